# SPDX-License-Identifier: GPL-2.0-or-later
"""Steps of the scene with a bar of progress, which can be interrupted: `polytope.run(…)`."""

import math
import numbers
import time

from tqdm import tqdm
from yade import O, PolytopeTimeStepper

from ..arguments import namedArguments, warn
from ..precision import isNumber, real
from .notNumbers import notNumbers

__all__ = ['run']

heard = 0.4
"""Seconds of the clock after which a part of the run ends. Python hears Ctrl-C between two parts alone, and each costs up to 0.04 s, for
YADE looks so seldom whether it is done."""

manySteps = 1e6
"""Steps to a time above which a scene where nothing limits the step was not meant to take so many."""


@namedArguments
def run(steps=None, until=None, every=100):
	"""Takes steps and returns when they are done; in a terminal it shows its progress and the time left, and Ctrl-C ends it between two steps.

	In place of O.run(steps, wait=True), which shows nothing and does not hear Ctrl-C::

	    polytope.run(1000)                                                   # so many steps
	    polytope.run(until=2)                                                # until O.time is 2 s
	    polytope.run(until=lambda: O.bodies[block].state.vel.norm() < 1e-3, steps=100000)

	The steps are those of O.run or O.step, bit for bit. As with O.run, an engine that calls O.pause() ends it, and so does O.stopAtTime;
	O.stopAtIter is cleared.

	A warning names a body whose position or velocity is no number in the end, and tells of a time that is more than a million steps away while nothing
	limits the time step.

	:param int steps: so many; with *until* the most to be taken
	:param until: time (O.time) at which to end [s], in the first step that reaches it; or a function without arguments that returns
	    whether to end. What holds already takes no step
	:param int every: steps after which the function is asked; each time costs up to 0.04 s, for YADE looks so seldom whether it is done
	:returns: True; False if it ended before: after so many *steps* without *until* being reached, by O.pause(), or by O.stopAtTime
	:raises ValueError: naming the argument, or what the scene lacks
	:raises RuntimeError: if the scene is running already, if it is divided on several processes (MPI), or what an engine raises
	:raises KeyboardInterrupt: at Ctrl-C; the scene can go on from there
	"""
	limit = math.inf if steps is None else _count(steps, 'steps', 0)
	_checkUntil(until, steps)
	every = _count(every, 'every', 1)
	timed = until is not None and not callable(until)
	_checkScene(timed)
	if timed:
		reached = _untilTime(real(until), limit)
	else:
		reached = _counted(limit, until, steps, every)
	_tellNotNumbers()
	return reached


def _counted(limit, until, steps, every):
	with tqdm(total=None if steps is None else limit, unit=' steps', disable=None, leave=False) as bar:
		if until is None:
			return _steps(limit, bar.update)
		return _untilTrue(until, limit, every, bar.update)


def _untilTime(until, limit):
	"""YADE itself looks at O.stopAtTime after each step, and then clears it."""
	own = O.stopAtTime
	shape = '{percentage:3.0f}%|{bar}| {n:.4g} of {total:.4g} s [{elapsed}<{remaining}]'
	with tqdm(total=float(until), initial=float(O.time), bar_format=shape, disable=None, leave=False) as bar:
		try:
			if until > O.time and not 0 < own < until:
				O.stopAtTime = until
			far = until - O.time > manySteps * O.dt
			if not far or _steps(min(1, limit), lambda _: None):
				if far:
					_tellUnlimited(until)
					limit -= 1
				_steps(limit, lambda _: bar.update(float(O.time) - bar.n), lambda: O.time >= until)
			return O.time >= until
		finally:
			O.stopAtTime = own if own > O.time else 0


def _tellUnlimited(until):
	"""After a step, in which the stepper has looked."""
	steppers = [engine for engine in O.engines if isinstance(engine, PolytopeTimeStepper) and not engine.dead]
	far = (until - O.time) / O.dt
	if far > manySteps and steppers and not any(engine.limitedBy for engine in steppers):
		warn(f'until: {float(far):.2g} steps away, for nothing limits the time step: it is still {float(O.dt):.2g} s; set O.dt')


def _tellNotNumbers():
	lost = notNumbers()
	if lost:
		more = f', and of {len(lost) - 1} bodies more' if len(lost) > 1 else ''
		warn(f'run: position or velocity of body {next(iter(lost))}{more} is not a number; polytope.check(O) tells which')


def _untilTrue(until, limit, every, show):
	end, size = O.iter + limit, [1]
	while not until():
		if O.iter >= end or not _steps(min(every, end - O.iter), show, size=size):
			return bool(until())
	return True


def _steps(count, show, ended=lambda: False, size=None):
	"""Runs this number of steps in parts, and tells *show* the number of each. Returns whether all were taken, or *ended()*: else an engine
	has paused. *size*: a list of the number of steps in the next part, for further calls."""
	end, size = O.iter + count, size or [1]
	while O.iter < end and not ended():
		first, start, now = O.iter, time.perf_counter(), int(min(size[0], end - O.iter))
		O.run(now, wait=True)
		show(O.iter - first)
		if O.iter < first + now and not ended():
			O.stopAtIter = 0  # the next O.run() would end there
			return False
		size[0] = min(10 * size[0], max(1, int(now * heard / (time.perf_counter() - start))))
	return True


def _count(value, name, least):
	if isinstance(value, bool) or not isinstance(value, numbers.Integral) or value < least:
		raise ValueError(f'{name}: must be a whole number, at least {least}, got {value!r}')
	return int(value)


def _checkUntil(until, steps):
	if until is None:
		if steps is None:
			raise ValueError('until: give a time [s], a function, or steps, else the run would have no end')
	elif not callable(until) and (isinstance(until, bool) or not isNumber(until) or not 0 <= until < math.inf):
		raise ValueError(f'until: must be a time of 0 s or later, or a function without arguments, got {until!r}')


def _checkScene(timed):
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	if getattr(O, 'splitted', False):  # which yade.mpy sets
		raise RuntimeError('O.bodies: the scene is divided on several processes; polytope.mpi has the run for it')
	if not O.engines:
		raise ValueError('O.engines: there are none, so nothing would happen; O.engines = polytope.engines()')
	if timed and not O.dt > 0:
		raise ValueError(f'O.dt: {O.dt:g} s; with it O.time does not go on to what until says')
