# SPDX-License-Identifier: GPL-2.0-or-later
"""A block with friction and cohesion on a plane: its factor of safety. Page: docs/verification-plane.md."""

from math import cos, radians, sin, tan

from yade import O, RockJointMat, polytope

dip, friction, cohesion, density, g = radians(40), radians(30), 6e3, 5000, 9.81
O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=friction, cohesion=cohesion))
O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
O.bodies.append(polytope.cuboid((0, 0, 0.1), (0.5, 0.5, 0.1)))
O.engines = polytope.engines(gravity=(g * sin(dip), 0, -g * cos(dip)))  # gravity leans in place of the plane
polytope.settle()
weight, area = density * g * 0.2, 1.0
closed = (weight * cos(dip) * tan(friction) + cohesion * area) / (weight * sin(dip))
print(f'factor of safety {polytope.factorOfSafety().factor:.3f}, closed form {closed:.3f}')
