# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields and counters of all ranks while the scene is divided: each body and contact once, though several ranks have it."""

import numpy as np
from yade import InteractionLoop, O, mpy

from ..measures.arrays import Arrays
from ..measures.arrays import arrays as ofThisRank
from .division import size

__all__ = ['arrays', 'stats']


def arrays():
	"""`polytope.arrays()` of the whole scene on rank 0, while it stays divided; None on the other ranks. Every rank has to call it.

	Each body is taken from the rank that computes it, a contact of two workers from the lower one. Sums over rows, as ½ m v² for the kinetic
	energy, count each once. Contacts are in the order of their ids.
	"""
	if size() == 1:
		return ofThisRank()
	if not O.splitted:
		return ofThisRank() if mpy.rank == 0 else None
	parts = mpy.comm.gather(_own(*ofThisRank()))
	if mpy.rank != 0:
		return None
	bodies, contacts = ([part[k] for part in parts] for k in (0, 1))
	names = sorted({name for part in bodies for name in part.shapeNames})
	bodies = [part._replace(shapes=_renamed(part.shapes, part.shapeNames, names), shapeNames=tuple(names)) for part in bodies]
	bodies, contacts = _joined(bodies), _joined(contacts)
	return Arrays(_rows(bodies, np.argsort(bodies.ids)), _rows(contacts, np.lexsort(contacts.ids.T[::-1])))


def stats():
	"""Counters of the geometry functors, *stats()*, summed over functors and ranks, on every rank; every rank has to call it.

	A pair of two workers is computed by both, and counts twice: a count of failures is an upper bound, and zero where there are none.
	"""
	total = {}
	for engine in O.engines:
		if isinstance(engine, InteractionLoop):
			for functor in engine.geomDispatcher.functors:
				if hasattr(functor, 'stats'):
					_add(total, functor.stats())
	if size() == 1:
		return total
	parts, total = mpy.comm.allgather(total), {}
	for part in parts:
		_add(total, part)
	return total


def _add(total, more):
	for name, value in more.items():
		if isinstance(value, dict):
			_add(total.setdefault(name, {}), value)
		else:
			total[name] = total.get(name, 0) + value


def _own(bodies, contacts):
	"""Rows that this rank answers for."""
	owners = np.zeros(len(O.bodies), int)
	owners[bodies.ids] = [O.bodies[int(k)].subdomain for k in bodies.ids]
	both = owners[contacts.ids]
	lower, higher = both.min(axis=1), both.max(axis=1)
	owner = np.where(lower > 0, lower, higher)  # rank 0 has fixed bodies and no contact of theirs
	return _rows(bodies, owners[bodies.ids] == mpy.rank), _rows(contacts, owner == mpy.rank)


def _rows(table, chosen):
	return table._replace(**{name: column[chosen] for name, column in table._asdict().items() if isinstance(column, np.ndarray)})


def _joined(parts):
	columns = {
		name: np.concatenate([getattr(part, name) for part in parts])
		for name, column in parts[0]._asdict().items()
		if isinstance(column, np.ndarray)
	}
	return parts[0]._replace(**columns)


def _renamed(codes, names, all):
	table = np.array([all.index(name) for name in names] + [-1], dtype=codes.dtype)
	return table[codes]
