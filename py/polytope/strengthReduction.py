# SPDX-License-Identifier: GPL-2.0-or-later
"""The factor of safety of a scene of rock joints: the number by which all strengths may be divided until it fails::

	from yade.polytope.strengthReduction import StrengthReduction

	polytope.settle()  # at rest under its own strengths
	found = StrengthReduction([body.id for body in O.bodies if body.dynamic], steps=(0.1, 0.02)).run()
	print(found.stable, found.failed)

tan φ, cohesion, tensile strength and their residual values of each joint and bond are divided by the same factor, so that joints, sets and
materials of different strengths keep their proportions. Bolts (polytope.bolt) keep theirs.
"""

import dataclasses
import math
from collections.abc import Iterable

from yade import O, RockJointMat, RockJointPhys
from yade.math import atan, tan  # of YADE's numbers, in any precision

from .bonding.bonds import madeBonds
from .scene.stages import Reduction, refuseMatchMaker

__all__ = ['StrengthReduction', 'StrengthReductionResult', 'checkedStrengths', 'divideStrengths', 'strengths']

strengths = 'friction', 'cohesion', 'tension'
"""What can be divided."""


def divideStrengths(factor, reduce=strengths):
	"""Divides the strengths of all rock joints at once: of contacts that exist, through their materials of those to come, and of bonds.

	tan φ, tan φᵣ, cohesion, tensile strength and the residual values of both; stiffnesses and dilation stay as they are. In a shear law of its own
	(RockJointMat.strength), tan φ at each stress and displacement is divided.

	:param float factor: above 0; 2 halves them
	:param reduce: which: of 'friction', 'cohesion' and 'tension', residual values with the peak's
	:raises ValueError: naming *factor* if out of range; *reduce* if there is another word in it; *frictAngle* if a MatchMaker of the Ip2
	    functor sets another angle for new contacts
	"""
	if not (factor > 0 and math.isfinite(factor)):
		raise ValueError(f'factor: must be a number above 0, got {factor}')
	checkedStrengths(reduce)
	refuseMatchMaker()
	angles, tangents, pressures = _names(reduce)

	def divide(one, names):
		for name in names if factor < 1 else names[::-1]:  # residual values are never above the peak's
			if getattr(one, name, -1) > 0:  # -1: none of its own
				setattr(one, name, getattr(one, name) / factor)

	def lower(one):
		for name in angles:
			if getattr(one, name, -1) > 0:
				setattr(one, name, atan(tan(getattr(one, name)) / factor))

	for material in O.materials:
		if isinstance(material, RockJointMat):
			if material.strength is None:
				lower(material)
			elif 'friction' in reduce:
				material.reduction *= factor
			divide(material, pressures)
	joints = [contact.phys for contact in O.interactions if contact.isReal and isinstance(contact.phys, RockJointPhys)]
	for joint in joints:
		if joint.hasOwnStrength and 'friction' in reduce:
			joint.reduction *= factor
		divide(joint, pressures if joint.hasOwnStrength else tangents + pressures)
	for bond in [*madeBonds(), *(joint.bond for joint in joints if joint.bond)]:
		lower(bond)
		divide(bond, pressures)


def checkedStrengths(reduce):
	"""Refuses what is no sequence of *strengths*."""
	names = () if isinstance(reduce, str) or not isinstance(reduce, Iterable) else list(reduce)
	if not names or not all(name in strengths for name in names):
		raise ValueError(f'reduce: must be a sequence of one or more of {strengths}, got {reduce!r}')


def _names(reduce):
	"""Attributes of materials, joints and bonds: angles, their tangents, and strengths in Pa."""
	angles = ('frictionAngle', 'residualFrictionAngle') if 'friction' in reduce else ()
	tangents = ('tangensOfFrictionAngle', 'tangensOfResidualFrictionAngle') if 'friction' in reduce else ()
	cohesions = ('cohesion', 'residualCohesion') if 'cohesion' in reduce else ()
	return angles, tangents, cohesions + (('tensileStrength', 'residualTensileStrength') if 'tension' in reduce else ())


@dataclasses.dataclass
class StrengthReductionResult:
	stable: float
	"""Highest factor at which all bodies were at rest."""
	failed: float
	"""Lowest one at which they failed, one last step above *stable*."""
	stages: list
	"""All stages (*Stage* of scene/stages.py, *level* is the factor) in the order they were run, the first one at the factor 1."""
	failedQueries: int
	"""Contact queries without an answer, over all stages."""

	@property
	def factor(self):
		"""Factor of safety: the middle of the bracket."""
		return (self.stable + self.failed) / 2


class StrengthReduction(Reduction):
	"""Finds the factor of safety (see the head of this file). The scene must stand with its own strengths: *polytope.settle()* first.

	The factor rises from 1 by the first step, each time until the bodies have come to rest again or have failed. At a failure the last
	stable state is restored, and the factor rises from it by the next, finer step. Stages, states and what is kept are as of
	*FrictionReduction*.

	:param bodies: ids of the bodies that are watched
	:param steps: of the factor, each smaller than the one before
	:param float most: factor at which to give up
	:param float stableSpeed: [m/s]
	:param float failedDistance: [m]; default a fiftieth of the largest watched body
	:param int checkEvery: steps between two checks
	:param int mostSteps: of one stage; one that is neither stable nor failed by then is 'creeping' and counts as failed
	:param measure: called without arguments at the end of each stage; what it returns is in Stage.measured
	:param progress: called with the Stage after each check, for a progress bar
	:raises ValueError: naming the argument that is out of range
	"""

	mark = 'strengthReduction'

	def __init__(
		self,
		bodies,
		steps=(0.1, 0.02),
		most=20.0,
		stableSpeed=2e-7,
		failedDistance=None,
		checkEvery=100,
		mostSteps=200000,
		measure=lambda: None,
		progress=lambda stage: None,
	):
		super().__init__(bodies, stableSpeed, failedDistance, checkEvery, mostSteps, measure, progress)
		self.most = most
		self._takeSteps(steps, 'positive')
		if not most > 1:
			raise ValueError(f'most: must be above 1, got {most}')

	def run(self):
		"""Divides the strengths. Leaves the scene in the failed state; restore() brings back the last stable state, with its reduced strengths.

		:returns: a StrengthReductionResult
		:raises RuntimeError: if the scene does not stand with its own strengths, or stands with a *most*-th of them
		"""
		self.present = self.kept = 1.0
		self._begin(1.0, 'with its own strengths')
		stable, failed = self._bracket(1.0)
		return StrengthReductionResult(stable, failed, self.stages, self.failedQueries)

	def restore(self):
		"""Brings back the last stable state."""
		super().restore()
		self.present = self.kept

	def _save(self):
		super()._save()
		self.kept = self.present

	def _levels(self, began, step):
		level, count = began, 0
		while level < self.most:
			count += 1
			level = began + count * step
			yield level

	def _standsAnyway(self, stable):
		return f'stable with strengths divided by {stable:g}'

	def _set(self, level):
		if level != self.present:
			divideStrengths(level / self.present)
		self.present = level
