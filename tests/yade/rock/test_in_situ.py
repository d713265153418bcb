# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.inSitu: the stress of each block is what was asked for, and the mass stays at rest."""

import math

import numpy as np
import pytest
from yade import Box, HyperbolicClosure, Ip2_RockJointMat_RockJointMat_RockJointPhys, MatchMaker, O, RockJointMat, Vector3, polytope, utils
from yade.polytope.rest.unbalanced import unbalancedForce
from yade.polytope.rock.commonFaces import commonFaces
from yade.polytope.rock.stress.field import StressField

weight = 2600 * 9.81
general = -1e6 * np.array([[4, 1, 0.5], [1, 5, 0.3], [0.5, 0.3, 6]])
k0 = weight * np.diag((0.6, 0.8, 1))
sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
upwards = np.zeros((3, 3, 3))
upwards[2] = k0


def material(**joint):
	joint = {'density': 2600, 'normalStiffness': 2e10, 'shearStiffness': 1e10, 'frictionAngle': math.radians(30), **joint}
	O.materials.append(RockJointMat(**joint))


def around(low, high, without=(), thick=0.5):
	"""Fixed plates on the sides of a box that touch it and not each other; but for sides of these numbers."""
	for k in range(6):
		axis, upper = k // 2, k % 2 == 0
		a, b = np.array(low, float), np.array(high, float)
		a[axis + 1 :] -= thick
		b[axis + 1 :] += thick
		a[axis], b[axis] = (high[axis], high[axis] + thick) if upper else (low[axis] - thick, low[axis])
		if k not in without:
			O.bodies.append(polytope.cuboid((a + b) / 2, (b - a) / 2, fixed=True))


def cuboid(low, high, **body):
	low, high = np.array(low, float), np.array(high, float)
	return O.bodies.append(polytope.cuboid((low + high) / 2, (high - low) / 2, **body))


def masonry(n=3, runningBond=True, without=()):
	"""Cubes of 1 m in courses, every other one shifted by half."""
	for k in range(n):
		cuts = [0, *np.arange(0.5, n), n] if runningBond and k % 2 else range(n + 1)
		for low, high in zip(cuts, cuts[1:], strict=False):
			for j in range(n):
				cuboid((low, j, k), (high, j + 1, k + 1))
	around((0, 0, 0), (n, n, n), without)
	O.engines = polytope.engines(gravity=(0, 0, 0))


def rock(gravity=0, without=(), **joint):
	"""A cube of 4 m cut by three oblique sets, its top at z = 0."""
	material(**joint)
	joints = [(50, 80, 1.3), (70, 200, 1.5), (20, 310, 1.6)]
	sets = [polytope.JointSet(math.radians(dip), math.radians(direction), spacing) for dip, direction, spacing in joints]
	polytope.jointedRock(sides, [4, 0, 4, 0, 0, 4], sets).append()
	around((0, 0, -4), (4, 4, 0), without)
	O.engines = polytope.engines(gravity=(0, 0, -gravity))


def error(field):
	"""Error of the stress in the block that is farthest off, over the largest component of the stress asked for."""
	worst = 0
	for k, found in polytope.bodyStress().items():
		asked = field.at(O.bodies[k].state.pos)
		worst = max(worst, np.abs(found - asked).max() / np.abs(asked).max())
	return worst


def staysAtRest(field, within=0.01, steps=500):
	"""The stress is there without a step, hardly anything moves in settling, and then it is there, too."""
	assert O.iter == 0 and O.time == 0
	assert error(field) < within and unbalancedForce() < 0.01
	places = {body.id: Vector3(body.state.pos) for body in O.bodies}
	assert polytope.settle(unbalanced=1e-6, elastic=False) <= steps
	assert error(field) < within
	assert not any(contact.phys.isSliding for contact in O.interactions if contact.isReal and contact.phys.contactArea > 0.01)
	stiffness = float(O.materials[0].normalStiffness)
	closure = max(np.abs(field.at(body.state.pos)).max() for body in O.bodies) / stiffness
	assert max((body.state.pos - places[body.id]).norm() for body in O.bodies) < 0.01 * closure
	return True


