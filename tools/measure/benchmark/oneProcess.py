# SPDX-License-Identifier: GPL-2.0-or-later
"""A measuring program in a process of its own, on one core and with one thread."""

import json
import os
import pathlib
import subprocess
import sys


def run(script, core, quick):
	"""What the measure() of this script found.

	:param str script: a program that ends with report(measure)
	:param int core: the only one it may use
	:raises RuntimeError: with the last lines that it printed, if it fails
	"""
	script = pathlib.Path(script).resolve()
	command = ['taskset', '-c', str(core), sys.executable, str(script), 'quick' if quick else 'full']
	output = subprocess.run(command, env=dict(os.environ, OMP_NUM_THREADS='1'), capture_output=True, text=True, timeout=3600)
	lines = [line for line in output.stdout.splitlines() if line.startswith('RESULT ')]
	if output.returncode or not lines:
		raise RuntimeError(f'{script.name}: ' + ' '.join((output.stderr or output.stdout).split('\n')[-4:]))
	return json.loads(lines[-1][len('RESULT ') :])


def report(measure):
	"""The end of such a script: prints what measure(quick) finds."""
	print('RESULT', json.dumps(measure(sys.argv[1] == 'quick')), flush=True)
	os._exit(0)  # YADE's own clean-up at exit is not measured
