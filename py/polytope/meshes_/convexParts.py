# SPDX-License-Identifier: GPL-2.0-or-later
"""A mesh that is not convex as convex parts, by CoACD (Wei et al. 2022, ACM Transactions on Graphics 41:42) or as its file has them."""

import numbers

import numpy as np
import scipy.sparse.csgraph
from yade import Vector3

from .arguments import rotation, vector, warn
from .bodies import fromVertices, notConvex
from .clumps import union

__all__ = ['convexParts']

enough = 0.01
"""Relative difference of the volumes of the mesh and of its parts above which there is a warning: such parts are another body."""
concavities = 0.05, 0.02, 0.01
"""Of a part that CoACD cuts no further (its *threshold*): the usual one, and finer ones, down to its least, while the volume is not met."""


def convexParts(path, points, triangles, parts, body):
	"""Bodies of the parts of a mesh; what fromMesh does with *parts*.

	:param points, triangles: (n, 3) [m], (m, 3)
	:param dict body: arguments of all bodies
	"""
	import trimesh

	if parts == 'objects':
		pieces = _objects(path, points, triangles)
	elif isinstance(parts, numbers.Integral) and not isinstance(parts, bool) and parts > 0:
		pieces = _decomposed(path, points, triangles, int(parts))
	else:
		raise ValueError(f"parts: must be a number of parts above 0, or 'objects', got {parts!r}")
	center, orientation = body.pop('center', None), body.pop('orientation', None)
	made = [fromVertices(piece, **body) for piece in pieces]
	_, middle, _ = whole = union(made)
	mesh, volume = trimesh.Trimesh(points, triangles), whole[0] / float(made[0].material.density)
	if mesh.is_watertight and parts != 'objects' and abs(volume / abs(mesh.volume) - 1) > enough:
		seen = f"path: '{path}' has {abs(mesh.volume):.3g} m³, its {len(made)} convex parts {volume:.3g} m³"
		warn(f"{seen}; give more parts, or cut the mesh with another program and take parts='objects'")
	_place(made, Vector3(*middle), center, orientation)
	return made


def _objects(path, points, triangles):
	"""Points of the pieces that share no vertex of the file."""
	import trimesh

	starts, ends = triangles[:, [0, 1]].ravel(), triangles[:, [1, 2]].ravel()
	links = scipy.sparse.coo_matrix((np.ones(len(starts)), (starts, ends)), (len(points),) * 2)
	labels = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
	pieces = []
	for k in np.unique(labels[triangles[:, 0]]):
		one = trimesh.Trimesh(points, triangles[labels[triangles[:, 0]] == k])
		where = f"path: object {len(pieces) + 1} of '{path}'"
		if not one.is_watertight:
			raise ValueError(
				f'{where} is not closed; write the file as OBJ or PLY, in which triangles share their vertices, with closed objects'
			)
		if abs(one.volume) < (1 - notConvex) * one.convex_hull.volume:
			raise ValueError(f'{where} is not convex; cut it into convex ones, or give a number of parts for CoACD')
		pieces.append(points[labels == k].tolist())
	return pieces


def _decomposed(path, points, triangles, most):
	"""Points of the parts that come nearest to the mesh's volume: with CoACD's usual concavity it may stop far below so many parts."""
	import trimesh

	try:
		import coacd
	except ImportError as error:
		remedy = "install it with 'pip install coacd' (it is optional), or cut the mesh with another program and take parts='objects'"
		raise ImportError(f"parts: needs CoACD, which is not installed; {remedy}") from error
	coacd.set_log_level('error')
	# joins equal vertices: of those of an STL file CoACD makes a closed mesh of its own, slowly and too large
	mesh = trimesh.Trimesh(points, triangles)
	best, least = None, np.inf
	for concavity in concavities:
		found = coacd.run_coacd(coacd.Mesh(mesh.vertices, mesh.faces), threshold=concavity, max_convex_hull=most, seed=0)
		pieces = [np.asarray(corners, float) for corners, _ in found]
		excess = abs(sum(trimesh.convex.convex_hull(piece).volume for piece in pieces) / abs(mesh.volume) - 1) if mesh.is_watertight else 0
		if excess < least:
			best, least = pieces, excess
		if excess <= enough or len(pieces) >= most:
			break
	return [piece.tolist() for piece in best]


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
