# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of simulation C, a wedge that slides on two joints: cases, with the shear that is locked into the joints, and their report.

Angles in degrees, forces over the wedge's weight W. A and B are the two faces; transverse shear T is normal to the line of sliding,
positive up in the plane.
"""

import math

import numpy as np
from matplotlib.figure import Figure
from yade import O

from ..wedges.scene import WedgeScene
from ..wedges.study import WedgeCase, WedgeReport
from ..wedges.theory import SlidingWedge

__all__ = ['SlidingWedgeCase', 'SlidingWedgeReport', 'limitEquilibrium', 'plotLockedShear']

leastEdgeForce = 1e-2
"""Force of the back edge, over W, from which on two faces alone no longer explain the critical angle."""
faceColors = {'A': '#1d4e79', 'B': '#f2a541'}


def limitEquilibrium(blocks):
	"""SlidingWedge of a BlockGeometry.

	:raises ValueError: if the wedge has not two joints, or does not slide on both
	"""
	faces = [blocks.jointNormal(name) for name in blocks.faceBlocks]
	if len(faces) != 2:
		raise ValueError(f'the wedge must have two joints, each shared with one block alone, got {len(faces)}')
	return SlidingWedge(*faces)


class SlidingWedgeCase(WedgeCase):
	"""See WedgeCase. Searches at once.

	:param given: the options; besides WedgeCase's *theory*, a SlidingWedge, and *edge_stiffness*
	:param progress: a tqdm bar
	:param bool turning: False: the wedge's rotation is blocked

	:ivar str failure: why there is no result; None if there is one
	:ivar dict settled, atFailure: forces() after settling, and in the last stable state
	"""

	def __init__(self, given, label, progress, turning=True, **changes):
		super().__init__(given, label, WedgeScene, **{'edgeStiffness': given.edge_stiffness, **changes})
		if not turning:
			O.bodies[self.scene.wedgeId].state.blockedDOFs = 'XYZ'
		self.failure = None
		try:
			self.scene.establishContacts()
			self.search(progress, self.forces)
		except RuntimeError as error:
			self.failure = str(error)
			return
		self.settled, self.atFailure = self.result.stages[0].measured, self.lastStage(self.result.stable).measured

	def forces(self):
		"""Forces on the wedge now: {normal: (A, B), transverse: (A, B), edge: of the back edge, section: contact sections over faces (A, B)}."""
		scene = self.scene
		normal, transverse, section = [], [], []
		for joint, direction in zip(scene.joints, self.given.theory.transverse(), strict=True):
			push, shear = scene.forceFrom(joint.block)
			normal.append(float(np.linalg.norm(push)) / scene.weight)
			transverse.append(float(shear.dot(direction)) / scene.weight)
			section.append(scene.sectionOf(joint) / joint.area)
		edge = sum(float(np.linalg.norm(sum(scene.forceFrom(name)))) for name in scene.geometry.edgeBlocks) / scene.weight
		return {'normal': normal, 'transverse': transverse, 'edge': edge, 'section': section}

	def withShear(self):
		"""Closed form with the transverse shear measured in the last stable state."""
		return math.degrees(self.given.theory.frictionAngle(*self.atFailure['transverse']))


class SlidingWedgeReport(WedgeReport):
	def __init__(self, findings, given, base, cases):
		super().__init__(findings, given, base, cases)
		self.theory = given.theory
		self.limit = math.degrees(given.theory.frictionAngle())

	def must(self, value, half):
		return self.ofReference((value - half, value + half))

	def criticalAngle(self, paper, expected, tolerance, note):
		base = self.base
		bracket = f'middle of the last step, {base.failed:.3f}° (failed) to {base.stable:.3f}° (stable); '
		bracket += f'{base.hops}; ' if base.hops else ''
		must = self.must(expected, tolerance)
		self.findings.row('critical friction angle', base.critical, '°', self.ofReference(paper), self.limit, must, bracket + note)

	def limitEquilibrium(self, paper, known, lowest):
		"""The closed form, beside values known for the reference.

		:param float paper: its friction angle
		:param dict known: quantity → (value, half the range in which it must lie)
		:param lowest: the same of the lowest angle
		"""
		theory = self.theory
		reactions = theory.reactions()
		ours = {
			'friction angle': (self.limit, '°'),
			'plunge of the line of intersection': (math.degrees(theory.plunge), '°'),
			'its trend': (math.degrees(theory.trend), '°'),
			'R_A/W': (reactions[0], '-'),
			'R_B/W': (reactions[1], '-'),
		}
		for quantity, (value, unit) in ours.items():
			published = self.ofReference(paper if quantity == 'friction angle' else None)
			must = self.must(*known[quantity])
			self.findings.row(f'limit equilibrium: {quantity}', value, unit, published, self.ofReference(known[quantity][0]), must)
		bound, shearA, shearB = theory.lowerBound()
		self.findings.row(
			'lowest angle of a statically admissible state',
			math.degrees(bound),
			'°',
			theory=self.ofReference(lowest[0]),
			accept=self.must(*lowest),
			note=f'with transverse shear T_A = {shearA:+.4f} W, T_B = {shearB:+.4f} W',
		)

	def lockedShear(self, margin):
		"""Limit equilibrium with the shear measured, which must lie within the bracket found, widened by *margin*; and why it differs."""
		base, findings = self.base, self.findings
		must = self.ofReference((base.failed - margin, base.stable + margin))
		within = base.failed - margin <= base.withShear() <= base.stable + margin
		note = (
			'the critical angle above, so it explains the whole difference'
			if within
			else 'not the critical angle above: no whole explanation'
		)
		findings.row('limit equilibrium with the locked-in shear measured', base.withShear(), '°', accept=must, note=note)
		settled, last = base.settled, base.atFailure
		lowest, *_ = self.theory.lowerBound()
		reactions, measured = sum(self.theory.reactions()), sum(last['normal'])
		change = 'raises' if measured > reactions else 'changes'
		findings.text(
			'Why a DEM need not fail at limit equilibrium. '
			'Limit equilibrium takes all shear forces parallel to the line of sliding; '
			f'then R_A + R_B = {reactions:.4f} W. '
			'A wedge that settles elastically goes straight down, so its joints also take shear across that line: '
			f'T_A = {settled["transverse"][0]:+.4f} W and T_B = {settled["transverse"][1]:+.4f} W at the start. '
			'Slip changes that on the way down, but not to zero: in the last stable state it is '
			f'T_A = {last["transverse"][0]:+.4f} W and T_B = {last["transverse"][1]:+.4f} W. '
			f'Such shear uses a little strength, and it {change} the normal forces (R_A + R_B = {measured:.4f} W). '
			f'Limit equilibrium with these T gives {base.withShear():.3f}° instead of {self.limit:.3f}°'
			+ (': the whole difference. ' if within else f', which is not the whole difference to the {base.critical:.3f}° found. ')
			+ f'No history can bring it below {math.degrees(lowest):.2f}° (static theorem).'
		)

	def independence(self, labels, tolerance):
		"""Changes of the critical angle that must be small."""
		for label in labels:
			case = self.case(label)
			change = math.nan if case.failure else case.critical - self.base.critical
			must = self.ofReference((-tolerance, tolerance))
			note = case.failure or case.hops
			self.findings.row(f'change of the critical angle: {label}', change, '°', theory=0, accept=must, note=note)

	def backEdge(self, most):
		"""Reports the back edge's force in the base case, which must not exceed *most*."""
		force = self.base.atFailure['edge']
		note = 'almost zero where stiffness is per area'
		self.findings.row('force of the back edge over W', force, '-', theory=0, accept=self.ofReference((0, most)), note=note)

	def stiffBackEdge(self, quantity, label, note):
		"""The critical angle of the case *label*, in which the back edge bears."""
		case = self.case(label)
		if not case.failure:
			self.findings.row(quantity, case.critical, '°', note=f'the edge carries {case.atFailure["edge"]:.3f} W then; {note}')

	def failedQueries(self):
		self.queries([case for case in [self.base, *self.cases] if not case.failure])

	def settings(self):
		columns = ['setting', 'stable [°]', 'failed [°]', 'ended as', 'change [°]', 'T_A/W', 'T_B/W', 'closed form with T [°]']
		columns += ['back edge/W', 'section/face', 'time steps']
		rows = [self._settingsRow(case) for case in [self.base, *self.cases]]
		self.findings.table('settings', 'What the critical angle depends on (one setting changed at a time)', columns, rows)

	def _settingsRow(self, case):
		if case.failure:
			return [case.label, '', '', case.failure] + 7 * ['']
		forces = case.atFailure
		return [
			case.label,
			f'{case.stable:.3f}',
			f'{case.failed:.3f}',
			case.lastStage(case.result.failed).outcome,
			'' if case is self.base else f'{case.critical - self.base.critical:+.3f}',
			f'{forces["transverse"][0]:+.4f}',
			f'{forces["transverse"][1]:+.4f}',
			f'{case.withShear():.3f}' if forces['edge'] < leastEdgeForce else '',  # it includes two faces only
			f'{forces["edge"]:.1e}',
			f'{min(forces["section"]):.4f}' if case.scene.stiffnessTimes != 'contact' else '',
			case.timeSteps,
		]

	def explainSettings(self):
		"""What the settings table shows, for the reference with all the settings of the full run."""
		change = {case.label: case.critical - self.base.critical for case in self.cases if not case.failure}
		starts = max(abs(change[label]) for label in ('start at 45°', 'start at 40°'))
		self.findings.text(
			'On the settings. '
			'Each face has one contact point, so the normal forces follow from moments too: '
			f'with rotation blocked the answer changes by {change["rotation blocked"]:+.2f}°, and the choice of contact point counts. '
			f'The wedge tilts on its faces: the smaller contact section is {min(self.base.atFailure["section"]):.2f} of its face. '
			f'Stiffness times the present section is softer by that ({change["stiffness times present contact section"]:+.2f}°); '
			'here a face keeps the stiffness of its whole area. '
			'A back edge with a stiffness of its own carries a part of the weight, which limit equilibrium on two planes does not include. '
			'One contact point carries no moment: with damping of 0.3 alone the wedge rocks as it slips, other shear is locked in, '
			'and the answer depends on the path '
			f'({change["damping 0.3"]:+.2f}° and {change["damping 0.3, friction steps 1, 0.02"]:+.2f}° '
			'by two sequences of friction steps); '
			f'rocking damping of the contacts corrects that ({change["damping 0.3, rocking damping 1"]:+.2f}°). '
			'Started at 36°, the wedge slips while it settles, '
			f'which locks in other shear as well ({change["start at 36°"]:+.2f}°); '
			f'starts at 40° and 45° change no more than {starts:.2f}°. '
			'The LP\'s own point is not unique on a face: it jumps, and the wedge drifts away.'
		)

	def figures(self, slid):
		"""Figures of the pictures and plots in the folder; *slid* is the distance in the last one [m]."""
		shear = 'Forces on the faces on the way down; the transverse shear left at the end explains the difference to limit equilibrium'
		super().figures('The wedge between its fixed blocks', f'slid by {slid} m', [('shear.png', shear)])


