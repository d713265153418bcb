# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of a body between planes, as bodies of their own that move with it."""

import numpy as np
from yade import Quaternion, Vector3, _polytope

from ..arguments import vectors
from ..scene.vertices import rows
from .polytopes import defaultCornerFraction, isotropyTolerance

__all__ = ['pieceOf']

samePlane = 1e-6
"""How far rounding may move a plane of a piece, as a part of the body's size, or turn it [rad], also far from the origin. A cut that is
parallel to a face is farther from it, by the least piece that is cut off."""


def pieceOf(body, cuts):
	"""The part of a body below planes, as a body that moves with it and has its density, material, colour, mask and blocked degrees of
	freedom. What is left of a face keeps the material that it has of its own (Polytope.faceMaterials).

	:param cuts: (normal, offset) of planes, from the body's centre, world axes
	:returns: the new body, and for each of its planes which of the body's it lies on, −1: a cut
	:raises ValueError: if nothing is below them
	"""
	shape, state = body.shape, body.state
	normals, offsets = [state.ori * one for one in shape.normals], list(shape.offsets)
	between = [*normals, *(normal for normal, _ in cuts)], [*offsets, *(offset for _, offset in cuts)]
	central = _polytope.ofHalfSpaces(
		vectors(between[0], 'normals', 3), between[1], shape.dimension, shape.thickness, False, None, defaultCornerFraction
	)
	piece = _polytope.body(central, body.material, None, Quaternion.Identity, False, isotropyTolerance, shape.color)
	own, density = piece.state, state.mass / shape.volume  # which may not be the material's
	arm = Vector3(own.pos)
	own.pos = own.refPos = state.pos + arm
	own.mass, own.inertia = density * piece.shape.volume, density * piece.shape.inertia
	own.vel, own.angVel = state.vel + state.angVel.cross(arm), state.angVel
	spin = own.ori.conjugate() * state.angVel
	own.angMom = own.ori * Vector3(*(moment * rate for moment, rate in zip(own.inertia, spin, strict=True)))
	own.blockedDOFs = state.blockedDOFs
	piece.shape.wire, piece.mask = shape.wire, body.mask
	planes = _formerPlanes(piece, body, normals, offsets)
	if len(shape.faceMaterials):
		piece.shape.faceMaterials = [int(k) for k in np.append(shape.faceMaterials, -1)[planes]]
	return piece, planes


def _formerPlanes(piece, body, normals, offsets):
	"""For each plane of a piece which of the body's it lies on; −1: a cut. The body's from its centre, world axes."""
	turned = rows(piece.state.ori * one for one in piece.shape.normals)
	limits = np.array(piece.shape.offsets, float) + turned @ np.array(piece.state.pos - body.state.pos, float)
	reach = float(body.shape.circumscribedRadius)
	apart = np.linalg.norm(turned[:, None] - rows(normals), axis=2) + np.abs(limits[:, None] - np.array(offsets, float)) / reach
	return np.where(apart.min(axis=1) < samePlane, apart.argmin(axis=1), -1)
