# SPDX-License-Identifier: GPL-2.0-or-later
"""What an initial stress is refused for, before anything of the scene is changed."""

import math

import numpy as np
from yade import O, Polytope, RockJointMat, _polytope

from ...bodies.halfSpaces import worldPlanes
from ...bonding.bonds import intactBonds
from ...scene.movers import canMove, moverOf
from ...scene.namedBodies import namedBodies
from ...scene.present import contactSettings, interactionLoops, jointMakers, laws
from ...scene.ranks import refuseDivided
from ...scene.stages import refuseMatchMaker
from ...scene.vertices import worldVertices
from ..commonFaces import contactOf, lesser, materialsOfSides
from ..faceMaterials import materialsOf
from ..faces import areaOfFace

__all__ = ['accuracy', 'forcesBorne', 'massOf', 'refuseField', 'refuseForces', 'refuseScene']

accuracy = 0.01
"""Share of a block's forces that may be missing for want of neighbours, or be left by gravity: so near is the stress to what was asked for."""

wrongForce = 0.05
"""How far a joint's force may be from what was asked, over what a body bears. The rim of its face and neighbours across an edge have a part
of the closure over its width."""

rounding = 1e-9
"""A stress below this share of the largest one at a joint is rounding."""


def massOf(bodies):
	"""Set of ids of the blocks, parts of clumps by themselves."""
	if bodies is None:
		named = [body.id for body in O.bodies if body is not None and isinstance(body.shape, Polytope) and canMove(body)]
	else:
		named = [part for k in namedBodies(bodies, name='bodies') for part in (O.bodies[k].shape.members if O.bodies[k].isClump else (k,))]
	for k in named:
		if not isinstance(O.bodies[k].shape, Polytope):
			raise ValueError(f'bodies: body {k} is a {type(O.bodies[k].shape).__name__}, no Polytope')
	if not any(canMove(O.bodies[k]) for k in named):
		_refuseNoBlocks(bodies is not None)
	return set(named)


def _refuseNoBlocks(areNamed):
	if areNamed:
		raise ValueError(
			'bodies: none of them can move, and a stress is that of blocks that can; name those, without the fixed ones around them'
		)
	if any(body is not None and isinstance(body.shape, Polytope) for body in O.bodies):
		raise ValueError(
			'bodies: all Polytopes are fixed, and a stress is that of blocks that can move; fix only those around the mass (fixed=True)'
		)
	raise ValueError('bodies: there is no Polytope; append the blocks first')


def refuseScene(chosen):
	refuseDivided()
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	if O.periodic:
		raise ValueError('O.periodic: blocks get their stress between fixed blocks; in a periodic cell strain the cell instead')
	makers = jointMakers(interactionLoops())
	if not laws() or not makers:
		raise ValueError('O.engines: set them first, with the law of rock joints: O.engines = polytope.engines()')
	model = contactSettings().contactModel if contactSettings() else 'surface'
	if not all(one.stiffnessPerArea for one in makers) or model not in ('surface', 'foundation'):
		raise ValueError(
			"O.engines: a stress needs joints with stiffness per area and contactModel='surface', the defaults of polytope.engines()"
		)
	refuseMatchMaker()
	if any(
		getattr(functor, name, None) for loop in interactionLoops() for functor in loop.physDispatcher.functors for name in ('kn', 'ks')
	):
		raise ValueError(
			'O.engines: a MatchMaker sets stiffnesses by pairs; a block has the closure of its own material, so give materials theirs'
		)
	for k in chosen:
		others = [material for material in materialsOf(O.bodies[k]) if not isinstance(material, RockJointMat)]
		if others:
			raise ValueError(f'bodies: body {k} is of a {type(others[0]).__name__}; a stress needs joints between RockJointMat')
	if any(contact.isReal for contact in O.interactions):
		raise ValueError('O.interactions: there are contacts already; call inSitu before the first step, or O.interactions.clear() first')
	bonded = {k for bond in intactBonds() for k in (bond.id1, bond.id2)} & chosen
	if bonded:
		raise ValueError(
			f'bodies: body {min(bonded)} is bonded, and a bond has no force as bodies are when it is made; give joints cohesion and tensileStrength in place of bonds'
		)


def refuseField(field, faces, chosen):
	if not faces:
		raise ValueError('bodies: no two faces touch; blocks must lie face on face as polytope.jointedRock makes them')
	_refuseMaterials(faces)
	stresses = [field.at(face.corners) for face in faces]
	largest = max(float(np.abs(several).max()) for several in stresses)
	if largest == 0:
		raise ValueError('stress: is zero at all joints; a mass without stress needs none')
	for face, several in zip(faces, stresses, strict=True):
		pulls = several @ face.normal @ face.normal
		worst = int(np.argmax(pulls))
		if pulls[worst] > rounding * largest:
			place = ', '.join(f'{x:.4g}' for x in face.corners[worst])
			raise ValueError(
				f'stress: tension of {pulls[worst]:.3g} Pa across the joint between {face.id1} and {face.id2} at ({place}); compression is negative, '
				'and a surface where it ends in the mass is where the blocks must end'
			)
	_refuseStrength(field, faces, largest)
	_refuseOverlap(faces, largest)
	_refuseCover(field, faces, chosen)


