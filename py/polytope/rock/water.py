# SPDX-License-Identifier: GPL-2.0-or-later
"""Water in joints and around blocks: `polytope.water(…)` (docs/water.md)."""

import math
from typing import NamedTuple

import numpy as np
from yade import O, Polytope, PolytopeWater, Vector3, _polytope

from ..arguments import namedArguments, number, vector, warn
from ..precision import isNumber
from ..scene.movers import canMove
from ..scene.present import gravityOf, insertEngine, placeOfForces
from ..scene.vertices import worldVertices
from .faces import areaVector
from .pressureFields import alongALine, belowALevel, belowASection, belowASurface, sectionOf
from .twoWaters import refuseTwice

__all__ = ['Face', 'water']


class Face(NamedTuple):
	"""A face of a body as it is now: what *faces* of *polytope.water* is asked for."""

	body: int
	"""Id of the body."""
	plane: int
	"""Index of its half-space in *shape.normals*; for a block of *polytope.jointedRock* also that in its list *faces*."""
	normal: np.ndarray
	"""Unit, outward [-]."""
	centre: np.ndarray
	"""Mean of its corners [m]."""
	area: float
	"""[m²]"""


least = 100.0
"""Density [kg/m³] below which it is taken for one in t/m³: no liquid in rock has it."""
sameMass = 1e-6
"""Tolerance on a clump's mass, as a part of it: more than the rounding of its parts, less than any overlap that is seen."""


@namedArguments
def water(level=None, density=1000, pressures=None, faces=None):
	"""Water presses on faces of blocks, in joints and outside: ``polytope.water(level=12)``. Set O.engines first.

	Each face below the water table has the pressure density · g · depth, wherever the body moves, integrated exactly over the part that is
	below: faces in a joint from both sides (uplift), faces outside as a lake does (buoyancy). The pressure in a joint is the same however
	far it is open. Each face has one water: give several calls the faces that each is for. In an engine *PolytopeWater*, which is put
	between InteractionLoop and NewtonIntegrator and is saved with the scene; docs/water.md has examples.

	:param level: height of the water table [m], counted against gravity; or three or more points of it (n, 3): in a vertical plane they are
	    a section, straight between them and level beyond its ends; otherwise triangles between them, which must reach over all bodies that
	    can move. Points may have two components in scenes of polygons
	:param float density: of the water [kg/m³], for *level*
	:param pressures: in place of *level*: [(point, pressure [Pa]), …] in order along a joint: linear between the points, constant across
	    their line and beyond its ends
	:param faces: function of a *Face* (body, plane, normal, centre, area), called once for each: whether it has this water; default all
	    faces of all polytopes, of later ones too
	:returns: the engine; ``engine.load(id)`` has force and moment on a body, ``engine.dead = True`` takes the water away
	:raises ValueError: naming the argument and the remedy: not finite, no gravity, nothing that gets wet, water that stands above the
	    ground in joints, faces on which another water presses already, clumps of parts that overlap
	"""
	place = placeOfForces('water acts')
	if O.periodic:
		raise ValueError('O.periodic: there is no water table in a periodic cell')
	if (level is None) == (pressures is None):
		raise ValueError('level: give either level, the height or points of the water table, or pressures along a joint')
	name = 'pressures' if level is None else 'level'
	bodies = [body for body in O.bodies if body is not None and isinstance(body.shape, Polytope)]
	if not bodies:
		raise ValueError('O.bodies: there are no polytopes that water could press on; make them first')
	_refuseOverlappingParts()
	pieces = _along(pressures) if level is None else _below(level, density, bodies, faces is not None)
	wet, chosen = _chosen(faces, bodies)
	corners = np.concatenate([corners for _, corners in chosen])
	engine = PolytopeWater(**_attributes(pieces), **wet)
	refuseTwice(engine, chosen, name)
	if not (_anyPressure(pieces, corners) or any(float(engine.load(body.id)[0].norm()) > 0 for body in bodies)):
		low, high = _reach(bodies, np.eye(3))
		raise ValueError(f'{name}: no face gets any pressure; the bodies reach from {_text(low)} to {_text(high)} m')
	insertEngine(place, engine)
	return engine


def _refuseOverlappingParts():
	"""Water would press on faces that are inside a clump."""
	for clump in O.bodies:
		if clump is None or not clump.isClump:
			continue
		parts = [O.bodies[k] for k in clump.shape.members]
		of = sum(float(part.shape.volume) * float(part.material.density) for part in parts if isinstance(part.shape, Polytope))
		if of > float(clump.state.mass) * (1 + sameMass):
			raise ValueError(
				f'O.bodies: the parts of clump {clump.id} weigh {of:g} kg and the clump {float(clump.state.mass):g} kg, so they overlap, and water would press on '
				'what is inside; make it of parts that only touch'
			)


def _anyPressure(pieces, corners):
	"""Whether a corner has pressure; for strips between corners the load tells."""
	for piece in pieces:
		apart = corners - piece.point
		within = np.all([apart @ side <= offset for side, offset in piece.sides], axis=0)
		if (within & (piece.value + apart @ piece.gradient > 0)).any():
			return True
	return False


