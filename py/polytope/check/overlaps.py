# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of bodies that begin in each other, of polytope.check(): polytopes, also across the boundary of a periodic cell, and polytopes in
YADE's own shapes."""

import collections
import itertools
import math

import numpy as np
import scipy  # loads its packages at their first use: half a second
from yade import Body, Box, Facet, Polytope, Sphere, Wall, _polytope

from ..bodies.halfSpaces import halfSpacesOf
from ..bodies.inSphere import depthInSphere
from ..measures.arrays import arrays
from ..scene.movers import sameClump
from .overlapEnergy import Thrown
from .standIns import standIn

__all__ = ['coincidence', 'mayMeet', 'overlaps', 'sharedFaces', 'sortedOffsets']

larger = 2.0
"""Circumscribed radius over another body's above which the other is looked for by the half-spaces of the larger one: their middles say little."""

looks = 3000
"""Pairs that are looked at, the nearest ones first: a second of queries is enough to find what was placed wrongly."""

onePlace = 1e-9
"""Distance over the circumscribed radius, or over a period, up to which two bodies are in one place, and two shapes are one: made elsewhere
they differ by rounding."""

oneFace = 1e-4
"""Angle [rad], and distance over the inscribed radius, up to which faces of two members of a clump lie in one plane; and overlap over that radius
from which on they share a part of it."""

Rows = collections.namedtuple('Rows', 'bodies places shifts')
"""Polytopes with where they are looked at [m], and by how much that differs from their state's position: in a periodic cell, images as well."""


def coincidence(scene):
	"""Polytopes of one shape in one place: the overlap is the whole body, and nothing says which way they are to part."""
	there, pairs = {}, []
	for body in scene.bodies:
		if isinstance(body.shape, Polytope):
			where = (*_placeInCell(scene, body), f'{float(body.shape.volume):.9g}')
			for other in there.setdefault(where, []):
				if other.mask & body.mask and not sameClump(body, other) and _sameShape(other, body):
					pairs.append((other.id, body.id))
					break
			there[where].append(body)
	if pairs:
		more = f', and {len(pairs) - 1} pairs more' if len(pairs) > 1 else ''
		seen = f'body {pairs[0][0]} and body {pairs[0][1]} have the same shape in the same place{more}: nothing presses them apart until they have moved, and then in any direction'
		yield 'same place', seen, 'move one of them, or O.bodies.erase() it if the same bodies were appended twice'


def _placeInCell(scene, body):
	if not scene.O.periodic:
		return tuple(map(float, body.state.pos))
	return tuple(round(float(x) % 1, 9) % 1 for x in _periodsOf(scene, np.array(body.state.pos, float)))


def _periodsOf(scene, places):
	return np.linalg.solve(np.array(scene.O.cell.hSize, float).reshape(3, 3), places.T).T


def overlaps(scene):
	"""Bodies that lie deep in each other, or so that their contact throws one of them."""
	found = {}
	thrown = Thrown(scene)
	for speed, one, other in itertools.chain(_ofPolytopes(scene, thrown), _withOthers(scene, thrown)):
		pair = tuple(sorted((one.id, other.id)))
		found[pair] = max(speed, found.get(pair, 0))
	if found:
		pair = min(found, key=lambda pair: (-found[pair], pair))
		more = f', and {len(found) - 1} pairs more' if len(found) > 1 else ''
		how = 'lie deep in each other' if math.isinf(found[pair]) else 'lie in each other'
		speed = (
			'they are shot apart'
			if math.isinf(found[pair])
			else f'their contact throws one of them at up to {found[pair]:.2g} m/s, more than a fall over its own thickness gives'
		)
		advice = 'move them apart: bodies should begin apart, or overlap by some thousandths of their size (polytope.cloud places them without overlap)'
		if scene.O.interactions.has(*pair, True):
			advice = f'a higher normalStiffness, if they came to be there by their weight, load or speed; else {advice}'
		yield 'overlap', f'body {pair[0]} and body {pair[1]} {how}{more}: {speed}', advice


