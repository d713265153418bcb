# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces of bodies that have been taken away, which fade to zero: an engine that goes on after saving and loading, and then removes itself."""

import ast
import functools
import json
import math

from yade import O, PyRunner, Vector3

from .present import insertEngine, placeOfForces

__all__ = ['act', 'heldByRelaxing', 'relaxing', 'startRelaxing']

module = "__import__('yade.polytope.scene.relaxing', fromlist=['act']).act"
"""A call that leaves no name among the script's own."""


def startRelaxing(loads, steps):
	"""Applies forces and torques to bodies from the next step on, less in each, and none after so many steps.

	:param loads: id → (force [N], torque about the centre [N·m]), constant in direction
	:raises ValueError: as placeOfForces
	"""
	place = placeOfForces('the forces that fade act')
	plain = json.dumps([[int(k), *([float(x) for x in vector] for vector in load)] for k, load in loads.items()])
	insertEngine(place, PyRunner(command=_command(int(O.iter), steps, plain), iterPeriod=1, initRun=True))


def relaxing():
	"""The engines of this kind in the scene."""
	return [engine for engine in O.engines if isinstance(engine, PyRunner) and engine.command.startswith(module)]


def heldByRelaxing():
	"""Ids of the bodies that those forces act on."""
	found = set()
	for engine in relaxing():
		_, _, loads = ast.literal_eval(engine.command[len(module) :])
		found |= {k for k, *_ in _unpacked(loads)}
	return found


def act(began, steps, loads):
	"""What the engine calls."""
	part = (int(O.iter) - began + 1) / steps
	if part >= 1:
		command = _command(began, steps, loads)
		O.engines = [engine for engine in O.engines if not (isinstance(engine, PyRunner) and engine.command == command)]
		return
	left = (1 + math.cos(math.pi * part)) / 2  # without a jump of the rate at either end, which would make bodies swing
	for k, force, torque in _unpacked(loads):
		if k < len(O.bodies) and O.bodies[k] is not None:
			O.forces.addF(k, left * Vector3(*force))
			O.forces.addT(k, left * Vector3(*torque))


def _command(began, steps, loads):
	"""The state is in the command, which is saved with the engine."""
	return f'{module}({began}, {steps}, {loads!r})'


@functools.lru_cache(maxsize=8)
def _unpacked(loads):
	"""Kept: a command is read in each step, and a word is read sooner than a list of numbers."""
	return json.loads(loads)
