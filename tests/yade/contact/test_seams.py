# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres and solids on seams, ridges and corners of several pieces, and facets of a bent mesh: as on one piece, whatever the physics."""

import math
import warnings

import pytest
from flatFace import sunk
from scipy.optimize import brentq
from scipy.spatial import ConvexHull
from yade import (
	FrictMat,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_FrictMat_FrictMat_MindlinPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_MindlinPhys_Mindlin,
	MatchMaker,
	O,
	PolytopeTimeStepper,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
	utils,
)

stiffness = 1e8
rules = pytest.mark.parametrize('rule', ['perArea', 'perContact', 'yadesOwn'])


def joints(rule, friction=0.5):
	"""Adds the material; returns physics with one stiffness for all contacts, whatever YADE takes for the sizes of bodies."""
	if rule == 'yadesOwn':
		O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=friction))
		given = {name: MatchMaker(algo='val', val=stiffness) for name in ('kn', 'ks')}
		return Ip2_FrictMat_FrictMat_FrictPhys(**given)
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=friction))
	return Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=rule == 'perArea')


def restingDepth(pieces, body, rule, blocked='xyXYZ', friction=0.5, steps=5000):
	"""How far the body has sunk from where it just touches, held from all motion but down; and its real contacts."""
	O.reset()
	physics = joints(rule, friction)
	O.bodies.append(pieces())
	resting = O.bodies[O.bodies.append(body())]
	resting.state.blockedDOFs = blocked
	height = resting.state.pos[2]
	O.engines = polytope.engines(damping=0.5, physics=physics)
	O.run(steps, wait=True)
	assert all(functor.stats()['failures'] == 0 for functor in O.engines[2].geomDispatcher.functors if hasattr(functor, 'stats'))
	contacts = [contact for contact in O.interactions if contact.isReal]
	carried = sum(abs(contact.phys.normalForce.dot(Vector3(0, 0, 1))) for contact in contacts)
	assert carried == pytest.approx(resting.state.mass * 9.81, rel=1e-2)
	return height - resting.state.pos[2], contacts


def plates(number):
	"""A floor of 6 m by 6 m."""
	columns, rows = (1, 2)[number > 1], (1, 2)[number > 2]
	places = {1: [0], 2: [-1.5, 1.5]}
	return [polytope.cuboid((x, y, -0.5), (3 / columns, 3 / rows, 0.5), fixed=True) for x in places[columns] for y in places[rows]]


def ridge(number):
	if number == 1:
		return [polytope.fromVertices([(s, y, -abs(s)) for y in (-2, 2) for s in (-1, 0, 1)], fixed=True)]
	return [
		polytope.fromVertices([(0, y, z) for y in (-2, 2) for z in (0, -1)] + [(s, y, -1) for y in (-2, 2)], fixed=True) for s in (-1, 1)
	]


def pyramid(number):
	base = [(1, 1, -1), (-1, 1, -1), (-1, -1, -1), (1, -1, -1)]
	if number == 1:
		return [polytope.fromVertices(base + [(0, 0, 0)], fixed=True)]
	return [polytope.fromVertices([(0, 0, 0), (0, 0, -1), base[k], base[(k + 1) % 4]], fixed=True) for k in range(4)]


def ball(x=0.0, y=0.0, radius=0.3):
	return lambda: utils.sphere((x, y, radius), radius)


@rules
@pytest.mark.parametrize(
	'floor, number, place',
	[
		(plates, 2, (0, 0.2)),
		(plates, 4, (0, 0)),
		(plates, 2, (0.001, 0.2)),
		(plates, 4, (0.001, -0.002)),
		(ridge, 2, (0, 0)),
		(pyramid, 4, (0, 0)),
	],
)
def testABallIsAsDeepOnPiecesAsOnOne(floor, number, place, rule):
	one, _ = restingDepth(lambda: floor(1), ball(*place), rule)
	depth, contacts = restingDepth(lambda: floor(number), ball(*place), rule)
	assert depth == pytest.approx(one, rel=1e-4)
	assert len(contacts) == number
	assert sum(contact.geom.share for contact in contacts) == pytest.approx(1, rel=1e-6)
	for contact in contacts:
		assert abs(contact.geom.normal[2]) == pytest.approx(1, abs=1e-9)


