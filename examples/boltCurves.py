# SPDX-License-Identifier: GPL-2.0-or-later
"""Pull-out of a grouted bolt, and shear of a joint across one: forces on the moved block, beside the closed forms. output/boltCurves.png

./run python examples/boltCurves.py
"""

import pathlib
from math import sqrt, tanh

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import O, RockJointMat, Vector3, polytope

area, modulus, bond, strength, length, free = 5e-4, 2e11, 3e8, 1.2e5, 1.5, 0.1
axial, rate = area * modulus, sqrt(bond / (area * modulus))
dowel = polytope.Dowel(5e7, 8e4)


def measured(direction, displacements, **bolt):
	"""Forces against the motion of a block that is moved away from a fixed one, 1 mm apart, with a bolt across."""
	O.reset()
	O.materials.append(RockJointMat(density=2500, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0))
	O.bodies.append([polytope.cuboid((x, 0, 0), (1, 0.5, 0.5), fixed=True) for x in (-1, 1.001)])
	O.engines = polytope.engines(timeStepper=False, gravity=(0, 0, 0))
	polytope.bolt(area=area, youngsModulus=modulus, **bolt)
	forces, start = [], Vector3(O.bodies[1].state.pos)
	for displacement in displacements:
		O.bodies[1].state.pos = start + displacement * direction
		O.step()
		forces.append(-float(O.forces.f(1).dot(direction)))
	return np.array(forces)


def pullOut(slipped):
	"""(displacement, force) where grout slips over this length from the mouth on."""
	rest = strength / rate * tanh(rate * (length - slipped))
	force = rest + strength * slipped
	return strength / bond + rest * slipped / axial + strength * slipped**2 / (2 * axial) + force * 0.501 / axial, force


def shear(displacement, lag):
	slanted = sqrt(free**2 + displacement**2)
	tension = (slanted - free) / (free / axial + 2 / lag)
	return min(dowel.stiffness * displacement, dowel.strength) + min(tension, 2e5) * displacement / slanted


pulled, sheared = np.linspace(0, 6e-3, 41), np.linspace(0, 8e-3, 41)
ends = dict(head=(-0.5, 0, 0), end=(1.501, 0, 0), grout=polytope.Grout(bond, strength, length=length))
across = dict(
	head=(-1, 0, 0), end=(1.901, 0, 0), plate=False, grout=polytope.Grout(1e10, 1e9), dowel=dowel, freeLength=free - 1e-3, yieldForce=2e5
)
found = measured(Vector3.UnitX, pulled, **ends), measured(Vector3.UnitY, sheared, **across)
curve = np.array([(0, 0), *(pullOut(a) for a in np.linspace(0, length, 50)), (pulled[-1], strength * length)])
theory = np.interp(pulled, *curve.T), np.array([shear(x, sqrt(axial * 1e10)) for x in sheared])
for name, one, other in zip(('pull-out', 'shear'), found, theory, strict=True):
	print(f'{name}: largest difference {100 * abs(one - other).max() / other.max():.2f} % of the largest force')
figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), layout='constrained')
titles = 'pull-out: displacement [mm]', 'shear of the joint [mm]'
for plot, title, along, one, other in zip(axes, titles, (pulled, sheared), found, theory, strict=True):
	plot.plot(1e3 * along, other / 1e3, color='0.5', label='closed form')
	plot.plot(1e3 * along, one / 1e3, '.', color='tab:red', label='computed')
	plot.set(xlabel=title, ylabel='force [kN]', xlim=0, ylim=0)
axes[0].legend(loc='lower right')
pathlib.Path('output').mkdir(exist_ok=True)
figure.savefig('output/boltCurves.png', dpi=100)
