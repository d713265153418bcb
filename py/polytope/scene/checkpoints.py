# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs that can be continued: states saved at intervals and when the process is told to stop (`checkpoint`), and loaded (`continueFrom`).

The engine PolytopeCheckpoint writes. O.run(…, wait=True) keeps Python's main thread waiting in C++, so the engine itself looks for the
signal, at the end of each step. Python's handler runs as soon as the main thread is free again: it writes if no step was under way, and
then lets the signal do what it does without checkpoints. In a step of O.step(), which the main thread itself computes, it waits for the
engine.
"""

import numbers
import os
import signal
import threading
import time
import zlib

from yade import O, PolytopeCheckpoint

from ..arguments import warn
from .ranks import forgetDivision

__all__ = ['checkpoint', 'continueFrom']

stopping = (signal.SIGTERM, signal.SIGINT)
lookAgain = 0.01
"""Time between looks at a run in the background that is about to end [s]."""

mark = b'polytope'
"""Begins the end of a file, before the CRC-32 of all that stands before it (PolytopeCheckpoint.cpp)."""

_former = {}
"""Signal's number → the handler that was there before."""


def checkpoint(fileName='checkpoint', iterPeriod=0, realPeriod=0, onSignal=True):
	"""An engine that saves the run: ``O.engines = polytope.engines() + [polytope.checkpoint('output/run', realPeriod=600)]``.

	The last two states are kept, as ``output/run.yade`` and ``output/run.previous.yade``; both are complete whenever the process is killed.
	With *onSignal* the run is also saved when the process gets SIGTERM (kill, the end of a job on a cluster) or SIGINT (ctrl-C): at the end
	of the step, or at once between two runs. Then the signal takes its usual effect. Put the engine last.

	:param str fileName: beginning of the files' names; folders are created
	:param int iterPeriod: steps from one state to the next; 0: steps do not count
	:param float realPeriod: seconds of the clock from one state to the next; 0: seconds do not count
	:param bool onSignal: whether to save on SIGTERM and SIGINT; this has to be called in Python's main thread
	:returns: PolytopeCheckpoint
	:raises ValueError: naming an argument that is out of range; *onSignal* outside the main thread
	"""
	if not isinstance(fileName, (str, os.PathLike)) or not os.path.basename(fileName):
		raise ValueError(f'fileName: must be the beginning of a file name, got {fileName!r}')
	for name, period, kind, noun in (
		('iterPeriod', iterPeriod, numbers.Integral, 'a whole number of steps'),
		('realPeriod', realPeriod, numbers.Real, 'a number of seconds'),
	):
		if not isinstance(period, kind) or not period >= 0:
			raise ValueError(f'{name}: must be {noun}, at least 0, got {period!r}')
	if not (onSignal or iterPeriod or realPeriod):
		raise ValueError('onSignal: nothing would ever be saved; give iterPeriod or realPeriod')
	if onSignal:
		_watch()
	return PolytopeCheckpoint(fileName=os.fspath(fileName), iterPeriod=int(iterPeriod), realPeriod=realPeriod, onSignal=bool(onSignal))


def continueFrom(fileName='checkpoint'):
	"""Loads the newest complete state that *checkpoint* has written under this name, with permanent forces, which O.load alone leaves out.

	The run goes on with the engines it was saved with, the checkpoints among them, written under this name. A state saved on several processes
	can go on with another number of them, or with one::

	    if not polytope.continueFrom('output/run'):
	        …  # the first time: bodies, engines and the checkpoint
	    while O.time < 2: O.run(100, wait=True)

	:param str fileName: as it was given to *checkpoint*
	:returns: name of the file that was loaded; None if there is none, and the scene is as it was
	:raises RuntimeError: if there are files and none can be read, or while a run goes on in the background, which would lose its scene in a step
	"""
	fileName = os.fspath(fileName)
	if O.running:
		raise RuntimeError('fileName: nothing is loaded while a run goes on; O.pause() first')
	names = [name for name in (f'{fileName}.yade', f'{fileName}.previous.yade') if os.path.exists(name)]
	faults = []
	for name in names:
		try:
			_checkSum(name)
			O.load(name, quiet=True)
		except Exception as fault:  # whatever the archive's reader throws
			faults.append(f'{name}: {fault}')
			continue
		for fault in faults:
			warn(f'fileName: {fault}; the state before it was loaded')
		_goOn(fileName)
		return name
	if names:
		raise RuntimeError(
			'fileName: no state can be read (one that another version of yade-polytope has written cannot be). ' + '; '.join(faults)
		)
	return None


def _checkSum(name):
	"""Refuses a file whose content is not what was written: the archive's reader takes other bytes for numbers."""
	found, left = 0, os.path.getsize(name) - len(mark) - 4
	with open(name, 'rb') as file:
		while left > 0:
			block = file.read(min(left, 1 << 20))
			found, left = zlib.crc32(block, found), left - len(block)
		if file.read() != mark + found.to_bytes(4, 'little'):
			raise ValueError('its content is not what was written, or its end is missing')


def _engines():
	return [engine for engine in O.engines if isinstance(engine, PolytopeCheckpoint)]


def _goOn(fileName):
	forgetDivision()
	engines = _engines()
	for engine in engines:
		if len(engines) == 1:  # else each has a name of its own
			engine.fileName = fileName
		for k, force, torque in zip(engine.loaded, engine.permanentForces, engine.permanentTorques, strict=True):
			O.forces.setPermF(k, force)
			O.forces.setPermT(k, torque)
		if engine.onSignal:
			_watch()


def _watch():
	if threading.current_thread() is not threading.main_thread():
		raise ValueError("onSignal: must be False here, handlers of signals are set in Python's main thread only")
	for number in stopping:
		if signal.getsignal(number) is not _told:
			_former[number] = signal.signal(number, _told)
	PolytopeCheckpoint.watchSignals()


def _told(number, frame):
	"""Python's handler, in the main thread."""
	while O.running:  # in the background: the engine writes and ends it
		time.sleep(lookAgain)
	watching = [engine for engine in _engines() if engine.onSignal and not engine.dead]
	if O.subStep != -1 and watching and not O.subStepping:  # a PyRunner of O.step(): the scene is between two states
		PolytopeCheckpoint.postpone(number)
		return
	for engine in watching:
		if PolytopeCheckpoint.notedSignal() and O.subStep == -1:
			engine.write()
	former = _former.get(number) or signal.SIG_DFL
	if callable(former):
		former(number, frame)
	elif former is signal.SIG_DFL:
		signal.signal(number, former)
		os.kill(os.getpid(), number)
