# SPDX-License-Identifier: GPL-2.0-or-later
"""What moves a sample's boundary in each step: a servo for each direction, and the engine that calls it."""

import math

from yade import O, PyRunner

from ..scene.present import insertEngine, placeOfForces

__all__ = ['Servo', 'act', 'actOn', 'eased']

massShare = 0.1
"""Mass of a servo over that of the sample: walls answer as fast as the grains, and the step that is stable for grains is stable for them."""
easing = 0.02
"""Part of the difference to a prescribed speed that is made up in a step."""
command = 'from yade.polytope.loading.servo import act; act()'
acting = [None]
"""The boundary that the engine moves."""


class Servo:
	"""A mass that is pushed by the difference of two forces: its speed ends where they are equal. It has no damping of its own, which would take part
	in the balance of a boundary that moves; bodies and contacts damp it."""

	def __init__(self, sampleMass, fastest=math.inf):
		self.mass, self.fastest, self.speed = massShare * sampleMass, fastest, 0.0

	def step(self, excess):
		"""Speed [m/s] after a step with this force [N]."""
		self.speed = min(max(self.speed + excess / self.mass * float(O.dt), -self.fastest), self.fastest)
		return self.speed


def eased(now, goal):
	"""Speed after a step towards a prescribed one, which begins without a blow; it ends at once."""
	return now + (goal - now) * easing if goal else 0.0


def actOn(boundary):
	"""Has the boundary's move() called in each step from now on, between InteractionLoop and NewtonIntegrator, where forces are known;
	None: nothing is moved."""
	if boundary is not None:
		placeOfForces('the walls are moved')
	known, acting[0] = acting[0], boundary
	if (
		boundary is not None
		and known is boundary
		and any(isinstance(engine, PyRunner) and engine.command == command for engine in O.engines)
	):
		return
	O.engines = [engine for engine in O.engines if not (isinstance(engine, PyRunner) and engine.command == command)]
	if boundary is not None:
		insertEngine(placeOfForces('the walls are moved'), PyRunner(command=command, iterPeriod=1, initRun=True))


def act():
	"""What the engine calls."""
	if acting[0] is None:
		raise RuntimeError('loading: the boundary of this scene is not known in this session, as after O.load; make the loading test anew')
	acting[0].mustBePresent()
	acting[0].move()
