# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests that are to notice a mutant: which of them come past it, how long they take, and the first that fails."""

import json
import math
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile

memory = 4 << 30
"""Most that a test may take [bytes]: a loop that a mutant makes endless may fill an array."""
patience = 3
"""A test that takes so many times the processor's time without a mutant, and two seconds more, is ended: the mutant is killed."""
asleep = 60
"""A test that takes so many times its limit on the clock is ended, too: a process that waits for nothing does not take so long."""
groups = (0.005, 0.02, 0.07, 0.2, 2, float('inf'))
"""Tests are run in these groups by their times [s], fastest first."""
quickGroups = 4
"""Number of groups that are run for all mutants before the others are run for any."""


class Run:
	"""A command with one mutant switched on, limited in memory and in time of the processor: a busy machine must not end what would pass."""

	def __init__(self, command, mutant, seconds, environment=None, folder=None):
		def limits():
			resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
			resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 1))

		variables = {**os.environ, 'OMP_NUM_THREADS': '1', **(environment or {}), 'POLYTOPE_MUTANT': str(mutant)}
		before = resource.getrusage(resource.RUSAGE_CHILDREN)
		with tempfile.TemporaryFile('w+', errors='replace') as out:
			process = subprocess.Popen(
				command, env=variables, cwd=folder, stdout=out, stderr=subprocess.STDOUT, preexec_fn=limits, process_group=0
			)
			try:
				self.code = process.wait(10 + asleep * seconds)
			except subprocess.TimeoutExpired:
				os.killpg(process.pid, signal.SIGKILL)
				process.wait()
				self.code = None
			if self.code in (-signal.SIGXCPU, -signal.SIGKILL):
				self.code = None
			after = resource.getrusage(resource.RUSAGE_CHILDREN)
			self.seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
			out.seek(0)
			self.output = out.read()


class CoreTests:
	"""The tests of GoogleTest."""

	def __init__(self, program, mutants=''):
		"""*mutants*: names those that are in the program."""
		self.program, self.mutants = str(program), mutants
		self.times, self.reaching, self.leftOut = {}, {}, []

	def names(self):
		suite, names = '', []
		for line in Run([self.program, '--gtest_list_tests'], 0, 60).output.splitlines():
			line = line.split('#')[0].rstrip()
			if line.endswith('.'):
				suite = line.strip()
			elif line.startswith('  '):
				names.append(suite + line.strip())
		if not names:
			raise RuntimeError(f'{self.program} has no tests')
		return names

	def measure(self, say):
		"""Times and reach of all tests. Those that an earlier call measured with the same mutants are not run again: remove the file if
		they changed."""
		kept = pathlib.Path(self.program + '.tests.json')
		found = json.loads(kept.read_text()) if kept.exists() else {}
		if found.get('mutants') == self.mutants:
			self.times, self.leftOut = found['times'], found['leftOut']
			self.reaching = {int(number): names for number, names in found['reaching'].items()}
		self.measured(say)
		kept.write_text(json.dumps({'mutants': self.mutants, 'times': self.times, 'leftOut': self.leftOut, 'reaching': self.reaching}))
		say(f'{len(self.times)} tests of the core, {sum(self.times.values()):.0f} s')

	def measured(self, say):
		"""Runs each test without a mutant. One that fails is left out: it asks for the last bits of another build. RuntimeError if there are many."""
		for name in self.names():
			if name in self.times or name in self.leftOut:
				continue
			with tempfile.NamedTemporaryFile('r') as file:
				run = Run([self.program, f'--gtest_filter={name}'], 0, 600, {'POLYTOPE_MUTANTS_REACHED': file.name})
				if run.code:
					self.leftOut.append(name)
					say(f'{name} fails without a mutant:\n{run.output[-800:]}')
					continue
				self.times[name] = run.seconds
				for number in file.read().split():
					self.reaching.setdefault(int(number), []).append(name)
		if len(self.leftOut) > 0.02 * len(self.times):
			raise RuntimeError(f'{len(self.leftOut)} tests fail without a mutant')

	def verdict(self, mutant, quick=None):
		"""Name of a test that the mutant fails, and how; None if it passes all that reach it. *quick*: only those of the first groups, or
		of the others."""
		least = min(self.times.values())
		names = self.reaching.get(mutant, [])
		some = {None: groups, True: groups[:quickGroups], False: groups[quickGroups:]}[quick]
		for upper in some:
			lower = groups[groups.index(upper) - 1] if upper != groups[0] else -1
			group = [name for name in names if lower < self.times[name] - least <= upper]
			if not group:
				continue
			limit = 2 + patience * sum(self.times[name] - least for name in group)
			run = Run([self.program, '--gtest_fail_fast', '--gtest_filter=' + ':'.join(group)], mutant, limit)
			if run.code != 0:
				return failureOf(run)
		return None


def failureOf(run):
	failed = re.findall(r'^\[  FAILED  \] ([\w./]+)', run.output, re.MULTILINE)
	last = re.findall(r'^\[ RUN      \] ([\w./]+)', run.output, re.MULTILINE)
	if run.code is None:
		return (last or ['?'])[-1] + ' (no end)'
	return failed[0] if failed else (last or ['?'])[-1] + f' (ends with {run.code})'


class PluginTests:
	"""The tests of pytest in these files, with the overlay that holds the mutants."""

	def __init__(self, tree, files):
		self.tree, self.files = tree, list(files)
		self.environment = {'YADE_PREFIX': str(tree / 'build/overlay')}
		self.times, self.reaching, self.leftOut = {}, {}, []

	def run(self, file, mutant, seconds, reached=None):
		command = [sys.executable, '-m', 'pytest', '-q', '-x', '-p', 'no:cacheprovider', str(next((self.tree / 'tests/yade').rglob(file)))]
		environment = {**self.environment, **({'POLYTOPE_MUTANTS_REACHED': reached} if reached else {})}
		return Run(command, mutant, seconds, environment, self.tree)

	def measure(self, say):
		"""Runs each file without a mutant. RuntimeError if one fails, or none comes past a mutant."""
		for file in self.files:
			with tempfile.NamedTemporaryFile('r') as reached:
				run = self.run(file, 0, 1800, reached.name)
				if run.code:
					raise RuntimeError(f'{file} fails without a mutant:\n{run.output[-3000:]}')
				self.times[file] = run.seconds
				for number in reached.read().split():
					self.reaching.setdefault(int(number), []).append(file)
			say(f'{file}: {run.seconds:.0f} s')
		if not self.reaching:
			raise RuntimeError('no test of the plug-in comes past a mutant')

	def verdict(self, mutant):
		for file in sorted(self.reaching.get(mutant, []), key=self.times.get):
			run = self.run(file, mutant, 30 + 4 * self.times[file])
			if run.code == 0:
				continue
			failed = re.search(r'^(?:FAILED|ERROR) (?:\S*/)?(\S+)', run.output, re.MULTILINE)
			if failed:
				return failed.group(1)
			return f'{file} (no end)' if run.code is None else f'{file} (ends with {run.code})'
		return None
