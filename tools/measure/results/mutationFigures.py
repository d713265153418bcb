# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of the mutation run: how many mutants the tests notice, and why the others are not noticed."""

import collections
import csv
import io
import json
import pathlib

from text import bold, paragraph, table

file = 'mutation.csv'
judgements = pathlib.Path(__file__).resolve().parents[1] / 'mutation/survivors.csv'
"""Written by hand: whether each survivor is *equivalent* (no answer differs by more than rounding) or *open*, and why."""
columns = 'revision seed id file line column kind original mutant source ran reachedBy killedBy'.split()
ofMutant = ('file', 'column', 'original', 'mutant', 'source')
"""What a survivor is known by, whatever line it is on."""


def taken(source):
	"""results.json of the mutation run as CSV."""
	found = json.loads(source.read_text())
	out = io.StringIO()
	writer = csv.DictWriter(out, columns, extrasaction='ignore', lineterminator='\n')
	writer.writeheader()
	for row in found['mutants']:
		same = {'revision': found['revision'], 'seed': found['seed'], 'ran': ' '.join(row['ran']), 'killedBy': row['killedBy'] or ''}
		writer.writerow({**row, **same})
	return out.getvalue()


def withKept(text, path):
	"""New results with those of other mutants, as *path* has them: kernel and law may be run apart, and a mutant that survived stays.
	Those whose line is no longer in the sources are left out.
	"""
	if not path.exists():
		return text
	new = list(csv.DictReader(io.StringIO(text)))
	again = {tuple(row[key] for key in ofMutant) for row in new}
	found = [row for row in rows(path) if tuple(row[key] for key in ofMutant) not in again and present(row, path.parents[2])] + new
	out = io.StringIO()
	writer = csv.DictWriter(out, columns, lineterminator='\n')
	writer.writeheader()
	writer.writerows(sorted(found, key=lambda row: (row['file'], int(row['line']), int(row['column']), row['mutant'])))
	return out.getvalue()


def rows(path):
	with open(path, newline='') as found:
		return list(csv.DictReader(found))


def present(row, root):
	"""Whether the line of the mutant is still in the sources."""
	source = root / row['file']
	return source.exists() and row['source'].split() in map(str.split, source.read_text().splitlines())


def judged(folder):
	"""(killed, equivalent, open, not judged): rows of the mutants; the last three with *why*."""
	known = {tuple(row[key] for key in ofMutant): row for row in rows(judgements)}
	found = {'killed': [], 'equivalent': [], 'open': [], 'not judged': []}
	for row in rows(folder / file):
		said = known.get(tuple(row[key] for key in ofMutant))
		kind = 'killed' if row['killedBy'] else said['verdict'] if said else 'not judged'
		found[kind].append({**row, 'why': said['why'] if said else ''})
	return found


def summary(folder):
	found = judged(folder)
	count = {kind: len(some) for kind, some in found.items()}
	some = sum(count.values())
	left = some - count['equivalent']
	share = 100 * count['killed'] / left
	revisions = collections.defaultdict(set)
	for row in rows(folder / file):
		revisions[row['revision'][:7], row['seed']].add(str(pathlib.PurePosixPath(row['file']).parent))
	which = '; '.join(
		f'{", ".join(sorted(places))}: revision {revision}, seed {seed}' for (revision, seed), places in sorted(revisions.items())
	)
	text = f'{share:.1f} %'
	return paragraph(f"""{some} mutants were run ({which}): {count['killed']} are killed, {count['equivalent']} change
		no answer. Of the {left} others {text if share >= 95 else bold(text)} are killed; {count['open'] + count['not judged']} survive. The target is 95 %.""")


def byPlace(folder):
	"""A line for each folder of the sources."""
	found, counts = judged(folder), collections.defaultdict(collections.Counter)
	for kind, some in found.items():
		for row in some:
			for name in (str(pathlib.PurePosixPath(row['file']).parent), 'all'):
				counts[name][kind] += 1
	lines = []
	for name in sorted(counts, key=lambda name: (name == 'all', name)):
		one = counts[name]
		surviving = one['open'] + one['not judged']
		lines.append([name, sum(one.values()), one['killed'], one['equivalent'], bold(surviving) if surviving else 0])
	return table(['in', 'mutants', 'killed', 'equivalent', 'survive'], lines)


def listed(kind):
	def figure(folder):
		some = sorted(judged(folder)[kind], key=lambda row: (row['file'], int(row['line'])))
		lines = [[row['file'], f'`{row["source"]}`', change(row), row['why']] for row in some]
		return table(['place', 'source', 'mutant', 'why'], lines) if lines else 'None.'

	return figure


def change(row):
	return f'`{row["original"]}` → `{row["mutant"]}`' if row['mutant'] else f'`{row["original"]}` left out'


figures = {
	'mutation.summary': summary,
	'mutation.places': byPlace,
	'mutation.open': lambda folder: (
		'\n\n'.join(filter(lambda text: text != 'None.', [listed('open')(folder), listed('not judged')(folder)])) or 'None.'
	),
	'mutation.equivalent': listed('equivalent'),
}
