# SPDX-License-Identifier: GPL-2.0-or-later
"""Bases that move as a record tells: Newmark's sliding block, a shaken column, records from files, and what is refused."""

import math
from math import cos, pi, radians, sin

import numpy as np
import pytest
from scipy.optimize import brentq
from yade import BaseMotion, O, RockJointMat, VelocityHistory, polytope

gravity = 9.81


def blockOnBase(friction=math.atan(0.3), stiffness=1e10, two=False):
	"""A block on its base, at rest, without damping; returns (number of the base, the block)."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=friction))
	if two:
		base = O.bodies.append(polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True))
		block = O.bodies.append(polytope.polygon([(-1, 0), (1, 0), (1, 1), (-1, 1)]))
	else:
		base = O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 2, 0.5), fixed=True))
		block = O.bodies.append(polytope.cuboid((0, 0, 0.5), (1, 1, 0.5)))
	O.engines = polytope.engines(damping=0)
	polytope.settle(unbalanced=1e-3)
	return base, O.bodies[block]


def way(base, block):
	return float(O.bodies[base].state.pos[0] - block.state.pos[0])


def runUntil(time, steps=100):
	while O.time < time:
		O.run(steps, wait=True)


@pytest.mark.parametrize('two', [False, True])
def testARectangularPulseMovesABlockAsNewmarkSays(two):
	"""d = V²/(2 μ g) (1 − μ/A) for an acceleration A g that ends at the velocity V (Newmark 1965, Géotechnique 15:139-160)."""
	friction, acceleration, duration = 0.3, 0.6, 0.3
	base, block = blockOnBase(math.atan(friction), two=two)
	velocity = acceleration * gravity * duration
	polytope.baseMotion(base, polytope.velocityHistory([0, velocity, velocity], times=[0, duration, 2], kind='velocity', baseline=False))
	before = way(base, block)
	runUntil(O.time + 1.2)
	assert way(base, block) - before == pytest.approx(velocity**2 / (2 * friction * gravity) * (1 - friction / acceleration), rel=5e-3)
	assert block.state.vel[0] == pytest.approx(velocity, rel=1e-3)


def sineSlips(friction, acceleration, omega):
	"""Ways of a block forth and back on a base with the acceleration A sin ωt for one period, until both are at rest."""
	limit = friction * gravity

	def speed(t):
		return acceleration / omega * (1 - cos(omega * t))

	def place(t):
		return acceleration / omega * (t - sin(omega * t) / omega)

	first = math.asin(limit / acceleration) / omega
	second = brentq(lambda t: speed(first) + limit * (t - first) - speed(t), first * 1.01, 2 * pi / omega)
	forth = place(second) - place(first) - speed(first) * (second - first) - limit * (second - first) ** 2 / 2
	assert acceleration * sin(omega * second) < -limit  # it goes on sliding at once
	third = second + speed(second) / limit
	assert third > 2 * pi / omega  # the base is at rest before the block is
	return forth, speed(second) * (third - second) - limit * (third - second) ** 2 / 2 - (place(2 * pi / omega) - place(second))


def testASineMovesABlockAsTheRigidPlasticSolutionSays():
	friction, acceleration, omega = 0.3, 6.0, 2 * pi / 0.8
	base, block = blockOnBase(math.atan(friction))
	forth, back = sineSlips(friction, acceleration, omega)
	times = np.linspace(0, 2 * pi / omega, 401)
	polytope.baseMotion(base, polytope.velocityHistory(acceleration * np.sin(omega * times), times=times))
	before, begin, most = way(base, block), O.time, 0.0
	while O.time < begin + 1.6:
		O.run(50, wait=True)
		most = max(most, way(base, block) - before)
	assert most == pytest.approx(forth, rel=1e-2)
	assert most - (way(base, block) - before) == pytest.approx(back, rel=1e-2)
	assert abs(block.state.vel[0]) < 1e-3 and O.bodies[base].state.vel.norm() == 0


# ------------------------------------------------------------------------------------------------ a column on joints


half, height, number = 0.5, 0.6, 4
kn, ks, density = 1e9, 4e8, 2600


def columnMatrices():
	"""Stiffness and mass of blocks that shift along x and turn about y, the base's first; each joint is a bed of springs over a face."""
	area, second, mass = 4 * half**2, 4 / 3 * half**4, density * 4 * half**2 * height
	stiffness = np.zeros((2 * number + 2, 2 * number + 2))
	for k in range(number):
		shift, turn = np.zeros(2 * number + 2), np.zeros(2 * number + 2)
		shift[2 * k : 2 * k + 4] = -1, -height / 2, 1, -height / 2
		turn[[2 * k + 1, 2 * k + 3]] = -1, 1
		stiffness += ks * area * np.outer(shift, shift) + kn * second * np.outer(turn, turn)
	inertia = mass * (height**2 + 4 * half**2) / 12
	return stiffness, np.diag([mass, inertia] * (number + 1))


