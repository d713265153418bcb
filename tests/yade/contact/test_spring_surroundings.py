# SPDX-License-Identifier: GPL-2.0-or-later
"""contactModel='spring' with YADE's own laws, shapes, periodic cells, polygons, and the time step it needs."""

import itertools
from math import sqrt

import pytest
from scenes import blockOnFloor, bounds, contact, density, driven, gravity, joint, loop, supports
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	FrictMat,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_FrictMat_FrictMat_MindlinPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Ip2_ViscElMat_ViscElMat_ViscElPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	Law2_ScGeom_MindlinPhys_Mindlin,
	Law2_ScGeom_ViscElPhys_Basic,
	MatchMaker,
	NewtonIntegrator,
	O,
	Quaternion,
	RockJointMat,
	ViscElMat,
	polytope,
)
from yade.utils import kineticEnergy

spring = {'contactModel': 'spring'}
stiffness = 1e7


def engines(physics, law, damping=0.0, weight=gravity, **functor):
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0),
		InteractionLoop([Ig2_Polytope_Polytope_PolytopeGeom(**spring, **functor)], [physics], [law]),
		NewtonIntegrator(gravity=(0, 0, -weight), damping=damping),
	]


def rockJoint(**options):
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5)
	return Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False), Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()


def cundallStrack():
	O.materials.append(FrictMat(young=stiffness, poisson=1, frictionAngle=0.5, density=density))
	physics = Ip2_FrictMat_FrictMat_FrictPhys(kn=MatchMaker(algo='val', val=stiffness), ks=MatchMaker(algo='val', val=stiffness))
	return physics, Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)


def viscoelastic():
	# of two bodies in series
	O.materials.append(ViscElMat(kn=2 * stiffness, ks=2 * stiffness, cn=0, cs=0, frictionAngle=0.5, density=density))
	return Ip2_ViscElMat_ViscElMat_ViscElPhys(), Law2_ScGeom_ViscElPhys_Basic()


def mindlin():
	O.materials.append(FrictMat(young=1e8, poisson=0.3, frictionAngle=0.5, density=density))
	return Ip2_FrictMat_FrictMat_MindlinPhys(), Law2_ScGeom_MindlinPhys_Mindlin()


linear = [rockJoint, cundallStrack, viscoelastic]


# --------------------------------------------------------------------------------------------------------------- laws


@pytest.mark.parametrize('make', [*linear, mindlin])
def testABlockCarriesItsWeightWithAnyLaw(make):
	engines(*make(), damping=0.5)
	floor, block = blockOnFloor(1e-3)
	O.dt = 5e-5
	O.run(30000, wait=True)
	found = contact(floor, block)
	assert found.phys.normalForce[2] == pytest.approx(block.state.mass * gravity, rel=1e-3)
	assert block.state.vel.norm() < 1e-5 and found.geom.status == 'contact'


def collision(make):
	O.reset()
	engines(*make(), weight=0)
	one = polytope.cuboid((0, 0, 0), (0.5, 0.35, 0.25), Quaternion((1, 2, 3), 1))
	two = polytope.cuboid((0.1, 0.2, 0.95), (0.3, 0.45, 0.4), Quaternion((3, 1, 2), 0.7))
	O.bodies.append([one, two])
	two.state.vel = (0, 0.1, -0.5)
	for material in O.materials:
		material.frictionAngle = 0
	O.dt = 1e-4
	start, contacts = polytope.mechanicalEnergy(), 0
	for _ in range(6000):
		O.step()
		contacts += any(i.isReal for i in O.interactions)
	assert contacts > 20 and not any(i.isReal for i in O.interactions)
	return [*one.state.vel, *two.state.vel, *one.state.angVel, *two.state.angVel], polytope.mechanicalEnergy() / start - 1


def testLinearLawsGiveTheSameCollisionAndKeepItsEnergy():
	motions, errors = zip(*[collision(make) for make in linear], strict=True)
	print(errors)
	for motion in motions[1:]:
		assert motion == pytest.approx(motions[0], rel=1e-9, abs=1e-12)
	assert max(map(abs, errors)) < 1e-4


@pytest.mark.parametrize('make', linear)
def testShearForceRemembersItsWay(make):
	engines(*make(), weight=0)
	floor, block = blockOnFloor(4e-3)
	driven(block)
	O.dt = 1e-5
	O.step()
	block.state.vel = (0.01, 0, 0)
	O.run(2000, wait=True)
	assert contact(floor, block).phys.shearForce[0] == pytest.approx(-stiffness * 2e-4, rel=1e-6)
	block.state.vel = (-0.01, 0, 0)
	O.run(2000, wait=True)
	assert abs(contact(floor, block).phys.shearForce[0]) < 1e-6 * stiffness * 2e-4
	block.state.vel = (10, 0, 0)
	O.run(40, wait=True)
	phys = contact(floor, block).phys
	assert phys.shearForce.norm() == pytest.approx(phys.normalForce.norm() * 0.5463, rel=1e-3)  # tan 0.5


