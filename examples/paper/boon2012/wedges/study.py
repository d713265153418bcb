# SPDX-License-Identifier: GPL-2.0-or-later
"""Common to the studies of the two rock wedges (simulations C and D): options, the search for the critical friction angle, the rows
that both report, pictures. Angles in degrees."""

import math

import numpy as np
from matplotlib.figure import Figure
from yade import O
from yade.polytope.frictionReduction import FrictionReduction, setFrictionAngle
from yade.polytope.pictures.still import picture

from ..reporting.options import (
	Decreasing,
	angle,
	contactModels,
	contactPoints,
	count,
	fraction,
	isReference,
	notNegative,
	paperParser,
	positive,
)
from .scene import stiffnessFactors

__all__ = ['WedgeCase', 'WedgeReport', 'parseWedge', 'plotReduction', 'wedgeParser']

lowestSpeed = 1e-10
"""Slower is drawn as this [m/s]."""
stableColor, failedColor = '#1d4e79', '#c8451b'


def wedgeParser(text, geometry, steps):
	"""An argparse parser with the options of both scripts, see paperParser().

	:param steps: default reductions of the friction angle, coarse to fine
	"""
	parser = paperParser(text, 'coarser search and fewer variants, with the same tolerances', geometry)
	show = parser.add_argument
	show('--normal-stiffness', type=positive, default=1e7, help='[Pa/m], or [N/m] with --stiffness-times contact')
	show('--shear-stiffness', type=positive, default=1e7, help='in the same unit')
	times = 'stiffness of a contact: times the area of the wedge\'s face; times the area of the present contact section; as it is'
	show('--stiffness-times', choices=stiffnessFactors, default='face', help=times)
	show(
		'--contact-model',
		choices=contactModels,
		default='boon2012',
		help='the others are those of a contact surface, which read no contact point',
	)
	show('--contact-point', choices=contactPoints, default='analyticCentre')
	show('--damping', type=fraction, default=0.7, help='YADE\'s own, of NewtonIntegrator')
	show('--contact-damping', type=notNegative, default=0.0, help='of contacts in normal and shear direction, fraction of critical')
	show('--rocking-damping', type=notNegative, default=0.0, help='of contacts against rocking, fraction of critical')
	show('--time-step-fraction', type=positive, default=0.2, help='time step over sqrt(mass / sum of normal stiffnesses)')
	show('--gravity', type=positive, default=10.0, help='[m/s²]')
	show('--density', type=positive, default=2000.0, help='[kg/m³]')
	show('--start', type=angle, default=70.0, help='friction angle to settle at [°]')
	reductions = 'reductions of the friction angle, coarse to fine [°]'
	show('--steps', type=positive, nargs='+', action=Decreasing, default=list(steps), help=reductions)
	show('--stable-speed', type=positive, default=2e-7, help='slower is at rest [m/s]')
	show('--failed-distance', type=positive, default=0.02, help='further from where it had settled is failed [m]')
	show('--check-every', type=count, default=100, help='time steps between two checks of speed and distance')
	show('--most-steps', type=count, default=200000, help='time steps at one angle; neither stable nor failed by then counts as failed')
	return parser


def parseWedge(parser, quickSteps):
	"""The options, and *reference*, see isReference().

	:param quickSteps: with --quick, where --steps says nothing else
	"""
	given = parser.parse_args()
	given.reference = isReference(parser, given)
	if given.quick and given.steps == parser.get_default('steps'):
		given.steps = list(quickSteps)
	return given


