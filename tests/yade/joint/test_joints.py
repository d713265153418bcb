# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks on joints, where theory has one answer: the default contact, both rules of stiffness, two and three dimensions."""

import math
import pathlib
import sys

import pytest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'))
from jointStudy.scenes.arch import MasonryArch
from jointStudy.scenes.blockOnBase import RockingBlock, ShakenBlock, TiltedBlock
from jointStudy.theory.arch import leastThickness
from jointStudy.theory.elasticArch import ElasticArch
from jointStudy.theory.rocking import rockingPeriod
from jointStudy.theory.toppling import criticalTilt, elasticToppling, rigidToppling


def tilted(ratio, friction, angle, **options):
	return TiltedBlock(width=ratio, frictionAngle=math.radians(friction), **options).apply(math.tan(angle))


@pytest.mark.parametrize('dimension', [2, 3])
@pytest.mark.parametrize('ratio', [0.25, 0.4])
def testBlockTopplesWhereGoodmanAndBraySay(dimension, ratio):
	mode, angle = criticalTilt(ratio, 1.0, math.radians(40))
	assert mode == 'topples'
	assert tilted(ratio, 40, 0.995 * angle, dimension=dimension).mode == 'stands'
	assert tilted(ratio, 40, 1.005 * angle, dimension=dimension).mode == 'topples'


@pytest.mark.parametrize('dimension', [2, 3])
@pytest.mark.parametrize('ratio', [0.25, 0.4])
def testBlockOnAnElasticJointTopplesWhereItsWedgeOfPressureEnds(dimension, ratio):
	options = {'dimension': dimension, 'perArea': True, 'stiffness': 1e11}
	_, angle = criticalTilt(ratio, 1.0, math.radians(40), pressing=2600 * 9.81 * ratio, stiffness=1e11)
	assert tilted(ratio, 40, 0.995 * angle, **options).mode == 'stands'
	assert tilted(ratio, 40, 1.005 * angle, **options).mode == 'topples'


@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('ratio, friction', [(0.4, 21), (1.0, 30)])
def testBlockSlidesAtItsFrictionAngle(ratio, friction, perArea):
	assert tilted(ratio, friction, math.radians(0.995 * friction), perArea=perArea).mode == 'stands'
	assert tilted(ratio, friction, math.radians(1.005 * friction), perArea=perArea).mode == 'slides'


@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('dimension', [2, 3])
def testShakenBlockIsOverturnedByItsWidthOverHeight(dimension, perArea):
	block = ShakenBlock(width=0.25, dimension=dimension, perArea=perArea, stiffness=1e11)
	least = elasticToppling(0.25, 1.0, 2600 * 9.81 * 0.25, 1e11, followsTilt=False) if perArea else rigidToppling(0.25, 1.0)
	assert block.apply(0.99 * least).mode == 'stands'
	assert block.apply(1.01 * least).mode == 'topples'


@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('dimension', [2, 3])
def testBlockRocksWithHousnersPeriod(dimension, perArea):
	block = RockingBlock(dimension=dimension, perArea=perArea)
	assert 4 * block.fall(0.05) == pytest.approx(rockingPeriod(block.width, block.height, 0.05), rel=0.01)


@pytest.mark.parametrize('dimension', [2, 3])
def testArchStandsAsThinAsLimitAnalysisSays(dimension):
	least = leastThickness(8, math.radians(89))
	assert MasonryArch(1.01 * least, 8, dimension=dimension).build().stands()
	thin = MasonryArch(0.99 * least, 8, dimension=dimension).build()
	assert not thin.stands()
	assert thin.speed < 1, 'it flies apart instead of falling'


def testArchOfElasticJointsStandsAsThinAsTheirEnergySays():
	# 1 % to either side of the elastic arch's own thickness, which lies 2 % above that of limit analysis
	stiffness, least = 1e12, leastThickness(8, math.radians(89))
	for thickness, stands in ((1.01 * least, False), (1.03 * least, True)):
		arch = MasonryArch(thickness, 8, stiffness=stiffness, perArea=True)
		assert ElasticArch(thickness, 8, stiffness / (arch.density * arch.gravity)).stands() == stands
		assert arch.build().stands() == stands
		assert arch.speed < 1, 'it flies apart instead of falling'


@pytest.mark.parametrize('stiffness, perArea', [(1e9, False), (1e10, True)])
@pytest.mark.parametrize('dimension', [2, 3])
def testArchStaysAtRest(dimension, stiffness, perArea):
	arch = MasonryArch(0.15, 8, dimension=dimension, stiffness=stiffness, perArea=perArea).build()
	arch.settle()
	assert arch.speed < 1e-6 and 0 < arch.sag < 0.01
	assert arch.creep(20000) < 1e-9
