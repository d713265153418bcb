# SPDX-License-Identifier: GPL-2.0-or-later
"""Range and defaults of the options for a three-hinged beam (simulation B) of any shape.

Angles in degrees, lengths in block heights (the half-beams' height).
"""

import math

__all__ = ['BeamLimits']


class BeamLimits:
	"""Rotations of a beam, and what follows from them.

	:param BeamBetweenWalls beam:
	:param rotations: (first, last); None: 0.25°, and the part of alignment that is 15° for the paper's beam
	:raises ValueError: unless they rise, and end before the hinges are in one line

	:ivar rotations: (first, last)
	:ivar float overlap: the largest depth of a corner in another body
	"""

	def __init__(self, beam, rotations=None):
		aligned = math.degrees(beam.alignment)
		first, last = self.rotations = tuple(rotations or (0.25, 15 / math.degrees(math.atan(1 / 3)) * aligned))
		if not first < last < aligned:
			raise ValueError(f'must rise, to below {aligned:.4g}°, hinges in one line')
		self.beam = beam
		self.overlap = float(max(beam.penetrations(math.radians(last)))) / beam.height

	def cornerRadii(self, abutmentLength):
		"""(least, limit): not below the overlap, and below the half-width of each body."""
		return self.overlap, min(1, self.beam.length / self.beam.height, abutmentLength) / 2

	def cornerRadius(self, abutmentLength, wanted=None):
		"""The corner radius: as wanted; None: 0.1, or the overlap where that is larger.

		:raises ValueError: if it is out of `cornerRadii`
		"""
		least, limit = self.cornerRadii(abutmentLength)
		radius = wanted or max(0.1, least)
		if not least <= radius < limit:
			raise ValueError(
				f'must be from {least:.4g}, the largest overlap, to below {limit:.4g}, half of the thinnest body, got {radius:.4g}'
			)
		return radius

	def frictionAngle(self, wanted=None):
		"""The friction angle: as wanted; None: 45°, or more where the beam needs it.

		:raises ValueError: if the half-beams slip at the abutments, whose shear force over normal force is 4/3 L₂/L₁ at small rotations
		"""
		shear = 4 / 3 * self.beam.height / self.beam.length
		angle = wanted or max(45, math.degrees(math.atan(1.5 * shear)))
		least = math.degrees(math.atan(shear))
		if angle <= least:
			raise ValueError(f'must be above {least:.4g}, else the abutments slip')
		return angle

	def isAppendixA(self, abutmentHeight, normalWeight, cornerRadius):
		"""Whether the normals at the abutments are horizontal and the abutments reach beyond the overlaps: only then theory holds."""
		needed = max(cornerRadius, self.overlap * math.tan(math.radians(self.rotations[1])))
		return normalWeight == 1 and (abutmentHeight - 1) / 2 >= needed - 1e-12