def testABallInAValleyHasTwoFullSprings():
	"""What it touches at two places is no seam."""
	valley = lambda: [
		polytope.fromVertices([(0, y, z) for y in (-2, 2) for z in (0, -1)] + [(s, y, z) for y in (-2, 2) for z in (1, -1)], fixed=True)
		for s in (-1, 1)
	]
	radius = 0.3
	depth, contacts = restingDepth(valley, lambda: utils.sphere((0, 0, radius * math.sqrt(2)), radius), 'perContact', friction=0)
	assert [contact.geom.share for contact in contacts] == [1, 1]
	mass = 2600 * 4 / 3 * math.pi * radius**3
	assert depth == pytest.approx(mass * 9.81 / stiffness, rel=1e-4)  # each is pressed by depth/√2, along 45°


def testABallAtTheEndOfAPlateKeepsItsSpring():
	_, contacts = restingDepth(lambda: [polytope.cuboid((-1, 0, -0.5), (1, 1, 0.5), fixed=True)], ball(0, 0.2), 'perContact')
	assert [contact.geom.share for contact in contacts] == [1]


@pytest.mark.parametrize('clumped', [True, False])
@pytest.mark.parametrize('rule', ['perArea', 'perContact'])
def testFreePlatesShareABall(clumped, rule):
	"""The plates lie on a floor, and each of them carries half of the ball."""

	def pieces():
		floor = [polytope.cuboid((0, 0, -2), (3, 3, 1), fixed=True)]
		two = [polytope.cuboid((x, 0, -0.5), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5)]
		O.bodies.append(floor)
		if clumped:
			O.bodies.appendClumped(two)
		else:
			O.bodies.append(two)
		return []

	O.reset()
	physics = joints(rule)
	pieces()
	radius = 0.1
	resting = O.bodies[O.bodies.append(utils.sphere((0, 0, radius), radius))]
	resting.state.blockedDOFs = 'xyXYZ'
	O.engines = polytope.engines(damping=0.5, physics=physics)
	O.run(12000, wait=True)
	contacts = [contact for contact in O.interactions if contact.isReal and resting.id in (contact.id1, contact.id2)]
	assert [contact.geom.share for contact in contacts] == pytest.approx([0.5, 0.5], abs=1e-2)
	for contact in contacts:
		assert contact.phys.normalForce.norm() == pytest.approx(resting.state.mass * 9.81 / 2, rel=1e-2)


def testHertzianSpringsAreShared():
	"""So they are with a stiffness of k √depth, too; one plate has its centre as far away as those of two, which YADE takes for its size."""
	depths = []
	for pieces in ([(1.5, 0, -0.5)], [(-1.5, 0, -0.5), (1.5, 0, -0.5)]):
		O.reset()
		O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.5))
		O.bodies.append([polytope.cuboid(centre, (3 if len(pieces) == 1 else 1.5, 3, 0.5), fixed=True) for centre in pieces])
		resting = O.bodies[O.bodies.append(utils.sphere((0, 0, 0.3), 0.3))]
		resting.state.blockedDOFs = 'xyXYZ'
		O.engines = polytope.engines(damping=0.5, physics=Ip2_FrictMat_FrictMat_MindlinPhys(), law=Law2_ScGeom_MindlinPhys_Mindlin())
		O.run(8000, wait=True)
		depths.append(0.3 - resting.state.pos[2])
	assert depths[1] == pytest.approx(depths[0], rel=1e-3)


def testABallRollsOverSeamsAsOnOnePlate():
	speeds = []
	for number in (1, 10):
		O.reset()
		physics = joints('perContact')
		width = 4 / number
		O.bodies.append([polytope.cuboid((width * (k + 0.5) - 0.5, 0, -0.5), (width / 2, 1, 0.5), fixed=True) for k in range(number)])
		radius = 0.1
		rolling = O.bodies[O.bodies.append(utils.sphere((0, 0.03, radius), radius))]
		rolling.state.pos -= Vector3(0, 0, rolling.state.mass * 9.81 / stiffness)
		rolling.state.vel, rolling.state.angVel = (1, 0, 0), (0, 1 / radius, 0)
		O.engines = polytope.engines(damping=0, physics=physics)
		while rolling.state.pos[0] < 1.7:
			O.run(200, wait=True)
		speeds.append(rolling.state.vel[0])
	assert speeds[1] == pytest.approx(speeds[0], rel=1e-5)


# solids


