# SPDX-License-Identifier: GPL-2.0-or-later
"""Level floors made of flush pieces: plates, boxes, facets, bricks, blocks of a jointed rock, polygons.

The top lies at z = 0 (polygons: y = 0), the joints across x at spacing, 2 spacing, … seams × spacing. All pieces are fixed.
"""

import dataclasses
import math

import numpy as np
from scipy.spatial import Delaunay
from yade import utils
from yade.polytope.bodies.polytopes import cuboid, fromHalfSpaces, fromVertices, polygon
from yade.polytope.rock.jointedRock import JointSet, jointedRock

__all__ = ['Floor', 'floorKinds', 'planarFloors']


@dataclasses.dataclass
class Floor:
	"""A floor of *seams* + 1 pieces in a row. `pieces(kind)` makes the bodies.

	Made of facets, mesh, bricks or rock there are joints in other directions, too, about as far apart.
	"""

	seams: int = 3
	spacing: float = 1.0
	"""Spacing of joints along x [m]."""
	before: float = 3.0
	"""Length of the first piece, before x = spacing [m]; `after` is that of the last."""
	after: float = 3.0
	side: tuple = (-2.0, 2.0)
	"""Extent along y [m]."""
	thickness: float = 0.5
	"""[m]; facets have none."""
	gap: float = 0.0
	"""Width of every joint [m]; plates, boxes and polygons only."""
	steps: tuple = ()
	"""Height of each piece's top over z = 0 [m], pieces without one: 0; plates, boxes and polygons only."""

	def pieces(self, kind):
		"""Bodies of a floor, one of *floorKinds*.

		:raises ValueError: naming *kind*
		"""
		if kind not in floorKinds:
			raise ValueError(f'kind: must be one of {", ".join(floorKinds)}, got {kind!r}')
		if (self.gap or self.steps) and kind not in ('plates', 'boxes', 'polygons'):
			raise ValueError(f'kind: gaps and steps can be had of plates, boxes and polygons, not of {kind!r}')
		return floorKinds[kind](self)

	@property
	def joints(self):
		"""x of the joints across x [m]."""
		return self.spacing * np.arange(1, self.seams + 1)

	@property
	def ends(self):
		"""x of the floor's first and last edge [m]."""
		return self.spacing - self.before, self.spacing * max(self.seams, 1) + self.after

	def rows(self):
		"""(x of the left end, x of the right end, height of the top) of each piece."""
		low = np.concatenate([[self.ends[0]], self.joints + self.gap / 2])
		high = np.concatenate([self.joints - self.gap / 2, [self.ends[1]]])
		heights = [*self.steps, *[0.0] * (len(low) - len(self.steps))]
		return list(zip(low, high, heights, strict=True))

	def grid(self):
		"""x and y of lines about *spacing* apart that cover the floor, joints across x among them."""
		x, y = [self.ends[0], *self.joints, self.ends[1]], self.side
		fine = [np.linspace(a, b, max(1, round((b - a) / self.spacing)) + 1)[:-1] for a, b in zip(x, x[1:], strict=False)]
		# no line along the middle, where bodies slide
		return np.array([*np.concatenate(fine), x[-1]]), np.linspace(*y, 2 * max(1, round((y[1] - y[0]) / self.spacing / 2)))


def _slab(floor):
	low, high = floor.ends
	return [_cuboid(low, high, floor)]


def _wall(floor):
	return [utils.wall(0, axis=2, sense=1)]


def _plates(floor):
	return [_cuboid(low, high, floor, top) for low, high, top in floor.rows()]


def _overlapping(floor):
	"""Plates that reach below the next one by half of their length, their tops level: parts of a body cut approximately."""
	return [_cuboid(low, min(high + (high - low) / 2, floor.ends[1]), floor, top) for low, high, top in floor.rows()]


def _boxes(floor):
	return [utils.box(*_middle(low, high, *floor.side, top - floor.thickness, top), fixed=True) for low, high, top in floor.rows()]


def _facets(floor):
	"""Each cell of a grid is two triangles."""
	x, y = floor.grid()
	pieces = []
	for a, b in zip(x, x[1:], strict=False):
		for c, d in zip(y, y[1:], strict=False):
			corners = [(a, c, 0), (b, c, 0), (b, d, 0), (a, d, 0)]
			pieces += [utils.facet([corners[k] for k in triangle], fixed=True) for triangle in ((0, 1, 2), (0, 2, 3))]
	return pieces


