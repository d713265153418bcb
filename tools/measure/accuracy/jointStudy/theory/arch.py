# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit analysis of a semicircular masonry arch (Heyman 1966, Int. J. Solids Struct. 2:249-279), by linear programs.

n rigid voussoirs with straight edges between radial joints, mean radius 1, thickness t, unit weight 1. Joints take no tension, and
slip at their friction angle. The arch stands (lower bound theorem) if some normal force N, shear S and moment M at each joint are in
equilibrium with the weights, |M| ≤ N t/2 and |S| ≤ N tan φ. All follow from the force and moment at one springing: three unknowns.
"""

import math

import numpy as np
from scipy.optimize import linprog

__all__ = ['archStands', 'leastThickness', 'voussoir']


def voussoir(thickness, blocks):
	"""Area and radius of the centroid of one of the blocks: a trapezium between the radii 1 ± t/2."""
	inner, outer, half = 1 - thickness / 2, 1 + thickness / 2, math.pi / (2 * blocks)
	area = (outer**2 - inner**2) * math.sin(half) * math.cos(half)
	return area, 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2) * math.cos(half)


def _resultants(thickness, blocks):
	"""Normal force, shear and moment about the joint's middle at all joints, for each unknown (3 rows) and the weights (the last).

	The unknowns are the force (−H, V) and the moment at the right springing, on the arch. At joint j, at the angle q from the right, acts
	what these and the weights of the blocks between add up to.
	"""
	area, radius = voussoir(thickness, blocks)
	q = np.linspace(0, math.pi, blocks + 1)
	middle = (q[:-1] + q[1:]) / 2
	weight = area * np.arange(blocks + 1)
	momentOfWeights = np.concatenate([[0], np.cumsum(area * radius * np.cos(middle))])
	x, y, one = np.cos(q), np.sin(q), np.ones_like(q)
	# force (x, y) and moment about the joint's middle, for H, V, M and the weights
	force = np.array([[-one, 0 * q, 0 * q, 0 * q], [0 * q, one, 0 * q, -weight]])
	moment = np.array([-y, 1 - x, one, -(momentOfWeights - x * weight)])
	normal = force[0] * -y + force[1] * x
	shear = force[0] * x + force[1] * y
	return normal, shear, moment


def archStands(thickness, blocks, frictionAngle):
	"""Whether some forces in equilibrium stay within all joints.

	:param float thickness: over the mean radius
	:param float frictionAngle: [rad]
	"""
	normal, shear, moment = _resultants(thickness, blocks)
	friction = math.tan(frictionAngle)
	rows = np.hstack([sign * m - limit * normal for m, limit in ((moment, thickness / 2), (shear, friction)) for sign in (1, -1)])
	return linprog([0, 0, 0], A_ub=rows[:3].T, b_ub=-rows[3], bounds=[(None, None)] * 3).status == 0


def leastThickness(blocks, frictionAngle, accuracy=1e-7):
	"""Least thickness over mean radius at which the arch stands.

	:raises ValueError: if the arch does not even stand with a thickness of 1: it slips
	"""
	low, high = 0.0, 1.0
	if not archStands(high, blocks, frictionAngle):
		raise ValueError(f'frictionAngle: {math.degrees(frictionAngle):g}° is too little, the arch slips at any thickness')
	while high - low > accuracy:
		middle = (low + high) / 2
		low, high = (low, middle) if archStands(middle, blocks, frictionAngle) else (middle, high)
	return high
