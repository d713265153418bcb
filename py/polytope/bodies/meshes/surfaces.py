# SPDX-License-Identifier: GPL-2.0-or-later
"""Readers of surfaces. Each returns (points (n, 3), triangles (m, 3), number of the object of each triangle)."""

import locale
import os

import numpy as np

__all__ = ['readByTrimesh', 'readGts', 'readObj', 'readSmesh', 'readVtk']


def _joined(parts):
	"""Several (points, triangles), each an object."""
	points = [np.asarray(points, float).reshape(-1, 3) for points, _ in parts]
	triangles = [np.asarray(corners, int).reshape(-1, 3) for _, corners in parts]
	starts = np.cumsum([0, *(len(one) for one in points)])
	return (
		np.concatenate(points),
		np.concatenate([corners + start for corners, start in zip(triangles, starts, strict=False)]),
		np.repeat(np.arange(len(parts)), [len(corners) for corners in triangles]),
	)


def readByTrimesh(path):
	import trimesh

	loaded = trimesh.load(path, process=False)
	several = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
	parts = [(one.vertices, getattr(one, 'faces', ())) for one in several if hasattr(one, 'vertices')]
	return _joined(parts or [((), ())])


def readObj(path):
	"""Reads an OBJ file with its lines ``o``, which trimesh does not keep apart from those of materials."""
	points, triangles, objects, present = [], [], [], 0
	with open(path, encoding='utf-8', errors='replace') as file:
		lines = file.read().replace('\\\n', ' ').splitlines()
	for number, line in enumerate(lines, 1):
		words = line.split() or ['']
		try:
			if words[0] == 'v':
				points.append((float(words[1]), float(words[2]), float(words[3])))
			elif words[0] == 'o':
				present += 1
			elif words[0] == 'f':
				corners = [int(word.split('/', 1)[0]) for word in words[1:]]
				# counted from 1, or back from the last point
				corners = [k - 1 if k > 0 else len(points) + k if k < 0 else -1 for k in corners]
				triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
				objects += [present] * (len(corners) - 2)
		except (ValueError, IndexError):
			raise ValueError(f'line {number}: {line.strip()[:60]!r} is no vertex or face') from None
	return np.array(points, float).reshape(-1, 3), np.array(triangles, int).reshape(-1, 3), np.array(objects, int)


def _words(path, *comments):
	"""Words of each line that has any, without comments, which begin with one of these signs."""
	found = []
	with open(path, encoding='utf-8', errors='replace') as file:
		for line in file:
			for sign in comments:
				line = line.split(sign, 1)[0]
			if words := line.split():
				found.append(words)
	return found


def readSmesh(path):
	"""Facets of TetGen: points, then polygons by their corners."""
	lines = _words(path, '#')
	try:
		count = int(lines[0][0])
		if count == 0:
			raise ValueError('its points are in a file .node; give the file .ele of its tetrahedra')
		points = [[float(word) for word in words[1:4]] for words in lines[1 : 1 + count]]
		first, facets = int(lines[1][0]), int(lines[1 + count][0])
		triangles = []
		for words in lines[2 + count : 2 + count + facets]:
			corners = [int(word) - first for word in words[1 : 1 + int(words[0])]]
			triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
	except IndexError:
		raise ValueError('it ends before its points and facets do') from None
	return _joined([(points, triangles)])


def readGts(path):
	"""Reads a file of the GNU Triangulated Surface library: points, edges, triangles by their edges. (YADE's module gts leaves the process
	in another locale.)"""
	lines = _words(path, '#', '!')
	try:
		count, edges, faces = map(int, lines[0][:3])
		points = [[float(word) for word in words[:3]] for words in lines[1 : 1 + count]]
		ends = np.array([[int(word) for word in words[:2]] for words in lines[1 + count : 1 + count + edges]]) - 1
		sides = np.array([[int(word) for word in words[:3]] for words in lines[1 + count + edges : 1 + count + edges + faces]]) - 1
		if (len(points), len(ends), len(sides)) != (count, edges, faces) or (sides < 0).any() or (sides >= edges).any():
			raise IndexError
		triangles = []
		for one, two in ends[sides[:, :2]]:
			middle = one[0] if one[0] in two else one[1]
			triangles.append((one[one != middle][0], middle, two[two != middle][0]))
	except IndexError:
		raise ValueError('it ends before its points, edges and triangles do') from None
	return _joined([(points, triangles)])


def readVtk(path):
	from vtkmodules.util.numpy_support import vtk_to_numpy
	from vtkmodules.vtkFiltersCore import vtkTriangleFilter
	from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
	from vtkmodules.vtkIOLegacy import vtkDataSetReader
	from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader

	reader, said = vtkDataSetReader() if os.path.splitext(path)[1].lower() == '.vtk' else vtkXMLGenericDataObjectReader(), []
	surface, triangles = vtkGeometryFilter(), vtkTriangleFilter()
	for one in (reader, surface, triangles):
		one.AddObserver('ErrorEvent', lambda *_: said.append('its content is not as VTK expects it'))
	reader.SetFileName(path)
	before = locale.setlocale(locale.LC_ALL)
	try:
		reader.Update()
	finally:
		locale.setlocale(locale.LC_ALL, before)  # its reader of legacy files leaves the process in another one
	if said or reader.GetOutput() is None:
		raise ValueError(said[0] if said else 'it is of no kind that VTK knows')
	surface.SetInputConnection(reader.GetOutputPort())
	triangles.SetInputConnection(surface.GetOutputPort())
	triangles.PassVertsOff()
	triangles.PassLinesOff()
	triangles.Update()
	found = triangles.GetOutput()
	if found.GetNumberOfPoints() == 0:
		return _joined([((), ())])
	corners = vtk_to_numpy(found.GetPolys().GetConnectivityArray()) if found.GetNumberOfPolys() else ()
	return _joined([(vtk_to_numpy(found.GetPoints().GetData()), corners)])
