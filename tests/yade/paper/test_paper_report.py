# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run paper` with small scripts in place of the six: what is run, what is skipped, what the report holds, how it ends."""

import csv
import importlib.util
import pathlib
import subprocess

import pytest
from boon2012.reporting.runs import sourceHash

path = pathlib.Path(__file__).resolve().parents[3] / 'examples' / 'paper' / 'report.py'
specification = importlib.util.spec_from_file_location('paperReport', path)
report = importlib.util.module_from_spec(specification)
specification.loader.exec_module(report)

# Writes findings as the real scripts do, without loading YADE; counts its runs. {ours} must be within 1 and 2.
script = '''"""A small script.

More about it."""
import importlib.util, pathlib, sys
folder = pathlib.Path(sys.argv[sys.argv.index('--output') + 1])
with open(pathlib.Path(__file__).with_suffix('.runs'), 'a') as runs:
	print(*sys.argv[1:-2], file=runs)
specification = importlib.util.spec_from_file_location('findings', {findings!r})
module = importlib.util.module_from_spec(specification)
specification.loader.exec_module(module)
findings = module.Findings('{letter}', 'Title of {letter}', folder)
findings.row('load <{letter}>', {ours}, 'N', paper=1.2, theory=1.25, accept=(1, 2), note='note on {letter}')
findings.text('Explanation of {letter}.')
findings.table('curve', 'Curve of {letter}', ['x [m]', 'kind'], [(0.123456789, 'face'), (2, 'edge')])
(folder / 'plot.png').write_bytes(b'picture of {letter}')
findings.figure(folder / 'plot.png', 'Figure of {letter}')
print('says {letter}')
{end}
sys.exit(0 if findings.save() else 1)
'''


class Project:
	"""Scripts X and Y, and the output folder."""

	def __init__(self, folder):
		self.folder, self.output = folder, folder / 'out'

	def write(self, letter, ours=1.5, end=''):
		findings = str(path.parent / 'boon2012/reporting/findings.py')
		(self.folder / f'{letter.lower()}_script.py').write_text(script.format(letter=letter, ours=ours, end=end, findings=findings))

	def run(self, *options):
		return report.main([*options, '--output', str(self.output)])

	def runs(self, letter):
		"""The options of each run so far."""
		record = self.folder / f'{letter.lower()}_script.runs'
		return record.read_text().splitlines() if record.exists() else []

	@property
	def html(self):
		return (self.output / 'report.html').read_text()

	@property
	def rows(self):
		with open(self.output / 'results.csv', newline='') as file:
			return list(csv.DictReader(file))


@pytest.fixture
def project(tmp_path, monkeypatch):
	monkeypatch.setattr(report, 'scripts', tmp_path)
	monkeypatch.setattr(report, 'simulations', {'X': ('x_script', 'First', ('--extra', '8')), 'Y': ('y_script', 'Second', ())})
	monkeypatch.setattr(report, 'sourceHash', lambda *_: 'one')
	made = Project(tmp_path)
	made.write('X')
	made.write('Y')
	return made


def testReportHoldsAllThatWasFound(project, capsys):
	assert project.run() == 0
	assert 'All that must hold does.' in capsys.readouterr().out
	html = project.html
	for letter in 'XY':
		for text in ('load &lt;{}&gt;', 'note on {}', 'Explanation of {}.', 'Curve of {}', 'Figure of {}'):
			assert text.format(letter) in html
		assert f'href="{letter.lower()}_script/curve.csv"' in html and (project.output / f'{letter.lower()}_script' / 'curve.csv').is_file()
	assert html.count('src="data:image/png;base64,') == 2
	assert '0.123457' in html and '+0.25' in html and '1 … 2' in html and 'A small script.' in html
	assert 'All 2 required rows hold.' in html and '✗' not in html
	row = project.rows[0]
	assert len(project.rows) == 2
	assert row == {
		'simulation': 'X',
		'title': 'Title of X',
		'quantity': 'load <X>',
		'unit': 'N',
		'paper': '1.2',
		'closed form': '1.25',
		'ours': '1.5',
		'difference': '0.25',
		'at least': '1',
		'at most': '2',
		'verdict': 'ok',
		'note': 'note on X',
	}


def testMissedRowEndsWithOneAndIsNamed(project, capsys):
	project.write('Y', ours=2.5)
	assert project.run() == 1
	assert 'Y: missed: load <Y>: 2.5 N, must be 1 … 2' in capsys.readouterr().out
	assert '1 of 2 required rows missed.' in project.html and project.html.count('✗ missed') == 2
	assert [row['verdict'] for row in project.rows] == ['ok', 'MISSED']
	assert project.run() == 1 and len(project.runs('Y')) == 1, 'a missed row is a result: no second run, and still missed'


