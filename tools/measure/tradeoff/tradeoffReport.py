# SPDX-License-Identifier: GPL-2.0-or-later
"""What `./run tradeoff` writes: findings of each scene with table and plot, one page, and the summary over all scenes."""

import csv
import datetime
import math

import jinja2
from boon2012.reporting.findings import Findings
from boon2012.reporting.page import section
from boon2012.reporting.runs import Run
from tabulate import tabulate
from tradeoffAxes import coarse, default, isNumerical, scatter
from yade.polytope.tradeoff.plot import plotTradeoff

__all__ = ['notRun', 'reportScene', 'show', 'summary', 'writePage', 'writeSummary']

floor = 1e-17
"""Errors below this are drawn there."""
notRun = '–'
"""In the summary, for a setting that is not run in that scene."""


def reportScene(scene, table, folder, finest):
	"""Writes the findings of one scene to a folder: the table as CSV, the plot, and texts.

	:param Scene scene: see tradeoffAxes
	:param TradeoffTable table: of its runs; where there is no closed form its errors are against the finest arithmetic, or the mean of seeds
	:param str finest: setting with the finest arithmetic; None: there is none but double
	:returns: (Findings, {setting: error by arithmetic and solver alone})
	"""
	findings = Findings(scene.letter, scene.title, folder)
	truth = scene.because or ('the mean over seeds' if scene.letter == 'A' else f'{finest or default}, the finest arithmetic available')
	findings.text(f'Answer: {scene.answer}. Truth: {truth}' + (f', {scene.truth:.9g}.' if scene.truth else '.'))
	if scene.letter == 'A':
		mean, deviation = scatter(table)
		findings.text(
			f'A heap is chaotic: any change of setting, even of rounding, gives another heap. Over seeds the coordination number is '
			f'{mean:.3f} ± {deviation:.3f} (standard deviation); an error below {deviation / mean:.2g} means nothing.'
		)
	coarser = [row.name for row in table.rows if row.name in coarse]
	if coarser:
		findings.text(
			f'{", ".join(coarser)}: hardly in effect. The kernel takes the centre as far as a depth right to 2e-14 of the size needs, '
			'whatever newtonTolerance says: in overlaps deeper than 2e-4 of the size that is finer than the default, 1e-10, and the answer is '
			'the default\'s to the last digit; in thinner ones it differs in the last digits (which makes another heap, in A).'
		)
	same = [row.name for row in table.rows if isNumerical(row.name)]
	bySolver = table.against(finest, same) if finest and scene.letter != 'A' and table[finest].answer is not None else None
	errors = {row.name: row.error for row in bySolver.rows} if bySolver else {}
	columns, rows = table.cells()
	columns = [*columns[:-1], f'difference to {finest}' if bySolver else 'difference', columns[-1]]
	rows = [[*row[:-1], '' if errors.get(row[0]) is None else errors[row[0]], row[-1]] for row in rows]
	findings.table('table', 'One setting changed at a time; cost: time for as much simulated time, over the default\'s', columns, rows)
	panels = [(f'{scene.answer}: error against {"the closed form" if scene.truth else truth}', table)]
	if bySolver and scene.truth:
		panels.append((f'the same model in other arithmetic: difference to {finest}', bySolver))
	plotTradeoff(findings.folder / 'pareto.png', panels, floor, f'{scene.letter} · {scene.title}')
	findings.figure('pareto.png', 'Error over time, each point a setting; square: default; orange: on the front, surpassed by none in both')
	good = [row for row in table.rows if row.failures == 0 or row.note]
	findings.row('settings with contact queries without an answer', len(table.rows) - len(good), theory=0, accept=(0, 0))
	return findings, errors


