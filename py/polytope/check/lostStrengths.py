# SPDX-License-Identifier: GPL-2.0-or-later
"""Strengths of joints that do not act, of polytope.check(): lost to the material on the other side, or not there yet. Each yields (what,
seen, advice)."""

import numpy as np
from yade import Polytope, RockJointMat

from ..rock.faceMaterials import materialsOf, materialsOfContact
from ..scene.movers import isMover
from .neighbours import touchingPairs

__all__ = ['hanging', 'lostStrengths']

strengths = ('cohesion', 'tensileStrength')
upward = 0.1
"""Cosine between the way up and a contact's normal, above which the other body is above."""


def lostStrengths(scene):
	"""Joints of two materials, of which one has cohesion or tensile strength and the other none: the smaller value counts."""
	bodies = [body for body in scene.bodies if isinstance(body.shape, Polytope) and isinstance(body.material, RockJointMat)]
	used = list({id(material): material for body in bodies for material in materialsOf(body)}.values())
	lacking = [name for name in strengths if len({float(getattr(material, name)) > 0 for material in used}) == 2]
	if not lacking:
		return
	told = set()
	for one, other, contact in touchingPairs(scene, bodies):
		sides = materialsOfContact(one, other, np.array(contact.normal, float))
		for name in lacking:
			weak, strong = sorted(sides, key=lambda material: float(getattr(material, name)))
			if float(getattr(strong, name)) > 0 == float(getattr(weak, name)) and (name, id(weak), id(strong)) not in told:
				told.add((name, id(weak), id(strong)))
				yield (
					'joint strength',
					f'the joint of body {one.id} and body {other.id} has no {name}: the smaller value of both sides counts, '
					f'{float(getattr(strong, name)):.3g} Pa of RockJointMat {strong.label!r} and 0 of {weak.label!r}',
					f'the material of the joint on both sides: Polytope.faceMaterials, or jointMaterials of a jointed rock (docs/jointed-rock.md); nothing, if no {name} is meant',
				)


def hanging(scene):
	"""Bodies that have only others above, which they just touch: without an overlap no contact comes about, and no tensile strength acts."""
	if scene.O.iter > 0 or not scene.ownEngines or scene.down is None:
		return
	up = -scene.down
	bodies = [body for body in scene.bodies if isinstance(body.shape, Polytope)]
	able = {
		body.id
		for body in bodies
		if isMover(body) and body.id not in scene.bonded and any(getattr(one, 'tensileStrength', 0) > 0 for one in materialsOf(body))
	}
	above, held = {}, set()
	for one, other, contact in touchingPairs(scene, bodies) if able else ():
		for key, neighbour, sign in ((one.id, other.id, 1), (other.id, one.id, -1)):
			if contact.inContact or sign * (np.array(contact.normal, float) @ up) < upward:
				held.add(key)
			else:
				above.setdefault(key, neighbour)
	for key in sorted(able & set(above) - held)[:1]:
		yield (
			'hangs',
			f'body {key} hangs from body {above[key]}, which it only touches: its joint has no tensile strength before they overlap, and it falls',
			'polytope.bond() after O.engines is set: bodies in touch then hold by the tensileStrength of their material',
		)
