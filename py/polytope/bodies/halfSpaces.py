# SPDX-License-Identifier: GPL-2.0-or-later
"""Half-spaces of bodies in world axes."""

import numpy as np
from yade import Vector3, _polytope

__all__ = ['halfSpacesOf']


def halfSpacesOf(body, seenFrom):
	"""(unit normals (n, 3), offsets (n,)) of a polytope, wall, facet or box as a body whose middle is at this point meets it."""
	normals, offsets = (np.frombuffer(numbers) for numbers in _polytope.supportPlanes(body, Vector3(*seenFrom)))
	return normals.reshape(-1, 3), offsets
