# SPDX-License-Identifier: GPL-2.0-or-later
"""Extensions that are no examples, in thirdParty/, written from docs/extending.md: an ellipsoid by planes that touch it, with a geometry of its own; and rods, a family whose
core is a segment, with a normal law. Closed forms, both colliders, new processes, two ranks."""

import json
import math
import re
import shutil
import sys

import pytest
from test_extensions import built, inYade, project, run
from yade import polytope

examples = project / 'tests/yade/plugin/thirdParty'


@pytest.fixture(scope='module')
def rods():
	return built('rods', examples=examples)


@pytest.fixture(scope='module')
def ellipsoid():
	return built('ellipsoid', examples=examples)


startOfRods = """
from yade import polytope, utils, Quaternion, Vector3
import math
polytope.load(sys.argv[1])
def material(stiffness=1e7, **more):
	return O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5, stiffnessPerArea=False, **more))
def rod(center, along=(1, 0, 0), length=1, radius=0.1, fixed=False):
	body = Body()
	body.shape, body.material = Rod(length=length, radius=radius), O.materials[-1]
	body.state.pos = body.state.refPos = center
	x, along = Vector3(1, 0, 0), Vector3(*along).normalized()
	axis = x.cross(along) if x.cross(along).norm() > 0 else Vector3(0, 0, 1)
	body.state.ori = Quaternion(axis.normalized(), math.acos(x.dot(along)))
	area, density = math.pi * radius**2, O.materials[-1].density
	body.state.mass = density * area * (length + 4 / 3 * radius)
	m, ball = density * area * length, density * 4 / 3 * math.pi * radius**3
	across = m * (length**2 / 12 + radius**2 / 4) + ball * (2 / 5 * radius**2 + length**2 / 4 + 3 / 8 * length * radius)
	body.state.inertia = (m * radius**2 / 2 + ball * 2 / 5 * radius**2, across, across)
	body.aspherical = body.bounded = True
	body.state.blockedDOFs = 'xyzXYZ' if fixed else ''
	return body
contacts = [Ig2_Rod_Rod_PolytopeGeom, Ig2_Rod_Polytope_PolytopeGeom, Ig2_Sphere_Rod_PolytopeGeom, Ig2_Wall_Rod_PolytopeGeom, Ig2_Polytope_Polytope_PolytopeGeom]
bounds = [Bo1_Rod_Aabb, Bo1_Polytope_Aabb, Bo1_Wall_Aabb, Bo1_Sphere_Aabb]
def loop():
	return InteractionLoop([kind() for kind in contacts], [Ip2_RockJointMat_RockJointMat_RockJointPhys()], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()])
"""


