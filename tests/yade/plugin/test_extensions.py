# SPDX-License-Identifier: GPL-2.0-or-later
"""Classes of others in a library of their own: the examples of docs/extending.md, built against the installed headers alone, and libraries that do not fit."""

import fcntl
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest
import yade

project = pathlib.Path(__file__).resolve().parents[3]
overlay = pathlib.Path(os.environ.get('YADE_PREFIX', '/usr'))
build = overlay.parent
if not yade.config.libDir.endswith('-double') or not (build / 'CMakeCache.txt').is_file():
	pytest.skip('of the build for double alone, beside its overlay', allow_module_level=True)


def run(*command, **options):
	done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=1200, **options)
	assert done.returncode == 0, done.stdout + done.stderr
	return done.stdout


def built(name, variant='as it is', prefix=overlay, options=(), examples=project / 'examples/extend', **changed):
	"""Path of the library of an example, from a copy of its sources, with other contents of a file `changed`, against the headers in a
	prefix. YADE's headers take a minute, so that copies and what was compiled stay in the build folder for the next run."""
	folder = build / 'testExtensions' / variant.replace(' ', '_') / name
	source, made = folder / 'sources', folder / 'build'
	source.mkdir(parents=True, exist_ok=True)
	with (folder / 'lock').open('w') as lock:  # tests that run side by side need the same library
		fcntl.flock(lock, fcntl.LOCK_EX)
		for path in (examples / name).iterdir():
			text = changed.get(path.stem, path.read_text())
			if not (source / path.name).is_file() or (source / path.name).read_text() != text:
				(source / path.name).write_text(text)
		run('cmake', '-S', source, '-B', made, '-G', 'Ninja', f'-DCMAKE_PREFIX_PATH={prefix}', '-DCMAKE_BUILD_TYPE=Release', *options)
		run('ninja', '-C', made)
		assert not re.search(rf'{project}/(src|pkg)/', run('ninja', '-C', made, '-t', 'deps')), 'it has seen source files'
	return made / f'{name}.so'


@pytest.fixture(scope='module')
def joint():
	return built('ownPhysics')


@pytest.fixture(scope='module')
def rounded():
	return built('roundedPolytope')


def inYade(script, *arguments, **environment):
	"""What a script prints in a YADE of its own; `answer(value)` makes it a value to return."""
	start = 'import json, sys\nimport yade\nfrom yade import *\ndef answer(value):\n\tprint("ANSWER", json.dumps(value))\n'
	clean = {name: value for name, value in os.environ.items() if name != 'YADE_POLYTOPE_EXTENSIONS'}
	command = [sys.executable, '-c', start + script, *map(str, arguments)]
	done = subprocess.run(command, env={**clean, **environment}, capture_output=True, text=True, timeout=600)
	assert done.returncode == 0, done.stdout + done.stderr
	found = re.findall(r'^ANSWER (.*)$', done.stdout, re.MULTILINE)
	return json.loads(found[-1]) if found else None, done.stderr


block = """
from yade import polytope
def scene(stiffness, height, stress=1e5):
	O.reset()
	O.materials.append(OwnJointMat(density=2600, initialStiffness=stiffness, maximumClosure=1e-3, shearStiffness=stiffness, frictionAngle=0.6, largestStress=stress))
	O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid(center=(0, 0, 0.5 + height), extents=(0.5, 0.4, 0.5)))
	O.engines = polytope.engines(physics=Ip2_OwnJointMat_OwnJointMat_OwnJointPhys(), law=Law2_PolytopeGeom_OwnJointPhys_Hyperbolic())
"""


