# SPDX-License-Identifier: GPL-2.0-or-later
"""RockJointMat, RockJointPhys and the Mohr-Coulomb law on one contact whose bodies have prescribed motion.

A unit cube (contact area 1 m²) on a floor, pressed in by 1 mm: normal force 1e5 N less a thousandth (flatFace.py), one step of 1 ms. Numbers are compared
with the formulas of the classes' documentation; rounding is all that may differ, unless a line says otherwise.
"""

from math import inf, nan, pi, sqrt

import pytest
from flatFace import faceForce
from scenes import blockOnFloor, contact, driven, joint, law, loop
from yade import (
	Bo1_Sphere_Aabb,
	Ig2_Sphere_Sphere_ScGeom,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	MatchMaker,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
	utils,
)
from yade.math import tan  # with all of YADE's digits, whichever they are
from yade.polytope.precision import real

overlap, stiffness, dt = 1e-3, 1e8, 1e-3
normal, normalPerArea = (stiffness * faceForce(overlap, perArea=perArea) for perArea in (False, True))


def pressed(material={}, velocity=(0, 0, 0), **engines):
	"""The contact after its first step: made, with the block moving at *velocity*."""
	joint(**dict(dict(normalStiffness=stiffness, shearStiffness=stiffness), **material))
	loop(**engines)
	floor, block = blockOnFloor(overlap)
	driven(block)
	O.dt = dt
	O.step()
	block.state.vel = velocity
	return floor, block, contact(floor, block)


# ------------------------------------------------------------------------------------------------ material

bad = [
	('normalStiffness', 0),
	('normalStiffness', -1),
	('normalStiffness', nan),
	('normalStiffness', inf),
	('shearStiffness', 0),
	('shearStiffness', -1e9),
	('shearStiffness', nan),
	('frictionAngle', -0.1),
	('frictionAngle', pi / 2),
	('frictionAngle', 30),
	('frictionAngle', nan),
	('cohesion', -1),
	('cohesion', nan),
	('cohesion', inf),
	('tensileStrength', -1),
	('tensileStrength', nan),
	('residualFrictionAngle', -0.5),
	('residualFrictionAngle', 30),
	('residualFrictionAngle', nan),
	('dilationAngle', -0.1),
	('dilationAngle', 10),
	('dilationAngle', nan),
	('dilationLimit', -1e-3),
	('dilationLimit', nan),
]


@pytest.mark.parametrize('name,value', bad)
def testBadValueIsRefusedAndLeavesTheMaterial(name, value):
	good = dict(
		normalStiffness=2e9,
		shearStiffness=1e9,
		frictionAngle=0.6,
		cohesion=1e5,
		tensileStrength=1e4,
		residualFrictionAngle=0.4,
		dilationAngle=0.1,
		dilationLimit=1e-3,
	)
	material = RockJointMat(**good)
	for change in (
		lambda: setattr(material, name, value),
		lambda: material.updateAttrs({name: value, 'cohesion': 7} if name != 'cohesion' else {name: value}),
	):
		with pytest.raises(ValueError, match=f'^{name}: must be'):
			change()
		assert {key: getattr(material, key) for key in good} == good
	with pytest.raises(ValueError, match=f'^{name}: must be'):
		RockJointMat(**dict(good, **{name: value}))


@pytest.mark.parametrize('density', [0, -1, nan, inf])
def testBadDensityIsRefused(density):
	with pytest.raises(ValueError, match='^density: must be positive and finite'):
		RockJointMat(density=density)


@pytest.mark.parametrize('name', ['normalDamping', 'shearDamping', 'rockingDamping'])
@pytest.mark.parametrize('value', [-0.1, nan, inf])
def testBadDampingIsRefused(name, value):
	functor = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, shearDamping=0.2, rockingDamping=0.1)
	with pytest.raises(ValueError, match=f'^{name}: must be'):
		setattr(functor, name, value)
	assert (functor.normalDamping, functor.shearDamping, functor.rockingDamping) == (0.3, 0.2, 0.1)


def testMaterialIsSavedAndLoaded(tmp_path):
	for archive in ('m.xml', 'm.yade'):
		O.reset()
		joint(cohesion=3.0, residualFrictionAngle=0.2, frictionAngle=0.7)
		O.save(str(tmp_path / archive))
		O.reset()
		O.load(str(tmp_path / archive))
		material = O.materials[0]
		assert (material.cohesion, material.residualFrictionAngle, material.frictionAngle, material.dilationLimit) == (3, 0.2, 0.7, inf)


