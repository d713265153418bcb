# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of collisions' energy: measurements, rows, tables, figures and texts of its findings."""

import math

import numpy as np
from tqdm import tqdm

from .meetings import Bounces, Collisions, lastEnergies, meetings, spread
from .plots import plotBounces, plotCorners, plotDamping, plotSteps
from .scene import Contact, freeFlight

__all__ = ['EnergyStudy', 'PeerFailed']

paper, sharp, perArea = "paper's model", "paper's model, corner radius 0", "paper's model, stiffness per area"
surface, spheres = 'contact surface', "YADE's spheres"
ours = {
	spheres: Contact('spheres'),
	surface: Contact('surface'),
	sharp: Contact('boon2012', corner=0),
	perArea: Contact('perArea'),
	paper: Contact('boon2012'),
}
surfaceMedian = 2e-5
"""Largest median error of the contact surface at 200 steps in half a period; (200/n)² times as much at n steps."""

columns = ['median', 'root mean square', 'largest', 'largest gain', 'collisions that gain', 'of']


def cells(s):
	return [s['median'], s['rms'], s['largest'], s['gain'], s['gaining'], s['number']]


class PeerFailed(Exception):
	"""The reason why there is no result."""


class EnergyStudy:
	"""All measurements, in the order of the report.

	:param given: the options: quick, number, seed
	:param findings: a Findings
	:param dict peers: {name as in the plots: function of the study's name, a time limit [s] and settings, which returns what
	    Collisions.run() or Bounces.run() does, or raises PeerFailed}
	"""

	def __init__(self, given, findings, peers):
		self.given, self.findings, self.quick, self.peers = given, findings, given.quick, peers
		self.meetings = meetings(given.number, given.seed)
		self.momentum = self.dampedMomentum = 0.0

	def collide(self, how, steps, overlap=0.02):
		found = Collisions(self.meetings, how, steps, overlap).build().run()
		if how.damping == 0:
			self.momentum = max(self.momentum, *found['momentum'], *found['angularMomentum'])
		else:
			self.dampedMomentum = max(self.dampedMomentum, *found['angularMomentum'])
		return found

	def peer(self, name, study, **request):
		"""None, and a row that says why, where there is no result."""
		try:
			return self.peers[name](study, 120 if self.quick else 240, **request)
		except PeerFailed as error:
			self.findings.row(f'{name}: {study}', str(error), note='left out of tables and figures')
			return None

	# ------------------------------------------------------------------------------------------------------- time step

	def timeSteps(self):
		steps = (25, 50, 100) if self.quick else (25, 50, 100, 200)
		found = {name: {n: self.collide(how, n) for n in steps} for name, how in tqdm(ours.items(), desc='time steps', disable=None)}
		fewer = {'number': min(self.given.number, 20 if self.quick else 100), 'overlap': 0.02, 'duration': 20 if self.quick else 40}
		for name in self.peers:
			results = {}
			for n in steps[:1] if self.quick else steps[:2]:
				result = self.peer(name, 'collisions', steps=n, seed=self.given.seed, **fewer)
				if result is None:
					break
				results[n] = result
			if results:
				found[name] = results
		spreads = {name: {n: spread(result) for n, result in bySteps.items()} for name, bySteps in found.items()}
		self.findings.table(
			'time_steps',
			'Energy error of random collisions of two regular solids without friction and damping, over the energy before: by time steps '
			'in '
			'half a period of the contact. Overlap of a central impact 2 % of the inscribed radius of a cube. Stiffness per area, '
			'PotentialBlock and Polyhedra: the same force for a tenth of a face, softer at corners.',
			['contact', 'steps', *columns, 'mean time in contact [half periods]'],
			[[name, n, *cells(s), found[name][n]['contactTime']] for name, bySteps in spreads.items() for n, s in bySteps.items()],
		)
		plotSteps(self.findings.folder / 'time_steps.png', spreads)
		self.findings.figure(
			'time_steps.png', "An error that falls with the time step is the integrator's; one that does not is the contact's."
		)
		self._rowsOfSteps(spreads, steps)
		self._samePhysics(found)
		self.spreads = spreads

	def _rowsOfSteps(self, spreads, steps):
		row, first, last = self.findings.row, steps[0], steps[-1]
		row(f'{paper}: median error', spreads[paper][last]['median'], accept=(0.08, 0.25), note='a trial before this study: 0.15')
		row(
			f'{paper}: largest error',
			spreads[paper][last]['largest'],
			accept=(0.5, 5),
			note='a trial before this study: 3.4; depends on the sample',
		)
		ratio = spreads[paper][first]['median'] / spreads[paper][last]['median']
		row(
			f'{paper}: median at {first} steps over that at {last}',
			ratio,
			theory=1,
			accept=(0.9, 1.1),
			note='smaller time steps do not help',
		)
		fall = spreads[surface][first]['rms'] / spreads[surface][last]['rms']
		square = (last / first) ** 2
		row(
			f'{surface}: root mean square at {first} steps over that at {last}',
			fall,
			theory=square,
			accept=(square / 2, math.inf),
			note="falls with the square of the time step or faster: the error is the integrator's",
		)
		row(
			f'{spheres}: largest error over (ω Δt)²/4, at any time step',
			max(s['largest'] / (math.pi / n) ** 2 * 4 for n, s in spreads[spheres].items()),
			theory=1,
			accept=(0, 1),
			note='bound of the leapfrog scheme on a spring that is met and left within a step',
		)
		for n in steps:
			row(
				f'{surface}: median error at {n} steps', spreads[surface][n]['median'], theory=0, accept=(0, surfaceMedian * (200 / n) ** 2)
			)
		row(
			f'{sharp}: median error at 100 steps',
			spreads[sharp][100]['median'],
			accept=(0, 0.3 * spreads[paper][100]['median']),
			note="normal from the linear program's dual (status normalFromDual): nearly a gradient while overlaps are small",
		)

	def _samePhysics(self, found):
		"""PotentialBlock is another program of the paper's model, with a stiffness per area."""
		block = found.get("YADE's PotentialBlock")
		if not block:
			return
		n = max(block)
		both = [(np.array(result['error']), np.array(result['parted'])) for result in (block[n], found[perArea][n])]
		number = len(both[0][0])
		good = both[0][1] & both[1][1][:number]
		difference = np.median(np.abs(both[0][0] - both[1][0][:number])[good])
		self.findings.row(
			"PotentialBlock against ours, stiffness per area: median difference of a collision's error",
			difference,
			theory=0,
			accept=(0, 5e-3),
			note='two programs of one model: the error is the model\'s',
		)

	# ---------------------------------------------------------------------------------------- corner radius and overlap

	def corners(self):
		corners = (0, 0.03, 0.1, 0.3) if self.quick else (0, 0.003, 0.01, 0.03, 0.1, 0.2, 0.5)
		overlaps = (0.005, 0.1) if self.quick else (0.005, 0.02, 0.1)
		cases = tqdm([(o, c) for o in overlaps for c in corners], desc='corner radii', disable=None)
		found = {o: {} for o in overlaps}
		for overlap, corner in cases:
			found[overlap][corner] = spread(self.collide(Contact('boon2012', corner), 50, overlap))
		smooth = {overlap: spread(self.collide(Contact('surface'), 50, overlap)) for overlap in overlaps}
		self.findings.table(
			'corner_radii',
			'The same collisions by corner radius (over the inscribed radius) and overlap of a central impact (over half a cube\'s '
			'edge), 50 steps in '
			'half a period.',
			['contact', 'overlap', 'corner radius', *columns],
			[[paper, overlap, corner, *cells(s)] for overlap, byCorner in found.items() for corner, s in byCorner.items()]
			+ [[surface, overlap, '', *cells(s)] for overlap, s in smooth.items()],
		)
		plotCorners(self.findings.folder / 'corner_radii.png', found)
		self.findings.figure('corner_radii.png', 'Corner radius 0 stands for the direction of the linear program\'s dual.')
		least = overlaps[0]
		self.findings.row(
			f'{paper}: median error, default corner radius over 0, overlap {100 * least:g} %',
			found[least][0.1]['median'] / found[least][0]['median'],
			accept=(5, math.inf),
			note='the error comes from averaging normals at corners, so from the corner radius',
		)

	# --------------------------------------------------------------------------------------------------------- damping

	def damping(self):
		fractions = (0, 0.05, 0.2, 1) if self.quick else (0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1)
		found = {}
		for name in tqdm((paper, sharp, surface), desc='damping', disable=None):
			how = ours[name]
			found[name] = {z: spread(self.collide(Contact(how.model, how.corner, contactDamping=z), 50)) for z in fractions}
		global_ = {d: spread(self.collide(Contact('boon2012', damping=d), 50)) for d in ((0.2,) if self.quick else (0.1, 0.2, 0.4))}
		self.findings.table(
			'damping',
			'Energy left after a collision, over that before, by damping: of the contact, as a fraction of critical, and YADE\'s own '
			'(NewtonIntegrator.damping). A central impact on a linear spring leaves exp(−2πζ/√(1 − ζ²)).',
			['contact', "contact's damping", "YADE's damping", 'least', 'median', 'most', 'collisions that gain', 'of'],
			[[name, z, 0, *s['left'], s['gaining'], s['number']] for name, byDamping in found.items() for z, s in byDamping.items()]
			+ [[paper, 0, d, *s['left'], s['gaining'], s['number']] for d, s in global_.items()],
		)
		plotDamping(self.findings.folder / 'damping.png', found, centralImpact)
		self.findings.figure('damping.png', 'Above 1 a collision has gained energy.')
		for name, byDamping in found.items():
			enough = [z for z, s in byDamping.items() if s['gaining'] == 0]
			least = next((z for z in fractions if all(byDamping[y]['gaining'] == 0 for y in fractions if y >= z)), None)
			self.findings.row(
				f'{name}: least contact damping at which no collision gains',
				'none up to 1' if least is None else least,
				'fraction of critical',
				note=f'of {list(fractions)}; gaining: {[s["gaining"] for s in byDamping.values()]}'
				+ ('' if least is not None or not enough else '; not monotonic'),
			)
		z = fractions[1]
		self.findings.row(f'{surface}: collisions that gain at {z:g} of critical', found[surface][z]['gaining'], accept=(0, 0))
		self.damped = found

	# ------------------------------------------------------------------------------------------------------------ cubes

	def bounces(self):
		seconds, number = (8, 8) if self.quick else (40, 16)
		steps = 25 if self.quick else 50
		found = {}
		for name, how in tqdm(ours.items(), desc='bounces', disable=None):
			found[name] = Bounces(how, steps, number).build().run(seconds)
		finer = Bounces(ours[surface], 2 * steps, number).build().run(seconds)
		for name in self.peers:
			result = self.peer(name, 'bounces', number=2 if self.quick else 4, steps=25, seconds=min(seconds, 20))
			if result:
				found[name] = result
		rows = []
		for name, result in [*found.items(), (f'{surface}, {2 * steps} steps', finer)]:
			left = lastEnergies(result)
			rows.append(
				[name, result['time'][-1], len(left), *np.quantile(left, (0, 0.5, 1)), np.nanmax(result['energy']), max(result['drift'])]
			)
		self.findings.table(
			'bounces',
			f'Cubes that fall 1 m onto a floor, turned at random, and bounce there without friction and damping ({steps} steps in half a '
			'period, PotentialBlock '
			'and Polyhedra 25, of the stiffness on a tenth of a face: at corners they are softer, so their steps finer): energy at the '
			'end and at most, over that at the start; way across the floor, which should be zero.',
			['contact', 'time [s]', 'cubes', 'least at the end', 'median', 'most', 'most at any time', 'largest way across [m]'],
			rows,
		)
		plotBounces(self.findings.folder / 'bounces.png', found)
		self.findings.figure('bounces.png', 'Energy of each cube (their number in brackets) over that at the start.')
		byName = {row[0]: row for row in rows}
		self.findings.row(
			f'{paper}: most energy of a bouncing cube at the end, over the start',
			byName[paper][5],
			accept=(1.1, math.inf),
			note=f'median {byName[paper][4]:.3g} after {seconds} s; a trial before this study: 1.12 to 1.75 after 40 s',
		)
		self.findings.row(
			f'{paper}: largest way across a level floor without friction',
			byName[paper][7],
			'm',
			theory=0,
			note='its normal is not the floor\'s',
		)
		self.findings.row(
			f'{surface}: largest way across a level floor without friction', byName[surface][7], 'm', theory=0, accept=(0, 1e-6)
		)
		off = {n: float(np.median(np.abs(lastEnergies(result) - 1))) for n, result in ((steps, found[surface]), (2 * steps, finer))}
		for n, error in off.items():
			self.findings.row(
				f'{surface}: median of |energy at the end over the start − 1|, {n} steps',
				error,
				theory=0,
				accept=(0, 0.05 if n == steps else 0.5 * off[steps]),
			)
		self.bounced = byName

	def integrator(self):
		"""A body alone, so that its error is not attributed to a contact."""
		rows = [
			[*half, turn, *freeFlight(half, turn, 5000)] for half in ((0.5, 0.5, 0.5), (0.5, 0.35, 0.25)) for turn in (1e-3, 1e-2, 1e-1)
		]
		self.findings.table(
			'integrator',
			"YADE's integrator alone: a box turning freely for 5000 steps.",
			['half-lengths [m]', '', '', 'turn in a step [rad]', 'relative change of energy', 'of angular momentum'],
			rows,
		)
		equal = [max(row[4:]) for row in rows if row[0] == row[2]]
		self.findings.row('free flight, equal moments: change of energy or angular momentum', max(equal), theory=0, accept=(0, 1e-12))
		unequal = next(row for row in rows if row[0] != row[2] and row[3] == 1e-2)
		self.findings.row(
			'free flight, unequal moments, 0.01 rad a step: change of energy',
			unequal[4],
			theory=0,
			note=f'of angular momentum {unequal[5]:.1g}: regular solids do not have this error',
		)

	def _advice(self):
		"""Conclusions for users, with this run's figures."""
		steps = max(self.spreads[paper])
		most, gentle = self.spreads[paper][steps], self.spreads[sharp][steps]
		damped = {z: s for z, s in self.damped[paper].items() if z > 0}
		left = '; '.join(
			f'at {z:g} of critical {s["gaining"]} of {s["number"]} gain, up to {100 * (s["left"][2] - 1):.0f} %'
			for z, s in damped.items()
			if s['gaining']
		)
		cubes = self.bounced[paper]
		self.findings.text(
			f"Where it matters. Two solids that meet without friction and damping part with {100 * most['median']:.0f} % more or less "
			"energy in the median, up to "
			f"{100 * most['largest']:.0f} %, at every time step: the paper's force is not the gradient of an energy. A cube that bounces "
			"on a floor for "
			f'{cubes[1]:.0f} s ends with {cubes[3]:.2f} to {cubes[5]:.2f} times its energy, and the level floor pushes it {cubes[7]:.0f} '
			'm aside. So do not use it for '
			'rebounds, granular gases, vibration, or whatever depends on a coefficient of restitution. Bodies that settle lose more to '
			'friction and damping than '
			"contacts give: the paper's simulations B to F (./run paper) hold their closed forms with it."
		)
		self.findings.text(
			f'Effect of damping. Damping of the contact lowers energy on average, but not in every collision: {left}. With corner radius 0 '
			'the median error is '
			f"{100 * gentle['median']:.1f} % and falls with the overlap; but then the normal jumps where the nearest feature changes "
			"(study of the contact's path). "
			"The contact surface has only the integrator's error. YADE's own damping (NewtonIntegrator.damping) changes "
			"angular momentum as well."
		)
		if all(name in self.bounced for name in self.peers):
			self.findings.text(
				"YADE's Polyhedra (overlap volume) conserve energy on a level floor, where their normal is the floor's, but not between "
				"two solids; its "
				"PotentialBlock is the paper's model, and has the error of ours with a stiffness per area."
			)

	def all(self):
		self.timeSteps()
		self.corners()
		self.damping()
		self.bounces()
		self.integrator()
		row = self.findings.row
		row(
			'largest change of momentum or angular momentum in a collision',
			self.momentum,
			theory=0,
			accept=(0, 1e-8),
			note='mass × speed is 1',
		)
		row(
			"the same of angular momentum with YADE's own damping",
			self.dampedMomentum,
			theory=0,
			note='NewtonIntegrator.damping changes force and torque of each body by themselves',
		)
		self._advice()


def centralImpact(damping):
	"""Energy left over that before, for a spring and dashpot."""
	return math.exp(-2 * math.pi * damping / math.sqrt(1 - damping**2)) if damping < 1 else 0.0
