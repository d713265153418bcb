# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies at rest, sliding, in flight, in collision, across a periodic boundary; with the plug-in's law and with YADE's own."""

from math import cos, radians, sin, sqrt, tan

import pytest
from flatFace import sunk
from scenes import blockOnFloor, contact, density, gravity, joint, kineticEnergy, law, loop, period, rowInAPeriodicCell
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	FrictMat,
	GlobalStiffnessTimeStepper,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Law2_ScGeom_FrictPhys_CundallStrack,
	Matrix3,
	NewtonIntegrator,
	O,
	Quaternion,
	Vector3,
	polytope,
)

stiffness = 1e8

# ------------------------------------------------------------------------------------------------ at rest


@pytest.mark.parametrize('warm', [True, False])
@pytest.mark.parametrize('perArea,half', [(False, (0.5, 0.5, 0.5)), (True, (0.5, 0.5, 0.5)), (True, (0.25, 0.5, 0.3))])
def testBlockCarriesItsWeight(perArea, half, warm):
	joint(normalStiffness=stiffness)
	loop(perArea, normalDamping=1, gravity=(0, 0, -gravity), ig2={'warmStart': warm})
	floor, block = blockOnFloor(half=half)
	kn = stiffness * (4 * half[0] * half[1] if perArea else 1)
	weight = block.state.mass * gravity
	O.dt = 0.1 * period(block.state.mass, kn)
	O.run(500, True)
	errors = [
		O.forces.f(floor.id)[2] / -weight - 1,
		contact(floor, block).phys.normalForce[2] / weight - 1,
		(half[2] - block.state.pos[2]) / sunk(weight / stiffness, (2 * half[0], 2 * half[1]), perArea) - 1,
	]
	print('relative errors of force on the floor, normal force, settlement:', errors)
	assert max(map(abs, errors[:2])) < 1e-10
	# a contact that is followed has its derivative in single precision, over 5e-3 of its depth
	assert abs(errors[2]) < (5e-3 * 2**-20 if warm else 1e-10)
	assert block.state.vel.norm() < 1e-12 and block.state.angVel.norm() < 1e-12


def testStatisticsAreTheSumsOverAllQueries():
	"""Two turned blocks in the floor, and one so little above it that their boxes overlap; every query anew, as `polytope.contact` makes it."""
	joint(normalStiffness=stiffness)
	paper = {'contactModel': 'boon2012'}
	loop(ig2={'warmStart': False, 'timing': True, **paper})
	floor = O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
	turned = Quaternion((1, 2, 3), 1.0)
	O.bodies.append([polytope.cuboid((x, 0, 0.6), (0.5, 0.5, 0.5), turned) for x in (-2, 2)])
	O.bodies.append(polytope.cuboid((0, 0, 0.51), (0.5, 0.5, 0.5)))
	O.engines[1].verletDist = 0.05
	O.dt = 1e-12
	for _ in range(4):
		O.step()
	queries = [polytope.contact(O.bodies[floor], body, **paper) for body in O.bodies if body.id != floor]
	stats = O.engines[2].geomDispatcher.functors[0].stats()
	assert stats['pairs'] == 3 * 4 and stats['contacts'] == stats['statuses']['contact'] == stats['timedPairs'] == 2 * 4
	assert stats['simplexPivots'] == 4 * sum(query.simplexPivots for query in queries) > 0
	assert stats['newtonIterations'] == 4 * sum(query.newtonIterations for query in queries if query.inContact) > 0
	assert stats['lpSeconds'] > 0 and stats['centreSeconds'] > 0


