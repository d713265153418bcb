# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions that are not convex: what a mesh encloses, rock with openings; their parts fill them once."""

from math import cos, pi, radians, sin

import numpy as np
import pytest
import trimesh
from yade import polytope
from yade.polytope import JointSet

box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]


def volumesOf(region):
	return polytope.jointedRock(*region, [polytope.Joint(0, 0, (0, 0, 1e3))]).volumes


def found(region, points):
	return sum((points @ np.array(n).T < d).all(axis=1).astype(int) for n, d in zip(*region, strict=True))


def ofMesh(mesh, path, **named):
	mesh.export(path)
	return polytope.meshRegion(path, **named)


def extruded(outline, height):
	"""A closed mesh over a polygon, star-shaped about its first corner."""
	n = len(outline)
	points = [(x, y, z) for z in (0, height) for x, y in outline]
	faces = [(0, k + 1, k) for k in range(1, n - 1)] + [(n, n + k, n + k + 1) for k in range(1, n - 1)]
	for k in range(n):
		m = (k + 1) % n
		faces += [(k, m, n + m), (k, n + m, n + k)]
	return trimesh.Trimesh(points, faces, process=False)


corner = [(2, 2), (0, 2), (0, 0), (5, 0), (5, 2)]
ell = [(2, 2), (2, 6), (0, 6), (0, 0), (5, 0), (5, 2)]


@pytest.mark.parametrize('turn', [0, 0.4])
@pytest.mark.parametrize('place', [(0, 0, 0), (3e4, -2e4, 500)])
def testAnEllOfAMesh(tmp_path, turn, place):
	mesh = extruded(ell, 3)
	mesh.apply_transform(trimesh.transformations.rotation_matrix(turn, (1, 2, 3)))
	mesh.apply_translation(place)
	region = ofMesh(mesh, tmp_path / 'ell.obj', scale=1)
	assert volumesOf(region).sum() == pytest.approx(3 * (5 * 2 + 2 * 4), rel=1e-6)
	assert len(region[0]) < 20
	rock = polytope.jointedRock(*region, [JointSet(radians(40), 1, spacing=1), JointSet(radians(80), 3, p32=0.5, radius=2)])
	assert rock.volumes.sum() == pytest.approx(54, rel=1e-6)


def testASphereIsNotDividedAndAShellIsHollow(tmp_path):
	outer, inner = trimesh.creation.icosphere(1, radius=2), trimesh.creation.icosphere(0, radius=1)
	assert volumesOf(ofMesh(outer, tmp_path / 'ball.off')).sum() == pytest.approx(outer.volume, rel=1e-9)
	inner.invert()
	shell = trimesh.util.concatenate([outer, inner])
	region = ofMesh(shell, tmp_path / 'shell.off')
	assert volumesOf(region).sum() == pytest.approx(outer.volume + inner.volume, rel=1e-6) and inner.volume < 0
	points = np.random.default_rng(1).uniform(-2, 2, (500, 3))
	distance = np.linalg.norm(points, axis=1)
	assert (found(region, points[distance < 0.7]) == 0).all() and (found(region, points[(distance > 1.01) & (distance < 1.7)]) == 1).all()


def testOpenAndEmptyMeshesAreRefused(tmp_path):
	mesh = extruded(ell, 3)
	mesh.update_faces(np.arange(len(mesh.faces)) > 3)
	with pytest.raises(ValueError, match='^path: .*is not closed'):
		ofMesh(mesh, tmp_path / 'open.obj')
	with pytest.raises(FileNotFoundError):
		polytope.meshRegion(tmp_path / 'none.stl')
	with pytest.raises(ValueError, match='^scale:'):
		ofMesh(extruded(ell, 3), tmp_path / 'ell.obj', scale=-1)


