# SPDX-License-Identifier: GPL-2.0-or-later
"""Times a saved scene as it is and with things changed: `python3 -m yade.polytope.requirements.worker SCENE CHANGES ANSWER`.

polytope.requirements() starts it as a process of its own: what it does to the scene does not matter.
"""

import json
import math
import os
import pathlib
import sys
import traceback

import numpy as np
from yade import O, PeriodicEngine

from .._timing import timed
from ..bodies.polytopes import polygon
from ..scene.permanentLoads import givePermanentLoads
from ..scene.present import colliders, geometryFunctors, laws

__all__ = ['change', 'prismOutline', 'stepTimes']

seconds, rounds = 0.12, 2
"""Of timed steps for each change in a round, and rounds over all changes: the machine may be busy during one."""
warmUp = 3
"""Steps before them: boxes and the contacts' warm-start data are computed again."""
flat = 1e-9
"""Up to which a normal counts as in the plane, or normal to it."""


def prismOutline(body):
	"""Corners of the cross-section of a polyhedron that is a prism along z where it is, in order, as (n, 2) array; None if it is none."""
	turn = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
	normals = np.array(body.shape.normals, float).reshape(-1, 3) @ turn.T
	along = np.abs(normals[:, 2])
	if not np.all((along < flat) | (along > 1 - flat)):
		return None
	corners = np.array(body.shape.vertices, float).reshape(-1, 3) @ turn.T + np.array(body.state.pos, float)
	return corners[corners[:, 2] > corners[:, 2].mean(), :2]


def change(name, value):
	"""One change of the scene that was loaded."""
	if name == 'trackEnergy':
		O.trackEnergy = value
	elif name == 'verletDist':
		for collider in colliders():
			collider.verletDist = value
	elif name == 'rockingDamping':
		for law in laws():
			law.rockingDamping = value
		for contact in O.interactions:  # whether areas are needed is determined when a contact is made
			if contact.isReal:
				O.interactions.erase(contact.id1, contact.id2)
	elif name == 'dimension':
		_flatten()
	else:
		for functor in geometryFunctors():
			setattr(functor, name, value)


def _flatten():
	"""Polygons for prisms; bodies keep material, place and motion, contacts are found anew."""
	bodies = []
	for body in O.bodies:
		height = np.ptp([float((body.state.ori * corner)[2]) for corner in body.shape.vertices])
		flatBody = polygon(prismOutline(body).tolist(), thickness=height, material=body.material, fixed=not body.dynamic)
		flatBody.shape.cornerRadius = min(body.shape.cornerRadius, 0.9 * flatBody.shape.inscribedRadius)
		flatBody.state.vel, flatBody.state.angVel = body.state.vel, body.state.angVel
		bodies.append(flatBody)
	O.interactions.clear()
	O.bodies.clear()
	O.bodies.append(bodies)


def load(scene, loads):
	"""The scene, and what its file does not hold: permanent loads, as costs.py has written them."""
	O.load(scene, quiet=True)
	givePermanentLoads({k: (force, torque) for k, force, torque in loads})
	# what writes files or runs scripts belongs to the scene of the user
	O.engines = [engine for engine in O.engines if not isinstance(engine, PeriodicEngine)]


def stepTime(scene, loads, changes):
	"""Of the scene with these changes [µs]; infinite if it does not run."""
	try:
		load(scene, loads)
		for name, value in changes:
			change(name, value)
		for _ in range(warmUp):
			O.step()
		return timed(seconds)[0]
	except Exception:
		traceback.print_exc()
		return math.inf


def stepTimes(scene, trials, loads=()):
	"""Name → time of a step [µs] with that change and the advised ones before it in force; '' as the scene is. Without what does not run.

	:param list trials: (name, value, whether it is advised)
	:param loads: [body's id, force, torque] of permanent loads
	"""
	plans, times, inForce = {'': []}, {'': stepTime(scene, loads, [])}, []
	for name, value, advised in trials:
		plans[name] = [*inForce, (name, value)]
		times[name] = stepTime(scene, loads, plans[name])
		if advised and times[name] < math.inf:
			inForce = plans[name]
	for _ in range(rounds - 1):
		for name, plan in plans.items():
			times[name] = min(times[name], stepTime(scene, loads, plan))
	return {name: time for name, time in times.items() if time < math.inf}


def main(scene, trials, answers):
	times = stepTimes(scene, **json.loads(pathlib.Path(trials).read_text()))
	pathlib.Path(answers).write_text(json.dumps(times))
	sys.stdout.flush()
	os._exit(0)


if __name__ == '__main__':
	main(*sys.argv[1:])
