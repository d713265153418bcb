# SPDX-License-Identifier: GPL-2.0-or-later
"""Polytopes against YADE's own walls, boxes, facets and spheres: a block comes to rest and is carried, on each."""

import json
import math
import os
import pathlib
import re
import subprocess
import sys

import pytest
from flatFace import faceForce
from scenes import bounds, withPolytopes
from yade import (
	Bo1_Box_Aabb,
	Bo1_Facet_Aabb,
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	ForceResetter,
	FrictMat,
	Ig2_Box_Polytope_PolytopeGeom,
	Ig2_Facet_Polytope_PolytopeGeom,
	Ig2_Sphere_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Law2_ScGeom_FrictPhys_CundallStrack,
	NewtonIntegrator,
	O,
	Vector3,
	polytope,
	utils,
)


def settle(supports, body, steps=8000, mayLieWithin=False):
	O.reset()
	O.materials.append(FrictMat(young=1e7, poisson=0.5, frictionAngle=0.5, density=2600))
	for support in supports:
		O.bodies.append(support())
	block = O.bodies[O.bodies.append(body())]
	functors = [one() for one in withPolytopes]
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([one() for one in bounds], verletDist=0.01),
		InteractionLoop(functors, [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.4),
	]
	O.dt = 1e-4
	O.run(steps, True)
	contacts = [i for i in O.interactions if i.isReal]
	carried = sum((i.phys.normalForce + i.phys.shearForce)[2] * (1 if i.id2 == block.id else -1) for i in contacts)
	assert all(f.stats()['failures'] == (f.stats()['statuses']['noDirection'] if mayLieWithin else 0) for f in functors)
	return block, contacts, carried


def cube():
	return polytope.cuboid((0.05, 0.03, 0.11), (0.1, 0.1, 0.1))


SUPPORTS = {
	'wall': [lambda: utils.wall(0, 2)],
	'wall, upper side': [lambda: utils.wall(0, 2, sense=1)],
	'box': [lambda: utils.box((0, 0, -0.1), (1, 1, 0.1), fixed=True)],
	'facet': [lambda: utils.facet([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], fixed=True)],
	'facet seen from behind': [lambda: utils.facet([(0, 1, 0), (1, -1, 0), (-1, -1, 0)], fixed=True)],
	'two facets': [
		lambda: utils.facet([(-1, -1, 0), (1, -1, 0), (1, 1, 0)], fixed=True),
		lambda: utils.facet([(-1, -1, 0), (1, 1, 0), (-1, 1, 0)], fixed=True),
	],
	'polytope': [lambda: polytope.cuboid((0, 0, -0.1), (1, 1, 0.1), fixed=True)],
	'sphere': [lambda: utils.sphere((0.05, 0.03, -1), 1, fixed=True)],
}


@pytest.mark.parametrize('support', SUPPORTS)
def testCubeRestsOn(support):
	block, contacts, carried = settle(SUPPORTS[support], cube)
	assert len(contacts) == len(SUPPORTS[support])
	assert carried == pytest.approx(9.81 * block.state.mass, rel=1e-3)
	depths = [i.geom.penetrationDepth for i in contacts]
	assert all(0 < d < 0.002 for d in depths)
	assert abs(block.state.pos[2] - (0.1 - max(depths))) < 2e-4
	assert all(i.geom.status == 'contact' for i in contacts)


def testSphereRestsOnPolytope():
	ball, contacts, carried = settle(SUPPORTS['polytope'], lambda: utils.sphere((0.1, 0.2, 0.11), 0.1))
	assert len(contacts) == 1 and carried == pytest.approx(9.81 * ball.state.mass, rel=1e-3)
	geom = contacts[0].geom
	assert geom.normal[2] == (-1 if contacts[0].id1 == ball.id else 1)
	assert ball.state.pos[2] == pytest.approx(0.1 - geom.penetrationDepth, abs=1e-12)
	assert geom.contactPoint[2] == pytest.approx(-geom.penetrationDepth / 2, abs=1e-12)


@pytest.mark.parametrize(
	'sense, start, through', [(-1, 0.15, True), (-1, -0.15, False), (1, 0.15, False), (1, -0.15, True), (0, 0.15, False), (0, -0.15, False)]
)
def testWallStopsOnItsSideAndLetsThroughFromTheOther(sense, start, through):
	"""A block thrown at it: 0.15 s later it is on the other side of the wall, or still on its own."""

	def thrown():
		block = polytope.cuboid((0.05, 0.03, start), (0.1, 0.1, 0.1))
		block.state.vel = (0, 0, -20 * start)
		return block

	# behind the wall it lies within the half-space, where nothing gives a direction
	block, contacts, _ = settle([lambda: utils.wall(0, 2, sense=sense)], thrown, steps=1500, mayLieWithin=through)
	assert (block.state.pos[2] * start < 0) == through
	assert not (contacts and through)


