# SPDX-License-Identifier: GPL-2.0-or-later
"""Load and rotation of the three-hinged beam: two blocks between rigid abutments, pushed down at midspan (simulation B of the paper).

By symmetry one half-beam is enough: a rectangle L₁ × L₂ turned by θ between the abutment's face and the plane of symmetry, L₁ apart.
It touches them with its lower outer and its upper inner corner. All forces on faces are horizontal, and both thrusts are equal.
"""

import dataclasses
import math

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

__all__ = ['BeamBetweenWalls', 'BeamOfTwoBlocks']


@dataclasses.dataclass
class _Beam:
	"""Common to both models: the beam, and everything that follows from its load at a rotation."""

	length: float = 0.138
	"""L₁ of each half-beam [m]."""
	height: float = 0.046
	"""L₂ [m]."""
	abutmentStiffness: float = 100e6
	"""Stiffness of the contact of half-beam and abutment: thrust over chord, whatever the contact's area [N/m]."""
	midspanStiffness: float = 50e6
	"""Stiffness of the contact of both half-beams [N/m]."""

	def __post_init__(self):
		for field in dataclasses.fields(self):
			value = getattr(self, field.name)
			if field.type is float and not 0 < value < math.inf:
				raise ValueError(f'{field.name}: must be positive and finite, got {value}')

	@property
	def alignment(self):
		"""Goodman's criterion: rigid blocks fail when the three hinges are in one line, tan θ = L₂/L₁ [rad]."""
		return math.atan(self.height / self.length)

	@property
	def lastTouch(self):
		"""A little less than twice `alignment`, where the half-beam no longer touches both sides, and than 90° [rad]."""
		return 0.999 * min(2 * self.alignment, math.pi / 2)

	def shortening(self, rotation):
		"""How much too long the turned half-beam is for its place, L₁ cos θ + L₂ sin θ − L₁: what both contacts share [m]."""
		return self.length * (np.cos(rotation) - 1) + self.height * np.sin(rotation)

	def drop(self, rotation):
		"""How far the upper corner at midspan goes down, while the lower corner at the abutment stays at its height [m]."""
		return self.height * (1 - np.cos(rotation)) + self.length * np.sin(rotation)

	def load(self, rotation, trueArm=False):
		raise NotImplementedError

	def peak(self, trueArm=False):
		"""Largest load and its rotation, (N, rad)."""
		found = minimize_scalar(
			lambda rotation: -self.load(rotation, trueArm),
			bounds=(1e-3 * self.alignment, self.alignment),
			method='bounded',
			options={'xatol': 1e-9},
		)
		return float(-found.fun), float(found.x)

	def exhaustion(self):
		"""Rotation at which the load is back to zero, both thrusts in one line [rad]."""
		return brentq(self.load, self.peak()[1], self.lastTouch, xtol=1e-12)

	def work(self, rotation):
		"""Work of the turning moment on one half-beam from 0 to a rotation, ∫ W L₁/2 dθ [J]."""
		return self.length / 2 * quad(self.load, 0, rotation, epsabs=1e-9, epsrel=1e-9)[0]


class BeamBetweenWalls(_Beam):
	"""Appendix A of Boon et al. (2012): a force acts along the chord through the centroid of the overlap, a right triangle.

	A corner that is δ deep in a wall makes a triangle with the legs δ/sin θ and δ/cos θ on the block's faces; its centroid lies
	y_c = δ(1/tan θ − tan θ)/3 from the corner along the wall, and the chord through it is d = δ(2 + tan²θ)/3. At midspan
	the overlap of both half-beams is two such triangles, mirrored, the chord 2d: with the half of the abutment's stiffness
	(the paper's 50 to 100 MN/m) both corners are equally deep. The paper has that case; here the two
	stiffnesses may be any. W is the weight of one half-beam, or the load at midspan: for both it is W L₁/2 that turns it.
	"""

	def _of(self, rotation):
		tangent = np.tan(rotation)
		return (2 + tangent**2) / 3, (1 / tangent - tangent) / 3

	def penetrations(self, rotation):
		"""δ of the corners behind the abutment's face and the plane of symmetry, for equal thrusts [m]."""
		share = 2 * self.midspanStiffness / (self.abutmentStiffness + 2 * self.midspanStiffness)
		return share * self.shortening(rotation), (1 - share) * self.shortening(rotation)

	def thrust(self, rotation):
		"""H = K d [N]."""
		return self.abutmentStiffness * self._of(rotation)[0] * self.penetrations(rotation)[0]

	def lever(self, rotation):
		"""Lever between both thrusts, l = L₂ cos θ − L₁ sin θ − 2 y_c [m]."""
		return self.height * np.cos(rotation) - self.length * np.sin(rotation) - self._of(rotation)[1] * self.shortening(rotation)

	def load(self, rotation, trueArm=False):
		"""W = H l/(L₁/2) [N]; 0 at θ = 0.

		:param float rotation: θ, from 0 to `lastTouch`; arrays are taken as well [rad]
		:param bool trueArm: from the abutment's contact point to the half-beam's centre, L₁/2 + δ/3, instead of the paper's L₁/2
		"""
		turned = np.where(np.asarray(rotation) == 0, 1e-9, rotation)  # the limits at 0 are regular, the formulae are not
		arm = self.length / 2
		if trueArm:
			arm = (self.length + self.shortening(turned)) / 2 - 2 / 3 * self.penetrations(turned)[0]
		load = np.where(np.asarray(rotation) == 0, 0, self.thrust(turned) * self.lever(turned) / arm)
		return float(load) if np.ndim(rotation) == 0 else load

	def stored(self, rotation):
		"""Elastic energy of one half-beam: its contact at the abutment and one half of that at midspan [J]."""
		thrust = self.thrust(rotation)
		return thrust**2 / 2 * (1 / self.abutmentStiffness + 1 / (2 * self.midspanStiffness))


