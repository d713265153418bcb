# SPDX-License-Identifier: GPL-2.0-or-later
"""Voronoi cells fill their region once, share faces, and are the points nearest to their seed."""

import math

import numpy as np
import pytest
from yade import O, Quaternion, RockJointMat, Vector3, polytope

box = (0, 1, -2), (3, 2, 0.5)
volume = 3 * 1 * 2.5


def testVolumesAddUp():
	cells = polytope.voronoi(box, 200, seed=1)
	assert len(cells.blocks) == len(cells.volumes) == len(cells.seeds) == 200
	assert cells.volumes.sum() == pytest.approx(volume, rel=1e-12)
	bodies = [polytope.fromHalfSpaces(*block) for block in cells.blocks]
	assert sum(body.shape.volume for body in bodies) == pytest.approx(volume, rel=1e-12)


@pytest.mark.parametrize('periodic', [False, True])
@pytest.mark.parametrize(('far', 'size'), [(1e6, 1), (1e6, 1e6), (-1e9, 1), (0, 1e-6), (10, 1e-6)])
def testFarAwayAndOfAnySize(far, size, periodic):
	"""Cells of a box are those of the box at the origin, moved and scaled; bodies are made of them as far as coordinates have digits."""
	corners = np.full(3, float(far)), np.full(3, float(far)) + size
	size = corners[1] - corners[0]
	here = polytope.voronoi(((0, 0, 0), (1, 1, 1)), 20, seed=1, periodic=periodic)
	there = polytope.voronoi(corners, 20, seed=1, periodic=periodic)
	digits = 1e-14 * max(1, abs(far) / size[0])
	assert there.volumes.sum() == pytest.approx(np.prod(size), rel=1e-12)
	assert there.volumes == pytest.approx(here.volumes * np.prod(size), rel=1e-9)
	assert there.seeds == pytest.approx(here.seeds * size + far, rel=1e-15, abs=1e-12 * size[0])
	bodies = [polytope.fromHalfSpaces(*block) for block in there.blocks]
	assert sum(body.shape.volume for body in bodies) == pytest.approx(np.prod(size), rel=100 * digits)


@pytest.mark.parametrize('number', [1, 2, 5, 9, 40])
def testFewCells(number):
	assert polytope.voronoi(box, number, seed=3).volumes.sum() == pytest.approx(volume, rel=1e-12)


def testCellsAreThePointsNearestToTheirSeed():
	cells = polytope.voronoi(box, 60, seed=2)
	points = np.random.default_rng(5).uniform(*box, (300, 3))
	nearest = np.linalg.norm(points[:, None] - cells.seeds, axis=2).argmin(axis=1)
	for point, own in zip(points, nearest, strict=True):
		inside = [(np.array(normals, float) @ point <= np.array(offsets, float)).all() for normals, offsets in cells.blocks]
		assert inside == [k == own for k in range(60)]


def testNeighboursShareTheirPlaneToTheLastBit():
	cells = polytope.voronoi(box, 30, seed=4)
	planes = [{(*normal, offset) for normal, offset in zip(*block, strict=True)} for block in cells.blocks]
	everywhere = set().union(*planes)
	region = 0
	for plane in everywhere:
		if tuple(-x for x in plane) not in everywhere:
			region += 1
	assert region <= 6, 'only the faces of the box have no other side'


def testConvexRegion():
	normals = [(1, 1, 1), (-2, 0, 0), (0, -1, 0), (0, 0, -1)]  # a tetrahedron with edges of 1
	cells = polytope.voronoi((normals, [1, 0, 0, 0]), 50, seed=1)
	assert cells.volumes.sum() == pytest.approx(1 / 6, rel=1e-12)


def testPeriodicCellsFillTheBoxWithTheirImages():
	cells = polytope.voronoi(box, 20, periodic=True, seed=1)
	extent = np.subtract(box[1], box[0])
	assert cells.volumes.sum() == pytest.approx(volume, rel=1e-12)
	points = np.random.default_rng(5).uniform(*box, (100, 3))
	shifts = [np.array(s) * extent for s in np.ndindex(3, 3, 3)]
	for point in points:
		count = sum((np.array(n, float) @ (point + shift - extent) < np.array(d, float)).all() for n, d in cells.blocks for shift in shifts)
		assert count == 1
	assert polytope.voronoi(box, 1, periodic=True, seed=1).volumes[0] == pytest.approx(volume, rel=1e-12)


def testRelaxedCellsAreMoreRegular():
	spread = [np.std(polytope.voronoi(box, 100, relaxed=n, seed=1).volumes) for n in (0, 5)]
	assert spread[1] < 0.5 * spread[0]
	periodic = polytope.voronoi(box, 30, periodic=True, relaxed=5, seed=1)
	assert periodic.volumes.sum() == pytest.approx(volume, rel=1e-12)
	assert (periodic.seeds >= box[0]).all() and (periodic.seeds <= box[1]).all()


def testOwnSeedsOnALattice():
	seeds = [(x + 0.5, y + 0.5, z + 0.5) for x in range(3) for y in range(3) for z in range(3)]
	cells = polytope.voronoi(((0, 0, 0), (3, 3, 3)), seeds=seeds)
	assert cells.volumes == pytest.approx(1, rel=1e-12) and all(len(normals) == 6 for normals, _ in cells.blocks)
	inAPlane = polytope.voronoi(((0, 0, 0), (3, 3, 1)), seeds=[(x + 0.5, y + 0.5, 0.5) for x in range(3) for y in range(3)])
	assert inAPlane.volumes == pytest.approx(1, rel=1e-12)


def testSeedDecides():
	one, same, other = (polytope.voronoi(box, 10, seed=seed) for seed in (1, 1, 2))
	assert one.blocks == same.blocks != other.blocks


def testBodiesTouchWithoutOverlap():
	O.materials.append(RockJointMat(density=2600))
	bodies = [polytope.fromHalfSpaces(*block) for block in polytope.voronoi(box, 12, seed=1).blocks]
	deepest = max(polytope.contact(a, b).depth for k, a in enumerate(bodies) for b in bodies[:k])
	assert deepest < 1e-12
	assert math.isfinite(deepest) and isinstance(bodies[0].state.pos, Vector3) and isinstance(bodies[0].state.ori, Quaternion)


@pytest.mark.parametrize(
	'arguments, name',
	[
		((((0, 0, 0), (1, 0, 1)), 5), 'region'),
		((((0, 0, 0), (1, math.inf, 1)), 5), 'region'),
		(('box', 5), 'region'),
		((([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)], [1, 1, 1, 1]), 5), 'region'),
		((box, 0), 'cells'),
		((box, 2.5), 'cells'),
		((box,), 'cells'),
		((box, 5, 'yes'), 'periodic'),
		((([(1, 1, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)], [1, 0, 0, 0]), 5, True), 'periodic'),
		((box, 5, False, -1), 'relaxed'),
		((box, None, False, 0, [(9, 9, 9)]), 'seeds'),
		((box, None, False, 0, [(1, 1.5, 0), (1, 1.5, 0)]), 'seeds'),
		((box, None, False, 0, [(1, 1.5)]), 'seeds'),
	],
)
def testRefusals(arguments, name):
	with pytest.raises(ValueError, match=f'^{name}: '):
		polytope.voronoi(*arguments)
