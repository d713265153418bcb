# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.tradeoff, interrupted: what is measured is kept, and no process is left."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest
from yade import NewtonIntegrator, O, RockJointMat, polytope


def build(interrupt=False):
	O.reset()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1), material=RockJointMat()))
	O.engines, O.dt = [NewtonIntegrator()], 1e-3
	return interrupt


def measure(interrupt):
	O.step()
	if interrupt:
		(pathlib.Path(os.environ['POLYTOPE_TEST']) / str(os.getpid())).touch()
		os.kill(os.getppid(), signal.SIGINT)
		time.sleep(3600)  # longer than the waiting time for its end below
	return 1.0


def runs(process):
	try:
		return pathlib.Path(f'/proc/{process}/stat').read_text().rpartition(')')[2].split()[0] not in 'ZX'  # ended, not yet waited for
	except FileNotFoundError:
		return False


def testAnInterruptKeepsTheRowsAndEndsTheProcess(monkeypatch, tmp_path):
	monkeypatch.setenv('POLYTOPE_TEST', str(tmp_path))
	with pytest.raises(KeyboardInterrupt) as interrupt:
		polytope.tradeoff(build, {'a': {}, 'b': {'interrupt': True}, 'c': {}}, measure, 1, timedSeconds=0)
	table = interrupt.value.table
	assert table['a'].counts and [row.name for row in table.front()] == ['a']
	assert all('interrupted' in table[name].note for name in 'bc')
	worker, end = next(tmp_path.iterdir()).name, time.monotonic() + 300
	while runs(worker) and time.monotonic() < end:
		time.sleep(0.01)
	assert not runs(worker)


def testAKilledCallerLeavesNoProcess(tmp_path):
	script = tmp_path / 'killed.py'
	script.write_text(
		'import os, pathlib, time\n'
		'from yade import NewtonIntegrator, O, polytope\n'
		'def build():\n'
		'	O.engines, O.dt = [NewtonIntegrator()], 1e-3\n'
		'def measure():\n'
		f'	(pathlib.Path({str(tmp_path)!r}) / f"worker-{{os.getpid()}}").touch()\n'
		'	time.sleep(3600)\n'
		'if __name__ == "__main__":\n'
		'	polytope.tradeoff(build, {"a": {}}, measure, 1)\n'
	)
	caller = subprocess.Popen([sys.executable, script], cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
	until = time.time() + 600  # against waiting for ever; YADE has to start
	while not list(tmp_path.glob('worker-*')):
		assert time.time() < until and caller.poll() is None
		time.sleep(0.1)
	(name,) = (path.name for path in tmp_path.glob('worker-*'))
	caller.kill()
	caller.wait()
	while runs(name.split('-')[1]):
		assert time.time() < until
		time.sleep(0.1)
