# SPDX-License-Identifier: GPL-2.0-or-later
"""A semicircular masonry arch of eight stones: how thin it may be. Page: docs/verification-arch.md."""

import numpy as np
from scipy.optimize import linprog
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, O, RockJointMat, polytope

count, density, g, tangent = 8, 2000, 9.81, 57.0  # mean radius 1; tan φ
q = np.linspace(0, np.pi, count + 1)  # of the joints, from the right


def mayStand(thick):
	"""Limit analysis: whether some force and moment at the right springing keep the thrust within all joints (Heyman 1966)."""
	low, high, half = 1 - thick / 2, 1 + thick / 2, np.pi / 2 / count
	lever = 2 / 3 * (high**3 - low**3) / (high**2 - low**2) * np.cos(half) * np.cos((q[1:] + q[:-1]) / 2)
	weight, moments, x, y, one = np.arange(count + 1), np.concatenate([[0], np.cumsum(lever)]), np.cos(q), np.sin(q), np.ones_like(q)
	across, along = np.array([-one, 0 * q, 0 * q, 0 * q]), np.array([0 * q, one, 0 * q, -weight])
	normal, shear, moment = across * -y + along * x, across * x + along * y, np.array([-y, 1 - x, one, x * weight - moments])
	rows = np.hstack([side * m - limit * normal for m, limit in ((moment, thick / 2), (shear, tangent)) for side in (1, -1)])
	return linprog([0, 0, 0], rows[:3].T, -rows[3], bounds=[(None, None)] * 3).status == 0


def stands(thick):
	O.reset()
	O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=np.arctan(tangent)))
	for a, b in zip(q, q[1:], strict=False):
		O.bodies.append(polytope.polygon([(r * np.cos(c), r * np.sin(c)) for r in (1 - thick / 2, 1 + thick / 2) for c in (a, b)]))
	for side in (-1, 1):
		O.bodies.append(polytope.polygon([(side * x, y) for x in (1 - thick, 1 + thick) for y in (-0.2, 0)], fixed=True))
	O.engines = polytope.engines(gravity=(0, -g, 0), physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
	try:
		return polytope.settle(unbalanced=1e-4, elastic=False, steps=60000) > 0
	except polytope.NotAtRest:
		return False


least = next(thick for thick in np.arange(0.05, 0.2, 1e-4) if mayStand(thick))
for part in 0.98, 1.02:
	print(f'{part:g} times the least thickness, closed form {least:.4f}: {"stands" if stands(part * least) else "falls"}')
