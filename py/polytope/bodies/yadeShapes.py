# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres and facets of YADE's with the arguments that all bodies have here."""

from yade import utils

from ..arguments import flag, maskOf, materialOf, vector
from .polytopes import randomColor, randomColour

__all__ = ['facetOf', 'sphereOf']


def sphereOf(center, radius, *, fixed=False, wire=False, **body):
	"""yade.utils.sphere; refuses as bodyOf() does. *cornerRadius* has no meaning for it and is passed over."""
	return _made(utils.sphere, (center, float(radius)), fixed, wire, **body)


def facetOf(corners, *, fixed=True, wire=False, **body):
	"""yade.utils.facet, filled unless *wire* is True."""
	return _made(utils.facet, (corners,), fixed, wire, **body)


def _made(
	make, place, fixed, wire, *, material=-1, color=None, highlight=False, mask=1, cornerRadius=None, velocity=None, angularVelocity=None
):
	given = None if color is None else vector(color, 'color')
	body = make(
		*place,
		fixed=flag(fixed, 'fixed'),
		wire=flag(wire, 'wire'),
		highlight=flag(highlight, 'highlight'),
		material=materialOf(material),
		mask=maskOf(mask),
		color=randomColour() if given is None or tuple(given) == randomColor else given,
	)
	for name, value, attribute in (('velocity', velocity, 'vel'), ('angularVelocity', angularVelocity, 'angVel')):
		if value is not None:
			setattr(body.state, attribute, vector(value, name))
	return body
