# SPDX-License-Identifier: GPL-2.0-or-later
"""The scripts of examples/peers/: they run, at reduced size and time, do what their originals show, and are not longer."""

import ast
import csv
import io
import pathlib
import re
import sys
import tokenize

import numpy as np
import pytest
import yade
import yade.utils
from yade import O, polytope

project = pathlib.Path(__file__).resolve().parents[3]
folder = project / 'examples/peers'
originals = pathlib.Path('/usr/share/doc/yade/examples')  # of Debian's package yade


def codeLines(text):
	"""Lines that are neither blank nor comment nor doc string."""
	doc = set()
	for node in ast.walk(ast.parse(text)):
		if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
			doc |= set(range(node.lineno, node.end_lineno + 1))
	lines = set()
	for token in tokenize.generate_tokens(io.StringIO(text).readline):
		if token.type not in (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER):
			lines |= set(range(token.start[0], token.end[0] + 1))
	return len(lines - doc)


def table():
	with open(folder / 'originals.csv') as file:
		return list(csv.DictReader(file))


@pytest.fixture
def runs(tmp_path, monkeypatch):
	"""runs(name, {text: other}): the script's names after it has run as in YADE, in an empty folder."""
	monkeypatch.chdir(tmp_path)
	main = vars(sys.modules['__main__'])  # where PyRunner's commands run
	before = dict(main)

	def run(name, shorter=()):
		text = (folder / f'{name}.py').read_text()
		for long, short in dict(shorter).items():
			assert text.count(long) == 1, f'{name}.py has no {long!r} any more'
			text = text.replace(long, short)
		main.update({**vars(__import__('math')), **{k: v for k, v in {**vars(yade), **vars(yade.utils)}.items() if k[0] != '_'}})
		exec(compile(text, name, 'exec'), main)
		return dict(main)

	yield run
	main.clear()
	main.update(before)


@pytest.fixture(autouse=True)
def drawn(monkeypatch):
	"""Names of the pictures, which are not drawn here."""
	names = []
	monkeypatch.setattr(polytope, 'picture', lambda path, **settings: names.append(path))
	return names


def failures():
	loop = next(engine for engine in O.engines if isinstance(engine, yade.InteractionLoop))
	return sum(functor.stats()['failures'] for functor in loop.geomDispatcher.functors if hasattr(functor, 'stats'))


def free():
	return [body.state for body in O.bodies if body.dynamic]


# ------------------------------------------------------------------------------------------------ lengths


@pytest.mark.parametrize('row', table(), ids=lambda row: row['original'])
def testScriptIsNotLongerThanItsOriginal(row):
	text = (folder / row['script']).read_text()
	assert row['original'].split('/')[-1] in text, 'the script names its original'
	assert codeLines(text) == int(row['ours']) <= int(row['lines'])
	if originals.is_dir():
		assert codeLines((originals / row['original']).read_text()) == int(row['lines'])


def testEveryScriptIsInTheTableAndRun():
	assert {row['script'] for row in table()} == {path.name for path in folder.glob('*.py')}
	tests = re.sub(r'\(\s+', '(', pathlib.Path(__file__).read_text())
	assert all(f"runs('{path.stem}'" in tests for path in folder.glob('*.py'))
	page = (project / 'docs/from-other-codes.md').read_text()
	for row in table():
		assert f'| `{row["original"]}` | {row["lines"]} | `{row["script"]}` | {row["ours"]} |' in page


def testCodeLinesAreCounted():
	assert codeLines('"""Doc\nstring."""\n# comment\n\na = 1  # one\nb = (\n\t2,\n)\n') == 4


# ------------------------------------------------------------------------------------------------ potential blocks and particles


def testPackingsStayInTheirContainers(runs, drawn):
	short = {'number = 200': 'number = 12'}
	runs('cuboidal_packing', {**short, 'O.time < 3': 'O.time < 0.3', 'O.run(1000': 'O.run(300'})
	states = free()
	assert len(states) == 12 and all(max(abs(x) for x in state.pos) < 1 for state in states) and failures() == 0
	assert min(state.vel[2] for state in states) < -1, 'they fall'
	O.reset()
	runs('cylindrical_packing', {**short, 'O.time < 2': 'O.time < 0.3', 'O.run(1000': 'O.run(300'})
	states = free()
	assert 2 < len(states) <= 12 and all(np.hypot(state.pos[0], state.pos[1]) < 0.5 and state.pos[2] > 0 for state in states)
	assert failures() == 0 and drawn == ['cuboidal_packing.png', 'cylindrical_packing.png']


