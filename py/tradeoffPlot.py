# SPDX-License-Identifier: GPL-2.0-or-later
"""The Pareto plot of polytope.tradeoff: error over cost."""

from matplotlib.figure import Figure

__all__ = ['plotTradeoff']

frontColor, otherColor, firstColor = '#c8451b', '#3380a8', '#1c2430'
sameSpot = (0.06, 0.03)
"""Points nearer than this in x and in y, over the plot's size, share one label."""


def plotTradeoff(path, panels, floor=1e-17, suptitle=''):
	"""Writes a PNG with one plot beside the other; points are numbered, and named beside the plot.

	:param panels: [(title, TradeoffTable)]
	:param float floor: errors below it, and 0, are drawn there
	"""
	figure = Figure(figsize=(9.6 * len(panels), 5.8), layout='constrained')
	for axes, (title, table) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
		_draw(axes, table, floor)
		axes.set_title(title, fontsize=10, loc='left')
	figure.suptitle(suptitle)
	figure.savefig(path, dpi=130)


def _draw(axes, table, floor):
	rows = [row for row in table.rows if row.error is not None and row.cost is not None]
	if not rows:
		axes.text(0.5, 0.5, 'nothing was measured', transform=axes.transAxes, ha='center')
		return
	first, front = table.rows[0].name, [row for row in table.front() if row in rows]
	points = [(row.cost, max(row.error, floor)) for row in rows]
	axes.set(xscale='log', yscale='log', xlabel='time for the first setting\'s time step [µs]', ylabel='error of the answer')
	for values, limit in zip(zip(*points, strict=True), (axes.set_xlim, axes.set_ylim), strict=True):
		room = max(max(values) / min(values), 3) ** 0.07
		limit(min(values) / room, max(values) * room)
	corners = [points[rows.index(row)] for row in front]
	ends = [(corners[0][0], axes.get_ylim()[1]), *corners, (axes.get_xlim()[1], corners[-1][1])]
	axes.step(*zip(*ends, strict=True), where='post', color=frontColor, linewidth=1.1, alpha=0.7, zorder=1)
	for row, point in zip(rows, points, strict=True):
		color = firstColor if row.name == first else frontColor if row in front else otherColor
		axes.plot(*point, 's' if row.name == first else 'o', color=color, markersize=6 if row.name == first else 5, zorder=2)
	toAxes = axes.transScale + axes.transLimits
	_number(axes, [toAxes.transform(point) for point in points])
	for k, row in enumerate(rows):
		weight = 'bold' if row.name == first else 'normal'
		color = frontColor if row in front else '0.25'
		axes.text(1.02, 0.99 - 0.042 * k, f'{k + 1:2}  {row.name}', transform=axes.transAxes, fontsize=8.5, va='top', color=color, weight=weight)
	missing = [row.name for row in table.rows if row not in rows]
	if missing:
		listed = 'no answer:\n' + '\n'.join(missing)
		axes.text(1.02, 0.99 - 0.042 * (len(rows) + 1), listed, transform=axes.transAxes, fontsize=8, va='top', color='0.55')
	if any(row.error < floor for row in rows):
		axes.axhline(floor, color='0.7', linewidth=0.8, linestyle=':')
		axes.text(0.01, floor, 'no error', transform=axes.get_yaxis_transform(), va='bottom', fontsize=8, color='0.4')
	axes.grid(True, which='major', color='0.92')
	axes.set_axisbelow(True)


def _number(axes, places):
	"""Numbers beside the points; those of one spot together."""
	groups = []
	for k, place in enumerate(places):
		near = next((group for group in groups if all(abs(group[0] - place) < sameSpot)), None)
		if near is None:
			groups.append((place, [k + 1]))
		else:
			near[1].append(k + 1)
	for (x, y), numbers in groups:
		text = ', '.join(map(str, numbers))
		axes.annotate(text, (x, y), (5, 4), xycoords='axes fraction', textcoords='offset points', fontsize=8.5, zorder=3)
