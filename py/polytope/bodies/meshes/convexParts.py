# SPDX-License-Identifier: GPL-2.0-or-later
"""A mesh that is not convex as convex parts, by CoACD (Wei et al. 2022, ACM Transactions on Graphics 41:42)."""

import dataclasses
import hashlib

import numpy as np
from tqdm import tqdm

from .closedPieces import piecesOf

__all__ = ['Cuts', 'cut']

enough = 0.01
"""Relative difference of the volumes of the mesh and of its parts up to which it is asked for no finer ones."""
concavities = 0.05, 0.02, 0.01
"""Concavity of a part that CoACD cuts no further (its *threshold*): the usual one, and finer ones, down to its least, while the volume is not met."""

far = 1000.0
"""Distance from the origin over the extent from which on a mesh is cut about its middle: volumes are sums of products with that distance."""

kept = 100
"""Meshes whose parts stay in memory: many stones are copies of a few, and cutting takes seconds."""
cutMeshes = {}
"""Parts, by the content of the mesh and the number of parts."""


@dataclasses.dataclass
class Cuts:
	parts: list
	"""points (k, 3) of each, in the mesh's units"""
	volume: float | None
	"""of the mesh; None if it is not closed"""
	told: bool = False
	"""whether a warning has said how far they miss the mesh's volume"""


def cut(mesh, most):
	"""Parts of a mesh, at most so many. The same mesh is cut once.

	:returns: *Cuts*, which others have, too
	:raises ImportError: if CoACD is not installed
	"""
	content = hashlib.sha256(mesh.points.tobytes())
	content.update(mesh.triangles.tobytes())
	content.update(mesh.objects.tobytes())
	key = content.digest(), most
	if key not in cutMeshes:
		pieces = piecesOf(mesh)
		closed = bool(pieces) and all(piece.closed for piece in pieces)
		volume = float(sum(piece.volume for piece in pieces)) if closed else None
		with tqdm(desc=f'cutting {len(mesh.triangles)} triangles into convex parts', bar_format='{desc} …', disable=None, leave=False):
			parts = decomposed(mesh.points, mesh.triangles, most, volume)
		if len(cutMeshes) >= kept:
			del cutMeshes[next(iter(cutMeshes))]
		cutMeshes[key] = Cuts(parts, volume)
	return cutMeshes[key]


def decomposed(points, triangles, most, volume):
	"""Points of the parts that come nearest to the mesh's volume: with CoACD's usual concavity it may stop far below so many parts.

	:param points, triangles: (n, 3) [m], (m, 3)
	:param int most: number of parts
	:param float volume: of the mesh [m³]; None if it is not closed
	:returns: list of arrays (k, 3)
	:raises ImportError: if CoACD is not installed
	"""
	import trimesh

	try:
		import coacd
	except ImportError as error:
		remedy = "install it (it is optional) with 'pip install --no-deps --target ~/coacd coacd' and set PYTHONPATH=~/coacd, or cut the mesh with another program and take parts='objects'"
		raise ImportError(f"parts: needs CoACD, which is not installed; {remedy}") from error
	coacd.set_log_level('error')
	low, high = points.min(axis=0), points.max(axis=0)
	middle, unit = (low + high) / 2, float((high - low).max()) or 1.0
	if np.abs(middle).max() < far * unit:
		middle = np.zeros(3)
	# joins equal vertices: from those of an STL file CoACD makes a closed mesh of its own, slowly and too large; at unit size, wherever it is
	mesh = trimesh.Trimesh((points - middle) / unit, triangles)
	best, least = None, np.inf
	for concavity in concavities:
		found = coacd.run_coacd(coacd.Mesh(mesh.vertices * unit, mesh.faces), threshold=concavity, max_convex_hull=most, seed=0)
		pieces = [np.asarray(corners, float) for corners, _ in found]
		filled = sum(trimesh.convex.convex_hull(piece / unit).volume for piece in pieces) * unit**3
		excess = 0 if volume is None else abs(filled / volume - 1)
		if excess < least:
			best, least = pieces, excess
		if excess <= enough or len(pieces) >= most:
			break
	return [piece + middle for piece in best]
