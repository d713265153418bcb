# SPDX-License-Identifier: GPL-2.0-or-later
"""Sixteen columns topple over a stepped base: at which friction angle, beside limit equilibrium (Goodman & Bray 1976). Half a minute.

./run python examples/goodmanBray.py           ends with 1 where both are half a degree apart"""

import sys
from math import cos, degrees, radians, sin, tan

from scipy.optimize import brentq
from yade import O, RockJointMat, polytope
from yade.polytope.frictionReduction import FrictionReduction

dip, width, weight = radians(30), 10.0, 25e3  # of the bases; of the columns [m]; of a cubic metre [N]
heights = [4.0 * n for n in range(1, 11)] + [40 - 6.2 * n for n in range(1, 7)]  # from the toe up; the tenth is at the crest


def pushOnTheLowest(friction):
	"""From the top column down each pushes the next one, by what it lacks to stand against toppling or sliding."""
	push, tangent = 0.0, tan(friction)
	for n, height in reversed(list(enumerate(heights, 1))):
		load = weight * width * height
		upper, lower = (height if n < 10 else height - 5.2), (height - 5 if n <= 10 else height)  # where the neighbours push
		topple = 0.0
		if n > 1 and (push > 0 or height * tan(dip) > width):
			topple = (push * (upper - width * tangent) + load / 2 * (height * sin(dip) - width * cos(dip))) / lower
		push = max(0.0, topple, push - load * (cos(dip) * tangent - sin(dip)) / (1 - tangent**2))
	return push


O.materials.append(RockJointMat(density=weight / 9.81, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(50)))
columns = []
for n, height in enumerate(heights):
	left, right, step = width * n, width * (n + 1), n + 1.0
	O.bodies.append(polytope.polygon([(left, step - 30), (right, step - 30), (right, step), (left, step)], fixed=True))
	columns.append(O.bodies.append(polytope.polygon([(left, step), (right, step), (right, step + height), (left, step + height)])))
O.engines = polytope.engines(gravity=(-9.81 * sin(dip), -9.81 * cos(dip), 0), damping=0.4)
found = FrictionReduction(columns, start=radians(50), steps=[radians(2), radians(0.5), radians(0.1)]).run()
exact = brentq(lambda friction: pushOnTheLowest(friction) - 1, radians(35), radians(42))  # 1 N: the lowest slides
print(f'stands at {degrees(found.stable):.1f}°, fails at {degrees(found.failed):.1f}°; limit equilibrium {degrees(exact):.2f}°')
sys.exit(abs(found.critical - exact) > radians(0.5))
