# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the paper's scripts, each as a program of its own with a folder of its own; what is complete is not run again."""

import dataclasses
import hashlib
import json
import pathlib
import subprocess
import sys
import time

from tqdm import tqdm

from .origin import origin

__all__ = ['Run', 'perform', 'sourceHash']

sourceFolders = ('src', 'pkg', 'py', 'examples')


def sourceHash(project, without=(), folders=sourceFolders):
	"""Hash of all that a result may depend on: any change makes every simulation run again.

	:param pathlib.Path project: the folder in which src, pkg, py and examples are
	:param without: paths in it that no result depends on
	:param folders: of the project, that results depend on
	"""
	digest = hashlib.sha256()
	for folder in folders:
		for path in sorted((project / folder).rglob('*')):
			if path.is_file() and '__pycache__' not in path.parts and path.relative_to(project) not in without:
				digest.update(f'{path.relative_to(project)} {path.stat().st_size}\n'.encode())
				digest.update(path.read_bytes())
	return digest.hexdigest()


@dataclasses.dataclass
class Run:
	"""One simulation's script, run or to be run, and its folder: findings.json from the script; run.json (options, sources, revision,
	machine, date) and log.txt from here."""

	letter: str
	title: str
	script: pathlib.Path
	folder: pathlib.Path
	options: list
	"""Options besides --output."""
	source: str
	"""sourceHash()."""

	@property
	def key(self):
		return {'options': self.options, 'source': self.source}

	def start(self):
		self.forget()
		(self.folder / 'findings.json').unlink(missing_ok=True)
		self.folder.mkdir(parents=True, exist_ok=True)
		self.began, self.origin = time.monotonic(), origin()
		with open(self.folder / 'log.txt', 'w') as log:
			command = [sys.executable, self.script, *self.options, '--output', self.folder]
			self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)

	def forget(self):
		"""Marks it as not complete."""
		(self.folder / 'run.json').unlink(missing_ok=True)

	def ended(self):
		"""True once the script has ended; its key (source, options), origin, exit code and time are written to run.json."""
		code = self.process.poll()
		if code is None:
			return False
		seconds = time.monotonic() - self.began
		(self.folder / 'run.json').write_text(
			json.dumps({**self.key, **self.origin, 'exitCode': code, 'seconds': seconds}, indent='\t') + '\n'
		)
		return True

	def stop(self):
		self.process.terminate()
		try:
			self.process.wait(10)
		except subprocess.TimeoutExpired:
			self.process.kill()
			self.process.wait()

	def read(self, name):
		"""A JSON file of the folder; empty where there is none or it is incomplete."""
		try:
			return json.loads((self.folder / name).read_text())
		except (OSError, ValueError):
			return {}

	@property
	def failure(self):
		"""Why there is no result, or ''. A script ends with 1 for a missed row, which is a result."""
		findings, code = self.read('findings.json'), self.read('run.json').get('exitCode')
		if code is None:
			return 'was not run to its end'
		if code and (code != 1 or findings.get('good', True)):
			return f'ended with exit code {code}'
		return '' if findings else 'left no findings'

	@property
	def complete(self):
		record = self.read('run.json')
		return all(record.get(name) == value for name, value in self.key.items()) and not self.failure


def perform(runs, jobs):
	"""Runs what is not complete, *jobs* at a time. What is interrupted is stopped, and not complete."""
	waiting, running = [run for run in runs if not run.complete], []
	style = '{l_bar}{bar}| {n_fmt}/{total_fmt} [{elapsed}{postfix}]'
	with tqdm(total=len(runs), initial=len(runs) - len(waiting), bar_format=style) as bar:
		try:
			while waiting or running:
				while waiting and len(running) < jobs:
					running.append(waiting.pop(0))
					running[-1].start()
				bar.set_postfix_str('running: ' + ', '.join(f'{run.letter} {run.title}' for run in running), refresh=sys.stderr.isatty())
				time.sleep(0.2)
				for run in [run for run in running if run.ended()]:
					running.remove(run)
					bar.set_postfix_str(f'{run.letter} ended', refresh=False)
					bar.update()
			bar.set_postfix_str('')
		finally:
			for run in running:
				run.stop()
