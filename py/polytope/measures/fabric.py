# SPDX-License-Identifier: GPL-2.0-or-later
"""Fabric of a packing: directions of contacts, and of the bodies' long axes."""

import numpy as np
from yade import O, Vector3

from ..bonding.bonds import intactBonds
from ..scene.movers import moverOf
from ..scene.vertices import rotationMatrix
from .counted import bearing, freePolytopes, massive

__all__ = ['contactFabric', 'longAxes', 'particleFabric']


def contactFabric(ids=None):
	"""Fabric tensor of the contacts that bear a force: the mean of n ⊗ n over their normals (Satake 1982); its trace is 1. A bond that bears a force
	counts as a contact, with its normal.

	:param ids: contacts of these bodies count, one between two of them once; None: all free polytopes and spheres, and clumps of them
	:returns: (3, 3) array [-]; a third of the unit matrix where normals have no direction in common
	:raises ValueError: naming *ids*, or if there is no such contact
	"""
	chosen = set(massive(ids))
	normals = [np.array(contact.geom.normal, float) for contact in bearing() if {moverOf(contact.id1), moverOf(contact.id2)} & chosen]
	for bond in intactBonds():
		if bond.force.squaredNorm() > 0 and {moverOf(bond.id1), moverOf(bond.id2)} & chosen:
			normals.append(np.array(O.bodies[bond.id1].state.ori * bond.frame1 * Vector3(1, 0, 0), float))
	if not normals:
		raise ValueError('ids: no contact of these bodies bears a force')
	return np.mean([np.outer(n, n) for n in normals], axis=0)


def particleFabric(ids=None):
	"""Fabric tensor of the bodies' long axes: the mean of a ⊗ a; its trace is 1. The long axis is that of the least moment of inertia.

	:param ids: of polytopes; None: all free ones that are in no clump
	:returns: (3, 3) array [-]
	:raises ValueError: naming *ids*
	"""
	return np.mean([np.outer(a, a) for a in longAxes(ids)], axis=0)


def longAxes(ids):
	"""(n, 3) unit vectors in world axes."""
	axes = []
	for k in freePolytopes(ids):
		body = O.bodies[k]
		turn = rotationMatrix(body.state.ori)
		# of a polygon in its plane, in which its thickness has no part
		axes.append(turn[:, int(np.argmin(np.array(body.shape.inertia, float)[: body.shape.dimension]))])
	return np.array(axes)
