# SPDX-License-Identifier: GPL-2.0-or-later
"""Libraries of shapes of Rockable (https://github.com/richefeu/rockable), files .shp: sphero-polyhedra, each between ``<`` and ``>``.

A sphero-polyhedron is the sum of a polyhedron and a ball; its faces are those of the polyhedron moved out by the ball's radius.
"""

import dataclasses

import numpy as np

from ..bodies import fromHalfSpaces, fromVertices
from .words import Words, warnIfNotConvex

__all__ = ['bodies']

remedy = "Rockable's manual has the format, 'Format of shape-files'"
flat = 1e-9
"""Thickness of a shape's vertices over their extent below which it is a plate."""


@dataclasses.dataclass
class Shape:
	line: int
	name: str = ''
	radius: float = 0
	vertices: list = dataclasses.field(default_factory=list)
	faces: list = dataclasses.field(default_factory=list)


def bodies(path, place, names=None, **body):
	"""Of all shapes, or of those with these names.

	:param place: from coordinates of the file to a point [m]
	"""
	words, shapes = Words(path, remedy), {}
	while words.present:
		shape = _shape(words)
		shapes[shape.name] = shape
	if not shapes:
		raise words.wrong('there is no shape')
	for name in names or ():
		if name not in shapes:
			raise ValueError(f"names: '{path}' has no shape {name!r}; it has {', '.join(shapes)}")
	return [_body(words, shapes[name], place, body) for name in names or shapes]


def _shape(words):
	shape = Shape(words.line)
	if words.word('a shape') != '<':
		raise words.wrong("a shape begins with '<'", shape.line)
	while (keyword := words.word("'>'")) != '>':
		if keyword == 'name':
			shape.name = words.word('a name')
		elif keyword == 'radius':
			line, shape.radius = words.line, words.real('the radius')
			if shape.radius < 0:
				raise words.wrong(f'the radius must be at least 0, got {shape.radius}', line)
		elif keyword == 'nv':
			shape.vertices = [words.point('a vertex') for _ in range(words.whole('the number of vertices', least=1))]
		elif keyword == 'nf':
			shape.faces = [_face(words, len(shape.vertices)) for _ in range(words.whole('the number of faces', least=0))]
		elif keyword == '<':
			raise words.wrong(f"a shape begins before that of line {shape.line} ends with '>'")
		# all others, edges among them, are computed from these
	if not shape.name:
		raise words.wrong('this shape has no name', shape.line)
	return shape


def _face(words, vertices):
	corners = words.whole("the number of a face's vertices", least=3)
	return [words.whole('the number of a vertex', least=0, most=vertices - 1) for _ in range(corners)]


def _body(words, shape, place, body):
	points = np.array([place(vertex) for vertex in shape.vertices], float)
	# a length of the file in metres
	radius = shape.radius * float((place((1, 0, 0)) - place((0, 0, 0))).norm())
	if len(points) < 3:
		raise words.wrong(f"'{shape.name}' is a sphere or a rod, no polyhedron; leave it out: names=[…]", shape.line)
	extents, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[1:]
	thin = extents[-1] <= flat * extents[0]
	across = axes[-1] * (radius if thin else 0)
	try:
		core = fromVertices([*(points + across), *(points - across)] if thin else points, **body)
	except ValueError as error:
		if not str(error).startswith('points'):
			raise
		raise words.wrong(f"'{shape.name}' is no polyhedron ({error}); leave it out: names=[…]", shape.line) from None
	if not thin:
		warnIfNotConvex(f"'{shape.name}' (line {shape.line} of '{words.path}')", core, points, shape.faces)
	if radius == 0:
		return core
	normals = np.array([core.state.ori * normal for normal in core.shape.normals], float)
	offsets = np.array(core.shape.offsets, float) + normals @ np.array(core.state.pos, float)
	faces = thin & (abs(normals @ axes[-1]) > 0.5)  # a plate's two faces are where they should be
	return fromHalfSpaces(normals, offsets + np.where(faces, 0, radius), **body)
