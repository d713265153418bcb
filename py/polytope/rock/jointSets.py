# SPDX-License-Identifier: GPL-2.0-or-later
"""Random joints of one family: planes, or discs at random places."""

import dataclasses
import math

import numpy as np
import scipy  # loads its packages at their first use: half a second

from ..arguments import flag, point
from .joint import Cut, areasOf, checkedAngles, finite, inSpace, positive, upwardNormal
from .jointRadii import radiiOf

__all__ = ['JointSet']

scatterReach = 3
"""Distance over the region's radius: how far from its centre, along the mean normal, scattered joints still start that may cross it."""
mostJoints = 1e6
"""Joints to be drawn for one set: more are refused, as more blocks than can be run; a radius or P32 in a wrong unit is more likely."""
drawnAtOnce = 256
"""Joints drawn before their area is summed."""


@dataclasses.dataclass(frozen=True)
class JointSet:
	"""Joints (discontinuities) of one family: planes through the whole rock mass, or, with a *radius*, discs.

	Planes are *spacing* apart. Discs have their centres anywhere, in the region and around it, with equal probability (a Poisson process: there are
	no more and no fewer joints near the region's faces), and are drawn until their area in the region is what *p32*, or *spacing*, asks for.

	:param float dip: angle of the planes below the horizontal [rad], 0…π/2
	:param float dipDirection: azimuth of the line of dip, clockwise from north (y) as seen from above [rad]
	:param float spacing: mean distance between neighbouring joints along the mean normal [m]
	:param through: a point on one of the joints [m], in the plane of two components or three; default the region's centroid. Only for equal
	    distances.
	:param bool exponential: distances drawn from the negative exponential distribution (Priest & Hudson 1976, Int. J. Rock Mech.
	    Min. Sci. 13:135-148) rather than all equal. Those of discs are.
	:param float fisher: constant κ of Fisher's distribution of the normals about the mean one (Fisher 1953, Proc. R. Soc. A
	    217:295-305): the larger the closer together; None: all parallel
	:param float p32: area of joints in a unit volume [1/m], in place of *spacing*; distances are random
	:param radius: of discs [m]: a number, ('exponential', mean), ('lognormal', mean, standard deviation), or ('powerLaw', smallest,
	    largest, exponent), the density of radii in proportion to r^−exponent; None: planes
	:param float termination: probability that a disc which meets a joint of an earlier set, or an earlier single joint, ends there
	:param float persistence: probability that a block which a joint reaches into is cut by it, 0…1
	:raises ValueError: naming the argument
	"""

	dip: float
	dipDirection: float
	spacing: float = None
	through: tuple = None
	exponential: bool = False
	fisher: float = None
	p32: float = None
	radius: object = None
	termination: float = 0.0
	persistence: float = 1.0

	def __post_init__(self):
		checkedAngles(self.dip, self.dipDirection)
		if self.p32 is None or self.spacing is not None:
			positive(self.spacing, 'spacing', 'or give p32')
		if self.p32 is not None:
			positive(self.p32, 'p32', 'area of joints per volume [1/m]')
			if self.spacing is not None:
				raise ValueError('p32: give it or spacing, not both')
		flag(self.exponential, 'exponential')
		if self.through is not None:
			if self.exponential or self.random:
				raise ValueError(
					'through: random distances (exponential, p32, radius) have no joint at a given point; leave it out, or add a Joint there'
				)
			object.__setattr__(self, 'through', point(self.through, 'through'))
		if self.fisher is not None and not (finite(self.fisher) and self.fisher > 0):
			raise ValueError(f"fisher: must be positive and finite (Fisher's constant), or None for parallel joints, got {self.fisher!r}")
		if self.radius is not None:
			radiiOf(self.radius)
		if not finite(self.termination) or not 0 <= self.termination <= 1:
			raise ValueError(f'termination: must be a probability, 0…1, got {self.termination!r}')
		if self.termination and self.radius is None:
			raise ValueError('termination: planes run through the whole rock; give the set a radius')
		if not finite(self.persistence) or not 0 < self.persistence <= 1:
			raise ValueError(f'persistence: must be a probability above 0, up to 1, got {self.persistence!r}')

	@property
	def random(self):
		"""Whether joints are drawn until their area is reached."""
		return self.p32 is not None or self.radius is not None

	@property
	def intensity(self):
		"""P32 that is asked for [1/m]. A line along the mean normal meets scattered joints less often than parallel ones, by the mean cosine."""
		if self.p32 is not None:
			return self.p32
		return 1 / self.spacing / (1 if self.fisher is None else 1 - math.tanh(self.fisher / 2) / self.fisher)

	@property
	def normal(self):
		"""Unit normal of the mean plane, upward."""
		return upwardNormal(self.dip, self.dipDirection)

	def planes(self, centre, radius, random):
		"""Planes at their distances that may cross a ball.

		:param centre: of the ball [m], from which d is measured
		:param float radius: of the ball [m]
		:param numpy.random.Generator random: for distances and normals
		:returns: (n, 4) array, rows a_x, a_y, a_z, d of planes a·x = d with unit normals
		"""
		reach = radius * (1 if self.fisher is None else scatterReach)
		if self.exponential:
			along = random.uniform(-reach, reach, random.poisson(2 * reach / self.spacing))
		else:
			first = 0.0 if self.through is None else float(self.normal @ (inSpace(self.through, 'through') - centre))
			along = first + self.spacing * np.arange(
				math.ceil((-reach - first) / self.spacing), math.floor((reach - first) / self.spacing) + 1
			)
		normals = self._normals(len(along), random)
		return np.column_stack([normals, along * (normals @ self.normal)])

	def cuts(self, region, earlier, entry, random):
		"""The set's joints in a region (region.Region), about its centre; the larger ones first.

		:param Earlier earlier: the joints that these may end at
		:param int entry: number of the set
		"""
		if not self.random:
			planes = self.planes(region.centre, region.radius, random)
			return [Cut(row[:3], row[3] * row[:3], persistence=self.persistence, entry=entry) for row in planes]
		wanted, found, area = self.intensity * region.volume, [], 0.0
		self._refuseTooMany(region, wanted)
		while area < wanted:
			drawn = self._drawn(region, earlier, entry, random)
			for cut, own in zip(drawn, areasOf(list(map(self._asCut, drawn)), region.parts).tolist(), strict=True):
				if not own > 0:
					continue
				nearer = area + own - wanted < wanted - area
				area += own
				if nearer:
					found.append(cut)
				if area >= wanted:
					break
		return sorted(found, key=lambda cut: -cut.radius)

	def _drawn(self, region, earlier, entry, random):
		"""Some joints that may reach into the ball about the region: along its normal the centre of each is within the ball, across within
		the sum of both radii."""
		normals = self._normals(drawnAtOnce, random)
		heights = random.uniform(-region.radius, region.radius, drawnAtOnce)
		centres = heights[:, None] * normals
		if self.radius is None:
			return [Cut(n, c, persistence=self.persistence, entry=entry) for n, c in zip(normals, centres, strict=True)]
		sizes = self._sizes(region.radius, random)
		directions = self._directions(normals, random)
		centres += ((region.radius + sizes) * self._parts(drawnAtOnce, random))[:, None] * directions
		cuts = [Cut(n, c, float(r), persistence=self.persistence, entry=entry) for n, c, r in zip(normals, centres, sizes, strict=True)]
		if self.termination:
			for cut in cuts:
				earlier.end(cut, self.termination, random)
		return cuts

	def _asCut(self, cut):
		"""The cut of a joint in the form in which it bounds blocks; a set in the plane has another."""
		return cut

	def _directions(self, normals, random):
		"""Unit vectors across these normals."""
		directions = np.cross(normals, random.normal(size=(len(normals), 3)))
		return directions / np.linalg.norm(directions, axis=1)[:, None]

	def _parts(self, number, random):
		"""Each centre's distance from the middle, over the distance within which centres lie evenly."""
		return np.sqrt(random.random(number))

	def _weights(self, reach, radii):
		"""Weights of the radii to the powers 0, 1, 2: together (reach + r)², in proportion to which centres lie near enough."""
		return [reach**2, 2 * reach * radii.moment(1), radii.moment(2)]

	def _sizes(self, reach, random):
		"""Radii weighted by how many centres lie near enough."""
		radii = radiiOf(self.radius)
		shares = np.array(self._weights(reach, radii))
		powers = random.choice(len(shares), drawnAtOnce, p=shares / shares.sum())
		sizes = np.empty(drawnAtOnce)
		for power in range(len(shares)):
			sizes[powers == power] = radii.draw(power, int((powers == power).sum()), random)
		return sizes

	def _refuseTooMany(self, region, wanted):
		expected = self._expected(region)
		if expected > mostJoints:
			raise ValueError(
				f'jointSets: a set of about {expected:.2g} joints, at most {mostJoints:.0g} can be; is a radius or P32 in another unit?'
			)

	def _expected(self, region):
		"""Joints to be drawn."""
		if self.radius is None:
			return 2 * region.radius * self.intensity
		radii, reach = radiiOf(self.radius), region.radius
		perVolume = self.intensity / (math.pi * radii.moment(2))
		return perVolume * 2 * reach * math.pi * (reach**2 + 2 * reach * radii.moment(1) + radii.moment(2))

	def _normals(self, number, random):
		if self.fisher is None:
			return np.tile(self.normal, (number, 1))
		return scipy.stats.vonmises_fisher(self.normal, self.fisher, seed=random).rvs(number).reshape(-1, 3)
