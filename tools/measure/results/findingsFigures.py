# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of `./run paper` and `./run accuracy`: what each script found, beside the closed form and the range that it must lie in."""

import json

from text import bold, origin, short, table

files = {'paper': 'paper.json', 'accuracy': 'accuracy.json'}


def taken(source):
	"""What is kept of the folder of a run: the rows of each script, and what it was run with. ValueError if there are none."""
	failed = [path.parent.name for path in sorted(source.glob('*/run.json')) if not (path.parent / 'findings.json').exists()]
	if failed:
		raise ValueError(f'{source}: {", ".join(failed)} ended without findings; see log.txt there')
	scripts = []
	for path in sorted(source.glob('*/findings.json')):
		found, record = json.loads(path.read_text()), json.loads((path.parent / 'run.json').read_text())
		if 'revision' not in record:
			raise ValueError(f'{path.parent}: run.json does not say the revision; run it again')
		about = {key: record[key] for key in ('revision', 'date', 'machine', 'cores', 'load', 'options', 'seconds')}
		scripts.append(
			{
				'name': path.parent.name,
				'letter': found['letter'],
				'title': found['title'],
				**about,
				'good': found['good'],
				'rows': found['rows'],
			}
		)
	if not scripts:
		raise ValueError(f'{source}: no */findings.json there')
	return _written(scripts)


def withKept(text, path):
	"""New results with those of the scripts that were not run with them; each says its revision and date."""
	scripts = {
		script['name']: script
		for source in ([path.read_text()] if path.exists() else []) + [text]
		for script in json.loads(source)['scripts']
	}
	return _written([scripts[name] for name in sorted(scripts)])


def _written(scripts):
	return json.dumps({'scripts': scripts}, indent=' ', ensure_ascii=False) + '\n'


def scriptsOf(folder, name):
	found = json.loads((folder / files[name]).read_text())['scripts']
	return sorted(({**script, 'quick': '--quick' in script['options']} for script in found), key=lambda script: script['letter'])


def difference(row):
	"""Ours less the closed form's, or where there is none the paper's."""
	reference = row['theory'] if row['theory'] is not None else row['paper']
	numbers = isinstance(reference, (int, float)) and isinstance(row['ours'], (int, float))
	return short(row['ours'] - reference, 2) if numbers else ''


def mustBe(row):
	if row['accept'] is None:
		return ''
	low, high = row['accept']
	if low == '-inf':
		return f'≤ {short(high, 6)}'
	if high == 'inf':
		return f'≥ {short(low, 6)}'
	return short(low, 6) if low == high else f'{short(low, 6)} … {short(high, 6)}'


def cells(row):
	ours = short(row['ours'], 6)
	return [
		row['quantity'],
		row['unit'],
		short(row['paper'], 6),
		short(row['theory'], 6),
		bold(ours + ' missed') if row['good'] is False else ours,
		difference(row),
		mustBe(row),
	]


titles = ['quantity', 'unit', 'paper', 'closed form', 'ours', 'difference', 'must be']


def allRows(name):
	"""A table for each script that was run, all its rows."""

	def figure(folder):
		parts = []
		for script in scriptsOf(folder, name):
			parts += [f'**{script["letter"]} · {script["title"]}** ({origin(script)}):', table(titles, map(cells, script['rows']))]
		return '\n\n'.join(parts)

	return figure


def verdicts(name):
	"""A line for each script: rows that must hold, those that do, those that do not by name."""

	def line(script):
		judged = [row for row in script['rows'] if row['good'] is not None]
		missed = [row for row in judged if not row['good']]
		said = (
			'; '.join(bold(f'{row["quantity"]}: {short(row["ours"], 3)} {row["unit"]}, must be {mustBe(row)}') for row in missed) or 'none'
		)
		return [
			f'{script["letter"]}: {script["title"]}',
			f'{len(judged) - len(missed)} of {len(judged)}',
			said,
			f'{script["seconds"]:.0f} s',
			origin(script),
		]

	return lambda folder: table(['study', 'limits met', 'missed', 'took', 'run on'], map(line, scriptsOf(folder, name)))


def speedKept(names):
	"""Over flush pieces at 1 m/s: the largest loss or gain of speed, over the speed, with a stiffness per contact and per area.

	:param names: of the contact in the rows, that of a new run first; older results name it otherwise
	"""

	def figure(folder):
		rows = [row for script in scriptsOf(folder, 'accuracy') if script['name'] == 'surfaces' for row in script['rows']]
		if not rows:
			return 'not measured'
		loss = {row['quantity']: row['ours'] for row in rows}
		found = [
			[loss.get(f'1 m/s over three joints: loss of speed: {name}, per {rule}') for rule in ('contact', 'area')] for name in names
		]
		kept = next((both for both in found if None not in both), None)
		return '; '.join(short(one, 2) for one in kept) if kept else 'not measured'

	return figure


contacts = {'default': ('surface',), 'paper': ('boon2012', "paper's normal")}
figures = {f'accuracy.speed.{name}': speedKept(names) for name, names in contacts.items()}
figures |= {'paper.rows': allRows('paper'), 'paper.verdicts': verdicts('paper'), 'accuracy.verdicts': verdicts('accuracy')}
