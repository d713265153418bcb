# SPDX-License-Identifier: GPL-2.0-or-later
"""Plots of `./run accuracy`: error and status along an axis."""

import collections
import statistics

from matplotlib.figure import Figure
from pairTables import failed

__all__ = ['plotPairs', 'save']

colors = ('#1d4e79', '#c8451b', '#5d8a3a', '#8a5a9e', '#c79a1e', '#3a9c9c', '#7a7a7a')
statusColors = {
	'separated': '#e3e6ea',
	'contact': '#86b7d6',
	'normalFromOneBody': '#a8cf9a',
	'normalFromDual': '#5d8a3a',
	'roundingLimited': '#f0c34a',
	'noDirection': '#e08a2e',
	'centreByIpopt': '#b79ad0',
}
failedColor = '#b3261e'
errors = {
	'infeasibilityError': 's*: error over the size',
	'forceError': 'depth × normal: error over the size',
	'centreError': 'contact point: error over the overlap’s own size',
}
least = 1e-17
"""Errors below are drawn here: exact."""


def plotPairs(path, axis, samples):
	"""Errors (median as a line, worst as marks) and statuses.

	:param Axis axis: title and labels
	:param samples: list of Sample
	"""
	values = list(dict.fromkeys(s.value for s in samples))
	kinds = list(dict.fromkeys(s.kind for s in samples))
	figure = Figure(figsize=(8, 13), dpi=110)
	plots = figure.subplots(4, 1, sharex=True, height_ratios=[2, 2, 3, 1.4])
	for plot, (name, label) in zip(plots, errors.items(), strict=False):
		for kind, color in zip(kinds, colors, strict=False):
			_curve(plot, [s for s in samples if s.kind == kind], values, name, kind, color)
		plot.set(yscale='log', ylabel=label)
		plot.grid(True, lw=0.3, color='0.85')
	_statuses(plots[3], samples, values)
	plots[0].set_title(axis.title)
	plots[3].set(xlabel=axis.label, ylabel='share of statuses')
	plots[3].set_xticks(range(len(values)), [f'{v:g}' for v in values], rotation=60 if len(values) > 9 else 0, fontsize=8)
	handles, labels = plots[0].get_legend_handles_labels()
	figure.legend(handles, labels, fontsize=8, ncols=len(labels), loc='lower center', bbox_to_anchor=(0.5, 0.016), frameon=False)
	figure.text(
		0.5,
		0.005,
		f'line: median, marks: worst; ● all statuses “contact”; ◇ another one that says what was done; ✕ no answer (docs/statuses.md), or refused. Errors below {least:g} are drawn there.',
		ha='center',
		fontsize=8,
	)
	save(figure, path, bottom=0.035)


def _curve(plot, samples, values, name, kind, color):
	positions, medians, worsts, marks = [], [], [], []
	for position, value in enumerate(values):
		here = [s for s in samples if s.value == value]
		errors = [max(getattr(s, name), least) for s in here if not s.refused and (s.compared or name == 'infeasibilityError')]
		if not errors:
			continue
		statuses = {s.status for s in here}
		positions.append(position)
		medians.append(statistics.median(errors))
		worsts.append(max(errors))
		marks.append('x' if statuses & set(failed) else 'o' if statuses <= {'contact', 'separated'} else 'D')
	plot.plot(positions, medians, lw=1.1, color=color, label=kind)
	for mark in 'oDx':
		chosen = [k for k, m in enumerate(marks) if m == mark]
		filling = {} if mark == 'x' else {'mfc': 'white' if mark == 'D' else color}
		plot.plot([positions[k] for k in chosen], [worsts[k] for k in chosen], mark, color=color, ms=5, ls='', **filling)


def _statuses(plot, samples, values):
	names = [*statusColors, *failed]
	counts = [collections.Counter(s.status for s in samples if s.value == value) for value in values]
	bottom = [0.0] * len(values)
	for name in names:
		shares = [count[name] / max(sum(count.values()), 1) for count in counts]
		if not any(shares):
			continue
		plot.bar(range(len(values)), shares, bottom=bottom, width=0.9, color=statusColors.get(name, failedColor), label=name)
		bottom = [b + s for b, s in zip(bottom, shares, strict=True)]
	plot.set_ylim(0, 1)
	plot.legend(fontsize=7, ncols=4, loc='lower center', bbox_to_anchor=(0.5, 1.0), frameon=False)


def save(figure, path, bottom=0.0):
	figure.tight_layout(rect=(0, bottom, 1, 1))
	figure.savefig(path)
