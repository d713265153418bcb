# SPDX-License-Identifier: GPL-2.0-or-later
"""A dense sample from loose bodies: `polytope.pack(…)` compresses them to a stress or a porosity, or lets them fall."""

import math
from collections.abc import Iterable

import numpy as np
from tqdm import tqdm
from yade import Body, O, Polytope, Vector3, Wall

from ..arguments import namedArguments, number, vector, warn
from ..bodies.clumps import clump
from ..bodies.grains import cloud
from ..bodies.grainShapes import partsOfLoose
from ..engines import engines
from ..measures.sizes import aabbExtrema
from ..scene.movers import movers, partsOf
from ..scene.namedBodies import namedBodies
from ..scene.present import geometryFunctors
from .cell import PeriodicSample
from .sample import between, deepest, fastestStrain, idsOfSample, tooDeep
from .servo import actOn
from .walls import WalledSample, boundaryMask, meetWalls, sixWalls, smooth, withoutEachOther

__all__ = ['pack', 'sample']

reached = 1e-4
"""Deviation of the porosity at which compression ends."""


densest = 0.35
"""Porosity of a dense sample, by which the size of the cell is judged beforehand."""


@namedArguments
def pack(bodies, lower, upper, stress=None, porosity=None, gravity=None, periodic=False, friction=None, wallFriction=0, seed=None):
	"""Packs polyhedra in a box between walls or in a periodic cell: ``sample = polytope.pack(grains, (0, 0, 0), (0.1, 0.1, 0.1), stress=1e5)``.

	Places them at random in the box without overlap (*cloud*), appends them and the walls to the scene, and runs it: the box shrinks evenly until the
	stress is the same on all sides and the bodies rest, or until the porosity is reached; or bodies fall and the box stays as it is.
	O.engines become polytope.engines(), unless there are some with contacts of polytopes: those stay.

	:param bodies: list of bodies, such as grains() makes, not yet in the scene; the parts of a body that is not convex as a list in its place, of
	    which a clump is made
	:param lower, upper: opposite corners of the box at the beginning [m], large enough for a cloud: five times the bodies' volume
	:param float stress: to compress to [Pa], positive
	:param float porosity: to compress to, between 0 and 1; the stress is what follows
	:param Vector3 gravity: to settle under [m/s²], along −z; walls on five sides
	:param bool periodic: in a periodic cell, O.cell, without walls
	:param float friction: angle between bodies while they are packed [rad]: 0 gives the densest sample; default the material's. Then the material's
	    own takes its place, and the sample comes to rest again.
	:param float wallFriction: angle between bodies and walls [rad]
	:param int seed: of the random places
	:returns: WalledSample or PeriodicSample, with ids, porosity, extents, stress(), boundaryStress(), for triaxial() and the other tests
	:raises ValueError: naming the argument
	:raises RuntimeError: if the bodies do not come to rest
	"""
	if [stress, porosity, gravity].count(None) != 2:
		raise ValueError('stress: give one of stress, porosity and gravity')
	stress, porosity = _checked(stress, porosity)
	if friction is not None:
		_angle(friction, 'friction')
	if gravity is not None:
		gravity = vector(gravity, 'gravity')
		if periodic or not (gravity[2] < 0 and gravity[0] == gravity[1] == 0):
			raise ValueError('gravity: must point along −z, and needs walls (periodic=False)')
	loose = _loose(bodies)
	bodies = [part for one in loose for part in partsOfLoose(one)]
	if periodic:
		_largeEnough(loose, lower, upper, porosity)
	cloud(lower, upper, loose, seed=seed)
	ids = [O.bodies.append(one) if isinstance(one, Body) else clump(one)[0] for one in loose]
	material = bodies[0].material
	usual = material.frictionAngle
	if friction is not None:
		_give(bodies, _angle(friction, 'friction'))
	made = _boundary(ids, lower, upper, material, wallFriction, periodic, gravity)
	try:
		_compress(made, stress, porosity) if gravity is None else made.settle()
	finally:
		_give(bodies, usual)
	if friction is not None:
		O.interactions.clear()  # contacts take the friction of their materials when they are made
		made.settle()
	return made


