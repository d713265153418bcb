# SPDX-License-Identifier: GPL-2.0-or-later
"""O.trackEnergy: the meaning of the terms, and their sum.

The law takes work over a step with the mean of the forces at both ends. With the kinetic energy ½ m v(n−½)·v(n+½) the sum of all
terms is then constant to rounding whatever happens in a contact; the term *nonconservative* is what stored, frictional and viscous
energy leave unexplained, so that it is small is the test.
"""

from math import tan

import numpy as np
import pytest
from flatFace import faceEnergy
from scenes import blockOnFloor, contact, density, driven, gravity, joint, loop, period
from yade import O, Quaternion, Vector3, polytope

stiffness = 1e8


def energies():
	names = 'elastPotential', 'plastDissip', 'normDampDissip', 'shearDampDissip', 'fractureDissip', 'nonconservative'
	return dict(dict.fromkeys(names, 0.0), **dict(O.energy.items()))  # the law names its terms at its first contact


class Ledger:
	"""Kinetic energy at the step, and the tracked terms."""

	def __init__(self):
		self.bodies = [b for b in O.bodies if b.dynamic]

	def step(self):
		before = [(Vector3(b.state.vel), Vector3(b.state.angVel)) for b in self.bodies]
		O.step()
		terms = energies()
		terms['kinetic'] = sum(
			b.state.mass * v.dot(b.state.vel) / 2 + sum(b.state.inertia[k] * w[k] * b.state.angVel[k] for k in range(3)) / 2
			for b, (v, w) in zip(self.bodies, before)
		)  # bodies of equal moments, or turning about one axis
		return terms


@pytest.mark.parametrize(
	'perArea,ig2,error',
	[
		(False, {'contactModel': 'boon2012'}, None),
		(True, {'contactModel': 'boon2012'}, None),  # the chord
		(True, {}, 2e-3),
		(False, {}, 2e-3),  # of the contact surface, whose rim is as wide as the overlap is deep
	],
)
def testContactsHaveTheEnergyOfTheirDepthRule(perArea, ig2, error):
	"""For a flat contact all rules give ½ δ²; where the rule is that of the chord, the geometry says -1."""
	joint(normalStiffness=stiffness)
	loop(perArea, ig2=ig2)
	O.trackEnergy = True
	floor, block = blockOnFloor(1e-3)
	O.dt = 1e-9
	O.step()
	geom = contact(floor, block).geom
	energy = geom.penetrationDepth**2 / 2
	assert geom.energyPerStiffness == (-1 if error is None else pytest.approx(energy, rel=error))
	assert energies()['elastPotential'] == pytest.approx(stiffness * energy, rel=error or 1e-9)


def testFlatDampedDropBalances():
	"""A cube falls 10 mm flat on a floor, bounces, comes to rest."""
	joint(normalStiffness=stiffness)
	loop(normalDamping=0.1, gravity=(0, 0, -gravity))
	floor, block = blockOnFloor(-0.01)
	O.trackEnergy = True
	O.dt = 0.01 * period(density, stiffness)
	ledger = Ledger()
	first = ledger.step()
	start = sum(first.values())
	scale = density * gravity * 0.01
	exact, yade, unexplained = 0, 0, 0
	for _ in range(14000):
		terms = ledger.step()
		exact = max(exact, abs(sum(terms.values()) - start) / scale)
		unexplained = max(unexplained, abs(terms['nonconservative']) / scale)
		yade = max(yade, abs(sum(v for k, v in energies().items() if k != 'nonconservative') - start) / scale)
	terms = energies()
	final = abs(sum(v for k, v in terms.items() if k != 'nonconservative') - start) / scale
	print({k: v / scale for k, v in terms.items()})
	print(
		'largest errors over m g h: all terms',
		exact,
		'unexplained',
		unexplained,
		"during the run with YADE's kinetic energy, without nonconservative",
		yade,
		'in the end',
		final,
	)
	assert terms['kinetic'] < 1e-6 * scale  # at rest
	assert terms['normDampDissip'] > 0.9 * scale
	assert exact < 1e-10
	assert unexplained < 1e-3 and final < 1e-3
	assert yade < 1e-2  # half a step's work of the contact force, ½ f v dt


def testSlidingDissipatesFrictionTimesWay():
	"""A flat block pushed at 1 m/s slides to rest: μ N s, and the kinetic energy it had."""
	joint(normalStiffness=stiffness, frictionAngle=0.3)
	loop(normalDamping=1, gravity=(0, 0, -gravity))
	floor, block = blockOnFloor(density * 0.2 * gravity / stiffness, half=(0.5, 0.5, 0.1))
	block.state.blockedDOFs = 'XYZ'
	mass = block.state.mass
	O.dt = 0.05 * period(mass, stiffness)
	O.run(2000, True)
	O.trackEnergy = True
	block.state.vel = (1, 0, 0)
	start = block.state.pos[0]
	ledger = Ledger()
	first = ledger.step()
	while block.state.vel[0] > 1e-2:
		terms = ledger.step()
	way = block.state.pos[0] - start
	friction = tan(0.3) * mass * gravity * way
	print('friction work over μ N s:', terms['plastDissip'] / friction, 'terms over ½ m v²:', {k: v / (mass / 2) for k, v in terms.items()})
	assert terms['plastDissip'] == pytest.approx(friction, rel=1e-3)
	assert sum(terms.values()) == pytest.approx(sum(first.values()), rel=1e-10)
	assert abs(terms['nonconservative']) < 1e-6 * friction


