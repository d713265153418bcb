# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialBlocks/WedgeYADE.py: rock cut by four sets of joints settles in a box, then a vertical cut frees its face.

x is east, y north, z up (there x is north and z down). Joints have friction alone.
"""

from yade import polytope

through = (0, 0, 0)
sets = [polytope.JointSet(radians(90), radians(315), spacing=1000, through=through)]  # the cut, along y = x
for dip, direction in ((70, 160), (60, 90), (70, 350), (60, 240)):
	sets.append(polytope.JointSet(radians(dip), radians(direction), spacing=10, through=through))
box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], [20, 20, 20, 20, 0, 40]
rock = O.materials.append(RockJointMat(density=2700, normalStiffness=2e8, shearStiffness=1e7, frictionAngle=radians(40)))
blocks = O.bodies.append([polytope.fromHalfSpaces(*block) for block in polytope.jointedRock(*box, sets, smallest=0.5).blocks])
O.materials.append(RockJointMat(density=2700, normalStiffness=2e9, shearStiffness=1e8, frictionAngle=0))
west, east, south, north, floor = O.bodies.append(polytope.plates((-20, -20, -40), (20, 20, 0), without='+z'))
O.engines = polytope.engines(damping=0.8)
while O.time < 1:
	O.run(100, wait=True)
for k in blocks:
	state = O.bodies[k].state
	state.vel = state.angVel = Vector3.Zero
	state.refPos = state.pos
	if state.pos[1] < state.pos[0]:
		O.bodies.erase(k)
O.bodies.erase(east)
O.bodies.erase(south)
O.engines[-2].damping = 0
while O.time < 3:
	O.run(100, wait=True)
left = [body.state for body in O.bodies if body.dynamic]
print(len(left), 'blocks behind the cut; the farthest has moved', max((state.pos - state.refPos).norm() for state in left), 'm')
polytope.picture('WedgeYADE.png', colorBy='displacement', view=(1, -1, 0.6))
