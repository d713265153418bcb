# SPDX-License-Identifier: GPL-2.0-or-later
"""Half-spaces of bodies and of regions in world axes."""

import numpy as np
from yade import Vector3, _polytope

from ..arguments import numbersOf, vectors
from ..scene.vertices import rotationMatrix, rows

__all__ = ['boxPlanes', 'convexRegion', 'halfSpacesOf', 'planesAboutCentre', 'worldPlanes']


def halfSpacesOf(body, seenFrom):
	"""(unit normals (n, 3), offsets (n,)) of a polytope, wall, facet or box as a body whose middle is at this point meets it."""
	normals, offsets = (np.frombuffer(numbers) for numbers in _polytope.supportPlanes(body, Vector3(*seenFrom)))
	return normals.reshape(-1, 3), offsets


def worldPlanes(body):
	"""(unit normals (n, 3), offsets (n,)) of a polytope's own planes."""
	turn = rotationMatrix(body.state.ori)
	normals = rows(body.shape.normals) @ turn.T
	return normals, np.array(body.shape.offsets, float) + normals @ np.array(body.state.pos, float)


def planesAboutCentre(body):
	"""(unit normals, offsets) of a polytope's planes in world axes, about its centre, in YADE's numbers; of a polygon those of the prism that it
	stands for."""
	shape = body.shape
	normals, offsets = [body.state.ori * normal for normal in shape.normals], list(shape.offsets)
	if shape.dimension == 2:
		normals += [Vector3(0, 0, 1), Vector3(0, 0, -1)]
		offsets += [shape.thickness / 2] * 2
	return normals, offsets


def boxPlanes(lower, upper):
	"""(normals, offsets) of an axis-parallel box."""
	return np.vstack([np.eye(3), -np.eye(3)]), np.concatenate([upper, -np.array(lower)])


def convexRegion(normals, offsets):
	"""(unit normals, offsets, its polyhedron as _polytope.polyhedron has it) of the half-spaces that bound a region; normals of any length.

	:raises TypeError, ValueError: naming *region*: they bound no convex body
	"""
	normals, offsets = np.array(normals, float), np.array(offsets, float)
	made = _polytope.polyhedron(vectors(normals, 'region', 3), numbersOf(offsets.tolist(), 'region'))
	lengths = np.linalg.norm(normals, axis=1)
	return normals / lengths[:, None], offsets / lengths, made
