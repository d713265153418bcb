# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a setting of polytope.tradeoff() is in effect: applied to the scene after build(), looked up again after measure()."""

import math

from yade import O

from ..scene.present import geometryFunctors

__all__ = ['Effect', 'settable']

settable = ('contactModel', 'contactPoint', 'solver', 'warmStart', 'tolerance', 'newtonTolerance', 'computeArea', 'timing')
"""Attributes of the contact functor that a setting may change."""
closest = 1e-9
"""Relative difference of two numbers that are the same: files of scenes may hold fewer digits."""


class Effect:
	"""Attributes of the contact functors and the time step, set when this is made; the simulation must not be running."""

	def __init__(self, changes):
		"""
		:param dict changes: those of a setting that are not the scene's own arguments
		:raises ValueError: if there is no functor that could take an attribute
		"""
		functors, self.attributes, self.timeStep = geometryFunctors(), {}, None
		named = [name for name in settable if name in changes]
		if named and not functors:
			raise ValueError(
				f'build: left no contact functor of polytopes, which {", ".join(named)} would be set in; '
				'make the engines in build(), with Ig2_Polytope_Polytope_PolytopeGeom in the InteractionLoop'
			)
		for name in named:
			for functor in functors:
				setattr(functor, name, changes[name])
			self.attributes[name] = getattr(functors[0], name)
		if 'timeStep' in changes:
			O.dt = changes['timeStep']
		if 'timeStepFactor' in changes:
			O.dt *= changes['timeStepFactor']
		if 'timeStep' in changes or changes.get('timeStepFactor', 1) != 1:  # a factor of 1 leaves the step to the scene
			self.timeStep = float(O.dt)

	def lost(self):
		"""What is no longer as it was set, in words; '' if all is."""
		functors, amiss = geometryFunctors(), []
		for name, value in self.attributes.items():
			if not functors:
				amiss.append(f'no contact functor is left to have {name}')
			others = [other for other in (getattr(functor, name) for functor in functors) if not _same(other, value)]
			if others:
				amiss.append(f'{name} is {_shown(others[0])}, not {_shown(value)}')
		if self.timeStep is not None and not _same(float(O.dt), self.timeStep):
			amiss.append(f'the time step is {float(O.dt):.6g} s, not {self.timeStep:.6g} s')
		return ' and '.join(amiss)


def _same(one, other):
	if isinstance(one, (str, bool)):
		return one == other
	return math.isclose(float(one), float(other), rel_tol=closest)


def _shown(value):
	return f'{value!r}' if isinstance(value, (str, bool)) else f'{float(value):g}'
