# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of `./run tradeoff`: for each a function that builds it and one that measures the answer.

They are called in a process of their own, with any arithmetic, so their input must not depend on it: a number that is searched for is rounded to few digits.
*model* is the contact model, *stiffness* a factor on all stiffnesses; the time step goes with 1/√stiffness.
"""

import math
import pathlib
import sys

paper = pathlib.Path(__file__).resolve().parents[2] / 'examples/paper'
sys.path.append(str(paper))  # boon2012

import numpy as np
from boon2012.beam.scene import ThreeHingedBeam
from boon2012.collisions.scene import Collision, readBlocks
from boon2012.falling.scene import FallingPolyhedra, circumradiusOfUnitVolume
from boon2012.roofWedge.scene import RoofWedge
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.scene import WedgeScene
from boon2012.wedges.theory import roofWedgeFrictionAngle
from yade import (
	HarmonicMotionEngine,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
)
from yade._polytope import contact
from yade.polytope import engines, regular
from yade.polytope.frictionReduction import FrictionReduction

models = ('surface', 'boon2012')
solids = (4, 6, 8, 12, 20)
scene = None
"""What a build function has made, for the measure function of the same scene."""


def block(name):
	return BlockGeometry.read(str(paper / 'geometry' / name))


# ------------------------------------------------------------------------------------------------ pair: forces, with no feedback and no chaos

pairDepth, pairSwing, pairPeriod, pairSteps = 1e-2, 2e-3, 100, 25
"""Radius of the ball in the overlap over the solid's size, amplitude of its motion, time steps of one swing, and steps to a quarter of it."""


def buildPairs(model, each=4):
	"""Every pair of regular solids of unit volume, *each* times in random orientations and directions, all fixed but for a small swing."""
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=1e6, shearStiffness=1e6, frictionAngle=0, density=1000))
	random, moving = np.random.default_rng(1), []
	for k, faces in enumerate([(first, second) for i, first in enumerate(solids) for second in solids[i:]] * each):
		turns = np.round(random.standard_normal((2, 4)), 6)
		direction = random.standard_normal(3)
		direction = np.round(direction / np.linalg.norm(direction), 6)
		centre, bodies = np.array([10.0 * k, 0, 0]), []
		for number, turn in zip(faces, turns, strict=True):
			orientation = Quaternion(*map(float, turn)).normalized()
			bodies.append(regular(number, round(circumradiusOfUnitVolume(number), 9), center=tuple(centre), orientation=orientation))
		low, high = 0.0, 2.5
		while high - low > 1e-7:
			middle = (low + high) / 2
			bodies[1].state.pos = Vector3(*map(float, centre + middle * direction))
			low, high = (middle, high) if contact(*bodies).infeasibility < -pairDepth else (low, middle)
		bodies[1].state.pos = Vector3(*map(float, centre + round(high, 6) * direction))
		for body in bodies:
			body.state.blockedDOFs = 'xyzXYZ'
		moving.append(O.bodies.append(bodies)[1])
	swing = HarmonicMotionEngine(ids=moving, A=(pairSwing, 0.7 * pairSwing, 0.4 * pairSwing), f=(1, 1, 1), fi=(0, 0, 0))
	per, geometry = (
		Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False),
		Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model),
	)
	usual = engines(gravity=(0, 0, 0), damping=0, geometry=geometry, physics=per, timeStepper=False)
	O.engines = [*usual[:-1], swing, usual[-1]]
	O.dt = 1 / pairPeriod


def measurePairs():
	for _ in range(pairSteps):
		O.step()
	return [x for k in range(1, len(O.bodies), 2) for x in O.forces.f(k)]


# ------------------------------------------------------------------------------------------------ B: the beam's peak load, from imposed rotations


def buildBeam(model):
	global scene
	scene = ThreeHingedBeam(contactModel=model).build()


def measureBeam():
	"""[N]. Leaves the half-beams turning slowly."""
	found = scene.peak()
	for side, k in zip((-1, 1), scene.beamIds, strict=True):
		O.bodies[k].state.angVel = (0, 0, side * 2e-4)
	return found.load


# ------------------------------------------------------------------------------------------------ C and D: the search for the critical friction angle

frictionSteps = (8, 1, 0.1, 0.01)
"""[°]; half of the last is how exactly an angle is known."""


def jointsOfWedges(stiffness):
	"""Joints of both wedges; *stiffness* is over the paper's."""
	return {'normalStiffness': 1e7 * stiffness, 'shearStiffness': 1e7 * stiffness}


