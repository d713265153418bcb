# SPDX-License-Identifier: GPL-2.0-or-later
"""Faces that neighbours have in common in the scene: where joints are, before there is a contact."""

import dataclasses

import numpy as np
from yade import O, RockJointPhys

from ..bodies.halfSpaces import worldPlanes
from ..bonding.bonds import facingFaces, presentBonds
from ..scene.vertices import rotationMatrix, rows
from .faceMaterials import materialOfPlane

__all__ = ['CommonFace', 'boundFaces', 'commonFaces', 'contactOf', 'lesser', 'materialOf', 'materialsOfSides', 'planeOf']

samePlane = 1e-4
"""1 − cosine of the angle within which a plane of a body is that of its joint: that between faces which *polytope.bond* joins."""


@dataclasses.dataclass
class CommonFace:
	id1: int
	id2: int
	normal: np.ndarray
	"""Normal, from body 1 to body 2."""
	centroid: np.ndarray
	area: float
	"""[m²]"""
	corners: np.ndarray
	"""(n, 3) in the world [m]"""
	second: np.ndarray
	"""(3, 3) ∫ r ⊗ r over the area, r from the centroid [m⁴]; zero of a polygon, whose line does not turn in its plane."""
	overlap: float
	"""Depth by which the faces overlap already [m]"""


def commonFaces(chosen=None):
	"""The common faces of pairs of bodies of which one is chosen and one can move. The bodies touch, or overlap.

	:param chosen: set of ids; default all
	"""
	return [_face(one) for one in facingFaces() if chosen is None or one.id1 in chosen or one.id2 in chosen]


def boundFaces():
	"""The faces of intact bonds, and of intact joints that act as bonds: also where tension has parted them farther than *commonFaces* looks."""
	joints = [one.phys.bond for one in O.interactions if one.isReal and isinstance(one.phys, RockJointPhys) and one.phys.intact]
	return [_face(bond) for bond in [*presentBonds(), *joints] if bond is not None]


def _face(found):
	body = O.bodies[found.id1]
	axes = rotationMatrix(body.state.ori * found.frame1)
	centroid = np.array(body.state.pos + body.state.ori * found.point1, float)
	second = np.zeros((3, 3))
	if body.shape.dimension == 3:
		second = sum(float(moment) * np.outer(axis, axis) for moment, axis in zip(found.secondMoments, axes.T[1:], strict=True))
	return CommonFace(
		found.id1, found.id2, axes[:, 0], centroid, float(found.area), centroid + rows(found.corners) @ axes.T, second, float(found.overlap)
	)


def contactOf(face):
	"""The contact of its two bodies; None where there is none."""
	if not O.interactions.has(face.id1, face.id2, onlyReal=True):
		return None
	return O.interactions[face.id1, face.id2]


def planeOf(face, k):
	"""Index of the plane of body k that has the face; −1 if none does."""
	side = 1 if k == face.id1 else -1
	normals, offsets = worldPlanes(O.bodies[k])
	away = np.abs(normals @ face.centroid - offsets)
	away[1 - side * normals @ face.normal > samePlane] = np.inf  # of those that are parallel one has the face
	plane = int(np.argmin(away))
	return plane if np.isfinite(away[plane]) else -1


def materialOf(face, k):
	"""Material on body k's side of the joint: that of its face, if the face has one of its own (*Polytope.faceMaterials*)."""
	body = O.bodies[k]
	return materialOfPlane(body, planeOf(face, k) if len(getattr(body.shape, 'faceMaterials', [])) else -1)


def materialsOfSides(face):
	"""Materials on both sides of the joint, that of body 1 first."""
	return [materialOf(face, k) for k in (face.id1, face.id2)]


def lesser(name, materials):
	"""The least value of an attribute: of strengths, the one that counts in a joint between these materials."""
	return min(getattr(material, name) for material in materials)
