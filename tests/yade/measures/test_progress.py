# SPDX-License-Identifier: GPL-2.0-or-later
"""What takes long shows its progress in a terminal, and writes nothing into a file."""

import os
import pty
import re
import subprocess
import sys
import threading

script = """
from yade import O, RockJointMat, polytope
O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.4))
cubes = [polytope.cuboid((0, 0, 0), (0.05, 0.05, 0.05)) for _ in range(8)]
sample = polytope.pack(cubes, (0, 0, 0), (0.5, 0.5, 0.5), porosity=0.85, seed=1)
polytope.triaxial(sample, 1e4).run(0.001)
polytope.voronoi(((0, 0, 0), (1, 1, 1)), 5, seed=1)
polytope.grains([(0.1, 0), (0.2, 1)], 200, seed=1)
end = O.time + 0.01
polytope.run(until=end)
polytope.run(20)
"""


def saidInATerminal(command):
	"""What a program writes into its errors where these are a terminal."""
	ours, its = pty.openpty()
	said = []

	def read():
		try:
			while part := os.read(ours, 4096):
				said.append(part)
		except OSError:  # Linux's way to say that the other end is closed
			pass

	reader = threading.Thread(target=read)
	reader.start()
	# each update is shown: on a fast machine all is over within the usual tenth of a second
	done = subprocess.run(command, stdout=subprocess.PIPE, stderr=its, timeout=300, env={**os.environ, 'TQDM_MININTERVAL': '0'})
	os.close(its)
	reader.join()
	os.close(ours)
	return done.returncode, b''.join(said).decode()


def testPackAndLoadingTestsShowTheirProgressInATerminalAlone():
	command = [sys.executable, '-c', script]
	code, said = saidInATerminal(command)
	assert code == 0, said
	for part in (
		'placing',
		' bodies',
		'compressing',
		'porosity 0.',
		' for 0.850',
		'settling',
		'unbalanced force',
		'loading',
		' rows',
		' cells',
		' shapes',
		' grains',
		' of ',
		' steps',
	):
		assert part in said, part
	done = subprocess.run(command, capture_output=True, text=True, timeout=300)
	assert done.returncode == 0 and 'placing' not in done.stderr + done.stdout and '%|' not in done.stderr + done.stdout, done.stderr


slope = """
from math import cos, radians, sin
from yade import O, RockJointMat, polytope
O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(45)))
O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 2, 0.5), fixed=True))
O.bodies.append(polytope.cuboid((0, 0, 0.1), (0.5, 0.5, 0.1)))
O.engines = polytope.engines(gravity=(9.81 * sin(radians(30)), 0, -9.81 * cos(radians(30))))
polytope.settle()
print(polytope.factorOfSafety())
"""


def testTheFactorOfSafetyTellsTheTimeLeftInATerminalAlone():
	command = [sys.executable, '-c', slope]
	code, said = saidInATerminal(command)
	assert code == 0, said
	assert re.search(r'\d+%.* \d+/\d+ \[\d\d:\d\d<\d\d:\d\d, .*strengths over 1\.', said), said
	done = subprocess.run(command, capture_output=True, text=True, timeout=300)
	assert done.returncode == 0 and 'factor of safety 1.7' in done.stdout, done.stderr
	assert 'strengths over' not in done.stderr + done.stdout and '%|' not in done.stderr + done.stdout
