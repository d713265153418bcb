# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of a few blocks whose answer is known, with one thing taken to the extreme. Every function gives rows of numbers."""

import dataclasses
import math

import numpy as np
from numpy.polynomial import Polynomial
from scipy.optimize import brentq
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
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
)
from yade.utils import kineticEnergy

__all__ = ['Scene', 'collide', 'rest', 'slide', 'stack', 'tower', 'vibrate']

gravity = 9.81
density = 2600.0


class Scene:
	"""An empty scene with the plug-in's engines; `failures` and `finite` check the result."""

	def __init__(self, model, pull=(0, 0, -gravity), damping=0.0, **law):
		O.reset()
		self.geometry = Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model)
		self.law = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(**law)
		loop = InteractionLoop([self.geometry], [Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)], [self.law])
		self.newton = NewtonIntegrator(gravity=pull, damping=damping)
		O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.01), loop, self.newton]

	def material(self, stiffness, weight=density, friction=30.0):
		return O.materials.append(
			RockJointMat(density=weight, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=math.radians(friction))
		)

	@property
	def failures(self):
		return self.geometry.stats()['failures']

	@property
	def finite(self):
		"""Whether every position, orientation and velocity is a number."""
		states = [body.state for body in O.bodies]
		return all(math.isfinite(x) for s in states for v in (s.pos, s.vel, s.angVel, s.ori) for x in v)


def floor(**body):
	return polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True, **body)


def touching(id1, id2):
	return O.interactions.has(id1, id2) and O.interactions[id1, id2].isReal


def force(id1, id2):
	"""Normal force along z of a contact, 0 where there is none [N]."""
	return O.interactions[id1, id2].phys.normalForce[2] if touching(id1, id2) else 0.0


@dataclasses.dataclass
class Stack:
	"""A block on a block on a floor, at rest."""

	lowerForce: float
	upperForce: float
	"""Relative errors of the contacts' normal forces."""
	lowerHeight: float
	upperHeight: float
	"""Errors of the blocks' heights over the upper contact's overlap."""
	speed: float
	"""Left, over that of a fall through the upper overlap."""
	failures: int
	finite: bool


def overlapOf(model, force, stiffness):
	"""How deep a face of 1 m² is pressed in by a force: force over stiffness with *boon2012*. With *surface* the energy is ½ k (6 W/V)², V and W the
	integrals of the least slack s and of s²/2 over the overlap (src/contact/SurfaceContact.hpp), a box whose volume of slacks above s is
	(1 − 2s)² (h − 2s)."""
	if model == 'boon2012':
		return force / stiffness
	volume = Polynomial([0, 0, 1 / 2, -1 / 3, 1 / 12]) / 2
	moment = Polynomial([0, 0, 0, 1 / 6, -1 / 6, 1 / 20]) / 4

	def excess(h):
		depth = 6 * moment(h) / volume(h)
		slope = 6 * (moment.deriv()(h) - moment(h) / volume(h) * volume.deriv()(h)) / volume(h)
		return depth * slope - force / stiffness

	return brentq(excess, 0.5 * force / stiffness, min(2 * force / stiffness, 0.5), xtol=1e-300, rtol=1e-15)


