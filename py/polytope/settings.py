# SPDX-License-Identifier: GPL-2.0-or-later
"""Groups of settings recommended by the measured Pareto fronts: `polytope.settings`."""

__all__ = ['presets', 'settings']

_paper = {'contactModel': 'paper', 'contactPoint': 'analyticCentre', 'solver': 'newton', 'warmStart': True}

presets = {
	'fast': {**_paper, 'timeStepFactor': 2.0},
	'balanced': {**_paper, 'timeStepFactor': 1.0},
	'exact': {'contactModel': 'spring', 'solver': 'newton', 'warmStart': True, 'timeStepFactor': 0.5},
}


def settings(name):
	"""Attributes for Ig2_Polytope_Polytope_PolytopeGeom, and a factor for the time step, as a dictionary of its own.

	They come from `./run tradeoff`, by this rule. A setting is in if it has an answer in every scene and gives a heap (A) within three
	standard deviations of what seeds give. The scenes that count for errors are those with a closed form that holds whatever the law
	between depth and force (C, D, F, rest); a relative error below 1e-4 counts as 1e-4, since no input is known better. Costs and errors
	are over the default's, geometric means over these scenes.

	- 'balanced': the default.
	- 'fast': the default with the longest of the time steps measured at which no error is more than a tenth above the default's.
	- 'exact': the contact model that conserves energy, with half of the scenes' own time step, for its faces are stiffer in rocking.

	What is in none of them costs time and brings no digit there (cold start, Ipopt, wider arithmetic, a finer Newton tolerance), or
	fails in a scene (the Chebyshev centre in C), or follows another law rather than having less error (the centroid).

	**What 'exact' is exact in**: energy (`./run python examples/energy.py`) and slip (C: off by 1.3e-3 instead of 3.4e-3, the default's). It is another contact,
	for stiffnesses per contact; where they are per area take contactModel='foundation'. Answers that depend on the stiffness of edges are of another law: the
	peak load of the beam B is off by 0.12 (default 0.16), both against forces at the centroid. `./run tradeoff --quick --only B C` prints these figures.

	'fast' was measured with the paper's normal (normal='innerPotential'), before the present default.

	**Time steps**: polytope.stableTimeStep(1) is safe for any heap; it is 1/ω where nothing is damped, less with dampers. 'exact' takes
	half of the scenes' own step: 0.13/ω in C. 'balanced' and 'fast' are not limited to it. They rest on the
	answers measured, in scenes with damped contacts, whose heap (A) is at 1.3/ω and 2.6/ω, and becomes unstable with twice the step of
	'fast'. polytope.requirements(O) names any step above stableTimeStep(1); where results are doubtful, put PolytopeTimeStepper into
	O.engines instead.

	:param str name: 'fast', 'balanced' or 'exact'
	:returns: attributes by name; and *timeStepFactor*, over the step you would take otherwise: the scenes' own is 0.2 √(m/k) (A, C, D), and
	    0.02 √(m/k) with critical dampers in the contacts (F, rest), which shorten what is stable
	:raises ValueError: for another name

	Use::

		choice = polytope.settings('exact')
		O.dt *= choice.pop('timeStepFactor')
		functor = Ig2_Polytope_Polytope_PolytopeGeom(**choice)

	or polytope.tradeoff(build, {name: polytope.settings(name) for name in ('fast', 'balanced', 'exact')}, …) for your own scene.
	"""
	if not isinstance(name, str) or name not in presets:
		raise ValueError(f'name: must be one of {", ".join(presets)}, got {name!r}')
	return dict(presets[name])
