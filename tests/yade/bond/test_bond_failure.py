# SPDX-License-Identifier: GPL-2.0-or-later
"""How bonds fail, what it costs, and what goes on afterwards; saving, loading, erasing."""

import math
import os

import numpy as np
import pytest
from scenes import gravity, joint, kineticEnergy, loop, stepper
from yade import BartonBandisStrength, ContinuouslyYieldingStrength, HyperbolicClosure, NewtonIntegrator, O, Vector3, polytope

kn, ks = 1e9, 4e8


def driven(velocity, overlap=0.0, ofJoint={}, **strength):
	"""A block bonded on top of a fixed one, moved by the script at this velocity. *ofJoint*: attributes of the joint's material."""
	joint(normalStiffness=kn, shearStiffness=ks, frictionAngle=0.5, **ofJoint)
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.4, 0.3), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.6 - overlap), (0.5, 0.4, 0.3), fixed=True))
	loop(True)
	with pytest.warns(UserWarning, match='no bond was made'):
		assert polytope.bond(**strength) == 0  # without ids no pair of fixed bodies
	assert polytope.bond(ids=[0, 1], **strength) == 1
	O.bodies[1].state.vel = velocity
	O.dt = 1e-5
	O.trackEnergy = True
	return polytope.bonds().bonds[0]


def runUntilItFails(bond, most=20000):
	"""State of the step in which it fails: force on body 2 and work until then, by the force on a body that the script moves."""
	work = 0.0
	while bond.intact:
		before = bond.force
		O.step()
		work -= (before + bond.force).dot(O.bodies[1].state.vel) * O.dt / 2
		most -= 1
		assert most > 0
	return Vector3(bond.force), work


def testPulledItFailsAtTheTensileStrength():
	bond = driven((0, 0, 0.01), tensileStrength=1e5, cohesion=1e6)
	force, _ = runUntilItFails(bond)
	assert bond.failure == 'tension' and bond.area == pytest.approx(0.8, rel=1e-12)
	assert -force[2] == pytest.approx(1e5 * 0.8, rel=2e-3)  # a step moves it by 1e-3 of the opening
	O.step()
	assert O.forces.f(1).norm() == 0 and polytope.bonds().intactCount == 0
	assert O.energy['fractureDissip'] == pytest.approx(0.8 * 1e5**2 / (2 * kn), rel=1e-2)


def testShearedItFailsAtTheCohesion():
	bond = driven((0.01, 0, 0), tensileStrength=1e6, cohesion=1e5, frictionAngle=0.5, bendingShare=0)
	force, _ = runUntilItFails(bond)
	assert bond.failure == 'shear' and -force[0] == pytest.approx(1e5 * 0.8, rel=1e-2)
	O.step()
	assert O.energy['fractureDissip'] == pytest.approx(0.8 * 1e5**2 / (2 * ks), rel=1e-2)


def testItBearsNoMoreTensionThanTheConeOfMohrCoulomb():
	"""Pulled without any shear it fails at c/tan φ, where that is less than the tensile strength."""
	bond = driven((0, 0, 0.01), tensileStrength=1e6, cohesion=1e5, frictionAngle=1.0)
	runUntilItFails(bond)
	assert bond.failure == 'shear' and bond.normalStress == pytest.approx(1e5 / math.tan(1.0), rel=1e-2)


@pytest.mark.parametrize('overlap', [0.0, 1e-4])
def testPressedItFailsWithFrictionAndTheJointGoesOn(overlap):
	"""Mohr-Coulomb; normal force and stored shear force of the joint begin where the bond's end, also where the bond was made in an overlap."""
	bond = driven((0, 0, -0.1), overlap, tensileStrength=1e6, cohesion=1e5, frictionAngle=0.5)
	for _ in range(200):
		O.step()
	pressed = bond.force[2]
	assert pressed == pytest.approx(kn * 0.8 * 2e-4, rel=1e-2)
	O.bodies[1].state.vel = (0.1, 0, 0)
	O.step()
	force, work = runUntilItFails(bond)
	normal = force[2]
	assert bond.failure == 'shear'
	assert -force[0] == pytest.approx(1e5 * 0.8 + normal * math.tan(0.5), rel=1e-2)
	stored = bond.energy
	O.step()
	contact = O.interactions[0, 1]
	along = -contact.phys.shearForce[0] if contact.id1 == 0 else contact.phys.shearForce[0]
	# the contact's pressure falls to zero at the face's edges, the bond's does not: a difference of the depth over the face's width
	assert contact.phys.normalForce.norm() == pytest.approx(normal, rel=1.5e-3) and not contact.phys.intact
	assert along == pytest.approx(normal * math.tan(0.5), rel=1.5e-3)
	# what is stored, and what is lost: the bond's energy and the work of this step, less what the joint stores
	joints = contact.phys.normalForce.squaredNorm() / (2 * contact.phys.kn) + along**2 / (2 * contact.phys.ks)
	given = (-force[0] + along) / 2 * 0.1 * O.dt
	assert O.energy['elastPotential'] == pytest.approx(joints, rel=1e-3)
	assert O.energy['fractureDissip'] == pytest.approx(stored + given - joints, rel=1e-3)
	for _ in range(100):
		O.step()
	assert O.forces.f(1)[2] == pytest.approx(normal, rel=2e-3)


