# SPDX-License-Identifier: GPL-2.0-or-later
"""Rock bolts between blocks that are moved by hand, against closed forms: pull-out, yield, rupture, dowel; balance; what is refused."""

import math
from math import inf, nan, pi, sqrt, tanh

import numpy as np
import pytest
from scenes import joint, loop
from yade import O, Quaternion, Vector3, polytope
from yade.polytope import Dowel, Grout

E, area = 2e11, 5e-4
EA = E * area
bar = dict(area=area, youngsModulus=E)


def blocks(count=2, gap=0.0, half=(1.0, 0.5, 0.5), moves=True):
	"""A row along x, whose first block is fixed; no contacts push where there is a gap."""
	joint()
	O.bodies.append([polytope.cuboid((k * (2 * half[0] + gap), 0, 0), half, fixed=k == 0 or not moves) for k in range(count)])
	loop(True)
	O.dt = 1e-12
	return [body.state for body in O.bodies]


def moved(state, place):
	"""Sets a block, takes a step; the block is where it was set to 1e-12 s of its motion."""
	state.vel, state.angVel = Vector3.Zero, Vector3.Zero
	state.pos = place
	O.step()


# ------------------------------------------------------------------------------------------------ end-anchored


def testEndAnchoredIsASpringYieldsAndBreaks():
	states = blocks(gap=0.1)
	length, start = 2.1, Vector3(states[1].pos)
	bolt = polytope.bolt((-0.5, 0, 0), (1.6, 0, 0), **bar, yieldForce=1e5, ruptureStrain=0.02, pretension=2e4)
	stiffness, yields = EA / length, 8e4 / EA * length
	curve = [(0, 2e4), (yields / 2, 6e4), (yields, 1e5), (0.02, 1e5), (0.02 - yields / 2, 1e5 - stiffness * yields / 2)]
	curve += [(-0.01, 0), (0.02, 1e5), (0.0410, 1e5), (0.0418, 0), (0.0, 0)]  # strain 0.02 with what is locked in: 0.04158
	for opening, force in curve:
		moved(states[1], start + Vector3(opening, 0, 0))
		assert bolt.headForce == pytest.approx(force, abs=1e-3), opening
		assert O.forces.f(0)[0] == pytest.approx(force, abs=1e-3) and O.forces.f(1)[0] == pytest.approx(-force, abs=1e-3)
	assert bolt.crossings[0].failure == 'rupture' and polytope.bolts().actingCount == 0


def testEndAnchoredPassesFreelyThroughBlocksBetween():
	states = blocks(3, gap=0.1)
	polytope.bolt((-0.5, 0, 0), (4.2, 0, 0), **bar)
	for k, state in enumerate(states[1:], 1):
		moved(state, state.pos + Vector3(1e-3, 0, 0))
		assert [O.forces.f(k)[0] for k in range(3)] == pytest.approx([(k > 1) * EA / 4.7e3, 0, (k > 1) * -EA / 4.7e3])


# ------------------------------------------------------------------------------------------------ grouted: pull-out


def lag(grout, length):
	"""Pull over displacement at the mouth of an elastic bolt in elastic grout."""
	return sqrt(EA * grout) * tanh(length * sqrt(grout / EA))


@pytest.mark.parametrize('grout', [2e7, 1e9, 2e10])
@pytest.mark.parametrize('length', [0.4, 0.9])
def testElasticPullOutIsShearLag(grout, length):
	states = blocks(gap=0.1)
	start = Vector3(states[1].pos)
	bolt = polytope.bolt((-0.5, 0, 0), (1.1 + length, 0, 0), **bar, grout=Grout(grout, 1e12, length=length))
	expected = 1 / (1.6 / EA + 1 / lag(grout, length))
	moved(states[1], start + Vector3(1e-4, 0, 0))
	assert bolt.headForce == pytest.approx(expected * 1e-4, rel=1e-6)
	assert bolt.crossings[0].stiffness == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize('grout,strength,length', [(1e9, 2e5, 0.8), (5e7, 5e4, 0.4)])
def testUltimatePullOutIsBondStrengthTimesLength(grout, strength, length):
	states = blocks(gap=0.1)
	start = Vector3(states[1].pos)
	bolt = polytope.bolt((-0.5, 0, 0), (1.1 + length, 0, 0), **bar, grout=Grout(grout, strength, length=length))
	for opening in np.linspace(0, 0.05, 60):
		moved(states[1], start + Vector3(opening, 0, 0))
	assert bolt.headForce == pytest.approx(strength * length, rel=1e-4)
	assert np.array(bolt.slips) == pytest.approx(-0.05 + strength * length * 1.6 / EA, rel=0.05)
	moved(states[1], start + Vector3(0.0499, 0, 0))
	assert bolt.headForce == pytest.approx(strength * length - 1e-4 / (1.6 / EA + 1 / lag(grout, length)), rel=2e-2)  # unloads elastically
	assert polytope.bolts().unsolved == 0


