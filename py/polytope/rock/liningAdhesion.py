# SPDX-License-Identifier: GPL-2.0-or-later
"""Adhesion of a lining to blocks: its strength, and which blocks the lining may stick to."""

import dataclasses
import math

import numpy as np
from yade import O, Polytope, RockJointMat

from ..arguments import number
from ..scene.present import interactionLoops, isPerArea, jointMakers
from ..scene.vertices import worldVertices

__all__ = ['Adhesion', 'blocksNear', 'positive']


@dataclasses.dataclass(frozen=True)
class Adhesion:
	"""Strength with which a lining sticks to the blocks that it lies on, as sprayed concrete does, until it fails. Its stiffnesses and its
	friction angle are those of the joint between the two RockJointMats."""

	tensileStrength: float
	"""Strength against the stress normal to the face, bending included [Pa]; infinity: does not fail."""
	shearStrength: float
	"""Strength against the shear stress without normal stress, the cohesion [Pa]; infinity: does not fail."""
	gap: float | None = None
	"""Largest distance of lining and block [m]; None: they touch."""


def positive(value, name, infinite=False):
	value = float(number(value, name))
	if not 0 < value or not (infinite or value < math.inf):
		raise ValueError(f'{name}: must be positive' + ('' if infinite else ' and finite') + f', got {value:g}')
	return value


def blocksNear(made, chain, width, axis, adhesion, flat):
	"""(segment, id) of blocks whose bounding boxes meet, by the segment's number; refuses those that the adhesion does not fit."""
	if not isinstance(adhesion, Adhesion):
		raise ValueError(f'adhesion: must be a polytope.Adhesion(tensileStrength, shearStrength), got {adhesion!r}')
	for name in ('tensileStrength', 'shearStrength'):
		positive(getattr(adhesion, name), f'adhesion: {name}', True)
	gap = 0.0 if adhesion.gap is None else float(number(adhesion.gap, 'adhesion: gap'))
	if not 0 <= gap < math.inf:
		raise ValueError(f'adhesion: its gap must be a finite distance, at least 0 [m], got {gap:g}')
	depth = np.abs(axis) * (0 if flat else width / 2)
	boxes = [(outline.min(axis=0) - depth, outline.max(axis=0) + depth) for outline in chain.outlines]
	margin = gap + 1e-3 * max(float(np.ptp(chain.outlines[0], axis=0).max()), width)
	makers, near = jointMakers(interactionLoops()), []
	blocks = [other for other in O.bodies if isinstance(other.shape, Polytope) and (other.shape.dimension == 2) == flat]
	for other in blocks:
		corners = worldVertices(other)
		low, high = corners.min(axis=0) - margin, corners.max(axis=0) + margin
		near += [(k, other.id) for k, box in enumerate(boxes) if (low <= box[1]).all() and (box[0] <= high).all()]
	for one in [made[0], *(O.bodies[k] for k in sorted({k for _, k in near}))]:
		if not isinstance(one.material, RockJointMat) or not isPerArea(one.material, makers):
			which = 'the lining' if one is made[0] else f'block {one.id}'
			raise ValueError(
				f'adhesion: needs stiffnesses per area, but the material of {which} is no RockJointMat that has them; give it one'
			)
	return near
