# SPDX-License-Identifier: GPL-2.0-or-later
"""Two waters on one face, which would press on it with the sum of both."""

import numpy as np
from yade import O, PolytopeWater

__all__ = ['refuseTwice']


def refuseTwice(engine, faces, name):
	"""Joints have one water: where two calls meant the same faces, one of them is forgotten, such as the table before it rose.

	:param engine: the new PolytopeWater, not in O.engines yet
	:param faces: [(Face, its corners), …] which it presses on
	:param name: argument to name
	:raises ValueError: if another one presses at the same place of a face: at a corner, at the middle of an edge or of the face
	"""
	for other in O.engines:
		if not isinstance(other, PolytopeWater) or other.dead:
			continue
		its = set(zip(other.wetBodies, other.wetPlanes, strict=True)) if other.someFaces else None
		common = [(face, corners) for face, corners in faces if its is None or (face.body, face.plane) in its]
		if not common:
			continue
		places = [
			np.concatenate([corners, (corners + np.roll(corners, 1, axis=0)) / 2, corners.mean(axis=0)[None]]) for _, corners in common
		]
		both = (_pressures(engine, np.concatenate(places)) > 0) & (_pressures(other, np.concatenate(places)) > 0)
		pressed = [
			face
			for (face, _), there in zip(common, np.split(both, np.cumsum([len(one) for one in places])[:-1]), strict=True)
			if there.any()
		]
		if pressed:
			raise ValueError(
				f'{name}: on {len(pressed)} faces, first face {pressed[0].plane} of body {pressed[0].body}, another water presses already, by an engine PolytopeWater in O.engines, and both would '
				'add up; give each call faces of its own (*faces*), or take the other one away first (its dead=True)'
			)


def _pressures(engine, places):
	"""(n,) of its field [Pa]; below zero where there is none."""
	found = np.full(len(places), -1.0)
	sides, offsets = np.array(engine.sides, float).reshape(-1, 3, 3), np.array(engine.sideOffsets, float).reshape(-1, 3)
	for point, value, gradient, three, ends in zip(engine.points, engine.values, engine.gradients, sides, offsets, strict=True):
		apart = places - np.array(point, float)
		within = (apart @ three.T <= ends).all(axis=1)
		found[within] = np.maximum(found[within], float(value) + apart[within] @ np.array(gradient, float))
	return found