@namedArguments
def sample(ids=None, lower=None, upper=None, wallFriction=0):
	"""The bodies that are in the scene, as a sample for triaxial() and the other tests; for samples that pack() did not make, or after O.load.

	Walls that the scene had before, as after O.load, are replaced at their places; plates of a shear test by walls at *lower* and *upper*.

	:param ids: of the bodies; default all that can move
	:param lower, upper: corners of the box at which walls are made [m]; without them where such walls are, or at the extents of the bodies; in a
	    periodic scene its cell
	:param float wallFriction: angle between bodies and walls [rad]
	:returns: WalledSample or PeriodicSample
	:raises ValueError: naming the argument
	"""
	chosen = [body.id for body in movers()] if ids is None else namedBodies(ids)
	if not chosen:
		raise ValueError('ids: the sample has no body that can move')
	if (lower is None) != (upper is None) or (O.periodic and lower is not None):
		raise ValueError('lower: give both corners of the box, or neither; in a periodic scene neither')
	former = [body for body in O.bodies if body is not None and body.mask == boundaryMask and not body.dynamic]
	plates = any(isinstance(body.shape, Polytope) for body in former)
	if plates and lower is None:
		seen = 'lower: the scene has the plates of a shear test, which is not to be continued so: what it had reached is not known after O.load'
		raise ValueError(f'{seen}; give lower and upper, corners of a box of walls about the bodies, which takes their place')
	if not O.periodic:
		there = _corners(former) or aabbExtrema(chosen)
		lower, upper = there if lower is None else (vector(lower, 'lower'), vector(upper, 'upper'))
		if not all(low < high for low, high in zip(lower, upper, strict=True)):
			raise ValueError(f'upper: must be above lower in all three directions, got lower {lower!r}, upper {upper!r}')
	idsOfSample(chosen)  # before anything of the scene is changed
	if plates:
		warn('ids: the plates of a shear test are replaced by walls round the bodies; what the test had reached is not continued')
	for body in former:
		O.bodies.erase(body.id)
	material = next(O.bodies[part].material for k in chosen for part in partsOf(k))
	return _boundary(chosen, lower, upper, material, wallFriction, O.periodic, None)


def _corners(former):
	"""Corners of the box between six walls, if there are as many."""
	walls = [
		[float(body.state.pos[axis]) for body in former if isinstance(body.shape, Wall) and body.shape.axis == axis] for axis in range(3)
	]
	return tuple(np.array([end(places) for places in walls]) for end in (min, max)) if all(len(places) == 2 for places in walls) else None


def _checked(stress, porosity):
	if stress is not None and not 0 < (stress := float(number(stress, 'stress'))) < math.inf:
		raise ValueError(f'stress: must be above 0 and finite [Pa], got {stress!r}')
	if porosity is not None and not 0 < (porosity := float(number(porosity, 'porosity'))) < 1:
		raise ValueError(f'porosity: must be between 0 and 1, got {porosity!r}')
	return stress, porosity


def _angle(value, name):
	angle = float(number(value, name))
	if not 0 <= angle < math.pi / 2:
		raise ValueError(f'{name}: must be an angle from 0 to below π/2 [rad], got {value!r}')
	return angle


def _loose(bodies):
	loose = list(bodies) if isinstance(bodies, Iterable) else []
	bodies = [part for one in loose for part in partsOfLoose(one)]
	if not bodies or not all(isinstance(body, Body) and body.id < 0 for body in bodies):
		raise ValueError(
			'bodies: must be a list of bodies that are not in the scene yet, such as polytope.grains makes, or of lists of the parts of one'
		)
	if len({body.material.id for body in bodies}) > 1:
		raise ValueError('bodies: must be of one material')
	if not hasattr(bodies[0].material, 'frictionAngle'):
		raise ValueError('bodies: their material must have a frictionAngle, as RockJointMat and FrictMat')
	return loose


