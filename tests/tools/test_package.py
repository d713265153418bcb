# SPDX-License-Identifier: GPL-2.0-or-later
"""The Debian package as far as its files say it, and `./run package` where no package can be tried. `./run package --test` tries it."""

import pathlib
import re
import subprocess

import pytest
from test_entry import clone, filled, shell, tmp_path  # noqa: F401, the fixtures

project = pathlib.Path(__file__).resolve().parents[2]
control = (project / 'debian/control').read_text()


def field(paragraph, name):
	"""Names of the packages in a field, without versions."""
	found = re.search(rf'^{name}:(.*(?:\n .*)*)', paragraph, re.MULTILINE)[1]
	return {part.split()[0] for part in found.split(',') if part.strip()}


source, plain, withIpopt, documentation, headers, library = control.split('\n\n')


def testVersionsAgree():
	"""The versions of CMake's project, the package and the citation are the same."""
	version = re.search(r'project\(yade-polytope VERSION ([\d.]+)', (project / 'CMakeLists.txt').read_text())[1]
	assert (project / 'debian/changelog').read_text().startswith(f'yade-polytope ({version}-1) ')
	assert re.search(r'^version: (.*)$', (project / 'CITATION.cff').read_text(), re.MULTILINE)[1] == version
	assert f'\n## {version}' in (project / 'CHANGELOG.md').read_text()


def testTheRootHasWhatThePackageIsBuiltFrom(clone, tmp_path):
	given = set(shell(clone, tmp_path, 'packages $(purposesOf package)').stdout.split())
	needed = {re.sub(r'^debhelper-compat$', 'debhelper', name) for name in field(source, 'Build-Depends')}
	assert needed - {'coinor-libipopt-dev'} <= given and 'coinor-libipopt-dev' in given


def testBothPackagesNeedTheSame():
	for name in ('Depends', 'Recommends', 'Architecture', 'Built-Using'):
		assert field(plain, name) == field(withIpopt, name), name
	assert field(plain, 'Conflicts') == {'yade-polytope-ipopt'} and field(withIpopt, 'Conflicts') == {'yade-polytope'}


def testDocumentationNeedsNoYade():
	"""It is for every Debian, from the same build, and doc-base has the page that the rules install."""
	assert field(documentation, 'Architecture') == {'all'} and not any('yade' in name for name in field(documentation, 'Depends'))
	(index,) = re.findall(r'^Index: (.*)$', (project / 'debian/yade-polytope-doc.doc-base').read_text(), re.MULTILINE)
	assert index.removeprefix('/').removesuffix('/index.html') in (project / 'debian/rules').read_text()


def testHeadersComeWithWhatTheyInclude():
	"""The headers need the very version of plug-in and core, and all that the plug-in is built from but what it alone needs. The library's
	package has its number in its name."""
	assert {'libpolytope-core1', 'yade-polytope'} <= field(headers, 'Depends')
	included = {name for name in field(source, 'Build-Depends') if name.endswith('-dev') or 'qt5' in name or name == 'qtbase5-dev'}
	ofOurOwn = {'coinor-libipopt-dev', 'dpkg-dev', 'libcgal-dev', 'libdeflate-dev', 'libgmp-dev'}
	assert included - ofOurOwn <= field(headers, 'Depends')
	abi = re.search(r'set\(polytope_abi (\d+)\)', (project / 'src/CMakeLists.txt').read_text())[1]
	assert library.startswith(f'Package: libpolytope-core{abi}\n')
	assert f'library = libpolytope-core{abi}\n' in (project / 'debian/rules').read_text()


def testEveryModuleThatIsImportedHasItsPackage():
	"""Modules of other projects have packages by the rule of Debian's names; trials of tests/yade/project/test_layers.py have the list of what may be
	imported."""
	named = re.search(r"ofTheProduct = set\('([^']*)'", (project / 'tests/yade/project/test_layers.py').read_text())[1].split()
	packages = {name: f'python3-{name}' for name in named if name != 'coacd'} | {'vtkmodules': 'python3-vtk9', 'PIL': 'python3-pil'}
	assert 'numpy' in packages and set(packages.values()) <= field(plain, 'Depends') | field(plain, 'Recommends')


