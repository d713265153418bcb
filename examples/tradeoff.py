# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost and accuracy of settings in a scene of your own: three blocks dropped on each other, four settings, one table.

./run python examples/tradeoff.py          prints the table, writes output/tradeoff.csv
"""

import os
from math import radians

from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	RockJointMat,
	polytope,
)


def build():
	"""The scene, ready to run. Each setting gets a process of its own, which calls this."""
	O.materials.append(RockJointMat(normalStiffness=2.5e8, shearStiffness=2.5e8, frictionAngle=radians(30), density=2600))
	O.bodies.append(polytope.cuboid((0, 0, -0.1), (1, 1, 0.1), fixed=True))
	for k in range(3):
		O.bodies.append(polytope.cuboid((0.02 * k, 0, 0.101 + 0.201 * k), (0.1, 0.1, 0.1)))
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.01),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom()],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys()],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, shearDamping=0.3)],
		),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.2),
	]
	O.dt = 1e-4


def measure():
	"""The number that matters: where the highest block comes to rest [m]."""
	for _ in range(10000):
		O.step()
	return O.bodies[3].state.pos[2]


settings = {
	'as it is': {},
	'time step × 2': {'timeStepFactor': 2},
	'cold start': {'warmStart': False},
	"the paper's contact": {'contactModel': 'boon2012'},
}

if __name__ == '__main__':  # true no more after `from yade import *`, which brings a __name__ of its own: see polytope.tradeoff
	weight, perArea = 9.81 * 2600 * 0.2**3, 2.5e8
	atRest = 0.5
	for blocks, middle, width in ((3, 0, 0.2), (2, 0.01, 0.18), (1, 0.03, 0.18)):
		load = (
			blocks * weight
		)  # on this contact; it acts where the blocks above have their centre, and an elastic foundation yields and tilts
		arm = (0.02 * 2 + 0.02 * (3 - blocks)) / 2 - middle
		stiffness = perArea * width * 0.2
		atRest -= load / stiffness + load * arm / (stiffness * width**2 / 12) * (0.04 - middle)
	table = polytope.tradeoff(build, settings, measure, reference=atRest)
	table.show()
	os.makedirs('output', exist_ok=True)
	table.csv('output/tradeoff.csv')
	print('On the Pareto front:', ', '.join(row.name for row in table.front()))
