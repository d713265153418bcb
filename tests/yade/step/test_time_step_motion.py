# SPDX-License-Identifier: GPL-2.0-or-later
"""PolytopeTimeStepper's limit *motion* counts how fast bodies that may meet move against each other; scenes that are empty at first."""

import math

import pytest
from scenes import gravity, joint
from yade import Bo1_Polytope_Aabb, InsertionSortCollider, O, PyRunner, polytope, utils


def grains(count=3, half=0.005, velocity=(0, 0, 0), base=0.0):
	"""Numbers of count × count grains side by side."""
	return [
		O.bodies.append(polytope.cuboid((0.02 * i, 0.02 * j, base + 1.01 * half), (half, half, half), velocity=velocity))
		for i in range(count)
		for j in range(count)
	]


def floor(velocity=(0, 0, 0), half=(0.2, 0.2, 0.05)):
	made = O.bodies[O.bodies.append(polytope.cuboid((0, 0, -half[2]), half, fixed=True))]
	made.state.vel = velocity
	return made


def runFor(seconds):
	end = O.time + seconds
	while O.time < end:
		O.run(100, wait=True)


def stepOf(scene, seconds=0.02, **engines):
	O.reset()
	joint(normalStiffness=1e8, shearStiffness=1e8)
	scene()
	O.engines = polytope.engines(**engines)
	runFor(seconds)
	return O.dt, O.engines[-1].limitedBy


def lost(speed=1000, place=(0.5, 0, -0.1)):
	O.bodies.append(polytope.cuboid(place, (0.005, 0.005, 0.005), velocity=(0, 0, -speed)))


@pytest.mark.parametrize('place', [(0.5, 0, -0.1), (0, 0, -1)])
def testAGrainThatHasLeftLimitsNothing(place):
	"""Beside the floor, or below it, on its way down at 1 km/s."""
	alone = stepOf(lambda: [floor(), grains()])
	assert stepOf(lambda: [floor(), grains(), lost(place=place)]) == alone
	assert alone[1] in ('material', 'contacts')


def testAStreamThatHasLeftLimitsNothing():
	"""Fifty grains one above the other, with the speeds of their free fall up to 140 m/s."""

	def stream():
		for k in range(1, 51):
			lost(math.sqrt(2 * gravity * 20 * k), (0.5, 0, -20 * k))

	assert stepOf(lambda: [floor(), grains(), stream()]) == stepOf(lambda: [floor(), grains()])


def testOnTheWayToOthersItDoes():
	"""The motion limits the step until the body has struck: a tenth of its inscribed radius in a step."""
	O.reset()
	joint(normalStiffness=1e8, shearStiffness=1e8)
	floor()
	grains()
	bullet = O.bodies[O.bodies.append(polytope.cuboid((0.1, 0.1, 0.02), (0.005, 0.005, 0.005), velocity=(0, 0, -300)))]
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	O.step()
	assert O.engines[-1].limitedBy == 'motion' and O.engines[-1].limitingBody == bullet.id
	assert O.dt == pytest.approx(0.1 * 0.005 / 300, rel=1e-6)


def testTwoThatFlyAtEachOther():
	"""Against each other they move twice as fast as each alone."""
	O.reset()
	joint(normalStiffness=1e8, shearStiffness=1e8)
	for side in (-1, 1):
		O.bodies.append(polytope.cuboid((side * 0.02, 0, 0), (0.005, 0.005, 0.005), velocity=(-side * 300, 0, 0)))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	O.step()
	assert O.engines[-1].limitedBy == 'motion' and O.dt == pytest.approx(0.1 * 0.005 / 600, rel=1e-6)


