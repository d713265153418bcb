# SPDX-License-Identifier: GPL-2.0-or-later
"""The checks of polytope.requirements(). Each gives (seen, advice, cost, trial), see requirements.Finding, or why it cannot be made.

They read and change nothing.
"""

import itertools
import math

import numpy as np
import yade
from yade import NewtonIntegrator, Polytope, PolytopeGeom, RockJointPhys, TimeStepper, _polytope

from ..arguments import vectors
from ..scene.permanentLoads import permanentLoads
from ..scene.present import geometryFunctors, interactionLoops, laws, stiffnessesPerArea, wrongUnit
from .boxes import boxes, verletDist
from .centre import contactPoint, solver
from .engines import engines
from .overlaps import cornerRadius, newtonTolerance
from .plane import dimension, polygons

__all__ = ['checks']

usual, safe, stable, least = 0.2, 1.0, 2.0, 0.05
"""Time step over τ, docs/time-step.md: as advised, up to where any heap is stable, up to where one body is (see stableTimeStep), and
below which steps are many."""
mostTwins = 50
"""Contacts that are computed again without the planes that own no face."""
timedWithoutContacts = ('verletDist',)
"""Changes whose time is meaningful in a scene without contacts."""
noContacts = 'no contacts now'
turned, changed = 1.0, 0.05
"""Changes of a normal's angle [°] and, relatively, of a force by such planes that are not reported."""

sameFace = 1 - 1e-6
"""Cosine between normals of two contacts of one face."""


class Scene:
	"""Data that several checks need."""

	def __init__(self, O):
		if not isinstance(O, type(yade.O)):
			raise ValueError(f'O: must be yade.O, got {O!r}')
		self.O = O
		self.functors = geometryFunctors()
		if not self.functors:
			raise ValueError('O: has no InteractionLoop with an Ig2_Polytope_Polytope_PolytopeGeom, there is nothing to check')
		if O.running:
			raise ValueError('O: is running; O.pause() first')
		self.contacts = [contact for contact in O.interactions if contact.isReal and isinstance(contact.geom, PolytopeGeom)]
		self.bodies = [body for body in O.bodies if body is not None and isinstance(body.shape, Polytope)]
		self.moving = [body for body in self.bodies if body.dynamic]
		self.unknown = sum(math.isnan(contact.geom.penetrationDepth) for contact in self.contacts)
		self.depths = [float(contact.geom.penetrationDepth) for contact in self.contacts if contact.geom.penetrationDepth > 0]
		self.dampers = laws()
		self.newton = next((engine for engine in O.engines if isinstance(engine, NewtonIntegrator)), None)

	def count(self, *statuses):
		"""Queries that ended so since the start, or the last resetStats()."""
		return sum(functor.stats()['statuses'].get(status, 0) for functor in self.functors for status in statuses)

	def any(self, name):
		"""Whether a contact functor has this switched on."""
		return any(getattr(functor, name) for functor in self.functors)

	def pairs(self):
		"""Ids of the contacts' bodies that are both polytopes."""
		pairs = [(contact.id1, contact.id2) for contact in self.contacts]
		return [pair for pair in pairs if all(isinstance(self.O.bodies[k].shape, Polytope) for k in pair)]

	def withoutDepths(self):
		"""Why there are no overlaps to check."""
		if self.unknown:
			return f'the depths of {self.unknown} contacts are not known: YADE does not save them. Take a step first, O.step()'
		return 'no polytopes overlap now'

	def size(self):
		"""Of the smallest polytope [m]."""
		return min(float(body.shape.inscribedRadius) for body in self.bodies)

	def values(self, name):
		return sorted({getattr(functor, name) for functor in self.functors})


def checks(O):
	"""(what was found, [(what could not be checked, why)], whether there are contacts).

	In the order in which advice can be followed: solver before contact point, for that of the point alone would make the solver active,
	and the contact model, which uses neither if it is one of a contact surface, at the end."""
	scene = Scene(O)
	each = (numbersOfBodies, engines, polygons, timeStep, solver, contactPoint, area, support, dimension, cornerRadius, planes, newtonTolerance)
	each += (verletDist, boxes, warmStart, clocks, energyTracking, energy, cohesion, loads)
	found, missing = [], []
	for one in each:
		name, answer = one.__doc__.strip().rstrip('.'), one(scene)
		if isinstance(answer, str):
			missing.append((name, answer))
			continue
		seen, advice, cost, trial = *answer, *['', None, None][len(answer) - 1 :]
		if trial and not scene.contacts and trial[0] not in timedWithoutContacts:
			trial = None
		found.append((name, seen, advice, cost, trial))
	return found, missing, bool(scene.contacts)


