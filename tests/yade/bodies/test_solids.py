# SPDX-License-Identifier: GPL-2.0-or-later
"""Prisms, frustums, containers and terrain: volumes by closed forms, no gaps, no overlaps, and what rests in them stays."""

from math import cos, pi, sin, tan

import numpy as np
import pytest
import trimesh
from yade import O, Quaternion, RockJointMat, Vector3, polytope


@pytest.fixture(autouse=True)
def material():
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6))


def deepest(bodies):
	return max(polytope.contact(a, b).depth for k, a in enumerate(bodies) for b in bodies[:k])


def inside(body, point):
	local = body.state.ori.conjugate() * (Vector3(*point) - body.state.pos)
	return all(normal.dot(local) <= offset for normal, offset in zip(body.shape.normals, body.shape.offsets, strict=True))


def corners(body):
	return np.array([body.state.pos + body.state.ori * corner for corner in body.shape.vertices], float)


def testPrism():
	body = polytope.prism([(0, 0), (2, 0), (0, 1)], 3)
	assert body.shape.volume == pytest.approx(3, rel=1e-12) and len(body.shape.faces) == 5
	assert list(body.state.pos) == pytest.approx([2 / 3, 1 / 3, 1.5])
	assert body.shape.dimension == 3 and body.dynamic
	assert list(polytope.prism([(0, 0), (2, 0), (0, 1)], 3, center=(1, 2, 3)).state.pos) == [1, 2, 3]


@pytest.mark.parametrize('faces, bottom, top, height', [(3, 1, 1, 2), (4, 2, 1, 3), (6, 1, 0, 1), (40, 0.5, 2, 1)])
def testFrustum(faces, bottom, top, height):
	body = polytope.frustum(faces, bottom, top, height)
	area = faces * sin(2 * pi / faces) / 2
	assert body.shape.volume == pytest.approx(area * height * (bottom**2 + bottom * top + top**2) / 3, rel=1e-12)
	assert len(body.shape.faces) == faces + (2 if top else 1)
	assert corners(body)[:, 2].min() == pytest.approx(0, abs=1e-12) and corners(body)[:, 2].max() == pytest.approx(height)


def testPlatesRoundABox():
	made = polytope.plates((0, 0, 0), (1, 2, 3), thickness=0.2)
	assert len(made) == 6 and all(not body.dynamic for body in made)
	assert sum(body.shape.volume for body in made) == pytest.approx(1.4 * 2.4 * 3.4 - 6, rel=1e-12)
	assert deepest(made) < 1e-12
	for point in np.random.default_rng(1).uniform((-0.2, -0.2, -0.2), (1.2, 2.2, 3.2), (200, 3)):
		within = (point > 0).all() and (point < (1, 2, 3)).all()
		assert sum(inside(body, point) for body in made) == (0 if within else 1)


def testPlatesWithoutALid():
	made = polytope.plates((0, 0, 0), (1, 1, 1), without='+z', color=(0, 1, 0))
	assert len(made) == 5 and all(body.state.pos[2] < 1 for body in made)
	assert all(list(body.shape.color) == [0, 1, 0] for body in made)
	assert made[0].shape.volume == pytest.approx(0.1, rel=1e-12), 'a tenth of the extent'
	assert polytope.plates((0, 0, 0), (1, 1, 1), fixed=False)[0].dynamic
	assert len(polytope.plates((0, 0, 0), (1, 1, 1), without=('+z', '-x'))) == 4


def testTubeOfPlates():
	made = polytope.tube(1, 2, number=12, thickness=0.1, center=(3, 4, 5))
	area = 12 * tan(pi / 12)
	assert len(made) == 12 and all(not body.dynamic for body in made)
	assert sum(body.shape.volume for body in made) == pytest.approx(area * (1.1**2 - 1) * 2, rel=1e-12)
	assert deepest(made) < 1e-12
	for angle in np.linspace(0, 2 * pi, 37)[:-1]:
		at = [Vector3(3 + r * cos(angle + 1e-3), 4 + r * sin(angle + 1e-3), 5.9) for r in (0.999, 1.05)]
		assert [sum(inside(body, point) for body in made) for point in at] == [0, 1]


def testTurnedTube():
	made = polytope.tube(1, 2, number=8, center=(1, 0, 0), orientation=Quaternion((0, 1, 0), pi / 2))
	reach = np.concatenate([corners(body) for body in made])
	assert reach[:, 0].min() == pytest.approx(0) and reach[:, 0].max() == pytest.approx(2)


