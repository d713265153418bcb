# SPDX-License-Identifier: GPL-2.0-or-later
"""tools/skipped.py: the summary at the end of `./run test`."""

import os
import pathlib
import subprocess
import sys

project = pathlib.Path(__file__).resolve().parents[2]
junit = '''<testsuites><testsuite>{}</testsuite></testsuites>'''
case = '<testcase classname="{}" name="{}">{}</testcase>'


def skipped(folder, *options, ci=''):
	done = subprocess.run(
		[sys.executable, project / 'tools/skipped.py', *options, folder],
		env={**os.environ, 'CI': ci},
		capture_output=True,
		text=True,
		timeout=600,
	)
	assert not done.stderr
	return done


def testSkipsAreCountedAndNamed(tmp_path):
	core = ['Shape.cube', 'Instructions', 'Fuzz.contact', 'Search', 'WithoutIpopt', 'InstructionSet.SSE2', 'Clang.Status']
	missing = '<skipped message="SKIP_RETURN_CODE=77"/><system-out>no valgrind\n</system-out>'
	(tmp_path / 'core.xml').write_text(
		junit.format(''.join(case.format(name, name, missing if name == 'Instructions' else '') for name in core))
	)
	(tmp_path / 'double.xml').write_text(
		junit.format(case.format('a.b', 'testX', '<skipped message="float128 is not built: so"/>') + case.format('a.b', 'testY', ''))
	)
	for ci, code in (('', 0), ('true', 1)):
		done = skipped(tmp_path, '--expect-core', '--expect-precision', 'longdouble', ci=ci)
		assert done.returncode == code
		assert 'skipped: 3\n' in done.stdout and 'core: Instructions' in done.stdout and '1 × no valgrind' in done.stdout
		assert 'a.b.testX' in done.stdout and 'precision longdouble' in done.stdout and 'testY' not in done.stdout


def testAllowedSkipsPassInCI(tmp_path):
	(tmp_path / 'double.xml').write_text(junit.format(case.format('a.b', 'testX', '<skipped message="float128 is not built: so"/>')))
	assert skipped(tmp_path, ci='true').returncode == 0


def testAPartThatWasNotBuiltIsNamed(tmp_path):
	(tmp_path / 'core.xml').write_text(junit.format(case.format('Shape.cube', 'Shape.cube', '')))
	done = skipped(tmp_path, '--expect-core', ci='true')
	assert done.returncode == 1 and 'skipped: 6\n' in done.stdout and 'clang' in done.stdout
	assert skipped(tmp_path / 'nothing', '--expect-core', ci='true').returncode == 1