def area(scene):
	"""contact area"""
	if 'boon2012' not in scene.values('contactModel'):
		return 'a contact surface has its own'
	if not scene.contacts:
		return noContacts
	users = sum(contact.geom.needsArea for contact in scene.contacts)
	if scene.any('computeArea'):
		if users == len(scene.contacts):
			return 'computeArea is on; all contacts need their area anyway', ''
		advice = 'computeArea = False, unless your script reads geom.contactArea: no law or material uses it'
		return f'computeArea is on; {users} of {len(scene.contacts)} contacts need their area', advice, None, ('computeArea', False)
	return f'{users} of {len(scene.contacts)} contacts need their area, and have it', ''


def support(scene):
	"""several pieces under one face"""
	if not scene.contacts:
		return noContacts
	if scene.unknown:
		return scene.withoutDepths()
	if _stiffnessPerArea(scene):
		return 'stiffnesses are per area: pieces that lie flush are as stiff as one', ''
	faces, shared = {}, 0
	for contact in scene.contacts:
		shared += contact.geom.share < 1
		for body in (contact.id1, contact.id2):
			if contact.geom.share == 1 and scene.O.bodies[body].dynamic:
				faces.setdefault(body, []).append(contact.geom)
	several = sum(any(_oneFace(a, b, depth) for a, b in itertools.combinations(found, 2)) for found in faces.values() if (depth := _depth(found)) > 0)
	seen = f'{shared} contacts with a fixed or clumped piece have their part of the stiffness; bodies with a face on several pieces of full stiffness: {several}'
	if several:
		return seen, 'stiffnessPerArea = True: per contact such a face is as stiff as it has pieces, and a piece acts in full at once'
	return seen, ''


def _depth(found):
	return min(float(geom.penetrationDepth) for geom in found)


def _oneFace(one, other, depth):
	"""Whether both contacts lie in one plane, to within an overlap."""
	along = one.normal.dot(other.normal)
	return abs(along) > sameFace and abs(one.normal.dot(other.contactPoint - one.contactPoint)) < depth


def energy(scene):
	"""damping and energy"""
	models = scene.values('contactModel')
	perArea = _stiffnessPerArea(scene)
	for found in wrongUnit(models, perArea):
		return found
	if 'boon2012' not in models:
		return 'the energy of the contact surface is conserved but for the moment about the normal that a single force leaves out', ''
	local = scene.newton.damping if scene.newton else 0
	viscous = max((law.normalDamping for law in scene.dampers), default=0)
	if local == 0 and viscous == 0:
		return (
			"nothing damps the normal direction, and contactModel 'boon2012' creates and destroys energy",
			"contactModel = 'surface' (which uses neither contactPoint nor solver), or damping: "
			"with contactModel 'boon2012' energy is not conserved at any time step",
			None,
			('contactModel', 'surface'),
		)
	return f'NewtonIntegrator.damping {local:g}, normalDamping {viscous:g} of critical', ''


def _stiffnessPerArea(scene):
	"""Of the joints there are; before the first, of those to come."""
	joints = [contact.phys for contact in scene.contacts if isinstance(contact.phys, RockJointPhys)]
	if joints:
		return any(joint.normalStiffness > 0 for joint in joints)
	return stiffnessesPerArea(interactionLoops())


def cohesion(scene):
	"""cohesion"""
	if not scene.contacts:
		return noContacts
	joints = [contact.phys for contact in scene.contacts if isinstance(contact.phys, RockJointPhys)]
	bonded = [joint for joint in joints if joint.cohesion > 0 or joint.tensileStrength > 0]
	intact = sum(joint.intact for joint in bonded)
	if bonded and not intact:
		advice = 'none (it costs no time); materials without cohesion and tensileStrength give the same run from here on'
		return f'{len(bonded)} of {len(joints)} joints had cohesion or tensile strength, none is intact', advice
	return f'{intact} of {len(joints)} joints have cohesion or tensile strength to lose; without them it costs no time', ''


def loads(scene):
	"""permanent forces"""
	loaded = len(permanentLoads())
	if not loaded:
		return 'none', ''
	advice = 'ForceEngine or TorqueEngine, or set them again after O.load: YADE leaves permanent forces out of O.save and O.saveTmp'
	return f'{loaded} bodies have one (O.forces.setPermF, setPermT)', advice


