# SPDX-License-Identifier: GPL-2.0-or-later
"""Outlines of a lining's segments along a line of points, cut at each corner along the bisector, so that neighbours share a face."""

import math
from typing import NamedTuple

import numpy as np

from ..arguments import vector

__all__ = ['Chain', 'axisOf', 'divided', 'segmentsOf']

sides = {'left': (0, 1), 'right': (-1, 0), 'middle': (-0.5, 0.5)}
"""Where both faces lie, to the left of the points, in thicknesses."""

outOfPlane = 1e-6
"""Tolerance on a point of the line, as a part of the line's extent: how far it may lie out of the line's plane, for coordinates written
with six digits."""

sharpest = math.radians(90)
"""Largest turn of the line at a point [rad]: beyond it a joint that is cut along the bisector is no section of a beam."""


class Chain(NamedTuple):
	outlines: list
	"""(4, 3) corners of each segment [m]"""
	lengths: np.ndarray
	"""(joints,) length of beam for which the joint stands: half of both segments, along the middle of the thickness [m]"""
	cosines: np.ndarray
	"""(joints,) of half the angle by which the line turns there"""
	distances: np.ndarray
	"""(joints,) along the middle of the thickness [m]"""


def axisOf(axis, points):
	"""Unit vector across the plane of the points."""
	if points.shape[1] == 2:
		if axis is not None:
			raise ValueError('axis: is z where points have two components; leave it out, or give points of three')
		return np.array([0.0, 0.0, 1.0])
	if axis is None:
		raise ValueError(
			'axis: must be given where points have three components: the direction of the width, for example that of the tunnel'
		)
	axis = np.array(vector(axis, 'axis'), float)
	if not axis.any():
		raise ValueError('axis: must not be zero')
	axis /= np.linalg.norm(axis)
	away = np.abs((points - points[0]) @ axis)
	if away.max() > outOfPlane * np.ptp(points, axis=0).max():
		raise ValueError(
			f'points: must lie in one plane normal to the axis; point {away.argmax()} is {away.max():g} m out of that of the first one'
		)
	return axis


def divided(points, axis, closed, longest):
	"""Points of the line with those between, so that no segment is longer; (n, 3)."""
	if not np.isfinite(points).all():
		raise ValueError('points: must be finite')
	least = 3 if closed else 2
	if len(points) < least:
		raise ValueError(f'points: {least} at least' + (', where closed is True' if closed else '') + f', got {len(points)}')
	line = (
		np.column_stack([points, np.zeros(len(points))]) if points.shape[1] == 2 else points - np.outer((points - points[0]) @ axis, axis)
	)
	whole = np.vstack([line, line[:1]]) if closed else line
	legs = np.linalg.norm(np.diff(whole, axis=0), axis=1)
	if legs.min() <= outOfPlane * legs.max():
		k = int(legs.argmin())
		remedy = 'the first one need not be given again with closed' if closed and k == len(legs) - 1 else 'leave one out'
		raise ValueError(f'points: point {k} and the next one are the same; {remedy}')
	counts = [1 if longest is None else max(1, math.ceil(leg / longest - outOfPlane)) for leg in legs]
	found = [a + (b - a) * j / count for a, b, count in zip(whole[:-1], whole[1:], counts, strict=True) for j in range(count)]
	return np.array(found if closed else [*found, line[-1]])


def segmentsOf(line, axis, thickness, side, closed):
	"""The Chain along a line of (n, 3) points in a plane normal to the axis."""
	if side not in sides:
		raise ValueError(f"side: must be 'left', 'right' or 'middle', got {side!r}")
	along = np.diff(np.vstack([line, line[:1]]) if closed else line, axis=0)
	along /= np.linalg.norm(along, axis=1)[:, None]
	# directions before and behind each point; at an end both are the same
	before = np.roll(along, 1, axis=0) if closed else np.vstack([along[:1], along])
	behind = along if closed else np.vstack([along, along[-1:]])
	cosines = np.einsum('ij,ij->i', before, behind)
	worst = int(cosines.argmin())
	if cosines[worst] < math.cos(sharpest) - outOfPlane:
		turn = math.degrees(math.acos(max(cosines[worst], -1)))
		raise ValueError(
			f'points: the line turns by {turn:.0f}° at {tuple(line[worst].tolist())}; at most 90°, round the corner with points between'
		)
	outward = np.cross(axis, before + behind) / (1 + cosines)[:, None]
	low, high = (line + share * thickness * outward for share in sides[side])
	following = (np.arange(len(along)) + 1) % len(line)
	inner = np.minimum(*(np.einsum('ij,ij->i', face[following] - face[: len(along)], along) for face in (low, high)))
	if inner.min() <= outOfPlane * thickness:
		place = tuple(line[int(inner.argmin())].tolist())
		raise ValueError(
			f'thickness: {thickness:g} m is too much for the bend of the line at {place}; thinner, longer segments or the other side'
		)
	middle = (low + high) / 2
	lengths = np.linalg.norm(middle[following] - middle[: len(along)], axis=1)
	at = [*range(1, len(along)), *([0] if closed else [])]  # the point of each joint
	return Chain(
		outlines=[np.array([low[k], low[j], high[j], high[k]]) for k, j in enumerate(following)],
		lengths=np.array([(lengths[k - 1] + lengths[k]) / 2 for k in at]),
		cosines=np.sqrt((1 + cosines[at]) / 2),
		distances=np.cumsum(lengths)[: len(at)],
	)
