# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints that keep tensile strength while they are torn open: in direct tension, in bending, hung beside their middle, and their energy."""

import math

import numpy as np
import pytest
from scenes import driven
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, O, RockJointMat, Vector3, polytope

stiffness, strength, gravity = 1e9, 2e4, 9.81
half = 0.05
perArea = pytest.mark.parametrize('perArea', [True, False])


def hung(residual=strength, perArea=True, offset=0.0, two=False, peak=strength, damping=0.3):
	"""A brick below a fixed one, which touches it all over; no gravity. Returns it, and the area in common."""
	kn = stiffness * (1 if perArea else 4 * half**2)
	O.materials.append(
		RockJointMat(
			density=2600,
			normalStiffness=kn,
			shearStiffness=kn,
			cohesion=1e6,
			residualCohesion=1e6,
			tensileStrength=peak,
			residualTensileStrength=residual,
		)
	)
	sink, width = 1e-9, 2 * half - offset
	if two:
		O.bodies.append(polytope.polygon([(-half, -half), (half, -half), (half, half), (-half, half)], fixed=True))
		lower = [(-half, -3 * half), (half, -3 * half), (half, -half), (-half, -half)]
		O.bodies.append(polytope.polygon([(x + offset, y + sink) for x, y in lower]))
	else:
		O.bodies.append(polytope.cuboid((0, 0, 0), (half, half, half), fixed=True))
		O.bodies.append(polytope.cuboid((offset, 0, -2 * half + sink), (half, half, half)))
	O.engines = polytope.engines(
		gravity=(0, 0, 0), damping=damping, physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)
	)
	O.run(20, wait=True)
	return O.bodies[1], width * (1 if two else 2 * half)


def pulled():
	"""(opening [m], force in tension [N])"""
	contact = O.interactions[0, 1]
	return float(-2 * half - O.bodies[1].state.pos[2]), float((contact.phys.normalForce - contact.phys.normalViscous)[2])


def moveTo(body, opening, speed=1e-3):
	"""Slowly; returns what *pulled* told on the way."""
	steps = max(1, round(abs(opening - pulled()[0]) / (speed * float(O.dt))))
	sign = math.copysign(speed, -(opening - pulled()[0]))
	body.state.vel = (0, 0, sign)
	rows = []
	for _ in range(steps):
		O.step()
		rows.append(pulled())
	body.state.vel = (0, 0, 0)
	O.step()
	return np.array(rows)


@perArea
@pytest.mark.parametrize('part', [1, 0.4])
def testPulledOpenItBearsItsResidualStrengthAndUnloadsElastically(perArea, part):
	body, area = hung(part * strength, perArea)
	driven(body)
	O.engines[-1].dead = True
	O.dt = 1e-5
	first, bears = strength / stiffness, part * strength * area
	rows = moveTo(body, 3 * first)
	before = rows[rows[:, 0] < 0.95 * first]
	assert before[:, 1] == pytest.approx(stiffness * area * before[:, 0], abs=2e-2 * strength * area)
	after = rows[rows[:, 0] > 1.05 * first]
	assert len(after) > 100 and after[:, 1] == pytest.approx(np.full(len(after), bears), rel=1e-3)
	lasting = 3 * first - part * first
	back = moveTo(body, -first)
	elastic, gap = back[back[:, 0] > 1.02 * lasting], back[(back[:, 0] < 0.98 * lasting) & (back[:, 0] > 0.02 * first)]
	assert elastic[:, 1] == pytest.approx(stiffness * area * (elastic[:, 0] - lasting), abs=2e-2 * strength * area)
	assert len(gap) > 10 and np.abs(gap[:, 1]).max() < 1e-9 * strength * area
	assert pulled()[1] == pytest.approx(-strength * area, rel=3e-2)  # it presses where it touches
	again = moveTo(body, 4 * first)
	assert again[-1, 1] == pytest.approx(bears, rel=1e-3)
	if not perArea:
		assert O.interactions[0, 1].phys.lastingOpening == pytest.approx(4 * first - part * first, rel=2e-2)