def testRodsHaveTheirClosedForms(rods):
	"""Depth, normal and point beside walls, spheres, boxes and each other: along a face, over an edge, at a corner, crossed, side by side,
	in a row, and with the segment itself in a box."""
	script = (
		startOfRods
		+ """
d = 0.01
s2, s3 = math.sqrt(2), math.sqrt(3)
box = lambda: polytope.cuboid((0, 0, 0), (0.4, 0.4, 0.4), fixed=True)
seen = []
def first(bodies, depth, normal, point):
	O.reset(); material()
	O.bodies.append(bodies())
	O.engines = [ForceResetter(), InsertionSortCollider([kind() for kind in bounds], verletDist=0), loop()]
	O.dt = 1e-9
	O.step()
	(c,) = [i for i in O.interactions if i.isReal]
	towards = 1 if c.id1 == 0 else -1
	seen.append([float(c.geom.penetrationDepth) - depth, float((towards * c.geom.normal - Vector3(*normal)).norm()), float((c.geom.contactPoint - Vector3(*point)).norm())])
# walls: flat, and on one end
first(lambda: [utils.wall(0, axis=2, sense=1), rod((0, 0, 0.1 - d))], d, (0, 0, 1), (0, 0, -d / 2))
first(lambda: [utils.wall(0, axis=2, sense=1), rod((0, 0, 0.3 + 0.1 - d), (0.8, 0, 0.6))], d, (0, 0, 1), (-0.4, 0, -d / 2))
# spheres: beside it, and beyond its end
first(lambda: [rod((0, 0, 0), fixed=True), utils.sphere((0.2, 0, 0.3 - d), 0.2)], d, (0, 0, 1), (0.2, 0, 0.1 - d / 2))
first(lambda: [rod((0, 0, 0), fixed=True), utils.sphere((0.5 + 0.3 - d, 0, 0), 0.2)], d, (1, 0, 0), (0.6 - d / 2, 0, 0))
# a box: along its top, the middle of what lies on it; over an edge; an end at a corner; deep
first(lambda: [box(), rod((0.3, 0, 0.5 - d))], d, (0, 0, 1), (0.1, 0, 0.4 - d / 2))
first(lambda: [box(), rod(Vector3(0.4, 0.1, 0.4) + Vector3(1, 0, 1) / s2 * (0.1 - d), (-1, 0, 1))], d, Vector3(1, 0, 1) / s2, Vector3(0.4, 0.1, 0.4) - Vector3(1, 0, 1) / s2 * d / 2)
first(lambda: [box(), rod(Vector3(1, 1, 1) * (0.4 + (0.1 - d + 0.5) / s3), (1, 1, 1))], d, Vector3(1, 1, 1) / s3, Vector3(1, 1, 1) * (0.4 - d / 2 / s3))
first(lambda: [box(), rod((0, 0, 0.35))], 0.15, (0, 0, 1), (0, 0, 0.4 - 0.15 / 2))
# rods: crossed, side by side, in a row
first(lambda: [rod((0, 0, 0), fixed=True), rod((0.2, 0.1, 0.2 - d), (0, 1, 0))], d, (0, 0, 1), (0.2, 0, 0.1 - d / 2))
first(lambda: [rod((0, 0, 0), fixed=True), rod((0.6, 0, 0.2 - d), (-1, 0, 0))], d, (0, 0, 1), (0.3, 0, 0.1 - d / 2))
first(lambda: [rod((0, 0, 0), fixed=True), rod((1 + 0.2 - d, 0, 0))], d, (1, 0, 0), (0.6 - d / 2, 0, 0))
answer(seen)
"""
	)
	seen, _ = inYade(script, rods)
	assert len(seen) == 11
	for depth, normal, point in seen:
		assert depth == pytest.approx(0, abs=1e-11) and normal == pytest.approx(0, abs=1e-9) and point == pytest.approx(0, abs=1e-6)


def testRodsThatHaveNoAnswerAreCounted(rods):
	"""With a polygon, which is no solid here; crossing each other; and with a stiffness per area, of which check tells before the run."""
	script = (
		startOfRods
		+ """
def failures(*bodies, **more):
	O.reset(); material()
	for name, value in more.items(): setattr(O.materials[-1], name, value)
	O.bodies.append([make() for make in bodies])
	O.engines = [ForceResetter(), InsertionSortCollider([kind() for kind in bounds], verletDist=0), loop(), NewtonIntegrator()]
	found = [one.seen for one in polytope.check(O) if 'without an area' in one.seen]
	O.dt = 1e-9
	O.run(3, True)
	return [O.engines[2].geomDispatcher.functors[0].stats()['failures'] + O.engines[2].geomDispatcher.functors[1].stats()['failures'], O.interactions.countReal(), len(found)]
answer([failures(lambda: rod((0, 0, 0), fixed=True), lambda: polytope.polygon([(-1, -1), (1, -1), (0, 1)])),
	failures(lambda: rod((0, 0, 0), fixed=True), lambda: rod((0, 0, 0), (0, 1, 0))),
	failures(lambda: rod((0, 0, 0), fixed=True), lambda: rod((0, 0, 0.19)), stiffnessPerArea=True)])
"""
	)
	(polygon, crossed, perArea), _ = inYade(script, rods)
	assert polygon[:2] == crossed[:2] == perArea[:2] == [3, 0]
	assert (polygon[2], crossed[2], perArea[2]) == (0, 0, 1)