# ------------------------------------------------------------------------------------------------ physics of two materials


def twoMaterials(first, second, **ip2):
	one, two = joint(**first), joint(**second)
	loop(ip2=ip2)
	O.bodies.append(
		[
			polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True, material=one),
			polytope.cuboid((0, 0, 0.499), (0.5, 0.5, 0.5), fixed=True, material=two),
		]
	)
	O.bodies[1].state.blockedDOFs = 'xyzXYZ'
	O.dt = dt
	O.bodies[1].dynamic = True
	O.step()
	return O.interactions[0, 1].phys


def testEqualMaterialsGiveTheJointItsOwnValues():
	phys = twoMaterials(*[dict(normalStiffness=3e8, shearStiffness=1e8, frictionAngle=0.3)] * 2)
	assert (phys.kn, phys.ks, phys.tangensOfFrictionAngle, phys.intact) == (3e8, 1e8, tan(0.3), False)


def testTwoMaterialsCombine():
	phys = twoMaterials(
		dict(
			normalStiffness=3e8,
			shearStiffness=3e7,
			frictionAngle=0.3,
			cohesion=5,
			tensileStrength=3,
			dilationAngle=0.1,
			residualFrictionAngle=0.25,
		),
		dict(normalStiffness=1e8, shearStiffness=1e7, frictionAngle=0.4, cohesion=4, tensileStrength=6, dilationAngle=0.2, dilationLimit=1),
	)
	assert (phys.kn, phys.ks) == (1.5e8, 1.5e7)
	assert (phys.tangensOfFrictionAngle, phys.tangensOfResidualFrictionAngle) == (tan(0.3), tan(0.25))
	assert (phys.cohesion, phys.tensileStrength, phys.tangensOfDilationAngle, phys.dilationLimit, phys.intact) == (4, 3, tan(0.1), 1, True)


def testMatchMakersReplaceTheRules():
	phys = twoMaterials({}, {}, kn=7e6, ks=5e6, frictAngle=MatchMaker(algo='val', val=0.1))
	assert (phys.kn, phys.ks, phys.tangensOfFrictionAngle) == (7e6, 5e6, tan(0.1))


def testJointsMadeLateStartBroken():
	for until, intact in ((-1, True), (5, True), (1, False)):
		O.reset()
		joint(frictionAngle=0.6, residualFrictionAngle=0.4, cohesion=1e5)
		loop(ip2=dict(intactUntilStep=until))
		floor, block = blockOnFloor(-1.5e-4)  # they meet between two steps
		driven(block, (0, 0, -0.1))
		O.dt = dt
		O.run(4, True)
		phys = contact(floor, block).phys
		assert phys.intact == intact
		assert phys.tangensOfFrictionAngle == tan(0.6 if intact else 0.4)


def testStiffnessPerAreaFollowsTheArea():
	"""A 1 × 1 m block pushed over the floor's edge: k = Pa/m × what is left of the section, in the first step as in any other."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness / 2)
	loop(perArea=True)
	floor, block = blockOnFloor(overlap)
	block.state.pos = (4.7, 0, block.state.pos[2])
	driven(block, (10, 0, 0))
	O.dt = dt
	for step in range(60):
		O.step()
		area = 5 - (4.2 + 10 * dt * step)
		phys = contact(floor, block).phys
		assert phys.contactArea == pytest.approx(area, rel=(overlap / area) ** 2)  # seen along a normal that leans by about this angle
		assert phys.kn == stiffness * phys.contactArea and phys.ks == phys.kn / 2
		assert phys.normalForce.norm() == pytest.approx(phys.kn * contact(floor, block).geom.penetrationDepth, rel=1e-14)


def testStiffnessPerContactIsThatOfAnyArea():
	floor, block, i = pressed()
	O.step()
	assert i.geom.contactArea == pytest.approx(1, rel=1e-9)
	assert i.phys.kn == stiffness


def testEveryRockJointHasItsArea():
	"""Shear acts over it, whatever the stiffness; with the paper's own contact at one point, as there."""
	for model in 'surface', 'boon2012':
		O.reset()
		floor, block, i = pressed(ig2={'contactModel': model})
		O.step()
		assert i.geom.needsArea and i.geom.contactArea == pytest.approx(1, rel=1e-9)
		assert len(i.geom.outline) == (4 if model == 'surface' else 0)
		assert i.phys.twistingStiffness == pytest.approx(i.phys.ks / 6 if model == 'surface' else 0, rel=1e-9)


