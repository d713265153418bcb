# SPDX-License-Identifier: GPL-2.0-or-later
"""How contact point, normal and force move while one cube slides, tilts and rolls over another, through every change of contact.

The poses are prescribed: an orientation and a line along which the cube is pushed until the largest ball in the overlap has a given
radius (−s*, which does not depend on the contact's model). So the path is continuous, and where the answer is not, the contact
is the cause. A jump is told from a steep rise by halving: steps with the largest change are halved again and again; the
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
)

from .scenes import Pair, Placing, deep

__all__ = ['Scan', 'Smoothness', 'Zoom', 'change', 'forceUnit', 'halvings', 'quantities', 'scan', 'smoothness', 'warmAnswers', 'zoom']

quantities = ('point', 'normal', 'force')
halvings = 24
"""Number of times that a step of the path is halved, by default: to motions of some 1e-10 edges."""

rounding = 1e-9
"""Changes below this are not told from rounding."""


def change(a, b):
	"""Change of point [edges], normal [rad] and force between two answers."""
	point, normal, force = np.linalg.norm(b - a, axis=1)
	return np.array([point, 2 * math.asin(min(normal / 2, 1)), force])


def besideOnItsLine(a, b):
	"""Answer *a* with its point moved along its line of action to beside that of *b*: where on that line it is changes nothing."""
	point, normal, force = a
	return np.array([point + (b[0] - point).dot(normal) * normal, normal, force])


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


def scan(path, steps, how, planes='plain', overlap=1.0):
	"""All variants' answers along a path.

	:param dict how: {name: arguments of the contact}, as `variants`
	:param float overlap: factor on the path's
	"""
	placing = Placing(overlap)
	t = np.linspace(0, 1, steps + 1)
	poses = [placing.pose(path, x) for x in t]
	motion = np.array([placing.motion(a, b) for a, b in itertools.pairwise(poses)])
	pairs = {name: Pair(variant, planes) for name, variant in how.items()}
	return Scan(
		path,
		overlap,
		planes,
		how,
		t,
		poses,
		motion,
		{name: np.array([pair.answer(pose) for pose in poses]) for name, pair in pairs.items()},
	)


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
		"""Limit of the change as the motion tends to zero."""
		return float(self.change[-1]) if self.growth > 0.5 and self.change[-1] > rounding else 0.0


@dataclasses.dataclass
class Smoothness:
	"""Smoothness of one quantity on one path.

	:ivar float jump: the largest jump; 0 without any
	:ivar float rate: largest change per motion; infinite with a jump
	:ivar Zoom worst: where it was found
	"""

	jump: float
	rate: float
	worst: Zoom


def smoothness(zooms):
	"""Smoothness of one quantity, from its zooms."""
	jump = max(zooms, key=lambda one: one.jump)
	if jump.jump > 0:
		return Smoothness(jump.jump, math.inf, jump)
	steep = max(zooms, key=lambda one: one.rate.max())
	return Smoothness(0.0, float(steep.rate.max()), steep)


def zoom(found, name, places=6, depth=halvings, force=None):
	"""[Zooms of point, normal and force] of a scan's variant, about the *places* steps with the largest change and with the largest rate.

	:param float force: unit of the force, over stiffness; default the variant's mean on this path
	"""
	placing, pair = Placing(found.overlap), Pair(found.how[name], found.planes)
	answers = found.answers[name]
	unit = np.array([1, 1, force or forceUnit(answers)])
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
	perArea = found.how[name]['contactModel'] == 'foundation'
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
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)],
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
		answers.append(np.array([geom.contactPoint, geom.normal, pair.force(geom.penetrationDepth, geom.contactArea) * geom.normal]))
	O.reset()
	return np.array(answers)
