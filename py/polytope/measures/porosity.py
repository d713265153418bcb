# SPDX-License-Identifier: GPL-2.0-or-later
"""Porosity of a heap of polytopes, and what of a body's volume is inside a box or a convex region."""

import itertools

import numpy as np
import scipy  # loads its packages at their first use: half a second
from yade import O, Polytope, Sphere, Vector3, _polytope

from ..arguments import warn
from ..bodies.halfSpaces import boxPlanes, convexRegion
from ..bodies.polytopes import fromHalfSpaces
from ..scene.movers import canMove, partsOf
from ..scene.namedBodies import namedBodies
from ..scene.vertices import localVertices, rotationMatrix

__all__ = ['porosity', 'solidVolume', 'volumeInside']

thin = 1e-9
"""An intersection with a box whose inscribed ball is smaller than this, over the body's size, has no volume."""


def porosity(lower=None, upper=None, ids=None, region=None):
	"""Part of a box, a convex region or the periodic cell that is not filled: 1 − solid volume / volume.

	Bodies across its faces count with the part inside, cut exactly (the polyhedron of both sets of half-spaces). Where bodies in
	contact overlap, the overlap counts twice; that of a clump's parts counts once. Choose a box inside the heap: near walls and free
	surface there is less. In a periodic cell every image of a body counts with its part in the box.

	:param lower, upper: opposite corners of an axis-parallel box [m], 3 numbers each
	:param ids: of the bodies that count, a clump's for all its members; None: all free polytopes, with a warning where there are free spheres
	:param region: (normals, offsets), half-spaces a·x ≤ d [m] as for fromHalfSpaces, in place of a box. Without box and region, in a
	    periodic scene: the whole cell, whatever its tilt
	:returns: [-]
	:raises ValueError: naming *upper* where the box has no volume, *region*, or *ids* for a body that is no polyhedron, not there or named twice
	"""
	solids = [[O.bodies[part] for part in partsOf(k)] for k in namedBodies(ids)]
	if ids is None:  # what is no polytope in a clump is warned of, too
		solids = [[part for part in parts if isinstance(part.shape, Polytope)] for parts in solids]
	spheres = sum(isinstance(body.shape, Sphere) and canMove(body) for body in O.bodies if body) if ids is None else 0
	if spheres:
		warn(f'ids: the volume of {spheres} free spheres is not counted, only that of polytopes; give ids to say that this is meant')
	if lower is None and upper is None and region is None:
		if not O.periodic:
			raise ValueError('lower: give the corners of a box, or a region; only a periodic cell has a volume of its own')
		return 1 - sum(_filled(parts) for parts in solids) / abs(float(O.cell.volume))
	(normals, offsets), volume, corners = _box(lower, upper) if region is None else _region(region, lower, upper)
	low, high = corners.min(axis=0), corners.max(axis=0)
	return 1 - sum(_filledInside(parts, (normals, offsets), low, high) for parts in solids) / volume


def _box(lower, upper):
	"""(half-spaces, volume [m³], corners)"""
	try:
		lower, upper = np.array(lower, float), np.array(upper, float)
	except (TypeError, ValueError):
		lower = upper = np.empty(0)
	if lower.shape != (3,) or upper.shape != (3,) or not (upper > lower).all() or not np.isfinite(upper - lower).all():
		raise ValueError(f'upper: must be three finite numbers above those of lower, got lower {lower}, upper {upper}')
	return boxPlanes(lower, upper), float(np.prod(upper - lower)), np.array([lower, upper])


def _region(region, lower, upper):
	if lower is not None or upper is not None:
		raise ValueError('region: give a box or a region, not both')
	try:
		normals, offsets = region
		normals, offsets, made = convexRegion(normals, offsets)
	except (TypeError, ValueError) as error:
		raise ValueError(f'region: must be (normals, offsets) of a convex body ({error})') from None
	return (normals, offsets), float(made['volume']), np.array(made['vertices'], float).reshape(-1, 3)


