# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings that `./run tradeoff` varies, one at a time, in each of its scenes, and the reference of each answer."""

import dataclasses
import math

import numpy as np
import tradeoffScenes as scenes
from boon2012.beam.theory import BeamBetweenWalls
from boon2012.slidingWedge.study import limitEquilibrium
from boon2012.wedges.theory import roofWedgeFrictionAngle
from yade.polytope import _builds

__all__ = ['Scene', 'allScenes', 'coarse', 'default', 'isNumerical', 'scatter']

default = 'default'
"""The scene as it is: the paper's contact (boon2012), whose point, solver and tolerance are varied."""

points = {'Chebyshev centre': {'contactPoint': 'chebyshevCentre'}, 'centroid': {'contactPoint': 'centroid'}}
models = {'spring': {'contactModel': 'spring'}}
tolerances = {
	'Newton tolerance 1e-2': {'newtonTolerance': 1e-2},
	'Newton tolerance 1e-6': {'newtonTolerance': 1e-6},
	'Newton tolerance 1e-14': {'newtonTolerance': 1e-14},
}
coarse = {name for name, changes in tolerances.items() if changes['newtonTolerance'] > 1e-10}
"""Tolerances that are not in effect where overlaps are deeper than 2e-4 of the size: the kernel takes the centre as far as a depth to 2e-14
of the size needs (tolerance::depth in src/numbers/Tolerances.hpp), whatever the setting says. They are run to show that."""
cold = {'cold start': {'warmStart': False}}
ipopt = {'Ipopt': {'solver': 'ipopt'}}
wide = {name: {'precision': name} for name in _builds.precisions if name != 'double'}
times = {f'time step × {factor:g}': {'timeStepFactor': factor} for factor in (0.25, 0.5, 2, 4)}
stiffnesses = {f'stiffness × {factor:g}': {'stiffness': factor} for factor in (0.1, 10)}
seeds = {f'seed {seed}': {'seed': seed} for seed in range(2, 7)}

numerical = {**tolerances, **cold, **ipopt, **wide}
"""These change how exactly the same model is computed, not the model."""
statics = {default: {}, **points, **models, **numerical}
dynamics = {**statics, **times, **stiffnesses}
longSteps = {'time step × 10': {'timeStepFactor': 10}}
"""Of the paper's 0.02 √(m/k)."""
tooSlow = {'C': ('mpfr150',), 'A': ('Ipopt', 'float128', 'mpfr150')}
"""Letter of the scene → settings that it is not run with."""


def isNumerical(name):
	return name == default or name in numerical


@dataclasses.dataclass
class Scene:
	"""One scene with its settings.

	:ivar str answer: what is measured
	:ivar truth: the closed form; None: there is none
	:ivar str because: where it comes from
	:ivar float timedSeconds: of polytope.tradeoff
	"""

	letter: str
	title: str
	build: object
	measure: object
	settings: dict
	answer: str
	truth: float = None
	because: str = ''
	timedSeconds: float = 0.3

	def chosen(self, quick):
		"""The settings of a full or a quick run: the quick one leaves out what takes long or shows nothing new."""
		if not quick:
			return self.settings
		left = {'Newton tolerance 1e-14', 'Newton tolerance 1e-6', 'time step × 0.25', 'seed 4', 'seed 5', 'seed 6'}
		left |= {'mpfr150'} if self.letter in 'CDFA' or self.letter == 'rest' else set()
		left |= {'Ipopt', 'longdouble', 'float128'} if self.letter in 'CDA' or self.letter == 'rest' else set()
		return {name: changes for name, changes in self.settings.items() if name not in left}

	def numericalReference(self, settings):
		"""Name of the setting with the finest arithmetic among those that were run; None if there is none but double."""
		there = [name for name in wide if name in settings and _builds.available(name)]
		return there[-1] if there else None


def allScenes():
	"""letter → Scene."""
	return {scene.letter: scene for scene in (*_statics(), *_wedges(), *_dynamics())}


def _statics():
	"""Scenes whose answer does not depend on the time step."""
	return (
		Scene('pair', 'Overlapping pairs', scenes.buildPairs, scenes.measurePairs, statics, 'forces of 60 contacts'),
		Scene(
			'B',
			'Three-hinged beam',
			scenes.buildBeam,
			scenes.measureBeam,
			statics,
			'peak load',
			BeamBetweenWalls().peak()[0],
			'Appendix A of Boon et al. (2012), whose forces act at the centroid of the overlap',
		),
	)


def _wedges():
	"""Scenes whose answer is the friction angle at which a wedge begins to move."""
	wedge = limitEquilibrium(scenes.BlockGeometry.read(scenes.geometry('c_sliding_wedge.json')))
	return (
		Scene(
			'C',
			'Sliding wedge',
			scenes.buildSlidingWedge,
			scenes.measureSlidingWedge,
			_without(dynamics, 'C'),
			'critical friction angle',
			math.degrees(wedge.frictionAngle()),
			'limit equilibrium (Hoek & Bray 1981)',
		),
		Scene(
			'D',
			'Roof wedge',
			scenes.buildRoofWedge,
			scenes.measureRoofWedge,
			dynamics,
			'critical friction angle',
			_roofAngle(),
			'φ = α + atan(W/ΣH)',
		),
	)


def _dynamics():
	"""Scenes of bodies that collide and come to rest."""
	return (
		Scene(
			'F',
			'Collisions without loss',
			scenes.buildCollision,
			scenes.measureCollision,
			{**dynamics, **longSteps},
			'energy after four collisions over that of the fall',
			1.0,
			'it is conserved',
			timedSeconds=0,  # afterwards the blocks are apart
		),
		Scene(
			'rest',
			'Cube at rest (F1)',
			scenes.buildRest,
			scenes.measureRest,
			{**dynamics, **longSteps},
			'height at rest + m g/kₙ',
			0.5,
			'½ edge − m g/kₙ',
		),
		Scene('A', 'Heap of 96 solids', scenes.buildHeap, scenes.measureHeap, {**_without(dynamics, 'A'), **seeds}, 'coordination number'),
	)


def _without(settings, letter):
	return {name: changes for name, changes in settings.items() if name not in tooSlow[letter]}


def _roofAngle():
	"""[°], of the geometry file with the scene's own stress, density and gravity."""
	scene = scenes.buildRoofWedge()
	horizontal = scene.horizontalStress * sum(joint.area for joint in scene.joints) * math.cos(scene.inclinations[0])
	angle = math.degrees(roofWedgeFrictionAngle(scene.weight, horizontal, scene.inclinations[0]))
	scenes.O.reset()
	return angle


def scatter(table):
	"""(mean, standard deviation) of the answer over default and seeds."""
	values = [float(row.answer) for row in table.rows if row.answer is not None and (row.name == default or row.name in seeds)]
	return float(np.mean(values)), float(np.std(values, ddof=1)) if len(values) > 1 else math.nan
