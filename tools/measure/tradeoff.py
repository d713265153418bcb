# SPDX-License-Identifier: GPL-2.0-or-later
"""Accuracy for speed in the paper's scenes: what contact model, time step, stiffness and arithmetic cost, and the error of the answer that matters.

The program behind `./run tradeoff`. Scenes: pair (contact forces, against the finest arithmetic), B (peak load), C and D (critical friction angles),
F (energy after collisions), rest (where a cube comes to rest), A (a heap's coordination number, against the mean over seeds). With each contact model one
setting at a time is changed. Out of it come a table on screen, summary.csv and a table for each scene.

	./run tradeoff                   # all: some 25 minutes
	./run tradeoff --quick           # fewer settings: some minutes
	./run tradeoff --only B pair     # these scenes
"""

import argparse
import csv
import dataclasses
import json
import math
import os
import pathlib
import sys
import tempfile

letters = ('pair', 'B', 'C', 'D', 'F', 'rest', 'A')


def options(arguments=None):
	parser = argparse.ArgumentParser(prog='./run tradeoff', description=__doc__.splitlines()[0])
	parser.add_argument('--quick', action='store_true', help='fewer settings, and no other arithmetic than double')
	parser.add_argument('--only', nargs='+', choices=letters, default=letters, metavar='SCENE', help=f'of {", ".join(letters)}')
	parser.add_argument(
		'--output', type=pathlib.Path, help='folder for all files (default: output/tradeoff, with --quick output/tradeoff-quick)'
	)
	# for ./run: only reads the options; prints the builds that this run asks for
	parser.add_argument('--check', action='store_true', help=argparse.SUPPRESS)
	parser.add_argument('--precisions', action='store_true', help=argparse.SUPPRESS)
	given = parser.parse_args(arguments)
	given.output = (given.output or pathlib.Path('output/tradeoff-quick' if given.quick else 'output/tradeoff')).resolve()
	try:
		given.output.mkdir(parents=True, exist_ok=True)
		tempfile.TemporaryFile(dir=given.output).close()
	except OSError as error:
		parser.error(f'--output: cannot write to {given.output}: {error.strerror}; name a folder that files can be written to')
	return given


if __name__ == '__main__':  # before YADE is loaded, or even built
	given = options()
	if given.check:
		sys.exit()

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded, here and in the processes
paper = pathlib.Path(__file__).resolve().parents[2] / 'examples/paper'
sys.path.append(str(paper))  # boon2012; in a process of its own, too

import numpy as np
from boon2012.beam.scene import ThreeHingedBeam
from boon2012.beam.theory import BeamBetweenWalls
from boon2012.collisions.scene import Collision, readBlocks
from boon2012.falling.scene import FallingPolyhedra, circumradiusOfUnitVolume
from boon2012.reporting.origin import origin
from boon2012.reporting.report import endOnTerm
from boon2012.roofWedge.scene import RoofWedge
from boon2012.slidingWedge.study import limitEquilibrium
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.scene import WedgeScene
from boon2012.wedges.theory import roofWedgeFrictionAngle
from tabulate import tabulate
from yade import (
	HarmonicMotionEngine,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
)
from yade._polytope import contact
from yade.polytope import _builds, engines, regular, tradeoff
from yade.polytope.frictionReduction import FrictionReduction

models = ('surface', 'boon2012')
wide = tuple(name for name in _builds.precisions if name != 'double')
leftOutWhenQuick = ('× 0.5', '× 0.1', *wide, 'seed 4', 'seed 5', 'seed 6')
solids = (4, 6, 8, 12, 20)
scene = None
"""What build() has made, for measure(): these are called in a process of their own, with any arithmetic. So their input must not depend on it: a number
that is searched for is rounded to few digits. *model* is the contact model, *stiffness* a factor on all stiffnesses; the time step goes with 1/√stiffness."""


def block(name):
	return BlockGeometry.read(str(paper / 'geometry' / name))


# ------------------------------------------------------------------------------------------------ pair: forces, with no feedback and no chaos

pairDepth, pairSwing, pairPeriod, pairSteps = 1e-2, 2e-3, 100, 25
"""Radius of the ball in the overlap over the solid's size, amplitude of its motion, time steps of one swing, and steps to a quarter of it."""


