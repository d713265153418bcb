# SPDX-License-Identifier: GPL-2.0-or-later
"""A block on two faces with friction alone: how its factor of safety depends on shear that the way to rest leaves in its joints (docs/strength-reduction.md).

./run python examples/lockedInForces.py               # all: two to four minutes
./run python examples/lockedInForces.py --dip 65 --ratios 1 0.01

The base dips 30° towards x, a plane beside the block dips towards y, and holds its left side; with a hanging wall a parallel plane holds its right side, too.
"""

import argparse
from math import cos, radians, sin

import numpy as np
from yade import O, RockJointMat, polytope

base, friction = radians(30), radians(36)
surface = sin(base), 0, cos(base)
stiffness = 2e9
"""kₙ [Pa/m]"""


def rock(dip):
	planes = [polytope.Joint(base, radians(90), (0, 0, 0)), *(polytope.Joint(dip, 0, (0, y, 0)) for y in (-1, 1))]
	return polytope.jointedRock([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), surface, (0, 0, -1)], [3, 3, 3, 3, 1.5, 4], planes)


def scene(dip, ratio=1.0, hangingWall=False):
	"""The block between fixed ones; *ratio*: kₛ/kₙ."""
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=stiffness, shearStiffness=ratio * stiffness, frictionAngle=friction))
	ids = rock(dip).append()
	above = [k for k in ids if np.dot(O.bodies[k].state.pos, surface) > 0]
	_, block, wall = sorted(above, key=lambda k: O.bodies[k].state.pos[1])
	for k in ids:
		O.bodies[k].dynamic = k == block
	if not hangingWall:
		O.bodies.erase(wall)
	O.engines = polytope.engines()


def factor(*given):
	scene(*given)
	polytope.settle()
	return polytope.factorOfSafety().factor


def limitEquilibrium(dip):
	"""Factor of safety by limit equilibrium, with all friction along the line of intersection."""
	(block,) = polytope.keyBlocks(rock(dip), [surface, (1, 0, 0), (-1, 0, 0)], frictionAngle=friction)
	return block.factorOfSafety


def limitAnalysis(dip):
	"""The largest factor at which any forces within the friction of both faces balance the weight."""
	scene(dip)
	return polytope.limitAnalysis(tolerance=1e-3).factor


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('--dip', type=float, nargs='+', default=[65, 80], help='of the plane beside the block [°]')
	parser.add_argument('--ratios', type=float, nargs='+', default=[1, 0.1, 0.01, 0.001], help='shearStiffness over normalStiffness')
	given = parser.parse_args()
	for degrees in given.dip:
		dip = radians(degrees)
		print(f'{degrees:g}°: limit equilibrium {limitEquilibrium(dip):.3f}, limit analysis {limitAnalysis(dip):.3f}')
		for ratio in given.ratios:
			print(f'  kₛ/kₙ {ratio:g}: {factor(dip, ratio):.3f}, with a hanging wall {factor(dip, ratio, True):.3f}', flush=True)


if __name__ == '__main__':
	main()
