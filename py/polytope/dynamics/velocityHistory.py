# SPDX-License-Identifier: GPL-2.0-or-later
"""A velocity over time from a record of velocity or acceleration: `polytope.velocityHistory(…)`."""

import os

import numpy as np
from scipy.integrate import cumulative_trapezoid
from yade import O, Vector3, VelocityHistory

from ..arguments import flag, namedArguments, number, vector, warn
from ..precision import real
from .peer import peerRecord

__all__ = ['velocityHistory']

kinds = ('velocity', 'acceleration')
strongest = 50.0
"""Acceleration [m/s²] above which a record is taken for one in another unit: the strongest records of earthquakes have some 4 g."""


@namedArguments
def velocityHistory(record, times=None, kind=None, unit=None, direction=None, baseline=True, start=None):
	"""The velocity over time that a record tells, for *baseMotion* and *quietBoundary*::

		quake = polytope.velocityHistory('record.txt', unit=9.81)                                     # time [s], acceleration [g]
		pulse = polytope.velocityHistory([0, 1, 0], times=[0, 0.1, 0.2], kind='velocity')             # [m/s]
		north = polytope.velocityHistory('RSN6_180.AT2', direction=(0, 1, 0))                         # PEER's; the file tells interval and unit

	The record is linear between its instants. An acceleration is integrated by the trapezoidal rule, from rest. Records do not end at rest, as their
	zero is not exact: the baseline correction takes away the straight line from the first velocity to the last one, as one constant
	acceleration would give it.

	:param record: name of a text file, or values: n numbers, or n rows of three, the components along x, y, z. A file has a column of times
	    [s] and one of values, or three; lines that begin with # are left out, and columns are separated by blanks or commas. Or it is a
	    file of the PEER database (.AT2, .VT2), with NPTS and DT at its head
	:param times: n instants [s], or the interval between them; not for a file
	:param str kind: 'acceleration', the default, or 'velocity'; of a PEER file what it says itself
	:param float unit: of the values, in m/s² or m/s: 9.81 for a record in g, 0.01 for one in cm; default 1, of a PEER file what it says itself
	:param direction: of a record with one component, of any length but zero; default along x
	:param bool baseline: whether the baseline is corrected
	:param float start: O.time [s] at which the record begins; default: now
	:returns: *VelocityHistory*, with *times* [s] from *start* on, and *velocities* [m/s]; before it the velocity is zero, after it the last
	    one goes on
	:raises ValueError: naming the argument: times that do not increase, values that are not finite, too few or too many columns, a
	    direction for three of them; of a file with the line
	:raises FileNotFoundError: if there is no such file
	"""
	if kind is not None and kind not in kinds:
		raise ValueError(f'kind: must be one of {kinds}, got {kind!r}')
	baseline = flag(baseline, 'baseline')
	if unit is not None and not 0 < abs(number(unit, 'unit')) < np.inf:
		raise ValueError(f'unit: must be finite and not zero, got {unit!r}')
	start = O.time if start is None else number(start, 'start')
	if isinstance(record, (str, os.PathLike)):
		times, values, kind, itsUnit = _fromFile(record, times, kind)
	else:
		(times, values), itsUnit = _fromValues(record, times), 1.0
	velocities = float(itsUnit if unit is None else unit) * _components(values, direction)
	if kind != 'velocity':
		_tellStrong(velocities)
		velocities = cumulative_trapezoid(velocities, times, axis=0, initial=0)
	if baseline:
		part = (times - times[0]) / (times[-1] - times[0])
		velocities = velocities - (velocities[0] + np.outer(part, velocities[-1] - velocities[0]))
	instants = float(start) + times - times[0]
	return VelocityHistory(times=[real(t) for t in instants], velocities=[Vector3(*map(real, v)) for v in velocities.tolist()])


def _tellStrong(accelerations):
	most = float(np.linalg.norm(accelerations, axis=1).max())
	if most > strongest:
		warn(
			f'record: its largest acceleration is {most:.3g} m/s², {most / 9.81:.3g} g, more than earthquakes have; is it in m/s² already (unit=1), in cm/s² (unit=0.01), or a velocity (kind)?'
		)


