# SPDX-License-Identifier: GPL-2.0-or-later
"""Water on faces: buoyancy, floating, uplift under a dam, Hoek & Bray's slope with a tension crack."""

from math import cos, inf, nan, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from yade import O, PolytopeWater, Quaternion, RockJointMat, Vector3, polytope
from yade.polytope.strengthReduction import StrengthReduction

gravity, density = 9.81, 1000
weight = density * gravity
"""Weight of a cubic metre of water [N]."""


def rock(**values):
	return O.materials.append(RockJointMat(**{**dict(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.6), **values}))


def moment(load, body, about):
	"""Moment of a load about a point."""
	force, torque = load
	return torque + (O.bodies[body].state.pos - Vector3(*about)).cross(force)


def testASubmergedMassHasItsBuoyancy():
	"""The blocks of a jointed mass one by one, and all of them: ρ g V upwards, in the middle, from whatever is beside them."""
	rock()
	normals = np.concatenate([np.eye(3), -np.eye(3)])
	mass = polytope.jointedRock(
		normals, [3, 2, 1, 3, 2, 1], [polytope.JointSet(radians(40), radians(70), 0.9), polytope.JointSet(radians(80), radians(10), 0.8)]
	)
	ids = mass.append()
	O.engines = polytope.engines()
	engine = polytope.water(level=4)
	loads = [engine.load(one) for one in ids]
	for (force, torque), volume in zip(loads, mass.volumes, strict=True):
		assert (force - Vector3(0, 0, weight * volume)).norm() < 1e-11 * weight * volume
		assert torque.norm() < 1e-11 * weight * volume
	total = sum((force for force, _ in loads), Vector3.Zero)
	assert (total - Vector3(0, 0, weight * 6 * 4 * 2)).norm() < 1e-12 * weight * 48
	assert len(ids) > 30


def testForcesActInTheStep():
	rock()
	body = O.bodies.append(polytope.regular(12, 0.5, center=(0, 0, -3)))
	O.bodies.append(polytope.cuboid((9, 0, 0), (1, 1, 1), fixed=True))  # so that the level is not above the ground
	O.engines = polytope.engines(damping=0)
	one, other = (polytope.water(level=0, faces=lambda face, side=side: (face.normal[0] > 0) == side) for side in (True, False))
	assert [type(one).__name__ for one in O.engines[2:6]] == ['InteractionLoop', 'PolytopeWater', 'PolytopeWater', 'NewtonIntegrator']
	volume = O.bodies[body].shape.volume
	O.dt = 1e-4
	O.engines = O.engines[:-1]
	O.step()
	expected = (1000 * volume / O.bodies[body].state.mass - 1) * gravity * O.dt
	assert O.bodies[body].state.vel[2] == pytest.approx(expected, rel=1e-12)
	assert one.load(body)[0][2] + other.load(body)[0][2] == pytest.approx(weight * volume, rel=1e-12)
	part, before = one.load(body)[0], Vector3(O.bodies[body].state.vel)
	other.dead = True
	O.step()
	assert (O.bodies[body].state.vel - before)[0] == pytest.approx(part[0] / O.bodies[body].state.mass * O.dt, rel=1e-6)


def testAClumpFloatsAsTheBlockThatItMakes():
	"""Water on the faces that its parts share cancels."""
	rock(density=600)
	turn = Quaternion((0, 1, 0), 0.2)
	whole = O.bodies.append(polytope.cuboid((9, 0, 0), (1, 1, 0.5), turn))
	clump, _ = polytope.clump([polytope.cuboid(turn * Vector3(side * 0.5, 0, 0), (0.5, 1, 0.5), turn) for side in (-1, 1)])
	O.engines = polytope.engines(damping=0, timeStepper=False)
	O.dt = 1e-3
	polytope.water(level=0.1)
	O.run(2000, wait=True)
	one, other = O.bodies[whole].state, O.bodies[clump].state
	assert one.pos[2] == pytest.approx(other.pos[2], abs=1e-9) and (one.angVel - other.angVel).norm() < 1e-8
	assert one.vel.norm() > 1e-3 and abs(one.angVel[1]) > 1e-3


