# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of mixed shapes in containers made of YADE's facets: a funnel they run out of, a drum that turns them over; their energy."""

import dataclasses
import math

import numpy as np
from yade import O, Quaternion, RockJointMat, RotationEngine, Vector3, utils
from yade.polytope import cuboid, fromVertices, regular

from .engines import jointEngines

__all__ = ['EnergyBook', 'FacetDrum', 'FacetFunnel', 'FacetGrains', 'cylinderFacets', 'mixedGrain']

circumradiusOfUnit = {
	4: (8 * math.sqrt(3) / 27) ** (-1 / 3),
	6: math.sqrt(3) / 2,
	8: (3 / 4) ** (1 / 3),
	12: 2.785163863 ** (-1 / 3),
	20: 2.536150710 ** (-1 / 3),
}
"""Faces: circumradius of a regular solid of the volume 1."""


def mixedGrain(number, position, volume, random):
	"""The next of a mixture of the five regular solids and an irregular hull, of about one volume, turned at random."""
	axis = Vector3(*random.normal(size=3))
	turn = Quaternion(axis.normalized(), random.uniform(0, 2 * math.pi))
	kinds = tuple(circumradiusOfUnit)
	size = volume ** (1 / 3)
	if number % 6 < len(kinds):
		faces = kinds[number % 6]
		return regular(faces, circumradiusOfUnit[faces] * size, position, turn)
	points = random.normal(size=(12, 3))
	points *= (0.95 * size / np.linalg.norm(points, axis=1))[:, None]
	points *= (1.1, 0.95, 0.75)
	return fromVertices(points + np.array(position))


def cylinderFacets(profile, segments, fromAxis=lambda r, q, z: (r * math.cos(q), r * math.sin(q), z)):
	"""Facets of a surface of revolution: triangles between rings of the given (radius, height); a radius of 0 is a point on the axis."""
	rings = [[fromAxis(r, 2 * math.pi * k / segments, z) for k in range(segments)] for r, z in profile]
	for (low, lower), (high, upper) in zip(zip(profile, rings, strict=True), list(zip(profile, rings, strict=True))[1:], strict=False):
		for k in range(segments):
			a, b, c, d = lower[k], lower[(k + 1) % segments], upper[k], upper[(k + 1) % segments]
			if low[0] > 0:
				yield utils.facet([a, b, d if high[0] > 0 else c])
			if high[0] > 0:
				yield utils.facet([a, d, c])


class EnergyBook:
	"""Energy balance: work of gravity and drive, and where it is stored or dissipated. Start it before the first step.

	Gravity's work is taken from heights, kinetic energy from velocities, the drive's work from the angular momentum of the grains,
	which the drum and gravity alone change: none of them from contact forces. Friction, dampers and springs are those of the
	law (O.trackEnergy).
	"""

	def __init__(self, ids, gravity):
		O.trackEnergy = True
		self.states = [O.bodies[i].state for i in ids]
		self.mass = np.array([s.mass for s in self.states])
		self.gravity = gravity
		self.height, self.kinetic = self._height(), utils.kineticEnergy()

	def _height(self):
		return float(self.mass @ [s.pos[2] for s in self.states])

	def read(self, drive=0.0):
		"""Terms [J] by name, and 'missing': what was put in less what is accounted for (below 0: contacts have made energy)."""
		spent = {
			name: O.energy[name] if name in dict(O.energy.items()) else 0.0
			for name in ('plastDissip', 'normDampDissip', 'shearDampDissip', 'elastPotential', 'nonconservative', 'nonviscDamp')
		}
		book = {'gravity': self.gravity * (self.height - self._height()), 'drive': drive, 'kinetic': utils.kineticEnergy() - self.kinetic}
		book.update(friction=spent['plastDissip'], damping=spent['normDampDissip'] + spent['shearDampDissip'] + spent['nonviscDamp'])
		book.update(elastic=spent['elastPotential'], nonconservative=spent['nonconservative'])
		book['missing'] = book['gravity'] + book['drive'] - book['kinetic'] - book['friction'] - book['damping'] - book['elastic']
		return book


@dataclasses.dataclass
class FacetGrains:
	"""Common to both containers."""

	number: int = 60
	"""Number of grains."""
	volume: float = 1.3e-5
	"""Volume of a grain [m³]."""
	segments: int = 24
	"""Number of segments of the container's circumference."""
	frictionAngle: float = math.radians(25)
	stiffness: float = None
	"""[N/m], or [Pa/m] where perArea; default 1e5 N/m, 1e9 Pa/m."""
	perArea: bool = False
	ig2: dict = dataclasses.field(default_factory=dict)
	contactDamping: float = 0.3
	damping: float = 0.0
	seed: int = 3
	density: float = 2600
	gravity: float = 9.81
	timeStepFraction: float = 0.1

	def _begin(self):
		O.reset()
		k = self.stiffness or (1e9 if self.perArea else 1e5)
		O.materials.append(
			RockJointMat(density=self.density, normalStiffness=k, shearStiffness=k * 2 / 3, frictionAngle=self.frictionAngle)
		)
		self.random = np.random.default_rng(self.seed)

	def _pour(self, places):
		"""Puts grains at the first of the places."""
		self.ids = [O.bodies.append(mixedGrain(n, next(places), self.volume, self.random)) for n in range(self.number)]

	def _engines(self, moving=()):
		jointEngines(
			self.ig2,
			self.perArea,
			(0, 0, -self.gravity),
			damping=self.damping,
			verlet=0.1 * self.volume ** (1 / 3),
			moving=moving,
			normalDamping=self.contactDamping,
			shearDamping=self.contactDamping,
		)
		# a tenth of a grain's width is what rests on its neighbour where stiffnesses are per area
		k = self.stiffness or (1e9 if self.perArea else 1e5)
		k *= 0.1 * self.volume ** (2 / 3) if self.perArea else 1
		O.dt = self.timeStepFraction * math.sqrt(min(O.bodies[i].state.mass for i in self.ids) / k)

	@property
	def positions(self):
		return np.array([O.bodies[i].state.pos for i in self.ids], float)

	@property
	def speeds(self):
		return np.array([O.bodies[i].state.vel.norm() for i in self.ids])


