# SPDX-License-Identifier: GPL-2.0-or-later
"""A rock wedge between fixed blocks, simulation C of the paper and the base of simulation D's scene."""

import dataclasses
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
	NewtonIntegrator,
	O,
	RockJointMat,
)
from yade.polytope.bodies.polytopes import fromHalfSpaces
from yade.polytope.rock.faces import areaVector

from .blockGeometry import BlockGeometry, samePlane

__all__ = ['Joint', 'WedgeScene', 'stiffnessFactors']

colors = [(0.35, 0.60, 0.72), (0.55, 0.76, 0.75), (0.93, 0.86, 0.66), (0.16, 0.42, 0.58)]
wedgeColor = (0.85, 0.42, 0.16)

fixedMask, wedgeMask = 2, 3

stiffnessFactors = ('face', 'section', 'contact')
"""Values of WedgeScene.stiffnessTimes."""


@dataclasses.dataclass
class Joint:
	"""Face of the wedge against one fixed block."""

	block: str
	normal: np.ndarray
	"""Unit normal out of the fixed block, into the wedge."""
	area: float
	"""Area of the wedge's face [m²]."""


@dataclasses.dataclass
class WedgeScene:
	"""A free wedge between fixed blocks (simulations C and D of Boon et al. 2012). Make it with `WedgeScene(...).build()`.

	The paper gives the joints' dips; sizes and parameters are our choice, density, stiffnesses and gravity those of Itasca's 3DEC
	verification problems of the same two wedges.
	"""

	geometry: BlockGeometry
	normalStiffness: float = 1e7
	"""[Pa/m], or [N/m] where stiffnessTimes is 'contact'."""
	shearStiffness: float = 1e7
	stiffnessTimes: str = 'face'
	"""What stiffnesses are multiplied with: 'face', the area of the wedge's face, once and for all; 'section', the present area of the
	contact section, smaller when the wedge tilts on the face; 'contact', nothing. Contacts along an edge have no face: with 'face'
	they take their section."""
	edgeStiffness: float = None
	"""Normal and shear stiffness of contacts along an edge [N/m]; None: as stiffnessTimes says."""
	density: float = 2000
	gravity: float = 10
	damping: float = 0.7
	"""YADE's own: NewtonIntegrator.damping."""
	contactDamping: float = 0.0
	"""Damping of each contact, normal and shear, fraction of critical."""
	rockingDamping: float = 0.0
	"""Damping of rocking at each contact, fraction of critical: without it one contact point leaves rocking on a face to YADE's own damping."""
	contactModel: str = 'boon2012'
	"""'boon2012', 'surface', 'foundation' or 'spring'; the last three do not read *contactPoint*."""
	contactPoint: str = 'analyticCentre'
	timeStepFraction: float = 0.2
	"""Time step over sqrt(wedge's mass / sum of its faces' normal stiffnesses)."""
	frictionAngle: float = math.radians(70)
	"""Friction angle at the start."""

	# what build() made
	ids: dict = dataclasses.field(default_factory=dict, init=False)
	"""Block's name → body's id."""
	joints: list = dataclasses.field(default_factory=list, init=False)
	"""The wedge's faces, one for each block that is the other side of just one of its planes."""

	fixedBlocksMeet = False
	"""Whether there are contacts between the fixed blocks."""

	def __post_init__(self):
		if self.stiffnessTimes not in stiffnessFactors:
			raise ValueError(f'stiffnessTimes: must be one of {stiffnessFactors}, got {self.stiffnessTimes!r}')

	def build(self):
		O.reset()
		O.materials.append(
			RockJointMat(
				density=self.density,
				normalStiffness=self.normalStiffness,
				shearStiffness=self.shearStiffness,
				frictionAngle=self.frictionAngle,
			)
		)
		self.ids = {name: O.bodies.append(self._body(k, name)) for k, name in enumerate(self.geometry.planes)}
		wedge = O.bodies[self.wedgeId]
		# the fixed blocks have one and the same mask, the wedge another one that has a bit in common with it
		avoided = 0 if self.fixedBlocksMeet else fixedMask
		O.engines = [
			ForceResetter(),
			InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.02 * wedge.shape.volume ** (1 / 3), avoidSelfInteractionMask=avoided),
			InteractionLoop(
				[Ig2_Polytope_Polytope_PolytopeGeom(contactModel=self._contactModel(), contactPoint=self.contactPoint)],
				[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=self.stiffnessTimes != 'contact')],
				[self._law()],
			),
			NewtonIntegrator(damping=self.damping, gravity=(0, 0, -self.gravity)),
		]
		self.joints = self._joints()
		stiffness = self.normalStiffness * (
			len(self.joints) if self.stiffnessTimes == 'contact' else sum(joint.area for joint in self.joints)
		)
		O.dt = self.timeStepFraction * math.sqrt(wedge.state.mass / stiffness)
		return self

	def _contactModel(self):
		"""The contact model. That of a contact surface goes by the unit of the stiffness, which _fixStiffness makes one per contact after the
		contact has begun."""
		return 'spring' if (self.contactModel, self.stiffnessTimes) == ('surface', 'face') else self.contactModel

	def establishContacts(self):
		"""Takes the first steps, until the wedge touches the blocks around, and sets those stiffnesses that are not to follow the contact
		section.

		:raises RuntimeError: if the wedge does not come to touch one of them
		"""
		wanted = self.geometry.faceBlocks + (self.geometry.edgeBlocks if self.edgeStiffness is not None else [])
		for _ in range(1000):
			O.step()
			missing = [name for name in wanted if not O.interactions.has(self.wedgeId, self.ids[name], onlyReal=True)]
			if not missing:
				break
		else:
			raise RuntimeError(f'the wedge does not come to touch {missing}')
		for name, stiffness in self._setStiffnesses().items():
			self._fixStiffness(name, *stiffness)

	def _setStiffnesses(self):
		"""Block's name → (normal, shear) of its contact with the wedge [N/m], where it does not follow the contact section."""
		which = {}
		if self.stiffnessTimes == 'face':
			which = {joint.block: (self.normalStiffness * joint.area, self.shearStiffness * joint.area) for joint in self.joints}
		if self.edgeStiffness is not None:
			which |= {name: (self.edgeStiffness, self.edgeStiffness) for name in self.geometry.edgeBlocks}
		return which

	def _fixStiffness(self, name, normal, shear):
		phys = O.interactions[self.wedgeId, self.ids[name]].phys
		phys.normalStiffness = phys.shearStiffness = 0  # per area: none
		phys.kn, phys.ks = normal, shear

	def keepStiffness(self):
		"""Sets stiffnesses again where a contact has opened and closed: YADE makes new ones then, per area.

		:returns: how many
		"""
		again = 0
		for name, stiffness in self._setStiffnesses().items():
			pair = self.wedgeId, self.ids[name]
			if O.interactions.has(*pair, onlyReal=True) and O.interactions[pair].phys.normalStiffness != 0:
				self._fixStiffness(name, *stiffness)
				again += 1
		return again

	@property
	def wedgeId(self):
		return self.ids[self.geometry.wedge]

	@property
	def weight(self):
		"""Weight of the wedge [N]."""
		return O.bodies[self.wedgeId].state.mass * self.gravity

	def forceFrom(self, name):
		"""Force of a block on the wedge: (normal part, shear part), vectors [N]; zeros if they do not touch."""
		pair = self.wedgeId, self.ids[name]
		if not O.interactions.has(*pair, onlyReal=True):
			return np.zeros(3), np.zeros(3)
		contact = O.interactions[pair]
		sign = 1 if contact.id2 == self.wedgeId else -1  # YADE's forces are those on body 2
		return sign * np.array(contact.phys.normalForce, float), sign * np.array(contact.phys.shearForce, float)

	def sectionOf(self, joint):
		"""Present area of the contact section of one of the *joints* [m²]; 0 if it is open, or if no contact asks for areas."""
		pair = self.wedgeId, self.ids[joint.block]
		return O.interactions[pair].phys.contactArea if O.interactions.has(*pair, onlyReal=True) else 0.0

	def _law(self):
		return Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(
			normalDamping=self.contactDamping, shearDamping=self.contactDamping, rockingDamping=self.rockingDamping
		)

	def _body(self, k, name):
		planes = self.geometry.planes[name]
		free = name == self.geometry.wedge
		try:
			return fromHalfSpaces(
				planes[:, :3],
				planes[:, 3],
				fixed=not free,
				mask=wedgeMask if free else fixedMask,
				color=wedgeColor if free else colors[k % len(colors)],
			)
		except ValueError as error:
			raise ValueError(f"block '{name}': {error}") from None

	def _joints(self):
		normals = {name: self.geometry.jointNormal(name) for name in self.geometry.faceBlocks}
		return [Joint(name, normal, self._faceArea(normal)) for name, normal in normals.items()]

	def _faceArea(self, normal):
		"""Area of the wedge's face whose outward normal is opposite to *normal*."""
		body = O.bodies[self.wedgeId]
		corners = np.array([body.state.ori * v for v in body.shape.vertices], float)
		for face in body.shape.faces:
			vector = areaVector(corners[list(face)])
			area = np.linalg.norm(vector)
			if area + vector.dot(normal) < samePlane * area:
				return float(area)
		raise ValueError(f"block '{self.geometry.wedge}': its joint with normal {normal} has no face")
