# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints that dilation holds apart: a bed of springs over the face all the same, in whose force, moment and energy dilation is a part of the closure.

The block is 1 m × 1 m × 0.2 m (2-D: 1 m × 0.2 m) on a larger one.
"""

from math import cos, radians, sin, tan

import pytest
from scenes import joint
from yade import BartonBandisStrength, Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, O, polytope

half, stiff = 0.1, 1e9
units = pytest.mark.parametrize('perArea', [True, False], ids=['per area', 'per contact'])


def block(overlap, flat=False, **material):
	joint(**dict(dict(density=2600, normalStiffness=stiff, shearStiffness=stiff), **material))
	if flat:
		O.bodies.append(polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True))
		O.bodies.append(polytope.polygon([(x, y - overlap) for x, y in ((-0.5, 0), (0.5, 0), (0.5, 2 * half), (-0.5, 2 * half))]))
	else:
		O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, half - overlap), (0.5, 0.5, half)))
	return O.bodies[1]


@pytest.mark.parametrize('flat', [False, True], ids=['3D', '2D'])
@units
def testTheTiltUnderAnEccentricLoadIsThatOfTheBed(flat, perArea):
	"""At every dilation as without, per area 12 N e/K. Slid slowly across the load's arm (2-D: along it, without friction), from no dilation to twenty times the closure."""
	load, arm, psi = 1e5, 0.05, radians(15)
	body = block(load / stiff, flat, frictionAngle=0.0 if flat else 0.1, dilationAngle=psi, stiffnessPerArea=perArea)
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.4)
	body.state.blockedDOFs = 'x' if flat else 'yX'
	O.forces.setPermF(1, (0, -load, 0) if flat else (0, 0, -load))
	O.forces.setPermT(1, (0, 0, load * arm) if flat else (0, load * arm, 0))
	polytope.run(until=O.time + 0.05)
	turned = lambda: body.state.ori.toRotationMatrix()[(1, 0) if flat else (0, 2)]  # noqa: E731
	bed = turned()
	if perArea:
		assert bed == pytest.approx(12 * load * arm / stiff, rel=0.02)
	body.state.vel = (0.02, 0, 0) if flat else (0, 0.02, 0)
	phys = O.interactions[0, 1].phys
	for times in (0.3, 0.9, 1.0, 1.1, 2, 5, 20):
		while phys.dilation < times * load / stiff:
			polytope.run(until=O.time + 0.002)
		assert turned() == pytest.approx(bed, rel=0.02), times


@units
def testABlockThatClimbsItsAsperitiesStaysFlat(perArea):
	"""On a slope of 40°, friction 30°, dilation 10°: a = g (sin α − tan φ cos α) / (1 + tan φ tan ψ), N = m (g cos α + a tan ψ),
	and friction takes N (tan φ − tan ψ) for each metre, the rest being work against the weight."""
	alpha, phi, psi = radians(40), radians(30), radians(10)
	body = block(2600 * 2 * half * 9.81 * cos(alpha) / stiff, frictionAngle=phi, dilationAngle=psi, stiffnessPerArea=perArea)
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, rockingDamping=0.1)
	O.engines = polytope.engines(gravity=(9.81 * sin(alpha), 0, -9.81 * cos(alpha)), damping=0, law=law)
	polytope.settle()
	O.trackEnergy = True
	start = float(body.state.pos[0])
	polytope.run(until=O.time + 0.4)
	a = 9.81 * (sin(alpha) - tan(phi) * cos(alpha)) / (1 + tan(phi) * tan(psi))
	normal = float(body.state.mass) * (9.81 * cos(alpha) + a * tan(psi))
	way, phys = float(body.state.pos[0]) - start, O.interactions[0, 1].phys
	assert phys.dilation > 100 * normal / stiff
	assert body.state.ori.toAxisAngle()[1] < 1.2 * 12 * normal * tan(phi) * half / stiff
	assert phys.normalForce.norm() == pytest.approx(normal, rel=0.01)
	assert phys.normalViscous.norm() < 0.01 * normal
	assert O.energy['plastDissip'] == pytest.approx((tan(phi) - tan(psi)) * normal * way, rel=0.02)
	assert abs(O.energy['nonconservative']) < 0.005 * O.energy['plastDissip']


def testDampersDoNotChangeHowFastARoughJointSlides():
	"""Barton and Bandis' strength depends on the stress, which is that of the load alone."""
	ways = []
	for damping in (0, 0.3):
		O.reset()
		alpha = radians(40)
		material = dict(frictionAngle=radians(20), strength=BartonBandisStrength(JRC=15, JCS=60e6, jointLength=1.0))
		body = block(2600 * 2 * half * 9.81 * cos(alpha) / stiff, **material)
		law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=damping)
		O.engines = polytope.engines(gravity=(9.81 * sin(alpha), 0, -9.81 * cos(alpha)), damping=0, law=law)
		polytope.settle()
		body.state.vel = (0.3, 0, 0)
		start = float(body.state.pos[0])
		polytope.run(until=O.time + 0.4)
		ways.append(float(body.state.pos[0]) - start)
	assert ways[1] == pytest.approx(ways[0], rel=0.01)


@units
@pytest.mark.parametrize('faces', [True, False], ids=['faces', 'edges'])
def testACollisionWithDilationKeepsTheBalance(perArea, faces):
	"""Two free bodies without dampers slide on each other while they spin: what the forces took is stored or lost in friction."""
	joint(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=radians(30), dilationAngle=radians(15), stiffnessPerArea=perArea)
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.4, 0.3)))
	O.bodies.append(polytope.cuboid((0.2, 0.1, 0.56), (0.3, 0.35, 0.25)) if faces else polytope.regular(12, 0.4, center=(0.1, 0.15, 0.75)))
	spins = [(0, 0, 5), (0, 0, -8)] if faces else [(2, -1, 3), (-1, 2, -2)]
	for body, velocity, spin in zip(O.bodies, [(0.3, 0.1, 1), (-0.5, 0.2, -1)], spins, strict=True):
		body.state.vel, body.state.angVel = velocity, spin
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, timeStepper=False, law=law)
	O.dt = 2e-5
	O.trackEnergy = True
	kinetic = sum(float(body.state.mass) * body.state.vel.squaredNorm() / 2 for body in O.bodies)
	O.run(10000, True)
	assert O.energy['plastDissip'] > 0.01 * kinetic
	assert abs(O.energy['nonconservative']) < 1e-3 * kinetic
