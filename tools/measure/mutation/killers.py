# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests that are to notice a mutant: which of them come past it, how long they take, and the first that fails."""

import os
import re
import resource
import signal
import subprocess
import tempfile
import time

memory = 4 << 30
"""Most that a test may take [bytes]: a loop that a mutant makes endless may fill an array."""
patience = 8
"""A test that takes so many times what it takes without a mutant, and five seconds more, is ended: the mutant is killed."""
groups = (0.02, 0.2, 2, float('inf'))
"""Tests are run in these groups by their times [s], fastest first."""


class Run:
	"""A command with one mutant switched on, limited in time and memory."""

	def __init__(self, command, mutant, seconds, environment=None, folder=None):
		limits = lambda: resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
		variables = {**os.environ, 'OMP_NUM_THREADS': '1', **(environment or {}), 'POLYTOPE_MUTANT': str(mutant)}
		with tempfile.TemporaryFile('w+', errors='replace') as out:
			begin = time.monotonic()
			process = subprocess.Popen(
			        command, env=variables, cwd=folder, stdout=out, stderr=subprocess.STDOUT, preexec_fn=limits, start_new_session=True
			)
			try:
				self.code = process.wait(seconds)
			except subprocess.TimeoutExpired:
				os.killpg(process.pid, signal.SIGKILL)
				process.wait()
				self.code = None
			self.seconds = time.monotonic() - begin
			out.seek(0)
			self.output = out.read()


class CoreTests:
	"""Those of GoogleTest."""

	def __init__(self, program):
		self.program = str(program)
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
		"""Runs each test without a mutant. One that fails is left out: it asks for the last bits of another build. RuntimeError if there are many."""
		for name in self.names():
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
		say(f'{len(self.times)} tests of the core, {sum(self.times.values()):.0f} s')

	def verdict(self, mutant):
		"""Name of a test that the mutant fails, and how; None if it passes all that reach it."""
		least = min(self.times.values())
		names = self.reaching.get(mutant, [])
		for lower, upper in zip((-1, *groups), groups, strict=False):
			group = [name for name in names if lower < self.times[name] - least <= upper]
			if not group:
				continue
			limit = 5 + patience * sum(self.times[name] - least for name in group)
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
	"""Those of pytest in these files, with the overlay that holds the mutants."""

	def __init__(self, tree, files):
		self.tree, self.files = tree, list(files)
		self.environment = {'YADE_PREFIX': str(tree / 'build/overlay')}
		self.seconds, self.reaching, self.leftOut = 0.0, {}, []

	def run(self, mutant, seconds):
		import sys

		command = [sys.executable, '-m', 'pytest', '-q', '-x', '-p', 'no:cacheprovider', *(f'tests/yade/{name}' for name in self.files)]
		return Run(command, mutant, seconds, self.environment, self.tree)

	def measure(self, say):
		run = self.run(0, 1800)
		if run.code:
			raise RuntimeError('the tests of the plug-in fail without a mutant:\n' + run.output[-3000:])
		self.seconds = run.seconds
		say(f'tests of the plug-in: {self.seconds:.0f} s')

	def verdict(self, mutant):
		run = self.run(mutant, 30 + 4 * self.seconds)
		if run.code == 0:
			return None
		failed = re.search(r'^(?:FAILED|ERROR) (?:tests/yade/)?(\S+)', run.output, re.MULTILINE)
		if failed:
			return failed.group(1)
		return 'pytest (no end)' if run.code is None else f'pytest (ends with {run.code})'
