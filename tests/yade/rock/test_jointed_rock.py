# SPDX-License-Identifier: GPL-2.0-or-later
"""Rock cut into blocks by sets of joints: the blocks fill the region once, joints are as requested."""

from math import exp, pi, radians, tanh

import numpy as np
import pytest
from yade import polytope
from yade.polytope import JointSet

box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
half = [10, 10, 8, 8, 6, 6]
volume = 20 * 16 * 12
east, north = pi / 2, 0
scattered = [
	JointSet(radians(35), east, 3, exponential=True, fisher=60),
	JointSet(radians(80), radians(250), 4, exponential=True, fisher=60),
	JointSet(radians(88), north, 4, exponential=True, fisher=60),
]


def inside(block, points):
	normals, offsets = block
	return (points @ normals.T < offsets).all(axis=1)


def testThreeOrthogonalSetsMakeEqualBoxes():
	rock = polytope.jointedRock(box, half, [JointSet(0, 0, 2), JointSet(pi / 2, east, 2), JointSet(pi / 2, north, 4, through=(5, 0, 1))])
	assert len(rock.blocks) == 6 * 10 * 4 and rock.uncut == 0
	assert len(rock.joints) == 5 + 9 + 3
	assert rock.volumes == pytest.approx(np.full(240, 16.0), rel=1e-12)
	assert len(polytope.jointedRock(box, half, [JointSet(0, 0, 500)]).blocks) == 2, 'the default of smallest leaves joints a thin region'
	body = polytope.fromHalfSpaces(*rock.blocks[0])
	assert len(body.shape.normals) == 6 and float(body.shape.volume) == pytest.approx(16, rel=1e-12)


@pytest.mark.parametrize('place', [(0, 0, 0), (4e5, 5.6e6, 800)], ids=['at the origin', 'in map coordinates'])
def testBlocksFillTheRegionOnce(place):
	offsets = np.array(half) + np.array(box) @ place
	rock = polytope.jointedRock(box, offsets, scattered, seed=5)
	assert len(rock.blocks) > 50
	assert rock.volumes.sum() == pytest.approx(volume, rel=1e-12 if not any(place) else 1e-8)
	points = np.random.default_rng(1).uniform(-1, 1, (2000, 3)) * (10, 8, 6) + place
	found = sum(inside(block, points).astype(int) for block in rock.blocks)
	assert (found == 1).all()
	assert len(rock.blocks) == len(polytope.jointedRock(box, half, scattered, seed=5).blocks)


def testNeighboursTouchWithoutOverlap():
	rock = polytope.jointedRock(box, half, scattered, seed=2)
	bodies = [polytope.fromHalfSpaces(*block) for block in rock.blocks]
	contacts = [polytope.contact(a, b) for k, a in enumerate(bodies) for b in bodies[:k]]
	assert not any(contact.inContact for contact in contacts)
	assert sum(contact.infeasibility < 1e-9 for contact in contacts) > 3 * len(bodies), 'neighbours share faces, edges and corners'


def testJointsStartFromTheCentroid():
	"""They do not start from the mean of the corners: a corner that is cut off by very little leaves them where they are."""
	(whole,), (cut,) = (
		polytope.jointedRock(normals, offsets, [JointSet(0, 0, 100)]).joints
		for normals, offsets in ((box, [10, 0, 8, 0, 6, 0]), ([*box, (1, 1, 1)], [10, 0, 8, 0, 6, 0, 24 - 1e-3]))
	)
	assert whole[3] == pytest.approx(3, abs=1e-12) and cut[3] == pytest.approx(3, abs=1e-9)


def testVerticalByOneRoundingTooMuch():
	assert polytope.jointedRock(box, half, [JointSet(pi / 2 * (1 + 2e-16), 0, 100)]).joints.shape == (1, 4)


def testDipAndDipDirection():
	rock = polytope.jointedRock(box, half, [JointSet(radians(30), radians(90), 100, through=(1, 2, 3))])
	(plane,) = rock.joints
	assert plane[:3] == pytest.approx((0.5, 0, 0.75**0.5))  # dips to the east: its upward normal leans there
	assert plane[:3] @ (1, 2, 3) == pytest.approx(plane[3])
	assert len(rock.blocks) == 2
	assert JointSet(radians(30), 0, 1).normal == pytest.approx((0, 0.5, 0.75**0.5)), 'azimuth 0 is north'


