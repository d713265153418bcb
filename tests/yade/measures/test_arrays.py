# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.arrays() against the scene's own attributes, one by one."""

import builtins
import time

import numpy as np
import pytest
from scenes import rowInAPeriodicCell
from yade import (
	FrictMat,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Law2_ScGeom_FrictPhys_CundallStrack,
	NewtonIntegrator,
	O,
	PolytopeGeom,
	PyRunner,
	Quaternion,
	RockJointMat,
	ScGeom,
	polytope,
	utils,
)


def mixed():
	"""Polytopes, spheres that touch them and each other, a clump, a wall, an erased body, masks, a permanent force."""
	O.materials.append(FrictMat(density=2600, young=1e7, poisson=0.3, frictionAngle=0.5))
	O.bodies.append([polytope.cuboid((0, 0, -0.5), (4, 4, 0.5), fixed=True, mask=5), utils.wall(-3, axis=0)])
	erased = O.bodies.append(polytope.regular(8, 0.3, (3, 3, 1)))
	O.bodies.append(
		[polytope.cuboid((0, 0, 0.299), (0.5, 0.4, 0.3), Quaternion((0, 0, 1), 0.3)), polytope.cuboid((0, 0, 0.897), (0.4, 0.4, 0.3))]
	)
	O.bodies.append([utils.sphere((2, 0, 0.199), 0.2), utils.sphere((2, 0, 0.597), 0.2)])
	O.bodies.appendClumped([polytope.cuboid((-1.5 + 0.4 * k, 0, 0.199), (0.2, 0.2, 0.2)) for k in range(2)])
	O.engines = polytope.engines(
		physics=[Ip2_FrictMat_FrictMat_FrictPhys()],
		law=[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
		integrator=NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.3),
		timeStepper=False,
	)
	O.engines[2].geomDispatcher.functors[0].computeArea = True
	O.dt = 1e-5
	O.bodies.erase(erased)
	O.forces.setPermF(3, (1, 2, 3))
	for _ in range(20):
		O.step()
	return erased


def testEveryBodyIsARow():
	erased = mixed()
	bodies = polytope.arrays().bodies
	there = [body for body in O.bodies if body is not None]
	assert list(bodies.ids) == [body.id for body in there] and erased not in bodies.ids
	assert [bodies.shapeNames[code] for code in bodies.shapes] == [type(body.shape).__name__ for body in there]
	assert set(bodies.shapeNames) == {'Polytope', 'Wall', 'Sphere', 'Clump'}
	assert list(bodies.clumpIds) == [body.clumpId for body in there] and len(set(bodies.clumpIds)) == 2
	assert list(bodies.masks) == [body.mask for body in there] and bodies.masks[0] == 5
	for k, body in enumerate(there):
		state = body.state
		assert bodies.masses[k] == state.mass
		assert list(bodies.positions[k]) == list(state.pos) and list(bodies.orientations[k]) == [state.ori[i] for i in range(4)]
		assert list(bodies.velocities[k]) == list(state.vel) and list(bodies.angularVelocities[k]) == list(state.angVel)
		assert list(bodies.forces[k]) == list(O.forces.f(body.id, sync=True))
		assert list(bodies.torques[k]) == list(O.forces.t(body.id, sync=True))
	moving = bodies.velocities[:, 2] != 0
	assert moving.sum() >= 6 and np.abs(bodies.forces).max() > 100


def testAClumpsRowHasTheSumOfItsMembers():
	mixed()
	bodies = polytope.arrays().bodies
	clump = bodies.shapes == bodies.shapeNames.index('Clump')
	members = (bodies.clumpIds >= 0) & ~clump
	assert clump.sum() == 1 and members.sum() == 2
	assert bodies.forces[members][:, 2].sum() > 1
	assert bodies.forces[clump][0] == pytest.approx(bodies.forces[members].sum(axis=0), rel=1e-12)


def testEveryRealContactIsARow():
	mixed()
	contacts = polytope.arrays().contacts
	real = {(one.id1, one.id2): one for one in O.interactions if one.isReal}
	assert len(contacts.ids) == len(real) and {tuple(ids) for ids in contacts.ids.tolist()} == set(real)
	kinds = set()
	for k, ids in enumerate(contacts.ids.tolist()):
		geom, phys = real[tuple(ids)].geom, real[tuple(ids)].phys
		kinds.add(type(geom))
		assert list(contacts.points[k]) == list(geom.contactPoint) and list(contacts.normals[k]) == list(geom.normal)
		assert contacts.depths[k] == geom.penetrationDepth
		assert list(contacts.normalForces[k]) == list(phys.normalForce) and list(contacts.shearForces[k]) == list(phys.shearForce)
		assert list(contacts.forces[k]) == list(phys.normalForce + phys.shearForce)
		if type(geom) is PolytopeGeom:
			assert contacts.areas[k] == geom.contactArea and contacts.infeasibilities[k] == geom.infeasibility
			assert contacts.statusNames[contacts.statuses[k]] == geom.status
		else:
			assert np.isnan(contacts.areas[k]) and np.isnan(contacts.infeasibilities[k]) and contacts.statuses[k] == -1
	assert kinds == {PolytopeGeom, ScGeom} and contacts.areas[contacts.statuses >= 0].max() > 0.5
	assert not contacts.images.any()


