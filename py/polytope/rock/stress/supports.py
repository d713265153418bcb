# SPDX-License-Identifier: GPL-2.0-or-later
"""Planes in which pieces of one rigid body lie flush, so that they stay flush where one of them moves.

Fixed bodies, or the parts of a clump, that lie side by side make one face of several pieces. A piece that a block meets along an edge alone
has no joint, and so no closure of its own. If it stayed where it is, its neighbours' faces would stand out by theirs, a step as high as the
contact is deep: whether such a step counts is decided anew with each motion (docs/contact-force.md, internal faces of a rigid support), so
that the force would jump and the block would never come to rest.
"""

import numpy as np
import scipy  # loads its packages at their first use
from yade import O, Polytope

from ...bodies.halfSpaces import worldPlanes
from ...scene.movers import canMove
from ...scene.vertices import worldVertices
from ..faceMaterials import materialOfPlane

__all__ = ['inLine']

flush = 1e-9
"""How far the ends of one plane, or two bodies that touch, may be apart by rounding, over the largest coordinate."""


def inLine(moved):
	"""Planes that move, and those which continue them.

	:param moved: (id, index of the plane) → material
	:returns: the same with the others, of which each has its own material
	"""
	found = dict(moved)
	for pieces in _supports({k for k, _ in moved}):
		_follow(pieces, found)
	return found


def _supports(of):
	"""Lists of ids: those fixed bodies and parts of clumps that make one rigid body with one of these."""
	bodies = [body for body in O.bodies if body is not None and isinstance(body.shape, Polytope)]
	groups = {}
	for body in bodies:
		if not canMove(body):
			groups.setdefault(None, []).append(body.id)
		elif body.isClumpMember:
			groups.setdefault(body.clumpId, []).append(body.id)
	return [ids for ids in groups.values() if len(ids) > 1 and of & set(ids)]


def _follow(pieces, found):
	"""Adds planes of the pieces to *found*, piece by piece."""
	corners = {k: worldVertices(O.bodies[k]) for k in pieces}
	low, high = (np.array([side(corners[k], axis=0) for k in pieces]) for side in (np.min, np.max))
	size = float(max(np.abs(low).max(), np.abs(high).max()))
	planes = [worldPlanes(O.bodies[k]) for k in pieces]
	places = np.concatenate([np.column_stack([size * normals, offsets]) for normals, offsets in planes])
	owners = [(row, plane) for row, (normals, _) in enumerate(planes) for plane in range(len(normals))]
	numbers = {(pieces[row], plane): number for number, (row, plane) in enumerate(owners)}
	tree = scipy.spatial.cKDTree(places)
	waiting = [numbers[key] for key in found if key in numbers]
	while waiting:
		number = waiting.pop()
		row = owners[number][0]
		for other in tree.query_ball_point(places[number], flush * size):
			beside, plane = owners[other]
			key = pieces[beside], plane
			apart = np.maximum(low[beside] - high[row], low[row] - high[beside]).max()
			if key not in found and apart <= flush * size:
				found[key] = materialOfPlane(O.bodies[key[0]], plane)
				waiting.append(other)
