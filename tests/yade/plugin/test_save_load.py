# SPDX-License-Identifier: GPL-2.0-or-later
"""A run that is saved, loaded and continued ends where the uninterrupted one does, bit for bit in one thread.

What YADE itself does not keep: forces (O.forces shows zero until the first step), ScGeom.penetrationDepth and shearInc (NaN and zero
until then), pairs that do not touch (their memory of the last basis starts anew, and a new contact does not use it), the collider's state
(with verletDist > 0 it searches for pairs again at once, so a body that has turned may be found in contact some steps earlier than without
the break), the order of pairs in the loop where contacts begin after the break (unless loopOnSortedInteractions gives them one: forces on a
body are summed in this order), and what scripts hold. None of it affects the motion here: the scenes search for pairs in each step.
"""

import os
import subprocess
import sys

import pytest
from yade import O, RockJointMat, polytope

# runs in a process of its own with one thread; prints the states in full precision
program = r'''
import sys
sys.path.insert(0, sys.argv[1])
import yade
from yade import *
from yade import O, Quaternion, Vector3, polytope, utils
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
	O.engines[2].loopOnSortedInteractions = True  # contacts begin after the break, and three forces add up
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	for k in range(12):
		O.bodies.append(polytope.regular((4, 6, 8, 12)[k % 4], .5, (.7 * (k % 2), .6 * (k // 2 % 2), .6 + .7 * k), Quaternion((1, k, 2), k)))
	O.dt = 6e-4

def surfaceHeap():
	"""The pieces of contact surfaces that are kept from step to step are saved."""
	heap()
	O.engines[2].geomDispatcher.functors[0].contactModel = 'spring'

def ownStep():
	"""O.dt is found by the scene, and the break lies between two updates of it."""
	heap()
	O.engines += [PolytopeTimeStepper()]

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

def centroidHeap():
	heap()
	geometry = O.engines[2].geomDispatcher.functors[0]
	geometry.contactModel = 'boon2012'
	geometry.contactPoint = 'centroid'

def ipoptTower():
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
	loop(False, normalDamping=0.3, gravity=(0.3, 0, -gravity), damping=0.1, ig2={'solver': 'ipopt', 'contactModel': 'boon2012'})
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	for k in range(2):
		O.bodies.append(polytope.cuboid((0.1 * k, 0.05 * k, 0.499 + 0.998 * k), (.5, .5, .5), Quaternion((0, 0, 1), 0.3 * k)))
	O.dt = 6e-4

def mixed():
	"""Blocks on a box, a facet, a wall and two spheres."""
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
	loop(False, normalDamping=0.3, gravity=(0.5, 0, -gravity), damping=0.1)
	pairs = [Ig2_Polytope_Polytope_PolytopeGeom(), Ig2_Wall_Polytope_PolytopeGeom(), Ig2_Box_Polytope_PolytopeGeom(),
	         Ig2_Facet_Polytope_PolytopeGeom(), Ig2_Sphere_Polytope_PolytopeGeom()]
	boxes = [Bo1_Polytope_Aabb(), Bo1_Wall_Aabb(), Bo1_Box_Aabb(), Bo1_Facet_Aabb(), Bo1_Sphere_Aabb()]
	O.engines = [O.engines[0], InsertionSortCollider(boxes, verletDist=0), InteractionLoop(pairs, *[[one] for one in
	         (O.engines[2].physDispatcher.functors[0], O.engines[2].lawDispatcher.functors[0])]), O.engines[3]]
	O.bodies.append([utils.box((0, 0, -.5), (1, 1, .5), fixed=True), utils.facet([(1, -3, 0), (4, -3, 0), (2, 3, 0)], fixed=True),
	                 utils.wall(-1, 2), utils.sphere((6, .1, 0), .5), utils.sphere((6.9, -.1, 0), .4, fixed=True)])
	for x in (-3, 0, 2.2, 6.3):
		O.bodies.append(polytope.cuboid((x, 0, 1), (.5, .4, .3), Quaternion((1, 2, 3), .2)))
	O.dt = 5e-4

def polygons():
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
	loop(True, normalDamping=0.3, rockingDamping=0.5, gravity=(0, -gravity, 0), damping=0.1)
	O.bodies.append(polytope.polygon([(-9, -1), (9, -1), (9, 0), (-9, 0)], fixed=True))
	for k in range(8):
		O.bodies.append(polytope.polygon([(x + 1.1 * (k % 3), y + 1.2 * (k // 3) + .6) for x, y in ((-.5, -.4), (.5, -.5), (.4, .5), (-.3, .5))]))
	O.dt = 5e-4

def shearedCell():
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
	loop(False, normalDamping=0.3, damping=0.1)
	O.engines[2].loopOnSortedInteractions = True  # contacts begin after the break
	O.periodic = True
	O.cell.setBox(7.9, 7.9, 7.9)
	O.cell.velGrad = ((-.1, .3, 0), (0, -.1, 0), (0, 0, -.1))
	for k in range(64):
		body = polytope.cuboid((2 * (k % 4) + 1, 2 * (k // 4 % 4) + 1, 2 * (k // 16) + 1), (.95, .9, .85))
		body.state.angVel = (k % 3 - 1, 1, k % 2)
		O.bodies.append(body)
	O.dt = 3e-4

def clumps():
	joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
	loop(False, normalDamping=0.3, gravity=(0, 0, -gravity), damping=0.1)
	O.engines[2].loopOnSortedInteractions = True  # as in heap()
	O.bodies.append(polytope.cuboid((0, 0, -1), (9, 5, 1), fixed=True))
	for k in range(3):
		at = Vector3(.3 * k, .1 * k, .35 + .8 * k)
		O.bodies.appendClumped([polytope.cuboid(at, (.6, .3, .3)), polytope.cuboid(at + Vector3(.5, .5, 0), (.3, .6, .3))])
	O.dt = 4e-4

def state():
	out = []
	for b in O.bodies:
		s = b.state
		out += [*s.pos, *s.ori, *s.vel, *s.angVel, *s.angMom]
	for i in sorted(O.interactions, key=lambda i: (i.id1, i.id2)):
		if i.isReal: out += [i.id1, i.id2, *i.phys.normalForce, *i.phys.shearForce, i.geom.penetrationDepth]
	out += [v for _, v in sorted(O.energy.items())] + [O.dt]
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
	here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
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


@pytest.mark.parametrize('scene', ['heap', 'surfaceHeap'])
def testHeapIsResumed(scene, tmp_path):
	uninterrupted, resumed = runs(scene, 3000, 500, tmp_path / 'scene.xml')
	# nine and sixteen contacts in double; how many there are just then differs with the numbers' rounding
	contacts = 8 if polytope.buildInfo()['precision'] == 'double' else 6
	assert len(uninterrupted) >= 13 * 16 + contacts * 9
	assert resumed == uninterrupted


@pytest.mark.parametrize('scene', ['slidePerArea', 'slidePerContact'])
def testSlideOverJointsIsResumed(scene, tmp_path):
	"""What is left out as internal faces, and shares of stiffness, go on; saved while the body lies on all three pieces."""
	uninterrupted, resumed = runs(scene, 300, 501, tmp_path / 'scene.yade.gz')
	assert len(uninterrupted) >= 4 * 16 + 2 * 9
	assert resumed == uninterrupted


others = [
	('centroidHeap', 2500, 200, 4),
	('ownStep', 3017, 300, 2),
	('mixed', 1500, 300, 4),
	('polygons', 1200, 300, 6),
	('shearedCell', 600, 300, 4),
	('clumps', 1500, 300, 3),
]
"""Scene, steps until it is saved, steps after it, and contacts that there are at least."""
needsIpopt = pytest.mark.skipif(not polytope.buildInfo()['ipopt'], reason='this build has no Ipopt')
others.append(pytest.param('ipoptTower', 40, 20, 2, marks=needsIpopt))


@pytest.mark.parametrize('scene,before,after,contacts', others)
def testOtherScenesAreResumed(scene, before, after, contacts, tmp_path):
	uninterrupted, resumed = runs(scene, before, after, tmp_path / 'scene.yade.gz')
	assert resumed == uninterrupted
	bodies = {'centroidHeap': 13, 'ownStep': 13, 'ipoptTower': 3, 'mixed': 9, 'polygons': 9, 'shearedCell': 64, 'clumps': 10}[scene]
	assert len(uninterrupted) >= bodies * 16 + contacts * 9


damaged = r'''
import sys
sys.path.insert(0, sys.argv[1])
from yade import O, polytope
from scenes import blockOnFloor, joint, loop

