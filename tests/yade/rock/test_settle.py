# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.settle: joints that gravity's first swing would break bear what they can bear at rest."""

import math

import pytest
from rockScenes import meanArm
from yade import NewtonIntegrator, O, PolytopeBonds, Quaternion, QuietBoundary, RockJointMat, Vector3, polytope
from yade.polytope.scene.permanentLoads import permanentLoads

dip, friction = math.radians(35), math.radians(30)
halfLength, halfWidth, height = 5.0, 5.0, 5.0
area, weight = 4 * halfLength * halfWidth, 2600 * 9.81 * 4 * halfLength * halfWidth * height


def slope(factor, **joint):
	"""A block on a plane, held by friction and cohesion with this factor of safety."""
	cohesion = (factor * weight * math.sin(dip) - weight * math.cos(dip) * math.tan(friction)) / area
	O.materials.append(
		RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=friction, cohesion=cohesion, **joint)
	)
	turn = Quaternion((0, 1, 0), dip)
	O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, -1), (20, 20, 1), orientation=turn, fixed=True))
	O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, height / 2), (halfLength, halfWidth, height / 2), orientation=turn))
	O.engines = polytope.engines()
	return O.bodies[1]


def hanging(factor):
	"""A block that hangs from a roof by the tensile strength of its joint, with this factor of safety."""
	strength = factor * weight / area
	O.materials.append(
		RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, cohesion=10 * strength, tensileStrength=strength)
	)
	O.bodies.append(polytope.cuboid((0, 0, 1), (20, 20, 1), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 1e-6 - height / 2), (halfLength, halfWidth, height / 2)))  # in touch
	O.engines = polytope.engines()
	return O.bodies[1]


def stays(block, seconds=1.0):
	begin, end = Vector3(block.state.pos), O.time + seconds
	while O.time < end:
		O.run(50, wait=True)
	return (block.state.pos - begin).norm() < 1e-3


@pytest.mark.parametrize('factor', [0.98, 1.02])
def testABlockOnASlopeStaysByItsFactorOfSafety(factor):
	block = slope(factor)
	assert polytope.settle() > 0
	assert block.state.vel.norm() < 1e-5
	assert O.interactions[0, 1].phys.intact
	assert stays(block) == (factor > 1)


def testGravityAtOnceBreaksIt():
	"""What it is for: a factor of safety of 1.5 is lost in the first swing."""
	assert not stays(slope(1.5), 3)


@pytest.mark.parametrize('factor', [0.98, 1.02])
def testAHangingBlockStaysByItsFactorOfSafety(factor):
	block = hanging(factor)
	polytope.settle()
	assert stays(block) == (factor > 1)


@pytest.mark.parametrize('factor', [0.98, 1.02])
def testSoDoesOneThatHangsByABond(factor):
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9))
	O.bodies.append(polytope.cuboid((0, 0, 1), (20, 20, 1), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, -height / 2), (halfLength, halfWidth, height / 2)))
	O.engines = polytope.engines()
	polytope.bond(normalStiffness=1e9, shearStiffness=1e9, tensileStrength=factor * weight / area)
	polytope.settle()
	assert not next(engine for engine in O.engines if isinstance(engine, PolytopeBonds)).unbreakable
	assert stays(O.bodies[1]) == (factor > 1)


def testTheSceneHasItsOwnStrengthAndDampingAgain():
	block = slope(1.2)
	integrator = next(engine for engine in O.engines if isinstance(engine, NewtonIntegrator))
	law = O.engines[2].lawDispatcher.functors[0]
	integrator.damping = 0.15
	polytope.settle()
	assert integrator.damping == 0.15 and not law.unbreakable
	block.state.vel = (1, 0, 0)  # not at rest in time
	with pytest.raises(RuntimeError, match='not at rest after 50'):
		polytope.settle(steps=50)
	assert integrator.damping == 0.15 and not law.unbreakable


def testTooFewStepsToTellAndForcesThatAreNoNumbers():
	block = slope(1.2)
	polytope.settle()
	with pytest.raises(RuntimeError, match='^steps: 50 are too few to tell that bodies are at rest'):
		polytope.settle(steps=50)
	O.forces.setPermF(block.id, (float('nan'), 0, 0))
	with pytest.raises(RuntimeError, match='^bodies: the unbalanced force is not a number'):
		polytope.settle()


def testWithoutElasticJointsKeepTheirStrength():
	block = slope(1.02)
	with pytest.raises(RuntimeError, match='not at rest'):
		polytope.settle(elastic=False, steps=4000)
	assert not O.interactions[0, 1].phys.intact
	assert block.state.vel.norm() > 0.1


@pytest.mark.parametrize('name,value', [('unbalanced', 0), ('damping', 1), ('damping', 0), ('steps', 0), ('unbalanced', 'no')])
def testWhatIsOutOfRangeIsNamed(name, value):
	slope(1.2)
	with pytest.raises((ValueError, TypeError), match=name):
		polytope.settle(**{name: value})


def testWithoutAnIntegratorItIsRefused():
	with pytest.raises(ValueError, match='NewtonIntegrator'):
		polytope.settle()


