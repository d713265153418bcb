# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks that friction or clamping holds: lintel, corbel, keys of several faces, an arch and a wall with a load across, a ladder; default settings, joints per area, in space as in the plane."""

import pathlib
import sys
from math import atan, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from yade import O, Quaternion, RockJointMat, Vector3, polytope

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'))
from jointStudy.theory.toppling import elasticToppling

gravity, density, stiffness = 9.81, 2600, 1e9
plane = pytest.mark.parametrize('dimension', [2, 3])


def joint(friction, normalStiffness=stiffness, shearStiffness=stiffness):
	O.reset()
	O.materials.append(
		RockJointMat(density=density, normalStiffness=normalStiffness, shearStiffness=shearStiffness, frictionAngle=atan(friction))
	)


def block(dimension, x, z, depth, fixed=False):
	"""A block from x[0] to x[1], z[0] to z[1], symmetric about the plane y = 0; a polygon with y upwards where dimension is 2. Returns its id."""
	if dimension == 2:
		return O.bodies.append(
			polytope.polygon([(a, b) for a, b in ((x[0], z[0]), (x[1], z[0]), (x[1], z[1]), (x[0], z[1]))], depth, fixed=fixed)
		)
	center = ((x[0] + x[1]) / 2, 0, (z[0] + z[1]) / 2)
	return O.bodies.append(polytope.cuboid(center, ((x[1] - x[0]) / 2, depth / 2, (z[1] - z[0]) / 2), fixed=fixed))


def held(ids, load, ramp=0.3, hold=0.5, before=0.1, fallen=2e-3, **engines):
	"""Whether none of these bodies moves by *fallen* [m] once their weights have grown to *load* times their masses [m/s²], smoothly. Other
	bodies have no weight."""
	O.engines = polytope.engines(gravity=(0, 0, 0), **engines)
	while O.time < before:
		O.step()
	states = [O.bodies[k].state for k in ids]
	places = [Vector3(state.pos) for state in states]
	while O.time < before + ramp + hold:
		part = min(1, (O.time - before) / ramp)
		for k, state in zip(ids, states, strict=True):
			O.forces.setPermF(k, Vector3(load) * (state.mass * part * (2 - part)))
		for _ in range(10):
			O.step()
		if max((state.pos - place).norm() for state, place in zip(states, places, strict=True)) > fallen:
			return False
	return True


def up(dimension):
	return Vector3(0, 1, 0) if dimension == 2 else Vector3(0, 0, 1)


def lintel(dimension, thrust, load, friction=0.5):
	"""A block between a fixed abutment and one that a force presses on it."""
	joint(friction)
	hung = block(dimension, (-0.5, 0.5), (-0.3, 0.3), 0.4)
	block(dimension, (-1.5, -0.5), (-0.5, 0.5), 0.6, fixed=True)
	pressed = block(dimension, (0.5, 1.5), (-0.5, 0.5), 0.6)
	O.bodies[pressed].state.blockedDOFs = 'yzXYZ'
	O.forces.setPermF(pressed, (-thrust, 0, 0))
	return held([hung], load)


@pytest.mark.parametrize('dimension, across', [(2, 0), (3, 0), (3, 0.5)])
def testALintelIsHeldByTwiceFrictionTimesThrust(dimension, across):
	"""*across*: part of gravity that acts out of the plane."""
	weight = density * 1 * 0.6 * 0.4 * gravity
	load = -gravity * up(dimension) + Vector3(0, gravity * across, 0)
	least = weight * hypot(1, across) / (2 * 0.5)
	assert lintel(dimension, 1.01 * least, load)
	assert not lintel(dimension, 0.99 * least, load)


corbelLength, corbelHeight, clamped = 1.0, 0.3, 0.4


