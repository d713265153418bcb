# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains in a rotating drum; prints the inclination of the heap, draws it.

./run python examples/drum.py          about a minute; writes output/drum.png
"""

from math import atan2, degrees, pi, radians

import numpy as np
from yade import NewtonIntegrator, O, Quaternion, RockJointMat, RotationEngine, polytope

radius, length, speed = 0.1, 0.08, 2.0
O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=5e7, frictionAngle=radians(35)))
ends = O.bodies.append([polytope.cuboid((0, side * (length / 2 + 0.01), 0), (0.12, 0.01, 0.12), fixed=True) for side in (-1, 1)])
staves = O.bodies.append(polytope.tube(radius, length, number=24, orientation=Quaternion((1, 0, 0), pi / 2), color=(0.75, 0.75, 0.72)))
grains = polytope.grains([(0.016, 0), (0.022, 1)], mass=0.45, elongation=(0.7, 1), flatness=(0.7, 1), seed=1)
inside = O.bodies.append(polytope.cloud((-0.065, -0.035, -0.065), (0.065, 0.035, 0.065), grains, seed=1))

drum = RotationEngine(ids=staves, rotationAxis=(0, 1, 0), zeroPoint=(0, 0, 0), rotateAroundZero=True, angularVelocity=0)
O.engines = [drum] + polytope.engines(integrator=NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)))


def inclination():
	"""Inclination of the heap, from its centre of mass [°]: 0 at rest in a round drum, positive where the wall carries grains to."""
	weights = np.array([O.bodies[k].state.mass for k in inside])
	x, _, z = np.average([O.bodies[k].state.pos for k in inside], axis=0, weights=weights)
	return degrees(atan2(-x, -z))


polytope.run(until=0.3)
drum.angularVelocity = speed
angles = []
while O.time < 2.3:
	polytope.run(100)
	angles.append(inclination())
print(f'{len(inside)} grains; inclination of the heap at the end {np.mean(angles[len(angles) // 2 :]):.0f}°')
for number, stave in enumerate(staves):
	O.bodies[stave].shape.color = (0.75, 0.75, 0.72) if number % 2 else (0.55, 0.6, 0.65)
polytope.picture('output/drum.png', view=(0.15, -1, 0.25), fixed=lambda body: 'hidden' if body.id == ends[0] else 'solid')
