# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run on several processes leaves in a scene that was saved after it. Does not start MPI, as importing yade.polytope.mpi does."""

from yade import O, config

__all__ = ['eraseRanks', 'forgetDivision', 'refuseDivided']


def refuseDivided():
	"""To be called before bodies are erased or made: yade.mpy ends with an error of its own if one rank does so alone.

	:raises RuntimeError: the scene is divided on several processes
	"""
	if getattr(O, 'splitted', False):  # which yade.mpy sets
		raise RuntimeError('O.bodies: the scene is divided on several processes; bodies break on rank 0, after polytope.mpi.merge()')


def forgetDivision():
	"""The scene is then as one that was never divided: one process computes contacts of bodies of its own subdomain only."""
	if 'MPI' not in config.features:
		return  # bodies have no subdomain
	for body in O.bodies:
		body.subdomain = 0
	eraseRanks()


def eraseRanks():
	"""Erases the bodies that stand for ranks, and the boxes they have."""
	for body in O.bodies:
		if body.isSubdomain:
			O.bodies.erase(body.id)
	for engine in O.engines:
		dispatcher = getattr(engine, 'boundDispatcher', None)
		if dispatcher:
			dispatcher.functors = [functor for functor in dispatcher.functors if functor.__class__.__name__ != 'Bo1_Subdomain_Aabb']
