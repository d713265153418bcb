# SPDX-License-Identifier: GPL-2.0-or-later
"""Loading tests: stacks of cubes and sliding blocks against closed forms; small random samples, whose stresses are held and balanced."""

import math
from math import exp, radians, tan

import numpy as np
import pytest
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, NewtonIntegrator, O, Quaternion, RockJointMat, Vector3, Wall, polytope, utils

edge, friction = 0.1, radians(30)
perArea, perContact = 1e9, 1e7


def material(stiffness=perArea):
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness / 2, frictionAngle=friction))


def stack(number, gap, perAreaStiffness=True):
	"""Cubes on a regular lattice; along x and y with a gap."""
	material(perArea if perAreaStiffness else perContact)
	places = [np.array(place) for place in np.ndindex(*number)]
	spacing = np.array([edge + gap, edge + gap, edge])
	O.bodies.append([polytope.cuboid(tuple(spacing * (place + 0.5)), (edge / 2,) * 3) for place in places])
	O.engines = polytope.engines(gravity=(0, 0, 0), physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perAreaStiffness))
	return spacing * number


def periodicStack(gap):
	"""27 cubes in a periodic cell."""
	O.periodic = True
	extents = np.array([3 * (edge + gap)] * 2 + [3 * edge])
	O.cell.setBox(*extents.tolist())
	stack((3, 3, 3), gap)
	return extents


def grains(mass=0.008, seed=1, stiffness=1e11):
	material(stiffness)
	return polytope.grains([(0.005, 0), (0.006, 1)], mass=mass, elongation=(0.8, 1), flatness=(0.8, 1), vertices=10, seed=seed)


packings = {}
"""(periodic, mass) → (positions, orientations, corners) of the sample, which is packed once."""


def packed(periodic=False, mass=0.008):
	"""A sample packed at 100 kPa."""
	loose = grains(mass)
	if (periodic, mass) not in packings:
		length = (sum(body.shape.volume for body in loose) / 0.16) ** (1 / 3)
		sample = polytope.pack(loose, (0, 0, 0), (length,) * 3, stress=1e5, periodic=periodic, seed=1)
		assert 0.35 < sample.porosity < 0.55
		corners = (None, tuple(O.cell.hSize.diagonal())) if periodic else (tuple(sample.lower), tuple(sample.upper))
		packings[periodic, mass] = [(Vector3(O.bodies[k].state.pos), Quaternion(O.bodies[k].state.ori)) for k in sample.ids], corners
		return sample
	places, (lower, upper) = packings[periodic, mass]
	for body, (position, orientation) in zip(loose, places, strict=True):
		body.state.pos, body.state.ori = position, orientation
	if periodic:
		O.periodic = True
		O.cell.setBox(*upper)
	O.bodies.append(loose)
	return polytope.sample(lower=lower, upper=None if periodic else upper)


def noFailures():
	return all(functor.stats()['failures'] == 0 for functor in O.engines[2].geomDispatcher.functors)


def ofBoundary(sample):
	"""Mean stress by the forces of the boundary alone, −1/V Σ f ⊗ x: that of any stress field in equilibrium with them."""
	contacts, inside = polytope.arrays().contacts, np.isin(polytope.arrays().contacts.ids, sample.ids)
	outer = inside.sum(axis=1) == 1
	sign = np.where(inside[outer, 1], 1, -1)[:, None]
	return -(sign * contacts.forces[outer]).T @ contacts.points[outer] / sample.volume


@pytest.mark.parametrize('perAreaStiffness', (True, False))
def testOedometerOfAStackOfCubesIsTheirSpringsInARow(perAreaStiffness):
	"""m layers are m + 1 contacts in a row, those with the walls counted: ΔL = (m + 1) Δp / kₙ, or (m + 1) ΔF / (columns kₙ)."""
	extents = stack((2, 2, 3), 0.01, perAreaStiffness)
	test = polytope.oedometer(polytope.sample(lower=(0, 0, 0), upper=tuple(extents)))
	lengths = []
	for stress in (1e4, 2e4, 1e4):
		test.load(stress)
		lengths.append(test.sample.extents[2])
	force = 1e4 * extents[0] * extents[1] / 4
	expected = 4 * force / (perArea * edge**2 if perAreaStiffness else perContact)
	assert lengths[0] - lengths[1] == pytest.approx(expected, rel=2e-3) and lengths[2] - lengths[0] == pytest.approx(0, abs=2e-3 * expected)
	columns = test.columns
	assert columns['axialStress'][1:] == pytest.approx([1e4, 2e4, 1e4], rel=1e-3) and columns['lateralStress'][1:] == pytest.approx(
		[0, 0, 0]
	)
	assert test.sample.porosity == pytest.approx(1 - 12 * edge**3 / (extents[0] * extents[1] * lengths[2]), rel=1e-9)


