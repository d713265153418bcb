# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints that keep cohesion once they have failed: a block on a plane, and a wedge on two of them against limit equilibrium (Hoek & Bray)."""

from math import cos, radians, sin, tan

import numpy as np
import pytest
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, O, RockJointMat, RockJointPhys, Vector3, polytope
from yade.polytope.strengthReduction import divideStrengths

gravity = 9.81


def blockOnPlane(cohesion, residual, slope=radians(50), friction=radians(30), perArea=True, tensile=0.0):
	"""A block of 1 m² and 1 t, too flat to topple, on a plane that slopes because gravity leans."""
	O.reset()
	stiffness = 1e9
	O.materials.append(
		RockJointMat(
			density=5000,
			normalStiffness=stiffness,
			shearStiffness=stiffness,
			frictionAngle=friction,
			cohesion=cohesion,
			residualCohesion=residual,
			tensileStrength=tensile,
		)
	)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (9, 2, 0.5), fixed=True))
	sink = 1000 * gravity * cos(slope) / stiffness
	block = O.bodies[O.bodies.append(polytope.cuboid((-5, 0, 0.1 - sink), (0.5, 0.5, 0.1)))]
	O.engines = polytope.engines(
		gravity=(gravity * sin(slope), 0, -gravity * cos(slope)),
		damping=0,
		physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea),
	)
	return block


@pytest.mark.parametrize('perArea', [True, False])
@pytest.mark.parametrize('part', [0, 0.5, 1])
def testABlockSlidesAgainstWhatIsLeftOfItsCohesion(part, perArea):
	"""a = g sin α − (N tan φ + c A)/m, c the residual cohesion, after the peak is passed."""
	cohesion, slope, friction = 1.2e3, radians(50), radians(30)
	block = blockOnPlane(cohesion, part * cohesion, slope, friction, perArea)
	O.run(1000, wait=True)
	start, velocity = O.time, block.state.vel[0]
	contact = O.interactions[0, 1]
	assert contact.phys.residualCohesion == part * cohesion and not contact.phys.intact
	O.run(1000, wait=True)
	acceleration = gravity * sin(slope) - gravity * cos(slope) * tan(friction) - part * cohesion / 1000
	assert acceleration > 1 and (block.state.vel[0] - velocity) / (O.time - start) == pytest.approx(acceleration, rel=2e-3)


@pytest.mark.parametrize('tensile', [0, 1e5])
@pytest.mark.parametrize('factor, stands', [(1.03, True), (0.97, False)])
def testPerfectlyPlasticCohesionHoldsAtItsFactorOfSafety(factor, stands, tensile):
	"""A swing over the strength is lost motion, no failure: gravity that begins at once (twice the shear force) does not take the cohesion."""
	slope, friction = radians(50), radians(30)
	cohesion = factor * 1000 * gravity * sin(slope) - 1000 * gravity * cos(slope) * tan(friction)
	block = blockOnPlane(cohesion, cohesion, slope, friction, tensile=tensile)
	O.engines[3].damping = 0.2
	while O.time < 1:
		O.run(500, wait=True)
	assert (block.state.vel.norm() < 1e-4 and block.state.pos[0] < -4.99) == stands


def normalOf(dip, direction):
	return np.array(polytope.JointSet(radians(dip), radians(direction), 1).normal)


def wedge(factor, shearStiffness):
	"""Hoek & Bray's wedge of two joints (24 kPa, 20° and 48 kPa, 30°), 30 m high, dry; strengths over *factor*. Returns it and its factor
	of safety."""
	O.reset()
	one, two, face, top = (normalOf(*joint) for joint in ((45, 105), (70, 235), (65, 185), (12, 195)))
	strengths = (24e3, radians(20)), (48e3, radians(30))
	for label in 'AB':
		O.materials.append(
			RockJointMat(
				label=label, density=2600, normalStiffness=1e9, shearStiffness=shearStiffness, frictionAngle=radians(60), cohesion=1e9
			)
		)
	O.materials.append(
		RockJointMat(
			label='W',
			density=2600,
			normalStiffness=1e9,
			shearStiffness=shearStiffness,
			frictionAngle=radians(80),
			cohesion=1e12,
			residualCohesion=1e12,
		)
	)
	line = np.cross(one, two)
	line *= -np.sign(line[2]) / np.linalg.norm(line)
	up = np.array([-face[0] * face[2], -face[1] * face[2], 1 - face[2] ** 2])
	body = polytope.fromHalfSpaces([-one, -two, face, top], [0, 0, 0, float(top @ (30 * up / up[2]))], material='W')
	box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	O.bodies.append(polytope.fromHalfSpaces([one, *box], [0] + [200] * 6, material='A', fixed=True))
	O.bodies.append(polytope.fromHalfSpaces([two, -one, *box], [0, 0] + [200] * 6, material='B', fixed=True))
	body = O.bodies[O.bodies.append(body)]
	O.engines = polytope.engines()
	while O.time < 3:
		O.run(500, wait=True)
	areas = [O.interactions[k, body.id].phys.contactArea for k in (0, 1)]
	weight = body.state.mass * gravity
	pressed = np.linalg.solve(np.column_stack([one, two, -line]), [0, 0, weight])
	bears = sum(c * area + n * tan(phi) for (c, phi), area, n in zip(strengths, areas, pressed[:2], strict=True))
	for contact in O.interactions:
		if isinstance(contact.phys, RockJointPhys):
			cohesion, friction = strengths[contact.id1]
			contact.phys.cohesion = contact.phys.residualCohesion = cohesion / factor
			contact.phys.tangensOfFrictionAngle = tan(friction) / factor
	return body, bears / pressed[2]


@pytest.mark.parametrize('shearStiffness', [1e9, 1e7])
def testAWedgeHasTheFactorOfSafetyOfLimitEquilibrium(shearStiffness):
	for part, stands in ((0.985, True), (1.015, False)):
		safety = wedge(1, shearStiffness)[1]
		assert safety == pytest.approx(1.877, abs=5e-3)
		body, _ = wedge(part * safety, shearStiffness)
		place = Vector3(body.state.pos)
		end = O.time + 4
		while O.time < end and (body.state.pos - place).norm() < 0.5:
			O.run(500, wait=True)
		assert ((body.state.pos - place).norm() < 0.1) == stands, (part, body.state.pos - place, body.state.vel)


def testItIsNotAboveThePeak():
	with pytest.raises(
		ValueError, match='^residualCohesion: must be at most the cohesion, and where both become smaller this one first, got 7'
	):
		RockJointMat(cohesion=6, residualCohesion=7)
	material = RockJointMat(cohesion=6, residualCohesion=5)
	with pytest.raises(ValueError, match='^residualCohesion: must be at most the cohesion'):
		material.cohesion = 4
	assert (material.cohesion, material.residualCohesion) == (6, 5)
	material.residualCohesion = material.cohesion = 4
	O.materials.append(material)
	for factor, cohesion in ((2, 2), (0.25, 8)):  # down and up
		divideStrengths(factor)
		assert (material.cohesion, material.residualCohesion) == (cohesion, cohesion)
