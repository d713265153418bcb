# SPDX-License-Identifier: GPL-2.0-or-later
"""A block on supports of several pieces (2-D, far too soft): the force of each piece, as the first step of a scene finds it; prints and draws it.

Where pieces continue each other, the block has the force of the solid that they make, whatever the cut. Where they do not, it feels the step or the
corner.

	./run python examples/flushPieces.py          writes output/flushPieces.png
"""

import os

import matplotlib

matplotlib.use('Agg')
import numpy as np
from matplotlib import pyplot
from matplotlib.patches import Polygon
from yade import O, RockJointMat, polytope

low, depth, stiffness = -0.8, 0.1, 1e6
block = [(-0.7, -depth), (0.8, -depth), (0.8, 0.8), (-0.7, 0.8)]
onItsCorner = [(0, -0.45), (0.8, 0.35), (0, 1.15), (-0.8, 0.35)]


def slab(left, right, top=0.0):
	return [(left, low), (right, low), (right, top), (left, top)]


supports = {
	'one piece': (block, [slab(-1.4, 1.4)]),
	'two flush pieces: the same force': (block, [slab(-1.4, 0), slab(0, 1.4)]),
	'cut obliquely: the same force': (block, [[(-1.4, low), (-0.3, low), (0.3, 0), (-1.4, 0)], [(-0.3, low), (1.4, low), (1.4, 0), (0.3, 0)]]),
	'an open joint: counts as closed': (block, [slab(-1.4, 0), slab(0.04, 1.4)]),
	'a step: the higher side pushes': (block, [slab(-1.4, 0, top=-0.06), slab(0, 1.4)]),
	'a corner that points inwards': (onItsCorner, [[(-1.4, low), (0, low), (0, -0.1), (-1.4, 0.35)], [(0, low), (1.4, low), (1.4, 0.35), (0, -0.1)]]),
}


def forces(corners, pieces):
	"""Of the pieces on the block: where each acts, and how large it is [N]."""
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=stiffness, frictionAngle=0))
	O.engines = polytope.engines(gravity=(0, 0, 0), timeStepper=False)
	fixed = O.bodies.append([polytope.polygon(piece, fixed=True) for piece in pieces])
	O.bodies.append(polytope.polygon(corners))
	O.dt = 1e-6
	O.step()
	found = []
	for contact in O.interactions:
		sign = 1 if contact.id1 in fixed else -1
		found.append((np.array(contact.geom.contactPoint, float)[:2], sign * np.array(contact.phys.normalForce, float)[:2]))
	return found


figure, axes = pyplot.subplots(2, 3, figsize=(12, 6.2))
sums = {}
for (name, (corners, pieces)), panel in zip(supports.items(), axes.flat, strict=True):
	for piece in pieces:
		panel.add_patch(Polygon(piece, facecolor='#1d4e79', edgecolor='#1d4e79', alpha=0.3, linewidth=1.5))
	panel.add_patch(Polygon(corners, facecolor='#c8451b', edgecolor='#c8451b', alpha=0.3, linewidth=1.5))
	found = forces(corners, pieces)
	sums[name] = sum(force for _, force in found)
	print(f'{name}: {", ".join(f"({force[0] / 1e3:.2f}, {force[1] / 1e3:.2f}) kN" for _, force in found)}; sum {sums[name].round(1)} N')
	for point, force in found:
		panel.annotate('', point + force / 1.2e5, point, arrowprops={'arrowstyle': '-|>', 'linewidth': 2, 'shrinkA': 0, 'shrinkB': 0})
		panel.plot(*point, 'o', color='black', markersize=4)
	panel.set(xlim=(-1.5, 1.5), ylim=(low - 0.05, 1.25), aspect='equal', title=name)
	panel.axis('off')
os.makedirs('output', exist_ok=True)
figure.savefig('output/flushPieces.png', dpi=80, bbox_inches='tight')
print('drawn as output/flushPieces.png')
