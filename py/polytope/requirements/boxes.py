# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of the collider, of polytope.requirements(): how far its boxes reach, and how tight they are."""

import numpy as np
from yade import Polytope, PolytopeCollider

from ..scene.present import colliders

__all__ = ['boxes', 'verletDist']

reach = 0.05
"""verletDist over the smallest body's size that is advised where there is none."""
leastReach = 1e-3
"""verletDist over that size below which any motion makes the collider run."""
mostPairs = 8
"""Pairs checked for each contact, above which verletDist is too large."""
mostApart = 1 / 3
"""Part of the pairs that tight boxes would not have made, above which it is reported."""


def verletDist(scene):
	"""verletDist"""
	if not colliders() or not scene.moving:
		return 'no InsertionSortCollider, or no body that can move'
	present = float(colliders()[0].verletDist)
	size = min(float(body.shape.inscribedRadius) for body in scene.moving)
	length = abs(present) * (size if present < 0 else 1)
	pairs = sum(functor.stats()['pairs'] for functor in scene.functors)
	contacts = sum(functor.stats()['contacts'] for functor in scene.functors)
	ratio = f', {pairs / contacts:.3g} pairs checked for each contact so far' if contacts else ''
	if present == 0:
		seen = '0: the collider sorts in every step'
	elif length > size and (not contacts or pairs > mostPairs * contacts):
		seen = f"{length:.3g} m, more than the smallest body's inscribed radius"
	elif length < leastReach * size:
		seen = f'{length:.3g} m, almost zero: the collider runs in nearly every step'
	else:
		return f'{length:.3g} m{ratio}', ''
	better = 2 * reach * size
	return seen + ratio, f'verletDist = {better:.2g}', None, ('verletDist', better)


def boxes(scene):
	"""boxes"""
	if not colliders():
		return 'no InsertionSortCollider'
	if isinstance(colliders()[0], PolytopeCollider):
		return 'tight: PolytopeCollider', ''
	tight = {body.id: _tightBox(body, float(colliders()[0].verletDist)) for body in scene.bodies}
	pairs = [(tight[one.id1], tight[one.id2]) for one in scene.O.interactions.all() if one.id1 in tight and one.id2 in tight]
	if scene.O.periodic or not pairs:
		return 'of circumscribed balls, where bodies can turn: PolytopeCollider has tight ones', ''
	apart = sum(bool(np.any(low1 > high2) or np.any(low2 > high1)) for (low1, high1), (low2, high2) in pairs)
	seen = f'of circumscribed balls, where bodies can turn: tight ones of {apart} of {len(pairs)} pairs are apart'
	return seen, 'PolytopeCollider in place of InsertionSortCollider' if apart > mostApart * len(pairs) else ''


def _tightBox(body, room):
	points = np.array([list(body.state.pos + body.state.ori * vertex) for vertex in body.shape.vertices], float)
	return points.min(axis=0) - room, points.max(axis=0) + room
