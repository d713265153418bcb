# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of making bodies, and of cutting a rock mass into blocks: processor time of this thread, whatever else the machine does.

As a program (bench.py runs it in a process of its own) it prints what it measured as JSON.
"""

import statistics
import time

import oneProcess

rocks = {'quick': (2000, 16000), 'full': (12500, 100000)}
"""Blocks of the two rock masses: eight times as many in the second."""


def measure(quick):
	"""{measure: µs a body or block}, and the numbers of blocks."""
	import numpy as np
	from yade import FrictMat, O, polytope

	O.materials.append(FrictMat(density=2600))
	random = np.random.default_rng(1)
	cubes, solids, clouds = (random.uniform(0.5, 1, (2000, 3)), random.uniform(1, 2, 2000), random.normal(size=(2000, 20, 3)))
	clouds /= np.linalg.norm(clouds, axis=2)[:, :, None]
	clouds = [[tuple(float(x) for x in point) for point in cloud] for cloud in clouds]

	def each(number, make):
		"""Median over five batches. The bodies are kept: a shape that no body uses is constructed again."""
		kept, times, items = [make(0)], [], iter(range(1, 5 * number + 1))
		for _ in range(5):
			start = time.thread_time()
			kept += [make(next(items)) for _ in range(number)]
			times.append((time.thread_time() - start) / number)
		return 1e6 * statistics.median(times)

	number = 60 if quick else 300
	found = {
		'equal cubes': each(10 * number, lambda i: polytope.cuboid((0, 0, i), (1, 1, 1))),
		'equal icosahedra': each(10 * number, lambda i: polytope.regular(20, 1, center=(0, 0, i))),
		'equal hulls of 20 points': each(10 * number, lambda i: polytope.fromVertices(clouds[0])),
		'new cubes': each(number, lambda i: polytope.cuboid((0, 0, 0), cubes[i])),
		'new icosahedra': each(number, lambda i: polytope.regular(20, solids[i])),
		'new hulls of 20 points': each(number, lambda i: polytope.fromVertices(clouds[i])),
	}
	blocks = []
	for wanted in rocks['quick' if quick else 'full']:
		rock, found[f'{wanted} blocks'] = cut(wanted)
		blocks.append(len(rock.blocks))
	found['bodies of blocks'] = each(number, lambda i: polytope.fromHalfSpaces(*rock.blocks[i]))
	return {'microseconds': found, 'blocks': blocks}


def cut(wanted):
	"""About this many blocks of three scattered sets, and the µs a block."""
	from math import pi, radians

	from yade import polytope

	spacing = 100 / (wanted ** (1 / 3) - 1)  # n joints make n + 1 layers
	sets = [
		polytope.JointSet(radians(dip), azimuth, spacing, exponential=True, fisher=200) for dip, azimuth in ((5, 0), (85, pi / 2), (85, 0))
	]
	normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	times = []
	for _ in range(3):
		start = time.thread_time()
		rock = polytope.jointedRock(normals, [50] * 6, sets, seed=1)
		times.append((time.thread_time() - start) / len(rock.blocks))
	return rock, 1e6 * statistics.median(times)


def run(core, quick):
	"""measure() in a process of its own on one core."""
	return oneProcess.run(__file__, core, quick)


if __name__ == '__main__':
	oneProcess.report(measure)
