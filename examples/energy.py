# SPDX-License-Identifier: GPL-2.0-or-later
"""The contact surface and the paper's contact: 200 polyhedra in a box without friction and damping, and their total energy over time.

	./run python examples/energy.py                 # some minutes; writes output/energy.png and prints the errors
	./run python examples/energy.py --seconds 0.5   # shorter; --number N, --output FILE, --help

With the contact surface energy is conserved, with a stiffness per contact (contactModel='spring') and with one per area ('foundation'); the remaining
error falls with the time step, so it is the integrator's. The paper's force, stiffness times the chord along an averaged normal ('boon2012'), is no
gradient of an energy: that of such a gas grows, at any time step.
"""

import argparse
import os
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')

from matplotlib.figure import Figure
from tabulate import tabulate
from tqdm import tqdm
from yade import O, polytope

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'paper'))
from boon2012.falling.scene import FallingPolyhedra

fraction = 0.02
"""Longest time step, as a part of sqrt(mass / stiffness)."""
perArea = 25.0
"""Stiffness per area of *foundation*, over that per contact of the others and the area of a cube's face."""
conserving = 'spring', 'foundation'
runs = ('boon2012', 1), ('boon2012', 4), *((model, shorter) for model in conserving for shorter in (1, 2, 4))
"""Contact model, and how many times shorter the step is."""
colors = {
	**{('boon2012', 1): '#c8451b', ('boon2012', 4): '#f2a541'},
	**{('spring', 1): '#1d4e79', ('spring', 2): '#5a9bc4', ('spring', 4): '#a9cfe6'},
	**{('foundation', 1): '#5b2a86', ('foundation', 2): '#9a6fc0', ('foundation', 4): '#cdb7e0'},
}


def energies(model, shorter, seconds, samples=200, number=200):
	"""One run: times [s], total energies over that at the start, and the shortest polytope.stableTimeStep(2) [s] seen."""
	scene = FallingPolyhedra(
		faces=(4, 6, 8, 12, 20), number=number, frictionAngle=0, contactDamping=0, damping=0, timeStepFraction=fraction / shorter
	).build()
	scene.geometryFunctor.contactModel = model
	if model == 'foundation':
		scene.interactionLoop.physDispatcher.functors[0].stiffnessPerArea = True
		for material in O.materials:
			material.normalStiffness *= perArea / scene.size**2
			material.shearStiffness *= perArea / scene.size**2
	steps = max(2, round(seconds / O.dt / samples))
	times, values, limits = [O.time], [polytope.mechanicalEnergy()], []
	for _ in tqdm(range(samples), desc=f'{model} {O.dt:.1e} s', disable=None):
		O.run(steps - 1, wait=True)
		times.append(O.time)
		values.append(polytope.mechanicalEnergy())
		limits.append(polytope.stableTimeStep(2, default=1))
	return times, [value / values[0] for value in values], min(limits)


def draw(path, results):
	figure = Figure(figsize=(8, 6.5), layout='constrained')
	upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
	for (model, shorter), (step, times, values, _) in results.items():
		style = {'color': colors[model, shorter], 'label': f"'{model}', Δt = {1e6 * step:.1f} µs", 'linewidth': 1.3}
		if model not in conserving or shorter == 1:
			upper.plot(times, values, **style)
		if model in conserving:
			lower.plot(times, [100 * (value - 1) for value in values], **style)
	upper.set(ylabel='total energy / that at the start', title='200 polyhedra fall in a box, without friction and damping', ylim=(0, None))
	lower.set(xlabel='time [s]', ylabel='error [%]', title="the same of contactModel='spring' and 'foundation' alone")
	for axes in (upper, lower):
		axes.grid(alpha=0.3)
		axes.legend(loc='upper left' if axes is upper else 'best', fontsize='small')
	figure.savefig(path, dpi=100)


def main():
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	parser.add_argument('--seconds', type=float, default=1.2, help='simulated time; the solids reach the floor after 0.2 to 0.6 s')
	parser.add_argument('--number', type=int, default=200, help='of polyhedra')
	parser.add_argument('--output', default='output/energy.png', help='the picture')
	given = parser.parse_args()
	results, rows = {}, []
	for model, shorter in runs:
		times, values, limit = energies(model, shorter, given.seconds, number=given.number)
		results[model, shorter] = O.dt, times, values, limit
		worst = max(abs(value - 1) for value in values)
		rows.append([model, f'{1e6 * O.dt:.2f}', f'{1e6 * limit:.0f}', f'{100 * (values[-1] - 1):+.4f}', f'{100 * worst:.4f}'])
	os.makedirs(os.path.dirname(given.output) or '.', exist_ok=True)
	draw(given.output, results)
	print(tabulate(rows, ['contactModel', 'Δt [µs]', 'stable up to [µs]', 'error at the end [%]', 'largest [%]'], disable_numparse=True))
	print(f'Picture: {given.output}')


if __name__ == '__main__':
	main()
