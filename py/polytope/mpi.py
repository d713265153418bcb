# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes on several processes by YADE's own engine for it, yade.mpy (MPI); docs/mpi.md.

yade.mpy looks for the collider by the class name InsertionSortCollider and by the label *collider*, and every rank has a time step of its
own. When it divides a scene, contacts across the borders of ranks begin anew. Importing this module lets it find PolytopeCollider, whatever
its label, hands these contacts over as they are, keeps the time steps of all ranks equal, and ends all ranks when one fails. It imports
yade.mpy, which starts MPI: `from yade.polytope import mpi`.
"""

import functools
import math
import sys
import traceback

import yade
from yade import O, PolytopeCheckpoint, PolytopeTimeStepper, PyRunner, TimeStepper, _polytope, mpy

__all__ = ['divide', 'merge', 'rank', 'run', 'size', 'sumOfRanks']

shareStep = "import sys; sys.modules['yade.polytope.mpi'].shareTimeStep()"
"""What runs after a time stepper on each rank."""


def rank():
	"""Number of this process: 0 has the whole scene before it is divided and after it is merged, the others compute."""
	return mpy.rank


def size():
	"""Number of processes; 1 without mpirun."""
	return mpy.numThreads or 1


def divide(axis=0):
	"""Gives each worker an equal number of the bodies that can move, in the order of their positions along an axis. On rank 0, before the
	first run; on the others it does nothing.

	Fixed bodies stay with rank 0, which lets all workers touch them.

	:param int axis: 0, 1, 2: x, y, z
	:raises ValueError: naming *axis*
	"""
	if axis not in (0, 1, 2):
		raise ValueError(f'axis: must be 0, 1 or 2, got {axis!r}')
	if mpy.rank != 0 or size() == 1:
		return
	moving = [body for body in O.bodies if body is not None and body.dynamic]
	moving.sort(key=lambda body: body.state.pos[axis])
	for k, body in enumerate(moving):
		body.subdomain = 1 + k * (size() - 1) // len(moving)


def run(steps, merged=True):
	"""Runs steps on all ranks; every rank has to call it. With one process it is O.run(steps, wait=True).

	:param int steps: how many
	:param bool merged: whether rank 0 has the whole scene afterwards, to be measured, drawn and saved; takes time
	"""
	if size() == 1:
		O.run(steps, wait=True)
		return
	mpy.mpirun(steps, size(), withMerge=merged)


def merge():
	"""Brings the whole scene to rank 0; every rank has to call it. The next run() divides it again as it was."""
	if size() > 1:
		mpy.mergeScene()


def sumOfRanks(number):
	"""Sum of each rank's number, on every rank; every rank has to call it."""
	return mpy.comm.allreduce(number, op=mpy.MPI.SUM) if size() > 1 else number


def shareTimeStep():
	"""Every rank takes the smallest of the time steps that the ranks have found; where none has found a limit, each keeps its own."""
	if size() > 1 and O.splitted:
		least = mpy.comm.allreduce(O.dt if _limitsTheStep() else math.inf, op=mpy.MPI.MIN)
		if least < math.inf:
			O.dt = least


def _limitsTheStep():
	"""Whether this rank's time stepper has found a limit. Rank 0 has fixed bodies alone, and the time step that O.reset has left."""
	stepper = next(engine for engine in O.engines if isinstance(engine, TimeStepper))
	return bool(stepper.limitedBy) if isinstance(stepper, PolytopeTimeStepper) else mpy.rank > 0


def _typedEngine(name):
	"""YADE's function of this name finds the class alone, not those derived from it."""
	kind = getattr(yade, name)
	for engine in O.engines:
		if isinstance(engine, kind):
			return engine
	raise RuntimeError(f'O.engines: there is no {name}, which a run on several processes needs')


def _prepared(splitScene):
	"""The scene as yade.mpy needs it, when it is divided for the first time."""

	@functools.wraps(splitScene)
	def split():
		if mpy.rank == 0 and not O.splittedOnce:
			_check()
			_forgetDivision()
			plain = O.engines
			O.engines = _sharing(plain)
			splitScene()
			O.initialEngines = plain  # what the merged scene gets
		else:
			splitScene()

	return split


def _sharing(engines):
	"""With one time step on all ranks; without saved states, of which each rank would write its own part under the same name."""
	made = []
	for engine in engines:
		if isinstance(engine, PolytopeCheckpoint):
			continue
		made.append(engine)
		if isinstance(engine, TimeStepper):
			made.append(PyRunner(iterPeriod=1, initRun=True, command=shareStep))
	return made


def _forgetDivision():
	"""What an earlier division has left in a scene that was saved after it: the bodies that stand for ranks."""
	for body in O.bodies:
		if body.isSubdomain:
			O.bodies.erase(body.id)
	dispatcher = _typedEngine('InsertionSortCollider').boundDispatcher
	dispatcher.functors = [functor for functor in dispatcher.functors if not isinstance(functor, yade.Bo1_Subdomain_Aabb)]


def _check():
	_typedEngine('InsertionSortCollider')
	_typedEngine('NewtonIntegrator')
	if O.periodic:
		raise RuntimeError('O.periodic: yade.mpy takes wrong boxes of ranks in a periodic cell; run this scene on one process')
	if mpy.REALLOCATE_FREQUENCY:
		raise RuntimeError('mpy.REALLOCATE_FREQUENCY: must be 0; a body that changes ranks during a run would lose contacts')
	if any(body is not None and body.isClump for body in O.bodies):
		raise RuntimeError('O.bodies: clumps are not supported on several processes; run this scene on one')
	moving = [body for body in O.bodies if body is not None and body.dynamic]
	if not mpy.DOMAIN_DECOMPOSITION and all(body.subdomain == 0 for body in moving):
		raise RuntimeError('Body.subdomain: all bodies are with rank 0; call polytope.mpi.divide() or set mpy.DOMAIN_DECOMPOSITION')


def _withCollider(parallelCollide):
	@functools.wraps(parallelCollide)
	def collide():
		mpy.collider = _typedEngine('InsertionSortCollider')
		divided = mpy.rank > 0 and not O.splitted  # this worker still has the whole scene
		contacts = _polytope.WorkerContacts() if divided else None
		parallelCollide()
		if contacts:
			contacts.put()

	return collide


def _endAll(kind, fault, trace):
	"""An exception that ends one rank ends all: the others would wait for it for ever."""
	traceback.print_exception(kind, fault, trace)
	sys.stdout.flush()
	sys.stderr.flush()
	mpy.MPI.COMM_WORLD.Abort(1)


def _exit(status=None):
	"""As sys.exit, but one that says that something has failed ends all ranks: the program yade calls it after an exception."""
	if status not in (None, 0):
		sys.stdout.flush()
		sys.stderr.flush()
		mpy.MPI.COMM_WORLD.Abort(status if isinstance(status, int) else 1)
	raise SystemExit(status)


def _set():
	mpy.typedEngine = _typedEngine
	mpy.splitScene = _prepared(mpy.splitScene)
	mpy.parallelCollide = _withCollider(mpy.parallelCollide)
	mpy.bodiesAreOurs = True
	if size() > 1:
		sys.excepthook = _endAll
		sys.exit = _exit


if not hasattr(mpy, 'bodiesAreOurs'):  # once
	_set()