def testCheckTellsOfPairsWithoutAContactBeforeTheRun(rods):
	"""A rod and a facet, which have a functor that is not in the loop; a rod and a shape of YADE's that no extension knows; a rod and a
	polygon, which is no core in space."""
	script = (
		startOfRods
		+ """
def found(other, functors):
	O.reset(); material()
	O.bodies.append([other(), rod((0, 0, 1))])
	O.engines = [ForceResetter(), InsertionSortCollider([kind() for kind in bounds] + [Bo1_Facet_Aabb(), Bo1_Tetra_Aabb()]),
		InteractionLoop([kind() for kind in functors], [Ip2_RockJointMat_RockJointMat_RockJointPhys()], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()]), NewtonIntegrator(damping=0.2)]
	return [[one.seen, one.advice] for one in polytope.check(O) if one.what == 'contact functors']
facet = lambda: utils.facet([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], fixed=True)
def tetra():
	body = Body()
	body.shape, body.material = Tetra(v=[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]), O.materials[-1]
	return body
polygon = lambda: polytope.polygon([(-1, -1), (1, -1), (0, 1)], fixed=True)
answer([found(facet, contacts), found(facet, [*contacts, Ig2_Facet_Rod_PolytopeGeom]), found(tetra, contacts), found(polygon, contacts)])
"""
	)
	(facet, with_, tetra, polygon), _ = inYade(script, rods)
	none = 'the InteractionLoop has no functor for {} and Rod: they pass through each other'
	assert facet == [
		[none.format('Facet'), 'add Ig2_Facet_Rod_PolytopeGeom() to the InteractionLoop; polytope.engines() without geometry has it']
	]
	assert with_ == []
	((seen, advice),) = tetra
	assert seen == none.format('Tetra') and advice.startswith('no loaded extension has one: write it')
	((seen, advice),) = polygon
	assert (
		seen
		== 'Ig2_Rod_Polytope_PolytopeGeom meets bodies by their cores, and a Polytope of dimension 2 has none: such pairs are counted as failures'
	)
	assert advice.startswith('make it a polyhedron')


@pytest.mark.parametrize('value', ['nan', 'inf', '-0.1'])
def testARadiusThatIsNoneIsToldAndCounted(rods, value):
	"""The rod's family is derived from no class of ours: check names the body, and the pair is a failure instead of a contact, also where
	the box holds it."""
	script = (
		startOfRods
		+ """
material()
O.bodies.append([polytope.cuboid((0, 0, -0.4), (2, 2, 0.4), fixed=True), rod((0, 0, 0.099))])
O.engines = polytope.engines()
good = [one.seen for one in polytope.check(O)]
O.step()
contacts = O.interactions.countReal()
O.bodies[1].shape.radius = float(sys.argv[2])
seen = [one.seen for one in polytope.check(O) if one.what == 'shapes']
O.dt = 1e-9
O.step()
failures = sum(one.stats()['failures'] for one in O.engines[2].geomDispatcher.functors)
c = O.interactions[0, 1]
answer([good, contacts, seen, failures, c.geom.status])
"""
	)
	(good, contacts, seen, failures, status), _ = inYade(script, rods, value)
	assert good == [] and contacts == 1
	assert len(seen) == 1 and seen[0].startswith('body 1, a Rod: ') and 'at least 0' in seen[0]
	assert failures == 1 and status == 'failed'


def testBothCollidersSeeRodsAtOnce(rods):
	"""A rod that turns as it falls onto a box: first contact in the same step, at most two steps' way deep."""
	script = (
		startOfRods
		+ """
seen = []
for kind in (InsertionSortCollider, PolytopeCollider):
	for verlet in (0.02, 0.04):
		O.reset(); material()
		O.bodies.append([polytope.cuboid((0, 0, 0), (0.4, 0.4, 0.4)), rod((0, 0, 0.8))])
		O.bodies[1].state.vel, O.bodies[1].state.angVel = (0, 0, -1), (0, 3, 0)
		O.engines = [ForceResetter(), kind([one() for one in bounds], verletDist=verlet), loop(), NewtonIntegrator(damping=0)]
		O.dt = 1e-4
		while not O.interactions.countReal() and O.iter < 5000: O.step()
		(c,) = [i for i in O.interactions if i.isReal] or [None]
		seen.append([O.iter, float(c.geom.penetrationDepth)])
answer(seen)
"""
	)
	seen, _ = inYade(script, rods)
	assert all(one == seen[0] for one in seen) and 100 < seen[0][0] < 4999
	assert 0 <= seen[0][1] < 2 * 1e-4 * (1 + 3 * 0.5)


