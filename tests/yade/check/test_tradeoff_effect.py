# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.tradeoff: a row counts only where its setting was in effect to the end of measure()."""

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
	utils,
)


def engines(withPolytopes=True):
	loop = [Ig2_Polytope_Polytope_PolytopeGeom()], [Ip2_RockJointMat_RockJointMat_RockJointPhys()], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()]
	polytopes = [InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.1), InteractionLoop(*loop)] if withPolytopes else []
	return [ForceResetter(), *polytopes, NewtonIntegrator(gravity=(0, 0, -10))]


def buildBodies():
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5, density=1000))
	O.bodies.append(polytope.cuboid((0, 0, -1), (3, 3, 1), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 1), (1, 1, 1)))
	O.dt = 1e-3


def build():
	buildBodies()
	O.engines = engines()


def buildAndSave():
	build()
	O.saveTmp()


def buildSphere():
	O.reset()
	O.bodies.append(utils.sphere((0, 0, 0), 1))
	O.engines, O.dt = engines(withPolytopes=False), 1e-3


def measure():
	O.step()
	return O.bodies[len(O.bodies) - 1].state.pos[2]


def measureAgain():
	O.loadTmp()
	return measure()


def measureSaved():
	O.saveTmp('start')
	measure()
	O.loadTmp('start')
	return measure()


def measureWithNewEngines():
	O.engines = engines()
	return measure()


def measureWithItsOwnStep():
	O.dt = 0.5e-3
	return measure()


attributes = {'contactPoint': 'chebyshevCentre', 'contactModel': 'spring', 'newtonTolerance': 1e-6, 'warmStart': False}
changed = {'attributes': attributes, 'longer': {'timeStepFactor': 2}}
default = {'as it is': {}, 'named': {'contactModel': 'surface', 'warmStart': True}}


def run(make, settings, function):
	return polytope.tradeoff(make, settings, function, 'as it is', timedSeconds=0)


def assertLost(row, *words):
	assert row.note.startswith('not in effect: ') and all(word in row.note for word in words), row.note
	assert row.answer is None and row.error is None and row.cost is None and not row.counts


def testARenewedSceneLosesItsSettings():
	table = run(buildAndSave, {**default, **changed}, measureAgain)
	said = [
		"contactPoint is 'analyticCentre', not 'chebyshevCentre'",
		"contactModel is 'surface', not 'spring'",
		'newtonTolerance is 1e-10, not 1e-06',
		'warmStart is True, not False',
	]
	assertLost(table['attributes'], *said)
	assertLost(table['longer'], 'the time step is 0.001 s, not 0.002 s', 'O.saveTmp')
	assert [table[name].note for name in default] == ['', ''] and table.front()[0].name in default


def testASceneSavedInMeasureKeepsThem():
	table = run(build, {'as it is': {}, **changed}, measureSaved)
	assert not any(row.note for row in table.rows) and table['longer'].timeStep == 2e-3


def testEnginesOfMeasure():
	table = run(build, {'as it is': {}, 'cold': {'warmStart': False}, 'step': {'timeStep': 2e-3}}, measureWithNewEngines)
	assertLost(table['cold'], 'warmStart')
	assert not table['step'].note and table['step'].timeStep == 2e-3
	table = run(buildBodies, {'as it is': {}, 'cold': {'warmStart': False}}, measureWithNewEngines)
	assert 'build: left no contact functor' in table['cold'].note and table['cold'].cost is None and not table['as it is'].note


def testASceneWithoutPolytopes():
	table = run(buildSphere, {'as it is': {}, 'Ipopt': {'solver': 'ipopt'}}, measure)
	assert 'solver' in table['Ipopt'].note and 'Ig2_Polytope_Polytope_PolytopeGeom' in table['Ipopt'].note
	assert table['Ipopt'].cost is None and table['as it is'].counts


@pytest.mark.parametrize('changes', [{'timeStep': 2e-3}, {'timeStepFactor': 2}])
def testATimeStepOfMeasure(changes):
	"""No fault of those that name none: their cost is that of the step they take."""
	table = run(build, {**default, 'step': changes}, measureWithItsOwnStep)
	assertLost(table['step'], 'the time step is 0.0005 s, not 0.002 s')
	assert [table[name].note for name in default] == ['', '']
	assert table['as it is'].timeStep == 0.5e-3 and table['as it is'].cost == pytest.approx(table['as it is'].stepMicroseconds)
