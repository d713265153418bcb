# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run fuzz` and `./run sanitize` leave a log with what identifies the run; the programs they run are stand-ins here."""

import os
import pathlib
import re
import shutil
import subprocess

import pytest

source = pathlib.Path(__file__).resolve().parents[2]
time = r'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ'
fuzzer = """#!/bin/bash
echo "$@" >>"$arguments"
echo '#100 NEW cov: 55 ft: 70'
echo 'stat::number_of_executed_units: 1000'
echo 'stat::new_units_added: 4'
case $0 in *contact) [ -z "$crash" ] || { echo 'contact violated: depth'; exit 77; } ;; esac
"""


@pytest.fixture
def project(tmp_path):
	folder = tmp_path / 'a project'
	shutil.copytree(source / 'tools', folder / 'tools', ignore=shutil.ignore_patterns('measure'))
	programs = folder / 'build/checked/tools/measure/fuzz'
	programs.mkdir(parents=True)
	for target in ('construction', 'contact'):
		for name, text in ((f'polytope_fuzz_{target}', fuzzer), (f'polytope_replay_{target}', '#!/bin/bash\nmkdir -p "$2"\n')):
			(programs / name).write_text(text)
			(programs / name).chmod(0o755)
	subprocess.run(['git', 'init', '-q', folder], check=True)
	identity = ['-c', 'user.name=test', '-c', 'user.email=test@example.org']
	subprocess.run(['git', '-C', folder, *identity, 'commit', '-q', '--allow-empty', '-m', 'one'], check=True)
	return folder


def call(project, command, **environment):
	parts = '. "$project/tools/messages.sh"; . "$project/tools/fuzz.sh"; checkedMemory() { :; }'
	parts += '; checkCore() { sleep 1; }; checkThreads() { return 1; }; checkValgrind() { :; }'
	folders = {
		'project': project,
		'build': project / 'build',
		'logs': project / 'logs',
		'cache': project,
		'arguments': project / 'arguments',
	}
	environment = {**os.environ, 'crash': '', **{name: str(path) for name, path in folders.items()}, **environment}
	return subprocess.run(
		['bash', '-euo', 'pipefail', '-c', f'{parts}; {command}'], env=environment, capture_output=True, text=True, timeout=60
	)


def revisionOf(project):
	return subprocess.run(['git', '-C', project, 'rev-parse', 'HEAD'], capture_output=True, text=True, check=True).stdout.strip()


def logOf(project, kind):
	(path,) = (project / 'output' / kind).glob('log-*.txt')
	return path.read_text()


@pytest.mark.parametrize('crash', ['', 'yes'])
def testFuzzLeavesALog(project, crash):
	done = call(project, 'fuzz --seconds 3 --seed 17', crash=crash)
	assert done.returncode == (1 if crash else 0), done.stderr
	log = logOf(project, 'fuzz')
	lines = log.splitlines()
	assert lines[0].split() == ['revision', revisionOf(project)] and re.fullmatch(f'began    {time}', lines[1])
	assert lines[2].split() == ['seed', '17'] and re.fullmatch(f'ended    {time}', lines[-1])
	rows = {line.split()[0]: line.split()[1:] for line in lines if re.match('(construction|contact) +3 ', line)}
	assert rows == {'construction': ['3', '1000', '55', '4', '0'], 'contact': ['3', '1000', '55', '4', '1' if crash else '0']}
	assert ('violated: depth' in log) == bool(crash)
	assert all(line in done.stdout for line in lines[3:-1]) and 'log: ' in done.stdout
	assert (project / 'arguments').read_text().count('-seed=17 -max_total_time=3 ') == 2


def testFuzzTakesAnotherSeedEachTime(project):
	assert call(project, 'fuzz --seconds 3 --target construction').returncode == 0
	seed = re.search(r'^seed +([1-9]\d*)$', logOf(project, 'fuzz'), re.MULTILINE)[1]
	assert f'-seed={seed} ' in (project / 'arguments').read_text()


@pytest.mark.parametrize('seed', ['0', '-1', 'x', '1e3', ''])
def testWrongSeedsAreRefused(project, seed):
	done = call(project, f"fuzz --seed '{seed}'")
	assert done.returncode == 1 and '--seed' in done.stderr and not (project / 'output').exists()


def testSanitizeLeavesALog(project):
	done = call(project, 'sanitize --only core --only threads')
	assert done.returncode == 1
	lines = logOf(project, 'sanitize').splitlines()
	assert lines[0].split() == ['revision', revisionOf(project)] and re.fullmatch(f'began    {time}', lines[1])
	assert re.fullmatch(r'core: sound, [1-9] s', lines[2]) and re.fullmatch(r'threads: ERRORS, \d s', lines[3])
	assert re.fullmatch(f'ended    {time}', lines[4]) and 'log: ' in done.stdout


def testADryRunLeavesNone(project):
	for command in ('fuzz --dry-run', 'sanitize --dry-run --only core'):
		assert call(project, command).returncode == 0
	assert not (project / 'output').exists()
