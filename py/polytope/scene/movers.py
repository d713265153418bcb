# SPDX-License-Identifier: GPL-2.0-or-later
"""What moves with what: a clump moves as one, its members with it; what is fixed does not move."""

from yade import O

__all__ = ['canMove', 'cannotTurn', 'isMover', 'moverOf', 'movers', 'partsOf', 'sameClump']


def partsOf(k):
	"""Ids of a clump's members; for another body its own."""
	body = O.bodies[k]
	return list(body.shape.members) if body.isClump else [k]


def moverOf(k):
	"""The body itself, or the clump that it is a member of."""
	return O.bodies[k].clumpId if O.bodies[k].isClumpMember else k


def isMover(body):
	"""Whether forces move it by itself: a clump, not its members."""
	return body.dynamic and not body.isClumpMember


def movers():
	"""The bodies of the scene that forces move by themselves."""
	return [body for body in O.bodies if body is not None and isMover(body)]


def canMove(body):
	"""Whether forces move it: a member of a clump moves with the clump."""
	return (O.bodies[body.clumpId] if body.isClumpMember else body).dynamic


def cannotTurn(body):
	"""Whether all of its rotations are blocked."""
	return set('XYZ') <= set(body.state.blockedDOFs)


def sameClump(one, other):
	"""Whether both bodies are members of one clump."""
	return one.isClumpMember and other.isClumpMember and one.clumpId == other.clumpId
