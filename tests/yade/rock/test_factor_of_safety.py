# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.factorOfSafety against closed forms, and that it leaves the scene as it was."""

import math
import pathlib

import numpy as np
import pytest
from rockScenes import across, along, blockMaterial, blockOnSlope, dip, friction, gravity, gravityOnSlope, meanArm
from scipy.optimize import brentq
from yade import FrictMat, NewtonIntegrator, O, PyRunner, TorqueEngine, Vector3, polytope
from yade.polytope.scene.permanentLoads import permanentLoads
from yade.polytope.strengthReduction import divideStrengths


def onSlope(dip, half, flat=False, **joint):
	"""A block on a slope, at rest."""
	block = blockOnSlope(dip, half, flat, **joint)
	for k in (0, 1):
		O.bodies[k].state.pos -= Vector3(*gravityOnSlope(dip, flat)) * (k * 1e-9)  # in touch
	polytope.settle()
	return block


@pytest.mark.filterwarnings('ignore:gravity at once')
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
	block = onSlope(dip, (0.5, 0.5, 0.1), flat, cohesion=6e3)
	found = polytope.factorOfSafety(reduce=reduce)
	assert found.stable <= theory * 1.003 and found.failed >= theory * 0.997
	assert found.factor == pytest.approx(theory, rel=0.01) and found.failed / found.stable <= 1.0101
	assert found.bodies == [block] and found.directions[0] == pytest.approx((1, 0, 0), abs=1e-3)
	assert 0.25 * 0.02 * 0.46 < np.linalg.norm(found.displacements[0]) < 0.1 and np.abs(found.rotations).max() < 1e-2


def holds(found, theory, tolerance, rest=1 / 20):
	"""Whether the bracket has the closed form in it, to this part of the tolerance, by default that at which blocks are at rest, and is as
	narrow as was asked."""
	rest = tolerance * rest
	return found.stable * (1 - rest) < theory < found.failed * (1 + rest) and found.failed / found.stable <= 1 + tolerance


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('theory', [0.62, 0.75, 0.8245, 0.9, 0.95, 1.005, 1.03])
@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('share', [0, 0.5, 1])
def testTheBracketOfPlaneFailureHoldsTheClosedForm(share, flat, theory):
	"""*share*: of cohesion in the strength."""
	joint = {'cohesion': share * theory * along, 'frictionAngle': math.atan((1 - share) * theory * along / across)}
	onSlope(dip, (0.5, 0.5, 0.1), flat, **joint)
	assert holds(polytope.factorOfSafety(tolerance=0.02), theory, 0.02, rest=0)


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('weak', [0, 1])
def testBlocksOnASlopeThatSwingIfStrengthFallsAtOnce(weak):
	"""Twelve blocks, on a bedding through the toe of a face, with soft joints: a trial from far below the limit fails there by the swing
	alone. From larger strengths than the limit's, and from smaller ones."""
	steep, angle = math.radians(35), math.radians((45, 30)[weak])
	blockMaterial(density=2600, normalStiffness=1e8, shearStiffness=5e7, frictionAngle=angle)
	face = math.radians(65)
	region = [(math.sin(face), math.cos(face)), (0, 1), (-1, 0), (-math.sin(steep), -math.cos(steep))]
	sets = [
		polytope.JointSet(steep, math.pi / 2, 2, through=(0, 0, 0)),
		polytope.JointSet(math.radians(80), 1.5 * math.pi, 3),
	]
	O.bodies.append(polytope.polygon([(0, 0), (-30, 30 * math.tan(steep)), (-30, -3), (0, -3)], fixed=True))
	assert len(polytope.jointedRock(region, [0, 10, 25, 0], sets).append()) == 12
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	polytope.settle(densityScaling=True)
	assert holds(polytope.factorOfSafety(tolerance=0.02), math.tan(angle) / math.tan(steep), 0.02)


