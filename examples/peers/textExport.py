# SPDX-License-Identifier: GPL-2.0-or-later
# After YADE's examples/polyhedra/textExport.py: grains in a box, written as text.
from yade import polytope

O.bodies.append(polytope.cloud((0, 0, 0), (0.3, 0.3, 0.3), polytope.grains([(0.025, 0), (0.05, 1)], mass=1, seed=4), seed=4))
polytope.writeShapes('textPolyhedra.txt')
