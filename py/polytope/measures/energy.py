# SPDX-License-Identifier: GPL-2.0-or-later
"""The mechanical energy of a scene, as exactly as its time steps define it."""

from yade import O, PolytopeGeom, RockJointPhys, Vector3

from ..bonding.bolting import madeBolts
from ..bonding.bonds import madeBonds
from ..scene.movers import canMove, movers
from ..scene.present import contactSettings, geometryFunctors, gravityOf, integrators, meanwhile

__all__ = ['mechanicalEnergy', 'storedEnergy']


def mechanicalEnergy():
	"""Take one time step, and return the total energy at the positions it started from: kinetic, of gravity, and of the springs of
	contacts, bonds and bolts.

	YADE's velocities lie half a step between positions. The energy here is made of those before and after the positions,
	½ m v₋·v₊ + ½ ω₋·I ω₊: under gravity, and in a contact that stays linear, its sum with the potential is then constant to rounding for
	any time step (with the squares of one of them it would oscillate by f·v Δt/2). Rotation is that of NewtonIntegrator's default for
	unequal moments of inertia (rotAlgorithm delValle2023). Springs: of rock joints as their law books them, with dilation, tension and a closure of
	their own; of others kn × *PolytopeGeom.energyPerStiffness* where there is one, else kn depth²/2, and shear force²/(2 ks). Heights are
	above z = 0, along gravity: that of O.engines' NewtonIntegrator, of several the sum. In a periodic cell velocities are those beside the cell's own
	motion (velGrad · position), whichever of its images a body is in; spins are whole.

	Contacts of other laws count as linear springs: with a Hertzian law, or a stiffness that changes in time (per contact area), this is not
	the energy.

	:returns: [J]
	:raises ValueError: if O.engines has no NewtonIntegrator, or contact functors of polytopes without Ig2_Polytope_Polytope_PolytopeGeom
	"""
	if not integrators():
		raise ValueError('O.engines: there must be a NewtonIntegrator, whose gravity counts')
	moving = [(body.state, *_motion(body.state)) for body in movers() if body.state.mass > 0]
	settings = contactSettings()
	if settings is None and geometryFunctors():
		raise ValueError(
			'O.engines: the InteractionLoop needs an Ig2_Polytope_Polytope_PolytopeGeom(), which has the settings of all contacts'
		)
	with meanwhile([(settings, 'computeEnergy', True)] if settings else []):
		O.step()
	stored = sum(sum(storedEnergy(contact)) for contact in O.interactions if contact.isReal and _moves(contact)) + sum(
		one.energy for one in madeBonds() + madeBolts()
	)
	gravity = gravityOf()
	return sum(_energy(*one, gravity) for one in moving) + stored


def _motion(state):
	# copies: what YADE returns are references, which change with the body
	return Vector3(state.pos), state.ori.conjugate(), _besideTheCell(state), Vector3(state.angVel)


def _besideTheCell(state):
	"""Velocity without that of the cell at this place. A gradient that was set since the last step is not in it yet."""
	return state.vel - O.cell.prevVelGrad * state.pos if O.periodic else Vector3(state.vel)


def _energy(state, position, toBody, velocity, spin, gravity):
	before, after = toBody * spin, toBody * state.angVel
	rotation = sum(moment * one * other for moment, one, other in zip(state.inertia, before, after, strict=True))
	return (state.mass * velocity.dot(_besideTheCell(state)) + rotation) / 2 - state.mass * gravity.dot(position)


def _moves(contact):
	"""Whether forces can move one of the bodies, or its clump: what those that are held store is nobody's."""
	return canMove(O.bodies[contact.id1]) or canMove(O.bodies[contact.id2])


def storedEnergy(contact):
	"""(energy of the normal spring, of the shear spring) of a contact [J], as its law books them in O.energy.

	A contact of another law counts as a linear spring, but where its geometry has the energy whose gradient the force is.
	"""
	geom, phys = contact.geom, contact.phys
	if isinstance(phys, RockJointPhys) and isinstance(geom, PolytopeGeom):
		return phys.normalEnergy(geom), phys.shearEnergy
	perStiffness = getattr(geom, 'energyPerStiffness', -1)
	if perStiffness < 0:
		perStiffness = max(geom.penetrationDepth, 0) ** 2 / 2
	return phys.kn * perStiffness, phys.shearForce.squaredNorm() / (2 * phys.ks) if phys.ks > 0 else 0
