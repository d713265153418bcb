# SPDX-License-Identifier: GPL-2.0-or-later
"""What contacts each body has, which dampers need (StiffnessSums), in a divided scene: a rank has all contacts of its own bodies alone.

So in each step, before the contacts, every rank gives the others the sums of those of its bodies that they know. Rank 0 has fixed bodies,
of which there are none.
"""

from yade import O, _polytope, mpy

__all__ = ['passOn', 'share', 'states', 'takeStates']

_tag = 7302
"""MPI's tag of these messages."""


def share():
	"""Exchanges sums with other ranks, before the contacts of each step, on every rank."""
	if not O.splitted or mpy.rank == 0:
		return
	sent = [
		mpy.comm.isend(_polytope.stiffnessSums(ids), dest=other, tag=_tag)
		for other, ids in enumerate(O.subD.intersections)
		if other not in (0, mpy.rank) and ids
	]
	for other, ids in enumerate(O.subD.mirrorIntersections):
		if other not in (0, mpy.rank) and ids:
			_polytope.takeStiffnessSums(ids, mpy.comm.recv(source=other, tag=_tag))
	for message in sent:
		message.wait()


def passOn(moved):
	"""Passes on the sums of bodies that change ranks; every rank has to call it.

	:param moved: ids for each rank
	"""
	for ids, sums in mpy.comm.alltoall([(ids, _polytope.stiffnessSums(ids)) for ids in moved]):
		if ids:
			_polytope.takeStiffnessSums(ids, sums)


def states():
	"""The sums of each worker's bodies, on rank 0, before a merge; every rank has to call it."""
	own = [body.id for body in O.bodies if body.subdomain == mpy.rank and not body.isSubdomain] if mpy.rank > 0 else []
	return mpy.comm.gather((own, _polytope.stiffnessSums(own)))


def takeStates(states):
	"""Takes over the workers' sums, on rank 0, after a merge."""
	for ids, sums in states:
		if ids:
			_polytope.takeStiffnessSums(ids, sums)
