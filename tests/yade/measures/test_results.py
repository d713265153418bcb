# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures in README.md and docs are those of docs/results: a figure or a result changed alone is found, and a target missed is said."""

import json
import pathlib
import shutil
import subprocess
import sys

import pytest

project = pathlib.Path(__file__).resolve().parents[3]
program = project / 'tools/measure/results/results.py'


def results(*arguments):
	done = subprocess.run([sys.executable, program, *map(str, arguments)], capture_output=True, text=True, timeout=60)
	said = [line for line in (done.stdout + done.stderr).splitlines(keepends=True) if not line.startswith('no results of')]
	return done.returncode, ''.join(said)


@pytest.fixture
def root(tmp_path):
	"""A copy of the pages and the results."""
	shutil.copy(project / 'README.md', tmp_path)
	shutil.copytree(project / 'docs', tmp_path / 'docs', ignore=shutil.ignore_patterns('*.png'))
	return tmp_path


def changed(path, old, new):
	text = path.read_text()
	assert old in text
	path.write_text(text.replace(old, new))


def testPagesAreAsTheResultsSay():
	assert results('--check') == (0, '')


def testNoFigureLacksItsResult():
	"""One that looks for rows by names which the benchmark no longer has would say so in its page alone."""
	for page in (project / 'README.md', *(project / 'docs').glob('*.md')):
		assert 'ot measured<!-- end -->' not in page.read_text(), page.name


def testAFigureChangedAloneIsFound(root):
	changed(root / 'README.md', 'search.pairs -->', 'search.pairs -->1')
	assert results('--check', '--root', root) == (1, 'README.md differs from docs/results\n')
	assert results('--root', root) == (0, 'README.md written\n')
	assert (root / 'README.md').read_text() == (project / 'README.md').read_text()


def testNewResultsAreTakenOverWithAllTheirFigures(root, tmp_path):
	"""A defect in them is said, too."""
	log = tmp_path / 'log.txt'
	shutil.copy(root / 'docs/results/search.txt', log)
	changed(log, 'defects: miss 0,', 'defects: miss 3,')
	assert results('--take', 'search', log, '--root', root) == (0, 'README.md written\naccuracy.md written\n')
	for page in ('README.md', 'docs/accuracy.md'):
		assert '**miss: 3' in (root / page).read_text()
		assert 'none invented' not in (root / page).read_text()


def testUnknownFiguresAndOpenMarkersAreNamed(root):
	changed(root / 'README.md', 'from search.pairs', 'from search.pears')
	code, said = results('--check', '--root', root)
	assert code and "README.md: there is no figure 'search.pears'" in said
	changed(root / 'README.md', ' million<!-- end -->', ' million')
	code, said = results('--check', '--root', root)
	assert code and 'without <!-- end -->' in said


def findings(folder, **changes):
	"""What a script of `./run paper` leaves: one row that holds, one that does not, one that is only reported."""
	row = {'quantity': 'angle', 'unit': '°', 'paper': 33.2, 'theory': 33.5, 'ours': 33.25, 'accept': [33, 34], 'good': True, 'note': ''}
	rows = [row, {**row, 'quantity': 'height', 'ours': 35.0, 'good': False}, {**row, 'quantity': 'time', 'accept': None, 'good': None}]
	about = {
		'revision': '0123456789',
		'date': '2026-11-23',
		'machine': 'a machine',
		'cores': 2,
		'load': 0.1,
		'options': ['--quick'],
		'seconds': 3.0,
		**changes,
	}
	folder.mkdir(parents=True)
	(folder / 'findings.json').write_text(json.dumps({'letter': 'C', 'title': 'Wedge', 'rows': rows, 'good': False}))
	(folder / 'run.json').write_text(json.dumps({key: value for key, value in about.items() if value is not None}))


