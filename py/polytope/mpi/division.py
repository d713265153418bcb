# SPDX-License-Identifier: GPL-2.0-or-later
"""How yade.mpy divides a scene, set right for polytopes.

yade.mpy looks for the collider by the class name InsertionSortCollider and by the label *collider*, and every rank has a time step of its
own. When it divides a scene, contacts across the borders of ranks begin anew, and permanent forces are lost. *install* lets it find
PolytopeCollider, whatever its label, hands contacts and permanent forces over as they are, keeps the time steps of all ranks equal, refuses what
would come out wrong, and ends all ranks when one fails.
"""

import functools
import math
import sys
import traceback

import yade
from yade import InteractionLoop, O, PolytopeTimeStepper, PyRunner, TimeStepper, mpy

from ..bonding import bolting
from ..scene.movers import moverOf
from ..scene.ranks import eraseRanks
from . import bonds, clumps, dampers, decomposition, joints, permanentLoads, reallocation, waiting
from .recorders import ofWholeScene

__all__ = ['check', 'handOut', 'install', 'shareTimeStep', 'size']

shareStep = "import sys; sys.modules['yade.polytope.mpi'].shareTimeStep()"
"""What runs after a time stepper on each rank."""
shareDampers = "import sys; sys.modules['yade.polytope.mpi.dampers'].share()"
"""What runs before the contacts."""


_ranksOfBodies = {}
"""On rank 0 while the scene is merged: body's id → rank. The bodies themselves are rank 0's then, which can step alone."""


def size():
	"""Number of processes; 1 without mpirun."""
	return mpy.numThreads or 1


def handOut():
	"""The next run hands the scene of rank 0 out to all ranks, as the first one does. On every rank; the scene must be merged."""
	O.splittedOnce = False


def assign(ranks):
	"""Gives bodies to ranks, on rank 0.

	:param dict ranks: id → rank; the others stay with rank 0, members of clumps with their clump
	"""
	_ranksOfBodies.clear()
	for body in O.bodies:
		body.subdomain = ranks.get(moverOf(body.id), 0)


def _own():
	"""Makes all bodies those of rank 0, after a merge: YADE leaves out contacts neither of whose bodies belongs to the rank that it runs on."""
	for body in O.bodies:
		if body.subdomain != 0 and not body.isSubdomain:
			_ranksOfBodies[body.id] = body.subdomain
			body.subdomain = 0


def _disown():
	"""Gives the bodies back to their ranks, before the scene is divided again."""
	for k, rank in _ranksOfBodies.items():
		if O.bodies[k] is not None:
			O.bodies[k].subdomain = rank
	_ranksOfBodies.clear()


def shareTimeStep():
	"""Every rank takes the smallest of the time steps that the ranks have found; where none has found a limit, each keeps its own."""
	if size() > 1 and O.splitted:
		waiting.forAll()
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
	@functools.wraps(splitScene)
	def split():
		_handOutScene(splitScene)
		bonds.divide(True)

	return split


def _handOutScene(splitScene):
	"""The scene as yade.mpy needs it, when it is handed out to all ranks."""
	_disown()
	waiting.agree()
	if O.splittedOnce:
		splitScene()
		return
	if mpy.rank != 0:
		splitScene()
		permanentLoads.take(None)
		return
	check()
	eraseRanks()
	if mpy.DOMAIN_DECOMPOSITION:
		decomposition.prepare()
	clumps.giveMaterials()
	loads = permanentLoads.ofAll()
	plain = O.engines
	O.engines = _sharing(plain)
	splitScene()
	O.initialEngines = plain  # what the merged scene gets
	permanentLoads.take(loads)


def _sharing(engines):
	"""The engines with one time step on all ranks, and with dampers that know all contacts; without what writes the whole scene (recorders.py)."""
	made = []
	for engine in engines:
		if ofWholeScene(engine):
			continue
		if isinstance(engine, InteractionLoop):
			made.append(PyRunner(iterPeriod=1, initRun=True, command=shareDampers))
		made.append(engine)
		if isinstance(engine, TimeStepper):
			made.append(PyRunner(iterPeriod=1, initRun=True, command=shareStep))
	return made


