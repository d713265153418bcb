# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of simulation B: the load-rotation curves (Fig. 8 of the paper), the beam and its overlaps."""

import math

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from yade import O

from ..reporting.figures import saveFigure
from .study import contactPointNames, solverNames

__all__ = ['drawBeam', 'plotCurves']

colors = {'centroid': '#1d4e79', 'analyticCentre': '#c8451b', 'chebyshevCentre': '#5d8a3a', 'spring': '#7a4fa3'}
ipoptColor = '#3a8f6b'


def plotCurves(path, closed, curves, pushes, last):
	"""Fig. 8: load against rotation, and against the drop at midspan.

	:param closed: BeamBetweenWalls
	:param dict curves: (contact point, solver) → BeamCurve
	:param dict pushes: contact point → BeamReadings at rest under imposed load
	:param float last: rotation at which the closed form's curve ends [rad]
	"""
	figure = Figure(figsize=(8.5, 5.6), dpi=150)
	plot = figure.subplots()
	fine, end = np.linspace(0, last, 400), math.degrees(closed.alignment)
	plot.plot(np.degrees(fine), closed.load(fine) / 1e3, color='black', lw=1.2, label='closed form (Appendix A)')
	plot.plot(np.degrees(fine), closed.load(fine, trueArm=True) / 1e3, color='0.5', lw=1, ls='--', label='closed form, true arm')
	for (point, solver), curve in curves.items():
		label = contactPointNames[point] + (f', {solverNames[solver]}' if point == 'analyticCentre' else '') + ', rotation imposed'
		look = (
			{'marker': 's', 'ms': 7, 'mfc': 'none', 'ls': '', 'color': ipoptColor}
			if solver == 'ipopt'
			else {'marker': 'o', 'ms': 3.5, 'lw': 1, 'ls': '' if point == 'centroid' else '-', 'color': colors[point]}
		)
		plot.plot(*_line(curve.readings[:: max(1, len(curve.readings) // 30)]), label=label, **look)
	for point, readings in pushes.items():
		plot.plot(*_line(readings), 'x', ms=7, color=colors[point], label=f'{contactPointNames[point]}, load imposed')
		(rotation,), (load,) = _line(readings[-1:])
		arrow = {'arrowstyle': '->', 'color': colors[point], 'lw': 1.2}
		plot.annotate('', (rotation + 2.2, load), (rotation + 0.3, load), arrowprops=arrow)
	plot.axvline(end, color='0.3', ls=':', lw=1.4)
	plot.text(end - 0.15, 1, 'Goodman: hinges in one line', rotation=90, ha='right', va='bottom', fontsize=8, color='0.3')
	plot.axhline(0, color='0.7', lw=0.6)
	plot.set(xlabel='rotation of the half-beams (°)', ylabel='load W (kN)', xlim=(0, 1.04 * end))
	ticks = np.arange(0, 1e3 * closed.drop(closed.alignment) + 1, 5)
	turned = np.linspace(0, 1.1 * closed.alignment, 500)
	top = plot.twiny()
	top.set(xlim=plot.get_xlim(), xlabel='drop at midspan (mm)')
	top.set_xticks(np.interp(ticks, 1e3 * closed.drop(turned), np.degrees(turned)), [f'{tick:g}' for tick in ticks])
	plot.legend(fontsize=8, loc='lower center', bbox_to_anchor=(0.44, 0.02))
	saveFigure(path, figure)


def drawBeam(path, study, contactPoints, first, last):
	"""The beam at three rotations with its line of thrust, and both overlaps at the peak from near.

	:param study: BeamStudy
	:param contactPoints: the last one's peak is drawn; all are shown in the overlaps
	:param first, last: rotations before and after [rad]
	"""
	panels = [['a', 'a'], ['b', 'b'], ['c', 'c'], ['d', 'e']]
	figure = Figure(figsize=(8, 10.5), dpi=150)
	plots = figure.subplot_mosaic(panels, height_ratios=[1, 1, 1, 1.6])
	scene = study.scene(contactPoint=contactPoints[-1])
	peak = scene.peak().rotation
	reach, height = scene.length + 0.6 * scene.abutmentLength, scene.height
	for name, rotation in zip('abc', (first, peak, last), strict=True):
		reading, plot = scene.balance(rotation), plots[name]
		_drawBodies(plot, scene)
		hinge, middle = (contact.geom.contactPoint for contact in scene.contacts())
		plot.plot([hinge[0], middle[0], -hinge[0]], [hinge[1], middle[1], hinge[1]], 'o-', color=colors[contactPoints[-1]], ms=3, lw=1)
		plot.set(xlim=(-reach, reach), ylim=(-0.85 * height, 1.4 * height), aspect='equal')
		forces = f'load {reading.load / 1e3:.2f} kN, thrust {reading.thrust / 1e3:.1f} kN'
		plot.set_title(f'{contactPointNames[contactPoints[-1]]}, {math.degrees(rotation):.2f}°: {forces}', fontsize=9)
		plot.axis('off')
	window = 2.2e3 * study.appendixA.shortening(peak)
	for name, k, title in (('d', 0, 'at the abutment'), ('e', 1, 'at midspan')):
		plot = plots[name]
		for point in contactPoints:
			scene = study.scene(contactPoint=point)
			scene.balance(peak)
			geometry = scene.contacts()[k].geom
			center = [1e3 * geometry.contactPoint[axis] for axis in (0, 1)]
			label = f'{contactPointNames[point]}, chord {1e3 * geometry.penetrationDepth:.3f} mm'
			plot.plot(*([x] for x in center), 'o', color=colors[point], ms=6, label=label)
		_drawBodies(plot, scene, scale=1e3, alpha=0.45)
		plot.set(xlabel='x (mm)', ylabel='y (mm)')
		plot.set(xlim=(center[0] - window, center[0] + window), ylim=(center[1] - 2.4 * window, center[1] + 2.4 * window))
		plot.set_title(f'{title}, {math.degrees(peak):.2f}°', fontsize=9)
		plot.legend(fontsize=7, loc='lower left')
	saveFigure(path, figure)


def _line(readings):
	return [math.degrees(reading.rotation) for reading in readings], [reading.load / 1e3 for reading in readings]


def _drawBodies(plot, scene, scale=1, alpha=1.0):
	for k in scene.abutmentIds + scene.beamIds:
		state, shape = O.bodies[k].state, O.bodies[k].shape
		corners = sorted((vertex for vertex in shape.vertices if vertex[2] > 0), key=lambda vertex: math.atan2(vertex[1], vertex[0]))
		corners = [scale * (state.pos + state.ori * corner) for corner in corners]
		plot.add_patch(Polygon([(corner[0], corner[1]) for corner in corners], facecolor=shape.color, edgecolor='0.2', lw=0.8, alpha=alpha))
