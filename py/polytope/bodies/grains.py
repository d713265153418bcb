# SPDX-License-Identifier: GPL-2.0-or-later
"""Random angular grains: one, a sample after a sieve curve, and a cloud of them without overlap."""

import math
import numbers

import numpy as np
from tqdm import tqdm
from yade import Body, Polytope, Sphere, Vector3, _polytope

from ..arguments import materialOf, number, positive, randomOf, vector
from .grainShapes import cornersOf, partsOfLoose, pointsOnAnEllipsoid, shapesOf, turnOf
from .inSphere import depthInSphere
from .polytopes import builder, fromVertices

__all__ = ['cloud', 'grains', 'randomGrain']

curveError = 0.01
"""Deviation from the sieve curve, over the whole mass, above which a sample is refused."""
inMillimetres = 2
"""Opening [m] of the largest sieve above which the curve's sizes were perhaps meant in mm: no sieve is so large."""
mostGrains = 10_000_000
"""The most that one call makes: a script that asks for more has mistaken its units."""
trialShapes = 200
"""Shapes whose mean volume is taken, for a sample of a given number of grains: its error is a percent or so."""
tries = 500
"""Random places for each body of a cloud."""
fewestVertices, mostVertices = 4, 200


@builder
def randomGrain(size, elongation=1, flatness=1, vertices=14, seed=None, **body):
	"""A convex grain whose vertices lie on an ellipsoid, with random faces. Its long axis is x, its short axis z, before it is turned.

	:param float size: intermediate extent [m]: the square opening of a sieve that it just passes
	:param float elongation: intermediate over longest extent, above 0, at most 1
	:param float flatness: shortest over intermediate extent, above 0, at most 1
	:param int vertices: 4 to 200
	:param int seed: of the random numbers
	:raises ValueError: naming the argument
	"""
	size = positive(size, 'size')
	random = randomOf(seed)
	points = pointsOnAnEllipsoid(
		random, _vertices(vertices), *(_share(value, name) for value, name in ((elongation, 'elongation'), (flatness, 'flatness')))
	)
	return fromVertices((size * points).tolist(), **body)


@builder(lacks=('center', 'orientation'))
def grains(curve, mass=None, elongation=1, flatness=1, vertices=14, seed=None, shapes=None, number=None, **body):
	"""Random grains after a sieve curve, in random orientations at the origin: ``O.bodies.append(polytope.cloud(lower, upper, grains))``.

	Between two sieves passing mass grows with the logarithm of the size: a straight line in the usual diagram. The sample meets the curve
	at each sieve to 1 % of its mass.

	:param curve: [(size, passing), …]: openings of sieves [m], ascending, and the part of the mass that passes, from 0 to 1
	:param float mass: of all grains [kg]; or *number*
	:param elongation, flatness: as of randomGrain; or (least, largest), between which they are uniform
	:param int vertices: of each grain
	:param int seed: of the random numbers
	:param shapes: list of bodies whose shapes the grains have, larger or smaller, one or the other at random, in place of *elongation*,
	    *flatness* and *vertices*: ``[polytope.fromMesh(path) for path in …]``. Their size is the intermediate extent along the principal
	    axes. A list of parts (``fromMesh(path, parts=8)``) in place of a body is one that is not convex
	:param int number: of grains, in place of *mass*: that of a sample which has about so many, to some percent
	:returns: list of bodies; of a shape in parts a list of these in a body's place, as *cloud* and *pack* take it
	:raises ValueError: naming the argument; *mass* or *number* where so few grains cannot meet the curve
	"""
	sizes, passing = _curve(curve)
	count = _vertices(vertices)
	ranges = [_range(value, name) for value, name in ((elongation, 'elongation'), (flatness, 'flatness'))]
	density = float(materialOf(body.get('material', -1)).density)
	if not density > 0:
		raise ValueError('material: needs a density above 0')

	def shapeBy(random):
		return shapesOf(shapes, random, lambda: pointsOnAnEllipsoid(random, count, *(random.uniform(*one) for one in ranges)))

	what, total = _massOf(mass, number, lambda: _massOfOne(sizes, passing, density, shapeBy(randomOf(seed))))
	_notTooMany(sizes, passing, total, density)
	random, made, owed, masses = randomOf(seed), [], 0.0, np.zeros(len(sizes))
	shape = shapeBy(random)
	for k, (least, largest) in enumerate(zip(sizes, sizes[1:], strict=False)):
		owed += total * (passing[k + 1] - passing[k])
		drawn, diameters = _fraction(random, least, largest, owed / density, shape)
		each = tqdm(zip(drawn, diameters, strict=True), desc='grains', total=len(drawn), unit=' grains', disable=None, leave=False)
		for one, diameter in each:
			parts = one.bodies(diameter, turnOf(random), body)
			made.append(parts[0] if len(parts) == 1 else parts)
			masses[k + 1] += density * one.volume * diameter**3
		owed -= masses[k + 1]
	off = np.abs(masses.cumsum() - total * np.array(passing)).max() / total
	if off > curveError:
		heavy = f'a grain of {sizes[-1]:.3g} m has about {density * sizes[-1] ** 3 / 2:.2g} kg'
		if sizes[-1] > inMillimetres:
			heavy += ' (sizes are in m: were mm meant?)'
		raise ValueError(
			f'{what}: {total:.3g} kg are too few grains for this curve ({len(made)}, off by {100 * off:.2g} %): {heavy}; take more'
		)
	return made


