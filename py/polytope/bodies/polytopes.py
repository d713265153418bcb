# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies with Polytope shapes, from half-spaces, points or dimensions.

All functions return a yade Body, ready for ``O.bodies.append``, with mass and inertia from the material's density. They
share these keyword arguments (*body* below), with the meaning they have in yade.utils.box:

:param Vector3 center: where the body's centroid is [m]; default where its planes or points are (*regular*, *cuboid*: their centre)
:param Quaternion orientation: turns the body about its centroid
:param material: Material instance, index or label in O.materials, or a function that makes one; default the last one added
:param bool fixed: block all degrees of freedom
:param float cornerRadius: radius of the inner potential particle's corners [m] (Polytope.cornerRadius), read by the contact model
    'boon2012' alone; default a tenth of the inscribed ball's radius
:param Vector3 color: RGB in 0…1; default random, as (-1, -1, -1)
:param bool wire: draw edges only
:param bool highlight: highlight in the 3d view
:param int mask: Body.mask
:param Vector3 velocity: initial velocity [m/s]
:param Vector3 angularVelocity: initial angular velocity [rad/s]
"""

import functools
import inspect
import numbers
import random

import numpy as np
from yade import Quaternion, Vector3, _polytope

from .._sharedArguments import withShared
from ..arguments import flag, maskOf, materialOf, number, numbersOf, rotation, rows, vector, vectors
from ..scene.vertices import rotationMatrix

__all__ = ['fromHalfSpaces', 'fromVertices', 'regular', 'cuboid', 'polygon']

defaultCornerFraction = 0.1
"""Default cornerRadius over the inscribed ball's radius."""

isotropyTolerance = 1e-9
"""Relative difference of principal moments up to which a body is integrated as isotropic (exact for equal moments)."""

still = (0, 0, 0)
"""Default velocities."""

colours = random.Random()
"""Draws the colours of bodies that are given none: a generator of its own, so that the script's random numbers are not affected."""

concave = 1e-6
"""How deep a point may lie inside the hull, over the outline's extent, and still be one of a straight side, written with six digits."""


randomColor = (-1, -1, -1)
"""What stands for a random colour in YADE."""


def builder(make=None, *, lacks=()):
	"""Decorates a function that makes a body or several: where a keyword is unknown it is named, and what the function takes.
	Its help text gets the arguments that all bodies have.

	:param lacks: arguments of all bodies that this one does not have
	"""
	if make is None:
		return functools.partial(builder, lacks=lacks)
	own = [name for name, one in inspect.signature(make).parameters.items() if one.kind is not one.VAR_KEYWORD]

	@functools.wraps(make)
	def checked(*given, **named):
		for name in named:
			if name not in own and (name not in ofAllBodies or name in lacks):
				others = [name for name in ofAllBodies if name not in own and name not in lacks]
				takes = f'{", ".join(own)}, and as all bodies {", ".join(others)}'
				raise TypeError(f'{make.__name__}: there is no argument {name!r}; it takes {takes}')
		return make(*given, **named)

	checked.__doc__ = withShared(make.__doc__, __doc__, {*own, *lacks})
	return checked


@builder
def fromHalfSpaces(normals, offsets, keepRedundant=True, thickness=None, **body):
	"""Polyhedron {x : normals[i]·x ≤ offsets[i] for all i} in world coordinates, as a body at its centroid; or a polygon of the xy plane,
	as *polygon* makes it.

	:param normals: (n, 3) outward normals of any length [-]; of a polygon (n, 2)
	:param offsets: n offsets, in units of the normals' length [m]
	:param bool keepRedundant: keep planes that own no face: they take part in the analytic centre (Boon et al. 2012,
	    section 2.2) and change normals, see *Polytope*. Planes that repeat another one are dropped in any case.
	:param float thickness: of a polygon: extent along z for mass and contact areas [m]; default 1
	:raises ValueError: naming the argument: unbounded, empty or flat set, NaN or infinite values, zero normal, fewer than
	    four planes (of a polygon three), lengths that differ, cornerRadius that does not fit inside, the *thickness* of a polyhedron
	"""
	flat = areFlat(normals)
	if thickness is not None and not flat:
		raise ValueError('thickness: is that of a polygon, whose normals have two components')
	thickness = 1 if thickness is None else number(thickness, 'thickness')
	normals, offsets = vectors(normals, 'normals', 2 if flat else 3), numbersOf(offsets, 'offsets')
	keepRedundant = flag(keepRedundant, 'keepRedundant')
	return bodyOf(
		lambda *corner: _polytope.ofHalfSpaces(normals, offsets, 2 if flat else 3, thickness, keepRedundant, *corner), flat=flat, **body
	)


def areFlat(normals):
	"""Whether these rows have two components."""
	try:
		return len(normals) > 0 and all(len(row) == 2 for row in normals)
	except TypeError:
		return False


@builder
def fromVertices(points, **body):
	"""Convex hull of points in world coordinates, as a body at its centroid.

	:param points: (n, 3) points [m]; points inside the hull are allowed
	:raises ValueError: naming *points*: fewer than four, NaN or infinite, all in one plane
	"""
	points = vectors(points, 'points', 3)
	return bodyOf(lambda *corner: _polytope.ofPoints(points, 3, 0, 1, *corner), **body)


