# SPDX-License-Identifier: GPL-2.0-or-later
"""`cmake --install` under a prefix of one's own, and into a staging folder; `uninstall.cmake` leaves nothing."""

import os
import pathlib
import re
import subprocess
import sys

import pytest
import yade

if 'buildKey' not in os.environ:
	pytest.skip('not started by ./run', allow_module_level=True)

build = pathlib.Path(os.environ['YADE_PREFIX']).parent
if yade.config.libDir.endswith('-double'):
	libraries = pathlib.Path(os.path.relpath(yade.config.libDir, yade.config.prefix))
else:
	pytest.skip('of the build for double alone', allow_module_level=True)
files = 'libpolytope.so', 'polytope-py/_polytope.so', 'polytope-py/polytope/__init__.py', 'polytope-py/polytope/bodies/meshes/files.py'


@pytest.fixture(autouse=True)
def manifest():
	"""CMake's list of what was installed last stays as it was: it is the user's."""
	lists = {path: path.read_bytes() for path in build.glob('install_manifest*.txt')}
	yield
	for path in build.glob('install_manifest*.txt'):
		path.unlink()
	for path, text in lists.items():
		path.write_bytes(text)


def cmake(*arguments, **environment):
	return subprocess.run(['cmake', *arguments], env={**os.environ, **environment}, capture_output=True, text=True, timeout=300)


def remaining(folder):
	return [path for path in folder.rglob('*') if not path.is_dir() or path.is_symlink()]


def testAPrefixOfOnesOwn(tmp_path):
	"""YADE runs from there; nothing of an earlier version stays beside the new files; nothing is left in the end."""
	prefix = tmp_path / 'own'
	old = prefix / libraries / 'polytope-py/polytope/earlier.py'
	old.parent.mkdir(parents=True)
	old.touch()
	done = cmake('--install', str(build), '--prefix', str(prefix), '--strip')
	assert done.returncode == 0, done.stderr
	assert all((prefix / libraries / name).is_file() for name in files) and not old.exists()
	documents = prefix / 'share/doc/yade-polytope'
	assert all(
		(documents / name).is_file()
		for name in (
			'LICENSE',
			'README.md',
			'CITATION.cff',
			'docs/install.md',
			'docs/funnel.png',
			'examples/mesh.py',
			'examples/pebble.obj',
		)
	)
	assert not (documents / 'examples/paper').exists()
	assert (prefix / libraries / files[1]).stat().st_size < (build / 'pkg/polytope/_polytope.so').stat().st_size, 'not stripped'
	script = 'import yade; from yade import polytope; print(polytope.__file__, polytope.cuboid((0, 0, 0), (1, 1, 1)).shape)'
	environment = {**os.environ, 'YADE_PREFIX': str(prefix)}
	run = subprocess.run([sys.executable, '-c', script], env=environment, capture_output=True, text=True, timeout=300)
	assert run.returncode == 0 and '<Polytope' in run.stdout and f'{prefix}/lib' in run.stdout, run.stdout + run.stderr
	assert remaining(prefix)
	done = cmake(f'-DCMAKE_INSTALL_PREFIX={prefix}', '-P', str(build / 'uninstall.cmake'))
	assert done.returncode == 0 and not remaining(prefix), done.stderr
	again = cmake(f'-DCMAKE_INSTALL_PREFIX={prefix}', '-P', str(build / 'uninstall.cmake'))
	assert again.returncode == 1 and 'no yade-polytope' in again.stderr


def testAStagingFolder(tmp_path):
	"""Makers of packages use one: under YADE's own prefix no links are made."""
	where = {'DESTDIR': str(tmp_path)}
	own = pathlib.Path(re.search(r'^YADE_LIBRARY_DIR:PATH=(.*)$', (build / 'CMakeCache.txt').read_text(), re.MULTILINE)[1])
	prefix = str(own).removesuffix(f'/{libraries}')
	assert cmake('--install', str(build), '--prefix', prefix, '--component', 'plugin', **where).returncode == 0
	found = remaining(tmp_path)
	assert all(tmp_path / own.relative_to('/') / name in found for name in files)
	assert not any(path.is_symlink() for path in found) and not list(tmp_path.rglob('LICENSE'))
	assert cmake(f'-DCMAKE_INSTALL_PREFIX={prefix}', '-P', str(build / 'uninstall.cmake'), **where).returncode == 0
	assert not remaining(tmp_path)


def testFilesOfAnotherYadeAreNotReplaced(tmp_path):
	other = tmp_path / libraries / 'libyade.so'
	other.parent.mkdir(parents=True)
	other.write_text('own')
	done = cmake('--install', str(build), '--prefix', str(tmp_path))
	assert done.returncode == 1 and 'another YADE' in done.stderr and other.read_text() == 'own'