@pytest.mark.parametrize('runningBond', [False, True])
@pytest.mark.parametrize('stress', [np.diag((-4e6, -5e6, -6e6)), general, -5e6 * np.eye(3)])
def testMasonry(stress, runningBond):
	material()
	masonry(runningBond=runningBond)
	assert polytope.inSitu(stress) == (133 if runningBond else 108)
	assert staysAtRest(StressField(stress), 0.002)


def testTheErrorIsAboutThreeTimesTheClosureOverTheWidth():
	"""0.6 % of 1 m; it is warned of."""
	material(normalStiffness=1e9, shearStiffness=1e9)
	masonry()
	with pytest.warns(UserWarning, match='of 30 of 30 blocks is off by more than 1 % .*stiffer joints'):
		polytope.inSitu(np.diag((-4e6, -5e6, -6e6)))
	assert 0.01 < error(StressField(np.diag((-4e6, -5e6, -6e6)))) < 3 * 0.006


def testBlocksOfTwoMaterials():
	"""The blocks have the materials in turns; each has the closure of its own."""
	material(label='hard', normalStiffness=4e10)
	material(label='soft', normalStiffness=1e10)
	for i, j, k in np.ndindex(3, 3, 3):
		O.bodies.append(polytope.cuboid((i + 0.5, j + 0.5, k + 0.5), (0.5, 0.5, 0.5), material=('hard', 'soft')[(i + j + k) % 2]))
	around((0, 0, 0), (3, 3, 3))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(general)
	assert staysAtRest(StressField(general), 0.002)


def testPlanesWithoutAFaceStayWhereTheyAre():
	"""One such plane is before the face's own among the planes, one behind it."""
	material()
	far, near = [(1, 0, 0), (0, 1, 0)], [1.3, 1.2]
	O.bodies.append(polytope.fromHalfSpaces([far[0], *sides, far[1]], [near[0], 1, 0, 1, 0, 1, 0, near[1]]))
	assert len(O.bodies[0].shape.normals) == 8
	for low in ((1, 0, 0), (0, 1, 0), (1, 1, 0)):
		cuboid(low, np.add(low, 1))
	around((0, 0, 0), (2, 2, 1))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(general)
	assert staysAtRest(StressField(general), 0.002)


def testObliqueJoints():
	"""There are thin blocks, too; the joints close by 0.03 mm."""
	rock(normalStiffness=2e11, shearStiffness=1e11)
	assert min(float(body.shape.inscribedRadius) for body in O.bodies) < 0.04
	polytope.inSitu(general)
	assert staysAtRest(StressField(general), steps=1000)


@pytest.mark.parametrize('without', [(), (4,)])
def testGravityWithK0(without):
	"""There are scenes with a plate on the ground's surface, which bears nothing, and without it."""
	rock(gravity=9.81, without=without)
	polytope.inSitu(np.zeros((3, 3)), upwards)
	assert staysAtRest(StressField(np.zeros((3, 3)), upwards), steps=1000)


def testBlocksAtTheRegionsBoundaryMayBeTheFixedOnes():
	"""No plates; of the region, an octahedron, whose sides are no box."""
	material(normalStiffness=2e11)
	octahedron = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
	joints = [(50, 80, 1.1), (70, 200, 1.2), (20, 310, 1.1)]
	sets = [polytope.JointSet(math.radians(dip), math.radians(direction), spacing) for dip, direction, spacing in joints]
	mass = polytope.jointedRock(octahedron, [4] * 8, sets)
	for k, made in zip(mass.append(), mass.faces, strict=True):
		if (made < 0).any():  # a face of the region
			O.bodies[k].dynamic = False
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(general)
	assert len(polytope.bodyStress()) > 4 and error(StressField(general)) < 0.001
	assert polytope.settle(elastic=False) <= 500 and error(StressField(general)) < 0.001


