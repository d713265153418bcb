# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of packings against closed forms."""

import warnings

import numpy as np
import pytest
from scenes import rowInAPeriodicCell
from yade import ForceResetter, NewtonIntegrator, O, Quaternion, RockJointMat, Vector3, polytope, utils
from yade.polytope.scene.present import gravityOf

g, density = 10, 2600


@pytest.fixture(autouse=True)
def material():
	O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.8))


def atRest(seconds=0.6, gravity=(0, 0, -g)):
	O.engines = polytope.engines(integrator=NewtonIntegrator(gravity=gravity, damping=0.5))
	while O.time < seconds:
		O.step()


def column(number=3, half=(0.5, 0.4, 0.3)):
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	for k in range(number):
		O.bodies.append(polytope.cuboid((0, 0, half[2] * (2 * k + 1)), half))


def testStressOfBlocksInAColumn():
	"""σ of a block is that of its middle: the weight of what is above and half of its own, over the area."""
	column()
	atRest()
	stress = polytope.bodyStress()
	assert set(stress) == {1, 2, 3}
	for k in (1, 2, 3):
		mean = -density * g * 0.6 * (3 - k + 0.5)
		assert stress[k][2, 2] == pytest.approx(mean, rel=1e-3)
		assert np.abs(stress[k] - np.diag([0, 0, stress[k][2, 2]])).max() < 2e-3 * abs(mean)


def testStressOfATurnedBlockUnderSideLoads():
	"""A block held between plates that press it from two sides: -F/A in that direction, whatever its orientation and shape."""
	O.bodies.append(polytope.prism([(0, 0), (1, 0), (1, 0.5), (0, 0.5)], 0.8, center=(0, 0, 0)))
	O.bodies.append([polytope.cuboid((side * 1.49999, 0, 0), (1, 2, 2), fixed=True) for side in (-1, 1)])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	O.step()
	force = O.interactions[0, 1].phys.normalForce.norm()
	assert force > 0
	assert polytope.bodyStress()[0][0, 0] == pytest.approx(-force / 0.4, rel=1e-4)
	assert polytope.bodyStress([0])[0].trace() == pytest.approx(-force / 0.4, rel=1e-4)


