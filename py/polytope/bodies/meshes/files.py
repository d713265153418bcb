# SPDX-License-Identifier: GPL-2.0-or-later
"""Surfaces from mesh files: points, triangles, and the object of the file to which each triangle belongs.

Read by trimesh (STL, PLY, OFF, GLB, 3MF …), meshio (Gmsh, TetGen, Abaqus …) and VTK (its own formats), which are loaded when a file needs them. Of
a mesh of volumes (tetrahedra, hexahedra …) the surface is taken.
"""

import dataclasses
import os

import numpy as np

from ...arguments import pathOfFile
from .cells import readByMeshio
from .surfaces import readByTrimesh, readGts, readObj, readSmesh, readVtk

__all__ = ['Mesh', 'isMeshFile', 'readMesh']

readers = {
	**dict.fromkeys(('.stl', '.stl_ascii', '.ply', '.off', '.glb', '.gltf', '.3mf', '.dae', '.xyz'), readByTrimesh),
	'.obj': readObj,
	'.gts': readGts,
	'.smesh': readSmesh,
	**dict.fromkeys(('.vtk', '.vtp', '.vtu', '.vtr', '.vts', '.vti'), readVtk),
	**dict.fromkeys(('.msh', '.ele', '.node', '.inp', '.mesh', '.meshb', '.med', '.bdf', '.nas', '.fem'), readByMeshio),
	**dict.fromkeys(('.vol', '.e', '.exo', '.xdmf', '.avs', '.ugrid', '.su2', '.f3grid', '.dat', '.tec'), readByMeshio),
}
"""Readers by the ends of file names; trimesh may know others."""
textOfOthers = {'.tess': 'a tessellation of Neper', '.shp': 'a library of Rockable'}
"""Files that readShapes reads."""


@dataclasses.dataclass
class Mesh:
	points: np.ndarray
	"""(n, 3), in the file's units; those of its triangles, or all where it has none"""
	triangles: np.ndarray
	"""(m, 3) numbers of points"""
	objects: np.ndarray
	"""m numbers, of the object of each triangle; 0 for all where the file names none or one"""


def isMeshFile(path):
	"""Whether its name ends as that of a mesh."""
	return _suffix(path) in readers


def readMesh(path, name):
	"""The surface of a mesh file; refuses as fromMesh() does.

	:param str name: of the argument
	"""
	path = pathOfFile(path, name)
	suffix = _suffix(path)
	if suffix in textOfOthers:
		raise ValueError(f"{name}: '{path}' is {textOfOthers[suffix]}, no mesh; polytope.readShapes reads it")
	try:
		points, triangles, objects = readers.get(suffix, readByTrimesh)(path)
	except Exception as error:  # readers pass on what they meet
		missing = isinstance(error, ImportError) and error.name
		said = f'it needs the Python module {error.name}, which is not installed' if missing else f'{error}' or type(error).__name__
		if missing == 'chardet':  # with which trimesh guesses how text is written
			said = 'it is neither binary nor text of its format; it may end early'
		elif suffix not in readers:
			said = f"{said}; its name may end in {', '.join(sorted(readers))}"
		raise ValueError(f"{name}: '{path}' cannot be read as a mesh ({said})") from error
	if len(points) == 0:
		raise ValueError(f"{name}: '{path}' has no vertices; its content may not be of the format that its name indicates")
	if len(triangles) and not 0 <= triangles.min() <= triangles.max() < len(points):
		raise ValueError(f"{name}: '{path}' cannot be read as a mesh (a triangle has a vertex that is not there; there are {len(points)})")
	if not np.isfinite(points).all():
		raise ValueError(f"{name}: '{path}' has a vertex that is not finite")
	if len(triangles):
		used, triangles = np.unique(triangles, return_inverse=True)  # others may be centres of arcs, or left over
		points, triangles = points[used], triangles.reshape(-1, 3)
	return Mesh(points, triangles, np.unique(objects, return_inverse=True)[1])


def _suffix(path):
	return os.path.splitext(path)[1].lower()