def testFlushPiecesOfASupportStayFlush():
	"""A piece that blocks meet along an edge alone moves with its neighbours' faces: a step as high as the contact is deep would come and
	go, and thin blocks beside it would never rest."""
	material()
	for x in (0, 1):
		cuboid((x, 0, 0), (x + 1, 1, 1), fixed=x == 1)
		cuboid((x, 0, -1), (x + 1, 1, 0), fixed=True)
	around((0, 0, 0), (1, 1, 1), without=(0, 5))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(general)
	tops = [float(O.bodies[k].state.pos[2]) + max(float(vertex[2]) for vertex in O.bodies[k].shape.vertices) for k in (1, 3)]
	assert tops[0] == pytest.approx(tops[1], abs=1e-12) and tops[0] == pytest.approx(6e6 / 4e10, rel=1e-6)
	assert staysAtRest(StressField(general), 0.002)


def testThinBlocksBesideFixedOnesComeToRest():
	"""Joints at random distances, blocks at the boundary are the fixed ones, the top is free."""
	material(frictionAngle=math.radians(40))
	random = np.random.default_rng(1)
	joints = [
		polytope.JointSet(
			math.radians(dip + random.uniform(-10, 10)), math.radians(direction + random.uniform(-30, 30)), spacing, exponential=True
		)
		for dip, direction, spacing in [(50, 80, 1.3), (70, 200, 1.5), (20, 310, 1.6)]
	]
	mass = polytope.jointedRock(sides, [5, 0, 5, 0, 0, 5], joints, seed=1, smallest=0.02)
	for k, (normals, _), made in zip(mass.append(), mass.blocks, mass.faces, strict=True):
		O.bodies[k].dynamic = not any(joint < 0 and normal[2] < 0.99 for joint, normal in zip(made, normals, strict=True))
	O.engines = polytope.engines()
	polytope.inSitu(np.zeros((3, 3)), upwards)
	assert polytope.settle(elastic=False) <= 300


def testShearThatChangesInSpaceTurnsFacesAboutTheirNormals():
	"""σ_xy = a z: a face with the normal x and sides b has the moment a b⁴/12 on body 2."""
	material()
	masonry(2, runningBond=False)
	slope = np.zeros((3, 3, 3))
	slope[2, 0, 1] = slope[2, 1, 0] = 1e5
	polytope.inSitu(-5e6 * np.eye(3), slope)
	between = O.interactions[0, 2]
	assert between.geom.normal == pytest.approx((1, 0, 0), abs=1e-12)
	assert between.phys.twistingMoment == pytest.approx(1e5 / 12, rel=1e-3)
	assert between.phys.shearForce == pytest.approx((0, -0.5e5, 0), rel=1e-3, abs=1)
	torque = max(O.forces.t(body.id).norm() for body in O.bodies if body.dynamic)
	assert torque < 0.01 * 1e5 / 12
	O.step()
	assert between.phys.twistingMoment == pytest.approx(1e5 / 12, rel=1e-3)  # the law goes on from it
	assert staysAtRestAfter(StressField(-5e6 * np.eye(3), slope))


def staysAtRestAfter(field):
	return polytope.settle(unbalanced=1e-6, elastic=False) <= 500 and error(field) < 0.002


@pytest.mark.parametrize(
	'strength',
	[
		{'cohesion': 1e6, 'tensileStrength': 1e6},
		{'tensileStrength': 1e6, 'residualTensileStrength': 5e5},
		{'tensileStrength': 1e6},
		{'cohesion': 1e6},
	],
)
def testJointsKeepTheirStrength(strength):
	material(residualFrictionAngle=math.radians(20), **strength)
	masonry()
	polytope.inSitu(general)
	for name in ('tensileStrength', 'residualTensileStrength'):
		assert getattr(O.materials[0], name) == strength.get(name, 0)
		assert all(getattr(O.interactions[face].phys, name) == strength.get(name, 0) for face in commonFacesBefore)
	assert staysAtRest(StressField(general), 0.002)
	for face in commonFacesBefore:
		phys = O.interactions[face].phys
		assert phys.intact and phys.tensileStrength == strength.get('tensileStrength', 0) and phys.cohesion == strength.get('cohesion', 0)
		assert (phys.bond is not None) == ('tensileStrength' in strength)


commonFacesBefore = [(0, 3), (0, 1)]


