# SPDX-License-Identifier: GPL-2.0-or-later
"""The factor of safety by limit analysis: `polytope.limitAnalysis(…)` (docs/limit-analysis.md)."""

import dataclasses

import numpy as np
from tqdm import tqdm
from yade import O

from ...arguments import namedArguments, number
from ...scene.stages import partOfSize
from ...strengthReduction import checkedStrengths, strengths
from ..bracket import Bracket
from ..failure import Failure, inMode, noMode, told
from .blocks import blocksOf, cornersOf, refuseScene
from .bolts import linksOf, withLinks
from .equilibrium import Equilibrium
from .leastStrength import leastStrength

__all__ = ['LimitAnalysis', 'LimitTrial', 'limitAnalysis']


@dataclasses.dataclass
class LimitTrial:
	"""Strengths divided by one number."""

	factor: float
	stands: bool
	missing: float
	"""Least cohesion and tensile strength that all joints would need in addition to stand [Pa]; 0 where it stands."""
	steps: int
	"""Steps of the interior-point method."""


@dataclasses.dataclass
class LimitAnalysis(Failure):
	"""What *polytope.limitAnalysis* found. Displacements and rotations are those with which the mass begins to fail, of a size such that
	the block that goes and turns most for its size moves by a fiftieth of it."""

	trials: list
	"""All *LimitTrial* in the order in which they were made."""
	joints: int
	"""Number of faces that blocks have in common."""


@namedArguments
def limitAnalysis(reduce=strengths, tolerance=0.01, most=20):
	"""The number by which all strengths of joints can be divided until no forces within them hold the blocks: ``print(polytope.limitAnalysis())``.

	Limit analysis of rigid blocks (Livesley 1978; Ferris & Tin-Loi 2001; Portioli et al. 2014): no step is run, and the scene need not be
	at rest, only be appended, with O.engines for gravity. Joints are where faces of Polytopes lie on each other; what blocks touch by edges
	and corners alone does not count. A joint bears forces at the corners of the common face: normal forces, down to the tensile strength
	times the area that the corner stands for, and shear forces within Coulomb's cone with friction and cohesion. The scene stands where
	forces within these strengths balance weight, given loads (O.forces.setPermF and setPermT, ForceEngine, TorqueEngine) and water on every
	block (static theorem). Else it fails, and the motion is found along with that (kinematic theorem). Second-order cones, not polygons in
	their place, solved by an interior-point method with the package python3-cvxopt.

	A bolt that passes from block to block bears a tension up to what its steel (yieldForce) and grout hold, and its dowel across, all fully
	mobilised whatever its stiffness; these are not divided. A bond is a joint of its own strengths (both infinite: what it joins is one
	block).

	Joints are perfectly plastic, as in limit equilibrium, so the strength is that of the material before failure, residual values do not
	count, and stiffnesses do not matter. With friction a joint that slips opens by tan φ times its slip (associated flow): the theorems
	hold for no other. For rock that dilates less the factor is an upper estimate. Where blocks can open freely, as where they slide out of
	a slope, that does not matter. Where they jam it is too high: by 4 to 12 % for wedges on two planes, by a fifth for columns that topple
	and rub against each other, without bound between fixed walls. Compare *polytope.keyBlocks*, or *polytope.factorOfSafety*, which has the
	dilation that the material has.

	:param reduce: which strengths: of 'friction', 'cohesion' and 'tension'
	:param float tolerance: width of the bracket over the factor
	:param float most: factor at which to give up: what stands there has an infinite one, with no mode; and by which strengths are
	    multiplied where it is below 1
	:returns: *LimitAnalysis*
	:raises ValueError: naming the argument, or what in the scene is no rigid block with joints: bodies other than Polytopes, materials
	    other than RockJointMat, bonds with one strength without a limit, bolts without one, blocks that no joint connects to a fixed one
	:raises ImportError: python3-cvxopt is not installed
	:raises RuntimeError: the scene does not stand with *most* times its strengths
	"""
	tolerance, most = float(number(tolerance, 'tolerance')), float(number(most, 'most'))
	if not 1e-4 <= tolerance < 1:
		raise ValueError(f'tolerance: must be from 0.0001 to below 1, got {tolerance:g}')
	if not 1 < most < float('inf'):
		raise ValueError(f'most: must be above 1 and finite, got {most:g}')
	checkedStrengths(reduce)
	refuseScene()
	blocks = blocksOf()
	links = linksOf(blocks)
	return _Search(blocks, cornersOf(blocks, links), links, tuple(reduce), tolerance).run(most)


