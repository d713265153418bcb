# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.mechanicalEnergy(): constant to rounding where the leapfrog scheme has an exact invariant, at any time step."""

import warnings
from math import sqrt

import pytest
from flatFace import faceEnergy
from scenes import blockOnFloor, contact, density, gravity, joint, loop
from yade import (
	FrictMat,
	HyperbolicClosure,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	MatchMaker,
	Matrix3,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
	utils,
)
from yade.polytope.measures.energy import storedEnergy
from yade.polytope.motionRecord import MotionRecord


def energies(steps):
	values = [polytope.mechanicalEnergy() for _ in range(steps)]
	return max(abs(value / values[0] - 1) for value in values[1:])


def testFreeFlightOfATumblingCube():
	joint()
	loop(gravity=(1, 2, -gravity))
	cube = polytope.cuboid((0, 0, 5), (0.5, 0.5, 0.5), Quaternion((1, 2, 3), 1))
	O.bodies.append(cube)
	cube.state.vel, cube.state.angVel = (3, 1, 2), (1, 5, 3)
	O.dt = 0.01
	assert energies(50) < 1e-12


def testInAShearedCellItDoesNotMatterWhichImageABodyIsIn():
	def energy(cells):
		O.reset()
		joint()
		loop(gravity=(0, 0, 0))
		O.periodic = True
		O.cell.setBox(2, 3, 4)
		O.cell.velGrad = Matrix3(0, 0, 20, 0, 0, 0, 0, 0, 0)
		O.dt = 1e-4
		cube = polytope.cuboid((0.5, 1, 1), (0.3, 0.2, 0.25))
		O.bodies.append(cube)
		O.step()
		cube.state.pos += Vector3(0, 0, 4 * cells)
		cube.state.vel = O.cell.velGrad * cube.state.pos + Vector3(0.1, 0.2, 0.3)
		return polytope.mechanicalEnergy(), cube.state.mass * 0.14 / 2

	for cells in (0, 1, 100):
		own, beside = energy(cells)
		assert own == pytest.approx(beside, rel=1e-10)


@pytest.mark.parametrize('model', ['boon2012', 'spring'])
def testBounceOnASpringAtAnyTimeStep(model):
	"""Face on face the spring is linear; that of the contact surface but for its rim, as wide as the overlap is deep."""
	joint(normalStiffness=1e7)
	loop(gravity=(0, 0, -gravity), ig2={'contactModel': model})
	_, block = blockOnFloor(4e-3)
	block.state.blockedDOFs = 'XYZ'  # so long a step is not stable in rotation
	O.dt = 0.5 * sqrt(density / 1e7)
	heights = []
	for _ in range(40):
		heights.append(block.state.pos[2])
		O.step()
	assert max(heights) < 0.5 and max(heights) - min(heights) > 1e-3  # it swings, and stays in contact
	assert energies(40) < (1e-12 if model == 'boon2012' else 1e-7)


@pytest.mark.parametrize('perArea', [True, False])
@pytest.mark.parametrize('pieces', [1, 2])
def testASphereThatBouncesKeepsItsEnergy(perArea, pieces):
	"""With a stiffness per area its disc grows as it sinks in: the energy is about a third of force times depth, a linear spring's half."""
	O.materials.append(
		RockJointMat(density=2600, normalStiffness=3e8 if perArea else 2e7, shearStiffness=1e7, frictionAngle=0, stiffnessPerArea=perArea)
	)
	O.bodies.append([polytope.cuboid((x, 0, -0.5), (2 / pieces, 2, 0.5), fixed=True) for x in ([0] if pieces == 1 else [-1, 1])])
	O.bodies.append(utils.sphere((0.013, 0, 0.2001), 0.2))
	O.bodies[-1].state.vel = (0.3, 0, -3)
	O.engines = polytope.engines(damping=0, gravity=(0, 0, 0), timeStepper=False, law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb())
	O.dt = 2e-6
	first, depths = polytope.mechanicalEnergy(), []
	while not depths or any(contact.isReal for contact in O.interactions):
		O.step()
		if any(contact.isReal for contact in O.interactions):
			depths.append(max(contact.geom.penetrationDepth for contact in O.interactions if contact.isReal))
			if len(depths) % 50 == 0:
				assert polytope.mechanicalEnergy() == pytest.approx(first, rel=1e-4)
	assert max(depths) > 5e-3


def testIsOfThePositionsTheStepBeganAt():
	joint(normalStiffness=1e7)
	loop(gravity=(0, 0, -gravity))
	_, block = blockOnFloor(4e-3)
	O.dt = 1e-4
	weight = block.state.mass * gravity
	assert polytope.mechanicalEnergy() == pytest.approx(weight * (0.5 - 4e-3) + 1e7 * faceEnergy(4e-3), rel=1e-12)
	assert O.iter == 1 and block.state.vel != Vector3.Zero


