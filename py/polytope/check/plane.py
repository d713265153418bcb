# SPDX-License-Identifier: GPL-2.0-or-later
"""The third dimension, of polytope.check(O, costs=True): whether all bodies are prisms side by side, and what moves stays in the xy plane."""

import numpy as np
from yade import O, Polytope

from ..bodies.halfSpaces import worldPlanes
from ..bodies.polytopes import polygon
from ..scene.present import gravityOf
from ..scene.vertices import worldVertices

__all__ = ['dimension', 'makePolygons']

sideBySide = 0.5
"""Part of the least height that all heights must have in common: a polygon meets every other one, whatever its height. With less,
prisms may touch from above and below."""

flat = 1e-9
"""Deviation up to which a normal counts as in the plane, or normal to it."""
rounding = 1e-9
"""Motion out of the plane, over that in it, that rounding accounts for: it accumulates over the steps, but stays far below this."""
alongALine, towardsAPlace = ('gravity', 'force'), ('accel', 'acceleration')
"""Attributes of engines that load bodies."""


def dimension(scene):
	"""Yields (what, seen, advice, trial) where polygons would do."""
	bodies, moving = scene.bodies, [body for body in scene.bodies if body.dynamic]
	if not moving or any(not isinstance(body.shape, Polytope) or body.shape.dimension == 2 for body in bodies):
		return
	inPlane = all(set('zXY') <= set(body.state.blockedDOFs) for body in moving)
	kept = inPlane or _staysInPlane(scene.O, moving)
	if len(bodies) < len(scene.O.bodies) or not kept or any(_outline(body) is None for body in bodies):
		return
	common, shortest = _heights(bodies)
	if common < sideBySide * shortest:
		return
	seen = f'prisms along z, {"blocked out of the xy plane" if inPlane else "moving in the xy plane"}, solved in space'
	advice = 'make the bodies with polytope.polygon(outline, thickness)' + ('' if inPlane else ', if they are to stay in the plane')
	yield 'third dimension', seen, advice, ('dimension', 2)


def _outline(body):
	"""Corners of the cross-section of a polyhedron that is a prism along z where it is, in order, as (n, 2) array; None if it is none."""
	along = np.abs(worldPlanes(body)[0][:, 2])
	if not np.all((along < flat) | (along > 1 - flat)):
		return None
	corners = worldVertices(body)
	return corners[corners[:, 2] > corners[:, 2].mean(), :2]


def makePolygons():
	"""Polygons in place of all bodies of the scene, which are prisms; they keep material, place and motion. Contacts are found anew."""
	bodies = []
	for body in O.bodies:
		height = float(np.ptp(worldVertices(body)[:, 2]))
		made = polygon(_outline(body).tolist(), thickness=height, material=body.material, fixed=not body.dynamic)
		made.shape.cornerRadius = min(body.shape.cornerRadius, 0.9 * made.shape.inscribedRadius)
		made.state.vel, made.state.angVel = body.state.vel, body.state.angVel
		bodies.append(made)
	O.interactions.clear()
	O.bodies.clear()
	O.bodies.append(bodies)


def _heights(bodies):
	"""(what the z ranges of all these bodies have in common, the least of their heights) [m]; below zero if there is a gap."""
	low, high = (np.array([bound(worldVertices(body)[:, 2]) for body in bodies]) for bound in (np.min, np.max))
	return high.min() - low.max(), (high - low).min()


def _staysInPlane(O, moving):
	"""Whether velocities and loads of these bodies have no part out of the xy plane; False if nothing moves or drives them.

	Rounding is measured by the largest speed in the plane, and by what gravity there adds to it in a step: for bodies at rest, rounding is all
	the motion there is.

	:param list moving: bodies
	"""
	loads = [getattr(engine, name) for engine in O.engines for name in alongALine if hasattr(engine, name)]
	loads = np.array([[float(x) for x in load] for load in [*loads, (0, 0, 0)]])
	central = any(getattr(engine, name, 0) for engine in O.engines for name in towardsAPlace)
	# permanent forces are not asked for: O.forces.permF reads out of bounds for bodies that have none
	if central or O.forces.getPermForceUsed() or np.abs(loads[:, 2]).max() > rounding * np.abs(loads).max():
		return False
	gravity = gravityOf().norm()
	size = min(float(body.shape.inscribedRadius) for body in moving)
	velocity, spin = (np.abs([[float(x) for x in getattr(body.state, name)] for body in moving]).max(axis=0) for name in ('vel', 'angVel'))
	scale = max(velocity[0], velocity[1], spin[2] * size, float(gravity) * float(O.dt))
	if scale == 0 and not loads.any():
		return False  # no motion to judge by
	return velocity[2] <= rounding * scale and max(spin[:2]) * size <= rounding * scale