def testTerrainOfAHeightMap():
	heights = [[0.1 * i * i + 0.2 * j for j in range(4)] for i in range(5)]
	made = polytope.terrain(heights, spacing=0.5, depth=1, origin=(10, 20))
	assert len(made) == 2 * 4 * 3 and all(not body.dynamic for body in made)
	mean = [np.mean([heights[i][j], heights[i + 1][j], heights[i][j + 1]]) for i in range(4) for j in range(3)]
	mean += [np.mean([heights[i + 1][j], heights[i + 1][j + 1], heights[i][j + 1]]) for i in range(4) for j in range(3)]
	assert sum(body.shape.volume for body in made) == pytest.approx(sum(0.125 * (h + 1) for h in mean), rel=1e-12)
	assert deepest(made) < 1e-12
	top = {tuple(np.round(corner, 9)) for body in made for corner in corners(body) if corner[2] > -0.5}
	assert top == {(round(10 + 0.5 * i, 9), round(20 + 0.5 * j, 9), round(heights[i][j], 9)) for i in range(5) for j in range(4)}


def testTerrainOfAMesh(tmp_path):
	points = [(0, 0, 1), (2, 0, 1), (0, 2, 2), (2, 2, 1), (2, 2, 3)]
	trimesh.Trimesh(points, [(0, 1, 2), (1, 3, 2), (1, 3, 4)], process=False).export(tmp_path / 'hill.stl')
	made = polytope.terrain(tmp_path / 'hill.stl', depth=1)
	assert len(made) == 2, 'the vertical triangle is left out'
	assert sum(body.shape.volume for body in made) == pytest.approx(2 * (4 / 3 + 4 / 3), rel=1e-6)


def _hill():
	"""A surface of 96 triangles."""
	x, y = np.meshgrid(np.linspace(0, 4, 9), np.linspace(0, 3, 7), indexing='ij')
	top = np.stack([x, y, 1 + np.sin(x) * np.cos(y)], axis=-1).reshape(-1, 3)
	first = [7 * i + j for i in range(8) for j in range(6)]
	return trimesh.Trimesh(top, [three for k in first for three in ((k, k + 7, k + 1), (k + 7, k + 8, k + 1))], process=False)


def _volume(made):
	return sum(float(body.shape.volume) for body in made)


def testTerrainOfAClosedMeshIsThatOfItsUpperSide(tmp_path):
	hill = _hill()
	hill.export(tmp_path / 'open.ply')
	solid = trimesh.creation.extrude_triangulation(hill.vertices[:, :2], hill.faces, 1)
	upper = solid.vertices[:, 2] > 0.5
	lookup = {tuple(np.round(v[:2], 9)): v[2] for v in hill.vertices}
	solid.vertices = [(x, y, lookup[tuple(np.round((x, y), 9))] if up else -3) for (x, y, _), up in zip(solid.vertices, upper, strict=True)]
	assert solid.is_watertight
	for turned in (False, True):
		if turned:
			solid.invert()
		solid.export(tmp_path / 'closed.stl')
		closed = polytope.terrain(tmp_path / 'closed.stl', depth=1)
		assert len(closed) == 96
		assert _volume(closed) == pytest.approx(_volume(polytope.terrain(tmp_path / 'open.ply', depth=1)), rel=1e-5)


def testTerrainInOtherUnitsAndPlaces(tmp_path):
	hill = _hill().apply_translation((4e5, 5e6, 100))
	hill.export(tmp_path / 'hill.obj', digits=9)
	made = polytope.terrain(tmp_path / 'hill.obj', depth=2, scale=0.5, shift=(-2e5, -2.5e6, -50))
	reach = np.concatenate([corners(body) for body in made])
	assert reach.min(axis=0)[:2] == pytest.approx((0, 0), abs=1e-6) and reach.max(axis=0)[:2] == pytest.approx((2, 1.5), abs=1e-6)
	assert reach[:, 2].max() == pytest.approx(1, abs=0.05)
	moved = polytope.terrain([[0, 0], [0, 0]], spacing=1, depth=1, scale=2, shift=(5, 6, 7))
	reach = np.concatenate([corners(body) for body in moved])
	assert (reach.min(axis=0), reach.max(axis=0)) == (pytest.approx((5, 6, 6)), pytest.approx((7, 8, 7)))


