# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of the results."""
import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from scenes import median, peers, solids

planesOf = {**{name: 2 * faces for name, faces in solids.items()}, **{f'hull {n}': 2 * n for n in (20, 50, 100, 200)}}
"""Planes of both bodies together."""

colors = {
        'ours cold': '#c2410c',
        'ours warm': '#f59e0b',
        'ours, spring cold': '#be185d',
        'ours, spring warm': '#f472b6',
        'one pass': '#9ca3af',
        'libccd MPR': '#1d4ed8',
        'libccd GJK+EPA': '#60a5fa',
        'FCL': '#0f766e',
        'coal GJK+EPA': '#7c3aed',
        'CLP, as YADE calls it': '#374151',
        'CLP, one model reused': '#6b7280',
}


def save(figure, path):
	figure.tight_layout()
	figure.savefig(path, dpi=120)
	plt.close(figure)


def costAgainstPlanes(kernels, path):
	figure, axes = plt.subplots(figsize=(8, 5.5))
	for method, color in colors.items():
		points = sorted((planesOf[name], kernels[method, name].median) for name in planesOf if (method, name) in kernels)
		# a cube's pair and a hull's may have the same number of planes: the hulls go on where the solids end
		if points:
			axes.plot(*zip(*points), 'o-', color=color, label=method, markersize=4, linewidth=2 if method.startswith('ours') else 1)
	axes.set(xscale='log', yscale='log', xlabel='planes of both bodies', ylabel='µs a pair', title='Touching pair: regular solids, then random hulls')
	axes.grid(True, which='both', alpha=0.25)
	axes.legend(fontsize=8, ncols=2)
	save(figure, path)


def stages(kernels, name, start):
	"""Cost of each stage [µs] from differences of medians: {stage: µs}."""

	def time(method):
		return kernels[method, name].median

	lp = time(f'ours, LP alone {start}')
	byLp = time(f'ours, Chebyshev centre {start}')
	return {
	        'frames, planes, LP': lp,
	        'normal, depth': max(0, byLp - lp),
	        'analytic centre': max(0, time(f'ours {start}') - byLp),
	        'contact area (if asked for)': max(0, time('ours with area warm') - time('ours warm')),
	}


def breakdown(kernels, path):
	names = [name for name in planesOf if ('ours cold', name) in kernels]
	figure, both = plt.subplots(1, 2, figsize=(12, 5), sharey=True)
	for axes, start in zip(both, ('cold', 'warm'), strict=True):
		bottom = np.zeros(len(names))
		table = [stages(kernels, name, start) for name in names]
		for stage, color in zip(table[0], ('#1d4ed8', '#0f766e', '#c2410c', '#d1d5db'), strict=True):
			# per pass over all planes: the floor is 1
			heights = np.array([row[stage] / kernels['one pass', name].median for row, name in zip(table, names, strict=True)])
			axes.bar(names, heights, bottom=bottom, color=color, label=stage)
			bottom += heights
		axes.axhline(1, color='black', linewidth=1, linestyle='--', label='one pass over all planes')
		if start == 'cold':
			axes.axhline(25, color='#9ca3af', linewidth=1, linestyle=':', label='target without area')
		axes.set_title(start)
		axes.tick_params(axis='x', rotation=40)
		axes.grid(True, axis='y', alpha=0.25)
	both[0].set_ylabel('cost in passes over all planes')
	both[0].legend(fontsize=8)
	save(figure, path)


def costBySet(kernels, path):
	names = list(dict.fromkeys(name for _, name in kernels))
	figure, axes = plt.subplots(figsize=(9, 0.42 * len(names) + 1.6))
	for method, color in colors.items():
		aside = 0.25 if 'spring' in method else 0  # its pairs apart cost the same
		points = [(kernels[method, name].median, y + aside, kernels[method, name].wrong) for y, name in enumerate(names) if (method, name) in kernels]
		if not points:
			continue
		right = [(x, y) for x, y, wrong in points if not wrong]
		wrong = [(x, y) for x, y, wrong in points if wrong]
		axes.plot(*(zip(*right) if right else ([], [])), 'o', color=color, label=method, zorder=3 if method.startswith('ours') else 2)
		axes.plot(*(zip(*wrong) if wrong else ([], [])), 'x', color=color)
	axes.set(xscale='log', xlabel='µs a pair (×: some answers wrong)', yticks=range(len(names)), yticklabels=names)
	axes.invert_yaxis()
	axes.grid(True, which='both', alpha=0.25)
	axes.legend(fontsize=8, loc='upper left', bbox_to_anchor=(1.01, 1))
	save(figure, path)


def growth(found, path):
	numbers = sorted(found)
	costs = [1e6 * median(found[number]['perBody']) for number in numbers]
	loops = [1e6 * median([row['loop'] for row in found[number]['rows']]) / found[number]['bodies'] for number in numbers]
	figure, axes = plt.subplots(figsize=(7, 4.5))
	axes.plot(numbers, costs, 'o-', color='#374151', label='all engines')
	axes.plot(numbers, loops, 'o-', color='#c2410c', label='InteractionLoop; the rest is collider and integrator')
	axes.axhline(1.3 * costs[0], color='#9ca3af', linestyle=':', label='1.3 × all engines of the smallest heap')
	axes.set(xscale='log', xlabel='bodies', ylabel='µs a body and step', ylim=(0, None), title='Heaps of cubes, as many layers on ever larger floors')
	axes.grid(True, alpha=0.25)
	axes.legend()
	save(figure, path)


def heaps(found, path):
	colors = {'ours': '#c2410c', 'ours, with area': '#f59e0b', 'polyhedra': '#0f766e', 'potentialBlock': '#1d4ed8'}
	figure, axes = plt.subplots(figsize=(9, 4.5))
	for shift, (method, color) in enumerate(colors.items()):
		at = [(x, 1e6 * median(row[method]['perPair'])) for x, row in enumerate(found.values()) if row.get(method)]
		if at:
			axes.bar([x + 0.2 * (shift - 1.5) for x, _ in at], [y for _, y in at], width=0.19, color=color, label=peers.get(method, method))
	axes.set(yscale='log', ylabel='InteractionLoop, µs a candidate pair', xticks=range(len(found)), xticklabels=list(found), title='200 falling solids')
	axes.set_ylim(bottom=0.05)
	axes.grid(True, axis='y', which='both', alpha=0.25)
	axes.legend(loc='upper left', bbox_to_anchor=(1.01, 1))
	save(figure, path)


def extras(costs, path):
	"""*costs*: {what is asked for: µs a step}, the first of nothing."""
	figure, axes = plt.subplots(figsize=(7, 0.5 * len(costs) + 1.2))
	bars = axes.barh(list(costs), list(costs.values()), color=['#c2410c'] + ['#f59e0b'] * (len(costs) - 1))
	without = next(iter(costs.values()))
	axes.bar_label(bars, [f'{cost:.0f}' if name == 'nothing' else f'{100 * (cost / without - 1):+.0f} %' for name, cost in costs.items()], padding=4)
	axes.axvline(without, color='#9ca3af', linestyle=':')
	axes.set(xlabel='µs a step, all engines', title='Settled cubes: what is asked for besides', xlim=(0, 1.15 * max(costs.values())))
	axes.invert_yaxis()
	save(figure, path)
