# SPDX-License-Identifier: GPL-2.0-or-later
"""Sizes, joints per length, stereonet, and blocks that can leave a face, against closed forms."""

from math import acos, asin, cos, pi, radians, sin, tan

import numpy as np
import pytest
from yade import polytope
from yade.polytope import Joint, JointSet

box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
half = [10, 10, 10, 10, 5, 5]
east, south, vertical = pi / 2, pi, pi / 2


def slope(*joints, face=60):
	"""Rock behind a face that dips to the east and runs through the origin, 10 m high."""
	normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (sin(radians(face)), 0, cos(radians(face)))]
	return polytope.jointedRock(normals, [5, 40, 12, 12, 10, 5, 0], list(joints)), normals[-1]


def testPlaneSlide():
	"""Hoek & Bray's plane failure: a slab above a joint through the toe, cut off at its sides."""
	dip, friction, cohesion = radians(35), radians(30), 5e4
	rock, face = slope(Joint(dip, east, (0, 0, 0)), Joint(vertical, 0, (0, 4, 0)), Joint(vertical, 0, (0, -4, 0)))
	(block,) = polytope.keyBlocks(rock, [face, (0, 0, 1)], friction)
	assert block.mode == 'slides on one face' and block.joints == (0,)
	assert block.direction == pytest.approx((cos(dip), 0, -sin(dip)))
	assert block.volume == pytest.approx(8 * 10 * 10 * (1 / tan(dip) - 1 / tan(radians(60))) / 2)
	assert block.factorOfSafety == pytest.approx(tan(friction) / tan(dip))
	area, weight = 8 * 10 / sin(dip), 2600 * 9.81 * block.volume
	(held,) = polytope.keyBlocks(rock, [face, (0, 0, 1)], friction, cohesion=[cohesion, 0, 0])
	assert held.factorOfSafety == pytest.approx(tan(friction) / tan(dip) + cohesion * area / (weight * sin(dip)))
	steep, face = slope(Joint(radians(65), east, (0, 0, 0)), Joint(vertical, 0, (0, 4, 0)), Joint(vertical, 0, (0, -4, 0)))
	assert not polytope.keyBlocks(steep, face, friction), 'it dips more steeply than the face and does not come out in it'


@pytest.mark.parametrize('dip, turn', [(55, 45), (50, 60), (65, 40)])
def testSymmetricWedge(dip, turn):
	"""Hoek & Bray: tan φ/tan ψ · sin β/sin(ξ/2), ξ between the planes, β from the horizontal to their bisector's normal plane."""
	dip, turn, friction = radians(dip), radians(turn), radians(30)
	rock, face = slope(Joint(dip, east - turn, (0, 0, 1)), Joint(dip, east + turn, (0, 0, 1)), face=75)
	(wedge,) = [one for one in polytope.keyBlocks(rock, [face, (0, 0, 1)], friction) if one.mode == 'slides on two faces']
	first, second = (Joint(dip, east + sign * turn, (0, 0, 0)).normal for sign in (-1, 1))
	line = np.cross(first, second)
	line /= np.linalg.norm(line) * -np.sign(line[2])
	plunge = asin(-line[2])
	assert wedge.direction == pytest.approx(line)
	between = pi - acos(first @ second)  # of the planes, in the rock of the wedge
	expected = tan(friction) / tan(plunge) / sin(between / 2)  # β = 90°: the wedge is upright
	assert wedge.factorOfSafety == pytest.approx(expected)
	assert sorted(wedge.joints) == [0, 1]


def roof(dip):
	"""Four joints that meet above a tunnel's roof: a pyramid."""
	joints = [Joint(radians(dip), azimuth, (2 * sin(azimuth), 2 * cos(azimuth), -5)) for azimuth in (0, pi / 2, pi, 3 * pi / 2)]
	return polytope.jointedRock(box, half, joints)


def testRoof():
	"""A pyramid that narrows upwards falls; one that widens upwards cannot leave the roof."""
	(block,) = polytope.keyBlocks(roof(70), (0, 0, -1), radians(40))
	assert block.mode == 'falls' and block.factorOfSafety == 0 and block.joints == ()
	assert block.volume == pytest.approx(16 * 2 * tan(radians(70)) / 3)
	assert block.direction == pytest.approx((0, 0, -1))
	joints = [Joint(radians(70), azimuth, (-sin(azimuth), -cos(azimuth), -5)) for azimuth in (0, pi / 2, pi, 3 * pi / 2)]
	tapered = polytope.jointedRock(box, half, [*joints, Joint(0, 0, (0, 0, 0))])
	assert not polytope.keyBlocks(tapered, (0, 0, -1), radians(40))


