# SPDX-License-Identifier: GPL-2.0-or-later
"""One body on a level floor, in units that make runs short: the scene of all measurements on floors made of flush pieces."""

import dataclasses
import math

import numpy as np
from yade import (
	Bo1_Box_Aabb,
	Bo1_Facet_Aabb,
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	Bo1_Wall_Aabb,
	ForceResetter,
	Ig2_Box_Polytope_PolytopeGeom,
	Ig2_Box_Sphere_ScGeom,
	Ig2_Facet_Polytope_PolytopeGeom,
	Ig2_Facet_Sphere_ScGeom,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Polytope_PolytopeGeom,
	Ig2_Wall_Polytope_PolytopeGeom,
	Ig2_Wall_Sphere_ScGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	Quaternion,
	RockJointMat,
	Vector3,
)
from yade.polytope.bodies.clumps import clump
from yade.polytope.scene.timeStep import stableTimeStep

from .flatBodies import lyingBody, planarBodies
from .floors import Floor

__all__ = ['SurfaceScene']

otherPairs = (
	Ig2_Sphere_Polytope_PolytopeGeom,
	Ig2_Wall_Polytope_PolytopeGeom,
	Ig2_Box_Polytope_PolytopeGeom,
	Ig2_Facet_Polytope_PolytopeGeom,
)
boxesOfShapes = Bo1_Polytope_Aabb, Bo1_Sphere_Aabb, Bo1_Wall_Aabb, Bo1_Box_Aabb, Bo1_Facet_Aabb


