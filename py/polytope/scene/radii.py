# SPDX-License-Identifier: GPL-2.0-or-later
"""Radii of shapes, with the margins of those that extensions derive from Polytope."""

import math

from yade import Polytope, _polytope

__all__ = ['inscribedRadius', 'marginOf', 'outerRadius']


def marginOf(shape):
	"""Radius of the ball around each point of a polytope [m]; 0 where it has none, or none that is a length."""
	margin = float(_polytope.marginOf(shape))
	return margin if 0 < margin < math.inf else 0.0


def inscribedRadius(shape):
	"""Radius of the largest ball inside [m]; infinite for what has none, such as walls."""
	if isinstance(shape, Polytope):
		return float(shape.inscribedRadius) + marginOf(shape)
	return float(getattr(shape, 'radius', math.inf))


def outerRadius(shape):
	"""Radius of the ball about a polytope's centre that holds it [m]."""
	return float(shape.circumscribedRadius) + marginOf(shape)
