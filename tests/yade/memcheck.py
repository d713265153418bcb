#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""valgrind's memcheck over a small scene of YADE: no error with a frame of ours.

YADE, Python, MPI and Qt have errors of their own; what counts is an error whose stack goes through our libraries. The bodies are regular
solids: valgrind does not follow the rounding modes in which CGAL decides nearly degenerate cases. Not a test of pytest: it takes minutes.
`./run sanitize` runs it; by hand: ./run python tests/yade/memcheck.py. Exit code 1 if there is an error of ours.
"""

import collections
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

ours = ('libpolytope.so', '_polytope.so')

scene = r'''
import sys, tempfile
sys.path.insert(0, sys.argv[1])
import yade
from yade import O, Quaternion, polytope
from scenes import gravity, joint, loop

def heap(contactModel):
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4, cohesion=1e4, tensileStrength=1e4)
	loop(True, normalDamping=0.3, gravity=(1, 0, -gravity), damping=0.1)
	functor = O.engines[2].geomDispatcher.functors[0]
	functor.contactModel = contactModel
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	for k, faces in enumerate((4, 6, 8, 12, 20)):
		O.bodies.append(polytope.regular(faces, .5, (.55 * (k % 2), .1 * k, .25 + .45 * (k // 2)), Quaternion((1, k, 2), k)))
	O.dt = 6e-4
	O.trackEnergy = True
	return functor

for model in ('boon2012', 'foundation'):
	functor = heap(model)
	O.run(60, True)
	contacts = sum(i.isReal for i in O.interactions)
	assert contacts >= 3, contacts
	assert functor.stats()['failures'] == 0, functor.stats()
	polytope.contact(O.bodies[1], O.bodies[2])
	with tempfile.TemporaryDirectory() as folder:
		O.save(folder + '/scene.xml')
		O.reset()
		O.load(folder + '/scene.xml')
		O.run(20, True)
	assert sum(i.isReal for i in O.interactions) >= 3
	print('RESULT', model, contacts, 'contacts', flush=True)
	O.reset()
'''


def errors(path):
	"""Each different error in valgrind's report: kind and stacks, a stack being (object, function, file, line). The report may be long."""
	for _, element in ElementTree.iterparse(path):
		# XML brings a search for leaks along, whatever is asked for: what classes and Python hold until the process ends
		if element.tag == 'error' and element.findtext('kind').startswith('Leak_'):
			element.clear()
		elif element.tag == 'error':
			yield (
				element.findtext('kind'),
				[tuple(frame.findtext(key, '') for key in ('obj', 'fn', 'file', 'line')) for frame in element.iter('frame')],
			)
			element.clear()


def isOurs(frames):
	return any(os.path.basename(frame[0]) in ours for frame in frames)


def main():
	here = os.path.dirname(os.path.abspath(__file__))
	with tempfile.TemporaryDirectory() as folder:
		report = os.path.join(folder, 'valgrind.xml')
		command = [
			'valgrind',
			'--tool=memcheck',
			'--leak-check=no',
			'--show-leak-kinds=none',
			'--num-callers=40',
			'--error-limit=no',
			'--xml=yes',
			f'--xml-file={report}',
			sys.executable,
			'-c',
			scene,
			here,
		]
		environment = dict(os.environ, PYTHONMALLOC='malloc', OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1', QT_QPA_PLATFORM='offscreen')
		run = subprocess.run(command, env=environment, capture_output=True, text=True)
		print(*(line for line in run.stdout.splitlines() if line.startswith('RESULT')), sep='\n')
		if run.returncode or run.stdout.count('RESULT') != 2:
			sys.exit(f'the scene ended with {run.returncode}:\n{run.stdout[-2000:]}\n{run.stderr[-4000:]}')
		own, others = [], collections.Counter()
		for kind, frames in errors(report):
			if isOurs(frames):
				own.append((kind, frames))
			else:
				others[os.path.basename(frames[0][0])] += 1
	print(f'errors with a frame of ours: {len(own)}; of others: {sum(others.values())}', dict(others.most_common(8)))
	for kind, frames in own[:20]:
		print(f'\n{kind}')
		for path, function, file, line in frames:
			print(f'  {function or "?"} {file}:{line} {os.path.basename(path)}')
	return 1 if own else 0


if __name__ == '__main__':
	sys.exit(main())
