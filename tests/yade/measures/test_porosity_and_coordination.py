# SPDX-License-Identifier: GPL-2.0-or-later
"""Porosity and coordination number of heaps against what is known."""

import math

import numpy as np
import pytest
from scenes import gravity, joint, loop
from yade import Matrix3, O, Quaternion, polytope, utils
from yade.polytope.bodies.halfSpaces import boxPlanes
from yade.polytope.measures.porosity import volumeInside


def volumeWithin(body, lower, upper):
	return volumeInside(body, *boxPlanes(lower, upper))


def testCubesOnALatticeHaveTheirPorosity():
	joint()
	for x in range(3):
		for y in range(3):
			for z in range(3):
				O.bodies.append(polytope.cuboid((x, y, z), (0.4, 0.4, 0.4)))
	solid = 0.8**3
	assert polytope.porosity((-0.5, -0.5, -0.5), (2.5, 2.5, 2.5)) == pytest.approx(1 - solid, rel=1e-12)
	# faces of the box through the middle of the outer cubes
	assert polytope.porosity((0, 0, 0), (2, 2, 2)) == pytest.approx(1 - solid, rel=1e-12)
	assert polytope.porosity((0.41, 0.41, 0.41), (0.59, 0.59, 0.59)) == 1
	assert polytope.porosity((0.7, 0.7, 0.7), (1.3, 1.3, 1.3)) == pytest.approx(0, abs=1e-12)
	assert polytope.porosity((-0.5, -0.5, -0.5), (2.5, 2.5, 2.5), ids=[0]) == pytest.approx(1 - solid / 27, rel=1e-12)


def testPorosityOfAWedgeOfTheLattice():
	"""Half of a cube's diagonal cut; and a region that is the box."""
	joint()
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)))
	normals, offsets = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 2), (0, 0, -1)], [1, 1, 1, 1, 2, 1]
	assert polytope.porosity(region=(normals, offsets)) == pytest.approx(polytope.porosity((-1, -1, -1), (1, 1, 1)), rel=1e-12)
	wedge = [*normals, (1, 1, 0)], [*offsets, 0]
	assert polytope.porosity(region=wedge) == pytest.approx(1 - 0.5 / 4, rel=1e-12)
	for name, wrong in (
		('region', {'region': (normals[:3], offsets[:3])}),
		('region', {'region': 7}),
		('region', {'lower': (0, 0, 0), 'region': wedge}),
		('lower', {}),
	):
		with pytest.raises(ValueError, match=f'^{name}: '):
			polytope.porosity(**wrong)


def testPorosityOfATiltedCellIsThatOfItsBox():
	joint()
	O.periodic = True
	O.cell.hSize = Matrix3(3, 0, 1.2, 0, 3, 0, 0, 0, 3)
	O.bodies.append([polytope.cuboid((x, 1, 1), (0.5, 0.4, 0.6)) for x in (0, 5)])
	assert polytope.porosity() == pytest.approx(1 - 2 * 0.96 / 27, rel=1e-12)
	assert polytope.porosity(
		region=([(1, 0, -0.4), (-1, 0, 0.4), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], [3, 0, 3, 0, 3, 0])
	) == pytest.approx(polytope.porosity(), rel=1e-10)


@pytest.mark.parametrize('faces', [4, 8, 20])
def testHalvesOfATurnedSolidAddUp(faces):
	joint()
	body = polytope.regular(faces, 1, (5, 6, 7), Quaternion((1, 2, 3), 1))
	O.bodies.append(body)
	for axis in range(3):
		for cut in (-0.6, -0.2, 0.1, 0.5):
			lower, upper = np.array((3.0, 4, 5)), np.array((7.0, 8, 9))
			middle = upper.copy(), lower.copy()
			for half in middle:
				half[axis] = body.state.pos[axis] + cut
			parts = volumeWithin(body, lower, middle[0]), volumeWithin(body, middle[1], upper)
			assert sum(parts) == pytest.approx(body.shape.volume, rel=1e-10)
			assert min(parts) > 0 or abs(cut) > 0.3


def testCutVolumesAgreeWithRandomPoints():
	joint()
	body = polytope.regular(12, 1, (0.3, -0.2, 0.1), Quaternion((3, 1, 2), 2))
	O.bodies.append(body)
	lower, upper = np.array((-0.5, -0.4, -0.3)), np.array((0.4, 0.8, 0.9))
	points = np.random.default_rng(1).uniform(lower, upper, (200000, 3))
	local = (points - np.array(body.state.pos)) @ np.array(body.state.ori.toRotationMatrix())
	inside = (local @ np.array(body.shape.normals, float).T <= np.array(body.shape.offsets)).all(axis=1)
	box, part = float(np.prod(upper - lower)), float(inside.mean())
	assert volumeWithin(body, lower, upper) / box == pytest.approx(part, abs=5 * math.sqrt(part * (1 - part) / len(points)))


