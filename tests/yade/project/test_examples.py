# SPDX-License-Identifier: GPL-2.0-or-later
"""Every script of examples/ runs, at reduced size where it takes long, and ends as its head says."""

import csv
import pathlib
import re
import runpy
import sys

import pytest
from yade import Facet, InteractionLoop, O, Vector3, polytope

folder = pathlib.Path(__file__).resolve().parents[3] / 'examples'
here = (
	'ballast',
	'blockOnSlope',
	'boltCurves',
	'boltedWedge',
	'bondedCube',
	'crushedCube',
	'crushedGrain',
	'directShear',
	'drum',
	'energy',
	'flushPieces',
	'funnel',
	'goodmanBray',
	'jointNetwork',
	'jointedSlope',
	'lining',
	'lockedInForces',
	'mesh',
	'paraview',
	'polygons',
	'restitution',
	'rocking',
	'slopeFromJoints',
	'timeStep',
	'tradeoff',
	'triaxial',
	'tunnel',
)
elsewhere = {'hello': 'test_docs', 'oneContact': 'test_docs', 'mpi': 'test_mpi'}


@pytest.fixture
def runs(tmp_path, monkeypatch):
	"""runs(name, *options, shorter={text: other}): the example's names after it has run as a program in an empty folder."""
	monkeypatch.chdir(tmp_path)

	def run(name, *options, shorter=()):
		path = folder / f'{name}.py'
		text = path.read_text()
		for long, short in dict(shorter).items():
			assert text.count(long) == 1, f'{name}.py has no {long!r} any more'
			text = text.replace(long, short)
		monkeypatch.setattr(sys, 'argv', [str(path), *options])
		names = {'__name__': '__main__', '__file__': str(path)}
		exec(compile(text, str(path), 'exec'), names)
		assert {made.name for made in tmp_path.iterdir()} <= {'output', 'small.png'}, 'examples write into output/'
		return names

	return run


def noFailures():
	(loop,) = (engine for engine in O.engines if isinstance(engine, InteractionLoop))
	return all(functor.stats()['failures'] == 0 for functor in loop.geomDispatcher.functors)


def isPicture(path):
	return pathlib.Path(path).read_bytes().startswith(b'\x89PNG')


def testEveryExampleIsRun():
	assert {path.stem for path in folder.glob('*.py')} == {*here, *elsewhere}
	for name, test in elsewhere.items():
		assert f'{name}.py' in next(pathlib.Path(__file__).parents[1].rglob(f'{test}.py')).read_text()
	tests = pathlib.Path(__file__).read_text()
	assert all(re.search(rf"runs\(\s*'{name}'", tests) or f"run_path(str(folder / '{name}.py'))" in tests for name in here)


def testExamplesCanBeInterrupted():
	"""Ctrl-C is seen between two calls of O.run: none of them may run to the end of a simulation."""
	calls = {path.name: re.findall(r'\bO\.run\(([^)]*)\)', path.read_text()) for path in (*folder.glob('*.py'), *folder.glob('peers/*.py'))}
	assert sum(map(len, calls.values())) > 25
	for name, several in calls.items():
		for given in several:
			assert re.match(r'\d{1,4}\b|steps\b|[a-z]+Steps\b', given), f'{name}: O.run({given}) cannot be interrupted'


def testBondedCubeBreaksInPart(runs, capsys):
	runs('bondedCube', shorter={'until=0.15': 'until=0.01'})
	made, intact, tension, shear = map(int, re.findall(r'\d+', capsys.readouterr().out)[:4])
	assert made == intact + tension + shear and 0 < intact < made and isPicture('output/bondedCube.png') and noFailures()


def testBlocksOnSlopesStandSlideAndToppleAs3DecSays(runs, capsys):
	with pytest.raises(SystemExit) as end:
		runs('blockOnSlope')
	lines = [line.split(': ')[1].split(';')[0] for line in capsys.readouterr().out.splitlines() if line.startswith('  ')]
	usual, soft = ['stands', 'slides', 'slides', 'stands', 'topples'], ['topples', 'topples', 'slides', 'topples', 'topples']
	assert not end.value.code and lines == usual + soft + usual and noFailures()


