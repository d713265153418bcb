# SPDX-License-Identifier: GPL-2.0-or-later
"""The least strength that joints lack: a second-order cone program, by an interior-point method.

	minimise λ  with  A r = −load,  |t| ≤ μ n + c + λ a,  n ≥ −(σ + λ a),  λ ≥ 0

for forces r = (n, t) at the corners of joints; a: part of the area that a corner stands for. The mass stands where λ is 0. The multipliers
of equilibrium are the velocities of the blocks: how it fails where λ > 0 (static and kinematic theorem of limit analysis).

Primal-dual path following with the scaling of Nesterov and Todd and Mehrotra's corrector, as in L. Vandenberghe (2010), The CVXOPT linear
and quadratic cone program solvers; its equations are solved for the blocks' velocities, whose matrix is that of the stiffness of springs at
the corners.
"""

import dataclasses

import numpy as np

from .cones import Cones, Scaling, product, quotient

__all__ = ['LeastStrength', 'leastStrength']

almost = 0.99
"""Part of the way to the boundary of the cones that a step takes."""
mostSteps = 150
shallow = 1e-3
"""Depth within the cones below which a first point is moved into them."""
balanced = 1e-6
"""Largest force that may be missing to equilibrium, over the mean weight."""
none = 1e-7
"""Least strength below which none is missing, in the units of *leastStrength*, where a mean block that is 1 % too weak lacks some 1e-3."""
atLimit = 1e-5
"""Least strength, in the units of *leastStrength*, below which a factor is the limit itself to 1e-4: there rounding may end the steps
before the bounds meet, and the last point in equilibrium is the answer."""
gap = 0.01
"""Relative difference of bounds on the least strength, at which it is known: it is above 0, and leads to the next factor."""


@dataclasses.dataclass
class LeastStrength:
	value: float
	"""λ"""
	forces: np.ndarray
	"""(corners, 3)"""
	motion: np.ndarray
	"""(6 blocks,) velocities, of any size"""
	openings: np.ndarray
	"""(corners, 2) multipliers: how much a joint's normal force, and its tensile strength, take part in the motion"""
	steps: int

	@property
	def isZero(self):
		"""Whether no strength is missing."""
		return self.value < none


class _Program:
	"""G and h of G x + s = h, x = (forces, λ), and solutions of its equations."""

	def __init__(self, equilibrium, load, friction, cohesion, tension, share):
		self.equilibrium, self.load = equilibrium, load
		self.friction, self.share = friction, share
		self.limits = Cones(np.column_stack([cohesion, np.zeros((len(cohesion), 2))]), np.append(tension, 0.0))

	def within(self, forces, lack):
		"""−G x"""
		more = self.share * lack
		return Cones(np.column_stack([self.friction * forces[:, 0] + more, forces[:, 1:]]), np.append(forces[:, 0] + more, lack))

	def back(self, z):
		"""−Gᵀ z"""
		forces = z.round.copy()
		forces[:, 0] = self.friction * z.round[:, 0] + z.plain[:-1]
		return forces, float(self.share @ (z.round[:, 0] + z.plain[:-1]) + z.plain[-1])

	def factorise(self, scaling):
		"""Solver of Aᵀ y + Gᵀ z = bx, A x = by, G x − W² z = bz: a function of (bx, its part of λ, by, bz).

		Without λ, forces at a corner and its slip are as of a spring, H = Gᵀ W⁻² G. Its inverse, and what λ adds, are written out: terms of
		many orders of magnitude would cancel in numbers.
		"""
		friction, share, w = self.friction, self.share, scaling.w
		round2, plain2 = scaling.size**2, 1 / scaling.plain**2
		d, onlyLack = plain2[:-1], float(plain2[-1])
		first = round2 * (2 * w[:, 0] ** 2 - 1)
		least = friction**2 + d * first
		flexibility = np.empty((len(w), 3, 3))
		flexibility[:, 0, 0] = first / least
		flexibility[:, 0, 1:] = flexibility[:, 1:, 0] = (2 * round2 * friction * w[:, 0] / least)[:, None] * w[:, 1:]
		flexibility[:, 1:, 1:] = round2[:, None, None] * (
			np.eye(2) + (2 * (friction**2 - d * round2) / least)[:, None, None] * w[:, 1:, None] * w[:, None, 1:]
		)
		byLack = np.column_stack(
			[share * (friction + d * first) / least, (-2 * round2 * w[:, 0] * share * d * (1 - friction) / least)[:, None] * w[:, 1:]]
		)
		stiffness = onlyLack + float((share**2 * (1 - friction) ** 2 * d / least).sum())
		solve = self.equilibrium.factorise(flexibility)
		ofLack = self.equilibrium.resultants(byLack)
		motionOfLack = solve(ofLack)
		pivot = stiffness + float(ofLack @ motionOfLack)

		def bent(forces):
			return (flexibility @ forces[:, :, None])[:, :, 0]

		def step(bx, bLack, by, bz):
			pressed, pressedLack = self.back(scaling.over2(bz))
			right, rightLack = bx - pressed, bLack - pressedLack
			motion = solve(self.equilibrium.resultants(bent(right)) - by)
			lack = (rightLack - float((byLack * right).sum()) + float(ofLack @ motion)) / pivot
			motion = motion - motionOfLack * lack
			forces = bent(right - self.equilibrium.slips(motion)) - byLack * lack
			return forces, lack, motion, -scaling.over2(self.within(forces, lack) + bz)

		def refined(bx, bLack, by, bz):
			"""The same, with what rounding has left solved for once more."""
			forces, lack, motion, z = step(bx, bLack, by, bz)
			back, backLack = self.back(z)
			more = step(
				bx - self.equilibrium.slips(motion) + back,
				bLack + backLack,
				by - self.equilibrium.resultants(forces),
				bz + self.within(forces, lack) + scaling.times(scaling.times(z)),
			)
			return forces + more[0], lack + more[1], motion + more[2], z + more[3]

		return refined


