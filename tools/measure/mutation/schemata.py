# SPDX-License-Identifier: GPL-2.0-or-later
"""A copy of the project in which all mutants stand, built once (mutant schemata); what does not compile is taken out."""

import concurrent.futures
import hashlib
import json
import pathlib
import re
import shutil
import subprocess

from sites import written

project = pathlib.Path(__file__).resolve().parents[3]
copied = ('CMakeLists.txt', 'cmake', 'src', 'pkg', 'py', 'tests', 'examples', 'tools/measure')


def put(path, text):
	"""Writes a file only if it changes, so that nothing is compiled twice."""
	if not path.exists() or path.read_text() != text:
		path.parent.mkdir(parents=True, exist_ok=True)
		path.write_text(text)


def cached(name):
	"""A variable of the project's own build."""
	found = re.search(rf'^{name}:\w+=(.*)$', (project / 'build/CMakeCache.txt').read_text(), re.MULTILINE)
	return found.group(1) if found else ''


class Schemata:
	"""mutants are those that are still in; drop() takes one out for good."""

	def __init__(self, folder, mutants, say):
		self.tree, self.build, self.say = folder / 'tree', folder / 'tree/build', say
		self.mutants, self.dropped = list(mutants), []
		for name in copied:
			source, target = project / name, self.tree / name
			if source.is_file():
				put(target, source.read_text())
				continue
			shutil.copytree(source, target, copy_function=self.copy, dirs_exist_ok=True, ignore=shutil.ignore_patterns('__pycache__'))

	def copy(self, source, target):
		"""Sources are written by write(), with mutants; all else as it is."""
		name = str(pathlib.Path(target).relative_to(self.tree))
		if not any(mutant.file == name for mutant in self.mutants):
			data = pathlib.Path(source).read_bytes()
			if not pathlib.Path(target).exists() or pathlib.Path(target).read_bytes() != data:
				shutil.copy(source, target)

	def write(self):
		for name in {mutant.file for mutant in self.mutants + self.dropped}:
			put(self.tree / name, written((project / name).read_text(), [mutant for mutant in self.mutants if mutant.file == name]))

	def configure(self):
		"""-O1, which no build type of the project has: half the time to compile."""
		header = project / 'tools/measure/mutation/Switch.hpp'
		command = [
			'cmake',
			'-S',
			self.tree,
			'-B',
			self.build,
			'-G',
			'Ninja',
			'-DPOLYTOPE_YADE=ON',
			f'-DPOLYTOPE_OVERLAY={self.build}/overlay',
		]
		command += [f'-DYADE_SOURCE_DIR={cached("YADE_SOURCE_DIR")}', f'-DCMAKE_CXX_FLAGS=-O1 -DNDEBUG -w -include {header}']
		command += ['-DCMAKE_BUILD_TYPE=Mutants']
		subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

	def drop(self, messages):
		"""Takes out the mutants that these messages of the compiler name; their number."""
		bad = {mutant.id for mutant in namedIn(messages, self.tree, self.mutants)}
		self.dropped += [mutant for mutant in self.mutants if mutant.id in bad]
		self.mutants = [mutant for mutant in self.mutants if mutant.id not in bad]
		return len(bad)

	def checkSyntax(self, jobs):
		"""The files that have the contact kernel, without code: cheaper than to build until nothing fails, since all tests include its headers."""
		self.write()
		if (self.build / 'checked').exists() and (self.build / 'checked').read_text() == str([mutant.id for mutant in self.mutants]):
			return
		commands = json.loads((self.build / 'compile_commands.json').read_text())
		commands = [entry for entry in commands if '/tree/src/contact/' in entry['file']]

		def messages(entry):
			done = subprocess.run(
				entry['command'] + ' -fsyntax-only -fmax-errors=0', shell=True, cwd=entry['directory'], capture_output=True, text=True
			)
			return done.stderr if done.returncode else ''

		while commands:
			self.write()
			with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
				texts = list(pool.map(messages, commands))
			commands = [entry for entry, text in zip(commands, texts, strict=True) if text]
			count = self.drop('\n'.join(texts))
			self.say(f'{len(commands)} files do not compile; {count} mutants taken out')
			if commands and not count:
				raise RuntimeError('no mutant is to blame:\n' + '\n'.join(texts)[:3000])
		put(self.build / 'checked', str([mutant.id for mutant in self.mutants]))

	def key(self, sources):
		"""Names the mutants that are in the build."""
		return hashlib.sha256(f'{sources} {[mutant.id for mutant in self.mutants]}'.encode()).hexdigest()[:16]

	def make(self, jobs, *targets):
		while True:
			self.write()
			done = subprocess.run(['ninja', '-C', self.build, '-k', '0', '-j', str(jobs), *targets], capture_output=True, text=True)
			if not done.returncode:
				return
			count = self.drop(done.stdout)
			self.say(f'{targets[0]}: {count} mutants taken out')
			if not count:
				raise RuntimeError('no mutant is to blame:\n' + done.stdout[-3000:])

	def link(self, jobs, units):
		"""The core's tests of the project's own build with these files of src/ and tests/core/, with mutants, in the place of its own; the
		program's path."""
		objects = {unit: objectOf(unit) for unit in units}
		self.make(jobs, *objects.values())
		program, own = self.build / 'testsOfUnits', project / 'build'
		subprocess.run(['ninja', '-C', own, '-j', str(jobs), 'polytope_core_tests'], check=True, stdout=subprocess.DEVNULL)
		found = subprocess.run(
			['ninja', '-C', own, '-t', 'commands', 'tests/core/polytope_core_tests'], capture_output=True, text=True, check=True
		)
		command = re.sub(r' -Wl,--dependency-file=\S+', ' FIRST', found.stdout.splitlines()[-1].split(' && ')[1])
		for unit, name in objects.items():
			if not unit.startswith('src/'):
				command = command.replace(f' {name} ', ' ')
		# first come the objects with mutants: the linker takes the first of the functions that several files hold
		command = command.replace('FIRST', ' '.join(str(self.build / name) for name in objects.values()))
		subprocess.run(command.replace(' -o tests/core/polytope_core_tests', f' -o {program}'), shell=True, cwd=own, check=True)
		return program


def objectOf(unit):
	"""Path of the object of a file of src/ or tests/core/, in the build folder."""
	if unit.startswith('src/'):
		return f'src/CMakeFiles/polytope_core.dir/{unit.removeprefix("src/")}.o'
	return f'tests/core/CMakeFiles/polytope_core_tests.dir/{unit.removeprefix("tests/core/")}.o'


def namedIn(messages, tree, mutants):
	"""Mutants on the line of an error; where that has none on the lines beside it, of the same statement; or else on the lines that required it."""
	byLine = {}  # ccache may write paths from the build folder
	for mutant in mutants:
		byLine.setdefault((mutant.file, mutant.line), []).append(mutant)
	bad, required = [], []
	for line in messages.splitlines():
		place = re.search(rf'(?:{re.escape(str(tree))}|\.\.)/([\w/.]+):(\d+):', line)
		steps = range(12) if 'declared here' in line else (0, 1, 2, -1, -2)  # a function in a constant expression: all its lines
		near = [byLine.get((place.group(1), int(place.group(2)) + k), []) for k in steps] if place else [[]]
		if ' error: ' in line:
			bad += near[0] or sum(near, []) or required
			required = []
		elif 'required from' in line or 'In instantiation' in line or 'inlined from' in line:
			required += near[0]
		elif 'note:' in line:
			bad += sum(near, []) if 'declared here' in line else near[0]
	return bad
