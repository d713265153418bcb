# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene brought to rest under its loads, before its joints have to bear them."""

import numpy as np
from tqdm import tqdm
from yade import O, Vector3

from ._scaledMasses import scaledMasses
from ._scene import integrators, laws, meanwhile
from .arguments import flag, namedArguments, number
from .bolting import bolts, madeBolts
from .bonding import bonds, madeBonds
from .relaxing import relaxing

__all__ = ['settle', 'unbalancedForce']

between = 50
"""Steps between two looks at the unbalanced force."""
looks = 3
"""Looks in a row at which it must be small: it passes through low values in each swing."""


@namedArguments
def settle(unbalanced=1e-5, elastic=True, damping=0.8, steps=1000000, densityScaling=False):
	"""Steps until the bodies are at rest under the scene's loads, as they would be if these had come slowly.

	Gravity that begins at once makes bodies swing: joints then bear up to twice their load, and one with cohesion or tensile strength and a
	factor of safety below two fails in the first swing. So while the bodies come to rest the joints are elastic: those that touch do
	not slip, intact ones do not fail and bear any tension, and bonds (*polytope.bond*) and bolts (*polytope.bolt*) do not break or yield; motion is damped strongly. Then they have their strength
	and the scene its damping again. What they can't bear fails in the steps that follow, from rest.

	Joints that have no strength but friction stick meanwhile, too. Joints that have failed stay so. Time goes on (O.time), and other engines run;
	forces of excavated bodies that still fade (*polytope.excavate*) are waited for.
	A state that is saved meanwhile has joints with their strength, but this damping.

	:param unbalanced: resultant force on a body over its weight, or over half of what its contacts, bonds and bolts bear where that is more, below which it counts as
	    being at rest [-]; of all bodies that can move
	:param elastic: False: joints keep their strength, only damping is changed
	:param damping: of NewtonIntegrator meanwhile [-], above 0 and below 1
	:param steps: most steps to take
	:param densityScaling: True: bodies that need a smaller time step than half of all bodies do, such as slivers, are heavier meanwhile, with the weight that
	    they have: the same state of rest in fewer steps. Masses are what they were when the function returns. Time (O.time) has no meaning meanwhile, and
	    PolytopeCheckpoint does not save
	:returns: the number of steps taken
	:raises ValueError: if an argument is out of range, if O.engines has no NewtonIntegrator, or naming *densityScaling* in a scene in motion: with BaseMotion, QuietBoundary
	    or bodies of prescribed velocity, or with weights that are not NewtonIntegrator.gravity
	:raises RuntimeError: if the bodies are not at rest after so many steps; strengths and damping are the scene's own again
	"""
	unbalanced, damping, steps = number(unbalanced, 'unbalanced'), number(damping, 'damping'), number(steps, 'steps')
	if not unbalanced > 0:
		raise ValueError(f'unbalanced: {unbalanced:g}; above 0')
	if not 0 < damping < 1:
		raise ValueError(f'damping: {damping:g}; above 0 and below 1')
	if not steps >= 1:
		raise ValueError(f'steps: {steps:g}; at least 1')
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	if not integrators():
		raise ValueError('O.engines: there must be a NewtonIntegrator, whose damping counts')
	changed = [(integrator, 'damping', damping) for integrator in integrators()]
	if flag(elastic, 'elastic'):
		breakable = [*laws(), *(engine for engine in (bonds(), bolts()) if engine)]
		changed += [(one, 'unbreakable', True) for one in breakable]
	with meanwhile(changed):
		if not flag(densityScaling, 'densityScaling'):
			return _untilRest(unbalanced, int(steps))
		with scaledMasses() as (adapt, masses):
			return _untilRest(unbalanced, int(steps), adapt, masses)


def _untilRest(unbalanced, steps, adapt=lambda: None, masses=None):
	quiet, taken = 0, 0
	with tqdm(unit=' steps', disable=None, leave=False) as bar:
		while taken < steps:
			now = min(between, steps - taken)
			O.run(now, wait=True)
			taken += now
			adapt()
			force = unbalancedForce(masses=masses)
			bar.set_postfix_str(f'unbalanced force {force:.2g} for {unbalanced:g}', refresh=False)
			bar.update(now)
			quiet = quiet + 1 if force < unbalanced and not relaxing() else 0
			if quiet == looks:
				return taken
	raise RuntimeError(
		f'steps: not at rest after {taken} (unbalanced force {force:.2g} for {unbalanced:g}); more steps, a larger *unbalanced*, or a support for bodies that fall'
	)


def unbalancedForce(watched=None, masses=None):
	"""Of the body that is least at rest: resultant over its weight, or over half of what contacts, bonds and bolts press and pull it with, where that is more.

	:param watched: ids, of clumps their own; None: all that can move
	:param masses: true masses by id, where those of the scene are scaled [kg]
	"""
	last = len(O.bodies)
	owner, borne = np.arange(last), np.zeros(last)  # a clump moves as one
	moving = []
	for body in O.bodies:
		if body.isClumpMember:
			owner[body.id] = body.clumpId
		elif body.dynamic and (watched is None or body.id in watched):
			moving.append(body)
	forces = [(contact, (contact.phys.normalForce + contact.phys.shearForce).norm()) for contact in O.interactions if contact.isReal]
	forces += [(bond, bond.force.norm()) for bond in madeBonds() if bond.intact]
	forces += [(crossing, abs(crossing.tension) + crossing.shearForce.norm()) for one in madeBolts() for crossing in one.crossings if not crossing.failure]
	for link, force in forces:
		for key in (link.id1, link.id2):
			borne[owner[key]] += float(force) / 2
	gravity = integrators()[0].gravity
	worst = 0.0
	for body in moving:
		own = (masses or {}).get(body.id, body.state.mass) * gravity
		# a clump's forces are those of its members, without the permanent one that a scaled mass comes with
		weight = own if body.isClump else body.state.mass * gravity
		scale = max(float(own.norm()), borne[body.id])
		if scale > 0:
			worst = max(worst, float((_force(body) + weight).norm()) / scale)
	return worst


def _force(body):
	if not body.isClump:
		return O.forces.f(body.id)
	return sum((O.forces.f(member) for member in body.shape.members), Vector3.Zero)
