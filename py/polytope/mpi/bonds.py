# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds in a divided scene: every rank has all of them, and computes those of its bodies."""

from yade import mpy

from ..bonding import bonds as bonding

__all__ = ['check', 'divide', 'share', 'states', 'takeStates']


def divide(divided):
	"""The scene is divided, or merged."""
	engine = bonding.bonds()
	if engine:
		engine._divided, engine._missing = divided, 0


def check():
	"""To be called after steps, on every rank.

	:raises RuntimeError: a bond did not act, for its other body was not on its rank
	"""
	engine = bonding.bonds()
	if mpy.comm.allreduce(engine._missing if engine else 0):
		raise RuntimeError(
			'O.engines: a bond joins bodies so far apart that their boxes do not meet; set a larger verletDist of the collider, or a smaller gap in polytope.bond'
		)


def share():
	"""Every rank gets what the others have found, before bodies change ranks; every rank has to call it."""
	bonds = bonding.bonds()
	for found in mpy.comm.allgather(bonds._states() if mpy.rank > 0 and bonds else []):
		if bonds and mpy.rank > 0:
			bonds._takeStates(found)


def states():
	"""What each worker has found, on rank 0, before a merge; every rank has to call it."""
	engine = bonding.bonds()
	return mpy.comm.gather(engine._states() if mpy.rank > 0 and engine else [])


def takeStates(states):
	"""Takes over what the workers have found, on rank 0, after a merge."""
	engine = bonding.bonds()
	if engine:
		for state in states:
			engine._takeStates(state)
		engine._adoptBodies()