def testALawOfOnesOwnRestsAtItsClosedForm(joint, tmp_path):
	"""k u/(1 − u/V) A = m g; the same after the scene is loaded in a new process, which knows the extension from the environment; and
	nothing is found wrong."""
	saved = tmp_path / 'scene.yade.bz2'
	script = (
		block
		+ """
one = polytope.load(sys.argv[1])
scene(1e8, 1e-4)
found = repr(polytope.check(O))
O.run(10000, True)
c = O.interactions[0, 1]
O.save(sys.argv[2])
answer([float(c.geom.penetrationDepth), float(O.bodies[1].state.mass), found, list(one.classes), one.name])
"""
	)
	(depth, mass, found, classes, name), _ = inYade(script, joint, saved)
	weight, area = mass * 9.81, 0.8
	assert depth == pytest.approx(weight / (area * 1e8 + weight / 1e-3), rel=1e-6)
	assert found.splitlines()[0] == 'nothing was found that is wrong'
	assert name == 'ownPhysics' and sorted(classes)[-1] == 'OwnJointPhys' and len(classes) == 4
	again = (
		'O.load(sys.argv[1])\nO.run(50, True)\nc = O.interactions[0, 1]\nanswer([float(c.geom.penetrationDepth), type(c.phys).__name__])'
	)
	(after, kind), _ = inYade(again, saved, YADE_POLYTOPE_EXTENSIONS=str(joint))
	assert after == pytest.approx(depth, rel=1e-6) and kind == 'OwnJointPhys'


def testTheStepBeforeContactKnowsTheStiffness(joint):
	"""10⁴ times as stiff, the step is a hundredth; a block that is dropped does not leave faster than it came."""
	script = (
		block
		+ """
polytope.load(sys.argv[1])
steps, speeds = [], []
for stiffness in (1e8, 1e12):
	scene(stiffness, 0.05, stress=0)
	steps.append(polytope.stableTimeStep())
scene(1e12, 0.05, stress=1e6)
O.engines[-2].damping = 0
while not O.interactions.countReal():
	came = abs(float(O.bodies[1].state.vel[2]))
	O.step()
O.run(2000, True)
answer([steps, came, abs(float(O.bodies[1].state.vel[2]))])
"""
	)
	(steps, came, left), _ = inYade(script, joint)
	assert steps[0] / steps[1] == pytest.approx(100, rel=1e-9)
	assert came == pytest.approx(math.sqrt(2 * 9.81 * 0.05), rel=0.01) and left < 1.01 * came


def testEachClassHasAnIndexOfItsOwn(joint):
	script = """
from yade import polytope
polytope.load(sys.argv[1])
def indices(base):
	kinds = [getattr(yade, name) for name in dir(yade) if isinstance(getattr(yade, name), type)]
	return [kind().dispIndex for kind in kinds if issubclass(kind, base) and kind is not base]
answer([indices(Material), OwnJointMat().dispIndex, indices(IPhys), OwnJointPhys().dispIndex, OwnJointPhys().dispHierarchy(True)[:2]])
"""
	(materials, material, physics, phys, hierarchy), _ = inYade(script, joint)
	assert materials.count(material) == 1 and physics.count(phys) == 1
	assert hierarchy == ['OwnJointPhys', 'FrictPhys']


hidden = """cmake_minimum_required(VERSION 3.22)
project(ownPhysics C CXX)
set(CMAKE_CXX_FLAGS "-fvisibility=hidden -fvisibility-inlines-hidden")
find_package(yade-polytope 0.1 REQUIRED)
yade_polytope_add_extension(ownPhysics SOURCES ownPhysics.cpp)
%s
"""


def testHiddenVisibilityIsUndoneOrRefused():
	"""By flags of the project, the function undoes it; forced for the file, the library is refused, and YADE goes on."""
	library = built('ownPhysics', 'hidden', CMakeLists=hidden % '')
	assert inYade('from yade import polytope\nanswer(len(polytope.load(sys.argv[1]).classes))', library)[0] == 4
	forced = 'set_source_files_properties(ownPhysics.cpp PROPERTIES COMPILE_OPTIONS "-fvisibility=hidden;-fvisibility-inlines-hidden")'
	assert 'hidden visibility' in refused(built('ownPhysics', 'forced', CMakeLists=hidden % forced))