def buildPairs(model, each=4):
	"""Every pair of regular solids of unit volume, *each* times in random orientations and directions, all fixed but for a small swing."""
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=1e6, shearStiffness=1e6, frictionAngle=0, density=1000))
	random, moving = np.random.default_rng(1), []
	for k, faces in enumerate([(first, second) for i, first in enumerate(solids) for second in solids[i:]] * each):
		turns = np.round(random.standard_normal((2, 4)), 6)
		direction = random.standard_normal(3)
		direction = np.round(direction / np.linalg.norm(direction), 6)
		centre, bodies = np.array([10.0 * k, 0, 0]), []
		for number, turn in zip(faces, turns, strict=True):
			orientation = Quaternion(*map(float, turn)).normalized()
			bodies.append(regular(number, round(circumradiusOfUnitVolume(number), 9), center=tuple(centre), orientation=orientation))
		low, high = 0.0, 2.5
		while high - low > 1e-7:
			middle = (low + high) / 2
			bodies[1].state.pos = Vector3(*map(float, centre + middle * direction))
			low, high = (middle, high) if contact(*bodies).infeasibility < -pairDepth else (low, middle)
		bodies[1].state.pos = Vector3(*map(float, centre + round(high, 6) * direction))
		for body in bodies:
			body.state.blockedDOFs = 'xyzXYZ'
		moving.append(O.bodies.append(bodies)[1])
	swing = HarmonicMotionEngine(ids=moving, A=(pairSwing, 0.7 * pairSwing, 0.4 * pairSwing), f=(1, 1, 1), fi=(0, 0, 0))
	per, geometry = (
		Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False),
		Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model),
	)
	usual = engines(gravity=(0, 0, 0), damping=0, geometry=geometry, physics=per, timeStepper=False)
	O.engines = [*usual[:-1], swing, usual[-1]]
	O.dt = 1 / pairPeriod


def measurePairs():
	for _ in range(pairSteps):
		O.step()
	return [x for k in range(1, len(O.bodies), 2) for x in O.forces.f(k)]


# ------------------------------------------------------------------------------------------------ B: the beam's peak load, from imposed rotations


def buildBeam(model):
	global scene
	scene = ThreeHingedBeam(contactModel=model).build()


def measureBeam():
	"""[N]. Leaves the half-beams turning slowly."""
	found = scene.peak()
	for side, k in zip((-1, 1), scene.beamIds, strict=True):
		O.bodies[k].state.angVel = (0, 0, side * 2e-4)
	return found.load


# ------------------------------------------------------------------------------------------------ C and D: the search for the critical friction angle

frictionSteps = (8, 1, 0.1, 0.01)
"""[°]; half of the last is how exactly an angle is known."""


def buildSlidingWedge(model, stiffness=1):
	global scene
	joints = {'normalStiffness': 1e7 * stiffness, 'shearStiffness': 1e7 * stiffness}
	scene = WedgeScene(block('c_sliding_wedge.json'), contactModel=model, **joints).build()


def measureSlidingWedge():
	scene.establishContacts()
	return criticalAngle(1.3e-3)


def buildRoofWedge(model=models[0], stiffness=1):
	global scene
	joints = {'normalStiffness': 1e7 * stiffness, 'shearStiffness': 1e7 * stiffness}
	scene = RoofWedge(block('d_roof_wedge.json'), contactModel=model, **joints).build()


def measureRoofWedge():
	scene.setJointForces()
	return criticalAngle(1.15e-3)


def criticalAngle(usual):
	"""[°]. Leaves the wedge at rest in the last stable state.

	:param float usual: time step of the scene as it is [s]
	"""
	steps = [math.radians(step) for step in frictionSteps]
	between = max(1, round(100 * usual / float(O.dt)))  # of two checks, which are equally far apart in time
	reduction = FrictionReduction([scene.wedgeId], math.radians(70), steps, checkEvery=between, mostSteps=400 * between)
	found = reduction.run()
	reduction.restore()
	return math.degrees(found.critical)


def roofAngle():
	"""[°], of the geometry file with the scene's own stress, density and gravity."""
	buildRoofWedge()
	horizontal = scene.horizontalStress * sum(joint.area for joint in scene.joints) * math.cos(scene.inclinations[0])
	angle = math.degrees(roofWedgeFrictionAngle(scene.weight, horizontal, scene.inclinations[0]))
	O.reset()
	return angle


# ------------------------------------------------------------------------------------------------ F: undamped collisions; the cube of F1 at rest

