# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of simulation F, one block that falls onto another: contact types, jumps, budgets of momentum and energy, their report."""

import math

import numpy as np
from tqdm import trange
from yade import O
from yade.polytope.motionRecord import MotionRecord, noContact

from .scene import Collision, readBlocks

__all__ = ['CollisionReport', 'CollisionRun', 'durations', 'labels']

labels = {'vertexFace': 'F1', 'edgeEdge': 'F2'}
durations = {'vertexFace': 2.6, 'edgeEdge': 1.8}
"""[s]"""
sampleSteps = 200
"""Steps between two samples of the energy."""
riseElsewhere = {'F1': 0.0041, 'F2': 3730}
"""Largest rise of energy between such samples in an independent program of the paper's algorithm, which has no shear damper, at the
reference's settings [J]."""
riseWithoutDamping = {20: 1894.038, 200: 9256.513}
"""Steps → largest rise of F2's energy in any so many steps in that program, with a normal damper alone and no damping of YADE's [J]."""
noticeable = 1e-3
"""Rises of energy below this are not listed [J]."""
aroundTransition = 60
"""Steps before and after a change of type in which jumps are searched for."""


class CollisionRun:
	"""One collision, recorded in every step.

	:param given: the options: geometry, density, normal_stiffness, shear_stiffness, friction, contact_damping, damping, damp_gravity,
	    gravity, corner_radius, time_step, contact_point
	:param str name: 'vertexFace' or 'edgeEdge'
	:param changes: arguments of Collision that differ from the options

	:ivar scene: the Collision
	:ivar record: the MotionRecord
	:ivar int failures: contact queries without an answer
	"""

	def __init__(self, given, name, **changes):
		settings = {
			'density': given.density,
			'normalStiffness': given.normal_stiffness,
			'shearStiffness': given.shear_stiffness,
			'frictionCoefficient': given.friction,
			'contactDamping': given.contact_damping,
			'damping': given.damping,
			'dampGravity': given.damp_gravity,
			'gravity': given.gravity,
			'cornerRadius': given.corner_radius,
			'timeStep': given.time_step,
			'contactPoint': given.contact_point,
		}
		self.name, self.label, self.changes = name, labels[name], changes
		self.words = ', '.join(f'{key} {value:g}' if isinstance(value, float) else f'{key} {value}' for key, value in changes.items())
		self.scene = Collision(*readBlocks(given.geometry, name), **{**settings, **changes}).build()
		self.record = MotionRecord(self.scene.body, self.scene.contact, self.scene.integrator)
		for _ in trange(math.ceil(durations[name] / O.dt), desc=f'{self.label} {self.words}', unit=' steps', disable=None):
			self.record.step()
		self.record.finish()
		self.failures = self.scene.geometryFunctor.stats()['failures']

	def phases(self):
		"""[(first step, last step + 1, type)] of equal types in a row."""
		types = self.record.type
		starts = np.flatnonzero(np.r_[True, types[1:] != types[:-1]])
		return list(zip(starts.tolist(), [*starts[1:].tolist(), len(types)], types[starts].tolist(), strict=True))

	def firstTimes(self):
		"""{type: time of its first appearance [s]}, in order."""
		first = {}
		for begin, _, kind in self.phases():
			if kind != noContact:
				first.setdefault(kind, float(self.record.time[begin]))
		return first

	def jumps(self):
		"""Change of contact point [mm], normal [°] and contact force [kN] from the step before; point and normal are NaN without a
		contact before or now."""
		record = self.record

		def change(vectors):
			return np.r_[np.nan, np.linalg.norm(np.diff(vectors, axis=0), axis=1)]

		turn = np.degrees(2 * np.arcsin(np.minimum(change(record.normal) / 2, 1)))
		return 1e3 * change(record.point), turn, 1e-3 * change(record.contactForce)

	def transitions(self):
		"""[(step, type before, type after)]"""
		phases = self.phases()
		return [(begin, before, after) for (_, _, before), (begin, _, after) in zip(phases, phases[1:], strict=False)]

	def flightError(self):
		"""Largest change of energy in free flight, with what the integrator's damping took, over the energy at the start [-]."""
		energy = self.record.energy() + self.record.dampingLoss()
		flights = [slice(begin, end) for begin, end, kind in self.phases() if kind == noContact]
		return max((float(np.ptp(energy[flight])) for flight in flights), default=0.0) / energy[0]

	def largestRise(self, every=sampleSteps):
		"""Largest rise between two samples (of kinetic + potential + elastic, of kinetic + potential energy) [J]."""
		motion = self.record.kineticEnergy() + self.record.potentialEnergy()
		return tuple(float(np.diff(values[::every]).max(initial=0)) for values in (self.record.energy(), motion))

	def largestRiseIn(self, steps):
		"""Largest rise of kinetic + potential + elastic energy in any so many steps [J]; that between samples depends on where they lie."""
		energy = self.record.energy()
		return float((energy[steps:] - energy[:-steps]).max(initial=0))

	def rises(self):
		"""Every stretch of steps in which kinetic + potential + elastic energy rises without a break by `noticeable` or more."""
		energy = self.record.energy()
		up = np.r_[False, np.diff(energy) > 0, False]
		stretches = zip(np.flatnonzero(~up[:-1] & up[1:]), np.flatnonzero(up[:-1] & ~up[1:]), strict=True)
		return [Rise(self.record, begin, end) for begin, end in stretches if energy[end] - energy[begin] >= noticeable]

	def rest(self):
		"""(height of the centre [m], energy [J], body axis that points down, its cosine with the vertical).

		Height and energy by the closed form: at rest on a level floor, with the face that is down at the end flat on it.
		"""
		w, x, y, z = self.record.orientation[-1]
		vertical = np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])  # in the body's frame
		axis = int(np.abs(vertical).argmax())
		weight = self.record.mass * self.scene.gravity
		sink = weight / self.scene.normalStiffness
		height = self.scene.fixed.position[2] + self.scene.fixed.halfLengths[2] + self.scene.free.halfLengths[axis] - sink
		return height, weight * (height + sink / 2), ('−' if vertical[axis] > 0 else '+') + 'xyz'[axis], abs(float(vertical[axis]))


