# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.limitAnalysis against closed forms and other programs, what it refuses, and that it leaves the scene as it was."""

import json
import math
import pathlib
import sys

import numpy as np
import pytest
from rockScenes import across, along, blockMaterial, blockOnSlope, dip, friction, gravity, meanArm
from scipy.optimize import minimize
from yade import FrictMat, ForceEngine, O, PolytopeBond, PolytopeBonds, RadialForceEngine, RockJointMat, TorqueEngine, Vector3, polytope, utils

project = pathlib.Path(__file__).resolve().parents[3]
sys.path.append(str(project / 'examples/paper'))
from boon2012.slope import theory  # noqa: E402

fine = 1e-3
"""Tolerance of the factor where a closed form is known."""


def expect(found, theory):
	assert found.stable <= theory * (1 + 1e-4) and found.failed >= theory * (1 - 1e-4), (found.stable, theory, found.failed)
	assert found.failed / found.stable <= 1 + fine


def testPartsThatAreBondedForGoodAreOneBlock():
	"""The mode is that of one block, and both parts are named."""
	blockMaterial(cohesion=6e3)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	parts = O.bodies.append([polytope.cuboid((x, 0, 0.1), (0.25, 0.5, 0.1)) for x in (-0.25, 0.25)])
	O.engines = polytope.engines(gravity=(gravity * math.sin(dip), 0, -gravity * math.cos(dip)))
	polytope.bond(parts, tensileStrength=math.inf, cohesion=math.inf)
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, (across * math.tan(friction) + 6e3) / along)
	assert sorted(found.bodies) == parts and found.joints == 2
	assert found.displacements[0] == pytest.approx(found.displacements[1], rel=1e-6)


def testOneBondedForGoodToWhatIsFixedIsFixed():
	blockMaterial()
	floor = O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	lower, upper = O.bodies.append([polytope.cuboid((0, 0, z), (0.5, 0.5, 0.1)) for z in (0.1, 0.3)])
	O.engines = polytope.engines(gravity=(gravity * math.sin(dip), 0, -gravity * math.cos(dip)))
	polytope.bond([floor, lower], tensileStrength=math.inf, cohesion=math.inf)
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, math.tan(friction) / math.tan(dip))
	assert found.bodies == [upper]


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize(
	'reduce, theory',
	[
		(('friction', 'cohesion', 'tension'), (across * math.tan(friction) + 6e3) / along),
		(['friction'], across * math.tan(friction) / (along - 6e3)),
		(['cohesion'], 6e3 / (along - across * math.tan(friction))),
	],
)
def testPlaneFailure(flat, reduce, theory):
	"""The direction is that of associated flow: the block opens by tan φ/F times its slip."""
	block = blockOnSlope(dip, (0.5, 0.5, 0.1), flat, cohesion=6e3)
	found = polytope.limitAnalysis(reduce=reduce, tolerance=fine)
	expect(found, theory)
	opening = math.atan(math.tan(friction) / (theory if 'friction' in reduce else 1))
	assert found.bodies == [block]
	assert found.directions[0] == pytest.approx(
		(math.cos(opening), math.sin(opening) if flat else 0, 0 if flat else math.sin(opening)), abs=0.01
	)
	assert np.linalg.norm(found.displacements[0]) == pytest.approx(0.02 * (0.2 ** (1 / 2) if flat else 0.2 ** (1 / 3)), rel=1e-6)
	assert found.joints == 1 and [trial.stands for trial in found.trials if trial.factor == 1] == [True]


@pytest.mark.parametrize(
	'joint, theory', [({}, math.tan(friction) / math.tan(dip)), ({'cohesion': 5e2}, (across * math.tan(friction) + 5e2) / along)]
)
def testAFactorBelowOne(joint, theory):
	blockOnSlope(dip, (0.5, 0.5, 0.1), **joint)
	expect(polytope.limitAnalysis(tolerance=fine), theory)


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('short', [1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 0, -1e-8])
def testAFactorBesideOneThatIsTried(flat, short):
	"""A back-analysis gives strengths for a factor of 1, rounded: there the bounds on the lack of strength do not meet before rounding ends
	the steps."""
	blockOnSlope(dip, (0.5, 0.5, 0.1), flat, frictionAngle=math.atan((1 - short) * math.tan(dip)))
	expect(polytope.limitAnalysis(tolerance=fine), 1 - short)


