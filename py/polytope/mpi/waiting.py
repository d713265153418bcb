# SPDX-License-Identifier: GPL-2.0-or-later
"""How rank 0 waits where a machine has fewer cores than processes.

Rank 0 has little to do in a step, and waits for the workers by asking again and again, as MPI does: that takes a part of a core from them. So here it
sleeps between two questions, each time for a small part of the time that it has waited already.
"""

import functools
import os
import time

from yade import mpy

__all__ = ['agree', 'forAll', 'forForces']

share = 0.05
"""How late rank 0 may notice that it can go on, over the time waited so far."""

_sleeps = False


def agree():
	"""Finds whether any machine has more of these processes than cores. On every rank."""
	global _sleeps
	here = mpy.comm.Split_type(mpy.MPI.COMM_TYPE_SHARED)
	_sleeps = mpy.comm.allreduce(here.size > os.cpu_count(), op=mpy.MPI.LOR)
	here.Free()


def _until(done):
	begin = time.perf_counter()
	while not done():
		time.sleep(share * (time.perf_counter() - begin))


def forAll():
	"""Returns when every rank has called it; where each has a core, at once."""
	if not _sleeps:
		return
	met = mpy.comm.Ibarrier()
	if mpy.rank == 0:
		_until(met.Test)
	else:
		met.Wait()


def forForces(receiveForces):
	"""YADE's function, with this wait before it; it is called on rank 0 alone."""

	@functools.wraps(receiveForces)
	def receive(subdomains):
		if _sleeps:
			for rank in subdomains:
				_until(lambda rank=rank: mpy.comm.Iprobe(source=rank, tag=mpy._FORCES_))
		receiveForces(subdomains)

	return receive