def testTheLoadOfAClumpIsThatOfItsMembersTogether():
	rock()
	clump, members = O.bodies.appendClumped([polytope.cuboid((x, 0.2 * x, 0.5 * x), (0.5, 0.5, 0.5)) for x in (0, 1)])
	O.engines = polytope.engines()
	water = polytope.water(level=0.25)
	force, torque = water.load(clump)
	loads = [water.load(k) for k in members]
	arms = [O.bodies[k].state.pos - O.bodies[clump].state.pos for k in members]
	assert force[2] == pytest.approx(1000 * 9.81 * (0.75 + 0.25), rel=1e-12)
	assert (force - loads[0][0] - loads[1][0]).norm() < 1e-9
	assert (torque - sum((t + arm.cross(f) for arm, (f, t) in zip(arms, loads, strict=True)), Vector3.Zero)).norm() < 1e-9 < torque.norm()
	water.dead = True
	assert water.load(clump)[0] == Vector3.Zero and water.load(members[0])[0] == Vector3.Zero


@pytest.mark.parametrize('flat', [False, True])
def testAFloatingBlockHasItsDraftAndRightingMoment(flat):
	"""Archimedes: draft h ρ_b/ρ_w; a box turned by θ without a dry bottom has the moment ρ g L sin θ (b³/12 (1 + tan² θ/2) − A (h − T)/2)."""
	width, height, length, ratio = 2.0, 0.8, 1.5, 0.6
	rock(density=ratio * density)
	if flat:
		corners = [(-width / 2, -height / 2), (width / 2, -height / 2), (width / 2, height / 2), (-width / 2, height / 2)]
		body, up, axis = polytope.polygon(corners, length), Vector3(0, 1, 0), Vector3(0, 0, 1)
	else:
		body, up, axis = polytope.cuboid((0, 0, 0), (width / 2, length / 2, height / 2)), Vector3(0, 0, 1), Vector3(0, -1, 0)
	number = O.bodies.append(body)
	O.engines = polytope.engines(gravity=-gravity * up)
	draft, level = ratio * height, 3.0
	engine = polytope.water(level=level)
	state, tilt = O.bodies[number].state, 0.1
	for turn in (tilt, -tilt, 0):
		state.ori = Quaternion(axis, turn)
		# the waterline passes the same point of the block's middle plane: the wedges on both sides are equal
		state.pos = level * up + (height / 2 - draft) * cos(turn) * up
		force, torque = engine.load(number)
		assert (force - weight * draft * width * length * up).norm() < 1e-12 * force.norm()
		if turn == 0:
			assert torque.norm() < 1e-12 * weight
			continue
		arm = width**3 / 12 * (1 + tan(turn) ** 2 / 2) - draft * width * (height - draft) / 2
		assert torque.dot(axis) == pytest.approx(-weight * length * sin(turn) * arm, rel=1e-12)
		assert (torque - torque.dot(axis) * axis).norm() < 1e-12 * weight


@pytest.mark.parametrize('flat', [False, True])
def testABlockComesToRestAtItsDraft(flat):
	"""Dropped askew it rights itself; let go slightly, it heaves with the period 2π √(T/g)."""
	rock(density=600)
	half = 0.5
	body = polytope.polygon([(-1, -half), (1, -half), (1, half), (-1, half)], 1) if flat else polytope.cuboid((0, 0, 0), (1, 1, half))
	axis = 1 if flat else 2
	number = O.bodies.append(body)
	state = O.bodies[number].state
	state.ori = Quaternion(Vector3(0, 0, 1) if flat else Vector3(0, 1, 0), 0.3)
	O.engines = polytope.engines(damping=0.3, timeStepper=False)
	O.dt = 2e-3
	polytope.water(level=0)
	O.run(20000, wait=True)
	assert state.pos[axis] == pytest.approx(half - 0.6, abs=1e-6)
	assert abs(state.ori.toAxisAngle()[1]) < 1e-6
	O.engines[-1].damping = 0
	state.vel = state.angVel = Vector3.Zero
	state.pos = state.pos + 0.01 * Vector3(0, flat, not flat)
	O.run(round(sqrt(0.6 / gravity) * pi / O.dt), wait=True)  # half a period
	assert state.pos[axis] == pytest.approx(half - 0.6 - 0.01, abs=2e-5)


