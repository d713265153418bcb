# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation A of Boon, Houlsby & Utili (2012): 200 regular polyhedra fall onto a floor between four walls.

Runs one solid or all five and shows that they come to rest (the paper's Fig. 5) and what the contact detection costs: µs
per contact problem against the number of planes of both bodies, for the linear programme, the centre by Newton's method
and by Ipopt, warm-started from the last step's answer and cold (Fig. 6). Writes results, pictures, ParaView files and
findings.json. Expected: all particles inside, no query without an answer, kinetic energy below 5e-4 N m g L at the end.
Heaps are chaotic: other ranges are compared over several seeds. Ends with 1 if what must hold does not.

	./run demo                                 # all five solids, with pictures: two minutes
	./run demo --shape cube --threads 2 --vtk-every 100   # ParaView files every 100 steps
	./run python examples/paper/a_falling_polyhedra.py --seeds 8   # as `./run paper` does: five minutes
	./run yade -n -x examples/paper/a_falling_polyhedra.py --quick

What the paper leaves open (sizes, stiffness, damping, time step) is set in yade.polytope.scenes.FallingPolyhedra.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import sys
import time

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; within `yade` it is set already (yade -j)

solidNames = ('tetrahedron', 'cube', 'octahedron', 'dodecahedron', 'icosahedron')

# Found for 200 particles and 7000 steps by an independent program of the paper's algorithm, one run of each solid; lengths
# in L. The ranges of contacts and mean height are those of the five runs; the others are bounds.
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
energyEvery = 20  # steps between two points of the energy curve
fewestSeeds = 5
"""With fewer there is no telling chance from cause."""

# of Fig. 6: result, label, what the paper reads from its own figure, colour, line style
curves = (
        ('ipoptMicroseconds', 'centre by Ipopt, cold start', 'a few ms', '#8a4f9e', '-'),
        ('centreColdMicroseconds', 'centre by Newton, cold start', 'tens of µs', '#c8451b', '-'),
        ('centreMicroseconds', 'centre by Newton, warm start', '', '#c8451b', ':'),
        ('lpColdMicroseconds', 'linear programme, cold start', 'tens of µs', '#1d4e79', '-'),
        ('lpMicroseconds', 'linear programme, warm start', '', '#1d4e79', ':'),
)

# fields of FallingPolyhedra that a run may change: field, what it is
parameters = (
        ('size', 'L, edge of the cube of equal volume [m]'),
        ('density', '[kg/m³]'),
        ('normalStiffness', 'of each contact [N/m]'),
        ('stiffnessRatio', 'shear over normal stiffness'),
        ('frictionAngle', '[degrees]'),
        ('contactDamping', 'fraction of critical, of each contact'),
        ('damping', 'of NewtonIntegrator'),
        ('gravity', '[m/s²]'),
        ('cornerFraction', 'corner radius over L'),
        ('timeStepFraction', 'time step over sqrt(mass / normal stiffness)'),
)

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
	parser = argparse.ArgumentParser(
	        description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter, allow_abbrev=False
	)
	shapes = (*solidNames, 'mixed', 'all')
	parser.add_argument('--shape', choices=shapes, default='all', help='all: the five solids one after another; mixed: in one scene')
	parser.add_argument('--number', type=int, default=fullNumber, help='of particles')
	parser.add_argument('--steps', type=int, default=fullSteps)
	threads = int(os.environ['OMP_NUM_THREADS'])
	parser.add_argument('--threads', type=int, default=threads, help='one thread ends in the same state, to the last bit, every time')
	parser.add_argument('--seed', type=int, default=1, help='of the orientations')
	parser.add_argument('--seeds', type=int, default=1, help='so many runs of each solid, with this seed and the next ones')
	parser.add_argument('--contact-point', choices=('analyticCentre', 'chebyshevCentre', 'centroid'), default='analyticCentre')
	for name, meaning in parameters:
		option = ''.join('-' + letter.lower() if letter.isupper() else letter for letter in name)
		text = f'{meaning} (default: as in FallingPolyhedra)'
		parser.add_argument(f'--{option}', dest=name, type=float, default=argparse.SUPPRESS, metavar='X', help=text)
	parser.add_argument('--quick', action='store_true', help='fewer states to time, no ParaView files and no pictures of the heap')
	parser.add_argument('--output', type=pathlib.Path, default=pathlib.Path('output/a_falling_polyhedra'), help='folder for all files')
	parser.add_argument('--no-pictures', action='store_true')
	parser.add_argument('--vtk-every', type=int, default=1000, metavar='STEPS', help='ParaView files every so many steps; 0: none')
	parser.add_argument('--sample-every', type=int, default=100, metavar='STEPS', help='time cold starts every so many steps')
	parser.add_argument('--ipopt-every', type=int, default=5, metavar='STATES', help='time Ipopt on every so many of these; 0: not at all')
	if '--quick' in sys.argv:
		parser.set_defaults(vtk_every=0, sample_every=500, ipopt_every=7)
	given = parser.parse_args()
	for name in ('number', 'steps', 'threads', 'seeds', 'sample_every'):
		if getattr(given, name) < 1:
			parser.error(f"--{name.replace('_', '-')} must be at least 1")
	for name in ('vtk_every', 'ipopt_every'):
		if getattr(given, name) < 0:
			parser.error(f"--{name.replace('_', '-')} must not be negative")
	given.parameters = {name: getattr(given, name) for name, _ in parameters if hasattr(given, name)}
	for name, value in given.parameters.items():
		positive = name in ('size', 'density', 'normalStiffness', 'timeStepFraction')
		if not math.isfinite(value) or value < 0 or positive and value == 0:
			parser.error(f"{name} must be {'positive' if positive else 'zero or more'}, not {value:g}")
	if 'frictionAngle' in given.parameters:
		if given.parameters['frictionAngle'] >= 90:
			parser.error('frictionAngle must be below 90 degrees')
		given.parameters['frictionAngle'] = math.radians(given.parameters['frictionAngle'])
	return given


def simulate(name, seed, given):
	"""One run; returns its results as a dictionary. With the first seed also pictures, files, and times of other solvers."""
	from tqdm import tqdm
	from yade import O, PolytopeVTKRecorder
	from yade.polytope.report import RunWatch
	from yade.polytope.scenes import FallingPolyhedra, solids
	from yade.polytope.solverTimes import StateSample
	from yade.utils import kineticEnergy

	first = seed == given.seed
	faces = tuple(solids.values()) if name == 'mixed' else (solids[name], )
	scene = FallingPolyhedra(faces=faces, number=given.number, seed=seed, **given.parameters).build()
	scene.geometryFunctor.contactPoint = given.contact_point
	folder = given.output / name
	recorder = None
	if first:
		folder.mkdir(parents=True, exist_ok=True)
		if given.vtk_every:
			recorder = PolytopeVTKRecorder(fileName=f'{folder}/', iterPeriod=given.vtk_every)
			O.engines = O.engines + [recorder]

	watch, sample = RunWatch(scene.geometryFunctor, scene.interactionLoop), StateSample()
	energyUnit = given.number * scene.mass * scene.gravity * scene.size or 1
	energies = []
	half = min(halfStep, given.steps)
	pictures = [f'{folder}/step{step:05d}.png' for step in sorted({0, half, given.steps})]
	shown = first and not (given.no_pictures or given.quick)
	with tqdm(total=given.steps, desc=f'{name:12} {seed}', unit=' steps', smoothing=0.05, disable=None) as progress:

		def afterStep():
			progress.update()
			if O.iter % energyEvery == 0:
				energies.append((O.iter, kineticEnergy() / energyUnit))
			if first and O.iter % given.sample_every == 0:
				sample.keep()

		if shown:
			draw(pictures[0], scene)
		began = time.perf_counter()
		watch.run(half, afterStep)
		wallTime = time.perf_counter() - began
		energyHalf = kineticEnergy() / energyUnit
		if half < given.steps:
			if shown:
				draw(pictures[1], scene)
			began = time.perf_counter()
			watch.run(given.steps - half, afterStep)
			wallTime += time.perf_counter() - began
	if shown:
		draw(pictures[-1], scene)
		drawSeries(folder, pictures, scene)
	if recorder:
		recorder()  # the state at the end

	summary = watch.summary()
	positions = [body.state.pos for body in scene.particles()]
	inside = sum(max(abs(p[0]), abs(p[1])) < scene.width / 2 and 0 < p[2] < scene.wallHeight for p in positions)
	return {
	        'shape': name,
	        'planesPerPair': 2 * faces[0] if len(faces) == 1 else None,
	        'number': given.number,
	        'threads': O.numThreads,
	        'seed': seed,
	        'seconds': wallTime,
	        **summary,
	        'energyHalf': energyHalf,
	        'energyEnd': summary['kineticEnergy'] / energyUnit,
	        'meanHeight': sum(p[2] for p in positions) / len(positions) / scene.size,
	        'deepestOverlap': summary['deepestOverlap'] / scene.size,
	        'overlap': summary['overlap'] / scene.size,
	        'inside': inside,
	        'energies': energies,
	        **(timeSolvers(sample, given) if first else {}),  # last: it leaves another scene
	}


def timeSolvers(sample, given):
	"""Cold starts, and Ipopt, on the states kept during the run."""
	from yade.polytope.solverTimes import hasSolver
	results = {}
	if sample.marks:
		cold = sample.times(warmStart=False)
		results = {'cold': cold, 'lpColdMicroseconds': cold['lpMicroseconds'], 'centreColdMicroseconds': cold['centreMicroseconds']}
		if given.ipopt_every and given.contact_point == 'analyticCentre' and hasSolver('ipopt'):
			ipopt = sample.times(every=given.ipopt_every, passes=1, solver='ipopt', warmStart=False)
			results.update(ipopt=ipopt, ipoptMicroseconds=ipopt['centreMicroseconds'])
	return results


def draw(path, scene):
	"""As in the paper's Fig. 5: at the start, half-way and at the end, from the same place."""
	from yade.polytope.pictures import picture
	floor, top = scene.width / 2 + scene.wallThickness, scene.lattice()[:, 2].max() + scene.spacing / 2
	frame = [(x, y, -scene.wallThickness) for x in (-floor, floor) for y in (-floor, floor)]
	frame += [(x, y, top) for x in (-scene.width / 2, scene.width / 2) for y in (-scene.width / 2, scene.width / 2)]
	picture(path, bodies=shownBodies(scene), fixed='solid', frame=frame, size=(1000, 1000))


def shownBodies(scene):
	"""Without the walls."""
	from yade import O
	return [body for body in O.bodies if body.id not in scene.wallIds]


def drawSeries(folder, pictures, scene):
	"""The three pictures side by side, and the end once more from nearer."""
	import numpy as np
	from matplotlib.image import imread, imsave
	from yade.polytope.pictures import picture
	imsave(f'{folder}/steps.png', np.concatenate([imread(path) for path in pictures], axis=1))
	picture(f'{folder}/end.png', bodies=shownBodies(scene), fixed='solid', size=(1600, 1000))


# What is printed


def show(results, comparable):
	"""Costs and outcome of the first seed's runs."""
	from tabulate import tabulate
	titles = [title for _, title, _ in costColumns]
	rows = [['' if r[key] is None else format(r[key], form) for key, _, form in costColumns] for r in results]
	print('\nWhat the contact detection did, and what it cost')
	print(tabulate(rows, titles, stralign='right', disable_numparse=True))

	known = f' (what is expected is known for {fullNumber} particles, {fullSteps} steps and the usual parameters)'
	print('\nWhat came out' + ('' if comparable else known))
	rows = [['particles inside', results[0]['number'], *(r['inside'] for r in results)]]
	rows.append(['queries without an answer', 0, *(r['failures'] for r in results)])
	for key, (low, high) in expected.items():
		cells = [f"{r[key]:.4g}" + ('' if not comparable else '  ok' if low <= r[key] <= high else '  outside') for r in results]
		rows.append([labels[key], f'{low:g} … {high:g}' if comparable else '', *cells])
	print(tabulate(rows, ['', 'expected', *[r['shape'] for r in results]], disable_numparse=True))
	print('\nState at the end (SHA-256, first 16 digits; the same every time with one thread)')
	print(tabulate([[r['shape'], r['stateHash']] for r in results], tablefmt='plain'))


def save(results, folder):
	"""All runs, seed by seed."""
	(folder / 'results.json').write_text(json.dumps(results, indent='\t') + '\n')
	nested = ('statuses', 'energies', 'cold', 'ipopt')
	with open(folder / 'results.csv', 'w', newline='') as file:
		writer = csv.DictWriter(file, [key for key in results[0] if key not in nested], extrasaction='ignore')
		writer.writeheader()
		writer.writerows(results)


# What is found: rows, tables, figures and texts of the report


def findingsOf(results, given, comparable):
	from yade.polytope.findings import Findings
	options = {key: str(value) for key, value in vars(given).items() if key not in ('output', 'parameters')}
	findings = Findings('A', 'Falling polyhedra', given.output, options)
	firsts = [r for r in results if r['seed'] == given.seed]
	solid = {r['shape']: [other for other in results if other['shape'] == r['shape']] for r in firsts}
	settled(findings, results, solid, given, comparable)
	timed = [r for r in firsts if r['planesPerPair'] and 'cold' in r]
	if timed:
		costs(findings, timed, given)
	if not given.no_pictures:
		energies = plotEnergies(firsts, given.output / 'energies.png')
		findings.figure(energies, 'Kinetic energy during the run, first seed: free fall, impacts, then the heap comes to rest.')
		steps = f'at the start, at step {min(halfStep, given.steps)} and at step {given.steps}'
		for r in firsts if not given.quick else ():
			caption = f"As the paper's Fig. 5, {r['shape']}: {given.number} bodies {steps}. The walls are not drawn."
			findings.figure(given.output / r['shape'] / 'steps.png', caption)
	return findings


def settled(findings, results, solid, given, comparable):
	"""Have all come to rest as they should?"""
	note = f"{len(results)} runs: {'five solids' if len(solid) == 5 else ', '.join(solid)}, {given.seeds} seed{'s'[:given.seeds > 1]} each"
	findings.row('particles inside, fewest of all runs', min(r['inside'] for r in results), accept=(given.number, given.number), note=note)
	pairs, contacts = (sum(r[key] for r in results) for key in ('pairs', 'contactQueries'))
	findings.row(
	        'contact queries without an answer',
	        sum(r['failures'] for r in results),
	        paper='no difficulty',
	        accept=(0, 0),
	        note=f'of {pairs:,} pairs queried, of which {contacts:,} were contacts'
	)
	several = given.seeds >= fewestSeeds
	for key in ('energyHalf', 'energyEnd', 'deepestOverlap', 'overlap'):
		if key == 'energyHalf' and given.steps < halfStep:
			continue
		worst, name = max((statistics.median(r[key] for r in runs), name) for name, runs in solid.items())
		low, high = expected[key]
		# one body that topples late, or one hard impact, decides these two in a single run
		required = comparable and (several or key not in ('energyEnd', 'deepestOverlap'))
		note = f'{name}; median of the seeds; reference: ' + (f'{low:g} … {high:g}; less is no fault' if low else f'at most {high:g}')
		findings.row(f'{labels[key]}: largest of the solids', rounded(worst), accept=(0, high) if required else None, note=note)
	if comparable and len(solid) == 5:
		for key in ('contacts', 'meanHeight'):
			for pick, word, reference in zip((min, max), ('least', 'largest'), expected[key], strict=True):
				values = [pick(r[key] for r in runs) for runs in zip(*solid.values(), strict=True)]  # one of each seed
				compareExtreme(findings, f'{labels[key]}: {word} of the solids', values, reference)
		if several:
			findings.text(whyOutside(solid, given))
	rows = []
	for key, reference in expected.items():
		for name, runs in solid.items():
			figures = (pick(r[key] for r in runs) for pick in (statistics.median, min, max))
			rows.append([labels[key], name, len(runs), *figures, *(reference if comparable else ('', ''))])
	columns = ['', 'solid', 'seeds', 'median', 'least', 'largest', 'reference, from', 'reference, to']
	findings.table('settled', 'How each solid came to rest, over the seeds.', columns, rows)
	if not given.no_pictures and given.seeds > 1:
		findings.figure(
		        plotSeeds(solid, comparable, given.output / 'seeds.png'),
		        'Each dot a run of another seed; bars: medians. Grey: the range of the independent program, one run of each solid.'
		)


def compareExtreme(findings, quantity, values, reference):
	"""The reference has the extreme of five single runs: must it be one of ours? Within the 99 % prediction interval for one more value."""
	accept, note = None, f'reference, of one run of each solid: {reference:g}'
	if len(values) >= fewestSeeds:
		from scipy.stats import t
		half = rounded(t.ppf(0.995, len(values) - 1) * statistics.stdev(values) * math.sqrt(1 + 1 / len(values)))
		accept = rounded(reference - half), rounded(reference + half)
		note += f' ± 99 % prediction interval of our scatter ({statistics.stdev(values):.3g} between seeds); ours: mean of the seeds'
	findings.row(quantity, rounded(statistics.fmean(values)), accept=accept, note=note)


def rounded(value):
	"""To the digits that mean something here."""
	return float(f'{value:.4g}')


def whyOutside(solid, given):
	"""Single runs against the ranges of the reference."""
	outside = {}
	for key, (low, high) in expected.items():
		outside[labels[key]] = sum(not low <= r[key] <= high for runs in solid.values() for r in runs)
	heights = [r['meanHeight'] for r in solid['tetrahedron']]
	mean, deviation = statistics.fmean(heights), statistics.stdev(heights)
	reference = expected['meanHeight'][1]
	away = (reference - mean) / deviation
	counts = ', '.join(f'{count} in “{label}”' for label, count in outside.items() if count) or 'none'
	return (
	        f'Heaps are chaotic: with another seed each solid ends in another heap. Of {sum(map(len, solid.values()))} runs these are '
	        f'outside the reference: {counts}. Its ranges are those of one run of each solid by an independent program, so single runs '
	        'fall outside by chance; what must hold is compared over the seeds. '
	        f"The tetrahedra's mean height is an example: {mean:.3f} L in the mean of {given.seeds} seeds, with a standard deviation of "
	        f'{deviation:.3f} L between them ({min(heights):.3f} … {max(heights):.3f} L). The largest of the reference, {reference:g} L, '
	        f"lies {abs(away):.1f} standard deviations {'below' if away < 0 else 'above'} our mean: "
	        + ('chance explains it.' if abs(away) < 2 else 'chance hardly explains it.')
	)


def costs(findings, timed, given):
	"""Fig. 6: what a contact problem costs against the planes of both bodies."""
	planes = [r['planesPerPair'] for r in timed]
	shown = [curve for curve in curves if all(math.isfinite(r.get(curve[0], math.nan)) for r in timed)]
	for key, label, reading, *_ in shown:
		values = [r[key] for r in timed]
		findings.row(f'{label}: N = {span(planes)}', span(values), 'µs', paper=reading or None)
	if 'ipopt' in timed[0]:
		missing, tried = (sum(r['ipopt'][key] for r in timed) for key in ('fallbacks', 'contacts'))
		findings.row('contacts whose centre Ipopt did not find', missing, paper='no difficulty', note=f'of {tried:,} given to it')
	fits = []
	if len(timed) >= 3:
		import numpy as np
		growth = {'lpColdMicroseconds': 'O(N)', 'ipoptMicroseconds': 'almost none'}
		for key, label, *_ in shown:
			values = [r[key] for r in timed]
			exponent = np.polyfit(np.log(planes), np.log(values), 1)[0]
			slope, constant = np.polyfit(planes, values, 1)
			fits.append([label, exponent, constant, slope])
			note = f'straight line through the five: {constant:.3g} µs + {slope:.3g} µs × N'
			findings.row(f'{label}: grows as N to the power', rounded(exponent), paper=growth.get(key), note=note)
	if not given.no_pictures:
		caption = (
		        "The paper's Fig. 6, redrawn: time per contact problem against the number of planes of both bodies. Shaded: what the paper "
		        'says of its own, tens of µs (linear programme by CPLEX, log-barrier centre) and a few ms (IPOPT).'
		)
		findings.figure(plotCosts(timed, shown, given.output / 'fig6.png'), caption)
	findings.text(howTimed(timed))
	rows = [[r['shape'], r['planesPerPair'], *[r[key] for key, *_ in shown]] for r in timed]
	findings.table('fig6', 'Time per contact problem [µs].', ['solid', 'N', *[label for _, label, *_ in shown]], rows)
	if fits:
		columns = ['', 'power', 'constant [µs]', 'slope [µs per plane]']
		findings.table('fig6_fits', 'How the times grow with N: as a power, and as a straight line constant + slope N.', columns, fits)
	columns = ['solid', 'N', 'pivots per LP, warm', 'pivots per LP, cold', 'Newton steps, warm', 'Newton steps, cold']
	columns += ['pairs, cold', 'contacts, cold', 'contacts, Ipopt', 'iterations, Ipopt', 'fallbacks, Ipopt', 'failures, cold and Ipopt']
	rows = []
	for r in timed:
		cold, ipopt = r['cold'], r.get('ipopt') or dict.fromkeys(r['cold'], 0)
		work = [source[key] for key in ('pivotsPerPair', 'newtonPerContact') for source in (r, cold)]
		counts = cold['pairs'], cold['contacts'], ipopt['contacts'], ipopt['ipoptPerContact'], ipopt['fallbacks']
		rows.append([r['shape'], r['planesPerPair'], *work, *counts, cold['failures'] + ipopt['failures']])
	findings.table('fig6_sample', 'What the times of cold starts and of Ipopt are means of, and how the solvers did.', columns, rows)


def span(values):
	low, high = format(min(values), '.3g'), format(max(values), '.3g')
	return low if low == high else f'{low} … {high}'


def howTimed(timed):
	contacts, states = sum(r['contactQueries'] for r in timed), timed[0]['cold']['states']
	text = (
	        "Times are wall times by the functor's own clock. Warm start is what a run costs: each pair begins with its last step's basis "
	        'and point; the mean over all pairs (LP) or contacts (centre) of ten steps in every hundred of the whole run. Cold start is '
	        f'what the paper timed, whose solvers started anew in each step: all pairs and contacts of {states} states spread evenly over '
	        'the run, each state gone through five times, of which the fastest counts. Steps in which another program took the processor '
	        'do not count.'
	)
	if 'ipopt' in timed[0]:
		seconds = sum(r['ipoptMicroseconds'] * r['contactQueries'] for r in timed) * 1e-6
		ratios = [r['ipoptMicroseconds'] / r['centreColdMicroseconds'] for r in timed]
		text += (
		        f" Ipopt solved every contact of {timed[0]['ipopt']['states']} of these states once; all {contacts:,} contacts of the "
		        f'runs would take it {seconds / 3600:.1f} hours. It takes {min(ratios):.0f} to {max(ratios):.0f} times as long as Newton '
		        'for the same centre: setting up a general problem costs more than solving three equations.'
		)
	else:
		text += ' Ipopt is not in this build or was not asked for: its curve is missing.'
	return text + (
	        ' The paper used general solvers (CPLEX, IPOPT) on a machine of its time; here each problem has a solver of its own, for '
	        'exactly four and three unknowns. Absolute times differ for both reasons; their order and their growth with N can be compared.'
	)


def axes(path, size, **labels):
	"""A figure with plain axes; returns them and what saves it."""
	import matplotlib
	matplotlib.use('Agg')
	import matplotlib.pyplot as plt
	figure, ax = plt.subplots(figsize=size, layout='constrained')
	ax.set(**labels)
	ax.spines[['top', 'right']].set_visible(False)

	def finish():
		figure.savefig(path, dpi=150)
		plt.close(figure)
		return path

	return ax, finish


def plotCosts(timed, shown, path):
	ax, finish = axes(path, (8, 5.6), xlabel='planes of both bodies, $N_A + N_B$', ylabel='µs per contact problem')
	ax.set(xscale='log', yscale='log')
	planes = [r['planesPerPair'] for r in timed]
	for low, high, text in ((1e3, 1e4, 'paper: IPOPT, “a few ms”'), (1e1, 1e2, 'paper: LP and log-barrier centre, “tens of µs”')):
		ax.axhspan(low, high, color='#e9ecf1', zorder=0)
		place = {'xycoords': ('axes fraction', 'data'), 'xytext': (0, -4), 'textcoords': 'offset points', 'ha': 'right', 'va': 'top'}
		ax.annotate(text, (0.99, high), **place, color='#687385')
	for key, label, _, color, style in shown:
		ax.plot(planes, [r[key] for r in timed], style, color=color, marker='o', label=label)
	ax.set_xticks(planes, [str(n) for n in planes])
	ax.minorticks_off()
	ax.legend(frameon=False, loc='upper left', bbox_to_anchor=(0, -0.13), ncols=2, fontsize='small')
	return finish()


def plotEnergies(firsts, path):
	ax, finish = axes(path, (8, 4), xlabel='step', ylabel='kinetic energy / (N m g L)', yscale='log')
	for k, r in enumerate(firsts):
		if r['energies']:
			ax.plot(*zip(*r['energies'], strict=True), label=r['shape'], color=f'C{k}', lw=1.2)
	ax.legend(frameon=False)
	return finish()


def plotSeeds(solid, comparable, path):
	import matplotlib
	matplotlib.use('Agg')
	import matplotlib.pyplot as plt
	figure, panels = plt.subplots(2, 3, figsize=(11, 6), layout='constrained')
	for ax, key in zip(panels.flat, expected, strict=True):
		if comparable:
			ax.axhspan(*expected[key], color='#e9ecf1', zorder=0)
		for k, of in enumerate(solid.values()):
			values = [r[key] for r in of]
			ax.plot([k] * len(values), values, 'o', ms=4, alpha=0.6, color=f'C{k}')
			ax.plot([k - 0.25, k + 0.25], [statistics.median(values)] * 2, color=f'C{k}', lw=2)
		ax.set_title(labels[key], fontsize='medium')
		ax.set_xticks(range(len(solid)), [name[:5] + '.' if len(name) > 5 else name for name in solid], fontsize='small')
		if key.startswith('energy'):
			ax.set_yscale('log')
		ax.spines[['top', 'right']].set_visible(False)
	figure.savefig(path, dpi=150)
	plt.close(figure)
	return path


def main():
	given = options()
	os.environ['OMP_NUM_THREADS'] = str(given.threads)
	from yade import O
	if O.numThreads != given.threads:
		print(f'--threads {given.threads}: within YADE threads are its own option: yade -j {given.threads} …', file=sys.stderr)
		return 2
	names = solidNames if given.shape == 'all' else (given.shape, )
	results = [simulate(name, seed, given) for name in names for seed in range(given.seed, given.seed + given.seeds)]
	asUsual = not given.parameters and given.contact_point == 'analyticCentre'
	comparable = asUsual and given.number == fullNumber and given.steps == fullSteps
	show([r for r in results if r['seed'] == given.seed], comparable)
	save(results, given.output)
	findings = findingsOf(results, given, comparable)
	print('\nWhat is found')
	findings.show()
	good = findings.save()
	print(f'\nFiles: {given.output}/')
	return 0 if good else 1


if __name__ == '__main__':
	sys.exit(main())
