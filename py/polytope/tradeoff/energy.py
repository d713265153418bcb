# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a scene blew up: the energy that is there at the end of a run and came from nowhere."""

import math

from yade import NewtonIntegrator, O, Vector3
from yade.utils import kineticEnergy

__all__ = ['Energy', 'growth']

twice, muchMore = 2, 10
"""Times what there was, and times what the calmest of the runs created: see growth()."""


class Energy:
	"""Of the bodies that can move, from the moment this is made on."""

	def __init__(self):
		self.places = {body.id: Vector3(body.state.pos) for body in _moving()}
		self.before = float(kineticEnergy()) + _stored()

	def created(self):
		"""(kinetic energy that neither what was there nor gravity accounts for, what was there and what gravity gave), both [J].

		Kinetic energy alone: what the springs hold at the end would only add to it. None if these are no longer the same bodies, inf for
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
	"""For each of several runs of one scene by how much its energy grew, over what there was; 0 where that is no sign of having blown up.

	It is one if more than twice as much came from nowhere as there was, and much more than in the calmest of the runs. (The paper's contact
	creates as much as there was in collisions without damping; imposed motion does the same work in all.)

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
