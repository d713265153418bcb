# SPDX-License-Identifier: GPL-2.0-or-later
"""A block slides on a base that is shaken: how far. Page: docs/verification-newmark.md."""

from math import atan

from yade import O, RockJointMat, polytope

friction, acceleration, duration, g = 0.3, 0.6, 0.3, 9.81  # tan φ; of the base [g]; of the pulse [s]
O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=atan(friction)))
base = O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 2, 0.5), fixed=True))
block = O.bodies.append(polytope.cuboid((0, 0, 0.5), (1, 1, 0.5)))
O.engines = polytope.engines(damping=0)
polytope.settle(unbalanced=1e-3)
velocity = acceleration * g * duration
record = polytope.velocityHistory([0, velocity, velocity], times=[0, duration, 2], kind='velocity', baseline=False)
polytope.baseMotion(base, record)


def lag():
	return float(O.bodies[base].state.pos[0] - O.bodies[block].state.pos[0])


before, end = lag(), O.time + 1.2
polytope.run(until=end)
closed = velocity**2 / (2 * friction * g) * (1 - friction / acceleration)
print(f'slides by {lag() - before:.4f} m, closed form {closed:.4f} m')
