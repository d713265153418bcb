# SPDX-License-Identifier: GPL-2.0-or-later
"""Permanent forces and torques (O.forces.setPermF, setPermT) when a scene is handed out: YADE does not send them with it."""

from yade import O, Vector3, mpy

__all__ = ['ofAll', 'passOn', 'take']


def ofAll():
	"""(id, force, torque) of all bodies, on rank 0; nothing where no load is set."""
	if not O.forces.getPermForceUsed():
		return []
	O.forces.f(0, sync=True)  # else those set since the last step are not seen
	return [_of(body.id) for body in O.bodies]


def take(loads):
	"""Each rank takes the loads of its own bodies; every rank has to call it, with what rank 0 has."""
	loads = mpy.comm.bcast(loads)
	if mpy.rank == 0:
		return
	for k, force, torque in loads:
		if O.bodies[k] is not None and O.bodies[k].subdomain == mpy.rank and any(force + torque):
			_set(k, force, torque)


def passOn(moved):
	"""Passes on the loads of bodies that have changed ranks; every rank has to call it.

	:param moved: ids for each rank
	"""
	used = O.forces.getPermForceUsed()
	for loads in mpy.comm.alltoall([[_of(k) for k in ids] if used else [] for ids in moved]):
		for k, force, torque in loads:
			_set(k, force, torque)
	if used:
		for ids in moved:
			for k in ids:
				_set(k, Vector3.Zero, Vector3.Zero)


def _of(k):
	return k, tuple(O.forces.permF(k)), tuple(O.forces.permT(k))


def _set(k, force, torque):
	O.forces.setPermF(k, Vector3(force))
	O.forces.setPermT(k, Vector3(torque))
