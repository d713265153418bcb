# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run figures --measure NAME`: runs that command, and takes over what it wrote unless it failed. The commands are stand-ins here."""

import os
import pathlib
import shutil
import subprocess

import pytest

source = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def project(tmp_path):
	"""A command that says how it was called and ends with $ends, and a program that says what it is to take over."""
	folder = tmp_path / 'a project'
	(folder / 'tools/measure/results').mkdir(parents=True)
	for name in ('messages.sh', 'figures.sh'):
		shutil.copy(source / 'tools' / name, folder / 'tools')
	(folder / 'tools/inside.sh').write_text('printf "<%s>" ran "$@"; echo; exit "$ends"\n')
	(folder / 'tools/measure/results/results.py').write_text('import sys\nprint("takes", sys.argv[1:])\n')
	return folder


def figures(project, *arguments, code=0):
	command = '. "$project/tools/messages.sh"; . "$project/tools/figures.sh"; figures "$@"'
	environment = {**os.environ, 'project': str(project), 'ends': str(code)}
	return subprocess.run(
		['bash', '-euo', 'pipefail', '-c', command, 'figures', *arguments], env=environment, capture_output=True, text=True, timeout=60
	)


@pytest.mark.parametrize(
	'name, option, ending',
	[
		('bench', '--output', ''),
		('tradeoff', '--output', ''),
		('accuracy', '--output', ''),
		('paper', '--output', ''),
		('search', '--log', '.txt'),
	],
)
@pytest.mark.parametrize('code', [0, 1])
def testWhatIsMeasuredIsTakenOver(project, name, option, ending, code):
	into = f'{project}/output/figures/{name}{ending}'
	done = figures(project, '--measure', name, '--quick', code=code)
	assert done.returncode == 0, done.stderr
	assert done.stdout.splitlines() == [f'<ran><{name}><--quick><{option}><{into}>', f"takes {['--take', name, into]}"]


@pytest.mark.parametrize('code', [2, 130])
def testARunThatFailedOrWasInterruptedIsNot(project, code):
	done = figures(project, '--measure', 'bench', code=code)
	assert done.returncode == 1 and str(code) in done.stderr and 'takes' not in done.stdout


@pytest.mark.parametrize('arguments', [['--measure'], ['--measure', 'nothing']])
def testUnknownMeasurementsAreRefused(project, arguments):
	done = figures(project, *arguments)
	assert done.returncode == 1 and 'bench, tradeoff' in done.stderr and not done.stdout


def testOtherOptionsGoToTheProgram(project):
	assert figures(project, '--check').stdout == "takes ['--check']\n"
