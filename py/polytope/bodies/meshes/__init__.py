# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies from mesh files: the convex hull of all that a file has, or a list of convex parts: `polytope.fromMesh(…)`; facets."""

import numbers

import numpy as np
from yade import Vector3, _polytope

from ...arguments import positive, rotation, vector, vectors, warn
from ..clumps import union
from ..polytopes import bodyOf, builder, ofOneColour
from .closedPieces import piecesOf
from .convexParts import cut
from .digits import remedy, warnOfRounding
from .facets import facets
from .files import readMesh

__all__ = ['facets', 'fromMesh']

notConvex = 1e-3
"""Part of the hull's volume that a mesh may lack and still count as convex: curved surfaces of flat triangles lack some."""
singlePrecision = 1e-6
"""Distance over the extent up to which a mesh file's points count as coplanar: binary STL and most exporters keep 24 bits."""
facetNoise = 4.0
"""Distance over the largest error of a coordinate up to which points count as coplanar, where that is more: they are rounded in three
coordinates; and a margin."""
mostNoise = 0.01
"""The most that this distance may be, over the extent."""
farOut = 1000.0
"""Distance from the origin over the extent from which on a body that is none may be one whose file has too few digits."""
enough = 0.01
"""Relative difference of the volumes of the mesh and of its parts above which there is a warning: such parts are another body."""
asFacets = 'a container (funnel, cup, drum) is read by polytope.facets(…)'
named = 3
"""How many of several objects a warning names."""


@builder
def fromMesh(path, scale=1.0, parts=None, **body):
	"""Convex hull of a mesh file's vertices, as a body at its centroid; or with *parts* a list of convex bodies.

	Formats: STL, OBJ, PLY, OFF, GLB, 3MF … (trimesh); GTS; VTK's own; Gmsh, TetGen, Abaqus, Medit … (meshio). For a mesh of volumes, the
	surface is taken. A warning tells of a mesh that is not closed, not convex, or several bodies, and of a file whose numbers have too few
	digits where the mesh is. A container (funnel, cup, drum) is read by *facets*.

	:param path: the file
	:param float scale: factor on all coordinates, for files in other units than metres
	:param parts: 'objects': the file's bodies, as a list: its objects (lines ``o`` of OBJ, solids of STL, geometries of GLB and 3MF,
	    volumes of Gmsh), and in each of these the pieces that are closed by themselves, which may share corners, edges and faces. For one
	    that is not convex or not closed, the hull is taken, with a warning; a single one is refused. Or the number of convex parts at most,
	    into which CoACD cuts the mesh, approximately: ``polytope.clump(polytope.fromMesh('horse.obj', parts=20))``. CoACD is optional:
	    ``pip install --no-deps --target ~/coacd coacd``, and PYTHONPATH=~/coacd. *center* and *orientation* are of the whole. A mesh is cut
	    once: further calls, also with another *scale*, make copies of the same parts.
	:raises ImportError: if CoACD is needed and not installed
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: naming *path* if it is none or the file cannot be read as a mesh or its hull is flat; naming *scale* if not positive; *parts*
	"""
	scale = positive(scale, 'scale')
	cutting = isinstance(parts, numbers.Integral) and not isinstance(parts, bool) and parts > 0
	if not (parts is None or parts == 'objects' or cutting):
		raise ValueError(f"parts: must be a number of parts above 0, or 'objects', got {parts!r}")
	mesh = readMesh(path, 'path')
	error = warnOfRounding(path, 'path', mesh.points, _extent(mesh.points), 'its extent') * scale
	cuts = cut(mesh, int(parts)) if cutting else None
	mesh.points = mesh.points * scale
	if parts is None:
		made = _hull(path, mesh.points, error, body)
		_tellWhatTheHullHides(path, mesh, float(made.shape.volume), _lacking(mesh.points, error))
		return made
	center, orientation = body.pop('center', None), body.pop('orientation', None)
	made = _decomposed(path, cuts, scale, body) if cutting else _objects(path, mesh, error, body)
	if center is not None or orientation is not None:
		_place(made, Vector3(*union(made)[1]), center, orientation)
	return made


def _extent(points):
	return float(np.ptp(points, axis=0).max())


def _noise(points, error):
	"""How far points of a plane may lie apart, over the extent, if each of their coordinates may be off by *error*."""
	return facetNoise * error / (_extent(points) or 1)


