# SPDX-License-Identifier: GPL-2.0-or-later
"""What an initial stress is warned of: the scene takes it, but moves, or has it less exactly."""

import numpy as np
from yade import O, PolytopeWater

from ...arguments import warn
from ...scene.movers import canMove, moverOf
from ...scene.present import gravityOf
from ..commonFaces import materialOf
from .refusals import accuracy, forcesBorne

__all__ = ['warnOfClosure', 'warnOfGravity']

errorOfClosure = 3
"""Error of a block's stress over the closure of its joints by its width: the rim of faces and neighbours across edges; 2.1 for a cube, 2.7
for slivers (test_in_situ.py)."""


def warnOfGravity(field, faces, chosen):
	"""Where the divergence of the stress, which is that between the blocks (effective), is not weight and water."""
	waters = [engine for engine in O.engines if isinstance(engine, PolytopeWater) and not engine.dead]
	gravity = np.array(gravityOf(), float)
	bears, forces = forcesBorne(field, faces), {}
	for k in chosen:
		body = O.bodies[k]
		if canMove(body):
			left = float(body.shape.volume) * (field.divergence + float(body.material.density) * gravity)
			left += sum(np.array(water.load(k)[0], float) for water in waters)
			forces[moverOf(k)] = forces.get(moverOf(k), np.zeros(3)) + left
	parts = {k: float(np.linalg.norm(left)) / bears[k] for k, left in forces.items() if bears.get(k, 0) > 0}
	worst = max(parts, key=parts.get, default=None)
	if worst is not None and parts[worst] > accuracy:
		loads, water = (
			('gravity and water', ' less the buoyancy ρ_w g of what is under water: it is the stress between the blocks')
			if waters
			else ('gravity', '')
		)
		warn(
			f'gradient: stress and {loads} do not balance, by {parts[worst]:.2g} of what body {worst} bears; the mass will move until they do. '
			f'The divergence of the stress must be -ρg: with z upwards and gravity along -z the derivative of σ_zz along z is ρg{water}'
		)


def warnOfClosure(field, faces, chosen):
	"""Where the closure of joints is a large part of a block."""
	closures = {}
	for face in faces:
		for k in {face.id1, face.id2} & chosen:
			pressure = -float(face.normal @ field.at(face.centroid) @ face.normal)
			closures[k] = max(closures.get(k, 0.0), pressure / float(materialOf(face, k).normalStiffness))
	errors = {k: errorOfClosure * closure / (2 * float(O.bodies[k].shape.inscribedRadius)) for k, closure in closures.items()}
	many = [k for k, error in errors.items() if error > accuracy]
	if many:
		worst = max(many, key=errors.get)
		warn(
			f'stress: joints close by {closures[worst]:.2g} m, and the stress of {len(many)} of {len(chosen)} blocks is off by more than 1 % for that, of body {worst} by some '
			f'{100 * errors[worst]:.2g} %; stiffer joints, or no blocks so thin (*smallest* of jointedRock)'
		)
