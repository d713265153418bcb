# SPDX-License-Identifier: GPL-2.0-or-later
"""Vectors in a product of cones: second-order ones in space, and numbers that are not negative; the scaling of Nesterov and Todd."""

import dataclasses

import numpy as np

__all__ = ['Cones', 'Scaling', 'product', 'quotient']


@dataclasses.dataclass
class Cones:
	round: np.ndarray
	"""(n, 3) vectors, in the cone where the first component is at least as large as the other two together"""
	plain: np.ndarray
	"""(m,) numbers"""

	@classmethod
	def unit(cls, rounds, plains):
		"""In the middle of all cones."""
		return cls(np.tile([1.0, 0, 0], (rounds, 1)), np.ones(plains))

	def __add__(self, other):
		return Cones(self.round + other.round, self.plain + other.plain)

	def __sub__(self, other):
		return Cones(self.round - other.round, self.plain - other.plain)

	def __neg__(self):
		return Cones(-self.round, -self.plain)

	def __rmul__(self, factor):
		return Cones(factor * self.round, factor * self.plain)

	def dot(self, other):
		return float((self.round * other.round).sum() + self.plain @ other.plain)

	def largest(self):
		"""The largest magnitude of any component."""
		return max(float(np.abs(self.round).max()), float(np.abs(self.plain).max()))

	def depth(self):
		"""By how much it is within the cones, least of all."""
		return min(float((self.round[:, 0] - np.linalg.norm(self.round[:, 1:], axis=1)).min()), float(self.plain.min()))


def _turned(v):
	"""J v"""
	return v * np.array([1.0, -1.0, -1.0])


def _squares(v):
	"""vᵀ J v of vectors within the cone, without cancellation"""
	across = np.linalg.norm(v[:, 1:], axis=1)
	return (v[:, 0] - across) * (v[:, 0] + across)


def product(a, b):
	"""a ∘ b"""
	return Cones(
		np.concatenate(
			[(a.round * b.round).sum(axis=1, keepdims=True), a.round[:, :1] * b.round[:, 1:] + b.round[:, :1] * a.round[:, 1:]], axis=1
		),
		a.plain * b.plain,
	)


def quotient(a, b):
	"""x with a ∘ x = b"""
	first = (a.round * _turned(b.round)).sum(axis=1) / _squares(a.round)
	rest = (b.round[:, 1:] - first[:, None] * a.round[:, 1:]) / a.round[:, :1]
	return Cones(np.concatenate([first[:, None], rest], axis=1), b.plain / a.plain)


class Scaling:
	"""W, symmetric, for which s and z are the same point when they are scaled: W⁻¹ s = W z."""

	def __init__(self, s, z):
		ss, zz = _squares(s.round), _squares(z.round)
		unit = s.round / np.sqrt(ss)[:, None], z.round / np.sqrt(zz)[:, None]
		half = np.sqrt((1 + (unit[0] * unit[1]).sum(axis=1)) / 2)
		w = (unit[0] + _turned(unit[1])) / (2 * half[:, None])
		w[:, 0] = np.sqrt(1 + (w[:, 1:] ** 2).sum(axis=1))
		self.w, self.size = w, (ss / zz) ** 0.25
		self.root = (w + [1.0, 0, 0]) / np.sqrt(2 * (w[:, :1] + 1))
		self.plain = np.sqrt(s.plain / z.plain)
		self.point = self.times(z)

	def times(self, v):
		"""W v"""
		return Cones(
			self.size[:, None] * (2 * self.root * (self.root * v.round).sum(axis=1, keepdims=True) - _turned(v.round)), self.plain * v.plain
		)

	def over2(self, v):
		"""W⁻² v"""
		turned = _turned(self.w)
		return Cones(
			(2 * turned * (turned * v.round).sum(axis=1, keepdims=True) - _turned(v.round)) / (self.size**2)[:, None],
			v.plain / self.plain**2,
		)

	def room(self, step):
		"""Largest x with point + x step in the cones, where the step is scaled, too."""
		at = self.point
		size = np.sqrt(_squares(at.round))
		unit = at.round / size[:, None]
		along = (unit * _turned(step.round)).sum(axis=1)
		across = step.round[:, 1:] - ((along + step.round[:, 0]) / (unit[:, 0] + 1))[:, None] * unit[:, 1:]
		return 1 / max(1e-12, float(((np.linalg.norm(across, axis=1) - along) / size).max()), float((-step.plain / at.plain).max()))
