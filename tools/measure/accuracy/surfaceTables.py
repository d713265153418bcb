# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and limits of surfaces.py: floor × contact × stiffness rule × body, and what must stay as it is."""

import dataclasses
import math

from surfaceStudy.edges import drop, edgeCarries, gapHolds, onStep, pressedPast, restOverEnd, roll
from surfaceStudy.measures import cross, rest, slideDown, stop
from tabulate import tabulate
from tqdm import tqdm
from yade import Quaternion, Vector3

__all__ = ['SurfaceStudy', 'contacts', 'rules']

sliding = 2e-3
"""Largest error of the speed kept, of direction [rad], and of spin times half length over speed, on floors without friction."""
braking = 5e-3
"""Largest error of a distance with friction."""
evenDepth = 0.05
"""Depth at rest across a joint over that on one piece: largest difference to 1. A body on unequal pieces leans a little."""
rolling = 0.05
"""Difference of ways of a rolling body on plates and on one slab, over the way: impacts on a joint are those on two springs."""

tilts = [
	*(('cube', 'y', angle) for angle in (0.5, 2, 5, 15, 30, 45)),
	*(('cube', 'x', angle) for angle in (2, 15, 45)),
	*(('icosahedron', 'y', 20), ('hull', 'y', 10)),
]
"""Body, axis and angle [°] by which it is turned from lying on a face."""

default = 'surface'
contacts = {default: {}, 'boon2012': {'contactModel': 'boon2012'}}
"""Name → attributes of the contact functors."""
rules = {'per contact': False, 'per area': True}


@dataclasses.dataclass
class Case:
	"""One row of the table of crossings."""

	floor: str
	body: str
	contact: str
	rule: str
	crossing: object
	depth: float


