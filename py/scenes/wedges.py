# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulations C and D of the paper: a rock wedge between fixed blocks, which slides out or falls out as friction goes down."""

import dataclasses
import json
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
	Vector3,
)

from ..bodies import fromHalfSpaces
from ..theory.wedges import dipOf, jointForces

__all__ = ['BlockGeometry', 'Joint', 'RoofWedge', 'WedgeScene', 'stiffnessFactors', 'touchingRoofBlocks']

colors = [(0.35, 0.60, 0.72), (0.55, 0.76, 0.75), (0.93, 0.86, 0.66), (0.16, 0.42, 0.58)]
wedgeColor = (0.85, 0.42, 0.16)

fixedMask, wedgeMask = 2, 3

stiffnessFactors = ('face', 'section', 'contact')
"""Values of WedgeScene.stiffnessTimes."""

samePlane = 1e-6
"""Up to which two planes of a geometry file are the two sides of one joint: of normals [-] and of distances over the wedge's height [-]."""


@dataclasses.dataclass
class Joint:
	"""Face of the wedge against one fixed block."""

	block: str
	normal: np.ndarray
	"""Unit normal out of the fixed block, into the wedge."""
	area: float
	"""Of the wedge's face [m²]."""


class BlockGeometry:
	"""Named convex blocks, one of them the wedge, from a geometry file (examples/paper/geometry/README.md has the format).

	:ivar dict planes: name → (n, 4) array, rows a_x, a_y, a_z, d with unit normals: a·x ≤ d
	:ivar str wedge: name of the free block
	"""

	def __init__(self, planes):
		"""
		:param dict planes: name → rows of four numbers; the name of exactly one block has 'wedge' in it
		:raises ValueError: naming the block that is wrong
		"""
		self.planes = {}
		for name, rows in planes.items():
			try:
				array = np.array(rows, float)
			except (TypeError, ValueError):
				array = np.empty(0)
			if array.ndim != 2 or array.shape[1] != 4 or not np.isfinite(array).all() or not np.linalg.norm(array[:, :3], axis=1).all():
				raise ValueError(
					f"block '{name}': planes must be rows of four finite numbers [a_x, a_y, a_z, d] with a normal other than zero"
				)
			self.planes[name] = array / np.linalg.norm(array[:, :3], axis=1, keepdims=True)
		wedges = [name for name in self.planes if 'wedge' in name.lower()]
		if len(wedges) != 1:
			raise ValueError(f"exactly one block must have 'wedge' in its name, got {list(self.planes)}")
		self.wedge = wedges[0]

	@classmethod
	def read(cls, path):
		"""
		:raises ValueError: naming the file, and what is wrong with it
		:raises OSError: if it cannot be read
		"""
		try:
			with open(path) as file:
				return cls({name: block['planes'] for name, block in json.load(file).items()})
		except (AttributeError, KeyError, TypeError) as error:
			raise ValueError(f"{path}: must be an object of blocks, each with 'planes' ({type(error).__name__}: {error})") from None
		except ValueError as error:  # JSON's own error is one too
			raise ValueError(f'{path}: {error}') from None

	@property
	def others(self):
		return [name for name in self.planes if name != self.wedge]

	def sharedPlanes(self, name):
		"""The wedge's planes of which block *name* is the other side."""
		scale = np.ptp(self.planes[self.wedge][:, 3]) or 1.0
		return [
			k
			for k, plane in enumerate(self.planes[self.wedge])
			if any(
				np.allclose(plane[:3], -other[:3], atol=samePlane) and abs(plane[3] + other[3]) < samePlane * scale
				for other in self.planes[name]
			)
		]

	@property
	def faceBlocks(self):
		"""Names of the blocks that meet the wedge on a face: they are the other side of just one of its planes."""
		return [name for name in self.others if len(self.sharedPlanes(name)) == 1]

	@property
	def edgeBlocks(self):
		"""Names of the blocks that meet the wedge along an edge or at a vertex: they are the other side of several of its planes."""
		return [name for name in self.others if len(self.sharedPlanes(name)) > 1]

	def jointNormal(self, name):
		"""Unit normal of the joint with one of the *faceBlocks*, into the wedge."""
		return -self.planes[self.wedge][self.sharedPlanes(name)[0], :3]


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
	"""Of each contact, normal and shear, fraction of critical."""
	rockingDamping: float = 0.0
	"""Of each contact, fraction of critical: without it one contact point leaves rocking on a face to YADE's own damping."""
	contactModel: str = 'paper'
	"""Or 'conservative', which does not read contactPoint, and needs a shorter time step: it is stiff in rocking."""
	contactPoint: str = 'analyticCentre'
	timeStepFraction: float = 0.2
	"""Time step over sqrt(wedge's mass / sum of its faces' normal stiffnesses)."""
	frictionAngle: float = math.radians(70)
	"""To begin with."""

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
				[Ig2_Polytope_Polytope_PolytopeGeom(contactModel=self.contactModel, contactPoint=self.contactPoint)],
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
		if self.stiffnessTimes == 'face':
			for joint in self.joints:
				self._fixStiffness(joint.block, self.normalStiffness * joint.area, self.shearStiffness * joint.area)
		if self.edgeStiffness is not None:
			for name in self.geometry.edgeBlocks:
				self._fixStiffness(name, self.edgeStiffness, self.edgeStiffness)

	def _fixStiffness(self, name, normal, shear):
		phys = O.interactions[self.wedgeId, self.ids[name]].phys
		phys.normalStiffness = phys.shearStiffness = 0  # per area: none
		phys.kn, phys.ks = normal, shear

	def checkStiffness(self):
		"""Whether contacts still have the stiffnesses that were set: YADE makes new ones when a contact has opened and closes again.

		:raises RuntimeError: naming a block whose contact was lost
		"""
		fixed = [joint.block for joint in self.joints] if self.stiffnessTimes == 'face' else []
		for name in fixed + (self.geometry.edgeBlocks if self.edgeStiffness is not None else []):
			pair = self.wedgeId, self.ids[name]
			if not O.interactions.has(*pair, onlyReal=True) or O.interactions[pair].phys.normalStiffness != 0:
				raise RuntimeError(f"the contact with block '{name}' was lost during the run, and its stiffness with it")

	@property
	def wedgeId(self):
		return self.ids[self.geometry.wedge]

	@property
	def weight(self):
		"""Of the wedge [N]."""
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
		"""Of the wedge's face that looks against *normal*."""
		body = O.bodies[self.wedgeId]
		corners = np.array([body.state.ori * v for v in body.shape.vertices], float)
		for face in body.shape.faces:
			polygon = corners[list(face)]
			vector = sum(np.cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]) for k in range(1, len(polygon) - 1)) / 2
			area = np.linalg.norm(vector)
			if area + vector.dot(normal) < samePlane * area:
				return float(area)
		raise ValueError(f"block '{self.geometry.wedge}': its joint with normal {normal} has no face")