def amplification(omega):
	"""Displacement of the topmost block's centre over that of the base, at a steady frequency."""
	stiffness, mass = columnMatrices()
	dynamic = stiffness - omega**2 * mass
	return np.linalg.solve(dynamic[2:, 2:], -dynamic[2:, 0])[-2]


def column():
	O.materials.append(RockJointMat(density=density, normalStiffness=kn, shearStiffness=ks, frictionAngle=radians(60)))
	base = O.bodies.append(polytope.cuboid((0, 0, -height / 2), (half, half, height / 2), fixed=True))
	for k in range(number):
		O.bodies.append(polytope.cuboid((0, 0, (k + 0.5) * height), (half, half, height / 2)))
	O.engines = polytope.engines(damping=0)
	polytope.settle()
	return base


@pytest.mark.parametrize('part', [0.5, 0.8, 1.3])
def testAColumnOfBlocksAmplifiesTheMotionOfItsBase(part):
	"""The base moves below and above the column's first frequency."""
	stiffness, mass = columnMatrices()
	omega = part * math.sqrt(min(np.linalg.eigvals(np.linalg.solve(mass, stiffness)[2:, 2:]).real))
	base = column()
	period, amplitude = 2 * pi / omega, 1e-5
	times = np.linspace(0, 24 * period, 24 * 60 + 1)
	grown = np.clip(times / (16 * period), 0, 1)
	grown = grown**3 * (10 - 15 * grown + 6 * grown**2)  # slowly: its own frequencies stay away
	history = polytope.velocityHistory(amplitude * omega * grown * np.sin(omega * times), times=times, kind='velocity', baseline=False)
	polytope.baseMotion(base, history)
	begin, rows = O.time, []
	while O.time < begin + 24 * period:
		O.run(10, wait=True)
		if O.time > begin + 18 * period:
			rows.append([O.time - begin, O.bodies[base].state.pos[0], O.bodies[number].state.pos[0]])
	t, below, top = np.array(rows, float).T
	waves = np.column_stack([np.sin(omega * t), np.cos(omega * t), np.ones_like(t)])
	low, high = (np.linalg.lstsq(waves, one)[0] for one in (below, top))
	assert np.hypot(*low[:2]) == pytest.approx(amplitude, rel=1e-3)
	assert high[:2] @ low[:2] / (low[:2] @ low[:2]) == pytest.approx(amplification(omega), rel=1e-2)


# ------------------------------------------------------------------------------------------------ records


def testARecordOfAFileMovesTheBaseAsItTells(tmp_path):
	"""The record is in g, with an offset of its zero: the base comes to rest, and its way is the integral of the velocity."""
	random, interval = np.random.default_rng(1), 0.01
	times = 5 + interval * np.arange(200)
	accelerations = np.convolve(random.normal(size=200), np.hanning(9), 'same') * 0.1 + 0.02
	(tmp_path / 'record.txt').write_text('# s, g\n' + ''.join(f'{t:.3f}, {a:.15e}\n' for t, a in zip(times, accelerations, strict=True)))
	base, block = blockOnBase(radians(40))
	begin = O.time
	history = polytope.velocityHistory(tmp_path / 'record.txt', unit=gravity, direction=(3, 4, 0))
	engine = polytope.baseMotion([base], history)
	assert list(O.engines[0].ids) == list(engine.ids) == [base]
	velocities = np.array(history.velocities, float)
	assert np.linalg.norm(velocities[-1]) < 1e-12 and np.linalg.norm(velocities, axis=1).max() > 0.1
	assert velocities[:, 0] * 4 == pytest.approx(velocities[:, 1] * 3, abs=1e-12)
	assert list(map(float, history.times)) == pytest.approx(begin + times - 5, abs=1e-12)
	rate = np.diff(velocities[:, 0]) / interval  # apart from the baseline, the mean of two accelerations
	means = 0.6 * gravity * (accelerations[1:] + accelerations[:-1]) / 2
	assert rate - means == pytest.approx(np.full(199, (rate - means).mean()), abs=1e-9)
	start = np.array(O.bodies[base].state.pos, float)
	runUntil(begin + 2.1)
	expected = interval * (velocities[1:] + velocities[:-1]).sum(axis=0) / 2
	assert np.array(O.bodies[base].state.pos, float) - start == pytest.approx(expected, abs=1e-4 * np.abs(velocities).max())
	assert O.bodies[base].state.vel.norm() < 1e-12


