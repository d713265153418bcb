# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that fall for ever, of polytope.check(): below all that is fixed, or free to pass through it. Each yields (what, seen, advice)."""

import numpy as np
from yade import Box, Facet, Polytope, Sphere, Wall

from ..bonding.bolting import madeBolts
from ..scene.movers import isMover, moverOf, partsOf
from ..scene.vertices import worldVertices

__all__ = ['belowAll', 'falling']


def falling(scene):
	"""Gravity in the wrong direction, a body on the wrong side of a floor or fallen past it, a mask that it has not in common with any."""
	lost = scene.fallen
	if lost:
		more = f', and so are {len(lost) - 1} others' if len(lost) > 1 else ''
		seen = f'body {lost[0]} is below all that is fixed{more}: with gravity {tuple(scene.totalGravity.tolist())} it falls for ever'
		yield (
			'falls',
			seen,
			'gravity in the direction in which bodies are to fall, a body above what is to stop it, ground that reaches far enough; O.bodies.erase() what has left the scene',
		)
	through = _through(scene)
	if through:
		seen = f'body {through[0]} has no bit of its mask, {scene.O.bodies[through[0]].mask}, in common with any that is fixed, nor with one that they hold: it falls through'
		yield 'masks', seen, 'a bit that both have; mask=1 is the default of all bodies'


def _through(scene):
	"""Ids of free bodies that meet nothing fixed, nor others that do; members of a clump are held by it, and a mask of 0 marks what is to
	meet nothing."""
	held = 0
	for body in scene.bodies:
		held |= 0 if scene.moves(body) else body.mask
	if not held or not scene.ownEngines or not scene.gravity() > 0 or scene.bonded or madeBolts():
		return []
	free = {body.id: body.mask for body in scene.bodies if scene.moves(body) and body.mask and not body.isClumpMember}
	masks = set(free.values())
	while more := {mask for mask in masks if mask & held}:
		masks -= more
		for mask in more:
			held |= mask
	return [k for k, mask in free.items() if mask in masks]


def belowAll(scene):
	"""Ids of bodies below all that is fixed and could hold them, which nothing touches; bodies alone in space may fall."""
	if scene.O.periodic or not scene.ownEngines or scene.down is None or madeBolts():
		return []
	ends = {}
	for body in scene.bodies:
		if not scene.moves(body):
			ends[body.mask] = max(ends.get(body.mask, -np.inf), _lowest(body, scene.down))
	touched = {moverOf(k) for contact in scene.O.interactions if contact.isReal for k in (contact.id1, contact.id2)}
	touched |= {moverOf(body.id) for body in scene.bodies if body.id in scene.bonded}
	found = []
	for body in scene.O.bodies if ends else ():
		if body is not None and isMover(body) and body.id not in touched:
			masks = [scene.O.bodies[k].mask for k in partsOf(body.id)]
			under = [end for mask, end in ends.items() if any(mask & own for own in masks)]
			if under and np.array(body.state.pos, float) @ scene.down > max(under):
				found.append(body.id)
	return found


def _lowest(body, down):
	"""How far down it reaches [m]; a wall that does not lie across gravity reaches for ever."""
	place = float(np.array(body.state.pos, float) @ down)
	if isinstance(body.shape, (Polytope, Box, Facet)):
		return float((worldVertices(body) @ down).max())
	if isinstance(body.shape, Sphere):
		return place + float(body.shape.radius)
	return place if isinstance(body.shape, Wall) and abs(down[body.shape.axis]) == 1 else np.inf
