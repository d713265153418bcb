# SPDX-License-Identifier: GPL-2.0-or-later
"""A joint's bed of shear springs whose rims lift in turn, in two directions: it loses energy, as springs do that leave and come back unstrained."""

from math import atan, cos, radians, sin, tan

import numpy as np
import pytest
from scenes import joint
from yade import Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, NewtonIntegrator, O, Vector3, polytope

normalStiffness, shearStiffness, pressedIn, tilt, shift = 1e9, 7e8, 1e-4, 2e-4, 3e-5
half = (0.5, 0.4, 0.3)
legs = {
	'X': (shift, 0, 0, 0),
	'Y': (0, shift, 0, 0),
	'R': (0, 0, tilt, 0),
	'T': (0, 0, 0, tilt),
}
"""Ways along x and y, and tilts about them; a small letter undoes what the capital one has done."""


def leg(letter):
	return np.array(legs[letter.upper()]) * (1 if letter.isupper() else -1)


def bedOfSprings(loop, mu, cycles, steps, number=30):
	"""Loss per cycle [J] and shear force at the end [N] of point springs below the face, each with Coulomb's limit; one that is not pressed is
	unstrained."""
	along = (np.arange(number) + 0.5) / number * 2 - 1
	x, y = (axis.ravel() for axis in np.meshgrid(half[0] * along, half[1] * along))
	area = 4 * half[0] * half[1] / number**2
	pose, stress, losses = np.zeros(4), np.zeros((number**2, 2)), []
	for _ in range(cycles):
		lost = 0.0
		for letter in loop:
			step = leg(letter) / steps
			for _ in range(steps):
				pose += step
				pressure = normalStiffness * np.maximum(pressedIn - (y * pose[2] - x * pose[3]), 0)
				trial = stress + shearStiffness * np.array([step[0] - half[2] * step[3], step[1] + half[2] * step[2]])
				stress = trial * np.minimum(1, mu * pressure / (np.linalg.norm(trial, axis=1) + 1e-30))[:, None]
				lost += ((trial**2).sum() - (stress**2).sum()) / (2 * shearStiffness) * area
		losses.append(lost)
	return losses, np.linalg.norm(stress.sum(0) * area)


def block(loop, mu, cycles, steps):
	"""The same of a block whose motion is prescribed."""
	O.reset()
	joint(normalStiffness=normalStiffness, shearStiffness=shearStiffness, frictionAngle=atan(mu))
	floor = O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	moved = O.bodies.append(polytope.cuboid((0, 0, half[2]), half))
	O.engines = polytope.engines(
		gravity=(0, 0, 0), damping=0, timeStepper=False, law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0)
	)
	O.dt, O.trackEnergy = 1e-4, True
	state = O.bodies[moved].state
	state.blockedDOFs = 'xyzXYZ'

	def go(way, turn):
		state.vel, state.angVel = Vector3(*way) / (steps * O.dt), Vector3(*turn) / (steps * O.dt)
		O.run(steps, True)

	go((0, 0, -pressedIn), (0, 0, 0))
	losses = []
	for _ in range(cycles):
		before = O.energy['plastDissip']
		for letter in loop:
			x, y, aboutX, aboutY = leg(letter)
			go((x, y, 0), (aboutX, aboutY, 0))
		losses.append(O.energy['plastDissip'] - before)
	return losses, O.interactions[floor, moved].phys.shearForce.norm()


@pytest.mark.parametrize('loop', ['TXRtxr', 'XTYRxtyr', 'XTRxtr', 'TRXtYrxy', 'XTxt'])
def testClosedLoopsLoseWhatSpringsLose(loop):
	"""Shear and tilts about both axes, undone in the same order, with friction that holds all but the last rim. The layers of a bed stand for its springs:
	half to one and a half times their loss, and a shear force that is as large to a third. With rims that were known by their time alone the force
	grew by a sixth in each cycle, for ever."""
	mu = tan(radians(80))
	expected, force = bedOfSprings(loop, mu, 6, 40)
	seen, seenForce = block(loop, mu, 20, 100)
	print(loop, [f'{one:.4f}' for one in (*expected[:2], expected[-1])], [f'{one:.4f}' for one in (*seen[:2], seen[-1])], force, seenForce)
	assert all(loss > -1e-6 for loss in seen)
	assert seen[-1] == pytest.approx(seen[5], rel=1e-3, abs=1e-5)
	assert seen[-1] == pytest.approx(expected[-1], rel=0.5, abs=1e-4)
	assert seenForce == pytest.approx(force, rel=1 / 3, abs=0.03 * normalStiffness * pressedIn * 4 * half[0] * half[1])