class _Search:
	def __init__(self, blocks, corners, links, reduce, tolerance):
		self.blocks, self.corners, self.links, self.reduce, self.tolerance = blocks, corners, links, reduce, tolerance
		self.length = float(blocks.sizes.mean())
		self.force = float(np.linalg.norm(blocks.loads * [1, 1, 1, 1 / self.length, 1 / self.length, 1 / self.length], axis=1).mean())
		"""Units, in which numbers are about 1."""
		self.area = float(corners.areas.mean()) if len(corners.areas) else self.length**2
		bolted, linked = withLinks(blocks, corners, self.links)
		self.equilibrium = Equilibrium(bolted, linked, self.length)
		self.load = (bolted.loads / np.repeat([self.force, self.force * self.length], 3) * blocks.free).ravel()
		self.trials, self.motion, self.limit = [], None, None

	def run(self, most):
		with tqdm(unit=' steps', disable=None, leave=False) as self.bar:
			bracket = Bracket(self.tolerance, most)
			if not self._stands(1.0, bracket):
				bracket.stable = 1 / most
				if not self._stands(bracket.stable, bracket):
					raise RuntimeError(
						f'the scene does not stand, not even with {most:g} times {", ".join(self.reduce)}: {told(*self._mode())}; a support, or more of the other strengths'
					)
			while not bracket.isFound:
				if self._stands(bracket.next(), bracket) and bracket.stable >= most:
					break
		mode = self._mode() if np.isfinite(bracket.failed) else noMode()
		return LimitAnalysis(bracket.stable, bracket.failed, *mode, self.trials, len(self.corners.one))

	def _stands(self, factor, bracket):
		corners = self.corners
		parts = [1 / factor if name in self.reduce else 1.0 for name in strengths]
		share = corners.areas / self.area
		pressure = self.force / self.area
		friction, most = corners.friction, self.links.most / self.force
		cohesion, tension = (share * of / pressure for of in (corners.cohesion, corners.tension))
		try:
			found = leastStrength(
				self.equilibrium,
				self.load,
				np.append(parts[0] * friction, np.full(len(most), -1.0)),
				np.append(parts[1] * cohesion, most / 2),
				np.append(parts[2] * tension, most / 2),
				np.append(share, 0 * most),
				lambda _: self._show(factor),
			)
		except ArithmeticError as error:
			raise RuntimeError(
				f'strengths divided by {factor:g}: no forces in equilibrium were found ({error}); is each block held along all that it can move along?'
			) from None
		stands = found.isZero
		self.trials.append(LimitTrial(factor, stands, 0.0 if stands else found.value * pressure, found.steps))
		limit = None
		if not stands:
			if factor <= bracket.failed:
				self.motion = found.motion
			# by how much λ falls for more strength: the straight line leads to where it is 0
			openings, forces = found.openings[: len(share)], found.forces[: len(share)]
			slopes = ((openings[:, 0] * by).sum() for by in (friction * forces[:, 0], cohesion))
			slopes = [*slopes, (openings[:, 1] * tension).sum()]
			slope = float(sum(slope for slope, name in zip(slopes, strengths, strict=True) if name in self.reduce))
			limit = 1 / (1 / factor + found.value / slope) if slope > 0 else None
		bracket.tell(factor, stands, limit=limit)
		return stands

	def _show(self, factor):
		self.bar.set_postfix_str(f'strengths over {factor:.4g}', refresh=False)
		self.bar.update(1)

	def _mode(self):
		"""(ids, displacements, rotations) of the blocks that move, the farthest first."""
		motion = self.motion.reshape(-1, 6) * self.blocks.free
		ways = np.linalg.norm(motion[:, :3], axis=1)
		turns = np.linalg.norm(motion[:, 3:], axis=1) * self.blocks.sizes / (2 * self.length)  # of a face
		size = partOfSize / float(((ways + turns) / self.blocks.sizes).max())
		ids, moves, turned = [], [], []
		for row in inMode(ways):
			turn = size / self.length * motion[row, 3:]
			for k in self.blocks.ids[row]:
				ids.append(k)
				moves.append(size * motion[row, :3] + np.cross(turn, np.array(O.bodies[k].state.pos, float) - self.blocks.centres[row]))
				turned.append(turn)
		return ids, np.array(moves), np.array(turned)