def check():
	"""Refuses a scene that would come out wrong on several processes. On rank 0.

	:raises RuntimeError: naming what is wrong, and what to do
	"""
	_typedEngine('InsertionSortCollider')
	_typedEngine('NewtonIntegrator')
	_checkSettings()
	if bolting.madeBolts():
		raise RuntimeError('O.engines: bolts (polytope.bolt) do not act on several processes; run this scene on one process')
	if O.periodic:
		raise RuntimeError('O.periodic: yade.mpy takes wrong boxes of ranks in a periodic cell; run this scene on one process')
	if O.trackEnergy:
		raise RuntimeError(
			'O.trackEnergy: must be False; contacts of two ranks would count twice. polytope.mpi.arrays() has what energies are made of'
		)
	for engine in O.engines:
		if isinstance(engine, yade.Recorder):
			name = engine.__class__.__name__
			raise RuntimeError(
				f'O.engines: each rank would write the file of {name}; take it out, and call it on rank 0 after polytope.mpi.merge()'
			)
	if not clumps.movers():
		raise RuntimeError('O.bodies: no body can move; a run on several processes divides those that can')
	if mpy.DOMAIN_DECOMPOSITION:
		return
	ranks = [body.subdomain for body in clumps.movers()]
	if not any(ranks):
		raise RuntimeError('Body.subdomain: all bodies are with rank 0; call polytope.mpi.divide() or set mpy.DOMAIN_DECOMPOSITION')
	if not all(0 < rank < size() for rank in ranks):
		raise RuntimeError(f'Body.subdomain: must be a rank, 1 to {size() - 1}; call polytope.mpi.divide()')
	clumps.check()


def _checkSettings():
	"""Settings of yade.mpy that lose bodies or contacts."""
	for name, wanted, why in (
		('ERASE_REMOTE', True, 'ranks would keep dead copies of bodies'),
		('COPY_MIRROR_BODIES_WHEN_COLLIDE', True, 'bodies that come near another rank would be missed there'),
		('USE_CPP_MPI', True, 'its other way gives states of one rank to bodies of another where rank 0 has bodies that are touched'),
		('OPTIMIZE_COM', True, 'it was not tested with polytopes'),
		('MERGE_W_INTERACTIONS', True, 'merged contacts would begin anew'),
		('MASTER_UPDATE_STATES', True, 'fixed bodies that have a velocity would stand still for the other ranks'),
		('REALLOCATE_MINIMAL', False, 'bodies would be left out that others touch'),
		('RESET_SUBDOMAINS_WHEN_COLLIDE', False, 'contacts would begin anew; call polytope.mpi.divide() between two runs instead'),
		('DISTRIBUTED_INSERT', False, 'polytope.mpi hands out the scene of rank 0'),
		('MERGE_SPLIT', False, 'polytope.mpi.run() merges where it is needed'),
		('MINIMAL_INTERSECTIONS', False, 'it was not tested with polytopes'),
	):
		if getattr(mpy, name) != wanted:
			raise RuntimeError(f'mpy.{name}: must be {wanted!r}; {why}')


def _withNeighboursOfBoth(genLocalIntersections):
	"""A worker is a neighbour where either of both finds it so: their searches for pairs differ where boxes just meet, and one would wait
	for the other's message for ever."""

	@functools.wraps(genLocalIntersections)
	def generate(subdomains):
		lists, own = genLocalIntersections(subdomains), mpy.rank
		for other, found in enumerate(mpy.comm.allgather(lists[own])):
			if 0 < other != own > 0 and own in found and other not in lists[own]:
				lists[own].append(other)
		return lists

	return generate


def _refuseErased():
	"""Refuses bodies that were erased, on a worker, before a merge: yade.mpy would send a body that is not there."""
	erased = [k for k in O.subD.ids if O.bodies[k] is None]
	if erased:
		raise RuntimeError(
			f'O.bodies: body {erased[0]} was erased while the scene was divided; erase and append bodies on rank 0, after polytope.mpi.merge()'
		)


