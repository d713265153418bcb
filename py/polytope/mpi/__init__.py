# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes on several processes by YADE's own engine for it, yade.mpy (MPI); docs/mpi.md.

Rank 0 has the scene, its fixed bodies, and what is written; the others, the workers, compute the bodies that can move. Importing this package
starts MPI and sets yade.mpy right for polytopes (division.py): `from yade.polytope import mpi`.
"""

from numbers import Integral

from yade import O, config, mpy

from ..scene.ranks import eraseRanks
from . import bonds, clumps, division, meeting, recorders
from .division import shareTimeStep
from .fields import arrays, stats

if 'MPI' not in config.features:
	raise ImportError(
		f'YADE {config.version} in {config.libDir} was built without MPI; build it with -DENABLE_MPI=ON, and yade-polytope again for it'
	)

__all__ = ['arrays', 'divide', 'leastOfRanks', 'merge', 'rank', 'run', 'shareTimeStep', 'size', 'stats', 'sumOfRanks']


def rank():
	"""Number of this process: 0 has the whole scene before it is divided and after it is merged, the others compute."""
	return mpy.rank


def size():
	"""Number of processes; 1 without mpirun."""
	return division.size()


def divide(axis=0):
	"""Gives each worker an equal number of the bodies that can move, in the order of their positions along an axis; every rank has to call it.

	Called again during a run, it merges the scene and divides it by the positions that the bodies have then. Contacts keep what they remember.
	Fixed bodies stay with rank 0, which lets all workers touch them. A clump is one body, at its centre.

	:param int axis: 0, 1, 2: x, y, z
	:raises ValueError: naming *axis*
	"""
	if axis not in (0, 1, 2):
		raise ValueError(f'axis: must be 0, 1 or 2, got {axis!r}')
	if size() == 1:
		return
	meeting.at('polytope.mpi.divide')
	merge()
	division.handOut()  # also one that was never divided
	if rank() == 0:
		moving = clumps.movers()
		moving.sort(key=lambda body: body.state.pos[axis])
		division.assign({body.id: 1 + k * (size() - 1) // len(moving) for k, body in enumerate(moving)})


def run(steps, merged=True):
	"""Runs steps on all ranks; every rank has to call it. With one process it is O.run(steps, wait=True).

	PolytopeVTKRecorder, VTKRecorder and PolytopeCheckpoint in O.engines are called on rank 0 with the merged scene, between two steps, when their
	periods have passed. A merged scene is handed out anew, with all that was changed on rank 0.

	:param int steps: how many
	:param bool merged: whether rank 0 has the whole scene afterwards, to be measured, drawn and saved; takes time
	:raises ValueError: naming *steps*
	"""
	if not isinstance(steps, Integral) or steps < 1:
		raise ValueError(f'steps: must be a whole number, at least 1, got {steps!r}')
	if size() == 1:
		O.run(int(steps), wait=True)
		return
	meeting.at('polytope.mpi.run')
	_record()
	while steps > 0:
		piece = mpy.comm.bcast(min(int(steps), recorders.stepsToNext()) if rank() == 0 else None)
		mpy.mpirun(piece, size())
		bonds.check()
		steps -= piece
		_record()
	if merged:
		merge()


def _record():
	"""Merges the scene and calls the recorders that are due, if there are any."""
	due = recorders.due() if rank() == 0 else None
	if not mpy.comm.bcast(bool(due)):
		return
	if O.splitted:
		mpy.mergeScene()  # workers keep their part, and go on with it
	if rank() == 0:
		recorders.record(due)


def merge():
	"""Brings the whole scene to rank 0; every rank has to call it. The next run() hands it out again: each body to the rank that it had,
	where that is not changed by divide()."""
	meeting.at('polytope.mpi.merge')
	if size() == 1 or not O.splitted:
		return
	mpy.mergeScene()
	division.handOut()
	if rank() == 0:
		eraseRanks()


def sumOfRanks(number):
	"""Sum of each rank's number, on every rank; every rank has to call it."""
	return mpy.comm.allreduce(number, op=mpy.MPI.SUM) if size() > 1 else number


def leastOfRanks(number):
	"""The smallest of each rank's number, on every rank; every rank has to call it: ``mpi.leastOfRanks(polytope.stableTimeStep(default=1))``."""
	return mpy.comm.allreduce(number, op=mpy.MPI.MIN) if size() > 1 else number


division.install()
meeting.install()