joint()
loop()
blockOnFloor(1e-3)
O.dt = 1e-5
O.run(5, True)
folder = sys.argv[2]
refused = 0

def load(path, content):
	global refused
	with open(path, 'wb') as file: file.write(content)
	try:
		O.load(path)
	except (RuntimeError, ValueError) as error:
		assert str(error)
		refused += 1
	else:
		print('LOADED', path)

for name in ('scene.xml', 'scene.xml.bz2', 'scene.yade', 'scene.yade.gz'):
	path = folder + '/' + name
	O.save(path)
	with open(path, 'rb') as file: whole = file.read()
	for part in (0, 0.1, 0.5, 0.9, 0.99):
		load(folder + '/damaged-' + name, whole[:int(part * len(whole))])
	O.load(path)
	O.run(3, True)
	assert len(O.bodies) == 2 and O.interactions[0, 1].isReal

text = open(folder + '/scene.xml').read()
block = text.index('<offsets', text.index('<offsets') + 1)
first = text.index('<item>', block) + 6
end = text.index('</item>', first)
for number in ('nan', 'inf', '-1', '0', '1e300', '0.6', 'half'):
	load(folder + '/damaged.xml', (text[:first] + number + text[end:]).encode())
O.load(folder + '/scene.xml')
O.run(3, True)
assert len(O.bodies) == 2 and O.interactions[0, 1].isReal
print('REFUSED', refused)
'''


def testDamagedArchivesAreRefused(tmp_path):
	"""Truncated anywhere, or with a plane that makes no body about its centroid: an exception, and the process goes on."""
	here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
	done = subprocess.run([sys.executable, '-c', damaged, here, str(tmp_path)], capture_output=True, text=True, timeout=600)
	assert done.returncode == 0, done.stdout[-1000:] + done.stderr[-3000:]
	assert 'LOADED' not in done.stdout and 'REFUSED 27' in done.stdout, done.stdout


def testARunIsContinuedWhateverYadeIsBuiltWith(tmp_path):
	"""A state may come from a run on several processes, and what stood for these is erased. YADE's wider precisions are built without MPI:
	bodies have no subdomain there."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.4))
	O.bodies.append([polytope.cuboid((0, 0, -0.5), (1, 1, 0.5), fixed=True), polytope.cuboid((0, 0, 0.499), (0.4, 0.4, 0.5))])
	O.engines = polytope.engines() + [polytope.checkpoint(str(tmp_path / 'run'), iterPeriod=2, onSignal=False)]
	O.run(3, True)
	O.reset()
	assert polytope.continueFrom(str(tmp_path / 'run')) and O.iter == 3  # taken in the step from 2 to 3
	O.run(2, True)
	assert O.interactions[0, 1].isReal