class _Point:
	"""Forces, λ, motion, and s and z within the cones, on the way to the least λ."""

	def __init__(self, program):
		"""The least s and the least z that satisfy the equations, moved into the cones."""
		self.program, corners = program, len(program.share)
		one = Cones.unit(corners, corners + 1)
		solve = program.factorise(Scaling(one, one))
		self.forces, self.lack, self.motion, z = solve(np.zeros((corners, 3)), -1.0, -program.load, program.limits)
		self.s, self.z = (v if v.depth() > shallow else v + (1 - v.depth()) * one for v in (-z, z))

	def measure(self):
		"""By how much equations are not satisfied, and the bound that the motion gives."""
		program, equilibrium = self.program, self.program.equilibrium
		back, backLack = program.back(self.z)
		self.offForces, self.offLack = equilibrium.slips(self.motion) - back, 1 - backLack
		self.offLoad = equilibrium.resultants(self.forces) + program.load
		self.offLimits = self.s - program.within(self.forces, self.lack) - program.limits
		self.unbalanced = max(float(np.abs(self.offLoad).max()), self.offLimits.largest())
		bound = (float(self.motion @ program.load) - program.limits.dot(self.z)) / backLack
		error = abs(float((self.offForces * self.forces).sum())) / backLack  # of the bound, where slips are not quite those of the motion
		stands = self.lack < none
		fails = bound > none and max(self.lack - bound, error) < gap * bound
		self.isBalanced = self.unbalanced < balanced
		self.isFound = self.isBalanced and (stands or fails)

	def answer(self, steps):
		openings = np.column_stack([self.z.round[:, 0], self.z.plain[:-1]])
		return LeastStrength(self.lack, self.forces, self.motion, openings, steps)

	def advance(self):
		"""One step of the predictor and corrector."""
		scaling = Scaling(self.s, self.z)
		solve, at, corners = self.program.factorise(scaling), scaling.point, len(self.program.share)

		def direction(wanted, part):
			"""Step towards products s ∘ z that change by *wanted*, which takes away this part of what equations are off by."""
			u = quotient(at, wanted)
			*step, dz = solve(-part * self.offForces, -part * self.offLack, -part * self.offLoad, -part * self.offLimits - scaling.times(u))
			scaledZ = scaling.times(dz)
			return step, dz, u - scaledZ, scaledZ

		square = product(at, at)
		*_, scaledS, scaledZ = direction(-square, 1.0)
		centring = (1 - min(1.0, scaling.room(scaledS), scaling.room(scaledZ))) ** 3
		centre = centring * self.s.dot(self.z) / (2 * corners + 1)
		wanted = centre * Cones.unit(corners, corners + 1) - square - product(scaledS, scaledZ)
		(forces, lack, motion), dz, scaledS, scaledZ = direction(wanted, 1 - centring)
		room = min(1.0, almost * min(scaling.room(scaledS), scaling.room(scaledZ)))
		self.forces, self.lack, self.motion = self.forces + room * forces, self.lack + room * lack, self.motion + room * motion
		self.s, self.z = self.s + room * scaling.times(scaledS), self.z + room * dz


def leastStrength(equilibrium, load, friction, cohesion, tension, share, told=lambda point: None):
	"""λ for these strengths.

	:param equilibrium: *Equilibrium* of n blocks
	:param load: (6 n,) forces and moments on blocks, in units in which a mean weight is about 1
	:param friction: (corners,) tan φ
	:param cohesion: (corners,) shear strength without normal force
	:param tension: (corners,) tensile strength
	:param share: (corners,) a, about 1 on average
	:param told: called before each step
	:raises ArithmeticError: there is none, since nothing holds the blocks, or rounding leaves none to be found
	"""
	point, last = _Point(_Program(equilibrium, load, friction, cohesion, tension, share)), None
	for steps in range(mostSteps):
		with np.errstate(invalid='ignore', divide='ignore', over='ignore'):  # beyond what rounding allows; seen below
			point.measure()
		told(point)
		if point.isFound:
			return point.answer(steps)
		if point.isBalanced and point.lack < atLimit:
			last = point.answer(steps)
		if not np.isfinite(point.lack):
			break
		with np.errstate(invalid='ignore', divide='ignore', over='ignore'):
			point.advance()
	if last:
		return last
	raise ArithmeticError(f'after {steps} steps forces of up to {point.unbalanced:.2g} of the mean load are not balanced')
