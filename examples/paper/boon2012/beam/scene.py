# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation B of the paper: two half-beams between two abutments are pushed down at midspan until they snap through (2-D)."""

import dataclasses
import math

from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	MatchMaker,
	NewtonIntegrator,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
)
from yade.polytope.bodies.polytopes import polygon

__all__ = ['BeamReading', 'ThreeHingedBeam']


@dataclasses.dataclass
class BeamReading:
	"""One moment of the beam, from the forces of its contacts."""

	rotation: float
	"""Rotation of the half-beams [rad]."""
	load: float
	"""W = M/(L₁/2) with the moment M of all contact forces on one half-beam about its contact point at the abutment [N]."""
	loadTrueArm: float
	"""W with the arm from that contact point to the half-beam's centre: its weight that would be in equilibrium [N]."""
	thrust: float
	"""Horizontal force at the abutment [N]."""
	thrustMidspan: float
	lever: float
	"""Height of the contact point at midspan above that at the abutment [m]."""
	stored: float
	"""Elastic energy of one half-beam: normal springs of its contact at the abutment and half of that at midspan [J]."""
	tilt: float
	"""Angle of the contact normal at the abutment with the horizontal, positive upwards on the half-beam [rad]."""
	drop: float
	"""Way of the half-beam's upper inner corner, at midspan, downwards since it began to turn [m]."""
	rise: float
	"""Way of the half-beam's lower outer corner, upwards since it began to turn [m]."""
	shearRatio: float
	"""Shear over normal force at the abutment: slips where it reaches tan φ."""