@pytest.mark.parametrize('flat', [False, True])
def testTopplingOfAColumnHeldByTheTensionOfItsBase(flat):
	"""Plastic: its base pulls with the strength all over, about the foot."""
	wide, high, steep = 0.5, 1.0, math.radians(40)
	load = 5000 * gravity * wide * high
	lacking = load * (high * math.sin(steep) - wide * math.cos(steep)) / 2  # moment about the foot, of unit width
	block = blockOnSlope(
		steep, (wide / 2, 0.5, high / 2), flat, tensileStrength=1.7 * lacking * 2 / wide**2, cohesion=1e7, frictionAngle=math.radians(60)
	)
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, 1.7)
	turn = found.rotations[0] @ ((0, 0, -1) if flat else (0, 1, 0))
	assert found.bodies == [block] and turn == pytest.approx(
		np.linalg.norm(found.displacements[0]) / math.hypot(wide / 2, high / 2), rel=0.05
	)


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('slender', [0.98, 1.02])
def testABlockTopplesWhereGoodmanAndBraySay(flat, slender):
	"""tan α = b/h; no friction helps a block that is more slender."""
	wide, high = 0.5, 1.0
	blockOnSlope(math.atan(slender * wide / high), (wide / 2, 0.5, high / 2), flat, frictionAngle=math.radians(60))
	if slender > 1:
		with pytest.raises(RuntimeError, match='does not stand, not even with 20 times friction, cohesion, tension: body '):
			polytope.limitAnalysis()
	else:
		found = polytope.limitAnalysis(tolerance=fine)
		expect(found, math.tan(math.radians(60)) / (slender * wide / high))


def testWhatHangsByTension():
	strength = 1.6 * 5000 * gravity
	blockMaterial(tensileStrength=strength, cohesion=1e7)
	O.bodies.append(polytope.cuboid((0, 0, 1.5), (2, 2, 0.5), fixed=True))
	hanging = O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, 1.6)
	assert found.bodies == [hanging] and found.directions[0] == pytest.approx((0, 0, -1), abs=1e-3)
	endless = polytope.limitAnalysis(reduce=('friction', 'cohesion'), most=3)
	assert endless.factor == endless.failed == math.inf and endless.stable == 3
	assert endless.bodies == [] and endless.displacements.shape == endless.rotations.shape == endless.directions.shape == (0, 3)
	assert str(endless).startswith('factor of safety infinite: it stands with strengths divided by 3,')


def normalOf(joint):
	return np.array(polytope.JointSet(math.radians(joint[0]), math.radians(joint[1]), 1).normal)


def limitOfTranslation(load, planes):
	"""Least factor by which a block that does not turn fails, by the kinematic theorem: over all directions, by a search that knows nothing of cones.

	:param load: unit force
	:param planes: (outward normal of the rock below, tan φ, cohesion times area over the load) of each
	"""
	first = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]])

	def sliding(way, normal):
		return float(np.sqrt(1e-16 + np.sum((way - (normal @ way) * normal) ** 2)))

	def gain(factor):
		def lost(way):
			return -load @ way + sum(cohesion / factor * sliding(way, normal) for normal, _, cohesion in planes)

		limits = [
			{'type': 'ineq', 'fun': lambda way, n=normal, t=tangent: n @ way - t / factor * sliding(way, n)}
			for normal, tangent, _ in planes
		]
		limits.append({'type': 'ineq', 'fun': lambda way: 1 - way @ way})
		starts = [
			sum(x * n for x, n in zip(part, [plane[0] for plane in planes], strict=True)) + 0.5 * load + 0.3 * side
			for part in ((1, 1), (1, 0.3), (0.3, 1))
			for side in [*first, *-first]
		]
		found = [minimize(lost, start, constraints=limits, method='SLSQP') for start in starts]
		return max([-one.fun for one in found if one.success and all(limit['fun'](one.x) > -1e-7 for limit in limits)], default=0.0)

	low, high = 0.5, 10.0
	while high - low > 1e-4:
		middle = (low + high) / 2
		low, high = (low, middle) if gain(middle) > 1e-6 else (middle, high)
	return (low + high) / 2


