# SPDX-License-Identifier: GPL-2.0-or-later
"""Names the type of a contact of two polytopes by the features that touch: vertex-face, edge-edge, face-face and so on.

Contact detection with half-spaces does not need it; this is for evaluating runs.
"""

import collections

import numpy as np
from yade import O, Polytope

from ..scene.vertices import rotationMatrix

__all__ = ['ContactTypes', 'typeOf', 'types2d', 'types3d']

types3d = ('vertex-vertex', 'vertex-edge', 'vertex-face', 'edge-edge', 'edge-face', 'face-face')
types2d = ('vertex-vertex', 'vertex-edge', 'edge-edge')
"""A polygon's edge is a face of the prism it stands for, its vertex an edge: edge-edge here is face-face there."""

_features = {3: ('face', 'edge', 'vertex'), 2: ('edge', 'vertex')}
_order = ('vertex', 'edge', 'face')

ownsFace = 1e-9
"""Distance, over the body's size, within which a vertex lies on a plane."""
independent = 1e-6
"""Sine of the angle below which normals count as parallel."""


def typeOf(feature1, feature2):
	"""Name of the contact of two features: typeOf('face', 'edge') is 'edge-face'."""
	return '-'.join(sorted((feature1, feature2), key=_order.index))


class ContactTypes:
	"""Names the types of contacts, by the faces of each body that lie near the contact point.

	A body takes part in a contact with the nearest of its faces to the contact point and all others within *tolerance* of it.
	Where their normals span a line that is a face, where they span a plane an edge, and where they span space a vertex (for
	polygons: an edge and a vertex). Planes that own no face do not count. With the tolerance at its default, the body's corner
	radius, these are the very planes whose normals make the contact normal (Eqs 13-17 of Boon et al. 2012): the type names
	the faces that the algorithm uses. Faces that overlap on a strip narrower than about two tolerances count as edges or vertices.

	:param float tolerance: [m]; default the corner radius of each body
	:raises ValueError: for a tolerance that is negative or not finite
	"""

	def __init__(self, tolerance=None):
		if tolerance is not None and not 0 <= tolerance < float('inf'):
			raise ValueError(f'tolerance: must be a length, at least 0 and finite, got {tolerance}')
		self.tolerance = tolerance
		self._planes = {}

	def of(self, contact):
		"""The contact's type, the lower feature first: one of `types3d`, or of `types2d` for polygons.

		:param contact: a real Interaction of two bodies with the shape Polytope
		:raises ValueError: for a body of another shape
		"""
		point = np.array(contact.geom.contactPoint, float)
		shift = O.cell.hSize * contact.cellDist if O.periodic else (0, 0, 0)
		features = self.feature(O.bodies[contact.id1], point), self.feature(O.bodies[contact.id2], point - np.array(shift, float))
		return typeOf(*features)

	def feature(self, body, point):
		"""The feature of *body* at *point* (world coordinates): 'face', 'edge' or 'vertex'."""
		turn = rotationMatrix(body.state.ori)[None]
		return self.features(body, [point], [body.state.pos], turn)[0]

	def features(self, body, points, positions, turns):
		"""Features of *body* at many points, with as many poses of the body.

		:param points: (n, 3) in world coordinates
		:param positions: (n, 3) of the body's centre
		:param turns: (n, 3, 3) its orientation as a matrix
		:returns: list of n words
		"""
		if body.id not in self._planes or body.id < 0:
			self._planes[body.id] = _facePlanes(body.shape)
		normals, offsets, dimension, cornerRadius = self._planes[body.id]
		local = np.einsum('nji,nj->ni', turns, np.array(points, float) - np.array(positions, float))
		slack = offsets - local @ normals.T
		tolerance = cornerRadius if self.tolerance is None else self.tolerance
		near, which = np.unique(slack <= np.maximum(tolerance, slack.min(axis=1, keepdims=True)), axis=0, return_inverse=True)
		names = [_features[dimension][_rank(normals[row]) - 1] for row in near]
		return [names[k] for k in which.ravel()]

	def count(self):
		"""Number of real contacts of each type, as a Counter."""
		return collections.Counter(self.of(contact) for contact in O.interactions if contact.isReal)


def _rank(normals):
	return 1 if len(normals) == 1 else int(np.sum(np.linalg.svd(normals, compute_uv=False) > independent))


def _facePlanes(shape):
	"""Normals and offsets of the planes that own a face, dimension, corner radius; in the body's frame."""
	if not isinstance(shape, Polytope):
		raise ValueError(f'contact: both bodies must have the shape Polytope, one is {type(shape).__name__}')
	normals, offsets = np.array(shape.normals, float).reshape(-1, 3), np.array(shape.offsets, float)
	vertices = np.array(shape.vertices, float).reshape(-1, 3)
	if shape.dimension == 2:
		vertices = vertices[vertices[:, 2] > 0]  # those of one end of the prism
	on = np.abs(vertices @ normals.T - offsets) <= ownsFace * np.abs(vertices).max()
	face = on.sum(axis=0) >= shape.dimension
	return normals[face], offsets[face], shape.dimension, shape.cornerRadius
