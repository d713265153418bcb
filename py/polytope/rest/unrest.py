# SPDX-License-Identifier: GPL-2.0-or-later
"""Which bodies will not come to rest, and why: found while a scene is run."""

import math
from typing import NamedTuple

import numpy as np
from yade import O

from ..measures.arrays import arrays
from ..scene.movers import partsOf
from ..scene.present import jointMaterials
from ..scene.stages import sizeOf
from .holding import isHeld, isThin, touched, unsupported
from .unbalanced import unbalancedForces
from .ways import posesById, turnsOf, waysOf

__all__ = ['NotAtRest', 'Restless', 'Unrest', 'remedy', 'told']

firstSpan = 1250
"""Length of the first span in steps; as often it is looked what falls, which it has by more than its size."""
patience = 10000
"""Steps before what trembles or slides away beside others is given up: some swings of the largest bodies of a mass whose time step is set
by the smallest ones."""
asBefore = 0.7
"""Mean force over its mean in the span before, half as long, above which it does not fade."""
inPlace, drift = 1e-3, 1.5
"""Largest way in a span over the body's size, and over that in the span before, below which it trembles and does not move: with a steady
speed the latter is two, from rest faster and faster three or more."""
turns = 10
"""Path over the largest way in a span, from which on it goes to and fro and does not swing: one swing of a slender column, almost upright
against its slope, takes 20000 steps or more, and in a quarter of it the force of one that comes to rest does not fade. A path from look to
look is some fifty ways where it trembles, and one or two in a part of a swing."""
still = 1e-9
"""Way over the size that is none but rounding."""
away = 0.5
"""Way over the body's size, from which on one that slides faster and faster slides away, where nothing else is unrest."""
farAway = 2
"""Way over the size in each of two spans on end, from which on one beside others that may come to rest slides away."""
leaning = 2.0
"""Angle of a body that still moves, from which on it topples [°]: blocks turn by some tenths as their joints close."""
displacedBy = 0.1
"""Way over the size, from which on a body that touched others has not come to rest where it was: joints close by some thousandths."""
named = 3
"""Bodies that a message names."""


class Restless(NamedTuple):
	"""A body that does not come to rest."""

	id: int
	unbalanced: float
	"""Mean unbalanced force since the last doubling of steps [-]."""
	kind: str
	"""'falls', 'slides', 'topples', 'trembles', or 'moves', which is none of these."""
	why: str


class NotAtRest(RuntimeError):
	"""Bodies that do not come to rest: *bodies* has them as *Restless*, the one with the largest force first."""

	def __init__(self, message, bodies=()):
		super().__init__(message)
		self.bodies = list(bodies)


