# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of `./run tradeoff`: what each setting costs, and the error of the answer that matters in each scene."""

import csv
import json
import math

from text import bold, origin, short, table

file = 'tradeoff.json'


def taken(source):
	"""What is kept of the folder of a run: its summary, and what it was run on."""
	with open(source / 'summary.csv', newline='') as summary:
		rows = list(csv.reader(summary))
	about = json.loads((source / 'origin.json').read_text())
	lines = ',\n'.join('  ' + json.dumps(row, ensure_ascii=False) for row in rows)
	return json.dumps(about, ensure_ascii=False, indent=' ')[:-2] + ',\n "summary": [\n' + lines + '\n ]\n}\n'


def cell(text, digits):
	"""A number of the summary; what has no answer is bold."""
	try:
		number = float(text)
	except ValueError:
		return bold({'RuntimeError': 'does not stand'}.get(text, text)) if text else ''
	return '' if math.isnan(number) else short(number, digits)


def settings(folder):
	found = json.loads((folder / file).read_text())
	head, *rows = found['summary']
	lines = [[name, *(cell(text, 2) for text in texts)] for name, *texts in rows]
	return f'All scenes ({origin(found)}):\n\n' + table(head, lines)


figures = {'tradeoff.settings': settings}
