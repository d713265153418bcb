# SPDX-License-Identifier: GPL-2.0-or-later
"""RockJointMat.stiffnessPerArea: the unit of a stiffness belongs to its material, and the geometry follows it."""

import pytest
from yade import FrictMat, Ip2_RockJointMat_RockJointMat_RockJointPhys, O, RockJointMat, polytope

perContact, area = 3e8, 4.0


def rock(**attributes):
	values = dict(density=2600, normalStiffness=perContact, shearStiffness=perContact, frictionAngle=0.5)
	return RockJointMat(**(values | attributes))


def blockOnFloor(floor, block, physics=None, gap=-1e-4):
	"""A cube of 2 m on a slab; materials by the order in which they are given."""
	O.materials.append([floor, block] if block is not floor else floor)
	O.bodies.append(polytope.cuboid((0, 0, -1), (4, 4, 1), fixed=True, material=floor))
	O.bodies.append(polytope.cuboid((0, 0, 1 + gap), (1, 1, 1), material=block))
	O.engines = polytope.engines(physics=physics or Ip2_RockJointMat_RockJointMat_RockJointPhys(), gravity=(0, 0, -9.81), damping=0.2)


def heightAfter(steps):
	O.run(steps, wait=True)
	return float(O.bodies[1].state.pos[2])


@pytest.mark.parametrize('gap', [-1e-4, 1e-3])
def testTheMaterialSaysWhatTheFunctorSaid(gap):
	"""Both are the same to the last bit, the time step before contact included."""
	blockOnFloor(rock(), rock(), Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False), gap)
	before = heightAfter(1), float(O.dt)
	byFunctor = before, heightAfter(400)
	O.reset()
	blockOnFloor(rock(stiffnessPerArea=False), rock(stiffnessPerArea=False), gap=gap)
	before = heightAfter(1), float(O.dt)
	assert (before, heightAfter(400)) == byFunctor
	contact = O.interactions[0, 1]
	assert contact.phys.kn == perContact and contact.phys.normalStiffness == 0


def testEachScalesAsItsUnitSays():
	weight = 2600 * 8 * 9.81
	for isPerArea, stiffness in ((True, perContact * area), (False, perContact)):
		O.reset()
		joint = rock(stiffnessPerArea=isPerArea)
		blockOnFloor(joint, joint)
		polytope.settle()
		assert 1 - heightAfter(1) == pytest.approx(weight / stiffness, rel=1e-3)


@pytest.mark.parametrize('order', [(True, False), (False, True)])
def testInDifferentUnitsThatPerContactHolds(order):
	one, other = (rock(stiffnessPerArea=isPerArea, normalStiffness=perContact * (1 if isPerArea else 2)) for isPerArea in order)
	with pytest.warns(UserWarning, match='units: stiffnesses of RockJointMat'):
		blockOnFloor(one, other)
	O.step()
	assert O.interactions[0, 1].phys.kn == 2 * perContact
	assert O.interactions[0, 1].phys.normalStiffness == 0


def testAContactWithoutAScene():
	"""polytope.contact goes by the materials: the depth of a spring differs from that of a foundation."""
	depths = {}
	for isPerArea in (True, False):
		O.reset()
		O.materials.append(rock(stiffnessPerArea=isPerArea))
		lower = polytope.cuboid((0, 0, -1), (1, 1, 1))
		upper = polytope.cuboid((1.95, 1.9, 0.8), (1, 1, 1))
		depths[isPerArea] = float(polytope.contact(lower, upper).depth)
		O.bodies.append([lower, upper])
		O.engines = polytope.engines(gravity=(0, 0, 0))
		O.step()
		assert float(O.interactions[0, 1].geom.penetrationDepth) == pytest.approx(depths[isPerArea], rel=1e-9)
	assert depths[True] != pytest.approx(depths[False], rel=1e-2)


def testABondIsPerArea():
	joint = rock(stiffnessPerArea=False)
	blockOnFloor(joint, joint, gap=0)
	with pytest.raises(ValueError, match=r'normalStiffness: must be given per area \[Pa/m\]'):
		polytope.bond()
	assert not polytope.bonds() or not polytope.bonds().bonds
	polytope.bond(normalStiffness=1e9, shearStiffness=1e9)
	assert len(polytope.bonds().bonds) == 1


def testOfOneUnitNothingIsFound():
	joint = rock(stiffnessPerArea=False)
	blockOnFloor(joint, joint)
	assert not [found for found in polytope.check(O) if found.what == 'units']
	O.materials.append(FrictMat(density=2600))
	assert not [found for found in polytope.check(O) if found.what == 'units']
