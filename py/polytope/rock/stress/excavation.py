# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks taken out of a mass, at once or without a shock: `polytope.excavate(…)` (docs/stress-and-excavation.md)."""

import numbers

import numpy as np
from yade import O, Polytope

from ...arguments import namedArguments, numbersOf, rows
from ...bonding.bolting import madeBolts
from ...bonding.bonds import madeBonds
from ...scene.movers import canMove, moverOf
from ...scene.namedBodies import namedBodies
from ...scene.present import integrators
from ...scene.ranks import refuseDivided
from ...scene.relaxing import startRelaxing
from .removedForces import removedForces

__all__ = ['excavate']


@namedArguments
def excavate(bodies=None, normals=None, offsets=None, over=0):
	"""Takes blocks away: ``polytope.excavate([4, 7], over=2000)``, or all whose centre is in a region: ``polytope.excavate(normals=…, offsets=…, over=2000)``.

	Blocks that vanish at once leave their neighbours with forces that are out of balance, so that these swing: a joint gets up to twice the change of its load. With *over* the forces that
	the blocks exert on those that stay go on acting and fade to zero in so many steps: take five periods of the slowest swing or more. An engine does it, before NewtonIntegrator in
	O.engines. It removes itself after the last step, is saved with the scene, and goes on when that is loaded. polytope.settle() waits for it.

	Blocks are taken whole. For an outline that cuts through blocks, cut them along it when the mass is made (*polytope.jointedRock*, or *polytope.split* before
	*polytope.inSitu*): the stress does not depend on where joints are.

	:param bodies: ids; of a clump its own
	:param normals: (n, 3) outward normals of a region, of any length [-]; bodies that can move go if their centre is inside
	:param offsets: n offsets, in units of the normals' length [m]: {x : normals[i]·x ≤ offsets[i] for all i}
	:param int over: steps in which the forces fade; 0: at once
	:returns: ids of the bodies that were taken away
	:raises ValueError: naming the argument and the remedy; then nothing is changed
	"""
	if isinstance(over, bool) or not isinstance(over, numbers.Integral) or over < 0:
		raise ValueError(f'over: must be a whole number of steps, 0 for at once, got {over!r}')
	if (bodies is None) == (normals is None and offsets is None):
		raise ValueError('bodies: give either bodies, or normals and offsets of a region')
	refuseDivided()
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	chosen = _inside(normals, offsets) if bodies is None else [int(k) for k in namedBodies(bodies, name='bodies')]
	if not chosen:
		raise ValueError('bodies: there is none' if bodies is not None else 'normals: no body that can move has its centre in the region')
	if over and not integrators():
		raise ValueError('over: O.engines has no NewtonIntegrator, before which the forces act; set O.engines first')
	if over and not (madeBonds() or madeBolts() or any(contact.isReal for contact in O.interactions)):
		raise ValueError(
			'over: no contact bears a force yet that could fade; polytope.settle() or polytope.inSitu(…) first, or over=0, which takes the blocks away before the first step'
		)
	parts = {part for k in chosen for part in (O.bodies[k].shape.members if O.bodies[k].isClump else (k,))}
	loads = removedForces(parts) if over else {}
	for k in chosen:
		O.bodies.erase(k, eraseClumpMembers=True)
	if loads:
		startRelaxing(loads, int(over))
	return chosen


def _inside(normals, offsets):
	if normals is None or offsets is None:
		raise ValueError('offsets: a region has normals and offsets')
	planes, limits = np.array(rows(normals, 'normals', 3), float), np.array(numbersOf(offsets, 'offsets'), float)
	if len(planes) != len(limits) or not len(planes):
		raise ValueError(f'offsets: must be one for each of the {len(planes)} normals, got {len(limits)}')
	if not (np.isfinite(planes).all() and np.isfinite(limits).all() and planes.any(axis=1).all()):
		raise ValueError('normals: normals and offsets must be finite, and no normal zero')
	found = dict.fromkeys(moverOf(body.id) for body in O.bodies if body is not None and isinstance(body.shape, Polytope) and canMove(body))
	return [k for k in found if (planes @ np.array(O.bodies[k].state.pos, float) <= limits).all()]
