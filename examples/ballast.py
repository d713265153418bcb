# SPDX-License-Identifier: GPL-2.0-or-later
"""Railway ballast under a sleeper whose load comes and goes; prints the settlement after each cycle, draws it.

./run python examples/ballast.py          less than a minute; writes output/ballast.png
"""

from math import cos, pi, radians

from yade import NewtonIntegrator, O, RockJointMat, polytope

curve = [(0.0315, 0), (0.04, 0.3), (0.05, 0.7), (0.063, 1)]  # openings of sieves [m], part of the mass that passes
long, wide, high = 0.36, 0.2, 0.7  # the box [m]
largest, period, cycles = 2e3, 0.05, 4  # load [N], duration of a cycle [s]

O.materials.append(RockJointMat(density=2700, normalStiffness=5e8, shearStiffness=3.5e8, frictionAngle=radians(40)))
box = O.bodies.append(polytope.plates((0, 0, 0), (long, wide, high), without='+z', color=(0.8, 0.8, 0.78)))
stones = polytope.grains(curve, mass=9, elongation=(0.6, 1), flatness=(0.6, 1), seed=1)
for number, stone in enumerate(stones):
	stone.shape.color = [(0.42, 0.42, 0.44), (0.52, 0.5, 0.48), (0.6, 0.58, 0.55)][number % 3]
ballast = O.bodies.append(polytope.cloud((0, 0, 0), (long, wide, high), stones, seed=1))
O.engines = polytope.engines(integrator=NewtonIntegrator(damping=0.4, gravity=(0, 0, -9.81)))
polytope.run(until=0.5)

top = max(O.bodies[k].state.pos[2] + O.bodies[k].shape.circumscribedRadius for k in ballast)
place, half = (long / 2, wide / 2, top + 0.04), (0.09, 0.095, 0.04)
sleeper = O.bodies.append(polytope.cuboid(place, half, color=(0.55, 0.4, 0.28)))
state = O.bodies[sleeper].state
state.blockedDOFs = 'xyXYZ'  # it moves along z alone
polytope.run(until=0.65)

began, first, settlement = O.time, state.pos[2], []
for cycle in range(1, cycles + 1):
	while O.time < began + cycle * period:
		load = largest / 2 * (1 - cos(2 * pi * (O.time - began) / period))
		O.forces.setPermF(sleeper, (0, 0, -load))
		O.run(5, wait=True)
	settlement.append(first - state.pos[2])
	print(f'{len(ballast)} stones, {cycle} cycles: settlement {1e3 * settlement[-1]:.1f} mm')
polytope.picture('output/ballast.png', view=(-0.5, -1, 0.5), fixed=lambda body: 'solid' if body.id == box[4] else 'hidden')