def _fromFile(name, times, kind):
	"""(times, values, kind, unit)"""
	if times is not None:
		raise ValueError('times: the file has them in its first column')
	if not os.path.isfile(name):
		raise FileNotFoundError(f'record: there is no file {os.fspath(name)!r}; its place is relative to {os.getcwd()!r}')
	lines = _linesOf(os.fspath(name))
	peer = peerRecord(os.fspath(name), lines)
	if peer is None:
		table = _table(os.fspath(name), lines)
		return *_checked(table[:, 0], table[:, 1:], 'record'), kind, 1.0
	times, values, itsKind, unit = peer
	if kind not in (None, itsKind):
		raise ValueError(f'kind: {os.fspath(name)!r} says that it is of {itsKind}, got {kind!r}; leave it out')
	return *_checked(times, values, 'record'), itsKind, unit


def _linesOf(name):
	try:
		with open(name, encoding='utf-8-sig') as file:
			return list(file)
	except UnicodeDecodeError:
		raise ValueError(f'record: {name!r} is no text; must have columns of numbers, time and one or three values') from None


def _table(name, lines):
	"""Rows of two or four numbers."""
	split = [(number, line.split('#')[0].replace(',', ' ').split()) for number, line in enumerate(lines, 1)]
	rows = [(number, words) for number, words in split if words]
	if not rows:
		raise ValueError(f'record: {name!r} has no numbers')
	columns = len(rows[0][1])
	values = []
	for line, words in rows:
		try:
			values.append([float(word) for word in words])
		except ValueError:
			hint = (
				'put # before lines of words'
				if not values
				else 'columns are separated by blanks or commas, and decimals begin with a point'
			)
			raise ValueError(f'record: {name!r}, line {line}: must have numbers, got {' '.join(words)[:60]!r}; {hint}') from None
		if len(words) != columns:
			raise ValueError(f'record: {name!r}, line {line}: has {len(words)} columns, the lines before have {columns}')
	if columns not in (2, 4):
		raise ValueError(
			f'record: {name!r} has {columns} columns; must be time and one value, or time and three. Values without times, several in a line, are read by '
			f'velocityHistory(numpy.array(open(…).read().split(), float), times=interval), without the lines at its head'
		)
	return np.array(values)


def _fromValues(record, times):
	if times is None:
		raise ValueError('times: needed with values: as many instants, or the interval between them [s]')
	try:
		values = np.array(record, float)
	except (TypeError, ValueError):
		raise ValueError('record: must be the name of a file, n numbers, or n rows of three') from None
	values = values.reshape(-1, 1) if values.ndim == 1 else values
	if values.ndim != 2 or values.shape[1] not in (1, 3):
		raise ValueError(f'record: must be n numbers, or n rows of three, got an array of shape {np.shape(record)}')
	try:
		instants = np.array(times, float)
	except (TypeError, ValueError):
		raise ValueError('times: must be a sequence of numbers, or one number') from None
	if instants.ndim == 0:
		instants = instants * np.arange(len(values))
	if instants.shape != (len(values),):
		raise ValueError(f'times: must be as many as there are values, {len(values)}, got {instants.size}')
	return _checked(instants, values, 'times')


def _checked(times, values, name):
	"""*name*: that of the argument with the times."""
	if len(times) < 2:
		raise ValueError(f'record: must have two instants at least, got {len(times)}')
	for where, column in ((name, times), ('record', values)):
		bad = np.flatnonzero(~np.isfinite(column.reshape(len(times), -1)).all(axis=1))
		if len(bad):
			raise ValueError(f'{where}: must be finite, and is not in row {bad[0]} (from 0 on); fill the gap or leave the row out')
	back = np.flatnonzero(np.diff(times) <= 0)
	if len(back):
		k = back[0]
		raise ValueError(f'{name}: times must increase; that of row {k + 1} (from 0 on) is {times[k + 1]:g} s, after {times[k]:g} s')
	return times, values


def _components(values, direction):
	if values.shape[1] == 3:
		if direction is not None:
			raise ValueError('direction: the record has three columns, the components along x, y and z; leave it out')
		return values
	direction = (1, 0, 0) if direction is None else direction
	along = np.array([float(x) for x in vector(direction, 'direction')])
	if not np.linalg.norm(along) > 0:
		raise ValueError('direction: must not be zero')
	return np.outer(values[:, 0], along / np.linalg.norm(along))
