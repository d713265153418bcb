# SPDX-License-Identifier: GPL-2.0-or-later
"""A YADE that somebody has built (`-DYADE_EXECUTABLE=…`): what CMake finds out about it, and what it refuses. It is configured here, not compiled.

The YADE of these tests is a prefix with the program and the config.py of Debian's, changed to what another build would have written into them.
"""

import os
import pathlib
import re
import subprocess
import sys

import pytest
import yade

if 'buildKey' not in os.environ:
	pytest.skip('not started by ./run', allow_module_level=True)

project = pathlib.Path(__file__).resolve().parents[3]
cache = (pathlib.Path(os.environ['YADE_PREFIX']).parent / 'CMakeCache.txt').read_text()
sources = pathlib.Path(re.search(r'^YADE_SOURCE_DIR:PATH=(.*)$', cache, re.MULTILINE)[1])
debian = pathlib.Path(yade.__file__).resolve().parents[2]  # …/yade-double


def ownYade(prefix, libraries='lib64/dem', name='yade-2025.2.0', **config):
	"""Makes the prefix of a YADE built with `-DLIBRARY_OUTPUT_PATH=libraries`, with these values in its config.py; its program."""
	config = {'libPATH': libraries, 'features': ' LOGGER VTK OPENMP GTS', 'sourceRoot': str(sources)} | config
	folder = prefix / libraries / name
	(folder / 'py/yade').mkdir(parents=True)
	(prefix / 'bin').mkdir()
	for library in debian.glob('lib*.so'):
		(folder / library.name).symlink_to(library)
	text = (debian / 'py/yade/config.py').read_text()
	for key, value in config.items():
		text, found = re.subn(rf"^{key}( *)=('[^'\n]*'|\w+)", rf'{key}\1={value!r}', text, flags=re.MULTILINE)
		assert found == 1, key
	(folder / 'py/yade/config.py').write_text(text)
	program = prefix / 'bin' / name
	(prefix / 'bin/python').symlink_to(sys.executable)
	program.write_text(f"#!{prefix}/bin/python\nlibPATH='{libraries}'\n")
	(prefix / f'bin/{name}-batch').write_text(program.read_text())
	return program


def configured(program, build, *options):
	"""What CMake says, in one line, and whether it goes on."""
	command = ['cmake', '-S', project, '-B', build, '-G', 'Ninja', '-DPOLYTOPE_TESTS=OFF', f'-DYADE_EXECUTABLE={program}', *options]
	done = subprocess.run(command, capture_output=True, text=True, timeout=300)
	return ' '.join((done.stdout + done.stderr).split()), done.returncode == 0


def testWhatTheProgramTells(tmp_path):
	"""Folder, Python, version, features, macros and sources; the default place to install to. A link to the program will do."""
	prefix = tmp_path / 'install'
	link = tmp_path / 'yade'
	link.symlink_to(ownYade(prefix, highPrecisionMpmath=False))
	said, good = configured(link, tmp_path / 'build')
	assert good and f'YADE 2025.2.0 in {prefix}/lib64/dem/yade-2025.2.0: LOGGER VTK OPENMP GTS' in said, said
	assert f'Found Python3: {prefix}/bin/python' in said
	commands = (tmp_path / 'build/compile_commands.json').read_text()
	macros = {name for name in re.findall(r'-D(YADE_\w+)', next(line for line in commands.splitlines() if 'unit_1.cpp.o' in line))}
	assert {'YADE_BOOST_LOG', 'YADE_VTK', 'YADE_OPENMP', 'YADE_GTS', 'YADE_DISABLE_REAL_MULTI_HP'} <= macros
	assert not {'YADE_OPENGL', 'YADE_MPI', 'YADE_CGAL', 'YADE_LS_DEM'} & macros and f'-isystem {sources}' in commands
	assert f'CMAKE_INSTALL_PREFIX:PATH={prefix}\n' in (tmp_path / 'build/CMakeCache.txt').read_text()


def testItsPrecision(tmp_path):
	program = ownYade(tmp_path / 'install', highPrecisionName='PrecisionLongDouble', highPrecisionBits=80, highPrecisionDecimalPlaces=18)
	said, good = configured(program, tmp_path / 'build')
	assert good, said
	assert '"longdouble"' in (tmp_path / 'build/pkg/polytope/BuildInfo.hpp').read_text()
	assert 'yade::Real' in (tmp_path / 'build/generated/polytope/config.hpp').read_text()


@pytest.mark.parametrize(
	'changes, text',
	[
		({'features': ' LOGGER VTK NEW_ENGINE'}, 'the feature NEW_ENGINE, unknown to'),
		({'features': ' LOGGER MASK_ARBITRARY'}, 'the number of bits of its masks cannot be known'),
		({'features': ' LOGGER VECTORIZE'}, 'it changes the alignment of all Eigen types'),
		({'highPrecisionName': 'PrecisionFloat', 'highPrecisionBits': 32}, 'This YADE computes with PrecisionFloat;'),
		({'version': '2024.1.0'}, 'YADE 2024.1.0 is in'),
		({'version': '2025-11-03.git-abc1234'}, 'They must be the same version'),
		({'sourceRoot': '/nowhere'}, 'its source tree is needed for the headers: set YADE_SOURCE_DIR'),
	],
)
def testARefusedYade(changes, text, tmp_path):
	said, good = configured(ownYade(tmp_path / 'install', **changes), tmp_path / 'build')
	assert not good and text in said, said


def testSourcesThatAreNoRelease(tmp_path):
	(tmp_path / 'trunk/core').mkdir(parents=True)
	(tmp_path / 'trunk/core/Scene.hpp').touch()
	said, good = configured(ownYade(tmp_path / 'install', sourceRoot=str(tmp_path / 'trunk')), tmp_path / 'build')
	assert not good and 'trunk has no file RELEASE' in said, said


def testNoYade(tmp_path):
	"""A name that is no file, a folder, another program, and a program without its libraries."""
	program = ownYade(tmp_path / 'install')
	for name in (tmp_path / 'nothing', tmp_path / 'install', pathlib.Path('/bin/sh')):
		said, good = configured(name, tmp_path / 'build')
		assert not good and f"YADE_EXECUTABLE={name} is not YADE's program. Name the file" in said, said
	said, good = configured(f'{program}-batch', tmp_path / 'build')
	assert not good and f'are not in {tmp_path}/install/lib64/dem/yade-2025.2.0-batch: name the program' in said, said
