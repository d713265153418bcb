# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds while they hold, against closed forms: springs, aggregates at rest and in flight, time step, what is refused."""

import math

import numpy as np
import pytest
from scenes import joint, loop, stepper
from yade import ForceResetter, NewtonIntegrator, O, Quaternion, RockJointMat, Sphere, Vector3, polytope, utils

kn, ks = 1e9, 4e8


def bondedPair(gap=0.0, half=(0.5, 0.4, 0.3)):
	"""A block bonded to a fixed one along x, across a gap (an overlap, where negative)."""
	joint(normalStiffness=kn, shearStiffness=ks)
	O.bodies.append(polytope.cuboid((0, 0, 0), half, fixed=True))
	O.bodies.append(polytope.cuboid((2 * half[0] + gap, 0, 0), half))
	loop(True)
	O.dt = 1e-12
	assert polytope.bond(gap=max(gap, 0) * 1.5) == 1
	return polytope.bonds().bonds[0], O.bodies[1].state


@pytest.mark.parametrize('gap', [-1e-3, 0, 1e-2])
def testABondBeginsWithoutStress(gap):
	bond, _ = bondedPair(gap)
	O.step()
	assert bond.area == pytest.approx(0.8 * 0.6, rel=1e-12) and bond.intact
	assert bond.force.norm() < 1e-6 and bond.moment.norm() < 1e-6  # rounding of positions, times 4.8e8 N/m
	assert bond.overlap == pytest.approx(max(-gap, 0), abs=1e-15)
	assert not O.interactions.has(0, 1) or not O.interactions[0, 1].isReal


@pytest.mark.parametrize('gap', [-1e-3, 1e-2])
def testPullShearBendingAndTwistAreHookes(gap):
	bond, state = bondedPair(gap)
	area, wide, high = 0.48, 0.8, 0.6
	moments = {1: kn * wide * high**3 / 12, 2: kn * high * wide**3 / 12, 0: ks * wide * high * (wide**2 + high**2) / 12}
	start, middle = Vector3(state.pos), Vector3(0.5 + gap / 2, 0, 0)
	for axis in range(3):
		along = Vector3(*[1e-6 * (k == axis) for k in range(3)])
		state.pos = start + along
		O.step()
		assert bond.force[axis] == pytest.approx(-(kn if axis == 0 else ks) * area * 1e-6, rel=1e-6)
		assert bond.energy == pytest.approx(abs(bond.force[axis]) * 1e-6 / 2, rel=1e-6)
		turn = Quaternion(along.normalized(), 1e-6)  # about the bond's point
		state.pos, state.ori = middle + turn * (start - middle), turn
		O.step()
		assert bond.moment[axis] == pytest.approx(-moments[axis] * 1e-6, rel=1e-6)
		assert bond.force.norm() < 1e-5 * moments[axis] * 1e-6
		assert np.array(O.forces.t(0)) == pytest.approx(
			-np.array(O.forces.t(1)) - np.cross(np.array(start), np.array(O.forces.f(1))), abs=1e-6
		)
		state.pos, state.ori = start, Quaternion((1, 0, 0), 0)
	edge = bond
	turn = Quaternion(Vector3(0, 1, 0), 1e-6)
	state.pos, state.ori = middle + turn * (start - middle), turn
	O.step()
	assert edge.edgeStress == pytest.approx(kn * 1e-6 * high / 2, rel=1e-6) and abs(edge.normalStress) < 1e-6 * edge.edgeStress


def aggregate(cells=30, **bond):
	joint(normalStiffness=1e10, shearStiffness=5e9)
	blocks = polytope.voronoi(((0, 0, 0), (1, 1, 1)), cells, seed=3).blocks
	O.bodies.append([polytope.fromHalfSpaces(*block) for block in blocks])
	loop(True)
	made = polytope.bond(**bond)
	stepper()
	return made


def faceAreas(body):
	corners = np.array(body.shape.vertices, float)
	total = 0
	for face in body.shape.faces:
		ring = corners[list(face)]
		total += np.linalg.norm(sum(np.cross(ring[k] - ring[0], ring[k + 1] - ring[0]) for k in range(1, len(ring) - 1))) / 2
	return total


def testAllFacesOfAVoronoiMassAreBondedOnce():
	aggregate()
	inner = (sum(map(faceAreas, O.bodies)) - 6) / 2  # those of a cube are free
	assert sum(bond.area for bond in polytope.bonds().bonds) == pytest.approx(inner, rel=1e-5)
	assert polytope.bond() == 0  # what is bonded stays as it is


def testAllFacesOfJointedRockAreBonded():
	joint(normalStiffness=1e10, shearStiffness=5e9)
	sets = [polytope.JointSet(dip=dip, dipDirection=direction, spacing=0.4) for dip, direction in ((0.2, 0), (1.4, 0.3), (1.5, 1.9))]
	sides = np.vstack([np.eye(3), -np.eye(3)])
	rock = polytope.jointedRock(sides, [1.0] * 6, sets, seed=1)
	O.bodies.append([polytope.fromHalfSpaces(*block) for block in rock.blocks])
	loop(True)
	polytope.bond()
	inner = (sum(map(faceAreas, O.bodies)) - 24) / 2
	assert len(O.bodies) > 30 and sum(bond.area for bond in polytope.bonds().bonds) == pytest.approx(inner, rel=1e-4)


