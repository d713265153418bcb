# SPDX-License-Identifier: GPL-2.0-or-later
"""The example of a normal law of one's own: in all that a scene shows it is the plug-in's own hyperbola."""

import pytest
from test_extensions import built, inYade


@pytest.fixture(scope='module')
def hyperbola():
	return built('hyperbolicJoint')


scene = """
from yade import polytope, Vector3
import math
def scene(closure, **more):
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=2e8, shearStiffness=1e8, frictionAngle=0.5, closure=closure(maximumClosure=4e-4), **more))
	tilt = Quaternion((1, 0, 0), 0.3)
	O.bodies.append(polytope.cuboid(center=tilt * Vector3(0, 0, -0.5), orientation=tilt, extents=(2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid(center=tilt * Vector3(0, 0, 0.5 + 1e-3), orientation=tilt, extents=(0.5, 0.4, 0.5)))
	O.trackEnergy = True
	O.engines = polytope.engines()
def state():
	c, s = O.interactions[0, 1], O.bodies[1].state
	numbers = [*s.pos, *s.vel, *s.angVel, *c.phys.normalForce, *c.phys.shearForce, c.phys.kn, c.phys.ks, O.dt, *(v for _, v in sorted(O.energy.items()))]
	return [float(x) for x in numbers]
"""


def testItIsThePlugInsHyperbolaInAllThatASceneShows(hyperbola, tmp_path):
	"""A block that falls onto a slope: motion, forces, stiffness, time step, energies; and on from a scene that was saved, in a new process."""
	saved = tmp_path / 'scene.yade.bz2'
	script = (
		'polytope.load(sys.argv[1])\nseen = []\nfor closure in (HyperbolicClosure, OwnHyperbola):\n\tscene(closure)\n\tO.run(600, True)\n'
		'\tseen.append(state())\nO.save(sys.argv[2])\nO.run(100, True)\nanswer([seen, state(), O.interactions.countReal()])\n'
	)
	(seen, later, contacts), _ = inYade(scene + script, hyperbola, saved)
	assert contacts == 1
	assert seen[1] == pytest.approx(seen[0], rel=1e-9, abs=1e-9)
	assert seen[1][9:12] != [0, 0, 0]
	again, _ = inYade(scene + 'O.load(sys.argv[1])\nO.run(100, True)\nanswer(state())\n', saved, YADE_POLYTOPE_EXTENSIONS=str(hyperbola))
	assert again == pytest.approx(later, rel=1e-9, abs=1e-9)
