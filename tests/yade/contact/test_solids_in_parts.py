# SPDX-License-Identifier: GPL-2.0-or-later
"""Cubes in parts, cut straight and obliquely, on floors in pieces: the contacts have together force, moment and energy of the one of both solids."""

import itertools
import math
import random

import pytest
from scenes import kineticEnergy
from yade import (
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
	utils,
)

half = 0.5
corners = [Vector3(*(half * (1 if n >> axis & 1 else -1) for axis in range(3))) for n in range(8)]
square = [(-half, -half), (half, -half), (half, half), (-half, half)]


def prism(outline, upright):
	"""Over an outline across this axis."""
	return [Vector3(*(*point[:upright], level, *point[upright:])) for point in outline for level in (-half, half)]


def eighth(n):
	"""Between the middle of the cube and one corner."""
	return [Vector3(*(corners[n][axis] * (k >> axis & 1) for axis in range(3))) for k in range(8)]


cubes = {
	'whole': [corners],
	'prisms': [prism([square[k] for k in sides], 2) for sides in ((0, 1, 2), (0, 2, 3))],
	'four prisms': [prism([square[k], square[(k + 1) % 4], (0.1, -0.05)], 1) for k in range(4)],
	'five tetrahedra': [[corners[n] for n in of] for of in ((0, 3, 5, 6), (0, 1, 3, 5), (0, 2, 3, 6), (0, 4, 5, 6), (7, 3, 5, 6))],
	'six tetrahedra': [[corners[n] for n in (0, one, other, 7)] for one in (1, 2, 4) for other in (3, 5, 6) if other & one],
	'eighths': [eighth(n) for n in range(8)],
}


def plates(number, width):
	edge = width / number
	places = [edge * (k + 0.5) - width / 2 for k in range(number)]
	return [polytope.cuboid((x, y, -0.5), (edge / 2, edge / 2, 0.5), fixed=True) for x in places for y in places]


def triangles(number, width):
	edge = width / number
	low = [edge * k - width / 2 for k in range(number)]
	return [
		polytope.fromVertices([(x + edge * u, y + edge * v, z) for u, v in of for z in (-1, 0)], fixed=True)
		for x in low
		for y in low
		for of in (((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1)))
	]


floors = {
	'slab': lambda width: plates(1, width),
	'plates': lambda width: plates(4, width),
	'triangles': lambda width: triangles(3, width),
}


def joints(rule):
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0))
	return {
		'physics': Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=rule == 'perArea'),
		'law': Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0),
		'gravity': (0, 0, 0),
		'damping': 0,
		'timeStepper': False,
	}


def append(parts, turn, place):
	"""The number of the body, or of the clump."""
	bodies = [polytope.fromVertices([turn * corner + place for corner in part]) for part in parts]
	return O.bodies.append(bodies[0]) if len(bodies) == 1 else O.bodies.appendClumped(bodies)[0]


def load(rule, floor, parts, turn, place):
	"""Force on the floor, its moment about the cube, and the energy; all contacts have an answer."""
	options = joints(rule)
	O.trackEnergy = True
	O.engines = polytope.engines(**options)
	O.bodies.append(floor())
	append(parts, turn, place)
	O.dt = 1e-9
	O.step()
	force, moment, energy = Vector3.Zero, Vector3.Zero, 0
	for contact in (contact for contact in O.interactions if contact.isReal):
		assert contact.geom.status == 'contact'
		way = 1 if O.bodies[contact.id1].dynamic else -1
		force += way * contact.phys.normalForce
		moment += way * ((contact.geom.contactPoint - place).cross(contact.phys.normalForce) + contact.geom.turningArm * contact.phys.normalForce)
		energy += contact.geom.energyPerStiffness * contact.phys.kn
	return force, moment, energy


def poses(number):
	"""Cubes that lie on a face, lean by up to 0.001, stand on an edge, on a corner; with depths of 0.0003 to 0.01."""
	some = random.Random(34)
	for k in range(number):
		turn = Quaternion((0, 0, 1), some.uniform(0, 6))
		if k % 4 == 1:
			turn *= Quaternion((1, 0, 0), some.uniform(-1e-3, 1e-3)) * Quaternion((0, 1, 0), some.uniform(-1e-3, 1e-3))
		elif k % 4 > 1:
			turn *= Quaternion((1, 0, 0), some.uniform(0.3, 1.2))
		if k % 4 == 3:
			turn *= Quaternion((0, 1, 0), some.uniform(0.2, 1))
		lowest = min((turn * corner)[2] for corner in corners)
		yield turn, Vector3(some.uniform(-0.4, 0.4), some.uniform(-0.4, 0.4), -lowest - 10 ** some.uniform(-3.5, -2))


rules = pytest.mark.parametrize('rule', ['perArea', 'perContact'])