def cube(degrees=0, axis=(0, 1, 0), half=0.3, beside=0.0):
	"""Turned about an axis, its lowest point where the seams meet."""

	def make():
		turn = Quaternion(Vector3(axis).normalized(), math.radians(degrees))
		corners = [turn * Vector3(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
		lowest = min(corners, key=lambda corner: corner[2])
		along = (-lowest[0] + beside, -lowest[1] if axis[0] else 0, -lowest[2]) if degrees else (0, 0, half)
		return polytope.cuboid(along, (half, half, half), orientation=turn)

	return make


@pytest.mark.parametrize('rule', ['perContact', 'yadesOwn'])
@pytest.mark.parametrize('number', [2, 4])
@pytest.mark.parametrize(
	'body',
	[cube(), cube(45), cube(20), cube(20, beside=1e-4), cube(54.7356, (1, 1, 0)), cube(54.7356, (1, 1, 0), beside=1e-3)],
	ids=['face', 'edge', 'edge20', 'edgeBeside', 'corner', 'cornerBeside'],
)
def testASolidIsAsDeepOnPiecesAsOnOne(body, number, rule):
	one, _ = restingDepth(lambda: plates(1), body, rule)
	depth, contacts = restingDepth(lambda: plates(number), body, rule)
	assert depth == pytest.approx(one, rel=1e-3)
	assert sum(contact.geom.share for contact in contacts) == pytest.approx(1, rel=1e-3)


def testAStiffnessOfYadesOwnIsSharedOnceHoweverTheShareChanges():
	"""It is multiplied in place: across a seam and back it is what it was."""
	O.reset()
	physics = joints('yadesOwn')
	O.bodies.append(plates(2))
	moving = O.bodies[O.bodies.append(utils.sphere((-0.1, 0, 0.2999), 0.3, fixed=True))]
	O.engines = polytope.engines(physics=physics, timeStepper=False)
	O.dt = 1e-4
	moving.state.vel = (0.1, 0, 0)
	sums = []
	for step in range(4000):
		if step == 2000:
			moving.state.vel = (-0.1, 0, 0)
		O.step()
		contacts = [contact for contact in O.interactions if contact.isReal]
		for contact in contacts:
			assert contact.phys.kn == pytest.approx(contact.geom.share * stiffness, rel=1e-9)
			assert contact.phys.ks == pytest.approx(contact.geom.share * stiffness, rel=1e-9)
		sums.append(sum(contact.phys.normalForce.norm() for contact in contacts))
	assert sums == pytest.approx([1e-4 * stiffness] * 4000, rel=1e-6)


# facets


def bent(left, right):
	"""Two slopes that meet in a line, of two facets each."""
	facets = []
	for s, fall in ((-1, left), (1, right)):
		facets += [utils.facet(((0, -2, 0), (0, 2, 0), (s, 2, -fall))), utils.facet(((0, -2, 0), (s, 2, -fall), (s, -2, -fall))[::-1])]
	return facets


def tip(base):
	return [utils.facet(((0, 0, 0), base[k], base[(k + 1) % len(base)])) for k in range(len(base))]


regular = {
	number: [(math.cos(2 * math.pi * k / number + 0.1), math.sin(2 * math.pi * k / number + 0.1), -1) for k in range(number)]
	for number in (3, 4, 8, 32)
}


def sunkOnRidge(area, radius, perArea, length=1.0, force=2600 * 9.81 / stiffness):
	"""How far a block of this length sinks onto a ridge. *area*, *radius*: of the ridge's section one unit below its edge, and of the circle in it [1]."""

	def grows(h):
		"""Force over the stiffness. V = A (L r/3 − r²/6), W = A (L r²/12 − r³/15) with A = α h², r = ϱ h."""
		v, vGrows = (
			area * (length * radius / 3 * h**3 - radius**2 / 6 * h**4),
			area * (length * radius * h**2 - 2 * radius**2 / 3 * h**3),
		)
		w, wGrows = (
			area * (length * radius**2 / 12 * h**4 - radius**3 / 15 * h**5),
			area * (length * radius**2 / 3 * h**3 - radius**3 / 3 * h**4),
		)
		return (2 * vGrows if perArea else 36 * w / v * (wGrows * v - w * vGrows) / v**2) - force

	return brentq(grows, 1e-9, 0.2)


def onRidge():
	return polytope.cuboid((0, 0.1, 0.5), (0.5, 0.5, 0.5))


@pytest.mark.parametrize('rule', rules.args[1])
@pytest.mark.parametrize('left, right', [(0.5, 0.5), (1, 1), (1.5, 1.5), (2, 2), (0.5, 1)])
def testARidgeOfPiecesIsThatOfOneSolid(left, right, rule):
	"""Of facets, of one solid, of two, and of four, two of which lie flush on each side."""
	found = []
	for ridge in [lambda: bent(left, right), *(lambda number=number: slopes(left, right, number) for number in (1, 2, 4))]:
		depth, contacts = restingDepth(ridge, onRidge, rule, steps=8000)
		found.append(depth)
		assert sum(contact.geom.share for contact in contacts) == pytest.approx(1, rel=1e-6)
	assert found == pytest.approx([found[0]] * 4, rel=1e-5)
	width = 1 / left + 1 / right
	radius = width / (width + math.hypot(1, 1 / left) + math.hypot(1, 1 / right))
	assert found[0] == pytest.approx(sunkOnRidge(width / 2, radius, rule == 'perArea'), rel=1e-3)


def wedges(base):
	return [polytope.fromVertices([(0, 0, 0), (0, 0, -1), base[k], base[(k + 1) % len(base)]], fixed=True) for k in range(len(base))]


@pytest.mark.parametrize('rule', rules.args[1])
@pytest.mark.parametrize('sides', [3, 4, 8])
@pytest.mark.parametrize('pieces', [tip, wedges], ids=['facets', 'wedges'])
def testATipOfPiecesIsThatOfOneSolid(pieces, sides, rule):
	"""A pyramid with an inscribed ball of radius r, volume Ω: V = Ω r/4, W = Ω r²/20, Ω = ω h³, r = ϱ h."""
	base = regular[sides]
	depth, contacts = restingDepth(
		lambda: pieces(base), lambda: polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)), rule, friction=0, steps=12000
	)
	assert len(contacts) == sides
	assert sum(contact.geom.share for contact in contacts) == pytest.approx(1, rel=1e-6)
	one = ConvexHull([(0, 0, 0), *base])
	radius = 3 * one.volume / one.area
	force = 2600 * 9.81 / stiffness
	expected = (force / (2 * one.volume * radius)) ** (1 / 3) if rule == 'perArea' else force / (1.2 * radius) ** 2
	assert depth == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize('pieces', [tip, wedges], ids=['facets', 'wedges'])
