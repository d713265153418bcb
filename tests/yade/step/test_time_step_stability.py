# SPDX-License-Identifier: GPL-2.0-or-later
"""τ against measured limits of stability, and heaps and slopes that come to rest with PolytopeTimeStepper's default."""

import math

import numpy as np
import pytest
from scenes import blockOnFloor, contactOf, density, gravity, joint, loop, stepper, stepUntil
from yade import O, Quaternion, Vector3, _polytope, polytope, utils

models = ('boon2012', 'surface')


# ------------------------------------------------------------------------------------- against measured limits of stability


def pressed(model, perArea, blocked, half, depth=1e-4):
	"""A block pressed onto a floor, at rest; returns it."""
	O.reset()
	joint(normalStiffness=1e8, shearStiffness=6e7, frictionAngle=1.5)
	stiffness = 1e8 * (4 * half[0] * half[1] if perArea else 1)
	weight = depth * stiffness / (density * 8 * half[0] * half[1] * half[2])
	newton = loop(perArea=perArea, gravity=(0, 0, -weight), ig2=contactOf(model, perArea))
	block = blockOnFloor(depth, half)[1]
	block.state.blockedDOFs = 'xyzXYZ'
	O.dt = 1e-9
	O.step()
	newton.gravity = -O.interactions[0, 1].phys.normalForce / block.state.mass
	block.state.blockedDOFs = blocked
	return block.state


def grows(dt, *scene, steps=300, depth=1e-4):
	"""Whether a disturbance grows fiftyfold with this time step; small against the tilt up to which rocking is linear, and against slip."""
	state = pressed(*scene)
	size, small = max(scene[3]), 1e-5 * depth
	O.dt = dt
	place, orientation = state.pos, state.ori
	if 'z' not in state.blockedDOFs:
		state.pos += Vector3(0, 0, small)
	if 'x' not in state.blockedDOFs:
		state.vel = Vector3(1e-2 * small / dt, 0, 0)
	if 'Y' not in state.blockedDOFs:
		state.ori = Quaternion((0 if 'X' in state.blockedDOFs else 1, 1, 0), 1e-2 * small / size) * state.ori
	for _ in range(steps):
		O.step()
		turn = orientation.conjugate() * state.ori
		tilt = 2 * math.sqrt(sum(turn[k] ** 2 for k in range(3)))
		if not float((state.pos - place).norm()) + tilt * size < 50 * small:
			return True
	return False


def critical(start, *scene):
	"""Largest stable step by bisection, to 2 %."""
	low, high = start, 16 * start
	assert not grows(low, *scene)
	while high > 1.02 * low:
		middle = math.sqrt(low * high)
		low, high = (low, middle) if grows(middle, *scene) else (middle, high)
	return low


@pytest.mark.parametrize('half', [(0.5, 0.5, 0.5), (0.5, 0.4, 0.1), (0.1, 0.1, 0.6)])
@pytest.mark.parametrize('motion, blocked', [('normal', 'xyXYZ'), ('shear', 'yzXYZ'), ('rocking', 'xyzXZ'), ('all', '')])
@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('model', models)
def testTwiceTauIsTheLimitOfOneBlock(model, perArea, motion, blocked, half):
	scene = (model, perArea, blocked, half)
	pressed(*scene)
	limit = 2 * _polytope.timeStepLimits()['contacts']
	ratio = limit / critical(limit / 4, *scene)
	print(f'{model}, per area {perArea}, {half}, {motion}: 2 τ over the measured limit {ratio:.3f}')
	assert 0.98 < ratio < 1.02


