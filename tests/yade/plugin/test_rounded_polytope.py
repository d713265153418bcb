# SPDX-License-Identifier: GPL-2.0-or-later
"""The example of a shape of one's own, a polyhedron rounded by a ball: closed forms, both colliders, scenes."""

import math

import pytest
from test_extensions import inYade, project, rounded  # noqa: F401, as fixtures

start = """
from yade import polytope, Quaternion, Vector3
import math
polytope.load(sys.argv[1])
h, r = 0.4, 0.1
def material(stiffness=1e7):
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5))
def cube(center, radius=r, orientation=Quaternion.Identity, **more):
	body = polytope.cuboid(center=center, extents=(h,) * 3, orientation=orientation, **more)
	return polytope.withShape(body, RoundedPolytope(radius=radius)) if radius else body
def contacts():
	own = [Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom(), Ig2_Polytope_RoundedPolytope_PolytopeGeom(), Ig2_Sphere_RoundedPolytope_PolytopeGeom(), Ig2_Wall_RoundedPolytope_PolytopeGeom()]
	return own + [Ig2_Polytope_Polytope_PolytopeGeom(), Ig2_Wall_Polytope_PolytopeGeom()]
def bounds():
	return [Bo1_Polytope_Aabb(), Bo1_Wall_Aabb(), Bo1_Sphere_Aabb()]
def loop():
	return InteractionLoop(contacts(), [Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()])
"""


