# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/tests/interactinDetectionFactor.py: two grains approach, and are seen by each other before they touch.

There a factor makes the contact begin across a gap. Here a contact begins at the touch; the gap before is asked for.
"""

from yade import polytope

O.materials.append(RockJointMat())
one = polytope.randomGrain(1, seed=5)
two = polytope.randomGrain(1, seed=6, center=(3, 0, 0), velocity=(-1, 0, 0))
O.bodies.append([one, two])
O.engines = polytope.engines(gravity=(0, 0, 0))
while O.time < 2.5:
	O.run(500, wait=True)
	print(f'time {O.time:.3f}, overlap {polytope.contact(one, two).depth:.4f}')
