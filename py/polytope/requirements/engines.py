# SPDX-License-Identifier: GPL-2.0-or-later
"""The check of O.engines, of polytope.requirements(): YADE runs them as they are, in the order in which they stand. See checks."""

from yade import Bo1_Polytope_Aabb, ForceResetter, InteractionLoop, NewtonIntegrator

from ..scene.present import colliders, interactionLoops

__all__ = ['engines']


def engines(scene):
	"""engines"""
	wrong = [*_missing(scene), *_disordered(scene)]
	names = ', '.join(type(engine).__name__ for engine in scene.O.engines)
	return names, '; '.join(wrong)


def _missing(scene):
	"""What nothing says when it is not there: no force, no motion, no pair."""
	kinds = [type(engine) for engine in scene.O.engines]
	if ForceResetter not in kinds:
		yield 'ForceResetter() at the start: forces of all steps add up without it'
	if scene.moving and NewtonIntegrator not in kinds:
		yield 'NewtonIntegrator() after the InteractionLoop: nothing moves without it'
	if not colliders():
		yield 'PolytopeCollider([Bo1_Polytope_Aabb()]) before the InteractionLoop: no pairs are found without a collider'
	elif not any(isinstance(functor, Bo1_Polytope_Aabb) for one in colliders() for functor in one.boundDispatcher.functors):
		yield 'Bo1_Polytope_Aabb() in the collider: polytopes have no boxes without it, and no contacts'
	for loop in interactionLoops():
		for name, dispatcher in (('Ip2', loop.physDispatcher), ('Law2', loop.lawDispatcher)):
			if not dispatcher.functors:
				yield f'an {name} functor in the InteractionLoop: contacts have no force without it'


def _disordered(scene):
	"""Pairs of engines of which the first must stand before the second."""
	places = {}
	for place, engine in enumerate(scene.O.engines):
		for kind in (ForceResetter, InteractionLoop, NewtonIntegrator):
			if isinstance(engine, kind):
				places.setdefault(kind, place)
		if engine in colliders():
			places.setdefault('collider', place)
	for first, second, why in (
		(ForceResetter, InteractionLoop, 'the forces of contacts are lost'),
		('collider', InteractionLoop, 'pairs are found a step late'),
		(InteractionLoop, NewtonIntegrator, 'forces act a step late, and those of the first step not at all'),
	):
		if first in places and second in places and places[first] > places[second]:
			yield f'{_name(first)} before {_name(second)}: {why} as it is'


def _name(kind):
	return kind if isinstance(kind, str) else kind.__name__
