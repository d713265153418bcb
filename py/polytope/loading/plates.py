# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates with edges, where walls without ends do not do: those of the shear tests."""

import numpy as np
from yade import O, Vector3

from ..bodies.polytopes import cuboid
from .walls import boundaryMask, withoutEachOther

__all__ = ['force', 'moveTo', 'plate', 'replaced']

thickness = 0.25
"""Thickness of plates over the sample's length: what a shear box may be displaced without opening to its side."""


def plate(lower, upper, material):
	"""A fixed plate in the scene; returns its id. Plates and walls of a boundary do not meet each other and may overlap."""
	low, high = np.array(lower, float), np.array(upper, float)
	return O.bodies.append(
		cuboid(tuple((low + high) / 2), tuple((high - low) / 2), material=material, fixed=True, mask=boundaryMask, wire=True)
	)


def replaced(walls):
	"""Erases walls; their contacts end."""
	for k in walls:
		O.bodies.erase(k)
	withoutEachOther()


def moveTo(k, place, spin=0.0):
	"""Velocity with which the body is at this place [m] after the step, and its rate of rotation about y [rad/s]."""
	state, dt = O.bodies[k].state, float(O.dt)
	state.vel = Vector3(*((np.array(place) - np.array(state.pos, float)) / dt).tolist())
	state.angVel = Vector3(0, float(spin), 0)


def force(*several):
	"""Force of the bodies on these plates together [N]."""
	return sum(np.array(O.forces.f(k, sync=True), float) for k in several)