def refused(library, **environment):
	"""What polytope.load() says; YADE itself, started with the library in its environment, says the same and goes on, and so does
	polytope.load() then."""
	script = """
from yade import polytope
try: polytope.load(sys.argv[1])
except ValueError as error: text = str(error)
answer([text, hasattr(yade, "OwnJointMat"), polytope.extensions()])
"""
	begin = f'the extension {library} is not loaded: '
	(text, *known), _ = inYade(script, library, **environment)
	assert text.startswith(f'path: {begin}') and known == [False, []], text
	reason = text.split(begin, 1)[1]
	again, warning = inYade(script, library, YADE_POLYTOPE_EXTENSIONS=str(library), **environment)
	assert again == [text, False, []] and f'WARNING: {begin}{reason}.' in warning
	return reason


@pytest.mark.parametrize(
	'here, there, reason',
	[
		(b'precision=double', b'precision=single', 'the precision single, and this YADE computes in double'),
		(b'yade=20', b'yade=19', 'it was built for YADE 19'),
		(b'headers=', b'headers=xy', 'with other headers than those of this one'),
	],
	ids=['precision', 'yade', 'headers'],
)
def testWhatDoesNotFitIsRefused(here, there, reason, joint, tmp_path):
	library = tmp_path / 'other.so'
	bytes_ = joint.read_bytes()
	start = bytes_.index(b'yade-polytope-extension\n')
	place = bytes_.index(here, start)
	library.write_bytes(bytes_[:place] + there + bytes_[place + len(there) :])
	assert reason in refused(library)


@pytest.fixture(scope='module')
def otherAbi(tmp_path_factory):
	"""The headers of this plug-in, with another number of the binary interface."""
	prefix = tmp_path_factory.mktemp('otherAbi')
	shutil.copytree(overlay / 'include/yade-polytope-double', prefix / 'include/yade-polytope-double')
	(cmake,) = overlay.glob('lib*/**/cmake/yade-polytope')
	shutil.copytree(cmake, prefix / cmake.relative_to(overlay))
	config = prefix / 'include/yade-polytope-double/polytope/config.hpp'
	text = config.read_text()
	changed = re.sub(r'(#define POLYTOPE_ABI) \d+', r'\1 77', text)
	assert changed != text
	config.write_text(changed)
	return prefix


def testAnExtensionBuiltWithAnotherInterfaceIsRefused(otherAbi):
	library = built('ownPhysics', 'other abi', prefix=otherAbi)
	assert refused(library).startswith('it was built for the binary interface 77 of yade-polytope, and this one has ')


def testTheSumOfTheHeadersChangesWithThem(tmp_path):
	"""By which an extension is compared with the plug-in: the same for the same headers, another one where one of them, or the
	configuration, has another line."""
	source, into = tmp_path / 'source', tmp_path / 'into'
	name = 'host/FlatArchive.hpp'
	(source / 'host').mkdir(parents=True)
	shutil.copy(project / 'pkg/polytope' / name, source / name)
	sums = into / 'yade-polytope/Fingerprint.hpp'

	def made():
		options = {'SOURCE': source, 'PREFIX': 'yade-polytope', 'INTO': into, 'HEADERS': name, 'CORE': '', 'STAMP': tmp_path / 'stamp'}
		run(
			'cmake',
			*(f'-D{key}={value}' for key, value in options.items()),
			f'-DFINGERPRINT={sums}',
			'-P',
			project / 'cmake/publicHeaders.cmake',
		)
		return re.search(r'YADE_POLYTOPE_FINGERPRINT "(\w{64})"', sums.read_text())[1]

	first = made()
	assert made() == first
	with (source / name).open('a') as file:
		file.write('// another line\n')
	second = made()
	assert second != first
	(into / 'polytope').mkdir()
	(into / 'polytope/config.hpp').write_text('#define POLYTOPE_ABI 2\n')
	assert made() not in (first, second)


