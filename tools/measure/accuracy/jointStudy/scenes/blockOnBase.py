# SPDX-License-Identifier: GPL-2.0-or-later
"""One block on a plane: the plane is tilted, or shaken, or the block rocks on it (Goodman & Bray 1976, Housner 1963).

The plane runs along x. In 2-D y is up, in 3-D z. Positive tilts, turns and ways are towards +x, the toe's side.
"""

import dataclasses
import math

from yade import O, Quaternion, RockJointMat, Vector3
from yade.polytope import cuboid, polygon

from .engines import jointEngines

__all__ = ['BlockOnBase', 'RockingBlock', 'ShakenBlock', 'TiltedBlock', 'Verdict']


@dataclasses.dataclass
class Verdict:
	"""Response of a block to a tilt or an acceleration."""

	mode: str
	"""'stands', 'slides' or 'topples'."""
	turn: float
	"""Rotation of the block since the start [rad]."""
	way: float
	"""Way of its centre along the base, less what turning about the toe gives [m]."""

	@property
	def stands(self):
		return self.mode == 'stands'


@dataclasses.dataclass
class BlockOnBase:
	"""A block at rest on a long fixed plate. `BlockOnBase(...).build()`."""

	width: float = 0.4
	height: float = 1.0
	depth: float = 0.5
	"""Depth along the third axis [m]; for polygons it is their thickness."""
	dimension: int = 2
	frictionAngle: float = math.radians(35)
	stiffness: float = 1e11
	"""Normal and shear: [Pa/m] where perArea, else [N/m]."""
	perArea: bool = False
	ig2: dict = dataclasses.field(default_factory=dict)
	density: float = 2600
	gravity: float = 9.81
	damping: float = 0.4
	contactDamping: float = 0.3
	rockingDamping: float = 0.0
	timeStepFraction: float = 0.2
	"""Time step over √(m/k)."""

	def build(self, tilt=0.0):
		"""The block turned by *tilt* about its toe [rad], which lies as deep in the base as carries the weight."""
		O.reset()
		O.materials.append(
			RockJointMat(
				density=self.density, normalStiffness=self.stiffness, shearStiffness=self.stiffness, frictionAngle=self.frictionAngle
			)
		)
		b, h = self.width, self.height
		self.mass = self.density * b * h * self.depth
		kn = self.stiffness * (b * self.depth if self.perArea else 1)
		overlap = self._startingOverlap(kn, tilt)
		# the toe is the origin of the turn
		x = b / 2 - (b * math.cos(tilt) - h * math.sin(tilt)) / 2
		up = (h * math.cos(tilt) + b * math.sin(tilt)) / 2 - overlap
		self._builtUpward = self.vector(math.sin(tilt), math.cos(tilt))
		self.base, self.block = (O.bodies[O.bodies.append(body)] for body in self._bodies(x, up, tilt))
		self.integrator = jointEngines(
			self.ig2,
			self.perArea,
			self.vector(0, -self.gravity),
			damping=self.damping,
			verlet=0.02 * b,
			normalDamping=self.contactDamping,
			shearDamping=self.contactDamping,
			rockingDamping=self.rockingDamping,
		)
		O.dt = self.timeStepFraction * math.sqrt(self.mass / kn)
		self._startTurn, self._startToe = self.turn, self._toe()
		return self

	def _startingOverlap(self, kn, tilt):
		return self.mass * self.gravity / kn

	def _bodies(self, x, up, tilt):
		b, h, d = self.width, self.height, self.depth
		if self.dimension == 3:
			yield cuboid((0, 0, -0.5), (5, 2, 0.5), fixed=True)
			yield cuboid((x, 0, up), (b / 2, d / 2, h / 2), Quaternion((0, 1, 0), tilt))
			return
		c, s = math.cos(tilt), math.sin(tilt)
		yield polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], thickness=d, fixed=True)
		corners = [(i * b / 2, j * h / 2) for i in (-1, 1) for j in (-1, 1)]
		yield polygon([(x + c * u + s * v, up - s * u + c * v) for u, v in corners], thickness=d)

	def vector(self, along, up):
		return Vector3(along, 0, up) if self.dimension == 3 else Vector3(along, up, 0)

	@property
	def upward(self):
		"""Number of the axis that points up."""
		return 2 if self.dimension == 3 else 1

	@property
	def turn(self):
		"""Rotation of the block towards its toe, from upright, [rad]: where its own upward edge points."""
		# the body's own axes are principal ones: what is turned is what was there at the start
		state = self.block.state
		turned = state.ori * (state.refOri.conjugate() * self._builtUpward)
		return math.atan2(turned[0], turned[self.upward])

	def _toe(self):
		"""Place of the toe along the base [m]."""
		turn = self.turn
		centre = self.block.state.pos[0] - self.base.state.pos[0]
		return centre + (self.width * math.cos(turn) - self.height * math.sin(turn)) / 2


