# SPDX-License-Identifier: GPL-2.0-or-later
"""How bodies look in a picture: colours by a value, and what is drawn solid, translucent or as edges."""

import functools
import math

import numpy as np
from yade import Polytope

from ..scene.vertices import localVertices, reachOfWalls, rows, worldVertices
from .camera import unit

__all__ = [
	'colorMap',
	'colors',
	'colorsWithoutValue',
	'endsOf',
	'rgbOf',
	'shadesFor',
	'styles',
	'typicalRadius',
	'usualFixedColor',
	'valueFunction',
]

colorMap = ['#1d4e79', '#3380a8', '#86bcbb', '#f0e4ba', '#f2a541', '#c8451b']
"""Low to high; dark to light to warm, so that it is readable in grey and for colour-blind readers as well."""

shades = 256
"""Shades of the colour map that are told apart."""

usualFixedColor = (0.86, 0.86, 0.84)


_values = {
	'speed': lambda body: body.state.vel.norm(),
	'size': lambda body: (body.state.mass / body.material.density) ** (1 / 3),
	'displacement': lambda body: (body.state.pos - body.state.refPos).norm(),
}


def colors(bodies, colorBy, valueRange, up, fixedColor):
	"""Ends of the scale, and the function from a body to its colour."""
	value = valueFunction(colorBy, up)
	plain = colorsWithoutValue(colorBy, fixedColor)
	if value is None:
		return 0, 1, plain
	moving = {body.id: float(value(body)) for body in bodies if body.dynamic}
	low, high = endsOf(min(moving.values(), default=0), max(moving.values(), default=1), valueRange)
	shade = dict(zip(moving, map(tuple, shadesFor(list(moving.values()), low, high).tolist()), strict=True))
	return low, high, lambda body: shade[body.id] if body.dynamic else plain(body)


def valueFunction(colorBy, up):
	"""The function from a body to the value that its colour stands for; None for each body's own colour."""
	if colorBy == 'color':
		return None
	known = {**_values, 'height': lambda body: sum(float(u * x) for u, x in zip(up.tolist(), body.state.pos, strict=True))}
	value = colorBy if callable(colorBy) else known.get(colorBy)
	if value is None:
		raise ValueError(f"colorBy: must be 'color', a function, or one of {sorted(known)}, not {colorBy!r}")
	return value


def colorsWithoutValue(colorBy, fixedColor):
	"""The function from a body to its colour where that follows no value."""
	if isinstance(fixedColor, str) and fixedColor != 'own':
		raise ValueError(f"fixedColor: must be RGB or 'own', not {fixedColor!r}")
	own = colorBy == 'color' or isinstance(fixedColor, str)
	return lambda body: body.shape.color if own else fixedColor


def endsOf(least, greatest, valueRange):
	"""Ends of the colour scale, for values from the least to the greatest."""
	low, high = valueRange or (least, greatest)
	if valueRange is None and 0 < low < 0.1 * high:
		low = 0
	return low, high


def shadesFor(values, low, high):
	"""RGB in 0…1 for each of the values, (n, 3); for what is not a number that of the lowest."""
	share = np.nan_to_num((np.asarray(values) - low) / (high - low or 1), nan=0.0)
	return _shades()[np.rint(np.clip(share, 0, 1) * (shades - 1)).astype(int)]


def rgbOf(colors):
	"""(n, 3) in 0…1 of colours like '#1d4e79'."""
	return np.array([[int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)] for color in colors])


@functools.lru_cache
def _shades():
	"""The colour map at so many values, (shades, 3)."""
	known = rgbOf(colorMap)
	at = np.linspace(0, 1, shades)
	places = np.linspace(0, 1, len(known))
	return np.stack([np.interp(at, places, channel) for channel in known.T], axis=-1)


def styles(bodies, fixed, view, up, flat):
	"""The function from a body to the way it is drawn."""
	if callable(fixed):
		return lambda body: 'solid' if body.dynamic else fixed(body)
	if fixed not in ('auto', 'solid', 'glass', 'wire', 'hidden'):
		raise ValueError(f"fixed: must be 'auto', 'solid', 'glass', 'wire', 'hidden' or a function, not {fixed!r}")
	if fixed == 'auto' and flat:
		fixed = 'solid'
	if fixed != 'auto':
		return lambda body: 'solid' if body.dynamic else fixed
	moving = rows(body.state.pos for body in bodies if body.dynamic)
	if not len(moving):
		return lambda body: 'solid'
	middle = np.median(moving, axis=0)  # one that has fallen off does not count
	room = reachOfWalls(bodies)

	def style(body):
		if body.dynamic:
			return 'solid'
		points = worldVertices(body, room)
		if not len(points):
			return 'hidden'
		nearest = np.clip(middle, points.min(axis=0), points.max(axis=0))  # of the body's box
		way = unit(nearest - middle + 1e-12 * view)
		if way @ up < -math.sqrt(0.5):
			return 'solid'
		return 'wire' if way @ view > 0 else 'glass'

	return style


def typicalRadius(bodies):
	"""Median of the half-extent of the moving bodies (of all, if none moves): the reach of the soft shading."""
	several = [body for body in bodies if body.dynamic] or bodies
	return float(np.median([_reach(body.shape) for body in several])) or 1.0


def _reach(shape):
	"""Distance of the farthest vertex from the body's position [m]."""
	return float(shape.circumscribedRadius) if isinstance(shape, Polytope) else np.linalg.norm(localVertices(shape), axis=1).max(initial=0)
