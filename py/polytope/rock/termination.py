# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints that end at others which they meet (T-terminations)."""

import numpy as np

__all__ = ['Earlier']

parallel = 1e-9
"""Sine of the angle between two joints below which they do not meet."""


class Earlier:
	"""Joints that were there before."""

	def __init__(self, cuts):
		self.cuts = list(cuts)
		self.normals = np.array([cut.normal for cut in cuts]).reshape(-1, 3)
		self.offsets = np.array([cut.offset for cut in cuts])
		self.centres = np.array([cut.centre for cut in cuts]).reshape(-1, 3)
		self.radii = np.array([cut.radius or np.inf for cut in cuts])

	def end(self, cut, probability, random):
		"""Gives a disc an edge at each joint that it meets, with this probability. If a disc crosses one, the side with its centre is left."""
		if not self.cuts:
			return
		ends = [k for k in self._met(cut) if random.random() < probability]
		planes = np.column_stack([self.normals[ends], self.offsets[ends]])
		beyond = planes[:, :3] @ cut.centre > planes[:, 3]
		planes[beyond] *= -1
		cut.edges = np.concatenate([cut.edges, planes])

	def _met(self, cut):
		"""Numbers of the joints that have a stretch of line in common with the disc."""
		along = np.cross(self.normals, cut.normal)
		sines = np.linalg.norm(along, axis=1)
		heights = self.offsets - self.normals @ cut.centre
		near = np.flatnonzero((sines > parallel) & (np.abs(heights) < cut.radius * sines))
		along = along[near] / sines[near, None]
		# foot of the disc's centre on the common line, within the disc's plane
		down = self.normals[near] - (self.normals[near] @ cut.normal)[:, None] * cut.normal
		feet = cut.centre + heights[near, None] * down / sines[near, None] ** 2
		low, high = _within(feet, along, cut.centre[None], np.full(len(near), cut.radius))
		lower, upper = _within(feet, along, self.centres[near], self.radii[near])
		low, high = np.maximum(low, lower), np.minimum(high, upper)
		return [int(k) for i, k in enumerate(near) if _stretch(low[i], high[i], feet[i], along[i], self.cuts[k].edges)]


def _within(feet, along, centres, radii):
	"""Where lines enter and leave balls, as distances from their feet; leave < enter: never."""
	middle = np.einsum('ij,ij->i', centres - feet, along)
	away = np.linalg.norm(centres - feet - middle[:, None] * along, axis=1)
	half = np.where(away < radii, np.sqrt(np.maximum(radii**2 - away**2, 0)), -1)
	return middle - half, middle + half


def _stretch(low, high, foot, along, edges):
	"""Whether anything is left of it inside the edges."""
	for edge in edges:
		slope, rest = edge[:3] @ along, edge[3] - edge[:3] @ foot
		if slope > 0:
			high = min(high, rest / slope)
		elif slope < 0:
			low = max(low, rest / slope)
		elif rest < 0:
			return False
	return low < high
