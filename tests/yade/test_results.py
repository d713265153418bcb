# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures in README.md and docs are those of docs/results: a figure or a result changed alone is found, and a target missed is said."""

import pathlib
import shutil
import subprocess
import sys

import pytest

project = pathlib.Path(__file__).resolve().parents[2]
program = project / 'tools/measure/results/results.py'


def results(*arguments):
	done = subprocess.run([sys.executable, program, *map(str, arguments)], capture_output=True, text=True, timeout=60)
	return done.returncode, done.stdout + done.stderr


@pytest.fixture
def root(tmp_path):
	"""A copy of the pages and results."""
	shutil.copy(project / 'README.md', tmp_path)
	shutil.copytree(project / 'docs', tmp_path / 'docs', ignore=shutil.ignore_patterns('*.png'))
	return tmp_path


def changed(path, old, new):
	text = path.read_text()
	assert old in text
	path.write_text(text.replace(old, new))


def testPagesAreAsTheResultsSay():
	assert results('--check') == (0, '')


def testAFigureChangedAloneIsFound(root):
	changed(root / 'README.md', 'search.pairs -->10 million', 'search.pairs -->11 million')
	assert results('--check', '--root', root) == (1, 'README.md differs from docs/results\n')
	assert results('--root', root) == (0, 'README.md written\n')
	assert (root / 'README.md').read_text() == (project / 'README.md').read_text()


def testNewResultsAreTakenOverWithAllTheirFigures(root, tmp_path):
	"""And a defect in them is said."""
	log = tmp_path / 'log.txt'
	shutil.copy(root / 'docs/results/search.txt', log)
	changed(log, 'defects:      miss 0,', 'defects:      miss 3,')
	assert results('--take', 'search', log, '--root', root) == (0, 'README.md written\naccuracy.md written\n')
	for page in ('README.md', 'docs/accuracy.md'):
		assert '**miss: 3**' in (root / page).read_text()
		assert 'none invented' not in (root / page).read_text()


def testUnknownFiguresAndOpenMarkersAreNamed(root):
	changed(root / 'README.md', 'from search.pairs', 'from search.pears')
	code, said = results('--check', '--root', root)
	assert code and "README.md: there is no figure 'search.pears'" in said
	changed(root / 'README.md', '10 million<!-- end -->', '10 million')
	code, said = results('--check', '--root', root)
	assert code and 'without <!-- end -->' in said


def testEveryResultIsShown():
	"""And every file in the folder is one that a figure comes from."""
	sys.path.insert(0, str(program.parent))
	try:
		import figures
	finally:
		sys.path.pop(0)
	assert {path.name for path in (project / 'docs/results').iterdir()} == set(figures.results.values())
	text = ''.join(page.read_text() for page in (project / 'README.md', *(project / 'docs').glob('*.md')))
	assert [name for name in figures.figures if f'<!-- from {name} -->' not in text] == []
