# SPDX-License-Identifier: GPL-2.0-or-later
"""The entry script `run` and its parts, with a cache folder and a project of the test's own: nothing is downloaded or installed."""

import os
import pathlib
import shlex
import shutil
import subprocess

import pytest

project = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def tmp_path(tmp_path):
	"""A folder for clone, cache and all else, whose path has what a shell would take apart or expand."""
	folder = tmp_path / 'with spaces, "quotes", it\'s $HOME & *'
	folder.mkdir()
	return folder


@pytest.fixture
def clone(tmp_path):
	"""A clone of the entry script alone, in the folder that holds it."""
	folder = tmp_path / 'source' / 'yade-polytope'
	folder.mkdir(parents=True)
	shutil.copy(project / 'run', folder)
	shutil.copytree(project / 'tools', folder / 'tools')
	return folder


def call(clone, cache, *arguments):
	environment = {**os.environ, 'YADE_POLYTOPE_CACHE': str(cache)}
	return subprocess.run([clone / 'run', *arguments], env=environment, capture_output=True, text=True, timeout=600)


def shell(clone, cache, script, **environment):
	"""The parts of `run`, sourced, and then the script."""
	parts = '\n'.join(f'. "$project/tools/{part}.sh"' for part in ('messages', 'debian', 'debianRoot', 'yadeSource', 'cache', 'verbs'))
	environment = {**os.environ, 'project': str(clone), 'cache': str(cache), 'logs': f'{cache}/logs', **environment}
	return subprocess.run(
		['bash', '-euo', 'pipefail', '-c', f'{parts}\n{script}'], env=environment, capture_output=True, text=True, timeout=600
	)


def filled(cache):
	"""A cache as it is after some calls."""
	for name in ('logs', 'ccache/0', 'bench-venv', 'yade-2025.2.0-1/core'):
		(cache / name).mkdir(parents=True)
	for name in ('lock', 'build.lock', 'logs/building.log', 'yade-2025.2.0-1/core/Scene.hpp', 'yade-2025.2.0-1/RELEASE'):
		(cache / name).touch()
	return cache


def testCleanAllRemovesWhatWasMade(clone, tmp_path):
	cache = filled(tmp_path / 'cache')
	(clone / 'build').mkdir()
	done = call(clone, cache, 'clean', '--all')
	assert done.returncode == 0, done.stderr
	assert not cache.exists() and not (clone / 'build').exists() and (clone / 'run').exists()


def testCleanAllWithTheParentAsCacheLeavesTheClone(clone):
	"""The clone's name begins as those of YADE's sources do; a folder `logs` and a lock may be the user's own."""
	parent = clone.parent
	(parent / 'logs').mkdir()
	for lock in (False, True):
		if lock:
			(parent / 'lock').touch()
		done = call(clone, parent, 'clean', '--all')
		assert done.returncode == 1 and 'yade-polytope' in done.stderr and 'YADE_POLYTOPE_CACHE' in done.stderr
		assert (clone / 'run').exists() and (parent / 'logs').exists()


def testCleanAllLeavesAnotherCloneInTheCache(clone, tmp_path):
	"""A clone of YADE or of this project that a user put there."""
	cache = filled(tmp_path / 'cache')
	assert shell(clone, cache, 'claimCache').returncode == 0
	other = cache / 'yade-trunk'
	(other / 'core').mkdir(parents=True)
	(other / '.git').mkdir()
	(other / 'RELEASE').touch()
	(other / 'core/Scene.hpp').touch()
	assert call(clone, cache, 'clean', '--all').returncode == 0
	assert other.exists() and not (cache / 'yade-2025.2.0-1').exists()


def testSetUpRefusesAFolderOfOthers(clone, tmp_path):
	cache = tmp_path / 'documents'
	cache.mkdir()
	(cache / 'letter.txt').write_text('mine')
	done = shell(clone, cache, 'claimCache')
	assert done.returncode == 1 and 'letter.txt' in done.stderr and not (cache / 'CACHEDIR.TAG').exists()


def testSetUpTakesANewFolderAndAnEarlierVersions(clone, tmp_path):
	for cache in (tmp_path / 'new' / 'deep', filled(tmp_path / 'earlier')):
		assert shell(clone, cache, 'claimCache').returncode == 0
		assert (cache / 'CACHEDIR.TAG').read_text().startswith('Signature: 8a477f597d28d172789f06886806bc55\n')


def testCleanRefusesWhatItDoesNotKnow(clone, tmp_path):
	(clone / 'build').mkdir()
	done = call(clone, tmp_path / 'cache', 'clean', '--al')
	assert done.returncode == 1 and '--al' in done.stderr and (clone / 'build').exists()