def testColumnsToppleAtTheAngleOfGoodmanAndBray(runs, capsys):
	"""Less closely than the example."""
	with pytest.raises(SystemExit) as end:
		runs(
			'goodmanBray',
			shorter={
				'start=radians(50), steps=[radians(2), radians(0.5), radians(0.1)]': 'start=radians(42), steps=[radians(2), radians(0.5)]'
			},
		)
	stands, fails, exact = map(float, re.findall(r'[\d.]+(?=°)', capsys.readouterr().out))
	assert not end.value.code and exact == pytest.approx(38.13, abs=0.01) and fails - 0.3 < exact < stands + 0.3 and noFailures()


def testBoltsAreAsTheirClosedFormsSay(runs, capsys):
	runs('boltCurves')
	differences = [float(found) for found in re.findall(r'([\d.]+) %', capsys.readouterr().out)]
	assert len(differences) == 2 and max(differences) < 0.2 and isPicture('output/boltCurves.png')


def testALiningBearsWhatComesLooseInTheRoof(runs, capsys):
	names = runs('lining')
	weight, borne = map(float, re.findall(r'([\d.]+) kN', capsys.readouterr().out)[-2:])
	assert weight > 1 and borne == pytest.approx(weight, rel=1e-3) and isPicture('output/lining.png')
	assert names['forces'].moment == pytest.approx(names['forces'].moment[::-1], abs=1) and names['forces'].normal.max() < 0


def testDirectShearByThreeLaws(runs, capsys):
	runs('directShear', shorter={'< 4e-3': '< 2e-3'})
	peaks = {name: float(angle) for name, angle in re.findall(r'(.*): peak ([\d.]+)°', capsys.readouterr().out)}
	assert peaks['Mohr-Coulomb'] == pytest.approx(30, abs=0.1) and peaks['Barton-Bandis'] == pytest.approx(50, abs=0.1)
	assert 40 < peaks['continuously yielding'] < 50 and isPicture('output/directShear.png')


def testBoltsRaiseTheFactorOfARoofWedge(runs, capsys):
	runs('boltedWedge', shorter={'(0, 2000, 4000, 6000)': '(0, 4000)'})
	found = [[float(number) for number in re.findall(r'[\d.]+', line)] for line in capsys.readouterr().out.splitlines()]
	assert [row[0] for row in found] == [0, 4000] and found[0][2] == pytest.approx(1.55, abs=1e-3) and found[1][2] > 2
	assert all(measured == pytest.approx(theory, rel=0.01) for _, measured, theory in found)


def testFactorsOfABlockOnTwoFacesDependOnLockedInShear(runs, capsys):
	"""Soft in shear it is that of limit equilibrium; else above, and below limit analysis of the same faces; between two walls the block jams."""
	runs('lockedInForces', '--dip', '65', '--ratios', '1', '0.01')
	found = [[float(number) for number in re.findall(r'[\d.]+', line)] for line in capsys.readouterr().out.splitlines()]
	(_, equilibrium, analysis), (_, stiff, jammed), (_, soft, _) = found
	assert (equilibrium, analysis) == (pytest.approx(1.408, abs=1e-3), pytest.approx(1.492, abs=2e-3))
	assert soft == pytest.approx(equilibrium, rel=0.006) and 1.01 * equilibrium < stiff < analysis < jammed


def testCrushedCubeBalancesItsEnergy(runs, capsys):
	names = runs('crushedCube')
	missing = float(re.search(r'missing: (\S+) %', capsys.readouterr().out)[1])
	assert abs(missing) < 1 and names['parts']['broken'] > 0.02 * names['work'] and isPicture('output/crushedCube.png') and noFailures()
	assert 2 * polytope.bonds().intactCount < names['made'] and 1e6 < names['strength'] < 1e8


def testCrushedGrainBreaksWhereItsStressSays(runs):
	"""Force times height over volume is the mean stress; for a stress along one direction q is √2/3 of it. Halves are stronger."""
	names = runs('crushedGrain')
	height, first = -2 * names['low'], names['forces'][0]
	assert first == pytest.approx(1e6 * 3 / 2**0.5 * names['volume'] / height, rel=2e-2) and names['forces'][1] > first
	assert sum(piece.shape.volume for piece in names['pieces']) == pytest.approx(names['volume'], rel=1e-12)
	assert len(names['pieces']) == len(names['forces']) + 1 and isPicture('output/crushedGrain.png') and noFailures()


