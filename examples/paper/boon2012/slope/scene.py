# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation E of the paper: a rock slope whose joints do not daylight, in the plane."""

import dataclasses
import json
import math

import numpy as np
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	RockJointMat,
)
from yade.polytope.bodies.polytopes import polygon

__all__ = ['SlumpingSlope', 'readSlope']

layerColors = [(0.78, 0.31, 0.16), (0.93, 0.64, 0.29), (0.93, 0.86, 0.66), (0.55, 0.76, 0.75), (0.35, 0.60, 0.72), (0.16, 0.42, 0.58)]
dipTolerance = math.radians(5)
"""Tolerance on the angle between the dip that a file states and the edges that have it."""


def readSlope(path):
	"""A slope's polygons from a JSON file {free: [[[x, y], …], …], fixed: […], params: {delta, s}}, as arguments of SlumpingSlope.

	The toe is on the left, and the face points to the left. *params* may be left out: all blocks then count as one layer.

	:returns: dictionary {free, fixed, dip, spacing}
	:raises ValueError: naming the file and what is wrong in it
	"""
	with open(path) as file:
		try:
			content = json.load(file)
		except ValueError as error:
			raise ValueError(f'{path}: this is not JSON: {error}') from error
	for name in ('free', 'fixed'):
		if not isinstance(content, dict) or not content.get(name):
			raise ValueError(f'{path}: there are no polygons named {name!r}')
		if not isinstance(content[name], list):
			raise ValueError(f'{path}: {name!r} must be a list of polygons')
		for k, corners in enumerate(content[name]):
			if not isinstance(corners, list) or len(corners) < 3 or not all(map(_isPoint, corners)):
				raise ValueError(f'{path}: {name}[{k}] must be a list of three or more points [x, y]')
	params = content.get('params', {})
	if not isinstance(params, dict):
		raise ValueError(f"{path}: 'params' must be an object {{delta, s}}")
	dip, spacing = params.get('delta'), params.get('s')
	if dip is not None and not (_isNumber(dip) and 0 < dip <= 90):
		raise ValueError(f"{path}: params' delta, the dip of face and bedding [°], must be a number above 0 and up to 90, not {dip!r}")
	if spacing is not None and not (_isNumber(spacing) and spacing > 0):
		raise ValueError(f"{path}: params' s, the spacing of the bedding [m], must be a positive number, not {spacing!r}")
	if dip is not None and not _hasEdgeThatRises(content['free'], math.radians(dip)):
		raise ValueError(
			f"{path}: no edge of a free block rises to the right at params' delta, {dip:g}°, within {math.degrees(dipTolerance):g}°: "
			'the toe must be on the left, with the face to the left (mirror x if it is the other way round)'
		)
	return {'free': content['free'], 'fixed': content['fixed'], 'dip': None if dip is None else math.radians(dip), 'spacing': spacing}


def _isNumber(value):
	return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _isPoint(value):
	return isinstance(value, list) and len(value) == 2 and all(map(_isNumber, value))


def _hasEdgeThatRises(polygons, dip):
	for corners in polygons:
		edges = np.roll(corners, -1, axis=0) - corners
		across = np.abs(edges @ np.array([math.sin(dip), -math.cos(dip)]))
		lengths = np.hypot(*edges.T)
		if np.any((lengths > 0) & (across <= math.sin(dipTolerance) * lengths)):
			return True
	return False


@dataclasses.dataclass
class SlumpingSlope:
	"""Polygons of unit thickness, a fixed base and back (simulation E of Boon et al. 2012, Fig. 11).

	Make it with `SlumpingSlope(**readSlope(path)).build()`.
	The paper gives no sizes and no parameters; those here are our choice. The polygons are true 2-D bodies: nothing is out of
	the plane, and there are no contacts at the sides.
	"""

	free: list
	"""Corners of the blocks that can move [m]."""
	fixed: list
	dip: float = None
	"""Dip of the face and the bedding [rad], for distinguishing layers; the face points to the left."""
	spacing: float = None
	"""Spacing of the bedding [m]."""
	density: float = 2500
	normalStiffness: float = 1e9
	"""Normal stiffness of the joints, per area [Pa/m]."""
	shearStiffness: float = 1e9
	stiffnessPerArea: bool = True
	"""False: stiffnesses are those of each contact [N/m]."""
	frictionAngle: float = math.radians(40)
	"""Friction angle at the start; high enough for the blocks to settle."""
	contactDamping: float = 0.1
	"""Damping of each contact, normal and shear, fraction of critical."""
	damping: float = 0.3
	"""YADE's own: NewtonIntegrator.damping."""
	gravity: float = 10
	cornerRadius: float = 0.05
	timeStep: float = 1e-4
	contactPoint: str = 'analyticCentre'
	contactModel: str = 'boon2012'
	"""'boon2012', 'surface', 'foundation' or 'spring'; the last three do not read *contactPoint*."""

	# what build() made
	freeIds: list = dataclasses.field(default_factory=list, init=False)
	fixedIds: list = dataclasses.field(default_factory=list, init=False)

	def build(self):
		O.reset()
		O.materials.append(
			RockJointMat(
				density=self.density,
				normalStiffness=self.normalStiffness,
				shearStiffness=self.shearStiffness,
				frictionAngle=self.frictionAngle,
			)
		)
		shape = {'thickness': 1.0, 'cornerRadius': self.cornerRadius}
		self.fixedIds = O.bodies.append([polygon(corners, fixed=True, color=(0.86, 0.86, 0.84), **shape) for corners in self.fixed])
		self.freeIds = O.bodies.append(
			[
				polygon(corners, color=layerColors[layer % len(layerColors)], **shape)
				for corners, layer in zip(self.free, self.layers(), strict=True)
			]
		)
		O.engines = [
			ForceResetter(),
			InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.05),
			InteractionLoop(
				[Ig2_Polytope_Polytope_PolytopeGeom(contactModel=self.contactModel, contactPoint=self.contactPoint)],
				[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=self.stiffnessPerArea)],
				[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=self.contactDamping, shearDamping=self.contactDamping)],
			),
			NewtonIntegrator(damping=self.damping, gravity=(0, -self.gravity, 0)),
		]
		O.dt = self.timeStep
		return self

	def layers(self):
		"""Layer of each free block, 0 the outermost: by its centre below the outermost corner; zeros if dip or spacing is unknown."""
		if self.dip is None or not self.spacing:
			return [0] * len(self.free)
		inward = np.array([math.sin(self.dip), -math.cos(self.dip)])
		depths = [np.array(corners) @ inward for corners in self.free]
		face = min(depth.min() for depth in depths)
		layers = np.floor([(depth.mean() - face) / self.spacing for depth in depths]).astype(int)
		return (layers - layers.min()).tolist()

	def bodies(self):
		"""The free blocks, in the order of *free*."""
		return [O.bodies[k] for k in self.freeIds]
