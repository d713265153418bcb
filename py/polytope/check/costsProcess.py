# SPDX-License-Identifier: GPL-2.0-or-later
"""Times a saved scene as it is and with things changed: `python3 -m yade.polytope.check.costsProcess SCENE CHANGES ANSWER`.

polytope.check(O, costs=True) starts it as a process of its own: what it does to the scene does not matter.
"""

import json
import math
import os
import pathlib
import sys
import traceback

from yade import O, PeriodicEngine

from .._timing import timed
from ..scene.permanentLoads import givePermanentLoads
from ..scene.present import colliders, contactSettings
from .plane import makePolygons

__all__ = ['change', 'stepTimes']

seconds, rounds = 0.12, 2
"""Time of timed steps for each change in a round [s], and rounds over all changes: the machine may be busy during one."""
warmUp = 3
"""Steps before them: boxes and the contacts' warm-start data are computed again."""


def change(name, value):
	"""One change of the scene that was loaded."""
	if name == 'trackEnergy':
		O.trackEnergy = value
	elif name == 'verletDist':
		for collider in colliders():
			collider.verletDist = value
	elif name == 'dimension':
		makePolygons()
	else:
		setattr(contactSettings(), name, value)


def load(scene, loads):
	"""The scene, and what its file does not hold: permanent loads, as costs.py has written them."""
	O.load(scene, quiet=True)
	givePermanentLoads({k: (force, torque) for k, force, torque in loads})
	# what writes files or runs scripts belongs to the scene of the user
	O.engines = [engine for engine in O.engines if not isinstance(engine, PeriodicEngine)]


def stepTime(scene, loads, changes):
	"""Time of a step of the scene with these changes [µs]; infinite if it does not run."""
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
	"""Name → time of a step [µs] with that change and those before it in force; '' as the scene is. Without what does not run.

	:param list trials: (name, value)
	:param loads: [body's id, force, torque] of permanent loads
	"""
	plans, times, inForce = {'': []}, {'': stepTime(scene, loads, [])}, []
	for name, value in trials:
		plans[name] = [*inForce, (name, value)]
		times[name] = stepTime(scene, loads, plans[name])
		if times[name] < math.inf:
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
