# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation A of the paper: regular polyhedra fall onto a floor between four walls."""

import dataclasses
import math

import numpy as np
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	Quaternion,
	RockJointMat,
)
from yade.polytope import cuboid, regular

__all__ = ['FallingPolyhedra', 'circumradiusOfUnitVolume', 'solids']

solids = {'tetrahedron': 4, 'cube': 6, 'octahedron': 8, 'dodecahedron': 12, 'icosahedron': 20}
"""The regular solids' numbers of faces."""

solidColors = {4: (0.85, 0.42, 0.16), 6: (0.16, 0.42, 0.58), 8: (0.47, 0.70, 0.70), 12: (0.93, 0.83, 0.58), 20: (0.62, 0.20, 0.17)}
layerColors = [(0.16, 0.42, 0.58), (0.35, 0.60, 0.72), (0.55, 0.76, 0.75), (0.93, 0.86, 0.66), (0.93, 0.64, 0.29), (0.78, 0.31, 0.16)]


def circumradiusOfUnitVolume(faces):
	"""Circumradius of the regular solid of volume 1, from volume and circumradius of the one of edge 1."""
	root = math.sqrt
	volume, circumradius = {
		4: (1 / (6 * root(2)), root(6) / 4),
		6: (1, root(3) / 2),
		8: (root(2) / 3, 1 / root(2)),
		12: ((15 + 7 * root(5)) / 4, root(3) * (1 + root(5)) / 4),
		20: (5 * (3 + root(5)) / 12, root(10 + 2 * root(5)) / 4),
	}[faces]
	return circumradius / volume ** (1 / 3)


@dataclasses.dataclass
class FallingPolyhedra:
	"""Regular polyhedra of equal volume fall from a lattice onto a floor between four walls (simulation A of Boon et al. 2012).

	The paper gives number and solids; all sizes and parameters are our choice. Make it with `FallingPolyhedra(...).build()`.
	"""

	faces: tuple = (8,)
	"""Numbers of faces (4, 6, 8, 12, 20) of the solids, used in turn; an int for one solid alone."""
	number: int = 200
	seed: int = 1
	"""Seed of the orientations: the same seed gives the same scene."""
	columns: int = 6
	"""Lattice points along each side of the floor; the number of layers follows from the number of solids."""
	size: float = 0.1
	"""L, edge of the cube of each solid's volume [m]."""
	density: float = 2600
	normalStiffness: float = 1.25e6
	"""Normal stiffness of each contact [N/m]."""
	stiffnessRatio: float = 2 / 3
	"""Shear over normal stiffness."""
	frictionAngle: float = math.radians(30)
	contactDamping: float = 0.3
	"""Damping of each contact, fraction of critical."""
	damping: float = 0.1
	"""YADE's own: NewtonIntegrator.damping."""
	gravity: float = 9.81
	cornerFraction: float = 0.1
	"""Corner radius over L."""
	timeStepFraction: float = 0.2
	"""Time step over sqrt(mass / normalStiffness)."""
	leastWallHeight: float = 1.6
	"""Walls of more than six layers are higher. [m]"""
	wallThickness: float = 0.1
	verletFraction: float = 0.02
	"""Reach of the collider's bounding boxes beyond the bodies, over L. Measured: 0.01 to 0.03 differ by less than noise."""

	# what build() made
	floorId: int = dataclasses.field(default=-1, init=False)
	wallIds: list = dataclasses.field(default_factory=list, init=False)
	particleIds: list = dataclasses.field(default_factory=list, init=False)

	def __post_init__(self):
		if isinstance(self.faces, int):
			self.faces = (self.faces,)

	@property
	def mass(self):
		"""Mass of one particle [kg]."""
		return self.density * self.size**3

	@property
	def spacing(self):
		"""Spacing of the lattice: the largest of the solids, the tetrahedron, fits with any orientation. [m]"""
		return 2.02 * 1.249 * self.size

	@property
	def width(self):
		"""Width of the square floor between the walls [m]."""
		return self.columns * self.spacing

	@property
	def wallHeight(self):
		return max(self.leastWallHeight, self.lattice()[-1, 2] + 0.5 * self.spacing)

	@property
	def timeStep(self):
		return self.timeStepFraction * math.sqrt(self.mass / self.normalStiffness)

	def build(self):
		O.reset()
		O.materials.append(
			RockJointMat(
				density=self.density,
				normalStiffness=self.normalStiffness,
				shearStiffness=self.stiffnessRatio * self.normalStiffness,
				frictionAngle=self.frictionAngle,
			)
		)
		self._addContainer()
		self._addParticles()
		self.geometryFunctor = Ig2_Polytope_Polytope_PolytopeGeom()
		self.interactionLoop = InteractionLoop(
			[self.geometryFunctor],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=self.contactDamping, shearDamping=self.contactDamping)],
		)
		O.engines = [
			ForceResetter(),
			PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=self.verletFraction * self.size),
			self.interactionLoop,
			NewtonIntegrator(damping=self.damping, gravity=(0, 0, -self.gravity)),
		]
		O.dt = self.timeStep
		return self

	def lattice(self):
		"""Starting points of the particles' centres: layers of columns × columns, from below."""
		layer = self.columns**2
		k = np.arange(self.number)
		lowest = 0.5 * self.spacing + 0.1 * self.size
		horizontal = (np.arange(self.columns) + 0.5) * self.spacing - self.width / 2
		return np.stack([horizontal[k % self.columns], horizontal[k % layer // self.columns], lowest + k // layer * self.spacing], axis=1)

	def orientations(self):
		"""Uniformly random rotations as unit quaternions (w, x, y, z)."""
		quaternions = np.random.default_rng(self.seed).standard_normal((self.number, 4))
		return quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)

	def _addContainer(self):
		half, wall, rise = self.width / 2, self.wallThickness / 2, self.wallHeight / 2
		fixed = {'fixed': True, 'cornerRadius': self.cornerFraction * self.size, 'color': (0.86, 0.86, 0.84)}
		outer = half + 2 * wall
		self.floorId = O.bodies.append(cuboid((0, 0, -wall), (outer, outer, wall), **fixed))
		self.wallIds = O.bodies.append(
			[cuboid((side * (half + wall), 0, rise), (wall, outer, rise), **fixed) for side in (-1, 1)]
			+ [cuboid((0, side * (half + wall), rise), (half, wall, rise), **fixed) for side in (-1, 1)]
		)

	def _addParticles(self):
		"""Different solids in different colours; with one solid alone, each layer of the lattice has its colour."""
		for k, (center, orientation) in enumerate(zip(self.lattice(), self.orientations(), strict=True)):
			faces = self.faces[k % len(self.faces)]
			layer = k // self.columns**2
			body = regular(
				faces,
				circumradiusOfUnitVolume(faces) * self.size,
				center=tuple(center),
				orientation=Quaternion(*orientation),
				cornerRadius=self.cornerFraction * self.size,
				color=solidColors[faces] if len(self.faces) > 1 else layerColors[layer % len(layerColors)],
			)
			self.particleIds.append(O.bodies.append(body))

	def particles(self):
		return [O.bodies[k] for k in self.particleIds]
