# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of where bodies are and how they meet there, of polytope.check(). Each yields (what, seen, advice)."""

import itertools
import math

import numpy as np
from yade import Box, Facet, Polytope, RockJointMat, Wall

from ..bodies.halfSpaces import halfSpacesOf
from ..bonding.bonds import intactBonds
from ..rock.faceMaterials import materialsOf
from ..scene.movers import isMover
from ..scene.notNumbers import notNumbers
from ..scene.present import isPerArea, jointMakers
from ..scene.radii import inscribedRadius
from ..scene.vertices import rotationMatrix, worldVertices
from .neighbours import looks, touching, touchingPairs
from .overlaps import coincidence, overlaps, sharedFaces

__all__ = ['lostBodies', 'overlapShare', 'placeFindings']

softest = 0.1
"""Overlap over the inscribed radius, under a body's own weight or in its impact on one face, above which the contact gives way: overlaps of
some thousandths are usual, and forces are computed for small ones."""

half = 0.5
"""Extent of a body's bounds over the cell's edge, in the cell's axes, above which YADE's collider gives up."""


def placeFindings(scene):
	for one in (coincidence, overlaps, sharedFaces, spanning, stiffness, suddenGravity):
		yield from one(scene)


def lostBodies(scene):
	"""Positions, orientations and velocities that are not finite."""
	lost = notNumbers()
	if lost:
		key, wrong = next(iter(lost.items()))
		more = f', and {len(lost) - 1} bodies more' if len(lost) > 1 else ''
		seen = (
			f'body {key}: {" and ".join(f"state.{name}" for name in wrong)} is not a finite number{more}: no contact of it can be computed'
		)
		yield 'not a number', seen, 'give it finite values; in a run, go back to a saved state and take PolytopeTimeStepper()'


def suddenGravity(scene):
	"""Joints with a strength that they can lose, between bodies in touch, and gravity that begins with the first step."""
	if scene.O.iter > 0 or not scene.gravity() > 0:
		return
	strong = [body for body in scene.bodies if isinstance(body.shape, Polytope) and _canLoseStrength(body)]
	bonded = any(math.isfinite(bond.tensileStrength) for bond in intactBonds())
	supports = [body for body in scene.bodies if isinstance(body.shape, (Box, Facet, Wall)) and _canLoseStrength(body)]
	if not bonded and not any(True for _ in touchingPairs(scene, strong)) and not _anyRests(scene, strong, supports):
		return
	what = 'bonds' if bonded else 'joints with cohesion or tensile strength'
	seen = f'{what} and gravity that begins at once: the first swing loads them up to twice, and what fails then is lost although it would hold at rest'
	yield 'gravity at once', seen, 'polytope.settle() before the run: at rest first, then the true strengths'


def _canLoseStrength(body):
	"""A joint on one of its faces."""
	return any(
		isinstance(material, RockJointMat)
		and (material.cohesion > material.residualCohesion or material.tensileStrength > material.residualTensileStrength)
		for material in materialsOf(body)
	)


def _anyRests(scene, bodies, supports):
	"""Whether a vertex of one of the bodies lies on a box, facet or wall."""
	pairs = ((body, support) for body in bodies if scene.moves(body) for support in supports if body.mask & support.mask)
	for body, support in itertools.islice(pairs, looks):
		if _distances(support, worldVertices(body)).min(initial=math.inf) < touching * float(body.shape.circumscribedRadius):
			return True
	return False


def _distances(support, points):
	"""Least distances of points from a box, facet or wall as a body in their middle meets it [m]; below zero: in it."""
	normals, offsets = halfSpacesOf(support, points.mean(axis=0))
	return (points @ normals.T - offsets).max(axis=1)