def testSpheresInTheSameScene():
	"""Contacts without a section get π min(R)², and YADE's own law."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness / 2)
	loop(perArea=True)
	O.engines[1].boundDispatcher.functors = O.engines[1].boundDispatcher.functors + [Bo1_Sphere_Aabb()]
	O.engines[2].geomDispatcher.functors = O.engines[2].geomDispatcher.functors + [Ig2_Sphere_Sphere_ScGeom()]
	O.engines[2].lawDispatcher.functors = O.engines[2].lawDispatcher.functors + [Law2_ScGeom_FrictPhys_CundallStrack()]
	floor, block = blockOnFloor(overlap)
	O.bodies.append([utils.sphere((20, 0, 0), 1), utils.sphere((22.49, 0, 0), 1.5)])
	O.dt = 1e-6
	O.step()
	phys = O.interactions[2, 3].phys
	assert phys.kn == pytest.approx(stiffness * pi, rel=1e-14)
	assert O.forces.f(3)[0] == pytest.approx(phys.kn * 0.01, rel=1e-9)
	assert O.forces.f(block.id)[2] == pytest.approx(normalPerArea, rel=1e-9)


# ------------------------------------------------------------------------------------------------ law: shear


def testShearForceGrowsByStiffnessThenCoulombLimitsIt():
	floor, block, i = pressed(dict(frictionAngle=0.5, shearStiffness=4e7), velocity=(0.05, 0, 0))
	limit = normal * tan(0.5)
	for step in range(1, 60):
		O.step()
		moved = 0.05 * dt * step
		expected = min(4e7 * moved, limit)
		assert i.phys.shearForce[0] == pytest.approx(-expected, rel=1e-9)
		assert O.forces.f(floor.id)[0] == pytest.approx(expected, rel=1e-9)
		assert i.phys.isSliding == (4e7 * moved > limit * (1 + 1e-9))
	assert i.phys.slip[0] == pytest.approx(moved - limit / 4e7, rel=1e-9)
	assert law().ratioSlidingContacts() == 1


def testFrictionChangedDuringTheRunActsAtOnce():
	floor, block, i = pressed(dict(frictionAngle=0.5), velocity=(0.1, 0, 0))
	O.run(50, True)
	for angle in (0.3, 0.1, 0.4):
		i.phys.tangensOfFrictionAngle = tan(angle)
		O.run(1 if angle < 0.4 else 20, True)
		assert i.phys.shearForce.norm() == pytest.approx(normal * tan(angle), rel=1e-9)


@pytest.mark.parametrize('axis', [(0, 1, 0), (0, 0, 1), (1, 2, 3)])
def testShearForceTurnsWithTheBodies(axis):
	"""Both bodies turned by 90° together: force and torque turn with them. The rotation is first order in each step, so the error of
	the direction falls with the step; the force's length is kept by construction."""
	errors = []
	for steps in (100, 400):
		O.reset()
		floor, block, i = pressed(velocity=(0.02, 0.01, 0))
		O.run(10, True)
		block.state.vel = (0, 0, 0)
		O.step()
		before, arm = Vector3(i.phys.shearForce), Vector3(block.state.pos)  # copies: YADE returns references
		angle = pi / 2 / steps
		spin = Vector3(*axis).normalized() * angle / dt
		for step in range(1, steps + 1):
			turn = Quaternion(spin.normalized(), angle * step)
			for body, start in ((floor, Vector3(0, 0, -1)), (block, arm)):
				body.state.pos, body.state.ori = turn * start, turn
				body.state.vel, body.state.angVel = spin.cross(turn * start), spin
			O.step()
		assert (i.geom.normal - turn * Vector3(0, 0, 1)).norm() < 1e-9
		assert abs(i.phys.shearForce.dot(i.geom.normal)) < 1e-12 * before.norm()
		errors.append((i.phys.shearForce - turn * before).norm() / before.norm())
	print('error of the turned shear force:', errors)
	assert errors[0] < 2e-2 and errors[1] < errors[0] / 3.5


# ------------------------------------------------------------------------------------------------ law: strength


