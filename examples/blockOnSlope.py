# SPDX-License-Identifier: GPL-2.0-or-later
"""3DEC's blocks on a slope, 10 m wide: they stand, slide or topple, on stiff and on soft joints, beside theory (docs/from-3dec.md).

./run python examples/blockOnSlope.py          ends with 1 where a block does not do what theory says"""

import sys
import warnings
from math import cos, degrees, radians, sin

from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, O, RockJointMat, polytope
from yade.polytope.check.softJoints import stableTilt

warnings.filterwarnings('ignore', 'soft joint')  # what this is about
g, width = 10, 10.0


def found(height, slope, friction, stiffness, perArea):
	O.reset()
	O.materials.append(RockJointMat(density=2000, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=radians(friction)))
	O.bodies.append(polytope.cuboid((0, 0, -5), (60, 20, 5), fixed=True))
	block = O.bodies[O.bodies.append(polytope.cuboid((0, 0, height / 2), (width / 2, width / 2, height / 2)))]
	joints = Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)
	O.engines = polytope.engines(gravity=(g * sin(slope), 0, -g * cos(slope)), physics=joints, damping=0.4)
	while abs(block.state.pos[0]) < 2:
		O.run(1000, wait=True)
		if block.state.vel.norm() < 1e-6:
			return 'stands'
	return 'topples' if block.state.ori.toAxisAngle()[1] > radians(5) else 'slides'


wrong = 0
for stiffness, perArea in ((1e9, True), (1e7, True), (1e7 * width**2, False)):
	print(f'{stiffness:.0e} {"Pa/m" if perArea else "N/m, the contact as one spring: 1e7 Pa/m on 100 m²"}')
	for height, slope, friction in ((10.0, 40, 40.1), (10.0, 40, 39.9), (5.0, 40, 20), (25.0, 19, 40), (25.0, 24, 40)):
		softness = 2000 * g * height / (stiffness * width) if perArea else 0.0
		topples = degrees(stableTilt([width / height], [softness])[0][0])
		theory = 'slides' if friction < min(slope, topples) else 'topples' if topples < slope else 'stands'
		wrong += (here := found(height, radians(slope), friction, stiffness, perArea)) != theory
		print(f'  {height:.0f} m on {slope}° with {friction}° of friction: {here}; theory: {theory}, could topple from {topples:.1f}° on')
sys.exit(wrong > 0)
