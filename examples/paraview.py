# SPDX-License-Identifier: GPL-2.0-or-later
"""Files for ParaView: polyhedra fall, and every 100 steps are recorded as real polyhedra, with their contacts.

./run python examples/paraview.py          then open output/paraview/bodies.pvd and contacts.pvd in ParaView
"""

import os
import sys

from yade import O, PolytopeVTKRecorder

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'paper'))
from boon2012.falling.scene import FallingPolyhedra

FallingPolyhedra(faces=(4, 6, 8, 12, 20), number=60, columns=4).build()
O.engines = O.engines + [PolytopeVTKRecorder(fileName='output/paraview/', iterPeriod=100)]
for _ in range(40):  # Ctrl-C ends it between two calls of O.run
	O.run(100, wait=True)

# In ParaView: the bodies' “color” is in bytes, so uncheck “Map Scalars” for it; for the contacts add a Glyph (arrows) along
# “normalForce”, scaled by its magnitude.
