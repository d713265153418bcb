# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks on joints so soft that they topple below their own angle: the closed form, what check() says of them, a block that is tilted."""

import pathlib
import sys
from math import atan, cos, degrees, pi, radians, sin

import numpy as np
import pytest
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, NewtonIntegrator, O, RockJointMat, polytope, utils
from yade.polytope.check.softJoints import stableTilt

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'))
from jointStudy.theory.toppling import elasticToppling

pytestmark = [pytest.mark.filterwarnings('ignore:soft joint'), pytest.mark.filterwarnings('ignore:gravity at once')]
density, g, width = 2000, 10, 10.0


def block(height=10.0, stiffness=1e7, flat=False, perArea=True, support=None, damping=0.2, **joint):
	"""3DEC's block of 10 m on its base; its number."""
	O.reset()
	O.materials.append(
		RockJointMat(**{**dict(density=density, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=radians(60)), **joint})
	)
	if flat:
		O.bodies.append(polytope.polygon([(-40, -10), (40, -10), (40, 0), (-40, 0)], fixed=True))
		number = O.bodies.append(polytope.polygon([(-5, 0), (5, 0), (5, height), (-5, height)]))
	else:
		O.bodies.append(support() if support else polytope.cuboid((0, 0, -5), (40, 40, 5), fixed=True))
		number = O.bodies.append(polytope.cuboid((0, 0, height / 2), (5, 5, height / 2)))
	physics = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)
	O.engines = polytope.engines(gravity=(0, -g * flat, -g * (not flat)), physics=physics, damping=damping)
	return number


def told():
	return [one for one in polytope.check(O) if one.what == 'soft joint']


def testTheClosedFormIsThatOfTheWedgeOfPressure():
	for ratio in (0.25, 0.4, 1.0):
		for softness in (1e-6, 1e-4, 1e-3, 1e-2):
			elastic, rigid = stableTilt([ratio], [softness])
			assert rigid[0] == pytest.approx(atan(ratio), rel=1e-12)
			assert elastic[0] == pytest.approx(atan(elasticToppling(ratio, 1.0, softness * ratio**2, 1.0)), abs=radians(0.01))
	assert stableTilt([1.0], [1e-12])[0][0] == pytest.approx(pi / 4, abs=radians(0.05))
	elastic, rigid = stableTilt([5.0, 50.0, 500.0], [1e-3] * 3)  # plates
	assert (elastic <= rigid).all() and np.isfinite(elastic).all()
	assert (np.diff(stableTilt([0.4] * 4, [1e-4, 1e-3, 1e-2, 1e-1])[0]) < 0).all()


@pytest.mark.parametrize('flat', [False, True])
@pytest.mark.parametrize('height, angles', [(10.0, ('45.0°', '37.3°')), (25.0, ('21.8°', '13.0°'))])
def testCheckTellsOf3DecsBlocks(height, angles, flat):
	number = block(height, flat=flat)
	(found,) = told()
	assert (
		f'body {number} stands on slopes of up to {angles[0]} where its joint is rigid, of {angles[1]} with a normalStiffness of 1e+07 Pa/m'
		in found.seen
	)
	needed = float(found.advice.split()[3])
	block(height, stiffness=needed, flat=flat)
	assert not told()
	block(height, stiffness=needed / 10, flat=flat)
	assert told()


def testCheckSaysNothingWhereNoAngleIsLost():
	for values in (
		dict(frictionAngle=radians(35)),  # slides before it topples
		dict(perArea=False, stiffness=1e9),  # presses as one spring
		dict(tensileStrength=1e6, residualCohesion=0),
		dict(stiffness=1e11),
	):
		block(**values)
		assert not told(), values
	block(frictionAngle=radians(35), cohesion=1e6)  # does not slide
	assert told()
	number = block()
	O.bodies[number].state.pos += (0, 0, 3)  # falls
	assert not told()
	number = block()
	O.bodies.append([polytope.cuboid((side * 10, 0, 5), (5, 5, 5), fixed=True) for side in (-1, 1)])  # held by its neighbours
	assert not told()


@pytest.mark.parametrize(
	'support',
	[
		lambda: utils.wall(0, 2),
		lambda: utils.box((0, 0, -1), (20, 20, 1), fixed=True),
		lambda: utils.facet([(-40, -40, 0), (40, -40, 0), (0, 60, 0)], fixed=True),
	],
)
def testOnYadesOwnSupports(support):
	block(support=support)
	assert told()


@pytest.mark.parametrize('flat', [False, True])
def testASoftBlockThatIsTiltedTopplesNearItsAngle(flat):
	"""Slowly, with strong damping. The face's pressure, which falls to zero at its rim, takes half a degree more at most."""
	number = block(flat=flat, damping=0.8)
	limit = degrees(stableTilt([1.0], [density * g / 1e7])[0][0])
	newton = next(engine for engine in O.engines if isinstance(engine, NewtonIntegrator))
	state = O.bodies[number].state

	def tilt(angle):
		newton.gravity = (g * sin(radians(angle)), -g * cos(radians(angle)) * flat, -g * cos(radians(angle)) * (not flat))
		for _ in range(200):
			O.run(300, wait=True)
			if state.vel.norm() < 1e-5 or state.ori.toAxisAngle()[1] > radians(40):
				break
		return degrees(state.ori.toAxisAngle()[1])

	for angle in (*np.arange(0, limit - 4, 4), limit - 4, limit - 2, limit - 1):
		assert tilt(angle) < 15, angle
	assert tilt(limit + 0.5) > 39
