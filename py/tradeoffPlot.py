# SPDX-License-Identifier: GPL-2.0-or-later
"""The Pareto plot of polytope.tradeoff: error over cost."""

from matplotlib.figure import Figure

__all__ = ['plotTradeoff']

frontColor, otherColor, firstColor = '#c8451b', '#3380a8', '#1c2430'
leastGap = 0.035
"""Between two labels' lines, over the plot's height."""


def plotTradeoff(path, panels, floor=1e-17, suptitle=''):
	"""Writes a PNG with one plot beside the other.

	:param panels: [(title, TradeoffTable)]
	:param float floor: errors below it, and 0, are drawn there
	"""
	figure = Figure(figsize=(8.2 * len(panels), 6.2), layout='constrained')
	for axes, (title, table) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
		_draw(axes, table, floor)
		axes.set_title(title, fontsize=10)
	figure.suptitle(suptitle)
	figure.savefig(path, dpi=130)


def _draw(axes, table, floor):
	rows = [row for row in table.rows if row.error is not None and row.cost is not None]
	if not rows:
		axes.text(0.5, 0.5, 'nothing was measured', transform=axes.transAxes, ha='center')
		return
	front = table.front()
	points = {row.name: (row.cost, max(row.error, floor)) for row in rows}
	axes.set(xscale='log', yscale='log', xlabel='time for the first setting\'s time step [µs]', ylabel='error of the answer')
	costs, errors = zip(*points.values(), strict=True)
	span = max(costs) / min(costs)
	axes.set_xlim(min(costs) / max(span, 2) ** 0.06, max(costs) * max(span, 2) ** 0.42)  # room for the labels
	span = max(errors) / min(errors)
	axes.set_ylim(min(errors) / max(span, 10) ** 0.07, max(errors) * max(span, 10) ** 0.07)
	corners = [points[row.name] for row in front]
	axes.step([x for x, _ in corners], [y for _, y in corners], where='post', color=frontColor, linewidth=1.2, zorder=1, label='front')
	first = table.rows[0].name
	for row in rows:
		color = frontColor if row in front else otherColor
		axes.plot(*points[row.name], 's' if row.name == first else 'o', color=firstColor if row.name == first else color, markersize=5)
	_label(axes, points, {row.name for row in front})
	if any(row.error < floor for row in rows):
		axes.axhline(floor, color='0.7', linewidth=0.8, linestyle=':')
		axes.text(0.01, floor, ' 0', transform=axes.get_yaxis_transform(), va='bottom', fontsize=7, color='0.4')
	axes.grid(True, which='major', color='0.92')
	axes.set_axisbelow(True)


def _label(axes, points, onFront):
	"""Names beside the points, moved up and down until none covers another."""
	toAxes = axes.transScale + axes.transLimits
	places = {name: toAxes.transform(point) for name, point in points.items()}
	taken = []
	for name, (x, y) in sorted(places.items(), key=lambda item: (item[1][1], item[1][0])):
		where = y
		while any(abs(where - other) < leastGap and abs(x - left) < 0.3 for left, other in taken):
			where += leastGap / 4
		taken.append((x, where))
		axes.annotate(
			name,
			(x, y),
			(x + 0.02, where),
			xycoords='axes fraction',
			textcoords='axes fraction',
			fontsize=7.5,
			va='center',
			color=frontColor if name in onFront else '0.25',
			arrowprops={'arrowstyle': '-', 'color': '0.75', 'linewidth': 0.6, 'shrinkA': 0, 'shrinkB': 2} if where - y > leastGap / 2 else None,
		)
