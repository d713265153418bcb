# SPDX-License-Identifier: GPL-2.0-or-later
"""Prisms and frustums, and containers and ground made of fixed pieces: plates round a box, a tube, terrain.

Pieces share faces exactly, to rounding; bodies slide over the joints between flush fixed pieces as over one face (docs/surfaces.md).
"""

import math
import numbers
import os

import numpy as np
from yade import Quaternion, Vector3, _polytope

from ..arguments import number, rotation, rows, vector, vectors
from .meshes.digits import warnOfRounding
from .meshes.files import readMesh
from .polytopes import builder, cuboid, defaultCornerFraction, fromVertices, ofOneColour, refuseInside

__all__ = ['frustum', 'plates', 'prism', 'terrain', 'tube']

thicknessFraction = 0.1
"""Default thickness of plates over the least extent of what they enclose, and of terrain over its horizontal extent."""
sides = ('-x', '+x', '-y', '+y', '-z', '+z')
flat = 1e-9
"""Of a mesh's triangle, its horizontal area over the square of its longest edge, below which it is vertical and is left out."""


@builder
def prism(points2d, height, **body):
	"""Straight prism over a convex polygon in the xy plane, from z = 0 to *height*. For 2-D take *polygon*.

	:param points2d: (n, 2) corners [m], in any order
	:param float height: [m]
	:raises ValueError: naming *points2d* (also where a corner lies inside the others: the outline is not convex) or *height*
	"""
	height, outline = _positive(height, 'height'), rows(points2d, 'points2d', 2)
	corners = [(x, y, z) for x, y in outline for z in (0, height)]
	try:
		made = fromVertices(corners, **body)
	except ValueError as error:
		raise ValueError(str(error).replace('points', 'points2d', 1) if str(error).startswith('points') else str(error)) from None
	if len(made.shape.offsets) < len(outline) + 2:
		refuseInside(_polytope.ofPoints(vectors(corners, 'points2d', 3), 3, 0, 1, None, defaultCornerFraction), outline, made.shape)
	return made


@builder
def frustum(faces, bottom, top, height, **body):
	"""Frustum of a regular pyramid (or, with *top* 0, the pyramid) along z, its base in the plane z = 0; equal radii make a regular prism.

	:param int faces: number of its sides, at least 3
	:param float bottom: circumradius of the base [m]
	:param float top: circumradius of the other end [m], at least 0
	:param float height: [m]
	:raises ValueError: naming the argument
	"""
	if isinstance(faces, bool) or not isinstance(faces, numbers.Integral) or faces < 3:
		raise ValueError(f'faces: must be a whole number, at least 3, got {faces!r}')
	bottom, height, top = _positive(bottom, 'bottom'), _positive(height, 'height'), number(top, 'top')
	if not 0 <= top < math.inf:
		raise ValueError(f'top: must be at least 0 and finite, got {top!r}')
	corners = [(math.cos(2 * math.pi * k / faces), math.sin(2 * math.pi * k / faces)) for k in range(faces)]
	ends = [(bottom, 0), (top, height)] if top > 0 else [(bottom, 0)]
	points = [(radius * x, radius * y, z) for radius, z in ends for x, y in corners] + ([] if top > 0 else [(0, 0, height)])
	return fromVertices(points, **body)


@builder(lacks=('center', 'orientation'))
def plates(lower, upper, thickness=None, without=(), **body):
	"""Six plates round a box, as fixed bodies; those of opposite sides are equal, and none overlaps another one.

	:param lower, upper: opposite corners of the box inside [m]
	:param float thickness: [m]; default a tenth of the least extent
	:param without: sides to leave out, of '-x', '+x', '-y', '+y', '-z', '+z'
	:returns: list of bodies in the order of the sides, fixed unless *fixed* is False
	:raises ValueError: naming the argument
	"""
	low, high = _box(lower, upper)
	left = (without,) if isinstance(without, str) else tuple(without)
	if not set(left) <= set(sides):
		raise ValueError(f'without: must be of {", ".join(sides)}, got {without!r}')
	thick = thicknessFraction * float((high - low).min()) if thickness is None else _positive(thickness, 'thickness')
	made, pieces = [], ofOneColour({'fixed': True, **body})
	for k, side in enumerate(sides):
		axis, upward = divmod(k, 2)
		bottom, top = low.copy(), high.copy()
		bottom[:axis] -= thick  # those of later axes reach over those of earlier ones
		top[:axis] += thick
		bottom[axis], top[axis] = (high[axis], high[axis] + thick) if upward else (low[axis] - thick, low[axis])
		if side not in left:
			made.append(cuboid(tuple((bottom + top) / 2), tuple((top - bottom) / 2), **pieces))
	return made


