# SPDX-License-Identifier: GPL-2.0-or-later
"""Dampers of a body on many pieces, beside neighbours and in heaps: together they are the one damper of the body and its support."""

import math
import warnings

import pytest
from scenes import joint
from yade import Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, O, Quaternion, polytope, utils

half, stiffness = 0.2, 1e9


def engines(zeta=0.0, perArea=True, timeStepper=False, damping=0, **law):
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')  # of several free pieces under one face
		O.engines = polytope.engines(
			gravity=(0, 0, 0),
			damping=damping,
			law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=zeta, **law),
			timeStepper=timeStepper,
		)
	O.engines[2].physDispatcher.functors[0].stiffnessPerArea = perArea


def pavement(n, free=False, top=0.0):
	"""n × n plates, together wider than the cube's face by a fiftieth. With sides in line a spin of 1e-11 rad/s, or rounding, decides which way the wedge
	between them presses, by 1e-3 of the force."""
	wide = 1.02 * half
	h = 2 * wide / n
	for i in range(n):
		for j in range(n):
			O.bodies.append(polytope.cuboid((-wide + h * (i + 0.5), -wide + h * (j + 0.5), top - 0.5), (h / 2, h / 2, 0.5), fixed=not free))
	if free:
		for body in O.bodies:
			body.state.blockedDOFs = 'xyzXYZ'


def restitution(zeta, n, perArea=True, free=False, dt=2e-6, make=None):
	"""Speed up, and rate of turning, of a cube that has fallen flat on n × n pieces at 1 m/s."""
	O.reset()
	k = stiffness if perArea else stiffness * 4 * half**2
	joint(normalStiffness=k, shearStiffness=k, frictionAngle=0.3)
	(make or pavement)(n, free)
	cube = O.bodies[O.bodies.append(polytope.cuboid((0, 0, half + 1e-4), (half, half, half), velocity=(0, 0, -1)))]
	engines(zeta, perArea)
	O.dt = dt
	while O.time < 0.02:
		O.run(20, wait=True)
		if cube.state.vel[2] > 0 and not any(one.isReal for one in cube.intrs()):
			break
	return float(cube.state.vel[2]), float(cube.state.angVel.norm())


def theory(zeta):
	"""Coefficient of restitution of a spring and a damper that cannot pull: m x'' + c x' + k x = 0 until the force is zero."""
	return math.exp(-zeta / math.sqrt(1 - zeta**2) * math.atan2(2 * zeta * math.sqrt(1 - zeta**2), 2 * zeta**2 - 1))


@pytest.mark.parametrize('perArea, free', [(True, False), (True, True), (False, False)])
@pytest.mark.parametrize('zeta', [0.1, 0.3])
def testRestitutionDoesNotDependOnTheNumberOfPieces(zeta, perArea, free):
	for n in (1, 2, 3, 4):
		found, turned = restitution(zeta, n, perArea, free)
		assert found == pytest.approx(theory(zeta), abs=2e-3), n
		assert turned < 1e-6


def testRestitutionOnFourHundredPieces():
	assert restitution(0.3, 20, dt=1e-5)[0] == pytest.approx(theory(0.3), abs=5e-3)


def facets(n, free):
	"""A terrain of n × n squares of two facets."""
	h = 4 * half / n
	for i in range(n):
		for j in range(n):
			a, b, c, d = [(-2 * half + h * (i + x), -2 * half + h * (j + y), 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
			O.bodies.append([utils.facet((a, b, c), fixed=True), utils.facet((a, c, d), fixed=True)])


@pytest.mark.parametrize('n', [2, 3, 5])
def testAFlatFallOnTerrainDoesNotTurn(n):
	found, turned = restitution(0.3, n, make=facets)
	assert found == pytest.approx(theory(0.3), abs=2e-3)
	assert turned < 1e-3


def testShearDampersAddUpToOne():
	"""A cube pressed on n × n pieces and pushed: its oscillation along them decays as on one."""
	left = []
	for n in (1, 3):
		O.reset()
		joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=1.5)
		pavement(n)
		cube = O.bodies[O.bodies.append(polytope.cuboid((0, 0, half - 1e-4), (half, half, half)))]
		cube.state.blockedDOFs = 'zXYZ'
		cube.state.vel = (1e-3, 0, 0)
		engines(shearDamping=0.2)
		omega = math.sqrt(stiffness * 4 * half**2 / cube.state.mass)
		O.dt = 1e-3 / omega
		O.run(int(2 * math.pi / omega / math.sqrt(1 - 0.2**2) / O.dt), wait=True)
		left.append(float(cube.state.vel[0]) / 1e-3)
	assert left == pytest.approx([math.exp(-0.2 / math.sqrt(1 - 0.2**2) * 2 * math.pi)] * 2, rel=0.02)


def slab(n=20, perArea=True):
	"""A slab with all defaults falls by 1 cm on n × n plates. Returns the highest speed upwards and the highest place."""
	O.reset()
	joint(density=2600, normalStiffness=1e9 if perArea else 1e9 / n**2, shearStiffness=1e9 if perArea else 1e9 / n**2, frictionAngle=0.5)
	h = 2 / n
	O.bodies.append(
		[
			polytope.cuboid((-1 + h * (i + 0.5), -1 + h * (j + 0.5), -0.1), (h / 2, h / 2, 0.1), fixed=True)
			for i in range(n)
			for j in range(n)
		]
	)
	body = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0.11), (1, 1, 0.1)))]
	O.engines = polytope.engines()
	fastest = top = 0.0
	while O.time < 0.1:
		O.step()
		if body.state.vel[2] > 0:
			fastest, top = max(fastest, float(body.state.vel[2])), max(top, float(body.state.pos[2]) - 0.1)
	return fastest, top


