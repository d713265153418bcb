# SPDX-License-Identifier: GPL-2.0-or-later
"""History of a joint: shear force, slip and dilation while the contact area changes, and while the joint is open."""

from math import cos, inf, radians, sin, sqrt, tan

import pytest
from flatFace import faceForce
from scenes import blockOnFloor, contact, driven, gravity, joint, loop
from yade import O, Vector3, polytope

overlap, stiffness, dt = 1e-3, 1e8, 1e-3


def energies():
	return dict(
		dict.fromkeys(('elastPotential', 'plastDissip', 'normDampDissip', 'shearDampDissip', 'nonconservative'), 0.0),
		**dict(O.energy.items()),
	)


# ------------------------------------------------------------------------------------------------ the area changes


def wedgeFoot(depth=overlap, **material):
	"""A body whose lower edge, 1 m long between slopes of 45°, lies in a floor at this depth: area 2 × depth × 1 m. Returns it."""
	joint(**dict(dict(normalStiffness=stiffness, shearStiffness=stiffness), **material))
	loop(perArea=True)
	O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
	O.bodies.append(polytope.fromVertices([(x, y, z - depth) for x, z in ((0, 0), (0.5, 0.5), (-0.5, 0.5)) for y in (-0.5, 0.5)]))
	driven(O.bodies[1])
	O.dt = dt
	O.step()
	return O.bodies[1]


def moved(body, way, steps=100):
	"""Moves the body by this way; it is at rest at the end."""
	body.state.vel = Vector3(way) / (steps * dt)
	O.run(steps, True)
	body.state.vel = (0, 0, 0)
	O.step()


def testSpringsThatLeaveTakeTheirForceAlongAndThoseThatJoinHaveNone():
	"""Sheared by u, lifted to half of the depth, lowered again: k A u, half of it, and the same half. Those that came last, unstrained, leave first
	and without a force."""
	body, u = wedgeFoot(frictionAngle=radians(80)), 1e-4
	i = O.interactions[0, 1]
	O.trackEnergy = True
	moved(body, (0, u, 0))
	full = stiffness * 2 * overlap * u
	assert i.phys.shearForce.norm() == pytest.approx(full, rel=1e-6)
	begun = energies()
	moved(body, (0, 0, overlap / 2))
	assert i.phys.shearForce.norm() == pytest.approx(full / 2, rel=1e-6)
	lost = energies()
	assert lost['plastDissip'] - begun['plastDissip'] == pytest.approx(full * u / 4, rel=1e-5)  # half of the springs, each with k u²/2
	for _ in range(3):
		for way in -overlap / 2, overlap / 2:
			moved(body, (0, 0, way))
			assert i.phys.shearForce.norm() == pytest.approx(full / 2, rel=1e-6)
	assert energies()['plastDissip'] == pytest.approx(lost['plastDissip'], abs=1e-6 * full * u)
	assert i.phys.slip.norm() == 0 and i.phys.dilation == 0
	moved(body, (0, -u / 2, 0))
	assert i.phys.shearForce.norm() == pytest.approx(full / 4, rel=1e-6)
	assert i.phys.shearEnergy == pytest.approx(full * u / 16, rel=1e-6)


def testAreaThatVanishesMakesNoSlip():
	"""A sheared joint at its strength whose area shrinks to a tenth while nothing moves along it: the force falls with the area, the strength with
	its square, and slip takes up what is between."""
	body = wedgeFoot(frictionAngle=0.1, dilationAngle=0.02)
	i = O.interactions[0, 1]
	moved(body, (0, 2e-4, 0))
	slip, elastic = i.phys.slip.norm(), i.phys.shearForce.norm() / i.phys.ks
	# springs that joined as dilation, which deepens the edge, made its area grow are strained less: a part of the elastic displacement as small as that of the area
	assert slip > 5e-5 and 2e-4 - elastic * i.phys.dilation / overlap < slip + elastic < 2e-4
	moved(body, (0, 0, 0.9 * overlap), 400)
	assert i.phys.contactArea == pytest.approx(0.2 * overlap, rel=0.1)
	assert i.phys.slip.norm() + i.phys.shearForce.norm() / i.phys.ks == pytest.approx(2e-4, rel=1e-5)
	assert i.phys.slip.norm() < 2e-4


