# SPDX-License-Identifier: GPL-2.0-or-later
"""A convex region cut into Voronoi cells, as half-spaces.

The cell of a seed is what lies nearer to it than to any other: the half-spaces of the bisectors with its neighbours, and of the region.
Neighbours come from Qhull (SciPy), planes are computed here: two neighbours have the same plane with opposite signs, to the last bit:
cells fill the region once and share faces without overlap.
"""

import dataclasses
import itertools
import numbers

import numpy as np
import scipy  # loads its packages at their first use: half a second
from tqdm import tqdm
from yade import _polytope

from ..arguments import flag, namedArguments, randomOf, rows, vectors
from .halfSpaces import boxPlanes, convexRegion

__all__ = ['VoronoiCells', 'voronoi']

helpersReach = 10.0
"""Distance of the points that bound all cells, over the extent of the seeds and of the region."""
filled = 1e-9
"""Relative difference of the cells' volume from the region's above which a neighbour was missed."""
atOnce = 1e-12
"""Distance of two seeds, over the region's size, below which they are one."""
mostTries = 1000
"""Points drawn for each seed before the region counts as empty."""


@dataclasses.dataclass
class VoronoiCells:
	"""What polytope.voronoi() returns."""

	blocks: list
	"""(normals, offsets) of each cell in world coordinates, for polytope.fromHalfSpaces."""
	volumes: np.ndarray
	"""[m³]; in a region that is a box they add up to its volume to rounding, wherever it is."""
	seeds: np.ndarray
	"""(n, 3) points [m], in the order of the blocks."""


@namedArguments
def voronoi(region, cells=None, periodic=False, relaxed=0, seeds=None, seed=None):
	"""Cuts a box or a convex region into Voronoi cells: ``[polytope.fromHalfSpaces(*block) for block in polytope.voronoi(…).blocks]``.

	:param region: (lower, upper), opposite corners of a box [m], or (normals, offsets), half-spaces a·x ≤ d as for fromHalfSpaces
	:param int cells: number of cells, around as many random points
	:param bool periodic: cells go on across the faces of the box, for O.cell of its size; they stick out where a neighbour's image is
	:param int relaxed: how often each seed is moved to its cell's centroid (Lloyd's algorithm): cells become more regular
	:param seeds: (n, 3) points of one's own inside the region [m], in place of *cells*
	:param int seed: of the random numbers
	:returns: VoronoiCells
	:raises ValueError: naming the argument
	"""
	normals, offsets, lower, upper = _region(region)
	if flag(periodic, 'periodic') and len(region[0]) != 3:
		raise ValueError('periodic: needs a box as region, (lower, upper)')
	if isinstance(relaxed, bool) or not isinstance(relaxed, numbers.Integral) or relaxed < 0:
		raise ValueError(f'relaxed: must be a whole number, at least 0, got {relaxed!r}')
	if (cells is None) == (seeds is None):
		raise ValueError('cells: give a number of cells, or seeds, one of them')
	# about the region's middle: Qhull and the cells' volumes lose the digits that coordinates far away take
	middle = (lower + upper) / 2
	offsets, lower, upper = offsets - normals @ middle, lower - middle, upper - middle
	points = _random(cells, normals, offsets, lower, upper, seed) if seeds is None else _own(seeds, middle, normals, offsets, upper - lower)
	box = upper - lower if periodic else None
	for _ in range(relaxed):
		_, _, points = _cells(points, normals, offsets, (lower, upper), box)
		if periodic:
			points = lower + np.mod(points - lower, box)
	blocks, volumes, _ = _cells(points, normals, offsets, (lower, upper), box)
	whole = float(np.prod(box)) if periodic else _volume(normals, offsets)
	if abs(volumes.sum() / whole - 1) > filled:
		raise RuntimeError(f'voronoi: the cells fill {volumes.sum():.9g} of {whole:.9g} m³; move seeds that are nearly at one place')
	blocks = [
		(planes, [offset + float(np.dot(normal, middle)) for normal, offset in zip(planes, ends, strict=True)]) for planes, ends in blocks
	]
	return VoronoiCells(blocks, volumes, points + middle)


def _volume(normals, offsets):
	return float(_polytope.polyhedron(vectors(normals, 'normals', 3), offsets.tolist())['volume'])


