# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes on 2 and 3 ranks under mpirun against one process: bodies, contacts and what joints remember."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest
from yade import polytope

if shutil.which('mpirun') is None or 'MPI' not in polytope.buildInfo()['yadeFeatures']:
	pytest.skip('YADE has no MPI here, or there is no mpirun', allow_module_level=True)

here = pathlib.Path(__file__).resolve().parent
project = here.parents[1]
hangs = 600
"""Time after which a run is taken for one that hangs [s]; one takes some seconds."""

heap = r'''
import json, os, random, sys
sys.path.insert(0, sys.argv[1])
from yade import *
from yade import O, Quaternion, Vector3, polytope
start, steps = sys.argv[2], int(sys.argv[3])
if len(sys.argv) == 4:
	random.seed(1)
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5, dilationAngle=0.05))
	O.bodies.append(polytope.plates((-1, -0.5, 0), (1, 0.5, 2)))
	for k in range(24):
		place = (-0.75 + 0.5 * (k % 4) + random.uniform(-0.02, 0.02), -0.24 + 0.48 * (k // 4 % 2), 0.25 + 0.45 * (k // 8))
		O.bodies.append(polytope.regular((4, 6, 8, 12, 20)[k % 5], 0.22, place, Quaternion((1, k, 2), k)))
	O.engines = polytope.engines()
	O.run(2500, wait=True)
	O.save(start)
	sys.exit()
from yade.polytope import mpi
O.load(start)
parts = int(sys.argv[5])
mpi.divide(0)
for _ in range(parts):
	mpi.run(steps // parts)
if mpi.rank() == 0:
	if len(sys.argv) > 6: O.save(sys.argv[6])
	whole = lambda vector: [x.hex() for x in vector]
	bodies = {b.id: [*whole(b.state.pos), *whole(b.state.ori), *whole(b.state.vel), *whole(b.state.angVel)] for b in O.bodies if b and b.dynamic and not b.isSubdomain}
	contacts = [
		[i.id1, i.id2, whole(i.geom.normal), whole(i.phys.normalForce), whole(i.phys.shearForce), whole(i.phys.slip), i.phys.dilation.hex(), i.phys.intact]
		for i in O.interactions if i.isReal
	]
	json.dump({'bodies': bodies, 'contacts': contacts, 'iter': O.iter, 'time': O.time, 'engines': len(O.engines),
		'coordination': polytope.coordinationNumber().mean, 'mass': polytope.arrays().bodies.masses.sum()}, open(sys.argv[4], 'w'))
'''


def under(ranks, *command, fails=False):
	"""What a command has printed on this number of ranks, 0: without MPI."""
	run = ['mpirun', '--oversubscribe', '-np', str(ranks)] if ranks else []
	environment = {
		**os.environ,
		'OMP_NUM_THREADS': '1',
		'OMPI_ALLOW_RUN_AS_ROOT': '1',
		'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1',
		'OMPI_MCA_btl': 'self,sm',
		'OMPI_MCA_mpi_yield_when_idle': '1',
	}
	done = subprocess.run([*run, *command], capture_output=True, text=True, timeout=hangs, env=environment)
	assert (done.returncode != 0) == fails, done.stdout + done.stderr
	return done.stdout + done.stderr


@pytest.fixture(scope='module')
def settled(tmp_path_factory):
	folder = tmp_path_factory.mktemp('mpi')
	under(0, sys.executable, '-c', heap, str(here), f'{folder}/start.yade', '0')
	return folder


def ended(folder, ranks, steps=100, parts=1):
	name = f'{folder}/{ranks}-{steps}-{parts}.json'
	if not os.path.exists(name):
		under(ranks, sys.executable, '-c', heap, str(here), f'{folder}/start.yade', str(steps), name, str(parts))
	return json.loads(pathlib.Path(name).read_text())


def farthest(one, other):
	return max(abs(float.fromhex(x) - float.fromhex(y)) for x, y in zip(one, other, strict=True))


def flat(contact):
	return [x for part in contact[2:6] for x in part] + [contact[6]]


