# SPDX-License-Identifier: GPL-2.0-or-later
"""Smoothness of the contact: path of point, normal and force as one cube slides, tilts and rolls over another.

Prescribed poses through every change of contact (face, edge, vertex, over an edge to the next face, deeper than the corner radius):
largest jump, or largest change per motion where there is none, for the contact surface (foundation, spring), and for the paper's contact at the analytic centre, the Chebyshev
centre, the centroid and with the corner radius 0; with and without planes that cut nothing; and from a warm start against a cold one.
Ends with 1 if a contact that is smooth jumps, or a warm answer differs from a cold one by more than the solver's tolerance.

	./run python tools/measure/accuracy/contactPath.py            # two minutes
	./run python tools/measure/accuracy/contactPath.py --quick    # fewer steps, planes and halvings: half a minute
"""

import math
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; one pair is too few for more

import numpy as np
from tqdm import tqdm
from yade import O, RockJointMat

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import count, paperParser, shown
from boon2012.reporting.script import conclude
from pathStudy.path import besideOnItsLine, change, forceUnit, halvings, quantities, scan, smoothness, warmAnswers, zoom
from pathStudy.scenes import deep, paths, planeSets, variants

foundation, spring, analytic, chebyshev, centroid, sharp = variants
surfaces = foundation, spring
pressed = 'edge pressed deeper than the corner radius'
flat = 'slide, face on face, to beyond the edge'
ridge = {foundation: 2 * deep, spring: 1e-5}
"""Largest jump of a contact surface, and largest difference of its warm and cold answers: where sides of both cubes come into line, planes
coincide, and the energy has a ridge (docs/contact-surface.md). There the rim of a foundation's face of edges a, b at the overlap h begins
to push sideways with K b h²/2 where the face pushes with K (a b h − (a + b) h²/2): the force turns by some h/2a, half of this limit, and
changes by some more of the path's mean force, where that is less."""
units = {'point': 'edges', 'normal': 'rad', 'force': 'mean force'}


