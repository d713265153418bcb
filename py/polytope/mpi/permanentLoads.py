# SPDX-License-Identifier: GPL-2.0-or-later
"""Permanent forces and torques (O.forces.setPermF, setPermT) when a scene is handed out: YADE does not send them with it."""

from yade import O, Vector3, mpy

__all__ = ['ofAll', 'take']


def ofAll():
	"""On rank 0: (id, force, torque) of all bodies; none where none is set."""
	if not O.forces.getPermForceUsed():
		return []
	O.forces.f(0, sync=True)  # else those set since the last step are not seen
	return [(body.id, tuple(O.forces.permF(body.id)), tuple(O.forces.permT(body.id))) for body in O.bodies]


def take(loads):
	"""Each rank those of its own bodies; every rank has to call it, with what rank 0 has."""
	loads = mpy.comm.bcast(loads)
	if mpy.rank == 0:
		return
	for k, force, torque in loads:
		if O.bodies[k] is not None and O.bodies[k].subdomain == mpy.rank and any(force + torque):
			O.forces.setPermF(k, Vector3(force))
			O.forces.setPermT(k, Vector3(torque))
