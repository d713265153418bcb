# SPDX-License-Identifier: GPL-2.0-or-later
"""Displacements and stresses of chosen blocks over time, in yade.plot: `polytope.history(…)` (docs/stress-and-excavation.md)."""

import ast
import math
import numbers
import re

import numpy as np
from yade import O, Polytope, PyRunner, Vector3

from ..arguments import flag, namedArguments, point, warn
from ..measures.stress import bodyStress
from ..scene.movers import canMove, moverOf, partsOf

__all__ = ['followParts', 'histories', 'history', 'record']

module = "__import__('yade.polytope.rock.pointHistories', fromlist=['record']).record"
"""A call that leaves no name among the script's own."""
axes = 'xyz'
components = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
within = 1e-9
"""Tolerance on a point at a body's surface, as a part of the body's size: how far outside it may be."""


@namedArguments
def history(points, every=100, stress=False):
	"""Records how points of bodies move, in yade.plot: ``polytope.history({'crown': (0, 0, 2.1), 'wall': 17}, every=50)``.

	Adds an engine to O.engines that adds a row to *plot.data* at once and then every so many steps: *i* (O.iter), *t* (O.time) and for each name
	*crown_x*, *crown_y*, *crown_z*, its displacement since this call [m]. A point moves with the body that it lies in. With *stress* also
	*crown_xx*, *crown_yy*, *crown_zz*, *crown_xy*, *crown_yz* and *crown_zx*, bodyStress of this body [Pa]. ``plot.plot()``,
	``plot.saveDataTxt(…)`` and numpy.array(plot.data['crown_z']) show them. The engine is saved with the scene and goes on when that is
	loaded, the rows are not. Rows of later steps than this one, which a former scene has left in *plot.data*, are removed, with a warning.
	It records nothing of a body that is no more (nan), nor of the trials of *factorOfSafety*. Several calls share the row of a step; one
	that has no row of another call has nan in its columns.

	:param points: dictionary of names (letters, digits, _) → id of a body, for its centre, or point in a body that can move [m]: of two
	    components for a polygon
	:param int every: steps from one row to the next
	:param bool stress: whether to record stresses
	:returns: the names of the columns
	:raises ValueError: naming the argument
	"""
	if not isinstance(points, dict) or not points:
		raise ValueError("points: must be a dictionary of names and of ids or points, as {'crown': (0, 0, 2.1), 'wall': 17}")
	if isinstance(every, bool) or not isinstance(every, numbers.Integral) or every < 1:
		raise ValueError(f'every: must be a whole number of steps, at least 1, got {every!r}')
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	flag(stress, 'stress')
	followed = {_name(name): _follow(name, point) for name, point in points.items()}
	there = {name for engine in histories() for name in re.findall(r"'(\w+)':", engine.command)} & set(followed)
	if there:
		raise ValueError(f'points: {sorted(there)} are recorded already; take other names')
	_forgetFormerScene()
	engine = PyRunner(command=_command(followed, bool(stress)), iterPeriod=int(every), iterLast=O.iter)
	O.engines = [*O.engines, engine]
	record(followed, bool(stress))
	return [f'{name}_{what}' for name in followed for what in _columns(bool(stress))]


def _forgetFormerScene():
	"""O.reset() leaves yade.plot its data, and rows of this scene would follow them."""
	from yade import plot

	last = max((step for step in plot.data.get('i', []) if step == step), default=0)  # a column of others has no number there
	if last > O.iter:
		plot.resetData()
		warn(f'plot.data: rows of a former scene, up to step {last:g}, are removed; plot.saveDataTxt(…) before O.reset() keeps them')


def histories():
	"""The engines of this kind in the scene."""
	return [engine for engine in O.engines if isinstance(engine, PyRunner) and engine.command.startswith(module)]


def followParts(made):
	"""Points of bodies that have been cut go on with the part that they lie in. Call it before these bodies are erased.

	:param made: id → ids of the bodies that are left of it
	"""
	for engine in histories():
		followed, stress = ast.literal_eval(engine.command.removeprefix(module))
		for name, (k, local, origin) in followed.items():
			place = O.bodies[k].state.pos + O.bodies[k].state.ori * Vector3(*local) if k in made else None
			for part in made.get(k, []):
				if _holds(part, place):
					followed[name] = part, _inAxesOf(part, place), origin
		engine.command = _command(followed, stress)


