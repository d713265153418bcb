# SPDX-License-Identifier: GPL-2.0-or-later
"""Polytopes that touch from the start, for polytope.check()."""

import itertools

import numpy as np
import scipy  # loads its packages at their first use: half a second
from yade import _polytope

from ..measures.arrays import arrays
from .overlaps import mayMeet, sortedOffsets

__all__ = ['contactOf', 'looks', 'touching', 'touchingPairs']

touching = 1e-6
"""Gap over the smaller circumscribed radius up to which bodies are in touch from the start."""

looks = 2000
"""Pairs of neighbours to look at for those that touch: blocks of a rock mass do, grains of a cloud do not."""


def touchingPairs(scene, bodies):
	"""(one, other, their contact) of those that meet."""
	if len(bodies) < 2:
		return
	radii = np.array([float(body.shape.circumscribedRadius) for body in bodies])
	rows = arrays().bodies
	places = rows.positions[np.searchsorted(rows.ids, [body.id for body in bodies])]
	near = scipy.spatial.cKDTree(places).query_ball_point(places, 2 * radii)
	rank = np.argsort(np.argsort(-radii, kind='stable'))  # the larger one of a pair looks for the other
	pairs = ((bodies[i], bodies[j], radii[j]) for i, others in enumerate(near) for j in others if rank[i] < rank[j])
	for one, other, radius in itertools.islice((pair for pair in pairs if _meet(scene, *pair[:2])), looks):
		contact = contactOf(one, other, radius)
		if contact is not None:
			yield one, other, contact


def contactOf(one, other, radius):
	"""The contact of two polytopes, the smaller of which has this circumscribed radius [m]; None: they do not touch."""
	try:
		contact = _polytope.contact(one, other)
	except ValueError:  # a polygon and a polyhedron
		return None
	return contact if float(contact.infeasibility) < touching * radius else None


def _meet(scene, one, other):
	"""Whether they may have a contact: not the same place, which coincidence() finds."""
	samePlace = (one.state.pos - other.state.pos).norm() == 0 and sortedOffsets(one) == sortedOffsets(other)
	return not samePlace and mayMeet(scene, one, other)