@pytest.fixture(scope='module')
def wide():
	"""The example, built for long double by the function for CMake."""
	if not (overlay / 'include/yade-polytope-longdouble').is_dir():
		pytest.skip('the plug-in is not built for long double')
	return built('ownPhysics', 'long double', options=['-DYADE_POLYTOPE_PRECISION=longdouble'])


@pytest.fixture(scope='module')
def inLongDouble():
	"""Environment of YADE in long double, with this plug-in."""
	if not (build / 'longdouble/overlay.complete').is_file():
		pytest.skip('the plug-in is not built for long double')
	(path,) = pathlib.Path('/usr/lib').glob('*/yade-longdouble/py')
	return {'PYTHONPATH': str(path)}


def testAnExtensionForLongDoubleIsRefusedInDouble(wide):
	assert refused(wide).startswith('it was built for the precision longdouble, and this YADE computes in double;')


def testLongDoubleHasItsOwnExtensions(joint, wide, inLongDouble):
	"""That for double is refused; its own has the closed form, with more digits than double."""
	assert refused(joint, **inLongDouble).startswith('it was built for the precision double, and this YADE computes in longdouble;')
	script = (
		block
		+ """
polytope.load(sys.argv[1])
scene(1e8, -5e-6)
O.dt = 1e-12
O.step()
c = O.interactions[0, 1]
u, k, v, area = c.geom.penetrationDepth, 1e8, O.materials[0].maximumClosure, c.geom.contactArea
force = area * k * u / (1 - u / v)
answer([str(c.phys.normalForce[2] / force - 1), str(u), polytope.buildInfo()['precision'], str(1 + type(u)(2)**-60 == 1)])
"""
	)
	(ratio, depth, precision, rounded), _ = inYade(script, wide, **inLongDouble)
	assert precision == 'longdouble' and rounded == 'False'
	h, a, b = 5e-6, 1, 0.8  # a face of a × b, whose pressure falls to zero at the rim over the depth h
	assert float(depth) == pytest.approx(h - (a + b) * h**2 / (2 * a * b), rel=1e-9)
	assert abs(float(ratio)) < 2**-58


def testWhatIsNoExtensionIsRefused(tmp_path):
	library = tmp_path / 'none.so'
	shutil.copy(build / 'src/libpolytope_core.a', library)
	assert 'it is no extension of yade-polytope' in refused(library)


@pytest.mark.parametrize('part', [0.5, 0.9, 0.9999])
def testAFileThatIsCutOffIsRefused(part, joint, tmp_path):
	"""With the text that it has about itself: the dynamic linker would end the process."""
	whole = joint.read_bytes()
	library = tmp_path / 'part.so'
	library.write_bytes(whole[: int(part * len(whole))])
	text = f'its file is cut off: it has {int(part * len(whole))} of {len(whole)} bytes; copy it or build it again'
	assert refused(library) == text


def testWhatIsNoFileIsRefused(joint, tmp_path):
	"""By polytope.load, and at the start in YADE_POLYTOPE_EXTENSIONS, where the others are loaded."""
	script = """
from yade import polytope
def said(path):
	try: polytope.load(path)
	except (ValueError, FileNotFoundError) as error: return str(error)
answer([said(path) for path in (None, 5, sys.argv[1], sys.argv[1] + '/none.so')])
"""
	(nothing, number, folder, missing), _ = inYade(script, tmp_path)
	assert nothing == 'path: must be the path of a library that yade_polytope_add_extension has built, got None'
	assert number.endswith('got 5')
	assert folder == f'path: the extension {tmp_path} is not loaded: it is a folder; give the path of the library in it'
	assert missing.startswith(f'path: there is no file {tmp_path}/none.so')
	known, warning = inYade('answer(hasattr(yade, "OwnJointMat"))', YADE_POLYTOPE_EXTENSIONS=f'{tmp_path}:{tmp_path}/none.so:{joint}')
	assert known is True
	assert f'WARNING: the extension {tmp_path} is not loaded: it is a folder; give the path of the library in it.' in warning
	assert f'WARNING: the extension {tmp_path}/none.so is not loaded: there is no such file; build the extension first.' in warning