def testBoxThatOnlyTouchesHasNoVolume():
	joint()
	body = polytope.cuboid((0, 0, 0), (1, 1, 1))
	O.bodies.append(body)
	assert volumeWithin(body, np.array((1.0, -1, -1)), np.array((2.0, 1, 1))) == 0
	assert volumeWithin(body, np.array((1 - 1e-12, -1, -1)), np.array((2.0, 1, 1))) == 0
	tetrahedron = polytope.regular(4, 1)  # boxes that meet, bodies that do not
	O.bodies.append(tetrahedron)
	corners = np.array(tetrahedron.shape.vertices, float)
	assert volumeWithin(tetrahedron, corners.max(axis=0) - 0.05, corners.max(axis=0) + 1) == 0


def testBadArgumentsAreNamed():
	joint()
	O.bodies.append(polytope.polygon([(0, 0), (1, 0), (0, 1)]))
	with pytest.raises(ValueError, match='ids: body 0 is no polyhedron'):
		polytope.porosity((0, 0, 0), (1, 1, 1))
	with pytest.raises(ValueError, match='upper'):
		polytope.porosity((0, 0, 0), (1, 0, 1))
	O.reset()
	O.bodies.append(utils.sphere((0, 0, 0), 1))
	with pytest.raises(ValueError, match='ids'):
		polytope.coordinationNumber()


@pytest.mark.parametrize('model', ['surface', 'boon2012'])
def testCoordinationOfATowerAndARattler(model):
	joint(normalStiffness=1e8)
	loop(normalDamping=1, gravity=(0, 0, -gravity), damping=0.3, ig2={'contactModel': model})
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	O.bodies.append([polytope.cuboid((0, 0, 0.4999 + 0.9998 * k), (0.5, 0.5, 0.5)) for k in range(4)])
	O.bodies.append(polytope.cuboid((5, 0, 3), (0.5, 0.5, 0.5)))  # in flight
	O.bodies.append(polytope.cuboid((3, 0, 0.4999), (0.5, 0.5, 0.5)))  # alone on the floor
	O.dt = 1e-6
	O.step()
	found = polytope.coordinationNumber()
	# tower: 2, 2, 2, 1; flight: 0; floor: 1
	assert (found.bodies, found.rattlers) == (6, 3)
	assert found.mean == pytest.approx(8 / 6) and found.mechanical == 2
	assert math.isnan(polytope.coordinationNumber(ids=[5]).mechanical)


@pytest.mark.parametrize('lean', [0, 0.3])
def testImagesOfAPeriodicCellCount(lean):
	"""A cube at a corner of the cell, straight or sheared, which any box of the cell's size cuts into parts that make one whole."""
	joint()
	O.periodic = True
	O.cell.hSize = Matrix3(1, lean, 0, 0, 1, 0, 0, 0, 1)
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.3, 0.35, 0.4)))
	hollow = 1 - 8 * 0.3 * 0.35 * 0.4
	for corner in ((0, 0, 0), (-0.5, -0.5, -0.5), (3.1, -7.2, 0.4)):
		assert polytope.porosity(corner, [x + 1 for x in corner]) == pytest.approx(hollow, rel=1e-9)
	assert polytope.porosity((0, 0, 0), (2, 3, 1)) == pytest.approx(hollow, rel=1e-9)


def testAClumpIsOneBody():
	joint(normalStiffness=1e8)
	loop(normalDamping=1, gravity=(0, 0, -gravity), damping=0.3)
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	clump, members = O.bodies.appendClumped([polytope.cuboid((x, 0, 0.4999), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5)])
	O.bodies.append(polytope.cuboid((0, 0, 1.4998), (0.5, 0.5, 0.5)))  # on both members
	held, _ = O.bodies.appendClumped([polytope.cuboid((x, 0, 0.4999), (0.5, 0.5, 0.5)) for x in (4.5, 5.5)])
	O.bodies[held].dynamic = False
	O.dt = 1e-6
	O.step()
	found = polytope.coordinationNumber()
	assert (found.bodies, found.rattlers) == (2, 0)
	assert found.mean == (4 + 2) / 2  # two members on the floor, one body on both
	assert polytope.porosity((-1, -0.5, 0), (1, 0.5, 0.9), ids=[clump]) == pytest.approx(0, abs=1e-3)
	assert polytope.porosity((-1, -0.5, 0), (1, 0.5, 0.9)) == pytest.approx(0, abs=1e-3)
	for call in (polytope.coordinationNumber, lambda ids: polytope.porosity((0, 0, 0), (1, 1, 1), ids=ids)):
		with pytest.raises(ValueError, match=f'ids: body {members[0]} is a member of clump {clump}'):
			call(ids=[members[0]])


@pytest.mark.parametrize('ids', [[99], [-1], ['a'], [0, 0], 0])
def testBodiesThatAreNotThereAreRefused(ids):
	joint()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	for call in (polytope.coordinationNumber, lambda ids: polytope.porosity((0, 0, 0), (1, 1, 1), ids=ids)):
		with pytest.raises(ValueError, match='ids'):
			call(ids)


def testBoxesWithoutAnEndAreRefused():
	with pytest.raises(ValueError, match='upper'):
		polytope.porosity((0, 0, 0), (1, 1, math.inf))
