# SPDX-License-Identifier: GPL-2.0-or-later
"""A joint as a bed of shear springs and friction over its area: moments about the normal, load cycles, blocks held by shear alone."""

from math import asinh, atan, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from scenes import blockOnFloor, contact, driven, gravity, joint, loop
from yade import (
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PyRunner,
	Quaternion,
	Vector3,
	polytope,
)

stiffness = 1e9


def prism(sides, radius, height, center, **body):
	corners = [
		(center[0] + radius * cos(2 * pi * (k + 0.5) / sides), center[1] + radius * sin(2 * pi * (k + 0.5) / sides)) for k in range(sides)
	]
	return polytope.fromVertices([(x, y, center[2] + z) for x, y in corners for z in (-height / 2, height / 2)], **body)


def meanRadius(sides, radius):
	"""Mean radius of a regular polygon under an even pressure."""
	h, t = radius * cos(pi / sides), radius * sin(pi / sides)
	return (h * (t * hypot(t, h) + h * h * asinh(t / h)) / 3) / (h * t)


def atRest(sides, mu, perArea=True, tiles=1, radius=0.5, height=0.4, **newton):
	"""A prism at rest on a floor of so many tiles in each direction, pressed in by its weight."""
	k = stiffness if perArea else stiffness / 10
	joint(normalStiffness=k, shearStiffness=k, frictionAngle=atan(mu))
	loop(perArea=perArea, gravity=(0, 0, -gravity), **newton)
	for i in range(tiles):
		for j in range(tiles):
			at = [6 / tiles * (n + 0.5) - 3 for n in (i, j)]
			O.bodies.append(polytope.cuboid((*at, -0.5), (3 / tiles, 3 / tiles, 0.5), fixed=True))
	body = prism(sides, radius, height, (0, 0, height / 2))
	O.bodies.append(body)
	area = sides / 2 * radius**2 * sin(2 * pi / sides)
	sunk = body.state.mass * gravity / (k * area if perArea else k)
	body.state.pos -= Vector3(0, 0, sunk)
	O.dt = 0.1 * sqrt(sunk / gravity)
	return body


def inertiaAboutZ(body):
	axes = body.state.ori.toRotationMatrix()
	return sum(body.state.inertia[k] * axes.row(2)[k] ** 2 for k in range(3))


# ------------------------------------------------------------------------------------------------ turning on the spot


@pytest.mark.parametrize('sides, perArea, tiles', [(4, True, 1), (6, True, 1), (24, True, 1), (4, False, 1), (24, False, 1), (4, True, 2)])
def testASpinningPrismIsBrakedByFrictionTimesItsMeanRadius(sides, perArea, tiles):
	mu = 0.5
	body = atRest(sides, mu, perArea, tiles)
	rate = mu * body.state.mass * gravity * meanRadius(sides, 0.5) / inertiaAboutZ(body)
	body.state.angVel = (0, 0, 1)
	while O.time < 0.8 / rate:
		O.step()
	assert body.state.angVel[2] == pytest.approx(1 - rate * O.time, rel=3e-3)
	assert body.state.vel.norm() < 1e-3
	while O.time < 3 / rate:
		O.step()
	assert abs(body.state.angVel[2]) < 0.05  # it swings on the springs of the bed
	assert sum(i.phys.isSliding for i in O.interactions if i.isReal) == 0


def testADiscThatSlidesAndSpinsStopsBothAtOnce():
	"""Farkas, Bartels, Unger & Wolf (2003), Phys. Rev. Lett. 90:248302: a disc's velocity over its rim's tends to 0.653, however it starts."""
	last = []
	for start in (0.4, 1.5):
		O.reset()
		body = atRest(24, 0.4, height=0.02, radius=0.5)
		speed = 0.5
		body.state.vel, body.state.angVel = (speed * start, 0, 0), (0, 0, speed / 0.5)
		ratio = start
		while body.state.angVel[2] > 0.05 * speed / 0.5 and body.state.vel.norm() > 0.05 * speed * 0.65:
			O.step()
			ratio = body.state.vel.norm() / (0.5 * body.state.angVel[2])
		last.append(ratio)
		while O.time < 1:
			O.step()
		assert body.state.vel.norm() < 0.02 * speed and abs(body.state.angVel[2]) < 0.04 * speed / 0.5
	assert last[0] < 0.653 < last[1] and 0.45 < last[0] and last[1] < 0.85