def faceOf(number, *outward):
	"""Chooses the face of a body with this normal."""
	towards = np.array(outward) / np.linalg.norm(outward)
	return lambda face: face.body == number and face.normal @ towards > 0.999


def hoekBray(flat, waterInCrack):
	"""Rock above a plane of 35° in a face of 60° and 60 m, behind it a tension crack of 14 m; the toe is the origin. (block, weight, length
	of the plane, uplift, thrust)."""
	high, face, plane, crack, cohesion, friction = 60.0, radians(60), radians(35), 14.0, 1e5, radians(35)
	back = (high - crack) / tan(plane)
	rock(density=26e3 / gravity, frictionAngle=friction, cohesion=cohesion, residualCohesion=cohesion)
	at = (lambda x, up: (x, up, 0)) if flat else (lambda x, up: (x, 0, up))
	if flat:
		block = polytope.polygon([(0, 0), (back, high - crack), (back, high), (high / tan(face), high)], 1)
		base = polytope.polygon([(-9, -9 * tan(plane)), (-9, -20), (90, -20), (90, 90 * tan(plane))], 1, fixed=True)
	else:
		ends = [(0, 1, 0), (0, -1, 0)]
		block = polytope.fromHalfSpaces(
			[at(sin(plane), -cos(plane)), at(-sin(face), cos(face)), at(0, 1), at(1, 0), *ends], [0, 0, high, back, 0.5, 0.5]
		)
		base = polytope.fromHalfSpaces(
			[at(-sin(plane), cos(plane)), at(0, -1), at(1, 0), at(-1, 0), *ends], [0, 80, 100, 60, 5, 5], fixed=True
		)
	O.bodies.append(base)
	number = O.bodies.append(block)
	O.engines = polytope.engines()
	foot = high - crack
	polytope.water(level=foot + waterInCrack, faces=faceOf(number, 1, 0, 0))
	polytope.water(pressures=[(at(back, foot), weight * waterInCrack), (at(0, 0), 0)], faces=faceOf(number, *at(sin(plane), -cos(plane))))
	length, pressed = foot / sin(plane), float(O.bodies[number].state.mass) * gravity
	uplift, thrust = weight * waterInCrack * length / 2, weight * waterInCrack**2 / 2
	strength = cohesion * length + (pressed * cos(plane) - uplift - thrust * sin(plane)) * tan(friction)
	return number, strength / (pressed * sin(plane) + thrust * cos(plane)), uplift, thrust


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.filterwarnings('ignore:gravity at once')
def testTheSlopeOfHoekAndBrayWithWaterInItsTensionCrack(flat):
	"""1.2768 with 7 m of water in the crack and a pressure along the plane that falls to zero at the toe (Hoek & Bray 1981, chapter 7)."""
	number, factor, uplift, thrust = hoekBray(flat, 7.0)
	assert factor == pytest.approx(1.2768, abs=5e-5)
	crack, plane = [one for one in O.engines if isinstance(one, PolytopeWater)]
	up = Vector3(0, flat, not flat)
	assert (crack.load(number)[0] - Vector3(-thrust, 0, 0)).norm() < 1e-10 * thrust
	assert (plane.load(number)[0] - uplift * (cos(radians(35)) * up - Vector3(sin(radians(35)), 0, 0))).norm() < 1e-10 * uplift
	polytope.settle()
	found = StrengthReduction([number], steps=(0.05, 0.01)).run()
	assert found.factor == pytest.approx(factor, abs=0.01)


