# SPDX-License-Identifier: GPL-2.0-or-later
"""A prism in a roof, held by the stress that was there before the rock below it was taken away; default settings, in space as in the plane."""

from math import cos, radians, sin, tan

import numpy as np
import pytest
from yade import NewtonIntegrator, O, RockJointMat, Vector3, polytope

gravity, density = 9.81, 2600
angle, height, far = radians(20), 5.0, 6.0
"""Angle of the prism's faces from the vertical; height of the prism, and distance from its middle to the ends of the rock at its sides [m]."""
friction, normalStiffness, shearStiffness, stress = radians(35), 1e10, 1e9, 5e5
"""Stiffnesses in Pa/m; horizontal stress in Pa."""
half = height * tan(angle)
everyDepth = pytest.mark.parametrize('dimension, depth', [(2, 1), (3, 1), (3, 5), (3, 20)])
twoDepths = pytest.mark.parametrize('dimension, depth', [(2, 1), (3, 5)])


class Face:
	"""One face of the prism while nothing slips; all for a metre of depth."""

	normal, shear = (stiffness * height / cos(angle) for stiffness in (normalStiffness, shearStiffness))

	def __init__(self, force, sheared):
		"""Normal and shear force [N/m]; the latter lifts the prism."""
		self.force, self.sheared = force, sheared

	@classmethod
	def inSitu(cls):
		"""The rock at the sides is pushed by x against the prism, which that presses down on the floor by v: equilibrium of both."""
		closure, slip = np.array([cos(angle), -sin(angle)]), np.array([sin(angle), cos(angle)])
		floor = normalStiffness * 2 * half
		normal, shear = cls.normal * closure, cls.shear * slip
		equations = [normal * cos(angle) + shear * sin(angle), 2 * (normal * sin(angle) - shear * cos(angle)) - [0, floor]]
		moved = np.linalg.solve(equations, [stress * height, 0])
		return cls(normal @ moved, shear @ moved)

	def lowered(self, way):
		return Face(self.force - self.normal * sin(angle) * way, self.sheared + self.shear * cos(angle) * way)

	@property
	def lift(self):
		"""What both faces bear of the prism's weight."""
		return 2 * (self.sheared * cos(angle) - self.force * sin(angle))

	def under(self, weight):
		return self.lowered((weight - self.lift) / (2 * (self.shear * cos(angle) ** 2 + self.normal * sin(angle) ** 2)))

	def strength(self):
		"""Largest weight that they bear."""
		way = (self.force * tan(friction) - self.sheared) / (self.shear * cos(angle) + self.normal * sin(angle) * tan(friction))
		return self.lowered(way).lift