def testThreeComponentsAndTheirBaseline():
	values = np.array([[1, 2, 3], [4, 5, 6], [7, 7, 7]], float)
	history = polytope.velocityHistory(values, times=0.5, kind='velocity', unit=2, start=3)
	assert list(map(float, history.times)) == [3, 3.5, 4]
	assert np.array(history.velocities, float) == pytest.approx(2 * np.array([[0, 0, 0], [0, 0.5, 1], [0, 0, 0]]))
	as_is = polytope.velocityHistory(values, times=0.5, kind='velocity', baseline=False)
	assert np.array(as_is.velocities, float) == pytest.approx(values)
	assert np.array(as_is.at(0.25), float) == pytest.approx([2.5, 3.5, 4.5])
	assert np.array(as_is.at(-0.1), float) == pytest.approx([0, 0, 0]) and np.array(as_is.at(9), float) == pytest.approx([7, 7, 7])


@pytest.mark.parametrize('archive', ['state.xml', 'state.yade.gz'])
def testALoadedSceneGoesOnMoving(archive, tmp_path):
	base, block = blockOnBase()
	polytope.baseMotion(base, polytope.velocityHistory([0, 1, -1, 0], times=0.1, kind='velocity'))
	runUntil(O.time + 0.1)
	O.save(str(tmp_path / archive))
	ends = []
	for _ in range(2):
		for _ in range(300):
			O.step()
		ends.append([*O.bodies[0].state.pos, *O.bodies[1].state.pos])
		O.load(str(tmp_path / archive))
	assert ends[0] == pytest.approx(ends[1], abs=1e-13) and abs(ends[0][0]) > 0.01


# ------------------------------------------------------------------------------------------------ what is refused


@pytest.mark.parametrize(
	'arguments, message',
	[
		(dict(record=[1, 2, 3]), '^times: needed'),
		(dict(record=[1, 2, 3], times=[0, 1]), '^times: must be as many'),
		(dict(record=[1, 2, 3], times=[0, 1, 1]), '^times: times must increase.*row 2'),
		(dict(record=[1, 2, 3], times=-0.1), '^times: times must increase'),
		(dict(record=[1, 2, 3], times='fast'), '^times: must be a sequence'),
		(dict(record=[1, math.nan, 3], times=1), '^record: must be finite.*row 1'),
		(dict(record=[1, 2, 3], times=[0, math.inf, 3]), '^times: must be finite'),
		(dict(record=[1], times=1), '^record: must have two instants'),
		(dict(record=[[1, 2], [3, 4]], times=1), '^record: must be n numbers'),
		(dict(record=[1, 'two'], times=1), '^record: must be the name'),
		(dict(record=[1, 2], times=1, kind='displacement'), '^kind'),
		(dict(record=[1, 2], times=1, unit=0), '^unit'),
		(dict(record=[1, 2], times=1, direction=(0, 0, 0)), '^direction'),
		(dict(record=[[1, 2, 3], [4, 5, 6]], times=1, direction=(1, 0, 0)), '^direction: the record has three columns'),
		(dict(record=[1, 2], times=1, baseline='yes'), '^baseline'),
		(dict(record='nowhere.txt', times=1), '^times: the file has them'),
	],
)
def testArgumentsOfARecordThatCannotBeAreNamed(arguments, message):
	with pytest.raises(ValueError, match=message):
		polytope.velocityHistory(**arguments)


