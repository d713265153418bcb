# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks and grains on joints, where theory has one answer: for each choice of contact and both rules of stiffness.

Toppling (Goodman & Bray), a shaken and a rocking block (Housner), a masonry arch, cubes let go on slopes, edges on floors, solids that
roll over flush plates, grains in a drum and a funnel of facets. One line a quantity as it is measured, and one table: theory, contact surface
(the default), the paper's contact. Ends with 1 if the default misses a limit. With --contact-model or --set that choice alone is
measured, and checked against the same limits.

	./run python tools/measure/accuracy/joints.py                                        # all
	./run python tools/measure/accuracy/joints.py --quick                                # coarser, smaller
	./run python tools/measure/accuracy/joints.py --scene slope edges --contact-model boon2012 --rule contact
	./run python tools/measure/accuracy/joints.py --scene toppling --contact-model foundation --per-area
"""

import argparse
import ast
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; the scenes are small

from jointStudy.measures import measures

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import paperParser, shown
from boon2012.reporting.script import conclude

contacts = {'surface': {}, 'boon2012': {'contactModel': 'boon2012'}}
"""Name: attributes of the geometry functors."""
rules = {'contact': False, 'area': True}


def attribute(text):
	"""(name, value) from NAME=VALUE (argparse type)."""
	name, equals, value = text.partition('=')
	if not equals or not name.isidentifier():
		raise argparse.ArgumentTypeError(f'must be NAME=VALUE, got {text!r}')
	try:
		return name, ast.literal_eval(value)
	except (SyntaxError, ValueError):
		return name, value


def options(arguments=None):
	parser = paperParser(__doc__, quick='coarser and smaller')
	parser.set_defaults(output=pathlib.Path('output/accuracy/joints'))
	parser.add_argument('--scene', nargs='+', choices=list(measures), default=list(measures), help='which to measure')
	parser.add_argument('--rule', choices=[*rules, 'both'], default='both', help='what stiffnesses are per')
	parser.add_argument('--per-area', dest='rule', action='store_const', const='area', help='the same as --rule area')
	parser.add_argument('--contact-model', help='of the geometry functors: this choice alone')
	parser.add_argument(
		'--set', type=attribute, nargs='+', default=[], metavar='NAME=VALUE', help='other attributes of the geometry functors'
	)
	return parser.parse_args(arguments)


def choices(given):
	"""{name: attributes of the geometry functors}"""
	model = {} if given.contact_model is None else {'contactModel': given.contact_model}
	chosen = {**model, **dict(given.set)}
	if chosen:
		return {', '.join(f'{name}={value}' for name, value in chosen.items()): chosen}
	return contacts


class Study:
	"""All that is measured, as rows {(scene, rule, quantity): {contact: Measured}}."""

	def __init__(self, given, findings):
		self.given, self.findings, self.contacts = given, findings, choices(given)
		self.judged = next(iter(self.contacts))
		self.found = {}

	def measure(self):
		for scene in self.given.scene:
			for name, ig2 in self.contacts.items():
				for rule in rules if self.given.rule == 'both' else [self.given.rule]:
					for one in measures[scene](ig2, rules[rule], self.given.quick):
						self.found.setdefault((scene, rule, one.quantity), {})[name] = one
						verdict = 'told' if one.allowed is None else 'within' if one.good else 'MISSED'
						print(
							f'{scene}, {name}, per {rule}: {one.quantity} {one.ours:.6g} {one.unit}, theory {one.theory:.6g}: {verdict}',
							flush=True,
						)

	def rows(self):
		for (scene, rule, quantity), ones in self.found.items():
			one = ones[self.judged]
			accept = None if one.allowed is None else (one.theory - one.allowed, one.theory + one.allowed)
			self.findings.row(f'{scene}, per {rule}: {quantity}', one.ours, one.unit, theory=one.theory, accept=accept)

	def table(self):
		self.findings.table(
			'joints',
			f'Scenes with a closed form, by contact and by what stiffnesses are per. Limits hold for: {self.judged}.',
			['scene', 'stiffness per', 'quantity', 'unit', 'theory', *self.contacts, 'most off'],
			[
				[
					*key,
					ones[self.judged].unit,
					ones[self.judged].theory,
					*(one.ours for one in ones.values()),
					ones[self.judged].allowed or '',
				]
				for key, ones in self.found.items()
			],
		)


def main(arguments=None):
	given = options(arguments)
	findings = Findings('joints', 'Blocks and grains with a closed form', given.output, shown(given))
	study = Study(given, findings)
	study.measure()
	study.rows()
	study.table()
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main(sys.argv[1:]))
