# SPDX-License-Identifier: GPL-2.0-or-later
"""Coefficient of restitution over `normalDamping` of the law: measured on a cube that hits a fixed plate, beside the closed form.

./run python examples/restitution.py
"""

from math import acos, atan2, exp, pi, sqrt

from tabulate import tabulate
from yade import (
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeTimeStepper,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
)

turns = {
	'face': Quaternion.Identity,
	'edge': Quaternion((1, 0, 0), pi / 4),
	'vertex': Quaternion((sqrt(0.5), -sqrt(0.5), 0), acos(1 / sqrt(3))),
}
"""What the cube hits the plate with: its centroid is above the middle of that."""
speed, shares = 1.0, (0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7)


def theory(damping):
	"""Coefficient of restitution of a linear spring and dashpot that do not pull, for a fraction of critical damping below 1.

	T. Schwager, T. Pöschel (2007), Coefficient of restitution and linear-dashpot model revisited, Granular Matter 9:465-469.
	"""
	root = sqrt(1 - damping**2)
	return exp(-damping / root * (pi - atan2(2 * damping * root, 1 - 2 * damping**2)))


def measured(damping, turn, fraction=0.4):
	"""Speed after the collision over that before it, without gravity.

	:param fraction: of the safe time step; 0.4 is PolytopeTimeStepper's default
	"""
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0))
	O.bodies.append(polytope.cuboid((0, 0, -0.05), (0.2, 0.2, 0.05), fixed=True))
	cube = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0), (0.05, 0.05, 0.05), orientation=turn, velocity=(0, 0, -speed)))]
	lowest = min((turn * Vector3(vertex))[2] for vertex in cube.shape.vertices)
	cube.state.pos = (0, 0, 1e-3 - lowest)
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=damping)
	step = PolytopeTimeStepper(timestepSafetyCoefficient=fraction)
	O.engines = polytope.engines(law=law, integrator=NewtonIntegrator(damping=0), timeStepper=step)
	while cube.state.vel[2] < 0 or any(contact.isReal for contact in O.interactions):
		O.run(20, wait=True)
	return cube.state.vel[2] / speed


def main():
	rows = [(damping, theory(damping), *(measured(damping, turn) for turn in turns.values())) for damping in shares]
	print(tabulate(rows, ('normalDamping', 'closed form', *turns), floatfmt=('g', *['.2f'] * 4)))


if __name__ == '__main__':
	main()