def testScatterFollowsFisherAndTheExponentialDistribution():
	random = np.random.default_rng(7)
	kappa, spacing, radius = 40.0, 0.01, 10.0
	joints = JointSet(radians(35), east, spacing, exponential=True, fisher=kappa)
	planes = joints.planes(np.zeros(3), radius, random)
	length = 60.0  # scattered joints start up to three radii away
	assert len(planes) == pytest.approx(length / spacing, abs=4 * (length / spacing) ** 0.5)
	resultant = planes[:, :3].mean(axis=0)
	assert np.linalg.norm(resultant) == pytest.approx(1 / tanh(kappa) - 1 / kappa, abs=2e-3)
	assert resultant / np.linalg.norm(resultant) == pytest.approx(joints.normal, abs=0.01)
	parallel = JointSet(0, 0, spacing, exponential=True).planes(np.zeros(3), radius, random)
	gaps = np.diff(np.sort(parallel[:, 3]))
	for distance in (0.005, 0.01, 0.02):
		assert (gaps > distance).mean() == pytest.approx(exp(-distance / spacing), abs=0.045)


def testNoPieceBelowSmallest():
	sets = [*scattered, JointSet(radians(36), radians(91), 1.7)]
	coarse = polytope.jointedRock(box, half, sets, smallest=0.3, seed=4)
	fine = polytope.jointedRock(box, half, sets, smallest=0, seed=4)
	radii = [polytope.contact(body, body).infeasibility for body in (polytope.fromHalfSpaces(*block) for block in coarse.blocks)]
	assert max(radii) <= -0.3 * (1 - 1e-9)
	assert coarse.uncut > 0 and len(fine.blocks) > len(coarse.blocks)
	for rock in (coarse, fine):
		assert rock.volumes.sum() == pytest.approx(volume, rel=1e-12)


def testSeedDecides():
	first, same, other = (polytope.jointedRock(box, half, scattered, seed=seed) for seed in (1, 1, 2))
	assert np.array_equal(first.joints, same.joints) and np.array_equal(first.volumes, same.volumes)
	assert not np.array_equal(first.joints, other.joints)


def testJointsAlongFacesAndCornersDoNotCut():
	rock = polytope.jointedRock(box, half, [JointSet(0, 0, 6), JointSet(pi / 2, east, 100, through=(10, 0, 0))], smallest=0)
	assert len(rock.blocks) == 2 and rock.uncut == 0


@pytest.mark.parametrize(
	'arguments, named',
	[
		({'dip': 35}, 'dip'),
		({'dip': -0.1}, 'dip'),
		({'dip': float('nan')}, 'dip'),
		({'dip': 'steep'}, 'dip'),
		({'dipDirection': 90}, 'dipDirection'),
		({'spacing': 0}, 'spacing'),
		({'spacing': float('inf')}, 'spacing'),
		({'spacing': True}, 'spacing'),
		({'fisher': 0}, 'fisher'),
		({'through': (1, 2, 3, 4)}, 'through'),
		({'exponential': 'no'}, 'exponential'),
		({'exponential': None}, 'exponential'),
		({'through': (1, 2, float('nan'))}, 'through'),
		({'through': (0, 0, 0), 'exponential': True}, 'through'),
	],
)
def testWrongJointsAreRefused(arguments, named):
	with pytest.raises(ValueError, match=f'^{named}:'):
		JointSet(**{'dip': 0.5, 'dipDirection': 1, 'spacing': 2, **arguments})


@pytest.mark.parametrize(
	'arguments, named',
	[
		({'normals': box[:3], 'offsets': half[:3]}, 'normals'),
		({'normals': 5}, 'normals'),
		({'normals': [*box[:5], (0, 0, float('nan'))]}, 'normals'),
		({'offsets': half[:5]}, 'offsets'),
		({'offsets': [10, -11, 8, 8, 6, 6]}, '(normals|offsets)'),
		({'jointSets': []}, 'jointSets'),
		({'jointSets': [3]}, 'jointSets'),
		({'jointSets': 3}, 'jointSets'),
		({'jointSets': [JointSet(0.5, 1, 1e-5)]}, 'jointSets'),
		({'jointSets': [JointSet(0, 0, 0.05), JointSet(pi / 2, 0, 0.05), JointSet(pi / 2, pi / 2, 0.05)]}, 'jointSets'),
		({'smallest': -1}, 'smallest'),
		({'smallest': 6.01}, 'smallest'),
		({'offsets': ['a'] * 6}, 'offsets'),
		({'smallest': 'no'}, 'smallest'),
		({'seed': -1}, 'seed'),
		({'seed': 1.5}, 'seed'),
	],
)
def testWrongArgumentsAreRefused(arguments, named):
	with pytest.raises(ValueError, match=f'^{named}:'):
		polytope.jointedRock(**{'normals': box, 'offsets': half, 'jointSets': scattered, **arguments})


@pytest.mark.parametrize('region', [(None, None), ([polytope.Joint(0.5, 1, (0, 0, 0))], [1])])
def testJointsWithoutARegionAreRefused(region):
	with pytest.raises(ValueError, match='^normals: joints cut a region of rock, and none is given; give .*half-spaces.*meshRegion'):
		polytope.jointedRock(*region, scattered)