def testSlopeSlidesBelowTheDipOfItsBeddingOnly(runs, capsys):
	"""Four metres of it along the face."""
	with pytest.raises(SystemExit) as end:
		runs(
			'jointedSlope',
			shorter={'[24, 2, 10, 0, 14, 2, 0]': '[24, 2, 4, 0, 14, 2, 0]', 'moved(radians(20), 1.0)': 'moved(radians(20), 0.05)'},
		)
	assert not end.value.code and 'queries without an answer: 0' in capsys.readouterr().out and isPicture('output/jointedSlope.png')


def testASlopeFromAFileOfJointsFailsAlongItsBedding(runs, capsys):
	"""Five metres high: joints read, blocks cut, factor of safety by limit analysis and by strength reduction, picture and film."""
	names = runs('slopeFromJoints', '--height', '5', '--width', '3', '--frames', '3', '--tolerance', '0.04', '--reduction')
	assert 'sliding on bedding: 1.198' in capsys.readouterr().out
	for found in (names['found'], names['reduced']):
		assert found.stable < 1.03 * 1.198 and found.failed > 0.97 * 1.198 and found.failed / found.stable <= 1.0401
	assert all(way @ (-0.82, 0, -0.57) > 0.95 for way in names['reduced'].directions)  # down the bedding
	assert all(way @ (-0.82, 0, -0.57) > 0.7 for way in names['found'].directions)  # and it opens by the friction angle
	assert isPicture('output/slopeFromJoints.png') and pathlib.Path('output/slopeFromJoints.gif').read_bytes().startswith(b'GIF')
	assert len(polytope.readJoints('output/slopeFromJoints.csv')) > 10 and noFailures()


def testJointNetworkCutsWhatWasAskedFor(runs, capsys):
	"""A third of its joints, and so fewer blocks than it wants."""
	with pytest.raises(SystemExit) as end:
		runs('jointNetwork', shorter={'asked, size = 0.35': 'asked, size = 0.12', '>= 100000': '>= 5000'})
	out = capsys.readouterr().out
	assert not end.value.code and 'cuts not made' in out and isPicture('output/stereonet.png'), out


def testFunnelLetsGrainsOutBelowAlone(runs, capsys):
	runs(
		'funnel',
		shorter={
			'mass=0.25': 'mass=0.03',
			"[(0.007, 0), (0.01, 0.5), (0.013, 1)]": '[(0.009, 0), (0.011, 1)]',
			'O.time < 0.45': 'O.time < 0.35',
		},
	)
	out, number = map(int, re.search(r'(\d+) of (\d+) grains', capsys.readouterr().out).groups())
	grains = [body.state.pos for body in O.bodies if body.dynamic]
	assert 0 < out and number == len(grains) > 8 and isPicture('output/funnel.png') and noFailures()
	assert sum(isinstance(body.shape, Facet) for body in O.bodies) == 144
	for x, y, z in grains:
		# inside the funnel's radius at that height, or below its spout; above the floor
		radius = 0.08 if z > 0.22 else 0.02 + 0.6 * (z - 0.12) if z > 0.12 else 0.02
		assert z > 0 and (z < 0.09 or (x**2 + y**2) ** 0.5 < radius)


def testPebblesLieInTheTray(runs, capsys):
	names = runs('mesh', shorter={'until=1.5': 'until=0.25'})
	hull = O.bodies[5].shape
	assert f'{hull.volume} m³, with {len(hull.normals)} planes' in capsys.readouterr().out
	assert len(hull.normals) > 20 and O.bodies[24].shape.volume / hull.volume == pytest.approx(
		((0.007 + 0.0002 * 19) / 0.007) ** 3, rel=1e-5
	)
	pebbles = [body.state for body in O.bodies if body.dynamic]
	assert len(pebbles) == 20 and isPicture('output/pebbles.png') and noFailures()
	assert all(state.pos[2] > 0 and abs(state.pos[0]) < 0.14 and abs(state.pos[1]) < 0.14 for state in pebbles)
	assert min(state.pos[2] for state in pebbles) < 0.05 and names['pebble'].endswith('pebble.obj')


def testPolygonsSlideOutOfTheHopper(runs):
	runs('polygons', shorter={'until=2': 'until=1'})
	free = [body.state for body in O.bodies if body.dynamic]
	assert len(free) == 72 and isPicture('output/polygons.png') and noFailures()
	assert all(state.pos[2] == 0 and state.angVel[0] == state.angVel[1] == 0 for state in free)
	through = sum(state.pos[1] < 0.4 for state in free)
	assert 5 < through < 72 and min(state.pos[1] for state in free) > -1.3


