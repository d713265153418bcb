# SPDX-License-Identifier: GPL-2.0-or-later
"""Linings against the theory of beams and rings: cantilever, ring under pressure, roof block on a beam, adhesion; refused arguments."""

from math import cos, inf, nan, pi, sin

import numpy as np
import pytest
from scenes import joint
from yade import FrictMat, O, PolytopeBonds, RockJointMat, Vector3, polytope
from yade.polytope import Adhesion

g, density = 9.81, 2400.0
E, ratio, thickness, width = 3e10, 0.2, 0.3, 0.8
area, inertia = thickness * width, width * thickness**3 / 12
beam = dict(thickness=thickness, youngsModulus=E, poissonsRatio=ratio, width=width)
shearStiffness = 5 / 6 * E / (2 * (1 + ratio)) * area

plane = dict(ids=['2-D', '3-D'], argvalues=[2, 3])


def along(points, dimension):
	"""Points of the xy plane, as two-dimensional ones, or turned into the xz plane with the axis that belongs to it."""
	return dict(points=points) if dimension == 2 else dict(points=[(x, 0, y) for x, y in points], axis=(0, -1, 0))


def vectorOf(x, y, dimension):
	return Vector3(x, y, 0) if dimension == 2 else Vector3(x, 0, y)


def start(dimension, gravity=g, **material):
	joint(density=density, normalStiffness=1e10, shearStiffness=5e9, **material)
	O.engines = polytope.engines(gravity=vectorOf(0, -gravity, dimension))


def block(low, high, dimension, **body):
	"""A rectangle of the plane, as wide as the lining."""
	if dimension == 2:
		return O.bodies.append(polytope.polygon([low, (high[0], low[1]), high, (low[0], high[1])], thickness=width, **body))
	middle, half = (np.array(low) + high) / 2, (np.array(high) - low) / 2
	return O.bodies.append(polytope.cuboid((middle[0], 0, middle[1]), (half[0], width / 2, half[1]), **body))


# ------------------------------------------------------------------------------------------------ beams


@pytest.mark.parametrize('dimension', **plane)
@pytest.mark.parametrize('side', ['left', 'right', 'middle'])
def testACantileverBendsAsABeamUnderItsWeightAndALoadAtItsEnd(dimension, side):
	start(dimension)
	number, h, load = 10, 0.4, 2e4
	made = polytope.lining(**along([(0, 0), ((number + 1) * h, 0)], dimension), segmentLength=h, side=side, **beam)
	O.bodies[made.ids[0]].dynamic = False  # clamped at its centre
	tip = O.bodies[made.ids[-1]]
	first = Vector3(tip.state.pos)
	O.forces.setPermF(tip.id, vectorOf(0, -load, dimension))
	polytope.settle()
	arms = h * (number - np.arange(number))  # from each joint to the free end
	q = density * g * area
	forces = made.forces
	assert forces.distances == pytest.approx(h * np.arange(1, number + 1))
	assert forces.moment == pytest.approx(q * arms**2 / 2 + load * (arms - h / 2), rel=1e-3)  # tension on top, the left of +x
	assert forces.shear == pytest.approx(-(q * arms + load), rel=1e-3)  # dM/ds; the part behind pulls down
	assert abs(forces.normal).max() < 1e-2 * load  # that of the slope
	span = number * h  # from clamp to the last segment's centre; half a segment of weight beyond it
	end = q * h / 2
	deflection = (load + end) * span**3 / (3 * E * inertia) + end * h / 4 * span**2 / (2 * E * inertia) + q * span**4 / (8 * E * inertia)
	deflection += ((load + end) * span + q * span**2 / 2) / shearStiffness
	assert (first - tip.state.pos).norm() == pytest.approx(deflection, rel=1e-2)


def roof(dimension, span=4.0, height=0.5, half=0.25):
	"""A lining on two narrow supports, one of them smooth so that no thrust arises, and a block that lies loose on its middle."""
	start(dimension)
	smooth = RockJointMat(density=density, normalStiffness=1e10, shearStiffness=5e9, frictionAngle=0)
	block((-span / 2 - 0.01, -0.5), (-span / 2 + 0.01, 0), dimension, fixed=True)
	block((span / 2 - 0.01, -0.5), (span / 2 + 0.01, 0), dimension, fixed=True, material=smooth)
	made = polytope.lining(**along([(-span / 2 - 0.1, 0), (span / 2 + 0.1, 0)], dimension), segmentLength=0.2, **beam)
	return made, O.bodies[block((-half, thickness), (half, thickness + height), dimension)]


