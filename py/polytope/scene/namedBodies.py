# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that a script names, clumps by their own number."""

import numbers

from yade import O, Polytope

from .movers import moverOf

__all__ = ['namedBodies']


def namedBodies(ids, erased=False, name='ids'):
	"""Numbers of bodies, a clump by its own; None: all that hold a Polytope and can move. ValueError naming them.

	:param bool erased: leave out numbers of bodies that have been erased, in place of refusing them
	:param str name: of the argument
	"""
	if ids is not None:
		try:
			ids = list(ids)
		except TypeError:
			raise ValueError(f'{name}: must be a list of numbers of bodies, got {ids!r}') from None
		if erased:
			ids = [k for k in ids if not (isinstance(k, numbers.Integral) and 0 <= k < len(O.bodies) and O.bodies[k] is None)]
		for k in ids:
			if not isinstance(k, numbers.Integral) or not 0 <= k < len(O.bodies) or O.bodies[k] is None:
				raise ValueError(f'{name}: there is no body {k!r}')
			if moverOf(k) != k:
				raise ValueError(f'{name}: body {k} is a member of clump {moverOf(k)}; name the clump')
		if len(set(ids)) < len(ids):
			raise ValueError(f'{name}: some bodies are named twice')
		return [int(k) for k in ids]
	free = (moverOf(body.id) for body in O.bodies if isinstance(body.shape, Polytope))
	return [k for k in dict.fromkeys(free) if O.bodies[k].dynamic]
