# SPDX-License-Identifier: GPL-2.0-or-later
"""Initial stress of a rock mass: `polytope.inSitu(…)` (docs/stress-and-excavation.md)."""

import numpy as np
from yade import Collider, ForceResetter, InteractionLoop, O, RockJointMat, Vector3

from ...arguments import namedArguments
from ...scene.present import interactionLoops, meanwhile
from ..commonFaces import commonFaces, contactOf, lesser, materialsOfSides
from .field import StressField
from .refusals import massOf, refuseField, refuseForces, refuseScene
from .unloadedSize import closures, enlarge, restore
from .warnings import warnOfClosure, warnOfGravity

__all__ = ['inSitu']


@namedArguments
def inSitu(stress, gradient=None, bodies=None):
	"""Gives a blocky mass a state of stress as initial contact forces, before the first step: ``polytope.inSitu(numpy.diag((-4e6, -4e6, -6e6)))``.

	Tension is positive, as in *polytope.bodyStress*: compression is negative. Blocks lie as they are cut, face on face, with fixed
	Polytopes all around but at surfaces that the stress leaves free. Each joint gets the normal and shear force of σ·n over its area,
	linear over the face. For that blocks get the size that they have without load: larger by half of the closure p/kₙ at each joint, with
	the mass that they had. Nothing else moves. The stress of each block is the one asked for to about three times the closure over the
	block's width.

	O.engines must be set. The stress should balance gravity, or the mass moves until it does: ∂σ_ik/∂x_k + ρ g_i = 0. With z upwards and
	σ_zz = 0 at z = 0, σ_zz = ρ g z and σ_xx = σ_yy = k₀ σ_zz:
	``polytope.inSitu(numpy.zeros((3, 3)), gradient=[0 * k, 0 * k, 2600 * 9.81 * k])`` with ``k = numpy.diag((k0, k0, 1))``.

	:param stress: symmetric (3, 3) tensor at the origin of coordinates [Pa]
	:param gradient: (3, 3, 3) its derivatives along x, y and z, each symmetric [Pa/m]; default none
	:param bodies: ids of the blocks; default all free Polytopes. Joints with neighbours that are not among them, fixed ones too, get the stress
	:returns: the number of joints that have got it
	:raises ValueError: naming the argument and the remedy; the scene is as it was
	"""
	field = StressField(stress, gradient)
	chosen = massOf(bodies)
	refuseScene(chosen)
	faces = commonFaces(chosen)
	refuseField(field, faces, chosen)
	warnOfGravity(field, faces, chosen)
	warnOfClosure(field, faces, chosen)
	before = enlarge(closures(faces, field))
	try:
		_makeContacts()
		refuseForces(field, faces)
		count = _shear(field, faces)
	except Exception:
		O.interactions.clear()
		restore(before)
		raise
	_act()
	return count


def _makeContacts():
	"""Joints with tensile strength get it when they have their force: their own bond takes it up as it is then."""
	materials = [one for one in O.materials if isinstance(one, RockJointMat) and one.tensileStrength > 0]
	with meanwhile([(material, name, 0) for material in materials for name in ('residualTensileStrength', 'tensileStrength')]):
		_act()


def _act():
	"""Contacts and their forces, without a step."""
	for engine in O.engines:
		if isinstance(engine, (ForceResetter, Collider, InteractionLoop)) and not engine.dead:
			engine()
	O.forces.f(0, sync=True)  # YADE resets forces for as many bodies as it has summed them for


def _shear(field, faces):
	intactUntil = [
		functor.intactUntilStep
		for loop in interactionLoops()
		for functor in loop.physDispatcher.functors
		if hasattr(functor, 'intactUntilStep')
	]
	mayBeIntact = all(step < 0 or O.iter <= step for step in intactUntil)
	count = 0
	for face in faces:
		contact = contactOf(face)
		if contact is None:
			continue
		_setShear(contact, face, field)
		sides = materialsOfSides(face)
		tensile = lesser('tensileStrength', sides)
		if tensile > 0:
			contact.phys.tensileStrength, contact.phys.intact = tensile, mayBeIntact
			# the cap of the Ip2 functor, which has met both strengths as zero (_makeContacts)
			contact.phys.residualTensileStrength = min(tensile, lesser('residualTensileStrength', sides))
		count += 1
	return count


def _setShear(contact, face, field):
	phys, normal = contact.phys, np.array(contact.geom.normal, float)
	across = np.eye(3) - np.outer(normal, normal)
	# of a polygon's contact the point is the centre of its pressure, not of its face
	middle = face.centroid if O.bodies[contact.id1].shape.dimension == 2 else np.array(phys.shearPoint, float)
	# on body 2, whose outward normal is −n
	force = -float(phys.contactArea) * across @ field.at(middle) @ normal
	phys.shearForce = Vector3(*force.tolist())
	turning = -np.einsum('kij,j->ik', field.slope, normal)  # of the traction with the place
	moments = turning @ face.second  # ∫ traction ⊗ r
	phys.twistingMoment = float(np.einsum('ijk,i,kj', _permutation, normal, moments))


_permutation = np.array([[[(i - j) * (j - k) * (k - i) / 2 for k in range(3)] for j in range(3)] for i in range(3)])
"""The permutation symbol: (a × b)ᵢ = permutation[i, j, k] aⱼ bₖ"""
