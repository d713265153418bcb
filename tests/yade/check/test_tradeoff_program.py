# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run tradeoff`: its options, and what it writes when it is interrupted."""

import argparse
import os
import pathlib
import subprocess
import sys

import pytest
from yade.polytope.tradeoff.table import Row, TradeoffTable

project = pathlib.Path(__file__).resolve().parents[3]
paperScript = project / 'tools/measure/tradeoff/tradeoffPaper.py'


@pytest.mark.parametrize(
	('arguments', 'code', 'word'),
	[
		(['--only', 'Z'], 2, 'invalid choice'),
		(['--output', '/proc/nope'], 2, '--output: cannot write to /proc/nope'),
		(['--help'], 0, 'usage'),
		(['--only', 'B'], 1, 'configur'),
	],
)
def testOptionsAreReadBeforeAnythingIsBuilt(arguments, code, word, tmp_path):
	"""In a folder where building fails: only good options get as far as that."""
	for name in ('examples', 'tools'):
		(tmp_path / name).symlink_to(project / name)
	own = {name: str(tmp_path / name) for name in ('cache', 'logs', 'yadeSource')}
	for folder in own.values():
		pathlib.Path(folder).mkdir()
	environment = {**os.environ, **own, 'project': str(tmp_path), 'buildKey': 'none'}
	command = ['bash', str(tmp_path / 'tools/inside.sh'), 'tradeoff', *arguments]
	ended = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True)
	assert ended.returncode == code and word in (ended.stdout + ended.stderr).lower(), ended.stdout + ended.stderr
	assert (tmp_path / 'build').exists() == (code == 1)


@pytest.mark.parametrize(
	('arguments', 'precisions'), [('--only A', 'longdouble'), ('--only B', 'longdouble float128 mpfr150'), ('--quick', '')]
)
def testOnlyThePrecisionsThatAreAskedForAreBuilt(arguments, precisions):
	command = [sys.executable, str(paperScript), *arguments.split(), '--precisions']
	said = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
	assert [line for line in said if not line.startswith('Using python')] == precisions.split()


def testLettersAreThoseOfTheScenes(monkeypatch):
	monkeypatch.syspath_prepend(str(paperScript.parent))
	import tradeoffPaper
	from tradeoffAxes import allScenes

	assert list(tradeoffPaper.letters) == list(allScenes())


def tableOf(**answers):
	rows = [Row(name, {}) for name in answers]
	for row, answer in zip(rows, answers.values(), strict=True):
		times = {'stepMicroseconds': 1, 'contactMicroseconds': 1, 'contacts': 1, 'timeStep': 1, 'seconds': 1, 'fallbacks': 0, 'failures': 0}
		row.take({'values': {'x': repr(answer)}, **times} if answer else {'error': 'interrupted before it was run'})
	return TradeoffTable(rows, 1.0)


@pytest.fixture
def program(monkeypatch, tmp_path):
	monkeypatch.syspath_prepend(str(paperScript.parent))
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