@pytest.mark.filterwarnings('ignore:gravity at once')
def testOnSoftJointsABlockLeansAndCarriesASteeperOne():
	"""A block turns by M/(kₙ I) against the one below. So the joint between two, in the middle between their faces, is steeper: tan
	φ/tan(35° + θ). In the plane, of unit width."""
	steep, angle, high, soft = math.radians(35), math.radians(30), 0.3, 1e7
	blockMaterial(density=2600, normalStiffness=soft, shearStiffness=soft, frictionAngle=angle)
	O.bodies.append(polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True))
	for k in (0, 1):
		O.bodies.append(polytope.polygon([(-0.5, k * high), (0.5, k * high), (0.5, (k + 1) * high), (-0.5, (k + 1) * high)]))
	O.engines = polytope.engines(gravity=gravityOnSlope(steep, True))
	polytope.settle()
	lower, upper = (2600 * gravity * math.sin(steep) * (n * high) ** 2 / 2 / (soft / 12) for n in (2, 1))
	leans = lower + upper / 2
	assert math.degrees(leans) == pytest.approx(0.204, abs=1e-3)
	found = polytope.factorOfSafety()
	assert holds(found, math.tan(angle) / math.tan(steep + leans), 0.01)
	assert found.failed < math.tan(angle) / math.tan(steep)


@pytest.mark.filterwarnings('ignore:gravity at once')
def testABlockThatTremblesInPlaceStands():
	"""A force that changes its sign every 20 steps, larger than what counts as rest; it is named."""
	block = onSlope(dip, (0.5, 0.5, 0.1), cohesion=6e3)
	push = PyRunner(command=f'O.forces.addF({block}, Vector3(0, 100 * (-1) ** (O.iter // 20), 0))', iterPeriod=1)
	O.engines = O.engines[:3] + [push] + O.engines[3:]
	with pytest.warns(UserWarning, match=f'bodies: {block} tremble in place by more than 0.001 of what they bear'):
		found = polytope.factorOfSafety(tolerance=0.05)
	assert found.stable < (across * math.tan(friction) + 6e3) / along < found.failed
	assert [trial.trembling for trial in found.trials if trial.outcome == 'stable'][-1] == [block]


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('theory', [0.62, 0.75, 0.8245, 0.9, 0.95, 1.005, 1.03, 1.7])
def testTopplingOfAColumnHeldByTheTensionOfItsBase(theory, flat):
	"""It parts where the beam formula's stress at the edge is the strength: σ = 6 M/b² − N/b, of unit width."""
	wide, high, steep = 0.5, 1.0, math.radians(40)
	load = 5000 * gravity * wide * high
	stress = 6 * load * math.sin(steep) * high / 2 / wide**2 - load * math.cos(steep) / wide
	joint = {'tensileStrength': theory * stress, 'cohesion': 1e7, 'frictionAngle': math.radians(60)}
	block = onSlope(steep, (wide / 2, 0.5, high / 2), flat, normalStiffness=1e10, shearStiffness=1e10, **joint)
	found = polytope.factorOfSafety(tolerance=0.02)
	assert holds(found, theory, 0.02)
	assert found.bodies == [block]
	turn = found.rotations[0] @ ((0, 0, -1) if flat else (0, 1, 0))  # forwards, about the foot
	assert turn == pytest.approx(np.linalg.norm(found.displacements[0]) / math.hypot(wide / 2, high / 2), rel=0.05)


