# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints that end in the rock: what they cut, which blocks are one body, random sets by their area per volume."""

from math import cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from yade import O, RockJointMat, polytope
from yade.polytope import Joint, JointSet
from yade.polytope.rock.joint import anglesOf
from yade.polytope.rock.jointedRegion import regionOf
from yade.polytope.rock.jointRadii import radiiOf
from yade.polytope.rock.termination import Earlier

box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
half = [10, 10, 8, 8, 6, 6]
volume = 20 * 16 * 12
east, north, vertical = pi / 2, 0.0, pi / 2


def cut(*joints, **named):
	return polytope.jointedRock(box, half, list(joints), **named)


def rectangle(axis, place, low, high):
	"""Normal to an axis."""
	i, j = [k for k in range(3) if k != axis]
	corners = np.full((4, 3), float(place))
	corners[:, i], corners[:, j] = [low[0], high[0], high[0], low[0]], [low[1], low[1], high[1], high[1]]
	return Joint.polygon(corners)


def bodyVolumes(rock):
	return np.array([rock.volumes[parts].sum() for parts in rock.bodies])


def testADiscThatEndsInsideDividesNothing():
	disc = Joint(radians(20), east, (1, 0, 0), radius=3)
	rock = cut(disc)
	assert len(rock.blocks) == 1 and rock.bodies == [[0]] and (rock.faces[0] == -1).all()
	assert rock.areas == pytest.approx([9 * pi], rel=1e-12)
	assert rock.sections == pytest.approx([20 / cos(radians(20)) * 16], rel=1e-12)
	apart = cut(disc, incomplete='cut')
	assert apart.bodies == [[0], [1]] and apart.volumes.sum() == pytest.approx(volume, rel=1e-12)
	assert cut(Joint(radians(20), east, (1, 0, 0), radius=30)).bodies == [[0], [1]], 'it reaches the faces on all sides'


def testADiscOutsideCutsNothing():
	with pytest.warns(
		UserWarning, match=r'^jointSets: no joint reaches into the region, whose centre is \(.*are their places in other units or axes'
	):
		rock = cut(Joint(0, 0, (14, 0, 0), radius=3), incomplete='cut')
	assert len(rock.blocks) == 1 and len(rock.joints) == 0


@pytest.mark.parametrize('short', [False, True])
def testPolygonsCutACuboidOutOfAnEdge(short):
	"""4 × 3 × 2 m at a corner of the region; one joint that is too short by half a metre leaves it attached."""
	rock = cut(
		rectangle(0, 6, (5, 4), (9, 7)),
		rectangle(1, 5, (6, 4), (9.5 if short else 11, 7)),
		rectangle(2, 4, (6, 5), (11, 9)),
	)
	assert rock.volumes.sum() == pytest.approx(volume, rel=1e-12)
	if short:
		assert sorted(bodyVolumes(rock)) == pytest.approx([volume])
	else:
		assert sorted(bodyVolumes(rock)) == pytest.approx([24, volume - 24], rel=1e-12)
		small = rock.bodies[int(np.argmin(bodyVolumes(rock)))]
		assert sorted(rock.faces[small[0]]) == [-1, -1, -1, 0, 1, 2], 'faces know which joint made them'


def testTrianglesInOnePlaneAreOneJoint():
	"""A joint that is not convex comes in convex parts."""
	first, second = [(-11, -9, 1), (11, -9, 1), (11, 9, 1)], [(-11, -9, 1), (11, 9, 1), (-11, 9, 1)]
	rock = cut([Joint.polygon(first), Joint.polygon(second)])
	assert sorted(bodyVolumes(rock)) == pytest.approx([5 * 320, 7 * 320], rel=1e-12)
	assert cut(Joint.polygon(first)).bodies == [[0]]


def network(seed, incomplete='clump'):
	sets = [JointSet(radians(d), a, p32=0.35, radius=('lognormal', 5, 2), fisher=30) for d, a in ((20, 1), (80, 2.5), (85, 0.7))]
	return sets, polytope.jointedRock(box, half, sets, seed=seed, incomplete=incomplete, smallest=1e-6)


def testBlocksOfDiscsFillTheRegionOnce():
	_, rock = network(3)
	assert len(rock.bodies) > 20 and max(map(len, rock.bodies)) > 20
	assert rock.volumes.sum() == pytest.approx(volume, rel=1e-12)
	assert sorted(k for parts in rock.bodies for k in parts) == list(range(len(rock.blocks)))
	points = np.random.default_rng(1).uniform(-1, 1, (1000, 3)) * (10, 8, 6)
	assert (sum((points @ n.T < d).all(axis=1).astype(int) for n, d in rock.blocks) == 1).all()


