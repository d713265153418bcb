# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of each setting in a scene, and its effect on the result of interest: `polytope.tradeoff`."""

import contextlib
import csv
import dataclasses
import importlib.util
import inspect
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import yade
from tabulate import tabulate
from tqdm import tqdm
from yade import O

from . import _builds
from ._timing import meansSoFar, resetTimes, timed
from .arguments import number, numbersOf
from .scene.present import contactSettings, geometryFunctors

__all__ = ['Row', 'TradeoffTable', 'tradeoff']

ofTheContact = ('contactModel', 'contactPoint', 'solver', 'warmStart', 'tolerance', 'newtonTolerance', 'computeArea', 'timing')
"""Attributes of the contact functors that a setting may change."""
ownNames = *ofTheContact, 'timeStep', 'timeStepFactor', 'precision'  # what it may change besides arguments of build
inside = 'POLYTOPE_TRADEOFF'  # environment variable of the processes that tradeoff() starts, with a folder for the answer


class CalledAgain(RuntimeError):
	"""tradeoff() was called in a process of its own: the script, which is read there, has come to the call."""


@dataclasses.dataclass
class Row:
	"""One setting: *answer* of measure(), *error*: its distance from the reference, over the size of that (but for a reference of 0),
	*timeStep* [s] when measure() ended, *cost*: µs for as much simulated time as the first setting's step, *failures* of contact queries,
	*note*: why there is no answer."""

	name: str
	changes: dict
	answer: object = None
	error: float = None
	timeStep: float = None
	stepMicroseconds: float = None
	cost: float = None
	failures: int = 0
	note: str = ''


class TradeoffTable(list):
	"""What polytope.tradeoff() returns: a list of *Row* in the order of the settings; table[name] is the row of a setting."""

	columns = ('setting', 'answer', 'error', 'cost', 'µs per step', 'time step [s]', 'failures', 'note')

	def __init__(self, rows, reference):
		super().__init__(rows)
		true, first = (
			self[reference].answer if isinstance(reference, str) else reference,
			next((row.timeStep for row in rows if row.timeStep), 0),
		)
		for row in rows:
			row.cost = row.stepMicroseconds * first / row.timeStep if row.stepMicroseconds and row.timeStep else None
			if row.answer is not None and not np.isfinite(row.answer).all():
				row.note = 'the answer is not a finite number'
			elif row.answer is not None and np.shape(row.answer) != np.shape(true):
				row.note = f'the reference, {true}, has not as many numbers as the answer'
			elif row.answer is not None:
				off, size = np.linalg.norm(np.subtract(row.answer, true)), np.linalg.norm(true)
				row.error = float(off / size if size else off)

	def __getitem__(self, name):
		return next(row for row in self if row.name == name) if isinstance(name, str) else super().__getitem__(name)

	def front(self):
		"""Rows that no other one surpasses in both cost and error, lowest cost first; an error smaller by under a tenth is no gain."""
		kept = []
		for row in sorted((row for row in self if row.error is not None and row.cost), key=lambda row: (row.cost, row.error)):
			if not kept or row.error < 0.9 * kept[-1].error:
				kept.append(row)
		return kept

	def cells(self):
		"""The rows as lists of text and numbers; the cost is that over the first setting's."""
		first = next((row.cost for row in self if row.cost), 1)
		for row in self:
			answer = f'{len(row.answer)} numbers' if isinstance(row.answer, list) else row.answer
			yield [row.name, answer, row.error, row.cost and row.cost / first, row.stepMicroseconds, row.timeStep, row.failures, row.note]

	def show(self):
		print(tabulate(self.cells(), self.columns, floatfmt=('', '.10g', *['.3g'] * 6)))

	def csv(self, path):
		"""Writes the file, with all digits."""
		with open(path, 'w', newline='') as file:
			csv.writer(file).writerows([self.columns, *self.cells()])


def tradeoff(build, settings, measure, reference, timedSeconds=0.5):
	"""Runs one scene with several settings and tabulates cost and error of each.

	Each setting runs in a Python process of its own, which reads the script up to this call, calls build(), applies the setting, calls measure(), and
	then times steps; settings that do the same work may differ by a tenth. Where a run can blow up, let measure() raise an exception then:
	the row says so.

	:param build: function that makes the scene with engines and O.dt; it and *measure* stand above the call, at the top of a file
	:param dict settings: name → changes, {} for the scene as it is. A change is an attribute of the contact functors (*contactModel*, …),
	    *timeStep* [s], *timeStepFactor* (of the scene's own), *precision* ('double', 'longdouble', 'float128', 'mpfr150': YADE's builds),
	    or any argument of *build*
	:param measure: function without arguments that runs the scene and returns the number that matters, or several as a list
	:param reference: the true answer, or the name of the setting whose answer counts as true
	:param float timedSeconds: of each process [s]; 0: the time is the mean over the steps that measure() itself takes
	:returns: *TradeoffTable*, a list of *Row* with show(), csv(path), front()
	:raises ValueError: naming the argument: a function that another process cannot find, a change that is none, a reference that is no setting
	:raises RuntimeError: if called by *build* or *measure*
	"""
	if os.environ.get(inside):
		raise CalledAgain('tradeoff: called by one of its own processes')
	task = {'build': _placeOf('build', build), 'measure': _placeOf('measure', measure), 'timedSeconds': timedSeconds}
	if not isinstance(settings, dict) or not settings or not 0 <= number(timedSeconds, 'timedSeconds') < math.inf:
		raise ValueError(
			f'settings, timedSeconds: must be a dictionary with at least one entry and a time from 0 on, got {settings!r}, {timedSeconds!r}'
		)
	rows = [Row(name, _checked(build, name, changes)) for name, changes in settings.items()]
	if not isinstance(reference, str):
		reference = numbersOf(reference, 'reference') if hasattr(reference, '__len__') else number(reference, 'reference')
	if reference not in settings if isinstance(reference, str) else not (np.size(reference) and np.isfinite(reference).all()):
		raise ValueError(f'reference: must be a finite number, a list of such, or one of {list(settings)}, got {reference!r}')
	for row in tqdm(rows, disable=None, leave=False):
		vars(row).update(_run({**task, 'changes': row.changes}))
	return TradeoffTable(rows, reference)


