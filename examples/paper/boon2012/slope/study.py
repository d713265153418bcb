# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of simulation E, a slope whose joints do not daylight: limit analysis, critical friction angle, failure, their report."""

import math

import numpy as np
from tqdm import tqdm
from yade import O
from yade.polytope.frictionReduction import FrictionReduction, setFrictionAngle
from yade.polytope.measures.contactTypes import ContactTypes

from .scene import SlumpingSlope
from .theory import criticalFrictionAngle

__all__ = ['Failure', 'SlopeReport', 'SlopeRun', 'prismTypes']

prismTypes = {'edge-edge': 'face–face', 'vertex-edge': 'edge–face', 'vertex-vertex': 'edge–edge'}
"""Names of polygons' contacts → of those of the prisms they stand for."""
sampleSteps = 100
collapse = 1.0
"""Motion at which the record of a failure ends [m]."""
arrestStep = math.radians(0.5)
"""Taken from the friction angle where a failing slope comes to rest before that."""


def blockStates(scene):
	"""(blocks, 3): centre [m] and orientation [rad] of each free block."""
	rows = []
	for body in scene.bodies():
		axis, turn = body.state.ori.toAxisAngle()
		rows.append([body.state.pos[0], body.state.pos[1], axis[2] * turn])
	return np.array(rows)


def queriesFailedNow():
	"""Contact queries without an answer that the present functors count."""
	return sum(functor.stats()['failures'] for functor in O.engines[2].geomDispatcher.functors)


class SlopeRun:
	"""A slope, settled, and its critical friction angle.

	:param given: the options: geometry's polygons as *slope* (see readSlope), density, normal_stiffness, shear_stiffness,
	    stiffness_per_contact, gravity, contact_damping, damping, corner_radius, time_step, contact_point, start, steps,
	    failed_distance, stable_speed, most_steps
	:param str label: for the table of settings and the progress bar
	:param dict protocol: arguments of FrictionReduction that differ from the options
	:param changes: arguments of SlumpingSlope that differ from the options

	:ivar scene: the SlumpingSlope, as it failed
	:ivar result: the FrictionReductionResult, None if there is none
	:ivar str remark: why there is none
	:ivar int failedQueries: contact queries without an answer
	"""

	def __init__(self, given, label, protocol=None, **changes):
		settings = {
			'density': given.density,
			'normalStiffness': given.normal_stiffness,
			'shearStiffness': given.shear_stiffness,
			'stiffnessPerArea': not given.stiffness_per_contact,
			'gravity': given.gravity,
			'contactDamping': given.contact_damping,
			'damping': given.damping,
			'cornerRadius': given.corner_radius,
			'timeStep': given.time_step,
			'contactPoint': given.contact_point,
			'frictionAngle': math.radians(given.start),
		}
		self.label, self.given = label, given
		self.scene = SlumpingSlope(**given.slope, **{**settings, **changes}).build()
		self.protocol = {
			'steps': [math.radians(step) for step in given.steps],
			'stableSpeed': given.stable_speed,
			'failedDistance': given.failed_distance,
			'mostSteps': given.most_steps,
			**(protocol or {}),
		}

	@property
	def longestTimeStep(self):
		"""0.3 sqrt(least mass / normal stiffness), the stiffness being that of 1 m² or of one contact [s]."""
		lightest = min(body.state.mass for body in self.scene.bodies())
		return 0.3 * math.sqrt(lightest / self.scene.normalStiffness)

	def reduce(self):
		"""Finds the critical angle; a scene that does not settle, or stands at any angle, has a *remark* and no *result*."""
		types = ContactTypes(self.scene.cornerRadius)
		with tqdm(desc=self.label, unit=' checks', disable=None) as bar:

			def progress(stage):
				words = f'{math.degrees(stage.level):.2f}°, {1e3 * stage.displacement:.1f} mm, {stage.speed:.0e} m/s'
				bar.set_postfix_str(words, refresh=False)
				bar.update()

			self.reduction = FrictionReduction(
				self.scene.freeIds,
				start=self.scene.frictionAngle,
				checkEvery=sampleSteps,
				measure=lambda: (blockStates(self.scene), types.count()),
				progress=progress,
				**self.protocol,
			)
			self.result, self.remark = None, ''
			try:
				self.result = self.reduction.run()
			except RuntimeError as error:
				self.remark = str(error)
		self.failedQueries = self.result.failedQueries if self.result else self.reduction.failedQueries + queriesFailedNow()
		return self


