# SPDX-License-Identifier: GPL-2.0-or-later
"""A regular solid that rolls down a slope of one plate, or of several that lie flush: the path must be the same."""

import dataclasses
import math

import numpy as np
from yade import Matrix3, O, Quaternion, RockJointMat, Vector3
from yade.polytope import fromVertices, regular

from .engines import jointEngines

__all__ = ['RollingSolid']


@dataclasses.dataclass
class RollingSolid:
	"""`RollingSolid(...).build()`. The slope falls along +x; seams run across it."""

	faces: int = 12
	plates: int = 10
	"""Number of plates of equal length, which lie flush."""
	slope: float = math.radians(25)
	frictionAngle: float = math.radians(35)
	radius: float = 0.1
	"""Circumradius [m]."""
	length: float = 4.0
	"""Length of the whole slope [m]."""
	seamAngle: float = 0.0
	"""Angle of the seams with the slope's strike [rad]."""
	stiffness: float = None
	"""[N/m], or [Pa/m] where perArea."""
	perArea: bool = False
	ig2: dict = dataclasses.field(default_factory=dict)
	speed: float = 1.0
	"""Speed at the start, along the slope [m/s]; the solid rolls at this speed."""
	yaw: float = 0.0
	"""Rotation of the solid about the slope's normal [rad]; 0: an edge of the face that it lies on is level, and its motion symmetric."""
	contactDamping: float = 0.3
	density: float = 2600
	timeStepFraction: float = 0.1

	def build(self):
		O.reset()
		k = self.stiffness or (1e9 if self.perArea else 1e7)
		O.materials.append(
			RockJointMat(density=self.density, normalStiffness=k, shearStiffness=k * 2 / 3, frictionAngle=self.frictionAngle)
		)
		self.down = np.array([math.cos(self.slope), 0, -math.sin(self.slope)])
		self.up = np.array([math.sin(self.slope), 0, math.cos(self.slope)])
		ends = np.linspace(-0.2, self.length - 0.2, self.plates + 1)
		skew = math.tan(self.seamAngle)
		for a, b in zip(ends, ends[1:], strict=False):
			corners = [self._at(u + skew * v, v, w) for u in (a, b) for v in (-1, 1) for w in (0, 0.2)]
			O.bodies.append(fromVertices(corners, fixed=True))
		body = regular(self.faces, self.radius)
		turn = Quaternion(Vector3(*self.up), self.yaw) * self._flat(body)
		centre = self.up * (max(body.shape.offsets) * (1 - 1e-6))
		solid = regular(
			self.faces, self.radius, centre, turn, velocity=self.down * self.speed, angularVelocity=(0, self.speed / self.radius, 0)
		)
		self.solid = O.bodies[O.bodies.append(solid)]
		jointEngines(
			self.ig2,
			self.perArea,
			(0, 0, -9.81),
			verlet=0.1 * self.radius,
			normalDamping=self.contactDamping,
			shearDamping=self.contactDamping,
		)
		O.dt = self.timeStepFraction * math.sqrt(self.solid.state.mass / 1e7)
		return self

	def _flat(self, body):
		"""The turn that puts a face of a body at the origin on the slope, with one of its edges along y."""
		toWorld = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
		normal = toWorld @ np.array(body.shape.normals[0], float)
		corners = np.array(body.shape.vertices, float) @ toWorld.T
		on = corners[corners @ normal > (1 - 1e-9) * (corners @ normal).max()]
		nearest = on[np.argsort(np.linalg.norm(on - on[0], axis=1))[1]]
		edge = (nearest - on[0]) / np.linalg.norm(nearest - on[0])
		before = np.column_stack([np.cross(edge, normal), edge, normal])
		down = -self.up
		after = np.column_stack([np.cross((0, 1, 0), down), (0, 1, 0), down])
		return Quaternion(Matrix3(*(after @ before.T).ravel())) * body.state.ori

	def _at(self, along, aside, below):
		return tuple(self.down * along - self.up * below + np.array([0, aside, 0]))

	def path(self, time, points=50):
		"""(points, 3): along the slope, across its dip, above it [m], at equal times."""
		found = []
		for k in range(1, points + 1):
			while O.time < time * k / points:
				O.step()
			p = np.array(self.solid.state.pos)
			found.append((p @ self.down, p[1], p @ self.up))
		return np.array(found)
