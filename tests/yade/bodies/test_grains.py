# SPDX-License-Identifier: GPL-2.0-or-later
"""Random grains have the extents asked for, a sample meets its sieve curve, and bodies of a cloud are inside the box and apart."""

import math
import sys

import numpy as np
import pytest
import scipy
import yade
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, O, Quaternion, RockJointMat, polytope

shapesModule = sys.modules['yade.polytope.bodies.grainShapes']


@pytest.fixture(autouse=True)
def material():
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6))


def corners(body):
	return np.array([body.state.pos + body.state.ori * corner for corner in body.shape.vertices], float)


@pytest.mark.parametrize('vertices', [4, 8, 14, 60])
@pytest.mark.parametrize('elongation, flatness', [(1, 1), (0.5, 0.3)])
def testExtentsOfAGrain(vertices, elongation, flatness):
	for seed in range(5):
		grain = polytope.randomGrain(0.02, elongation, flatness, vertices, seed)
		assert np.ptp(corners(grain), axis=0) == pytest.approx([0.02 / elongation, 0.02, 0.02 * flatness], rel=1e-12)
		assert len(grain.shape.vertices) == vertices, 'all lie on an ellipsoid'


def testSeedDecides():
	one, same, other = (polytope.randomGrain(1, seed=seed).shape for seed in (1, 1, 2))
	assert list(one.vertices) == list(same.vertices) != list(other.vertices)
	assert polytope.randomGrain(1).shape.volume != polytope.randomGrain(1).shape.volume


def testGrainIsABodyLikeOthers():
	grain = polytope.randomGrain(0.1, fixed=True, center=(1, 2, 3), color=(1, 0, 0))
	assert list(grain.state.pos) == [1, 2, 3] and not grain.dynamic and list(grain.shape.color) == [1, 0, 0]


curve = [(0.002, 0), (0.004, 0.15), (0.008, 0.5), (0.016, 1)]


def sieved(monkeypatch, *arguments, **named):
	"""(sizes that grains were made with, masses): extents along y when a grain is made, before it is turned."""
	sizes, make = [], shapesModule.fromVertices
	monkeypatch.setattr(
		shapesModule, 'fromVertices', lambda points, **body: sizes.append(np.ptp(points, axis=0)[1]) or make(points, **body)
	)
	sample = polytope.grains(*arguments, **named)
	return np.array(sizes), np.array([float(body.state.mass) for body in sample]), sample


@pytest.mark.parametrize('mass, shape', [(0.05, {}), (0.3, {'elongation': (0.6, 1), 'flatness': (0.4, 0.8)}), (0.3, {'vertices': 8})])
def testSampleMeetsItsSieveCurve(mass, shape, monkeypatch):
	sizes, masses, sample = sieved(monkeypatch, curve, mass, seed=1, **shape)
	assert len(sample) > 100 and masses.sum() == pytest.approx(mass, rel=0.01)
	for opening, passing in curve:
		assert masses[sizes <= opening * (1 + 1e-9)].sum() / mass == pytest.approx(passing, abs=0.01)
	between = math.sqrt(0.004 * 0.008)
	assert masses[sizes < between].sum() / mass == pytest.approx(0.325, abs=0.04), 'a straight line over the logarithm of the size'


def testOrientationsAreRandom():
	sample = polytope.grains([(0.01, 0), (0.012, 1)], 2, elongation=0.5, flatness=0.5, seed=1)
	longest = []
	for body in sample:
		points = corners(body)
		longest.append(np.linalg.eigh(np.cov(points.T))[1][:, 2] ** 2)
	assert len(sample) > 300 and np.mean(longest, axis=0) == pytest.approx([1 / 3] * 3, abs=0.05)


def testNumbersFollowTheMasses():
	sample = polytope.grains([(0.01, 0), (0.02, 1)], 5, seed=2)
	masses = sorted(float(body.state.mass) for body in sample)
	half = np.searchsorted(np.cumsum(masses), sum(masses) / 2)
	assert len(masses) > 300 and half > 0.7 * len(masses), 'half of the mass is in few large grains'