class Unrest:
	"""Follows a scene from look to look, from when it is made.

	Steps are divided into spans, each of them as long as all before it. A body that goes to and fro, and whose mean force in a span is
	nearly what it was in the one before, will be no nearer to rest after twice as many steps.

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
		self.sizes = _sizes()
		self.origin = self.began = self.last = posesById()
		self.span = self.spanBefore = np.zeros(len(O.bodies))
		"""Largest ways since the span began, and in the one before, by moving or by turning (ways.py) [m]."""
		self.path = self.pathBefore = np.zeros(len(O.bodies))
		"""Sums of the ways from look to look since the span began [m]."""
		self.slid = set()
		"""Ids of bodies that slid far away in the span before."""
		self.fallsAt = firstSpan

	def look(self, steps):
		"""To be called after so many more steps; returns the largest unbalanced force."""
		forces = unbalancedForces(self.watched, self.masses)
		self.sum, self.looks, self.steps = _ofLength(self.sum, len(forces)) + forces, self.looks + 1, self.steps + steps
		self.mean = self.sum / self.looks
		if self.stood is None:
			self.stood = set(map(int, np.unique(arrays().contacts.ids)))
		if len(O.bodies) != len(self.sizes):
			self.sizes = _sizes()
		poses = posesById()
		ways = _waysWithTurns(self.began, poses, self.sizes)
		self.span = np.maximum(_ofLength(self.span, len(ways)), ways)
		self.path = _ofLength(self.path, len(ways)) + _waysWithTurns(self.last, poses, self.sizes)
		self.last = poses
		return float(forces.max(initial=0.0))

	def displaced(self, held=frozenset()):
		"""Bodies that touched others when it began, or were held in another way (their ids), and have moved by a tenth of their size or
		more, as (id, way [m]), the farthest first."""
		ways = _ways(self.origin.places, posesById().places)
		stood = (self.stood or set()) | held
		far = [(int(k), float(ways[k])) for k in np.flatnonzero(ways > 0) if int(k) in stood and ways[k] > displacedBy * sizeOf(int(k))]
		return sorted(far, key=lambda one: -one[1])

	def hopeless(self):
		"""What falls or slides far away; or all bodies that are not at rest, if none of them comes nearer to it, as *Restless*; else none.
		To be asked after each look."""
		if self.steps < self.end:
			return self._falling()
		found = self.moving()
		ways = _ways(self.origin.places, self.last.places)
		far = {one.id for one in found if one.kind == 'slides' and ways[one.id] > farAway * sizeOf(one.id)}
		slides = [one for one in found if one.id in far & self.slid] if self.steps >= patience else []
		lost = [one for one in found if one.kind == 'falls'] or (found if all(map(self._isLost, found)) else slides)
		self.slid = far
		self.spanBefore, self.span, self.began = self.span, np.zeros(len(self.span)), self.last
		self.before, self.sum, self.looks, self.end = self.mean, np.zeros(0), 0, 2 * self.steps
		self.pathBefore, self.path = self.path, np.zeros(len(self.path))
		return lost

	def moving(self, atLeast=0.0):
		"""All bodies that are not at rest, and what they do; only those that have moved by at least this part of their size."""
		ways = _ways(self.origin.places, self.last.places)
		span, path = (self.span, self.path) if self.looks else (self.spanBefore, self.pathBefore)
		there = [int(k) for k in np.flatnonzero(self.mean > self.bound) if k < len(O.bodies) and O.bodies[int(k)] is not None]
		if atLeast > 0:
			there = [k for k in there if ways[k] > atLeast * sizeOf(k)]
		falling = unsupported(there) if any(ways[k] > sizeOf(k) for k in there) else {}
		found = [Restless(k, float(self.mean[k]), *self._kind(k, falling, float(ways[k]), float(span[k]), float(path[k]))) for k in there]
		return sorted(found, key=lambda one: -one.unbalanced)

	def _falling(self):
		"""Now and then."""
		if self.steps < self.fallsAt:
			return []
		self.fallsAt = self.steps + firstSpan
		return [one for one in self.moving(atLeast=1) if one.kind == 'falls']

	def _isLost(self, one):
		if one.kind == 'trembles':
			return self.steps >= patience and self.mean[one.id] >= asBefore * _ofLength(self.before, len(self.mean))[one.id]
		return one.kind in ('falls', 'slides')

	def _kind(self, k, falling, way, span, path):
		"""Kind of unrest of body k, which has moved by *way* since the start and by *span* since the span began, on this *path*.

		:param falling: what *unsupported* tells of the bodies that are not at rest
		"""
		size, others = sizeOf(k), touched(k)
		if way > size and k in falling:  # what floats or hangs by a given force stays
			withIt = sorted(falling[k] - {k})
			if not withIt:
				return 'falls', 'touches nothing, and nothing is below it'
			ones = f'body {withIt[0]}' + (f' and {len(withIt) - 1} more' if len(withIt) > 1 else '')
			return 'falls', f'falls together with {ones}, and nothing is below'
		if not others and not isHeld(k):
			return 'moves', f'touches nothing, has moved by {way:.2g} m'
		before = float(_ofLength(self.spanBefore, len(self.span))[k])
		toAndFro = path >= turns * span or span <= still * size
		if toAndFro and span <= min(inPlace * size, max(drift * before, still * size)):
			return 'trembles', 'trembles in place' + (', is thin' if isThin(k) else '')
		sliding = sorted(other for other, slides in others.items() if slides)
		if sliding and way > away * size and span > before:
			return 'slides', f'slides on body {sliding[0]}, by {way:.2g} m up to now'
		turn = self._turn(k)
		if turn > leaning and way < math.radians(turn) * size / 10:
			return 'moves', f'turns in place, by {turn:.0f}° up to now'
		if turn > leaning:
			return 'topples', f'topples: turned by {turn:.0f}°, has moved by {way:.2g} m'
		return 'moves', f'has moved by {way:.2g} m'

	def _turn(self, k):
		"""Angle by which body k has turned since the start [°]; zero for one that is new."""
		return math.degrees(turnsOf(self.origin.of([k]), self.last.of([k]))[0]) if k < len(self.origin.places) else 0.0


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
		if any(_couldHang(one.id) for one in restless if one.kind == 'falls'):
			ways.append('polytope.bond() before, if it should hang by its tensileStrength: bodies that only touch have no joint')
	if 'topples' in kinds:
		ways.append('a wider base, a support, or bonds and bolts for what topples')
	if 'slides' in kinds:
		ways.append('more strength or a support for what slides')
	if 'trembles' in kinds:
		what = (
			', or no bodies so thin (*smallest* of polytope.jointedRock)'
			if any(isThin(one.id) for one in restless if one.kind == 'trembles')
			else ''
		)
		ways.append(
			f'an *unbalanced* above {max(one.unbalanced for one in restless if one.kind == "trembles"):.1g} for what trembles{what}'
		)
	return '; '.join(ways) or 'a larger *unbalanced*, or a support for bodies that fall'


def _couldHang(k):
	return any(material.tensileStrength > 0 for material in jointMaterials([O.bodies[part] for part in partsOf(k)]))


def _sizes():
	return np.array([0.0 if body is None else sizeOf(body.id) for body in (O.bodies[k] for k in range(len(O.bodies)))])


def _ways(before, now):
	"""Lengths from place to place [m]; zero for bodies that are new"""
	found = np.zeros(len(now))
	both = min(len(before), len(now))
	found[:both] = np.linalg.norm(now[:both] - before[:both], axis=1)
	return found


def _waysWithTurns(before, now, sizes):
	"""waysOf(); zero for bodies that are new"""
	found = np.zeros(len(sizes))
	both = min(len(before.places), len(sizes))
	found[:both] = waysOf(before.of(slice(both)), now.of(slice(both)), sizes[:both])
	return found


def _ofLength(values, length):
	"""The values, with zeros for bodies that are new."""
	return np.concatenate([values[:length], np.zeros(max(0, length - len(values)))])
