# SPDX-License-Identifier: GPL-2.0-or-later
"""Extensions under MPI: two ranks know shapes, contacts and laws of two extensions from the environment, and agree with one process."""

import json
import re
import shutil
import sys

import pytest
from test_extensions import built, inYade, run  # noqa: F401
from yade import polytope

if shutil.which('mpirun') is None or 'MPI' not in polytope.buildInfo()['yadeFeatures']:
	pytest.skip('YADE has no MPI here, or there is no mpirun', allow_module_level=True)

scene = """
import json
from yade import *
from yade import polytope
from yade.polytope import mpi
import yade
def make():
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5, stiffnessPerArea=False, closure=OwnHyperbola(maximumClosure=0.1)))
	for k in range(8):
		body = polytope.cuboid(center=(0.99 * k, 0.02 * k, 0.5), extents=(0.4, 0.3 + 0.01 * k, 0.35), fixed=k in (0, 7))
		O.bodies.append(polytope.withShape(body, RoundedPolytope(radius=0.1)))
	rounded = [Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom(), Ig2_Polytope_RoundedPolytope_PolytopeGeom(), Ig2_Polytope_Polytope_PolytopeGeom()]
	O.engines = polytope.engines(geometry=rounded, gravity=(0, 0, -1), timeStepper=False)
	O.dt = 1e-4
if mpi.rank() == 0: make()
mpi.divide()
mpi.run(200)
if mpi.rank() == 0:
	places = [[float(x) for x in (*body.state.pos, *body.state.vel, *body.state.angVel)] for body in O.bodies if isinstance(body.shape, RoundedPolytope)]
	print('ANSWER', json.dumps([places, sum(i.isReal for i in O.interactions), float(O.bodies[1].shape.radius)]))
"""


def testTwoRanksAgreeWithOneProcess(tmp_path, monkeypatch):
	libraries = ':'.join(str(built(name)) for name in ('roundedPolytope', 'hyperbolicJoint'))
	path = tmp_path / 'row.py'
	path.write_text(scene)
	monkeypatch.setenv('YADE_POLYTOPE_EXTENSIONS', libraries)
	monkeypatch.setenv('OMP_NUM_THREADS', '1')
	monkeypatch.setenv('TMPDIR', str(tmp_path))
	one, two = (
		json.loads(re.findall(r'^ANSWER (.*)$', run(*command, sys.executable, path), re.MULTILINE)[-1])
		for command in ([], ['mpirun', '--oversubscribe', '-np', '2'])
	)
	assert one[1] == two[1] == 7 and one[2] == two[2] == 0.1
	for here, there in zip(one[0], two[0], strict=True):
		assert there == pytest.approx(here, rel=1e-9, abs=1e-12)
	assert min(place[5] for place in one[0]) < -1e-3  # it moves
