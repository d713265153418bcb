# SPDX-License-Identifier: GPL-2.0-or-later
"""A cube of rock of 100 m cut by some 1000 discs of three sets into more than 100 000 blocks, and a tunnel's roof with its key blocks.

Prints blocks, bodies, time, and how far the blocks' volumes are from the region's and the joints' area from what was asked. Ends with 1 if the cutting
takes more than 60 s, volumes are off by 1e-12 or the area of a set by 2 %.

	./run python examples/jointNetwork.py          writes output/stereonet.png
"""

import os
import sys
import time
from math import pi, radians

import numpy as np
from yade import polytope

east, north = pi / 2, 0
box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
asked, size = 0.35, 100
sets = [
	polytope.JointSet(radians(dip), direction, p32=asked, radius=('lognormal', 28, 9), fisher=100)
	for dip, direction in ((10, east), (85, east), (80, north))
]

start = time.thread_time()
blocky = polytope.jointedRock(box, [size / 2] * 6, sets, smallest=1e-3, seed=1, incomplete='cut')
seconds = time.thread_time() - start
volume = abs(blocky.volumes.sum() / size**3 - 1)
areas = np.bincount(blocky.sets, blocky.areas) / size**3
area = np.abs(areas / asked - 1).max()
print(
	f'{len(blocky.joints)} discs cut {len(blocky.blocks)} blocks in {seconds:.1f} s; volumes are off by {volume:.1g}, areas of the sets by {100 * area:.2g} %'
)
print(f'they end inside blocks: {100 * blocky.areas.sum() / blocky.sections.sum():.0f} % of the area that was cut is joints')

start = time.thread_time()
true = polytope.jointedRock(box, [size / 2] * 6, sets, smallest=1e-3, seed=1)
print(
	f'joints separate {len(true.bodies)} bodies; the largest has {max(map(len, true.bodies))} blocks ({time.thread_time() - start:.1f} s)'
)

# a tunnel of 8 × 6 m along the north through a smaller piece of the same rock
tunnel = (box, [4, 4, 50, 50, 3, 3])
roof = polytope.jointedRock(*polytope.regionWithout(box, [15, 15, 15, 15, 12, 12], [tunnel]), sets, seed=1)
print(polytope.rockReport(roof))
for key in polytope.keyBlocks(roof, (0, 0, -1), radians(35))[:5]:
	print(f'roof: block {key.body} of {key.volume:.2g} m³ {key.mode}, factor of safety {key.factorOfSafety:.2f}')
os.makedirs('output', exist_ok=True)
polytope.stereonet(blocky, 'output/stereonet.png')
sys.exit(not (len(blocky.blocks) >= 100000 and seconds < 60 and volume < 1e-12 and area < 0.02))
