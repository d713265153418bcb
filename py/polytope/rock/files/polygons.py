# SPDX-License-Identifier: GPL-2.0-or-later
"""Polygons of dfnWorks: a polygon a line, the number of its corners and {x, y, z} of each."""

import re

__all__ = ['joints']


def joints(rows):
	words = re.split(r'[:\s]+', rows.lines[0].strip()) if rows.lines else []
	if len(words) < 2 or words[0].lower() != 'npolygons':
		raise rows.wrong(1, "the first line must be 'nPolygons:' and their number", 'take dfnWorks\' polygons.dat')
	number, found = rows.whole(1, words[1], 'the number of polygons'), []
	for line, text in enumerate(rows.lines, 1):
		if line == 1 or not text:
			continue
		corners = [[word for word in re.split(r'[,\s]+', point) if word] for point in re.findall(r'\{([^{}]*)\}', text)]
		told = rows.whole(line, text.split('{')[0].strip(), 'the number of corners')
		if told != len(corners):
			raise rows.wrong(line, f'{told} corners are told, {len(corners)} are there', 'correct the line')
		found.append(rows.polygon(line, [rows.point(line, corner) for corner in corners]))
	if len(found) != number:
		raise rows.wrong(1, f'{number} polygons are told, {len(found)} are there', 'is the file complete?')
	return found
