# SPDX-License-Identifier: GPL-2.0-or-later
"""Containers from mesh files as facets: `polytope.facets(…)`, and what fromMesh says of such a mesh."""

import itertools

import numpy as np
import pytest
import trimesh
from scenes import joint
from yade import Facet, Ip2_RockJointMat_RockJointMat_RockJointPhys, O, Quaternion, polytope, utils

width, height = 2000, 1000  # [mm]


@pytest.fixture(autouse=True)
def material():
	joint()


@pytest.fixture
def cup(tmp_path):
	"""A box without a lid, of triangles: an STL file in millimetres."""
	box = trimesh.creation.box((width, width, height))
	box.update_faces(box.face_normals[:, 2] < 0.5)
	box.export(tmp_path / 'cup.stl')
	return tmp_path / 'cup.stl'


def testAMeshThatIsAContainerIsToldHowItIsRead(cup, tmp_path):
	with pytest.warns(
		UserWarning, match=r'is not closed; the body is the convex hull .*container .funnel, cup, drum. is read by polytope.facets'
	):
		polytope.fromMesh(cup, scale=1e-3)
	with pytest.raises(ValueError, match=r'is not closed, and there is no other; close it.*; a container .* is read by polytope.facets'):
		polytope.fromMesh(cup, scale=1e-3, parts='objects')
	trimesh.creation.annulus(0.8, 1, 1).export(tmp_path / 'ring.stl')
	with pytest.warns(UserWarning, match=r'is not convex: .* is read by polytope.facets'):
		polytope.fromMesh(tmp_path / 'ring.stl')


@pytest.mark.parametrize('perArea', [True, False])
def testABlockRestsInACupOfFacets(cup, perArea):
	ids = O.bodies.append(polytope.facets(cup, scale=1e-3, shift=(0, 0, 3), color=(0.1, 0.2, 0.3)))
	assert len(ids) == 10 and all(isinstance(O.bodies[k].shape, Facet) and not O.bodies[k].dynamic for k in ids)
	assert tuple(O.bodies[0].shape.color) == pytest.approx((0.1, 0.2, 0.3)) and not O.bodies[0].shape.wire
	corners = np.array(
		[O.bodies[k].state.pos + O.bodies[k].state.ori * corner for k in ids for corner in O.bodies[k].shape.vertices], float
	)
	assert corners.min(axis=0) == pytest.approx([-1, -1, 2.5]) and corners.max(axis=0) == pytest.approx([1, 1, 3.5])
	block = O.bodies[
		O.bodies.append(polytope.cuboid((0.3, 0.1, 2.81), (0.3, 0.3, 0.3), orientation=Quaternion((0, 0, 1), 0.4), velocity=(1, 0, 0)))
	]
	O.engines = polytope.engines(physics=physics(perArea))
	while O.time < 1.5:
		O.run(200, wait=True)
	assert block.state.pos[2] == pytest.approx(2.8, abs=2e-3) and block.state.vel.norm() < 1e-3
	assert abs(block.state.pos[0]) < 0.71 and O.engines[2].geomDispatcher.functors[0].stats()['failures'] == 0


def physics(perArea):
	return Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)


def testTrianglesWithoutAnAreaAreLeftOut(tmp_path):
	path = tmp_path / 'a.obj'
	path.write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n')
	with pytest.warns(UserWarning, match='^path: 1 of the 2 triangles of .*a.obj. have no area and are left out'):
		(one,) = polytope.facets(path)
	assert float(one.shape.area) == pytest.approx(0.5)
	path.write_text('v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n')
	with pytest.raises(ValueError, match='^path: .* has no triangle with an area'):
		polytope.facets(path)


def testBadArguments(cup, tmp_path):
	with pytest.raises(FileNotFoundError, match='^path: there is no file'):
		polytope.facets(tmp_path / 'none.stl')
	for arguments, words in (
		({'scale': 0}, 'scale: must be positive'),
		({'shift': 1}, 'shift: '),
		({'mask': 'a'}, 'mask: must be a whole'),
	):
		with pytest.raises(ValueError, match=f'^{words}'):
			polytope.facets(cup, **arguments)
	with pytest.raises(TypeError, match="facets: there is no argument 'center'; it takes path, scale, shift, and as all bodies material"):
		polytope.facets(cup, center=(0, 0, 0))
	assert len(O.bodies) == 0


def testPiecesOfOneThingHaveOneColour(cup):
	"""A random one, another for the next thing; or the one that is given."""

	def things(**body):
		yield polytope.plates((0, 0, 0), (1, 1, 1), **body)
		yield polytope.tube(1, 1, **body)
		yield polytope.terrain([[0, 0, 0], [0, 1, 0], [0, 0, 0]], spacing=1, **body)
		yield polytope.facets(cup, **body)

	seen = [{tuple(piece.shape.color) for piece in pieces} for pieces in [*things(), *things()]]
	assert all(len(colours) == 1 for colours in seen) and len(set.union(*seen)) == len(seen)
	assert all({tuple(piece.shape.color) for piece in pieces} == {(1, 0, 0)} for pieces in things(color=(1, 0, 0)))
	with pytest.raises(ValueError, match='^color: '):
		polytope.plates((0, 0, 0), (1, 1, 1), color='red')


@pytest.mark.parametrize('split', [1, 2])
def testAPlateThatOverhangsTheRidgeOfARoofLiesThere(split):
	"""Its centre is over facets that do not touch the ridge; those beyond the ridge must not be seen from below."""
	slope = 0.3
	rows = [k / split for k in range(-2 * split, 2 * split + 1)]
	for x, next_ in itertools.pairwise(rows):
		for y, beyond in itertools.pairwise(rows):
			one, two, three, four = ((a, b, -slope * abs(a)) for a, b in ((x, y), (next_, y), (next_, beyond), (x, beyond)))
			O.bodies.append([utils.facet([one, two, three], fixed=True), utils.facet([one, three, four], fixed=True)])
	tilt = np.arctan(slope)
	normal = np.array([-np.sin(tilt), 0, np.cos(tilt)])
	start = np.array([-0.28, -0.59, -0.28 * slope]) + 0.0401 * normal
	plate = O.bodies[O.bodies.append(polytope.cuboid(tuple(start), (0.6, 0.5, 0.04), orientation=Quaternion((0, 1, 0), -tilt)))]
	O.engines = polytope.engines()
	polytope.run(until=0.1)
	assert plate.state.vel.norm() < 1e-3
	assert np.linalg.norm(np.array(plate.state.pos, float) - start) < 1e-3
	assert all(abs(contact.geom.normal.dot(tuple(normal))) > 0.999 for contact in O.interactions if contact.isReal)