def testATipOfManyPieces(pieces):
	"""Of 32: the force is that of one solid, and each piece has the same part of it."""
	forces = []
	for make in (lambda: [polytope.fromVertices([(0, 0, 0), *regular[32]], fixed=True)], lambda: pieces(regular[32])):
		O.reset()
		physics = joints('perArea', 0)
		O.bodies.append(make())
		O.bodies.append(polytope.cuboid((0, 0, 0.499), (0.5, 0.5, 0.5)))
		O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, physics=physics, timeStepper=False)
		O.dt = 1e-9
		O.step()
		contacts = [contact for contact in O.interactions if contact.isReal]
		forces.append(sum((contact.phys.normalForce for contact in contacts), Vector3.Zero).norm())
	assert [contact.geom.share for contact in contacts] == pytest.approx([1 / 32] * 32, rel=0.01)
	assert forces[1] == pytest.approx(forces[0], rel=2e-3)


def slopes(left, right, number):
	"""A ridge of 1 m, solid, or of two wedges, each in *number* / 2 pieces along the ridge."""
	if number == 1:
		return [
			polytope.fromVertices(
				[(s, y, -fall * abs(s)) for y in (-2, 2) for s, fall in ((-1, left), (0, 0), (1, right))]
				+ [(s, y, -3) for y in (-2, 2) for s in (-1, 1)],
				fixed=True,
			)
		]
	pieces, length = [], 8 / number
	for k in range(number // 2):
		ends = (-2 + k * length, -2 + (k + 1) * length)
		for s, fall in ((-1, left), (1, right)):
			pieces.append(polytope.fromVertices([(x, y, z) for y in ends for x, z in ((0, 0), (0, -3), (s, -fall), (s, -3))], fixed=True))
	return pieces


@pytest.mark.parametrize('rule', rules.args[1])
@pytest.mark.parametrize('thickness', [0.01, 0.1, 1])
def testThinTilesCarryAsOnePlate(thickness, rule):
	"""Overlaps of up to half their thickness."""
	soft = 5e6
	depths = []
	for halves in ([(0, 0, 2)], [(x, y, 1) for x in (-1, 1) for y in (-1, 1)]):
		O.reset()
		if rule == 'yadesOwn':
			O.materials.append(FrictMat(density=2600, young=1e7, poisson=0.3, frictionAngle=0.5))
			physics = Ip2_FrictMat_FrictMat_FrictPhys(kn=MatchMaker(algo='val', val=soft), ks=MatchMaker(algo='val', val=soft))
		else:
			O.materials.append(RockJointMat(density=2600, normalStiffness=soft, shearStiffness=soft, frictionAngle=0.5))
			physics = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=rule == 'perArea')
		O.bodies.append([polytope.cuboid((x, y, -thickness / 2), (half, half, thickness / 2), fixed=True) for x, y, half in halves])
		block = O.bodies[O.bodies.append(polytope.cuboid((0.2, 0.1, 0.5), (0.5, 0.5, 0.5)))]
		O.engines = polytope.engines(physics=physics)
		while O.time < 2.5:
			O.run(500, wait=True)
		assert block.state.angVel.norm() < 1e-5
		depths.append(0.5 - block.state.pos[2])
	assert depths == pytest.approx([sunk(2600 * 9.81 / soft, perArea=rule == 'perArea')] * 2, rel=1e-4)


