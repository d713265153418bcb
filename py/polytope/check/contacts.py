# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of the contacts that there are, of polytope.check(). Each yields (what, seen, advice)."""

import itertools

from yade import PolytopeGeom, RockJointPhys

from ..scene.present import geometryFunctors

__all__ = ['contactFindings']

answers = ('separated', 'contact', 'normalFromOneBody', 'normalFromDual', 'roundingLimited', 'centreByIpopt')
"""Statuses of queries that have one."""
sameFace = 1 - 1e-6
"""Cosine between normals of two contacts of one face."""


def contactFindings(scene):
	"""Findings about the contacts of the scene's own engines: nothing is known yet of the contacts that others make."""
	if scene.ownEngines:
		yield from failures(scene)
		yield from severalPieces(scene)


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
			advice = (
				'set them apart; or have no contacts among fixed bodies: mask=3 for each, and avoidSelfInteractionMask=2 for the collider'
			)
	yield 'failures', seen, advice


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