def testCleanRefusesAFolderOfOthersBeforeItRemovesAnything(clone, tmp_path):
	cache = tmp_path / 'documents'
	cache.mkdir()
	(cache / 'letter.txt').write_text('mine')
	(clone / 'build').mkdir()
	for option in ('--all', '--root'):
		done = call(clone, cache, 'clean', option)
		assert done.returncode == 1 and 'letter.txt' in done.stderr
		assert (clone / 'build').exists() and (cache / 'letter.txt').exists()


def testARootInUseStays(clone, tmp_path):
	"""Its lock keeps it as long as a process holds it; then it is removed. The build folder stays with --root."""
	cache = filled(tmp_path / 'cache')
	root = cache / 'debian13'
	root.mkdir()
	(clone / 'build').mkdir()
	holder = subprocess.Popen(
		['bash', '-c', f'. {shlex.quote(str(clone))}/tools/debianRoot.sh; holdDebianRoot {shlex.quote(str(root))}; echo held; read -r _'],
		stdin=subprocess.PIPE,
		stdout=subprocess.PIPE,
		text=True,
	)
	try:
		assert holder.stdout.readline() == 'held\n'
		for option in ('--root', '--all'):
			done = call(clone, cache, 'clean', option)
			assert done.returncode == 1 and f'{root} is in use' in done.stdout
			assert root.exists() and (cache / 'logs').exists()
	finally:
		holder.communicate('\n')
	(clone / 'build').mkdir(exist_ok=True)
	done = call(clone, cache, 'clean', '--root')
	assert done.returncode == 0 and f'removing {root}' in done.stdout, done.stderr
	assert not root.exists() and (cache / 'logs').exists() and (clone / 'build').exists()


def testARootThatCannotBeRemovedIsAnError(clone, tmp_path):
	cache = filled(tmp_path / 'cache')
	(cache / 'debian13').mkdir()
	(cache / 'debian13.made').touch()
	for option in ('--root', '--all'):
		done = shell(clone, cache, f'removeDebianRoot() {{ return 1; }}\nclean {option}')
		assert done.returncode == 1 and (cache / 'debian13.made').exists() and (cache / 'logs').exists()


def testAnotherPurposeAddsToTheRoot(clone, tmp_path):
	"""The root that is there is neither made anew nor removed; nor is an earlier version's."""
	cache = filled(tmp_path / 'cache')
	for name in ('debian13/var/lib/dpkg/info', 'debian13/var/lib/dpkg/updates', 'debian13-0123abcd'):
		(cache / name).mkdir(parents=True)
	(cache / 'debian13/var/lib/dpkg/status').write_text(
		''.join(
			f'Package: {name}\nStatus: install ok installed\nVersion: 1\nArchitecture: all\nMaintainer: x <x@x>\nDescription: x\n\n'
			for name in ('yade', 'cmake')
		)
	)
	(cache / 'debian13.made').write_text('1\n')
	functions = (clone / 'run').read_text()
	functions = functions[functions.index('# The Debian root, with') : functions.index('# The source of exactly')]
	stubs = 'makeDebianRoot() { echo MADE; }; removeDebianRoot() { echo REMOVED; }; installInDebianRoot() { shift; printf "%s\\n" "$@" >"$cache/added"; }'
	done = shell(clone, cache, f'{stubs}\n{functions}\nsetUpRoot base test\necho "root is $root"')
	assert done.returncode == 0, done.stderr
	assert 'MADE' not in done.stdout and 'REMOVED' not in done.stdout and f'root is {cache}/debian13' in done.stdout
	assert './run clean --root' in done.stdout, 'a root of 1970 is old'
	added = (cache / 'added').read_text().split()
	assert {'g++', 'python3-pytest-xdist', 'valgrind'} <= set(added) and not {'yade', 'cmake', 'libccd-dev'} & set(added)
	assert (cache / 'debian13-0123abcd').exists()


def testArchivesOfTheRoot(clone, tmp_path):
	"""There are archives with and without further files of sources."""
	functions = (clone / 'run').read_text()
	functions = functions[functions.index('rootArchives()') : functions.index('# Everything before')]
	apt = tmp_path / 'root/etc/apt'
	(apt / 'sources.list.d').mkdir(parents=True)
	(apt / 'sources.list').write_text(
		'deb [signed-by=/a.gpg] https://debian.example/debian trixie main\n\ndeb https://security.example trixie-security main\n'
	)
	expected = ['https://debian.example/debian trixie main', 'https://security.example trixie-security main']
	for _ in range(2):
		done = shell(clone, tmp_path, f'{functions}\nfound=$(rootArchives {shlex.quote(str(tmp_path))}/root)\necho "$found"')
		assert done.returncode == 0 and done.stdout.splitlines() == expected
		(apt / 'sources.list.d/more.list').write_text('deb https://more.example trixie main\n')
		expected = [*expected, 'https://more.example trixie main']


