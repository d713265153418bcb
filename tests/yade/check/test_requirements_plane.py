# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.requirements: when it advises polygons for prisms."""

import pytest
from requirementsScenes import advised, row
from yade import O, polytope


def flatRow():
	row(steps=0, spin=0)
	O.engines[3].gravity = (0, -10, 0)
	for k, body in enumerate(O.bodies):
		if body.dynamic:
			body.state.blockedDOFs = 'zXY'
			body.state.pos = (1.2 * k, 0, 0.2)
			body.state.vel = body.state.angVel = (0, 0, 0)
	O.bodies[0].state.pos = (0, -5.3995, 0)


def testThirdDimensionAndItsPrice():
	flatRow()
	for _ in range(20):
		O.step()
	found = polytope.requirements(O)['third dimension']
	assert 'polygon' in found.advice and found.cost is not None
	O.bodies[1].state.blockedDOFs = ''
	O.bodies[1].state.angVel = (0.1, 0, 0)
	assert 'third dimension' not in advised()


def testThirdDimensionUpToRounding():
	flatRow()
	for body in O.bodies:
		if body.dynamic:
			body.state.blockedDOFs = ''
			body.state.vel, body.state.angVel = (0.1, 0, 2e-18), (1e-18, 0, 0.1)
	assert 'third dimension' in advised()
	for engine, gravity in ((O.engines[3], (0, -10, -10)), (O.engines[3], (0, 0, -10))):
		engine.gravity = gravity
		assert 'third dimension' not in advised()
	O.engines[3].gravity = (0, -10, 0)
	O.forces.setPermF(1, (0, 0, 5))
	assert 'third dimension' not in advised()


def testBlocksThatAreAboutToFallAreNoPolygons():
	row(steps=0, spin=0)
	assert 'third dimension' not in advised()


@pytest.mark.parametrize('measure', [False, True])
@pytest.mark.parametrize('heights', [(0, 10, -0.5), (0.499, 1.497, -0.5), (0, 0, -0.999)])
def testPrismsAboveEachOtherAreNoPolygons(heights, measure):
	"""Apart, stacked, and both on a floor below: polygons would meet where these do not, or meet from above."""
	row(number=2, steps=0, spin=0)
	O.engines[3].gravity = (0, -10, 0)
	floor, *blocks = O.bodies
	for body, x, z in ((blocks[0], 0, heights[0]), (blocks[1], 0.3, heights[1]), (floor, 0, heights[2])):
		body.state.pos = (x, 0, z)
		body.state.blockedDOFs = 'zXY' if body in blocks else body.state.blockedDOFs
	O.step()
	found = polytope.requirements(O, measure=measure)['third dimension']
	assert not found.advice and found.cost is None and 'not side by side in one plane' in found.seen


def testPrismsOfDifferentHeightSideBySideAreAdvised():
	flatRow()
	O.bodies[2].state.pos += (0, 0, 0.2)  # still shares most of its height with the floor and the others
	assert 'third dimension' in advised()
	O.bodies[2].state.pos += (0, 0, 0.3)
	found = polytope.requirements(O, measure=False)['third dimension']
	assert not found.advice and 'only 0.3 m in common' in found.seen