restingRod = (
	startOfRods
	+ """
def scene():
	O.reset(); material(1e8)
	O.bodies.append([polytope.cuboid((x, 0, -0.2), (0.1, 0.2, 0.2), fixed=True) for x in (-0.5, 0.5)])
	O.bodies.append(rod((0, 0, 0.1), length=1.6))
	O.engines = polytope.engines()
def pushes():
	return [float(O.forces.f(k)[2]) / (9.81 * float(O.bodies[2].state.mass)) for k in (0, 1)]
"""
)


def testARodRestsOnTwoBlocks(rods, tmp_path):
	"""Under the engines that polytope.engines() chooses: half of the weight on each, no finding; and on in a new process, which has the
	extension from the environment."""
	saved = tmp_path / 'rod.yade.bz2'
	script = (
		restingRod
		+ """
scene()
found = repr(polytope.check(O))
O.run(20000, True)
forces = pushes()
O.save(sys.argv[2])
O.run(20, True)
answer([found, forces, [float(x) for x in O.bodies[2].state.pos], sorted(type(one).__name__ for one in O.engines[1].boundDispatcher.functors)])
"""
	)
	(found, forces, place, functors), _ = inYade(script, rods, saved)
	assert found.splitlines()[0] == 'nothing was found that is wrong', found
	assert 'Bo1_Rod_Aabb' in functors
	assert forces == pytest.approx([-0.5, -0.5], rel=1e-3)
	again, _ = inYade(
		'O.load(sys.argv[1])\nO.run(20, True)\nanswer([float(x) for x in O.bodies[2].state.pos])', saved, YADE_POLYTOPE_EXTENSIONS=str(rods)
	)
	assert again == pytest.approx(place, rel=1e-12, abs=1e-12)


def testALawOfAThirdPartyRestsAtItsClosedForm(rods):
	"""u = a ln(1 + σ/(k a)), with a stiffness per area."""
	script = """
from yade import polytope
import math
polytope.load(sys.argv[1])
O.materials.append(RockJointMat(density=2600, normalStiffness=1e6, shearStiffness=1e6, frictionAngle=0.5, closure=ExponentialClosure(length=4e-3)))
O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
O.bodies.append(polytope.cuboid(center=(0, 0, 0.5), extents=(0.5, 0.4, 0.5)))
O.engines = polytope.engines()
found = repr(polytope.check(O))
O.run(20000, True)
stress = 9.81 * O.bodies[1].state.mass / 0.8
answer([found, float(O.interactions[0, 1].geom.penetrationDepth) / (4e-3 * math.log(1 + stress / (1e6 * 4e-3)))])
"""
	(found, ratio), _ = inYade(script, rods)
	assert ratio == pytest.approx(1, rel=1e-5), found


startOfEllipsoids = """
from yade import polytope, Quaternion, Vector3
import math
polytope.load(sys.argv[1])
axes = (0.5, 0.3, 0.2)
def material(stiffness=1e7):
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5, stiffnessPerArea=False))
def ellipsoid(center, orientation=Quaternion.Identity, axes=axes, steps=5, **more):
	angles = [math.pi / 2 * k / steps for k in range(steps + 1)]
	octant = {(round(math.cos(a) * math.cos(b), 12), round(math.cos(a) * math.sin(b), 12), round(math.sin(a), 12)) for a in angles for b in angles}
	normals = sorted({tuple(s * x for s, x in zip(signs, n)) for n in octant for signs in [(i, j, k) for i in (1, -1) for j in (1, -1) for k in (1, -1)]})
	normals = sorted({tuple(x + 0.0 for x in n) for n in normals})
	reach = [math.sqrt(sum((a * x)**2 for a, x in zip(axes, n))) for n in normals]
	body = polytope.fromHalfSpaces(normals, reach, center=center, orientation=orientation, **more)
	return polytope.withShape(body, Ellipsoid(semiAxes=axes))
def contacts():
	return [Ig2_Polytope_Ellipsoid_EllipsoidGeom(), Ig2_Ellipsoid_Ellipsoid_EllipsoidGeom(), Ig2_Polytope_Polytope_PolytopeGeom()]
physics = Ip2_RockJointMat_RockJointMat_RockJointPhys
"""


