# SPDX-License-Identifier: GPL-2.0-or-later
"""One block falls onto a floor; prints the contact it rests on.

./run python examples/hello.py          or, in YADE:  ./run yade -n -x examples/hello.py
"""

from math import radians

from yade import O, RockJointMat, polytope

# stiffnesses per area [Pa/m]: a contact's own is this times the area in which the blocks meet
O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=radians(35)))

O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
block = O.bodies.append(polytope.cuboid(center=(0, 0, 0.55), extents=(0.5, 0.4, 0.5)))

O.engines = polytope.engines()  # the usual ones, gravity 9.81 m/s² along −z; sets O.dt
polytope.run(until=2)

contact = O.interactions[0, block]
weight = 9.81 * O.bodies[block].state.mass
print('contact point    ', contact.geom.contactPoint)
print('normal           ', contact.geom.normal)
print('depth            ', contact.geom.penetrationDepth, 'm')
print('area             ', contact.geom.contactArea, 'm²')
print('force over weight', contact.phys.normalForce.norm() / weight)
