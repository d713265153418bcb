# SPDX-License-Identifier: GPL-2.0-or-later
"""Faces of many bodies with their colours as arrays, for pictures."""

import math

import numpy as np
from yade import Sphere, Wall

from ..scene.vertices import localFaces, mostRings, placeOf, quaternionOf, reachOfWalls, rows, turned, unturned, wallFaces
from .rims import withRims

__all__ = ['collect']

fewestRings = 4
"""Least number of rings of faces between the poles of a sphere that is drawn; the most are scene.vertices.mostRings."""
mostSphereFaces = 2_500_000
"""Faces of all spheres together, above which they get fewer rings: so many are each a few pixels large."""


def collect(bodies, colorOf=lambda body: body.shape.color, styleOf=lambda body: 'solid'):
	"""The bodies' faces in world coordinates, as arrays.

	:param colorOf: function of a body: RGB in 0…1, or an array (faces, 3) with that of each face; of a polygon each side's is seen along it
	    on the caps
	:param styleOf: function of a body: any word; bodies of the same word come together, 'hidden' ones not at all
	:returns: dictionary style → {points (n, 3), offsets (faces + 1), connectivity, colors (faces, 3) bytes, ids (faces)};
	    spheres are of the style 'smooth'
	"""
	parts, room = {}, reachOfWalls(bodies)
	rings = _rings(sum(isinstance(body.shape, Sphere) for body in bodies))
	for body in bodies:
		style = styleOf(body)
		if style == 'hidden':
			continue
		faces = wallFaces(body, room) if isinstance(body.shape, Wall) else localFaces(body.shape, rings)
		if len(faces[1]) == 0:
			continue
		turn, color = quaternionOf(body), colorOf(body)
		if isinstance(body.shape, Sphere):
			style, turn = 'smooth', unturned
		if np.ndim(color) == 2 and getattr(body.shape, 'dimension', 3) == 2:
			*faces, color = withRims(*faces, color)
		parts.setdefault(style, []).append((*faces, placeOf(body), turn, color, body.id))
	return {style: _joined(*zip(*several, strict=True)) for style, several in parts.items()}


def _joined(vertices, counts, corners, places, quaternions, colors, ids):
	"""Arrays of all bodies together, from lists with one entry for each body."""
	own = [len(one) for one in vertices]
	first = np.cumsum([0, *own[:-1]])
	points = turned(np.concatenate(vertices), np.repeat(np.array(quaternions), own, axis=0))
	faces = [len(one) for one in counts]
	return {
		'points': points + np.repeat(np.array(places), own, axis=0),
		'offsets': np.concatenate([[0], np.cumsum(np.concatenate(counts))]),
		'connectivity': np.concatenate(corners) + np.repeat(first, [len(one) for one in corners]),
		'colors': np.round(255 * np.clip(_ofFaces(colors, faces), 0, 1)).astype(np.uint8),
		'ids': np.repeat(ids, faces),
	}


def _ofFaces(colors, faces):
	"""RGB of each face, from those of bodies with so many faces."""
	if not any(isinstance(color, np.ndarray) and color.ndim == 2 for color in colors):
		return np.repeat(rows(colors), faces, axis=0)
	return np.concatenate([np.broadcast_to(np.array(color, float), (count, 3)) for color, count in zip(colors, faces, strict=True)])


def _rings(spheres):
	"""How many each of so many spheres has."""
	return int(min(mostRings, max(fewestRings, math.sqrt(mostSphereFaces / (2 * spheres))))) if spheres else mostRings