@pytest.mark.parametrize('centre', [-0.1, 0.1])
def testWhatOverhangsABoxOfFacetsIsCarriedByItsTopAlone(centre):
	"""Its side is seen from outside, though the body's centre may be within. What the edges take off the top's pressure is of the order of
	the depth over the width."""

	def box():
		quad = lambda a, b, c, d: [utils.facet((a, b, c)), utils.facet((a, c, d))]
		return quad((-2, -1, 0), (0, -1, 0), (0, 1, 0), (-2, 1, 0)) + quad((0, -1, -1), (0, 1, -1), (0, 1, 0), (0, -1, 0))

	depth, _ = restingDepth(box, lambda: polytope.cuboid((centre, 0, 0.5), (0.5, 0.5, 0.5)), 'perArea', steps=8000)
	assert depth == pytest.approx(2600 * 9.81 / stiffness / (0.5 - centre), rel=3e-3)


# clumps, and supports that are not flush


def tiles(number, width, gap=0.0):
	edge = width / number
	return [
		polytope.cuboid(
			(-width / 2 + edge * (i + 0.5), -width / 2 + edge * (j + 0.5), -0.5), ((edge - gap) / 2, (edge - gap) / 2, 0.5), fixed=True
		)
		for i in range(number)
		for j in range(number)
	]


grounds = {
	'plate': lambda: tiles(1, 0.8),
	'tiles': lambda: tiles(6, 0.8),
	'terrain': lambda: polytope.terrain([[0.0] * 9 for _ in range(9)], spacing=0.1, origin=(-0.43, -0.41)),
	'facets': lambda: [utils.facet(((-1, -1, 0), (1, -1, 0), (1, 1, 0))), utils.facet(((-1, -1, 0), (1, 1, 0), (-1, 1, 0)))],
}


@rules
@pytest.mark.parametrize('ground', grounds)
def testAClumpOfFlushPartsSettlesOnPieces(ground, rule):
	"""Both sides of a contact may be pieces."""
	O.reset()
	physics = joints(rule)
	O.bodies.append(grounds[ground]())
	clump, _ = polytope.clump([polytope.cuboid((x, y, 0.2001), (0.1, 0.1, 0.2)) for x in (-0.1, 0.1) for y in (-0.1, 0.1)])
	O.engines = polytope.engines(physics=physics)
	fastest = 0
	while O.time < 0.4:
		O.run(5, wait=True)
		fastest = max(fastest, O.bodies[clump].state.vel.norm())
	assert 0.03 < fastest < 0.0443  # of a fall of 0.1 mm
	assert O.bodies[clump].state.vel.norm() < 1e-3
	contacts = [contact for contact in O.interactions if contact.isReal]
	force = O.bodies[clump].state.mass * 9.81 / stiffness
	assert sum(contact.phys.normalForce[2] for contact in contacts) == pytest.approx(force * stiffness, rel=1e-6)
	expected = force / 0.4**2 if rule == 'perArea' else force  # one spring
	assert 0.2 - O.bodies[clump].state.pos[2] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize('rule', ['perArea', 'perContact'])
@pytest.mark.parametrize('beyond', [-0.25, 0.02])
def testABlockThatOverhangsAFloorOfPieces(beyond, rule):
	"""The block's centre is before the floor's end or beyond it: the block comes to rest, or falls, as on one piece."""
	found = []
	for edges in ([-3, 0], [-3, -0.25, 0], [-3, -0.3, -0.1, 0]):
		O.reset()
		physics = joints(rule, friction=1)
		O.bodies.append([polytope.cuboid(((a + b) / 2, 0, -0.5), ((b - a) / 2, 2, 0.5), fixed=True) for a, b in zip(edges, edges[1:])])
		block = O.bodies[O.bodies.append(polytope.cuboid((beyond, 0, 0.5), (0.5, 0.5, 0.5)))]
		O.engines = polytope.engines(damping=0.4, physics=physics)
		while O.time < 2:
			O.run(500, wait=True)
		found.append((0.5 - block.state.pos[2], (block.state.ori * Vector3(1, 0, 0))[2]))
		assert (found[-1][0] > 0.1) == (beyond > 0)
	if beyond < 0:
		for other in found[1:]:
			assert other == pytest.approx(found[0], rel=1e-4)