def testATunnelAndAPit():
	"""A tunnel of 16 sides through a box, and a pit from above that reaches out of it; both meet nothing else."""
	radius, sides = 3.0, 16
	around = [2 * pi * k / sides for k in range(sides)]
	tunnel = ([(cos(a), 0, sin(a)) for a in around] + [(0, 1, 0), (0, -1, 0)], [radius] * sides + [30, 30])
	pit = ([(1, 0, 1), (-1, 0, 1), (0, 1, 1), (0, -1, 1), (0, 0, 1), (0, 0, -1)], None)
	pit = ([(1, 0, -1), (-1, 0, -1), (0, 1, -1), (0, -1, -1), (0, 0, 1), (0, 0, -1)], [-6, -6, -6, -6, 20, -7])
	half = [20, 20, 20, 20, 10, 10]
	region = polytope.regionWithout(box, half, [tunnel, pit])
	section = sides * radius**2 * np.tan(pi / sides)
	depth, bottom = 3.0, 2 * (7 - 6)
	opened = depth / 3 * (bottom**2 + bottom * (bottom + 2 * depth) + (bottom + 2 * depth) ** 2)
	assert volumesOf(region).sum() == pytest.approx(40 * 40 * 20 - section * 40 - opened, rel=1e-12)
	points = np.random.default_rng(2).uniform(-1, 1, (3000, 3)) * (20, 20, 10)
	out = [(points @ np.array(n).T < d).all(axis=1) for n, d in (tunnel, pit)]
	assert (found(region, points) == ~(out[0] | out[1])).all()
	rock = polytope.jointedRock(*region, [JointSet(radians(30), 1, spacing=5), JointSet(radians(80), 2, spacing=6)])
	assert rock.volumes.sum() == pytest.approx(volumesOf(region).sum(), rel=1e-12)


def testWrongOpeningsAreRefused():
	with pytest.raises(ValueError, match='^openings: must be a list'):
		polytope.regionWithout(box, [1] * 6, [(box[:4], [1] * 4)])
	with pytest.raises(ValueError, match='^openings: must be a list'):
		polytope.regionWithout(box, [1] * 6, [3])
	with pytest.raises(ValueError, match='^openings: nothing is left'):
		polytope.regionWithout(box, [1] * 6, [(box, [2] * 6)])


def sidesOf(dimension):
	return [*np.eye(dimension), *-np.eye(dimension)]


def level(dimension, height, **size):
	"""A horizontal joint."""
	return polytope.Joint(0, radians(90), (0, 0, height)[-dimension:], **size)


@pytest.mark.parametrize('dimension', [2, 3])
def testSeamsOfARegionAreNoJoints(dimension):
	"""Blocks that meet where no joint runs are one body, also where joints that end in the rock cut blocks wholly."""
	sides, across = sidesOf(dimension), [5] * (dimension - 1)  # two boxes that share x = 0
	boxes = [sides, sides], [[10, *across, 0, *across], [0, *across, 10, *across]]
	tunnel = [2] * dimension if dimension == 2 else [2, 20, 2]
	hollow = polytope.regionWithout(sides, [10] * 2 * dimension, [(sides, tunnel * 2)])
	for region, height, bodies, blocks in ((boxes, 4, 2, 4), (hollow, 9, 2, None)):
		whole = [polytope.jointedRock(*region, [level(dimension, height)], incomplete=way) for way in ('clump', 'cut')]
		assert len(whole[0].bodies) == len(whole[1].bodies) == bodies
		volumes = [sorted(rock.volumes[body].sum() for body in rock.bodies) for rock in whole]
		assert volumes[0] == pytest.approx(volumes[1], rel=1e-12)
		assert blocks is None or len(whole[1].blocks) == blocks
		assert sorted(block for body in whole[1].bodies for block in body) == list(range(len(whole[1].blocks)))
	ending = level(dimension, 4, radius=3)  # reaches into both boxes, and ends inside them
	assert [len(polytope.jointedRock(*boxes, [ending], incomplete=way).bodies) for way in ('clump', 'cut')] == [1, 2]
	steep = polytope.Joint(radians(90), radians(90), (0,) * dimension)  # along the seam
	assert [len(polytope.jointedRock(*boxes, [steep, level(dimension, 4)], incomplete=way).bodies) for way in ('clump', 'cut')] == [4, 4]
	beside = polytope.Joint(
		0, radians(90), (5, 0, 4) if dimension == 3 else (5, 4), radius=3
	)  # in one box alone, as the other below is whole
	cut = polytope.jointedRock(*boxes, [beside], incomplete='cut')
	assert len(cut.blocks) == 3 and len(cut.bodies) == 1
