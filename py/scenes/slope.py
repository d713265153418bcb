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

from ..bodies import polygon

__all__ = ['SlumpingSlope', 'readSlope']

layerColors = [(0.78, 0.31, 0.16), (0.93, 0.64, 0.29), (0.93, 0.86, 0.66), (0.55, 0.76, 0.75), (0.35, 0.60, 0.72), (0.16, 0.42, 0.58)]


def readSlope(path):
	"""A slope's polygons from a JSON file {free: [[[x, y], …], …], fixed: […], params: {delta, s}}, as arguments of SlumpingSlope.

	*params* may be left out: all blocks then count as one layer.

	:returns: dictionary {free, fixed, dip, spacing}
	:raises ValueError: naming what the file lacks
	"""
	with open(path) as file:
		content = json.load(file)
	for name in ('free', 'fixed'):
		if not isinstance(content, dict) or not content.get(name):
			raise ValueError(f'{path}: there are no polygons named {name!r}')
		for k, corners in enumerate(content[name]):
			if len(corners) < 3 or any(len(point) != 2 for point in corners):
				raise ValueError(f'{path}: {name}[{k}] must be a list of three or more points [x, y]')
	params = content.get('params', {})
	return {
		'free': content['free'],
		'fixed': content['fixed'],
		'dip': math.radians(params['delta']) if 'delta' in params else None,
		'spacing': params.get('s'),
	}


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
	"""Of the face and the bedding [rad], for telling layers apart; face through the origin."""
	spacing: float = None
	"""Of the bedding [m]."""
	density: float = 2500
	normalStiffness: float = 1e9
	"""Of the joints, per area [Pa/m]."""
	shearStiffness: float = 1e9
	stiffnessPerArea: bool = True
	"""False: stiffnesses are those of each contact [N/m]."""
	frictionAngle: float = math.radians(40)
	"""At the start; high enough for the blocks to settle."""
	contactDamping: float = 0.1
	"""Of each contact, normal and shear, fraction of critical."""
	damping: float = 0.3
	"""YADE's own: NewtonIntegrator.damping."""
	gravity: float = 10
	cornerRadius: float = 0.05
	timeStep: float = 1e-4
	contactPoint: str = 'analyticCentre'

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
				[Ig2_Polytope_Polytope_PolytopeGeom(contactPoint=self.contactPoint)],
				[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=self.stiffnessPerArea)],
				[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=self.contactDamping, shearDamping=self.contactDamping)],
			),
			NewtonIntegrator(damping=self.damping, gravity=(0, -self.gravity, 0)),
		]
		O.dt = self.timeStep
		return self

	def layers(self):
		"""Layer of each free block, 0 the outermost: by its centre's distance from the face; zeros if dip or spacing are not known."""
		if self.dip is None or not self.spacing:
			return [0] * len(self.free)
		centres = np.array([np.mean(corners, axis=0) for corners in self.free])
		depth = centres @ np.array([math.sin(self.dip), -math.cos(self.dip)])
		return np.floor(depth / self.spacing).astype(int).tolist()

	def bodies(self):
		"""The free blocks, in the order of *free*."""
		return [O.bodies[k] for k in self.freeIds]
