# SPDX-License-Identifier: GPL-2.0-or-later
"""A cube of bonded Voronoi cells is crushed between two plates; prints its strength and where the work of the plate went, draws it.

./run python examples/crushedCube.py
"""

from math import radians

from yade import NewtonIntegrator, O, RockJointMat, polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=1e10, shearStiffness=5e9, frictionAngle=radians(35)))
O.bodies.append(polytope.cuboid((0.5, 0.5, -0.1), (1, 1, 0.1), fixed=True))
plate = O.bodies.append(polytope.cuboid((0.5, 0.5, 1.1), (1, 1, 0.1), fixed=True))
cells = O.bodies.append([polytope.fromHalfSpaces(*block) for block in polytope.voronoi(((0, 0, 0), (1, 1, 1)), 40, seed=1).blocks])
O.engines = polytope.engines(integrator=NewtonIntegrator(damping=0))
made = polytope.bond(ids=cells, tensileStrength=2e6, cohesion=4e6)
O.trackEnergy = True

speed = 0.5
O.bodies[plate].state.vel = (0, 0, -speed)
work = force = strength = 0
while O.time < 0.02:
	O.step()
	before, force = force, O.forces.f(plate)[2]
	work += (before + force) / 2 * speed * O.dt
	strength = max(strength, force)

moving = sum(O.bodies[k].state.mass * O.bodies[k].state.vel.squaredNorm() / 2 for k in cells)  # of turning there is little
parts = dict(moving=moving, stored=O.energy['elastPotential'], broken=O.energy['fractureDissip'], slid=O.energy['plastDissip'])
parts['damped'] = O.energy['normDampDissip'] + O.energy['shearDampDissip']
print(f'largest stress {strength / 1e6:.2f} MPa; {polytope.bonds().intactCount} of {made} bonds are intact')
print(f'work {work:.5g} J:', ', '.join(f'{name} {100 * value / work:.2f} %' for name, value in parts.items()))
print(f'missing: {100 * (1 - sum(parts.values()) / work):.2f} %')
polytope.picture(
	'output/crushedCube.png',
	colorBy='displacement',
	legend='moved [m]',
	fixed=lambda body: 'glass' if body.id == plate else 'solid',
	view=(-0.6, -1, 0.25),
	size=(1200, 1000),
)
