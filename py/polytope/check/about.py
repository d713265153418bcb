# SPDX-License-Identifier: GPL-2.0-or-later
"""What polytope.check() says of a scene that it finds no fault with: sizes, masses, gravity, which may be meant or not."""

import numpy as np
from yade import Box, Facet, Polytope, Sphere

from ..scene.movers import movers
from ..scene.radii import marginOf, outerRadius
from ..scene.vertices import worldVertices

__all__ = ['aboutScene', 'extentOf', 'extentOfSupports']


def aboutScene(scene):
	"""How many bodies can move, how large and heavy they are, the extent of what is fixed, gravity; nothing for a scene without bodies."""
	if not scene.bodies:
		return ''
	whole = [body for body in movers() if body.shape is not None or body.isClump]
	if not whole:
		return 'no body can move'
	said = [f'{len(whole)} bod{"y" if len(whole) == 1 else "ies"} can move']
	reaches = {body.id: reach for body in whole if (reach := _reach(scene, body))}
	if reaches:
		ends = [scene.O.bodies[choose(reaches, key=reaches.get)] for choose in (min, max)]
		said.append(f'{_span([_width(scene, body) for body in ends])} m across')
	said.append(f'{_span([float(body.state.mass) for body in whole])} kg')
	held = extentOfSupports(scene)
	fixed = (
		[f'what is fixed is {held:.3g} m across']
		if held
		else []
		if any(not scene.moves(body) for body in scene.bodies)
		else ['nothing is fixed']
	)
	gravity = [f'gravity is {tuple(float(f"{g:.6g}") for g in scene.totalGravity)} m/s²'] if scene.integrators else []
	return '; '.join([', '.join(said), *fixed, *gravity])


def _members(scene, clump):
	return [scene.O.bodies[k] for k in clump.shape.members]


def _reach(scene, body):
	"""Radius of a ball about its centre that holds it [m]; 0 for shapes whose size is not known here."""
	if body.isClump:
		parts = [(part, _reach(scene, part)) for part in _members(scene, body)]
		return max((float((part.state.pos - body.state.pos).norm()) + reach for part, reach in parts if reach), default=0.0)
	if isinstance(body.shape, Polytope):
		return outerRadius(body.shape)
	return float(body.shape.radius) if isinstance(body.shape, Sphere) and np.isfinite(body.shape.radius) else 0.0


def _width(scene, body):
	"""Largest edge of the box around it [m], in its own axes; for a clump, in those of the world."""
	if not body.isClump:
		return extentOf(body) if isinstance(body.shape, Polytope) else 2 * _reach(scene, body)
	corners = []
	for part in _members(scene, body):
		if isinstance(part.shape, Polytope):
			corners.append(worldVertices(part)[:, : part.shape.dimension])
		elif reach := _reach(scene, part):
			place = np.array(part.state.pos, float)
			corners.append(np.array([place - reach, place + reach]))
	return float(np.ptp(np.concatenate(corners), axis=0).max())


def _span(values):
	least, most = (f'{value:.3g}' for value in (min(values), max(values)))
	return least if least == most else f'{least} to {most}'


def extentOf(body):
	"""Largest edge of the box around a polytope in its own axes [m]."""
	corners = np.array(body.shape.vertices, float).reshape(-1, 3)[:, : body.shape.dimension]
	return float(np.ptp(corners, axis=0).max()) + 2 * marginOf(body.shape)


def extentOfSupports(scene):
	"""Largest edge of the box around all that cannot move [m]; walls are endless and tell nothing."""
	held = [body for body in scene.bodies if not scene.moves(body)]
	corners = [worldVertices(body) for body in held if isinstance(body.shape, (Polytope, Box, Facet))]
	return float(np.ptp(np.concatenate(corners), axis=0).max()) if corners else 0.0