def onTwoPlanes(strengths):
	"""A wedge of Hoek & Bray on planes of 45/105 and 70/235, of these (cohesion, friction angle [°]): (its id, upward normals of the
	planes, their line, downward, its weight)."""
	one, two, face, top = map(normalOf, ((45, 105), (70, 235), (65, 185), (12, 195)))
	for label, (cohesion, angle) in zip('ABW', (*strengths, (1e9, 80)), strict=True):
		blockMaterial(label=label, density=2600, frictionAngle=math.radians(angle), cohesion=cohesion)
	up = np.array([-face[0] * face[2], -face[1] * face[2], 1 - face[2] ** 2])
	box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	O.bodies.append(polytope.fromHalfSpaces([one, *box], [0] + [200] * 6, material='A', fixed=True))
	O.bodies.append(polytope.fromHalfSpaces([two, -one, *box], [0, 0] + [200] * 6, material='B', fixed=True))
	wedge = O.bodies.append(polytope.fromHalfSpaces([-one, -two, face, top], [0, 0, 0, float(top @ (30 * up / up[2]))], material='W'))
	O.engines = polytope.engines()
	line = np.cross(one, two)
	return wedge, (one, two), -line * np.sign(line[2]) / np.linalg.norm(line), float(O.bodies[wedge].state.mass) * gravity


def testAWedge():
	"""Limit equilibrium without shear across the line of intersection gives 1.877. The limit analysis gives the most that forces within the
	strengths of both planes can hold."""
	wedge, (one, two), line, load = onTwoPlanes([(24e3, 20), (48e3, 30)])
	found = polytope.limitAnalysis(tolerance=fine)
	areas = {bond.id1: float(bond.area) for bond in PolytopeBonds().find([], -1, 0.01, anyBond())}
	planes = [(one, math.tan(math.radians(20)), 24e3 * areas[0] / load), (two, math.tan(math.radians(30)), 48e3 * areas[1] / load)]
	theory = limitOfTranslation(np.array([0, 0, -1.0]), planes)
	assert theory == pytest.approx(1.959, abs=2e-3)
	expect(found, theory)
	assert found.bodies == [wedge] and found.directions[0] @ line > 0.9


def testAWedgeOfFrictionAlone():
	"""Friction across the line holds more where there is more of it: 2.498 for the 2.238 of limit equilibrium, 12 % above it."""
	wedge, (one, two), line, _ = onTwoPlanes([(0, 40), (0, 45)])
	down = np.array([0, 0, -1.0])
	along = down @ line
	frictions = math.tan(math.radians(40)), math.tan(math.radians(45))
	pressing = np.linalg.lstsq(np.column_stack([one, two]), along * line - down, rcond=None)[0]
	assert pressing.min() > 0
	equilibrium = pressing @ frictions / along
	assert equilibrium == pytest.approx(2.238, abs=1e-3)
	theory = limitOfTranslation(down, [(one, frictions[0], 0), (two, frictions[1], 0)])
	assert theory / equilibrium == pytest.approx(1.116, abs=2e-3)
	expect(polytope.limitAnalysis(tolerance=fine), theory)


def anyBond():
	return PolytopeBond(normalStiffness=1, shearStiffness=1, tensileStrength=math.inf, cohesion=math.inf, frictionAngle=0)


def columnsOnSteps(angle):
	"""Goodman & Bray's sixteen columns, as in examples/goodmanBray.py."""
	steep, width, heaviness = math.radians(30), 10.0, 25e3
	heights = [4.0 * n for n in range(1, 11)] + [40 - 6.2 * n for n in range(1, 7)]
	blockMaterial(density=heaviness / gravity, frictionAngle=math.radians(angle))
	for n, height in enumerate(heights, 1):
		left, right, step = width * n, width * (n + 1), n + 1.0
		O.bodies.append(polytope.polygon([(left, step - 30), (right, step - 30), (right, step), (left, step)], fixed=True))
		O.bodies.append(polytope.polygon([(left, step), (right, step), (right, step + height), (left, step + height)]))
	O.engines = polytope.engines(gravity=(-gravity * math.sin(steep), -gravity * math.cos(steep), 0))


