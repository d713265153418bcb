# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks that can leave a rock mass through a free face, and their factor of safety by limit equilibrium.

Goodman & Shi (1985), Block Theory and Its Application to Rock Engineering: a block can move along s if s leads into no joint face. Under
its weight it falls, slides on one face or on two (Warburton 1981, Rock Mech. Rock Eng. 14:109-131); at most one of these is possible.
"""

import dataclasses
import itertools
import math
from collections.abc import Sequence

import numpy as np

from ..arguments import namedArguments, number, numbersOf, vector
from .faces import areaOfFace, shapeOf
from .given import refuseOthers
from .joint import finite

__all__ = ['KeyBlock', 'keyBlocks']

rounding = 1e-9
"""Sine of an angle below which two directions are the same."""


@dataclasses.dataclass
class KeyBlock:
	"""A block that moves if friction and cohesion do not hold it."""

	body: int
	"""The block's number in *JointedRock.bodies*."""
	mode: str
	"""'falls', 'slides on one face' or 'slides on two faces'"""
	joints: tuple
	"""Rows of *JointedRock.joints* that it slides on."""
	direction: np.ndarray
	"""Unit vector of its motion."""
	factorOfSafety: float
	"""Resisting over driving force; 0 where it falls."""
	volume: float
	"""[m³]"""


@namedArguments
def keyBlocks(rock, free, frictionAngle, cohesion=0.0, density=2600.0, gravity=(0, 0, -9.81)):
	"""Blocks of a jointed rock that would leave it through free faces of the region under their weight:
	``polytope.keyBlocks(rock, (0, 0, -1), radians(35))``.

	Joints with friction and cohesion and without tensile strength; each block alone, its neighbours at rest, without rotation. Blocks at
	faces of the region that are not free go on beyond it and do not move. Bodies of several blocks are left out.

	:param JointedRock rock: what jointedRock made
	:param free: outward normal of the free face, or a list of such: of a tunnel's roof (0, 0, −1)
	:param frictionAngle: of joints [rad], or a sequence of one for each of jointedRock's *jointSets*
	:param cohesion: of joints [Pa], or a sequence as for *frictionAngle*
	:param float density: of rock [kg/m³]
	:param gravity: [m/s²]
	:returns: list of *KeyBlock*, the least factor of safety first
	:raises ValueError: naming the argument: *rock* that is none; *free* where the region has no such face
	"""
	refuseOthers(rock)
	faces = _unitNormals(free)
	if not any((np.array(normals) @ faces.T > 1 - rounding).any() for normals, _ in rock.blocks):
		raise ValueError('free: no face of the region has this outward normal; a roof has (0, 0, -1), a floor (0, 0, 1)')
	tangents = np.tan(_perSet(frictionAngle, 'frictionAngle', rock.entries, math.pi / 2))
	strengths = _perSet(cohesion, 'cohesion', rock.entries, math.inf)
	if not 0 < number(density, 'density') < math.inf:
		raise ValueError(f'density: must be positive and finite [kg/m³], got {density!r}')
	weight = float(density) * np.array(vector(gravity, 'gravity'), float)
	if not weight.any():
		raise ValueError('gravity: must not be zero, nothing moves')
	found = []
	for body, parts in enumerate(rock.bodies):
		if len(parts) > 1:
			continue
		(normals, _), labels = rock.blocks[parts[0]], rock.faces[parts[0]]
		loose = (labels < 0) & (normals @ faces.T > 1 - rounding).any(axis=1)
		if loose.any() and (labels[~loose] >= 0).all():
			move = _motion(normals, loose, weight * float(rock.volumes[parts[0]]))
			if move is not None:
				found.append(_keyBlock(rock, body, parts[0], *move, tangents, strengths))
	return sorted(found, key=lambda one: one.factorOfSafety)


def _motion(normals, loose, force):
	"""(direction, planes that it slides on, force along it, forces onto them), or None: it stays without friction, or cannot move."""
	held = normals[~loose]
	number = np.flatnonzero(~loose)
	size = float(np.linalg.norm(force))
	onto = held @ force
	if (onto <= rounding * size).all():
		return force / size, (), size, ()
	for i in np.flatnonzero(onto > rounding * size):
		along = force - onto[i] * held[i]
		driving = float(np.linalg.norm(along))
		if driving > rounding * size and _free(held, along / driving, [i]):
			return along / driving, (int(number[i]),), driving, (float(onto[i]),)
	for i, j in itertools.combinations(range(len(held)), 2):
		line = np.cross(held[i], held[j])
		length = float(np.linalg.norm(line))
		if length < rounding or abs(line @ force) <= rounding * length * size:
			continue
		line *= np.sign(line @ force) / length
		driving = float(line @ force)
		pressing = np.linalg.solve(np.column_stack([held[i], held[j], line]), force)[:2]
		if (pressing > 0).all() and _free(held, line, [i, j]):
			return line, (int(number[i]), int(number[j])), driving, tuple(pressing.tolist())
	return None


def _free(held, direction, on):
	"""Whether a motion leads into no face, but along those that it slides on."""
	into = held @ direction
	into[on] = 0
	return bool((into <= rounding).all())


def _keyBlock(rock, body, block, direction, planes, driving, onto, tangents, strengths):
	(normals, offsets), labels = rock.blocks[block], rock.faces[block]
	corners = shapeOf(normals, offsets)[0] if planes and strengths.any() else None
	resisting = 0.0
	for plane, pressing in zip(planes, onto, strict=True):
		one = rock.sets[labels[plane]]
		resisting += pressing * tangents[one]
		if corners is not None:
			resisting += strengths[one] * areaOfFace(corners, normals[plane], offsets[plane])
	mode = ('falls', 'slides on one face', 'slides on two faces')[len(planes)]
	joints = tuple(int(labels[plane]) for plane in planes)
	return KeyBlock(body, mode, joints, direction, float(resisting / driving), float(rock.volumes[block]))


def _unitNormals(free):
	try:
		rows = np.array(free, float).reshape(-1, 3)
		lengths = np.linalg.norm(rows, axis=1)
	except (TypeError, ValueError):
		lengths = np.zeros(1)
	if not len(lengths) or not np.isfinite(lengths).all() or not lengths.all():
		raise ValueError(f'free: must be the outward normal of a free face, or a list of such, got {free!r}')
	return rows / lengths[:, None]


def _perSet(values, name, sets, below):
	given = values if isinstance(values, (Sequence, np.ndarray)) and not isinstance(values, str) else [values] * sets
	if not all(finite(x) and 0 <= x < below for x in given):
		limits = 'from 0 on [Pa]' if math.isinf(below) else 'an angle from 0 to below π/2 (radians)'
		raise ValueError(f'{name}: must be {limits}, one number or one for each joint set, got {values!r}')
	if len(given) != sets:
		raise ValueError(f'{name}: {len(given)} are given for {sets} joint sets; give one number, or one for each')
	return np.array(numbersOf(given, name), float)
