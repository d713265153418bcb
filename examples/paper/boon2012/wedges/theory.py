# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit equilibrium of two rock wedges: one that slides on two planes, one that hangs in a roof (simulations C and D).

Axes: x east, y north, z up. A plane of dip δ and dip direction ψ (clockwise from north) has the upward normal
(sin δ sin ψ, sin δ cos ψ, cos δ). Angles in radians; forces in units of the weight W where a name ends so.
"""

import dataclasses
import math

import numpy as np
from scipy.optimize import brentq, minimize

__all__ = [
	'SlidingWedge',
	'upwardNormal',
	'dipOf',
	'jointForces',
	'roofWedgeFrictionAngle',
	'roofWedgeConstantNormal',
	'horizontalForceUnderWeight',
	'jointClosure',
	'sideAreaOf',
	'stressShare',
]


def upwardNormal(dip, dipDirection):
	"""Upward unit normal (3) of a plane."""
	return np.array([math.sin(dip) * math.sin(dipDirection), math.sin(dip) * math.cos(dipDirection), math.cos(dip)])


def dipOf(normal):
	"""Dip and dip direction in 0…2π of a plane from a normal of any length and sign."""
	x, y, z = np.asarray(normal, float) / np.linalg.norm(normal) * (-1 if normal[2] < 0 else 1)
	return math.acos(min(z, 1.0)), math.atan2(x, y) % (2 * math.pi)


@dataclasses.dataclass
class SlidingWedge:
	"""A wedge that rests on two planes and can slide along their line of intersection (Hoek & Bray 1981, Rock Slope Engineering, ch. 8).

	Forces only: moments are not considered. The planes carry no water, the joints no cohesion.

	:raises ValueError: if the planes are parallel or their line is horizontal, or if the wedge would lift off one of them (then it
	    slides down the other one alone, and stands up to that plane's dip)
	"""

	normalA: np.ndarray
	"""Upward unit normal of plane A."""
	normalB: np.ndarray

	def __post_init__(self):
		line = np.cross(self.normalA, self.normalB)
		length = np.linalg.norm(line)
		if length < 1e-9 or abs(line[2]) < 1e-9 * length:
			raise ValueError('planes A and B: must meet in a line that is not horizontal')
		self.direction = -np.sign(line[2]) * line / length
		if min(self.reactions()) <= 0:
			raise ValueError('planes A and B: the wedge lifts off one of them and slides on the other one alone')

	@classmethod
	def ofDips(cls, dipA, dipDirectionA, dipB, dipDirectionB):
		return cls(upwardNormal(dipA, dipDirectionA), upwardNormal(dipB, dipDirectionB))

	@property
	def plunge(self):
		"""Plunge of the line of intersection, below the horizontal."""
		return math.asin(-self.direction[2])

	@property
	def trend(self):
		"""Trend of the line of intersection, clockwise from north."""
		return math.atan2(self.direction[0], self.direction[1]) % (2 * math.pi)

	def transverse(self):
		"""Unit vectors in plane A and in plane B, normal to the direction of sliding, each pointing up."""
		vectors = [np.cross(self.direction, normal) for normal in (self.normalA, self.normalB)]
		return [vector if vector[2] > 0 else -vector for vector in vectors]

	def reactions(self, shearA=0.0, shearB=0.0):
		"""Normal forces over W (R_A, R_B) with these transverse shear forces over W on the wedge, positive up in the plane."""
		transverseA, transverseB = self.transverse()
		down = np.array([0, 0, -1.0])
		load = down - down.dot(self.direction) * self.direction + shearA * transverseA + shearB * transverseB
		return np.linalg.lstsq(np.stack([self.normalA, self.normalB], axis=1), -load, rcond=None)[0]

	def frictionAngle(self, shearA=0.0, shearB=0.0):
		"""Friction angle at which the wedge begins to slide.

		Without transverse shear tan φ = sin(plunge) / ((R_A + R_B)/W). What transverse shear force is locked into a face is part of its
		strength; it also changes R_A and R_B: φ solves Σ √((R_i tan φ)² − T_i²) = W sin(plunge).

		:param float shearA, shearB: transverse shear forces over W, as for reactions()
		:raises ValueError: if a face would be in tension with these
		"""
		normal, shear = np.array(self.reactions(shearA, shearB)), np.abs([shearA, shearB])
		if min(normal) <= 0:
			raise ValueError('shearA, shearB: with these a face would be in tension')

		def strength(tangent):
			return sum(math.sqrt(max((n * tangent) ** 2 - t**2, 0)) for n, t in zip(normal, shear, strict=True))

		least = max(shear / normal)  # the transverse shear alone needs this
		driving = math.sin(self.plunge)
		if strength(least) >= driving:
			return math.atan(least)
		return math.atan(brentq(lambda tangent: strength(tangent) - driving, least, least + 2 * driving / min(normal) + 1, xtol=1e-14))

	def lowerBound(self):
		"""Lowest friction angle with a statically admissible state: (angle, shearA, shearB) over all locked-in transverse shear forces.

		By the static theorem nothing that obeys equilibrium and friction stands below it; what a wedge stands at lies between this
		and frictionAngle(), depending on its history.
		"""
		found = minimize(
			lambda shear: self.frictionAngle(*shear), (0.0, 0.0), method='Nelder-Mead', options={'xatol': 1e-9, 'fatol': 1e-13}
		)
		return found.fun, *found.x


def jointForces(horizontalStress, area, inclination):
	"""Normal and up-dip shear force (N, S) on a wedge's face in a stress field with σ_h both ways and σ_v = 0.

	:param float horizontalStress: [Pa], positive in compression
	:param float area: of the face [m²]
	:param float inclination: α, of the joint from the vertical
	:returns: [N]; their resultant is horizontal, σ_h A cos α
	"""
	horizontal = horizontalStress * area * math.cos(inclination)
	return horizontal * math.cos(inclination), horizontal * math.sin(inclination)


def roofWedgeFrictionAngle(weight, horizontalForce, inclination):
	"""Friction angle at which a symmetric roof wedge falls: φ = α + atan(W/ΣH).

	The force of each joint on the wedge has the horizontal part H and lifts W ΣH⁻¹ H; its angle to the joint's normal is φ. It needs no
	more than equilibrium and symmetry. ΣH is σ_h ΣA cos α for kn = ks (Boon et al. 2012, simulation D), as the wedge's elastic
	settlement leaves H unchanged then; otherwise see horizontalForceUnderWeight().

	:param float weight: W [N]
	:param float horizontalForce: ΣH, sum of the horizontal forces' sizes on the wedge's faces [N]
	:param float inclination: α, of the joints from the vertical
	"""
	return inclination + math.atan(weight / horizontalForce)


def roofWedgeConstantNormal(weight, normalForce, inclination):
	"""What a constant normal force would give, wrongly: the joints open as the wedge settles.

	:param float normalForce: ΣN over all faces before the weight came on [N]
	"""
	return math.atan((weight / normalForce + math.sin(inclination)) / math.cos(inclination))


def horizontalForceUnderWeight(weight, horizontalForce, inclination, normalStiffness, shearStiffness):
	"""ΣH [N] after the weight has come on elastically: the wedge goes down by u, N by kn u sin α, S up by ks u cos α.

	:param float horizontalForce: ΣH before, of a state in equilibrium without the weight [N]
	:param float normalStiffness, shearStiffness: of all faces together, in any unit: the ratio counts
	"""
	sine, cosine = math.sin(inclination), math.cos(inclination)
	settlement = weight / (normalStiffness * sine**2 + shearStiffness * cosine**2)
	return horizontalForce + (shearStiffness - normalStiffness) * sine * cosine * settlement


def stressShare(area, sideArea, inclination=math.pi / 6, stiffnessRatio=1.0):
	"""σ_eff/σ_h of a roof wedge between three rigid blocks of 120° that touch each other: (A + 2 A_v)/(A + 3 A_v) for α = 30° and kn = ks.

	The blocks are pressed inward by c by a boundary stress σ_h, with the wedge free to rise and weightless. The joint with the wedge
	takes g kn A c, g = 1/(cos²α + kn/ks sin²α), each of the two joints with the neighbours √3 kn A_v c, normal to it, of which √3/2 is
	radial: kn c (g A + 3 A_v) in all, against the boundary's σ_h (A cos α + √3 A_v). Side joints are stiffer than their share of the
	stress, so the wedge gets less than σ_h.

	:param float area: A, of the joint between wedge and block [m²]
	:param float sideArea: A_v, of the vertical joint between two blocks [m²]
	:param float stiffnessRatio: ks/kn of all joints [-]
	"""
	cosine = math.cos(inclination)
	return (area * cosine + math.sqrt(3) * sideArea) / cosine / (area + 3 * sideArea / _radialStiffness(inclination, stiffnessRatio))


def sideAreaOf(area, share, inclination=math.pi / 6, stiffnessRatio=1.0):
	"""A_v [m²] of a given stressShare()."""
	cosine = math.cos(inclination)
	return area * cosine * (1 - share) / (3 * share * cosine / _radialStiffness(inclination, stiffnessRatio) - math.sqrt(3))


def jointClosure(horizontalStress, inclination, normalStiffness, shearStiffness):
	"""How far the blocks around a roof wedge move inward under σ_h, the wedge being free to rise [m]: σ_h cos α (cos²α/kn + sin²α/ks).

	:param float normalStiffness, shearStiffness: [Pa/m]
	"""
	return horizontalStress * math.cos(inclination) / normalStiffness / _radialStiffness(inclination, shearStiffness / normalStiffness)


def _radialStiffness(inclination, stiffnessRatio):
	"""g: horizontal force of a joint over kn A times its horizontal closure, when it passes on no vertical force."""
	return 1 / (math.cos(inclination) ** 2 + math.sin(inclination) ** 2 / stiffnessRatio)
