# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of `./run bench`: all targets with what was measured, missed ones in bold, and what features cost. Groups may be measured apart."""

import itertools
import json
import re

from text import bold, origin, paragraph, short, table

file = 'bench.json'
ofScenes = (
	'InteractionLoop',
	'time per body',
	'time per contact',
	'time of a step',
	'a million bodies',
	'memory',
	'polytope.arrays',
	'PolytopeVTKRecorder',
	'O.save',
	'O.load',
	'checkpoint',
)
ofBodies = ('body of', 'jointedRock')
order = ('kernels', 'shapes', 'results', 'scenes', 'sizes', 'scale', 'growth', 'threads', 'beside')
"""Order of the groups of `./run bench`."""


def taken(source):
	"""What is kept of the folder of a run: targets, medians, what features cost; not each repetition."""
	found = json.loads((source / 'results.json').read_text())
	machine = found['machine']
	run = {
		'groups': found['groups'],
		'revision': machine['revision'] + '-dirty' * machine['changed'],
		'date': machine['date'][:10],
		'machine': machine['processor'],
		'cores': machine['cores'],
		'load': round(machine['loadAverage'][0], 2),
		'system': machine['system'],
		'compiler': machine['compiler'],
		'instructionSet': machine.get('instructionSet'),
		'quick': found['quick'],
		'notes': found['notes'],
	}
	kept = ('method', 'set', 'median', 'spread', 'wrong', 'pairs', 'pivots', 'iterations', 'contacts')
	kernels = [{key: one[key] for key in kept} for one in found.get('kernels', {}).get('measurements', [])]
	return _written(
		{'features': found.get('features'), 'shapes': found.get('shapes'), 'runs': [run], 'targets': found['targets'], 'kernels': kernels}
	)


def withKept(text, path):
	"""New results with those of the groups that were not measured with them; each run says its revision and date."""
	new = json.loads(text)
	if not path.exists():
		return text
	old, groups = json.loads(path.read_text()), new['runs'][0]['groups']
	runs = [{**run, 'groups': [group for group in run['groups'] if group not in groups]} for run in old['runs']]
	new['runs'] = [run for run in runs if run['groups']] + new['runs']
	new['targets'] = [row for row in old['targets'] if row['group'] not in groups] + new['targets']
	new['targets'].sort(key=lambda row: order.index(row['group']))
	for name, group in (('features', 'scenes'), ('shapes', 'shapes'), ('kernels', 'kernels')):
		if group not in groups:
			new[name] = old[name]
	return _written(new)


def _written(found):
	parts = {name: found[name] for name in ('runs', 'targets', 'kernels')}
	text = json.dumps({name: found[name] for name in ('features', 'shapes')}, indent=' ', ensure_ascii=False)[:-2]
	for name, rows in parts.items():
		text += f',\n "{name}": [\n' + ',\n'.join('  ' + json.dumps(row, ensure_ascii=False) for row in rows) + '\n ]'
	return text + '\n}\n'


def read(folder):
	return json.loads((folder / file).read_text())


def named(row):
	"""(what the rows of a group have in common, this row's own name): touching, warm, cube → (touching, warm; cube)."""
	head, comma, tail = row['measure'].rpartition(', ')
	return (head, tail) if comma else (row['measure'], '')


def against(row):
	"""The target without the count of a peer's wrong answers."""
	return re.sub(r' \(\d+ wrong\)', '', row['target'])


def wrong(row):
	found = re.search(r'\((\d+) wrong\)', row['target'])
	return f' ({found.group(1)} wrong)' if found else ''


def joined(texts):
	"""0.26 µs, 0.28 µs → 0.26, 0.28 µs."""
	texts = [text for text in texts if text]
	units = {text.partition(' ')[2] for text in texts}
	if len(units) == 1 and (unit := units.pop()):
		return ', '.join(text.partition(' ')[0] for text in texts) + ' ' + unit
	return ', '.join(texts)


def ratio(row):
	text = '' if row['ratio'] is None else short(row['ratio'])
	return bold(text or 'missed') if row['met'] is False else text


