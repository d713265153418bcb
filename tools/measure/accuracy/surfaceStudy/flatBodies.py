# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that lie on one of their faces, for scenes on floors: solids, a hull of random points, polygons, and a sphere."""

import math

import numpy as np
from yade import Quaternion, Vector3, utils
from yade.polytope.bodies.polytopes import cuboid, fromVertices, polygon, regular
from yade.polytope.rock.faces import areaOfFace

__all__ = ['Lying', 'lyingBody', 'bodyKinds', 'planarBodies']


def _hull(material):
	"""The hull of 24 random points on an ellipsoid."""
	points = np.random.default_rng(3).normal(size=(24, 3))
	return fromVertices(points / np.linalg.norm(points, axis=1)[:, None] * (0.32, 0.28, 0.22), material=material)


def _irregular(material):
	angles = np.radians([0, 50, 95, 160, 230, 290])
	return polygon(np.column_stack([0.32 * np.cos(angles), 0.27 * np.sin(angles)]), material=material)


bodyKinds = {
	'cube': lambda material: cuboid((0, 0, 0), (0.25, 0.25, 0.25), material=material),
	'box': lambda material: cuboid((0, 0, 0), (0.35, 0.2, 0.15), material=material),
	'smallCube': lambda material: cuboid((0, 0, 0), (0.05, 0.05, 0.05), material=material),
	'tetrahedron': lambda material: regular(4, 0.35, material=material),
	'dodecahedron': lambda material: regular(12, 0.3, material=material),
	'icosahedron': lambda material: regular(20, 0.3, material=material),
	'hull': _hull,
	'square': lambda material: polygon([(-0.25, -0.25), (0.25, -0.25), (0.25, 0.25), (-0.25, 0.25)], material=material),
	'polygon': _irregular,
	'sphere': lambda material: utils.sphere((0, 0, 0), 0.25, material=material),
}
"""Name → function of the material. About half a metre wide."""

planarBodies = ('square', 'polygon')
"""Bodies in the xy plane, where y is up."""


class Lying:
	"""A body with a face down.

	:ivar body: not yet in the scene, its centroid at the origin
	:ivar float height: of the centroid over that face [m]
	:ivar float area: of that face [m²]; polygons: length × thickness; the sphere: a hundredth of its great circle
	:ivar float back, front: extent of the whole body behind and ahead of the centroid along the direction of motion [m]
	"""

	def __init__(self, body, height, area, corners, along):
		self.body, self.height, self.area = body, height, area
		self.back, self.front = -float((corners @ along).min()), float((corners @ along).max())


def lyingBody(kind, material=-1, heading=0.0, yaw=0.0, tilt=Quaternion.Identity):
	"""A body with its most stable face down (polyhedra: z, polygons: y is up).

	:param kind: one of *bodyKinds*
	:param float heading: angle of the direction of motion from x, about z [rad]; the body turns with it
	:param float yaw: further angle about the vertical [rad]; not for polygons
	:param Quaternion tilt: turns the body last of all, so that an edge or a vertex is lowest
	:returns: :yref:`Lying`
	:raises ValueError: naming *kind*
	"""
	if kind not in bodyKinds:
		raise ValueError(f'kind: must be one of {", ".join(bodyKinds)}, got {kind!r}')
	body = bodyKinds[kind](material)
	planar = kind in planarBodies
	up = np.array([0.0, 1.0, 0.0] if planar else [0.0, 0.0, 1.0])
	along = np.array([math.cos(heading), math.sin(heading), 0.0])
	body.state.pos = Vector3(0, 0, 0)
	if kind == 'sphere':
		radius = body.shape.radius
		return Lying(body, radius, 0.01 * math.pi * radius**2, radius * np.array([-along, along]), along)
	body.state.ori = _faceDown(body.shape, up, planar)
	if not planar:
		body.state.ori = Quaternion(Vector3(0, 0, 1), heading + yaw) * body.state.ori
	body.state.ori = tilt * body.state.ori
	corners = np.array([body.state.ori * v for v in body.shape.vertices], float)
	heights = corners @ up
	height = -float(heights.min())
	if planar:
		area = float(np.ptp(corners[heights < -height + 1e-9, 0])) * body.shape.thickness
	else:
		area = areaOfFace(corners, up, -height)
	return Lying(body, height, area, corners, along)


def _faceDown(shape, up, planar):
	"""Turns the face down whose rim is farthest from the centroid's foot on it: the one the body stands on most stably."""
	normals, offsets = np.array(shape.normals, float), np.array(shape.offsets, float)
	best, margin = 0, -math.inf
	for k, (normal, offset) in enumerate(zip(normals, offsets, strict=True)):
		across = np.sqrt(np.maximum(1 - (normals @ normal) ** 2, 0))
		others = across > 1e-6
		least = ((offsets - offset * (normals @ normal))[others] / across[others]).min()
		if least > margin + 1e-9:
			best, margin = k, least
	normal = normals[best]
	if planar:  # about z alone
		angle = math.atan2(-up[1], -up[0]) - math.atan2(normal[1], normal[0])
		return Quaternion(Vector3(0, 0, 1), angle)
	turned = np.cross(normal, -up)
	sine, cosine = np.linalg.norm(turned), -float(normal @ up)
	if sine < 1e-12:
		return Quaternion.Identity if cosine > 0 else Quaternion(Vector3(1, 0, 0), math.pi)
	return Quaternion(Vector3(*turned / sine), math.atan2(sine, cosine))