def testOedometerInAPeriodicCellIsTheSpringsOfItsLayers():
	"""Three layers are three contacts in a row, the last one with the image of the first."""
	extents = periodicStack(0.02)
	test = polytope.oedometer(polytope.sample())
	lengths = []
	for stress in (1e4, 2e4):
		test.load(stress)
		lengths.append(test.sample.extents[2])
	force = 1e4 * extents[0] * extents[1] / 9
	assert lengths[0] - lengths[1] == pytest.approx(3 * force / (perArea * edge**2), rel=2e-3)
	assert test.columns['lateralStress'] == pytest.approx([0, 0, 0], abs=1)


def testSimpleShearOfAPeriodicLatticeHasItsShearModulus():
	"""All cubes turn by half of the shear strain γ: contacts on all faces slip by aγ/2, so τ = kₛ a γ / 2."""
	periodicStack(0)
	sample = polytope.sample()
	sample.control(stresses={0: 1e4, 1: 1e4, 2: 1e4})
	sample.settle()
	test = polytope.simpleShear(sample, stress=1e4, rate=0.005)
	test.run(1e-4)
	test.sample.settle()
	test.note()
	columns = test.columns
	assert columns['shearStress'][-1] == pytest.approx(perArea / 2 * edge * columns['shearStrain'][-1] / 2, rel=1e-2)
	turn = O.bodies[0].state.ori.toRotationMatrix()
	assert turn[0, 2] == pytest.approx(columns['shearStrain'][-1] / 2, rel=2e-2)


def testTriaxialOfAStackOfCubesHasItsModulusAndNoPoissonsRatio():
	stack((2, 2, 2), 0)
	test = polytope.triaxial(polytope.sample(lower=(0, 0, 0), upper=(2 * edge,) * 3), stress=1e4, rate=0.02)
	before = test.sample.extents
	test.run(5e-4)
	test.sample.settle()
	test.note()
	columns = test.columns
	assert columns['deviator'][-1] == pytest.approx(perArea * (before[2] - test.sample.extents[2]) / 3, rel=2e-3)
	assert columns['axialStrain'][-1] == pytest.approx(5e-4, rel=1e-2)
	assert columns['volumetricStrain'] == pytest.approx(columns['axialStrain'], abs=5e-6)
	assert columns['lateralStress'] == pytest.approx(1e4, rel=1e-3)
	assert len(columns['deviator']) == 202


def assertMeanStressIsThatOfTheWalls(sample):
	# the walls' friction, too, is in the mean stress, and 0.2 to 0.6 % of what the walls bear at right angles (six samples)
	assert np.diag(sample.stress()) == pytest.approx(sample.boundaryStress(), rel=1e-2)
	assert sample.stress() == pytest.approx(ofBoundary(sample), abs=2e-3 * 1e5)


def testTriaxialBetweenWallsHoldsItsStress():
	sample = packed()
	test = polytope.triaxial(sample, stress=1e5, inertialNumber=5e-3)
	assert sample.boundaryStress() == pytest.approx(1e5, rel=1e-3)
	assertMeanStressIsThatOfTheWalls(sample)
	test.run(0.02)
	columns = test.columns
	assert columns['lateralStress'].mean() == pytest.approx(1e5, rel=1e-3) and columns['lateralStress'] == pytest.approx(1e5, rel=0.02)
	assert columns['axialStrain'][[0, -1]] == pytest.approx([0, 0.02], abs=1e-4) and columns['deviator'][-1] > 4e4
	assert columns['porosity'][-1] == pytest.approx(1 - (1 - columns['porosity'][0]) * exp(columns['volumetricStrain'][-1]), rel=1e-3)
	sample.settle()
	assertMeanStressIsThatOfTheWalls(sample)
	assert noFailures()
	with pytest.raises(ValueError, match='^sample'):
		polytope.triaxial('here', stress=1e5)


