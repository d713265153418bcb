# SPDX-License-Identifier: GPL-2.0-or-later
"""What a change of the time step within a contact does to the energy, and that PolytopeTimeStepper's changes cost no more than a constant step does.

YADE's leapfrog has velocities half a step before positions: v(n−½). After steps of h the next one, of h', should add a (h + h')/2 to them, and adds a h'.
"""

import math

import pytest
from scenes import blockOnFloor, density, joint, loop
from test_contact_surface import gasOf
from yade import O, Vector3, polytope

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
