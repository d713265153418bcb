# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of blocks with a closed form: toppling, shaking, a masonry arch, slopes, edges, rolling; for each choice of contact and rule of stiffness.

One line a quantity as it is measured. Ends with 1 if the default contact misses a limit.

	./run python tests/accuracy/joints.py                                        # default, paper's normal, conservative; both rules
	./run python tests/accuracy/joints.py --quick                                # coarser
	./run python tests/accuracy/joints.py --scene slope edges --normal dualWeights --rule contact
	./run python tests/accuracy/joints.py --scene toppling --contact-model conservative --per-area --set barrier=3e-4
"""

import argparse
import ast
import os
import sys
import time

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; the scenes are small

from yade.polytope.studies.jointScenes import measures


def options(arguments=None):
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
	parser.add_argument('--quick', action='store_true', help='coarser')
	parser.add_argument('--scene', nargs='+', choices=list(measures), default=list(measures))
	parser.add_argument('--rule', choices=('contact', 'area', 'both'), default='both', help='what stiffnesses are per')
	parser.add_argument('--per-area', dest='rule', action='store_const', const='area', help='the same as --rule area')
	parser.add_argument('--contact-model', dest='contactModel', help='of the geometry functors')
	parser.add_argument('--normal', help='of the geometry functors')
	parser.add_argument('--set', nargs='+', default=[], metavar='NAME=VALUE', help='other attributes of the geometry functors')
	return parser.parse_args(arguments)


def choices(given):
	"""{name: attributes of the geometry functors}"""
	ig2 = {name: getattr(given, name) for name in ('contactModel', 'normal') if getattr(given, name) is not None}
	for pair in given.set:
		name, value = pair.split('=', 1)
		ig2[name] = ast.literal_eval(value)
	return {', '.join(f'{k}={v}' for k, v in ig2.items()) or 'default': ig2}


def main(arguments=None):
	given = options(arguments)
	good = True
	for scene in given.scene:
		for name, ig2 in choices(given).items():
			for rule in ('contact', 'area') if given.rule == 'both' else (given.rule,):
				begun = time.time()
				for one in measures[scene](ig2, rule == 'area', given.quick):
					good &= one.good
					verdict = '' if one.allowed is None else 'ok' if one.good else 'MISSED'
					print(
						f'{scene:9} {name} per {rule}: {one.quantity} {one.ours:.6g} {one.unit}, theory {one.theory:.6g}, '
						f'off {one.ours - one.theory:+.2g} of {one.allowed or 0:.2g} {verdict} [{time.time() - begun:.1f} s]',
						flush=True,
					)
					begun = time.time()
	return 0 if good else 1


if __name__ == '__main__':
	sys.exit(main(sys.argv[1:]))
