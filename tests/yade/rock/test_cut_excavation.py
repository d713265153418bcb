# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.excavate where its region crosses blocks: what is left of them goes on with contact forces, bonds, materials and marks."""

import math

import numpy as np
import pytest
from rockScenes import stressedMass
from yade import (
	FrictMat,
	HyperbolicClosure,
	NewtonIntegrator,
	O,
	PolytopeBonds,
	RockJointMat,
	Vector3,
	plot,
	polytope,
)
from yade.polytope.measures.energy import storedEnergy
from yade.polytope.rock.pointHistories import histories
from yade.polytope.scene.relaxing import relaxing

gravity, density, kn, ks = 9.81, 2600, 1e9, 5e8


def material(**joint):
	return O.materials.append(
		RockJointMat(**{'density': density, 'normalStiffness': kn, 'shearStiffness': ks, 'frictionAngle': math.radians(35), **joint})
	)


def undamped(**engines):
	O.engines = polytope.engines(damping=0, **engines)
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0


def boxOf(low, high):
	return dict(normals=[*np.eye(3), *-np.eye(3)], offsets=[*high, *(-x for x in low)])


def slot(half=0.05):
	return dict(normals=[(1, 0, 0), (-1, 0, 0)], offsets=[half, half])


def contactOf(k):
	(contact,) = [contact for contact in O.bodies[k].intrs() if contact.isReal]
	return contact


def onFloor(half=(0.5, 0.5, 1), flat=False, **joint):
	"""A block on a fixed floor, pressed into it by its weight: bodies 0 and 1. Returns the weight."""
	material(**joint)
	x, y, z = half
	if flat:
		O.bodies.append(polytope.polygon([(-3, -1), (3, -1), (3, 0), (-3, 0)], fixed=True))
		O.bodies.append(polytope.polygon([(-x, 0), (x, 0), (x, 2 * z), (-x, 2 * z)]))
	else:
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, z), half))
	weight = O.bodies[1].state.mass * gravity
	area = 2 * x if flat else 4 * x * y
	depth = weight / (kn * area)
	O.bodies[1].state.pos -= (0, depth, 0) if flat else (0, 0, depth)
	return weight


def above(height, flat):
	return dict(normals=[(0, -1) if flat else (0, 0, -1)], offsets=[-height])


@pytest.mark.parametrize('flat', [False, True])
def testWhatIsLeftOfAColumnWeighsOnTheFloorAsMuchAsItIs(flat):
	"""The column's upper half is cut off gradually: the floor bears all of the weight first, half of it at last, and never more or less."""
	weight = onFloor(flat=flat)
	undamped()
	O.step()
	(left,) = polytope.excavate(**above(1, flat), over=1000)[1]
	assert O.bodies[1] is None and O.bodies[left].state.mass * gravity == pytest.approx(weight / 2, rel=1e-4)
	contact = contactOf(left)
	assert contact.phys.normalForce.norm() == pytest.approx(weight, rel=1e-4)
	forces = []
	for _ in range(1300):
		O.step()
		forces.append(float(contact.phys.normalForce.norm()))
	assert 1000 * O.dt > 5 * 2 * math.pi * math.sqrt(weight / 2 / gravity / kn)
	assert weight / 2 * 0.99 < min(forces) and max(forces) < weight * 1.0001
	assert forces[-1] == pytest.approx(weight / 2, rel=0.01) and not relaxing()


@pytest.mark.parametrize('flat', [False, True])
def testCutOffAtOnceItSwings(flat):
	"""A quarter is cut off: the floor bears from all of the weight to half of it, about the three quarters; the energy stays that which it had."""
	weight = onFloor(flat=flat)
	undamped()
	O.engines[-1].dead = True
	O.dt = 2e-5  # the energy swings by the square of this
	O.trackEnergy = True
	O.step()
	stored = O.energy['elastPotential']
	assert stored == pytest.approx(weight**2 / 2 / kn, rel=1e-4)
	(left,) = polytope.excavate(**above(1.5, flat))[1]
	contact, forces, totals = contactOf(left), [], []
	for _ in range(1000):
		O.step()
		forces.append(float(contact.phys.normalForce.norm()))
		totals.append(O.energy.total())
		if len(totals) == 1:
			assert O.energy['elastPotential'] == pytest.approx(stored, rel=1e-4)
	assert max(forces) == pytest.approx(weight, rel=0.01) and min(forces) == pytest.approx(weight / 2, rel=0.01)
	assert np.ptp(totals) < 1e-3 * stored