def _text(point):
	return '(' + ', '.join(f'{x:g}' for x in point) + ')'


def _reach(bodies, axes):
	"""Least and largest coordinate of all corners along each axis."""
	along = np.concatenate([worldVertices(body) for body in bodies]) @ axes.T
	return along.min(axis=0), along.max(axis=0)


def _below(level, density, bodies, someFaces):
	density = number(density, 'density')
	if not 0 < density < math.inf:
		raise ValueError(f'density: must be above 0 [kg/m³], water has 1000, got {density:g}')
	gravity = np.array([float(x) for x in gravityOf()])
	if density < least:
		warn(f'density: {density:g} kg/m³ is no water, which has 1000: in t/m³? Lengths are in m, masses in kg')
	weight = float(density) * float(np.linalg.norm(gravity))
	if not weight > 0:
		raise ValueError('level: NewtonIntegrator has no gravity, so there is no up; set it first, or give pressures')
	up = -gravity / np.linalg.norm(gravity)
	points = None if isNumber(level) else _points(level, 'level')
	highest = float(level) if points is None else float((points @ up).max())
	if not math.isfinite(highest):
		raise ValueError(f'level: must be finite [m], got {level!r}')
	top = float(_reach(bodies, up[None])[1][0])
	if someFaces and highest > top:
		raise ValueError(
			f'level: {highest:g} m is above the ground, {top:g} m: water in joints and cracks stands at most as high (level={top:g}); a lake '
			f'presses on all faces, without *faces*'
		)
	bottom = -float(_reach(bodies, -up[None])[1][0])
	if highest - top > top - bottom:
		warn(
			f'level: {highest:g} m is above all bodies, which reach up to {top:g} m: they are at the bottom of a lake, whose pressure acts on all faces; in joints alone water stands at most as high as the ground'
		)
	if points is None:
		return belowALevel(highest, up, weight)
	section = sectionOf(points, up)
	if section is not None:
		return belowASection(*section, up, weight)
	moving = [worldVertices(body) for body in bodies if canMove(body)]
	return belowASurface(points, up, weight, np.concatenate([*moving, np.empty((0, 3))]))


def _along(pressures):
	try:
		pairs = [(point, float(number(pressure, 'pressures'))) for point, pressure in pressures]
	except (TypeError, ValueError):
		raise ValueError('pressures: must be pairs of a point and its pressure [Pa]: [((x, y, z), 1e5), …]') from None
	values = np.array([pressure for _, pressure in pairs])
	if not (np.isfinite(values).all() and (values >= 0).all()):
		raise ValueError('pressures: must be finite and at least 0 [Pa]')
	return alongALine(_points([point for point, _ in pairs], 'pressures'), values)


def _points(given, name):
	"""(n, 3); points of two components have z = 0."""
	try:
		given = [[*point, 0] if len(point) == 2 else point for point in given]
	except TypeError:
		raise ValueError(f'{name}: must be a number or points of two or three numbers, got {given!r}') from None
	if len(given) < 2:
		raise ValueError(f'{name}: must be two points at least, got {len(given)}')
	return np.array([[float(x) for x in vector(point, name)] for point in given])


def _attributes(pieces):
	"""The attributes of PolytopeWater: three sides for each piece."""
	sides = [[*piece.sides, *[(np.zeros(3), 0.0)] * (3 - len(piece.sides))] for piece in pieces]
	return dict(
		points=[Vector3(*piece.point) for piece in pieces],
		values=[float(piece.value) for piece in pieces],
		gradients=[Vector3(*piece.gradient) for piece in pieces],
		sides=[Vector3(*normal) for three in sides for normal, _ in three],
		sideOffsets=[float(offset) for three in sides for _, offset in three],
	)


def _chosen(faces, bodies):
	"""(attributes of PolytopeWater, [(Face, its corners), …])."""
	every = [pair for body in bodies for pair in _facesOf(body)]
	if faces is None:
		return {}, every
	if not callable(faces):
		raise ValueError(f'faces: must be a function of a face (body, plane, normal, centre, area), got {faces!r}')
	chosen = [(face, corners) for face, corners in every if faces(face)]
	if not chosen:
		raise ValueError('faces: is true of no face; normals point out of the body, so both faces of a joint have opposite ones')
	numbers = dict(wetBodies=[face.body for face, _ in chosen], wetPlanes=[face.plane for face, _ in chosen])
	return dict(someFaces=True, **numbers), chosen


def _facesOf(body):
	"""The faces on half-spaces, without the caps of polygons, each with its corners."""
	corners = worldVertices(body)
	_, counts, rings = _polytope.packedFaces(body.shape)
	rings = np.split(np.frombuffer(rings, np.int32), np.cumsum(np.frombuffer(counts, np.int32))[:-1])
	for plane, ring in zip(np.frombuffer(_polytope.planesOfFaces(body.shape), np.int32), rings, strict=True):
		if plane >= 0:
			outward = areaVector(corners[ring])
			area = float(np.linalg.norm(outward))
			yield Face(body.id, int(plane), outward / area, corners[ring].mean(axis=0), area), corners[ring]
