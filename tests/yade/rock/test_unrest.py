# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.settle names the bodies that do not come to rest, and why, as soon as that is clear."""

import math
import re

import pytest
from scenes import joint
from yade import O, PyRunner, Quaternion, Vector3, polytope
from yade.polytope.rest.unrest import patience


def floor(half=2.0, dip=0.0, flat=False):
	"""A fixed slope through the origin that dips towards x."""
	turn = Quaternion((0, 0, 1), -dip) if flat else Quaternion((0, 1, 0), dip)
	if flat:
		corners = [turn * Vector3(x, y, 0) for x, y in ((-half, -1), (half, -1), (half, 0), (-half, 0))]
		O.bodies.append(polytope.polygon([(c[0], c[1]) for c in corners], fixed=True))
	else:
		O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, -0.5), (half, half, 0.5), orientation=turn, fixed=True))
	return turn


def block(turn, x, flat=False):
	if flat:
		corners = [turn * Vector3(x + dx, y, 0) for dx, y in ((-0.25, 0), (0.25, 0), (0.25, 0.5), (-0.25, 0.5))]
		return O.bodies.append(polytope.polygon([(c[0], c[1]) for c in corners]))
	return O.bodies.append(polytope.cuboid(turn * Vector3(x, 0, 0.25), (0.25, 0.25, 0.25), orientation=turn))


def engines(flat=False):
	O.engines = polytope.engines(gravity=(0, -9.81, 0) if flat else (0, 0, -9.81))


def settleFails(**arguments):
	with pytest.raises(polytope.NotAtRest) as told:
		polytope.settle(**arguments)
	return told.value


@pytest.mark.parametrize('flat', [False, True])
def testWhatFallsIsToldAtOnce(flat):
	joint(normalStiffness=1e7, shearStiffness=1e7)
	turn = floor(flat=flat)
	stays, falls = block(turn, 0, flat), block(turn, 3, flat)
	engines(flat)
	error = settleFails()
	assert [(one.id, one.kind) for one in error.bodies] == [(falls, 'falls')]
	assert f'body {falls} touches nothing, and nothing is below it (1)' in str(error) and 'a support for what falls' in str(error)
	assert O.iter <= 1250
	O.bodies.erase(falls)
	assert polytope.settle() > 0 and O.bodies[stays].state.vel.norm() < 1e-4


@pytest.mark.parametrize('flat', [False, True])
def testWhatCouldHangByABondIsToldSo(flat):
	"""The block's tensile strength would hold it, but it only touches what it hangs from."""
	joint(normalStiffness=1e9, shearStiffness=1e9, tensileStrength=1e5, cohesion=1e6)
	if flat:
		O.bodies.append(polytope.polygon([(-2, 0), (2, 0), (2, 1), (-2, 1)], fixed=True))
		O.bodies.append(polytope.polygon([(-0.5, -1), (0.5, -1), (0.5, 0), (-0.5, 0)]))
	else:
		O.bodies.append(polytope.cuboid((0, 0, 1), (2, 2, 1), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (0.5, 0.5, 0.5)))
	engines(flat)
	found = polytope.check(O)['hangs']
	assert 'body 1 hangs from body 0' in found.seen and 'polytope.bond()' in found.advice
	O.saveTmp(quiet=True)
	assert 'polytope.bond() before, if it should hang by its tensileStrength' in str(settleFails())
	O.loadTmp(quiet=True)
	assert polytope.bond() == 1 and not any(one.what == 'hangs' for one in polytope.check(O))
	assert polytope.settle() > 0


@pytest.mark.parametrize('flat', [False, True])
def testWhatTopplesIsToldSo(flat):
	"""Four times as high as wide, on 20°: it turns over its foot."""
	joint(normalStiffness=1e10, shearStiffness=1e10, frictionAngle=math.radians(35))
	down = 9.81 * math.sin(math.radians(20)), -9.81 * math.cos(math.radians(20))
	if flat:
		floor(6, flat=True)
		O.bodies.append(polytope.polygon([(-0.5, 0), (0.5, 0), (0.5, 4), (-0.5, 4)]))
		O.engines = polytope.engines(gravity=(*down, 0))
	else:
		floor(6)
		O.bodies.append(polytope.cuboid((0, 0, 2), (0.5, 0.5, 2)))
		O.engines = polytope.engines(gravity=(down[0], 0, down[1]))
	error = settleFails(steps=16000)
	assert [(one.id, one.kind) for one in error.bodies] == [(1, 'topples')]
	assert re.search(r'body 1 topples: turned by \d+°', str(error)) and 'a wider base, a support' in str(error)


