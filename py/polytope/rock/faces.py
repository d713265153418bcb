# SPDX-License-Identifier: GPL-2.0-or-later
"""Faces of a block: which corners are on a plane, their polygon's area, axes across its normal."""

import numpy as np
from yade import _polytope

from ..arguments import numbersOf, vectors

__all__ = ['areaOfFace', 'areaVector', 'centroidOf', 'frameOf', 'shapeOf', 'triangles']

onPlane = 1e-9
"""Tolerance on the corners of a block's face, as a part of the block's extent: how far from the face's plane they may be computed."""


def shapeOf(normals, offsets):
	"""(corners, centroid, volume) of a block, computed about the first corner of its box, where numbers are small."""
	middle = np.linalg.lstsq(normals, offsets, rcond=None)[0]
	shape = _polytope.polyhedron(vectors(normals, 'normals', 3), numbersOf(offsets - normals @ middle, 'offsets'))
	return np.array(shape['vertices'], float) + middle, np.array(shape['centroid'], float) + middle, float(shape['volume'])


def areaOfFace(corners, normal, offset):
	"""Area of the face that a convex body with these corners (n, 3) has on a plane [m²]; 0 of an edge or a vertex."""
	extent = float(np.ptp(corners, axis=0).max())
	on = corners[np.abs(corners @ normal - offset) < onPlane * extent]
	if len(on) < 3:
		return 0.0
	x, y = ((on - on.mean(axis=0)) @ frameOf(normal)[:, 1:]).T
	return float(np.linalg.norm(areaVector(on[np.argsort(np.arctan2(y, x))])))


def areaVector(corners):
	"""Normal times area [m²] of a polygon of these corners (n, 3), which turn to the left about it."""
	return triangles(corners).sum(axis=0)


def centroidOf(corners):
	"""Centroid [m] of a convex polygon of these corners (n, 3), by the triangles about its first corner."""
	arms = corners[1:] - corners[0]
	return corners[0] + np.average((arms[:-1] + arms[1:]) / 3, axis=0, weights=np.linalg.norm(triangles(corners), axis=1))


def triangles(corners):
	"""Normals times areas [m²] of the triangles about the first corner."""
	arms = corners[1:] - corners[0]
	return np.cross(arms[:-1], arms[1:]) / 2


def frameOf(normal):
	"""(3, 3) columns: the unit normal and two directions across it."""
	across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
	across /= np.linalg.norm(across)
	return np.column_stack([normal, across, np.cross(normal, across)])
