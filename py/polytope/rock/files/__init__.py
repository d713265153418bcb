# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints from text files: tables of discs, the files of YADE's BlockGen, polygons of FracMan and dfnWorks."""

from ...arguments import namedArguments, pathOfFile, positive
from . import fracMan, polygons, tables
from .rows import Rows

__all__ = ['readJoints']

readers = {'table': tables.joints, 'blockGen': tables.blockGen, 'fracMan': fracMan.joints, 'dfnWorks': polygons.joints}


@namedArguments
def readJoints(path, format=None, scale=1):
	"""Joints of a text file, for jointedRock: ``polytope.jointedRock(normals, offsets, polytope.readJoints('joints.csv'))``.

	- ``'table'``: a first line with the names of columns, then a joint a line, separated by commas, semicolons or tabs. Columns *dip*,
	  *dip_direction* [degrees], *x*, *y*, *z* [m]: x east, y north, z up; *radius* or *diameter* [m]: without it, or where it is empty, a
	  plane through the whole rock; *set*, a whole number or a name. Others are not read.
	- ``'blockGen'``: what YADE's BlockGen reads, separated by semicolons after a first line that is passed over. Of 16 or 17 columns
	  (*filenameProbabilistic*) rectangles: dip, dip direction, centre, half-lengths along strike and along dip; of 11
	  (*filenamePersistentPlanes*) sets of planes through the origin: dip, dip direction, spacing. Planes are where BlockGen puts them, in
	  its axes: x north, y east, z down. Properties are not read.
	- ``'fracMan'``: polygons of FracMan's ``.fab`` text, with their set. Tessellated fractures give one joint for each triangle.
	- ``'dfnWorks'``: polygons of dfnWorks (``polygons.dat``: ``nPolygons: …``, then a polygon a line: number of corners, {x, y, z} …).

	Lines that begin with # are passed over. A table whose angles could all be radians is read as degrees, with a warning.

	:param path: the file
	:param str format: one of these names; default by the file's end and first line
	:param float scale: factor on all lengths, for files in other units than metres
	:returns: list of *Joint*, in the order of the file; of *JointSet* for BlockGen's persistent planes
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: naming the argument, and for a malformed file the line, what is expected there and what to do
	"""
	path = pathOfFile(path, 'path')
	if format is not None and format not in readers:
		raise ValueError(f'format: must be one of {", ".join(readers)}, got {format!r}')
	factor = positive(scale, 'scale')
	rows = Rows(path, factor)
	found = readers[format or _formatOf(rows)](rows)
	if not found:
		raise ValueError(f"path: '{path}' has no joints; is it a file of another format? format= names it")
	return found


def _formatOf(rows):
	first = rows.lines[rows.first].lower() if rows.lines else ''
	if rows.path.lower().endswith('.fab') or first.startswith('begin format'):
		return 'fracMan'
	if first.startswith('npolygons'):
		return 'dfnWorks'
	if tables.isBlockGens(rows.lines):
		return 'blockGen'
	if tables.isTable(first):
		return 'table'
	columns = ', '.join(tables.needed)
	raise rows.wrong(
		rows.first + 1, f'no columns named {columns}, and no beginning of another format', 'name the columns there, or give format='
	)