@pytest.mark.parametrize('rule', ['perArea', 'perContact'])
def testCohesionOfABlockOnPiecesIsThatOfItsArea(rule):
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0, cohesion=1e5))
	O.bodies.append(plates(4))
	O.bodies.append(polytope.cuboid((0.1, 0.2, 0.4999), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=rule == 'perArea'), gravity=(0, 0, 0))
	for _ in range(3):
		O.step()
	contacts = [contact for contact in O.interactions if contact.isReal]
	assert len(contacts) == 4
	assert sum(contact.geom.contactArea for contact in contacts) == pytest.approx(1, rel=1e-3)


@pytest.mark.parametrize('gap', [0, 1e-4, 1e-2])
def testASlabOnSupportsThatAreNotFlushIsNotThrown(gap):
	"""Each of 100 supports has a full spring, and all of them begin in one step: no damper may count on the whole slab."""
	O.reset()
	physics = joints('perContact')
	O.bodies.append(tiles(10, 2, gap))
	slab = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0.06), (1, 1, 0.05)))]
	O.engines = polytope.engines(physics=physics)
	fastest = 0
	while O.time < 0.1:
		O.step()
		fastest = max(fastest, slab.state.vel[2])
	assert fastest < 0.5 * math.sqrt(2 * 9.81 * 0.01)


def spike(tip, way):
	"""A tetrahedron whose sharp corner is at *tip* and points that way."""
	back = -Vector3(*way) / Vector3(*way).norm()
	u = back.cross(Vector3(0, 0, 1))
	u /= u.norm()
	base = [Vector3(*tip) + 0.2 * back + 0.05 * (math.cos(turn) * u + math.sin(turn) * back.cross(u)) for turn in (0.3, 2.4, 4.5)]
	return polytope.fromVertices([tip, *map(tuple, base)])


@pytest.mark.parametrize('way', [(1, -1, -1), (0.4, -0.7, -0.6), (0.3, -0.3, -0.9)])
def testNoWallIsLeftOutBehindACornerThatPointsInwards(way):
	"""A tip in the corner of a floor and two walls, one of which ends at the other: where it is behind both, the one covers the other's
	face. The energy is that of the depth: 0.5 of its square for a face, 4 for this tip, some ten where it cuts an edge; 10⁸ and more where
	the wall had no face."""
	for z in (-1e-5, 1e-5, 1e-4, 1e-3):
		for x in (1e-4, 4e-4, 2e-3):
			for y in (-1e-3, -4e-3):
				O.reset()
				physics = joints('perContact', 0)
				floor = polytope.cuboid((0, 0, -0.05), (0.9, 0.9, 0.05), fixed=True)
				wall = polytope.cuboid((0.05, 0, 0.8), (0.05, 0.9, 0.8), fixed=True)
				ending = polytope.cuboid((-0.45, -0.05, 0.8), (0.45, 0.05, 0.8), fixed=True)
				O.bodies.append([floor, wall, ending, spike((x, y, z), way)])
				O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, physics=physics)
				O.dt = 1e-9
				O.step()
				touching = [contact.geom for contact in O.interactions if contact.isReal]
				assert touching
				assert all(geom.energyPerStiffness < 100 * geom.penetrationDepth**2 for geom in touching), (x, y, z)


