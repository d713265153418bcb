# SPDX-License-Identifier: GPL-2.0-or-later
"""What contacts and bonds do to bodies, and what holds bodies at rest."""

from yade import O, PolytopeGeom, PolytopeWater, RockJointPhys, Vector3

from ...bonding.bonds import presentBonds
from ...scene.movers import canMove, partsOf
from ...scene.present import gravityOf

__all__ = ['forcesOfContacts', 'less', 'loadsAtRest', 'removedForces', 'weightAndWater']


def removedForces(removed):
	"""id → (force [N], torque about its centre [N·m]) of contacts and bonds with the bodies *removed* (a set of ids), of bodies that stay
	and can move."""
	return forcesOfContacts(lambda k: k not in removed and canMove(O.bodies[k]), lambda k: k in removed)


def loadsAtRest(bodies):
	"""id → (force, torque) that balances contacts, bonds, weight and water of bodies and clumps that can move; of a clump its parts each by
	themselves, and its weight."""
	movers = [k for k in bodies if O.bodies[k].dynamic]
	parts = {part for k in movers for part in partsOf(k)}
	loads = weightAndWater(movers)
	for k, load in forcesOfContacts(lambda k: k in parts).items():
		_add(loads, k, *load)
	return {k: (-force, -torque) for k, (force, torque) in loads.items()}


def less(loads, others):
	"""Loads of both, these minus the others."""
	left = dict(loads)
	for k, (force, torque) in others.items():
		_add(left, k, -force, -torque)
	return left


def weightAndWater(movers):
	"""id → (force, torque about its centre) of bodies and clumps."""
	gravity = gravityOf()
	waters = [engine for engine in O.engines if isinstance(engine, PolytopeWater)]
	loads = {k: (O.bodies[k].state.mass * gravity, Vector3.Zero) for k in movers}
	for k in movers:
		for water in waters:
			_add(loads, k, *water.load(k))
	return loads


def _add(loads, k, force, torque):
	known = loads.get(k, (Vector3.Zero, Vector3.Zero))
	loads[k] = known[0] + force, known[1] + torque


def forcesOfContacts(on, by=lambda k: True):
	"""id → (force [N], torque about its centre [N·m]) of contacts and bonds on bodies for whose ids *on* is true, by those for whose ids *by* is. Not
	O.forces, which are not known after O.load."""
	loads = {}
	for contact in O.interactions:
		if contact.isReal:
			_ofLink(loads, contact, on, by, lambda contact=contact: (*_ofContact(contact), contact.geom.contactPoint))
	for bond in presentBonds():
		_ofLink(loads, bond, on, by, lambda bond=bond: (bond.force, bond.moment, bond.point))
	return loads


def _ofLink(loads, link, on, by, found):
	for k, other, sign in ((link.id1, link.id2, -1), (link.id2, link.id1, 1)):
		if on(k) and by(other):
			force, moment, point = found()
			if O.periodic and k == link.id2:
				point = point - O.cell.hSize * link.cellDist
			_add(loads, k, sign * force, sign * ((point - O.bodies[k].state.pos).cross(force) + moment))


def _ofContact(contact):
	"""(force, moment about the contact point) on body 2."""
	phys, geom = contact.phys, contact.geom
	force, moment = phys.normalForce + phys.shearForce, Vector3.Zero
	if isinstance(phys, RockJointPhys):
		if phys.bond is not None:
			return force, phys.bond.moment + phys.rockingMoment
		shear = (phys.shearPoint - geom.contactPoint).cross(phys.shearForce) + phys.twistingMoment * geom.normal
		moment = phys.rockingMoment + shear
		if isinstance(geom, PolytopeGeom):
			moment += geom.turningArm * (phys.normalForce - phys.normalViscous)
	return force, moment
