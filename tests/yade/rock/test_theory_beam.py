# SPDX-License-Identifier: GPL-2.0-or-later
"""The closed form of the three-hinged beam against hand values, its own geometry and energy; the two-block model against its limits."""

import math

import numpy as np
import pytest
from boon2012.beam.theory import BeamBetweenWalls, BeamOfTwoBlocks

beam = BeamBetweenWalls()


def testAppendixA():
	"""Values derived from Appendix A of Boon et al. (2012) once more, outside this project."""
	load, rotation = beam.peak()
	assert load == pytest.approx(37027.3, abs=0.05) and math.degrees(rotation) == pytest.approx(6.7468488, abs=2e-6)
	assert beam.drop(rotation) == pytest.approx(16.531e-3, abs=5e-7)
	assert beam.thrust(rotation) == pytest.approx(149.32e3, abs=5) and beam.lever(rotation) == pytest.approx(17.110e-3, abs=5e-7)
	assert beam.thrust(rotation) / beam.abutmentStiffness == pytest.approx(1.49323e-3, abs=5e-9)
	assert beam.load(1e-6) / 1e-6 == pytest.approx(681.48e3, rel=1e-5)
	assert beam.load(math.radians(0.25)) == pytest.approx(2905.74, abs=5e-3)
	assert beam.load(math.radians(0.5)) == pytest.approx(5677.27, abs=5e-3)
	assert math.degrees(beam.exhaustion()) == pytest.approx(15.195, abs=5e-4)


def testTrueArm():
	load, rotation = beam.peak(trueArm=True)
	assert load == pytest.approx(36634, abs=0.5) and math.degrees(rotation) == pytest.approx(6.713, abs=5e-4)
	(depth,) = {round(delta, 12) for delta in beam.penetrations(rotation)}
	assert load == pytest.approx(beam.load(rotation) * 0.069 / (0.069 + depth / 3), rel=1e-9)


def testGoodman():
	assert math.degrees(beam.alignment) == pytest.approx(18.435, abs=5e-4) and beam.drop(beam.alignment) == pytest.approx(0.046, rel=1e-12)


def testWorkIsLessThanEnergy():
	_, rotation = beam.peak()
	assert beam.work(rotation) == pytest.approx(204.7, abs=0.05) and beam.stored(rotation) == pytest.approx(223.0, abs=0.05)


@pytest.mark.parametrize('degrees', [0.3, 4, 11, 14.9])
@pytest.mark.parametrize('stiffnesses', [(100e6, 50e6), (70e6, 130e6)])
def testForcesFromTheCornersThemselves(degrees, stiffnesses):
	"""The load follows from polygons, too: corner points of the triangles, their centroids, chords between the points where lines cross."""
	turned = math.radians(degrees)
	model = BeamBetweenWalls(0.15, 0.05, *stiffnesses)
	turn = np.array([[math.cos(turned), math.sin(turned)], [-math.sin(turned), math.cos(turned)]])
	behind, ahead = model.penetrations(turned)
	low = np.array([-behind, 0])
	high = low + turn @ [0.15, 0.05]
	assert high[0] - 0.15 == pytest.approx(ahead, abs=1e-15)

	def contact(corner, along, wall):
		"""Height of the triangle's centroid and width of the triangle there: the corner, and where its edges cross the wall."""
		a, b = (corner + edge * (wall - corner[0]) / edge[0] for edge in along)
		centroid = (corner + a + b) / 3
		edge = a if abs(a[1] - corner[1]) > abs(b[1] - corner[1]) else b  # the longer one, which the chord ends on
		return centroid[1], abs(wall - (corner + (edge - corner) * (centroid[1] - corner[1]) / (edge[1] - corner[1]))[0])

	lowHeight, lowChord = contact(low, (turn @ [1, 0], turn @ [0, 1]), 0)
	highHeight, highChord = contact(high, (turn @ [-1, 0], turn @ [0, -1]), 0.15)
	thrust = stiffnesses[0] * lowChord
	assert thrust == pytest.approx(stiffnesses[1] * 2 * highChord, rel=1e-9)
	assert model.thrust(turned) == pytest.approx(thrust, rel=1e-9)
	assert model.lever(turned) == pytest.approx(highHeight - lowHeight, rel=1e-9)
	assert model.load(turned) == pytest.approx(thrust * (highHeight - lowHeight) / 0.075, rel=1e-9)


def testLoadTakesArraysAndZero():
	rotations = np.radians([0, 1, 7])
	assert list(beam.load(rotations)) == [0, beam.load(rotations[1]), beam.load(rotations[2])]
	assert beam.load(0) == 0 and isinstance(beam.load(0), float)


def testLoadIsProportionalToStiffness():
	double = BeamBetweenWalls(abutmentStiffness=200e6, midspanStiffness=100e6)
	assert double.peak()[0] == pytest.approx(2 * beam.peak()[0], rel=1e-12) and double.peak()[1] == pytest.approx(beam.peak()[1], abs=1e-8)


def testAnalyticCentreOfTwoBlocks():
	"""Abutments of three block heights: a figure computed outside this project."""
	load, rotation = BeamOfTwoBlocks().peak()
	assert load == pytest.approx(31278, abs=1) and math.degrees(rotation) == pytest.approx(6.37, abs=5e-3)


def testSizeOfTheAbutmentsMatters():
	peaks = [BeamOfTwoBlocks(abutmentHeight=times * 0.046).peak()[0] for times in (1.5, 3, 10, 1000)]
	assert peaks == sorted(peaks) and peaks[0] < 0.95 * peaks[1]
	assert peaks[2] == pytest.approx(peaks[3], rel=2e-3), 'far planes do not count'


def testWithAWallAtMidspanTheOrderReverses():
	assert BeamOfTwoBlocks().peak()[0] < beam.peak()[0] < BeamOfTwoBlocks(wallAtMidspan=True).peak()[0]


def testTrueArmOfTwoBlocks():
	model = BeamOfTwoBlocks()
	assert 0.98 < model.load(0.1, trueArm=True) / model.load(0.1) < 0.995 and model.load(0) == 0


@pytest.mark.parametrize('name', ['length', 'height', 'abutmentStiffness', 'midspanStiffness'])
@pytest.mark.parametrize('value', [0, -1, math.nan, math.inf])
def testNonsenseIsRefused(name, value):
	with pytest.raises(ValueError, match=name):
		BeamBetweenWalls(**{name: value})
	with pytest.raises(ValueError, match=name):
		BeamOfTwoBlocks(**{name: value})
