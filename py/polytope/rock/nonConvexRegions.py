# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions that are not convex, as convex parts: what a closed mesh encloses, a region without openings (tunnels, pits).

Their surfaces cut a convex region as joints do, each face only the blocks that it reaches into; each block is then inside or outside.
"""

import dataclasses
import math

import numpy as np
from yade import _polytope

from ..arguments import namedArguments, numbersOf, positive, rows, vectors, warn
from ..bodies.halfSpaces import boxPlanes
from ..bodies.meshes.digits import warnOfRounding
from ..bodies.meshes.files import readMesh
from ..bodies.polytopes import areFlat
from ..precision import real
from .inPlane import asPrisms
from .joint import Cut, Joint, asArguments
from .jointedRegion import areSeveral, regionOf

__all__ = ['meshRegion', 'regionWithout']

dust = 1e-12
"""Volume over the whole region's, below which a part is rounding between faces that meet in one corner, and is left out."""
gap = 1e-3
"""How far the winding number of a closed mesh may be from a whole one."""
missed = 1e-5
"""Tolerance on the volume of the parts, as a part of the mesh's: how far they may differ. Beyond it, faces cross."""
flat = 1e-6
"""Distance as a part of the mesh's extent: triangles that lie in one plane to within it are put into that plane. In a file they miss it by
the last digit, and parts as thin as this would be cut."""
around = 0.1
"""Margin as a part of the mesh's extent: how far the box that is cut reaches beyond the mesh, so that none of its faces is near one of the mesh's."""
needle = 1e-12
"""Area of a triangle over the square of its longest edge below which it has no plane and is left out."""
mostParts = 100000
"""Parts that a surface may cut a region into."""


@namedArguments
def meshRegion(path, scale=1):
	"""What a closed mesh encloses, as convex parts: ``polytope.jointedRock(*polytope.meshRegion('pit.stl'), sets)``.

	Exact: a box is cut along the triangles. So the number of parts grows with the triangles; take a coarse mesh.

	:param path: of a mesh file, as *fromMesh* reads them
	:param float scale: factor on all coordinates, for files in other units than metres
	:returns: (list of normals, list of offsets), one each for every part
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: naming *path* where the mesh is not closed, or its faces cross
	"""
	factor = positive(scale, 'scale')
	mesh = readMesh(path, 'path')
	points = np.array(mesh.points, float) * factor
	corners = points[mesh.triangles]
	edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
	areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
	sound = areas > needle * edges.max(axis=1) ** 2
	corners, areas = corners[sound], areas[sound]
	if not len(corners):
		raise ValueError(f"path: '{path}' has no triangles")
	warnOfRounding(path, 'path', points, float(np.median(edges)), 'the usual length of an edge')
	middle = (points.min(axis=0) + points.max(axis=0)) / 2
	volume = float(np.einsum('ij,ij->i', corners[:, 0] - middle, np.cross(corners[:, 1] - middle, corners[:, 2] - middle)).sum()) / 6
	used = points[np.unique(mesh.triangles)]
	extent = float(np.ptp(used, axis=0).max())
	box = boxPlanes(used.min(axis=0) - around * extent, used.max(axis=0) + around * extent)
	cells = _cells(*box, _flattened(corners, areas, middle, flat * extent))
	turns = np.array([_windings(cell[2], corners) for cell in cells])
	if np.abs(turns - turns.round()).max() > gap:
		raise ValueError(f"path: '{path}' is not closed; close its gaps (trimesh: fill_holes)")
	kept = [cell for cell, turn in zip(cells, turns, strict=True) if turn.round()]
	filled = sum(cell[3] for cell in kept)
	if abs(filled - abs(volume)) > missed * abs(volume):
		raise ValueError(f"path: '{path}' has faces that cross: it encloses {filled:.6g} m³, its faces add up to {abs(volume):.6g} m³")
	return _lists(kept)


@namedArguments
def regionWithout(normals, offsets, openings):
	"""A region without openings, such as tunnels and pits, as convex parts: ``polytope.jointedRock(*polytope.regionWithout(…), sets)``.

	:param normals, offsets: of the region, as for *jointedRock*; in the plane, with normals of two components, openings have such, too
	:param openings: list of (normals, offsets) of convex openings, which may overlap and reach out of the region
	:returns: (list of normals, list of offsets), one each for every part
	:raises ValueError: naming *openings* where one is not convex and bounded, or nothing is left
	"""
	if _areFlat(normals):
		return _withoutInPlane(normals, offsets, openings)
	try:
		solids = [_polytope.polyhedron(vectors(n, 'openings', 3), numbersOf(d, 'openings')) for n, d in openings]
	except (TypeError, ValueError) as error:
		raise ValueError(f'openings: must be a list of (normals, offsets) of convex openings; {error}') from None
	planes = [(np.array(solid['normals'], float), np.array(solid['offsets'], float)) for solid in solids]
	faces = []
	for solid in planes:
		rows = np.column_stack(solid)
		faces += [Cut(row[:3], row[3] * row[:3], edges=np.delete(rows, k, axis=0)) for k, row in enumerate(rows)]
	cells = _cells(normals, offsets, faces)
	inside = [[bool((n @ cell[2] < d).all()) for n, d in planes] for cell in cells]
	for k in np.flatnonzero(~np.any(inside, axis=0)):
		warn(
			f'openings: opening {k} (counted from 0) is wholly outside the region, and takes nothing away; is its place in other units or axes?'
		)
	kept = [cell for cell, within in zip(cells, inside, strict=True) if not any(within)]
	if not kept:
		raise ValueError('openings: nothing is left of the region')
	return _lists(kept)