@pytest.mark.parametrize('gravity', [0, 9.81])
def testPolygons(gravity):
	"""Rhombs in rows, of a thickness of 0.5 m, y upwards, with the surface at y = 4 and a load of 0.1 MPa there."""
	material(normalStiffness=1e10)
	for i in range(4):
		for j in range(4):
			x, y = i + 0.3 * j, j
			O.bodies.append(polytope.polygon([(x, y), (x + 1, y), (x + 1.3, y + 1), (x + 0.3, y + 1)], thickness=0.5))
	for outline in (
		[(-1, -1), (6, -1), (6, 0), (-1, 0)],
		[(-1, 4), (6, 4), (6, 5), (-1, 5)],
		[(-1, 0), (0, 0), (1.2, 4), (-1, 4)],
		[(4, 0), (6, 0), (6, 4), (5.2, 4)],
	):
		O.bodies.append(polytope.polygon(outline, thickness=0.5, fixed=True))
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	slope = np.zeros((3, 3, 3))
	slope[1] = 2600 * gravity * np.diag((0.6, 1, 0))
	stress = -4 * slope[1] - 1e5 * np.diag((0.8, 1, 0))
	assert polytope.inSitu(stress, slope) == 40
	field = StressField(stress, slope)
	assert unbalancedForce() < 1e-3
	assert polytope.settle(elastic=False) <= 300
	for k, found in polytope.bodyStress().items():
		assert np.abs(found - field.at(O.bodies[k].state.pos))[:2, :2].max() < 0.002 * 1e5


def testBlocksWeighWhatTheyWeighed():
	material()
	masonry()
	before = [(body.state.mass, body.state.refPos, Vector3(body.shape.color), body.shape.volume) for body in O.bodies]
	polytope.inSitu(general)
	for body, (mass, place, colour, volume) in zip(O.bodies, before, strict=True):
		assert body.state.mass == mass and body.shape.color == colour and body.shape.volume > volume
		assert (body.state.pos - place).norm() < 1e-3 and body.state.refPos == body.state.pos
	moment = O.bodies[0].state.inertia[0] / O.bodies[0].state.mass
	assert moment == pytest.approx(1 / 6, rel=1e-3)


def testSavedAndLoaded(tmp_path):
	material()
	masonry(2)
	polytope.inSitu(general)
	O.save(str(tmp_path / 'stressed.yade'))
	O.load(str(tmp_path / 'stressed.yade'))
	O.run(100, wait=True)
	assert error(StressField(general)) < 0.002


def uniform(x):
	return -x * np.eye(3)


@pytest.mark.parametrize(
	'stress, gradient, message',
	[
		(np.array([[-4, 1, 0], [2, -5, 0], [0, 0, -6]]), None, '^stress: must be symmetric'),
		(np.diag((-4, math.nan, -1)), None, '^stress: must be finite'),
		(np.diag((-4, -math.inf, -1)), None, '^stress: must be finite'),
		((-4, -5, -6), None, r'^stress: must be a symmetric \(3, 3\) tensor'),
		('high', None, '^stress: must be a symmetric'),
		(np.zeros((3, 3)), None, '^stress: is zero'),
		(uniform(-1e6), None, '^stress: tension of 1e.06 Pa.*compression is negative'),
		(np.diag((-1e6, -1e6, 1e3)), None, '^stress: tension of 1e.03 Pa'),
		(uniform(1e6), np.diag((1, 2, 3)), r'^gradient: must be three symmetric \(3, 3\) tensors'),
		(uniform(1e6), np.full((3, 3, 3), math.nan), '^gradient: must be finite'),
		(uniform(1e6), 1e7 * upwards / weight, '^stress: tension'),
		(
			np.diag((-1e6, -1e6, -9e6)) + 3e6 * np.eye(3)[[1, 0, 2]] * [[1], [1], [0]],
			None,
			r'joints cannot bear it, the one between \d+ and \d+ needs 71.6° of friction and has 30.0°',
		),
	],
)
def testBadStressesAreRefused(stress, gradient, message):
	material()
	masonry(2)
	before = [(body.state.pos, body.shape.offsets) for body in O.bodies]
	with pytest.raises(ValueError, match=message):
		polytope.inSitu(stress, gradient)
	assert [(body.state.pos, body.shape.offsets) for body in O.bodies] == before and not list(O.interactions)