@pytest.mark.parametrize('flat', [False, True])
def testABlockThatShearHoldsOnASlopeIsCutAcrossIt(flat):
	"""Parts have the pressures and the shear of the whole where they are; both stay, and each bears its own weight."""
	angle, half = math.radians(25), (1, 0.5, 0.25)
	weight = onFloor(half, flat)
	down, into = gravity * math.sin(angle), gravity * math.cos(angle)
	O.engines = polytope.engines(gravity=(down, -into, 0) if flat else (down, 0, -into))
	polytope.settle()
	whole = contactOf(1).phys
	normal, shear = (float(force.norm()) for force in (whole.normalForce, whole.shearForce))
	assert shear == pytest.approx(weight * math.sin(angle), rel=1e-3)
	places = sorted(polytope.excavate(**slot(), over=2000)[1], key=lambda k: O.bodies[k].state.pos[0])
	up, low = (contactOf(k).phys for k in places)
	for part in up, low:
		assert part.shearForce.norm() == pytest.approx(0.475 * shear, rel=2e-5)
	assert up.normalForce.norm() + low.normalForce.norm() == pytest.approx(0.95 * normal, rel=1e-4)
	slope = (
		weight * math.sin(angle) * half[2] / ((1 if flat else 2 * half[1]) * 2**3 / 12)
	)  # of the pressure that balances the moment of the shear
	apart = slope * (1 - 0.05**2) * (1 if flat else 2 * half[1])
	assert low.normalForce.norm() - up.normalForce.norm() == pytest.approx(apart, rel=2e-3)
	before = [Vector3(O.bodies[k].state.pos) for k in places]
	polytope.settle()
	assert not relaxing()
	for k, place, part in zip(places, before, (up, low), strict=True):
		assert part.shearForce.norm() == pytest.approx(0.475 * weight * math.sin(angle), rel=2e-3)
		assert part.normalForce.norm() == pytest.approx(0.475 * weight * math.cos(angle), rel=2e-3)
		assert (O.bodies[k].state.pos - place).norm() < 2 * weight / kn


def testShearAndTwistAreThoseOfTheBedAtThePlaceOfEachPart():
	"""Displacement e + w n × r of the springs over each part; both have the moment of the whole less that of the slot."""
	onFloor((1, 0.5, 0.25))
	undamped()
	O.step()
	whole = contactOf(1).phys
	force, moment = Vector3(300, 200, 0), 400
	whole.shearForce, whole.twistingMoment = force, moment
	e, w = np.array(force, float) / whole.ks, moment / whole.twistingStiffness
	places = polytope.excavate(**slot())[1]
	total, about = np.zeros(3), 0.0
	for k in places:
		part, x = contactOf(k).phys, math.copysign(0.525, O.bodies[k].state.pos[0])
		wanted = ks * 0.95 * (e + w * np.array([0, x, 0]))
		assert np.array(part.shearForce, float) == pytest.approx(wanted, abs=1e-6 * force.norm())
		assert part.twistingMoment == pytest.approx(ks * 0.95 * w * (0.95**2 + 1) / 12, rel=1e-6)
		assert np.array(part.shearPoint, float)[:2] == pytest.approx((x, 0), abs=1e-6)
		total += np.array(part.shearForce, float)
		about += part.twistingMoment + x * part.shearForce[1]
	assert total == pytest.approx(0.95 * np.array(force, float), rel=1e-6)
	assert about == pytest.approx(moment * (1 - 0.05 * (0.1**2 + 1) / (2**2 + 1)), rel=1e-6)


def hanging(flat, bonded):
	"""A block of 2 m by 1 m hangs from a fixed one; bodies 0 and 1."""
	strength = {} if bonded else dict(cohesion=1e6, tensileStrength=1e6)
	material(**strength)
	if flat:
		O.bodies.append(polytope.polygon([(-1, 0), (1, 0), (1, 1), (-1, 1)], fixed=True))
		O.bodies.append(polytope.polygon([(-1, -1), (1, -1), (1, 0), (-1, 0)]))
	else:
		O.bodies.append(polytope.cuboid((0, 0, 0.5), (1, 0.5, 0.5), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (1, 0.5, 0.5)))
	O.engines = polytope.engines(gravity=(60, -gravity, 0) if flat else (60, 8, -gravity))
	O.bodies[1].state.pos += (0, 1e-6, 0) if flat else (0, 0, 1e-6)
	if bonded:
		polytope.bond(tensileStrength=1e6, cohesion=1e6)
	polytope.settle()


