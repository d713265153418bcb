# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of simulation B: load and rotation of the three-hinged beam by statics and dynamics, and the theories they are compared with.

Angles in radians. Lengths are given in block heights, as the script's options are: one is the half-beams' height.
"""

import dataclasses
import math

from .scene import ThreeHingedBeam
from .theory import BeamBetweenWalls, BeamOfTwoBlocks

__all__ = ['AbutmentSize', 'BeamCurve', 'BeamStudy', 'DrivenBeam', 'PushedBeam', 'TiltedNormal', 'contactPointNames', 'solverNames']

contactPointNames = {
	'centroid': 'centroid',
	'analyticCentre': 'analytic centre',
	'chebyshevCentre': 'Chebyshev centre',
	'spring': 'contact surface',
}
solverNames = {'newton': 'Newton', 'ipopt': 'Ipopt'}


@dataclasses.dataclass
class BeamCurve:
	"""Rotation imposed, statics."""

	contactPoint: str
	solver: str
	readings: list
	"""BeamReading at each rotation."""
	peak: object
	"""BeamReading at the largest load."""
	work: float
	"""Work of the imposed moment on one half-beam, up to the peak [J]."""
	exhaustion: float
	"""Rotation beyond the peak at which the load is zero [rad]."""


@dataclasses.dataclass
class DrivenBeam:
	"""Rotation imposed at a constant rate, dynamics; loads over the factor on the stiffness."""

	contactPoint: str
	label: str
	peak: float
	"""Largest load [N]."""
	rotation: float
	"""Rotation at the largest load [rad]."""
	deviation: float
	"""Largest difference from theory at the same rotation, over theory's peak [-]."""
	rise: float
	"""Rise of the hinge at the abutment up to the peak [m]."""


@dataclasses.dataclass
class PushedBeam:
	"""Weight imposed, dynamics; weights over the factor on the stiffness."""

	contactPoint: str
	label: str
	held: float
	"""Largest weight held [N]."""
	snapped: float
	"""The next one tried, at which the half-beams snapped through [N]."""
	readings: list
	"""BeamReadings at rest, of which the loads are as they were."""


@dataclasses.dataclass
class AbutmentSize:
	"""Abutments of another size, the contact point at the analytic centre."""

	height: float
	length: float
	"""[block heights]"""
	peak: object
	"""BeamReading at the largest load, rotation imposed, statics."""
	model: tuple
	"""Peak by the independent model (N, rad)."""
	wall: tuple
	"""Peak (N, rad) by that model with a rigid block of the abutments' size instead of the other half-beam."""


@dataclasses.dataclass
class TiltedNormal:
	"""Another direction of the contact normals at the abutments."""

	contactPoint: str
	weight: float
	"""Weight of the abutment's face in the normal."""
	radius: float
	"""Radius of the bodies' corners [block heights]."""
	peak: object
	"""BeamReading at the largest load, rotation imposed, statics."""


