# SPDX-License-Identifier: GPL-2.0-or-later
"""Common to `./run paper` and `./run accuracy`: run the scripts, write one report, print the outcome."""

import argparse
import signal
import sys

from .options import writableFolder
from .page import section, show, writeHtml, writeResults
from .runs import perform

__all__ = ['endOnTerm', 'outputFolder', 'report']


def outputFolder(parser, folder):
	"""The folder as a whole path, made if need be; ends the program as argparse does, naming --output, if no file can be written there."""
	try:
		folder = writableFolder(folder)
		folder.mkdir(parents=True, exist_ok=True)
	except (argparse.ArgumentTypeError, OSError) as error:
		parser.error(f'--output: {error}')
	return folder


def report(planned, given, template, base=None):
	"""Performs the runs that *given.only* names and writes report.html and results.csv into *given.output*, which must be there.

	Of the others those are shown, too, that an earlier call completed there, from the same source and with the same options.

	:param planned: list of :yref:`Run`, all there are
	:param given: options with *only* (letters), *output*, *quick*, *fresh* (run again what is complete) and *jobs* (at a time)
	:param template, base: as in :yref:`writeHtml`
	:returns: exit code: 0, 1 where a row or a run that is shown is not good, 130 if interrupted
	"""
	runs = [run for run in planned if run.letter in given.only]
	if given.fresh:
		for run in runs:
			run.forget()
	try:
		perform(runs, given.jobs)
	except KeyboardInterrupt:
		print('\nInterrupted: what is complete is kept; call again to go on.', file=sys.stderr)
		return 130
	earlier = [run.letter for run in planned if run not in runs and run.complete]
	absent = [run.letter for run in planned if run not in runs and run.letter not in earlier]
	sections = [section(run) for run in planned if run.letter not in absent]
	page, rows = given.output / 'report.html', given.output / 'results.csv'
	writeResults(sections, rows)
	writeHtml(sections, template, page, given.quick, absent, earlier, base=base)
	good = show(sections)
	if earlier:
		print(f'\nComplete in this folder from an earlier call, and shown as well: {", ".join(earlier)}')
	print(f'\nReport: {page}, rows: {rows}')
	return 0 if good else 1


def endOnTerm():
	"""Stops, on a signal to end, the processes that perform() started."""
	signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
