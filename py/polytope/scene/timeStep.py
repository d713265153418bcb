# SPDX-License-Identifier: GPL-2.0-or-later
"""A time step that is stable with the present contacts, rocking included."""

import math

from yade import _polytope

from ..precision import isNumber

__all__ = ['safeTimeStep', 'stableTimeStep']


def safeTimeStep():
	"""τ [s] of the present contacts; in a scene without any, τ of those that may come; None where nothing limits it."""
	limits = _polytope.timeStepLimits()
	return limits['material'] if limits['contacts'] is None else limits['contacts']


def stableTimeStep(fraction=0.2, default=None):
	"""Time step from the stiffnesses of all present contacts, as a fraction of τ, which is 1/ω of the fastest body where no contact is damped.

	What *PolytopeTimeStepper* computes, without its limit of motion: in most scenes put that engine into O.engines instead, which keeps
	the step right as the run goes on (docs/time-step.md says what τ is). One body between fixed ones is stable up to 2 τ, any heap up to
	τ. YADE's GlobalStiffnessTimeStepper neglects rocking. In a scene without contacts it is the τ of the contacts that may come,
	from the materials.

	:param float fraction: of τ, above 0; at most 1 is safe for any heap, at most 2 (refused above) for one body
	:param float default: returned [s] where nothing limits the step
	:returns: the time step [s]; set it with O.dt = …
	:raises ValueError: naming *fraction*, or *default* where one is needed
	"""
	if not isNumber(fraction) or not 0 < fraction <= 2:
		raise ValueError(f'fraction: must be above 0 and at most 2, the limit of one body, got {fraction!r}')
	if default is not None and not (isNumber(default) and not isinstance(default, bool) and 0 < default < math.inf):
		raise ValueError(f'default: must be a finite time step above 0, got {default!r}')
	limit = safeTimeStep()
	if limit is not None:
		return fraction * limit
	if default is None:
		raise ValueError('default: no contact between bodies that can move limits the time step, now or later; give one')
	return default
