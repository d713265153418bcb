# SPDX-License-Identifier: GPL-2.0-or-later
"""A rock slope cut into blocks by three sets of joints; slides along its bedding once friction is below the bedding's dip.

Bedding dips 35° out of the face; the other two sets are steep, with random distances and orientations. The slope settles at 45° of
friction, then friction is set to 37°, where it comes to a new equilibrium in two seconds and stands, and to 33°, where it slides (blocks
stand up to 35°): prints how far blocks have moved meanwhile and draws the slide. Ends with 1 if it is not so.

	./run python examples/jointedSlope.py          writes output/jointedSlope.png
"""

import sys
from math import cos, pi, radians, sin

import numpy as np
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	PolytopeTimeStepper,
	RockJointMat,
	polytope,
)
from yade.polytope.frictionReduction import setFrictionAngle

east, north, west = pi / 2, 0, 3 * pi / 2
bedding, face = radians(35), radians(60)

# x from the toe into the slope, y along it, z up: a box, and the face through the toe
normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (-sin(face), 0, cos(face))]
offsets = [24, 2, 10, 0, 14, 2, 0]
rock = polytope.jointedRock(
	normals,
	offsets,
	[
		polytope.JointSet(bedding, west, spacing=2),
		polytope.JointSet(radians(80), east, spacing=3, exponential=True, fisher=400),
		polytope.JointSet(radians(85), north, spacing=2.5, exponential=True, fisher=400),
	],
	smallest=0.3,
	seed=3,
)
print(
	f'{len(rock.blocks)} blocks of {len(rock.joints)} joints, {np.quantile(rock.volumes, 0.1):.2g} … {np.quantile(rock.volumes, 0.9):.2g} m³ '
	f'(10 and 90 %), {rock.volumes.sum():.6f} m³ in all; {rock.uncut} cuts were left out'
)

O.materials.append(RockJointMat(density=2600, normalStiffness=2e8, shearStiffness=1e8, frictionAngle=radians(45)))
for planes in rock.blocks:
	body = polytope.fromHalfSpaces(*planes)
	corners = np.array([body.state.pos + body.state.ori * v for v in body.shape.vertices], float)
	held = corners[:, 2].min() < 1e-6 or corners[:, 0].max() > offsets[0] - 1e-6  # below the toe, or at the back
	if held:
		body.state.blockedDOFs = 'xyzXYZ'
	O.bodies.append(body)

O.engines = [
	ForceResetter(),
	PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.02),
	InteractionLoop(
		[Ig2_Polytope_Polytope_PolytopeGeom()],
		[Ip2_RockJointMat_RockJointMat_RockJointPhys()],
		[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.2, shearDamping=0.2)],
	),
	NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.2),
	PolytopeTimeStepper(),  # sets O.dt
]


def moved(friction, seconds):
	"""Largest way of a block [m] after so much time with a friction angle, and the number of blocks that have moved by 5 cm."""
	setFrictionAngle(friction)
	start = [body.state.pos for body in O.bodies]
	O.stopAtTime = end = O.time + seconds
	while O.time < end:  # Ctrl-C ends it between two calls of O.run
		O.run(200, wait=True)
	ways = [(body.state.pos - origin).norm() for body, origin in zip(O.bodies, start, strict=True)]
	return max(ways), sum(way > 0.05 for way in ways)


moved(radians(45), 1.0)
settling, _ = moved(radians(37), 2.0)
stands, _ = moved(radians(37), 1.0)
slides, number = moved(radians(33), 1.0)
print(
	f'friction 37°: {1000 * settling:.1f} mm, then {1e6 * stands:.0f} µm in a second; 33°: {1000 * slides:.0f} mm, {number} blocks by 5 cm and more (bedding dips 35°)'
)
print('queries without an answer:', O.engines[2].geomDispatcher.functors[0].stats()['failures'])
moved(radians(20), 1.0)
polytope.picture('output/jointedSlope.png', colorBy='displacement', legend='moved [m]', fixed='solid', view=(-1, -0.6, 0.42))
sys.exit(not (stands < 1e-4 and slides > 0.1 and number > 10))
