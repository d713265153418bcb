# SPDX-License-Identifier: GPL-2.0-or-later
"""From where a picture is taken: directions of view, and the camera that shows given points."""

import math
import numbers

import numpy as np

from ..scene.present import gravityOf

__all__ = ['against', 'cameraFor', 'fromTheFront', 'pixels', 'unit', 'viewAxes']

viewAngle = 24
"""Vertical opening of the camera [degrees]; small, so that bodies of equal size appear equal."""

centred = 1e-6
"""By how much the picture may be off its middle, over the distance of the camera: less than a hundredth of a pixel."""

alongUp = 1e-6
"""Sine of the angle between view and up below which up says nothing."""


largest = 20000
"""Pixels of a picture's edge."""


def pixels(size):
	"""(width, height) of a picture, checked."""
	try:
		width, height = size
	except (TypeError, ValueError):
		width = height = None
	if not all(isinstance(edge, numbers.Integral) and not isinstance(edge, bool) and 1 <= edge <= largest for edge in (width, height)):
		raise ValueError(f'size: must be (width, height), whole numbers of pixels from 1 to {largest}, got {size!r}')
	return int(width), int(height)


def viewAxes(view, up, flat):
	"""Unit vectors: towards the camera, and up in the picture."""
	for name, direction in ('view', view), ('up', up):
		if direction is not None and not 0 < np.linalg.norm(np.asarray(direction, float)) < np.inf:
			raise ValueError(f'{name}: must be a direction, finite and not zero, got {direction!r}')
	up = unit(up if up is not None else against(flat))
	view = unit(view if view is not None else (0, 0, 1) if flat else fromTheFront(up))
	if np.linalg.norm(np.cross(up, view)) < alongUp:
		up = np.eye(3)[(np.abs(view).argmax() + 1) % 3]  # seen from above
	return view, up


def against(flat):
	"""Direction against gravity; of scenes without gravity z, of polygons y."""
	gravity = np.array(gravityOf(), float) * ((1, 1, 0) if flat else 1)
	if gravity.any():
		return -gravity
	return (0, 1, 0) if flat else (0, 0, 1)


def fromTheFront(up):
	"""From the front, above and a little from the left, turned with *up* the shortest way from z."""
	view, z = np.array([-0.55, -1, 0.62]), np.array([0.0, 0, 1])
	axis, cosine = np.cross(z, up), up[2]
	if cosine < alongUp - 1:
		return view * (1, -1, -1)  # half a turn about x
	cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
	return view + cross @ view + cross @ cross @ view / (1 + cosine)


def cameraFor(points, view, up, aspect, zoom, flat, free):
	"""The camera in the direction *view* from the scene that shows all points, with a share of the height left *free* above them."""
	right = unit(np.cross(up, view))
	axes = np.array([right, np.cross(view, right), view])  # right, up, towards the camera
	local = points @ axes.T
	middle = (local.min(axis=0) + local.max(axis=0)) / 2
	margin = 1.04 / zoom
	if flat:
		extent = np.ptp(local, axis=0)
		height = margin * max(extent[1] / (1 - free), extent[0] / aspect, 1e-12)
		middle[1] += free * height / 2
		return _cameraAt(middle, extent[2] + height, axes, {'parallelScale': height / 2})
	slope = math.tan(math.radians(viewAngle / 2))
	reach = slope * np.array([aspect, 1 - free])
	for _ in range(20):  # perspective: nearer points reach farther out, so the middle moves with the distance
		seen = local - middle
		distance = max((margin * np.abs(seen[:, :2]) / reach + seen[:, 2:]).max(), 1e-12)
		inPicture = seen[:, :2] / (distance - seen[:, 2:])
		shift = distance * (inPicture.min(axis=0) + inPicture.max(axis=0)) / 2
		middle[:2] += shift
		if np.abs(shift).max() < centred * distance:
			break
	middle[1] += free * slope * distance
	return _cameraAt(middle, distance, axes, {'viewAngle': viewAngle})


def _cameraAt(middle, distance, axes, lens):
	focus = middle @ axes
	return {'focus': list(focus), 'position': list(focus + distance * axes[2]), 'up': list(axes[1]), **lens}


def unit(vector):
	vector = np.array(vector, float)
	return vector / np.linalg.norm(vector)
