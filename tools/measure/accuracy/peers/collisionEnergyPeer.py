# SPDX-License-Identifier: GPL-2.0-or-later
"""The studies of collisionEnergy.py with YADE's own PotentialBlock or Polyhedra, in a process of their own, whose YADE has the peer.

`./run bench` builds the peers (tools/measure/benchmark/YadePeers.cmake); shapes and laws are those of tools/measure/benchmark/heap.py.
Usage: collisionEnergyPeer.py '{"method": "polyhedra", "study": "collisions", …}'; the last line printed is RESULT and JSON.
"""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys

benchmark = pathlib.Path(__file__).resolve().parents[2] / 'benchmark'

names = {'potentialBlock': 'PotentialBlock', 'polyhedra': 'Polyhedra'}


def measure(method, study, timeLimit, **request):
	"""Result of Collisions.run() or Bounces.run() with the peer's shapes and law.

	:param str method: 'potentialBlock' or 'polyhedra'
	:param str study: 'collisions' (request: number, seed, steps, overlap, duration) or 'bounces' (number, steps, seconds)
	:raises PeerFailed: if it is not built, or gives no result within *timeLimit* [s]
	"""
	from collisionStudy.report import PeerFailed

	# by its path: others have a module `scenes`, too
	place = importlib.util.spec_from_file_location('benchmarkScenes', benchmark / 'scenes.py')
	scenes = importlib.util.module_from_spec(place)
	place.loader.exec_module(scenes)
	# ./run bench builds in a folder beside the overlay that this YADE was loaded from
	plugins = pathlib.Path(os.environ['YADE_PREFIX']).parent / 'bench/tools/measure/benchmark'
	try:
		overlay = scenes.Scenes(plugins, core=None, quick=True, results=[], note=None).overlay(method)
	except scenes.SceneFailed:
		raise PeerFailed('not built (./run bench builds it)') from None
	command = [sys.executable, __file__, json.dumps({'method': method, 'study': study, **request})]
	environment = {**os.environ, 'OMP_NUM_THREADS': '1', 'YADE_PREFIX': str(overlay)}
	try:
		done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=timeLimit)
	except subprocess.TimeoutExpired:
		raise PeerFailed(f'no result after {timeLimit} s') from None
	lines = [line for line in done.stdout.splitlines() if line.startswith('RESULT ')]
	if done.returncode or not lines:
		raise PeerFailed(f'ended with {done.returncode}')
	return json.loads(lines[-1][len('RESULT ') :])


def main(arguments):
	sys.path[:0] = [str(benchmark), str(pathlib.Path(__file__).resolve().parents[1])]
	import heap
	from collisionStudy.meetings import Bounces, Collisions, meetings
	from collisionStudy.scene import Contact

	request = json.loads(arguments[0])
	convert, loop = {
		'potentialBlock': (heap.toPotentialBlock, heap.potentialBlockLoop),
		'polyhedra': (heap.toPolyhedra, heap.polyhedraLoop),
	}[request['method']]
	number, steps = request['number'], request['steps']
	if request['study'] == 'collisions':
		scene = Collisions(meetings(number, request['seed']), Contact(), steps, request['overlap'], request['duration']).build()
		settings = {}
	else:
		scene = Bounces(Contact(), steps, number).build()
		settings = {'seconds': request['seconds']}
	heap.replaceByPeer(scene, convert, loop)
	print('RESULT', json.dumps(scene.run(**settings)), flush=True)
	os._exit(0)  # some of the peers crash when the process ends


if __name__ == '__main__':
	main(sys.argv[1:])
