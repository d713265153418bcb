# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines, functors and bodies of the present scene that several modules read or change."""

import contextlib

from yade import (
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	Polytope,
	PolytopeGeomFunctor,
	RockJointMat,
	Vector3,
)

__all__ = [
	'EngineOfScene',
	'colliders',
	'contactSettings',
	'geometryFunctors',
	'gravityOf',
	'insertEngine',
	'integrators',
	'interactionLoops',
	'isPerArea',
	'jointMakers',
	'jointMaterials',
	'laws',
	'meanwhile',
	'placeOfForces',
	'unitOfModel',
	'unitsOfStiffness',
	'wrongUnit',
]

unitOfModel = {'foundation': True, 'spring': False}
"""Whether the stiffness of a contact model is per area, for those that are the gradient of an energy with one unit alone."""


def interactionLoops():
	return [engine for engine in O.engines if isinstance(engine, InteractionLoop)]


def geometryFunctors(loops=None):
	"""The contact functors of polytopes of these loops, default the scene's, mixed pairs included."""
	functors = (functor for loop in (interactionLoops() if loops is None else loops) for functor in loop.geomDispatcher.functors)
	return [functor for functor in functors if isinstance(functor, PolytopeGeomFunctor)]


def contactSettings(loops=None):
	"""The functor whose attributes are the settings of all contacts of a scene with these loops, default the present one; None where it has
	none, and the defaults hold."""
	return next((functor for functor in geometryFunctors(loops) if isinstance(functor, Ig2_Polytope_Polytope_PolytopeGeom)), None)


def integrators():
	return [engine for engine in O.engines if isinstance(engine, NewtonIntegrator)]


def gravityOf(engines=None):
	"""Acceleration of bodies that move freely: each NewtonIntegrator that is not dead adds its own gravity [m/s²].

	:param engines: those of the scene; default O.engines
	:returns: Vector3
	"""
	engines = O.engines if engines is None else engines
	return sum((one.gravity for one in engines if isinstance(one, NewtonIntegrator) and not one.dead), Vector3.Zero)


def colliders():
	return [engine for engine in O.engines if isinstance(engine, InsertionSortCollider)]


def laws():
	"""The plug-in's laws of the scene."""
	functors = (functor for loop in interactionLoops() for functor in loop.lawDispatcher.functors)
	return [functor for functor in functors if isinstance(functor, Law2_PolytopeGeom_RockJointPhys_MohrCoulomb)]


def jointMakers(loops):
	"""The functors of these loops that make rock joints."""
	return [one for loop in loops for one in loop.physDispatcher.functors if isinstance(one, Ip2_RockJointMat_RockJointMat_RockJointPhys)]


def jointMaterials(bodies):
	"""RockJointMats of these bodies. O.materials is not asked: reading it ends the process where a material was added twice."""
	used = [body.material for body in bodies]
	return list({id(material): material for material in used if isinstance(material, RockJointMat)}.values())


def isPerArea(material, makers):
	"""Whether the stiffnesses of a RockJointMat are taken per area."""
	return material.stiffnessPerArea and all(one.stiffnessPerArea for one in makers)


def unitsOfStiffness(loops):
	"""The units of stiffness that contacts of polytopes in these loops may have, a set: True per area, False per contact.

	A joint of two units has that per contact, as YADE's own physics have; without bodies it is what these loops are made for.
	"""
	makers = jointMakers(loops)
	used = [body.material for body in O.bodies if isinstance(body.shape, Polytope) and body.material is not None]
	if not used:
		return {all(one.stiffnessPerArea for one in makers)} if makers else {False}
	joints = jointMaterials(O.bodies) if makers else []
	return {isPerArea(one, makers) for one in joints} | ({False} if any(not isinstance(one, RockJointMat) for one in used) else set()) or {False}


def wrongUnit(model, perArea):
	"""(seen, advice) for a contact model whose force is no gradient of an energy with stiffnesses of this unit; None for others."""
	if unitOfModel.get(model, perArea) == perArea:
		return None
	made = 'stiffnesses per area' if perArea else 'stiffnesses per contact'
	other = next(name for name, unit in unitOfModel.items() if unit == perArea)
	return (
		f'contactModel {model!r} with {made}: the force is no gradient of an energy',
		f"contactModel='surface', which goes by the unit, or {other!r}, or stiffnessPerArea={not perArea} and stiffnesses in {'N/m' if perArea else 'Pa/m'}",
	)


def placeOfForces(what):
	"""Where in O.engines forces of an engine must be added: after what finds contacts, before what moves the bodies.

	:param str what: what acts there, with its verb, for the messages
	:raises ValueError: naming *engines* if there is no such place
	"""
	engines = list(O.engines)
	integrator = next((k for k, one in enumerate(engines) if isinstance(one, NewtonIntegrator)), None)
	if integrator is None:
		raise ValueError(f'engines: set O.engines first, for example O.engines = polytope.engines(); {what} before NewtonIntegrator')
	loops = [k for k, one in enumerate(engines) if isinstance(one, InteractionLoop)]
	if loops and loops[-1] > integrator:
		raise ValueError(f'engines: NewtonIntegrator is before InteractionLoop in O.engines; {what} between them, put it behind')
	return integrator


def insertEngine(place, engine):
	"""Puts an engine into O.engines before the one that is at this place now."""
	O.engines = O.engines[:place] + [engine] + O.engines[place:]


@contextlib.contextmanager
def meanwhile(settings):
	"""Attributes with other values, as (object, name, value), until the block ends; then they are what they were."""
	before = [(one, name, getattr(one, name)) for one, name, _ in settings]
	for one, name, value in settings:
		setattr(one, name, value)
	try:
		yield
	finally:
		for one, name, value in reversed(before):
			setattr(one, name, value)


class EngineOfScene:
	"""The scene's one engine of a kind whose members hold bodies (bonds, bolts), known also after it has left O.engines.

	:param kind: its class
	:param str holding: attribute that counts the members that hold bodies of this scene
	"""

	def __init__(self, kind, holding):
		self.kind, self.holding, self.last = kind, holding, None

	def present(self):
		"""The engine that is in O.engines; None where there is none."""
		found = next((engine for engine in O.engines if isinstance(engine, self.kind)), None)
		if found is not None:
			self.last = found
			found._meetBodies()  # loaded members do not know their bodies yet; in another scene they would take what has the same ids
		return found

	def make(self, act, making):
		"""The scene's engine, or a new one, with what *making*, a function of the engine, returns. A new one is in O.engines only if that
		raises nothing.

		:param str act: what acts in it, with its verb, for the messages
		:raises ValueError: naming *engines* if there is no place for a new one
		"""
		engine, place = self.present(), None
		if engine is None:
			place, engine = placeOfForces(act), self.kind()
		made = making(engine)
		if place is not None:
			insertEngine(place, engine)
			self.last = engine
		return engine, made

	def removed(self):
		"""The engine, if it is no longer in O.engines and would hold bodies of this scene; else None."""
		lost = self.present() is None and self.last is not None and getattr(self.last, self.holding)
		return self.last if lost else None
