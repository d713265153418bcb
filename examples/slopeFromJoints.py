# SPDX-License-Identifier: GPL-2.0-or-later
"""A rock slope from a file of joints to its factor of safety, a picture of how it fails and a film of that.

Joints are read from a CSV file with the columns dip, dip_direction [degrees], x, y, z [m] and set, as a survey has them; without one, a file is drawn at random: bedding that dips 35° out of
the face of 60°, and two steep sets. Bedding has 40° of friction, the steep joints 45°. Blocks that slide on bedding planes between open joints have the factor of safety tan 40°/tan 35° = 1.198;
wedges and steps of steep joints raise it, slender blocks that topple lower it. The factor is that of limit analysis, an upper bound (docs/limit-analysis.md). Prints it, the bodies that move, and the time of each part.
In the film the blocks that move by limit analysis run with strengths that are too small, the others are held.

	./run python examples/slopeFromJoints.py                             some 200 blocks; writes output/slopeFromJoints.png and .gif
	./run python examples/slopeFromJoints.py --height 45 --width 115     some 10 000
	./run python examples/slopeFromJoints.py --joints survey.csv         joints of your own
	./run python examples/slopeFromJoints.py --reduction                 the factor by strength reduction, too: some minutes for 200 blocks
"""

import argparse
import os
import time
from math import cos, radians, sin, tan

import numpy as np
from yade import O, RockJointMat, polytope
from yade.polytope.strengthReduction import divideStrengths

options = argparse.ArgumentParser(description=__doc__.split('\n', 1)[0])
options.add_argument('--joints', help='CSV file of joints; default one is drawn at random')
options.add_argument('--height', type=float, default=13.0, help='of the slope [m], default %(default)g')
options.add_argument('--width', type=float, default=9.0, help='along the slope [m], default %(default)g')
options.add_argument('--tolerance', type=float, default=0.02, help='of the factor of safety, default %(default)g')
options.add_argument('--frames', type=int, default=40, help='of the film, default %(default)g')
options.add_argument('--reduction', action='store_true', help='the factor by strength reduction, too')
options = options.parse_args()

face, began = radians(60), time.time()
depth, base = options.height / tan(face) + 10, 2.0
# x from the toe into the slope, y along it, z up: a box, and the face through the toe
normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (-sin(face), 0, cos(face))]
offsets = [depth, base, options.width, 0, options.height, base, 0]


def told(what):
	print(f'{what} ({time.time() - began:.0f} s, {sum(os.times()[:4]):.0f} s of processors)', flush=True)


def survey(path):
	"""Joints of three sets, each through a point at random in the slope: dip, dip direction, spacing, scatter [degrees]."""
	random = np.random.default_rng(3)
	low, high = np.array([-base, 0, -base]), np.array([depth, options.width, options.height])
	with open(path, 'w') as file:
		print('dip,dip_direction,x,y,z,set', file=file)
		for number, (dip, direction, spacing, scatter) in enumerate([(35, 270, 2.0, 0.0), (80, 90, 2.6, 3.0), (85, 0, 2.2, 3.0)]):
			a, b = radians(dip), radians(direction)
			normal = np.array([sin(a) * sin(b), sin(a) * cos(b), cos(a)])
			reach = np.abs(normal) @ (high - low)
			for along in np.arange(0.5 * spacing, reach, spacing):
				place = (low + high) / 2 + (along - reach / 2 + random.uniform(-0.3, 0.3) * spacing) * normal
				steep, towards = dip + scatter * random.normal(), direction + scatter * random.normal()
				row = [min(steep, 180 - steep), (towards + 180 * (steep > 90)) % 360, *place]  # beyond the vertical it dips the other way
				print(','.join(f'{x:.6f}' for x in row) + f',{number}', file=file)


os.makedirs('output', exist_ok=True)
drawn = not options.joints
if drawn:
	options.joints = 'output/slopeFromJoints.csv'
	survey(options.joints)
joints = polytope.readJoints(options.joints)
rock = polytope.jointedRock(normals, offsets, [joints], smallest=0.3)
for name, friction in (('bedding', 40), ('steep', 45)):
	O.materials.append(RockJointMat(label=name, density=2600, normalStiffness=5e8, shearStiffness=2.5e8, frictionAngle=radians(friction)))
ids = rock.append(jointMaterials=['bedding', *['steep'] * (rock.entries - 1)], material='steep')  # the first set is the bedding
for k, planes in zip(ids, rock.bodies, strict=True):  # blocks at the bottom and at the back hold the slope
	O.bodies[k].dynamic = not any(
		rock.faces[block][plane] < 0 and (normal[2] < -0.99 or normal[0] > 0.99)
		for block in planes
		for plane, normal in enumerate(rock.blocks[block][0])
	)
told(f'{len(ids)} blocks of {len(joints)} joints, {sum(not O.bodies[k].dynamic for k in ids)} of them fixed')

O.engines = polytope.engines(damping=0.4)
found = polytope.limitAnalysis(tolerance=options.tolerance)
told(found)
told(f'{found.joints} joints, {len(found.trials)} programs')
if drawn:
	print(f'sliding on bedding: {tan(radians(40)) / tan(radians(35)):.3f}')
view = {'fixed': 'solid', 'view': (-1, -0.6, 0.42)}
found.picture('output/slopeFromJoints.png', **view)
told('output/slopeFromJoints.png')

if options.reduction:
	steps = polytope.settle(
		unbalanced=1e-4, elastic=False, densityScaling=True
	)  # joints have friction alone, which comes back after a swing
	told(f'at rest after {steps} steps of {O.dt:.2g} s')
	reduced = polytope.factorOfSafety(tolerance=options.tolerance)
	told(f'by strength reduction: {reduced}')
	told(f'{len(reduced.trials)} trials, {sum(trial.steps for trial in reduced.trials)} steps')

divideStrengths(1.3 * found.failed)
for k in set(ids) - set(found.bodies):
	O.bodies[k].dynamic = False
with polytope.animate('output/slopeFromJoints.gif', every=100, colorBy='displacement', legend='moved [m]', **view):
	for _ in range(options.frames):  # Ctrl-C ends it between two calls of O.run
		O.run(100, wait=True)
told(f'output/slopeFromJoints.gif: {len(found.bodies)} blocks for {O.time:.2g} s')
