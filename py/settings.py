# SPDX-License-Identifier: GPL-2.0-or-later
"""Groups of settings that the measured fronts recommend: `polytope.settings`."""

__all__ = ['presets', 'settings']

presets = {
	'fast': {'contactModel': 'paper', 'contactPoint': 'analyticCentre', 'solver': 'newton', 'warmStart': True, 'timeStepFraction': 0.4},
	'balanced': {'contactModel': 'paper', 'contactPoint': 'analyticCentre', 'solver': 'newton', 'warmStart': True, 'timeStepFraction': 0.2},
	'exact': {'contactModel': 'conservative', 'solver': 'newton', 'warmStart': True, 'timeStepFraction': 0.1},
}


def settings(name):
	"""Attributes for Ig2_Polytope_Polytope_PolytopeGeom, and the time step, as a dictionary of its own.

	They come from `./run tradeoff`, by this rule. The scenes that count are those with a closed form that holds whatever the law between
	depth and force (C, D, F, rest); a relative error below 1e-4 counts as 1e-4, since no input is known better. Each setting there has
	a cost and an error over the default's, the geometric means over these scenes; one without an answer in any of them is out.

	- 'balanced': the default.
	- 'fast': the default with the longest of the time steps measured at which no error is more than a tenth above the default's.
	- 'exact': the setting of least error, with the longest of the time steps measured at which it has an answer in all these scenes.

	What is in none of them costs time and brings no digit there (cold start, Ipopt, wider arithmetic, a finer Newton tolerance), or
	fails in a scene (the Chebyshev centre in C and D), or gives another law rather than less error (centroid).

	:param str name: 'fast', 'balanced' or 'exact'
	:returns: attributes by name; and *timeStepFraction*, for O.dt, of √(m/k) of the lightest body on the stiffest contact
	:raises ValueError: for another name

	Use::

		choice = polytope.settings('exact')
		O.dt = choice.pop('timeStepFraction') * math.sqrt(mass / stiffness)
		functor = Ig2_Polytope_Polytope_PolytopeGeom(**choice)

	Large flat faces pressed together are stiffer than k against rocking with the conservative contact: have the time step checked by
	polytope.requirements(O) once they touch.
	"""
	if name not in presets:
		raise ValueError(f'name: must be one of {", ".join(presets)}, got {name!r}')
	return dict(presets[name])