fall, partings, restAfter = 1e-3, 4, 2.6
"""Fall before the first touch [m], number of collisions after which the energy is taken, time of rest [s]."""


def buildCollision(model, stiffness=1, kind='edgeEdge'):
	global scene
	scale = {'normalStiffness': 1e8 * stiffness, 'shearStiffness': 1e8 * stiffness, 'timeStep': 8.944e-5 / math.sqrt(stiffness)}
	undamped = {'frictionCoefficient': 0, 'contactDamping': 0, 'damping': 0} if kind == 'edgeEdge' else {}
	scene = Collision(*readBlocks(str(paper / 'geometry/f_collisions.json'), kind), contactModel=model, **undamped, **scale).build()
	O.trackEnergy = False


def measureCollision():
	"""Energy after the fourth collision over that of the fall. Free flight: the position is taken where the velocity belongs to."""
	state, before, count = scene.body.state, False, 0
	level = state.pos[2] - fall
	while count < partings:
		O.step()
		touching = scene.contact() is not None
		count += before and not touching
		before = touching
		if O.time > 2:
			raise RuntimeError(f'the blocks have parted {count} times only')
	spin = state.ori.conjugate() * state.angVel
	kinetic = (state.mass * state.vel.squaredNorm() + sum(state.inertia[k] * spin[k] ** 2 for k in range(3))) / 2
	weight = state.mass * scene.gravity
	return (kinetic + weight * (state.pos[2] - state.vel[2] * O.dt / 2 - level)) / (weight * fall)


def buildRest(model, stiffness=1):
	buildCollision(model, stiffness, 'vertexFace')


def measureRest():
	"""Height of the cube's centre as if the floor did not yield [m]: its sinking by m g/kₙ is added."""
	for _ in range(math.ceil(restAfter / float(O.dt))):
		O.step()
	return scene.body.state.pos[2] + scene.body.state.mass * scene.gravity / scene.normalStiffness


# ------------------------------------------------------------------------------------------------ A: a heap, which is chaotic

heapTime = 1.5
"""Simulated [s]."""


def buildHeap(model, stiffness=1, seed=1):
	global scene
	scene = FallingPolyhedra(faces=solids, number=96, columns=4, seed=seed, normalStiffness=1.25e6 * stiffness).build()
	scene.geometryFunctor.contactModel = model


def measureHeap():
	"""Coordination number: contacts of one solid, with walls and floor."""
	top = max(body.state.pos[2] for body in scene.particles())
	for _ in range(math.ceil(heapTime / float(O.dt))):
		O.step()
	if not all(-scene.size < body.state.pos[2] < top + scene.size for body in scene.particles()):
		raise RuntimeError('blew up')
	moving = set(scene.particleIds)
	return sum((one.id1 in moving) + (one.id2 in moving) for one in O.interactions if one.isReal) / scene.number


# ------------------------------------------------------------------------------------------------ settings, and the table


@dataclasses.dataclass
class Scene:
	"""*answer*: what is measured. *truth*: the closed form; None: there is none. *varied*: name → change. *timedSeconds*: of polytope.tradeoff."""

	title: str
	build: object
	measure: object
	varied: dict
	answer: str
	truth: float = None
	timedSeconds: float = 0.3

	def settings(self, quick):
		"""Each contact model as it is and with one thing changed; wider arithmetic where it is built."""
		varied = {name: change for name, change in self.varied.items() if name not in wide or _builds.available(name)}
		if quick:
			varied = {name: change for name, change in varied.items() if not name.endswith(leftOutWhenQuick)}
		each = {
			f'{model}{", " * bool(name)}{name}': {'model': model, **change}
			for model in models
			for name, change in {'': {}, **varied}.items()
		}
		return {name: change for name, change in each.items() if 'seed' not in change or change['model'] == models[0]}


arithmetic = {name: {'precision': name} for name in wide}
steps = {f'time step × {factor:g}': {'timeStepFactor': factor} for factor in (0.5, 2, 4)}
dynamics = {**steps, **{f'stiffness × {factor:g}': {'stiffness': factor} for factor in (0.1, 10)}}
seeds = {f'seed {seed}': {'seed': seed} for seed in range(2, 7)}