def testFailedScriptEndsWithOneAndIsRunAgain(project, capsys):
	project.write('Y', end='raise RuntimeError("no such thing")')
	assert project.run('--jobs', '2') == 1
	assert 'Y: y_script.py ended with exit code 1' in capsys.readouterr().out
	assert 'Without a result: Y.' in project.html and 'RuntimeError: no such thing' in project.html and 'load &lt;X&gt;' in project.html
	project.write('Y')
	assert project.run() == 0
	assert len(project.runs('X')) == 1 and len(project.runs('Y')) == 2, 'goes on where it stood'


@pytest.mark.parametrize('end', ['findings.save(); sys.exit(3)', 'findings.save(); sys.exit(1)', 'sys.exit(0)', 'import os; os.abort()'])
def testExitCodeAndFindingsMustAgree(project, end):
	project.write('Y', end=end)
	assert project.run('--only', 'Y') == 1
	assert 'Without a result: Y.' in project.html


def testMissingScriptIsAFailure(project):
	(project.folder / 'y_script.py').unlink()
	assert project.run() == 1


def testCompleteRunsAreNotRunAgain(project, monkeypatch):
	assert project.run() == project.run() == 0
	assert project.runs('X') == ['--extra 8'] and project.runs('Y') == ['']
	assert project.run('--quick') == 0
	assert project.runs('X') == ['--extra 8', '--quick'], 'other options'
	assert project.run('--quick', '--fresh') == 0
	assert len(project.runs('X')) == 3
	monkeypatch.setattr(report, 'sourceHash', lambda *_: 'another')
	assert project.run('--quick') == 0
	assert len(project.runs('X')) == 4, 'other source'
	(project.output / 'x_script' / 'findings.json').write_text('{"letter"')
	assert project.run('--quick') == 0
	assert len(project.runs('X')) == 5 and len(project.runs('Y')) == 4, 'not whole'


def testOnlyTheLettersAskedFor(project):
	assert project.run('--only', 'y') == 0
	assert not project.runs('X') and 'load &lt;X&gt;' not in project.html and 'not asked for: X' in project.html
	assert [row['simulation'] for row in project.rows] == ['Y']
	assert project.run('--only', 'X') == 0 and len(project.runs('Y')) == 1, 'Y is complete'
	assert 'of an earlier call: Y' in project.html and [row['simulation'] for row in project.rows] == ['X', 'Y']


def testAnOutputThatCannotBeWrittenIsRefusedAtOnce(project, capsys):
	project.output = '/proc/nope'
	with pytest.raises(SystemExit) as refused:
		project.run()
	assert refused.value.code == 2 and '--output: cannot write to /proc/nope' in capsys.readouterr().err and not project.runs('X')


@pytest.mark.parametrize('options', [('--only', 'XZ'), ('--only', ''), ('--jobs', '0'), ('--nonsense',)])
def testNonsenseIsRefused(project, options):
	with pytest.raises(SystemExit) as refused:
		project.run(*options)
	assert refused.value.code == 2


def testLongTablesAreCut(project):
	project.write('X', end="findings.table('long', 'Long', ['x'], [(k + 0.5,) for k in range(1000)])")
	assert project.run('--only', 'X') == 0
	assert 'Long: 1000 rows, of which the first 300' in project.html
	assert '<td class="number">299.5</td>' in project.html and '300.5' not in project.html


def testSourceHashSeesAnyFile(tmp_path):
	for name in ('src/a.cpp', 'examples/paper/geometry/g.json'):
		(tmp_path / name).parent.mkdir(parents=True)
		(tmp_path / name).write_text('one')
	hashes = [sourceHash(tmp_path)]
	for name in ('src/a.cpp', 'examples/paper/geometry/g.json', 'src/new.hpp'):
		(tmp_path / name).write_text('two')
		hashes.append(sourceHash(tmp_path))
	assert len(set(hashes)) == 4
	(tmp_path / 'src' / '__pycache__').mkdir()
	(tmp_path / 'src' / '__pycache__' / 'a.pyc').write_text('compiled')
	assert sourceHash(tmp_path) == hashes[-1]
	assert sourceHash(tmp_path, [pathlib.Path('src/a.cpp')]) != hashes[-1]


def testTheReportsOwnFilesAreThere():
	"""Its own files are those that sourceHash() leaves out."""
	assert report.ofTheReport and all((path.parents[2] / name).is_file() for name in report.ofTheReport)


def testTheSixSimulationsAreKnown():
	names = {letter: name for letter, (name, _, _) in report.simulations.items()}
	assert ''.join(names) == 'ABCDEF'
	assert all(name.startswith(f'{letter.lower()}_') for letter, name in names.items())


@pytest.mark.parametrize('letter', report.simulations)
def testScriptRunsWithinYadeToo(letter):
	"""YADE executes it in its own namespace: `__file__` is YADE's there. The arguments behind its name and its exit code are its own."""
	name = path.parent / f'{report.simulations[letter][0]}.py'
	assert not [line for line in name.read_text().splitlines() if '__file__' in line.partition('#')[0]]
	done = subprocess.run(['yade', '-n', '-x', name, '--nonsense'], capture_output=True, text=True, timeout=1800)
	assert done.returncode == 2 and 'unrecognized arguments: --nonsense' in done.stderr, done.stderr
