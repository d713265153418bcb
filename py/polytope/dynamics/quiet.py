# SPDX-License-Identifier: GPL-2.0-or-later
"""Boundaries that let waves out: `polytope.quietBoundary(…)`."""

import numpy as np
from yade import BaseMotion, O, Polytope, QuietBoundary, Vector3

from ..arguments import namedArguments, number, vector
from ..precision import real
from ..rock.faces import areaVector, centroidOf
from ..rock.stress.forces import forcesOfContacts
from ..scene.permanentLoads import permanentLoads
from ..scene.present import gravityOf, insertEngine, placeOfForces
from ..scene.vertices import localVertices
from ._bodies import bodiesOf, historyOf, refuseWithoutIntegrator

__all__ = ['quietBoundary']

outward = np.cos(0.01)
"""Cosine of the largest angle between the normal of the boundary and that of a face which belongs to it: what settling turns bodies by."""
unheld = 0.01
"""Force that a free body may lack to be at rest, over its weight."""


@namedArguments
def quietBoundary(ids, normal, pWave, sWave, history=None):
	"""Lets waves out of the model through the outer faces of bodies, by dashpots (Lysmer & Kuhlemeyer 1969, J. Eng. Mech. Div. ASCE
	95:859-877), from now on::

		polytope.quietBoundary(base, (0, 0, -1), pWave=sqrt(kn * spacing / density), sWave=sqrt(ks * spacing / density))

	The stress on the faces is ρ c_p times the normal part of their velocity and ρ c_s times the tangential part, against it. In blocks with
	joints of stiffness k per area that lie across the wave's way at a spacing h, waves much longer than h run at c = √(k h/ρ).

	Bodies that were fixed can move along x, y and z after this and cannot turn; what the rest pressed them with at this moment, and their
	weight, is held by a constant force. Blocks at the boundary that are half as thick as the others reflect least.

	:param ids: number of a body, or several; polytopes with a face of this outward normal
	:param normal: outward normal of the boundary, of any length
	:param float pWave, sWave: speeds c_p, c_s of waves with motion along the normal and across it [m/s]
	:param history: what *velocityHistory* returns: velocity of a wave that comes in through the boundary, half of what it gives a free
	    surface of the same rock; None: none does
	:returns: the engine *QuietBoundary*, which stands before NewtonIntegrator in O.engines and is saved with the scene
	:raises ValueError: naming the argument: bodies that are not there, without such a face or with a neighbour on it, free bodies that are
	    not at rest, bodies in another quiet boundary of this normal, or moved by *baseMotion*; a history that has begun already; no
	    NewtonIntegrator
	"""
	ids, history = bodiesOf(ids), None if history is None else historyOf(history)
	normal = np.array([float(x) for x in vector(normal, 'normal')])
	if not np.linalg.norm(normal) > 0:
		raise ValueError('normal: must not be zero')
	normal /= np.linalg.norm(normal)
	speeds = [number(pWave, 'pWave'), number(sWave, 'sWave')]
	for name, speed in zip(('pWave', 'sWave'), speeds, strict=True):
		if not 0 <= speed < np.inf:
			raise ValueError(f'{name}: must be a finite speed, at least 0 [m/s], got {speed:g}')
	for one in O.engines:
		if isinstance(one, QuietBoundary) and set(one.ids) & set(ids) and np.dot(list(map(float, one.normal)), normal) > outward:
			raise ValueError('ids: O.engines has a QuietBoundary of this normal for some of them; remove it first')
	driven = sorted({k for one in O.engines if isinstance(one, BaseMotion) for k in one.ids} & set(ids))
	if driven:
		raise ValueError(
			f'ids: body {driven[0]} is moved by a BaseMotion, and a quiet boundary must be free to move; give the record to the boundary (history=), or remove the BaseMotion first'
		)
	refuseWithoutIntegrator()
	gravity, place = gravityOf(), placeOfForces('the dashpots act')
	areas, faces = zip(*(_outerFace(k, normal) for k in ids), strict=True)
	_refuseLoadedFaces(ids, normal)
	loads = forcesOfContacts(lambda k: k in ids)
	borne = {k: loads[k][0] if k in loads else Vector3.Zero for k in ids}
	_refuseUnheld(ids, gravity, borne)
	supports = [_support(O.bodies[k], gravity, borne[k]) for k in ids]
	impedances = [
		[real(area * float(speed) * float(O.bodies[k].material.density)) for k, area in zip(ids, areas, strict=True)] for speed in speeds
	]
	engine = QuietBoundary(
		ids=ids,
		normal=Vector3(*map(real, normal)),
		normalDashpots=impedances[0],
		shearDashpots=impedances[1],
		faces=[Vector3(*map(real, face)) for face in faces],
		supports=supports,
		history=history,
	)
	for k in ids:
		state = O.bodies[k].state
		if not set('xyz') - set(state.blockedDOFs):
			state.vel, state.blockedDOFs = Vector3.Zero, ''.join(sorted(set(state.blockedDOFs) - set('xyz')))
	insertEngine(place, engine)
	return engine