def _massOf(mass, howMany, massOfOne):
	"""(the argument that was given, mass of all grains)"""
	if (mass is None) == (howMany is None):
		raise ValueError('mass: give the mass of all grains [kg], or their number (number=…), one of the two')
	if mass is not None:
		return 'mass', positive(mass, 'mass')
	if isinstance(howMany, bool) or not isinstance(howMany, numbers.Integral) or not 0 < howMany <= mostGrains:
		raise ValueError(f'number: must be a whole number from 1 to {mostGrains:,}, got {howMany!r}')
	return 'number', int(howMany) * massOfOne()


def _massOfOne(sizes, passing, density, shape):
	"""Mean mass of the grains of this curve, by the mean volume of some shapes."""
	volume = sum(shape().volume for _ in range(trialShapes)) / trialShapes
	fractions = zip(sizes, sizes[1:], passing, passing[1:], strict=False)
	return density * volume / sum((high - low) / _meanCube(least, largest) for least, largest, low, high in fractions)


def _meanCube(least, largest):
	"""Mean of the cubes of the sizes between two sieves: where mass is uniform over the logarithm of the size, numbers fall with its cube."""
	return 3 * math.log(largest / least) / (least**-3 - largest**-3)


def _notTooMany(sizes, passing, mass, density):
	"""Refuses a mass of too many grains. They are counted as if each were as heavy as a cube of the fraction's upper sieve: there are more
	of them."""
	expected = sum(mass * (high - low) / (density * size**3) for size, low, high in zip(sizes[1:], passing, passing[1:], strict=False))
	if expected > mostGrains:
		raise ValueError(
			f'mass: {mass:.3g} kg of these sizes are more than {expected:.2g} grains; at most {mostGrains:,} are made (sizes in m, mass in kg)'
		)


def cloud(lower, upper, bodies, seed=None):
	"""Places polyhedra and YADE's spheres at random inside a box, apart from each other, the largest first; their orientations stay.

	:param lower, upper: opposite corners of the box [m]
	:param bodies: list of bodies, such as grains() makes, spheres among them; the parts of a body that is not convex as a list in its
	    place, for *clump*
	:param int seed: of the random numbers
	:returns: the bodies
	:raises ValueError: naming *bodies*, or *upper* where the box is too small for them
	"""
	low, high = np.array([*vector(lower, 'lower')], float), np.array([*vector(upper, 'upper')], float)
	try:
		bodies = list(bodies)
	except TypeError:
		raise ValueError(f'bodies: must be a list of polyhedra and spheres, got {bodies!r}') from None
	groups = [partsOfLoose(one) for one in bodies]
	if not all(isinstance(part, Body) and _isSolid(part.shape) for parts in groups for part in parts):
		raise ValueError('bodies: must be a list of polyhedra and spheres, or of lists of the parts of one')
	middles = [sum((part.state.pos for part in parts), Vector3.Zero) / len(parts) for parts in groups]
	offsets = [[part.state.pos - middle for part in parts] for parts, middle in zip(groups, middles, strict=True)]
	corners = [
		np.concatenate([_ends(part) + np.array(offset, float) for part, offset in zip(parts, aside, strict=True)])
		for parts, aside in zip(groups, offsets, strict=True)
	]
	radii = [
		max(float(np.linalg.norm(offset)) + _radius(part) for part, offset in zip(parts, aside, strict=True))
		for parts, aside in zip(groups, offsets, strict=True)
	]
	random, placed = randomOf(seed), _Placed(min(radii, default=1))
	order = sorted(range(len(bodies)), key=lambda k: -radii[k])
	for k in tqdm(order, desc='placing', unit=' bodies', disable=None, leave=False):
		begin, end = low - corners[k].min(axis=0), high - corners[k].max(axis=0)
		if not (begin <= end).all():
			raise ValueError(f'upper: the box is smaller than the largest body, which is {np.ptp(corners[k], axis=0).max():.3g} m')
		for place in random.uniform(begin, end, (tries, 3)):
			for part, offset in zip(groups[k], offsets[k], strict=True):
				part.state.pos = Vector3(*place) + offset
			if placed.free(place, radii[k], groups[k]):
				break
		else:
			raise ValueError(f'upper: {placed.number} of {len(bodies)} bodies have a place in this box without overlap; take a larger one')
		placed.add(place, radii[k], groups[k])
	for body in (part for parts in groups for part in parts):
		body.state.refPos, body.state.refOri = body.state.pos, body.state.ori
	return bodies


