# SPDX-License-Identifier: GPL-2.0-or-later
"""Polygons against YADE's shapes: on walls along x and y they rest, for spheres they are prisms, and with the others they do not mix."""

import pytest
from flatFace import faceForce, sunk
from scenes import bounds, gravity, joint, withPolytopes
from yade import (
	ForceResetter,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	polytope,
	utils,
)

half = 0.1
corners = [(x + 0.3, y + half - 1e-4) for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))]


def onto(support, steps=1):
	"""A square of 0.2 m that reaches 0.1 mm into what support() makes; returns (contacts, failed queries, square)."""
	joint(normalStiffness=1e6, shearStiffness=1e6)
	O.bodies.append(support())
	square = O.bodies[O.bodies.append(polytope.polygon(corners, thickness=0.5))]
	pairs = [one() for one in withPolytopes]
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.5, shearDamping=0.5, rockingDamping=0.5)
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([one() for one in bounds], verletDist=0.001),
		InteractionLoop(pairs, [Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)], [law]),
		NewtonIntegrator(gravity=(0, -gravity, 0), damping=0.3),
	]
	O.dt = 2e-4
	for _ in range(steps):
		O.step()
	return [contact for contact in O.interactions if contact.isReal], sum(pair.stats()['failures'] for pair in pairs), square


@pytest.mark.parametrize('sense', [0, 1])
def testRestsOnAWallAlongY(sense):
	(contact,), failed, square = onto(lambda: utils.wall(0, 1, sense=sense), 3000)
	weight = square.state.mass * gravity
	assert failed == 0 and contact.geom.status == 'contact'
	assert contact.phys.normalForce.norm() == pytest.approx(weight, rel=1e-3)
	assert square.state.pos[1] == pytest.approx(half - sunk(weight / 1e6, (2 * half,)), abs=1e-7) and square.state.pos[2] == 0
	assert contact.geom.contactArea in (0, pytest.approx(2 * half * 0.5, rel=1e-3))


def testLeansOnAWallAlongX():
	contacts, failed, _ = onto(lambda: utils.wall(0.3 - half + 1e-4, 0, sense=1))
	assert failed == 0 and len(contacts) == 1 and abs(contacts[0].geom.normal[0]) == pytest.approx(1)
	assert contacts[0].geom.penetrationDepth == pytest.approx(faceForce(1e-4, (2 * half,)), rel=1e-9)


def testRestsOnASphereAsAPrismOfItsThickness():
	(contact,), failed, square = onto(lambda: utils.sphere((0.3, -0.5, 0.2), 0.5, fixed=True), 3000)
	weight = square.state.mass * gravity
	assert failed == 0 and contact.phys.normalForce.norm() == pytest.approx(weight, rel=1e-3)
	assert contact.geom.contactPoint[2] == pytest.approx(0.2)  # within 0.25 of the plane: on the prism's side
	O.bodies[0].state.pos = (0.3, -0.5, 0.8)  # its nearest point is an edge of the prism, at z = 0.25, too far away
	O.run(5, True)
	assert not any(one.isReal for one in O.interactions)


@pytest.mark.parametrize(
	'support',
	[
		lambda: utils.wall(0, 2),
		lambda: utils.wall(-0.1, 2, sense=1),
		lambda: utils.box((0, -0.5, 0), (1, 0.5, 1), fixed=True),
		lambda: utils.facet([(-1, 0, -1), (1, 0, -1), (0, 0, 1)], fixed=True),
		lambda: polytope.cuboid((0, -0.5, 0), (1, 0.5, 1), fixed=True),
	],
	ids=['wall along z', 'wall of one side', 'box', 'facet', 'polyhedron'],
)
def testWhatDoesNotMixIsCountedAndNamedBefore(support):
	onto(support, 0)
	assert 'polytope.polygon' in polytope.check(O)['polygons'].advice
	O.step()
	assert sum(pair.stats()['failures'] for pair in O.engines[2].geomDispatcher.functors) == 1
	assert not any(one.isReal for one in O.interactions)


def testWhatMixesIsNotNamed():
	onto(lambda: utils.wall(0, 1), 0)
	assert 'polygons' not in [one.what for one in polytope.check(O)]
	O.bodies.append(utils.sphere((5, 0, 0), 0.5))
	assert 'polygons' not in [one.what for one in polytope.check(O)]