@dataclasses.dataclass
class SurfaceScene:
	"""A body with a face down on a floor. Make it with `SurfaceScene(…).build()`, then `settle()`.

	Stiffness follows from the depth at rest on one piece, a two-thousandth of half a metre, which is that of a rock or concrete
	joint under a block of this size in ordinary simulations; a step of 0.15/ω is then 0.5 to 1 ms, and a second of motion a
	thousand steps or two. Both stiffness rules have the same depth at rest on one piece.
	"""

	floor: str = 'plates'
	"""One of floors.floorKinds."""
	body: str = 'cube'
	"""One of flatBodies.bodyKinds."""
	contact: dict = dataclasses.field(default_factory=dict)
	"""Attributes of all Ig2_*_PolytopeGeom, such as dict(contactModel='boon2012')."""
	perArea: bool = False
	"""Stiffness per area [Pa/m] instead of per contact [N/m]."""
	pieces: Floor = dataclasses.field(default_factory=Floor)
	clumped: bool = False
	"""Pieces are the parts of one fixed clump, made by polytope.clump; polytopes only."""
	friction: float = 0.0
	"""Coefficient μ."""
	incline: float = 0.0
	"""Angle by which gravity leans towards the direction of motion [rad]: the floor stays level."""
	heading: float = 0.0
	"""Angle of the direction of motion from x [rad]; joints across x then lie at 90° less this angle to it."""
	yaw: float = 0.0
	"""Angle of the body about the vertical from the direction of motion [rad]."""
	tilt: Quaternion = dataclasses.field(default_factory=lambda: Quaternion.Identity)
	"""Turns the body last of all, about its centroid."""
	held: bool = False
	"""The body does not turn: tilted, it slides on an edge or a vertex."""
	turn: Quaternion = dataclasses.field(default_factory=lambda: Quaternion.Identity)
	"""Rotation of the whole scene, gravity included: nothing is then along the axes. Not for walls; polygons turn about z alone."""
	at: tuple = (0.0, 0.13)
	"""x and y of the body's centroid [m]; polygons read x alone."""
	depth: float = 2.5e-4
	"""Depth at rest on one piece [m]."""
	law: dict = dataclasses.field(default_factory=lambda: {'normalDamping': 0.3})
	"""Attributes of Law2_PolytopeGeom_RockJointPhys_MohrCoulomb; rocking is undamped by default."""
	shearRatio: float = 2 / 3
	"""Shear over normal stiffness."""
	stepFraction: float = 0.15
	"""Time step over 1/ω of the body on its contacts at rest (yade.polytope.stableTimeStep): stable when it lies on more pieces later."""
	density: float = 2000
	gravity: float = 9.81

	def build(self):
		O.reset()
		material = RockJointMat(density=self.density, frictionAngle=math.atan(self.friction))
		O.materials.append(material)
		self.lying = lyingBody(self.body, material, self.heading, self.yaw, self.tilt)
		self.mass = self.lying.body.state.mass
		self.stiffness = self.mass * self.gravity / self.depth
		perUnit = self.stiffness / self._referenceArea() if self.perArea else self.stiffness
		material.normalStiffness, material.shearStiffness = perUnit, perUnit * self.shearRatio
		self.planar = self.body in planarBodies
		self.up = np.array([0.0, 1.0, 0.0] if self.planar else [0.0, 0.0, 1.0])
		self.along = np.array([math.cos(self.heading), math.sin(self.heading), 0.0])
		self.across = np.cross(self.up, self.along)
		made = self.pieces.pieces(self.floor)
		for piece in made:
			self._turned(piece)
		if self.clumped:
			clump(made)
		else:
			O.bodies.append(made)
		self.moving = self.lying.body
		self.moving.state.pos = Vector3(*self._start())
		self._turned(self.moving)
		if self.held:
			self.moving.state.blockedDOFs = 'XYZ'
		self.placed = Quaternion(self.moving.state.ori)
		self.id = O.bodies.append(self.moving)
		self._engines()
		O.dt = 0.1 * math.sqrt(self.mass / self.stiffness)
		return self

	def _referenceArea(self):
		"""Area of the body's lowest face; where an edge or a vertex is lowest, that of the face it would lie on."""
		return self.lying.area or lyingBody(self.body).area

	def _start(self):
		place = np.array([self.at[0], 0.0 if self.planar else self.at[1], 0.0])
		return place + self.up * (self.lying.height - self.depth)

	def _turned(self, body):
		body.state.pos, body.state.ori = self.turn * body.state.pos, self.turn * body.state.ori
		body.state.refPos, body.state.refOri = body.state.pos, body.state.ori

	def _engines(self):
		pull = self.gravity * (math.sin(self.incline) * self.along - math.cos(self.incline) * self.up)
		self.functors = [Ig2_Polytope_Polytope_PolytopeGeom(**self.contact), *(kind() for kind in otherPairs)]
		self.newton = NewtonIntegrator(gravity=self.turn * Vector3(*pull), damping=0)
		self.lawFunctor = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(**self.law)
		# YADE's own pairs, for the sphere on facets, boxes and walls
		peers = [Ig2_Facet_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()]
		O.engines = [
			ForceResetter(),
			PolytopeCollider([box() for box in boxesOfShapes], verletDist=0.02),
			InteractionLoop(
				[*self.functors, *peers],
				[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=self.perArea)],
				[self.lawFunctor, Law2_ScGeom_FrictPhys_CundallStrack()],
			),
			self.newton,
		]

	def settle(self, periods=40):
		"""Brings the body to rest, held against an incline, then sets the time step from the contacts there are.

		:param float periods: time this takes over √(m/k)
		"""
		state, pull = self.moving.state, Vector3(self.newton.gravity)  # a copy: YADE returns a reference
		self.newton.gravity = self.turn * Vector3(*(-self.gravity * math.cos(self.incline) * self.up))
		self.newton.damping = 0.3
		self.advance(3 * O.dt)  # makes the contacts
		self.timeStep()
		self.advance(periods * math.sqrt(self.mass / self.stiffness))
		self.newton.gravity, self.newton.damping = pull, 0
		state.vel = state.angVel = state.angMom = Vector3(0, 0, 0)
		self.timeStep()
		return self

	def release(self, time):
		"""Runs for so long [s] from where the body was placed, slightly damped."""
		self.newton.damping = 0.1
		self.advance(3 * O.dt)
		self.timeStep()
		self.advance(time)

	def timeStep(self):
		"""Sets O.dt for the present contacts."""
		limit = 0.15 * math.sqrt(self.mass / self.stiffness)
		O.dt = min(limit, stableTimeStep(self.stepFraction, default=limit))

	def push(self, speed):
		"""Gives the body this speed along the direction of motion [m/s]."""
		self.moving.state.vel = self.turn * Vector3(*(speed * self.along))

	def advance(self, time):
		"""Runs for so long [s]."""
		self.steps(max(1, round(time / O.dt)))

	def steps(self, number):
		for _ in range(number):
			O.step()  # O.run(…, True) checks for its end only every 40 ms

	@property
	def position(self):
		"""Place of the centroid: along the motion from the origin, to its left, up [m]."""
		return self._components(self.turn.conjugate() * self.moving.state.pos)

	@property
	def velocity(self):
		return self._components(self.turn.conjugate() * self.moving.state.vel)

	@property
	def spin(self):
		"""Angular velocity in the same axes [rad/s]."""
		return self._components(self.turn.conjugate() * self.moving.state.angVel)

	def _components(self, vector):
		return np.array([np.array(vector, float) @ axis for axis in (self.along, self.across, self.up)])

	@property
	def leaning(self):
		"""Angle of the body from how it was placed, about level axes [rad]."""
		up = self.turn * Vector3(*self.up)
		now = self.moving.state.ori * (self.placed.conjugate() * up)
		return math.acos(max(-1.0, min(1.0, float(now.dot(up)))))

	def corners(self):
		"""Corners of the body, in the same axes as the position [m]."""
		state = self.moving.state
		return np.array([self._components(self.turn.conjugate() * (state.pos + state.ori * v)) for v in self.moving.shape.vertices])

	@property
	def failures(self):
		return sum(functor.stats()['failures'] for functor in self.functors)

	@property
	def touching(self):
		"""Contacts of the body at present."""
		return sum(contact.isReal for contact in O.interactions)