def testBlockPushedOffAnEdge():
	"""Pushed over the floor's edge at constant depth until nothing is left of the area: slip is the way less the elastic part, friction takes
	∫ k A u tan φ dx and what the springs that leave the area held."""
	phi = 0.4
	joint(normalStiffness=stiffness, shearStiffness=stiffness / 2, frictionAngle=phi)
	loop(perArea=True)
	floor, block = blockOnFloor(overlap)
	block.state.pos = (4, 0, block.state.pos[2])
	driven(block, (1, 0, 0))
	O.dt = dt
	normal = lambda length: faceForce(overlap, (length, 1), True)
	elastic = normal(1) * tan(phi) * 2
	O.run(200, True)
	i = contact(floor, block)
	assert i.phys.isSliding and i.phys.slip[0] == pytest.approx(0.2 - elastic, rel=1e-9)
	O.trackEnergy = True
	O.run(301, True)
	begun, start = energies(), block.state.pos[0] - dt  # the law comes before the motion
	assert i.phys.contactArea == pytest.approx(1, abs=2e-3)
	O.run(700, True)
	terms, area, way = energies(), i.phys.contactArea, 0.7
	assert area == pytest.approx(1 - (start + way - 4.5), rel=2e-5)  # seen along a normal that leans by the depth over the length
	# at the mean area along the way, on which the force depends linearly
	friction = stiffness * tan(phi) * way * normal(1 - (start - 4.5) - way / 2)
	left = stiffness / 2 * elastic**2 / 2 * way
	assert terms['plastDissip'] - begun['plastDissip'] == pytest.approx(friction + left, rel=1e-6)
	# the elastic energy of the area that is lost is the work of the normal force, which leans towards the edge
	assert abs(terms['nonconservative'] - begun['nonconservative']) < 1e-3 * stiffness * overlap**2 / 2 * way
	largest = 0
	while (0, 1) in {(one.id1, one.id2) for one in O.interactions} and O.iter < 2000:
		largest = max(largest, i.phys.slip.norm() - (block.state.pos[0] - 4))
		O.step()
	assert largest <= 0 and block.state.pos[0] > 5.49


@pytest.mark.parametrize('way', [1, -1])
def testCohesionFollowsTheArea(way):
	"""A block half over the floor's edge, drawn off or on: it holds until the spring's force k u is c times the area that there is then,
	c (A₀ ∓ w u)."""
	k, cohesion, width, area = 1e6, 4e5, 1, 0.5
	joint(normalStiffness=k, shearStiffness=k, frictionAngle=0, cohesion=cohesion)
	loop(perArea=False)
	floor, block = blockOnFloor(overlap)
	block.state.pos = (5, 0, block.state.pos[2])
	driven(block, (way, 0, 0))
	O.dt = dt
	O.step()
	i = contact(floor, block)
	failure = cohesion * area / (k + way * cohesion * width)
	for step in range(1, 450):
		O.step()
		moved = dt * step
		assert i.phys.contactArea == pytest.approx(area - way * width * moved, rel=5e-3)
		assert i.phys.intact == (moved < failure) or abs(moved - failure) < 3 * dt
	assert not i.phys.intact and dt * 440 > failure