@pytest.mark.parametrize('ranks, parts', [(2, 1), (3, 1), (3, 2)])
def testMergedSceneIsThatOfOneProcess(settled, ranks, parts):
	"""To 1e-12 of a body's size over 100 steps; parts: merged and divided again in between."""
	one, several = ended(settled, 0), ended(settled, ranks, parts=parts)
	assert one['iter'] == several['iter'] == 2600 and one['engines'] == several['engines']
	assert one['coordination'] == several['coordination'] > 1 and one['mass'] == pytest.approx(several['mass'], rel=1e-12)
	assert one['time'] == pytest.approx(several['time'], rel=1e-13)
	assert one['bodies'].keys() == several['bodies'].keys() and len(one['bodies']) == 24
	assert max(farthest(one['bodies'][k][:7], several['bodies'][k][:7]) for k in one['bodies']) < 1e-12 * 0.22
	assert max(farthest(one['bodies'][k][7:], several['bodies'][k][7:]) for k in one['bodies']) < 1e-9


@pytest.mark.parametrize('ranks', [2, 3])
def testContactsKeepWhatTheyRemember(settled, ranks):
	one, several = (
		{tuple(sorted(contact[:2])): contact for contact in ended(settled, number)['contacts']} for number in (0, ranks)
	)
	assert one.keys() == several.keys() and len(one) > 24
	largest = max(abs(float.fromhex(x)) for contact in one.values() for x in contact[3])
	for ids, contact in one.items():
		assert contact[:2] == several[ids][:2] and contact[7] == several[ids][7]
		assert farthest(flat(contact), flat(several[ids])) < 1e-9 * largest
	assert any(float.fromhex(x) != 0 for contact in one.values() for x in contact[4])
	assert any(float.fromhex(x) != 0 for contact in one.values() for x in contact[5])


def testAMergedSceneIsSavedAndContinued(settled):
	"""Saved on rank 0 after a merge, loaded and divided by other processes."""
	saved, name = f'{settled}/saved.yade', f'{settled}/continued.json'
	under(3, sys.executable, '-c', heap, str(here), f'{settled}/start.yade', '50', f'{settled}/half.json', '1', saved)
	under(3, sys.executable, '-c', heap, str(here), saved, '50', name, '1')
	one, several = ended(settled, 0), json.loads(pathlib.Path(name).read_text())
	assert several['iter'] == 2600 and one['bodies'].keys() == several['bodies'].keys()
	assert max(farthest(one['bodies'][k][:7], several['bodies'][k][:7]) for k in one['bodies']) < 1e-12 * 0.22


def testTheSceneMoves(settled):
	"""Else the comparison above would say nothing."""
	start, end = ended(settled, 0, steps=0), ended(settled, 0)
	assert max(farthest(start['bodies'][k][:3], end['bodies'][k][:3]) for k in start['bodies']) > 1e-7


def testARankThatFailsEndsTheRun(tmp_path):
	script = tmp_path / 'fails.py'
	script.write_text('from yade import *\nfrom yade import polytope\nfrom yade.polytope import mpi\n'
	                  'if mpi.rank() == 1:\n\traise ValueError("on purpose")\nmpi.mpy.comm.barrier()\nmpi.mpy.comm.recv(source=1, tag=99)\n')
	for program in ([sys.executable], ['yade', '-n', '-x']):
		assert 'on purpose' in under(2, *program, str(script), fails=True)


def testASceneThatIsNotDividedIsRefused(tmp_path):
	script = tmp_path / 'undivided.py'
	script.write_text('from yade import *\nfrom yade import O, polytope\nfrom yade.polytope import mpi\n'
	                  'if mpi.rank() == 0:\n\tO.materials.append(RockJointMat(density=2600))\n'
	                  '\tO.bodies.append(polytope.regular(6, 1))\n\tO.engines = polytope.engines()\nmpi.run(5)\n')
	assert 'polytope.mpi.divide()' in under(2, sys.executable, str(script), fails=True)


