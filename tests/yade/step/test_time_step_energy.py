# SPDX-License-Identifier: GPL-2.0-or-later
"""What a change of the time step within a contact does to the energy, and that PolytopeTimeStepper's changes cost no more than a constant step does.

YADE's leapfrog has velocities half a step before positions: v(n−½). After steps of h the next one, of h', should add a (h + h')/2 to them, and adds a h'.
"""

import itertools
import math

import numpy as np
import pytest
from scenes import blockOnFloor, density, joint, loop
from test_contact_surface import gasOf
from yade import Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, O, Vector3, polytope
from yade.utils import wall

stiffness = 1e9


def correct(body, change):
	"""Adds what the velocities of a body lack after a time step that was shorter or longer than the one before it by `change` [s]."""
	state = body.state
	state.vel = state.vel - O.forces.f(body.id) / state.mass * change / 2
	torque = state.ori.conjugate() * O.forces.t(body.id)
	state.angVel = state.angVel - state.ori * Vector3(*(torque[k] / state.inertia[k] for k in range(3))) * change / 2


def bounce(part, corrected=False):
	"""A cube that falls flat on a floor, without damping; half-way in, the step becomes half of what it was, a part of 1/ω. Returns the
	energy that it gains, and what the change of the step says, over what it had."""
	O.reset()
	joint(normalStiffness=stiffness, frictionAngle=0)
	loop(perArea=True)
	_, block = blockOnFloor(-1e-6)
	block.state.blockedDOFs = 'xyXYZ'
	frequency, speed = math.sqrt(stiffness / density), 0.1
	block.state.vel = (0, 0, -speed)
	O.dt = part / frequency
	while block.state.vel[2] < -speed * math.sqrt(0.5):
		O.step()
	change = -O.dt / 2
	velocity, acceleration = block.state.vel[2], O.forces.f(block.id)[2] / block.state.mass
	O.dt = O.dt + change
	if corrected:
		correct(block, change)
	while block.state.vel[2] < 0 or O.forces.f(block.id)[2] > 0:
		O.step()
	return float((block.state.vel[2] / speed) ** 2 - 1), float(velocity * acceleration * change / speed**2)


@pytest.mark.parametrize('part', [0.1, 0.05, 0.025])
def testAChangeOfTheStepInAContactIsAnErrorOfFirstOrder(part):
	"""The error is m v a (h' − h)/2: a quarter of the step over the time 1/ω."""
	gained, said = bounce(part)
	assert said == pytest.approx(part / 4, rel=part)
	assert gained == pytest.approx(said, rel=part)


def testWithVelocitiesCorrectedItIsOneOfSecondOrder():
	errors = [abs(bounce(part, corrected=True)[0]) for part in (0.1, 0.05, 0.025)]
	assert errors[0] < 0.1**2 and errors[2] < errors[0] / 10


def errorOfGases(model, corrected=False, step=None):
	"""Root of the mean square of the energy's error in five gases of 64 solids over 4 s; and the time step at the end."""
	squares = []
	for seed in range(1, 6):
		O.reset()
		gasOf(model, 4, seed)
		if step:
			O.engines = O.engines[:-1]
			O.dt = step
		start, last = polytope.mechanicalEnergy(), 0
		while O.time < 4:
			O.step()
			if corrected and last and O.dt != last:
				for body in O.bodies:
					if body.dynamic:
						correct(body, O.dt - last)
			last = O.dt
			if O.iter % 300 == 0:
				squares.append((polytope.mechanicalEnergy() / start - 1) ** 2)
	return math.sqrt(sum(squares) / len(squares)), O.dt


def testTheStepOfAGasWithAFoundationDoesNotChange():
	gasOf('foundation', 4, 1)
	O.step()
	step, collided = O.dt, False
	while O.time < 1:
		O.step()
		collided = collided or any(contact.isReal for contact in O.interactions)
		assert O.dt == step
	assert collided


@pytest.mark.parametrize('model', ['spring', 'yadesOwn'])
def testChangesOfTheStepCostAGasNoMoreThanAConstantStepDoes(model):
	"""Errors of five other gases differ by up to a factor of 1.5: motion is chaotic."""
	changing, usual = errorOfGases(model)
	corrected, _ = errorOfGases(model, corrected=True)
	constant, _ = errorOfGases(model, step=usual)
	print(f'{model}: error {changing:.1e}; with velocities corrected at changes {corrected:.1e}; with a constant step {constant:.1e}')
	assert changing < 2 * constant
	assert corrected > 0.3 * constant


def regularCorners(sides, turn, radius):
	return [(radius * np.cos(angle), radius * np.sin(angle)) for angle in turn + 2 * np.pi * np.arange(sides) / sides]