@pytest.mark.parametrize('model', ['perArea', 'perContact'])
@pytest.mark.parametrize('way', [(-1, 0.3, -1), (-1, 0.2, -0.3), (-0.4, 0.1, -1)])
def testATipThatSlidesOutOfAWallUnderTheFloorDoesTheWorkThatItsEnergyLoses(way, model):
	"""Before it is beyond the wall's face, its overlap with the floor is all below the wall, and the floor's face there is one between two pieces."""
	physics = joints(model, 0)
	floor = polytope.cuboid((0, 0, -0.05), (0.9, 0.9, 0.05), fixed=True)
	wall = polytope.cuboid((-0.05, 0, 0.8), (0.05, 0.9, 0.8), fixed=True)
	tip = O.bodies.append([floor, wall, spike((0, 0, 0), way)])[-1]
	O.engines = [one for one in polytope.engines(gravity=(0, 0, 0), damping=0, physics=physics) if not isinstance(one, PolytopeTimeStepper)]
	O.dt = 1e-12
	start, steps = O.bodies[tip].state.pos, 400
	places = [start + Vector3(-2e-3 + 3e-3 * k / steps, 0, 5e-4 - 1.5e-3 * k / steps) for k in range(steps + 1)]
	work, energies, forces = 0, [], []
	for place in places:
		O.bodies[tip].state.pos, O.bodies[tip].state.vel = place, (0, 0, 0)
		O.step()
		energies.append(polytope.mechanicalEnergy())
		forces.append(O.forces.f(tip))
	for one, other, force, another in zip(places, places[1:], forces, forces[1:], strict=False):
		work += (other - one).dot(force + another) / 2
	assert min(energies) < 0.2 * max(energies)
	assert work == pytest.approx(energies[0] - energies[-1], abs=1e-3 * max(energies))


def energyLeft(model, pieces, tilt, speed, x):
	"""A cube of 1 m falls on a corner, without friction, damping and gravity. Returns the kinetic energy afterwards over that before, and
	how deep the cube sank in [m]."""
	O.reset()
	perArea = model == 'foundation'
	O.materials.append(
		RockJointMat(density=2600, normalStiffness=1e9 if perArea else 1e8, shearStiffness=1e7, frictionAngle=0, stiffnessPerArea=perArea)
	)
	O.bodies.append([polytope.cuboid((x, 0, -2), (4 / pieces, 4, 2), fixed=True) for x in ([0] if pieces == 1 else [-2, 2])])
	cube = polytope.cuboid((x, 0.03, 0), (0.5, 0.5, 0.5), orientation=Quaternion((1, 2, 0.5), tilt), velocity=(0, 0, -speed))
	corners = [cube.state.ori * corner for corner in cube.shape.vertices]
	cube.state.pos = (x, 0.03, 1e-3 - min(corner[2] for corner in corners))
	O.bodies.append(cube)
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')  # it sinks in deeply
		O.engines = [one for one in polytope.engines(damping=0, gravity=(0, 0, 0)) if not isinstance(one, PolytopeTimeStepper)]
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.dt = 0.02 * math.sqrt(cube.state.mass / 1e9)
	before, deepest = utils.kineticEnergy(), 0
	while cube.state.vel[2] < 0 or any(contact.isReal for contact in O.interactions):
		O.step()
		cube = O.bodies[len(O.bodies) - 1]
		deepest = max(deepest, -min((cube.state.pos + cube.state.ori * corner)[2] for corner in cube.shape.vertices))
	return utils.kineticEnergy() / before, deepest


@pytest.mark.parametrize('model', ['foundation', 'spring'])
def testEnergyOfADeepImpactOnASeam(model):
	"""A corner sinks in by 0.04 to 0.17 of the edge, beside the seam or across it: as on one plate. Where such faces count as internal up to a tenth of the
	inscribed radius alone, it leaves sideways, with more energy than it had."""
	for tilt, speed in ((0.3, 5), (0.3, 15), (0.8, 5), (0.8, 15)):
		alone, depth = energyLeft(model, 1, tilt, speed, 0)
		assert alone == pytest.approx(1, abs=1e-4)
		assert 0.03 < depth < 0.175
		for x in (0, 0.03, 0.05):
			left, deepest = energyLeft(model, 2, tilt, speed, x)
			assert left == pytest.approx(1, abs=1e-4)
			assert deepest == pytest.approx(depth, rel=1e-3)


# ------------------------------------------------------------------------------------------------ both bodies made of pieces


def bar(centre, turn, several, half=0.03):
	"""Number of a bar's body and of its parts: one cuboid, or a clump of two cubes."""
	if not several:
		number = O.bodies.append(polytope.cuboid(centre, (2 * half, half, half), turn))
		return number, [number]
	return polytope.clump([polytope.cuboid(centre + turn * Vector3(x, 0, 0), (half,) * 3, turn) for x in (-half, half)])


