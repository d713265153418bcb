# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's own shapes as polytope.contact() can meet them, for polytope.check()."""

import numpy as np

from ..bodies.halfSpaces import boxPlanes, halfSpacesOf
from ..bodies.polytopes import fromHalfSpaces
from ..scene.vertices import worldVertices

__all__ = ['standIn']

behind = 4.0
"""Circumscribed radii of the body from its middle at which a wall or facet ends behind its surface: so far away that no other face of it is
the nearest one."""


def standIn(support, body):
	"""A wall, facet or box by its half-spaces as the body meets them, as a polytope; None where the body is on the far side of one of them."""
	normals, offsets = halfSpacesOf(support, body.state.pos)
	corners, middle, reach = worldVertices(body), np.array(body.state.pos, float), float(body.shape.circumscribedRadius)
	if (normals @ corners.T - offsets[:, None]).min(axis=1).max() > 0:
		return None
	box = boxPlanes(middle - behind * reach, middle + behind * reach)
	try:
		return fromHalfSpaces(
			np.concatenate([normals, box[0]]),
			np.concatenate([offsets, box[1]]),
			material=body.material,
			color=(1, 1, 1),
		)
	except ValueError:  # a box without thickness, a facet without area
		return None