@pytest.mark.parametrize('young, weight', [(3e8, 0.25), (0.0, 0.5), (float('inf'), 0.5)])
def testWeightsOfTheNormalsAreThoseOfTheStiffnesses(young, weight):
	"""Equal ones where they say nothing."""
	material = [O.materials.append(FrictMat(young=k, poisson=0.3, frictionAngle=0.5, density=density)) for k in (1e8, 2e8)]
	bodies = [polytope.cuboid((0, 0, z), (0.5, 0.5, 0.5), material=m) for z, m in zip((0, 0.999), material, strict=True)]
	O.bodies.append(bodies)
	bodies[1].material.young = young  # no body is made of a material without stiffness
	bodies[1].state.ori = Quaternion((1, 2, 3), 0.02)
	functor = Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012')
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb()]),
		InteractionLoop([functor], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
	]
	O.step()
	geom = contact(*bodies).geom
	assert geom.normalWeight == weight
	# the same gradients, weighted there as the bodies' stiffnesses say
	assert (geom.normal - polytope.contact(*bodies, contactModel='boon2012').normal).norm() < 1e-14


def testOverlapThatIsNotSeenIsLessThanABody():
	joint()
	bodies = [polytope.cuboid((0, 0, z), (0.5, 0.5, 0.5)) for z in (0, 0.999)]
	assert polytope.contact(*bodies, tolerance=0.5).status == 'separated'
	for tolerance in (1, -1e-20):
		with pytest.raises(ValueError, match='tolerance: must be at least 0 and below 1'):
			polytope.contact(*bodies, tolerance=tolerance)


def testArmsAcrossThePeriodEndAtTheImage():
	rowInAPeriodicCell()
	contacts = [one for one in O.interactions if one.isReal]
	assert len(contacts) == 3 and sum(tuple(one.cellDist) != (0, 0, 0) for one in contacts) == 1
	for one in contacts:
		# a shear force at the contact point, half a block away from either centre, along y on the block on the right
		one.phys.ks, one.phys.shearForce = 0, Vector3(0, one.geom.normal[0], 0)
		one.phys.tangensOfFrictionAngle = 1e6
	O.step()
	for one in contacts:
		assert abs(one.phys.shearForce[1]) == pytest.approx(1, rel=1e-9)
	for body in O.bodies:  # one contact pushes along y, one against it: no force, and both turn the block the same way
		assert O.forces.f(body.id)[1] == pytest.approx(0, abs=1e-9)
		assert O.forces.t(body.id)[2] == pytest.approx(-2 * 0.5, rel=1e-3)


def testStackCarriesItsWeight():
	"""Five blocks: every contact carries what lies on it."""
	joint(normalStiffness=stiffness)
	loop(True, normalDamping=0.5, shearDamping=0.5, rockingDamping=0.5, gravity=(0, 0, -gravity))
	O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
	O.bodies.append([polytope.cuboid((0, 0, k + 0.5), (0.5, 0.5, 0.5)) for k in range(5)])
	weight = O.bodies[1].state.mass * gravity
	O.dt = 0.1 * period(O.bodies[1].state.mass, stiffness)
	O.run(8000, True)
	for k in range(5):
		assert O.interactions[k, k + 1].phys.normalForce[2] == pytest.approx((5 - k) * weight, rel=1e-6)


def testClumpCarriesItsWeightAndIsDampedWithItsMass():
	joint(normalStiffness=stiffness)
	loop(normalDamping=1, gravity=(0, 0, -gravity))
	O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
	clump, members = O.bodies.appendClumped(
		[polytope.cuboid((-0.5, 0, 0.5), (0.5, 0.5, 0.5)), polytope.cuboid((0.5, 0, 0.5), (0.5, 0.5, 0.5))]
	)
	mass = O.bodies[clump].state.mass
	assert mass == pytest.approx(2 * density, rel=1e-9)
	O.dt = 0.05 * period(mass, 2 * stiffness)
	O.step()
	O.step()
	phys = O.interactions[0, members[0]].phys
	speed = O.bodies[members[0]].state.vel[2]
	O.step()
	# the two members lie flush: half of the stiffness and of the damper each
	assert O.interactions[0, members[0]].geom.share == pytest.approx(0.5, rel=1e-6)
	assert phys.normalViscous[2] == pytest.approx(-sqrt(mass * stiffness) * speed, rel=1e-5)
	O.run(1000, True)
	total = sum(O.interactions[0, member].phys.normalForce[2] for member in members)
	assert total == pytest.approx(mass * gravity, rel=1e-6)


