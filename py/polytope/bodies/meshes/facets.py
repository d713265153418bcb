# SPDX-License-Identifier: GPL-2.0-or-later
"""Containers and ground from mesh files, as facets of YADE's: `polytope.facets(…)`."""

import numpy as np
from yade import Vector3

from ...arguments import positive, vector, warn
from ..polytopes import builder, ofOneColour
from ..yadeShapes import facetOf
from .digits import warnOfRounding
from .files import readMesh

__all__ = ['facets', 'haveAreas']

flat = 1e-9
"""Twice the area of a triangle over the square of its longest edge below which it has none."""


@builder(lacks=('center', 'orientation', 'cornerRadius', 'velocity', 'angularVelocity'))
def facets(path, scale=1.0, shift=(0, 0, 0), **body):
	"""The triangles of a mesh file as YADE's facets: a funnel, cup or drum as a program for drawing writes it, or ground.

	``ids = O.bodies.append(polytope.facets('funnel.stl', scale=1e-3))``. Bodies may be on both sides. The mesh need not be closed or
	convex. To move it, give *ids* to an engine (``RotationEngine(ids=ids, …)``).

	:param path: the file, of any format that fromMesh reads
	:param float scale: factor on all coordinates, for files in other units than metres
	:param shift: is added to all coordinates, after scale [m]
	:returns: list of bodies, fixed unless *fixed* is False
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: naming *path* if the file cannot be read as a mesh or has no triangle with an area; naming *scale* or *shift*
	"""
	factor, moved = positive(scale, 'scale'), vector(shift, 'shift')
	mesh = readMesh(path, 'path')
	corners = mesh.points[mesh.triangles]
	solid = haveAreas(corners)
	if not solid.any():
		raise ValueError(f"path: '{path}' has no triangle with an area")
	if not solid.all():
		warn(f"path: {(~solid).sum()} of the {len(solid)} triangles of '{path}' have no area and are left out")
	warnOfRounding(
		path, 'path', mesh.points, float(np.median(np.linalg.norm(_edges(corners[solid]), axis=2))), 'the usual length of an edge'
	)
	places = [factor * Vector3(*point) + moved for point in mesh.points.tolist()]
	pieces = ofOneColour(body)
	return [facetOf([places[k] for k in three], **pieces) for three in mesh.triangles[solid].tolist()]


def haveAreas(corners):
	"""Which of these triangles (n, 3, 3) have an area."""
	edges = _edges(corners)
	return np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) > flat * (edges**2).sum(axis=2).max(axis=1, initial=0)


def _edges(corners):
	return corners - np.roll(corners, 1, axis=1)