def resistance(slip, half, cells=200):
	"""Force and moment about the centre of a square under an even pressure that slips so, over friction times normal force."""
	x, y = np.meshgrid(*2 * [(np.arange(cells) + 0.5) / cells * 2 * half - half])
	u, v = slip[0] - slip[2] * y, slip[1] + slip[2] * x
	size = np.hypot(u, v)
	return np.array([(u / size).mean(), (v / size).mean(), ((x * v - y * u) / size).mean()])


def testABlockPulledOffItsCentreTurnsAboutTheRightPoint():
	"""Pulled so slowly that forces balance: its velocity is the one whose friction is the pull, a block and its arm by brute force."""
	mu, arm, half = 0.5, 0.2, 0.5
	body = atRest(4, mu, radius=half * sqrt(2), height=0.005, damping=0.2)  # flat: the pull does not tilt it
	weight = body.state.mass * gravity
	low, high = 0.01, 10
	for _ in range(60):  # the pole on the side away from the pull, at which moment over force is the arm
		pole = (low + high) / 2
		f = resistance((1, 0, 1 / pole), half)
		low, high = (pole, high) if f[2] / f[0] > arm else (low, pole)
	most = mu * weight * f[0]
	O.engines = [*O.engines[:-1], PyRunner(iterPeriod=1, command='pull()'), O.engines[-1]]

	def pull():
		force = Vector3(most * min(1.003, 0.9 + 0.2 * O.time), 0, 0)
		O.forces.addF(body.id, force)
		O.forces.addT(body.id, Vector3(0, 0, arm * force[0]))

	import __main__

	__main__.pull = pull
	while O.time < 0.45:
		O.step()
	assert body.state.vel.norm() < 1e-4  # holds below the limit
	while body.state.pos[0] < 1e-4:
		O.step()
	assert body.state.vel[0] / body.state.angVel[2] == pytest.approx(pole, rel=0.02)
	assert abs(body.state.vel[1]) < 0.02 * body.state.vel[0]


# ------------------------------------------------------------------------------------------------ held by shear alone


def roof(dimension, depth, seconds=0.6):
	"""A roof prism between two inclined abutments, weight ramped up: how far it has moved down, and S/N."""
	slope, high, gap, far = radians(20), 5.0, 1e-4, 6.0
	wide = high * tan(slope)
	joint(normalStiffness=1e10, shearStiffness=1e9, frictionAngle=radians(80))
	right = [(wide, 0), (far, 0), (far, high), (0, high)]
	outlines = [
		[(-wide, 0), (wide, 0), (0, high)],
		[(x - gap / cos(slope), y) for x, y in right],
		[(gap / cos(slope) - x, y) for x, y in right],
	]
	for k, outline in enumerate(outlines):
		if dimension == 2:
			O.bodies.append(polytope.polygon(outline, depth, fixed=k > 0))
		else:
			O.bodies.append(polytope.fromVertices([(x, z, y) for x, y in outline for z in (-depth / 2, depth / 2)], fixed=k > 0))
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, shearDamping=0.5)
	O.engines = polytope.engines(gravity=(0, 0, 0), law=law)
	newton = next(engine for engine in O.engines if isinstance(engine, NewtonIntegrator))
	wedge, up = O.bodies[0], 1 if dimension == 2 else 2
	start = wedge.state.pos[up]
	while O.time < seconds:
		weight = [0, 0, 0]
		weight[up] = -gravity * min(1, O.time / 0.2)
		newton.gravity = weight
		O.step()
	one = contact(O.bodies[0], O.bodies[1])
	return start - wedge.state.pos[up], one.phys.shearForce.norm() / one.phys.normalForce.norm()


