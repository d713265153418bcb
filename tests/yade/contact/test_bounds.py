# SPDX-License-Identifier: GPL-2.0-or-later
"""A body that turns in place meets its neighbour however rarely the collider runs; boxes are tight where the collider takes account of
rotation."""

import ctypes
import math

import numpy as np
import pytest
from boon2012.falling.scene import FallingPolyhedra
from scenes import driven, joint, loop
from yade import Bo1_Polytope_Aabb, InsertionSortCollider, O, Polytope, PolytopeCollider, Quaternion, Vector3, polytope

colliders = [InsertionSortCollider, PolytopeCollider]


def collider(kind, verletDist):
	O.engines = [O.engines[0], kind([Bo1_Polytope_Aabb()], verletDist=verletDist), *O.engines[2:]]
	return O.engines[1]


@pytest.mark.parametrize('kind', colliders)
@pytest.mark.parametrize('verletDist', [0, 1e-6, 0.01, 0.2])
def testRodTurningInPlaceIsSeen(kind, verletDist):
	joint()
	loop()
	collider(kind, verletDist)
	rod, block = polytope.cuboid((0, 0, 0), (1, 0.1, 0.1)), polytope.cuboid((0, 1.1, 0), (0.5, 0.3, 0.5), fixed=True)
	O.bodies.append([rod, block])
	driven(rod, angularVelocity=(0, 0, 1))
	O.dt = 1e-3
	while O.interactions.countReal() == 0 and O.iter < 2000:
		O.step()
	assert O.interactions.countReal() == 1
	contact = O.interactions[rod.id, block.id]
	assert 0 < contact.geom.penetrationDepth < 2e-3  # a step's travel of the tip
	# the block's corner (0.5, 0.8) meets the rod's upper face, 0.1 from its axis
	assert O.iter * O.dt == pytest.approx(math.acos(0.1 / math.hypot(0.5, 0.8)) - math.atan(0.5 / 0.8), abs=3e-3)


@pytest.mark.parametrize('kind', colliders)
def testBodyTurnedByTheScriptIsSeen(kind):
	"""The body's angVel stays zero; the other collider notices only a translation."""
	joint()
	loop()
	collider(kind, 0.05)
	rod, block = polytope.cuboid((0, 0, 0), (1, 0.1, 0.1)), polytope.cuboid((0, 0.8, 0), (0.2, 0.2, 0.2), fixed=True)
	O.bodies.append([rod, block])
	driven(rod)
	O.dt = 1e-6
	O.step()
	assert not list(O.interactions)
	rod.state.ori = Quaternion((0, 0, 1), math.pi / 2)
	if kind is InsertionSortCollider:
		rod.state.pos += Vector3(0.1, 0, 0)
		O.step()
	O.step()
	assert O.interactions[rod.id, block.id].isReal


def testBoxesAreTightWhereNothingTurns():
	joint()
	loop()
	fixed, free = polytope.cuboid((0, 0, 0), (3, 2, 1), fixed=True), polytope.cuboid((9, 0, 0), (3, 2, 1))
	O.bodies.append([fixed, free])
	O.engines[1].verletDist = 0
	O.dt = 1e-6
	O.step()
	assert list(fixed.bound.max) == pytest.approx([3, 2, 1])
	assert list(free.bound.max) == pytest.approx([9 + math.sqrt(14), math.sqrt(14), math.sqrt(14)])


@pytest.mark.parametrize('verletDist', [0, 0.25, 2])
def testBoxesOfPolytopeColliderAreTightWithRoomToTurn(verletDist):
	joint()
	loop()
	collider(PolytopeCollider, verletDist)
	fixed, free = polytope.cuboid((0, 0, 0), (3, 2, 1), fixed=True), polytope.cuboid((12, 0, 0), (3, 2, 1))
	O.bodies.append([fixed, free])
	O.dt = 1e-6
	O.step()
	ball = math.sqrt(14)
	assert list(fixed.bound.max) == pytest.approx([3 + verletDist, 2 + verletDist, 1 + verletDist])
	# a tenth of it for the turn of a body at rest, and never more than the circumscribed ball
	turn = 0.1 * verletDist
	assert list(free.bound.max) == pytest.approx(
		[x + verletDist for x in (12 + min(3 + turn, ball), min(2 + turn, ball), min(1 + turn, ball))]
	)
	assert list(free.bound.min) == pytest.approx(
		[x - verletDist for x in (12 - min(3 + turn, ball), -min(2 + turn, ball), -min(1 + turn, ball))]
	)


