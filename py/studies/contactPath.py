# SPDX-License-Identifier: GPL-2.0-or-later
"""How contact point, normal and force move while one cube slides, tilts and rolls over another, through every change of contact.

The poses are prescribed: an orientation and a line along which the cube is pushed until the largest ball in the overlap has a given
radius (−s*, which does not depend on the contact's model). So the path is continuous, and where the answer is not, it is the
contact's own doing. A jump is told from a steep rise by halving: steps with the largest change are halved again and again; the
change per motion of a jump doubles each time, that of a smooth answer converges to its Lipschitz constant.

Lengths are in edges of the moving cube, forces in units of the mean force on that path.
"""

import dataclasses
import itertools
import math

import numpy as np
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	O,
	Polytope,
	Quaternion,
	RockJointMat,
	Vector3,
)
from yade._polytope import contact

from ..bodies import cuboid

__all__ = [
	'Pair',
	'Smoothness',
	'Zoom',
	'change',
	'deep',
	'forceUnit',
	'halvings',
	'paths',
	'planeSets',
	'quantities',
	'scan',
	'smoothness',
	'variants',
	'warmAnswers',
	'zoom',
]

fixedHalf, movingHalf = 0.8, 0.5
"""Of the cubes' edges."""
deep = 0.005
"""Radius of the largest ball in the overlap: half the overlap of faces."""
quantities = ('point', 'normal', 'force')
halvings = 24
"""Of a step of the path, by default: to motions of some 1e-10 edges."""

rounding = 1e-9
"""Changes below this are not told from rounding."""

variants = {
	'analytic centre': {},
	'Chebyshev centre': {'contactPoint': 'chebyshevCentre'},
	'centroid': {'contactPoint': 'centroid'},
	'analytic centre, corner radius 0': {'cornerRadius': 0.0},
	'conservative': {'contactModel': 'conservative'},
}
"""Arguments of polytope.contact, and the corner radius where it is not the default."""

planeSets = ('plain', 'touching', 'repeated')
"""Six planes a cube; with planes through all edges and vertices that cut nothing; with the planes that face each other four times."""


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
		normals, offsets = normals + 3 * [facing], offsets + 3 * [half]
	body.shape = Polytope(normals=[Vector3(*n) for n in normals], offsets=offsets, cornerRadius=0.05 if cornerRadius is None else cornerRadius)
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
		"""(contact point, normal, force over stiffness) of a query that remembers nothing."""
		self.place(pose)
		found = contact(self.fixed, self.moving, **self.arguments)
		return np.array([found.point, found.normal, max(found.depth, 0) * found.normal])


class _Placing:
	"""Finds poses; of plain cubes, since planes that cut nothing do not change s*."""

	def __init__(self, overlap=1.0):
		self.pair, self.overlap = Pair({}), overlap
		self.corners = movingHalf * np.array(list(itertools.product((-1, 1), repeat=3)))

	def pose(self, path, t):
		"""Newton's method along the line from far outside: s* is convex along it, so it comes from one side and ends on the root."""
		(point, direction), orientation, radius = path(t)
		moving, way = self.pair.moving, 4.0
		moving.state.ori = orientation
		for _ in range(60):
			moving.state.pos = Vector3(*(point + way * direction))
			found = contact(self.pair.fixed, moving)
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


def change(a, b):
	"""Of point [edges], normal [rad] and force between two answers."""
	point, normal, force = np.linalg.norm(b - a, axis=1)
	return np.array([point, 2 * math.asin(min(normal / 2, 1)), force])


@dataclasses.dataclass
class Scan:
	"""A path in equal steps of t.

	:ivar list poses: (position, orientation) of the moving cube
	:ivar motion: (n,) way of its farthest-moving vertex in each step
	:ivar answers: {variant: (n + 1, 3, 3) point, normal, force over stiffness}
	"""

	path: object
	overlap: float
	planes: str
	how: dict
	t: np.ndarray
	poses: list
	motion: np.ndarray
	answers: dict


def scan(path, steps, planes='plain', how=variants, overlap=1.0):
	"""All variants' answers along a path.

	:param dict how: as `variants`
	:param float overlap: factor on the path's
	"""
	placing = _Placing(overlap)
	t = np.linspace(0, 1, steps + 1)
	poses = [placing.pose(path, x) for x in t]
	motion = np.array([placing.motion(a, b) for a, b in itertools.pairwise(poses)])
	pairs = {name: Pair(variant, planes) for name, variant in how.items()}
	return Scan(path, overlap, planes, how, t, poses, motion, {name: np.array([pair.answer(pose) for pose in poses]) for name, pair in pairs.items()})


