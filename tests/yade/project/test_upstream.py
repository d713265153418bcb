# SPDX-License-Identifier: GPL-2.0-or-later
"""tools/upstream/place.sh: the project's C++ in a copy of YADE's own source tree (docs/developing.md). It is not built here."""

import difflib
import os
import pathlib
import re
import subprocess

import pytest

if 'buildKey' not in os.environ:
	pytest.skip('not started by ./run', allow_module_level=True)

project = pathlib.Path(__file__).resolve().parents[3]
cache = (pathlib.Path(os.environ['YADE_PREFIX']).parent / 'CMakeCache.txt').read_text()
yadeSource = pathlib.Path(re.search(r'^YADE_SOURCE_DIR:PATH=(.*)$', cache, re.MULTILINE)[1])


def place(*arguments):
	return subprocess.run([project / 'tools/upstream/place.sh', *arguments], capture_output=True, text=True, timeout=120)


def testTheTreeHasAPlaceInYadesOwn(tmp_path):
	"""The lines that are added, in the places that YADE's CMakeLists.txt has for them; sources and version are this project's."""
	tree = tmp_path / 'yade'
	done = place(yadeSource, tree)
	assert done.returncode == 0 and f'cmake -S {tree}' in done.stdout, done.stderr
	before, after = ((folder / 'CMakeLists.txt').read_text().splitlines() for folder in (yadeSource, tree))
	changes = [line for line in difflib.ndiff(before, after) if line[0] in '+-']
	assert len(changes) == 6 and all(line[0] == '+' for line in changes), changes
	disabled, loop, subdirectory = (
		next(k for k, line in enumerate(after) if text in line)
		for text in ('LIST(APPEND disabled_pkgs_list "polytope")', 'SUBDIRLIST(SUBDIRS_PKG', 'ADD_SUBDIRECTORY(pkg/polytope)')
	)
	assert disabled < loop < subdirectory, 'the loop makes no library of it, and Boost and VTK are known by then'
	own = (tree / 'pkg/polytope/CMakeLists.txt').read_text()
	version = re.search(r'^project\(yade-polytope VERSION (\S+)', (project / 'CMakeLists.txt').read_text(), re.MULTILINE)[1]
	assert f'project(yade-polytope VERSION {version} ' in own
	for name in re.search(r'\^host/\(([A-Za-z|]+)\)', own)[1].split('|'):
		assert (tree / f'pkg/polytope/host/{name}.cpp').is_file()
	assert (tree / 'pkg/polytope/src/contact/ContactQuery.cpp').is_file() and (tree / 'pkg/polytope/cmake/Compiler.cmake').is_file()


def testWhatItRefuses(tmp_path):
	assert place().returncode == 2
	for source, folder, text in (
		(tmp_path, tmp_path / 'new', 'is no source tree of YADE'),
		(yadeSource, tmp_path, 'exists; name a new folder'),
	):
		refused = place(source, folder)
		assert refused.returncode == 1 and text in refused.stderr and not list(tmp_path.iterdir())
