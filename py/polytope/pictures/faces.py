# SPDX-License-Identifier: GPL-2.0-or-later
"""Faces of bodies as arrays, for pictures.

Faces of one shape are three arrays: vertices (n, 3) in its own frame, the number of corners of each face, and the corners of all
faces one after another, as rows of the vertices.
"""

import functools
import math

import numpy as np
from yade import O, Sphere, Wall, _polytope

from .rims import withRims

__all__ = ['collect', 'localVertices', 'reachOfWalls', 'rows', 'worldVertices']

mostRings, fewestRings = 24, 4
"""Rings of faces between the poles of a sphere that is drawn."""
mostSphereFaces = 2_500_000
"""Faces of all spheres together, above which they get fewer rings: so many are each a few pixels large."""


def collect(bodies, colorOf=lambda body: body.shape.color, styleOf=lambda body: 'solid'):
	"""The bodies' faces in world coordinates, as arrays.

	:param colorOf: function of a body: RGB in 0…1, or an array (faces, 3) with that of each face; of a polygon each side's is seen along it
	    on the caps
	:param styleOf: function of a body: any word; bodies of the same word come together, 'hidden' ones not at all
	:returns: dictionary style → {points (n, 3), offsets (faces + 1), connectivity, colors (faces, 3) bytes, ids (faces)};
	    spheres are of the style 'smooth'
	"""
	parts, room = {}, reachOfWalls(bodies)
	rings = _rings(sum(isinstance(body.shape, Sphere) for body in bodies))
	for body in bodies:
		style = styleOf(body)
		if style == 'hidden':
			continue
		faces = _wallFaces(body, room) if isinstance(body.shape, Wall) else _localFaces(body.shape, rings)
		if len(faces[1]) == 0:
			continue
		turn, color = _quaternion(body), colorOf(body)
		if isinstance(body.shape, Sphere):
			style, turn = 'smooth', unturned
		if np.ndim(color) == 2 and getattr(body.shape, 'dimension', 3) == 2:
			*faces, color = withRims(*faces, color)
		parts.setdefault(style, []).append((*faces, _place(body), turn, color, body.id))
	return {style: _joined(*zip(*several, strict=True)) for style, several in parts.items()}


def _joined(vertices, counts, corners, places, quaternions, colors, ids):
	"""Arrays of all bodies together, from lists with one entry for each body."""
	own = [len(one) for one in vertices]
	first = np.cumsum([0, *own[:-1]])
	points = _turned(np.concatenate(vertices), np.repeat(np.array(quaternions), own, axis=0))
	faces = [len(one) for one in counts]
	return {
		'points': points + np.repeat(np.array(places), own, axis=0),
		'offsets': np.concatenate([[0], np.cumsum(np.concatenate(counts))]),
		'connectivity': np.concatenate(corners) + np.repeat(first, [len(one) for one in corners]),
		'colors': np.round(255 * np.clip(_ofFaces(colors, faces), 0, 1)).astype(np.uint8),
		'ids': np.repeat(ids, faces),
	}


def _ofFaces(colors, faces):
	"""RGB of each face, from those of bodies with so many faces."""
	if not any(isinstance(color, np.ndarray) and color.ndim == 2 for color in colors):
		return np.repeat(rows(colors), faces, axis=0)
	return np.concatenate([np.broadcast_to(np.array(color, float), (count, 3)) for color, count in zip(colors, faces, strict=True)])


def rows(vectors):
	"""(n, 3) array of YADE's vectors: numpy.array() of them takes ten times as long."""
	return np.array([(float(v[0]), float(v[1]), float(v[2])) for v in vectors]).reshape(-1, 3)


def _place(body):
	position = O.cell.wrap(body.state.pos) if O.periodic else body.state.pos
	return float(position[0]), float(position[1]), float(position[2])


def _quaternion(body):
	ori = body.state.ori
	return float(ori[0]), float(ori[1]), float(ori[2]), float(ori[3])


def _turned(points, quaternions):
	"""Points (n, 3), each by its quaternion (x, y, z, w), or all by one."""
	axis, scalar = quaternions[..., :3], quaternions[..., 3:]
	if not axis.any():
		return points
	twice = 2 * np.cross(axis, points)
	return points + scalar * twice + np.cross(axis, twice)


unturned = 0.0, 0.0, 0.0, 1.0
noFaces = np.empty((0, 3)), np.empty(0, int), np.empty(0, int)


def _localFaces(shape, rings=mostRings):
	vertices, counts, corners = _polytope.packedFaces(shape)
	if counts:
		return np.frombuffer(vertices).reshape(-1, 3), np.frombuffer(counts, np.int32), np.frombuffer(corners, np.int32)
	if isinstance(shape, Sphere):
		vertices, counts, corners = _sphereFaces(rings)
		return float(shape.radius) * vertices, counts, corners
	return noFaces


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
	return _turned(localVertices(body.shape), np.array(_quaternion(body))) + np.array(_place(body))


def _wallFaces(body, room):
	"""A rectangle across the room, relative to the wall's position."""
	if room is None:
		return noFaces
	axis = body.shape.axis
	first, second = (axis + 1) % 3, (axis + 2) % 3
	corners = np.zeros((4, 3))
	corners[:, axis] = float(body.state.pos[axis])
	corners[:, first] = [room[k][first] for k in (0, 1, 1, 0)]
	corners[:, second] = [room[k][second] for k in (0, 0, 1, 1)]
	return corners - np.array(body.state.pos, float), np.array([4]), np.arange(4)


def _rings(spheres):
	"""How many each of so many spheres has."""
	return int(min(mostRings, max(fewestRings, math.sqrt(mostSphereFaces / (2 * spheres))))) if spheres else mostRings


@functools.lru_cache
def _sphereFaces(rings):
	"""Faces of a sphere of radius 1: quadrilaterals between circles of latitude; triangles at the poles would make no visible difference."""
	around = 2 * rings
	latitude, longitude = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, around, endpoint=False), indexing='ij')
	points = np.stack([np.sin(latitude) * np.cos(longitude), np.sin(latitude) * np.sin(longitude), np.cos(latitude)], axis=-1)
	here = np.arange(rings * around).reshape(rings, around)
	beside = np.roll(here, -1, axis=1)
	faces = np.stack([here, here + around, beside + around, beside], axis=-1)
	return points.reshape(-1, 3), np.full(rings * around, 4), faces.ravel()


def localVertices(shape):
	"""Vertices in the body's frame; none of a wall."""
	return _localFaces(shape)[0]
