# SPDX-License-Identifier: GPL-2.0-or-later
"""A lining or beam of segments along a line, in contact with blocks or bonded to them: `polytope.lining(…)` (docs/support.md)."""

import math
from typing import NamedTuple

import numpy as np
from yade import O, Polytope, Vector3

from ..arguments import flag, materialOf, number, rows, warn
from ..bodies.polytopes import builder, fromVertices, ofOneColour, polygon
from ..bonding.bonds import bond, bonds, madeBonds
from ..scene.present import placeOfForces
from .liningAdhesion import Adhesion, blocksNear, positive
from .liningSegments import axisOf, divided, segmentsOf

__all__ = ['Adhesion', 'Lining', 'LiningForces', 'lining']

shearPart = 5 / 6
"""κ: part of a rectangular section that counts in shear (Timoshenko's beam)."""


class LiningForces(NamedTuple):
	"""Section forces at the joints of a lining, in the order of its line, for its whole width. NaN where the joint has failed."""

	points: np.ndarray
	"""(n, 3) middle of each joint, as it is now [m]"""
	distances: np.ndarray
	"""(n,) along the middle of the thickness from the first end, as it was made [m]"""
	normal: np.ndarray
	"""(n,) normal force N, tension positive [N]"""
	shear: np.ndarray
	"""(n,) shear force Q = dM/ds: what the part behind exerts on the part before the joint, to the left of the line [N]"""
	moment: np.ndarray
	"""(n,) bending moment M, positive with tension on the left of the line [N·m]"""


class Lining:
	"""A lining in the scene. It knows its bodies by their ids, so it serves after O.load, too."""

	def __init__(self, ids, joints, distances, axis):
		self.ids = tuple(ids)
		"""Ids of the segments, in the order of the line."""
		self.joints = tuple(joints)
		"""(id before, id behind) of each joint."""
		self._distances, self._axis = distances, axis

	@property
	def bonds(self):
		"""The PolytopeBond of each joint.

		:raises ValueError: if the scene has none of them any more
		"""
		found = {(one.id1, one.id2): one for one in madeBonds()}
		try:
			return [found[tuple(sorted(joint))] for joint in self.joints]
		except KeyError:
			raise ValueError(
				"engines: the scene lacks the lining's bonds; O.engines = polytope.engines() puts them back, O.reset() ends them"
			) from None

	@property
	def adhesion(self):
		"""The PolytopeBonds between the segments and blocks."""
		own = set(self.ids)
		return [one for one in madeBonds() if (one.id1 in own) != (one.id2 in own)]

	@property
	def forces(self):
		"""LiningForces of now, as NumPy arrays: ``matplotlib.pyplot.plot(lining.forces.distances, lining.forces.moment)``."""
		rows = [_section(one, behind, self._axis) for one, (_, behind) in zip(self.bonds, self.joints, strict=True)]
		table = np.array(rows, float).reshape(-1, 6)
		return LiningForces(table[:, :3], self._distances.copy(), table[:, 3], table[:, 4], table[:, 5])


