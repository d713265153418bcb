# SPDX-License-Identifier: GPL-2.0-or-later
"""The bodies of which the surface of a mesh consists: pieces that are closed by themselves, though they may share corners, edges and faces.

A mesh is looked at about its middle and in units of its extent: merged points, volumes and hulls are then the same wherever it is and
whatever its unit.
"""

import dataclasses

import numpy as np
import scipy.sparse.csgraph
import scipy.spatial

__all__ = ['Piece', 'piecesOf']

fullTurn = 2 * np.pi
sameDirection = 1e-9
"""Angle [rad] between triangles at an edge up to which they lie on each other."""


@dataclasses.dataclass
class Piece:
	triangles: np.ndarray
	"""numbers of the mesh's triangles"""
	closed: bool
	volume: float
	"""Volume that it encloses, in the file's units; without meaning for a mesh that is not closed"""
	hull: float
	"""volume of its convex hull; 0 where it is flat"""


def piecesOf(mesh):
	"""Bodies in the order of their first triangles: the closed pieces of each object of the file, and what is left of it, by what hangs together.

	A closed piece within another one and turned inside out is a hole, and belongs to that one.

	Where objects of the file are closed only together, as parts of one surface are that differ in their material, they count as one.

	:param mesh: files.Mesh
	"""
	import trimesh

	if not len(mesh.triangles):
		return []
	low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
	unit = float((high - low).max()) or 1.0
	whole = trimesh.Trimesh((mesh.points - (low + high) / 2) / unit, mesh.triangles)  # joins equal points: STL has three for each triangle
	pieces = _pieces(whole, _labels(mesh.triangles, mesh.objects, whole))
	if mesh.objects.any() and not all(piece.closed for piece in pieces):
		together = _pieces(whole, _labels(mesh.triangles, np.zeros_like(mesh.objects), whole))
		if all(piece.closed for piece in together):
			pieces = together
	return [dataclasses.replace(one, volume=abs(one.volume) * unit**3, hull=one.hull * unit**3) for one in _withHoles(whole, pieces)]


def _pieces(whole, labels):
	order = np.argsort(labels, kind='stable')
	groups = np.split(order, np.flatnonzero(np.diff(labels[order])) + 1)
	return [_piece(whole, group) for group in groups if labels[group[0]] >= 0]


def _labels(triangles, objects, whole):
	"""Number of the piece of each triangle; −1 for those without an area, which bound nothing."""
	faces, labels, number = np.asarray(whole.faces), np.full(len(triangles), -1), 0
	sound = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
	for label in np.unique(objects):
		own = np.flatnonzero((objects == label) & sound)
		rest = []
		# what shares points of the file and is closed is a body, though another one has points in the same places
		for part in _components(triangles[own]):
			edges, counts = np.unique(_edges(faces[own[part]]), axis=0, return_counts=True)
			if (counts == 2).all():
				for group in _bySides(whole.vertices, faces[own[part]]):
					labels[own[part][group]], number = number, number + 1
			else:
				rest.append(own[part])
		if rest:
			rest = np.concatenate(rest)
			for part in _bySides(whole.vertices, faces[rest]):
				labels[rest[part]], number = number, number + 1
	return _inOrder(labels)


def _inOrder(labels):
	"""Labels numbered in the order in which they first come."""
	found, first = np.unique(labels[labels >= 0], return_index=True)
	new = np.empty(len(found), int)
	new[np.argsort(first)] = np.arange(len(found))
	labels[labels >= 0] = new[labels[labels >= 0]]
	return labels


def _edges(faces):
	"""Edges of triangles, each with its smaller point first: three for each triangle."""
	return np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)


def _grouped(count, one, other):
	"""Groups of what links from *one* to *other* join, as lists of numbers below *count*."""
	links = scipy.sparse.coo_matrix((np.ones(len(one)), (one, other)), (count, count))
	labels = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
	order = np.argsort(labels, kind='stable')
	return np.split(order, np.flatnonzero(np.diff(labels[order])) + 1) if count else []


def _components(triangles):
	"""Groups of triangles that hang together by points."""
	_, corners = np.unique(triangles, return_inverse=True)
	corners = corners.reshape(-1, 3)
	count = len(triangles)
	nodes = count + corners.max(initial=-1) + 1
	groups = _grouped(nodes, np.repeat(np.arange(count), 3), count + corners.ravel())
	return [group[group < count] for group in groups]


