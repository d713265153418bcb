#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Bounds on the machine instructions of one query, counted by callgrind: the same on a busy machine.

Usage: instructions.py POLYTOPE_CORE_TESTS. Exit code 77 (skipped) where there is no valgrind, or no AVX2 in it.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

bounds = {
	'cold': {4: 3460, 6: 4400, 12: 6190, 20: 9560},
	'warm': {6: 3170, 20: 4370},
	'surface': {6: 6460, 20: 12490},
	'apart': {6: 400},
}
"""Faces of the regular solids: instructions a pair, measured and a tenth more. Touching pairs of the paper's contact without and with warm start,
with warm start the contact model spring, and separated pairs."""

pairs = 20
few, many = 5, 55


def count(program, runs):
	"""Instructions of all queries of each run (kind, faces, repetitions), and what the program printed."""
	with tempfile.TemporaryDirectory() as folder:
		# one process, since starting it takes valgrind seconds. Within the query alone: the rest varies with the libraries
		command = ['valgrind', '--tool=callgrind', f'--callgrind-out-file={folder}/out', '--toggle-collect=polytope::contactQuery*']
		command += ['--dump-after=*countedQueries*', program, '--gtest_also_run_disabled_tests', '--gtest_filter=Counters.DISABLED_Queries']
		environment = dict(os.environ, POLYTOPE_COUNTED=' '.join(','.join(map(str, one)) for one in runs))
		result = subprocess.run(command, env=environment, capture_output=True, text=True)
		if result.returncode:
			sys.exit(f'{" ".join(command)} ended with {result.returncode}:\n{result.stdout}\n{result.stderr}')
		dumps = [pathlib.Path(f'{folder}/out.{k + 1}').read_text() for k in range(len(runs))]
	return {
		one: int(re.search(r'^(?:totals|summary): (\d+)', dump, re.MULTILINE)[1]) for one, dump in zip(runs, dumps, strict=True)
	}, result.stdout


def main():
	if not shutil.which('valgrind'):
		print('no valgrind')
		return 77
	kinds = [(kind, *one) for kind, solids in bounds.items() for one in solids.items()]
	counted, printed = count(sys.argv[1], [(kind, faces, repetitions) for kind, faces, _ in kinds for repetitions in (few, many)])
	if 'instruction set: AVX2' not in printed:
		print('the bounds are for AVX2')
		return 77
	failed = False
	for kind, faces, bound in kinds:
		each = (counted[kind, faces, many] - counted[kind, faces, few]) / ((many - few) * pairs)
		print(f'{kind}, {faces} faces: {each:.0f} instructions a query, bound {bound:.0f}', flush=True)
		failed |= not bound / 2 < each <= bound  # far below: not the query was counted
	return failed


if __name__ == '__main__':
	sys.exit(main())