def testFixedBodiesThatOverlapDoNotCount():
	"""The contact of such bodies bears any force, and would make all others small beside it."""
	block = slope(1.02)
	for x in (30, 30.9):
		O.bodies.append(polytope.cuboid((x, 0, 0), (1, 1, 1), fixed=True))
	polytope.settle()
	assert block.state.vel.norm() < 1e-5 and stays(block)


def testASmallBodyThatFallsBesideALargeOneIsNotAtRest():
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=friction))
	O.bodies.append(polytope.cuboid((0, 0, -1), (20, 20, 1), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 5), (5, 5, 5)))
	small = O.bodies[O.bodies.append(polytope.cuboid((10, 0, 3), (0.1, 0.1, 0.1)))]
	O.engines = polytope.engines()
	polytope.settle()
	assert small.state.pos[2] == pytest.approx(0.1, abs=1e-3) and small.state.vel.norm() < 1e-5


def testAStateSavedMeanwhileHasItsStrength(tmp_path):
	slope(0.9)
	law = O.engines[2].lawDispatcher.functors[0]
	law.unbreakable = True
	O.run(500, wait=True)
	assert O.interactions[0, 1].phys.intact
	O.save(str(tmp_path / 'meanwhile.yade'))
	O.load(str(tmp_path / 'meanwhile.yade'))
	O.run(100, wait=True)
	assert not O.interactions[0, 1].phys.intact


def testNoMoreStepsThanAskedFor():
	slope(1.2)
	with pytest.raises(RuntimeError, match='not at rest after 7 '):
		polytope.settle(steps=7)
	assert O.iter == 7


# ------------------------------------------------------------------------------------------------ density scaling


def slopeWithSlivers(clumped=False):
	"""Two blocks on a plane of 10°, on a plate of a fiftieth of their height, or a clump of two. Returns the ids of what can move."""
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=friction))
	turn, height = Quaternion((0, 1, 0), math.radians(10)), 0.0
	O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, -1), (20, 20, 1), orientation=turn, fixed=True))
	for thick in (0.02, 1.0, 1.0):
		middle = height + thick / 2
		if clumped and thick == 0.02:
			polytope.clump([polytope.cuboid(turn * Vector3(x, 0, middle), (0.5, 1, thick / 2), orientation=turn) for x in (-0.5, 0.5)])
		else:
			O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, middle), (1, 1, thick / 2), orientation=turn))
		height += thick
	O.engines = polytope.engines()
	return [body.id for body in O.bodies if body.id > 0 and not body.isClumpMember]


def rest(clumped, **options):
	moving = slopeWithSlivers(clumped)
	masses = [O.bodies[k].state.mass for k in moving]
	inertias = [Vector3(O.bodies[k].state.inertia) for k in moving]
	taken = polytope.settle(unbalanced=1e-6, **options)
	assert [O.bodies[k].state.mass for k in moving] == masses
	assert [O.bodies[k].state.inertia for k in moving] == inertias
	assert not permanentLoads()
	return taken, {k: Vector3(O.bodies[k].state.pos) for k in moving}


@pytest.mark.parametrize('clumped', [False, True])
def testDensityScalingComesToTheSameRestInFewerSteps(clumped):
	plainly, expected = rest(clumped)
	scaled, found = rest(clumped, densityScaling=True)
	# both parts of the clump swing on their own contacts, which damp the plain run, too
	assert scaled < plainly / (3 if clumped else 4)
	settled = 2600 * 9.81 * 2.02 / 1e9
	# the joints of two parts share the shear by the way on which they came under load: damping=0.7 moves the rest by more than a hundredth
	near = (1e-2 if clumped else 1e-3) * settled
	assert max((place - found[k]).norm() for k, place in expected.items()) < near
	# it stays so with its own masses and time step
	assert O.dt <= 0.4001 * polytope.stableTimeStep(1)
	assert next(engine for engine in O.engines if isinstance(engine, NewtonIntegrator)).damping == 0.2
	O.run(200, wait=True)
	assert max((O.bodies[k].state.pos - place).norm() for k, place in found.items()) < 1e-3 * settled


def testMassesAreTheirOwnWhereItDoesNotComeToRest():
	moving = slopeWithSlivers()
	masses = [O.bodies[k].state.mass for k in moving]
	with pytest.raises(RuntimeError, match='^steps: not at rest'):
		polytope.settle(steps=50, densityScaling=True)
	assert [O.bodies[k].state.mass for k in moving] == masses
	assert not permanentLoads()


def testDensityScalingIsRefusedForMotion():
	slopeWithSlivers()
	O.bodies[0].state.vel = (0.1, 0, 0)
	with pytest.raises(ValueError, match='^densityScaling: body 0 is moved'):
		polytope.settle(densityScaling=True)
	O.bodies[0].state.vel = (0, 0, 0)
	O.engines = O.engines + [QuietBoundary()]
	with pytest.raises(ValueError, match='^densityScaling: O.engines has QuietBoundary'):
		polytope.settle(densityScaling=True)
	with pytest.raises(ValueError, match='^densityScaling'):
		polytope.settle(densityScaling='yes')


