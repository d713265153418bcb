# SPDX-License-Identifier: GPL-2.0-or-later
"""A block rocks on its edges: time from impact to impact, and what an impact leaves of its speed. Page: docs/verification-housner.md."""

from math import acosh, atan2, cos, hypot, sin, sqrt

from yade import Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, O, Quaternion, RockJointMat, Vector3, polytope

g, width, height = 9.81, 0.5, 2.0
leans, radius = atan2(width, height), hypot(width, height) / 2
start = 0.2 * leans
O.materials.append(RockJointMat(density=2600, normalStiffness=1e10, shearStiffness=1e10, frictionAngle=1.05))
turn, edge = Quaternion((0, 1, 0), start), Vector3(width / 2, 0, 0)
O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
place = edge + turn * Vector3(-width / 2, 0, height / 2)
block = O.bodies[O.bodies.append(polytope.cuboid(place, (width / 2, 0.25, height / 2), orientation=turn))]
law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, rockingDamping=0.6)
O.engines = polytope.engines(damping=0, law=law)


def leaning():
	up = block.state.ori * Vector3(0, 0, 1)
	return atan2(up[0], up[2])


impacts, before, most = [], leaning(), 0.0
while len(impacts) < 2:
	O.step()
	now = leaning()
	if before * now <= 0:
		impacts.append(O.time)
	most = max(most, abs(now)) if impacts else 0.0
	before = now
closed = 2 / sqrt(3 * g / 4 / radius) * acosh(1 / (1 - most / leans))
print(f'from impact to impact {impacts[1] - impacts[0]:.4f} s, closed form {closed:.4f} s')
kept = sqrt((cos(leans - most) - cos(leans)) / (cos(leans - start) - cos(leans)))
print(f'an impact leaves {kept:.3f} of the angular velocity, closed form {1 - 1.5 * sin(leans) ** 2:.3f}')