@pytest.mark.parametrize('half', [(0.5, 0.5, 0.5), (0.3, 0.5, 0.1)])
@pytest.mark.parametrize('perArea, times', [(False, 4), (True, 1)])
def testABlockRocksOnItsContactSurfaceAtTheFrequencyOfItsStiffness(perArea, times, half):
	"""Moment per tilt of a foundation: kₙ L²/12. A spring's is four times that (src/timestep/RockingStiffness.hpp). About the middle of the
	block the shear spring at its base adds to that, and the force on it takes away."""
	depth, tilt = 1e-4, 1e-6
	block = pressed('surface', perArea, 'xyzXZ', half, depth)
	found = O.interactions[0, 1]
	rocking = times * found.phys.kn * (2 * half[0]) ** 2 / 12
	stiffness = rocking + found.phys.ks * half[2] ** 2 - found.phys.normalForce.norm() * half[2]
	period = 2 * math.pi * math.sqrt(block.inertia[1] / stiffness)
	block.ori = Quaternion((0, 1, 0), tilt) * block.ori
	O.dt = period / 400
	crossings, last = [], 0.0
	while len(crossings) < 5:
		O.step()
		speed = float(block.angVel[1])
		if last * speed < 0:
			crossings.append(O.time - O.dt * speed / (speed - last))
		last = speed
	measured = (crossings[-1] - crossings[0]) / 2
	print(f'per area {perArea}, {half}: period over that of the stiffness {measured / period:.5f}')
	assert measured == pytest.approx(period, rel=2e-3)
	# and so it is stable up to the engine's limit, and not beyond
	limit = 2 * _polytope.timeStepLimits()['contacts']
	assert not grows(0.98 * limit, 'surface', perArea, 'xyzXZ', half) and grows(1.02 * limit, 'surface', perArea, 'xyzXZ', half)


# --------------------------------------------------------------------------------------------------------------- heaps and slopes


@pytest.mark.parametrize('faces', [4, 6, 8, 12, 20])
@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('model', models)
def testHeapsOf27Settle(model, perArea, faces):
	joint(normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6)
	loop(
		perArea=perArea,
		normalDamping=0.3,
		shearDamping=0.3,
		rockingDamping=0.3,
		gravity=(0, 0, -gravity),
		damping=0.6,
		ig2=contactOf(model, perArea),
	)
	stepper()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (8, 8, 0.5), fixed=True))
	random = np.random.default_rng(7)
	for k in range(27):
		place = 1.5 * np.array((k % 3 - 1, k // 3 % 3 - 1, k // 9 + 0.6)) + random.uniform(-0.05, 0.05, 3)
		axis = random.normal(size=3)
		O.bodies.append(polytope.regular(faces, 0.7, tuple(place), Quaternion(Vector3(*axis).normalized(), random.uniform(0, 3))))
	stepUntil(2)
	while O.time < 40 and utils.unbalancedForce() > 0.01:  # round bodies roll for long, with a quarter of the step, too
		stepUntil(O.time + 1)
	moving = [body.state for body in O.bodies if body.dynamic]
	ratio = float(utils.unbalancedForce())
	print(f'{model}, per area {perArea}, {faces} faces: unbalanced force {ratio:.1e} after {O.time:.0f} s, {O.iter} steps')
	assert all(0 < state.pos[2] < 4 for state in moving)
	assert ratio < 0.01


def slopeOfJointedRock():
	"""Blocks on bedding of 30° in a small slope; those at the back and below the toe are held."""
	face = math.radians(60)
	west, north, east = 3 * math.pi / 2, 0, math.pi / 2
	rock = polytope.jointedRock(
		[(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (-math.sin(face), 0, math.cos(face))],
		[6, 1, 2, 0, 4, 1, 0],
		[
			polytope.JointSet(math.radians(30), west, spacing=1.5),
			polytope.JointSet(math.radians(80), east, spacing=2),
			polytope.JointSet(math.radians(85), north, spacing=2),
		],
		smallest=0.2,
		seed=3,
	)
	for planes in rock.blocks:
		body = polytope.fromHalfSpaces(*planes)
		corners = np.array([body.state.pos + body.state.ori * v for v in body.shape.vertices], float)
		if corners[:, 2].min() < 1e-6 or corners[:, 0].max() > 6 - 1e-6:
			body.state.blockedDOFs = 'xyzXYZ'
		O.bodies.append(body)


@pytest.mark.parametrize('model', models)
def testSlopeOfJointedRockSettles(model):
	joint(normalStiffness=2e8, shearStiffness=1e8, frictionAngle=math.radians(40))
	loop(perArea=True, normalDamping=0.2, shearDamping=0.2, gravity=(0, 0, -gravity), damping=0.2, ig2=contactOf(model, perArea=True))
	stepper()
	slopeOfJointedRock()
	assert sum(body.state.blockedDOFs == '' for body in O.bodies) >= 5
	stepUntil(1.5)
	print(f'{model}: unbalanced force {float(utils.unbalancedForce()):.1e}')
	assert utils.unbalancedForce() < 1e-4
	assert all((body.state.pos - body.state.refPos).norm() < 0.01 for body in O.bodies)