@builder(lacks=('center', 'orientation', 'fixed', 'velocity', 'angularVelocity'))
def lining(
	points,
	thickness,
	youngsModulus,
	poissonsRatio=0.2,
	width=1.0,
	axis=None,
	side='left',
	closed=False,
	segmentLength=None,
	tensileStrength=math.inf,
	shearStrength=math.inf,
	adhesion=None,
	**body,
):
	"""A lining, or a beam: segments along a line of points, bonded to each other as an elastic beam of rectangular section:
	``polytope.lining([(0, 0), (4, 0)], thickness=0.2, youngsModulus=3e10, segmentLength=0.25)``.

	It is put into O.bodies, and touches blocks as any body does: density, friction and the stiffness of contacts with blocks are those of
	its material. No segment is fixed: ``O.bodies[lining.ids[0]].dynamic = False`` holds the first one. With *adhesion* it is also bonded to
	all blocks that touch it. It is without force as it is made. Set O.engines first: its bonds are in the engine PolytopeBonds.
	docs/support.md has the equations.

	:param points: (n, 2) corners of the line, a lining of polygons; or (n, 3), one of polyhedra, all in one plane normal to *axis* [m]
	:param float thickness: of the section, in the plane of the line [m]
	:param float youngsModulus: E [Pa]; for a long tunnel of which a slice is computed E/(1 - ν²)
	:param float poissonsRatio: of the shear modulus G = E/(2 (1 + ν)) [-]
	:param float width: of the section, along *axis*; half of it lies on each side of the points [m]. For a lining of polygons it is their thickness
	:param Vector3 axis: across the plane of the line, needed for (n, 3) points: seen against it, the left of the line is on the left
	:param side: where the thickness lies, seen along the line: 'left', 'right' or 'middle'. The inside of a tunnel whose points go round
	    anticlockwise is left
	:param bool closed: the last point is joined to the first one by a segment, as in a ring
	:param float segmentLength: the line between two points is divided into equal segments not longer than this [m]; default one segment
	:param float tensileStrength: tension at the edge of a joint, N/A + M/W, at which the joint breaks [Pa]; default it does not
	:param float shearStrength: mean shear stress at which a joint breaks [Pa]; default it does not
	:param Adhesion adhesion: polytope.Adhesion(tensileStrength, shearStrength) to the blocks; default none, contact alone
	:returns: Lining, with *ids* and section *forces*
	:raises ValueError: naming the argument and the remedy; then nothing was changed
	"""
	thickness, modulus, width = (
		positive(x, name) for x, name in ((thickness, 'thickness'), (youngsModulus, 'youngsModulus'), (width, 'width'))
	)
	ratio = float(number(poissonsRatio, 'poissonsRatio'))
	if not -1 < ratio <= 0.5:
		raise ValueError(f'poissonsRatio: must be above -1 and at most 0.5, got {ratio:g}')
	strengths = dict(
		tensileStrength=positive(tensileStrength, 'tensileStrength', True), cohesion=positive(shearStrength, 'shearStrength', True)
	)
	flat = _isFlat(points)
	line = np.array(rows(points, 'points', 2 if flat else 3), float)
	axis = axisOf(axis, line)
	_refuseOtherDimension(flat)
	closed = flag(closed, 'closed')
	if segmentLength is not None:
		segmentLength = positive(segmentLength, 'segmentLength')
	chain = segmentsOf(divided(line, axis, closed, segmentLength), axis, thickness, side, closed)
	pieces = ofOneColour({**body, 'material': materialOf(body.get('material', -1))})
	if flat:
		made = [polygon(outline[:, :2], thickness=width, **pieces) for outline in chain.outlines]
	else:
		made = [fromVertices([x + z * axis for x in outline for z in (-width / 2, width / 2)], **pieces) for outline in chain.outlines]
	if bonds() is None:
		placeOfForces('bonds act')  # refuses before anything is changed
	near = [] if adhesion is None else blocksNear(made, chain, width, axis, adhesion, flat)

	ids = O.bodies.append(made)
	count = len(ids)
	joints = [(ids[k - 1], ids[k]) for k in range(1, count)] + ([(ids[-1], ids[0])] if closed else [])
	for joint, length, cosine in zip(joints, chain.lengths, chain.cosines, strict=True):
		bond(list(joint), frictionAngle=0, **_stiffnesses(modulus, ratio, thickness, width, length, cosine), **strengths)
	stuck = sum(
		bond([ids[k], other], gap=adhesion.gap, tensileStrength=adhesion.tensileStrength, cohesion=adhesion.shearStrength)
		for k, other in near
	)
	if adhesion is not None and not stuck:
		warn(
			'adhesion: no segment has a face on the face of a block, so the lining does not stick to any; move it or its side, or give Adhesion(…, gap=…)'
		)
	return Lining(ids, joints, chain.distances, axis)


def _isFlat(points):
	try:
		return len(points[0]) == 2
	except (TypeError, IndexError, KeyError):
		raise ValueError('points: must be a sequence of at least two points, each of two or three numbers [m]') from None


def _stiffnesses(modulus, ratio, thickness, width, length, cosine):
	"""Stiffnesses per area of a bond as stiff as this length of the beam. At a corner of the line the joint is cut slanted, by half the angle, whose
	cosine is given: its area is larger than the section by 1/cosine and its second moment by 1/cosine³."""
	shearModulus = modulus / (2 * (1 + ratio))
	slanted = thickness / cosine
	polar = width * slanted * (width**2 + slanted**2) / 12
	return dict(
		normalStiffness=modulus * cosine / length,
		shearStiffness=shearPart * shearModulus * cosine / length,
		bendingStiffness=modulus * cosine**3 / length,
		twistingStiffness=shearModulus * _torsionConstant(thickness, width) / (length * polar),
	)


def _torsionConstant(a, b):
	"""Saint-Venant's torsion constant of a rectangle, to 0.5 % (Roark's Formulas for Stress and Strain)."""
	b, a = sorted((a, b))
	return a * b**3 * (1 / 3 - 0.21 * b / a * (1 - b**4 / (12 * a**4)))


def _refuseOtherDimension(flat):
	"""Polygons and polyhedra have no contact."""
	there = {body.shape.dimension for body in O.bodies if body is not None and isinstance(body.shape, Polytope)}
	if there == {3} and flat:
		raise ValueError(
			'points: have two components, as for a lining of polygons, and the scene has polyhedra; give points of three, and the axis'
		)
	if there == {2} and not flat:
		raise ValueError('points: have three components, as for a lining of polyhedra, and the scene has polygons; give points of two')


def _section(one, behind, axis):
	"""x, y, z of the joint's middle, N, Q, M."""
	if not one.intact:
		return [*one.point, math.nan, math.nan, math.nan]
	sign = 1 if one.id2 == behind else -1
	normals = [O.bodies[number].state.ori * (frame * Vector3(1, 0, 0)) for number, frame in ((one.id1, one.frame1), (one.id2, one.frame2))]
	along = sign * np.array(normals[0] + normals[1], float)
	along /= np.linalg.norm(along)
	left = np.cross(axis, along)
	force, moment = sign * np.array(one.force, float), sign * np.array(one.moment, float)  # on the part behind the joint
	return [*one.point, -force @ along, -force @ left / np.linalg.norm(left), moment @ axis]