def testWhatTheStudiesFoundIsWrittenWithWhatIsMissed(root, tmp_path):
	"""For the paper's simulations and the studies of accuracy; a quick run and a busy machine are said."""
	findings(tmp_path / 'found/wedge', load=3.2)
	for name in ('paper', 'accuracy'):
		assert results('--take', name, tmp_path / 'found', '--root', root)[0] == 0
	text = (root / 'docs/six-simulations.md').read_text()
	assert '| angle | ° | 33.2 | 33.5 | 33.25 | -0.25 | 33 … 34 |' in text
	assert '| height | ° | 33.2 | 33.5 | **35 missed** | 1.5 | 33 … 34 |' in text
	for page in ('six-simulations', 'accuracy'):
		(line,) = (line for line in (root / f'docs/{page}.md').read_text().splitlines() if line.startswith('| C: Wedge |'))
		assert '| 1 of 2 | **height: 35 °, must be 33 … 34** |' in line
		assert all(part in line for part in ('revision 0123456', '**the quick variant**', 'busy'))
	assert results('--check', '--root', root)[0] == 0


def testErrorsOverFlushPiecesAreThoseOfTheResults(root):
	"""The errors of one measure, with both contacts and both rules; new data are found, and a limit that is missed is bold."""
	data = root / 'docs/results/accuracy.json'
	content = json.loads(data.read_text())
	(found,) = (script for script in content['scripts'] if script['name'] == 'surfaces')
	rows = [row for row in found['rows'] if row['quantity'].startswith('1 m/s over three joints: loss of speed: ')]
	page = root / 'docs/surfaces.md'
	shown = ' | '.join(f'{row["ours"]:.2g}' for row in rows)
	assert len(rows) == 4 and f'| 1 m/s over three joints: loss of speed [-] | 0 … 0.002 | {shown} |' in page.read_text()
	rows[1].update(ours=0.0123, good=False)
	data.write_text(json.dumps(content))
	assert results('--check', '--root', root)[0] == 1
	assert results('--root', root)[0] == 0 and '**0.012 missed**' in page.read_text()


def testTheMainRowsOfThePaperAreAllThere():
	"""The first table of docs/six-simulations.md leaves out what a script no longer finds."""
	scripts = json.loads((project / 'docs/results/paper.json').read_text())['scripts']
	found = {(script['letter'], row['quantity']) for script in scripts for row in script['rows']}
	sys.path.insert(0, str(program.parent))
	try:
		import findingsFigures
	finally:
		sys.path.pop(0)
	assert set(findingsFigures.ofThePaper) <= found


def testResultsWithoutARevisionAreNotTaken(root, tmp_path):
	findings(tmp_path / 'found/wedge', revision=None)
	code, said = results('--take', 'paper', tmp_path / 'found', '--root', root)
	assert code and 'does not say the revision' in said
	code, said = results('--take', 'bench', tmp_path / 'found', '--root', root)
	assert code and '--take bench' in said


def testScriptsThatWereNotRunAgainKeepTheirResults(root, tmp_path):
	findings(tmp_path / 'one/wedge')
	findings(tmp_path / 'one/beam')
	findings(tmp_path / 'two/beam', revision='abcdef0123', date='2026-11-24')
	for run in ('one', 'two'):
		assert results('--take', 'accuracy', tmp_path / run, '--root', root)[0] == 0
	scripts = {script['name']: script for script in json.loads((root / 'docs/results/accuracy.json').read_text())['scripts']}
	assert scripts['wedge']['revision'] == '0123456789' and scripts['beam']['revision'] == 'abcdef0123'


def testResultsOfARunInWhichAScriptFailedAreNotTaken(root, tmp_path):
	findings(tmp_path / 'found/wedge')
	findings(tmp_path / 'found/beam')
	(tmp_path / 'found/beam/findings.json').unlink()
	code, said = results('--take', 'paper', tmp_path / 'found', '--root', root)
	assert code and 'beam ended without findings' in said