def testAGroutedBoltTiesEveryJointThatItCrosses():
	grout, free = 1e9, 0.1
	states = blocks(3, half=(1.0, 0.5, 0.5), gap=1e-3)
	bolt = polytope.bolt((-1, 0, 0), (4.9, 0, 0), **bar, grout=Grout(grout, inf), plate=False, freeLength=free)
	assert [(one.id1, one.id2) for one in bolt.crossings] == [(0, 1), (1, 2)]
	moved(states[2], states[2].pos + Vector3(1e-4, 0, 0))
	deep = sqrt(EA * grout)  # a long bolt; the middle block's length is 6 times the transfer length
	expected = 1 / ((free + 1e-3) / EA + 2 / deep)
	assert bolt.crossings[1].tension == pytest.approx(expected * 1e-4, rel=0.01)
	assert abs(bolt.crossings[0].tension) < 0.01 * bolt.crossings[1].tension
	assert O.forces.f(2)[0] == pytest.approx(-bolt.crossings[1].tension)


def testSteelYieldsAtTheJointAndBreaksByItsFreeLength():
	states = blocks(gap=1e-3)
	start = Vector3(states[1].pos)
	bolt = polytope.bolt(
		(-1, 0, 0), (2.9, 0, 0), **bar, grout=Grout(1e10, 1e7), plate=False, yieldForce=1e5, ruptureStrain=0.1, freeLength=0.1
	)
	long = max(np.diff(bolt.stations))
	for opening in np.linspace(0, 0.098 * long, 20):
		moved(states[1], start + Vector3(opening, 0, 0))
	assert bolt.largestForce == pytest.approx(1e5, rel=1e-9) and bolt.crossings[0].tension == pytest.approx(1e5, rel=1e-9)
	moved(states[1], start + Vector3(0.105 * long, 0, 0))
	assert bolt.crossings[0].failure == 'rupture' and O.forces.f(1).norm() == 0


def testPretensionOfAGroutedAnchor():
	blocks(gap=0.1)
	bolt = polytope.bolt((-0.5, 0, 0), (1.9, 0, 0), **bar, grout=Grout(1e9, 2e5, length=0.8), pretension=1e5)
	O.step()
	assert bolt.headForce == pytest.approx(1e5, rel=1e-9)
	assert O.forces.f(0)[0] == pytest.approx(1e5, rel=1e-9) and O.forces.f(1)[0] == pytest.approx(-1e5, rel=1e-9)
	assert sum(bolt.groutForces) == pytest.approx(-1e5, rel=1e-6)


@pytest.mark.parametrize('plate, free', [(True, None), (False, None), (False, 0.3)])
def testPullOutIsTheStrengthOfWhatIsGrouted(plate, free):
	"""g times the length in the weaker block, less half of what is free at the joint; a plate holds the head's side."""
	strength, states = 1e5, blocks(half=(0.5, 0.5, 0.5))
	start = Vector3(states[1].pos)
	bolt = polytope.bolt(
		(-0.2, 0, 0), (1.3, 0, 0), **bar, grout=Grout(1e9, strength), plate=plate, **({} if free is None else {'freeLength': free})
	)
	free = 4 * sqrt(4 * area / pi) if free is None else free
	assert bolt.freeLength == pytest.approx(free)
	holds = strength * ((0.8 if plate else 0.7) - free / 2)
	assert sum(bolt.groutStrengths) == pytest.approx(strength * (1.5 - free))
	for opening in np.linspace(0, 0.01, 50):
		moved(states[1], start + Vector3(opening, 0, 0))
	assert bolt.crossings[0].tension == pytest.approx(holds, rel=1e-4)


# ------------------------------------------------------------------------------------------------ shear


def testDowelIsElasticThenPlastic():
	states = blocks(gap=1e-3)
	start = Vector3(states[1].pos)
	bolt = polytope.bolt((-1, 0, 0), (2.9, 0, 0), area=1e-9, youngsModulus=1e3, grout=Grout(1e7, inf), plate=False, dowel=Dowel(5e7, 8e4))
	crossing = bolt.crossings[0]
	for shear, force in ((1e-4, 5e3), (1e-3, 5e4), (1.6e-3, 8e4), (5e-3, 8e4), (4e-3, 3e4), (2e-3, -7e4), (1e-3, -8e4)):
		moved(states[1], start + Vector3(0, 0.6 * shear, -0.8 * shear))
		assert np.array(crossing.shearForce) == pytest.approx(np.array([0, -0.6, 0.8]) * force, rel=1e-9, abs=1e-6), shear
		assert np.array(O.forces.f(1)) == pytest.approx(np.array(crossing.shearForce), abs=1e-3)


