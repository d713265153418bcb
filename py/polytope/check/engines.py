# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of O.engines and of the settings of functors, of polytope.check(). Each yields (what, seen, advice)."""

from yade import (
	BaseMotion,
	ForceResetter,
	GlobalStiffnessTimeStepper,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	KinematicEngine,
	NewtonIntegrator,
	Polytope,
	PolytopeBolts,
	PolytopeBonds,
	PolytopeWater,
	QuietBoundary,
	Sphere,
	TriaxialStressController,
	VTKRecorder,
)

from ..bonding.bolting import removedBolts
from ..bonding.bonds import removedBonds
from ..scene.movers import canMove, moverOf
from ..scene.present import unitsOfStiffness, wrongUnit

__all__ = ['engineFindings']


def engineFindings(scene):
	for one in (
		missing,
		twice,
		order,
		spheresOnly,
		densityScaling,
		bondsAndBolts,
		erasedForces,
		dampingOfShaken,
		unitOfSurface,
		pointWithoutArea,
		recorders,
		driven,
		masks,
	):
		yield from one(scene)


def missing(scene):
	"""Engines without which nothing touches or nothing moves."""
	if not any(scene.moves(body) for body in scene.bodies):
		return
	if not scene.loops:
		yield 'engines', 'O.engines has no InteractionLoop: bodies pass through each other', 'O.engines = polytope.engines()'
	if not scene.colliders:
		yield (
			'engines',
			'O.engines has no collider: no pair is ever found',
			'put PolytopeCollider([Bo1_Polytope_Aabb(), …]) before the InteractionLoop',
		)
	if not scene.integrators:
		yield (
			'engines',
			'O.engines has no NewtonIntegrator: nothing moves',
			'put NewtonIntegrator(gravity=(0, 0, -9.81)) after the InteractionLoop',
		)
	if not scene.those(ForceResetter):
		yield 'engines', 'O.engines has no ForceResetter: forces add up from step to step', 'put ForceResetter() first'


def twice(scene):
	"""Engines that must act once a step."""
	if len(scene.colliders) > 1:
		names = ' and '.join(type(one).__name__ for one in scene.colliders)
		yield (
			'engines',
			f'O.engines has {len(scene.colliders)} colliders, {names}: each takes away pairs that the other one keeps',
			'keep one',
		)
	for kind, what in (
		(InteractionLoop, 'contact forces are computed and added once by each'),
		(NewtonIntegrator, 'each moves all bodies by a step'),
	):
		several = scene.those(kind)
		if len(several) > 1:
			name = kind.__name__
			advice = 'keep one, with all functors in it' if kind is InteractionLoop else 'keep one'
			yield 'engines', f'O.engines has {len(several)} {name}s: {what}', advice


def spheresOnly(scene):
	"""Controllers of YADE that count the volume of spheres alone."""
	for engine in scene.those(TriaxialStressController):
		if any(isinstance(body.shape, Polytope) for body in scene.bodies):
			seen = f'{type(engine).__name__} knows spheres only: its porosity is wrong for polytopes, as is what it controls by it'
			yield 'engines', seen, 'polytope.pack and polytope.triaxial, or PeriTriaxController in a periodic cell (docs/loading.md)'


def densityScaling(scene):
	"""YADE's takes the radius of every body without a contact. What is set in the integrator is set in the stepper, too."""
	scaling = [engine for engine in scene.those(GlobalStiffnessTimeStepper) if engine.densityScaling]
	others = [body for body in scene.bodies if scene.moves(body) and not isinstance(body.shape, Sphere)]
	if scaling and others:
		seen = 'GlobalStiffnessTimeStepper has densityScaling=True, which is for spheres: YADE ends the process where another body has no contact'
		yield 'density scaling', seen, 'densityScaling=False; PolytopeTimeStepper() takes the largest step that is stable'


def order(scene):
	"""From a ForceResetter on, and round to the first engine again, the loop must come before the integrator; from that on the collider
	before the loop."""
	if scene.colliders and scene.loops and scene.integrators:
		after = _roundFrom(scene, scene.integrators[0])
		if after.index(scene.colliders[0]) > after.index(scene.loops[0]):
			name = type(scene.colliders[0]).__name__
			yield (
				'order of engines',
				f'bodies move between {name} and the InteractionLoop: pairs are found a step late',
				f'put {name} between the NewtonIntegrator of one step and the InteractionLoop of the next, best right before the loop',
			)
	resetters = scene.those(ForceResetter)
	if not resetters or not scene.loops or not scene.integrators:
		return
	after = _roundFrom(scene, resetters[0])
	if after.index(scene.loops[0]) > after.index(scene.integrators[0]):
		where = 'between the InteractionLoop and the NewtonIntegrator: it erases the contact forces before they act'
		yield (
			'order of engines',
			f'ForceResetter is {where}',
			'put ForceResetter first in O.engines, then collider, InteractionLoop, NewtonIntegrator',
		)


def _roundFrom(scene, engine):
	"""The engines that follow this one, round to the first again."""
	start = scene.engines.index(engine)
	return scene.engines[start + 1 :] + scene.engines[:start]


