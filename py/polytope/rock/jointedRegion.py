# SPDX-License-Identifier: GPL-2.0-or-later
"""The region that joints cut: convex, or convex parts that share faces."""

import dataclasses

import numpy as np
from yade import FrictMat, _polytope

from ..arguments import numbersOf, rows, vectors
from ..bodies.clumps import union
from ..bodies.polytopes import areFlat, fromHalfSpaces
from .inPlane import asPrisms
from .joint import Joint

__all__ = ['Region', 'areSeveral', 'regionOf']

overlapping = 1e-9
"""Volume of overlaps over that of all parts, above which parts are not those of one region: more than rounding."""


@dataclasses.dataclass
class Region:
	parts: list
	"""(normals, offsets) of each, about the centre, as _polytope takes them."""
	centre: np.ndarray
	"""Centroid [m]."""
	radius: float
	"""Radius of the ball about the centre that holds it [m]."""
	inscribedRadius: float
	"""The largest one of its parts [m]."""
	volume: float
	"""[m³]"""
	thickness: float = 0.0
	"""Thickness of the prism that stands for a region in the plane [m]; 0: a region of space."""


def regionOf(normals, offsets):
	"""The region that jointedRock's arguments name.

	:raises ValueError: naming *normals* or *offsets*: what fromHalfSpaces refuses, parts that overlap
	"""
	if normals is None or (isinstance(normals, (list, tuple)) and any(isinstance(one, Joint) for one in normals)):
		raise ValueError(
			'normals: joints cut a region of rock, and none is given; give outward normals and offsets of the half-spaces that bound it, or those of polytope.meshRegion(…)'
		)
	several = areSeveral(normals)
	pairs = list(zip(normals, offsets, strict=False)) if several else [(normals, offsets)]
	if several and not len(normals) == len(offsets) == len(pairs):
		raise ValueError(f'offsets: must be as many sequences as there are parts, {len(normals)}, got {len(offsets)}')
	flat = [areFlat(n) for n, _ in pairs]
	if any(flat) and not all(flat):
		raise ValueError('normals: some parts of the region have normals of two components, and some of three')
	half, pairs = asPrisms([(rows(n, 'normals', 2), numbersOf(d, 'offsets')) for n, d in pairs]) if all(flat) else (0.0, pairs)
	given = [_polytope.polyhedron(vectors(n, 'normals', 3), numbersOf(d, 'offsets')) for n, d in pairs]
	volumes = np.array([float(part['volume']) for part in given])
	centre = np.average([np.array(part['centroid'], float) for part in given], axis=0, weights=volumes)
	if several:
		_refuseOverlaps(pairs, volumes.sum())
	about = []
	for part in given:
		normals = np.array(part['normals'], float)
		about.append((vectors(normals, 'normals', 3), numbersOf(np.array(part['offsets'], float) - normals @ centre, 'offsets')))
	corners = np.concatenate([np.array(part['vertices'], float) for part in given])
	radius = float(np.linalg.norm((corners - centre)[:, : 2 if half else 3], axis=1).max())
	return Region(about, centre, radius, max(float(part['inscribedRadius']) for part in given), float(volumes.sum()), 2 * half)


def areSeveral(normals):
	"""Whether these are lists of normals, one for each part."""
	try:
		return np.ndim(normals[0][0]) > 0
	except (TypeError, IndexError, KeyError):
		return False


def _refuseOverlaps(pairs, volume):
	bodies = [fromHalfSpaces(normals, offsets, material=FrictMat(density=1)) for normals, offsets in pairs]
	fill = union(bodies)[0]
	if volume - fill > overlapping * volume:
		raise ValueError(f'normals: parts of the region overlap, by {volume - fill:.3g} m³ of {volume:.6g}; they may share faces only')
