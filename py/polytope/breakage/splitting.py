# SPDX-License-Identifier: GPL-2.0-or-later
"""Breakage of a grain along a plane: `polytope.split(…)` (docs/bonds.md)."""

import numbers

from yade import O, Polytope

from ..arguments import namedArguments, number, vector
from ..bodies.pieces import pieceOf
from ..bonding.bonds import intactBonds
from ..loading.sample import replaceInSamples
from ..rock.jointsOfFaces import replaceInRocks
from ..rock.stress.cutting import Part, together
from ..rock.stress.takingOver import takeOver
from ..scene.movers import partsOf
from ..scene.ranks import refuseDivided

__all__ = ['split', 'splitAnew']

thinnest = 1e-3
"""Least inscribed radius of a piece, over that of the body: a sliver of less has contacts that differ in stiffness by its size, and moves by
rounding rather than by forces."""


@namedArguments
def split(id, normal, point=None, smallest=None):
	"""Breaks a body in two along a plane: ``below, above = polytope.split(7, normal=(0, 0, 1))``. The body is erased, the two pieces are new bodies.

	The pieces fill the body, touch without overlap, and move as it did: mass, centre of mass, linear and angular momentum and kinetic energy
	are what they were, to rounding. They overlap other bodies as it did: no energy of an overlap is added. Material, colour, mask and
	blocked degrees of freedom are the body's; a permanent force is not passed on. What is left of a face keeps the material and the joint
	that it has of its own (Polytope.faceMaterials, *JointedRock.jointsOfFaces*); the fresh faces have none.

	Rock joints with a stiffness per area go on, as with *polytope.excavate*: each piece has its share of the face, with shear, slip and
	cohesion; so do bonds. Other contacts begin anew on the pieces, without shear force, and so do all in a periodic cell.

	A clump is cut part by part. What lies on one side is one body, a clump where it has several parts, or several bodies where it falls
	apart. Of a part no piece below *smallest* is cut off.

	:param int id: of a body with a Polytope shape that is in no clump, or of a clump of such
	:param Vector3 normal: of the plane, of any length, world axes
	:param Vector3 point: in the plane [m]; default the body's centroid
	:param float smallest: least inscribed radius of a piece [m]; default a thousandth of the body's, of a clump of the part's
	:returns: (id of the piece below the plane, id of the one on the side to which the normal points); of a clump that falls apart on a side
	    a tuple of ids for that side
	:raises ValueError: naming the argument and the remedy; then nothing is changed
	:raises RuntimeError: the scene is divided on several processes (docs/mpi.md)
	"""
	k = _idOf(id)
	pieces = _pieces(k, normal, point, smallest)
	sides = [together([[piece] for piece in side]) if O.bodies[k].isClump else [side] for side in pieces]
	made = takeOver({k: [*sides[0], *sides[1]]}, replaceInSamples)[k]
	below, above = made[: len(sides[0])], made[len(sides[0]) :]
	return tuple(side[0] if len(side) == 1 else tuple(side) for side in (below, above))


def splitAnew(k, normal, point, smallest):
	"""A body that is no clump and has no bonds, into (id below, id above) whose contacts all begin anew: nothing is looked for, so that
	many may break in a step."""
	pieces = [side[0] for side in _pieces(k, normal, point, smallest)]
	former, made = O.bodies[k], tuple(O.bodies.append(piece.body) for piece in pieces)
	replaceInSamples(k, made)
	replaceInRocks(former, [piece.body for piece in pieces], [piece.planes for piece in pieces])
	O.bodies.erase(k)
	return made


def _pieces(k, normal, point, smallest):
	"""Below and above the plane: a list of *Part* each."""
	body, normal = O.bodies[k], vector(normal, 'normal')
	parts = [O.bodies[part] for part in partsOf(k)]
	if not normal.norm() > 0:
		raise ValueError('normal: must not be zero')
	if parts[0].shape.dimension == 2 and normal[2] != 0:
		raise ValueError(f'normal: a polygon is cut along a line of its plane; the third component must be 0, got {tuple(normal)}')
	normal.normalize()
	given = None if smallest is None else number(smallest, 'smallest')
	if given is not None and not 0 <= given < float('inf'):
		raise ValueError(f'smallest: must be a length, at least 0 [m], got {smallest!r}')
	refuseDivided()
	through = body.state.pos if point is None else vector(point, 'point')
	sides = [], []
	for part in parts:
		least, height = thinnest * part.shape.inscribedRadius if given is None else given, normal.dot(through - part.state.pos)
		try:
			pieces = [_piece(part, sign * normal, sign * height, least) for sign in (1, -1)]
		except ValueError:
			if not body.isClump:
				raise
			sides[int(height < 0)].append(Part(part.id, *pieceOf(part, [])))
		else:
			for side, piece in zip(sides, pieces, strict=True):
				side.append(Part(part.id, *piece))
	for piece in (*sides[0], *sides[1]):
		piece.body.state.blockedDOFs = body.state.blockedDOFs  # a clump's are not those of its parts
	if not all(sides):
		raise ValueError(f'point: the plane does not cut clump {k} in two; choose a point inside it')
	return sides


def _idOf(id):
	if isinstance(id, bool) or not isinstance(id, numbers.Integral) or not 0 <= id < len(O.bodies) or O.bodies[id] is None:
		raise ValueError(f'id: there is no body {id!r}')
	k = int(id)
	parts = partsOf(k)
	for part in parts:
		if not isinstance(O.bodies[part].shape, Polytope):
			raise ValueError(
				f'id: body {part} has no Polytope shape ({type(O.bodies[part].shape).__name__}); make it with polytope.cuboid or another builder'
			)
	if O.bodies[k].isClumpMember:
		raise ValueError(f'id: body {k} is a member of clump {O.bodies[k].clumpId}; split that, or O.bodies.releaseFromClump it first')
	if O.periodic and any({bond.id1, bond.id2} & set(parts) for bond in intactBonds()):
		raise ValueError(f'id: body {k} has bonds, which are not passed on in a periodic cell; break bonded bodies by their bonds')
	return k


def _piece(body, normal, offset, least):
	"""The piece of a body below a plane, which is given from the body's centre in world axes; and its planes as *pieceOf* has them."""
	try:
		piece, planes = pieceOf(body, [(normal, offset)])
	except ValueError as error:
		raise ValueError(f'point: the plane does not cut body {body.id} in two ({error}); choose a point inside it') from None
	if not piece.shape.inscribedRadius >= least:
		raise ValueError(
			f'point: the plane cuts off a piece of inscribed radius {piece.shape.inscribedRadius:.3g} m, below smallest = {least:.3g} m; move it inwards'
		)
	return piece, planes
