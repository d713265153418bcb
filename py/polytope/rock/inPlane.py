# SPDX-License-Identifier: GPL-2.0-or-later
"""Jointed rock in the plane: x is horizontal, y up, and dips are those seen in the section (apparent dips).

The region is a prism between two planes z = ± half, and all joints are normal to the section: so blocks are prisms, whose outlines are the polygons.
"""

import dataclasses
import itertools
import math

import numpy as np
import scipy

from .joint import Cut, upwardNormal
from .jointRadii import radiiOf
from .jointSets import JointSet

__all__ = ['asPrisms', 'asSegment', 'expectedInPlane', 'flatCut', 'flatSet', 'outlinesOf']

across = 1e-9
"""Sine of the angle to the section at which a dip is seen in its true size."""
fewest = 3
"""Sides of a triangle."""
largeKappa = 50
"""κ from which on normals that point down are too rare to count."""


def asPrisms(parts):
	"""Polygons (normals, offsets) as polyhedra of a thickness of a power of two, which is that of their size."""
	for normals, d in parts:
		if len(normals) != len(d):
			raise ValueError(f'offsets: must be one for each of the {len(normals)} normals, got {len(d)}')
		if len(normals) < fewest:
			raise ValueError(f'normals: a polygon has at least {fewest} sides, got {len(normals)}; add those that close it')
	size = max((float(np.abs(np.array(d, float)).max()) for _, d in parts if len(d)), default=1.0)
	half = 2.0 ** math.ceil(math.log2(size)) if 0 < size < math.inf else 1.0
	return half, [([*((*n, 0) for n in normals), (0, 0, 1), (0, 0, -1)], [*d, half, half]) for normals, d in parts]


def _normalOf(dip, dipDirection):
	"""In the section, upward."""
	east, north, up = upwardNormal(dip, dipDirection)
	if abs(north) > across:
		raise ValueError(
			'jointSets: in the plane dips are those seen in the section; dipDirection must be π/2, it falls towards x, or 3π/2, against it'
		)
	return np.array([east, up, 0.0]) / math.hypot(east, up)


def flatCut(joint):
	"""A single joint as it cuts: through the whole rock, or as long as twice its radius.

	:raises ValueError: naming *jointSets*: a polygon of space, or one that is oblique to the section
	"""
	if joint.corners is not None:
		raise ValueError('jointSets: a Joint.polygon is one of space; in the plane Joint(dip, dipDirection, centre, radius) is a segment')
	x, y, *_ = joint.centre
	return Cut(_normalOf(joint.dip, joint.dipDirection), np.array([x, y, 0.0]), joint.radius or 0.0)


def asSegment(cut):
	"""What a disc is in the plane: its edges bound it, whatever the thickness of the prism."""
	if not cut.radius:
		return cut
	along = np.array([-cut.normal[1], cut.normal[0], 0.0])
	ends = np.array([[*(side * along), side * along @ cut.centre + cut.radius] for side in (1, -1)])
	return dataclasses.replace(cut, radius=0.0, edges=np.concatenate([cut.edges, ends]))


def flatSet(given):
	"""A joint set as it cuts in the plane."""
	values = {field.name: getattr(given, field.name) for field in dataclasses.fields(given)}
	if given.through is not None:
		values['through'] = (*given.through[:2], 0.0)
	return _FlatSet(**values)


class _FlatSet(JointSet):
	@property
	def normal(self):
		return _normalOf(self.dip, self.dipDirection)

	@property
	def intensity(self):
		"""Length of joints in a unit area, P21 [1/m]. Of scattered ones over what a line along the mean normal meets: the mean of |cos| by
		von Mises' distribution, L₋₁(κ)/I₀(κ)."""
		if self.p32 is not None:
			return self.p32
		if self.fisher is None:
			return 1 / self.spacing
		special, kappa = scipy.special, self.fisher
		return (
			1
			/ self.spacing
			/ (special.i1e(kappa) / special.i0e(kappa) if kappa > largeKappa else special.modstruve(-1, kappa) / special.i0(kappa))
		)

	def _normals(self, number, random):
		normal = self.normal
		if self.fisher is None:
			return np.tile(normal, (number, 1))
		turns = random.vonmises(0, self.fisher, number)
		along = np.array([-normal[1], normal[0], 0.0])
		return np.cos(turns)[:, None] * normal + np.sin(turns)[:, None] * along

	def _directions(self, normals, random):
		return np.column_stack([-normals[:, 1], normals[:, 0], np.zeros(len(normals))]) * random.choice([-1, 1], len(normals))[:, None]

	def _parts(self, number, random):
		return random.random(number)

	def _weights(self, reach, radii):
		return [reach, radii.moment(1)]

	def _expected(self, region):
		if self.radius is None:
			return 2 * region.radius * self.intensity
		radii, reach = radiiOf(self.radius), region.radius
		return self.intensity / (2 * radii.moment(1)) * 2 * reach * 2 * (reach + radii.moment(1))

	def _asCut(self, cut):
		return asSegment(cut)


def expectedInPlane(area, jointSets):
	"""Blocks: as many as there are points in which two joints meet, and lines."""
	scaled = [joints.normal * joints.intensity for joints in jointSets]
	lines, points = (
		sum(np.linalg.norm(a) for a in scaled),
		sum(np.linalg.norm(np.cross(a, b)) for a, b in itertools.combinations(scaled, 2)),
	)
	return 1 + lines * math.sqrt(area) + points * area


def outlinesOf(rock, thickness):
	"""The polygons of prisms, which *fromHalfSpaces* takes, and areas and lengths in place of volumes and areas."""
	for k, (normals, offsets) in enumerate(rock.blocks):
		sides = np.abs(normals[:, 2]) < 0.5
		rock.blocks[k], rock.faces[k] = (normals[sides, :2], offsets[sides]), rock.faces[k][sides]
	rock.volumes, rock.areas, rock.sections = rock.volumes / thickness, rock.areas / thickness, rock.sections / thickness
	return rock