class Rise:
	"""Energy rises from step *begin* to step *end*: what rose, its source, and the losses [J]."""

	def __init__(self, record, begin, end):
		def change(values):
			return float(values[end] - values[begin])

		self.begin, self.end = begin, end
		self.time = float(record.time[begin]), float(record.time[end])
		self.types = ' '.join(sorted(set(record.type[begin : end + 1]) - {noContact}))
		self.total = change(record.energy())
		self.motion = change(record.kineticEnergy() + record.potentialEnergy())
		self.elastic = change(record.elasticEnergy())
		self.given = change(record.made())
		self.taken = change(record.contactLoss()) + change(record.dampingLoss())
		self.unexplained = self.total - self.given + self.taken
		self.depth = 1e3 * float(record.depth[begin]), 1e3 * float(record.depth[end])
		self.approach = 1e3 * change(record.approach())

	@property
	def cause(self):
		if self.motion <= 0:
			return 'depth grows though no work is done'
		return 'force does more work than the spring had' if self.elastic <= 0 else 'both: depth grows, and force does work'

	columns = (
		'from [s]',
		'to [s]',
		'contact types',
		'rise',
		'kinetic + potential',
		'elastic',
		'made by the normal spring',
		'taken by friction and all dampers',
		'unexplained',
		'depth before [mm]',
		'after [mm]',
		'approach along the normal [mm]',
		'cause',
	)

	def row(self):
		energies = self.total, self.motion, self.elastic, self.given, self.taken, self.unexplained
		return [*self.time, self.types, *energies, *self.depth, self.approach, self.cause]


