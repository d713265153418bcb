# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.tradeoff and `./run tradeoff`, interrupted: what is measured is kept, and no process is left."""

import argparse
import os
import pathlib
import signal
import time

import pytest
from yade import NewtonIntegrator, O, RockJointMat, polytope
from yade.polytope.tradeoffTable import Row, TradeoffTable

examples = pathlib.Path(__file__).resolve().parents[2] / 'examples'


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
		time.sleep(300)
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
	worker, end = next(tmp_path.iterdir()).name, time.monotonic() + 10
	while runs(worker) and time.monotonic() < end:
		time.sleep(0.01)
	assert not runs(worker)


def tableOf(**answers):
	rows = [Row(name, {}) for name in answers]
	for row, answer in zip(rows, answers.values(), strict=True):
		times = {'stepMicroseconds': 1, 'contactMicroseconds': 1, 'contacts': 1, 'timeStep': 1, 'seconds': 1, 'fallbacks': 0, 'failures': 0}
		row.take({'values': {'x': repr(answer)}, **times} if answer else {'error': 'interrupted before it was run'})
	return TradeoffTable(rows, 1.0)


@pytest.fixture
def program(monkeypatch, tmp_path):
	monkeypatch.setenv('POLYTOPE_GEOMETRY', str(examples / 'paper/geometry'))
	monkeypatch.syspath_prepend(str(examples))
	import tradeoffPaper

	def run(*tables):
		"""Scenes C, D, F in turn; the last of the tables is that of an interrupted one."""
		waiting = list(tables)

		def tradeoff(*_, **__):
			table = waiting.pop(0)
			if not waiting:
				interrupt = KeyboardInterrupt()
				interrupt.table = table
				raise interrupt
			return table

		monkeypatch.setattr(tradeoffPaper, 'tradeoff', tradeoff)
		return tradeoffPaper.main(argparse.Namespace(quick=True, only=['C', 'D', 'F'], output=tmp_path))

	return run


def testTheProgramReportsWhatIsMeasured(program, tmp_path, capsys):
	assert program(tableOf(default=1.01, fast=1.02), tableOf(default=1.01, fast=None)) == 130
	page = (tmp_path / 'report.html').read_text()
	assert 'id="C"' in page and 'id="D"' in page and 'id="F"' not in page and 'interrupted: not all' in page
	assert 'interrupted before it was run' in page and 'kept, not run: F.' in capsys.readouterr().err
	assert (tmp_path / 'summary.csv').is_file()


def testTheProgramInterruptedAtOnceWritesNothing(program, tmp_path, capsys):
	assert program(tableOf(default=None, fast=None)) == 130
	assert not list(tmp_path.iterdir()) and 'not run: C, D, F.' in capsys.readouterr().err
