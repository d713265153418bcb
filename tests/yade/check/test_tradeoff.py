# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.tradeoff: rows against known values of a block on a floor."""

import csv

import pytest
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	RockJointMat,
	polytope,
)
from yade.polytope import _builds
from yade.polytope.tradeoff.table import Row, TradeoffTable

weight, stiffness = 8 * 1000 * 10.0, 1e8


def build(density=1000):
	"""A cube of edge 2 m on a floor."""
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5, density=density))
	O.bodies.append(polytope.cuboid((0, 0, -1), (3, 3, 1), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 1), (1, 1, 1)))
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.1),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012')],  # a face's depth is its force over the stiffness
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=1)],
		),
		NewtonIntegrator(gravity=(0, 0, -10), damping=0),
	]
	O.dt = 1e-3
	return {'time': 0.5}


def measure(scene):
	while O.time < scene['time']:
		O.step()
	functor = O.engines[2].geomDispatcher.functors[0]
	return {'sink': 1 - O.bodies[1].state.pos[2], 'iterations': functor.stats()['newtonIterations'], 'steps': O.iter}


def measurePlace():
	O.step()
	return list(O.bodies[1].state.pos)


def measureWrongly():
	raise ArithmeticError('no such thing')


def run(settings, reference=weight / stiffness, function=measure, **options):
	return polytope.tradeoff(build, settings, function, reference, **{'timedSeconds': 0.02, **options})


def testRowsTellWhatChanged():
	O.reset()
	here = O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1), material=RockJointMat()))
	steps = {'half step': {'timeStepFactor': 0.5}, 'step': {'timeStep': 2e-3}}
	table = run({'as it is': {}, 'cold': {'warmStart': False}, **steps, 'heavy': {'density': 2000}})
	assert len(O.bodies) == 1 and O.bodies[here].state.pos[2] == 0  # the scene of this process is as it was
	for name in ('as it is', 'cold', 'half step', 'step'):
		assert table[name].error < 1e-6 and table[name].failures == 0 and table[name].contacts == 1
	assert table['heavy'].error == pytest.approx(1, abs=1e-6)
	assert [table[name].timeStep for name in ('half step', 'step')] == [5e-4, 2e-3]
	assert [int(table[name].values['steps']) for name in ('as it is', 'half step', 'step')] == pytest.approx([500, 1000, 250], abs=1)
	assert table['cold'].values['iterations'] > table['as it is'].values['iterations']
	for row in table.rows:
		assert 0 < row.contactMicroseconds < row.stepMicroseconds
		assert row.cost == pytest.approx(row.stepMicroseconds * 1e-3 / row.timeStep)


def testFilesAndOtherReference(tmp_path, capsys):
	table = run({'a': {}, 'b': {'density': 2000}})
	other = table.against('b')
	assert other['b'].error == 0 and other['a'].error == pytest.approx(0.5, abs=1e-6) and table['b'].error == pytest.approx(1, abs=1e-6)
	assert [row.name for row in table.against('a', ['b']).rows] == ['b']
	table.show()
	assert 'µs per contact' in capsys.readouterr().out
	table.csv(tmp_path / 'table.csv')
	with open(tmp_path / 'table.csv') as file:
		rows = list(csv.DictReader(file))
	assert [row['setting'] for row in rows] == ['a', 'b'] and float(rows[1]['answer']) == float(table['b'].answer)
	table.plot(tmp_path / 'plot.png')
	assert (tmp_path / 'plot.png').read_bytes()[:4] == b'\x89PNG'


def testVectorsAndMeansOfTheRunItself():
	table = run({'a': {}}, [0, 0, 2], measurePlace, timedSeconds=0)
	assert table['a'].error == pytest.approx(0.5, abs=1e-3) and table['a'].stepMicroseconds > 0


def testWhatGoesWrongIsSaid():
	missing = [name for name in _builds.precisions if not _builds.available(name)]
	settings = {'a': {}, **{name: {'precision': name} for name in missing[:1]}}
	table = run(settings)
	assert table['a'].error < 1e-6
	for name in missing[:1]:
		assert table[name].note == f'not built for {name}: YADE_POLYTOPE_PRECISION={name} ./run build'
	assert 'no such thing' in run({'a': {}}, function=measureWrongly)['a'].note
	assert 'longer' in run({'a': {}}, timeLimit=0.01)['a'].note


def testRefusals(monkeypatch):
	for arguments, word in (
		((lambda: None, {'a': {}}, measure, 1), 'build'),
		((build, {'a': {}}, lambda: 1, 1), 'measure'),
		((build, {}, measure, 1), 'settings'),
		((build, {'a': {}}, measure, 'b'), 'reference'),
		((build, {'a': {'precision': 'single'}}, measure, 1), 'precision'),
	):
		with pytest.raises(ValueError, match=word):
			polytope.tradeoff(*arguments)
	monkeypatch.setenv('POLYTOPE_TRADEOFF', '1')
	with pytest.raises(RuntimeError, match='__main__'):
		run({'a': {}})


def testFrontHoldsWhatNothingBeats():
	rows = []
	for name, time, value in (('first', 2, 1.5), ('worse and dearer', 3, 1.9), ('cheap', 1, 3), ('best', 8, 1), ('none', None, None)):
		row = Row(name, {})
		if value is None:
			row.take({'error': 'none'})
		else:
			answer = {'values': {'x': repr(value)}, 'timeStep': 1, 'seconds': 1, 'fallbacks': 0, 'failures': 0}
			row.take({**answer, 'stepMicroseconds': time, 'contactMicroseconds': time, 'contacts': 1})
			row.take({**answer, 'stepMicroseconds': time + 1, 'contactMicroseconds': time / 2, 'contacts': 1})
			assert (row.stepMicroseconds, row.contactMicroseconds) == (time, time / 2)  # the least of all processes
		rows.append(row)
	table = TradeoffTable(rows, 1)
	assert [row.name for row in table.front()] == ['cheap', 'first', 'best'] and table['best'].error == 0


def testDigitsBeyondDoubleCount():
	rows = [Row(name, {}) for name in 'ab']
	for row, text in zip(rows, ('1.00000000000000000000000000001', '1'), strict=True):
		row.take({'values': {'x': text}, 'timeStep': 1, 'seconds': 1, 'fallbacks': 0, 'failures': 0})
	assert TradeoffTable(rows, 'b')['a'].error == pytest.approx(1e-29, rel=1e-6)
