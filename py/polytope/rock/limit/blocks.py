# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene as rigid blocks with joints where their faces lie on each other, in arrays."""

import dataclasses
import math

import numpy as np
from scipy.sparse import csgraph, csr_matrix
from yade import O, Polytope, RockJointMat

from ...bonding.bonds import intactBonds, presentBonds
from ...scene.movers import canMove, moverOf, partsOf
from ...scene.present import integrators
from ...scene.ranks import refuseDivided
from ...scene.stages import refuseMatchMaker, sizeOf
from ..commonFaces import boundFaces, commonFaces, lesser, materialsOfSides
from ..faces import frameOf, triangles
from ..stress.forces import weightAndWater
from .givenLoads import givenLoads

__all__ = ['Blocks', 'Corners', 'blocksOf', 'cornersOf', 'refuseScene']

components = 'xyzXYZ'


@dataclasses.dataclass
class Blocks:
	"""Rigid ones that can move: bodies and clumps, those that bonds without a limit hold together as one."""

	ids: list
	"""For each the ids of its bodies and clumps."""
	centres: np.ndarray
	"""(n, 3) [m]"""
	loads: np.ndarray
	"""(n, 6) weight, given loads and water: force [N], and moment about the centre [N·m]"""
	free: np.ndarray
	"""(n, 6) of the components of motion those that are not blocked"""
	sizes: np.ndarray
	"""(n,) edges of cubes, or squares, of the same volume [m]"""

	def __post_init__(self):
		self._rows = {k: number for number, group in enumerate(self.ids) for k in group}

	def rowOf(self, k):
		"""Row of the block that body k is of; −1: it does not move, or is gone."""
		return self._rows.get(moverOf(k), -1) if O.bodies[k] is not None else -1


@dataclasses.dataclass
class Corners:
	"""Corners of joints, and their faces."""

	one: np.ndarray
	"""(faces,) row of the block in *Blocks*, −1: it does not move"""
	two: np.ndarray
	middles: np.ndarray
	"""(faces, 3) centroids [m]"""
	face: np.ndarray
	"""(corners,) row of the face"""
	places: np.ndarray
	"""(corners, 3) [m]"""
	frames: np.ndarray
	"""(corners, 3, 3) columns: normal from block *one* to block *two*, two directions across"""
	areas: np.ndarray
	"""(corners,) parts of the face's area, whose centroid is the face's [m²]"""
	friction: np.ndarray
	"""(corners,) tan φ"""
	cohesion: np.ndarray
	"""(corners,) [Pa]"""
	tension: np.ndarray
	"""(corners,) tensile strength [Pa]"""


def refuseScene():
	"""What blocks with joints alone are no model of."""
	refuseDivided()
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	if O.periodic:
		raise ValueError('O.periodic: a factor of safety is that of blocks beside fixed ones, and a periodic cell has no fixed one')
	if not integrators():
		raise ValueError('O.engines: there must be a NewtonIntegrator, with gravity; set O.engines first')
	refuseMatchMaker()
	if any(math.isinf(bond.tensileStrength) != math.isinf(bond.cohesion) for bond in intactBonds()):
		raise ValueError(
			'polytope.bond: a bond has one strength without a limit; give it a tensileStrength and a cohesion, or both infinite, which makes one block of what it joins'
		)
	for body in O.bodies:
		if body is not None and not body.isClump and not isinstance(body.shape, Polytope):
			raise ValueError(
				f'O.bodies: body {body.id} is a {type(body.shape).__name__}; joints are where faces of Polytopes lie on each other, so supports must be Polytopes, too'
			)


def _isRigid(bond):
	"""Whether it holds whatever happens."""
	return math.isinf(bond.tensileStrength) and math.isinf(bond.cohesion)


def _groups():
	"""Ids of bodies and clumps that can move, in groups that bonds without a limit hold together; without those that such bonds hold to a
	fixed body."""
	movers = [body.id for body in O.bodies if body is not None and moverOf(body.id) == body.id]
	row = {k: number for number, k in enumerate(movers)}
	links = [(row[moverOf(bond.id1)], row[moverOf(bond.id2)]) for bond in presentBonds() if _isRigid(bond)]
	one, two = np.array(links, int).reshape(-1, 2).T
	labels = csgraph.connected_components(csr_matrix((np.ones(len(one)), (one, two)), (len(movers), len(movers))), directed=False)[1]
	groups = {}
	for k, label in zip(movers, labels.tolist(), strict=True):
		groups.setdefault(label, []).append(k)
	return [group for group in groups.values() if all(canMove(O.bodies[k]) for k in group)]