def testAFaceWithoutNeighboursIsRefused():
	material()
	masonry(2, without=(0,))
	with pytest.raises(
		ValueError, match=r'^bodies: of the face of body \d towards \(1, 0, 0\) 0 of 1 m².*surround the mass by fixed Polytopes'
	):
		polytope.inSitu(general)
	polytope.inSitu(np.diag((0, -5e6, -6e6)))  # which leaves it free


def testPlatesThatOverlapAreRefused():
	material()
	masonry(2)
	cuboid((2, 0, 0), (3, 2, 2), fixed=True)
	with pytest.raises(ValueError, match=r'^bodies: of the face of body \d towards \(1, 0, 0\) 2 of 1 m²'):
		polytope.inSitu(general)


def testASecondCallIsRefused():
	material()
	masonry(2)
	polytope.inSitu(general)
	with pytest.raises(ValueError, match=r'^O.interactions: .*before the first step'):
		polytope.inSitu(general)
	O.interactions.clear()
	with pytest.raises(ValueError, match=r'overlap by 0.00\d+ m already.*make the mass anew'):
		polytope.inSitu(general)


@pytest.mark.parametrize(('share', 'refused'), [(0.9, False), (1.1, True)])
def testAnOverlapCountsByTheStiffnessOfBothMaterials(share, refused):
	"""Two stiffnesses act in series: 2 k₁k₂/(k₁ + k₂) is larger than the lesser one."""
	material()
	material(normalStiffness=1e11)
	stress = -6e6
	stiffness = 2 * 2e10 * 1e11 / (2e10 + 1e11)
	overlap = share * 0.01 * abs(stress) / stiffness
	assert overlap * 2e10 < 0.01 * abs(stress)
	cuboid((0, 0, 0), (1, 1, 1), material=0)
	cuboid((1 - overlap, 0, 0), (2, 1, 1), material=1)
	around((0, 0, 0), (2, 1, 1))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	if refused:
		with pytest.raises(ValueError, match=r'^bodies: 0 and 1 overlap by .* already'):
			polytope.inSitu(stress * np.eye(3))
	else:
		polytope.inSitu(stress * np.eye(3))


def testAContactThatIsMissingIsRefusedAndTheSceneIsAsItWas():
	material()
	masonry(2)
	O.bodies[3].mask, O.engines[1].avoidSelfInteractionMask = 2, 0
	before = [(body.state.pos, body.state.ori, body.state.inertia, body.shape.offsets) for body in O.bodies]
	with pytest.raises(ValueError, match=r'^bodies: the joint between \d and 3 would bear 0 N for .*mask'):
		polytope.inSitu(general)
	assert [(body.state.pos, body.state.ori, body.state.inertia, body.shape.offsets) for body in O.bodies] == before
	O.bodies[3].mask = 1
	polytope.inSitu(general)
	assert error(StressField(general)) < 0.002


@pytest.mark.filterwarnings('error:gradient')
def testWaterIsPartOfTheBalance():
	"""The stress between blocks under water has the gradient of the weight less the buoyancy."""
	material()
	masonry(2, without=(4,))
	O.engines[3].gravity = (0, 0, -9.81)
	water = polytope.water(level=3)
	lighter = np.zeros((3, 3, 3))
	lighter[2] = (2600 - 1000) * 9.81 * np.diag((0.6, 0.8, 1))
	polytope.inSitu(-2 * lighter[2], lighter)
	assert polytope.settle(elastic=False) <= 500 and error(StressField(-2 * lighter[2], lighter)) < 0.005
	O.reset()
	material()
	masonry(2, without=(4,))
	O.engines[3].gravity = (0, 0, -9.81)
	polytope.water(level=3)
	with pytest.raises(UserWarning, match='stress and gravity and water do not balance.*less the buoyancy'):
		polytope.inSitu(-2 * upwards[2], upwards)
	assert water


def testAStressThatDoesNotBalanceGravityIsWarnedOf():
	material()
	masonry(2)
	O.engines[3].gravity = (0, 0, -9.81)
	with pytest.warns(UserWarning, match='gradient: stress and gravity do not balance'):
		polytope.inSitu(uniform(1e5))