class _Placed:
	"""Bodies by place: a grid for each size, of cells as wide as its largest body."""

	def __init__(self, smallest):
		self.smallest, self.levels, self.number = smallest, {}, 0

	def _reach(self, level):
		return 2 * self.smallest * 2**level

	def add(self, place, radius, parts):
		level = int(math.log2(max(radius / self.smallest, 1)))
		width = 2 * self._reach(level)
		cell = tuple((place // width).astype(int).tolist())
		self.levels.setdefault(level, {}).setdefault(cell, []).append((place.tolist(), radius, parts))
		self.number += 1

	def free(self, place, radius, parts):
		"""Whether nothing touches the body of these parts there."""
		for level, cells in self.levels.items():
			width, reach = 2 * self._reach(level), radius + self._reach(level)
			first, last = ((place - reach) // width).astype(int).tolist(), ((place + reach) // width).astype(int).tolist()
			for x in range(first[0], last[0] + 1):
				for y in range(first[1], last[1] + 1):
					for z in range(first[2], last[2] + 1):
						if any(_touch(place, radius, parts, one) for one in cells.get((x, y, z), ())):
							return False
		return True


def _touch(place, radius, parts, other):
	where, reach, neighbours = other
	near = math.dist(where, place) < radius + reach
	return near and any(_inContact(part, neighbour) for part in parts for neighbour in neighbours)


def _inContact(one, other):
	spheres = [isinstance(body.shape, Sphere) for body in (one, other)]
	if all(spheres):
		return (one.state.pos - other.state.pos).norm() < one.shape.radius + other.shape.radius
	if any(spheres):
		return depthInSphere(*((other, one) if spheres[0] else (one, other))) > 0
	return _polytope.contact(one, other).inContact


def _isSolid(shape):
	return isinstance(shape, Sphere) or (isinstance(shape, Polytope) and shape.dimension == 3)


def _radius(part):
	"""Radius of a ball about its position that holds it [m]."""
	return float(part.shape.radius if isinstance(part.shape, Sphere) else part.shape.circumscribedRadius)


def _ends(part):
	"""Points whose box is the body's, relative to its centre [m]."""
	return float(part.shape.radius) * np.concatenate([np.eye(3), -np.eye(3)]) if isinstance(part.shape, Sphere) else cornersOf(part)


def _fraction(random, least, largest, volume, shape):
	"""(shapes of size 1, sizes) between two sieves, together of this volume as nearly as there are grains."""
	steep, meanCube = least**-3 - largest**-3, _meanCube(least, largest)
	shapes, volumes, total = [], [], 0.0  # not summed anew for each grain: there may be 100 000
	with tqdm(desc='shapes of grains', unit=' shapes', disable=None, leave=False) as progress:
		while total * meanCube < volume:
			shapes.append(shape())
			volumes.append(shapes[-1].volume)
			total += volumes[-1]
			progress.update()
	if shapes and total * meanCube - volume > volumes[-1] * meanCube / 2:  # one less is nearer
		shapes.pop(), volumes.pop()
	if not shapes:
		return [], []
	shares = (random.permutation(len(shapes)) + random.uniform(size=len(shapes))) / len(shapes)
	sizes = (least**-3 - shares * steep) ** (-1 / 3)
	for _ in range(20):
		sizes = np.clip(sizes * (volume / (volumes * sizes**3).sum()) ** (1 / 3), least, largest)
	return shapes, sizes.tolist()


def _curve(curve):
	try:
		sizes, passing = ([float(row[k]) for row in curve] for k in (0, 1))
		correct = all(len(row) == 2 for row in curve)
	except (TypeError, ValueError, IndexError):
		correct, sizes, passing = False, [], []
	rising = (
		correct and len(sizes) > 1 and sizes[0] > 0 and all(a < b for a, b in zip(sizes, sizes[1:], strict=False)) and sizes[-1] < math.inf
	)
	if not rising or passing[0] != 0 or passing[-1] != 1 or not all(a <= b for a, b in zip(passing, passing[1:], strict=False)):
		raise ValueError(
			'curve: must be [(size, passing), …] with sizes above 0 that ascend, and passing from 0 to 1 (not percent) that does not fall'
		)
	return sizes, passing


def _vertices(vertices):
	if isinstance(vertices, bool) or not isinstance(vertices, numbers.Integral) or not fewestVertices <= vertices <= mostVertices:
		raise ValueError(f'vertices: must be a whole number from {fewestVertices} to {mostVertices}, got {vertices!r}')
	return int(vertices)


def _share(value, name):
	value = number(value, name)
	if not 0 < value <= 1:
		raise ValueError(f'{name}: must be above 0 and at most 1, got {value!r}')
	return float(value)


def _range(value, name):
	if not isinstance(value, (tuple, list)):
		return (_share(value, name),) * 2
	if len(value) != 2 or not _share(value[0], name) <= _share(value[1], name):
		raise ValueError(f'{name}: must be a number or (least, largest), got {value!r}')
	return float(value[0]), float(value[1])
