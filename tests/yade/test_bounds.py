# SPDX-License-Identifier: GPL-2.0-or-later
"""A body that turns in place meets its neighbour however seldom the collider runs."""
import math

import pytest
from scenes import driven, joint, loop
from yade import O, polytope


@pytest.mark.parametrize('verletDist', [0, 0.01, 0.2])
def testRodTurningInPlaceIsSeen(verletDist):
	joint()
	loop()
	O.engines[1].verletDist = verletDist
	rod, block = polytope.cuboid((0, 0, 0), (1, .1, .1)), polytope.cuboid((0, 1.1, 0), (.5, .3, .5), fixed=True)
	O.bodies.append([rod, block])
	driven(rod, angularVelocity=(0, 0, 1))
	O.dt = 1e-3
	while O.interactions.countReal() == 0 and O.iter < 2000:
		O.step()
	assert O.interactions.countReal() == 1
	contact = O.interactions[rod.id, block.id]
	assert 0 < contact.geom.penetrationDepth < 2e-3  # a step's travel of the tip
	# the block's corner (0.5, 0.8) meets the rod's upper face, 0.1 from its axis
	assert O.iter * O.dt == pytest.approx(math.acos(.1 / math.hypot(.5, .8)) - math.atan(.5 / .8), abs=3e-3)



def testBoxesAreTightWhereNothingTurns():
	joint()
	loop()
	fixed, free = polytope.cuboid((0, 0, 0), (3, 2, 1), fixed=True), polytope.cuboid((9, 0, 0), (3, 2, 1))
	O.bodies.append([fixed, free])
	O.engines[1].verletDist = 0
	O.dt = 1e-6
	O.step()
	assert list(fixed.bound.max) == pytest.approx([3, 2, 1])
	assert list(free.bound.max) == pytest.approx([9 + math.sqrt(14), math.sqrt(14), math.sqrt(14)])
