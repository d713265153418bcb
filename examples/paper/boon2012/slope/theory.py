# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit analysis of blocks in the plane (simulation E of Boon et al. 2012): the friction angle without equilibrium, and its mechanism.

Static theorem for rigid blocks with rough joints that take no tension (Livesley 1978, Int. J. Numer. Methods Eng. 12:1853-1871): the
blocks stand if forces can be found at both ends of every joint that balance all weights with N ≥ 0 and |T| ≤ N tan φ. That is a linear
programme; its dual are the velocities of the mechanism by which they fail (with the associated flow rule: sliding blocks also part).
"""

import dataclasses
import math

import numpy as np
from scipy.optimize import linprog

__all__ = ['Joint', 'LimitState', 'centroid', 'criticalFrictionAngle', 'joints', 'largestOutwardLoad']


@dataclasses.dataclass
class Joint:
	"""Where two blocks meet along a line."""

	first: int
	second: int
	ends: np.ndarray
	"""(2, 2) both ends [m]."""
	normal: np.ndarray
	"""Unit, from the first block to the second."""


@dataclasses.dataclass
class LimitState:
	"""What criticalFrictionAngle found."""

	angle: float
	"""Critical friction angle [rad]; 0 if the blocks stand without friction."""
	velocities: np.ndarray
	"""(free blocks, 3): velocity of the centroid (x, y) and angular velocity (counter-clockwise) of the mechanism, such that the fastest
	corner of all blocks has 1 [m/s, rad/s]; zeros if there is none."""


def centroid(corners):
	"""(area, centroid) of a polygon given by its corners counter-clockwise (clockwise: negative area)."""
	x, y = np.asarray(corners, float).T
	cross = x * np.roll(y, -1) - np.roll(x, -1) * y
	area = cross.sum() / 2
	return area, np.array([((x + np.roll(x, -1)) * cross).sum(), ((y + np.roll(y, -1)) * cross).sum()]) / (6 * area)


def joints(free, fixed, tolerance=1e-6, inset=0.0):
	"""Joints of the blocks with each other and with fixed ones.

	:param free: polygons (lists of corners); block k is free[k]
	:param fixed: polygons that do not move; block len(free) + k
	:param float tolerance: distance between two edges that are one joint, and the least length of one [m]
	:param float inset: both ends of each joint are moved in by this, as if the blocks' corners were worn off [m]
	:returns: list of Joint, those between two fixed blocks left out
	"""
	blocks = [_counterClockwise(corners) for corners in [*free, *fixed]]
	found = []
	for first in range(len(free)):
		for second in range(first + 1, len(blocks)):
			for start, end in _edges(blocks[first]):
				along = end - start
				length = np.linalg.norm(along)
				along = along / length
				normal = np.array([along[1], -along[0]])  # outward, as corners go counter-clockwise
				for a, b in _edges(blocks[second]):
					if max(abs((a - start) @ normal), abs((b - start) @ normal)) > tolerance or (b - a) @ along >= 0:
						continue
					low, high = max(0.0, (b - start) @ along) + inset, min(length, (a - start) @ along) - inset
					if high - low > tolerance:
						found.append(Joint(first, second, np.array([start + low * along, start + high * along]), normal))
	return found


def _counterClockwise(corners):
	corners = np.asarray(corners, float)
	return corners if centroid(corners)[0] > 0 else corners[::-1]


def _edges(corners):
	return zip(corners, np.roll(corners, -1, axis=0), strict=True)


def largestOutwardLoad(free, found, friction, outward=(-1, 0), rotations=True):
	"""Largest k for which weights W and forces k W along *outward* on all blocks can be in balance.

	:param free: polygons of the free blocks
	:param found: their joints
	:param float friction: tan φ of all joints
	:param outward: unit direction, away from the slope
	:param bool rotations: False: moments need not be in balance, as if no block could turn
	:returns: (k, velocities of the mechanism at that load as in LimitState, unscaled); (−inf, None) if there is no balance at any k
	"""
	count, points = len(free), 2 * len(found)
	bodies = [centroid(_counterClockwise(corners)) for corners in free]
	balance, load = np.zeros((3 * count, 2 * points + 1)), np.zeros(3 * count)
	for k, (area, _) in enumerate(bodies):
		load[3 * k + 1] = area  # minus the weight, with unit weight 1
		balance[3 * k : 3 * k + 2, -1] = area * np.asarray(outward, float)
	for j, joint in enumerate(found):
		tangent = np.array([-joint.normal[1], joint.normal[0]])
		for end in range(2):
			column = 2 * (2 * j + end)
			for direction, where in ((joint.normal, column), (tangent, column + 1)):
				for block, sign in ((joint.second, 1), (joint.first, -1)):
					if block < count:
						arm = joint.ends[end] - bodies[block][1]
						balance[3 * block : 3 * block + 3, where] = sign * np.array(
							[*direction, arm[0] * direction[1] - arm[1] * direction[0]]
						)
	if not rotations:
		balance, load = (np.delete(array, np.arange(2, 3 * count, 3), axis=0) for array in (balance, load))
	strength = np.zeros((2 * points, 2 * points + 1))
	for p in range(points):
		strength[2 * p, 2 * p : 2 * p + 2] = -friction, 1
		strength[2 * p + 1, 2 * p : 2 * p + 2] = -friction, -1
	bounds = [(0, None), (None, None)] * points + [(None, None)]
	goal = np.zeros(2 * points + 1)
	goal[-1] = -1
	solution = linprog(goal, A_ub=strength, b_ub=np.zeros(2 * points), A_eq=balance, b_eq=load, bounds=bounds, method='highs')
	if solution.status == 2:
		return -math.inf, None
	if solution.status == 3:
		return math.inf, None
	if solution.status:
		raise RuntimeError(f'the linear programme has no answer: {solution.message}')
	velocities = -solution.eqlin.marginals.reshape(count, -1)
	if not rotations:
		velocities = np.column_stack([velocities, np.zeros(count)])
	return solution.x[-1], velocities


def criticalFrictionAngle(free, fixed, rotations=True, inset=0.0, tolerance=1e-9):
	"""Smallest friction angle with which the blocks can stand, and the mechanism at it.

	:param free: polygons of the blocks [m]
	:param fixed: polygons of what they stand on and lean against
	:param bool rotations: False: for mechanisms in which no block turns
	:param float inset: see joints()
	:param float tolerance: of the angle [rad]
	:returns: a LimitState
	:raises ValueError: if they cannot stand with any friction
	"""
	found = joints(free, fixed, inset=inset)
	if largestOutwardLoad(free, found, 0.0, rotations=rotations)[0] >= 0:
		return LimitState(0.0, np.zeros((len(free), 3)))
	low, high = 0.0, math.radians(89)
	if largestOutwardLoad(free, found, math.tan(high), rotations=rotations)[0] < 0:
		raise ValueError('free: these blocks cannot stand with any friction')
	while high - low > tolerance:
		middle = (low + high) / 2
		if largestOutwardLoad(free, found, math.tan(middle), rotations=rotations)[0] >= 0:
			high = middle
		else:
			low = middle
	velocities = largestOutwardLoad(free, found, math.tan(high), rotations=rotations)[1]
	return LimitState(high, velocities / _fastest(free, velocities))


def _fastest(free, velocities):
	speeds = []
	for corners, (u, v, spin) in zip(free, velocities, strict=True):
		arms = np.asarray(corners, float) - centroid(corners)[1]
		speeds.append(np.hypot(u - spin * arms[:, 1], v + spin * arms[:, 0]).max())
	return max(speeds)