@pytest.mark.parametrize(
	'text, message',
	[
		('0 1\n1 2\n1 3\n', 'times must increase'),
		('0 1 2\n1 2 3\n', 'has 3 columns'),
		('0 a\n1 2\n', "line 1: must have numbers, got '0 a'; put # before"),
		('PEER NGA\nNPTS= 4\n .1E-3 .2\n', "line 1: must have numbers, got 'PEER NGA'"),
		('0;1\n1;2\n', 'line 1: must have numbers'),
		('0 1\n0.1 2;5\n', 'line 2: .*decimals begin with a point'),
		('0 1\n1 2 3\n', 'line 2: has 3 columns, the lines before have 2'),
		('', 'has no numbers'),
		('# time\n\n', 'has no numbers'),
		('0.1\n0.2\n', r'has 1 columns; .*velocityHistory\(numpy.array'),
		('0 1\n1 nan\n', 'must be finite'),
	],
)
def testFilesThatAreNoRecordAreNamed(text, message, tmp_path):
	(tmp_path / 'record.txt').write_text(text)
	with pytest.raises(ValueError, match='^record: .*' + message):
		polytope.velocityHistory(str(tmp_path / 'record.txt'))


def testAFileThatIsNoTextIsNamed(tmp_path):
	(tmp_path / 'record.txt').write_bytes(bytes(range(128, 256)))
	with pytest.raises(ValueError, match='^record: .*is no text'):
		polytope.velocityHistory(tmp_path / 'record.txt')


peerHead = 'PEER NGA STRONG MOTION DATABASE RECORD\nImperial Valley-02, 5/19/1940, El Centro Array #9, 180\n'


@pytest.mark.parametrize(
	'line, counts, kind, unit',
	[
		('ACCELERATION TIME SERIES IN UNITS OF G', 'NPTS=    7, DT=   .0100 SEC,', 'acceleration', 9.80665),
		('ACCELERATION TIME HISTORY IN UNITS OF G', '  7    0.0100   NPTS, DT', 'acceleration', 9.80665),
		('', 'NPTS= 7, DT= 1E-2', 'acceleration', 9.80665),
		('VELOCITY TIME SERIES IN UNITS OF CM/S', 'NPTS=   7, DT=   0.01 SEC', 'velocity', 0.01),
	],
)
def testARecordOfThePeerDatabase(line, counts, kind, unit, tmp_path):
	values = [0, 0.1e-2, -0.2e-2, 0.4e-2, 0.3e-2, -0.1e-2, 0.05e-2]
	rows = '  .0000000E+00  .1000000E-02 -.2000000E-02  .4000000E-02  .3000000E-02\n -.1000000E-02  .5000000E-03\n'
	(tmp_path / 'RSN6.AT2').write_text(f'{peerHead}{line}\n{counts}\n{rows}')
	expected = polytope.velocityHistory(values, times=0.01, kind=kind, unit=unit, direction=(0, 2, 0))
	for options in (dict(), dict(kind=kind), dict(unit=unit)):
		made = polytope.velocityHistory(tmp_path / 'RSN6.AT2', direction=(0, 2, 0), **options)
		assert made.times == pytest.approx(expected.times) and len(made.times) == 7
		assert np.array(made.velocities, float) == pytest.approx(np.array(expected.velocities, float), abs=1e-15)
	assert max(velocity[1] for velocity in made.velocities) > 1e-6


@pytest.mark.parametrize(
	'line, counts, rows, message',
	[
		('ACCELERATION TIME SERIES IN UNITS OF G', 'NPTS= 4, DT= .01', '1 2 3', 'has 3 values, and NPTS=4 in line 4; is it complete'),
		('ACCELERATION TIME SERIES IN UNITS OF G', 'NPTS= 2, DT= .01', '1 2 3', 'has 3 values, and NPTS=2'),
		('DISPLACEMENT TIME SERIES IN UNITS OF CM', 'NPTS= 3, DT= .01', '1 2 3', 'has displacements; take the file of accelerations'),
		('ACCELERATION TIME SERIES IN UNITS OF FT', 'NPTS= 3, DT= .01', '1 2 3', "in units of 'ft', known are g"),
		('ACCELERATION TIME SERIES IN UNITS OF G', 'NPTS= 3, DT= .01', '1 2\nend 3', 'line 6: must have numbers'),
		('ACCELERATION TIME SERIES IN UNITS OF G', 'NPTS= 3, DT= 0', '1 2 3', 'times must increase'),
	],
)
def testPeerFilesThatCannotBeAreNamed(line, counts, rows, message, tmp_path):
	path = tmp_path / 'RSN6.AT2'
	path.write_text(f'{peerHead}{line}\n{counts}\n{rows}\n')
	with pytest.raises(ValueError, match='^record: .*' + message):
		polytope.velocityHistory(path)


