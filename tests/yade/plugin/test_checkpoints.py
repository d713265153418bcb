# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs that are ended by signals, in processes of their own, and continued: they end where the uninterrupted run does, bit for bit."""

import os
import pathlib
import resource
import signal
import subprocess
import sys
import threading
import time

import pytest
from scenes import runInBackground
from yade import ForceResetter, NewtonIntegrator, O, PolytopeCheckpoint, RockJointMat, polytope

program = r'''
import os, signal, sys, time
sys.path.insert(0, sys.argv[1])
from yade import *
from yade import O, Quaternion, polytope
from scenes import joint, loop
name, steps, how = sys.argv[2], int(sys.argv[3]), sys.argv[4]
options = dict(option.split('=') for option in sys.argv[5:])

def build():
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
	loop(True, normalDamping=0.3, gravity=(0, 0, -9.81), damping=0.1)
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	for k in range(int(options.get('bodies', 4))):
		O.bodies.append(polytope.cuboid((2 * (k % 4), 0, .31 + k // 4), (.5, .4, .3), Quaternion((1, k, 0), 0.05 * k)))
	O.dt = 2e-4
	O.forces.setPermF(1, (200, 0, 0))
	O.engines = O.engines + [polytope.checkpoint(name, iterPeriod=int(options.get('every', 0)))]

start = polytope.continueFrom(name)
if not start: build()
if 'signalAt' in options and not start:
	at, number = options['signalAt'].split(',')
	command = f"import signal; O.iter == {at} and signal.raise_signal({number})"  # os.kill may reach another thread, some steps later
	O.engines = [PyRunner(iterPeriod=1, initRun=True, command=command)] + O.engines
print('from', start, O.iter, flush=True)
if how == 'wait':
	O.run(steps - O.iter, wait=True)
elif how == 'step':
	while O.iter < steps: O.step()
elif how == 'background':
	O.run(steps - O.iter)
	while O.running: time.sleep(0.01)
elif how == 'idle':
	O.run(50, wait=True)
	print('idle', flush=True)
	while True: time.sleep(0.05)
for body in O.bodies:
	print('state', *(x.hex() for x in (*body.state.pos, *body.state.ori, *body.state.vel, *body.state.angVel)))
print('end', O.iter, O.time.hex(), flush=True)
'''
here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
many = 10**9
"""Steps of a run that ends by a signal."""
hangs = 600
"""Time after which a process is taken for one that hangs [s]; on a machine that does nothing else each ends after seconds."""


def start(folder, steps=400, how='wait', **options):
	return subprocess.Popen(
		[sys.executable, '-c', program, here, str(folder / 'run'), str(steps), how, *(f'{key}={value}' for key, value in options.items())],
		stdout=subprocess.PIPE,
		stderr=subprocess.PIPE,
		text=True,
		env={**os.environ, 'OMP_NUM_THREADS': '1'},
	)


def result(folder, **options):
	process = start(folder, **options)
	said, errors = process.communicate(timeout=hangs)
	assert process.returncode == 0, errors
	return [line for line in said.splitlines() if line.startswith(('from', 'state', 'end'))]


def waitFor(process, text):
	for line in process.stdout:
		if line.startswith(text):
			return
	raise AssertionError(process.stderr.read())


def until(condition):
	end = time.monotonic() + hangs
	while not condition():
		assert time.monotonic() < end, 'nothing happened'
		time.sleep(0.005)


@pytest.fixture(scope='module')
def uninterrupted(tmp_path_factory):
	lines = result(tmp_path_factory.mktemp('whole'), steps=1500, how='wait')
	assert lines[0] == 'from None 0' and lines[-1].startswith('end 1500')
	return lines[1:]


@pytest.mark.parametrize('how', ['wait', 'step', 'background'])
@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGINT], ids=['SIGTERM', 'SIGINT'])
def testASignalSavesTheRunAndEndsIt(tmp_path, uninterrupted, how, number):
	process = start(tmp_path, many, how)
	waitFor(process, 'from')
	time.sleep(0.1)
	process.send_signal(number)
	_, errors = process.communicate(timeout=hangs)
	assert process.returncode == -number  # Python ends itself so by ctrl-C, too
	assert ('KeyboardInterrupt' in errors) == (number == signal.SIGINT)
	assert [path.name for path in tmp_path.iterdir()] == ['run.yade']
	O.load(f'{tmp_path}/run.yade')
	assert 0 < O.iter < many and O.time == pytest.approx(O.iter * O.dt, rel=1e-9)
	if O.iter < 1500:  # else the process was so fast that there is nothing to compare with
		lines = result(tmp_path, steps=1500)
		assert lines[0] == f'from {tmp_path}/run.yade {O.iter}' and lines[1:] == uninterrupted


