# SPDX-License-Identifier: GPL-2.0-or-later
"""Arguments that a moving base and a quiet boundary share."""

import numbers

from yade import O, VelocityHistory

from ..scene.present import integrators

__all__ = ['bodiesOf', 'historyOf', 'refuseWithoutIntegrator']


def bodiesOf(ids):
	"""Numbers of bodies, as a list of int. ValueError naming *ids*."""
	try:
		ids = list(ids)
	except TypeError:
		ids = [ids]
	for k in ids:
		if isinstance(k, bool) or not isinstance(k, numbers.Integral) or not 0 <= k < len(O.bodies) or O.bodies[int(k)] is None:
			raise ValueError(f'ids: there is no body {k!r}')
	ids = [int(k) for k in ids]
	if not ids:
		raise ValueError('ids: there must be one at least')
	if len(set(ids)) < len(ids):
		raise ValueError('ids: some bodies are named twice')
	return ids


def historyOf(given):
	if not isinstance(given, VelocityHistory) or not len(given.times):
		raise ValueError(f'history: must be what polytope.velocityHistory returns, got {given!r}')
	began = float(given.times[0])
	if began < O.time:
		raise ValueError(
			f'history: begins at {began:g} s, and O.time is {O.time:g} s; make it now (after polytope.settle()), or give it another start'
		)
	return given


def refuseWithoutIntegrator():
	"""ValueError where O.engines has no NewtonIntegrator, RuntimeError while the scene runs."""
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	if not integrators():
		raise ValueError(
			'O.engines: there must be a NewtonIntegrator; set O.engines first, for example O.engines = polytope.engines(damping=0)'
		)