def testARoofPrismHoldsInSpaceAsInThePlane():
	flat, ratio = roof(2, 1)
	assert abs(flat) < 1e-3
	for depth in (1, 20):
		O.reset()
		solid, same = roof(3, depth)
		assert solid == pytest.approx(flat, rel=1e-3)
		assert same == pytest.approx(ratio, rel=1e-3)


def testAClampedBlockDoesNotSwing():
	"""Clamped by 1000 times its weight at its lower half, and pushed: it stays, with the moment of its weight held by friction on both faces."""
	joint(normalStiffness=1e10, shearStiffness=1e10, frictionAngle=radians(45))
	weight = 2600 * 2 * 9.81
	pressed = 1000 * weight / 1e10
	block = polytope.cuboid((0, 0, 1), (0.5, 0.5, 1))
	O.bodies.append(block)
	# no edge of the block in line with one of theirs: there a pressure over an area that changes pushes along the face
	O.bodies.append([polytope.cuboid((side * (1.5 - pressed), 0, 0.6), (1, 0.4, 0.5), fixed=True) for side in (-1, 1)])
	O.engines = polytope.engines(law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, shearDamping=0.5))
	block.state.angVel = (1e-3, 0, 0)
	while O.time < 0.5:
		O.step()
	assert block.state.ori.toAxisAngle()[1] == pytest.approx(0, abs=1e-5) and block.state.angVel.norm() < 1e-10
	forces = [i for i in O.interactions if i.isReal]
	assert len(forces) == 2
	for i in forces:
		assert i.phys.shearForce.norm() == pytest.approx(weight / 2, rel=0.01)
		assert i.phys.shearPoint[2] == pytest.approx(0.6, abs=1e-3)  # of the area, not of the block
		corners = [Vector3(corner) for corner in i.geom.outline]
		assert min(c[2] for c in corners) == pytest.approx(0.1, abs=1e-4) and max(c[2] for c in corners) == pytest.approx(1.1, abs=1e-4)


def stiffnessMatrix(perArea, slope):
	"""Stiffness of a flat block at rest on a slope that cohesion holds: how its force and moment fall with a small motion, [N/m], [N], [N m]."""
	halves, small, columns = (0.5, 0.5, 0.1), 1e-9, []
	for moved in range(-1, 6):
		O.reset()
		joint(density=1e4, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=radians(30), cohesion=1e6, residualCohesion=1e6)
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
		block = polytope.cuboid((0, 0, 0.1 - 1e3 * 9.81 * cos(slope) / 1e8), halves)
		O.bodies.append(block)
		physics = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)
		law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=1, shearDamping=0.3, rockingDamping=0.3)
		O.engines = polytope.engines(
			gravity=(9.81 * sin(slope), 0, -9.81 * cos(slope)), physics=physics, law=law, damping=0.5, timeStepper=False
		)
		O.dt = 1e-4
		for _ in range(4000):
			O.step()
		law.normalDamping = law.shearDamping = law.rockingDamping = 0
		driven(block)
		O.step()
		O.step()
		if moved >= 0:
			step = [0.0] * 6
			step[moved] = small / O.dt
			driven(block, step[:3], step[3:])
		O.step()
		driven(block)
		O.step()
		load = np.array([*O.forces.f(block.id), *O.forces.t(block.id)], float)
		columns.append(load)
	return np.array([(columns[0] - column) / small for column in columns[1:]]).T


