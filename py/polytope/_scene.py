# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines and functors of the present scene that *check*, *tradeoff*, *requirements* and *frictionReduction* read or change."""

from yade import Ig2_Polytope_Polytope_PolytopeGeom, InsertionSortCollider, InteractionLoop, Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, O

__all__ = ['colliders', 'geometryFunctors', 'interactionLoops', 'laws', 'notConservative', 'stiffnessesPerArea', 'unitOfModel']

notConservative = (
	'the conservative contact with stiffnesses per area',
	'stiffnessPerArea = False and stiffnesses in N/m: one that changes with the contact area is no gradient of an energy',
)
"""What *check* and *requirements* say about it: (seen, advice)."""
unitOfModel = {'foundation': True, 'spring': False}
"""Whether the stiffness of a contact model is per area, for those that are the gradient of an energy with one unit alone."""


def interactionLoops():
	return [engine for engine in O.engines if isinstance(engine, InteractionLoop)]


def geometryFunctors():
	"""The scene's contact functors of polytopes, mixed pairs included."""
	functors = (functor for loop in interactionLoops() for functor in loop.geomDispatcher.functors)
	return [functor for functor in functors if isinstance(functor, Ig2_Polytope_Polytope_PolytopeGeom)]


def colliders():
	return [engine for engine in O.engines if isinstance(engine, InsertionSortCollider)]


def laws():
	"""The plug-in's laws of the scene."""
	functors = (functor for loop in interactionLoops() for functor in loop.lawDispatcher.functors)
	return [functor for functor in functors if isinstance(functor, Law2_PolytopeGeom_RockJointPhys_MohrCoulomb)]


def stiffnessesPerArea(loops):
	"""Whether these loops make joints whose stiffness is per area."""
	makers = (functor for loop in loops for functor in loop.physDispatcher.functors)
	return any(getattr(functor, 'stiffnessPerArea', False) for functor in makers)