def _lacking(points, error):
	"""Part of the hull's volume that a convex mesh may lack, if each of its coordinates may be off by *error*."""
	return max(notConvex, min(_noise(points, error), 1))


def _hull(path, points, error, body):
	"""The body of the hull of points, each coordinate of which may be off by *error*."""
	corners = vectors(points, 'points', 3)
	coplanar = min(max(singlePrecision, _noise(points, error)), mostNoise)

	def shape(*corner):
		try:
			return _polytope.ofPoints(corners, 3, coplanar, 1, *corner)
		except ValueError as refusal:
			if not str(refusal).startswith('points'):
				raise
			largest, extent = float(np.abs(points).max()), _extent(points)
			digits = (
				f'; at coordinates up to {largest:.3g} m its numbers may have too few digits: {remedy}' if largest > farOut * extent else ''
			)
			raise ValueError(f"path: the vertices of '{path}' make no body ({refusal}){digits}") from None

	return bodyOf(shape, **body)


def _tellWhatTheHullHides(path, mesh, hull, lacking):
	"""Warns where the hull is not the body of the mesh."""
	pieces = piecesOf(mesh)
	if len(pieces) > 1 and (sum(piece.closed for piece in pieces) > 1 or mesh.objects.any()):
		seen = f"path: '{path}' has {len(pieces)} bodies; the body is the convex hull of all of them, {hull:.3g} m³"
		warn(f"{seen}; polytope.fromMesh(…, parts='objects') makes a list of all, for O.bodies.append or polytope.clump")
	elif len(pieces) != 1 or not pieces[0].closed:
		warn(f"path: '{path}' is not closed; the body is the convex hull of its vertices; {asFacets}")
	elif pieces[0].volume < (1 - lacking) * hull:
		seen = f"path: '{path}' is not convex: it has {pieces[0].volume:.3g} m³, its hull, which the body is, {hull:.3g} m³"
		warn(f'{seen}; polytope.clump(polytope.fromMesh(…, parts=…)) makes a body of convex parts; {asFacets}')


def _objects(path, mesh, error, body):
	"""Bodies of the pieces of a mesh."""
	pieces = piecesOf(mesh)
	made, odd = [], {}
	for number, piece in enumerate(pieces, 1):
		points = mesh.points[np.unique(mesh.triangles[piece.triangles])]
		if not piece.closed:
			odd[number] = 'is not closed'
		elif piece.volume < (1 - _lacking(points, error)) * piece.hull:
			odd[number] = f'is not convex ({piece.volume:.3g} m³, its hull {piece.hull:.3g} m³)'
		if odd and len(pieces) == 1:
			remedy = f'close it, or cut it into convex ones, or give a number of parts for CoACD; {asFacets}'
			raise ValueError(f"path: object 1 of '{path}' {odd[1]}, and there is no other; {remedy}")
		if piece.hull == 0:
			odd[number] = 'is flat and is left out'
		else:
			made.append(_hull(path, points, error, body))
	if not made:
		raise ValueError(f"path: '{path}' has no object that is a body")
	if odd:
		seen = [f'object {number} {what}' for number, what in odd.items()]
		more = f' and {len(seen) - named} more' if len(seen) > named else ''
		warn(
			f"path: of '{path}', {', '.join(seen[:named])}{more}; the body is the convex hull; cut it into convex ones if that is not meant"
		)
	return made


def _decomposed(path, cuts, scale, body):
	"""Bodies of the parts into which CoACD cut a mesh."""
	pieces = ofOneColour(body)
	made = [_hull(path, part * scale, 0, pieces) for part in cuts.parts]
	found = union(made)[0] / float(made[0].material.density)
	volume = cuts.volume and cuts.volume * scale**3
	if volume and abs(found / volume - 1) > enough and not cuts.told:
		cuts.told = True  # as of all stones of this mesh
		seen = f"path: '{path}' has {volume:.3g} m³, its {len(made)} convex parts {found:.3g} m³"
		warn(f"{seen}; give more parts, or cut the mesh with another program and take parts='objects'")
	return made


def _place(made, middle, center, orientation):
	"""Moves parts as one body, turned about *middle*."""
	turn = None if orientation is None else rotation(orientation)
	shift = middle if center is None else vector(center, 'center')
	for part in made:
		state = part.state
		arm = state.pos - middle
		state.pos = state.refPos = shift + (arm if turn is None else turn * arm)
		if turn is not None:
			state.ori = state.refOri = turn * state.ori
