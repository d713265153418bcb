# SPDX-License-Identifier: GPL-2.0-or-later
"""Density scaling: bodies that limit the time step are heavier while a scene comes to rest, with the weight that they have."""

import contextlib
import math

import numpy as np
from yade import BaseMotion, O, PolytopeCheckpoint, PolytopeTimeStepper, QuietBoundary, TimeStepper, Vector3, _polytope

from ..scene.movers import movers
from ..scene.permanentLoads import permanentLoads
from ..scene.present import gravityOf, meanwhile
from ..scene.timeStep import safeTimeStep

__all__ = ['scaledMasses', 'scaledMassesIfPossible']

weights = 'GravityEngine', 'CentralGravityEngine', 'CentralConstantAccelerationEngine', 'AxialGravityEngine', 'HdapsGravityEngine'
"""YADE's engines whose forces go by the mass."""


@contextlib.contextmanager
def scaledMasses():
	"""Masses and moments of inertia multiplied until the block ends, so that no body needs a smaller time step than half of them do.

	Each body whose τ (polytope.stableTimeStep) is below the median gets the mass that makes it the median; a permanent force takes away
	what that adds to its weight. Time steppers follow by themselves; without one O.dt is multiplied. At the end masses, permanent forces
	and time step are the scene's own again, and what PolytopeCheckpoint would have saved meanwhile has been left out.

	:returns: a context manager, whose value is a pair: a function that adapts the masses to the present contacts, and the true masses by id
	:raises ValueError: naming *densityScaling* where the scene's motion is not that of coming to rest, or its weights do not come from
	    NewtonIntegrator
	"""
	_refuse()
	checkpoints = [engine for engine in O.engines if isinstance(engine, PolytopeCheckpoint)]
	scaled, stepBefore = _Scaled(), O.dt
	with meanwhile([(engine, 'dead', True) for engine in checkpoints]):
		try:
			scaled.adapt()
			if not _steppers():
				O.dt = stepBefore * scaled.gain
			yield scaled.adapt, scaled.masses
		finally:
			scaled.restore()
			O.dt = _ownStep(stepBefore)


@contextlib.contextmanager
def scaledMassesIfPossible():
	"""Masses scaled as by scaledMasses() where they may be and a time stepper sets the time step; elsewhere nothing is changed, and the
	value is None."""
	try:
		_refuse()
		possible = bool(_steppers())
	except ValueError:
		possible = False
	if not possible:
		yield None
		return
	with scaledMasses() as made:
		yield made


def _refuse():
	for engine in O.engines:
		if isinstance(engine, (BaseMotion, QuietBoundary)):
			raise ValueError(
				f'densityScaling: O.engines has {type(engine).__name__}, and waves need the true masses; settle first, then add it'
			)
		if type(engine).__name__ in weights:
			raise ValueError(
				f'densityScaling: O.engines has {type(engine).__name__}, whose forces go by the mass; use NewtonIntegrator.gravity'
			)
	for body in O.bodies:
		if not body.dynamic and not body.isClumpMember and (body.state.vel.norm() > 0 or body.state.angVel.norm() > 0):
			raise ValueError(
				f'densityScaling: body {body.id} is moved with a prescribed velocity, which would not be slow any more; stop it first'
			)


def _steppers():
	return [engine for engine in O.engines if isinstance(engine, TimeStepper) and engine.active and not engine.dead]


def _ownStep(before):
	"""The time step that is right with the true masses: a PolytopeTimeStepper's next update may be some steps ahead."""
	own = next((one for one in _steppers() if isinstance(one, PolytopeTimeStepper)), None)
	limit = safeTimeStep() if own else None
	return before if limit is None else min(own.timestepSafetyCoefficient * limit, own.maxDt)


class _Scaled:
	def __init__(self):
		self.before = {
			body.id: (body.state.mass, Vector3(body.state.inertia)) for body in movers() if 0 < float(body.state.mass) < math.inf
		}
		self.masses = {key: mass for key, (mass, _) in self.before.items()}
		self.factors = dict.fromkeys(self.before, 1.0)
		self.gravity = gravityOf()
		self.loads = {key: force for key, (force, _) in permanentLoads().items()}
		self.target = self.gain = None

	def adapt(self):
		"""Adapts the masses to the present contacts."""
		steps = _polytope.timeStepsOfBodies()
		own = {key: float(steps[key]) / math.sqrt(self.factors[key]) for key in self.before if key < len(steps) and steps[key] is not None}
		if not own:
			return
		if self.target is None:
			self.target = float(np.median(list(own.values())))
			self.gain = self.target / min(own.values())
		for key, step in own.items():
			self._scale(key, max(1.0, (self.target / step) ** 2))

	def _scale(self, key, factor):
		"""Multiplies the true mass by this."""
		mass, inertia = self.before[key]
		if factor == self.factors[key] or O.bodies[key] is None:
			return
		state = O.bodies[key].state
		state.mass, state.inertia = mass * factor, inertia * factor
		O.forces.setPermF(key, self.loads.get(key, Vector3.Zero) + mass * (1 - factor) * self.gravity)
		self.factors[key] = factor

	def restore(self):
		for key in self.before:
			self._scale(key, 1.0)
			if O.bodies[key] is not None:
				O.bodies[key].state.mass, O.bodies[key].state.inertia = self.before[key]
