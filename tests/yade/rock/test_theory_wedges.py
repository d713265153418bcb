# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms of the sliding wedge and the roof wedge against the published values, special cases and balances worked out another way."""

from math import atan, cos, degrees, isclose, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from boon2012.wedges import theory as wedges
from boon2012.wedges.theory import SlidingWedge

roofArea, roofWeight, inclination = 2 / sqrt(3), 0.5773502691896258 * 2000 * 10, radians(30)


def paperWedge():
	return SlidingWedge.ofDips(*(radians(x) for x in (40, 130, 60, 220)))


# ------------------------------------------------------------------------------------------------ sliding wedge


def testPapersWedge():
	wedge = paperWedge()
	assert degrees(wedge.plunge) == pytest.approx(37.0583, abs=5e-5)
	assert degrees(wedge.trend) == pytest.approx(155.848, abs=5e-4)
	assert wedge.reactions() == pytest.approx([0.673312, 0.242106], abs=5e-7)
	assert degrees(wedge.frictionAngle()) == pytest.approx(33.35722, abs=5e-6)
	assert degrees(wedge.lowerBound()[0]) == pytest.approx(31.07, abs=0.005)


def testForcesBalance():
	wedge = paperWedge()
	shears = 0.03, -0.05
	angle = wedge.frictionAngle(*shears)
	normals = wedge.reactions(*shears)
	along = [-sqrt((n * tan(angle)) ** 2 - t**2) * wedge.direction for n, t in zip(normals, shears, strict=True)]
	across = [t * direction for t, direction in zip(shears, wedge.transverse(), strict=True)]
	total = normals[0] * wedge.normalA + normals[1] * wedge.normalB + sum(along) + sum(across) + np.array([0, 0, -1])
	assert np.abs(total).max() < 1e-12


def testTransverseVectorsLieInTheirPlanes():
	wedge = paperWedge()
	for vector, normal in zip(wedge.transverse(), (wedge.normalA, wedge.normalB), strict=True):
		assert abs(vector.dot(normal)) < 1e-15 and abs(vector.dot(wedge.direction)) < 1e-15
		assert np.linalg.norm(vector) == pytest.approx(1) and vector[2] > 0


@pytest.mark.parametrize('dip,half', [(30, 40), (50, 60), (45, 20)])
def testSymmetricWedgeIsTheWedgeFormula(dip, half):
	"""tan φ = tan(plunge) sin β, with half the angle β between the planes (Hoek & Bray's wedge factor is 1/sin β)."""
	plunge, half = radians(dip), radians(half)
	line, across = np.array([cos(plunge), 0, -sin(plunge)]), np.array([0, 1, 0])
	up = np.cross(line, across)
	normals = [sin(half) * up + side * cos(half) * across for side in (1, -1)]
	assert SlidingWedge(*normals).frictionAngle() == pytest.approx(atan(tan(plunge) * sin(half)), abs=1e-12)


def testLowerBoundIsAMinimum():
	wedge = paperWedge()
	bound, *shears = wedge.lowerBound()
	assert bound < wedge.frictionAngle()
	for change in ((1e-3, 0), (-1e-3, 0), (0, 1e-3), (0, -1e-3)):
		assert wedge.frictionAngle(*(np.array(shears) + change)) > bound
	# the bound is a state of equilibrium: no shear force above the strength
	assert max(abs(np.array(shears)) / wedge.reactions(*shears)) <= tan(bound) + 1e-9


def testNothingStandsBelowTheLowerBound():
	wedge = paperWedge()
	bound = wedge.lowerBound()[0]
	for a in np.linspace(-0.5, 0.3, 17):
		for b in np.linspace(-0.5, 0.3, 17):
			if min(wedge.reactions(a, b)) > 0:
				assert wedge.frictionAngle(a, b) > bound - 1e-9


@pytest.mark.parametrize('dips', [(40, 130, 40, 130), (40, 90, 40, 270), (70, 130, 20, 140)])
def testWedgesThatDoNotSlideOnTwoPlanesAreRefused(dips):
	with pytest.raises(ValueError, match='^planes A and B: '):
		SlidingWedge.ofDips(*(radians(x) for x in dips))


