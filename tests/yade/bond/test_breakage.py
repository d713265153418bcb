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
	mixed, members = O.bodies.appendClumped([polytope.cuboid((0, 5, 0), (0.6, 0.5, 0.5)), utils.sphere((1, 5, 0), 0.5)])
	clump = polytope.clump([polytope.cuboid((k, 9, 0), (0.5, 0.5, 0.5)) for k in range(2)])[0]
	count = len(O.bodies)
	for number, words in (
		(99, 'there is no body 99'),
		(sphere, 'no Polytope shape'),
		(members[0], 'member of clump'),
		(mixed, 'no Polytope shape'),
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
	with pytest.raises(ValueError, match=f'^point: the plane does not cut clump {clump} in two'):
		polytope.split(clump, (1, 0, 0), (1.6, 0, 0))
	assert len(O.bodies) == count and all(body is not None for body in O.bodies)


def testAClumpIsCutPartByPart():
	"""An L that flies and spins, across one of its cubes: a cube and a clump, with all that it had."""
	joint()
	clump, members = polytope.clump([polytope.cuboid((x, y, 0), (0.5, 0.5, 0.5)) for x, y in ((0, 0), (1, 0), (0, 1))])
	loop(True)
	state = O.bodies[clump].state
	state.vel, state.angVel = (3, -1, 2), (1, -2, 1)
	state.angMom = spinOf(state)
	O.dt = 1e-9
	O.step()  # parts move with it
	before, centre = sums([O.bodies[clump]], Vector3.Zero), Vector3.Zero
	below, above = polytope.split(clump, (1, 0, 0), (0.75, 0, 0))
	assert all(O.bodies[k] is None for k in (clump, *members))
	assert O.bodies[below].isClump and len(O.bodies[below].shape.members) == 3 and not O.bodies[above].isClump
	assert float(O.bodies[above].shape.volume) == pytest.approx(0.75)
	after = sums([O.bodies[below], O.bodies[above]], centre)
	assert after == pytest.approx(before, rel=1e-7, abs=1e-7 * np.abs(before).max())


def testAClumpMayFallApart():
	"""A U across its legs."""
	joint()
	clump, _ = polytope.clump([polytope.cuboid((x, y, 0), (0.5, 0.5, 0.5)) for x, y in ((0, 0), (1, 0), (2, 0), (0, 1), (2, 1))])
	below, above = polytope.split(clump, (0, 1, 0), (0, 0.75, 0))
	assert O.bodies[below].isClump and len(above) == 2
	assert [float(O.bodies[k].shape.volume) for k in above] == pytest.approx([0.75, 0.75])


@pytest.mark.parametrize('clumped', [False, True])
def testRockJointsGoOn(clumped):
	"""A block that holds on a slope by shear and cohesion, broken upright: the pieces bear what it bore, from the first step on."""
	joint(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.3, cohesion=1e5)
	loop(True, gravity=(5, 0, -8), normalDamping=0.3)
	floor = O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True))
	halves = [polytope.cuboid((x, 0, 0.5 - 2e-5), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5)]
	block = polytope.clump(halves)[0] if clumped else O.bodies.append(polytope.cuboid((0, 0, 0.5 - 2e-5), (1, 0.5, 0.5)))
	stepper()
	polytope.settle()
	weight = O.bodies[block].state.mass
	sheared = lambda: sum((contact.phys.shearForce for contact in O.bodies[floor].intrs() if contact.isReal), Vector3.Zero)
	pressed = lambda: sum((contact.phys.normalForce for contact in O.bodies[floor].intrs() if contact.isReal), Vector3.Zero)
	shear, press = Vector3(sheared()), Vector3(pressed())
	assert shear.norm() == pytest.approx(5 * weight, rel=1e-3)
	pieces = polytope.split(block, (1, 0, 0), (0.2, 0, 0))
	assert (sheared() - shear).norm() < 1e-6 * shear.norm() and (pressed() - press).norm() < 1e-3 * press.norm()
	contacts = [
		contact
		for k in pieces
		for part in (O.bodies[k].shape.members if O.bodies[k].isClump else [k])
		for contact in O.bodies[part].intrs()
		if contact.isReal
	]
	assert sum(contact.phys.contactArea for contact in contacts) == pytest.approx(2, rel=1e-4)
	assert all(contact.phys.intact for contact in contacts)
	places = [Vector3(O.bodies[k].state.pos) for k in pieces]
	polytope.settle()
	moved = [(O.bodies[k].state.pos - place).norm() for k, place in zip(pieces, places, strict=True)]
	assert max(moved) < 5e-4  # the narrow one leans on a quarter of a metre now, and holds


def testBondsGoOn():
	joint()
	ids = O.bodies.append([polytope.cuboid((k, 0, 0), (0.5, 0.5, 0.5)) for k in range(2)])
	loop(True)
	polytope.bond(ids, tensileStrength=1e6, cohesion=1e6)
	pieces = polytope.split(0, (0, 1, 0), (0, 0.2, 0))
	(engine,) = (engine for engine in O.engines if type(engine).__name__ == 'PolytopeBonds')
	held = {
		min(bond.id1, bond.id2) + max(bond.id1, bond.id2) - 1: bond.area
		for bond in engine.bonds
		if bond.intact and bond.id1 in (1, *pieces) and bond.id2 in (1, *pieces)
	}
	assert sorted(held.values()) == pytest.approx([0.3, 0.7]) and set(held) == set(pieces)
