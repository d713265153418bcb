# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that are not convex, as clumps of convex parts that may overlap: `polytope.clump(…)`. Mass and inertia are those of the union."""

import numpy as np
from yade import Body, Matrix3, O, Polytope, Quaternion, Vector3, _polytope

from .arguments import vectors
from .bodies import defaultCornerFraction, isotropyTolerance

__all__ = ['clump', 'union']


def clump(parts):
	"""Adds convex bodies to the scene as one rigid body, a clump: ``number, members = polytope.clump([polytope.cuboid(…), …])``.

	The parts may touch and overlap. Mass, centre of mass and inertia are those of their union, where overlaps count once, with the density
	of the part that comes first; O.bodies.appendClumped counts them for each part. There are no contacts between parts, and bodies slide
	over faces that two parts share as over one. It moves as the first part does, and is fixed if that is.

	O.bodies.updateClumpProperties and addToClump make YADE's sums of them again.

	:param parts: list of polyhedra that are not in the scene yet
	:returns: (number of the clump, numbers of its parts), as O.bodies.appendClumped does
	:raises ValueError: naming *parts*
	"""
	parts = list(parts)
	if not parts or not all(isinstance(part, Body) and isinstance(part.shape, Polytope) and part.shape.dimension == 3 for part in parts):
		raise ValueError('parts: must be a list of polyhedra, as polytope.cuboid and other builders make')
	if any(part.id >= 0 for part in parts):
		raise ValueError(
			'parts: must not be in the scene yet; O.bodies.clump makes clumps of bodies that are, with the sum of their masses'
		)
	mass, centre, tensor = union(parts)
	first = parts[0].state
	velocity = first.vel + first.angVel.cross(Vector3(*centre) - first.pos)
	spin, blocked = Vector3(first.angVel), first.blockedDOFs
	number, members = O.bodies.appendClumped(parts)
	moments, axes = np.linalg.eigh(tensor)
	if np.linalg.det(axes) < 0:
		axes[:, 0] *= -1
	_polytope.setClump(O.bodies[number], mass, Vector3(*moments), Vector3(*centre), _quaternion(axes), isotropyTolerance)
	state = O.bodies[number].state
	state.vel, state.angVel, state.blockedDOFs = velocity, spin, blocked
	state.angMom = Vector3(*(tensor @ np.array(spin, float)))
	return number, members


def union(parts):
	"""(mass, centre of mass, tensor of inertia about it) of what polyhedra fill together, by cutting it into disjoint convex pieces."""
	planes, boxes = [_planes(part) for part in parts], [_box(part) for part in parts]
	pieces = []
	for k, part in enumerate(parts):
		rest = [part.state]
		if any(_meet(boxes[k], boxes[j]) for j in range(k)):
			left = [planes[k]]
			for j in range(k):
				if _meet(boxes[k], boxes[j]):
					left = [outside for piece in left for outside in _outside(piece, planes[j], part)]
			rest = [_piece(one, part) for one in left]
		pieces += rest
	mass = sum(float(piece.mass) for piece in pieces)
	centre = sum(float(piece.mass) * np.array(piece.pos, float) for piece in pieces) / mass
	tensor = np.zeros((3, 3))
	for piece in pieces:
		turn, arm = np.array(piece.ori.toRotationMatrix(), float).reshape(3, 3), np.array(piece.pos, float) - centre
		own = turn @ np.diag([float(moment) for moment in piece.inertia]) @ turn.T
		tensor += own + float(piece.mass) * (arm @ arm * np.eye(3) - np.outer(arm, arm))
	return mass, centre, tensor


def _planes(part):
	"""Normals and offsets of a body, world axes."""
	normals = [part.state.ori * normal for normal in part.shape.normals]
	return normals, [offset + normal.dot(part.state.pos) for normal, offset in zip(normals, part.shape.offsets, strict=True)]


def _box(part):
	corners = np.array([part.state.pos + part.state.ori * vertex for vertex in part.shape.vertices], float)
	return corners.min(axis=0), corners.max(axis=0)


def _meet(one, other):
	return (one[0] < other[1]).all() and (other[0] < one[1]).all()


def _outside(piece, cutter, part):
	"""What is left of a convex piece outside of another one, as disjoint convex pieces."""
	normals, offsets = piece
	if _piece((normals + cutter[0], offsets + cutter[1]), part) is None:
		return [piece]
	left = []
	for normal, offset in zip(*cutter, strict=True):
		beyond = normals + [-normal], offsets + [-offset]
		if _piece(beyond, part) is not None:
			left.append(beyond)
		normals, offsets = normals + [normal], offsets + [offset]
	return left


def _piece(planes, part):
	"""State of the polyhedron between planes, of the part's density; None where there is none, or a flat one."""
	normals, offsets = planes
	origin = part.state.pos  # numbers are small about it
	about = [offset - normal.dot(origin) for normal, offset in zip(normals, offsets, strict=True)]
	try:
		shape = _polytope.ofHalfSpaces(vectors(normals, 'normals', 3), about, 3, 1, False, None, defaultCornerFraction)
	except ValueError:
		return None
	state = _polytope.body(shape, part.material, origin + shape.position, Quaternion.Identity, False, isotropyTolerance, None).state
	density = part.state.mass / part.shape.volume / part.material.density  # of the body, which need not be the material's
	state.mass, state.inertia = density * state.mass, density * state.inertia
	return state


def _quaternion(axes):
	"""Of the rotation whose matrix has these columns."""
	return Quaternion(Matrix3(*axes.flatten().tolist())).normalized()