def bondsNow(bonded):
	if bonded:
		engine = next(engine for engine in O.engines if isinstance(engine, PolytopeBonds))
		return {max(bond.id1, bond.id2): bond for bond in engine.bonds if O.bodies[max(bond.id1, bond.id2)] is not None}
	return {max(contact.id1, contact.id2): contact.phys.bond for contact in O.interactions if contact.isReal}


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('bonded', [False, True])
def testBondsAreSharedByTheirArea(flat, bonded):
	"""The bond has tension, shear, bending and twist at once: stresses are linear over the area, so those of the parts are known from the whole."""
	hanging(flat, bonded)
	whole = bondsNow(bonded)[1]
	area, moments, point, stored = whole.area, whole.secondMoments, Vector3(whole.point), whole.energy
	force, moment = Vector3(whole.force), Vector3(whole.moment)
	assert 1e5 < whole.edgeStress < 1e6 and whole.intact
	left = polytope.excavate(**slot(), over=1000)[1]
	parts = bondsNow(bonded)
	assert set(parts) == set(left) and len(left) == 2
	assert all(part.intact for part in parts.values())
	assert sum(part.area for part in parts.values()) == pytest.approx(0.95 * area, rel=1e-6)
	total = sum((part.force for part in parts.values()), Vector3.Zero)
	assert (total - 0.95 * force).norm() < 1e-3 * force.norm()
	about = sum((part.moment + (part.point - point).cross(part.force) for part in parts.values()), Vector3.Zero)
	lost = 0.05**3  # of the second moment along x
	inPlane, out = (moments[0], moments[1]) if moments[0] > moments[1] else (moments[1], moments[0])
	assert inPlane == pytest.approx(2**3 / 12, rel=1e-3)
	for axis, kept in (
		((2, 1 - lost), (1, 1 - lost)) if flat else ((1, 1 - lost), (0, 0.95), (2, ((1 - lost) * inPlane + 0.95 * out) / (inPlane + out)))
	):
		assert about[axis] == pytest.approx(kept * moment[axis], rel=2e-3, abs=1e-3 * moment.norm())
	assert sum(part.energy for part in parts.values()) == pytest.approx(stored, rel=0.06) and stored > 0
	O.step()
	assert all(O.bodies[k].state.vel.norm() < 1e-6 for k in left)
	assert set(bondsNow(bonded)) == set(left)


def hangsBetweenWalls(strength, flat):
	"""A block 2 m high and 1 m wide between fixed walls that press it, on a fixed base that bears it. Joints of its upper half can bear
	this multiple of the half's weight."""
	weight, pressure, friction = density * gravity, 2e4, math.radians(20)
	material(frictionAngle=friction, cohesion=strength * weight / 2 - pressure * math.tan(friction))
	if flat:
		for x in (-1.5, 0.5):
			O.bodies.append(polytope.polygon([(x, 0), (x + 1, 0), (x + 1, 2), (x, 2)], fixed=True))
		O.bodies.append(polytope.polygon([(-0.5, -1), (0.5, -1), (0.5, 0), (-0.5, 0)], fixed=True))
		O.bodies.append(polytope.polygon([(-0.5, 0), (0.5, 0), (0.5, 2), (-0.5, 2)]))
	else:
		for x in (-1, 1):
			O.bodies.append(polytope.cuboid((x, 0, 1), (0.5, 1, 1), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (0.5, 1, 0.5), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, 1), (0.5, 0.5, 1)))
	undamped(gravity=(0, -gravity, 0) if flat else (0, 0, -gravity))
	up = 1 if flat else 2
	stress, slope = np.zeros((3, 3)), np.zeros((3, 3, 3))
	stress[0, 0], stress[up, up], slope[up, up, up] = -pressure, -2 * weight, weight
	assert polytope.inSitu(stress, slope) == 3
	return weight, dict(normals=[np.eye(3)[up]], offsets=[1]), up


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('over, stands', [(0, False), (3000, True)])
def testWhatHangsBetweenWallsStandsWhereItsLowerHalfIsCutOffGradually(over, stands, flat):
	"""A tunnel's roof in one block: W/2 on either side, twice that if at once, by joints that bear 1.3 times W/2."""
	weight, region, up = hangsBetweenWalls(1.3, flat)
	(left,) = polytope.excavate(**region, over=over)[3]
	place, peak = Vector3(O.bodies[left].state.pos), 0.0
	for _ in range(5000):
		O.step()
		if O.interactions.has(0, left, True):
			peak = max(peak, float(O.interactions[0, left].phys.shearForce.norm()))
	moved = O.bodies[left].state.pos - place
	if stands:
		assert O.interactions[0, left].phys.shearForce.norm() == pytest.approx(weight / 2, rel=0.01) and peak < 1.01 * weight / 2
		assert O.interactions[0, left].phys.intact and moved.norm() < 1e-4
	else:
		assert moved[up] < -0.01


def massUnderStress(**strength):
	material(normalStiffness=1e11, shearStiffness=5e10, **strength)
	return stressedMass()


def oblique(half=1.2):
	"""A convex region in its middle that no joint is parallel to."""
	normals = np.array([(1, 0.2, 0), (-1, 0.1, 0), (0, 1, 0.1), (0, -1, 0.1), (0.1, 0, 1), (0, 0.1, -1)])
	normals /= np.linalg.norm(normals, axis=1)[:, None]
	return dict(normals=normals, offsets=normals @ (2.5, 2.5, 2.5) + half)


def flatMass():
	"""Rhombs in the plane under stress, those at the boundary fixed."""
	material(normalStiffness=1e11, shearStiffness=5e10)
	along, across = np.array([1, 0.2]), np.array([0.3, 1])
	for i in range(7):
		for j in range(7):
			at = i * along + j * across
			corners = [at, at + along, at + along + across, at + across]
			O.bodies.append(polytope.polygon([tuple(map(float, x)) for x in corners], fixed=i in (0, 6) or j in (0, 6)))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(-1e6 * np.array([[4, 1, 0], [1, 6, 0], [0, 0, 1]]))


