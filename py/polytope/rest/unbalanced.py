# SPDX-License-Identifier: GPL-2.0-or-later
"""How far each body is from equilibrium: its resultant force, or moment, over what it bears."""

import numpy as np
from yade import O

from ..bonding.bolting import madeBolts
from ..bonding.bonds import intactBonds
from ..measures.arrays import arrays
from ..scene.movers import movers
from ..scene.permanentLoads import permanentLoads
from ..scene.present import gravityOf
from ..scene.stages import sizeOf

__all__ = ['resultants', 'unbalancedForce', 'unbalancedForces']


def unbalancedForce(watched=None):
	"""Unbalanced force of the body that is least at rest: its resultant, along what it can move, or its moment over half of its size where
	that is more, over its weight, or over half of what contacts, bonds and bolts press and pull it with, where that is more.

	:param watched: ids, of clumps their own; None: all that can move
	"""
	return float(unbalancedForces(watched).max(initial=0.0))


def unbalancedForces(watched=None, masses=None):
	"""Unbalanced force of each body over its scale (unbalancedForce), by its id [-]; 0 of those that cannot move or are not watched, and of
	parts of clumps.

	:param masses: true masses by id, where those of the scene are scaled [kg]
	"""
	bodies, contacts = arrays()
	last, owner = len(O.bodies), _owners(bodies)
	pressing = np.linalg.norm(np.nan_to_num(contacts.forces), axis=1) / 2
	borne = sum(np.bincount(owner[contacts.ids[:, side]], pressing, last) for side in (0, 1))
	forces = [(bond, bond.force.norm()) for bond in intactBonds()]
	forces += [
		(crossing, abs(crossing.tension) + crossing.shearForce.norm())
		for one in madeBolts()
		for crossing in one.crossings
		if not crossing.failure
	]
	for link, force in forces:
		for key in (link.id1, link.id2):
			borne[owner[key]] += float(force) / 2
	scale = np.maximum(_trueMasses(bodies, masses) * np.linalg.norm(np.array(gravityOf(), float)), borne)
	moving = np.flatnonzero(scale > 0)
	if watched is not None:
		moving = np.intersect1d(moving, np.fromiter(watched, int))
	found = np.zeros(last)
	arms = np.array([sizeOf(int(k)) / 2 for k in moving])
	loads = _loads()[moving]
	force, moment = np.linalg.norm(loads[:, :3], axis=1), np.linalg.norm(loads[:, 3:], axis=1)
	found[moving] = np.maximum(force, moment / arms) / scale[moving]
	return found


def resultants():
	"""(n, 3) by id: force on each body with its weight, along what it can move; 0 of those that cannot, and of parts of clumps [N]."""
	return _loads()[:, :3]


def _loads():
	"""(n, 6) by id: the same, and the moment about the body's centre, about the axes that it can turn about [N·m]."""
	bodies = arrays().bodies
	last, owner = len(O.bodies), _owners(bodies)
	single = bodies.clumpIds != bodies.ids  # a clump's own row has the sum of its parts, without its permanent load
	forces = np.column_stack([np.bincount(owner[bodies.ids[single]], bodies.forces[single, m], last) for m in range(3)])
	moments = np.zeros((last, 3))
	moments[bodies.ids] = bodies.torques
	clumps = set(bodies.ids[~single].tolist())
	for key, (force, torque) in permanentLoads().items():
		if key in clumps:
			forces[key] += [float(x) for x in force]
			moments[key] += [float(x) for x in torque]
	present = np.zeros(last)
	present[bodies.ids] = bodies.masses  # a scaled mass comes with a permanent force that takes away what it adds to the weight
	forces = forces + np.outer(present, np.array(gravityOf(), float))  # whole numbers where there is none
	moving, free = _movers()
	held = np.zeros((last, 6))
	held[moving] = free * np.hstack([forces, moments])[moving]  # what is held bears any force
	return held


def _owners(bodies):
	"""What each body moves with, by id: the body itself, or the clump that it is part of, which moves as one."""
	owner = np.arange(len(O.bodies))
	owner[bodies.ids] = np.where(bodies.clumpIds >= 0, bodies.clumpIds, bodies.ids)
	return owner


def _trueMasses(bodies, masses):
	true = np.zeros(len(O.bodies))
	true[bodies.ids] = bodies.masses
	for key, mass in (masses or {}).items():
		true[key] = float(mass)
	return true


def _movers():
	"""(ids of the bodies that forces move, of clumps their own; (n, 6) 1 for the axes along which, and then about which, they do, else 0)"""
	moving = movers()
	held = [body.state.blockedDOFs for body in moving]
	free = np.array([[axis not in one for axis in 'xyzXYZ'] for one in held], float)
	return np.array([body.id for body in moving], int), free.reshape(-1, 6)
