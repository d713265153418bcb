# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation B of Boon, Houlsby & Utili (2012): the load a three-hinged beam carries while its two half-beams turn (Fig. 8), in true 2-D.

Two half-beams, 138 mm × 46 mm, between fixed abutments; contacts of 100 MN/m at the abutments and 50 MN/m at midspan. The rotation
is imposed, so that the curve goes on beyond its peak; the load is the moment of the contact forces over L₁/2. Shown beside Appendix A
of the paper (closed form) and Goodman's criterion, for the contact point at the centroid of the overlap and at the analytic centre
(by Newton's method, and by Ipopt where the build has it); then what the abutments' size, contact normals, time step, stiffness and
load control do to it.

Expected: with the centroid, the closed form itself, to rounding: peak 37 027.3 N at 6.7469°. With the analytic centre and abutments
of three block heights 31 278 N at 6.37°. The load imposed instead reaches the peak and snaps through. Ends with 1 if not.

	./run python examples/paper/b_three_hinged_beam.py              # a quarter of a minute (longer with Ipopt)
	./run python examples/paper/b_three_hinged_beam.py --quick      # some seconds
	./run yade -n -x examples/paper/b_three_hinged_beam.py --quick
	./run python examples/paper/b_three_hinged_beam.py --length 0.2 --abutment-height 5 --midspan-stiffness 100e6 --contact-point centroid
"""
import argparse
import math
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; four bodies are too few for more

tolerances = {'centroid': 0.005, 'analyticCentre': 0.01}
"""Of loads and rotations against theory, and of their change with time step and stiffness."""
solverTolerance = 1e-6
"""Of Newton's loads against Ipopt's, over the peak."""
changes = {'time step halved': {'timeStep': 0.5}, 'stiffness doubled': {'stiffness': 2}}


def options():
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	show = parser.add_argument
	show('--length', type=positive, default=0.138, help='L1 of each half-beam [m]')
	show('--height', type=positive, default=0.046, help='L2 of the half-beams, the "block height" below [m]')
	show('--abutment-height', type=positive, default=3, help='[block heights], at least 1')
	show('--abutment-length', type=positive, default=1, help='away from the beam [block heights]')
	show('--abutment-heights', type=positive, nargs='+', help='those of the study of size [block heights] (default: 1 1.2 1.5 2 3 5 10 20)')
	show('--abutment-stiffness', type=positive, default=100e6, help='of each contact at an abutment [N/m]')
	show('--midspan-stiffness', type=positive, default=50e6, help='of the contact at midspan [N/m]')
	show('--normal-weight', type=positive, default=1, help="of the abutment's face in the normal: 0.5 (equal) to 1 (rigid: horizontal)")
	show('--corner-radius', type=positive, help='[block heights]; must not be below the overlaps (default: 0.1, or the largest overlap)')
	show('--contact-point', choices=('centroid', 'analyticCentre', 'chebyshevCentre'), nargs='+', default=['centroid', 'analyticCentre'])
	show('--solver', choices=('newton', 'ipopt'), nargs='+', help='of the analytic centre; newton is always run (default: all there are)')
	show('--rotations', type=positive, nargs=2, metavar=('FIRST', 'LAST'), help='[°] (default: 0.25, and 0.81366 of alignment, here 15)')
	show('--points', type=int, help='of each curve (default: 119, quick 31)')
	show('--drive-steps', type=int, help='time steps of a rotation at a constant rate (default: 30000, quick 8000)')
	show('--time-step-fraction', type=positive, default=0.1, help='in dynamics: time step over sqrt(mass / stiffness at the abutment)')
	show('--damping', type=float, default=0.7, help='in dynamics: YADE\'s own, of NewtonIntegrator')
	show('--friction-angle', type=positive, help='in dynamics: enough for no slip at the abutments [°] (default: 45, or more)')
	show('--quick', action='store_true', help='fewer points, steps and sizes, with the same tolerances')
	show('--output', type=pathlib.Path, default=pathlib.Path('output/b_three_hinged_beam'), help='folder for all files')
	show('--no-pictures', action='store_true')
	given = parser.parse_args()
	from yade.polytope.solverTimes import hasSolver
	from yade.polytope.theory.beam import BeamBetweenWalls

	given.points = given.points or (31 if given.quick else 119)
	given.drive_steps = given.drive_steps or (8000 if given.quick else 30000)
	given.abutment_heights = sorted(set(given.abutment_heights or ([1, 1.5, 3, 10] if given.quick else [1, 1.2, 1.5, 2, 3, 5, 10, 20])))
	beam = BeamBetweenWalls(given.length, given.height, given.abutment_stiffness, given.midspan_stiffness)
	aligned = math.degrees(beam.alignment)
	given.rotations = given.rotations or [0.25, 15 / math.degrees(math.atan(1 / 3)) * aligned]
	overlap = max(beam.penetrations(math.radians(given.rotations[1]))) / given.height
	given.corner_radius = given.corner_radius or max(0.1, overlap)
	overhang = (given.abutment_height - 1) / 2
	needed = max(given.corner_radius, overlap * math.tan(math.radians(given.rotations[1])))
	given.horizontal = given.normal_weight == 1 and overhang >= needed - 1e-12
	shear = 4 / 3 * given.height / given.length  # over normal force at the abutment, at small rotations
	given.friction_angle = given.friction_angle or max(45, math.degrees(math.atan(1.5 * shear)))
	hasIpopt = hasSolver('ipopt')
	for good, message in (
	        (given.rotations[0] < given.rotations[1] < aligned, f'--rotations: must rise, to below {aligned:.4g}°, hinges in one line'),
	        (given.points >= 5, '--points: must be at least 5'),
	        (given.drive_steps >= 1000, '--drive-steps: must be at least 1000'),
	        (min(given.abutment_heights + [given.abutment_height]) >= 1, '--abutment-height, --abutment-heights: must be at least 1'),
	        (0.5 <= given.normal_weight <= 1, '--normal-weight: must be 0.5 to 1'),
	        (overlap <= given.corner_radius < 0.5, f'--corner-radius: must be from {overlap:.4g}, the largest overlap, to below 0.5'),
	        (given.time_step_fraction < 0.5, '--time-step-fraction: must be below 0.5'),
	        (0 <= given.damping < 1, '--damping: must be 0 to below 1'),
	        (
	                math.degrees(math.atan(shear)) < given.friction_angle < 90,
	                f'--friction-angle: must be below 90, and above {math.degrees(math.atan(shear)):.4g}, else the abutments slip'
	        ),
	        (hasIpopt or 'ipopt' not in (given.solver or []), '--solver: this build has no ipopt'),
	):  # yapf: disable
		if not good:
			parser.error(message)
	solvers = given.solver or ['newton', 'ipopt']
	given.solver = ['newton'] + ['ipopt'] * (hasIpopt and 'ipopt' in solvers)
	given.ipoptMissing = not hasIpopt
	return given


def degrees(angle):
	return f'{math.degrees(angle):.4f}'


def positive(text):
	value = float(text)
	if not 0 < value < math.inf:
		raise argparse.ArgumentTypeError(f'must be positive and finite, got {text}')
	return value


class Report:
	"""Runs everything and writes it down, one part after the other."""

	def __init__(self, given, findings):
		from yade.polytope.beamStudy import BeamStudy
		self.given, self.findings = given, findings
		self.study = BeamStudy(
		        {
		                'length': given.length,
		                'height': given.height,
		                'abutmentStiffness': given.abutment_stiffness,
		                'midspanStiffness': given.midspan_stiffness
		        }, {
		                'abutmentHeight': given.abutment_height * given.height,
		                'abutmentLength': given.abutment_length * given.height
		        },
		        abutmentNormalWeight=given.normal_weight,
		        cornerRadius=given.corner_radius * given.height,
		        timeStepFraction=given.time_step_fraction,
		        damping=given.damping,
		        frictionAngle=math.radians(given.friction_angle)
		)
		self.closed = self.study.appendixA
		self.rotations = [math.radians(rotation) for rotation in given.rotations]
		self.withTheory = [point for point in given.contact_point if point in self.study.theory]

	def within(self, quantity, ours, theory, unit, tolerance, note=''):
		"""A row that must be within a relative tolerance of theory, where theory holds."""
		accept = (theory - tolerance * abs(theory), theory + tolerance * abs(theory)) if self.given.horizontal else None
		self.findings.row(quantity, ours, unit, theory=theory, accept=accept, note=note)

	def deviation(self, quantity, percent, tolerance, note=''):
		"""A row of a difference from theory, where theory holds within the tolerance."""
		self.findings.row(quantity, percent, '%', theory=0, accept=(0, 100 * tolerance) if self.given.horizontal else None, note=note)

	def change(self, quantity, percent, tolerance, note=''):
		"""A row of a change of the result that must be small, whatever the settings."""
		self.findings.row(quantity, percent, '%', theory=0, accept=(-100 * tolerance, 100 * tolerance), note=note)

	def curves(self):
		import numpy as np
		from tqdm import tqdm
		given = self.given
		wanted = [(point, 'newton') for point in given.contact_point]
		if 'analyticCentre' in given.contact_point:
			wanted += [('analyticCentre', solver) for solver in given.solver if solver != 'newton']
		rotations = np.linspace(*self.rotations, given.points)
		with tqdm(total=len(wanted) * given.points, desc='rotation imposed', unit='point', leave=False) as progress:
			self.found = {which: self.study.curve(*which, rotations, progress.update) for which in wanted}
		end = math.degrees(self.closed.alignment)
		self.findings.row("Goodman's criterion: rotation with the hinges in one line", end, '°', theory=end, note='closed form')
		if ('centroid', 'newton') in self.found:
			self._centroid(self.found['centroid', 'newton'])
		if ('analyticCentre', 'newton') in self.found:
			self._analyticCentre(self.found['analyticCentre', 'newton'], self.found.get(('analyticCentre', 'ipopt')))
		columns = ['contact point', 'solver', 'load (N)', 'rotation (°)', 'drop at midspan (mm)', 'thrust (kN)', 'lever (mm)']
		columns += ['load with the true arm (N)', 'work up to it (J)', 'energy stored (J)', 'load is zero at (°)']
		rows = [self._peak(point, solver, curve) for (point, solver), curve in self.found.items()]
		self.findings.table('peaks', 'At the peak, rotation imposed. Work and energy are those of one half-beam.', columns, rows)

	def _peak(self, point, solver, curve):
		from yade.polytope.beamPlots import names, solverNames
		peak = curve.peak
		return [
		        names[point], solverNames[solver] if point == 'analyticCentre' else '', f'{peak.load:.1f}', degrees(peak.rotation),
		        f'{1e3 * peak.drop:.3f}', f'{peak.thrust / 1e3:.2f}', f'{1e3 * peak.lever:.3f}', f'{peak.loadTrueArm:.1f}',
		        f'{curve.work:.1f}', f'{peak.stored:.1f}', degrees(curve.exhaustion)
		]

	def _centroid(self, curve):
		closed, peak, tolerance = self.closed, curve.peak, tolerances['centroid']
		load, rotation = closed.peak()
		apart = [(abs(reading.load - theory), abs(theory)) for reading in curve.readings for theory in [closed.load(reading.rotation)]]
		self.within('centroid: peak load', peak.load, load, 'N', tolerance)
		self.within('centroid: rotation at the peak', math.degrees(peak.rotation), math.degrees(rotation), '°', tolerance)
		self.deviation(
		        'centroid: largest deviation from the closed form along the curve',
		        max(100 * difference / value for difference, value in apart),
		        tolerance,
		        note='of the load at the same rotation, at {} rotations from {:g} to {:g}°; at most {:.1e} N'.format(
		                len(apart), *self.given.rotations, max(apart)[0]
		        )
		)
		for what, ours, theory, unit in (
		        ('thrust at the peak', peak.thrust / 1e3, closed.thrust(rotation) / 1e3, 'kN'),
		        ('lever of the thrusts at the peak', 1e3 * peak.lever, 1e3 * closed.lever(rotation), 'mm'),
		        ('drop at midspan at the peak', 1e3 * peak.drop, 1e3 * closed.drop(rotation), 'mm'),
		        ('rotation with the load back to zero', math.degrees(curve.exhaustion), math.degrees(closed.exhaustion()), '°'),
		        ('work up to the peak', curve.work, closed.work(rotation), 'J'),
		        ('energy stored at the peak', peak.stored, closed.stored(rotation), 'J'),
		):
			note = 'more than the work: not conservative' if 'stored' in what else ''
			self.within(f'centroid: {what}', ours, theory, unit, tolerance, note)

	def _analyticCentre(self, newton, ipopt):
		load, rotation = self.study.twoBlocks.peak()
		note = 'in place of a closed form: an independent program for the same planes, in exact symmetry'
		title = f'analytic centre, abutments of {self.given.abutment_height:g} block heights'
		tolerance, ours = tolerances['analyticCentre'], newton.peak
		self.within(f'{title}: peak load', ours.load, load, 'N', tolerance, note)
		self.within(f'{title}: rotation at the peak', math.degrees(ours.rotation), math.degrees(rotation), '°', tolerance, note)
		if ipopt:
			pairs = [(a.load, b.load) for a, b in zip(newton.readings, ipopt.readings, strict=True)]
			self.findings.row(
			        'analytic centre: Newton against Ipopt, largest difference of loads over the peak',
			        max(abs(a - b) for a, b in pairs) / newton.peak.load,
			        theory=0,
			        accept=(0, solverTolerance),
			        note=f'over the load at the same rotation: {max(abs(a / b - 1) for a, b in pairs):.1e}'
			)
		elif self.given.ipoptMissing:
			self.findings.text('This build has no Ipopt: the curve of the analytic centre by Ipopt and its row are missing.')

	def dynamics(self):
		"""The rotation at a rate, and the weight, each with half the time step and double the stiffness."""
		from tqdm import tqdm
		self.pushes, self.rise, turned, pushed = {}, {}, [], []
		with tqdm(total=7 * len(self.withTheory), desc='dynamics', unit='run', leave=False) as progress:
			for point in self.withTheory:
				turned += self._turn(point, progress)
				pushed += self._push(point, progress)
		columns = ['contact point', 'run', 'largest load (N)', 'rotation (°)', 'against theory (%)', 'change (%)']
		caption = 'Half-beams turned at a constant rate, to half as far again as the peak. Loads over the factor on the stiffness.'
		self.findings.table('driven', caption, columns + ['deviation along the curve (% of the peak)'], turned)
		columns = ['contact point', 'run', 'weight held (N)', 'snapped through at (N)', 'against theory (%)', 'change (%)']
		caption = 'Weight of the half-beams raised until they snap through. Weights over the factor on the stiffness.'
		self.findings.table('pushed', caption, columns + ['last rotation at rest (°)'], pushed)
		if self.pushes:
			limit = math.tan(math.radians(self.given.friction_angle))
			slip = max(reading.shearRatio for readings in self.pushes.values() for reading in readings)
			title, note = 'load imposed: shear over normal force at the abutment', f'slips at {limit:.4g}'
			self.findings.row(title, slip, accept=(0, 0.999 * limit), note=note)

	def _turn(self, point, progress):
		from yade.polytope.beamPlots import names
		tolerance, (top, topRotation), title = tolerances[point], self.study.theory[point].peak(), f'{names[point]}, turned at a rate'
		# further on, half-beams stouter than the paper's (L1/L2 = 1) leave their symmetry
		last, base = min(self.rotations[1], 1.5 * topRotation), None
		for label, change in {'as given': {}, **changes, 'rate halved': {'rate': 0.5}}.items():
			run = self.study.driven(point, self.rotations[0], last, self.given.drive_steps, **change)
			progress.update()
			base = base or run
			changed = 100 * (run.peak / base.peak - 1)
			if change:
				self.change(f'{title}: change of the peak, {label}', changed, tolerance)
			else:
				self.deviation(f'{title}: largest deviation from theory over the peak', 100 * run.deviation, tolerance)
				self.rise[point] = run.rise
			against = f'{100 * (run.peak / top - 1):+.4f}'
			yield [names[point], label, f'{run.peak:.1f}', degrees(run.rotation), against, f'{changed:+.4f}', f'{100 * run.deviation:.4f}']

	def _push(self, point, progress):
		from yade.polytope.beamPlots import names
		tolerance, (top, _), title = tolerances[point], self.study.theory[point].peak(trueArm=True), f'{names[point]}, load imposed'
		precision, settleSteps, base = 1e-3 if self.given.quick else 2e-4, 50 / self.given.time_step_fraction, None
		for label, change in {'as given': {}, **changes}.items():
			held, tooMuch, readings = self.study.pushed(point, self.rotations[0], precision, settleSteps, **change)
			progress.update()
			base = base or held
			changed = 100 * (held / base - 1)
			if change:
				note = f'weights tried are {100 * (tooMuch / held - 1):.2g} % apart'
				self.change(f'{title}: change of the weight held, {label}', changed, tolerance, note)
			else:
				note = f'theory with the true arm, L₁/2 + δ/3; snapped through at {tooMuch:.1f} N'
				self.within(f'{title}: weight held', held, top, 'N', tolerance, note)
				self.pushes[point] = readings
			against, rotation = f'{100 * (held / top - 1):+.3f}', degrees(readings[-1].rotation)
			yield [names[point], label, f'{held:.1f}', f'{tooMuch:.1f}', against, f'{changed:+.3f}', rotation]

	def abutments(self):
		from tqdm import tqdm
		given, unit, top = self.given, self.given.height, self.closed.peak()[0]
		lengths = [given.abutment_length] if given.quick else [given.abutment_length, 3 * given.abutment_length]
		runs = self.study.abutments([height * unit for height in given.abutment_heights], [length * unit for length in lengths])
		self.sizes = list(tqdm(runs, total=len(given.abutment_heights) * len(lengths), desc='abutments', leave=False))
		columns = ['abutment height (block heights)', 'abutment length (block heights)', 'peak load (N)', 'rotation (°)']
		columns += ['against the closed form (%)', 'independent program (N)', 'rotation (°)', 'with a block at midspan (N)', 'rotation (°)']
		rows = [
		        [
		                f'{height / unit:g}', f'{length / unit:g}', f'{peak.load:.1f}', degrees(peak.rotation),
		                f'{100 * (peak.load / top - 1):+.2f}', f'{model[0]:.1f}', degrees(model[1]), f'{wall[0]:.1f}', degrees(wall[1])
		        ] for height, length, peak, model, wall in self.sizes
		]
		caption = "Analytic centre: what the size of the abutments does; their middle is at the height of the beam's middle."
		self.findings.table('abutments', caption, columns, rows)

	def normals(self):
		from yade.polytope.beamPlots import names
		given, rows = self.given, []
		radii = [radius for radius in (given.corner_radius, 2 * given.corner_radius) if radius < 0.5]
		for point in given.contact_point:
			base = None
			for weight in dict.fromkeys([given.normal_weight, 0.9, 0.75, 0.5]):
				for radius in radii:
					peak = self.study.peak(contactPoint=point, abutmentNormalWeight=weight, cornerRadius=radius * given.height)
					base = base or peak.load
					numbers = [f'{weight:g}', f'{radius:g}', degrees(peak.tilt), f'{peak.load:.1f}', degrees(peak.rotation)]
					rows.append([names[point], *numbers, f'{100 * (peak.load / base - 1):+.3f}'])
		columns = ['contact point', "weight of the abutment's face", 'corner radius (block heights)', 'tilt of the normal (°)']
		caption = 'Contact normals at the abutments that are not horizontal; at midspan they are, by symmetry.'
		self.findings.table('normals', caption, columns + ['peak load (N)', 'rotation (°)', 'change (%)'], rows)

	def pictures(self):
		from yade.polytope import beamPlots
		findings, folder = self.findings, self.findings.folder
		beamPlots.plotCurves(folder / 'figure8.png', self.closed, self.found, self.pushes, self.rotations[1])
		caption = "Fig. 8 of the paper from our data. Crosses: states at rest under imposed weight, with Appendix A's arm like all else"
		findings.figure('figure8.png', caption + '; the arrows are where it snaps through.')
		beamPlots.drawBeam(folder / 'beam.png', self.study, self.given.contact_point, self.rotations[0], 0.93 * self.rotations[1])
		caption = 'The beam and its line of thrust, through the contact points; below, both overlaps at the peak (stretched sideways).'
		findings.figure('beam.png', caption)
		if self.sizes:
			beamPlots.plotSizes(folder / 'abutments.png', self.closed, self.sizes, self.given.height)
			caption = 'Analytic centre: peak load and the size of the abutments. Grey: a rigid block instead of the other half-beam.'
			findings.figure('abutments.png', caption)

	def explain(self):
		closed = self.closed
		load, rotation = closed.peak()
		trueLoad, trueRotation = closed.peak(trueArm=True)
		if not self.given.horizontal:
			self.text(
				"""With these options the contact normals at the abutments are not horizontal, or the abutments end within the overlap:
				Appendix A does not hold, and the comparison with it is shown without being judged."""
			)
		self.text(
			"""Appendix A is one rectangle between two rigid walls; here both half-beams are modelled. With the centroid these are the
			same: the overlap at midspan is two of Appendix A's triangles, mirrored, with the centroid at the same height and twice the
			chord, so half the stiffness gives the same thrust. Abutments twice as stiff as midspan is also what equal half-beams give
			against rigid abutments, each body having half of the compliance of a joint; and with weights by stiffness (Eq. 17) a rigid
			body's face decides the normal: all forces are horizontal, as in Appendix A."""
		)
		self.text(
			f"""The load is W = M/(L₁/2) with the moment M of the contact forces on one half-beam: Appendix A's arm. The true one, from the
			contact point at the abutment to the middle of the half-beam, is L₁/2 + δ/3: its peak is {trueLoad:.1f} N at
			{degrees(trueRotation)}° instead of {load:.1f} N at {degrees(rotation)}°. Imposed weight acts on the true arm."""
		)
		if ('centroid', 'newton') in self.found:
			curve = self.found['centroid', 'newton']
			self.text(
				f"""Up to the peak {curve.work:.1f} J of work are done on a half-beam, but {curve.peak.stored:.1f} J are stored in its
				springs, {100 * (curve.peak.stored / curve.work - 1):.1f} % more: the force on the chord through the centroid is not the
				gradient of ½Kd², for the centroid moves along the faces as the block turns."""
			)
		if ('analyticCentre', 'newton') in self.found:
			peak, (wall, _) = self.found['analyticCentre', 'newton'].peak, self.study.wallPeak()
			thrust, lever = closed.thrust(peak.rotation) / 1e3, 1e3 * closed.lever(peak.rotation)
			self.text(
				f"""The analytic centre lies off the centroid because planes that do not bound the overlap take part. At its peak the thrust
				is {peak.thrust / 1e3:.2f} kN with a lever of {1e3 * peak.lever:.2f} mm; with the centroid it is {thrust:.2f} kN with
				{lever:.2f} mm at the same rotation. The size of the abutments, which the paper does not give, matters. So does what is
				at midspan: with a rigid block of the abutments' size instead of the other half-beam, which is Appendix A's model, the
				peak is {wall:.0f} N, {'above' if wall > load else 'below'} the closed form of the centroid. That the analytic centre is
				on the safe side holds for two half-beams, not in general."""
			)
		rises = ' and '.join(f'{1e3 * rise:.3f} mm' for rise in self.rise.values())
		if rises:
			self.text(
				f"""Statics has no time step; so the answer to half the time step and double the stiffness is taken from dynamics, in two
				ways. First, the half-beams turn at a constant rate and move freely otherwise; friction holds them at the abutments,
				where they do not slip but roll: the hinge has risen by {rises} at the peak. The analytic centre feels that it is off
				the abutment's middle; this is what remains as the rate goes down. Second, weight is raised in steps, each kept until
				the half-beams are at rest; when they snap through, half of the step is tried from the last state at rest. This ends a
				little below the peak, since every step swings beyond its equilibrium, and can show nothing beyond it."""
			)

	def text(self, paragraph):
		self.findings.text(' '.join(paragraph.split()))

	def run(self):
		self.curves()
		self.dynamics()
		self.sizes = None
		if 'analyticCentre' in self.given.contact_point:
			self.abutments()
		self.normals()
		note = f'failures and fallbacks, of {self.study.queries} queries'
		self.findings.row('contact queries without a proper answer', self.study.failures, theory=0, accept=(0, 0), note=note)
		if not self.given.no_pictures:
			self.pictures()
		self.explain()


def main():
	given = options()
	from yade.polytope.findings import Findings
	shown = {key: str(value) for key, value in vars(given).items() if key not in ('output', 'no_pictures', 'ipoptMissing')}
	findings = Findings('B', 'Three-hinged beam', given.output, shown)
	Report(given, findings).run()
	good = findings.save()
	findings.show()
	if given.ipoptMissing:
		print('\nThis build has no Ipopt: its curve and its row are missing.')
	print(f'\nFiles: {given.output}/')
	return 0 if good else 1


if __name__ == '__main__':
	sys.exit(main())
