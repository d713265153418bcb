# SPDX-License-Identifier: GPL-2.0-or-later
"""The layers depend on each other one way only, and what is installed is the product alone.

	src  <  pkg  <  py/polytope  <  examples/paper/boon2012  <  tools/measure

Each may use what stands to its left; tools/measure also tests/core, which stands beside pkg: tests of src alone, with the exact arithmetic that programs compare with. Files are read as text: an import within a function counts as one at the top of a file.
"""

import ast
import pathlib
import re
import sys

import pytest
from yade import polytope

project = pathlib.Path(__file__).resolve().parents[3]

product, reproduction, measurement = project / 'py/polytope', project / 'examples/paper', project / 'tools/measure'
coreTests = project / 'tests/core'
ofTheProduct = set('PIL coacd cvxopt meshio numpy scipy mpmath matplotlib tabulate tqdm trimesh vtkmodules'.split())
"""Packages of others that it may use; coacd where it is installed, for meshes that are not convex."""


def files(folder, *endings):
	found = sorted(path for path in folder.rglob('*') if path.suffix in endings and '__pycache__' not in path.parts)
	assert found, f'nothing in {folder}'
	return found


def includes(path):
	"""What a C++ file includes, as written."""
	return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(), re.MULTILINE)


def imports(path, package=None):
	"""Names of the modules that a Python file imports, relative ones from the folder *package* as 'package.….module'."""
	names = []
	for node in ast.walk(ast.parse(path.read_text())):
		if isinstance(node, ast.Import):
			names += [alias.name for alias in node.names]
		elif isinstance(node, ast.ImportFrom) and not node.level:
			names += [node.module] + [f'{node.module}.{alias.name}' for alias in node.names]
		elif isinstance(node, ast.ImportFrom):
			place = path.parents[node.level - 1].relative_to(package.parent)  # ValueError: above the package
			module = '.'.join([*place.parts, *([node.module] if node.module else [])])
			names += [module] + [f'{module}.{alias.name}' for alias in node.names]
	return names


def modules(folder):
	"""What `import NAME` could take from the programs and packages of this folder."""
	paths = files(folder, '.py')
	return {path.stem for path in paths} | {path.parent.name for path in paths if path.name == '__init__.py'}


def foreign(names):
	"""Top-level names that are neither Python's own nor YADE's."""
	return {name.split('.')[0] for name in names} - set(sys.stdlib_module_names) - {'yade'}


def testTheCoreKnowsNothingAboveIt():
	"""src includes its own files, and of YADE the numbers alone (Real.hpp)."""
	own = {path.relative_to(project / 'src').as_posix() for path in files(project / 'src', '.hpp')}
	for path in files(project / 'src', '.hpp', '.cpp'):
		for name in includes(path):
			ofAnother = (
				name.startswith(('pkg/', 'py/', 'tests/', 'tools/', 'examples/', 'core/', 'lib/', 'boost/python')) or name == 'Python.h'
			)
			assert not ofAnother or (path.name == 'Real.hpp' and name.startswith('lib/high-precision/')), f'{path.name} includes {name}'
			assert not (project / 'pkg/polytope' / name).is_file() or name in own, f'{path.name} includes {name} of pkg'


folders = (
	'numbers',
	'program',
	'shape',
	'cutting',
	'centre',
	'shear',
	'joint',
	'surface',
	'contact',
	'timestep',
	'bond',
	'bolt',
	'neighbours',
)
"""Folders of src, in this order."""


def testEachFolderOfTheCoreIncludesToTheLeftOnly():
	assert sorted(folders) == sorted(path.name for path in (project / 'src').iterdir() if path.is_dir())
	for path in files(project / 'src', '.hpp', '.cpp'):
		level = folders.index(path.parent.name)
		for name in includes(path):
			if (project / 'src' / name).is_file():
				folder = name.split('/')[0]
				assert folders.index(folder) <= level, f'{path.parent.name}/{path.name} includes {name}'


