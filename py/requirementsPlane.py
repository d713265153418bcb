# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether what moves stays in the xy plane by itself: its motion, and what drives it."""

import numpy as np
from yade import NewtonIntegrator, Vector3

__all__ = ['staysInPlane']

rounding = 1e-9
"""Motion out of the plane, over that in it, that rounding accounts for: it gathers over the steps, but stays far below this."""
alongALine, towardsAPlace = ('gravity', 'force'), ('accel', 'acceleration')
"""Attributes of engines that load bodies."""


def staysInPlane(O, moving):
	"""Whether velocities and loads of these bodies have no part out of the xy plane; False if nothing moves or drives them.

	Rounding is measured by the largest speed in the plane, and by what gravity there adds to it in a step: of bodies at rest rounding is all
	the motion there is.

	:param list moving: bodies
	"""
	loads = [getattr(engine, name) for engine in O.engines for name in alongALine if hasattr(engine, name)]
	loads = np.array([[float(x) for x in load] for load in [*loads, (0, 0, 0)]])
	central = any(getattr(engine, name, 0) for engine in O.engines for name in towardsAPlace)
	# permanent forces are not asked for: O.forces.permF reads beyond what is there for bodies that have none
	if central or O.forces.getPermForceUsed() or np.abs(loads[:, 2]).max() > rounding * np.abs(loads).max():
		return False
	gravity = max((Vector3(engine.gravity).norm() for engine in O.engines if isinstance(engine, NewtonIntegrator)), default=0)
	size = min(float(body.shape.inscribedRadius) for body in moving)
	velocity, spin = (np.abs([[float(x) for x in getattr(body.state, name)] for body in moving]).max(axis=0) for name in ('vel', 'angVel'))
	scale = max(velocity[0], velocity[1], spin[2] * size, float(gravity) * float(O.dt))
	if scale == 0 and not loads.any():
		return False  # nothing to tell from
	return velocity[2] <= rounding * scale and max(spin[:2]) * size <= rounding * scale
