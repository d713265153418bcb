# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains run out of a funnel that is read from an STL file; prints how many have left it, draws them and the curve of their number.

./run python examples/funnel.py          writes output/funnel.stl, output/funnel.png and output/funnelCurve.png
./run yade examples/funnel.py            the same, with a window in which the curve grows during the run
"""

import os
from math import cos, pi, radians, sin

import trimesh
from matplotlib import pyplot
from yade import O, RockJointMat, plot, polytope

# the funnel, as a program for drawing would write it: rings of points, and two triangles between neighbours
profile = [(0.08, 0.32), (0.08, 0.22), (0.02, 0.12), (0.02, 0.09)]  # radius and height [m]
sides = 24
points = [(r * cos(2 * pi * k / sides), r * sin(2 * pi * k / sides), z) for r, z in profile for k in range(sides)]
quads = [
	(sides * j + k, sides * j + (k + 1) % sides, sides * (j + 1) + (k + 1) % sides, sides * (j + 1) + k)
	for j in range(3)
	for k in range(sides)
]
os.makedirs('output', exist_ok=True)
trimesh.Trimesh(points, [three for a, b, c, d in quads for three in ((a, b, c), (a, c, d))]).export('output/funnel.stl')

O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=5e7, frictionAngle=radians(25)))
O.bodies.append(polytope.facets('output/funnel.stl', color=(0.6, 0.65, 0.7)))
O.bodies.append(polytope.cuboid((0, 0, -0.01), (0.12, 0.12, 0.01), fixed=True, color=(0.82, 0.82, 0.8)))
curve = [(0.007, 0), (0.01, 0.5), (0.013, 1)]  # opening of the sieve [m], part that passes
grains = polytope.grains(curve, mass=0.25, elongation=(0.7, 1), flatness=(0.6, 1), vertices=12, seed=2)
for k, grain in enumerate(grains):
	grain.shape.color = (0.95, 0.7 + 0.06 * (k % 4), 0.4 + 0.08 * (k % 4))
O.bodies.append(polytope.cloud((-0.055, -0.055, 0.21), (0.055, 0.055, 0.5), grains, seed=2))

O.engines = polytope.engines()


def addPoint():
	"""Adds a point to the curve: how many grains have left the funnel."""
	heights = [body.state.pos[2] for body in O.bodies if body.dynamic]
	plot.addData(t=O.time, left=sum(height < 0.09 for height in heights))
	pyplot.pause(0.01)  # lets the window draw itself


plot.plots = {'t': 'left'}
addPoint()
plot.plot()  # a window that follows the data; without a screen nothing
while O.time < 0.45:
	polytope.run(100)
	addPoint()
print(plot.data['left'][-1], 'of', len(grains), 'grains have left the funnel')
plot.plot(noShow=True).savefig('output/funnelCurve.png')
polytope.picture(
	'output/funnel.png', fixed=lambda body: 'glass' if body.id < 2 * len(quads) else 'solid', view=(-0.3, -1, 0.25), size=(1000, 1000)
)