def plotLockedShear(path, case):
	"""Normal forces and transverse shear over W against friction angle, in the stable states on the way down."""
	stages = sorted((stage for stage in case.result.stages if stage.outcome == 'stable'), key=lambda stage: -stage.level)
	angles = [math.degrees(stage.level) for stage in stages]
	limits = case.given.theory.reactions()
	figure = Figure(figsize=(12, 4.6), layout='constrained')
	left, right = figure.subplots(1, 2)
	for k, (name, color) in enumerate(faceColors.items()):
		left.plot(angles, [stage.measured['normal'][k] for stage in stages], '.-', color=color, label=f'face {name}')
		left.axhline(limits[k], color=color, linestyle='--', linewidth=1, label=f'closed form, no transverse shear: {limits[k]:.4f}')
		right.plot(angles, [stage.measured['transverse'][k] for stage in stages], '.-', color=color, label=f'face {name}')
	left.set(ylabel='normal force / W', title='normal forces', ylim=(0, 1))
	right.set(ylabel='transverse shear force / W (up the face: positive)', title='transverse shear: zero in the closed form')
	right.axhline(0, color='0.5', linewidth=1)
	for axes in (left, right):
		axes.set_xlabel('friction angle [°]')
		axes.invert_xaxis()
		axes.legend()
	figure.savefig(path, dpi=130)