def testCohesionAndResidualFriction():
	"""Peak cA + N tan φ, then N tan φ_r from the failing step on."""
	cohesion = 4e4
	floor, block, i = pressed(dict(frictionAngle=0.5, cohesion=cohesion, residualFrictionAngle=0.3), velocity=(0.1, 0, 0), perArea=True)
	peak = normalPerArea * tan(0.5) + cohesion
	largest = 0
	for step in range(1, 30):
		O.step()
		trial = stiffness * 0.1 * dt * step
		force = i.phys.shearForce.norm()
		if trial < peak * (1 - 1e-9):
			assert i.phys.intact and force == pytest.approx(trial, rel=1e-9)
			largest = force
		else:
			assert not i.phys.intact and force == pytest.approx(normalPerArea * tan(0.3), rel=1e-9)
	assert peak - stiffness * 0.1 * dt < largest <= peak
	block.state.vel = (-0.1, 0, 0)
	O.run(20, True)
	assert i.phys.shearForce[0] == pytest.approx(normalPerArea * tan(0.3), rel=1e-9)  # and this is permanent


def testCohesionIsTimesTheAreaPerContactToo():
	floor, block, i = pressed(dict(frictionAngle=0.0, cohesion=4e4), velocity=(0.01, 0, 0))
	O.run(39, True)
	assert i.phys.intact and i.phys.shearForce.norm() == pytest.approx(3.9e4, rel=1e-9)
	O.run(2, True)
	assert not i.phys.intact and i.phys.shearForce.norm() == 0


@pytest.mark.parametrize('perArea', [True, False])
def testTensionBreaksAndDoesNotHeal(perArea):
	tensile = 5.1e4  # between the forces of two steps
	floor, block, i = pressed(dict(tensileStrength=tensile, cohesion=1e5), velocity=(0, 0, 0.02), perArea=perArea)
	for step in range(1, 120):
		O.step()
		depth = overlap - 0.02 * dt * (step - 1)  # the loop runs before the bodies move
		expected = stiffness * (faceForce(depth) if depth > 1e-12 and not perArea else depth)
		if expected > -tensile * (1 - 1e-9):
			assert i.phys.intact and i.phys.normalForce[2] == pytest.approx(expected, rel=1e-9, abs=1e-6)
			assert O.forces.f(block.id)[2] == i.phys.normalForce[2]
		else:
			assert i.isReal and not i.phys.intact and i.phys.normalForce.norm() == 0
	block.state.vel = (0, 0, -0.02)
	O.run(100, True)
	assert i.phys.normalForce[2] == pytest.approx(stiffness * i.geom.penetrationDepth, rel=1e-9) and i.phys.normalForce[2] > 0
	block.state.vel = (0.1, 0, 0)
	O.run(50, True)
	assert i.phys.shearForce.norm() == pytest.approx(i.phys.normalForce.norm() * tan(0.5), rel=1e-9)  # no cohesion left
	block.state.vel = (0, 0, 0.02)
	O.run(110, True)
	assert i.phys.normalForce.norm() == 0


@pytest.mark.parametrize('model', ['surface', 'boon2012'])
@pytest.mark.parametrize('strength', ['tensileStrength', 'cohesion'])
def testStrengthPerContactIsTimesThePresentArea(strength, model):
	floor, block, i = pressed({strength: 4e4}, ig2={'contactModel': model})
	block.state.pos += Vector3(4.75, 0, 0)  # over the floor's end
	O.step()
	assert i.phys.contactArea == pytest.approx(0.75, rel=1e-9) and i.phys.intact


def testAJointThatIsPulledOpenKeepsASmallShearForce():
	"""Two thousandths of a newton, far above what rounding leaves."""
	floor, block, i = pressed(dict(tensileStrength=1e6, cohesion=1e6))
	block.state.pos += Vector3(1e-3 / stiffness, 0, 2 * overlap)
	block.state.vel = Vector3(1e-3 / stiffness / dt, 0, 0)
	O.step()
	O.step()
	assert i.phys.normalForce[2] < 0 and i.phys.shearForce.norm() == pytest.approx(2e-3, rel=1e-6)