def testShearThatOpensAFaceIsRefused():
	with pytest.raises(ValueError, match='^shearA, shearB: '):
		paperWedge().frictionAngle(3, 3)


@pytest.mark.parametrize('dip,direction', [(40, 130), (60, 220), (89, 359), (5, 10)])
def testDipAndNormal(dip, direction):
	normal = wedges.upwardNormal(radians(dip), radians(direction))
	for sign in (2, -3):
		assert [degrees(x) for x in wedges.dipOf(sign * normal)] == pytest.approx([dip, direction])


# ------------------------------------------------------------------------------------------------ roof wedge


@pytest.mark.parametrize('gravity,angle', [(10, 34.4019), (9.81, 34.3186)])
def testPapersRoofWedge(gravity, angle):
	horizontal = 3 * 5e4 * roofArea * cos(inclination)
	found = wedges.roofWedgeFrictionAngle(roofWeight * gravity / 10, horizontal, inclination)
	assert degrees(found) == pytest.approx(angle, abs=5e-5)


def testJointForcesHaveAHorizontalResultant():
	normal, shear = wedges.jointForces(5e4, roofArea, inclination)
	assert (normal, shear) == (pytest.approx(43301.27, abs=5e-3), pytest.approx(25000))
	assert normal * sin(inclination) == pytest.approx(shear * cos(inclination))


def testConstantNormalForceIsAnotherAnswer():
	normal, _ = wedges.jointForces(5e4, roofArea, inclination)
	assert degrees(wedges.roofWedgeConstantNormal(roofWeight, 3 * normal, inclination)) == pytest.approx(34.215, abs=5e-4)


@pytest.mark.parametrize('ratio', [0.2, 0.5, 1, 2])
def testSettlementUnderWeight(ratio):
	"""The settlement is compared with the forces on a face, summed up the long way."""
	normal, shear = (3 * force for force in wedges.jointForces(5e4, roofArea, inclination))
	kn, ks = 1e7, ratio * 1e7
	settlement = roofWeight / (kn * sin(inclination) ** 2 + ks * cos(inclination) ** 2)
	normal, shear = normal - kn * settlement * sin(inclination), shear + ks * settlement * cos(inclination)
	assert shear * cos(inclination) - normal * sin(inclination) == pytest.approx(roofWeight)  # vertical balance
	horizontal = wedges.horizontalForceUnderWeight(roofWeight, 3 * 5e4 * roofArea * cos(inclination), inclination, kn, ks)
	assert horizontal == pytest.approx(normal * cos(inclination) + shear * sin(inclination))
	assert wedges.roofWedgeFrictionAngle(roofWeight, horizontal, inclination) == pytest.approx(atan(shear / normal))


def testStressShareOfTouchingBlocks():
	for side in (0, 0.1, 1, 7):
		assert wedges.stressShare(roofArea, side) == pytest.approx((roofArea + 2 * side) / (roofArea + 3 * side))
	for share in (0.99, 0.9, 0.7):
		for angle in (pi / 6, pi / 5):
			for ratio in (1, 0.6):
				assert isclose(wedges.stressShare(2.0, wedges.sideAreaOf(2.0, share, angle, ratio), angle, ratio), share)


@pytest.mark.parametrize('ratio', [0.3, 1])
def testClosureOfTheJoints(ratio):
	"""Radial movement c and free settlement v of the wedge: normal and shear force of a joint balance σ_h A cos α."""
	kn, ks, angle = 1e7, ratio * 1e7, radians(25)
	closure = wedges.jointClosure(5e4, angle, kn, ks)
	rows = [[kn * cos(angle), -kn * sin(angle)], [ks * sin(angle), ks * cos(angle)]]  # stresses N, S from (c, v)
	toHorizontal, toVertical = np.array([cos(angle), sin(angle)]), np.array([-sin(angle), cos(angle)])
	matrix = np.array([toHorizontal @ rows, toVertical @ rows])
	assert closure == pytest.approx(np.linalg.solve(matrix, [5e4 * cos(angle), 0])[0])