def benchmark(folder):
	"""results.json as `./run bench` writes it, of three groups; those that were kept before would stay beside them."""
	(folder / 'docs/results/bench.json').unlink(missing_ok=True)

	def target(measure, bound, ratio, met, ours='0.26 µs', peer='0.37 µs'):
		group = 'shapes' if measure.startswith('body') else 'scenes' if '200 falling' in measure else 'kernels'
		return {'group': group, 'measure': measure, 'target': bound, 'ours': ours, 'peer': peer, 'ratio': ratio, 'met': met}

	rows = [
		target('touching, warm, cube', '≤ 0.4 × libccd MPR', 0.39, True),
		target('touching, warm, octahedron', '≤ 0.4 × libccd MPR (2 wrong)', 0.57, False),
	]
	rows += [
		target('touching, cold, stacked', 'reported, × libccd MPR', 1.9, None),
		target('body of a known shape, cube', '< 15 µs here', None, False, '16 µs', ''),
	]
	rows += [
		target(f'InteractionLoop per step, 200 falling, {name}', '≥ 60 × faster than Polyhedra', ratio, True)
		for name, ratio in (('cube', 83.4), ('icosahedron', 214))
	]
	machine = {
		'date': '2026-11-24T08:00:00+00:00',
		'revision': 'fedcba9876',
		'changed': False,
		'processor': 'a machine',
		'cores': 2,
		'system': 'x',
		'compiler': 'g++ 14',
	}
	machine.update(loadAverage=[0.1, 0.1, 0.1], instructionSet='AVX-512', flags=[])
	kernel = {
		'method': 'ours',
		'set': 'cube',
		'times': [1, 2, 3],
		'median': 2,
		'spread': 0.1,
		'wrong': 0,
		'pairs': 9,
		'pivots': 1,
		'iterations': 2,
		'contacts': 1,
	}
	features = {'bodies': 2000, 'microseconds': {'nothing': 100, 'contact area': 130}}
	found = {
		'groups': ['kernels', 'shapes', 'scenes'],
		'quick': False,
		'machine': machine,
		'notes': ['coal is missing.'],
		'targets': rows,
		'kernels': {'measurements': [kernel]},
		'features': features,
	}
	(folder / 'results.json').write_text(json.dumps(found))


def testTheBenchmarkIsWrittenWithTheTargetsThatAreMissed(root, tmp_path):
	"""Rows of one measure in one line; whatever stood there before is gone."""
	benchmark(tmp_path)
	assert results('--take', 'bench', tmp_path, '--root', root)[0] == 0
	text = (root / 'docs/performance.md').read_text()
	assert (
		'| touching, warm: cube, octahedron (2 wrong) | ≤ 0.4 × libccd MPR | 0.26, 0.26 µs | 0.37, 0.37 µs | 0.39, **0.57** | **1 of 2** |'
		in text
	)
	assert '| touching, cold: stacked | reported, × libccd MPR | 0.26 µs | 0.37 µs | 1.9 |  |' in text
	assert '| body of a known shape: cube | < 15 µs here | 16 µs |  | **missed** | **0 of 1** |' in text
	assert '| contact area | +30 % |' in text and 'Coal is missing.' in text and 'revision fedcba9;' in text
	assert ' '.join(text.split()).count('3 of 5 targets met') == 1
	assert 'before results were kept' not in text and 'not measured since' not in text
	assert '83 to 214 times faster' in (root / 'README.md').read_text()
	assert '"times"' not in (root / 'docs/results/bench.json').read_text()


def testAGroupOfTheBenchmarkThatIsMeasuredAgainTakesThePlaceOfItsRows(root, tmp_path):
	benchmark(tmp_path)
	assert results('--take', 'bench', tmp_path, '--root', root)[0] == 0
	found = json.loads((tmp_path / 'results.json').read_text())
	row = {
		'group': 'shapes',
		'measure': 'body of a known shape, cube',
		'target': '< 15 µs here',
		'ours': '12 µs',
		'peer': '',
		'ratio': None,
		'met': True,
	}
	for part in ('kernels', 'features'):
		del found[part]
	found.update(
		groups=['shapes'],
		targets=[row],
		notes=[],
		machine={**found['machine'], 'revision': 'abcdef0123', 'date': '2026-11-25T08:00:00+00:00', 'instructionSet': None},
	)
	(tmp_path / 'results.json').write_text(json.dumps(found))
	assert results('--take', 'bench', tmp_path, '--root', root)[0] == 0
	text = (root / 'docs/performance.md').read_text()
	assert '| body of a known shape: cube | < 15 µs here | 12 µs |  |  | 1 of 1 |' in text and '16 µs' not in text
	assert '| touching, cold: stacked |' in text and '| contact area | +30 % |' in text
	joined = ' '.join(text.split())
	assert '4 of 5 targets met' in joined and 'Kernels, scenes: a machine, 2 cores; 2026-11-24; revision fedcba9' in joined
	assert 'Shapes: a machine, 2 cores; 2026-11-25; revision abcdef0' in joined


