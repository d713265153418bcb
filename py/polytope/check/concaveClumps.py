# SPDX-License-Identifier: GPL-2.0-or-later
"""Clumps of flush parts that are not convex, of polytope.check(): with a stiffness for each contact their collisions keep no energy. It yields
(what, seen, advice)."""

import itertools

import numpy as np
import scipy  # loads its packages at their first use: half a second
from yade import O, Polytope, RockJointMat

from ..scene.present import isPerArea, jointMakers
from ..scene.vertices import worldVertices
from .neighbours import contactOf

__all__ = ['concaveClumps']

missing = 1e-3
"""Share of its convex hull that a solid does not fill from which on it is not convex; the hulls of grains that were cut differ by rounding."""

looks = 300
"""Clumps of different mass and inertia to look at."""


def concaveClumps(scene):
	"""Where nothing dampens: numerical damping takes more than a collision may give."""
	if not scene.integrators or any(float(one.damping) > 0 for one in scene.integrators):
		return
	makers = jointMakers(scene.loops)
	for number, members in itertools.islice(_kinds(scene).items(), looks):
		joint = members[0].material
		if makers and isinstance(joint, RockJointMat) and isPerArea(joint, makers):
			continue
		if any(_isConcave(part) for part in _solids(members)):
			seen = f'clump {number} is not convex, and its contacts have a stiffness each: what falls flat onto it, or it onto something, may leave with a good part of its energy more or less'
			yield 'concave clump', seen, 'RockJointMat, and stiffnesses per area (docs/contact-force.md); numerical damping hides it'
			return


def _kinds(scene):
	"""Number of a clump and its polytopes, of clumps of one mass and inertia the first."""
	clumps = {}
	for body in scene.bodies:
		if body.isClumpMember and isinstance(body.shape, Polytope):
			clumps.setdefault(body.clumpId, []).append(body)
	kinds = {}
	for number, members in clumps.items():
		state = O.bodies[number].state
		kinds.setdefault(tuple(f'{float(x):.6g}' for x in (len(members), state.mass, *state.inertia)), (number, members))
	return dict(kinds.values())


def _solids(members):
	"""Those that touch each other, in lists."""
	count = len(members)
	meet = np.zeros((count, count), bool)
	for i, j in itertools.combinations(range(count), 2):
		radius = min(float(members[k].shape.circumscribedRadius) for k in (i, j))
		meet[i, j] = contactOf(members[i], members[j], radius) is not None
	_, label = scipy.sparse.csgraph.connected_components(meet, directed=False)
	return [[members[k] for k in np.flatnonzero(label == one)] for one in np.unique(label)]


def _isConcave(members):
	if len(members) == 1:
		return False
	dimension = members[0].shape.dimension
	corners = np.concatenate([worldVertices(body)[:, :dimension] for body in members])
	thickness = 1.0 if dimension == 3 else float(members[0].shape.thickness)
	hull = float(scipy.spatial.ConvexHull(corners).volume) * thickness
	return hull - sum(float(body.shape.volume) for body in members) > missing * hull
