# SPDX-License-Identifier: GPL-2.0-or-later
"""What `./run paper` and `./run accuracy` do alike: run the scripts, write one report, say how it ended."""

import signal
import sys

from .paperReport import section, show, writeHtml, writeResults
from .paperRuns import perform

__all__ = ['endOnTerm', 'report']


def report(runs, given, template, absent, base=None):
	"""Performs the runs and writes report.html and results.csv into *given.output*, which must be there.

	:param runs: list of :yref:`Run`
	:param given: options with *output*, *quick*, *fresh* (run again what is complete) and *jobs* (at a time)
	:param template, absent, base: as in :yref:`writeHtml`
	:returns: exit code: 0, 1 where a row or a run is not good, 130 if interrupted
	"""
	if given.fresh:
		for run in runs:
			run.forget()
	try:
		perform(runs, given.jobs)
	except KeyboardInterrupt:
		print('\nInterrupted: what is complete is kept; call again to go on.', file=sys.stderr)
		return 130
	sections = [section(run) for run in runs]
	page, rows = given.output / 'report.html', given.output / 'results.csv'
	writeResults(sections, rows)
	writeHtml(sections, template, page, given.quick, absent, base=base)
	good = show(sections)
	print(f'\nReport: {page}, rows: {rows}')
	return 0 if good else 1


def endOnTerm():
	"""Lets a program that is told to end stop what perform() started."""
	signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
