# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy of collisions without friction: random meetings of two regular solids, and cubes that bounce on a floor.

Nothing but the normal force acts, so that all energy is kinetic again once the bodies have parted, whatever a contact stores:
Δ(kinetic energy) is the contact's and the integrator's error. Regular solids have equal moments of inertia, which YADE's integrator
turns without an error of its own. All bodies of a study are in one scene, each pair far from the others.

	found = Collisions(meetings(200), Contact('boon2012'), steps=100).build().run()
"""

import dataclasses
import math

import numpy as np
from boon2012.falling.scene import circumradiusOfUnitVolume, solids
from yade import O, Quaternion, Vector3, utils
from yade._polytope import contact
from yade.polytope.bodies.polytopes import cuboid, regular

from .scene import EnergyScene

__all__ = ['Bounces', 'Collisions', 'Meeting', 'lastEnergies', 'meetings', 'noticeable', 'spread']

noticeable = 1e-6
"""Gains of energy below this part of the start's are not counted as such."""

inscribedRadiusOfCube = 0.5


@dataclasses.dataclass(frozen=True)
class Meeting:
	"""Two solids of volume and mass 1 that come towards each other at speed 1, one at (x, y) off the other's line."""

	faces: tuple
	orientations: tuple
	"""(w, x, y, z) of both, of any length."""
	direction: tuple
	"""Unit vector from the first to the second."""
	offset: tuple
	"""Of the second, across the direction."""
	spins: tuple
	"""Angular velocities."""


def meetings(number, seed=1, offset=0.5, spin=1.0):
	"""Random meetings of regular solids (4, 6, 8, 12 or 20 faces, edge of the cube of their volume 1).

	:param float offset: largest distance between the lines the centres move on
	:param float spin: largest component of the angular velocities
	"""
	random = np.random.default_rng(seed)

	def unit(vector):
		return vector / np.linalg.norm(vector)

	def one():
		faces = random.choice(list(solids.values()), 2)
		direction = unit(random.standard_normal(3))
		across = random.standard_normal(3)
		across = unit(across - direction * (across @ direction)) * offset * math.sqrt(random.random())
		parts = random.standard_normal((2, 4)), direction, across, random.uniform(-spin, spin, (2, 3))
		return Meeting(tuple(faces.tolist()), *(_tuples(part) for part in parts))

	return [one() for _ in range(number)]


def _tuples(array):
	return tuple(map(_tuples, array)) if array.ndim else float(array)