@dataclasses.dataclass
class ThreeHingedBeam:
	"""Two half-beams between fixed abutments, all polygons in the xy plane (simulation B of Boon et al. 2012, Fig. 8).

	The plane of symmetry is x = 0, the abutments' faces are at x = ±L₁; the beam's lower face is at y = 0 before it turns. The
	paper gives the half-beams' size and the stiffnesses; all else is our choice. `ThreeHingedBeam(...).build()`, then `balance`
	(statics, the rotation imposed), `drive` (dynamics, the rotation imposed) or `push` (dynamics, the load imposed).
	"""

	length: float = 0.138
	"""L₁ of each half-beam [m]."""
	height: float = 0.046
	"""L₂ [m]."""
	abutmentHeight: float = 0.138
	"""The abutments' middle is at the height of the half-beams' middle. [m]"""
	abutmentLength: float = 0.046
	"""Length of the abutments away from the beam [m]."""
	abutmentStiffness: float = 100e6
	"""Stiffness of the contact of half-beam and abutment [N/m]."""
	midspanStiffness: float = 50e6
	"""Stiffness of the contact of both half-beams [N/m]."""
	abutmentNormalWeight: float = 1.0
	"""Weight of the abutment's face against the half-beam's planes in their contact's normal, 0.5 to 1. At 1, a rigid abutment, the normal is that of
	its face and all forces are horizontal, as in Appendix A. (A joint of stiffness 50 between equal blocks is one of 100 against a rigid one: the
	paper's two values.)"""
	cornerRadius: float = 0.0046
	"""Must be larger than the overlaps: a point deeper than that in a body gets no normal from it. [m]"""
	contactModel: str = 'boon2012'
	"""'boon2012', 'surface' or 'spring'; the last two read neither contactPoint nor solver nor corner radius nor normal weight."""
	contactPoint: str = 'analyticCentre'
	solver: str = 'newton'
	density: float = 2600
	shearStiffnessRatio: float = 1.0
	"""Shear over normal stiffness of each contact."""
	frictionAngle: float = math.radians(45)
	"""The abutments must not slip: shear over normal force there is 2/3 L₂/(L₁/2) for small rotations."""
	damping: float = 0.7
	"""YADE's own (NewtonIntegrator.damping), which does not act on what is at rest or in equilibrium."""
	timeStepFraction: float = 0.1
	"""Time step over sqrt(mass of a half-beam / stiffness at the abutment)."""

	# what build() made
	abutmentIds: list = dataclasses.field(default_factory=list, init=False)
	beamIds: list = dataclasses.field(default_factory=list, init=False)
	"""Left, right."""

	def __post_init__(self):
		positive = (
			'length',
			'height',
			'abutmentHeight',
			'abutmentLength',
			'abutmentStiffness',
			'midspanStiffness',
			'cornerRadius',
			'density',
			'shearStiffnessRatio',
			'timeStepFraction',
		)
		for name in positive:
			if not 0 < getattr(self, name) < math.inf:
				raise ValueError(f'{name}: must be positive and finite, got {getattr(self, name)}')
		if not 0.5 <= self.abutmentNormalWeight <= 1:
			raise ValueError(f'abutmentNormalWeight: must be 0.5 to 1, got {self.abutmentNormalWeight}')
		if self.abutmentHeight < self.height:
			raise ValueError(f'abutmentHeight: must be at least the height of the beam, {self.height}, got {self.abutmentHeight}')

	@property
	def mass(self):
		"""Mass of one half-beam, 1 m thick [kg]."""
		return self.density * self.length * self.height

	def build(self):
		O.reset()
		# the contacts' stiffnesses are given pair by pair; those of the materials only set the weights of the normals
		weight = self.abutmentNormalWeight
		ratio = weight / (1 - weight) if weight < 1 else 1e18  # so large that the half-beam's weight is below rounding
		joint = {'shearStiffness': self.midspanStiffness, 'frictionAngle': self.frictionAngle, 'density': self.density}
		beam = O.materials.append(RockJointMat(normalStiffness=self.midspanStiffness, **joint))
		abutment = O.materials.append(RockJointMat(normalStiffness=ratio * self.midspanStiffness, **joint))
		pairs = ((beam, beam, self.midspanStiffness), (beam, abutment, self.abutmentStiffness))

		bottom, top = (self.height - self.abutmentHeight) / 2, (self.height + self.abutmentHeight) / 2
		near, far = self.length, self.length + self.abutmentLength
		look = {'cornerRadius': self.cornerRadius}
		rigid = {'material': abutment, 'fixed': True, 'color': (0.86, 0.86, 0.84), **look}
		self.abutmentIds = [
			O.bodies.append(polygon(_rectangle(*sorted((side * near, side * far)), bottom, top), **rigid)) for side in (-1, 1)
		]
		self.beamIds = [
			O.bodies.append(polygon(_rectangle(*sorted((0, side * self.length)), 0, self.height), material=beam, color=color, **look))
			for side, color in ((-1, (0.16, 0.42, 0.58)), (1, (0.35, 0.60, 0.72)))
		]
		O.engines = [
			ForceResetter(),
			InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0),
			InteractionLoop(
				[Ig2_Polytope_Polytope_PolytopeGeom(contactModel=self.contactModel, contactPoint=self.contactPoint, solver=self.solver)],
				[
					Ip2_RockJointMat_RockJointMat_RockJointPhys(
						stiffnessPerArea=False,
						kn=MatchMaker(matches=pairs),
						ks=MatchMaker(matches=tuple((a, b, self.shearStiffnessRatio * k) for a, b, k in pairs)),
					)
				],
				[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()],
			),
			NewtonIntegrator(damping=self.damping, gravity=(0, 0, 0)),
		]
		O.dt = self.timeStepFraction * math.sqrt(self.mass / self.abutmentStiffness)
		return self

	# The integrator and the contacts are looked up each time: O.loadTmp exchanges them.

	@property
	def integrator(self):
		return O.engines[-1]

	def stats(self):
		"""Counters of the contact functor, see Ig2_Polytope_Polytope_PolytopeGeom.stats."""
		return O.engines[2].geomDispatcher.functors[0].stats()

	@property
	def rotation(self):
		"""Present rotation of the left half-beam, clockwise [rad]."""
		orientation = O.bodies[self.beamIds[0]].state.ori
		return -2 * math.atan2(orientation[2], orientation[3])

	def place(self, rotation, behind):
		"""Put both half-beams at rest at a rotation, mirrored, with their lower outer corner at y = 0, *behind* the abutment's face.

		:param float rotation: left half-beam clockwise [rad]
		:param float behind: [m]
		"""
		corner = Vector3(self.length / 2, self.height / 2, 0)  # from the corner to the centre
		for side, k in ((-1, self.beamIds[0]), (1, self.beamIds[1])):
			turn = Quaternion((0, 0, 1), side * rotation)
			state = O.bodies[k].state
			state.ori = turn
			state.pos = Vector3(side * (self.length + behind), 0, 0) + turn * Vector3(-side * corner[0], corner[1], 0)
			state.vel = state.angVel = Vector3.Zero
			state.blockedDOFs = 'xyzXYZ'

	def balance(self, rotation):
		"""Impose a rotation, find the place where both thrusts on a half-beam are equal, and read the load there: statics, no friction.

		:param float rotation: above 0 and so small that the half-beam is too long for its place [rad]
		:raises ValueError: for other rotations
		"""
		shared = self.length * (math.cos(rotation) - 1) + self.height * math.sin(rotation)
		if not rotation > 0 or not shared > 0:
			last = 2 * math.atan(self.height / self.length)
			raise ValueError(f'rotation: the half-beam touches both sides from 0 to {last} rad only, got {rotation}')

		def unbalanced(behind):
			self.place(rotation, behind)
			O.step()
			return float(O.forces.f(self.beamIds[0])[0])  # SciPy takes floats only, YADE's wider precisions have other types

		behind = brentq(unbalanced, 1e-3 * shared, (1 - 1e-3) * shared, xtol=1e-16, rtol=1e-15)
		unbalanced(behind)
		return self.reading()

	def peak(self):
		"""The largest load of all imposed rotations, as `balance` reads it."""
		alignment = math.atan(self.height / self.length)
		found = minimize_scalar(
			lambda rotation: -float(self.balance(rotation).load),
			bounds=(1e-2 * alignment, alignment),
			method='bounded',
			options={'xatol': 1e-8},
		)
		return self.balance(found.x)

	def exhaustion(self):
		"""Rotation beyond the peak at which the load is back to zero [rad]."""
		last = min(2 * math.atan(self.height / self.length), math.pi / 2)
		last = next(part * last for part in (0.999, 0.99, 0.95) if self._loadOrNone(part * last) < 0)
		return brentq(lambda rotation: self.balance(rotation).load, self.peak().rotation, last, xtol=1e-9)

	def work(self, rotation):
		"""Work of the imposed moment on one half-beam from 0 to a rotation, ∫ M dθ, by quadrature over `balance` [J]."""
		return self.length / 2 * quad(self._loadOrNone, 0, rotation, epsrel=1e-7)[0]

	def _loadOrNone(self, rotation):
		try:
			return self.balance(rotation).load
		except RuntimeError:
			return 0.0  # open

	def drive(self, first, last, steps, sample=1):
		"""Turn both half-beams at a constant rate from one rotation to another, free to move in x and y: dynamics.

		:param float first: start, in equilibrium and moving as it will [rad]
		:param float last: [rad]
		:param int steps: time steps on the way
		:param int sample: yield every so many steps
		:returns: generator of BeamReading
		"""
		rate = (last - first) / (steps * O.dt)
		ahead = 1e-3 * (last - first)
		self.balance(first + ahead)
		sideways = O.bodies[self.beamIds[0]].state.pos[0]
		self.balance(first)
		sideways = (sideways - O.bodies[self.beamIds[0]].state.pos[0]) / ahead
		for side, k in zip((-1, 1), self.beamIds, strict=True):
			state = O.bodies[k].state
			state.blockedDOFs = 'zXYZ'
			state.angVel = (0, 0, side * rate)
			state.vel = (-side * rate * sideways, -rate * self.length / 2, 0)  # else the start is an impact
		for step in range(1, steps + 1):
			rotation = self.rotation
			O.step()
			if step % sample == 0:
				yield dataclasses.replace(self.reading(), rotation=rotation)  # of which the forces are

	def push(self, first, increment, precision=2e-4, settleSteps=500, mostSettles=200):
		"""Load both half-beams with more and more weight until they snap through: dynamics, the load imposed.

		The weight is raised by increments, over settleSteps steps each, and then kept until the half-beams are at rest. Where they
		turn beyond Goodman's alignment instead, the last state at rest is restored and tried again with half of the increment.

		:param float first: rotation to start from, in equilibrium with its weight [rad]
		:param float increment: first one [N]
		:param float precision: ends when the increment is this small against the weight
		:param int settleSteps: steps between two checks; at rest: rotation changed by less than 1e-7 rad since the last check
		:param int mostSettles: checks after which a state counts as not at rest
		:returns: (largest weight held, the next that was not [N], readings at rest)
		:raises RuntimeError: if the half-beams neither come to rest nor turn on
		"""
		held = self.balance(first).loadTrueArm
		for k in self.beamIds:
			O.bodies[k].state.blockedDOFs = 'zXY'
		self.integrator.gravity = (0, -held / self.mass, 0)
		if not self._comesToRest(held, held, settleSteps, mostSettles):
			raise RuntimeError(f'the beam does not hold the weight it starts with, {held} N')
		readings, tooMuch = [self.reading()], math.inf
		O.saveTmp('held')
		while increment > precision * held:
			if self._comesToRest(held, held + increment, settleSteps, mostSettles):
				held += increment
				readings.append(self.reading())
				O.saveTmp('held')
			else:
				tooMuch = held + increment
				O.loadTmp('held')
				increment /= 2  # not by bisection: a large increment overshoots the peak where small ones do not
		return held, tooMuch, readings

	def _comesToRest(self, before, weight, settleSteps, mostSettles):
		"""Raise the weight and wait. True: at rest; False: snapped through."""
		beyond = math.atan(self.height / self.length)
		for k in range(1, settleSteps + 1):
			self.integrator.gravity = (0, -(before + (weight - before) * k / settleSteps) / self.mass, 0)
			O.step()
		for _ in range(mostSettles):
			last = self.rotation
			for _ in range(settleSteps):
				O.step()
			if self.rotation > beyond:
				return False
			if abs(self.rotation - last) < 1e-7 and abs(O.bodies[self.beamIds[0]].state.angVel[2]) * O.dt < 1e-9:
				return True
		raise RuntimeError(f'neither at rest nor turning after {mostSettles * settleSteps} steps at {weight} N')

	def contacts(self):
		"""(at the left abutment, at midspan); None for one that is open."""
		pairs = (self.abutmentIds[0], self.beamIds[0]), self.beamIds
		found = [O.interactions[pair[0], pair[1]] if O.interactions.has(*pair) else None for pair in pairs]
		return [contact if contact and contact.isReal else None for contact in found]

	def reading(self):
		"""The left half-beam, from the contact forces of the last step.

		:raises RuntimeError: if one of its contacts is open
		"""
		abutment, midspan = self.contacts()
		if not abutment or not midspan:
			raise RuntimeError(f'a contact of the beam is open at a rotation of {self.rotation} rad')
		k = self.beamIds[0]
		center, hinge = O.bodies[k].state.pos, abutment.geom.contactPoint
		moment = O.forces.t(k)[2] + (center - hinge).cross(O.forces.f(k))[2]
		normal = abutment.geom.normal
		toUpperCorner = O.bodies[k].state.ori * Vector3(self.length / 2, self.height / 2, 0)
		return BeamReading(
			rotation=self.rotation,
			load=moment / (self.length / 2),
			loadTrueArm=moment / (center[0] - hinge[0]),
			thrust=(abutment.phys.normalForce + abutment.phys.shearForce)[0],
			thrustMidspan=(midspan.phys.normalForce + midspan.phys.shearForce)[0],
			lever=(midspan.geom.contactPoint - hinge)[1],
			stored=sum(share * _stored(c) for c, share in ((abutment, 1), (midspan, 0.5))),
			tilt=math.atan2(normal[1], normal[0]),
			drop=self.height - (center + toUpperCorner)[1],
			rise=(center - toUpperCorner)[1],
			shearRatio=abutment.phys.shearForce.norm() / abutment.phys.normalForce.norm(),
		)


def _stored(contact):
	energy = contact.geom.energyPerStiffness  # of the contact surface; -1 for the paper's
	return contact.phys.kn * energy if energy >= 0 else contact.phys.normalForce.squaredNorm() / (2 * contact.phys.kn)


def _rectangle(left, right, bottom, top):
	return [(left, bottom), (right, bottom), (right, top), (left, top)]