def spanning(scene):
	"""Bodies of more than half of a periodic cell: YADE's collider ends the run when it meets one, since an image could be on either side."""
	colliders = [collider for collider in scene.colliders if not collider.allowBiggerThanPeriod]
	if not scene.O.periodic or not colliders:
		return
	cell = np.array(scene.O.cell.hSize, float).reshape(3, 3)
	if not abs(np.linalg.det(cell)) > 0:
		yield 'periodic cell', 'O.cell has no volume', 'O.cell.setBox(x, y, z) with the edges of the cell'
		return
	walls = [body.id for body in scene.bodies if isinstance(body.shape, Wall)]
	if walls:
		seen = f'{len(walls)} walls (body {walls[0]} first) are without end, beyond every periodic cell: YADE ends the run'
		yield 'periodic cell', seen, 'allowBiggerThanPeriod=True in the collider, or plates of half a cell at the most'
	margin = 2 * max(0.0, *(float(collider.verletDist) for collider in colliders)) / np.abs(np.linalg.norm(cell, axis=0))
	narrowest = 1 / np.linalg.norm(np.linalg.inv(cell), axis=1).max()  # distance of two opposite sides
	large = {}
	for body in scene.bodies:
		if isinstance(body.shape, Polytope) and _width(body.shape) / narrowest + margin.max() > half:
			turn = rotationMatrix(body.state.ori)
			corners = np.linalg.solve(cell, turn @ np.array(body.shape.vertices, float).reshape(-1, 3).T)  # in periods
			share = float((np.ptp(corners, axis=1) + margin).max())
			if share > half:
				large[body.id] = share
	if large:
		key = max(large, key=large.get)
		seen = f"{len(large)} bodies (body {key} most) span {large[key]:.2g} of the periodic cell with the collider's verletDist: YADE ends the run"
		yield (
			'periodic cell',
			seen,
			'a larger cell, smaller bodies, or walls in place of the periodic cell; for plates through all of it allowBiggerThanPeriod=True in the collider',
		)


def _width(shape):
	"""Diameter of a ball that holds it [m]: what is small enough with it needs no closer look."""
	return math.hypot(2 * float(shape.circumscribedRadius), float(shape.thickness) if shape.dimension == 2 else 0)


def stiffness(scene):
	"""A body on one of its faces, of the mean size of those of its volume, against another one of its material."""
	makers = jointMakers(scene.loops)
	if not makers or makers[0].kn:  # a MatchMaker: its values are not known here
		return
	deepest, worst, gravity, lost = 0.0, None, scene.gravity(), set(scene.fallen)  # what falls for ever meets nothing
	for body in scene.bodies:
		if body.id not in lost and isinstance(body.shape, Polytope) and isinstance(body.material, RockJointMat) and isMover(body):
			share = overlapShare(body, isPerArea(body.material, makers), gravity)
			if share > deepest:
				deepest, worst = share, body
	if deepest <= softest:
		return
	perArea = isPerArea(worst.material, makers)
	unit, other = ('Pa/m', 'N/m') if perArea else ('N/m', 'Pa/m')
	value = f'normalStiffness {_softest(worst):.3g} {unit}'
	seen = f'{value}: body {worst.id} sinks in by {deepest:.2g} of its inscribed radius, by its weight or speed'
	advice = f'a higher normalStiffness; if it is meant in {other}: RockJointMat(stiffnessPerArea={not perArea})'
	yield 'stiffness', seen, advice


def overlapShare(body, perArea, gravity):
	"""Overlap under its weight or in its impact, over its inscribed radius; for a body of RockJointMat."""
	shape, weight = body.shape, float(body.state.mass)
	face = float(shape.volume) ** (2 / 3) if shape.dimension == 3 else math.sqrt(float(shape.volume * shape.thickness))
	k = _softest(body) * (face if perArea else 1)
	return max(weight * gravity / k, float(body.state.vel.norm()) * math.sqrt(weight / k)) / inscribedRadius(shape) if weight > 0 else 0.0


def _softest(body):
	"""normalStiffness of the softest joint that it can have."""
	return min(float(material.normalStiffness) for material in materialsOf(body) if isinstance(material, RockJointMat))
