# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints with a closure and a shear law of their own: direct shear and normal loading of a block against closed forms, and against
their rate equations integrated here.

The block is 1 m × 1 m × 0.5 m (2-D: 1 m × 0.5 m), its lower face slides on a larger one. Default settings: contactModel='surface',
stiffness per area.
"""

import math

import numpy as np
import pytest
from scenes import joint
from yade import (
	BartonBandisStrength,
	ContinuouslyYieldingStrength,
	HyperbolicClosure,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	O,
	PowerClosure,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
)
from yade.polytope.frictionReduction import setFrictionAngle
from yade.polytope.strengthReduction import StrengthReduction

half, stiff = 0.25, 1e10
dimensions = pytest.mark.parametrize('flat', [False, True], ids=['3D', '2D'])


def block(flat, overlap, **material):
	"""The block on its floor, pressed in by *overlap*; up is z, in 2-D y. Returns (block, up)."""
	joint(**dict(dict(normalStiffness=stiff, shearStiffness=stiff), **material))
	height = half - overlap
	if flat:
		corners = np.array([(-0.5, -half), (0.5, -half), (0.5, half), (-0.5, half)])
		O.bodies.append(polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True))
		O.bodies.append(polytope.polygon(corners + (0, height)))
	else:
		O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, height), (0.5, 0.5, half)))
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.4)
	return O.bodies[1], 1 if flat else 2


def shear(flat, speed, way, stress, stiffness=0.0, overlap=0.0, **material):
	"""Direct shear under a constant normal stress, or one that grows with the rise by *stiffness* [Pa/m].

	:returns: arrays of displacement along the joint, shear stress, normal stress, rise of the block
	"""
	body, up = block(flat, overlap, **material)
	body.state.blockedDOFs = 'xzXYZ' if flat else 'xyXYZ'
	start, rows = float(body.state.pos[up]), []
	load = Vector3(0, 0, 0)

	def press():
		load[up] = -(stress + stiffness * (float(body.state.pos[up]) - start))
		O.forces.setPermF(1, load)

	def steps(number):
		for _ in range(number):
			press()
			O.step()

	steps(400)
	start = float(body.state.pos[up])
	begin = float(body.state.pos[0])
	body.state.vel = Vector3(speed, 0, 0)
	while float(body.state.pos[0]) - begin < way:
		steps(5)
		contact = O.interactions[0, 1]
		phys, area = contact.phys, contact.phys.contactArea
		rows.append(
			(
				float(body.state.pos[0]) - begin,
				phys.shearForce.norm() / area,
				phys.normalForce.norm() / area,
				float(body.state.pos[up]) - start,
			)
		)
	return np.array(rows).T


# ------------------------------------------------------------------------------------------------ Barton-Bandis

roughness, wall, residual = 10.0, 100e6, math.radians(30)
rough = dict(strength=BartonBandisStrength(JRC=roughness, JCS=wall), frictionAngle=residual)
peak = 0.1 / 500 * (roughness / 0.1) ** 0.33
mobilised = [0, 0.3, 0.6, 1, 2, 4, 10, 25, 100], [0, 0, 0.75, 1, 0.85, 0.7, 0.5, 0.4, 0]


def barton(displacement, stress):
	"""Mobilised friction and dilation angle [rad]."""
	part = np.interp(displacement / peak, *mobilised)
	logarithm = math.log10(wall / stress)
	damage = min(2, max(1, roughness / (12 * logarithm) + 0.7))
	return residual + math.radians(roughness * part * logarithm), math.radians(roughness * part * logarithm) / damage


@dimensions
def testBartonBandisUnderConstantStress(flat):
	way, tau, sigma, rise = shear(flat, 0.01, 3 * peak, 1e6, **rough)
	late = way > 0.3 * peak
	angles = np.degrees(np.arctan2(tau, sigma))
	wanted = [math.degrees(barton(x, 1e6)[0]) for x in way]
	assert np.abs(angles - wanted)[late].max() < 0.1
	assert angles.max() == pytest.approx(30 + 10 * 2, abs=0.1)
	assert way[angles.argmax()] == pytest.approx(peak, rel=0.05)
	# dilation is of the slip, the displacement less that of the shear springs
	slip = np.maximum(0, way - tau / stiff)
	dilated = np.concatenate([[0], np.cumsum(np.tan([barton(x, 1e6)[1] for x in (way[1:] + way[:-1]) / 2]) * np.diff(slip))])
	assert rise[-1] == pytest.approx(dilated[-1], rel=0.01)
	assert np.abs(rise - dilated).max() < 0.02 * dilated[-1]


@dimensions
def testBartonBandisUnderConstantStiffness(flat):
	spring = 5e8
	way, tau, sigma, rise = shear(flat, 0.01, 2 * peak, 1e6, spring, **rough)
	dilation, last, stress = 0.0, 0.0, 1e6
	wanted = []
	for x in np.linspace(0, way[-1], 4001):
		friction, dip = barton(x, stress)
		slip = max(last, x - stress * math.tan(friction) / stiff) if x > 0.3 * peak else last
		dilation, last = dilation + math.tan(dip) * (slip - last), slip
		stress = 1e6 + spring * dilation / (1 + spring / stiff)
		wanted.append((x, stress * math.tan(friction), stress))
	wanted = np.array(wanted).T
	late = way > 0.35 * peak
	for found, column in ((tau, 1), (sigma, 2)):
		assert found[late] == pytest.approx(np.interp(way, wanted[0], wanted[column])[late], rel=0.02)
	assert sigma[-1] > 1.1e6


def testResidualAngle():
	"""A hundred times the peak displacement."""
	short = BartonBandisStrength(JRC=10, JCS=100e6, sampleLength=0.01, jointLength=0.01)
	_, tau, sigma, _ = shear(False, 0.1, 100 * 0.01 / 500 * 1000**0.33, 1e6, strength=short, frictionAngle=residual)
	assert math.degrees(math.atan2(tau[-1], sigma[-1])) == pytest.approx(30, abs=0.1)


def testLongJointsAreWeaker():
	strength = BartonBandisStrength(JRC=10, JCS=100e6, jointLength=1)
	scaled = 10 * 10**-0.2, 100e6 * 10**-0.3
	later = 1 / 500 * scaled[0] ** 0.33
	way, tau, sigma, _ = shear(False, 0.02, 1.2 * later, 1e6, strength=strength, frictionAngle=residual)
	angles = np.degrees(np.arctan2(tau, sigma))
	assert angles.max() == pytest.approx(30 + scaled[0] * math.log10(scaled[1] / 1e6), abs=0.1)
	assert way[angles.argmax()] == pytest.approx(later, rel=0.05)


# ------------------------------------------------------------------------------------------------ continuously yielding

fresh, intrinsic, wear = math.radians(50), math.radians(30), 1e-3


def yielding(ways, stress, stiffness):
	"""Rate equations of the continuously-yielding joint along these displacements, by small steps: stress, plastic displacement, rise."""
	angle, tau, ratio, rise, last = fresh, 0.0, 0.0, 0.0, 0
	found = []
	for change in np.diff(ways):
		sense = math.copysign(1, change)
		strength = stress * math.tan(angle)
		if last and sense != last:
			ratio = min(0.75, sense * tau / strength)
		last = sense
		part = min(1.0, max(0.0, (1 - sense * tau / strength) / (1 - ratio)))
		tau += part * stiffness * change
		plastic = (1 - part) * abs(change)
		if abs(tau) > strength:
			plastic += (abs(tau) - strength) / stiffness
			tau = sense * strength
		angle = intrinsic + (angle - intrinsic) * math.exp(-plastic / wear)
		rise += math.tan(max(0, math.atan(abs(tau) / stress) - intrinsic)) * plastic
		found.append((tau, rise))
	return np.array([(0, 0), *found]).T


@dimensions
def testContinuouslyYieldingFollowsItsRateEquations(flat):
	law = ContinuouslyYieldingStrength(initialFrictionAngle=fresh, roughness=wear)
	way, tau, sigma, rise = shear(flat, 0.01, 4e-3, 1e6, strength=law, frictionAngle=intrinsic)
	ways = np.linspace(0, way[-1], 40001)
	wanted, risen = yielding(ways, 1e6, stiff)
	assert tau == pytest.approx(np.interp(way, ways, wanted), abs=0.01 * wanted.max())
	assert rise == pytest.approx(np.interp(way, ways, risen), abs=0.02 * risen.max())
	# it peaks below the fresh joint's strength, and falls towards the intrinsic one
	assert math.tan(intrinsic) * 1e6 < tau[-1] < tau.max() < math.tan(fresh) * 1e6


def testContinuouslyYieldingStiffensWithTheStress():
	law = ContinuouslyYieldingStrength(initialFrictionAngle=fresh, roughness=wear, stiffnessExponent=0.5, referenceStress=4e6)
	way, tau, _, _ = shear(False, 0.002, 2e-5, 1e6, strength=law, frictionAngle=intrinsic)
	ways = np.linspace(0, way[-1], 2001)
	assert tau == pytest.approx(np.interp(way, ways, yielding(ways, 1e6, stiff / 2)[0]), abs=3e3)


def testContinuouslyYieldingTurnsBack():
	"""Forth, back and forth again: elastic where it turns, and a loop that loses energy."""
	law = ContinuouslyYieldingStrength(initialFrictionAngle=fresh, roughness=wear)
	body, up = block(False, 0, strength=law, frictionAngle=intrinsic)
	body.state.blockedDOFs = 'xyXYZ'
	O.forces.setPermF(1, (0, 0, -1e6))
	O.run(400, wait=True)
	ways, stresses = [0.0], [0.0]
	begin, path = float(body.state.pos[0]), []
	for speed, steps in ((0.01, 200), (-0.01, 250), (0.01, 300)):
		body.state.vel = Vector3(speed, 0, 0)
		for _ in range(steps):
			O.step()
			path.append(float(body.state.pos[0]) - begin)
			stresses.append(-float(O.interactions[0, 1].phys.shearForce[0]) / O.interactions[0, 1].phys.contactArea)
		body.state.vel = Vector3(0, 0, 0)
	ways += path
	wanted, _ = yielding(np.array(ways), 1e6, stiff)
	assert np.array(stresses) == pytest.approx(wanted, abs=0.02 * wanted.max())


# ------------------------------------------------------------------------------------------------ closure


def pressed(flat, closure, closures, area=1.0, **material):
	"""Normal stress at each of these closures, the block being put there."""
	body, up = block(flat, 0, closure=closure, **material)
	body.state.blockedDOFs = 'xyzXYZ'
	O.dt = 1e-5
	found = []
	for closed in closures:
		position = Vector3(0, 0, 0)
		position[up] = half - closed
		body.state.pos = position
		O.step()
		O.step()
		found.append((O.interactions[0, 1].phys.normalForce.norm() / area, O.interactions[0, 1].geom.penetrationDepth))
	return np.array(found).T


cycle = np.concatenate([np.linspace(1e-6, 9e-5, 15), np.linspace(9e-5, 2e-5, 10), np.linspace(2e-5, 9.8e-5, 15)])


@dimensions
def testTheHyperbolaOfNormalCycles(flat):
	stress, depth = pressed(flat, HyperbolicClosure(maximumClosure=1e-4), cycle)
	assert stress == pytest.approx(stiff * cycle / (1 - cycle / 1e-4), rel=0.01)
	assert depth == pytest.approx(cycle, rel=1e-3)


@dimensions
def testThePowerOfNormalCycles(flat):
	stress, _ = pressed(flat, PowerClosure(exponent=0.5, referenceStress=1e6), cycle)
	assert stress == pytest.approx(1e6 * (0.5 * stiff / 1e6 * cycle) ** 2, rel=0.01)


def testAHyperbolaPerContact():
	body, up = block(False, 0, closure=HyperbolicClosure(maximumClosure=1e-4))
	O.engines = polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False), gravity=(0, 0, 0))
	body.state.blockedDOFs = 'xyzXYZ'
	O.dt = 1e-5
	for closed in (2e-5, 8e-5):
		body.state.pos = (0, 0, half - closed)
		O.step()
		O.step()
		assert O.interactions[0, 1].phys.normalForce.norm() == pytest.approx(stiff * closed / (1 - closed / 1e-4), rel=0.01)
		assert O.interactions[0, 1].phys.kn == pytest.approx(stiff / (1 - closed / 1e-4) ** 2, rel=0.01)


def testTheTimeStepFollowsTheStiffness():
	"""A hundred times stiffer at nine tenths of the maximum closure; between two updates of the stepper, too."""
	body, up = block(False, 1e-6, closure=HyperbolicClosure(maximumClosure=1e-4))
	body.state.blockedDOFs = 'xyXYZ'
	O.step()
	O.step()
	before = O.dt
	for step in range(20):
		body.state.pos = (0, 0, half - 9e-5 * (step + 1) / 20)
		body.state.vel = Vector3(0, 0, 0)
		O.step()
	assert O.iter < 50
	assert O.dt == pytest.approx(before / 10, rel=0.4)
	assert O.dt < 1.01 * 0.4 * polytope.stableTimeStep(1) / 0.6


@pytest.mark.parametrize(
	'closure', [HyperbolicClosure(maximumClosure=2e-4), PowerClosure(exponent=0.4, referenceStress=1e5)], ids=['hyperbola', 'power']
)
@pytest.mark.parametrize('perArea', [True, False], ids=['perArea', 'perContact'])
def testAGasKeepsItsEnergy(closure, perArea):
	"""Solids that fly about in a box and collide with faces, edges and corners, without friction and damping."""
	rng = np.random.default_rng(5)
	unit = 1 if perArea else 1e-2
	joint(normalStiffness=1e9 * unit, shearStiffness=1e9 * unit, frictionAngle=0, closure=closure)
	for axis in range(3):
		for side in (-1, 1):
			centre, size = Vector3(0, 0, 0), Vector3(1, 1, 1)
			centre[axis], size[axis] = side * 0.7, 0.2
			O.bodies.append(polytope.cuboid(centre, size, fixed=True))
	for k in range(8):
		place = (np.array([k & 1, k >> 1 & 1, k >> 2]) - 0.5) * 0.5
		O.bodies.append(
			polytope.cuboid(
				Vector3(*place),
				Vector3(*rng.uniform(0.06, 0.1, 3)),
				velocity=Vector3(*rng.uniform(-1, 1, 3)),
				angularVelocity=Vector3(*rng.uniform(-3, 3, 3)),
			)
		)
	O.engines = polytope.engines(
		physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea), gravity=(0, 0, 0), damping=0
	)
	O.engines[-1].timestepSafetyCoefficient = 0.1
	O.run(10, wait=True)
	begin, collided, errors = polytope.mechanicalEnergy(), 0, []
	for _ in range(40):
		O.run(50, wait=True)
		collided = max(collided, sum(contact.isReal for contact in O.interactions))
		errors.append(abs(polytope.mechanicalEnergy() / begin - 1))
	assert collided > 2
	assert max(errors) < 2e-3


# ------------------------------------------------------------------------------------------------ energy, memory, refusals


@pytest.mark.parametrize('law', ['rough', 'yielding'])
def testAllEnergyIsAccountedFor(law):
	"""What the drive and the weight give is stored, or lost in friction; dilation lifts the weight."""
	strength = (
		BartonBandisStrength(JRC=10, JCS=100e6)
		if law == 'rough'
		else ContinuouslyYieldingStrength(initialFrictionAngle=fresh, roughness=wear)
	)
	body, up = block(False, 0, strength=strength, frictionAngle=residual, closure=HyperbolicClosure(maximumClosure=1e-3))
	body.state.blockedDOFs = 'xyXYZ'
	O.forces.setPermF(1, (0, 0, -1e6))
	O.run(400, wait=True)
	O.trackEnergy = True
	O.step()
	body.state.vel = Vector3(0.01, 0, 0)
	begin, given, before = float(O.energy['elastPotential']), 0.0, None
	for _ in range(1500):
		O.step()
		force = -float(O.interactions[0, 1].phys.shearForce[0])
		given += 0.01 * O.dt * (force + (force if before is None else before)) / 2
		before = force
	lost = float(O.energy['plastDissip'])
	assert lost > 0
	assert abs(float(O.energy['nonconservative'])) < 0.01 * lost
	lifted = 1e6 * (O.interactions[0, 1].phys.dilation)
	assert lost + lifted + float(O.energy['elastPotential']) - begin == pytest.approx(given, rel=0.02)


def testASceneThatIsSavedGoesOnAsItWould(tmp_path):
	def scene():
		body, up = block(False, 0, closure=HyperbolicClosure(maximumClosure=1e-3), **rough)
		body.state.blockedDOFs = 'xyXYZ'
		O.engines[3].gravity = (0, 0, -1e6 / body.state.mass)
		O.run(100, wait=True)
		body.state.vel = Vector3(0.01, 0, 0)
		O.run(600, wait=True)

	scene()
	O.save(str(tmp_path / 's.yade'))
	O.run(300, wait=True)
	straight = O.interactions[0, 1].phys
	expected = (
		straight.slipLength,
		straight.dilation,
		straight.tangensOfFrictionAngle,
		Vector3(straight.normalForce),
		Vector3(straight.shearForce),
	)
	assert expected[0] > 0 and expected[1] > 0
	O.load(str(tmp_path / 's.yade'))
	O.run(300, wait=True)
	loaded = O.interactions[0, 1].phys
	assert (loaded.slipLength, loaded.dilation, loaded.tangensOfFrictionAngle, loaded.normalForce, loaded.shearForce) == expected
	material = O.materials[0]
	assert (material.strength.JRC, material.strength.JCS, material.closure.maximumClosure) == (10, 100e6, 1e-3)


def testTwoMaterials():
	one = RockJointMat(
		normalStiffness=1e10,
		frictionAngle=0.5,
		closure=HyperbolicClosure(maximumClosure=1e-4),
		strength=BartonBandisStrength(JRC=12, JCS=5e7),
	)
	other = RockJointMat(
		normalStiffness=1e10,
		frictionAngle=0.6,
		closure=HyperbolicClosure(maximumClosure=3e-4),
		strength=BartonBandisStrength(JRC=8, JCS=9e7),
	)
	plain = RockJointMat(normalStiffness=1e10, frictionAngle=0.4)
	O.materials.append([one, other, plain])
	O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True, material=one))
	for x, material in ((-1.1, other), (1.1, plain)):
		O.bodies.append(polytope.cuboid((x, 0, 0.5 - 5e-5), (0.5, 0.5, 0.5), material=material))
		O.bodies[-1].state.blockedDOFs = 'xyzXYZ'
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.dt = 1e-6
	O.step()
	O.step()
	both, single = (O.interactions[0, k].phys for k in (1, 2))
	assert both.hasOwnStrength and not single.hasOwnStrength
	assert both.normalForce.norm() == pytest.approx(1e10 * 5e-5 / (1 - 5e-5 / 2e-4), rel=0.01)
	assert single.normalForce.norm() == pytest.approx(1e10 * 5e-5, rel=0.01)
	assert single.tangensOfFrictionAngle == pytest.approx(math.tan(0.4))


@pytest.mark.parametrize(
	'law,name,value',
	[
		(BartonBandisStrength, 'JRC', -1),
		(BartonBandisStrength, 'JRC', 31),
		(BartonBandisStrength, 'JCS', 0),
		(BartonBandisStrength, 'jointLength', 0),
		(BartonBandisStrength, 'sampleLength', math.nan),
		(ContinuouslyYieldingStrength, 'initialFrictionAngle', 50),
		(ContinuouslyYieldingStrength, 'roughness', 0),
		(ContinuouslyYieldingStrength, 'stiffnessExponent', 2),
		(ContinuouslyYieldingStrength, 'referenceStress', -1),
		(HyperbolicClosure, 'maximumClosure', 0),
		(HyperbolicClosure, 'maximumClosure', math.inf),
		(PowerClosure, 'exponent', 1),
		(PowerClosure, 'referenceStress', 0),
	],
)
def testBadParametersAreRefused(law, name, value):
	good = law()
	before = getattr(good, name)
	with pytest.raises(ValueError, match=f'^{name}: must be'):
		setattr(good, name, value)
	assert getattr(good, name) == before
	with pytest.raises(ValueError, match=f'^{name}: must be'):
		law(**{name: value})


@pytest.mark.parametrize(
	'name,value',
	[
		('cohesion', 1e5),
		('residualCohesion', 1e4),
		('tensileStrength', 1e4),
		('residualTensileStrength', 1.0),
		('residualFrictionAngle', 0.3),
		('dilationAngle', 0.1),
		('dilationLimit', 1e-3),
	],
)
@pytest.mark.parametrize('strength', [BartonBandisStrength(), ContinuouslyYieldingStrength()])
def testWhatBelongsToMohrCoulombIsRefused(strength, name, value):
	with pytest.raises(ValueError, match=f'^{name}: belongs to Mohr-Coulomb'):
		RockJointMat(strength=strength, **{name: value})
	material = RockJointMat(strength=strength)
	with pytest.raises(ValueError, match=f'^{name}: belongs to Mohr-Coulomb'):
		setattr(material, name, value)
	assert getattr(material, name) == getattr(RockJointMat(), name)
	plain = RockJointMat(**{name: value, name.replace('residualC', 'c').replace('residualT', 't'): value})
	name = name.replace('residualC', 'c').replace('residualT', 't')  # the peak is named first
	with pytest.raises(ValueError, match=f'^{name}: belongs to Mohr-Coulomb'):
		plain.strength = strength
	assert plain.strength is None


@pytest.mark.parametrize('wrong', [BartonBandisStrength(), 3, 'stiff'])
def testALawOfTheWrongKindIsNamed(wrong):
	material = RockJointMat(closure=PowerClosure(), strength=None)
	with pytest.raises(ValueError, match=f'^closure: must be a normal law, HyperbolicClosure.* got {type(wrong).__name__}$'):
		RockJointMat(closure=wrong)
	with pytest.raises(ValueError, match='^closure: must be a normal law'):
		material.closure = wrong
	assert isinstance(material.closure, PowerClosure)
	material.closure = None
	with pytest.raises(ValueError, match='^strength: must be a shear law, BartonBandisStrength.* got HyperbolicClosure$'):
		material.strength = HyperbolicClosure()
	with pytest.raises(ValueError, match='^strength: must be a shear law'):
		RockJointMat(strength=HyperbolicClosure())
	assert material.strength is None and material.closure is None


def testWhatElseDoesNotGoTogether():
	with pytest.raises(ValueError, match='^tensileStrength: a joint with a closure'):
		RockJointMat(tensileStrength=1e5, closure=HyperbolicClosure())
	RockJointMat(cohesion=1e5, closure=HyperbolicClosure())
	with pytest.raises(ValueError, match='^frictionAngle: must not be above'):
		RockJointMat(frictionAngle=1, strength=ContinuouslyYieldingStrength(initialFrictionAngle=0.9))
	with pytest.raises(ValueError, match='^reduction: belongs to a shear law'):
		RockJointMat(reduction=2)


dip = math.radians(35)


def blockOnASlope(**material):
	"""A block on a slope at rest; returns the normal stress under it."""
	joint(normalStiffness=1e9, shearStiffness=1e9, **material)
	turn = Quaternion((0, 1, 0), dip)
	O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, -1), (5, 5, 1), orientation=turn, fixed=True))
	O.bodies.append(polytope.cuboid(turn * Vector3(0, 0, 0.5), (1, 1, 0.5), orientation=turn))
	O.engines = polytope.engines(damping=0.8)
	polytope.settle()
	return 2600 * 9.81 * math.cos(dip)


def testFactorOfSafetyOfAContinuouslyYieldingSlope():
	law = ContinuouslyYieldingStrength(initialFrictionAngle=fresh, roughness=1.0)
	blockOnASlope(strength=law, frictionAngle=residual)
	assert polytope.factorOfSafety(tolerance=0.02).factor == pytest.approx(math.tan(fresh) / math.tan(dip), rel=0.03)
	assert O.materials[0].reduction == 1 and O.interactions[0, 1].phys.reduction == 1


def testFactorOfSafetyOfARoughSlope():
	"""Strengths are reduced in small steps, in which the roughness is mobilised: the factor is tan φ of the peak at this stress over tan 35°."""
	stress = blockOnASlope(**rough)
	closed = math.tan(residual + math.radians(10 * math.log10(wall / stress))) / math.tan(dip)
	assert polytope.factorOfSafety(tolerance=0.02).factor == pytest.approx(closed, rel=0.03)
	found = StrengthReduction([1], steps=(0.1, 0.02)).run()
	assert found.factor == pytest.approx(closed, rel=0.03)
	assert O.materials[0].reduction == pytest.approx(found.failed)


def testWallStrengthInMPaIsFound():
	joint(strength=BartonBandisStrength(JCS=60), frictionAngle=residual)
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	with pytest.warns(UserWarning, match='JCS of RockJointMat .* is 60 Pa'):
		O.engines = polytope.engines()


def testNoSingleAngleStandsForAShearLaw():
	joint(strength=BartonBandisStrength(), frictionAngle=residual)
	with pytest.raises(ValueError, match='^strength: joints have a shear law'):
		setFrictionAngle(0.3)
	assert O.materials[0].frictionAngle == residual
