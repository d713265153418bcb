# SPDX-License-Identifier: GPL-2.0-or-later
"""The core as a library of its own, as other programs find it: from the overlay, and from a prefix that it was installed in."""

import math
import os
import pathlib
import re
import shutil
import subprocess

import pytest
import yade
from scipy.optimize import brentq

project = pathlib.Path(__file__).resolve().parents[3]
overlay = pathlib.Path(os.environ.get('YADE_PREFIX', '/usr'))
build = overlay.parent
if not yade.config.libDir.endswith('-double') or not (build / 'CMakeCache.txt').is_file():
	pytest.skip('of the build for double alone, beside its overlay', allow_module_level=True)
example = project / 'examples/extend/coreAlone'


def run(*command, **options):
	done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=600, **options)
	assert done.returncode == 0, done.stdout + done.stderr
	return done.stdout


def numbers(text, name):
	return [float(word) for word in re.search(rf'^{re.escape(name)} (.*)$', text, re.MULTILINE)[1].split()]


def native(compiler):
	"""The flag for this processor, where the compiler can take it: clang 19 warns of its own choice on processors newer than it."""
	command = [compiler, '-march=native', '-Werror', '-fsyntax-only', '-x', 'c++', os.devnull]
	return '-march=native' if subprocess.run(command, capture_output=True, timeout=600).returncode == 0 else ''


@pytest.fixture
def installed(tmp_path):
	"""A prefix with the component core; CMake's list of what was installed last stays the user's."""
	before = {path: path.read_bytes() for path in build.glob('install_manifest*.txt')}
	prefix = tmp_path / 'prefix'
	run('cmake', '--install', build, '--component', 'core', '--prefix', prefix)
	for path in build.glob('install_manifest*.txt'):
		path.unlink()
	for path, text in before.items():
		path.write_bytes(text)
	return prefix


@pytest.mark.parametrize('place, compiler', [('overlay', 'g++'), ('prefix', 'g++'), ('prefix', 'clang++')])
def testTwoSetsOfVerticesHaveTheirContact(place, compiler, installed, tmp_path):
	"""s*, point, normal, depth and force have their closed forms. The program has warnings of its own as errors, and none of our options;
	it sees no source file of this project."""
	if shutil.which(compiler) is None:
		pytest.skip(f'there is no {compiler} here')
	prefix = overlay if place == 'overlay' else installed
	source, made = tmp_path / 'source', tmp_path / 'build'
	shutil.copytree(example, source)
	flags = f'-Wall -Wextra -Wconversion -Wpedantic -Werror -O2 {native(compiler)}'
	run(
		'cmake',
		'-S',
		source,
		'-B',
		made,
		'-G',
		'Ninja',
		f'-DCMAKE_PREFIX_PATH={prefix}',
		f'-DCMAKE_CXX_COMPILER={compiler}',
		f'-DCMAKE_CXX_FLAGS={flags}',
	)
	run('ninja', '-C', made)
	assert 'EIGEN_DONT' not in (made / 'build.ninja').read_text()
	seen = run('ninja', '-C', made, '-t', 'deps')
	assert f'{prefix}/include/polytope-core/polytope/contact/ContactQuery.hpp' in seen
	assert not re.search(rf'{project}/(src|pkg)/', seen)

	printed = run(made / 'coreAlone')
	assert numbers(printed, 's*') == [pytest.approx(-0.05 / (1 + math.sqrt(3)), rel=1e-14)]
	# the analytic centre: where the product of the distances to all planes is largest, along the axis that both bodies share
	height = brentq(lambda z: -1 / (1 - z) + 1 / (1 + z) + 4 / (z - 0.95) - 4 / (2.95 - z), 0.95 + 1e-9, 1 - 1e-9, xtol=1e-15)
	assert numbers(printed, 'point') == pytest.approx([0, 0, height], abs=1e-11)
	assert numbers(printed, 'normal') == pytest.approx([0, 0, 1], abs=1e-13)
	assert numbers(printed, 'depth') == [pytest.approx(0.05, rel=1e-12)]
	assert numbers(printed, 'force') == pytest.approx([0, 0, 5e4], rel=1e-12, abs=1e-8)


def testSixteenLines():
	"""The example's main() has sixteen lines at most, from the shapes to what is printed."""
	text = (example / 'coreAlone.cpp').read_text()
	body = text[text.index('int main()') :].splitlines()[2:-1]
	assert 0 < len(body) <= 16


def testTheLibraryShowsItsInterfaceAlone(installed):
	"""All that a program can link to is what the public headers declare; other functions of ours and of Eigen are hidden."""
	library = next(installed.glob('lib*/**/libpolytope-core.so'))
	shown = run('nm', '-DC', '--defined-only', library)
	ours = {line.split(' ', 2)[2] for line in shown.splitlines() if ' T ' in line}
	assert any(name.startswith('polytope::contactQuery(') for name in ours) and any(
		name.startswith('polytope::pairDistance(') for name in ours
	)
	assert not any('contactKernel' in name or 'solveLp' in name or name.startswith('Eigen::') for name in ours)
	assert '::Eigen' not in shown and not re.search(r' [WV] Eigen::', shown)


def testAsAPartOfAnotherProject(tmp_path):
	"""add_subdirectory makes the target, without YADE, tests or a build type of ours."""
	lines = ['cmake_minimum_required(VERSION 3.22)', 'project(other C CXX)', f'add_subdirectory({project} polytope)']
	lines += [
		'get_target_property(kind polytope::core TYPE)',
		'message(STATUS "kind ${kind}, type <${CMAKE_BUILD_TYPE}>, yade ${POLYTOPE_YADE}")',
	]
	lines += ['get_target_property(options polytope::core INTERFACE_COMPILE_OPTIONS)', 'message(STATUS "options ${options}")']
	(tmp_path / 'CMakeLists.txt').write_text('\n'.join(lines))
	printed = run('cmake', '-S', tmp_path, '-B', tmp_path / 'build', '-G', 'Ninja')
	assert 'kind SHARED_LIBRARY, type <>, yade OFF' in printed and 'options options-NOTFOUND' in printed