def stack(model, stiffnessRatio=1.0, massRatio=1.0, away=0.1, settle=100, most=1000000):
	"""Upper block on lower one on a floor. The joint below is stiffnessRatio times as stiff as the upper block's, the upper block
	massRatio times as heavy as the lower one; starts with overlaps smaller than at rest (closed form) by the fraction *away* and settles
	under the law's own damping, for *settle* times the slowest √(m/k), but no more than *most* steps."""
	scene = Scene(model, normalDamping=1, shearDamping=1, rockingDamping=1)
	soft = 1e8
	hard = soft * stiffnessRatio
	below = scene.material(hard, density / massRatio)
	above = scene.material(soft, density)
	light, heavy = density / massRatio, density
	between = soft if stiffnessRatio == 1 else 2 * soft * hard / (soft + hard)
	overlaps = overlapOf(model, (light + heavy) * gravity, hard), overlapOf(model, heavy * gravity, between)
	heights = 0.5 - overlaps[0], 1.5 - overlaps[0] - overlaps[1]
	O.bodies.append([floor(material=below)])
	O.bodies.append(polytope.cuboid((0.1, 0.2, heights[0] + away * overlaps[0]), (0.5, 0.5, 0.5), material=below))
	O.bodies.append(polytope.cuboid((0.1, 0.2, heights[1] + away * sum(overlaps)), (0.5, 0.5, 0.5), material=above))
	O.dt = 0.1 * math.sqrt(light / (hard + between))
	slowest = math.sqrt(heavy / min(hard, between))
	O.run(min(int(settle * slowest / O.dt) + 2000, most), True)
	lower, upper = O.bodies[1].state, O.bodies[2].state
	return Stack(
		force(0, 1) / ((light + heavy) * gravity) - 1,
		force(1, 2) / (heavy * gravity) - 1,
		(lower.pos[2] - heights[0]) / overlaps[1],
		(upper.pos[2] - heights[1]) / overlaps[1],
		max(lower.vel.norm(), upper.vel.norm()) / math.sqrt(2 * gravity * overlaps[1]),
		scene.failures,
		scene.finite,
	)


@dataclasses.dataclass
class Collision:
	momentum: float
	"""Change, over the moving body's momentum before."""
	energy: float
	"""Relative change of kinetic energy."""
	speed: float
	"""Relative error of the light body's speed afterwards (closed form)."""
	parted: bool
	failures: int
	finite: bool


def collide(model, massRatio, lightMoves=True, turn=(0.3, -0.5, 0.8)):
	"""A cube meets another one face on face without friction and damping, one massRatio times as heavy as the other."""
	scene = Scene(model, pull=(0, 0, 0))
	stiffness, masses = 1e8, (massRatio, 1.0)
	materials = [scene.material(stiffness, mass, friction=0) for mass in masses]
	orientation = Quaternion(turn, 0.7)
	axis = orientation * Vector3(0, 0, 1)
	gap = 1e-6
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5), orientation, material=materials[0]))
	O.bodies.append(polytope.cuboid(axis * (1 + gap), (0.5, 0.5, 0.5), orientation, material=materials[1]))
	moving = 1 if lightMoves else 0
	speed = 0.1
	O.bodies[moving].state.vel = axis * (-speed if lightMoves else speed)
	before = kineticEnergy()
	reduced = massRatio / (1 + massRatio)
	O.dt = 0.02 * math.sqrt(reduced / stiffness)
	touched = False
	for _ in range(60):
		O.run(20, True)
		touched = touched or touching(0, 1)
		if touched and not touching(0, 1):
			break
	velocities = [body.state.vel.dot(axis) for body in O.bodies]
	momentum = masses[0] * velocities[0] + masses[1] * velocities[1]
	given = masses[moving] * (-speed if lightMoves else speed)
	# elastic: the light body's speed afterwards
	light = speed * (massRatio - 1) / (massRatio + 1) if lightMoves else speed * 2 * massRatio / (massRatio + 1)
	return Collision(
		momentum / given - 1,
		kineticEnergy() / before - 1,
		(velocities[1] - light) / speed,
		touched and not touching(0, 1),
		scene.failures,
		scene.finite,
	)


@dataclasses.dataclass
class Vibration:
	timeStep: float
	"""Time step over 2 √(m/k), the limit of the central difference scheme for the block on its contact."""
	growth: float
	"""Largest distance from rest over that at the start, in all steps."""
	energyGrowth: float
	"""Largest kinetic energy over the first swing's energy ½ k a²."""
	statuses: str
	"""Other than contact and separated that occurred."""
	failures: int
	finite: bool


