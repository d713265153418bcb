# SPDX-License-Identifier: GPL-2.0-or-later
"""Costs of simulation A (the paper's Fig. 6): time per contact problem against the number of planes of both bodies."""

import math

import numpy as np

from .plots import plotCosts
from .report import rounded

__all__ = ['ContactCostReport', 'curves']

curves = {
	'ipoptMicroseconds': 'centre by Ipopt, cold start',
	'centreColdMicroseconds': 'centre by Newton, cold start',
	'centreMicroseconds': 'centre by Newton, warm start',
	'lpColdMicroseconds': 'linear program, cold start',
	'lpMicroseconds': 'linear program, warm start',
}
"""Name in the results → label."""


class ContactCostReport:
	"""Reports the costs of those runs that have one solid each and states to time; with none of them it reports nothing.

	:param Findings findings: where it goes
	:param given: the options *output* and *no_pictures*
	:param list results: one run of each solid, see FallingRun
	"""

	def __init__(self, findings, given, results):
		self.findings, self.given = findings, given
		self.timed = [r for r in results if r['planesPerPair'] and 'cold' in r]
		self.planes = [r['planesPerPair'] for r in self.timed]
		self.curves = {}
		if self.timed:
			self.curves = {key: label for key, label in curves.items() if all(math.isfinite(r.get(key, math.nan)) for r in self.timed)}
		self.hasIpopt = bool(self.timed) and 'ipopt' in self.timed[0]

	def times(self, paper):
		"""*paper*: what it reads from its own figure, name in the results → text."""
		for key, label in self.curves.items():
			ours = _span(self._values(key))
			self.findings.row(f'{label}: N = {_span(self.planes)}', ours, 'µs', paper=paper.get(key))

	def ipopt(self, paper):
		"""Contacts that it did not find; *paper* is what the paper says of its own."""
		if self.hasIpopt:
			missing, tried = (sum(r['ipopt'][key] for r in self.timed) for key in ('fallbacks', 'contacts'))
			self.findings.row('contacts whose centre Ipopt did not find', missing, paper=paper, note=f'of {tried:,} given to it')

	def growth(self, paper):
		"""Powers of N; *paper*: name in the results → text."""
		for key, (label, exponent, constant, slope) in self._fits().items():
			note = f'straight line through the five: {constant:.3g} µs + {slope:.3g} µs × N'
			self.findings.row(f'{label}: grows as N to the power', rounded(exponent), paper=paper.get(key), note=note)

	def figure(self, paperBands, paperText):
		"""Fig. 6, redrawn.

		:param paperBands: see plotCosts()
		:param str paperText: what they are, for the caption
		"""
		if self.timed and not self.given.no_pictures:
			plotCosts(self.given.output / 'fig6.png', self.timed, self.curves, paperBands)
			caption = (
				"The paper's Fig. 6, redrawn: time per contact problem against the number of planes of both bodies. "
				f'Shaded: what the paper says of its own, {paperText}.'
			)
			self.findings.figure('fig6.png', caption)

	def howTimed(self, paperSolvers):
		"""How the times were taken, and what they may be compared with; *paperSolvers* are those of the paper."""
		if not self.timed:
			return
		first = self.timed[0]
		text = (
			"Times are wall times by the functor's own clock. Warm start is what a run costs: each pair begins with its last step's basis "
			'and point; the mean over all pairs (LP) or contacts (centre) of ten steps in every hundred of the whole run. Cold start is '
			f'what the paper timed, whose solvers started anew in each step: all pairs and contacts of {first["cold"]["states"]} states '
			'spread evenly over the run, each state gone through five times, of which the fastest counts. Steps in which another program '
			'took the processor do not count.'
		)
		if self.hasIpopt:
			seconds = sum(r['ipoptMicroseconds'] * r['contactQueries'] for r in self.timed) * 1e-6
			ratios = [r['ipoptMicroseconds'] / r['centreColdMicroseconds'] for r in self.timed]
			text += (
				f' Ipopt solved every contact of {first["ipopt"]["states"]} of these states three times, of which the fastest counts; all '
				f'{sum(self._values("contactQueries")):,} contacts of the runs would take it {seconds / 3600:.1f} hours. '
				f'It takes {min(ratios):.0f} to {max(ratios):.0f} times as long as Newton '
				'for the same centre: setting up a general problem costs more than solving three equations.'
			)
		else:
			text += ' Ipopt is not in this build or was not asked for: its curve is missing.'
		self.findings.text(
			f'{text} The paper used general solvers ({paperSolvers}) on a machine of its time; here each problem has a solver of its own, '
			'for exactly four and three unknowns. Absolute times differ for both reasons; '
			'their order and their growth with N can be compared.'
		)

	def tables(self):
		if not self.timed:
			return
		rows = [[r['shape'], r['planesPerPair'], *[r[key] for key in self.curves]] for r in self.timed]
		self.findings.table('fig6', 'Time per contact problem [µs].', ['solid', 'N', *self.curves.values()], rows)
		fits = self._fits()
		if fits:
			columns = ['', 'power', 'constant [µs]', 'slope [µs per plane]']
			caption = 'How the times grow with N: as a power, and as a straight line constant + slope N.'
			self.findings.table('fig6_fits', caption, columns, fits.values())
		columns = ['solid', 'N', 'pivots per LP, warm', 'pivots per LP, cold', 'Newton steps, warm', 'Newton steps, cold']
		columns += ['pairs, cold', 'contacts, cold', 'contacts, Ipopt', 'iterations, Ipopt', 'fallbacks, Ipopt', 'failures, cold and Ipopt']
		caption = 'What the times of cold starts and of Ipopt are means of, and how the solvers did.'
		self.findings.table('fig6_sample', caption, columns, [self._sampleRow(r) for r in self.timed])

	@staticmethod
	def _sampleRow(r):
		cold, ipopt = r['cold'], r.get('ipopt') or dict.fromkeys(r['cold'], 0)
		work = [source[key] for key in ('pivotsPerPair', 'newtonPerContact') for source in (r, cold)]
		counts = cold['pairs'], cold['contacts'], ipopt['contacts'], ipopt['ipoptPerContact'], ipopt['fallbacks']
		return [r['shape'], r['planesPerPair'], *work, *counts, cold['failures'] + ipopt['failures']]

	def _values(self, key):
		return [r[key] for r in self.timed]

	def _fits(self):
		"""Name in the results → (label, power of N, constant, slope of a straight line); empty with less than three solids."""
		fits = {}
		for key, label in self.curves.items() if len(self.timed) >= 3 else ():
			exponent = np.polyfit(np.log(self.planes), np.log(self._values(key)), 1)[0]
			slope, constant = np.polyfit(self.planes, self._values(key), 1)
			fits[key] = label, exponent, constant, slope
		return fits


def _span(values):
	low, high = format(min(values), '.3g'), format(max(values), '.3g')
	return low if low == high else f'{low} … {high}'
