# SPDX-License-Identifier: GPL-2.0-or-later
"""Rock bolts in scenes with a closed form: hanging blocks, a block on a slope, a roof wedge; energy, time step, saved states, checks."""

from math import atan, cos, inf, radians, sin, sqrt, tan, tanh

import numpy as np
import pytest
from scenes import joint
from yade import GlobalStiffnessTimeStepper, NewtonIntegrator, O, PolytopeTimeStepper, Vector3, polytope
from yade.polytope import Dowel, Grout
from yade.polytope.strengthReduction import StrengthReduction

g = 9.81
E, area = 2e11, 5e-4
EA = E * area
bar = dict(area=area, youngsModulus=E)


# ------------------------------------------------------------------------------------------------ hanging blocks


def roofAndSlab(gap=0.05, half=(1.0, 0.8, 0.5)):
	"""A slab below a fixed roof, apart from it."""
	joint(density=2500.0)
	O.bodies.append(polytope.cuboid((0, 0, 1), (3, 3, 1), fixed=True))
	slab = O.bodies[O.bodies.append(polytope.cuboid((0, 0, -half[2] - gap), half))]
	O.engines = polytope.engines(damping=0.5)
	return slab


def testThreeBoltsShareTheWeightByTheirPlaces():
	slab = roofAndSlab()
	weight = float(slab.state.mass) * g
	places = np.array([(-0.8, -0.5), (0.7, -0.6), (0.1, 0.6)])
	bolts = [polytope.bolt((x, y, -1.05), (x, y, 1.5), **bar) for x, y in places]
	polytope.settle()
	shares = np.linalg.solve([[1, 1, 1], *places.T], [1, 0, 0])
	assert [float(bolt.headForce) for bolt in bolts] == pytest.approx(shares * weight, rel=5e-4)
	arrays = polytope.boltArrays()
	assert arrays.forces == pytest.approx(shares * weight, rel=5e-4) and arrays.bolts.tolist() == [0, 1, 2]
	assert arrays.crossingIds.tolist() == [[1, 0]] * 3 and arrays.tensions == pytest.approx(arrays.forces)
	assert arrays.strains == pytest.approx(arrays.forces / EA, rel=1e-9) and arrays.distances[0] == pytest.approx([0, 2.55])


def testASlabOnGroutedBoltsSinksAsShearLagSays():
	slab = roofAndSlab()
	start, grout, free = float(slab.state.pos[2]), 5e8, 0.1
	weight = float(slab.state.mass) * g
	for x, y in ((-0.8, -0.6), (0.8, -0.6), (-0.8, 0.6), (0.8, 0.6)):
		polytope.bolt((x, y, -1.05), (x, y, 1.5), **bar, grout=Grout(grout, 2e5), plate=False, freeLength=free)
	polytope.settle()
	rate = sqrt(grout / EA)
	mouths = [sqrt(EA * grout) * tanh(rate * length) for length in (1 - free / 2, 1.5 - free / 2)]
	assert start - float(slab.state.pos[2]) == pytest.approx(weight / 4 * ((free + 0.05) / EA + 1 / mouths[0] + 1 / mouths[1]), rel=1e-3)


@pytest.mark.parametrize('strength,holds', [(1.02, True), (0.98, False)])
def testASlabFallsWhereTheGroutIsTooWeak(strength, holds):
	slab = roofAndSlab()
	weight, bonded = float(slab.state.mass) * g, 1 - 0.05
	bolt = polytope.bolt((0, 0, -1.05), (0, 0, 1.5), **bar, grout=Grout(1e9, strength * weight / bonded), plate=False, freeLength=0.1)
	polytope.settle()
	O.run(3000, wait=True)
	start = float(slab.state.pos[2])
	O.run(1000, wait=True)
	assert (start - float(slab.state.pos[2]) < 1e-6) == holds
	if holds:
		assert bolt.largestForce == pytest.approx(weight, rel=1e-4)


# ------------------------------------------------------------------------------------------------ factors of safety


def rectangle(x, y):
	return [(-x, -y), (x, -y), (x, y), (-x, y)]