def summary(tables, scenes):
	"""For each setting, over all scenes: (name, cost over the default's: least, median, most; {letter: error or note})."""
	names = list(dict.fromkeys(row.name for table in tables.values() for row in table.rows if not row.name.startswith('seed')))
	lines = []
	for name in names:
		costs, errors = [], {}
		for letter, table in tables.items():
			row = next((row for row in table.rows if row.name == name), None)
			if row is None:
				continue
			base = table[default]
			if row.cost and base.cost:
				costs.append(row.cost / base.cost)
			errors[letter] = row.note.partition(':')[0] if row.note else row.error
		costs.sort()
		middle = (costs[len(costs) // 2] + costs[(len(costs) - 1) // 2]) / 2 if costs else math.nan
		lines.append((name, (costs[0], middle, costs[-1]) if costs else (math.nan,) * 3, errors))
	return lines


def writeSummary(lines, letters, path):
	"""Writes the summary as CSV and returns (columns, rows of text), with *notRun* where a scene does not have the setting."""
	columns = ['setting', 'cost: least', 'median', 'most', *(f'error {letter}' for letter in letters)]
	rows = [[name, *costs, *(errors.get(letter, notRun) for letter in letters)] for name, costs, errors in lines]
	with open(path, 'w', newline='') as file:
		writer = csv.writer(file)
		writer.writerow(columns)
		writer.writerows([['' if cell in (None, notRun) else cell for cell in row] for row in rows])
	short = [[_short(cell, '.2f' if 0 < k < 4 else '.2g') for k, cell in enumerate(row)] for row in rows]
	return columns, short


def _short(cell, form):
	if isinstance(cell, float):
		return '' if math.isnan(cell) else format(cell, form)
	if cell is None:
		return 'no error'
	return {'RuntimeError': 'does not stand', 'interrupted before it was run': 'not run'}.get(cell, cell)


def show(columns, rows):
	"""Prints a table of texts."""
	print(tabulate(rows, columns, disable_numparse=True))


def writePage(path, parts, columns, rows, script, quick, interrupted=False):
	"""The HTML page.

	:param list parts: (Scene, its Findings)
	:param columns, rows: of the summary
	:param bool interrupted: whether scenes or settings are missing that were asked for
	"""
	sections = []
	for scene, findings in parts:
		run = Run(scene.letter, scene.title, script, findings.folder, [], '')
		sections.append(section(run))
	environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
	about = {'date': datetime.date.today().isoformat(), 'quick': quick, 'interrupted': interrupted}
	tables = {'columns': columns, 'rows': rows}
	path.write_text(environment.from_string(_page).render(sections=sections, about=about, **tables))


_page = '''<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>yade-polytope: accuracy for speed</title>
<style>
body { margin: 0 auto; max-width: 1180px; padding: 2rem 1.5rem 4rem; color: #1c2430; font: 15px/1.5 "DejaVu Sans", Arial, sans-serif; }
h1, h2 { color: #1d4e79; } h2 { border-top: 2px solid #1d4e79; padding-top: .8rem; margin-top: 3rem; }
.wide { overflow-x: auto; } .wide table { width: 100%; } table { border-collapse: collapse; font-size: .8rem; }
th, td { padding: .25rem .4rem; border-bottom: 1px solid #d9dee6; text-align: right; white-space: nowrap; }
th, .words { white-space: normal; }
th:first-child, td:first-child, .parts td:last-child, .parts th:last-child { text-align: left; } th { color: #687385; vertical-align: bottom; }
th:first-child, td:first-child { position: sticky; left: 0; background: #fff; } .parts td:last-child { min-width: 6rem; }
figure { margin: 1.2rem 0; } img { max-width: 100%; border: 1px solid #d9dee6; } .quiet, figcaption { color: #687385; }
</style></head><body>
<h1>Accuracy for speed: cost of each setting, and its effect on the answer</h1>
<p class="quiet">{{ about.date }}{% if about.quick %} · quick variant: fewer settings{% endif %}{% if about.interrupted %} · interrupted: not all that was asked for is here{% endif %}. One setting is changed at a time. Costs
are times for as much simulated time as the default's step, over the default's; errors are relative, against closed forms (B, C, D, F,
rest), the finest arithmetic (pair) or the mean over seeds (A). –: the setting is not run in that scene (too slow there, of no
meaning, or left out of the quick variant); blank costs: no run of it gave an answer. Settings named in words instead of a figure have no
answer that counts; the table of the scene says why.</p>
<h2>All scenes</h2>
<div class="wide"><table><tr>{% for title in columns %}<th>{{ title }}</th>{% endfor %}</tr>
{% for row in rows %}<tr>{% for cell in row %}<td{% if ' ' in cell and not loop.first %} class="words"{% endif %}>{{ cell }}</td>{% endfor %}</tr>{% endfor %}</table></div>
{% for part in sections %}<h2 id="{{ part.letter }}">{{ part.letter }} · {{ part.title }}</h2>
{% for item in part.parts %}
{% if item.kind == 'text' %}<p>{{ item.text }}</p>
{% elif item.kind == 'figure' %}<figure><img src="{{ item.url }}" alt="{{ item.caption }}"><figcaption>{{ item.caption }}</figcaption></figure>
{% else %}<p class="quiet">{{ item.caption }}. Blank: not measured.</p><div class="wide parts"><table>
<tr>{% for title, number in item.columns %}<th>{{ title }}</th>{% endfor %}</tr>
{% for row in item.rows %}<tr>{% for text, number in row %}<td{% if not number and not loop.first %} class="words"{% endif %}>{{ text }}</td>{% endfor %}</tr>{% endfor %}</table></div>
{% endif %}{% endfor %}{% endfor %}
</body></html>
'''
