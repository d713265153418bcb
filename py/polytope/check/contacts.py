# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of the contacts that there are, of polytope.check(). Each yields (what, seen, advice)."""

import itertools

import numpy as np
from yade import FrictPhys, Polytope, PolytopeGeom, RockJointPhys

from ..scene.present import geometryFunctors

__all__ = ['contactFindings']

answers = ('separated', 'contact', 'normalFromOneBody', 'normalFromDual', 'roundingLimited', 'centreByIpopt')
"""Statuses of queries that have one."""
withoutContact = 'set them apart; or have no contacts among fixed bodies: mask=3 for each, and avoidSelfInteractionMask=2 for the collider'
"""What to do about fixed bodies that pierce each other."""
sameFace = 1 - 1e-6
"""Cosine between normals of two contacts of one face."""
bornByFriction, bornByPressure = 0.5, 0.1
"""Of a body's weight: what friction bears at least, and pressure at most, where friction alone holds it up. On a slope pressure bears its part."""


def contactFindings(scene):
	"""Findings about the contacts of the scene's own engines: nothing is known yet of the contacts that others make."""
	if scene.ownEngines:
		yield from failures(scene)
		yield from energyOfFixedBodies(scene)
		yield from severalPieces(scene)
		yield from heldByFriction(scene)


def failures(scene):
	"""Queries without an answer, since the start or the last resetStats(), and a pair that has none now."""
	failed = sum(functor.stats()['failures'] for functor in geometryFunctors())
	if not failed:
		return
	seen, advice = f'{failed} contact queries had no answer', 'find out which: docs/statuses.md says why a query may have none'
	now = [one for one in scene.O.interactions if one.isReal and isinstance(one.geom, PolytopeGeom) and one.geom.status not in answers]
	if now:
		one = min(now, key=lambda one: not _fixed(scene, one))  # those of fixed bodies come back in each step
		seen += f', now {len(now)}: body {one.id1} and body {one.id2} have {one.geom.status}'
		if _fixed(scene, one):
			seen += ', and are both fixed'
			advice = withoutContact
	yield 'failures', seen, advice


def energyOfFixedBodies(scene):
	"""Contacts whose bodies nothing moves: what they store and seem to do is in the energies of the scene, and hides all else."""
	if not scene.O.trackEnergy:
		return
	for one in scene.O.interactions:
		if not (one.isReal and isinstance(one.geom, PolytopeGeom) and one.geom.penetrationDepth > 0 and _fixed(scene, one)):
			continue
		if all(scene.O.bodies[key].state.vel.norm() == 0 and scene.O.bodies[key].state.angVel.norm() == 0 for key in (one.id1, one.id2)):
			seen = f'body {one.id1} and body {one.id2} are both fixed and pierce each other: the energy of their contact is in O.energy'
			yield 'energy of fixed bodies', seen, withoutContact
			return


def _fixed(scene, pair):
	return not any(scene.moves(scene.O.bodies[key]) for key in (pair.id1, pair.id2))


def severalPieces(scene):
	"""Bodies with a face on several pieces, each of which has the full stiffness of a contact: such a face is as stiff as it has pieces."""
	contacts = [one for one in scene.O.interactions if one.isReal and isinstance(one.geom, PolytopeGeom) and one.geom.penetrationDepth > 0]
	if any(isinstance(one.phys, RockJointPhys) and one.phys.normalStiffness > 0 for one in contacts):
		return  # stiffnesses are per area: pieces that lie flush are as stiff as one
	faces = {}
	for one in contacts:
		for key in (one.id1, one.id2):
			if one.geom.share == 1 and scene.O.bodies[key].dynamic:
				faces.setdefault(key, []).append(one.geom)
	several = [key for key, found in faces.items() if any(_oneFace(*pair) for pair in itertools.combinations(found, 2))]
	if several:
		seen = f'{len(several)} bodies (body {several[0]} first) lie with one face on several pieces, of which each has the full stiffness'
		yield 'several pieces under one face', seen, 'stiffnessPerArea=True: per contact such a face is as stiff as it has pieces'


def _oneFace(one, other):
	"""Whether both contacts lie in one plane, to within an overlap."""
	along, depth = one.normal.dot(other.normal), min(one.penetrationDepth, other.penetrationDepth)
	return abs(along) > sameFace and abs(one.normal.dot(other.contactPoint - one.contactPoint)) < depth


def heldByFriction(scene):
	"""Polyhedra between faces that do not lie under them, with laws of YADE's own: friction at one point of a face has no moment about it."""
	if scene.down is None:
		return
	borne = {}
	for one in scene.O.interactions:
		if not (one.isReal and isinstance(one.geom, PolytopeGeom) and isinstance(one.phys, FrictPhys)) or isinstance(
			one.phys, RockJointPhys
		):
			continue
		for key, sign in ((one.id1, -1), (one.id2, 1)):
			body = scene.O.bodies[key]
			if isinstance(body.shape, Polytope) and body.shape.dimension == 3 and scene.moves(body):
				forces = np.array([one.phys.normalForce, one.phys.shearForce], float)
				borne[key] = borne.get(key, 0) - sign * forces @ scene.down
	weight = {key: scene.gravity() * float(scene.O.bodies[key].state.mass) for key in borne}
	held = [
		key
		for key, (pressure, friction) in borne.items()
		if friction > bornByFriction * weight[key] and pressure < bornByPressure * weight[key]
	]
	if held:
		seen = f'body {held[0]}' + (f' and {len(held) - 1} more are' if held[1:] else ' is') + ' held by friction between faces, '
		seen += 'which the scene\'s law puts at one point of each: in space such a body turns about these points and falls out'
		yield 'held by friction', seen, 'RockJointMat, whose friction acts over the faces (docs/contact-force.md)'