def _outerFace(number, normal):
	"""(area [m²], centroid in the body's axes [m]) of the faces that look out."""
	body = O.bodies[number]
	if not isinstance(body.shape, Polytope):
		raise ValueError(f'ids: body {number} is no polytope ({type(body.shape).__name__}); boundaries are made of polytopes')
	if body.isClumpMember:
		raise ValueError(
			f"ids: body {number} is a member of clump {body.clumpId}, which moves as one; make blocks at the boundary that are none (jointedRock: incomplete='cut')"
		)
	turned = np.array(body.state.ori.conjugate() * Vector3(*map(real, normal)), float)
	vertices = localVertices(body.shape)
	faces = [(areaVector(corners), corners) for corners in (vertices[face] for face in body.shape.faces)]  # of a polygon those of its prism
	outer = [(np.linalg.norm(area), centroidOf(corners)) for area, corners in faces if area @ turned > outward * np.linalg.norm(area)]
	if not outer:
		raise ValueError(
			f'ids: body {number} has no face of the normal {tuple(np.round(normal, 3).tolist())}; name the bodies at the boundary alone'
		)
	areas, centroids = zip(*outer, strict=True)
	return float(sum(areas)), np.average(centroids, axis=0, weights=areas)


def _refuseLoadedFaces(ids, normal):
	"""A face that a neighbour presses on is no end of the model."""
	for one in O.interactions:
		if not one.isReal or not float(one.phys.normalForce.norm()) > 0:
			continue
		along = float(np.array(one.geom.normal, float) @ normal)  # from body 1 to body 2
		for k, other, towards in ((one.id1, one.id2, along), (one.id2, one.id1, -along)):
			if k in ids and towards > outward:
				raise ValueError(
					f'ids: body {other} presses on the face of body {k} that looks along the normal; a quiet boundary is where the model ends: name the last '
					'bodies alone, or the normal that points out of the rock'
				)


def _refuseUnheld(ids, gravity, borne):
	"""Dashpots hold no weight: a free body would sink with a steady speed."""
	for k in ids:
		state = O.bodies[k].state
		free = [axis not in state.blockedDOFs for axis in 'xyz']
		weight = state.mass * gravity
		force = np.array(borne[k] + permanentLoads().get(k, (Vector3.Zero,))[0] + weight, float) * free
		if np.linalg.norm(force) > unheld * float(weight.norm()) > 0:
			raise ValueError(
				f'ids: body {k} can move and is not at rest ({np.linalg.norm(force):.3g} N): dashpots hold no load. Fix it (fixed=True), so that what it bears '
				'is held from now on, or polytope.settle() first'
			)


def _support(body, gravity, borne):
	"""Force that holds a fixed body where it is; none for one that is free."""
	if set('xyz') - set(body.state.blockedDOFs):
		return Vector3.Zero
	return -(borne + permanentLoads().get(body.id, (Vector3.Zero,))[0] + body.state.mass * gravity)
