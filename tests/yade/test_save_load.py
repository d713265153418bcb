# SPDX-License-Identifier: GPL-2.0-or-later
"""A run that is saved, loaded and continued ends where the uninterrupted one does, bit for bit in one thread.

What YADE itself does not keep: forces (O.forces shows zero until the first step), ScGeom.penetrationDepth and shearInc (NaN and zero
until then), pairs that do not touch (their memory of the last basis starts anew), the collider's state (with verletDist > 0 it
searches for pairs again at once, so a body that has turned may be found in contact some steps earlier than without the break), and what
scripts hold. None of it affects the motion here: the scenes search for pairs in each step.
"""
import math
import os
import subprocess
import sys

import pytest
from yade import O, Quaternion, Vector3, polytope

from scenes import joint, loop

# runs in a process of its own with one thread; prints the states in full precision
program = r'''
import sys
sys.path.insert(0, sys.argv[1])
import yade
from yade import O, Quaternion, Vector3, polytope
from scenes import gravity, joint, loop

def columns():
	"""Four blocks, none with more than two contacts: friction, tension, dilation, dampers, energy."""
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4, cohesion=2e4, tensileStrength=1e4, residualFrictionAngle=0.3, dilationAngle=0.05)
	loop(True, normalDamping=0.2, shearDamping=0.1, rockingDamping=0.1, gravity=(1.5, 0, -gravity), damping=0.05)
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	for k in range(2):
		O.bodies.append(polytope.cuboid((-3 + 3 * k, 0, .3), (.5, .4, .3)))
		O.bodies.append(polytope.cuboid((-3.1 + 3 * k, 0.02, .95), (.3, .4, .3), Quaternion((1, 2, 3), 0.2 * k)))
	O.dt = 3e-4

def heap():
	"""Twelve solids fallen on each other."""
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
	loop(False, normalDamping=0.3, gravity=(0, 0, -gravity), damping=0.1)
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	for k in range(12):
		O.bodies.append(polytope.regular((4, 6, 8, 12)[k % 4], .5, (.7 * (k % 2), .6 * (k // 2 % 2), .6 + .7 * k), Quaternion((1, k, 2), k)))
	O.dt = 6e-4

def conservativeHeap():
	heap()
	O.engines[2].geomDispatcher.functors[0].contactModel = 'conservative'

def slide(perArea):
	"""A prism slides over the joints of three flush plates that meet in a T."""
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.1)
	loop(perArea, normalDamping=0.3, gravity=(0, 0, -gravity))
	for centre, half in (((-2, 0, -.5), (2, 2, .5)), ((2, -1, -.5), (2, 1, .5)), ((2, 1, -.5), (2, 1, .5))):
		O.bodies.append(polytope.cuboid(centre, half, fixed=True))
	body = polytope.cuboid((-.2, 0.05, .2495), (.4, .3, .25), Quaternion((0, 0, 1), 0.3))
	body.state.vel = (2, .1, 0)
	O.bodies.append(body)
	O.dt = 3e-4

def slidePerArea():
	slide(True)

def slidePerContact():
	slide(False)

def state():
	out = []
	for b in O.bodies:
		s = b.state
		out += [*s.pos, *s.ori, *s.vel, *s.angVel, *s.angMom]
	for i in sorted(O.interactions, key=lambda i: (i.id1, i.id2)):
		if i.isReal: out += [i.id1, i.id2, *i.phys.normalForce, *i.phys.shearForce, i.geom.penetrationDepth]
	out += [v for _, v in sorted(O.energy.items())]
	return ' '.join(float(x).hex() for x in out)

scene, before, after, archive, energy = sys.argv[2], int(sys.argv[3]), int(sys.argv[4]), sys.argv[5], sys.argv[6] == 'energy'
globals()[scene]()
O.trackEnergy = energy
O.run(before, True)
O.save(archive)
O.run(after, True)
print('RESULT', state())
O.reset()
O.load(archive)
O.run(after, True)
print('RESULT', state())
'''


def runs(scene, before, after, archive, energy=False):
	here = os.path.dirname(os.path.abspath(__file__))
	environment = dict(os.environ, OMP_NUM_THREADS='1')
	command = [sys.executable, '-c', program, here, scene, str(before), str(after), str(archive), 'energy' if energy else 'none']
	output = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=1800)
	assert output.returncode == 0, output.stderr
	return [[float.fromhex(x) for x in line.split()[1:]] for line in output.stdout.splitlines() if line.startswith('RESULT')]


@pytest.mark.parametrize('archive', ['scene.xml', 'scene.xml.bz2', 'scene.yade', 'scene.yade.gz'])
@pytest.mark.parametrize('before', [1, 700])
def testSavedAndResumedEqualsUninterrupted(archive, before, tmp_path):
	uninterrupted, resumed = runs('columns', before, 1500, tmp_path / archive)
	assert len(uninterrupted) >= 5 * 16 + 2 * 9  # two contacts or more are left
	assert resumed == uninterrupted


def testEnergiesAreResumed(tmp_path):
	uninterrupted, resumed = runs('columns', 700, 800, tmp_path / 'scene.yade', energy=True)
	assert resumed == uninterrupted


@pytest.mark.parametrize('scene', ['heap', 'conservativeHeap'])
def testHeapIsResumed(scene, tmp_path):
	uninterrupted, resumed = runs(scene, 3000, 500, tmp_path / 'scene.xml')
	# eleven and sixteen contacts in double; how many there are just then differs with the numbers' rounding
	contacts = 10 if polytope.buildInfo()['precision'] == 'double' else 6
	assert len(uninterrupted) >= 13 * 16 + contacts * 9
	assert resumed == uninterrupted


@pytest.mark.parametrize('scene', ['slidePerArea', 'slidePerContact'])
def testSlideOverJointsIsResumed(scene, tmp_path):
	"""What is left out as internal faces, and shares of stiffness, go on; saved while the body lies on all three pieces."""
	uninterrupted, resumed = runs(scene, 300, 501, tmp_path / 'scene.yade.gz')
	assert len(uninterrupted) >= 4 * 16 + 2 * 9
	assert resumed == uninterrupted


def testAPairApartHasNoJunk():
	"""Its geometry is saved, too; YADE leaves normal and contact point as they lie in memory."""
	joint()
	loop()
	O.bodies.append(polytope.cuboid((0, 0, 0), (.5, .5, .5)))
	O.bodies.append(polytope.cuboid((1, 1, 0), (.5, .5, .5), Quaternion((0, 0, 1), math.pi / 4)))  # boxes overlap, bodies do not
	O.dt = 1e-4
	O.step()
	(pair,) = O.interactions.all(onlyReal=False)
	assert not pair.isReal
	assert pair.geom.normal == Vector3.Zero and pair.geom.contactPoint == Vector3.Zero