@pytest.mark.parametrize(
	'ofJoint',
	[
		{},
		dict(dilationAngle=math.radians(1)),
		dict(
			dilationAngle=0.2,
			cohesion=1e5,
			residualCohesion=1e4,
			tensileStrength=1e4,
			residualTensileStrength=1e3,
			residualFrictionAngle=0.4,
		),
		dict(closure=HyperbolicClosure(maximumClosure=1e-3), dilationAngle=0.2),
		dict(strength=BartonBandisStrength(JRC=10, JCS=1e8)),
		dict(strength=ContinuouslyYieldingStrength(initialFrictionAngle=0.9)),
	],
	ids=['plain', 'dilation', 'residual', 'closure', 'Barton-Bandis', 'yielding'],
)
def testTheOverlapOfABondPressesOnNoJointThatFollowsIt(ofJoint):
	"""Whatever the joint is: where the bond had no force it has that of its dilation alone, and of the overlap (here 80 kN) nothing."""
	overlap = 1e-4
	bond = driven((0.1, 0, 0), overlap, ofJoint, tensileStrength=1e9, cohesion=1e4, frictionAngle=0.5, bendingShare=0)
	runUntilItFails(bond)
	assert bond.failure == 'shear' and bond.overlap == pytest.approx(overlap, rel=1e-9)
	for _ in range(10):
		O.step()
		phys = O.interactions[0, 1].phys  # None: a joint that nothing presses on has ended
		dilation = phys.dilation if phys else 0
		assert abs(O.forces.f(1)[2]) <= kn * 0.8 * (dilation * 1.05 + 2e-3 * overlap)
	assert 'dilationAngle' not in ofJoint or (dilation > 0 and phys.restOverlap == bond.overlap)


def testABrickHangsByItsBondAMillimetreOffCentre():
	joint(normalStiffness=1e10, shearStiffness=1e10)
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.05, 0.05, 0.05), fixed=True))
	O.bodies.append(polytope.cuboid((0.001, 0, -0.1), (0.05, 0.05, 0.05)))
	loop(True, damping=0.3, gravity=(0, 0, -gravity))
	weight = O.bodies[1].state.mass * gravity
	area = 0.1 * 0.099
	polytope.bond(tensileStrength=390 * weight / area, cohesion=390 * weight / area)
	stepper()
	while O.time < 0.1:
		O.run(1000, wait=True)
	bond = polytope.bonds().bonds[0]
	assert bond.intact and bond.force[2] == pytest.approx(weight, rel=1e-3)
	# half a millimetre of lever: moment over the bending stiffness of the area
	inertia = 0.1 * 0.099**3 / 12
	assert abs(bond.moment[1]) == pytest.approx(weight * 0.5e-3, rel=1e-2)
	assert O.bodies[1].state.ori.toAxisAngle()[1] == pytest.approx(weight * 0.5e-3 / (1e10 * inertia), rel=1e-2)


def testEnergyOfAVibratingChainIsKept():
	joint(normalStiffness=kn, shearStiffness=ks)
	O.bodies.append([polytope.cuboid((k, 0, 0), (0.5, 0.5, 0.5), fixed=k == 0) for k in range(4)])
	loop(True)
	polytope.bond()
	stepper(timestepSafetyCoefficient=0.02)
	O.trackEnergy = True
	O.bodies[3].state.vel = (0.3, 0.5, -0.4)
	start = O.bodies[3].state.mass * 0.25
	worst = 0

	def kinetic():
		return sum(kineticEnergy(body.state) for body in O.bodies)

	before = kinetic()
	for _ in range(3000):
		O.step()
		now = kinetic()  # half a step later and half a step before the stored energy
		worst = max(worst, abs((before + now) / 2 + O.energy['elastPotential'] - start))
		before = now
	assert worst < 1e-3 * start


def testALoadedSceneGoesOnAsTheSavedOne(tmp_path):
	def scene():
		joint(normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.4)
		blocks = polytope.voronoi(((0, 0, 0.01), (1, 1, 1.01)), 10, seed=2).blocks
		O.bodies.append([polytope.fromHalfSpaces(*block) for block in blocks])
		O.bodies.append(polytope.cuboid((0.5, 0.5, -0.5), (3, 3, 0.5), fixed=True))
		loop(True, gravity=(0, 0, -gravity), normalDamping=0.2)
		polytope.bond(ids=range(10), tensileStrength=8e5, cohesion=8e5, frictionAngle=0.5)
		for body in O.bodies:
			if body.dynamic:
				body.state.vel = (0, 0, -2)
		O.dt = 5e-5

	def states():
		return np.array([[*body.state.pos, *body.state.ori] for body in O.bodies], float)

	path = str(tmp_path / 'bonded.yade.bz2')
	scene()
	O.run(200, wait=True)
	O.save(path)
	saved = polytope.bonds().intactCount
	O.run(300, wait=True)
	expected, left = states(), polytope.bonds().intactCount
	O.reset()
	O.load(path)
	assert os.path.getsize(path) > 0 and polytope.bonds().intactCount == saved
	O.run(300, wait=True)
	assert polytope.bonds().intactCount == left
	assert 0 < left < saved <= len(polytope.bonds().bonds)  # some fail after the loading
	assert np.abs(states() - expected).max() < 1e-9