def testWhatFallsOnSomethingIsWaitedFor():
	joint(normalStiffness=1e9, shearStiffness=1e9)
	turn = floor()
	above = block(turn, 0)
	O.bodies[above].state.pos += (0, 0, 3)
	engines()
	steps = polytope.settle(damping=0.2)
	assert steps > 1250 and O.bodies[above].state.pos[2] == pytest.approx(0.25, abs=1e-3)


@pytest.mark.parametrize('flat', [False, True])
def testWhatSlidesIsToldWithItsBase(flat):
	joint(normalStiffness=1e7, shearStiffness=1e7, frictionAngle=math.radians(20))
	turn = floor(40, math.radians(30), flat)
	slides = block(turn, -30, flat)
	engines(flat)
	error = settleFails(elastic=False)
	assert [(one.id, one.kind) for one in error.bodies] == [(slides, 'slides')]
	assert 'slides on body 0, by ' in str(error) and 'more strength or a support' in str(error)
	assert O.iter <= patience
	way = (O.bodies[slides].state.pos - turn * Vector3(-30, 0.25 if flat else 0, 0 if flat else 0.25)).norm()
	assert way < 30  # long before its end


def testWhatTremblesIsToldInABoundedTime():
	"""A force that changes its sign every 20 steps, as of a contact that comes and goes."""
	joint(normalStiffness=1e7, shearStiffness=1e7)
	turn = floor()
	rests, trembles = block(turn, -1), block(turn, 1)
	engines()
	push = PyRunner(command=f'O.forces.addF({trembles}, Vector3((-1) ** (O.iter // 20), 0, 0))', iterPeriod=1)
	O.engines = O.engines[:3] + [push] + O.engines[3:]
	error = settleFails()
	assert [(one.id, one.kind) for one in error.bodies] == [(trembles, 'trembles')] and rests
	least = error.bodies[0].unbalanced
	assert 1e-5 < least < 1e-2 and f'body {trembles} trembles in place ({least:.2g})' in str(error)
	assert patience <= O.iter <= 2 * patience
	assert polytope.settle(unbalanced=10 * least) < 1000  # the remedy


def testThinOnesAreCalledThin():
	joint(normalStiffness=1e7, shearStiffness=1e7)
	floor()
	plate = O.bodies.append(polytope.cuboid((0, 0, 0.02), (0.5, 0.5, 0.02)))
	engines()
	push = PyRunner(command=f'O.forces.addF({plate}, Vector3((-1) ** (O.iter // 20), 0, 0))', iterPeriod=1)
	O.engines = O.engines[:3] + [push] + O.engines[3:]
	assert 'is thin' in str(error := settleFails()) and '*smallest* of polytope.jointedRock' in str(error)


def testWhatComesToRestSlowlyIsNotGivenUp():
	"""A column that swings for many periods with hardly any damping."""
	joint(normalStiffness=1e7, shearStiffness=1e7)
	floor()
	for k in range(5):
		O.bodies.append(polytope.cuboid((0, 0, 0.5 * k + 0.25), (0.25, 0.25, 0.25)))
	engines()
	assert polytope.settle(unbalanced=1e-6, damping=0.01) > 5000