def _region(region):
	"""Half-spaces of the region, with unit normals, and its box's corners."""
	try:
		first, second = region
		first, second = np.array(first, float), np.array(second, float)
	except (TypeError, ValueError):
		raise ValueError('region: must be (lower, upper), the corners of a box, or (normals, offsets)') from None
	if first.shape == second.shape == (3,):
		if not (first < second).all() or not np.isfinite(second - first).all():
			raise ValueError(f'region: upper must be above lower, and both finite, got {region!r}')
		return *boxPlanes(first, second), first, second
	try:
		normals, offsets, made = convexRegion(first, second)
	except (ValueError, TypeError) as error:
		raise ValueError(f'region: makes no convex body ({error})') from None
	corners = np.array(made['vertices'], float)
	return normals, offsets, corners.min(axis=0), corners.max(axis=0)


def _random(cells, normals, offsets, lower, upper, seed):
	if isinstance(cells, bool) or not isinstance(cells, numbers.Integral) or cells < 1:
		raise ValueError(f'cells: must be a whole number, at least 1, got {cells!r}')
	random, found = randomOf(seed), np.empty((0, 3))
	for _ in range(mostTries):
		points = random.uniform(lower, upper, (cells, 3))
		found = np.concatenate([found, points[(points @ normals.T < offsets).all(axis=1)]])
		if len(found) >= cells:
			return found[:cells]
	raise ValueError('region: is too thin for random points; give seeds of your own')


def _own(seeds, middle, normals, offsets, extent):
	points = np.array([[float(x) for x in row] for row in rows(seeds, 'seeds', 3)]).reshape(-1, 3) - middle
	if not len(points) or not np.isfinite(points).all() or not (points @ normals.T < offsets).all():
		raise ValueError('seeds: must be finite points inside the region')
	if len(points) > 1 and scipy.spatial.cKDTree(points).query(points, k=2)[0][:, 1].min() <= atOnce * extent.max():
		raise ValueError('seeds: two of them are at one point')
	return points


def _cells(points, normals, offsets, corners, box):
	"""(blocks, volumes, centroids).

	:param corners: of the region's box
	:param box: extents of a periodic box; None: the region's half-spaces bound the cells
	"""
	shifts = [(0, 0, 0)] if box is None else sorted(itertools.product((-1, 0, 1), repeat=3), key=lambda shift: shift != (0, 0, 0))
	images = np.concatenate([points + np.array(shift) * (0 if box is None else box) for shift in shifts])
	neighbours = _neighbours(images, len(points), corners)
	outer = (np.empty((0, 3)), np.empty(0)) if box is not None else (normals, offsets)
	blocks, volumes, centroids = [], np.empty(len(points)), np.empty((len(points), 3))
	for k, point in enumerate(tqdm(points, desc='cells', unit=' cells', disable=None, leave=False)):
		between = images[neighbours[k]] - point
		distances = np.linalg.norm(between, axis=1)
		unit = between / distances[:, None]
		middles = np.einsum('ij,ij->i', unit, (point + images[neighbours[k]]) / 2)
		planes, ends = np.vstack([unit, outer[0]]), np.concatenate([middles, outer[1]])
		made = _polytope.polyhedron(vectors(planes, 'normals', 3), ends.tolist())
		blocks.append(([tuple(normal) for normal in made['normals']], list(made['offsets'])))
		volumes[k], centroids[k] = float(made['volume']), np.array(made['centroid'], float)
	return blocks, volumes, centroids


def _neighbours(images, number, corners):
	"""Points whose cells share a face with those of the first *number* points, and maybe more.

	Eight points far outside bound every cell and make a triangulation of points in one plane possible. Every point of the region is nearer
	to a seed than to any of them.
	"""
	low, high = (bound([*images, *corners], axis=0) for bound in (np.min, np.max))
	reach = helpersReach * float(np.linalg.norm(high - low))
	helpers = (low + high) / 2 + reach * np.array(list(itertools.product((-1, 1), repeat=3)))
	starts, others = scipy.spatial.Delaunay(np.concatenate([images, helpers])).vertex_neighbor_vertices
	return [[j for j in others[starts[k] : starts[k + 1]].tolist() if j < len(images)] for k in range(number)]
