# SPDX-License-Identifier: GPL-2.0-or-later
"""What each setting costs in a scene, and what it does to the answer that matters there: `polytope.tradeoff`."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

from tqdm import tqdm

from . import tradeoffPrecision as precision
from .tradeoffTable import Row, TradeoffTable
from .tradeoffWorker import settable, takesTheScene

__all__ = ['tradeoff']

ofTheScene = ('timeStep', 'timeStepFactor', 'precision')
inside = 'POLYTOPE_TRADEOFF'
"""Environment variable of the processes that are started here."""


def tradeoff(build, settings, measure, reference, repeats=1, timedSeconds=0.5, timeLimit=None):
	"""Runs one scene with several settings and tabulates cost and error of each.

	Each setting runs in a Python process of its own, which loads the file *build* and *measure* are written in, calls build(), applies
	the setting, calls measure(), and then takes steps for *timedSeconds* from where that left the scene: the times are the least means
	of many blocks of steps, so that other programs disturb them little. One thread, unless OMP_NUM_THREADS says more.

	In a script, put the call under ``if __name__ == '__main__':``, or the processes would come to it again (they refuse).

	:param build: function that makes the scene with engines and O.dt
	:param dict settings: name → changes, {} for the scene as it is. A change is an attribute of the contact functors
	    (Ig2_Polytope_Polytope_PolytopeGeom: *contactPoint*, *newtonTolerance*, *warmStart*, *solver*, *contactModel*, *barrier*, …),
	    *timeStep* [s], *timeStepFactor* (of the scene's own), *precision* ('double', 'longdouble', 'float128', 'mpfr150': YADE's builds;
	    a row says so where the plug-in was not built for it), or any argument of *build*
	:param measure: function that runs the scene and returns the number that matters, or several as a list (their error is that of the
	    vector), or a dict of such, the first of which is the answer and the others are tabulated. Called without arguments, or with
	    what *build* returned if it takes one
	:param reference: the true answer (a number or list), or the name of the setting whose answer counts as true
	:param int repeats: processes for each setting; the least times count
	:param float timedSeconds: of each process [s]; 0: the times are means over the steps that measure() itself takes, since it last
	    made new engines (O.loadTmp does)
	:param float timeLimit: after which a process is stopped and its row says so [s]
	:returns: a :yref:`TradeoffTable` with show(), csv(path), plot(path), front(), against(reference)
	:raises ValueError: naming the argument: functions that cannot be found by another process (lambdas, functions within functions),
	    a reference that is no setting, an unknown precision
	:raises RuntimeError: if called within such a process (see above)

	Example: examples/tradeoff.py.
	"""
	if os.environ.get(inside):
		raise RuntimeError("tradeoff: called by one of its own processes; put the call under `if __name__ == '__main__':`")
	where = {name: _place(name, function) for name, function in (('build', build), ('measure', measure))}
	if not settings:
		raise ValueError('settings: there must be at least one')
	if isinstance(reference, str) and reference not in settings:
		raise ValueError(f'reference: {reference!r} is none of the settings, {list(settings)}')
	if not repeats >= 1:
		raise ValueError(f'repeats: must be at least 1, got {repeats}')
	for changes in settings.values():
		precision.available(changes.get('precision', 'double'))
	takesTheScene(measure)
	rows = {name: Row(name, dict(changes)) for name, changes in settings.items()}
	with tqdm(total=repeats * len(rows), disable=None, leave=False) as bar:
		for _ in range(repeats):
			for row in rows.values():  # round by round: what disturbs one round does not disturb one setting alone
				bar.set_postfix_str(row.name, refresh=True)
				if not row.note:
					row.take(_run(where, row.changes, timedSeconds, timeLimit))
				bar.update()
	return TradeoffTable(list(rows.values()), reference)


def _place(name, function):
	"""Where another process finds it."""
	code = getattr(function, '__code__', None)
	if code is None or function.__qualname__ != function.__name__ or function.__name__ == '<lambda>':
		raise ValueError(f'{name}: must be a function written with def at the top of a file, got {function!r}')
	file = pathlib.Path(code.co_filename).resolve()
	if not file.is_file():
		raise ValueError(f'{name}: must be written in a file, so that other processes can load it; {code.co_filename} is none')
	return {'module': function.__module__, 'file': str(file), 'name': function.__name__}


def _run(where, changes, timedSeconds, timeLimit):
	"""One process; what it answered, {'error': …} if it did not."""
	kind = changes.get('precision', precision.present())
	if not precision.available(kind):
		return {'error': f'not built for {kind}'}
	task = {
		**where,
		'changes': {name: value for name, value in changes.items() if name in settable or name in ofTheScene},
		'arguments': {name: value for name, value in changes.items() if name not in settable and name not in ofTheScene},
		'timedSeconds': timedSeconds,
	}
	with tempfile.TemporaryDirectory() as folder:
		files = [pathlib.Path(folder) / name for name in ('task.json', 'answer.json', 'log.txt')]
		files[0].write_text(json.dumps(task))
		# -P: the folder this is called from is no place for modules
		command = [sys.executable, '-P', '-m', 'yade.polytope.tradeoffWorker', *map(str, files[:2])]
		with open(files[2], 'w') as log:
			try:
				environment = {**precision.environment(kind), inside: '1'}
				ended = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log, timeout=timeLimit)
			except subprocess.TimeoutExpired:
				return {'error': f'took longer than {timeLimit:g} s'}
		if not files[1].is_file():
			last = files[2].read_text(errors='replace').strip().splitlines()[-1:]
			return {'error': f'ended with exit code {ended.returncode}: {" ".join(last)}'}
		return json.loads(files[1].read_text())
