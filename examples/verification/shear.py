# SPDX-License-Identifier: GPL-2.0-or-later
"""Direct shear of a joint under constant normal stress: its strength at the peak and after it, and how it opens. Page: docs/verification-shear.md."""

from math import radians, tan

from yade import O, RockJointMat, polytope

friction, residual, dilation, cohesion = radians(35), radians(28), radians(6), 2e5
stress, ks, slip = 1e6, 1e10, 5e-3  # normal stress [Pa]; shear stiffness [Pa/m]; slip on which it dilates [m]
O.materials.append(
	RockJointMat(
		density=2600,
		normalStiffness=1e10,
		shearStiffness=ks,
		frictionAngle=friction,
		residualFrictionAngle=residual,
		cohesion=cohesion,
		dilationAngle=dilation,
		dilationLimit=slip * tan(dilation),
	)
)
O.bodies.append(polytope.cuboid((0, 0, -0.5), (1, 1, 0.5), fixed=True))
top = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0.25), (0.5, 0.5, 0.25)))]
top.state.blockedDOFs = 'xyXYZ'
O.forces.setPermF(top.id, (0, 0, -stress))  # on 1 m²
O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.4)
polytope.settle()
lift, sheared, peak = top.state.pos[2], top.state.pos[0], 0.0
joint = O.interactions[0, top.id].phys
while top.state.pos[0] - sheared < 0.01:
	top.state.vel = (0.001 if joint.intact else 0.02, 0, 0)
	O.step()
	peak = max(peak, joint.shearForce.norm())
print(f'peak {peak / 1e6:.4f} MPa, closed form {(cohesion + stress * tan(friction)) / 1e6:.4f} MPa')
print(f'residual {joint.shearForce.norm() / 1e6:.4f} MPa, closed form {stress * tan(residual) / 1e6:.4f} MPa')
print(f'opens by {1e3 * (top.state.pos[2] - lift):.4f} mm, closed form {1e3 * slip * tan(dilation):.4f} mm')
