# SPDX-License-Identifier: GPL-2.0-or-later
"""Input in other units, in other places, or of another dimension than the scene: warned of or refused, with the remedy."""

import warnings

import pytest
from scenes import joint
from yade import O, polytope
from yade.polytope.strengthReduction import StrengthReduction

box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
steel = dict(area=4.9e-4, youngsModulus=2e11)


def blocks():
	"""Two that can move on a fixed one."""
	joint(normalStiffness=1e9, shearStiffness=1e9)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True))
	for z in (0.5, 1.5):
		O.bodies.append(polytope.cuboid((0, 0, z), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()


def silent(act):
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		return act()


@pytest.mark.parametrize(
	'change, message',
	[
		({'area': 490}, r'^area: 490 m² .*490 mm² are 0.00049 m²'),
		({'youngsModulus': 200}, r'^youngsModulus: 200 Pa .* 200 GPa are 2e\+11 Pa'),
		({'youngsModulus': 2e5}, r'^youngsModulus: 200000 Pa .*in MPa\? 200000 MPa are 2e\+11 Pa'),
	],
)
def testABoltInOtherUnits(change, message):
	blocks()
	silent(lambda: polytope.bolt((0, 0, 1.9), (0, 0, -0.9), **steel))
	with pytest.warns(UserWarning, match=message):
		polytope.bolt((0.2, 0, 1.9), (0.2, 0, -0.9), **{**steel, **change})


def testWaterFarAboveTheGround():
	blocks()
	silent(lambda: polytope.water(level=4))
	O.reset()
	blocks()
	with pytest.warns(UserWarning, match='^level: 100 m is above all bodies, which reach up to 2 m'):
		polytope.water(level=100)


def testAnOpeningOutsideTheRegion():
	silent(lambda: polytope.regionWithout(box, [1] * 6, [(box, [0.5] * 6)]))
	with pytest.warns(UserWarning, match=r'^openings: opening 1 \(counted from 0\) is wholly outside the region'):
		normals, _ = polytope.regionWithout(box, [1] * 6, [(box, [0.5] * 6), (box, [-9, 10, 1, 1, 1, 1])])
	assert len(normals) > 1


def testARecordInAnotherUnit():
	silent(lambda: polytope.velocityHistory([0, 0.3, 0], times=0.1, unit=9.81))
	silent(lambda: polytope.velocityHistory([0, 90, 0], times=0.1, kind='velocity'))
	with pytest.warns(UserWarning, match=r'^record: its largest acceleration is 294 m/s², 30 g'):
		polytope.velocityHistory([0, 30, 0], times=0.1, unit=9.81)


def testAPointOnAFaceOfTwoBlocks():
	blocks()
	silent(lambda: polytope.history({'in': (0, 0, 0.9)}))
	with pytest.warns(
		UserWarning, match=r'^points: on: \(0.0, 0.0, 1.0\) is on a face of bodies 1, 2, and moves with body 1; give a point inside'
	):
		polytope.history({'on': (0, 0, 1)})


def testALiningOfTheOtherDimension():
	blocks()
	before = len(O.bodies)
	with pytest.raises(ValueError, match='^points: have two components.*give points of three, and the axis'):
		polytope.lining([(0, 3), (1, 3)], thickness=0.1, youngsModulus=3e10)
	assert len(O.bodies) == before
	O.reset()
	joint()
	O.bodies.append(polytope.polygon([(0, 0), (1, 0), (1, 1)]))
	O.engines = polytope.engines()
	with pytest.raises(ValueError, match='^points: have three components.*give points of two'):
		polytope.lining([(0, 3, 0), (1, 3, 0)], thickness=0.1, youngsModulus=3e10, axis=(0, 0, 1))


def testMessagesNameArgumentAndRemedy(tmp_path):
	blocks()
	with pytest.raises(ValueError, match=r'^bodies: must be a sequence of ids, \[1\] for one body'):
		StrengthReduction(1)
	with pytest.raises(ValueError, match='^unbalanced: must be above 0, got 0'):
		polytope.settle(unbalanced=0)
	rock = polytope.jointedRock(box, [1] * 6, [polytope.Joint(0, 0, (0, 0, 0))])
	with pytest.raises(ValueError, match=r"^path: its name must end in .png, .svg, .pdf, got '"):
		polytope.stereonet(rock, tmp_path / 'net.foo')
	with pytest.raises(FileNotFoundError, match='^path: there is no folder'):
		polytope.stereonet(rock, tmp_path / 'none/net.png')
