# SPDX-License-Identifier: GPL-2.0-or-later
"""One heap in one YADE process, for scenes.py: makes it, or takes over its state, and measures the InteractionLoop.

Usage: heap.py '{"method": "ours", …}' with the fields of Request as JSON. The last line printed is RESULT and JSON.
"""

import dataclasses
import json
import os
import pathlib
import sys
import time

import numpy as np
from memory import memoryInUse
from yade import Body, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator, O, Quaternion, Vector3, utils

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))
from boon2012.falling.scene import FallingPolyhedra, circumradiusOfUnitVolume


@dataclasses.dataclass
class Request:
	method: str = 'ours'
	"""ours, spheres (YADE's own, of the same volume), potentialBlock or polyhedra (YADE's own, built by YadePeers.cmake)."""
	faces: tuple = (6,)
	number: int = 200
	columns: int = 6
	compact: bool = False
	"""Lattice as tight as cubes in any orientation allow: they fall in a shorter time."""
	settle: int = 1000
	"""Steps before the measured ones."""
	steps: int = 200
	chunks: int = 10
	"""The measured steps in so many parts, whose median counts."""
	save: str = ''
	"""Where to write the bodies' state after the settling steps (.npz)."""
	load: str = ''
	"""State to start from instead of the lattice; then *settle* steps are made all the same."""
	pairs: str = ''
	"""Where to write the real contacts of the last step, for the kernels' benchmark (.csv)."""
	area: bool = False
	"""Ours: also the contact section's area."""
	perArea: bool = False
	"""Ours: stiffnesses per contact area, anew in each step."""
	energy: bool = False
	"""Ours: with O.trackEnergy."""
	ballBoxes: bool = False
	"""Ours: with YADE's own collider, for which bodies that can turn have the boxes of their circumscribed balls."""
	recorder: str = ''
	"""Ours: a PolytopeVTKRecorder that writes bodies and contacts in every 100th step, to files that begin so."""


class Heap(FallingPolyhedra):
	"""The falling heap of simulation A with particles ten times as large, times and relative overlaps as there:
	PotentialBlock finds the vertices of a shape with tolerances in metres."""

	compact = False

	@property
	def spacing(self):
		return 1.75 * self.size if self.compact else super().spacing


def heap(request):
	scene = Heap(
		faces=tuple(request.faces),
		number=request.number,
		columns=request.columns,
		size=1,
		normalStiffness=1.25e8,
		leastWallHeight=16,
		wallThickness=1,
	)
	scene.compact = request.compact
	return scene


# ------------------------------------------------------------------------------------------------------------ YADE's own shapes


def volumetricStiffness(scene):
	"""Force per overlap volume, of contacts of a tenth of a cube's face [N/m³]."""
	return scene.normalStiffness / (0.1 * scene.size**2)


def toPotentialBlock(shape, scene):
	from yade import FrictMat, PotentialBlock

	a, b, c = np.array([list(n) for n in shape.normals]).T.tolist()
	r = shape.cornerRadius
	own = PotentialBlock(a=a, b=b, c=c, d=[d - r for d in shape.offsets], r=r, R=0, AabbMinMax=True)
	return own, FrictMat(young=-1, poisson=-1, frictionAngle=scene.frictionAngle, density=scene.density), own.orientation


def toPolyhedra(shape, scene):
	from yade import Polyhedra, PolyhedraMat

	own = Polyhedra(v=list(shape.vertices))
	own.Initialize()
	stiffness = volumetricStiffness(scene)
	material = PolyhedraMat(young=2 * stiffness, poisson=scene.stiffnessRatio, frictionAngle=scene.frictionAngle, density=scene.density)
	return own, material, own.GetOri()


def potentialBlockLoop(scene):
	from yade import Ig2_PB_PB_ScGeom, Ip2_FrictMat_FrictMat_KnKsPBPhys, Law2_SCG_KnKsPBPhys_KnKsPBLaw, PotentialBlock2AABB

	normal = volumetricStiffness(scene)
	shear = scene.stiffnessRatio * normal
	return PotentialBlock2AABB(), InteractionLoop(
		[Ig2_PB_PB_ScGeom()],
		[Ip2_FrictMat_FrictMat_KnKsPBPhys(kn_i=normal, ks_i=shear, Knormal=normal, Kshear=shear, viscousDamping=scene.contactDamping)],
		[Law2_SCG_KnKsPBPhys_KnKsPBLaw(allowViscousAttraction=False)],
	)