@pytest.mark.parametrize('model', ['boon2012', 'surface'])
@pytest.mark.parametrize('psi', [0, 5])
def testSlipOfABlockThatTipsOntoItsEdge(model, psi):
	"""Pressed and sheared on its face, then tipped about one edge until it leaves: slip and elastic displacement stay within the way that the
	bodies move along each other at their contact point."""
	joint(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(30), dilationAngle=radians(psi))
	loop(perArea=True, ig2=dict(contactModel=model))
	floor, block = blockOnFloor(1e-4, (1, 0.5, 0.5))
	driven(block)
	O.dt = 1e-4
	O.step()
	i = contact(floor, block)
	block.state.vel, moved = (5e-4, 0, 0), 0
	for step in range(3500):
		if step == 1000:
			block.state.vel, block.state.angVel = (0, 0, 0), (0, 2e-3, 0)
		if step > 1000:  # about the lower edge ahead, and slowly up with it
			arm = block.state.ori * Vector3(1, 0, -0.5)
			block.state.vel = -Vector3(0, 2e-3, 0).cross(arm) + Vector3(0, 0, 2e-4 if step > 1500 else 0)
		O.step()
		if not i.isReal:
			break
		moved += i.geom.shearInc.norm()
		assert i.phys.slip.norm() + i.phys.shearForce.norm() / i.phys.ks <= moved * (1 + 1e-9)
	assert moved > 5e-5


@pytest.mark.parametrize('limit', [5e-3, inf])
def testSlipOfABlockThatRocksOnASlope(limit):
	"""The contact's area shrinks to nothing in some steps. Slip and dilation stay within what the block has moved."""
	slope, psi = radians(35), radians(5)
	joint(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(30), dilationAngle=psi, dilationLimit=limit)
	loop(perArea=True, normalDamping=0.3, shearDamping=0.3, rockingDamping=0.5, gravity=(gravity * sin(slope), 0, -gravity * cos(slope)))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (30, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((-20, 0, 0.5), (1, 0.5, 0.5)))
	block = O.bodies[1]
	O.dt = 0.1 * sqrt(block.state.mass / 2e9)
	way = 0
	for _ in range(1500):
		O.step()
		way += (block.state.vel.norm() + block.state.angVel.norm() * sqrt(1.5)) * O.dt
		for i in O.interactions:
			assert i.phys.slip.norm() <= way and i.phys.dilation <= way * tan(psi)
			assert i.phys.normalForce.norm() < 20 * block.state.mass * gravity
	assert way > 1e-3


# ------------------------------------------------------------------------------------------------ the joint opens


def testDilationIsRememberedWhileTheJointIsOpen():
	"""Slip, lift, shift back by a quarter, lower: the joint is wider by the dilation of the remaining slip, and its force follows."""
	psi = 0.1
	for perArea in (False, True):
		O.reset()
		joint(normalStiffness=stiffness, shearStiffness=stiffness, dilationAngle=psi)
		loop(perArea=perArea)
		floor, block = blockOnFloor(overlap)
		driven(block)
		O.dt = dt
		O.step()
		i = contact(floor, block)
		for velocity, steps in (((0.04, 0, 0), 1000), ((0, 0, 0.05), 200), ((-0.01, 0, 0), 1000), ((0, 0, -0.05), 200), ((0, 0, 0), 1)):
			block.state.vel = velocity
			O.run(steps, True)
			if velocity[0] < 0:
				assert i.phys.normalForce.norm() == i.phys.shearForce.norm() == 0 and not i.phys.isSliding
		assert i.isReal
		assert i.phys.slip[0] == pytest.approx(0.03, rel=1e-9) and abs(i.phys.slip[1]) < 1e-12
		assert i.phys.dilation == pytest.approx(0.03 * tan(psi), rel=1e-9)
		assert i.phys.normalForce[2] == pytest.approx(stiffness * faceForce(overlap + 0.03 * tan(psi), perArea=perArea), rel=1e-9)
		assert i.phys.shearForce.norm() < 1e-14 * i.phys.normalForce.norm()  # rounding of the normal while it is pressed together


def testJointThatHasNotSlippedHasNothingToRemember():
	joint(normalStiffness=stiffness, dilationAngle=0.1)
	loop()
	floor, block = blockOnFloor(overlap)
	driven(block)
	O.dt = dt
	O.step()
	block.state.vel = (0, 0, 0.1)
	O.run(15, True)
	assert O.interactions.countReal() == 0


