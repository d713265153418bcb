# SPDX-License-Identifier: GPL-2.0-or-later
"""A block whose face is pressed into a large flat one, in closed form: force, energy and depth of a contact surface.

The overlap is a cuboid of the face's sides and the depth h that the block has sunk. Its points with a slack of at least s are a cuboid that is smaller by 2 s along each
edge, so with A(t) the product of (side − t), V and W of src/contact/SurfaceContact.hpp are

	V = ½ ∫ (h − t) A(t) dt,     W = ¼ ∫ t (h − t) A(t) dt     from 0 to h.
"""

from numpy.polynomial import Polynomial
from scipy.optimize import brentq

__all__ = ['faceEnergy', 'faceForce', 'sunk']


def _volumes(h, sides):
	"""V, dV/dh, W, dW/dh."""
	area = Polynomial([1.0])
	for side in sides:
		area *= Polynomial([float(side), -1.0])
	t = Polynomial([0.0, 1.0])
	zeroth, first, second = ((weight * area).integ()(h) for weight in (1, t, t**2))
	return (h * zeroth - first) / 2, zeroth / 2, (h * first - second) / 4, first / 4


def faceForce(h, sides=(1.0, 1.0), perArea=False):
	"""Force over the stiffness: [m³] per area, [m] per contact. *sides*: of the face [m]; one for polygons, of unit thickness."""
	v, vGrows, w, wGrows = _volumes(float(h), sides)
	return 2 * vGrows if perArea else 36 * w / v * (wGrows * v - w * vGrows) / v**2


def faceEnergy(h, sides=(1.0, 1.0), perArea=False):
	"""Energy over the stiffness: [m⁴] per area, [m²] per contact."""
	v, _, w, _ = _volumes(float(h), sides)
	return 2 * v if perArea else 18 * (w / v) ** 2


def sunk(force, sides=(1.0, 1.0), perArea=False):
	"""How far the block sinks [m]; *force*: over the stiffness."""
	force = float(force)  # of YADE's numbers
	return brentq(lambda h: faceForce(h, sides, perArea) - force, 1e-12, float(min(sides)) / 4, xtol=1e-16, rtol=1e-15)
