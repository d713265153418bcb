# SPDX-License-Identifier: GPL-2.0-or-later
"""A rock mass cut into blocks by sets of joints.

Blocks are lists of half-spaces, so a joint cuts a block in two by being added to it once from either side (src/shape/JointedBlocks.hpp; Boon,
Houlsby & Utili 2015, "A new rock slicing method based on linear programming", Computers and Geotechnics 65:12-29). Coordinates: x east, y north, z up.
"""

import dataclasses
import itertools
import math
import numbers
from collections.abc import Iterable

import numpy as np
import scipy  # loads its packages at their first use: half a second
from yade import _polytope

from .arguments import flag, numbersOf, vector, vectors
from .precision import isNumber, real

__all__ = ['JointSet', 'JointedRock', 'jointedRock']

mostBlocks = 1e5
"""Expected number of blocks: more are refused, since such a scene could not be run; a spacing in a wrong unit is more likely."""

smallestFraction = 0.01
"""Default inscribed radius of the smallest piece over the smallest spacing, or over the region's own inscribed radius if that is less: thinner
pieces need a shorter time step and carry no load."""

oneRounding = 1e-12
"""[rad]: a dip this much above π/2 is vertical."""

scatterReach = 3
"""Over the region's radius: how far from its centre, along the mean normal, scattered joints still start that may cross it."""


@dataclasses.dataclass(frozen=True)
class JointSet:
	"""Joints (discontinuities) of one family. Each is a plane that cuts through the whole rock mass: fully persistent.

	:param float dip: angle of the planes below the horizontal [rad], 0…π/2
	:param float dipDirection: azimuth of the line of dip, clockwise from north (y) as seen from above [rad]
	:param float spacing: mean distance between neighbouring joints along the mean normal [m]
	:param through: a point on one of the joints [m]; default the region's centroid. Not with *exponential*.
	:param bool exponential: distances drawn from the negative exponential distribution (Priest & Hudson 1976, Int. J. Rock Mech.
	    Min. Sci. 13:135-148) rather than all equal
	:param float fisher: constant κ of Fisher's distribution of the normals about the mean one (Fisher 1953, Proc. R. Soc. A
	    217:295-305): the larger the closer together; None: all parallel
	:raises ValueError: naming the argument
	"""

	dip: float
	dipDirection: float
	spacing: float
	through: tuple = None
	exponential: bool = False
	fisher: float = None

	def __post_init__(self):
		if not _finite(self.dip) or not 0 <= self.dip <= math.pi / 2 + oneRounding:
			raise ValueError(f'dip: must be from 0 to π/2 (radians), got {self.dip!r}')
		if not _finite(self.dipDirection) or abs(self.dipDirection) > 2 * math.pi:
			raise ValueError(f'dipDirection: must be an azimuth in radians, within ±2π, got {self.dipDirection!r}')
		if not _finite(self.spacing) or not self.spacing > 0:
			raise ValueError(f'spacing: must be positive and finite [m], got {self.spacing!r}')
		flag(self.exponential, 'exponential')
		if self.through is not None:
			if self.exponential:
				raise ValueError('through: random distances (exponential) have no joint at a given point; leave it out')
			object.__setattr__(self, 'through', tuple(float(x) for x in vector(self.through, 'through')))
		if self.fisher is not None and not (_finite(self.fisher) and self.fisher > 0):
			raise ValueError(f"fisher: must be positive and finite (Fisher's constant), or None for parallel joints, got {self.fisher!r}")

	@property
	def normal(self):
		"""Unit normal of the mean plane, upward."""
		horizontal = math.sin(self.dip)
		return np.array([horizontal * math.sin(self.dipDirection), horizontal * math.cos(self.dipDirection), math.cos(self.dip)])

	def planes(self, centre, radius, random):
		"""Joints that may cross a ball.

		:param centre: of the ball [m], from which d is measured
		:param float radius: of the ball [m]
		:param numpy.random.Generator random: for distances and normals
		:returns: (n, 4) array, rows a_x, a_y, a_z, d of planes a·x = d with unit normals
		"""
		reach = radius * (1 if self.fisher is None else scatterReach)
		if self.exponential:
			along = random.uniform(-reach, reach, random.poisson(2 * reach / self.spacing))
		else:
			first = 0.0 if self.through is None else float(self.normal @ (np.array(self.through) - centre))
			along = first + self.spacing * np.arange(math.ceil((-reach - first) / self.spacing), math.floor((reach - first) / self.spacing) + 1)
		if self.fisher is None:
			normals = np.tile(self.normal, (len(along), 1))
		else:
			normals = scipy.stats.vonmises_fisher(self.normal, self.fisher, seed=random).rvs(len(along)).reshape(-1, 3)
		return np.column_stack([normals, along * (normals @ self.normal)])