def vibrate(model, fraction, steps=2000):
	"""A block swings on a floor about its rest, undamped, with a time step of *fraction* times polytope.stableTimeStep(2)."""
	scene = Scene(model)
	stiffness = 1e8
	scene.material(stiffness)
	overlap = density * gravity / stiffness
	amplitude = 0.1 * overlap
	O.bodies.append([floor(), polytope.cuboid((0.1, 0.2, 0.5 - overlap), (0.5, 0.5, 0.5))])
	block = O.bodies[1].state
	low = 0.5 - overlap
	block.pos = Vector3(0.1, 0.2, low - amplitude)
	O.dt = 1e-9
	O.step()  # makes the contact
	O.dt = polytope.stableTimeStep(2) * fraction
	block.pos, block.ori = Vector3(0.1, 0.2, low + amplitude), Quaternion.Identity
	block.vel = block.angVel = Vector3(0, 0, 0)
	farthest = energy = 0.0
	scene.geometry.resetStats()
	for _ in range(steps):
		O.step()
		away = abs(block.pos[2] - low)
		farthest, energy = max(farthest, away), max(energy, kineticEnergy())
		if not math.isfinite(away):
			break
	seen = {name for name, number in scene.geometry.stats()['statuses'].items() if number} - {'contact', 'separated'}
	return Vibration(
		O.dt / (2 * math.sqrt(density / stiffness)),
		farthest / amplitude,
		energy / (0.5 * stiffness * amplitude**2),
		' '.join(sorted(seen)),
		scene.failures,
		scene.finite,
	)


@dataclasses.dataclass
class Tower:
	force: float
	"""Largest relative error of a contact's normal force."""
	sideways: float
	"""Largest way of a block across the vertical since it was placed [m]; blocks are 1 m wide."""
	tilt: float
	"""Largest tilt [rad]."""
	settlement: float
	"""Settlement of the top block less what the overlaps at rest add up to, over that sum."""
	speed: float
	"""Largest speed left [m/s]."""
	failures: int
	finite: bool


def tower(model, blocks=50, steps=30000, seed=1):
	"""Cubes of 1 m on top of each other, each up to 2 cm aside, placed with the overlaps that carry what lies above on aligned ones."""
	scene = Scene(model, damping=0.2, normalDamping=0.5, shearDamping=0.5, rockingDamping=0.5)
	stiffness = 1e10  # at a tenth of it the column buckles under its weight, see sceneExtremes.py
	scene.material(stiffness)
	weight = density * gravity
	aside = np.random.default_rng(seed).uniform(-0.02, 0.02, (blocks, 2))
	O.bodies.append(floor())
	height = 0.0
	for k in range(blocks):
		height -= (blocks - k) * weight / stiffness
		O.bodies.append(polytope.cuboid((*aside[k], height + k + 0.5), (0.5, 0.5, 0.5)))
	O.dt = 0.1 * math.sqrt(density / (2 * stiffness))
	O.run(steps, True)
	errors = [force(k, k + 1) / ((blocks - k) * weight) - 1 for k in range(blocks)]
	states = [O.bodies[k + 1].state for k in range(blocks)]
	sideways = [math.hypot(s.pos[0] - x, s.pos[1] - y) for s, (x, y) in zip(states, aside, strict=True)]
	tilts = [math.acos(min(1.0, (s.ori * Vector3(0, 0, 1))[2])) for s in states]
	settled = (states[-1].pos[2] - (blocks - 0.5)) / height - 1
	speeds = [s.vel.norm() for s in states]
	return Tower(max(map(abs, errors)), max(sideways), max(tilts), settled, max(speeds), scene.failures, scene.finite)


@dataclasses.dataclass
class Rest:
	steps: int
	position: float
	"""Way from where it was at the start [m]; the block is 1 m wide."""
	turn: float
	"""Angle from how it stood [rad]."""
	energy: float
	"""Kinetic, over what lifting the block by its overlap takes."""