def _refuseMaterials(faces):
	"""Refuses materials whose joints cannot be given a stress: a face's own material counts before its body's."""
	for face in faces:
		joint, materials = f'bodies: the joint between {face.id1} and {face.id2}', materialsOfSides(face)
		if not all(isinstance(material, RockJointMat) for material in materials):
			raise ValueError(f'{joint} is not between two RockJointMat')
		if not all(material.stiffnessPerArea for material in materials):
			raise ValueError(
				f'{joint} has a stiffness per contact, and a stress needs one per area; give its material, or that of its face, stiffnessPerArea=True'
			)
		closure = next((material.closure for material in materials if material.closure), None)
		if closure:
			raise ValueError(
				f'{joint} has a closure of its own ({type(closure).__name__}). Joints get their stress by blocks that are larger by pressure/normalStiffness, as it '
				'is for linear springs; another closure would make another pressure of it. Give such joints closure=None and the normalStiffness that the closure has at this stress'
			)


def _refuseStrength(field, faces, largest):
	weak = []
	for face in faces:
		traction = field.at(face.centroid) @ face.normal
		normal = -float(traction @ face.normal)
		shear = float(np.linalg.norm(traction + normal * face.normal))
		materials = materialsOfSides(face)
		cohesion, friction = (float(lesser(name, materials)) for name in ('cohesion', 'frictionAngle'))
		if shear > cohesion + normal * math.tan(friction) + rounding * largest:
			weak.append((math.atan2(max(shear - cohesion, 0), normal), face, friction))
	if weak:
		needed, face, friction = max(weak, key=lambda one: one[0])
		raise ValueError(
			f'stress: {len(weak)} of {len(faces)} joints cannot bear it, the one between {face.id1} and {face.id2} needs '
			f'{math.degrees(needed):.1f}° of friction and has {math.degrees(friction):.1f}°; a stress nearer to equal in all directions, or stronger joints'
		)


def _refuseOverlap(faces, largest):
	for face in faces:
		stiffness = float(_polytope.stiffnessInSeries(*(material.normalStiffness for material in materialsOfSides(face))))
		if face.overlap * stiffness > accuracy * largest:
			raise ValueError(
				f'bodies: {face.id1} and {face.id2} overlap by {face.overlap:.3g} m already; blocks must lie face on face, and a stress that they '
				'have from an earlier call cannot be replaced: make the mass anew'
			)


def _refuseCover(field, faces, chosen):
	"""Each face of a block that can move must have neighbours all over, unless the stress leaves it free."""
	touching, bears = {}, forcesBorne(field, faces)
	for face in faces:
		touching.setdefault(face.id1, []).append((face.normal, face.area))
		touching.setdefault(face.id2, []).append((-face.normal, face.area))
	for k in chosen:
		body = O.bodies[k]
		if not canMove(body) or body.isClumpMember:  # members lie on each other
			continue
		vertices, (normals, offsets) = worldVertices(body), worldPlanes(body)
		for normal, offset in zip(normals, offsets, strict=True):
			area = areaOfFace(vertices, normal, offset)
			if area == 0:  # a plane that owns no face
				continue
			covered = sum(part for n, part in touching.get(k, []) if n @ normal > 1 - 1e-4)
			missing = abs(area - covered) * float(np.linalg.norm(field.at(_middle(vertices, normal, offset)) @ normal))
			if missing > accuracy * bears.get(k, 0.0):
				direction = ', '.join(f'{x:.3g}' for x in normal)
				raise ValueError(
					f'bodies: of the face of body {k} towards ({direction}) {covered:.4g} of {area:.4g} m² lies on neighbours, so {missing:.3g} N would be '
					'missing or too much; surround the mass by fixed Polytopes that touch it and do not overlap each other, fill openings and excavate them afterwards'
				)


def _middle(vertices, normal, offset):
	away = offset - vertices @ normal
	return vertices[away <= away.min() + 1e-9 * float(np.ptp(vertices))].mean(axis=0)


def refuseForces(field, faces):
	"""Contacts that do not bear what their joint was given."""
	bears = forcesBorne(field, faces)
	for face in faces:
		asked = -face.area * float(face.normal @ field.at(face.centroid) @ face.normal)
		contact = contactOf(face)
		borne = 0.0 if contact is None else float(contact.phys.normalForce.norm())
		if abs(borne - asked) > wrongForce * min(bears[moverOf(k)] for k in (face.id1, face.id2) if canMove(O.bodies[k])):
			raise ValueError(
				f'bodies: the joint between {face.id1} and {face.id2} would bear {borne:.4g} N for {asked:.4g} N. Do a mask or the collider keep them apart? '
				'Is the closure, pressure over normalStiffness, a large part of a block (stiffer joints)?'
			)


def forcesBorne(field, faces):
	"""id of each mover → half of what its joints bear [N]"""
	bears = {}
	for face in faces:
		for k in {moverOf(face.id1), moverOf(face.id2)}:
			bears[k] = bears.get(k, 0.0) + face.area * float(np.linalg.norm(field.at(face.centroid) @ face.normal)) / 2
	return bears