@dataclasses.dataclass
class JointedRock:
	"""What *jointedRock* made."""

	blocks: list
	"""(normals, offsets) of each block in world coordinates, for *fromHalfSpaces*, without redundant planes."""
	volumes: np.ndarray
	"""Of the blocks [m³]."""
	joints: np.ndarray
	"""(n, 4) planes a·x = d of all joints that cut a block, unit normals."""
	uncut: int
	"""Cuts that were not made, as they would have left a piece below *smallest*."""


def jointedRock(normals, offsets, jointSets, smallest=None, seed=0):
	"""Cut a convex region of rock into blocks by sets of joints::

		slope = polytope.jointedRock(normals, offsets, [polytope.JointSet(radians(35), radians(90), spacing=2), …])
		O.bodies.append([polytope.fromHalfSpaces(*block) for block in slope.blocks])

	The blocks fill the region and touch without overlap, to the rounding of double (in YADE's wider precisions, too). Joints
	cut one after the other, set by set: where *smallest* keeps a cut from being made, the order matters. For a region that is not convex cut convex parts of it.

	:param normals: (n, 3) outward normals of the region, of any length [-]
	:param offsets: n offsets, in units of the normals' length [m]: {x : normals[i]·x ≤ offsets[i] for all i}
	:param jointSets: sequence of *JointSet*
	:param float smallest: inscribed radius [m] below which no piece is cut off: the block stays whole there; default a hundredth
	    of the smallest spacing or of the region's own inscribed radius
	:param int seed: of the random distances and normals
	:returns: *JointedRock*
	:raises ValueError: naming the argument: what *fromHalfSpaces* refuses of a region, no joint sets, more than 100 000
	    blocks to be expected, *smallest* negative or above the region's inscribed radius, *seed* negative
	"""
	jointSets = list(jointSets) if isinstance(jointSets, Iterable) else []
	if not jointSets or not all(isinstance(joints, JointSet) for joints in jointSets):
		raise ValueError('jointSets: must be a sequence of one or more JointSet')
	if isinstance(seed, bool) or not isinstance(seed, numbers.Integral) or seed < 0:
		raise ValueError(f'seed: must be a whole number from 0 on, got {seed!r}')
	given = _polytope.polyhedron(vectors(normals, 'normals', 3), numbersOf(offsets, 'offsets'))
	# about the region's centroid, where numbers are small
	centre, normals = (np.array(given[name], float) for name in ('centroid', 'normals'))
	offsets = np.array(given['offsets'], float) - normals @ centre
	radius = float(np.linalg.norm(np.array(given['vertices'], float) - centre, axis=1).max())
	inscribedRadius = float(given['inscribedRadius'])
	if smallest is None:
		smallest = smallestFraction * min(inscribedRadius, *(joints.spacing for joints in jointSets))
	if not _finite(smallest) or not 0 <= smallest <= inscribedRadius:
		raise ValueError(
			f"smallest: must be from zero to the region's own inscribed radius, {inscribedRadius:.6g} m, got {smallest!r}: no piece has more"
		)
	expected = _expectedBlocks(float(given['volume']), jointSets)
	if expected > mostBlocks:
		raise ValueError(f'jointSets: about {expected:.2g} blocks are to be expected, at most {mostBlocks:.0g} can be; is a spacing in another unit?')
	random = np.random.default_rng(seed)
	planes = np.concatenate([joints.planes(centre, radius, random) for joints in jointSets])
	cut = _polytope.jointedBlocks(*_exactly(normals, offsets), *_exactly(planes[:, :3], planes[:, 3]), real(smallest))
	faces = np.frombuffer(cut['planes']).reshape(-1, 4).copy()
	normals, offsets = faces[:, :3], faces[:, 3] + faces[:, :3] @ centre
	joints = planes[np.frombuffer(cut['cutting'], np.int32)]
	joints[:, 3] += joints[:, :3] @ centre
	ends = np.cumsum(np.frombuffer(cut['counts'], np.int32))
	return JointedRock(
		[(normals[begin:end], offsets[begin:end]) for begin, end in zip([0, *ends[:-1]], ends, strict=True)],
		np.frombuffer(cut['volumes']).copy(),
		joints,
		cut['uncut'],
	)


def _expectedBlocks(volume, jointSets):
	"""As many as there are points in which three joints meet, within the region, lines on its surface in which two do, and so on."""
	length, scaled = volume ** (1 / 3), [joints.normal / joints.spacing for joints in jointSets]
	planes = sum(np.linalg.norm(a) for a in scaled)
	lines = sum(np.linalg.norm(np.cross(a, b)) for a, b in itertools.combinations(scaled, 2))
	points = sum(abs(np.linalg.det(three)) for three in itertools.combinations(scaled, 3))
	return 1 + planes * length + lines * length**2 + points * volume


def _finite(value):
	return isNumber(value) and not isinstance(value, bool) and math.isfinite(value)


def _exactly(normals, offsets):
	return vectors(normals, 'normals', 3), numbersOf(offsets, 'offsets')
