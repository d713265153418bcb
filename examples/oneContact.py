# SPDX-License-Identifier: GPL-2.0-or-later
"""One pair without a scene: two polygons overlap; prints the contact of Boon et al. (2012), as `polytope.contact` finds it, and draws it.

The largest circle in the overlap is the linear program's answer, its radius -s*; the contact point is the analytic centre of all
half-spaces of both bodies; the depth is the chord along the normal through it.

	./run python examples/oneContact.py [FILE.png]          writes output/one-contact.png
"""

import os
import sys

import matplotlib

matplotlib.use('Agg')
import numpy as np
from matplotlib import pyplot
from matplotlib.patches import Circle, Polygon
from yade import O, RockJointMat, polytope

path = sys.argv[1] if len(sys.argv) > 1 else 'output/one-contact.png'
os.makedirs(os.path.dirname(path) or '.', exist_ok=True)
O.materials.append(RockJointMat())
corners = [(0, 0), (4, 0), (4.4, 1.4), (2.6, 2.4), (0.4, 1.9)], [(1.2, 1.55), (3.3, 1.25), (4.6, 3), (3, 4.2), (1.1, 3.4)]
bodies = [polytope.polygon(points, cornerRadius=0.6) for points in corners]  # more than the overlap is deep

found = polytope.contact(*bodies, contactModel='boon2012')
ball = polytope.contact(*bodies, contactModel='boon2012', contactPoint='chebyshevCentre')  # the linear program's own point
print('status       ', found.status)
print('radius -s*   ', -found.infeasibility, 'm')
print('contact point', found.point)
print('normal       ', found.normal)
print('depth        ', found.depth, 'm')


def along(body, direction, start):
	"""How far it is from *start* to the body's surface."""
	turned = body.state.ori.conjugate()
	n, x = turned * direction, turned * (start - body.state.pos)
	return min((d - a.dot(x)) / a.dot(n) for a, d in zip(body.shape.normals, body.shape.offsets, strict=True) if a.dot(n) > 0)


# forwards to where the chord leaves body 1, backwards to where it leaves body 2
ends = [
	found.point + along(bodies[0], found.normal, found.point) * found.normal,
	found.point - along(bodies[1], -found.normal, found.point) * found.normal,
]
assert abs((ends[0] - ends[1]).norm() - found.depth) < 1e-12


def flat(vector):
	return np.array(vector, float)[:2]


point, normal = flat(found.point), flat(found.normal)
figure, axes = pyplot.subplots(figsize=(8, 6))
for k, (points, color) in enumerate(zip(corners, ('#1d4e79', '#c8451b'), strict=True)):
	axes.add_patch(Polygon(points, facecolor=color, alpha=0.25))
	for start, end in zip(points, np.roll(points, -1, axis=0), strict=True):  # each edge, and the line of its half-plane
		axes.axline(start, end, color=color, linewidth=0.6, linestyle=':')
		axes.plot(*np.transpose([start, end]), color=color, linewidth=1.8)
	axes.annotate(f'body {k + 1}', np.mean(points, axis=0) + (0, 1.1 * k - 0.3), color=color, fontsize=13, ha='center', va='center')
axes.add_patch(Circle(flat(ball.point), -found.infeasibility, fill=False, label='largest circle in the overlap, radius −s*'))
axes.plot(*np.transpose([flat(end) for end in ends]), color='black', linewidth=3, label='depth, along the normal', solid_capstyle='butt')
axes.annotate('', point + 1.1 * normal, point, arrowprops={'arrowstyle': '-|>', 'linewidth': 1.2})
axes.annotate('normal', point + 1.1 * normal + (0.08, 0), va='center')
axes.plot(*point, 'o', color='white', markeredgecolor='black', label='contact point: analytic centre')
axes.set(xlim=(-0.6, 5.3), ylim=(-0.4, 5.1), aspect='equal')
axes.axis('off')
axes.legend(loc='upper left', frameon=False)
figure.savefig(path, dpi=110, bbox_inches='tight')
print('drawn as', path)
