# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedraBreak/uniaxial_compression.py: a cube under three moving plates breaks after Mohr, Coulomb and Weibull.

Opposite the plates stand fixed ones (there the cube itself is fixed).
"""

from yade import plot, polytope

size, factor = 0.035, 1e4  # stiffness and strengths are reduced by this, as there
strength = dict(tension=5e9 / factor, compression=1e10 / factor, volume=1e-9, modulus=3, probability=0.6)
O.materials.append(RockJointMat(density=2500, normalStiffness=1e11, shearStiffness=5e10, frictionAngle=0))
cube = O.bodies.append(polytope.cuboid((0, 0, 0), (size / 2, size / 2, size / 2), mask=7))
plates = []
for axis, speed in ((2, 1e-3), (1, 2e-4), (0, 2e-4)):
	extents = Vector3(size, size, size)
	extents[axis] = size / 10
	for side in (-1, 1):
		plate = polytope.cuboid(side * 0.6 * size * Vector3.Unit(axis), extents, fixed=True, mask=2**axis)  # plates do not meet
		plate.state.vel = -speed * Vector3.Unit(axis) if side > 0 else Vector3.Zero
		O.bodies.append(plate)
	plates.append(plate)
O.engines = polytope.engines(gravity=(0, 0, 0), damping=0.8)
broken = {}
while not broken:
	for _ in range(10):
		O.step()
	stress = [O.forces.f(plate.id)[axis] / size**2 * factor for plate, axis in zip(plates, (2, 1, 0), strict=True)]
	plot.addData(u=size * 0.6 - plates[0].state.pos[2], stressTop=stress[0], stressLeft=stress[1], stressBack=stress[2])
	broken = polytope.breakGrains(**strength)
print(f'broken at {stress[0] / 1e6:.3f} MPa, {stress[1] / 1e6:.3f} MPa aside, after {1000 * plot.data["u"][-1]:.4f} mm')
