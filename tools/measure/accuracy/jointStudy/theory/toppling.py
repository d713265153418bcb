# SPDX-License-Identifier: GPL-2.0-or-later
"""A block on a plane that is tilted, or shaken: slides or topples (Goodman & Bray 1976), on a rigid joint and on an elastic one.

Angles in radians, lengths in metres, forces in newtons. The plane dips towards the block's *toe*; the edge on the other side is the heel.
"""

import math

from scipy.optimize import minimize_scalar

__all__ = ['criticalTilt', 'elasticToppling', 'failureMode', 'rigidToppling']


def rigidToppling(width, height):
	"""Tangent of the tilt at which a rigid block begins to turn about its toe: width over height (Goodman & Bray 1976, Eq. 2)."""
	return width / height


def elasticToppling(width, height, pressing, stiffness, followsTilt=True):
	"""Tangent of the tilt at which a block topples on an elastic joint that takes no tension: the largest one at which there is equilibrium.

	A joint of normal stiffness kn per area under a block turned by θ carries the pressure kn θ x, x from where the joint opens to the toe:
	a wedge of the length L with the resultant N = ½ kn θ L² per unit of breadth, L/3 from the toe. Against it stands the weight, whose
	arm shrinks as the block leans. With the block's centre at X = (b cos θ − h sin θ)/2 behind the toe and Y = (h cos θ + b sin θ)/2 above
	it, and the toe L sin θ deep in the joint, equilibrium of moments about the resultant is

		T (Y − L sin θ) = N (X − L/3),        L = √(2 N / (kn θ)),

	and T/N = tan(tilt). It has its largest value at θ ~ (N/kn)^(1/3), where L/3 is twice the loss of lever arm by tilting, (h + b²/h) θ/2;
	beyond, the block falls. It lies below b/h by (N/kn)^(1/3) to first order, and reaches it for a rigid joint alone.

	:param float pressing: the block's weight per unit of breadth [N/m]
	:param float stiffness: kn [Pa/m]
	:param bool followsTilt: True: the plane is tilted, so that N is the weight times the cosine; False: it stays level and is accelerated
	:returns: tangent of the tilt, or acceleration of the base over that of gravity
	:raises ValueError: if the joint is so soft that the block would fall before its heel opens
	"""

	def tangent(turn, normal):
		length = math.sqrt(2 * normal / (stiffness * turn))
		behind = (width * math.cos(turn) - height * math.sin(turn)) / 2
		above = (height * math.cos(turn) + width * math.sin(turn)) / 2
		return (behind - length / 3) / (above - length * math.sin(turn))

	normal, found = pressing, 0.0
	for _ in range(100):
		low = min(2 * normal / (stiffness * width**2), 0.4)  # where the heel opens
		best = minimize_scalar(lambda log: -tangent(math.exp(log), normal), bounds=(math.log(low), math.log(0.5)), method='bounded')  # noqa: B023
		if best.x < math.log(low) + 1e-3:
			raise ValueError(f'stiffness: {stiffness:g} Pa/m is so soft that the block falls with its heel still closed')
		last, found = found, -best.fun
		normal = pressing * math.cos(math.atan(found)) if followsTilt else pressing
		if abs(found - last) < 1e-14:
			break
	return found


def failureMode(toppling, friction):
	"""(mode, tangent): 'slides' or 'topples', whichever comes first.

	:param float toppling: tangent of the tilt at which the block topples
	:param float friction: coefficient
	"""
	return ('slides', friction) if friction < toppling else ('topples', toppling)


def criticalTilt(width, height, frictionAngle, **elastic):
	"""(mode, angle) at which a block on a tilting plane fails.

	:param elastic: *pressing* and *stiffness* of :yref:`elasticToppling`; none: a rigid joint
	"""
	toppling = elasticToppling(width, height, **elastic) if elastic else rigidToppling(width, height)
	mode, tangent = failureMode(toppling, math.tan(frictionAngle))
	return mode, math.atan(tangent)
