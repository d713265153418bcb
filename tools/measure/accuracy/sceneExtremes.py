# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes in YADE varied along six axes from easy to extreme, each beside its closed form, with both contact models.

Stiffness ratio to 1e6, mass ratio to 1e9, time step to past the critical one, a tower of 50 blocks, 1e6 steps at rest and a slide of 1e6
steps. Ends with 1 if a number of a scene is not finite, a contact failed, or an error is above the limit that
docs/accuracy.md states. --quick has fewer values along the axes and the same limits, so the same number of steps where a limit is one of steps.

	./run python tools/measure/accuracy/sceneExtremes.py --quick
	./run python tools/measure/accuracy/sceneExtremes.py --axes tower rest
"""

import argparse
import dataclasses
import math
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; a few bodies are too few for more

from tqdm import tqdm

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import writableFolder
from boon2012.reporting.script import conclude
from sceneAxes import collide, rest, slide, stack, tower, vibrate

models = ('surface', 'boon2012')


def cells(results):
	"""(columns, rows) of a table of (model, value, dataclass)."""
	columns = ['model', 'value', *(field.name for field in dataclasses.fields(results[0][2]))]
	return columns, [[model, f'{value:g}', *(_text(x) for x in dataclasses.astuple(result))] for model, value, result in results]


def _text(x):
	return f'{x:.3g}' if isinstance(x, float) else str(x)


def sound(findings, title, failures, finite):
	findings.row(
		f'{title}: scenes with a contact query without an answer or a number that is not finite',
		sum(map(bool, failures)) + finite.count(False),
		accept=(0, 0),
	)


def worst(values):
	values = [abs(v) for v in values if not math.isnan(v)]
	return max(values) if values else math.nan


def stiffness(findings, quick):
	title = 'Stiffness ratio'
	ratios = (1, 1e2, 1e4) if quick else (1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6)
	results = [(model, ratio, stack(model, stiffnessRatio=ratio)) for model in models for ratio in ratios]
	sound(findings, title, [r.failures for _, _, r in results], [r.finite for _, _, r in results])
	findings.row(
		f'{title}: normal forces at rest, worst relative error',
		worst(x for _, _, r in results for x in (r.lowerForce, r.upperForce)),
		accept=(0, 1e-7),
	)
	heights = worst(x for _, _, r in results for x in (r.lowerHeight, r.upperHeight))
	findings.row(f'{title}: heights at rest over the softer overlap, worst error', heights, accept=(0, 2e-7))
	findings.text(
		f'{title}. A block on a block on a floor; the joint below is up to a million times as stiff as the one between the blocks. The time step '
		'follows the stiff joint, the settling the soft one. Each rounding of a position (1e-16 m) is a force of the stiff joint’s stiffness times that.'
	)
	findings.table('stiffness', f'{title}; value: stiffness below over above', *cells(results))


def mass(findings, quick):
	title = 'Mass ratio'
	ratios = (1, 1e3, 1e9) if quick else (1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9)
	results = [
		(f'{model}, {"light" if light else "heavy"} moves', ratio, collide(model, ratio, light))
		for model in models
		for light in (True, False)
		for ratio in ratios
	]
	stacks = [('surface', ratio, stack('surface', massRatio=ratio, away=0, most=5000)) for ratio in ratios]
	everything = results + stacks
	sound(findings, title, [r.failures for _, _, r in everything], [r.finite for _, _, r in everything])
	findings.row(f'{title}: collisions that did not part', sum(not r.parted for _, _, r in results), accept=(0, 0))
	findings.row(f'{title}: momentum after a collision, worst relative change', worst(r.momentum for _, _, r in results), accept=(0, 1e-14))
	findings.row(f'{title}: light body’s speed after it, worst relative error', worst(r.speed for _, _, r in results), accept=(0, 1e-4))
	errors = worst(x for _, _, r in stacks for x in (r.lowerForce, r.upperForce))
	findings.row(f'{title}: heavy block left on a light one (surface), worst relative error of a force', errors, accept=(0, 1e-7))
	findings.text(
		f'{title}. A cube meets another face on face, without friction and damping, at a fiftieth of √(m/k): the error of its speed is the time '
		'step’s. And a heavy block is placed on a light one with the closed form’s overlaps, and left for 5000 steps of the light one; what the first step gave it (g Δt) swings on.'
	)
	findings.table('mass', f'{title}, collisions; value: heavy over light body', *cells(results))
	findings.table('massStacks', f'{title}, heavy block on a light one; value: heavy over light block', *cells(stacks))


def timeStep(findings, quick):
	title = 'Time step'
	fractions = (0.1, 0.5, 0.9, 1.1, 2) if quick else (0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99, 1.01, 1.05, 1.1, 1.3, 1.6, 2, 3, 5, 10)
	results = [(model, fraction, vibrate(model, fraction)) for model in models for fraction in fractions]
	sound(findings, title, [r.failures for _, _, r in results], [r.finite for _, _, r in results])
	# central differences: a free swing's amplitude is larger by 1/√(1 − (Δt/Δt crit)²)
	below = worst(r.growth * math.sqrt(1 - r.timeStep**2) - 1 for _, f, r in results if f <= 0.9)
	findings.row(
		f'{title}: up to 0.9 of polytope.stableTimeStep(2), swing over the scheme’s own, worst difference', below, accept=(0, 0.05)
	)
	# beyond it the block may rock instead, until it lifts off: height need not show it, energy does
	above = min(r.energyGrowth for _, f, r in results if f >= 1.1)
	findings.row(f'{title}: from 1.1 of it on, least growth of the kinetic energy: it shows', above, accept=(10, math.inf))
	findings.text(
		f'{title}. A block swings on a floor about its rest for 2000 steps, undamped. polytope.stableTimeStep(2) is the limit of one body from all '
		'stiffnesses, rocking of both contact models included (docs/time-step.md), here where the overlap of the swing is deepest. Below it the swing is the scheme’s own; past it the block turns, is thrown off, and gains energy each time it '
		'comes back: kinetic energy tells at once, and every number stays finite.'
	)
	findings.table('timeStep', f'{title}; value: over polytope.stableTimeStep(2)', *cells(results))


def towers(findings, quick):
	title = 'Tower of 50 blocks'
	steps = (3000, 30000) if quick else (1000, 3000, 10000, 30000)
	results = [(model, n, tower(model, 50, n)) for model in models for n in steps]
	sound(findings, title, [r.failures for _, _, r in results], [r.finite for _, _, r in results])
	last = {model: next(r for m, n, r in results if (m, n) == (model, steps[-1])) for model in models}
	for model, r in last.items():
		findings.row(f'{title}: worst relative error of a normal force ({model})', r.force, accept=(0, 5e-5))
		findings.row(f'{title}: largest way sideways ({model})', r.sideways, 'm', accept=(0, 5e-3))
	# blocks aside tilt their joints, and the top comes down with the square of the way aside: 1e-3 of the settlement after 6000 steps, a quarter of
	# that with half the way, 3e-13 with none; it goes on for as long as the column leans, 4.5e-3 after 30 000
	findings.row(
		f'{title}: settlement of the top over that of aligned blocks, difference',
		worst(r.settlement for r in last.values()),
		accept=(0, 1e-2),
	)
	findings.text(
		f'{title}. Cubes of 1 m, each up to 2 cm aside, placed with the overlaps that carry the weight. A joint’s rocking stiffness in the '
		'paper’s model is k L² (L half the width), so the column buckles under a weight of 7.84 k L² h/H² (Greenhill), that is, below k = 1.6e9 N/m; here it is 1e10 N/m.'
	)
	findings.table('tower', f'{title}; value: steps', *cells(results))


def atRest(findings, quick):
	title = 'Steps at rest'
	steps = 1000000
	results, failures, finite = [], [], []
	for model in models:
		rows, failed, good = rest(model, steps)
		results += [(model, row.steps, row) for row in rows]
		failures.append(failed)
		finite.append(good)
	sound(findings, title, failures, finite)
	findings.row(f'{title}: way of a block of 1 m in {steps} steps', worst(r.position for _, _, r in results), 'm', accept=(0, 1e-11))
	# about the normal nothing turns it back, and it keeps the spin that was left when damping ended, 1e-13 rad/s; the limit is a rounding of the
	# orientation, 1.1e-16, in each of the million steps
	findings.row(f'{title}: its turn', worst(r.turn for _, _, r in results), 'rad', accept=(0, 1e-10))
	findings.row(f'{title}: its kinetic energy over weight × overlap', worst(r.energy for _, _, r in results), accept=(0, 1e-15))
	findings.text(f'{title}. A block on a floor, both turned in space, has come to rest; then all damping is taken away.')
	findings.table('rest', f'{title}; value: steps', *cells(results))


def slides(findings, quick):
	title = 'Slide'
	steps = 1000000
	results, failures, finite = [], [], []
	for model in models:
		rows, failed, good = slide(model, steps)
		results += [(model, row.steps, row) for row in rows]
		failures.append(failed)
		finite.append(good)
	sound(findings, title, failures, finite)
	# the first millimetre is given to the shear that the joint had stored
	findings.row(
		f'{title}: distance after {steps} steps, worst relative error',
		worst(r.distanceError for _, n, r in results if n == steps),
		accept=(0, 1e-5),
	)
	findings.row(f'{title}: speed, worst relative error', worst(r.speedError for _, _, r in results), accept=(0, 1e-5))
	findings.row(f'{title}: tilt of the block', worst(r.tilt for _, _, r in results), 'rad', accept=(0, 1e-5))
	findings.text(
		f'{title}. A flat block slides down a slope half a degree steeper than its friction angle, with normal and rocking damping.'
	)
	findings.table('slide', f'{title}; value: steps', *cells(results))


axes = {'stiffness': stiffness, 'mass': mass, 'timeStep': timeStep, 'tower': towers, 'rest': atRest, 'slide': slides}


def options(arguments=None):
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	parser.add_argument('--quick', action='store_true', help='fewer values')
	parser.add_argument('--axes', nargs='+', choices=list(axes), default=list(axes), metavar='AXIS', help=f'of {", ".join(axes)}')
	parser.add_argument('--output', type=writableFolder, default=pathlib.Path('output/sceneExtremes'), help='folder for all files')
	return parser.parse_args(arguments)


def main(arguments=None):
	given = options(arguments)
	findings = Findings('scenes', 'Scenes at the extremes', given.output, {'quick': given.quick})
	for name in tqdm(given.axes):
		axes[name](findings, given.quick)
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