def testTooFewGrainsForTheCurveAreRefused():
	with pytest.raises(ValueError, match=r'^mass: .* too few grains .*\(sizes are in m: were mm meant\?\); take more'):
		polytope.grains([(31.5, 0), (63, 1)], mass=3, seed=1)
	with pytest.raises(ValueError, match=r'^mass: .* too few grains .*: a grain of 0.016 m has about 0.0053 kg; take more'):
		polytope.grains(curve, 0.001, seed=1)
	with pytest.raises(ValueError, match=r'a grain of 16 m has about 5.3e\+06 kg'):  # a curve in millimetres
		polytope.grains([(1000 * size, passing) for size, passing in curve], 0.5, seed=1)


def brick(length, width, height, place):
	return polytope.cuboid(place, (length / 2, width / 2, height / 2), orientation=Quaternion((1, 2, 3), 0.7))


def testGrainsOfGivenShapes():
	"""Bricks of two forms, given in metres, at some place and turned: their intermediate extent is the size, and the sample meets the curve."""
	sample = polytope.grains(curve, 0.3, seed=1, shapes=[brick(3, 2, 1, (5, 5, 5)), brick(1, 1.5, 4, (0, 0, 9))], color=(1, 0, 0))
	sizes, forms = [], set()
	for body in sample:
		extents = np.sort(np.ptp(np.array(body.shape.vertices, float), axis=0))  # along the principal axes
		sizes.append(extents[1])
		forms.add(tuple(np.round(extents / extents[1], 6)))
		assert body.state.pos.norm() < 1e-12 and tuple(body.shape.color) == (1, 0, 0)
	assert forms == {(0.5, 1, 1.5), (round(1 / 1.5, 6), 1, round(4 / 1.5, 6))}
	sizes, masses = np.array(sizes), np.array([float(body.state.mass) for body in sample])
	assert masses.sum() == pytest.approx(0.3, rel=0.01)
	for opening, passing in curve:
		assert masses[sizes <= opening * (1 + 1e-9)].sum() / 0.3 == pytest.approx(passing, abs=0.01)
	longest = [
		np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)[:, np.argmax(np.ptp(body.shape.vertices, axis=0))] ** 2
		for body in sample
	]
	assert np.mean(longest, axis=0) == pytest.approx([1 / 3] * 3, abs=0.08), 'turned at random'


@pytest.mark.parametrize('sides', [(1, 2, 3), (3, 1, 2), (2, 3, 1), (2, 1, 3), (1, 3, 2), (3, 2, 1)])
def testGrainsAreNoMirrorImages(sides):
	"""Cubes at the corners of a tetrahedron with edges of different lengths."""
	places = np.vstack([np.zeros(3), np.diag(sides)])
	parts = [polytope.cuboid(tuple(place), (0.2, 0.2, 0.2)) for place in places]
	for grain in polytope.grains([(0.01, 0), (0.02, 1)], 0.05, seed=1, shapes=[parts]):
		first, *others = (np.array(part.state.pos, float) for part in grain)
		assert np.linalg.det([other - first for other in others]) > 0


def testGrainsOfPartsMakeClumps():
	"""An L of two boxes that overlap: it counts as their union, its parts lie to each other as they were given, and a cloud of clumps has
	them apart."""
	parts = [polytope.cuboid((10, 0, 0), (3, 1, 1)), polytope.cuboid((8, 1, 0), (1, 2, 1))]  # 24 + 16 - 8 m³, 6 m × 4 m × 2 m
	sample = polytope.grains([(0.01, 0), (0.02, 1)], 0.2, seed=3, shapes=[parts])
	assert len(sample) > 20 and all(len(one) == 2 for one in sample)
	for one, other in sample:
		assert float(one.shape.volume / other.shape.volume) == pytest.approx(24 / 16)
		scale = float(one.shape.volume / 24) ** (1 / 3)
		assert float((one.state.pos - other.state.pos).norm()) == pytest.approx(scale * 5**0.5)
		assert scale * 3 < 0.02, 'the intermediate extent along principal axes, which are not those of the boxes'
	polytope.cloud((0, 0, 0), (0.15, 0.15, 0.15), sample, seed=1)
	numbers = [polytope.clump(one)[0] for one in sample]
	assert sum(float(O.bodies[number].state.mass) for number in numbers) == pytest.approx(0.2, rel=0.01)