@pytest.mark.parametrize('perArea', [False, True])
def testBlockThatSlidesAndDilatesDownASlope(perArea):
	"""It climbs its asperities with a = g (sin α − cos α tan φ) / (1 + tan φ tan ψ), flies off them at the dilation's limit, lands, and
	goes on at the limit's height with g (sin α − cos α tan φ). Friction, lifting and dampers take what gravity gives."""
	slope, phi, psi, limit = radians(35), radians(30), radians(5), 5e-3
	joint(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=phi, dilationAngle=psi, dilationLimit=limit)
	loop(perArea=perArea, normalDamping=0.1, shearDamping=0.3, gravity=(gravity * sin(slope), 0, -gravity * cos(slope)))
	floor, block = polytope.cuboid((0, 0, -0.5), (30, 2, 0.5), fixed=True), polytope.cuboid((-20, 0, 0.5), (0.5, 0.5, 0.5))
	O.bodies.append([floor, block])
	block.state.blockedDOFs = 'XYZ'
	mass = block.state.mass
	O.dt = 0.1 * sqrt(mass / 1e9)
	sunk = mass * gravity * cos(slope) / 1e9
	block.state.pos = (-20, 0, 0.5 - sunk)
	O.trackEnergy = True
	sliding = gravity * (sin(slope) - cos(slope) * tan(phi))

	def acceleration(way):
		"""Mean, from here on for this way; also the number of steps without a force."""
		start, begun, speed, apart = block.state.pos[0], O.time, block.state.vel[0], 0
		while block.state.pos[0] < start + way:
			O.step()
			apart += contact(floor, block).phys.normalForce.norm() == 0
		return (block.state.vel[0] - speed) / (O.time - begun), apart

	acceleration(0.1 * limit / tan(psi))  # the shear spring is strained first
	climbing, apart = acceleration(0.7 * limit / tan(psi))
	assert climbing == pytest.approx(sliding / (1 + tan(phi) * tan(psi)), rel=1e-3) and apart == 0
	way, height = block.state.pos[0] + 20, block.state.pos[2] - 0.5
	assert height == pytest.approx(way * tan(psi), abs=3 * sunk)
	_, apart = acceleration(limit / tan(psi))
	assert apart > 5
	going, apart = acceleration(limit / tan(psi))
	assert going == pytest.approx(sliding, rel=1e-3) and apart == 0
	way, height = block.state.pos[0] + 20, block.state.pos[2] - 0.5
	assert height == pytest.approx(limit - sunk, abs=1e-3 * sunk)
	terms = energies()
	given = mass * gravity * (sin(slope) * way - cos(slope) * (height + sunk))
	taken = mass * block.state.vel.squaredNorm() / 2
	taken += sum(terms[name] for name in ('plastDissip', 'normDampDissip', 'shearDampDissip', 'elastPotential'))
	assert taken == pytest.approx(given, rel=2e-3)
	assert abs(terms['nonconservative']) < 1e-3 * given


# ------------------------------------------------------------------------------------------------ stiffnesses


def testStiffnessSetByTheScript():
	"""A stiffness per contact stays as it is; one per area follows from the joint's own values."""
	for perArea in (False, True):
		O.reset()
		joint(normalStiffness=stiffness, shearStiffness=stiffness)
		loop(perArea=perArea)
		floor, block = blockOnFloor(overlap)
		driven(block)
		O.dt = dt
		O.step()
		phys = contact(floor, block).phys
		phys.kn, phys.ks = 2e7, 1e7
		O.run(2, True)
		if perArea:
			assert phys.kn == phys.ks == pytest.approx(stiffness, rel=1e-9) and phys.normalStiffnessPerContact == 0
			phys.normalStiffness = phys.shearStiffness = 0
			phys.kn, phys.ks = 2e7, 1e7
			O.run(2, True)
		assert (phys.kn, phys.ks) == (2e7, 1e7) == (phys.normalStiffnessPerContact, phys.shearStiffnessPerContact)
		assert phys.normalForce[2] == pytest.approx(2e7 * faceForce(overlap, perArea=perArea), rel=1e-9)
