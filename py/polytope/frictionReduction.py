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

from .scene.stages import Reduction, Stage, refuseMatchMaker

__all__ = ['FrictionReduction', 'FrictionReductionResult', 'Stage', 'setFrictionAngle']


def setFrictionAngle(angle):
	"""Gives all rock joints this friction angle at once: contacts that exist, and through their materials those to come.

	:param float angle: [rad], from 0 to below π/2
	:raises ValueError: naming *frictionAngle* if out of range; *strength* if joints have a shear law of their own; naming *frictAngle* if a
	    MatchMaker of the Ip2 functor sets another angle for new contacts
	"""
	refuseMatchMaker()
	if any(isinstance(material, RockJointMat) and material.strength is not None for material in O.materials):
		raise ValueError('strength: joints have a shear law, which no single angle stands for; polytope.factorOfSafety divides it')
	for material in O.materials:
		if isinstance(material, RockJointMat):
			material.frictionAngle = angle
	for contact in O.interactions:
		if contact.isReal and isinstance(contact.phys, RockJointPhys):
			contact.phys.tangensOfFrictionAngle = tan(angle)


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


class FrictionReduction(Reduction):
	"""Finds the friction angle at which bodies fail (see the head of this file).

	A stage is *stable* when all bodies are slower than *stableSpeed* at three consecutive checks, *checkEvery* steps apart (a body that
	oscillates is slow for a moment), and has *failed* when one of them is further than *failedDistance* from where it was when the scene
	had settled. Speed and way are of the centre, or by the body's turn half a size away from it, whichever is larger. States are kept with
	O.saveTmp: after run(), and after restore(), bodies, contacts and engines are new Python objects, so hold ids, not bodies. Engines' own
	counters start anew too; failed contact queries are summed up here. Permanent forces and torques (O.forces.setPermF, setPermT), which
	O.saveTmp leaves out, are kept.

	:param bodies: ids of the bodies that are watched
	:param float start: friction angle to settle at [rad]
	:param steps: reductions [rad], each smaller than the one before
	:param float stableSpeed: [m/s]
	:param float failedDistance: [m]; default a fiftieth of the largest watched body: of the edge of the cube (square) that has its volume (area)
	:param int checkEvery: steps between two checks
	:param int mostSteps: of one stage; one that is neither stable nor failed by then is 'creeping' and counts as failed
	:param measure: called without arguments at the end of each stage; what it returns is in Stage.measured
	:param progress: called with the Stage after each check, for a progress bar
	:raises ValueError: naming the argument that is out of range
	"""

	mark = 'frictionReduction'

	def __init__(
		self,
		bodies,
		start,
		steps,
		stableSpeed=2e-7,
		failedDistance=None,
		checkEvery=100,
		mostSteps=200000,
		measure=lambda: None,
		progress=lambda stage: None,
	):
		super().__init__(bodies, stableSpeed, failedDistance, checkEvery, mostSteps, measure, progress)
		self.start = start
		if not 0 < start < math.pi / 2:
			raise ValueError(f'start: must be an angle in radians between 0 and pi/2, got {start}')
		self._takeSteps(steps, 'positive angles')
		if not self.steps[0] < start:
			raise ValueError(f'steps: must be angles in radians below the start, {start:g}, got {self.steps[0]:g}')

	def run(self):
		"""Settles the scene and reduces the angle. Leaves the scene in the failed state; restore() brings back the last stable state.

		:returns: a FrictionReductionResult
		:raises RuntimeError: if the scene does not come to rest at the starting angle, or stands at any angle
		"""
		self._begin(self.start, f'at the starting angle, {math.degrees(self.start):g}°')
		stable, failed = self._bracket(self.start)
		return FrictionReductionResult(stable, failed, self.stages, self.failedQueries)

	def _levels(self, began, step):
		return (began - count * step for count in range(1, math.ceil(began / step)))  # not by repeated subtraction: rounding would add up

	def _standsAnyway(self, stable):
		return f'stable at every friction angle down to {math.degrees(stable):g}°'

	def _set(self, level):
		setFrictionAngle(level)