def testColumnsThatToppleStandAtLessFrictionThanRealOnes():
	"""Joints that slip open: columns jam, and stand at 33.4° in place of the 38.13° of limit equilibrium; a linear program of its own for
	the plane says the same."""
	columnsOnSteps(45)
	found = polytope.limitAnalysis(tolerance=fine)
	corners = [[(float(x), float(y)) for x, y in cornersOf(body)] for body in O.bodies]
	turned = [[rotated(point) for point in one] for one in corners]  # its gravity is along −y
	angle = theory.criticalFrictionAngle(turned[1::2], turned[::2]).angle
	assert math.degrees(angle) < 35
	expect(found, 1 / math.tan(angle))


def cornersOf(body):
	"""Corners of a polygon, counter-clockwise."""
	points = {tuple(np.round(np.array(body.state.pos + body.state.ori * vertex, float)[:2], 9)) for vertex in body.shape.vertices}
	middle = np.mean(list(points), axis=0)
	return sorted(points, key=lambda point: math.atan2(point[1] - middle[1], point[0] - middle[0]))


def rotated(point):
	"""The point, rotated by 30°, the dip of the blocks' base."""
	(x, y), c, s = point, math.cos(math.radians(30)), math.sin(math.radians(30))
	return x * c - y * s, x * s + y * c


def testASlopeWithTheAngleOfALinearProgramInThePlane():
	"""Simulation E of the paper, whose limit analysis is a program of its own: 19.75°."""
	content = json.loads((project / 'examples/paper/geometry/e_slope.json').read_text())
	angle = theory.criticalFrictionAngle(content['free'], content['fixed']).angle
	blockMaterial(frictionAngle=math.radians(30))
	for name in ('free', 'fixed'):
		for corners in content[name]:
			O.bodies.append(polytope.polygon(corners, fixed=name == 'fixed'))
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	expect(polytope.limitAnalysis(tolerance=fine), math.tan(math.radians(30)) / math.tan(angle))


@pytest.mark.parametrize('side', [65, 80])
def testABlockBesideASteepPlane(side):
	"""More than the limit equilibrium of keyBlocks; between two parallel planes it jams, without bound."""
	base, friction, steep = math.radians(30), math.radians(36), math.radians(side)
	surface = math.sin(base), 0, math.cos(base)
	planes = [polytope.Joint(base, math.radians(90), (0, 0, 0)), *(polytope.Joint(steep, 0, (0, y, 0)) for y in (-1, 1))]
	rock = polytope.jointedRock([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), surface, (0, 0, -1)], [3, 3, 3, 3, 1.5, 4], planes)
	blockMaterial(density=2600, frictionAngle=friction)
	ids = rock.append()
	above = [k for k in ids if np.dot(O.bodies[k].state.pos, surface) > 0]
	_, block, wall = sorted(above, key=lambda k: O.bodies[k].state.pos[1])
	for k in ids:
		O.bodies[k].dynamic = k == block
	O.engines = polytope.engines()
	assert polytope.limitAnalysis().factor == math.inf
	O.bodies.erase(wall)
	faces = [(np.array(normal), math.tan(friction), 0.0) for normal in (surface, (0, math.sin(steep), math.cos(steep)))]
	theory = limitOfTranslation(np.array([0, 0, -1.0]), faces)
	expect(polytope.limitAnalysis(tolerance=fine), theory)


@pytest.mark.parametrize('pull', [0, 2000, 6000])
def testAWedgeInARoof(pull):
	"""Between two blocks that a permanent force presses, and that move along it alone: φ = i + arctan((W − T)/2H), T the yield force of a bolt."""
	lean, pressed, height = math.radians(20), 8e3, 0.8
	blockMaterial(density=2500, frictionAngle=math.radians(60))

	def block(corners):
		return O.bodies.append(polytope.fromVertices([(x, y, z) for y in (-0.5, 0.5) for x, z in corners]))

	low, high = math.tan(lean), 0.2 * math.tan(lean)
	wedge = block([(-low, 0), (low, 0), (-high, height), (high, height)])
	fixed = []
	for side in (-1, 1):
		rock = block([(side * x, z) for x, z in ((low, 0), (high, height), (1.4, 0), (1.4, height))])
		O.bodies[rock].state.blockedDOFs = 'yzXYZ'
		O.forces.setPermF(rock, (-side * pressed, 0, 0))
		fixed.append(rock)
	O.engines = polytope.engines()
	load = float(O.bodies[wedge].state.mass) * gravity - pull
	if pull:
		O.bodies.append(polytope.cuboid((0, 0, 2), (2, 0.5, 0.5), fixed=True))
		polytope.bolt((0, 0, 0), (0, 0, 2.2), area=5e-4, youngsModulus=2e11, yieldForce=pull)
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, math.tan(math.radians(60)) / math.tan(lean + math.atan(load / (2 * pressed))))
	assert wedge in found.bodies


