# SPDX-License-Identifier: GPL-2.0-or-later
"""Times of a step of the present scene, by YADE's own clocks: for *tradeoff* and *check*."""

import math
import time

from yade import O

from .scene.present import geometryFunctors, interactionLoops

__all__ = ['meansSoFar', 'resetTimes', 'timed']

leastBlock = 1e6
"""The least time of one block of timed steps [ns]: a thousand times the clock's own resolution."""


def resetTimes():
	for functor in geometryFunctors():
		functor.resetStats()
	for engine in O.engines:
		engine.execTime = engine.execCount = 0
	O.timingEnabled = True


def contactsSoFar():
	return sum(functor.stats()['contacts'] for functor in geometryFunctors())


def meansSoFar():
	"""Means over all steps since resetTimes(): (µs a step, µs of the loop a contact, contacts a step)."""
	steps, found = max((engine.execCount for engine in O.engines), default=0), contactsSoFar()
	if not steps:
		return None, None, None
	spent, loops = (sum(engine.execTime for engine in engines) * 1e-3 for engines in (O.engines, interactionLoops()))
	return spent / steps, loops / found if found else None, found / steps


def timed(seconds):
	"""Takes steps for so long and returns the least mean times of blocks of them: (µs a step, µs of the loop a contact, contacts a step).

	The least, not the mean: another program that takes the processor makes a block longer, nothing makes it shorter.
	"""
	steps, began, step, contact, contacts = 1, time.perf_counter(), math.inf, math.inf, 0.0
	while True:
		resetTimes()
		for _ in range(steps):
			O.step()
		spent, found = sum(engine.execTime for engine in O.engines), contactsSoFar()
		out = time.perf_counter() - began > seconds
		if spent < leastBlock and not out:
			steps *= 2
			continue
		if spent / steps * 1e-3 < step:
			step, contacts = spent / steps * 1e-3, found / steps
		if found:
			contact = min(contact, sum(loop.execTime for loop in interactionLoops()) / found * 1e-3)
		if out:
			return step, contact if math.isfinite(contact) else None, contacts