def testExampleOnThreeRanks(tmp_path):
	text = (project / 'examples/mpi.py').read_text()
	short = text.replace('seconds, report = 0.4, 0.1', 'seconds, report = 0.05, 0.05').replace('range(96)', 'range(24)').replace('[-96:', '[6:30')
	assert short.count('range(24)') == 1 and short.count('[6:30') == 1 and '0.05, 0.05' in short
	script = tmp_path / 'mpi.py'
	script.write_text(short)
	heights = [
		float(line.split('mean height ')[1].split()[0])
		for ranks in (0, 3)
		for line in under(ranks, 'yade', '-n', '-x', str(script)).splitlines()
		if 'mean height' in line
	]
	assert len(heights) == 2 and heights[0] == heights[1] > 0.2


sliding = r'''
import json, sys
from yade import *
from yade import O, Quaternion, polytope
from yade.polytope import mpi
pieces, steps, name = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
if mpi.rank() == 0:
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.3, dilationAngle=0.05))
	half = 6 / pieces
	O.bodies.append([polytope.cuboid((half * (2 * k + 1) - 4, 0, -0.5), (half, 1, 0.5), fixed=True) for k in range(pieces)])
	for k in range(8):
		O.bodies.append(polytope.cuboid((0.7 * k - 3, 0, 0.2), (0.2, 0.3, 0.2), Quaternion((0, 0, 1), 0.1 * k)))
		O.bodies[-1].state.vel = (2.0 + 0.05 * k, 0.1, 0)
	O.engines = polytope.engines(timeStepper=False)
	O.dt = 3e-4
mpi.divide(0)
mpi.run(steps)
if mpi.rank() == 0:
	json.dump({'bodies': {b.id: [*b.state.pos] for b in O.bodies if b and b.dynamic and not b.isSubdomain},
		'contacts': {f'{i.id1} {i.id2}': [*i.phys.shearForce, *i.phys.slip, i.phys.dilation] for i in O.interactions if i.isReal}}, open(name, 'w'))
'''


@pytest.mark.parametrize('pieces, steps', [(1, 400), (24, 80)])
def testBlocksThatSlideFromOneRanksPartToTheOthers(tmp_path, pieces, steps):
	for ranks in (0, 3):
		under(ranks, sys.executable, '-c', sliding, str(pieces), str(steps), f'{tmp_path}/{ranks}.json')
	one, several = (json.loads((tmp_path / f'{ranks}.json').read_text()) for ranks in (0, 3))
	assert one['bodies'].keys() == several['bodies'].keys() and one['contacts'].keys() == several['contacts'].keys()
	for kind, tolerance in (('bodies', 1e-12 * 0.4), ('contacts', 1e-9 * 2500)):
		assert max(abs(x - y) for k in one[kind] for x, y in zip(one[kind][k], several[kind][k], strict=True)) < tolerance
	assert min(position[0] - (0.7 * k - 3) for k, position in enumerate(one['bodies'].values())) > 3e-4 * steps
	assert max(abs(contact[3]) for contact in one['contacts'].values()) > 1e-4  # slip


@pytest.mark.parametrize('change, said', [
	('O.periodic = True', 'O.periodic'),
	('mpi.mpy.REALLOCATE_FREQUENCY = 1', 'mpy.REALLOCATE_FREQUENCY'),
	('O.bodies.appendClumped([polytope.regular(6, 1, (3, 0, 0)), polytope.regular(6, 1, (4, 0, 0))])', 'clumps'),
])
def testWhatCannotBeHadIsRefused(tmp_path, change, said):
	script = tmp_path / 'refused.py'
	script.write_text('from yade import *\nfrom yade import O, polytope\nfrom yade.polytope import mpi\n'
	                  'if mpi.rank() == 0:\n\tO.materials.append(RockJointMat(density=2600))\n'
	                  f'\tO.bodies.append(polytope.regular(6, 1))\n\tO.engines = polytope.engines()\n\t{change}\nmpi.divide()\nmpi.run(5)\n')
	assert said in under(2, sys.executable, str(script), fails=True)