def tumble(perArea, turn):
	"""(nonconservative over the dissipation by dampers and friction) after four blocks have fallen onto each other."""
	O.reset()
	joint(normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.4)
	loop(perArea, normalDamping=0.2, shearDamping=0.2, rockingDamping=0.2, gravity=(0, 0, -gravity))
	O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
	turns = [Quaternion((1, 2, k), 0.4 * k + turn) for k in range(4)]
	O.bodies.append([polytope.cuboid((0.4 * (k % 2) + turn, 0, 1 + 1.6 * k), (0.5, 0.5, 0.5), turns[k]) for k in range(4)])
	O.trackEnergy = True
	O.dt = 0.01 * period(density, 1e7)
	ledger = Ledger()
	start = sum(ledger.step().values())
	for _ in range(6000):
		terms = ledger.step()
	lost = sum(terms[k] for k in ('plastDissip', 'normDampDissip', 'shearDampDissip'))
	print('per area' if perArea else 'per contact', turn, {k: round(v) for k, v in terms.items()})
	assert lost > 1e4
	assert all(terms[k] >= 0 for k in ('plastDissip', 'normDampDissip', 'shearDampDissip', 'elastPotential'))
	assert sum(terms.values()) == pytest.approx(start, abs=1e-3 * lost)
	return terms['nonconservative'] / lost


@pytest.mark.parametrize('perArea', [False, True])
def testTumblingBlocksBalance(perArea):
	"""Edges, vertices, faces, a tenth of a block deep; friction and all dampers. The sum is constant but for the rotation's integration;
	what the contacts create or destroy is in *nonconservative*: at most 1e-4 of the loss, since each damper's work is taken with the force where
	it acted (7e-4 with the last force at the present point and normal, and that falls as the step only)."""
	shares = [tumble(perArea, turn) for turn in (0, 0.01, 0.02, 0.03, 0.05, 0.08)]
	assert np.max(np.abs(shares)) < 2e-4


def testFractureReleasesWhatWasStored():
	joint(normalStiffness=stiffness, tensileStrength=5e4)
	loop()
	floor, block = blockOnFloor(1e-4)
	driven(block)
	O.trackEnergy = True
	O.dt = 1e-4
	O.step()
	# the contact appears compressed: its elastic energy has no source
	assert energies()['nonconservative'] == pytest.approx(-stiffness * faceEnergy(1e-4), rel=1e-9)
	block.state.vel = (0, 0, 1e-2)
	O.step()  # a start out of rest is not leapfrog motion
	made = energies()['nonconservative']
	i = contact(floor, block)
	while i.phys.intact:
		O.step()
	terms = energies()
	stored = 5e4**2 / stiffness / 2
	assert terms['elastPotential'] == 0
	assert terms['fractureDissip'] == pytest.approx(stored, rel=5e-3)  # fails within a step of the strength
	assert terms['nonconservative'] == pytest.approx(made, rel=1e-8)  # the work of a step is that of a straight line


def testDilationLiftsAtTheCostOfShear():
	"""Work of shear = friction + lifting (+ what the damper takes of the lifting): the joint lifts its load by slip × tan ψ."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5, dilationAngle=0.1)
	loop(normalDamping=1, gravity=(0, 0, -gravity))
	floor, block = blockOnFloor(density * gravity / stiffness)
	block.state.blockedDOFs = 'xyXYZ'
	O.dt = 0.05 * period(density, stiffness)
	O.run(500, True)
	block.state.vel = (0.01, 0, block.state.vel[2])
	O.trackEnergy = True
	weight = density * gravity
	pushed = 0.0
	O.run(3000, True)
	while O.iter < 12000:
		O.step()
		pushed = pushed + O.forces.f(floor.id)[0] * 0.01 * O.dt  # wider numbers are changed in place by +=
		if O.iter == 3501:
			begun, begin, low = dict(energies()), pushed, block.state.pos[2]
	terms = energies()
	friction, viscous = (terms[k] - begun[k] for k in ('plastDissip', 'normDampDissip'))
	lift = block.state.pos[2] - low
	slip = 0.01 * O.dt * (O.iter - 3501)
	work = pushed - begin
	print('lift over slip tan ψ:', lift / (slip * tan(0.1)), 'friction + lifting over work:', (friction + viscous + weight * lift) / work)
	assert lift == pytest.approx(slip * tan(0.1), rel=1e-3)
	assert friction + viscous + weight * lift == pytest.approx(work, rel=1e-3)


def testTrackingDoesNotChangeTheMotion():
	ends = []
	for track in (False, True):
		O.reset()
		joint(normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.4)
		loop(True, normalDamping=0.2, shearDamping=0.2, rockingDamping=0.2, gravity=(0, 0, -gravity))
		O.bodies.append(
			[polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True), polytope.cuboid((0, 0, 0.8), (0.5, 0.4, 0.3), Quaternion((1, 2, 3), 0.5))]
		)
		O.trackEnergy = track
		O.dt = 1e-3
		O.run(2000, True)
		ends.append((tuple(O.bodies[1].state.pos), tuple(O.bodies[1].state.vel), tuple(O.bodies[1].state.ori)))
	# the energy's pieces of the surface are summed in another order
	for one, other in zip(*ends, strict=True):
		assert one == pytest.approx(other, rel=1e-9, abs=1e-9)