class Roof:
	"""The prism between the rock at its sides, which is fixed once the floor is gone."""

	def __init__(self, dimension, depth, steps):
		"""*steps*: in which the floor's force is taken away; 0: at once."""
		O.materials.append(
			RockJointMat(density=density, normalStiffness=normalStiffness, shearStiffness=shearStiffness, frictionAngle=friction)
		)
		self.dimension, self.depth = dimension, depth
		self.prism = self._body([(-half, 0), (half, 0), (0, height)])
		sides = [self._body([(side * x, z) for x, z in ((half, 0), (far, 0), (far, height), (0, height))]) for side in (1, -1)]
		self.side = sides[0]
		floor = self._body([(-far, -2), (far, -2), (far, 0), (-far, 0)], fixed=True)
		for side, force in zip(sides, (-1, 1), strict=True):
			O.bodies[side].state.blockedDOFs = 'yzXYZ'
			O.forces.setPermF(side, (force * stress * height * depth, 0, 0))
		O.engines = polytope.engines(gravity=(0, 0, 0))
		self.rest(3, [self.prism, *sides])
		self.inSitu = self.face()
		for side in sides:
			O.bodies[side].state.blockedDOFs = 'xyzXYZ'
			O.bodies[side].state.vel = (0, 0, 0)
		O.forces.reset(resetAll=True)
		contact = O.interactions[self.prism, floor]
		bearing = -(contact.phys.normalForce + contact.phys.shearForce)
		O.bodies.erase(floor)
		for part in np.linspace(1, 0, steps + 1)[1:]:
			O.forces.setPermF(self.prism, bearing * float(part))
			self.rest(0.3)
		O.forces.reset(resetAll=True)
		self.rest(3)

	def _body(self, outline, fixed=False):
		if self.dimension == 2:
			return O.bodies.append(polytope.polygon(outline, self.depth, fixed=fixed))
		ends = (-self.depth / 2, self.depth / 2)
		return O.bodies.append(polytope.fromVertices([(x, y, z) for x, z in outline for y in ends], fixed=fixed))

	@property
	def weight(self):
		return O.bodies[self.prism].state.mass * gravity / self.depth

	def rest(self, most, ids=None):
		states, end, calm = [O.bodies[k].state for k in ids or [self.prism]], O.time + most, 0
		while calm < 3:
			assert O.time < end
			for _ in range(100):
				O.step()
			calm = calm + 1 if all(state.vel.norm() < 1e-7 for state in states) else 0

	def face(self):
		phys = O.interactions[self.prism, self.side].phys
		return Face(float(phys.normalForce.norm()) / self.depth, float(phys.shearForce.norm()) / self.depth)

	def stands(self, times):
		"""Whether the prism stays once its weight has grown to so many times what it is."""
		(newton,) = (engine for engine in O.engines if isinstance(engine, NewtonIntegrator))
		state, begin = O.bodies[self.prism].state, O.time
		place = Vector3(state.pos)
		up = Vector3(0, 1, 0) if self.dimension == 2 else Vector3(0, 0, 1)
		while O.time < begin + 1 and (state.pos - place).norm() < 0.02:
			part = min(1, (O.time - begin) / 0.5)
			newton.gravity = -gravity * times * part * (2 - part) * up
			for _ in range(10):
				O.step()
		moved = (state.pos - place).norm()
		assert moved < 1e-4 or moved > 0.02
		return moved < 0.02


def same(face, other):
	return (face.force, face.sheared) == pytest.approx((other.force, other.sheared), rel=2e-3)


@everyDepth
@pytest.mark.parametrize('times', [0.99, 1.01])
def testExcavatedGraduallyItFallsUnderTheWeightOfItsSprings(dimension, depth, times):
	"""2.75 times its own."""
	roof = Roof(dimension, depth, steps=20)
	assert same(roof.inSitu, Face.inSitu())
	assert same(roof.face(), Face.inSitu().under(0))
	most = Face.inSitu().under(0).strength() / roof.weight
	assert most == pytest.approx(2.75, abs=0.01)
	assert roof.stands(times * most) == (times < 1)


@twoDepths
@pytest.mark.parametrize('times', [0.99, 1.01])
def testExcavatedAtOnceItFallsUnderTheWeightThatTheStateLeaves(dimension, depth, times):
	"""It overshoots and slips a little, and bears less than if it had been let down gradually: what its springs have then says how much."""
	roof = Roof(dimension, depth, steps=0)
	left = roof.face()
	assert left.lift == pytest.approx(0, abs=1e-3 * left.force)
	most = left.strength() / roof.weight
	assert 2.2 < most < 2.75
	assert roof.stands(times * most) == (times < 1)


@twoDepths
def testItsFactorOfSafetyIsThatOfItsSprings(dimension, depth):
	"""Strengths are reduced, under its own weight: 1.54."""
	roof = Roof(dimension, depth, steps=20)
	bearing = Face.inSitu().under(0).under(roof.weight)
	assert roof.stands(1)
	assert same(roof.face(), bearing)
	found = polytope.factorOfSafety(tolerance=0.01)
	assert found.factor == pytest.approx(tan(friction) * bearing.force / bearing.sheared, rel=0.01)