def testARefusalIsTheSameAgain(joint, tmp_path):
	"""Asked for again, a copy whose classes are there already, and which stays in the process, is refused with the same words."""
	copy = tmp_path / 'copy.so'
	shutil.copy(joint, copy)
	script = """
from yade import polytope
polytope.load(sys.argv[1])
def said():
	try: polytope.load(sys.argv[2])
	except ValueError as error: return str(error)
answer([said(), said()])
"""
	(first, second), _ = inYade(script, joint, copy)
	assert 'there is a class Own' in first and first == second


def testAPrecisionThatIsNotThereIsNamed(tmp_path):
	"""By CMake, before anything is compiled."""
	text = 'cmake_minimum_required(VERSION 3.22)\nproject(other C CXX)\nset(YADE_POLYTOPE_PRECISION mpfr151)\nfind_package(yade-polytope 0.1 REQUIRED)\n'
	(tmp_path / 'CMakeLists.txt').write_text(text)
	command = ['cmake', '-S', str(tmp_path), '-B', str(tmp_path / 'build'), f'-DCMAKE_PREFIX_PATH={overlay}']
	done = subprocess.run(command, capture_output=True, text=True, timeout=300)
	assert done.returncode != 0 and 'YADE_POLYTOPE_PRECISION=mpfr151' in ' '.join(done.stderr.split())


@pytest.mark.parametrize('name', ['libaaa.so', 'libzzz.so', 'any name.so'])
def testTheFolderOfExtensions(name, joint, tmp_path):
	"""What lies there is loaded when YADE starts, whatever its name; what does not fit is left out; a build does not empty the folder."""
	prefix = tmp_path / 'prefix'
	shutil.copytree(overlay / 'lib', prefix / 'lib', symlinks=True)
	libraries = prefix / pathlib.Path(yade.config.libDir).relative_to(overlay)
	place = libraries.parent / 'yade-polytope/double'
	place.mkdir(parents=True, exist_ok=True)
	shutil.copy(joint, place / name)
	(place / 'broken.so').write_text('nothing')
	known, warning = inYade('answer([hasattr(yade, "OwnJointMat"), hasattr(yade, "RockJointMat")])', YADE_PREFIX=str(prefix))
	assert known == [True, True] and 'broken.so is not loaded: it is no extension' in warning
	own = libraries / 'polytope-py/mine.txt'
	own.write_text('mine')
	arguments = {
		'YADE_LIBRARY_DIR': pathlib.Path(yade.__file__).resolve().parents[3],
		'OVERLAY': libraries.parent,
		'PROGRAMS': prefix / 'bin',
	}
	arguments |= {
		'GATE': build / 'pkg/polytope/libpolytope.so',
		'CLASSES': build / 'pkg/polytope/_polytope.so',
		'PYTHON_PACKAGE': project / 'py/polytope',
	}
	run('cmake', *(f'-D{key}={value}' for key, value in arguments.items()), '-P', project / 'cmake/overlay.cmake')
	assert own.read_text() == 'mine' and (place / name).is_file()


def testProcessesThatAreStartedKnowIt(joint):
	script = """
from yade import polytope
import subprocess
polytope.load(sys.argv[1])
polytope.load(sys.argv[1])
code = 'import yade; print(hasattr(yade, "OwnJointMat"))'
answer([subprocess.run([sys.executable, '-c', code], capture_output=True, text=True).stdout.strip().endswith('True'), len(polytope.extensions())])
"""
	assert inYade(script, joint)[0] == [True, 1]


