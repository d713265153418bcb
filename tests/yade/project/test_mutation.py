# SPDX-License-Identifier: GPL-2.0-or-later
"""tools/measure/mutation: places are found, all mutants stand in one program, and each changes what its name says and nothing else."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

folder = pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/mutation'
sys.path.append(str(folder))
from mutation import chosen
from schemata import namedIn, project
from sites import Mutant, sites, written

source = '''#include <cstdio>
// a comment + b
double value(double a, double b, int n)
{
	double x = a + b * 2 - b / a;
	if (a < b) x += a;
	if (n == 3) return -x;
	/* c - d */ const char* text = "a - b";
	double y[1 + 1] = {};
	for (int i = 0; i < n; ++i)
		x -= b + y[n * 0];
	return text ? x : a;
}
int main() { std::printf("%g %g %g", value(2, 3, 1), value(3, 2, 3), value(2, 2, 0)); }
'''
kinds = '+ -|- +|* /|/ *|< >|< <=|< >=|+= -=|== !=|- |2 2 + 1|2 2 - 1|3 3 + 1|3 3 - 1'.split('|')
"""Mutants of the first lines: original and what stands in its place."""
arrays = 9
"""Line of the source from which on indices are counted; the places that follow are not looked at here."""


def printed(folder, text, environment=None, options=()):
	"""What a program of this source prints."""
	file = folder / 'program.cpp'
	file.write_text(text)
	subprocess.run(['c++', '-std=c++17', *options, file, '-o', folder / 'program'], check=True, timeout=120)
	return subprocess.run([folder / 'program'], env=environment, capture_output=True, text=True, timeout=10).stdout


@pytest.fixture(scope='module')
def mutants(tmp_path_factory):
	path = tmp_path_factory.mktemp('mutants') / 'sample.cpp'
	path.write_text(source)
	found = []
	for *place, others, text in sites(path, 'sample.cpp'):
		found += [(place, other, text) for other in others]
	return path, [Mutant(i + 1, *place, other, text) for i, (place, other, text) in enumerate(found)]


def testPlacesAreFoundInCodeAlone(mutants):
	"""There are none in comments, messages and loops over indices."""
	_, found = mutants
	assert [f'{mutant.original} {mutant.mutant}' for mutant in found if mutant.line == 8] == []
	assert {f'{mutant.original} {mutant.mutant}' for mutant in found if mutant.line < arrays} == set(kinds)
	assert [mutant.original for mutant in found if mutant.line == arrays] == []


@pytest.mark.skipif(not shutil.which('c++'), reason='no compiler')
def testEachMutantIsTheProgramThatItsNameSays(mutants, tmp_path):
	"""With one mutant of each place in it and one switched on, as the source with that one operator, sign or number changed."""
	path, found = mutants
	original = printed(tmp_path, source)
	left = [mutant for mutant in found if mutant.line < arrays]
	while left:
		some = list({(mutant.line, mutant.column): mutant for mutant in left}.values())
		left = [mutant for mutant in left if mutant not in some]
		options = ['-include', folder / 'Switch.hpp']
		assert printed(tmp_path, written(source, some), options=options) == original
		shutil.move(tmp_path / 'program', tmp_path / 'all')
		for mutant in some:
			lines = source.split('\n')
			line, end = lines[mutant.line - 1], mutant.column + len(mutant.original)
			new = f'({mutant.mutant})' if mutant.kind == 'constant' else mutant.mutant
			lines[mutant.line - 1] = f'{line[: mutant.column]}{new}{line[end:]}'
			reached = tmp_path / 'reached'
			environment = {**os.environ, 'POLYTOPE_MUTANT': str(mutant.id), 'POLYTOPE_MUTANTS_REACHED': str(reached)}
			said = subprocess.run([tmp_path / 'all'], env=environment, capture_output=True, text=True, timeout=10).stdout
			assert said == printed(tmp_path, '\n'.join(lines)) != original, mutant
			assert str(mutant.id) in reached.read_text().split()


def testMutantsArePickedInAllFoldersOfTheCore():
	folders = {str(path.parent.relative_to(project)) for path in chosenFiles(10**6)}
	assert {str(path.relative_to(project)) for path in (project / 'src').iterdir() if path.is_dir()} <= folders
	assert {name.split('/')[0] for name in folders} == {'src', 'pkg'}


def testMutantsArePickedInTheFilesAskedFor():
	assert {path.parent.name for path in chosenFiles(40, ['src/shear/', 'src/bond/'])} == {'shear', 'bond'}
	assert {path.name for path in chosenFiles(40, ['RockJointLaw'])} == {'RockJointLaw.cpp'}


def chosenFiles(count, *files):
	"""Files of so many mutants."""
	mutants = chosen(count, 1, *files)
	assert len(mutants) == count or count == 10**6
	return [project / mutant.file for mutant in mutants]


def testMutantsThatDoNotCompileAreNamedByTheMessages():
	"""Messages are on the line of the error, beside it, or where a template was asked for."""

	def mutant(number, line):
		return Mutant(number, 'src/a.hpp', line, 0, 'arithmetic', '+', '-', '')

	messages = '''In file included from /t/src/b.cpp:3:
/t/src/a.hpp:7:3:   required from here
/t/src/other.hpp:1:2: error: no match
/t/src/a.hpp:8:1: warning: unused
../src/a.hpp:20:1: error: no match
/t/src/a.hpp:30:1: error: no match'''
	found = namedIn(messages, pathlib.Path('/t'), [mutant(1, 7), mutant(2, 8), mutant(3, 20), mutant(4, 21), mutant(5, 32)])
	assert [entry.id for entry in found] == [1, 3, 5]


pretended = '''#!{python}
import os, sys, time
if '--gtest_list_tests' in sys.argv:
	sys.exit(print('Sum.\\n  Quick\\n  Slow'))
mutant = int(os.environ['POLYTOPE_MUTANT'])
for name in sys.argv[-1].split('=')[1].split(':'):
	print('[ RUN      ]', name, flush=True)
	while name == 'Sum.Slow' and time.process_time() < .5: pass
	if mutant == 1 and name == 'Sum.Slow': sys.exit(print('[  FAILED  ]', name, '(3 ms)') or 1)
	if mutant == 2: os.abort()
	while mutant == 3: pass
	if mutant == 4: bytearray(1 << 40)
	if 'POLYTOPE_MUTANTS_REACHED' in os.environ: open(os.environ['POLYTOPE_MUTANTS_REACHED'], 'w').write('1 2 3 4 5' if name == 'Sum.Slow' else '2 3 4')
'''
"""Program with two tests. Mutants: 1 fails the slow one, 2 crashes, 3 does not end, 4 wants too much memory, 5 is noticed by none, 6 is not
reached."""


def testVerdicts(tmp_path, monkeypatch):
	import killers

	program, said = tmp_path / 'tests', []
	program.write_text(pretended.replace('{python}', sys.executable))
	program.chmod(0o755)
	monkeypatch.setattr(killers, 'patience', 0)
	tests = killers.CoreTests(program)
	tests.measure(said.append)
	assert list(tests.times) == ['Sum.Quick', 'Sum.Slow'] and tests.times['Sum.Slow'] > 0.4
	assert tests.reaching == {1: ['Sum.Slow'], 5: ['Sum.Slow'], **{k: ['Sum.Quick', 'Sum.Slow'] for k in (2, 3, 4)}}
	again = killers.CoreTests(program)
	again.measure(said.append)
	assert (again.times, again.reaching) == (tests.times, tests.reaching)
	found = [tests.verdict(mutant) for mutant in range(1, 7)]
	assert found == ['Sum.Slow', 'Sum.Quick (ends with -6)', 'Sum.Quick (no end)', 'Sum.Quick (ends with 1)', None, None]
