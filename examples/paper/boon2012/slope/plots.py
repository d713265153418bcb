# SPDX-License-Identifier: GPL-2.0-or-later
"""Plots and pictures of simulation E."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.patches import Polygon
from yade.polytope.pictures.still import picture

from ..reporting.figures import saveFigure
from .theory import centroid

__all__ = ['drawBlocks', 'plotMechanism', 'sideBySide']


def drawBlocks(path, scene, **settings):
	"""The blocks as they stand; *settings* as of picture()."""
	corners = np.concatenate([np.array(points, float) for points in scene.free])
	low, high = corners.min(axis=0) - (2.5, 1.2), corners.max(axis=0) + (1.0, 0.6)
	frame = [(x, y, 0) for x in (low[0], high[0]) for y in (low[1], high[1])]
	picture(path, frame=frame, size=(1000, 800), **settings)


def sideBySide(path, parts):
	"""Pictures in a row, {path: title}."""
	figure = Figure(figsize=(6.3 * len(parts), 5.4))
	for axis, (part, title) in zip(figure.subplots(1, len(parts), squeeze=False)[0], parts.items(), strict=True):
		axis.imshow(imread(part))
		axis.set_title(title)
		axis.axis('off')
	saveFigure(path, figure)


def plotMechanism(path, slope, limit, motion, length=0.8):
	"""Velocities of the limit analysis beside the motion at failure, both enlarged to *length* [m]."""
	figure = Figure(figsize=(12, 5.4))
	axes = figure.subplots(1, 2, sharex=True, sharey=True)
	for axis, moves, title in zip(axes, (limit.velocities, motion), ('limit analysis', 'simulation, at failure'), strict=True):
		moves = moves * (length / max(np.linalg.norm(moves[:, :2], axis=1).max(), 1e-300))
		most = np.abs(moves[:, 2]).max()
		for corners in slope['fixed']:
			axis.add_patch(Polygon(corners, facecolor='#dbdbd7', edgecolor='none'))
		for corners, (x, y, turn) in zip(slope['free'], moves, strict=True):
			corners = np.array(corners)
			arms = corners - centroid(corners)[1]
			moved = corners + np.array([x, y]) + turn * np.column_stack([-arms[:, 1], arms[:, 0]])
			color = '#3380a8' if abs(turn) > 0.05 * most else '#f0e4ba'
			axis.add_patch(Polygon(corners, facecolor='none', edgecolor='#b0b0b0', lw=0.6))
			axis.add_patch(Polygon(moved, facecolor=color, edgecolor='#222222', lw=0.8, alpha=0.8))
		axis.set_title(f'{title}: motion enlarged to {length:g} m')
		axis.set_xlabel('x [m]')
		axis.set_aspect('equal')
	corners = np.concatenate([np.array(points) for points in slope['free']])
	axes[0].set_xlim(corners[:, 0].min() - 2, corners[:, 0].max() + 1)
	axes[0].set_ylim(corners[:, 1].min() - 1, corners[:, 1].max() + 1)
	axes[0].set_ylabel('y [m]')
	saveFigure(path, figure)
