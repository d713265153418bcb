# SPDX-License-Identifier: GPL-2.0-or-later
"""Plots of sceneExtremes.py: one for each axis, both contact models in it."""

import math

from extremePlots import save
from matplotlib.figure import Figure

__all__ = ['Line', 'plotScenes']

colors = {'surface': '#1d4e79', 'boon2012': '#c8451b'}
styles = ('o-', 's--', '^:', 'D-.')


class Line:
	"""A quantity along the axis: its size is drawn, nothing where it is 0."""

	def __init__(self, label, x, y, panel=0):
		self.label, self.x, self.y, self.panel = label, list(x), list(y), panel


def plotScenes(path, title, label, panels, lines, marks=()):
	"""Lines on logarithmic axes.

	:param panels: labels of the vertical axes, side by side
	:param dict lines: model → list of Line
	:param marks: (x, text) of vertical lines
	"""
	figure = Figure(figsize=(6.2 * len(panels), 4.6), dpi=110)
	plots = figure.subplots(1, len(panels), squeeze=False)[0]
	for model, own in lines.items():
		for panel, plot in enumerate(plots):
			for style, line in zip(styles, [line for line in own if line.panel == panel], strict=False):
				values = [abs(y) or math.nan for y in line.y]
				plot.plot(line.x, values, style, color=colors[model], ms=4, lw=1.2, label=f'{line.label} ({model})')
	for plot, name in zip(plots, panels, strict=True):
		for x, text in marks:
			plot.axvline(x, color='0.3', ls=':', lw=1.2)
			plot.text(x, 0.98, f' {text}', transform=plot.get_xaxis_transform(), fontsize=8, color='0.3', va='top')
		plot.set(xscale='log', yscale='log', xlabel=label, ylabel=name)
		plot.grid(True, lw=0.3, color='0.85')
		if plot.get_legend_handles_labels()[0]:
			plot.legend(fontsize=7)
	figure.suptitle(title)
	save(figure, path)
