# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation A of Boon, Houlsby & Utili (2012): 200 regular polyhedra fall onto a floor between four walls.

Runs one solid or all five, measures every part of the contact detection, compares the result with what is expected, and
writes results, pictures and ParaView files. Ends with 1 if a particle has left the box or a contact query had no answer.

	./run demo                                 # all five solids, with pictures
	./run demo --shape cube --threads 2 --vtk-every 100   # ParaView files every 100 steps
	./run python examples/paper/a_falling_polyhedra.py --help

It is an ordinary Python program (`import yade`), for its options and its exit code; within `yade` it does not run.
What the paper leaves open (sizes, stiffness, damping, time step) is set in yade.polytope.scenes.FallingPolyhedra.
"""
import argparse
import csv
import json
import os
import pathlib
import sys
import time

solidNames = ('tetrahedron', 'cube', 'octahedron', 'dodecahedron', 'icosahedron')

# Found for 200 particles and 7000 steps by an independent program of the paper's algorithm, one run of each solid; lengths
# in L. Other orientations at the start scatter about as much: a single body that topples late holds 1e-3 of the energy.
fullNumber, fullSteps, halfStep = 200, 7000, 4000
expected = {
        'energyHalf': (1e-3, 2e-2),
        'energyEnd': (1e-6, 5e-4),
        'contacts': (373, 469),
        'meanHeight': (1.04, 1.23),
        'deepestOverlap': (0, 0.025),
        'overlap': (0, 0.005),
}
labels = {
        'energyHalf': f'kinetic energy / (N m g L), step {halfStep}',
        'energyEnd': 'kinetic energy / (N m g L), end',
        'contacts': 'contacts, end',
        'meanHeight': 'mean height of centres / L, end',
        'deepestOverlap': 'deepest overlap / L, whole run',
        'overlap': 'deepest overlap / L, end',
}

# result, column title, format
costColumns = (
        ('shape', 'solid', ''),
        ('planesPerPair', 'planes\nper pair', ''),
        ('pairs', 'pairs\nqueried', ','),
        ('dismissed', 'dismissed\nat once', ','),
        ('contactQueries', 'contacts\nsolved', ','),
        ('pivotsPerPair', 'pivots\nper LP', '.3f'),
        ('newtonPerContact', 'Newton\nper centre', '.2f'),
        ('lpMicroseconds', 'µs per\nLP', '.2f'),
        ('centreMicroseconds', 'µs per\ncentre', '.2f'),
        ('loopMicrosecondsPerPair', 'loop: µs\nper pair', '.2f'),
        ('loopMicrosecondsPerContact', 'loop: µs\nper contact', '.2f'),
        ('fallbacks', 'fall-\nbacks', ','),
        ('failures', 'fail-\nures', ','),
        ('seconds', 'run\n[s]', '.1f'),
)


def options():
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	shapes = (*solidNames, 'mixed', 'all')
	parser.add_argument('--shape', choices=shapes, default='all', help='all: the five solids one after another; mixed: in one scene')
	parser.add_argument('--number', type=int, default=fullNumber, help='of particles')
	parser.add_argument('--steps', type=int, default=fullSteps)
	parser.add_argument('--threads', type=int, default=1, help='one thread ends in the same state, to the last bit, every time')
	parser.add_argument('--seed', type=int, default=1, help='of the orientations')
	parser.add_argument('--contact-point', choices=('analyticCentre', 'chebyshevCentre', 'centroid'), default='analyticCentre')
	parser.add_argument('--output', type=pathlib.Path, default=pathlib.Path('output/a_falling_polyhedra'), help='folder for all files')
	parser.add_argument('--no-pictures', action='store_true')
	parser.add_argument('--vtk-every', type=int, default=1000, metavar='STEPS', help='ParaView files every so many steps; 0: none')
	given = parser.parse_args()
	for name in ('number', 'steps', 'threads'):
		if getattr(given, name) < 1:
			parser.error(f'--{name} must be at least 1')
	return given


def simulate(name, given):
	"""One run; returns its results as a dictionary."""
	from tqdm import tqdm
	from yade import O, PolytopeVTKRecorder
	from yade.polytope.report import RunWatch
	from yade.polytope.scenes import FallingPolyhedra, solids
	from yade.utils import kineticEnergy

	faces = tuple(solids.values()) if name == 'mixed' else (solids[name], )
	scene = FallingPolyhedra(faces=faces, number=given.number, seed=given.seed).build()
	scene.geometryFunctor.contactPoint = given.contact_point
	folder = given.output / name
	folder.mkdir(parents=True, exist_ok=True)
	recorder = PolytopeVTKRecorder(fileName=f'{folder}/', iterPeriod=given.vtk_every)
	if given.vtk_every:
		O.engines = O.engines + [recorder]

	watch = RunWatch(scene.geometryFunctor, scene.interactionLoop)
	energyUnit = given.number * scene.mass * scene.gravity * scene.size
	half = min(halfStep, given.steps)
	pictures = [f'{folder}/step{step:05d}.png' for step in sorted({0, half, given.steps})]
	with tqdm(total=given.steps, desc=f'{name:12}', unit=' steps', smoothing=0.05, disable=None) as progress:
		draw(pictures[0], scene, given)
		began = time.perf_counter()
		watch.run(half, progress.update)
		wallTime = time.perf_counter() - began
		energyHalf = kineticEnergy() / energyUnit
		if half < given.steps:
			draw(pictures[1], scene, given)
			began = time.perf_counter()
			watch.run(given.steps - half, progress.update)
			wallTime += time.perf_counter() - began
	draw(pictures[-1], scene, given)
	drawSeries(folder, pictures, scene, given)
	if given.vtk_every:
		recorder()  # the state at the end

	summary = watch.summary()
	positions = [body.state.pos for body in scene.particles()]
	inside = sum(max(abs(p[0]), abs(p[1])) < scene.width / 2 and 0 < p[2] < scene.wallHeight for p in positions)
	return {
	        'shape': name,
	        'planesPerPair': 2 * faces[0] if len(faces) == 1 else None,
	        'number': given.number,
	        'threads': given.threads,
	        'seed': given.seed,
	        'seconds': wallTime,
	        **summary,
	        'energyHalf': energyHalf,
	        'energyEnd': summary['kineticEnergy'] / energyUnit,
	        'meanHeight': sum(p[2] for p in positions) / len(positions) / scene.size,
	        'deepestOverlap': summary['deepestOverlap'] / scene.size,
	        'overlap': summary['overlap'] / scene.size,
	        'inside': inside,
	}


def draw(path, scene, given):
	"""As in the paper's Fig. 5: at the start, half-way and at the end, from the same place."""
	if given.no_pictures:
		return
	from yade.polytope.pictures import picture
	floor, top = scene.width / 2 + scene.wallThickness, scene.lattice()[:, 2].max() + scene.spacing / 2
	frame = [(x, y, -scene.wallThickness) for x in (-floor, floor) for y in (-floor, floor)]
	frame += [(x, y, top) for x in (-scene.width / 2, scene.width / 2) for y in (-scene.width / 2, scene.width / 2)]
	picture(path, bodies=shownBodies(scene), fixed='solid', frame=frame, size=(1000, 1000))


