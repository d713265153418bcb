# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene brought to rest under its loads, before its joints have to bear them."""

import math

from tqdm import tqdm
from yade import NewtonIntegrator, O, Vector3, utils

from ._scene import laws
from .arguments import flag, namedArguments, number
from .bonding import bonds

__all__ = ['settle']

between = 50
"""Steps between two looks at the unbalanced force."""
looks = 3
"""Looks in a row at which it must be small: it passes through low values in each swing."""


@namedArguments
def settle(unbalanced=1e-5, elastic=True, damping=0.8, steps=1000000):
	"""Steps until the bodies are at rest under the scene's loads, as they would be if these had come slowly.

	Gravity that begins at once makes bodies swing: joints then bear up to twice their load, and one with cohesion or tensile strength and a
	factor of safety below two fails in the first swing. So while the bodies come to rest the joints are elastic: those that touch do
	not slip, intact ones do not fail and bear any tension, and bonds (*polytope.bond*) do not break; motion is damped strongly. Then they have their strength
	and the scene its damping again. What they can't bear fails in the steps that follow, from rest.

	Joints that have no strength but friction stick meanwhile, too. Joints that have failed stay so. Time goes on (O.time), and other engines run.

	:param unbalanced: mean unbalanced force over the mean force of a contact or bond, below which the bodies count as being at rest [-]
	:param elastic: False: joints keep their strength, only damping is changed
	:param damping: of NewtonIntegrator meanwhile [-], above 0 and below 1
	:param steps: most steps to take
	:returns: the number of steps taken
	:raises ValueError: if an argument is out of range, or if O.engines has no NewtonIntegrator
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
	integrators = [engine for engine in O.engines if isinstance(engine, NewtonIntegrator)]
	if not integrators:
		raise ValueError('O.engines: there must be a NewtonIntegrator, whose damping counts')
	changed = [(integrator, 'damping', damping) for integrator in integrators]
	if flag(elastic, 'elastic'):
		breakable = [*laws(), *([bonds()] if bonds() else [])]
		changed += [(one, 'unbreakable', True) for one in breakable]
	before = [(one, name, getattr(one, name)) for one, name, _ in changed]
	for one, name, value in changed:
		setattr(one, name, value)
	try:
		return _untilRest(unbalanced, int(steps))
	finally:
		for one, name, value in before:
			setattr(one, name, value)


def _untilRest(unbalanced, steps):
	quiet, force = 0, math.nan
	with tqdm(unit=' steps', disable=None, leave=False) as bar:
		for taken in range(between, steps + between, between):
			O.run(between, wait=True)
			force = _unbalancedForce()  # not a number where nothing bears a force
			bar.set_postfix_str(f'unbalanced force {force:.2g} for {unbalanced:g}', refresh=False)
			bar.update(between)
			quiet = quiet + 1 if force < unbalanced else 0
			if quiet == looks:
				return taken
	seen = 'nothing bears a force' if math.isnan(force) else f'unbalanced force {force:.2g} for {unbalanced:g}'
	raise RuntimeError(f'steps: not at rest after {taken} ({seen}); more steps, a larger *unbalanced*, or a support for bodies that fall')


def _unbalancedForce():
	"""YADE's, in which forces of bonds count as those of contacts."""
	borne = [bond.force.norm() for bond in bonds().bonds if bond.intact] if bonds() else []
	if not borne:
		return float(utils.unbalancedForce())
	borne += [(contact.phys.normalForce + contact.phys.shearForce).norm() for contact in O.interactions if contact.isReal]
	gravity = next(engine.gravity for engine in O.engines if isinstance(engine, NewtonIntegrator))
	moving = [body for body in O.bodies if body.dynamic and not body.isClumpMember]
	left = [(_force(body) + body.state.mass * gravity).norm() for body in moving]
	return float(sum(left) / len(left) / (sum(borne) / len(borne))) if left and sum(borne) > 0 else math.nan


def _force(body):
	if not body.isClump:
		return O.forces.f(body.id)
	return sum((O.forces.f(member) for member in body.shape.members), Vector3.Zero)
