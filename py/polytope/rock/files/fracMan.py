# SPDX-License-Identifier: GPL-2.0-or-later
"""Polygons of FracMan's text format (.fab).

BEGIN FRACTURE … END FRACTURE: for each fracture a line with its number, its number of corners, its set and properties; a line for each
corner, its number, x, y, z; and a line with 0 and the normal. BEGIN TESSFRACTURE … END TESSFRACTURE: a line with number, number of nodes, number of
triangles and set; a line for each node, its number, x, y, z; a line for each triangle, its number and three nodes.
"""

__all__ = ['joints']

tessellated = {'TESSFRACTURE': True, 'FRACTURE': False}


def joints(rows):
	found, lines = [], iter(enumerate(rows.lines, 1))
	for _, text in lines:
		words = text.upper().split()
		if words[:1] == ['BEGIN'] and words[1:2] and words[1] in tessellated:
			_section(rows, lines, words[1], found)
	return found


def _section(rows, lines, name, found):
	for line, text in lines:
		words = text.split()
		if not words:
			continue
		if words[0].upper() == 'END':
			return
		if len(words) < 3 + tessellated[name]:
			expected = 'number, nodes, triangles, set' if tessellated[name] else 'number, corners, set'
			raise rows.wrong(line, f'a fracture begins with {expected}, got {text!r}', 'export it from FracMan anew')
		corners = rows.whole(line, words[1], 'the number of corners')
		points = [_fields(rows, lines, 'a corner')[1] for _ in range(corners)]
		if tessellated[name]:
			number = rows.whole(line, words[3], 'the set')
			for _ in range(rows.whole(line, words[2], 'the number of triangles')):
				_triangle(rows, lines, points, number, found)
		else:
			_next(rows, lines, 'the normal')
			found.append(rows.polygon(line, points, rows.whole(line, words[2], 'the set')))
	raise rows.wrong(len(rows.lines), f'the file ends within the section {name}', f'is it complete? END {name} is missing')


def _triangle(rows, lines, points, number, found):
	line, words = _next(rows, lines, 'a triangle')
	if len(words) < 4:
		raise rows.wrong(line, f'a triangle has a number and three nodes, got {" ".join(words)!r}', 'export it from FracMan anew')
	nodes = [rows.whole(line, word, 'a node') for word in words[1:4]]
	if not all(1 <= node <= len(points) for node in nodes):
		raise rows.wrong(line, f'a triangle names a node that is not there: {nodes}', 'export it from FracMan anew')
	found.append(rows.polygon(line, [points[node - 1] for node in nodes], number))


def _fields(rows, lines, what):
	line, words = _next(rows, lines, what)
	return line, rows.point(line, words[1:4])


def _next(rows, lines, what):
	for line, text in lines:
		if text:
			return line, text.split()
	raise rows.wrong(len(rows.lines), f'the file ends where {what} is expected', 'is it complete?')