def bondsAndBolts(scene):
	"""Bonds and bolts that are lost, or of which others know nothing."""
	for what, kind, removed, loss in (
		('bonds', PolytopeBonds, removedBonds, lambda engine: f'whose {engine.intactInScene} bonds were intact: those bodies are loose'),
		('bolts', PolytopeBolts, removedBolts, lambda engine: f'of which {engine.actingInScene} held blocks: they hold nothing now'),
	):
		those, lost = scene.those(kind), removed() if scene.ownEngines else None
		if lost is not None:
			remedy = f'O.engines = polytope.engines(…) puts it back; a list of your own must hold polytope.{what}() before NewtonIntegrator'
			yield what, f'O.engines has no {kind.__name__} any more, {loss(lost)}', remedy
		if len(those) > 1:
			seen = f'O.engines has {len(those)} {kind.__name__}: contacts and functions know the {what} of the first one only'
			yield what, seen, f'keep one, and make all {what} with polytope.{what[:-1]}'


def dampingOfShaken(scene):
	"""Numerical damping of motion that comes from a base or leaves through a boundary."""
	shaken = [type(one).__name__ for one in scene.those(BaseMotion, QuietBoundary)]
	damping = max((float(one.damping) for one in scene.integrators), default=0.0)
	if shaken and damping > 0:
		seen = f'NewtonIntegrator has damping={damping:g} beside {shaken[0]}: it acts on absolute velocities, so that it holds back all that is carried along'
		advice = "damping=0, and polytope.settle() for coming to rest before; joints have dampers of their own (the law's normalDamping, shearDamping)"
		yield 'damping', seen, advice


def erasedForces(scene):
	"""Forces that are not there any more when bodies are moved."""
	resetters = scene.those(ForceResetter)
	if not resetters or not scene.integrators:
		return
	after = _roundFrom(scene, resetters[0])
	for kind, what in ((PolytopeBonds, 'bonds'), (PolytopeBolts, 'bolts'), (PolytopeWater, 'water'), (QuietBoundary, 'order of engines')):
		if any(after.index(one) > after.index(scene.integrators[0]) for one in scene.those(kind)):
			seen = f'{kind.__name__} is not before the NewtonIntegrator: its forces are erased before they act'
			yield what, seen, 'put it after the InteractionLoop'


def unitOfSurface(scene):
	for loop in scene.loops:
		for functor in loop.geomDispatcher.functors:
			if not isinstance(functor, Ig2_Polytope_Polytope_PolytopeGeom):
				continue
			for perArea in sorted(unitsOfStiffness([loop])):
				if wrong := wrongUnit(functor.contactModel, perArea):
					yield 'damping and energy', *wrong


def pointWithoutArea(scene):
	"""The largest ball between flush faces lies in a corner of them as well as anywhere, and the section through it has hardly any area."""
	for loop in scene.loops:
		for functor in loop.geomDispatcher.functors:
			if not isinstance(functor, Ig2_Polytope_Polytope_PolytopeGeom) or functor.contactPoint != 'chebyshevCentre':
				continue
			if True in unitsOfStiffness([loop]):
				seen = "contactPoint 'chebyshevCentre' with stiffnesses per area: of faces that lie flush the point may be a corner, where the area is almost none, and so is the stiffness"
				yield 'contact point', seen, "contactPoint='analyticCentre', or stiffnessPerArea=False and stiffnesses in N/m"


def recorders(scene):
	"""YADE's recorder knows spheres, boxes and facets; by default contacts of spheres with each other alone (skipFacetIntr)."""
	if not any(isinstance(body.shape, Polytope) for body in scene.bodies):
		return
	if any({'intr', 'all'} & set(recorder.recorders) for recorder in scene.those(VTKRecorder)):
		seen = "YADE's VTKRecorder writes no polytopes, and with 'intr' the contacts of spheres with each other alone"
		yield 'recorder', seen, "PolytopeVTKRecorder(fileName='output/', recorders=['bodies', 'contacts']), beside it or in its place"


def driven(scene):
	"""Engines that move bodies by their numbers: YADE passes over numbers that there are none of, and moves bodies without a blocked degree
	of freedom by forces, too."""
	bodies = scene.O.bodies
	for engine in scene.those(KinematicEngine):
		name = type(engine).__name__
		there = [k for k in engine.ids if 0 <= k < len(bodies) and bodies[k] is not None]
		lost = [k for k in engine.ids if k not in there]
		free = [k for k in there if canMove(bodies[k]) and not bodies[moverOf(k)].state.blockedDOFs]
		if lost:
			yield (
				'engines',
				f'{name} moves body {lost[0]}, which does not exist',
				'ids of bodies that are in the scene: O.bodies.append(…) returns them',
			)
		if free:
			yield (
				'engines',
				f'{name} moves body {free[0]}, which is free: gravity and contacts move it, too',
				'make it with fixed=True, or set its dynamic = False',
			)


def masks(scene):
	"""A mask without any bit meets nothing; one such body may be a marker."""
	free = [body for body in scene.bodies if scene.moves(body)]
	if free and not any(body.mask for body in free):
		yield (
			'masks',
			'all bodies that can move have mask=0: they touch nothing',
			'mask=1, the default, or bits that those have which they are to touch',
		)
