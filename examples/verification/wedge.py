# SPDX-License-Identifier: GPL-2.0-or-later
"""A rock wedge on two joints with cohesion: its factor of safety. Page: docs/verification-wedge.md."""

from math import radians

from yade import O, RockJointMat, polytope

one, two, face, top = (
	polytope.JointSet(radians(dip), radians(direction), 1).normal for dip, direction in ((45, 105), (70, 235), (65, 185), (12, 195))
)
for label, cohesion, friction in (('A', 24e3, 20), ('B', 48e3, 30), ('wedge', 1e9, 80)):  # a joint has the lower strength of its two sides
	O.materials.append(
		RockJointMat(
			label=label,
			density=2600,
			normalStiffness=1e9,
			shearStiffness=1e9,
			frictionAngle=radians(friction),
			cohesion=cohesion,
			residualCohesion=cohesion,
		)
	)
box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
O.bodies.append(polytope.fromHalfSpaces([one, *box], [0] + [200] * 6, material='A', fixed=True))
O.bodies.append(polytope.fromHalfSpaces([two, -one, *box], [0, 0] + [200] * 6, material='B', fixed=True))
crest = 30 * (-face[1] * top[1] * face[2] - face[0] * top[0] * face[2]) / (1 - face[2] ** 2) + 30 * top[2]  # the face is 30 m high
O.bodies.append(polytope.fromHalfSpaces([-one, -two, face, top], [0, 0, 0, crest], material='wedge'))
O.engines = polytope.engines(damping=0.4)
polytope.settle()
print(f'factor of safety {polytope.factorOfSafety().factor:.3f}, closed form 1.877')
