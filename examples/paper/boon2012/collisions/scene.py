# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation F of the paper: one block falls onto a fixed one, vertex on face or edge on edge."""

import dataclasses
import json
import math

from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	Quaternion,
	RockJointMat,
)
from yade.polytope.bodies.polytopes import cuboid

__all__ = ['Block', 'Collision', 'readBlocks']


@dataclasses.dataclass
class Block:
	"""A rectangular block and where it stands."""

	halfLengths: tuple = (0.5, 0.5, 0.5)
	"""Half lengths along its own axes [m]."""
	position: tuple = (0, 0, 0)
	"""Position of its centre [m]."""
	orientation: tuple = (1, 0, 0, 0)
	"""Unit quaternion (w, x, y, z)."""


def readBlocks(path, name):
	"""(fixed, free) blocks of the collision *name* from a JSON file {name: {fixed: {halfLengths, position, orientation}, free: {…}}}.

	:raises ValueError: naming what the file lacks
	"""
	with open(path) as file:
		content = json.load(file)
	try:
		return tuple(Block(**{key: tuple(value) for key, value in content[name][which].items()}) for which in ('fixed', 'free'))
	except KeyError as error:
		raise ValueError(f'{path}: there is no {error} for the collision {name!r}') from None
	except TypeError as error:
		raise ValueError(f'{path}: {name}: {error}') from None


@dataclasses.dataclass
class Collision:
	"""A free block falls onto a fixed one (simulation F of Boon et al. 2012, Figs 12 and 13). `Collision(fixed, free).build()`.

	The paper gives no sizes and no parameters; those here are our choice.
	"""

	fixed: Block
	free: Block
	density: float = 2000
	normalStiffness: float = 1e8
	"""Normal stiffness of the contact [N/m]."""
	shearStiffness: float = 1e8
	frictionCoefficient: float = 1
	contactDamping: float = 1
	"""Damping of the contact, normal and shear, fraction of critical."""
	shearDamping: float = None
	"""Damping of the contact's shear alone, where it differs from *contactDamping*."""
	damping: float = 0.3
	"""YADE's own: NewtonIntegrator.damping."""
	dampGravity: bool = True
	"""Whether YADE's damping acts on gravity too, so on free flight (NewtonIntegrator.dampGravity)."""
	gravity: float = 9.81
	cornerRadius: float = 0.05
	timeStep: float = 8.944e-5
	"""0.02 sqrt(mass / normalStiffness) for the unit cube. [s]"""
	contactPoint: str = 'analyticCentre'
	contactModel: str = 'boon2012'
	"""'boon2012', 'surface', 'foundation' or 'spring'; the last three do not read *contactPoint*."""

	# what build() made
	fixedId: int = dataclasses.field(default=-1, init=False)
	freeId: int = dataclasses.field(default=-1, init=False)

	def build(self):
		O.reset()
		shearDamping = self.contactDamping if self.shearDamping is None else self.shearDamping
		O.materials.append(
			RockJointMat(
				density=self.density,
				normalStiffness=self.normalStiffness,
				shearStiffness=self.shearStiffness,
				frictionAngle=math.atan(self.frictionCoefficient),
			)
		)
		self.fixedId = O.bodies.append(self._body(self.fixed, color=(0.86, 0.86, 0.84), fixed=True))
		self.freeId = O.bodies.append(self._body(self.free, color=(0.35, 0.60, 0.72)))
		self.geometryFunctor = Ig2_Polytope_Polytope_PolytopeGeom(contactModel=self.contactModel, contactPoint=self.contactPoint)
		self.integrator = NewtonIntegrator(damping=self.damping, dampGravity=self.dampGravity, gravity=(0, 0, -self.gravity))
		O.engines = [
			ForceResetter(),
			# pairs are searched for in each step: the step of the first touch is part of the result
			InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0),
			InteractionLoop(
				[self.geometryFunctor],
				[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
				[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=self.contactDamping, shearDamping=shearDamping)],
			),
			self.integrator,
		]
		O.dt = self.timeStep
		O.trackEnergy = True
		return self

	def _body(self, block, **body):
		orientation = Quaternion(*block.orientation)
		return cuboid(block.position, block.halfLengths, orientation, cornerRadius=self.cornerRadius, **body)

	@property
	def body(self):
		"""The free block."""
		return O.bodies[self.freeId]

	def contact(self):
		"""The contact of the two blocks, None while there is none."""
		if not O.interactions.has(self.fixedId, self.freeId):
			return None
		contact = O.interactions[self.fixedId, self.freeId]
		return contact if contact.isReal else None