@perArea
@pytest.mark.parametrize('part', [1, 0.4])
def testWorkOfTearingIsPlasticAndWhatThePeakLosesIsFracture(perArea, part):
	body, area = hung(part * strength, perArea)
	driven(body)
	O.engines[-1].dead = True
	O.dt, O.trackEnergy = 1e-5, True
	first = strength / stiffness
	moveTo(body, 5 * first)
	scale = strength * area * first
	assert O.energy['elastPotential'] == pytest.approx(part**2 * scale / 2, rel=1e-2)
	assert O.energy['plastDissip'] == pytest.approx(part * (5 - part) * scale, rel=5e-2 if part < 1 else 1e-2)
	lost = (1 - part) ** 2 * scale / 2 if part < 1 else 0
	fracture = O.energy['fractureDissip'] if part < 1 else 0
	total = O.energy['elastPotential'] + O.energy['plastDissip'] + fracture
	work = scale / 2 + part * 4 * scale
	assert total == pytest.approx(work, rel=1e-2) and fracture == pytest.approx(lost, abs=2e-2 * scale)
	assert abs(O.energy['nonconservative']) < 1e-3 * scale


def momentOfSection(rotation, width, depth):
	"""Moment of a rectangle without normal force, whose springs bear the strength in tension and any pressure, when it is bent by this angle."""
	k = stiffness * rotation
	if k * width / 2 <= strength:
		return k * depth * width**3 / 12
	yielding = strength / k  # distance from the neutral axis where the strength is reached
	# pressed over c: k c²/2 = T e/2 + T (w − c − e)
	c = (-strength + math.sqrt(strength**2 + 2 * k * strength * (width - yielding / 2))) / k
	return depth * (k * c**3 / 3 + strength * yielding**2 / 3 + strength * ((width - c) ** 2 - yielding**2) / 2)


@pytest.mark.parametrize('times', [0.8, 1.5, 4, 40])
def testABentJointHasTheMomentOfItsElasticPlasticSection(times):
	"""The moment rises to three times the one at which the joint's edge yields: from T b h²/6 to T b h²/2, where all of it is torn open."""
	body, area = hung(damping=0.5)
	limit = strength / (stiffness * half)  # rotation at which the edge yields
	body.state.blockedDOFs = 'yXYZ'
	steps = 3000 + round(1000 * times)  # slowly: what swings open stays open
	body.state.angVel = (0, times * limit / (steps * float(O.dt)), 0)
	O.run(steps, wait=True)
	body.state.angVel = (0, 0, 0)
	O.run(3000, wait=True)
	bond, rotation = O.interactions[0, 1].phys.bond, float(body.state.ori.toAxisAngle()[1])
	moment = abs(float(bond.moment[1] + (bond.point - Vector3(0, 0, -half)).cross(bond.force)[1]))
	assert bond.force.norm() < 1e-3 * strength * area
	assert moment == pytest.approx(momentOfSection(rotation, 2 * half, 2 * half), rel=1e-2)
	assert momentOfSection(40 * limit, 1, 1) > 2.5 * strength / 6


@pytest.mark.parametrize('two', [False, True])
@pytest.mark.parametrize('factor, holds', [(0.97, True), (1.03, False)])
def testABrickHungBesideItsMiddleFallsWhenAllOfItsFaceYields(two, factor, holds):
	"""It falls at W = T A/(1 + 2 e/h), e from the face's middle: moments about the edge that is still pressed. A brittle joint: T A/(1 + 6 e/h)."""
	offset = 0.02
	body, area = hung(offset=offset, two=two, damping=0.4)
	width = 2 * half - offset
	limit = strength * area / (1 + offset / width)  # e = offset/2
	for part in np.linspace(0.02, 1, 50):
		load = Vector3(0, -factor * part * limit, 0) if two else Vector3(0, 0, -factor * part * limit)
		O.forces.setPermF(1, load)
		O.run(200, wait=True)
	place = Vector3(body.state.pos)
	O.run(20000, wait=True)
	assert (body.state.vel.norm() < 1e-5 and (body.state.pos - place).norm() < 1e-4) == holds


@pytest.mark.parametrize('factor, holds', [(0.9, True), (1.03, False)])
def testACantileverOfBlocksFailsByAPlasticHingeAtItsClampedEnd(factor, holds):
	"""F L = T b h²/2: three times the load at which its outermost fibre yields. At nine tenths it has turned by 2 mrad. The joint nearer to
	the load has a third of the moment, and does not yield."""
	O.materials.append(
		RockJointMat(
			density=2600,
			normalStiffness=1e10,
			shearStiffness=1e10,
			cohesion=1e9,
			tensileStrength=strength,
			residualTensileStrength=strength,
		)
	)
	size = 2 * half
	O.bodies.append([polytope.cuboid((k * (size - 1e-10), 0, 0), (half, half, half), fixed=k == 0) for k in range(3)])
	O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.4)
	O.run(20, wait=True)
	limit = strength * size**3 / 2 / (1.5 * size)  # at the middle of the last block
	for part in np.linspace(0.02, 1, 50):
		O.forces.setPermF(2, (0, 0, -factor * part * limit))
		O.run(400, wait=True)
	O.run(4000, wait=True)
	height = float(O.bodies[2].state.pos[2])
	O.run(4000, wait=True)
	fallen = height - float(O.bodies[2].state.pos[2])
	assert (fallen < 1e-6 and O.bodies[2].state.vel.norm() < 1e-5) if holds else fallen > 5e-3
	assert not holds or O.interactions[1, 2].phys.bond.edgeStress < strength


