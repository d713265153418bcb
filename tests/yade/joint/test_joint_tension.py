# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints with tensile strength and stiffness per area: they hold over their whole area, however they are tilted (pkg/polytope/joint/RockJointBond.cpp)."""

import math

import numpy as np
import pytest
from scenes import gravity, joint, loop, stepper
from yade import O, Quaternion, polytope

kn, ks = 1e9, 4e8
overlap = 5e-6


def hung(offset=0.0, half=(0.05, 0.05, 0.05), damping=0.3, **strength):
	"""A brick below a fixed one, moved aside along x."""
	joint(normalStiffness=kn, shearStiffness=ks, **dict(dict(tensileStrength=1e6, cohesion=1e6), **strength))
	O.bodies.append(polytope.cuboid((0, 0, 0), half, fixed=True))
	O.bodies.append(polytope.cuboid((offset, 0, -2 * half[2] + overlap), half))
	newton = loop(True, normalDamping=damping, shearDamping=damping, damping=damping)
	stepper()
	return newton, O.bodies[1].state


def edgeStress(offset, half, weight):
	"""Stress at the edge as in a beam: the faces have a strip less in common, and the weight acts beside its middle."""
	width, depth = 2 * half[0] - offset, 2 * half[1]
	return weight / (width * depth) * (1 + 6 * (offset / 2) / width)


@pytest.mark.parametrize('offset', [0, 1e-3, 1e-2, 3e-2])
def testABrickHungBesideItsMiddleHolds(offset):
	newton, state = hung(offset)
	newton.gravity = (0, 0, -gravity)
	O.run(4000, wait=True)
	contact, weight = O.interactions[0, 1], state.mass * gravity
	area = (0.1 - offset) * 0.1
	assert contact.phys.intact and contact.phys.contactArea == pytest.approx(area, rel=1e-9)
	assert contact.phys.normalForce[2] == pytest.approx(weight, rel=1e-3)
	assert contact.phys.bond.edgeStress == pytest.approx(edgeStress(offset, (0.05, 0.05, 0.05), weight), rel=2e-3)
	tilt = weight * offset / 2 / (kn * 0.1 * (0.1 - offset) ** 3 / 12)
	assert state.ori.toAxisAngle()[1] == pytest.approx(tilt, rel=1e-2, abs=1e-12)
	assert -0.1 - state.pos[2] == pytest.approx(weight / (kn * area) + tilt * offset / 2, rel=1e-2)


def testItFailsWhereTheStressAtItsEdgeReachesTheStrength():
	"""Gravity grows slowly. One tenth beside the middle, the strength at the edge is reached at two thirds of the straight pull."""
	offset, half = 1e-2, (0.05, 0.05, 0.05)
	newton, state = hung(offset, tensileStrength=2e4, cohesion=1e6)
	held = 0
	for factor in np.linspace(0, 10, 401):
		newton.gravity = (0, 0, -gravity * factor)
		O.run(60, wait=True)
		if not O.interactions.has(0, 1) or not O.interactions[0, 1].isReal or not O.interactions[0, 1].phys.intact:
			break
		held = factor
	expected = 2e4 / edgeStress(offset, half, state.mass * gravity)
	assert held == pytest.approx(expected, rel=1e-2) and expected > 5
	O.run(2000, wait=True)
	assert state.pos[2] < -0.11  # nothing holds it any more


def testABlockUnderARoofDoesNotSwingOff():
	joint(normalStiffness=kn, shearStiffness=kn, tensileStrength=1e6, cohesion=1e6)
	O.bodies.append(polytope.cuboid((0, 0, 1.5 - 1e-6), (3, 3, 0.5), fixed=True))
	block = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0.5), (1, 0.5, 0.5)))]
	loop(True, normalDamping=0.2, shearDamping=0.2, gravity=(0, 0, -gravity), damping=0.2)
	stepper()
	while O.time < 0.3:
		O.run(200, wait=True)
	assert O.interactions[0, 1].phys.intact
	assert 0.5 - block.state.pos[2] == pytest.approx(block.state.mass * gravity / (kn * 2) - 1e-6 + 1e-6, rel=0.1)
	assert block.state.ori.toAxisAngle()[1] < 1e-9


def testAPolygonHoldsAsWell():
	joint(normalStiffness=kn, shearStiffness=ks, tensileStrength=1e6, cohesion=1e6)
	O.bodies.append(polytope.polygon([(-3, 1 - 1e-6), (3, 1 - 1e-6), (3, 2), (-3, 2)], fixed=True))
	block = O.bodies[O.bodies.append(polytope.polygon([(-1, 0), (1.2, 0), (1, 1), (-1, 1)]))]
	loop(True, normalDamping=0.2, shearDamping=0.2, gravity=(0, -gravity, 0), damping=0.2)
	stepper()
	start = Quaternion(block.state.ori)  # that of its principal axes
	O.run(8000, wait=True)
	contact = O.interactions[0, 1]
	assert contact.phys.intact and contact.phys.normalForce[1] == pytest.approx(block.state.mass * gravity, rel=1e-3)
	moment = block.state.mass * gravity * block.state.pos[0]
	assert abs((start.conjugate() * block.state.ori).toAxisAngle()[1]) == pytest.approx(moment / (kn * 2**3 / 12), rel=1e-4)