def testRockGoesOnWhereNoDiscIsCrossed():
	"""Two points with no disc between them are in one body; across a joint that is whole they are not: sampled, without any of the code that cuts."""
	sets, rock = network(3)
	random = np.random.default_rng(5)
	region = regionOf(box, half)
	draws, cuts = np.random.default_rng(3), []
	for number, one in enumerate(sets):
		cuts += one.cuts(region, Earlier(cuts), number, draws)
	first = random.uniform(-1, 1, (1500, 3)) * (9.9, 7.9, 5.9)
	second = np.clip(first + random.normal(size=first.shape) * 0.4, [-9.99, -7.99, -5.99], [9.99, 7.99, 5.99])
	crossed = np.zeros(len(first), bool)
	for one in cuts:
		above, below = first @ one.normal - one.offset, second @ one.normal - one.offset
		with np.errstate(divide='ignore', invalid='ignore'):
			at = first + (above / (above - below))[:, None] * (second - first)
		crossed |= (above * below < 0) & (np.linalg.norm(at - one.centre, axis=1) < one.radius)
	owner = np.empty(len(rock.blocks), int)
	for body, parts in enumerate(rock.bodies):
		owner[parts] = body
	bodies = [np.argmax([(points @ n.T < d).all(axis=1) for n, d in rock.blocks], axis=0) for points in (first, second)]
	same = owner[bodies[0]] == owner[bodies[1]]
	assert same[~crossed].all()
	assert 0.1 < crossed.mean() < 0.9 and (~same).sum() > 50


@pytest.mark.parametrize('radius', [None, 2.5, ('exponential', 1.5), ('lognormal', 2, 1), ('powerLaw', 1, 8, 2.5)])
@pytest.mark.parametrize('fisher', [None, 20])
def testDensityIsAsAskedFor(radius, fisher):
	rock = cut(JointSet(radians(50), 1, p32=2.0, radius=radius, fisher=fisher), incomplete='cut', smallest=0, seed=2)
	assert rock.areas.sum() / volume == pytest.approx(2.0, rel=0.02)
	assert (rock.areas <= rock.sections * (1 + 1e-12)).all()


def testSpacingOfDiscsIsThatOfAScanLine():
	"""Lines along the mean normal meet scattered discs at the spacing that was asked for, in the region's middle and near its faces alike."""
	joints = JointSet(radians(30), 1, spacing=0.5, radius=1, fisher=15)
	region, random, direction, length = regionOf(box, half), np.random.default_rng(4), joints.normal, 0.5
	middle = random.uniform(-1, 1, (1000, 3)) * (4, 4, 3)
	edge = random.uniform(-1, 1, (1000, 3)) * (9.5, 7.5, 5.5)
	edge[:, 0] = 9.5 * np.sign(edge[:, 0])
	hits, networks = np.zeros(2), 8
	for _ in range(networks):
		for one in joints.cuts(region, Earlier([]), 0, random):
			for place, points in enumerate((middle, edge)):
				along = (one.offset - points @ one.normal) / (one.normal @ direction)
				at = points + along[:, None] * direction
				hits[place] += ((np.abs(along) < length / 2) & (np.linalg.norm(at - one.centre, axis=1) < one.radius)).sum()
	assert hits / (networks * 1000 * length) == pytest.approx(
		1 / 0.5, rel=0.07
	)  # some 2000 discs reach into each place: 2.2 % is a standard deviation


@pytest.mark.parametrize('radius', [2.0, ('exponential', 1.5), ('lognormal', 2, 1), ('powerLaw', 1, 8, 2.5), ('powerLaw', 1, 8, 3)])
def testRadiiFollowTheirDistribution(radius):
	"""Weighted by r^k the mean of r is the ratio of two moments."""
	radii, random = radiiOf(radius), np.random.default_rng(6)
	for power in range(3):
		drawn = radii.draw(power, 200000, random)
		assert drawn.mean() == pytest.approx(radii.moment(power + 1) / radii.moment(power), rel=0.02)
	assert radii.moment(0) == pytest.approx(1)