def reachedFrom(folder):
	"""For each file of a folder the folder's headers that it includes, through others, too."""
	place = {path.name: path for path in files(project / folder, '.hpp')}
	within = {
		path: {place[name] for name in map(lambda name: pathlib.Path(name).name, includes(path)) if name in place}
		for path in files(project / folder, '.hpp', '.cpp')
	}
	reachedBy = {}
	for path in within:
		reached, ahead = set(), set(within[path])
		while ahead:
			reached |= ahead
			ahead = set().union(*(within[one] for one in ahead)) - reached
		reachedBy[path] = reached
	return reachedBy


@pytest.mark.parametrize('folder', ['src', 'pkg/polytope'])
def testNoHeaderIncludesItselfThroughOthers(folder):
	for path, reached in reachedFrom(folder).items():
		assert path not in reached, f'{path.name} includes itself'


def testAFunctorKnowsTheClassesThatItIsOf():
	"""YADE's macro casts to them; where all files are compiled as one a missing header is not noticed."""
	made = 0
	for path, reached in reachedFrom('pkg/polytope').items():
		for names in re.findall(r'FUNCTOR[12]D\(([^)]*)\)', path.read_text()):
			for name in names.replace(' ', '').split(','):
				ownHeader = [header for header in files(project / 'pkg/polytope', '.hpp') if header.stem == name]
				made += len(ownHeader)
				assert path in ownHeader or set(ownHeader) <= reached, f'{path.name} does not include {name}.hpp'
	assert made > 5


def withoutCommentsAndTexts(path):
	return re.sub(r'//.*', '', re.sub(r'"(?:\\.|[^"\\])*"', '""', path.read_text()))


def testAFileIncludesTheFunctionsThatItCalls():
	"""Those that stand outside classes; where all files are compiled as one a missing header is not noticed."""
	code = {path: withoutCommentsAndTexts(path) for path in files(project / 'pkg/polytope', '.hpp', '.cpp')}
	declaredIn = {}
	for path, text in code.items():
		if path.suffix == '.hpp':
			for name in re.findall(r'^(?![\t#}])[^\n=]*?\b([a-z]\w+)\(', text, re.MULTILINE):
				declaredIn.setdefault(name, set()).add(path)
	del declaredIn['decltype']
	assert len(declaredIn) > 50
	reachedBy = reachedFrom('pkg/polytope')
	for path, text in code.items():
		reached = {path} | reachedBy[path]
		for name in set(re.findall(r'(?:(?<![.>:\w])|(?<=yade::))(\w+)\(', text)) & set(declaredIn):
			member = any(re.search(rf'(?<!return)[\w>&*] [*&]?{name}\(', code[one]) for one in reached)
			assert member or declaredIn[name] & reached, f'{path.name} calls {name}() of {sorted(one.name for one in declaredIn[name])}'


rooms = 'host', 'material', 'shape', 'pairs', 'bond', 'bolt', 'contact', 'joint', 'bonding', 'step', 'loads', 'output', 'python'
"""Folders of pkg/polytope, in this order."""


def testEachFolderOfThePlugInIncludesToTheLeftOnly():
	plugin = project / 'pkg/polytope'
	assert sorted(rooms) == sorted(path.name for path in plugin.iterdir() if path.is_dir())
	for path in files(plugin, '.hpp', '.cpp'):
		for name in includes(path):
			if (plugin / name).is_file():
				assert rooms.index(name.split('/')[0]) <= rooms.index(path.parent.name), f'{path.parent.name}/{path.name} includes {name}'


def testThePlugInUsesTheCoreAndYadeAlone():
	plugin = project / 'pkg/polytope'
	for path in files(plugin, '.hpp', '.cpp'):
		for name in includes(path):
			assert not name.startswith(('py/', 'tests/', 'tools/', 'examples/')), f'{path.name} includes {name}'
			if (project / name).is_file():
				assert name.startswith('src/'), f'{path.name} includes {name}'
			elif name.endswith('.hpp') and name.split('/')[0] in rooms:
				assert (plugin / name).is_file(), f'{path.name} includes {name}, which is none of pkg: as <src/{name}>?'