# ------------------------------------------------------------------------------------------------ incline

friction = radians(30)


def tiltTest(slope, halfHeight=0.5, rockingDamping=1.0, steps=2000, ig2={}, **dampers):
	"""A block at rest on a slope (held by high friction), then friction is lowered to 30° and all but the law's own damping removed.
	Returns (distance slid, mean acceleration, theory's acceleration)."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=radians(60))
	newton = loop(normalDamping=1, shearDamping=1, rockingDamping=1, gravity=(0, 0, -gravity), damping=0.7, ig2=ig2)
	turn = Quaternion((0, 1, 0), radians(slope))
	floor, block = blockOnFloor(half=(0.5, 0.5, halfHeight), turn=turn)
	O.dt = 0.1 * period(block.state.mass, stiffness)
	O.run(2500, True)
	assert block.state.vel.norm() < 1e-5
	newton.damping = 0
	law().rockingDamping = rockingDamping
	for name, value in dampers.items():
		setattr(law(), name, value)
	contact(floor, block).phys.tangensOfFrictionAngle = tan(friction)
	O.materials[0].frictionAngle = friction  # for a contact that is lost and comes back
	downhill = turn * Vector3(1, 0, 0)
	start, time = block.state.pos.dot(downhill), O.time
	O.run(steps, True)
	time = O.time - time
	theory = gravity * (sin(radians(slope)) - tan(friction) * cos(radians(slope)))
	return block.state.pos.dot(downhill) - start, block.state.vel.dot(downhill) / time, theory


def testBlockHoldsBelowTheFrictionAngle():
	distance, acceleration, _ = tiltTest(29.95)
	print('29.95°: slid', distance)
	assert abs(distance) < 1e-6


@pytest.mark.parametrize('slope', [30.05, 32, 40])
def testBlockSlidesAboveTheFrictionAngle(slope):
	distance, acceleration, theory = tiltTest(slope)
	print(f'{slope}°: slid {distance:.4e} m, acceleration {acceleration:.6f}, theory {theory:.6f}, ratio {acceleration / theory:.4f}')
	assert distance > 0.25 * theory * (0.1 * period(density, stiffness) * 2000) ** 2
	if slope > 31:
		assert acceleration == pytest.approx(theory, rel=0.02)


def testUndampedFlatBlockSlidesToo():
	"""A fifth as high as long: the lever arm of friction is too short to make it rock."""
	distance, acceleration, theory = tiltTest(40, halfHeight=0.1, rockingDamping=0, normalDamping=0, shearDamping=0)
	print(f'flat, undamped, 40°: acceleration over theory {acceleration / theory:.4f}')
	assert acceleration == pytest.approx(theory, rel=0.02)


@pytest.mark.parametrize('dampers', [dict(normalDamping=1, shearDamping=1), dict(normalDamping=0, shearDamping=0)])
def testCubeWithoutRockingDampingRidesOnItsLeadingEdge(dampers):
	"""A weakness of one contact point with the averaged normal: sliding excites rocking onto the cube's leading edge, where the normal
	is inclined against the motion, and the cube is too slow: by little without damping, nearly stopped with a normal damper, which
	sustains the rocking. Recorded, not wanted."""
	distance, acceleration, theory = tiltTest(40, rockingDamping=0, ig2={'contactModel': 'boon2012'}, **dampers)
	way = theory / 2 * (0.1 * period(density, stiffness) * 2000) ** 2
	print(f'cube without rocking damping {dampers}, 40° with φ = 30°: {distance:.3f} m of {way:.3f} m')
	assert distance < (0.1 if dampers['normalDamping'] else 0.95) * way


@pytest.mark.parametrize('dampers', [dict(normalDamping=1, shearDamping=1), dict(normalDamping=0, shearDamping=0)])
def testCubeWithoutRockingDampingSlidesWithTheDefaultContact(dampers):
	"""The contact's normal stays the floor's."""
	_, acceleration, theory = tiltTest(40, rockingDamping=0, **dampers)
	print(f'cube without rocking damping {dampers}, 40° with φ = 30°: acceleration over theory {acceleration / theory:.4f}')
	assert acceleration == pytest.approx(theory, rel=0.02)


# ------------------------------------------------------------------------------------------------ flight and collision


def momenta(bodies):
	linear = sum((b.state.mass * b.state.vel for b in bodies), Vector3.Zero)
	angular = sum((b.state.mass * b.state.pos.cross(b.state.vel) + spinMomentum(b) for b in bodies), Vector3.Zero)
	return linear, angular


def spinMomentum(body):
	state = body.state
	if body.aspherical:
		return Vector3(state.angMom)
	return Vector3(*(state.inertia[k] * state.angVel[k] for k in range(3)))


def kinetic(bodies):
	return sum(kineticEnergy(body.state) for body in bodies)


def twoFreeBlocks(half, gap):
	joint(normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.6)
	newton = loop()
	newton.rotAlgorithm = newton.rotAlgorithm.Fincham1992
	first = polytope.cuboid((0, 0, 0), half, Quaternion((1, 2, 3), 0.7), velocity=(0.5, 0.1, 0), angularVelocity=(0.3, -0.2, 0.5))
	second = polytope.cuboid(
		(gap, 0.2, 0.1), half, Quaternion((-1, 0.5, 2), 1.1), velocity=(-0.8, 0, 0.2), angularVelocity=(-0.1, 0.4, 0.2)
	)
	for b in (first, second):
		if b.aspherical:
			b.state.angMom = b.state.ori * Vector3(*(b.state.inertia[k] * (b.state.ori.conjugate() * b.state.angVel)[k] for k in range(3)))
	O.bodies.append([first, second])
	O.dt = 0.05 * period(first.state.mass, 1e7)
	return first, second


@pytest.mark.parametrize('half', [(0.5, 0.5, 0.5), (0.5, 0.35, 0.25)])
def testFreeFlightConservesMomentaAndEnergy(half):
	bodies = twoFreeBlocks(half, 20)
	O.step()
	linear, angular = momenta(bodies)
	energy = kinetic(bodies)
	O.run(2000, True)
	assert (momenta(bodies)[0] - linear).norm() == 0
	assert (momenta(bodies)[1] - angular).norm() < 1e-12 * angular.norm()
	drift = kinetic(bodies) / energy - 1
	print('energy drift in free flight:', drift)
	assert abs(drift) < (1e-12 if half[0] == half[2] else 1e-5)  # the rotation of unequal moments is YADE's, of second order


@pytest.mark.parametrize('half', [(0.5, 0.5, 0.5), (0.5, 0.35, 0.25)])
def testCollisionConservesMomenta(half):
	"""It does so to rounding, with YADE's integrator that keeps angular momentum by construction (Fincham1992)."""
	bodies = twoFreeBlocks(half, 1.6)
	O.step()
	linear, angular = momenta(bodies)
	touched = 0
	for _ in range(3000):
		O.step()
		touched += O.interactions.countReal()
	scale = sum(b.state.mass * b.state.vel.norm() for b in bodies)
	errors = (momenta(bodies)[0] - linear).norm() / scale, (momenta(bodies)[1] - angular).norm() / scale
	print('contact steps, relative errors of momentum and angular momentum (over Σ m v × 1 m):', touched, errors)
	assert touched > 20 and O.interactions.countReal() == 0
	assert max(errors) < 1e-13