def polyhedraLoop(scene):
	from yade import (
		Bo1_Polyhedra_Aabb,
		Ig2_Polyhedra_Polyhedra_PolyhedraGeom,
		Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys,
		Law2_PolyhedraGeom_PolyhedraPhys_Volumetric,
	)

	return Bo1_Polyhedra_Aabb(), InteractionLoop(
		[Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
		[Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
		[Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()],
	)


def replaceByPeer(scene, convert, loop):
	"""The scene's bodies become the peer's, at their places; engines likewise. Each body has a shape of its own, as
	YADE's functions for these shapes make them. Returns the memory in use without either [bytes]."""
	shapes, states = {}, []
	for body in O.bodies:
		key = tuple(body.shape.offsets), body.shape.cornerRadius, tuple(map(tuple, body.shape.normals))
		shapes.setdefault(key, body.shape)
		state = body.state
		# copies: YADE returns references to the body
		vectors = [Vector3(getattr(state, name)) for name in ('pos', 'vel', 'angVel', 'inertia')]
		states.append((shapes[key], body.aspherical, vectors, Quaternion(state.ori), state.mass, state.blockedDOFs))
	step = O.dt
	scene.interactionLoop = scene.geometryFunctor = None
	O.reset()
	empty = memoryInUse()
	material = None
	for shape, aspherical, (pos, vel, angVel, inertia), ori, mass, blocked in states:
		new = Body()
		new.shape, ownMaterial, turn = convert(shape, scene)
		if material is None:
			material = O.materials[O.materials.append(ownMaterial)]
		new.aspherical, new.material = aspherical, material
		new.state.pos, new.state.ori, new.state.vel, new.state.angVel = pos, ori * turn, vel, angVel
		new.state.mass, new.state.inertia, new.state.blockedDOFs = mass, inertia, blocked
		O.bodies.append(new)
	bound, scene.interactionLoop = loop(scene)
	setEngines(scene, [bound])
	O.dt = step
	return empty


def setEngines(scene, bounds):
	O.engines = [
		ForceResetter(),
		InsertionSortCollider(bounds, verletDist=scene.verletFraction * scene.size),
		scene.interactionLoop,
		NewtonIntegrator(damping=scene.damping, gravity=(0, 0, -scene.gravity)),
	]


def replaceBySpheres(scene):
	"""Spheres of the particles' volume, of the same mass and contact stiffness, between walls at the same places."""
	from yade import (
		Bo1_Sphere_Aabb,
		Bo1_Wall_Aabb,
		FrictMat,
		Ig2_Sphere_Sphere_ScGeom,
		Ig2_Wall_Sphere_ScGeom,
		Ip2_FrictMat_FrictMat_FrictPhys,
		Law2_ScGeom_FrictPhys_CundallStrack,
	)

	# aside by a little: exactly above each other they would stay so
	aside = np.random.default_rng(scene.seed).uniform(-0.1, 0.1, (scene.number, 2)) * scene.size
	places = [
		(body.state.pos[0] + x, body.state.pos[1] + y, body.state.pos[2]) for body, (x, y) in zip(scene.particles(), aside, strict=True)
	]
	step = O.dt
	O.reset()
	radius = scene.size * (3 / (4 * np.pi)) ** (1 / 3)
	# Ip2_FrictMat_FrictMat_FrictPhys: kn = 2 E1 R1 E2 R2 / (E1 R1 + E2 R2) for equal ones E R
	O.materials.append(
		FrictMat(
			density=scene.density, young=scene.normalStiffness / radius, poisson=scene.stiffnessRatio, frictionAngle=scene.frictionAngle
		)
	)
	half = scene.width / 2
	O.bodies.append([utils.wall(0, 2, sense=1)] + [utils.wall(side * half, axis, sense=-side) for axis in (0, 1) for side in (-1, 1)])
	scene.particleIds = O.bodies.append([utils.sphere(place, radius) for place in places])
	scene.interactionLoop = InteractionLoop(
		[Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]
	)
	setEngines(scene, [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()])
	O.dt = step


# ------------------------------------------------------------------------------------------------------------------- state


def saveState(path):
	"""Orientations as (x, y, z, w)."""
	states = [body.state for body in O.bodies]
	np.savez_compressed(
		path, **{name: np.array([list(getattr(state, name)) for state in states]) for name in ('pos', 'ori', 'vel', 'angVel')}
	)


def loadState(path):
	with np.load(path) as data:
		for body, pos, ori, vel, angVel in zip(O.bodies, data['pos'], data['ori'], data['vel'], data['angVel'], strict=True):
			body.state.pos, body.state.vel, body.state.angVel = pos, vel, angVel
			body.state.ori = Quaternion(ori[3], *ori[:3])


def writePairs(path, scene):
	"""Real contacts of the particles for PairSets.cpp: faces and circumradius of both, rotation of both, from centre to centre."""
	particles = set(scene.particleIds)
	rows = []
	for contact in O.interactions:
		if not contact.isReal or contact.id1 not in particles or contact.id2 not in particles:
			continue
		one, two = O.bodies[contact.id1].state, O.bodies[contact.id2].state
		row = []
		for number in (contact.id1, contact.id2):
			faces = len(O.bodies[number].shape.normals)
			row += [faces, circumradiusOfUnitVolume(faces) * scene.size]
		for state in (one, two):
			row += [x for line in state.ori.toRotationMatrix() for x in line]
		rows.append(row + list(two.pos - one.pos))
	np.savetxt(path, rows, fmt='%.17g', delimiter=',')


# ------------------------------------------------------------------------------------------------------------------- measuring


def askFor(scene, request):
	"""Optional features that a script may use."""
	scene.geometryFunctor.computeArea = request.area
	if request.perArea:
		scene.interactionLoop.physDispatcher.functors[0].stiffnessPerArea = True
		for name in ('normalStiffness', 'shearStiffness'):  # of contacts of a tenth of a cube's face
			setattr(O.materials[0], name, getattr(O.materials[0], name) / (0.1 * scene.size**2))
	O.trackEnergy = request.energy
	if request.ballBoxes:
		tight = O.engines[1]
		O.engines = [O.engines[0], InsertionSortCollider(tight.boundDispatcher.functors, verletDist=tight.verletDist), *O.engines[2:]]
	if request.recorder:
		from yade import PolytopeVTKRecorder

		O.engines += [PolytopeVTKRecorder(fileName=request.recorder, iterPeriod=100, recorders=['bodies', 'contacts'])]


def measure(scene, request):
	"""Medians' raw material: one row a chunk of steps."""
	rows = []
	each = max(1, request.steps // request.chunks)
	O.timingEnabled = True
	for _ in range(request.chunks):
		for engine in O.engines:
			engine.execTime = 0
		before = len(O.interactions), O.interactions.countReal()
		wall, processor = time.perf_counter(), time.process_time()
		# in this thread: O.run(…, True) checks only every 40 ms whether it is done
		for _ in range(each):
			O.step()
		wall, processor = time.perf_counter() - wall, time.process_time() - processor
		after = len(O.interactions), O.interactions.countReal()
		# YADE's clock goes on while another process has the core: with one thread, only the share that was ours counts
		share = min(1, processor / wall) if O.numThreads == 1 else 1
		rows.append(
			{
				'pairs': (before[0] + after[0]) / 2,
				'contacts': (before[1] + after[1]) / 2,
				'loop': 1e-9 * share * scene.interactionLoop.execTime / each,
				'step': 1e-9 * share * sum(engine.execTime for engine in O.engines) / each,
				'engines': {type(engine).__name__: 1e-9 * share * engine.execTime / each for engine in O.engines},
				'share': share,
			}
		)
	O.timingEnabled = False
	return rows


def linearShare(scene):
	"""Part of the contacts since the last call that were taken from their last full computation, to first order."""
	found = scene.geometryFunctor.stats()
	scene.geometryFunctor.resetStats()
	return found['linear'] / max(1, found['contacts'])


def main(request):
	scene = heap(request)
	empty = memoryInUse()
	scene.build()
	if request.method == 'spheres':
		replaceBySpheres(scene)
	if request.load:
		loadState(request.load)
	if request.method == 'potentialBlock':
		empty = replaceByPeer(scene, toPotentialBlock, potentialBlockLoop)
	elif request.method == 'polyhedra':
		empty = replaceByPeer(scene, toPolyhedra, polyhedraLoop)
	elif request.method == 'ours':
		askFor(scene, request)
	bodies = memoryInUse()
	started = time.perf_counter()
	if request.settle:
		O.run(request.settle, True)
	settled = time.perf_counter() - started
	if request.save:
		saveState(request.save)
	if request.method == 'ours':
		linearShare(scene)
	rows = measure(scene, request)
	if request.pairs:
		writePairs(request.pairs, scene)
	speed = np.max([body.state.vel.norm() for body in O.bodies])
	if not np.isfinite(speed):
		sys.exit(f'{request.method}: bodies have velocities that are not finite')
	return {
		'request': dataclasses.asdict(request),
		'rows': rows,
		'bodies': len(O.bodies),
		'threads': O.numThreads,
		'settleSeconds': settled,
		'largestSpeed': float(speed),
		'emptyBytes': empty,
		'bodiesBytes': bodies,
		'endBytes': memoryInUse(),
		'pairs': len(O.interactions),
		'contacts': O.interactions.countReal(),
		'linear': linearShare(scene) if request.method == 'ours' else None,
	}


if __name__ == '__main__':
	print('RESULT', json.dumps(main(Request(**json.loads(sys.argv[1])))), flush=True)
	os._exit(0)  # YADE's own clean-up at exit is not measured
