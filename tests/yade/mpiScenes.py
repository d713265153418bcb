# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that test_mpi.py runs on one process and, under mpirun, on several: `mpiScenes.py FOLDER SCENE …`.

Each writes what rank 0 has at its end to FOLDER/SCENE-RANKS.json, all numbers in full.
"""

import json
import os
import random
import sys
import time
import warnings

import numpy as np
import yade
from mpiClumpScenes import carried, clumpedSliding, clumpOf, startClumps  # noqa: F401 (called by their names)
from mpiSceneState import folder, load, master, material, settling, solids, state, steps
from yade import O, Quaternion, Vector3, polytope
from yade.polytope import mpi

os.cpu_count = lambda: 2  # so that on any machine rank 0 sleeps while it waits on three ranks, and does not on two

radius = 0.22


def start():
	"""A heap that has come to rest in a box, on one process."""
	random.seed(1)
	material()
	O.bodies.append(polytope.plates((-1, -0.5, 0), (1, 0.5, 2)))
	for k in range(solids):
		place = (-0.75 + 0.5 * (k % 4) + random.uniform(-0.02, 0.02), -0.24 + 0.48 * (k // 4 % 2), 0.25 + 0.45 * (k // 8))
		O.bodies.append(polytope.regular((4, 6, 8, 12, 20)[k % 5], radius, place, Quaternion((1, k, 2), k)))
	O.engines = polytope.engines()
	O.run(settling, wait=True)
	O.save(f'{folder}/start.yade', quiet=True)


def heap(start='start'):
	load(start)
	mpi.run(steps)
	return state()


def clumped():
	return heap('startClumps')


def parts(start='start'):
	"""Merged and divided again as it was."""
	load(start)
	mpi.run(steps // 2)
	mpi.run(steps // 2)
	return state()


def clumpedParts():
	return parts('startClumps')


rounding = 1e-13
"""× the largest value. A contact of bodies of two ranks is computed on both, on one of them perhaps from its beginning and on the other from the last step's
planes: points, areas and forces differ by rounding, and which of them the merged scene has depends on which rank was first."""


def divided(start='start'):
	"""Divided anew along another axis; before that the fields of all ranks, against those of the merged scene."""
	load(start)
	mpi.run(steps // 2, merged=False)
	fields, stats = mpi.arrays(), mpi.stats()
	mpi.divide(1)
	again = polytope.arrays()
	ranks = {body.id: (body.subdomain, body.isClumpMember) for body in O.bodies}
	mpi.run(steps // 2)
	if not master:
		return None
	pairs = [(ranks[int(one)], ranks[int(other)]) for one, other in again.contacts.ids]
	order = np.lexsort(again.contacts.ids.T[::-1])

	def alike(name):
		here, there = getattr(fields.contacts, name), getattr(again.contacts, name)[order]
		return bool(abs(here - there).max() < rounding * abs(here).max())

	same = {
		**{
			name: np.array_equal(getattr(fields.bodies, name), getattr(again.bodies, name))
			for name in ('ids', 'clumpIds', 'positions', 'velocities', 'masses')
		},
		'contacts': np.array_equal(fields.contacts.ids, again.contacts.ids[order]),
		**{name: alike(name) for name in ('points', 'areas', 'forces')},
	}
	# force on all bodies together, fixed ones included: the contacts' own cancel
	parts = fields.bodies.clumpIds != fields.bodies.ids
	return {
		**state(),
		'same': same,
		'net': [float(x) for x in fields.bodies.forces[parts].sum(axis=0)],
		'push': float(abs(fields.contacts.forces).max()),
		'ofTwoRanks': sum(0 < one[0] != other[0] > 0 and one[1] and other[1] for one, other in pairs),
		'stats': {name: stats[name] for name in ('pairs', 'failures')},
		'names': [fields.bodies.shapeNames[k] for k in fields.bodies.shapes],
	}


def clumpedDivided():
	return divided('startClumps')


def decomposed(start='start'):
	"""The scene is divided by yade.mpy's own decomposition."""
	mpi.mpy.DOMAIN_DECOMPOSITION = True
	load(start)
	mpi.run(steps)
	mpi.mpy.DOMAIN_DECOMPOSITION = False
	ranks = list(mpi.division._ranksOfBodies.values())
	return master and {**state(), 'counts': [ranks.count(k) for k in (1, 2)]}


def clumpedDecomposed():
	return decomposed('startClumps')