def testRoomToTurnIsThatOfAHundredSteps():
	joint()
	loop()
	collider(PolytopeCollider, 0.2)
	radius = math.sqrt(14)
	slow, fast = polytope.cuboid((0, 0, 0), (3, 2, 1)), polytope.cuboid((12, 0, 0), (3, 2, 1))
	O.bodies.append([slow, fast])
	driven(slow, angularVelocity=(0, 0, 0.1 / radius))
	driven(fast, angularVelocity=(0, 0, 6 / radius))  # the Verlet distance in 3.3 steps: the circumscribed ball's box
	O.dt = 0.01
	O.step()
	assert list(slow.bound.max) == pytest.approx([3 + 0.1 + 0.2, 2 + 0.1 + 0.2, 1 + 0.1 + 0.2])
	assert list(fast.bound.max) == pytest.approx([12 + radius + 0.2, radius + 0.2, radius + 0.2])
	before = O.engines[1].numAction
	O.run(95, True)
	assert O.engines[1].numAction == before
	O.run(10, True)
	assert O.engines[1].numAction == before + 1  # its box alone is made anew, with room from its rotation since
	assert slow.bound.max[2] == pytest.approx(1 + 0.1, rel=1e-3) and list(fast.bound.max) == pytest.approx([12 + radius, radius, radius])


def testBodySpinningInPlaceDoesNotKeepTheColliderBusy():
	joint()
	loop()
	busy = collider(PolytopeCollider, 0.02)
	spinner = polytope.cuboid((0, 0, 0), (1, 0.5, 0.2))
	O.bodies.append(spinner)
	driven(spinner, angularVelocity=(0, 3, 1))
	O.dt = 0.01
	O.run(500, True)
	assert busy.numAction < 10
	assert spinner.bound.max[2] >= math.sqrt(1.29)  # the ball's
	# and gets a tight box when it has come to rest and the collider has run
	spinner.state.angVel = (0, 0, 0)
	spinner.state.ori = Quaternion.Identity
	for _ in range(3):
		spinner.state.pos += Vector3(0.05, 0, 0)
		O.step()
		O.step()
	assert spinner.bound.max[2] < 0.3


def runsOfTheCollider(kind, steps):
	"""Runs in these steps, after the first two, and the number of bodies whose orientation changed in them (YADE normalises it)."""
	busy = collider(kind, 0.05)
	O.dt = 1e-4
	O.run(2, True)
	before, orientations = busy.numAction, [Quaternion(body.state.ori) for body in O.bodies]
	changed = set()
	for _ in range(steps):
		O.step()
		changed.update(body.id for body, old in zip(O.bodies, orientations) if body.state.ori != old)
	return busy.numAction - before, len(changed)


def testFixedObliqueBodyDoesNotKeepTheColliderBusy():
	"""The box of a body that cannot turn is not enlarged, and YADE normalises every orientation in each step: it differs by a rounding."""
	runs = []
	for kind in colliders:
		O.reset()
		joint()
		loop()
		O.bodies.append(polytope.fromVertices(np.random.default_rng(11).uniform(-1, 1, (8, 3)), fixed=True))
		runs.append(runsOfTheCollider(kind, 100)[0])
	assert runs == [0, 0]