def testATrayThatMovesFast():
	"""With what lies on it, at 150 m/s past a wall beside it: the step is that at rest, where its motion would give 3e-6 s, and the grains
	stay where they lie."""

	def tray(speed):
		floor((speed, 0, 0))
		O.bodies.append(utils.wall(-3, axis=2, sense=1))
		return grains(velocity=(speed, 0, 0))

	# YADE's numerical damping would slow down what moves, against the tray, too
	rest = stepOf(lambda: tray(0), 0.05, damping=0)
	moving = stepOf(lambda: tray(150), 0.05, damping=0)
	assert 'motion' not in (moving[1], rest[1])
	assert 0.8 * rest[0] < moving[0] < rest[0] * (1 + 1e-6)
	for body in O.bodies:
		if body.dynamic:
			assert body.state.vel[0] == pytest.approx(150, abs=1e-3) and abs(body.state.pos[2] - 0.005) < 1e-4


def testPolygonsToo():
	def flat(velocity):
		O.bodies.append(polytope.polygon([(-1, -0.1), (1, -0.1), (1, 0), (-1, 0)], fixed=True))
		O.bodies.append([polytope.polygon([(x, 1e-4), (x + 0.05, 1e-4), (x + 0.05, 0.05), (x, 0.05)]) for x in (-0.1, 0, 0.1)])
		if velocity:
			O.bodies.append(polytope.polygon([(3, -1), (3.05, -1), (3.05, -0.95), (3, -0.95)], velocity=(0, -velocity, 0)))

	assert stepOf(lambda: flat(2000)) == stepOf(lambda: flat(0))


# ------------------------------------------------------------------------------------------------ empty at first


def fill():
	"""A layer of grains each time, at most three."""
	layers = sum(body.dynamic for body in O.bodies) // 9
	if layers < 3:
		grains(base=0.05)


@pytest.mark.parametrize('walls', [False, True])
def testASceneThatIsEmptyAtFirstIsFilled(walls):
	"""By an engine with virtPeriod, behind the time stepper: what it puts in falls as it should, from the first step on."""
	import __main__

	__main__.fill = fill
	joint(normalStiffness=1e8, shearStiffness=1e8)
	if walls:
		floor()
	O.engines = polytope.engines(damping=0) + [PyRunner(virtPeriod=0.1, command='fill()')]
	O.step()
	O.step()
	assert O.engines[-2].limitedBy == 'period' and O.dt == pytest.approx(0.001)
	for _ in range(110):
		if any(body.dynamic for body in O.bodies):
			break
		O.step()
	first = next(body for body in O.bodies if body.dynamic)
	assert O.time == pytest.approx(0.1, rel=0.03)
	start = O.time
	height = first.state.pos[2]
	O.step()
	assert O.dt < 1e-3 and O.engines[-2].limitedBy != 'period'
	assert first.state.vel.norm() < gravity * 1e-3
	while O.time < start + 0.05:
		O.run(20, wait=True)
	assert first.state.pos[2] == pytest.approx(height - gravity * (O.time - start) ** 2 / 2, rel=1e-2)
	runFor(0.4)
	assert sum(body.dynamic for body in O.bodies) == 27
	if walls:
		assert all(body.state.pos[2] > 0.0049 for body in O.bodies if body.dynamic)


def testWithAnotherColliderTheStepStaysAsItIs():
	"""Nobody calls the time stepper before new bodies move."""
	joint()
	O.engines = polytope.engines(collider=InsertionSortCollider([Bo1_Polytope_Aabb()])) + [PyRunner(virtPeriod=0.1, command='pass')]
	O.dt = 1e-4
	O.step()
	O.step()
	assert O.dt == 1e-4 and O.engines[-2].limitedBy == ''


def testSmallBodiesAmongLargeOnesGetTheirStepBeforeTheyMove():
	joint(normalStiffness=1e8, shearStiffness=1e8)
	floor(half=(2, 2, 0.5))
	O.bodies.append(polytope.cuboid((1, 1, 0.52), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()
	O.run(60, wait=True)
	large = O.dt
	small = O.bodies[O.bodies.append(polytope.cuboid((-1, -1, 0.0049), (0.005, 0.005, 0.005)))]
	O.step()
	assert O.dt < 0.2 * large
	assert small.state.vel[2] < 1e8 * 4 * 0.005**2 * 1e-4 / small.state.mass * O.dt * 1.001
