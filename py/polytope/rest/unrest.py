# SPDX-License-Identifier: GPL-2.0-or-later
"""Which bodies will not come to rest, and why: found while a scene is run."""

from typing import NamedTuple

import numpy as np
from yade import O, RockJointPhys, Wall

from ..bonding.bolting import madeBolts
from ..bonding.bonds import madeBonds
from ..measures.arrays import arrays
from ..scene.present import integrators
from ..scene.stages import sizeOf
from .unbalanced import unbalancedForces

__all__ = ['NotAtRest', 'Restless', 'Unrest', 'remedy', 'told']

firstSpan = 1250
"""Steps after which it is looked for the first time what falls, which it has by more than its size; then whenever their number has doubled."""
patience = 10000
"""Steps before what neither falls nor slides away is given up: some swings of the largest bodies of a mass whose time step is set by the smallest ones."""
asBefore = 0.7
"""Mean force over its mean in the span before, half as long, above which it does not fade."""
inPlace, drift = 1e-3, 1.5
"""Largest way in a span over the body's size, and over that in the span before, below which it trembles and does not move: with a steady speed the latter is two, from rest faster and faster three or more."""
still = 1e-9
"""Way over the size that is none but rounding."""
away = 0.5
"""Way over the body's size, from which on one that slides faster and faster slides away."""
thin = 0.1
"""Inscribed over circumscribed radius, below which a body is said to be thin."""
named = 3
"""Bodies that a message names."""


class Restless(NamedTuple):
	"""A body that does not come to rest."""

	id: int
	unbalanced: float
	"""Its mean force since the last doubling of steps [-]."""
	kind: str
	"""'falls', 'slides', 'trembles', or 'moves', which is none of these."""
	why: str


class NotAtRest(RuntimeError):
	"""Bodies that do not come to rest: *bodies* has them as *Restless*, the one with the largest force first."""

	def __init__(self, message, bodies=()):
		super().__init__(message)
		self.bodies = list(bodies)


class Unrest:
	"""Follows a scene from look to look, from when it is made.

	Steps are divided into spans, each of them as long as all before it. A body whose mean force in a span is nearly what it was in the one before will be no nearer to rest after twice as many
	steps.

	:param float bound: unbalanced force below which a body is at rest
	:param watched: ids; None: all that can move
	:param masses: true masses by id, where those of the scene are scaled [kg]
	"""

	def __init__(self, bound, watched=None, masses=None):
		self.bound, self.watched, self.masses = bound, watched, masses
		self.steps, self.end, self.looks = 0, firstSpan, 0
		self.stood = None
		"""Ids of bodies that touched others at the first look."""
		self.sum = self.mean = self.before = np.zeros(0)
		self.origin = self.began = _places()
		self.span = self.spanBefore = np.zeros(len(self.origin))
		"""Largest ways since the span began, and in the one before [m]."""

	def look(self, steps):
		"""After so many steps more; returns the largest unbalanced force."""
		forces = unbalancedForces(self.watched, self.masses)
		self.sum, self.looks, self.steps = _ofLength(self.sum, len(forces)) + forces, self.looks + 1, self.steps + steps
		self.mean = self.sum / self.looks
		if self.stood is None:
			self.stood = set(map(int, np.unique(arrays().contacts.ids)))
		ways = _ways(self.began, _places())
		self.span = np.maximum(_ofLength(self.span, len(ways)), ways)
		return float(forces.max(initial=0.0))

	def displaced(self):
		"""Of bodies that stood on others when it began, those that have moved by more than their size, as (id, way [m]), the farthest first."""
		ways = _ways(self.origin, _places())
		far = [(int(k), float(ways[k])) for k in np.flatnonzero(ways > 0) if int(k) in self.stood and ways[k] > sizeOf(int(k))]
		return sorted(far, key=lambda one: -one[1])

	def hopeless(self):
		"""All bodies that are not at rest, if none of them comes nearer to it, as *Restless*; else none. To be asked after each look."""
		if self.steps < self.end:
			return []
		found = self.moving()
		lost = [one for one in found if one.kind == 'falls'] or (found if all(map(self._isLost, found)) else [])
		self.spanBefore, self.span, self.began = self.span, np.zeros(len(self.span)), _places()
		self.before, self.sum, self.looks, self.end = self.mean, np.zeros(0), 0, 2 * self.steps
		return lost

	def moving(self):
		"""All that are not at rest, and what they do."""
		ways, span = _ways(self.origin, _places()), self.span if self.looks else self.spanBefore
		there = [int(k) for k in np.flatnonzero(self.mean > self.bound) if k < len(O.bodies) and O.bodies[int(k)] is not None]
		found = [Restless(k, float(self.mean[k]), *self._kind(k, float(ways[k]), float(span[k]))) for k in there]
		return sorted(found, key=lambda one: -one.unbalanced)

	def _isLost(self, one):
		if one.kind == 'trembles':
			return self.steps >= patience and self.mean[one.id] >= asBefore * _ofLength(self.before, len(self.mean))[one.id]
		return one.kind in ('falls', 'slides')

	def _kind(self, k, way, span):
		"""Kind of unrest of body k, which has moved by *way* since the start and by *span* since the span began."""
		size, touched = sizeOf(k), _touched(k)
		if not touched and not _held(k):
			if way > size and not _anythingBelow(k):  # what floats or hangs by a given force stays
				return 'falls', 'touches nothing, and nothing is below it'
			return 'moves', f'touches nothing, has moved by {way:.2g} m'
		before = float(_ofLength(self.spanBefore, len(self.span))[k])
		if span <= min(inPlace * size, max(drift * before, still * size)):
			return 'trembles', 'trembles in place' + (', is thin' if _isThin(k) else '')
		sliding = sorted(other for other, slides in touched.items() if slides)
		if sliding and way > away * size and span > before:
			return 'slides', f'slides on body {sliding[0]}, by {way:.2g} m up to now'
		return 'moves', f'has moved by {way:.2g} m'


