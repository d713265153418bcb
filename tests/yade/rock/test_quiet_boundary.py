# SPDX-License-Identifier: GPL-2.0-or-later
"""Quiet boundaries: pulses leave a row of blocks, where a fixed or a free end throws them back; waves come in; a column stays at rest."""

import math

import numpy as np
import pytest
from yade import Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, O, QuietBoundary, RockJointMat, Vector3, polytope, utils

kn, ks, density, size = 1e9, 4e8, 2600, 1.0
pWave, sWave = math.sqrt(kn * size / density), math.sqrt(ks * size / density)
count = 60


def row(ends=(1, 1), two=False):
	"""Blocks along x that do not turn, joined by springs; the first and the last one are this part as thick as the others. No gravity."""
	O.materials.append(
		RockJointMat(density=density, normalStiffness=kn, shearStiffness=ks, frictionAngle=0.5, cohesion=1e9, tensileStrength=1e9)
	)
	widths = [ends[0] * size, *[size] * (count - 2), ends[1] * size]
	begins = np.cumsum([0, *widths]) - 1e-10 * size * np.arange(count + 1)  # they touch
	for begin, width in zip(begins, widths, strict=False):
		if two:
			O.bodies.append(polytope.polygon([(begin, 0), (begin + width, 0), (begin + width, 0.7), (begin, 0.7)]))
		else:
			O.bodies.append(polytope.cuboid((begin + width / 2, 0, 0), (width / 2, 0.4, 0.5)))
		O.bodies[-1].state.blockedDOFs = 'XYZ'
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()  # whose dampers would take from waves
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, law=law)
	O.step()
	assert all(O.interactions[k, k + 1].phys.bond for k in range(count - 1))


def pulse(direction, width=5.0):
	"""A velocity in the middle, half of which runs to either side."""
	for body in O.bodies:
		body.state.vel = Vector3(direction) * 1e-3 * math.exp(-(((body.id - count / 2) / width) ** 2) / 2)