def testTwoThousandFixedObliqueBodiesDoNotKeepTheColliderBusy():
	"""The bodies have any orientation, and are far from the origin, too; some of them are changed by the normalisation in each step."""
	joint()
	loop()
	random = np.random.default_rng(5)
	for k in range(2500):
		angle = random.uniform(0, 2 * math.pi)
		at = Vector3(1e3 * (k % 50), 1e3 * (k // 50), 0)
		O.bodies.append(polytope.cuboid(at, (0.5, 0.4, 0.3), Quaternion(Vector3(*random.normal(0, 1, 3)).normalized(), angle), fixed=True))
	runs, changed = runsOfTheCollider(PolytopeCollider, 20)
	assert changed > 0 or polytope.buildInfo()['precision'] != 'double'
	assert runs == 0


def testSlowestTurnThatIsOneIsSeen():
	"""A fixed body turned by the script, by as little as moves a vertex by more than rounding: its box is made anew."""
	joint()
	loop()
	rod = polytope.cuboid((0, 0, 0), (1, 0.1, 0.1), Quaternion((1, 2, 3), 0.4), fixed=True)
	O.bodies.append(rod)
	runs, _ = runsOfTheCollider(PolytopeCollider, 10)
	assert runs == 0
	for tiny in (1e-14, 1e-9):
		before, turned = O.engines[1].numAction, rod.state.ori * Quaternion((0, 0, 1), tiny)
		rod.state.ori = turned
		O.run(3, True)
		assert O.engines[1].numAction == before + 1


def tightBoxes():
	boxes = {}
	for body in O.bodies:
		if body is None or body.isClump or not isinstance(body.shape, Polytope):
			continue
		points = np.array([list(body.state.pos + body.state.ori * vertex) for vertex in body.shape.vertices])
		boxes[body.id] = points.min(axis=0), points.max(axis=0)
	return boxes


def missed():
	"""How many pairs may meet and have tight boxes that overlap; and those whose bodies do, and that the collider has not found."""
	boxes = tightBoxes()
	found = {(min(one.id1, one.id2), max(one.id1, one.id2)) for one in O.interactions.all()}
	ids, pairs = sorted(boxes), 0
	lost = []
	for i in ids:
		for j in ids:
			one, two = O.bodies[i], O.bodies[j]
			if j <= i or (one.clumpId >= 0 and one.clumpId == two.clumpId) or not (one.dynamic or two.dynamic):
				continue
			if (boxes[i][0] <= boxes[j][1]).all() and (boxes[j][0] <= boxes[i][1]).all():
				pairs += 1
				if (i, j) not in found and polytope.contact(one, two).inContact:
					lost.append((i, j))
	return pairs, lost


@pytest.mark.parametrize('verletFraction', [0.005, 0.05, 0.3])
def testNoPairOfAHeapIsMissed(verletFraction):
	scene = FallingPolyhedra(faces=[4, 6], number=40, verletFraction=verletFraction, seed=3)
	scene.build()
	looked = 0
	for body in scene.particles():
		body.state.angVel = (7, -5, 3)
	for _ in range(25):
		O.run(40, True)
		pairs, lost = missed()
		assert not lost
		looked += pairs
	assert looked > 400
	assert isinstance(O.engines[1], PolytopeCollider)


def testPairsOfTumblingClumpsAreFound():
	joint()
	loop(gravity=(0, 0, -10), damping=0.1)
	collider(PolytopeCollider, 0.05)
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 9, 1), fixed=True))
	for k in range(4):
		at = Vector3(k * 0.8 - 1.5, 0.3 * k, 0.8 + 0.9 * k)
		O.bodies.appendClumped([polytope.cuboid(at, (0.6, 0.2, 0.2)), polytope.cuboid(at + Vector3(0.5, 0.5, 0), (0.2, 0.6, 0.2))])
	O.dt = 2e-4
	for _ in range(40):
		O.run(100, True)
		pairs, lost = missed()
		assert not lost
	assert pairs > 4


def testAfterLoadingNoPairIsMissed(tmp_path):
	scene = FallingPolyhedra(faces=[4], number=30, seed=5)
	scene.build()
	O.run(600, True)
	O.save(str(tmp_path / 'heap.yade.gz'))
	O.load(str(tmp_path / 'heap.yade.gz'))
	for _ in range(10):
		O.run(40, True)
		pairs, lost = missed()
		assert pairs > 20 and not lost


def faces(gap, verletDist):
	"""Two cubes whose faces, at 45° to the axes, are so far apart, so that their boxes overlap."""
	joint()
	loop()
	collider(PolytopeCollider, verletDist)
	turned = Quaternion((0, 0, 1), math.pi / 4)
	way = (1 + gap) / math.sqrt(2)
	O.bodies.append([polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5), turned), polytope.cuboid((way, way, 0), (0.5, 0.5, 0.5), turned)])
	O.dt = 1e-3
	return O.bodies


def testPairsThatStayApartHaveNoInteraction():
	one, other = faces(gap=0.1, verletDist=0.01)
	O.step()
	assert len(O.interactions) == 0
	# s* is half the gap; without room for a way all are pairs whose boxes overlap
	O.engines[1].verletDist = 0
	O.step()
	assert len(O.interactions) == 1 and O.interactions.countReal() == 0
	# a piece of a rigid support keeps its pairs: internal faces are searched for among them
	O.engines[1].verletDist = 0.01
	one.dynamic = False
	O.engines[1]()
	assert len(O.interactions) == 1
	one.dynamic = True
	O.engines[1]()
	assert len(O.interactions) == 0


