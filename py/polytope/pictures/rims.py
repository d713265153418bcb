# SPDX-License-Identifier: GPL-2.0-or-later
"""Colours of single faces of a polygon, which a picture shows from the end: its sides are lines there, so each colours a strip of the cap
along it."""

import numpy as np

__all__ = ['withRims']

width = 0.25
"""Width of a strip, over the way from the cap's edge to the mean of its corners: seen in a picture, and the cap's own colour, too."""


def withRims(vertices, counts, corners, colors):
	"""Faces, as in *faces*, and their colours (n, 3), with a strip on each cap beside each side, in the side's colour.

	Caps are the faces whose normal is along z.
	"""
	loops = np.split(corners, np.cumsum(counts)[:-1])
	caps = [np.ptp(vertices[loop, 2]) == 0 for loop in loops]
	ofSide = {}
	for loop, cap, color in zip(loops, caps, colors, strict=True):
		if not cap:
			ofSide.update((pair, color) for pair in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))
	points, faces, painted = list(vertices), [], []
	for loop, cap, color in zip(loops, caps, colors, strict=True):
		if not cap:
			faces.append(loop.tolist())
			painted.append(color)
			continue
		own = vertices[loop]
		inner = list(range(len(points), len(points) + len(loop)))
		points += list(own + width * (own.mean(axis=0) - own))
		faces.append(inner)
		painted.append(color)
		for k, (one, two) in enumerate(zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)):
			faces.append([one, two, inner[(k + 1) % len(inner)], inner[k]])
			painted.append(ofSide[two, one])  # the neighbour goes the other way round
	return np.array(points), np.array([len(face) for face in faces]), np.concatenate(faces), np.array(painted)
