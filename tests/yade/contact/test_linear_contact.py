# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts whose bodies hardly move are taken from their last full computation, to first order (docs/contact-surface.md): the same answers as with
warmStart=False, which computes every contact in full."""

import pathlib
from math import cos, radians, sin

import numpy as np
import pytest
from yade import FrictMat, O, Quaternion, RockJointMat, Vector3, polytope

gravity = 10


def material(**options):
	O.reset()
	O.materials.append(
		RockJointMat(**{'density': 2600, 'normalStiffness': 1e9, 'shearStiffness': 5e8, 'frictionAngle': radians(35), **options})
	)


def engines(warm=True, **options):
	O.engines = polytope.engines(**options)
	functor().warmStart = warm


def functor():
	return O.engines[2].geomDispatcher.functors[0]


def followed():
	"""Part of the contacts since the last call that were followed."""
	found = functor().stats()
	functor().resetStats()
	return found['linear'] / found['contacts']


def pile(levels=4):
	"""Blocks on a floor, each turned and put aside on the one below, the upper ones resting on an edge of it."""
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
	for k in range(levels):
		turn = Quaternion((0, 0, 1), 0.4 * k)
		O.bodies.append(polytope.cuboid((0.07 * k, 0.05 * k, 0.25 + 0.4999 * k), (0.5, 0.4, 0.25), orientation=turn))


def states():
	return np.array([[*body.state.pos, *body.state.ori] for body in O.bodies])


def ofRun(build, warm, seconds):
	build(warm)
	polytope.run(until=O.time + seconds)
	return states(), [(contact.phys.normalForce, contact.phys.shearForce) for contact in O.interactions if contact.isReal]


def assertSameRest(full, forces, linear, others):
	"""States and forces of two runs, of which the latter is that in O."""
	depth = max(-contact.geom.infeasibility for contact in O.interactions if contact.isReal)
	assert np.abs(linear - full).max() < 0.01 * depth
	for one, other in zip(forces, others, strict=True):
		for a, b in zip(one, other, strict=True):
			assert (a - b).norm() < 1e-3 * forces[0][0].norm()


@pytest.mark.parametrize('perArea', [True, False])
def testAPileComesToRestWhereItDoesInFull(perArea):
	def build(warm):
		material(**({} if perArea else {'normalStiffness': 2e8, 'shearStiffness': 1e8}))
		pile()
		engines(warm)
		if not perArea:
			O.engines[2].physDispatcher.functors[0].stiffnessPerArea = False

	full, forces = ofRun(build, False, 1.5)
	assert followed() == 0
	linear, others = ofRun(build, True, 1.5)
	assert followed() > 0.3
	assertSameRest(full, forces, linear, others)


def buildPolygons(warm, perArea):
	"""Blocks of several thicknesses on a floor, each turned a little or put on its edge, and leaning on others."""
	material(**({} if perArea else {'normalStiffness': 2e8, 'shearStiffness': 1e8, 'stiffnessPerArea': False}))
	O.bodies.append(polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True, thickness=2))
	for k in range(4):
		half = 0.5 - 0.04 * k
		corners = [(x * half + 0.07 * k, 0.25 + y * 0.25 + 0.4999 * k) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
		O.bodies.append(polytope.polygon(corners, thickness=0.3 + 0.4 * k))
	O.bodies.append(polytope.polygon([(-0.95, 0.03), (-0.85, 0), (-0.51, 0.62), (-0.61, 0.65)], thickness=0.5))
	engines(warm)


@pytest.mark.parametrize('perArea', [True, False])
def testPolygonsComeToRestWhereTheyDoInFull(perArea):
	full, forces = ofRun(lambda warm: buildPolygons(warm, perArea), False, 2)
	assert followed() == 0
	linear, others = ofRun(lambda warm: buildPolygons(warm, perArea), True, 2)
	functor().resetStats()
	O.run(64, wait=True)
	assert followed() > 0.7
	assertSameRest(full, forces, linear, others)


def buildOverPieces(warm, perArea=True):
	"""A block across the seams of six pieces of a floor, cut obliquely, and one on it that is off its middle."""
	material(**({} if perArea else {'normalStiffness': 2e8, 'shearStiffness': 1e8}))
	cut = [-3, -0.35, 0.3, 3]
	for k in range(3):
		for y0, y1 in ((-3, 0.1), (0.1, 3)):
			slant = 0.2 if 0 < k else 0
			ends = [(cut[k] - slant, cut[k + 1] - 0.2 * (k < 2)), (cut[k] + slant, cut[k + 1] + 0.2 * (k < 2))]
			corners = [(x, y, z) for y, xs in ((y0, ends[0]), (y1, ends[1])) for x in xs for z in (-1, 0)]
			O.bodies.append(polytope.fromVertices(corners, fixed=True))
	ids = O.bodies.append(polytope.cuboid((0, 0, 0.4 - 2e-5), (0.8, 0.6, 0.4)))
	O.bodies.append(polytope.cuboid((0.3, 0.1, 0.95 - 4e-5), (0.3, 0.2, 0.15), orientation=Quaternion((0, 0, 1), 0.3)))
	engines(warm)
	if not perArea:
		O.engines[2].physDispatcher.functors[0].stiffnessPerArea = False
	return ids


@pytest.mark.parametrize('perArea', [True, False])
def testPiecesOfAFloorAreFollowed(perArea):
	"""What each piece carries is what it does in full, and all of them the weight; when one of them is taken away, the others take over."""
	found = {}
	for warm in (False, True):
		ids = buildOverPieces(warm, perArea)
		polytope.run(until=O.time + 2)
		functor().resetStats()
		O.run(64, wait=True)
		part = followed()
		assert part > 0.7 if warm else part == 0
		runs = []
		for removed in (None, 0):
			if removed is not None:
				O.bodies.erase(removed)
				polytope.run(until=O.time + 1)
			runs.append((states()[-2:], {(c.id1, c.id2): c.phys.normalForce[2] for c in O.interactions if c.isReal and ids in (c.id1, c.id2)}))
		found[warm] = runs
	depth = max(-contact.geom.infeasibility for contact in O.interactions if contact.isReal)
	weights = sum(O.bodies[k].state.mass for k in (ids, ids + 1)) * 9.81
	for (place, forces), (other, others) in zip(found[False], found[True], strict=True):
		assert np.abs(place - other).max() < 0.02 * depth
		assert forces.keys() == others.keys()
		for pair, force in forces.items():
			assert force == pytest.approx(others[pair], abs=1e-3 * weights)
	assert len(found[True][0][1]) > len(found[True][1][1]) >= 4


def testAPieceIsMissedInTheStepAfterItWasErased():
	"""With a stiffness per contact its neighbours have their larger shares at once, whichever step is the one in which a pair looks for neighbours."""
	block = buildOverPieces(True, perArea=False)
	polytope.run(until=O.time + 1)

	def shares():
		return {contact.id1: contact.geom.share for contact in O.interactions if contact.isReal and contact.id2 == block}

	before = shares()
	O.bodies.erase(1)
	O.step()
	after = shares()
	O.run(16, wait=True)
	later = shares()
	assert later.keys() == after.keys() == before.keys() - {1}
	for piece in after:
		assert after[piece] == pytest.approx(later[piece], abs=2e-3)
	assert max(after[piece] - before[piece] for piece in after) > 0.05


def testASlowTurntableTakesTheOutlineAlong():
	"""A block off the axis of a floor that turns: its outline turns with it, in the world by a right angle, and what friction holds is the centripetal
	force."""
	material()
	floor = O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid((2, 0, 0.24999), (0.5, 0.3, 0.25)))
	engines()
	polytope.run(until=O.time + 0.3)
	O.engines[3].damping = 0
	law = O.engines[2].lawDispatcher.functors[0]
	law.shearDamping = law.rockingDamping = 0.3
	speed = radians(90) / 2
	O.bodies[floor].state.angVel = (0, 0, speed)
	O.bodies[block].state.angVel = (0, 0, speed)
	O.bodies[block].state.vel = Vector3(0, 0, speed).cross(O.bodies[block].state.pos)
	start = O.time
	polytope.run(until=O.time + 0.5)
	functor().resetStats()
	polytope.run(until=O.time + 1.5)
	assert followed() > 0.5
	angle = speed * (O.time - start)
	contact = O.interactions[floor, block]
	state = O.bodies[block].state
	assert (state.pos - Vector3(2 * cos(angle), 2 * sin(angle), state.pos[2])).norm() < 1e-3
	# as it was when the contact was computed: the bodies have moved since
	turned = Quaternion((0, 0, 1), -speed * O.dt) * state.ori
	corners = np.array([turned.conjugate() * (corner - state.pos + O.dt * state.vel) for corner in contact.geom.outline])
	assert np.abs(np.abs(corners) - (0.5, 0.3, 0.25)).max() < 3e-5
	pull = state.mass * speed**2 * 2
	assert abs(contact.phys.shearForce.norm() - pull) < 0.02 * pull


def testABlockThatRocksKeepsItsEnergy():
	"""So slowly that most steps are linear, without damping: neither the derivative nor the steps between two full computations give or take energy."""
	material(normalStiffness=1e8, frictionAngle=radians(30))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
	ids = O.bodies.append(polytope.cuboid((0, 0, 0.5 - 2.6e3 * gravity / 1e8), (0.5, 0.5, 0.5)))
	engines(gravity=(0, 0, -gravity), damping=0)
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.trackEnergy = True
	O.bodies[ids].state.angVel = (2e-4, 1e-4, 0)
	O.step()
	O.step()
	before, energies = polytope.mechanicalEnergy(), []
	motion = O.bodies[ids].state.mass / 6 * 5e-8 / 2
	functor().resetStats()
	for _ in range(20):
		O.run(500, wait=True)
		energies.append(polytope.mechanicalEnergy())
	assert followed() > 0.5
	assert max(abs(energy - before) for energy in energies) < 0.01 * motion


@pytest.mark.parametrize('steps', [1, 7])
def testASavedPileGoesOnToTheBit(steps, tmp_path):
	material()
	pile()
	engines(timeStepper=False)  # it sets O.dt in another step after loading
	O.dt = 1e-4
	polytope.run(until=O.time + 0.5)
	functor().resetStats()
	O.run(50, wait=True)
	assert followed() > 0.3
	path = str(pathlib.Path(tmp_path) / 'pile.yade.bin')
	O.save(path, quiet=True)
	O.run(steps, wait=True)
	expected = states()
	O.load(path, quiet=True)
	O.run(steps, wait=True)
	assert np.array_equal(states(), expected)


def testAShapeThatIsExchangedIsNoticed():
	material()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
	ids = O.bodies.append(polytope.cuboid((0, 0, 0.49999), (0.5, 0.5, 0.5)))
	engines()
	polytope.run(until=O.time + 0.5)
	functor().resetStats()
	O.step()
	assert followed() == 1
	O.bodies[ids].shape = polytope.cuboid((0, 0, 0), (0.4, 0.5, 0.5)).shape
	O.step()
	assert followed() == 0
	assert O.interactions[0, ids].geom.contactArea == pytest.approx(0.8, rel=1e-3)


def testYadesOwnPhysicsAreFollowed():
	O.reset()
	O.materials.append(FrictMat(density=2600, young=1e9, poisson=0.3, frictionAngle=0.6))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
	ids = O.bodies.append(polytope.cuboid((0, 0, 0.49999), (0.5, 0.5, 0.5)))
	engines(damping=0.3)
	polytope.run(until=O.time + 0.5)
	functor().resetStats()
	O.run(20, wait=True)
	assert followed() > 0.8
	force = O.interactions[0, ids].phys.normalForce.norm()
	assert force == pytest.approx(9.81 * O.bodies[ids].state.mass, rel=1e-4)
