#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Bounds on the machine instructions of one query, counted by callgrind: the same on a busy machine.

Usage: instructions.py POLYTOPE_CORE_TESTS. Exit code 77 (skipped) where there is no valgrind, or no AVX2 in it.
"""
import os
import re
import shutil
import subprocess
import sys

bounds = {
        'cold': {4: 3460, 6: 4400, 12: 6190, 20: 9560},
        'averaged': {6: 3170, 20: 4370},
        'apart': {6: 400},
}
"""Faces of the regular solids: instructions a pair, measured and a tenth more. Touching pairs without and with warm start,
and separated pairs, with it. averaged: touching, with warm start, and the paper's averaged normal."""

warm = 1.15
"""The same with the default normal: at most so many times the instructions of the averaged one."""

pairs = 20
few, many = 5, 55


def run(program, kind, faces, repetitions):
	"""Instructions of all queries of the process, and what it printed."""
	# within the query alone: what libraries do when they are loaded varies from run to run
	command = [
	        'valgrind', '--tool=callgrind', '--callgrind-out-file=/dev/null', '--toggle-collect=polytope::contactQuery*', program, '--gtest_also_run_disabled_tests', '--gtest_filter=Counters.DISABLED_Queries'
	]
	result = subprocess.run(command, env=dict(os.environ, POLYTOPE_COUNTED=f'{faces},{repetitions},{kind}'), capture_output=True, text=True)
	if result.returncode:
		sys.exit(f'{" ".join(command)} ended with {result.returncode}:\n{result.stdout}\n{result.stderr}')
	return int(re.search(r'Collected\s*:\s*(\d+)', result.stderr).group(1)), result.stdout


def main():
	if not shutil.which('valgrind'):
		print('no valgrind')
		return 77
	failed = False
	counted = {}
	kinds = [(kind, *one) for kind, solids in bounds.items() for one in solids.items()]
	for kind, faces, bound in [*kinds, *(('warm', faces, None) for faces in bounds['averaged'])]:
		(first, printed), (second, _) = run(sys.argv[1], kind, faces, few), run(sys.argv[1], kind, faces, many)
		if 'instruction set: AVX2' not in printed:
			print('the bounds are for AVX2')
			return 77
		each = counted[kind, faces] = (second - first) / ((many - few) * pairs)
		bound = bound or warm * counted['averaged', faces]
		print(f'{kind}, {faces} faces: {each:.0f} instructions a query, bound {bound:.0f}', flush=True)
		failed |= not bound / 2 < each <= bound  # far below: not the query was counted
	return failed


if __name__ == '__main__':
	sys.exit(main())
