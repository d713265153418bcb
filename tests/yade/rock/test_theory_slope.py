# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit analysis of blocks in the plane against closed forms, and the slope of simulation E."""

import json
import math
import pathlib

import numpy as np
import pytest
from boon2012.slope.theory import centroid, criticalFrictionAngle, joints, largestOutwardLoad

slopeFile = pathlib.Path(__file__).resolve().parents[3] / 'examples/paper/geometry/e_slope.json'


def turned(corners, angle, shift=(0, 0)):
	turn = np.array([(math.cos(angle), -math.sin(angle)), (math.sin(angle), math.cos(angle))])
	return np.asarray(corners, float) @ turn.T + shift


def blockOnIncline(angle, width=2.0, height=1.0):
	"""A block on an incline that dips to the left by *angle*."""
	block = [(0, 0), (width, 0), (width, height), (0, height)]
	ground = [(-5, -3), (5, -3), (5, 0), (-5, 0)]
	return [turned(block, angle)], [turned(ground, angle)]


def testCentroidOfTriangle():
	area, centre = centroid([(0, 0), (3, 0), (0, 3)])
	assert area == pytest.approx(4.5) and centre == pytest.approx([1, 1])
	assert centroid([(0, 0), (0, 3), (3, 0)])[0] == pytest.approx(-4.5)


@pytest.mark.parametrize('degrees', [5, 20, 26])
def testSlidingBlockNeedsFrictionOfItsIncline(degrees):
	free, fixed = blockOnIncline(math.radians(degrees))
	limit = criticalFrictionAngle(free, fixed)
	assert math.degrees(limit.angle) == pytest.approx(degrees, abs=1e-6)
	assert limit.velocities[0, 2] == pytest.approx(0, abs=1e-6)
	# associated flow: it parts from the incline at the friction angle, so moves horizontally; and to the left, outward
	assert limit.velocities[0, :2] == pytest.approx([-1, 0], abs=1e-6)


def testSlenderBlockTopplesWhateverTheFriction():
	"""Narrower than its height times tan of the dip."""
	free, fixed = blockOnIncline(math.radians(30), width=0.5)
	with pytest.raises(ValueError, match='free'):
		criticalFrictionAngle(free, fixed)
	assert criticalFrictionAngle(free, fixed, rotations=False).angle == pytest.approx(math.radians(30), abs=1e-6)


@pytest.mark.parametrize('friction, load', [(0.3, 0.3), (3.0, 2.0)])
def testHorizontalLoadOnFlatBlock(friction, load):
	"""A block 2 m wide, 1 m high slides at k = tan φ, or topples about its corner at k = width/height."""
	free, fixed = blockOnIncline(0.0)
	k, velocities = largestOutwardLoad(free, joints(free, fixed), friction)
	assert k == pytest.approx(load, rel=1e-9)
	# turns to the left, counter-clockwise
	assert (velocities[0, 2] > 1e-6) == (friction > 2)


def testInsetNarrowsTheBase():
	free, fixed = blockOnIncline(0.0)
	assert largestOutwardLoad(free, joints(free, fixed, inset=0.1), 3.0)[0] == pytest.approx(2 * 0.9, rel=1e-9)


def testOrderOfCornersDoesNotMatter():
	free, fixed = blockOnIncline(math.radians(20))
	limit = criticalFrictionAngle([free[0][::-1]], [fixed[0][::-1]])
	assert math.degrees(limit.angle) == pytest.approx(20, abs=1e-6)


def slope():
	content = json.loads(slopeFile.read_text())
	return content['free'], content['fixed']


def testJointsOfTheSlope():
	"""28 blocks in 4 layers of 7: in each layer 6 cross joints and one with the base, between layers and with the back 7 each."""
	free, fixed = slope()
	found = joints(free, fixed)
	assert len(found) == 4 * 6 + 4 + 4 * 7
	assert sum(joint.second >= len(free) for joint in found) == 4 + 7
	bodies = [centroid(corners)[1] for corners in [*free, *fixed]]
	for joint in found:
		if joint.second < len(free):
			assert (bodies[joint.second] - bodies[joint.first]) @ joint.normal > 0


def testSlopeOfSimulationE():
	"""19.75° and the outer layer alone, its lower five blocks turning backward as one; nothing slides even without friction."""
	free, fixed = slope()
	limit = criticalFrictionAngle(free, fixed)
	assert math.degrees(limit.angle) == pytest.approx(19.748, abs=0.001)
	assert np.abs(limit.velocities[7:]).max() < 1e-6
	spins = limit.velocities[:7, 2]
	assert np.ptp(spins[:5]) < 1e-6 and spins[0] < -0.1
	assert abs(spins[5] - spins[0]) > 0.01 and (spins < 0).all()
	assert criticalFrictionAngle(free, fixed, rotations=False).angle == 0


def testMechanismsWorkIsNone():
	"""At the limit the load k is 0, and with the associated flow joints neither give nor take: gravity does no work on the mechanism."""
	free, fixed = slope()
	limit = criticalFrictionAngle(free, fixed)
	areas = np.array([centroid(corners)[0] for corners in free])
	assert abs(areas @ limit.velocities[:, 1]) < 1e-6 * np.abs(areas * limit.velocities[:, 1]).sum()
