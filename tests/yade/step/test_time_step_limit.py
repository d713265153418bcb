# SPDX-License-Identifier: GPL-2.0-or-later
"""2 τ of one body between fixed ones against its measured limit of stability: faces, edges and vertices, all six motions free."""

import math

import numpy as np
import pytest
from scenes import contactOf, joint, loop
from yade import O, Quaternion, Vector3, _polytope, polytope

depth = 1e-6
"""Depth over the size [m]: the weight that presses so deep turns a body on a vertex much more slowly than its springs do."""
disturbance, growth, steps = 1e-5 * depth, 100, 300
halfCube, halfPlate = (0.5, 0.5, 0.5), (0.5, 0.5, 0.02)


def floor():
	return polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True)


def lowered(body, below=depth):
	"""The body with its lowest vertex so far below z = 0."""
	lowest = min(float((body.state.pos + body.state.ori * vertex)[2]) for vertex in body.shape.vertices)
	body.state.pos -= Vector3(0, 0, lowest + below)
	return body


def turned(from_, to):
	rotation = Quaternion()
	rotation.setFromTwoVectors(Vector3(*from_).normalized(), Vector3(*to).normalized())
	return rotation


def cuboidWith(lowest, half):
	"""A cuboid that stands on that point of its surface, its centre above it."""
	return lowered(polytope.cuboid((0, 0, 0), half, turned(lowest, (0, 0, -1))))


def onPegs():
	pegs = [polytope.cuboid((x, y, -0.5), (0.05, 0.05, 0.5), fixed=True) for x in (-0.4, 0, 0.4) for y in (-0.4, 0, 0.4)]
	return [*pegs, lowered(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.05)))]


def inCorner():
	sides = [polytope.cuboid(center, (1, 1, 1), fixed=True) for center in ((0, 0, -1), (-1.5 + depth, 0, 1.1), (0, -1.5 + depth, 1.1))]
	return [*sides, lowered(polytope.cuboid((0, 0, 0), halfCube))]


def crossedEdges():
	below = polytope.cuboid((0, 0, 0), (1, 0.5, 0.5), turned((0, 1, 1), (0, 0, 1)), fixed=True)
	below.state.pos = (0, 0, -math.sqrt(0.5))
	above = polytope.cuboid((0, 0, 0), (1, 0.5, 0.5), Quaternion((0, 0, 1), 1.2) * turned((0, 1, 1), (0, 0, -1)))
	return [below, lowered(above)]


scenes = {
	'cube on its face': lambda: [floor(), cuboidWith((0, 0, -1), halfCube)],
	'plate on its face': lambda: [floor(), cuboidWith((0, 0, -1), halfPlate)],
	'face lifted along one side': lambda: [floor(), lowered(polytope.cuboid((0, 0, 0), halfCube, Quaternion((1, 0.3, 0), depth)))],
	'plate that juts out': lambda: [
		polytope.cuboid((0.45, 0.1, -0.5), (0.3, 0.3, 0.5), fixed=True),
		cuboidWith((0, 0, -1), (0.5, 0.5, 0.1)),
	],
	'plate on nine pegs': onPegs,
	'cube in a corner': inCorner,
	'cube on its edge': lambda: [floor(), cuboidWith((0, 1, 1), halfCube)],
	'cube on its vertex': lambda: [floor(), cuboidWith((1, 1, 1), halfCube)],
	'edge across edge': crossedEdges,
	'tilted bar on its end': lambda: [floor(), lowered(polytope.cuboid((0, 0, 0), (1, 0.1, 0.1), Quaternion((1, 3, 0), 0.5)))],
}


def balanced(name, perArea, damping, shear):
	"""The scene's last body, free, with forces that balance those of its contacts."""
	O.reset()
	joint(normalStiffness=1e8, shearStiffness=shear * 1e8, frictionAngle=1.55)
	loop(perArea=perArea, normalDamping=damping, shearDamping=damping, ig2=contactOf('surface', perArea))
	O.bodies.append(scenes[name]())
	body = O.bodies[len(O.bodies) - 1]
	body.state.blockedDOFs, O.dt = 'xyzXYZ', 1e-12
	O.step()
	O.step()
	assert any(contact.isReal for contact in O.interactions)
	force, torque = Vector3(O.forces.f(body.id)), Vector3(O.forces.t(body.id))
	O.forces.setPermF(body.id, -force)
	O.forces.setPermT(body.id, -torque)
	body.state.blockedDOFs = ''
	O.step()  # dampers know what can move from the step before
	O.step()
	return body


def grows(dt, *scene):
	"""Whether a disturbance of all six motions grows a hundredfold with this time step."""
	state = balanced(*scene).state
	place, orientation, size = Vector3(state.pos), state.ori.conjugate(), math.sqrt(max(state.inertia) / state.mass)
	motion = np.random.default_rng(3).normal(size=6)
	state.pos += disturbance * Vector3(*motion[:3])
	axis = Vector3(*motion[3:])
	state.ori = Quaternion(axis.normalized(), float(disturbance / size * axis.norm())) * state.ori
	O.dt = dt
	for _ in range(steps):
		O.step()
		turn = orientation * state.ori
		tilt = 2 * math.sqrt(sum(float(turn[k]) ** 2 for k in range(3)))
		if not float((state.pos - place).norm()) + tilt * size < growth * disturbance:
			return True
	return False


@pytest.mark.parametrize('damping, shear', [(0, 0.6), (0.3, 0.6), (0, 0.01)])
@pytest.mark.parametrize('perArea', [True, False])
@pytest.mark.parametrize('name', scenes)
def testTheStepIsBetweenHalfOfTheLimitAndTheLimit(name, perArea, damping, shear):
	"""An edge or a vertex with a stiffness per contact is softer along its normal than k: where nothing but that holds the body (*shear*,
	the shear stiffness over k, is small), 2 τ is as low as 0.4 of the limit."""
	scene, least = (name, perArea, damping, shear), 0.5 if perArea or shear > 0.1 else 0.4
	balanced(*scene)
	limit = 2 * float(_polytope.timeStepLimits()['contacts'])
	low, high = limit / 1.02, limit / least
	assert not grows(low, *scene), '2 τ is above the limit'
	assert grows(high, *scene), f'2 τ is below {least} of the limit'
	while high > 1.02 * low:
		middle = math.sqrt(low * high)
		low, high = (low, middle) if grows(middle, *scene) else (middle, high)
	print(
		f'{name}, {"per area" if perArea else "per contact"}, dampers {damping}, shear {shear}: 2 τ over the measured limit {limit / low:.2f}'
	)