def comesBack(speed, direction):
	"""Largest velocity in the middle once the pulses have come back from the ends, over half of that which there was at first."""
	begin, along = O.time, np.array(direction, float)
	most = 0.0
	while O.time < begin + 1.6 * count * size / speed:
		O.run(5, wait=True)
		if O.time > begin + 0.6 * count * size / speed:
			most = max(most, abs(float(np.dot(np.array(O.bodies[count // 2].state.vel, float), along))))
	return most / 0.5e-3


waves = pytest.mark.parametrize('direction, speed', [((1, 0, 0), pWave), ((0, 1, 0), sWave)])


@waves
@pytest.mark.parametrize('fixed', [False, True])
def testOtherEndsThrowAPulseBack(direction, speed, fixed):
	row(ends=(0.5, 1))
	polytope.quietBoundary(0, (-1, 0, 0), pWave, sWave)
	if fixed:
		O.bodies[count - 1].state.blockedDOFs = 'xyzXYZ'
	pulse(direction)
	assert comesBack(speed, direction) == pytest.approx(1, abs=0.06)


@waves
@pytest.mark.parametrize('two', [False, True])
def testAPulseLeavesThroughAQuietBoundary(direction, speed, two):
	row(ends=(0.5, 0.5), two=two)
	polytope.quietBoundary(0, (-1, 0, 0), pWave, sWave)
	polytope.quietBoundary([count - 1], (2, 0, 0), pWave, sWave)
	pulse(direction)
	assert comesBack(speed, direction) < 0.01


@waves
def testAWholeBlockAtTheBoundaryReflectsByItsExcessMass(direction, speed):
	"""Half a block too much: θ/4 of a wave of θ = ω h/c, which grows with the frequency: the derivative of the pulse times h/(4 c)."""
	row(ends=(0.5, 1))
	polytope.quietBoundary(0, (-1, 0, 0), pWave, sWave)
	polytope.quietBoundary(count - 1, (1, 0, 0), pWave, sWave)
	pulse(direction, width=5.0)
	assert comesBack(speed, direction) == pytest.approx(math.exp(-0.5) / 5 / 4, rel=0.1)


@waves
def testAWaveThatComesInIsTwiceAsLargeAtTheFreeEndAndLeaves(direction, speed):
	row(ends=(0.5, 0.5))
	width = 5 * size / speed
	times = np.linspace(0, 12 * width, 300)
	velocities = 1e-3 * np.exp(-(((times - 6 * width) / width) ** 2) / 2)
	history = polytope.velocityHistory(velocities, times=times, kind='velocity', direction=direction)
	polytope.quietBoundary(0, (-1, 0, 0), pWave, sWave, history=history)
	begin, most, along = O.time, 0.0, np.array(direction, float)
	while O.time < begin + 6 * width + 1.5 * count * size / speed:
		O.run(5, wait=True)
		most = max(most, float(np.array(O.bodies[count - 1].state.vel, float) @ along))
	assert most == pytest.approx(2e-3, rel=1e-2)
	while O.time < begin + 12 * width + 2.5 * count * size / speed:
		O.run(20, wait=True)
	assert max(float(body.state.vel.norm()) for body in O.bodies) < 0.01e-3


def energyLeft(quiet, number=11):
	"""Energy of the motion of a square mass of joined blocks, struck in its middle, when waves have crossed it three times, over that at
	first; no side is held."""
	O.materials.append(
		RockJointMat(density=density, normalStiffness=kn, shearStiffness=ks, frictionAngle=0.5, cohesion=1e9, tensileStrength=1e9)
	)
	widths = np.array([0.5 * size, *[size] * (number - 2), 0.5 * size])
	begins = np.cumsum([0, *widths]) - 1e-9 * size * np.arange(number + 1)
	ids = np.empty((number, number), int)
	for i, j in np.ndindex(number, number):
		x, y, right, top = begins[i], begins[j], begins[i] + widths[i], begins[j] + widths[j]
		ids[i, j] = O.bodies.append(polytope.polygon([(x, y), (right, y), (right, top), (x, top)]))
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.05, shearDamping=0.05)
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, law=law)
	if quiet:
		for side, normal in ((ids[0], (-1, 0, 0)), (ids[-1], (1, 0, 0)), (ids[:, 0], (0, -1, 0)), (ids[:, -1], (0, 1, 0))):
			polytope.quietBoundary(side, normal, pWave, sWave)
	for i, j in np.ndindex(number, number):
		far = ((i - number // 2) ** 2 + (j - number // 2) ** 2) / 2**2
		O.bodies[int(ids[i, j])].state.vel = Vector3(0, 1e-3, 0) * math.exp(-far / 2)
	begin = polytope.mechanicalEnergy()
	while O.time < 3 * number * size / pWave:
		O.run(20, wait=True)
	return polytope.mechanicalEnergy() / begin


def testAMassStruckInItsMiddleComesToRestThroughItsFourSides():
	"""P and S waves, obliquely too; blocks at the corners have two boundaries, and blocks turn."""
	assert energyLeft(quiet=False) > 0.2
	O.reset()
	assert energyLeft(quiet=True) < 2e-3


# ------------------------------------------------------------------------------------------------ a column under gravity


def column():
	O.materials.append(RockJointMat(density=density, normalStiffness=kn, shearStiffness=ks, frictionAngle=1.0))
	base = O.bodies.append(polytope.cuboid((0, 0, -0.25), (0.6, 0.5, 0.25), fixed=True))
	for k in range(6):
		O.bodies.append(polytope.cuboid((0, 0, k + 0.5), (0.6, 0.5, 0.5)))
	O.engines = polytope.engines(damping=0)
	polytope.settle(unbalanced=1e-8)
	return base


@pytest.mark.parametrize('loaded', [False, True])
def testWhatTheBoundaryBearsAtRestIsHeld(loaded, tmp_path):
	"""It is held also right after O.load, before forces are computed again."""
	base = column()
	if loaded:
		O.save(str(tmp_path / 'state.yade'))
		O.load(str(tmp_path / 'state.yade'))
	polytope.quietBoundary(base, (0, 0, -1), pWave, sWave)
	weight = sum(float(body.state.mass) for body in O.bodies) * 9.81
	(engine,) = (one for one in O.engines if isinstance(one, QuietBoundary))
	assert engine.supports[0][2] == pytest.approx(weight, rel=1e-4)
	assert engine.normalDashpots[0] == pytest.approx(1.2 * density * pWave) and engine.shearDashpots[0] == pytest.approx(
		1.2 * density * sWave
	)
	assert np.array(engine.faces[0], float) == pytest.approx([0, 0, -0.25])
	places = [Vector3(body.state.pos) for body in O.bodies]
	O.run(5000, wait=True)
	assert max(float((body.state.pos - place).norm()) for body, place in zip(O.bodies, places, strict=True)) < 1e-7


def testAColumnThatWasStruckComesToRestThroughItsBase(tmp_path):
	"""The column's momentum goes into the dashpot: all of it moves by m v/(ρ c_p A)."""
	base = column()
	polytope.quietBoundary(base, (0, 0, -1), pWave, sWave)
	top = O.bodies[len(O.bodies) - 1]
	top.state.vel = (0, 0, -0.01)
	place = float(O.bodies[base].state.pos[2])
	begin = O.time
	O.save(str(tmp_path / 'state.yade'))
	ends = []
	for _ in range(2):
		while O.time < begin + 1:
			O.run(200, wait=True)
		ends.append(float(O.bodies[base].state.pos[2]))
		assert max(float(body.state.vel.norm()) for body in O.bodies) < 1e-5
		O.load(str(tmp_path / 'state.yade'))
	moved = -0.01 * 1.2 * density / (density * pWave * 1.2)
	assert ends[0] - place == pytest.approx(moved, rel=1e-2) and ends[1] == pytest.approx(ends[0], abs=1e-12)


# ------------------------------------------------------------------------------------------------ what is refused


def testArgumentsThatCannotBeAreNamed():
	base = column()
	sphere = O.bodies.append(utils.sphere((9, 0, 0), 1))
	O.bodies.appendClumped([polytope.cuboid((20 + x, 0, 0), (0.5, 0.5, 0.5)) for x in (0, 1)])
	engines, blocked = len(O.engines), O.bodies[base].state.blockedDOFs
	for arguments, message in (
		((99, (0, 0, -1), 1, 1), '^ids: there is no body 99'),
		(([], (0, 0, -1), 1, 1), '^ids: there must be one'),
		((base, (0, 1, -1), 1, 1), '^ids: body 0 has no face'),
		((sphere, (0, 0, -1), 1, 1), '^ids: body 7 is no polytope'),
		((8, (0, 0, -1), 1, 1), '^ids: body 8 is a member of clump 10'),
		((10, (0, 0, -1), 1, 1), '^ids: body 10 is no polytope'),
		((base, (0, 0, 0), 1, 1), '^normal: must not be zero'),
		((base, 'down', 1, 1), '^normal'),
		((base, (0, 0, -1), -1, 1), '^pWave'),
		((base, (0, 0, -1), 1, math.inf), '^sWave'),
		((base, (0, 0, -1), 1, 1, [0, 1]), '^history'),
	):
		with pytest.raises(ValueError, match=message):
			polytope.quietBoundary(*arguments)
	assert len(O.engines) == engines and O.bodies[base].state.blockedDOFs == blocked
	polytope.quietBoundary(base, (0, 0, -1), pWave, sWave)
	with pytest.raises(ValueError, match='^ids: O.engines has a QuietBoundary'):
		polytope.quietBoundary(base, (0, 0, -1), pWave, sWave)


def testAFaceThatANeighbourPressesOnIsNoBoundary():
	base = column()
	engines = len(O.engines)
	for ids, normal, other in (([base], (0, 0, 1), 1), ([3], (0, 0, -1), 2), ([3, 6], (0, 0, 1), 4)):
		with pytest.raises(ValueError, match=f'^ids: body {other} presses on the face of body {ids[0]} .*where the model ends'):
			polytope.quietBoundary(ids, normal, pWave, sWave)
	assert len(O.engines) == engines
	polytope.quietBoundary(6, (0, 0, 1), pWave, sWave)  # the free surface


def testAFreeBodyThatIsNotAtRestIsRefused():
	"""Dashpots would let it sink with a steady speed."""
	O.materials.append(RockJointMat(density=density, normalStiffness=kn, shearStiffness=ks, frictionAngle=1.0))
	blocks = [O.bodies.append(polytope.cuboid((0, 0, k), (0.6, 0.5, 0.5))) for k in range(3)]
	O.engines = polytope.engines(damping=0)
	engines = len(O.engines)
	with pytest.raises(ValueError, match=rf'^ids: body {blocks[0]} can move and is not at rest .*Fix it'):
		polytope.quietBoundary(blocks[0], (0, 0, -1), pWave, sWave)
	assert len(O.engines) == engines and O.bodies[blocks[0]].state.blockedDOFs == ''
	O.bodies[blocks[0]].dynamic = False
	polytope.settle()
	polytope.quietBoundary(blocks[0], (0, 0, -1), pWave, sWave)


def testADashpotIsStableHoweverStrongItIs():
	"""c A Δt/m of 100 and more: what moves stops, and nothing grows."""
	row(ends=(0.5, 0.5))
	polytope.quietBoundary(0, (-1, 0, 0), 1e3 * pWave, 1e3 * sWave)
	polytope.quietBoundary(count - 1, (1, 0, 0), pWave, sWave)
	assert (
		next(one for one in O.engines if isinstance(one, QuietBoundary)).normalDashpots[0] * float(O.dt) / float(O.bodies[0].state.mass)
		> 100
	)
	pulse((1, 0, 0))
	assert comesBack(pWave, (1, 0, 0)) == pytest.approx(1, abs=0.05)  # as from a fixed end
	assert O.bodies[0].state.vel.norm() < 1e-2 * 0.5e-3


def testListsOfOtherLengthsAreRefused():
	base = column()
	polytope.quietBoundary(base, (0, 0, -1), pWave, sWave)
	engine = next(one for one in O.engines if isinstance(one, QuietBoundary))
	assert not any(one.what in ('damping', 'order of engines') for one in polytope.check(O))
	O.engines = [engine, *(one for one in O.engines if not isinstance(one, QuietBoundary))]
	assert 'QuietBoundary' in polytope.check(O)['order of engines'].seen
	engine.normalDashpots = []
	with pytest.raises(Exception, match='a value for each of ids'):
		O.step()


def testABodyIsEitherMovedOrFree():
	row(ends=(0.5, 1))
	history = polytope.velocityHistory([0, 1e-3, 0], times=0.1, kind='velocity')
	for body in (O.bodies[0], O.bodies[count - 1]):
		body.state.blockedDOFs = 'xyzXYZ'
	polytope.baseMotion(0, history)
	engines = len(O.engines)
	with pytest.raises(ValueError, match='^ids: body 0 is moved by a BaseMotion.*history='):
		polytope.quietBoundary(0, (-1, 0, 0), pWave, sWave)
	polytope.quietBoundary(count - 1, (1, 0, 0), pWave, sWave)
	O.bodies[count - 1].state.blockedDOFs = 'xyzXYZ'
	with pytest.raises(ValueError, match='^ids: some of them are a quiet boundary'):
		polytope.baseMotion(count - 1, history)
	assert len(O.engines) == engines + 1
	O.step()
