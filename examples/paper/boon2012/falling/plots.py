# SPDX-License-Identifier: GPL-2.0-or-later
"""Plot of simulation A: what a contact problem costs (Fig. 6 of the paper)."""

from matplotlib.figure import Figure

__all__ = ['plotCosts']

styles = {
	'ipoptMicroseconds': ('#8a4f9e', '-'),
	'centreColdMicroseconds': ('#c8451b', '-'),
	'centreMicroseconds': ('#c8451b', ':'),
	'lpColdMicroseconds': ('#1d4e79', '-'),
	'lpMicroseconds': ('#1d4e79', ':'),
}
"""Colour and line style of the curves."""
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


def _axes(size, **labels):
	figure = Figure(figsize=size, layout='constrained')
	ax = figure.subplots()
	ax.set(**labels)
	ax.spines[['top', 'right']].set_visible(False)
	return figure, ax