@pytest.mark.parametrize('drained', [False, True])
@pytest.mark.parametrize('margin', [0.99, 1.01])
@pytest.mark.filterwarnings('ignore:soft joint')  # of a slice of 1 m, across it
def testADamSlidesAtItsFactorWithUplift(drained, margin):
	"""(W − U) tan φ / H: thrust of 9 m of water, uplift under the base that falls to zero at the toe, with a drain 2 m from the heel to a
	third of it there."""
	wide, high, deep = 8.0, 10.0, 9.0
	pressures = [((0, 0, 0), weight * deep), ((2, 0, 0), weight * deep / 3), ((wide, 0, 0), 0)]
	uplift, thrust = weight * (21 if drained else 36), weight * deep**2 / 2
	load = 2400 * gravity * wide * high
	rock(density=2400, frictionAngle=np.arctan(margin * thrust / (load - uplift)))
	O.bodies.append(polytope.cuboid((4, 0, -1), (20, 3, 1), fixed=True))
	dam = O.bodies.append(polytope.cuboid((wide / 2, 0, high / 2), (wide / 2, 0.5, high / 2)))
	O.engines = polytope.engines(damping=0.4)
	side = polytope.water(level=deep, faces=faceOf(dam, -1, 0, 0))
	base = polytope.water(pressures=pressures if drained else pressures[::2], faces=faceOf(dam, 0, 0, -1))
	assert (side.load(dam)[0] - Vector3(thrust, 0, 0)).norm() < 1e-12 * thrust
	assert (moment(side.load(dam), dam, (0, 0, 0)) - Vector3(0, thrust * deep / 3, 0)).norm() < 1e-12 * thrust * high
	assert (base.load(dam)[0] - Vector3(0, 0, uplift)).norm() < 1e-12 * uplift
	arm = (12 * 5 / 6 + 9 * 4) / 21 if drained else wide / 3  # a trapezoid and a triangle
	assert (moment(base.load(dam), dam, (0, 0, 0)) - Vector3(0, -uplift * arm, 0)).norm() < 1e-12 * uplift * wide
	polytope.settle()
	O.run(4000, wait=True)
	assert (O.bodies[dam].state.vel.norm() < 1e-6) == (margin > 1), O.bodies[dam].state.vel


@pytest.mark.parametrize('flat', [False, True])
def testABlockUnderWaterPressesWithItsEffectiveWeight(flat):
	"""The block is still held on a slope of 25° by friction of 26°, since water takes its share of both; the joint below is as wet as the rest."""
	dip = radians(25)
	rock(frictionAngle=radians(26))
	if flat:
		O.bodies.append(polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], 1, fixed=True))
		number = O.bodies.append(polytope.polygon([(-1, 0), (1, 0), (1, 0.5), (-1, 0.5)], 1))
	else:
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
		number = O.bodies.append(polytope.cuboid((0, 0, 0.25), (1, 0.5, 0.25)))
	up = Vector3(0, flat, not flat)
	O.engines = polytope.engines(gravity=gravity * (Vector3(sin(dip), 0, 0) - cos(dip) * up), damping=0.4)
	polytope.water(level=20)
	polytope.settle()
	joint = O.interactions[0, number].phys
	effective = (2600 - density) * gravity * 1.0
	assert joint.normalForce.norm() == pytest.approx(effective * cos(dip), rel=1e-4)
	assert joint.shearForce.norm() == pytest.approx(effective * sin(dip), rel=1e-4)
	O.run(2000, wait=True)
	assert O.bodies[number].state.vel.norm() < 1e-6


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('margin', [0.98, 1.02])
def testALayerOfBlocksWithSeepageAlongTheSlope(margin, flat):
	"""Infinite slope with water up to its surface that flows along it (Taylor 1948): p = ρ g d cos β at the depth d across it, factor (γ −
	γ_w) tan φ / (γ tan β)."""
	slope, deep, wide, number = radians(15), 2.0, 3.0, 5
	rock(density=2200, frictionAngle=np.arctan(margin * 2200 / (2200 - density) * tan(slope)))
	up = Vector3(0, flat, not flat)
	if flat:
		O.bodies.append(polytope.polygon([(-9, -1), (24, -1), (24, 0), (-9, 0)], 1, fixed=True))
		blocks = [polytope.polygon([(x, 0), (x + wide, 0), (x + wide, deep), (x, deep)], 1) for x in wide * np.arange(number)]
	else:
		O.bodies.append(polytope.cuboid((7, 0, -0.5), (16, 9, 0.5), fixed=True))
		blocks = [polytope.cuboid((x + wide / 2, y, deep / 2), (wide / 2, 1, deep / 2)) for x in wide * np.arange(number) for y in (-1, 1)]
	ids = O.bodies.append(blocks)
	O.engines = polytope.engines(gravity=gravity * (sin(slope) * Vector3(1, 0, 0) - cos(slope) * up), damping=0.4)
	water = polytope.water(pressures=[(deep * up, 0), (0 * up, weight * deep * cos(slope))])
	area = wide * (1 if flat else 2)
	for one in ids:
		uplift = weight * deep * cos(slope) * area
		assert (water.load(one)[0] - uplift * up).norm() < 1e-12 * uplift
	polytope.settle()
	O.run(4000, wait=True)
	fastest = max(O.bodies[one].state.vel.norm() for one in ids)
	assert (fastest < 1e-6) == (margin > 1), fastest


