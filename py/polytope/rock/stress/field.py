# SPDX-License-Identifier: GPL-2.0-or-later
"""A stress field that is linear in space. Tension is positive, as in YADE and in polytope.bodyStress."""

import numpy as np

from ...precision import real

__all__ = ['StressField']

symmetry = 1e-9
"""How far a tensor may be from symmetric by rounding, over its largest component."""


class StressField:
	"""σ(x) = stress + x₀ gradient[0] + x₁ gradient[1] + x₂ gradient[2].

	:param stress: (3, 3) tensor at the origin [Pa]
	:param gradient: (3, 3, 3) its derivatives along x, y and z [Pa/m]; None: uniform
	:raises ValueError: naming *stress* or *gradient*
	"""

	def __init__(self, stress, gradient=None):
		self.origin = _tensors(
			stress, 'stress', (3, 3), 'a symmetric (3, 3) tensor [Pa], compression negative, for example numpy.diag((-4e6, -4e6, -6e6))'
		)
		what = 'three symmetric (3, 3) tensors, the derivatives of the stress along x, y and z [Pa/m]'
		self.slope = np.zeros((3, 3, 3)) if gradient is None else _tensors(gradient, 'gradient', (3, 3, 3), what)

	def at(self, point):
		"""(3, 3) tensor [Pa]; (n, 3, 3) of n points"""
		points = np.asarray(point, float)
		return self.origin + (points @ self.slope.reshape(3, 9)).reshape(*points.shape[:-1], 3, 3)

	@property
	def divergence(self):
		"""Force on a unit of volume [N/m³]"""
		return np.einsum('kik->i', self.slope)


def _tensors(given, name, shape, what):
	try:
		found = np.array([real(x) for x in np.array(given, dtype=object).ravel()], float).reshape(shape)
	except (TypeError, ValueError):
		raise ValueError(f'{name}: must be {what}') from None
	if not np.isfinite(found).all():
		raise ValueError(f'{name}: must be finite; {what}')
	if not np.abs(found - np.swapaxes(found, -1, -2)).max() <= symmetry * np.abs(found).max():
		raise ValueError(f'{name}: must be symmetric, or blocks would turn; {what}')
	return found
