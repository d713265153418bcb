# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of a simulation, beside the paper's figure and the closed form: rows, tables, figures, and whether all that must hold does.

One script writes one `Findings` into its folder; `./run paper` puts those of all six together into one report.
"""

import csv
import json
import math
import pathlib

__all__ = ['Findings']


class Findings:
	"""Collects the results of one simulation, and writes them to *folder* (findings.json, and each table as CSV).

	:param str letter: what it is chosen by: of the simulation in Boon et al. (2012), 'A' to 'F'; of a study of ./run accuracy its name
	:param str title: in a few words
	:param folder: for all files; made if need be
	:param dict options: what the run was made with, as given by the user
	"""

	def __init__(self, letter, title, folder, options=None):
		self.folder = pathlib.Path(folder)
		self.folder.mkdir(parents=True, exist_ok=True)
		self.content = {'letter': letter, 'title': title, 'options': options or {}, 'rows': [], 'parts': []}

	def row(self, quantity, ours, unit='', paper=None, theory=None, accept=None, note=''):
		"""One line of the table paper / closed form / ours / difference.

		:param float ours: what this run gave
		:param paper: the paper's figure, None where it gives none
		:param theory: the closed form's, None where there is none
		:param accept: (low, high), both included: the row must lie within, or the run has failed; None: only reported
		:param str note: where a difference comes from, or what the acceptance rests on
		:returns: True unless the row must hold and does not
		:raises ValueError: for a range whose ends are in the wrong order, or not numbers
		"""
		if accept is not None and not accept[0] <= accept[1]:
			raise ValueError(f"row {quantity}: accept must be (low, high), not {accept}")
		good = None if accept is None else bool(accept[0] <= ours <= accept[1])  # False for NaN
		self.content['rows'].append(
			{
				'quantity': quantity,
				'unit': unit,
				'paper': _number(paper),
				'theory': _number(theory),
				'ours': _number(ours),
				'accept': None if accept is None else [_number(x) for x in accept],
				'good': good,
				'note': note,
			}
		)
		return good is not False

	def text(self, paragraph):
		"""A paragraph of the report (plain text): an explanation, with its figures."""
		self.content['parts'].append({'kind': 'text', 'text': paragraph})

	def table(self, name, caption, columns, rows):
		"""A table: written as NAME.csv, and shown in the report.

		:param columns: titles, with units
		:param rows: sequences of numbers or strings as long as *columns*
		"""
		rows = [list(row) for row in rows]
		for row in rows:
			if len(row) != len(columns):
				raise ValueError(f"table {name}: a row has {len(row)} cells, columns are {len(columns)}: {row}")
		with open(self.folder / f'{name}.csv', 'w', newline='') as file:
			writer = csv.writer(file)
			writer.writerow(columns)
			writer.writerows(rows)
		self.content['parts'].append({'kind': 'table', 'file': f'{name}.csv', 'caption': caption})

	def figure(self, path, caption):
		"""A picture or plot (PNG) that lies in the folder or below it."""
		path = pathlib.Path(path)
		path = path.relative_to(self.folder) if path.is_relative_to(self.folder) else path
		if not (self.folder / path).is_file():
			raise FileNotFoundError(f"figure {path} is not in {self.folder}")
		self.content['parts'].append({'kind': 'figure', 'file': str(path), 'caption': caption})

	@property
	def good(self):
		"""True when every row that must hold does."""
		return all(row['good'] is not False for row in self.content['rows'])

	def save(self):
		"""Writes findings.json, last of all files: if it exists, the run is complete. Returns `good`."""
		(self.folder / 'findings.json').write_text(json.dumps({**self.content, 'good': self.good}, indent='\t') + '\n')
		return self.good

	def show(self):
		"""Prints the rows."""
		from tabulate import tabulate

		titles = ['', 'unit', 'paper', 'closed form', 'ours', 'difference', 'must be', '']
		print(tabulate([rowCells(row) for row in self.content['rows']], titles, disable_numparse=True))


def rowCells(row):
	"""One row as text: quantity, unit, paper, closed form, ours, difference to the closed form (else to the paper), must be, verdict."""
	difference = rowDifference(row)
	difference = '' if difference is None else format(difference, '+.3g') if difference else '0'
	accept = '' if row['accept'] is None else _range(*row['accept'])
	verdict = {None: '', True: 'ok', False: 'MISSED'}[row['good']]
	return [row['quantity'], row['unit'], _text(row['paper']), _text(row['theory']), _text(row['ours']), difference, accept, verdict]


def rowDifference(row):
	"""Ours less the closed form, where there is none less the paper's; None where one of them is not a number."""
	reference = row['theory'] if row['theory'] is not None else row['paper']
	numbers = isinstance(reference, (int, float)) and isinstance(row['ours'], (int, float))
	return row['ours'] - reference if numbers else None


def _range(low, high):
	if low == high:
		return _text(low)
	if low == '-inf' or high == 'inf':
		return '≤ ' + _text(high) if low == '-inf' else '≥ ' + _text(low)
	return f'{_text(low)} … {_text(high)}'


def _number(x):
	"""The number as JSON can hold it: NumPy's numbers as Python's, what is not finite as text."""
	if x is None or isinstance(x, str):
		return x
	if isinstance(x, bool) or float(x).is_integer() and abs(x) < 2**53:
		return int(x)
	return float(x) if math.isfinite(x) else repr(float(x))


def _text(x):
	return '' if x is None else x if isinstance(x, str) else format(x, '.7g')
