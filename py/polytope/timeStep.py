# SPDX-License-Identifier: GPL-2.0-or-later
"""A time step that the present contacts can bear, rocking included."""
import math

from yade import O

from .precision import isNumber

__all__ = ['stableTimeStep']


def stableTimeStep(fraction=0.2, default=None):
	"""Time step from the stiffnesses of all present contacts, as a fraction of the shortest 1/ω of any body that can move.

	For each body ω² is the larger of Σ (kn + ks)/m and Σ (rocking stiffness + (kn + ks) arm²)/I, over its contacts, with the smallest
	principal moment of inertia. A conservative contact has the rocking stiffness normal force × :yref:`PolytopeGeom.rockingArm` (face on
	face it may exceed all others; docs/conservative-contact.md). The paper's model has one of about kn × (face)², for its contact point moves to the
	closing edge, too: arm² covers most of it (a cube on a floor is stable up to 1.83/ω). YADE's GlobalStiffnessTimeStepper does not know it.
	The central difference scheme is stable up to 2/ω of one body between fixed ones. Coupled bodies, and rotation with translation, may
	each raise the highest frequency by √2 (each contact adds (kn + ks)(1/m₁ + 1/m₂ + arm₁²/I₁ + arm₂²/I₂) at most), so up to 1/ω any
	heap is stable; with damped contacts heaps stood up to 2.6/ω (polytope.settings says where). Rocking stiffness grows with the normal force, so leave room: where bodies are thrown together, call this again as the run
	goes on.

	:param float fraction: of 1/ω, above 0; at most 1 is safe for any heap, at most 2 (refused above) for one body
	:param float default: returned [s] where no contact limits the step yet
	:returns: the time step [s]; set it with O.dt = …
	:raises ValueError: naming *fraction*, or *default* where one is needed
	"""
	if not isNumber(fraction) or not 0 < fraction <= 2:
		raise ValueError(f'fraction: must be above 0 and at most 2, the limit of one body, got {fraction!r}')
	if default is not None and not (isNumber(default) and not isinstance(default, bool) and 0 < default < math.inf):
		raise ValueError(f'default: must be a finite time step above 0, got {default!r}')
	translation, rotation = {}, {}
	for contact in O.interactions:
		if not contact.isReal:
			continue
		stiffness = contact.phys.kn + contact.phys.ks
		rocking = max(contact.phys.normalForce.dot(contact.geom.normal), 0) * getattr(contact.geom, 'rockingArm', 0)
		for body, arm in ((contact.id1, contact.geom.refR1), (contact.id2, contact.geom.refR2)):
			translation[body] = translation.get(body, 0) + stiffness
			rotation[body] = rotation.get(body, 0) + rocking + stiffness * arm**2
	fastest = 0
	for body, stiffness in translation.items():
		state = O.bodies[body].state
		if O.bodies[body].dynamic and state.mass > 0 and min(state.inertia) > 0:
			fastest = max(fastest, stiffness / state.mass, rotation[body] / min(state.inertia))
	if fastest > 0:
		return fraction / math.sqrt(fastest)
	if default is None:
		raise ValueError('default: no contact between bodies that can move limits the time step yet; give one to start with')
	return default