def _placeOf(name, function):
	"""(file, name): where another process finds a function."""
	file = getattr(getattr(function, '__code__', None), 'co_filename', '')
	if not pathlib.Path(file).is_file() or '<' in function.__qualname__:
		raise ValueError(
			f'{name}: must be a function written with def at the top of a file, so that other processes can load it, got {function!r}'
		)
	return [str(pathlib.Path(file).resolve()), function.__name__]


def _checked(build, setting, changes):
	"""A copy in kinds that another process understands (numbers of NumPy become Python's)."""
	try:
		changes = json.loads(json.dumps(dict(changes), default=lambda value: value.tolist()))
		inspect.signature(build).bind(**{name: value for name, value in changes.items() if name not in ownNames})
		if not all(0 < float(changes.get(name, 1)) < math.inf for name in ('timeStep', 'timeStepFactor')):
			raise ValueError('timeStep and timeStepFactor must be above 0')
		_builds.available(changes.get('precision', 'double'))
	except (AttributeError, TypeError, ValueError) as error:
		raise ValueError(
			f'settings[{setting!r}]: {error}; a change is a number or text: an argument of build, or one of {", ".join(ownNames)}'
		) from None
	return changes


def _run(task):
	"""What one process does: it returns the attributes of its row."""
	kind = task['changes'].get('precision', _builds.present())
	if not _builds.available(kind):
		return {'note': f'not built for {kind}: YADE_POLYTOPE_PRECISION={kind} ./run build'}
	command = [sys.executable, '-P', '-c', f'from {__name__} import answerTo; answerTo()']  # -P: no modules of the present folder
	with tempfile.TemporaryDirectory() as folder:
		environment, answer = {**_builds.environment(kind), inside: folder}, pathlib.Path(folder) / 'answer.json'
		ended = subprocess.run(command, env=environment, input=json.dumps(task), text=True, capture_output=True)
		return (
			json.loads(answer.read_text())
			if answer.is_file()
			else {'note': f'ended with exit code {ended.returncode}: {ended.stderr.strip()[-200:]}'}
		)


def answerTo():
	"""What a process does: the task is its input, the answer a file in the folder that the environment names."""
	try:
		found = _answer(**json.load(sys.stdin))
	except (Exception, SystemExit) as error:
		found = {'note': f'{type(error).__name__}: {error}'}
	(pathlib.Path(os.environ[inside]) / 'answer.json').write_text(json.dumps(found))
	os._exit(0)  # without YADE's clean-up of threads and windows


def _answer(build, measure, changes, timedSeconds):
	_load(*build)(**{name: value for name, value in changes.items() if name not in ownNames})
	named = [name for name in ofTheContact if name in changes]
	if named and not contactSettings():
		raise ValueError(f'build: left no Ig2_Polytope_Polytope_PolytopeGeom in O.engines, which {", ".join(named)} would be set in')
	for name in named:
		setattr(contactSettings(), name, changes[name])
	O.dt = step = changes.get('timeStep', float(O.dt)) * changes.get('timeStepFactor', 1)
	resetTimes()
	answer = _load(*measure)()
	lost = [name for name in named if not contactSettings() or getattr(contactSettings(), name) != changes[name]]
	lost += [name for name in ('timeStep', 'timeStepFactor') if name in changes and not math.isclose(float(O.dt), step, rel_tol=1e-9)]
	if lost:
		return {'note': f'{", ".join(lost)} not in effect after measure(): O.saveTmp() belongs in measure(), engines and O.dt in build()'}
	answer = [float(one) for one in answer] if hasattr(answer, '__len__') else float(answer)
	found = {'answer': answer, 'timeStep': float(O.dt), 'failures': sum(functor.stats()['failures'] for functor in geometryFunctors())}
	return {**found, 'stepMicroseconds': (timed(timedSeconds) if timedSeconds > 0 else meansSoFar())[0]}


def _load(file, name):
	"""The function; a script is read with the names that YADE gives scripts."""
	if file not in sys.modules:
		sys.path.insert(0, str(pathlib.Path(file).parent))
		specification = importlib.util.spec_from_file_location('script', file)
		sys.modules[file] = module = importlib.util.module_from_spec(specification)
		vars(module).update({key: value for source in (yade, yade.utils, math) for key, value in vars(source).items() if key[0] != '_'})
		with contextlib.suppress(CalledAgain):  # what it needs is defined above the call
			specification.loader.exec_module(module)
	return getattr(sys.modules[file], name)
