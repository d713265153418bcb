# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialBlocks/JengaTower.py: a piece is pulled out of a tower and put on top; the tower falls."""

from yade import polytope

O.materials.append(RockJointMat(normalStiffness=1e7, shearStiffness=1e7 / 1.5, frictionAngle=radians(10), density=400))
length, width, height = 0.075, 0.025, 0.015
across = Quaternion((0, 0, 1), pi / 2)
for layer in range(18):
	for k in (-1, 0, 1):
		center, turn = ((k * width, 0), across) if layer % 2 else ((0, k * width), Quaternion.Identity)
		center = (*center, (layer + 0.5) * height)
		O.bodies.append(polytope.cuboid(center, (length / 2, width / 2, height / 2), orientation=turn))
O.bodies.append(polytope.cuboid((0, 0, -0.15 * length), (2.5 * length, 2.5 * length, 0.15 * length), fixed=True, color=(0, 0.5, 1)))


def putOnTop(number, k):
	state = O.bodies[number].state
	state.pos, state.ori, state.vel, state.angVel = (0, k * width, 18.5 * height), Quaternion.Identity, Vector3.Zero, Vector3.Zero


putOnTop(10, 1)
pull = TranslationEngine(ids=[11], translationAxis=(0, 1, 0), velocity=5)
O.engines = [pull] + polytope.engines(damping=0.1)
while O.bodies[11].state.pos[1] < length:
	O.step()
pull.dead = True
putOnTop(11, 0)
while O.time < 2:
	O.run(500, wait=True)
	for body in O.bodies:
		if hypot(body.state.pos[0], body.state.pos[1]) > 2 * length:
			O.bodies.erase(body.id)
polytope.picture('JengaTower.png')