class Study:
	"""All measurements, in the order of the report."""

	def __init__(self, given, findings):
		self.given, self.findings = given, findings
		self.places, self.depth = (3, 20) if given.quick else (8, halvings)
		self.scans, self.found = {}, {}

	def measure(self):
		"""scans {(planes, path): Scan}, found {(planes, path, variant): [Smoothness of each quantity]}"""
		sets = planeSets[:2] if self.given.quick else planeSets
		for planes, path in tqdm([(p, n) for p in sets for n in paths], desc='paths', disable=None):
			found = scan(paths[path], self.given.steps, variants, planes)
			self.scans[planes, path] = found
			for name in variants:
				force = forceUnit(self.scans['plain', path].answers[name])
				self.found[planes, path, name] = [smoothness(z) for z in zoom(found, name, self.places, self.depth, force)]

	def table(self):
		def shown(one):
			return [one.jump or '', '' if one.jump else one.rate]

		self.findings.table(
			'smoothness',
			'Largest jump, or where there is none the largest change per motion (Lipschitz constant), of contact point, normal and '
			'force. Two cubes, edges 1 (moving) '
			'and 1.6; lengths in edges of the moving one, forces in mean forces of the path with plain planes; overlap of faces '
			f'{2 * deep:g}, corner radius 0.05.',
			['planes', 'path', 'contact']
			+ [f'{q}: {what} [{u}{per}]' for q, u in units.items() for what, per in (('jump', ''), ('rate', ' per edge'))],
			[[*key, *(cell for one in three for cell in shown(one))] for key, three in self.found.items()],
		)

	def worst(self, name, quantity, planes='plain', without=()):
		"""Smoothness on the worst path."""
		k = quantities.index(quantity)
		several = [three[k] for (p, path, n), three in self.found.items() if p == planes and n == name and path not in without]
		return max(several, key=lambda one: (one.jump, one.rate))

	def rows(self):
		row = self.findings.row
		for name in variants:
			for quantity, unit in units.items():
				without = (pressed,) if name in (analytic, centroid) else ()
				one = self.worst(name, quantity, without=without)
				words = ' (overlap below the corner radius)' if without else ''
				must = name in (*surfaces, analytic, centroid) or quantity == 'point' and name == sharp
				row(
					f'{name}: largest jump of the {quantity}{words}',
					one.jump,
					unit,
					theory=0,
					accept=(0, ridge.get(name, 0)) if must else None,
					note='' if one.jump else f'at most {one.rate:.3g} {unit} per edge of motion',
				)
		for name in (*surfaces, analytic, centroid):
			one = self.found['plain', pressed, name][1]
			row(
				f'{name}: jump of the normal where an edge is pressed deeper than the corner radius',
				one.jump,
				'rad',
				theory=0,
				accept=(0.1, math.pi) if name in (analytic, centroid) else (0, 0),
				note='' if name not in (analytic, centroid) else 'the gradient of one body vanishes: status normalFromOneBody',
			)
		row(
			f'{chebyshev}: jumps by about an edge where faces become parallel',
			self.worst(chebyshev, 'point').jump,
			'edges',
			accept=(0.5, 1.5),
		)
		row(
			f'{sharp}: normal jumps from face to face',
			self.worst(sharp, 'normal').jump,
			'rad',
			accept=(1, 2),
			note='the linear program\'s dual direction changes with its basis',
		)
		self._flatNormals()
		self._redundant()
		self._words()

	def _words(self):
		def rates(name):
			return [self.worst(name, quantity, without=(pressed,)).rate for quantity in quantities]

		paper, smooth = rates(analytic), rates(spring)
		turned = self.worst(foundation, 'normal').jump
		cut = math.degrees(self.found['plain', pressed, analytic][1].jump)
		self.findings.text(
			"The paper's point, normal and force move without a jump through every change of contact, with and without planes that cut "
			"nothing: at most "
			f'{paper[0]:.3g} edges of the point, {paper[1]:.3g} rad of the normal and {paper[2]:.3g} mean forces per edge of motion; '
			'these rates go with '
			'one over overlap and corner radius. They hold while the contact point is within the corner radius of both bodies: pressed '
			'deeper, the normal '
			f'jumps by {cut:.3g}°. The contact surface has no jump at any depth but where sides come into line (a hundred thousandth with spring; with foundation '
			f'the normal turns by {turned:.3g} rad there); the rates of spring are {smooth[0]:.3g}, {smooth[1]:.3g} and '
			f'{smooth[2]:.3g}: '
			'the point crosses a face as that tilts through a smaller angle. The Chebyshev centre jumps by an edge where faces become '
			'parallel, and is not '
			'unique there; with corner radius 0 the normal jumps from face to face.'
		)

	def _flatNormals(self):
		"""Face on face the normal should be the faces'."""
		found = self.scans['plain', flat]
		inside = found.t < 0.2  # the moving face lies within the fixed one
		for name, answers in found.answers.items():
			off = float(np.degrees(np.arccos(np.minimum(answers[inside, 1, 2], 1))).max())
			limit = {chebyshev: None, foundation: (0, 0.01), spring: (0, 0.01)}.get(name, (0, 1e-5))
			note = 'its ball lies in a corner of the overlap, within the corner radius of the side faces' if name == chebyshev else ''
			self.findings.row(f"{name}: angle of normal and faces' normal, face on face", off, '°', theory=0, accept=limit, note=note)

	def _redundant(self):
		"""Planes that cut nothing: do they make jumps, and how much do they change the answers?"""
		rows = []
		for planes in dict.fromkeys(key[0] for key in self.scans):
			if planes == 'plain':
				continue
			for name in variants:
				most = np.zeros(3)
				for path in set(paths) - {pressed}:
					plain, other = (self.scans[p, path].answers[name] for p in ('plain', planes))
					differences = np.array([change(a, b) for a, b in zip(plain, other, strict=True)])
					most = np.maximum(most, differences.max(axis=0) / [1, 1, forceUnit(plain)])
				jumps = [self.worst(name, quantity, planes, (pressed,)).jump for quantity in quantities]
				rows.append([planes, name, *most, *jumps])
				if name in (*surfaces, analytic):
					self.findings.row(
						f'{name}, {planes} planes: largest jump of point, normal or force',
						max(jumps),
						theory=0,
						accept=(0, ridge.get(name, 0)),
					)
		self.findings.table(
			'redundant_planes',
			'Planes that cut nothing (touching: through all edges and vertices of both cubes; repeated: the planes that face each other '
			'four times, 1e-12 apart): largest difference '
			'of the answer to that of six planes a cube, and largest jump, over all paths less deep than the corner radius.',
			['planes', 'contact'] + [f'{what} of the {q} [{u}]' for what in ('difference', 'jump') for q, u in units.items()],
			rows,
		)

	def warm(self):
		"""Answers must not depend on where the solver started."""
		rows = []
		for name in variants:
			most = np.zeros(3)
			for path in paths:
				found = self.scans['plain', path]
				warm = warmAnswers(found, name)
				touching = ~np.isnan(warm[:, 0, 0])
				pairs = zip(warm[touching], found.answers[name][touching], strict=True)
				# a contact that is followed from step to step leaves its point where it is on its line of action (docs/contact-surface.md)
				differences = np.array([change(besideOnItsLine(a, b) if name in surfaces else a, b) for a, b in pairs])
				most = np.maximum(most, differences.max(axis=0) / [1, 1, forceUnit(found.answers[name])])
			rows.append([name, *most])
			for quantity, difference in zip(quantities, most, strict=True):
				note = 'where faces are parallel it is not unique' if name == chebyshev else ''
				if name in surfaces and quantity == 'point':
					note = 'across the line of action'
				self.findings.row(
					f'{name}: largest difference of the {quantity}, warm start against cold',
					difference,
					units[quantity],
					theory=0,
					accept=None if name == chebyshev else (0, ridge.get(name, 1e-9)),
					note=note,
				)
		self.findings.table(
			'warm_start',
			'Largest difference between answers that start from the last step\'s and answers from nothing, over all paths; the solver\'s '
			'tolerance is 1e-10 of the '
			"overlap's own size.",
			['contact', *(f'{q} [{u}]' for q, u in units.items())],
			rows,
		)

	def scaling(self):
		"""Dependence of the largest rates on overlap and corner radius."""
		tilt, over = 'tilt, face to edge', 'vertex over an edge to the next face'
		rows = []
		for overlap in (0.25, 1, 4):
			found = scan(paths[tilt], self.given.steps, {name: variants[name] for name in (analytic, spring)}, overlap=overlap)
			rates = {name: smoothness(zoom(found, name, self.places, self.depth)[0]).rate for name in found.how}
			rows.append(['overlap of faces', 2 * deep * overlap, tilt, 'point', rates[analytic], rates[spring]])
		for factor in (0.25, 1, 4):
			found = scan(paths[over], self.given.steps, {analytic: {**variants[analytic], 'cornerRadius': 0.05 * factor}})
			rate = smoothness(zoom(found, analytic, self.places, self.depth)[1]).rate
			rows.append(['corner radius: factor', factor, over, 'normal', rate, ''])
		self.findings.table(
			'scaling',
			'Largest change per motion of the point as faces tilt, by overlap, and of the normal as a vertex goes over an edge, by '
			'corner radius: a contact '
			'turns within a motion of the order of its rounding.',
			['varied', 'value', 'path', 'quantity', f'{analytic} [per edge]', f'{spring} [per edge]'],
			rows,
		)

	def all(self):
		self.measure()
		self.rows()
		self.table()
		self.warm()
		self.scaling()


def main(arguments=None):
	parser = paperParser(__doc__, quick='fewer steps, planes and halvings')
	parser.set_defaults(output=pathlib.Path('output/accuracy/contactPath'))
	parser.add_argument('--steps', type=count, default=None, help='of each path (2000; quick: 400)')
	given = parser.parse_args(arguments)
	given.steps = given.steps or (400 if given.quick else 2000)
	findings = Findings('path', 'Smoothness of the contact', given.output, shown(given))
	O.reset()
	O.materials.append(RockJointMat(density=1, normalStiffness=1, shearStiffness=1))
	Study(given, findings).all()
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main(sys.argv[1:]))