def testColumnOfDrumsStandsAtFirst(runs):
	names = runs('multidrum_column', {'O.time < 1': 'O.iter < 200', 'O.run(1000': 'O.run(100'})
	heights = [state.pos[2] for state in free()]
	assert heights == sorted(heights) and heights[-1] == pytest.approx(12 * 1.008 + 1.28 / 3, abs=0.1) and failures() == 0
	drums = [body.shape.volume for body in list(O.bodies)[:12]]
	assert drums[:10] == sorted(drums[:10], reverse=True) and drums[9:] == pytest.approx([drums[9], drums[9], drums[8]], rel=1e-12)
	assert O.bodies[names['base']].state.pos[0] == pytest.approx(
		0.1 * (np.cos(6 * np.pi * O.time + np.pi / 2) - np.cos(np.pi / 2)), abs=1e-3
	)


def testStandardShapesHaveTheirSizes(runs, drawn):
	runs('standard_shapes')
	shapes = [body.shape for body in O.bodies]
	assert len(shapes) == 30 and drawn == ['standard_shapes.png']
	assert shapes[0].volume == pytest.approx((0.05 / 3**0.5) ** 3) == shapes[1].volume
	assert [len(shape.normals) for shape in shapes[2:7]] == [4, 6, 8, 12, 20]
	edge = min((v - shapes[8].vertices[0]).norm() for v in shapes[8].vertices[1:])
	assert (shapes[7].volume, edge, shapes[9].inscribedRadius) == tuple(map(pytest.approx, (1e-5, 0.01, 0.01)))
	assert shapes[11].vertices[0].norm() == pytest.approx(0.01)
	# a cube's edges are √2/2 of its edge from the centre
	assert shapes[3].volume == pytest.approx((0.01 * 2**0.5) ** 3)
	assert [len(shape.normals) for shape in shapes[12::3]] == [5, 6, 7, 8, 9, 10]


def testPieceOfTheTowerIsPutOnTop(runs):
	runs('JengaTower', {'O.time < 2': 'O.time < 0.03'})
	assert len(O.bodies) == 55 and all(body is not None for body in O.bodies) and failures() == 0
	assert O.bodies[11].state.pos[2] == pytest.approx(18.5 * 0.015, abs=0.01) and O.bodies[10].state.pos[2] == pytest.approx(
		18.5 * 0.015, abs=0.01
	)


def testCutFreesTheRock(runs, capsys):
	names = runs(
		'WedgeYADE',
		{
			'O.time < 1': 'O.time < 0.02',
			'spacing=10,': 'spacing=20,',
			'O.time < 3': 'O.time < 0.1',
			'O.run(100, wait=True)\nleft': 'O.run(20, wait=True)\nleft',
		},
	)
	blocks = names['blocks']
	assert len(blocks) > 20 and sum(body.shape.volume for body in O.bodies if body.dynamic) == pytest.approx(40**3 / 2, rel=0.02)
	assert all(state.refPos[1] >= state.refPos[0] for state in names['left']) and failures() == 0
	assert f'{len(names["left"])} blocks behind the cut' in capsys.readouterr().out
	assert 1e-5 < max((state.pos - state.refPos).norm() for state in names['left']) < 1


def testCubesFallThroughTheOpenedFloor(runs):
	short = {'number = 100': 'number = 12', 'O.time < 10': 'O.time < 1.6', 'O.time > 5': 'O.time > 0.02', 'O.run(500': 'O.run(100'}
	names = runs('cubePBscaled', {**short, '7 * height': '5'})
	assert names['fallen'] + len(free()) == 12 and names['fallen'] == names['plot'].data['fallen'][-1] > 0
	assert min(state.pos[1] for state in free()) > -5.5 and O.bodies[names['lid']] is None and failures() == 0
	O.reset()
	names = runs('cubePPscaled', {**short, '98, 4.25': '5, 4.25'})
	assert 0 < len(free()) < 12 and O.bodies[names['lid']] is None and failures() == 0
	assert O.engines[2].geomDispatcher.functors[0].contactModel == 'boon2012'


# ------------------------------------------------------------------------------------------------ polyhedra


@pytest.mark.parametrize('name, size', [('ball', 0.025), ('irregular', 0.03)])
def testGrainComesToRestOnTheWall(name, size, runs):
	if name == 'ball':
		runs('ball', {'vertices=100': 'vertices=100, seed=1'})  # one of thirty still rolls after a second
	else:
		runs('irregular')
	grain = O.bodies[1]
	assert 0.5 * size < grain.state.pos[2] < 1.2 * size and failures() == 0
	assert grain.state.vel.norm() < 0.05


def testBallIsShotAtTheWall(runs, drawn):
	runs('wall', {'size, number = 0.1, 10': 'size, number = 0.1, 3', '7 * size': '2 * size', 'shot + 0.3': 'shot + 0.03'})
	assert len(O.bodies) == 11 and failures() == 0
	cubes = list(O.bodies)[:9]
	assert max(body.state.vel[0] for body in cubes) > 1 and O.bodies[10].state.vel[0] < 14
	assert drawn == ['wall.png']


