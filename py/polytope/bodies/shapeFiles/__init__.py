# SPDX-License-Identifier: GPL-2.0-or-later
"""Shapes from and to text files: YADE's own format for polyhedra, Neper's tessellations (.tess), Rockable's shapes (.shp), blocks of COMPAS
(.json)."""

import numbers
import os

from yade import O, Polytope, Vector3

from ...arguments import pathOfFile, pathOfNewFile, positive, vector
from ...scene.namedBodies import namedBodies
from ..meshes.files import isMeshFile
from ..polytopes import builder
from . import compas, neper, rockable, yadeText

__all__ = ['readShapes', 'writeShapes']

formats = {'.tess': neper.bodies, '.shp': rockable.bodies, '.json': compas.bodies}
"""Readers by the ends of file names; all others are YADE's text."""


@builder(lacks=('center', 'orientation'))
def readShapes(path, scale=1, shift=(0, 0, 0), names=None, parts=None, rounded=None, **body):
	"""Bodies of all shapes in a text file: ``O.bodies.append(polytope.readShapes('cells.tess', scale=1e-3))``.

	- ``.tess``: cells of a Neper tessellation, of its dimension 3 as polyhedra, 2 as polygons. Cells share faces exactly; empty ones, which Neper may
	  write, are left out.
	- ``.shp``: shapes of a Rockable library, convex hulls with faces moved out by the shape's radius, to where Rockable's faces are (edges,
	  there round, are sharp; *rounded* keeps them); a flat shape is a plate of twice that thickness. They lie where their vertices do. A
	  shape of one vertex is a sphere of YADE's; one that is marked as a surface, such as a container, a list of plates, one for each face;
	  rods and what else is no body are left out, with a warning that names them.
	- ``.json``: blocks of masonry from COMPAS (compas_assembly, compas_dem, compas_cra, or a list of meshes), convex hulls; supports are
	  *fixed*, unless that is given.
	- names of meshes (.stl, .obj, .msh …) are refused: fromMesh reads them.
	- any other name: polyhedra in YADE's text format, from writeShapes or from YADE's export.textPolyhedra, as convex hulls.

	What is not convex is warned of.

	:param path: the file
	:param float scale: factor on all coordinates, for files in other units than metres
	:param shift: is added to all coordinates, after scale [m]
	:param names: of a Rockable library, those to be read, in this order; default all
	:param int parts: of a Rockable library: number of convex parts at most into which CoACD cuts a shape that is not convex, as fromMesh
	    does. The list of its parts is then in its place in what is returned, for polytope.clump, cloud or pack
	:param rounded: of a Rockable library: a class derived from Polytope with the attribute *radius*, as the RoundedPolytope of
	    docs/extending.md. Bodies keep the radius of their shape then: edges are round, volume and mass those of the sum with the ball. Plates
	    and spheres are as without it
	:returns: list of bodies, in the order of the file or of *names*
	:raises ImportError: if CoACD is needed and not installed
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: naming the argument, and for a malformed file the line and what is expected there
	"""
	path = pathOfFile(path, 'path')
	scale = positive(scale, 'scale')
	if isMeshFile(path):
		raise ValueError(f"path: '{path}' is a mesh; polytope.fromMesh reads it, with parts='objects' all bodies of a file")
	suffix = os.path.splitext(path)[1].lower()
	if names is not None and suffix != '.shp':
		raise ValueError('names: only shapes of a Rockable library (.shp) have names')
	if parts is not None and suffix != '.shp':
		raise ValueError('parts: only shapes of a Rockable library (.shp) are cut into parts; of a mesh, fromMesh makes them')
	if parts is not None and (isinstance(parts, bool) or not isinstance(parts, numbers.Integral) or parts < 1):
		raise ValueError(f'parts: must be a number of parts above 0, got {parts!r}')
	if rounded is not None and suffix != '.shp':
		raise ValueError('rounded: only shapes of a Rockable library (.shp) have a radius')
	if rounded is not None and not (isinstance(rounded, type) and issubclass(rounded, Polytope) and hasattr(rounded, 'radius')):
		raise ValueError(f'rounded: must be a class derived from Polytope with the attribute radius, got {rounded!r}')
	if rounded is not None:
		body['rounded'] = rounded
	if parts is not None:
		body['parts'] = int(parts)
	if names is not None:
		body['names'] = [names] if isinstance(names, str) else list(names)
	moved = vector(shift, 'shift')
	return formats.get(suffix, yadeText.bodies)(path, lambda point: scale * Vector3(*point) + moved, **body)


def writeShapes(path, ids=None):
	"""Writes polyhedra with vertices and faces where they are now, in YADE's text format: ``polytope.writeShapes('grains.txt')``.

	The format is that of YADE's export.textPolyhedra, which YADE's ymport.textPolyhedra and readShapes read. Numbers have all their digits.
	Of a body's planes only those that own a face are kept; material, colour and velocity are not (``O.save`` keeps everything).

	:param path: the file; its folder is made if there is none
	:param ids: of polyhedra; default all
	:returns: number of polyhedra written
	:raises ValueError: naming *ids* for a body that is not there or no polyhedron, *path* for a folder
	"""
	chosen = _polyhedra() if ids is None else namedBodies(ids)
	for k in chosen:
		shape = O.bodies[k].shape
		if not isinstance(shape, Polytope) or shape.dimension != 3:
			raise ValueError(f'ids: body {k} is no polyhedron')
	if not chosen:
		raise ValueError('ids: the scene has no polyhedron to write')
	return yadeText.write(pathOfNewFile(path, 'path'), [O.bodies[k] for k in chosen])


def _polyhedra():
	return [body.id for body in O.bodies if isinstance(body.shape, Polytope) and body.shape.dimension == 3]