@pytest.mark.parametrize('how', ['wait', 'step', 'background'])
def testASignalInAStepSavesAtItsEnd(tmp_path, uninterrupted, how):
	"""The process signals itself in the middle of step 300, so that what is saved is known."""
	process = start(tmp_path, 1500, how, signalAt=f'300,{int(signal.SIGTERM)}')
	process.communicate(timeout=hangs)
	assert process.returncode == -signal.SIGTERM
	lines = result(tmp_path, steps=1500)
	assert lines[0] == f'from {tmp_path}/run.yade 301' and lines[1:] == uninterrupted


def testASignalBetweenTwoRunsSavesAtOnce(tmp_path, uninterrupted):
	process = start(tmp_path, 0, 'idle')
	waitFor(process, 'idle')
	process.terminate()
	process.communicate(timeout=hangs)
	assert process.returncode == -signal.SIGTERM
	lines = result(tmp_path, steps=1500)
	assert lines[0] == f'from {tmp_path}/run.yade 50' and lines[1:] == uninterrupted


def testKilledWhileItRuns(tmp_path, uninterrupted):
	"""SIGKILL at any moment: the last two states are complete, and the run goes on from the newest."""
	process = start(tmp_path, many, 'wait', every=20)
	until(lambda: (tmp_path / 'run.previous.yade').exists())
	time.sleep(0.05)
	process.kill()
	process.communicate(timeout=hangs)
	saved = {}
	for name in ('run.previous', 'run'):
		path = tmp_path / f'{name}.yade'
		if path.exists():  # between two renamings there is one
			O.load(str(path))
			saved[name] = O.iter
	assert saved['run.previous'] > 0 and saved['run.previous'] % 20 == 1  # PeriodicEngine counts from the first step
	assert 'run' not in saved or saved['run'] == saved['run.previous'] + 20
	if max(saved.values()) < 1500:
		lines = result(tmp_path, steps=1500)
		assert lines[0].endswith(f' {max(saved.values())}') and lines[1:] == uninterrupted


def testKilledInTheMiddleOfWriting(tmp_path):
	"""A scene that takes long to write; the process is killed while its file grows."""
	process = start(tmp_path, many, 'wait', every=1, bodies=2000)
	writing, last = tmp_path / 'run.writing.yade', tmp_path / 'run.yade'
	until(last.exists)
	whole = last.stat().st_size

	def halfWritten():
		try:
			return 0 < writing.stat().st_size < 0.9 * whole
		except FileNotFoundError:
			return False

	for _ in range(10):
		until(halfWritten)
		process.send_signal(signal.SIGSTOP)  # it may be further by now
		time.sleep(0.02)
		if halfWritten():
			break
		process.send_signal(signal.SIGCONT)
	assert halfWritten()
	process.kill()
	process.communicate(timeout=hangs)
	assert 0 < writing.stat().st_size < 0.9 * whole
	with pytest.raises(Exception, match='.'):
		O.load(str(writing))
	assert polytope.continueFrom(tmp_path / 'run') in (str(last), str(tmp_path / 'run.previous.yade'))
	assert len(O.bodies) == 2001 and O.iter > 0


def scene(engine):
	O.engines = [ForceResetter(), NewtonIntegrator(), engine]
	O.bodies.append(polytope.regular(6, 1, material=RockJointMat(density=2600)))
	O.dt = 1e-3


def testTheLastTwoAreKept(tmp_path):
	scene(polytope.checkpoint(tmp_path / 'deep/run', iterPeriod=5, onSignal=False))
	for _ in range(23):
		O.step()
	assert {path.name for path in (tmp_path / 'deep').iterdir()} == {'run.yade', 'run.previous.yade'}
	assert O.iter == 23 and O.engines[2].written == 4
	O.load(f'{tmp_path}/deep/run.previous.yade')
	assert O.iter == 16 and O.time == pytest.approx(0.016)
	assert polytope.continueFrom(f'{tmp_path}/deep/run') == f'{tmp_path}/deep/run.yade'
	assert O.iter == 21 and O.time == pytest.approx(0.021)
	O.step()
	assert O.iter == 22 and O.engines[2].written == 4


def testSecondsOfTheClock(tmp_path):
	scene(polytope.checkpoint(tmp_path / 'run', realPeriod=0.05, onSignal=False))
	O.step()
	assert O.engines[2].written == 0
	time.sleep(0.06)
	O.step()
	assert O.engines[2].written == 1 and (tmp_path / 'run.yade').exists()


