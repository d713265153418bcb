# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation B: the quick variant holds what must hold; geometry, stiffness and contact point are taken from the options."""

import csv
import math

import pytest
from boon2012.beam import theory
from boon2012.beam.limits import BeamLimits
from boon2012.beam.scene import ThreeHingedBeam
from boon2012.solverTimes import hasSolver
from paperScripts import expectRangesOfTheWholeRun, results, run, runHere
from yade import O

script = 'b_three_hinged_beam'
short = ('--quick', '--no-pictures', '--contact-point', 'centroid', '--points', '7', '--drive-steps', '2000')


@pytest.fixture(scope='module')
def quick(tmp_path_factory):
	folder = tmp_path_factory.mktemp('quick')
	done = run(script, folder, '--quick')
	assert done.returncode == 0, done.stdout + done.stderr
	return folder


def testTheFullVariantsSizesAreSaid(tmp_path):
	"""The numbers that the full variant takes, which is too long for a test."""
	said = ' '.join(run(script, tmp_path, '--help').stdout.split())
	assert 'None: 119, quick 31' in said and 'chebyshevCentre,centroid' in said


def table(folder, name):
	with open(folder / 'out' / f'{name}.csv', newline='') as file:
		return list(csv.reader(file))[1:]


def testCentroidIsTheClosedForm(quick):
	content, rows = results(quick)
	assert content['letter'] == 'B' and content['good']
	assert rows['centroid: peak load']['ours'] == pytest.approx(37027.3, abs=0.05)
	assert rows['centroid: rotation at the peak']['ours'] == pytest.approx(6.7469, abs=1e-4)
	assert rows['centroid: largest deviation from the closed form along the curve']['accept'] == [0, 0.5]
	assert rows['centroid: largest deviation from the closed form along the curve']['ours'] < 1e-7
	assert rows['centroid: rotation with the load back to zero']['ours'] == pytest.approx(15.195, abs=5e-4)
	assert rows['centroid: work up to the peak']['ours'] == pytest.approx(204.7, abs=0.05)
	assert rows['centroid: energy stored at the peak']['ours'] == pytest.approx(223.0, abs=0.05)
	assert rows['contact queries without an answer']['ours'] == 0


def testRangesAreThoseOfTheWholeRun(quick):
	expectRangesOfTheWholeRun(results(quick)[1], 'B')


def testAnalyticCentre(quick):
	_, rows = results(quick)
	load, rotation = (rows[f'analytic centre, abutments of 3 block heights: {what}'] for what in ('peak load', 'rotation at the peak'))
	assert load['ours'] == pytest.approx(31278, rel=0.01) and load['good'] and rotation['ours'] == pytest.approx(6.37, abs=0.05)
	assert load['accept'] == [pytest.approx(0.99 * load['theory']), pytest.approx(1.01 * load['theory'])]
	peaks = [float(row[2]) for row in table(quick, 'abutments')]
	assert peaks == sorted(peaks) and len(peaks) == 4 and peaks[0] < 0.85 * peaks[-1]
	for row in table(quick, 'abutments'):
		assert float(row[2]) == pytest.approx(float(row[5]), rel=1e-5), 'the independent program'


def testNewtonAgainstIpopt(quick):
	content, rows = results(quick)
	row = rows.get('analytic centre: Newton against Ipopt, largest difference of loads over the peak')
	said = any('no Ipopt' in part.get('text', '') for part in content['parts'])
	if hasSolver('ipopt'):
		assert row['ours'] <= 1e-6 and row['accept'] == [0, 1e-6] and not said
	else:
		assert row is None and said


def testTimeStepAndStiffness(quick):
	_, rows = results(quick)
	for point, tolerance in (('centroid', 0.5), ('analytic centre', 1)):
		for way in ('turned at a rate: change of the peak', 'load imposed: change of the weight held'):
			for change in ('time step halved', 'stiffness doubled'):
				row = rows[f'{point}, {way}, {change}']
				assert row['good'] and row['accept'] == [-tolerance, tolerance]
		assert rows[f'{point}, load imposed: weight held']['good']
	assert rows['load imposed: shear over normal force at the abutment']['ours'] < 0.5
	assert len(table(quick, 'driven')) == 8 and len(table(quick, 'pushed')) == 6


def testFigures(quick):
	content, _ = results(quick)
	figures = [part['file'] for part in content['parts'] if part['kind'] == 'figure']
	assert figures == ['figure8.png', 'beam.png']
	for figure in figures:
		assert (quick / 'out' / figure).stat().st_size > 20000


