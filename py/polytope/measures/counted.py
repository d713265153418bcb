# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies, contacts and bonds that measures of a packing count."""

from yade import O, Polytope, Sphere

from ..scene.movers import moverOf, movers
from ..scene.namedBodies import namedBodies

__all__ = ['bearing', 'freePolytopes', 'massive']


def bearing():
	"""Contacts that bear a normal force."""
	return [contact for contact in O.interactions if contact.isReal and contact.phys.normalForce.squaredNorm() > 0]


def massive(ids):
	"""Polytopes, spheres and clumps."""
	if ids is None:
		bodies = (O.bodies[moverOf(body.id)] for body in O.bodies if body is not None and isinstance(body.shape, (Polytope, Sphere)))
		return list(dict.fromkeys(body.id for body in bodies if body.dynamic))
	for k in (named := namedBodies(ids)):
		if not O.bodies[k].isClump and not isinstance(O.bodies[k].shape, (Polytope, Sphere)):
			raise ValueError(f'ids: body {k} is neither a polytope nor a sphere')
	return named


def freePolytopes(ids):
	if ids is None:
		found = [body.id for body in movers() if isinstance(body.shape, Polytope)]
	else:
		found = namedBodies(ids)
	if not found:
		raise ValueError('ids: there is no free polytope')
	for k in found:
		if not isinstance(O.bodies[k].shape, Polytope):
			raise ValueError(f'ids: body {k} is no polytope')
	return found