def testTruncatedFileGivesWayToTheOneBefore(tmp_path):
	scene(polytope.checkpoint(tmp_path / 'run', iterPeriod=1, onSignal=False))
	for _ in range(4):
		O.step()
	last = tmp_path / 'run.yade'
	last.write_bytes(last.read_bytes()[:-300])
	with pytest.warns(UserWarning, match='run.yade: '):
		assert polytope.continueFrom(tmp_path / 'run') == f'{tmp_path}/run.previous.yade'
	assert O.iter == 3
	(tmp_path / 'run.previous.yade').write_bytes(b'')
	with pytest.raises(RuntimeError, match='no state can be read'):
		polytope.continueFrom(tmp_path / 'run')


def testGarbledFileGivesWayToTheOneBefore(tmp_path):
	"""Three bytes that were changed anywhere in it; the archive's reader takes most of them as they are. O.load reads the file all the same."""
	scene(polytope.checkpoint(tmp_path / 'run', iterPeriod=1, onSignal=False))
	for _ in range(4):
		O.step()
	good, last = (tmp_path / 'run.yade').read_bytes(), tmp_path / 'run.yade'
	O.load(str(last), quiet=True)
	assert O.iter == 4
	for place in range(0, len(good), len(good) // 30):
		content = bytearray(good)
		for k in range(place, min(place + 3, len(good))):
			content[k] ^= 0x5A
		last.write_bytes(content)
		with pytest.warns(UserWarning, match='run.yade: its content is not what was written'):
			assert polytope.continueFrom(tmp_path / 'run') == f'{tmp_path}/run.previous.yade'
		assert O.iter == 3


@pytest.mark.parametrize('missing', [1, 500, 5000])
def testFullDiskKeepsTheLastState(tmp_path, missing):
	"""The system takes no more bytes, at the end of the file or before: in a process that may not write larger files."""
	scene(polytope.checkpoint(tmp_path / 'run', iterPeriod=1, onSignal=False))
	for _ in range(3):
		O.step()
	good = (tmp_path / 'run.yade').read_bytes()
	before = resource.getrlimit(resource.RLIMIT_FSIZE)
	resource.setrlimit(resource.RLIMIT_FSIZE, (len(good) - missing, before[1]))
	try:
		with pytest.raises(RuntimeError, match='fileName: cannot write .*run.writing.yade; is the disk full'):
			O.engines[2].write()
	finally:
		resource.setrlimit(resource.RLIMIT_FSIZE, before)
	assert (tmp_path / 'run.yade').read_bytes() == good and (tmp_path / 'run.previous.yade').exists()
	O.engines[2].write()
	assert polytope.continueFrom(tmp_path / 'run') == f'{tmp_path}/run.yade' and O.iter == 3


def testNothingToContinueFromLeavesTheScene(tmp_path):
	scene(PolytopeCheckpoint())
	assert polytope.continueFrom(tmp_path / 'run') is None and len(O.bodies) == 1


def testNothingIsLoadedWhileARunGoesOn(tmp_path):
	"""It would take the scene from the thread that computes a step: a crash, before this was refused."""
	scene(polytope.checkpoint(tmp_path / 'run', iterPeriod=10**6, onSignal=False))
	O.engines[2].write()
	runInBackground()
	try:
		with pytest.raises(RuntimeError, match='nothing is loaded while a run goes on; O.pause'):
			polytope.continueFrom(tmp_path / 'run')
		assert O.running and O.iter > 0
	finally:
		O.pause()
	assert polytope.continueFrom(tmp_path / 'run') == f'{tmp_path}/run.yade' and O.iter == 0


def testRefusals(tmp_path):
	for options, name in (
		({'fileName': ''}, 'fileName'),
		({'fileName': 3}, 'fileName'),
		({'iterPeriod': -1}, 'iterPeriod'),
		({'iterPeriod': 0.5}, 'iterPeriod'),
		({'realPeriod': '9'}, 'realPeriod'),
		({'realPeriod': -1}, 'realPeriod'),
		({'onSignal': False}, 'onSignal'),
	):
		with pytest.raises(ValueError, match=f'^{name}: '):
			polytope.checkpoint(**{'fileName': str(tmp_path / 'x'), **options})
	refused = []

	def outside():
		try:
			polytope.checkpoint(str(tmp_path / 'x'))
		except ValueError as fault:
			refused.append(str(fault))

	thread = threading.Thread(target=outside)
	thread.start()
	thread.join()
	assert len(refused) == 1 and refused[0].startswith('onSignal: ')
	assert pathlib.Path(tmp_path).exists()
