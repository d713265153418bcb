# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixed bodies that move as a record tells: `polytope.baseMotion(…)`."""

from yade import BaseMotion, O, QuietBoundary

from ..arguments import namedArguments
from ..scene.present import integrators
from ._bodies import bodiesOf, historyOf, refuseWithoutIntegrator

__all__ = ['baseMotion']


@namedArguments
def baseMotion(ids, history):
	"""Moves fixed bodies with a velocity that is given over time, as one rigid base, from now on::

		O.engines = polytope.engines(damping=0)
		polytope.baseMotion(base, polytope.velocityHistory('record.txt', unit=9.81))

	The engine *BaseMotion* comes first in O.engines, and is saved with the scene. Bodies turn with nothing, and what was there of their
	velocity is replaced. YADE's numerical damping acts on absolute velocities and must be 0 as long as the history goes on: it would hold
	back what the base carries along. Let the scene come to rest before (*settle*), while its own damping is 0.

	:param ids: number of a body, or several; fixed ones
	:param history: what *velocityHistory* returns
	:returns: the engine *BaseMotion*; ``O.engines = [one for one in O.engines if one is not engine]`` removes it, engine.dead = True stops it
	:raises ValueError: naming the argument: bodies that are not there or not fixed, a history that has begun already, damping other than 0,
	    no NewtonIntegrator
	"""
	ids, history = bodiesOf(ids), historyOf(history)
	for k in ids:
		body = O.bodies[k]
		if body.isClumpMember:
			raise ValueError(f'ids: body {k} is a member of clump {body.clumpId}; fix and name the clump')
		if set('xyzXYZ') - set(body.state.blockedDOFs):
			raise ValueError(f"ids: body {k} is not fixed; make it with fixed=True, or set its state.blockedDOFs = 'xyzXYZ'")
	if any(set(one.ids) & set(ids) for one in O.engines if isinstance(one, BaseMotion)):
		raise ValueError('ids: O.engines has a BaseMotion for some of them; remove it first')
	if any(set(one.ids) & set(ids) for one in O.engines if isinstance(one, QuietBoundary)):
		raise ValueError('ids: some of them are a quiet boundary, which moves freely; give the record to quietBoundary (history=)')
	refuseWithoutIntegrator()
	damping = max((float(one.damping) for one in integrators() if not one.dead), default=0.0)
	if damping != 0:
		raise ValueError(
			f'damping: NewtonIntegrator has {damping:g}, which acts on absolute velocities and would hold back what the base carries along; '
			'O.engines = polytope.engines(damping=0)'
		)
	engine = BaseMotion(ids=ids, history=history)
	O.engines = [engine, *O.engines]
	return engine
