# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds in a divided scene: every rank has all of them, and computes those of its bodies."""

from yade import O, PolytopeBonds, mpy

__all__ = ['check', 'divide', 'states', 'takeStates']


def _engine():
	"""The engine with the scene's bonds, or None; its name begins with _ where only several processes need it."""
	return next((engine for engine in O.engines if isinstance(engine, PolytopeBonds)), None)


def divide(divided):
	"""The scene is divided, or merged."""
	bonds = _engine()
	if bonds:
		bonds._divided, bonds._missing = divided, 0


def check():
	"""After steps, on every rank.

	:raises RuntimeError: a bond did not act, for its other body was not on its rank
	"""
	bonds = _engine()
	if mpy.comm.allreduce(bonds._missing if bonds else 0):
		raise RuntimeError(
			'O.engines: a bond joins bodies so far apart that their boxes do not meet; set a larger verletDist of the collider, or a smaller gap in polytope.bond'
		)


def states():
	"""On rank 0 what each worker has found, before a merge; every rank has to call it."""
	bonds = _engine()
	return mpy.comm.gather(bonds._states() if mpy.rank > 0 and bonds else [])


def takeStates(states):
	"""On rank 0, after a merge."""
	bonds = _engine()
	if bonds:
		for state in states:
			bonds._takeStates(state)
		bonds._adoptBodies()