def shownBodies(scene):
	"""Without the walls."""
	from yade import O
	return [body for body in O.bodies if body.id not in scene.wallIds]


def drawSeries(folder, pictures, scene, given):
	"""The three pictures side by side, and the end once more from nearer."""
	if given.no_pictures:
		return
	import numpy as np
	from matplotlib.image import imread, imsave
	from yade.polytope.pictures import picture
	imsave(f'{folder}/steps.png', np.concatenate([imread(path) for path in pictures], axis=1))
	picture(f'{folder}/end.png', bodies=shownBodies(scene), fixed='solid', size=(1600, 1000))


def judge(result, comparable):
	"""[(what, value, expected, verdict)]: what must hold in any run, and the ranges if the run is the one they are for."""
	checks = []
	musts = ('particles inside', result['inside'], result['number']), ('queries without an answer', result['failures'], 0)
	for what, value, required in musts:
		checks.append((what, value, required, 'ok' if value == required else 'NOT OK'))
	for key, (low, high) in expected.items():
		verdict = '' if not comparable else 'ok' if low <= result[key] <= high else 'outside'
		checks.append((labels[key], result[key], f'{low:g} … {high:g}' if comparable else '', verdict))
	return checks


def show(results, comparable):
	from tabulate import tabulate
	titles = [title for _, title, _ in costColumns]
	rows = [['' if r[key] is None else format(r[key], form) for key, _, form in costColumns] for r in results]
	print('\nWhat the contact detection did, and what it cost')
	print(tabulate(rows, titles, stralign='right', disable_numparse=True))

	print('\nWhat came out' + ('' if comparable else f' (what is expected is known for {fullNumber} particles and {fullSteps} steps)'))
	verdicts = {r['shape']: judge(r, comparable) for r in results}
	rows = []
	for checks in zip(*verdicts.values(), strict=True):
		what, _, wanted, _ = checks[0]
		rows.append([what, wanted] + [f'{value:.4g}  {verdict}' for _, value, _, verdict in checks])
	print(tabulate(rows, ['', 'expected', *verdicts], disable_numparse=True))
	print('\nState at the end (SHA-256, first 16 digits; the same every time with one thread)')
	print(tabulate([[r['shape'], r['stateHash']] for r in results], tablefmt='plain'))
	return not any(verdict == 'NOT OK' for checks in verdicts.values() for *_, verdict in checks)


def save(results, folder):
	(folder / 'results.json').write_text(json.dumps(results, indent='\t') + '\n')
	with open(folder / 'results.csv', 'w', newline='') as file:
		writer = csv.DictWriter(file, [key for key in results[0] if key != 'statuses'], extrasaction='ignore')
		writer.writeheader()
		writer.writerows(results)


def main():
	given = options()
	os.environ['OMP_NUM_THREADS'] = str(given.threads)  # read when YADE is loaded, so before that
	import yade  # noqa: F401
	names = solidNames if given.shape == 'all' else (given.shape, )
	results = [simulate(name, given) for name in names]
	comparable = given.number == fullNumber and given.steps == fullSteps
	good = show(results, comparable)
	save(results, given.output)
	print(f'\nFiles: {given.output}/')
	return 0 if good else 1


if __name__ == '__main__':
	sys.exit(main())
