# SPDX-License-Identifier: GPL-2.0-or-later
"""One report of several scripts' findings (`./run paper`, `./run accuracy`): an HTML page with all figures and tables, a CSV file with all rows, and a table on screen.

It takes what Findings wrote into the folders of the runs (see paperRuns.Run).
"""

import ast
import base64
import csv
import datetime
import pathlib
import platform

import jinja2
import yade.config
from tabulate import tabulate

from .findings import rowCells, rowDifference

__all__ = ['section', 'show', 'writeHtml', 'writeResults']

longestTable, longestOpenTable = 300, 25
"""Rows shown in the page; rows shown without a click."""

resultColumns = (
	'simulation',
	'title',
	'quantity',
	'unit',
	'paper',
	'closed form',
	'ours',
	'difference',
	'at least',
	'at most',
	'verdict',
	'note',
)


def section(run):
	"""What the page holds of one Run, as a dictionary."""
	findings, record = run.read('findings.json'), run.read('run.json')
	log = run.folder / 'log.txt'
	return {
		'letter': run.letter,
		'title': findings.get('title', run.title),
		'summary': _summary(run.script),
		'script': run.script.name,
		'command': '/'.join(run.script.parts[-3:]),
		'options': ' '.join(run.options),
		'seconds': record.get('seconds'),
		'failure': run.failure,
		'log': log.read_text(errors='replace').splitlines()[-25:] if run.failure and log.is_file() else [],
		'rows': [{**row, 'cells': rowCells(row)} for row in findings.get('rows', [])],
		'parts': [_part(part, run.folder) for part in findings.get('parts', [])],
		'folder': run.folder.name,
	}


def _summary(script):
	"""The first line of a script's docstring."""
	try:
		return (ast.get_docstring(ast.parse(script.read_text())) or '').partition('\n')[0]
	except (OSError, SyntaxError):
		return ''


def _part(part, folder):
	"""A part of the findings with its file's content: a picture as a data URL, a table as its cells."""
	if part['kind'] == 'figure':
		content = base64.b64encode((folder / part['file']).read_bytes()).decode()
		return {**part, 'url': f'data:image/png;base64,{content}'}
	if part['kind'] == 'table':
		with open(folder / part['file'], newline='') as file:
			columns, *rows = csv.reader(file)
		cells = [[_cell(cell) for cell in row] for row in rows[:longestTable]]
		heads = [(title, any(row[k][1] for row in cells)) for k, title in enumerate(columns)]
		return {**part, 'columns': heads, 'rows': cells, 'length': len(rows), 'open': len(rows) <= longestOpenTable}
	return part


def _cell(text):
	"""Numbers with six digits, the rest as it is; and whether it is a number."""
	try:
		number = float(text)
	except ValueError:
		return text, False
	return text if text.lstrip('-').isdigit() else format(number, '.6g'), True


def writeResults(sections, path):
	"""All rows of all simulations as CSV, numbers with all digits."""
	with open(path, 'w', newline='') as file:
		writer = csv.writer(file)
		writer.writerow(resultColumns)
		for part in sections:
			for row in part['rows']:
				low, high = row['accept'] or (None, None)
				figures = row['paper'], row['theory'], row['ours'], rowDifference(row), low, high
				writer.writerow([part['letter'], part['title'], row['quantity'], row['unit'], *figures, row['cells'][-1], row['note']])


def writeHtml(sections, template, path, quick, absent, earlier=(), base=None):
	"""The page.

	:param list sections: see section()
	:param pathlib.Path template: of jinja2
	:param base: folder of the template that *template* extends, if it does
	:param bool quick: whether these are short variants
	:param list absent: letters of the simulations that were not asked for and are not there
	:param list earlier: letters of those that an earlier call completed
	"""
	environment = jinja2.Environment(
		loader=jinja2.FileSystemLoader([template.parent, *([base] if base else [])]), autoescape=True, undefined=jinja2.StrictUndefined
	)
	rows = [row for part in sections for row in part['rows']]
	about = {
		'quick': quick,
		'date': datetime.date.today().isoformat(),
		'yade': yade.config.version,
		'machine': _processor(),
		'required': sum(row['good'] is not None for row in rows),
		'missed': sum(row['good'] is False for row in rows),
		'failed': [part['letter'] for part in sections if part['failure']],
		'absent': absent,
		'earlier': earlier,
		'withPaper': any(row['paper'] is not None for row in rows),
		'withTheory': any(row['theory'] is not None for row in rows),
	}
	path.write_text(environment.get_template(template.name).render(sections=sections, about=about))


def _processor():
	for line in pathlib.Path('/proc/cpuinfo').read_text().splitlines():
		if line.startswith('model name'):
			return line.partition(':')[2].strip()
	return platform.machine()


def show(sections):
	"""Prints all rows, then what was missed or failed; returns whether all is good."""
	titles = ['', '', 'unit', 'paper', 'closed form', 'ours', 'difference', 'must be', '']
	print(tabulate([[part['letter'], *row['cells']] for part in sections for row in part['rows']], titles, disable_numparse=True))
	amiss = [f'{part["letter"]}: {part["script"]} {part["failure"]}: see {part["folder"]}/log.txt' for part in sections if part['failure']]
	for part in sections:
		for row in part['rows']:
			if row['good'] is False:
				_, unit, _, _, ours, _, accept, _ = row['cells']
				amiss.append(f'{part["letter"]}: missed: {row["quantity"]}: {ours} {unit}, must be {accept}')
	print('\n' + ('\n'.join(amiss) or 'All that must hold does.'))
	return not amiss