def normalOf(joint):
	return np.array(polytope.JointSet(math.radians(joint[0]), math.radians(joint[1]), 1).normal)


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('shearStiffness', [1e9, 1e8, 1e5])
@pytest.mark.parametrize('theory', [0.62, 0.8245, 0.95, 1.005, 1.877])
def testTheWedgeOfHoekAndBray(theory, shearStiffness):
	"""Two joints of 24 kPa, 20° and 48 kPa, 30°, or a part of these strengths, perfectly plastic; slides along their line of intersection."""
	one, two, face, top = map(normalOf, ((45, 105), (70, 235), (65, 185), (12, 195)))
	part = theory / 1.877
	for label, cohesion, angle in (('A', part * 24e3, 20), ('B', part * 48e3, 30), ('W', 1e9, 80)):
		blockMaterial(
			label=label,
			density=2600,
			shearStiffness=shearStiffness,
			frictionAngle=math.atan(part * math.tan(math.radians(angle))),
			cohesion=cohesion,
			residualCohesion=cohesion,
		)
	line = np.cross(one, two)
	line *= -np.sign(line[2]) / np.linalg.norm(line)
	up = np.array([-face[0] * face[2], -face[1] * face[2], 1 - face[2] ** 2])
	box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	O.bodies.append(polytope.fromHalfSpaces([one, *box], [0] + [200] * 6, material='A', fixed=True))
	O.bodies.append(polytope.fromHalfSpaces([two, -one, *box], [0, 0] + [200] * 6, material='B', fixed=True))
	wedge = O.bodies.append(polytope.fromHalfSpaces([-one, -two, face, top], [0, 0, 0, float(top @ (30 * up / up[2]))], material='W'))
	O.engines = polytope.engines()
	polytope.settle()
	found = polytope.factorOfSafety()
	assert found.factor == pytest.approx(theory, rel=0.01)
	assert found.bodies == [wedge] and found.directions[0] @ line > 0.999


