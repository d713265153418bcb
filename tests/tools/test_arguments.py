# SPDX-License-Identifier: GPL-2.0-or-later
"""What `run` refuses before it does anything, what it lets through, and what it says while it waits."""

import pytest
from test_entry import call, clone, shell, tmp_path  # noqa: F401, the fixtures


@pytest.mark.parametrize(
	'arguments, named',
	[
		(['format', '--chekc'], "'--chekc'"),
		(['format', 'src'], "'src'"),
		(['build', '-v'], "'-v'"),
		(['test', '--fsat'], "'--fsat'"),
		(['test', '-k', 'nothing', '--fats'], "'--fats'"),
		(['bench', '--onyl', 'kernels'], "'--onyl'"),
		(['bench', '--only=kernel'], "'kernel'"),
		(['accuracy', '--only', 'pairs', 'nosuch'], "'nosuch'"),
		(['tradeoff', '--only', 'B', 'X'], "'X'"),
		(['paper', '--quik'], "'--quik'"),
		(['search', '--pair', '5'], "'--pair'"),
		(['demo', '--nummer=5'], "'--nummer'"),
		(['fuzz', '--target', 'all'], "'all'"),
		(['sanitize', '--only', 'nothing'], "'nothing'"),
		(['clean', '--root', '--all'], "'--root --all'"),
		(['package', '--tset'], "'--tset'"),
		(['package', 'x.deb'], "'x.deb'"),
	],
)
def testUnknownArgumentsAreRefusedFirst(clone, tmp_path, arguments, named):
	"""They are refused before the cache is even made, so before anything is installed, built or formatted."""
	cache = tmp_path / 'cache'
	done = call(clone, cache, *arguments)
	assert done.returncode == 1 and named in done.stderr.splitlines()[1] and not done.stdout
	assert not cache.exists()


def testKnownArgumentsPass(clone, tmp_path):
	lines = [
		'accuracy --quick --only pairs scenes --output x --jobs 2',
		'bench --only=kernels --output=x',
		'bench --quick --beside ../other',
		'paper --only ACF',
		'demo --seed -1 --shape cube',
		'test --fast -k one --ff -x --pdb',
		'yade -n -x script.py --own',
		'python script.py --own',
		'shell -c ls',
		'build overlay polytope_search',
		'format --check',
		'fuzz --target contact --seconds 5',
		'package --ipopt --test',
		'sanitize --only core --only fuzz --help',
		'search --pairs 5 --family solids',
	]
	done = shell(clone, tmp_path, ''.join(f'checkArguments {line}\n' for line in lines) + 'echo passed')
	assert done.stdout == 'passed\n' and done.returncode == 0, done.stderr


def testWaitingForAnotherBuildIsSaid(clone, tmp_path):
	"""It says so in one line, and then it builds."""
	functions = (clone / 'tools/inside.sh').read_text()
	functions = functions[functions.index('# Builds one precision') : functions.index('# The plug-in of the precision in use')]
	stubs = 'buildFolder() { echo "$cache"; }; configure() { :; }; setDevelop() { :; }; step() { echo built; }; measuringPrograms=\n'
	cache = tmp_path / 'cache'
	cache.mkdir()
	held = 'exec 7>"$cache/build.lock"; flock 7; (exec 8>&-; sleep 1) & exec 7>&-\n'
	for before, expected in (('', ['built']), (held, ['  waiting for another ./run to end its build …', 'built'])):
		done = shell(clone, cache, stubs + functions + before + 'buildPrecision double one')
		assert done.returncode == 0 and done.stdout.splitlines() == expected, done.stderr
