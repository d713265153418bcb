# SPDX-License-Identifier: GPL-2.0-or-later
"""Triaxial compression of 1000 random grains between smooth walls: curves in output/triaxial.png, the sample in
output/triaxialSample.png.

./run python examples/triaxial.py
"""

from math import radians

from yade import O, RockJointMat, polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=2e10, shearStiffness=1e10, frictionAngle=radians(30)))
curve = [(0.004, 0), (0.008, 1)]
grains = polytope.grains(curve, mass=0.155, elongation=(0.6, 1), flatness=(0.6, 1), vertices=12, seed=1)
sample = polytope.pack(grains, (0, 0, 0), (0.07, 0.07, 0.07), stress=1e5, friction=radians(5), seed=1)
print(f'{len(sample.ids)} grains, porosity {sample.porosity:.3f}')
test = polytope.triaxial(sample, stress=1e5, inertialNumber=5e-3)
test.run(0.2)
test.plot('output/triaxial.png')
polytope.picture('output/triaxialSample.png', colorBy='displacement', legend='displacement [m]', fixed='hidden')

columns = test.columns
sample.settle()
print(f'lateral stress {columns["lateralStress"].mean():.0f} Pa in the mean, largest deviator {columns["deviator"].max():.0f} Pa')
print(f'at rest, stress on the walls over that of the contacts: {sample.boundaryStress() / sample.stress().diagonal()}')
