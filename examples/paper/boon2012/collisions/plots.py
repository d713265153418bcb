# SPDX-License-Identifier: GPL-2.0-or-later
"""Plots and pictures of simulation F."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.image import imread
from yade import Quaternion
from yade.polytope.motionRecord import noContact
from yade.polytope.pictures.still import picture

from ..reporting.figures import saveFigure

__all__ = ['drawSequence', 'plotOverview']

typeColors = {
	noContact: '#f2f2f2',
	'vertex-vertex': '#7a1f1f',
	'vertex-edge': '#c8451b',
	'vertex-face': '#f2a541',
	'edge-edge': '#8d6bb0',
	'edge-face': '#86bcbb',
	'face-face': '#3380a8',
}
axisColors = ('#1d4e79', '#c8451b', '#222222')
views = {'vertexFace': (-0.8, -1, 0.5), 'edgeEdge': (1, 0.35, 0.3)}


def drawSequence(path, run, panels=6):
	"""The paper's Figs 12 and 13: start, first appearance of each type, end, and the middle of the longest gaps."""
	record, steps = run.record, _pictureSteps(run, panels)
	low, high = record.position[steps].min(axis=0) - 0.75, record.position[steps].max(axis=0) + 0.75
	if run.name == 'vertexFace':
		low[2] = 0
	else:
		low, high = np.minimum(low, -0.7), np.maximum(high, 0.7)
	frame = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
	figure = Figure(figsize=(4 * (panels // 2), 8.4))
	state = run.scene.body.state
	for k, (step, axis) in enumerate(zip(steps, figure.subplots(2, panels // 2).flat, strict=True)):
		w, x, y, z = record.orientation[step]
		state.pos, state.ori = record.position[step], Quaternion(w, x, y, z)
		part = path.with_name(f'{path.stem}_{k + 1}.png')
		picture(part, fixed='solid', frame=frame, view=views[run.name], size=(760, 720))
		axis.imshow(imread(part))
		axis.set_title(f'({"abcdefgh"[k]})  {record.time[step]:.3f} s: {_shown(record.type[step])}')
		axis.axis('off')
	saveFigure(path, figure)


def _pictureSteps(run, panels):
	record = run.record
	steps = {0, len(record.time) - 1}
	for kind, time in run.firstTimes().items():
		if len(steps) < panels and np.count_nonzero(record.type == kind) > 50:
			steps.add(int(round(time / record.timeStep)))
	while len(steps) < panels:
		ordered = sorted(steps)
		gap = max(range(len(ordered) - 1), key=lambda k: ordered[k + 1] - ordered[k])
		steps.add((ordered[gap] + ordered[gap + 1]) // 2)
	return sorted(steps)


def plotOverview(path, run):
	"""Type, centre, force, depth, and the terms of the energy balance, over time."""
	record = run.record
	figure = Figure(figsize=(10, 13))
	centre, force, depth, energy, taken = axes = figure.subplots(5, 1, sharex=True)
	for axis in axes:
		_shadeTypes(axis, run, labelled=axis is centre)
	for values, name, color in zip(record.position.T, 'xyz', axisColors, strict=True):
		centre.plot(record.time, values, label=name, color=color)
	centre.legend(loc='upper center', bbox_to_anchor=(0.5, 1.3), ncol=9, frameon=False, columnspacing=1)
	centre.set_ylabel('centre [m]')
	force.semilogy(record.time, 1e-3 * np.maximum(np.linalg.norm(record.contactForce, axis=1), 1e-1), color='#222222', lw=0.8)
	force.set_ylabel('contact force [kN]')
	depth.plot(record.time, 1e3 * record.depth, color='#222222')
	depth.set_ylabel('depth [mm]')
	energy.plot(record.time, 1e-3 * record.energy(), color='#222222', label='kinetic + potential + elastic')
	motion = record.kineticEnergy() + record.potentialEnergy()
	energy.plot(record.time, 1e-3 * motion, color='#c8451b', ls='--', label='kinetic + potential')
	energy.set_ylabel('energy [kJ]')
	curves = {
		'contact: dampers and friction': (record.contactLoss(), '#1d4e79'),
		"YADE's damping": (record.dampingLoss(), '#86bcbb'),
		'made by the normal spring': (record.made(), '#c8451b'),
		'elastic': (record.elasticEnergy(), '#222222'),
	}
	for label, (values, color) in curves.items():
		taken.plot(record.time, 1e-3 * values, label=label, color=color)
	taken.set_ylabel('taken so far [kJ]')
	taken.set_xlabel('time [s]')
	for axis in (energy, taken):
		axis.legend(frameon=False)
	saveFigure(path, figure)


def _shown(kind):
	return 'no contact' if kind == noContact else kind.replace('-', '–')


def _shadeTypes(axis, run, labelled):
	seen = set()
	for begin, end, kind in run.phases():
		label = _shown(kind) if labelled and kind not in seen else None
		stretch = run.record.time[begin], run.record.time[end - 1] + run.record.timeStep
		axis.axvspan(*stretch, color=typeColors[kind], alpha=0.45, lw=0, label=label)
		seen.add(kind)
	axis.set_xlim(run.record.time[0], run.record.time[-1])
