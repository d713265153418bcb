# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of simulation D, a wedge that hangs between joints in a roof: cases, with both ways of stress, and their report.

Angles in degrees. α is the joints' inclination from the vertical, σ_h the horizontal stress, ΣH the sum of the horizontal forces on the
wedge, σ_eff the stress that would give it, A the area of a joint with the wedge, A_v that of a vertical joint between two outer blocks.
"""

import math

import numpy as np
from matplotlib.figure import Figure

from ..wedges.blockGeometry import touchingRoofBlocks
from ..wedges.study import WedgeCase, WedgeReport
from ..wedges.theory import (
	horizontalForceUnderWeight,
	jointClosure,
	jointForces,
	roofWedgeConstantNormal,
	roofWedgeFrictionAngle,
	sideAreaOf,
	stressShare,
)
from .scene import RoofWedge

__all__ = ['RoofWedgeCase', 'RoofWedgeReport', 'areEvenlySpread', 'frontView', 'plotStressShare', 'touchingCases']

jointForcesSet, boundaryStress = 1, 2
"""The two ways of stress, see RoofWedge."""
runColor, paperColor = '#1d4e79', '#c8451b'


fractions = {2: 'half', 3: 'a third', 4: 'a quarter'}
"""One over a number of joints, in words."""


def areEvenlySpread(joints):
	"""Whether the closed forms hold for a wedge's joints: they have the same dip and area and lie evenly around the vertical."""
	normals, areas = np.array([joint.normal for joint in joints]), np.array([joint.area for joint in joints])
	azimuths = np.sort(np.arctan2(normals[:, 1], normals[:, 0]))
	turns = np.diff(azimuths, append=azimuths[0] + 2 * math.pi)
	same = np.ptp(normals[:, 2]) < 1e-6 and np.ptp(areas) < 1e-6 * areas.max()
	return len(joints) > 1 and bool(same and np.ptp(turns) < 1e-6)


class RoofWedgeCase(WedgeCase):
	"""See WedgeCase. Searches at once.

	:param given: the options; besides WedgeCase's *horizontal_stress*
	:param int way: 1: joint forces set; 2: boundary stress
	:param progress: a tqdm bar
	:raises RuntimeError: if there is no answer

	:ivar list closures: how far each outer block has moved [m]; empty with way 1
	:ivar list forces: (normal, shear) of each joint before the weight came on [N]
	:ivar float horizontal: ΣH with the weight, before the reduction [N]
	:ivar float inclination: α [rad]
	:ivar float stressShare: σ_eff/σ_h before the weight came on
	"""

	def __init__(self, given, label, way, progress, **changes):
		super().__init__(given, label, RoofWedge, **{'horizontalStress': given.horizontal_stress, **changes})
		self.way, scene = way, self.scene
		if way == jointForcesSet:
			scene.setJointForces()
			self.closures = []
		else:
			self.closures = scene.pressByBoundary(given.stable_speed, given.most_steps)
		self.forces = [tuple(math.sqrt(part.dot(part)) for part in scene.forceFrom(joint.block)) for joint in scene.joints]
		self.inclination = scene.inclinations[0]
		self.stressShare = scene.horizontalForce() / self.fullForce
		self.search(progress, scene.horizontalForce)
		self.horizontal = self.result.stages[0].measured

	@property
	def area(self):
		"""A [m²]."""
		return self.scene.joints[0].area

	@property
	def fullForce(self):
		"""ΣH [N] where the wedge gets all of σ_h."""
		return self.scene.horizontalStress * sum(joint.area for joint in self.scene.joints) * math.cos(self.inclination)

	@property
	def stiffnessRatio(self):
		return self.scene.shearStiffness / self.scene.normalStiffness

	@property
	def byFace(self):
		"""Whether stiffnesses go by area, as the closed form of σ_eff/σ_h has it."""
		return self.scene.stiffnessTimes == 'face'

	@property
	def shareFormula(self):
		"""σ_eff/σ_h by the closed form."""
		return stressShare(self.area, self.scene.sideArea, self.inclination, self.stiffnessRatio)

	@property
	def fromForce(self):
		"""α + atan(W/ΣH) with ΣH as measured before the reduction."""
		return math.degrees(roofWedgeFrictionAngle(self.scene.weight, self.horizontal, self.inclination))

	@property
	def closedForm(self):
		"""α + atan(W/ΣH) with ΣH from σ_h, what the blocks' own joints take, and the elastic settlement."""
		scene = self.scene
		area = sum(joint.area for joint in scene.joints)
		stiffnesses = scene.normalStiffness * area, scene.shearStiffness * area
		ready = horizontalForceUnderWeight(scene.weight, self.shareFormula * self.fullForce, self.inclination, *stiffnesses)
		return math.degrees(roofWedgeFrictionAngle(scene.weight, ready, self.inclination))

	def shareFor(self, angle, gravity=None):
		"""σ_eff/σ_h with which the wedge falls at *angle*, with its own gravity or another one [m/s²]."""
		weight = self.scene.weight * (gravity or self.scene.gravity) / self.scene.gravity
		return weight / math.tan(math.radians(angle) - self.inclination) / self.fullForce