# ------------------------------------------------------------------------------------------------------- surroundings


def testAcrossAPeriodicBoundary():
	depths = []
	for shift in (0, 1):
		O.reset()
		joint(normalStiffness=stiffness)
		loop(ig2=spring)
		O.periodic = True
		O.cell.setBox(4, 4, 4)
		turn = Quaternion((1, 2, 3), 0.7)
		one = polytope.cuboid((3.6 if shift else 1.6, 2, 2), (0.5, 0.5, 0.5), turn)
		two = polytope.cuboid((0.55 if shift else 2.55, 2.1, 2.05), (0.5, 0.5, 0.5), fixed=True)
		O.bodies.append([one, two])
		O.dt = 1e-6
		O.step()
		found = contact(one, two)
		depths.append((found.geom.penetrationDepth, *found.phys.normalForce))
	assert depths[0] == pytest.approx(depths[1], rel=1e-9)


def loopWith(functor):
	"""A loop with the law's engines, and with the functor of a mixed pair beside that of two polytopes, which has the settings."""
	loop(ig2=spring, gravity=(0, 0, -gravity))
	O.engines[1].boundDispatcher.functors = [one() for one in bounds]
	O.engines[2].geomDispatcher.functors = [*O.engines[2].geomDispatcher.functors, functor]


@pytest.mark.parametrize('other', supports)
def testMixedPairsShareTheModel(other):
	joint(normalStiffness=stiffness, frictionAngle=0)
	functor, support = supports[other]
	loopWith(functor())
	O.bodies.append(support())
	block = polytope.cuboid((0, 0, 0.499), (0.5, 0.5, 0.5))
	O.bodies.append(block)
	O.dt = 1e-6
	O.step()
	geom = contact(O.bodies[0], block).geom
	assert geom.energyPerStiffness > 0 and abs(geom.normal[2]) == pytest.approx(1) and geom.penetrationDepth == pytest.approx(1e-3, rel=0.1)


@pytest.mark.parametrize('other', supports)
def testAnEdgeBouncesOnMixedPairsWithoutLoss(other):
	joint(normalStiffness=stiffness, frictionAngle=0)
	functor, support = supports[other]
	loopWith(functor())
	O.trackEnergy = True
	O.bodies.append(support())
	block = polytope.cuboid((0, 0, 0.75), (0.5, 0.35, 0.25), Quaternion((1, 2, 3), 1))
	O.bodies.append(block)
	block.state.vel = (0, 0, -1)
	O.dt = 2e-5
	start, booked, contacts = polytope.mechanicalEnergy(), [], 0
	for _ in range(20000):
		O.step()
		contacts += any(i.isReal for i in O.interactions)
		booked.append(dict(O.energy.items()).get('elastPotential', 0))
	assert contacts > 100 and block.state.vel[2] != 0
	assert max(booked) > 0.1 * block.state.mass / 2  # the law's energy terms include the spring
	error = polytope.mechanicalEnergy() / start - 1
	print(other, error)
	assert abs(error) < 1e-4


def testStableTimeStepKnowsRocking():
	joint(normalStiffness=1e7, shearStiffness=1e7)
	loop(gravity=(0, 0, -gravity), ig2=spring)
	floor, block = blockOnFloor(1e-3)
	# no contact yet: that of one at a vertex, κ = k (1/m + (3/4 L²)/(m L²/6))
	assert polytope.stableTimeStep(1) == pytest.approx(1 / sqrt(5.5 * 1e7 / block.state.mass), rel=1e-9)
	with pytest.raises(ValueError, match='fraction'):
		polytope.stableTimeStep(3)
	O.dt = 1e-6
	O.step()
	found = contact(floor, block)
	rocking = 4 * found.phys.kn * 1 / 12  # of a face of 1 m
	# sliding, and turning about the contact by shear and rocking
	m, inertia, arm = block.state.mass, min(block.state.inertia), (found.geom.contactPoint - block.state.pos).norm()
	slide, turn, both = 1e7 / m, (rocking + 1e7 * arm**2) / inertia, 1e7 * arm / sqrt(m * inertia)
	expected = 1 / sqrt((slide + turn) / 2 + sqrt(((slide - turn) / 2) ** 2 + both**2))
	assert polytope.stableTimeStep(1) == pytest.approx(expected, rel=1e-6)
	block.state.blockedDOFs = 'xyzXYZ'
	with pytest.raises(ValueError, match='default'):
		polytope.stableTimeStep()
	assert polytope.stableTimeStep(default=0.1) == 0.1