def _command(followed, stress):
	"""The state is in the command, which is saved with the engine."""
	return f'{module}({followed!r}, {stress})'


def _inAxesOf(k, place):
	state = O.bodies[k].state
	return tuple(map(float, state.ori.conjugate() * (place - state.pos)))


def _holds(k, place):
	"""Whether the point is in the body, or a part of the clump."""
	for body in (O.bodies[part] for part in partsOf(k)):
		local = body.state.ori.conjugate() * (place - body.state.pos)
		beyond = max(float(n.dot(local)) - float(d) for n, d in zip(body.shape.normals, body.shape.offsets, strict=True))
		if beyond <= within * float(body.shape.circumscribedRadius):
			return True
	return False


def record(followed, stress):
	"""What the engine calls."""
	there = [k for k, *_ in followed.values() if k < len(O.bodies) and O.bodies[k] is not None]
	stresses = bodyStress(list(dict.fromkeys(there))) if stress and there else {}
	row = {}
	for name, (k, local, origin) in followed.items():
		values = np.full(3, np.nan)
		if k in there:
			state = O.bodies[k].state
			values = np.array(state.pos + state.ori * Vector3(*local) - Vector3(*origin), float)
		if stress:
			tensor = stresses.get(k, np.full((3, 3), np.nan))
			values = [*values, *(tensor[i, j] for i, j in components)]
		row |= {f'{name}_{what}': float(value) for what, value in zip(_columns(stress), values, strict=True)}
	_add({'i': O.iter, 't': float(O.time)}, row)


def _add(step, row):
	"""Adds a row to plot.data, or fills the one that another call of *history* has added in this step."""
	from yade import plot  # brings matplotlib, which takes longer to load than all of this package

	shared = all(plot.data.get(name, [])[-1:] == [value] for name, value in step.items())
	if shared:
		plot.addDataColumns(row)
		shared = all(math.isnan(plot.data[name][-1]) for name in row)
	if not shared:
		plot.addData(**step, **row)
		return
	for name, value in row.items():
		plot.data[name][-1] = value


def _columns(stress):
	return [*axes, *(axes[i] + axes[j] for i, j in components)] if stress else list(axes)


def _name(name):
	if not isinstance(name, str) or not re.fullmatch(r'\w+', name):
		raise ValueError(f'points: names are letters, digits and _, as columns of yade.plot are named by them, got {name!r}')
	return name


def _follow(name, given):
	"""(id of what moves, the point in its axes, the point where it is now)"""
	if isinstance(given, numbers.Integral) and not isinstance(given, bool):
		given = int(given)
		if not 0 <= given < len(O.bodies) or O.bodies[given] is None:
			raise ValueError(f'points: {name}: there is no body {given}')
		k = moverOf(given)
		place = O.bodies[given].state.pos
	else:
		place = Vector3(*_inScene(given, f'points: {name}'))
		k = _bodyAt(name, place)
	return k, _inAxesOf(k, place), tuple(map(float, place))


def _inScene(given, name):
	"""A point of two components is one in the plane of the scene's polygons."""
	place = point(given, name)
	if len(place) == 2:
		heights = {float(body.state.pos[2]) for body in O.bodies if body is not None and getattr(body.shape, 'dimension', 0) == 2}
		if len(heights) != 1:
			raise ValueError(f'{name}: must be three numbers, got {place}; two are those of a scene of polygons in one plane')
		place = *place, heights.pop()
	return place


def _bodyAt(name, place):
	found = []
	for body in O.bodies:
		if body is None or not isinstance(body.shape, Polytope) or not canMove(body):
			continue
		if _holds(body.id, place):
			found += [] if moverOf(body.id) in found else [moverOf(body.id)]
	if len(found) > 1:
		warn(
			f'points: {name}: {tuple(map(float, place))} is on a face of bodies {", ".join(map(str, found))}, and moves with body {found[0]}; give a point inside one of them, or an id'
		)
	if found:
		return found[0]
	raise ValueError(
		f'points: {name}: there is no Polytope that can move at {tuple(map(float, place))}; give a point inside a block, or an id'
	)