def recorded():
	"""With a snapshot of ParaView and a saved state every 25 steps; a pull that YADE does not send with the scene; a step by rank 0 alone."""
	load()
	if master:
		os.makedirs(f'{folder}/{mpi.size()}', exist_ok=True)
		O.forces.setPermF(O.bodies[len(O.bodies) - 1].id, Vector3(300, 0, 0))
		O.engines = O.engines + [
			yade.PolytopeVTKRecorder(iterPeriod=25, fileName=f'{folder}/{mpi.size()}/'),
			polytope.checkpoint(f'{folder}/{mpi.size()}/run', iterPeriod=25, onSignal=False),
		]
	mpi.run(60)
	if master:
		O.step()
	mpi.run(39)
	found = state()
	if master:
		found['engines'] -= 2
	return found


def settled(start='start'):
	load(start)
	return state()


def clumpedSettled():
	return settled('startClumps')


def sliding(pieces, number, waterTable=None, **joint):
	mpi.merge()
	O.reset()
	if master:
		O.materials.append(
			yade.RockJointMat(
				**{**dict(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.3), **(joint or dict(dilationAngle=0.05))}
			)
		)
		half = 6 / pieces
		O.bodies.append([polytope.cuboid((half * (2 * k + 1) - 4, 0, -0.5), (half, 1, 0.5), fixed=True) for k in range(pieces)])
		for k in range(8):
			O.bodies.append(polytope.cuboid((0.7 * k - 3, 0, 0.2), (0.2, 0.3, 0.2), Quaternion((0, 0, 1), 0.1 * k)))
			O.bodies[-1].state.vel = (2.0 + 0.05 * k, 0.1, 0)
		O.engines = polytope.engines(timeStepper=False)
		O.dt = 3e-4
		if waterTable is not None:
			polytope.water(level=waterTable)
	mpi.divide()
	mpi.run(number)
	return state()


def reallocated(scene, atRandom=False):
	"""A heap with bodies that change ranks in the run, and how many did so; at random: every five steps, two of five of those that both
	ranks know."""

	def once():
		mpy, counts, dice = mpi.mpy, [], random.Random(mpi.rank())
		byPlace, collide = mpy.REALLOCATE_FILTER, mpy.checkAndCollide

		def choose(own, other, surplus):
			chosen = [k for k in O.subD.intersections[other] if dice.random() < 0.4] if atRandom else byPlace(own, other, surplus)
			counts.append(len(chosen))
			return chosen

		def often():
			if O.iter % 5 == 0:
				mpy.typedEngine('NewtonIntegrator').maxVelocitySq = 2  # by which yade.mpy judges whether bodies have left their boxes
			return collide()

		mpy.REALLOCATE_FREQUENCY, mpy.REALLOCATE_FILTER = 1, choose
		if atRandom:
			mpy.checkAndCollide = often
		found = scene()
		mpy.REALLOCATE_FREQUENCY, mpy.REALLOCATE_FILTER, mpy.checkAndCollide = 0, byPlace, collide
		moved = mpi.mpy.comm.allreduce(sum(counts)) if mpi.size() > 1 else 0
		return dict(found, moved=moved) if master else None

	return once


def crossing():
	"""Stacks of two blocks, and blocks with a clump on them, that pass each other on a floor in two rows, from one half to the other."""
	mpi.merge()
	O.reset()
	if master:
		O.materials.append(yade.RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.1, dilationAngle=0.05))
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 1, 0.5), fixed=True))
		for k in range(6):
			way = 1 if k % 2 else -1
			place = Vector3(-way * (0.4 + 0.3 * k), 0.26 * way, 0.15)
			O.bodies.append(polytope.cuboid(place, (0.2, 0.2, 0.15)))
			if k < 4:
				O.bodies.append(polytope.cuboid(place + Vector3(0, 0, 0.25), (0.15, 0.15, 0.1)))
				above = O.bodies[-1]
			else:
				above = O.bodies[clumpOf(2, place + Vector3(0, 0, 0.25), Quaternion.Identity)]
			for body in (O.bodies[-1], O.bodies[-2], above):
				body.state.vel = (6 * way, 0, 0)
		O.engines = polytope.engines(timeStepper=False)
		O.dt = 2e-4
	mpi.divide()
	mpi.run(300, merged=False)
	mpi.run(300)
	mpi.run(300)
	return state()


def smooth():
	return sliding(1, 400)


def wet():
	return sliding(1, 300, waterTable=0.25)


def joints():
	return sliding(24, 80)


def rough():
	"""Barton-Bandis on joints that stiffen as they close."""
	return ownLaws(
		strength=yade.BartonBandisStrength(JRC=10, JCS=1e7, sampleLength=0.1, jointLength=0.4),
		closure=yade.HyperbolicClosure(maximumClosure=1e-3),
	)