class Failure:
	"""Lets a slope fail: from the last stable state with the friction at which it failed; whenever it comes to rest, with less.

	Arrays with one row a sample, motions since the slope had settled: time [s], angle (friction) [rad], motion (…, blocks, 3) [m, rad],
	displacement (…, blocks) [m], rotation (…, blocks) counter-clockwise [°], contacts (…, 3): numbers of the types in the order of
	`prismTypes`.

	:param run: a SlopeRun that has a result, in its last stable state; its scene is used up
	:ivar int failed: the first sample in which a block has moved further than the options' failed_distance, else the last
	"""

	def __init__(self, run):
		self.run, given = run, run.given
		self.settled = run.result.stages[0].measured[0]
		self.types = ContactTypes(run.scene.cornerRadius)
		self._samples = []
		angle, calm = run.result.failed, 0
		self._sample(run.result.stable)
		setFrictionAngle(angle)
		with tqdm(total=collapse, desc='failure', bar_format='{desc}: {n:.2f} of {total} m [{elapsed}]', disable=None) as bar:
			for _ in range(3 * given.most_steps // sampleSteps):
				for _ in range(sampleSteps):
					O.step()
				moved, speed = self._sample(angle)
				bar.update(min(moved, collapse) - bar.n)
				if not moved <= collapse:
					break
				calm = calm + 1 if speed < given.stable_speed else 0
				if calm == FrictionReduction.calmChecks:
					angle, calm = max(angle - arrestStep, 0.0), 0
					setFrictionAngle(angle)
		times, angles, motions, contacts = zip(*self._samples, strict=True)
		self.time, self.angle = np.array(times) - times[0], np.array(angles)
		self.motion, self.contacts = np.array(motions), np.array(contacts)
		self.displacement = np.linalg.norm(self.motion[:, :, :2], axis=2)
		self.rotation = np.degrees(self.motion[:, :, 2])
		beyond = self.displacement.max(axis=1) > given.failed_distance
		self.failedQueries = queriesFailedNow()
		self.failed = int(np.argmax(beyond)) if beyond.any() else len(self.time) - 1

	def _sample(self, angle):
		motion = blockStates(self.run.scene) - self.settled
		motion[:, 2] = (motion[:, 2] + np.pi) % (2 * np.pi) - np.pi
		count = self.types.count()
		self._samples.append((O.time, angle, motion, [count[name] for name in prismTypes]))
		speed = max(body.state.vel.norm() for body in self.run.scene.bodies())
		return float(np.linalg.norm(motion[:, :2], axis=1).max()), speed


class SlopeReport:
	"""Rows, tables and texts of the findings.

	:param findings: a Findings
	:param given: the options, with *slope*, and *reference*: whether the geometry is that of the reference
	:param layers: layer of each block, 0 the outermost
	"""

	acceptedAngles = (19, 22.5)
	"""Critical angles that are accepted for the reference geometry [°]: independent programs with vertex springs and of the paper's algorithm failed
	from 19.5° to 21.5°."""
	mostInnerMotion = 0.02
	"""Largest motion of the inner layers when the slope has failed [m]."""
	limitAngle, limitTolerance, limitTogether = 19.75, 0.005, 5
	"""Critical angle of the reference geometry [°], by an independent linear program; so many outer blocks turn as one."""

	def __init__(self, findings, given, layers):
		self.findings, self.given, self.layers = findings, given, layers
		self.layersKnown = given.slope['dip'] is not None and bool(given.slope['spacing'])
		self.outer = np.array(layers) == 0
		heights = np.array([np.mean(corners, axis=0)[1] for corners in given.slope['free']])
		self.outerFromBelow = np.array(sorted(np.flatnonzero(self.outer), key=lambda k: heights[k]))

	def _ifReference(self, value):
		return value if self.given.reference else None

	def introduction(self):
		given = self.given
		per = 'N/m for each contact' if given.stiffness_per_contact else 'Pa/m times the length in contact'
		self.findings.text(
			f'{len(self.layers)} blocks as polygons 1 m thick (true 2-D), base and back fixed. Joints have kₙ = '
			f'{given.normal_stiffness:g} and kₛ = {given.shear_stiffness:g} {per}; the corner radius is {given.corner_radius:g} m. '
			f'Settled at {given.start:g}°; then the friction angle goes down in steps of '
			f'{", ".join(f"{step:g}" for step in given.steps)}°. A state is stable when all blocks are slower than '
			f'{given.stable_speed:g} m/s at three consecutive checks, and has failed when one has moved by more than '
			f'{given.failed_distance:g} m since the slope had settled: such a slope comes to rest again and again after smaller motions.'
		)
		if not self.layersKnown:
			self.findings.text(
				"The geometry's params do not state the dip and the spacing of the bedding. So outer and inner blocks cannot be told "
				'apart: there are no rows on either, and all blocks have the colour of the outer layer.'
			)
		elif self.outer.all():
			self.findings.text('There is one layer only. So there are no rows on inner blocks.')

	def limitAnalysis(self):
		"""Rows of the static theorem; keeps its LimitState in *limit*.

		:raises ValueError: if the blocks cannot stand with any friction
		"""
		free, fixed = self.given.slope['free'], self.given.slope['fixed']
		self.limit = criticalFrictionAngle(free, fixed)
		self.findings.row(
			'critical friction angle, limit analysis',
			math.degrees(self.limit.angle),
			'°',
			theory=self._ifReference(self.limitAngle),
			accept=self._ifReference((self.limitAngle - self.limitTolerance, self.limitAngle + self.limitTolerance)),
			note='static theorem; closed form: an independent linear program',
		)
		self.findings.row(
			'the same if no block could turn',
			math.degrees(criticalFrictionAngle(free, fixed, rotations=False).angle),
			'°',
			theory=self._ifReference(0),
			accept=self._ifReference((0, 0)),
			note='0: there is no translational mechanism even without friction',
		)
		moving = np.abs(self.limit.velocities).max(axis=1) > 1e-6
		if not self.outer.all():
			self.findings.row(
				'mechanism: inner blocks that move',
				int(np.count_nonzero(moving & ~self.outer)),
				'',
				theory=self._ifReference(0),
				accept=self._ifReference((0, 0)),
			)
		if self.layersKnown:
			spins = self.limit.velocities[self.outerFromBelow, 2]
			together = 0
			while together < len(spins) and abs(spins[together] - spins[0]) < 1e-6 * abs(spins[0]):
				together += 1
			over = ', '.join(f'{spin / spins[0]:.3f}' for spin in spins) if spins[0] else 'none'
			backward = 'clockwise, that is backward' if (spins <= 0).all() else 'not all of them clockwise'
			self.findings.row(
				'mechanism: lowest outer blocks that turn as one',
				together,
				'',
				theory=self._ifReference(self.limitTogether),
				accept=self._ifReference((self.limitTogether, self.limitTogether)),
				note=f'spins of the outer layer over the lowest one, from below: {over}; {backward}',
			)

	def criticalAngle(self, run):
		result = run.result
		self.findings.row(
			'critical friction angle',
			math.degrees(result.critical),
			'°',
			theory=math.degrees(self.limit.angle),
			accept=self._ifReference(self.acceptedAngles),
			note=f'stands at {math.degrees(result.stable):.3f}°, fails at {math.degrees(result.failed):.3f}°; '
			'closed form: limit analysis of sharp rigid blocks',
		)

	def mode(self, failure):
		"""How the blocks have moved when the slope has failed."""
		turned, moved = failure.rotation[failure.failed], failure.displacement[failure.failed]
		if self.layersKnown:
			lower = self.outerFromBelow[: self.limitTogether]
			self.findings.row(
				f'least backward rotation of the lowest {len(lower)} outer blocks at failure',
				-turned[lower].max(),
				'°',
				accept=self._ifReference((1e-3, 90)),
				note='clockwise, the face being on the left; of all outer blocks from below: '
				+ ', '.join(f'{-turn:.3f}' for turn in turned[self.outerFromBelow]),
			)
			self.findings.row(
				'their largest difference', float(np.ptp(turned[lower])), '°', note='0 if they turn as one, as in the limit analysis'
			)
		if not self.outer.all():
			self.findings.row('largest rotation of an inner block at failure', float(np.abs(turned[~self.outer]).max()), '°')
			self.findings.row(
				'largest motion of an inner block at failure',
				float(moved[~self.outer].max()),
				'm',
				accept=self._ifReference((0, self.mostInnerMotion)),
			)
		motion = failure.motion[failure.failed]
		self.findings.row(
			'likeness of motion and mechanism of the limit analysis',
			_cosine(motion, self.limit.velocities),
			'-',
			theory=1,
			note='cosine of the vectors of all velocities and spins; in the analysis joints part by tan φ of what they slide',
		)
		self.findings.row('the same of the rotations alone', _cosine(motion[:, 2], self.limit.velocities[:, 2]), '-', theory=1)

	def contacts(self, failure):
		for name, counts in zip(prismTypes.values(), failure.contacts.T, strict=True):
			self.findings.row(f'{name} contacts before failure', int(counts[0]), '', note=f'{counts.min()} … {counts.max()} while it fails')

	def failedQueries(self, name, number):
		self.findings.row(name, number, '', theory=0, accept=(0, 0))

	def tables(self, run, failure):
		self.findings.table(
			'stages',
			'The friction reduction, with the numbers of contacts at the end of each stage. The first stage is the settling.',
			[
				'friction angle [°]',
				'outcome',
				'time [s]',
				'largest motion since settling [mm]',
				'largest speed at the end [m/s]',
				*prismTypes.values(),
			],
			[
				[_degrees(stage.level), stage.outcome, stage.steps * run.scene.timeStep, 1e3 * stage.displacement, stage.speed]
				+ [stage.measured[1][name] for name in prismTypes]
				for stage in run.result.stages
			],
		)
		largest = failure.displacement.max(axis=1).tolist()
		self.findings.table(
			'contacts',
			'Contacts by type while the slope fails.',
			['time [s]', 'friction angle [°]', 'largest motion [m]', *prismTypes.values()],
			[
				[time, _degrees(angle), most, *numbers]
				for time, angle, most, numbers in zip(failure.time, failure.angle, largest, failure.contacts.tolist(), strict=True)
			],
		)
		motion = failure.motion[failure.failed]
		self.findings.table(
			'blocks',
			'Each block when the slope has failed, and in the limit analysis (velocities over that of the fastest corner).',
			['block', 'layer', 'motion x [mm]', 'motion y [mm]', 'rotation [°]', 'analysis: x', 'analysis: y', 'analysis: spin [1/m]'],
			[
				[k, layer, *(1e3 * motion[k, :2]), math.degrees(motion[k, 2]), *self.limit.velocities[k]]
				for k, layer in enumerate(self.layers)
			],
		)

	def settings(self, runs):
		"""The critical angle with other settings, and the limit analysis with joints whose ends are worn off by the corner radius."""
		worn = {
			radius: math.degrees(
				criticalFrictionAngle(self.given.slope['free'], self.given.slope['fixed'], inset=radius, tolerance=1e-6).angle
			)
			for radius in sorted({run.scene.cornerRadius for run in runs})
		}
		brackets = [(_degrees(run.result.failed), _degrees(run.result.stable)) if run.result else ('', '') for run in runs]
		self.findings.table(
			'settings',
			'Other settings. Beside them a limit analysis in which forces keep the corner radius away from the ends of joints.',
			[
				'setting',
				'fails at [°]',
				'stands at [°]',
				'limit analysis, corners worn off [°]',
				'contact queries without an answer',
				'remark',
			],
			[
				[run.label, *bracket, worn[run.scene.cornerRadius], run.failedQueries, run.remark]
				for run, bracket in zip(runs, brackets, strict=True)
			],
		)
		radii = {}
		for run, bracket in zip(runs, brackets, strict=True):
			if run.result and (run.label.startswith('corner radius') or not radii):
				radii[run.scene.cornerRadius] = bracket
		self.findings.text(
			'Why the blocks do not fail at the angle of the limit analysis: its blocks have sharp corners, can load each other at the '
			'very ends of their joints, and count as failed when they begin to move. The rounding of the corners by r keeps the forces '
			'away from the ends: '
			+ '; '.join(
				f'r = {radius:g} m: {low:g}…{high:g}° (analysis with ends worn off by r: {worn[radius]:.2f}°)'
				for radius, (low, high) in sorted(radii.items())
			)
			+ f'. That the slope must move by {self.given.failed_distance:g} m to count as failed lowers the angle, as the blocks come '
			'to rest again '
			'after smaller motions: see the row with failure at a fifth of that.'
		)


def _cosine(a, b):
	return float(np.sum(a * b) / max(np.linalg.norm(a) * np.linalg.norm(b), 1e-300))


def _degrees(angle):
	return round(math.degrees(angle), 6)
