# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.excavate: neighbours of what is taken away get their new load without a swing, or with one."""

import math

import numpy as np
import pytest
from rockScenes import stressedMass
from yade import O, PyRunner, RockJointMat, Vector3, polytope
from yade.polytope.scene.relaxing import relaxing

gravity, density = 9.81, 2600


def material(**joint):
	O.materials.append(
		RockJointMat(**{'density': density, 'normalStiffness': 1e9, 'shearStiffness': 1e9, 'frictionAngle': math.radians(30), **joint})
	)


def undamped():
	"""Neither numerical nor viscous damping."""
	O.engines = polytope.engines(damping=0)
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0


def slabOnLegs(flat=False):
	"""A slab of 6 m on three fixed legs, at rest. Returns its weight; legs are 0, 1, 2, the slab 3."""
	material()
	for x in (-2, 0, 2):
		if flat:
			O.bodies.append(polytope.polygon([(x - 0.2, -1), (x + 0.2, -1), (x + 0.2, 0), (x - 0.2, 0)], fixed=True))
		else:
			O.bodies.append(polytope.cuboid((x, 0, -0.5), (0.2, 0.5, 0.5), fixed=True))
	slab = polytope.polygon([(-3, 0), (3, 0), (3, 0.5), (-3, 0.5)]) if flat else polytope.cuboid((0, 0, 0.25), (3, 0.5, 0.25))
	O.bodies.append(slab)
	undamped()
	slab.state.pos -= (0, 1e-6, 0) if flat else (0, 0, 1e-6)
	polytope.settle()
	return slab.state.mass * gravity


def forceOf(leg, slab=3):
	return O.interactions[leg, slab].phys.normalForce.norm()


def peakOf(measure, steps):
	"""Largest value after each of so many steps."""
	largest = 0
	for _ in range(steps):
		O.step()
		largest = max(largest, measure())
	return largest


@pytest.mark.parametrize('flat', [False, True])
def testALegThatVanishesMakesTheOthersSwing(flat):
	"""From W/3 about W/2: to 2/3 W, for nothing damps."""
	weight = slabOnLegs(flat)
	assert forceOf(0) == pytest.approx(weight / 3, rel=1e-3)
	assert polytope.excavate([1]) == {1: []}
	assert O.bodies[1] is None and not relaxing()
	assert peakOf(lambda: forceOf(0), 1000) == pytest.approx(2 / 3 * weight, rel=0.01)


@pytest.mark.parametrize('flat, over', [(False, 320), (False, 2000), (True, 320)])
def testALegThatIsRelaxedDoesNot(flat, over):
	"""Undamped, too, the others never have more than half of the weight, to 1 %; from five periods on."""
	weight = slabOnLegs(flat)
	area = 0.4
	assert over * O.dt > 5 * 2 * math.pi * math.sqrt(weight / gravity / (2 * area * 1e9))
	engines = [type(engine) for engine in O.engines]
	polytope.excavate([1], over=over)
	O.step()
	assert O.forces.f(3).norm() == pytest.approx(weight, rel=1e-4)  # no jump: what is missing to the weight is NewtonIntegrator's
	peak = peakOf(lambda: forceOf(0), over + 400)
	assert forceOf(0) == pytest.approx(weight / 2, rel=0.01) and peak < 1.01 * weight / 2
	assert [type(engine) for engine in O.engines] == engines