@builder
def regular(faces, circumradius, center=(0, 0, 0), orientation=None, **body):
	"""Regular polyhedron.

	:param int faces: 4, 6, 8, 12 or 20
	:param float circumradius: distance of the vertices from the centre [m]
	:param Vector3 center: centre [m]
	:param Quaternion orientation: of the body
	:raises ValueError: naming *faces* or *circumradius*
	"""
	if not isinstance(faces, numbers.Integral):
		raise ValueError(f'faces: must be 4, 6, 8, 12 or 20, got {faces!r}')
	faces, circumradius = int(faces), number(circumradius, 'circumradius')
	return bodyOf(lambda *corner: _polytope.ofRegular(faces, circumradius, *corner), center=center, orientation=orientation, **body)


@builder
def cuboid(center, extents, orientation=None, **body):
	"""Rectangular block.

	:param Vector3 center: centre [m]
	:param Vector3 extents: half-lengths along the body's axes [m], as for *yade.utils.box*
	:param Quaternion orientation: of the body
	:raises ValueError: naming *extents* if one is not positive and finite
	"""
	half = vector(extents, 'extents')
	return bodyOf(lambda *corner: _polytope.ofCuboid(half, *corner), center=center, orientation=orientation, **body)


@builder
def polygon(points2d, thickness=1.0, **body):
	"""Convex polygon in the xy plane (2-D), with z and rotations out of the plane blocked.

	:param points2d: (n, 2) corners [m] in world coordinates, in any order
	:param float thickness: extent along z for mass and contact areas [m]
	:raises ValueError: naming *points2d* (also where a corner lies inside the others: the outline is not convex), *thickness*, or a
	    *velocity* or *angularVelocity* out of the plane
	"""
	outline = rows(points2d, 'points2d', 2)
	points, thickness = vectors(outline, 'points2d', 2), number(thickness, 'thickness')

	def shape(*corner):
		try:
			return _polytope.ofPoints(points, 2, 0, thickness, *corner)
		except ValueError as error:
			raise ValueError(str(error).replace('points', 'points2d', 1) if str(error).startswith('points') else str(error)) from None

	made = bodyOf(shape, flat=True, **body)
	if len(made.shape.offsets) < len(outline):
		refuseInside(shape(None, defaultCornerFraction), outline, made.shape)
	return made


def refuseInside(placed, outline, shape):
	"""Refuses the outline of a polygon or prism, some of whose points are no corners, where one is not on its rim: it is not convex.

	:param placed: the shape where the points are (CentralShape)
	"""
	turn = rotationMatrix(placed.orientation)
	normals = np.array(shape.normals, float) @ turn.T
	sides = np.abs(normals[:, 2]) < 0.5  # a prism's ends are normal to z
	points = np.array(outline, float)
	slacks = np.array(shape.offsets, float)[sides] - (points - np.array(placed.position, float)[:2]) @ normals[sides, :2].T
	k = int(np.argmax(slacks.min(axis=1)))
	if slacks[k].min() > concave * np.ptp(points, axis=0).max():
		raise ValueError(
			f'points2d: the outline is not convex, point {k} {tuple(points[k].tolist())} lies inside the hull of the others; leave it out, or make convex parts'
		)


def randomColour():
	return Vector3(colours.random(), colours.random(), colours.random())


def ofOneColour(body):
	"""Arguments of all bodies, for pieces of one thing: one random colour where none is given."""
	given = body.get('color')
	return body if given is not None and tuple(vector(given, 'color')) != randomColor else {**body, 'color': randomColour()}


def bodyOf(
	shape,
	flat=False,
	*,
	center=None,
	orientation=None,
	material=-1,
	fixed=False,
	cornerRadius=None,
	color=None,
	wire=False,
	highlight=False,
	mask=1,
	velocity=still,
	angularVelocity=still,
):
	"""The body of the shape that shape(cornerRadius, default's fraction) makes."""
	placed = shape(None if cornerRadius is None else number(cornerRadius, 'cornerRadius'), defaultCornerFraction)
	mask = maskOf(mask)
	given = None if color is None else vector(color, 'color')
	if given is None or tuple(given) == randomColor:
		given = randomColour()
	body = _polytope.body(placed, materialOf(material), *_pose(center, orientation, flat), flag(fixed, 'fixed'), isotropyTolerance, given)
	if flag(wire, 'wire'):
		body.shape.wire = True
	if flag(highlight, 'highlight'):
		body.shape.highlight = True
	if mask != 1:
		body.mask = mask
	if velocity is not still:
		body.state.vel = given = vector(velocity, 'velocity')
		if flat and given[2] != 0:
			raise ValueError(f'velocity: a polygon stays in its plane; the third component must be 0, got {velocity!r}')
	if angularVelocity is not still:
		body.state.angVel = given = vector(angularVelocity, 'angularVelocity')
		if flat and (given[0] != 0 or given[1] != 0):
			raise ValueError(f'angularVelocity: a polygon turns about z alone; the first two components must be 0, got {angularVelocity!r}')
	return body


ofAllBodies = tuple(name for name, one in inspect.signature(bodyOf).parameters.items() if one.kind is one.KEYWORD_ONLY)


def _pose(center, orientation, flat):
	"""The place of the centroid or None, and the turn about it."""
	turn = Quaternion.Identity if orientation is None else rotation(orientation)
	if center is not None:
		center = vector(center, 'center')
		if flat and center[2] != 0:
			raise ValueError(f'center: a polygon lies in the plane z = 0; the third component must be 0, got {center!r}')
	if flat and (turn[0] != 0 or turn[1] != 0):
		raise ValueError(f'orientation: a polygon turns about z alone, got {orientation!r}')
	return center, turn