def testShearAcrossAJointBendsTheSteelToo():
	"""Dowel, and the tension that the free length has when the joint shears: EA (√(l² + δ²) − l)/l, in series with the grout."""
	grout, free = 1e10, 0.1
	states = blocks(gap=1e-3)
	start = Vector3(states[1].pos)
	polytope.bolt(
		(-1, 0, 0), (2.9, 0, 0), **bar, grout=Grout(grout, inf), plate=False, dowel=Dowel(5e7, 8e4), freeLength=free, yieldForce=1e5
	)
	long = free + 1e-3
	stiffness = 1 / (long / EA + 2 / sqrt(EA * grout))
	for shear in (5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2):
		moved(states[1], start + Vector3(0, shear, 0))
		slanted = sqrt(long**2 + shear**2)
		tension = min(1e5, stiffness * (slanted - long))
		assert -O.forces.f(1)[1] == pytest.approx(min(5e7 * shear, 8e4) + tension * shear / slanted, rel=0.01), shear
		assert -O.forces.f(1)[0] == pytest.approx(tension * long / slanted, rel=0.01)


def testDowelOfABar():
	"""A long beam on an elastic foundation, loaded at its end: y = 2 P β/k, on both sides of the joint."""
	dowel = Dowel.ofBar(0.025, 2e11, 3e9, 4e8, 5e7)
	bending = 2e11 * math.pi * 0.025**4 / 64
	beta = (3e9 / (4 * bending)) ** 0.25
	assert dowel.stiffness == pytest.approx(1 / (2 * 2 * beta / 3e9), rel=1e-12)
	assert dowel.strength == pytest.approx(0.67 * 0.025**2 * sqrt(4e8 * 5e7), rel=1e-12)
	with pytest.raises(ValueError, match='^rockStrength: '):
		Dowel.ofBar(0.025, 2e11, 3e9, 4e8, 0)


# ------------------------------------------------------------------------------------------------ balance


@pytest.mark.parametrize(
	'made', [dict(), dict(grout=Grout(1e9, 2e5), dowel=Dowel(1e8, 5e4)), dict(grout=Grout(1e9, 2e5), dowel=Dowel(1e8, 5e4), plate=False)]
)
def testForcesAndMomentsOfAllBodiesAreOppositePairs(made):
	random = np.random.default_rng(1)
	states = blocks(4, gap=0.05, moves=True)
	polytope.bolt((-0.6, -0.3, 0.2), (6.7, 0.3, -0.2), **bar, pretension=1e4 if made.get('plate', True) else 0, **made)
	for _ in range(5):
		for state in states[1:]:
			state.pos += Vector3(2e-3, 0, 0) + Vector3(*random.uniform(-2e-3, 2e-3, 3))
			state.ori = Quaternion(Vector3(*random.uniform(-1, 1, 3)).normalized(), 1e-2) * state.ori
		places = [np.array(state.pos) for state in states]
		O.step()
		forces, moments = ([np.array(of(k)) for k in range(4)] for of in (O.forces.f, O.forces.t))
		scale = max(np.linalg.norm(force) for force in forces)
		assert scale > 1e3
		assert np.abs(sum(forces)).max() < 1e-12 * scale
		assert np.abs(sum(m + np.cross(x, f) for m, x, f in zip(moments, places, forces, strict=True))).max() < 1e-11 * scale


def testClumpsAndErasedBlocks():
	joint()
	parts = [polytope.cuboid((2 + k, 0, 0), (0.5, 0.5, 0.5)) for k in (0.1, 1.1)]
	O.bodies.append(polytope.cuboid((0.5, 0, 0), (1, 0.5, 0.5), fixed=True))
	O.bodies.append(parts)
	O.bodies.clump([1, 2])
	O.bodies.append(polytope.cuboid((4.7, 0, 0), (1, 0.5, 0.5)))
	loop(True)
	bolt = polytope.bolt((-0.5, 0, 0), (5.5, 0, 0), **bar, grout=Grout(1e9, inf))
	assert [(one.id1, one.id2) for one in bolt.crossings] == [(0, 1), (1, 4)]
	O.dt = 1e-9
	O.step()
	O.bodies.erase(4)
	O.step()
	assert polytope.bolts().dropped == 1 and [one.failure for one in bolt.crossings] == ['', 'erased']
	O.bodies[3].state.pos += Vector3(1e-3, 0, 0)  # the clump
	for part in (1, 2):
		O.bodies[part].state.pos += Vector3(1e-3, 0, 0)
	O.step()
	assert bolt.crossings[0].tension > 1e4 and O.forces.f(0)[0] == pytest.approx(bolt.crossings[0].tension)
	O.bodies.erase(0)
	O.step()
	assert polytope.bolts().dropped == 2 and polytope.bolts().actingCount == 0