def testForcesOfContactsAreThoseOfBodies():
	mixed()
	bodies, contacts = polytope.arrays()
	total = np.zeros((len(O.bodies), 3))
	np.add.at(total, contacts.ids[:, 0], -contacts.forces)
	np.add.at(total, contacts.ids[:, 1], contacts.forces)
	total[3] += (1, 2, 3)
	alone = bodies.shapes != bodies.shapeNames.index('Clump')
	assert np.abs(total[bodies.ids[alone]] - bodies.forces[alone]).max() < 1e-9 * np.abs(total).max()


def testImagesInAPeriodicCell():
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.8))
	rowInAPeriodicCell()
	contacts = polytope.arrays().contacts
	assert len(contacts.ids) == 3 and np.abs(contacts.images).sum() == 1
	for ids, image, normal in zip(contacts.ids.tolist(), contacts.images, contacts.normals, strict=True):
		assert list(image) == list(O.interactions[ids[0], ids[1]].cellDist)
		way = O.bodies[ids[1]].state.pos + O.cell.hSize * O.interactions[ids[0], ids[1]].cellDist - O.bodies[ids[0]].state.pos
		assert normal[0] == pytest.approx(way[0], rel=1e-3)  # neighbours are 1 m apart


def testTypesShapesAndAnEmptyScene():
	empty = polytope.arrays()
	assert empty.bodies.positions.shape == (0, 3) and empty.contacts.ids.shape == (0, 2) and empty.bodies.shapeNames == ()
	mixed()
	bodies, contacts = polytope.arrays()
	n, m = len(bodies.ids), len(contacts.ids)
	assert bodies.orientations.shape == (n, 4) and contacts.images.shape == (m, 3) and contacts.depths.shape == (m,)
	for table in (bodies, contacts):
		for name, column in table._asdict().items():
			if not name.endswith('Names'):
				assert column.dtype == (np.int32 if name in 'ids shapes clumpIds masks images statuses'.split() else np.float64), name
	before = tuple(O.bodies[3].state.pos)
	bodies.positions[:] = 7  # a copy, and writable
	assert tuple(O.bodies[3].state.pos) == before


def testLargeColumnsHaveAllRows():
	"""Each column begins with a large page of memory of its own; arrays that are kept stay as they are when the scene goes on."""
	O.materials.append(RockJointMat(density=2600))
	O.bodies.append([polytope.cuboid((2 * k, 0.5 * k, -k), (0.5, 0.5, 0.5), velocity=(0, k, 1)) for k in range(25000)])
	first = polytope.arrays().bodies
	assert first.positions.nbytes > 2**19 and first.positions.flags.c_contiguous
	k = np.arange(25000)
	assert (first.ids == k).all() and (first.positions == np.stack([2 * k, 0.5 * k, -k], axis=1)).all()
	assert (first.velocities == np.stack([0 * k, k, 0 * k + 1], axis=1)).all() and (first.orientations == (0, 0, 0, 1)).all()
	for body in (0, 24999):
		O.bodies[body].state.pos = (7, 7, 7)
	assert (polytope.arrays().bodies.positions[[0, -1]] == 7).all()
	first.positions[0] += 1
	assert first.positions[0].tolist() == [1, 1, 1] and first.positions[-1].tolist() == [49998, 12499.5, -24999]


def testNoLoopInPython():
	"""The number of Python's calls does not grow with the scene."""
	import sys

	def calls():
		count = 0

		def counted(frame, event, argument):
			nonlocal count
			count += event in ('call', 'c_call')

		sys.setprofile(counted)
		polytope.arrays()
		sys.setprofile(None)
		return count

	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.8))
	O.bodies.append(polytope.regular(6, 1, (0, 0, 0)))
	few = calls()
	O.bodies.append([polytope.regular(6, 1, (3 * k, 0, 0)) for k in range(1, 200)])
	assert calls() == few > 0


def testAfterLoading(tmp_path):
	"""What YADE does not save is as the help text says: forces are zero, depths not a number."""
	mixed()
	O.save(f'{tmp_path}/scene.yade')
	before = polytope.arrays()
	O.load(f'{tmp_path}/scene.yade')
	bodies, contacts = polytope.arrays()
	assert (bodies.positions == before.bodies.positions).all() and not bodies.forces[bodies.ids != 3].any()
	assert len(contacts.ids) == len(before.contacts.ids) and np.isnan(contacts.depths).all() and np.isfinite(contacts.points).all()


def testARunInTheBackgroundIsRefused():
	"""The contacts would come and go while they are read; from an engine of the run it works."""
	mixed()
	found = []
	builtins.found = found
	command = 'import time; from yade import polytope; found.append(len(polytope.arrays().bodies.ids)); time.sleep(0.05)'
	O.engines = O.engines + [PyRunner(iterPeriod=10, command=command)]
	O.run(100)
	while not found:
		time.sleep(0.001)
	with pytest.raises(RuntimeError, match='O.pause'):
		polytope.arrays()
	O.wait()
	assert len(found) == 10 and set(found) == {len(polytope.arrays().bodies.ids)}