def planes(scene):
	"""planes without a face"""
	spare = {body.id: len(body.shape.normals) - len(body.shape.faces) + 2 * (body.shape.dimension == 2) for body in scene.bodies}
	spare = {key: number for key, number in spare.items() if number}
	if not spare:
		return 'every plane owns a face', ''
	seen = f'{sum(spare.values())} planes of {len(spare)} bodies own none'
	if not scene.pairs():
		return f'{seen}, but no two polytopes are in contact now to measure their effect'
	functor = scene.functors[0]
	how = {name: getattr(functor, name) for name in ('contactPoint', 'contactModel', 'solver', 'tolerance', 'newtonTolerance')}
	angle = force = compared = 0
	for pair in [pair for pair in scene.pairs() if spare.keys() & set(pair)][:mostTwins]:
		bodies = [scene.O.bodies[key] for key in pair]
		here, there = (_polytope.contact(*both, **how) for both in (bodies, [_twin(body) for body in bodies]))
		if here.inContact and there.inContact:
			compared += 1
			one, other = (np.array(found.normal, float) * float(found.depth) for found in (here, there))
			angle = max(angle, math.degrees(math.acos(min(1, float(here.normal.dot(there.normal))))))
			force = max(force, np.linalg.norm(one - other) / np.linalg.norm(other))
	if compared:
		seen += f'; without them normals of {compared} contacts turn by up to {angle:.2g}° and forces change by up to {100 * force:.2g} %'
	if angle > turned or force > changed:
		return seen, 'fromHalfSpaces(…, keepRedundant=False), unless they are wanted: each one shifts contact point and normal'
	return seen, ''


def _twin(body):
	"""The body without planes that own no face, at its present pose."""
	shape = body.shape
	normals = vectors(shape.normals, 'normals', 3)
	placed = _polytope.ofHalfSpaces(normals, shape.offsets, shape.dimension, shape.thickness, False, shape.cornerRadius, 0)
	state = body.state
	return _polytope.body(placed, body.material, state.pos + state.ori * placed.position, state.ori, True, 0, None)


def numbersOfBodies(scene):
	"""numbers of bodies"""
	states = {body.id: (*body.state.pos, *body.state.ori, *body.state.vel, *body.state.angVel) for body in scene.O.bodies if body is not None}
	lost = [k for k, numbers in states.items() if not all(math.isfinite(float(x)) for x in numbers)]
	failed = sum(functor.stats()['failures'] for functor in scene.functors)
	seen = f'{len(lost)} of {len(states)} bodies have non-finite positions or velocities' + (f', {failed} contact queries had no answer' if failed else '')
	if lost:
		return f'{seen} (body {lost[0]})', 'the run failed earlier: such a body has no contacts; go back, and take a smaller O.dt'
	return seen, 'find out where: docs/statuses.md says why a query may have no answer' if failed else ''


def timeStep(scene):
	"""time step"""
	steppers = [type(engine).__name__ for engine in scene.O.engines if isinstance(engine, TimeStepper) and engine.active]
	if steppers:
		advice = 'keep one of them: each overwrites the step of the other' if steppers[1:] else ''
		if steppers == ['GlobalStiffnessTimeStepper']:
			advice = 'PolytopeTimeStepper: GlobalStiffnessTimeStepper neglects the rocking of faces and what the contacts to come will be'
		return f'set by {" and ".join(steppers)}', advice
	if not 0 < float(scene.O.dt) < math.inf:
		return f'{float(scene.O.dt):.3g} s', 'O.dt must be above 0: nothing moves otherwise'
	limit = _polytope.timeStepLimits()['contacts']
	if limit is None:
		return 'no contact limits it now'
	limit = float(limit)
	fraction = float(scene.O.dt) / limit
	seen = f'{float(scene.O.dt):.3g} s, {fraction:.2g} of τ (1/ω of the fastest body, less with dampers; any heap is stable up to 1, one body up to 2)'
	smaller = f'O.dt = {usual * limit:.2g} (polytope.stableTimeStep({usual}))'
	if fraction > stable:
		return seen, f'{smaller}: beyond the limit of stability of one body, 2 τ, a heap can be stable there by damping only'
	if fraction > safe:
		return seen, f'{smaller}: near the limit of stability, beyond what is safe for any heap, stableTimeStep(1)'
	if fraction < least:
		return seen, f'O.dt = {usual * limit:.2g} takes {fraction / usual:.2g} of the steps, unless a stiffer contact is still to come'
	return seen, ''


def warmStart(scene):
	"""warm start"""
	if all(functor.warmStart for functor in scene.functors):
		return 'on', '', None, ('warmStart', False)
	return 'off', 'warmStart = True: the answer is the same to rounding', None, ('warmStart', True)


def clocks(scene):
	"""clocks"""
	if scene.any('timing'):
		return "the contact functor's timing is on", 'timing = False, unless you read lpSeconds and centreSeconds', None, ('timing', False)
	return "the contact functor's timing is off", ''


def energyTracking(scene):
	"""energy tracking"""
	if scene.O.trackEnergy:
		return 'O.trackEnergy is on', 'O.trackEnergy = False, unless you read O.energy', None, ('trackEnergy', False)
	return 'O.trackEnergy is off', ''
