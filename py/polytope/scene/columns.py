# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of numbers of all bodies or contacts, which C++ fills, as NumPy arrays."""

import numpy as np

__all__ = ['arraysOf']


def arraysOf(columns):
	"""Array by name; of more than one number a row, (n, width)."""
	made = {}
	for name, (memory, kind, count, offset, width) in columns.items():
		flat = np.frombuffer(memory, kind, count, offset)
		made[name] = flat if width == 1 else flat.reshape(-1, width)
	return made