def testOpenJointKeepsTheAreaOfItsLastTouch():
	"""It does so also where rounding decides whether the bodies touch; the section of bodies apart is that of bodies grown."""
	floor, block, i = pressed(dict(tensileStrength=1e6, cohesion=1e5), perArea=True)
	touching = float(i.phys.contactArea)
	assert touching == pytest.approx(1, rel=1e-12)
	for gap in (0, -8 * 2 ** (1 - polytope.buildInfo()['bits']), 1e-5):
		block.state.pos = (0, 0, 0.5 + real(gap))
		O.step()
		assert i.geom.status == 'separated' and i.geom.contactArea > touching + 1e-7
		assert float(i.phys.contactArea) == touching


@pytest.mark.parametrize('gap', [0, 1e-6])
def testBlocksCutFaceToFaceCanBeBondedBeforeTheyOverlap(gap):
	"""utils.createInteraction makes the joint of blocks that just touch; it has its area and its tension from the start."""
	joint(tensileStrength=1e6, normalStiffness=stiffness)
	loop(perArea=True)
	floor, block = blockOnFloor(-gap)
	driven(block)
	O.dt = dt
	O.step()
	assert O.interactions.countReal() == 0
	i = utils.createInteraction(0, 1)
	assert i.phys.intact and i.phys.kn == pytest.approx(stiffness, rel=1e-5)
	block.state.vel = (0, 0, 1e-3)
	O.run(11, True)
	assert i.phys.normalForce[2] == pytest.approx(-stiffness * (gap + 1e-5), rel=1e-5)


def testJointWithoutStrengthEndsWhenItOpens():
	floor, block, i = pressed(velocity=(0, 0, 0.1))
	O.run(9, True)
	assert i.isReal
	O.run(3, True)
	assert not i.isReal


def testBrokenJointIsForgottenFarAway():
	floor, block, i = pressed(dict(tensileStrength=1), velocity=(0, 0, 10))
	O.run(20, True)
	assert i.isReal
	O.run(100, True)
	assert not i.isReal


def testTensionInShearFailure():
	"""A joint that fails in shear while it is pulled loses its tension with its cohesion."""
	floor, block, i = pressed(dict(tensileStrength=1e6, cohesion=1e4, frictionAngle=0.4), velocity=(0, 0, 0.1))
	O.run(10, True)
	block.state.vel = (0, 0, 0)
	O.step()
	block.state.pos += Vector3(0, 0, 1e-4)
	O.step()
	assert i.phys.intact and i.phys.normalForce[2] == pytest.approx(-1e4, rel=1e-9)
	strength = 1e4 + i.phys.normalForce[2] * tan(0.4)
	assert strength > 0
	block.state.vel = (0.01, 0, 0)
	while i.phys.intact and O.iter < 100:
		force = i.phys.shearForce.norm()
		O.step()
	assert strength - 2 * stiffness * 0.01 * dt < force <= strength
	assert i.phys.shearForce.norm() == i.phys.normalForce.norm() == 0


# ------------------------------------------------------------------------------------------------ law: dilation


def testDilationWidensTheJointBySlip():
	psi, limit = 0.1, 5e-5
	floor, block, i = pressed(dict(frictionAngle=0.5, dilationAngle=psi, dilationLimit=limit), velocity=(0.01, 0, 0))
	slip = 0
	for _ in range(300):
		O.step()
		opening = min(slip * tan(psi), limit)  # slip up to the last step
		assert i.phys.dilation == pytest.approx(opening, rel=1e-12)
		assert i.phys.normalForce[2] == pytest.approx(stiffness * faceForce(overlap + opening), rel=1e-12)
		if i.phys.isSliding:
			assert i.phys.shearForce.norm() == pytest.approx(i.phys.normalForce.norm() * tan(0.5), rel=1e-12)
		slip = i.phys.slip.norm()
	assert i.phys.dilation == limit and slip > 1e-3
	block.state.vel = (-0.01, 0, 0)
	while i.phys.slip[0] > limit / tan(psi) / 2:
		O.step()
	O.step()
	assert i.phys.dilation < limit / 2  # slipping back closes it


# ------------------------------------------------------------------------------------------------ law: damping


def testNormalDampingIsAFractionOfCritical():
	floor, block, i = pressed(velocity=(0, 0, -0.01), normalDamping=0.3)
	block.state.blockedDOFs = 'xyXYZ'  # the floor cannot move: effective mass is the block's
	O.forces.setPermF(block.id, Vector3(0, 0, 0))
	velocity = block.state.vel[2]
	O.step()
	expected = -2 * 0.3 * sqrt(block.state.mass * stiffness) * velocity
	assert i.phys.normalViscous[2] == pytest.approx(expected, rel=1e-12)
	assert i.phys.normalForce[2] == pytest.approx(stiffness * i.geom.penetrationDepth + expected, rel=1e-12)