@dataclasses.dataclass
class FacetFunnel(FacetGrains):
	"""Grains in a funnel of facets, of 45° above a round outlet, closed by a gate. `FacetFunnel(...).build()`, then `open()`."""

	outlet: float = 0.18
	"""Diameter [m]."""
	width: float = 0.44
	"""Diameter of the cylinder above [m]."""
	height: float = 2.0
	"""Height of the cylinder [m]."""
	gated: bool = True

	def build(self):
		self._begin()
		low, high = self.outlet / 2, self.width / 2
		cone = high - low  # of 45°
		profile = [
			(low, 0),
			(low + cone / 3, cone / 3),
			(low + 2 * cone / 3, 2 * cone / 3),
			(high, cone),
			(high, cone + 0.3 * self.height),
			(high, cone + self.height),
		]
		self.wallIds = O.bodies.append(list(cylinderFacets(profile, self.segments)))
		self.gate = O.bodies.append(cuboid((0, 0, -0.0205), (0.99 * low, 0.99 * low, 0.02), fixed=True)) if self.gated else None
		self._pour(self._places())
		self._engines()
		return self

	def _places(self):
		"""A cubic lattice within the funnel, from below."""
		pitch, z = 2.6 * self.volume ** (1 / 3), 2 * self.volume ** (1 / 3)
		while True:
			free = self.radiusAt(z) - 1.9 * self.volume ** (1 / 3)
			n = int(free / pitch) + 1
			yield from ((i * pitch, j * pitch, z) for i in range(-n, n + 1) for j in range(-n, n + 1) if math.hypot(i, j) * pitch < free)
			z += pitch

	def radiusAt(self, z):
		return min(self.outlet / 2 + max(z, 0.0), self.width / 2)

	def open(self):
		"""Takes the gate away."""
		O.bodies.erase(self.gate)

	@property
	def outside(self):
		"""Grains whose centre is beyond the wall."""
		p = self.positions
		wall = np.array([self.radiusAt(z) for z in p[:, 2]])
		return int(np.sum((np.hypot(p[:, 0], p[:, 1]) > wall) & (p[:, 2] > 0)))

	@property
	def below(self):
		"""Grains that have left."""
		return int(np.sum(self.positions[:, 2] < 0))

	def hanging(self, slow=1e-3):
		"""Grains above the outlet that hardly move [m/s]."""
		return int(np.sum((self.positions[:, 2] >= 0) & (self.speeds < slow)))


@dataclasses.dataclass
class FacetDrum(FacetGrains):
	"""Grains in a closed drum of facets that turns about its level axis, y. `FacetDrum(...).build()`, then `turn(time)`."""

	radius: float = 0.2
	length: float = 0.2
	speed: float = 3.0
	"""[rad/s]"""

	def build(self):
		self._begin()
		half = self.length / 2
		profile = [(0, -half), (self.radius, -half), (self.radius, half), (0, half)]
		walls = cylinderFacets(profile, self.segments, lambda r, q, y: (r * math.cos(q), y, -r * math.sin(q)))
		self.wallIds = O.bodies.append(list(walls))
		self._pour(self._places())
		drive = RotationEngine(
			ids=self.wallIds, angularVelocity=self.speed, rotationAxis=(0, 1, 0), rotateAroundZero=True, zeroPoint=(0, 0, 0)
		)
		self._engines(moving=[drive])
		self.book = EnergyBook(self.ids, self.gravity)
		self._impulse, self._begun = 0.0, self._momentum()
		return self

	def _places(self):
		pitch = 2.6 * self.volume ** (1 / 3)
		free = 0.97 * self.radius - 1.3 * self.volume ** (1 / 3)
		n, m = int(free / pitch), max(int((self.length / 2 - 1.3 * self.volume ** (1 / 3)) / pitch), 0)
		for k in range(-n, n + 1):
			yield from (
				(i * pitch, j * pitch, k * pitch) for i in range(-n, n + 1) for j in range(-m, m + 1) if math.hypot(i, k) * pitch < free
			)
		raise ValueError(f'number: {self.number} grains do not fit into the drum')

	def _momentum(self):
		"""Angular momentum of the grains about the axis."""
		total = 0.0
		for i in self.ids:
			s = O.bodies[i].state
			own = s.ori.conjugate() * s.angVel
			total += s.mass * (s.pos.cross(s.vel))[1] + (s.ori * Vector3(*(own[k] * s.inertia[k] for k in range(3))))[1]
		return total

	def turn(self, time, every=10):
		"""Turns on for so many seconds; the drive's work is summed up meanwhile, from gravity's moment every so many steps."""
		end = O.time + time
		weight = self.book.mass * self.gravity
		last, then = weight @ self.positions[:, 0], O.time
		while O.time < end:
			for _ in range(every):
				O.step()
			now = weight @ self.positions[:, 0]
			self._impulse += (last + now) / 2 * (O.time - then)
			last, then = now, O.time
		return self

	@property
	def driveWork(self):
		"""Work of the drum on the grains [J]: speed times the moment of momentum that it gave them, without what gravity gave."""
		return self.speed * (self._momentum() - self._begun - self._impulse)

	@property
	def outside(self):
		p = self.positions
		return int(np.sum((np.hypot(p[:, 0], p[:, 2]) > self.radius) | (np.abs(p[:, 1]) > self.length / 2)))