def _largeEnough(loose, lower, upper, porosity):
	"""YADE's collider needs bodies that are smaller than half of the cell, in the end."""
	extents = np.array(upper, float) - np.array(lower, float)
	filled = 1 - (densest if porosity is None else porosity)
	groups = [partsOfLoose(one) for one in loose]
	shrunk = extents * (sum(float(part.shape.volume) for parts in groups for part in parts) / filled / float(np.prod(extents))) ** (1 / 3)
	longest = max(_length(parts) for parts in groups)
	if not float(shrunk.min()) > 2 * longest:
		seen = f'bodies: {len(loose)} make a cell of {shrunk.min():.3g} m, and the largest is {longest:.3g} m'
		raise ValueError(f'{seen}; a periodic cell must be more than twice as long: take more, or smaller ones, or walls')


def _length(parts):
	"""Largest length of a body of these parts [m]."""
	middle = sum((part.state.pos for part in parts), Vector3.Zero) / len(parts)
	return 2 * max(float((part.state.pos - middle).norm()) + float(corner.norm()) for part in parts for corner in part.shape.vertices)


def _give(bodies, frictionAngle):
	for body in bodies:
		body.material.frictionAngle = frictionAngle


def _boundary(ids, lower, upper, material, wallFriction, periodic, gravity):
	"""The sample with its walls or cell, and O.engines."""
	if periodic:
		if lower is not None:
			_cell(ids, np.array(lower, float), np.array(upper, float))
		walls = None
	else:
		own = smooth(material, _angle(wallFriction, 'wallFriction'))
		walls = sixWalls(np.array(lower, float), np.array(upper, float), own, without=() if gravity is None else [(2, 1)])
	made = PeriodicSample(ids) if periodic else WalledSample(ids, walls)
	if not geometryFunctors():  # as in a new scene, or with the engines that YADE begins with
		O.engines = engines(gravity=(0, 0, 0) if gravity is None else gravity)
	if walls:
		meetWalls()
	withoutEachOther()
	actOn(None)
	O.step()  # the time stepper's first
	O.step()
	return made


def _cell(ids, lower, upper):
	"""YADE's cell begins at the origin."""
	O.periodic = True
	O.cell.setBox(*(upper - lower).tolist())
	for k in dict.fromkeys(part for own in ids for part in (own, *partsOf(own))):
		O.bodies[k].state.pos -= Vector3(*lower.tolist())
		O.bodies[k].state.refPos = O.bodies[k].state.pos


def _compress(made, stress, porosity):
	if stress is not None:
		made.control(stresses=dict.fromkeys(range(3), stress))
		made.settle()
		return
	if porosity > made.porosity:
		raise ValueError(f'porosity: is {made.porosity:.3g} in the box at the beginning; take a larger box, or a smaller porosity')
	with tqdm(desc='compressing', unit=' steps', disable=None, leave=False) as bar:
		while (left := math.log((1 - porosity) / (1 - made.porosity)) / 3) > reached * (1 - porosity):
			# ever slower at the end, over as many steps as the walls' easing needs to follow
			made.control(rates=dict.fromkeys(range(3), min(fastestStrain, left / 200) / float(O.dt)))
			for _ in range(between):
				O.step()
			bar.set_postfix_str(f'porosity {made.porosity:.3f} for {porosity:.3f}', refresh=False)
			bar.update(between)
			if (pressed := made.overlap()) > deepest:
				raise RuntimeError(f'porosity: {made.porosity:.3g} is reached so far, and {tooDeep(pressed)}')
	made.control()
	for k in made.ids:
		state = O.bodies[k].state
		state.vel = state.angVel = state.angMom = (0, 0, 0)  # as loose bodies nothing would stop them
	made.settle(untouched=True)
