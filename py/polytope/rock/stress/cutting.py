# SPDX-License-Identifier: GPL-2.0-or-later
"""What a region takes of blocks, and what it leaves of them (`polytope.excavate`)."""

import copy
import dataclasses

import numpy as np
from yade import Body, O, Vector3, _polytope

from ...arguments import numbersOf, rows, vectors
from ...bodies.halfSpaces import planesAboutCentre
from ...bodies.pieces import pieceOf
from ...bodies.polytopes import areFlat
from ...precision import real
from ...scene.movers import partsOf
from ...scene.vertices import worldVertices
from ..joint import Cut, asArguments
from ..jointedRegion import areSeveral
from ..jointedRock import mostBlocks, smallestBridge

__all__ = ['ExcavatedRegion', 'Part', 'restsOf', 'together']

thinnest = 0.01
"""Least inscribed radius of what is cut off or left, over that of the block: such slivers bear no load and shorten the time step. More than
a joint's closure, by which blocks that were cut along the region reach over its faces (*inSitu*)."""
level = 1e-9
"""Sine of the angle up to which a plane is that of polygons."""
touching = 1e-6
"""Distance up to which two parts of a clump touch, over the smaller part's inscribed radius."""


@dataclasses.dataclass
class Part:
	"""A convex part of what is left of a body."""

	of: int
	"""Id of the body."""
	body: Body
	"""The part as a body, which is not in the scene yet."""
	planes: np.ndarray
	"""For each of its planes which of the former body's it lies on; −1: a cut."""


class ExcavatedRegion:
	"""Convex parts, each {x : normals[i]·x ≤ offsets[i] for all i}, which may be without bounds and overlap.

	:raises ValueError: naming *normals* or *offsets*
	"""

	def __init__(self, normals, offsets):
		if normals is None or offsets is None:
			raise ValueError('offsets: a region has normals and offsets')
		several = areSeveral(normals)
		if several and (np.ndim(offsets[0]) == 0 or len(normals) != len(offsets)):
			raise ValueError(f'offsets: must be a sequence for each of the {len(normals)} parts of the region')
		self.parts = [_planes(*part) for part in (zip(normals, offsets, strict=True) if several else [(normals, offsets)])]

	def at(self, body):
		"""What of it is where the body is: of polygons its section with their plane."""
		if body.shape.dimension == 3:
			return self
		section, z = copy.copy(self), float(body.state.pos[2])
		section.parts = list(filter(None, (_section(normals, limits, z) for normals, limits in self.parts)))
		return section

	def holds(self, point):
		return any((normals @ point <= limits).all() for normals, limits in self.parts)

	def holdsAll(self, points, margin):
		return any((points @ normals.T <= limits + margin).all() for normals, limits in self.parts)

	def isBeside(self, points, margin):
		"""Whether it reaches none of what these corners span by more than the margin."""
		return all((points @ normals.T >= limits - margin).all(axis=0).any() for normals, limits in self.parts)

	def faces(self, centre):
		"""The faces of its parts as joints that cut, about this point."""
		for normals, limits in self.parts:
			planes = np.column_stack([normals, limits - normals @ centre])
			for k, plane in enumerate(planes):
				yield Cut(plane[:3], plane[3] * plane[:3], edges=np.delete(planes, k, axis=0))


def _isInPlane():
	"""Whether all bodies are polygons."""
	return all(getattr(body.shape, 'dimension', 2) == 2 for body in O.bodies if body is not None)


def _planes(normals, offsets):
	if areFlat(normals) and _isInPlane():
		normals = [(*normal, 0) for normal in rows(normals, 'normals', 2)]
	planes, limits = np.array(rows(normals, 'normals', 3), float), np.array(numbersOf(offsets, 'offsets'), float)
	if len(planes) != len(limits) or not len(planes):
		raise ValueError(f'offsets: must be one for each of the {len(planes)} normals, got {len(limits)}')
	if not (np.isfinite(planes).all() and np.isfinite(limits).all() and planes.any(axis=1).all()):
		raise ValueError('normals: normals and offsets must be finite, and no normal zero')
	lengths = np.linalg.norm(planes, axis=1)
	return planes / lengths[:, None], limits / lengths


