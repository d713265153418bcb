# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of a packing that take bodies as the polytopes they are: stress, fabric, extents, sizes.

YADE's own functions of this kind take every body for a sphere, or leave out what is none.
"""

import math

import numpy as np
from yade import O, Polytope, Sphere, Vector3

from ..bonding.bonds import madeBonds
from ..pictures.faces import localVertices, worldVertices
from ..scene.movers import moverOf, movers
from ..scene.namedBodies import namedBodies
from .heap import solidVolume

__all__ = ['aabbExtrema', 'bodyStress', 'contactFabric', 'particleFabric', 'sizeDistribution']


def bodyStress(ids=None):
	"""Mean stress of each body, from its contact forces and their arms: σ = 1/V Σ f ⊗ (x − c), with its own volume V and centre c. Bonds, and joints
	with tensile strength that act as bonds, count with their force and with the first moments of the stresses of bending and twisting over their area.

	The mean of a body in equilibrium; gravity has no part in it about the centroid. Not symmetric where the body is not in equilibrium of
	moments. A clump is one body, its volume what its parts fill together (with spheres among them: the sum).

	:param ids: of the bodies; None: all free polytopes and spheres, and clumps of them
	:returns: dictionary id → (3, 3) array [Pa], tension positive as in YADE; rows are components of the force
	:raises ValueError: naming *ids* for a body that is not there, named twice, or without a volume
	"""
	stress = {k: np.zeros((3, 3)) for k in _massive(ids)}
	for contact in _bearing():
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
	for bond in _intactBonds():
		_addBond(stress, bond)
	return {k: total / _volume(k) for k, total in stress.items()}


def _addBond(stress, bond):
	force, moment, point = (np.array(vector, float) for vector in (bond.force, bond.moment, bond.point))
	axes = np.array((O.bodies[bond.id1].state.ori * bond.frame1).toRotationMatrix(), float).reshape(3, 3)
	normal, u, v = axes.T
	# ∫ t ⊗ r over the area, r from its centroid: pressure σ = k(θ₁z − θ₂y), and the shear of a twist, whose mean is the part of a rotation
	spread = np.outer(normal, np.cross(normal, moment)) + moment @ normal / 2 * (np.outer(v, u) - np.outer(u, v))
	shift = np.array(O.cell.hSize * bond.cellDist, float) if O.periodic else 0
	for k, sign, place in ((bond.id1, -1, point), (bond.id2, 1, point - shift)):
		whole = moverOf(k)
		if whole in stress:
			stress[whole] += sign * (np.outer(force, place - np.array(O.bodies[whole].state.pos, float)) + spread)


def contactFabric(ids=None):
	"""Fabric tensor of the contacts that bear a force: the mean of n ⊗ n over their normals (Satake 1982); its trace is 1. A bond that bears a force
	counts as a contact, with its normal.

	:param ids: contacts of these bodies count, one between two of them once; None: all free polytopes and spheres, and clumps of them
	:returns: (3, 3) array [-]; a third of the unit matrix where normals have no direction in common
	:raises ValueError: naming *ids*, or if there is no such contact
	"""
	chosen = set(_massive(ids))
	normals = [np.array(contact.geom.normal, float) for contact in _bearing() if {moverOf(contact.id1), moverOf(contact.id2)} & chosen]
	for bond in _intactBonds():
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
	return np.mean([np.outer(a, a) for a in _longAxes(ids)], axis=0)


def _longAxes(ids):
	"""(n, 3) unit vectors in world axes."""
	axes = []
	for k in _polytopes(ids):
		body = O.bodies[k]
		turn = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
		# of a polygon in its plane, in which its thickness has no part
		axes.append(turn[:, int(np.argmin(np.array(body.shape.inertia, float)[: body.shape.dimension]))])
	return np.array(axes)


def aabbExtrema(ids=None):
	"""Opposite corners of the box about bodies, by their vertices (spheres: radius), not by their bounds.

	:param ids: of polytopes, spheres, boxes, facets and clumps; None: all free polytopes and spheres, and clumps of them
	:returns: (lower, upper), arrays of 3 [m]; in a periodic cell bodies count where their centre is inside it
	:raises ValueError: naming *ids* for a body that is not there, or without an extent (walls)
	"""
	low, high = np.full(3, np.inf), np.full(3, -np.inf)
	for k in _massive(None) if ids is None else namedBodies(ids):
		for member in O.bodies[k].shape.members if O.bodies[k].isClump else (k,):
			points = _extremes(O.bodies[member])
			low, high = np.minimum(low, points.min(axis=0)), np.maximum(high, points.max(axis=0))
	if not np.isfinite(low).all():
		raise ValueError('ids: there is no free polytope or sphere')
	return low, high


def sizeDistribution(sieves=None, ids=None):
	"""Grain size distribution: the part of the mass that passes a square sieve.

	A polytope's size is the intermediate one of its extents along its principal axes.

	:param sieves: openings [m]; None: the sizes of the bodies themselves, in order
	:param ids: of polyhedra; None: all free ones that are in no clump
	:returns: (openings, passing), arrays [m], [-]
	:raises ValueError: naming *ids*, or *sieves* if they are no lengths
	"""
	chosen = _polytopes(ids)
	flat = next((k for k in chosen if O.bodies[k].shape.dimension == 2), None)
	if flat is not None:
		raise ValueError(f'ids: body {flat} is a polygon, which no sieve has an opening for; name polyhedra')
	sizes = np.array([np.sort(np.ptp(localVertices(O.bodies[k].shape), axis=0))[1] for k in chosen])
	masses = np.array([float(O.bodies[k].shape.volume * O.bodies[k].material.density) for k in chosen])
	try:
		openings = np.sort(sizes) if sieves is None else np.array([float(opening) for opening in sieves])
	except (TypeError, ValueError):
		openings = np.array([np.nan])
	if not (openings > 0).all():
		raise ValueError(f'sieves: must be openings above 0 [m], got {sieves!r}')
	order = np.argsort(sizes)
	passed = np.concatenate([[0], np.cumsum(masses[order])])
	return openings, passed[np.searchsorted(sizes[order], openings, side='right')] / masses.sum()


def _bearing():
	return [contact for contact in O.interactions if contact.isReal and contact.phys.normalForce.squaredNorm() > 0]


def _intactBonds():
	return [bond for bond in madeBonds() if bond.intact]


def _massive(ids):
	"""Polytopes, spheres and clumps."""
	if ids is None:
		bodies = (O.bodies[moverOf(body.id)] for body in O.bodies if body is not None and isinstance(body.shape, (Polytope, Sphere)))
		return list(dict.fromkeys(body.id for body in bodies if body.dynamic))
	for k in (named := namedBodies(ids)):
		if not O.bodies[k].isClump and not isinstance(O.bodies[k].shape, (Polytope, Sphere)):
			raise ValueError(f'ids: body {k} is neither a polytope nor a sphere')
	return named


def _polytopes(ids):
	if ids is None:
		found = [body.id for body in movers() if isinstance(body.shape, Polytope)]
	else:
		found = namedBodies(ids)
	if not found:
		raise ValueError('ids: there is no free polytope')
	for k in found:
		if not isinstance(O.bodies[k].shape, Polytope):
			raise ValueError(f'ids: body {k} is no polytope')
	return found


def _extremes(body):
	"""Points whose box is the body's."""
	if isinstance(body.shape, Sphere):
		place = O.cell.wrap(body.state.pos) if O.periodic else body.state.pos
		return np.array(place, float) + np.array([[-1], [1]]) * float(body.shape.radius)
	points = worldVertices(body)
	if not len(points):
		raise ValueError(f'ids: body {body.id} is a {type(body.shape).__name__}, which has no extent of its own')
	return points


def _volume(k):
	body = O.bodies[k]
	if body.isClump and all(isinstance(O.bodies[part].shape, Polytope) for part in body.shape.members):
		return solidVolume(k)
	if body.isClump:
		return sum(_volume(member) for member in body.shape.members)
	return float(body.shape.volume) if isinstance(body.shape, Polytope) else 4 / 3 * math.pi * float(body.shape.radius) ** 3