@dataclasses.dataclass
class BeamOfTwoBlocks(_Beam):
	"""The beam with the contact point at the analytic centre of all planes of both bodies (Eq. 10 of the paper), numerically.

	The abutments are blocks with their middle at the height of the half-beams' middle. Independent of the plug-in: planes in
	exact symmetry, Newton's method to rounding.
	"""

	abutmentHeight: float = 0.138
	abutmentLength: float = 0.046
	wallAtMidspan: bool = False
	"""True: instead of the other half-beam, a rigid block as the abutment (Appendix A's own model), twice as stiff."""

	def load(self, rotation, trueArm=False):
		"""W = H l/(L₁/2) [N], with *trueArm* from the abutment's contact point to the half-beam's centre instead of L₁/2.

		:param float rotation: θ, above 0 (at 0 the limit, 0) [rad]
		"""
		if rotation == 0:
			return 0.0
		shortening = self.shortening(rotation)

		def difference(behind):
			abutment, midspan = self._contacts(rotation, behind)
			return abutment[0] - midspan[0]

		behind = brentq(difference, 1e-3 * shortening, (1 - 1e-3) * shortening, xtol=1e-14)
		(thrust, hinge), (_, upper) = self._contacts(rotation, behind)
		arm = (self.length + shortening) / 2 - behind - hinge[0] if trueArm else self.length / 2
		return thrust * (upper[1] - hinge[1]) / arm

	def _contacts(self, rotation, behind):
		"""Thrust and point of the contact at the abutment and of that at midspan, the corner *behind* the abutment's face."""
		cos, sin = math.cos(rotation), math.sin(rotation)
		corner = np.array([-behind, 0])
		normals = _axes @ np.array([[cos, -sin], [sin, cos]])
		halfBeam = normals, np.array([self.length, 0, self.height, 0]) + normals @ corner
		bottom, top = (self.height - self.abutmentHeight) / 2, (self.height + self.abutmentHeight) / 2
		abutment = _axes, np.array([0, self.abutmentLength, top, -bottom])
		if self.wallAtMidspan:
			stiffness, right = 2 * self.midspanStiffness, (_axes, np.array([self.length + self.abutmentLength, -self.length, top, -bottom]))
		else:  # the half-beam, mirrored in the plane x = L1
			mirrored = halfBeam[0] * [-1, 1]
			stiffness, right = self.midspanStiffness, (mirrored, halfBeam[1] + mirrored @ [2 * self.length, 0])
		# starts: the centroids of Appendix A's triangles
		rise = (1 / math.tan(rotation) - math.tan(rotation)) / 3
		hinge, chord = _analyticCentre(abutment, halfBeam, (-behind / 3, rise * behind))
		cornerHeight, ahead = self.height - self.drop(rotation), self.shortening(rotation) - behind
		inside = ahead / 3 if self.wallAtMidspan else 0
		upper, widerChord = _analyticCentre(halfBeam, right, (self.length + inside, cornerHeight - rise * ahead))
		return (self.abutmentStiffness * chord, hinge), (stiffness * widerChord, upper)


_axes = np.array([[1.0, 0], [-1, 0], [0, 1], [0, -1]])


def _analyticCentre(left, right, start):
	"""Analytic centre of the planes of both bodies, from a point inside, and the horizontal chord through it between their surfaces."""
	normals, offsets = np.concatenate([left[0], right[0]]), np.concatenate([left[1], right[1]])
	point = np.array(start)
	if np.min(offsets - normals @ point) <= 0:
		raise ValueError(f'start: must lie inside both bodies, got {start}')
	for _ in range(100):
		slack = offsets - normals @ point
		gradient, scaled = normals.T @ (1 / slack), normals / slack[:, None]
		step = -np.linalg.solve(scaled.T @ scaled, gradient)
		decrement = math.sqrt(max(-gradient @ step, 0))
		point = point + step / (1 + decrement if decrement > 0.25 else 1)
		if decrement < 1e-12:
			break
	return point, _wayOut(left, point, 1) + _wayOut(right, point, -1)


def _wayOut(body, point, direction):
	"""Horizontal way from a point inside to the surface."""
	normals, offsets = body
	along = direction * normals[:, 0]
	facing = along > 1e-15
	return np.min((offsets - normals @ point)[facing] / along[facing])