def testWaterInATensionCrack():
	"""Plane failure of Hoek & Bray, 1.2768."""
	high, face, plane, crack, water = 60.0, math.radians(60), math.radians(35), 14.0, 1000 * gravity
	back, foot, full = (high - crack) / math.tan(plane), high - crack, 7.0
	blockMaterial(density=26e3 / gravity, frictionAngle=math.radians(35), cohesion=1e5)
	O.bodies.append(polytope.polygon([(-9, -9 * math.tan(plane)), (-9, -20), (90, -20), (90, 90 * math.tan(plane))], fixed=True))
	block = O.bodies.append(polytope.polygon([(0, 0), (back, foot), (back, high), (high / math.tan(face), high)]))
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	towards = lambda x, y: lambda one: one.body == block and one.normal @ (x, y, 0) > 0.999  # noqa: E731
	polytope.water(level=foot + full, faces=towards(1, 0))
	polytope.water(pressures=[((back, foot), water * full), ((0, 0), 0)], faces=towards(math.sin(plane), -math.cos(plane)))
	length, load = foot / math.sin(plane), float(O.bodies[block].state.mass) * gravity
	uplift, thrust = water * full * length / 2, water * full**2 / 2
	closed = (1e5 * length + (load * math.cos(plane) - uplift - thrust * math.sin(plane)) * math.tan(math.radians(35))) / (
		load * math.sin(plane) + thrust * math.cos(plane)
	)
	assert closed == pytest.approx(1.2768, rel=2e-3)
	expect(polytope.limitAnalysis(tolerance=fine), closed)


def testOfSeveralBlocksTheWeakerMoves():
	blockMaterial()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (9, 9, 0.5), fixed=True, material=0))
	O.materials[0].cohesion = 1e6
	for k, factor in enumerate((1.9, 1.4)):
		blockMaterial(cohesion=factor * along - across * math.tan(friction))
		O.bodies.append(polytope.cuboid((0, 3 * k, 0.1), (0.5, 0.5, 0.1), material=k + 1))
	O.engines = polytope.engines(gravity=(gravity * math.sin(dip), 0, -gravity * math.cos(dip)))
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, 1.4)
	assert found.bodies == [2]


def testAClumpMovesAsOne():
	"""Two halves of the block of testPlaneFailure, glued together."""
	blockMaterial(cohesion=6e3)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	clump, parts = polytope.clump([polytope.cuboid((x, 0, 0.1), (0.25, 0.5, 0.1)) for x in (-0.25, 0.25)])
	O.engines = polytope.engines(gravity=(gravity * math.sin(dip), 0, -gravity * math.cos(dip)))
	expect(polytope.limitAnalysis(tolerance=fine), (across * math.tan(friction) + 6e3) / along)
	O.forces.setPermF(parts[0], (1000, 0, 0))  # on a part of it
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, (across * math.tan(friction) + 6e3) / (along + 1000))
	assert found.bodies == [clump]


def testUnitsAndPlaceDoNotMatter():
	"""The scene is in millimetres, far from the origin."""
	blockMaterial(density=5e-6, cohesion=6e-3 * 1e-6 * 1e6)
	far = Vector3(3e5, -2e5, 1e5)
	O.bodies.append(polytope.cuboid(far + Vector3(0, 0, -500), (3000, 2000, 500), fixed=True))
	O.bodies.append(polytope.cuboid(far + Vector3(0, 0, 100), (500, 500, 100)))
	O.engines = polytope.engines(gravity=(gravity * math.sin(dip), 0, -gravity * math.cos(dip)))
	weight = 5e-6 * 200 * 1e6 * gravity
	expect(polytope.limitAnalysis(tolerance=fine), (weight * math.cos(dip) * math.tan(friction) + 6e-3 * 1e6) / (weight * math.sin(dip)))