@pytest.mark.parametrize('stiffness, dip', [(1e10, 17), (1e11, 17.3)])
def testASlenderColumnOnASlopeIsWaitedFor(stiffness, dip):
	"""Three times as high as wide, it topples at 18.4°: near that it swings so slowly that its force does not fade between 2500 and 10000 steps."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=math.radians(40))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (6, 6, 0.5), fixed=True))
	column = O.bodies.append(polytope.cuboid((0, 0, 1.5), (0.5, 0.5, 1.5)))
	O.engines = polytope.engines(gravity=(9.81 * math.sin(math.radians(dip)), 0, -9.81 * math.cos(math.radians(dip))))
	assert polytope.settle() > 2 * patience
	assert 0 < O.bodies[column].state.pos[0] < 0.005


@pytest.mark.parametrize('flat', [False, True])
def testWhatSlidesAwayIsToldBesideWhatMoves(flat):
	"""Another block is pushed up and down its slope as long as it is run."""
	joint(normalStiffness=1e7, shearStiffness=1e7, frictionAngle=math.radians(60))
	turn = floor(60, math.radians(30), flat)
	moves = block(turn, 55, flat)
	joint(normalStiffness=1e7, shearStiffness=1e7, frictionAngle=math.radians(20))
	slides = block(turn, -55, flat)
	O.bodies[slides].material = O.materials[1]
	engines(flat)
	push = 0.6 * 9.81 * O.bodies[moves].state.mass * (turn * Vector3(-1, 0, 0))
	command = f'O.forces.addF({moves}, Vector3({push[0]}, {push[1]}, {push[2]})) if O.iter % 3000 < 1500 else None'
	O.engines = O.engines[:3] + [PyRunner(command=command, iterPeriod=1)] + O.engines[3:]
	error = settleFails(elastic=False)
	assert [(one.id, one.kind) for one in error.bodies] == [(slides, 'slides')]
	assert O.iter <= patience and O.bodies[slides].state.vel.norm() > 0.1


def testWhatFallsOverAnEdgeIsToldThen():
	"""A block that slides off its base, with nothing below: not at the end of the span, after 20000 steps."""
	joint(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=math.radians(20))
	slides = block(floor(3, math.radians(30)), 2.9)
	engines()
	error = settleFails(elastic=False)
	assert [(one.id, one.kind) for one in error.bodies] == [(slides, 'falls')]
	assert O.iter < 10000 and O.bodies[slides].state.pos[2] < -3 * math.sin(math.radians(30))


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('bonded', [False, True])
def testBlocksThatFallOnEachOtherAreToldAtOnce(bonded, flat):
	"""A column of three and, above it, one apart: nothing but falling blocks is below any of them."""
	joint(normalStiffness=1e8, shearStiffness=1e8, tensileStrength=1e6, cohesion=1e6)
	turn = floor(flat=flat)
	stays, *falling = block(turn, 0, flat), *(block(turn, 3, flat) for _ in range(4))
	for k, high in zip(falling, (0, 0.5, 1, 3), strict=True):
		O.bodies[k].state.pos += (0, high, 0) if flat else (0, 0, high)
	engines(flat)
	if bonded:
		assert polytope.bond() == 3
	error = settleFails()
	assert sorted((one.id, one.kind) for one in error.bodies) == [(k, 'falls') for k in falling]
	ones = {one.id: one.why for one in error.bodies}
	alone = 'touches nothing, and nothing is below it'
	assert ones[falling[3]] == alone
	assert ones[falling[0]] == (f'falls together with body {falling[1]} and 1 more, and nothing is below' if bonded else alone)
	assert O.iter <= 5000
	for k in falling:
		O.bodies.erase(k)
	assert polytope.settle() > 0 and O.bodies[stays].state.vel.norm() < 1e-4


@pytest.mark.parametrize('flat', [False, True])
def testBlocksThatFallTogetherOnSomethingAreWaitedFor(flat):
	joint(normalStiffness=1e9, shearStiffness=1e9)
	turn = floor(flat=flat)
	column = [block(turn, 0, flat) for _ in range(3)]
	for n, k in enumerate(column):
		O.bodies[k].state.pos += (0, 3 + 0.5 * n, 0) if flat else (0, 0, 3 + 0.5 * n)
	engines(flat)
	assert polytope.settle(damping=0.4) > 1250
	for n, k in enumerate(column):
		assert O.bodies[k].state.pos[1 if flat else 2] == pytest.approx(0.25 + 0.5 * n, abs=1e-3)


def testABlockThatHangsByASoftBondIsWaitedFor(recwarn):
	"""It sinks by more than its size, W/(kₙ A), with nothing below, from one that cannot move; the bond holds it, so it is not named as one
	that fell."""
	joint(normalStiffness=1e4, shearStiffness=1e4, tensileStrength=1e9, cohesion=1e9)
	holds, hangs = (O.bodies.append(polytope.cuboid((0, 0, z), (0.25, 0.25, 0.25))) for z in (0, -0.5))
	O.bodies[holds].state.blockedDOFs = 'xyzXYZ'
	engines()
	assert polytope.bond() == 1
	sinks = float(O.bodies[hangs].state.mass) * 9.81 / (1e4 * 0.25)
	assert sinks > 1
	recwarn.clear()
	assert polytope.settle(damping=0.1) > 1250
	assert O.bodies[hangs].state.pos[2] == pytest.approx(-0.5 - sinks, rel=1e-3)
	assert not any('moved by more than' in str(one.message) for one in recwarn)
