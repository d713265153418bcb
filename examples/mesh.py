# SPDX-License-Identifier: GPL-2.0-or-later
"""A mesh file as particle: ten pebbles of one OBJ file fall into a heap; draws it. (Particles are the meshes' convex hulls.)

	./run python examples/mesh.py          writes pebbles.png
"""
import os
from math import radians

from yade import O, Bo1_Polytope_Aabb, ForceResetter, Ig2_Polytope_Polytope_PolytopeGeom, InsertionSortCollider, InteractionLoop
from yade import Ip2_RockJointMat_RockJointMat_RockJointPhys, Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, NewtonIntegrator, RockJointMat
from yade import polytope
from yade.polytope.pictures import picture

pebble = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'pebble.obj')  # in centimetres
O.materials.append(RockJointMat(density=2600, normalStiffness=1e6, shearStiffness=7e5, frictionAngle=radians(30)))

O.bodies.append(polytope.cuboid((0, 0, -0.02), (0.3, 0.3, 0.02), fixed=True, color=(0.86, 0.86, 0.84)))
for k in range(10):
	body = polytope.fromMesh(pebble, scale=0.01 * (1 + 0.05 * k), color=(0.75, 0.65 - 0.02 * k, 0.5 - 0.03 * k))
	body.state.pos = (0.03 * (k % 2), 0.02 * (k % 3), 0.08 + 0.1 * k)
	O.bodies.append(body)

O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Polytope_Aabb()]),
        InteractionLoop(
                [Ig2_Polytope_Polytope_PolytopeGeom()],
                [Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
                [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, shearDamping=0.3)],
        ),
        NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.2),
]
O.dt = 1e-4
O.run(15000, wait=True)
print('volume of the smallest pebble:', O.bodies[1].shape.volume, 'm³, with', len(O.bodies[1].shape.normals), 'planes')
picture('pebbles.png', view=(-0.5, -1, 0.5))
