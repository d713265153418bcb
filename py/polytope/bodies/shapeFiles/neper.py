# SPDX-License-Identifier: GPL-2.0-or-later
"""Tessellations of Neper (https://neper.info), files .tess of its format 2 and later.

Sections begin with words ``**name``. A face has an equation a x + b y + c z = d, one for both cells beside it: cells share faces exactly.
"""

from yade import Vector3

from ..polytopes import fromHalfSpaces, polygon
from .words import Words

__all__ = ['bodies']

cut = "mesh such a tessellation (neper -M, format msh) and read that file with polytope.fromMesh(…, parts='objects'), which makes the hull of each cell"
remedy = "write the tessellation anew with neper -T, format tess; Neper's manual has the format"
fits = 1e-6
"""Distance of a vertex from its face's plane, over the cell's size: Neper writes 12 decimals. Regularization bends faces by more."""


def bodies(path, place, **body):
	"""Bodies of all cells.

	:param place: from coordinates of the file to a point [m]
	"""
	words = Words(path, remedy)
	if words.present != '***tess':
		raise words.wrong(f"a tessellation begins with '***tess', but {words.present!r} is there")
	dimension, sections = None, {}
	while words.present != '***end':
		section = words.word("'***end'")
		if section == '**general':
			dimension = words.whole('the dimension', least=1, most=3)
		elif section == '**vertex':
			sections['vertex'] = _vertices(words, place)
		elif section == '**face':
			sections['face'] = _faces(words, sections.get('vertex', {}))
		elif section == '**polyhedron':
			sections['polyhedron'] = _cells(words, sections.get('face', {}))
	needed = {2: ('vertex', 'face'), 3: ('vertex', 'face', 'polyhedron')}.get(dimension)
	if needed is None:
		raise words.wrong(f'tessellations of dimension 2 and 3 have bodies, this one has dimension {dimension}')
	for name in needed:
		if name not in sections:
			raise words.wrong(f'the section **{name} is missing')
	if dimension == 2:
		made = [_flat(words, face, sections['vertex'], body) for face in sections['face'].values() if face[1]]
	else:
		made = [_solid(words, cell, sections, body) for cell in sections['polyhedron']]
	if not made:
		raise words.wrong('all cells are empty')
	return made


def _vertices(words, place):
	"""Number → point."""
	points = {}
	for _ in range(words.whole('the number of vertices', least=1)):
		number = words.whole('the number of a vertex', least=1)
		points[number] = place(words.point('a vertex'))
		words.whole("a vertex's state")
	return points


def _faces(words, points):
	"""Number → (line, numbers of vertices, normal). One of an empty cell has no vertices."""
	faces = {}
	for _ in range(words.whole('the number of faces', least=1)):
		line, number = words.line, words.whole('the number of a face', least=1)
		corners = _numbers(words, 'vertices', points, 'vertex', 3, signed=False)
		_numbers(words, 'edges', None, 'edge', 0)
		_, *normal = (words.real("a parameter of a face's equation") for _ in range(4))
		for what in ('state', 'point'):
			words.whole(f"a face's {what}")
		words.point("a face's point")
		faces[number] = (line, corners, Vector3(*normal))
	return faces


def _cells(words, faces):
	"""(line, signed numbers of faces) of each that is not empty."""
	cells = []
	for _ in range(words.whole('the number of polyhedra', least=1)):
		line = words.line
		words.whole('the number of a polyhedron', least=1)
		numbers = _numbers(words, 'faces', faces, 'face', 4)
		if numbers:
			cells.append((line, numbers))
		for number in numbers:
			if not faces[abs(number)][1]:
				raise words.wrong(f'face {abs(number)} has no vertices', line)
	return cells


def _numbers(words, what, known, name, least, signed=True):
	"""A list that begins with its length, which is 0 for an empty cell.

	:param known: what the numbers name; None: they are not looked up
	:param bool signed: a number may be negative: the face is seen from its other side
	"""
	numbers, line = [], words.line
	count = words.whole(f'a number of {what}', least=0)
	if 0 < count < least:
		raise words.wrong(f'a number of {what} must be 0 or at least {least}, got {count}', line)
	for _ in range(count):
		line = words.line
		numbers.append(words.whole(f'the number of a {name}'))
		found = abs(numbers[-1]) if signed else numbers[-1]
		if known is not None and found not in known:
			raise words.wrong(f'there is no {name} {found}', line)
	return numbers


def _solid(words, cell, sections, body):
	line, faces = cell
	points, normals, offsets = sections['vertex'], [], []
	corners = {k for number in faces for k in sections['face'][abs(number)][1]}
	size = max((points[k] - points[j]).norm() for j in list(corners)[:1] for k in corners)
	for number in faces:
		where, own, normal = sections['face'][abs(number)]
		# the offset from the vertices, whose places may be scaled and shifted; the same for both cells beside the face
		heights = [normal.dot(points[k]) for k in own]
		offset, sign = sum(heights) / len(heights), 1 if number > 0 else -1
		beyond = max(sign * (normal.dot(points[k]) - offset) for k in corners)
		if beyond > fits * size or max(heights) - min(heights) > fits * size:
			seen = 'a cell is not convex: vertices lie beyond the plane of this face, which regularization or -transform cut has bent'
			raise words.wrong(f'{seen}; tessellate without them, or {cut}', where)
		normals.append(sign * normal)
		offsets.append(sign * offset)
	try:
		return fromHalfSpaces(normals, offsets, **body)
	except ValueError as error:
		if not str(error).startswith(('normals', 'offsets')):
			raise
		raise words.wrong(f'the faces of this cell make no body ({error})', line) from None


def _flat(words, face, points, body):
	line, corners, _ = face
	try:
		return polygon([tuple(points[k])[:2] for k in corners], **body)
	except ValueError as error:
		if not str(error).startswith('points2d'):
			raise
		raise words.wrong(
			f'the vertices of this cell make no polygon ({error}); cells that regularization or -transform cut has bent are not convex: tessellate without them',
			line,
		) from None
