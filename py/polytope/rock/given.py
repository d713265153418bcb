# SPDX-License-Identifier: GPL-2.0-or-later
"""A jointed rock as an argument, and the part of a line that lies in it."""

import numpy as np

from .jointedRock import JointedRock

__all__ = ['lengthWithin', 'refuseOthers']


def refuseOthers(rock):
	""":raises ValueError: if it is not what jointedRock made of a region of space"""
	if not isinstance(rock, JointedRock):
		raise ValueError(f'rock: must be what polytope.jointedRock(…) returns, got {type(rock).__name__}')
	if rock.blocks[0][0].shape[1] == 2:
		raise ValueError(
			'rock: is one in the plane, and this is told of rock in space; its volumes, areas and sets say what there is in the plane'
		)


def lengthWithin(rock, start, along):
	"""Length of the line from start to start + along that lies in blocks [m]; along a face of blocks less or more."""
	found = 0.0
	for normals, offsets in rock.blocks:
		slopes, room = normals @ along, offsets - normals @ start
		with np.errstate(divide='ignore', invalid='ignore'):
			parts = room / slopes
		first = max(0.0, parts[slopes < 0].max(initial=0.0))
		last = min(1.0, parts[slopes > 0].min(initial=1.0))
		if last > first and (room[slopes == 0] >= 0).all():
			found += last - first
	return found * float(np.linalg.norm(along))
