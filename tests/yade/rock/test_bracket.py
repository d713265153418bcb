# SPDX-License-Identifier: GPL-2.0-or-later
"""The factors that polytope.factorOfSafety tries: fewer than halving takes where forces tell the limit, hardly more where they mislead."""

import math

import pytest
from yade.polytope.rock.bracket import Bracket


def search(limit, lacks, tolerance=0.01, most=20):
	"""Factors that were tried, and the bracket in the end. *lacks*: the force that is missing at a factor that fails."""
	bracket, tried = Bracket(tolerance, most), []
	while not bracket.isFound and bracket.stable < most:
		factor = bracket.next()
		tried.append(factor)
		bracket.tell(factor, factor < limit, lacks(factor) if factor >= limit else 0.0)
		assert len(tried) < 100
	return tried, bracket


def slides(limit):
	"""W sin α − (W cos α tan φ + c A)/F, which is zero at the limit."""
	return lambda factor: 1 / limit - 1 / factor


@pytest.mark.parametrize('limit', [1.003, 1.1, 1.198, 1.7321, 3.3, 12.0])
def testWhatSlidesIsFoundInFewTrials(limit):
	tried, bracket = search(limit, slides(limit))
	assert bracket.stable < limit < bracket.failed <= bracket.stable * 1.01
	enclosing = next(k for k, factor in enumerate(tried, 1) if factor >= limit)
	assert len(tried) - enclosing <= 6 and (limit == 1.003 or len(tried) - enclosing < 6)  # halving takes 6
	assert limit == 1.003 or abs(tried[-1] / limit - 1) > 2e-3  # not so near that it would creep


@pytest.mark.parametrize(
	'lacks',
	[
		lambda factor: 0.0,
		lambda factor: 1.0,
		lambda factor: math.sin(1e3 * factor) ** 2,
		lambda factor: math.nan,
		lambda factor: -1.0,
		lambda factor: 1 / factor,
		lambda factor: (factor - 1) ** 8,
		lambda factor: (factor - 1) ** 0.1,
	],
)
@pytest.mark.parametrize('limit', [1.05, 1.198, 4.7])
def testWhereForcesMisleadItTakesAtMostTwiceAsMany(lacks, limit):
	tried, bracket = search(limit, lacks)
	assert bracket.stable < limit < bracket.failed <= bracket.stable * 1.01
	enclosing = next(k for k, factor in enumerate(tried, 1) if factor >= limit)
	assert len(tried) - enclosing <= 12


def testOtherBodiesTellNothingOfTheLimit():
	for second, expected in ((7, 1.55 * 0.996), (8, 1.4)):
		bracket = Bracket(0.01, 20)
		bracket.tell(1.75, False, slides(1.55)(1.75), 7)
		bracket.tell(1.6, False, slides(1.55)(1.6), second)
		bracket.tell(1.2, True)
		assert bracket.next() == pytest.approx(expected)


def testWhatNeverFailsEndsAtTheMost():
	tried, bracket = search(math.inf, slides(1), most=5)
	assert tried == pytest.approx([1.5, 2.25, 3.375, 5]) and bracket.stable == 5


def testTheTrialsToComeAreCounted():
	bracket = Bracket(0.01, 20)
	assert bracket.halvings == 1 + 6
	bracket.tell(1.5, False, 1.0)
	assert bracket.halvings == 6
	bracket.tell(1.25, True)
	assert bracket.halvings == 5


@pytest.mark.parametrize('jump', [1.02, 1.1, 1.4])
@pytest.mark.parametrize('limit', [0.62, 0.8245, 1.1, 1.7321, 3.3])
def testATrialThatFailedByItsJumpIsMadeAgainFromNearby(limit, jump):
	"""The mass fails where its strength falls at once to near the limit, by more than *jump*."""
	bracket, factors = Bracket(0.01, 20), [1 / 20 if limit < 1 else 1.0]
	bracket.stable = factors[0]
	while not bracket.isFound:
		factors.append(bracket.next())
		began = bracket.stable
		stands = factors[-1] < limit and (factors[-1] < 0.9 * limit or factors[-1] < jump * began)
		bracket.tell(factors[-1], stands, limit=None if stands else limit, began=began)
		assert len(factors) < 100
	assert bracket.stable < limit < bracket.failed <= bracket.stable * 1.01


def told(limit, estimate, tolerance=0.01):
	"""Factors that are tried where the motion in a failed trial tells the limit by this function of the factor."""
	bracket, tried = Bracket(tolerance, 20), []
	while not bracket.isFound:
		tried.append(bracket.next())
		stands = tried[-1] < limit
		bracket.tell(tried[-1], stands, limit=None if stands else estimate(tried[-1]))
		assert len(tried) < 100
	assert bracket.stable < limit < bracket.failed <= bracket.stable * 1.01
	return tried


@pytest.mark.parametrize('limit', [1.1, 1.198, 1.7321, 3.3, 12.0])
def testTheMotionThatTellsTheLimitEndsTheSearchWithTwoTrials(limit):
	tried = told(limit, lambda factor: limit)
	enclosing = next(k for k, factor in enumerate(tried, 1) if factor >= limit)
	assert len(tried) == enclosing + 2


@pytest.mark.parametrize('limit', [1.1, 1.198, 1.7321, 3.3])
def testAMotionThatTellsBetterTheNearerItIsTakesFewer(limit):
	"""A tenth of the distance wrong, as where normal forces depend on the strength."""
	tried = told(limit, lambda factor: limit + 0.1 * (factor - limit))
	enclosing = next(k for k, factor in enumerate(tried, 1) if factor >= limit)
	assert len(tried) - enclosing < 6  # halving takes 6


@pytest.mark.parametrize(
	'estimate', [lambda factor: 0.9 * factor, lambda factor: 0.999 * factor, lambda factor: 0.0, lambda factor: 99.0, lambda factor: None]
)
@pytest.mark.parametrize('limit', [1.05, 1.198, 4.7])
def testAMotionThatMisleadsTakesAtMostTwiceAsMany(limit, estimate):
	tried = told(limit, estimate)
	enclosing = next(k for k, factor in enumerate(tried, 1) if factor >= limit)
	assert len(tried) - enclosing <= 14