@dataclasses.dataclass
class Zoom:
	"""Steps of one path halved about their largest change, for one quantity.

	:ivar motion, change: (halvings + 1,) of the step that keeps the largest change
	"""

	t: float
	motion: np.ndarray
	change: np.ndarray

	@property
	def rate(self):
		return self.change / self.motion

	@property
	def growth(self):
		"""Growth of the rate per halving at the end, as a power of two: 1 for a jump, 0 and below for a smooth answer."""
		last = self.rate[-9:]
		return math.log2(last[-1] / last[0]) / 8 if last[0] > 0 and last[-1] > 0 else -math.inf

	@property
	def jump(self):
		"""What is left of the change when the motion has gone to nothing."""
		return float(self.change[-1]) if self.growth > 0.5 and self.change[-1] > rounding else 0.0


@dataclasses.dataclass
class Smoothness:
	"""Of one quantity on one path.

	:ivar float jump: the largest; 0 without
	:ivar float rate: largest change per motion; infinite with a jump
	:ivar Zoom worst: where it was found
	"""

	jump: float
	rate: float
	worst: Zoom


def smoothness(zooms):
	"""Of the zooms of one quantity."""
	jump = max(zooms, key=lambda one: one.jump)
	if jump.jump > 0:
		return Smoothness(jump.jump, math.inf, jump)
	steep = max(zooms, key=lambda one: one.rate.max())
	return Smoothness(0.0, float(steep.rate.max()), steep)


def zoom(found, name, places=6, depth=halvings):
	"""[Zooms of point, of normal, of force] of a scan's variant, about the *places* steps with the largest change and those with the largest rate."""
	placing, pair = _Placing(found.overlap), Pair(found.how[name], found.planes)
	answers = found.answers[name]
	unit = np.array([1, 1, forceUnit(answers)])
	changes = np.array([change(a, b) for a, b in itertools.pairwise(answers)]) / unit
	rates = changes / found.motion[:, None]
	zooms = []
	for quantity in range(3):
		steps = {int(k) for values in (changes, rates) for k in np.argsort(values[:, quantity])[-places:]}
		zooms.append([])
		for k in sorted(steps):
			ends = [(found.t[i], found.poses[i], answers[i]) for i in (k, k + 1)]
			motion, size = [found.motion[k]], [changes[k, quantity]]
			for _ in range(depth):
				t = (ends[0][0] + ends[1][0]) / 2
				pose = placing.pose(found.path, t)
				middle = (t, pose, pair.answer(pose))
				halves = [(ends[0], middle), (middle, ends[1])]
				parts = [(change(a[2], b[2]) / unit)[quantity] for a, b in halves]
				ends = halves[int(parts[1] > parts[0])]
				motion.append(placing.motion(ends[0][1], ends[1][1]))
				size.append(max(parts))
			zooms[-1].append(Zoom(float(ends[0][0]), np.array(motion), np.array(size)))
	return zooms


def forceUnit(answers):
	"""Mean force, as force over stiffness; the overlap of faces where there is none at all."""
	return np.linalg.norm(answers[:, 2], axis=1).mean() or 2 * deep


def warmAnswers(found, name):
	"""Point, normal and force over stiffness along the path from YADE's loop, where each query starts from the last one's answer.

	:returns: (n, 3, 3); NaN where there was no contact
	"""
	O.reset()
	pair = Pair(found.how[name], found.planes)
	functor = Ig2_Polytope_Polytope_PolytopeGeom(**pair.arguments)
	for body in (pair.fixed, pair.moving):
		body.state.blockedDOFs = 'xyzXYZ'
	pair.place(found.poses[0])
	ids = O.bodies.append([pair.fixed, pair.moving])
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0),
		InteractionLoop(
			[functor],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()],
		),
	]
	O.dt = 1e-9
	answers = []
	for pose in found.poses:
		pair.place(pose)
		O.step()
		here = O.interactions[ids] if O.interactions.has(*ids) else None
		if here is None or not here.isReal:
			answers.append(np.full((3, 3), np.nan))
			continue
		geom = here.geom
		answers.append(np.array([geom.contactPoint, geom.normal, max(geom.penetrationDepth, 0) * geom.normal]))
	O.reset()
	return np.array(answers)