def testAnEllipsoidHasItsClosedForms(ellipsoid, tmp_path):
	"""Mass and moments; depth and the geometry's own attribute on a floor, turned, and of two of them tip to tip; arrays; at rest on the
	floor; and from a saved scene in a new process."""
	saved = tmp_path / 'ellipsoid.yade.bz2'
	script = (
		startOfEllipsoids
		+ """
floor = lambda: polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True)
seen = []
def first(*bodies):
	O.reset(); material(1e8)
	O.bodies.append([make() for make in bodies])
	O.engines = polytope.engines(geometry=contacts(), gravity=(0, 0, -9.81))
	O.dt = 1e-9
	O.step()
	c = O.interactions[0, 1]
	towards = 1 if c.id1 == 0 else -1
	seen.append([float(c.geom.penetrationDepth), float(towards * c.geom.normal[2]), float(c.geom.curvatureRadius), type(c.geom).__name__])
d, upright = 0.01, Quaternion((0, 1, 0), math.pi / 2)
first(floor, lambda: ellipsoid((0, 0, 0.2 - d)))
first(floor, lambda: ellipsoid((0, 0, 0.5 - d), upright))
first(lambda: ellipsoid((0, 0, 0), upright, fixed=True), lambda: ellipsoid((0, 0, 1 - d), upright))
first(floor, lambda: ellipsoid((0, 0, 0.199)))
body = O.bodies[1]
mass = [float(body.state.mass) / 2600, *(float(x) / float(body.state.mass) for x in body.state.inertia)]
O.reset(); material(1e8)
O.bodies.append([floor(), ellipsoid((0, 0, 0.2))])
O.engines = polytope.engines(geometry=contacts())
found = repr(polytope.check(O))
O.run(8000, True)
c = O.interactions[0, 1]
arrays = polytope.arrays().contacts
PolytopeVTKRecorder(fileName=sys.argv[3], recorders=['contacts'], ascii=True)()
push = float(c.geom.penetrationDepth * c.phys.kn) / (9.81 * float(body.state.mass))
O.save(sys.argv[2])
radius = float(c.geom.curvatureRadius)
O.bodies[1].state.pos += Vector3(0, 0, 0.1)
O.run(2, True)
answer([seen, mass, found, push, arrays.statusNames[arrays.statuses[0]], radius, O.interactions.countReal()])
"""
	)
	(seen, mass, found, push, status, radius, left), _ = inYade(script, ellipsoid, saved, tmp_path / 'shown')
	assert 'NumberOfPoints="1"' in next(tmp_path.glob('showncontacts.*.vtp')).read_text()
	a, b, c = 0.5, 0.3, 0.2
	assert left == 0
	assert mass == pytest.approx([4 / 3 * math.pi * a * b * c, (b * b + c * c) / 5, (a * a + c * c) / 5, (a * a + b * b) / 5], rel=1e-12)
	assert [one[0] for one in seen[:3]] == pytest.approx([0.01] * 3, rel=1e-6)
	assert [one[1] for one in seen[:3]] == pytest.approx([1] * 3, abs=1e-9)
	assert [one[2] for one in seen[:3]] == pytest.approx([a * b / c, b * c / a, b * c / a], rel=1e-6)
	assert {one[3] for one in seen} == {'EllipsoidGeom'}
	assert push == pytest.approx(1, rel=1e-3) and status == 'contact'
	assert found.splitlines()[0] == 'nothing was found that is wrong', found
	script = 'O.load(sys.argv[1])\nc = O.interactions[0, 1]\nanswer([type(c.geom).__name__, float(c.geom.curvatureRadius), float(O.bodies[1].shape.semiAxes[0])])'
	assert inYade(script, saved, YADE_POLYTOPE_EXTENSIONS=str(ellipsoid))[0] == ['EllipsoidGeom', pytest.approx(radius, rel=1e-12), 0.5]


def testBothCollidersSeeEllipsoidsAtOnce(ellipsoid):
	script = (
		startOfEllipsoids
		+ """
seen = []
for kind in (InsertionSortCollider, PolytopeCollider):
	for verlet in (0.02, 0.04):
		O.reset(); material()
		O.bodies.append([ellipsoid((0, 0, 0)), ellipsoid((0.05, 0, 0.5), Quaternion(Vector3(1, 2, 0).normalized(), 0.4))])
		O.bodies[1].state.vel, O.bodies[1].state.angVel = (0, 0, -1), (1, 0, 2)
		O.engines = [ForceResetter(), kind([Bo1_Polytope_Aabb()], verletDist=verlet), InteractionLoop(contacts(), [physics()], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()]), NewtonIntegrator(damping=0)]
		O.dt = 1e-4
		while not O.interactions.countReal() and O.iter < 5000: O.step()
		seen.append([O.iter, float(O.interactions[0, 1].geom.penetrationDepth)])
answer(seen)
"""
	)
	seen, _ = inYade(script, ellipsoid)
	assert all(one == seen[0] for one in seen) and 100 < seen[0][0] < 4999
	assert 0 <= seen[0][1] < 1e-3


