# SPDX-License-Identifier: GPL-2.0-or-later
"""Plots of the study of collisions' energy."""

import numpy as np
from matplotlib.figure import Figure

__all__ = ['plotBounces', 'plotCorners', 'plotDamping', 'plotSteps']

styles = {
	"paper's model": ('#c8451b', '-'),
	"paper's model, corner radius 0": ('#f2a541', '-'),
	"paper's model, stiffness per area": ('#8d6bb0', '-'),
	'contact surface': ('#1d4e79', '-'),
	"YADE's PotentialBlock": ('#8d6bb0', ':'),
	"YADE's Polyhedra": ('#4c8c4a', ':'),
	"YADE's spheres": ('#222222', '--'),
}


def plotSteps(path, found):
	"""Median and largest error over the number of steps: found is {name: {steps: spread}}."""
	figure = Figure(figsize=(11, 5.4))
	for axis, key, title in zip(figure.subplots(1, 2, sharey=True), ('median', 'largest'), ('median', 'largest'), strict=True):
		for name, bySteps in found.items():
			color, line = styles[name]
			axis.loglog(list(bySteps), [s[key] for s in bySteps.values()], line, color=color, marker='o', ms=4, label=name)
		axis.set_xlabel('time steps in half a period of the contact')
		axis.set_title(f'{title} error of the energy, over that before')
		axis.grid(alpha=0.3, which='both', lw=0.5)
		ticks = sorted({steps for bySteps in found.values() for steps in bySteps})
		axis.set_xticks(ticks, [str(tick) for tick in ticks])
		axis.minorticks_off()
	figure.legend(*figure.axes[0].get_legend_handles_labels(), loc='lower center', ncol=4, frameon=False)
	figure.tight_layout(rect=(0, 0.12, 1, 1))
	figure.savefig(path, dpi=110)


def plotCorners(path, found):
	"""Error over the corner radius, a line for each overlap: found is {overlap: {corner: spread}}."""
	figure = Figure(figsize=(11, 4.5))
	for axis, key in zip(figure.subplots(1, 2), ('median', 'largest'), strict=True):
		for color, (overlap, byCorner) in zip(('#86bcbb', '#3380a8', '#1d4e79'), found.items(), strict=False):
			axis.plot(range(len(byCorner)), [s[key] for s in byCorner.values()], 'o-', color=color, label=f'overlap {100 * overlap:g} %')
			axis.set_xticks(range(len(byCorner)), [f'{corner:g}' for corner in byCorner])
		axis.set_yscale('log')
		axis.set_xlabel('corner radius over inscribed radius')
		axis.set_title(f"{key} error of the energy, paper's model")
		axis.grid(alpha=0.3, which='both', lw=0.5)
		axis.legend(frameon=False, fontsize=9)
	_save(figure, path)


def plotDamping(path, found, theory):
	"""Energy left over the contact's damping: found is {name: {damping: spread}}, theory a function of the damping."""
	figure = Figure(figsize=(4.2 * len(found), 4.5))
	for axis, (name, byDamping) in zip(figure.subplots(1, len(found), sharey=True, squeeze=False)[0], found.items(), strict=True):
		color, _ = styles[name]
		damping = np.array(list(byDamping))
		least, median, most = np.array([s['left'] for s in byDamping.values()]).T
		axis.fill_between(damping, least, most, color=color, alpha=0.25, lw=0, label='all collisions')
		axis.plot(damping, median, 'o-', color=color, ms=4, label='median')
		fine = np.linspace(0, damping[-1], 200)
		axis.plot(fine, [theory(z) for z in fine], '--', color='#222222', lw=1, label='central impact, linear spring')
		axis.axhline(1, color='#222222', lw=0.8)
		axis.set_title(name)
		axis.set_xlabel("contact's damping, fraction of critical")
		axis.grid(alpha=0.3, lw=0.5)
	figure.axes[0].set_ylabel('energy after the collision over that before')
	figure.axes[0].legend(frameon=False, fontsize=9)
	_save(figure, path)


def plotBounces(path, found):
	"""Energy of each bouncing body over time: found is {name: result of Bounces.run()}."""
	columns = 3
	rows = -(-len(found) // columns)
	figure = Figure(figsize=(13, 3.4 * rows))
	axes = figure.subplots(rows, columns, sharey=True, squeeze=False).flat
	ticks = (0.2, 0.5, 1, 2, 5, 10)
	for axis, (name, result) in zip(axes, found.items(), strict=False):
		color, _ = styles[name]
		energy = np.array(result['energy'])
		for one in energy.T:
			free = np.isfinite(one)
			axis.plot(np.array(result['time'])[free], one[free], color=color, lw=0.9, alpha=0.8)
		axis.axhline(1, color='#222222', lw=0.6)
		axis.set_yscale('log')
		axis.set_yticks(ticks, [f'{tick:g}' for tick in ticks])
		axis.minorticks_off()
		axis.set_title(f'{name} ({energy.shape[1]})')
		axis.grid(alpha=0.3, which='both', lw=0.5)
		axis.set_xlabel('time [s]')
	for axis in list(figure.axes)[len(found) :]:
		axis.set_visible(False)
	for axis in figure.axes[::columns]:
		axis.set_ylabel('energy over that at the start')
	_save(figure, path)


def _save(figure, path):
	figure.tight_layout()
	figure.savefig(path, dpi=110)
