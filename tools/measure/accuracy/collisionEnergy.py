# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy error of collisions without friction and damping: the contact surface, the paper's contact, YADE's own spheres.

Random meetings of two regular solids. Nothing but the normal force acts, so that all energy is kinetic again once the bodies have parted, whatever a
contact stores: the change of the kinetic energy is the contact's and the integrator's error. Regular solids have equal moments of inertia, which
YADE's integrator turns without an error of its own. Error against time step, and the damping with which no collision gains energy. Ends with 1 if
momentum is not kept, if an error that is the integrator's does not fall with the time step, or one that is the contact's does.

	./run python tools/measure/accuracy/collisionEnergy.py            # two minutes
	./run python tools/measure/accuracy/collisionEnergy.py --quick    # fewer meetings and steps: half a minute
"""

import dataclasses
import math
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; the study is small

import numpy as np
from tqdm import tqdm
from yade import (
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	ForceResetter,
	FrictMat,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Sphere_ScGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	NewtonIntegrator,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
	utils,
)
from yade._polytope import contact
from yade.polytope import regular

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012
from boon2012.falling.scene import circumradiusOfUnitVolume, solids
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import count, paperParser, shown
from boon2012.reporting.script import conclude

noticeable = 1e-6
"""Gains of energy below this part of the start's are not counted as such."""
surfaceMedian = 2e-5
"""Largest median error of the contact surface at 200 steps in half a period; (200/n)² times as much at n steps."""


@dataclasses.dataclass(frozen=True)
class Contact:
	"""*model*: a contactModel, or 'spheres', YADE's own. *corner*: corner radius over the inscribed radius, of boon2012. *damping*: of the contact's
	normal, fraction of critical."""

	model: str = 'surface'
	corner: float = 0.1
	damping: float = 0


paper, sharp, surface, spheres = 'boon2012', 'boon2012, corner radius 0', 'contact surface', "YADE's spheres"
contacts = {spheres: Contact('spheres'), surface: Contact(), sharp: Contact('boon2012', corner=0), paper: Contact('boon2012')}


@dataclasses.dataclass(frozen=True)
class Meeting:
	"""Two solids of volume and mass 1 that come towards each other at speed 1: numbers of faces, orientations (w, x, y, z), unit vector from the
	first to the second, offset of the second across it, angular velocities."""

	faces: list
	orientations: np.ndarray
	direction: np.ndarray
	offset: np.ndarray
	spins: np.ndarray


def meetings(number, seed=1, offset=0.5, spin=1.0):
	"""Random meetings of regular solids (4, 6, 8, 12 or 20 faces, edge of the cube of their volume 1).

	:param float offset: largest distance between the lines the centres move on
	:param float spin: largest component of the angular velocities
	"""
	random = np.random.default_rng(seed)

	def unit(vector):
		return vector / np.linalg.norm(vector)

	def one():
		faces = random.choice(list(solids.values()), 2).tolist()
		direction = unit(random.standard_normal(3))
		across = random.standard_normal(3)
		across = unit(across - direction * (across @ direction)) * offset * math.sqrt(random.random())
		return Meeting(faces, random.standard_normal((2, 4)), direction, across, random.uniform(-spin, spin, (2, 3)))

	return [one() for _ in range(number)]