def testShearSpringCounts():
	joint(normalStiffness=1e7, shearStiffness=1e7)
	loop()
	_, block = blockOnFloor(4e-3)
	O.dt = 1e-9
	before = polytope.mechanicalEnergy()
	contact(O.bodies[0], block).phys.shearForce = (1e4, 0, 0)
	assert polytope.mechanicalEnergy() - before == pytest.approx(1e4**2 / 2e7, rel=1e-6)


def testClumpMembersCountOnce():
	joint()
	loop(gravity=(0, 0, -gravity))
	clump, _ = O.bodies.appendClumped([polytope.cuboid((x, 0, 3), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5)])
	O.dt = 1e-4
	assert polytope.mechanicalEnergy() == pytest.approx(O.bodies[clump].state.mass * gravity * 3, rel=1e-9)


def testSceneWithoutIntegratorIsRefused():
	with pytest.raises(ValueError, match='NewtonIntegrator'):
		polytope.mechanicalEnergy()


def touching(one, other):
	return O.interactions.has(one.id, other.id, onlyReal=True)


@pytest.mark.parametrize('model', ['boon2012', 'surface'])
@pytest.mark.parametrize('kind', ['dilation', 'closure', 'tension', 'residualTension'])
def testStoredEnergyIsThatOfTheLaw(kind, model):
	"""Where the force is not the geometry's own times a constant stiffness, too: a block that widens its joint by sliding, with a closure
	of its own, and that is pulled off."""
	joint(
		normalStiffness=1e7,
		**{
			'dilation': {'dilationAngle': 0.3},
			'closure': {'closure': HyperbolicClosure(maximumClosure=0.05)},
			'tension': {'tensileStrength': 1e5},
			'residualTension': {'tensileStrength': 1e5, 'residualTensileStrength': 5e4},
		}[kind],
	)
	newton = loop(perArea=model == 'surface', gravity=(0, 0, -gravity), ig2={"contactModel": model, "computeEnergy": True})
	floor, block = blockOnFloor(4e-3)
	O.trackEnergy = True
	O.dt = 1e-4
	block.state.blockedDOFs = 'XYZ'
	block.state.vel = (0, 0, 1.5) if 'ension' in kind else (1, 0, 0)
	seen, record = [], MotionRecord(block, lambda: contact(floor, block) if touching(floor, block) else None, newton)
	for _ in range(150):
		record.step()
		if touching(floor, block):
			one = contact(floor, block)
			assert sum(storedEnergy(one)) == pytest.approx(O.energy['elastPotential'], rel=1e-9, abs=1e-9), O.iter
			seen.append((float(one.geom.penetrationDepth), float(one.phys.dilation)))
	depths, dilations = zip(*seen, strict=True)
	assert max(dilations) > 1e-3 or kind != 'dilation'
	assert min(depths) < -1e-3 or 'ension' not in kind
	record.finish()
	assert record.elasticEnergy() == pytest.approx(record.elastPotential, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize('physics', ['frictMat', 'perContact', 'perArea'])
def testABlockThatRocksOnItsFaceKeepsItsEnergy(physics):
	"""There is no damping: the peaks of the block's kinetic energy stay the same over 50 swings, whatever the physics, all of which have the same
	stiffness."""
	half, stiffness = 0.5, 1e7
	if physics == 'frictMat':
		O.materials.append(FrictMat(density=2500, young=1, poisson=0.5, frictionAngle=0.6))
		given = {name: MatchMaker(algo='val', val=value) for name, value in (('kn', stiffness), ('ks', stiffness / 2))}
		made = Ip2_FrictMat_FrictMat_FrictPhys(**given)
	else:
		O.materials.append(RockJointMat(density=2500, normalStiffness=stiffness, shearStiffness=stiffness / 2, frictionAngle=0.6))
		made = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=physics == 'perArea')
	O.bodies.append(polytope.cuboid((0, 0, -half), (2, 2, half), fixed=True))
	mass = 2500 * (2 * half) ** 3
	sink = mass * 10 / stiffness
	block = O.bodies[O.bodies.append(polytope.cuboid((0, 0, half - sink), (half, half, half), Quaternion((0, 1, 0), 0.1 * sink / half)))]
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')  # of energy without damping
		O.engines = polytope.engines(gravity=(0, 0, -10), physics=made, damping=0, timeStepper=False)
	if physics != 'frictMat':
		O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.dt = 0.05 * sqrt(mass / stiffness)
	peaks = []
	for _ in range(5):
		peak = 0
		for _ in range(120):
			O.run(20, wait=True)
			peak = max(peak, mass * block.state.vel.squaredNorm() / 2 + block.state.inertia[1] * block.state.angVel.squaredNorm() / 2)
		peaks.append(peak)
	assert peaks == pytest.approx([peaks[0]] * 5, rel=0.03)