def testTheProductImportsNothingOfReproductionAndMeasurement():
	for path in files(product, '.py'):
		names = imports(path, product)
		assert foreign(names) <= ofTheProduct | {'polytope'}, f'{path.name} imports {foreign(names) - ofTheProduct}'
		for name in names:
			assert not re.match(r'yade\.polytope\b', name), f'{path.name} imports {name}; within the product imports are relative'


parts = """precision arguments _sharedArguments _builds scene pictures bodies bonding measures _timing rest strengthReduction rock check engines
loading breakage dynamics mpi frictionReduction motionRecord tradeoff extensions _helpTexts""".split()
"""Folders and modules of py/polytope, in this order."""


def testEachPartOfTheProductImportsToTheLeftOnly():
	there = {path.stem for path in product.iterdir() if path.name not in ('__pycache__', '__init__.py')}
	assert there == set(parts)
	for path in files(product, '.py'):
		if path == product / '__init__.py':
			continue
		own = path.relative_to(product).parts[0].removesuffix('.py')
		for name in imports(path, product):
			of = name.split('.')[1] if name.startswith('polytope.') else None
			assert of not in parts or parts.index(of) <= parts.index(own), f'{path.relative_to(product)} imports {name}'


def testTheReproductionImportsNothingOfMeasurement():
	for path in files(reproduction, '.py'):
		package = reproduction / 'boon2012'
		names = imports(path, package)
		own = foreign(name for name in names if not name.startswith('boon2012'))
		assert not own & modules(measurement), f'{path.name} imports {own & modules(measurement)}'


def testTestsOfTheCoreKnowTheCoreAlone():
	measured = {path.name for path in files(measurement, '.hpp')}
	for path in files(coreTests, '.hpp', '.cpp'):
		for name in includes(path):
			assert not name.startswith(('pkg/', 'py/', 'tools/', 'examples/', 'core/', 'lib/')), f'{path.name} includes {name}'
			assert name not in measured, f'{path.name} includes {name} of tools/measure'


def testMeasurementUsesNoTestsButThoseOfTheCore():
	"""Its programs compare with the exact arithmetic of tests/core; of pkg's headers and of tests/yade they take nothing."""
	ofThePlugIn = {path.relative_to(project / 'pkg/polytope').as_posix() for path in files(project / 'pkg/polytope', '.hpp')}
	for path in files(measurement, '.hpp', '.cpp'):
		for name in includes(path):
			assert not name.startswith(('pkg/', 'py/', 'tests/yade/', 'examples/')), f'{path.name} includes {name}'
			assert name not in ofThePlugIn or (project / 'src' / name).is_file(), f'{path.name} includes {name} of pkg'
	others = modules(project / 'tests/yade') - modules(measurement) - modules(reproduction)
	for path in files(measurement, '.py'):
		own = foreign(imports(path, measurement))
		assert not own & others, f'{path.name} imports {own & others} of tests/yade'


def testClosedFormsNeedNoYade():
	for path in reproduction.glob('boon2012/*/theory.py'):
		names = imports(path, reproduction / 'boon2012')
		assert foreign(names) <= {'numpy', 'scipy', 'boon2012'} and not any(name.split('.')[0] == 'yade' for name in names), path


def testNothingOfReproductionAndMeasurementIsInstalled():
	"""The module that runs here is the product's folder as the overlay links it; `cmake --install` copies the same one."""
	assert pathlib.Path(polytope.__file__).resolve() == product / '__init__.py'
	assert {path.name for path in (project / 'py').iterdir() if path.name != '__pycache__'} == {'polytope'}
	rules = (project / 'cmake/Install.cmake').read_text()
	installed = re.findall(r'DIRECTORY\s+"\$\{PROJECT_SOURCE_DIR\}/([^"]+)"', rules)
	assert installed == ['py/polytope/'] and 'PATTERN "paper" EXCLUDE' in rules and 'tools' not in rules
