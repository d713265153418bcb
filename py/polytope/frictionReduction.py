# SPDX-License-Identifier: GPL-2.0-or-later
"""The friction angle at which a scene of rock joints fails, found by reducing it step by step::

	from yade.polytope.frictionReduction import FrictionReduction

	reduction = FrictionReduction([wedge.id], start=radians(70), steps=[radians(s) for s in (1, 0.1, 0.02)])
	found = reduction.run()
	print(degrees(found.stable), degrees(found.failed))

The scene settles at a high angle. From there the angle is reduced by the first step, each time until the bodies have come to rest
again or have failed. At a failure the last stable state is restored, and the angle is reduced from it by the next, finer step.
The result is a bracket as wide as the last step.
"""

import dataclasses
import math

from yade import O, RockJointMat, RockJointPhys
from yade.math import tan  # of YADE's numbers, in any precision

from ._loads import givePermanentLoads, permanentLoads
from ._scene import interactionLoops

__all__ = ['FrictionReduction', 'FrictionReductionResult', 'Stage', 'setFrictionAngle']


def setFrictionAngle(angle):
	"""Gives all rock joints this friction angle at once: contacts that exist, and through their materials those to come.

	:param float angle: [rad], from 0 to below π/2
	:raises ValueError: naming *frictionAngle* if out of range; naming *frictAngle* if a MatchMaker of the
	    Ip2 functor sets another angle for new contacts
	"""
	for loop in interactionLoops():
		if any(getattr(functor, 'frictAngle', None) for functor in loop.physDispatcher.functors):
			raise ValueError('frictAngle: new contacts would take the MatchMaker of the Ip2 functor, not the materials\' angle')
	for material in O.materials:
		if isinstance(material, RockJointMat):
			material.frictionAngle = angle
	for contact in O.interactions:
		if contact.isReal and isinstance(contact.phys, RockJointPhys):
			contact.phys.tangensOfFrictionAngle = tan(angle)


@dataclasses.dataclass
class Stage:
	"""What happened at one friction angle."""

	angle: float
	"""[rad]"""
	outcome: str
	"""'stable': at rest; 'failed': moved too far; 'creeping': neither by the time limit, which counts as failure."""
	steps: int
	speed: float
	"""Of the fastest body at the end [m/s]."""
	displacement: float
	"""Of the body that has moved most since the scene had settled, at the end [m]."""
	samples: list
	"""(time since the stage began [s], speed [m/s], displacement [m]) at each check."""
	measured: object = None
	"""What *measure* returned at the end of the stage."""


@dataclasses.dataclass
class FrictionReductionResult:
	stable: float
	"""Lowest friction angle at which all bodies were at rest [rad]."""
	failed: float
	"""Highest one at which they failed, one last step below *stable* [rad]."""
	stages: list
	"""All stages in the order they were run, the first one being the settling."""
	failedQueries: int
	"""Contact queries without an answer, over all stages."""

	@property
	def critical(self):
		"""Middle of the bracket [rad]."""
		return (self.stable + self.failed) / 2


