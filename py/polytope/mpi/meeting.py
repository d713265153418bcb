# SPDX-License-Identifier: GPL-2.0-or-later
"""A function that every rank has to call, and one does not: the others would wait for it for ever. So the ranks say what they call, and at its end a
script does, too.
"""

import atexit
import functools

import yade
from yade import mpy

__all__ = ['at', 'install']


def at(name):
	"""To be called on every rank, before what all of them have to do.

	:param str name: of the function
	:raises RuntimeError: other ranks are somewhere else; it ends all of them
	"""
	if mpy.comm is None:
		return
	names = mpy.comm.allgather(name)
	if len(set(names)) > 1:
		where = '; '.join(f'rank {rank}: {name}' for rank, name in enumerate(names))
		raise RuntimeError(f'every rank has to call the same functions of polytope.mpi in the same order, but they are at: {where}')


_ended = False


def _atEnd():
	global _ended
	if _ended:
		return
	_ended = True
	try:
		at('the end of the script')
	except RuntimeError as fault:
		print(f'RuntimeError: {fault}', flush=True)
		mpy.MPI.COMM_WORLD.Abort(1)


def _endingWith(function):
	"""The function that the program yade calls after a script."""

	@functools.wraps(function)
	def end():
		_atEnd()
		function()

	return end


def install():
	if not mpy.numThreads or mpy.numThreads == 1:
		return
	options = getattr(getattr(yade, 'runtime', None), 'opts', None)  # of the program yade; a script of Python has none
	if not getattr(options, 'mpi_mode', False):
		atexit.register(_atEnd)
	elif options.exitAfter:  # else rank 0 goes on in a shell, and tells the workers what to do
		mpy.disconnect, mpy.spawnedProcessWaitCommand = _endingWith(mpy.disconnect), _endingWith(mpy.spawnedProcessWaitCommand)