def boltedBlock(flat, pull, bolt):
	"""A block of 1 m² on a slope of 40°, gravity turned; polyhedra, or polygons. Returns its id, and its factor of safety in theory."""
	dip, friction, lean = radians(40), radians(35), radians(35)
	joint(density=5000.0, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=friction)
	if flat:
		O.bodies.append(polytope.polygon(rectangle(3, 1), center=(0, -1, 0), fixed=True))
		block = O.bodies.append(polytope.polygon(rectangle(0.5, 0.1), center=(0, 0.1, 0)))
		down, into = Vector3(1, 0, 0), Vector3(0, -1, 0)
	else:
		O.bodies.append(polytope.cuboid((0, 0, -1), (3, 1, 1), fixed=True))
		block = O.bodies.append(polytope.cuboid((0, 0, 0.1), (0.5, 0.5, 0.1)))
		down, into = Vector3(1, 0, 0), Vector3(0, 0, -1)
	O.engines = polytope.engines(gravity=g * (sin(dip) * down + cos(dip) * into), damping=0.4)
	axis = sin(lean) * into - cos(lean) * down
	middle = -0.1 * into  # of the block
	polytope.bolt(middle - 0.1 * axis / sin(lean), middle + 1.5 * axis, **bar, **bolt)
	weight = float(O.bodies[block].state.mass) * g
	return block, (weight * cos(dip) + pull * sin(lean)) * tan(friction) / (weight * sin(dip) - pull * cos(lean))


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('bolt', [dict(pretension=2e3, yieldForce=2e3), dict(yieldForce=2e3), dict(grout=Grout(1e9, 1e6), yieldForce=2e3)])
def testABoltedBlockOnASlope(flat, bolt):
	"""(W cos α + T sin β) tan φ / (W sin α − T cos β): pulled from the start, or by its own sliding until the steel yields."""
	block, factor = boltedBlock(flat, 2e3, bolt)
	polytope.settle(elastic=False)
	found = StrengthReduction([block], steps=(0.1, 0.01)).run()
	assert factor == pytest.approx(1.2995, abs=1e-4)  # 0.834 without a bolt
	assert found.factor == pytest.approx(factor, rel=0.01)


def testABoltedRoofWedge():
	"""The wedge lies between joints at i to the vertical that a horizontal force H presses: it falls at φ = i + arctan((W − T)/2H)."""
	lean, horizontal, pull = radians(20), 8e3, 5e3
	joint(density=2500.0, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(50))
	width = tan(lean)
	wedge = O.bodies.append(
		polytope.fromVertices(
			[(x, y, z) for y in (-0.5, 0.5) for x, z in ((-width, 0), (width, 0), (-0.2 * width, 0.8), (0.2 * width, 0.8))]
		)
	)
	for side in (-1, 1):
		corners = [(width, 0), (0.2 * width, 0.8), (width + 1, 0), (width + 1, 0.8)]
		abutment = O.bodies[O.bodies.append(polytope.fromVertices([(side * x, y, z) for y in (-0.5, 0.5) for x, z in corners]))]
		abutment.state.blockedDOFs = 'yzXYZ'
		O.forces.setPermF(abutment.id, (-side * horizontal, 0, 0))
	O.bodies.append(polytope.cuboid((0, 0, 2.0), (2, 0.5, 0.5), fixed=True))
	O.engines = polytope.engines(damping=0.4)
	polytope.bolt((0, 0, 0), (0, 0, 2.2), **bar, pretension=pull, yieldForce=pull)
	weight = float(O.bodies[wedge].state.mass) * g
	found = StrengthReduction([wedge], steps=(0.1, 0.01)).run()
	factors = [tan(radians(50)) / tan(lean + atan((weight - pulled) / (2 * horizontal))) for pulled in (0, pull)]
	assert factors == pytest.approx([1.066, 1.864], abs=2e-3)
	assert found.factor == pytest.approx(factors[1], rel=0.01)


# ------------------------------------------------------------------------------------------------ energy, momentum, time step


def freeBlocks(bolt):
	"""Three blocks in a row that drift and turn, far enough apart not to touch."""
	joint(density=2500.0)
	for k in range(3):
		spin = Vector3(0.2, -0.3 + 0.3 * k, 0.1 * k)
		O.bodies.append(polytope.cuboid((2.5 * k, 0, 0), (0.5, 0.4, 0.3), velocity=(0.3 * k, 0.2 - 0.3 * k, 0.1), angularVelocity=spin))
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0, timeStepper=False)
	O.dt = 5e-5
	O.trackEnergy = True
	return polytope.bolt((-0.4, 0, 0), (5.4, 0.1, 0.05), **bar, **bolt)


def momentum(state):
	return state.mass * state.vel


def spin(state):
	turning = state.ori.conjugate() * state.angVel
	return state.pos.cross(momentum(state)) + state.ori * Vector3(*(turning[k] * state.inertia[k] for k in range(3)))


def total(of):
	return sum((of(body.state) for body in O.bodies), Vector3.Zero)


@pytest.mark.parametrize('bolt', [dict(pretension=5e3), dict(grout=Grout(1e8, inf), dowel=Dowel(1e7, inf))])
def testElasticBoltsKeepEnergyAndMomentum(bolt):
	freeBlocks(bolt)
	before, turning, energy = total(momentum), total(spin), float(polytope.mechanicalEnergy())
	energies = []
	for _ in range(20):
		O.run(100, wait=True)
		energies.append(float(polytope.mechanicalEnergy()))
	assert (total(momentum) - before).norm() < 1e-12 * energy
	assert energies == pytest.approx([energy] * 20, rel=1e-4)
	assert (total(spin) - turning).norm() < 1e-3 * turning.norm()
	assert O.energy['plastDissip'] == 0