@rules
@pytest.mark.parametrize('width', [4.0, 0.9], ids=['wide', 'narrow'])
@pytest.mark.parametrize('floor', floors)
@pytest.mark.parametrize('cube', cubes)
def testACubeInPartsHasTheContactOfTheWhole(cube, floor, width, rule):
	"""To rounding, but for the least part of a stiffness that a contact has; on a narrow floor over its ends, too."""
	asked = 0
	for turn, place in poses(16):
		force, moment, energy = load(rule, lambda: plates(1, width), cubes['whole'], turn, place)
		if not force.norm():
			continue  # beside a narrow floor
		parts = load(rule, lambda: floors[floor](width), cubes[cube], turn, place)
		assert (parts[0] - force).norm() < 1e-8 * force.norm()
		assert (parts[1] - moment).norm() < 1e-8 * force.norm()
		assert parts[2] == pytest.approx(energy, rel=1e-8)
		asked += 1
	assert asked > 8


@rules
@pytest.mark.parametrize('depth', [1e-7, 1e-3])
@pytest.mark.parametrize('ground', ['slab', 'wall'])
def testACubeInPartsLiesShallowlyAsTheWhole(ground, depth, rule):
	"""With overlaps of some times what rounding leaves between flush pieces, and on a wall, which has no size."""
	floor = {'slab': lambda: plates(1, 4.0), 'wall': lambda: [utils.wall(0, axis=2)]}[ground]
	place = Vector3(0, 0, half - depth)
	force, _, energy = load(rule, floor, cubes['whole'], Quaternion((0, 0, 1), 0.3), place)
	for cube in ('prisms', 'five tetrahedra', 'eighths'):
		parts = load(rule, floor, cubes[cube], Quaternion((0, 0, 1), 0.3), place)
		assert (parts[0] - force).norm() < 1e-7 * force.norm()
		assert parts[2] == pytest.approx(energy, rel=1e-7)


def collision(rule, cube, some):
	"""The energy of motion after an undamped collision of two cubes, that before, and the most that was stored in between."""
	O.engines = polytope.engines(**joints(rule))
	turns = [Quaternion([some.gauss(0, 1) for _ in range(3)], some.uniform(0, 3)) for _ in range(2)]
	one = O.bodies[append(cubes[cube], turns[0], Vector3.Zero)]
	other = O.bodies[append(cubes[cube], turns[1], Vector3(1.75, some.uniform(-0.2, 0.2), some.uniform(-0.2, 0.2)))]
	one.state.vel, other.state.vel = Vector3(1, 0, 0), Vector3(-1, 0, 0)
	O.dt = 0.05 * math.sqrt(2600 / 1e8)
	before = moving = polytope.mechanicalEnergy()
	stored = 0
	while O.time < 1 and not (stored and not O.interactions.countReal()):
		O.run(5, wait=True)
		moving = kineticEnergy(one.state) + kineticEnergy(other.state)
		stored = max(stored, before - moving)
	assert stored > 0.05 * before and not O.interactions.countReal()
	return moving, before, stored


@pytest.mark.parametrize('rule, room', [('perArea', 1e-5), ('perContact', 1e-3)])
@pytest.mark.parametrize('cube', ['whole', 'prisms', 'five tetrahedra'])
def testCubesInPartsKeepTheirEnergyInCollisions(cube, rule, room):
	"""Over what was stored, as whole ones do; it changed by up to all of that where a piece had no face of its neighbours."""
	for seed in range(3):
		moving, before, stored = collision(rule, cube, random.Random(seed))
		assert abs(moving - before) < room * stored


@pytest.mark.parametrize('floor', [1, 2, 4])
def testAClumpThatIsHeldHasTheContactOfOneThatIsFree(floor):
	"""With all its degrees of freedom blocked, as a platen that a script drives, it counts as fixed: its own members are those of its solid all the same."""
	forces = []
	for blocked in ('', 'xyzXYZ'):
		O.reset()
		O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0, stiffnessPerArea=False))
		width = 2 / floor
		for i, j in itertools.product(range(floor), repeat=2):
			O.bodies.append(polytope.cuboid((-1 + width * (i + 0.5), -1 + width * (j + 0.5), -0.5), (width / 2, width / 2, 0.5), fixed=True))
		turn, centre = Quaternion((0, 0, 1), 0.1), Vector3(0.06, 0.05, 0.198)
		corners = itertools.product((-0.1, 0.1), repeat=3)
		number, members = polytope.clump([polytope.cuboid(centre + turn * Vector3(*at), (0.1, 0.1, 0.1), turn) for at in corners])
		O.bodies[number].state.blockedDOFs = blocked
		O.engines = polytope.engines(gravity=(0, 0, 0), timeStepper=False)
		O.dt = 1e-12
		O.step()
		assert sum(contact.geom.share for contact in O.interactions if contact.isReal) == pytest.approx(1, rel=1e-6)
		forces.append(sum(O.forces.f(member)[2] for member in members))
	assert forces[1] == pytest.approx(forces[0], rel=1e-9)
