# SPDX-License-Identifier: GPL-2.0-or-later
"""One setting of polytope.tradeoff(), in a process of its own: `python3 -m yade.polytope.tradeoff.worker TASK ANSWER`, two JSON files."""

import ctypes
import importlib
import importlib.util
import inspect
import json
import math
import os
import pathlib
import signal
import sys
import time

import mpmath
import numpy as np
import yade
from yade import O, _polytope

from .._timing import meansSoFar, resetTimes, timed
from ..scene.present import geometryFunctors
from .effect import Effect
from .energy import Energy
from .inside import CalledAgain

__all__ = ['load', 'takesTheScene']

digits = 45
"""Decimal digits of an answer: those of float128, and ten more."""
whatLosesIt = 'O.saveTmp() belongs in measure(), new engines and O.dt in build()'
"""Advice where a setting is lost."""


def load(where):
	"""The function of {'module', 'file', 'name'}; a script is loaded from its file, with the names that YADE gives scripts."""
	if where['module'].startswith('yade.'):
		module = importlib.import_module(where['module'])
	else:
		name = 'tradeoff_' + pathlib.Path(where['file']).stem
		module = sys.modules.get(name)
		if module is None:
			sys.path.insert(0, str(pathlib.Path(where['file']).parent))
			specification = importlib.util.spec_from_file_location(name, where['file'])
			module = sys.modules[name] = importlib.util.module_from_spec(specification)
			for source in (yade, yade.utils, math):
				vars(module).update({key: value for key, value in vars(source).items() if key[0] != '_'})
			try:
				specification.loader.exec_module(module)
			except CalledAgain:
				pass  # the script has reached its call of tradeoff(): what it needs is defined above that
	return getattr(module, where['name'])


def takesTheScene(measure):
	"""Whether *measure* takes the value that *build* returned."""
	return bool(inspect.signature(measure).parameters)


def written(value):
	"""A number, or a sequence of them, as text with all digits."""
	if hasattr(value, '__len__') and hasattr(value, '__getitem__') and not isinstance(value, (str, bytes, dict)):
		return [written(one) for one in value]  # vectors of YADE's, too
	if isinstance(value, (int, np.integer)):
		return str(int(value))
	if isinstance(value, (float, np.floating)):
		return repr(float(value))
	try:
		return mpmath.nstr(mpmath.mpf(value), digits)
	except (TypeError, ValueError):
		raise ValueError(f'measure: must return a number, a list of numbers or a dictionary of these, there is {value!r}') from None


def checkTimeStep(function):
	if not 0 < O.dt < math.inf:
		raise ValueError(f'{function}: must leave O.dt above 0, it is {float(O.dt):g}')


def answer(task):
	"""What Row.take() takes."""
	build, measure = load(task['build']), load(task['measure'])
	scene = build(**task['arguments'])
	effect = Effect(task['changes'])
	checkTimeStep('build')
	resetTimes()
	energy, began = Energy(), time.perf_counter()
	values = measure(scene) if takesTheScene(measure) else measure()
	seconds = time.perf_counter() - began
	if not isinstance(values, dict):
		values = {'value': values}
	if not values:
		raise ValueError('measure: returned a dictionary without an answer')
	if not O.engines:
		raise ValueError('measure: left no engines, whose time would be the cost')
	checkTimeStep('measure')
	lost = effect.lost()
	if lost:
		return {'error': f'not in effect: after measure() {lost}; {whatLosesIt}'}
	counts = [functor.stats() for functor in geometryFunctors()]
	limit = _polytope.timeStepLimits()['contacts']
	ofLimit = None if limit is None else float(O.dt) / float(limit)
	result = {
		'timeStepOfLimit': ofLimit,
		'energy': energy.created(),
		'values': {name: written(value) for name, value in values.items()},
		'seconds': seconds,
		'timeStep': float(O.dt),  # that of the steps that are timed
		'fallbacks': sum(count['fallbacks'] for count in counts),
		'failures': sum(count['failures'] for count in counts),
	}
	times = timed(task['timedSeconds']) if task['timedSeconds'] > 0 and O.engines else meansSoFar()
	result['stepMicroseconds'], result['contactMicroseconds'], result['contacts'] = times
	return result


def endWithCaller():
	"""So that a caller which is killed, by a batch system for example, leaves no process behind (prctl(2), Linux)."""
	endsWithParent = 1
	ctypes.CDLL(None).prctl(endsWithParent, signal.SIGKILL)


def main(taskFile, answerFile):
	endWithCaller()
	task = json.loads(pathlib.Path(taskFile).read_text())
	try:
		content = answer(task)
	except Exception as error:
		import traceback

		traceback.print_exc()
		content = {'error': f'{type(error).__name__}: {error}'}
	except SystemExit as error:
		content = {'error': f'build or measure called sys.exit({error.code!r})'}
	pathlib.Path(answerFile).write_text(json.dumps(content))
	sys.stdout.flush()
	sys.stderr.flush()
	os._exit(0)  # end at once, without YADE's clean-up of threads and windows


if __name__ == '__main__':
	main(*sys.argv[1:])
