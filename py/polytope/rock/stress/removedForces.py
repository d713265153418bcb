# SPDX-License-Identifier: GPL-2.0-or-later
"""What bodies that are to be taken away do to those that stay."""

from yade import O, PolytopeGeom, RockJointPhys, Vector3

from ...bonding.bonds import madeBonds
from ...scene.movers import canMove

__all__ = ['removedForces']


def removedForces(removed):
	"""id → (force [N], torque about its centre [N·m]) of contacts and bonds with the bodies *removed* (a set of ids), of bodies that stay and can move."""
	loads = {}
	for contact in O.interactions:
		if contact.isReal and (contact.id1 in removed) != (contact.id2 in removed):
			force, moment = _ofContact(contact)
			_add(loads, contact, removed, force, contact.geom.contactPoint, moment)
	for bond in madeBonds():
		if bond.intact and (bond.id1 in removed) != (bond.id2 in removed):
			_add(loads, bond, removed, bond.force, bond.point, bond.moment)
	return loads


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


def _add(loads, link, removed, force, point, moment):
	stays, sign = (link.id1, -1) if link.id2 in removed else (link.id2, 1)
	body = O.bodies[stays]
	if not canMove(body):
		return
	if O.periodic and stays == link.id2:
		point = point - O.cell.hSize * link.cellDist
	known = loads.get(stays, (Vector3.Zero, Vector3.Zero))
	torque = (point - body.state.pos).cross(force) + moment
	loads[stays] = known[0] + sign * force, known[1] + sign * torque
