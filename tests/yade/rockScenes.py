# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of rock that several tests have in common."""

import math

import numpy as np
from yade import O, RockJointMat, polytope

gravity = 9.81
dip, friction = math.radians(40), math.radians(30)
weight = 1000 * gravity
"""Weight of a block of 1 × 1 × 0.2 m, and its parts across and along a plane of that dip [N]."""
across, along = weight * math.cos(dip), weight * math.sin(dip)
meanArm = (math.sqrt(2) + math.asinh(1)) / 6
"""Mean distance from the middle of a square of edge 1, by which friction under an even pressure bears a twist [-]."""


def blockMaterial(**joint):
	O.materials.append(RockJointMat(**{'density': 5000, 'normalStiffness': 1e9, 'shearStiffness': 1e9, 'frictionAngle': friction, **joint}))


def gravityOnSlope(dip, flat=False):
	"""Gravity in the axes of a plane of this dip."""
	return (gravity * math.sin(dip), -gravity * math.cos(dip), 0) if flat else (gravity * math.sin(dip), 0, -gravity * math.cos(dip))


def blockOnSlope(dip, half, flat=False, **joint):
	"""A block on a plane; by gravity that leans."""
	blockMaterial(**joint)
	if flat:
		O.bodies.append(polytope.polygon([(-3, -1), (3, -1), (3, 0), (-3, 0)], fixed=True))
		x, y = half[0], 2 * half[2]
		block = O.bodies.append(polytope.polygon([(-x, 0), (x, 0), (x, y), (-x, y)]))
	else:
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
		block = O.bodies.append(polytope.cuboid((0, 0, half[2]), half))
	O.engines = polytope.engines(gravity=gravityOnSlope(dip, flat))
	return block


def stressedMass():
	"""A cube of oblique blocks of the last material under stress, those at its faces fixed. Returns the rock."""
	sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	joints = [(50, 80, 1.3), (70, 200, 1.5), (20, 310, 1.6)]
	sets = [polytope.JointSet(math.radians(dip), math.radians(direction), spacing) for dip, direction, spacing in joints]
	mass = polytope.jointedRock(sides, [5, 0, 5, 0, 5, 0], sets)
	for k, made in zip(mass.append(), mass.faces, strict=True):
		O.bodies[k].dynamic = not (made < 0).any()
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(-1e6 * np.array([[4, 1, 0.5], [1, 5, 0.3], [0.5, 0.3, 6]]))
	return mass