def testTheTradeOffIsWritten(root, tmp_path):
	(tmp_path / 'summary.csv').write_text(
		'setting,cost: least,median,most,error C\ndefault,1,1,1,0.00341\nfast,0.5,0.51,nan,RuntimeError\n'
	)
	about = {
		'revision': '0123456789-dirty',
		'date': '2026-11-23',
		'machine': 'a machine',
		'cores': 2,
		'load': 0.1,
		'quick': False,
		'interrupted': False,
		'scenes': ['C'],
	}
	(tmp_path / 'origin.json').write_text(json.dumps(about))
	assert results('--take', 'tradeoff', tmp_path, '--root', root)[0] == 0
	text = (root / 'docs/settings.md').read_text()
	assert '| fast | 0.5 | 0.51 |  | **does not stand** |' in text and 'revision 0123456 with changes' in text


def testMutantsThatSurviveAreListed(root, tmp_path):
	"""One mutant is killed, one is not and nobody has judged it."""
	row = {
		'id': 1,
		'file': 'src/a/b.hpp',
		'line': 3,
		'column': 5,
		'kind': 'arithmetic',
		'original': '+',
		'mutant': '-',
		'source': 'x | y + z',
		'ran': ['core'],
		'reachedBy': 4,
	}
	mutants = [
		{**row, 'killedBy': 'Sum.Quick'},
		{**row, 'id': 2, 'line': 7, 'killedBy': None},
	]
	(root / 'docs/results/mutation.csv').unlink()
	(tmp_path / 'results.json').write_text(json.dumps({'revision': '0123456789', 'seed': 5, 'mutants': mutants}))
	assert results('--take', 'mutation', tmp_path / 'results.json', '--root', root)[0] == 0
	text = (root / 'docs/mutation.md').read_text()
	joined = ' '.join(text.split())
	assert '| src/a | 2 | 1 | 0 | **1** |' in text and '**50.0 %**' in joined and 'src/a: revision 0123456, seed 5' in joined
	assert '| src/a/b.hpp | `x \\| y + z` | `+` → `-` |  |' in text


def testMutantsOfAnotherRunStay(root, tmp_path):
	"""Mutants that the new run does not have stay, with their revision, if their line is still in the sources."""
	row = {'file': 'src/a/b.hpp', 'column': 5, 'kind': 'arithmetic', 'original': '+', 'mutant': '-', 'ran': ['core'], 'reachedBy': 4}
	(root / 'docs/results/mutation.csv').unlink()
	(root / 'src/a').mkdir(parents=True)
	(root / 'src/a/b.hpp').write_text('x =  y + z\nu = v + w')
	for revision, mutants in (
		('1111111', [('x = y + z', None), ('u = v + w', None), ('lost + y', None)]),
		('2222222', [('x = y + z', 'Sum.Quick')]),
	):
		found = [{**row, 'id': k, 'line': k, 'source': source, 'killedBy': by} for k, (source, by) in enumerate(mutants, 1)]
		(tmp_path / 'results.json').write_text(json.dumps({'revision': revision, 'seed': 5, 'mutants': found}))
		assert results('--take', 'mutation', tmp_path / 'results.json', '--root', root)[0] == 0
	text = (root / 'docs/mutation.md').read_text()
	assert 'src/a: revision 1111111, seed 5; src/a: revision 2222222, seed 5' in ' '.join(text.split())
	assert '| src/a | 2 | 1 | 0 | **1** |' in text and '`u = v + w`' in text and '`x = y + z`' not in text and 'lost' not in text


def testEveryResultIsShown():
	"""Every file in the folder is one that a figure comes from, too."""
	sys.path.insert(0, str(program.parent))
	try:
		import results as figures
	finally:
		sys.path.pop(0)
	assert {path.name for path in (project / 'docs/results').iterdir()} <= {file for _, file in figures.kinds.values()}
	text = ''.join(page.read_text() for page in (project / 'README.md', *(project / 'docs').glob('*.md')))
	assert [name for name in figures.figures if f'<!-- from {name} -->' not in text] == []