def testContactAndWallStressDifferByInertia():
	"""While a sample deforms: on the axis the contacts bear less than the walls, sideways more, as the square of the inertial number; not
	by damping."""
	found, unsure = {}, {}
	for inertialNumber, damping in ((2e-2, 0.2), (2e-2, 0), (5e-3, 0.2)):
		O.reset()
		sample = packed()
		test = polytope.triaxial(sample, stress=1e5, inertialNumber=inertialNumber)
		next(engine for engine in O.engines if isinstance(engine, NewtonIntegrator)).damping = damping
		rows, usual = [], test.measure
		test.measure = lambda rows=rows, sample=sample, usual=usual: (
			rows.append((np.diag(sample.stress()), sample.boundaryStress())),
			usual(),
		)[1]
		test.run(0.01)
		# records scatter by 2 %, and those next to each other are much the same: the mean is as sure as that of ten parts of the run
		parts = np.array(rows)[21:].reshape(10, -1, 2, 3).mean(axis=1)
		differences = np.array([(contacts[:2].mean() / walls[:2].mean() - 1, contacts[2] / walls[2] - 1) for contacts, walls in parts])
		found[inertialNumber, damping] = differences.mean(axis=0)
		unsure[inertialNumber, damping] = differences.std(axis=0, ddof=1) / math.sqrt(len(parts))
	print(found, unsure)
	lateral, axial = found[2e-2, 0.2]
	assert 0.01 < lateral < 0.025 and -0.03 < axial < -0.005
	sure = 3 * np.hypot(unsure[2e-2, 0.2], unsure[2e-2, 0])
	assert sure[0] < 0.008 and sure[1] < 0.035
	assert (abs(found[2e-2, 0] - found[2e-2, 0.2]) < sure).all(), 'without numerical damping the same'
	assert np.abs(found[5e-3, 0.2]).max() < 0.006


def testAnotherSceneIsToldOf(tmp_path):
	"""After O.load a test of before would step for ever, since its bodies are gone; the boundary of the loaded scene stands still, which a
	run must not hide."""
	extents = stack((2, 2, 2), 0)
	test = polytope.triaxial(polytope.sample(), stress=1e5, inertialNumber=1e-2)
	O.save(str(tmp_path / 'test.yade.gz'))
	O.load(str(tmp_path / 'test.yade.gz'))
	with pytest.raises(RuntimeError, match='^sample: its body 0 is not in the present scene, as after O.load'):
		test.run(1e-4)
	with pytest.raises(RuntimeError):
		O.step()
	again = polytope.triaxial(polytope.sample(), stress=1e5, inertialNumber=1e-2)
	assert sum(isinstance(body.shape, Wall) for body in O.bodies if body is not None) == 6, 'in place of the former ones, not beside them'
	# pressed to the same stress again: as far as it was at rest
	assert again.sample.extents == pytest.approx(test.sample.extents, rel=1e-7) and again.sample.extents == pytest.approx(extents, rel=1e-2)
	again.run(1e-5)
	O.reset()
	with pytest.raises(RuntimeError, match='^sample: its body 0 is not'):
		again.run(1e-4)


def testAStressThatTheGrainsCannotBearIsToldOf():
	"""Joints so soft that they would overlap by their size."""
	with pytest.raises(
		RuntimeError,
		match=r'^loading: the bodies overlap by .* of their size on average, which no bodies do; give the material a higher normalStiffness',
	):
		polytope.pack(grains(0.008, stiffness=1e8), (0, 0, 0), (0.033,) * 3, stress=1e5, periodic=True, seed=1)