def _section(normals, limits, z):
	"""The polygon in which a plane of this z cuts a part; None: they do not meet."""
	limits, lengths = limits - z * normals[:, 2], np.linalg.norm(normals[:, :2], axis=1)
	across = lengths > level
	if (limits[~across] < 0).any():
		return None
	return np.column_stack([normals[across, :2], np.zeros(across.sum())]) / lengths[across, None], limits[across] / lengths[across]


def restsOf(k, region):
	"""What is left of a body or clump of polytopes outside of the region: a list of bodies, each a list of *Part*; empty: nothing; None:
	all, untouched."""
	bodies = [O.bodies[part] for part in partsOf(k)]
	if all(_isBeside(body, region) for body in bodies):
		return None
	found = [_partsOf(body, region) for body in bodies]
	if all(inside == 0 for _, inside in found):
		return None
	return together([group for groups, _ in found for group in groups])


def _leastOf(body):
	return thinnest * float(body.shape.inscribedRadius)


def _isBeside(body, region):
	return region.at(body).isBeside(worldVertices(body), 2 * _leastOf(body))


def _partsOf(body, region):
	"""(groups of parts outside, number of cells inside) of a convex body."""
	if _isBeside(body, region):
		return [[Part(body.id, *pieceOf(body, []))]], 0
	region, least = region.at(body), _leastOf(body)
	if region.holdsAll(worldVertices(body), 2 * least):
		return [], 1
	centre = np.array(body.state.pos, float)
	groups, inside = {}, 0
	for cell, number in _cells(body, list(region.faces(centre)), least):
		normals, offsets, labels, middle = cell
		if region.holds(centre + middle):
			inside += 1
		else:
			cuts = [
				(Vector3(*map(real, normal)), real(offset))
				for normal, offset, label in zip(normals, offsets, labels, strict=True)
				if label >= 0
			]
			groups.setdefault(number, []).append(Part(body.id, *pieceOf(body, cuts)))
	return list(groups.values()), inside


def _cells(body, faces, least):
	"""Into which faces cut a convex body: ((normals, offsets, labels, a point inside), number of the body that it is a part of). About the
	body's centre."""
	normals, offsets = planesAboutCentre(body)
	own = vectors(normals, 'normals', 3), numbersOf(offsets, 'offsets')
	made = _polytope.jointedBlocks([own], asArguments(faces), real(least), real(smallestBridge), mostBlocks, 0)
	planes, labels = np.frombuffer(made['planes']).reshape(-1, 4), np.frombuffer(made['labels'], np.int32)
	ends = np.cumsum(np.frombuffer(made['counts'], np.int32))
	for begin, end, number in zip([0, *ends[:-1]], ends, np.frombuffer(made['bodies'], np.int32).tolist(), strict=True):
		rows_ = planes[begin:end]
		solid = _polytope.polyhedron(vectors(rows_[:, :3], 'normals', 3), numbersOf(rows_[:, 3], 'offsets'))
		yield (rows_[:, :3], rows_[:, 3], labels[begin:end], np.array(solid['centroid'], float)), number


def together(groups):
	"""Groups of *Part* of one clump that touch are one body: a list of bodies, each a list of them."""
	bodies = []
	for group in groups:
		beside = [other for other in bodies if any(_touch(one.body, part.body) for one in other for part in group)]
		bodies = [other for other in bodies if other not in beside] + [[part for other in [*beside, group] for part in other]]
	return bodies


def _touch(one, other):
	if (one.state.pos - other.state.pos).norm() > one.shape.circumscribedRadius + other.shape.circumscribedRadius:
		return False
	apart = touching * float(min(one.shape.inscribedRadius, other.shape.inscribedRadius))
	return float(_polytope.contact(one, other).infeasibility) < apart
