# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks in the size that they have without load, so that their joints are closed by the stress where the blocks are.

A joint under the pressure p is closed by p/kₙ; half of that belongs to either side if they are of one material, else to each side the part
of its own stiffness. Each plane of a block that is part of a joint moves outwards by its part, p/(2 kₙ), and turns where p changes along
it. So neighbours overlap by what gives the pressure at each place of the joint (contact model *foundation*), wherever joints meet and
whatever their directions are.
"""

import numpy as np
from yade import O, Quaternion, _polytope

from ...arguments import vectors
from ...bodies.halfSpaces import worldPlanes
from ...bodies.polytopes import isotropyTolerance
from ...scene.vertices import rotationMatrix, rows
from ..commonFaces import materialOf, planeOf
from .supports import inLine

__all__ = ['closures', 'enlarge', 'restore']


def closures(faces, field):
	"""How each body's planes move: id → {plane: (n, g) with the outward way [m] at the world's x being n + g·x}."""
	moved = {}
	for face in faces:
		for k in (face.id1, face.id2):
			plane = planeOf(face, k)
			if plane >= 0:
				moved[k, plane] = materialOf(face, k)
	found = {}
	for (k, plane), material in inLine(moved).items():
		normals, _ = worldPlanes(O.bodies[k])
		found.setdefault(k, {})[plane] = _closure(normals[plane], field, 2 * float(material.normalStiffness))
	return found


def _closure(normal, field, stiffness):
	at = -normal @ field.origin @ normal / stiffness
	slope = -np.einsum('i,kij,j->k', normal, field.slope, normal) / stiffness
	return at, slope


def enlarge(bodies):
	"""Gives bodies such planes.

	:param bodies: what *closures* returned
	:returns: what *restore* takes
	"""
	before = []
	try:
		for k, planes in bodies.items():
			before.append(_stateOf(O.bodies[k]))
			_enlargeOne(O.bodies[k], planes)
		_followParts(bodies)
	except Exception:
		restore(before)
		raise
	return before


def _enlargeOne(body, planes):
	state, old = body.state, body.shape
	turn = rotationMatrix(state.ori)
	place = np.array(state.pos, float)
	normals, offsets = rows(old.normals), np.array(old.offsets, float)  # in the body's axes
	for plane, (at, slope) in planes.items():
		across = turn.T @ slope
		across -= normals[plane] @ across * normals[plane]
		foot = place + turn @ (offsets[plane] * normals[plane])  # the plane's point nearest to the centre
		offsets[plane] += at + slope @ foot
		normals[plane] -= across
	made = _polytope.ofHalfSpaces(
		vectors(normals, 'normals', 3), offsets.tolist(), old.dimension, old.thickness, True, old.cornerRadius, 0.1
	)
	new = _polytope.body(made, body.material, None, Quaternion.Identity, False, isotropyTolerance, old.color)
	shape, density = new.shape, state.mass / old.volume
	shape.wire, shape.highlight, shape.faceMaterials = old.wire, old.highlight, old.faceMaterials
	# it weighs what it weighed: the size without load is the same rock
	state.inertia = density * old.volume / shape.volume * shape.inertia
	shift, turned = state.ori * new.state.pos, new.state.ori
	state.pos, state.refPos = state.pos + shift, state.refPos + shift
	state.ori, state.refOri = state.ori * turned, state.refOri * turned
	body.shape, body.aspherical = shape, new.aspherical


ofState = 'pos', 'ori', 'refPos', 'refOri', 'inertia'


def _stateOf(body):
	return body, body.shape, body.aspherical, [getattr(body.state, name) for name in ofState]


def restore(before):
	"""Shapes and places as they were."""
	for body, shape, aspherical, values in before:
		body.shape, body.aspherical = shape, aspherical
		for name, value in zip(ofState, values, strict=True):
			setattr(body.state, name, value)
	_followParts(body.id for body, *_ in before)


def _followParts(bodies):
	"""Clumps know where their parts are."""
	for k in {O.bodies[k].clumpId for k in bodies if O.bodies[k].isClumpMember}:
		clump = O.bodies[k]
		state = clump.state
		reference = state.refPos, state.refOri
		_polytope.setClump(clump, state.mass, state.inertia, state.pos, state.ori, isotropyTolerance)
		state.refPos, state.refOri = reference
