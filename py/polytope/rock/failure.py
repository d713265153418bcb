# SPDX-License-Identifier: GPL-2.0-or-later
"""How a rock mass fails, and by how much strengths were divided then: what each way to a factor of safety tells."""

import dataclasses

import numpy as np

from ..pictures.still import picture
from ..scene.movers import moverOf
from ..scene.stages import sizeOf

__all__ = ['Failure', 'inMode', 'noMode', 'partOfMode', 'told']

partOfMode = 0.1
"""Part of the largest displacement from which on a body is part of the mode."""


@dataclasses.dataclass
class Failure:
	"""A factor of safety with its mode."""

	stable: float
	"""Highest number by which strengths were divided and the scene stood."""
	failed: float
	"""Lowest one at which it failed; infinite: it stood with all that were tried, so it fails by no lack of these strengths, or at a larger
	number than *most*."""
	bodies: list
	"""Ids of those that moved when it failed, the farthest first: all that moved at least a tenth as far."""
	displacements: np.ndarray
	"""(n, 3) theirs [m]"""
	rotations: np.ndarray
	"""(n, 3) theirs, as vectors along the axis [rad]"""

	@property
	def factor(self):
		"""Middle of the bracket; infinite where nothing failed."""
		return (self.stable + self.failed) / 2

	@property
	def directions(self):
		"""(n, 3) unit vectors of the displacements; zero of a body that only turns"""
		lengths = np.linalg.norm(self.displacements, axis=1, keepdims=True)
		return np.divide(self.displacements, lengths, out=np.zeros_like(self.displacements), where=lengths > 0)

	def picture(self, path, **arguments):
		"""The scene as it is, bodies coloured by how far they moved when it failed. *arguments* are those of *polytope.picture*."""
		ways = dict(zip(self.bodies, np.linalg.norm(self.displacements, axis=1), strict=True))
		picture(
			path,
			**{
				'colorBy': lambda body: ways.get(moverOf(body.id), 0.0),
				'valueRange': (0, max(ways.values(), default=1)),
				'legend': 'displacement [m]',
				**arguments,
			},
		)

	def __str__(self):
		if np.isinf(self.failed):
			return f'factor of safety infinite: it stands with strengths divided by {self.stable:g}, so it fails by no lack of them (or at a larger number; *most*)'
		return f'factor of safety {self.factor:.4g} (stands at {self.stable:.4g}, fails at {self.failed:.4g}): {told(self.bodies, self.displacements, self.rotations)}'


def inMode(ways):
	"""Rows of the bodies that have gone so far, the farthest first, that they are part of the mode."""
	return [k for k in np.argsort(-ways) if ways[k] >= partOfMode * ways.max()]


def noMode():
	"""(bodies, displacements, rotations) of what does not fail."""
	return [], np.empty((0, 3)), np.empty((0, 3))


def told(bodies, displacements, rotations):
	"""The first ones, for a message."""
	modes = '; '.join(_toldOne(*one) for one in list(zip(bodies, displacements, rotations, strict=True))[:3])
	return modes + (f' and {len(bodies) - 3} more' if len(bodies) > 3 else '')


def _toldOne(k, way, turn):
	length, angle = np.linalg.norm(way), np.linalg.norm(turn)
	if angle * sizeOf(k) / 2 > length:
		return f'body {k} turns by {np.degrees(angle):.2g}° about {_direction(turn)}'
	return f'body {k} by {length:.2g} m towards {_direction(way)}'


def _direction(vector):
	return f'({", ".join(f"{x:.2f}" for x in vector / np.linalg.norm(vector))})'
