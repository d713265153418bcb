# SPDX-License-Identifier: GPL-2.0-or-later
"""Coordination number of a heap: contacts per body."""

import dataclasses
import itertools

from ..bonding.bonds import intactBonds
from ..scene.movers import moverOf
from ..scene.namedBodies import namedBodies
from .counted import bearing

__all__ = ['Coordination', 'coordinationNumber']


@dataclasses.dataclass
class Coordination:
	"""Contacts per body, a clump being one. A contact of two bodies of the heap counts for both, one with a wall or floor once."""

	mean: float
	"""Mean over all bodies, rattlers included."""
	mechanical: float
	"""Mean over bodies with two contacts or more, counting contacts between such bodies alone: Thornton's mechanical coordination number (2000,
	Géotechnique 50:43), (2C − N₁)/(N − N₀ − N₁). NaN if there is no such body."""
	rattlers: int
	"""N₀ + N₁: bodies with no or one contact. They carry at most their own weight."""
	bodies: int
	"""N"""


def coordinationNumber(ids=None):
	"""Contacts per body, of the contacts that bear a normal force and of bonded pairs. A pair of polytopes has one contact, be it face on face. A
	clump is one body, with the contacts of all its members.

	:param ids: of the heap's bodies; None: all free polytopes, and clumps of them
	:returns: Coordination
	:raises ValueError: naming *ids* if there is none, or a body is not there, named twice, or a member of a clump
	"""
	touching = dict.fromkeys(namedBodies(ids), 0)
	if not touching:
		raise ValueError('ids: there is no free polytope')
	pairs = [(contact.id1, contact.id2) for contact in bearing()]
	pairs += {(bond.id1, bond.id2) for bond in intactBonds()}
	for k in map(moverOf, itertools.chain(*pairs)):
		if k in touching:
			touching[k] += 1
	several = [count for count in touching.values() if count > 1]
	mechanical = sum(several) / len(several) if several else float('nan')
	return Coordination(sum(touching.values()) / len(touching), mechanical, len(touching) - len(several), len(touching))
