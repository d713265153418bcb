# SPDX-License-Identifier: GPL-2.0-or-later
"""A mesh file as particle: twenty pebbles of one OBJ file fall into a tray; draws them. (Particles are the meshes' convex hulls.)

	./run python examples/mesh.py          writes pebbles.png
"""
import os
from math import radians

from yade import (
        Bo1_Polytope_Aabb, ForceResetter, Ig2_Polytope_Polytope_PolytopeGeom, InteractionLoop,
        Ip2_RockJointMat_RockJointMat_RockJointPhys, Law2_PolytopeGeom_RockJointPhys_MohrCoulomb, NewtonIntegrator, O,
        PolytopeCollider, RockJointMat, polytope
)
from yade.polytope.pictures import picture

pebble = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'pebble.obj')  # in centimetres
O.materials.append(RockJointMat(density=2600, normalStiffness=1e6, shearStiffness=7e5, frictionAngle=radians(30)))

tray = [((0, 0, -0.01), (0.16, 0.16, 0.01)), ((-0.15, 0, 0.06), (0.01, 0.16, 0.06)), ((0.15, 0, 0.06), (0.01, 0.16, 0.06))]
tray += [((0, -0.15, 0.06), (0.14, 0.01, 0.06)), ((0, 0.15, 0.06), (0.14, 0.01, 0.06))]
O.bodies.append([polytope.cuboid(center, extents, fixed=True, color=(0.8, 0.8, 0.78)) for center, extents in tray])
for k in range(20):
	body = polytope.fromMesh(pebble, scale=0.007 + 0.0002 * k, color=(0.80, 0.70 - 0.015 * k, 0.55 - 0.02 * k))
	body.state.pos = (0.12 * (k % 2) - 0.06, 0.12 * (k // 2 % 2) - 0.06, 0.05 + 0.07 * (k // 4))
	O.bodies.append(body)

O.engines = [
        ForceResetter(),
        PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.002),
        InteractionLoop(
                [Ig2_Polytope_Polytope_PolytopeGeom()], [Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
                [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3, shearDamping=0.3)]
        ),
        NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.2),
]
O.dt = 1e-4
O.run(15000, wait=True)
print('volume of the smallest pebble:', O.bodies[5].shape.volume, 'm³, with', len(O.bodies[5].shape.normals), 'planes')
picture('pebbles.png', view=(-0.5, -1, 1.1))
