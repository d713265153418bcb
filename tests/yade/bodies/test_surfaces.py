# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies on floors made of flush pieces behave as on one smooth floor; real steps, gaps and ends stay what they are.

Quick form of `./run accuracy --only surfaces`, with its limits, for the default contact.
"""

import math
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest
from scenes import gravity, joint, loop
from surfaceStudy.edges import drop, edgeCarries, gapHolds, onStep, pressedPast, restOverEnd, roll
from surfaceStudy.flatBodies import bodyKinds, lyingBody
from surfaceStudy.floors import Floor, floorKinds
from surfaceStudy.measures import cross, rest, slideDown, stop
from surfaceStudy.surface import SurfaceScene
from yade import Bo1_Polytope_Aabb, O, PolytopeCollider, Quaternion, RockJointMat, Vector3, polytope

folder = pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'
sys.path.append(str(folder))

import surfaceTables
from boon2012.reporting.findings import Findings
from surfaceTables import braking, rolling, sliding

rules = pytest.mark.parametrize('perArea', [False, True], ids=['perContact', 'perArea'])


def keeps(crossing):
	print(crossing)
	assert crossing.failures == 0
	assert crossing.kept == pytest.approx(1, abs=sliding)
	assert abs(crossing.direction) < sliding
	assert crossing.spin < sliding


# without friction


@rules
@pytest.mark.parametrize('floor, body', [('slab', 'cube'), ('wall', 'box'), ('slab', 'icosahedron'), ('slab', 'square')])
def testSlidesOnOnePiece(floor, body, perArea):
	keeps(cross(floor, body, perArea=perArea))


@rules
@pytest.mark.parametrize('floor', ['plates', 'oblique', 'boxes', 'facets', 'mesh', 'bricks', 'rock'])
def testSlidesOverFlushPieces(floor, perArea):
	keeps(cross(floor, 'cube', perArea=perArea))


@rules
@pytest.mark.parametrize('body', ['box', 'tetrahedron', 'dodecahedron', 'icosahedron', 'hull'])
def testBodiesSlideOverPlates(body, perArea):
	keeps(cross('plates', body, perArea=perArea))


surfaceRows = [
	*((floor, 'cube', 0) for floor in ('plates', 'oblique', 'boxes', 'facets', 'bricks', 'rock')),
	*(('plates', body, 0) for body in ('box', 'tetrahedron', 'dodecahedron', 'icosahedron', 'hull', 'square')),
	*((floor, body, tilt) for floor in ('plates', 'facets', 'rock') for body, tilt in (('cube', 5), ('cube', 45), ('hull', 10))),
	('oblique', 'icosahedron', 20),
	('mesh', 'dodecahedron', 0),
]


@rules
@pytest.mark.parametrize('floor, body, tilt', surfaceRows)
def testTheContactSurfaceSlidesOverPieces(floor, body, tilt, perArea):
	"""It slides on faces, edges and vertices; among the rows are some that the default misses."""
	held = {'tilt': Quaternion(Vector3(0, 1, 0), math.radians(tilt)), 'held': True} if tilt else {}
	keeps(cross(floor, body, {'contactModel': 'surface'}, perArea, **held))


@rules
@pytest.mark.parametrize('floor', ['plates', 'oblique', 'facets', 'rock'])
@pytest.mark.parametrize('body, tilt', [('cube', 5), ('cube', 15), ('cube', 45), ('icosahedron', 20), ('hull', 10)])
def testBodiesHeldOnAnEdgeOrAVertexSlideOverPieces(floor, body, tilt, perArea):
	"""They lost speed at each joint when only faces were seen to slide."""
	keeps(cross(floor, body, perArea=perArea, tilt=Quaternion(Vector3(0, 1, 0), math.radians(tilt)), held=True))


@rules
@pytest.mark.parametrize('floor', ['plates', 'facets'])
def testFacesThatAreNotQuiteLevelSlideOverPieces(floor, perArea):
	"""Held at 2°: a long wedge, whose normal leans before the end of a piece while the collider does not yet know the next one."""
	crossing = cross(floor, 'cube', perArea=perArea, tilt=Quaternion(Vector3(0, 1, 0), math.radians(2)), held=True)
	assert crossing.failures == 0
	assert crossing.kept == pytest.approx(1, abs=2 * sliding)
	assert abs(crossing.direction) < sliding


@rules
@pytest.mark.parametrize('floor', ['plates', 'oblique', 'bricks', 'rock', 'overlapping'])
@pytest.mark.parametrize('body, tilt', [('cube', 0), ('icosahedron', 0), ('cube', 45)])
def testSlidesOverTheSeamsBetweenThePartsOfAClump(floor, body, tilt, perArea):
	"""Made by polytope.clump; a body on a face, or held on an edge."""
	tilted = {'tilt': Quaternion(Vector3(0, 1, 0), math.radians(tilt)), 'held': True} if tilt else {}
	keeps(cross(floor, body, perArea=perArea, clumped=True, **tilted))


@rules
@pytest.mark.parametrize('floor, body', [('plates', 'square'), ('oblique', 'polygon')])
def testPolygonsSlideOverPolygons(floor, body, perArea):
	keeps(cross(floor, body, perArea=perArea))


@rules
@pytest.mark.parametrize('edge', ['front', 'back'])
@pytest.mark.parametrize('speed, behind', [(1e-3, 0.005), (1e-2, 0.02), (0.1, 0.08)])
def testSlidesSlowly(speed, behind, edge, perArea):
	keeps(cross('plates', 'cube', perArea=perArea, speed=speed, seams=1, edge=edge, behind=behind))


@rules
@pytest.mark.parametrize('floor', ['wall', pytest.param('slab')])
def testSlidesSlowlyOnOnePiece(floor, perArea):
	keeps(cross(floor, 'cube', perArea=perArea, speed=1e-3, seams=1, edge='front', behind=0.005))


@rules
def testSlidesFast(perArea):
	keeps(cross('plates', 'cube', perArea=perArea, speed=10))


@rules
@pytest.mark.parametrize('angle', [20, 45, 80])
def testSlidesOverJointsAtAnAngle(angle, perArea):
	keeps(cross('plates', 'cube', perArea=perArea, spacing=0.5, angle=angle))


@rules
@pytest.mark.parametrize('seams, spacing', [(1, 1.0), (10, 0.2), (100, 0.1)])
def testSlidesOverManyJoints(seams, spacing, perArea):
	keeps(cross('plates', 'cube', perArea=perArea, seams=seams, spacing=spacing))


@rules
def testSlidesWithEverythingTurned(perArea):
	keeps(cross('plates', 'cube', perArea=perArea, turn=Quaternion((1, 2, 3), 0.8)))


def testSphereForComparison():
	"""On polytopes that lie flush it touches their union: nothing brakes or lifts it."""
	assert cross('slab', 'sphere').kept == pytest.approx(1, abs=1e-9)
	assert cross('plates', 'sphere').kept == pytest.approx(1, abs=1e-6)


# over free pieces


def slideOverPieces(pieces, perArea=True, seconds=1.9, order=1, verletDist=None, stiffness=1e8):
	"""A cube of 0.5 m slides without friction at 1 m/s over *pieces(sunk)*, which lie on a rough floor, from x = 0. The order of the bodies
	is reversed where *order* is -1.

	:returns: speed lost, its place
	"""
	O.reset()
	for label, friction in (('smooth', 0), ('rough', 1)):
		O.materials.append(
			RockJointMat(
				density=2600,
				normalStiffness=stiffness,
				shearStiffness=stiffness,
				frictionAngle=friction,
				stiffnessPerArea=perArea,
				label=label,
			)
		)
	sunk = 2600 * gravity / stiffness
	floor = polytope.cuboid((0, 0, -1.5), (6, 2, 0.5), fixed=True, material='rough')
	cube = polytope.cuboid((0, 0.05, 0.25 - 1.5 * sunk), (0.25, 0.25, 0.25), material='smooth', velocity=(1, 0, 0))
	O.bodies.append([floor, *pieces(sunk), cube][::order])
	O.engines = polytope.engines(damping=0, collider=verletDist and PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=verletDist))
	while O.time < seconds:
		O.step()
	return 1 - float(cube.state.vel[0]), np.array(cube.state.pos, float)


def slabs(higher=0.0, fixed=False):
	"""Two slabs of 2 m, the second one higher by so many depths of the cube."""

	def made(sunk):
		yield polytope.cuboid((0, 0, -0.5 - sunk), (1, 1, 0.5), material='rough', fixed=fixed)
		half = 0.5 + higher * sunk / 4
		yield polytope.cuboid((2, 0, -1 - sunk + half), (1, 1, half), material='rough', fixed=fixed)

	return made


def testSlidesOverTheJointOfTwoFreeSlabs():
	"""Per area no speed is lost. Per contact it lies on two springs at the joint, and the slab that it leaves has sunk under it."""
	lost, _ = slideOverPieces(slabs())
	assert abs(lost) < 1e-4
	lost, _ = slideOverPieces(slabs(), perArea=False)
	assert 1e-3 < lost < 1e-2


def testTheOrderOfBodiesAndTheVerletDistanceDoNotMatterOnFreeSlabs():
	lost, place = slideOverPieces(slabs())
	for changed in ({'order': -1}, {'verletDist': 1e-3}, {'verletDist': 0.1}):
		other, where = slideOverPieces(slabs(), **changed)
		assert abs(other - lost) < 1e-9 and np.abs(where - place).max() < 1e-9


@pytest.mark.parametrize('fixed', [False, True])
@pytest.mark.parametrize('height', [0.05, 0.1, 1])
def testAStairOfSlabsSlowsDownByItsHeight(height, fixed):
	"""A twentieth of the depth is a step, too: v² changes by 2 g h, and the cube comes to lie higher by h. What the joint itself takes, by which the
	cube goes down and up again, it takes both ways."""
	(up, above), (down, below) = (slideOverPieces(slabs(sign * height, fixed)) for sign in (1, -1))
	height *= 0.5 * 2600 * gravity / 1e8
	assert up - down == pytest.approx(math.sqrt(1 + 2 * gravity * height) - math.sqrt(1 - 2 * gravity * height), rel=0.02)
	assert above[2] - below[2] == pytest.approx(2 * height, rel=1e-3)
	assert 0 < (up + down) / 2 < 1e-4


@pytest.mark.parametrize('perArea, stiffness, height', [(True, 2.5e6, 0.02), (False, 6.4e5, 0.02 / 4)])
def testAStepOfAFiftiethOfTheDepthChangesNoSpeed(perArea, stiffness, height):
	"""Up or down: the step counts as none also while no more than a sliver of the cube is left on the slab behind, or has come onto the next one. It lies
	5 mm deep, so that it is a sliver for some steps."""
	for sign in (1, -1):
		lost, _ = slideOverPieces(slabs(sign * height, fixed=True), perArea=perArea, stiffness=stiffness)
		assert abs(lost) < 1e-6


def testSlidesOverFreeBlocksOfOneRock():
	"""Eight blocks between two sets of joints, four of which it crosses."""

	def rock(sunk):
		sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
		sets = [polytope.JointSet(math.pi / 2, direction, spacing) for direction, spacing in ((math.pi / 2, 1), (0, 1.1))]
		mass = polytope.jointedRock(sides, [3.2, 0.8, 1, 1, -sunk, 1 + sunk], sets)
		return [polytope.fromHalfSpaces(*block, material='rough') for block in mass.blocks]

	lost, _ = slideOverPieces(rock, seconds=2.4)
	assert len(O.bodies) == 10
	assert abs(lost) < 1e-3


# with friction


@pytest.mark.parametrize(
	'floor, body, perArea',
	[
		('slab', 'cube', False),
		('slab', 'cube', True),
		('slab', 'square', True),
		*(pytest.param(f, b, r) for f, b in (('plates', 'cube'), ('facets', 'cube'), ('plates', 'square')) for r in (False, True)),
	],
)
def testStopsWhereFrictionSays(floor, body, perArea):
	way = stop(floor, body, perArea=perArea)
	print(way)
	assert way.distance == pytest.approx(1, abs=braking) and abs(way.direction) < braking


@pytest.mark.parametrize(
	'floor, body, perArea',
	[
		('slab', 'cube', True),
		pytest.param('slab', 'cube', False),
		*(pytest.param(f, 'dodecahedron', r) for f in ('slab', 'plates', 'facets') for r in (False, True)),
		*(pytest.param(f, 'cube', r) for f in ('plates', 'facets') for r in (False, True)),
	],
)
def testAcceleratesOnAnIncline(floor, body, perArea):
	way = slideDown(floor, body, perArea=perArea)
	print(way)
	assert way.distance == pytest.approx(1, abs=braking) and abs(way.direction) < braking


# at rest, and what must stay


@pytest.mark.parametrize('perArea', [pytest.param(False, id='perContact'), pytest.param(True, id='perArea')])
@pytest.mark.parametrize('floor, body', [('plates', 'cube'), ('facets', 'cube'), ('plates', 'icosahedron'), ('plates', 'square')])
def testSinksAcrossAJointAsOnOnePiece(floor, body, perArea):
	found = rest(floor, body, perArea=perArea)
	print(found)
	assert found.contacts >= 2 and found.creep < 1e-6
	assert found.depth == pytest.approx(1, abs=0.01) and found.tilt < 1e-3


@rules
def testAStepStopsOrLifts(perArea):
	for speed in (0.1, 1.0):
		past, lowest, _ = onStep(perArea=perArea, speed=speed)
		assert past < (min(pressedPast(speed), 0.05) if perArea else 1e-3) or lowest > 1e-3  # of 2 mm


def testAStepIsSeenAtAll():
	"""Without a step nothing stops the body and nothing lifts it."""
	past, lowest, _ = onStep(perArea=True, height=0.0)
	assert past > 0.05 and abs(lowest) < 3e-4


@rules
def testAGapIsAGapAndAnEndCarries(perArea):
	wide, narrow = gapHolds(perArea=perArea)
	assert abs(wide) < 1e-3 and narrow == pytest.approx(0.046, abs=1e-3)  # ½ g t² less a little damping
	assert edgeCarries(perArea=perArea, over=-0.2) > 1e-2
	if not perArea:
		assert edgeCarries(perArea=perArea, over=0.2) < 1e-3


def testAFaceOverAnEndRestsOnAWedgeOfPressure():
	assert edgeCarries(perArea=True, over=0.3, time=6) == pytest.approx(restOverEnd(over=0.3), rel=0.01)


@pytest.mark.parametrize('tilt', [0, pytest.param(5), pytest.param(20), 45])
@rules
def testAFrictionlessFloorPushesUpAlone(tilt, perArea):
	for floor in ('slab', 'plates'):
		assert drop(floor, perArea=perArea, tilt=tilt).sideways < sliding


@rules
@pytest.mark.parametrize('tilt', [0, 45])
def testReboundsFromAJointAsFromOnePiece(tilt, perArea):
	slab, plates = (drop(floor, perArea=perArea, tilt=tilt) for floor in ('slab', 'plates'))
	assert plates.rebound == pytest.approx(slab.rebound, abs=0.02)


@rules
def testADodecahedronRollsAsOnOnePiece(perArea):
	slab, plates = (roll(floor, perArea=perArea) for floor in ('slab', 'plates'))
	assert slab[-1] > 0.9
	assert plates == pytest.approx(slab, abs=rolling * slab[-1])


# what the scenes are made of


@pytest.mark.parametrize('kind', [kind for kind in floorKinds if kind not in ('wall', 'overlapping')])
def testPiecesAreFlushAndFillTheFloor(kind):
	floor = Floor(3, 0.7, before=1.4, after=1.2, side=(-1.0, 1.3))
	pieces = floor.pieces(kind)
	O.bodies.append(pieces)
	low, high = floor.ends
	assert len(pieces) > 1 or kind in ('slab', 'polygon')
	planar = pieces[0].state.pos[1] < 0 and kind.lower().endswith(('polygon', 'polygons'))
	volume = area = 0
	for piece in pieces:
		if kind == 'boxes':
			assert piece.state.pos[2] + piece.shape.extents[2] == pytest.approx(0, abs=1e-12)
			volume += 8 * math.prod(piece.shape.extents)
			continue
		corners = np.array([piece.state.pos + piece.state.ori * v for v in piece.shape.vertices], float)
		top = corners[:, 1 if planar else 2].max()
		assert top == pytest.approx(0, abs=1e-9) or kind == 'rock' and top < 0  # some blocks do not reach the surface
		if kind in ('facets', 'mesh'):
			area += np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0])) / 2
		else:
			volume += piece.shape.volume
	whole = (high - low) * (1 if planar else 2.3)
	assert area + volume / floor.thickness == pytest.approx(whole, rel=1e-9)
	assert not any(piece.dynamic for piece in pieces)


def testFloorsSayWhatTheyCannot():
	with pytest.raises(ValueError, match='kind'):
		Floor().pieces('carpet')
	with pytest.raises(ValueError, match='gaps'):
		Floor(gap=0.1).pieces('facets')
	with pytest.raises(ValueError, match='kind'):
		lyingBody('horse')


@pytest.mark.parametrize('kind', [kind for kind in bodyKinds if kind != 'sphere'])
def testBodiesLieOnAFace(kind):
	scene = SurfaceScene('polygon' if kind in ('square', 'polygon') else 'slab', kind, perArea=True).build()
	corners = scene.corners()
	assert corners[:, 2].min() == pytest.approx(-scene.depth, abs=1e-12)
	assert (corners[:, 2] < -scene.depth + 1e-9).sum() >= (2 if scene.planar else 3)
	assert scene.lying.area > 0
	scene.settle(300)
	assert scene.failures == 0
	(contact,) = (contact for contact in O.interactions if contact.isReal)
	assert contact.phys.normalForce.norm() == pytest.approx(scene.mass * scene.gravity, rel=1e-3)
	aside = (contact.geom.contactPoint - scene.moving.state.pos).cross(Vector3(*scene.up)).norm()
	assert aside < 1e-4 and scene.leaning < 1e-2
	if kind != 'hull':  # it lifts off on one side
		assert scene.lying.height - scene.position[2] == pytest.approx(foundationDepth(scene, corners), rel=0.01)


def foundationDepth(scene, corners):
	"""Depth of the centroid of a body that lies on a face, on springs spread over that face: the mean depth times 1 + e·r⁻²·e, where e is
	its place from the middle of the face, and r² are the squares of the face's radii of gyration."""
	low = corners[corners[:, 2] < -scene.depth + 1e-9]
	if scene.planar:
		ends = low[:, 0].min(), low[:, 0].max()
		return scene.depth * (1 + 12 * ((scene.position[0] - sum(ends) / 2) / (ends[1] - ends[0])) ** 2)
	face = low[:, :2] - low[:, :2].mean(axis=0)
	face = face[np.argsort(np.arctan2(face[:, 1], face[:, 0]))]
	area, first, second = 0, np.zeros(2), np.zeros((2, 2))
	for p, q in zip(face, np.roll(face, -1, axis=0), strict=True):
		twice = p[0] * q[1] - p[1] * q[0]
		area += twice / 2
		first += twice * (p + q) / 6
		second += twice / 24 * (np.outer(p, p) + np.outer(q, q) + np.outer(p + q, p + q))
	middle = first / area
	off = scene.position[:2] - low[:, :2].mean(axis=0) - middle
	return scene.depth * (1 + off @ np.linalg.solve(second / area - np.outer(middle, middle), off))