class CollisionReport:
	"""Rows, tables and texts of the findings.

	:param findings: a Findings
	:param given: the options, with *reference*: whether all are as by default
	"""

	budgetTolerance = 1e-6
	"""The following are over the energy at the start [-]."""
	flightTolerance = 1e-9
	bookTolerance = 1e-7
	"""Measured 3e-8: a shear force that turns with the contact is compared with one that is projected."""
	fallTolerance = 1e-6
	"""Measured 1.5e-7: over a change of sign of the speed the mean of the forces is not that at its zero."""
	heightTolerance, energyTolerance = 1e-5, 0.01
	"""[m], [J]"""
	restingPlace, restingDistance = (0.472, 0.518), 0.1
	"""Where F1 comes to rest, by an independent small program of the paper's algorithm [m]; another contact model (overlap volume) gave
	(0.482, 0.531)."""
	independent = {
		'vertexFace': 'vertex 0.018 s, edge 1.02 s, face 1.76…2.03 s',
		'edgeEdge': 'edge–edge 0.018 s, edge on face 1.01 s, parting ≈ 1.7 s',
	}
	"""Times that program gave."""
	order = {'vertexFace': ['vertex-face', 'edge-face', 'face-face'], 'edgeEdge': ['edge-edge', 'edge-face']}
	independentTolerance = 1e-4
	"""Measured 2e-5: orientations in the geometry's file have ten digits."""
	gap = 1e-3
	"""Height through which the reference blocks fall until they touch [m]."""

	def __init__(self, findings, given):
		self.findings, self.given = findings, given

	def introduction(self):
		given = self.given
		self.findings.text(
			f'Blocks of {given.density:g} kg/m³; at the contact kₙ = {given.normal_stiffness:g} N/m, kₛ = {given.shear_stiffness:g} N/m, '
			f'friction coefficient {given.friction:g}, {given.contact_damping:g} of critical damping; YADE damping {given.damping:g}, '
			f'time step {given.time_step:g} s. Contact types are named by the faces of each block within the corner radius of the '
			"contact point (yade.polytope.measures.contactTypes). YADE's damping takes a fraction of every component of the resultant of contact "
			'force and gravity, in free flight too; the budgets count it, and a run without it satisfies Δ(m v) = ∫F dt + m g t with '
			'the contact force alone.'
		)

	def _ifReference(self, accept):
		return accept if self.given.reference else None

	def sequence(self, run):
		"""First touch and order of the types."""
		given, first = self.given, run.firstTimes()
		fall = math.sqrt(2 * self.gap / (given.gravity * (1 - given.damping if given.damp_gravity else 1)))
		self.findings.row(
			f'{run.label}: first touch',
			min(first.values(), default=math.nan),
			's',
			theory=fall if given.reference else None,
			accept=self._ifReference((fall - given.time_step, fall + 2 * given.time_step)),
			note="free fall by 1 mm under 0.7 g: YADE's damping acts on gravity" if given.reference else '',
		)
		wanted = self.order[run.name]
		self.findings.row(
			f'{run.label}: {", ".join(wanted)} come in this order',
			int([kind for kind in first if kind in wanted] == wanted),
			'1: yes',
			theory=1 if given.reference else None,
			accept=self._ifReference((1, 1)),
			note='first appearances: '
			+ ', '.join(f'{kind} {time:.3f} s' for kind, time in first.items())
			+ f'; an independent program of the same algorithm: {self.independent[run.name]}',
		)

	def atRest(self, run):
		"""Where and how the block of F1 lies, and its energy."""
		given, record, label = self.given, run.record, run.label
		height, energy, down, cosine = run.rest()
		x, y, z = record.position[-1]
		held = given.damp_gravity or given.damping == 0
		self.findings.row(
			f'{label}: height at rest',
			z,
			'm',
			theory=height,
			accept=(height - self.heightTolerance, height + self.heightTolerance) if held else None,
			note='½ − m g/kₙ'
			if held
			else "YADE's damping, which spares gravity here, takes its fraction of the contact force even at rest",
		)
		self.findings.row(
			f'{label}: lies on its face −z',
			int(down == '−z' and cosine > 1 - 1e-6),
			'1: yes',
			theory=1 if given.reference else None,
			accept=self._ifReference((1, 1)),
			note=f'face {down} down, cosine with the vertical 1 − {1 - cosine:.1e}',
		)
		self.findings.row(
			f'{label}: place of rest, distance from {self.restingPlace}',
			math.dist((x, y), self.restingPlace),
			'm',
			accept=self._ifReference((0, self.restingDistance)),
			note=f'at ({x:.4f}, {y:.4f}); an independent program of the same algorithm rests at {self.restingPlace}, '
			'one with another contact model at (0.482, 0.531)',
		)
		start = record.mass * given.gravity * run.scene.free.position[2]
		self.findings.row(
			f'{label}: energy at the start',
			record.energy()[0],
			'J',
			theory=start,
			accept=(start - self.energyTolerance, start + self.energyTolerance) if record.type[0] == noContact else None,
			note='m g z',
		)
		self.findings.row(
			f'{label}: energy at the end',
			record.energy()[-1],
			'J',
			theory=energy,
			accept=self._ifReference((energy - self.energyTolerance, energy + self.energyTolerance)),
			note='m g (½ − m g/kₙ) + (m g)²/2kₙ; with other settings friction may lock in shear, and its energy',
		)

	def parting(self, run):
		begin, _, kind = run.phases()[-1]
		self.findings.row(
			f'{run.label}: the blocks part',
			run.record.time[begin] if kind == noContact else math.nan,
			's',
			accept=self._ifReference((1.5, 1.9)),
			note='an independent program of the same algorithm: ≈ 1.7 s',
		)

	def budgets(self, run, words=''):
		"""Momentum, free flight, energy; *words* tells the run from the one as given."""
		record, label = run.record, run.label
		self.findings.row(
			f'{label}: momentum budget{words}',
			record.momentumError(),
			'-',
			theory=0,
			accept=(0, self.budgetTolerance),
			note='largest |Δ(m v) − ∫F dt − m g t| over ∫|F| dt + m g t; F is the contact force'
			+ (", with what YADE's damping adds to it" if record.damping else ''),
		)
		self.findings.row(
			f'{label}: energy in free flight{words}',
			run.flightError(),
			'-',
			theory=0,
			accept=(0, self.flightTolerance),
			note='largest change over the energy at the start' + ("; what YADE's damping takes is counted" if record.damping else ''),
		)
		self.findings.row(
			f'{label}: energy balance{words}',
			np.abs(record.balance()).max() / record.energy()[0],
			'-',
			theory=0,
			accept=(0, self.budgetTolerance),
			note='largest |energy + losses − what the normal spring made − start| over the start; kinetic and potential from the states, springs '
			'from overlap and shear force, losses from the work of the force',
		)
		errors = record.bookError()
		self.findings.row(
			f"{label}: law's own account of energy{words}",
			max(errors.values()) / record.energy()[0],
			'-',
			theory=0,
			accept=(0, self.bookTolerance),
			note='largest difference to the one from states, geometry and forces over the energy at the start; '
			+ ', '.join(f'{name} {error:.2g} J' for name, error in errors.items()),
		)
		self.findings.row(
			f'{label}: energy that dampers and friction give{words}',
			max(largestFall(record.normalLoss()), largestFall(record.shearLoss())) / record.energy()[0],
			'-',
			theory=0,
			accept=(0, self.fallTolerance),
			note='largest fall of what they have taken, over the energy at the start',
		)
		rise, motion = run.largestRise()
		self.findings.row(
			f'{label}: largest rise of energy in {sampleSteps} steps{words}',
			rise,
			'J',
			note=f'of kinetic and potential energy alone {motion:.3g} J; an independent program without shear damper: {riseElsewhere[label]:g} J',
		)

	def besideIndependent(self, run):
		"""The run that the independent program made, too: step by step both agree to 1e-9 of a metre, a turn and a radian per second."""
		for steps, theirs in riseWithoutDamping.items():
			self.findings.row(
				f'{run.label}: largest rise of energy in any {steps} steps, normal damper alone',
				run.largestRiseIn(steps),
				'J',
				theory=theirs,
				accept=(theirs * (1 - self.independentTolerance), theirs * (1 + self.independentTolerance)),
				note="an independent program of the paper's algorithm; YADE's damping 0 in both",
			)

	def jumps(self, run):
		names = {'jump of the contact point': 'mm', 'turn of the normal': '°', 'change of the contact force': 'kN'}
		for (name, unit), values in zip(names.items(), run.jumps(), strict=True):
			self.findings.row(
				f'{run.label}: largest {name} in a step', _largest(values), unit, note='where an edge or a face lands, within few steps'
			)

	def failures(self, runs):
		self.findings.row('contact queries without an answer', sum(run.failures for run in runs), '', theory=0, accept=(0, 0))

	def transitionTable(self, runs):
		rows = []
		for run in runs:
			changes = run.jumps()
			for begin, before, after in run.transitions():
				window = slice(max(begin - aroundTransition, 0), begin + aroundTransition)
				near, there = ([_largest(values[part]) for values in changes] for part in (window, slice(begin, begin + 1)))
				rows.append([run.label, run.record.time[begin], before, after, *near, *there])
		self.findings.table(
			'transitions',
			f'Every change of contact type, with the largest changes in a step within {aroundTransition} steps of it, and in the very '
			'step.',
			['collision', 'time [s]', 'from', 'to', 'point [mm]', 'normal [°]', 'force [kN]']
			+ ['in the step: point [mm]', 'in the step: normal [°]', 'in the step: force [kN]'],
			rows,
		)

	def energyRises(self, runs):
		"""Every rise of energy, with its cause; their budgets must close."""
		rises = {run: run.rises() for run in runs}
		for run, ofRun in rises.items():
			self.findings.text(_explanation(run, ofRun))
		self.findings.table(
			'energy_rises',
			f'Every rise of kinetic + potential + elastic energy by {noticeable:g} J or more: what rose, its source, and the losses [J].',
			['collision', *Rise.columns],
			[[run.label, *rise.row()] for run, ofRun in rises.items() for rise in ofRun],
		)
		self.findings.row(
			'largest part of a rise of energy without a cause',
			max((abs(rise.unexplained) for ofRun in rises.values() for rise in ofRun), default=0.0),
			'J',
			theory=0,
			accept=(0, self.budgetTolerance * max(run.record.energy()[0] for run in runs)),
			note='rise less what the normal spring made, plus losses',
		)

	def settings(self, runs):
		"""A table of runs with other settings."""
		rows = []
		for run in runs:
			begin, _, kind = run.phases()[-1]
			samples = round(sampleSteps * self.given.time_step / run.record.timeStep)  # at the same times
			rows.append(
				[run.label, run.words or 'as given', run.firstTimes().get('edge-face', ''), kind, run.record.time[begin]]
				+ [*run.record.position[-1], run.rest()[2] if run.name == 'vertexFace' else '']
				+ [*run.largestRise(samples), *(_largest(values) for values in run.jumps())]
			)
		self.findings.table(
			'settings',
			f'Other settings. Rises of energy are those in {sampleSteps} steps as given; the last columns are the largest changes in '
			'one step.',
			[
				'collision',
				'setting',
				'first edge-face [s]',
				'last type',
				'since [s]',
				'x at the end [m]',
				'y at the end [m]',
				'z at the end [m]',
			]
			+ ['face down', 'largest rise of energy [J]', 'of kinetic + potential [J]', 'point [mm]', 'normal [°]', 'force [kN]'],
			rows,
		)


