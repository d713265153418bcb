# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms of blocks on joints, against what the literature and other ways to them give."""

import math
import pathlib
import sys

import numpy as np
import pytest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'))
from jointStudy.theory.arch import archStands, leastThickness, voussoir
from jointStudy.theory.elasticArch import ElasticArch
from jointStudy.theory.rocking import housnerPeriod, rockingFrequency, rockingPeriod
from jointStudy.theory.toppling import criticalTilt, elasticToppling, rigidToppling


def testBlockSlidesOrTopplesWhicheverComesFirst():
	assert criticalTilt(0.4, 1, math.radians(35)) == ('topples', pytest.approx(math.atan(0.4)))
	assert criticalTilt(0.4, 1, math.radians(21)) == ('slides', pytest.approx(math.radians(21)))


def testElasticJointTendsToTheRigidOneWithTheCubeRootOfItsStiffness():
	below = [1 - elasticToppling(0.4, 1, 1e4, stiffness) / rigidToppling(0.4, 1) for stiffness in (1e12, 8e12, 64e12)]
	assert below[0] / below[1] == pytest.approx(2, rel=0.02)
	assert below[1] / below[2] == pytest.approx(2, rel=0.01)
	assert 0 < below[2] < 0.01


def testElasticJointIsInEquilibriumWithItsPressure():
	# the joint's pressure, summed up over the base turned by many angles: no turn bears more
	width, height, weight, stiffness = 0.4, 1.0, 1e4, 1e10
	best = 0
	for turn in np.geomspace(1e-4, 5e-2, 400):
		low, high = 1e-7, 0.1
		for _ in range(60):  # depth of the toe that carries the weight
			depth = (low + high) / 2
			x = np.linspace(0, width * math.cos(turn), 2001)  # from the toe
			pressure = stiffness * np.maximum(depth - x * math.tan(turn), 0)
			low, high = (low, depth) if np.trapezoid(pressure, x) > weight else (depth, high)
		arm = np.trapezoid(pressure * x, x) / np.trapezoid(pressure, x)
		behind, above = (
			(width * math.cos(turn) - height * math.sin(turn)) / 2,
			(height * math.cos(turn) + width * math.sin(turn)) / 2 - depth,
		)
		best = max(best, (behind - arm) / above)
	assert elasticToppling(width, height, weight, stiffness, followsTilt=False) == pytest.approx(best, rel=1e-4)


def testSoftJointIsRefused():
	with pytest.raises(ValueError, match='stiffness'):
		elasticToppling(0.4, 1, 1e4, 1e4)


def testHousnersPeriodIsThatOfASlenderBlock():
	p = rockingFrequency(0.2, 1)
	assert p == pytest.approx(math.sqrt(3 * 9.81 / (4 * math.hypot(0.1, 0.5))))
	assert rockingPeriod(0.02, 1, 0.01) == pytest.approx(housnerPeriod(0.02, 1, 0.01), rel=1e-4)


def testRockingPeriodIsThatOfTheEquationOfMotion():
	width, height, turn, speed, time, step = 0.4, 1.0, 0.2, 0.0, 0.0, 1e-5
	p, alpha = rockingFrequency(width, height), math.atan2(width, height)
	speed -= step / 2 * p**2 * math.sin(alpha - turn)
	while turn > 0:
		turn, time = turn + step * speed, time + step
		speed -= step * p**2 * math.sin(alpha - turn)
	assert 4 * time == pytest.approx(rockingPeriod(width, height, 0.2), rel=1e-4)


@pytest.mark.parametrize('tilt', [0, -0.1, 0.5])
def testTiltBeyondFallingIsRefused(tilt):
	with pytest.raises(ValueError, match='tilt'):
		rockingPeriod(0.2, 1, tilt)


def testArchOfManyBlocksIsMilankovitchs():
	# Milankovitch 1907, Makris & Alexakis 2013: t/R = 0.1075 of a semicircle between radial joints
	assert leastThickness(400, math.radians(89)) == pytest.approx(0.1075, abs=5e-5)


def testArchOfLittleFrictionSlips():
	assert not archStands(0.9, 16, math.radians(10))
	with pytest.raises(ValueError, match='frictionAngle'):
		leastThickness(16, math.radians(10))


def testVoussoirIsATrapezium():
	area, radius = voussoir(0.2, 5)
	half = math.pi / 10
	low, high = 0.9 * math.cos(half), 1.1 * math.cos(half)
	assert area == pytest.approx((low + high) * math.tan(half) * (high - low))
	x = np.linspace(low, high, 100001)
	assert radius == pytest.approx(np.trapezoid(x * x, x) / np.trapezoid(x, x))


def testForcesInAnElasticArchAreItsEnergysSlope():
	arch = ElasticArch(0.15, 6, 1e4)
	moved, step = np.random.default_rng(1).normal(size=(6, 3)) * 1e-2, 1e-6
	slope = [(arch.energy(moved + d, 1) - arch.energy(moved - d, 1)) / (2 * step) for d in step * np.eye(18).reshape(18, 6, 3)]
	assert arch.gradient(moved, 1).ravel() == pytest.approx(np.array(slope), rel=1e-6, abs=1e-6)


def testElasticArchTendsToLimitAnalysisWithTheCubeRootOfItsStiffness():
	# its thickness is above by 4.2 % and half of that: below and above these it falls and stands
	least = leastThickness(6, math.radians(89))
	for stiffness, falls, stands in ((5e6, 1.025, 1.055), (4e7, 1.0125, 1.0275)):
		assert not ElasticArch(falls * least, 6, stiffness).stands()
		assert ElasticArch(stands * least, 6, stiffness).stands()
