# SPDX-License-Identifier: GPL-2.0-or-later
"""A cube let go on a slope of one piece or of many, on a wall, or with an edge on a flat floor: where theory has one answer."""

import dataclasses
import math

import numpy as np
from yade import O, Quaternion, RockJointMat, Vector3, utils
from yade.polytope import cuboid, fromVertices

from .engines import jointEngines

__all__ = ['CubeOnSlope', 'edgeNormal', 'slopeFloors', 'wallKick']

slopeFloors = ('slab', 'facet', 'tiles', 'facets')
"""One block, one facet, ten flush blocks, forty facets."""

density, gravity = 2600.0, 9.81


@dataclasses.dataclass
class CubeOnSlope:
	"""A cube that lies flat on a slope and is let go. `CubeOnSlope(...).build()`.

	With the slope α and the friction angle φ it slides down s = ½ g (sin α − tan φ cos α) t².
	"""

	floor: str = 'slab'
	"""One of `slopeFloors`."""
	slope: float = math.radians(45)
	frictionAngle: float = math.radians(25)
	half: float = 0.05
	"""Half of its edge [m]."""
	stiffness: float = None
	"""[N/m], or [Pa/m] where perArea; default 1e6 N/m, 1e8 Pa/m: the same for the whole face."""
	perArea: bool = False
	ig2: dict = dataclasses.field(default_factory=dict)
	normalDamping: float = 0.3
	rockingDamping: float = 0.0
	timeStepFraction: float = 0.05

	def build(self):
		if self.floor not in slopeFloors:
			raise ValueError(f'floor: must be one of {slopeFloors}, got {self.floor!r}')
		O.reset()
		k = self.stiffness or (1e8 if self.perArea else 1e6)
		O.materials.append(RockJointMat(density=density, normalStiffness=k, shearStiffness=k * 2 / 3, frictionAngle=self.frictionAngle))
		self.down = np.array([math.cos(self.slope), 0, -math.sin(self.slope)])
		self.up = np.array([math.sin(self.slope), 0, math.cos(self.slope)])
		self.floorIds = O.bodies.append(list(self._floor()))
		cube = cuboid(self.up * self.half, (self.half,) * 3, Quaternion((0, 1, 0), self.slope))
		self.cube = O.bodies[O.bodies.append(cube)]
		jointEngines(
			self.ig2,
			self.perArea,
			(0, 0, -gravity),
			normalDamping=self.normalDamping,
			shearDamping=0.3,
			rockingDamping=self.rockingDamping,
		)
		whole = k * (4 * self.half**2 if self.perArea else 1)
		O.dt = self.timeStepFraction * math.sqrt(cube.state.mass / whole)
		return self

	def _floor(self):
		if self.floor == 'slab':
			yield self._slab(-0.2, 4.0)
		elif self.floor == 'facet':
			yield utils.facet([self._at(*uv) for uv in ((-2, -3), (6, 0), (-2, 3))])
		ends = [-0.2 + 0.4 * k for k in range(11)] if self.floor in ('tiles', 'facets') else []
		for a, b in zip(ends, ends[1:], strict=False):
			if self.floor == 'tiles':
				yield self._slab(a, b)
				continue
			for left, right in ((-0.5, 0.03), (0.03, 0.5)):
				yield utils.facet([self._at(a, left), self._at(b, left), self._at(b, right)])
				yield utils.facet([self._at(a, left), self._at(b, right), self._at(a, right)])

	def _at(self, along, aside, below=0.0):
		return Vector3(*(self.down * along - self.up * below + np.array([0, aside, 0])))

	def _slab(self, begin, end):
		return fromVertices([self._at(u, v, w) for u in (begin, end) for v in (-0.5, 0.5) for w in (0, 0.1)], fixed=True)

	def distanceInTheory(self, time):
		"""[m]"""
		return 0.5 * gravity * (math.sin(self.slope) - math.tan(self.frictionAngle) * math.cos(self.slope)) * time**2

	def slide(self, time):
		"""Distance slid after *time* seconds, and distance across the slope's dip [m]."""
		while O.time < time:
			O.step()
		way = np.array(self.cube.state.pos) - self.up * self.half
		# to the very time: a step is 1e-5 of it
		late = O.time - time
		return float(way @ self.down) - late * float(np.array(self.cube.state.vel) @ self.down), float(way[1])


def _floorUnderEdge(kind):
	"""A flat floor at z = 0, of any shape of YADE's."""
	if kind == 'polytope':
		return cuboid((0, 0, -0.1), (1, 1, 0.1), fixed=True)
	if kind == 'wall':
		return utils.wall(0, 2, sense=1)
	if kind == 'box':
		return utils.box((0, 0, -0.1), (1, 1, 0.1), fixed=True)
	return utils.facet([(-3, -2, 0), (3, -2, 0), (0, 4, 0)])


def edgeNormal(turn, overlap=1e-4, floor='polytope', ig2=None):
	"""Angle of the contact normal off the vertical where a cube turned by *turn* about an edge lies on a flat floor [rad]; theory: 0.

	:param float turn: [rad]
	:param float overlap: of the edge [m]; the cube is 0.1 m wide
	:param str floor: 'polytope', 'wall', 'box' or 'facet'
	"""
	O.reset()
	O.materials.append(RockJointMat(density=density, normalStiffness=1e6, shearStiffness=1e6, frictionAngle=0.5))
	O.bodies.append(_floorUnderEdge(floor))
	height = 0.05 * (math.sin(turn) + math.cos(turn)) - overlap
	O.bodies.append(cuboid((0, 0, height), (0.05,) * 3, Quaternion((0, 1, 0), turn)))
	jointEngines(ig2 or {}, False, (0, 0, 0))
	O.dt = 1e-9
	O.step()
	return math.acos(min(1.0, abs(O.interactions[0, 1].geom.normal[2])))


def wallKick(ig2=None, perArea=False, turn=0.35, floor='wall', duration=0.5):
	"""Largest sideways speed of a tilted cube dropped on a frictionless floor [m/s]; theory: 0. It falls 0.01 m and rebounds, damped."""
	O.reset()
	k = 1e8 if perArea else 1e6
	O.materials.append(RockJointMat(density=density, normalStiffness=k, shearStiffness=k * 2 / 3, frictionAngle=0))
	O.bodies.append(_floorUnderEdge(floor))
	height = 0.05 * (math.sin(turn) + math.cos(turn)) + 0.01
	cube = O.bodies[O.bodies.append(cuboid((0, 0, height), (0.05,) * 3, Quaternion((0, 1, 0), turn)))]
	ig2 = ig2 or {}
	jointEngines(ig2, perArea, (0, 0, -gravity), normalDamping=0.3, shearDamping=0.3)
	O.dt = 0.05 * math.sqrt(cube.state.mass / 1e6)
	most = 0.0
	while O.time < duration:
		O.step()
		most = max(most, math.hypot(cube.state.vel[0], cube.state.vel[1]))
	return most