class SurfaceStudy:
	"""All measurements, in the order of the report; the limits are those of the default contact, others are shown beside it."""

	def __init__(self, findings, quick):
		self.findings, self.quick, self.cases = findings, quick, []

	def variants(self):
		return [(name, rule) for name in contacts for rule in rules]

	def worst(self, quantity, values, limit, note='', unit='', theory=0):
		"""A row for each contact and stiffness rule.

		:param values: list of (contact's name, rule, error)
		"""
		for name, rule in self.variants():
			own = [abs(error) for n, r, error in values if (n, r) == (name, rule)]
			if own:
				error = math.nan if any(map(math.isnan, own)) else max(own)
				accept = (0, limit) if name == default else None
				self.findings.row(f'{quantity}: {name}, {rule}', error, unit, theory=theory, accept=accept, note=note)

	def others(self):
		"""All but the crossings."""
		self.speeds()
		self.joints()
		self.tilted()
		self.friction()
		self.edges()
		self.impacts()
		self.rolls()

	def crossings(self):
		"""The table: floor × body × contact × rule."""
		floors = ('slab', 'wall', 'plates', 'oblique', 'boxes', 'facets', 'mesh', 'bricks', 'rock')
		if self.quick:
			floors = ('slab', 'plates', 'facets', 'rock')
		bodies = ('cube', 'icosahedron') if self.quick else ('cube', 'box', 'tetrahedron', 'dodecahedron', 'icosahedron', 'hull')
		flat = ('square',) if self.quick else ('square', 'polygon')
		pairs = [(floor, body) for floor in floors for body in bodies]
		pairs += [(floor, body) for floor in ('slab', 'plates', 'oblique') for body in flat]
		for floor, body in tqdm(pairs, desc='floors', disable=None):
			for name, rule in self.variants():
				self._case(floor, body, name, rule)
		for floor in [f for f in floors if f != 'rock']:  # a comparison; the sphere has one contact and one rule
			self._case(floor, 'sphere', default, 'per contact')
		self.findings.text(
			'Bodies with a face down, about 0.5 m wide, slide at 1 m/s without friction over three joints 1 m apart. Their stiffness follows '
			'from the depth at rest on one piece, 0.25 mm, their time step from the stiffnesses (0.15/ω): an ordinary simulation. '
			'normalDamping 0.3, everything else as by default. Depth: at rest across a joint, over that on a slab.'
		)
		self.findings.table(
			'crossings',
			'Speed kept (final over initial), least speed on the way, direction, spin times half length over speed, largest lift over '
			'the depth at rest; depth at rest across a joint over that on one slab.',
			[
				'floor',
				'body',
				'contact',
				'stiffness',
				'speed kept',
				'least',
				'direction [rad]',
				'spin',
				'lift',
				'depth',
				'steps',
				'failures',
			],
			[
				[c.floor, c.body, c.contact, c.rule, *_numbers(c.crossing, 'kept slowest direction spin lift'), _short(c.depth)]
				+ [c.crossing.steps, c.crossing.failures]
				for c in self.cases
			],
		)
		ours = [c for c in self.cases if c.body != 'sphere']
		self._summary()
		self.findings.row('failures of contacts', sum(c.crossing.failures for c in self.cases), theory=0, accept=(0, 0))
		self._slides('1 m/s over three joints', [(c.contact, c.rule, c.crossing) for c in ours])
		self.worst(
			'depth across a joint over that on one piece, difference to 1',
			[(c.contact, c.rule, c.depth - 1) for c in ours],
			evenDepth,
			note='per contact two pieces are twice as stiff as one, as long as stiffness is not shared between them',
		)

	def _summary(self):
		"""Range over all bodies of each floor, contact and unit, as CSV and as Markdown for the documentation."""
		columns = ['floor', 'contact', 'stiffness', 'speed kept', 'direction [rad]', 'spin', 'lift', 'depth']
		groups = {}
		for c in self.cases:
			groups.setdefault((c.floor, 'sphere' if c.body == 'sphere' else c.contact, c.rule), []).append(c)
		rows = []
		for key, own in groups.items():
			crossings = [c.crossing for c in own]
			largest = [f'{max(abs(getattr(x, name)) for x in crossings):.2g}' for name in ('direction', 'spin', 'lift')]
			rows.append([*key, _span([x.kept for x in crossings], 4), *largest, _span([c.depth for c in own], 2)])
		self.findings.table('summary', 'The same, all bodies together: from the least to the greatest, or the greatest.', columns, rows)
		(self.findings.folder / 'summary.md').write_text(tabulate(rows, columns, tablefmt='github', disable_numparse=True) + '\n')

	def _case(self, floor, body, name, rule):
		crossing = cross(floor, body, contacts[name], rules[rule])
		depth = 1.0 if floor in ('slab', 'wall') else rest(floor, body, contacts[name], rules[rule]).depth
		self.cases.append(Case(floor, body, name, rule, crossing, depth))

	def _slides(self, title, found):
		"""Rows of what must be kept; found: list of (contact, rule, Crossing)."""
		self.worst(f'{title}: loss of speed', [(n, r, c.kept - 1) for n, r, c in found], sliding)
		self.worst(f'{title}: direction', [(n, r, c.direction) for n, r, c in found], sliding, unit='rad')
		self.worst(f'{title}: spin × half length / speed', [(n, r, c.spin) for n, r, c in found], sliding)

	def speeds(self):
		"""Speeds from creeping to fast."""
		found = []
		floors = ('plates',) if self.quick else ('slab', 'plates', 'facets')
		slow = ((1e-3, 0.005), (0.1, 0.08)) if self.quick else ((1e-3, 0.02), (1e-2, 0.08), (0.1, 0.08))
		for floor in tqdm(floors, desc='speeds', disable=None):
			for name, rule in self.variants():
				arguments = floor, 'cube', contacts[name], rules[rule]
				for speed, behind in slow:
					for edge in ('front', 'back'):
						found.append((floor, speed, edge, name, rule, cross(*arguments, speed, 1, edge=edge, behind=behind)))
				found.append((floor, 10.0, 'all', name, rule, cross(*arguments, 10.0)))
		self.findings.table(
			'speeds',
			'A cube at other speeds; up to 0.1 m/s one of its edges alone crosses one joint, from 1 mm before to 20 mm '
			'(1 mm/s; --quick: 5 mm) or 80 mm behind it.',
			['floor', 'speed [m/s]', 'edge', 'contact', 'stiffness', 'speed kept', 'direction [rad]', 'spin', 'lift'],
			[[f, v, e, n, r, *_numbers(c, 'kept direction spin lift')] for f, v, e, n, r, c in found],
		)
		for speed in dict.fromkeys(row[1] for row in found):
			self._slides(f'{speed:g} m/s', [(n, r, c) for _, v, _, n, r, c in found if v == speed])

	def joints(self):
		"""Other angles and numbers of joints."""
		found = []
		angles = (30,) if self.quick else (10, 20, 35, 50, 65, 80)
		numbers = ((10, 0.2),) if self.quick else ((1, 1.0), (10, 0.5), (10, 0.2), (100, 0.1))
		for name, rule in tqdm(self.variants(), desc='joints', disable=None):
			arguments = contacts[name], rules[rule], 1.0
			for angle in angles:
				for body in ('cube', 'dodecahedron')[: 1 if self.quick else 2]:
					found.append((3, 0.5, angle, body, name, rule, cross('plates', body, *arguments, 3, 0.5, angle)))
			for seams, spacing in numbers:
				found.append((seams, spacing, 90, 'cube', name, rule, cross('plates', 'cube', *arguments, seams, spacing)))
		self.findings.table(
			'joints',
			'Joints of plates at other angles to the motion, and more of them (closer than the body is long: it lies on '
			'several pieces at a time).',
			['joints', 'apart [m]', 'angle [°]', 'body', 'contact', 'stiffness', 'speed kept', 'direction [rad]', 'spin', 'lift'],
			[[*row[:6], *_numbers(row[6], 'kept direction spin lift')] for row in found],
		)
		self._slides('joints at an angle', [(row[4], row[5], row[6]) for row in found if row[2] != 90])
		self._slides('1 to 100 joints', [(row[4], row[5], row[6]) for row in found if row[2] == 90])

	def tilted(self):
		"""Bodies that are held from turning slide on an edge or a vertex, or on a face that is not level."""
		floors = ('plates', 'facets') if self.quick else ('slab', 'plates', 'oblique', 'boxes', 'facets', 'mesh', 'rock')
		found = []
		for floor in tqdm(floors, desc='tilted', disable=None):
			for name, rule in self.variants():
				for body, axis, angle in tilts[::4] if self.quick else tilts:
					turned = Quaternion(Vector3.UnitX if axis == 'x' else Vector3.UnitY, math.radians(angle))
					crossing = cross(floor, body, contacts[name], rules[rule], tilt=turned, held=True)
					found.append((floor, body, axis, angle, name, rule, crossing))
		self.findings.table(
			'tilted',
			'Bodies that are turned about the direction of motion (x) or across it (y) and held so: they slide on a face that is not level, on an edge '
			'or on a vertex, at 1 m/s over three joints.',
			['floor', 'body', 'turned about', 'angle [°]', 'contact', 'stiffness', 'speed kept', 'direction [rad]', 'lift'],
			[[*row[:6], *_numbers(row[6], 'kept direction lift')] for row in found],
		)
		self._slides('on an edge or a vertex', [row[4:] for row in found])

	def friction(self):
		floors = ('slab', 'plates', 'facets') if self.quick else ('slab', 'plates', 'oblique', 'boxes', 'facets', 'mesh', 'bricks')
		bodies = ('cube',) if self.quick else ('cube', 'box', 'dodecahedron')
		pairs = [(f, b) for f in floors for b in bodies] + [(f, 'square') for f in ('slab', 'plates')]
		found = []
		for floor, body in tqdm(pairs, desc='friction', disable=None):
			for name, rule in self.variants():
				arguments = floor, body, contacts[name], rules[rule]
				found.append((floor, body, name, rule, stop(*arguments), slideDown(*arguments)))
		self.findings.table(
			'friction',
			'Stopping from 2 m/s with μ = 0.3, joints 0.2 m apart: distance over v²/(2μg). Sliding down 45° with φ = 25°, joints 0.4 m apart, 0.8 s, '
			'rocking undamped: way over ½ g (sin α − tan φ cos α) t². '
			'Aside: way across over that.',
			['floor', 'body', 'contact', 'stiffness', 'stop', 'stop: aside', 'incline', 'incline: aside'],
			[[*row[:4], *_numbers(row[4], 'distance direction'), *_numbers(row[5], 'distance direction')] for row in found],
		)
		for title, k in (('stopping distance', 4), ('way down an incline', 5)):
			self.worst(f'{title}: relative error', [(row[2], row[3], row[k].distance - 1) for row in found], braking)
			self.worst(f'{title}: way aside', [(row[2], row[3], row[k].direction) for row in found], braking)

	def edges(self):
		"""Real steps, gaps and ends."""
		rows = []
		for name, rule in self.variants():
			contact, perArea = contacts[name], rules[rule]
			for speed in (0.1, 1.0):
				past, lowest, kept = onStep(contact, perArea, speed=speed)
				# stopped by it, or what is past it lies on it; 1 mm: the depth of the impact at 0.1 m/s; 0.05 m: a tenth of the body
				good = past < (min(pressedPast(speed), 0.05) if perArea else 1e-3) or lowest > 0.001
				rows.append([f'step of 2 mm at {speed:g} m/s', name, rule, past, lowest, kept, good])
			wide, narrow = gapHolds(contact, perArea)
			rows.append(['gap of 0.12 m under a cube of 0.5 m: come down [m]', name, rule, wide, '', '', abs(wide) < 1e-3])
			rows.append(['gap of 0.12 m under a cube of 0.1 m: come down [m]', name, rule, narrow, '', '', narrow > 0.04])
			for over in (0.3, -0.2):  # of its half length of 250 mm
				# faces with a stiffness per area: the edge is pressed in, and it takes a while to come to rest
				pressed = perArea and name == default and over > 0
				down = edgeCarries(contact, perArea, over=over, time=3 if pressed else 0.3)
				where = 'inside' if over > 0 else 'outside'
				good = abs(down / restOverEnd(over) - 1) < 0.01 if pressed else down < 1e-3 if over > 0 else down > 0.01
				rows.append([f'end of a slab, centroid {abs(over) * 250:.0f} mm {where}: come down [m]', name, rule, down, '', '', good])
		self.findings.table(
			'edges',
			'What must not change: a step stops a body or lifts it (first number: how far its front is past the step’s face [m], then the '
			'height of its lowest corner there [m] and the speed left), gaps and ends of floors.',
			['case', 'contact', 'stiffness', 'number', 'lowest', 'speed left', 'good'],
			[[*row[:3], *(_short(x) if isinstance(x, float) else x for x in row[3:6]), 'yes' if row[6] else 'NO'] for row in rows],
		)
		for name, rule in self.variants():
			wrong = [row[0] for row in rows if (row[1], row[2]) == (name, rule) and not row[6]]
			self.worst('steps, gaps and ends: cases that went wrong', [(name, rule, len(wrong))], 0, note='; '.join(wrong))

	def impacts(self):
		tilts = (0, 20) if self.quick else (0, 2, 5, 10, 20, 30, 45)
		found = []
		for body in ('cube',) if self.quick else ('cube', 'square'):
			for floor in ('slab', 'plates'):
				for tilt in tilts:
					for name, rule in self.variants():
						found.append((floor, body, tilt, name, rule, drop(floor, body, contacts[name], rules[rule], tilt=tilt)))
		self.findings.table(
			'impacts',
			'A body flies onto a joint at 0.5 m/s, without gravity, friction and damping, turned about the joint’s direction: sideways '
			'and upward speed, spin times half length, over the speed of the impact; kinetic energy over that before.',
			['floor', 'body', 'turned [°]', 'contact', 'stiffness', 'sideways', 'rebound', 'spin', 'energy'],
			[[*row[:5], *_numbers(row[5], 'sideways rebound spin energy')] for row in found],
		)
		self.worst('impact on a frictionless floor: sideways speed', [(row[3], row[4], row[5].sideways) for row in found], sliding)
		pairs = list(zip([f for f in found if f[0] == 'slab'], [f for f in found if f[0] == 'plates'], strict=True))
		self.worst(
			'impact on a joint against that on a slab: difference of the rebound',
			[(a[3], a[4], a[5].rebound - b[5].rebound) for a, b in pairs],
			0.02,
			note='per contact two pieces are twice as stiff',
		)

	def rolls(self):
		found = []
		for name, rule in self.variants():
			ways = [roll(floor, 'dodecahedron', contacts[name], rules[rule]) for floor in ('slab', 'plates')]
			found.append((name, rule, *ways, max(abs(a - b) for a, b in zip(*ways, strict=True)) / ways[0][-1]))
		self.findings.table(
			'rolling',
			'A dodecahedron rolls down 40°, μ = 0.9, over ten joints 0.3 m apart: ways after 0.2, 0.4 … 1 s [m].',
			['contact', 'stiffness', *(f'{where}, {t:.1f} s' for where in ('slab', 'plates') for t in (0.2, 0.4, 0.6, 0.8, 1.0))]
			+ ['largest difference over the way'],
			[[n, r, *map(_short, slab[1::2]), *map(_short, plates[1::2]), _short(error)] for n, r, slab, plates, error in found],
		)
		self.worst(
			'rolling dodecahedron: difference of the ways on ten plates and on a slab', [(n, r, e) for n, r, _, _, e in found], rolling
		)


def _numbers(result, names):
	return [_short(getattr(result, name)) for name in names.split()]


def _span(values, digits):
	least, greatest = (f'{x:.{digits}f}' for x in (min(values), max(values)))
	return least if least == greatest else f'{least} … {greatest}'


def _short(x):
	return float(f'{x:.6g}')