def testGrainsFallOnThePlate(runs):
	runs('free-fall', {'number = 150': 'number = 10', 'O.time < 0.5': 'O.time < 0.1'})
	assert len(O.bodies) == 11 and failures() == 0
	sizes = [sorted(np.ptp(np.array(body.shape.vertices, float), axis=0))[1] for body in list(O.bodies)[1:]]
	assert 0.02 < min(sizes) and max(sizes) < 0.055


@pytest.mark.skipif(not originals.is_dir(), reason="YADE's examples, with the horse, are not installed")
def testHorseFallsOnAHorse(runs):
	runs('horse', {'O.time < 0.01': 'O.iter < 20', 'O.run(50': 'O.run(10'})
	tetrahedra = [body.shape.volume for body in O.bodies if isinstance(body.shape, yade.Polytope)]
	assert len(tetrahedra) == 1988 and min(tetrahedra) > 0
	spheres = free()
	assert len(spheres) > 100 and np.mean([state.vel[2] for state in spheres]) < 0
	assert O.energy['kinetic'] > 0 and failures() == 0


def testSpheresBounceOffTheGrain(runs):
	names = runs('sphere-interaction', {'O.time < 0.2': 'O.time < 0.1'})
	away = [O.bodies[k].state for k in names['spheres']]
	assert O.bodies[names['grain']].state.vel.norm() == 0 and failures() == 0
	assert any(state.vel.dot(state.pos) > 0 and state.pos.norm() < 6 for state in away)


def testWeakGrainsBreakIntoMorePieces(runs):
	names = runs('splitter', {'O.time < 0.03': 'O.time < 0.026'})
	counts = [len(ids) for ids in names['pieces'].values()]
	assert counts == sorted(counts, reverse=True) and counts[0] > 1 and failures() == 0
	for ids in names['pieces'].values():
		assert sum(O.bodies[k].shape.volume for k in ids) == pytest.approx(names['volume'], rel=1e-10)


def testGrainsAreWritten(runs):
	runs('textExport')
	assert len(O.bodies) > 20 and len(polytope.readShapes('textPolyhedra.txt')) == len(O.bodies)


def testClumpTakesTheHeavyBodysProperties(runs):
	names = runs('clump', {'O.time < 2': 'O.time < 0.05'})
	clump, body = names['clump'], names['body'].state
	assert clump.mass == pytest.approx(2 * 2600) == body.mass and (clump.pos - body.pos).norm() < 1e-9
	assert sorted(clump.inertia) == pytest.approx(sorted(body.inertia), rel=1e-9)
	fallen = O.bodies[names['number']].state
	assert fallen.pos[2] == pytest.approx(5 - 0.8 * 9.81 * O.time**2 / 2, abs=0.02) and fallen.mass == pytest.approx(3 * 2600)


def testGapClosesAsTheGrainsMove(runs, capsys):
	runs('interactionDetectionFactor', {'O.time < 2.5': 'O.time < 1'})
	rows = [line.replace(',', '').split() for line in capsys.readouterr().out.splitlines() if line.startswith('time')]
	times, gaps = (np.array([float(row[k]) for row in rows]) for k in (1, 3))
	assert len(rows) > 3 and (np.diff(gaps) > 0).all() and gaps[-1] < 0
	assert np.diff(gaps) == pytest.approx(np.diff(times), rel=0.2), 'they approach by 1 m/s, nearly along the normal'


@pytest.mark.parametrize('scGeom', [True, False])
def testCubesCollideWithBothLaws(scGeom, runs):
	runs('scGeom', {'scGeom = True': f'scGeom = {scGeom}', 'O.time < 2': 'O.time < 1.1'})
	one, two = (body.state for body in O.bodies)
	assert one.vel[0] < -0.3 and two.vel[0] > one.vel[0] and (two.pos - one.pos)[0] > 2 and failures() == 0


def testCubeBreaksAtItsStrength(runs):
	names = runs('uniaxial_compression')
	expected = 1e10 * (1e-9 / 0.035**3 * -np.log(1 - 0.6)) ** (1 / 3)
	assert expected < names['stress'][0] < 1.15 * expected and failures() == 0
	assert [len(pieces) for pieces in names['broken'].values()] == [2] and O.bodies[names['cube']] is None
	# a face of edge a that is pressed in by h carries K (a² h − a h²): a fifth of the depth is a little more than a fifth of the force
	slope = names['stress'][0] / names['factor'] / 1e11 / names['size']
	assert names['stress'][1] == pytest.approx(names['stress'][0] / 5 * (1 + 0.8 * slope), rel=1e-6)
