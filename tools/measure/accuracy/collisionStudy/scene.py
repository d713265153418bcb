# SPDX-License-Identifier: GPL-2.0-or-later
"""Common to the studies of collisions' energy: the contact, materials and engines; and a body that turns freely."""

import dataclasses
import math

from yade import (
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	Bo1_Wall_Aabb,
	ForceResetter,
	FrictMat,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Sphere_ScGeom,
	Ig2_Wall_Sphere_ScGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	NewtonIntegrator,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
)
from yade.polytope.bodies.polytopes import cuboid

__all__ = ['Contact', 'EnergyScene', 'freeFlight']


@dataclasses.dataclass(frozen=True)
class Contact:
	"""How bodies touch."""

	model: str = 'surface'
	"""A contactModel, 'perArea' (boon2012 with a stiffness per contact area) or 'spheres' (YADE's own)."""
	corner: float = 0.1
	"""Corner radius over the inscribed radius, of boon2012."""
	contactDamping: float = 0
	"""Of the contact's normal, fraction of critical."""
	damping: float = 0
	"""YADE's own: NewtonIntegrator.damping."""


class EnergyScene:
	"""What both studies share: materials, engines, and data for exchanging the shapes for YADE's own.

	:ivar float half: half a period of the contact, π √(m/k): the time of a central impact [s]
	"""

	size, density, frictionAngle, stiffnessRatio, verletFraction = 1.0, 1.0, 0.0, 1.0, 0.0

	def begin(self, how, stiffness, reducedMass, steps):
		O.reset()
		self.how, self.normalStiffness, self.damping, self.contactDamping = how, stiffness, how.damping, how.contactDamping
		self.half = math.pi * math.sqrt(reducedMass / stiffness)
		self.timeStep = self.half / steps
		if how.model == 'spheres':
			# Ip2_FrictMat_FrictMat_FrictPhys: kn = 2 E1 R1 E2 R2 / (E1 R1 + E2 R2)
			O.materials.append(FrictMat(density=self.density, young=stiffness / self.radius, poisson=1, frictionAngle=0))
			return
		# per area: as on a tenth of a cube's face
		stiffness *= 10 if how.model == 'perArea' else 1
		O.materials.append(RockJointMat(density=self.density, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0))

	def makeEngines(self):
		if self.how.model == 'spheres':
			bounds = [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]
			self.interactionLoop = InteractionLoop(
				[Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
				[Ip2_FrictMat_FrictMat_FrictPhys()],
				[Law2_ScGeom_FrictPhys_CundallStrack()],
			)
		else:
			bounds, perArea = [Bo1_Polytope_Aabb()], self.how.model == 'perArea'
			self.interactionLoop = InteractionLoop(
				[Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012' if perArea else self.how.model)],
				[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)],
				[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=self.contactDamping)],
			)
		O.engines = [
			ForceResetter(),
			InsertionSortCollider(bounds, verletDist=0),  # pairs are searched for in each step
			self.interactionLoop,
			NewtonIntegrator(damping=self.damping, gravity=(0, 0, -self.gravity)),
		]
		O.dt = self.timeStep

	def rounded(self, body):
		body.shape.cornerRadius = self.how.corner * body.shape.inscribedRadius
		return body


def freeFlight(half, turn, steps):
	"""A box of half-lengths *half* turns freely by *turn* radians a step. Returns the relative changes of its rotational energy
	and of its angular momentum's size, as YADE keeps it."""
	O.reset()
	O.materials.append(RockJointMat(density=1))
	box = cuboid((0, 0, 0), half, Quaternion((1, 2, 3), 1))
	O.bodies.append(box)
	state = box.state
	spin = Vector3(0.6, 0.64, 0.48)
	state.angVel = state.ori * spin
	state.angMom = state.ori * Vector3(*[state.inertia[k] * spin[k] for k in range(3)])
	O.engines = [ForceResetter(), NewtonIntegrator(damping=0)]
	O.dt = turn

	def now():
		# equal moments: YADE does not use angMom
		momentum = state.ori.conjugate() * state.angMom if box.aspherical else state.inertia[0] * state.angVel
		return sum(momentum[k] ** 2 / state.inertia[k] for k in range(3)) / 2, momentum.norm()

	before = now()
	O.run(steps, True)
	return [abs(b / a - 1) for a, b in zip(before, now(), strict=True)]
