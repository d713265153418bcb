# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that overlap, cut into bodies that touch: for members of a clump and pieces of a support, each of which has contacts of its own."""

import numpy as np
from yade import Vector3, _polytope

from ..scene.vertices import worldVertices
from .clumps import newParts
from .halfSpaces import worldPlanes
from .pieces import pieceOf

__all__ = ['withoutOverlap']

touching = 1e-6
"""Overlap over the smaller circumscribed radius up to which two bodies touch, and no piece is cut off."""


def withoutOverlap(bodies):
	"""Bodies that fill the same space and touch, without overlap: ``polytope.clump(polytope.withoutOverlap([polytope.cuboid(…), …]))``.

	Where members of a clump, or pieces of a fixed support, overlap with faces in one plane, each has a contact there, which together are
	twice as stiff as they ought to be. Of those that this function returns each has its own part of it.

	The first body is returned as it is. From each later one what lies in those before is cut away, by the planes of their faces; what is left is
	one convex body or several, each with the material, density, colour, mask and blocked degrees of freedom of the body that it was cut from, and moving
	with it. A body that lies wholly in one before it is left out.

	:param bodies: list of polyhedra, or of polygons in one plane and of one thickness, that are not in the scene yet
	:returns: list of bodies
	:raises ValueError: naming *bodies*
	"""
	bodies = newParts(bodies, 'bodies')
	made = []
	for number, one in enumerate(bodies):
		left = [one]
		for earlier in bodies[:number]:
			left = [piece for part in left for piece in _outside(part, earlier)]
		made += left
	return made


def _outside(part, other):
	"""What of a body lies outside of another one."""
	allowed = touching * float(min(one.shape.circumscribedRadius for one in (part, other)))
	if not float(_polytope.contact(part, other).infeasibility) < -allowed:
		return [part]
	pieces = []
	for normal, offset in zip(*worldPlanes(other), strict=True):
		beyond = worldVertices(part) @ normal - offset
		if beyond.max() <= allowed:
			continue
		own = offset - normal @ np.array(part.state.pos, float)
		pieces.append(pieceOf(part, [(Vector3(*-normal), -own)])[0])
		part = pieceOf(part, [(Vector3(*normal), own)])[0]
	return pieces
