# SPDX-License-Identifier: GPL-2.0-or-later
"""Breakage of a grain along a plane: `polytope.split(…)` (docs/bonds.md)."""

import numbers

from yade import O, Polytope

from ..arguments import namedArguments, number, vector
from ..bodies.pieces import pieceOf
from ..bonding.bonds import madeBonds
from ..loading.sample import replaceInSamples
from ..rock.jointsOfFaces import replaceInRocks
from ..scene.ranks import refuseDivided

__all__ = ['split']

thinnest = 1e-3
"""Least inscribed radius of a piece, over that of the body: a sliver of less has contacts that differ in stiffness by its size, and moves by
rounding rather than by forces."""


@namedArguments
def split(id, normal, point=None, smallest=None):
	"""Breaks a body in two along a plane: ``below, above = polytope.split(7, normal=(0, 0, 1))``. The body is erased, the two pieces are new bodies.

	The pieces fill the body, touch without overlap, and move as it did: mass, centre of mass, linear and angular momentum and kinetic energy
	are what they were, to rounding. They overlap other bodies as it did: no energy of an overlap is added. Contacts of the body begin anew on the
	pieces, without shear force. Material, colour, mask and blocked degrees of freedom are the body's; a permanent force is not passed on. What
	is left of a face keeps the material and the joint that it has of its own (Polytope.faceMaterials, *JointedRock.jointsOfFaces*); the fresh faces have none.

	:param int id: of a body with a Polytope shape that is in no clump and has no bonds
	:param Vector3 normal: of the plane, of any length, world axes
	:param Vector3 point: in the plane [m]; default the body's centroid
	:param float smallest: least inscribed radius of a piece [m]; default a thousandth of the body's
	:returns: (id of the piece below the plane, id of the one on the side to which the normal points)
	:raises ValueError: naming the argument and the remedy; then nothing is changed
	:raises RuntimeError: the scene is divided on several processes (docs/mpi.md)
	"""
	body = _bodyOf(id)
	normal, state, shape = vector(normal, 'normal'), body.state, body.shape
	if not normal.norm() > 0:
		raise ValueError('normal: must not be zero')
	if shape.dimension == 2 and normal[2] != 0:
		raise ValueError(f'normal: a polygon is cut along a line of its plane; the third component must be 0, got {tuple(normal)}')
	normal.normalize()
	height = 0 if point is None else normal.dot(vector(point, 'point') - state.pos)
	least = thinnest * shape.inscribedRadius if smallest is None else number(smallest, 'smallest')
	if not 0 <= least < float('inf'):
		raise ValueError(f'smallest: must be a length, at least 0 [m], got {smallest!r}')
	refuseDivided()
	pieces, planes = zip(*(_piece(body, side * normal, side * height, least) for side in (1, -1)), strict=True)
	made = tuple(O.bodies.append(piece) for piece in pieces)
	replaceInSamples(body.id, made)
	replaceInRocks(body, [O.bodies[k] for k in made], planes)
	O.bodies.erase(body.id)
	return made


def _bodyOf(id):
	if isinstance(id, bool) or not isinstance(id, numbers.Integral) or not 0 <= id < len(O.bodies) or O.bodies[id] is None:
		raise ValueError(f'id: there is no body {id!r}')
	body = O.bodies[id]
	if not isinstance(body.shape, Polytope):
		raise ValueError(
			f'id: body {id} has no Polytope shape ({type(body.shape).__name__}); make it with polytope.cuboid or another builder'
		)
	if body.isClumpMember:
		raise ValueError(f'id: body {id} is a member of clump {body.clumpId}; O.bodies.releaseFromClump it first')
	if any(bond.intact and id in (bond.id1, bond.id2) for bond in madeBonds()):
		raise ValueError(
			f'id: body {id} has bonds, of which it is not known on which piece they would be; break bonded bodies by their bonds'
		)
	return body


def _piece(body, normal, offset, least):
	"""Below a plane, from the body's centre, world axes; and its planes as *pieceOf* has them."""
	try:
		piece, planes = pieceOf(body, [(normal, offset)])
	except ValueError as error:
		raise ValueError(f'point: the plane does not cut body {body.id} in two ({error}); choose a point inside it') from None
	if not piece.shape.inscribedRadius >= least:
		raise ValueError(
			f'point: the plane cuts off a piece of inscribed radius {piece.shape.inscribedRadius:.3g} m, below smallest = {least:.3g} m; move it inwards'
		)
	return piece, planes