onRanks = """
import json, math, sys
import yade
from yade import *
from yade import polytope, Quaternion, Vector3
from yade.polytope import mpi
def make():
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5, stiffnessPerArea=False, closure=ExponentialClosure(length=0.05)))
	for k in range(6):
		normals = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if (x, y, z) != (0, 0, 0)]
		reach = [math.sqrt((0.5 * x)**2 + (0.3 * y)**2 + (0.25 * z)**2) for x, y, z in normals]
		body = polytope.fromHalfSpaces(normals, reach, center=(0.99 * k, 0, 0.02 * k), fixed=k in (0, 5))
		O.bodies.append(polytope.withShape(body, Ellipsoid(semiAxes=(0.5, 0.3, 0.25))))
	for k in range(4):
		body = Body()
		body.shape, body.material = Rod(length=1, radius=0.1), O.materials[0]
		body.state.pos = body.state.refPos = (1.19 * k, 3, 0)
		body.state.mass, body.state.inertia, body.aspherical, body.bounded = 90, (0.4, 9, 9), True, True
		body.state.blockedDOFs = 'xyzXYZ' if k in (0, 3) else ''
		O.bodies.append(body)
	contacts = [Ig2_Ellipsoid_Ellipsoid_EllipsoidGeom(), Ig2_Rod_Rod_PolytopeGeom(), Ig2_Polytope_Polytope_PolytopeGeom()]
	O.engines = polytope.engines(geometry=contacts, gravity=(0, 0, -1), timeStepper=False)
	O.dt = 1e-4
if mpi.rank() == 0: make()
mpi.divide()
mpi.run(200)
if mpi.rank() == 0:
	places = [[float(x) for x in (*body.state.pos, *body.state.vel, *body.state.angVel)] for body in O.bodies if isinstance(body.shape, (Ellipsoid, Rod))]
	print('ANSWER', json.dumps([places, sum(i.isReal for i in O.interactions)]))
"""


def testTwoRanksAgreeOnThem(rods, ellipsoid, tmp_path, monkeypatch):
	if shutil.which('mpirun') is None or 'MPI' not in polytope.buildInfo()['yadeFeatures']:
		pytest.skip('YADE has no MPI here, or there is no mpirun')
	path = tmp_path / 'rows.py'
	path.write_text(onRanks)
	monkeypatch.setenv('YADE_POLYTOPE_EXTENSIONS', f'{rods}:{ellipsoid}')
	monkeypatch.setenv('OMP_NUM_THREADS', '1')
	monkeypatch.setenv('TMPDIR', str(tmp_path))
	one, two = (
		json.loads(re.findall(r'^ANSWER (.*)$', run(*command, sys.executable, path), re.MULTILINE)[-1])
		for command in ([], ['mpirun', '--oversubscribe', '-np', '2'])
	)
	assert len(one[0]) == 10 and one[1] == two[1] == 8
	for here, there in zip(one[0], two[0], strict=True):
		assert there == pytest.approx(here, rel=1e-9, abs=1e-12)
	assert min(place[5] for place in one[0]) < -1e-3  # it moves


@pytest.fixture(scope='module')
def plane():
	return built('plane', examples=examples)


startOfPlanes = """
from yade import polytope, utils, Quaternion, Vector3
import math
polytope.load(sys.argv[1])
def material(stiffness=1e8, **more):
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5, stiffnessPerArea=False, **more))
def plane(position, orientation):
	body = Body()
	body.shape, body.material = Plane(), O.materials[-1]
	body.state.pos = body.state.refPos = position
	body.state.ori = orientation
	body.state.blockedDOFs, body.bounded, body.dynamic = 'xyzXYZ', True, False
	return body
def block(center, orientation, radius):
	return polytope.withShape(polytope.cuboid(center, (0.4, 0.3, 0.2), orientation=orientation), RoundedBlock(radius=radius))
"""


