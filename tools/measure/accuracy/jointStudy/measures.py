# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of rigid blocks with a closed form, measured with one choice of contact at a time: the results of `./run accuracy --only
joints`."""

import dataclasses
import functools
import math

import numpy as np
from yade import O

from .scenes.arch import MasonryArch
from .scenes.blockOnBase import RockingBlock, ShakenBlock, TiltedBlock
from .scenes.facetGrains import EnergyBook, FacetDrum, FacetFunnel
from .scenes.releasedCube import CubeOnSlope, edgeNormal, slopeFloors, wallKick
from .scenes.rollingSolid import RollingSolid
from .theory.arch import leastThickness
from .theory.elasticArch import leastElasticThickness
from .theory.rocking import rockingPeriod
from .theory.toppling import criticalTilt, elasticToppling

__all__ = ['Measured', 'bisect', 'discharge', 'measures']

density, gravity = 2600.0, 9.81

archStiffness = {False: 4e10, True: 1e12}
"""[N/m], where hinges of the arch lie inside its edges by less than a hundredth of its thickness; [Pa/m], where that is two hundredths."""


@dataclasses.dataclass
class Measured:
	"""One quantity of one scene."""

	quantity: str
	unit: str
	theory: float
	ours: float
	allowed: float
	"""Largest difference that the default contact may have to theory; None: only reported."""

	@property
	def good(self):
		return self.allowed is None or abs(self.ours - self.theory) <= self.allowed


def bisect(stands, low, high, accuracy):
	"""Load between those at which *stands(load)* is true and false; where it does not change in between, the end it lies beyond."""
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
			block = TiltedBlock(
				width=ratio, dimension=dimension, frictionAngle=math.radians(friction), stiffness=kn, perArea=perArea, ig2=ig2
			)
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
	"""Least thickness of a masonry arch, by limit analysis or, per area, with elastic joints; and whether a thicker one stays at rest."""
	friction = math.radians(89)
	# where joints are elastic, there is a theory for few blocks
	for dimension, blocks in ((2, 8), (3, 8)) if quick or perArea else ((2, 8), (2, 32), (3, 32)):
		theory = _elasticThickness(blocks, archStiffness[True]) if perArea else leastThickness(blocks, friction)
		options = {'blocks': blocks, 'dimension': dimension, 'perArea': perArea, 'ig2': ig2}
		kn = archStiffness[perArea]
		falls = bisect(
			lambda t: not MasonryArch(t, stiffness=kn, **options).build().stands(),  # noqa: B023
			0.95 * theory,
			1.1 * theory,
			(5e-3 if quick else 2e-3) * theory,
		)
		yield Measured(f'{dimension}-D, {blocks} blocks: least thickness over radius', '-', theory, falls, 0.01 * theory)
		still = MasonryArch(0.15, stiffness=1e9 / (0.15 if perArea else 1), **options).build()
		still.settle()
		steps = 20000 if quick else 100000
		still.creep(steps)
		yield Measured(f'{dimension}-D, {blocks} blocks: creep in {steps} steps, over the radius', '-', 0.0, still.creep(steps), 1e-9)


@functools.cache
def _elasticThickness(blocks, stiffness):
	return leastElasticThickness(blocks, stiffness / (MasonryArch.density * MasonryArch.gravity))


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
		found = [
			edgeNormal(math.radians(turn), overlap, floor, ig2)
			for overlap in (1e-5, 1e-4, 1e-3)
			for floor in ('polytope', 'wall', 'box', 'facet')
		]
		worst = max((angle for angle in found if angle is not None), default=math.nan)
		yield Measured(f'edge of a cube turned by {turn}° on a floor: normal off the vertical', '°', 0.0, math.degrees(worst), 0.1)
	for floor in ('wall', 'facet') if quick else ('wall', 'facet', 'box', 'polytope'):
		yield Measured(
			f'tilted cube dropped on a frictionless {floor}: sideways speed', 'm/s', 0.0, wallKick(ig2, perArea, floor=floor), 1e-3
		)


def rolling(ig2, perArea, quick):
	"""A solid that rolls over ten flush plates, against its path on one plate.

	Rolling from edge to edge multiplies small differences: after a second the path on one plate is known no better than what half the
	time step changes in it."""
	for faces in (12, 20):
		make = functools.partial(RollingSolid, faces=faces, perArea=perArea, ig2=ig2)
		one, ten = make(plates=1).build().path(1.0), make(plates=10).build().path(1.0)
		finer = make(plates=1, timeStepFraction=make().timeStepFraction / 2).build().path(1.0)
		half, whole = len(one) // 2, len(one)
		yield Measured(
			f'{faces} faces, one plate, 1 s: change of the path with half the time step', 'm', 0.0, np.abs(finer - one).max(), None
		)
		for steps, time, unsure in ((half, 0.5, 0.0), (whole, 1.0, 2 * np.abs(finer - one).max())):
			off = np.abs(ten - one)[:steps].max()
			yield Measured(
				f'{faces} faces, ten plates, {time:g} s: farthest from the path on one', 'm', 0.0, off, 5e-3 * one[steps - 1, 0] + unsure
			)


def containers(ig2, perArea, quick):
	"""Energy budget of grains in a turning drum and in a funnel of facets; discharge of the funnel."""
	drum = FacetDrum(number=16 if quick else 60, segments=16, perArea=perArea, ig2=ig2).build().turn(1.0 if quick else 3.0)
	yield from _budget('drum', drum.book.read(drum.driveWork))
	yield Measured('drum: grains outside', '-', 0, drum.outside, 0)
	funnel = FacetFunnel(number=30 if quick else 100, outlet=0.12, width=0.25, gated=False, perArea=perArea, ig2=ig2).build()
	book = EnergyBook(funnel.ids, gravity)
	while funnel.below < funnel.number / 2 and O.time < 2:
		O.step()
	yield from _budget('funnel', book.read())
	funnel = (
		FacetFunnel(number=60, outlet=0.12, width=0.25, perArea=perArea, ig2=ig2)
		if quick
		else FacetFunnel(number=500, perArea=perArea, ig2=ig2)
	)
	outside, hanging = discharge(funnel, 3.0 if quick else 6.0)
	yield Measured(f'funnel, {funnel.number} grains: outside the wall', '-', 0, outside, 0)
	yield Measured(f'funnel, {funnel.number} grains: left at rest on the slope', '-', 0, hanging, 0)


def _budget(name, book):
	work = book['gravity'] + book['drive']
	yield Measured(f'{name}: energy that contacts made, over the work of gravity and drive', '-', 0.0, -book['missing'] / work, 0.01)
	# the law's energy terms against heights, velocities and momenta
	yield Measured(f"{name}: the same by the law's own energy terms", '-', -book['missing'] / work, -book['nonconservative'] / work, 0.005)


def discharge(funnel, most, filling=0.7):
	"""Fills the funnel, opens it, waits until it is empty. Returns (most grains outside at any time, grains at rest above the outlet)."""
	funnel.build()
	outside = _run(funnel, filling)
	funnel.open()
	begun = O.time
	while O.time - begun < most and funnel.below < funnel.number:
		outside = max(outside, _run(funnel, 0.05))
	return outside, funnel.hanging()


def _run(funnel, time):
	end = O.time + time
	while O.time < end:
		O.step()
	return funnel.outside


measures = {
	'toppling': toppling,
	'shaking': shaking,
	'arch': arch,
	'slope': slope,
	'edges': edges,
	'rolling': rolling,
	'containers': containers,
}
"""Name: generator of :yref:`Measured` from (ig2, perArea, quick)."""
