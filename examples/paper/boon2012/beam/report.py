# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows, tables, figures and explanations of simulation B, the three-hinged beam."""

import math

from ..solverTimes import hasSolver
from .plots import drawBeam, plotCurves
from .study import contactPointNames, solverNames

__all__ = ['BeamReport', 'noIpopt']

noIpopt = 'This build has no Ipopt: the curve of the analytic centre by Ipopt and its row are missing.'


class BeamReport:
	"""Reports the results of a BeamStudy, one part after the other.

	:param Findings findings: where it goes
	:param BeamStudy study: after its runs
	:param bool holds: whether theory holds for the options; otherwise differences from it are shown without being judged
	:param dict tolerances: relative ones, by contact point: of loads and rotations against theory, and of their changes
	"""

	def __init__(self, findings, study, holds, tolerances):
		self.findings, self.study, self.holds, self.tolerances = findings, study, holds, tolerances
		self.given, self.closed = study.given, study.appendixA

	def within(self, quantity, ours, theory, unit, tolerance, note=''):
		"""A row that must be within a relative tolerance of theory, where theory holds."""
		accept = (theory - tolerance * abs(theory), theory + tolerance * abs(theory)) if self.holds else None
		self.findings.row(quantity, ours, unit, theory=theory, accept=accept, note=note)

	def deviation(self, quantity, percent, tolerance, note=''):
		"""A row of a difference from theory, where theory holds within the tolerance."""
		self.findings.row(quantity, percent, '%', theory=0, accept=(0, 100 * tolerance) if self.holds else None, note=note)

	def change(self, quantity, percent, tolerance, note=''):
		"""A row of a change of the result that must be small, whatever the settings."""
		self.findings.row(quantity, percent, '%', theory=0, accept=(-100 * tolerance, 100 * tolerance), note=note)

	def curves(self, curves, solverTolerance):
		"""Rotation imposed, statics.

		:param list curves: BeamCurves
		:param float solverTolerance: of Newton's loads against Ipopt's, over the peak
		"""
		self.found = {(curve.contactPoint, curve.solver): curve for curve in curves}
		end = math.degrees(self.closed.alignment)
		self.findings.row("Goodman's criterion: rotation with the hinges in one line", end, '°', theory=end, note='closed form')
		if ('centroid', 'newton') in self.found:
			self._centroid(self.found['centroid', 'newton'])
		if ('analyticCentre', 'newton') in self.found:
			self._analyticCentre(self.found['analyticCentre', 'newton'])
			if ('analyticCentre', 'ipopt') in self.found:
				self._solvers(self.found['analyticCentre', 'newton'], self.found['analyticCentre', 'ipopt'], solverTolerance)
			elif not hasSolver('ipopt'):
				self._text(noIpopt)
		columns = ['contact point', 'solver', 'load (N)', 'rotation (°)', 'drop at midspan (mm)', 'thrust (kN)', 'lever (mm)']
		columns += ['load with the true arm (N)', 'work up to it (J)', 'energy stored (J)', 'load is zero at (°)']
		caption = 'At the peak, rotation imposed. Work and energy are those of one half-beam.'
		self.findings.table('peaks', caption, columns, [_peakRow(curve) for curve in curves])

	def _centroid(self, curve):
		closed, peak, tolerance = self.closed, curve.peak, self.tolerances['centroid']
		load, rotation = closed.peak()
		apart = [(abs(reading.load - theory), abs(theory)) for reading in curve.readings for theory in [closed.load(reading.rotation)]]
		self.within('centroid: peak load', peak.load, load, 'N', tolerance)
		self.within('centroid: rotation at the peak', math.degrees(peak.rotation), math.degrees(rotation), '°', tolerance)
		where = 'of the load at the same rotation, at {} rotations from {:g} to {:g}°; at most {:.1e} N'
		self.deviation(
			'centroid: largest deviation from the closed form along the curve',
			max(100 * difference / value for difference, value in apart),
			tolerance,
			note=where.format(len(apart), *self.given.rotations, max(apart)[0]),
		)
		for what, ours, theory, unit in (
			('thrust at the peak', peak.thrust / 1e3, closed.thrust(rotation) / 1e3, 'kN'),
			('lever of the thrusts at the peak', 1e3 * peak.lever, 1e3 * closed.lever(rotation), 'mm'),
			('drop at midspan at the peak', 1e3 * peak.drop, 1e3 * closed.drop(rotation), 'mm'),
			('rotation with the load back to zero', math.degrees(curve.exhaustion), math.degrees(closed.exhaustion()), '°'),
			('work up to the peak', curve.work, closed.work(rotation), 'J'),
			('energy stored at the peak', peak.stored, closed.stored(rotation), 'J'),
		):
			note = 'more than the work: not the gradient of an energy' if 'stored' in what else ''
			self.within(f'centroid: {what}', ours, theory, unit, tolerance, note)

	def _analyticCentre(self, curve):
		load, rotation = self.study.twoBlocks.peak()
		note = 'in place of a closed form: an independent program for the same planes, in exact symmetry'
		title = f'analytic centre, abutments of {self.given.abutment_height:g} block heights'
		tolerance, ours = self.tolerances['analyticCentre'], curve.peak
		self.within(f'{title}: peak load', ours.load, load, 'N', tolerance, note)
		self.within(f'{title}: rotation at the peak', math.degrees(ours.rotation), math.degrees(rotation), '°', tolerance, note)

	def _solvers(self, newton, ipopt, tolerance):
		pairs = [(a.load, b.load) for a, b in zip(newton.readings, ipopt.readings, strict=True)]
		self.findings.row(
			'analytic centre: Newton against Ipopt, largest difference of loads over the peak',
			max(abs(a - b) for a, b in pairs) / newton.peak.load,
			theory=0,
			accept=(0, tolerance),
			note=f'over the load at the same rotation: {max(abs(a / b - 1) for a, b in pairs):.1e}',
		)

	def dynamics(self, driven, pushed):
		"""The rotation at a rate, and the weight; the first run with each contact point is the one that the others change.

		:param list driven, pushed: DrivenBeams, PushedBeams
		"""
		self.rises, self.pushes, turnedRows, pushedRows = [], {}, [], []
		for point in dict.fromkeys(run.contactPoint for run in driven):
			turnedRows += self._driven(point, [run for run in driven if run.contactPoint == point])
			pushedRows += self._pushed(point, [run for run in pushed if run.contactPoint == point])
		columns = ['contact point', 'run', 'largest load (N)', 'rotation (°)', 'against theory (%)', 'change (%)']
		caption = 'Half-beams turned at a constant rate, to half as far again as the peak. Loads over the factor on the stiffness.'
		self.findings.table('driven', caption, columns + ['deviation along the curve (% of the peak)'], turnedRows)
		columns = ['contact point', 'run', 'weight held (N)', 'snapped through at (N)', 'against theory (%)', 'change (%)']
		caption = 'Weight of the half-beams raised until they snap through. Weights over the factor on the stiffness.'
		self.findings.table('pushed', caption, columns + ['last rotation at rest (°)'], pushedRows)
		if self.pushes:
			limit = math.tan(math.radians(self.given.friction_angle))
			slip = max(reading.shearRatio for readings in self.pushes.values() for reading in readings)
			title, note = 'load imposed: shear over normal force at the abutment', f'slips at {limit:.4g}'
			self.findings.row(title, slip, accept=(0, 0.999 * limit), note=note)

	def _driven(self, point, runs):
		base, name, tolerance, (top, _) = runs[0], contactPointNames[point], self.tolerances[point], self.study.theory[point].peak()
		self.rises.append(base.rise)
		title = f'{name}, turned at a rate'
		self.deviation(f'{title}: largest deviation from theory over the peak', 100 * base.deviation, tolerance)
		for run in runs:
			changed = 100 * (run.peak / base.peak - 1)
			if run is not base:
				self.change(f'{title}: change of the peak, {run.label}', changed, tolerance)
			against = f'{100 * (run.peak / top - 1):+.4f}'
			yield [name, run.label, f'{run.peak:.1f}', _degrees(run.rotation), against, f'{changed:+.4f}', f'{100 * run.deviation:.4f}']

	def _pushed(self, point, runs):
		base, name, tolerance = runs[0], contactPointNames[point], self.tolerances[point]
		top, _ = self.study.theory[point].peak(trueArm=True)
		self.pushes[point] = base.readings
		title = f'{name}, load imposed'
		note = f'theory with the true arm, L₁/2 + δ/3; snapped through at {base.snapped:.1f} N'
		self.within(f'{title}: weight held', base.held, top, 'N', tolerance, note)
		for run in runs:
			changed = 100 * (run.held / base.held - 1)
			if run is not base:
				note = f'weights tried are {100 * (run.snapped / run.held - 1):.2g} % apart'
				self.change(f'{title}: change of the weight held, {run.label}', changed, tolerance, note)
			against, rotation = f'{100 * (run.held / top - 1):+.3f}', _degrees(run.readings[-1].rotation)
			yield [name, run.label, f'{run.held:.1f}', f'{run.snapped:.1f}', against, f'{changed:+.3f}', rotation]

	def abutments(self, sizes):
		""":param list sizes: AbutmentSizes"""
		self.sizes, top = sizes, self.closed.peak()[0]
		if not sizes:
			return
		columns = ['abutment height (block heights)', 'abutment length (block heights)', 'peak load (N)', 'rotation (°)']
		columns += ['against the closed form (%)', 'independent program (N)', 'rotation (°)', 'with a block at midspan (N)', 'rotation (°)']
		rows = [
			[
				f'{size.height:g}',
				f'{size.length:g}',
				*_loadAndRotation(size.peak.load, size.peak.rotation),
				f'{100 * (size.peak.load / top - 1):+.2f}',
				*_loadAndRotation(*size.model),
				*_loadAndRotation(*size.wall),
			]
			for size in sizes
		]
		caption = "Analytic centre: effect of the abutments' size; their middle is at the height of the beam's middle."
		self.findings.table('abutments', caption, columns, rows)

	def normals(self, tilted):
		""":param list tilted: TiltedNormals; of each contact point the first one is as given"""
		base, rows = {}, []
		for case in tilted:
			first = base.setdefault(case.contactPoint, case)
			numbers = [f'{case.weight:g}', f'{case.radius:g}', _degrees(case.peak.tilt)]
			numbers += _loadAndRotation(case.peak.load, case.peak.rotation)
			rows.append([contactPointNames[case.contactPoint], *numbers, f'{100 * (case.peak.load / first.peak.load - 1):+.3f}'])
		columns = ['contact point', "weight of the abutment's face", 'corner radius (block heights)', 'tilt of the normal (°)']
		caption = 'Contact normals at the abutments that are not horizontal; at midspan they are, by symmetry.'
		self.findings.table('normals', caption, columns + ['peak load (N)', 'rotation (°)', 'change (%)'], rows)

	def failedQueries(self):
		note = f'of {self.study.queries}'
		self.findings.row('contact queries without an answer', self.study.failures, theory=0, accept=(0, 0), note=note)

	def figures(self):
		findings, folder, study = self.findings, self.findings.folder, self.study
		plotCurves(folder / 'figure8.png', self.closed, self.found, self.pushes, study.last)
		caption = "Fig. 8 of the paper from our data. Crosses: states at rest under imposed weight, with Appendix A's arm like all else"
		findings.figure('figure8.png', caption + '; the arrows are where it snaps through.')
		drawBeam(folder / 'beam.png', study, self.given.contact_point, study.first, 0.93 * study.last)
		caption = 'The beam and its line of thrust, through the contact points; below, both overlaps at the peak (stretched sideways).'
		findings.figure('beam.png', caption)

	def explain(self):
		"""What the rows and tables show, with their figures."""
		if not self.holds:
			self._text(
				"""With these options the contact normals at the abutments are not horizontal, or the abutments end within the overlap:
				Appendix A does not hold, and the comparison with it is shown without being judged."""
			)
		self._explainClosedForm()
		if ('centroid', 'newton') in self.found:
			curve = self.found['centroid', 'newton']
			self._text(
				f"""Up to the peak {curve.work:.1f} J of work are done on a half-beam, but {curve.peak.stored:.1f} J are stored in its
				springs, {100 * (curve.peak.stored / curve.work - 1):.1f} % more: the force on the chord through the centroid is not the
				gradient of ½Kd², for the centroid moves along the faces as the block turns."""
			)
		if ('analyticCentre', 'newton') in self.found:
			self._explainAnalyticCentre(self.found['analyticCentre', 'newton'].peak)
		if self.rises:
			self._explainDynamics()

	def _explainClosedForm(self):
		load, rotation = self.closed.peak()
		trueLoad, trueRotation = self.closed.peak(trueArm=True)
		self._text(
			"""Appendix A is one rectangle between two rigid walls; here both half-beams are modelled. With the centroid these are the
			same: the overlap at midspan is two of Appendix A's triangles, mirrored, with the centroid at the same height and twice the
			chord, so half the stiffness gives the same thrust. Abutments twice as stiff as midspan is also what equal half-beams give
			against rigid abutments, each body having half of the compliance of a joint; and with weights by stiffness (Eq. 17) a rigid
			body's face decides the normal: all forces are horizontal, as in Appendix A."""
		)
		self._text(
			f"""The load is W = M/(L₁/2) with the moment M of the contact forces on one half-beam: Appendix A's arm. The true one, from the
			contact point at the abutment to the middle of the half-beam, is L₁/2 + δ/3: its peak is {trueLoad:.1f} N at
			{_degrees(trueRotation)}° instead of {load:.1f} N at {_degrees(rotation)}°. Imposed weight acts on the true arm."""
		)

	def _explainAnalyticCentre(self, peak):
		(load, _), (wall, _) = self.closed.peak(), self.study.wallPeak()
		thrust, lever = self.closed.thrust(peak.rotation) / 1e3, 1e3 * self.closed.lever(peak.rotation)
		self._text(
			f"""The analytic centre lies off the centroid because planes that do not bound the overlap take part. At its peak the thrust
			is {peak.thrust / 1e3:.2f} kN with a lever of {1e3 * peak.lever:.2f} mm; with the centroid it is {thrust:.2f} kN with
			{lever:.2f} mm at the same rotation. The size of the abutments, which the paper does not give, matters. So does what is
			at midspan: with a rigid block of the abutments' size instead of the other half-beam, which is Appendix A's model, the
			peak is {wall:.0f} N, {'above' if wall > load else 'below'} the closed form of the centroid. That the analytic centre is
			on the safe side holds for two half-beams, not in general."""
		)

	def _explainDynamics(self):
		rises = ' and '.join(f'{1e3 * rise:.3f} mm' for rise in self.rises)
		self._text(
			f"""Statics has no time step; so the answer to half the time step and double the stiffness is taken from dynamics, in two
			ways. First, the half-beams turn at a constant rate and move freely otherwise; friction holds them at the abutments,
			where they do not slip but roll: the hinge has risen by {rises} at the peak. The analytic centre is affected by being off
			the abutment's middle; this remains as the rate is reduced. Second, weight is raised in steps, each kept until
			the half-beams are at rest; when they snap through, half of the step is tried from the last state at rest. This ends a
			little below the peak, since every step overshoots its equilibrium, and gives no result beyond it."""
		)

	def _text(self, paragraph):
		self.findings.text(' '.join(paragraph.split()))


def _peakRow(curve):
	peak, ofSolvers = curve.peak, curve.contactPoint == 'analyticCentre'
	return [
		contactPointNames[curve.contactPoint],
		solverNames[curve.solver] if ofSolvers else '',
		*_loadAndRotation(peak.load, peak.rotation),
		f'{1e3 * peak.drop:.3f}',
		f'{peak.thrust / 1e3:.2f}',
		f'{1e3 * peak.lever:.3f}',
		f'{peak.loadTrueArm:.1f}',
		f'{curve.work:.1f}',
		f'{peak.stored:.1f}',
		_degrees(curve.exhaustion),
	]


def _loadAndRotation(load, rotation):
	return [f'{load:.1f}', _degrees(rotation)]


def _degrees(angle):
	return f'{math.degrees(angle):.4f}'