def errorOfPolygonGas(model, safety):
	"""Largest error of the energy of nine polygons between walls, in 2 s, and of three such gases."""
	worst = 0
	for seed in range(1, 4):
		O.reset()
		random = np.random.default_rng(seed)
		perArea = model == 'foundation'
		joint(normalStiffness=2e8 if perArea else 3e7, frictionAngle=0, stiffnessPerArea=perArea)
		O.bodies.append([wall(position, axis=axis) for axis in (0, 1) for position in (0, 1.2)])
		for row, column in itertools.product(range(3), range(3)):
			sides, turn = random.integers(3, 8), random.uniform(0, 6)
			body = polytope.polygon(regularCorners(sides, turn, 0.17), thickness=0.2, center=(0.2 + 0.4 * column, 0.2 + 0.4 * row, 0))
			body.state.vel = (*random.normal(0, 0.5, 2), 0)
			O.bodies.append(body)
		O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0))
		O.engines[-1].timestepSafetyCoefficient = safety
		start = polytope.mechanicalEnergy()
		while O.time < 2:
			O.run(200, wait=True)
			worst = max(worst, abs(polytope.mechanicalEnergy() / start - 1))
	return worst


@pytest.mark.parametrize(('model', 'most'), [('foundation', 2e-3), ('spring', 5e-3)])
def testTheErrorOfAGasOfPolygonsIsOneOfSecondOrder(model, most):
	"""They meet with the stiffness and the lever arms that the step is made for; for most solids it is on the safe side."""
	errors = [errorOfPolygonGas(model, safety) for safety in (0.4, 0.2)]
	print(f'{model}: largest error {errors[0]:.1e}; with half the step {errors[1]:.1e}')
	assert errors[0] < most and errors[1] < errors[0] / 2


def polygonsInABox(seed):
	"""30 regular polygons fall into a box, without friction and damping. Returns their weight [N]."""
	O.reset()
	random = np.random.default_rng(seed)
	joint(normalStiffness=1e6, shearStiffness=5e5, frictionAngle=0, stiffnessPerArea=False)
	for centre, half in (((0, -0.05), (0.6, 0.05)), ((-0.65, 1.5), (0.05, 1.5)), ((0.65, 1.5), (0.05, 1.5))):
		(x, y), (a, b) = centre, half
		corners = [(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)]
		O.bodies.append(polytope.polygon(corners, fixed=True, thickness=0.2))
	for row, column in itertools.product(range(6), range(5)):
		sides, turn = 3 + (row + column) % 4, random.uniform(0, 6)
		corners = [(0.22 * column - 0.45 + x, 0.22 * row + 0.15 + y) for x, y in regularCorners(sides, turn, 0.1)]
		O.bodies.append(polytope.polygon(corners, thickness=0.2))
	undamped = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0, shearDamping=0, rockingDamping=0)
	O.engines = polytope.engines(damping=0, law=undamped)
	return sum(body.state.mass for body in O.bodies if body.dynamic) * 9.81


def errorOfFall(seed, corrected=False, step=None):
	"""Largest error of the energy in 0.6 s over what the fall has set free; and the least time step."""
	weight = polygonsInABox(seed)
	if step:
		O.engines = O.engines[:-1]
		O.dt = step
	moving = [body for body in O.bodies if body.dynamic]
	height = sum(body.state.mass * body.state.pos[1] for body in moving)
	start, last, worst, least = polytope.mechanicalEnergy(), O.dt, 0, O.dt
	while O.time < 0.6:
		O.step()
		if corrected and O.dt != last:
			for body in moving:
				correct(body, O.dt - last)
				body.state.vel = body.state.vel - Vector3(0, -9.81, 0) * (O.dt - last) / 2
		last, least = O.dt, min(least, O.dt)
		if O.iter % 20 == 0:
			worst = max(worst, abs(polytope.mechanicalEnergy() - start))
	fallen = height - sum(body.state.mass * body.state.pos[1] for body in moving)
	assert fallen > 0.1 * weight / 9.81
	return float(worst / (fallen * 9.81)), least


def testChangesOfTheStepWhilePolygonsPileUp():
	"""A pile has more contacts on a body than its first ones, so that the step becomes shorter while they are loaded."""
	seeds = range(1, 6)
	changing = [errorOfFall(seed) for seed in seeds]
	usual = min(step for _, step in changing)
	found = {
		'PolytopeTimeStepper': [error for error, _ in changing],
		'velocities corrected at each change': [errorOfFall(seed, corrected=True)[0] for seed in seeds],
		'constant step, its least': [errorOfFall(seed, step=usual)[0] for seed in seeds],
		'constant step, a quarter of that': [errorOfFall(seed, step=usual / 4)[0] for seed in seeds],
	}
	means = {name: sum(errors) / len(errors) for name, errors in found.items()}
	for name, errors in found.items():
		print(f'{name}: largest error {means[name]:.1e} in the mean, {max(errors):.1e} at most')
	assert max(found['PolytopeTimeStepper']) < 0.03, 'with the default step'
	assert means['constant step, a quarter of that'] < means['constant step, its least'] / 4 < means['PolytopeTimeStepper'] / 4
