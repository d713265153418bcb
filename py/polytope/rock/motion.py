# SPDX-License-Identifier: GPL-2.0-or-later
"""What the motion of bodies in a trial tells: whether it goes on by itself, and how much strength would have stopped it."""

import numpy as np
from yade import O, Polytope, _polytope

from ..measures.arrays import arrays
from ..rest.holding import areJoined
from ..rest.unbalanced import resultants
from ..rest.ways import posesById, waysOf
from ..scene.movers import partsOf
from ..scene.stages import partOfSize

__all__ = ['Motion']

far = 0.25
"""Part of the way that counts as failure, from which on a body that moves faster and faster has failed: some ten times what elastic joints
give way."""
faster = 1.05
"""Least ratio of the ways in two of three or four equal parts of a trial, one after the other, where a body moves faster and faster: a
steady speed has 1, a steady acceleration from rest 1.4 at least."""
unmoved = 1e-6
"""Way over that which counts as failure, up to which a body is at rest, whatever its speed."""
early = 0.3
"""Part of the way that counts as failure, up to which the motion tells of the strength: beyond that blocks have come free of each other, and fall."""
sameWay = 0.5
"""Part of a body's way along its motion, from which on another body moves with it, and does not stop it."""
grazing = 0.1
"""Component of a contact's normal along the motion, above which it could stop it [-]."""


class Motion:
	"""Follows bodies from look to look of a trial, at equal numbers of steps.

	On the ways s of a mass that begins to move its bodies gain the work P = Σ F·s of their mean resultant forces F, in which vibrations
	cancel, and its joints take D = −Σ S·u by friction, with shear forces S and slips u of one side against the other. With strengths that
	are k times as large it would gain P + D − k D, as long as normal forces stay what they are, so k = 1 + P/D would just hold it (the
	kinematic theorem of limit analysis). Exact for one block on a plane; where normal forces depend on the strength, or blocks topple, it
	is an estimate.

	:param watched: ids of the bodies
	:param sizes: of each [m]
	"""

	def __init__(self, watched, sizes):
		self.watched, self.sizes = np.array(watched), sizes
		self.limits = partOfSize * sizes
		"""Way of each that counts as failure [m]."""
		self.parts = [np.zeros(len(sizes))]
		"""Way of each body, or by its turn (rest/ways.py), over its limit at each look, from the start on."""
		self.forces, self.looks = np.zeros((len(O.bodies), 3)), 0
		"""Sum of the resultant forces of all bodies over the looks that count [N], and their number."""
		self.taken, self.time = 0.0, O.time
		"""D [J], up to this time [s]."""
		self.began = self.now = posesById()
		self.touched, self.since = _touching(), (0, set())
		"""Pairs of bodies that touched when it began, or long since, by half or a quarter of the looks: what still moves faster and faster
		is not stopped by them; and those that touched at a look, with its number."""

	def look(self):
		poses = posesById()
		self.parts.append(waysOf(self.began.of(self.watched), poses.of(self.watched), self.sizes) / self.limits)
		if len(self.parts) > 2 * self.since[0]:
			self.touched, self.since = self.touched | self.since[1], (len(self.parts), _touching())
		if self.parts[-1].max() < early:
			self.forces, self.looks = self.forces + resultants(), self.looks + 1
			self.taken, self.time, self.now = self.taken + _friction() * (O.time - self.time), O.time, poses

	def way(self, looks):
		"""Largest way in the last looks, over its limit."""
		return float(np.abs(self.parts[-1] - self.parts[max(0, len(self.parts) - looks)]).max())

	def speedsUp(self):
		"""Whether a body has moved faster and faster all the while: its joints lack little of what would hold it, less than what counts as
		an unbalanced force."""
		return bool((self._speeding(3) & (self.parts[-1] > unmoved)).any())

	def limit(self, factor):
		"""The factor at which strengths would have held the mass, or None.

		:param factor: by which they are divided now
		"""
		gained = float((self.forces * (self.now.places - self.began.places)).sum()) / max(1, self.looks)
		return factor * self.taken / (self.taken + gained) if self.taken > 0 and gained > 0 else None

	def runsAway(self):
		"""Whether a body moves faster and faster with nothing that could stop it on the way that is left until it counts as failed."""
		if len(self.parts) < 9 or self.parts[-1].max() < far:
			return False
		speeding = (self.parts[-1] >= far) & self._speeding(4)
		return any(not self._isStopped(k) for k in np.flatnonzero(speeding))

	def _speeding(self, spans):
		"""For each body whether it moved faster in each of so many equal parts of the trial than in the one before."""
		last = len(self.parts) - 1
		ways = np.diff([self.parts[last * k // spans] for k in range(spans + 1)], axis=0)
		return (ways[1:] > faster * np.maximum(ways[:-1], 0)).all(axis=0)

	def _isStopped(self, k):
		"""Whether body k meets another one, which it has not touched for long and which does not move with it; or it may be: a bolt or a
		bond joins it, or what moves with it, and may pull more the farther it goes. A bolt across a joint pulls not at all at first. Of a body
		that hardly moves and turns, it is not looked what is ahead."""
		way = (posesById().places - self.began.places)[self.watched]
		length = np.linalg.norm(way[k])
		if 2 * length < self.parts[-1][k] * self.limits[k]:
			return True
		along = way[k] / length
		withIt = {int(self.watched[j]) for j in np.flatnonzero(way @ along >= sameWay * length)}
		parts = {part for j in withIt for part in partsOf(j)}
		return areJoined(parts) or self._meets(int(self.watched[k]), along, self.limits[k] - length, parts)

	def _meets(self, k, along, left, withIt):
		"""Whether body k would touch another one, not of these, now or on the way that is left, so that it could not go on along it."""
		parts = [O.bodies[part] for part in partsOf(k)]
		if not all(isinstance(part.shape, Polytope) for part in parts):
			return True  # of other shapes it is not looked what is ahead
		for part in parts:
			place, reach = part.state.pos, float(part.shape.circumscribedRadius) + left
			near = [body for body in _others(withIt) if (body.state.pos - place).norm() < reach + float(body.shape.circumscribedRadius)]
			near = [body for body in near if not {(part.id, body.id), (body.id, part.id)} & self.touched]
			try:
				for ahead in (0.0, 0.5, 1.0):
					part.state.pos = place + type(place)(*(ahead * left * along))
					if any(_opposes(_polytope.contact(part, body), along) for body in near):
						return True
			finally:
				part.state.pos = place
		return False


def _friction():
	"""Power that shear forces of all contacts take [W]."""
	bodies, contacts = arrays()
	places, speeds, turns = (np.zeros((len(O.bodies), 3)) for _ in range(3))
	places[bodies.ids], speeds[bodies.ids], turns[bodies.ids] = bodies.positions, bodies.velocities, bodies.angularVelocities
	one, two = contacts.ids.T
	sliding = (
		speeds[two]
		+ np.cross(turns[two], contacts.points - places[two])
		- speeds[one]
		- np.cross(turns[one], contacts.points - places[one])
	)
	return -float(np.nansum(contacts.shearForces * sliding))


def _touching():
	return set(map(tuple, arrays().contacts.ids.tolist()))


def _others(withIt):
	return [body for body in O.bodies if body is not None and isinstance(body.shape, Polytope) and body.id not in withIt]


def _opposes(contact, along):
	return contact.inContact and np.array(contact.normal, float) @ along > grazing