def flatRegion():
	middle = 3.5 * np.array([1.3, 1.2])
	normals = np.array([(1, 0.4, 0), (-1, 0.1, 0), (0.2, 1, 0), (0.1, -1, 0)])
	normals /= np.linalg.norm(normals, axis=1)[:, None]
	return dict(normals=normals, offsets=normals[:, :2] @ middle + 0.9)


def forcesNow():
	"""Force and torque on each body or clump that can move."""
	O.step()
	found = {}
	for body in O.bodies:
		if body.dynamic and not body.isClumpMember:
			parts = [body, *(O.bodies[k] for k in (body.shape.members if body.isClump else ()))]
			force = sum((O.forces.f(part.id) for part in parts), Vector3.Zero)
			torque = sum(
				(O.forces.t(part.id) + (part.state.pos - body.state.pos).cross(O.forces.f(part.id)) for part in parts), Vector3.Zero
			)
			found[body.id] = force, torque
	return found


@pytest.mark.parametrize(
	'scene, region',
	[(massUnderStress, oblique), (lambda: massUnderStress(cohesion=1e6, tensileStrength=1e6), oblique), (flatMass, flatRegion)],
)
def testAStressedMassIsAtRestWhereItIsCutAndAllIsHeld(scene, region):
	"""No force or torque on any body jumps by 1e-5 of what neighbours are pressed with, and no block moves by 1e-3 of a joint's closure."""
	scene()
	before = forcesNow()
	pressed = max(float(contact.phys.normalForce.norm()) for contact in O.interactions if contact.isReal)
	volume = sum(float(body.shape.volume) for body in O.bodies)
	gone = polytope.excavate(**region(), over=10**7)
	left = [k for several in gone.values() for k in several]
	assert len(left) > 5
	places = {body.id: Vector3(body.state.pos) for body in O.bodies}
	after = forcesNow()
	for k, (force, torque) in after.items():
		known = before.get(k, (Vector3.Zero, Vector3.Zero))
		assert (force - known[0]).norm() < 1e-5 * pressed and (torque - known[1]).norm() < 1e-5 * pressed
	O.run(300, wait=True)
	assert max(float((body.state.pos - places[body.id]).norm()) for body in O.bodies) < 1e-3 * 6e6 / 1e11
	assert volume > sum(float(body.shape.volume) for body in O.bodies if not body.isClump)


def cube(size=2, place=(10, 0, 0), flat=False):
	material()
	half = size / 2
	square = [(-half, -half), (half, -half), (half, half), (-half, half)]
	body = polytope.polygon(square) if flat else polytope.cuboid(place, (half, half, half))
	return O.bodies.append(body)


def volumes(ids):
	return sorted(
		sum(float(O.bodies[part].shape.volume) for part in (O.bodies[k].shape.members if O.bodies[k].isClump else [k])) for k in ids
	)


@pytest.mark.parametrize(
	'low, high, left',
	[
		((-9, -9, 0.4), (19, 9, 9), [5.6]),  # a half
		((10.5, -9, 0.5), (19, 9, 9), [8 - 0.5]),  # an edge: one body that is not convex
		((9.5, -9, 0.5), (10.5, 9, 9), [8 - 1]),  # a notch
		((9.5, -9, -9), (10.5, 9, 9), [2, 2]),  # right through: two bodies
		((9.5, -9, -0.5), (10.5, 9, 0.5), [8 - 2]),  # a tunnel through it: a ring
		((9.5, -0.5, -0.5), (10.5, 0.5, 0.5), [8 - 1]),  # a hole in it
		((9.5, -0.5, 0.995), (10.5, 0.5, 9), None),  # a sliver
		((9.005, -9, -9), (19, 9, 9), []),  # all but a sliver
	],
)
def testWhatIsLeftOfACube(low, high, left):
	k = cube()
	if left is None:
		with pytest.raises(ValueError, match=r'^normals: no body that can move is cut by the region'):
			polytope.excavate(**boxOf(low, high))
		return
	made = polytope.excavate(**boxOf(low, high))
	assert list(made) == [k] and volumes(made[k]) == pytest.approx(sorted(left), rel=1e-12)
	if len(left) == 1:
		rest, taken = O.bodies[made[k][0]].state, np.minimum(high, (11, 1, 1)) - np.maximum(low, (9, -1, -1))
		middle = (np.minimum(high, (11, 1, 1)) + np.maximum(low, (9, -1, -1))) / 2
		centre = (8 * np.array((10, 0, 0)) - taken.prod() * middle) / left[0]
		assert rest.mass == pytest.approx(density * left[0], rel=1e-12)
		assert np.array(rest.pos, float) == pytest.approx(centre, abs=1e-12)