def testSphereAgainstEdgeAndVertex():
	# a unit cube's edge and vertex: shortest distances known
	O.reset()
	O.materials.append(FrictMat())
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1), fixed=True))
	for direction in (Vector3(1, 1, 0), Vector3(1, 1, 1), Vector3(1, 0.2, 0.3)):
		corner = Vector3(*[1 if d == 1 else d for d in direction])
		away = Vector3(*[1 if d == 1 else 0 for d in direction]).normalized()
		O.bodies.append(utils.sphere(corner + 0.45 * away, 0.5, fixed=True))
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb(), Bo1_Sphere_Aabb()]),
		InteractionLoop(
			[Ig2_Sphere_Polytope_PolytopeGeom()],
			[Ip2_FrictMat_FrictMat_FrictPhys()],
			[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
		),
		NewtonIntegrator(),
	]
	O.dt = 1e-6
	O.step()
	contacts = [i for i in O.interactions if i.isReal]
	assert len(contacts) == 3
	for i in contacts:
		assert i.geom.penetrationDepth == pytest.approx(0.05, abs=1e-12)
		# from the sphere (body 1) to the cube
		assert i.id1 != 0 and i.geom.normal.dot(O.bodies[i.id1].state.pos) < 0


def testBoxWithoutVolumeIsCountedNotFatal():
	O.reset()
	O.materials.append(FrictMat())
	O.bodies.append(utils.box((0, 0, 0), (1, 1, 0), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.05), (0.1, 0.1, 0.1)))
	functor = Ig2_Box_Polytope_PolytopeGeom()
	O.engines = [
		InsertionSortCollider([Bo1_Polytope_Aabb(), Bo1_Box_Aabb()]),
		InteractionLoop([functor], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
		NewtonIntegrator(),
	]
	O.step()
	assert functor.stats()['failures'] == 1 and not [i for i in O.interactions if i.isReal]


def pressed(h):
	"""Depth of a contact in which a cube of 0.2 m has sunk by h."""
	return faceForce(h, (0.2, 0.2))


def held(support, functor, bound):
	"""A cube fixed 1e-4 deep in what is under it, and the engines of one such pair."""
	O.reset()
	O.materials.append(FrictMat())
	O.bodies.append(support)
	O.bodies.append(polytope.cuboid((0, 0, 0.0999), (0.1, 0.1, 0.1), fixed=True))
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb(), bound], verletDist=0.01),
		InteractionLoop([functor], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
		NewtonIntegrator(),
	]
	O.dt = 1e-6
	O.step()
	(contact,) = O.interactions
	assert float(contact.geom.penetrationDepth) == pytest.approx(pressed(1e-4), rel=1e-9)
	return contact


def testBoxThatGrowsInARun():
	functor = Ig2_Box_Polytope_PolytopeGeom()
	contact = held(utils.box((0, 0, -0.1), (1, 1, 0.1), fixed=True), functor, Bo1_Box_Aabb())
	O.bodies[0].shape.extents = (1, 1, 0.1005)
	O.step()
	assert contact.geom.penetrationDepth == pytest.approx(pressed(6e-4), rel=1e-9)
	O.bodies[0].shape.extents = (1, 1, 0.1)
	O.step()
	assert float(contact.geom.penetrationDepth) == pytest.approx(pressed(1e-4), rel=1e-9)
	assert functor.stats()['failures'] == 0


def testBoxThatLosesItsVolumeInARun():
	functor = Ig2_Box_Polytope_PolytopeGeom()
	contact = held(utils.box((0, 0, -0.1), (1, 1, 0.1), fixed=True), functor, Bo1_Box_Aabb())
	O.bodies[0].shape.extents = (1, 1, 0)
	O.step()
	assert functor.stats()['failures'] == 1 and contact.geom.status == 'failed'
	O.bodies[0].shape.extents = (1, 1, 0.1)
	O.step()
	assert functor.stats()['failures'] == 1 and contact.geom.status == 'contact'