def testTriaxialInAPeriodicCellHoldsItsStress():
	test = polytope.triaxial(packed(periodic=True, mass=0.02), stress=1e5, inertialNumber=5e-3)
	assert test.sample.boundaryStress() == pytest.approx(1e5, rel=1e-3)
	test.run(0.02)
	columns = test.columns
	assert columns['lateralStress'].mean() == pytest.approx(1e5, rel=1e-3) and columns['deviator'][-1] > 4e4
	stress = -sum(O.bodies[k].shape.volume * one for k, one in polytope.bodyStress().items()) / O.cell.volume
	assert np.diag(stress) == pytest.approx(test.sample.boundaryStress(), rel=5e-3) and noFailures()


def testPeriodicSimpleShearToOneKeepsItsStressSymmetric():
	"""The cell is replaced by a less tilted one on the way, which has the same contacts and the same stress."""
	test = polytope.simpleShear(packed(periodic=True, mass=0.02), stress=1e5, inertialNumber=0.1)
	widest = 0
	for strain in np.arange(1, 11) / 10:
		test.run(strain)
		cell = np.array(O.cell.hSize, float).reshape(3, 3)
		widest = max(widest, abs(cell[0, 2] / cell[0, 0]))
	trsf = np.array(O.cell.trsf, float).reshape(3, 3)
	assert trsf[0, 2] / trsf[2, 2] == pytest.approx(1, abs=1e-2) and widest < 0.6
	cell = np.array(O.cell.hSize, float).reshape(3, 3)
	assert np.linalg.det(cell) == pytest.approx(np.prod(test.sample.extents), rel=1e-9)
	test.sample.settle()
	stress = test.sample.stress()
	assert stress[2, 2] == pytest.approx(1e5, rel=1e-3) and -stress[0, 2] > 1e4
	assert np.abs(stress - stress.T).max() < 1e-3 * np.trace(stress) / 3
	bodies = -sum(O.bodies[k].shape.volume * one for k, one in polytope.bodyStress().items()) / O.cell.volume
	assert bodies == pytest.approx(stress, abs=5e-3 * 1e5) and noFailures()
	before = sum(contact.isReal for contact in O.interactions)
	O.interactions.clear()
	O.step()
	assert sum(contact.isReal for contact in O.interactions) == pytest.approx(before, abs=2)


def testSimpleShearBetweenPlatesIsThatOfTheContacts():
	test = polytope.simpleShear(packed(), stress=1e5, inertialNumber=2e-2)
	assert test.sample.boundaryStress()[2] == pytest.approx(1e5, rel=1e-3)
	test.run(0.1)
	columns = test.columns
	assert columns['normalStress'].mean() == pytest.approx(1e5, rel=1e-3) and 0.2 < columns['stressRatio'][-1] < 1
	test.sample.settle()
	assert test.sample.stress() == pytest.approx(ofBoundary(test.sample), abs=5e-3 * 1e5)
	assert test.sample.boundaryStress()[2] == pytest.approx(1e5, rel=1e-3) and noFailures()
	side = O.bodies[test.sample.sides[0]].state
	assert (side.ori * type(side.pos)(0, 0, 1))[0] == pytest.approx(np.sin(np.arctan(0.1)), abs=1e-4)
	with pytest.raises(ValueError, match='^strain'):
		test.run(1.5)


def testShearBoxOfTwoBlocksSlidesAtTheirFriction():
	"""Over the rim of the lower half, which bears nothing, as well; blocks leave room on the sides to which they move."""
	material()
	O.bodies.append([polytope.cuboid((0.52, 0.25, 0.15), (0.48, 0.25, 0.15)), polytope.cuboid((0.48, 0.25, 0.45), (0.48, 0.25, 0.15))])
	test = polytope.shearBox(polytope.sample(lower=(0, 0, 0), upper=(1, 0.5, 0.6)), stress=1e5, speed=0.05)
	test.run(0.05)
	columns = test.columns
	sliding = columns['displacement'] > 0.01
	assert columns['stressRatio'][sliding] == pytest.approx(tan(friction), rel=2e-3)
	assert columns['normalStress'][50:] == pytest.approx(1e5, rel=2e-3) and columns['rise'][-1] == pytest.approx(0, abs=1e-4)
	with pytest.raises(ValueError, match='^displacement'):
		test.run(0.3)