class Collisions(EnergyScene):
	"""All meetings in one scene.

	:param meetings: sequence of Meeting
	:param Contact how: the contact
	:param steps: time steps in half a period of the contact
	:param overlap: of a central impact, over half a cube's edge: gives the stiffness
	:param duration: half periods from first touch on
	"""

	spacing = 20.0
	gap = 1e-3
	"""Between the solids at the start."""
	radius = (3 / (4 * math.pi)) ** (1 / 3)
	"""Of a sphere of volume 1."""
	gravity = 0.0

	def __init__(self, meetings, how, steps, overlap=0.02, duration=40):
		self.meetings, self.overlap, self.duration = meetings, overlap, duration
		self.begin(how, 0.5 / (overlap * inscribedRadiusOfCube) ** 2, 0.5, steps)

	def build(self):
		self.pairs = []
		for k, meeting in enumerate(self.meetings):
			pair = self._pair(meeting, self._base(k))
			for body, way, spin in zip(pair, (0.5, -0.5), meeting.spins, strict=True):
				body.state.vel, body.state.angVel = way * Vector3(*meeting.direction), Vector3(*spin)
			self.pairs.append(tuple(O.bodies.append(list(pair))))
		self.makeEngines()
		return self

	def _base(self, k):
		columns = math.ceil(math.sqrt(len(self.meetings)))
		return self.spacing * np.array([k % columns, k // columns, 0])

	def _pair(self, meeting, base):
		direction, offset = np.array(meeting.direction), np.array(meeting.offset)
		if self.how.model == 'spheres':
			apart = math.sqrt((2 * self.radius + self.gap) ** 2 - offset @ offset)
			return [utils.sphere(tuple(place), self.radius) for place in (base, base + offset + apart * direction)]
		pair = [self._solid(faces, q, base) for faces, q in zip(meeting.faces, meeting.orientations, strict=True)]
		near, far = 0.0, 3.0  # no two of these solids reach so far
		for _ in range(50):
			middle = (near + far) / 2
			pair[1].state.pos = Vector3(*(base + offset + middle * direction))
			if contact(*pair).infeasibility < self.gap:
				near = middle
			else:
				far = middle
		return pair

	def _solid(self, faces, orientation, place):
		return self.rounded(regular(faces, circumradiusOfUnitVolume(faces), tuple(place), Quaternion(*orientation).normalized()))

	def run(self):
		"""Until `duration` is over. Returns a dictionary of lists, a number a pair:

		error: change of the kinetic energy over that of the start; touched, parted: whether the two have met, and are free again at the
		end; momentum, angularMomentum: size of their change (mass × speed is 1); and contactTime: mean time under force of those that
		touched, in half periods.
		"""
		energy, linear, angular = self._state()
		every = max(1, round(self.half / self.timeStep / 20))
		steps = math.ceil(self.duration * self.half / self.timeStep)
		pressed = np.zeros(len(self.pairs), int)
		for step in range(steps):
			O.step()
			if step % every == 0 or step == steps - 1:
				# not by the interaction: YADE's Polyhedra keep theirs while the boxes overlap
				now = np.array([O.forces.f(one) != Vector3.Zero for one, _ in self.pairs])
				pressed += now
		after, linearAfter, angularAfter = self._state()
		return {
			'error': (after / energy - 1).tolist(),
			'touched': (pressed > 0).tolist(),
			'parted': (~now).tolist(),
			'momentum': np.linalg.norm(linearAfter - linear, axis=1).tolist(),
			'angularMomentum': np.linalg.norm(angularAfter - angular, axis=1).tolist(),
			'contactTime': float(pressed[pressed > 0].mean()) * every * self.timeStep / self.half,
		}

	def _state(self):
		"""Kinetic energy, momentum and angular momentum about the place of its start, of each pair."""
		energies, linear, angular = [], [], []
		for k, pair in enumerate(self.pairs):
			base = Vector3(*self._base(k))
			states = [O.bodies[number].state for number in pair]
			energies.append(sum(s.mass * s.vel.squaredNorm() / 2 + s.inertia[0] * s.angVel.squaredNorm() / 2 for s in states))
			linear.append(list(sum((s.mass * s.vel for s in states), Vector3.Zero)))
			angular.append(list(sum((s.inertia[0] * s.angVel + s.mass * (s.pos - base).cross(s.vel) for s in states), Vector3.Zero)))
		return np.array(energies), np.array(linear), np.array(angular)


class Bounces(EnergyScene):
	"""Cubes of mass and edge 1, turned at random, fall 1 m onto a floor each, and bounce there without end.

	:param Contact how: the contact
	:param steps: time steps in half a period of the contact
	:param number: of cubes
	:param overlap: of the first impact, were it central, over half the edge: gives the stiffness
	"""

	spacing, floor = 1000.0, 400.0
	"""Between the cubes; half the width of a floor [m]."""
	drop, gravity, radius = 1.0, 9.81, 0.5

	def __init__(self, how, steps, number=16, overlap=0.02, seed=5):
		self.number, self.overlap = number, overlap
		self.orientations = np.random.default_rng(seed).standard_normal((number, 4))
		self.begin(how, 2 * self.gravity * self.drop / (overlap * inscribedRadiusOfCube) ** 2, 1.0, steps)

	def build(self):
		height = math.sqrt(3) / 2 + self.drop
		if self.how.model == 'spheres':
			O.bodies.append(utils.wall(0, 2, sense=1))
			cubes = [utils.sphere((*self._place(k), height), self.radius) for k in range(self.number)]
			for cube in cubes:
				cube.state.mass, cube.state.inertia = 1, Vector3(0.1, 0.1, 0.1)
		else:
			for k in range(self.number):
				O.bodies.append(self.rounded(cuboid((*self._place(k), -1), (self.floor, self.floor, 1), fixed=True)))
			turns = [Quaternion(*q).normalized() for q in self.orientations]
			cubes = [self.rounded(cuboid((*self._place(k), height), 3 * (0.5,), turn)) for k, turn in enumerate(turns)]
		self.cubes = O.bodies.append(cubes)
		self.makeEngines()
		return self

	def _place(self, k):
		return self.spacing * (k % 4), self.spacing * (k // 4)

	def run(self, seconds=40.0, samples=100):
		"""Returns a dictionary of lists: time [s]; energy: of each cube at each time, over that at the start, both above lying still and
		flat on the floor (NaN within an impact, where the contact holds some); drift: way of each cube across the floor [m]."""
		start = self._energies()
		times, energies = [0.0], [(start / start).tolist()]
		for _ in range(samples):
			O.run(round(seconds / samples / self.timeStep), True)
			times.append(O.time)
			energies.append((self._energies() / start).tolist())
		places = [O.bodies[cube].state.pos for cube in self.cubes]
		drift = [math.dist((p[0], p[1]), self._place(k)) for k, p in enumerate(places)]
		return {'time': times, 'energy': energies, 'drift': drift}

	def _energies(self):
		"""Velocities are half a step older than places."""
		states = [O.bodies[cube].state for cube in self.cubes]
		late = Vector3(0, 0, -self.gravity * self.timeStep / 2) if O.iter else Vector3.Zero
		turning = [s.inertia[0] * s.angVel.squaredNorm() / 2 for s in states]
		energies = np.array(turning) + [s.mass * ((s.vel + late).squaredNorm() / 2 + self.gravity * (s.pos[2] - 0.5)) for s in states]
		return np.where([O.iter and O.forces.f(cube) != Vector3.Zero for cube in self.cubes], np.nan, energies)


def lastEnergies(found):
	"""Each cube's last energy outside an impact, of what Bounces.run() returned."""
	energies = np.array(found['energy'])
	last = len(energies) - 1 - np.argmax(np.isfinite(energies[::-1]), axis=0)
	return energies[last, np.arange(energies.shape[1])]


def spread(found):
	"""Of the collisions that touched and have parted, a dictionary: number, median, rms and largest error, largest gain,
	number that gained, and least, median and largest energy left over that of the start.

	:param found: what Collisions.run() returned
	"""
	error = np.array(found['error'])[np.array(found['touched']) & np.array(found['parted'])]
	size = np.abs(error)
	return {
		'number': len(error),
		'median': float(np.median(size)),
		'rms': float(np.sqrt(np.mean(size**2))),
		'largest': float(size.max()),
		'gain': float(error.max()),
		'gaining': int(np.count_nonzero(error > noticeable)),
		'left': [float(1 + q) for q in np.quantile(error, (0, 0.5, 1))],
	}
