# SPDX-License-Identifier: GPL-2.0-or-later
"""How far bodies have gone since a moment, or turned, whichever carries their surface farther: one that only spins stays where it is."""

from typing import NamedTuple

import numpy as np
from yade import O

from ..measures.arrays import arrays

__all__ = ['Poses', 'posesOf', 'turnsOf', 'waysOf']


class Poses(NamedTuple):
	places: np.ndarray
	"""(n, 3) [m]"""
	orientations: np.ndarray
	"""(n, 4) quaternions (x, y, z, w)"""


def posesOf(ids):
	"""Where these bodies are."""
	bodies = arrays().bodies
	row = np.zeros(len(O.bodies), int)
	row[bodies.ids] = np.arange(len(bodies.ids))
	return Poses(bodies.positions[row[ids]], bodies.orientations[row[ids]])


def waysOf(before, now, sizes):
	"""(n,) way of the centre, or turnsOf(), whichever is larger [m]."""
	return np.maximum(np.linalg.norm(now.places - before.places, axis=1), turnsOf(before, now, sizes))


def turnsOf(before, now, sizes):
	"""(n,) way of a point half a size away from the centre by the body's turn [m]."""
	(v, w), (u, s) = ((poses.orientations[:, :3], poses.orientations[:, 3:]) for poses in (before, now))
	sine = np.linalg.norm(w * u - s * v - np.cross(v, u), axis=1)  # of half the angle: its cosine alone has half of the digits
	cosine = np.abs((v * u).sum(axis=1) + (w * s)[:, 0])
	return np.arctan2(sine, cosine) * sizes