def rest(model, steps, undamped=True):
	"""A block that has come to rest on a floor, turned in space; then left alone without damping. Rows at growing numbers of steps."""
	turn = Quaternion((1, 2, 3), 0.4)
	up = turn * Vector3(0, 0, 1)
	scene = Scene(model, pull=up * -gravity, damping=0.5, normalDamping=1, shearDamping=1, rockingDamping=1)
	stiffness = 1e8
	scene.material(stiffness)
	overlap = density * gravity / stiffness
	O.bodies.append(polytope.cuboid(up * -1, (5, 5, 1), turn, fixed=True))
	O.bodies.append(polytope.cuboid(turn * Vector3(0.3, 0.2, 0.5 - overlap), (0.5, 0.5, 0.5), turn))
	O.dt = 0.1 * math.sqrt(density / stiffness)
	O.run(20000, True)
	if undamped:
		scene.newton.damping = 0
		scene.law.normalDamping = scene.law.shearDamping = scene.law.rockingDamping = 0
	state = O.bodies[1].state
	place, pose = Vector3(state.pos), Quaternion(state.ori)
	rows, done = [], 0
	for target in sorted({max(1, round(steps / 10**k)) for k in np.arange(3, -0.1, -0.5)}):
		O.run(int(target - done), True)
		done = target
		between = pose.conjugate() * state.ori
		angle = 2 * math.asin(min(1.0, math.hypot(*[between[k] for k in range(3)])))
		rows.append(Rest(target, (state.pos - place).norm(), angle, kineticEnergy() / (density * gravity * overlap)))
	return rows, scene.failures, scene.finite


@dataclasses.dataclass
class Slide:
	steps: int
	distance: float
	"""Slid so far [m]."""
	distanceError: float
	speedError: float
	"""Relative, to a block that slides without rocking: ½ a t² and a t, a = g (sin α − tan φ cos α)."""
	tilt: float
	"""Angle between the block's and the slope's normal [rad]."""


def slide(model, steps, slope=30.5, friction=30.0):
	"""A flat block slides down a long slope, half a degree steeper than its friction angle. Rows at growing numbers of steps."""
	stiffness, half = 1e10, (0.5, 0.5, 0.1)
	mass = density * 8 * half[0] * half[1] * half[2]
	step = 0.1 * math.sqrt(mass / stiffness)
	a = gravity * (math.sin(math.radians(slope)) - math.tan(math.radians(friction)) * math.cos(math.radians(slope)))
	length = 0.5 * a * (steps * step) ** 2
	turn = Quaternion((0, 1, 0), math.radians(slope))
	along, up = turn * Vector3(1, 0, 0), turn * Vector3(0, 0, 1)
	scene = Scene(model, damping=0, normalDamping=1, shearDamping=1, rockingDamping=1)
	scene.material(stiffness, friction=60)
	overlap = mass * gravity * math.cos(math.radians(slope)) / stiffness
	O.bodies.append(polytope.cuboid(along * (length / 2) - up, (length / 2 + 2, 2, 1), turn, fixed=True))
	O.bodies.append(polytope.cuboid(up * (half[2] - overlap), half, turn))
	O.dt = step
	scene.newton.damping = 0.7
	O.run(5000, True)  # comes to rest, held by friction
	scene.newton.damping = 0
	O.interactions[0, 1].phys.tangensOfFrictionAngle = math.tan(math.radians(friction))
	state = O.bodies[1].state
	start, begun, rows, done = state.pos.dot(along), O.time, [], 0
	for target in sorted({max(100, round(steps / 10**k)) for k in np.arange(2, -0.1, -0.25)}):
		O.run(int(target - done), True)
		done = target
		time, distance = O.time - begun, state.pos.dot(along) - start
		tilt = math.acos(max(-1.0, min(1.0, (state.ori * Vector3(0, 0, 1)).dot(up))))
		rows.append(Slide(target, distance, distance / (0.5 * a * time**2) - 1, state.vel.dot(along) / (a * time) - 1, tilt))
	return rows, scene.failures, scene.finite and touching(0, 1)