class WedgeCase:
	"""One search for the critical friction angle with one group of settings.

	:param given: the options, with *blocks*, a BlockGeometry
	:param str label: for tables
	:param builder: WedgeScene or RoofWedge
	:param blocks: BlockGeometry instead of the options'
	:param start, steps: instead of the options'
	:param changes: attributes of the scene against the options'

	:ivar scene: as built
	:ivar FrictionReductionResult result: of search()
	:ivar int remade: of search(): contacts that opened and closed again on the way to rest, and got their stiffness back at the next check
	"""

	def __init__(self, given, label, builder, blocks=None, start=None, steps=None, **changes):
		self.given, self.label = given, label
		self.start, self.steps = start or given.start, steps or given.steps
		attributes = {
			'normalStiffness': given.normal_stiffness,
			'shearStiffness': given.shear_stiffness,
			'stiffnessTimes': given.stiffness_times,
			'contactModel': given.contact_model,
			'contactPoint': given.contact_point,
			'damping': given.damping,
			'contactDamping': given.contact_damping,
			'rockingDamping': given.rocking_damping,
			'timeStepFraction': given.time_step_fraction,
			'gravity': given.gravity,
			'density': given.density,
		}
		self.scene = builder(blocks or given.blocks, frictionAngle=math.radians(self.start), **{**attributes, **changes}).build()

	def search(self, progress, measure):
		"""Looks for the critical friction angle of the scene, which must stand ready. Leaves it as it was at the lowest stable angle.

		:param progress: a tqdm bar, one unit of which is this search
		:param measure: see FrictionReduction
		:raises RuntimeError: as FrictionReduction.run() does
		"""
		given = self.given
		stages = []

		def check(stage):
			progress.set_postfix_str(f'{math.degrees(stage.level):.3f}°', refresh=False)
			stages.extend([stage] * self.scene.keepStiffness())

		try:
			reduction = FrictionReduction(
				[self.scene.wedgeId],
				math.radians(self.start),
				[math.radians(step) for step in self.steps],
				stableSpeed=given.stable_speed,
				failedDistance=given.failed_distance,
				checkEvery=given.check_every,
				mostSteps=given.most_steps,
				measure=measure,
				progress=check,
			)
			self.result = reduction.run()
			reduction.restore()
			self.remade = sum(stage.outcome == 'stable' for stage in stages)  # in a failure all contacts open
		finally:
			progress.update()

	@property
	def stable(self):
		"""Lowest angle at which the wedge was at rest."""
		return math.degrees(self.result.stable)

	@property
	def failed(self):
		"""Highest one at which it failed."""
		return math.degrees(self.result.failed)

	@property
	def critical(self):
		"""Critical friction angle [°]: the middle between the two."""
		return math.degrees(self.result.critical)

	@property
	def timeSteps(self):
		"""Number of them, over all stages."""
		return sum(stage.steps for stage in self.result.stages)

	@property
	def hops(self):
		"""What there is to say of *remade*, '' if nothing."""
		return f'contacts opened {self.remade} times; --rocking-damping 1 or --contact-damping 0.3 keeps them closed' if self.remade else ''

	def lastStage(self, angle):
		"""The Stage at the end of which the angle was found *stable* or *failed* [rad]."""
		return [stage for stage in self.result.stages if stage.level == angle][-1]

	def drawFailure(self, folder, distance, frame=None, **options):
		"""Two pictures from the same place: before.png as it is, after.png when the wedge has moved by *distance* [m] at the angle of
		failure.

		:param frame: as of picture(); None: all blocks
		:param options: of picture()
		"""
		if frame is None:
			frame = np.concatenate([_corners(body) for body in O.bodies])
		options = {'frame': frame, 'size': (1000, 800), **options}
		picture(str(folder / 'before.png'), **options)
		self._runOn(distance)
		picture(str(folder / 'after.png'), **options)

	def _runOn(self, distance, mostSteps=100000):
		setFrictionAngle(self.result.failed)
		origin = O.bodies[self.scene.wedgeId].state.pos
		for _ in range(mostSteps):
			O.step()
			if (O.bodies[self.scene.wedgeId].state.pos - origin).norm() > distance:
				return

	def wedgeCorners(self):
		"""(n, 3) array, as the wedge is now."""
		return _corners(O.bodies[self.scene.wedgeId])


def _corners(body):
	return np.array([tuple(body.state.pos + body.state.ori * corner) for corner in body.shape.vertices])


class WedgeReport:
	"""Rows that both studies report.

	:param Findings findings: where they go
	:param given: the options
	:param WedgeCase base: with the options' own settings
	:param list cases: each with another setting
	"""

	def __init__(self, findings, given, base, cases):
		self.findings, self.given, self.base, self.cases = findings, given, base, cases

	def case(self, label):
		return next(case for case in self.cases if case.label == label)

	def ofReference(self, value):
		"""The value if all is as by default, None otherwise: other settings have no known answer."""
		return value if self.given.reference else None

	def queries(self, cases):
		failures = sum(case.result.failedQueries for case in cases)
		self.findings.row('contact queries without an answer', failures, theory=0, accept=(0, 0))

	def figures(self, before, moved, others=()):
		"""Figures of plotReduction() and WedgeCase.drawFailure().

		:param str before: what is seen
		:param str moved: what has happened in the second picture
		:param others: further ones, (file, caption)
		"""
		self.findings.figure('reduction.png', 'Friction reduction: displacement against friction angle, and speed at the last two angles')
		for path, caption in others:
			self.findings.figure(path, caption)
		self.findings.figure('before.png', f'{before}, at {self.base.stable:.2f}°')
		self.findings.figure('after.png', f'The same at {self.base.failed:.2f}°, when it has {moved}')


def plotReduction(path, case, theory, title):
	"""Two plots of one search: displacement at the end of each stage against friction angle, and speed over time at the last two angles.

	:param WedgeCase case: after its search
	:param float theory: closed form's critical angle, None for none
	"""
	figure = Figure(figsize=(12, 4.6), layout='constrained')
	left, right = figure.subplots(1, 2)
	reduced = case.result.stages[1:]
	for stable, color, marker, label in ((True, stableColor, 'o', 'at rest'), (False, failedColor, 'v', 'failed (run ends there)')):
		stages = [stage for stage in reduced if (stage.outcome == 'stable') == stable]
		angles, displacements = [math.degrees(stage.level) for stage in stages], [1e3 * stage.displacement for stage in stages]
		left.plot(angles, displacements, marker, color=color, markersize=4, label=label)
	if theory is not None:
		left.axvline(theory, color='0.4', linewidth=1, linestyle='--', label=f'closed form {theory:.3f}°')
	left.set(xlabel='friction angle [°]', ylabel='displacement since settling [mm]', title=title)
	left.invert_xaxis()
	left.set_yscale('symlog', linthresh=0.01)  # before the first slip it is zero
	left.set_ylim(-5e-4, 3e3 * max(stage.displacement for stage in reduced))
	left.legend()
	for end, color, word in ((case.result.stable, stableColor, 'comes to rest'), (case.result.failed, failedColor, 'fails')):
		times, speeds, _ = zip(*case.lastStage(end).samples, strict=True)
		right.semilogy(times, np.maximum(speeds, lowestSpeed), '.-', color=color, linewidth=1, label=f'{math.degrees(end):.3f}°: {word}')
	limit = case.given.stable_speed
	right.axhline(limit, color='0.4', linewidth=1, linestyle='--', label=f'at rest below {limit:g} m/s')
	right.set(xlabel='time since this friction angle was set [s]', ylabel='speed [m/s]', title='the last two friction angles')
	right.legend()
	figure.savefig(path, dpi=130)