# ------------------------------------------------------------------------------------------------ what is refused


good = dict(head=(-0.5, 0, 0), end=(2.5, 0, 0), area=5e-4, youngsModulus=2e11)
refused = [
	('head, end: are the same point', dict(end=(-0.5, 0, 0))),
	('head, end: the line .* meets no block', dict(head=(0, 0, 5), end=(3, 0, 5))),
	('head, end: the line .* lies in body 0 alone', dict(end=(0.5, 0, 0))),
	('end: .* lies in no block', dict(end=(9, 0, 0))),
	('head: must be finite', dict(head=(0, 0, nan))),
	('end: must be three numbers', dict(end=(1, 2))),
	*(('area: must be positive', dict(area=x)) for x in (0, -1, nan, inf)),
	*(('youngsModulus: must be positive', dict(youngsModulus=x)) for x in (0, nan)),
	('youngsModulus: must be a number', dict(youngsModulus='steel')),
	('yieldForce: must be above 0', dict(yieldForce=0)),
	('ruptureStrain: must be above 0', dict(ruptureStrain=nan)),
	('ruptureStrain: .* = 0.002, got 0.001: it would break at 100000 N .*leave out yieldForce', dict(ruptureStrain=1e-3, yieldForce=2e5)),
	('pretension: must be at least 0', dict(pretension=-1)),
	('pretension: must be at most the yieldForce', dict(pretension=2e5, yieldForce=1e5)),
	('pretension: must be less than', dict(pretension=2e6, ruptureStrain=0.01)),
	('pretension: needs a plate', dict(pretension=1e3, plate=False, grout=Grout(1e9, 1e5))),
	('pretension: 400000 N is more than the grout holds', dict(pretension=4e5, grout=Grout(1e9, 1e5))),
	('plate: nothing holds the head', dict(plate=False)),
	('plate: must be True or False', dict(plate=1)),
	('grout: must be a polytope.Grout', dict(grout=1e9)),
	('grout: its stiffness must be positive', dict(grout=Grout(0, 1e5))),
	('grout: its stiffness must be positive', dict(grout=Grout(nan, 1e5))),
	('grout: must be of a strength', dict(grout=Grout(1e9, 0))),
	('grout: must be of a length', dict(grout=Grout(1e9, 1e5, length=-2))),
	("grout: must be of a length at most the bolt's own, from head to end", dict(grout=Grout(1e9, 1e5, length=20))),
	('grout: holds the bolt in one block alone', dict(grout=Grout(1e9, 1e5, length=0.3), plate=False)),
	('dowel: a bolt without grout', dict(dowel=Dowel(1e8, 1e5))),
	('dowel: must be of a strength', dict(grout=Grout(1e9, 1e5), dowel=Dowel(1e8, nan))),
	('dowel: its stiffness must be positive', dict(grout=Grout(1e9, 1e5), dowel=Dowel(-1, 1e5))),
	('freeLength: must be positive', dict(grout=Grout(1e9, 1e5), freeLength=0)),
	('freeLength: must not be negative', dict(freeLength=-1)),
]


@pytest.mark.parametrize('message,change', refused)
def testBadInputNamesTheArgument(message, change):
	blocks()
	engines = list(O.engines)
	with pytest.raises(ValueError, match=f'^{message}'):
		polytope.bolt(**{**good, **change})
	assert polytope.bolts() is None and list(O.engines) == engines
	polytope.bolt(**good)
	with pytest.raises(ValueError, match=f'^{message}'):
		polytope.bolt(**{**good, **change})
	assert len(polytope.bolts().bolts) == 1


def testScenesThatBoltsCannotBeIn():
	with pytest.raises(ValueError, match='^engines: set O.engines first'):
		polytope.bolt(**good)
	blocks()
	O.periodic = True
	O.cell.setBox(9, 9, 9)
	with pytest.raises(ValueError, match='periodic cell'):
		polytope.bolt(**good)
	O.reset()
	joint()
	square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
	O.bodies.append([polytope.polygon(square, center=(0, 0, 0)), polytope.polygon(square, center=(2, 0, 0))])
	loop(True)
	with pytest.raises(ValueError, match='^head, end: a bolt through polygons'):
		polytope.bolt(**{**good, 'end': (2.5, 0, 0.3)})
	assert polytope.bolt(**good).crossings[0].id2 == 1
