# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies with margins of an extension on YADE's boxes and facets, and on supports of several pieces: closed forms, both colliders, seams, slopes, corners of meshes."""

import math

import pytest
from test_extensions import inYade, rounded  # noqa: F401, as fixtures
from test_third_party import rods, startOfRods  # noqa: F401, as fixtures

floors = """
from yade import polytope, utils, Quaternion, Vector3
def steps(count):  # O.run waits in tenths of a second
	for _ in range(count): O.step()
def floor(kind, width=0.5, columns=8, q=Quaternion.Identity):
	box = lambda x, y, half: utils.box(q * Vector3(x, y, -0.5), (half, half, 0.5), orientation=q, fixed=True)
	plate = lambda x, y, half: polytope.cuboid(q * Vector3(x, y, -0.5), (half, half, 0.5), orientation=q, fixed=True)
	if kind == 'box': return [box(0, 0, 4)]
	if kind in ('boxes', 'plates'):
		places = [(width * (i + 0.5), width * (j + 0.5)) for i in range(-columns, columns) for j in range(-2, 2)]
		return [(box if kind == 'boxes' else plate)(x, y, width / 2) for x, y in places]
	made = []
	for i in range(-columns, columns):
		for j in range(-2, 2):
			a, b, c, d = [q * Vector3(width * (i + p), width * (j + s), 0) for p, s in ((0, 0), (1, 0), (1, 1), (0, 1))]
			made += [utils.facet(three, fixed=True) for three in ((a, b, c), (a, c, d))]
	return made
"""

start = (
	"""
from yade import polytope, utils, Quaternion, Vector3
import math
polytope.load(sys.argv[1])
h, r, k = 0.4, 0.1, 1e8
def material(friction=0.0):
	O.materials.append(RockJointMat(density=2600, normalStiffness=k, shearStiffness=k, frictionAngle=friction))
def rounded(center, half=(h, h, h), radius=r, orientation=Quaternion.Identity, **more):
	return polytope.withShape(polytope.cuboid(center=center, extents=half, orientation=orientation, **more), RoundedPolytope(radius=radius))
"""
	+ floors
	+ """
def perContact(**more):
	return polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False), **more)
def insertionSort():
	return InsertionSortCollider([Bo1_Polytope_Aabb(), Bo1_Box_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb(), Bo1_Sphere_Aabb()], verletDist=0.01)
def withoutLoss():
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.engines[2].lawDispatcher.functors[0].shearDamping = 0
def kinetic(state):
	spin = state.ori.conjugate() * state.angVel
	return float(state.mass * state.vel.squaredNorm() + sum(i * w * w for i, w in zip(state.inertia, spin))) / 2
"""
)


