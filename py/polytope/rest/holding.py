# SPDX-License-Identifier: GPL-2.0-or-later
"""What holds a body up: contacts, bonds, bolts, and what it would fall on."""

import numpy as np
from yade import O, RockJointPhys, Wall

from ..bonding.bolting import madeBolts
from ..bonding.bonds import intactBonds
from ..scene.movers import partsOf
from ..scene.present import integrators

__all__ = ['anythingBelow', 'isHeld', 'isThin', 'touched']

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


def isHeld(k):
	"""Whether a bond or a bolt holds it."""
	parts = set(partsOf(k))
	return any(parts & {bond.id1, bond.id2} for bond in intactBonds()) or any(
		parts & {crossing.id1, crossing.id2} for bolt in madeBolts() for crossing in bolt.crossings if not crossing.failure
	)


def anythingBelow(k):
	"""Whether there is anything below body k, by the balls around boxes: rather too much counts."""
	gravity = np.array(integrators()[0].gravity, float)
	if not gravity.any():
		return True
	down, parts = gravity / np.linalg.norm(gravity), set(partsOf(k))
	centre = np.array(O.bodies[k].state.pos, float)
	own = max(_ball(O.bodies[part])[1] + np.linalg.norm(_ball(O.bodies[part])[0] - centre) for part in parts)
	for body in O.bodies:
		if body is None or body.id in parts or body.isClump or body.bound is None:
			continue
		if isinstance(body.shape, Wall):
			axis = body.shape.axis
			if (float(body.state.pos[axis]) - centre[axis]) * down[axis] > 0:
				return True
			continue
		middle, radius = _ball(body)
		apart = middle - centre
		deep = apart @ down
		if deep > -radius - own and np.linalg.norm(apart - deep * down) < radius + own:
			return True
	return False


def _ball(body):
	low, high = np.array(body.bound.min, float), np.array(body.bound.max, float)
	return (low + high) / 2, float(np.linalg.norm(high - low)) / 2
