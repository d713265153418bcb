# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints on which a block topples far below its own angle, of polytope.check(). It yields (what, seen, advice).

A joint with a normal stiffness per area k carries a block that leans on a wedge of pressure under its edge. With the weight W per breadth
the tangent of the slope on which there is equilibrium is the largest value, over the turn θ of the block, of

	(x − L/3) / (y − L sin θ),        L = √(2 N/(k θ)),        x = b/2 cos θ − h/2 sin θ,        y = h/2 cos θ + b/2 sin θ,

with N = W times the cosine of the slope; of a rigid joint it is b/h (Goodman & Bray 1976). What counts is W/(k b²), that is density ·
gravity · (h/b)/k: blocks of all sizes lose the same angle.
"""

import math
from typing import NamedTuple

import numpy as np
import scipy  # loads its packages at their first use: half a second
from yade import Box, Facet, Polytope, RockJointMat, Wall, _polytope

from ..bodies.halfSpaces import worldPlanes
from ..rock.faceMaterials import materialOfPlane, materialsOf
from ..scene.movers import isMover
from ..scene.present import isPerArea, jointMakers
from ..scene.vertices import worldVertices

__all__ = ['softJoints', 'stableTilt']

lost = math.radians(1)
"""Loss of the stable angle above which it is told [rad]."""
level = 0.9
"""Cosine between gravity and a face on which a body can be said to stand."""
together = 0.02
"""Distance of two faces that are one joint, settled or not yet in touch, over the body's circumscribed radius."""
rounding = 1e-9
"""Distance of corners that are on a plane, over the circumscribed radius."""
beside = 0.5
"""Cosine between a contact's normal and the face on which a body stands, below which the contact holds its side."""
most = 1000
"""Largest number of bodies that are looked at: where there are more, so many are taken evenly, since what one loses others of its kind lose too."""
looks = 20
"""Number of bodies for which it is found out what they touch; those that lose most come first."""
leastTurn, mostTurn, turns = 1e-6, 0.5, 400
"""Angles of a leaning block, among which the largest tangent is looked for [rad]: for joints so stiff that it is below them, the loss is
far below *lost*."""
rounds = 20
"""Number of rounds to find N, whose slope is sought; each makes the error several times smaller."""


def stableTilt(ratio, softness):
	"""Angle of the slope at which blocks topple [rad]: (elastic, rigid).

	:param ratio: (n,) width over height [-]
	:param softness: (n,) W/(k b²): weight per breadth over stiffness per area and squared width [-]
	"""
	ratio, softness = np.asarray(ratio, float)[:, None], np.asarray(softness, float)[:, None]
	turn = np.geomspace(leastTurn, mostTurn, turns)
	sine, cosine = np.sin(turn), np.cos(turn)
	tangent = ratio
	for _ in range(rounds):
		pressing = softness * np.cos(np.arctan(tangent))
		wedge = np.minimum(np.sqrt(2 * pressing / turn), 1)  # lengths over the width; until the heel opens all of it is pressed
		behind, above = 0.5 * cosine - 0.5 / ratio * sine - wedge / 3, 0.5 / ratio * cosine + 0.5 * sine - wedge * sine
		values = np.where(above > 0, behind / above, 0)  # flat plates: their centre comes below the toe's depth
		tangent = np.clip(values.max(axis=1, keepdims=True), 0, ratio)
	return np.arctan(tangent[:, 0]), np.arctan(ratio[:, 0])


