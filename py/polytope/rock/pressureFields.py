# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressures that are linear in pieces, of water tables and along joints, as the engine PolytopeWater has them."""

from typing import NamedTuple

import numpy as np
from scipy.spatial import Delaunay, QhullError

__all__ = ['Piece', 'alongALine', 'belowALevel', 'belowASection', 'belowASurface', 'sectionOf']

thin = 1e-9
"""Distance as a part of the points' extent: points that are less apart are in one place, or in one vertical plane, to the rounding of
points that were computed."""


class Piece(NamedTuple):
	"""Pressure value + gradient·(x − point) where side·(x − point) ≤ offset for all sides."""

	point: np.ndarray
	value: float
	gradient: np.ndarray
	sides: list
	"""(unit normal, offset) each, three at most."""


def belowALevel(level, up, weight):
	""":param weight: of the water in a unit of volume [N/m³]"""
	return [Piece(level * up, 0.0, -weight * up, [])]


def sectionOf(points, up):
	"""(points in their order, direction, positions along it) of points in one vertical plane; None of others."""
	plan = points - np.outer(points @ up, up)
	_, extents, directions = np.linalg.svd(plan - plan.mean(axis=0))
	if extents[1] > thin * extents[0]:
		return None
	along = plan @ directions[0]
	order = np.argsort(along)
	return points[order], directions[0], along[order]


def belowASection(points, direction, along, up, weight):
	"""Straight between the points, level beyond the first and the last one, the same across the vertical plane in which they are."""
	slopes = np.diff(points @ up) / _steps(along, 'level', 'of two points at one place seen from above, leave out one')
	gradients = [weight * (slope * direction - up) for slope in (0.0, *slopes, 0.0)]
	return _strips(points, np.zeros(len(points)), direction, along, gradients)


def alongALine(points, values):
	"""Linear between the points along the direction from the first to the last one, constant beyond these and across."""
	direction = points[-1] - points[0]
	length = np.linalg.norm(direction)
	if not length > 0:
		raise ValueError('pressures: the first and the last point are the same; give both ends of the joint')
	direction = direction / length
	along = points @ direction
	slopes = np.diff(values) / _steps(along, 'pressures', 'give the points in the order in which they are along the joint')
	return _strips(points, values, direction, along, [slope * direction for slope in (0.0, *slopes, 0.0)])


def _steps(along, name, remedy):
	steps = np.diff(along)
	if not (steps > thin * np.ptp(along)).all():
		raise ValueError(f'{name}: points must be one after the other along their line; {remedy}')
	return steps


def _strips(points, values, direction, along, gradients):
	"""Pieces of pressure before the first point, between each two, and behind the last one."""
	pieces = [Piece(points[0], values[0], gradients[0], [(direction, 0.0)])]
	for k, step in enumerate(np.diff(along)):
		pieces.append(Piece(points[k], values[k], gradients[k + 1], [(-direction, 0.0), (direction, step)]))
	return [*pieces, Piece(points[-1], values[-1], gradients[-1], [(-direction, 0.0)])]


def belowASurface(points, up, weight, corners):
	"""Below triangles between the points.

	:param corners: (n, 3) points that must be below or above one of them
	:raises ValueError: naming *level* if they are not
	"""
	axes = np.linalg.svd(up[None])[2][1:]  # two that are horizontal
	plan = points @ axes.T
	try:
		mesh = Delaunay(plan)
	except QhullError as fault:
		raise ValueError(f'level: no triangles can be made between the points seen from above: {str(fault).splitlines()[0]}') from None
	outside = np.flatnonzero(mesh.find_simplex(corners @ axes.T, tol=thin) < 0)
	if len(outside):
		x, y, z = corners[outside[0]]
		raise ValueError(
			f'level: seen from above the points do not reach over the body with a corner at ({x:g}, {y:g}, {z:g}) m; add points farther out'
		)
	return [_triangle(points[corner], plan[corner], axes, up, weight) for corner in mesh.simplices]


def _triangle(points, plan, axes, up, weight):
	heights = points @ up
	slope = np.linalg.solve(plan[1:] - plan[0], heights[1:] - heights[0])
	sides = []
	for k in range(3):
		begin, end, third = plan[k], plan[(k + 1) % 3], plan[(k + 2) % 3]
		normal = np.array([end[1] - begin[1], begin[0] - end[0]]) / np.linalg.norm(end - begin)
		if normal @ (third - begin) > 0:
			normal = -normal
		sides.append((normal @ axes, float(normal @ (begin - plan[0]))))
	return Piece(points[0], 0.0, weight * (slope @ axes - up), sides)
