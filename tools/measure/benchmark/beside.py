# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run bench --beside FOLDER`: whole steps of settled heaps and of a jointed slope, of this revision and of that of another checkout, by turns.

Each revision has its own build and makes its own scene with its own defaults; what is compared is what a user waits for.
"""

import json
import os
import pathlib
import statistics
import sys

import scenes
from tqdm import tqdm

here = pathlib.Path(__file__).resolve().parent
heapProgram = here.relative_to(here.parents[2]) / 'heap.py'


def overlayOf(checkout):
	"""The plug-in that a checkout has built; ValueError if there is none."""
	overlay = checkout / 'build/overlay'
	if not (checkout / 'build/overlay.complete').exists():
		raise ValueError(f'--beside {checkout}: nothing is built there. Run `./run build` in that folder first.')
	if not (checkout / heapProgram).exists():
		raise ValueError(f'--beside {checkout}: no {heapProgram} there: give the top folder of a checkout of this project.')
	return overlay


def run(checkout, program, core, **request):
	"""What one process of that checkout's plug-in finds, on one core."""
	environment = dict(os.environ, OMP_NUM_THREADS='1', YADE_PREFIX=str(overlayOf(checkout)))
	command = ['taskset', '-c', str(core), sys.executable, str(program), json.dumps(request)]
	try:
		return scenes.resultOf(command, environment)
	except scenes.SceneFailed as error:
		raise scenes.SceneFailed(f'{checkout}: {error}') from None


def perBody(found):
	"""Time of a step [µs/body]."""
	return 1e6 * statistics.median(row['step'] for row in found['rows']) / found['bodies']


def scenesOf(quick):
	"""{name: (whether it is a heap, request)}"""
	number, columns, settle = (300, 7, 3000) if quick else (2000, 18, 17000)
	heap = {'number': number, 'columns': columns, 'compact': True, 'settle': settle, 'steps': 300}
	slope = {'scale': 1 if quick else 2.5, 'settle': 1000 if quick else 26000, 'steps': 300}
	return {
		f'heap of {number} cubes': (True, {'faces': [6], **heap}),
		f'heap of {number} solids of five kinds': (True, {'faces': [4, 6, 8, 12, 20], **heap}),
		'jointed slope': (False, slope),
	}


def measure(other, core, quick):
	"""(name, {'ours', 'other': result}) of each scene per area and per contact, one after the other; a result has perBody [µs]."""
	project = here.parents[2]
	cases = [(name, perArea, *one) for name, one in scenesOf(quick).items() for perArea in (True, False)]
	for name, perArea, isHeap, request in tqdm(cases, desc='beside the other revision'):
		both = {}
		for which, checkout in (('ours', project), ('other', other)):
			program = checkout / heapProgram if isHeap else here / 'slope.py'
			both[which] = run(checkout, program, core, perArea=perArea, **request)
			both[which]['perBody'] = perBody(both[which])
		bodies = '' if isHeap else f' of {both["ours"]["bodies"]} blocks'
		yield f'{name}{bodies}, per {"area" if perArea else "contact"}', both