@pytest.mark.parametrize('what', ['perContact', 'boon2012', 'noEngines', 'matchMaker', 'bonded', 'friction', 'periodic', 'none', 'box'])
def testScenesThatCannotHaveAStress(what):
	material()
	masonry(2)
	expected, arguments = '^O.engines', {}
	if what == 'perContact':
		O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
	elif what == 'boon2012':
		O.engines[2].geomDispatcher.functors[0].contactModel = 'boon2012'
	elif what == 'noEngines':
		O.engines = []
	elif what == 'matchMaker':
		O.engines[2].physDispatcher.functors[0].kn = MatchMaker(algo='val', val=1e9)
		expected = '^O.engines: .*MatchMaker'
	elif what == 'bonded':
		polytope.bond()
		expected = '^bodies: body 0 is bonded.*in place of bonds'
	elif what == 'friction':
		O.bodies[0].material = utils.defaultMaterial()
		expected = '^bodies: body 0 is of a FrictMat'
	elif what == 'periodic':
		O.periodic, expected = True, '^O.periodic'
	elif what == 'none':
		arguments, expected = {'bodies': [99]}, '^bodies: there is no body 99'
	elif what == 'box':
		box = O.bodies.append(utils.box((9, 9, 9), (1, 1, 1)))
		assert isinstance(O.bodies[box].shape, Box)
		arguments, expected = {'bodies': [box]}, f'^bodies: body {box} is a Box'
	with pytest.raises(ValueError, match=expected):
		polytope.inSitu(uniform(1e6), **arguments)


def testWhereNothingCanMoveThereIsNoStress():
	material()
	with pytest.raises(ValueError, match='^bodies: there is no Polytope; append the blocks first'):
		polytope.inSitu(uniform(1e6))
	masonry(2)
	fixed = [body.id for body in O.bodies if not body.dynamic]
	with pytest.raises(ValueError, match='^bodies: none of them can move'):
		polytope.inSitu(uniform(1e6), bodies=fixed)
	for body in O.bodies:
		body.dynamic = False
	with pytest.raises(ValueError, match='^bodies: all Polytopes are fixed.*fix only those around the mass'):
		polytope.inSitu(uniform(1e6))


@pytest.mark.parametrize('asked', ['body', 'face'])
def testTheMaterialsOfFacesAreAskedFirst(asked):
	"""A body's own material does not count where all of its faces have another one."""
	material()
	masonry(2)
	refused = dict(normalStiffness=2e10, shearStiffness=1e10, frictionAngle=0.5)
	perContact = O.materials.append(RockJointMat(**refused, stiffnessPerArea=False))
	closing = O.materials.append(RockJointMat(**refused, closure=HyperbolicClosure(maximumClosure=1e-3)))
	own, blocks = O.bodies[0].material.id, [body for body in O.bodies if body.dynamic]
	if asked == 'body':
		for body in blocks:
			body.shape.faceMaterials = [own] * len(body.shape.normals)
			body.material = O.materials[perContact]
		assert polytope.inSitu(uniform(1e6)) > 0
		assert error(StressField(uniform(1e6))) < 0.005
		return
	for bad, words in (
		(perContact, 'has a stiffness per contact.*stiffnessPerArea=True'),
		(closing, r'has a closure of its own \(HyperbolicClosure\).*linear springs'),
	):
		blocks[0].shape.faceMaterials = [bad] * len(blocks[0].shape.normals)
		with pytest.raises(ValueError, match=f'^bodies: the joint between .* {words}'):
			polytope.inSitu(uniform(1e6))
		assert not list(O.interactions)


def testAClumpGetsIt():
	"""A clump of three blocks in an L, and a block that fills the corner, get the stress. Parts get other centres and axes with their size, and stay
	where they are."""
	material()
	corners = [(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)], [(1, 0), (2, 0), (2, 1), (1, 1)], [(0, 1), (1, 1), (1, 2), (0, 2)]
	prisms = [[(x, y, z) for x, y in outline for z in (0, 1)] for outline in corners]
	clump, _ = polytope.clump([polytope.fromVertices(points) for points in prisms])
	cuboid((1, 1, 0), (2, 2, 1))
	around((0, 0, 0), (2, 2, 1))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(general)
	assert clump in polytope.bodyStress() and error(StressField(general)) < 0.005
	assert staysAtRest(StressField(general), 0.005)


