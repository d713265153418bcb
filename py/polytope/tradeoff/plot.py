# SPDX-License-Identifier: GPL-2.0-or-later
"""The Pareto plot of polytope.tradeoff: error over cost."""

import math

import numpy as np
from matplotlib.figure import Figure

from ..precision import isNumber

__all__ = ['plotTradeoff']

frontColor, otherColor, firstColor = '#c8451b', '#3380a8', '#1c2430'
digitSize = (6.5, 9.5)
"""Width of a digit and height of a number beside a point [pt]."""
clear = 5
"""Room around a point that numbers keep free, where they can [pt]."""
leastSpan = 12
"""Of an axis, end over beginning: more than a decade, so that it has at least one labelled tick."""


def plotTradeoff(path, panels, floor=1e-17, suptitle=''):
	"""Writes a PNG with one plot beside the other; points are numbered, and named beside the plot.

	:param panels: [(title, TradeoffTable)]
	:param float floor: errors below it, and 0, are drawn there
	"""
	if not (isNumber(floor) and 0 < floor < math.inf):
		raise ValueError(f'floor: must be a number above 0, got {floor!r}')
	figure = Figure(figsize=(9.6 * len(panels), 5.8), layout='constrained')
	for axes, (title, table) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
		_draw(axes, table, floor)
		axes.set_title(title, fontsize=10, loc='left')
	figure.suptitle(suptitle)
	figure.savefig(path, dpi=130)


def _draw(axes, table, floor):
	rows = [row for row in table.rows if row.counts]
	if not rows:
		axes.text(0.5, 0.5, table.remark or 'nothing was measured', transform=axes.transAxes, ha='center')
		return
	first, front = table.rows[0].name, [row for row in table.front() if row in rows]
	points = [(row.cost, max(row.error, floor)) for row in rows]
	axes.set(xscale='log', yscale='log', xlabel='time for the first setting\'s time step [µs]', ylabel='error of the answer')
	for values, limit in zip(zip(*points, strict=True), (axes.set_xlim, axes.set_ylim), strict=True):
		span = max(values) / min(values)
		room = max(span**0.07, (leastSpan / span) ** 0.5)
		limit(min(values) / room, max(values) * room)
	corners = [points[rows.index(row)] for row in front]
	ends = [(corners[0][0], axes.get_ylim()[1]), *corners, (axes.get_xlim()[1], corners[-1][1])]
	axes.step(*zip(*ends, strict=True), where='post', color=frontColor, linewidth=1.1, alpha=0.7, zorder=1)
	for row, point in zip(rows, points, strict=True):
		color = firstColor if row.name == first else frontColor if row in front else otherColor
		axes.plot(*point, 's' if row.name == first else 'o', color=color, markersize=6 if row.name == first else 5, zorder=2)
	_number(axes, points)
	for k, row in enumerate(rows):
		weight = 'bold' if row.name == first else 'normal'
		color = frontColor if row in front else '0.25'
		axes.text(1.02, 0.99 - 0.042 * k, f'{k + 1:2}  {row.name}', transform=axes.transAxes, fontsize=8.5, va='top', color=color, weight=weight)
	missing = [row.name for row in table.rows if row not in rows]
	if missing:
		listed = 'no answer that counts:\n' + '\n'.join(missing)
		axes.text(1.02, 0.99 - 0.042 * (len(rows) + 1), listed, transform=axes.transAxes, fontsize=8, va='top', color='0.55')
	if any(row.error < floor for row in rows):
		axes.axhline(floor, color='0.7', linewidth=0.8, linestyle=':')
		axes.text(0.01, floor, 'no error', transform=axes.get_yaxis_transform(), va='bottom', fontsize=8, color='0.4')
	axes.grid(True, which='major', color='0.92')
	axes.set_axisbelow(True)


def _number(axes, points):
	"""Beside each point its number, at the nearest place where it covers neither points nor other numbers; a line leads to one further off."""
	axes.figure.draw_without_rendering()  # places of points are known from here on
	places = axes.transData.transform(points) * 72 / axes.figure.dpi
	taken = [(x - clear / 2, y - clear / 2, x + clear / 2, y + clear / 2) for x, y in places]
	frame = axes.get_window_extent().extents * 72 / axes.figure.dpi
	for k, (place, point) in enumerate(zip(places, points, strict=True)):
		size = np.array([digitSize[0] * len(str(k + 1)), digitSize[1]])

		def cost(offset, size=size, place=place):
			others = np.linalg.norm(places - place - offset, axis=1).min() < 0.99 * math.hypot(*offset)  # it would seem another point's
			return _covered([*(place + offset - size / 2), *(place + offset + size / 2)], taken, frame) + others * size.prod()

		offset = min(_offsets(size), key=cost)
		taken.append((*(place + offset - size / 2), *(place + offset + size / 2)))
		far = cost(offset) > 0 or math.hypot(*offset) > 0.5 * max(size) + 2 * clear
		line = {'arrowstyle': '-', 'color': '0.6', 'linewidth': 0.6, 'shrinkA': 0, 'shrinkB': 2} if far else None
		text = {'fontsize': 8.5, 'ha': 'center', 'va': 'center', 'zorder': 3}
		axes.annotate(str(k + 1), point, offset, textcoords='offset points', arrowprops=line, **text)


def _offsets(size):
	"""From a point to the middle of its number [pt], near ones first, up and right before down and left."""
	for ring in range(1, 7):
		for angle in (50, 90, 130, -50, -90, -130, 10, 170):
			yield np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))]) * (0.5 * max(size) + clear * (2 * ring - 1))


def _covered(box, taken, frame):
	"""Area of a box that is taken, or outside the frame."""
	inside = max(0, min(box[2], frame[2]) - max(box[0], frame[0])) * max(0, min(box[3], frame[3]) - max(box[1], frame[1]))
	over = sum(max(0, min(box[2], x) - max(box[0], left)) * max(0, min(box[3], y) - max(box[1], low)) for left, low, x, y in taken)
	return over + (box[2] - box[0]) * (box[3] - box[1]) - inside