def yielding():
	return ownLaws(
		strength=yade.ContinuouslyYieldingStrength(initialFrictionAngle=0.7, roughness=1e-2),
		closure=yade.PowerClosure(exponent=0.4, referenceStress=1e4),
	)


def ownLaws(**laws):
	"""What sliding() gives, on one piece, so that joints keep what they have from one rank to the other; and how far each has slipped in all."""
	found = sliding(1, 250, **laws)
	if master:
		found['slipped'] = {f'{i.id1} {i.id2}': float(i.phys.slipLength).hex() for i in O.interactions if i.isReal}
	return found


def bonded():
	"""Two beams of nine blocks that are bonded to each other, each held at one end by its first block; one bond in the middle of the second
	is weak."""
	mpi.merge()
	O.reset()
	if master:
		material()
		for row in (0, 2):
			O.bodies.append([polytope.cuboid((0.4 * k, row, 0), (0.2, 0.2, 0.2), fixed=k == 0) for k in range(9)])
		O.engines = polytope.engines(timeStepper=False)
		O.dt = 2e-5
		polytope.bond(normalStiffness=1e9, shearStiffness=4e8, tensileStrength=1e9, cohesion=1e9)
		weak = next(bond for bond in polytope.bonds().bonds if (bond.id1, bond.id2) == (13, 14))
		weak.tensileStrength = weak.cohesion = 120
	mpi.divide()
	mpi.run(150, merged=False)
	mpi.run(100)
	half = state()
	mpi.run(50)
	found = state()
	if master:
		found['halfWay'] = half['bodies']
		found['bonds'] = {
			f'{b.id1} {b.id2}': [
				b.intact,
				b.failure,
				b.failedAt,
				[float(x).hex() for x in (*b.force, *b.moment, *b.point, b.energy, b.edgeStress)],
			]
			for b in polytope.bonds().bonds
		}
	return found


def opened():
	"""Blocks that slip over each other, part by half their size and meet again: pairs of two ranks, and with a fixed block."""
	mpi.merge()
	O.reset()
	if master:
		O.materials.append(yade.RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.3, dilationAngle=0.05))
		O.bodies.append(polytope.cuboid((0, 0, 0), (0.2, 0.2, 0.2), fixed=True))
		for k in range(1, 5):
			O.bodies.append(polytope.cuboid((0.3999 * k, 0, 0), (0.2, 0.2, 0.2)))
		O.engines = polytope.engines(timeStepper=False, gravity=(0, 0, 0))
		O.dt = 1e-4
	found = []
	for velocity, number in (((0, 0.5, 0), 60), ((5, 0, 0), 390), ((-5, 0, 0), 405)):
		if master:
			for k in range(1, 5):
				O.bodies[k].state.vel, O.bodies[k].state.angVel = k * Vector3(velocity), (0, 0, 0)
		mpi.divide()
		mpi.run(number)
		found.append(state())
	return master and dict(found[2], apart=found[1])


def shaken():
	"""The heap, thrown up in eight ways, 250 steps later: [mean height, speed, contacts] of each."""
	found = []
	for seed in range(8):
		load()
		if master:
			dice = np.random.default_rng(seed)
			for body in O.bodies:
				if body.dynamic and not body.isSubdomain:
					body.state.vel, body.state.angVel = dice.uniform((-1, -1, 0), (1, 1, 3)), dice.uniform(-5, 5, 3)
		mpi.run(250)
		if master:
			free = [body.state for body in O.bodies if body.dynamic and not body.isSubdomain]
			found.append(
				[
					float(np.mean([state.pos[2] for state in free])),
					float(np.mean([state.vel.norm() for state in free])),
					O.interactions.countReal(),
				]
			)
	return found


def edited():
	"""Changed on rank 0 between two runs: a body is erased, one gets another velocity and a force, gravity another direction; then one is
	appended."""
	load()
	mpi.run(20)
	if master:
		free = [body for body in O.bodies if body.dynamic]
		O.bodies.erase(free[3].id)
		free[5].state.vel = (0.3, 0.2, 0.1)
		O.forces.setPermF(free[7].id, Vector3(0, 0, 200))
		next(engine for engine in O.engines if isinstance(engine, yade.NewtonIntegrator)).gravity = (1, 0, -9.81)
		with warnings.catch_warnings():
			warnings.simplefilter('error')
			polytope.check(O)
		polytope.check(O, costs=True)  # starts a process of its own
	mpi.run(20)
	if master:
		O.bodies.append(polytope.regular(6, radius, (0, 0, 1.6)))
	mpi.divide()
	mpi.run(20)
	mpi.run(1, merged=False)
	limit = mpi.leastOfRanks(polytope.stableTimeStep(default=1))
	mpi.merge()
	found = state()
	if master:
		found['bodies'] = dict(enumerate(found['bodies'].values()))  # the appended one's id depends on the number of ranks
		found['limit'] = limit
	return found


