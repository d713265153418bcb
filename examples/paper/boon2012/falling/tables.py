# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables that simulation A prints: costs, results, and final states."""

from tabulate import tabulate

from .run import quantities

__all__ = ['showCosts', 'showOutcome', 'showStates']

costColumns = (
	('shape', 'solid', ''),
	('planesPerPair', 'planes\nper pair', ''),
	('pairs', 'pairs\nqueried', ','),
	('dismissed', 'dismissed\nat once', ','),
	('contactQueries', 'contacts\nsolved', ','),
	('pivotsPerPair', 'pivots\nper LP', '.3f'),
	('newtonPerContact', 'Newton\nper centre', '.2f'),
	('lpMicroseconds', 'µs per\nLP', '.2f'),
	('centreMicroseconds', 'µs per\ncentre', '.2f'),
	('loopMicrosecondsPerPair', 'loop: µs\nper pair', '.2f'),
	('loopMicrosecondsPerContact', 'loop: µs\nper contact', '.2f'),
	('fallbacks', 'fall-\nbacks', ','),
	('failures', 'fail-\nures', ','),
	('seconds', 'run\n[s]', '.1f'),
)
"""Name in the results, column title, format."""


def showCosts(results):
	"""One line a run."""
	rows = [['' if r[key] is None else format(r[key], form) for key, _, form in costColumns] for r in results]
	print('\nWhat the contact detection did, and what it cost')
	print(tabulate(rows, [title for _, title, _ in costColumns], stralign='right', disable_numparse=True))


def showOutcome(results, ranges, known, chaotic=()):
	"""One column a run.

	:param dict ranges: of the reference, name in the results → (from, to); empty where nothing is known
	:param str known: for what it is known
	:param chaotic: names of results that chance decides in a single run, which may lie outside and gets no verdict
	"""
	print('\nWhat came out' + ('' if ranges else f' (the reference is known for {known})'))
	rows = [['particles inside', results[0]['number'], *(r['inside'] for r in results)]]
	rows.append(['queries without an answer', 0, *(r['failures'] for r in results)])
	for key, label in quantities.items():
		judged = None if key in chaotic else ranges.get(key)
		rows.append(
			[
				label + ' *' * (key in chaotic and key in ranges),
				_range(ranges.get(key)),
				*(f'{r[key]:.4g}' + _verdict(r[key], judged) for r in results),
			]
		)
	print(tabulate(rows, ['', 'reference', *[r['shape'] for r in results]], disable_numparse=True))
	if ranges and chaotic:
		print(
			'* Heaps are chaotic, and a body that topples late or a hard impact decides alone: a single run may lie outside. What must hold is'
		)
		print('  compared below where all five solids are run, and by ./run paper --only A over eight seeds.')


def _range(ends):
	return '' if ends is None else f'{ends[0]:g} … {ends[1]:g}'


def _verdict(value, ends):
	if ends is None:
		return ''
	return '  ok' if ends[0] <= value <= ends[1] else '  outside'


def showStates(results):
	print('\nState at the end (SHA-256, first 16 digits; the same every time with one thread)')
	print(tabulate([[r['shape'], r['stateHash']] for r in results], tablefmt='plain'))