def testBelowATableThatSlopesWaterPushesDownTheSlope():
	"""−∫ grad p dV: ρ g V upwards and ρ g V times the slope towards the lower side, across a kink the sum of both parts; of a section, and
	of triangles."""
	rock()
	number = O.bodies.append(polytope.cuboid((0.25, 0.1, -4), (1, 1, 1)))
	O.engines = polytope.engines()
	section = [(10, 0, 1), (-10, 0, 4), (0, 0, 0)]  # in any order
	left, right = 0.75 * 4, 1.25 * 4  # volumes
	expected = weight * Vector3(0.4 * left - 0.1 * right, 0, left + right)
	first = polytope.water(level=section)
	force, _ = first.load(number)
	first.dead = True
	assert (force - expected).norm() < 1e-12 * expected.norm()
	surface = [(x, y, 0.4 * -x if x < 0 else 0.1 * x) for x in (-10, 0, 10) for y in (-9, 9)]
	second = polytope.water(level=surface)
	force, torque = second.load(number)
	second.dead = True
	assert (force - expected).norm() < 1e-12 * expected.norm()
	assert abs(torque[0]) < 1e-10 * weight and abs(torque[2]) < 1e-10 * weight
	beyond = polytope.water(level=[(-9, 0, 0), (-8, 0, 2)]).load(number)  # level beyond its ends
	assert (beyond[0] - Vector3(0, 0, weight * 8)).norm() < 1e-12 * weight * 8


def testTheEngineIsSavedWithTheScene(tmp_path):
	rock()
	number = O.bodies.append(polytope.regular(20, 1))
	O.engines = polytope.engines()
	polytope.water(level=[(-5, 0, 0.3), (0, 0, 0.1), (5, 0, 0.2)], faces=lambda face: face.normal[0] <= 0.2)
	polytope.water(level=0.5, faces=lambda face: face.normal[0] > 0.2 and face.area > 0)
	O.engines = polytope.engines()  # keeps the water
	before = [engine.load(number) for engine in O.engines if isinstance(engine, PolytopeWater)]
	O.save(str(tmp_path / 'scene.yade.gz'))
	O.reset()
	O.load(str(tmp_path / 'scene.yade.gz'))
	after = [engine.load(number) for engine in O.engines if isinstance(engine, PolytopeWater)]
	assert len(before) == 2 and before == after and before[0] != before[1] and before[1][0].norm() > 0


