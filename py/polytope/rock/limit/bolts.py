# SPDX-License-Identifier: GPL-2.0-or-later
"""Bolts as plastic links between rigid blocks: a tension along the axis up to what steel and grout hold, and the dowel across it.

A link is written as a corner of a joint (*Corners*) with a friction of −1: |t| ≤ 2 s − (n + s), n ≥ −s has |t| ≤ 2 s, and n, which acts on
nothing, is bounded. The tension lies between 0 and T: half of T is a load, and the rest t between −T/2 and T/2.
"""

import dataclasses
import math

import numpy as np

from ...bonding.bolting import madeBolts
from ..faces import frameOf

__all__ = ['Links', 'linksOf', 'withLinks']


@dataclasses.dataclass
class Links:
	one: np.ndarray
	"""(links,) row of the block on the side of the head, −1: it does not move"""
	two: np.ndarray
	places: np.ndarray
	"""(links, 3) [m]"""
	frames: np.ndarray
	"""(links, 3, 3) columns: none, and the directions along which it acts, or none"""
	most: np.ndarray
	"""(links,) largest force along these [N]"""
	loads: np.ndarray
	"""(links, 3) on block two; the opposite on block one [N]"""


def linksOf(blocks):
	"""The links that bolts which hold make between blocks.

	:raises ValueError: if one has no limit
	"""
	found = []
	for bolt in madeBolts():
		head, end = (np.array([float(x) for x in point]) for point in (bolt.head, bolt.end))
		axis = (end - head) / np.linalg.norm(end - head)
		for crossing in bolt.crossings:
			one, two = blocks.rowOf(crossing.id1), blocks.rowOf(crossing.id2)
			if crossing.failure or one == two:
				continue
			place = head + (float(crossing.start) + float(crossing.stop)) / 2 * axis
			tension = _tension(bolt, crossing)
			found.append((one, two, place, np.column_stack([0 * axis, axis, 0 * axis]), tension / 2, -tension / 2 * axis))
			if crossing.dowelStrength > 0:
				frame = frameOf(axis) * [0, 1, 1]
				found.append((one, two, place, frame, float(crossing.dowelStrength), 0 * axis))
	columns = zip(*found, strict=True) if found else ([], [], np.empty((0, 3)), np.empty((0, 3, 3)), [], np.empty((0, 3)))
	one, two, *rest = map(np.array, columns)
	return Links(one.astype(int), two.astype(int), *rest)


def _tension(bolt, crossing):
	"""Largest one at this joint [N]: of the steel, and of what holds it on either side."""
	sides = [float(bolt.yieldForce)]
	if bolt.groutStiffness > 0:
		strengths = np.array([float(strength) for strength in bolt.groutStrengths])
		places = np.array([float(place) for place in bolt.stations])[-len(strengths) :]  # the plate's comes before
		before = places < (float(crossing.start) + float(crossing.stop)) / 2
		sides.append(strengths[~before].sum())
		if not bolt.plate:
			sides.append(strengths[before].sum())
	if not min(sides) < math.inf:
		raise ValueError(
			'polytope.bolt: a bolt without a yieldForce holds whatever pulls at it, and limit analysis knows no elastic forces; give it a yieldForce'
		)
	return min(sides)


def withLinks(blocks, corners, links):
	"""Blocks with the part of the tensions that is a load, and corners with the links' own behind the joints'."""
	loads = blocks.loads.copy()
	for one, two, place, load in zip(links.one, links.two, links.places, links.loads, strict=True):
		for block, force in ((one, -load), (two, load)):
			if block >= 0:
				loads[block] += [*force, *np.cross(place - blocks.centres[block], force)]
	count, faces, none = len(links.one), len(corners.middles), np.zeros(len(links.one))
	more = dict(
		one=links.one,
		two=links.two,
		middles=links.places,
		face=faces + np.arange(count),
		places=links.places,
		frames=links.frames,
		**dict.fromkeys(('areas', 'friction', 'cohesion', 'tension'), none),
	)
	joined = {name: np.concatenate([getattr(corners, name), value]) for name, value in more.items()}
	return dataclasses.replace(blocks, loads=loads), dataclasses.replace(corners, **joined)