class BeamStudy:
	"""Runs beams that differ in one thing at a time, and counts their contact queries.

	:param given: the script's options, with *rotations*, (first, last) [rad]
	"""

	def __init__(self, given):
		self.given = given
		shape = {
			'length': given.length,
			'height': given.height,
			'abutmentStiffness': given.abutment_stiffness,
			'midspanStiffness': given.midspan_stiffness,
		}
		abutment = self._abutment(given.abutment_height, given.abutment_length)
		self.attributes = {
			**shape,
			**abutment,
			'abutmentNormalWeight': given.normal_weight,
			'cornerRadius': given.corner_radius * given.height,
			'timeStepFraction': given.time_step_fraction,
			'damping': given.damping,
			'frictionAngle': math.radians(given.friction_angle),
		}
		self.appendixA = BeamBetweenWalls(**shape)
		self.twoBlocks = BeamOfTwoBlocks(**shape, **abutment)
		self.theory = {'centroid': self.appendixA, 'analyticCentre': self.twoBlocks}
		"""Theories by contact point."""
		self.first, self.last = map(math.radians, given.rotations)
		self.queries = self.failures = 0

	def _abutment(self, height, length):
		return {'abutmentHeight': height * self.given.height, 'abutmentLength': length * self.given.height}

	def scene(self, stiffness=1, timeStep=1, **changes):
		"""The beam with factors on both stiffnesses and on the time step's fraction, and other attributes. contactPoint 'spring' is the
		contact model of that name."""
		if changes.get('contactPoint') == 'spring':
			changes = {**changes, 'contactModel': 'spring', 'contactPoint': 'analyticCentre'}
		attributes = {**self.attributes, **changes}
		for name in ('abutmentStiffness', 'midspanStiffness'):
			attributes[name] *= stiffness
		attributes['timeStepFraction'] *= timeStep
		return ThreeHingedBeam(**attributes).build()

	def _count(self, scene):
		stats = scene.stats()
		self.queries += stats['pairs']
		self.failures += stats['failures']

	def curve(self, contactPoint, solver, rotations):
		"""BeamCurve over *rotations* [rad]."""
		scene = self.scene(contactPoint=contactPoint, solver=solver)
		readings = [scene.balance(rotation) for rotation in rotations]
		peak = scene.peak()
		curve = BeamCurve(contactPoint, solver, readings, peak, scene.work(peak.rotation), scene.exhaustion())
		self._count(scene)
		return curve

	def peak(self, **changes):
		"""BeamReading at the largest load, rotation imposed, statics."""
		scene = self.scene(**changes)
		peak = scene.peak()
		self._count(scene)
		return peak

	def driven(self, contactPoint, label, stiffness=1, timeStep=1, rate=1):
		"""DrivenBeam to half as far again as theory's peak. The factors change one thing each: *drive_steps* are those without them."""
		theory, scene = self.theory[contactPoint], self.scene(stiffness, timeStep, contactPoint=contactPoint)
		top, topRotation = theory.peak()
		last = min(self.last, 1.5 * topRotation)  # further on, half-beams stouter than the paper's (L1/L2 = 1) leave their symmetry
		# the time step is a fraction of sqrt(mass / stiffness)
		steps = round(self.given.drive_steps / timeStep / rate * math.sqrt(stiffness))
		readings = list(scene.drive(self.first, last, steps, sample=max(1, steps // 2000)))
		self._count(scene)
		largest = max(readings, key=lambda reading: reading.load)
		away = max(abs(reading.load / stiffness - theory.load(reading.rotation)) for reading in readings[::40])
		return DrivenBeam(contactPoint, label, largest.load / stiffness, largest.rotation, away / top, largest.rise)

	def pushed(self, contactPoint, label, precision, stiffness=1, timeStep=1):
		"""PushedBeam, see ThreeHingedBeam.push. The simulated time between two checks is the same for any time step."""
		scene = self.scene(stiffness, timeStep, contactPoint=contactPoint)
		increment = stiffness * self.theory[contactPoint].peak()[0] / 20
		settleSteps = round(50 / self.given.time_step_fraction / timeStep)
		held, tooMuch, readings = scene.push(self.first, increment, precision, settleSteps=settleSteps)
		self._count(scene)
		return PushedBeam(contactPoint, label, held / stiffness, tooMuch / stiffness, readings)

	def wallPeak(self):
		"""Peak (N, rad) with the analytic centre and a rigid block of the abutments' size instead of the other half-beam."""
		return dataclasses.replace(self.twoBlocks, wallAtMidspan=True).peak()

	def abutment(self, height, length):
		"""AbutmentSize [block heights]."""
		size = self._abutment(height, length)
		model = dataclasses.replace(self.twoBlocks, **size)
		wall = dataclasses.replace(model, wallAtMidspan=True)
		return AbutmentSize(height, length, self.peak(contactPoint='analyticCentre', **size), model.peak(), wall.peak())

	def tilted(self, contactPoint, weight, radius):
		"""TiltedNormal."""
		attributes = {'abutmentNormalWeight': weight, 'cornerRadius': radius * self.given.height}
		return TiltedNormal(contactPoint, weight, radius, self.peak(contactPoint=contactPoint, **attributes))
