# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact models *foundation* and *spring*: force, energy and what they leave out, in scenes."""

import itertools
import math
import random

import pytest
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	FrictMat,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	MatchMaker,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
)

models = {'foundation': (True, 1e9), 'spring': (False, 1e8)}
"""Whether its stiffness is per area, and one."""


def engines(model, damping=0.0, gravity=(0, 0, -9.81), **settings):
	perArea, _ = models[model]
	return [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.01),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model, **settings)],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0)],
		),
		NewtonIntegrator(damping=damping, gravity=gravity),
	]


def joint(model, frictionAngle=0.0):
	stiffness = models[model][1]
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=frictionAngle))


def tiltedBlock():
	O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	turn = Quaternion((0.6, 0.8, 0), 0.02)
	return O.bodies.append(polytope.cuboid(center=(0.3, 0, 0.505), extents=(0.5, 0.4, 0.5), orientation=turn))


def oneStep(contactModel, perArea=None):
	"""Geometry of the first step's contact; stiffness per area or per contact of rock joints, or FrictMat's."""
	O.reset()
	if perArea is None:
		O.materials.append(FrictMat(density=2600, young=1e8, poisson=1, frictionAngle=0.5))
		physics, law = Ip2_FrictMat_FrictMat_FrictPhys(), Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)
	else:
		joint('foundation' if perArea else 'spring')
		physics = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)
		law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()
	block = tiltedBlock()
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()]),
		InteractionLoop([Ig2_Polytope_Polytope_PolytopeGeom(contactModel=contactModel, computeArea=True)], [physics], [law]),
	]
	O.dt = 1e-9
	O.step()
	return O.interactions[0, block].geom


@pytest.mark.parametrize('perArea, model', [(True, 'foundation'), (False, 'spring'), (None, 'spring')])
def testSurfaceGoesByTheUnitOfTheStiffness(perArea, model):
	geom, named = oneStep('surface', perArea), oneStep(model, perArea)
	other = oneStep('spring' if model == 'foundation' else 'foundation', perArea)
	assert (geom.penetrationDepth, geom.contactPoint, geom.normal) == (named.penetrationDepth, named.contactPoint, named.normal)
	assert abs(geom.penetrationDepth / other.penetrationDepth - 1) > 0.05
	# and so does the contact of two bodies without a step
	alone = polytope.contact(O.bodies[0], O.bodies[1], contactModel='surface')
	assert alone.depth == pytest.approx(geom.penetrationDepth, rel=1e-9)
	assert (alone.point - geom.contactPoint).norm() < 1e-9 and alone.area == pytest.approx(geom.contactArea, rel=1e-9)


@pytest.mark.parametrize('model', models)
def testABlockRestsOnAFaceWithItsWeight(model):
	joint(model)
	floor = O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid(center=(0.3, 0, 0.5), extents=(0.5, 0.4, 0.5)))
	O.engines = engines(model, damping=0.7, computeEnergy=True)
	O.dt = 1e-4
	O.run(4000, wait=True)
	contact, weight = O.interactions[floor, block], 9.81 * O.bodies[block].state.mass
	assert contact.geom.status == 'contact'
	assert (contact.geom.normal - Vector3(0, 0, 1)).norm() < 1e-9
	assert contact.phys.normalForce.norm() == pytest.approx(weight, rel=1e-4)
	perArea, stiffness = models[model]
	depth = weight / (stiffness * (0.8 if perArea else 1))
	assert contact.geom.penetrationDepth == pytest.approx(depth, rel=1e-3)
	assert contact.geom.energyPerStiffness == pytest.approx(depth**2 / 2, rel=2e-3)
	assert abs(contact.geom.turningArm) < 1e-9
	assert contact.geom.contactArea == pytest.approx(0.8, rel=1e-3)


