# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines that write the whole scene: each worker would write its part under the same name. They are left out of the divided scene, and run on
rank 0 with the merged one, between two steps, at the periods they have.
"""

import math
import time

import yade
from yade import O, PolytopeCheckpoint

__all__ = ['due', 'ofWholeScene', 'record', 'stepsToNext']

kinds = tuple(getattr(yade, name) for name in ('PolytopeCheckpoint', 'PolytopeVTKRecorder', 'VTKRecorder') if hasattr(yade, name))
lookAtClock = 100
"""Steps between looks at the clock, for periods of real time."""


def ofWholeScene(engine):
	"""Whether this engine is run on the merged scene."""
	return isinstance(engine, kinds)


def due():
	"""The engines whose period has passed, in their order; their counters then start again. On rank 0."""
	return [engine for engine in _all() if _isDue(engine)]


def record(engines):
	"""Runs them on the scene as it is, which must be merged."""
	for engine in engines:
		if isinstance(engine, PolytopeCheckpoint):
			engine.write()
		else:
			engine()


def stepsToNext():
	"""Steps that can be taken before one of them may be due, at least 1. On rank 0."""
	return max(1, min((_steps(engine) for engine in _all()), default=2**31 - 1))


def _all():
	engines = O.initialEngines if O.splitted else O.engines
	return [engine for engine in engines if ofWholeScene(engine) and not engine.dead]


def _isDue(engine):
	"""Whether the engine is due, by the rule of YADE's PeriodicEngine::isActivated, which only the engine's own loop calls."""
	if O.iter < engine.iterLast:
		engine.nDone = 0
	first = engine.nDone == 0
	if first and engine.firstIterRun > 0 and engine.firstIterRun > O.iter:
		return False
	passed = (
		0 < engine.virtPeriod <= O.time - engine.virtLast
		or 0 < engine.realPeriod <= time.time() - engine.realLast
		or 0 < engine.iterPeriod <= O.iter - engine.iterLast
	)
	isDue = (engine.nDo < 0 or engine.nDone < engine.nDo) and (engine.initRun or engine.firstIterRun > 0 if first else passed)
	if isDue or first:
		engine.virtLast, engine.realLast, engine.iterLast = O.time, time.time(), O.iter
		engine.nDone += 1
	return isDue


def _steps(engine):
	counts = [2**31 - 1]
	if engine.firstIterRun > O.iter:
		counts.append(engine.firstIterRun - O.iter)
	if engine.iterPeriod > 0:
		counts.append(engine.iterLast + engine.iterPeriod - O.iter)
	if engine.virtPeriod > 0:
		counts.append(math.ceil((engine.virtLast + engine.virtPeriod - O.time) / O.dt))
	if engine.realPeriod > 0:
		counts.append(lookAtClock)
	return min(counts)
