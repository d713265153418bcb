# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run fuzz`, `./run sanitize` and `./run search`: that they start, and how they check their options. Their results are not tested here.

Options of all verbs: `run` refuses the ones that a program does not have before there is a program, from the lists in tools/verbs.sh.
"""

import os
import re
import subprocess
import sys

import pytest

if 'buildKey' not in os.environ:
	pytest.skip('not started by ./run', allow_module_level=True)

project = os.environ['project']
build = os.path.dirname(os.environ['YADE_PREFIX'])


def inside(*arguments):
	"""Calls inside.sh as `./run` does, in the place where we are."""
	return subprocess.run(['bash', os.path.join(project, 'tools', 'inside.sh'), *arguments], capture_output=True, text=True, timeout=1800)


def search(*arguments):
	program = os.path.join(build, 'tools', 'measure', 'search', 'polytope_search')
	if not os.path.exists(program):
		pytest.skip('polytope_search is not built: ./run build polytope_search')
	return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=1800)


@pytest.mark.parametrize(
	'verb, options',
	[('fuzz', ['--seconds', '--target', '--dry-run']), ('sanitize', ['--only', 'core', 'threads', 'fuzz', 'valgrind', '--dry-run'])],
)
def testHelpNamesTheOptions(verb, options):
	done = inside(verb, '--help')
	assert done.returncode == 0 and not done.stderr
	assert f'./run {verb}' in done.stdout and all(option in done.stdout for option in options)


programs = {
	'accuracy': ['tools/measure/accuracy/report.py'],
	'bench': ['tools/measure/benchmark/bench.py', '--programs', 'none'],
	'demo': ['examples/paper/a_falling_polyhedra.py'],
	'docs': ['tools/site/build.py'],
	'paper': ['examples/paper/report.py'],
	'tradeoff': ['tools/measure/tradeoff.py'],
}
"""Behind the verbs."""


def listed(function, verb):
	"""What tools/verbs.sh has."""
	return set(
		subprocess.run(
			['bash', '-c', f'. {project}/tools/verbs.sh; {function} {verb}'], capture_output=True, text=True, check=True
		).stdout.split()
	)


@pytest.mark.parametrize('verb', [*programs, 'fuzz', 'sanitize', 'search'])
def testOptionsOfAVerbAreThoseOfItsProgram(verb):
	if verb in programs:
		script, *more = programs[verb]
		done = subprocess.run([sys.executable, os.path.join(project, script), *more, '--help'], capture_output=True, text=True)
	else:
		done = search('--help') if verb == 'search' else inside(verb, '--help')
	assert done.returncode == 0, done.stderr
	assert set(re.findall(r'^ +(?:-h, )?(--[a-z-]+)', done.stdout, re.MULTILINE)) == listed('optionsOf', verb) | {'--help'}
	words = set(re.findall(r'\w+', done.stdout))
	assert listed('namesOf', verb) <= words


@pytest.mark.parametrize('verb', ['accuracy', 'bench', 'tradeoff'])
def testNamesOfAVerbAreThoseOfItsProgram(verb):
	"""A name that there is not is answered with all there are."""
	script, *more = programs[verb]
	done = subprocess.run([sys.executable, os.path.join(project, script), *more, '--only', 'nosuch'], capture_output=True, text=True)
	assert done.returncode == 2 and set(re.findall(r"\w+", done.stderr.split('choose from')[1])) == listed('namesOf', verb)


@pytest.mark.parametrize(
	'arguments, named',
	[
		(['fuzz', '--seconds'], '--seconds'),
		(['fuzz', '--seconds', '0'], '--seconds'),
		(['fuzz', '--seconds', '99999999999999999999'], '--seconds'),
		(['fuzz', '--target', 'nothing'], 'nothing'),
		(['fuzz', '--nonsense'], '--nonsense'),
		(['sanitize', '--only', 'nothing'], 'nothing'),
		(['sanitize', '--only'], '--only'),
		(['sanitize', 'core'], 'core'),
		(['mpi'], 'number of processes'),
		(['mpi', '0', 'x.py'], 'number of processes'),
		(['mpi', '2', 'nowhere.py'], 'nowhere.py'),
	],
)
def testRefusals(arguments, named):
	done = inside(*arguments)
	assert done.returncode == 1 and named in done.stderr and not done.stdout
	assert 'unbound' not in done.stderr


@pytest.mark.parametrize(
	'arguments, folders',
	[
		(['fuzz'], {'checked': ['polytope_fuzz_construction', 'polytope_fuzz_contact']}),
		(['sanitize'], {'checked': ['polytope_fuzz_construction', 'polytope_core_tests'], 'checked-threads': ['polytope_core_tests']}),
	],
)
def testTheyConfigure(arguments, folders):
	"""A dry run reaches the compiler."""
	done = inside(*arguments, '--dry-run')
	assert done.returncode == 0, done.stdout + done.stderr
	for folder, targets in folders.items():
		with open(os.path.join(build, folder, 'CMakeCache.txt')) as cache:
			assert 'clang++' in next(line for line in cache if line.startswith('CMAKE_CXX_COMPILER:'))
		with open(os.path.join(build, folder, 'build.ninja')) as rules:
			text = rules.read()
		assert '-fsanitize=' in text
		for target in targets:
			assert f'build {target}: phony' in text or f'/{target}:' in text, target


def testSearchHelps():
	done = search('--help')
	assert done.returncode == 0 and not done.stderr
	assert '--pairs' in done.stdout and '--quick' in done.stdout and 'Families:' in done.stdout


@pytest.mark.parametrize(
	'arguments',
	[
		['--pairs', '0'],
		['--pairs', '-1'],
		['--pairs', '99999999999999999999'],
		['--pairs', '1e6'],
		['--pairs', '1000000000001'],
		['--pairs'],
		['--seed', '99999999999999999999'],
		['--threads', '-1'],
		['--threads', '4294967296'],
		['--trial', '1'],
		['--family', 'none'],
		['--nonsense'],
		['--quick', '--pairs', '0'],
		['--log', '/proc/nope/x'],
		['--family', 'solids', '--trial', '-1'],
		['--family', 'solids', '--trial', '1', '--quick'],
	],
)
def testSearchRefuses(arguments):
	done = search(*arguments)
	assert done.returncode == 2 and not done.stdout
	message, remedy = done.stderr.splitlines()
	assert next(word for word in reversed(arguments) if word.startswith('--')) in message and '--help' in remedy


def testSearchOfOneTrialSaysWhich():
	done = search('--family', 'solids', '--trial', '99999999', '--threads', '1')
	assert done.returncode == 0 and '\n--seed 1 --family solids --trial 99999999; ' in done.stdout


def testSearchLooksAtAsManyPairsAsItSays():
	done = search('--pairs', '1', '--threads', '1', '--family', search('--help').stdout.split('Families:')[1].split()[0])
	assert done.returncode == 0
	assert int(next(line for line in done.stdout.splitlines() if line.startswith('all ')).split()[1]) >= 1