def testPackToAPorosity():
	loose = grains()
	length = (sum(body.shape.volume for body in loose) / 0.16) ** (1 / 3)
	sample = polytope.pack(loose, (1, 2, 3), (1 + length, 2 + length, 3 + length), porosity=0.46, seed=1)
	assert sample.porosity == pytest.approx(0.46, abs=2e-4) and utils.unbalancedForce() < 1e-2
	assert (sample.lower > (1, 2, 3)).all() and polytope.porosity(sample.lower, sample.upper) == pytest.approx(0.46, abs=2e-3)


def testPackUnderGravity():
	loose = grains(0.004, stiffness=1e8)
	sample = polytope.pack(loose, (0, 0, 0), (0.02, 0.02, 0.06), gravity=(0, 0, -9.81), seed=1)
	weight = sum(O.bodies[k].state.mass for k in sample.ids) * 9.81
	assert -O.forces.f(sample.walls[2][0], sync=True)[2] == pytest.approx(weight, rel=5e-3) and sample.walls[2][1] is None
	assert polytope.aabbExtrema(sample.ids)[1][2] < 0.04
	with pytest.raises(ValueError, match='^sample: it has no wall above'):
		polytope.oedometer(sample)
	sample.close()
	test = polytope.oedometer(sample)
	test.load(1e3)
	below = O.forces.f(sample.walls[2][0], sync=True)[2], O.forces.f(sample.walls[2][1], sync=True)[2]
	assert -below[0] - below[1] == pytest.approx(weight, rel=2e-2)


def testWhatIsWrongIsNamed():
	loose = grains()
	for wrong, options in (
		('stress', {}),
		('stress', {'stress': 1e5, 'porosity': 0.5}),
		('stress', {'stress': -1}),
		('porosity', {'porosity': 2}),
		('gravity', {'gravity': (1, 0, 0)}),
		('friction', {'stress': 1e5, 'friction': 2}),
	):
		with pytest.raises(ValueError, match=f'^{wrong}: '):
			polytope.pack(loose, (0, 0, 0), (0.1, 0.1, 0.1), **options)
		assert len(O.bodies) == 0
	with pytest.raises(ValueError, match='^upper: '):
		polytope.pack(loose, (0, 0, 0), (0.01, 0.01, 0.01), stress=1e5)
	with pytest.raises(ValueError, match='^bodies: '):
		polytope.pack([], (0, 0, 0), (0.1, 0.1, 0.1), stress=1e5)
	with pytest.raises(ValueError, match='^bodies: .* a periodic cell must be'):
		polytope.pack(grains(0.004), (0, 0, 0), (0.1, 0.1, 0.1), stress=1e5, periodic=True)
	O.bodies.append(loose)
	with pytest.raises(ValueError, match='^bodies: '):
		polytope.pack(loose, (0, 0, 0), (0.1, 0.1, 0.1), stress=1e5)
	for wrong, options in (
		('lower', {'lower': (0, 0, 0)}),
		('upper', {'lower': (0, 0, 0), 'upper': (1, 0, 1)}),
		('ids', {'ids': []}),
		('ids', {'ids': [10**6]}),
	):
		with pytest.raises(ValueError, match=f'^{wrong}: '):
			polytope.sample(**options)
	for make, arguments in ((polytope.sample, ()), (polytope.pack, (loose,)), (polytope.triaxial, ()), (polytope.oedometer, ())):
		with pytest.raises(TypeError, match=f"^{make.__name__}: there is no argument 'strain'; it takes "):
			make(*arguments, strain=1)


def testASampleOfWhatIsThereHasTheExtentsOfItsBodies():
	"""A stack of cubes, without corners; and stages of an oedometer that say nothing."""
	extents = stack((2, 2, 3), 0)
	sample = polytope.sample()
	assert sample.extents == pytest.approx(extents, rel=1e-12) and sample.porosity == pytest.approx(0, abs=1e-12)
	test = polytope.oedometer(sample)
	with pytest.raises(ValueError, match=r'^stresses: give the axial stresses of the stages'):
		test.load()
	for wrong in ('1e5', -1, float('nan'), float('inf'), True):
		with pytest.raises(ValueError, match='^stresses: must be a number above 0'):
			test.load(1e5, wrong)
	triaxial = polytope.triaxial(polytope.sample(lower=(0, 0, 0), upper=tuple(extents)), stress=1e5)
	for wrong in ('0.1', float('nan'), float('inf'), True, None):
		with pytest.raises(ValueError, match='^strain: must be a finite number'):
			triaxial.run(wrong)
	assert len(test.columns['axialStress']) == 1, 'nothing is loaded before all stages are known to be right'