@perArea
@pytest.mark.parametrize('residual, holds', [(1, True), (0, False)])
def testASwingOverTheStrengthIsNoFailureWhereItIsPerfectlyPlastic(perArea, residual, holds):
	"""Gravity that begins at once pulls twice as hard at first."""
	area = 4 * half**2
	weight = 2600 * 8 * half**3 * gravity
	peak = 1.1 * weight / area
	body, _ = hung(residual * peak, perArea, peak=peak, damping=0.2)
	body.state.blockedDOFs = 'XYZ'  # with a stiffness per contact it hangs by one point
	O.engines[3].gravity = (0, 0, -gravity)
	O.run(5000, wait=True)
	assert (body.state.vel.norm() < 1e-5 and body.state.pos[2] > -2.01 * half) == holds


def testATornJointEndsWhereTheGapIsItsBlocksInscribedRadius():
	body, area = hung()
	body.state.blockedDOFs = 'xyXYZ'
	O.forces.setPermF(1, (0, 0, -2 * strength * area))
	while O.interactions.has(0, 1) and O.interactions[0, 1].isReal:
		O.step()
		gap = float(-2 * half - body.state.pos[2])
	assert gap == pytest.approx(half, rel=2e-2)  # to the way of a step


@pytest.mark.parametrize('archive', ['state.xml', 'state.yade'])
def testALoadedSceneGoesOnYielding(archive, tmp_path):
	body, area = hung(offset=0.02)
	O.forces.setPermF(1, (0, 0, -0.7 * strength * area))
	O.run(2000, wait=True)
	assert O.interactions[0, 1].phys.bond
	O.forces.setPermF(1, (0, 0, 0))
	O.save(str(tmp_path / archive))
	ends = []
	for _ in range(2):
		O.run(200, wait=True)
		ends.append([*O.bodies[1].state.pos, *O.bodies[1].state.ori])
		O.load(str(tmp_path / archive))
	assert ends[0] == pytest.approx(ends[1], abs=1e-13)


@pytest.mark.parametrize('name, peak', [('residualTensileStrength', 'tensileStrength'), ('residualCohesion', 'cohesion')])
@pytest.mark.parametrize('value', [-1, float('nan'), float('inf')])
def testBadValuesAreRefused(name, peak, value):
	with pytest.raises(ValueError, match=f'^{name}'):
		RockJointMat(**{name: value})
	material = RockJointMat(**{peak: 6, name: 5})
	with pytest.raises(ValueError, match=f'^{name}'):
		setattr(material, name, value)
	assert getattr(material, name) == 5


def testItIsNotAboveThePeak():
	with pytest.raises(ValueError, match='^residualTensileStrength: must be at most the tensileStrength'):
		RockJointMat(tensileStrength=6, residualTensileStrength=7)
	material = RockJointMat(tensileStrength=6, residualTensileStrength=5)
	with pytest.raises(ValueError, match='^residualTensileStrength: must be at most the tensileStrength'):
		material.tensileStrength = 4
	assert (material.tensileStrength, material.residualTensileStrength) == (6, 5)


def testBetweenTwoMaterialsItCountsUpToTheSmallerPeak():
	weak, tough = dict(cohesion=1e6, tensileStrength=1e3), dict(cohesion=1e6, tensileStrength=9e3, residualTensileStrength=9e3)
	for residual in (0, 1e3):
		O.reset()
		O.materials.append([RockJointMat(**weak, residualTensileStrength=residual), RockJointMat(**tough)])
		for k in (0, 1):
			O.bodies.append(polytope.cuboid((0, 0, k * (1 - 1e-9)), (0.5, 0.5, 0.5), fixed=k == 0, material=k))
		O.engines = polytope.engines(gravity=(0, 0, 0))
		O.step()
		phys = O.interactions[0, 1].phys
		assert (phys.tensileStrength, phys.residualTensileStrength) == (1e3, residual)
