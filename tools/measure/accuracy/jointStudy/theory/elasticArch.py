# SPDX-License-Identifier: GPL-2.0-or-later
"""The arch of arch.py with joints that are elastic, per area, and take no tension: how thin it may be before it falls.

Rigid blocks, joints of normal stiffness kn per area, as stiff in shear, that do not slip. A joint whose two edges are δ₀ and δ₁ deep in
each other stores ½ kn ∫ ⟨δ⟩² ds over its length, ⟨δ⟩ what is above 0. The arch stands if, as its weight grows from nothing, its energy
keeps a minimum that can be reached. Hinges then lie not at edges but a third of their wedge of pressure inside, so that it must be
thicker than by limit analysis. Lengths in mean radii, forces per unit of breadth in weight density × radius².
"""

import math

import numpy as np

from .arch import leastThickness, voussoir

__all__ = ['ElasticArch', 'leastElasticThickness']


class ElasticArch:
	"""The arch's energy, by the places and turns of its blocks (n, 3): x, y of the centroid, angle, from where they were cut.

	:param float thickness: over the mean radius
	:param float stiffness: kn over (weight density) [-]: [Pa/m] over [N/m³]
	"""

	def __init__(self, thickness, blocks, stiffness):
		self.thickness, self.blocks, self.stiffness = thickness, blocks, stiffness
		self.weight, radius = voussoir(thickness, blocks)
		q = math.pi * np.arange(blocks + 1) / blocks
		middle = (q[:-1] + q[1:]) / 2
		self.rest = np.column_stack([radius * np.cos(middle), radius * np.sin(middle), np.zeros(blocks)])
		ends = np.array([1 - thickness / 2, 1 + thickness / 2])
		# (joints, 2 edges, 2): the edges of each joint from the centroid of the block before and behind it; the springers stay
		edges = np.stack([ends * np.cos(q)[:, None], ends * np.sin(q)[:, None]], axis=-1)
		centres = np.vstack([np.zeros(2), self.rest[:, :2], np.zeros(2)])
		self.before, self.behind = edges - centres[:-1, None], edges - centres[1:, None]
		self.normal = np.column_stack([-np.sin(q), np.cos(q)])  # from the block before to that behind
		self.centres = centres

	def _joints(self, moved):
		moves = np.vstack([np.zeros(3), moved, np.zeros(3)])
		arm1, arm2 = _turned(self.before, moves[:-1, 2]), _turned(self.behind, moves[1:, 2])
		apart = (self.centres[1:] + moves[1:, :2])[:, None] + arm2 - (self.centres[:-1] + moves[:-1, :2])[:, None] - arm1
		n = _turned(self.normal[:, None], (moves[:-1, 2] + moves[1:, 2]) / 2)[:, 0]
		slip = np.einsum('jek,jk->j', apart, _across(n)) / 2
		return arm1, arm2, apart, n, -np.einsum('jek,jk->je', apart, n), slip

	def energy(self, moved, load):
		"""Energy with *load* times the weight, from where the blocks were cut."""
		*_, depth, slip = self._joints(moved)
		squares = (depth * _edgeForces(depth)).sum() + (slip**2).sum()
		return self.stiffness * self.thickness * squares / 2 + load * self.weight * moved[:, 1].sum()

	def gradient(self, moved, load):
		"""Gradient of the energy (n, 3): minus the forces and moments on the blocks."""
		arm1, arm2, apart, n, depth, slip = self._joints(moved)
		along = _across(n)
		# forces at the two edges that do the work of the pressure, and the shear's, half at each: on the block behind
		pressure = self.stiffness * self.thickness * _edgeForces(depth)
		shear = -self.stiffness * self.thickness * slip / 2
		force = pressure[:, :, None] * n[:, None] + shear[:, None, None] * along[:, None]
		# the normal turns with half of both blocks
		turning = np.einsum('jek,jek->j', force, _across(apart)) / 2
		result = np.zeros((self.blocks + 2, 3))
		result[1:, :2] -= force.sum(axis=1)
		result[:-1, :2] += force.sum(axis=1)
		result[1:, 2] -= np.einsum('jek,jek->j', force, _across(arm2)) - turning
		result[:-1, 2] += np.einsum('jek,jek->j', force, _across(arm1)) + turning
		result[1:-1, 1] += load * self.weight
		return result[1:-1]

	def hessian(self, moved, load):
		step = 1e-2 * self.weight / self.stiffness  # a small part of what joints close by under one block
		flat = moved.ravel()
		columns = [
			(self.gradient((flat + d).reshape(moved.shape), load) - self.gradient((flat - d).reshape(moved.shape), load)).ravel()
			/ (2 * step)
			for d in np.eye(flat.size) * step
		]
		matrix = np.array(columns)
		return (matrix + matrix.T) / 2

	def stands(self, steps=12):
		"""Whether there is a stable equilibrium at every load up to the whole weight."""
		moved = np.zeros((self.blocks, 3))
		for load in np.linspace(0, 1, steps + 1)[1:]:
			moved = self._equilibrium(moved, load)
			if moved is None:
				return False
		return True

	def _equilibrium(self, moved, load, fallen=0.05):
		"""The minimum downhill from *moved*, by Newton's method with Levenberg's shift; None if there is none within *fallen*."""
		shift = 1e-6 * self.stiffness
		# of the forces; below are those of places' rounding
		unbalanced = 1e-7 * load * self.weight + 1e-14 * self.stiffness * self.thickness
		energy = self.energy(moved, load)
		for _ in range(300):
			residual = self.gradient(moved, load)
			values, vectors = np.linalg.eigh(self.hessian(moved, load))
			if np.abs(residual).max() < unbalanced and values[0] > 0:
				return moved
			for _ in range(60):
				way = -vectors @ ((vectors.T @ residual.ravel()) / (np.maximum(values, 0) + shift))
				tried = moved + way.reshape(moved.shape)
				closer = values[0] > 0 and np.abs(self.gradient(tried, load)).max() < np.abs(residual).max()
				if (closer or self.energy(tried, load) < energy) and np.abs(way).max() < 0.1 * fallen:
					break
				shift *= 4
			moved, energy, shift = tried, self.energy(tried, load), shift / 16
			if np.abs(moved).max() > fallen:
				return None
		return None


