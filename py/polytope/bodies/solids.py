# SPDX-License-Identifier: GPL-2.0-or-later
"""Prisms and frustums, and containers made of fixed pieces: plates round a box, a tube.

Pieces share faces exactly, to rounding; bodies slide over the joints between flush fixed pieces as over one face (docs/surfaces.md).
"""

import math
import numbers

import numpy as np
from yade import Quaternion, Vector3, _polytope

from ..arguments import number, positive, rotation, rows, vector, vectors
from .polytopes import builder, cuboid, defaultCornerFraction, fromVertices, ofOneColour, refuseInside

__all__ = ['frustum', 'plates', 'prism', 'tube']

thicknessFraction = 0.1
"""Default thickness of plates over the least extent of what they enclose."""
sides = ('-x', '+x', '-y', '+y', '-z', '+z')


@builder
def prism(points2d, height, **body):
	"""Straight prism over a convex polygon in the xy plane, from z = 0 to *height*. For 2-D take *polygon*.

	:param points2d: (n, 2) corners [m], in any order
	:param float height: [m]
	:raises ValueError: naming *points2d* (also where a corner lies inside the others: the outline is not convex) or *height*
	"""
	height, outline = positive(height, 'height'), rows(points2d, 'points2d', 2)
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
	bottom, height, top = positive(bottom, 'bottom'), positive(height, 'height'), number(top, 'top')
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
	thick = thicknessFraction * float((high - low).min()) if thickness is None else positive(thickness, 'thickness')
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
	radius, height = positive(radius, 'radius'), positive(height, 'height')
	if isinstance(number, bool) or not isinstance(number, numbers.Integral) or number < 3:
		raise ValueError(f'number: must be a whole number of plates, at least 3, got {number!r}')
	thick = thicknessFraction * radius if thickness is None else positive(thickness, 'thickness')
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


def _angles(number):
	return [2 * math.pi * (k - 0.5) / number for k in range(number)]


def _box(lower, upper):
	low, high = np.array([*vector(lower, 'lower')], float), np.array([*vector(upper, 'upper')], float)
	if not (low < high).all():
		raise ValueError(f'upper: must be above lower in all three directions, got lower {lower!r}, upper {upper!r}')
	return low, high