def testClumpsWithFacesThatAreNotConvexGetIt():
	"""Joints that end in the rock make them."""
	material(normalStiffness=1e11)
	joints = [(50, 80, 1.3, 1.6), (70, 200, 1.5, None), (20, 310, 1.6, None)]
	sets = [
		polytope.JointSet(math.radians(dip), math.radians(direction), spacing, radius=radius) for dip, direction, spacing, radius in joints
	]
	polytope.jointedRock(sides, [4, 0, 4, 0, 4, 0], sets).append()
	around((0, 0, 0), (4, 4, 4))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(general)
	assert sum(body.isClump for body in O.bodies) > 3
	assert staysAtRest(StressField(general), 0.01, steps=2000)


def testCommonFacesOfAMass():
	material()
	masonry(2, runningBond=False)
	faces = commonFaces({0})
	assert len(faces) == 6 and all(face.area == pytest.approx(1) for face in faces)
	assert sum((face.normal if face.id1 == 0 else -face.normal) * face.area for face in faces) == pytest.approx(0, abs=1e-12)
	assert faces[0].second == pytest.approx((np.eye(3) - np.outer(faces[0].normal, faces[0].normal)) / 12)


def testJointsHaveTheMaterialOfTheirFaces():
	"""The joint is weaker and softer in shear than the rock: its friction, its stress and its factor of safety are those of its own material."""
	O.materials.append(RockJointMat(label='rock', density=2600, normalStiffness=1e10, shearStiffness=1e10, frictionAngle=math.radians(50)))
	O.materials.append(RockJointMat(label='bed', density=2600, normalStiffness=1e10, shearStiffness=5e9, frictionAngle=math.radians(25)))
	box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	dip = polytope.Joint(math.radians(20), math.radians(90), (0, 0, 0))
	ids = polytope.jointedRock(box, [3, 3, 1, 1, 2, 2], [dip]).append(material='rock', jointMaterials=['bed'])
	low, high = sorted(ids, key=lambda k: O.bodies[k].state.pos[2])
	O.bodies[low].dynamic = False
	walls = [((4, 0, 0), (1, 1, 2)), ((-4, 0, 0), (1, 1, 2)), ((0, 2, 0), (5, 1, 2)), ((0, -2, 0), (5, 1, 2)), ((0, 0, 3), (5, 3, 1))]
	walls = O.bodies.append([polytope.cuboid(*wall, fixed=True, material='rock') for wall in walls])
	O.engines = polytope.engines()
	k = 2600 * 9.81 * np.diag((0.5, 0.5, 1))
	polytope.inSitu(-4 * k, gradient=[0 * k, 0 * k, k])
	joint = O.interactions[low, high].phys
	assert joint.tangensOfFrictionAngle == pytest.approx(math.tan(math.radians(25)))
	assert joint.shearStiffness == pytest.approx(5e9)
	polytope.excavate(walls, over=3000)
	O.run(3500, True)
	polytope.settle()
	assert polytope.factorOfSafety().factor == pytest.approx(math.tan(math.radians(25)) / math.tan(math.radians(20)), rel=0.012)


def testJointsWhoseFacesAreTooWeakAreRefused():
	O.materials.append(RockJointMat(label='rock', density=2600, normalStiffness=1e10, shearStiffness=1e10, frictionAngle=math.radians(60)))
	O.materials.append(RockJointMat(label='weak', density=2600, normalStiffness=1e10, shearStiffness=1e10, frictionAngle=math.radians(20)))
	box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	dip = polytope.Joint(math.radians(30), math.radians(90), (0, 0, 0))
	ids = polytope.jointedRock(box, [1, 1, 1, 1, 1, 1], [dip]).append(material='rock', jointMaterials=['weak'])
	walls = [
		((2, 0, 0), (1, 1, 1)),
		((-2, 0, 0), (1, 1, 1)),
		((0, 2, 0), (3, 1, 1)),
		((0, -2, 0), (3, 1, 1)),
		((0, 0, 2), (3, 3, 1)),
		((0, 0, -2), (3, 3, 1)),
	]
	O.bodies.append([polytope.cuboid(*wall, fixed=True, material='rock') for wall in walls])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	with pytest.raises(ValueError, match=r'needs 21.8° of friction and has 20.0°'):
		polytope.inSitu(np.diag((-1e6, -1e6, -4e6)), bodies=ids)