def heldBySides(strength):
	"""A cube of 1 m between fixed walls that press it, on a fixed base that bears its weight. Its joints can bear this multiple of the
	weight, by brittle cohesion and friction."""
	weight, pressure = density * gravity, 2e4
	friction = math.radians(20)
	cohesion = strength * weight / 2 - pressure * math.tan(friction)
	material(frictionAngle=friction, cohesion=cohesion)
	for x in (-1, 1):
		O.bodies.append(polytope.cuboid((x, 0, 0.5), (0.5, 1, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (0.5, 1, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
	undamped()
	slope = np.zeros((3, 3, 3))
	slope[2, 2, 2] = weight
	assert polytope.inSitu([[-pressure, 0, 0], [0, 0, 0], [0, 0, -weight]], slope) == 3
	return weight


def shearOf(wall):
	return O.interactions[wall, 3].phys.shearForce.norm()


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('over, stands', [(0, False), (3000, True)])
def testABlockThatHangsBetweenWallsKeepsItsCohesionWhereItsSupportIsRelaxed(over, stands):
	"""W/2 on either side; to twice that where the support vanishes, which is more than 1.3 times."""
	weight = heldBySides(1.3)
	place = O.bodies[3].state.pos
	polytope.excavate([2], over=over)
	peak = peakOf(lambda: shearOf(0) if O.interactions.has(0, 3, True) else 0, 5000)
	assert (O.bodies[3].state.pos - place).norm() < 1e-4 if stands else O.bodies[3].state.pos[2] < place[2] - 0.01
	if stands:
		assert shearOf(0) == pytest.approx(weight / 2, rel=0.01) and peak < 1.01 * weight / 2
		assert O.interactions[0, 3].phys.intact


@pytest.mark.filterwarnings('ignore:gravity at once')
def testWhatHangsHasTheFactorOfSafetyOfItsJoints():
	"""Stress, excavation and strength reduction one after the other: (c A + H tan φ)/(W/2), of brittle joints."""
	heldBySides(1.3)
	polytope.excavate([2], over=3000)
	assert polytope.settle(elastic=False) >= 3000
	found = polytope.factorOfSafety()
	assert found.factor == pytest.approx(1.3, rel=0.01)
	assert found.bodies == [3] and found.directions[0] == pytest.approx((0, 0, -1), abs=1e-3)


@pytest.mark.filterwarnings('ignore:gravity at once')
def testStrongerItSwingsToTwiceItsLoad():
	weight = heldBySides(3)
	polytope.excavate([2])
	assert peakOf(lambda: shearOf(0), 500) == pytest.approx(weight, rel=0.01)


def bonded():
	"""A beam of three bonded blocks that is held at both ends, as loads beside its axis."""
	material()
	for x in range(-1, 2):
		O.bodies.append(polytope.cuboid((x, 0, 0), (0.5, 0.3, 0.3), fixed=x != 0))
	undamped()
	polytope.bond()
	O.forces.setPermF(1, (0, 100, 50))
	O.forces.setPermT(1, (10, 20, 30))
	polytope.settle()


def twisted():
	"""A block on a plane, pressed and turned by friction about the normal, beside its middle."""
	material(frictionAngle=math.radians(60))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
	undamped()
	O.forces.setPermF(1, (3e3, 1e3, -1e4))
	O.forces.setPermT(1, (0, 0, 500))
	polytope.settle()


@pytest.mark.parametrize('scene, removed, kept', [(bonded, 0, 1), (twisted, 0, 1)])
def testForcesAndMomentsOfWhatIsTakenAwayGoOnActing(scene, removed, kept):
	scene()
	O.step()
	force, torque = Vector3(O.forces.f(kept)), Vector3(O.forces.t(kept))
	O.bodies[kept].state.vel = O.bodies[kept].state.angVel = (0, 0, 0)
	polytope.excavate([removed], over=10**6)
	O.step()
	size = O.bodies[kept].state.mass * gravity
	assert (O.forces.f(kept) - force).norm() < 1e-4 * size and (O.forces.t(kept) - torque).norm() < 1e-4 * size


@pytest.mark.parametrize('strength', [{}, {'cohesion': 1e6, 'tensileStrength': 1e6}])
def testTheLargestBlockOfAMassUnderStressLeavesNoJump(strength):
	"""Oblique joints, also such as act as bonds: forces and torques of its neighbours are what they were, to 1e-5 of what it pressed them with."""
	material(normalStiffness=1e11, shearStiffness=5e10, **strength)
	stressedMass()
	removed = max((body for body in O.bodies), key=lambda body: float(body.shape.volume)).id
	neighbours = [k for contact in O.bodies[removed].intrs() for k in (contact.id1, contact.id2) if k != removed and O.bodies[k].dynamic]
	assert neighbours
	O.step()
	before = {k: (Vector3(O.forces.f(k)), Vector3(O.forces.t(k))) for k in neighbours}
	pressed = max(contact.phys.normalForce.norm() for contact in O.bodies[removed].intrs() if contact.isReal)
	polytope.excavate([removed], over=10**6)
	O.step()
	for k, (force, torque) in before.items():
		assert (O.forces.f(k) - force).norm() < 1e-5 * pressed and (O.forces.t(k) - torque).norm() < 1e-5 * pressed


def testItGoesOnAfterSavingAndLoading(tmp_path):
	slabOnLegs()
	polytope.excavate([1], over=500)
	for _ in range(200):
		O.step()
	O.save(str(tmp_path / 'relaxing.yade'))
	places = []
	for load in (False, True):
		if load:
			O.load(str(tmp_path / 'relaxing.yade'))
		for _ in range(400):
			O.step()
		places.append(O.bodies[3].state.pos[2])
		assert not relaxing()
	assert places[0] == pytest.approx(places[1], abs=1e-12)


def testTwoAtATimeAndABodyThatIsGone():
	weight = slabOnLegs()
	polytope.excavate([1], over=3000)
	polytope.excavate([0], over=3000)
	assert len(relaxing()) == 2
	O.step()
	assert O.forces.f(3)[2] == pytest.approx(weight, rel=1e-3)
	polytope.excavate([3])
	O.run(10, wait=True)


def testSettleWaits():
	weight = slabOnLegs()
	polytope.excavate([1], over=1000)
	assert polytope.settle() >= 1000
	assert not relaxing() and forceOf(0) == pytest.approx(weight / 2, rel=1e-3)


def testARegionTakesWhatMovesAndHasItsCentreInside():
	material()
	for x in range(5):
		O.bodies.append(polytope.cuboid((x, 0, 0), (0.5, 0.5, 0.5), fixed=x == 2))
	clump = polytope.clump([polytope.cuboid((2, 0, 1), (0.5, 0.5, 0.5)), polytope.cuboid((3, 0, 1), (0.5, 0.5, 0.5))])[0]
	O.engines = polytope.engines()
	assert polytope.excavate(normals=[(-2, 0, 0), (1, 0, 0)], offsets=[-1.8, 3.2], cut=False) == {1: [], 3: [], clump: []}
	assert [body.id for body in O.bodies] == [0, 2, 4]


@pytest.mark.parametrize(
	'name, arguments',
	[
		('over', {'bodies': [1], 'over': -1}),
		('over', {'bodies': [1], 'over': 2.5}),
		('cut', {'bodies': [1], 'cut': 1}),
		('bodies', {}),
		('bodies', {'bodies': [7]}),
		('bodies', {'bodies': []}),
		('bodies', {'bodies': [1], 'normals': [(1, 0, 0)], 'offsets': [1]}),
		('offsets', {'normals': [(1, 0, 0)]}),
		('offsets', {'normals': [(1, 0, 0)], 'offsets': [1, 2]}),
		('normals', {'normals': [(0, 0, 0)], 'offsets': [1]}),
		('normals', {'normals': [(1, 0, math.nan)], 'offsets': [1]}),
		('normals', {'normals': [(1, 0, 0)], 'offsets': [-99]}),
	],
)
def testBadArgumentsAreNamedAndNothingIsTaken(name, arguments):
	slabOnLegs()
	with pytest.raises(ValueError, match=f'^{name}: '):
		polytope.excavate(**arguments)
	assert len(list(O.bodies)) == 4 and not any(isinstance(engine, PyRunner) for engine in O.engines)


def testBeforeTheFirstStepThereAreNoForcesThatCouldFade():
	material()
	for k in range(3):
		O.bodies.append(polytope.cuboid((0, 0, k), (0.5, 0.5, 0.5), fixed=k == 0))
	O.engines = polytope.engines()
	with pytest.raises(ValueError, match=r'^over: no contact bears a force yet .*polytope\.settle\(\) or polytope\.inSitu'):
		polytope.excavate([2], over=100)
	assert len(O.bodies) == 3 and not relaxing()
	assert polytope.excavate([2]) == {2: []}


def testWithoutAnIntegratorForcesCannotFade():
	material()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	with pytest.raises(ValueError, match='^engines: set O.engines first.* before NewtonIntegrator'):
		polytope.excavate([0], over=10)
	assert O.bodies[0] is not None
