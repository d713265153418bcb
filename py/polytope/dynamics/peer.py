# SPDX-License-Identifier: GPL-2.0-or-later
"""Records as the PEER ground motion database has them (.AT2, .VT2): four lines of words, then values at equal intervals, some in a line."""

import re

import numpy as np

__all__ = ['peerRecord']

headLines = 10
"""In which the line with NPTS and DT is looked for; PEER's files have it in the fourth."""
standardGravity = 9.80665
"""[m/s²]"""
decimal = r'[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?'
counts = re.compile(rf'NPTS\s*=\s*(\d+)\D*?\bDT\s*=\s*({decimal})', re.IGNORECASE)
countsBefore = re.compile(rf'^\s*(\d+)\s+({decimal})\s+NPTS\s*,\s*DT', re.IGNORECASE)
"""The line as files had it until 2013: 4000 0.0050 NPTS, DT."""
units = {
	'acceleration': {'g': standardGravity, 'cm/s2': 0.01, 'cm/s/s': 0.01, 'm/s2': 1.0},
	'velocity': {'cm/s': 0.01, 'cm/sec': 0.01, 'm/s': 1.0},
}


def peerRecord(name, lines):
	"""(times [s], values (n, 1), 'acceleration' or 'velocity', unit of the values in m/s² or m/s) of a file's lines; None if it is none of these.

	Kind and unit are those of its line "ACCELERATION TIME SERIES IN UNITS OF G"; without one they are that.

	:param name: of the file, for messages
	:raises ValueError: naming *record*: other than NPTS values, displacements, an unknown unit
	"""
	found = [
		(k, match) for k, line in enumerate(lines[:headLines]) for match in [counts.search(line) or countsBefore.search(line)] if match
	]
	if not found:
		return None
	last, match = found[0]
	number, interval = int(match[1]), float(match[2].lower().replace('d', 'e'))
	kind, unit = _kindOf(name, ' '.join(lines[:last]))
	values = []
	for k, line in enumerate(lines[last + 1 :], last + 2):
		try:
			values += [float(word) for word in line.replace(',', ' ').split()]
		except ValueError:
			raise ValueError(
				f'record: {name!r}, line {k}: must have numbers after the line with NPTS and DT, got {line.strip()[:60]!r}'
			) from None
	if len(values) != number:
		raise ValueError(
			f'record: {name!r} has {len(values)} values, and NPTS={number} in line {last + 1}; is it complete? Correct the line if it is'
		)
	return interval * np.arange(number), np.array(values).reshape(-1, 1), kind, unit


def _kindOf(name, head):
	told = re.search(
		r'(ACCELERATION|VELOCITY|DISPLACEMENT)\s+TIME\s+(?:SERIES|HISTORY)(?:\s+IN\s+UNITS?\s+OF\s+(\S+))?', head, re.IGNORECASE
	)
	if told is None:
		return 'acceleration', standardGravity
	kind, unit = told[1].lower(), (told[2] or '').rstrip('.,;').lower()
	if kind not in units:
		raise ValueError(f'record: {name!r} has displacements; take the file of accelerations (.AT2) or velocities (.VT2)')
	unit = unit or ('g' if kind == 'acceleration' else 'cm/s')
	if unit not in units[kind]:
		raise ValueError(
			f'record: {name!r} is in units of {unit!r}, known are {", ".join(units[kind])}; give unit=, and times= with an array of its values'
		)
	return kind, units[kind][unit]
