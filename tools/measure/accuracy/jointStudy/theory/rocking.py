# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid block that rocks about its toes on a rigid base (Housner 1963, Bull. Seismol. Soc. Am. 53:403-417).

The block of width b and height h has the half diagonal R = ½ √(b² + h²), the angle α = atan(b/h) between that and the vertical, and,
turning about a toe with the moment of inertia 4/3 m R², θ'' = −p² sin(α − θ), p² = 3g/(4R).
"""

import math

from scipy.integrate import quad

__all__ = ['housnerPeriod', 'rockingFrequency', 'rockingPeriod', 'slenderness']


def slenderness(width, height):
	"""α, the tilt at which the block stands on its toe with its centre above it [rad]."""
	return math.atan2(width, height)


def rockingFrequency(width, height, gravity=9.81):
	"""p = √(3g/4R) [1/s]."""
	return math.sqrt(3 * gravity / (2 * math.hypot(width, height)))


def housnerPeriod(width, height, tilt, gravity=9.81):
	"""Period of free rocking from the tilt θ₀, T = (4/p) acosh(1/(1 − θ₀/α)) (Housner 1963, Eq. 5), sin(α − θ) taken as α − θ [s]."""
	_check(width, height, tilt)
	return 4 / rockingFrequency(width, height, gravity) * math.acosh(1 / (1 - tilt / slenderness(width, height)))


def rockingPeriod(width, height, tilt, gravity=9.81):
	"""Period of free rocking without that approximation: four times the fall from θ₀ to 0, ½ θ'² = p² (cos(α − θ₀) − cos(α − θ)) [s].

	With θ = θ₀ − u² the integrand has no singularity at the start."""
	_check(width, height, tilt)
	alpha, p = slenderness(width, height), rockingFrequency(width, height, gravity)

	def integrand(u):
		# cos(α − θ₀) − cos(α − θ₀ + u²), without cancellation
		drop = 2 * math.sin(alpha - tilt + u * u / 2) * math.sin(u * u / 2)
		return 2 * u / (p * math.sqrt(2 * drop)) if u > 0 else 2 / (p * math.sqrt(2 * math.sin(alpha - tilt)))

	return 4 * quad(integrand, 0, math.sqrt(tilt), epsabs=0, epsrel=1e-10)[0]


def _check(width, height, tilt):
	if not 0 < tilt < slenderness(width, height):
		raise ValueError(
			f'tilt: must be above 0 and below the angle at which the block falls, {slenderness(width, height):g}, got {tilt!r}'
		)