class FrictionReduction:
	"""Finds the friction angle at which bodies fail (see the head of this file).

	A stage is *stable* when all bodies are slower than *stableSpeed* at three consecutive checks, *checkEvery* steps apart (a body that
	oscillates is slow for a moment), and has *failed* when one of them is further than *failedDistance* from where it was when the scene
	had settled. States are kept with O.saveTmp: after run(), and after restore(), bodies, contacts and engines are new Python objects,
	so hold ids, not bodies. Engines' own counters start anew too; failed contact queries are summed up here. Permanent forces and torques
	(O.forces.setPermF, setPermT), which O.saveTmp leaves out, are kept.

	:param bodies: ids of the bodies that are watched
	:param float start: friction angle to settle at [rad]
	:param steps: reductions [rad], each smaller than the one before
	:param float stableSpeed: [m/s]
	:param float failedDistance: [m]
	:param int checkEvery: steps between two checks
	:param int mostSteps: of one stage; one that is neither stable nor failed by then is 'creeping' and counts as failed
	:param measure: called without arguments at the end of each stage; what it returns is in Stage.measured
	:param progress: called with the Stage after each check, for a progress bar
	:raises ValueError: naming the argument that is out of range
	"""

	calmChecks = 3
	mark = 'frictionReduction'

	def __init__(
		self,
		bodies,
		start,
		steps,
		stableSpeed=2e-7,
		failedDistance=0.02,
		checkEvery=100,
		mostSteps=200000,
		measure=lambda: None,
		progress=lambda stage: None,
	):
		self.bodies, self.start, self.steps = list(bodies), start, list(steps)
		self.stableSpeed, self.failedDistance = stableSpeed, failedDistance
		self.checkEvery, self.mostSteps = checkEvery, mostSteps
		self.measure, self.progress = measure, progress
		if not self.bodies:
			raise ValueError('bodies: there must be at least one')
		if not 0 < start < math.pi / 2:
			raise ValueError(f'start: must be an angle in radians between 0 and pi/2, got {start}')
		if (
			not self.steps
			or not all(step > 0 for step in self.steps)
			or any(a <= b for a, b in zip(self.steps, self.steps[1:], strict=False))
		):
			raise ValueError(f'steps: must be positive angles, each smaller than the one before, got {self.steps}')
		for name in ('stableSpeed', 'failedDistance', 'checkEvery', 'mostSteps'):
			if not getattr(self, name) > 0:
				raise ValueError(f'{name}: must be positive, got {getattr(self, name)}')

	def run(self):
		"""Settles the scene and reduces the angle. Leaves the scene in the failed state; restore() brings back the last stable state.

		:returns: a FrictionReductionResult
		:raises RuntimeError: if the scene does not come to rest at the starting angle, or stands at any angle
		"""
		self.stages, self.failedQueries = [], 0
		settled = self._stage(self.start)
		if settled.outcome != 'stable':
			raise RuntimeError(
				f'the scene is not stable at the starting angle, {math.degrees(self.start):g}°: {settled.outcome} '
				f'({settled.displacement:.3g} m, {settled.speed:.3g} m/s after {settled.steps} steps); '
				+ (
					'start higher, with stiffer contacts, or with a larger failedDistance'
					if settled.outcome == 'failed'
					else 'take more damping, a larger stableSpeed, or more mostSteps'
				)
			)
		self.origins = self._positions()
		self._save()
		stable = self.start
		for level, step in enumerate(self.steps):
			if level:
				self.restore()
			stable, failed = self._reduce(stable, step)
		self._bookQueries()
		return FrictionReductionResult(stable, failed, self.stages, self.failedQueries)

	def restore(self):
		"""Brings back the last stable state."""
		self._bookQueries()
		O.loadTmp(self.mark, quiet=True)
		givePermanentLoads(self.loads)

	def _save(self):
		O.saveTmp(self.mark, quiet=True)
		self.loads = permanentLoads()

	def _reduce(self, stable, step):
		"""Down from a stable angle by *step* until failure: (lowest stable angle, angle of failure)."""
		began = stable
		for count in range(1, math.ceil(began / step)):
			angle = began - count * step  # not by repeated subtraction: rounding would add up
			if self._stage(angle).outcome != 'stable':
				return stable, angle
			stable = angle
			self._save()
		raise RuntimeError(f'stable at every friction angle down to {math.degrees(stable):g}°')

	def _stage(self, angle):
		setFrictionAngle(angle)
		if not self.stages:
			self.origins = self._positions()
		stage = Stage(angle, 'creeping', 0, 0.0, 0.0, [])
		self.stages.append(stage)
		began, calm = O.time, 0
		while stage.steps < self.mostSteps:
			for _ in range(self.checkEvery):
				O.step()  # O.run(…, wait=True) checks only every 40 ms whether it is done
			stage.steps += self.checkEvery
			stage.speed = max(float(O.bodies[k].state.vel.norm()) for k in self.bodies)
			stage.displacement = max(float((O.bodies[k].state.pos - origin).norm()) for k, origin in self.origins.items())
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

	def _positions(self):
		return {k: O.bodies[k].state.pos for k in self.bodies}

	def _bookQueries(self):
		"""Adds the contact functors' counts of failures to ours."""
		for loop in interactionLoops():
			for functor in loop.geomDispatcher.functors:
				if hasattr(functor, 'stats'):
					self.failedQueries += functor.stats()['failures']
					functor.resetStats()