@pytest.mark.parametrize('loop', ['TXRtxr', 'XTYRxtyr', 'TRXtYrxy'])
def testLoopsInWhichRimsSlipTakeEnergy(loop):
	"""With the friction of rock: where each rim slips by itself springs lose more, up to a dozen times, than the bed, which slips as a whole."""
	seen, _ = block(loop, tan(radians(35)), 20, 100)
	assert all(loss > 0 for loss in seen)
	assert seen[-1] < bedOfSprings(loop, tan(radians(35)), 3, 40)[0][-1]


@pytest.mark.parametrize('loop', ['TXRt', 'XTYR'])
def testWhatIsCutHasNoMoreShearEnergy(loop):
	"""A block is cut in the middle of such a loop: force and moment stay but for the rims at the cut, what the springs store does not rise."""
	block(loop, tan(radians(80)), 1, 100)
	whole = O.interactions[0, 1].phys
	energy, force, at, moment = whole.shearEnergy, Vector3(whole.shearForce), Vector3(whole.shearPoint), whole.twistingMoment
	polytope.split(1, normal=(1, 0.3, 0))
	parts = [contact.phys for contact in O.interactions if contact.isReal]
	assert len(parts) == 2
	print(energy, [part.shearEnergy for part in parts], force, moment)
	assert 0.5 * energy < sum(part.shearEnergy for part in parts) < energy
	assert (sum((part.shearForce for part in parts), Vector3.Zero) - force).norm() < 0.03 * force.norm()
	turning = sum(part.twistingMoment + (part.shearPoint - at).cross(part.shearForce)[2] for part in parts)
	assert turning == pytest.approx(moment, abs=0.03 * force.norm() * half[0])


@pytest.mark.parametrize('mu', [0.7, 5])
def testAWedgeInAGrooveGainsNothing(mu):
	"""A free body in a V groove whose sides differ, pushed and turned, without dampers: its rims lift in turn on both sides. It had 260 times the
	energy that it was given after a second at a friction of 5, and friction had given back all that it had taken at 0.7."""
	joint(normalStiffness=1e9, shearStiffness=7e8, frictionAngle=atan(mu))
	sides = Vector3(0, sin(0.8), cos(0.8)), Vector3(0, -sin(0.5), cos(0.5))
	for side, left, right in zip(sides, (0, 2), (2, 0), strict=True):
		O.bodies.append(
			polytope.fromHalfSpaces(
				[side, (0, 0, -1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)], [0, 1, 2, 2, left, right], fixed=True
			)
		)
	wedge = O.bodies[
		O.bodies.append(polytope.fromHalfSpaces([-sides[0], -sides[1], (0, 0, 1), (0, 0, -1), (1, 0, 0), (-1, 0, 0)], [0, 0, 0.6, -0.1, 0.4, 0.4]))
	]
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3)
	O.engines = polytope.engines(law=law)
	polytope.settle(unbalanced=1e-6, elastic=True)
	law.normalDamping = 0
	next(engine for engine in O.engines if isinstance(engine, NewtonIntegrator)).damping = 0
	rest = polytope.mechanicalEnergy()
	wedge.state.vel, wedge.state.angVel = (0.003, 0.002, -0.003), (0.02, 0.01, 0.03)
	O.trackEnergy = True
	O.step()
	given, lost, end = polytope.mechanicalEnergy() - rest, [], O.time + 0.5
	while O.time < end:
		O.run(100, True)
		lost.append((rest - polytope.mechanicalEnergy()) / given + 1)
	print(mu, given, lost[:: len(lost) // 5])
	assert all(later - sooner > -0.02 for sooner, later in zip(lost, lost[1:], strict=False))
	assert 0.5 < lost[-1] < 1.2