def sharedFaces(scene):
	"""Members of a clump that overlap with faces in one plane: what presses on the part of it that is of both presses on each."""
	members = [body for body in scene.bodies if isinstance(body.shape, Polytope) and body.isClumpMember]
	places = np.array([body.state.pos for body in members], float).reshape(-1, 3)
	pairs = ((members[i], members[j]) for i, j in _candidates(Rows(members, places, np.zeros_like(places))))
	found = [(one.id, other.id) for one, other in pairs if sameClump(one, other) and _shareFace(one, other)]
	if found:
		more = f', and {len(found) - 1} pairs more' if len(found) > 1 else ''
		one, other = sorted(found[0])
		seen = f'members {one} and {other} of a clump overlap, with faces in one plane{more}: where that is a face of both, a contact has twice the stiffness, and its energy changes where one of them ends'
		yield 'overlapping members', seen, 'polytope.clump(polytope.withoutOverlap(parts)): parts that fill the same and touch'


def _shareFace(one, other):
	size = min(float(body.shape.inscribedRadius) for body in (one, other))
	try:
		if not float(_polytope.contact(one, other, contactModel='boon2012', contactPoint='chebyshevCentre').depth) > oneFace * size:
			return False
	except ValueError:  # a polygon and a polyhedron
		return False
	(normals, offsets), (itsNormals, itsOffsets) = (halfSpacesOf(body, np.array(one.state.pos, float)) for body in (one, other))
	parallel = np.linalg.norm(normals[:, None] - itsNormals[None], axis=2) < oneFace
	return bool((parallel & (abs(offsets[:, None] - itsOffsets[None]) < oneFace * size)).any())


def _ofPolytopes(scene, thrown):
	rows = _rows(scene)
	for i, j in _candidates(rows):
		one, other = rows.bodies[i], rows.bodies[j]
		samePlace = np.linalg.norm(rows.places[i] - rows.places[j]) <= onePlace * float(one.shape.circumscribedRadius) and _sameShape(
			one, other
		)
		if mayMeet(scene, one, other) and not samePlace:  # that coincidence() finds
			speed = thrown.speed(one, other, _at(one, rows.shifts[i]), _at(other, rows.shifts[j]))
			if speed:
				yield speed, one, other


def _at(body, shift):
	"""The body, or one like it whose place differs by so much [m]."""
	if not shift.any():
		return body
	image = Body()
	image.shape, image.material = body.shape, body.material
	image.state.pos, image.state.ori = body.state.pos + type(body.state.pos)(*map(float, shift)), body.state.ori
	return image


def _rows(scene):
	bodies = [body for body in scene.bodies if isinstance(body.shape, Polytope)]
	table = arrays().bodies
	places = table.positions[np.searchsorted(table.ids, [body.id for body in bodies])].reshape(-1, 3)
	shifts = np.zeros_like(places)
	cell = np.array(scene.O.cell.hSize, float).reshape(3, 3) if scene.O.periodic else None
	if cell is None or not bodies or not abs(np.linalg.det(cell)) > 0:
		return Rows(bodies, places, shifts)
	periods = _periodsOf(scene, places)
	inside = periods - np.floor(periods)
	reach = 2 * max(float(body.shape.circumscribedRadius) for body in bodies) * np.linalg.norm(np.linalg.inv(cell), axis=1)
	images = [(0, 0, 0), *(image for image in itertools.product((-1, 0, 1), repeat=3) if any(image))]
	chosen, at = [], []
	for image in images:
		near = np.flatnonzero(((inside + image >= -reach) & (inside + image <= 1 + reach)).all(axis=1))
		chosen.append(near)
		at.append(inside[near] + image)
	chosen, at = np.concatenate(chosen), np.concatenate(at) @ cell.T
	return Rows([bodies[k] for k in chosen], at, at - places[chosen])