def testFacesOfAJointSetAreThoseThatJointedRockNames():
	rock()
	normals = np.concatenate([np.eye(3), -np.eye(3)])
	mass = polytope.jointedRock(normals, [1] * 6, [polytope.JointSet(0, 0, 0.7), polytope.JointSet(radians(90), 0, 0.7)])
	ids = mass.append()
	assert all(len(blocks) == 1 for blocks in mass.bodies)
	joint = {
		(number, plane): made for number, (block,) in zip(ids, mass.bodies, strict=True) for plane, made in enumerate(mass.faces[block])
	}
	O.engines = polytope.engines()
	flat = polytope.water(level=1, faces=lambda face: joint[face.body, face.plane] >= 0 and mass.sets[joint[face.body, face.plane]] == 0)
	count = sum(mass.sets[made[made >= 0]].tolist().count(0) for made in mass.faces)
	assert len(flat.wetBodies) == count > 4
	for number, plane in zip(flat.wetBodies, flat.wetPlanes, strict=True):
		body = O.bodies[number]
		assert abs((body.state.ori * body.shape.normals[plane])[2]) == pytest.approx(1, abs=1e-12)


def testCheckTellsOfWaterThatActsTooLate():
	rock()
	O.bodies.append(polytope.regular(20, 1))
	O.engines = polytope.engines()
	engine = polytope.water(level=0)
	assert not [one for one in polytope.check(O) if one.what == 'water']
	O.engines = [one for one in O.engines if one is not engine and not isinstance(one, PolytopeWater)] + [engine]
	assert 'after the InteractionLoop' in polytope.check(O)['water'].advice


@pytest.mark.parametrize(
	'arguments, words',
	[
		(dict(), 'level: give either level'),
		(dict(level=1, pressures=[((0, 0, 0), 1), ((1, 0, 0), 1)]), 'level: give either level'),
		(dict(level=inf), 'level: must be finite'),
		(dict(level=nan), 'level: must be finite'),
		(dict(level='high'), 'level: '),
		(dict(level=[(0, 0, 1)]), 'level: must be two points at least'),
		(dict(level=[(0, 0, 1), (0, 0, 2)]), 'level: points must be one after the other'),
		(dict(level=[(0, 0, nan), (1, 0, 2)]), 'level: must be finite'),
		(dict(level=[(0, 0, 5), (1, 0, 5), (0, 1, 5)]), 'level: seen from above the points do not reach'),
		(dict(level=-1.5), 'level: no face gets any pressure; the bodies reach from'),
		(dict(level=1, density=0), 'density: must be above 0'),
		(dict(level=1, density=-1000), 'density: must be above 0'),
		(dict(level=1, density=inf), 'density: must be above 0'),
		(dict(level=2, faces=lambda face: True), 'level: 2 m is above the ground, 1 m: .*level=1'),
		(dict(level=1, faces=lambda face: False), 'faces: is true of no face'),
		(dict(level=1, faces=3), 'faces: must be a function'),
		(dict(pressures=[((0, 0, 0), 1e5)]), 'pressures: must be two points'),
		(dict(pressures=[((0, 0, 0), 1e5), ((1, 0, 0), -1)]), 'pressures: must be finite and at least 0'),
		(dict(pressures=[((0, 0, 0), 1e5), ((0, 0, 0), 1)]), 'pressures: the first and the last point are the same'),
		(dict(pressures=[((0, 0, 0), 1), ((2, 0, 0), 1), ((1, 0, 0), 1)]), 'pressures: points must be one after the other'),
		(dict(pressures=5), 'pressures: must be pairs'),
		(dict(pressures=[((0, 0, 0), 0), ((1, 0, 0), 0)]), 'pressures: no face gets any pressure'),
	],
)
def testWhatIsRefused(arguments, words):
	rock()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	O.engines = polytope.engines()
	with pytest.raises(ValueError, match=f'^{words}'):
		polytope.water(**arguments)
	assert not any(isinstance(engine, PolytopeWater) for engine in O.engines)


