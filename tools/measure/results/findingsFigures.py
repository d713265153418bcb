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


def label(script, between):
	"""Letter or name by which a script is chosen, and title; the title alone of results without the former."""
	return between.join(filter(None, (script['letter'], script['title'])))


def allRows(name):
	"""A table for each script that was run, all its rows."""

	def figure(folder):
		parts = []
		for script in scriptsOf(folder, name):
			parts += [f'**{label(script, " · ")}** ({origin(script)}):', table(titles, map(cells, script['rows']))]
		return '\n\n'.join(parts)

	return figure


def mainRows(folder):
	"""The rows that answer what each of the paper's simulations is about."""
	found = {(script['letter'], row['quantity']): (script, row) for script in scriptsOf(folder, 'paper') for row in script['rows']}
	lines = []
	for key in ofThePaper:
		if key in found:
			script, row = found[key]
			_, unit, paper, theory, ours, *_ = cells(row)
			lines.append([label(script, ', '), row['quantity'], unit, paper, theory, ours])
	return table(['simulation', 'quantity', 'unit', 'paper', 'closed form', 'ours'], lines)


ofThePaper = (
	('A', 'linear program, cold start: N = 8 … 40'),
	('A', 'centre by Newton, cold start: N = 8 … 40'),
	('B', 'centroid: peak load'),
	('B', 'analytic centre, abutments of 3 block heights: peak load'),
	('C', 'critical friction angle'),
	('C', 'limit equilibrium with the locked-in shear measured'),
	('D', 'critical friction angle, way 1, joint forces set, g = 10 m/s²'),
	('E', 'critical friction angle'),
	('F', 'F1: height at rest'),
)
"""Letter and quantity."""


def verdicts(name):
	"""A line for each script: rows that must hold, those that do, those that do not by name."""

	def line(script):
		judged = [row for row in script['rows'] if row['good'] is not None]
		missed = [row for row in judged if not row['good']]
		said = (
			'; '.join(bold(f'{row["quantity"]}: {short(row["ours"], 3)} {row["unit"]}, must be {mustBe(row)}') for row in missed) or 'none'
		)
		return [
			label(script, ': '),
			f'{len(judged) - len(missed)} of {len(judged)}',
			said,
			f'{script["seconds"]:.0f} s',
			origin(script),
		]

	return lambda folder: table(['study', 'limits met', 'missed', 'took', 'run on'], map(line, scriptsOf(folder, name)))


def floors(folder):
	"""Table of the study of floors made of flush pieces: the largest error of each measure, for both contacts and both rules of stiffness."""
	script = next((script for script in scriptsOf(folder, 'accuracy') if script['name'] == 'surfaces'), None)
	if script is None:
		return 'Not measured.'
	found = {}
	for row in script['rows']:
		measure, _, of = row['quantity'].rpartition(': ')
		if of in contacts:
			found.setdefault((measure, row['unit']), {})[of] = row
	lines = []
	for (measure, unit), rows in found.items():
		limit = next((mustBe(row) for row in rows.values() if row['accept'] is not None), '')
		lines.append(
			[f'{measure} [{unit or "-"}]', limit, *(cells({**rows[of], 'ours': float(short(rows[of]['ours'], 2))})[4] for of in contacts)]
		)
	return f'{origin(script)}:\n\n' + table(['largest error', 'must be', *contacts.values()], lines)


contacts = {
	f'{name}, per {rule}': f'{shown}, per {rule}'
	for name, shown in (('surface', 'the default'), ('boon2012', '*boon2012*'))
	for rule in ('contact', 'area')
}
"""What the rows of the study of floors end with, and the heading of its column."""

figures = {
	'paper.main': mainRows,
	'paper.rows': allRows('paper'),
	'paper.verdicts': verdicts('paper'),
	'accuracy.verdicts': verdicts('accuracy'),
	'accuracy.floors': floors,
}