def _candidates(rows):
	"""Pairs whose balls overlap, the likeliest ones first."""
	if len(rows.bodies) < 2:
		return []
	radii, reaches = (
		np.array([float(getattr(body.shape, name)) for body in rows.bodies]) for name in ('inscribedRadius', 'circumscribedRadius')
	)
	rank = np.empty(len(radii), int)
	rank[np.argsort(-reaches, kind='stable')] = np.arange(len(radii))  # the larger one of a pair looks for the other
	tree, found = scipy.spatial.cKDTree(rows.places), []
	own = np.array([body.id for body in rows.bodies])
	for i, near in enumerate(tree.query_ball_point(rows.places, 2 * reaches)):
		near = np.array(near, int)
		near = near[(rank[near] > rank[i]) & (own[near] != own[i])]
		if not len(near):
			continue
		apart = np.sqrt(((rows.places[near] - rows.places[i]) ** 2).sum(axis=1))
		small = larger * reaches[near] < reaches[i]
		like = ~small & (apart < reaches[i] + reaches[near])
		if like.any():
			found.append((apart[like] / (radii[i] + radii[near[like]]), np.full(like.sum(), i), near[like]))
		if small.any():
			slack, inside = _slacks(rows, i, near[small]), near[small]
			deep = slack > -reaches[inside]
			found.append((-slack[deep] / reaches[inside[deep]], np.full(deep.sum(), i), inside[deep]))
	if not found:
		return []
	score, one, other = (np.concatenate(part) for part in zip(*found, strict=True))
	first = np.lexsort((other, one, score))[:looks]
	return list(zip(one[first].tolist(), other[first].tolist(), strict=True))


def _slacks(rows, i, others):
	"""How deep the middles of others are in a body [m], below zero: out of it."""
	normals, offsets = halfSpacesOf(rows.bodies[i], rows.places[i])
	return (offsets - (rows.places[others] - rows.shifts[i]) @ normals.T).min(axis=1)


def _withOthers(scene, thrown):
	"""Polyhedra in facets, walls, boxes and spheres of YADE's; across a periodic boundary these are not looked for."""
	bodies = [body for body in scene.bodies if isinstance(body.shape, Polytope) and body.shape.dimension == 3]
	others = [body for body in scene.bodies if isinstance(body.shape, (Facet, Wall, Box, Sphere))]
	if not bodies or not others:
		return
	places = np.array([body.state.pos for body in bodies], float)
	reaches = np.array([float(body.shape.circumscribedRadius) for body in bodies])
	near = ((other, _gaps(other, places) - reaches) for other in others)
	pairs = [(gaps[j], j, other) for other, gaps in near for j in np.flatnonzero(gaps < 0)]
	for _, j, other in sorted(pairs, key=lambda pair: pair[:2])[:looks]:
		body = bodies[j]
		if not mayMeet(scene, body, other):
			continue
		if isinstance(other.shape, Sphere):
			speed = thrown.speedOfDepth(body, other, depthInSphere(body, other))
		else:
			solid = standIn(other, body)
			speed = solid and thrown.speed(body, other, body, solid)
		if speed:
			yield speed, body, other


def _gaps(other, places):
	"""Distances from points to a ball that holds the body [m]; for a wall, to its plane."""
	shape, place = other.shape, np.array(other.state.pos, float)
	if isinstance(shape, Sphere) and not math.isfinite(shape.radius):  # of classes derived from it that were given none
		return np.full(len(places), math.inf)
	if isinstance(shape, Wall):
		return abs(places[:, shape.axis] - place[shape.axis])
	radius = (
		float(shape.radius)
		if isinstance(shape, Sphere)
		else float(shape.extents.norm())
		if isinstance(shape, Box)
		else max(float(corner.norm()) for corner in shape.vertices)
	)
	return np.linalg.norm(places - place, axis=1) - radius


def mayMeet(scene, one, other):
	return one.mask & other.mask and not sameClump(one, other) and (scene.moves(one) or scene.moves(other))


def _sameShape(one, other):
	planes, others = sortedOffsets(one), sortedOffsets(other)
	return len(planes) == len(others) and np.allclose(planes, others, rtol=0, atol=onePlace * float(one.shape.circumscribedRadius))


def sortedOffsets(body):
	return sorted(float(offset) for offset in body.shape.offsets)
