# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of rigid blocks with a closed form, measured with one choice of contact at a time: what `./run accuracy --only joints` tells."""

import dataclasses
import functools
import math

import numpy as np

from ..scenes.arch import MasonryArch
from ..scenes.blockOnBase import RockingBlock, ShakenBlock, TiltedBlock
from ..scenes.releasedCube import CubeOnSlope, edgeNormal, slopeFloors, wallKick
from ..scenes.rollingSolid import RollingSolid
from ..theory.arch import leastThickness
from ..theory.rocking import rockingPeriod
from ..theory.toppling import criticalTilt, elasticToppling

__all__ = ['Measured', 'bisect', 'measures']

density, gravity = 2600.0, 9.81


@dataclasses.dataclass
class Measured:
	"""One quantity of one scene."""

	quantity: str
	unit: str
	theory: float
	ours: float
	allowed: float
	"""Largest difference that the default contact may have to theory; None: told only."""

	@property
	def good(self):
		return self.allowed is None or abs(self.ours - self.theory) <= self.allowed


def bisect(stands, low, high, accuracy):
	"""Load between those at which *stands(load)* is true and false; where it does not change between the ends, the end it would lie beyond."""
	if not stands(low):
		return low
	if stands(high):
		return high
	while high - low > accuracy:
		middle = (low + high) / 2
		low, high = (middle, high) if stands(middle) else (low, middle)
	return (low + high) / 2


def toppling(ig2, perArea, quick):
	"""Critical tilt of a block, against Goodman & Bray, or with stiffnesses per area against the elastic joint."""
	kn = 1e11
	for dimension in (2, 3):
		for ratio, friction in ((0.25, 40), (0.4, 35), (0.4, 21), (1.0, 30)):
			elastic = {'pressing': density * gravity * ratio, 'stiffness': kn} if perArea else {}
			mode, angle = criticalTilt(ratio, 1.0, math.radians(friction), **elastic)
			block = TiltedBlock(width=ratio, dimension=dimension, frictionAngle=math.radians(friction), stiffness=kn, perArea=perArea, ig2=ig2)
			ours = bisect(lambda a: block.apply(math.tan(a)).stands, 0.9 * angle, 1.04 * angle, (4e-3 if quick else 5e-4) * angle)  # noqa: B023
			name = f'{dimension}-D, width/height {ratio:g}, friction {friction}°: {mode} at'
			yield Measured(name, '°', math.degrees(angle), math.degrees(ours), 5e-3 * math.degrees(angle))


def shaking(ig2, perArea, quick):
	"""Acceleration of the base that overturns a block, and the period at which it rocks."""
	ratio, kn = 0.25, 1e11
	for dimension in (2, 3):
		theory = elasticToppling(ratio, 1.0, density * gravity * ratio, kn, followsTilt=False) if perArea else ratio
		block = ShakenBlock(width=ratio, dimension=dimension, stiffness=kn, perArea=perArea, ig2=ig2)
		ours = bisect(lambda a: block.apply(a).stands, 0.9 * theory, 1.05 * theory, (4e-3 if quick else 1e-3) * theory)  # noqa: B023
		yield Measured(f'{dimension}-D, base accelerated, width/height {ratio:g}: uplift at a/g', '-', theory, ours, 0.01 * theory)
		for tilt in (0.05,) if quick else (0.02, 0.05, 0.1):
			block = RockingBlock(dimension=dimension, perArea=perArea, ig2=ig2)
			theory = rockingPeriod(block.width, block.height, tilt)
			yield Measured(f'{dimension}-D, rocking from {tilt:g} rad: period', 's', theory, 4 * block.fall(tilt), 0.01 * theory)


def arch(ig2, perArea, quick):
	"""Least thickness of a masonry arch, and whether a thicker one stays at rest."""
	friction = math.radians(89)
	for dimension, blocks in ((2, 12), (3, 12)) if quick else ((2, 12), (2, 32), (3, 32)):
		theory = leastThickness(blocks, friction)
		options = {'blocks': blocks, 'dimension': dimension, 'stiffness': 1e11 if perArea else 1e9, 'perArea': perArea, 'ig2': ig2}
		falls = bisect(lambda t: not MasonryArch(t, **options).build().stands(), 0.93 * theory, 1.15 * theory, (5e-3 if quick else 2e-3) * theory)  # noqa: B023
		yield Measured(f'{dimension}-D, {blocks} blocks: least thickness over radius', '-', theory, falls, 0.01 * theory)
		still = MasonryArch(0.15, **{**options, 'stiffness': 1e10 if perArea else 1e9}).build()
		still.stands()
		steps = 20000 if quick else 100000
		still.creep(steps)
		yield Measured(f'{dimension}-D, {blocks} blocks: creep in {steps} steps, over the radius', '-', 0.0, still.creep(steps), 1e-9)


def slope(ig2, perArea, quick):
	"""A cube let go on a slope of 45°, friction 25°, rocking undamped."""
	for floor in slopeFloors:
		scene = CubeOnSlope(floor=floor, perArea=perArea, ig2=ig2).build()
		theory = scene.distanceInTheory(0.8)
		ours, aside = scene.slide(0.8)
		yield Measured(f'cube released on {floor}: distance in 0.8 s', 'm', theory, ours, 5e-3 * theory)
		yield Measured(f'cube released on {floor}: drift aside', 'm', 0.0, aside, 2e-3 * theory)


def edges(ig2, perArea, quick):
	"""An edge on a flat floor, and a tilted cube dropped on a frictionless one."""
	for turn in (5, 15, 30):
		found = [edgeNormal(math.radians(turn), overlap, floor, ig2) for overlap in (1e-5, 1e-4, 1e-3) for floor in ('polytope', 'wall', 'box', 'facet')]
		worst = max((angle for angle in found if angle is not None), default=math.nan)
		yield Measured(f'edge of a cube turned by {turn}° on a floor: normal off the vertical', '°', 0.0, math.degrees(worst), 0.1)
	for floor in ('wall', 'facet') if quick else ('wall', 'facet', 'box', 'polytope'):
		yield Measured(f'tilted cube dropped on a frictionless {floor}: sideways speed', 'm/s', 0.0, wallKick(ig2, perArea, floor=floor), 1e-3)


def rolling(ig2, perArea, quick):
	"""A solid that rolls over ten flush plates, against its path on one plate."""
	for faces in (12, 20):
		make = functools.partial(RollingSolid, faces=faces, perArea=perArea, ig2=ig2)
		one, ten = make(plates=1).build().path(1.0), make(plates=10).build().path(1.0)
		finer = make(plates=1, timeStepFraction=make().timeStepFraction / 2).build().path(1.0)
		along = one[-1, 0]
		yield Measured(f'{faces} faces, one plate: change of the path with half the time step', 'm', 0.0, np.abs(finer - one).max(), None)
		yield Measured(f'{faces} faces, ten plates: largest distance from the path on one', 'm', 0.0, np.abs(ten - one).max(), 5e-3 * along)


measures = {'toppling': toppling, 'shaking': shaking, 'arch': arch, 'slope': slope, 'edges': edges, 'rolling': rolling}
"""Name: generator of :yref:`Measured` from (ig2, perArea, quick)."""