def testAnUnloadedAggregateStaysAsItIs():
	made = aggregate(12, tensileStrength=1e3, cohesion=1e3)
	places = [(Vector3(body.state.pos), Quaternion(body.state.ori)) for body in O.bodies]
	O.run(100000, wait=True)
	assert polytope.bonds().intactCount == made > 30
	assert max((body.state.pos - place).norm() for body, (place, _) in zip(O.bodies, places, strict=True)) < 1e-9
	assert max(abs((body.state.ori.conjugate() * turn).toAxisAngle()[1]) for body, (_, turn) in zip(O.bodies, places, strict=True)) < 1e-9


def momenta():
	linear, angular = Vector3.Zero, Vector3.Zero
	for body in O.bodies:
		state = body.state
		linear += state.mass * state.vel
		angular += state.mass * state.pos.cross(state.vel) + state.angMom
	return linear, angular


def testAThrownAggregateKeepsItsMomenta():
	"""Bonds give both bodies opposite forces at one point. The default rotation algorithm of YADE's integrator keeps angular momentum to an order of
	the time step only; Fincham's adds the moment to it as it is."""
	aggregate(12)
	next(one for one in O.engines if isinstance(one, NewtonIntegrator)).rotAlgorithm = 'Fincham1992'
	spin = Vector3(3, -2, 5)
	for body in O.bodies:
		assert body.aspherical
		body.state.vel = Vector3(2, 1, 0) + spin.cross(body.state.pos - Vector3(0.5, 0.5, 0.5))
		body.state.angVel = spin
		axes = body.state.ori
		inBody = axes.conjugate() * spin
		body.state.angMom = axes * Vector3(*[body.state.inertia[k] * inBody[k] for k in range(3)])
	start = momenta()
	O.run(3000, wait=True)
	end = momenta()
	assert (end[0] - start[0]).norm() < 1e-12 * start[0].norm()
	assert (end[1] - start[1]).norm() < 1e-10 * start[1].norm()
	assert polytope.bonds().intactCount > 30


def testTheTimeStepKnowsBonds():
	bond, state = bondedPair()
	state.blockedDOFs = 'yzXYZ'
	limit = math.sqrt(state.mass / (kn * bond.area))
	assert polytope.stableTimeStep(fraction=1) == pytest.approx(limit, rel=1e-12)
	engine = stepper(timestepSafetyCoefficient=0.5)
	O.step()
	assert O.dt <= 0.5 * limit * (1 + 1e-12) and engine.limitedBy in ('contacts', 'material')
	state.blockedDOFs = 'xyzX'
	slip = ks * bond.area * 0.5**2  # at the bond, by a turn about the block's centre
	turning = kn * 0.8 * 0.6**3 / 12 + slip, kn * 0.6 * 0.8**3 / 12 + slip
	fastest = max(stiffness / inertia for stiffness, inertia in zip(turning, list(state.inertia)[1:], strict=True))
	assert polytope.stableTimeStep(fraction=1) == pytest.approx(1 / math.sqrt(fastest), rel=1e-9)


def testPolygonsAndPeriodicCells():
	joint(normalStiffness=kn, shearStiffness=ks)
	square = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
	O.bodies.append([polytope.polygon([(x + k, y) for x, y in square], thickness=0.2) for k in range(3)])
	loop(True)
	assert polytope.bond() == 2 and [bond.area for bond in polytope.bonds().bonds] == pytest.approx([0.2, 0.2])
	O.reset()
	joint(normalStiffness=kn, shearStiffness=ks)
	O.periodic = True
	O.cell.setBox(4, 4, 4)
	O.bodies.append([polytope.cuboid((k + 0.5, 1.5, 1.5), (0.5, 0.5, 0.5)) for k in range(4)])
	loop(True)
	assert polytope.bond() == 4  # the last one with the first one's image
	assert {tuple(bond.cellDist) for bond in polytope.bonds().bonds} in ({(0, 0, 0), (-1, 0, 0)}, {(0, 0, 0), (1, 0, 0)})
	stepper()
	O.run(100, wait=True)
	assert max(bond.force.norm() for bond in polytope.bonds().bonds) < 1e-3


def testAnglesOfFrictionHaveTheLimitsOfTheMaterial():
	for angle in (0, math.pi / 2 - 1e-5, math.pi / 2, 1.6):
		taken = []
		for make in (RockJointMat, polytope.bond):
			O.reset()
			bondedPair()
			try:
				make(frictionAngle=angle)
				taken.append(True)
			except ValueError:
				taken.append(False)
		assert taken == [angle < math.pi / 2] * 2, angle


def testWhatIsRefused():
	bondedPair()
	sphere = O.bodies.append(utils.sphere((9, 0, 0), 1))
	for name, value in {
		'gap': -1,
		'angle': 2,
		'normalStiffness': 0,
		'shearStiffness': -3,
		'bendingStiffness': math.inf,
		'twistingStiffness': 'a',
		'tensileStrength': 0,
		'cohesion': -1,
		'frictionAngle': 2,
		'bendingShare': 1.5,
		'ids': [0, 7],
	}.items():
		with pytest.raises(ValueError, match=f'^{name}: '):
			polytope.bond(**{name: value})
	with pytest.raises(ValueError, match='^ids: body 2 has no Polytope'):
		polytope.bond(ids=[0, sphere])
	assert isinstance(O.bodies[sphere].shape, Sphere) and len(polytope.bonds().bonds) == 1
	O.engines = [ForceResetter()]
	with pytest.raises(ValueError, match='^engines: set O.engines first'):
		polytope.bond()