@pytest.mark.parametrize('saved', [False, True])
def testBodiesMadeAnewAreNotBonded(saved, tmp_path):
	"""O.bodies.clear() gives the same numbers to other bodies; O.engines stay."""
	bond = driven((0, 0, 0))
	O.step()
	if saved:
		O.save(str(tmp_path / 'scene.yade'))
		O.load(str(tmp_path / 'scene.yade'))
		O.step()
		bond = polytope.bonds().bonds[0]
	O.bodies.clear()
	O.bodies.append([polytope.cuboid((0, 0, 2 * k), (0.5, 0.4, 1), fixed=k == 0) for k in range(2)])
	O.step()
	assert bond.failure == 'erased' and O.forces.f(1).norm() == 0
	O.bodies.clear()
	O.bodies.append([polytope.cuboid((0, 0, 2 * k), (0.5, 0.4, 1), fixed=k == 0) for k in range(2)])
	assert polytope.bond() == polytope.bonds().intactCount == 1


def testABondEndsWithAnErasedBody():
	joint(normalStiffness=kn, shearStiffness=ks)
	O.bodies.append([polytope.cuboid((k, 0, 0), (0.5, 0.5, 0.5), fixed=k == 0) for k in range(3)])
	loop(True, gravity=(0, 0, -gravity))
	polytope.bond()
	stepper()
	O.run(20, wait=True)
	O.bodies.erase(1)
	O.run(200, wait=True)
	assert {bond.failure for bond in polytope.bonds().bonds} == {'erased'} and polytope.bonds().intactCount == 0
	assert O.bodies[2].state.vel[2] < -1e-3 * gravity * O.time
	assert polytope.bonds().bonds[0].energy == 0 and next(e for e in O.engines if isinstance(e, NewtonIntegrator))


def hung(offset, size=(0.1, 0.1, 0.1), **strength):
	"""A brick below another one, beside its place by so much, bonded with the strengths of their material; and the largest stress at the
	edge of their common face under the brick's weight: weight and eccentricity over area and section modulus."""
	joint(normalStiffness=1e11, shearStiffness=1e11, frictionAngle=0.5, **strength)
	half = Vector3(*size) / 2
	O.bodies.append(polytope.cuboid((0, 0, size[2]), half, fixed=True))
	O.bodies.append(polytope.cuboid((offset, 0, 0), half))
	newton = loop(True, damping=0.5)
	assert polytope.bond() == 1 and 'tension' not in [found.what for found in polytope.check(O)]
	stepper()
	width = size[0] - offset
	weight = O.bodies[1].state.mass * gravity
	return newton, weight / (width * size[1]) * (1 + 6 * (offset / 2) / width)


def testAJointOfItsMaterialsStrengthHoldsABrickOffCentre():
	"""By 1 mm, with 390 times the weight. The faces only touch: there is no contact yet that could hold (test_joint_tension.py)."""
	newton, stress = hung(0.001, tensileStrength=390 * 2600 * gravity * 0.1, cohesion=1e9)
	newton.gravity = (0, 0, -gravity)
	O.run(20000, wait=True)
	bond, brick = polytope.bonds().bonds[0], O.bodies[1].state
	assert bond.intact and bond.edgeStress == pytest.approx(stress, rel=1e-6)
	angle = O.bodies[1].state.mass * gravity * 0.0005 / (1e11 * 0.1 * 0.099**3 / 12)
	assert 2 * abs(brick.ori[1]) == pytest.approx(angle, rel=1e-4) and brick.vel.norm() < 1e-9


@pytest.mark.parametrize('size, offset', [((0.1, 0.1, 0.1), 0.001), ((2, 1, 1), 0.4)])
def testAHungBlockFallsWhereTheStressAtTheEdgeReachesItsStrength(size, offset):
	newton, stress = hung(offset, size, tensileStrength=1e6, cohesion=1e9)
	bond, times = polytope.bonds().bonds[0], 1e6 / stress
	for k in range(20000):
		newton.gravity = (0, 0, -gravity * 1.1 * times * k / 20000)
		O.step()
		if not bond.intact:
			break
	assert bond.failure == 'tension' and -newton.gravity[2] / gravity == pytest.approx(times, rel=0.01)
	O.run(100, wait=True)
	assert not O.interactions.countReal(), 'it falls'


def testStrengthsAreThoseOfTheMaterialsIfTheyHaveAny():
	for strength, expected in (
		({}, (math.inf, math.inf)),
		({'cohesion': 2e5}, (0, 2e5)),
		({'cohesion': 2e5, 'tensileStrength': 1e5}, (1e5, 2e5)),
	):
		O.reset()
		hung(0, **strength)
		bond = polytope.bonds().bonds[0]
		assert (bond.tensileStrength, bond.cohesion) == expected
