# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's program for studies of parameters runs with the plug-in: `yade-batch TABLE SCRIPT` in `./run shell`."""

import math
import os
import re
import shutil
import subprocess

import pytest
from yade import polytope

script = """
readParamsFromTable(noTableOk=True, angle=30.)
from yade.params.table import *
from yade import polytope
O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=radians(angle)))
O.bodies.append(polytope.cuboid((0, 0, -0.5), (20, 20, 0.5), fixed=True))
block = O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
slope = radians(35)
O.engines = polytope.engines(gravity=(9.81 * sin(slope), 0, -9.81 * cos(slope)), damping=0)
def momentum():  # over the mass, of what friction and weight give it along the slope: what it has upwards took friction
	velocity = O.bodies[block].state.vel
	return velocity[0] + tan(radians(angle)) * velocity[2]
while O.time < 0.3: O.run(200, wait=True)
begin, first = O.time, momentum()
while O.time < 0.8: O.run(200, wait=True)
print('BATCH', angle, (momentum() - first) / (O.time - begin))
waitIfBatch()
"""


@pytest.mark.skipif(not shutil.which('yade-batch'), reason='YADE is installed without its program yade-batch')
@pytest.mark.skipif(polytope.buildInfo()['precision'] != 'double', reason='yade-batch is that of double')
def testAStudyOfParameters(tmp_path):
	"""A block on a slope of 35° for three angles of friction: each job's acceleration is g (sin − tan φ cos)."""
	(tmp_path / 'slope.py').write_text(script)
	(tmp_path / 'angles.table').write_text('description angle\na 10\nb 20\nc 30\n')
	done = subprocess.run(
		['yade-batch', '--job-threads=1', '-j2', 'angles.table', 'slope.py'],
		cwd=tmp_path,
		env={**os.environ, 'DISPLAY': ''},
		capture_output=True,
		text=True,
		timeout=300,
	)
	said = '\n'.join(path.read_text(errors='replace') for path in sorted(tmp_path.glob('*.log')))
	assert done.returncode == 0, done.stdout + done.stderr + said
	found = {float(angle): float(acceleration) for angle, acceleration in re.findall(r'^BATCH (\S+) (\S+)', said, re.MULTILINE)}
	slope = math.radians(35)
	for angle in (10, 20, 30):
		expected = 9.81 * (math.sin(slope) - math.tan(math.radians(angle)) * math.cos(slope))
		assert found[angle] == pytest.approx(expected, rel=1e-3)