@builder
def tube(radius, height, number=24, thickness=None, center=(0, 0, 0), orientation=Quaternion.Identity, **body):
	"""A hollow cylinder of equal plates (staves) that touch a circle from outside, as fixed bodies. Its axis is z before it is turned.

	:param float radius: of the circle inside [m]
	:param float height: [m]
	:param int number: of plates, at least 3
	:param float thickness: [m]; default a tenth of the radius
	:param Vector3 center: of the tube [m]
	:param Quaternion orientation: turns the tube about its centre
	:returns: list of bodies, fixed unless *fixed* is False
	:raises ValueError: naming the argument
	"""
	radius, height = _positive(radius, 'radius'), _positive(height, 'height')
	if isinstance(number, bool) or not isinstance(number, numbers.Integral) or number < 3:
		raise ValueError(f'number: must be a whole number of plates, at least 3, got {number!r}')
	thick = thicknessFraction * radius if thickness is None else _positive(thickness, 'thickness')
	middle, turn = vector(center, 'center'), rotation(orientation)
	corners = [
		[r / math.cos(math.pi / number) * np.array([math.cos(a), math.sin(a)]) for r in (radius, radius + thick)] for a in _angles(number)
	]
	made, pieces = [], ofOneColour({'fixed': True, **body})
	for k in range(number):
		outline = corners[k] + corners[(k + 1) % number]
		points = [middle + turn * Vector3(x, y, z) for x, y in outline for z in (-height / 2, height / 2)]
		made.append(fromVertices(points, **pieces))
	return made


@builder(lacks=('center', 'orientation'))
def terrain(heights, spacing=None, depth=None, origin=(0, 0), **body):
	"""Ground from a height map or from a mesh file, as fixed triangular prisms from the surface down to one level.

	:param heights: (n, m) heights z [m] at x, y = origin + spacing · (i, j); or the path of a mesh file, of whose triangles the
	    vertical ones are left out (it must not hang over)
	:param float spacing: distance of neighbouring heights [m]; not for a mesh
	:param float depth: of the base below the lowest point [m]; default a tenth of the horizontal extent
	:param origin: x and y of the first height [m]; not for a mesh
	:returns: list of bodies, fixed unless *fixed* is False: two for each cell of the map, or one for each triangle
	:raises ValueError: naming the argument
	"""
	if isinstance(heights, (str, os.PathLike)):
		mesh = readMesh(heights, 'heights')
		points, triangles = mesh.points, mesh.triangles
		edges = np.linalg.norm(points[triangles[:, 0]] - points[triangles[:, 1]], axis=1)
		if len(edges):
			warnOfRounding(heights, 'heights', points, float(np.median(edges)), 'the usual length of an edge')
	else:
		points, triangles = _ofHeights(heights, _positive(spacing, 'spacing'), rows([origin], 'origin', 2)[0])
	extent = float(np.ptp(points[:, :2], axis=0).max())
	base = points[:, 2].min() - (thicknessFraction * extent if depth is None else _positive(depth, 'depth'))
	made, pieces = [], ofOneColour({'fixed': True, **body})
	for corners in points[triangles]:
		edges = corners - np.roll(corners, 1, axis=0)
		area = abs(edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]) / 2
		if area > flat * (edges**2).sum(axis=1).max():
			below = np.column_stack([corners[:, :2], np.full(3, base)])
			made.append(fromVertices(np.vstack([corners, below]).tolist(), **pieces))
	if not made:
		raise ValueError('heights: the mesh has no triangle that is not vertical')
	return made


def _ofHeights(heights, spacing, origin):
	"""Points and triangles of a height map."""
	try:
		values = np.array(heights, float)
	except (TypeError, ValueError):
		values = np.empty(0)
	if values.ndim != 2 or min(values.shape) < 2 or not np.isfinite(values).all():
		raise ValueError('heights: must be rows of finite heights, at least 2 × 2, or the path of a mesh file')
	n, m = values.shape
	x, y = np.meshgrid(float(origin[0]) + spacing * np.arange(n), float(origin[1]) + spacing * np.arange(m), indexing='ij')
	first = (np.arange(n - 1)[:, None] * m + np.arange(m - 1)).ravel()
	triangles = np.concatenate([np.column_stack([first, first + m, first + 1]), np.column_stack([first + m, first + m + 1, first + 1])])
	return np.column_stack([x.ravel(), y.ravel(), values.ravel()]), triangles


def _angles(number):
	return [2 * math.pi * (k - 0.5) / number for k in range(number)]


def _box(lower, upper):
	low, high = np.array([*vector(lower, 'lower')], float), np.array([*vector(upper, 'upper')], float)
	if not (low < high).all():
		raise ValueError(f'upper: must be above lower in all three directions, got lower {lower!r}, upper {upper!r}')
	return low, high


def _positive(value, name):
	length = number(value, name)
	if not 0 < length < math.inf:
		raise ValueError(f'{name}: must be positive and finite, got {value!r}')
	return float(length)