# ------------------------------------------------------------------------------------------------ periodic cell


def acrossBoundary(shift, velocity):
	"""Forces on two overlapping blocks and their contact; the second moved by a cell vector, its image in the same place."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness / 3)
	loop(normalDamping=0.2, shearDamping=0.2).dead = True
	first = polytope.cuboid((0.3, 1, 1.2), (0.5, 0.4, 0.3), Quaternion((1, 2, 3), 0.2), velocity=velocity, angularVelocity=(0.1, 0.2, -0.3))
	second = polytope.cuboid(
		Vector3(-0.6, 1.1, 1.3) + shift, (0.5, 0.4, 0.3), Quaternion((-1, 0.5, 2), 0.3), angularVelocity=(0, -0.2, 0.1)
	)
	O.bodies.append([first, second])
	O.dt = 1e-4
	O.run(2, True)
	i = O.interactions[0, 1]
	assert i.isReal
	result = [i.geom.penetrationDepth, i.phys.normalForce, i.phys.shearForce] + [x for k in (0, 1) for x in (O.forces.f(k), O.forces.t(k))]
	return result, i


@pytest.mark.parametrize('cell', [((4, 0, 0), (0, 4, 0), (0, 0, 4)), ((4, 0, 0), (1.2, 4, 0), (0.5, -0.7, 4))])
def testContactAcrossThePeriodicBoundary(cell):
	velocity = Vector3(0.02, -0.03, 0.01)
	expected, _ = acrossBoundary(Vector3.Zero, velocity)
	expected = [Vector3(x) if isinstance(x, Vector3) else x for x in expected]
	for count in ((1, 0, 0), (1, 1, 0), (-1, 0, 1), (2, -1, -1)):
		O.reset()
		O.periodic = True
		O.cell.hSize = Matrix3(*(x for vector in cell for x in vector)).transpose()  # columns are the cell's vectors
		shift = sum((n * Vector3(*vector) for n, vector in zip(count, cell)), Vector3.Zero)
		found, i = acrossBoundary(shift, velocity)
		assert tuple(i.cellDist) == tuple(-n for n in count)
		for one, other in zip(found, expected):
			difference = (one - other).norm() if isinstance(one, Vector3) else abs(one - other)
			scale = max(other.norm(), 1.0) if isinstance(other, Vector3) else abs(other)
			assert difference < 1e-10 * scale, (found, expected)


def testDeformingCellMovesTheImage():
	"""The velocity of the image, velGrad × cell vector, enters shear and damping as if the body itself moved."""
	gradient = Matrix3(0.01, 0.02, 0, 0, -0.01, 0, 0.005, 0, 0)
	shift = Vector3(4, 0, 0)
	results = []
	for periodic in (False, True):
		O.reset()
		if periodic:
			O.periodic = True
			O.cell.setBox(4, 4, 4)
			O.cell.velGrad = gradient
			O.cell.homoDeform = 0
		image = gradient * shift
		joint(normalStiffness=stiffness, shearStiffness=stiffness / 3)
		loop(normalDamping=0.2)  # the integrator is what makes a change of velGrad effective
		O.bodies.append(
			[
				polytope.cuboid((0.3, 1, 1), (0.5, 0.4, 0.3)),
				polytope.cuboid(Vector3(-0.6, 1, 1) + (shift if periodic else Vector3.Zero), (0.5, 0.4, 0.3)),
			]
		)
		if not periodic:
			O.bodies[1].state.vel = -image
		O.dt = 1e-9
		O.run(2, True)
		i = O.interactions[0, 1]
		before = Vector3(i.phys.shearForce)
		O.run(5, True)
		results.append((Vector3(i.phys.normalViscous), i.phys.shearForce - before))
	for one, other in zip(*results):
		assert other.norm() > 0
		assert (one - other).norm() < 1e-6 * other.norm()  # the cell itself has moved by 1e-9 of its strain rate


# ------------------------------------------------------------------------------------------------ YADE's own law and time step


def yadeLoop(damping=0.0):
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom()],
			[Ip2_FrictMat_FrictMat_FrictPhys(kn=stiffness, ks=stiffness)],
			[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
		),
		NewtonIntegrator(gravity=(0, 0, -gravity), damping=damping),
	]


def testCundallStrackCarriesTheWeight():
	O.materials.append(FrictMat(density=density, frictionAngle=0.5))
	yadeLoop(damping=0.7)
	floor, block = blockOnFloor()
	O.dt = 0.1 * period(block.state.mass, stiffness)
	O.run(1500, True)
	weight = block.state.mass * gravity
	assert O.forces.f(floor.id)[2] == pytest.approx(-weight, rel=1e-6)
	assert 0.5 - block.state.pos[2] == pytest.approx(sunk(weight / stiffness), rel=1e-6)


@pytest.mark.parametrize('slope,slides', [(29.9, False), (40, True)])
def testCundallStrackOnAnIncline(slope, slides):
	"""A flat block, which does not need rocking damping."""
	O.materials.append(FrictMat(density=density, frictionAngle=friction))
	yadeLoop(damping=0.7)
	turn = Quaternion((0, 1, 0), radians(slope))
	floor, block = blockOnFloor(half=(0.5, 0.5, 0.1), turn=turn)
	O.dt = 0.1 * period(block.state.mass, stiffness)
	O.run(1000, True)
	O.engines[-1].damping = 0
	downhill = turn * Vector3(1, 0, 0)
	start, speed, time = block.state.pos.dot(downhill), block.state.vel.dot(downhill), O.time
	O.run(2000, True)
	acceleration = (block.state.vel.dot(downhill) - speed) / (O.time - time)
	theory = gravity * (sin(radians(slope)) - tan(friction) * cos(radians(slope)))
	print(f'Cundall-Strack, {slope}°: acceleration {acceleration:.5f}, theory {theory:.5f}')
	if slides:
		assert acceleration == pytest.approx(theory, rel=0.02)
	else:
		assert abs(block.state.pos.dot(downhill) - start) < 1e-6


@pytest.mark.parametrize('which', ['MohrCoulomb', 'MohrCoulombPerArea', 'CundallStrack'])
def testGlobalStiffnessTimeStepperIsStable(which):
	"""Tumbling blocks fall into a heap: the step is a sensible part of √(m/k), and no energy appears."""
	if which == 'CundallStrack':
		O.materials.append(FrictMat(density=density, frictionAngle=0.5))
		yadeLoop(damping=0.2)
	else:
		joint(normalStiffness=stiffness, shearStiffness=stiffness)
		loop(which.endswith('Area'), normalDamping=0.3, gravity=(0, 0, -gravity), damping=0.2)
	O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
	O.bodies.append([polytope.cuboid((0.4 * (k % 2), 0, 1 + 1.8 * k), (0.5, 0.5, 0.5), Quaternion((1, 2, k), 0.4 * k)) for k in range(5)])
	mass = O.bodies[1].state.mass
	O.engines = O.engines + [
		GlobalStiffnessTimeStepper(timestepSafetyCoefficient=0.5, defaultDt=2e-3, maxDt=2e-3, timeStepUpdateInterval=1)
	]
	O.dt = 1e-3
	start = sum(b.state.mass * gravity * b.state.pos[2] for b in O.bodies if b.dynamic)
	smallest = 1.0
	while O.time < 3:
		O.run(100, True)
		smallest = min(smallest, O.dt)
		total = sum(b.state.mass * gravity * b.state.pos[2] for b in O.bodies if b.dynamic) + kinetic([b for b in O.bodies if b.dynamic])
		assert total < start
	unit = period(mass, stiffness)
	print(f'{which}: smallest dt {smallest / unit:.3f} √(m/k), at the end {O.dt / unit:.3f}')
	assert 0.02 * unit < smallest < unit
