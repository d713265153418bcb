# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints between bodies of two ranks that are open: their boxes do not meet, but the joint remembers its slip until the bodies touch again.

yade.mpy gives a rank the bodies of others that are near its own, by boxes, and deletes the rest with their contacts. Here a rank asks, in
each search for pairs, for the other bodies of its contacts, too.
"""

import functools

from yade import O, _polytope, mpy

__all__ = ['keptByRanks', 'remember']

_partners = []
"""Ids of bodies of other ranks that this rank's bodies have contacts with."""


def remember():
	"""Remembers the present contacts before a search for pairs, on every rank. Returns them, since the first search after the scene was
	divided deletes them."""
	global _partners
	contacts = _polytope.WorkerContacts() if mpy.rank > 0 else None
	_partners = contacts.partners() if contacts else []
	return contacts


def keptByRanks(genLocalIntersections):
	"""Wraps the function that lists this rank's bodies that another rank needs: it lists also those that the other rank has asked for."""

	@functools.wraps(genLocalIntersections)
	def generate(subdomains):
		lists = genLocalIntersections(subdomains)
		for other, ids in enumerate(mpy.comm.allgather(_partners)):
			listed = set(lists[other]) if ids else ()
			missing = [k for k in ids if k not in listed and O.bodies[k] is not None and O.bodies[k].subdomain == mpy.rank]
			if missing and other != mpy.rank:
				lists[other] += missing
				if other not in lists[mpy.rank]:
					lists[mpy.rank].append(other)
		return lists

	return generate
