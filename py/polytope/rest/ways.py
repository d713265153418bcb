# SPDX-License-Identifier: GPL-2.0-or-later
"""How far bodies have gone since a moment, or turned, whichever carries their surface farther: one that only spins stays where it is."""

from typing import NamedTuple

import numpy as np
from yade import O

from ..measures.arrays import arrays

__all__ = ['Poses', 'posesById', 'turnsOf', 'waysOf']


class Poses(NamedTuple):
	places: np.ndarray
	"""(n, 3) [m]"""
	orientations: np.ndarray
	"""(n, 4) quaternions (x, y, z, w)"""

	def of(self, ids):
		return Poses(self.places[ids], self.orientations[ids])


def posesById():
	"""Of all bodies; those of ids without a body are at zero, not turned."""
	bodies = arrays().bodies
	places, orientations = np.zeros((len(O.bodies), 3)), np.tile([0.0, 0.0, 0.0, 1.0], (len(O.bodies), 1))
	places[bodies.ids], orientations[bodies.ids] = bodies.positions, bodies.orientations
	return Poses(places, orientations)


def turnsOf(before, now):
	"""(n,) angles of the turns [rad]."""
	(v, w), (u, s) = ((poses.orientations[:, :3], poses.orientations[:, 3:]) for poses in (before, now))
	sine = np.linalg.norm(w * u - s * v - np.cross(v, u), axis=1)  # of half the angle: its cosine alone has half of the digits
	cosine = np.abs((v * u).sum(axis=1) + (w * s)[:, 0])
	return 2 * np.arctan2(sine, cosine)


def waysOf(before, now, sizes):
	"""(n,) way of the centre, or of a point half a size away from it by the body's turn, whichever is larger [m]."""
	return np.maximum(np.linalg.norm(now.places - before.places, axis=1), turnsOf(before, now) * sizes / 2)
