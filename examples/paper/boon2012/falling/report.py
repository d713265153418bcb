# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of simulation A: whether all have come to rest as they should, over several seeds.

Heaps are chaotic: with another seed each solid ends in another heap. The reference is one run of each solid, so what must hold is
compared over the seeds, with their scatter.
"""

import math
import statistics

from scipy.stats import f, t

from .run import halfStep, quantities

__all__ = ['FallingPolyhedraReport', 'rounded']

fewestSeeds = 5
"""Least number of seeds: with fewer, chance and cause cannot be distinguished."""


class FallingPolyhedraReport:
	"""
	:param Findings findings: where it goes
	:param given: the options *number*, *steps*, *seed*, *seeds*, *quick*, *no_pictures*, *output*; and *reference*: whether the run is
	    one that *expected* is known for; otherwise nothing is compared with it
	:param list results: of all runs, see FallingRun
	:param dict expected: name in the results → (from, to)
	:param dict scatter: name in the results → standard deviations between seeds of the least and the largest of the solids
	:param int scatterSeeds: of how many seeds they are
	"""

	def __init__(self, findings, given, results, expected, scatter, scatterSeeds):
		self.findings, self.given, self.results, self.expected, self.scatter = findings, given, results, expected, scatter
		self.freedom = scatterSeeds - 1
		self.firsts = [r for r in results if r['seed'] == given.seed]
		self.ofSolid = {r['shape']: [other for other in results if other['shape'] == r['shape']] for r in self.firsts}
		self.several = given.seeds >= fewestSeeds

	@property
	def ranges(self):
		"""What is expected, empty where it is not known."""
		return self.expected if self.given.reference else {}

	def inside(self):
		number, seeds = self.given.number, self.given.seeds
		solids = 'five solids' if len(self.ofSolid) == 5 else ', '.join(self.ofSolid)
		note = f'{len(self.results)} runs: {solids}, {seeds} seed{"s"[: seeds > 1]} each'
		fewest = min(r['inside'] for r in self.results)
		self.findings.row('particles inside, fewest of all runs', fewest, accept=(number, number), note=note)

	def answered(self, paper):
		"""Queries without an answer; *paper* is what the paper says of its own."""
		pairs, contacts, failures = (sum(r[key] for r in self.results) for key in ('pairs', 'contactQueries', 'failures'))
		note = f'of {pairs:,} pairs queried, of which {contacts:,} were contacts'
		self.findings.row('contact queries without an answer', failures, paper=paper, accept=(0, 0), note=note)

	def largest(self, key, chance=False):
		"""Median over the seeds, of the solid where it is largest: it must not exceed what is expected.

		:param bool chance: that one body can decide it in a single run: with few seeds the second least of the solids must hold, not the largest
		"""
		if key == 'energyHalf' and self.given.steps < halfStep:
			return
		ofSolids = [(statistics.median(r[key] for r in runs), name) for name, runs in self.ofSolid.items()]
		worst, name = max(ofSolids)
		low, high = self.expected[key]
		must = (0, high) if self.given.reference and (self.several or not chance) else None
		note = f'{name}; median of the seeds; reference: ' + (f'{low:g} … {high:g}; less is no fault' if low else f'at most {high:g}')
		self.findings.row(f'{quantities[key]}: largest of the solids', rounded(worst), accept=must, note=note)
		if chance and not self.several and self.given.reference and len(ofSolids) == 5:
			second = rounded(sorted(value for value, _ in ofSolids)[1])
			note = 'of one run a solid: in one of ten a single body topples late (6 of 60 runs), so in four of five of them by chance once in 2000 reports'
			self.findings.row(f'{quantities[key]}: second least of the solids', second, accept=(0, high), note=note)

	def extremes(self, key):
		"""Least and largest of the five solids. The reference has those of five single runs: the mean of our seeds must differ from it by no
		more than 99 % of such differences do, at the scatter between seeds that was measured once. It does not grow with that of this run,
		which must itself be no larger, by the distributions of Student and Fisher."""
		if not self.given.reference or len(self.ofSolid) != 5:
			return
		extremes = zip((min, max), ('least', 'largest'), self.expected[key], self.scatter[key], strict=True)
		for pick, word, reference, deviation in extremes:
			values = [pick(r[key] for r in runs) for runs in zip(*self.ofSolid.values(), strict=True)]
			half = rounded(t.ppf(0.995, self.freedom) * deviation * math.sqrt(1 + 1 / len(values)))
			must = rounded(reference - half), rounded(reference + half)
			note = f'reference, of one run of each solid: {reference:g}, ± 99 % at a scatter of {deviation:g} between seeds'
			title = f'{quantities[key]}: {word} of the solids'
			self.findings.row(title, rounded(statistics.fmean(values)), accept=must, note=note + '; ours: mean of the seeds' * self.several)
			if self.several:
				most = rounded(deviation * math.sqrt(f.ppf(0.995, len(values) - 1, self.freedom)))
				self.findings.row(
					f'{title}, scatter between seeds',
					rounded(statistics.stdev(values)),
					accept=(0, most),
					note='99.5 % of such samples are below',
				)

	def singleRuns(self):
		"""Why single runs are outside the ranges of the reference."""
		if not self.given.reference or len(self.ofSolid) != 5 or not self.several:
			return
		outside = {}
		for key, (low, high) in self.expected.items():
			outside[quantities[key]] = sum(not low <= r[key] <= high for r in self.results)
		counts = ', '.join(f'{count} in “{label}”' for label, count in outside.items() if count) or 'none'
		heights = [r['meanHeight'] for r in self.ofSolid['tetrahedron']]
		mean, deviation = statistics.fmean(heights), statistics.stdev(heights)
		reference = self.expected['meanHeight'][1]
		away = (reference - mean) / deviation
		self.findings.text(
			f'Heaps are chaotic: with another seed each solid ends in another heap. Of {len(self.results)} runs these are '
			f'outside the reference: {counts}. Its ranges are those of one run of each solid by an independent program, so single runs '
			'fall outside by chance; what must hold is compared over the seeds. '
			f"The tetrahedra's mean height is an example: {mean:.3f} L in the mean of {self.given.seeds} seeds, "
			f'with a standard deviation of {deviation:.3f} L between them ({min(heights):.3f} … {max(heights):.3f} L). '
			f'The largest of the reference, {reference:g} L, lies {abs(away):.1f} standard deviations '
			+ ('below' if away < 0 else 'above')
			+ ' our mean: '
			+ ('chance explains it.' if abs(away) < 2 else 'chance hardly explains it.')
		)

	def seeds(self):
		"""Table of all quantities, over the seeds."""
		rows = []
		for key, label in quantities.items():
			for name, runs in self.ofSolid.items():
				figures = (pick(r[key] for r in runs) for pick in (statistics.median, min, max))
				rows.append([label, name, len(runs), *figures, *self.ranges.get(key, ('', ''))])
		columns = ['', 'solid', 'seeds', 'median', 'least', 'largest', 'reference, from', 'reference, to']
		self.findings.table('settled', 'How each solid came to rest, over the seeds.', columns, rows)

	def figures(self):
		"""The pictures of the first seed's runs."""
		given = self.given
		if given.no_pictures:
			return
		steps = f'at the start, at step {min(halfStep, given.steps)} and at step {given.steps}'
		for r in self.firsts if not given.quick else ():
			caption = f"As the paper's Fig. 5, {r['shape']}: {given.number} bodies {steps}. The walls are not drawn."
			self.findings.figure(f'{r["shape"]}/steps.png', caption)


def rounded(value):
	"""The value, rounded to the digits that mean something here."""
	return float(f'{value:.4g}')