@dataclasses.dataclass
class LoadedBlock(BlockOnBase):
	"""A block at rest to which a load is applied: the part that tilting and shaking have in common."""

	turnLimit: float = math.radians(0.5)
	"""A block turned by more has toppled: beyond the turn at which an elastic joint carries most. [rad]"""
	wayLimit: float = 1e-3
	"""A block whose toe has moved farther has slid [m]."""
	driftLimit: float = 5e-5
	"""A block whose toe still creeps faster when the time is over slides, however little it has moved [m/s]."""

	def apply(self, load, ramp=0.5, most=5.0):
		"""Builds the scene, raises the load (the tangent of a tilt, or an acceleration over gravity's) and holds it.

		:param float ramp: time over which the load rises, with a tangent of zero at the end [s]
		:param float most: how long it is held at most [s]: near the critical load a block turns slowly, and one that stands rocks for long
		:returns: :yref:`Verdict`
		"""
		self.build()
		settling = O.time + 300 * O.dt
		while O.time < settling:
			O.step()
		self._startTurn, self._startToe, begun = self.turn, self._toe(), O.time
		looked = self.verdict()
		lookAgain = begun + ramp
		while O.time - begun < ramp + most:
			for _ in range(100):
				part = min((O.time - begun) / ramp, 1)
				self._load(load * part * (2 - part))
				O.step()
			last = self.verdict()
			if not last.stands:
				return last
			if O.time > lookAgain + 0.2:
				drift = abs(last.way - looked.way) / (O.time - lookAgain)
				if drift < self.driftLimit and self._atRest():
					return last
				looked, lookAgain = last, O.time
		return last if drift < self.driftLimit else dataclasses.replace(last, mode='slides')

	def verdict(self):
		turn, way = self.turn - self._startTurn, self._toe() - self._startToe
		mode = 'topples' if turn > self.turnLimit else 'slides' if way > self.wayLimit else 'stands'
		return Verdict(mode, turn, way)

	def _atRest(self):
		"""Slower than a ten thousandth of what a hundredth of gravity would do to it within a second."""
		state = self.block.state
		speed = (state.vel - self.base.state.vel).norm()
		return max(speed, state.angVel.norm() * self.height) < 1e-6 * self.gravity

	def _load(self, load):
		raise NotImplementedError


@dataclasses.dataclass
class TiltedBlock(LoadedBlock):
	"""The load is the tangent of the tilt: gravity turns, the plane stays."""

	def _load(self, load):
		tilt = math.atan(load)
		self.integrator.gravity = self.vector(self.gravity * math.sin(tilt), -self.gravity * math.cos(tilt))


@dataclasses.dataclass
class ShakenBlock(LoadedBlock):
	"""The load is the acceleration of the base away from the toe, over that of gravity; the base itself moves.

	YADE's own damping would act on the common motion, too: it is left out."""

	damping: float = 0.0
	contactDamping: float = 0.5
	rockingDamping: float = 0.5

	def build(self, tilt=0.0):
		super().build(tilt)
		# a base that a force accelerates moves in step with the block, one whose velocity a script sets half a step before or behind it
		self.base.state.mass = 1e12 * self.mass
		self.base.state.blockedDOFs = 'yzXYZ'
		return self

	def _load(self, load):
		O.forces.setPermF(self.base.id, self.vector(-load * self.gravity * self.base.state.mass, 0))


@dataclasses.dataclass
class RockingBlock(BlockOnBase):
	"""A block tilted about its toe and let go (Housner 1963)."""

	width: float = 0.2
	frictionAngle: float = math.radians(60)
	damping: float = 0.0

	def fall(self, tilt):
		"""Builds the block turned by *tilt* and lets go of it; returns the time until it is upright [s], a quarter of the period."""
		self.build(tilt)
		before, begun = self.turn, O.time
		while O.time - begun < 10 * math.sqrt(self.height / self.gravity):
			O.step()
			now = self.turn
			if now <= 0:
				return O.time - begun - O.dt * now / (now - before)
			before = now
		return math.inf
