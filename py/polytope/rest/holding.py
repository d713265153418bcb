# SPDX-License-Identifier: GPL-2.0-or-later
"""What holds bodies up: contacts, bonds, bolts, and what they would fall on."""

import numpy as np
from yade import O, RockJointPhys, Wall

from ..bonding.bolting import madeBolts
from ..bonding.bonds import facingFaces, intactBonds
from ..measures.arrays import arrays
from ..scene.movers import moverOf, partsOf
from ..scene.present import gravityOf

__all__ = ['areJoined', 'facingPairs', 'isHeld', 'isThin', 'joinedPairs', 'touched', 'unsupported']

thin = 0.1
"""Inscribed over circumscribed radius, below which a body is said to be thin."""


def isThin(k):
	shapes = [O.bodies[part].shape for part in partsOf(k)]
	return any(hasattr(one, 'inscribedRadius') and float(one.inscribedRadius) < thin * float(one.circumscribedRadius) for one in shapes)


def touched(k):
	"""Other bodies that press on it → whether the joint slides."""
	found = {}
	for part in partsOf(k):
		for contact in O.bodies[part].intrs():
			if contact.isReal and float(contact.phys.normalForce.norm()) > 0:
				other = contact.id2 if contact.id1 == part else contact.id1
				found[other] = isinstance(contact.phys, RockJointPhys) and contact.phys.isSliding
	return found


def facingPairs():
	"""Pairs of ids of bodies with a face at each other's, the smaller id first, as *polytope.bond* finds them: also where they touch
	without a force, and so have no contact."""
	return _inOrder((one.id1, one.id2) for one in facingFaces())


def isHeld(k):
	"""Whether a bond or a bolt holds it."""
	return areJoined(partsOf(k))


def areJoined(parts):
	"""Whether a bond or a bolt joins one of these bodies to another."""
	parts = set(parts)
	return any(parts & set(pair) for pair in _links())


def joinedPairs():
	"""Pairs of ids of bodies that bonds and bolts join, the smaller id first."""
	return _inOrder(_links())


def _inOrder(pairs):
	return {(min(pair), max(pair)) for pair in pairs}


def _links():
	"""Ids of bodies that bonds and bolts connect, in pairs."""
	yield from ((bond.id1, bond.id2) for bond in intactBonds())
	yield from ((crossing.id1, crossing.id2) for bolt in madeBolts() for crossing in bolt.crossings if not crossing.failure)


def unsupported(moving):
	"""Which of these bodies hang in the air: no chain of contacts, bonds and bolts connects them to a fixed one or to one that is at rest,
	and nothing is below them, other than bodies that fall themselves. Id → the group that falls as one.

	:param moving: ids of the bodies that are not at rest, of clumps their own
	"""
	moving, contacts = set(moving), arrays().contacts
	pressing = contacts.ids[np.linalg.norm(np.nan_to_num(contacts.forces), axis=1) > 0]
	graph = {k: set() for k in moving}
	held = set()
	for one, two in [*pressing.tolist(), *_links()]:
		one, two = moverOf(one), moverOf(two)
		for k, other in ((one, two), (two, one)):
			if k in moving:
				graph[k].add(other)
				if other not in moving:
					held.add(k)
	groups = [group for group in _joined(graph) if not group & held]
	boxes, below = _Boxes(), True
	while groups and below:
		falling = {part for group in groups for k in group for part in partsOf(k)}
		below = [group for group in groups if any(boxes.anythingBelow(k, falling) for k in group)]
		groups = [group for group in groups if group not in below]
	return {k: group for group in groups for k in group}


def _joined(graph):
	"""Sets of ids that are connected in this graph, without those that are no ids of its own."""
	left = set(graph)
	while left:
		group, ahead = set(), [left.pop()]
		while ahead:
			k = ahead.pop()
			group.add(k)
			ahead += (graph[k] & left) - group
			left -= graph[k]
		yield group


class _Boxes:
	"""Boxes around all bodies, as the collider has them."""

	def __init__(self):
		gravity = np.array(gravityOf(), float)
		self.down = gravity / np.linalg.norm(gravity) if gravity.any() else None
		there = [body for body in O.bodies if body is not None and not body.isClump and body.bound is not None]
		self.row = {body.id: row for row, body in enumerate(there)}
		self.low, self.high = (np.array([corner(body) for body in there], float).reshape(-1, 3) for corner in (_lowest, _highest))

	def anythingBelow(self, k, falling):
		"""Whether the box around body k would meet that of a body, other than these, on its way down for ever."""
		if self.down is None:
			return True
		rows = [self.row[part] for part in partsOf(k) if part in self.row]
		if not rows:
			return True
		others = [row for part, row in self.row.items() if part not in falling]
		low, high = self.low[rows].min(axis=0), self.high[rows].max(axis=0)
		begin, end = np.zeros(len(others)), np.full(len(others), np.inf)
		for axis, speed in enumerate(self.down):
			before, after = self.low[others, axis] - high[axis], self.high[others, axis] - low[axis]
			if speed == 0:
				end[(before > 0) | (after < 0)] = -1
			else:
				times = np.sort([before / speed, after / speed], axis=0)
				begin, end = np.maximum(begin, times[0]), np.minimum(end, times[1])
		return bool((begin <= end).any())


def _lowest(body):
	return _corner(body, body.bound.min, -np.inf)


def _highest(body):
	return _corner(body, body.bound.max, np.inf)


def _corner(body, corner, endless):
	if not isinstance(body.shape, Wall):
		return [float(x) for x in corner]
	return [float(body.state.pos[axis]) if axis == body.shape.axis else endless for axis in range(3)]
