# SPDX-License-Identifier: GPL-2.0-or-later
"""One joint: a plane, a disc or a convex polygon. Coordinates: x east, y north, z up."""

import dataclasses
import math

import numpy as np
from yade import _polytope

from ..arguments import numbersOf, point, vectors
from ..precision import isNumber
from .faces import areaVector

__all__ = ['Cut', 'Joint', 'areasOf', 'asArguments', 'checkedAngles', 'finite', 'positive', 'upwardNormal']

oneRounding = 1e-12
"""[rad]: a dip this much above π/2 is vertical."""
planar = 1e-3
"""Tolerance on a polygon's corners, as a part of its extent: how far they may be from their mean plane. Files have three digits or more."""
convex = 1e-3
"""Tolerance on a polygon's corners, as a part of its extent: how far a corner may lie inside the hull of the others, for the same reason."""
outside = 1.001
"""Radius of the disc that stands for a polygon, over that of the circle about its corners: its edges bound it."""


@dataclasses.dataclass(frozen=True)
class Joint:
	"""One joint (discontinuity) at a given place: a plane through a point, or a disc about it. *Joint.polygon* makes one of corners.

	:param float dip: angle below the horizontal [rad], 0…π/2
	:param float dipDirection: azimuth of the line of dip, clockwise from north (y) as seen from above [rad]
	:param centre: of the disc, or a point of the plane [m]; of a segment in a section of rock in the plane two components will do
	:param float radius: of the disc [m]; None: it runs through the whole rock mass
	:param set: a number or a name of one's own, such as that of a set in a file: jointedRock tells joints of one list apart by it
	:raises ValueError: naming the argument
	"""

	dip: float
	dipDirection: float
	centre: tuple
	radius: float = None
	set: int = 0
	corners: tuple = None
	"""(n, 3) corners of a polygon [m], as *Joint.polygon* sets them; None: a disc or a plane."""

	def __post_init__(self):
		checkedAngles(self.dip, self.dipDirection)
		object.__setattr__(self, 'centre', point(self.centre, 'centre'))
		if self.radius is not None:
			positive(self.radius, 'radius', 'or None for a joint through the whole rock')

	@classmethod
	def polygon(cls, corners, set=0):
		"""A convex polygon.

		:param corners: (n, 3) corners in order [m], n ≥ 3, in one plane to a thousandth of their extent: the mean plane is taken
		:param set: a number or a name of one's own
		:raises ValueError: naming *corners*: fewer than three, not in one plane, no area, not convex
		"""
		points = np.array(_polytopeRows(corners), float)
		if len(points) < 3:
			raise ValueError(f'corners: must be three or more, got {len(points)}')
		middle = points.mean(axis=0)
		away = points - middle
		extent = float(np.linalg.norm(away, axis=1).max())
		area = areaVector(away)
		size = float(np.linalg.norm(area))
		if not size > planar**2 * extent**2:
			raise ValueError('corners: the polygon has no area; give corners in order round it')
		normal = area / size
		heights = away @ normal
		if np.abs(heights).max() > planar * extent:
			raise ValueError(
				f'corners: must lie in one plane, they miss it by {np.abs(heights).max():.3g} m; divide the polygon into triangles'
			)
		flat = away - np.outer(heights, normal)
		edges = np.roll(flat, -1, axis=0) - flat
		lengths = np.linalg.norm(edges, axis=1)
		sides = np.cross(normal, edges[lengths > 0]) / lengths[lengths > 0, None]
		inside = np.einsum('ekx,ex->ek', flat[None] - flat[lengths > 0][:, None], sides)
		if inside.min() < -convex * extent:
			raise ValueError('corners: the polygon is not convex; divide it into convex ones, which cover the joint together')
		dip, direction = anglesOf(normal)
		return cls(dip, direction, tuple(middle), None, set, tuple(map(tuple, (middle + flat).tolist())))

	@property
	def normal(self):
		"""Unit normal, upward."""
		return upwardNormal(self.dip, self.dipDirection)

	@property
	def cut(self):
		"""The joint as jointedRock cuts by it."""
		centre = inSpace(self.centre, 'centre')
		if self.corners is None:
			return Cut(self.normal, centre, self.radius or 0.0)
		corners = np.array(self.corners)
		edges = np.roll(corners, -1, axis=0) - corners
		edges = edges[np.linalg.norm(edges, axis=1) > 0]
		starts = corners[np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1) > 0]
		turn = np.sign(np.cross(corners - centre, np.roll(corners, -1, axis=0) - centre).sum(axis=0) @ self.normal)
		outward = np.cross(edges, turn * self.normal)
		outward /= np.linalg.norm(outward, axis=1)[:, None]
		reach = outside * float(np.linalg.norm(corners - centre, axis=1).max())
		return Cut(self.normal, centre, reach, np.column_stack([outward, np.einsum('ij,ij->i', outward, starts)]))


