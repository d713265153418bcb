# SPDX-License-Identifier: GPL-2.0-or-later
"""What a scene pays for without using it, and how much: polytope.check(O, costs=True). Each check yields (what, seen, advice, trial).

Costs are measured by costsProcess.py, on a copy of the scene.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from yade import Polytope, PolytopeCollider, PolytopeGeom

from .. import _builds
from ..scene.permanentLoads import permanentLoads
from ..scene.present import contactSettings, geometryFunctors
from ..scene.radii import inscribedRadius
from ..scene.timeStep import safeTimeStep
from ..scene.vertices import worldVertices
from .plane import dimension
from .steps import usual, yadesDt

__all__ = ['costFindings', 'takeCosts']

reach = 0.1
"""verletDist over the smallest body's inscribed radius that is advised where there is none."""
leastReach = 1e-3
"""verletDist over that radius below which any motion makes the collider run."""
mostPairs = 8
"""Pairs checked for each contact, above which verletDist is too large."""
mostApart = 1 / 3
"""Part of the pairs that tight boxes would not have made, above which it is reported."""
least = 0.05
"""Time step over τ below which steps are many."""
switches = {
	'computeArea': (False, 'no law or material uses it; leave it on if your script reads geom.contactArea'),
	'computeEnergy': (
		False,
		'O.trackEnergy and polytope.mechanicalEnergy do without; leave it on if your script reads geom.energyPerStiffness',
	),
	'timing': (False, 'leave it on if you read lpSeconds and centreSeconds of stats()'),
	'warmStart': (True, 'forces are the same to 1e-5'),
}
"""Setting of the contacts → (value that costs less, why)."""


def costFindings(scene):
	for one in (functorSwitches, energyTracking, verletDist, boxes, dimension, smallStep):
		yield from one(scene)


def functorSwitches(scene):
	settings = contactSettings()
	for name, (cheaper, why) in switches.items() if settings else ():
		if name == 'computeArea' and _contacts(scene) and all(one.geom.needsArea for one in _contacts(scene)):
			continue
		if getattr(settings, name) != cheaper:
			yield name, f'{name} is {not cheaper}', f'{name} = {cheaper}: {why}', (name, cheaper)


def energyTracking(scene):
	if scene.O.trackEnergy:
		yield 'energy tracking', 'O.trackEnergy is on', 'O.trackEnergy = False, unless you read O.energy', ('trackEnergy', False)


def verletDist(scene):
	radii = [inscribedRadius(body.shape) for body in scene.bodies if scene.moves(body)]
	if not scene.colliders or not radii or not min(radii) > 0:
		return
	present, size = float(scene.colliders[0].verletDist), min(radii)
	length = abs(present) * (size if present < 0 else 1)
	pairs, contacts = (sum(functor.stats()[name] for functor in geometryFunctors()) for name in ('pairs', 'contacts'))
	if length > size and (not contacts or pairs > mostPairs * contacts):
		seen = f"verletDist is {length:.3g} m, more than the smallest body's inscribed radius" + (
			f'; {pairs / contacts:.3g} pairs are checked for each contact' if contacts else ''
		)
	elif length < leastReach * size:
		seen = f'verletDist is {length:.3g} m: the collider runs in nearly every step'
	else:
		return
	better = float(f'{reach * size:.2g}')
	yield 'verletDist', seen, f'verletDist = {better:g}', ('verletDist', better)


def boxes(scene):
	"""Boxes of YADE's collider are those of circumscribed balls where bodies can turn."""
	if not scene.colliders or isinstance(scene.colliders[0], PolytopeCollider) or scene.O.periodic:
		return
	room = float(scene.colliders[0].verletDist)
	tight = {body.id: _tightBox(body, room) for body in scene.bodies if isinstance(body.shape, Polytope)}
	pairs = [(tight[one.id1], tight[one.id2]) for one in scene.O.interactions.all() if one.id1 in tight and one.id2 in tight]
	apart = sum(bool(np.any(low1 > high2) or np.any(low2 > high1)) for (low1, high1), (low2, high2) in pairs)
	if apart > mostApart * len(pairs):
		seen = f'boxes are of circumscribed balls where bodies can turn: tight ones of {apart} of {len(pairs)} pairs are apart'
		yield 'boxes', seen, f'PolytopeCollider in place of {type(scene.colliders[0]).__name__}'


def smallStep(scene):
	limit, dt = safeTimeStep() if scene.loops else None, float(scene.O.dt)
	if limit is not None and yadesDt < dt < least * limit:
		seen = f'O.dt is {dt:.3g} s, {dt / float(limit):.2g} of the largest step that is stable for any heap'
		yield (
			'small time step',
			seen,
			f'O.dt = {usual * float(limit):.2g} takes {dt / float(usual * limit):.2g} of the steps, unless a stiffer contact is still to come',
			None,
		)


def _contacts(scene):
	return [one for one in scene.O.interactions if one.isReal and isinstance(one.geom, PolytopeGeom)]


def _tightBox(body, room):
	points = worldVertices(body)
	return points.min(axis=0) - room, points.max(axis=0) + room


def takeCosts(O, found):
	"""Measures what the advice of these findings saves.

	:param Check found: gets the time of a step, its findings their costs, or it says why there are none
	"""
	if not any(one.isReal for one in O.interactions):
		found.notMeasured = 'nothing is in contact now; ask again when bodies touch'
		return
	timed = [finding for finding in found if finding.trial]
	times, found.notMeasured = _stepTimes(O, [finding.trial for finding in timed])
	before = found.stepMicroseconds = times.get('')
	for finding in timed:
		if finding.trial[0] in times:
			finding.cost, before = before - times[finding.trial[0]], times[finding.trial[0]]
	# contacts in space whose bodies hardly move cost less than those of polygons
	found[:] = [one for one in found if one.what != 'third dimension' or one.cost is None or one.cost > 0]


def _stepTimes(O, trials):
	"""(name of a change → time of a step [µs], see costsProcess.stepTimes; why there is none, '' if there is)."""
	try:
		folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
	except OSError as error:
		raise _unwritable('a temporary folder', error) from error
	with folder:
		scene, changes, answers, log = (
			pathlib.Path(folder.name) / name for name in ('scene.yade.bin', 'changes.json', 'answers.json', 'log.txt')
		)
		loads = [[k, [float(x) for x in force], [float(x) for x in torque]] for k, (force, torque) in permanentLoads().items()]
		try:
			O.save(str(scene), quiet=True)
			changes.write_text(json.dumps({'trials': trials, 'loads': loads}))
			file = open(log, 'w')
		except (OSError, RuntimeError) as error:  # YADE's own is a RuntimeError
			raise _unwritable(f'the scene to {scene}', error) from error
		command = [sys.executable, '-P', '-m', 'yade.polytope.check.costsProcess', str(scene), str(changes), str(answers)]
		with file:
			subprocess.run(command, env=_builds.environment(_builds.present()), stdin=subprocess.DEVNULL, stdout=file, stderr=file)
		try:
			times = json.loads(answers.read_text())
		except (OSError, ValueError):
			times = {}
		if '' in times:
			return times, ''
		lines = log.read_text(errors='replace').split('\n')
		return {}, next((line.strip() for line in reversed(lines) if line.strip()), 'the measuring process ended without a message')


def _unwritable(what, error):
	return OSError(f'costs: cannot write {what} ({error}); set TMPDIR to a folder that can be written before Python starts, or costs=False')
