# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of each setting in a scene, and its effect on the result of interest: `polytope.tradeoff`."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

from tqdm import tqdm

from .. import _builds
from .arguments import checkArguments, checkedSettings, checkNumbers, checkReference, ofTheScene, placeOf
from .effect import settable
from .inside import CalledAgain, inside
from .table import Row, TradeoffTable, checkLength
from .worker import takesTheScene

__all__ = ['tradeoff']


def tradeoff(build, settings, measure, reference, repeats=1, timedSeconds=0.5, timeLimit=None):
	"""Runs one scene with several settings and tabulates cost and error of each.

	Each setting runs in a Python process of its own, which loads the file *build* and *measure* are written in, calls build(), applies
	the setting, calls measure(), and then takes steps for *timedSeconds* from where that left the scene: the times are the least means
	of many blocks of steps, so that other programs disturb them less. Settings that do the same work may still differ by a tenth: *repeats*
	narrows that. One thread, unless OMP_NUM_THREADS says more.

	These processes read the script from its beginning up to this call, no further: *build* and *measure* must stand above it. Put the
	call, and all that should run once, under ``if __name__ == '__main__':``, and these processes do not reach it at all. Not after ``from
	yade import *``, which renames the script ('yade' is among the names it brings, as __name__): the condition is false even in the script
	itself, and nothing happens. Then either call tradeoff() at the script's end with no condition, or ask before importing::

		isScript = __name__ == '__main__'
		from yade import *
		...
		if isScript:
			table = polytope.tradeoff(build, settings, measure, reference)

	What a setting changes besides arguments of *build* is set once, after build(), and looked up again after measure(). A scene that is
	renewed in between loses it (O.loadTmp of a state saved in build(), engines made in measure()): such a row says 'not in effect', and has
	neither answer nor cost. To go back to the start save it in measure(), O.saveTmp() first. A measure() may change O.dt (to
	polytope.stableTimeStep() for example), but then no *timeStep* or *timeStepFactor* is in effect, except a factor of 1. A setting that
	measure() loses and restores at its end is not detected.

	:param build: function that makes the scene with engines and O.dt
	:param dict settings: name → changes, {} for the scene as it is. A change is an attribute of the contact functors
	    (Ig2_Polytope_Polytope_PolytopeGeom: *contactPoint*, *newtonTolerance*, *warmStart*, *solver*, *contactModel*, …;
	    a *newtonTolerance* coarser than the default changes almost nothing, since the depth is kept to 2e-14 of the size anyway),
	    *timeStep* [s], *timeStepFactor* (of the scene's own), *precision* ('double', 'longdouble', 'float128', 'mpfr150': YADE's builds;
	    a row says so where the plug-in was not built for it), or any argument of *build*
	:param measure: function that runs the scene and returns the number that matters, or several as a list (their error is that of the
	    vector), or a dict of such, the first of which is the answer and the others are tabulated. Called without arguments, or with
	    what *build* returned if it takes one
	:param reference: the true answer (a number or list as long as measure()'s), or the name of the setting whose answer counts as true;
	    if that one has no answer, no row has an error, and says so
	:param int repeats: processes for each setting; the least times count
	:param float timedSeconds: of each process [s]; 0: the times are means over the steps that measure() itself takes, since it last
	    made new engines (O.loadTmp does)
	:param float timeLimit: after which a process is stopped and its row says so [s]
	:returns: a *TradeoffTable* with show(), csv(path), plot(path), front(), against(reference). A row whose answer is not a number,
	    or whose scene blew up (see TradeoffTable), or whose setting was not in effect, says so and is never on the front
	:raises ValueError: naming the argument: functions that cannot be found by another process (lambdas, functions within functions),
	    a reference that is no setting (or of another length than the first answer), an unknown precision, a time step that is not above 0
	:raises RuntimeError: if called within such a process by *build* or *measure*
	:raises KeyboardInterrupt: if interrupted, with what is measured as its attribute *table*; the process that runs is ended

	Example: examples/tradeoff.py.
	"""
	if os.environ.get(inside):
		raise CalledAgain("tradeoff: called by one of its own processes; put the call under `if __name__ == '__main__':`")
	where = {name: placeOf(name, function) for name, function in (('build', build), ('measure', measure))}
	settings = checkedSettings(settings)
	checkArguments(build, settings)
	checkReference(reference, settings)
	checkNumbers(repeats, timedSeconds, timeLimit)
	takesTheScene(measure)
	return _table([Row(name, changes) for name, changes in settings.items()], reference, where, repeats, timedSeconds, timeLimit)


def _table(rows, reference, *how):
	"""Of the rows, measured; if interrupted, the table of what is measured goes with the exception."""
	try:
		_measure(rows, reference, *how)
	except KeyboardInterrupt as interrupt:
		for row in rows:
			row.note = row.note or ('interrupted before it was run' if row.answer is None else '')
		interrupt.table = TradeoffTable(rows, reference)
		raise
	return TradeoffTable(rows, reference)


def _measure(rows, reference, where, repeats, timedSeconds, timeLimit):
	"""All processes, round by round: so that a disturbance affects all settings alike."""
	fits = isinstance(reference, str)
	with tqdm(total=repeats * len(rows), disable=None, leave=False) as bar:
		for _ in range(repeats):
			for row in rows:
				bar.set_postfix_str(row.name, refresh=True)
				if not row.note:
					row.take(_run(where, row.changes, timedSeconds, timeLimit))
				if not fits and row.answer is not None:
					checkLength(row.answer, reference)  # now, not after all runs
					fits = True
				bar.update()


def _run(where, changes, timedSeconds, timeLimit):
	"""One process; what it answered, {'error': …} if it did not."""
	kind = changes.get('precision', _builds.present())
	if not _builds.available(kind):
		return {'error': f'not built for {kind}: YADE_POLYTOPE_PRECISION={kind} ./run build'}
	task = {
		**where,
		'changes': {name: value for name, value in changes.items() if name in settable or name in ofTheScene},
		'arguments': {name: value for name, value in changes.items() if name not in settable and name not in ofTheScene},
		'timedSeconds': timedSeconds,
	}
	with tempfile.TemporaryDirectory() as folder:
		files = [pathlib.Path(folder) / name for name in ('task.json', 'answer.json', 'log.txt')]
		files[0].write_text(json.dumps(task))
		# -P: modules in the present folder are not to be imported
		command = [sys.executable, '-P', '-m', 'yade.polytope.tradeoff.worker', *map(str, files[:2])]
		with open(files[2], 'w') as log:
			try:
				environment = {**_builds.environment(kind), inside: '1'}
				ended = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log, timeout=timeLimit)
			except subprocess.TimeoutExpired:
				return {'error': f'took longer than {timeLimit:g} s'}
		if not files[1].is_file():
			return {'error': _howItEnded(ended.returncode, files[2].read_text(errors='replace'))}
		return json.loads(files[1].read_text())


def _howItEnded(code, log):
	"""A process that left no answer: the signal by name, or the last words of its log that are words (after a signal these are a backtrace)."""
	if code < 0:
		names = {one.value: f', {one.name}' for one in signal.Signals}
		return f'ended by signal {-code}{names.get(-code, "")}'
	said = [line.strip() for line in log.splitlines() if any(letter.isalpha() for letter in line) and 'RuntimeWarning' not in line]
	return f'ended with exit code {code}' + (f': {said[-1]}' if said else '')
