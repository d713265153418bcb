# SPDX-License-Identifier: GPL-2.0-or-later
"""What changes of a scene save, timed in a process of its own, for polytope.requirements(): see worker."""

import json
import pathlib
import subprocess
import sys
import tempfile

from .. import _builds
from ..scene.permanentLoads import permanentLoads

__all__ = ['stepTimes']


def stepTimes(O, trials):
	"""(name of a change → time of a step [µs], see worker.stepTimes; why there is none, '' if there is).

	:param list trials: (name, value, whether it is advised)
	:raises OSError: if the scene cannot be saved to a temporary folder
	"""
	try:
		folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
	except OSError as error:
		raise _unwritable('a temporary folder', error) from error
	with folder:
		scene, changes, answers, log = (pathlib.Path(folder.name) / name for name in ('scene.yade.bin', 'changes.json', 'answers.json', 'log.txt'))
		try:
			O.save(str(scene), quiet=True)
			changes.write_text(json.dumps({'trials': trials, 'loads': _loads()}))
			file = open(log, 'w')
		except (OSError, RuntimeError) as error:  # YADE's own is a RuntimeError
			raise _unwritable(f'the scene to {scene}', error) from error
		command = [sys.executable, '-P', '-m', 'yade.polytope.requirements.worker', str(scene), str(changes), str(answers)]
		with file:
			subprocess.run(command, env=_builds.environment(_builds.present()), stdin=subprocess.DEVNULL, stdout=file, stderr=file)
		try:
			times = json.loads(answers.read_text())
		except (OSError, ValueError):
			times = {}
		if '' in times:
			return times, ''
		lines = log.read_text(errors='replace').split('\n')
		return {}, next((line.strip() for line in reversed(lines) if line.strip()), 'the measuring process ended without a message')


def _loads():
	"""As JSON: [body's id, force, torque]."""
	return [[k, [float(x) for x in force], [float(x) for x in torque]] for k, (force, torque) in permanentLoads().items()]


def _unwritable(what, error):
	return OSError(f'measure: cannot write {what} ({error}); set TMPDIR to a folder that can be written before Python starts, or measure=False')
