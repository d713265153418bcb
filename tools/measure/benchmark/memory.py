# SPDX-License-Identifier: GPL-2.0-or-later
"""Bytes of a body of a known shape, of a pair whose boxes overlap but whose bodies do not touch, and of a contact; YADE's spheres beside them.

As a program (bench.py runs it in a process of its own) it prints them as JSON. Each is the difference between two scenes of as many bodies in
the same order, one with pairs and one without, so what engines and lists of bodies need is not in it.
"""

import ctypes
import gc
import math

import oneProcess


class MallocInfo(ctypes.Structure):
	"""struct mallinfo2 of the C library."""

	_fields_ = [
		(name, ctypes.c_size_t)
		for name in ('arena', 'ordblks', 'smblks', 'hblks', 'hblkhd', 'usmblks', 'fsmblks', 'uordblks', 'fordblks', 'keepcost')
	]


def memoryInUse():
	"""What C++ has allocated and not freed [bytes]: neither Python's small objects nor what allocators keep for later."""
	gc.collect()
	library = ctypes.CDLL(None)
	library.mallinfo2.restype = MallocInfo
	info = library.mallinfo2()
	return info.uordblks + info.hblkhd


def cubes(places, turn):
	"""A new scene of cubes of edge 1 that cannot turn, so that their boxes are tight; bytes that one takes."""
	from yade import O, RockJointMat, polytope

	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
	polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5))
	before = memoryInUse()
	for place in places:
		O.bodies.append(polytope.cuboid(place, (0.5, 0.5, 0.5), turn))
		O.bodies[-1].state.blockedDOFs = 'XYZ'
	each = (memoryInUse() - before) / len(places)
	O.engines = polytope.engines(timeStepper=False)
	O.engines[1].verletDist = 0
	O.dt = 1e-6
	return each


def spheres(places):
	"""Does the same as cubes() for YADE's spheres of diameter 1."""
	from yade import (
		Bo1_Sphere_Aabb,
		ForceResetter,
		FrictMat,
		Ig2_Sphere_Sphere_ScGeom,
		InsertionSortCollider,
		InteractionLoop,
		Ip2_FrictMat_FrictMat_FrictPhys,
		Law2_ScGeom_FrictPhys_CundallStrack,
		NewtonIntegrator,
		O,
		utils,
	)

	O.reset()
	O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.5))
	before = memoryInUse()
	for place in places:
		O.bodies.append(utils.sphere(place, 0.5))
	each = (memoryInUse() - before) / len(places)
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
		NewtonIntegrator(),
	]
	O.dt = 1e-6
	return each


def bytesOfFirstStep():
	from yade import O

	before = memoryInUse()
	O.step()
	return memoryInUse() - before


def perPair(near, far, build, touching):
	"""Bytes that each pair takes of the bodies that *build* puts at the places *near*; at the places *far* they have none."""
	from yade import O

	build(near)
	O.step()  # what all pairs share is there from now on
	build(far)
	without = bytesOfFirstStep()
	assert len(O.interactions) == 0
	build(near)
	bytesOfAll = bytesOfFirstStep()
	assert len(O.interactions) > 0 and O.interactions.countReal() == (len(O.interactions) if touching else 0)
	return (bytesOfAll - without) / len(O.interactions)


def measure(quick):
	from yade import Quaternion

	side, number = (60, 3000) if quick else (200, 30000)

	def straight(places):
		return cubes(places, Quaternion((0, 0, 1), 0))

	def turned(places):
		return cubes(places, Quaternion((0, 0, 1), math.pi / 4))

	# turned by 45° on the squares of one colour of a board: boxes overlap and faces are 0.06 m apart
	board = [(x, y, 0) for x in range(side) for y in range(x % 2, side, 2)]
	near, far = ([(spacing * x, spacing * y, 0) for x, y, _ in board] for spacing in (0.75, 2))
	# one above the other in twos
	touching, apart = ([(2 * k, 0, z) for k in range(number) for z in (0, distance)] for distance in (0.999, 2))
	return {
		'body': turned(far),
		'pair apart': perPair(near, far, turned, touching=False),
		'contact': perPair(touching, apart, straight, touching=True),
		'spheres': {'body': spheres(far), 'contact': perPair(touching, apart, spheres, touching=True)},
	}


def run(core, quick):
	"""measure() in a process of its own on one core."""
	return oneProcess.run(__file__, core, quick)


if __name__ == '__main__':
	oneProcess.report(measure)