def _bySides(points, faces):
	"""Groups of triangles that bound the same piece of space.

	Where more than two triangles meet at an edge, each goes on in the one that comes next when it is turned about the edge through what it
	bounds. Closed groups are kept; what else hangs together by points is one group.
	"""
	edges = _edges(faces)
	order = np.lexsort((edges[:, 1], edges[:, 0]))
	starts = np.flatnonzero(np.r_[True, (np.diff(edges[order], axis=0) != 0).any(axis=1)])
	counts = np.diff(np.r_[starts, len(order)])
	two = starts[counts == 2]
	pairs, open_ = [np.column_stack([order[two], order[two + 1]])], np.zeros(len(faces), bool)
	a, b, c = (points[faces[:, k]] - points[faces].mean(axis=(0, 1)) for k in range(3))
	turned = float((np.cross(a, b) * c).sum()) < 0  # all normals point inwards
	for start, count in zip(starts[counts != 2], counts[counts != 2], strict=True):
		meeting = order[start : start + count]
		found = _partners(points, faces, meeting, turned)
		if found:
			pairs.append(np.array(found))
		else:
			open_[meeting // 3] = True
	pairs = np.concatenate(pairs) // 3
	groups, left = [], []
	for group in _grouped(len(faces), pairs[:, 0], pairs[:, 1]):
		(left if open_[group].any() else groups).append(group)
	if left:
		left = np.concatenate(left)
		groups += [left[part] for part in _components(faces[left])]
	return groups


def _partners(points, faces, meeting, turned):
	"""Pairs of the sides (three times the triangle plus the number of its edge) that meet at one edge and bound the same space; [] if they
	do not fit."""
	if len(meeting) % 2:
		return []
	triangles, own = faces[meeting // 3], meeting % 3
	begin, end, third = (triangles[np.arange(len(meeting)), (own + k) % 3] for k in range(3))
	forward = begin < end
	if forward.sum() * 2 != len(meeting):
		return []
	low = min(begin[0], end[0])
	axis = points[max(begin[0], end[0])] - points[low]
	axis = axis / np.linalg.norm(axis)
	arms = points[third] - points[low]
	arms = arms - np.outer(arms @ axis, axis)
	first = arms[0] / np.linalg.norm(arms[0])
	angles = np.arctan2(arms @ np.cross(axis, first), arms @ first)
	pairs = []
	for k in np.flatnonzero(forward):
		# the normal of a triangle that runs with the axis points to where angles grow, and what it bounds lies on the other side
		turn = (angles[~forward] - angles[k] if turned else angles[k] - angles[~forward]) % fullTurn
		turn[(turn < sameDirection) | (turn > fullTurn - sameDirection)] = fullTurn
		pairs.append((meeting[k], meeting[np.flatnonzero(~forward)[np.argmin(turn)]]))
	return pairs if len({other for _, other in pairs}) == len(pairs) else []


def _piece(whole, triangles):
	used, faces = np.unique(whole.faces[triangles], return_inverse=True)
	faces = faces.reshape(-1, 3)
	points = whole.vertices[used]
	points = points - points.mean(axis=0)  # sums are small about it
	_, edge, counts = np.unique(_edges(faces), axis=0, return_inverse=True, return_counts=True)
	closed = bool((counts % 2 == 0).all())
	ways = np.where(faces < np.roll(faces, -1, axis=1), 1, -1).ravel()  # along each edge, from its smaller point or back
	if closed and np.bincount(edge.ravel(), weights=ways).any():
		faces = _sameWinding(points, faces)
	a, b, c = (points[faces[:, k]] for k in range(3))
	try:
		hull = float(scipy.spatial.ConvexHull(points).volume)
	except scipy.spatial.QhullError:  # points in a plane
		hull = 0.0
	return Piece(triangles, closed, float((np.cross(a, b) * c).sum()) / 6, hull)


def _sameWinding(points, faces):
	"""Triangles, some of them turned round, so that neighbours have their normals on the same side."""
	import trimesh

	mesh = trimesh.Trimesh(points, faces, process=False)
	trimesh.repair.fix_winding(mesh)
	return np.asarray(mesh.faces)


def _withHoles(whole, pieces):
	"""Pieces with their holes."""
	if len({piece.volume < 0 for piece in pieces if piece.closed}) < 2:
		return pieces
	boxes = []
	for piece in pieces:
		points = whole.vertices[np.unique(whole.faces[piece.triangles])]
		boxes.append((points.min(axis=0), points.max(axis=0)))
	holes = {}
	for k in sorted(range(len(pieces)), key=lambda k: -abs(pieces[k].volume)):
		(low, high), others = boxes[k], (j for j in range(len(pieces)) if j not in holes and pieces[k].closed and pieces[j].closed)
		outer = [j for j in others if pieces[k].volume * pieces[j].volume < 0 and (boxes[j][0] < low).all() and (high < boxes[j][1]).all()]
		if outer:
			holes[k] = min(outer, key=lambda j: abs(pieces[j].volume))
	found = []
	for k in range(len(pieces)):
		if k in holes:
			continue
		inside = [pieces[j] for j, outer in holes.items() if outer == k]
		triangles = np.concatenate([pieces[k].triangles, *(one.triangles for one in inside)])
		volume = abs(pieces[k].volume) - sum(abs(one.volume) for one in inside)
		found.append(dataclasses.replace(pieces[k], triangles=triangles, volume=volume))
	return found
