# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialBlocks/multidrum_column.py: a column of drums, tapering and with a capital, on a base that shakes."""

from yade import polytope

O.materials.append(RockJointMat(normalStiffness=1e8, shearStiffness=2e8 / 3, frictionAngle=atan(0.4), density=2000))
h, least, taper = 1.008, 1.28, 0.037
for k in range(12):  # ten drums taper, two widen
	bottom, top = (least + taper * abs(10 - j) for j in (k, k + 1))
	drum = polytope.frustum(10, bottom, top, h)
	drum.state.pos += Vector3(0, 0, k * h)
	O.bodies.append(drum)
O.bodies.append(polytope.cuboid((0, 0, 12 * h + least / 3), (1.5 * 1.65, 1.5 * 1.65, least / 3), color=(1, 0, 0)))
base = O.bodies.append(polytope.cuboid((0, 0, -least / 2), (8.25, 8.25, least / 2), color=(0, 1, 0), fixed=True))
shaking = HarmonicMotionEngine(A=(0.1, 0, 0), f=(3, 0, 0), fi=(pi / 2, 0, 0), ids=[base])
O.engines = [shaking] + polytope.engines(damping=0)
while O.time < 1:
	O.run(1000, wait=True)
polytope.picture('multidrum_column.png')