def testBondsInACellAreRefused():
	"""YADE's measure of a cell's stress does not know them: the cell would be pressed far beyond its target, or the bonds be torn."""
	material()
	O.periodic = True
	O.cell.setBox(*[4 * edge] * 3)
	half = [edge / 2] * 3
	O.bodies.append([polytope.cuboid([edge * (n + 0.5) for n in (i, j, k)], half) for i in range(4) for j in range(4) for k in range(4)])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	made = polytope.sample()
	assert polytope.bond() == 192
	with pytest.raises(RuntimeError, match='192 intact bonds'):
		polytope.triaxial(made, stress=1e5).run(1e-4)
	with pytest.raises(RuntimeError, match='192 intact bonds'):
		polytope.sample()


def testWhatIsNoSampleLeavesTheSceneAsItIs():
	material()
	O.bodies.append([polytope.cuboid((0, 0, 0), [edge / 2] * 3), polytope.polygon([(1, 0), (1.1, 0), (1, 0.1)])])
	with pytest.raises(ValueError, match='^ids: .*body 1 is none'):
		polytope.sample()
	assert len(O.bodies) == 2


def testPackingThatWouldPressBodiesIntoEachOtherIsRefused():
	with pytest.raises(RuntimeError, match='porosity: .* overlap by .* which no bodies do'):
		polytope.pack(grains(0.002), (0, 0, 0), (0.02, 0.02, 0.02), porosity=0.01, seed=1)


def testAStrainInPercentIsQuestioned():
	test = polytope.triaxial(packed(), stress=1e5)
	for wrong in (2, 1, -1):
		with pytest.raises(ValueError, match='strain: must be at most 0.7'):
			test.run(wrong)
	test.run(1e-4)
	test.run(2e-4)
	assert test.columns['axialStrain'][-1] == pytest.approx(2e-4, abs=1e-5), 'a total, not what is added'


@pytest.mark.parametrize('kind', ['simpleShear', 'shearBox'])
def testAShearTestThatIsLoadedIsNotReplacedUnasked(tmp_path, kind):
	"""A box of walls took the place of its plates, about the extents of bodies that a tilted frame had held."""
	make = getattr(polytope, kind)
	test = make(packed(), stress=1e5, inertialNumber=2e-2)
	test.run(0.02 * (test.sample.extents[0] if kind == 'shearBox' else 1))
	O.save(str(tmp_path / 'test.yade.gz'))
	O.load(str(tmp_path / 'test.yade.gz'))
	there = [body.id for body in O.bodies if body is not None]
	with pytest.raises(
		ValueError, match='^lower: the scene has the plates of a shear test, .* not known after O.load; give lower and upper'
	):
		polytope.sample()
	assert [body.id for body in O.bodies if body is not None] == there, 'nothing is changed'
	low, high = polytope.aabbExtrema([body.id for body in O.bodies if body is not None and body.dynamic])
	with pytest.warns(UserWarning, match='plates of a shear test are replaced'):
		sample = polytope.sample(lower=low, upper=high)
	assert sum(isinstance(body.shape, Wall) for body in O.bodies if body is not None) == 6 and sample.extents == pytest.approx(high - low)


