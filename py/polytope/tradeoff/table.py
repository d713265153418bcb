# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost and error of settings: the rows, the table, and its Pareto front."""

import copy
import csv
import math

import mpmath

from .arguments import checkReference
from .energy import growth

__all__ = ['Row', 'TradeoffTable', 'checkLength']

ofTheRows = object()
"""For *true*, where the reference's row is among the table's (None: it has no answer that counts)."""
digits = 60
"""Decimal digits in which answers are compared."""


class Row:
	"""One setting.

	:ivar str name: of the setting
	:ivar dict changes: what it changes
	:ivar values: name → number or list (mpmath, all digits) that measure() returned, the first one the answer; {} without an answer
	:ivar float error: of the answer, |answer − reference| over |reference| (or as it is, for a reference of 0); None without
	:ivar float stepMicroseconds: of all engines for one step
	:ivar float contactMicroseconds: of the interaction loop for one contact
	:ivar float contacts: in one step
	:ivar float timeStep: [s], when measure() ended
	:ivar float timeStepOfLimit: time step over polytope.stableTimeStep(1) when measure() ended, None without contacts
	:ivar float cost: µs for as much simulated time as the first setting's step
	:ivar int fallbacks, failures: of the contact functors over the run, see stats()
	:ivar list energy: what energy.Energy.created() found
	:ivar str note: why there is no answer, or why it does not count; '' where it does
	"""

	def __init__(self, name, changes):
		self.name, self.changes, self.values, self.note = name, changes, {}, ''
		self.error = self.stepMicroseconds = self.contactMicroseconds = self.contacts = self.timeStep = self.cost = self.seconds = None
		self.fallbacks, self.failures, self.timeStepOfLimit, self.energy = 0, 0, None, None

	def take(self, answer):
		"""What a process answered; of several the least times."""
		if 'error' in answer:
			self.note = ' '.join(answer['error'].split())
			return
		self.values = {name: _numbers(text) for name, text in answer['values'].items()}
		self.timeStep, self.seconds, self.contacts = answer['timeStep'], answer['seconds'], answer.get('contacts')
		self.fallbacks, self.failures = answer['fallbacks'], answer['failures']
		self.timeStepOfLimit, self.energy = answer.get('timeStepOfLimit'), answer.get('energy')
		for name in ('stepMicroseconds', 'contactMicroseconds'):
			times = [time for time in (getattr(self, name), answer.get(name)) if time is not None]
			setattr(self, name, min(times, default=None))

	@property
	def answer(self):
		"""The first of the values; None without."""
		return next(iter(self.values.values()), None)

	@property
	def counts(self):
		"""Whether it has cost and error, and no remark: only then it can be on the front."""
		return self.error is not None and self.cost is not None and not self.note