@pytest.mark.parametrize('dimension', **plane)
def testALiningUnderALooseRoofBlockIsASimplySupportedBeam(dimension):
	span, half = 4.0, 0.25
	made, loose = roof(dimension, span, half=half)
	polytope.settle(elastic=False)  # the smooth support slips
	q, weight = density * g * area, float(loose.state.mass) * g
	x = made.forces.distances - 0.1 - span / 2  # from the middle of the span
	assert np.array(made.forces.points)[:, 0] == pytest.approx(x, abs=1e-3)
	reaction = (weight + q * (span + 0.2)) / 2
	shear = np.sign(x) * (reaction - q * (span / 2 + 0.1 - abs(x)))
	moment = -(reaction * (span / 2 - abs(x)) - q * (span / 2 + 0.1 - abs(x)) ** 2 / 2)
	outside = (abs(x) > half) & (abs(x) < span / 2 - 0.02)
	assert outside.sum() >= 16
	assert made.forces.moment[outside] == pytest.approx(moment[outside], rel=1e-2)
	assert made.forces.shear[outside] == pytest.approx(shear[outside], rel=1e-2)
	# below the block: between a load in its middle and one at both its edges
	within = ~outside & (abs(x) < half)
	assert within.any() and (abs(made.forces.moment[within]) < abs(moment[within]) * 1.01).all()
	assert (abs(made.forces.moment[within]) > abs(moment[within]) - weight * half / 2 * 1.01).all()


@pytest.mark.parametrize('part, holds', [(1.05, True), (0.95, False)])
def testALiningCracksWhereItsEdgeReachesTheTensileStrength(part, holds):
	made, _ = roof(2)
	polytope.settle(elastic=False)
	strength = abs(made.forces.moment).max() * thickness / 2 / inertia
	for one in made.bonds:
		one.tensileStrength = part * strength
	O.run(20, wait=True)
	assert all(one.intact for one in made.bonds) == holds == (not np.isnan(made.forces.moment).any())


# ------------------------------------------------------------------------------------------------ rings


def ringPoints(number, radius):
	return [(radius * cos(a), radius * sin(a)) for a in 2 * pi * (np.arange(number) + 0.5) / number]


@pytest.mark.parametrize('dimension', **plane)
def testARingUnderPressureHasTheNormalForceOfTheBoilerFormula(dimension):
	"""N = p R with the radius to which the pressure acts, no shear and moment; and it gets smaller by p R r/(E A)."""
	start(dimension, gravity=0)
	number, radius, pressure = 24, 3.0, 2e5
	made = polytope.lining(**along(ringPoints(number, radius), dimension), closed=True, **beam)
	side = 2 * radius * sin(pi / number)
	places = [Vector3(O.bodies[k].state.pos) for k in made.ids]
	for k, place in zip(made.ids, places):
		O.forces.setPermF(k, -pressure * side * width * place.normalized())
	polytope.settle()
	forces = made.forces
	assert forces.normal == pytest.approx(np.full(number, -pressure * radius * width), rel=1e-3)
	assert abs(forces.shear).max() < 1e-3 * abs(forces.normal).max()
	assert abs(forces.moment).max() < 1e-3 * abs(forces.normal).max() * thickness
	shrunk = np.mean([place.norm() - O.bodies[k].state.pos.norm() for k, place in zip(made.ids, places)])
	middle = (radius - thickness / 2 / cos(pi / number)) * cos(pi / number)  # of the segments
	assert shrunk == pytest.approx(pressure * radius * width * middle / (E * area), rel=2e-2)