@pytest.mark.parametrize('tilt', [0, 2e-6, 4e-5])
def testWhileAllOfItIsPressedItIsTheOrdinaryFoundation(tilt):
	"""Force and moment of the overlap and of the springs over the faces, but for what the faces' edges take off the pressure of the
	overlap: its depth over their width."""
	found = []
	for strength in (0, 1e6):
		O.reset()
		joint(normalStiffness=kn, shearStiffness=ks, tensileStrength=strength, cohesion=1e6)
		turn = Quaternion((0, 1, 0), tilt)
		O.bodies.append(polytope.cuboid((0, 0, -1), (2, 2, 1), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, 0.5 - 1e-4), (0.5, 0.4, 0.5), orientation=turn, fixed=True))
		loop(True)
		O.dt = 1e-9
		O.step()
		assert bool(O.interactions[0, 1].phys.bond) == (strength > 0)
		found.append(np.array([*O.forces.f(1), *O.forces.t(1)], float))
	assert found[1][2] == pytest.approx(found[0][2], rel=1.3e-4)
	assert found[1][4] == pytest.approx(found[0][4], rel=2e-3, abs=1e-3 * kn * 1e-9)
	if tilt:
		assert -found[0][4] == pytest.approx(kn * tilt * 0.8 / 12, rel=2e-3)


def testOnlyAStiffnessPerAreaAndATensileStrengthMakeIt():
	for perArea, tension, expected in ((True, 1e5, True), (False, 1e5, False), (True, 0, False)):
		O.reset()
		joint(normalStiffness=kn, shearStiffness=ks, tensileStrength=tension, cohesion=1e5)
		O.bodies.append(polytope.cuboid((0, 0, 0), (0.05, 0.05, 0.05), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, 0.1 - overlap), (0.05, 0.05, 0.05), fixed=True))
		loop(perArea)
		O.dt = 1e-9
		O.step()
		assert bool(O.interactions[0, 1].phys.bond) == expected


def testNothingIsGluedWhereTheFacesDoNotTouch():
	"""A brick that stands on its edge, tilted by less than the largest angle of faces that face each other: the far side is open."""
	joint(normalStiffness=kn, shearStiffness=ks, tensileStrength=1e5, cohesion=1e5)
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.05, 0.05, 0.05), fixed=True))
	turn = Quaternion((0, 1, 0), 5e-3)
	O.bodies.append(polytope.cuboid((0, 0, 0.1 + 0.05 * 5e-3 - overlap), (0.05, 0.05, 0.05), orientation=turn, fixed=True))
	loop(True)
	O.dt = 1e-9
	O.step()
	phys = O.interactions[0, 1].phys
	assert phys.intact and phys.bond is None and phys.normalForce.norm() > 0


def testAnEdgeThatPartsLeavesCohesionOnWhatIsPressed():
	"""A block that is pushed over: its tensile strength goes first, its cohesion holds where it is still pressed."""
	joint(normalStiffness=kn, shearStiffness=ks, tensileStrength=10, cohesion=1e6)
	O.bodies.append(polytope.cuboid((0, 0, -1), (2, 2, 1), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.5 - overlap), (0.5, 0.5, 0.5)))
	newton = loop(True, normalDamping=0.3, shearDamping=0.3, damping=0.3)
	newton.gravity = (0, 0, -gravity)
	stepper()
	O.run(1000, wait=True)
	assert O.interactions[0, 1].phys.bond
	newton.gravity = (0.6 * gravity, 0, -gravity)  # the resultant leaves the core of the base, and stays on the base
	O.run(3000, wait=True)
	phys = O.interactions[0, 1].phys
	assert phys.intact and phys.bond is None and phys.tensileStrength == 0 and phys.cohesion == 1e6
	assert 0.3 < phys.contactArea < 0.8
	assert abs(phys.shearForce[0]) == pytest.approx(0.6 * O.bodies[1].state.mass * gravity, rel=1e-2)