class TradeoffTable:
	"""What polytope.tradeoff() returns: *rows* in the order of the settings, see *Row*.

	Two kinds of answer do not count, and their row's *note* says why: one that is not a number (nan, inf), and one of a scene that blew up.
	That is judged by the kinetic energy after measure() against the energy before it and the work of gravity (energy.py): a
	row blew up if it created more than twice that, and ten times as much as the row that created least. Where all rows blow up, none does
	by this rule: check *dt·ω*.
	"""

	def __init__(self, rows, reference, true=ofTheRows):
		"""
		:param list rows: of Row
		:param reference: number, list, or name of a row
		:param true: the answer of *reference*, where its row is not among these
		:ivar str remark: why no row has an error; '' where they have
		"""
		self.rows, self.reference = rows, reference
		for row, grown in zip(rows, growth([row.energy for row in rows]), strict=True):
			if not row.note and row.answer is not None and not _isFinite(row.answer):
				row.note = f'the answer is {_shown(row.answer)}'
			elif not row.note and grown:
				row.note = f'blew up: kinetic energy was created, {grown:.2g} times what was available'
		true = self._true(reference) if true is ofTheRows else true
		self.remark = f'no error: the reference, {reference!r}, has no answer that counts' if true is None else ''
		first = next((row.timeStep for row in rows if row.timeStep), None)
		for row in rows:
			known = row.answer is not None and _isFinite(row.answer) and true is not None
			if known and isinstance(reference, str) and _length(row.answer) != _length(true):
				row.note, known = row.note or f'measure() returned {_length(row.answer)}, for {reference!r} {_length(true)}', False
			row.error = _difference(row.answer, true) if known else None
			if row.cost is None and row.stepMicroseconds is not None:
				row.cost = row.stepMicroseconds * (first / row.timeStep if row.timeStep else 1)

	def _true(self, reference):
		if isinstance(reference, str):
			return None if self[reference].note else self[reference].answer
		return _numbers([repr(float(x)) for x in reference] if hasattr(reference, '__len__') else repr(float(reference)))

	def __getitem__(self, name):
		"""The row of that name."""
		for row in self.rows:
			if row.name == name:
				return row
		raise KeyError(f'{name!r} is none of the settings, {[row.name for row in self.rows]}')

	def against(self, reference, names=None):
		"""A table of the same runs with errors against another reference; with *names*, of these rows alone.

		:raises ValueError: naming *reference*, if it is neither finite numbers nor the name of a row
		"""
		checkReference(reference, [row.name for row in self.rows])
		rows = [copy.copy(row) for row in (self.rows if names is None else map(self.__getitem__, names))]
		return TradeoffTable(rows, reference, self._true(reference))

	def front(self):
		"""Rows that no other one surpasses in both cost and error, lowest cost first; an error smaller by under a tenth is no gain. Without
		rows that do not count (see the class)."""
		measured = [row for row in self.rows if row.counts]
		measured.sort(key=lambda row: (row.cost, row.error))
		best, kept = math.inf, []
		for row in measured:
			if row.error < 0.9 * best or not kept:
				best = row.error
				kept.append(row)
		return kept

	columns = ('setting', 'answer', 'error', 'µs per step', 'µs per contact', 'contacts', 'dt·ω', 'cost', 'on the front', 'fallbacks', 'failures')

	def cells(self):
		"""The table as (columns, rows of text and numbers): further values of measure() come after the answer."""
		named = (name for row in self.rows for name in list(row.values)[1:] if not isinstance(row.values[name], list))
		others = list(dict.fromkeys(named))
		front, cheapest = self.front(), next((row.cost for row in self.rows if row.cost), None)
		columns = [*self.columns[:2], *others, *self.columns[2:], 'note']
		rows = []
		for row in self.rows:
			answer = row.answer
			shown = '' if answer is None else _shown(answer) if isinstance(answer, list) else float(answer)
			more = [float(row.values[name]) if name in row.values else '' for name in others]
			times = [row.stepMicroseconds, row.contactMicroseconds, row.contacts, row.timeStepOfLimit, row.cost / cheapest if row.cost and cheapest else None]
			rows.append(
				[row.name, shown, *more]
				+ ['' if value is None else value for value in (row.error, *times)]
				+ ['yes' if row in front else '', row.fallbacks, row.failures, row.note or self.remark]
			)
		return columns, rows

	def show(self):
		"""Prints it. *dt·ω* is the time step over polytope.stableTimeStep(1); *cost* is the time for as much simulated time as the first setting's step, over that of the first setting."""
		from tabulate import tabulate

		columns, rows = self.cells()
		short = {columns.index(name): '.3g' for name in ('error', 'µs per step', 'µs per contact', 'contacts', 'dt·ω', 'cost')}
		text = [
			[format(cell, short.get(k, '.10g')) if isinstance(cell, float) else cell for k, cell in enumerate(row)] for row in rows
		]
		print(tabulate(text, columns, disable_numparse=True))

	def csv(self, path):
		"""Writes it, with all digits of double precision."""
		columns, rows = self.cells()
		with open(path, 'w', newline='') as file:
			writer = csv.writer(file)
			writer.writerow(columns)
			writer.writerows(rows)

	def plot(self, path, title='', floor=1e-17):
		"""Writes a PNG: error over cost, both logarithmic, each point with its setting's name, the front drawn.

		:param float floor: errors below this, and 0, are drawn there
		:raises ValueError: naming *floor*, if it is not above 0
		"""
		from .plot import plotTradeoff

		plotTradeoff(path, [(title, self)], floor)


def _numbers(text):
	with mpmath.workdps(digits):
		return [_numbers(one) for one in text] if isinstance(text, list) else mpmath.mpf(text)


def _isFinite(answer):
	return all(mpmath.isfinite(one) for one in (answer if isinstance(answer, list) else [answer]))


def _shown(answer):
	if not isinstance(answer, list):
		return f'{float(answer):g}'
	return f'{len(answer)} numbers' + ('' if _isFinite(answer) else ', some of them nan or inf')


def checkLength(value, true):
	""":raises ValueError: naming *reference*: the true answer has not as many numbers as the measured one, or is one number where that is a list"""
	there, wanted = _length(value), _length(true)
	if there != wanted:
		raise ValueError(f'reference: must have as many numbers as measure() returns: that is {there}, the reference {wanted}')


def _length(value):
	return f'{len(value)} numbers' if hasattr(value, '__len__') else 'a single number'


def _difference(value, true):
	"""|value − true| over |true|, or as it is where that is 0; of lists the Euclidean norms."""
	checkLength(value, true)
	pairs = list(zip(value, true, strict=True)) if isinstance(true, list) else [(value, true)]
	with mpmath.workdps(digits):
		off, scale = (mpmath.sqrt(sum(x**2 for x in part)) for part in ([a - b for a, b in pairs], [b for _, b in pairs]))
		return float(off / scale) if scale else float(off)
