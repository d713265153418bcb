# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run test [--fast] PLACE…`: what runs for a place, with stand-ins for the programs that build and test."""

import re

import pytest
from test_entry import project, shell

stubs = '''
build() { echo "build $*"; }
buildWith() { echo "build overlay $*"; }
hasPrecision() { true; }
buildPrecision() { echo "buildPrecision $*"; }
usePrecision() { precision=$1; }
ctest() { echo ctest; }
pytest() { case $1 in --version) ;; *) echo "pytest $*"; esac; }
python3() { shift; echo "skipped $*"; }
build=$cache/build precision=double cores=1
. "$project/tools/test.sh"
unset YADE_POLYTOPE_PRECISION
'''


def ran(tmp_path, arguments):
	"""(lines of what was called, without where results go; the rest of the process)."""
	done = shell(project, tmp_path, f'{stubs}\ntest_ {arguments}')
	lines = [' '.join(word for word in line.split() if not word.startswith('--junitxml')) for line in done.stdout.splitlines()]
	return [line for line in lines if line.startswith(('build', 'ctest', 'pytest', 'skipped'))], done


def words(line):
	return line.split()


def testAPlaceAloneIsBuiltAndRun(tmp_path):
	lines, done = ran(tmp_path, '--fast joint -n 1')
	assert done.returncode == 0, done.stderr
	assert lines[0] == 'build overlay polytope_native_trace' and not any(line.startswith('ctest') for line in lines)
	assert any(line.startswith('pytest tests/yade/joint') and '-m not slow' in line for line in lines)
	assert '--expect-core' not in lines[-1] and '--expect-precision' not in lines[-1]


def testSeveralPlacesAndAFile(tmp_path):
	lines, done = ran(tmp_path, 'tools rock test_rock_joint::testSlip tests/yade/bond/test_bonds.py -n 1')
	assert done.returncode == 0, done.stderr
	(run,) = [line for line in lines if line.startswith('pytest')]
	assert words(run)[1:5] == [
		'tests/tools',
		'tests/yade/rock',
		'tests/yade/joint/test_rock_joint.py::testSlip',
		'tests/yade/bond/test_bonds.py',
	]
	assert not any('longdouble' in line for line in lines), 'the repeat is of the whole alone'


def testTheCoreAlone(tmp_path):
	lines, done = ran(tmp_path, '--fast core')
	assert done.returncode == 0, done.stderr
	assert lines[0] == 'build overlay testPrograms' and 'ctest' in lines and not any(line.startswith('pytest') for line in lines)


def testWithoutAPlaceAllIsRun(tmp_path):
	lines, done = ran(tmp_path, '-n 1')
	assert done.returncode == 0, done.stderr
	assert lines[0] == 'build overlay testPrograms' and 'ctest' in lines and lines.count('buildPrecision longdouble overlay') == 1
	assert [words(line)[1:3] for line in lines if line.startswith('pytest')] == [['tests/yade', 'tests/tools'], ['tests/yade', '-n']]
	assert lines[-1].startswith('skipped --expect-precision longdouble --expect-core')


@pytest.mark.parametrize('arguments', ['nowhere', '--fast joint nowhere', 'test_nothing'])
def testAPlaceThatThereIsNotIsRefusedFirst(tmp_path, arguments):
	for script in (f'checkArguments test {arguments}', f'{stubs}\ntest_ {arguments}'):
		done = shell(project, tmp_path, script)
		assert done.returncode == 1 and 'there is no place' in done.stderr and 'joint, loads' not in done.stdout and not done.stdout.strip()
	assert 'core, tools, ' in done.stderr and 'rock, ' in done.stderr


def testWhatRunsInTheRootKnowsPlaces():
	"""tools/test.sh is read by inside.sh alone, in another process than `run`."""
	sourced = re.findall(r'^\. "\$project/(tools/\w+\.sh)"', (project / 'tools/inside.sh').read_text(), re.MULTILINE)
	assert 'placeOf' in (project / 'tools/test.sh').read_text()
	assert any(re.search(r'^placeOf\(\)', (project / path).read_text(), re.MULTILINE) for path in sourced)