def testANotchedPolygonTurnsAsOne():
	"""Mass, centre and moment of inertia of a square less a notch; it goes on turning about the centre that it had."""
	k = cube(flat=True)
	state = O.bodies[k].state
	state.angVel, state.angMom = (0, 0, 1), (0, 0, state.inertia[2])
	state.refPos = (-0.3, -0.1, 0)
	O.engines = polytope.engines(gravity=(0, 0, 0))
	(left,) = polytope.excavate(normals=[(1, 0, 0), (-1, 0, 0), (0, -1, 0)], offsets=[0.5, 0.5, -0.2])[k]
	rest, notch = O.bodies[left].state, 0.8
	away = notch * 0.6 / (4 - notch)
	inertia = density * (4 * 4 / 6 - notch * ((1 + 0.8**2) / 12 + 0.6**2) - (4 - notch) * away**2)
	assert O.bodies[left].isClump and rest.mass == pytest.approx(density * (4 - notch), rel=1e-12)
	assert np.array(rest.pos - rest.refPos, float) == pytest.approx((0.3, 0.1, 0), abs=1e-12)
	assert rest.pos[1] == pytest.approx(-away, rel=1e-12) and rest.inertia[2] == pytest.approx(inertia, rel=1e-12)
	assert rest.vel[0] == pytest.approx(away, rel=1e-12) and rest.angVel[2] == 1


def testARegionOfSeveralPartsIsTheirUnion():
	"""Two that cross; a block of a clump that is cut in two by them, the other one stays with its side."""
	material()
	parts = [polytope.cuboid((x, 0, 0), (1, 1, 1)) for x in (0, 2)]
	k = polytope.clump(parts)[0]
	cross = dict(normals=[[(1, 0, 0), (-1, 0, 0)], [(0, 0, 1), (0, 0, -1), (1, 0, 0)]], offsets=[[-0.2, 0.6], [0.2, 0.2, 0]])
	made = polytope.excavate(**cross)[k]
	assert volumes(made) == pytest.approx([0.4 * 0.8 * 2] * 2 + [4 * 1.2 + 8 - 2 * 0.2 * 0.4], rel=1e-12)
	largest = max(made, key=lambda one: O.bodies[one].state.mass)
	assert O.bodies[largest].isClump and O.bodies[largest].state.mass == pytest.approx(density * max(volumes(made)), rel=1e-12)


def testFacesKeepMaterialJointAndWater():
	own = material()
	smooth = material(frictionAngle=math.radians(20))
	joints = [polytope.Joint(radians, 0, (2, 2, 2), set=number) for number, radians in enumerate((0.0, math.pi / 2))]
	rock = polytope.jointedRock([*np.eye(3), *-np.eye(3)], [4, 4, 4, 0, 0, 0], [[one] for one in joints])
	ids = rock.append(jointMaterials=[smooth, None], material=own)
	O.engines = polytope.engines()
	water = polytope.water(level=3, faces=lambda face: abs(face.normal[2]) > 0.9 and abs(face.centre[2] - 2) < 0.1)
	uplift = {k: float(water.load(k)[0][2]) for k in ids}
	polytope.history({'kept': (0.5, 0.5, 0.5), 'taken': (1.5, 1.5, 1.9)}, every=1)
	before = rock.setsOfFaces(O.bodies[ids[0]]).tolist()
	middle = (2, 2, 2)
	made = polytope.excavate(**boxOf(np.subtract(middle, 1), np.add(middle, 1)))
	assert set(made) == set(ids) and all(len(several) == 1 for several in made.values())
	for k, (left,) in made.items():
		parts = [O.bodies[part] for part in O.bodies[left].shape.members]
		for part in parts:
			sets = rock.setsOfFaces(part)
			normals = [part.state.ori * normal for normal in part.shape.normals]
			assert [smooth if one == 0 else -1 for one in sets] == list(part.shape.faceMaterials)
			for one, normal, offset in zip(sets, normals, part.shape.offsets, strict=True):
				at = abs(normal.dot(part.state.pos) + offset)
				assert (one == 0) == (abs(normal[2]) > 0.9 and abs(at - 2) < 1e-6) and (one == 1) == (
					abs(normal[1]) > 0.9 and abs(at - 2) < 1e-6
				)
		# the face of 2 m by 2 m less the 1 m by 1 m, on which the pressure is that of 1 m
		assert float(water.load(left)[0][2]) == pytest.approx(0.75 * uplift[k], rel=1e-9)
	assert sorted(before) == [-1, -1, -1, -1, 0, 1]
	for (left,) in made.values():
		O.bodies[left].state.pos += (0, 0, 0.25)
	O.engines = histories()
	O.run(2, wait=True)
	assert plot.data['kept_z'] == pytest.approx([0, 0.25], abs=1e-12) and math.isnan(plot.data['taken_z'][-1])


def refused(name, **arguments):
	"""Nothing of the scene has changed."""

	def state():
		bodies = [(body.id, type(body.shape).__name__, Vector3(body.state.pos), len(body.intrs())) for body in O.bodies]
		return (
			bodies,
			[type(engine).__name__ for engine in O.engines],
			len(O.materials),
			sorted((one.id1, one.id2) for one in O.interactions),
		)

	before = state()
	with pytest.raises(ValueError, match=f'^{name}'):
		polytope.excavate(**arguments)
	assert state() == before


