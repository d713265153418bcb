# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of `./run tradeoff`: for each a function that builds it and one that measures the answer that matters there.

They run in processes of their own with any arithmetic (see polytope.tradeoff), so their input must not depend on it: a number
that is searched for is rounded to few digits. *stiffness* is a factor on all stiffnesses; the time step goes with 1/√stiffness.
"""

import math
import os
import pathlib
import sys

import numpy as np
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	HarmonicMotionEngine,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
)
from yade._polytope import contact
from yade.polytope.bodies.polytopes import regular
from yade.polytope.frictionReduction import FrictionReduction

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # in a process of its own, too
from boon2012.beam.scene import ThreeHingedBeam
from boon2012.collisions.scene import Collision, readBlocks
from boon2012.roofWedge.scene import RoofWedge
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.scene import WedgeScene
from yade.polytope.fallingPolyhedra import FallingPolyhedra, circumradiusOfUnitVolume

solids = (4, 6, 8, 12, 20)
geometryFolder = str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper/geometry')
"""Of the paper's geometry files."""


def geometry(name):
	return os.path.join(geometryFolder, name)


# Pairs: contact forces of all kinds of regular solids, in motion. The arithmetic's own scene: no feedback, no chaos.

pairDepth, pairSwing, pairPeriod, pairSteps = 1e-2, 2e-3, 100, 25
"""Radius of the ball in the overlap over the solid's size, amplitude of its motion, time steps of one swing, and steps to a quarter of it."""


def buildPairs(each=4):
	"""Every pair of regular solids of unit volume, *each* times in random orientations and directions, all fixed but for a small swing."""
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=1e6, shearStiffness=1e6, frictionAngle=0, density=1000))
	random, moving = np.random.default_rng(1), []
	kinds = [(first, second) for k, first in enumerate(solids) for second in solids[k:]] * each
	for k, (first, second) in enumerate(kinds):
		quaternions = np.round(random.standard_normal((2, 4)), 6)
		direction = random.standard_normal(3)
		direction = np.round(direction / np.linalg.norm(direction), 6)
		center = np.array([10.0 * k, 0, 0])
		bodies = [
			regular(faces, round(circumradiusOfUnitVolume(faces), 9), center=tuple(center), orientation=Quaternion(*map(float, turn)).normalized())
			for faces, turn in zip((first, second), quaternions, strict=True)
		]
		low, high = 0.0, 2.5
		while high - low > 1e-7:
			middle = (low + high) / 2
			bodies[1].state.pos = Vector3(*map(float, center + middle * direction))
			low, high = (middle, high) if contact(*bodies).infeasibility < -pairDepth else (low, middle)
		bodies[1].state.pos = Vector3(*map(float, center + round(high, 6) * direction))
		for body in bodies:
			body.state.blockedDOFs = 'xyzXYZ'
			O.bodies.append(body)
		moving.append(bodies[1].id)
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.05),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012')],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()],
		),
		HarmonicMotionEngine(ids=moving, A=(pairSwing, 0.7 * pairSwing, 0.4 * pairSwing), f=(1, 1, 1), fi=(0, 0, 0)),
		NewtonIntegrator(),
	]
	O.dt = 1 / pairPeriod


def measurePairs():
	"""All contact forces, and their moments about the second bodies' centres."""
	for _ in range(pairSteps):
		O.step()
	forces, moments = [], []
	for k in range(1, len(O.bodies), 2):
		forces += list(O.forces.f(k))
		moments += list(O.forces.t(k))
	return {'forces': forces, 'moments': moments}


# B: the beam's peak load, from imposed rotations in equilibrium.


def buildBeam():
	return ThreeHingedBeam().build()


def measureBeam(scene):
	"""The peak load [N] and its rotation [°]. Leaves the half-beams turning slowly."""
	found = scene.peak()
	for side, k in zip((-1, 1), scene.beamIds, strict=True):
		O.bodies[k].state.angVel = (0, 0, side * 2e-4)
	return {'peak load [N]': found.load, 'at [°]': math.degrees(found.rotation)}


# C and D: the whole search for the critical friction angle.