def clampOfCorbel(K):
	"""Least force that clamps a corbel on elastic joints: rigid, P a = W (L/2 - a) about the wall's edge. Turned by θ it bears on a wedge
	of pressure at that edge, and one at its rear end, which are w = √(2 N/(K θ)) long with their resultants w/3 from their edges; the arms
	change with θ, too."""
	weight = density * corbelLength * corbelHeight * gravity  # for each metre of depth

	def moment(turn, force):
		lower, upper = (sqrt(2 * normal / (K * turn)) for normal in (force + weight, force))
		return (
			force * (clamped - corbelHeight * turn - upper / 3)
			- (force + weight) * lower / 3
			- weight * (corbelLength / 2 - clamped + corbelHeight / 2 * turn)
		)

	def most(force):
		low = 2 * (force + weight) / (K * clamped**2)
		return -minimize_scalar(lambda log: -moment(np.exp(log), force), bounds=(np.log(low), np.log(0.3)), method='bounded').fun

	low, high = 0.1 * weight, 3 * weight
	for _ in range(50):
		low, high = ((low + high) / 2, high) if most((low + high) / 2) < 0 else (low, (low + high) / 2)
	return low


def corbel(dimension, clamp, K, depth=0.4):
	"""A block that lies in a wall to *clamped* of its length; what lies on it there is pressed down by a force, and does not turn."""
	joint(0.8, K, K)
	stone = block(dimension, (-clamped, corbelLength - clamped), (0, corbelHeight), depth)
	block(dimension, (-1, 0), (-0.5, 0), depth + 0.2, fixed=True)
	above = block(dimension, (-0.8, 0), (corbelHeight, corbelHeight + 0.1), depth + 0.2)
	O.bodies[above].state.blockedDOFs = 'yXYZ' if dimension == 3 else 'zXYZ'
	O.forces.setPermF(above, -clamp * depth * up(dimension))
	return held([stone], -gravity * up(dimension), ramp=2, hold=1, fallen=3e-3)


@plane
def testACorbelIsClampedByItsMoment(dimension):
	K = 1e10
	least = clampOfCorbel(K)
	assert 1.05 < least / (density * corbelLength * corbelHeight * gravity * (corbelLength / 2 - clamped) / clamped) < 1.1
	assert corbel(dimension, 1.01 * least, K)
	assert not corbel(dimension, 0.99 * least, K)


keySlope, pad, closure, keyStiffness, keyFriction = radians(15), 0.4, 1e-4, 1e10, 0.8
"""Angle of a key's faces from the vertical; width of the fixed blocks that press on them, and how far into them [m]; normal and shear
stiffness [Pa/m]."""


def key(faces, pressed, load, across):
	"""A frustum of so many faces that widens downwards, some of them pressed by a fixed block at the height of the centroid. Loads are
	forces [N]; *across* is along y."""
	joint(keyFriction, keyStiffness, keyStiffness)
	high, apothem = 1.0, 0.8
	rings = [((apothem - z * tan(keySlope)) / cos(pi / faces), z) for z in (-high / 2, high / 2)]
	angles = [2 * pi * (n + 0.5) / faces for n in range(faces)]
	stone = O.bodies.append(polytope.fromVertices([(r * cos(q), r * sin(q), z) for r, z in rings for q in angles]))
	state = O.bodies[stone].state
	for n in pressed:
		about = Quaternion((0, 0, 1), 2 * pi * n / faces)
		turn = about * Quaternion((0, 1, 0), -keySlope)
		middle = about * Vector3(apothem - state.pos[2] * tan(keySlope), 0, state.pos[2])
		O.bodies.append(polytope.cuboid(middle + turn * Vector3(0.5 - closure, 0, 0), (0.5, pad / 2, pad / 2), turn, fixed=True))
	return held([stone], Vector3(0, across * load, -load) / state.mass)


def limitOfKey(faces, across):
	"""It moves by u down and v across. Of each face the closure falls by u sin α, and it is sheared by u cos α and v."""
	k, area = keyStiffness, pad**2

	def excess(load):
		u = load / (faces * area * k) + closure * sin(keySlope)
		v = across * load / (faces * area * k)
		return hypot(u * cos(keySlope), v) - keyFriction * (closure - u * sin(keySlope))

	return brentq(excess, 0, faces * area * k * closure)


@pytest.mark.parametrize(
	'faces, pressed, across', [(4, (0, 2), 0), (4, (0, 2), 0.7), (3, (0, 1, 2), 0), (4, (0, 1, 2, 3), 0), (6, range(6), 0)]
)
def testAKeyOfSeveralFacesFallsWhereItsSpringsSlip(faces, pressed, across):
	"""Keys with two faces, three, four and six; *across*: a load along two faces, over that down."""
	least = limitOfKey(len(pressed), across)
	assert key(faces, pressed, 0.99 * least, across)
	assert not key(faces, pressed, 1.01 * least, across)