@pytest.mark.filterwarnings('ignore:gravity at once')
def testOfSeveralBlocksTheWeakerMoves():
	"""Side by side, with cohesions of factors of safety 1.4 and 1.9; the stronger one is not part of the mode."""
	blockMaterial()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (9, 9, 0.5), fixed=True, material=0))
	O.materials[0].cohesion = 1e6
	for k, factor in enumerate((1.9, 1.4)):
		blockMaterial(cohesion=factor * along - across * math.tan(friction))
		O.bodies.append(polytope.cuboid((0, 3 * k, 0.1), (0.5, 0.5, 0.1), material=k + 1))
	O.engines = polytope.engines(gravity=(gravity * math.sin(dip), 0, -gravity * math.cos(dip)))
	polytope.settle()
	assert polytope.factorOfSafety().factor == pytest.approx(1.4, rel=0.01)
	found = polytope.factorOfSafety(bodies=[1])
	assert found.factor == pytest.approx(1.9, rel=0.01) and found.bodies == [1]


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('bonded', [False, True])
def testWhatHangsByTension(bonded):
	"""A block of 1 m³ under a roof, by its joint and by a bond: σ A/W."""
	strength = 1.6 * 5000 * gravity
	blockMaterial(**({} if bonded else {'tensileStrength': strength, 'cohesion': 1e7}))
	O.bodies.append(polytope.cuboid((0, 0, 1.5), (2, 2, 0.5), fixed=True))
	hanging = O.bodies.append(polytope.cuboid((0, 0, 0.5 + 1e-7), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()
	if bonded:
		polytope.bond(tensileStrength=strength, cohesion=1e7)
	polytope.settle()
	found = polytope.factorOfSafety()
	assert found.factor == pytest.approx(1.6, rel=0.01)
	assert found.bodies == [hanging] and found.directions[0] == pytest.approx((0, 0, -1), abs=1e-3)
	endless = polytope.factorOfSafety(reduce=('friction', 'cohesion'), most=3)
	assert endless.factor == math.inf and endless.stable == 3 and endless.bodies == []
	assert all(trial.outcome == 'stable' for trial in endless.trials)


def limitOfTwoBlocks(upper, lower, steep, gentle, angle):
	"""Factor at which a block on a steep plane pushes another one along a gentle one, with a vertical joint between them: all three joints
	at their strength.

	:param upper, lower: weights
	"""

	def missing(factor):
		t = math.tan(angle) / factor
		s, c = math.sin(steep), math.cos(steep)
		# of the upper block with the normal force N: thrust P = N (s - t c), and N (c + t s) + t P = its weight
		normal = upper / (c + t * s + t * (s - t * c))
		thrust = normal * (s - t * c)
		s, c = math.sin(gentle), math.cos(gentle)
		return thrust + (lower + t * thrust) / (c + t * s) * (s - t * c)

	return brentq(missing, 0.5, 5)


def pushing(angle):
	"""Two blocks at rest, in the plane; (steep, gentle) of their planes. The joint between the blocks ends above the kink, where the upper
	one would be held by the gentle plane."""
	steep, gentle, high, long, above = math.radians(50), math.radians(10), 1.0, 2.0, 0.05
	back, down, along = high / math.tan(steep), math.tan(gentle), above / math.tan(steep)
	blockMaterial(density=2600, frictionAngle=math.radians(angle), normalStiffness=1e10, shearStiffness=1e10)
	O.bodies.append(polytope.polygon([(0, 0), (-1.5 * back, 1.5 * high), (-1.5 * back, -1), (0, -1)], fixed=True))
	O.bodies.append(polytope.polygon([(0, 0), (2 * long, -2 * long * down), (2 * long, -2), (0, -2)], fixed=True))
	O.bodies.append(polytope.polygon([(-along, above), (-along, high), (-back, high)]))
	O.bodies.append(polytope.polygon([(0, 0), (-along, above), (-along, high), (long, high), (long, -long * down)]))
	O.engines = polytope.engines()
	polytope.settle(elastic=False)
	return steep, gentle


@pytest.mark.parametrize('angle', [30, 35])
def testABlockThatPushesAnother(angle):
	"""None of the three joints decides alone."""
	steep, gentle = pushing(angle)
	found = polytope.factorOfSafety(tolerance=0.005)
	weights = [O.bodies[k].state.mass * gravity for k in (2, 3)]
	assert found.factor == pytest.approx(limitOfTwoBlocks(*weights, steep, gentle, math.radians(angle)), rel=0.01)
	assert sorted(found.bodies) == [2, 3]
	ways = dict(zip(found.bodies, found.directions, strict=True))
	assert ways[2] == pytest.approx((math.cos(steep), -math.sin(steep), 0), abs=0.05)
	assert ways[3] == pytest.approx((math.cos(gentle), -math.sin(gentle), 0), abs=0.05)


def settled(**joint):
	block = onSlope(dip, (0.5, 0.5, 0.1), cohesion=6e3, **joint)
	O.forces.setPermF(block, (1, 2, 3))
	O.engines[-1].label = 'last'
	return block


@pytest.mark.filterwarnings('ignore:gravity at once')
def testTheSceneIsWhatItWas():
	block = settled()

	def state():
		O.forces.f(0, sync=True)  # before that YADE does not know what it was given
		one, joint = O.bodies[block].state, O.interactions[0, block].phys
		return (
			O.iter,
			O.time,
			one.pos,
			one.ori,
			Vector3(one.vel),
			O.forces.permF(block),
			joint.cohesion,
			Vector3(joint.shearForce),
			O.materials[0].cohesion,
			[getattr(engine, 'damping', None) for engine in O.engines],
		)

	before = state()
	polytope.factorOfSafety(tolerance=0.1)
	assert state() == before
	assert polytope.factorOfSafety(reduce=['cohesion'], most=1.2).factor == math.inf
	assert state() == before


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize(
	'joint, theory', [({}, math.tan(friction) / math.tan(dip)), ({'cohesion': 5e2}, (across * math.tan(friction) + 5e2) / along)]
)
def testAFactorBelowOneIsFoundFromLargerStrengths(joint, theory):
	block = onSlope(dip, (0.5, 0.5, 0.1), **joint)
	before = O.bodies[block].state.pos
	found = polytope.factorOfSafety()
	assert theory < 0.8 and found.factor == pytest.approx(theory, rel=0.005)
	assert found.stable < theory < found.failed and found.bodies == [block] and found.directions[0] == pytest.approx((1, 0, 0), abs=1e-3)
	assert (found.trials[0].factor, found.trials[0].outcome) == (1, 'failed')
	assert O.bodies[block].state.pos == before and O.materials[0].frictionAngle == friction


@pytest.mark.filterwarnings('ignore:gravity at once')
def testASceneThatDoesNotStandWithLargerStrengthsIsRefused():
	block = onSlope(dip, (0.5, 0.5, 0.1))
	before = O.bodies[block].state.pos
	with pytest.raises(
		RuntimeError, match=r'own strengths \(failed.*\), nor with 20 times cohesion; polytope\.settle\(\) first.*other strengths'
	):
		polytope.factorOfSafety(reduce=['cohesion'])
	assert O.bodies[block].state.pos == before and O.materials[0].frictionAngle == friction


@pytest.mark.filterwarnings('ignore:gravity at once')
def testASceneThatFailsByItsFirstSwingAloneIsRefused():
	"""Its brittle joint would bear 1.05 times the load, and not that of gravity at once: no factor below 1."""
	blockMaterial(frictionAngle=0, cohesion=1.05 * along)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid((0, 0, 0.1), (0.5, 0.5, 0.1)))
	O.engines = polytope.engines(gravity=(gravity * math.sin(dip), 0, -gravity * math.cos(dip)))
	O.bodies[block].state.pos -= Vector3(0, 0, 1e-6)
	O.run(1, wait=True)
	with pytest.raises(RuntimeError, match=r'from a state at rest, and fails from the one that it is in; polytope.settle\(\) first'):
		polytope.factorOfSafety()


@pytest.mark.filterwarnings('ignore:gravity at once')
def testABoltThatYieldsHoldsAsFarAsTheBlockMayMove():
	"""Grouted, without pretension; the steel yields over its free length, and turns with the way u along the joint: T acts by u/√(u² + l²)
	along it. It fails at u = size/50."""
	steep, angle, free, yields, load = math.radians(38), math.radians(42), 0.1, 3e4, 2500 * gravity * 2
	blockMaterial(density=2500, normalStiffness=2e9, shearStiffness=2e9, frictionAngle=angle)
	O.bodies.append(polytope.cuboid((0, 0, -3), (20, 5, 3), fixed=True))
	block = O.bodies.append(polytope.cuboid((0, 0, 0.5), (1, 0.5, 0.5)))
	O.engines = polytope.engines(gravity=(gravity * math.sin(steep), 0, -gravity * math.cos(steep)))
	polytope.bolt(
		(0, 0, 1), (0, 0, -2), area=4.9e-4, youngsModulus=2e11, yieldForce=yields, freeLength=free, grout=polytope.Grout(1e9, 4e5)
	)
	polytope.settle()
	found = polytope.factorOfSafety(tolerance=0.05)
	way = 2 ** (1 / 3) / 50
	turned = math.hypot(way, free)
	theory = (load * math.cos(steep) + yields * free / turned) * math.tan(angle) / (load * math.sin(steep) - yields * way / turned)
	assert theory == pytest.approx(2.667, rel=1e-3) and found.factor == pytest.approx(theory, rel=0.02)
	assert np.linalg.norm(found.displacements[0]) == pytest.approx(way, rel=0.03) and found.bodies == [block]
	assert found.trials[-1].displacement < 1.1 * way


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('inclination', [90, 80])
@pytest.mark.parametrize('without', [0.85, 1.05])
def testAPassiveBoltAcrossTheJoint(without, inclination):
	"""Without grout; at a right angle to the joint it bears nothing before the block has moved, and its yield force after 11 mm, of 16 mm
	that it may move. The closed form of docs/support.md."""
	steep, lean, load = math.radians(38), math.radians(inclination), 2600 * gravity * 0.5
	yields = 0.2 * load
	blockMaterial(density=2600, shearStiffness=5e8, frictionAngle=math.atan(without * math.tan(steep)))
	O.bodies.append(polytope.cuboid((0, 0, -1.5), (3, 2, 1.5), fixed=True))
	block = O.bodies.append(polytope.cuboid((0, 0, 0.25), (0.5, 0.5, 0.25)))
	O.engines = polytope.engines(gravity=gravityOnSlope(steep))
	down = Vector3(-math.cos(lean), 0, -math.sin(lean))
	polytope.bolt(down * (-0.4995 / math.sin(lean)), down, area=4.9e-4, youngsModulus=2e11, yieldForce=yields)
	polytope.settle()
	found = polytope.factorOfSafety()
	held = load * math.cos(steep) + yields * math.sin(lean)
	theory = held * without * math.tan(steep) / (load * math.sin(steep) - yields * math.cos(lean))
	assert found.factor == pytest.approx(theory, rel=0.01) and found.bodies == [block]


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize(
	'name, value',
	[
		('tolerance', 0),
		('tolerance', math.nan),
		('most', 1),
		('steps', 10),
		('reduce', 'friction'),
		('reduce', ['weight']),
		('reduce', []),
		('bodies', [7]),
		('bodies', []),
	],
)
def testBadArgumentsAreNamed(name, value):
	settled()
	cohesion = O.materials[0].cohesion
	with pytest.raises(ValueError, match=f'^{name}: '):
		polytope.factorOfSafety(**{name: value})
	assert O.materials[0].cohesion == cohesion


@pytest.mark.filterwarnings('ignore:gravity at once')
def testPictureAndText(tmp_path):
	block = settled()
	found = polytope.factorOfSafety(tolerance=0.2)
	assert str(found).startswith('factor of safety 1.') and f'body {block} by 0.01' in str(found) and 'towards (1.00' in str(found)
	path = pathlib.Path(tmp_path) / 'mode.png'
	found.picture(path)
	assert path.read_bytes()[:4] == b'\x89PNG'


def besideAStop(gap):
	"""A block that would slide at a factor of 1.2, and a wall this far down the slope from it."""
	steep = math.radians(30)
	blockMaterial(frictionAngle=math.atan(1.2 * math.tan(steep)))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 3, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
	O.bodies.append(polytope.cuboid((1.5 + gap, 0, 0.5), (1, 1, 0.5), fixed=True))
	O.engines = polytope.engines(gravity=(gravity * math.sin(steep), 0, -gravity * math.cos(steep)))
	polytope.settle()
	return block


@pytest.mark.parametrize('gap', [0.008, 0.012])
def testABlockThatMovesAndIsStoppedBeforeItsLimitStands(gap):
	"""The block's limit is 0.02 m. It would have failed without the wall, and has moved faster and faster."""
	besideAStop(gap)
	assert polytope.factorOfSafety(most=2).factor == math.inf


def testABlockThatIsStoppedBehindItsLimitHasFailed():
	block = besideAStop(0.03)
	found = polytope.factorOfSafety()
	assert found.factor == pytest.approx(1.2, rel=0.01) and found.bodies == [block]
	assert max(np.linalg.norm(way) for way in found.displacements) < 0.01  # it was seen before a fiftieth of its size
	assert max(trial.steps for trial in found.trials) < 3000


@pytest.mark.parametrize('angle', [30, 35])
def testTheAnswerIsThatOfTrialsFromTheFirstState(angle):
	"""What stands and what fails at the ends of the bracket does so from the scene's own strengths at once, too."""
	pushing(angle)
	integrator = NewtonIntegrator(gravity=(0, -gravity, 0), damping=0.4)
	O.engines = [integrator if isinstance(engine, NewtonIntegrator) else engine for engine in O.engines]
	found = polytope.factorOfSafety()
	assert len([trial for trial in found.trials if trial.outcome == 'stable']) > 2
	O.saveTmp('first', quiet=True)
	for factor, stands in ((found.stable, True), (found.failed, False)):
		O.loadTmp('first', quiet=True)
		before = np.array([O.bodies[k].state.pos for k in (2, 3)], float)
		divideStrengths(factor)
		ways = []
		for _ in range(20):
			O.run(1500, wait=True)
			ways.append(np.linalg.norm(np.array([O.bodies[k].state.pos for k in (2, 3)], float) - before, axis=1).max())
		assert ways[-1] < 1.01 * ways[9] if stands else ways[-1] > 2 * ways[9] > 2e-3, ways


@pytest.mark.filterwarnings('ignore:gravity at once')
def testTheAnswerIsThatOfASceneThatWasWeakenedBefore():
	theory = (across * math.tan(friction) + 6e3) / along
	onSlope(dip, (0.5, 0.5, 0.1), cohesion=6e3)
	divideStrengths(1.4)
	polytope.settle(elastic=False)
	assert 1.4 * polytope.factorOfSafety().factor == pytest.approx(theory, rel=0.01)


def testBodiesWithoutStrengthsToReduceAreRefused():
	O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=math.radians(35)))
	floor = O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()
	with pytest.raises(ValueError, match='they are of FrictMat'):
		polytope.factorOfSafety()
	with pytest.raises(ValueError, match=f'body {floor} cannot move'):
		polytope.factorOfSafety(bodies=[floor])