@pytest.mark.parametrize('part', [1, 4])
def testStableTimeStepOfAHeap(part):
	"""Nine columns of three cubes that lean on each other, at rest: up to stableTimeStep(1) rounding does not grow without damping, whatever
	the coupling of bodies (the bound is on one body's frequency, a heap's highest is at most twice that); far above it does."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness)
	loop(normalDamping=0.5, shearDamping=0.5, gravity=(0, 0, -gravity), damping=0.5, ig2=spring)
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 9, 1), fixed=True))
	for k in range(27):
		x, y, z = k % 3, k // 3 % 3, k // 9
		O.bodies.append(polytope.cuboid((0.9999 * x + 0.01 * z, 0.9999 * y, 0.5 + z), (0.5, 0.5, 0.5)))
	O.dt = polytope.stableTimeStep(0.2, default=5e-5)
	while O.time < 1.5:
		O.run(500, wait=True)
		O.dt = polytope.stableTimeStep(0.2, default=5e-5)
	assert len([i for i in O.interactions if i.isReal]) >= 27
	rest = kineticEnergy()
	O.engines[-1].damping = 0
	law = O.engines[2].lawDispatcher.functors[0]
	law.normalDamping = law.shearDamping = 0
	O.dt = polytope.stableTimeStep(1) * part
	assert polytope.stableTimeStep(1) < 0.2 * sqrt(density / stiffness)  # rocking is what limits it
	O.run(1500, wait=True)
	print(rest, kineticEnergy())
	if part == 1:
		assert kineticEnergy() < 1e-8 * 27 * density * gravity
	else:
		assert kineticEnergy() > 1e-4 * 27 * density * gravity


# ---------------------------------------------------------------------------------------------------- 2-D, starts, statuses


def testPolygonsRestAndCollide():
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0)
	loop(ig2=spring, gravity=(0, -gravity, 0))
	floor = polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True)
	block = polytope.polygon([(-0.5, 0.3), (0.2, 0.1), (0.6, 0.8), (-0.1, 1.2)])
	O.bodies.append([floor, block])
	block.state.vel = (0, -1, 0)
	O.dt = 2e-5
	start, contacts = polytope.mechanicalEnergy(), 0
	for _ in range(30000):
		O.step()
		contacts += any(i.isReal for i in O.interactions)
	assert contacts > 100
	assert abs(polytope.mechanicalEnergy() / start - 1) < 1e-4
	O.engines[-1].damping = 0.4
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0.3
	O.dt = 5e-5
	O.run(100000, wait=True)
	assert contact(floor, block).phys.normalForce[1] == pytest.approx(block.state.mass * gravity, rel=1e-3)


def testWarmAndColdStartsGiveTheSameMotion():
	motions = []
	for warm in (True, False):
		O.reset()
		engines(*rockJoint(), warmStart=warm)
		O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
		O.bodies.append(
			[polytope.regular(faces, 0.5, (0.2 * k, 0, 0.6 + k), Quaternion((1, k, 2), k)) for k, faces in enumerate((6, 12, 20))]
		)
		O.dt = 1e-4
		O.run(5000, wait=True)
		assert any(i.isReal for i in O.interactions)
		motions.append([value for body in O.bodies for value in (*body.state.pos, *body.state.ori)])
	assert motions[1] == pytest.approx(motions[0], abs=1e-6)


def testCoincidentBodiesHaveNoDirectionAndNoForce():
	engines(*rockJoint(), weight=0)
	O.bodies.append([polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5), fixed=k == 0) for k in range(2)])
	O.dt = 1e-6
	O.step()
	found = contact(*O.bodies)
	assert found.geom.status == 'noDirection' and found.phys.normalForce.norm() < 1e-3 and O.bodies[1].state.vel.norm() < 1e-6
	# the energy's top: least slacks in a cube are a pyramid over each face, so 6 W/V is 1.2 times the inscribed radius
	assert found.geom.energyPerStiffness == pytest.approx((1.2 * 0.5) ** 2 / 2, rel=1e-9)
	stats = O.engines[2].geomDispatcher.functors[0].stats()
	assert stats['failures'] == stats['fallbacks'] == stats['statuses']['noDirection'] == 1


@pytest.mark.parametrize('perArea', [False, True])
def testABodyPutElsewhereHasItsSharesAtOnce(perArea):
	"""On the joints of 36 flush pieces, wherever a script puts it: the force of a floor of one piece."""
	O.reset()
	stiffness = 1e9 if perArea else 1e7
	O.materials.append(
		RockJointMat(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5, density=2600, stiffnessPerArea=perArea)
	)
	for i, j in itertools.product(range(6), range(6)):
		O.bodies.append(polytope.cuboid((i - 2.5, j - 2.5, -0.5), (0.5, 0.5, 0.5), fixed=True))
	body = O.bodies[O.bodies.append(polytope.cuboid((0.03, 0.02, 0.4 - 1e-3), (0.7, 0.6, 0.4)))]
	body.state.blockedDOFs = 'xyzXYZ'
	O.engines = polytope.engines()
	O.dt = 1e-5

	def force():
		return sum(float(contact.phys.normalForce[2]) for contact in O.interactions if contact.isReal)

	O.run(3, True)
	first = force()
	for place in ((0.63, 0.47), (-0.2, 0.9), (0.03, 0.02)):
		body.state.pos = (*place, 0.4 - 1e-3)
		O.step()
		assert force() == pytest.approx(first, rel=1e-3)