def testWhatTheSceneMustHave():
	rock()
	with pytest.raises(ValueError, match=r'^engines: set O.engines first.*water acts before NewtonIntegrator'):
		polytope.water(level=1)
	O.engines = polytope.engines(gravity=(0, 0, 0))
	with pytest.raises(ValueError, match='^O.bodies: there are no polytopes'):
		polytope.water(level=1)
	number = O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	with pytest.raises(ValueError, match='^level: NewtonIntegrator has no gravity'):
		polytope.water(level=1)
	engine = polytope.water(pressures=[((0, 0, 0), 1e5), ((1, 0, 0), 1e5)])
	assert engine.load(number)[0].norm() < 1e-9  # both ends of the line are on faces
	with pytest.raises(ValueError, match='^id: there is no body 7'):
		engine.load(7)
	O.periodic = True
	with pytest.raises(ValueError, match='^O.periodic: '):
		polytope.water(level=1)
	with pytest.raises(ValueError, match='^values: must be as many as points'):
		PolytopeWater(points=[Vector3.Zero])


def testAClumpOfPartsThatOverlapIsRefused():
	O.materials.append(RockJointMat(density=1000, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6))
	polytope.clump([polytope.cuboid((0, 0, 0), (1, 1, 0.5)), polytope.cuboid((0, 0, 0.5), (1, 1, 0.5))])
	O.engines = polytope.engines()
	engines = len(O.engines)
	with pytest.raises(ValueError, match='8000 kg and the clump 6000 kg, so they overlap'):
		polytope.water(level=20)
	assert len(O.engines) == engines


@pytest.mark.parametrize('arguments', [dict(level=1), dict(pressures=[((0, 0, 0), 1e5), ((1, 0, 0), 0)])])
def testTheSameWaterTwiceIsRefused(arguments):
	rock()
	block = O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	O.engines = polytope.engines()
	first = polytope.water(**arguments)
	name = next(iter(arguments))
	for faces in (None, lambda face: face.normal[2] > 0.9 or face.normal[0] < -0.9):
		with pytest.raises(
			ValueError, match=rf'^{name}: on \d faces, first face \d of body {block}, another water presses already.*dead=True'
		):
			polytope.water(**arguments, faces=faces)
	assert sum(isinstance(engine, PolytopeWater) for engine in O.engines) == 1
	force = first.load(block)[0]
	first.dead = True
	assert polytope.water(**arguments).load(block)[0] == force


@pytest.mark.parametrize('flat', [False, True])
def testAWaterTableThatRoseReplacesTheOneBefore(flat):
	"""Two tables would press with the sum of both: the second is refused until the first is taken away."""
	rock()
	block = O.bodies.append(polytope.polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)]) if flat else polytope.cuboid((0, 0, 0), (1, 1, 1)))
	O.engines = polytope.engines(**(dict(gravity=(0, -gravity, 0)) if flat else {}))
	low, engines = polytope.water(level=0), list(O.engines)
	with pytest.raises(ValueError, match='^level: on .* faces.*another water presses already'):
		polytope.water(level=0.5)
	assert O.engines == engines
	low.dead = True
	assert polytope.water(level=0.5).load(block)[0].norm() == pytest.approx(weight * 2 * 1.5 * (1 if flat else 2), rel=1e-12)


def testWatersOfTwoLevelsOnOneFaceAreTakenWhereTheyDoNotMeet():
	"""Pressure in the upper part of a face by one, in its lower part by the other: nothing adds up."""
	rock()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	O.engines = polytope.engines()

	def front(face):
		return face.normal[0] > 0.9

	polytope.water(pressures=[((0, 0, 1), 1e4), ((0, 0, 0.3), 0)], faces=front)
	assert polytope.water(level=-0.4, faces=front)


def testADensityInOtherUnitsIsTold():
	rock()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	O.engines = polytope.engines()
	with pytest.warns(UserWarning, match='density: 1 kg/m³ is no water'):
		polytope.water(level=3, density=1)
