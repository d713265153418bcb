# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints as tables: a joint a line, with named columns, or with those of YADE's BlockGen."""

import csv
import math

import numpy as np

from ...arguments import warn
from ..joint import Joint, anglesOf
from ..jointSets import JointSet

__all__ = ['blockGen', 'isBlockGens', 'isTable', 'joints', 'needed']

needed = ('dip', 'dip_direction', 'x', 'y', 'z')
names = {
	**{name: name for name in (*needed, 'radius', 'diameter', 'set')},
	**dict.fromkeys(('dipdirection', 'dip_dir', 'dipdir', 'dd'), 'dip_direction'),
	**{f'{word}_{axis}': axis for word in ('position', 'centre', 'center') for axis in 'xyz'},
}
"""Names of columns, in small letters with underscores."""
turnRounding = 1e-3
"""Rounding of angles that have three digits or more [°]."""
ofPlanes, ofRectangles = 11, 16
"""BlockGen's columns; those of rectangles end with a comment."""


def separatorOf(line):
	return next((one for one in ';\t' if one in line), ',')


def columnsOf(line):
	"""{column: place}"""
	return {names[word]: place for place, word in enumerate(_words(line)) if word in names}


def _words(line):
	return [word.strip().strip('"').lower().replace('-', '_').replace(' ', '_') for word in line.split(separatorOf(line))]


def _twice(line):
	"""A column of which there are several, such as *radius*, or *dip_direction* as *dd*, too; else None."""
	words = [names[word] for word in _words(line) if word in names]
	return next((word for word in words if words.count(word) > 1), None)


def isTable(line):
	return set(needed) <= set(columnsOf(line))


def isBlockGens(lines):
	"""Whether they have BlockGen's number of fields, and no radius, which BlockGen does not know."""
	fields = [len(line.rstrip(';').split(';')) for line in [line for line in lines if line][1:]]
	size = {'radius', 'diameter'} & set(columnsOf(next(filter(None, lines), '')))
	return not size and bool(fields) and fields[0] >= ofPlanes


def joints(rows):
	heading = rows.lines[rows.first] if rows.lines else ''
	columns = columnsOf(heading)
	missing = [name for name in needed if name not in columns]
	if missing:
		raise rows.wrong(rows.first + 1, f'there is no column {", ".join(missing)}', f'name the columns: {", ".join(needed)}, radius')
	separator = separatorOf(heading)
	twice = _twice(heading)
	if twice:
		raise rows.wrong(rows.first + 1, f'several columns are the {twice}', 'leave all but one out, or name the others otherwise')
	found = []
	for line, fields in enumerate(csv.reader(rows.lines, delimiter=separator), 1):
		if line <= rows.first + 1 or not any(field.strip() for field in fields):
			continue
		if separator == ',' and any(fields[len(_words(heading)) :]):
			raise rows.wrong(
				line,
				f'{len(fields)} fields, {len(_words(heading))} columns',
				'are there decimal commas? Write decimal points, or separate columns by semicolons or tabs',
			)
		if len(fields) <= max(columns.values()):
			raise rows.wrong(line, f'{len(fields)} fields, {max(columns.values()) + 1} or more are expected', 'complete the line')
		found.append(_joint(rows, line, {name: fields[place].strip() for name, place in columns.items()}))
	_tellRadians(rows, found)
	return found


def _tellRadians(rows, joints):
	"""Degrees are whole numbers mostly, and seldom all within the numbers that radians have."""
	angles = np.degrees([(joint.dip, joint.dipDirection) for joint in joints]).reshape(-1, 2)
	within = (angles[:, 0] <= math.pi / 2 + turnRounding).all() and (np.abs(angles[:, 1]) <= 2 * math.pi + turnRounding).all()
	if within and len(angles) and (np.abs(angles - np.round(angles)) > turnRounding).any():
		warn(
			f"path: '{rows.path}': no dip is above {angles[:, 0].max():.3g}°, no dip direction above {np.abs(angles[:, 1]).max():.3g}°; if they are in radians, write degrees"
		)


def _joint(rows, line, fields):
	dip, direction, *centre = (rows.number(line, fields[name], name) for name in needed)
	_degrees(rows, line, dip, direction)
	radius = None
	for name, half in (('radius', 1), ('diameter', 0.5)):
		if fields.get(name):
			radius = half * rows.scale * rows.number(line, fields[name], name)
	number = _set(rows, line, fields.get('set') or '0')
	place = tuple(rows.scale * x for x in centre)
	return rows.checked(line, lambda: Joint(math.radians(dip), math.radians(direction), place, radius, number))


def _set(rows, line, text):
	"""A whole number, or a name."""
	try:
		float(text)
	except ValueError:
		return text
	return rows.whole(line, text, 'set')


def blockGen(rows):
	found = []
	for line, text in enumerate(rows.lines, 1):
		fields = [field.strip() for field in text.rstrip(';').split(';')]
		if line <= rows.first + 1 or not text:
			continue
		if len(fields) not in (ofPlanes, ofRectangles, ofRectangles + 1):
			remedy = f'BlockGen has {ofPlanes} for persistent planes, {ofRectangles} or one more for joints of finite size'
			raise rows.wrong(line, f'{len(fields)} fields separated by semicolons', remedy)
		dip, direction = (rows.number(line, fields[k], name) for k, name in ((0, 'dip'), (1, 'dip direction')))
		_degrees(rows, line, dip, direction)
		normal, strike = _normal(math.radians(dip), math.radians(direction))
		if len(fields) == ofPlanes:
			spacing = rows.scale * rows.number(line, fields[2], 'spacing')
			found.append(rows.checked(line, lambda normal=normal, spacing=spacing: JointSet(*anglesOf(normal), spacing, through=(0, 0, 0))))
			continue
		centre = np.array(rows.point(line, fields[2:5]))
		along, down = (rows.scale * rows.number(line, fields[k], 'a half-length') for k in (5, 6))
		first, second = along * strike, down * np.cross(normal, strike)
		corners = [centre + i * first + j * second for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
		found.append(rows.polygon(line, corners))
	return found


def _normal(dip, direction):
	"""Normal and strike in BlockGen's axes, x north, y east, z down."""
	normal = np.array([-math.sin(dip) * math.cos(direction), -math.sin(dip) * math.sin(direction), math.cos(dip)])
	return normal, np.array([math.sin(direction), -math.cos(direction), 0.0])


def _degrees(rows, line, dip, direction):
	if not 0 <= dip <= 90:
		raise rows.wrong(line, f'dip must be from 0 to 90 degrees, got {dip:g}', 'turn the dip direction by 180 for an overturned joint')
	if not abs(direction) <= 360:
		raise rows.wrong(line, f'dip direction must be an azimuth in degrees, got {direction:g}', 'correct it')