@pytest.mark.parametrize('flip', [1, -1])
def testFacetWhoseCornersMoveInARun(flip):
	corners = [Vector3(-1, -1, 0), Vector3(1, -1, 0), Vector3(0, 1, 0)][::flip]
	functor = Ig2_Facet_Polytope_PolytopeGeom()
	contact = held(utils.facet(corners, fixed=True), functor, Bo1_Facet_Aabb())
	shape = O.bodies[0].shape
	before = list(shape.vertices)
	shape.vertices = [v + Vector3(0, 0, 5e-4) for v in before]
	O.step()
	assert contact.geom.penetrationDepth == pytest.approx(pressed(6e-4), rel=1e-9)
	shape.vertices = before
	O.step()
	assert float(contact.geom.penetrationDepth) == pytest.approx(pressed(1e-4), rel=1e-9)
	assert functor.stats()['failures'] == 0


strange = '''
import json, math, os, sys
from yade import Bo1_Box_Aabb, Bo1_Facet_Aabb, Ig2_Box_Polytope_PolytopeGeom, Ig2_Facet_Polytope_PolytopeGeom, O, Vector3, utils
sys.path[:0] = sys.argv[1], os.path.dirname(sys.argv[1])
from test_mixed_pairs import held

numbers = [math.nan, math.inf, -math.inf, 0, -1, 1e-160, 1e-51, 1e-14, 1e-11, 1e-9, 1e-7, 1e8, 1e16, 1e30, 1e51, 1e160]
answers = []

def stepWith(functor, contact, extents=None, vertices=None):
	shape = O.bodies[0].shape
	if extents: shape.extents = extents
	if vertices: shape.vertices = vertices
	O.step()
	geom = contact.geom  # None where a thin solid has let go
	answers.append((geom.status, float(geom.penetrationDepth) if contact.isReal else 0) if geom else ('none', 0))

box = Ig2_Box_Polytope_PolytopeGeom()
contact = held(utils.box((0, 0, -.1), (1, 1, .1), fixed=True), box, Bo1_Box_Aabb())
for x in numbers:
	for axis in range(3):
		extents = [1, 1, .1]
		extents[axis] = x
		stepWith(box, contact, extents=extents)
stepWith(box, contact, extents=(1, 1, .1))
facet = Ig2_Facet_Polytope_PolytopeGeom()
contact = held(utils.facet([Vector3(-1, -1, 0), Vector3(1, -1, 0), Vector3(0, 1, 0)], fixed=True), facet, Bo1_Facet_Aabb())
corners = [Vector3(v) for v in O.bodies[0].shape.vertices]
for x in numbers:
	for axis in range(3):
		moved = [Vector3(v) for v in corners]
		moved[0][axis] = x
		stepWith(facet, contact, vertices=moved)
	stepWith(facet, contact, vertices=[x * v for v in corners])
for moved in ([corners[0], corners[0], corners[1]], [corners[0]] * 3, corners):
	stepWith(facet, contact, vertices=moved)
counted = sum(functor.stats()['statuses']['failed'] for functor in (box, facet))
print('ANSWERS', json.dumps([answers, counted]))
'''


def testStrangeBoxesAndFacetsAreCountedNotFatal():
	"""YADE's loop has extents and corners that are no solid, too thin, too far, or no numbers. Afterwards all is as before."""
	where = os.path.dirname(os.path.abspath(__file__))
	done = subprocess.run(
		[sys.executable, '-c', strange, where], env={**os.environ, 'OMP_NUM_THREADS': '1'}, capture_output=True, text=True, timeout=600
	)
	assert done.returncode == 0, done.stderr[-2000:]
	answers, counted = json.loads(next(line for line in done.stdout.splitlines() if line.startswith('ANSWERS'))[8:])
	failed = [status == 'failed' for status, _ in answers]
	assert counted == sum(failed) > 40 and len(answers) == 3 * 16 + 1 + 4 * 16 + 3
	ends = answers[3 * 16], answers[-1]  # the box and the facet as they were
	assert all(status == 'contact' and depth == pytest.approx(pressed(1e-4), rel=1e-9) for status, depth in ends)
	assert all(math.isfinite(depth) for _, depth in answers)


def testStandInsAreMadeWhereNothingIsThrown():
	"""Construction may also end with what no box or facet above brings about (no inscribed ball found, no memory): all is made within shapeOrNull,
	which lets nothing out (tests/core/ShapeFactoryTest.cpp)."""
	folder = pathlib.Path(__file__).resolve().parents[3] / 'pkg/polytope/contact'
	source = ''.join((folder / name).read_text() for name in ('MixedPairs.cpp', 'StandIns.cpp'))
	assert re.findall(r'\bpartner\s*=\s*([\w:]+)', source) == ['polytope::shapeOrNull'] * 3
