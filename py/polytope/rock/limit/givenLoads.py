# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads that a script gives bodies: permanent ones, and those of engines."""

from yade import DragEngine, ForceEngine, InterpolatingDirectedForceEngine, LinearDragEngine, O, RadialForceEngine, TorqueEngine, Vector3

from ...arguments import warn
from ...scene.permanentLoads import permanentLoads

__all__ = ['givenLoads']

changing = InterpolatingDirectedForceEngine, RadialForceEngine, DragEngine, LinearDragEngine
"""Engines whose forces depend on time, place or speed."""


def givenLoads():
	"""Body's id → (force at its centre [N], torque [N·m]), of O.forces.setPermF and setPermT, and of the engines ForceEngine and
	TorqueEngine that are not dead. Warns of engines whose forces change."""
	loads = permanentLoads()

	def add(k, force, torque):
		if 0 <= k < len(O.bodies):
			before = loads.get(k, (Vector3.Zero, Vector3.Zero))
			loads[k] = before[0] + force, before[1] + torque

	for engine in O.engines:
		if engine.dead:
			continue
		if isinstance(engine, changing):
			warn(f'limitAnalysis: the forces of {type(engine).__name__} change with time, place or speed and are left out; O.forces.setPermF gives constant ones')
		elif isinstance(engine, ForceEngine):
			for k in engine.ids:
				add(k, engine.force, Vector3.Zero)
		elif isinstance(engine, TorqueEngine):
			for k in engine.ids:
				add(k, Vector3.Zero, engine.moment)
	return loads