@pytest.mark.parametrize('speed', [0.01, 1, 20])
def testPairThatComesNearIsFoundBeforeItTouches(speed):
	one, other = faces(gap=0.1, verletDist=0.01)
	other.state.vel = Vector3(-1, -1, 0) / math.sqrt(2) * speed
	O.dt = 1e-3 / speed
	began = None
	for _ in range(200):
		O.step()
		if began is None and O.interactions.all(onlyReal=False):
			began = O.iter
		if O.interactions.countReal():
			break
	gap = math.sqrt(2) * (other.state.pos - one.state.pos)[0] - 1
	assert O.interactions[0, 1].isReal and gap > -2e-3
	assert 30 < began < O.iter or speed == 20  # not before it was near, and not with the contact


def testPairThatTurnsTogetherIsFoundBeforeItTouches():
	"""Translation is zero: the rotation alone brings them together."""
	joint()
	loop()
	collider(PolytopeCollider, 0.01)
	rod, block = polytope.cuboid((0, 0, 0), (1, 0.1, 0.1)), polytope.cuboid((0.8, 0.75, 0), (0.3, 0.3, 0.3))
	O.bodies.append([rod, block])
	driven(rod, angularVelocity=(0, 0, 0.2))
	O.dt = 1e-3
	O.step()
	assert len(O.interactions) == 0
	while not O.interactions.countReal() and O.iter < 10000:
		O.step()
	assert 0 < O.interactions[0, 1].geom.penetrationDepth < 4e-4


