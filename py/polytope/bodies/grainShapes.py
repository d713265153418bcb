# SPDX-License-Identifier: GPL-2.0-or-later
"""Shapes of grains whose intermediate extent is 1: random ones, and those of given bodies, as grains() makes them larger or smaller."""

import dataclasses

import numpy as np
import scipy  # loads its packages at their first use: half a second
from yade import Body, Polytope, Quaternion

from ..scene.vertices import localVertices, rotationMatrix
from .clumps import union
from .polytopes import fromVertices, ofOneColour

__all__ = ['GrainShape', 'cornersOf', 'partsOfLoose', 'pointsOnAnEllipsoid', 'shapesOf', 'turnOf']

candidates = 10
"""Random points tried for each vertex: the one farthest from those that there are is taken (Mitchell's best candidate), so that vertices
are spread."""


@dataclasses.dataclass(frozen=True)
class GrainShape:
	parts: list
	"""points (k, 3) of each convex part, about the centre"""
	volume: float
	"""of all parts together"""

	def bodies(self, size, turn, body):
		"""A body of each part, as large as this and turned.

		:param dict body: arguments of fromVertices
		"""
		if len(self.parts) == 1:
			return [fromVertices((size * self.parts[0]).tolist(), orientation=turn, center=(0, 0, 0), **body)]
		matrix = rotationMatrix(turn)
		pieces = ofOneColour(body)
		return [fromVertices((size * points @ matrix.T).tolist(), **pieces) for points in self.parts]


def pointsOnAnEllipsoid(random, vertices, elongation, flatness):
	"""Vertices of a grain of size 1."""
	fresh = random.normal(size=(vertices, candidates, 3))
	fresh /= np.sqrt(np.einsum('ijk,ijk->ij', fresh, fresh))[:, :, None]
	found = fresh[:, 0].copy()
	for k in range(1, vertices):
		found[k] = fresh[k, (fresh[k] @ found[:k].T).max(axis=1).argmin()]
	low, high = found.min(axis=0), found.max(axis=0)
	return (found - (low + high) / 2) / (high - low) * (1 / elongation, 1, flatness)


def shapesOf(shapes, random, draw):
	"""A function that gives the shape of the next grain: one of the given, at random, or of those that draw() gives, as points."""
	if shapes is None:
		return lambda: _random(draw())
	try:
		given = [partsOfLoose(one) for one in shapes]
	except TypeError:
		given = []
	if not given or not all(
		isinstance(part, Body) and isinstance(part.shape, Polytope) and part.shape.dimension == 3 for parts in given for part in parts
	):
		raise ValueError('shapes: must be a list of polyhedra, or of lists of the parts of one, as polytope.fromMesh makes')
	scaled = [_scaled(parts) for parts in given]
	return lambda: scaled[random.integers(len(scaled))]


def _random(points):
	return GrainShape([points], float(scipy.spatial.ConvexHull(points).volume))


def _scaled(parts):
	"""The shape of a body, whose intermediate extent along its principal axes becomes 1."""
	mass, centre, tensor = union(parts)
	axes = np.linalg.eigh(tensor)[1]
	if np.linalg.det(axes) < 0:  # a grain is no mirror image
		axes[:, 0] *= -1
	points = [(np.array(part.state.pos, float) - centre + cornersOf(part)) @ axes for part in parts]
	size = float(np.sort(np.ptp(np.concatenate(points), axis=0))[1])
	return GrainShape([some / size for some in points], mass / float(parts[0].material.density) / size**3)


def partsOfLoose(one):
	"""Bodies of an entry of a list of bodies that are not in the scene: parts of a clump, or the body itself."""
	return list(one) if isinstance(one, (list, tuple)) and one else [one]


def cornersOf(body):
	"""Relative to its centre, in world axes."""
	return localVertices(body.shape) @ rotationMatrix(body.state.ori).T


def turnOf(random):
	"""Uniform over all rotations."""
	w, x, y, z = random.normal(size=4).tolist()
	return Quaternion(w, x, y, z).normalized()