class Collisions:
	"""All meetings in one scene, each pair far from the others: Collisions(meetings(200), Contact('boon2012'), steps=100).run()

	:param meetings: sequence of Meeting
	:param Contact how: the contact
	:param steps: time steps in half a period of the contact, π √(m/k)
	:param overlap: of a central impact, over half a cube's edge: gives the stiffness
	:param duration: half periods from first touch on
	"""

	spacing, gap = 20.0, 1e-3
	"""Spacing of the pairs; gap between the solids at the start."""
	radius = (3 / (4 * math.pi)) ** (1 / 3)
	"""Radius of a sphere of volume 1."""

	def __init__(self, meetings, how, steps, overlap=0.02, duration=40):
		O.reset()
		self.meetings, self.how, self.duration = meetings, how, duration
		stiffness = 0.5 / (overlap * 0.5) ** 2
		self.half = math.pi * math.sqrt(0.5 / stiffness)
		# Ip2_FrictMat_FrictMat_FrictPhys: kn = 2 E1 R1 E2 R2 / (E1 R1 + E2 R2)
		sphere = FrictMat(density=1, young=stiffness / self.radius, poisson=1, frictionAngle=0)
		O.materials.append(
			sphere
			if how.model == 'spheres'
			else RockJointMat(density=1, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0)
		)
		self.pairs = [self._pair(meeting, self._base(k)) for k, meeting in enumerate(meetings)]
		O.engines = self._engines()
		O.dt = self.half / steps

	def _engines(self):
		if self.how.model == 'spheres':
			bound, loop = (
				Bo1_Sphere_Aabb(),
				([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
			)
		else:
			geometry, physics = (
				Ig2_Polytope_Polytope_PolytopeGeom(contactModel=self.how.model),
				Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False),
			)
			bound, loop = (
				Bo1_Polytope_Aabb(),
				([geometry], [physics], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=self.how.damping)]),
			)
		collider = InsertionSortCollider([bound], verletDist=0)  # pairs are searched for in each step
		return [ForceResetter(), collider, InteractionLoop(*loop), NewtonIntegrator(damping=0)]

	def _base(self, k):
		columns = math.ceil(math.sqrt(len(self.meetings)))
		return self.spacing * np.array([k % columns, k // columns, 0])

	def _pair(self, meeting, base):
		if self.how.model == 'spheres':
			apart = math.sqrt((2 * self.radius + self.gap) ** 2 - meeting.offset @ meeting.offset)
			pair = [utils.sphere(tuple(place), self.radius) for place in (base, base + meeting.offset + apart * meeting.direction)]
		else:
			pair = [self._solid(faces, turn, base) for faces, turn in zip(meeting.faces, meeting.orientations, strict=True)]
			near, far = 0.0, 3.0  # no two of these solids reach so far
			for _ in range(50):
				middle = (near + far) / 2
				pair[1].state.pos = Vector3(*(base + meeting.offset + middle * meeting.direction))
				near, far = (middle, far) if contact(*pair).infeasibility < self.gap else (near, middle)
		for body, way, spin in zip(pair, (0.5, -0.5), meeting.spins, strict=True):
			body.state.vel, body.state.angVel = way * Vector3(*meeting.direction), Vector3(*spin)
		return tuple(O.bodies.append(pair))

	def _solid(self, faces, turn, place):
		body = regular(faces, circumradiusOfUnitVolume(faces), tuple(place), Quaternion(*turn).normalized())
		body.shape.cornerRadius = self.how.corner * body.shape.inscribedRadius
		return body

	def run(self):
		"""Runs until `duration` is over. Returns a dictionary of lists, a number a pair:

		error: change of the kinetic energy over that of the start; touched, parted: whether the two have met, and are free again at the
		end; momentum, angularMomentum: size of their change (mass × speed is 1); and contactTime: mean time under force of those that
		touched, in half periods.
		"""
		energy, linear, angular = self._state()
		every = max(1, round(self.half / O.dt / 20))
		steps = math.ceil(self.duration * self.half / O.dt)
		pressed = np.zeros(len(self.pairs), int)
		for step in range(steps):
			O.step()
			if step % every == 0 or step == steps - 1:
				now = np.array([O.forces.f(one) != Vector3.Zero for one, _ in self.pairs])
				pressed += now
		after, linearAfter, angularAfter = self._state()
		return {
			'error': after / energy - 1,
			'touched': pressed > 0,
			'parted': ~now,
			'momentum': np.linalg.norm(linearAfter - linear, axis=1),
			'angularMomentum': np.linalg.norm(angularAfter - angular, axis=1),
			'contactTime': float(pressed[pressed > 0].mean()) * every * O.dt / self.half,
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


def spread(found):
	"""How the errors of the collisions that touched and have parted are spread, a dictionary: number, median, rms and largest error, largest gain,
	number that gained, and least, median and largest energy left over that of the start.

	:param found: what Collisions.run() returned
	"""
	error = found['error'][found['touched'] & found['parted']]
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


def timeSteps(findings, several, quick):
	steps = (25, 50, 100) if quick else (25, 50, 100, 200)
	found = {
		name: {n: Collisions(several, how, n).run() for n in steps} for name, how in tqdm(contacts.items(), desc='time steps', disable=None)
	}
	spreads = {name: {n: spread(result) for n, result in bySteps.items()} for name, bySteps in found.items()}
	columns = ('median', 'rms', 'largest', 'gain', 'gaining', 'number')
	findings.table(
		'time_steps',
		'Energy error of random collisions of two regular solids without friction and damping, over the energy before: by time steps in half a period '
		'of the contact. Overlap of a central impact 2 % of the inscribed radius of a cube.',
		['contact', 'steps', *columns, 'mean time in contact [half periods]'],
		[
			[name, n, *(s[key] for key in columns), found[name][n]['contactTime']]
			for name, bySteps in spreads.items()
			for n, s in bySteps.items()
		],
	)
	row, first, last = findings.row, spreads[paper][steps[0]], spreads[paper][steps[-1]]
	row(f'{paper}: median error', last['median'], accept=(0.08, 0.25))
	row(f'{paper}: largest error', last['largest'], accept=(0.5, 5), note='depends on the sample')
	row(
		f'{paper}: median at {steps[0]} steps over that at {steps[-1]}',
		first['median'] / last['median'],
		theory=1,
		accept=(0.9, 1.1),
		note="the error is the contact's",
	)
	square = (steps[-1] / steps[0]) ** 2
	fall = spreads[surface][steps[0]]['rms'] / spreads[surface][steps[-1]]['rms']
	row(
		f'{surface}: root mean square at {steps[0]} steps over that at {steps[-1]}',
		fall,
		theory=square,
		accept=(square / 2, math.inf),
		note="the error is the integrator's",
	)
	for n in steps:
		row(f'{surface}: median error at {n} steps', spreads[surface][n]['median'], theory=0, accept=(0, surfaceMedian * (200 / n) ** 2))
	bound = max(s['largest'] / (math.pi / n) ** 2 * 4 for n, s in spreads[spheres].items())
	row(f'{spheres}: largest error over (ω Δt)²/4, at any time step', bound, theory=1, accept=(0, 1), note='bound of the leapfrog scheme')
	row(
		f'{sharp}: median error at 100 steps',
		spreads[sharp][100]['median'],
		accept=(0, 0.3 * spreads[paper][100]['median']),
		note='nearly a gradient while overlaps are small',
	)
	momentum = max(
		float(result[key].max()) for bySteps in found.values() for result in bySteps.values() for key in ('momentum', 'angularMomentum')
	)
	row('largest change of momentum or angular momentum in a collision', momentum, theory=0, accept=(0, 1e-8), note='mass × speed is 1')


def damping(findings, several, quick):
	fractions = (0, 0.05, 0.2, 1) if quick else (0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1)
	ours = {name: contacts[name] for name in (paper, sharp, surface)}
	found = {
		name: {z: spread(Collisions(several, dataclasses.replace(how, damping=z), 50).run()) for z in fractions}
		for name, how in tqdm(ours.items(), desc='damping', disable=None)
	}
	findings.table(
		'damping',
		'Energy left after a collision, over that before, by damping of the contact, as a fraction of critical. A central impact on a linear spring leaves '
		'exp(−2πζ/√(1 − ζ²)).',
		['contact', 'damping', 'least', 'median', 'most', 'collisions that gain', 'of'],
		[[name, z, *s['left'], s['gaining'], s['number']] for name, byDamping in found.items() for z, s in byDamping.items()],
	)
	for name, byDamping in found.items():
		least = next((z for z in fractions if all(byDamping[y]['gaining'] == 0 for y in fractions if y >= z)), None)
		said = f'of {list(fractions)}; gaining: {[s["gaining"] for s in byDamping.values()]}'
		findings.row(
			f'{name}: least damping at which no collision gains', 'none up to 1' if least is None else least, 'of critical', note=said
		)
	findings.row(f'{surface}: collisions that gain at {fractions[1]:g} of critical', found[surface][fractions[1]]['gaining'], accept=(0, 0))


def main(arguments=None):
	parser = paperParser(__doc__, quick='fewer meetings and steps')
	parser.set_defaults(output=pathlib.Path('output/accuracy/collisionEnergy'))
	parser.add_argument('--number', type=count, default=None, help='of meetings (200; quick: 60)')
	parser.add_argument('--seed', type=count, default=1, help='of the meetings')
	given = parser.parse_args(arguments)
	several = meetings(given.number or (60 if given.quick else 200), given.seed)
	findings = Findings('collisions', 'Energy of collisions', given.output, shown(given))
	timeSteps(findings, several, given.quick)
	damping(findings, several, given.quick)
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main(sys.argv[1:]))
