# SPDX-License-Identifier: GPL-2.0-or-later
"""Libraries of shapes of Rockable (https://github.com/richefeu/rockable), files .shp: sphero-polyhedra, each between ``<`` and ``>``.

A sphero-polyhedron is the sum of a polyhedron and a ball; its faces are those of the polyhedron moved out by the ball's radius. That of a point is a
sphere, that of an edge a rod.
"""

import dataclasses

import numpy as np

from ...arguments import warn
from ..meshes.convexParts import cut
from ..meshes.files import Mesh
from ..ownShapes import withShape
from ..polytopes import fromHalfSpaces, fromVertices, ofOneColour
from ..yadeShapes import sphereOf
from .words import Words, notConvex, warnIfNotConvex

__all__ = ['bodies']

remedy = "Rockable's manual has the format, 'Format of shape-files'"
flat = 1e-9
"""Thickness of a shape's vertices over their extent below which it is a plate."""


class NoBody(ValueError):
	"""Says of a shape why it is no body."""


@dataclasses.dataclass
class Shape:
	line: int
	name: str = ''
	radius: float = 0
	surface: bool = False
	vertices: list = dataclasses.field(default_factory=list)
	faces: list = dataclasses.field(default_factory=list)


def bodies(path, place, names=None, parts=None, rounded=None, **body):
	"""Bodies of all shapes that can be one, or of those with these names.

	:param place: from coordinates of the file to a point [m]
	:param parts: of shapes that are not convex, at most; None: their hulls
	:param rounded: class of bodies with a radius; None: their faces are moved out by it
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
	made, without = [], []
	for name in names or shapes:
		try:
			made.append(_body(path, shapes[name], place, parts, rounded, body))
		except NoBody as reason:
			if names:
				raise words.wrong(f'{reason}; leave it out: names=[…]', shapes[name].line) from None
			without.append(str(reason))
	if not made:
		raise words.wrong(f'there is no shape that is a body: {"; ".join(without)}', shapes[next(iter(shapes))].line)
	if without:
		warn(f"path: left out of '{path}': {'; '.join(without)}")
	return made


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
		elif keyword == 'isSurface':
			shape.surface = True
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


def _body(path, shape, place, parts, rounded, body):
	points = np.array([place(vertex) for vertex in shape.vertices], float).reshape(-1, 3)
	# a length of the file in metres
	radius = shape.radius * float((place((1, 0, 0)) - place((0, 0, 0))).norm())
	if len(points) == 1 and radius > 0:
		return sphereOf(points[0].tolist(), radius, **body)
	if len(points) < 3:
		raise NoBody(f"'{shape.name}' is a {'point' if len(points) == 1 else 'rod' if len(points) == 2 else 'shape without vertices'}")
	extents = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
	if extents[1] <= flat * extents[0]:
		raise NoBody(f"'{shape.name}' is a rod")
	if extents[-1] <= flat * extents[0]:
		return _plate(shape, points, radius, body)
	if shape.surface and shape.faces:
		pieces = ofOneColour(body)
		return [_plate(shape, points[face], radius, pieces) for face in shape.faces]
	core = _hull(shape, points, body)
	where = f"'{shape.name}' (line {shape.line} of '{path}')"
	if parts and notConvex(core, points, shape.faces):
		triangles = np.array([(face[0], *face[k : k + 2]) for face in shape.faces for k in range(1, len(face) - 1)])
		pieces = cut(Mesh(points, triangles, np.zeros(len(triangles), int)), parts).parts
		look = ofOneColour(body)
		return [_withRadius(shape, piece, radius, rounded, look) for piece in pieces]
	warnIfNotConvex(where, core, points, shape.faces, '; parts=… cuts it into convex parts')
	return _withRadius(shape, points, radius, rounded, body)


def _plate(shape, points, radius, body):
	"""Body of points that lie in a plane; it is twice the radius thick."""
	across = np.linalg.svd(points - points.mean(axis=0))[2][-1]
	return _inflated(shape, [*(points + radius * across), *(points - radius * across)], radius, body, across)


def _hull(shape, points, body):
	try:
		return fromVertices(points, **body)
	except ValueError as error:
		if not str(error).startswith('points'):
			raise
		raise NoBody(f"'{shape.name}' is no polyhedron ({error})") from None


def _withRadius(shape, points, radius, rounded, body):
	if rounded is None or radius == 0:
		return _inflated(shape, points, radius, body)
	return withShape(_hull(shape, points, body), rounded(radius=radius))


def _inflated(shape, points, radius, body, across=None):
	"""The hull of the points with its faces moved out by the radius.

	:param across: the normal of the two faces of a plate that are where they should be
	"""
	core = _hull(shape, points, body)
	if radius == 0:
		return core
	normals = np.array([core.state.ori * normal for normal in core.shape.normals], float)
	offsets = np.array(core.shape.offsets, float) + normals @ np.array(core.state.pos, float)
	right = 0 if across is None else abs(normals @ across) > 0.5
	return fromHalfSpaces(normals, offsets + np.where(right, 0, radius), **body)
