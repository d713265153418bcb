# SPDX-License-Identifier: GPL-2.0-or-later
"""A jointed slope in one YADE process, for beside.py: blocks of three joint sets, which friction holds, until they rest; then what a step takes.

Usage: slope.py '{"scale": 3, "perArea": true, "settle": 20000, "steps": 100}'. The last line printed is RESULT and JSON. It uses only what the
project has had since before its contact was a surface, so that older revisions can be measured with it.
"""

import json
import os
import sys
import time
from math import cos, pi, radians, sin

import numpy as np
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	PolytopeTimeStepper,
	RockJointMat,
	polytope,
)

east, north, west = pi / 2, 0, 3 * pi / 2
height, length, width = 14, 24, 10
dip = radians(60)
friction = radians(60)
"""More than the dip of the bedding, 35°: nothing slides."""


def build(scale, perArea):
	"""Joints *scale* times as close as in the coarsest slope; the blocks of the lower and the far side are fixed."""
	normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (-sin(dip), 0, cos(dip))]
	offsets = [length, 2, width, 0, height, 2, 0]
	sets = [
		polytope.JointSet(radians(35), west, spacing=2 / scale),
		polytope.JointSet(radians(80), east, spacing=3 / scale, exponential=True, fisher=400),
		polytope.JointSet(radians(85), north, spacing=2.5 / scale, exponential=True, fisher=400),
	]
	O.materials.append(RockJointMat(density=2600, normalStiffness=2e8, shearStiffness=1e8, frictionAngle=friction))
	for planes in polytope.jointedRock(normals, offsets, sets, smallest=0.3 / scale, seed=3).blocks:
		body = polytope.fromHalfSpaces(*planes)
		corners = np.array([body.state.pos + body.state.ori * corner for corner in body.shape.vertices], float)
		if corners[:, 2].min() < 1e-6 or corners[:, 0].max() > length - 1e-6:
			body.state.blockedDOFs = 'xyzXYZ'
		O.bodies.append(body)
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.02),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom()],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(**{} if perArea else {'stiffnessPerArea': False})],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.2, shearDamping=0.2)],
		),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.2),
		PolytopeTimeStepper(),
	]


def main(scale, perArea, settle, steps, chunks=10):
	build(scale, perArea)
	O.run(settle, True)
	rows = []
	for _ in range(chunks):
		started = time.process_time()
		# in this thread: O.run(…, True) checks only every 40 ms whether it is done
		for _ in range(max(1, steps // chunks)):
			O.step()
		rows.append({'step': (time.process_time() - started) / max(1, steps // chunks)})
	return {'rows': rows, 'bodies': len(O.bodies), 'contacts': O.interactions.countReal(), 'timeStep': O.dt}


if __name__ == '__main__':
	print('RESULT', json.dumps(main(**json.loads(sys.argv[1]))), flush=True)
	os._exit(0)  # YADE's own clean-up at exit is not measured
