# SPDX-License-Identifier: GPL-2.0-or-later
"""Extents of a packing, and the sizes of its bodies."""

import numpy as np
from yade import O, Sphere

from ..scene.namedBodies import namedBodies
from ..scene.vertices import localVertices, worldVertices
from .counted import freePolytopes, massive

__all__ = ['aabbExtrema', 'sizeDistribution']


def aabbExtrema(ids=None):
	"""Opposite corners of the box about bodies, by their vertices (spheres: radius), not by their bounds.

	:param ids: of polytopes, spheres, boxes, facets and clumps; None: all free polytopes and spheres, and clumps of them
	:returns: (lower, upper), arrays of 3 [m]; in a periodic cell bodies count where their centre is inside it
	:raises ValueError: naming *ids* for a body that is not there, or without an extent (walls)
	"""
	low, high = np.full(3, np.inf), np.full(3, -np.inf)
	for k in massive(None) if ids is None else namedBodies(ids):
		for member in O.bodies[k].shape.members if O.bodies[k].isClump else (k,):
			points = _extremes(O.bodies[member])
			low, high = np.minimum(low, points.min(axis=0)), np.maximum(high, points.max(axis=0))
	if not np.isfinite(low).all():
		raise ValueError('ids: there is no free polytope or sphere')
	return low, high


def sizeDistribution(sieves=None, ids=None):
	"""Grain size distribution: the part of the mass that passes a square sieve.

	A polytope's size is the intermediate one of its extents along its principal axes.

	:param sieves: openings [m]; None: the sizes of the bodies themselves, in order
	:param ids: of polyhedra; None: all free ones that are in no clump
	:returns: (openings, passing), arrays [m], [-]
	:raises ValueError: naming *ids*, or *sieves* if they are no lengths
	"""
	chosen = freePolytopes(ids)
	flat = next((k for k in chosen if O.bodies[k].shape.dimension == 2), None)
	if flat is not None:
		raise ValueError(f'ids: body {flat} is a polygon, which no sieve has an opening for; name polyhedra')
	sizes = np.array([np.sort(np.ptp(localVertices(O.bodies[k].shape), axis=0))[1] for k in chosen])
	masses = np.array([float(O.bodies[k].shape.volume * O.bodies[k].material.density) for k in chosen])
	try:
		openings = np.sort(sizes) if sieves is None else np.array([float(opening) for opening in sieves])
	except (TypeError, ValueError):
		openings = np.array([np.nan])
	if not (openings > 0).all():
		raise ValueError(f'sieves: must be openings above 0 [m], got {sieves!r}')
	order = np.argsort(sizes)
	passed = np.concatenate([[0], np.cumsum(masses[order])])
	return openings, passed[np.searchsorted(sizes[order], openings, side='right')] / masses.sum()


def _extremes(body):
	"""Points whose box is the body's."""
	if isinstance(body.shape, Sphere):
		place = O.cell.wrap(body.state.pos) if O.periodic else body.state.pos
		return np.array(place, float) + np.array([[-1], [1]]) * float(body.shape.radius)
	points = worldVertices(body)
	if not len(points):
		raise ValueError(f'ids: body {body.id} is a {type(body.shape).__name__}, which has no extent of its own')
	return points
