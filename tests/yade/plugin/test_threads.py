# SPDX-License-Identifier: GPL-2.0-or-later
"""One thread and two give the same motion.

Contacts are computed alike by any thread. Forces are summed by thread, then over threads: with up to two contacts on each body the sum
does not depend on the order, and runs agree bit for bit; with more they differ by rounding, which a heap in motion amplifies as any
other disturbance. Two runs with one thread agree bit for bit always.
"""

import functools
import os
import subprocess
import sys

from test_save_load import program

# the same scenes as for saving: one run, no archive
runner = (
	program[: program.index("globals()[scene]()")]
	+ '''
globals()[scene]()
O.trackEnergy = energy
O.run(after, True)
assert O.numThreads == int(sys.argv[7]), O.numThreads
print('RESULT', state())
'''
)

# the step after which a body that moves has three contacts for the first time
firstStepWithThree = (
	runner[: runner.index('O.run(after, True)')]
	+ '''
from collections import Counter
while True:
	O.step()
	contacts = Counter(b for i in O.interactions for b in (i.id1, i.id2) if O.bodies[b].dynamic)
	if contacts and max(contacts.values()) > 2: break
	assert O.iter < after, 'no body has three contacts'
print('RESULT', float(O.iter).hex())
'''
)


# YADE's integrator makes its energies' names in its parallel loop without a lock: now and then two threads make one twice, and what
# either has counted is lost. So only the law's are compared
ofTheIntegrator = '("gravWork", "kinetic", "nonviscDamp")'
runner = runner.replace('sorted(O.energy.items())', f'sorted(O.energy.items()) if _ not in {ofTheIntegrator}')


def run(scene, threads, steps, energy=False, script=runner):
	here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
	environment = dict(os.environ, OMP_NUM_THREADS=str(threads))
	command = [sys.executable, '-c', script, here, scene, '0', str(steps), 'none', 'energy' if energy else 'none', str(threads)]
	output = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=1800)
	assert output.returncode == 0, output.stderr
	(line,) = [line for line in output.stdout.splitlines() if line.startswith('RESULT')]
	return [float.fromhex(x) for x in line.split()[1:]]


def testTwoThreadsAgreeExactlyWithTwoContactsABody():
	assert run('columns', 1, 2000) == run('columns', 2, 2000)


def testOneThreadRepeatsItself():
	assert run('heap', 1, 3500) == run('heap', 1, 3500)


@functools.cache
def stepWithThreeContacts():
	(step,) = run('heap', 1, 5000, script=firstStepWithThree)
	return int(step)


def testTwoThreadsAgreeExactlyInAHeapBeforeABodyHasThreeContacts():
	steps = stepWithThreeContacts() - 1
	assert steps > 1000
	assert run('heap', 1, steps) == run('heap', 2, steps)


def testTwoThreadsAgreeInAHeap():
	"""One rounding at the first step with three contacts is 3e-12 three hundred steps later; here one in each of them may differ."""
	steps = stepWithThreeContacts() + 300
	one, two = run('heap', 1, steps), run('heap', 2, steps)
	difference = max(abs(a - b) for a, b in zip(one[: 13 * 16], two))
	print('equal', one == two, 'largest difference of any state value:', difference)
	assert difference < 1e-10


def testEnergiesOfTwoThreads():
	one, two = run('columns', 1, 1000, energy=True), run('columns', 2, 1000, energy=True)
	assert len(one) == len(two)
	assert max(abs(a - b) / max(1, abs(a)) for a, b in zip(one, two)) < 1e-10


erasing = """
import random
from yade import O, RockJointMat, Vector3, polytope, utils
random.seed(2)
O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
O.bodies.append(polytope.cuboid((9, 9, -0.5), (19, 19, 0.5), fixed=True))
places = [Vector3(i % 7 * 1.5, i // 7 * 1.5, 0.5) for i in range(40)]
made = [O.bodies.append(utils.sphere(at, 0.4) if k % 2 else utils.box(at, (0.4, 0.4, 0.4), fixed=True)) for k, at in enumerate(places)]
O.bodies.append([polytope.cuboid((2 * i, 4, 2), (0.2, 0.2, 0.2)) for i in range(5)])
O.engines = polytope.engines()
for k in range(40):
	O.run(3, True)
	O.bodies.erase(made.pop(random.randrange(len(made))))
	O.bodies.append(polytope.cuboid((0.3 * k, -4, 2), (0.1, 0.1, 0.1)))
"""


def testBodiesOfYadesShapesAreErasedWithTwoThreads():
	"""Their states belong to Python, too, whose memory one thread may change."""
	environment = dict(os.environ, OMP_NUM_THREADS='2')
	done = subprocess.run([sys.executable, '-c', erasing], env=environment, capture_output=True, text=True, timeout=600)
	assert done.returncode == 0, done.stderr
