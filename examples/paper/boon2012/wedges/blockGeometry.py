# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks around a wedge, as planes: read from a geometry file, or made."""

import json
import math

import numpy as np

__all__ = ['BlockGeometry', 'samePlane', 'touchingRoofBlocks']

samePlane = 1e-6
"""Difference up to which two planes of a geometry file are the two sides of one joint: of normals [-] and of distances over the wedge's
height [-]."""


class BlockGeometry:
	"""Named convex blocks, one of them the wedge, from a geometry file (examples/paper/geometry/README.md has the format).

	:ivar dict planes: name → (n, 4) array, rows a_x, a_y, a_z, d with unit normals: a·x ≤ d
	:ivar str wedge: name of the free block
	"""

	def __init__(self, planes):
		"""
		:param dict planes: name → rows of four numbers; the name of exactly one block has 'wedge' in it
		:raises ValueError: naming the block that is wrong
		"""
		self.planes = {}
		for name, rows in planes.items():
			try:
				array = np.array(rows, float)
			except (TypeError, ValueError):
				array = np.empty(0)
			if array.ndim != 2 or array.shape[1] != 4 or not np.isfinite(array).all() or not np.linalg.norm(array[:, :3], axis=1).all():
				raise ValueError(
					f"block '{name}': planes must be rows of four finite numbers [a_x, a_y, a_z, d] with a normal other than zero"
				)
			self.planes[name] = array / np.linalg.norm(array[:, :3], axis=1, keepdims=True)
		wedges = [name for name in self.planes if 'wedge' in name.lower()]
		if len(wedges) != 1:
			raise ValueError(f"exactly one block must have 'wedge' in its name, got {list(self.planes)}")
		self.wedge = wedges[0]

	@classmethod
	def read(cls, path):
		"""
		:raises ValueError: naming the file, and what is wrong with it
		:raises OSError: if it cannot be read
		"""
		try:
			with open(path) as file:
				return cls({name: block['planes'] for name, block in json.load(file).items()})
		except (AttributeError, KeyError, TypeError) as error:
			raise ValueError(f"{path}: must be an object of blocks, each with 'planes' ({type(error).__name__}: {error})") from None
		except ValueError as error:  # JSON's own error is one too
			raise ValueError(f'{path}: {error}') from None

	@property
	def others(self):
		return [name for name in self.planes if name != self.wedge]

	def sharedPlanes(self, name):
		"""The wedge's planes of which block *name* is the other side."""
		scale = np.ptp(self.planes[self.wedge][:, 3]) or 1.0
		return [
			k
			for k, plane in enumerate(self.planes[self.wedge])
			if any(
				np.allclose(plane[:3], -other[:3], atol=samePlane) and abs(plane[3] + other[3]) < samePlane * scale
				for other in self.planes[name]
			)
		]

	@property
	def faceBlocks(self):
		"""Names of the blocks that meet the wedge on a face: they are the other side of just one of its planes."""
		return [name for name in self.others if len(self.sharedPlanes(name)) == 1]

	@property
	def edgeBlocks(self):
		"""Names of the blocks that meet the wedge along an edge or at a vertex: they are the other side of several of its planes."""
		return [name for name in self.others if len(self.sharedPlanes(name)) > 1]

	def jointNormal(self, name):
		"""Unit normal of the joint with one of the *faceBlocks*, into the wedge."""
		return -self.planes[self.wedge][self.sharedPlanes(name)[0], :3]


def touchingRoofBlocks(geometry, sideArea):
	"""The wedge of a roof geometry between three blocks of 120° that touch each other over vertical joints of a given area.

	The blocks are slabs on the wedge's faces, as high as the wedge, cut by the three vertical planes through its apex: the
	thicker they are the larger the joints between them.

	:param BlockGeometry geometry: with a wedge of three equal joints at 120°
	:param float sideArea: of each joint between two blocks [m²], positive
	:returns: a BlockGeometry
	:raises ValueError: if the joints are not such
	"""
	wedge = geometry.planes[geometry.wedge]
	joints = [(name, wedge[geometry.sharedPlanes(name)[0]]) for name in geometry.others if geometry.sharedPlanes(name)]
	apex, *_ = np.linalg.lstsq(np.array([plane[:3] for _, plane in joints]), np.array([plane[3] for _, plane in joints]), rcond=None)
	if len(joints) != 3 or not np.allclose([plane[:3] for _, plane in joints], _threefold(joints[0][1][:3]), atol=1e-9):
		raise ValueError('geometry: must have three joints of equal dip, 120° apart')
	bottom = min(-plane[3] for plane in wedge if np.allclose(plane[:3], (0, 0, -1)))
	height = apex[2] - bottom
	horizontal = math.hypot(*joints[0][1][:2])
	thickness = sideArea / height * horizontal * math.cos(math.pi / 3)  # the vertical joint is a parallelogram as high as the wedge
	blocks = {geometry.wedge: wedge}
	for name, plane in joints:
		outward = np.array([plane[0], plane[1], 0]) / horizontal
		sides = [np.array([-outward[1], outward[0], 0]) * sign * 0.5 - outward * math.sqrt(3) / 2 for sign in (1, -1)]
		rows = [np.append(-plane[:3], -plane[3]), np.append(plane[:3], plane[3] + thickness), [0, 0, 1, apex[2]], [0, 0, -1, -bottom]]
		blocks[name] = rows + [np.append(side, side.dot(apex)) for side in sides]
	return BlockGeometry(blocks)


def _threefold(normal):
	"""A vector and itself turned by 120° and 240° clockwise about z."""
	turn = np.array([[-0.5, math.sqrt(0.75), 0], [-math.sqrt(0.75), -0.5, 0], [0, 0, 1]])
	return [normal, turn @ normal, turn @ turn @ normal]
