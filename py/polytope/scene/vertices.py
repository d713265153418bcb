# SPDX-License-Identifier: GPL-2.0-or-later
"""Vertices and faces of bodies as arrays.

Faces of one shape are three arrays: vertices (n, 3) in its own frame, the number of corners of each face, and the corners of all
faces one after another, as rows of the vertices.
"""

import functools

import numpy as np
from yade import O, Sphere, Wall, _polytope

__all__ = [
	'localFaces',
	'localVertices',
	'placeOf',
	'quaternionOf',
	'reachOfWalls',
	'rotationMatrix',
	'rows',
	'turned',
	'unturned',
	'wallFaces',
	'worldVertices',
]

mostRings = 24
"""Rings of faces between the poles of a sphere."""


def rows(vectors):
	"""(n, 3) array of YADE's vectors: numpy.array() of them takes ten times as long."""
	return np.array([(float(v[0]), float(v[1]), float(v[2])) for v in vectors]).reshape(-1, 3)


def placeOf(body):
	"""Position of a body, in a periodic scene that in the cell [m]."""
	position = O.cell.wrap(body.state.pos) if O.periodic else body.state.pos
	return float(position[0]), float(position[1]), float(position[2])


def quaternionOf(body):
	"""Orientation of a body, (x, y, z, w)."""
	ori = body.state.ori
	return float(ori[0]), float(ori[1]), float(ori[2]), float(ori[3])


def rotationMatrix(orientation):
	"""(3, 3) array of a Quaternion."""
	return np.array(orientation.toRotationMatrix(), float).reshape(3, 3)


def turned(points, quaternions):
	"""Points (n, 3), each by its quaternion (x, y, z, w), or all by one."""
	axis, scalar = quaternions[..., :3], quaternions[..., 3:]
	if not axis.any():
		return points
	twice = 2 * np.cross(axis, points)
	return points + scalar * twice + np.cross(axis, twice)


unturned = 0.0, 0.0, 0.0, 1.0
noFaces = np.empty((0, 3)), np.empty(0, int), np.empty(0, int)


def localFaces(shape, rings=mostRings):
	"""The three arrays of a shape; none of a wall, of a sphere faces between so many *rings*."""
	vertices, counts, corners = _polytope.packedFaces(shape)
	if counts:
		return np.frombuffer(vertices).reshape(-1, 3), np.frombuffer(counts, np.int32), np.frombuffer(corners, np.int32)
	if isinstance(shape, Sphere):
		vertices, counts, corners = _sphereFaces(rings)
		return float(shape.radius) * vertices, counts, corners
	return noFaces


def localVertices(shape):
	"""Vertices in the body's frame; none of a wall."""
	return localFaces(shape)[0]


def worldVertices(body, room=None):
	"""Vertices in world coordinates; of a wall those of its rectangle across the *room*, none without it."""
	if isinstance(body.shape, Wall):
		return wallFaces(body, room)[0] + np.array(body.state.pos, float)
	return turned(localVertices(body.shape), np.array(quaternionOf(body))) + np.array(placeOf(body))


def wallFaces(body, room):
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