def testWhatCannotBeCutIsRefused():
	onFloor()
	O.engines = polytope.engines()
	half = above(1, False)
	refused('cut: must be True or False', **half, cut='no')
	refused('offsets: must be one for each of the 1 normals', normals=half['normals'], offsets=[1, 2])
	refused('offsets: must be a sequence for each of the 2 parts', normals=[[(1, 0, 0)], [(0, 1, 0)]], offsets=[1, 2])
	refused('normals: normals and offsets must be finite', normals=[[(1, 0, 0)], [(0, 0, 0)]], offsets=[[1], [1]])
	refused('normals: every row must have 3 components', normals=[(1, 0)], offsets=[1])
	refused('normals: no body that can move is cut by the region or lies in it', **above(5, False))
	refused('over: no contact bears a force yet', **half, over=10)
	O.forces.setPermF(1, (1, 0, 0))
	refused('cut: block 1 has a permanent force', **half)
	O.forces.setPermF(1, (0, 0, 0))
	bolt = polytope.bolt(head=(0, 0, 2), end=(0, 0, -0.5), area=1e-3, youngsModulus=2e11)
	refused('cut: a bolt holds block 1', **half)
	assert bolt.crossings and polytope.excavate([1]) == {1: []}


@pytest.mark.parametrize('joint, seen', [(dict(stiffnessPerArea=False), 'has a stiffness per contact'), (None, 'is a FrictPhys')])
def testContactsThatCannotBeSharedAreRefused(joint, seen):
	if joint is None:
		O.materials.append(FrictMat(density=density, young=1e8, poisson=0.3))
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True))
		O.bodies.append(polytope.cuboid((0, 0, 1 - 1e-5), (0.5, 0.5, 1)))
	else:
		onFloor(**joint)
	O.engines = polytope.engines()
	O.step()
	refused(f'cut: the contact of block 1 between 0 and 1 {seen}', **above(1, False))


def testAPolygonIsCutByTheSectionOfTheRegionWithItsPlane():
	k = cube(flat=True)
	refused('normals: no body that can move', **boxOf((0, -9, 1), (9, 9, 2)))
	made = polytope.excavate(normals=[(-3, 0, 4), (0, 0, 1)], offsets=[-1.5, 1])[k]
	assert volumes(made) == pytest.approx([3], rel=1e-12)


def testAJointGoesOnWithWhatItHasBeenThrough():
	"""Failed, slipped, dilated, with a friction that a script has set: its parts are as it was, and no fresh joints of the material."""
	onFloor((1, 0.5, 0.25), cohesion=2e3, dilationAngle=math.radians(5), dilationLimit=1e-5)
	O.engines = polytope.engines(gravity=(gravity, 0, -gravity))
	for _ in range(2000):
		O.step()
		if O.interactions.has(0, 1, True) and O.interactions[0, 1].phys.slip.norm() > 2e-4:
			break
	whole = contactOf(1).phys
	assert not whole.intact and whole.isSliding and whole.dilation == pytest.approx(1e-5, rel=1e-3)
	whole.tangensOfFrictionAngle = 0.25
	slip = Vector3(whole.slip)
	left = polytope.excavate(**slot())[1]
	assert len(left) == 2
	for k in left:
		part = contactOf(k).phys
		assert not part.intact and part.tangensOfFrictionAngle == 0.25
		assert (part.slip - slip).norm() < 1e-9 and part.dilation == whole.dilation
		assert part.cohesion == 2e3
	assert sum(contactOf(k).phys.contactArea for k in left) == pytest.approx(0.95 * whole.contactArea, rel=1e-6)
	O.step()
	assert not contactOf(left[0]).phys.intact


def testAJointThatStiffensAsItClosesBearsThePartsWeight():
	weight = onFloor(closure=HyperbolicClosure(maximumClosure=1e-4))
	O.engines = polytope.engines()
	polytope.settle()
	(left,) = polytope.excavate(**above(1, False), over=1000)[1]
	part = contactOf(left).phys
	assert part.normalForce.norm() == pytest.approx(weight, rel=1e-3)
	O.step()
	assert part.normalForce.norm() == pytest.approx(weight, rel=1e-3)
	polytope.settle()
	assert part.normalForce.norm() == pytest.approx(weight / 2, rel=1e-3)


def testAJointThatStiffensAsItClosesKeepsItsEnergy():
	"""Half of what the joint can close by is closed. The part is on the whole face: its joint has the energy of the whole's, at once and in
	the next step, and no energy comes or goes then: hyperbola's ∫ σ dδ = −k A δₘ² (δ/δₘ + ln(1 − δ/δₘ))."""
	most = 1e-4
	onFloor(closure=HyperbolicClosure(maximumClosure=most))
	O.bodies[1].state.pos = (0, 0, 1 - most / 2)
	O.bodies[1].state.vel = Vector3.Zero
	undamped()
	O.engines[-1].dead = True
	O.dt = 1e-8  # nothing moves
	O.trackEnergy = True
	O.step()
	stored, total = float(O.energy['elastPotential']), float(O.energy.total())
	assert stored == pytest.approx(-kn * most**2 * (0.5 + math.log(0.5)), rel=1e-3)
	(left,) = polytope.excavate(**above(1, False))[1]
	assert sum(storedEnergy(contactOf(left))) == pytest.approx(stored, rel=1e-3)
	assert contactOf(left).phys.kn == pytest.approx(kn / 0.5**2, rel=1e-3)
	O.step()
	assert O.energy['elastPotential'] == pytest.approx(stored, rel=1e-3)
	assert abs(float(O.energy.total()) - total) < 1e-3 * stored


