# SPDX-License-Identifier: GPL-2.0-or-later
"""Stages of frictionReduction and strengthReduction, in which a scene comes to rest again or fails, each weaker than the one before."""

import dataclasses
import math
import numbers
from collections.abc import Iterable

from yade import O, Polytope

from .permanentLoads import givePermanentLoads, permanentLoads
from .present import interactionLoops

__all__ = ['Reduction', 'Stage', 'partOfSize', 'refuseMatchMaker', 'sizeOf']

partOfSize = 0.02
"""The way at which a watched body has failed, by default, over the size of the largest one."""


def refuseMatchMaker():
	"""
	:raises ValueError: naming *frictAngle* if a MatchMaker of the Ip2 functor sets the angle of new contacts
	"""
	for loop in interactionLoops():
		if any(getattr(functor, 'frictAngle', None) for functor in loop.physDispatcher.functors):
			raise ValueError("frictAngle: new contacts would take the MatchMaker of the Ip2 functor, not the materials' angle")


@dataclasses.dataclass
class Stage:
	"""What happened at one strength."""

	level: float
	"""Strength: the friction angle [rad] (*frictionReduction*), or the factor by which strengths were divided [-] (*strengthReduction*)."""
	outcome: str
	"""'stable': at rest; 'failed': moved too far; 'creeping': neither by the time limit, which counts as failure."""
	steps: int
	speed: float
	"""Speed of the fastest body at the end, of its centre or by its spin half a size away from it [m/s]."""
	displacement: float
	"""Way of the body that has moved most since the scene had settled, at the end, likewise [m]."""
	samples: list
	"""(time since the stage began [s], speed [m/s], displacement [m]) at each check."""
	measured: object = None
	"""What *measure* returned at the end of the stage."""


class Reduction:
	"""What both reductions share. A subclass has

	- *mark*, the name of its saved state,
	- _set(level), which gives joints the strength of a level,
	- _levels(began, step), the levels that follow a stable one,
	- _standsAnyway(stable), the message where all of them are stable.
	"""

	calmChecks = 3

	def __init__(self, bodies, stableSpeed, failedDistance, checkEvery, mostSteps, measure, progress):
		if not isinstance(bodies, Iterable):
			raise ValueError(f'bodies: must be a sequence of ids, [{bodies!r}] for one body, got {bodies!r}')
		self.bodies = list(bodies)
		if not self.bodies:
			raise ValueError('bodies: there must be at least one')
		missing = [k for k in self.bodies if not isinstance(k, numbers.Integral) or not 0 <= k < len(O.bodies) or O.bodies[k] is None]
		if missing:
			raise ValueError(f'bodies: there is no body {missing[0]!r}')
		self.stableSpeed, self.failedDistance = stableSpeed, failedDistance
		self.checkEvery, self.mostSteps = checkEvery, mostSteps
		self.measure, self.progress = measure, progress
		for name in ('stableSpeed', 'failedDistance', 'checkEvery', 'mostSteps'):
			value = getattr(self, name)
			if value is not None and not value > 0:
				raise ValueError(f'{name}: must be positive, got {value}')
		self.stages, self.failedQueries = [], 0
		self.sizes = {k: sizeOf(k) for k in self.bodies}

	def _takeSteps(self, steps, what):
		self.steps = list(steps)
		falling = all(a > b for a, b in zip(self.steps, self.steps[1:], strict=False))
		if not self.steps or not all(step > 0 for step in self.steps) or not falling:
			raise ValueError(f'steps: must be {what}, each smaller than the one before, got {self.steps}')

	def _begin(self, level, what):
		"""The stage that the scene begins with."""
		self.stages, self.failedQueries = [], 0
		if self.failedDistance is None:
			self.failedDistance = partOfSize * max(self.sizes.values())
		settled = self._stage(level)
		if settled.outcome != 'stable':
			raise RuntimeError(
				f'the scene is not stable {what}: {settled.outcome} '
				f'({settled.displacement:.3g} m, {settled.speed:.3g} m/s after {settled.steps} steps); '
				+ (
					'start with more strength, with stiffer contacts, or with a larger failedDistance'
					if settled.outcome == 'failed'
					else 'take more damping, a larger stableSpeed, or more mostSteps'
				)
			)
		self.origins = self._poses()
		self._save()

	def _bracket(self, stable):
		"""(last stable level, level of failure) by all steps, from a level that is stable."""
		for number, step in enumerate(self.steps):
			if number:
				self.restore()
			stable, failed = self._reduce(stable, step)
		self._bookQueries()
		return stable, failed

	def _reduce(self, stable, step):
		"""(last stable level, level of failure) by one step, from a level that is stable."""
		for level in self._levels(stable, step):
			if self._stage(level).outcome != 'stable':
				return stable, level
			stable = level
			self._save()
		raise RuntimeError(self._standsAnyway(stable))

	def restore(self):
		"""Brings back the last stable state."""
		self._bookQueries()
		O.loadTmp(self.mark, quiet=True)
		givePermanentLoads(self.loads)

	def _save(self):
		O.saveTmp(self.mark, quiet=True)
		self.loads = permanentLoads()

	def _stage(self, level):
		self._set(level)
		if not self.stages:
			self.origins = self._poses()
		stage = Stage(level, 'creeping', 0, 0.0, 0.0, [])
		self.stages.append(stage)
		began, calm = O.time, 0
		while stage.steps < self.mostSteps:
			for _ in range(self.checkEvery):
				O.step()  # O.run(…, wait=True) checks only every 40 ms whether it is done
			stage.steps += self.checkEvery
			stage.speed = max(_speed(O.bodies[k].state, self.sizes[k]) for k in self.bodies)
			stage.displacement = max(_way(O.bodies[k].state, self.sizes[k], *origin) for k, origin in self.origins.items())
			stage.samples.append((O.time - began, stage.speed, stage.displacement))
			self.progress(stage)
			calm = calm + 1 if stage.speed < self.stableSpeed else 0
			if not stage.displacement <= self.failedDistance:  # not a number counts as failed
				stage.outcome = 'failed'
				break
			if calm == self.calmChecks:
				stage.outcome = 'stable'
				break
		stage.measured = self.measure()
		return stage

	def _poses(self):
		return {k: (O.bodies[k].state.pos, O.bodies[k].state.ori) for k in self.bodies}

	def _bookQueries(self):
		"""Adds the contact functors' counts of failures to ours."""
		for loop in interactionLoops():
			for functor in loop.geomDispatcher.functors:
				if hasattr(functor, 'stats'):
					self.failedQueries += functor.stats()['failures']
					functor.resetStats()


def _speed(state, size):
	return max(float(state.vel.norm()), float(state.angVel.norm()) * size / 2)


def _way(state, size, place, orientation):
	turn = (state.ori * orientation.conjugate()).toAxisAngle()[1]
	return max(float((state.pos - place).norm()), float(min(turn, 2 * math.pi - turn)) * size / 2)


def sizeOf(number):
	"""Edge of the cube, or square, of the body's volume, or area [m]; for a clump that of its parts together."""
	body = O.bodies[number]
	if body.isClump:
		return sum(sizeOf(part) ** 3 for part in body.shape.members) ** (1 / 3)
	shape = body.shape
	if not isinstance(shape, Polytope):
		return 2 * float(getattr(shape, 'radius', 0.5))
	return (float(shape.volume) / (float(shape.thickness) if shape.dimension == 2 else 1)) ** (1 / shape.dimension)