def onAThinPlate(ownStep):
	"""A block on a plate of a fiftieth of its height; it and the plate slide on a plane of 20°."""
	O.reset()
	steep = math.radians(20)
	blockMaterial()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 3, 0.5), fixed=True))
	for low, high in ((0, 0.02), (0.02, 1.02)):
		O.bodies.append(polytope.cuboid((0, 0, (low + high) / 2), (1, 1, (high - low) / 2)))
	O.engines = polytope.engines(
		gravity=(gravity * math.sin(steep), 0, -gravity * math.cos(steep)), **({'timeStepper': False} if ownStep else {})
	)
	O.dt = 0.4 * polytope.stableTimeStep(1)
	polytope.settle()
	return math.tan(friction) / math.tan(steep)


def testBodiesThatLimitTheStepAreHeavierInTrials():
	"""Where the scene's step is the script's own, they are not: the factor is the same in more steps."""
	steps = {}
	for ownStep in (False, True):
		theory = onAThinPlate(ownStep)
		step, masses, places = O.dt, [body.state.mass for body in O.bodies], [body.state.pos for body in O.bodies]
		found = polytope.factorOfSafety()
		assert found.factor == pytest.approx(theory, rel=0.01) and found.stable < theory < found.failed
		assert [body.state.mass for body in O.bodies] == masses and [body.state.pos for body in O.bodies] == places
		assert not permanentLoads() and O.dt == step
		steps[ownStep] = sum(trial.steps for trial in found.trials)
	assert steps[False] < 0.6 * steps[True]


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('twist', [1.5, 0.5])
@pytest.mark.parametrize('engine', [False, True])
def testABlockThatOnlySpinsFails(twist, engine):
	"""*twist*: of what friction bears under an even pressure. Its centre stays where it is, and no force lacks."""
	blockMaterial(density=2600, normalStiffness=1e9, shearStiffness=1e9)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid((0, 0, 0.2), (0.5, 0.5, 0.2)))
	O.engines = polytope.engines(gravity=(0, 0, -gravity))
	moment = (0, 0, twist * math.tan(friction) * O.bodies[block].state.mass * gravity * meanArm)
	if engine:
		O.engines = [*O.engines[:3], TorqueEngine(ids=[block], moment=moment), *O.engines[3:]]
	else:
		O.forces.setPermT(block, moment)
	polytope.settle()
	found = polytope.factorOfSafety()
	assert holds(found, 1 / twist, 0.01, rest=0.1)
	assert found.bodies == [block] and found.rotations[0][2] > 0.04 and np.abs(found.rotations[0][:2]).max() < 1e-3
	assert f'body {block} turns by ' in str(found) and '° about (0.00, 0.00, 1.00)' in str(found).replace('-0.00', '0.00')
