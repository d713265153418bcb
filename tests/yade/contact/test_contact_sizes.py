# SPDX-License-Identifier: GPL-2.0-or-later
"""Sizes that YADE's own physics take their stiffness from: the same wherever a contact is, in pairs and in scenes with closed forms."""

from math import sqrt

import pytest
from scenes import driven, gravity, joint
from yade import (
	FrictMat,
	Ip2_FrictMat_FrictMat_MindlinPhys,
	Law2_ScGeom_MindlinPhys_Mindlin,
	O,
	Vector3,
	_polytope,
	polytope,
	utils,
)

half, young, poisson, density = 0.1, 1e8, 0.3, 2600.0


def frict():
	O.materials.append(FrictMat(density=density, young=young, poisson=poisson, frictionAngle=0.5))


def plate(half, at=(0, 0), fixed=True):
	return polytope.cuboid((*at, -half[2]), half, fixed=fixed)


def fixedClump(parts):
	O.bodies[polytope.clump(parts)[0]].state.blockedDOFs = 'xyzXYZ'
	return []


supports = {
	'wall': lambda: [utils.wall(0, axis=2, sense=1)],
	'box': lambda: [utils.box((0, 0, -0.5), (2, 2, 0.5), fixed=True)],
	'facet': lambda: [utils.facet([(-2, -2, 0), (2, -2, 0), (0, 2, 0)], fixed=True)],
	'thick plate': lambda: [plate((1, 1, 0.5))],
	'thin plate': lambda: [plate((1, 1, 0.002))],
	'small piece': lambda: [plate((0.15, 0.15, 0.02))],
	'clump of pieces': lambda: fixedClump([plate((0.15, 0.3, 0.02), (x, 0), fixed=False) for x in (-0.15, 0.15)]),
}
places = [(0, 0), (0.04, 0.01), (0.06, -0.05)]


def pressed(support, place, depth=1e-4, **engines):
	"""The contacts of a cube that is pressed on a support by this depth."""
	O.reset()
	frict()
	O.bodies.append(supports[support]())
	cube = O.bodies[O.bodies.append(polytope.cuboid((*place, half - depth), (half, half, half)))]
	O.engines = polytope.engines(gravity=(0, 0, 0), timeStepper=False, **engines)
	O.dt = 1e-9
	O.step()
	return cube, [one for one in cube.intrs() if one.isReal]


@pytest.mark.parametrize('support', supports)
def testStiffnessIsThatOfTheCubeWhereverItLies(support):
	"""E times the cube's half edge, as on a plane; the support has no size."""
	for place in places:
		for contact in pressed(support, place)[1]:
			assert contact.phys.kn == pytest.approx(young * half, rel=1e-12), place
			assert contact.phys.ks == pytest.approx(poisson * young * half, rel=1e-12)
			assert (contact.geom.refR1, contact.geom.refR2) == pytest.approx((half, half), rel=1e-12)


@pytest.mark.parametrize('support', ['wall', 'facet', 'thin plate'])
def testMindlinsStiffnessToo(support):
	for place in places:
		(contact,) = pressed(support, place, physics=Ip2_FrictMat_FrictMat_MindlinPhys(), law=Law2_ScGeom_MindlinPhys_Mindlin())[1]
		assert contact.phys.kno == pytest.approx(4 / 3 * young / (2 * (1 - poisson**2)) * sqrt(half / 2), rel=1e-12)


@pytest.mark.parametrize('place', [(0, 0), (0.3, 0.3), (0.4, 0)])
def testOfTwoFreeBodiesEachHasTheSizeOfItsVolume(place):
	frict()
	O.bodies.append([plate((0.5, 0.5, 0.004), fixed=False), polytope.cuboid((*place, half - 1e-4), (half, half, half))])
	O.engines = polytope.engines(gravity=(0, 0, 0), timeStepper=False)
	O.dt = 1e-9
	O.step()
	size = (0.5 * 0.5 * 0.004) ** (1 / 3)
	(contact,) = [one for one in O.interactions if one.isReal]
	assert (contact.geom.refR1, contact.geom.refR2) == pytest.approx((size, half), rel=1e-12)
	assert contact.phys.kn == pytest.approx(2 * young * size * half / (size + half), rel=1e-12)


def touching(*bodies):
	frict()
	O.bodies.append(bodies)
	O.engines = polytope.engines(gravity=(0, 0, 0), timeStepper=False)
	O.dt = 1e-9
	O.step()
	geom = O.interactions[0, 1].geom
	return geom.refR1, geom.refR2


