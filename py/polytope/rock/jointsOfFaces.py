# SPDX-License-Identifier: GPL-2.0-or-later
"""Which joint made each face of a rock's bodies, and each contact between them: for pictures, ParaView and arrays."""

import math
import os
import weakref

import numpy as np
from yade import O, Polytope

from ..bodies.halfSpaces import worldPlanes
from ..measures.arrays import arrays
from ..pictures.faceColors import ofFaces
from ..pictures.faces import collect
from ..scene.vertices import rows
from .faceMaterials import facesThatCount, facing

__all__ = ['contactJoints', 'jointsOfFaces', 'jointsOfPlanes', 'keep', 'replaceInRocks', 'setsOf', 'writeFaces']

turnOfFaces = 0.1
"""Angle [rad] by which planes of a body may differ from those that it was appended with: *inSitu* turns them by the closure of a joint
over its width. Another body under the same number, of another scene, has others."""

_rocks = []
"""Weak references to rocks that are in the scene, or were."""


def keep(rock, placed):
	"""What *JointedRock.placed* is from now on."""
	rock.placed = placed
	_rocks[:] = [known for known in _rocks if known() not in (None, rock)] + [weakref.ref(rock)]


def replaceInRocks(body, pieces, planes):
	"""A body of the scene has been broken: what is left of its faces keeps its joint.

	:param planes: for each piece, for each plane of its shape the body's that it lies on, −1: none
	"""
	for rock in filter(None, (known() for known in _rocks)):
		joints = np.append(jointsOfFaces(rock, body), -1)
		if (joints >= 0).any():
			rock.placed.update((piece.id, (rows(piece.shape.normals), joints[own])) for piece, own in zip(pieces, planes, strict=True))


def jointsOfPlanes(body, normals, joints):
	"""For each plane of the body's shape the number of the joint that made it.

	:param normals: of the block, in world axes; of a polygon two components
	:param joints: for each of these the number of its joint
	"""
	own = worldPlanes(body)[0][:, : normals.shape[1]]
	return joints[np.argmax(own @ (normals / np.linalg.norm(normals, axis=1, keepdims=True)).T, axis=1)]


def jointsOfFaces(rock, body):
	"""See *JointedRock.jointsOfFaces*."""
	planes = rows(body.shape.normals) if isinstance(body.shape, Polytope) else np.empty((0, 3))
	normals, joints = rock.placed.get(body.id, (None, None))
	if joints is None or len(joints) != len(planes) or ((normals * planes).sum(axis=1) < math.cos(turnOfFaces)).any():
		return np.full(len(planes), -1)
	return joints.copy()


def setsOf(rock, joints):
	"""The set of each of these joints; −1 of −1."""
	return np.append(rock.sets, -1)[joints]


def contactJoints(rock):
	"""See *JointedRock.contactJoints*."""
	contacts, known = arrays().contacts, {}
	found = np.full(len(contacts.ids), -1)
	for row, (ids, normal) in enumerate(zip(contacts.ids.tolist(), contacts.normals, strict=True)):
		(one, cosine1), (two, cosine2) = (_facing(rock, id, side * normal, known) for id, side in zip(ids, (1, -1), strict=True))
		counts1, counts2 = facesThatCount(cosine1, cosine2)
		found[row] = one if counts1 and (one >= 0 or not counts2) else two
	return found


def _facing(rock, id, normal, known):
	"""(joint, cosine of the angle to this normal) of the body's face that looks there most; −1 of a body that is none of the rock's."""
	if id not in known:
		body = O.bodies[id]
		joints = jointsOfFaces(rock, body) if body is not None and body.shape else np.empty(0, int)
		known[id] = joints, worldPlanes(body)[0] if len(joints) else None
	joints, normals = known[id]
	if not len(joints) or not np.isfinite(normal).all():
		return -1, -1.0
	plane, cosine = facing(normals, normal)
	return int(joints[plane]), cosine


def writeFaces(rock, path):
	"""See *JointedRock.writeFaces*."""
	from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
	from vtkmodules.vtkCommonCore import vtkPoints
	from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
	from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

	path = os.path.abspath(os.fspath(path))
	if os.path.splitext(path)[1] != '.vtp':
		raise ValueError(f'path: faces are polygons of VTK, whose files end in .vtp, got {path!r}')
	bodies = [body for body in O.bodies if body and isinstance(body.shape, Polytope)]
	if not bodies:
		raise ValueError('O.bodies: there is no Polytope to write; append() the rock first')
	mesh = collect(bodies)['solid']
	points, faces, data = vtkPoints(), vtkCellArray(), vtkPolyData()
	points.SetData(numpy_to_vtk(mesh['points'], deep=True))
	faces.SetData(*(numpy_to_vtkIdTypeArray(mesh[name].astype(np.int64), deep=True) for name in ('offsets', 'connectivity')))
	data.SetPoints(points)
	data.SetPolys(faces)
	for name, values in _columns(rock, bodies, mesh['ids']).items():
		column = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
		column.SetName(name)
		data.GetCellData().AddArray(column)
	os.makedirs(os.path.dirname(path), exist_ok=True)
	writer = vtkXMLPolyDataWriter()
	writer.SetFileName(path)
	writer.SetInputData(data)
	if not writer.Write():
		raise OSError(f'path: cannot write {path}')


def _columns(rock, bodies, ids):
	"""A value for each face, by name."""
	joints = np.concatenate([ofFaces(body.shape, jointsOfFaces(rock, body)) for body in bodies])
	materials = np.concatenate([ofFaces(body.shape, np.array(body.shape.faceMaterials, int)) for body in bodies])
	row = {body.id: k for k, body in enumerate(bodies)}
	body = np.array([row[id] for id in ids.tolist()])
	own = np.array([one.material.id for one in bodies])
	moved, speeds = (rows(vectors) for vectors in zip(*((one.state.pos - one.state.refPos, one.state.vel) for one in bodies), strict=True))
	return {
		'id': ids.astype(np.int32),
		'joint': joints.astype(np.int32),
		'set': setsOf(rock, joints).astype(np.int32),
		'material': np.where(materials < 0, own[body], materials).astype(np.int32),
		'displacement': moved[body],
		'velocity': speeds[body],
	}
