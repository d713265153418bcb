# SPDX-License-Identifier: GPL-2.0-or-later
"""The example of a shape of one's own, a polyhedron rounded by a ball: closed forms, both colliders, scenes."""

import pytest
from test_extensions import inYade, rounded  # noqa: F401, as fixtures

start = """
from yade import polytope, Quaternion, Vector3
import math
polytope.load(sys.argv[1])
h, r = 0.4, 0.1
def material(stiffness=1e7):
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5))
def cube(center, radius=r, orientation=Quaternion.Identity, **more):
	body = polytope.cuboid(center=center, extents=(h,) * 3, orientation=orientation, **more)
	if radius: body.shape = RoundedPolytope(normals=body.shape.normals, offsets=body.shape.offsets, radius=radius)
	return body
def contacts():
	own = [Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom(), Ig2_Polytope_RoundedPolytope_PolytopeGeom(), Ig2_Wall_RoundedPolytope_PolytopeGeom()]
	return own + [Ig2_Polytope_Polytope_PolytopeGeom(), Ig2_Wall_Polytope_PolytopeGeom()]
def bounds():
	return [Bo1_Polytope_Aabb(), Bo1_Wall_Aabb()]
def loop():
	return InteractionLoop(contacts(), [Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()])
"""


def testDepthsHaveTheirClosedForms(rounded):  # noqa: F811
	"""Faces, crossed edges, a corner on a face, corner on corner; with sharp bodies; with walls: depth 0.01 m, and the normal."""
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
	O.engines = [ForceResetter(), InsertionSortCollider(bounds()), loop()]
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
answer(seen)
"""
	)
	seen, _ = inYade('from yade import utils\n' + script, rounded)
	assert len(seen) == 14
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
	"""A sharp cube on a rounded one on a wall, under the plug-in's own engines with these contacts: stiffness times depth is the weight above, upright, and nothing is found wrong."""
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


def testWithoutItsFunctorsCheckSaysSo(rounded):  # noqa: F811
	"""With the plug-in's own functors alone the body is taken for its planes, and check says that."""
	script = (
		start
		+ """
material()
O.bodies.append([cube((0, 0, 0), fixed=True), cube((0, 0, 2 * h + 2 * r))])
O.engines = polytope.engines()
answer([[one.what, one.seen] for one in polytope.check(O)])
"""
	)
	found, _ = inYade(script, rounded)
	assert [
		'contact functors',
		'there is no functor for RoundedPolytope and RoundedPolytope: RoundedPolytope is taken for the Polytope of its planes',
	] in found
