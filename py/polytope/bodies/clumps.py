# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that are not convex, as clumps of convex parts that may overlap: `polytope.clump(…)`. Mass and inertia are those of the union."""

from collections.abc import Iterable

import numpy as np
from yade import Body, Matrix3, O, Polytope, Quaternion, Vector3, _polytope

from ..arguments import warn
from ..scene.vertices import rotationMatrix
from .halfSpaces import planesAboutCentre
from .polytopes import fromHalfSpaces, isotropyTolerance

__all__ = ['clump', 'newParts', 'ofUnion', 'rigid', 'union', 'volumeOfUnion']

apart = 0.01
"""Gap between two parts over the smaller one's inscribed radius, above which they do not belong together: parts that a program cuts out of a mesh
miss each other by the rounding of their file, a part in the wrong place by a part of its size."""


def clump(parts):
	"""Adds convex bodies to the scene as one rigid body, a clump: ``number, members = polytope.clump([polytope.cuboid(…), …])``.

	The parts may touch and overlap. Mass, centre of mass and inertia are those of their union, where overlaps count once, with the density
	of the part that comes first; O.bodies.appendClumped counts them for each part. There are no contacts between parts, and bodies slide
	over faces that two parts share as over one. It moves as the first part does, and is fixed if that is.

	Parts that do not touch are allowed, as in YADE: the clump is rigid across the gap. Since that is seldom meant, a warning names the part.

	O.bodies.updateClumpProperties and addToClump make YADE's sums of them again.

	:param parts: list of polyhedra, or of polygons in one plane and of one thickness, that are not in the scene yet, or one
	:returns: (number of the clump, numbers of its parts), as O.bodies.appendClumped does
	:raises ValueError: naming *parts*, also where their union would take more than some ten seconds
	"""
	parts = newParts(parts, 'parts', '; O.bodies.clump makes clumps of bodies that are, with the sum of their masses')
	made = ofUnion(parts)
	_warnOfPartsApart(parts)
	return made


def newParts(parts, name, remedy=''):
	"""List of bodies that can be parts of one, or ValueError with the name of the argument; `remedy`: for those that are in the scene."""
	parts = [parts] if isinstance(parts, Body) else list(parts) if isinstance(parts, Iterable) else []
	if not parts or not all(isinstance(part, Body) and isinstance(part.shape, Polytope) for part in parts):
		raise ValueError(f'{name}: must be a list of polyhedra or of polygons, as polytope.cuboid, polytope.polygon and other builders make')
	if len({_plane(part) for part in parts}) > 1:
		raise ValueError(f'{name}: must all be polyhedra, or all polygons of one thickness and in one plane, with the same z')
	if len({id(part) for part in parts}) < len(parts):
		raise ValueError(f'{name}: the same body is there twice; each part is a body of its own')
	if any(part.id >= 0 for part in parts):
		raise ValueError(f'{name}: must not be in the scene yet{remedy}')
	return parts


def ofUnion(parts):
	"""A clump of parts that may overlap."""
	return _append(parts, *union(parts))


def rigid(parts):
	"""A clump of parts that are known to touch and not to overlap: sums over them, in a time in proportion to their number."""
	masses = np.array([float(part.state.mass) for part in parts])
	places = np.array([[float(x) for x in part.state.pos] for part in parts])
	centre = masses @ places / masses.sum()
	tensor = np.zeros((3, 3))
	for part, mass, place in zip(parts, masses, places, strict=True):
		turn = rotationMatrix(part.state.ori)
		away = place - centre
		tensor += turn @ np.diag(np.array(part.state.inertia, float)) @ turn.T + mass * (away @ away * np.eye(3) - np.outer(away, away))
	return _append(parts, float(masses.sum()), centre, tensor)


def _append(parts, mass, centre, tensor):
	"""Adds the clump with this mass, centre of mass and tensor of inertia about it."""
	first = parts[0].state
	velocity = first.vel + first.angVel.cross(Vector3(*centre) - first.pos)
	spin, blocked = Vector3(first.angVel), first.blockedDOFs
	number, members = O.bodies.appendClumped(parts)
	moments, axes = np.linalg.eigh(tensor)
	if np.linalg.det(axes) < 0:
		axes[:, 0] *= -1
	_polytope.setClump(O.bodies[number], mass, Vector3(*moments), Vector3(*centre), _quaternion(axes), isotropyTolerance)
	state = O.bodies[number].state
	state.vel, state.angVel, state.blockedDOFs = velocity, spin, blocked
	state.angMom = Vector3(*(tensor @ np.array(spin, float)))
	return number, members


def union(parts):
	"""(mass, centre of mass, tensor of inertia about it) of what polyhedra, or polygons, fill together (src/cutting/UnionOfParts.hpp)."""
	_, mass, centre, tensor = _polytope.unionOf(_solids(parts))
	return float(mass), np.array(centre, float), np.array(tensor, float).reshape(3, 3)


def volumeOfUnion(parts):
	"""Volume of what polyhedra, or polygons with their thickness, fill together [m³]."""
	return float(_polytope.unionOf(_solids(parts))[0])


def _plane(part):
	"""(thickness, z) of a polygon; None of a polyhedron."""
	return (float(part.shape.thickness), float(part.state.pos[2])) if part.shape.dimension == 2 else None


def _solids(parts):
	"""Polygons as the prisms that they stand for."""
	return [_prism(part) if part.shape.dimension == 2 else part for part in parts]


def _prism(part):
	normals, offsets = planesAboutCentre(part)
	moved = [offset + normal.dot(part.state.pos) for normal, offset in zip(normals, offsets, strict=True)]
	made = fromHalfSpaces(normals, moved, material=part.material)
	made.state.mass = part.state.mass
	return made


def _warnOfPartsApart(parts):
	"""Parts that touch none of the others, as groups: the body is rigid across the gap all the same."""
	reach = [max(float(vertex.norm()) for vertex in part.shape.vertices) for part in parts]
	groups = list(range(len(parts)))
	for j, part in enumerate(parts):
		for k in range(j):
			allowed = apart * float(min(part.shape.inscribedRadius, parts[k].shape.inscribedRadius))
			if groups[j] == groups[k] or (part.state.pos - parts[k].state.pos).norm() > reach[j] + reach[k] + allowed:
				continue
			if _polytope.contact(part, parts[k]).infeasibility < allowed / 2:  # half of the gap
				groups = [groups[k] if group == groups[j] else group for group in groups]
	alone = [k for k, group in enumerate(groups) if group != groups[0]]
	if alone:
		warn(
			f'parts: part {alone[0]} touches neither part 0 nor what is joined to it; the clump is rigid across the gap. If that is not meant, check center and extents of the part',
		)


def _quaternion(axes):
	"""Quaternion of the rotation whose matrix has these columns."""
	return Quaternion(Matrix3(*axes.flatten().tolist())).normalized()