def allScenes():
	"""letter → Scene."""
	wedge = math.degrees(limitEquilibrium(block('c_sliding_wedge.json')).frictionAngle())
	angle, height = 'critical friction angle [°]', 'height at rest + m g/kₙ [m]'
	return {
		'pair': Scene('Overlapping pairs', buildPairs, measurePairs, arithmetic, 'forces of 60 contacts'),
		'B': Scene('Three-hinged beam', buildBeam, measureBeam, arithmetic, 'peak load [N]', BeamBetweenWalls().peak()[0]),
		'C': Scene('Sliding wedge', buildSlidingWedge, measureSlidingWedge, dynamics, angle, wedge),
		'D': Scene('Roof wedge', buildRoofWedge, measureRoofWedge, dynamics, angle, roofAngle()),
		# afterwards the blocks are apart: the times are those of the run itself
		'F': Scene(
			'Collisions without loss', buildCollision, measureCollision, dynamics, 'energy over that of the fall', 1.0, timedSeconds=0
		),
		'rest': Scene('Cube at rest (F1)', buildRest, measureRest, dynamics, height, 0.5),
		'A': Scene('Heap of 96 solids', buildHeap, measureHeap, {**dynamics, **seeds}, 'coordination number'),
	}


def measured(letter, scene, quick):
	"""TradeoffTable of one scene, with errors against the closed form; else of each model against its finest arithmetic, or the mean over seeds."""
	settings = scene.settings(quick)
	table = tradeoff(scene.build, settings, scene.measure, models[0] if scene.truth is None else scene.truth, scene.timedSeconds)
	if letter == 'A':
		answers = [row.answer for row in table if row.answer is not None and (row.name == models[0] or 'seed' in row.name)]
		mean = np.mean(answers)
		print(f'over seeds {mean:.3f} ± {np.std(answers, ddof=1):.3f}: an error below {np.std(answers, ddof=1) / mean:.2g} means nothing')
	for row in table:
		if scene.truth is None and row.answer is not None:
			finest = [other for other in table if other.answer is not None and other.name.startswith(row.name.partition(',')[0])][-1].answer
			true = mean if letter == 'A' else finest
			row.error = float(np.linalg.norm(np.subtract(row.answer, true)) / np.linalg.norm(true))
	return table


def summary(tables):
	"""Rows of the table over all scenes: setting; least, median and largest cost over that of the first setting; error, or why there is none, of each scene."""
	names = dict.fromkeys(row.name for table in tables.values() for row in table if 'seed' not in row.name)
	for name in sorted(names, key=lambda name: models.index(name.partition(',')[0])):
		rows = {letter: next((row for row in table if row.name == name), None) for letter, table in tables.items()}
		costs = [row.cost / tables[letter][0].cost for letter, row in rows.items() if row and row.cost]
		cells = [
			'' if row is None else 'blew up' if 'blew up' in row.note else row.note.partition(':')[0] or row.error for row in rows.values()
		]
		yield [name, *((min(costs), float(np.median(costs)), max(costs)) if costs else ('', '', '')), *cells]


def main(given):
	about, scenes, tables = {**origin(), 'quick': given.quick, 'interrupted': False, 'scenes': list(given.only)}, allScenes(), {}
	for letter in given.only:
		if letter == 'pair' and not any(name.partition(', ')[2] in wide for name in scenes[letter].settings(given.quick)):
			print('\npair: left out, there is no finer arithmetic than double to compare with')
			continue
		print(f'\n{letter}: {scenes[letter].title}, {scenes[letter].answer}', flush=True)
		tables[letter] = measured(letter, scenes[letter], given.quick)
		tables[letter].show()
		tables[letter].csv(given.output / f'{letter}.csv')
	columns, rows = ['setting', 'cost: least', 'median', 'most', *(f'error {letter}' for letter in tables)], list(summary(tables))
	with open(given.output / 'summary.csv', 'w', newline='') as file:
		csv.writer(file).writerows([columns, *rows])
	(given.output / 'origin.json').write_text(json.dumps({**about, 'scenes': list(tables)}, indent='\t') + '\n')
	print('\nAll scenes: cost over that of the first setting, and error of the answer')
	print(tabulate([[f'{cell:.2g}' if isinstance(cell, float) else cell for cell in row] for row in rows], columns, disable_numparse=True))
	return 1 if any(row.failures for table in tables.values() for row in table) else 0


if __name__ == '__main__':
	endOnTerm()
	if given.precisions:
		print(end=''.join(f'{name}\n' for name in wide if not given.quick and {'pair', 'B'} & set(given.only)))
	else:
		sys.exit(main(given))
