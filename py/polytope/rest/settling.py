# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene brought to rest under its loads, before its joints have to bear them."""

import math

from tqdm import tqdm
from yade import O

from ..arguments import flag, namedArguments, number, warn
from ..bonding.bolting import bolts
from ..bonding.bonds import bonds
from ..scene.present import integrators, laws, meanwhile
from ..scene.relaxing import heldByRelaxing, relaxing
from .holding import facingPairs, joinedPairs
from .scaledMasses import scaledMasses
from .unrest import NotAtRest, Unrest, named, remedy, told

__all__ = ['settle']

between = 50
"""Steps between two looks at the unbalanced force."""
looks = 3
"""Looks in a row at which it must be small: it passes through low values in each swing."""


@namedArguments
def settle(unbalanced=1e-5, elastic=True, damping=0.8, steps=1000000, densityScaling=False):
	"""Steps until the bodies are at rest under the scene's loads, as they would be if these had come slowly.

	Gravity that begins at once makes bodies swing: joints then bear up to twice their load, and one with cohesion or tensile strength and a
	factor of safety below two fails in the first swing. So while the bodies come to rest the joints are elastic: those that touch do
	not slip, intact ones do not fail and bear any tension, and bonds (*polytope.bond*) and bolts (*polytope.bolt*) do not break or yield;
	motion is damped strongly. Then they have their strength and the scene its damping again. What they can't bear fails in the steps that
	follow, from rest. A warning names bodies that touched others, or were held by bonds or bolts, at the start and came to rest elsewhere:
	they slid, fell or toppled.

	Joints that have no strength but friction stick meanwhile, too. Joints that have failed stay so. Time goes on (O.time), and other engines run;
	forces of excavated bodies that still fade (*polytope.excavate*) are waited for.
	A state that is saved meanwhile has joints with their strength, but this damping.

	:param unbalanced: resultant force on a body, or moment over half of its size where that is more, over its weight, or over half of what
	    its contacts, bonds and bolts bear where that is more, below which it counts as being at rest [-]; of all bodies that can move
	:param elastic: False: joints keep their strength, only damping is changed
	:param damping: of NewtonIntegrator meanwhile [-], above 0 and below 1
	:param steps: most steps to take
	:param densityScaling: True: bodies that need a smaller time step than half of all bodies do, such as slivers, are heavier meanwhile,
	    with the weight that they have: the same state of rest in fewer steps. Masses are what they were when the function returns. Time
	    (O.time) has no meaning meanwhile, and PolytopeCheckpoint does not save
	:returns: the number of steps taken
	:raises ValueError: if an argument is out of range, if O.engines has no NewtonIntegrator, or naming *densityScaling* in a scene in
	    motion: with BaseMotion, QuietBoundary or bodies of prescribed velocity, or with weights that are not NewtonIntegrator.gravity
	:raises NotAtRest: a RuntimeError that names the bodies which do not come to rest, with their unbalanced force and why, as soon as that
	    is clear: they fall with nothing below, slide away, or tremble in place; or all that move after so many steps. Strengths and damping
	    are the scene's own again
	"""
	unbalanced, damping, steps = number(unbalanced, 'unbalanced'), number(damping, 'damping'), number(steps, 'steps')
	if not unbalanced > 0:
		raise ValueError(f'unbalanced: must be above 0, got {unbalanced:g}')
	if not 0 < damping < 1:
		raise ValueError(f'damping: must be above 0 and below 1, got {damping:g}')
	if not steps >= 1:
		raise ValueError(f'steps: must be at least 1, got {steps:g}')
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


def _tellDisplaced(bodies):
	"""A block that has toppled is at rest, too."""
	if bodies:
		ones = ', '.join(f'body {k} by {way:.2g} m' for k, way in bodies[:named]) + (', …' if len(bodies) > named else '')
		warn(
			f'settle: at rest, but {len(bodies)} that touched others or were held moved by more than a tenth of their size: {ones}; they slid, fell or toppled'
		)


def _untilRest(unbalanced, steps, adapt=lambda: None, masses=None):
	quiet, taken, unrest = 0, 0, Unrest(unbalanced, masses=masses)
	first, relieved, pairs = unrest, heldByRelaxing(), facingPairs() | joinedPairs()
	with tqdm(unit=' steps', disable=None, leave=False) as bar:
		while taken < steps:
			now = min(between, steps - taken)
			for _ in range(now):
				O.step()  # O.run(…, wait=True) looks only every 40 ms whether it is done
			taken += now
			force, fading = unrest.look(now), bool(relaxing())
			if math.isnan(force):
				raise NotAtRest('bodies: the unbalanced force is not a number, as where a position, velocity or force is none; polytope.check(O) names such bodies')
			adapt()
			bar.set_postfix_str(f'unbalanced force {force:.2g} for {unbalanced:g}', refresh=False)
			bar.update(now)
			quiet = quiet + 1 if force < unbalanced and not fading else 0
			if quiet == looks:
				parted = {k for pair in pairs - joinedPairs() for k in pair}  # what a bond or bolt still holds has only stretched it
				_tellDisplaced(first.displaced(relieved | parted))
				return taken
			if fading:
				unrest = Unrest(unbalanced, masses=masses)  # whose forces change by themselves
			lost = unrest.hopeless()
			if lost:
				raise NotAtRest(f'bodies: {told(lost)}; {remedy(lost)}', lost)
	left = unrest.moving()
	if not left:
		raise NotAtRest(f'steps: {taken} are too few to tell that bodies are at rest and stay so (unbalanced force {force:.2g} for {unbalanced:g}); more steps')
	raise NotAtRest(
		f'steps: not at rest after {taken} (unbalanced force {force:.2g} for {unbalanced:g}): {told(left)}; more steps, or {remedy(left)}',
		left,
	)
