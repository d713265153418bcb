# SPDX-License-Identifier: GPL-2.0-or-later
"""Mean stress of bodies that are taken as the polytopes they are. YADE's own function takes every body for a sphere."""

import math

import numpy as np
from yade import O, Polytope

from ..bodies.clumps import volumeOfUnion
from ..bonding.bonds import intactBonds
from ..scene.movers import moverOf
from ..scene.vertices import rotationMatrix
from .counted import bearing, massive

__all__ = ['bodyStress']


def bodyStress(ids=None):
	"""Mean stress of each body, from its contact forces and their arms: σ = 1/V Σ f ⊗ (x − c), with its own volume V and centre c. Bonds, and joints
	with tensile strength that act as bonds, count with their force and with the first moments of the stresses of bending and twisting over
	their area.

	The mean of a body in equilibrium; gravity has no part in it about the centroid. Not symmetric where the body is not in equilibrium of
	moments. A clump is one body, its volume what its parts fill together (with spheres among them: the sum).

	:param ids: of the bodies; None: all free polytopes and spheres, and clumps of them
	:returns: dictionary id → (3, 3) array [Pa], tension positive as in YADE; rows are components of the force
	:raises ValueError: naming *ids* for a body that is not there, named twice, or without a volume
	"""
	stress = {k: np.zeros((3, 3)) for k in massive(ids)}
	for contact in bearing():
		if (own := getattr(contact.phys, 'bond', None)) is not None:  # a joint in tension
			_addBond(stress, own)
			continue
		force = np.array(contact.phys.normalForce + contact.phys.shearForce, float)
		point = np.array(contact.geom.contactPoint, float)
		shift = np.array(O.cell.hSize * contact.cellDist, float) if O.periodic else 0
		for k, sign, place in ((contact.id1, -1, point), (contact.id2, 1, point - shift)):
			whole = moverOf(k)
			if whole in stress:
				stress[whole] += np.outer(sign * force, place - np.array(O.bodies[whole].state.pos, float))
	for bond in intactBonds():
		_addBond(stress, bond)
	return {k: total / _volume(k) for k, total in stress.items()}


def _addBond(stress, bond):
	force, moment, point = (np.array(vector, float) for vector in (bond.force, bond.moment, bond.point))
	axes = rotationMatrix(O.bodies[bond.id1].state.ori * bond.frame1)
	normal, u, v = axes.T
	# ∫ t ⊗ r over the area, r from its centroid: pressure σ = k(θ₁z − θ₂y), and the shear of a twist, whose mean is the part of a rotation
	spread = np.outer(normal, np.cross(normal, moment)) + moment @ normal / 2 * (np.outer(v, u) - np.outer(u, v))
	shift = np.array(O.cell.hSize * bond.cellDist, float) if O.periodic else 0
	for k, sign, place in ((bond.id1, -1, point), (bond.id2, 1, point - shift)):
		whole = moverOf(k)
		if whole in stress:
			stress[whole] += sign * (np.outer(force, place - np.array(O.bodies[whole].state.pos, float)) + spread)


def _volume(k):
	body = O.bodies[k]
	if body.isClump and all(isinstance(O.bodies[part].shape, Polytope) for part in body.shape.members):
		return volumeOfUnion([O.bodies[part] for part in body.shape.members])
	if body.isClump:
		return sum(_volume(member) for member in body.shape.members)
	return float(body.shape.volume) if isinstance(body.shape, Polytope) else 4 / 3 * math.pi * float(body.shape.radius) ** 3
