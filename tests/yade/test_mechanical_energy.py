# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.mechanicalEnergy(): constant to rounding where the leapfrog scheme has an exact invariant, at any time step."""

from math import sqrt

import pytest
from scenes import blockOnFloor, contact, density, gravity, joint, loop
from yade import O, Quaternion, Vector3, polytope


def energies(steps):
	values = [polytope.mechanicalEnergy() for _ in range(steps)]
	return max(abs(value / values[0] - 1) for value in values[1:])


def testFreeFlightOfATumblingCube():
	joint()
	loop(gravity=(1, 2, -gravity))
	cube = polytope.cuboid((0, 0, 5), (0.5, 0.5, 0.5), Quaternion((1, 2, 3), 1))
	O.bodies.append(cube)
	cube.state.vel, cube.state.angVel = (3, 1, 2), (1, 5, 3)
	O.dt = 0.01
	assert energies(50) < 1e-12


@pytest.mark.parametrize('model', ['paper', 'conservative'])
def testBounceOnASpringAtAnyTimeStep(model):
	"""Face on face the spring is linear; the conservative one but for 0.02 μ."""
	joint(normalStiffness=1e7)
	loop(gravity=(0, 0, -gravity), ig2={'contactModel': model})
	_, block = blockOnFloor(4e-3)
	block.state.blockedDOFs = 'XYZ'  # so long a step is not stable in rotation
	O.dt = 0.5 * sqrt(density / 1e7)
	heights = []
	for _ in range(40):
		heights.append(block.state.pos[2])
		O.step()
	assert max(heights) < 0.5 and max(heights) - min(heights) > 1e-3  # it swings, and stays in contact
	assert energies(40) < (1e-12 if model == 'paper' else 1e-7)


def testIsOfThePositionsTheStepBeganAt():
	joint(normalStiffness=1e7)
	loop(gravity=(0, 0, -gravity))
	_, block = blockOnFloor(4e-3)
	O.dt = 1e-4
	weight = block.state.mass * gravity
	assert polytope.mechanicalEnergy() == pytest.approx(weight * (0.5 - 4e-3) + 1e7 * 4e-3**2 / 2, rel=1e-12)
	assert O.iter == 1 and block.state.vel != Vector3.Zero


def testShearSpringCounts():
	joint(normalStiffness=1e7, shearStiffness=1e7)
	loop()
	_, block = blockOnFloor(4e-3)
	O.dt = 1e-9
	before = polytope.mechanicalEnergy()
	contact(O.bodies[0], block).phys.shearForce = (1e4, 0, 0)
	assert polytope.mechanicalEnergy() - before == pytest.approx(1e4**2 / 2e7, rel=1e-6)


def testClumpMembersCountOnce():
	joint()
	loop(gravity=(0, 0, -gravity))
	clump, _ = O.bodies.appendClumped([polytope.cuboid((x, 0, 3), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5)])
	O.dt = 1e-4
	assert polytope.mechanicalEnergy() == pytest.approx(O.bodies[clump].state.mass * gravity * 3, rel=1e-9)


def testSceneWithoutIntegratorIsRefused():
	with pytest.raises(ValueError, match='NewtonIntegrator'):
		polytope.mechanicalEnergy()