def testForcesOfFlushPiecesAreThoseOfOne(runs):
	names = runs('flushPieces')
	one, two, oblique, _, step, corner = names['sums'].values()
	assert (one[0], one[1]) == pytest.approx((0, 1e6 * (1.5 * 0.1 - 0.1**2 / 2)), abs=1e-3)
	assert two == pytest.approx(one, abs=1e-3) and oblique == pytest.approx(one, abs=1e-3)
	assert step[0] == pytest.approx(-1e6 * (0.1**2 - 0.04**2) / 2, abs=1e-3) and corner[0] == pytest.approx(0, abs=1e-3) and corner[1] > 0
	assert isPicture('output/flushPieces.png')



def testParaviewsFilesAreThere(runs):
	runs('paraview', shorter={'in range(40)': 'in range(5)'})
	for recorder in ('bodies', 'contacts'):
		series = pathlib.Path(f'output/paraview/{recorder}.pvd').read_text()
		files = re.findall(r'file="([^"]+)"', series)
		assert len(files) == 5 and all((pathlib.Path('output/paraview') / file).stat().st_size > 500 for file in files)


def testTriaxialTestHoldsItsStress(runs, capsys):
	names = runs('triaxial', shorter={'mass=0.155': 'mass=0.014', '(0.07, 0.07, 0.07)': '(0.032, 0.032, 0.032)', 'run(0.2)': 'run(0.02)'})
	columns = names['columns']
	assert columns['lateralStress'].mean() == pytest.approx(1e5, rel=1e-3) and columns['deviator'].max() > 4e4
	assert columns['axialStrain'][-1] == pytest.approx(0.02, abs=1e-4) and columns['volumetricStrain'][-1] > 0
	assert (
		isPicture('output/triaxial.png')
		and isPicture('output/triaxialSample.png')
		and f'{len(names["sample"].ids)} grains' in capsys.readouterr().out
		and noFailures()
	)


def testTimeStepsColumnStands(runs, capsys):
	runs('timeStep', 'column', 'perArea', 'boon2012', '0.4', shorter={'	return 1\n': '	return 0.5\n'})
	row = next(line for line in capsys.readouterr().out.splitlines() if line.startswith('column'))
	assert row.split()[1:4] == ['boon2012', 'perArea', '0.4'] and 'stopped' not in row
	assert float(re.search(r'unbalanced +(\S+)', row)[1]) < 1e-3
	assert float(re.search(r'mean height (\S+)', row)[1]) == pytest.approx(1, abs=1e-3)


def testAGasOfAContactSurfaceKeepsItsEnergy(runs, capsys):
	"""What examples/energy.py draws, with fewer solids: the error of a contact surface is that of the time step, the paper's is not."""
	energies = runpy.run_path(str(folder / 'energy.py'))['energies']
	worst = {}
	for model in ('spring', 'foundation', 'boon2012'):
		_, values, stable = energies(model, 1, 0.5, samples=20, number=24)
		worst[model] = max(abs(value - 1) for value in values)
		assert noFailures() and O.dt < stable and O.engines[2].geomDispatcher.functors[0].stats()['contacts'] > 1000
	assert worst['spring'] < 2e-4 and worst['foundation'] < 2e-4 and worst['boon2012'] > 2e-3
	monkey = runs('energy', '--seconds', '0.002', '--number', '5', '--output', 'small.png')
	assert isPicture('small.png') and len(re.findall(r'^(?:boon2012|spring|foundation) ', capsys.readouterr().out, re.MULTILINE)) == len(
		monkey['runs']
	)


def testGrainsStayInTheDrumAndRiseWithItsWall(runs, capsys):
	names = runs('drum', shorter={'mass=0.45': 'mass=0.25', 'O.time < 2.3': 'O.time < 0.8'})
	places = [O.bodies[k].state.pos for k in names['inside']]
	assert len(places) > 30 and isPicture('output/drum.png') and noFailures()
	assert all(x**2 + z**2 < 0.1**2 and abs(y) < 0.04 for x, y, z in places)
	assert 10 < names['angles'][-1] < 60 and float(re.search(r'end (\S+)°', capsys.readouterr().out)[1]) > 5
	# half a revolution a second about y: a stave is where it began, turned, and has the velocity of its place
	stave = O.bodies[names['staves'][0]].state
	assert stave.pos.norm() == pytest.approx(stave.refPos.norm(), rel=1e-3)
	assert (stave.vel - Vector3(0, 2, 0).cross(stave.pos)).norm() < 1e-3