@pytest.mark.parametrize('dimension', **plane)
def testARingOpensByItsBendingUnderTwoOppositeForces(dimension):
	"""Thin ring of radius r, forces P at the ends of a diameter: M = P r/π under them with tension inside, P r (1/2 - 1/π) at right angles
	with tension outside."""
	start(dimension, gravity=0)
	number, radius, load = 48, 3.0, 1e4
	made = polytope.lining(**along(ringPoints(number, radius), dimension), side='middle', closed=True, **beam)
	for k in (number // 4 - 1, 3 * number // 4 - 1):  # segments at top and bottom
		place = O.bodies[made.ids[k]].state.pos
		O.forces.setPermF(made.ids[k], -load * place.normalized())
	polytope.settle(damping=0.5)
	angles = np.arctan2(*(made.forces.points[:, k] for k in (1 if dimension == 2 else 2, 0)))
	exact = load * radius * (1 / pi - abs(np.cos(angles)) / 2)
	assert made.forces.moment == pytest.approx(exact, abs=0.01 * load * radius / pi)


@pytest.mark.parametrize('dimension', **plane)
def testRadialBlocksPressARing(dimension):
	"""Blocks that can move along their radius alone, each pushed by F on a segment: N = F/(2 sin(half the angle between them))."""
	start(dimension, gravity=0)
	number, radius, push = 12, 3.0, 3e5
	points = ringPoints(number, radius)
	made = polytope.lining(**along(points, dimension), closed=True, **beam)
	for a, b in zip(points, points[1:] + points[:1], strict=True):
		corners = [np.array(p) * s for p in (a, b) for s in (1, 1.2)]
		middle = np.mean(corners, axis=0)
		corners = [middle + (p - middle) * 0.98 for p in corners]  # apart from each other
		inward = -middle / np.linalg.norm(middle)
		corners = [p + inward * (inward @ ((np.array(a) + b) / 2 - (corners[0] + corners[2]) / 2)) for p in corners]
		if dimension == 2:
			rock = polytope.polygon(corners, thickness=width)
		else:
			rock = polytope.fromVertices([(x, y, z) for x, z in corners for y in (-width / 2, width / 2)])
		O.bodies.append(rock)
		rock.state.blockedDOFs = 'XYZ'
		O.forces.setPermF(rock.id, push * vectorOf(*inward, dimension))
	polytope.settle()
	assert made.forces.normal == pytest.approx(np.full(number, -push / (2 * sin(pi / number))), rel=1e-2)


# ------------------------------------------------------------------------------------------------ adhesion


@pytest.mark.parametrize('dimension', **plane)
@pytest.mark.parametrize('part, holds', [(1.05, True), (0.95, False)])
def testALiningHangsOnARoofByItsAdhesion(dimension, part, holds):
	"""A lining of weight ρ g t per area, below a fixed roof."""
	start(dimension)
	block((-1, 0), (1, 1), dimension, fixed=True)
	adhesion = Adhesion(part * density * g * thickness, 1e6)
	made = polytope.lining(**along([(-1, 0), (1, 0)], dimension), side='right', segmentLength=0.5, adhesion=adhesion, **beam)
	assert len(made.adhesion) == 4 and made.adhesion[0].area == pytest.approx(0.5 * width)
	height = [O.bodies[k].state.pos[1 if dimension == 2 else 2] for k in made.ids]
	polytope.settle()
	assert sum(one.force.norm() for one in made.adhesion) == pytest.approx(density * g * area * 2, rel=1e-3)
	O.run(2000, wait=True)
	fallen = [before - O.bodies[k].state.pos[1 if dimension == 2 else 2] for k, before in zip(made.ids, height)]
	assert (max(fallen) < 1e-5) == holds


@pytest.mark.parametrize('part, holds', [(1.05, True), (0.95, False)])
def testALiningHangsOnAWallByTheShearStrengthOfItsAdhesion(part, holds):
	"""One segment beside a fixed wall, as high as it is thick many times: the moment of its weight about the wall is left out by the share
	of bending."""
	start(2)
	block((0, 0), (1, 2), 2, fixed=True)
	made = polytope.lining([(0, 0), (0, 2)], side='left', adhesion=Adhesion(inf, part * density * g * thickness), **beam)
	(stuck,) = made.adhesion
	stuck.bendingShare, stuck.frictionAngle = 0, 0
	polytope.settle()
	O.run(2000, wait=True)
	assert stuck.intact == holds


# ------------------------------------------------------------------------------------------------ what a script may do with it


def testALiningOutlivesASavedScene(tmp_path):
	made, _ = roof(3)
	polytope.settle()
	before, file = made.forces, str(tmp_path / 'scene.yade.gz')
	O.save(file)
	O.reset()
	O.load(file)
	assert all(np.array_equal(old, new) for old, new in zip(before, made.forces))
	assert not polytope.check(O)


line = [(0, 0), (1, 0), (2, 0)]
refused = [
	(dict(points=[(0, 0)]), 'points: 2 at least'),
	(dict(points=line[:2], closed=True), 'points: 3 at least'),
	(dict(points=5), 'points: must be a sequence'),
	(dict(points=[(0, 0), (nan, 0)]), 'points: must be finite'),
	(dict(points=[(0, 0), (1, 0), (1, 0)]), 'points: point 1 and the next one are the same'),
	(dict(points=[(0, 0), (2, 0), (2, 2), (0, 0)], closed=True), 'the first one need not be given again'),
	(dict(points=[(0, 0), (2, 0), (0, 1)]), 'points: the line turns by 153°'),
	(dict(points=[(0, 0), (2, 0), (2, 0.2), (0, 0.2)], thickness=0.5), 'thickness: 0.5 m is too much for the bend'),
	(dict(points=[(0, 0, 0), (1, 0, 0)]), 'axis: must be given'),
	(dict(points=[(0, 0, 0), (1, 0, 0)], axis=(0, 0, 0)), 'axis: must not be zero'),
	(dict(points=[(0, 0, 0), (1, 0, 0)], axis=(1, 0, 1)), 'points: must lie in one plane'),
	(dict(axis=(0, 0, 1)), 'axis: is z'),
	(dict(thickness=0), 'thickness: must be positive'),
	(dict(youngsModulus=inf), 'youngsModulus: must be positive and finite'),
	(dict(poissonsRatio=0.6), 'poissonsRatio: must be above -1'),
	(dict(width='wide'), 'width: must be a number'),
	(dict(side='inside'), "side: must be 'left', 'right' or 'middle'"),
	(dict(closed=1), 'closed: must be True or False'),
	(dict(segmentLength=0), 'segmentLength: must be positive'),
	(dict(tensileStrength=-1), 'tensileStrength: must be positive'),
	(dict(shearStrength=0), 'shearStrength: must be positive'),
	(dict(adhesion=1e6), 'adhesion: must be a polytope.Adhesion'),
	(dict(adhesion=Adhesion(0, 1)), 'adhesion: tensileStrength: must be positive'),
	(dict(adhesion=Adhesion(1, 1, gap=-1)), 'adhesion: its gap must be a finite distance'),
	(dict(adhesion=Adhesion(1, 1), material='spheres'), 'adhesion: needs stiffnesses per area, but the material of the lining'),
]


@pytest.mark.parametrize('changed, message', refused)
def testBadArgumentsAreRefusedAndTheSceneStays(changed, message):
	start(2)
	O.materials.append(FrictMat(label='spheres'))
	block((0, -1), (2, 0), 2, fixed=True, material=0)
	engines, before = list(O.engines), len(O.bodies)
	with pytest.raises(ValueError) as error:
		polytope.lining(**{**beam, 'points': line, 'material': 0, **changed})
	assert message in str(error.value)
	assert len(O.bodies) == before and len(O.engines) == len(engines) and polytope.bonds() is None


def testEnginesComeFirstAndUnknownArgumentsAreNamed():
	joint()
	with pytest.raises(ValueError, match='engines: set O.engines first'):
		polytope.lining(line, **beam)
	with pytest.raises(TypeError, match="there is no argument 'fixed'"):
		polytope.lining(line, fixed=True, **beam)
	assert len(O.bodies) == 0


def testAnAdhesionThatFindsNoBlockWarns():
	start(2)
	block((0, -2), (2, -1), 2, fixed=True)
	with pytest.warns(UserWarning, match='adhesion: no segment has a face'):
		polytope.lining(line, adhesion=Adhesion(1e6, 1e6), **beam)
	assert len(polytope.lining([(0, -0.9), (2, -0.9)], adhesion=Adhesion(1e6, 1e6, gap=0.2), **beam).adhesion) == 1


def testALiningAfterAnExcavationAndWithoutItsEngine():
	start(2)
	gone, rock = block((0, 0), (2, 1), 2), block((0, 1), (2, 2), 2, fixed=True)
	O.bodies.erase(gone)
	made = polytope.lining([(0, 1), (2, 1)], side='right', segmentLength=0.5, adhesion=Adhesion(1e6, 1e6), **beam)
	assert {one.id1 for one in made.adhesion} == {rock} and len(made.adhesion) == 4
	O.bodies.erase(made.ids[1])
	O.step()
	assert np.isnan(made.forces.moment).tolist() == [True, True, False]
	O.engines = [one for one in O.engines if not isinstance(one, PolytopeBonds)]
	with pytest.raises(ValueError, match="engines: the scene lacks the lining's bonds"):
		made.forces  # noqa: B018
