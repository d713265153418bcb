# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes on 2 and 3 ranks under mpirun against one process: bodies, contacts and what joints remember. The scenes: mpiScenes.py.

To start processes takes most of the time, so one call runs many scenes.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import numpy as np
import pytest
from yade import polytope

if shutil.which('mpirun') is None or 'MPI' not in polytope.buildInfo()['yadeFeatures']:
	pytest.skip('YADE has no MPI here, or there is no mpirun', allow_module_level=True)

here = pathlib.Path(__file__).resolve().parents[1]
project = here.parents[1]
scenes = str(here / 'mpiScenes.py')
hangs = 300
"""Time after which a run is taken for one that hangs [s]; one takes some seconds."""
size = 0.22
"""Size of the solids of the heap [m]."""
clumpedBodies = 81
"""Number of bodies in the heap of clumps: 18 clumps, their 57 members and six single bodies."""
sameAsHeap = ['parts', 'divided', 'decomposed']
"""The heap's hundred steps on 3 ranks, in other ways."""
sameAsClumped = ['clumpedParts', 'clumpedDivided', 'clumpedDecomposed']
"""The hundred steps of the heap of clumps on 3 ranks, in other ways."""
sessions = tempfile.TemporaryDirectory(prefix='mpi')
"""Folder of the runs' own files, one in it for each run: mpirun names its by its process number and does not start where one that was
killed left the same."""
ownLaws = ['rough', 'yielding']
moving = ['smooth', 'wet', 'joints', *ownLaws, 'opened', 'bonded', 'clumpedSliding', 'carried', 'shaken', 'edited']


def testAYadeWithoutMpiIsRefused():
	"""It would fail at the first function of the package, on one rank alone."""
	code = "import yade\nyade.config.features.remove('MPI')\nfrom yade.polytope import mpi"
	run = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=hangs)
	assert run.returncode == 1 and 'ImportError: YADE ' in run.stderr and 'was built without MPI; build it with' in run.stderr