def searched():
	"""How often each rank has searched for pairs in twenty steps of cubes at rest side by side, with a fixed one and without."""
	found = {}
	for fixed in (True, False):
		mpi.merge()
		O.reset()
		if master:
			material()
			O.bodies.append([polytope.cuboid((0.9999 * k, 0, 0), (0.5, 0.5, 0.5)) for k in range(6)])
			if fixed:
				O.bodies.append(polytope.cuboid((2.5, 0, -0.999), (4, 0.5, 0.5), fixed=True))
			O.engines = polytope.engines(timeStepper=False, gravity=(0, 0, 0))
			O.dt = 1e-6
		mpi.divide()
		counts = []
		for number in (2, 20):
			mpi.run(number, merged=False)
			counts.append(next(engine for engine in O.engines if isinstance(engine, yade.PolytopeCollider)).numAction)
		found['with a fixed body' if fixed else 'all move'] = yade.mpy.comm.gather(counts)
	mpi.merge()
	return found


def refused():
	"""What the check says about each of these, on rank 0; nothing is run, so the other ranks need not take part."""
	load()
	if not master:
		return None
	from yade.polytope.mpi import division

	said = {}

	def saysNo(name):
		try:
			division.check()
		except RuntimeError as fault:
			said[name] = str(fault)
		else:
			said[name] = None

	saysNo('nothing')
	mpy = mpi.mpy
	for name, value in (
		('ERASE_REMOTE', False),
		('COPY_MIRROR_BODIES_WHEN_COLLIDE', False),
		('REALLOCATE_MINIMAL', True),
		('MERGE_W_INTERACTIONS', False),
		('USE_CPP_MPI', False),
	):
		former = getattr(mpy, name)
		setattr(mpy, name, value)
		saysNo(f'mpy.{name}')
		setattr(mpy, name, former)
	O.trackEnergy = True
	saysNo('O.trackEnergy')
	O.trackEnergy = False
	engines = O.engines
	O.engines = engines + [yade.ForceRecorder(ids=[0], file=os.devnull)]
	saysNo('ForceRecorder')
	O.engines = engines
	member = clumpOf(0, (0, 0, 3), Quaternion.Identity) - 1
	for body in O.bodies:
		body.subdomain = 1 if body.dynamic else 0
	O.bodies[member].subdomain = 2
	saysNo('Body.subdomain')
	O.load(f'{folder}/start.yade', quiet=True)
	ends = [body.state.pos for body in O.bodies if isinstance(body.shape, yade.Polytope)][:2]
	polytope.bolt(*ends, area=1e-4, youngsModulus=2e11)
	saysNo('bolts')
	O.load(f'{folder}/start.yade', quiet=True)
	O.periodic = True
	saysNo('O.periodic')
	return said


def killed(start='start'):
	"""Saves every 20 steps, twice, then runs on until it is killed."""
	with open(f'{folder}/process-{mpi.rank()}', 'w') as file:
		file.write(str(os.getpid()))
	load(start)
	if master:
		O.engines = O.engines + [polytope.checkpoint(f'{folder}/run', iterPeriod=20, onSignal=False)]
	mpi.run(40)
	if master:
		O.engines[-1].dead = True
		open(f'{folder}/running', 'w').close()
	mpi.run(10**6, merged=False)


def clumpedKilled():
	killed('startClumps')


def continued():
	"""What such a script does when it is called again."""
	mpi.merge()
	if master:
		assert polytope.continueFrom(f'{folder}/run') == f'{folder}/run.yade' and O.engines[-1].written == 2
		O.engines = O.engines[:-1]
	mpi.divide()
	mpi.run(steps - 40)
	return state()


reallocatedCrossing = reallocated(crossing)
reallocatedHeap, reallocatedSmooth, reallocatedBonded, reallocatedStacks = (
	reallocated(scene, atRandom=True) for scene in (heap, smooth, bonded, crossing)
)

for name in sys.argv[2:]:
	begin = time.perf_counter()
	found = globals()[name]()
	if master:
		with open(f'{folder}/{name}-{mpi.size()}.json', 'w') as file:
			json.dump(found, file)
		print(name, f'{time.perf_counter() - begin:.2f} s', flush=True)