def _withBodiesOfRankZero(mergeScene):
	@functools.wraps(mergeScene)
	def merge():
		merges = O.splitted
		if merges and mpy.rank > 0:
			_refuseErased()
		states = (bonds.states(), dampers.states()) if merges else None
		mergeScene()
		if merges:
			bonds.divide(False)
			if mpy.rank == 0:
				_own()
				clumps.takeMaterials()
				bonds.takeStates(states[0])
				dampers.takeStates(states[1])

	return merge


def _withCollider(parallelCollide):
	@functools.wraps(parallelCollide)
	def collide():
		mpy.collider = _typedEngine('InsertionSortCollider')
		divided = not O.splitted  # each worker still has the whole scene
		contacts = joints.remember()
		parallelCollide()
		if divided and contacts:
			contacts.put()

	return collide


def _withIdleRanks(checkAndCollide):
	"""The collider's check, for ranks without bodies that have a box, too. On such a rank, which is rank 0 where nothing is fixed, the
	integrator leaves 0, and the collider takes it that no step was done: all ranks would search for pairs in every step."""

	@functools.wraps(checkAndCollide)
	def check():
		newton = _typedEngine('NewtonIntegrator')
		if newton.maxVelocitySq == 0:
			newton.maxVelocitySq = 0.5  # as it is where no body has left its box
		return checkAndCollide()

	return check


def _withStatesOfRankZero(sendRecvStates):
	"""Bodies of rank 0 may have a velocity. With the setting that lets rank 0 send them, it leaves out the barrier that the workers come to."""

	@functools.wraps(sendRecvStates)
	def exchange():
		waiting.forAll()
		sendRecvStates()
		if mpy.rank == 0 and mpy.MASTER_UPDATE_STATES:
			mpy.comm.barrier()

	return exchange


def _endAll(kind, fault, trace):
	"""An exception that ends one rank ends all: the others would wait for it for ever."""
	traceback.print_exception(kind, fault, trace)
	sys.stdout.flush()
	sys.stderr.flush()
	mpy.MPI.COMM_WORLD.Abort(1)


def _exit(status=None):
	"""Exits as sys.exit does, but a status that says that something has failed ends all ranks: the program yade calls it after an exception."""
	if status not in (None, 0):
		sys.stdout.flush()
		sys.stderr.flush()
		mpy.MPI.COMM_WORLD.Abort(status if isinstance(status, int) else 1)
	raise SystemExit(status)


def install():
	"""Sets the functions of yade.mpy, once."""
	if hasattr(mpy, 'bodiesAreOurs'):
		return
	vars(sys.modules['__main__']).setdefault('sys', sys)  # commands of yade.mpy's engines are run among the script's names, and need it
	mpy.typedEngine = _typedEngine
	mpy.splitScene = _prepared(mpy.splitScene)
	mpy.mergeScene = _withBodiesOfRankZero(mpy.mergeScene)
	mpy.parallelCollide = _withCollider(mpy.parallelCollide)
	mpy.checkAndCollide = _withIdleRanks(mpy.checkAndCollide)
	mpy.sendRecvStates = _withStatesOfRankZero(mpy.sendRecvStates)
	mpy.genLocalIntersections = _withNeighboursOfBoth(clumps.wholeClumps(joints.keptByRanks(mpy.genLocalIntersections)))
	mpy.reallocateBodiesToSubdomains, mpy.REALLOCATE_FILTER = reallocation.reallocate, reallocation.beyondTheMiddle
	mpy.receiveForces = waiting.forForces(mpy.receiveForces)
	mpy.MASTER_UPDATE_STATES = True
	mpy.AUTO_COLOR = False  # colours of bodies are the user's
	mpy.bodiesAreOurs = True
	if size() > 1:
		sys.excepthook = _endAll
		sys.exit = _exit
