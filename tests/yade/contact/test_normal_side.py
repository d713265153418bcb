# SPDX-License-Identifier: GPL-2.0-or-later
"""The default contact's normal points out of the floor that a block lies on, however thin the overlap, however small the tilt."""

import math

import numpy as np
from yade import Quaternion, Vector3, polytope

floor = 0.5
"""Half of the lower cube's edge [m]."""


def blockOnCube(random, depth):
	"""A turned cube, a block whose lowest corner is *depth* deep in one of its faces, tilted against it a little; the face's normal."""
	turn = Quaternion(Vector3(*random.normal(size=3)).normalized(), random.uniform(0, 6))
	up = turn * Vector3(0, 0, 1)
	half = np.array([0.175, 0.06, 0.051]) * random.uniform(0.5, 2, 3)
	axis = turn * Vector3(*random.normal(size=2), 0).normalized()
	tilted = Quaternion(axis, random.choice([0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2])) * turn * Quaternion((0, 0, 1), random.uniform(0, 6))
	reach = max((tilted * Vector3(x * half[0], y * half[1], -half[2])).dot(-up) for x in (-1, 1) for y in (-1, 1))
	centre = turn * Vector3(*random.uniform(-0.45, 0.45, 2), 0) + up * (floor + reach - depth)
	return polytope.cuboid((0, 0, 0), (floor,) * 3, turn), polytope.cuboid(centre, half, tilted), up


def testNormalPointsOutOfTheFloor():
	random = np.random.default_rng(1)
	wrong, contacts = [], 0
	for depth in (1e-13, 1e-11, 1e-10, 1e-7):
		for _ in range(1200):
			lower, upper, up = blockOnCube(random, depth)
			found = polytope.contact(lower, upper)
			contacts += found.inContact
			if found.inContact and (found.normal.dot(up) < math.cos(math.radians(25)) or found.depth > 10 * depth):
				wrong.append((depth, found.depth, tuple(found.normal), tuple(up)))
	assert contacts > 4000
	assert not wrong
