# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's text format for polyhedra, as its export.textPolyhedra writes and ymport.textPolyhedra reads it.

Each polyhedron: a line "number vertices faces", a line for each vertex with its coordinates, one for each face with its vertices, from 0.
"""

import os

from ..polytopes import fromVertices
from .words import Words, warnIfNotConvex

__all__ = ['bodies', 'write']

remedy = 'a polyhedron is a line "number vertices faces", a line "x y z" for each vertex, a line of vertex numbers from 0 for each face'
head = f"""# Polyhedra: {remedy}.
"""


def bodies(path, place, **body):
	"""Bodies of all polyhedra of a file.

	:param place: from coordinates of the file to a point [m]
	"""
	words, made = Words(path, remedy), []
	while words.present:
		start = words.line
		name = f"polyhedron {words.whole('the number of a polyhedron')} (line {start} of '{path}')"
		vertices = words.whole('the number of vertices', least=4)
		faces = words.whole('the number of faces', least=0)
		words.endLine()
		points = [place(words.point('a vertex')) for _ in range(vertices)]
		corners = [_face(words, vertices) for _ in range(faces)]
		try:
			made.append(fromVertices(points, **body))
		except ValueError as error:
			if not str(error).startswith('points'):
				raise
			raise words.wrong(f'the vertices of {name} make no body ({error})', start) from None
		warnIfNotConvex(name, made[-1], points, corners)
	if not made:
		raise words.wrong('there is no polyhedron')
	return made


def _face(words, vertices):
	"""Vertex numbers on one line."""
	line, corners = words.line, []
	while words.present and words.line == line:
		corners.append(words.whole('the number of a vertex', least=0, most=vertices - 1))
	if len(corners) < 3:
		raise words.wrong(f'a face has at least three vertices, got {len(corners)}', line)
	return corners


def write(path, polyhedra):
	folder = os.path.dirname(os.path.abspath(path))
	os.makedirs(folder, exist_ok=True)
	with open(path, 'w', encoding='utf-8') as file:
		file.write(head)
		for body in polyhedra:
			shape, state = body.shape, body.state
			faces = [face for face in shape.faces if len(face) > 2]  # redundant planes own none
			file.write(f'{body.id} {len(shape.vertices)} {len(faces)}\n')
			for vertex in shape.vertices:
				file.write(' '.join(repr(float(x)) for x in state.pos + state.ori * vertex) + '\n')
			file.writelines(' '.join(map(str, face)) + '\n' for face in faces)
	return len(polyhedra)