def solidVolume(k):
	"""Volume of a polyhedron, or what the parts of a clump of them fill together [m³]: with the rigid body it does not change."""
	return _filled([O.bodies[part] for part in partsOf(k)])


def _filled(parts):
	volumes = [_whole(body) for body in parts]
	return volumes[0] if len(parts) == 1 else float(_polytope.unionOf(parts)[0])


def _filledInside(parts, planes, low, high):
	"""Volume [m³] of a body's part, with all of its images, within half-spaces: what its parts fill less what they fill outside."""
	normals, offsets = planes
	if len(parts) == 1:
		return sum(volumeInside(parts[0], normals, offsets - normals @ shift) for shift in _images(parts[0], low, high))
	for body in parts:
		_whole(body)
	region = fromHalfSpaces(normals.tolist(), offsets.tolist(), material=parts[0].material)
	place, inside = Vector3(region.state.pos), 0.0
	for shift in {tuple(shift) for body in parts for shift in _images(body, low, high)}:
		region.state.pos = place - Vector3(*shift)
		whole, around = _polytope.unionOf(parts)[0], _polytope.unionOf([region, *parts])[0]
		inside += float(whole + region.shape.volume - around)
	return inside


def _images(body, lower, upper):
	"""Displacements [m] of those images of a body that may reach into a box; without a periodic cell the body itself."""
	if not O.periodic:
		return [np.zeros(3)]
	cell, centre = np.array(O.cell.hSize, float).reshape(3, 3), np.array(body.state.pos, float)
	reach = max((float(corner.norm()) for corner in getattr(body.shape, 'vertices', [])), default=0.0)
	box = np.array(list(itertools.product(*zip(lower - reach - centre, upper + reach - centre, strict=True))))
	numbers = np.linalg.solve(cell, box.T)  # in periods, its columns being the corners
	first, last = np.floor(numbers.min(axis=1)).astype(int), np.ceil(numbers.max(axis=1)).astype(int)
	return [cell @ periods for periods in itertools.product(*(range(a, b + 1) for a, b in zip(first, last, strict=True)))]


def _whole(body):
	"""Volume of a polyhedron [m³]."""
	if not isinstance(body.shape, Polytope) or body.shape.dimension != 3:
		raise ValueError(f'ids: body {body.id} is no polyhedron')
	return float(body.shape.volume)


def volumeInside(body, normals, offsets):
	"""Volume [m³] of a polyhedron's part within half-spaces of unit normals.

	:raises ValueError: naming *ids* for a body that is no polyhedron
	"""
	volume, shape, state, planes = _whole(body), body.shape, body.state, (normals, offsets)
	position, reach = np.array([float(x) for x in state.pos]), float(shape.circumscribedRadius)
	distances = normals @ position - offsets
	if (distances <= -reach).all():  # most bodies, which need no closer look
		return volume
	if (distances >= reach).any():
		return 0.0
	turn = rotationMatrix(state.ori)
	corners = localVertices(shape) @ turn.T + position
	outside = corners @ normals.T - offsets
	if (outside <= 0).all():
		return volume
	if (outside.min(axis=0) >= 0).any():
		return 0.0
	normals = np.array(shape.normals, float) @ turn.T
	offsets = np.array(shape.offsets, float)
	# about the body's centre, in units of its size
	size = float(np.ptp(corners, axis=0).max())
	normals = np.vstack([normals, planes[0]])
	offsets = np.concatenate([offsets, planes[1] - planes[0] @ position]) / size
	# the largest ball inside: its centre is interior
	found = scipy.optimize.linprog(
		[0, 0, 0, -1], A_ub=np.column_stack([normals, np.ones(len(normals))]), b_ub=offsets, bounds=[(None, None)] * 4, method='highs'
	)
	if found.status != 0 or found.x[3] < thin:
		return 0.0
	part = scipy.spatial.HalfspaceIntersection(np.column_stack([normals, -offsets]), found.x[:3])
	return float(scipy.spatial.ConvexHull(part.intersections).volume) * size**3