def testAPolygonHasThatOfItsAreaWhateverItsThickness():
	def box(low, high):
		return polytope.polygon([(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])], thickness=3)

	assert touching(box((-1, -0.1), (1, 0)), box((0, -1e-4), (0.3, 0.2))) == pytest.approx(
		(sqrt(2 * 0.1) / 2, sqrt(0.3 * 0.2001) / 2), rel=1e-9
	)


def testASphereHasItsRadius():
	assert touching(utils.sphere((0, 0, 0), 0.05), polytope.cuboid((0, 0, 0.1499), (half, half, half))) == pytest.approx(
		(0.05, half), rel=1e-12
	)


@pytest.mark.parametrize('support', supports)
def testACubeComesToRestOnIt(support):
	"""Set down 0.1 mm above it, under defaults: it sinks by its weight over the stiffness of all contacts, which pieces of one support
	share, and never by more than a hundredth of its size."""
	frict()
	O.bodies.append(supports[support]())
	cube = O.bodies[O.bodies.append(polytope.cuboid((0, 0, half + 1e-4), (half, half, half)))]
	O.engines = polytope.engines(damping=0.3)
	lowest = half
	while O.time < 0.5:
		O.run(50, wait=True)
		lowest = min(lowest, cube.state.pos[2])
	contacts = [one for one in cube.intrs() if one.isReal]
	assert half - lowest < 0.01 * half
	assert half - cube.state.pos[2] == pytest.approx(
		cube.state.mass * gravity / (sum(one.geom.share for one in contacts) * young * half), rel=1e-2
	)
	assert polytope.check(O) == []


def testAHeapRestsOnAFacetAsOnAPlate():
	"""Nine grains with their centres about that of a facet, where distances to it vanish, and with one on top of another."""
	depths = []
	for support in ('facet', 'thick plate'):
		O.reset()
		frict()
		O.bodies.append(supports[support]())
		grains = [
			O.bodies.append(polytope.cuboid((0.05 * i, 0.05 * j - 0.02, 0.0201), (0.02, 0.02, 0.02)))
			for i in (-1, 0, 1)
			for j in (-1, 0, 1)
		]
		grains.append(O.bodies.append(polytope.cuboid((0, -0.02, 0.0602), (0.02, 0.02, 0.02))))
		O.engines = polytope.engines(damping=0.3)
		while O.time < 0.3:
			O.run(50, wait=True)
		depths.append([O.bodies[k].state.pos[2] for k in grains])
	assert depths[0] == pytest.approx(depths[1], abs=1e-9)
	assert min(depths[0]) > 0.0199


def testAJointOnAWallForgetsNoFailure():
	"""It lies where the wall says that it is; failed in shear, lifted off and set down again it has no cohesion any more."""
	joint(cohesion=1e6, tensileStrength=0)
	O.bodies.append(utils.wall(0, axis=2, sense=1))
	block = O.bodies[O.bodies.append(polytope.cuboid((0, 0, half - 1e-4), (half, half, half)))]
	O.engines = polytope.engines(gravity=(0, 0, 0), timeStepper=False)
	O.dt = 1e-4
	driven(block)
	O.step()
	contact = O.interactions[0, 1]
	assert contact.phys.intact
	for velocity, steps in (((20, 0, 0), 20), ((-20, 0, 0), 20), ((0, 0, 5), 10), ((0, 0, -5), 10)):
		block.state.vel = velocity
		O.run(steps, wait=True)
		assert O.interactions[0, 1].isReal and not O.interactions[0, 1].phys.intact, velocity
	block.state.vel = Vector3(0, 0, 5)
	O.run(int(2.1 * half / 5 / O.dt), wait=True)
	assert not (O.interactions.has(0, 1) and O.interactions[0, 1].isReal)  # as far away as the block is large: forgotten


@pytest.mark.parametrize('support', ['wall', 'thin plate', 'facet'])
def testTheTimeStepBeforeTheContactIsThatOfItsStiffness(support):
	"""The time step is that of a contact at the cube's corner: κ = k (1/m + (3/4 L²)/(m L²/6)), with the largest of normal and shear stiffness."""
	frict()
	O.bodies.append(supports[support]())
	cube = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 3), (half, half, half)))]
	O.engines = polytope.engines()
	kappa = 5.5 * young * half / cube.state.mass
	assert _polytope.timeStepLimits()['material'] == pytest.approx(1 / sqrt(kappa), rel=0.011)
	assert _polytope.timeStepLimits()['material'] <= 1 / sqrt(kappa)
