# SPDX-License-Identifier: GPL-2.0-or-later
"""Two cubes, the paths on which one moves over the other, and the poses on them: for the study of contact paths.

Lengths are in edges of the moving cube.
"""

import dataclasses
import itertools
import math

import numpy as np
from yade import O, Polytope, Quaternion, RockJointMat, Vector3
from yade._polytope import contact
from yade.polytope.bodies.polytopes import cuboid

__all__ = ['Pair', 'Placing', 'deep', 'fixedHalf', 'movingHalf', 'paths', 'planeSets', 'variants']

fixedHalf, movingHalf = 0.8, 0.5
"""Half the edge of the fixed and of the moving cube."""
deep = 0.005
"""Radius of the largest ball in the overlap: half the overlap of faces."""
variants = {
	'foundation': {'contactModel': 'foundation'},
	'spring': {'contactModel': 'spring'},
	'analytic centre': {'contactModel': 'boon2012'},
	'Chebyshev centre': {'contactModel': 'boon2012', 'contactPoint': 'chebyshevCentre'},
	'centroid': {'contactModel': 'boon2012', 'contactPoint': 'centroid'},
	'analytic centre, corner radius 0': {'contactModel': 'boon2012', 'cornerRadius': 0.0},
}
"""Arguments of polytope.contact, and the corner radius where it is not the default: the contact surface by both units of the stiffness, and
the paper's contact at each contact point."""

planeSets = ('plain', 'touching', 'repeated')
"""Six planes a cube; with planes through all edges and vertices that cut nothing; with the planes that face each other four times."""
again = 1e-12
"""Relative distance between these four: nearer ones are one plane to Polytope, which drops the others."""


def _turn(axis, angle):
	return Quaternion(tuple(axis), angle)


def _onto(body, world):
	"""The rotation that takes the direction *body* to *world*."""
	a, b = np.array(body, float) / np.linalg.norm(body), np.array(world, float) / np.linalg.norm(world)
	axis = np.cross(a, b)
	return _turn(axis / np.linalg.norm(axis), math.acos(np.clip(a @ b, -1, 1)))


def _around(angle, y=0.0):
	"""A direction in the plane xz, from +z to +x, with a part along y."""
	direction = np.array([math.sin(angle), y, math.cos(angle)])
	return np.zeros(3), direction / np.linalg.norm(direction)


def _above(x, y):
	return np.array([x, y, 0.0]), np.array([0.0, 0.0, 1.0])


def _vertexDown(world, twist):
	"""A vertex of the moving cube points against *world*, its edges turned by *twist* about that."""
	return _turn(np.array(world) / np.linalg.norm(world), twist) * _onto((-1, -1, -1), -np.array(world))


def _everyway(t):
	"""Round the fixed cube on a circle that is parallel to nothing, turning all the while."""
	a, b = 2 * math.pi * t, 2.7 * math.pi * t
	u, v = np.array([0.8, 0.36, 0.48]), np.array([-0.6, 0.48, 0.64])
	return (np.zeros(3), math.cos(a) * u + math.sin(a) * v), _turn((0.36, 0.48, 0.8), b)


paths = {
	'slide, face on face, to beyond the edge': lambda t: (_above(1.2 * t, 0.37 * t), Quaternion.Identity, deep),
	'slide over an edge to the next face': lambda t: (_around(0.5 * math.pi * t, 0.13), Quaternion.Identity, deep),
	'tilt, face to edge': lambda t: (_above(0.2, 0.13), _turn((0, 1, 0), 0.5 * (t - 0.1)), deep),
	'roll, edge to vertex': lambda t: (_above(0.2, 0.13), _turn((1, 0, 0), 0.5 * (t - 0.1)) * _turn((0, 1, 0), 0.5), deep),
	'vertex over an edge to the next face': lambda t: (_around(0.35 + 0.9 * t, 0.13), _vertexDown((1, 0.3, 1.1), 0.7), deep),
	'edge across an edge and past its end': lambda t: (_around(0.75, 1.6 * t), _turn((1, 0, 1), 0.9) * _turn((0, 1, 0), 0.6), deep),
	'vertex over a vertex': lambda t: (_around(0.6 + 0.4 * t, 0.65 + 0.1 * t), _vertexDown((1, 1.1, 1.05), 0.9), deep),
	'edge pressed deeper than the corner radius': lambda t: (_above(0.2, 0.13), _turn((0.1, 1, 0), 0.6), 0.001 + 0.08 * t),
	'round the body, turning': lambda t: (*_everyway(t), deep),
}
"""{name: function of t in 0 … 1: ((point, direction) of the line, orientation, radius of the overlap's largest ball)}"""