def told(restless):
	"""The first ones, for a message."""
	ones = '; '.join(f'body {one.id} {one.why} ({one.unbalanced:.2g})' for one in restless[:named])
	return f'{len(restless)} not at rest: {ones}{"; …" if len(restless) > named else ""}'


def remedy(restless):
	"""What can be done about it, for a message."""
	kinds = {one.kind for one in restless}
	ways = []
	if 'falls' in kinds:
		ways.append('a support for what falls, or O.bodies.erase() it')
	if 'slides' in kinds:
		ways.append('more strength or a support for what slides')
	if 'trembles' in kinds:
		what = ', or no bodies so thin (*smallest* of polytope.jointedRock)' if any(_isThin(one.id) for one in restless if one.kind == 'trembles') else ''
		ways.append(f'an *unbalanced* above {max(one.unbalanced for one in restless if one.kind == "trembles"):.1g} for what trembles{what}')
	return '; '.join(ways) or 'a larger *unbalanced*, or a support for bodies that fall'


def _parts(k):
	body = O.bodies[k]
	return list(body.shape.members) if body.isClump else [k]


def _isThin(k):
	shapes = [O.bodies[part].shape for part in _parts(k)]
	return any(hasattr(one, 'inscribedRadius') and float(one.inscribedRadius) < thin * float(one.circumscribedRadius) for one in shapes)


def _touched(k):
	"""Other bodies that press on it → whether the joint slides."""
	found = {}
	for part in _parts(k):
		for contact in O.bodies[part].intrs():
			if contact.isReal and float(contact.phys.normalForce.norm()) > 0:
				other = contact.id2 if contact.id1 == part else contact.id1
				found[other] = isinstance(contact.phys, RockJointPhys) and contact.phys.isSliding
	return found


def _held(k):
	"""Whether a bond or a bolt holds it."""
	parts = set(_parts(k))
	return any(bond.intact and parts & {bond.id1, bond.id2} for bond in madeBonds()) or any(
		parts & {crossing.id1, crossing.id2} for bolt in madeBolts() for crossing in bolt.crossings if not crossing.failure
	)


def _anythingBelow(k):
	"""Whether there is anything below body k, by the balls around boxes: rather too much counts."""
	gravity = np.array(integrators()[0].gravity, float)
	if not gravity.any():
		return True
	down, parts = gravity / np.linalg.norm(gravity), set(_parts(k))
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


def _places():
	"""(n, 3) by id; of ids without a body zero [m]"""
	bodies = arrays().bodies
	found = np.zeros((len(O.bodies), 3))
	found[bodies.ids] = bodies.positions
	return found


def _ways(before, now):
	"""Lengths from place to place; of bodies that are new zero [m]"""
	found = np.zeros(len(now))
	both = min(len(before), len(now))
	found[:both] = np.linalg.norm(now[:both] - before[:both], axis=1)
	return found


def _ofLength(values, length):
	"""The values, with zeros for bodies that are new."""
	return np.concatenate([values[:length], np.zeros(max(0, length - len(values)))])
