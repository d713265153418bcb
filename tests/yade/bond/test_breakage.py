# SPDX-License-Identifier: GPL-2.0-or-later
"""A body broken along a plane: mass, momenta and energy are what they were; what is refused."""

import numpy as np
import pytest
from scenes import blockOnFloor, gravity, joint, loop, stepper
from yade import O, Quaternion, Vector3, polytope, utils


def grain(**body):
	"""A random grain far from the origin that flies and spins."""
	joint()
	made = polytope.randomGrain(0.3, seed=4, center=(100, -50, 20), orientation=Quaternion((1, 2, 3), 0.7), **body)
	made.state.vel, made.state.angVel = (3, -1, 2), (5, -7, 4)
	return made


def spinOf(state):
	"""Angular momentum about the centre."""
	inBody = state.ori.conjugate() * state.angVel
	return state.ori * Vector3(*(moment * rate for moment, rate in zip(state.inertia, inBody, strict=True)))


def sums(bodies, about):
	"""Mass, first moment, linear and angular momentum about a point, kinetic energy."""
	mass, first, linear, angular, energy = 0, Vector3.Zero, Vector3.Zero, Vector3.Zero, 0
	for state in (body.state for body in bodies):
		arm = state.pos - about
		mass += state.mass
		first += state.mass * arm
		linear += state.mass * state.vel
		angular += state.mass * arm.cross(state.vel) + spinOf(state)
		energy += (state.mass * state.vel.squaredNorm() + state.angVel.dot(spinOf(state))) / 2
	return np.array([mass, *first, *linear, *angular, energy], float)


@pytest.mark.parametrize('normal, shift', [((0, 0, 1), (0, 0, 0)), ((1, -2, 0.5), (0.02, 0.03, -0.01))])
def testMassMomentaAndEnergyAreKept(normal, shift):
	body = grain(material=-1, mask=5, color=(0.1, 0.2, 0.3))
	body.state.mass *= 2  # not the material's density
	body.state.inertia *= 2
	number = O.bodies.append(body)
	centre = Vector3(body.state.pos)
	before, volume = sums([body], centre), body.shape.volume
	pieces = [O.bodies[k] for k in polytope.split(number, normal, centre + Vector3(*shift))]
	assert O.bodies[number] is None
	after = sums(pieces, centre)
	scale = np.array([before[0], *[before[0] * 0.3] * 3, *[before[0] * 4] * 3, *[before[0] * 0.3] * 3, before[-1]], float)
	assert (np.abs(after - before) < 1e-12 * scale).all()
	assert sum(piece.shape.volume for piece in pieces) == pytest.approx(volume, rel=1e-12)
	for piece, side in zip(pieces, (1, -1), strict=True):
		corners = (piece.state.pos + piece.state.ori * corner - centre - Vector3(*shift) for corner in piece.shape.vertices)
		assert max(side * Vector3(*normal).dot(corner) for corner in corners) == pytest.approx(0, abs=1e-12)
		assert (piece.mask, tuple(piece.shape.color), piece.material.id) == (5, (0.1, 0.2, 0.3), body.material.id)
		assert (piece.state.angMom - spinOf(piece.state)).norm() < 1e-12 * spinOf(body.state).norm()


def testPiecesFlyApartAsTheyMoved():
	"""In free flight with spin the halves part, each with constant momentum: nothing pushes them."""
	number = O.bodies.append(grain())
	loop(True)
	O.dt = 1e-5
	pieces = [O.bodies[k] for k in polytope.split(number, (1, 0, 0))]
	speeds = [Vector3(piece.state.vel) for piece in pieces]
	O.run(300, wait=True)
	for piece, speed in zip(pieces, speeds, strict=True):
		assert (piece.state.vel - speed).norm() < 1e-6 * speed.norm()


def testOverlapsWithOthersAreTheSame():
	"""A block at rest on a floor is broken upright: same force on the floor, same stored energy, and it stays at rest."""
	joint(normalStiffness=1e8, shearStiffness=1e8)
	loop(True, gravity=(0, 0, -gravity), normalDamping=0.3)
	floor, block = blockOnFloor(overlap=1000 * gravity * 2.6 / 1e8)
	O.trackEnergy = True
	stepper()
	O.run(500, wait=True)
	force, stored = O.forces.f(floor.id)[2], O.energy['elastPotential']
	pieces = [O.bodies[k] for k in polytope.split(block.id, (1, 0.3, 0))]
	O.step()
	# but for the edges that each piece has at the cut now: the depth over its width
	assert O.forces.f(floor.id)[2] == pytest.approx(force, rel=5e-4) and O.energy['elastPotential'] == pytest.approx(stored, rel=5e-4)
	O.run(2000, wait=True)
	assert max(piece.state.vel.norm() for piece in pieces) < 1e-5


def testPolygonsAreBrokenAlongLines():
	joint()
	number = O.bodies.append(polytope.polygon([(0, 0), (2, 0), (2, 1), (0, 1)], thickness=0.5))
	one, two = (O.bodies[k] for k in polytope.split(number, (1, 0, 0), (0.5, 0, 0)))
	assert (one.shape.dimension, one.shape.volume, two.shape.volume) == (2, pytest.approx(0.25), pytest.approx(0.75))
	assert tuple(two.state.pos) == pytest.approx((1.25, 0.5, 0)) and one.state.blockedDOFs == two.state.blockedDOFs == 'zXY'


def testWhatIsRefused():
	joint()
	O.bodies.append([polytope.cuboid((k, 0, 0), (0.5, 0.5, 0.5)) for k in range(2)])
	sphere = O.bodies.append(utils.sphere((9, 0, 0), 1))
	clump, members = O.bodies.appendClumped([polytope.cuboid((k, 5, 0), (0.6, 0.5, 0.5)) for k in range(2)])
	count = len(O.bodies)
	for number, words in (
		(99, 'there is no body 99'),
		(sphere, 'no Polytope shape'),
		(members[0], 'member of clump'),
		(clump, 'no Polytope shape'),
	):
		with pytest.raises(ValueError, match=f'^id: .*{words}'):
			polytope.split(number, (1, 0, 0))
	for arguments, words in {
		((0, 0, 0),): 'normal: must not be zero',
		((1, 0),): 'normal: must be three numbers',
		((1, 0, 0), (0.6, 0, 0)): 'point: the plane does not cut body 0',
		((1, 0, 0), (0.4999, 0, 0)): 'point: the plane cuts off a piece',
		((1, 0, 0), (0, 0, 0), -1): 'smallest: must be a length',
	}.items():
		with pytest.raises(ValueError, match=f'^{words}'):
			polytope.split(0, *arguments)
	loop(True)
	polytope.bond()
	with pytest.raises(ValueError, match='^id: body 0 has bonds'):
		polytope.split(0, (1, 0, 0))
	assert len(O.bodies) == count and all(body is not None for body in O.bodies)