def _cube(half, planes, facing, cornerRadius):
	body = cuboid((0, 0, 0), 3 * (half,))
	normals, offsets = [tuple(n) for n in body.shape.normals], list(body.shape.offsets)
	if planes == 'touching':
		for corner in itertools.product((-1, 0, 1), repeat=3):
			if sum(map(abs, corner)) > 1:
				length = math.sqrt(sum(map(abs, corner)))
				normals.append(tuple(c / length for c in corner))
				offsets.append(half * length)
	if planes == 'repeated':
		normals, offsets = normals + 3 * [facing], offsets + [half * (1 + k * again) for k in (1, 2, 3)]
	body.shape = Polytope(
		normals=[Vector3(*n) for n in normals], offsets=offsets, cornerRadius=0.05 if cornerRadius is None else cornerRadius
	)
	return body


@dataclasses.dataclass
class Pair:
	"""A fixed and a moving cube.

	:param dict variant: as in `variants`
	:param str planes: one of `planeSets`
	"""

	variant: dict
	planes: str = 'plain'

	def __post_init__(self):
		if len(O.materials) == 0:
			O.materials.append(RockJointMat(density=1, normalStiffness=1, shearStiffness=1))
		self.arguments = {key: value for key, value in self.variant.items() if key != 'cornerRadius'}
		corner = self.variant.get('cornerRadius')
		self.fixed = _cube(fixedHalf, self.planes, (0, 0, 1), corner)
		self.moving = _cube(movingHalf, self.planes, (0, 0, -1), corner)

	def place(self, pose):
		self.moving.state.pos, self.moving.state.ori = pose

	def answer(self, pose):
		"""(contact point, normal, force over stiffness) of a query without warm start."""
		self.place(pose)
		found = contact(self.fixed, self.moving, **self.arguments)
		return np.array([found.point, found.normal, self.force(found.depth, found.area) * found.normal])

	def force(self, depth, area):
		"""Force over the stiffness, which is per area for *foundation*: the force then comes as if that of 1 m² were 1."""
		return max(depth, 0) * (area if self.variant['contactModel'] == 'foundation' else 1)


class Placing:
	"""Finds poses of plain cubes, since planes that cut nothing do not change s*."""

	def __init__(self, overlap=1.0):
		self.pair, self.overlap = Pair({'contactModel': 'boon2012'}), overlap
		self.corners = movingHalf * np.array(list(itertools.product((-1, 1), repeat=3)))

	def pose(self, path, t):
		"""Newton's method along the line from far outside: s* is convex along it, so it comes from one side and ends on the root."""
		(point, direction), orientation, radius = path(t)
		moving, way = self.pair.moving, 4.0
		moving.state.ori = orientation
		for _ in range(60):
			moving.state.pos = Vector3(*(point + way * direction))
			found = contact(self.pair.fixed, moving, **self.pair.arguments)
			nearer = (found.infeasibility + self.overlap * radius) / np.dot(found.dualDirection, direction)
			if not nearer > 1e-15:
				break
			way -= nearer
		return Vector3(moving.state.pos), Quaternion(orientation)

	def motion(self, a, b):
		"""Largest way of a vertex between two poses."""

		def vertices(pose):
			turn = np.array(pose[1].toRotationMatrix(), float).reshape(3, 3)
			return self.corners @ turn.T + np.array(pose[0])

		return float(np.linalg.norm(vertices(b) - vertices(a), axis=1).max())
