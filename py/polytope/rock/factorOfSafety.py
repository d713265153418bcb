# SPDX-License-Identifier: GPL-2.0-or-later
"""The factor of safety of a scene, and how it fails: `polytope.factorOfSafety(…)` (docs/strength-reduction.md)."""

import dataclasses

import numpy as np
from tqdm import tqdm
from yade import O, Quaternion, RockJointMat

from ..arguments import namedArguments, number, warn
from ..bonding.bolting import madeBolts
from ..bonding.bonds import madeBonds
from ..pictures.films import filmEngines
from ..rest.scaledMasses import scaledMassesIfPossible
from ..rest.unbalanced import unbalancedForce
from ..rest.unrest import Unrest
from ..rest.ways import posesById, waysOf
from ..scene.movers import canMove
from ..scene.namedBodies import namedBodies
from ..scene.permanentLoads import givePermanentLoads, permanentLoads
from ..scene.present import integrators
from ..scene.relaxing import relaxing
from ..scene.stages import partOfSize, sizeOf
from ..strengthReduction import divideStrengths, strengths
from .bracket import Bracket
from .faceMaterials import materialsOf
from .failure import Failure, inMode, noMode, told
from .motion import Motion
from .pointHistories import histories

__all__ = ['FactorOfSafety', 'Trial', 'factorOfSafety']

atRest, loosest = 0.05, 1e-3
"""Unbalanced force, as of *settle*, below which bodies stand, over the tolerance [-]: one that slides has about the part by which its
strength is too small, so this is far below it; and the largest such force, whatever the tolerance."""
still = 1e-3
"""Way of a body in these looks, over that which counts as failure, below which it stands: what swings slowly has no unbalanced force for a moment."""
between, looks = 50, 3
"""Steps between two looks, and looks in a row at which all must be at rest."""
damping = 0.4
"""Damping of NewtonIntegrator in trials: local damping takes a part of the unbalanced force, so it does not move the limit of what stands."""
gently = 1.02
"""Largest ratio from one factor to the next where a bolt has no pretension: it bears only what blocks have moved by, and they would
overshoot from a larger one."""
before, standing = 'factorOfSafety', 'factorOfSafety.standing'
"""Names of states in memory: as the scene was, and the last one at rest."""


@dataclasses.dataclass
class Trial:
	"""Strengths divided by one number."""

	factor: float
	outcome: str
	"""'stable': at rest; 'failed': a body has moved too far, or does so faster and faster; 'creeping': neither by the last step, which
	counts as failure."""
	steps: int
	unbalanced: float
	"""Force at the end [-]."""
	displacement: float
	"""Way of the body that has moved or turned farthest for its size (rest/ways.py), since the first state that stood: with the scene's own
	strengths, or with *most* times them where the factor is below 1 [m]."""
	trembling: list = dataclasses.field(default_factory=list)
	"""Ids of bodies whose force does not fade though they stay where they are (*unrest*): 'stable' all the same."""


@dataclasses.dataclass
class FactorOfSafety(Failure):
	"""What *polytope.factorOfSafety* found."""

	trials: list
	"""All *Trial* in the order in which they were made."""


@namedArguments
def factorOfSafety(bodies=None, reduce=strengths, tolerance=0.01, most=20, steps=200000):
	"""The number by which all strengths of joints and bonds can be divided until bodies move away: ``print(polytope.factorOfSafety())``.

	The scene must be at rest under its loads (*polytope.settle*). It is run with its own strengths first; if it fails, the factor is below
	1, and the search begins with *most* times its strengths. Then strengths are divided by a number between what stood and what failed,
	trial by trial. A trial begins at the last state that stood: strengths are only ever lowered from there, so its forces are in
	equilibrium, and no joint bore more than its strength on the way, as if rock weathered. It is stable when no body has an unbalanced
	force above a twentieth of the tolerance (0.001 at most) and none moves, or only such as tremble in place for good. It has failed when a
	body has moved by a fiftieth of its size since the scene stood with its own strengths, or turned by 0.04 rad, or in this trial by a
	quarter of that faster and faster, with nothing ahead that could stop it and no bolt or bond that holds it. A body that moves and comes
	to rest before is stable.
	Where a bolt has no pretension, or a joint a shear law of its own (RockJointMat.strength), strengths are lowered by 2 % at a time. Then
	the scene is what it was, time and joints included. Bodies, contacts and engines are new Python objects, as after O.loadTmp: hold ids.

	Where a time stepper sets the time step, bodies that need a smaller one than half of all bodies do are heavier in the trials, with the
	weight that they have (as by *polytope.settle*, densityScaling).

	Other engines of O.engines run in the trials, too: those that write files should be dead meanwhile.

	:param bodies: ids of those that count; default all that can move
	:param reduce: which strengths: of 'friction', 'cohesion' and 'tension'
	:param float tolerance: width of the bracket over the factor
	:param float most: factor at which to give up: what stands there has an infinite one, with no mode; and by which strengths are
	    multiplied where it is below 1
	:param int steps: most of a trial; one that is neither at rest nor away by then counts as failed
	:returns: *FactorOfSafety*
	:raises ValueError: naming the argument: bodies that cannot move, or without joints and bonds whose strength could be reduced
	:raises RuntimeError: the scene does not stand with *most* times its strengths, or is not at rest; it is what it was
	"""
	tolerance, most, steps = number(tolerance, 'tolerance'), number(most, 'most'), number(steps, 'steps')
	if not 0 < tolerance < 1:
		raise ValueError(f'tolerance: must be above 0 and below 1, got {tolerance:g}')
	if not 1 < most < float('inf'):
		raise ValueError(f'most: must be above 1 and finite, got {most:g}')
	if not steps >= looks * between:
		raise ValueError(f'steps: must be at least {looks * between}, got {steps:g}')
	divideStrengths(1, reduce)  # refuses what is no strength
	watched = [int(k) for k in namedBodies(bodies, name='bodies')]
	if not watched:
		raise ValueError('bodies: there is none that can move')
	_refuseBodies(watched)
	_refuseScene()
	O.saveTmp(before, quiet=True)
	loads = permanentLoads()
	try:
		with scaledMassesIfPossible() as scaled:  # what stands and what does not is the same
			return _Search(watched, reduce, int(steps), scaled, tolerance).run(most)
	finally:
		_load(before, loads)