frictionSteps = (8, 1, 0.1, 0.01)
"""[°]; half of the last is how exactly an angle is known."""


def buildSlidingWedge(stiffness=1):
	blocks = BlockGeometry.read(geometry('c_sliding_wedge.json'))
	return WedgeScene(blocks, normalStiffness=1e7 * stiffness, shearStiffness=1e7 * stiffness).build()


def measureSlidingWedge(scene):
	scene.establishContacts()
	return _criticalAngle(scene, 1.3e-3)


def buildRoofWedge(stiffness=1):
	blocks = BlockGeometry.read(geometry('d_roof_wedge.json'))
	return RoofWedge(blocks, normalStiffness=1e7 * stiffness, shearStiffness=1e7 * stiffness).build()


def measureRoofWedge(scene):
	scene.setJointForces()
	return _criticalAngle(scene, 1.15e-3)


def _criticalAngle(scene, usual):
	"""[°]. Leaves the wedge at rest in the last stable state.

	:param float usual: time step of the scene as it is [s]
	"""
	steps = [math.radians(step) for step in frictionSteps]
	stepsBetween = max(1, round(100 * usual / float(O.dt)))  # of two checks, which are equally far apart in time
	reduction = FrictionReduction([scene.wedgeId], math.radians(70), steps, checkEvery=stepsBetween, mostSteps=400 * stepsBetween)
	found = reduction.run()
	reduction.restore()
	return math.degrees(found.critical)


# F: energy of frictionless, undamped collisions; and the cube of F1 when it has come to rest, as in the paper.

fall = 1e-3
"""Before the first touch [m]."""
partings = 4
"""Collisions after which the energy is taken."""
restAfter = 2.6
"""[s]"""


def buildCollision(stiffness=1):
	scale = {'normalStiffness': 1e8 * stiffness, 'shearStiffness': 1e8 * stiffness, 'timeStep': 8.944e-5 / math.sqrt(stiffness)}
	return Collision(*readBlocks(geometry('f_collisions.json'), 'edgeEdge'), frictionCoefficient=0, contactDamping=0, damping=0, **scale).build()


def measureCollision(scene):
	"""Energy after the fourth collision over that of the fall. Free flight: the position is taken where the velocity belongs to."""
	O.trackEnergy = False
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
	return {'energy over that of the fall': (kinetic + weight * (state.pos[2] - state.vel[2] * O.dt / 2 - level)) / (weight * fall)}


def buildRest(stiffness=1):
	scale = {'normalStiffness': 1e8 * stiffness, 'shearStiffness': 1e8 * stiffness, 'timeStep': 8.944e-5 / math.sqrt(stiffness)}
	return Collision(*readBlocks(geometry('f_collisions.json'), 'vertexFace'), **scale).build()


def measureRest(scene):
	"""Height of the cube's centre as if the floor did not yield, [m]: its sinking by m g/kₙ is added."""
	O.trackEnergy = False
	for _ in range(math.ceil(restAfter / float(O.dt))):
		O.step()
	sink = scene.body.state.mass * scene.gravity / scene.normalStiffness
	return {'height at rest + m g/kn [m]': scene.body.state.pos[2] + sink}


# A: a heap, which is chaotic: its answers are known to the scatter between seeds only.

heapTime = 1.5
"""Simulated [s]."""


def buildHeap(stiffness=1, seed=1):
	scene = FallingPolyhedra(faces=solids, number=96, columns=4, seed=seed, normalStiffness=1.25e6 * stiffness).build()
	scene.geometryFunctor.contactModel = 'boon2012'
	return scene


def measureHeap(scene):
	"""Coordination number (contacts of one solid, with walls and floor) and porosity up to twice the mean height of the centres."""
	for _ in range(math.ceil(heapTime / float(O.dt))):
		O.step()
	moving = set(scene.particleIds)
	touching = sum((contact.id1 in moving) + (contact.id2 in moving) for contact in O.interactions if contact.isReal)
	height = 2 * sum(body.state.pos[2] for body in scene.particles()) / scene.number
	porosity = 1 - scene.number * scene.size**3 / (scene.width**2 * height)
	return {'coordination number': touching / scene.number, 'porosity': porosity}