def testWithoutStiffnessesCheckSaysSo():
	"""A functor of an extension that does not tell the time step how stiff its contacts can be."""
	text = (project / 'examples/extend/ownPhysics/ownPhysics.cpp').read_text()
	silent = re.sub(r'std::optional<ContactStiffness> stiffnesses\((.*?)\) const override', r'ContactStiffness other(\1) const', text)
	assert silent != text
	library = built('ownPhysics', 'silent', ownPhysics=silent)
	script = block + 'polytope.load(sys.argv[1])\nscene(1e8, 0.1)\nanswer([[one.what, one.seen] for one in polytope.check(O)])'
	found, _ = inYade(script, library)
	name = 'Ip2_OwnJointMat_OwnJointMat_OwnJointPhys'
	assert any(what == 'time step' and f'{name} does not say how stiff' in seen for what, seen in found), found


@pytest.fixture(scope='module')
def thrower():
	"""A library with a static object whose constructor does what the environment says."""
	text = (project / 'examples/extend/hyperbolicJoint/hyperbolicJoint.cpp').read_text()
	added = """
#include <cstdlib>
#include <stdexcept>
struct Thrower {
	Thrower()
	{
		const std::string what = std::getenv("THROWER") ? std::getenv("THROWER") : "";
		if (what == "exception") throw std::runtime_error("no licence");
		if (what == "number") throw 5;
		if (what == "abort") std::abort();
		if (what == "exit") std::_Exit(3);
		if (what == "quiet") std::_Exit(0);
		if (what == "end") std::exit(0);
	}
};
const Thrower thrower;
"""
	return built('hyperbolicJoint', 'thrower', hyperbolicJoint=text + added)


@pytest.mark.parametrize(
	'what, reason',
	[
		('exception', 'throws: no licence'),
		('number', 'throws: an object that is no std::exception'),
		('abort', 'ends the process: Aborted'),
		('exit', 'ends the process'),
		('quiet', 'ends the process'),
		('end', 'ends the process'),
	],
)
def testAConstructorThatThrowsIsRefused(what, reason, thrower):
	"""The constructor of a static object runs while the library is loaded, where no exception can be caught."""
	assert refused(thrower, THROWER=what) == f'a constructor of its static objects {reason}'
	assert inYade('from yade import polytope\nanswer(polytope.load(sys.argv[1]).name)', thrower)[0] == 'hyperbolicJoint'


def testWhatWasRefusedOnTrialIsLookedAtAnew(thrower, joint, tmp_path):
	"""In the same process, under the same path: when its constructor no longer throws, and when another library is there. One that was
	refused after it had been loaded stays there, and the answer says that."""
	twice = tmp_path / 'twice.so'
	shutil.copy(joint, twice)
	script = """
import os, shutil
from yade import polytope
def said(path):
	try: return polytope.load(path).name
	except ValueError as error: return str(error).split('is not loaded: ')[1]
place, thrower, joint, twice = sys.argv[1:]
shutil.copy(thrower, place)
os.environ['THROWER'] = 'exception'
answers = [said(place), said(place)]
shutil.copy2(joint, place + '.new')
os.utime(place + '.new', ns=(os.stat(place).st_atime_ns, os.stat(place).st_mtime_ns))
os.replace(place + '.new', place)
answers += [said(place), said(twice), said(twice)]
shutil.copy(thrower, twice + '.new')
os.replace(twice + '.new', twice)
answers.append(said(twice))
os.environ['THROWER'] = ''
answers.append(said(thrower))
answer(answers)
"""
	(first, again, anew, double, doubleAgain, other, mended), _ = inYade(script, tmp_path / 'place.so', thrower, joint, twice)
	assert first == again == 'a constructor of its static objects throws: no licence'
	assert anew == 'ownPhysics'
	assert double == doubleAgain and double.startswith('there is a class Own')
	assert other.startswith('it was built anew after it was refused') and double in other and 'start YADE again' in other
	assert mended == 'hyperbolicJoint'