def testOtherGeometryAndStiffness(tmp_path, monkeypatch):
	options = ('--length', '0.3', '--height', '0.06', '--abutment-stiffness', '3e7', '--midspan-stiffness', '8e7')
	assert runHere(script, tmp_path, monkeypatch, *short, *options) == 0
	content, rows = results(tmp_path)
	load, rotation = theory.BeamBetweenWalls(0.3, 0.06, 3e7, 8e7).peak()
	assert rows['centroid: peak load']['ours'] == pytest.approx(load, rel=1e-9)
	assert rows['centroid: rotation at the peak']['ours'] == pytest.approx(math.degrees(rotation), abs=1e-4)
	assert not [name for name in rows if 'analytic' in name] and float(content['options']['length']) == 0.3


def testAWrongClosedFormIsFound(tmp_path, monkeypatch):
	right = theory.BeamBetweenWalls.lever
	monkeypatch.setattr(theory.BeamBetweenWalls, 'lever', lambda self, rotation: 1.006 * right(self, rotation))
	assert runHere(script, tmp_path, monkeypatch, *short) == 1
	_, rows = results(tmp_path)
	assert rows['centroid: peak load']['good'] is False


@pytest.mark.parametrize(
	'options',
	[
		('--length', '0'),
		('--rotations', '5', '20'),
		('--rotations', '5', '4'),
		('--abutment-height', '0.9'),
		('--normal-weight', '0.4'),
		('--corner-radius', '0.01'),
		('--friction-angle', '20'),
		('--damping', '1'),
		('--time-step-fraction', '0.6'),
		('--contact-point', 'middle'),
		('--points', '2'),
		('--points', '0'),
		('--drive-steps', '0'),
		('--corner-radius', '0.3', '--abutment-length', '0.5'),
		('--solver', 'simplex'),
	],
)
def testNonsenseIsRefused(tmp_path, monkeypatch, capsys, options):
	with pytest.raises(SystemExit) as end:
		runHere(script, tmp_path, monkeypatch, *options)
	assert end.value.code == 2 and options[0] in capsys.readouterr().err


def testLimitsOfThePapersBeam():
	limits = BeamLimits(theory.BeamBetweenWalls())
	first, last = limits.rotations
	assert first == 0.25 and last == pytest.approx(15) and limits.overlap < 0.1
	assert limits.cornerRadius(1) == 0.1 and limits.frictionAngle() == 45
	assert limits.isAppendixA(3, 1, 0.1) and limits.isAppendixA(1.2, 1, 0.1)
	assert not limits.isAppendixA(1.1, 1, 0.1) and not limits.isAppendixA(3, 0.9, 0.1)


def testThinAbutments(tmp_path, monkeypatch):
	"""Corner radii of the study of normals stay below half of the abutments' length."""
	assert runHere(script, tmp_path, monkeypatch, *short, '--abutment-length', '0.3') == 0
	assert {row[2] for row in table(tmp_path, 'normals')} == {'0.1'}


def testBuilder():
	beam = ThreeHingedBeam(contactPoint='centroid').build()
	assert len(O.bodies) == 4 and all(body.shape.dimension == 2 for body in O.bodies)
	reading = beam.balance(math.radians(3))
	abutment, midspan = beam.contacts()
	assert (abutment.phys.kn, midspan.phys.kn) == (100e6, 50e6)
	assert tuple(abutment.geom.normal) == (1, 0, 0) and reading.tilt == 0, 'a rigid abutment decides the normal'
	assert abs(reading.thrust - reading.thrustMidspan) < 1e-6 and reading.rise == pytest.approx(0, abs=1e-15)
	right = O.interactions[beam.abutmentIds[1], beam.beamIds[1]]
	assert right.phys.normalForce.norm() == pytest.approx(reading.thrust), 'mirrored'


def testEqualWeightsTiltTheNormal():
	assert abs(ThreeHingedBeam(abutmentNormalWeight=0.5).build().balance(math.radians(6)).tilt) > math.radians(1)


def testBalanceRefusesRotationsWithoutContact():
	beam = ThreeHingedBeam().build()
	for rotation in (0, -0.1, 0.7):
		with pytest.raises(ValueError, match='rotation'):
			beam.balance(rotation)


def testBuilderRefusesNonsense():
	for name, value in (('length', 0), ('abutmentHeight', 0.04), ('abutmentNormalWeight', 1.1), ('midspanStiffness', math.inf)):
		with pytest.raises(ValueError, match=name):
			ThreeHingedBeam(**{name: value})
