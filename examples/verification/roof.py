# SPDX-License-Identifier: GPL-2.0-or-later
"""A wedge in a tunnel's roof between two joints that the rock's horizontal force presses: at which friction it falls. Page: docs/verification-roof.md."""

from math import atan, degrees, radians, tan

from yade import O, RockJointMat, polytope
from yade.polytope.frictionReduction import FrictionReduction

lean, pressed, height, density, g = radians(20), 8e3, 0.8, 2500, 9.81  # of the joints; force per metre of tunnel [N/m]


def block(corners):
	return polytope.fromVertices([(x, y, z) for y in (-0.5, 0.5) for x, z in corners])


O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(60)))
low, high = tan(lean), 0.2 * tan(lean)
wedge = O.bodies.append(block([(-low, 0), (low, 0), (-high, height), (high, height)]))
for side in (-1, 1):
	rock = O.bodies[O.bodies.append(block([(side * x, z) for x, z in ((low, 0), (high, height), (1.4, 0), (1.4, height))]))]
	rock.state.blockedDOFs = 'yzXYZ'
	O.forces.setPermF(rock.id, (-side * pressed, 0, 0))
O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.4)
O.run(500, wait=True)  # pressed first: a wedge that falls has no friction
O.engines[3].gravity = (0, 0, -g)
found = FrictionReduction([wedge], start=radians(60), steps=[radians(s) for s in (2, 0.5, 0.1)]).run()
weight = float(O.bodies[wedge].state.mass) * g
closed = degrees(lean + atan(weight / (2 * pressed)))
print(f'falls at a friction angle of {degrees(found.critical):.2f}°, closed form {closed:.2f}°')
