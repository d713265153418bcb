# SPDX-License-Identifier: GPL-2.0-or-later
"""What a process that a fault ends writes in the tests' runs (tests/core/nativeTrace.cpp)."""

import os
import pathlib
import signal
import subprocess
import sys

library = pathlib.Path(__file__).resolve().parents[2] / 'build/tests/core/libpolytope_native_trace.so'


def testAFaultInAThreadIsWrittenWithItsFunctions():
	"""Functions of Python are written, by its faulthandler as in pytest, and those of C."""
	fault = 'import ctypes, faulthandler, threading; faulthandler.enable(); threading.Thread(target=lambda: ctypes.string_at(1)).start()'
	ended = subprocess.run([sys.executable, '-c', fault], env={**os.environ, 'LD_PRELOAD': str(library)}, capture_output=True, text=True)
	assert ended.returncode == -signal.SIGSEGV
	assert 'in <lambda>' in ended.stderr, ended.stderr
	functions = ended.stderr.partition('Functions of the thread')[2]
	assert '_ctypes' in functions and 'libc.so' in functions, ended.stderr


def testItIsWrittenFromATestThatPytestCaptures(tmp_path):
	"""There the process has another file for its errors, which is lost with it."""
	(tmp_path / 'test_fault.py').write_text('import ctypes\n\n\ndef testFault():\n\tctypes.string_at(1)\n')
	ended = subprocess.run(
		[sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', tmp_path],
		env={**os.environ, 'LD_PRELOAD': str(library)},
		cwd=tmp_path,
		capture_output=True,
		text=True,
	)
	assert ended.returncode == -signal.SIGSEGV
	assert 'test_fault.py' in ended.stderr and '_ctypes' in ended.stderr.partition('Functions of the thread')[2], ended.stderr