@pytest.mark.parametrize('sieves', [curve, [(0.01, 0), (0.012, 1)]])
@pytest.mark.parametrize('shapes', [None, [brick(3, 2, 1, (0, 0, 0)), brick(1, 1.5, 4, (0, 0, 9))]])
def testSampleOfANumberOfGrainsMeetsTheCurve(sieves, shapes, monkeypatch):
	sizes, masses, sample = sieved(monkeypatch, sieves, number=2000, seed=1, shapes=shapes, elongation=(0.6, 1))
	assert len(sample) == pytest.approx(2000, rel=0.05)
	for opening, passing in sieves if shapes is None else ():
		assert masses[sizes <= opening * (1 + 1e-9)].sum() / masses.sum() == pytest.approx(passing, abs=0.01)


def testMassOrNumberOneOfThem():
	for given in ({}, {'mass': 1, 'number': 10}):
		with pytest.raises(ValueError, match='^mass: give the mass of all grains'):
			polytope.grains(curve, **given)
	for wrong in (0, -1, 2.5, True, 10**8, '3'):
		with pytest.raises(ValueError, match='^number: must be a whole number from 1 to 10,000,000, got '):
			polytope.grains(curve, number=wrong)
	with pytest.raises(ValueError, match='^number: .* too few grains .*; take more'):
		polytope.grains(curve, number=3, seed=1)


def testMoreGrainsThanAnyMemoryHoldsAreRefused():
	"""A mass in milligrams, sizes in metres: it went on without end."""
	with pytest.raises(
		ValueError, match=r'^mass: 1e\+09 kg of these sizes are more than .* grains; at most 10,000,000 are made \(sizes in m, mass in kg\)'
	):
		polytope.grains([(0.01, 0), (0.02, 1)], 1e9)


@pytest.mark.parametrize('seed', ['x', -1, 1.5, True])
def testSeedThatIsNoneIsNamed(seed):
	one = [polytope.cuboid((0, 0, 0), (0.1, 0.1, 0.1))]
	for make in (
		lambda: polytope.randomGrain(1, seed=seed),
		lambda: polytope.grains(curve, 0.5, seed=seed),
		lambda: polytope.cloud((0, 0, 0), (1, 1, 1), one, seed=seed),
		lambda: polytope.voronoi(((0, 0, 0), (1, 1, 1)), 3, seed=seed),
	):
		with pytest.raises(ValueError, match='^seed: must be a whole number from 0 on, got '):
			make()


def testEachGrainsVolumeIsAskedForOnce():
	"""The choice of 3000 grains' sizes: summed anew for each grain, volumes made its time grow with the square of the number."""
	asked = []

	class Shape:
		@property
		def volume(self):
			asked.append(self)
			return 0.5

	grains = sys.modules['yade.polytope.bodies.grains']
	shapes, sizes = grains._fraction(np.random.default_rng(1), 1, 1.1, 0.5 * 1.15 * 3000, Shape)
	assert len(shapes) == len(sizes) > 2500
	assert len(asked) <= len(shapes) + 1


# ------------------------------------------------------------------------------------------------ cloud


def testCloudIsInsideAndApart():
	bodies = polytope.cloud((0, 0, 0), (0.1, 0.1, 0.15), polytope.grains([(0.004, 0), (0.03, 1)], 0.8, elongation=(0.5, 1), seed=1), seed=1)
	everywhere = np.concatenate([corners(body) for body in bodies])
	assert (everywhere >= 0).all() and (everywhere <= (0.1, 0.1, 0.15)).all()
	places = np.array([body.state.pos for body in bodies], float)
	reach = np.array([np.linalg.norm(np.array(body.shape.vertices, float), axis=1).max() for body in bodies])
	near = 0
	for k, body in enumerate(bodies):
		for j in np.nonzero(np.linalg.norm(places[:k] - places[k], axis=1) < reach[:k] + reach[k])[0]:
			near += 1
			assert not polytope.contact(body, bodies[j]).inContact
	assert near > 100, 'bodies are nearer than their balls'
	assert all(body.state.refPos == body.state.pos for body in bodies)


