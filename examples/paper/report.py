# SPDX-License-Identifier: GPL-2.0-or-later
"""The six simulations of Boon, Houlsby & Utili (2012), and one report of what came out: the program behind `./run paper`.

Each script of this folder runs as a program of its own and leaves its findings (yade.polytope.findings) in a folder of its
own. Out of these come report.html, with all figures and tables, and results.csv, with all rows paper / closed form / ours.
A simulation that is complete, of the same source and with the same options, is not run again: an interrupted call goes on
where it stood. Ends with 1, and says why, if a row that must hold was missed or a script failed.

	./run paper                      # all six
	./run paper --quick              # short variants with the same tolerances
	./run paper --only AC --fresh    # these two, anew
"""
import argparse
import ast
import base64
import csv
import dataclasses
import datetime
import hashlib
import json
import os
import pathlib
import platform
import signal
import subprocess
import sys
import time

here = scripts = pathlib.Path(__file__).resolve().parent
sourceFolders = ('src', 'pkg', 'py', 'examples')
ownFiles = (here / 'report.py', here / 'report.html.jinja')

# letter: script, title, options of the full run besides --output; the quick one's are --quick alone
simulations = {
        'A': ('a_falling_polyhedra', 'Falling polyhedra', ('--seeds', '8')),
        'B': ('b_three_hinged_beam', 'Three-hinged beam', ()),
        'C': ('c_sliding_wedge', 'Sliding wedge', ()),
        'D': ('d_roof_wedge', 'Roof wedge', ()),
        'E': ('e_slumping_slope', 'Slope with non-daylighting joints', ()),
        'F': ('f_collisions', 'Vertex–face and edge–edge collisions', ()),
}

longestTable, longestOpenTable = 300, 25  # rows shown in the report; rows shown without a click


def options(arguments=None):
	parser = argparse.ArgumentParser(prog='./run paper', description=__doc__.splitlines()[0])
	parser.add_argument('--quick', action='store_true', help='short variants, with the same tolerances')
	parser.add_argument('--only', metavar='LETTERS', default=''.join(simulations), help='of the simulations to run and report, e.g. ACF')
	parser.add_argument('--fresh', action='store_true', help='run again what is complete already')
	parser.add_argument('--output', type=pathlib.Path, help='folder for all files (default: output/paper, with --quick output/paper-quick)')
	parser.add_argument('--jobs', type=int, default=1, help='simulations at a time (default: 1); more disturb the times that A measures')
	given = parser.parse_args(arguments)
	given.only = given.only.upper()
	unknown = sorted(set(given.only) - set(simulations))
	if unknown or not given.only:
		parser.error(f"--only {given.only!r}: the simulations are {', '.join(simulations)}")
	if given.jobs < 1:
		parser.error('--jobs must be at least 1')
	given.output = (given.output or pathlib.Path('output/paper-quick' if given.quick else 'output/paper')).resolve()
	return given


def sourceHash():
	"""Of all that a result may depend on: any change makes every simulation run again."""
	digest = hashlib.sha256()
	project = here.parents[1]
	for folder in sourceFolders:
		for path in sorted((project / folder).rglob('*')):
			if path.is_file() and '__pycache__' not in path.parts and path not in ownFiles:
				digest.update(f'{path.relative_to(project)} {path.stat().st_size}\n'.encode())
				digest.update(path.read_bytes())
	return digest.hexdigest()


@dataclasses.dataclass
class Run:
	"""One simulation's script, run or to be run, and its folder: findings.json from the script; run.json and log.txt from here."""

	letter: str
	title: str
	script: pathlib.Path
	folder: pathlib.Path
	options: list
	source: str

	@property
	def key(self):
		return {'options': self.options, 'source': self.source}

	def start(self):
		for name in ('findings.json', 'run.json'):
			(self.folder / name).unlink(missing_ok=True)
		self.folder.mkdir(parents=True, exist_ok=True)
		self.began = time.monotonic()
		with open(self.folder / 'log.txt', 'w') as log:
			self.process = subprocess.Popen(
			        [sys.executable, self.script, *self.options, '--output', self.folder], stdin=subprocess.DEVNULL, stdout=log, stderr=log
			)

	def ended(self):
		"""True once the script is through; what it was goes to run.json."""
		code = self.process.poll()
		if code is None:
			return False
		seconds = time.monotonic() - self.began
		(self.folder / 'run.json').write_text(json.dumps({**self.key, 'exitCode': code, 'seconds': seconds}, indent='\t') + '\n')
		return True

	def stop(self):
		self.process.terminate()
		try:
			self.process.wait(10)
		except subprocess.TimeoutExpired:
			self.process.kill()
			self.process.wait()

	def read(self, name):
		"""A JSON file of the folder; empty where there is none or it is not whole."""
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


def plannedRuns(given):
	source = sourceHash()
	runs = []
	for letter, (name, title, extra) in simulations.items():
		if letter in given.only:
			chosen = ['--quick'] if given.quick else [*extra]
			runs.append(Run(letter, title, scripts / f'{name}.py', given.output / name, chosen, source))
	return runs


def perform(runs, jobs):
	"""Runs what is not complete, *jobs* at a time."""
	from tqdm import tqdm
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


# The report


