# SPDX-License-Identifier: GPL-2.0-or-later
"""The check of the third dimension, of polytope.requirements(): whether all are prisms side by side, and what moves stays in the xy plane."""

import numpy as np
from yade import NewtonIntegrator, Polytope, Sphere, Vector3, Wall

from .worker import prismOutline

__all__ = ['dimension', 'polygons']

sideBySide = 0.5
"""Part of the least height that all heights must have in common: a polygon meets every other one, whatever its height. With less,
prisms may touch from above and below."""

rounding = 1e-9
"""Motion out of the plane, over that in it, that rounding accounts for: it accumulates over the steps, but stays far below this."""
alongALine, towardsAPlace = ('gravity', 'force'), ('accel', 'acceleration')
"""Attributes of engines that load bodies."""


def dimension(scene):
	"""third dimension"""
	if not scene.moving:
		return 'no body can move'
	if any(body.shape.dimension == 2 for body in scene.bodies):
		return 'polygons: contacts are solved in the plane', ''
	inPlane = all(set('zXY') <= set(body.state.blockedDOFs) for body in scene.moving)
	kept = inPlane or _staysInPlane(scene.O, scene.moving)
	if len(scene.bodies) < len(scene.O.bodies) or not kept or any(prismOutline(body) is None for body in scene.bodies):
		return 'bodies move in space', ''
	seen = f'prisms along z, {"blocked out of the xy plane" if inPlane else "moving in the xy plane"}'
	common, least = _heights(scene.bodies)
	if common < sideBySide * least:
		shared = f'only {common:.3g} m' if common > 0 else 'nothing'
		return f'{seen}, but not side by side in one plane: their z ranges have {shared} in common', ''
	advice = 'make the bodies with polytope.polygon(outline, thickness)' + ('' if inPlane else ', if they are to stay in the plane')
	return f'{seen}, solved in space', advice, None, ('dimension', 2)


def polygons(scene):
	"""polygons among solids"""
	flat = sum(body.shape.dimension == 2 for body in scene.bodies)
	others = [body.id for body in scene.O.bodies if body is not None and flat and not body.isClump and not _meetsPolygons(body.shape)]
	if not others:
		return f'{flat} polygons, and nothing that they cannot touch' if flat else 'no polygons', ''
	seen = f'{flat} polygon{"s" if flat > 1 else ""}, and {len(others)} bodies that polygons cannot touch (body {others[0]})'
	return seen, 'polyhedra for polygons, or the other way round: polygons touch polygons, walls along x and y, and spheres alone'


def _meetsPolygons(shape):
	if isinstance(shape, Polytope):
		return shape.dimension == 2
	return shape is None or isinstance(shape, Sphere) or isinstance(shape, Wall) and shape.axis < 2


def _heights(bodies):
	"""(what the z ranges of all these bodies have in common, the least of their heights) [m]; below zero if there is a gap."""
	heights = [[float((body.state.pos + body.state.ori * corner)[2]) for corner in body.shape.vertices] for body in bodies]
	low, high = (np.array([bound(one) for one in heights]) for bound in (min, max))
	return high.min() - low.max(), (high - low).min()


def _staysInPlane(O, moving):
	"""Whether velocities and loads of these bodies have no part out of the xy plane; False if nothing moves or drives them.

	Rounding is measured by the largest speed in the plane, and by what gravity there adds to it in a step: of bodies at rest rounding is all
	the motion there is.

	:param list moving: bodies
	"""
	loads = [getattr(engine, name) for engine in O.engines for name in alongALine if hasattr(engine, name)]
	loads = np.array([[float(x) for x in load] for load in [*loads, (0, 0, 0)]])
	central = any(getattr(engine, name, 0) for engine in O.engines for name in towardsAPlace)
	# permanent forces are not asked for: O.forces.permF reads out of bounds for bodies that have none
	if central or O.forces.getPermForceUsed() or np.abs(loads[:, 2]).max() > rounding * np.abs(loads).max():
		return False
	gravity = max((Vector3(engine.gravity).norm() for engine in O.engines if isinstance(engine, NewtonIntegrator)), default=0)
	size = min(float(body.shape.inscribedRadius) for body in moving)
	velocity, spin = (np.abs([[float(x) for x in getattr(body.state, name)] for body in moving]).max(axis=0) for name in ('vel', 'angVel'))
	scale = max(velocity[0], velocity[1], spin[2] * size, float(gravity) * float(O.dt))
	if scale == 0 and not loads.any():
		return False  # no motion to judge by
	return velocity[2] <= rounding * scale and max(spin[:2]) * size <= rounding * scale