def _mesh(floor):
	"""Irregular triangles: the corners of the grid are moved by up to a third of a cell, except on the rim."""
	x, y = floor.grid()
	random = np.random.default_rng(7)
	points = np.array([(a, b) for a in x for b in y])
	inside = np.array([a not in (x[0], x[-1]) and b not in (y[0], y[-1]) for a, b in points])
	points[inside] += random.uniform(-1, 1, (inside.sum(), 2)) / 3 * [floor.spacing, y[1] - y[0]]
	triangles = points[Delaunay(points).simplices]
	return [utils.facet([(*corner, 0) for corner in triangle], fixed=True) for triangle in triangles]


def _bricks(floor):
	"""Rows along x, each half a brick aside of its neighbour: joints end in T's."""
	x, y = floor.grid()
	pieces = []
	for k, (c, d) in enumerate(zip(y, y[1:], strict=False)):
		inner = floor.joints - (floor.spacing / 2 if k % 2 else 0)
		ends = [floor.ends[0], *inner, floor.ends[1]]
		pieces += [_cuboid(a, b, floor, side=(c, d)) for a, b in zip(ends, ends[1:], strict=False)]
	return pieces


def _rock(floor):
	"""Blocks of one jointed rock: a set of joints that dips 60° to x, one that dips 75° nearly across to it."""
	(low, high), side = floor.ends, floor.side
	normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	dips = math.radians(60), math.radians(75)
	sets = [
		JointSet(dips[0], math.radians(90), floor.spacing * math.sin(dips[0]), through=(floor.spacing, 0, 0)),
		JointSet(dips[1], math.radians(20), floor.spacing * math.sin(dips[1]), through=(0, 0.3 * floor.spacing, 0)),
	]
	rock = jointedRock(normals, [high, -low, side[1], -side[0], 0, floor.thickness], sets, smallest=0.02 * floor.spacing)
	return [fromHalfSpaces(*block, fixed=True) for block in rock.blocks]


def _oblique(floor):
	"""Plates whose joints dip 60°: their edges are not right angles."""
	shift = floor.thickness / math.tan(math.radians(60))
	pieces = []
	for low, high, _ in floor.rows():
		ends = [(x + lean, z) for x in (low, high) for lean, z in ((0, 0), (-shift, -floor.thickness))]
		pieces.append(fromVertices([(x, y, z) for x, z in ends for y in floor.side], fixed=True))
	return pieces


def _polygon(floor):
	low, high = floor.ends
	return [polygon([(low, 0), (high, 0), (high, -floor.thickness), (low, -floor.thickness)], fixed=True)]


def _polygons(floor):
	"""Plates in the xy plane."""
	return [
		polygon([(low, top), (high, top), (high, top - floor.thickness), (low, top - floor.thickness)], fixed=True)
		for low, high, top in floor.rows()
	]


def _obliquePolygons(floor):
	shift = floor.thickness / math.tan(math.radians(60))
	return [
		polygon([(low, 0), (high, 0), (high - shift, -floor.thickness), (low - shift, -floor.thickness)], fixed=True)
		for low, high, _ in floor.rows()
	]


def _middle(x1, x2, y1, y2, z1, z2):
	"""(centre, half-lengths) of a cuboid."""
	low, high = np.array([x1, y1, z1]), np.array([x2, y2, z2])
	return tuple((low + high) / 2), tuple((high - low) / 2)


def _cuboid(low, high, floor, top=0.0, side=None):
	return cuboid(*_middle(low, high, *(side or floor.side), top - floor.thickness, top), fixed=True)


floorKinds = {
	'slab': _slab,
	'wall': _wall,
	'plates': _plates,
	'overlapping': _overlapping,
	'oblique': _oblique,
	'boxes': _boxes,
	'facets': _facets,
	'mesh': _mesh,
	'bricks': _bricks,
	'rock': _rock,
	'polygon': _polygon,
	'polygons': _polygons,
	'obliquePolygons': _obliquePolygons,
}
"""Name → function of a Floor. slab and wall are one piece."""

planarFloors = ('polygon', 'polygons', 'obliquePolygons')
"""Floors in the xy plane, for polygons."""
