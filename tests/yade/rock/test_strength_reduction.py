# SPDX-License-Identifier: GPL-2.0-or-later
"""Factor of safety by dividing all strengths: blocks with a closed form."""

from math import atan, cos, inf, radians, sin, tan

import pytest
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, MatchMaker, O, RockJointMat, polytope
from yade.polytope.frictionReduction import FrictionReduction
from yade.polytope.strengthReduction import StrengthReduction, divideStrengths

gravity, stiffness = 9.81, 1e9
weight = 1000 * gravity
"""Weight of a block of 0.2 m³ [N]: so flat that all of its face is pressed on a slope of 40°."""


def rock(density=5000, **strength):
	return O.materials.append(RockJointMat(density=density, normalStiffness=stiffness, shearStiffness=stiffness, **strength))


def slope(dip, blocks, perArea=True, half=0.1):
	"""Blocks of 1 m² and 1000 kg side by side on a slope, each of a material that it shares with what is under it. Their ids."""
	numbers = []
	for k, strength in enumerate(blocks):
		made = rock(500 / half, **strength)
		O.bodies.append(polytope.cuboid((0, 3 * k, -0.5), (3, 1, 0.5), fixed=True, material=made))
		numbers.append(O.bodies.append(polytope.cuboid((0, 3 * k, half), (0.5, 0.5, half), material=made)))
	physics = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)
	O.engines = polytope.engines(gravity=(gravity * sin(dip), 0, -gravity * cos(dip)), physics=physics, damping=0.4)
	return numbers


@pytest.mark.parametrize('perArea', [True, False])
@pytest.mark.parametrize('residual', [0, inf])
@pytest.mark.filterwarnings('ignore:gravity at once')
def testABlockOnASlopeWithCohesion(residual, perArea):
	"""Brittle or plastic: (W cos α tan φ + c A) / (W sin α)."""
	dip, friction, cohesion = radians(40), radians(30), 6e3
	numbers = slope(dip, [dict(frictionAngle=friction, cohesion=cohesion, residualCohesion=min(residual, cohesion))], perArea)
	polytope.settle()
	found = StrengthReduction(numbers).run()
	factor = (weight * cos(dip) * tan(friction) + cohesion) / (weight * sin(dip))
	assert found.stable < factor < found.failed and found.failed - found.stable == pytest.approx(0.02)
	assert found.factor == pytest.approx(factor, abs=0.01) and found.failedQueries == 0
	assert [stage.outcome for stage in found.stages].count('failed') == 2


@pytest.mark.filterwarnings('ignore:gravity at once')
def testCohesionActsOnWhatIsPressed():
	"""The weight of a block half as high as wide acts outside the middle third of the base: three times the way from there to the lower
	edge is pressed."""
	dip, friction, cohesion = radians(40), radians(30), 6e3
	numbers = slope(dip, [dict(frictionAngle=friction, cohesion=cohesion, residualCohesion=cohesion)], half=0.25)
	polytope.settle()
	found = StrengthReduction(numbers).run()
	pressed = 3 * (0.5 - 0.25 * tan(dip))
	factor = (weight * cos(dip) * tan(friction) + cohesion * pressed) / (weight * sin(dip))
	assert factor == pytest.approx(1.516, abs=1e-3) and found.factor == pytest.approx(factor, abs=0.02)


def testTheWeakestOfSeveralMaterialsFails():
	numbers = slope(radians(20), [dict(frictionAngle=radians(angle)) for angle in (40, 30)])
	reduction = StrengthReduction(numbers)
	found = reduction.run()
	assert found.factor == pytest.approx(tan(radians(30)) / tan(radians(20)), abs=0.01)
	start = O.bodies[numbers[0]].state.pos[0]
	assert O.bodies[numbers[1]].state.pos[0] > start + 0.01
	reduction.restore()
	for material, angle in zip(O.materials, (40, 30), strict=True):
		assert float(material.frictionAngle) == pytest.approx(atan(tan(radians(angle)) / found.stable), rel=1e-9)
	assert O.bodies[numbers[1]].state.pos[0] < start + 0.001


@pytest.mark.parametrize('bonded', [False, True])
@pytest.mark.filterwarnings('ignore:gravity at once')
def testABlockThatHangs(bonded):
	"""The block hangs by its joint's tensile strength or by a bond: σ A / W."""
	strength = 25e3
	rock(**({} if bonded else dict(tensileStrength=strength, cohesion=1e6)))
	O.bodies.append(polytope.cuboid((0, 0, 0.5), (1, 1, 0.5), fixed=True))
	block = O.bodies.append(polytope.cuboid((0, 0, -0.1 + (0 if bonded else 1e-5)), (0.5, 0.5, 0.1)))
	O.engines = polytope.engines(gravity=(0, 0, -gravity), damping=0.4)
	if bonded:
		polytope.bond(tensileStrength=strength, cohesion=1e6, frictionAngle=0.5)
	polytope.settle()
	found = StrengthReduction([block], steps=(0.2, 0.05), stableSpeed=1e-6).run()
	assert found.stable < strength / weight < found.failed


def testWhatIsRefused():
	(number,) = slope(radians(35), [dict(frictionAngle=radians(30))])
	for arguments, words in (
		({'bodies': []}, 'bodies: '),
		({'bodies': [99]}, 'bodies: there is no body 99'),
		({'steps': []}, 'steps: '),
		({'steps': (0.1, 0.2)}, 'steps: '),
		({'most': 1}, 'most: '),
		({'mostSteps': 0}, 'mostSteps: '),
	):
		with pytest.raises(ValueError, match=f'^{words}'):
			StrengthReduction(**{'bodies': [number], **arguments})
	with pytest.raises(ValueError, match='^steps: must be angles in radians below the start'):
		FrictionReduction([number], start=radians(60), steps=[5, 1])
	with pytest.raises(RuntimeError, match='not stable with its own strengths: failed'):
		StrengthReduction([number]).run()
	for factor in (0, -1, inf):
		with pytest.raises(ValueError, match='^factor: '):
			divideStrengths(factor)
	O.engines[2].physDispatcher.functors[0].frictAngle = MatchMaker(val=0.5)
	with pytest.raises(ValueError, match='^frictAngle: '):
		divideStrengths(2)


def testASceneThatStandsAnyway():
	numbers = slope(0, [dict(frictionAngle=radians(30))])
	with pytest.raises(RuntimeError, match='stable with strengths divided by 3'):
		StrengthReduction(numbers, steps=(1,), most=3).run()