@pytest.mark.parametrize('perArea', [True, False])
def testStiffnessOfABlockOnASlopeIsSymmetric(perArea):
	"""It is symmetric but for the shear force times the block's size, 1e4 N m. Else rocking and twisting, of one frequency here, set each
	other swinging: at rest the shear force acts at the middle of the face, though the pressure's centre is a tenth of a metre farther
	down."""
	found = stiffnessMatrix(perArea, radians(50))
	assert found[1, 1] == pytest.approx(1e8, rel=1e-3) and found[5, 5] == pytest.approx(1e8 / 6, rel=1e-3)
	assert np.abs(found - found.T).max() < 1e4


# ------------------------------------------------------------------------------------------------ the area changes


@pytest.mark.parametrize('feet', ['edge', 'flat'])
def testLoadCyclesDoNotLetABlockCreepDownASlope(feet):
	"""The block stands on two edges, or two faces, on a slope of 20° with friction of 35°; the weight across the slope goes up and down by 30 %."""
	slope = radians(20)
	joint(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(35))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	outline = [(0, 0), (0.1, 0.1), (-0.1, 0.1)] if feet == 'edge' else [(-0.1, 0), (0.1, 0), (0.1, 0.1), (-0.1, 0.1)]
	stands = [polytope.fromVertices([(x + at, y, z) for x, z in outline for y in (-0.4, 0.4)]) for at in (-0.4, 0.4)]
	clump, _ = O.bodies.appendClumped([polytope.cuboid((0, 0, 0.2), (0.5, 0.4, 0.1)), *stands])
	newton = NewtonIntegrator(gravity=(gravity * sin(slope), 0, -gravity * cos(slope)), damping=0.2)
	O.engines = polytope.engines(integrator=newton)
	state = O.bodies[clump].state
	while O.time < 0.5:
		O.step()
	start, place = O.time, []
	for cycle in range(1, 13):
		while O.time < start + cycle / 10:
			newton.gravity = (gravity * sin(slope), 0, -gravity * cos(slope) * (1 + 0.3 * sin(20 * pi * (O.time - start))))
			O.step()
		place.append(state.pos[0])
	assert abs(place[-1] - place[3]) / 8 < 1e-6
	assert place[0] - place[-1] < 1.5e-4  # as many independent springs: 0.06 to 0.12 mm, once


@pytest.mark.parametrize('perArea', [True, False])
def testLoadCyclesDoNotLetABlockCreepOverPieces(perArea):
	"""A tall block over the seam of two fixed pieces is pushed by a third of its weight, again and again, with friction of 80°: what either piece carries of it
	goes up and down with its tilt."""
	joint(normalStiffness=1e8, shearStiffness=1e8, frictionAngle=radians(80), stiffnessPerArea=perArea)
	for low, high in ((-2, 0.1), (0.1, 2)):
		O.bodies.append(polytope.cuboid(((low + high) / 2, 0, -0.5), ((high - low) / 2, 2, 0.5), fixed=True))
	block = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.4, 0.5)))]
	newton = NewtonIntegrator(gravity=(0, 0, -gravity), damping=0.2)
	O.engines = polytope.engines(integrator=newton)
	while O.time < 0.5:
		O.step()
	place = []
	for _ in range(6):
		start = O.time
		while O.time < start + 0.25:
			newton.gravity = (0.35 * gravity * sin(4 * pi * (O.time - start)) ** 2, 0, -gravity)
			O.step()
		place.append(block.state.pos[0])
	depth = max(-contact.geom.infeasibility for contact in O.interactions if contact.isReal)
	assert abs(place[-1] - place[2]) / 3 < 1e-3 * depth