def testABlockInARoofSlidesOnOneSide():
	"""A prism between a joint that dips at 80° and an overhanging one: it slides down the first."""
	joints = [Joint(radians(80), east, (-2, 0, -5)), Joint(radians(60), east, (2, 0, -5))]
	sides = [Joint(vertical, 0, (0, y, 0)) for y in (-3, 3)]
	rock = polytope.jointedRock(box, half, [*joints, *sides])
	assert rock.volumes.sum() == pytest.approx(4000)
	(block,) = polytope.keyBlocks(rock, (0, 0, -1), radians(30))
	assert block.mode == 'slides on one face' and block.joints == (0,)
	assert block.factorOfSafety == pytest.approx(tan(radians(30)) / tan(radians(80)))


def testReport():
	rock = polytope.jointedRock(
		box, half, [JointSet(0, 0, spacing=1, through=(0, 0, 0)), JointSet(vertical, east, spacing=20, through=(4, 0, 0))]
	)
	report = polytope.rockReport(rock)
	assert len(report.volumes) == 20 and report.volumes.sum() == pytest.approx(4000)
	assert report.flatness == pytest.approx([1 / 20] * 20)
	assert report.p32 == pytest.approx([9 / 10, 1 / 20])
	text = str(report)
	assert 'bodies            20, 4000 m³' in text and '1 : 20' in text and 'set 0 0.9, set 1 0.05' in text


def testReportOfDiscsCountsTheirOwnArea():
	rock = polytope.jointedRock(box, half, [JointSet(0.4, 1, p32=0.5, radius=3, fisher=50)], smallest=0, seed=1)
	assert polytope.rockReport(rock).p32 == pytest.approx([0.5], rel=0.02)


def testScanLine():
	rock = polytope.jointedRock(
		box, half, [JointSet(0, 0, spacing=1, through=(0, 0, 0.5)), Joint(0, 0, (0, 0, 0.1), radius=2)], incomplete='cut'
	)
	distances, joints = polytope.scanLine(rock, (0, 0, -4), (0, 0, 4))
	assert distances == pytest.approx(sorted([*np.arange(0.5, 8), 4.1])) and len(joints) == 9
	assert len(polytope.scanLine(rock, (3, 0, -4), (3, 0, 4))[0]) == 8, 'beside the disc'
	with pytest.raises(ValueError, match='^end:'):
		polytope.scanLine(rock, (0, 0, 0), (0, 0, 0))
	with pytest.raises(ValueError, match='^end: 9 of 14 m of the line lie in the rock'):
		polytope.scanLine(rock, (0, 0, -4), (0, 0, 10))


def testOtherThingsThanARockAreRefused():
	for function, arguments in (
		(polytope.rockReport, ()),
		(polytope.scanLine, ((0, 0, 0), (1, 0, 0))),
		(polytope.stereonet, ('net.png',)),
		(polytope.keyBlocks, ((0, 0, 1), 0.5)),
	):
		with pytest.raises(ValueError, match=r'^rock: must be what polytope.jointedRock\(…\) returns, got list'):
			function([1], *arguments)


def testStereonet(tmp_path):
	rock = polytope.jointedRock(
		box, half, [JointSet(radians(30), 1, spacing=2), JointSet(radians(80), 3, spacing=2, exponential=True, fisher=100)]
	)
	dips, directions = polytope.stereonet(rock, tmp_path / 'net.png')
	assert (tmp_path / 'net.png').read_bytes().startswith(b'\x89PNG')
	assert dips[rock.sets == 0] == pytest.approx(radians(30)) and directions[rock.sets == 0] == pytest.approx(1)
	with pytest.raises(ValueError, match='^path:'):
		polytope.stereonet(rock, 3)


@pytest.mark.parametrize(
	'arguments, named',
	[
		({'free': (1, 1, 0)}, 'free'),
		({'free': (0, 0, 0)}, 'free'),
		({'free': 'roof'}, 'free'),
		({'frictionAngle': -0.1}, 'frictionAngle'),
		({'frictionAngle': [0.5]}, 'frictionAngle'),
		({'frictionAngle': [0.5] * 9}, 'frictionAngle'),
		({'frictionAngle': 35}, 'frictionAngle'),
		({'cohesion': 'none'}, 'cohesion'),
		({'density': 0}, 'density'),
		({'gravity': (0, 0, 0)}, 'gravity'),
	],
)
def testWrongArgumentsAreRefused(arguments, named):
	with pytest.raises(ValueError, match=f'^{named}:'):
		polytope.keyBlocks(**{'rock': roof(70), 'free': (0, 0, -1), 'frictionAngle': 0.6, **arguments})
