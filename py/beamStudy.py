# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of simulation B: load and rotation of the three-hinged beam by statics and dynamics, and the theories they are held against."""
import dataclasses
import math

from .scenes import ThreeHingedBeam
from .theory.beam import BeamBetweenWalls, BeamOfTwoBlocks

__all__ = ['BeamCurve', 'BeamStudy', 'DrivenBeam']


@dataclasses.dataclass
class BeamCurve:
	"""Rotation imposed, statics."""

	readings: list
	"""BeamReading at each rotation."""
	peak: object
	"""BeamReading at the largest load."""
	work: float
	"""Of the imposed moment on one half-beam, up to the peak [J]."""
	exhaustion: float
	"""Rotation beyond the peak at which the load is zero [rad]."""


@dataclasses.dataclass
class DrivenBeam:
	"""Rotation imposed at a constant rate, dynamics; loads over the factor on the stiffness."""

	peak: float
	"""Largest load [N]."""
	rotation: float
	"""At the largest load [rad]."""
	deviation: float
	"""Largest difference from theory at the same rotation, over theory's peak [-]."""
	rise: float
	"""Of the hinge at the abutment up to the peak [m]."""


class BeamStudy:
	"""Runs beams that differ in one thing at a time, and counts their contact queries.

	:param dict shape: length, height, abutmentStiffness and midspanStiffness, see ThreeHingedBeam
	:param dict abutment: abutmentHeight and abutmentLength
	:param others: further attributes of ThreeHingedBeam
	"""

	def __init__(self, shape, abutment, **others):
		self.attributes = {**shape, **abutment, **others}
		self.appendixA = BeamBetweenWalls(**shape)
		self.twoBlocks = BeamOfTwoBlocks(**shape, **abutment)
		self.theory = {'centroid': self.appendixA, 'analyticCentre': self.twoBlocks}
		"""By contact point."""
		self.queries = self.failures = 0

	def scene(self, stiffness=1, timeStep=1, **changes):
		"""The beam with factors on both stiffnesses and on the time step's fraction, and other attributes."""
		attributes = {**self.attributes, **changes}
		for name in ('abutmentStiffness', 'midspanStiffness'):
			attributes[name] *= stiffness
		attributes['timeStepFraction'] *= timeStep
		return ThreeHingedBeam(**attributes).build()

	def _count(self, scene):
		stats = scene.stats()
		self.queries += stats['pairs']
		self.failures += stats['failures'] + stats['fallbacks']

	def curve(self, contactPoint, solver, rotations, progress=lambda: None):
		"""BeamCurve over *rotations* [rad]; *progress* is called after each."""
		scene = self.scene(contactPoint=contactPoint, solver=solver)
		readings = []
		for rotation in rotations:
			readings.append(scene.balance(rotation))
			progress()
		peak = scene.peak()
		curve = BeamCurve(readings, peak, scene.work(peak.rotation), scene.exhaustion())
		self._count(scene)
		return curve

	def peak(self, **changes):
		"""BeamReading at the largest load, rotation imposed, statics."""
		scene = self.scene(**changes)
		peak = scene.peak()
		self._count(scene)
		return peak

	def driven(self, contactPoint, first, last, steps, stiffness=1, timeStep=1, rate=1):
		"""DrivenBeam from one rotation to another [rad]; *steps* are those without the factors, each of which changes one thing alone."""
		theory, scene = self.theory[contactPoint], self.scene(stiffness, timeStep, contactPoint=contactPoint)
		steps = round(steps / timeStep / rate * math.sqrt(stiffness))  # the time step is a fraction of sqrt(mass / stiffness)
		readings = list(scene.drive(first, last, steps, sample=max(1, steps // 2000)))
		self._count(scene)
		largest = max(readings, key=lambda reading: reading.load)
		away = max(abs(reading.load / stiffness - theory.load(reading.rotation)) for reading in readings[::40])
		return DrivenBeam(largest.load / stiffness, largest.rotation, away / theory.peak()[0], largest.rise)

	def pushed(self, contactPoint, first, precision, settleSteps, stiffness=1, timeStep=1):
		"""Weight imposed, dynamics, see ThreeHingedBeam.push: (held, not held, both over the factor on the stiffness, BeamReadings)."""
		scene = self.scene(stiffness, timeStep, contactPoint=contactPoint)
		increment = stiffness * self.theory[contactPoint].peak()[0] / 20
		held, tooMuch, readings = scene.push(first, increment, precision, settleSteps=round(settleSteps / timeStep))
		self._count(scene)
		return held / stiffness, tooMuch / stiffness, readings

	def wallPeak(self):
		"""Peak (N, rad) with the analytic centre and a rigid block of the abutments' size instead of the other half-beam."""
		return dataclasses.replace(self.twoBlocks, wallAtMidspan=True).peak()

	def abutments(self, heights, lengths):
		"""Analytic centre with abutments of other sizes [m].

		:returns: generator of (height, length, BeamReading at the peak, peak (N, rad) by the independent model, the same with a rigid
		    block instead of the other half-beam)
		"""
		for height in heights:
			for length in lengths:
				size = {'abutmentHeight': height, 'abutmentLength': length}
				model = dataclasses.replace(self.twoBlocks, **size)
				wall = dataclasses.replace(model, wallAtMidspan=True)
				yield height, length, self.peak(contactPoint='analyticCentre', **size), model.peak(), wall.peak()