def testTheSceneIsWhatItWas():
	block = blockOnSlope(dip, (0.5, 0.5, 0.1), cohesion=1e5)
	O.bodies[block].state.pos -= Vector3(0, 0, 1e-8)
	O.run(50, wait=True)
	before = O.iter, O.bodies[block].state.pos, O.interactions[0, block].phys.normalForce, O.materials[0].cohesion, len(O.engines)
	polytope.limitAnalysis()
	O.run(1, wait=True)
	after = O.iter - 1, O.materials[0].cohesion, len(O.engines)
	assert after == (before[0], *before[3:]) and O.interactions.has(0, block, onlyReal=True)
	assert float(O.interactions[0, block].phys.normalForce.norm()) == pytest.approx(float(before[2].norm()), rel=0.5)


@pytest.mark.parametrize(
	'name, value',
	[
		('tolerance', 0),
		('tolerance', math.nan),
		('most', 1),
		('most', math.inf),
		('reduce', 'friction'),
		('reduce', ['weight']),
		('reduce', 3),
		('reduce', []),
	],
)
def testBadArgumentsAreNamed(name, value):
	blockOnSlope(dip, (0.5, 0.5, 0.1), cohesion=6e3)
	with pytest.raises(ValueError, match=f'^{name}: '):
		polytope.limitAnalysis(**{name: value})


def sphereBeside():
	O.bodies.append(utils.sphere((0, 0, 5), 0.5))


def otherMaterial():
	O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.6))
	O.bodies[1].material = O.materials[-1]


@pytest.mark.parametrize(
	'spoil, message',
	[
		(sphereBeside, 'O.bodies: body 2 is a Sphere; .*must be Polytopes'),
		(otherMaterial, 'O.bodies: body 1 is of a FrictMat; .*RockJointMat'),
		(lambda: setattr(O.bodies[1], 'dynamic', False), 'O.bodies: none can move'),
		(lambda: setattr(O.bodies[0], 'dynamic', True), 'O.bodies: no faces .* connect 2 blocks to a fixed one .0, 1.*fix'),
		(lambda: setattr(O.bodies[1].state, 'pos', (0, 0, 1)), 'O.bodies: no faces .* connect 1 blocks to a fixed one .1.'),
		(lambda: setattr(O.engines[3], 'gravity', (0, 0, 0)), 'O.engines: nothing loads the blocks; .*gravity'),
		(lambda: setattr(O, 'engines', []), 'O.engines: there must be a NewtonIntegrator'),
		(lambda: polytope.bond(tensileStrength=1e6, cohesion=math.inf), 'polytope.bond: .*one strength without a limit'),
		(lambda: polytope.bolt((0, 0, 0.2), (0, 0, -0.5), area=5e-4, youngsModulus=2e11), 'polytope.bolt: .*give it a yieldForce'),
	],
)
def testScenesThatAreNoBlocksWithJointsAreRefused(spoil, message):
	blockOnSlope(dip, (0.5, 0.5, 0.1), cohesion=6e3)
	spoil()
	with pytest.raises(ValueError, match=message):
		polytope.limitAnalysis()


def testALawOfItsOwnIsRefused():
	from yade import BartonBandisStrength

	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, strength=BartonBandisStrength()))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.1), (0.5, 0.5, 0.1)))
	O.engines = polytope.engines()
	with pytest.raises(ValueError, match='O.bodies: a joint of body 0 has a shear law of its own .BartonBandisStrength.*strength=None'):
		polytope.limitAnalysis()


def testPictureAndText(tmp_path):
	block = blockOnSlope(dip, (0.5, 0.5, 0.1), cohesion=6e3)
	found = polytope.limitAnalysis()
	assert str(found).startswith('factor of safety 1.') and f'body {block} by 0.012 m towards (' in str(found)
	path = pathlib.Path(tmp_path) / 'mode.png'
	found.picture(path)
	assert path.read_bytes()[:4] == b'\x89PNG'


