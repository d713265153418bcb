# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs of two fixed bodies: those that are apart or flush have no interaction, until one of them is freed, moved or put elsewhere."""

import pytest
from yade import O, RockJointMat, Vector3, polytope, utils
from yade.polytope.scene.present import geometryFunctors

stiffness = 1e8


def _engines():
	O.engines = polytope.engines(gravity=(0, 0, -9.81))


def _two(lift=0, **attributes):
	"""A fixed cube of 1 m on another one, `lift` above it; ids of both."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5))
	lower = O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5), fixed=True))
	upper = O.bodies.append(polytope.cuboid((0, 0, 1 + lift), (0.5, 0.5, 0.5), fixed=True, **attributes))
	_engines()
	return lower, upper


def _queries():
	return sum(functor.stats()['pairs'] for functor in geometryFunctors())


def testPiecesOfTheGroundAreNotAskedForEachOther():
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5))
	O.bodies.append(polytope.terrain([[0.3 * ((i + 2 * j) % 3) for j in range(8)] for i in range(8)], spacing=1, origin=(4e6, 0)))
	_engines()
	O.run(5, True)
	assert len(O.interactions.all()) == 0 and _queries() == 0
	stone = O.bodies.append(polytope.cuboid((4e6 + 3.4, 3.4, 1.4), (0.15, 0.15, 0.15)))
	polytope.run(until=1)
	touched = [one for one in O.interactions if one.isReal]
	assert touched and all(stone in (one.id1, one.id2) for one in O.interactions.all())
	assert O.bodies[stone].state.pos[2] > 0


def testFacetsOfAMeshAreNotAskedEither():
	"""They are not asked while they turn, either, as a drum does."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5))
	corners = [[Vector3(i, j, 0.2 * (i + j) % 0.5) for j in range(6)] for i in range(6)]
	mesh = [
		utils.facet(three)
		for i in range(5)
		for j in range(5)
		for three in (
			(corners[i][j], corners[i + 1][j], corners[i + 1][j + 1]),
			(corners[i][j], corners[i + 1][j + 1], corners[i][j + 1]),
		)
	]
	O.bodies.append(mesh)
	O.bodies.append([utils.wall(-1, axis=2), utils.box((0, 0, -0.5), (9, 9, 0.1), fixed=True)])
	stone = O.bodies.append(polytope.cuboid((2.4, 2.6, 1), (0.2, 0.2, 0.2)))
	_engines()
	O.run(5, True)
	assert all(stone in (one.id1, one.id2) for one in O.interactions.all())
	for body in mesh:
		body.state.vel = (0.1, 0, 0)
	polytope.run(until=1)
	assert all(stone in (one.id1, one.id2) for one in O.interactions.all()) and O.interactions.countReal() > 0
	mesh[0].dynamic = True
	O.step()
	assert any(stone not in (one.id1, one.id2) for one in O.interactions.all())


def testPiercingBodiesKeepTheirContact():
	lower, upper = _two(lift=-1e-3)
	O.run(3, True)
	assert O.forces.f(upper)[2] == pytest.approx(stiffness * 1e-3, rel=1e-2)


@pytest.mark.parametrize('lift', (0, 0.004, -1e-10))
def testAVelocityBringsThemIntoContact(lift):
	lower, upper = _two(lift)
	O.dt = 1e-4  # nothing is moved by forces, so nothing limits it
	O.run(200, True)
	assert not O.interactions.has(lower, upper)
	O.bodies[upper].state.vel = (0, 0, -0.01)
	start, depth = O.time, 1e-3
	polytope.run(until=start + (depth + lift) / 0.01)
	assert O.forces.f(upper)[2] == pytest.approx(stiffness * (1 - O.bodies[upper].state.pos[2]), rel=0.01)
	assert O.forces.f(upper)[2] == pytest.approx(stiffness * depth, rel=0.05)


def testAFreedBlockRestsOnWhatWasFixedBesideIt():
	lower, upper = _two()
	O.run(200, True)
	O.bodies[upper].dynamic = True
	polytope.run(until=O.time + 1)
	weight = 2600 * 9.81
	assert O.bodies[upper].state.pos[2] == pytest.approx(1 - weight / stiffness, abs=0.02 * weight / stiffness)


def testABlockThatIsPutIntoAnotherTouchesIt():
	lower, upper = _two()
	O.run(200, True)
	for depth in (1e-4, 1e-3):  # without a velocity
		O.bodies[upper].state.pos = Vector3(0, 0, 1 - depth)
		O.step()
		assert O.forces.f(upper)[2] == pytest.approx(stiffness * depth, rel=1e-3)


def testAFreedClumpRestsToo():
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5))
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 0.5, 0.5), fixed=True))
	clump, _parts = O.bodies.appendClumped([polytope.cuboid((x, 0, 1), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5)])
	O.bodies[clump].dynamic = False
	_engines()
	O.run(200, True)
	assert len([one for one in O.interactions if one.isReal]) == 0
	O.bodies[clump].dynamic = True
	polytope.run(until=O.time + 1)
	assert O.bodies[clump].state.pos[2] == pytest.approx(1 - 2600 * 9.81 / stiffness, abs=0.02 * 2600 * 9.81 / stiffness)


def testSavedScenesHaveTheSamePairs(tmp_path):
	lower, upper = _two()
	O.run(10, True)
	O.save(str(tmp_path / 'scene.yade.gz'))
	O.load(str(tmp_path / 'scene.yade.gz'))
	O.run(10, True)
	assert not O.interactions.has(lower, upper)
	O.bodies[upper].dynamic = True
	O.run(2000, True)
	assert O.interactions.has(lower, upper) and O.interactions[lower, upper].isReal


@pytest.mark.parametrize('first', (False, True))
def testAFixedPlatenOnFixedPlatesHasOneSpring(first):
	"""With a stiffness per contact, before and after it stops; its id may be lower or higher than theirs."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5, stiffnessPerArea=False))
	plates = [polytope.cuboid((x, y, -0.5), (1, 1, 0.5), fixed=True) for x in (-1, 1) for y in (-1, 1)]
	platen = polytope.cuboid((0.1, 0.2, 0.5), (0.5, 0.5, 0.5), fixed=True, velocity=(0, 0, -0.01))
	O.bodies.append([platen, *plates] if first else [*plates, platen])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.dt = 1e-4
	polytope.run(until=0.1)
	for _ in range(2):
		depth = 0.5 - float(platen.state.pos[2])
		assert depth > 9e-4
		assert O.forces.f(platen.id)[2] == pytest.approx(1e7 * depth, rel=0.02)
		platen.state.vel = (0, 0, 0)
		O.run(200, True)