def testMissedLimitsAreReported(tmp_path):
	findings = Findings('', 'limits', tmp_path)
	study = surfaceTables.SurfaceStudy(findings, True)
	for error, good in ((1e-3, True), (-1e-3, True), (-3e-3, False), (math.nan, False)):
		study.worst('error', [('surface', 'per area', 0.0), ('surface', 'per area', error), ('boon2012', 'per area', 1.0)], sliding)
		default, other = findings.content['rows'][-2:]
		assert default['good'] is good and other['good'] is None


def testOneCrossingInOneLine():
	done = subprocess.run(
		[sys.executable, folder / 'surfaces.py', '--floor', 'plates', '--per-area', '--contact', 'contactModel=surface'],
		capture_output=True,
		text=True,
		timeout=300,
	)
	assert done.returncode == 0, done.stderr
	assert float(re.search(r'per area: kept ([\d.]+)', done.stdout)[1]) == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize('clumped', [(), (1, 3), (0, 1, 2, 3)], ids=['bodies', 'alternating', 'clumps'])
def testFixedClumpsAndFixedBodiesAreOneSupport(clumped):
	"""A body on four pieces, of which some are fixed clumps of two, sinks in as on one: W/k."""
	O.reset()
	joint(normalStiffness=1e8, frictionAngle=0)
	loop(False, normalDamping=0.5, gravity=(0, 0, -gravity))
	for k in range(4):
		if k in clumped:
			clump, _ = O.bodies.appendClumped([polytope.cuboid((0.25 * k, y, -0.15), (0.125, 0.5, 0.15)) for y in (-0.5, 0.5)])
			O.bodies[clump].dynamic = False
		else:
			O.bodies.append(polytope.cuboid((0.25 * k, 0, -0.15), (0.125, 1, 0.15), fixed=True))
	body = polytope.cuboid((0.3, 0.1, 0.1), (0.2, 0.15, 0.1))
	O.bodies.append(body)
	O.dt = 1e-4
	for _ in range(6000):
		O.step()
	sunk = body.state.mass * gravity / 1e8  # but for the rim: faces of edges a, b push with k (h − (1/a + 1/b) h²/2)
	assert 0.1 - body.state.pos[2] == pytest.approx(sunk * (1 + sunk * (1 / 0.4 + 1 / 0.3) / 2), rel=1e-6)
