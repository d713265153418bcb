# SPDX-License-Identifier: GPL-2.0-or-later
"""A dry wall of four courses in running bond, on a base that leans: at which angle it topples. Page: docs/verification-wall.md."""

from math import atan, cos, degrees, sin

from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, O, RockJointMat, polytope

thick, course, length, courses, g = 0.4, 0.3, 0.6, 4, 9.81


def stands(part):
	"""At this part of the closed form; the base is tilted step by step, from rest to rest."""
	O.reset()
	O.materials.append(RockJointMat(density=2200, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.7))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	for k in range(courses):
		cuts = [-1, 0, 1] if k % 2 else [-1, -0.5, 0.5, 1]
		for low, high in zip(cuts, cuts[1:], strict=False):
			half = (thick / 2, (high - low) * length / 2, course / 2)
			O.bodies.append(polytope.cuboid((0, (low + high) * length / 2, (k + 0.5) * course), half))
	O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
	try:
		for lean in (0, 0.8 * closed, 0.9 * closed, part * closed):
			O.engines[3].gravity = (g * sin(lean), 0, -g * cos(lean))
			polytope.settle(unbalanced=1e-3, elastic=False, steps=10000)
	except polytope.NotAtRest:
		return False
	return True


closed = atan(thick / (courses * course))
for part in (0.97, 1.03):
	print(f'{part:g} times the closed form, {degrees(closed):.2f}°: {"stands" if stands(part) else "topples"}')