def testWithoutMarginsItIsTheContactOfTheHalfSpaces(rounded):  # noqa: F811
	"""0.01 m deep, just touching, apart: as of two plain polytopes, and no query fails."""
	script = (
		start
		+ """
sharp = lambda center, **more: polytope.withShape(polytope.cuboid(center=center, extents=(h,) * 3, **more), RoundedPolytope(radius=0.))
plain = lambda center, **more: polytope.cuboid(center=center, extents=(h,) * 3, **more)
seen = []
for gap in (-0.01, 0, 0.01):
	for below, above in ((plain, plain), (plain, sharp), (sharp, sharp)):
		O.reset(); material()
		O.bodies.append([below((0, 0, -h), fixed=True), above((0, 0, h + gap))])
		O.engines = [ForceResetter(), InsertionSortCollider(bounds(), verletDist=0), loop()]
		O.dt = 1e-9
		O.step()
		failed = sum(one.stats()['failures'] for one in O.engines[2].geomDispatcher.functors)
		seen.append([[float(i.geom.penetrationDepth) for i in O.interactions if i.isReal and i.geom.penetrationDepth > 1e-12], failed])
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	(deep,), _ = seen[0]
	assert deep == pytest.approx(0.01, rel=0.02)
	for k, (depths, failed) in enumerate(seen):
		assert failed == 0
		assert depths == ([pytest.approx(deep, rel=1e-9)] if k < 3 else [])


def testDepthsHaveTheirClosedForms(rounded):  # noqa: F811
	"""Faces, crossed edges, a corner on a face, corner on corner; with sharp bodies; with walls; with spheres: depth 0.01 m, and the normal."""
	script = (
		start
		+ """
s2, s3 = math.sqrt(2), math.sqrt(3)
one, depth = Quaternion.Identity, 0.01
x, y = Quaternion((1, 0, 0), math.pi / 4), Quaternion((0, 1, 0), math.pi / 4)
corner = Quaternion(Vector3(1, -1, 0).normalized(), math.acos(1 / s3))
seen = []
def first(make, normal):
	O.reset(); material()
	O.bodies.append(make())
	O.engines = [ForceResetter(), InsertionSortCollider(bounds(), verletDist=0), loop()]
	O.dt = 1e-9
	O.step()
	(c,) = [i for i in O.interactions if i.isReal]
	towards = 1 if c.id1 == 0 else -1
	seen.append([float(c.geom.penetrationDepth) - depth, float((towards * c.geom.normal - Vector3(normal)).norm())])
for a, b in ((r, r), (0, r), (r, 0)):
	both = a + b - depth
	for q1, q2, place, normal in (
		(one, one, (0, 0, 2 * h + both), (0, 0, 1)),
		(x, y, (0, 0, 2 * h * s2 + both), (0, 0, 1)),
		(one, corner, (0, 0, h + h * s3 + both), (0, 0, 1)),
		(one, one, Vector3(1, 1, 1) * (2 * h + both / s3), Vector3(1, 1, 1) / s3),
	):
		first(lambda: [cube((0, 0, 0), a, q1, fixed=True), cube(place, b, q2)], normal)
for sense in (0, 1):
	first(lambda: [utils.wall(0, axis=2, sense=sense), cube((0, 0, h + r - depth))], (0, 0, 1))
for place, normal in (((0, 0, h + r + 0.2 - depth), (0, 0, 1)), (Vector3(1, 1, 1) * (h + (r + 0.2 - depth) / s3), Vector3(1, 1, 1) / s3)):
	first(lambda: [cube((0, 0, 0), fixed=True), utils.sphere(place, 0.2)], normal)
	first(lambda: [utils.sphere(-Vector3(place), 0.2), cube((0, 0, 0), fixed=True)], normal)
answer(seen)
"""
	)
	seen, _ = inYade('from yade import utils\n' + script, rounded)
	assert len(seen) == 18
	for depth, normal in seen:
		assert depth == pytest.approx(0, abs=1e-13) and normal == pytest.approx(0, abs=1e-12)


def testBothCollidersSeeTheFirstContactAtOnce(rounded):  # noqa: F811
	"""Two free bodies that meet at 1 m/s: PolytopeCollider leaves out no pair whose radii can touch."""
	script = (
		start
		+ """
seen = []
for kind in (InsertionSortCollider, PolytopeCollider):
	for verlet in (0.02, 0.04):
		O.reset(); material()
		O.bodies.append([cube((0, 0, 0)), cube((0, 0, 2 * h + 2 * r + 0.05))])
		O.bodies[1].state.vel = (0, 0, -1)
		O.engines = [ForceResetter(), kind(bounds(), verletDist=verlet), loop(), NewtonIntegrator(damping=0)]
		O.dt = 1e-4
		while not O.interactions.countReal() and O.iter < 2500: O.step()
		seen.append([O.iter, 2 * h + 2 * r - float(O.bodies[1].state.pos[2] - O.bodies[0].state.pos[2])])
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	assert all(one == seen[0] for one in seen) and seen[0][0] == pytest.approx(502, abs=2)
	assert all(0 <= depth < 2.1e-4 for _, depth in seen)  # a step and the one after it, at 1 m/s


def testAPileRestsAtItsClosedForm(rounded):  # noqa: F811
	"""A sharp cube on a rounded one on a wall, under the plug-in's own engines with these contacts: stiffness times depth is the weight
	above, upright, and nothing is found wrong."""
	script = (
		start
		+ """
from yade import utils
material(1e9)
O.bodies.append([utils.wall(0, axis=2, sense=1), cube((0, 0, h + r)), cube((0.05, 0, 3 * h + 2 * r), 0)])
O.engines = polytope.engines(geometry=contacts(), physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
found = repr(polytope.check(O))
O.run(8000, True)
mass = [float(body.state.mass) for body in O.bodies]
below, above = O.interactions[0, 1], O.interactions[1, 2]
depths = [float(c.geom.penetrationDepth) * float(c.phys.kn) for c in (below, above)]
answer([found, mass, *depths, max(float(2 * math.acos(min(1, abs(body.state.ori[3])))) for body in list(O.bodies)[1:])])
"""
	)
	(found, mass, below, above, turned), _ = inYade(script, rounded)
	assert found.splitlines()[0] == 'nothing was found that is wrong'
	assert below == pytest.approx((mass[1] + mass[2]) * 9.81, rel=1e-3)
	assert above == pytest.approx(mass[2] * 9.81, rel=1e-3)
	assert turned < 0.01


def testEnginesHaveTheContactsOfTheExtension(rounded):  # noqa: F811
	"""Those for pairs of the scene's shapes, beside the plug-in's own: a body rests on a wall at its closed form without a list of
	functors; a sphere's are there where there is a sphere; settings of the contact are kept."""
	script = (
		start
		+ """
from yade import utils
def functors():
	return sorted(type(one).__name__ for one in O.engines[2].geomDispatcher.functors)
material(1e9)
O.bodies.append([utils.wall(0, axis=2, sense=1), cube((0, 0, h + r))])
joints = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)
O.engines = polytope.engines(physics=joints)
found, few = repr(polytope.check(O)), functors()
O.run(4000, True)
c = O.interactions[0, 1]
push = float(c.geom.penetrationDepth) * float(c.phys.kn) / (9.81 * float(O.bodies[1].state.mass))
O.bodies.append(utils.sphere((0, 0, 5), 0.2))
O.engines = polytope.engines(physics=joints, geometry=Ig2_Polytope_Polytope_PolytopeGeom(tolerance=1e-7))
answer([found, few, push, functors(), O.engines[2].geomDispatcher.functors[0].tolerance])
"""
	)
	(found, few, push, more, tolerance), _ = inYade(script, rounded)
	assert found.splitlines()[0] == 'nothing was found that is wrong'
	own = ['Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom', 'Ig2_Wall_RoundedPolytope_PolytopeGeom']
	assert set(own) <= set(few) and not any('Sphere' in name for name in few)
	assert push == pytest.approx(1, rel=1e-3)
	assert {*own, 'Ig2_Sphere_RoundedPolytope_PolytopeGeom', 'Ig2_Sphere_Sphere_ScGeom'} <= set(more) and tolerance == 1e-7


def testWithoutItsFunctorsCheckSaysSo(rounded):  # noqa: F811
	"""With the plug-in's own functors alone the body is taken for its planes, and check says that and what to add."""
	script = (
		start
		+ """
material()
O.bodies.append([cube((0, 0, 0), fixed=True), cube((0, 0, 2 * h + 2 * r)), utils.facet([(9, 9, 9), (8, 9, 9), (9, 8, 9)])])
O.engines = polytope.engines(geometry=[Ig2_Polytope_Polytope_PolytopeGeom(), Ig2_Facet_Polytope_PolytopeGeom()])
answer([[one.what, one.seen, one.advice] for one in polytope.check(O)])
"""
	)
	found, _ = inYade('from yade import utils\n' + script, rounded)
	taken = 'RoundedPolytope is taken for the Polytope of its planes'
	like = 'Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom() to the InteractionLoop; polytope.engines() without geometry has it'
	assert ['contact functors', f'there is no functor for RoundedPolytope and RoundedPolytope: {taken}', f'add {like}'] in found
	add = 'add Ig2_Facet_RoundedPolytope_PolytopeGeom() to the InteractionLoop'
	assert any('RoundedPolytope' in seen and 'Facet' in seen and add in advice for _, seen, advice in found), found


def testWithoutAnyFunctorTheyPassThroughEachOther(rounded):  # noqa: F811
	"""Where the loop has no functor of polytopes, nothing is taken for its planes: check says that they do not touch."""
	script = (
		start
		+ """
material()
O.bodies.append([cube((0, 0, 0), fixed=True), cube((0, 0, 2 * h + 2 * r))])
O.engines = polytope.engines(geometry=[Ig2_Sphere_Sphere_ScGeom()])
answer([[one.what, one.seen, one.advice] for one in polytope.check(O) if one.what == 'contact functors'])
"""
	)
	((_, seen, advice),), _ = inYade(script, rounded)
	assert seen == 'the InteractionLoop has no functor for RoundedPolytope and RoundedPolytope: they pass through each other'
	assert 'Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom()' in advice


def testSizesHaveTheMargin(rounded):  # noqa: F811
	"""A core of 2 mm in a ball of 0.1 m is a body of 0.2 m: check has no word of its size or stiffness, and the collider looks as far as for one."""
	script = (
		start
		+ """
O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5))
shape = RoundedPolytope(radius=0.1)
O.bodies.append(polytope.cuboid((0, 0, -0.5), (1, 1, 0.5), fixed=True))
O.bodies.append(polytope.withShape(polytope.cuboid((0, 0, 0.2), (1e-3,) * 3), shape))
O.bodies[1].state.vel = (0, 0, -1)
O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
found = polytope.check(O)
answer([[one.seen for one in found], '0.202 m across' in repr(found), O.engines[1].verletDist])
"""
	)
	(found, across, verletDist), _ = inYade(script, rounded)
	assert found == [] and across and 0.002 < verletDist < 0.02


def testCheckTellsOfMarginsBeforeTheRun(rounded):  # noqa: F811
	"""A stiffness per area, with which nothing would touch; a margin that is no number or below 0, with which the time step would be none."""
	script = (
		start
		+ """
def findings():
	return [[one.what, one.seen, one.advice] for one in polytope.check(O)]
material()
O.bodies.append([cube((0, 0, 0), fixed=True), cube((0, 0, 2 * h + 2 * r + 0.01))])
O.engines = polytope.engines()
seen = [findings()]
O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
for radius in (r, float('nan'), -0.1, float('inf')):
	O.bodies[1].shape.radius = radius
	seen.append(findings())
answer(seen)
"""
	)
	(perArea, good, *bad), _ = inYade(script, rounded)
	assert [(what, 'per area' in seen, 'stiffnessPerArea=False' in advice) for what, seen, advice in perArea] == [('units', True, True)]
	assert good == []
	for found, margin in zip(bad, ('nan', '-0.1', 'inf'), strict=True):
		said = f"body 1, a RoundedPolytope: its margin must be finite and at least 0; its attributes are {{'radius': {margin}}}"
		assert any(what == 'shapes' and seen == said for what, seen, _ in found), found


def testMassFrameAndDrawingAreThoseOfTheSum(rounded, tmp_path):  # noqa: F811
	"""A cube's volume and moment by Steiner's formula; a tetrahedron without symmetry, whose sum with a ball has another centroid; faces of
	pictures and VTK files; and all of it again in a new process that loads the scene."""
	saved = tmp_path / 'scene.yade'
	script = (
		start
		+ """
material()
body = cube((1, 2, 3))
points = [(0, 0, 0), (1.3, 0.1, 0), (0.2, 0.9, 0.1), (0.4, 0.3, 1.1)]
plain = polytope.fromVertices(points)
sharp = plain.state.pos
corner = polytope.withShape(polytope.fromVertices(points), RoundedPolytope(radius=0.3))
O.bodies.append([body, corner])
turn = corner.state.ori
core = [turn * vertex + corner.state.pos for vertex in corner.shape.vertices]
off = max(min((Vector3(*point) - vertex).norm() for vertex in core) for point in points)
from yade.polytope.scene.vertices import worldVertices
shown = worldVertices(body) - [1, 2, 3]
PolytopeVTKRecorder(fileName=sys.argv[2], recorders=['bodies'])()
O.save(sys.argv[3])
answer([float(body.shape.volume), [float(x) for x in body.state.inertia], float((corner.state.pos - sharp).norm()), off,
	[float(abs(shown).max()), float(abs(shown).min(axis=0).max())], float(corner.state.mass), [float(x) for x in corner.state.inertia]])
"""
	)
	(volume, inertia, way, off, shown, mass, moments), _ = inYade(script, rounded, tmp_path / 'shown', saved)
	a, r = 0.8, 0.1
	assert volume == pytest.approx(a**3 + 6 * a**2 * r + 3 * math.pi * a * r**2 + 4 / 3 * math.pi * r**3, rel=1e-13)
	assert inertia[0] == pytest.approx(inertia[2], rel=1e-12)
	assert 1e-3 < way < 0.1 and off < 1e-12  # the centroid is elsewhere, the body is not
	assert shown[0] == pytest.approx(0.5, abs=1e-12)
	text = next(tmp_path.glob('shownbodies.*.vtu')).read_bytes()
	assert b'NumberOfCells="2"' in text
	script = 'O.load(sys.argv[1])\nb = O.bodies[1]\nanswer([float(b.shape.radius), float(b.shape.volume * 2600), [float(x) for x in b.shape.inertia * 2600]])'
	(radius, massAgain, momentsAgain), _ = inYade(script, saved, YADE_POLYTOPE_EXTENSIONS=str(rounded))
	assert radius == 0.3 and massAgain == pytest.approx(mass, rel=1e-12) and momentsAgain == pytest.approx(moments, rel=1e-9)


def testAThinPrismIsARoundedSegmentOrTriangle(rounded):  # noqa: F811
	"""What docs/extending.md says of cores without an interior: the volume is that of a cylinder with two half balls, contacts have their
	closed forms, and flat points are refused."""
	script = (
		start
		+ """
material()
half = 5e-5
prism = lambda center, orientation=Quaternion.Identity, **more: polytope.withShape(polytope.cuboid(center, (1, half, half), orientation=orientation, **more), RoundedPolytope(radius=r))
def triangle(center, **more):
	body = polytope.fromVertices([(x, y, z) for x, y in ((0, 0), (1, 0), (0, 1)) for z in (-half, half)], center=center, **more)
	return polytope.withShape(body, RoundedPolytope(radius=r))
def said():
	try: polytope.fromVertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)])
	except ValueError as error: return str(error)
volume, refusal = float(prism((0, 0, 0)).shape.volume), said()
d, across = 0.01, Quaternion((0, 0, 1), math.pi / 2)
seen = []
for make in (
	lambda: [prism((0, 0, 0), fixed=True), prism((0.3, 0.2, 2 * (r + half) - d), across)],
	lambda: [prism((0, 0, 0), fixed=True), prism((0.3, 0, 2 * (r + half) - d))],
	lambda: [triangle((0, 0, 0), fixed=True), triangle((0.1, 0, 2 * (r + half) - d))],
	lambda: [triangle((0, 0, 0), fixed=True), prism((0.05, 0, 2 * (r + half) - d), across)],
	lambda: [triangle((0, 0, 0), fixed=True), utils.sphere((0, 0, r + half + 0.2 - d), 0.2)],
	lambda: [utils.wall(0, axis=2, sense=1), triangle((0, 0, r + half - d))],
):
	O.reset(); material()
	O.bodies.append(make())
	O.engines = [ForceResetter(), InsertionSortCollider(bounds(), verletDist=0), loop()]
	O.dt = 1e-9
	O.step()
	(c,) = [i for i in O.interactions if i.isReal]
	towards = 1 if c.id1 == 0 else -1
	seen.append([float(c.geom.penetrationDepth) - d, float((towards * c.geom.normal - Vector3(0, 0, 1)).norm())])
answer([volume, refusal, seen])
"""
	)
	(volume, refusal, seen), _ = inYade('from yade import utils\n' + script, rounded)
	r = 0.1
	assert 0 < volume / (2 * math.pi * r**2 + 4 / 3 * math.pi * r**3) - 1 < 2e-3
	assert refusal.startswith('points: ')
	assert len(seen) == 6
	for depth, normal in seen:
		assert depth == pytest.approx(0, abs=1e-12) and normal == pytest.approx(0, abs=1e-9)


resting = (
	start
	+ """
from yade import utils
def energy():
	moving = [body.state for body in O.bodies if body.state.blockedDOFs != 'xyzXYZ' and body.state.mass > 0]
	turning = [(state, state.ori.conjugate() * state.angVel) for state in moving]
	return float(sum(s.mass * s.vel.squaredNorm() + sum(i * w * w for i, w in zip(s.inertia, spin)) for s, spin in turning) / 2)
def scene(below, radius, slope=0, tilt=(0.003, 0.002, 0), half=(h, h, h), **more):
	O.reset(); material(1e8)
	q = Quaternion((1, 0, 0), slope)
	ground = lambda depth, radius: polytope.cuboid(center=q * Vector3(0, 0, -depth), extents=(1.5, 1.5, h), orientation=q, fixed=True)
	if below == 'wall': O.bodies.append(utils.wall(0, axis=2, sense=1))
	elif below == 'sharp': O.bodies.append(ground(h, 0))
	else: O.bodies.append(polytope.withShape(ground(h + 0.1, 0.1), RoundedPolytope(radius=0.1)))
	angle = Vector3(*tilt).norm()
	turned = q * Quaternion(Vector3(*tilt) / angle, angle) if angle else q
	body = polytope.cuboid(center=q * Vector3(0.05, 0, half[2] + radius + angle * max(half) + 2e-3), extents=half, orientation=turned)
	O.bodies.append(polytope.withShape(body, RoundedPolytope(radius=radius)))
	O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False), **more)
	return q
def rest(q, steps):  # largest kinetic energy, that at the end over it, way of the last fifth, tilt against the ground, corners of the outline, push
	most = 0
	for part in range(5):
		start = Vector3(O.bodies[1].state.pos)
		for k in range(20):
			O.run(steps // 100, True)
			most = max(most, energy())
	turned = q.conjugate() * O.bodies[1].state.ori
	(c,) = [i for i in O.interactions if i.isReal]
	return [most, energy() / most, float((O.bodies[1].state.pos - start).norm()), float((turned * Vector3(0, 0, 1)).cross(Vector3(0, 0, 1)).norm()), len(c.geom.outline), float(c.geom.penetrationDepth * c.phys.kn)]
"""
)


@pytest.mark.parametrize('below', ['sharp', 'wall', 'round'])
def testItComesToRestOnItsFace(rounded, below):  # noqa: F811
	"""Let fall with a tilt, margins from below the depth of the contact to near the size of the core, in space and, with what leads out of
	it blocked, in a plane: still to 1e-12 of its energy, upright, with its weight on the face."""
	script = (
		resting
		+ """
seen = []
for radius in (2e-5, 1e-3, 0.1, 0.3):
	for blocked in ('', 'xYZ'):
		q = scene(sys.argv[2], radius, tilt=(0.003, 0 if blocked else 0.002, 0))
		O.bodies[1].state.blockedDOFs = blocked
		seen.append([*rest(q, 16000), 9.81 * float(O.bodies[1].state.mass)])
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded, below)
	for most, left, way, tilt, corners, push, weight in seen:
		assert most > 0.01 and left < 1e-12 and way < 1e-9, seen
		assert tilt < 1e-7 and corners == 4 and push == pytest.approx(weight, rel=1e-6), seen


def testItStaysOnASlopeBelowTheAngleOfFriction(rounded):  # noqa: F811
	script = (
		resting
		+ """
seen = []
for below in ('sharp', 'round'):
	for radius in (1e-3, 0.1, 0.3):
		seen.append(rest(scene(below, radius, slope=0.3), 20000))
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	for _, left, way, tilt, corners, _ in seen:
		assert left < 1e-12 and way < 1e-9 and tilt < 1e-3 and corners == 4, seen


def testItRocksWithoutGainOrLoss(rounded):  # noqa: F811
	"""On faces, edges and corners in turn, without friction and dampers: whenever it is in the air it has the energy that it had at first,
	of that above rest, which is a hundredth of a body's height, to the order of its tilt. With a point that does not belong to the depth it
	would gain or lose most of it."""
	script = (
		resting
		+ """
seen = []
for half in ((h, h, h), (0.2, 0.2, 0.7)):
	scene('sharp', 0.1, tilt=(0.03, 0.02, 0), half=half, damping=0)
	O.materials[0].frictionAngle = 0
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	for engine in O.engines:
		if isinstance(engine, PolytopeTimeStepper): engine.timestepSafetyCoefficient = 0.1
	state, low = O.bodies[1].state, half[2] + 0.1
	def total():
		kept = state.vel
		state.vel = kept - Vector3(0, 0, 9.81 * O.dt / 2)  # YADE's velocities are those of half a step before
		sum = energy() + 9.81 * float(state.mass * (state.pos[2] - low))
		state.vel = kept
		return sum
	flights = []
	while O.time < 2:
		O.run(20, True)
		if not O.interactions.countReal(): flights.append(total())
	seen.append([max(abs(one / flights[0] - 1) for one in flights), len(flights)])
answer(seen)
"""
	)
	seen, _ = inYade(script, rounded)
	for error, count in seen:
		assert count > 20 and error < 0.03, seen


def testTwoBodiesOfRockableSettle(rounded):  # noqa: F811
	"""Two bodies of Rockable's library, with their radius, one on the other: at rest upright, with the weight of both below."""
	script = (
		resting
		+ """
path = sys.argv[2] + '/library.shp'
O.reset(); material(1e7)
O.bodies.append(utils.wall(0, axis=2, sense=1))
for k in (0, 1):
	(body,) = polytope.readShapes(path, names='Cube', rounded=RoundedPolytope)
	top = float(max(body.shape.offsets)) + float(body.shape.radius)
	body.state.pos = (0.1 * top * k, 0, (2 * k + 1.001) * top)
	body.state.ori = Quaternion.Identity
	O.bodies.append(body)
O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
found = repr(polytope.check(O))
most = 0
for k in range(100):
	O.run(300, True)
	most = max(most, energy())
push = [float(c.geom.penetrationDepth * c.phys.kn) for c in (O.interactions[0, 1], O.interactions[1, 2])]
answer([found, energy() / most, push, [9.81 * float(body.state.mass) for body in list(O.bodies)[1:]], [float(body.shape.radius) for body in list(O.bodies)[1:]]])
"""
	)
	(found, left, push, weights, radii), _ = inYade(script, rounded, project / 'tests/yade/shapes')
	assert found.splitlines()[0] == 'nothing was found that is wrong', found
	assert min(radii) > 0 and left < 1e-12
	assert push == pytest.approx([sum(weights), weights[1]], rel=1e-6)


def testShapesOfRockableKeepTheirRadius(rounded):  # noqa: F811
	"""A cube of its library: sharp with its faces moved out, or a rounded one, whose faces are in the same places."""
	script = (
		start
		+ """
material()
path = sys.argv[2] + '/library.shp'
(sharp,), (own,) = (polytope.readShapes(path, names='Cube', rounded=kind) for kind in (None, RoundedPolytope))
def said(call):
	try: call()
	except ValueError as error: return str(error)
radius = float(own.shape.radius)
answer([radius, float(max(sharp.shape.offsets) - max(own.shape.offsets)), float(sharp.shape.volume - own.shape.volume), type(own.shape).__name__,
	said(lambda: polytope.readShapes(path, rounded=Polytope)), said(lambda: polytope.withShape(own, RoundedPolytope(radius=1))),
	said(lambda: polytope.withShape(polytope.polygon([(0, 0), (1, 0), (0, 1)]), RoundedPolytope(radius=0.1))),
	said(lambda: polytope.withShape(sharp, RoundedPolytope(radius=-1)))])
"""
	)
	(radius, moved, less, kind, *refusals), _ = inYade(script, rounded, project / 'tests/yade/shapes')
	assert radius > 0 and moved == pytest.approx(radius, rel=1e-9) and less > 0 and kind == 'RoundedPolytope'
	for text, begin in zip(refusals, ('rounded: must be', 'body: must be', 'body: is a polygon', 'shape: its margin'), strict=True):
		assert text.startswith(begin), text


def testWhatAStageDoesNotKnowIsToldOrCounted(rounded):  # noqa: F811
	"""A stiffness per area has no area here: each pair is a failure, which check tells of. A frame that is not the sum's is told, too."""
	script = (
		start
		+ """
material()
O.bodies.append([cube((0, 0, 0), fixed=True), cube((0, 0, 2 * h + 2 * r - 0.01))])
O.engines = polytope.engines(geometry=contacts())
O.dt = 1e-6
O.run(3, True)
counts = O.engines[2].geomDispatcher.functors[0].stats()['failures']
points = [(0, 0, 0), (1.3, 0.1, 0), (0.2, 0.9, 0.1), (0.4, 0.3, 1.1)]
sharp = polytope.fromVertices(points)
sharp.shape = RoundedPolytope(normals=sharp.shape.normals, offsets=sharp.shape.offsets, radius=0.5)
sharp.state.pos = (9, 9, 9)
O.bodies.append(sharp)
answer([counts, [[one.what, one.seen] for one in polytope.check(O)]])
"""
	)
	(counts, found), _ = inYade(script, rounded)
	assert counts == 3
	assert any(what == 'shapes' and 'body 2, a RoundedPolytope: offsets: the body frame' in seen for what, seen in found), found