@pytest.mark.parametrize('tilt', [20, 35])
def testAColumnThatToppledIsTold(tilt, recwarn):
	"""Twice as high as wide it stands on 26.6°: beyond that it comes to rest on its side, and on less nothing is said."""
	angle = math.radians(tilt)
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=math.radians(60)))
	turn = Quaternion((0, 1, 0), angle)
	O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, -1), (30, 5, 1), orientation=turn, fixed=True))
	O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, 2 - 1e-5), (1, 1, 2), orientation=turn))
	O.engines = polytope.engines()
	recwarn.clear()
	polytope.settle(damping=0.3)
	told = [str(one.message) for one in recwarn if 'moved by more than a tenth of their size' in str(one.message)]
	assert len(told) == (tilt > 26.6)
	assert not told or 'body 1 by ' in told[0]


def testARoofThatComesDownIsTold(recwarn):
	"""A prop is excavated below a block between walls: it comes to rest on the floor below, 2 m deeper."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=math.radians(30)))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (4, 2, 0.5), fixed=True))
	O.bodies.append([polytope.cuboid((x, 0, 2), (1, 1, 2), fixed=True) for x in (-2, 2)])
	prop, roof = O.bodies.append([polytope.cuboid((0, 0, z), (1, 1, 1)) for z in (1, 3)])
	O.engines = polytope.engines()
	polytope.settle()
	polytope.excavate([prop], over=1000)
	recwarn.clear()
	polytope.settle()
	assert O.bodies[roof].state.pos[2] < 1.1
	assert any(f'body {roof} by 2 m' in str(one.message) for one in recwarn)


@pytest.mark.parametrize('gap, told', [(0, True), (1e-3, False)])
@pytest.mark.parametrize('flat', [False, True])
def testABlockThatOnlyTouchesARoofAndFallsIsTold(flat, gap, told, recwarn):
	"""Nothing holds it, and it comes to rest on a floor 4 m below. One that touched nothing was dropped, and is not named."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=math.radians(35)))
	for low, high, half, fixed in ((0, 2, 3, True), (-1 - gap, -gap, 1, False), (-6, -5, 3, True)):
		if flat:
			O.bodies.append(polytope.polygon([(-half, low), (half, low), (half, high), (-half, high)], fixed=fixed))
		else:
			O.bodies.append(polytope.cuboid((0, 0, (low + high) / 2), (half, half, (high - low) / 2), fixed=fixed))
	O.engines = polytope.engines()
	recwarn.clear()
	polytope.settle()
	assert O.bodies[1].state.pos[1 if flat else 2] == pytest.approx(-4.5, abs=1e-3)
	assert any('body 1 by 4 m' in str(one.message) for one in recwarn) == told


@pytest.mark.filterwarnings('ignore:gravity at once')
def testABlockThatHungByABondThatBreaksIsTold(recwarn):
	"""Across a gap, so that it touches nothing; settled with the strengths that the scene has."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9))
	O.bodies.append([polytope.cuboid((0, 0, 1), (3, 3, 1), fixed=True), polytope.cuboid((0, 0, -0.501), (1, 1, 0.5))])
	O.bodies.append(polytope.cuboid((0, 0, -5.5), (3, 3, 0.5), fixed=True))
	O.engines = polytope.engines()
	polytope.bond(gap=2e-3, tensileStrength=0.5 * 2600 * 9.81)
	recwarn.clear()
	polytope.settle(elastic=False)
	assert any('body 1 by 4 m' in str(one.message) for one in recwarn)


@pytest.mark.parametrize('density', [False, True])
def testAClumpUnderAPermanentForceComesToRest(density):
	"""The force counts for its balance, as for that of a single body, with scaled masses, too."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.6))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
	clump, _parts = O.bodies.appendClumped(
		[polytope.cuboid((1.5, 0, 0.25), (1.5, 0.5, 0.25)), polytope.cuboid((0.25, 0, 1.5), (0.25, 0.5, 1))]
	)
	O.engines = polytope.engines()
	O.forces.setPermF(clump, (-0.3 * float(O.bodies[clump].state.mass) * 9.81, 0, 0))
	polytope.settle(densityScaling=density)
	assert O.bodies[clump].state.vel.norm() < 1e-6


def testABlockThatOnlySpinsIsNotAtRest():
	"""Twisted by half as much again as its friction bears: its centre stays, and no force lacks."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=math.radians(30)))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid((0, 0, 0.2), (0.5, 0.5, 0.2)))
	O.engines = polytope.engines(gravity=(0, 0, -9.81))
	yielding = math.tan(math.radians(30)) * O.bodies[block].state.mass * 9.81 * meanArm
	O.forces.setPermT(block, (0, 0, 1.5 * yielding))
	with pytest.raises(polytope.NotAtRest, match=f'body {block} turns in place, by '):
		polytope.settle(elastic=False, steps=3000)
	O.forces.setPermT(block, (0, 0, 0.9 * yielding))
	assert polytope.settle(elastic=False) < 3000