def _edgeForces(depth):
	"""∫⟨δ⟩(1 − s) and ∫⟨δ⟩ s over a joint of length 1 whose edges are *depth* (joints, 2) deep."""
	a, b = depth.T
	change = np.where(a == b, 1.0, b - a)
	zero = np.clip(-a / change, 0, 1)
	low, high = np.where((a > 0) | (a == b), 0, zero), np.where((b > 0) | (a == b), 1, zero)
	low, high = np.where((a <= 0) & (b <= 0), 0, low), np.where((a <= 0) & (b <= 0), 0, high)
	middle = (low + high) / 2

	def at(s):
		value = np.maximum(a + (b - a) * s, 0)
		return np.column_stack([value * (1 - s), value * s])

	return ((high - low) / 6)[:, None] * (at(low) + 4 * at(middle) + at(high))  # Simpson: exact for cubics


def _turned(vectors, angles):
	c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
	return np.stack([c * vectors[..., 0] - s * vectors[..., 1], s * vectors[..., 0] + c * vectors[..., 1]], axis=-1)


def _across(vectors):
	"""Turned by a right angle: what they change by when they turn."""
	return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def leastElasticThickness(blocks, stiffness, accuracy=1e-3):
	"""Least thickness over mean radius at which the arch of elastic joints stands; above that of limit analysis by stiffness^(−1/3).

	:param float stiffness: as in :yref:`ElasticArch`
	:param float accuracy: relative
	"""
	low = leastThickness(blocks, math.radians(89))
	high = 1.08 * low
	while not ElasticArch(high, blocks, stiffness).stands():
		low, high = high, 1.3 * high
		if high > 1:
			raise ValueError(f'stiffness: {stiffness:g} is so soft that no arch stands')
	while high - low > accuracy * high:
		middle = (low + high) / 2
		low, high = (low, middle) if ElasticArch(middle, blocks, stiffness).stands() else (middle, high)
	return (low + high) / 2