def softJoints(scene):
	"""Blocks that stand on a face; those that slide before they topple lose nothing."""
	gravity, size = scene.totalGravity, scene.gravity()
	makers = jointMakers(scene.loops)
	if not size > 0 or not makers or makers[0].kn:  # a MatchMaker: its values are not known here
		return
	bodies = [body for body in scene.bodies if _mayTopple(body) and isPerArea(body.material, makers)]
	bases = [base for body in bodies[:: max(1, len(bodies) // most)] for base in _bases(body, gravity / size)]
	if not bases:
		return
	stiffness = np.array([float(base.material.normalStiffness) for base in bases])
	width, height, breadth = np.array([(base.width, base.height, base.breadth) for base in bases]).T
	softness = np.array([float(base.body.state.mass) for base in bases]) * size / breadth / (stiffness * width**2)
	slides = np.array([math.pi / 2 if base.material.cohesion > 0 else float(base.material.frictionAngle) for base in bases])
	elastic, rigid = (np.minimum(angles, slides) for angles in stableTilt(width / height, softness))
	for k in np.argsort(elastic - rigid)[:looks]:
		if rigid[k] - elastic[k] > lost and _standsFree(scene, bases[k]):
			needed = stiffness[k] * _stiffer(width[k] / height[k], softness[k], slides[k])
			angles = f'{math.degrees(rigid[k]):.1f}° where its joint is rigid, of {math.degrees(elastic[k]):.1f}°'
			seen = f'body {bases[k].body.id} stands on slopes of up to {angles} with a normalStiffness of {stiffness[k]:.3g} Pa/m: it leans on a wedge of pressure under its edge'
			yield 'soft joint', seen, f'a normalStiffness of {needed:.1g} Pa/m or more, if no other angle is meant (docs/from-3dec.md)'
			return


def _stiffer(ratio, softness, slides):
	"""Factor on the stiffness, a power of ten, with which the loss is below *lost*."""
	factor = 1.0
	while True:
		factor *= 10
		elastic, rigid = stableTilt([ratio], [softness / factor])
		if min(rigid[0], slides) - min(elastic[0], slides) <= lost:
			return factor


def _mayTopple(body):
	"""Joints with tensile strength hold the other edge."""
	return (
		isinstance(body.shape, Polytope)
		and isinstance(body.material, RockJointMat)
		and isMover(body)
		and not any(material.tensileStrength > 0 for material in materialsOf(body))
		and float(body.state.mass) > 0
	)


class Base(NamedTuple):
	"""Face on which a body stands."""

	body: object
	material: object
	"""The material of this face."""
	normal: np.ndarray
	"""Outward, world axes."""
	corners: np.ndarray
	"""(n, 3) world."""
	width: float
	"""Least, over all directions in the face [m]."""
	height: float
	"""Twice that of the body's centre above it [m]."""
	breadth: float
	"""Area over width [m]."""


def _bases(body, down):
	"""The body's lowest face, if that is nearly level."""
	shape, place = body.shape, np.array([float(x) for x in body.state.pos])
	normals, _ = worldPlanes(body)
	lowest = int(np.argmax(normals @ down))
	normal, offset = normals[lowest], float(shape.offsets[lowest])
	corners = worldVertices(body)
	flat = corners[np.abs((corners - place) @ normal - offset) < rounding * float(shape.circumscribedRadius)]
	if normal @ down < level or len(flat) < 3 or not offset > 0:
		return
	hull = scipy.spatial.ConvexHull(
		flat @ np.linalg.svd(normal[None])[2][1:].T
	)  # seen along the normal; of two dimensions volume is the area
	across = hull.equations[:, :2]
	widths = np.ptp(hull.points[hull.vertices] @ across.T, axis=0)
	width = float(widths.min())
	if shape.dimension == 2:  # the prism's cap may be the shorter side
		width = hull.volume / float(shape.thickness)
	yield Base(body, materialOfPlane(body, lowest), normal, flat, width, 2 * offset, hull.volume / width)


def _standsFree(scene, base):
	"""Whether it stands on a face of another body, with no body in touch with its sides that could hold it."""
	shape, middle = base.body.shape, np.array([float(x) for x in base.body.state.pos])
	room = together * float(shape.circumscribedRadius)
	others = [
		body
		for body in scene.bodies
		if body is not base.body and body.mask & base.body.mask and isinstance(body.shape, (Polytope, Box, Facet, Wall))
	]
	radii = np.array([float(body.shape.circumscribedRadius) if isinstance(body.shape, Polytope) else math.inf for body in others])
	places = np.array([[float(x) for x in body.state.pos] for body in others]).reshape(-1, 3)
	near = [others[k] for k in np.flatnonzero(np.linalg.norm(places - middle, axis=1) < radii + float(shape.circumscribedRadius) + room)]
	return any(_hasAFaceThere(other, base, room) for other in near) and not any(_holdsASide(other, base, room) for other in near)


def _holdsASide(other, base, room):
	if not isinstance(other.shape, Polytope) or other.shape.dimension != base.body.shape.dimension:
		return False
	contact = _polytope.contact(base.body, other)
	normal = np.array([float(x) for x in contact.normal])
	return float(contact.infeasibility) < room and abs(float(normal @ base.normal)) < beside


def _hasAFaceThere(other, base, room):
	shape = other.shape
	if isinstance(shape, Wall):
		away = float(other.state.pos[shape.axis]) - base.corners[:, shape.axis]
		return bool(np.abs(away).max() < room)
	corners = worldVertices(other)
	apart = (corners.min(axis=0) > base.corners.max(axis=0) + room) | (corners.max(axis=0) < base.corners.min(axis=0) - room)
	on = np.abs((corners - base.corners[0]) @ base.normal) < room
	return bool(not apart.any() and on.sum() >= 3)
