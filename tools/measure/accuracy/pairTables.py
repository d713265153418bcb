# SPDX-License-Identifier: GPL-2.0-or-later
"""Evaluation of the samples of polytope_extremes: faults, worst errors, and statuses."""

import collections
import csv
import math
import statistics

from yade._polytope import statuses

__all__ = ['Sample', 'faults', 'quiet', 'readSamples', 'summary', 'unjudged', 'worst']

quiet = ('contact', 'normalFromOneBody', 'normalFromDual')
"""Statuses that raise no doubt about point, depth and normal; every other one is a warning."""
failed = ('refused', *(name for name, answered in statuses().items() if not answered))

rounding = 2.0**-52

textColumns = ('axis', 'kind', 'status', 'refusal')
flags = ('inContact', 'touches', 'within', 'compared', 'finite', 'bounded', 'free')


class Sample:
	"""One contact of one pair: the CSV's columns as attributes, NaN where there is none."""

	def __init__(self, row):
		for name, text in row.items():
			if name in flags:
				setattr(self, name, text == '1')
			else:
				setattr(self, name, text if name in textColumns else float(text) if text else math.nan)

	@property
	def refused(self):
		return self.status == 'refused'

	@property
	def missed(self):
		"""A contact called separated, beyond the uncertainty by rounding. Failures have a status."""
		return self.touches and not self.inContact and not self.within and self.status == 'separated'

	@property
	def falseContact(self):
		return self.inContact and not self.touches and not self.within

	def error(self, quantity):
		"""A column or one of `derived`; NaN where the sample has none, or its status is a warning. s* needs no direction."""
		ofProgram = quantity == 'infeasibilityError' and self.status == 'noDirection'
		if self.refused or not (ofProgram or self.status in (*quiet, 'separated')):
			return math.nan
		if quantity in ('depthError', 'centreError', 'forceError', 'normalError') and not self.compared:
			return math.nan
		return derived[quantity](self) if quantity in derived else getattr(self, quantity)

	@property
	def silent(self):
		"""An error beyond what rounding of the planes explains, with a status that raises no doubt."""
		if self.status not in (*quiet, 'separated'):
			return False
		# s*: the program's certificate has roundings of its own (tolerance::certain), so twice as much. 2e-14: what the depth's definition leaves to a centre accepted at newtonTolerance
		pairs = [(self.infeasibilityError, 2 * self.infeasibilityRounding)]
		if self.compared:
			pairs += [
				(self.depthError, self.depthRounding + 2e-14),
				(self.centreError, self.centreRounding),
				(self.normalError, self.normalRounding),
			]
		return any(error > allowed for error, allowed in pairs)


def _compared(sample, value):
	return value if sample.compared else math.nan


derived = {
	'infeasibilityOfLarger': lambda s: s.infeasibilityError / s.value,
	'depthOfLarger': lambda s: _compared(s, s.depthError / s.value),
	'centreTimesOverlap': lambda s: _compared(s, max(s.centreError - 3e-9, 0) * -s.infeasibility),
	'depthTimesDistance': lambda s: _compared(s, s.depthError * s.value),
	'movedOverDistance': lambda s: abs(s.moved) / s.value,
	'overlapCalledContact': lambda s: -s.infeasibility / rounding if s.inContact and s.value > -150 else math.nan,
	'overlapCalledSeparated': lambda s: -s.infeasibility / rounding if not s.inContact else math.nan,
}


def readSamples(path):
	"""The samples of one CSV file."""
	with open(path, newline='') as file:
		return [Sample(row) for row in csv.DictReader(file)]


def faults(samples):
	"""Faults: {name: samples}."""
	asked = [s for s in samples if not s.refused]
	return {
		'not a number': [s for s in asked if not s.finite],
		'unbounded': [s for s in asked if not s.bounded],
		'missed contact': [s for s in asked if s.missed],
		'false contact': [s for s in asked if s.falseContact],
		'no way out along the normal': [s for s in asked if not s.free],
		'error without a status': [s for s in asked if s.silent],
	}


def unjudged(samples):
	"""Samples for which error() has nothing to say but s*: refused, with a status that is a warning, or contacts without a reference."""
	return [
		s
		for s in samples
		if s.status not in (*quiet, 'separated') or math.isnan(s.error('infeasibilityError')) or (s.inContact and not s.compared)
	]


def worst(samples, limit):
	"""The largest (and least) value of a limit's quantity over the samples it holds for; NaN, NaN where there is none."""
	values = [s.error(limit.quantity) for s in samples if limit.low <= s.value <= limit.high and not s.refused]
	values = [v for v in values if not math.isnan(v)]
	return (max(values), min(values)) if values else (math.nan, math.nan)


summaryColumns = (
	'pair',
	'value',
	'samples',
	's*: median error',
	's*: worst',
	'depth: worst error',
	'depth × normal: worst error',
	'point: median error',
	'point: worst',
	'normal: worst error',
	'µs, worst',
	'how they ended',
)


def summary(samples):
	"""Rows for `summaryColumns`: one for each kind of pair and value."""
	groups = collections.defaultdict(list)
	for s in samples:
		groups[s.kind, s.value].append(s)
	rows = []
	for (kind, value), group in groups.items():

		def of(pick, name, group=group):
			values = [getattr(s, name) for s in group if not s.refused and (name == 'infeasibilityError' or s.compared)]
			return f'{pick(values):.2g}' if values else ''

		ends = collections.Counter(s.status for s in group)
		times = [s.nanoseconds / 1e3 for s in group if not s.refused]
		rows.append(
			[
				kind,
				f'{value:g}',
				len(group),
				of(statistics.median, 'infeasibilityError'),
				of(max, 'infeasibilityError'),
				of(max, 'depthError'),
				of(max, 'forceError'),
				of(statistics.median, 'centreError'),
				of(max, 'centreError'),
				of(max, 'normalError'),
				f'{max(times):.3g}' if times else '',
				', '.join(f'{name} {count}' for name, count in ends.items()),
			]
		)
	return rows