def arch(breadth, friction, thickness=0.2, number=8):
	"""Voussoirs of a semicircle of radius 1 m about the y axis, on two fixed springers that are wider. Returns their ids."""
	joint(friction, 1e10, 1e10)
	inner, outer = 1 - thickness / 2, 1 + thickness / 2
	for side in (-1, 1):
		ring = [(side * r, y, z) for r in (inner - 0.1, outer + 0.1) for z in (0, -0.2) for y in (-breadth, breadth)]
		O.bodies.append(polytope.fromVertices(ring, fixed=True))
	cuts = [pi * k / number for k in range(number + 1)]
	return O.bodies.append(
		[
			polytope.fromVertices([(r * cos(q), y, r * sin(q)) for q in pair for r in (inner, outer) for y in (-breadth / 2, breadth / 2)])
			for pair in zip(cuts, cuts[1:], strict=False)
		]
	)


def leaning(tangent):
	return gravity * Vector3(0, tangent, -1)


def testAnArchIsOverturnedSidewaysAboutItsSpringings():
	"""As one body, about the outer edges of both springings, on the wedge of pressure of an elastic joint: 9 % below the rigid one's
	breadth over twice the height of its centroid."""
	breadth, thickness = 0.2, 0.2
	states = [O.bodies[k].state for k in arch(breadth, 1)]
	mass = sum(state.mass for state in states)
	height = sum(state.mass * state.pos[2] for state in states) / mass
	least = elasticToppling(breadth, 2 * height, mass * gravity / (2 * thickness), 1e10)
	assert held(arch(breadth, 1), leaning(0.98 * least), ramp=1, hold=0.7, before=0, fallen=5e-3)
	assert not held(arch(breadth, 1), leaning(1.02 * least), ramp=1, hold=0.7, before=0, fallen=5e-3)


def testABroadArchWithALoadAcrossNeedsTheFrictionOfLimitAnalysis():
	"""That is a lower bound of the friction that is needed: its joints open as they slip (docs/limit-analysis.md)."""
	arch(0.6, 1)
	O.engines = polytope.engines(gravity=(0, 0, 0))
	for body in O.bodies:
		O.forces.setPermF(body.id, leaning(0.3) * body.state.mass)
	least = 1 / polytope.limitAnalysis(tolerance=1e-3).stable
	assert 0.4 < least < 0.5
	assert held(arch(0.6, 1.1 * least), leaning(0.3), ramp=0.7, hold=0.3, before=0)
	assert not held(arch(0.6, 0.97 * least), leaning(0.3), ramp=0.7, hold=0.3, before=0)


def wall(thickness, friction, courses=4, length=1.2, brick=0.4, high=0.2, K=stiffness):
	"""Bricks in running bond on a fixed base. Returns their ids."""
	joint(friction, K, K)
	block(3, (-2, 2), (-0.2, 0), 2, fixed=True)
	ids = []
	for course in range(courses):
		between = np.arange(brick / 2 if course % 2 else brick, length - 1e-9, brick)
		cuts = [x - length / 2 for x in (0, *between, length)]
		ids += [block(3, pair, (course * high, (course + 1) * high), thickness) for pair in zip(cuts, cuts[1:], strict=False)]
	return ids


def testABrickWallIsOverturnedAcross():
	"""Its pressure at the base is that of one block on an elastic joint; rigid it would stand to a tangent of thickness over height, 14 % more."""
	least = elasticToppling(0.2, 0.8, density * 0.2 * 0.8 * gravity, stiffness)
	assert held(wall(0.2, 0.8), leaning(0.98 * least), ramp=1, hold=0.5, before=0, fallen=0.01)
	assert not held(wall(0.2, 0.8), leaning(1.02 * least), ramp=1, hold=0.5, before=0, fallen=0.01)