@dataclasses.dataclass
class RoofWedge(WedgeScene):
	"""A wedge in a roof, held by joints in compression under a horizontal stress σ_h both ways (simulation D). After build() call one
	of setJointForces() and pressByBoundary(); both leave the outer blocks fixed and the wedge free."""

	horizontalStress: float = 5e4
	"""[Pa], positive in compression."""
	sideArea: float = 0.0
	"""Area of the joint between two outer blocks [m²]; 0: they do not touch."""

	@property
	def fixedBlocksMeet(self):
		return self.sideArea > 0

	@property
	def inclinations(self):
		"""Of the joints from the vertical, one for each joint."""
		return [math.pi / 2 - dipOf(joint.normal)[0] for joint in self.joints]

	def setJointForces(self):
		"""Way 1: the outer blocks are moved in along the joints' normals until the overlap gives the stress field's normal force;
		its shear force is given to the contacts.

		:returns: forces on the wedge as set, [(normal, shear)] of each joint [N]
		"""
		self._hold(self.wedgeId)
		forces = [
			jointForces(self.horizontalStress, joint.area, inclination)
			for joint, inclination in zip(self.joints, self.inclinations, strict=True)
		]
		for joint, (normal, _) in zip(self.joints, forces, strict=True):
			stiffness = self.normalStiffness * (1 if self.stiffnessTimes == 'contact' else joint.area)
			self._moveIn(joint, normal / stiffness)
		self.establishContacts()
		O.step()  # with the stiffnesses that were set
		for _ in range(8):  # a section is a little smaller than the face, and changes with the overlap
			for joint, (normal, _) in zip(self.joints, forces, strict=True):
				self._moveIn(joint, (normal - np.linalg.norm(self.forceFrom(joint.block)[0])) / self._contact(joint).phys.kn)
			O.step()
		for joint, (_, shear) in zip(self.joints, forces, strict=True):
			contact = self._contact(joint)
			upDip = np.array([0, 0, 1.0]) - joint.normal[2] * joint.normal
			onWedge = shear * upDip / np.linalg.norm(upDip)
			contact.phys.shearForce = Vector3(*(onWedge if contact.id2 == self.wedgeId else -onWedge))
		self._release(self.wedgeId)
		return forces

	def pressByBoundary(self, restSpeed=2e-7, mostSteps=200000):
		"""Way 2: the outer blocks are pressed inward by the stress on their boundary, the wedge being weightless; the joints close.
		Once all is at rest the outer blocks are fixed and the wedge gets its weight. The blocks can neither turn nor rise.

		:param float restSpeed: [m/s] of the fastest block
		:returns: how far each outer block has moved [m]
		:raises RuntimeError: if they do not come to rest
		"""
		newton = O.engines[-1]
		newton.gravity = Vector3.Zero
		blocks = [O.bodies[self.ids[joint.block]] for joint in self.joints]
		origins = [block.state.pos for block in blocks]
		for joint, block in zip(self.joints, blocks, strict=True):
			inward = Vector3(joint.normal[0], joint.normal[1], 0)
			# the boundary's projection is that of all inner faces: the joint's, and two side joints' at 60° to it
			area = joint.area * inward.norm() + math.sqrt(3) * self.sideArea
			block.state.blockedDOFs = 'zXYZ'
			O.forces.setPermF(block.id, self.horizontalStress * area * inward.normalized())
		self.establishContacts()
		moving = blocks + [O.bodies[self.wedgeId]]
		for count in range(mostSteps):
			O.step()
			if count % 100 == 99 and max(block.state.vel.norm() for block in moving) < restSpeed:
				break
		else:
			raise RuntimeError(f'the outer blocks do not come to rest within {mostSteps} steps')
		O.forces.reset(True)
		for block in blocks:
			self._hold(block.id)
		newton.gravity = (0, 0, -self.gravity)
		return [(block.state.pos - origin).norm() for block, origin in zip(blocks, origins, strict=True)]

	def establishContacts(self):
		super().establishContacts()
		if self.stiffnessTimes == 'face' and self.sideArea:
			for contact in O.interactions:
				if contact.isReal and self.wedgeId not in (contact.id1, contact.id2):
					contact.phys.normalStiffness = contact.phys.shearStiffness = 0
					contact.phys.kn, contact.phys.ks = self.normalStiffness * self.sideArea, self.shearStiffness * self.sideArea

	def horizontalForce(self):
		"""ΣH: sum of the sizes of the horizontal forces on the wedge's faces [N]."""
		return sum(math.hypot(*sum(self.forceFrom(joint.block))[:2]) for joint in self.joints)

	def _contact(self, joint):
		return O.interactions[self.wedgeId, self.ids[joint.block]]

	def _moveIn(self, joint, distance):
		O.bodies[self.ids[joint.block]].state.pos += Vector3(*(distance * joint.normal))

	@staticmethod
	def _hold(bodyId):
		state = O.bodies[bodyId].state
		state.blockedDOFs = 'xyzXYZ'
		state.vel = state.angVel = Vector3.Zero

	@staticmethod
	def _release(bodyId):
		O.bodies[bodyId].state.blockedDOFs = ''