def testTheShearOfAJointInThePlaneIsThatOfItsMiddle():
	"""Its pressure has its centre lower, where both stresses are larger."""
	material(frictionAngle=math.radians(50))
	half, length = math.radians(25), 5 / math.cos(math.radians(25))
	joints = [polytope.Joint(math.pi / 2 - half, math.radians(direction), (0, 5, 0)) for direction in (90, 270)]
	ids = polytope.jointedRock([(1, 0), (-1, 0), (0, 1), (0, -1)], [4, 4, 7, 0], joints).append()
	O.bodies.append(polytope.polygon([(-4, -1), (4, -1), (4, 0), (-4, 0)], fixed=True))
	(prism,) = [k for k in ids if abs(O.bodies[k].state.pos[0]) < 1e-9 and O.bodies[k].state.pos[1] < 5]
	for k in ids:
		O.bodies[k].dynamic = k == prism
	O.engines = polytope.engines(gravity=(0, -9.81, 0))
	rise = 2600 * 9.81
	stress, gradient = np.diag([-5e4, -9 * rise, 0]), np.zeros((3, 3, 3))
	gradient[1][1, 1] = rise
	polytope.inSitu(stress, gradient=gradient)
	sheared = [
		float(c.phys.shearForce.norm())
		for c in O.bodies[prism].intrs()
		if c.isReal and c.phys.contactArea == pytest.approx(length, rel=1e-2)
	]
	assert sheared[:2] == pytest.approx([length * (6.5 * rise - 5e4) * math.sin(half) * math.cos(half)] * 2, rel=1e-3)


def amongFixedBlocks(joints, **joint):
	"""A cube of 6 m, its top 100 m deep, whose blocks at the boundary are the fixed ones, with the stress of its depth."""
	material(**joint)
	sets = [polytope.JointSet(math.radians(dip), math.radians(direction), spacing) for dip, direction, spacing in joints]
	mass = polytope.jointedRock(sides, [3] * 6, sets)
	for k, made in zip(mass.append(), mass.faces, strict=True):
		O.bodies[k].dynamic = not (made < 0).any()
	O.engines = polytope.engines()
	polytope.inSitu(-103 * k0, gradient=[0 * k0, 0 * k0, k0])


def normalForces():
	return {(c.id1, c.id2): np.array(c.phys.normalForce) for c in O.interactions if c.isReal}


@pytest.mark.parametrize('turn', [0, 0.1, 1])
def testBlocksAmongFixedBlocksKeepTheirForcesInEachStep(turn):
	"""Fixed blocks of both rows are of one solid: their faces in the joint's plane are not its ends."""
	joints = [(50, 80, 1.3), (70, 200, 1.5), (20, 310, 1.6)]
	amongFixedBlocks([(dip + turn, direction + turn, spacing) for dip, direction, spacing in joints], frictionAngle=math.radians(35))
	first = {pair: np.linalg.norm(force) for pair, force in normalForces().items()}
	large = 1e-2 * max(first.values())
	for _ in range(30):
		O.step()
		now = normalForces()
		changed = {pair: np.linalg.norm(now.get(pair, 0)) / force for pair, force in first.items() if force > large}
		assert changed == pytest.approx(dict.fromkeys(changed, 1), rel=0.05)


def testBlocksAmongFixedBlocksComeToRest():
	"""Their faces lie in one plane with those of the fixed blocks beside them: rounding must not say whose these are, anew in each search."""
	amongFixedBlocks([(15.44, 161.58, 1.168), (85.91, 226.15, 1.128), (30.12, 319.27, 1.137)], frictionAngle=math.radians(40))
	polytope.settle(elastic=False)
	first = normalForces()
	largest = max(np.linalg.norm(force) for force in first.values())
	for _ in range(40):  # a search takes turns every 16 steps
		O.step()
		now = normalForces()
		assert max(np.linalg.norm(now[pair] - first[pair]) for pair in first) < 1e-5 * largest