def testTermination():
	"""A disc that crosses an earlier plane ends there, on the side of its centre."""
	plane = Joint(vertical, east, (2, 0, 0)).cut
	disc = Joint(0, 0, (1, 0, 0), radius=3).cut
	Earlier([plane]).end(disc, 1.0, np.random.default_rng(0))
	assert disc.edges.tolist() == pytest.approx(np.array([[1, 0, 0, 2]]))
	for other in (
		Joint(vertical, east, (2, 8, 0), radius=3),
		Joint(vertical, east, (2, 0, 5), radius=4.9),
		Joint(0, 0, (1, 0, 1), radius=9),
	):
		missed = Joint(0, 0, (1, 0, 0), radius=3).cut
		Earlier([other.cut]).end(missed, 1.0, np.random.default_rng(0))
		assert len(missed.edges) == 0
	bedding, cross = JointSet(0, 0, spacing=2), JointSet(vertical, east, p32=0.5, radius=3, termination=1.0)
	region, random = regionOf(box, half), np.random.default_rng(1)
	planes = bedding.cuts(region, Earlier([]), 0, random)
	ended = cross.cuts(region, Earlier(planes), 1, random)
	for one in ended:
		levels, below = -one.edges[:, 3] * one.edges[:, 2], one.edges[:, 2] < 0
		crossed = [z for z in np.arange(-14, 15, 2) if abs(z - one.centre[2]) < 3]
		assert sorted(np.abs(levels)) == pytest.approx(sorted(np.abs(crossed)))
		assert (below == (one.centre[2] > one.edges[:, 3] * one.edges[:, 2])).all()
	rock = cut(bedding, cross, seed=1, smallest=1e-6)
	assert rock.areas[rock.sets == 1].sum() / volume == pytest.approx(0.5, rel=0.02)
	for normals, offsets in rock.blocks:  # no block reaches through a layer
		level = offsets[normals[:, 2] > 0.99].min() + offsets[normals[:, 2] < -0.99].min()
		assert level == pytest.approx(2, rel=1e-9)


def testPersistenceIsTheShareOfBlocksCut():
	layers, cross = JointSet(0, 0, spacing=0.5), JointSet(vertical, east, spacing=1, persistence=0.4)
	rock = cut(layers, cross, seed=1)
	number = len(rock.blocks) - 24  # of 19 joints through 24 layers
	assert number / (19 * 24) == pytest.approx(0.4, abs=4 * sqrt(0.4 * 0.6 / (19 * 24)))


def testRegionsOfSeveralParts():
	"""An L: 20 × 16 × 12 with a step of 20 × 8 × 4 on it."""
	step = ([*box], [10, 10, 8, 0, 10, -6])
	normals, offsets = [box, step[0]], [half, step[1]]
	joint = Joint(vertical, east, (-2, 0, 0))
	rock = polytope.jointedRock(normals, offsets, [joint])
	assert sorted(bodyVolumes(rock)) == pytest.approx([(volume + 640) * 0.4, (volume + 640) * 0.6], rel=1e-12)
	assert sorted(map(len, rock.bodies)) == [2, 2]
	along = polytope.jointedRock(normals, offsets, [Joint(0, 0, (0, 0, 6))])
	assert sorted(bodyVolumes(along)) == pytest.approx([640, volume], rel=1e-12)
	with pytest.raises(ValueError, match='^normals: parts of the region overlap'):
		polytope.jointedRock([box, box], [half, [11, -9, 8, 8, 6, 6]], [joint])
	with pytest.raises(ValueError, match='^offsets: must be as many'):
		polytope.jointedRock([box, box], [half], [joint])


def testAnglesAndNormals():
	for dip, direction in ((0.3, 1), (1.2, 4), (pi / 2, 2), (0.01, 6)):
		found = anglesOf(Joint(dip, direction, (0, 0, 0)).normal)
		assert found == pytest.approx((dip, direction))
		assert anglesOf(-Joint(dip, direction, (0, 0, 0)).normal) == pytest.approx((dip, direction)) or dip == pi / 2


@pytest.mark.parametrize('friction, slides', [(28, True), (32, False)])
def testBlockWithAJointThatEndsInItSlidesAsOne(friction, slides):
	"""A cuboid on a plane that dips at 30°, with a joint half through it across the slope: g (sin β − cos β tan φ)."""
	O.reset()
	beta = radians(30)
	O.materials.append(RockJointMat(density=2500, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=radians(friction)))
	turn = np.array([[cos(beta), 0, sin(beta)], [0, 1, 0], [-sin(beta), 0, cos(beta)]])  # x down the slope, z off it
	normals = np.array(box) @ turn.T
	region = [[normals, [2, 2, 1, 1, 1, 0]], [normals, [20, 4, 3, 3, 0, 1]]]
	crack = Joint.polygon(np.array([(0, -2, 0.4), (0, 2, 0.4), (0, 2, 2), (0, -2, 2)]) @ turn.T)
	base = Joint(beta, east, (0, 0, 0))
	rock = polytope.jointedRock([one[0] for one in region], [one[1] for one in region], [crack, base])
	assert sorted(bodyVolumes(rock)) == pytest.approx([4 * 2, 24 * 6], rel=1e-12)
	ids = rock.append()
	ground, block = (ids[k] for k in np.argsort(-bodyVolumes(rock)))
	for k in [ground, *([] if not O.bodies[ground].isClump else O.bodies[ground].shape.members)]:
		O.bodies[k].dynamic = False
	assert float(O.bodies[block].state.mass) == pytest.approx(8 * 2500)
	O.engines = polytope.engines(gravity=(0, 0, -9.81), damping=0.0)
	speeds = []
	for time in (0.3, 0.6):  # once the first swing is over
		while O.time < time:
			O.step()
		speeds.append(np.array(O.bodies[block].state.vel, float) @ (cos(beta), 0, -sin(beta)))
	expected = 9.81 * (sin(beta) - cos(beta) * tan(radians(friction))) if slides else 0
	assert (speeds[1] - speeds[0]) / 0.3 == pytest.approx(expected, abs=0.01)