@dataclasses.dataclass
class Cut:
	"""A joint as it cuts, in any coordinates (jointedRock's about the region's centre, where numbers are small): a plane, or a disc (radius
	above 0), less what lies beyond its edges."""

	normal: np.ndarray
	centre: np.ndarray
	radius: float = 0.0
	edges: np.ndarray = dataclasses.field(default_factory=lambda: np.empty((0, 4)))
	"""Rows a·x ≤ d of half-spaces that bound it."""
	persistence: float = 1.0
	entry: int = 0
	"""The set or joint that it belongs to, among the joints that the script gave."""

	@property
	def offset(self):
		return float(self.normal @ self.centre)

	def moved(self, by):
		"""The joint moved by a vector."""
		edges = self.edges.copy()
		edges[:, 3] += edges[:, :3] @ by
		return dataclasses.replace(self, centre=self.centre + by, edges=edges)


def asArguments(cuts):
	"""Joints as _polytope takes them."""
	normals = np.array([cut.normal for cut in cuts]).reshape(-1, 3)
	centres = np.array([cut.centre for cut in cuts]).reshape(-1, 3)
	edges = np.concatenate([np.empty((0, 4)), *(cut.edges for cut in cuts)])
	return (
		(vectors(normals, 'joints', 3), numbersOf(np.einsum('ij,ij->i', normals, centres), 'joints')),
		vectors(centres, 'joints', 3),
		numbersOf([cut.radius for cut in cuts], 'joints'),
		(vectors(edges[:, :3], 'joints', 3), numbersOf(edges[:, 3], 'joints')),
		numbersOf([len(cut.edges) for cut in cuts], 'joints'),
		numbersOf([cut.persistence for cut in cuts], 'joints'),
	)


def areasOf(cuts, regions):
	"""Area [m²] of each joint inside regions that _polytope takes."""
	return np.frombuffer(_polytope.jointAreas(regions, asArguments(cuts))).copy()


def upwardNormal(dip, dipDirection):
	horizontal = math.sin(dip)
	return np.array([horizontal * math.sin(dipDirection), horizontal * math.cos(dipDirection), math.cos(dip)])


def anglesOf(normal):
	"""(dip, dip direction) [rad] of a plane."""
	x, y, z = normal if normal[2] >= 0 else -np.asarray(normal)
	return math.atan2(math.hypot(x, y), z), math.atan2(x, y) % (2 * math.pi)


def inSpace(place, name):
	"""Refuses a point of two components."""
	if len(place) != 3:
		raise ValueError(f'{name}: must be three numbers for rock in space, got {place}; two are those of rock in the plane')
	return np.array(place)


def checkedAngles(dip, dipDirection):
	if not finite(dip) or not 0 <= dip <= math.pi / 2 + oneRounding:
		raise ValueError(f'dip: must be from 0 to π/2 (radians), got {dip!r}')
	if not finite(dipDirection) or abs(dipDirection) > 2 * math.pi:
		raise ValueError(f'dipDirection: must be an azimuth in radians, within ±2π, got {dipDirection!r}')


def positive(value, name, otherwise):
	if not finite(value) or not value > 0:
		raise ValueError(f'{name}: must be positive and finite [m], {otherwise}, got {value!r}')


def finite(value):
	return isNumber(value) and not isinstance(value, bool) and math.isfinite(value)


def _polytopeRows(corners):
	try:
		points = [tuple(float(x) for x in row) for row in corners]
	except (TypeError, ValueError):
		raise ValueError('corners: must be a sequence of points') from None
	if any(len(point) != 3 or not all(map(math.isfinite, point)) for point in points):
		raise ValueError('corners: every one must be three finite numbers [m]')
	return points