def buildSlidingWedge(model, stiffness=1):
	global scene
	scene = WedgeScene(block('c_sliding_wedge.json'), contactModel=model, **jointsOfWedges(stiffness)).build()


def measureSlidingWedge():
	scene.establishContacts()
	return criticalAngle(1.3e-3)


def buildRoofWedge(model=models[0], stiffness=1):
	global scene
	scene = RoofWedge(block('d_roof_wedge.json'), contactModel=model, **jointsOfWedges(stiffness)).build()


def measureRoofWedge():
	scene.setJointForces()
	return criticalAngle(1.15e-3)


def criticalAngle(usual):
	"""[°]. Leaves the wedge at rest in the last stable state.

	:param float usual: time step of the scene as it is [s]
	"""
	steps = [math.radians(step) for step in frictionSteps]
	between = max(1, round(100 * usual / float(O.dt)))  # of two checks, which are equally far apart in time
	reduction = FrictionReduction([scene.wedgeId], math.radians(70), steps, checkEvery=between, mostSteps=400 * between)
	found = reduction.run()
	reduction.restore()
	return math.degrees(found.critical)


def roofAngle():
	"""[°], of the geometry file with the scene's own stress, density and gravity."""
	buildRoofWedge()
	horizontal = scene.horizontalStress * sum(joint.area for joint in scene.joints) * math.cos(scene.inclinations[0])
	angle = math.degrees(roofWedgeFrictionAngle(scene.weight, horizontal, scene.inclinations[0]))
	O.reset()
	return angle


# ------------------------------------------------------------------------------------------------ F: undamped collisions; the cube of F1 at rest

fall, partings, restAfter = 1e-3, 4, 2.6
"""Fall before the first touch [m], number of collisions after which the energy is taken, time of rest [s]."""


def buildCollision(model, stiffness=1, kind='edgeEdge'):
	global scene
	scale = {'normalStiffness': 1e8 * stiffness, 'shearStiffness': 1e8 * stiffness, 'timeStep': 8.944e-5 / math.sqrt(stiffness)}
	undamped = {'frictionCoefficient': 0, 'contactDamping': 0, 'damping': 0} if kind == 'edgeEdge' else {}
	scene = Collision(*readBlocks(str(paper / 'geometry/f_collisions.json'), kind), contactModel=model, **undamped, **scale).build()
	O.trackEnergy = False


def measureCollision():
	"""Energy after the fourth collision over that of the fall. Free flight: the position is taken where the velocity belongs to."""
	state, before, count = scene.body.state, False, 0
	level = state.pos[2] - fall
	while count < partings:
		O.step()
		touching = scene.contact() is not None
		count += before and not touching
		before = touching
		if O.time > 2:
			raise RuntimeError(f'the blocks have parted {count} times only')
	spin = state.ori.conjugate() * state.angVel
	kinetic = (state.mass * state.vel.squaredNorm() + sum(state.inertia[k] * spin[k] ** 2 for k in range(3))) / 2
	weight = state.mass * scene.gravity
	return (kinetic + weight * (state.pos[2] - state.vel[2] * O.dt / 2 - level)) / (weight * fall)


def buildRest(model, stiffness=1):
	buildCollision(model, stiffness, 'vertexFace')


def measureRest():
	"""Height of the cube's centre as if the floor did not yield [m]: its sinking by m g/kₙ is added."""
	for _ in range(math.ceil(restAfter / float(O.dt))):
		O.step()
	return scene.body.state.pos[2] + scene.body.state.mass * scene.gravity / scene.normalStiffness


# ------------------------------------------------------------------------------------------------ A: a heap, which is chaotic

heapTime = 1.5
"""Simulated [s]."""


def buildHeap(model, stiffness=1, seed=1):
	global scene
	scene = FallingPolyhedra(faces=solids, number=96, columns=4, seed=seed, normalStiffness=1.25e6 * stiffness).build()
	scene.geometryFunctor.contactModel = model


def measureHeap():
	"""Coordination number: contacts of one solid, with walls and floor."""
	top = max(body.state.pos[2] for body in scene.particles())
	for _ in range(math.ceil(heapTime / float(O.dt))):
		O.step()
	if not all(-scene.size < body.state.pos[2] < top + scene.size for body in scene.particles()):
		raise RuntimeError('blew up')
	moving = set(scene.particleIds)
	return sum((one.id1 in moving) + (one.id2 in moving) for one in O.interactions if one.isReal) / scene.number