def testClumpsOfBlocksHaveTheSumsOfTheirParts():
	O.reset()
	_, rock = network(3)
	ids = rock.append(material=RockJointMat(density=1000), color=(1, 0, 0))
	for parts, number in zip(rock.bodies, ids, strict=True):
		assert float(O.bodies[number].state.mass) == pytest.approx(1000 * rock.volumes[parts].sum(), rel=1e-9)
		assert O.bodies[number].isClump == (len(parts) > 1)
	one = next(k for k, parts in enumerate(rock.bodies) if 1 < len(parts) < 6)
	bodies = [polytope.fromHalfSpaces(*rock.blocks[k], material=RockJointMat(density=1000)) for k in rock.bodies[one]]
	number, _ = polytope.clump(bodies)
	for name in ('pos', 'inertia'):
		assert np.array(getattr(O.bodies[number].state, name), float) == pytest.approx(
			np.array(getattr(O.bodies[ids[one]].state, name), float), rel=1e-9, abs=1e-9
		)


def testSeedDecides():
	same = [network(7)[1] for _ in range(2)]
	assert np.array_equal(same[0].volumes, same[1].volumes)
	assert not np.array_equal(network(8)[1].joints, same[0].joints)


@pytest.mark.parametrize(
	'arguments, named',
	[
		({'spacing': None}, 'spacing'),
		({'p32': 1}, 'p32'),
		({'p32': -1, 'spacing': None}, 'p32'),
		({'radius': -1}, 'radius'),
		({'radius': ('lognormal', 3)}, 'radius'),
		({'radius': ('uniform', 1, 2)}, 'radius'),
		({'radius': ('powerLaw', 3, 2, 3)}, 'radius'),
		({'radius': 'large'}, 'radius'),
		({'radius': 3, 'through': (0, 0, 0)}, 'through'),
		({'termination': 0.5}, 'termination'),
		({'termination': 2, 'radius': 1}, 'termination'),
		({'persistence': 0}, 'persistence'),
	],
)
def testWrongSetsAreRefused(arguments, named):
	with pytest.raises(ValueError, match=f'^{named}:'):
		JointSet(**{'dip': 0.5, 'dipDirection': 1, 'spacing': 2, **arguments})


@pytest.mark.parametrize(
	'make, named',
	[
		(lambda: Joint(2, 0, (0, 0, 0)), 'dip'),
		(lambda: Joint(1, 90, (0, 0, 0)), 'dipDirection'),
		(lambda: Joint(1, 1, (0,)), 'centre'),
		(lambda: Joint(1, 1, (0, 0, 0), radius=0), 'radius'),
		(lambda: Joint.polygon([(0, 0, 0), (1, 0, 0)]), 'corners'),
		(lambda: Joint.polygon([(0, 0, 0), (1, 0, 0), (2, 0, 0)]), 'corners'),
		(lambda: Joint.polygon([(0, 0, 0), (1, 0, 0), (1, 1, 0.2), (0, 1, 0)]), 'corners'),
		(lambda: Joint.polygon([(0, 0, 0), (2, 0, 0), (0.3, 0.3, 0), (0, 2, 0)]), 'corners'),
		(lambda: Joint.polygon([(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)]), 'corners'),
		(lambda: Joint.polygon([(0, 0, float('nan')), (1, 0, 0), (1, 1, 0)]), 'corners'),
		(lambda: cut(Joint(0, 0, (0, 0, 0)), incomplete='weld'), 'incomplete'),
		(lambda: cut([Joint(0, 0, (0, 0, 0)), 3]), 'jointSets'),
		(lambda: cut(JointSet(0, 0, p32=1e-3, radius=1e-4)), 'jointSets'),
		(lambda: cut(*[JointSet(d, a, p32=90) for d, a in ((0, 0), (vertical, east), (vertical, north))]), 'jointSets'),
	],
)
def testWrongJointsAreRefused(make, named):
	with pytest.raises(ValueError, match=f'^{named}:'):
		make()