def testAPeerFileOfAnotherKindThanAskedForIsNamed(tmp_path):
	(tmp_path / 'RSN6.AT2').write_text(f'{peerHead}ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 3, DT= .01\n1 2 3\n')
	with pytest.raises(ValueError, match='^kind: .*says that it is of acceleration'):
		polytope.velocityHistory(tmp_path / 'RSN6.AT2', kind='velocity')


def testFilesOfOtherSystems(tmp_path):
	"""A mark of the byte order, line ends of DOS, comments behind values."""
	(tmp_path / 'record.csv').write_bytes('\ufefftime'.encode('utf-8')[:3] + b'0,1\r\n0.5,2 # peak\r\n1,3\r\n')
	made = polytope.velocityHistory(tmp_path / 'record.csv', kind='velocity', baseline=False)
	assert list(made.times) == [0, 0.5, 1] and [v[0] for v in made.velocities] == [1, 2, 3]


def testAFileThatIsNotThere(tmp_path):
	with pytest.raises(FileNotFoundError, match='no file .*nowhere.txt'):
		polytope.velocityHistory(tmp_path / 'nowhere.txt')


def testAMovingBaseMustBeFixedAndWithoutDamping():
	base, block = blockOnBase()
	history = polytope.velocityHistory([0, 1, 0], times=0.1, kind='velocity')
	engines = len(O.engines)
	for ids, message in ((block.id, 'is not fixed'), (7, 'no body 7'), ([], 'one at least'), ([base, base], 'twice'), ('a', 'no body')):
		with pytest.raises(ValueError, match='^ids: .*' + message):
			polytope.baseMotion(ids, history)
	with pytest.raises(ValueError, match='^history: must be'):
		polytope.baseMotion(base, [0, 1])
	with pytest.raises(ValueError, match='^history: begins at 0 s'):
		polytope.baseMotion(base, polytope.velocityHistory([0, 1, 0], times=0.1, start=0))
	O.engines[3].damping = 0.2
	with pytest.raises(ValueError, match='^damping: .*0.2'):
		polytope.baseMotion(base, history)
	assert len(O.engines) == engines
	O.engines = []
	with pytest.raises(ValueError, match='^O.engines'):
		polytope.baseMotion(base, history)


def testTheEngineRefusesBeforeItMovesAnything():
	base, block = blockOnBase()
	polytope.baseMotion(base, polytope.velocityHistory([1, 1], times=0.1, kind='velocity', baseline=False))
	with pytest.raises(ValueError, match='^ids: O.engines has a BaseMotion'):
		polytope.baseMotion(base, polytope.velocityHistory([0, 1, 0], times=0.1, kind='velocity'))
	O.engines[4].damping = 0.2
	with pytest.raises(Exception, match='damping acts on absolute velocities'):
		O.engines[0]()
	O.engines[4].damping = 0
	O.bodies[base].state.blockedDOFs = 'xyz'
	with pytest.raises(Exception, match='is not fixed'):
		O.engines[0]()
	assert O.bodies[base].state.vel.norm() == 0
	O.bodies[base].state.blockedDOFs = 'xyzXYZ'
	assert not any(one.what == 'damping' for one in polytope.check(O))
	O.engines[4].damping = 0.1
	assert 'damping=0.1 beside BaseMotion' in polytope.check(O)['damping'].seen
	with pytest.raises(Exception, match='times must increase|increase'):
		VelocityHistory(times=[0, 0], velocities=[(0, 0, 0), (1, 0, 0)])
	with pytest.raises(Exception, match='history'):
		BaseMotion(ids=[base])()
