# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialBlocks/standard_shapes.py: shapes that the builders make.

Regular solids are given by their circumradius here; other sizes are scaled.
"""

from yade import polytope

O.materials.append(RockJointMat(density=2000))
d = 0.05


def sized(faces, by, size, center):
	"""A regular solid by its volume, edge, or the radius of the ball inside its faces (inner), its edges (middle) or about it (outer)."""
	unit = polytope.regular(faces, 1).shape
	edge = min((v - unit.vertices[0]).norm() for v in unit.vertices[1:])
	own = dict(volume=unit.volume ** (1 / 3), edge=edge, inner=unit.inscribedRadius, middle=sqrt(1 - edge**2 / 4), outer=1)
	return polytope.regular(faces, (size ** (1 / 3) if by == 'volume' else size) / own[by], center=center)


half = d / sqrt(3) / 2
planes = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
O.bodies.append(polytope.fromHalfSpaces(planes, [half] * 6, center=(-8 * d, d, 0), color=(1, 0, 0)))
O.bodies.append(polytope.cuboid((-8 * d, 0, 0), (half, half, half), fixed=True, color=(0, 1, 0)))
for k, faces in enumerate((4, 6, 8, 12, 20)):
	O.bodies.append(sized(faces, 'middle', 0.01, ((k - 7) * d, d, 0)))
for k, (by, size) in enumerate((('volume', 1e-5), ('edge', 0.01), ('inner', 0.01), ('middle', 0.01), ('outer', 0.01))):
	O.bodies.append(sized(12, by, size, ((k - 7) * d, 0, 0)))
for k in range(6):
	x = (k - 8) * d
	O.bodies.append(polytope.frustum(3 + k, 0.2 * d, 0.2 * d, 0.2 * d, center=(x, 2 * d, 0)))
	O.bodies.append(polytope.frustum(15 + 5 * k, 0.2 * d, 0.2 * d, 0.3 * d, center=(x, 3 * d, 0)))
	O.bodies.append(polytope.frustum(20, 0.2 * d, (k + 1) * 0.05 * d, 0.5 * d, center=(x, 4 * d, 0)))
polytope.picture('standard_shapes.png', fixed='solid', view=(-0.1, -0.4, 1))