def testThatOfStrengthReduction():
	"""A jointed slope of some hundred blocks, which slide along their bedding and can open freely."""
	face, high, wide = math.radians(60), 9.0, 6.0
	planes = [
		polytope.JointSet(math.radians(steep), math.radians(towards), spacing)
		for steep, towards, spacing in ((35, 270, 1.8), (80, 90, 2.2), (85, 0, 1.6))
	]
	depth = high / math.tan(face) + 4
	normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (-math.sin(face), 0, math.cos(face))]
	rock = polytope.jointedRock(normals, [depth, 1, wide, 0, high, 1, 0], planes, smallest=0.3)
	for angle in (40, 45):
		blockMaterial(density=2600, normalStiffness=5e8, shearStiffness=2.5e8, frictionAngle=math.radians(angle))
	ids = rock.append(jointMaterials=[0, 1, 1], material=1)
	for k, blocks in zip(ids, rock.bodies, strict=True):
		O.bodies[k].dynamic = not any(
			rock.faces[block][plane] < 0 and (normal[2] < -0.99 or normal[0] > 0.99)
			for block in blocks
			for plane, normal in enumerate(rock.blocks[block][0])
		)
	O.engines = polytope.engines(damping=0.4)
	limit = polytope.limitAnalysis()
	polytope.settle(unbalanced=1e-4, elastic=False, densityScaling=True)
	assert polytope.limitAnalysis().factor == pytest.approx(limit.factor, rel=0.01)  # the faces are the same
	found = polytope.factorOfSafety(tolerance=0.02)
	assert 80 < len(ids) < 200
	assert found.factor == pytest.approx(limit.factor, rel=0.02) and found.factor == pytest.approx(
		math.tan(math.radians(40)) / math.tan(math.radians(35)), rel=0.03
	)
	assert len(set(limit.bodies) & set(found.bodies)) > 0.7 * len(found.bodies), (len(ids), limit, found)


def testABlockThatTwistsOnItsBase():
	"""The block twists about its middle, which cannot move: cohesion at the four corners bears c b³/√2, 1.85 times what it would over the
	face, as the page says."""
	block = blockOnSlope(0.0, (0.5, 0.5, 0.5), frictionAngle=0, cohesion=1e5)
	O.bodies[block].state.blockedDOFs = 'xyzXY'
	O.forces.setPermT(block, (0, 0, 4e4))
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, 1e5 / math.sqrt(2) / 4e4)
	assert found.bodies == [block] and found.rotations[0] == pytest.approx((0, 0, 0.04), abs=1e-3)


@pytest.mark.parametrize('engine', [False, True])
def testAJointThatTwistsBearsMoreAtItsCorners(engine):
	"""Friction on a floor, twisted by half of what it bears under an even pressure: the page says by how much the figure is too high. The moment of an engine counts
	as one that is given by O.forces."""
	block = blockOnSlope(0.0, (0.5, 0.5, 0.5))
	atCorners = math.sqrt(0.5)
	moment = (0, 0, math.tan(friction) * O.bodies[block].state.mass * gravity * meanArm / 2)
	if engine:
		O.engines = [*O.engines[:3], TorqueEngine(ids=[block], moment=moment), *O.engines[3:]]
	else:
		O.forces.setPermT(block, moment)
	found = polytope.limitAnalysis(tolerance=fine)
	expect(found, 2 * atCorners / meanArm)
	assert 2 * atCorners / meanArm == pytest.approx(3.696, abs=1e-3)


def testForcesOfEnginesCount():
	block = blockOnSlope(0.0, (0.5, 0.5, 0.1))
	weight = O.bodies[block].state.mass * gravity
	dead = ForceEngine(ids=[block], force=(weight, 0, 0), dead=True)
	O.engines = [*O.engines[:3], ForceEngine(ids=[block], force=(weight / 4, 0, 0)), dead, *O.engines[3:]]
	expect(polytope.limitAnalysis(tolerance=fine), 4 * math.tan(friction))
	O.engines = [*O.engines[:3], RadialForceEngine(ids=[block], fNorm=1), *O.engines[3:]]
	with pytest.warns(UserWarning, match='RadialForceEngine change'):
		polytope.limitAnalysis()


def testThePackageThatLacksIsNamed(monkeypatch):
	blockOnSlope(dip, (0.5, 0.5, 0.1))
	monkeypatch.setitem(sys.modules, 'cvxopt', None)
	with pytest.raises(ImportError, match='limitAnalysis needs the package python3-cvxopt; sudo apt install'):
		polytope.limitAnalysis()