@pytest.mark.parametrize('model', models)
@pytest.mark.parametrize('faces', [4, 8, 12])
def testASolidThatBouncesOnAFloorKeepsItsEnergy(model, faces):
	"""On one face there is no moment about the normal to leave out. Kinetic energy is taken between two steps, as the positions are half a
	step on."""
	joint(model)
	O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	solid = O.bodies.append(
		polytope.regular(faces, circumradius=0.3, center=(0, 0, 0.35), orientation=Quaternion(Vector3(1, 2, 3).normalized(), 0.7))
	)
	O.engines = engines(model)
	O.dt = 2e-5
	start = polytope.mechanicalEnergy()
	touched, errors = 0, []
	for _ in range(40):
		O.run(500, wait=True)
		touched += len([contact for contact in O.interactions if contact.isReal])
		errors.append(abs(polytope.mechanicalEnergy() / start - 1))
	assert touched > 0
	assert max(errors) < 2e-4, max(errors)
	assert O.bodies[solid].state.vel.norm() > 0


def testSpringWorksWithYadesOwnLaw():
	O.materials.append(FrictMat(density=2600, young=1e9, poisson=0.3, frictionAngle=0))
	O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.regular(6, circumradius=0.3, center=(0, 0, 0.35), orientation=Quaternion(Vector3(1, 2, 3).normalized(), 0.7)))
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.01),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(contactModel='spring')],
			[Ip2_FrictMat_FrictMat_FrictPhys()],
			[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
		),
		NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
	]
	O.dt = 1e-5
	start = polytope.mechanicalEnergy()
	errors = []
	for _ in range(40):
		O.run(1000, wait=True)
		errors.append(abs(polytope.mechanicalEnergy() / start - 1))
	assert max(errors) < 5e-4, max(errors)


@pytest.mark.parametrize('model', models)
def testCheckNamesTheOtherUnit(model):
	joint(model)
	other = next(name for name in models if name != model)
	O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	O.engines = engines(model)
	O.engines[2].geomDispatcher.functors[0].contactModel = other
	found = [entry for entry in polytope.check(O) if 'no gradient of an energy' in str(entry)]
	assert len(found) == 1 and f"contactModel {other!r}" in found[0].seen and "contactModel='surface'" in found[0].advice, found
	for right in (model, 'surface'):
		O.engines[2].geomDispatcher.functors[0].contactModel = right
		assert not [entry for entry in polytope.check(O) if 'no gradient of an energy' in str(entry)]


def testUnknownModelIsRefusedByNameOfTheOthers():
	with pytest.raises(ValueError, match="contactModel: must be 'surface', 'foundation', 'spring' or 'boon2012'"):
		Ig2_Polytope_Polytope_PolytopeGeom(contactModel='winkler')


def testTwoBodiesAloneHaveTheSameContact():
	joint('foundation')
	lower = polytope.cuboid(center=(0, 0, 0), extents=(1, 1, 1))
	upper = polytope.cuboid(center=(0.2, 0.1, 1.99), extents=(1, 1, 1), orientation=Quaternion((0, 0, 1), 0.3))
	contact = polytope.contact(lower, upper, contactModel='foundation')
	assert contact.inContact and contact.status == 'contact'
	assert contact.depth == pytest.approx(0.01, rel=0.02)
	assert math.isclose(contact.energyPerStiffness, contact.depth**2 / 2, rel_tol=0.02)
	assert abs(contact.turningArm) < 1e-3


def gas(model, seed=1, side=3):
	"""Solids of all kinds that fly about in a box, without friction, damping and gravity."""
	random.seed(seed)
	joint(model)
	fill(side)


def fill(side):
	"""The box, and side³ solids at random."""
	O.bodies.append(polytope.plates((0, 0, 0), (0.3 * side,) * 3))
	for i, j, k in itertools.product(range(side), repeat=3):
		turn = Quaternion(Vector3(*(random.gauss(0, 1) for _ in range(3))), random.uniform(0, 3))
		velocity = [random.gauss(0, 0.5) for _ in range(3)]
		at = (0.15 + 0.3 * i, 0.15 + 0.3 * j, 0.15 + 0.3 * k)
		faces = random.choice((4, 6, 8, 12, 20))
		O.bodies.append(polytope.regular(faces, circumradius=0.12, center=at, orientation=turn, velocity=velocity))