@pytest.mark.parametrize('thickness, way', [(0.4, (0, 1, 0)), (0.2, (1, 0, 0))])
def testABrickWallSlidesAtItsFriction(thickness, way):
	"""Across the wall, and along it."""
	for part in (0.99, 1.02):
		load = gravity * (0.3 * part * Vector3(way) - Vector3(0, 0, 1))
		assert held(wall(thickness, 0.3), load, ramp=0.5, hold=0.3, before=0, fallen=1e-3) == (part < 1)


def ladder(dimension, angle, friction, turned, K, length=2.0, side=0.2):
	"""A bar of square section that leans on a floor and a wall, each with an edge; *turned* about its axis, with a vertex."""
	joint(friction, K, K)
	halfHeight = side / 2 * (sqrt(2) if turned else 1)
	along, across = length / 2 * Vector3(cos(angle), 0, sin(angle)), halfHeight * Vector3(sin(angle), 0, -cos(angle))
	bar = block(dimension, (-length / 2, length / 2), (-side / 2, side / 2), side)
	state = O.bodies[bar].state
	if dimension == 2:
		state.ori = Quaternion((0, 0, 1), angle) * state.ori
	else:
		state.ori = Quaternion((0, 1, 0), -angle) * Quaternion((1, 0, 0), pi / 4 if turned else 0) * state.ori
	foot, head = across - along, across + along
	block(dimension, (foot[0] - 1, foot[0] + 2), (foot[2] - 0.5, foot[2]), 1, fixed=True)
	block(dimension, (head[0], head[0] + 0.5), (head[2] - 1, head[2] + 1), 1, fixed=True)
	return held([bar], -gravity * up(dimension), ramp=1, hold=1, fallen=0.02)


@pytest.mark.parametrize('dimension, turned, K, margin', [(2, False, 1e10, 0.3), (3, False, 1e10, 0.3), (3, True, 1e11, 0.6)])
def testALadderStandsWhereFrictionAtBothEndsHoldsIt(dimension, turned, K, margin, friction=0.4):
	"""Rigid: tan θ = (1 - μ²)/(2 μ + (1 + μ²) h/L), with the height h and the length L of its section. Both ends slip by some depths before
	they hold what they can: with vertices, which are softer than edges, it stands from 0.3 to 0.6 degrees above (0.1 to 0.3 with ten times
	the stiffness)."""
	height = 0.2 * (sqrt(2) if turned else 1)
	least = atan((1 - friction**2) / (2 * friction + (1 + friction**2) * height / 2))
	assert ladder(dimension, least + radians(margin), friction, turned, K)
	assert not ladder(dimension, least - radians(margin), friction, turned, K)


def topplingAlong(courses, length, K, brick=0.4, high=0.2):
	"""Tangent at which a part of a wall turns about the lower corner of an end brick: that brick, and all that lies on what turns, so half
	a brick more with each course. The least over all courses; turned on the elastic joint below it as a block with the same arms and weight
	for each metre of breadth."""

	def arms(course):
		first = brick / 2 if course % 2 else brick
		lengths = np.minimum(first + brick / 2 * np.arange(courses - course), length)
		total = lengths.sum()
		return (lengths**2).sum() / 2 / total, (lengths * high * (np.arange(lengths.size) + 0.5)).sum() / total, total * high

	behind, above, area = min(map(arms, range(courses)), key=lambda each: each[0] / each[1])
	return behind / above, elasticToppling(2 * behind, 2 * above, density * gravity * area, K)


@pytest.mark.parametrize('length, rigid', [(0.4, 0.3333), (0.8, 0.5349), (1.2, 0.5789)])
def testABrickWallIsToppledAlong(length, rigid):
	"""A pier of a brick and two halves in turn topples as one body; a longer wall parts along its bond, from the half brick at the end of
	the second course up (as one body it would stand to a tangent of 0.67, and 1). Friction does not let it slide."""
	K = 1e10
	least, elastic = topplingAlong(6, length, K)
	assert least == pytest.approx(rigid, abs=1e-4)
	assert 0.94 < elastic / least < 0.97
	for part in (0.98, 1.02):
		load = gravity * Vector3(part * elastic, 0, -1)
		assert held(wall(0.2, 0.8, courses=6, length=length, K=K), load, ramp=1, hold=0.7, before=0, fallen=0.02) == (part < 1)