def testAClumpOnAFloorIsCutAsOneBody():
	"""Two flush halves and a wing; the upper half of all is cut off."""
	material()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True))
	clump = polytope.clump(
		[polytope.cuboid((x, 0, 0.5 - 1e-6), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5)]
		+ [polytope.cuboid((0, 0.75, 0.5 - 1e-6), (0.3, 0.25, 0.5))]
	)[0]
	undamped(gravity=(0, 0, -gravity))
	polytope.settle()
	weight = O.bodies[clump].state.mass * gravity

	def pressed():
		return sum(float(contact.phys.normalForce[2]) for contact in O.bodies[0].intrs() if contact.isReal)

	assert pressed() == pytest.approx(weight, rel=1e-3)
	(left,) = polytope.excavate(**above(0.5, False), over=2000)[clump]
	assert O.bodies[left].isClump and O.bodies[left].state.mass * gravity == pytest.approx(weight / 2, rel=1e-4)
	O.step()
	assert pressed() == pytest.approx(weight, rel=1e-3)
	polytope.settle()
	assert pressed() == pytest.approx(weight / 2, rel=1e-3)


def testACutGoesOnAfterSavingAndLoading(tmp_path):
	onFloor((1, 0.5, 0.25), cohesion=1e6, tensileStrength=1e6)
	O.engines = polytope.engines(gravity=(3, 1, -gravity))
	polytope.settle()
	left = polytope.excavate(**slot(), over=400)[1]
	for _ in range(100):
		O.step()
	O.save(str(tmp_path / 'cut.yade'))
	places = []
	for load in (False, True):
		if load:
			O.load(str(tmp_path / 'cut.yade'))
		for _ in range(500):
			O.step()
		places.append([tuple(map(float, O.bodies[k].state.pos)) for k in left])
		assert not relaxing() and all(contactOf(k).phys.bond.intact for k in left)
	assert np.array(places[0]) == pytest.approx(np.array(places[1]), abs=1e-12)


def facePressed(k):
	"""Area of a body's contacts across the slab, to one side."""
	parts = O.bodies[k].shape.members if O.bodies[k].isClump else [k]
	contacts = [contact for part in parts for contact in O.bodies[part].intrs() if contact.isReal]
	return sum(float(contact.phys.contactArea) for contact in contacts if abs(contact.geom.normal[1]) > 0.9) / 2


def testAnArchThroughASlabBetweenPlates():
	"""These press on clumps with corners that point inwards, in wedges: nothing jumps there, either, and the parts of a face have its area."""
	material(normalStiffness=2e10, shearStiffness=1e10)
	size, thick = 8, 0.75
	joints = [polytope.JointSet(math.radians(60), math.radians(90), 2.3), polytope.JointSet(math.radians(25), math.radians(270), 2.1)]
	polytope.jointedRock([*np.eye(3), *-np.eye(3)], [size, thick, size] * 2, joints, seed=2).append()
	for axis, half in enumerate(((1, thick, size), (size + 2, 1, size), (size + 2, thick + 2, 1))):
		for side in (-1, 1):
			O.bodies.append(polytope.cuboid(side * np.eye(3)[axis] * ((thick if axis == 1 else size) + 1), half, fixed=True))
	O.engines = polytope.engines(gravity=(0, 0, -gravity))
	k = density * gravity * np.diag((0.6, 0.6, 1))
	polytope.inSitu(-100 * k, gradient=[0 * k, 0 * k, k])
	before = forcesNow()
	pressed = max(float(contact.phys.normalForce.norm()) for contact in O.interactions if contact.isReal)
	arch = [(math.cos(a), 0, math.sin(a)) for a in np.linspace(0, math.pi, 13)]
	faces = {k: facePressed(k) for k in range(len(O.bodies)) if O.bodies[k].dynamic}
	gone = polytope.excavate(normals=[*arch, (0, 0, -1)], offsets=[2.5] * 13 + [2], over=10**7)
	assert sum(O.bodies[k].isClump for left in gone.values() for k in left) > 3
	for k, left in gone.items():
		volumes = sum(float(O.bodies[part].state.mass) for part in left) / density
		assert (
			sum(facePressed(part) for part in left) == pytest.approx(volumes / (2 * thick), rel=1e-4)
			and volumes / (2 * thick) < faces[k] * 1.0001
		)
	places = {body.id: Vector3(body.state.pos) for body in O.bodies}
	for k, (force, torque) in forcesNow().items():
		known = before.get(k, (Vector3(0, 0, O.bodies[k].state.mass * gravity), Vector3.Zero))
		assert (force - known[0]).norm() < 1e-5 * pressed and (torque - known[1]).norm() < 1e-5 * pressed
	O.run(100, wait=True)
	assert max(float((body.state.pos - places[body.id]).norm()) for body in O.bodies) < 1e-3 * 2.5e6 / 2e10