@pytest.mark.parametrize(
	'verb, needed, spared',
	[
		('demo', {'yade', 'g++', 'xvfb'}, {'clang', 'valgrind', 'libgtest-dev', 'libccd-dev', 'python3-pytest', 'clang-format'}),
		('yade', {'yade', 'g++'}, {'clang', 'valgrind', 'libccd-dev'}),
		('build overlay', {'yade'}, {'libgtest-dev'}),
		('build testPrograms', {'yade', 'libgtest-dev'}, {'libccd-dev'}),
		('test --fast', {'python3-pytest-xdist', 'valgrind', 'clang', 'xauth', 'python3-sphinx'}, {'libccd-dev'}),
		('docs', {'yade', 'python3-sphinx', 'python3-myst-parser', 'furo', 'libjs-mathjax'}, {'clang', 'valgrind'}),
		('bench', {'libccd-dev', 'git'}, {'clang', 'valgrind'}),
		('paper', {'git', 'yade'}, {'libccd-dev', 'clang'}),
		('figures --check', {'yade'}, {'libccd-dev', 'git'}),
		('figures --measure bench', {'libccd-dev', 'git'}, {'clang', 'valgrind'}),
		('fuzz', {'clang', 'libclang-rt-dev'}, {'libccd-dev'}),
		('format', {'clang-format'}, {'libccd-dev'}),
	],
)
def testPackagesOfAVerb(clone, tmp_path, verb, needed, spared):
	done = shell(clone, tmp_path, f'packages $(purposesOf {verb})')
	names = done.stdout.split()
	assert done.returncode == 0 and len(names) == len(set(names))
	assert needed <= set(names) and not spared & set(names)


def testAnUnknownPurposeIsRefused(clone, tmp_path):
	done = shell(clone, tmp_path, 'packages base nonsense')
	assert done.returncode == 1 and 'nonsense' in done.stderr


def testProxyIsLeftNowhere(clone, tmp_path):
	"""mmdebstrap fails, or succeeds having written apt's settings into the root as it does: no file that others may read has them."""
	secret = 'http://user:secret@proxy:3128'
	for fails in (1, 0):
		cache = tmp_path / f'cache{fails}'
		cache.mkdir()
		script = f'''
			umask 022
			apt-config() {{ echo 'Acquire::http::Proxy "{secret}";'; }}
			inNamespace() {{ "$@"; }}
			mmdebstrap() {{
				local option root
				for option in "$@"; do case $option in --aptopt=/*) settings=${{option#--aptopt=}} ;; */root) root=$option ;; esac; done
				grep -q secret "$settings" && echo "folder: $(stat -c %a "$(dirname "$root")") $(stat -c %a "$(dirname "$settings")")"
				mkdir -p "$root/etc/apt/apt.conf.d" "$root/etc/dpkg/dpkg.cfg.d"
				cp "$settings" "$root/etc/apt/apt.conf.d/99mmdebstrap"
				return {fails}
			}}
			makeDebianRoot "$cache/debian13" https://debian.example/debian https://security.example yade g++ && echo made || echo failed
			grep -r secret "$cache" || echo none
		'''
		done = shell(clone, cache, script)
		assert done.returncode == 0, done.stderr
		assert done.stdout.splitlines() == ['folder: 700 700', 'failed' if fails else 'made', 'none']
		assert (cache / 'debian13').exists() != bool(fails)


def testProxyIsOnNoCommandLine(clone, tmp_path):
	"""Every user can read the arguments of a running program, but only its owner the environment."""
	script = '''
		apt-config() { echo 'Acquire::http::Proxy "http://user:secret@proxy:3128";'; }
		inNamespace() { bash -c 'echo "arguments: $0 $*"; echo "environment: $APT_WAY"' "$@"; }
		installInDebianRoot "$cache/debian13" cmake
	'''
	done = shell(clone, tmp_path, script)
	assert done.returncode == 0, done.stderr
	assert done.stdout.splitlines() == [
		f'arguments: bash {clone}/tools/installInRoot.sh {tmp_path}/debian13 cmake',
		'environment: Acquire::http::Proxy "http://user:secret@proxy:3128";',
	]


def testInstallingOnTheMachineIsSaid(clone, tmp_path):
	script = '''
		missingPackages() { cat; }
		id() { echo 0; }
		step() { echo "STEP $1"; }
		installMissingPackages base
	'''
	done = shell(clone, tmp_path, script)
	assert done.returncode == 0, done.stderr
	said = done.stdout
	assert said.index('on the machine itself') < said.index('YADE_POLYTOPE_OWN_ROOT=1') < said.index('STEP') and ' yade ' in said


