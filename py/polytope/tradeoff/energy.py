# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a scene blew up (became unstable): the energy at the end of a run that no source accounts for."""

import math

from yade import NewtonIntegrator, O, Vector3
from yade.utils import kineticEnergy

__all__ = ['Energy', 'growth']

twice, muchMore = 2, 10
"""Limits, as multiples of the energy available and of the energy created in the run that created least: see growth()."""


class Energy:
	"""Of the bodies that can move, from the moment this is made on."""

	def __init__(self):
		self.places = {body.id: Vector3(body.state.pos) for body in _moving()}
		self.before = float(kineticEnergy()) + _stored()

	def created(self):
		"""(kinetic energy that neither the initial energy nor gravity accounts for, initial energy plus work of gravity), both [J].

		Kinetic energy alone: the springs' energy at the end would only add to it. None if these are no longer the same bodies, inf for
		velocities that are not numbers.
		"""
		bodies = _moving()
		if self.places.keys() != {body.id for body in bodies}:
			return None
		gravity = sum((engine.gravity for engine in O.engines if isinstance(engine, NewtonIntegrator)), Vector3(0, 0, 0))
		fallen = sum(float(body.state.mass * gravity.dot(body.state.pos - self.places[body.id])) for body in bodies)
		kinetic = float(kineticEnergy())
		if not math.isfinite(kinetic + fallen):
			return [math.inf, self.before]
		return [kinetic - self.before - fallen, self.before + abs(fallen)]


def growth(energies):
	"""For each of several runs of one scene by how much its energy grew, over the energy available; 0 where that does not mean that it blew
	up.

	It does if more than twice the energy available was created, and much more than in the run that created least. (The paper's contact
	creates as much as was available in collisions without damping; imposed motion does the same work in all.)

	:param list energies: of Energy.created(), or None
	"""
	least = min((max(created, 0) for created, _ in filter(None, energies)), default=0)
	grown = []
	for created, there in (one or (0, 0) for one in energies):
		large = created > max(twice * there, muchMore * least)
		grown.append((created / there if there > 0 else math.inf) if large else 0)
	return grown


def _moving():
	return [body for body in O.bodies if body is not None and body.dynamic and not body.isClumpMember and body.state.mass > 0]


def _stored():
	"""In the contacts' normal springs."""
	contacts = (contact.phys for contact in O.interactions if contact.isReal)
	return sum(float(phys.normalForce.squaredNorm() / (2 * phys.kn)) for phys in contacts if getattr(phys, 'kn', 0) > 0)