@pytest.mark.parametrize('model,error', [('foundation', 1e-5), ('spring', 1e-3)])
def testAGasKeepsItsEnergy(model, error):
	"""A thousandth is what energy may be off by."""
	gas(model)
	O.engines = engines(model, gravity=(0, 0, 0))
	perArea, stiffness = models[model]
	mass = min(body.state.mass for body in O.bodies if body.dynamic)
	O.dt = 0.06 * math.sqrt(mass / (stiffness * (0.12**2 if perArea else 1)))
	before = polytope.mechanicalEnergy()
	O.run(int(1 / O.dt), wait=True)
	geometry = O.engines[2].geomDispatcher.functors[0]
	counts = geometry.stats()
	assert counts['contacts'] > 1000 and counts['failures'] == 0
	assert counts['surfacesKept'] > 0.8 * counts['contacts']
	assert polytope.mechanicalEnergy() == pytest.approx(before, rel=error)
	assert not geometry.computeEnergy


def gasOf(model, side, seed):
	"""A gas with default engines, that of *spring* with FrictMat and YADE's own law, too; neither friction nor damping."""
	random.seed(seed)
	if model == 'yadesOwn':
		O.materials.append(FrictMat(density=2600, young=1e7, poisson=0.3, frictionAngle=0))
		given = {name: MatchMaker(algo='val', val=1e7) for name in ('kn', 'ks')}
		physics, law = Ip2_FrictMat_FrictMat_FrictPhys(**given), Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)
	else:
		stiffness = {'foundation': 1e9, 'spring': 1e7}[model]
		perArea = model == 'foundation'
		O.materials.append(
			RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0, stiffnessPerArea=perArea)
		)
		physics, law = Ip2_RockJointMat_RockJointMat_RockJointPhys(), Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0)
	fill(side)
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, physics=physics, law=law)


def errorsOfEnergy(seconds):
	"""Energy over that at the start less one, two hundred times."""
	start, errors = polytope.mechanicalEnergy(), []
	for part in range(1, 201):
		while O.time < seconds * part / 200:
			O.step()
		errors.append(polytope.mechanicalEnergy() / start - 1)
	assert O.engines[2].geomDispatcher.functors[0].stats()['failures'] == 0
	return errors


@pytest.mark.parametrize('seed', [1, 2])
@pytest.mark.parametrize('model, most', [('foundation', 5e-5), ('spring', 6e-4), ('yadesOwn', 1e-3)])
def testAGasOf64KeepsItsEnergyAtTheDefaultStep(model, most, seed):
	"""The root mean square over the time. The largest error is a matter of chance, for rounding alone makes another gas of it after some hundred
	collisions: twice as much is allowed for it."""
	gasOf(model, 4, seed)
	errors = errorsOfEnergy(4)
	mean, largest = math.sqrt(sum(error**2 for error in errors) / len(errors)), max(map(abs, errors))
	print(f'{model}, seed {seed}: root mean square {mean:.2g}, largest {largest:.2g}')
	assert mean < most and largest < 2 * most


@pytest.mark.parametrize('model, step', [('foundation', 9e-5), ('spring', 5e-5)])
def testTheErrorOfAGasFallsWithTheSquareOfTheTimeStep(model, step):
	"""Over four gases of 27, of a quarter of the step a sixteenth; of one gas it is four to forty times less, by chance. The step is constant: one that changes within a contact is an error of
	first order of YADE's leapfrog, and PolytopeTimeStepper changes it when solids lie on each other with a face."""
	squares = []
	for part in (1, 4):
		total = 0
		for seed in (1, 2, 3, 4):
			O.reset()
			gasOf(model, 3, seed)
			O.engines = O.engines[:-1]
			O.dt = step / part
			total += sum(error**2 for error in errorsOfEnergy(4))
		squares.append(total)
	assert math.sqrt(squares[0] / squares[1]) > 10