def targets(chosen):
	"""A table of the rows that are chosen: those of one measure and one target in one line, each ratio that misses in bold."""

	def figure(folder):
		found = read(folder)
		rows = [row for row in found['targets'] if chosen(row['measure'])]
		lines = []
		for (head, target), group in itertools.groupby(rows, key=lambda row: (named(row)[0], against(row))):
			group = list(group)
			names = ', '.join(named(row)[1] + wrong(row) for row in group if named(row)[1])
			judged = [row for row in group if row['met'] is not None]
			met = f'{sum(row["met"] for row in judged)} of {len(judged)}' if judged else ''
			if judged and not all(row['met'] for row in judged):
				met = bold(met)
			lines.append(
				[
					f'{head}: {names}' if names else head,
					target,
					joined(row['ours'] for row in group),
					joined(row['peer'] for row in group),
					', '.join(filter(None, map(ratio, group))),
					met,
				]
			)
		return table(['measure', 'target', 'ours', 'compared with', 'ratio', 'met'], lines)

	return figure


def isScene(measure):
	return measure.startswith(ofScenes)


def isBody(measure):
	return measure.startswith(ofBodies)


def isBeside(measure):
	return measure.startswith('whole step')


def isPair(measure):
	return not isScene(measure) and not isBody(measure) and not isBeside(measure)


def verdict(folder):
	"""How many targets are met, when and on what machine each group was measured, and what the runs themselves note."""
	found = read(folder)
	judged = [row for row in found['targets'] if row['met'] is not None]
	said = [f'{sum(row["met"] for row in judged)} of {len(judged)} targets met; ratios that miss are **bold** (`docs/results/bench.json`).']
	for run in found['runs']:
		about = '; '.join(filter(None, (origin(run), run['compiler'], run['instructionSet'])))
		notes = ''.join(f' {note[0].upper()}{note[1:]}' for note in run['notes'] if 'the machine was busy' not in note)  # origin says so
		said.append(f'{", ".join(run["groups"]).capitalize()}: {about}.{notes}')
	return '\n\n'.join(map(paragraph, said))


def faster(peer):
	"""Times faster than YADE's shape, the loop of 200 falling solids: least to most."""

	def figure(folder):
		rows = [
			row
			for row in read(folder)['targets']
			if row['measure'].startswith('InteractionLoop per step, 200 falling') and row['target'].endswith(peer)
		]
		if not rows:
			raise ValueError(f'{file}: no comparison with {peer}: run all groups of ./run bench')
		return f'{min(row["ratio"] for row in rows):.0f} to {max(row["ratio"] for row in rows):.0f} times faster'

	return figure


def energyCost(folder):
	"""What the energy of *foundation* adds to a warm query of pairs that touch: least to most of the sets in space, and in the plane."""
	kernels = {(row['method'], row['set']): row['median'] for row in read(folder)['kernels']}
	added = {
		name: 100 * (kernels['ours with energy warm', name] / without - 1)
		for (method, name), without in kernels.items()
		if method == 'ours warm' and not name.endswith('apart')
	}
	if not added:
		return 'not measured'
	inSpace = [cost for name, cost in added.items() if '2-D' not in name]
	inPlane = [cost for name, cost in added.items() if '2-D' in name]
	return f'{min(inSpace):.0f} to {max(inSpace):.0f} % in space, {max(inPlane):.0f} % in the plane'


def features(folder):
	found = read(folder)['features']
	if not found:
		raise ValueError(f'{file}: no cost of features: run all groups of ./run bench')
	costs, number = found['microseconds'], found['bodies']
	lines = [[name, f'{100 * (cost / costs["nothing"] - 1):+.0f} %'] for name, cost in costs.items() if name != 'nothing']
	return table([f'feature, on {number} settled cubes', 'adds to the time of a step'], lines)


figures = {
	'bench.verdict': verdict,
	'bench.scenes': targets(isScene),
	'bench.pairs': targets(isPair),
	'bench.bodies': targets(isBody),
	'bench.beside': targets(isBeside),
	'bench.energy': energyCost,
	'bench.features': features,
	'bench.polyhedra': faster('Polyhedra'),
}
