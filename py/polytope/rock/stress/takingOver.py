# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of blocks that have been cut take their place in the scene: joints, bonds, water, joint marks and histories go on with them."""

import itertools

import numpy as np
from yade import BaseMotion, Collider, O, Polytope, PolytopeGeom, PolytopeWater, QuietBoundary, RockJointPhys, _polytope

from ...bodies.clumps import ofUnion, rigid
from ...bonding.bolting import madeBolts
from ...bonding.bonds import bonds, madeBonds
from ...scene.movers import partsOf
from ...scene.permanentLoads import permanentLoads
from ..jointsOfFaces import replaceInRocks
from ..pointHistories import followParts

__all__ = ['refuseUnknown', 'takeOver']


def refuseUnknown(cut):
	"""What of bodies that are to be cut cannot go on with their parts.

	:param cut: ids of bodies and clumps
	"""
	if O.periodic:
		raise ValueError('O.periodic: blocks of a periodic cell are taken whole; give cut=False')
	loaded = permanentLoads()
	for k in cut:
		if any(part in loaded for part in (k, *partsOf(k))):
			raise ValueError(
				f'cut: block {k} has a permanent force, of which it is not known on which part it would act; take it away (O.forces.setPermF), and give it to the parts, or give cut=False'
			)
	parts = {part: k for k in cut for part in partsOf(k)}
	for part, k in parts.items():
		kind = type(O.bodies[part].shape)
		if kind is not Polytope:
			raise ValueError(f'cut: block {k} is a {kind.__name__}, of whose parts the shape is not known; give cut=False')
	for bolt in madeBolts():
		held = {k for crossing in bolt.crossings if not crossing.failure for k in (crossing.id1, crossing.id2)} & set(parts)
		if held:
			raise ValueError(
				f'cut: a bolt holds block {parts[min(held)]}, which the region would cut; put bolts in after the cut, or give cut=False'
			)
	for engine in O.engines:
		held = set(engine.ids) & set(parts) if isinstance(engine, (BaseMotion, QuietBoundary)) else ()
		if held:
			raise ValueError(
				f'cut: block {parts[min(held)]}, which the region would cut, is one of a {type(engine).__name__}; keep the region off it, or give cut=False'
			)
	for contact in O.interactions:
		for part in {contact.id1, contact.id2} & set(parts):
			if contact.isReal:
				_refuseContact(contact, parts[part])


def _isRockJoint(contact):
	return isinstance(contact.phys, RockJointPhys) and isinstance(contact.geom, PolytopeGeom)


def _refuseContact(contact, k):
	if not _isRockJoint(contact):
		raise ValueError(
			f'cut: the contact of block {k} between {contact.id1} and {contact.id2} is a {type(contact.phys).__name__}, and only rock joints go on with parts; '
			'give the blocks a RockJointMat, or cut=False'
		)
	if not contact.phys.normalStiffness > 0:
		raise ValueError(
			f'cut: the contact of block {k} between {contact.id1} and {contact.id2} has a stiffness per contact, which its parts would each have; '
			'give the materials stiffnessPerArea=True, or cut=False'
		)


def takeOver(rests, follow=lambda k, pieces: None):
	"""Takes bodies out of the scene, and puts what is left of them in their place.

	What is left and not convex is a clump. Rock joints with a stiffness per area and bonds go on, other contacts begin anew.

	:param rests: id of each body or clump → a list of bodies, each a list of cutting.Part; empty: nothing is left
	:param follow: is called with the id of each body and the ids of what is left of it, before the body is erased
	:returns: id → ids of these bodies
	"""
	former = {part: O.bodies[part] for k in rests for part in partsOf(k)}
	contacts = [contact for contact in O.interactions if contact.isReal and (contact.id1 in former or contact.id2 in former)]
	contacts = [contact for contact in contacts if _isRockJoint(contact) and contact.phys.normalStiffness > 0 and not O.periodic]
	linked = [one for one in madeBonds() if one.id1 in former or one.id2 in former]
	parts = {k: [] for k in former}
	for part in itertools.chain.from_iterable(itertools.chain.from_iterable(rests.values())):
		parts[part.of].append(part)
	made = {k: [_append(k, rest) for rest in several] for k, several in rests.items()}
	if (contacts or linked) and any(parts.values()):
		_goOn(contacts, linked, parts)
	for k, own in parts.items():
		replaceInRocks(former[k], [part.body for part in own], [part.planes for part in own])
	_replaceInWaters(parts)
	followParts(made)
	for k, pieces in made.items():
		follow(k, pieces)
	_erase(rests)
	return made


def _erase(ids):
	for k in ids:
		O.bodies.erase(k, eraseClumpMembers=True)


def _goOn(contacts, linked, parts):
	"""Bonds first: contacts ask for them."""
	_findPairs()
	for one in linked:
		_betweenParts(one, bonds()._continueBetween, parts)
	for contact in contacts:
		_betweenParts(contact, _polytope.continueBetween, parts)


def _betweenParts(link, goesOn, parts):
	"""A contact or bond goes on between the parts that have a share of it."""
	sides = [[part.body for part in parts[k]] if k in parts else [O.bodies[k]] for k in (link.id1, link.id2)]
	wholes = O.bodies[link.id1], O.bodies[link.id2]
	for one, other in itertools.product(*sides):
		goesOn(link, *wholes, one, other)


def _findPairs():
	"""Lets the collider find the pairs of the new bodies, all at once: contacts with parts of clumps that lie flush depend on each other."""
	for engine in O.engines:
		if isinstance(engine, Collider) and not engine.dead:
			engine()


def _append(k, rest):
	"""Id of one body of parts."""
	bodies = [part.body for part in rest]
	if len(bodies) == 1:
		made = O.bodies.append(bodies[0])
	else:
		overlap = O.bodies[k].isClump and not _addsUp(k)
		made = (ofUnion if overlap else rigid)(bodies)[0]
		_keepReference(O.bodies[made].state, O.bodies[k].state)
	for part in rest:
		_keepReference(part.body.state, O.bodies[part.of].state)
	return made


def _keepReference(state, former):
	"""Displacement and rotation go on."""
	back = former.refOri * former.ori.conjugate()
	state.refPos, state.refOri = former.refPos + back * (state.pos - former.pos), back * state.ori


def _addsUp(k):
	parts = sum(float(O.bodies[part].state.mass) for part in partsOf(k))
	return abs(parts - float(O.bodies[k].state.mass)) <= sameMass * parts


sameMass = 1e-9
"""How much more than a clump's mass the sum over its parts may be by rounding, over that mass; if it is more, they overlap."""


def _replaceInWaters(parts):
	"""Where water is on some faces only, it is on what is left of them."""
	for water in (engine for engine in O.engines if isinstance(engine, PolytopeWater) and engine.someFaces):
		wet = list(zip(water.wetBodies, water.wetPlanes, strict=True))
		left = [(k, plane) for k, plane in wet if k not in parts]
		of = {k: [plane for body, plane in wet if body == k] for k in parts}
		for k, own in parts.items():
			left += [(part.body.id, int(plane)) for part in own for plane in np.flatnonzero(np.isin(part.planes, of[k]))]
		if left != wet:
			water.updateAttrs(dict(wetBodies=[k for k, _ in left], wetPlanes=[plane for _, plane in left]))