@pytest.mark.parametrize('dimension', [2, 3])
def testABlockAtRestOnAFloorKeepsItsKineticEnergyForAMillionSteps(dimension):
	"""With FrictMat and YADE's own law, without damping: it sits at the depth of its weight, tilted by a tenth of that over its half width,
	rocks and bobs for ever."""
	stiffness, half = 1e7, 0.5
	O.materials.append(FrictMat(density=2500, young=1, poisson=0.5, frictionAngle=math.radians(35)))
	depth = 2500 * (2 * half) ** 3 * 10 / stiffness
	tilt = 0.1 * depth / half
	if dimension == 2:
		O.bodies.append(polytope.polygon([(-2, -1), (2, -1), (2, 0), (-2, 0)], fixed=True))
		c, s = half * math.cos(tilt), half * math.sin(tilt)
		corners = [(c - s, c + s), (-c - s, c - s), (-c + s, -c - s), (c + s, s - c)]
		O.bodies.append(polytope.polygon([(x, half - depth + y) for x, y in corners]))
	else:
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, half - depth), (half, half, half), Quaternion((0, 1, 0), tilt)))
	given = {name: MatchMaker(algo='val', val=value) for name, value in (('kn', stiffness), ('ks', stiffness / 2))}
	O.engines = polytope.engines(
		gravity=(0, -10, 0) if dimension == 2 else (0, 0, -10),
		physics=Ip2_FrictMat_FrictMat_FrictPhys(**given),
		law=Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False),
		damping=0,
	)
	state = O.bodies[1].state
	inertia = state.inertia[2 if dimension == 2 else 1]
	peaks = []
	for _ in range(10):
		peak = 0
		for _ in range(100000):
			O.step()
			peak = max(peak, (state.mass * state.vel.squaredNorm() + inertia * state.angVel.squaredNorm()) / 2)
		peaks.append(peak)
	assert O.iter == 1000000 and peaks[0] > 0.1
	assert peaks == pytest.approx([peaks[0]] * 10, rel=1e-3)


def testEnergyIsThereWhereItIsAskedFor():
	joint('foundation')
	floor = O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid(center=(0, 0, 0.4999), extents=(0.5, 0.5, 0.5)))
	O.engines = engines('foundation', gravity=(0, 0, 0))
	O.dt = 1e-9
	O.step()
	geom = O.interactions[floor, block].geom
	assert geom.energyPerStiffness == -1
	O.trackEnergy = True
	O.step()
	assert geom.energyPerStiffness == pytest.approx(geom.penetrationDepth**2 / 2, rel=1e-3)
	assert O.energy['elastPotential'] == pytest.approx(1e9 * geom.contactArea * geom.energyPerStiffness, rel=1e-9)


@pytest.mark.parametrize('taper', [1e-3, 1e-9])
def testACoupleIsNoForceFarAway(taper):
	"""A needle through a plate: pressures on its sides cancel, and what is left of the force has a line of action that is anywhere."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
	plate = O.bodies.append(polytope.cuboid((0, 0, 0), (0.3, 0.4, 0.05), fixed=True))
	ends = [(-0.6, 0.02), (0.6, 0.02 * (1 + taper))]
	needle = polytope.fromVertices([(x * r, y * r, z) for z, r in ends for x in (-1, 1) for y in (-1, 1)])
	needle.state.ori = Quaternion((1, 0, 0), 0.2) * needle.state.ori
	needle.state.angVel = (0.5, 0, 0)
	needle = O.bodies.append(needle)
	O.engines = polytope.engines(gravity=(0, 0, 0), geometry=Ig2_Polytope_Polytope_PolytopeGeom(contactModel='foundation'))
	O.run(50, wait=True)
	geom = O.interactions[plate, needle].geom
	assert geom.status == 'noDirection'
	assert geom.contactPoint.norm() < 0.1 and O.dt > 1e-6
	assert O.bodies[needle].state.angVel.norm() <= 0.5 + 1e-6
