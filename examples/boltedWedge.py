# SPDX-License-Identifier: GPL-2.0-or-later
"""Roof wedge between two joints that a horizontal force presses: its factor of safety without and with a bolt, beside theory.

./run python examples/boltedWedge.py
"""

from math import atan, radians, tan

from yade import O, RockJointMat, polytope
from yade.polytope.strengthReduction import StrengthReduction

lean, friction, pressed, height, gravity = radians(20), radians(60), 8e3, 0.8, 9.81


def factors(pull):
	"""(measured, closed form) of a wedge 1 m long with a bolt of this yield force [N]."""
	O.reset()
	O.materials.append(RockJointMat(density=2500, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=friction))
	low, high = tan(lean), 0.2 * tan(lean)
	wedge = O.bodies.append(block([(-low, 0), (low, 0), (-high, height), (high, height)]))
	for side in (-1, 1):
		rock = O.bodies[O.bodies.append(block([(side * x, z) for x, z in ((low, 0), (high, height), (1.4, 0), (1.4, height))]))]
		rock.state.blockedDOFs = 'yzXYZ'
		O.forces.setPermF(rock.id, (-side * pressed, 0, 0))
	O.bodies.append(polytope.cuboid((0, 0, 2), (2, 0.5, 0.5), fixed=True))
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.4)
	O.run(500, wait=True)  # pressed first: a wedge that falls has no friction
	O.engines[3].gravity = (0, 0, -gravity)
	if pull:
		polytope.bolt((0, 0, 0), (0, 0, 2.2), area=5e-4, youngsModulus=2e11, pretension=pull, yieldForce=pull)
	weight = O.bodies[wedge].state.mass * gravity
	return StrengthReduction([wedge], steps=(0.1, 0.01)).run().factor, tan(friction) / tan(lean + atan((weight - pull) / (2 * pressed)))


def block(corners):
	return polytope.fromVertices([(x, y, z) for y in (-0.5, 0.5) for x, z in corners])


for pull in (0, 2000, 4000, 6000):
	print('bolt {:4d} N: factor of safety {:.3f}, closed form {:.3f}'.format(pull, *factors(pull)))