def testStressOfAClumpOfPolygons():
	"""Two squares side by side on a floor, under their weight: −W/(2 width thickness) in the middle, of which the mean is."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.5))
	O.bodies.append(polytope.polygon([(-3, -1), (3, -1), (3, 0), (-3, 0)], fixed=True))
	clump, _parts = O.bodies.appendClumped([polytope.polygon([(x, 0), (x + 1, 0), (x + 1, 1), (x, 1)]) for x in (-1, 0)])
	O.engines = polytope.engines(gravity=(0, -9.81, 0))
	polytope.settle()
	assert polytope.bodyStress()[clump][1, 1] == pytest.approx(-2600 * 9.81 / 2, rel=1e-3)


def testStressOfAClumpIsThatOfOneBody():
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	clump, _ = O.bodies.appendClumped([polytope.cuboid((side * 0.25, 0, 0.3), (0.25, 0.4, 0.3)) for side in (-1, 1)])
	O.bodies.append(polytope.cuboid((0, 0, 0.9), (0.5, 0.4, 0.3)))
	atRest()
	stress = polytope.bodyStress()
	assert set(stress) == {clump, len(O.bodies) - 1}
	assert stress[clump][2, 2] == pytest.approx(-density * g * 0.6 * 1.5, rel=1e-3)


def testStressInAPeriodicCell():
	"""Three blocks in a row press on each other, the last one on the image of the first."""
	rowInAPeriodicCell()
	contacts = [contact for contact in O.interactions if contact.isReal]
	assert len(contacts) == 3 and any(contact.cellDist[0] != 0 for contact in contacts)
	force = contacts[0].phys.normalForce.norm()
	stress = polytope.bodyStress()
	for k in range(3):
		assert stress[k] == pytest.approx(np.diag([-force / 0.8, 0, 0]), abs=1e-3 * force)


def testFabricOfContacts():
	column()
	atRest(0.3)
	assert np.abs(polytope.contactFabric() - np.diag([0, 0, 1])).max() < 1e-6
	O.reset()
	O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.8))
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)))
	O.bodies.append([polytope.cuboid(tuple(1.4999 * axis), (1, 1, 1), fixed=True) for axis in np.eye(3)])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	O.step()
	fabric = polytope.contactFabric([0])
	assert fabric == pytest.approx(np.eye(3) / 3, abs=1e-3) and np.trace(fabric) == pytest.approx(1)


def testFabricOfBodies():
	O.bodies.append([polytope.cuboid((3 * k, 0, 0), (1, 0.5, 0.4)) for k in range(3)])
	assert polytope.particleFabric() == pytest.approx(np.diag([1, 0, 0]), abs=1e-12)
	O.bodies.append(polytope.cuboid((0, 5, 0), (1, 0.5, 0.4), Quaternion((0, 0, 1), np.pi / 2)))
	assert polytope.particleFabric() == pytest.approx(np.diag([0.75, 0.25, 0]), abs=1e-12)
	random = polytope.grains([(0.01, 0), (0.012, 1)], 1, elongation=0.5, flatness=1, seed=1)
	O.bodies.append(random)
	assert polytope.particleFabric([body.id for body in random]) == pytest.approx(np.eye(3) / 3, abs=0.06)


def testExtremaOfBodies():
	turn = Quaternion((0, 0, 1), np.pi / 4)
	O.bodies.append([polytope.cuboid((1, 2, 3), (1, 1, 0.5), turn), utils.sphere((5, 0, 0), 2)])
	O.bodies.append(polytope.cuboid((0, 0, -50), (9, 9, 1), fixed=True))
	low, high = polytope.aabbExtrema()
	assert low == pytest.approx([1 - 2**0.5, -2, -2]) and high == pytest.approx([7, 2 + 2**0.5, 3.5])
	assert polytope.aabbExtrema([2])[0] == pytest.approx([-9, -9, -51])
	clump, _ = O.bodies.appendClumped([polytope.cuboid((20, 0, 0), (1, 1, 1)), utils.sphere((22, 0, 0), 1)])
	assert [list(corner) for corner in polytope.aabbExtrema([clump])] == [pytest.approx([19, -1, -1]), pytest.approx([23, 1, 1])]
	assert polytope.aabbExtrema()[1][0] == pytest.approx(23)


def testSizeDistribution():
	O.bodies.append(
		[polytope.cuboid((k, 0, 0), (3 * half, 2 * half, half), Quaternion((1, k, 2), 1)) for k, half in enumerate((0.1, 0.2, 0.3))]
	)
	sizes, passing = polytope.sizeDistribution()
	assert sizes == pytest.approx([0.4, 0.8, 1.2]) and passing == pytest.approx(np.cumsum([1, 8, 27]) / 36)
	openings, passing = polytope.sizeDistribution([0.1, 0.5, 2])
	assert list(openings) == [0.1, 0.5, 2] and passing == pytest.approx([0, 1 / 36, 1])


def testSampleIsFoundAgain():
	"""Principal axes of a grain are not quite those that it was made in: the curve comes back to some per cent."""
	curve = [(0.004, 0), (0.008, 0.4), (0.016, 1)]
	O.bodies.append(polytope.grains(curve, 0.5, elongation=0.7, flatness=0.7, vertices=30, seed=1))
	_, passing = polytope.sizeDistribution([opening for opening, _ in curve])
	assert passing == pytest.approx([part for _, part in curve], abs=0.08)


def testRefusals():
	for measure in (polytope.bodyStress, polytope.aabbExtrema, polytope.particleFabric, polytope.sizeDistribution, polytope.contactFabric):
		with pytest.raises(ValueError, match='^ids: there is no body 7'):
			measure(ids=[7])
	for measure in (polytope.contactFabric, polytope.particleFabric, polytope.sizeDistribution, polytope.aabbExtrema):
		with pytest.raises(ValueError, match='^ids: '):
			measure()
	assert polytope.bodyStress() == {}
	O.bodies.append([utils.wall((0, 0, 0), axis=2), utils.sphere((0, 0, 5), 1)])
	with pytest.raises(ValueError, match='ids: body 0 is neither'):
		polytope.bodyStress([0])
	with pytest.raises(ValueError, match='ids: body 0 is a Wall'):
		polytope.aabbExtrema([0])
	with pytest.raises(ValueError, match='ids: body 1 is no polytope'):
		polytope.particleFabric([1])
	O.bodies.append(polytope.regular(6, 1))
	for wrong in ([0, 1], 'coarse', [-1]):
		with pytest.raises(ValueError, match='sieves'):
			polytope.sizeDistribution(wrong)
	assert isinstance(O.bodies[2].state.pos, Vector3)


def testYadesOwnFunctionsAreAsThePageSays():
	"""docs/packing.md lists them with what is wrong; one that came right should leave that list."""
	column()
	atRest()
	weight = density * g * 0.6 * 2.5
	assert abs(utils.bodyStressTensors()[1][2, 2]) > 1.8 * weight
	assert np.isnan(utils.porosity()) and np.isnan(utils.aabbExtrema()[0][0])
	assert utils.unbalancedForce() < 1e-3


def testPolygonsHaveLongAxesAndNoSieves():
	"""A thick plate of polygon: its thickness is no length of it."""
	O.reset()
	O.materials.append(RockJointMat())
	O.bodies.append(polytope.polygon([(0, 0), (1, 0), (1, 3), (0, 3)], thickness=20))
	assert np.diag(polytope.particleFabric()) == pytest.approx([0, 1, 0], abs=1e-12)
	with pytest.raises(ValueError, match='ids: body 0 is a polygon'):
		polytope.sizeDistribution()
	with pytest.raises(ValueError, match='ids: body 0 is a polygon'):
		polytope.breakGrains(tension=1)


def testPolytopesOfAClumpWithASphereCount():
	"""The sphere is warned of; its clump was refused by the number of a body that nobody had named."""
	O.bodies.appendClumped([utils.sphere((0, 0, 1), 0.5), polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5))])
	for region in ({'lower': (-1, -1, -1), 'upper': (1, 1, 1)}, {'lower': (-1, -1, 0), 'upper': (1, 1, 1)}):
		with pytest.warns(UserWarning, match='ids: the volume of 1 free spheres is not counted'):
			found = polytope.porosity(**region)
		assert found == pytest.approx(7 / 8, rel=1e-12)
	with pytest.raises(ValueError, match='^ids: body 0 is no polyhedron'):
		polytope.porosity((-1, -1, -1), (1, 1, 1), ids=[2])


def testFreeSpheresAreNotLeftOutOfPorositySilently():
	O.reset()
	O.materials.append(RockJointMat())
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)))
	O.bodies.append(utils.sphere((0, 0, 2), 0.5))
	with pytest.warns(UserWarning, match='ids: the volume of 1 free spheres') as told:
		assert polytope.porosity((-1, -1, -1), (1, 1, 1)) == pytest.approx(7 / 8)
	assert told[0].filename == __file__
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		assert polytope.porosity((-1, -1, -1), (1, 1, 1), ids=[0]) == pytest.approx(7 / 8)


def testGravityIsThatOfAllIntegratorsThatAct():
	"""As YADE moves a body: each NewtonIntegrator that is not dead adds its own gravity."""
	falling = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 5), (0.5, 0.5, 0.5)))].state
	parts = (0, 3, -7), (2, 0, -3)
	O.engines = [
		ForceResetter(),
		NewtonIntegrator(gravity=(0, 0, -1000), damping=0, dead=True),
		*(NewtonIntegrator(gravity=part, damping=0) for part in parts),
	]
	assert tuple(gravityOf()) == (2, 3, -10)
	energy = polytope.mechanicalEnergy()
	assert tuple(falling.vel / O.dt) == pytest.approx((2, 3, -10))
	assert energy == pytest.approx(falling.mass * 10 * 5, rel=1e-6)
	O.engines = O.engines[:2]
	assert tuple(gravityOf()) == (0, 0, 0)