@pytest.mark.parametrize(
	'grout, plate, end',
	[(None, True, -0.41)]
	+ [((1e9, strength, 2e4), plate, end) for strength in (1e5, 2e4) for plate, end in ((True, -0.41), (False, -0.9), (True, -1.5))],
)
def testABoltAcrossAJoint(grout, plate, end):
	"""A block on a slope with a bolt at a right angle to the joint: tan φ (W cos ψ + T) / (W sin ψ − V), T of steel or of the grout in rock
	below, or, without a plate, in the 0.8 m above, V of the dowel."""
	dip, yields, free = math.radians(40), 3e4, 0.02
	blockOnSlope(dip, (0.5, 0.5, 0.5), False, frictionAngle=math.radians(30))
	support = (
		{} if grout is None else dict(grout=polytope.Grout(*grout[:2]), dowel=polytope.Dowel(1e9, grout[2]), freeLength=free, plate=plate)
	)
	polytope.bolt((0, 0, 0.8), (0, 0, end), area=5e-4, youngsModulus=2e11, yieldForce=yields, **support)
	held = min(1, -end) - free / 2
	held = held if plate else min(held, 0.8 - free / 2)
	tension = yields if grout is None else min(yields, grout[1] * held)
	weight, dowel = float(O.bodies[1].state.mass) * gravity, 0 if grout is None else grout[2]
	theory = math.tan(math.radians(30)) * (weight * math.cos(dip) + tension) / (weight * math.sin(dip) - dowel)
	expect(polytope.limitAnalysis(tolerance=fine, most=100), theory)


def testBondsAreJointsOfTheirStrengths():
	"""A block on a slope: (W cos ψ tan φ + c A) / (W sin ψ); and one that hangs: σ A / W."""
	dip, cohesion = math.radians(50), 3e4
	blockOnSlope(dip, (0.5, 0.5, 0.5), False, frictionAngle=math.radians(10))
	polytope.bond(tensileStrength=1e6, cohesion=cohesion, frictionAngle=math.radians(35))
	weight = float(O.bodies[1].state.mass) * gravity
	expect(
		polytope.limitAnalysis(tolerance=fine), (weight * math.cos(dip) * math.tan(math.radians(35)) + cohesion) / (weight * math.sin(dip))
	)
	O.reset()
	blockMaterial()
	O.bodies.append(polytope.cuboid((0, 0, 1.5), (2, 2, 0.5), fixed=True))
	hanging = O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()
	weight = float(O.bodies[hanging].state.mass) * gravity
	polytope.bond(tensileStrength=1.4 * weight, cohesion=1e7, frictionAngle=0.5)
	expect(polytope.limitAnalysis(tolerance=fine), 1.4)


@pytest.mark.parametrize('asJoint', [False, True])
def testWhatHangsByABondThatHasOpenedIsHeld(asJoint):
	"""At rest a hanging block is farther from its roof than a millionth of its size; its factor is what it was, σ A/W."""
	strength = 1.4 * 5000 * gravity
	if asJoint:
		blockMaterial(tensileStrength=strength, cohesion=1e7)
	else:
		blockMaterial()
	O.bodies.append(polytope.cuboid((0, 0, 1.5), (2, 2, 0.5), fixed=True))
	hanging = O.bodies.append(polytope.cuboid((0, 0, 0.5 + (1e-9 if asJoint else 0)), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()
	weight = float(O.bodies[hanging].state.mass) * gravity
	if not asJoint:
		polytope.bond(tensileStrength=1.4 * weight, cohesion=1e7, frictionAngle=0.5)
	before = polytope.limitAnalysis(tolerance=fine)
	polytope.settle()
	assert O.bodies[hanging].state.pos[2] < 0.5 - 2e-6
	after = polytope.limitAnalysis(tolerance=fine)
	expect(before, strength / weight)
	expect(after, strength / weight)


def testASlabThatHangsByItsBoltsAlone():
	"""No face of it lies on another: four bolts of yield force W/2 hold it whatever divides strengths, for limits of bolts are not divided."""
	blockMaterial()
	O.bodies.append(polytope.cuboid((0, 0, 1), (3, 3, 1), fixed=True))
	slab = O.bodies.append(polytope.cuboid((0, 0, -0.55), (1, 1, 0.5)))
	O.engines = polytope.engines()
	weight = float(O.bodies[slab].state.mass) * gravity
	for x, y in ((-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)):
		polytope.bolt(
			(x, y, -1.05),
			(x, y, 1.5),
			area=4.9e-4,
			youngsModulus=2e11,
			yieldForce=0.5 * weight,
			grout=polytope.Grout(1e9, 1e7),
			dowel=polytope.Dowel(1e8, 1e5),
		)
	assert polytope.limitAnalysis().factor == math.inf
