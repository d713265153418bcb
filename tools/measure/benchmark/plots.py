# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture docs/speed.png, and the parts of a query."""

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
from scenes import solids

planesOf = {**{name: 2 * faces for name, faces in solids.items()}, **{f'hull {n}': 2 * n for n in (20, 50, 100, 200)}}
"""Planes of both bodies together."""

colors = {
	'ours cold': '#c2410c',
	'ours warm': '#f59e0b',
	'boon2012 cold': '#be185d',
	'boon2012 warm': '#f472b6',
	'one pass': '#9ca3af',
	'libccd MPR': '#1d4ed8',
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
			axes.plot(
				*zip(*points, strict=True), 'o-', color=color, label=method, markersize=4, linewidth=2 if method.startswith('ours') else 1
			)
	axes.set(
		xscale='log',
		yscale='log',
		xlabel='planes of both bodies',
		ylabel='µs a pair',
		title='Touching pair: regular solids, then random hulls',
	)
	axes.grid(True, which='both', alpha=0.25)
	axes.legend(fontsize=8, ncols=2)
	save(figure, path)


def parts(kernels, name):
	"""What the parts of a query cost, some as differences of medians: {part: µs}."""

	def time(method):
		return kernels[method, name].median

	cold, warm = time('ours cold'), time('ours warm')
	return {
		'cold': cold,
		'linear program of it': time('ours, LP alone cold'),
		'warm': warm,
		'energy more, if asked for': max(0, time('ours with energy warm') - warm),
		'outline more, for friction': max(0, time('ours with outline warm') - warm),
		'boon2012, warm': time('boon2012 warm'),
	}