def _areFlat(normals):
	return areFlat(normals[0] if areSeveral(normals) else normals)


def _withoutInPlane(normals, offsets, openings):
	"""All as prisms of one thickness."""
	several = areSeveral(normals)
	parts = list(zip(normals, offsets, strict=True)) if several else [(normals, offsets)]
	try:
		holes = [(rows(n, 'openings', 2), numbersOf(d, 'openings')) for n, d in openings]
		asPrisms(holes)  # refuses what bounds no polygon, as one of the openings
	except (TypeError, ValueError) as error:
		raise ValueError(
			f'openings: must be a list of (normals, offsets) with normals of two components, as those of the region; {error}'
		) from None
	half, prisms = asPrisms([*((rows(n, 'normals', 2), numbersOf(d, 'offsets')) for n, d in parts), *holes])
	solids, gaps = prisms[: len(parts)], prisms[len(parts) :]
	made = regionWithout([n for n, _ in solids], [d for _, d in solids], [(n, [*d[:-2], 2 * half, 2 * half]) for n, d in gaps])
	sides = [np.abs(n[:, 2]) < 0.5 for n in made[0]]
	return [n[on][:, :2] for n, on in zip(made[0], sides, strict=True)], [d[on] for d, on in zip(made[1], sides, strict=True)]


def _cells(normals, offsets, faces):
	"""Convex cells into which faces cut a region, each along its whole plane: (normals, offsets, a point inside, volume)."""
	region = regionOf(normals, offsets)
	made = _polytope.jointedBlocks(
		region.parts, asArguments([face.moved(-region.centre) for face in faces]), real(0), real(-1), mostParts, 0
	)
	planes, volumes = np.frombuffer(made['planes']).reshape(-1, 4), np.frombuffer(made['volumes'])
	ends = np.cumsum(np.frombuffer(made['counts'], np.int32))
	cells = []
	for begin, end, volume in zip([0, *ends[:-1]], ends, volumes.tolist(), strict=True):
		if volume > dust * region.volume:
			own = planes[begin:end]
			shape = _polytope.polyhedron(vectors(own[:, :3], 'normals', 3), numbersOf(own[:, 3], 'offsets'))
			inside = np.array(shape['centroid'], float) + region.centre
			cells.append((own[:, :3].copy(), own[:, 3] + own[:, :3] @ region.centre, inside, volume))
	return cells


def _flattened(triangles, areas, middle, apart):
	"""Triangles as joints; those near the plane of a larger one lie in it."""
	normals, distances, faces = np.empty((0, 3)), np.empty(0), []
	for k in np.argsort(-areas, kind='stable'):
		corners = triangles[k] - middle
		near = np.flatnonzero(np.abs(normals @ corners.T - distances[:, None]).max(axis=1, initial=0) <= apart) if len(normals) else []
		if len(near):
			corners -= np.outer(corners @ normals[near[0]] - distances[near[0]], normals[near[0]])
			faces.append(dataclasses.replace(Joint.polygon(corners + middle).cut, normal=normals[near[0]]))
			faces[-1].centre = middle + corners.mean(axis=0)
		else:
			faces.append(Joint.polygon(corners + middle).cut)
			normals = np.vstack([normals, faces[-1].normal])
			distances = np.append(distances, corners.mean(axis=0) @ faces[-1].normal)
	return faces


def _windings(point, triangles):
	"""How often a surface winds round a point: the sum of solid angles over 4π (van Oosterom & Strackee 1983, IEEE Trans. Biomed. Eng.
	30:125-126)."""
	a, b, c = (triangles[:, k] - point for k in range(3))
	la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
	over = np.einsum('ij,ij->i', a, np.cross(b, c))
	under = la * lb * lc + np.einsum('ij,ij->i', a, b) * lc + np.einsum('ij,ij->i', b, c) * la + np.einsum('ij,ij->i', c, a) * lb
	return float(np.arctan2(over, under).sum()) / (2 * math.pi)


def _lists(cells):
	return [cell[0] for cell in cells], [cell[1] for cell in cells]