def testDepthsHaveTheirClosedForms(rounded):  # noqa: F811
	"""Faces, an edge over a face, a corner on a face, corner on corner, on a box and on a triangle, both fixed and free: 0.01 m deep, and
	the normal. With a margin of 1e-3 m the cores overlap."""
	script = (
		start
		+ """
s2, s3 = math.sqrt(2), math.sqrt(3)
one, x = Quaternion.Identity, Quaternion((1, 0, 0), math.pi / 4)
corner = Quaternion(Vector3(1, -1, 0).normalized(), math.acos(1 / s3))
box = lambda **more: utils.box((0, 0, -h), (h, h, h), **more)
triangle = lambda **more: utils.facet([(-2, -2, 0), (2, -2, 0), (0, 2, 0)], **more)
depth, seen = 0.01, []
def first(make, normal):
	O.reset(); material()
	O.bodies.append(make())
	O.engines = perContact(collider=insertionSort(), timeStepper=False)
	O.dt = 1e-9
	O.step()
	(c,) = [i for i in O.interactions if i.isReal]
	towards = 1 if c.id1 == 0 else -1
	seen.append([float(c.geom.penetrationDepth) - depth, float((towards * c.geom.normal - Vector3(normal)).norm())])
for make in (box, triangle):
	for radius in (r, 1e-3):
		for q, low in ((one, h), (x, h * s2), (corner, h * s3)):
			first(lambda: [make(fixed=True), rounded((0, 0, low + radius - depth), radius=radius, orientation=q)], (0, 0, 1))
	first(lambda: [make(), rounded((0, 0, h + r - depth), fixed=True)], (0, 0, 1))
first(lambda: [box(fixed=True), rounded(Vector3(1, 1, 1) * (h + (r - depth) / s3) + Vector3(h, h, 0))], Vector3(1, 1, 1) / s3)
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	assert len(seen) == 15
	for depth, normal in seen:
		assert depth == pytest.approx(0, abs=1e-12) and normal == pytest.approx(0, abs=1e-9)


def testBothCollidersSeeTheFirstContactAtOnce(rounded):  # noqa: F811
	"""With a box that moves to meet it, and a facet: within a step's way of the closed form."""
	script = (
		start
		+ """
seen = []
for make in (lambda: utils.box((0, 0, -0.5), (0.5, 0.5, 0.5), fixed=True), lambda: utils.facet([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], fixed=True)):
	for kind in (insertionSort, lambda: None):
		O.reset(); material()
		O.bodies.append([make(), rounded((0, 0, h + r + 0.05))])
		O.bodies[0].state.vel, O.bodies[1].state.vel = (0, 0, 0.5), (0, 0, -0.5)
		O.engines = perContact(collider=kind(), gravity=(0, 0, 0), damping=0, timeStepper=False)
		O.dt = 1e-4
		while not O.interactions.countReal() and O.iter < 2500: O.step()
		seen.append([O.iter, h + r - float(O.bodies[1].state.pos[2] - (O.bodies[0].state.pos[2] + (0.5 if isinstance(O.bodies[0].shape, Box) else 0)))])
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	for steps, depth in seen:
		assert steps == pytest.approx(502, abs=2) and -1e-12 <= depth < 2.1e-4, seen


@pytest.mark.parametrize('kind', ['box', 'boxes', 'plates', 'facets'])
def testItComesToRestOnSeams(rounded, kind):  # noqa: F811
	"""Let fall with a tilt over seams, with friction, margins from below the depth of the contact to a body's size: upright, still, with
	its weight, under both colliders; check finds nothing wrong before."""
	script = (
		start
		+ """
seen = []
for collider in (insertionSort, lambda: None):
	for radius in (1e-3, 0.1):
		O.reset(); material(0.5)
		O.bodies.append(floor(sys.argv[2], columns=2))
		turned = Quaternion((0, 0, 1), 0.3) * Quaternion(Vector3(3, 2, 0).normalized(), 0.003)
		body = O.bodies[O.bodies.append(rounded((0.07, 0.05, h + radius + 3e-3), radius=radius, orientation=turned))]
		O.engines = perContact(collider=collider())
		found = repr(polytope.check(O)).splitlines()[0]
		O.run(12000, True)
		most = kinetic(body.state)
		push, weight = float(O.forces.f(body.id)[2]), 9.81 * float(body.state.mass)
		shares = sum(float(c.geom.share) for c in O.interactions if c.isReal)
		seen.append([found, most / (weight * 3e-3), push / weight, float((body.state.ori * Vector3(0, 0, 1)).cross(Vector3(0, 0, 1)).norm()), shares, O.interactions.countReal()])
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded, kind)
	for found, energy, push, tilt, shares, contacts in seen:
		assert found == 'nothing was found that is wrong'
		assert energy < 1e-10 and tilt < 1e-6, seen
		assert push == pytest.approx(1, rel=1e-6) and shares == pytest.approx(1, rel=1e-6), seen
		assert contacts == 1 if kind == 'box' else contacts > 3


@pytest.mark.parametrize('kind', ['boxes', 'plates', 'facets'])
def testItSlidesOverSeamsAsOverOneFace(rounded, kind):  # noqa: F811
	"""Without friction at 1 m/s over pieces of 0.5 m, flat and on an edge and a corner: the weight all the way, no motion up, aside, or
	about an axis."""
	script = (
		start
		+ """
seen = []
for radius, tilt in ((r, 0), (1e-3, 0), (2e-5, 0), (r, (1, 0, 0)), (r, (1, 1, 0))):
	O.reset(); material()
	O.bodies.append(floor(sys.argv[2]))
	q = Quaternion((0, 0, 1), 0.3) * (Quaternion(Vector3(tilt).normalized(), 0.6) if tilt else Quaternion.Identity)
	body = rounded((0, 0, 0), radius=radius, orientation=q)
	weight = 9.81 * float(body.state.mass)
	low = min(float((q * v)[2]) for v in body.shape.vertices)
	body.state.pos = (-1, 0.05, radius - low - weight / k)
	body.state.vel = (1, 0, 0)
	if tilt: body.state.blockedDOFs = 'XYZ'
	O.bodies.append(body)
	O.engines = perContact(damping=0)
	withoutLoss()
	most = [0, 0, 0]
	while float(body.state.pos[0]) < 0.2:
		steps(3)
		off = abs(float(O.forces.f(body.id)[2]) / weight - 1)
		most = [max(a, b) for a, b in zip(most, (off, float((body.state.vel - Vector3(1, 0, 0)).norm()), float(body.state.angVel.norm())))]
	seen.append(most)
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded, kind)
	for push, velocity, turning in seen:
		assert push < 1e-3 and velocity < 1e-4 and turning < 1e-4, seen


def testItSlidesDownASlopeByTheAngleOfFriction(rounded):  # noqa: F811
	"""On 20 boxes and on facets, tilted: at rest below the angle; above it with g (sin α − tan φ cos α)."""
	script = (
		start
		+ """
seen = []
for kind in ('boxes', 'facets'):
	for slope in (0.25, 0.35):
		O.reset(); material(0.3)
		q = Quaternion((0, 1, 0), slope)
		O.bodies.append(floor(kind, q=q))
		body = O.bodies[O.bodies.append(rounded(q * Vector3(-1.2, 0.05, h + r - 1e-4), orientation=q))]
		O.engines = perContact(damping=0)
		O.run(2000, True)
		way = lambda: float((q.conjugate() * body.state.pos)[0])
		start, came, at = O.time, float((q.conjugate() * body.state.vel)[0]), way()
		while O.time - start < 0.5: steps(100)
		seen.append([slope, (float((q.conjugate() * body.state.vel)[0]) - came) / (O.time - start), way() - at])
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	for slope, acceleration, way in seen:
		if slope < 0.3:
			assert abs(acceleration) < 1e-3 and abs(way) < 1e-4, seen
		else:
			assert way > 0.04 and acceleration == pytest.approx(9.81 * (math.sin(slope) - math.tan(0.3) * math.cos(slope)), rel=2e-3), seen


def testARodRollsOverSeams(rods):  # noqa: F811
	"""On boxes and facets, along and askew to their edges, without slip: it goes on at its speed, with its weight, and does not leave its plane."""
	script = (
		startOfRods
		+ floors
		+ """
seen = []
for kind in ('boxes', 'facets'):
	for turn in (math.pi / 2, 1.2):
		O.reset(); material(1e8)
		O.bodies.append(floor(kind))
		axis = Vector3(math.cos(turn), math.sin(turn), 0)
		body = O.bodies[O.bodies.append(rod((-0.15, 0.1, 0.1), axis, length=1.2))]
		weight = 9.81 * float(body.state.mass)
		body.state.pos -= Vector3(0, 0, weight / 1e8)
		along = axis.cross(Vector3(0, 0, 1))
		along = along if along[0] > 0 else -along
		body.state.vel, body.state.angVel = along, Vector3(0, 0, 1).cross(along) / 0.1
		O.engines = polytope.engines(damping=0)
		O.engines[2].lawDispatcher.functors[0].normalDamping = 0
		off = 0
		while float(body.state.pos[0]) < 0.15:
			steps(7)
			off = max(off, abs(float(O.forces.f(body.id)[2]) / weight - 1))
		seen.append([off, float((body.state.vel - along).norm()), float((body.state.angVel - Vector3(0, 0, 1).cross(along) / 0.1).norm()) * 0.1])
answer(seen)
"""
	)
	seen, _ = inYade(script, rods)
	for push, velocity, turning in seen:
		assert push < 1e-4 and velocity < 1e-4 and turning < 1e-4, seen


def testInAContainerOfAMesh(rounded):  # noqa: F811
	"""A box of facets, open above: bodies that fall in it come to rest on its floor and against its walls, and none leaves it; the floor
	has their weight."""
	script = (
		start
		+ """
material(0.4)
corners = [(x, y, z) for x in (-0.9, 0.9) for y in (-0.9, 0.9) for z in (0, 3)]
quads = [(0, 2, 6, 4), (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6)]
O.bodies.append([utils.facet([Vector3(*corners[a]) for a in three], fixed=True) for q in quads for three in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))])
for n in range(3):
	O.bodies.append(rounded((0.3 * (n % 2) - 0.1, 0.1, 0.8 + 1.3 * n), half=(0.25, 0.2, 0.3), orientation=Quaternion(Vector3(1, 2, n).normalized(), 0.5 + n)))
bodies = [body for body in O.bodies if isinstance(body.shape, RoundedPolytope)]
O.engines = perContact(damping=0.3)
O.run(40000, True)
inside = all(abs(body.state.pos[0]) < 0.9 and abs(body.state.pos[1]) < 0.9 and 0.2 < body.state.pos[2] < 3 for body in bodies)
weight = 9.81 * float(sum(body.state.mass for body in bodies))
onMesh = sum(float(O.forces.f(body.id)[2]) for body in O.bodies if isinstance(body.shape, Facet))
answer([inside, onMesh / weight, sum(kinetic(body.state) for body in bodies) / weight])
"""
	)
	(inside, push, energy), _ = inYade(script, rounded)
	assert inside and push == pytest.approx(-1, rel=1e-3) and energy < 1e-6


def testABlockDroppedOnABoxLeavesNoFaster(rounded):  # noqa: F811
	"""The time step before contact is that of the stiffness: without dampers it comes back to its height, not above."""
	script = (
		start
		+ """
seen = []
for kind in ('box', 'boxes', 'facets'):
	O.reset(); material()
	O.bodies.append(floor(kind, columns=2))
	body = O.bodies[O.bodies.append(rounded((0.1, 0.05, h + r + 0.1)))]
	O.engines = perContact(damping=0)
	withoutLoss()
	while not O.interactions.countReal(): O.step()
	while O.interactions.countReal(): O.step()
	seen.append(float(body.state.vel[2]) / math.sqrt(2 * 9.81 * 0.1))
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	assert seen == pytest.approx([1, 1, 1], rel=0.02)


def testABoxThatMovesTakesABodyAlong(rounded):  # noqa: F811
	"""A fixed box with a velocity: a body on it comes to that velocity by friction, with μ g; a free box lies on a fixed rounded body with
	its weight."""
	script = (
		start
		+ """
material(0.3)
O.bodies.append(utils.box((0, 0, -0.5), (4, 4, 0.5), fixed=True))
O.bodies.append(rounded((0, 0, h + r - 1e-4)))
O.engines = perContact(damping=0)
O.run(3000, True)
O.bodies[0].state.vel = (1, 0, 0)
start = O.time
while O.time - start < 0.1: steps(20)
rate = float(O.bodies[1].state.vel[0]) / (O.time - start)
while O.time - start < 0.6: steps(20)
carried = float(O.bodies[1].state.vel[0])
swing = 9.81 * math.tan(0.3) * math.sqrt(float(O.bodies[1].state.mass) / k)  # of the shear spring, which lets go at its limit, without dampers
O.reset(); material(0.3)
O.bodies.append([utils.box((0.1, 0, h + r + 0.2), (0.3, 0.3, 0.2)), rounded((0, 0, 0), fixed=True)])
O.engines = perContact()
O.run(6000, True)
answer([rate, carried, swing, float(O.forces.f(1)[2]) / (9.81 * float(O.bodies[0].state.mass))])
"""
	)
	(rate, carried, swing, push), _ = inYade(script, rounded)
	assert rate == pytest.approx(9.81 * math.tan(0.3), rel=0.02)
	assert swing < 0.02 and carried == pytest.approx(1, abs=swing) and push == pytest.approx(-1, rel=1e-3)


def testARodOnARidgeAndInAValley(rods):  # noqa: F811
	"""Ridge and valley are made of facets, and of wedges: across a ridge it has one spring for all pieces that meet there; in a valley each
	side has one of its own, W / (2 cos 45°)."""
	script = (
		startOfRods
		+ floors
		+ """
def roof(kind, sign):  # sign 1: a ridge along x, −1: a valley
	made = []
	for x in (-0.6, 0, 0.6):
		for side in (-1, 1):
			top = [Vector3(x + dx, 0, 0) for dx in (-0.3, 0.3)]
			low = [Vector3(x + dx, side * 0.8, -sign * 0.8) for dx in (-0.3, 0.3)]
			if kind == 'facets':
				made += [utils.facet(three, fixed=True) for three in ((top[0], top[1], low[0]), (top[1], low[1], low[0]))]
			else:
				under = [one + Vector3(0, side * (sign < 0) * 0.4, -1 if sign > 0 else -1) for one in (*top, *low)]
				made.append(polytope.fromVertices([*top, *low, *under], fixed=True))
	return made
seen = []
for kind in ('facets', 'wedges'):
	for sign, along in ((1, (0, 1, 0)), (-1, (1, 0, 0))):
		O.reset(); material(1e8); O.materials[-1].frictionAngle = 0
		O.bodies.append(roof(kind, sign))
		body = O.bodies[O.bodies.append(rod((0.1, 0, 0.1 * (1 if sign > 0 else math.sqrt(2)) + 1e-5), along, length=0.8))]
		body.state.blockedDOFs = 'xyXYZ'
		O.engines = polytope.engines()
		O.run(4000, True)
		weight = 9.81 * float(body.state.mass)
		sides = {}
		for c in O.interactions:
			if not c.isReal: continue
			towards = -1 if c.id1 == body.id else 1
			key = round(float(towards * c.geom.normal[1]), 3)
			share, force = sides.get(key, (0, 0))
			sides[key] = share + float(c.geom.share), force + float(c.geom.penetrationDepth * c.phys.kn) / weight
		seen.append([float(O.forces.f(body.id)[2]) / weight, sorted(sides.items())])
answer(seen)
"""
	)
	seen, _ = inYade(script, rods)
	for k, (push, sides) in enumerate(seen):
		assert push == pytest.approx(1, rel=1e-6), seen
		if k % 2 == 0:
			((normal, (share, force)),) = sides
			assert normal == 0 and share == pytest.approx(1, rel=1e-6) and force == pytest.approx(1, rel=1e-6)
		else:
			assert [one[0] for one in sides] == pytest.approx([-math.sqrt(0.5), math.sqrt(0.5)], abs=2e-3)
			for _, (share, force) in sides:
				assert share == pytest.approx(1, rel=1e-3) and force == pytest.approx(math.sqrt(0.5), rel=1e-3)


def testARodThatSpinsIsStoppedAsALine(rods):  # noqa: F811
	"""About the vertical on a wall, a box and a floor of plates: by the moment μ N L/4 of a line."""
	script = (
		startOfRods
		+ floors
		+ """
seen = []
for kind in ('wall', 'box', 'plates'):
	O.reset(); material(1e8)
	O.bodies.append([utils.wall(0, axis=2, sense=1)] if kind == 'wall' else floor(kind, columns=3))
	body = O.bodies[O.bodies.append(rod((0.05, 0.1, 0.1 - 1e-5), length=1.2))]
	O.engines = polytope.engines(damping=0)
	O.run(1000, True)
	body.state.angVel = (0, 0, 20)
	start = O.time
	while O.time - start < 0.05: steps(5)
	came, start = float(body.state.angVel[2]), O.time
	while O.time - start < 0.3: steps(5)
	rate = (came - float(body.state.angVel[2])) / (O.time - start)
	seen.append(rate * float(body.state.inertia[2]) / (math.tan(0.5) * 9.81 * float(body.state.mass) * 1.2 / 4))
answer(seen)
"""
	)
	seen, _ = inYade(script, rods)
	assert seen == pytest.approx([1, 1, 1], rel=0.02)
