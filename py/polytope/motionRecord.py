# SPDX-License-Identifier: GPL-2.0-or-later
"""Records one body's motion, the force on it and its one contact in every step, and computes the budgets of momentum and energy."""

import numpy as np
from yade import O

from .measures.contactTypes import ContactTypes, typeOf
from .measures.energy import storedEnergy
from .scene.vertices import rotationMatrix

__all__ = ['MotionRecord', 'noContact']

noContact = 'none'

_booked = ('elastPotential', 'plastDissip', 'normDampDissip', 'shearDampDissip', 'nonconservative')
"""Terms of O.energy that the contact law records (RockJoint law: fracture needs strength, which no body here has)."""
_springs = ('spring', 'normalStored', 'shearStored')
"""What of a contact's springs is recorded: force of the normal spring [N], energy of the normal and of the shear spring [J]."""


class MotionRecord:
	"""Steps the simulation and records the motion of one free body; after `finish()` all below are arrays with one row a step.

	Time n belongs to the position the step starts from: time, position, orientation (w, x, y, z), contactForce, torque,
	point, normal, depth (NaN without contact), type (`noContact` or as ContactTypes names it). velocityBefore and velocityAfter
	(spin…) are YADE's at half a step before and after it. Needs O.trackEnergy, a body of which all motion is free, and a
	partner that does not move.

	Two accounts of the contact's energy: the law's own terms in O.energy, of which *nonconservative* is whatever makes them add up, and
	one from states, geometry and forces (`energy`, `normalLoss`, `shearLoss`, `made`), in which nothing is left over; `bookError`
	compares them.

	:param body: the Body
	:param contactOf: function without argument: its present Interaction, or None
	:param integrator: the NewtonIntegrator; its damping and gravity enter the budgets
	:param tolerance: of ContactTypes
	"""

	def __init__(self, body, contactOf, integrator, tolerance=None):
		self.body, self.contactOf, self.integrator = body, contactOf, integrator
		self.types, self.partner = ContactTypes(tolerance), None
		self._rows = []

	def step(self):
		state = self.body.state
		here = [O.time, *state.pos, *_wxyz(state.ori), *state.vel, *state.angVel]
		O.step()
		force, torque = O.forces.f(self.body.id), O.forces.t(self.body.id)
		contact = self.contactOf()
		if contact:
			geom = contact.geom
			self.partner = contact.id2 if contact.id1 == self.body.id else contact.id1
			touch = [*geom.contactPoint, *geom.normal, *self._shearDamperOf(contact), geom.penetrationDepth, *_springsOf(contact)]
		else:
			touch = [*[np.nan] * 6, *[0] * 6, np.nan, 0, 0, 0]
		energy = dict(O.energy.items())  # the law adds its terms at its first contact
		self._rows.append([*here, *state.vel, *state.angVel, *force, *torque, *touch, *(energy.get(name, 0.0) for name in _booked)])

	def finish(self):
		rows = np.array(self._rows)
		del self._rows
		vectors = (
			'position',
			'orientation',
			'velocityBefore',
			'spinBefore',
			'velocityAfter',
			'spinAfter',
			'contactForce',
			'torque',
			'point',
			'normal',
			'shearDamper',
			'shearDamperCouple',
		)
		widths = {**dict.fromkeys(('time', *vectors, 'depth', *_springs, *_booked), 1), **dict.fromkeys(vectors, 3), 'orientation': 4}
		start = 0
		for name, width in widths.items():
			setattr(self, name, rows[:, start] if width == 1 else rows[:, start : start + width])
			start += width
		self.timeStep = O.dt
		self.mass = self.body.state.mass
		self.gravity = np.array(self.integrator.gravity, float)
		self.damping, self.dampGravity = self.integrator.damping, self.integrator.dampGravity
		self.inertia = np.array(self.body.state.inertia, float)
		self.type = self._namedTypes()
		return self

	def _shearDamperOf(self, contact):
		"""Force of the shear damper on the body [N], and its moment about the contact point [N·m]."""
		phys, sign = contact.phys, 1 if contact.id2 == self.body.id else -1
		force, arm = sign * phys.shearViscous, phys.shearPoint - contact.geom.contactPoint
		return *force, *(arm.cross(force) + sign * phys.twistingViscous * contact.geom.normal)

	def _namedTypes(self):
		touching = np.flatnonzero(np.isfinite(self.depth))
		names = np.full(len(self.depth), noContact, dtype='<U13')
		if len(touching):
			points, partner = self.point[touching], O.bodies[self.partner]
			own = self.types.features(self.body, points, self.position[touching], _rotations(self.orientation[touching]))
			turn = rotationMatrix(partner.state.ori)
			still = [partner.state.pos] * len(points), np.broadcast_to(turn, (len(points), 3, 3))
			names[touching] = [typeOf(*pair) for pair in zip(own, self.types.features(partner, points, *still), strict=True)]
		return names

	def dampingForce(self):
		"""Force that NewtonIntegrator's damping adds, by its own rule: a fraction of each component, against the velocity [N]."""
		acceleration = self.contactForce / self.mass + (self.gravity if self.dampGravity else 0)
		middle = self.velocityBefore + 0.5 * self.timeStep * acceleration
		return -self.mass * self.damping * np.abs(acceleration) * np.sign(middle)

	def dampingTorque(self):
		"""Torque that NewtonIntegrator's damping adds [N·m]; bodies of unequal moments are damped by the torque itself."""
		if self.body.aspherical:
			return -self.damping * np.abs(self.torque) * np.sign(self.spinBefore)
		acceleration = self.torque / self.inertia
		middle = self.spinBefore + 0.5 * self.timeStep * acceleration
		return -self.inertia * self.damping * np.abs(acceleration) * np.sign(middle)

	def momentumError(self):
		"""Largest ``|Δ(m v) − ∫(F + F_damping) dt − m g t|`` at any time, in any direction, over ``∫|F| dt + m |g| t`` of the whole run [-]."""
		impulse = np.cumsum(self.contactForce + self.dampingForce() + self.mass * self.gravity, axis=0) * self.timeStep
		change = self.mass * (self.velocityAfter - self.velocityBefore[0])
		scale = self.timeStep * np.sum(np.linalg.norm(self.contactForce, axis=1) + self.mass * np.linalg.norm(self.gravity))
		return np.abs(change - impulse).max() / scale

	def kineticEnergy(self):
		"""½ m v₋·v₊ + ½ ω₋·I ω₊ with the velocities half a step before and after [J]: free flight of a leapfrog conserves it exactly."""
		translation = 0.5 * self.mass * np.sum(self.velocityBefore * self.velocityAfter, axis=1)
		turn = _rotations(self.orientation)
		before, after = (np.einsum('nji,nj->ni', turn, spin) for spin in (self.spinBefore, self.spinAfter))
		return translation + 0.5 * np.sum(self.inertia * before * after, axis=1)

	def potentialEnergy(self):
		return -self.mass * self.position @ self.gravity

	def elasticEnergy(self):
		"""Energy of the contact's springs, from the overlap and the shear force [J]."""
		return self.normalStored + self.shearStored

	def energy(self):
		"""Kinetic, potential and elastic energy [J]."""
		return self.kineticEnergy() + self.potentialEnergy() + self.elasticEnergy()

	def dampingLoss(self):
		"""Energy dissipated by the integrator's damping up to time n [J]."""
		force, torque = self.dampingForce(), self.dampingTorque()
		work = np.sum((force[:-1] + force[1:]) * self.velocityAfter[:-1] + (torque[:-1] + torque[1:]) * self.spinAfter[:-1], axis=1)
		return np.concatenate([[0], -0.5 * self.timeStep * np.cumsum(work)])

	def _outward(self):
		"""Normal from the partner to the body; zero without contact."""
		sign = 1 if self.partner is not None and self.partner < self.body.id else -1  # YADE's body 1 has the lower id
		return sign * np.nan_to_num(self.normal)

	def _couple(self):
		"""Moment of the contact on the body about the contact point [N·m]; zero without contact."""
		return self.torque - np.cross(np.nan_to_num(self.point - self.position), self.contactForce)

	def _work(self, force, couple=0):
		"""Work of a force on the body at the contact point, and a moment, up to time n [J]: the mean of those at both ends of a step times
		its motion."""
		torque = np.cross(np.nan_to_num(self.point - self.position), force) + couple
		power = np.sum((force[:-1] + force[1:]) * self.velocityBefore[1:] + (torque[:-1] + torque[1:]) * self.spinBefore[1:], axis=1)
		return np.concatenate([[0], 0.5 * self.timeStep * np.cumsum(power)])

	def made(self):
		"""What the normal spring has given to the motion and still stores, up to time n [J]: zero if its force is the gradient of its
		energy."""
		return self._work(self.spring[:, None] * self._outward()) + self.normalStored - self.normalStored[0]

	def normalLoss(self):
		"""Energy taken along the normal by what the contact's force is beside the spring's, the damper, up to time n [J]."""
		outward = self._outward()
		return -self._work((np.sum(self.contactForce * outward, axis=1) - self.spring)[:, None] * outward)

	def shearLoss(self):
		"""Energy taken across the normal, by friction and the shear damper, less what the shear spring stores, up to time n [J]."""
		outward = self._outward()
		across = self.contactForce - np.sum(self.contactForce * outward, axis=1)[:, None] * outward
		return -self._work(across, self._couple()) - self.shearStored + self.shearStored[0]

	def contactLoss(self):
		"""Energy dissipated by the contact's friction and dampers up to time n [J]."""
		return self.normalLoss() + self.shearLoss()

	def bookError(self):
		"""Largest errors of the law's own terms, by term [J].

		Springs: against `elasticEnergy`. Dampers: against their forces' work. Friction: against the shear springs' forces times the motion
		at the contact point, taken as the law takes them, with the mean of the forces at both ends of a step, turned to the present normal,
		and the present lever arm (`shearLoss` has each end's own; where the contact point jumps that differs), without the steps in which the
		contact ends: the record has no contact point there, and the law does. Sum: what all of the law's terms leave over.
		"""
		outward, couple = self._outward(), self._couple()
		across = self.contactForce - np.sum(self.contactForce * outward, axis=1)[:, None] * outward - self.shearDamper
		turning = couple - self.shearDamperCouple
		motion = self.timeStep * (self.velocityBefore + np.cross(self.spinBefore, np.nan_to_num(self.point - self.position)))[1:]
		closer = np.sum(motion * outward[1:], axis=1)
		sideways = motion - closer[:, None] * outward[1:]
		touching = self.spring[1:] > 0
		turned = self.timeStep * self.spinBefore[1:]
		work = np.sum((across[:-1] + across[1:]) * sideways + (turning[:-1] + turning[1:]) * turned, axis=1)
		shear = -0.5 * np.cumsum(touching * work)

		def taken(total):
			return np.cumsum(touching * np.diff(total))

		pairs = {
			'springs': (self.elastPotential, self.elasticEnergy()),
			'normal damper': (self.normDampDissip, self.normalLoss()),
			'shear damper': (self.shearDampDissip, -self._work(self.shearDamper, self.shearDamperCouple)),
			'friction': (taken(self.plastDissip + self.shearStored), shear),
			'sum': (
				self.elastPotential + self.plastDissip + self.normDampDissip + self.shearDampDissip + self.nonconservative,
				-self._work(self.contactForce, couple),
			),
		}
		return {name: float(np.abs(law - own).max()) for name, (law, own) in pairs.items()}

	def approach(self):
		"""Way the bodies have come towards each other along the normal, at the contact point, up to time n [m]; zero without contact."""
		velocity, spin = (self.velocityBefore + self.velocityAfter) / 2, (self.spinBefore + self.spinAfter) / 2
		speed = np.sum(self._outward() * (velocity + np.cross(spin, self.point - self.position)), axis=1)
		return -np.cumsum(np.nan_to_num(speed)) * self.timeStep

	def balance(self):
		"""Energy and all losses, less what the normal spring has made and their sum at the start [J]: zero if forces and states belong
		together."""
		total = self.energy() + self.contactLoss() - self.made() + self.dampingLoss()
		return total - total[0]


def _springsOf(contact):
	"""The values named in `_springs`."""
	phys = contact.phys
	return (phys.normalForce - phys.normalViscous).dot(contact.geom.normal), *storedEnergy(contact)


def _wxyz(orientation):
	return orientation[3], orientation[0], orientation[1], orientation[2]


def _rotations(quaternions):
	w, x, y, z = quaternions.T
	return np.stack(
		[
			np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], axis=-1),
			np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], axis=-1),
			np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1),
		],
		axis=1,
	)