def testBallastSettlesUnderItsLoad(runs, capsys):
	names = runs(
		'ballast',
		shorter={
			'mass=9': 'mass=5',
			'long, wide, high = 0.36, 0.2, 0.7': 'long, wide, high = 0.26, 0.2, 0.7',
			'2e3, 0.05, 4': '1e3, 0.05, 2',
		},
	)
	settlement = names['settlement']
	assert len(settlement) == 2 and 0 < settlement[0] < 0.05 and settlement[1] > 0 and noFailures()
	assert isPicture('output/ballast.png') and '2 cycles' in capsys.readouterr().out
	assert all(0 < z < 0.7 and 0 < x < 0.26 and 0 < y < 0.2 for x, y, z in (O.bodies[k].state.pos for k in names['ballast']))


def testRockingLosesAsThePageSays(runs, capsys):
	"""Two rows of the table of docs/dynamics.md. More damping loses more, and Housner's loss lies between them."""
	names = runs('rocking', shorter={'(0, 0.2, 0.5, 0.6, 0.7, 0.8, 1)': '(0.5, 0.7)'})
	printed = [[float(word) for word in line.split()] for line in capsys.readouterr().out.splitlines() if re.match(r' *0\.', line)]
	page = (folder.parent / 'docs/dynamics.md').read_text()
	rows = [[float(cell) for cell in row.strip('|').split('|')] for row in re.findall(r'^\| [01][\d.]* \|.*\|$', page, re.MULTILINE)]
	rows = {damping: values for damping, *values in rows}
	assert len(rows) == 7 and len(printed) == 2
	for damping, *values, period in printed:
		assert rows[damping] == pytest.approx(values, abs=2e-3) and period == pytest.approx(1.01, abs=5e-3)
	assert rows[0.7][0] < names['housner']() == pytest.approx(0.912, abs=5e-4) and names['housner']() < rows[0.5][0]


def testRestitutionIsThatOfTheClosedForm(runs, capsys):
	"""The table of docs/stiffness.md is what is printed. A face has a constant stiffness: with shorter steps its restitution is that of the
	theory."""
	names = runs('restitution', shorter={"(0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7)": '(0.1, 0.5)'})
	printed = [line.split() for line in capsys.readouterr().out.splitlines() if re.match(r' *0\.', line)]
	page = (folder.parent / 'docs/stiffness.md').read_text()
	rows = [row.strip('|').split('|') for row in re.findall(r'^\| 0.*\|$', page, re.MULTILINE)]
	rows = {float(row[0]): [float(cell) for cell in row[1:]] for row in rows}
	assert len(rows) == 8 and len(printed) == 2
	for damping, *values in printed:
		assert rows[float(damping)] == pytest.approx([float(value) for value in values], abs=0.011)  # a digit of two
	for damping, values in rows.items():
		assert names['theory'](damping) == pytest.approx(values[0], abs=5.1e-3)
	for damping in (0, 0.1, 0.5):
		assert names['measured'](damping, names['turns']['face'], fraction=0.02) == pytest.approx(names['theory'](damping), abs=3e-3)


def testTradeoffFindsTheHeightAtRest(runs, capsys):
	names = runs('tradeoff')
	assert 'On the Pareto front:' in capsys.readouterr().out
	with open('output/tradeoff.csv') as file:
		rows = list(csv.DictReader(file))
	assert [next(iter(row.values())) for row in rows] == list(names['settings'])
	errors = {row['setting']: float(row['error']) for row in rows}
	# of 0.5 m; the rocking stiffness of the paper's contact is not that of the closed form
	assert all(0 < error < (2e-4 if name == "the paper's contact" else 2e-6) for name, error in errors.items())
	# a cold start computes each contact in full, and does not follow those at rest: to 1e-5 of the depth they share (docs/settings.md)
	answers = {row['setting']: float(row['answer']) for row in rows}
	assert 0.5 - answers['as it is'] == pytest.approx(0.5 - answers['cold start'], rel=1e-5)


def testATunnelIsCutThroughStressedBlocks(runs):
	names = runs('tunnel', shorter={'joints, seed=2)': 'joints, seed=2, smallest=0.3)', 'over=3000': 'over=1500'})
	assert len(names['cut']) > 5 and not set(names['cut']) & {body.id for body in O.bodies}
	assert noFailures() and 0 < names['moved'][0] < 0.01
	assert isPicture('output/tunnel.png')
