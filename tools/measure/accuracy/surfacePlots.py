# SPDX-License-Identifier: GPL-2.0-or-later
"""Plot of surfaces.py: bodies' loss of speed on each floor."""

from extremePlots import save
from matplotlib.figure import Figure

__all__ = ['plotCrossings']

colors = {'surface': '#1d4e79', 'boon2012': '#c8451b'}
marks = 'osD^v<>P*X'
least = 1e-7
"""Losses below are drawn here."""


def plotCrossings(path, cases, limit):
	"""Loss of speed by floor, a panel for each stiffness rule, a colour for each contact, a mark for each body.

	:param cases: list of surfaceTables.Case
	:param float limit: drawn as a line
	"""
	floors, names, bodies = (list(dict.fromkeys(getattr(c, key) for c in cases)) for key in ('floor', 'contact', 'body'))
	rules = list(dict.fromkeys(c.rule for c in cases))
	figure = Figure(figsize=(6.4 * len(rules), 5), dpi=110)
	for plot, rule in zip(figure.subplots(1, len(rules), sharey=True, squeeze=False)[0], rules, strict=True):
		for c in cases:
			if c.rule == rule:
				k, own = names.index(c.contact), 'k' if c.body == 'sphere' else colors[c.contact]
				x = floors.index(c.floor) + 0.25 * (k - (len(names) - 1) / 2) + 0.025 * (bodies.index(c.body) - len(bodies) / 2)
				plot.plot(x, max(least, abs(1 - c.crossing.kept)), marks[bodies.index(c.body) % len(marks)], color=own, ms=5, alpha=0.8)
		plot.axhline(limit, color='0.3', ls=':', lw=1.2)
		plot.set(yscale='log', title=rule, ylim=(least / 2, 5))
		plot.set_xticks(range(len(floors)), floors, rotation=45)
		plot.grid(True, axis='y', lw=0.3, color='0.85')
	plot.figure.axes[0].set_ylabel('loss of speed over three joints')
	handles = [plot.plot([], [], 'o', color=colors[name], label=name)[0] for name in names]
	handles += [plot.plot([], [], marks[k % len(marks)], color='k' if b == 'sphere' else '0.6', label=b)[0] for k, b in enumerate(bodies)]
	figure.legend(handles=handles, fontsize=8, ncols=6, loc='lower center', frameon=False)
	save(figure, path, bottom=0.12)