def section(run):
	"""What the template needs of one simulation."""
	from yade.polytope.findings import rowCells
	findings, record = run.read('findings.json'), run.read('run.json')
	log = run.folder / 'log.txt'
	return {
	        'letter': run.letter,
	        'title': findings.get('title', run.title),
	        'summary': scriptSummary(run.script),
	        'script': run.script.name,
	        'options': ' '.join(run.options),
	        'seconds': record.get('seconds'),
	        'failure': run.failure,
	        'log': log.read_text(errors='replace').splitlines()[-25:] if run.failure and log.is_file() else [],
	        'rows': [{**row, 'cells': rowCells(row)} for row in findings.get('rows', [])],
	        'parts': [shownPart(part, run.folder) for part in findings.get('parts', [])],
	        'folder': run.folder.name,
	}


def scriptSummary(script):
	"""The first line of a script's docstring."""
	try:
		return (ast.get_docstring(ast.parse(script.read_text())) or '').partition('\n')[0]
	except (OSError, SyntaxError):
		return ''


def shownPart(part, folder):
	"""A part of the findings with its file's content: a picture as a data URL, a table as its cells."""
	if part['kind'] == 'figure':
		content = base64.b64encode((folder / part['file']).read_bytes()).decode()
		return {**part, 'url': f'data:image/png;base64,{content}'}
	if part['kind'] == 'table':
		with open(folder / part['file'], newline='') as file:
			columns, *rows = csv.reader(file)
		shown = [[tableCell(cell) for cell in row] for row in rows[:longestTable]]
		heads = [(title, any(row[k][1] for row in shown)) for k, title in enumerate(columns)]
		return {**part, 'columns': heads, 'rows': shown, 'length': len(rows), 'open': len(rows) <= longestOpenTable}
	return part


def tableCell(text):
	"""Numbers with six digits, the rest as it is; and whether it is a number."""
	try:
		number = float(text)
	except ValueError:
		return text, False
	return text if text.lstrip('-').isdigit() else format(number, '.6g'), True


resultColumns = (
        'simulation', 'title', 'quantity', 'unit', 'paper', 'closed form', 'ours', 'difference', 'at least', 'at most', 'verdict', 'note'
)


def writeResults(sections, path):
	"""All rows of all simulations, numbers with all digits."""
	from yade.polytope.findings import rowDifference
	with open(path, 'w', newline='') as file:
		writer = csv.writer(file)
		writer.writerow(resultColumns)
		for part in sections:
			for row in part['rows']:
				low, high = row['accept'] or (None, None)
				figures = row['paper'], row['theory'], row['ours'], rowDifference(row), low, high
				writer.writerow([part['letter'], part['title'], row['quantity'], row['unit'], *figures, row['cells'][-1], row['note']])


def writeHtml(sections, given, path):
	import jinja2
	import yade.config
	environment = jinja2.Environment(loader=jinja2.FileSystemLoader(here), autoescape=True, undefined=jinja2.StrictUndefined)
	rows = [row for part in sections for row in part['rows']]
	about = {
	        'quick': given.quick,
	        'date': datetime.date.today().isoformat(),
	        'yade': yade.config.version,
	        'machine': processor(),
	        'required': sum(row['good'] is not None for row in rows),
	        'missed': sum(row['good'] is False for row in rows),
	        'failed': [part['letter'] for part in sections if part['failure']],
	        'absent': [letter for letter in simulations if letter not in given.only],
	}
	path.write_text(environment.get_template('report.html.jinja').render(sections=sections, about=about))


def processor():
	for line in pathlib.Path('/proc/cpuinfo').read_text().splitlines():
		if line.startswith('model name'):
			return line.partition(':')[2].strip()
	return platform.machine()


def show(sections):
	"""Prints all rows, then what is amiss; returns whether nothing is."""
	from tabulate import tabulate
	titles = ['', '', 'unit', 'paper', 'closed form', 'ours', 'difference', 'must be', '']
	print(tabulate([[part['letter'], *row['cells']] for part in sections for row in part['rows']], titles, disable_numparse=True))
	amiss = [f"{part['letter']}: {part['script']} {part['failure']}: see {part['folder']}/log.txt" for part in sections if part['failure']]
	for part in sections:
		for row in part['rows']:
			if row['good'] is False:
				_, unit, _, _, ours, _, accept, _ = row['cells']
				amiss.append(f"{part['letter']}: missed: {row['quantity']}: {ours} {unit}, must be {accept}")
	print('\n' + ('\n'.join(amiss) or 'All that must hold does.'))
	return not amiss


def main(arguments=None):
	given = options(arguments)
	given.output.mkdir(parents=True, exist_ok=True)
	runs = plannedRuns(given)
	if given.fresh:
		for run in runs:
			(run.folder / 'run.json').unlink(missing_ok=True)
	try:
		perform(runs, given.jobs)
	except KeyboardInterrupt:
		print('\nInterrupted: what is complete is kept; call again to go on.', file=sys.stderr)
		return 130
	os.environ.setdefault('OMP_NUM_THREADS', '1')  # YADE is loaded only to read findings
	sections = [section(run) for run in runs]
	writeResults(sections, given.output / 'results.csv')
	writeHtml(sections, given, given.output / 'report.html')
	good = show(sections)
	print(f"\nReport: {given.output / 'report.html'}, rows: {given.output / 'results.csv'}")
	return 0 if good else 1


if __name__ == '__main__':
	signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that perform() stops what it started
	sys.exit(main())
