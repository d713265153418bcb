# SPDX-License-Identifier: GPL-2.0-or-later
"""Loss of a rocking block at its impacts over `rockingDamping` of the law, beside Housner's, and its periods over amplitude.

./run python examples/rocking.py
"""

from math import acosh, atan2, cos, hypot, sin, sqrt

from tabulate import tabulate
from yade import Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, O, Quaternion, RockJointMat, Vector3, polytope

gravity, width, height = 9.81, 0.5, 2.0
leans = atan2(width, height)
"""Housner's α: angle of the diagonal with the edge that stands."""
radius, stiffness = hypot(width, height) / 2, 1e10
shares = (0, 0.2, 0.5, 0.6, 0.7, 0.8, 1)


def housner():
	"""Angular velocity after an impact over that before it, of a rigid block that neither slides nor bounces.

	G.W. Housner (1963), The behavior of inverted pendulum structures during earthquakes, Bulletin of the Seismological Society of America 53:403-417.
	"""
	return 1 - 1.5 * sin(leans) ** 2


def halfPeriod(amplitude):
	"""Time from one impact to the next one, Housner's (8), exact for slender blocks."""
	return 2 / sqrt(3 * gravity / 4 / radius) * acosh(1 / (1 - amplitude / leans))


def block(damping, amplitude):
	"""Leans by *amplitude* on an edge; without numerical damping. Returns a function that tells by how much it leans."""
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=1.05))
	turn = Quaternion((0, 1, 0), amplitude)
	edge = Vector3(width / 2, 0, 0)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	body = O.bodies[
		O.bodies.append(polytope.cuboid(edge + turn * Vector3(-width / 2, 0, height / 2), (width / 2, 0.25, height / 2), orientation=turn))
	]
	law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, rockingDamping=damping)
	O.engines = polytope.engines(damping=0, law=law)

	def leaning():
		up = body.state.ori * Vector3(0, 0, 1)
		return atan2(up[0], up[2])

	return leaning


def energy(amplitude):
	"""Energy of a block at this amplitude, over m g R."""
	return cos(leans - amplitude) - cos(leans)


def measured(damping, amplitude):
	"""(angular velocity after the first impact over that before it, time from there to the second one over Housner's)."""
	leaning = block(damping, amplitude)
	impacts, most, before = [], 0, leaning()
	while len(impacts) < 2:
		O.step()
		now = leaning()
		if before * now <= 0:
			impacts.append(O.time)
		if impacts:
			most = max(most, abs(now))
		before = now
	return sqrt(energy(most) / energy(amplitude)), (impacts[1] - impacts[0]) / halfPeriod(most)


def main():
	rows = []
	for damping in shares:
		(large, period), (small, _) = measured(damping, 0.5 * leans), measured(damping, 0.2 * leans)
		rows.append((damping, large, small, period))
	print(tabulate(rows, ('rockingDamping', 'from α/2', 'from α/5', 'time to the next impact, over theory'), floatfmt=('g', *['.3f'] * 3)))
	print(f'Housner: {housner():.3f}')


if __name__ == '__main__':
	main()