half, remaining, sideways, overburden = math.radians(25), 2.0, 5e4, 3e4
"""A roof prism: angle of its joints with the vertical, height of what the cut leaves [m], horizontal and vertical stress [Pa]."""


def roofPrism(flat, friction):
	"""Two joints that meet 5 m above a floor make a prism in fixed rock, under a stress; its lower 3 m are cut out, and then it gets its
	weight. Returns what is left, the vertical axis, and of the closed form a joint's length L, the settlement and the mean normal and shear
	stress of the joints, by the springs of both: u = (V b + W) / (2 L (kₙ sin²α + kₛ cos²α)), V the vertical stress, b the width at the
	cut, W the weight."""
	stiff, soft = 2e9, 1e9
	material(normalStiffness=stiff, shearStiffness=soft, frictionAngle=friction)
	up = 1 if flat else 2
	place = lambda x, height: (x, height, 0) if flat else (x, 0, height)
	joints = [polytope.Joint(math.pi / 2 - half, math.radians(direction), place(0, 5)) for direction in (90, 270)]
	if flat:
		rock = polytope.jointedRock([(1, 0), (-1, 0), (0, 1), (0, -1)], [4, 4, 7, 0], joints)
		floor = polytope.polygon([(-4, -1), (4, -1), (4, 0), (-4, 0)], fixed=True)
	else:
		rock = polytope.jointedRock([*np.eye(3), *-np.eye(3)], [4, 0.5, 7, 4, 0.5, 0], joints)
		floor = polytope.cuboid((0, 0, -0.5), (4, 0.5, 0.5), fixed=True)
	ids = rock.append()
	O.bodies.append(floor)
	(prism,) = [k for k in ids if abs(O.bodies[k].state.pos[0]) < 1e-9 and O.bodies[k].state.pos[up] < 5]
	for k in ids:
		O.bodies[k].dynamic = k == prism
	O.engines = polytope.engines(gravity=(0, 0, 0))
	stress = np.zeros((3, 3))
	stress[0, 0], stress[up, up] = -sideways, -overburden
	polytope.inSitu(stress)
	(left,) = polytope.excavate(normals=[place(0, 1)], offsets=[5 - remaining], over=2000)[prism]
	weight, width = density * gravity * remaining**2 * math.tan(half), 2 * remaining * math.tan(half)
	length, sine, cosine = remaining / math.cos(half), math.sin(half), math.cos(half)
	sunk = (overburden * width + weight) / (2 * length * (stiff * sine**2 + soft * cosine**2))
	pressed = sideways * cosine**2 + overburden * sine**2 - stiff * sunk * sine
	sheared = soft * sunk * cosine - (overburden - sideways) * sine * cosine
	assert 2 * length * (sheared * cosine - pressed * sine) == pytest.approx(weight)  # the closed form is in equilibrium
	return left, up, length, sunk, pressed, sheared


def loadRoof(up):
	"""After the cut the weight, little by little."""
	O.run(2000, wait=True)
	(integrator,) = (engine for engine in O.engines if isinstance(engine, NewtonIntegrator))
	for part in range(1, 41):
		down = [0, 0, 0]
		down[up] = -gravity * part / 40
		integrator.gravity = tuple(down)
		O.run(200, wait=True)


@pytest.mark.parametrize('flat', [False, True])
def testARoofPrismSettlesOnItsJoints(flat):
	left, up, length, sunk, pressed, sheared = roofPrism(flat, math.radians(70))
	at = float(O.bodies[left].state.pos[up])
	loadRoof(up)
	assert at - float(O.bodies[left].state.pos[up]) == pytest.approx(sunk, rel=0.01)
	contacts = [contact for contact in O.bodies[left].intrs() if contact.isReal and contact.phys.contactArea > 0.01 * length]
	assert len(contacts) == 2
	for contact in contacts:
		assert contact.phys.contactArea == pytest.approx(length, rel=1e-3)
		assert contact.phys.normalForce.norm() / length == pytest.approx(pressed, rel=0.01)
		assert contact.phys.shearForce.norm() / length == pytest.approx(sheared, rel=0.01)


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('more', [-2, 2])
def testARoofPrismStandsByTheAngleOfItsClosedForm(more, flat):
	"""tan φ is the shear over the normal stress of its joints."""
	*_, pressed, sheared = roofPrism(flat, math.radians(70))
	O.reset()
	left, up, *_ = roofPrism(flat, math.atan(sheared / pressed) + math.radians(more))
	at = float(O.bodies[left].state.pos[up])
	loadRoof(up)
	O.run(3000, wait=True)
	fallen = at - float(O.bodies[left].state.pos[up])
	assert fallen > 0.1 if more < 0 else fallen < 1e-3
