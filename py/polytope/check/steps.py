# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of time step and motion, of polytope.check(). Each yields (what, seen, advice)."""

import math

from yade import (
	BaseMotion,
	GlobalStiffnessTimeStepper,
	KinematicEngine,
	Polytope,
	PolytopeBolts,
	PolytopeBonds,
	PolytopeCollider,
	PolytopeTimeStepper,
	PyRunner,
	RotationEngine,
	TimeStepper,
)

from ..scene.movers import cannotTurn, moverOf
from ..scene.radii import inscribedRadius
from ..scene.timeStep import safeTimeStep

__all__ = ['stepFindings', 'usual', 'yadesDt']

usual, safe = 0.2, 1.0
"""Time step over τ (docs/time-step.md): as advised, and up to where any heap is stable, see stableTimeStep."""
yadesDt = 1e-8
"""YADE's own O.dt, until something sets it [s]."""

forgotten = 0.1
"""Share of the usual step below which YADE's own was not meant: somebody who wants so many steps would have set another number."""


def stepFindings(scene):
	for one in (steppers, timeStep, emptyAtFirst, nothingMoves, farInAStep, turningUnnoticed):
		yield from one(scene)


def steppers(scene):
	active = [engine for engine in scene.those(TimeStepper) if engine.active]
	if len(active) > 1:
		names = ' and '.join(type(engine).__name__ for engine in active)
		yield 'time step', f'{names} both set O.dt', 'keep one of them: each overwrites the step of the other'
	for engine in active:
		if isinstance(engine, GlobalStiffnessTimeStepper) and not float(engine.defaultDt) > 0:
			seen = 'GlobalStiffnessTimeStepper has no defaultDt: until the first contact O.dt is that of a wave in spheres, 1 s or so'
			yield 'time step', seen, 'PolytopeTimeStepper() in its place, or defaultDt = 0.2 √(m/k) with the least mass'
		unknown = ['bonds'] if any(bonds.intactCount for bonds in scene.those(PolytopeBonds)) else []
		unknown += ['bolts'] if any(bolts.actingCount for bolts in scene.those(PolytopeBolts)) else []
		if isinstance(engine, GlobalStiffnessTimeStepper) and unknown:
			seen = f'GlobalStiffnessTimeStepper does not know {" and ".join(unknown)}: its step may be unstable'
			yield 'time step', seen, 'PolytopeTimeStepper() in its place'
		limit = safeTimeStep() if scene.ownEngines and scene.loops and scene.O.iter > 0 else None
		if isinstance(engine, GlobalStiffnessTimeStepper) and limit is not None and float(scene.O.dt) > safe * float(limit):
			share = float(scene.O.dt) / float(limit)
			seen = f'GlobalStiffnessTimeStepper, which neglects the rocking of faces, has set O.dt to {share:.2g} of the largest step that is stable for any heap'
			yield 'time step', seen, 'PolytopeTimeStepper() in its place'


def timeStep(scene):
	"""τ follows from the engines that O has: nothing is known of others."""
	if (
		any(engine.active for engine in scene.those(TimeStepper))
		or not scene.ownEngines
		or not any(scene.moves(body) for body in scene.bodies)
	):
		return
	dt, remedy = float(scene.O.dt), 'put PolytopeTimeStepper() into O.engines'
	if not 0 < dt < math.inf:
		yield 'time step', f'O.dt is {dt:.3g} s', f'{remedy}, or set O.dt above 0'
		return
	limit = safeTimeStep() if scene.loops else None
	if limit is not None and dt > safe * limit:
		share = dt / float(limit)
		seen = f"O.dt is {dt:.3g} s, {share:.2g} of the largest step that is stable for any heap (YADE's PWaveTimeStep is for spheres)"
		yield 'time step', seen, f'{remedy}, or O.dt = {usual * float(limit):.2g} (polytope.stableTimeStep({usual}))'
	elif limit is not None and dt == yadesDt and dt < forgotten * usual * limit:
		seen = f'O.dt is {dt:.1g} s, as YADE begins, and nothing sets it: {usual * float(limit) / dt:.2g} times as many steps as are needed'
		yield 'time step', seen, f'{remedy}, or O.dt = {usual * float(limit):.2g} (polytope.stableTimeStep({usual}))'