def testFewBoxesAreMadeAnew():
	"""One body moves among many at rest: the others keep their boxes, and its pairs come and go."""
	joint()
	loop()
	collider(PolytopeCollider, 0.02)
	O.bodies.append([polytope.cuboid((1.2 * (k % 20), 1.2 * (k // 20), 0), (0.5, 0.5, 0.5), fixed=k % 2 == 0) for k in range(400)])
	runner = polytope.cuboid((0, 0, 1.01), (0.5, 0.5, 0.5))
	O.bodies.append(runner)
	driven(runner)
	runner.state.vel = (3, 3, 0)
	O.dt = 1e-3
	O.step()
	seen, made = set(), [body.bound.lastUpdateIter for body in O.bodies]
	O.run(90, True)
	assert O.engines[1].numAction > 10 and [body.bound.lastUpdateIter for body in O.bodies][:400] == made[:400]
	for _ in range(7000):
		O.step()
		mine = {min(pair.id1, pair.id2) for pair in O.interactions.all(onlyReal=False) if runner.id in (pair.id1, pair.id2)}
		seen |= mine
		assert len(mine) <= 4 + 5
	assert min(body.bound.lastUpdateIter for body in O.bodies) > O.iter - 120  # of all after a hundred steps
	assert seen >= {21 * k for k in range(0, 18, 2)}  # the fixed ones on the diagonal keep their pairs while boxes overlap
	assert len(O.interactions) < 8


def testShapeChangedInPlaceIsSeen():
	"""The collider sees it at once if it is told; else when boxes of all bodies are made anew, while one of them moves."""
	for told in (True, False):
		O.reset()
		joint()
		loop()
		collider(PolytopeCollider, 0.02)
		O.bodies.append([polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5), fixed=True), polytope.cuboid((0, 0, 1.2), (0.5, 0.5, 0.5))])
		O.bodies.append([polytope.cuboid((9 + 2 * k, 0, 0), (0.5, 0.5, 0.5)) for k in range(8)])
		driven(O.bodies[1])
		O.bodies[9].state.vel = (0, 0, 3)
		O.dt = 1e-3
		O.run(3, True)
		assert len(O.interactions) == 0
		O.bodies[1].shape = polytope.cuboid((0, 0, 0), (0.8, 0.8, 0.8)).shape
		O.engines[1].doSort = told
		O.run(1 if told else 120, True)
		assert O.interactions.countReal() == 1 and not O.engines[1].doSort


def testManyThreadsFindTheSamePairsInTheSameOrder():
	"""The loop's order decides in which order forces are added up."""
	order = []
	openMp = ctypes.CDLL('libgomp.so.1')
	for threads in (1, 2, 3):
		scene = FallingPolyhedra(faces=[6, 20], number=120, seed=4)
		scene.build()
		O.run(2500, True)
		assert O.interactions.countReal() > 60
		O.interactions.clear()
		openMp.omp_set_num_threads(threads)
		try:
			O.engines[1]()
		finally:
			openMp.omp_set_num_threads(1)
		order.append([(pair.id1, pair.id2) for pair in O.interactions.all(onlyReal=False)])
	assert len(order[0]) > 60 and order[1] == order[0] and order[2] == order[0]


def testBladeOfAnyShapeThatTurnsInPlaceIsSeen():
	"""Boxes and facets have no room to turn: their boxes follow in each step."""
	from yade import utils

	for make, where in ((utils.box, ((0, 0, 0), (1, 0.02, 0.2))), (utils.facet, ([(-1, 0, -0.2), (1, 0, -0.2), (0, 0, 0.4)],))):
		O.reset()
		joint()
		block = polytope.cuboid((0, 0.8, -0.2), (0.2, 0.2, 0.2))
		blade = make(*where, fixed=True)
		O.bodies.append([blade, block])
		O.engines = polytope.engines(gravity=(0, 0, 0), timeStepper=False)
		blade.state.angVel = (0, 0, 2)
		O.dt = 1e-3
		for _ in range(2000):
			O.step()
			if O.interactions.countReal():
				break
		assert O.interactions.countReal() == 1 and 0.9 < O.iter * O.dt * 2 < 1.3


def testPeriodicCellThatShearsMissesNoContact():
	"""Both colliders find the same contacts among tumbling blocks in a sheared periodic cell."""
	found = {}
	for kind in colliders:
		O.reset()
		joint()
		loop(damping=0)
		O.periodic = True
		O.cell.setBox(8, 8, 8)
		O.cell.velGrad = ((0, 0.2, 0), (0, 0, 0), (0, 0, 0))
		collider(kind, 0.1)
		random = np.random.default_rng(11)
		for i in range(64):
			body = polytope.cuboid((2 * (i % 4) + 1, 2 * (i // 4 % 4) + 1, 2 * (i // 16) + 1), (0.9, 0.8, 0.7))
			body.state.angVel = tuple(random.normal(0, 5, 3))
			O.bodies.append(body)
		O.dt = 5e-4
		times = []
		for _ in range(60):
			O.run(20, True)
			times.append(sorted((one.id1, one.id2) for one in O.interactions))
		found[kind] = times
	assert sum(map(len, found[PolytopeCollider])) > 50
	first = next(i for i, contacts in enumerate(found[InsertionSortCollider]) if contacts)
	# the same until rounding of sums in another order has grown
	assert found[PolytopeCollider][: first + 20] == found[InsertionSortCollider][: first + 20]


def testColliderKeepsThePeersShapes():
	"""Spheres among polytopes keep the other collider's boxes."""
	from yade import Bo1_Sphere_Aabb, utils

	joint()
	loop()
	O.engines = [O.engines[0], PolytopeCollider([Bo1_Polytope_Aabb(), Bo1_Sphere_Aabb()], verletDist=0.1), *O.engines[2:]]
	ball = utils.sphere((0, 0, 0), 1)
	O.bodies.append([ball, polytope.cuboid((9, 0, 0), (1, 1, 1))])
	O.dt = 1e-6
	O.step()
	assert list(ball.bound.max) == pytest.approx([1.1, 1.1, 1.1])


def testBodyWhosePoseIsNoNumberHidesNoOther():
	"""The collider goes on; its neighbours' contacts are found."""
	joint()
	loop()
	collider(PolytopeCollider, 0.05)
	lost, one, two = (polytope.cuboid((x, 0, 0), (0.5, 0.5, 0.5)) for x in (-3, 0, 2))
	O.bodies.append([lost, one, two])
	O.dt = 1e-4
	O.step()
	lost.state.ori = Quaternion(float('nan'), 0, 0, 0)
	two.state.vel = (-2, 0, 0)
	O.run(6000, True)
	assert one.state.vel[0] < -0.1  # it has been hit


def testErasedBodiesAreForgotten():
	joint()
	loop()
	collider(PolytopeCollider, 0.05)
	bodies = [polytope.cuboid((3 * k, 0, 0), (0.5, 0.5, 0.5)) for k in range(5)]
	O.bodies.append(bodies)
	for body in bodies:
		body.state.angVel = (0, 0, 0.1)
	O.dt = 1e-3
	O.run(20, True)
	O.bodies.erase(1)
	O.bodies.erase(4)
	O.run(200, True)
	O.bodies.clear()
	O.engines[1].isActivated()
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)))
	O.run(20, True)
	# half an edge, and a tenth of the Verlet distance, as of a body at rest, for its way and for its turn: nothing of the bodies before it
	assert list(O.bodies[0].bound.max) == pytest.approx([0.51, 0.51, 0.51]) and list(O.bodies[0].bound.min) == pytest.approx(
		[-0.51, -0.51, -0.51]
	)
