# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation D of the paper: a wedge in a roof, held by joints in compression, which falls out as friction goes down."""

import dataclasses
import math

import numpy as np
from yade import O, Vector3

from ..wedges.scene import WedgeScene
from ..wedges.theory import dipOf, jointForces

__all__ = ['RoofWedge']

pressingDamping = 0.3
"""Damping of contacts in normal and shear direction while the joints close, fraction of critical. YADE's own damping reduces forces, and
without contacts there are none: blocks that close fast would push a weightless wedge out, for good, where the shear stiffness is low."""


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
		"""Inclinations of the joints from the vertical, one for each joint."""
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
		Once all is at rest the outer blocks are fixed and the wedge gets its weight. The blocks can neither turn nor rise. Contacts are
		damped meanwhile (pressingDamping): the state of rest is elastic, and does not depend on it.

		:param float restSpeed: [m/s] of the fastest block
		:returns: how far each outer block has moved [m]
		:raises RuntimeError: if they do not come to rest
		"""
		newton, law = O.engines[-1], O.engines[2].lawDispatcher.functors[0]
		newton.gravity = Vector3.Zero
		law.normalDamping = law.shearDamping = max(self.contactDamping, pressingDamping)
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
			raise RuntimeError(self._whyNoRest(mostSteps))
		law.normalDamping = law.shearDamping = self.contactDamping
		O.forces.reset(True)
		for block in blocks:
			self._hold(block.id)
		newton.gravity = (0, 0, -self.gravity)
		return [(block.state.pos - origin).norm() for block, origin in zip(blocks, origins, strict=True)]

	def _whyNoRest(self, steps):
		lost = [joint.block for joint in self.joints if not O.interactions.has(self.wedgeId, self.ids[joint.block], onlyReal=True)]
		if lost:
			return (
				f'the wedge is pushed out of its joints (with {lost}) while the boundary stress closes them: take a larger shear '
				'stiffness (--shear-stiffness) or a smaller stress (--horizontal-stress)'
			)
		return (
			f'the outer blocks do not come to rest within {steps} steps: take more of them (--most-steps), a shorter time step '
			'(--time-step-fraction) or more damping (--damping, --contact-damping)'
		)

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
