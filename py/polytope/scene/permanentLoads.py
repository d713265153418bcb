# SPDX-License-Identifier: GPL-2.0-or-later
"""Permanent forces and torques (O.forces.setPermF, setPermT), which YADE leaves out of what O.save and O.saveTmp keep."""

from yade import O, Vector3

__all__ = ['givePermanentLoads', 'permanentLoads']


def permanentLoads():
	"""Body's id → (force [N], torque [N·m]) of the bodies that have one."""
	if not O.forces.getPermForceUsed() or not len(O.bodies):
		return {}
	O.forces.f(0, sync=True)  # YADE makes room for all bodies: reading a load before it does is out of bounds
	loads = {k: (Vector3(O.forces.permF(k)), Vector3(O.forces.permT(k))) for k in range(len(O.bodies))}
	return {k: load for k, load in loads.items() if load != (Vector3.Zero, Vector3.Zero)}


def givePermanentLoads(loads):
	"""Sets what permanentLoads() has returned."""
	for k, (force, torque) in loads.items():
		O.forces.setPermF(k, force)
		O.forces.setPermT(k, torque)
