# SPDX-License-Identifier: GPL-2.0-or-later
"""Plane failure of a slope with water in a tension crack and on the plane: its factor of safety. Page: docs/verification-tension-crack.md."""

from math import cos, radians, sin, tan

from yade import O, RockJointMat, polytope

high, face, plane, crack, cohesion, friction, g = 60.0, radians(60), radians(35), 14.0, 1e5, radians(35), 9.81
back, foot, weight = (high - crack) / tan(plane), high - crack, 1000 * g  # of the plane's upper end; water [N/m³]
strength = dict(frictionAngle=friction, cohesion=cohesion, residualCohesion=cohesion)
O.materials.append(RockJointMat(density=26e3 / g, normalStiffness=1e10, shearStiffness=1e10, **strength))
O.bodies.append(polytope.polygon([(-9, -9 * tan(plane)), (-9, -20), (90, -20), (90, 90 * tan(plane))], fixed=True))
block = O.bodies.append(polytope.polygon([(0, 0), (back, foot), (back, high), (high / tan(face), high)]))
O.engines = polytope.engines(gravity=(0, -g, 0), damping=0.4)


def faceTowards(x, y):
	return lambda one: one.body == block and one.normal @ (x, y, 0) > 0.999


full = 7.0  # water in the crack [m]; its pressure falls to zero along the plane down to the toe
polytope.water(level=foot + full, faces=faceTowards(1, 0))
polytope.water(pressures=[((back, foot), weight * full), ((0, 0), 0)], faces=faceTowards(sin(plane), -cos(plane)))
polytope.settle()
length, load = foot / sin(plane), float(O.bodies[block].state.mass) * g
uplift, thrust = weight * full * length / 2, weight * full**2 / 2
closed = (cohesion * length + (load * cos(plane) - uplift - thrust * sin(plane)) * tan(friction)) / (
	load * sin(plane) + thrust * cos(plane)
)
print(f'factor of safety {polytope.factorOfSafety().factor:.3f}, closed form {closed:.3f}')
