# SPDX-License-Identifier: GPL-2.0-or-later
"""Faces of bodies as arrays, for pictures."""

import numpy as np
from yade import Box, Facet, O, Polytope, Sphere, Wall

__all__ = ['collect', 'localVertices', 'reachOfWalls', 'worldVertices']


def collect(bodies, colorOf=lambda body: body.shape.color, styleOf=lambda body: 'solid'):
	"""The bodies' faces in world coordinates, as arrays.

	:param colorOf: function of a body: RGB in 0…1
	:param styleOf: function of a body: any word; bodies of the same word come together, 'hidden' ones not at all
	:returns: dictionary style → {points (n, 3), offsets (faces + 1), connectivity, colors (faces, 3) bytes, ids (faces)};
	    spheres are of the style 'smooth'
	"""
	parts, room = {}, reachOfWalls(bodies)
	for body in bodies:
		style = styleOf(body)
		if style == 'hidden':
			continue
		vertices, faces = _localFaces(body.shape) if not isinstance(body.shape, Wall) else _wallFaces(body, room)
		if len(faces) == 0:
			continue
		if isinstance(body.shape, Sphere):
			style = 'smooth'
		turn = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
		position = O.cell.wrap(body.state.pos) if O.periodic else body.state.pos
		color = np.round(255 * np.clip(np.array(colorOf(body), float), 0, 1)).astype(np.uint8)
		parts.setdefault(style, []).append((vertices @ turn.T + np.array(position, float), faces, color, body.id))
	return {style: _joined(several) for style, several in parts.items()}


def _joined(parts):
	first = np.cumsum([0] + [len(points) for points, *_ in parts[:-1]])
	faces = [[shift + v for v in face] for (_, bodyFaces, *_), shift in zip(parts, first, strict=True) for face in bodyFaces]
	counts = [len(bodyFaces) for _, bodyFaces, *_ in parts]
	return {
		'points': np.concatenate([points for points, *_ in parts]),
		'offsets': np.cumsum([0] + [len(face) for face in faces]),
		'connectivity': np.concatenate(faces),
		'colors': np.repeat([color for _, _, color, _ in parts], counts, axis=0),
		'ids': np.repeat([number for *_, number in parts], counts),
	}


def _localFaces(shape):
	if isinstance(shape, Polytope):
		return np.array(shape.vertices, float).reshape(-1, 3), shape.faces
	if isinstance(shape, Box):
		signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
		faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
		return signs * np.array(shape.extents, float), faces
	if isinstance(shape, Facet):
		return np.array(shape.vertices, float), [(0, 1, 2)]
	if isinstance(shape, Sphere):
		return _sphereFaces(shape.radius)
	return np.empty((0, 3)), []


def reachOfWalls(bodies):
	"""Opposite corners of the box about all bodies but walls, with the walls' places in it; None if there is no wall, or nothing else."""
	walls = [body for body in bodies if isinstance(body.shape, Wall)]
	others = [worldVertices(body) for body in bodies if not isinstance(body.shape, Wall)] if walls else []
	points = np.concatenate([*others, np.empty((0, 3))])
	if not len(points):
		return None
	low, high = points.min(axis=0), points.max(axis=0)
	for body in walls:
		axis, place = body.shape.axis, float(body.state.pos[body.shape.axis])
		low[axis], high[axis] = min(low[axis], place), max(high[axis], place)
	return low, high


def worldVertices(body, room=None):
	"""Vertices in world coordinates; of a wall those of its rectangle across the *room*, none without it."""
	if isinstance(body.shape, Wall):
		return _wallFaces(body, room)[0] + np.array(body.state.pos, float)
	turn = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
	position = O.cell.wrap(body.state.pos) if O.periodic else body.state.pos
	return _localFaces(body.shape)[0] @ turn.T + np.array(position, float)


def _wallFaces(body, room):
	"""A rectangle across the room, relative to the wall's position."""
	if room is None:
		return np.empty((0, 3)), []
	axis = body.shape.axis
	first, second = (axis + 1) % 3, (axis + 2) % 3
	corners = np.zeros((4, 3))
	corners[:, axis] = float(body.state.pos[axis])
	corners[:, first] = [room[k][first] for k in (0, 1, 1, 0)]
	corners[:, second] = [room[k][second] for k in (0, 0, 1, 1)]
	return corners - np.array(body.state.pos, float), [(0, 1, 2, 3)]


def _sphereFaces(radius, rings=24):
	"""Quadrilaterals between circles of latitude; triangles at the poles would make no visible difference."""
	around = 2 * rings
	latitude, longitude = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, around, endpoint=False), indexing='ij')
	points = radius * np.stack([np.sin(latitude) * np.cos(longitude), np.sin(latitude) * np.sin(longitude), np.cos(latitude)], axis=-1)
	faces = []
	for k in range(rings):
		for i in range(around):
			here, next = k * around + i, k * around + (i + 1) % around
			faces.append((here, here + around, next + around, next))
	return points.reshape(-1, 3), faces


def localVertices(shape):
	"""In the body's frame; none of a wall."""
	return _localFaces(shape)[0]