def emptyAtFirst(scene):
	"""As long as nothing can move, PolytopeTimeStepper has the step of a virtPeriod, with PolytopeCollider alone."""
	runners = scene.those(PyRunner)
	if not runners or not any(isinstance(engine, PolytopeTimeStepper) and engine.active for engine in scene.those(TimeStepper)):
		return
	if float(scene.O.dt) > yadesDt or any(scene.moves(body) for body in scene.bodies):
		return
	if any(float(runner.virtPeriod) > 0 for runner in runners) and any(isinstance(one, PolytopeCollider) for one in scene.colliders):
		return
	seen = (
		f'nothing can move yet, and O.dt is {float(scene.O.dt):.1g} s until something can: a PyRunner that waits for a time waits for ever'
	)
	yield 'time step', seen, 'PolytopeCollider and a PyRunner with virtPeriod, which then sets the step, or set O.dt'


def nothingMoves(scene):
	"""Nothing sets the step then, and a loop that runs up to a time does so for ever. Looked at for the scene's own engines: bodies may
	follow later."""
	if not scene.ownEngines or not scene.bodies or scene.those(PyRunner, KinematicEngine, BaseMotion) or float(scene.O.dt) > yadesDt:
		return
	if any(scene.moves(body) for body in scene.bodies):
		return
	pushed = [body.id for body in scene.bodies if float(body.state.vel.norm() + body.state.angVel.norm()) > 0]
	which = f'only fixed bodies move (body {pushed[0]} first)' if pushed else 'no body can move'
	seen = f'{which}, and O.dt is {float(scene.O.dt):.1g} s: a run up to a time takes for ever'
	advice = 'set O.dt' if pushed else 'append bodies that can move (fixed=False, a density above 0), or set O.dt'
	yield 'time step', seen, advice


def farInAStep(scene):
	"""PolytopeTimeStepper sees to it itself."""
	if any(isinstance(engine, PolytopeTimeStepper) and engine.active for engine in scene.those(TimeStepper)):
		return
	fast = [body for body in scene.bodies if float(body.state.vel.norm() * scene.O.dt) > inscribedRadius(body.shape)]
	if fast:
		body = max(fast, key=lambda one: float(one.state.vel.norm()))
		speed = f'body {body.id}: {float(body.state.vel.norm()):.3g} m/s × {float(scene.O.dt):.3g} s'
		seen = f'{len(fast)} bodies move farther than their size in a step ({speed})'
		yield 'speed', seen, 'PolytopeTimeStepper() limits the step by motion, too; or take a smaller O.dt, or mend the velocity'


def turningUnnoticed(scene):
	"""YADE's own collider makes boxes anew after translations alone."""
	if all(isinstance(collider, PolytopeCollider) or float(collider.verletDist) == 0 for collider in scene.colliders):
		return
	driven = {key for engine in scene.those(RotationEngine) if float(engine.angularVelocity) != 0 for key in engine.ids}
	for body in scene.bodies:
		blade = type(body.shape).__name__ in ('Box', 'Facet') and _turns(scene, body, driven)
		if blade or (isinstance(body.shape, Polytope) and body.id in driven and _seemsToRest(body)):
			yield 'turning bodies', _passes(body), 'PolytopeCollider in its place, or verletDist=0 in the collider'
			return


def _passes(body):
	return f'body {body.id}, a {type(body.shape).__name__}, turns, which the collider does not notice: it can pass through resting bodies'


def _turns(scene, body, driven):
	"""Whether it turns, or may turn, pushed by others; a member turns with its clump."""
	whole = scene.O.bodies[moverOf(body.id)]
	return whole.id in driven or body.id in driven or float(whole.state.angVel.norm()) > 0 or (scene.moves(body) and not cannotTurn(whole))


def _seemsToRest(body):
	"""When its box is made: Bo1_Polytope_Aabb gives it a tight one."""
	return not body.isClumpMember and cannotTurn(body) and not float(body.state.angVel.norm()) > 0
