# SPDX-License-Identifier: GPL-2.0-or-later
"""Ground of a height map or of a mesh, as fixed prisms. Bodies slide over the joints between them as over one face (docs/surfaces.md)."""

import os

import numpy as np
import scipy

from ..arguments import positive, rows, vector
from .meshes.digits import warnOfRounding
from .meshes.files import readMesh
from .polytopes import builder, fromVertices, ofOneColour

__all__ = ['terrain']

thicknessFraction = 0.1
"""Default thickness below the lowest point, over the horizontal extent."""
flat = 1e-9
"""A mesh's triangle whose horizontal area, over the square of its longest edge, is below this is vertical and is left out."""


@builder(lacks=('center', 'orientation'))
def terrain(heights, spacing=None, depth=None, origin=(0, 0), scale=1.0, shift=(0, 0, 0), **body):
	"""Ground from a height map or from a mesh file, as fixed triangular prisms from the surface down to one level.

	:param heights: (n, m) heights z [m] at x, y = origin + spacing · (i, j); or the path of a mesh file, of whose triangles the vertical ones are
	    left out, and, where it is closed, those that look down. It must not hang over
	:param float spacing: distance of neighbouring heights [m]; not for a mesh
	:param float depth: of the base below the lowest point of the surface [m]; default a tenth of the horizontal extent
	:param origin: x and y of the first height [m]; not for a mesh
	:param float scale: factor on all coordinates, for files in other units than metres
	:param shift: is added to all coordinates, after scale [m]: files in coordinates of a country lie far from the origin
	:returns: list of bodies, fixed unless *fixed* is False: two for each cell of the map, or one for each triangle
	:raises ValueError: naming the argument
	:raises FileNotFoundError: naming *heights* if there is no such file
	"""
	ofMesh = isinstance(heights, (str, os.PathLike))
	if ofMesh and spacing is not None:
		raise ValueError('spacing: is that of a height map; a mesh has its own points')
	factor, moved = positive(scale, 'scale'), np.array([*vector(shift, 'shift')], float)
	points, triangles = _ofMesh(heights) if ofMesh else _ofHeights(heights, spacing, origin)
	points = factor * points + moved
	extent = float(np.ptp(points[:, :2], axis=0).max())
	base = points[triangles][:, :, 2].min() - (thicknessFraction * extent if depth is None else positive(depth, 'depth'))
	pieces = ofOneColour({'fixed': True, **body})
	made = []
	for corners in points[triangles]:
		below = np.column_stack([corners[:, :2], np.full(3, base)])
		made.append(fromVertices(np.vstack([corners, below]).tolist(), **pieces))
	return made


def _ofMesh(path):
	"""Points and triangles of the surface of a mesh that is seen from above."""
	mesh = readMesh(path, 'heights')
	points, triangles = mesh.points, mesh.triangles
	edges = np.linalg.norm(points[triangles[:, 0]] - points[triangles[:, 1]], axis=1)
	if len(edges):
		warnOfRounding(path, 'heights', points, float(np.median(edges)), 'the usual length of an edge')
	edges = np.stack([points[triangles[:, (k + 1) % 3]] - points[triangles[:, k]] for k in range(3)], axis=1)
	area = _cross(edges[:, 0], edges[:, 1]) / 2
	seen = abs(area) > flat * (edges**2).sum(axis=2).max(axis=1, initial=0)
	if not seen.any():
		raise ValueError('heights: the mesh has no triangle that is not vertical')
	seen &= _looksUp(points, triangles)
	_refuseOverhang(points, triangles[seen])
	return points, triangles[seen]


def _looksUp(points, triangles):
	"""Which triangles have the outside above them; all of them if the mesh is not closed."""
	import trimesh

	solid = trimesh.Trimesh(points, triangles)  # joins equal points, which files as STL repeat
	if not solid.is_watertight or len(solid.faces) != len(triangles):
		return np.full(len(triangles), True)
	trimesh.repair.fix_normals(solid)
	return solid.face_normals[:, 2] > 0


def _refuseOverhang(points, triangles):
	"""The middle of no triangle may lie above or below another one."""
	corners = points[triangles][:, :, :2]
	middles = corners.mean(axis=1)
	reach = np.linalg.norm(corners - middles[:, None], axis=2).max(axis=1)
	near = scipy.spatial.cKDTree(middles).query_ball_point(middles, reach)
	one = np.repeat(np.arange(len(near)), [len(some) for some in near])
	other = np.concatenate([np.array(some, int) for some in near])
	one, other = one[one != other], other[one != other]
	turns = [_cross(corners[one, (k + 1) % 3] - corners[one, k], middles[other] - corners[one, k]) for k in range(3)]
	margin = flat * reach[one] ** 2
	inside = np.all([turn > margin for turn in turns], axis=0) | np.all([turn < -margin for turn in turns], axis=0)
	if inside.any():
		place = ', '.join(f'{x:.4g}' for x in middles[other[inside]][0])
		raise ValueError(f'heights: the mesh hangs over, or is there twice, at (x, y) = ({place}); polytope.facets(path) takes any surface')


def _cross(one, other):
	"""The z component, from x and y alone."""
	return one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]


def _ofHeights(heights, spacing, origin):
	"""Points and triangles of a height map."""
	try:
		values = np.array(heights, float)
	except (TypeError, ValueError):
		values = np.empty(0)
	if values.ndim != 2 or min(values.shape) < 2 or not np.isfinite(values).all():
		raise ValueError('heights: must be rows of finite heights, at least 2 × 2, or the path of a mesh file')
	spacing, origin = positive(spacing, 'spacing'), rows([origin], 'origin', 2)[0]
	n, m = values.shape
	x, y = np.meshgrid(float(origin[0]) + spacing * np.arange(n), float(origin[1]) + spacing * np.arange(m), indexing='ij')
	first = (np.arange(n - 1)[:, None] * m + np.arange(m - 1)).ravel()
	triangles = np.concatenate([np.column_stack([first, first + m, first + 1]), np.column_stack([first + m, first + m + 1, first + 1])])
	return np.column_stack([x.ravel(), y.ravel(), values.ravel()]), triangles