def testASampleWhoseWallsWereReplacedIsToldOf():
	"""The plates of a shear test had replaced them: its servos moved walls that were not there, until bodies had been pressed into each other."""
	sample = packed()
	test = polytope.simpleShear(sample, stress=1e5, inertialNumber=2e-2)
	for make in (polytope.triaxial, polytope.shearBox, polytope.simpleShear):
		with pytest.raises(RuntimeError, match='^sample: body .*, of its walls or plates, is no longer in the scene; a shear test'):
			make(sample, stress=1e5)
	test.run(0.01)
	again = polytope.simpleShear(test.sample, stress=1e5, inertialNumber=2e-2)
	with pytest.raises(ValueError, match='^strain: between plates at most 1 after 0.01 of an earlier test, got 0.995'):
		again.run(0.995)
	again.run(0.001)
	assert again.columns['normalStress'][-1] == pytest.approx(1e5, rel=2e-2)
	low, high = polytope.aabbExtrema(sample.ids)
	with pytest.warns(UserWarning, match='plates of a shear test'):
		polytope.sample(lower=low, upper=high)
	with pytest.raises(RuntimeError, match='^sample: body .*, of its walls or plates'):
		again.run(0.002)


def testEnginesThatHaveLostTheirIntegratorAreToldOf():
	"""They are told of also where the engine that moves the walls is there: it stepped 200 000 times."""
	sample = packed()
	polytope.triaxial(sample, stress=1e5)
	O.engines = [engine for engine in O.engines if not isinstance(engine, NewtonIntegrator)]
	with pytest.raises(ValueError, match='^engines: set O.engines first.* before NewtonIntegrator'):
		polytope.triaxial(sample, stress=1e5)


def cross(length=0.006):
	"""Parts of a body that is not convex, two bars that cross."""
	return [
		polytope.cuboid((0, 0, 0), (length / 2, length / 6, length / 6)),
		polytope.cuboid((0, 0, 0), (length / 6, length / 2, length / 6)),
	]


@pytest.mark.parametrize('periodic', [False, True])
def testBodiesThatAreNotConvexArePackedAsClumps(periodic):
	material(1e11)
	number = 40 if periodic else 15
	length = 0.05 if periodic else 0.04
	sample = polytope.pack([cross() for _ in range(number)], (0, 0, 0), (length,) * 3, stress=1e5, periodic=periodic, seed=3)
	assert len(sample.ids) == number and all(O.bodies[k].isClump for k in sample.ids)
	assert sample.solidVolume == pytest.approx(number * (2 * 0.006 * 0.002**2 - 0.002**3), rel=1e-9)
	assert sample.boundaryStress() == pytest.approx([1e5] * 3, rel=1e-3)
	assert 0.3 < sample.porosity < 0.9


def testACloudOfBodiesThatAreNotConvexHasNoOverlap():
	material()
	several = [cross() for _ in range(20)] + [polytope.cuboid((0, 0, 0), (0.003,) * 3) for _ in range(10)]
	placed = polytope.cloud((0, 0, 0), (0.04, 0.04, 0.04), several, seed=2)
	groups = [one if isinstance(one, list) else [one] for one in placed]
	for i, one in enumerate(groups):
		for other in groups[:i]:
			assert not any(polytope.contact(a, b).inContact for a in one for b in other)
	for one in groups[:20]:
		assert (one[0].state.pos - one[1].state.pos).norm() < 1e-15  # as they were given
	corners = np.array(
		[np.array(part.state.pos + part.state.ori * corner, float) for one in groups for part in one for corner in part.shape.vertices]
	)
	assert corners.min() >= 0 and corners.max() <= 0.04


def testGrainsThatBreakStayInTheirTest():
	"""An oedometer goes on with the pieces: mass and solid volume are those of the grains."""
	sample = packed()
	test = polytope.oedometer(sample)
	test.load(1e5)
	number, volume, mass = len(sample.ids), sample.solidVolume, sample.mass
	chosen = sample.ids[: number // 3]
	broken = [polytope.split(k, (0, 0, 1)) for k in chosen]
	assert len(sample.ids) == number + len(chosen) and not set(sample.ids) & set(chosen)
	assert set(np.ravel(broken)) <= set(sample.ids)
	assert sum(sample.volumes.values()) == pytest.approx(volume, rel=1e-12)
	test.load(1.5e5)
	assert sample.boundaryStress()[2] == pytest.approx(1.5e5, rel=1e-3)
	assert sum(O.bodies[k].state.mass for k in sample.ids) == pytest.approx(mass, rel=1e-12)
	assert test.columns['voidRatio'][-1] < test.columns['voidRatio'][0]
