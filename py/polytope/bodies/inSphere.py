# SPDX-License-Identifier: GPL-2.0-or-later
"""How deep a polytope lies in a sphere."""

import numpy as np
import scipy

from .halfSpaces import halfSpacesOf

__all__ = ['depthInSphere']


def depthInSphere(body, sphere):
	"""How deep the polytope lies in YADE's sphere [m]; below zero: how far it is from it."""
	centre, radius = np.array(sphere.state.pos, float), float(sphere.shape.radius)
	normals, offsets = halfSpacesOf(body, centre)
	slacks = offsets - normals @ centre
	return radius + float(slacks.min()) if slacks.min() >= 0 else radius - _distance(normals, slacks)


def _distance(normals, slacks):
	"""
	From the origin to the nearest x with normals · x ≤ slacks: least distance programming by non-negative least squares
	(C. L. Lawson & R. J. Hanson, Solving least squares problems, 1974, chapter 23).
	"""
	scale = np.abs(slacks).max()
	matrix = np.vstack([-normals.T, -slacks / scale])
	target = np.array([0.0, 0.0, 0.0, 1.0])
	residual = matrix @ scipy.optimize.nnls(matrix, target)[0] - target
	return scale * float(np.linalg.norm(residual[:3] / residual[3]))