def testBodiesThatCannotMoveAreNotDamped():
	floor, block, i = pressed(velocity=(0, 0, -0.01), normalDamping=0.3, shearDamping=0.3, rockingDamping=0.3)
	O.step()
	assert i.phys.normalViscous.norm() == i.phys.shearViscous.norm() == i.phys.rockingMoment.norm() == 0


def testNoViscousAttractionWithoutTension():
	for tensile in (0, 1e9):
		O.reset()
		floor, block, i = pressed(dict(tensileStrength=tensile), velocity=(0, 0, 0.9), normalDamping=1)
		block.state.blockedDOFs = 'xyXYZ'
		O.step()
		viscous = -2 * sqrt(block.state.mass * stiffness) * 0.9
		expected = stiffness * i.geom.penetrationDepth + viscous
		assert expected < 0
		assert i.phys.normalForce[2] == (pytest.approx(expected, rel=1e-12) if tensile else 0)


def testCoulombHoldsForElasticAndViscousShearTogether():
	seen = set()
	for speed in (0.001, 0.03, 0.08):
		O.reset()
		floor, block, i = pressed(dict(frictionAngle=0.5), shearDamping=1.0)
		block.state.blockedDOFs = 'yzXYZ'
		block.state.vel = (speed, 0, 0)
		O.step()
		viscous = 2 * sqrt(block.state.mass * stiffness) * speed
		elastic = stiffness * speed * dt
		limit = normal * tan(0.5)
		assert i.phys.shearForce[0] == pytest.approx(-min(elastic + viscous, limit), rel=1e-9)
		assert i.phys.shearViscous[0] == pytest.approx(-min(viscous, limit - elastic), rel=1e-9)
		seen.add(elastic + viscous < limit)
	assert seen == {True, False}


def testRockingDamperIsSpreadOverTheArea():
	floor, block, i = pressed(rockingDamping=0.5)
	block.state.blockedDOFs = 'xyzYZ'
	block.state.angVel = (1e-3, 0, 0)
	O.step()
	expected = -2 * 0.5 * sqrt(block.state.mass * stiffness) / 12 * 1e-3
	assert i.phys.rockingMoment[0] == pytest.approx(expected, rel=1e-3)  # the normal has turned a little
	arm = i.geom.contactPoint - block.state.pos
	assert (
		O.forces.t(block.id) - i.phys.rockingMoment - arm.cross(i.phys.normalForce + i.phys.shearForce)
	).norm() < 1e-2  # the block has moved since
	block.state.angVel = (10, 0, 0)
	O.step()
	assert i.phys.rockingMoment.norm() <= i.phys.normalForce.norm() * sqrt(i.geom.contactArea) / 2 * (1 + 1e-12)


def testPolygonsRockOnALength():
	"""2-D: the radius of gyration is of the contact's length, the area its length times the thickness."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness)
	loop(perArea=True, rockingDamping=0.5)
	O.bodies.append(polytope.polygon([(-2, -1), (2, -1), (2, 0), (-2, 0)], thickness=0.3, fixed=True))
	O.bodies.append(polytope.polygon([(-0.5, -overlap), (0.5, -overlap), (0.5, 0.5), (-0.5, 0.5)], thickness=0.3))
	block = O.bodies[1]
	O.dt = 1e-6
	O.step()
	phys = O.interactions[0, 1].phys
	assert phys.contactArea == pytest.approx(0.3, rel=1e-9) and phys.kn == pytest.approx(0.3 * stiffness, rel=1e-9)
	block.state.angVel = (0, 0, 1e-3)
	O.step()
	assert phys.rockingMoment[2] == pytest.approx(-2 * 0.5 * sqrt(block.state.mass * phys.kn) / 12 * 1e-3, rel=1e-6)


# ------------------------------------------------------------------------------------------------ nothing breaks the loop


def testNonsenseFromAScriptIsLeftOutAndCounted():
	floor, block, i = pressed()
	i.phys.kn = nan
	O.step()
	assert O.forces.f(block.id).norm() == 0
	assert law().nonFiniteForces() == 1
	i.phys.kn = stiffness
	O.step()
	assert O.forces.f(block.id)[2] == pytest.approx(normal, rel=1e-9)