def testAFamilyWithoutBounds(plane):
	"""A slope far from the body's place, beside a rounded block, a polytope and a sphere: depth along its normal; the block rests on it,
	below the angle of friction, and slides above it."""
	script = (
		startOfPlanes
		+ """
seen = []
d, tilt = 0.01, Quaternion((1, 0, 0), 0.3)
for make in (lambda: block(tilt * Vector3(7, 8, 0.3 - d), tilt, 0.1), lambda: polytope.cuboid(tilt * Vector3(7, 8, 0.2 - d), (0.4, 0.3, 0.2), orientation=tilt), lambda: utils.sphere(tilt * Vector3(7, 8, 0.2 - d), 0.2)):
	O.reset(); material()
	O.bodies.append([plane(tilt * Vector3(-90, 40, 0), tilt), make()])
	O.engines = polytope.engines()
	O.dt = 1e-9
	O.step()
	(c,) = [i for i in O.interactions if i.isReal]
	towards = 1 if c.id1 == 0 else -1
	seen.append([float(c.geom.penetrationDepth), float((towards * c.geom.normal - tilt * Vector3(0, 0, 1)).norm()), float((c.geom.contactPoint - tilt * Vector3(7, 8, -d / 2)).norm())])
ways = []
for angle in (0.3, 0.7):
	tilt = Quaternion((1, 0, 0), angle)
	O.reset(); material()
	O.bodies.append([plane((0, 0, 0), tilt), block(tilt * Vector3(0, 0, 0.3), tilt, 0.1)])
	O.engines = polytope.engines()
	found = repr(polytope.check(O))
	O.run(6000, True)
	start = O.bodies[1].state.pos
	O.run(1000, True)
	ways.append(float((O.bodies[1].state.pos - start).norm()))
answer([seen, ways, found])
"""
	)
	(seen, ways, found), _ = inYade(script, plane)
	for (depth, normal, point), near in zip(seen, (1e-12, 1e-3, 1e-12), strict=True):  # that without a margin is less at the rim
		assert (
			depth == pytest.approx(0.01, abs=near)
			and normal == pytest.approx(0, abs=near)
			and point == pytest.approx(0, abs=max(near, 1e-9))
		)
	assert ways[0] < 1e-9 and ways[1] > 0.01
	assert found.splitlines()[0] == 'nothing was found that is wrong', found


def testTheStepBeforeContactKnowsTheLargestTangent(plane):
	"""A law that begins 100 times as stiff as the material says has a tenth of the step of one that begins with that stiffness, and a block
	that is dropped leaves no faster than it came."""
	script = (
		startOfPlanes
		+ """
def scene(tangent):
	O.reset(); material(closure=SofteningClosure(length=10 * tangent, initialTangent=tangent))
	O.bodies.append([plane((0, 0, 0), Quaternion.Identity), block((0, 0, 0.35), Quaternion.Identity, 0.1)])
	O.engines = polytope.engines(damping=0)
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
steps = []
for tangent in (0.5, 1, 100):
	scene(tangent)
	steps.append(polytope.stableTimeStep())
O.run(1, True)
while not O.interactions.countReal():
	came = abs(float(O.bodies[1].state.vel[2]))
	O.step()
while O.interactions.countReal() and O.iter < 100000: O.step()
answer([steps, came, float(O.bodies[1].state.vel[2])])
"""
	)
	(steps, came, left), _ = inYade(script, plane)
	assert steps[0] == steps[1] == pytest.approx(10 * steps[2], rel=1e-9)
	assert 0.9 * came < left < 1.01 * came


def testAClosureWithoutALawIsRefused(plane):
	script = """
from yade import polytope
polytope.load(sys.argv[1])
def said(closure):
	try: RockJointMat(closure=closure)
	except ValueError as error: return str(error)
answer([said(SilentClosure()), said(JointClosure()), said(SofteningClosure()), said(PowerClosure(exponent=0))])
"""
	(silent, base, *good), _ = inYade(script, plane)
	reason = 'has no normal law; take a class whose law() gives one, HyperbolicClosure for example, or None for a linear spring'
	assert silent == f'closure: a SilentClosure {reason}' and base == f'closure: a JointClosure {reason}'
	assert good == [None, None]