def testMotionOfAHungBlockKeepsItsEnergy():
	"""There are no dampers; the energy is kept also in the step in which the joint fails: all that it had stored is the energy of fracture."""
	newton, state = hung(2e-2, damping=0.0, tensileStrength=3e4)
	O.trackEnergy = True
	newton.gravity = (0, 0, -gravity)
	O.engines = O.engines[:-1]
	O.dt = 2e-7
	O.step()
	state.vel, state.angVel = (0, 0, -0.02), (0, 0.1, 0)
	O.step()
	begin, scale = O.energy.total(), state.mass * 0.02**2
	for _ in range(30):
		O.run(20, wait=True)
		assert O.energy.total() == pytest.approx(begin, abs=2e-3 * scale)
	assert O.interactions[0, 1].phys.intact
	state.vel = (0, 0, -0.5)
	O.step()
	begin, scale = O.energy.total(), state.mass * 0.5**2
	while O.interactions[0, 1].isReal and O.interactions[0, 1].phys.intact:
		O.step()
	for _ in range(5):
		O.step()
	assert O.energy['fractureDissip'] > 0
	assert O.energy.total() == pytest.approx(begin, abs=2e-3 * scale)
	assert abs(O.energy['nonconservative']) < 2e-3 * scale


@pytest.mark.parametrize('archive', ['state.xml', 'state.yade'])
def testALoadedSceneGoesOnWithTheSameJoint(archive, tmp_path):
	newton, _ = hung(1e-2)
	newton.gravity = (0, 0, -gravity)
	O.run(500, wait=True)
	O.save(str(tmp_path / archive))
	ends = []
	for _ in range(2):
		O.run(300, wait=True)
		ends.append([*O.bodies[1].state.pos, *O.bodies[1].state.ori])
		O.load(str(tmp_path / archive))
		assert O.interactions[0, 1].phys.bond.area == pytest.approx(9e-3, rel=1e-9)
	assert ends[0] == pytest.approx(ends[1], abs=1e-13)


def testScriptsMayTakeItsStrength():
	newton, state = hung(1e-2)
	newton.gravity = (0, 0, -gravity)
	O.run(500, wait=True)
	O.interactions[0, 1].phys.tensileStrength = 0
	O.run(3000, wait=True)
	assert state.pos[2] < -0.101


def testItsTimeStepFollowsItsBending():
	"""A plate in tension has a rotation about y that is faster than its motion along the pull."""
	half = (0.1, 0.02, 0.005)
	newton, state = hung(0, half=half, damping=0.0)
	newton.gravity = (0, 0, -gravity)
	O.engines[-1].timestepSafetyCoefficient = 1
	O.run(1000, wait=True)
	assert O.interactions[0, 1].geom.penetrationDepth < 0
	area, lever = 4 * half[0] * half[1], half[2]
	bending = kn * half[1] * half[0] ** 3 * 4 / 3
	stiffness = np.array([[ks * area, ks * area * lever], [ks * area * lever, ks * area * lever**2 + bending]])
	inertia = np.array([state.mass, state.inertia[1]], float)
	omega = math.sqrt(max(np.linalg.eigvalsh(stiffness / np.sqrt(np.outer(inertia, inertia)))))
	assert float(O.dt) < 1 / omega


def cantilever(number, **strength):
	"""Cubes in a row along x, of which the first is fixed; pressed together by a millionth of their size."""
	joint(normalStiffness=1e10, shearStiffness=4e9, **dict(dict(tensileStrength=1e9, cohesion=1e9), **strength))
	O.bodies.append([polytope.cuboid((k * (0.1 - 1e-7), 0, 0), (0.05, 0.05, 0.05), fixed=k == 0) for k in range(number + 1)])
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.5)
	O.run(50, wait=True)
	return O.bodies[number]


def testACantileverOfBlocksBendsAsABeam():
	"""The deflection of docs/bonds.md, by ordinary joints."""
	number, load = 5, 10.0
	last = cantilever(number)
	start = float(last.state.pos[2])
	O.forces.setPermF(number, (0, 0, -load))
	O.run(15000, wait=True)
	second, area = 0.1**4 / 12, 0.01
	deflection = load * 0.1**2 / (1e10 * second) * (number**3 / 3 - number / 12) + number * load / (4e9 * area)
	assert start - last.state.pos[2] == pytest.approx(deflection, rel=1e-5)


def testStressOfABlockInACantileverIsThatOfBonds():
	"""Mean of the stress by shear and bending."""
	found = []
	for bonded in (False, True):
		O.reset()
		cantilever(3)
		if bonded:
			polytope.bond()
		O.forces.setPermF(3, (0, 0, -10))
		O.run(12000, wait=True)
		found.append(polytope.bodyStress([2])[2])
	assert abs(found[1][2, 0]) == pytest.approx(10 / 0.01, rel=1e-3)
	assert found[0] == pytest.approx(found[1], abs=1e-2 * 10 / 0.01)


def testACantileverOfBlocksBreaksAtTheStressOfItsOutermostFibre():
	number, strength = 5, 1e6
	cantilever(number, tensileStrength=strength)
	expected = strength * (0.1**4 / 12 / 0.05) / (0.1 * (number - 0.5))
	load = 0
	while (held := O.interactions.has(0, 1) and O.interactions[0, 1].phys.bond) and load < 1.2 * expected:
		load += expected / 200  # slowly
		O.forces.setPermF(number, (0, 0, -load))
		O.run(1000, wait=True)
	assert not held
	assert load == pytest.approx(expected, rel=1e-2)