def launch(ranks, *command):
	"""A command on this number of ranks, 0: without MPI."""
	run = ['mpirun', '--oversubscribe', '-np', str(ranks)] if ranks else []
	environment = {**os.environ, 'OMP_NUM_THREADS': '1', 'TMPDIR': tempfile.mkdtemp(dir=sessions.name)}
	return subprocess.Popen(
		[*run, *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment, start_new_session=True
	)


def under(ranks, *command, fails=False):
	"""What it has printed."""
	process = launch(ranks, *command)
	try:
		said = process.communicate(timeout=hangs)[0]
	except subprocess.TimeoutExpired:
		os.killpg(process.pid, signal.SIGKILL)
		raise
	assert (process.returncode != 0) == fails, said
	return said


@pytest.fixture(scope='module')
def found(tmp_path_factory):
	"""What the scenes have found: found(name, ranks)."""
	folder = tmp_path_factory.mktemp('mpi')
	under(0, sys.executable, scenes, str(folder), 'start', 'settled', 'heap', 'recorded', 'crossing', *moving)
	under(0, sys.executable, scenes, str(folder), 'startClumps', 'clumpedSettled', 'clumped')
	under(2, sys.executable, scenes, str(folder), 'heap', 'clumped', 'clumpedSliding', *ownLaws)
	under(
		3, sys.executable, scenes, str(folder), 'heap', *sameAsHeap, 'clumped', *sameAsClumped, 'recorded', *moving, 'searched', 'refused'
	)
	under(3, sys.executable, scenes, str(folder), *(f'reallocated{name}' for name in ('Crossing', 'Stacks', 'Heap', 'Smooth', 'Bonded')))
	under(4, sys.executable, scenes, str(folder), *(f'reallocated{name}' for name in ('Crossing', 'Stacks', 'Heap')))

	def read(name, ranks):
		return json.loads((folder / f'{name}-{ranks}.json').read_text())

	read.folder = folder
	return read


def farthest(one, other):
	return max(abs(float.fromhex(x) - float.fromhex(y)) for x, y in zip(one, other, strict=True))


agreement = 1e-9
"""Largest distance of equal places, as a part of a body's size. Forces of several ranks are added up in another order, and bodies of the
heap still move, at some 1 m/s: what rounding changes grows."""
sameForce = 1e-8
"""Largest difference of equal forces, as a part of the largest force. Where friction slips and turns at once, a few returns to its strength
in 100 000 change the force by so much for a load that differs by rounding alone."""


def same(one, several, bodies=24):
	"""Asserts that both are the same to *agreement*, and in what contacts remember."""
	assert one['iter'] == several['iter'] and one['engines'] == several['engines']
	assert one['coordination'] == several['coordination'] > 1 and one['mass'] == pytest.approx(several['mass'], rel=1e-12)
	assert one['time'] == pytest.approx(several['time'], rel=1e-13)
	assert one['bodies'].keys() == several['bodies'].keys() and len(one['bodies']) == bodies
	assert max(farthest(one['bodies'][k][:7], several['bodies'][k][:7]) for k in one['bodies']) < agreement * size
	assert max(farthest(one['bodies'][k][7:], several['bodies'][k][7:]) for k in one['bodies']) < 1e-7
	assert one['contacts'].keys() == several['contacts'].keys() and len(one['contacts']) > 24
	largest = max(abs(float.fromhex(x)) for contact in one['contacts'].values() for x in contact[3:6])
	for ids, contact in one['contacts'].items():
		assert contact[13] == several['contacts'][ids][13]  # intact
		assert farthest(contact[:13], several['contacts'][ids][:13]) < 1e-7 * largest
	return True


@pytest.mark.parametrize('name, ranks', [('heap', 2), ('heap', 3), *((name, 3) for name in sameAsHeap)])
def testMergedSceneIsThatOfOneProcess(found, name, ranks):
	assert same(found('heap', 1), found(name, ranks))


@pytest.mark.parametrize('name, ranks', [('clumped', 2), ('clumped', 3), *((name, 3) for name in sameAsClumped)])
def testMergedSceneOfClumpsIsThatOfOneProcess(found, name, ranks):
	assert same(found('clumped', 1), found(name, ranks), clumpedBodies)


@pytest.mark.parametrize('start, end', [('settled', 'heap'), ('clumpedSettled', 'clumped')])
def testTheSceneMovesAndContactsRemember(found, start, end):
	"""Otherwise the comparison above would say nothing."""
	before, after = found(start, 1), found(end, 1)
	assert max(farthest(before['bodies'][k][:3], after['bodies'][k][:3]) for k in before['bodies']) > 1e-7
	contacts = after['contacts'].values()
	assert any(float.fromhex(x) != 0 for contact in contacts for x in contact[6:9])  # shear force
	assert any(float.fromhex(x) != 0 for contact in contacts for x in contact[9:12])  # slip


@pytest.mark.parametrize('name, shapes', [('divided', {'Polytope'}), ('clumpedDivided', {'Polytope', 'Clump'})])
def testFieldsOfAllRanksAreThoseOfTheMergedScene(found, name, shapes):
	divided = found(name, 3)
	assert set(divided['same'].values()) == {True}, divided['same']
	assert max(abs(x) for x in divided['net']) < 1e-9 * divided['push'] and divided['push'] > 100
	assert set(divided['names']) == shapes and (divided['ofTwoRanks'] > 5) == ('Clump' in shapes)
	assert divided['stats']['pairs'] > 50 * len(divided['contacts']) and divided['stats']['failures'] == 0


def testDecompositionOfYadeGivesFixedBodiesToRankZero(found):
	assert found('decomposed', 3)['counts'] == [12, 12]


def testRecordersWriteTheWholeSceneOnce(found):
	"""Permanent forces act, too; a scene that rank 0 has changed is handed out anew."""
	one, several = found('recorded', 1), found('recorded', 3)
	assert same(one, several)
	assert max(farthest(one['bodies'][k][:3], found('heap', 1)['bodies'][k][:3]) for k in one['bodies']) > 1e-6
	names = [sorted(path.name for path in (found.folder / str(ranks)).iterdir() if '.26' not in path.name) for ranks in (1, 3)]
	assert names[0] == names[1] and {'bodies.pvd', 'bodies.2550.vtu', 'contacts.2575.vtp', 'run.yade', 'run.previous.yade'} <= set(names[0])
	for ranks in (1, 3):
		assert 'NumberOfCells="30"' in (found.folder / f'{ranks}/bodies.2575.vtu').read_text(errors='replace')  # six walls


@pytest.mark.parametrize('ranks', [2, 3])
def testClumpsThatMoveFromOneRanksPartToTheOthers(found, ranks):
	"""They fall, roll and strike each other on a fixed clump."""
	one, several = found('clumpedSliding', 1), found('clumpedSliding', ranks)
	assert (
		one['bodies'].keys() == several['bodies'].keys()
		and one['contacts'].keys() == several['contacts'].keys()
		and len(one['contacts']) > 10
	)
	assert max(farthest(one['bodies'][k], several['bodies'][k]) for k in one['bodies']) < agreement * size
	assert max(farthest(one['contacts'][k][6:13], several['contacts'][k][6:13]) for k in one['contacts']) < 1e-9 * 350
	assert sum(contact[13] for contact in one['contacts'].values()) < len(one['contacts']) - 5  # joints that have slipped


def testFixedBodiesWithAVelocityMoveOnAllRanks(found):
	one, several = found('carried', 1), found('carried', 3)
	assert one['bodies'].keys() == several['bodies'].keys() and one['contacts'].keys() == several['contacts'].keys()
	assert max(farthest(one['bodies'][k], several['bodies'][k]) for k in one['bodies']) < agreement * size
	pushed = [float.fromhex(x) for x in one['bodies']['4']]
	assert pushed[2] > 0.2 + 0.9 * 0.01 and pushed[7] > 1  # carried upwards, and struck by the plate


@pytest.mark.parametrize('name, moved', [('smooth', 400), ('wet', 300), ('joints', 80)])
def testBlocksThatSlideFromOneRanksPartToTheOthers(found, name, moved):
	one, several = found(name, 1), found(name, 3)
	assert one['bodies'].keys() == several['bodies'].keys() and one['contacts'].keys() == several['contacts'].keys()
	assert max(farthest(one['bodies'][k][:3], several['bodies'][k][:3]) for k in one['bodies']) < agreement * 0.4
	assert max(farthest(one['contacts'][k][6:13], several['contacts'][k][6:13]) for k in one['contacts']) < 1e-9 * 2500
	places = [float.fromhex(body[0]) for body in one['bodies'].values()]
	assert min(place - (0.7 * k - 3) for k, place in enumerate(places)) > 3e-4 * moved
	assert max(abs(float.fromhex(contact[10])) for contact in one['contacts'].values()) > 1e-4  # slip


@pytest.mark.parametrize('ranks', [2, 3])
@pytest.mark.parametrize('name', ownLaws)
def testJointsWithLawsOfTheirOwn(found, name, ranks):
	"""Closure and shear law, and how far asperities are worn, are those of one process where blocks slide from one rank's part to the other's."""
	one, several = found(name, 1), found(name, ranks)
	assert one['contacts'].keys() == several['contacts'].keys() == one['slipped'].keys() and len(one['contacts']) >= 8
	assert max(farthest(one['bodies'][k][:7], several['bodies'][k][:7]) for k in one['bodies']) < agreement * 0.4
	force = max(abs(float.fromhex(x)) for contact in one['contacts'].values() for x in contact[3:6])
	assert max(farthest(contact[3:9], several['contacts'][k][3:9]) for k, contact in one['contacts'].items()) < sameForce * force
	for k, slipped in one['slipped'].items():
		assert float.fromhex(several['slipped'][k]) == pytest.approx(float.fromhex(slipped), abs=agreement * 0.4)
	assert max(map(float.fromhex, one['slipped'].values())) > 0.02
	assert max(float.fromhex(contact[12]) for contact in one['contacts'].values()) > 1e-3  # dilation


def testOpenJointsOfTwoRanksRememberTheirSlip(found):
	"""Between workers, and with a fixed block: while they are open by half a block, and when they touch again."""
	one, several = found('opened', 1), found('opened', 3)
	pairs = {'0 1', '1 2', '2 3', '3 4'}
	assert (
		one['apart']['contacts'].keys()
		== several['apart']['contacts'].keys()
		== one['contacts'].keys()
		== several['contacts'].keys()
		== pairs
	)
	gaps = np.diff([0.0, *(float.fromhex(body[0]) for body in several['apart']['bodies'].values())]) - 0.4
	assert min(gaps) > 0.18
	for pair in pairs:
		assert float.fromhex(one['contacts'][pair][3]) > 1e5 and float.fromhex(one['contacts'][pair][12]) > 1e-4  # N; dilation
		assert farthest(one['contacts'][pair][3:9], several['contacts'][pair][3:9]) < 1e-9 * 2.5e5
		assert farthest(one['contacts'][pair][9:13], several['contacts'][pair][9:13]) < agreement * 0.4


def testLongerRunsAgreeInTheMean(found):
	"""Body by body they do not: forces are added up in another order, and collisions enlarge what that changes."""
	one, several = np.array(found('shaken', 1)), np.array(found('shaken', 3))
	uncertainty = np.sqrt((one.var(axis=0, ddof=1) + several.var(axis=0, ddof=1)) / len(one))
	assert (abs(one.mean(axis=0) - several.mean(axis=0)) < 2 * uncertainty).all(), (one, several)
	assert (uncertainty < 0.1 * one.mean(axis=0)).all()  # so that it says something


@pytest.mark.parametrize(
	'name, ranks, least',
	[
		('reallocatedCrossing', 3, 2),
		('reallocatedStacks', 3, 40),
		('reallocatedHeap', 3, 100),
		('reallocatedSmooth', 3, 50),
		('reallocatedBonded', 3, 100),
		('reallocatedCrossing', 4, 2),
		('reallocatedStacks', 4, 40),
		('reallocatedHeap', 4, 100),
	],
)
def testBodiesThatChangeRanksInARunKeepTheirContacts(found, name, ranks, least):
	"""mpy.REALLOCATE_FREQUENCY: those beyond the middle between two ranks; in the others any that both know, every five steps, so most of them."""
	one = found({'reallocatedStacks': 'crossing'}.get(name, name.removeprefix('reallocated').lower()), 1)
	several = found(name, ranks)
	assert several['moved'] >= least
	assert one['bodies'].keys() == several['bodies'].keys() and one['contacts'].keys() == several['contacts'].keys()
	assert max(farthest(one['bodies'][k][:3], several['bodies'][k][:3]) for k in one['bodies']) < agreement * size
	assert max(farthest(one['contacts'][k][3:13], several['contacts'][k][3:13]) for k in one['contacts']) < sameForce * 2000


def testBondsBetweenRanksActAndFailAsOnOne(found):
	"""So do bonds with a fixed body, which is rank 0's; the joint that follows the bond of two ranks is on both."""
	one, several = found('bonded', 1), found('bonded', 3)
	for bodies in ('halfWay', 'bodies'):
		assert max(farthest(one[bodies][k][:7], several[bodies][k][:7]) for k in one[bodies]) < agreement * 0.4
	assert one['bonds'].keys() == several['bonds'].keys() and len(one['bonds']) == 16
	for pair, (*fate, numbers) in one['bonds'].items():
		assert several['bonds'][pair][:3] == fate and fate[0] == (pair != '13 14')
		assert farthest(numbers, several['bonds'][pair][3]) < 1e-9 * max(abs(float.fromhex(x)) for x in numbers)
	assert one['bonds']['13 14'][1] == 'tension' and 0 < one['bonds']['13 14'][2] < 250
	assert one['contacts'].keys() == several['contacts'].keys() == {'13 14'}
	assert farthest(one['contacts']['13 14'][3:6], several['contacts']['13 14'][3:6]) < 1e-6 * abs(
		float.fromhex(one['contacts']['13 14'][3])
	)
	assert max(-float.fromhex(body[2]) for body in one['bodies'].values()) > 1e-5  # they hang down


def testPairsAreSearchedForOnlyWhenABodyHasLeftItsBox(found):
	"""This holds also where rank 0 has no body that could leave its box."""
	for counts in found('searched', 3).values():
		assert len(counts) == 3 and all(before == after > 0 for before, after in counts), counts


@pytest.mark.parametrize(
	'name, remedy',
	[
		('mpy.ERASE_REMOTE', 'must be True'),
		('mpy.COPY_MIRROR_BODIES_WHEN_COLLIDE', 'must be True'),
		('mpy.MERGE_W_INTERACTIONS', 'must be True'),
		('mpy.USE_CPP_MPI', 'must be True'),
		('mpy.REALLOCATE_MINIMAL', 'must be False'),
		('O.trackEnergy', 'polytope.mpi.arrays()'),
		('ForceRecorder', 'polytope.mpi.merge()'),
		('Body.subdomain', 'call polytope.mpi.divide()'),
		('bolts', 'run this scene on one'),
		('O.periodic', 'on one process'),
	],
)
def testWhatCannotBeHadIsRefused(found, name, remedy):
	said = found('refused', 3)
	assert said['nothing'] is None and name in said[name] and remedy in said[name]


@pytest.mark.parametrize('name, end, bodies', [('killed', 'heap', 24), ('clumpedKilled', 'clumped', clumpedBodies)])
def testARunThatIsKilledGoesOnFromItsLastState(found, name, end, bodies):
	"""Saved on 3 ranks, continued on 3 and on one."""
	(found.folder / 'running').unlink(missing_ok=True)
	process = launch(3, sys.executable, scenes, str(found.folder), name)
	latest = time.monotonic() + hangs
	while not (found.folder / 'running').exists() and process.poll() is None and time.monotonic() < latest:
		time.sleep(0.05)
	time.sleep(0.2)
	assert process.poll() is None, process.communicate()[0]
	for number in (process.pid, *(int((found.folder / f'process-{rank}').read_text()) for rank in range(3))):
		os.kill(number, signal.SIGKILL)
	process.communicate()
	for ranks in (3, 0):
		under(ranks, sys.executable, scenes, str(found.folder), 'continued')
		assert same(found(end, 1), found('continued', ranks or 1), bodies)


def testARankThatFailsEndsTheRun(tmp_path):
	script = tmp_path / 'fails.py'
	script.write_text(
		'from yade import *\nfrom yade import polytope\nfrom yade.polytope import mpi\n'
		'if mpi.rank() == 1:\n\traise ValueError("on purpose")\nmpi.mpy.comm.barrier()\nmpi.mpy.comm.recv(source=1, tag=99)\n'
	)
	assert 'on purpose' in under(2, 'yade', '-n', '-x', str(script), fails=True)


def testChangesOnRankZeroBetweenRunsAreHandedOut(found):
	"""A check of the merged scene finds nothing that would not be there on one process."""
	one, several = found('edited', 1), found('edited', 3)
	assert one['bodies'].keys() == several['bodies'].keys() and len(one['bodies']) == 24
	assert max(farthest(one['bodies'][k][:7], several['bodies'][k][:7]) for k in one['bodies']) < agreement * size
	assert len(one['contacts']) == len(several['contacts'])
	assert one['limit'] == pytest.approx(several['limit'], rel=1e-9) and 0 < one['limit'] < 0.1


@pytest.mark.parametrize('program', [sys.executable, 'yade'])
@pytest.mark.parametrize(
	'script, says',
	[
		('mpi.divide()\nif mpi.rank() == 0:\n\tmpi.run(5)\n', 'rank 0: polytope.mpi.run; rank 1: the end of the script'),
		('mpi.divide()\nmpi.run(2)\nif mpi.rank() == 1:\n\tmpi.merge()\n', 'rank 0: the end of the script; rank 1: polytope.mpi.merge'),
		('if mpi.rank() == 0:\n\tO.bodies[0].dynamic = False\nmpi.divide()\nmpi.run(2)\n', 'no body can move'),
		(
			'mpi.divide()\nO.engines = O.engines + [PyRunner(command="O.bodies.erase(0)", iterPeriod=3)]\nmpi.run(5)\n',
			'on rank 0, after polytope.mpi.merge()',
		),
		(
			'mpi.divide()\nmpi.run(2)\nif mpi.rank() == 0:\n\tO.bodies.append(polytope.regular(6, 1, (5, 0, 0)))\nmpi.run(5)\n',
			'call polytope.mpi.divide()',
		),
	],
)
def testWhatWouldWaitOrCrashEndsWithAMessage(tmp_path, program, script, says):
	name = tmp_path / 'script.py'
	name.write_text(
		'from yade import *\nfrom yade import O, PyRunner, RockJointMat, polytope\nfrom yade.polytope import mpi\n'
		'if mpi.rank() == 0:\n\tO.materials.append(RockJointMat(density=2600))\n'
		'\tO.bodies.append(polytope.regular(6, 1))\n\tO.engines = polytope.engines(timeStepper=False)\n\tO.dt = 1e-4\n' + script
	)
	options = ['-n', '-x'] if program == 'yade' else []
	assert says in ' '.join(under(2, program, *options, str(name), fails=True).split())


def testASceneThatIsNotDividedIsRefused(tmp_path):
	script = tmp_path / 'undivided.py'
	script.write_text(
		'from yade import *\nfrom yade import O, polytope\nfrom yade.polytope import mpi\n'
		'if mpi.rank() == 0:\n\tO.materials.append(RockJointMat(density=2600))\n'
		'\tO.bodies.append(polytope.regular(6, 1))\n\tO.engines = polytope.engines()\nmpi.run(5)\n'
	)
	assert 'polytope.mpi.divide()' in under(2, sys.executable, str(script), fails=True)


def testExampleOnThreeRanks():
	"""By `./run mpi` as far as the tests were started by `./run`."""
	example = [str(project / 'examples/mpi.py'), '0.05', '24']
	said = [under(0, 'yade', '-n', '-x', *example)]
	if 'buildKey' in os.environ:
		said.append(under(0, 'bash', str(project / 'tools/inside.sh'), 'mpi', '3', *example))
	else:
		said.append(under(3, 'yade', '-n', '-x', *example))
	heights = [[float(line.split('mean height ')[1].split()[0]) for line in text.splitlines() if 'mean height' in line] for text in said]
	assert len(heights[0]) == 1 and heights[0] == heights[1] and heights[0][0] > 0.2
