# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that change ranks during a run, mpy.REALLOCATE_FREQUENCY: in place of yade.mpy's way, which leaves the new rank without bodies
that they touch until the next search for pairs, and without their contacts.

Which bodies go where is decided by mpy.REALLOCATE_FILTER, as there; the one here takes the place of mpy.medianFilter, which moved no body
in any scene tried. They go with their contacts, after the bodies that they may touch: a rank takes a contact over when both its bodies are
there. A search for pairs by all ranks follows, so that each has the bodies it needs in the next step.
"""

from yade import O, mpy

from ..scene.movers import moverOf
from . import bonds, clumps, dampers, permanentLoads

__all__ = ['beyondTheMiddle', 'reallocate']


def beyondTheMiddle(own, other, surplus):
	"""This rank's bodies that the other rank knows and that lie beyond the plane half way between the centres of mass of both ranks' bodies.

	:param own, other: ranks
	:param surplus: by how many more bodies this rank has than half of both; unused, for the plane follows the bodies
	"""
	here, there = O.subD._centers_of_mass[own], O.subD._centers_of_mass[other]
	across, middle = there - here, (here + there) / 2
	return [k for k in O.subD.intersections[other] if (O.bodies[k].state.pos - middle).dot(across) > 0]


def reallocate(choose, blocking=True):
	"""Right after a search for pairs; every rank has to call it.

	:param choose: (this rank, other one, how many more bodies this one has) → ids of bodies for the other one
	:param blocking: of yade.mpy's function, in whose place this is
	"""
	bonds.share()
	moved = _chosen(choose)
	_send(_missing(_neighbours(ids) for ids in moved))
	for other, ids in enumerate(moved):
		for k in ids:
			O.bodies[k].subdomain = other
	_send(moved)
	permanentLoads.passOn(moved)
	dampers.passOn(moved)
	O.subD.updateLocalIds(True)
	mpy.collider.doSort = True  # finds pairs also of boxes that met before, when neither body was this rank's
	mpy.parallelCollide()


def _chosen(choose):
	"""Ids for each rank, clumps whole. A worker keeps one body at least."""
	own = {moverOf(k) for k in O.subD.ids} if mpy.rank > 0 else {}
	of = mpy.comm.allgather((len(own), O.subD.centerOfMass() if mpy.rank > 0 else None))
	chosen = [[] for _ in of]
	if mpy.rank == 0:
		return chosen
	O.subD._centers_of_mass = [centre for _, centre in of]
	O.subD.intersections, O.subD.mirrorIntersections = (
		[ids if other == mpy.rank else [k for k in ids if not O.bodies[k].isClump] for other, ids in enumerate(lists)]
		for lists in (O.subD.intersections, O.subD.mirrorIntersections)  # the filter looks at boxes, which clumps have not
	)
	for other in O.subD.intersections[mpy.rank]:
		if other == 0:
			continue
		for k in choose(mpy.rank, other, int((len(own) - of[other][0]) / 2)):
			number = moverOf(k)
			if number in own and len(own) > 1:
				own.remove(number)
				chosen[other] += clumps.parts(number)
	return chosen


def _neighbours(ids):
	"""Bodies that these may touch, clumps whole."""
	found = {}
	for k in ids:
		for pair in O.interactions.withBodyAll(k):
			other = O.bodies[pair.id1 if pair.id2 == k else pair.id2]
			if other is not None and not other.isSubdomain:
				found.update(dict.fromkeys(clumps.parts(moverOf(other.id))))
	return [k for k in found if k not in ids]


def _missing(lists):
	"""Ids, for each rank, of the bodies that it does not have: a copy must not take the place of a body that is its own."""
	asked = mpy.comm.alltoall(list(lists))
	return mpy.comm.alltoall([[k for k in ids if O.bodies[k] is None] for ids in asked])


def _send(lists):
	"""Bodies with their contacts to each rank."""
	expected = mpy.comm.alltoall([len(ids) for ids in lists])
	for other, ids in enumerate(lists):
		if ids:
			O.subD.sendBodies(other, ids)
	for other, count in enumerate(expected):
		if count:
			O.subD.receiveBodies(other)
	O.subD.completeSendBodies()
