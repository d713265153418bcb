# SPDX-License-Identifier: GPL-2.0-or-later
"""Surfaces of meshes of cells (tetrahedra, hexahedra, quadrangles …) that meshio reads: Gmsh, TetGen, Abaqus, Medit …"""

import contextlib
import io

import numpy as np

__all__ = ['readByMeshio']

volumeTags = 'gmsh:geometrical', 'medit:ref', 'tetgen:ref', 'cell_tags'
"""Where meshio keeps the number of the volume to which a cell belongs."""
faces = {
	'tetra': ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
	'pyramid': ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
	'wedge': ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
	'hexahedron': ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}
"""Faces of the cells of volumes, by their corners; cells of higher order have the same corners first."""
sides = {'triangle': 3, 'quad': 4}


def readByMeshio(path):
	"""(points, triangles, object of each triangle) of a file."""
	import meshio

	printed = io.StringIO()
	try:
		with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
			mesh = meshio.read(path)
	except SystemExit:  # by which meshio says that no reader of its fits
		raise ValueError(' '.join(printed.getvalue().split()) or 'its content is of no format that meshio knows') from None
	points = np.asarray(mesh.points, float)
	points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))]) if points.shape[1] < 3 else points
	return points, *_surface(mesh, points)


def _surface(mesh, points):
	"""(triangles, number of the object of each) of the volumes of a mesh, or of its surface where it has none."""
	tags = next(
		(mesh.cell_data[name] for name in volumeTags if name in mesh.cell_data), [np.zeros(len(block.data), int) for block in mesh.cells]
	)
	outer = []
	for block, tag in zip(mesh.cells, tags, strict=True):
		kind = next((kind for kind in faces if block.type.rstrip('0123456789') == kind), None)
		if kind:
			cells = np.asarray(block.data)
			corners = cells[:, sorted({k for face in faces[kind] for k in face})]
			middles = points[corners].mean(axis=1)
			outer += [(np.asarray(tag).ravel(), cells[:, face], middles) for face in faces[kind]]
	if outer:
		return _boundary(outer, points)
	triangles = []
	for block in mesh.cells:
		kind, cells = block.type.rstrip('0123456789'), np.asarray(block.data)
		if kind in sides or kind == 'polygon':
			triangles += [cells[:, [0, k, k + 1]] for k in range(1, sides.get(kind, cells.shape[1]) - 1)]
	triangles = np.concatenate(triangles) if triangles else np.empty((0, 3), int)
	return triangles, np.zeros(len(triangles), int)


def _boundary(outer, points):
	"""Faces of cells that no other cell of the same object has, as triangles with the cell behind them.

	:param outer: (objects, faces, middles of their cells) of faces with equal numbers of corners
	"""
	triangles, objects = [], []
	for corners in (3, 4):
		those = [one for one in outer if one[1].shape[1] == corners]
		if not those:
			continue
		tag, face, middle = (np.concatenate(one) for one in zip(*those, strict=True))
		_, first, count = np.unique(np.column_stack([tag, np.sort(face, axis=1)]), axis=0, return_index=True, return_counts=True)
		alone = first[count == 1]
		tag, face, middle = tag[alone], face[alone], middle[alone]
		a, b, c = (points[face[:, k]] for k in (0, 1, corners - 1))
		inward = (np.cross(b - a, c - a) * (a - middle)).sum(axis=1) < 0
		face[inward] = face[inward, ::-1]
		for k in range(1, corners - 1):
			triangles.append(face[:, [0, k, k + 1]])
			objects.append(tag)
	return np.concatenate(triangles), np.unique(np.concatenate(objects), return_inverse=True)[1]
