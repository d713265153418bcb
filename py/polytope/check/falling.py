# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that nothing fixed is below, of polytope.check(): gravity in the wrong direction, or a body on the wrong side of a floor. Yields (what, seen, advice)."""

import numpy as np
from yade import Box, Facet, Polytope, Sphere, Wall

from ..pictures.faces import worldVertices
from ..scene.movers import isMover

__all__ = ['falling']


def falling(scene):
	"""At the start, where neither contacts nor bonds hold anything yet; bodies alone in space may fall."""
	if scene.O.iter > 0 or scene.O.periodic or not scene.ownEngines or not scene.gravity() > 0 or len(scene.O.interactions):
		return
	gravity = np.sum([np.array(engine.gravity, float) for engine in scene.integrators], axis=0)
	down = gravity / np.linalg.norm(gravity)
	ends = [_lowest(body, down) for body in scene.bodies if not scene.moves(body)]
	if not ends:
		return
	below = [body for body in scene.bodies if isMover(body) and np.array(body.state.pos, float) @ down > max(ends)]
	if below:
		more = f', and so are {len(below) - 1} others' if len(below) > 1 else ''
		seen = f'body {below[0].id} is below all that is fixed{more}: with gravity {tuple(gravity.tolist())} it falls for ever'
		yield 'falls', seen, 'gravity in the direction in which bodies are to fall, or the body above what is to stop it'


def _lowest(body, down):
	"""How far down it reaches [m]; a wall that does not lie across gravity reaches for ever."""
	place = float(np.array(body.state.pos, float) @ down)
	if isinstance(body.shape, (Polytope, Box, Facet)):
		return float((worldVertices(body) @ down).max())
	if isinstance(body.shape, Sphere):
		return place + float(body.shape.radius)
	return place if isinstance(body.shape, Wall) and abs(down[body.shape.axis]) == 1 else np.inf