def _refuseBodies(watched):
	fixed = [k for k in watched if not canMove(O.bodies[k])]
	if fixed:
		raise ValueError(f'bodies: body {fixed[0]} cannot move; name bodies that can')
	parts = [part for k in watched for part in ([O.bodies[m] for m in O.bodies[k].shape.members] if O.bodies[k].isClump else [O.bodies[k]])]
	if not madeBonds() and not any(isinstance(part.material, RockJointMat) for part in parts):
		kinds = ', '.join(sorted({type(part.material).__name__ for part in parts}))
		raise ValueError(f'bodies: they are of {kinds}, and what is reduced are strengths of RockJointMat and of bonds')


def _refuseScene():
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	if not integrators():
		raise ValueError('O.engines: there must be a NewtonIntegrator; set O.engines first')
	if relaxing():
		raise RuntimeError('O.engines: forces of excavated bodies are still fading; polytope.settle() first')


def _load(name, loads):
	O.loadTmp(name, quiet=True)
	givePermanentLoads(loads)


class _Search:
	def __init__(self, watched, reduce, steps, scaled, tolerance):
		self.watched, self.reduce, self.steps, self.tolerance = watched, tuple(reduce), steps, tolerance
		self.bound = min(atRest * tolerance, loosest)
		self.loads = permanentLoads()
		"""Permanent loads, with those that scaled masses come with."""
		self.masses = scaled and scaled[1]
		"""True masses by id, where those of the scene are scaled."""
		self.sizes = np.array([sizeOf(k) for k in watched])
		self.trials, self.mode = [], None
		# what bears only after some motion: slack bolts, joints whose roughness slip mobilises
		self.gently = any(float(bolt.pretension) == 0 for bolt in madeBolts()) or any(
			getattr(material, 'strength', None) is not None for body in O.bodies for material in materialsOf(body)
		)
		self.reached = 1.0
		"""Factor of the state from which trials begin, the last one that stood."""
		self.lacked = 0.0, None
		"""Mean unbalanced force of the body that moved farthest in the last trial [-], and its id."""
		self.limit = None
		"""Factor that the motion in the last trial tells."""
		self.settled = None
		"""Whether the scene was at rest at first: then it may swing and fail as its joints begin to slip, and stand with the same strengths
		from a state in which they have slipped."""
		self.left = 1
		"""Trials that are expected, with the present one: for the time left in the bar."""

	def run(self, most):
		with tqdm(unit=' steps', disable=None, leave=False) as self.bar:
			bracket = self._begun(most)
			while not bracket.isFound:
				self.left = bracket.halvings
				trial = self._trialFromRest(bracket.next())
				bracket.tell(trial.factor, trial.outcome == 'stable', *self.lacked, self.limit, self.reached)
				bracket.stable = max(bracket.stable, self.reached)
				self._refuseUnsettled(bracket)
				if bracket.stable >= most:
					self.mode = noMode()
					break
		self._tellTrembling()
		return FactorOfSafety(bracket.stable, bracket.failed, *self.mode, self.trials)

	def _begun(self, most):
		"""Begins with the scene's own strengths; where the scene fails with these, with strengths so large that it stands, from the same state."""
		bracket = Bracket(self.tolerance, most)
		self.settled = unbalancedForce(self.watched) < self.bound
		self.origin = posesById().of(self.watched)
		O.saveTmp(standing, quiet=True)
		own = self._trial(1.0)
		if own.outcome != 'stable':
			self.mode = self._motion()
			bracket.tell(1.0, False, *self.lacked, self.limit, 0.0)
			_load(standing, self.loads)
			bracket.stable = 1 / most
			divideStrengths(bracket.stable, self.reduce)
			if self._trial(bracket.stable).outcome != 'stable':
				raise RuntimeError(
					f'the scene does not stand with its own strengths ({own.outcome}, unbalanced force {own.unbalanced:.2g} after {own.steps} steps; {told(*self.mode)}), '
					f'nor with {most:g} times {", ".join(self.reduce)}; polytope.settle() first, a support, or more of the other strengths'
				)
		self.origin = posesById().of(self.watched)
		return bracket

	def _refuseUnsettled(self, bracket):
		"""Refuses a scene that failed with its own strengths only because it was not at rest: from a state that stood it does not fail."""
		if not self.settled and bracket.stable >= 1 and self.trials[0].outcome != 'stable':
			raise RuntimeError(
				'the scene stands with its own strengths from a state at rest, and fails from the one that it is in; polytope.settle() first'
			)

	def _tellTrembling(self):
		ones = sorted({k for trial in self.trials for k in trial.trembling})
		if ones:
			warn(
				f'bodies: {", ".join(map(str, ones[:3]))}{" …" if len(ones) > 3 else ""} tremble in place by more than {self.bound:g} of what they bear; their trials count as stable'
			)

	def _trialFromRest(self, factor):
		if self.trials[-1].outcome != 'stable':
			_load(standing, self.loads)
		while self.gently and self.reached * gently < factor:
			trial = self._weaken(self.reached * gently)
			if trial.outcome != 'stable':
				return trial
		return self._weaken(factor)

	def _weaken(self, factor):
		divideStrengths(factor / self.reached, self.reduce)
		trial = self._trial(factor)
		if trial.outcome != 'stable':
			self.mode = self._motion()
		return trial

	def _trial(self, factor):
		for integrator in integrators():
			integrator.damping = damping
		for engine in [*histories(), *filmEngines()]:
			engine.dead = True  # what happens in a trial is none of the scene's history
		self.quiet = 0
		trial = Trial(factor, 'creeping', 0, 0.0, 0.0)
		motion, unrest = Motion(self.watched, self.sizes), Unrest(self.bound, self.watched, self.masses)
		self.trials.append(trial)
		while trial.steps < self.steps and trial.outcome == 'creeping':
			for _ in range(between):
				O.step()  # O.run(…, wait=True) looks only every 40 ms whether it is done
			trial.steps += between
			trial.unbalanced = unrest.look(between)
			motion.look()
			parts = self._show(factor)
			trial.outcome = self._outcome(trial, parts, motion, unrest)
		farthest = int(np.argmax(parts))
		self.lacked = float(unrest.mean[self.watched[farthest]]), self.watched[farthest]
		self.limit = motion.limit(factor) if set(self.reduce) == set(strengths) else None
		trial.displacement = float(self._ways()[farthest])
		if trial.outcome == 'stable':
			self.reached = factor
			O.saveTmp(standing, quiet=True)
		return trial

	def _outcome(self, trial, parts, motion, unrest):
		"""How the trial stands now: 'failed', 'stable', or 'creeping' where it is neither."""
		if not parts.max() <= 1 or motion.runsAway():  # not a number counts as failed
			return 'failed'
		self.quiet = self.quiet + 1 if trial.unbalanced < self.bound else 0
		stands = self.quiet >= looks and motion.way(looks) < still and not motion.speedsUp()
		trial.trembling = [] if stands else _trembling(unrest)
		return 'stable' if stands or trial.trembling else 'creeping'

	def _show(self, factor):
		"""Way of each body over that which counts as failure."""
		steps = [trial.steps for trial in self.trials]
		self.bar.total = sum(steps[:-1]) + self.left * max(steps)
		self.bar.set_postfix_str(f'strengths over {factor:.4g}', refresh=False)
		self.bar.update(between)
		return self._ways() / (partOfSize * self.sizes)

	def _ways(self):
		return waysOf(self.origin, posesById().of(self.watched), self.sizes)

	def _motion(self):
		"""(ids, displacements, rotations) of the bodies that have moved, the farthest first."""
		ways = self._ways()
		order = inMode(ways)
		moved = (posesById().of(self.watched).places - self.origin.places)[order]
		turned = [_rotation(self.origin.orientations[k], O.bodies[self.watched[k]].state.ori) for k in order]
		return [self.watched[k] for k in order], moved, np.array(turned)


def _trembling(unrest):
	"""Ids of the bodies that are not at rest, if all of them tremble in place for good."""
	lost = unrest.hopeless()
	return [one.id for one in lost] if all(one.kind == 'trembles' for one in lost) else []


def _rotation(before, now):
	x, y, z, w = before
	axis, angle = (now * Quaternion(w, x, y, z).conjugate()).toAxisAngle()[:2]
	angle = float(angle)
	return np.array(axis, float) * (angle - 2 * np.pi if angle > np.pi else angle)
