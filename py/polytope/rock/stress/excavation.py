# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks taken out of a mass, at once or without a shock: `polytope.excavate(…)` (docs/stress-and-excavation.md)."""

import numbers

import numpy as np
from yade import O, Polytope

from ...arguments import flag, namedArguments
from ...bonding.bolting import madeBolts
from ...bonding.bonds import madeBonds
from ...scene.movers import canMove, moverOf, partsOf
from ...scene.namedBodies import namedBodies
from ...scene.present import placeOfForces
from ...scene.ranks import refuseDivided
from ...scene.relaxing import startRelaxing
from .cutting import ExcavatedRegion, restsOf
from .forces import less, loadsAtRest, removedForces
from .takingOver import refuseUnknown, takeOver

__all__ = ['excavate']


@namedArguments
def excavate(bodies=None, normals=None, offsets=None, over=0, cut=True):
	"""Takes blocks away: ``polytope.excavate([4, 7], over=2000)``, or all that is in a region, such as a tunnel or a pit:
	``polytope.excavate(normals=…, offsets=…, over=2000)``.

	Blocks that the region crosses are cut by its faces. What lies outside stays as one body, a clump where it is not convex, or several
	where the region goes through it; bodies that the region leaves as they are keep their numbers, what is left of others gets new ones.
	Its contacts go on with their shear, slip, cohesion and bonds, its faces with their materials and joints. Of a block no slivers are cut
	off or left whose inscribed radius is below a hundredth of its own. By a region, bodies that cannot move are neither cut nor taken.

	Blocks that vanish at once leave their neighbours with forces that are out of balance, so that these swing: a joint gets up to twice the
	change of its load. With *over* the forces that what is taken exerts on what stays go on acting and fade to zero in so many steps: take
	five periods of the slowest swing or more. The rest of a block that is cut is held by the force and torque that balance it, which fade
	likewise. An engine does it, before NewtonIntegrator in O.engines. It removes itself after the last step, is saved with the scene, and
	goes on when that is loaded. polytope.settle() waits for it.

	:param bodies: ids; of a clump its own. They are taken whole
	:param normals: (n, 3) outward normals of a region, of any length [-], in the plane (n, 2), too; for a region that is not convex a list
	    of those of convex parts
	:param offsets: n offsets, in units of the normals' length [m]: {x : normals[i]·x ≤ offsets[i] for all i}; for several parts a list of those
	:param int over: steps in which the forces fade; 0: at once
	:param bool cut: False: blocks are taken whole, if their centre is in the region
	:returns: dictionary of the bodies that are gone: id → ids of what is left of it
	:raises ValueError: naming the argument and the remedy; then nothing is changed
	"""
	if isinstance(over, bool) or not isinstance(over, numbers.Integral) or over < 0:
		raise ValueError(f'over: must be a whole number of steps, 0 for at once, got {over!r}')
	cut = flag(cut, 'cut')
	if (bodies is None) == (normals is None and offsets is None):
		raise ValueError('bodies: give either bodies, or normals and offsets of a region')
	refuseDivided()
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	rests = _restsOf(ExcavatedRegion(normals, offsets), cut) if bodies is None else {int(k): [] for k in namedBodies(bodies, name='bodies')}
	if not rests:
		reach = 'is cut by the region or lies in it' if cut else 'has its centre in the region'
		raise ValueError('bodies: there is none' if bodies is not None else f'normals: no body that can move {reach}')
	_refuseOver(over)
	if any(rests.values()):
		refuseUnknown([k for k, several in rests.items() if several])
	gone = {part for k in rests for part in partsOf(k)}
	before = removedForces(gone) if over else {}
	made = takeOver(rests)
	if over:
		_relax(before, [k for several in made.values() for k in several], int(over))
	return made


def _relax(before, made, over):
	"""What acted on those that stay goes on acting, and what is left of others is held."""
	parts = {part for k in made for part in partsOf(k)}
	loads = less(before, {k: load for k, load in removedForces(parts).items() if k in before})
	loads.update(loadsAtRest(made))
	if loads:
		startRelaxing(loads, over)


def _refuseOver(over):
	if over:
		placeOfForces('the forces that fade act')  # refuses before anything is changed
	if over and not (madeBonds() or madeBolts() or any(contact.isReal for contact in O.interactions)):
		raise ValueError(
			'over: no contact bears a force yet that could fade; polytope.settle() or polytope.inSitu(…) first, or over=0, which takes the blocks away before the first step'
		)


def _restsOf(region, cut):
	"""id → what is left of it, of bodies and clumps that can move."""
	found = dict.fromkeys(moverOf(body.id) for body in O.bodies if body is not None and isinstance(body.shape, Polytope) and canMove(body))
	if not cut:
		return {k: [] for k in found if region.holds(np.array(O.bodies[k].state.pos, float))}
	rests = {k: restsOf(k, region) for k in found if all(isinstance(O.bodies[part].shape, Polytope) for part in partsOf(k))}
	return {k: several for k, several in rests.items() if several is not None}