@pytest.mark.parametrize(
	'bolt',
	[
		dict(yieldForce=3e4),
		dict(grout=Grout(1e8, 4e4), dowel=Dowel(1e7, 5e3)),
		dict(yieldForce=5e3, ruptureStrain=0.001, grout=Grout(1e9, 1e6), dowel=Dowel(1e7, 5e3)),
	],
)
def testWhatYieldSlipAndRuptureTakeIsAccountedFor(bolt):
	made = freeBlocks(bolt)
	energy = float(polytope.mechanicalEnergy())
	O.run(3000, wait=True)
	lost = O.energy['plastDissip'] + (O.energy['fractureDissip'] if 'ruptureStrain' in bolt else 0)
	assert lost > 0.05 * energy
	assert float(polytope.mechanicalEnergy()) + lost == pytest.approx(energy, rel=2e-3)
	assert ('rupture' in [one.failure for one in made.crossings]) == ('ruptureStrain' in bolt)
	assert polytope.bolts().unsolved == 0


def testTheTimeStepKnowsBolts():
	joint(density=2500.0)
	for k in range(2):
		O.bodies.append(polytope.cuboid((2.2 * k, 0, 0), (1, 1, 1)))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	before = O.dt
	bolt = polytope.bolt((-1, 0, 0), (3.2, 0, 0), area=1.0, youngsModulus=2e11, grout=Grout(1e11, inf), plate=False)
	O.step()
	stepper = O.engines[-1]
	assert isinstance(stepper, PolytopeTimeStepper) and O.dt < before and stepper.limitedBy == 'contacts'
	assert O.dt == pytest.approx(0.4 * sqrt(O.bodies[0].state.mass / bolt.crossings[0].stiffness), rel=1e-6)
	O.bodies[1].state.vel = (1, 0, 0)
	O.run(2000, wait=True)
	assert abs(bolt.crossings[0].opening) < 1e-2  # stable: half of the mass at 1 m/s on 9e10 N/m


# ------------------------------------------------------------------------------------------------ saved states, checks


def testARunGoesOnFromASavedStateBitForBit(tmp_path):
	freeBlocks(dict(grout=Grout(1e8, 4e4), dowel=Dowel(1e7, 5e3), pretension=2e4, ruptureStrain=0.01))
	O.run(700, wait=True)
	O.save(str(tmp_path / 'scene.yade.gz'))
	reached = []
	for again in (False, True):
		if again:
			O.load(str(tmp_path / 'scene.yade.gz'))
		O.run(700, wait=True)
		(bolt,) = polytope.bolts().bolts
		states = [tuple(x) for body in O.bodies for x in (body.state.pos, body.state.vel, body.state.angVel)]
		reached.append((states, list(bolt.elementForces), list(bolt.slips), bolt.energy, [one.failure for one in bolt.crossings]))
	assert reached[0] == reached[1] and max(reached[0][1]) > 1e3


def testOtherEnginesKeepTheBolts():
	roofAndSlab()
	bolt = polytope.bolt((0, 0, -1.05), (0, 0, 1.5), **bar)
	bolts = polytope.bolts()
	O.engines = [engine for engine in O.engines if engine is not bolts]
	assert any(finding.what == 'bolts' and 'they hold nothing now' in finding.seen for finding in polytope.check(O))
	O.engines = polytope.engines()
	assert len(polytope.bolts().bolts) == 1 and bolt.area == area
	assert not any(finding.what == 'bolts' for finding in polytope.check(O))
	kind = [type(engine) for engine in O.engines]
	assert kind.index(type(bolts)) + 1 == kind.index(NewtonIntegrator)
	O.engines = [*O.engines[:-3], O.engines[-2], O.engines[-3], GlobalStiffnessTimeStepper(defaultDt=1e-5)]
	found = [(finding.what, finding.seen) for finding in polytope.check(O)]
	assert any(what == 'bolts' and 'erased before they act' in seen for what, seen in found)
	assert any(what == 'time step' and 'does not know bolts' in seen for what, seen in found)


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('ruptureStrain', [inf, 2.1e-5])
def testABoltWithoutPretensionIsLoadedGentlyByTheFactorOfSafety(flat, ruptureStrain):
	"""The yield strain is 2e-5: a bolt that was loaded at once would swing beyond it and break at 1.23."""
	block, factor = boltedBlock(flat, 2e3, dict(yieldForce=2e3, ruptureStrain=ruptureStrain))
	polytope.settle(elastic=False)
	found = polytope.factorOfSafety()
	assert found.factor == pytest.approx(factor, rel=0.01) and found.failed / found.stable < 1.01
	assert found.bodies == [block] and all(
		later.factor / earlier.factor <= 1.021 for earlier, later in zip(found.trials, found.trials[1:], strict=False)
	)
