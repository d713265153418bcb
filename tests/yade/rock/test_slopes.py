# SPDX-License-Identifier: GPL-2.0-or-later
"""Cubes on slopes, edges on floors, solids that roll over plates: the default contact, both rules of stiffness."""

import math
import pathlib
import sys

import numpy as np
import pytest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'))
from jointStudy.scenes.releasedCube import CubeOnSlope, edgeNormal, slopeFloors, wallKick
from jointStudy.scenes.rollingSolid import RollingSolid


@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('floor', slopeFloors)
def testCubeSlidesDownASlopeAsFarAsTheorySays(floor, perArea):
	scene = CubeOnSlope(floor=floor, perArea=perArea).build()
	distance, aside = scene.slide(0.8)
	assert distance == pytest.approx(scene.distanceInTheory(0.8), rel=5e-3)
	assert abs(aside) < 2e-3 * distance


@pytest.mark.parametrize('floor', ['polytope', 'wall', 'box', 'facet'])
@pytest.mark.parametrize('turn', [5, 15, 30])
def testEdgeOnAFlatFloorHasTheFloorsNormal(turn, floor):
	for overlap in (1e-5, 1e-4, 1e-3):
		assert edgeNormal(math.radians(turn), overlap, floor) < math.radians(0.1)


@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('floor', ['wall', 'facet'])
def testTiltedCubeIsNotKickedAsideByAFrictionlessFloor(floor, perArea):
	assert wallKick(perArea=perArea, floor=floor) < 1e-3


@pytest.mark.parametrize(
	'faces, perArea',
	[
		(12, False),
		(12, True),
		(20, False),
		(20, True),
	],
)
def testSolidRollsOverFlushPlatesAsOverOne(faces, perArea):
	one, ten = (RollingSolid(faces=faces, plates=plates, perArea=perArea).build().path(0.5) for plates in (1, 10))
	assert np.abs(ten - one).max() < 5e-3 * one[-1, 0]
