# SPDX-License-Identifier: GPL-2.0-or-later
"""Core and plug-in compile for a YADE whose numbers are a class, as those of MPFR and float128 are. Only `./run tradeoff` builds these; long double, which the
tests build, is a type of C++ itself, and forgives more. The compiler only reads here: it makes no code, which would take half an hour. MPFR stands
for both: `./run tradeoff` builds each."""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess

import pytest

if 'buildKey' not in os.environ:
	pytest.skip('not started by ./run', allow_module_level=True)

project = pathlib.Path(__file__).resolve().parents[3]
cache = (pathlib.Path(os.environ['YADE_PREFIX']).parent / 'CMakeCache.txt').read_text()
sources = re.search(r'^YADE_SOURCE_DIR:PATH=(.*)$', cache, re.MULTILINE)[1]


def messagesOf(entry):
	"""What the compiler says of one file, with all warnings that a build takes as errors."""
	command = shlex.split(entry['command'])
	command = command[next(k for k, word in enumerate(command) if not word.endswith('ccache')) :]
	at = command.index('-o')
	command = [word for word in command[:at] + command[at + 2 :] if word != '-c']
	done = subprocess.run([*command, '-fsyntax-only'], cwd=entry['directory'], capture_output=True, text=True)
	return '' if done.returncode == 0 else f'{entry["file"]}\n{done.stderr}'


def testCompiles(tmp_path):
	options = ['-DPOLYTOPE_YADE=ON', '-DPOLYTOPE_PRECISION=mpfr150', '-DPOLYTOPE_TESTS=OFF', f'-DYADE_SOURCE_DIR={sources}']
	options += ['-DCMAKE_UNITY_BUILD=ON', '-DCMAKE_UNITY_BUILD_BATCH_SIZE=8']  # eight files read the headers once
	configured = subprocess.run(['cmake', '-S', project, '-B', tmp_path, '-G', 'Ninja', *options], capture_output=True, text=True)
	assert configured.returncode == 0, configured.stderr
	headers = subprocess.run(['cmake', '--build', tmp_path, '--target', 'polytope_kit'], capture_output=True, text=True)  # what a build writes before it compiles
	assert headers.returncode == 0, headers.stdout
	entries = json.loads((tmp_path / 'compile_commands.json').read_text())
	ofCore = sum(pathlib.Path(entry['file']).read_text().count(f'#include "{project}/src/') for entry in entries)
	assert ofCore > 30 and any('/pkg/' in entry['command'] for entry in entries)
	with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as threads:
		messages = [said for said in threads.map(messagesOf, entries) if said]
	assert not messages, '\n'.join(messages)
