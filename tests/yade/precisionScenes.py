# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes to run in several of YADE's precisions. As a program, in the precision that PYTHONPATH chooses: prints the end of the
scene it is told, every digit, one number a line."""

import sys

import scenes
from yade import O, Quaternion, polytope


def collision():
	"""Two bodies of several faces collide off centre with the contact model spring, and separate again, spinning."""
	scenes.joint(normalStiffness=1e6, shearStiffness=1e6, frictionAngle=0)
	scenes.loop(ig2=dict(contactModel='spring'))
	O.bodies.append(
		[
			polytope.regular(8, 1, (0, 0, 0), Quaternion((1, 2, 3), 0.5)),
			polytope.cuboid((1.5, 0.25, 0.125), (0.75, 0.5, 0.5), Quaternion((3, 1, 2), 0.75), velocity=(-3, 0, 0)),
		]
	)
	O.dt = 2.0**-12
	O.run(500, True)
	return O.bodies[1]


def blockOnFloor():
	"""A block, dropped a little tilted, on a floor with friction and dampers."""
	scenes.joint(normalStiffness=1e6, shearStiffness=1e6)
	scenes.loop(gravity=(0, 0, -scenes.gravity), normalDamping=0.25, shearDamping=0.25)
	O.bodies.append(
		[
			polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True),
			polytope.cuboid((0, 0, 0.625), (0.5, 0.375, 0.5), Quaternion((2, 1, 0), 0.125)),
		]
	)
	O.dt = 2.0**-11
	O.run(600, True)
	return O.bodies[1]


def endOf(scene):
	"""The numbers of the last body's state, as mpmath's or Python's."""
	O.reset()
	state = globals()[scene]().state
	numbers = [*state.pos, *state.ori, *state.vel, *state.angVel]
	O.reset()
	return numbers


if __name__ == '__main__':
	for number in endOf(sys.argv[1]):
		print(number)