def blocksOf():
	ids = _groups()
	if not ids:
		raise ValueError('O.bodies: none can move; append blocks that are not fixed')
	given = givenLoads()
	weights = weightAndWater([k for group in ids for k in group])
	loads, centres = np.zeros((len(ids), 6)), np.zeros((len(ids), 3))
	for row, group in enumerate(ids):
		masses = np.array([float(O.bodies[k].state.mass) for k in group])
		places = np.array([[float(x) for x in O.bodies[k].state.pos] for k in group])
		centres[row] = masses @ places / masses.sum()
		for k, place in zip(group, places, strict=True):
			arm = place - centres[row]
			own = [
				weights[k],
				*(_atCentre(given[part], part, k) for part in {k, *partsOf(k)} & set(given)),
			]
			for force, moment in own:
				force = np.array([float(x) for x in force])
				loads[row] += [*force, *(np.array([float(x) for x in moment]) + np.cross(arm, force))]
	blocked = [set().union(*(O.bodies[k].state.blockedDOFs for k in group)) for group in ids]
	free = np.array([[component not in some for component in components] for some in blocked])
	if not (loads * free).any():
		raise ValueError(
			'O.engines: nothing loads the blocks; give NewtonIntegrator gravity, or blocks a permanent force (O.forces.setPermF) or a ForceEngine'
		)
	return Blocks(ids, centres, loads, free, np.array([float(np.linalg.norm([sizeOf(k) for k in group], ord=3)) for group in ids]))


def _atCentre(load, part, k):
	"""Permanent force on a part of a clump, and its moment about the clump's centre."""
	force, moment = load
	return force, moment + (O.bodies[part].state.pos - O.bodies[k].state.pos).cross(force)


def cornersOf(blocks, links):
	"""Joints of these blocks.

	:param links: *Links* of their bolts
	:raises ValueError: naming what is no joint, and blocks that no joint and no bolt connects to a fixed one
	"""
	faces = [face for face in _jointFaces() if blocks.rowOf(face.id1) != blocks.rowOf(face.id2)]
	one, two = (np.array([blocks.rowOf(k) for k in ids], int) for ids in ([face.id1 for face in faces], [face.id2 for face in faces]))
	_refuseLoose(blocks, np.append(one, links.one), np.append(two, links.two))
	bonded = {frozenset((bond.id1, bond.id2)): bond for bond in intactBonds()}
	strengths = np.array([_strengthsOf(face, bonded.get(frozenset((face.id1, face.id2)))) for face in faces]).reshape(-1, 3)
	counts = [len(face.corners) for face in faces]
	face = np.repeat(np.arange(len(faces)), counts)
	return Corners(
		one,
		two,
		np.array([one.centroid for one in faces]).reshape(-1, 3),
		face,
		np.concatenate([np.empty((0, 3)), *(one.corners for one in faces)]),
		np.array([frameOf(one.normal) for one in faces]).reshape(-1, 3, 3)[face],
		np.concatenate([np.empty(0), *(_areas(one) for one in faces)]),
		*strengths[face].T,
	)


def _jointFaces():
	"""Faces that lie on each other, and those that tension has parted but not broken."""
	faces = commonFaces()
	known = {frozenset((face.id1, face.id2)) for face in faces}
	return faces + [face for face in boundFaces() if frozenset((face.id1, face.id2)) not in known]


def _refuseLoose(blocks, one, two):
	count = len(blocks.ids)
	held = np.flatnonzero(
		~blocks.free[:, :2].all(axis=1) | ~blocks.free[:, 5]
	)  # along an axis at least; polygons do not leave their plane anyway
	graph = csr_matrix(
		(
			np.ones(len(one) + len(held)),
			(np.append(np.where(one < 0, count, one), held), np.append(np.where(two < 0, count, two), np.full(len(held), count))),
		),
		(count + 1, count + 1),
	)
	part = csgraph.connected_components(graph, directed=False)[1]
	loose = [group[0] for group, number in zip(blocks.ids, part, strict=False) if number != part[-1]]
	if loose:
		ones = ', '.join(map(str, loose[:5])) + (' …' if len(loose) > 5 else '')
		raise ValueError(
			f'O.bodies: no faces that lie on each other, and no bolts, connect {len(loose)} blocks to a fixed one ({ones}), and nothing would hold them, whatever the strengths; '
			'erase them, fix blocks at the edge of the mass (body.dynamic=False), or put faces on each other to a millionth of their size; a block that leans on its joint after '
			'polytope.settle() does not: call limitAnalysis before it'
		)


def _strengthsOf(face, bond):
	"""(tan φ, cohesion, tensile strength): of the bond, or the lower ones of the two sides."""
	if bond is not None:
		return math.tan(bond.frictionAngle), float(bond.cohesion), float(bond.tensileStrength)
	sides = materialsOfSides(face)
	for k, material in zip((face.id1, face.id2), sides, strict=True):
		if not isinstance(material, RockJointMat):
			raise ValueError(f'O.bodies: body {k} is of a {type(material).__name__}; strengths of joints are those of RockJointMat')
		if material.strength is not None:
			raise ValueError(
				f'O.bodies: a joint of body {k} has a shear law of its own ({type(material.strength).__name__}), whose strength depends on slip; limit analysis has '
				'Mohr-Coulomb: give strength=None, frictionAngle and cohesion, or take polytope.factorOfSafety'
			)
	friction, cohesion, tensile = (float(lesser(name, sides)) for name in ('frictionAngle', 'cohesion', 'tensileStrength'))
	return math.tan(friction), cohesion, tensile


def _areas(face):
	"""Half of the two triangles with the centroid beside each corner: so much at the corners has the face's area and centroid."""
	areas = np.linalg.norm(triangles(np.vstack([face.centroid, face.corners, face.corners[:1]])), axis=1)
	return (areas + np.roll(areas, 1)) / 2