def forceOfBars(rule, turns, place, parts):
	"""Force on the second of two bars [N], and the number of contacts."""
	O.reset()
	physics = joints(rule, friction=0)
	first, _ = (bar(centre, turn, several)[1] for turn, centre, several in zip(turns, (Vector3.Zero, place), parts, strict=True))
	O.engines = polytope.engines(gravity=(0, 0, 0), physics=physics, timeStepper=False)
	O.dt = 1e-12
	O.step()
	contacts = [contact for contact in O.interactions if contact.isReal]
	assert all({contact.id1 in first, contact.id2 in first} == {True, False} for contact in contacts)
	force = sum((contact.phys.normalForce * (1 if contact.id1 in first else -1) for contact in contacts), Vector3.Zero)
	return force, len(contacts)


@rules
@pytest.mark.parametrize(('along', 'across', 'contacts'), [(0, 0, 4), (0.002, 0, 3), (0.004, 0.003, 3), (0.02, 0, 2), (0, 0.002, 4)])
def testAClumpOnAClumpHasTheForceOfTheSolids(along, across, contacts, rule):
	"""An edge across a face, both with a joint of two parts near the middle."""
	half = 0.03
	turns = Quaternion.Identity, Quaternion((0, 0, 1), 1.2) * Quaternion((1, 0, 0), math.pi / 4)
	place = Vector3(along, across, half + half * math.sqrt(2) - 0.002)
	one, _ = forceOfBars(rule, turns, place, (False, False))
	for parts in (True, False), (False, True), (True, True):
		force, found = forceOfBars(rule, turns, place, parts)
		assert (force - one).norm() < 1e-12 * one.norm()
	assert found == contacts


def collisionOfBars(rule, several):
	"""Motion after one bar has hit the other with an edge across its face, the change of energy over the largest stored, and the most contacts."""
	O.reset()
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0)
	physics = joints(rule, friction=0)
	lying = bar(Vector3.Zero, Quaternion.Identity, several)[0]
	turn = Quaternion((0, 0, 1), 1.2) * Quaternion((0, 1, 0), 0.002) * Quaternion((1, 0, 0), 0.75)
	falling = bar(Vector3(0, 0, 0.0746), turn, several)[0]
	O.bodies[falling].state.vel = Vector3(0.1, 0, -1)
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, physics=physics, law=law, timeStepper=False)
	O.dt = 1e-6
	O.step()
	before, stored, most = polytope.mechanicalEnergy(), 0, 0
	while not most or O.interactions.countReal():
		O.run(5, wait=True)
		contacts = [contact for contact in O.interactions if contact.isReal]
		stored = max(stored, sum(contact.phys.normalForce.norm() * contact.geom.penetrationDepth for contact in contacts) / 2)
		most = max(most, len(contacts))
		assert O.time < 0.1
	motion = [O.bodies[k].state.vel for k in (lying, falling)] + [0.05 * O.bodies[k].state.angVel for k in (lying, falling)]
	return motion, (polytope.mechanicalEnergy() - before) / stored, most


@pytest.mark.parametrize('rule', ['perArea', 'perContact'])
def testBarsOfTwoPartsCollideAsWholeOnes(rule):
	"""With up to four contacts in place of one."""
	whole, gained, one = collisionOfBars(rule, False)
	parts, gainedOfParts, several = collisionOfBars(rule, True)
	assert one == 1 and several >= 3
	assert max((a - b).norm() for a, b in zip(whole, parts, strict=True)) < 1e-6
	assert abs(gained) < 1e-5 and abs(gainedOfParts) < 1e-5


@pytest.mark.parametrize('rule', ['perArea', 'perContact'])
def testAClumpSlidesOverPlates(rule):
	"""It neither hops nor turns where its joint and those of the plates pass each other."""
	O.reset()
	physics = joints(rule, friction=0)
	O.bodies.append([polytope.cuboid((0.25 * k, 0, -0.5), (0.125, 1, 0.5), fixed=True) for k in range(-1, 5)])
	number, _ = bar(Vector3(0, 0, 0.03), Quaternion.Identity, True)
	clump = O.bodies[number]
	sinks = clump.state.mass * 9.81 / stiffness / (0.12 * 0.06 if rule == 'perArea' else 1)
	clump.state.pos = clump.state.pos - Vector3(0, 0, sinks)
	clump.state.vel = Vector3(1, 0, 0)
	O.engines = polytope.engines(damping=0, physics=physics, law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0))
	moved = 0
	while clump.state.pos[0] < 0.8:
		O.run(5, wait=True)
		moved = max(moved, abs(clump.state.pos[2] + sinks - 0.03), 0.05 * clump.state.angVel.norm() * O.dt)
	assert moved < 0.05 * sinks
	assert clump.state.vel[0] == pytest.approx(1, abs=2e-5)
	assert clump.state.angVel.norm() < 1e-3