def touchingCases(given, base, paper, shares, progress):
	"""Cases with boundary stress on blocks that touch each other around a threefold wedge.

	:param RoofWedgeCase base: where they do not
	:param float paper: the paper's angle: the first case is what it would need; None: no such case
	:param shares: A_v/A of the others
	:param progress: a tqdm bar; its total grows by their number
	"""
	areas = {f'A_v = {share:g} A': share * base.area for share in shares}
	if paper is not None:
		needed = base.shareFor(paper)
		areas = {f'σ_eff = {needed:.4f} σ_h, which {paper}° needs': sideAreaOf(base.area, needed, base.inclination)} | areas
	progress.total += len(areas)
	return [
		RoofWedgeCase(given, label, boundaryStress, progress, blocks=touchingRoofBlocks(given.blocks, area), sideArea=area)
		for label, area in areas.items()
	]


class RoofWedgeReport(WedgeReport):
	"""See WedgeReport.

	:param list ways: cases that differ in the way of stress, and in gravity; the first is the base
	:param list cases: each with another setting
	:param list touching: of touchingCases()
	:param float tolerance: of critical angles against closed forms, where half the last friction step is not more
	"""

	def __init__(self, findings, given, ways, cases, touching, tolerance):
		super().__init__(findings, given, ways[0], cases)
		self.ways, self.touching = ways, touching
		self.tolerance = max(tolerance, given.steps[-1] / 2)
		self.symmetric = areEvenlySpread(self.base.scene.joints)

	def must(self, value, half):
		"""Where the closed forms hold, which assume sharp edges."""
		known = self.symmetric and self.given.stiffness_times == 'face' and self.given.contact_model == 'boon2012'
		return (value - half, value + half) if known else None

	def criticalAngles(self, papers, known):
		"""Both ways beside the closed forms, with σ_h and with ΣH as measured.

		:param dict papers: the paper's angle by way
		:param dict known: angle of the closed form by gravity, for the reference
		"""
		alpha = f'{math.degrees(self.base.inclination):.4g}°'
		for case in self.ways:
			gravity = case.scene.gravity
			self.findings.row(
				f'critical friction angle, {case.label}',
				case.critical,
				'°',
				self.ofReference(papers[case.way]),
				case.closedForm if self.symmetric else None,
				self.must(case.closedForm, self.tolerance),
				f'middle of a step of {case.stable - case.failed:.3f}°'
				+ ('; the paper\'s blocks touch each other, see below' if self.touching and case.way == boundaryStress else ''),
			)
			self.findings.row(
				f'the same against {alpha} + atan(W/ΣH), {case.label}',
				case.critical,
				'°',
				theory=case.fromForce if self.symmetric else None,
				accept=(case.fromForce - self.tolerance, case.fromForce + self.tolerance) if self.symmetric else None,
				note=f'ΣH = {case.horizontal:.1f} N measured before the reduction',
			)
			if self.given.reference and case.way == jointForcesSet:
				accept = self.must(known[gravity], 1e-4)
				self.findings.row(f'closed form, g = {gravity:g} m/s²', case.closedForm, '°', theory=known[gravity], accept=accept)

	def prism(self, case):
		"""A wedge between two joints beside the same closed form: shear on its two faces alone holds it, and keeps it from turning."""
		known = self.given.stiffness_times == 'face' and self.given.contact_model == 'boon2012'
		self.findings.row(
			f'critical friction angle, {case.label}',
			case.critical,
			'°',
			None,
			case.closedForm,
			(case.closedForm - self.tolerance, case.closedForm + self.tolerance) if known else None,
			'not in the paper, whose friction at one point of each face lets it turn out of the roof',
		)

	def jointForces(self):
		"""Reports the joint forces of the base case, as set, and how that was done."""
		normal, shear = jointForces(self.given.horizontal_stress, self.base.area, self.base.inclination)
		for name, ours, closed in zip(('normal', 'shear'), self.base.forces[0], (normal, shear), strict=True):
			self.findings.row(f'{name} force of a joint as set', ours, 'N', theory=closed, accept=self.must(closed, 1e-6 * normal))
		self.findings.text(
			'How the joint forces are set (way 1). '
			'The fixed blocks are moved in along the joints\' normals until the overlap gives the normal force; '
			'the shear force, up-dip on the wedge, is written into the contacts; then the wedge is freed and its weight comes on. '
			'Way 2 pushes each outer block with the stress on the joint\'s projection, '
			'lets it move horizontally but neither turn nor rise, '
			'fixes it when it is at rest, and then gives the wedge its weight.'
		)

	def constantNormal(self, known):
		"""The error of assuming a constant normal force.

		:param known: (value, half the range) of the angle it would give for the reference
		"""
		base = self.base
		number = len(base.scene.joints)
		normal, _ = jointForces(self.given.horizontal_stress, base.area, base.inclination)
		wrong = math.degrees(roofWedgeConstantNormal(base.scene.weight, number * normal, base.inclination))
		value, half = known
		accept = self.ofReference((value - half, value + half))
		self.findings.row('a constant normal force would give, wrongly', wrong, '°', theory=self.ofReference(value), accept=accept)
		if not self.symmetric:
			return
		part = fractions.get(number, f'1/{number}')
		equal = (
			'With kn = ks the settlement under W opens the joints by as much horizontal force as their shear adds, '
			'so ΣH stays what the stress made it. '
		)
		self.findings.text(
			'Why φ = α + atan(W/ΣH). '
			f'At the end each joint\'s force has a horizontal part, {part} of ΣH, and lifts {part} of W; '
			'it is inclined to the joint\'s normal by α plus the angle of lift. '
			+ (equal if base.stiffnessRatio == 1 else 'The settlement under W opens the joints. ')
			+ f'A constant normal force, without that opening, would give {wrong:.3f}°.'
		)

	def closure(self):
		"""Reports the closure of the joints under boundary stress."""
		scene = self.base.scene
		case = next(case for case in self.ways if case.way == boundaryStress and case.scene.gravity == scene.gravity)
		if scene.stiffnessTimes == 'face':
			closed = 1e3 * jointClosure(self.given.horizontal_stress, case.inclination, scene.normalStiffness, scene.shearStiffness)
			accept = self.must(closed, 2e-3 * closed)
			self.findings.row('way 2: closure of the joints', 1e3 * max(case.closures), 'mm', theory=closed, accept=accept)

	def independence(self, labels):
		"""Changes of the critical angle that must be small: two angles that agree may still be found one friction step apart."""
		half = max(self.tolerance, (1 + 1e-9) * self.given.steps[-1])
		for label in labels:
			change = self.case(label).critical - self.base.critical
			accept = self.must(0, half)
			self.findings.row(f'change of the critical angle: {label}', change, '°', theory=0, accept=accept)

	def touchingBlocks(self, paper, tolerance):
		"""The stress that blocks which touch each other leave to the wedge, and its critical angle.

		:param float paper: its angle with boundary stress, for the case made for it
		:param float tolerance: of σ_eff/σ_h
		"""
		alpha = f'{math.degrees(self.base.inclination):.4g}°'
		for case in self.touching:
			share = case.shareFormula if case.byFace else None
			accept = self.must(case.shareFormula, tolerance)
			self.findings.row(f'blocks that touch: σ_eff/σ_h, {case.label}', case.stressShare, '-', theory=share, accept=accept)
			agree = self.must(case.fromForce, self.tolerance)
			self.findings.row(
				f'blocks that touch: critical angle, {case.label}',
				case.critical,
				'°',
				self.ofReference(paper) if 'needs' in case.label else None,
				case.closedForm if case.byFace else None,
				agree,
				f'A_v = {case.scene.sideArea:.4f} m²; {"must agree with " if agree else ""}{alpha} + atan(W/ΣH) = {case.fromForce:.3f}°',
			)

	def failedQueries(self):
		self.queries([*self.ways, *self.cases, *self.touching])

	def settings(self):
		columns = ['setting', 'stable [°]', 'failed [°]', 'ended as', 'change [°]', 'ΣH [N]', 'α + atan(W/ΣH) [°]', 'closed form [°]']
		rows = [
			[
				case.label,
				f'{case.stable:.3f}',
				f'{case.failed:.3f}',
				case.result.stages[-1].outcome,
				'' if case is self.base else f'{case.critical - self.base.critical:+.3f}',
				f'{case.horizontal:.1f}',
				f'{case.fromForce:.3f}',
				f'{case.closedForm:.3f}',
				case.timeSteps,
			]
			for case in [*self.ways, *self.cases]
		]
		caption = 'What the critical angle depends on (one setting changed at a time, way 1), and both ways'
		self.findings.table('settings', caption, [*columns, 'time steps'], rows)

	def explainPaper(self, paper):
		"""The cause of the paper's angle with boundary stress, for the reference."""
		base, first = self.base, self.touching[0]
		self.findings.text(
			f'The cause of the paper\'s {paper}° with boundary stress. '
			'Where the blocks around the wedge touch each other over vertical joints of area A_v, '
			'these are stiffer than their share of the stress and take more than that from the boundary: '
			'σ_eff/σ_h = (A + 2A_v)/(A + 3A_v) for rigid blocks and equal stiffnesses, confirmed by the runs below. '
			f'{paper}° asks for σ_eff = {base.shareFor(paper, 10):.4f} σ_h with g = 10 m/s², {base.shareFor(paper, 9.81):.4f} with 9.81; '
			f'blocks with A_v = {first.scene.sideArea / base.area:.3f} A give the first. '
			'The paper does not say how large its blocks are, so this shows that the cause is sufficient, not that it was the actual one.'
		)

	def touchingTable(self):
		columns = ['blocks', 'A_v [m²]', 'closure [mm]', 'ΣH [N]', 'σ_eff/σ_h measured', 'σ_eff/σ_h formula', 'stable [°]', 'failed [°]']
		rows = [
			[
				case.label,
				f'{case.scene.sideArea:.4f}',
				f'{1e3 * max(case.closures):.4f}',
				f'{case.horizontal:.1f}',
				f'{case.stressShare:.5f}',
				f'{case.shareFormula:.5f}' if case.byFace else '',
				f'{case.stable:.3f}',
				f'{case.failed:.3f}',
				f'{case.fromForce:.3f}',
			]
			for case in self.touching
		]
		caption = 'Boundary stress on blocks that touch each other around the wedge'
		self.findings.table('touching', caption, [*columns, 'α + atan(W/ΣH) [°]'], rows)

	def figures(self, fallen):
		"""Figures of the pictures and plots in the folder; *fallen* is the distance in the last one [m]."""
		if self.touching:
			caption = 'Boundary stress on blocks that touch each other: the wedge gets less of it, and needs more friction'
			self.findings.figure('touching.png', caption)
		super().figures('The wedge in the roof, seen from below without the block before it', f'fallen by {fallen} m')