@pytest.mark.parametrize('dimension', [2, 3])
def testABlockOnItsFaceShakenBelowYieldStays(dimension):
	"""On a joint that closes by 0.15 mm. The weight across a slope of 20° goes up and down by 30 %, twenty times."""
	slope = radians(20)
	joint(frictionAngle=radians(35))
	if dimension == 2:
		O.bodies.append(polytope.polygon([(-3, -1), (3, -1), (3, 0), (-3, 0)], fixed=True))
		block = polytope.polygon([(-0.5, 0), (0.5, 0), (0.5, 0.6), (-0.5, 0.6)])
	else:
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
		block = polytope.cuboid((0, 0, 0.3), (0.5, 0.4, 0.3))
	O.bodies.append(block)

	def pull(part):
		across = -gravity * cos(slope) * part
		return (gravity * sin(slope), across, 0) if dimension == 2 else (gravity * sin(slope), 0, across)

	newton = NewtonIntegrator(gravity=pull(1), damping=0.2)
	O.engines = polytope.engines(integrator=newton)
	while O.time < 1:
		O.step()
	start, begun, places = block.state.pos[0], O.time, []
	for cycle in range(1, 21):
		while O.time < begun + cycle / 10:
			newton.gravity = pull(1 + 0.3 * sin(20 * pi * (O.time - begun)))
			O.step()
		places.append(block.state.pos[0] - start)
	assert max(map(abs, places)) < 2e-5
	assert abs(places[19] - places[9]) / 10 < 1e-7


def testDroppedBlocksComeToRestAndNoneKeepsTurning():
	"""Thirty, at any angle and turning, with default settings. A point of friction has no moment about the normal: 25 of them turned on for ever."""
	random = np.random.default_rng(1)
	joint(frictionAngle=radians(35))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (100, 3, 0.5), fixed=True))
	for k in range(30):
		turn = random.normal(size=4)
		turn /= np.linalg.norm(turn)
		spin = tuple(random.normal(size=3) * 2)
		O.bodies.append(
			polytope.cuboid((-45 + 3 * k, 0, 1.2), (0.5, 0.4, 0.3), orientation=Quaternion(tuple(turn[:3]), turn[3]), angularVelocity=spin)
		)
	O.engines = polytope.engines()
	while O.time < 8:
		O.step()
	assert len([one for one in O.bodies if one.state.pos[2] > 0.2]) == 30
	assert max(one.state.angVel.norm() for one in O.bodies) < 1e-6
	assert max(one.state.vel.norm() for one in O.bodies) < 1e-6


def testASlidingAndTurningBlockKeepsItsBudget():
	"""Kinetic energy, friction, dampers and springs, over the way of a plate that is thrown along the floor turning."""
	body = atRest(4, 0.5, radius=0.5, height=0.02)
	O.trackEnergy = True
	O.step()
	body.state.vel, body.state.angVel = (1, 0.3, 0), (0, 0, 4)
	mass, inertia = body.state.mass, inertiaAboutZ(body)
	begun = mass * body.state.vel.squaredNorm() / 2 + inertia * body.state.angVel[2] ** 2 / 2
	start = dict(O.energy.items())
	lost, gained, largest = 0, 0, 0
	while O.time < 0.6:
		O.step()
		gained += max(0, lost - O.energy['plastDissip'])
		lost = O.energy['plastDissip']
		largest = max(largest, abs(O.energy['nonconservative'] - start['nonconservative']))
	assert lost == pytest.approx(begun, rel=5e-3)
	assert largest < 2e-3 * begun and gained < 1e-5 * begun  # see Shear::followCentroid


def testCohesionOverAFaceHoldsAMoment():
	"""Turned slowly on the spot, a cohesive face without friction fails at c ∫ r dA."""
	cohesion = 1e5
	joint(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0, cohesion=cohesion)
	loop(perArea=True)
	floor, block = blockOnFloor(1e-5)
	driven(block, angularVelocity=(0, 0, 1e-3))
	O.dt = 1e-4
	largest = 0
	for _ in range(6000):
		O.step()
		i = contact(floor, block)
		if not i.phys.intact:
			break
		largest = max(largest, abs(i.phys.twistingMoment))
	assert not i.phys.intact
	assert largest == pytest.approx(cohesion * meanRadius(4, sqrt(0.5)), rel=1e-3)
	assert i.phys.twistingMoment == 0