def touchingRoofBlocks(geometry, sideArea):
	"""The wedge of a roof geometry between three blocks of 120° that touch each other over vertical joints of a given area.

	The blocks are slabs on the wedge's faces, as high as the wedge, cut by the three vertical planes through its apex: the
	thicker they are the larger the joints between them.

	:param BlockGeometry geometry: with a wedge of three equal joints at 120°
	:param float sideArea: of each joint between two blocks [m²], positive
	:returns: a BlockGeometry
	:raises ValueError: if the joints are not such
	"""
	wedge = geometry.planes[geometry.wedge]
	joints = [(name, wedge[geometry.sharedPlanes(name)[0]]) for name in geometry.others if geometry.sharedPlanes(name)]
	apex, *_ = np.linalg.lstsq(np.array([plane[:3] for _, plane in joints]), np.array([plane[3] for _, plane in joints]), rcond=None)
	if len(joints) != 3 or not np.allclose([plane[:3] for _, plane in joints], _threefold(joints[0][1][:3]), atol=1e-9):
		raise ValueError('geometry: must have three joints of equal dip, 120° apart')
	bottom = min(-plane[3] for plane in wedge if np.allclose(plane[:3], (0, 0, -1)))
	height = apex[2] - bottom
	horizontal = math.hypot(*joints[0][1][:2])
	thickness = sideArea / height * horizontal * math.cos(math.pi / 3)  # the vertical joint is a parallelogram as high as the wedge
	blocks = {geometry.wedge: wedge}
	for name, plane in joints:
		outward = np.array([plane[0], plane[1], 0]) / horizontal
		sides = [np.array([-outward[1], outward[0], 0]) * sign * 0.5 - outward * math.sqrt(3) / 2 for sign in (1, -1)]
		rows = [np.append(-plane[:3], -plane[3]), np.append(plane[:3], plane[3] + thickness), [0, 0, 1, apex[2]], [0, 0, -1, -bottom]]
		blocks[name] = rows + [np.append(side, side.dot(apex)) for side in sides]
	return BlockGeometry(blocks)


def _threefold(normal):
	"""A vector and itself turned by 120° and 240° clockwise about z."""
	turn = np.array([[-0.5, math.sqrt(0.75), 0], [-math.sqrt(0.75), -0.5, 0], [0, 0, 1]])
	return [normal, turn @ normal, turn @ turn @ normal]
