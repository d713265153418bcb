# SPDX-License-Identifier: GPL-2.0-or-later
"""Meaning of the axes of pairs (PairAxes.cpp), and the limits that docs/accuracy.md states for them."""

import dataclasses
import math

__all__ = ['Axis', 'Limit', 'axes']


@dataclasses.dataclass
class Limit:
	"""The worst value of a quantity over all samples of a range of the axis must not be above `most`.

	Errors count where the contact's status raises no doubt (see pairTables.quiet); any other status is a warning, and Axis.unjudged limits
	how many there may be.
	"""

	text: str
	quantity: str
	"""A column of the CSV, or a name of pairTables.derived."""
	most: float
	low: float = -math.inf
	high: float = math.inf
	least: float = 0.0


@dataclasses.dataclass
class Axis:
	title: str
	label: str
	"""Label of the values."""
	limits: list
	note: str = ''
	unjudged: float = 0
	"""Largest share of samples of which no error is judged (pairTables.unjudged): refused, with a status that is a warning, or without a
	reference for the normal. Where it is above zero the note says which they are; the figure is what the pairs of this axis gave."""


depths = [
	Limit('s* over the size', 'infeasibilityError', 1e-14),
	Limit('depth over the size', 'depthError', 2e-14),
]
"""What holds on most axes."""

axes = {
	'depth': Axis(
		'Overlap depth',
		'overlap −s* over the size',
		[
			*depths,
			Limit('contact point over the overlap, overlaps down to 1e-6', 'centreError', 3e-9, low=0.9e-6),
			Limit('contact point over the size, beyond 3e-9 of the overlap, overlaps down to 1e-14', 'centreTimesOverlap', 5e-15),
		],
		'Below 1e-14 of the size the sign of s* is rounding, and the pair counts as separated. The contact point is as uncertain as the '
		'planes’ rounding over the overlap: 1 % of the overlap’s own size at 1e-13.',
	),
	'aspect': Axis(
		'Aspect ratio: plates and needles',
		'length over thickness',
		[
			Limit('s* over the size', 'infeasibilityError', 1e-14),
			Limit('depth × normal over the size', 'forceError', 1e-12),
			Limit('contact point over the overlap, up to 1e8', 'centreError', 1e-4, high=1.1e8),
		],
		'The overlap is a tenth of the thickness. Errors are of the size, so a plate’s depth is known to 1e-15 × aspect ratio of its thickness.',
	),
	'size': Axis(
		'Size ratio of the pair',
		'larger over smaller body',
		[
			Limit('s* over the larger body’s size', 'infeasibilityOfLarger', 1e-14),
			Limit('depth over the larger body’s size', 'depthOfLarger', 2e-14),
		],
		'The bodies’ distance and the larger one’s planes are rounded by its size: a grain on a block a million times larger has its depth '
		'to 1e-9 of the grain.',
	),
	'coordinates': Axis(
		'Coordinates',
		'distance from the origin over the size',
		[
			*depths,
			Limit('contact point over the overlap', 'centreError', 1e-9),
			Limit('change of s* by the positions’ own rounding, over the distance', 'movedOverDistance', 1e-15, low=0.5),
		],
		'Contacts are computed from the difference of positions: nothing is lost beyond the rounding of the positions themselves, 1e-16 of '
		'the distance.',
	),
	'angle': Axis(
		'Angle between nearly parallel faces',
		'angle (rad)',
		[
			*depths,
			Limit('contact point over the size, beyond 3e-9 of the overlap', 'centreTimesOverlap', 5e-15),
		],
		'wedge: the overlap ends within the faces, a tenth of the angle deep; whole face: it is 1e-2 deep.',
	),
	'twins': Axis(
		'Two planes of one body that nearly agree',
		'angle between them (rad)',
		[*depths, Limit('contact point over the overlap', 'centreError', 1e-9)],
	),
	'planes': Axis(
		'Planes per body',
		'planes',
		[*depths, Limit('contact point over the overlap', 'centreError', 1e-8)],
	),
	'redundant': Axis(
		'Redundant and duplicated planes',
		'planes added to a box',
		[*depths, Limit('contact point over the overlap', 'centreError', 3e-9)],
		'Copies move the analytic centre by definition (they are kept); the reference has them too.',
	),
	'touching': Axis(
		'Exactly touching',
		'gap in roundings of the size (2.2e-16)',
		[
			Limit('s* over the size', 'infeasibilityError', 1e-14),
			Limit('least overlap called a contact, in roundings', 'overlapCalledContact', 200, least=30),
			Limit('largest overlap called separated, in roundings', 'overlapCalledSeparated', 60),
		],
		'A pair touches from −s* = 45 roundings on. Where parallel edges overlap by less '
		'than 2e-11 of their length, how the weights balance along them is decided by the rounding of the planes’ normals: the normal may be that of '
		'either face.',
	),
	'coincident': Axis(
		'Identical bodies in one place',
		'distance of their centres over the size',
		[
			depths[0],
			# eight roundings, what planes and positions leave of s* (Reference.cpp): the normal is as uncertain as they are over the distance
			Limit('depth over the size × distance of the centres over the size', 'depthTimesDistance', 8 * 2.0**-52),
		],
		'The direction between two bodies that nearly coincide is as uncertain as rounding over their distance, and so is the depth along it. Where no '
		'direction leads out: normalFromDual or noDirection (the normal along the line of centres).',
		unjudged=0.31,
	),
	'inside': Axis(
		'One body inside the other',
		'inner over outer body',
		[Limit('s* over the size', 'infeasibilityError', 1e-14)],
		'No plane of the outer body is near: noDirection, so only s* is judged.',
		unjudged=1,
	),
	'deep': Axis(
		'Overlap beyond the corner radius',
		'overlap −s* over the corner radius',
		[*depths, Limit('contact point over the overlap', 'centreError', 1e-9)],
		'Deeper than cornerRadius in one body the normal is the other’s (normalFromOneBody), in both the program’s dual direction '
		'(normalFromDual), checked to lead out: moved along it by what it promises, the pair is free in exact arithmetic.',
		unjudged=0.02,
	),
	'units': Axis(
		'Units',
		'one size in metres',
		[*depths, Limit('difference to the answer in metres, scaled', 'deviation', 1e-11)],
		'From 1e-45 to 1e45 m; lengths outside 1e-50 … 1e50 m, here at 1e-60, are refused (planes 1e60 m away are what the kernel fills its vectors with).',
		unjudged=0.072,
	),
}
