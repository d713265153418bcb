# SPDX-License-Identifier: GPL-2.0-or-later
"""Marks the processes that polytope.tradeoff() starts."""

__all__ = ['CalledAgain', 'inside']

inside = 'POLYTOPE_TRADEOFF'
"""Environment variable of these processes."""


class CalledAgain(RuntimeError):
	"""polytope.tradeoff() was called in a process of its own: the script, which is read there, has come to the call."""