def version(clone, folder, script):
	"""What packageVersion says in a clone whose history the script makes."""
	(clone / 'debian').mkdir(exist_ok=True)
	(clone / 'debian/changelog').write_text((project / 'debian/changelog').read_text())
	stub = 'dpkg-query() { echo 2025.2.0; }\ngit() { command git -c user.name=x -c user.email=x@x "$@"; }\n'
	done = shell(
		clone,
		folder,
		f'{stub}. "$project/tools/package.sh"\ncd "$project"\n{script}\npackageVersion',
		GIT_CEILING_DIRECTORIES=str(clone.parent),
	)
	assert done.returncode == 0, done.stderr
	return done.stdout.split()[-1]


def testAVersionBeforeTheReleaseIsLessThanIt(clone, tmp_path):
	released = version(clone, tmp_path, '')  # sources without a history
	assert re.fullmatch(r'[\d.]+-1\+yade2025\.2\.0', released)
	before = version(clone, tmp_path, 'git init -q; git add -A; git commit -q -m one')
	assert re.fullmatch(r'[\d.]+~\d{8}\.\d{4}\.[0-9a-f]+-1\+yade2025\.2\.0', before)
	assert version(clone, tmp_path, f'git tag v{released.split("-")[0]}') == released
	changed = version(clone, tmp_path, 'echo >>run')
	assert changed == before.replace('-1+', '.changed-1+')
	for one, other in ((before, released), (before, changed), (changed, released)):
		assert subprocess.run(['dpkg', '--compare-versions', one, 'lt', other]).returncode == 0, (one, other)


@pytest.mark.parametrize(
	'stubs, reason',
	[
		('reachable() { return 1; }; inNamespace() { :; }', 'no mirror of Debian can be reached'),
		('reachable() { :; }; inNamespace() { return 1; }', 'does not allow namespaces'),
		(
			'reachable() { :; }; inNamespace() { :; }; id() { echo 1000; }; command() { [ "$2" != mmdebstrap ] && builtin command "$@"; }',
			'mmdebstrap is not installed',
		),
	],
)
def testWithoutARootNoneIsTried(clone, tmp_path, stubs, reason):
	"""It says why, and that is no failure; a build that fails is one. Without --test the package is made all the same."""
	script = f'. "$project/tools/packageTest.sh"\ndebianMirror() {{ echo http://mirror; }}; testPackage() {{ echo TRIED; }}\n{stubs}\n'
	inside = (
		'inside() { echo "inside $*"; mkdir -p "$project/output/package"; touch "$project/output/package/yade-polytope_1_amd64.deb"; }\n'
	)
	done = shell(clone, tmp_path / 'cache', script + inside + 'package --test')
	assert done.returncode == 0 and 'cannot be tried here' in done.stdout and reason in done.stdout, done.stdout + done.stderr
	assert 'inside' not in done.stdout and 'TRIED' not in done.stdout
	assert shell(clone, tmp_path / 'cache', script + inside + 'package').stdout == 'inside package\n'
	can = script + 'whyNoCleanRoot() { :; }\n'
	assert shell(clone, tmp_path / 'cache', can + inside + 'package --test').stdout == 'inside package\nTRIED\n'
	assert shell(clone, tmp_path / 'cache', can + 'inside() { false; }\npackage --test').returncode == 1


def testCleanRemovesTheCleanRoot(clone, tmp_path):
	cache = filled(tmp_path / 'cache')
	for name in ('debian13Clean', 'debian13Package-abc.partial'):
		(cache / name).mkdir()
	done = shell(clone, cache, 'clean --root')
	assert done.returncode == 0, done.stderr
	assert not list(cache.glob('debian13*'))
