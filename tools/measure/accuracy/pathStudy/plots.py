# SPDX-License-Identifier: GPL-2.0-or-later
"""Plots and pictures of the study of contact paths."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.image import imread
from yade import O
from yade.polytope.bodies.polytopes import cuboid
from yade.polytope.pictures.still import picture

from .path import forceUnit, quantities
from .scenes import fixedHalf, movingHalf

__all__ = ['drawPaths', 'plotHalving', 'plotPaths']

colors = {
	'foundation': '#2a9d8f',
	'analytic centre': '#c8451b',
	'Chebyshev centre': '#8d6bb0',
	'centroid': '#4c8c4a',
	'analytic centre, corner radius 0': '#f2a541',
	'spring': '#1d4e79',
}
lines = {'centroid': '--', 'analytic centre, corner radius 0': ':'}
labels = {'point': 'way of the contact point\n[edges]', 'normal': "normal's angle to its\nfirst [°]", 'force': 'force over the\nmean force'}


def plotPaths(path, scans):
	"""Way of the point from its first place, angle of the normal to its first, and force: scans is {path's name: Scan}."""
	figure = Figure(figsize=(3.4 * len(scans), 8))
	grid = figure.subplots(3, len(scans), squeeze=False, sharex='col')
	for axes, (name, found) in zip(grid.T, scans.items(), strict=True):
		way = np.concatenate([[0], np.cumsum(found.motion)])
		for variant, answers in found.answers.items():
			first = answers[0]
			angle = np.degrees(2 * np.arcsin(np.minimum(np.linalg.norm(answers[:, 1] - first[1], axis=1) / 2, 1)))
			values = np.linalg.norm(answers[:, 0] - first[0], axis=1), angle, np.linalg.norm(answers[:, 2], axis=1) / forceUnit(answers)
			for axis, value in zip(axes, values, strict=True):
				axis.plot(way, value, lines.get(variant, '-'), color=colors[variant], lw=1.1, label=variant)
				axis.grid(alpha=0.3, lw=0.5)
		axes[0].set_title(name.replace(', ', ',\n', 1) if len(name) > 24 else name, fontsize=10)
		axes[-1].set_xlabel('motion [edges]')
	for axis, quantity in zip(grid[:, 0], quantities, strict=True):
		axis.set_ylabel(labels[quantity])
	figure.legend(*grid[0, 0].get_legend_handles_labels(), loc='lower center', ncol=3, frameon=False)
	figure.tight_layout(rect=(0, 0.04, 1, 1))
	figure.savefig(path, dpi=110)


def plotHalving(path, worst):
	"""Change per motion as the step is halved, where it is largest: worst is {variant: {quantity: Zoom}}."""
	figure = Figure(figsize=(13, 4.8))
	units = {'point': 'edges per edge', 'normal': 'rad per edge', 'force': 'mean force per edge'}
	for axis, quantity in zip(figure.subplots(1, 3), quantities, strict=True):
		for variant, zooms in worst.items():
			one = zooms[quantity]
			axis.loglog(one.motion, one.rate, lines.get(variant, '-'), color=colors[variant], marker='.', ms=4, label=variant)
		axis.set_xlabel('motion in the step [edges]')
		axis.set_title(f'{quantity}: change per motion [{units[quantity]}]', fontsize=10)
		axis.grid(alpha=0.3, lw=0.5)
		axis.invert_xaxis()
	figure.legend(*figure.axes[0].get_legend_handles_labels(), loc='lower center', ncol=3, frameon=False)
	figure.tight_layout(rect=(0, 0.06, 1, 1))
	figure.savefig(path, dpi=110)


def drawPaths(path, scans, places=4):
	"""Where the moving cube is at the start, at the end and between, dark to light."""
	columns = 3
	rows = -(-len(scans) // columns)
	figure = Figure(figsize=(4 * columns, 3.6 * rows))
	for axis, (k, (name, found)) in zip(figure.subplots(rows, columns).flat, enumerate(scans.items()), strict=True):
		O.reset()
		O.bodies.append(cuboid((0, 0, 0), 3 * (fixedHalf,), fixed=True, color=(0.86, 0.86, 0.84)))
		for place in range(places):
			share = place / (places - 1)
			position, orientation = found.poses[round(share * (len(found.poses) - 1))]
			color = [(1 - share) * a + share * b for a, b in zip((0.11, 0.31, 0.47), (0.95, 0.75, 0.45), strict=True)]
			O.bodies.append(cuboid(position, 3 * (movingHalf,), orientation, color=color))
		frame = [(x, y, z) for x in (-1.9, 1.9) for y in (-1.9, 1.9) for z in (-1.9, 2.2)] if k == len(scans) - 1 else None
		part = path.with_name(f'{path.stem}_{k + 1}.png')
		picture(part, fixed='solid', frame=frame, view=(0.45, -1, 0.5), size=(640, 540))
		axis.imshow(imread(part))
		axis.set_title(name, fontsize=10)
		axis.axis('off')
	O.reset()
	figure.tight_layout()
	figure.savefig(path, dpi=110)
