# SPDX-License-Identifier: GPL-2.0-or-later
"""Direct shear of one joint at 1 MPa by three shear laws: stress, and rise of the block, against its displacement. output/directShear.png

./run python examples/directShear.py
"""

import pathlib
from math import degrees, radians

import numpy as np
from matplotlib.figure import Figure
from yade import BartonBandisStrength, ContinuouslyYieldingStrength, O, RockJointMat, polytope

yielding = ContinuouslyYieldingStrength(initialFrictionAngle=radians(50), roughness=1e-3)
laws = {'Barton-Bandis': dict(strength=BartonBandisStrength(JRC=10, JCS=100e6)), 'continuously yielding': dict(strength=yielding)}
laws['Mohr-Coulomb'] = dict(dilationAngle=radians(5), dilationLimit=1e-4)
figure = Figure(figsize=(9, 3.4), layout='constrained')
stress, rise = figure.subplots(1, 2)
for name, law in laws.items():
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=1e10, shearStiffness=5e9, frictionAngle=radians(30), **law))
	O.bodies.append([polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True), polytope.cuboid((0, 0, 0.25), (0.5, 0.5, 0.25))])
	O.engines, state = polytope.engines(gravity=(0, 0, 0), damping=0.4), O.bodies[1].state
	state.blockedDOFs = 'xyXYZ'
	O.forces.setPermF(1, (0, 0, -1e6))
	O.run(500, wait=True)
	state.vel, start, rows, joint = (0.01, 0, 0), state.pos, [], O.interactions[0, 1].phys
	while state.pos[0] < 4e-3:
		O.run(20, wait=True)
		rows.append((*(state.pos - start), joint.shearForce.norm() / joint.normalForce.norm()))
	along, _, up, ratio = np.array(rows, float).T
	print(f'{name}: peak {degrees(np.arctan(max(ratio))):.1f}°, at 4 mm {degrees(np.arctan(ratio[-1])):.1f}°, {1e3 * up[-1]:.2f} mm up')
	stress.plot(1e3 * along, ratio, label=name)
	rise.plot(1e3 * along, 1e3 * up)
stress.set(xlabel='displacement [mm]', ylabel='shear over normal stress', xlim=0, ylim=0)
rise.set(xlabel='displacement [mm]', ylabel='rise [mm]', xlim=0)
stress.legend(loc='lower right')
pathlib.Path('output').mkdir(exist_ok=True)
figure.savefig('output/directShear.png', dpi=100)
