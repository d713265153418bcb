# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the scripts of examples/paper: as a user does, or within this process, which saves loading YADE."""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys

import pytest

folder = pathlib.Path(__file__).resolve().parents[2] / 'examples/paper'


def run(name, where, *options):
	"""The script as a program of its own in the folder *where*, with --output out and one thread."""
	return subprocess.run(
		[sys.executable, folder / f'{name}.py', '--output', 'out', *options],
		cwd=where,
		env={**os.environ, 'OMP_NUM_THREADS': '1'},
		capture_output=True,
		text=True,
		timeout=1800,
	)


def runHere(name, where, monkeypatch, *options):
	"""Runs the script within this process; returns what main() does."""
	specification = importlib.util.spec_from_file_location(name, folder / f'{name}.py')
	script = importlib.util.module_from_spec(specification)
	specification.loader.exec_module(script)
	monkeypatch.setattr(sys, 'argv', [str(folder / f'{name}.py'), '--output', str(where / 'out'), *options])
	return script.main()


def expectRefusal(name, where, monkeypatch, capsys, options, message):
	"""The script ends with 2 and this *message*, and has written nothing."""
	with pytest.raises(SystemExit) as ended:
		runHere(name, where, monkeypatch, *options)
	assert ended.value.code == 2 and message in capsys.readouterr().err and not (where / 'out').exists()


def results(where):
	"""(findings, their rows by quantity) of a run in *where*."""
	content = json.loads((where / 'out/findings.json').read_text())
	return content, {row['quantity']: row for row in content['rows']}


def expectRangesOfTheWholeRun(rows, letter, but=()):
	"""Each row that a short run has in common with the whole run that docs/results keeps is judged by a range as wide, but those named in
	*but*; and by the same range, where it does not lie about what the run itself has measured."""
	kept = json.loads((folder.parents[1] / 'docs/results/paper.json').read_text())['scripts']
	whole = {row['quantity']: row for script in kept if script['letter'] == letter for row in script['rows']}
	common = [name for name, row in whole.items() if row['accept'] and name in rows and name not in but]
	assert len(common) > len([row for row in rows.values() if row['accept']]) / 2, common
	for name in common:
		(low, high), (lowest, highest) = rows[name]['accept'], whole[name]['accept']
		assert high - low == pytest.approx(highest - lowest, rel=1e-2, abs=1e-12), name
		assert low == pytest.approx(lowest, rel=1e-3, abs=1e-12), name