@pytest.mark.parametrize('n', [1, 4, 20])
def testASlabDoesNotGainEnergyUnderDefaults(n):
	fastest, top = slab(n)
	assert fastest < 0.443 * theory(0.3) * 1.2
	assert top < 0.01 * theory(0.3) ** 2 * 1.4


def testABlockOnAConeOfWedgesIsNotThrown():
	"""Thirty wedges whose tips meet under the middle of its face; it is set down flat."""
	joint(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.6)
	wedges = 30
	for k in range(wedges):
		a, b = 2 * math.pi * k / wedges, 2 * math.pi * (k + 1) / wedges
		ring = [(0.5 * math.cos(x), 0.5 * math.sin(x)) for x in (a, b)]
		O.bodies.append(polytope.fromVertices([(0, 0, 0), (0, 0, -0.5), *[(x, y, z) for x, y in ring for z in (-0.02, -0.5)]], fixed=True))
	block = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0.101), (0.1, 0.1, 0.1)))]
	O.engines = polytope.engines()
	highest = 0.0
	while O.time < 0.4:
		O.run(10, wait=True)
		highest = max(highest, float(block.state.pos[2]))
	assert highest < 0.1011
	assert abs(block.state.vel[2]) < 0.01


def testANeighbourAtTheSideChangesNothing():
	"""A cube that touches a plate beside it, too, falls as one alone: that contact does not carry it."""

	def beside(n, free):
		pavement(1)
		O.bodies.append(polytope.cuboid((2 * half - 1e-5, 0, 0), (half, 1, 1), fixed=True))
		O.materials[0].frictionAngle = 0

	assert restitution(0.3, 1, make=beside)[0] == pytest.approx(theory(0.3), abs=2e-3)


def testBetweenTwoPlatesTheDampersAreOneForBothSprings():
	"""Pressed from below and above: m x'' + 2 ζ √(2 k m) x' + 2 k x = 0."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.3)
	O.bodies.append([polytope.cuboid((0, 0, z), (half, half, half), fixed=True) for z in (-2 * half + 1e-4, 2 * half - 1e-4)])
	cube = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0), (half, half, half), velocity=(0, 0, 1e-3)))]
	cube.state.blockedDOFs = 'xyXYZ'
	engines(0.2)
	omega = math.sqrt(2 * stiffness * 4 * half**2 / cube.state.mass)
	O.dt = 1e-3 / omega
	O.run(int(2 * math.pi / omega / math.sqrt(1 - 0.2**2) / O.dt), wait=True)
	assert float(cube.state.vel[2]) / 1e-3 == pytest.approx(math.exp(-0.2 / math.sqrt(1 - 0.2**2) * 2 * math.pi), rel=0.02)


@pytest.mark.parametrize('tilt', [0, 0.01])
def testNoDamperTakesMoreThanTheMotionThereIs(tilt):
	"""However long the step and strong the damper: a cube that meets 4 × 4 plates gains no energy; one that meets them flat is stopped."""
	joint(normalStiffness=1, shearStiffness=1, frictionAngle=0.3)
	pavement(4)
	cube = O.bodies[
		O.bodies.append(polytope.cuboid((0, 0, half - 1e-3), (half, half, half), Quaternion((1, 0, 0), tilt), velocity=(0, 0, -1)))
	]
	engines(1e6)
	O.dt = 1e-5
	energies = []
	for _ in range(20):
		O.step()
		energies.append(utils.kineticEnergy())
	assert all(b <= a * (1 + 1e-9) for a, b in zip(energies, energies[1:], strict=False))
	assert energies[-1] < 0.9 * energies[0]
	if not tilt:
		assert abs(cube.state.vel[2]) < 1e-6


def testALoadedRunGoesOnAsIfItHadNotBeenInterrupted(tmp_path):
	"""It goes on the same to the last bit: a fall on 3 × 3 pieces, saved while the body is pressed in."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.3)
	pavement(3)
	cube = O.bodies.append(polytope.cuboid((0, 0, half + 1e-4), (half, half, half), Quaternion((1, 0.3, 0), 1e-3), velocity=(0, 0, -1)))
	engines(0.3, shearDamping=0.1)
	O.dt = 2e-5
	O.run(30, wait=True)
	assert sum(one.isReal for one in O.interactions) == 9
	O.save(str(tmp_path / 'state.yade.gz'), quiet=True)
	ends = []
	for _ in range(2):
		O.run(40, wait=True)
		ends.append((tuple(O.bodies[cube].state.pos), tuple(O.bodies[cube].state.vel), tuple(O.bodies[cube].state.angVel)))
		O.load(str(tmp_path / 'state.yade.gz'), quiet=True)
	assert ends[0] == ends[1]
