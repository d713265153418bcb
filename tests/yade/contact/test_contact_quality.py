# SPDX-License-Identifier: GPL-2.0-or-later
"""Smoothness of the contact's path and energy of collisions: the studies' quick variants hold, and detect the faults they are made for."""

import importlib.util
import json
import math
import pathlib

import numpy as np
import pytest
from collisionEnergy import Collisions, Contact, meetings, spread
from pathStudy.path import Zoom, scan, smoothness, warmAnswers, zoom
from pathStudy.scenes import paths, variants
from yade import (
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
)

folder = pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'


def study(name, where, *options):
	"""(exit code, rows by quantity) of a script run within this process."""
	specification = importlib.util.spec_from_file_location(name, folder / f'{name}.py')
	script = importlib.util.module_from_spec(specification)
	specification.loader.exec_module(script)
	code = script.main(['--quick', '--output', str(where), *options])
	content = json.loads((where / 'findings.json').read_text())
	return code, {row['quantity']: row for row in content['rows']}


def testPathStudyHolds(tmp_path):
	code, rows = study('contactPath', tmp_path, '--steps', '200')
	assert code == 0, [row for row in rows.values() if row['good'] is False]
	for quantity in ('point', 'normal', 'force'):
		assert rows[f'foundation: largest jump of the {quantity}']['ours'] < 0.01  # overlap over edge, where sides come into line
		assert rows[f'spring: largest jump of the {quantity}']['ours'] < 1e-5
		assert rows[f'analytic centre: largest jump of the {quantity} (overlap below the corner radius)']['ours'] == 0
	assert {path.name for path in tmp_path.iterdir()} >= {
		'smoothness.csv',
		'warm_start.csv',
		'redundant_planes.csv',
		'scaling.csv',
	}


def testEnergyStudyHolds(tmp_path):
	code, rows = study('collisionEnergy', tmp_path, '--number', '40')
	assert code == 0, [row for row in rows.values() if row['good'] is False]
	assert {path.name for path in tmp_path.iterdir()} >= {'time_steps.csv', 'damping.csv'}


# ---------------------------------------------------------------------------------------------------- what the studies measure with


@pytest.mark.parametrize('function, jump', [(lambda x: np.sign(x), 2), (lambda x: np.tanh(1e4 * x), 0), (lambda x: 0 * x, 0)])
def testHalvingTellsAJumpFromASteepRise(function, jump):
	edges = 0.3 * 0.5 ** np.arange(30)  # steps about zero, the place of jump and rise
	motion = 2 * edges
	found = smoothness([Zoom(0, motion, np.abs(function(edges) - function(-edges)))])
	assert found.jump == pytest.approx(jump)
	assert math.isinf(found.rate) == (jump > 0)


def testAKnownRateIsFound():
	"""Face on face the centroid of the overlap moves as the block does, and half as fast once that hangs over."""
	found = scan(paths['slide, face on face, to beyond the edge'], 50, {'centroid': variants['centroid']})
	point, normal, force = (smoothness(several) for several in zoom(found, 'centroid', places=2, depth=12))
	assert point.rate == pytest.approx(1, rel=1e-4) and point.jump == normal.jump == force.jump == 0
	moved = np.linalg.norm(np.diff(found.answers['centroid'][:, 0, 0]))
	assert moved > 0
	ways = np.diff(found.answers['centroid'][:, 0, 0]) / np.diff([pose[0][0] for pose in found.poses])
	assert ways[0] == pytest.approx(1, rel=1e-9) and ways[-1] == pytest.approx(0.5, rel=1e-9)


def testPosesKeepTheOverlap():
	"""The largest ball in the overlap has the radius the path asks for, in faces' contacts half the depth."""
	found = scan(paths['slide, face on face, to beyond the edge'], 20, {'centroid': variants['centroid']})
	depths = np.linalg.norm(found.answers['centroid'][:, 2], axis=1)
	assert depths == pytest.approx(0.01, rel=1e-9)


def testWarmAnswersAreThoseOfTheLoop():
	found = scan(paths['roll, edge to vertex'], 60, {'spring': variants['spring']})
	warm = warmAnswers(found, 'spring')
	assert np.isfinite(warm).all()
	assert np.abs(warm - found.answers['spring']).max() < 1e-9


# ------------------------------------------------------------------------------------------------------------------------ energy


@pytest.mark.parametrize('steps', [20, 53, 160])
def testSpheresKeepEnergyAndCountTheContact(steps):
	"""YADE's own spheres: half a period in contact, error within the leapfrog scheme's bound, momentum kept."""
	found = Collisions(meetings(20), Contact('spheres'), steps, duration=3).run()
	assert all(found['touched']) and all(found['parted'])
	assert found['contactTime'] == pytest.approx(1, abs=0.1)
	assert 0 < spread(found)['largest'] < (math.pi / steps) ** 2 / 4
	assert max(found['momentum']) < 1e-12


def testPapersErrorIsTheContactsNotTheIntegrators():
	several = meetings(30)
	paper = [spread(Collisions(several, Contact('boon2012'), steps).run()) for steps in (25, 50)]
	sharp = spread(Collisions(several, Contact('boon2012', corner=0), 25).run())
	spring = spread(Collisions(several, Contact('surface'), 50).run())
	assert paper[1]['median'] == pytest.approx(paper[0]['median'], rel=0.1) and paper[1]['median'] > 0.05
	assert sharp['median'] < 0.3 * paper[0]['median']
	assert spring['rms'] < 0.01 * paper[1]['rms']


def testDampingTakesEnergyOfEveryCollisionOfASpring():
	found = spread(Collisions(meetings(30), Contact('surface', damping=0.1), 25).run())
	assert found['gaining'] == 0 and found['left'][1] < 0.9


def testLevelFloorPushesUpOnly():
	"""Cubes turned at random fall 1 m onto a floor each, and bounce there: without friction nothing may move them sideways; the paper's
	averaged normals do."""
	ways, energies = {}, {}
	for model in ('surface', 'boon2012'):
		O.reset()
		O.materials.append(RockJointMat(density=1, normalStiffness=4e5, shearStiffness=4e5, frictionAngle=0))
		turns = np.random.default_rng(5).standard_normal((4, 4))
		O.bodies.append([polytope.cuboid((1000 * k, 0, -1), (400, 400, 1), fixed=True) for k in range(4)])
		cubes = [
			O.bodies[k]
			for k in O.bodies.append(
				[polytope.cuboid((1000 * k, 0, 2), (0.5, 0.5, 0.5), Quaternion(*turn).normalized()) for k, turn in enumerate(turns)]
			)
		]
		O.engines = polytope.engines(
			geometry=Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model),
			physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False),
			law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(),
			damping=0,
			timeStepper=False,
		)
		O.dt = math.pi / math.sqrt(4e5) / 25
		while O.time < 4 or any(contact.isReal for contact in O.interactions):
			O.step()
		ways[model] = max(abs(cube.state.pos[0] - 1000 * k) + abs(cube.state.pos[1]) for k, cube in enumerate(cubes))
		late = Vector3(0, 0, -9.81 * O.dt / 2)  # velocities are half a step older than places
		motion = [
			((c.state.vel + late).squaredNorm() + c.state.inertia[0] * c.state.angVel.squaredNorm()) / 2 + 9.81 * c.state.pos[2]
			for c in cubes
		]
		energies[model] = np.array(motion) / (9.81 * 2)
	assert ways['surface'] < 1e-6 < 0.1 < ways['boon2012']
	assert np.abs(energies['surface'] - 1).max() < 0.2