def testCoalIsPinned():
	lines = [line for line in (project / 'tools/coal.txt').read_text().splitlines() if not line.startswith('#')]
	assert any(line.startswith('coal==') for line in lines)
	assert all('==' in line and '--hash=sha256:' in line for line in lines)
	assert '--require-hashes' in (project / 'tools/bench.sh').read_text()


def testBuildsFromOtherSourcesArePutAway(clone, tmp_path):
	"""Builds are another precision's overlay and the programs of the tests: they are kept while the sources are those they were built from."""
	for name in ('src', 'pkg', 'cmake', 'tests/core'):
		(clone / name).mkdir(parents=True)
	(clone / 'CMakeLists.txt').touch()
	(clone / 'src/a.cpp').write_text('one')
	(clone / 'tests/core/aTest.cpp').write_text('one')
	build = clone / 'build'
	overlay, stamp = build / 'overlay/lib/x86_64-linux-gnu/yade-longdouble', build / 'longdouble/overlay.complete'
	ours, program = build / 'overlay/lib/x86_64-linux-gnu/yade-double', build / 'tools/measure/accuracy/polytope_extremes'
	for folder in (overlay, ours, stamp.parent, program.parent):
		folder.mkdir(parents=True)
	for file in (stamp, program):
		file.touch()
	functions = (clone / 'tools/inside.sh').read_text()
	functions = functions[functions.index('buildFolder()') : functions.index('# Builds one precision')]
	functions += '\nbuild=$project/build precision=double widePrecisions="longdouble float128 mpfr150" measuringPrograms=accuracy/polytope_extremes\n'

	def after(script, buildKey='here'):
		done = shell(clone, tmp_path, functions + script, buildKey=buildKey)
		assert done.returncode == 0, done.stderr
		assert ours.exists()
		return overlay.exists(), stamp.exists(), program.exists()

	built = (
		'sourcesKey >"$build/longdouble/sources"; sourcesKey tests >"$build/tools/measure/accuracy/polytope_extremes.sources"; dropStale'
	)
	assert after(built) == (True, True, True)
	(clone / 'tests/core/aTest.py').touch()  # nothing is compiled from it
	assert after('dropStale') == (True, True, True)
	(clone / 'tests/core/aTest.cpp').write_text('two')
	assert after('dropStale') == (True, True, False)
	(clone / 'src/a.cpp').write_text('two')
	assert after('dropStale') == (False, False, False)


def testBuildsForAnotherYadeArePutAway(clone, tmp_path):
	"""The same, where only YADE or the place has changed."""
	testBuildsFromOtherSourcesArePutAway(clone, tmp_path)
	functions = (clone / 'tools/inside.sh').read_text()
	functions = functions[functions.index('# One number for all') : functions.index('# Builds one precision')]
	keys = {shell(clone, tmp_path, functions + 'sourcesKey', buildKey=key).stdout for key in ('here', 'there')}
	assert len(keys) == 2


@pytest.mark.parametrize(
	'was,command,asked,becomes',
	[
		('OFF', 'build', '1', 'ON'),
		('OFF', 'build', '', None),
		('OFF', 'bench', '1', None),
		('ON', 'test', '1', None),
		('ON', 'test', '', 'OFF'),
		('ON', 'accuracy', '1', 'OFF'),
	],
)
def testWhatIsMeasuredIsNoBuildForDeveloping(clone, tmp_path, was, command, asked, becomes):
	"""The build folder is changed to it, and back, by the commands that honour YADE_POLYTOPE_DEVELOP; the others build for use."""
	(clone / 'build').mkdir()
	(clone / 'build/CMakeCache.txt').write_text(f'POLYTOPE_DEVELOP:BOOL={was}\n')
	functions = (clone / 'tools/inside.sh').read_text()
	functions = functions[functions.index('# Whether the plug-in is compiled file by file') : functions.index('buildFolder()')]
	script = f'{functions}\nstep() {{ shift 2; echo "$1 $2"; }}\ncommand={command}\nsetDevelop "$project/build"'
	done = shell(clone, tmp_path, script, YADE_POLYTOPE_DEVELOP=asked)
	assert done.returncode == 0, done.stderr
	assert done.stdout == (f'cmake -DPOLYTOPE_DEVELOP={becomes}\n' if becomes else '')


def testSlowTestsAreThere():
	"""A test that is renamed or moved keeps its place in the list."""
	for line in (project / 'tests/yade/slow.txt').read_text().splitlines():
		if not line.startswith('#'):
			file, name = line.split('::')
			assert f'def {name}(' in next((project / 'tests/yade').rglob(file)).read_text(), line
