# SPDX-License-Identifier: GPL-2.0-or-later
"""Clumps in a divided scene: each belongs whole to one rank, and every rank that has one of its parts has all of it.

The integrator moves a clump by the forces on its members, so that its rank must have them all. Another rank that has a member computes with
it as with any body of others, but for what is the clump's: its mass in dampers and limits of the time step, whether it is fixed, its other
members in internal faces. yade.mpy sends bodies that have a box where another rank's box overlaps it, which the clump's own body never
does, and its members do one by one.
"""

import functools

from yade import O, mpy

from ..scene.movers import moverOf
from ..scene.movers import movers as allMovers

__all__ = ['check', 'followClumps', 'giveMaterials', 'movers', 'parts', 'takeMaterials', 'wholeClumps']


def movers():
	"""Bodies that forces can move; for a clump its own body alone."""
	return [body for body in allMovers() if not body.isSubdomain]


def parts(number):
	"""Ids of all that a mover moves: those of a clump and its members, or that of a body alone."""
	body = O.bodies[number]
	return [*body.shape.ids, number] if body.isClump else [number]


def followClumps():
	"""Members get the rank of their clump."""
	for body in O.bodies:
		if body.isClumpMember:
			body.subdomain = O.bodies[body.clumpId].subdomain


def check():
	"""To be called on rank 0, where ranks of bodies were not given by polytope.mpi.

	:raises RuntimeError: a member is with another rank than its clump
	"""
	for body in O.bodies:
		if body.isClumpMember and body.subdomain != O.bodies[body.clumpId].subdomain:
			raise RuntimeError(
				f'Body.subdomain: member {body.id} of clump {body.clumpId} must be with the rank of its clump; call polytope.mpi.divide()'
			)


def giveMaterials():
	"""Gives each clump a material, on rank 0, before the scene is handed out: when it is merged, YADE looks up the material of each body
	that a worker has moved, and a clump has none."""
	for body in O.bodies:
		if body.isClump and body.dynamic:
			body.material = O.bodies[body.shape.ids[0]].material


def takeMaterials():
	"""Takes the materials from the clumps again, on rank 0, after a merge."""
	for body in O.bodies:
		if body.isClump:
			body.material = None


def wholeClumps(genLocalIntersections):
	"""Wraps the function that lists this rank's bodies that another rank needs: of a clump it lists all that belongs to it, in place of the
	members that are near."""

	@functools.wraps(genLocalIntersections)
	def generate(subdomains):
		lists = genLocalIntersections(subdomains)
		return [ids if other == mpy.rank else _withClumps(ids) for other, ids in enumerate(lists)]

	return generate


def _withClumps(ids):
	all = {}  # in their order, each once
	for k in ids:
		all.update(dict.fromkeys(parts(moverOf(k))))
	return list(all)