def frontView(case, fall):
	"""Options of picture(): the wedge and its way down by *fall* [m], without the block that stands before it."""
	corners = case.wedgeCorners()
	middle, half = corners.mean(axis=0), np.ptp(corners, axis=0) / 2
	box = [middle + 1.3 * half * (x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
	camera = np.array([-0.25, -1, -0.35])
	front = case.scene.ids[max(case.scene.joints, key=lambda joint: -joint.normal.dot(camera)).block]
	return {
		'frame': box + [corners[corners[:, 2].argmin()] - (0, 0, fall)],
		'view': tuple(camera),
		'fixed': lambda body: 'hidden' if body.id == front else 'glass',
	}


def plotStressShare(path, touching, paper):
	"""Critical angle against size of the joints between the outer blocks: runs, closed form and the paper's angle."""
	case = touching[0]
	area, inclination = case.area, case.inclination
	ratios = np.linspace(0, 1.1 * max(c.scene.sideArea for c in touching) / area, 200)
	forces = [case.fullForce * stressShare(area, ratio * area, inclination, case.stiffnessRatio) for ratio in ratios]
	angles = [math.degrees(roofWedgeFrictionAngle(case.scene.weight, force, inclination)) for force in forces]
	figure = Figure(figsize=(7, 4.6), layout='constrained')
	axes = figure.subplots()
	if case.byFace:
		axes.plot(ratios, angles, color='0.3', linewidth=1.2, label='closed form: (A + 2A_v)/(A + 3A_v) of the stress')
	runs = [c.scene.sideArea / area for c in touching], [c.critical for c in touching]
	axes.plot(*runs, 'o', color=runColor, label='runs with boundary stress')
	axes.axhline(paper, color=paperColor, linestyle='--', linewidth=1, label=f'the paper with boundary stress, {paper}°')
	axes.set(xlabel='A_v / A: joint between two outer blocks over joint with the wedge', ylabel='critical friction angle [°]')
	axes.legend()
	figure.savefig(path, dpi=130)
