# SPDX-License-Identifier: GPL-2.0-or-later
"""Plots of simulation A: what a contact problem costs (the paper's Fig. 6), energies, and the scatter between seeds."""

import statistics

from matplotlib.figure import Figure

from .run import quantities

__all__ = ['plotCosts', 'plotEnergies', 'plotSeeds']

styles = {
	'ipoptMicroseconds': ('#8a4f9e', '-'),
	'centreColdMicroseconds': ('#c8451b', '-'),
	'centreMicroseconds': ('#c8451b', ':'),
	'lpColdMicroseconds': ('#1d4e79', '-'),
	'lpMicroseconds': ('#1d4e79', ':'),
}
"""Of the curves: colour and line style."""
band = '#e9ecf1'
"""Colour of the ranges of paper and reference."""


def plotCosts(path, timed, curves, paperBands):
	"""Fig. 6, redrawn.

	:param list timed: results of one run of each solid
	:param dict curves: name in the results → label
	:param paperBands: what the paper says of its own times, (from [µs], to [µs], text)
	"""
	figure, ax = _axes((8, 5.6), xlabel='planes of both bodies, $N_A + N_B$', ylabel='µs per contact problem')
	ax.set(xscale='log', yscale='log')
	planes = [r['planesPerPair'] for r in timed]
	for low, high, text in paperBands:
		ax.axhspan(low, high, color=band, zorder=0)
		place = {'xycoords': ('axes fraction', 'data'), 'xytext': (0, -4), 'textcoords': 'offset points', 'ha': 'right', 'va': 'top'}
		ax.annotate(text, (0.99, high), **place, color='#687385')
	for key, label in curves.items():
		color, style = styles[key]
		ax.plot(planes, [r[key] for r in timed], style, color=color, marker='o', label=label)
	ax.set_xticks(planes, [str(n) for n in planes])
	ax.minorticks_off()
	ax.legend(frameon=False, loc='upper left', bbox_to_anchor=(0, -0.13), ncols=2, fontsize='small')
	figure.savefig(path, dpi=150)


def plotEnergies(path, results):
	"""Kinetic energy against step, one curve a run."""
	figure, ax = _axes((8, 4), xlabel='step', ylabel='kinetic energy / (N m g L)', yscale='log')
	for k, r in enumerate(results):
		if r['energies']:
			ax.plot(*zip(*r['energies'], strict=True), label=r['shape'], color=f'C{k}', lw=1.2)
	ax.legend(frameon=False)
	figure.savefig(path, dpi=150)


def plotSeeds(path, ofSolid, ranges):
	"""Each quantity of each run, and the medians.

	:param dict ofSolid: name → results of its runs
	:param dict ranges: of the reference, name in the results → (from, to); may be empty
	"""
	figure = Figure(figsize=(11, 6), layout='constrained')
	panels = figure.subplots(2, 3)
	for ax, (key, label) in zip(panels.flat, quantities.items(), strict=True):
		if key in ranges:
			ax.axhspan(*ranges[key], color=band, zorder=0)
		for k, runs in enumerate(ofSolid.values()):
			values = [r[key] for r in runs]
			ax.plot([k] * len(values), values, 'o', ms=4, alpha=0.6, color=f'C{k}')
			ax.plot([k - 0.25, k + 0.25], [statistics.median(values)] * 2, color=f'C{k}', lw=2)
		ax.set_title(label, fontsize='medium')
		ax.set_xticks(range(len(ofSolid)), [name[:5] + '.' if len(name) > 5 else name for name in ofSolid], fontsize='small')
		if key.startswith('energy'):
			ax.set_yscale('log')
		ax.spines[['top', 'right']].set_visible(False)
	figure.savefig(path, dpi=150)


def _axes(size, **labels):
	figure = Figure(figsize=size, layout='constrained')
	ax = figure.subplots()
	ax.set(**labels)
	ax.spines[['top', 'right']].set_visible(False)
	return figure, ax