def largestFall(values):
	"""Largest fall of a quantity that ought never to fall."""
	return float((np.maximum.accumulate(values) - values).max())


def _largest(values):
	return float(np.nanmax(values)) if np.isfinite(values).any() else ''


def _explanation(run, rises):
	"""Causes of the rises of energy, with this run's figures."""
	if not rises:
		return f'{run.label}: the energy never rises by {noticeable:g} J or more.'
	record = run.record
	most = max(rises, key=lambda rise: rise.total)
	stretch = slice(most.begin, most.end + 1)
	spring = 1e-3 * run.scene.normalStiffness * np.nanmax(record.depth[stretch])
	force = 1e-3 * np.linalg.norm(record.contactForce[stretch], axis=1).max()
	way = f'come {most.approach:.3g} mm closer' if most.approach > 0 else f'part by {-most.approach:.3g} mm'
	return (
		f'{run.label}: kinetic + potential + elastic energy rises in {len(rises)} stretch{"es" if len(rises) > 1 else ""}, by '
		f'{sum(rise.total for rise in rises):.4g} J together. The largest rise, {most.total:.4g} J from {most.time[0]:.4f} to '
		f'{most.time[1]:.4f} s ({most.types}): the depth goes from {most.depth[0]:.4g} to {most.depth[1]:.4g} mm, while the blocks {way} '
		f'along the normal at the contact point. Elastic energy changes by {most.elastic:+.4g} J, kinetic + potential by '
		f'{most.motion:+.4g} J. The normal spring makes {most.given:.4g} J, dampers and friction take {most.taken:.4g} J; '
		f"{most.unexplained:+.1e} J are left unexplained. The spring's force alone would be up to {spring:.4g} kN; with the dashpot's at "
		f'most {force:.3g} kN act. Cause: the force kₙ δ n is not the gradient of the stored energy ½ kₙ δ². The chord δ along the '
		'averaged normal grows by more than the blocks approach each other along it, as the contact point moves and the normal turns; '
		'the spring then stores energy without work being done on it, and the dashpot dissipates what the spring returns.'
	)