def testCloudOfGrainsAndSpheres():
	"""They are apart by closed forms: spheres by their centres, a sphere and a grain by the grain's corners, edges and faces, which a fine
	net of points stands for."""
	stones = polytope.grains([(0.01, 0), (0.02, 1)], number=30, seed=1)
	bodies = polytope.cloud((0, 0, 0), (0.1, 0.1, 0.1), [*stones, *(yade.utils.sphere((0, 0, 0), 0.006) for _ in range(60))], seed=1)
	spheres = [body for body in bodies if isinstance(body.shape, yade.Sphere)]
	places = np.array([body.state.pos for body in spheres], float)
	assert len(spheres) == 60 and (places >= 0.006).all() and (places <= 0.094).all()
	assert min(np.linalg.norm(places[:k] - places[k], axis=1).min() for k in range(1, 60)) > 0.012
	for stone in stones:
		tops = corners(stone)
		weights = np.random.default_rng(1).dirichlet(np.full(len(tops), 0.05), 4000)  # most are at corners, edges and faces
		apart = scipy.spatial.cKDTree(weights @ tops).query(places)[0].min()
		assert apart > 0.006
	nearest = min(scipy.spatial.cKDTree(corners(stone)).query(places)[0].min() for stone in stones)
	assert nearest < 0.0075, 'they fill the box: some are close'


def testCloudThatIsTooDense():
	sample = polytope.grains([(0.009, 0), (0.01, 1)], 0.36, seed=1)
	with pytest.raises(ValueError, match=f'upper: .* of {len(sample)} bodies'):
		polytope.cloud((0, 0, 0), (0.06, 0.06, 0.06), sample, seed=1)
	with pytest.raises(ValueError, match='upper: the box is smaller'):
		polytope.cloud((0, 0, 0), (0.06, 0.06, 0.001), sample)


def testCloudFallsAndComesToRest():
	O.bodies.append(polytope.plates((0, 0, 0), (0.06, 0.06, 0.2), without='+z'))
	O.bodies.append(polytope.cloud((0, 0, 0), (0.06, 0.06, 0.15), polytope.grains([(0.012, 0), (0.02, 1)], 0.1, seed=3), seed=3))
	O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
	O.materials[0].normalStiffness = O.materials[0].shearStiffness = 1e5
	while O.time < 0.8:
		O.step()
	grains = [body for body in O.bodies if body.dynamic]
	assert all(0 < body.state.pos[2] < 0.1 for body in grains) and max(body.state.vel.norm() for body in grains) < 0.1


@pytest.mark.parametrize(
	'build, name',
	[
		(lambda: polytope.randomGrain(0), 'size'),
		(lambda: polytope.randomGrain(1, elongation=1.1), 'elongation'),
		(lambda: polytope.randomGrain(1, flatness=0), 'flatness'),
		(lambda: polytope.randomGrain(1, vertices=3), 'vertices'),
		(lambda: polytope.grains([(1, 0)], 1), 'curve'),
		(lambda: polytope.grains([(2, 0), (1, 1)], 1), 'curve'),
		(lambda: polytope.grains([(1, 0.1), (2, 1)], 1), 'curve'),
		(lambda: polytope.grains([(1, 0), (2, 100)], 1), 'curve'),
		(lambda: polytope.grains(7, 1), 'curve'),
		(lambda: polytope.grains(curve, -1), 'mass'),
		(lambda: polytope.grains(curve, 1, elongation=(1, 0.5)), 'elongation'),
		(lambda: polytope.grains(curve, 1, shapes=[]), 'shapes'),
		(lambda: polytope.grains(curve, 1, shapes=['a.stl']), 'shapes'),
		(lambda: polytope.grains(curve, 1, shapes=[[polytope.polygon([(0, 0), (1, 0), (0, 1)])]]), 'shapes'),
		(lambda: polytope.cloud((0, 0, 0), (1, 1, 1), [1]), 'bodies'),
		(lambda: polytope.cloud((0, 0, 0), (1, 1, 1), [yade.utils.facet([(0, 0, 0), (1, 0, 0), (0, 1, 0)])]), 'bodies'),
		(lambda: polytope.cloud((0, 0, 0), (1, 1), []), 'upper'),
	],
)
def testRefusals(build, name):
	with pytest.raises(ValueError, match=f'^{name}: '):
		build()


def testUnknownArgument():
	with pytest.raises(TypeError, match="^grains: there is no argument 'colour'"):
		polytope.grains(curve, 1, colour=1)