@pytest.mark.parametrize('scale', [0, -1, float('nan'), 'mm'])
def testTerrainRefusesAScale(scale):
	with pytest.raises(ValueError, match='^scale: '):
		polytope.terrain([[0, 0], [0, 0]], spacing=1, scale=scale)


def testTerrainNamesTheArgument(tmp_path):
	_hill().export(tmp_path / 'hill.ply')
	with pytest.raises(ValueError, match='^spacing: is that of a height map'):
		polytope.terrain(tmp_path / 'hill.ply', spacing=1)
	with pytest.raises(ValueError, match='^heights: must be rows'):
		polytope.terrain(_hill())


@pytest.mark.parametrize('kind', ['cave', 'twice'])
def testGroundThatHangsOverIsRefused(kind, tmp_path):
	"""A roof beside the ground in an open mesh; ground that is there twice."""
	hill = _hill()
	other = trimesh.Trimesh([(1, 1, 3), (2, 1, 3), (1, 2, 3)], [(0, 1, 2)], process=False) if kind == 'cave' else hill.copy()
	trimesh.util.concatenate([hill, other]).export(tmp_path / 'ground.obj')
	with pytest.raises(ValueError, match=r'^heights: .*hangs over.*\(x, y\) = \(.*polytope.facets'):
		polytope.terrain(tmp_path / 'ground.obj')


def testABlockRestsInAContainerOnTerrain():
	O.bodies.append(polytope.plates((0, 0, 0), (2, 2, 2), without=('+z', '-z')))
	O.bodies.append(polytope.terrain(np.zeros((5, 5)), spacing=0.5, depth=0.2))
	block = O.bodies.append(polytope.cuboid((0.9, 1.2, 0.21), (0.3, 0.3, 0.2), velocity=(0.2, 0, 0)))
	O.engines = polytope.engines()
	while O.time < 1:
		O.step()
	state = O.bodies[block].state
	assert state.pos[2] == pytest.approx(0.2, abs=1e-3) and state.vel.norm() < 1e-3


@pytest.mark.parametrize(
	'build, name',
	[
		(lambda: polytope.prism([(0, 0), (1, 0), (0, 1)], 0), 'height'),
		(lambda: polytope.prism([(0, 0), (1, 0)], 1), 'points2d'),
		(lambda: polytope.prism([(0, 0, 1)], 1), 'points2d'),
		(lambda: polytope.frustum(2, 1, 1, 1), 'faces'),
		(lambda: polytope.frustum(4, 0, 1, 1), 'bottom'),
		(lambda: polytope.frustum(4, 1, -1, 1), 'top'),
		(lambda: polytope.frustum(4, 1, 1, float('inf')), 'height'),
		(lambda: polytope.plates((0, 0, 0), (1, 0, 1)), 'upper'),
		(lambda: polytope.plates((0, 0), (1, 0, 1)), 'lower'),
		(lambda: polytope.plates((0, 0, 0), (1, 1, 1), thickness=-1), 'thickness'),
		(lambda: polytope.plates((0, 0, 0), (1, 1, 1), without='top'), 'without'),
		(lambda: polytope.tube(0, 1), 'radius'),
		(lambda: polytope.tube(1, 1, number=2), 'number'),
		(lambda: polytope.tube(1, 1, orientation=1), 'orientation'),
		(lambda: polytope.terrain([[0, 1]], 1), 'heights'),
		(lambda: polytope.terrain([[0, 1], [1, float('nan')]], 1), 'heights'),
		(lambda: polytope.terrain([[0, 1], [1, 2]]), 'spacing'),
		(lambda: polytope.terrain([[0, 1], [1, 2]], 1, depth=0), 'depth'),
	],
)
def testRefusals(build, name):
	with pytest.raises(ValueError, match=f'^{name}: '):
		build()


@pytest.mark.parametrize(
	'name, arguments', [('plates', ((0, 0, 0), (1, 1, 1))), ('tube', (1, 1)), ('prism', ([(0, 0), (1, 0), (0, 1)], 1))]
)
def testUnknownArgumentNamesTheFunction(name, arguments):
	with pytest.raises(TypeError, match=f"^{name}: there is no argument 'colour'"):
		getattr(polytope, name)(*arguments, colour=(1, 0, 0))


def testMissingMeshOfTerrain():
	with pytest.raises(FileNotFoundError, match='heights: there is no file'):
		polytope.terrain('nowhere.stl')
