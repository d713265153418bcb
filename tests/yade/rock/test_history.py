# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.history: displacements and stresses of chosen points, against closed forms."""

import math

import numpy as np
import pytest
from yade import O, PyRunner, Quaternion, RockJointMat, plot, polytope


@pytest.fixture(autouse=True)
def noData():
	plot.resetData()
	yield
	plot.resetData()


def column():
	"""Builds a column of three cubes on a fixed base, under gravity."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.5))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (1, 1, 0.5), fixed=True))
	for k in range(3):
		O.bodies.append(polytope.cuboid((0, 0, k + 0.5), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()


def testAColumnSettlesByTheClosureOfItsJoints():
	column()
	names = polytope.history({'low': 1, 'top': (0.2, 0.1, 2.9)}, every=10, stress=True)
	assert names[:3] == ['low_x', 'low_y', 'low_z'] and len(names) == 18 and set(names) <= set(plot.data)
	polytope.settle()
	pressure = 2600 * 9.81
	low, top = np.array(plot.data['low_z']), np.array(plot.data['top_z'])
	assert low[0] == top[0] == 0 and len(low) > 10 and len(plot.data['t']) == len(low)
	assert low[-1] == pytest.approx(-3 * pressure / 1e9, rel=1e-3) and top[-1] == pytest.approx(-6 * pressure / 1e9, rel=1e-3)
	assert plot.data['low_zz'][-1] == pytest.approx(-2.5 * pressure, rel=1e-3) and plot.data['top_zz'][-1] == pytest.approx(
		-0.5 * pressure, rel=1e-3
	)
	assert np.diff(plot.data['i']) == pytest.approx(10)


def testAPointTurnsWithItsBody():
	column()
	polytope.history({'corner': (0.5, 0.5, 2.5), 'centre': 3}, every=1)
	O.bodies[3].state.ori = Quaternion((0, 0, 1), math.pi / 2) * O.bodies[3].state.ori
	O.run(2, wait=True)
	assert plot.data['corner_x'][-1] == pytest.approx(-1, abs=1e-4) and plot.data['corner_y'][-1] == pytest.approx(0, abs=1e-4)
	assert plot.data['centre_x'][-1] == pytest.approx(0, abs=1e-9)


def testItGoesOnAfterLoadingAndOfABodyThatIsGoneThereIsNothing(tmp_path):
	column()
	polytope.history({'top': 3}, every=5, stress=True)
	O.run(20, wait=True)
	O.save(str(tmp_path / 'column.yade'))
	O.load(str(tmp_path / 'column.yade'))
	before = len(plot.data['i'])
	O.run(20, wait=True)
	assert len(plot.data['i']) == before + 4 and not math.isnan(plot.data['top_z'][-1])
	polytope.excavate([3])
	O.run(5, wait=True)
	assert math.isnan(plot.data['top_z'][-1]) and math.isnan(plot.data['top_zz'][-1])


def testTrialsOfTheFactorOfSafetyAreNotRecorded():
	dip = math.radians(20)
	O.materials.append(RockJointMat(density=5000, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=math.radians(30)))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.1), (0.5, 0.5, 0.1)))
	O.engines = polytope.engines(gravity=(9.81 * math.sin(dip), 0, -9.81 * math.cos(dip)))
	polytope.history({'block': 1}, every=1)
	polytope.settle()
	rows = len(plot.data['i'])
	assert polytope.factorOfSafety(tolerance=0.05).factor == pytest.approx(math.tan(math.radians(30)) / math.tan(dip), rel=0.05)
	assert len(plot.data['i']) == rows
	O.step()
	assert len(plot.data['i']) == rows + 1


@pytest.mark.parametrize(
	'name, arguments',
	[
		('points', {'points': [1]}),
		('points', {'points': {}}),
		('points', {'points': {'a b': 1}}),
		('points', {'points': {3: 1}}),
		('points', {'points': {'a': 9}}),
		('points: a', {'points': {'a': (0, 0)}}),
		('points: a', {'points': {'a': (0, 0, 9)}}),
		('points: a', {'points': {'a': (0, 0, -0.5)}}),
		('every', {'points': {'a': 1}, 'every': 0}),
		('every', {'points': {'a': 1}, 'every': 1.5}),
		('stress', {'points': {'a': 1}, 'stress': 1}),
	],
)
def testBadArgumentsAreNamed(name, arguments):
	column()
	with pytest.raises(ValueError, match=f'^{name}'):
		polytope.history(**arguments)
	assert not any(isinstance(engine, PyRunner) for engine in O.engines) and not plot.data


def testRowsOfAFormerSceneAreRemoved():
	column()
	polytope.history({'top': 3}, every=5)
	O.run(20, wait=True)
	assert plot.data['i'] == [0, 5, 10, 15]
	O.reset()
	column()
	with pytest.warns(UserWarning, match='^plot.data: rows of a former scene, up to step 15, are removed'):
		polytope.history({'low': 1}, every=5)
	O.run(10, wait=True)
	assert plot.data['i'] == [0, 5] and set(plot.data) == {'i', 't', 'low_x', 'low_y', 'low_z'}
	polytope.history({'top': 3}, every=5)
	assert len(plot.data['low_z']) == 3  # those of this scene stay


def testANameTwiceIsRefused():
	column()
	polytope.history({'top': 3})
	with pytest.raises(ValueError, match="^points: \\['top'\\] are recorded already"):
		polytope.history({'top': 2, 'low': 1})


def testSeveralCallsShareTheRowsOfTheirSteps():
	"""What two calls have recorded at one step is one row; steps of one of them alone have no number of the other."""
	column()
	polytope.history({'low': 1}, every=10)
	polytope.history({'top': 3}, every=20)
	O.run(100, wait=True)
	steps = plot.data['i']
	assert len(set(steps)) == len(steps) > 8 and not np.isnan(plot.data['low_z']).any()
	assert np.isnan(plot.data['top_z']).tolist() == [k % 2 == 1 for k in range(len(steps))]
