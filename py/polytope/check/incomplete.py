# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that lack what every contact needs, of polytope.check(): YADE ends the process at them. Each yields (what, seen, advice)."""

from yade import Polytope

__all__ = ['incomplete']


def incomplete(scene):
	"""No other check can look at such a scene."""
	for body in scene.bodies:
		if body.material is None:
			yield 'material', f'body {body.id} has no material', f'O.bodies[{body.id}].material = O.materials[0], or that of its kind'
			return
	for body in scene.bodies:
		if isinstance(body.shape, Polytope) and not float(body.shape.volume) > 0:
			seen = f'body {body.id} has a Polytope without half-spaces: it touches nothing'
			yield 'shape', seen, 'make shapes by polytope.cuboid, polytope.fromVertices or polytope.fromHalfSpaces'
			return
	touching = {key for contact in scene.O.interactions if contact.isReal for key in (contact.id1, contact.id2)}
	for key in sorted(touching):
		if scene.O.bodies[key] is not None and scene.O.bodies[key].shape is None:
			yield 'shape', f'body {key} has no shape, and contacts from when it had one', 'erase it, O.bodies.erase(…), or give it a shape'
			return
