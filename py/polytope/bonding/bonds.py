# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds between the faces of neighbouring bodies: `polytope.bond(…)` (docs/bonds.md)."""

import math
import numbers

from yade import Clump, O, Polytope, PolytopeBond, PolytopeBonds, _polytope

from ..arguments import namedArguments, warn
from ..precision import isNumber, real
from ..scene.present import EngineOfScene

__all__ = ['bond', 'bonds', 'facingFaces', 'intactBonds', 'madeBonds', 'presentBonds', 'removedBonds']

ofScene = EngineOfScene(PolytopeBonds, 'intactInScene')
"""The last engine PolytopeBonds that was in O.engines: a list of engines that is set later may lack it."""


@namedArguments
def bond(
	ids=None,
	gap=None,
	angle=_polytope.facingOfJoints,
	normalStiffness=None,
	shearStiffness=None,
	bendingStiffness=None,
	twistingStiffness=None,
	tensileStrength=None,
	cohesion=None,
	frictionAngle=None,
	bendingShare=1,
):
	"""Bonds all pairs of faces of these bodies that touch, overlap or lie within a gap: ``polytope.bond(tensileStrength=5e6, cohesion=1e7)``.

	Each bond has the area that the two faces have in common, for good, and is without force as the bodies are now. Set O.engines
	first: the bonds are in an engine PolytopeBonds, which is put between InteractionLoop and NewtonIntegrator. Bodies that are bonded
	already and members of one clump are left out, as are pairs of fixed bodies unless *ids* names them. docs/bonds.md has the equations.

	:param ids: bodies (of a clump: its members); default all with a Polytope shape
	:param float gap: largest distance of two faces [m]; default 1e-6 of the smaller body's size: faces that touch or overlap
	:param float angle: largest angle between two faces [rad]
	:param float normalStiffness: per area [Pa/m]; default the joint's of the bodies' RockJointMat
	:param float shearStiffness: per area [Pa/m]; default in the same way
	:param float bendingStiffness: normal stiffness per area in bending [Pa/m]; default *normalStiffness*
	:param float twistingStiffness: shear stiffness per area in twisting [Pa/m]; default *shearStiffness*
	:param float tensileStrength: [Pa]; default the joint's of the bodies' RockJointMat, if that has tensileStrength or cohesion, else infinite: no
	    failure in tension
	:param float cohesion: [Pa]; default in the same way, else infinite: no failure in shear
	:param float frictionAngle: of the shear strength [rad]; default the joint's of the bodies' RockJointMat
	:param float bendingShare: part of the stresses by bending and twisting that counts against the strengths, 0 to 1
	:returns: number of bonds made; where the scene has none then, a warning says so
	:raises ValueError: naming the argument and the remedy
	"""
	pattern = PolytopeBond(
		normalStiffness=_value(normalStiffness, 'normalStiffness'),
		shearStiffness=_value(shearStiffness, 'shearStiffness'),
		bendingStiffness=_value(bendingStiffness, 'bendingStiffness'),
		twistingStiffness=_value(twistingStiffness, 'twistingStiffness'),
		tensileStrength=_value(tensileStrength, 'tensileStrength'),
		cohesion=_value(cohesion, 'cohesion'),
		frictionAngle=_value(frictionAngle, 'frictionAngle'),
		bendingShare=_value(bendingShare, 'bendingShare'),
	)
	if gap is not None and (not isNumber(gap) or not 0 <= gap < math.inf):
		raise ValueError(f'gap: must be a finite distance, at least 0 [m], got {gap!r}')
	if not isNumber(angle):
		raise ValueError(f'angle: must be a number [rad], got {angle!r}')
	bodies = [] if ids is None else _parts(ids)
	if ids is not None and not bodies:
		return 0

	def making(engine):
		made = engine.make(bodies, -1 if gap is None else real(gap), real(angle), pattern)
		if made == 0 and engine.intactCount == 0:
			within = 'touch or overlap' if gap is None else f'lie within {float(gap):g} m'
			movable = '' if ids is not None else ' of which one can move'
			advice = 'give a larger gap or angle' + (', or ids to bond fixed bodies' if movable else '')
			warn(f'no bond was made: no two faces of bodies{movable} {within} and face each other within {float(angle):g} rad; {advice}')
		return made

	return ofScene.make('bonds act', making)[1]


def bonds():
	"""The scene's engine PolytopeBonds, None where there is none."""
	return ofScene.present()


def madeBonds():
	"""All bonds of the scene, failed ones too."""
	engine = bonds()
	return engine.bonds if engine else []


def intactBonds():
	"""Bonds that have not failed, also of bodies that have been erased since the last step."""
	return [bond for bond in madeBonds() if bond.intact]


def presentBonds():
	"""Bonds that have not failed and whose bodies are in the scene."""
	return [bond for bond in intactBonds() if O.bodies[bond.id1] is not None and O.bodies[bond.id2] is not None]


def facingFaces():
	"""The faces that bodies have at each other's, as *bond* finds them: PolytopeBonds that never fail and are in no engine, also where
	bodies touch without a force."""
	pattern = PolytopeBond(normalStiffness=1, shearStiffness=1, tensileStrength=math.inf, cohesion=math.inf, frictionAngle=0)
	return PolytopeBonds().find([], -1, _polytope.facingOfJoints, pattern)


def removedBonds():
	"""An engine PolytopeBonds with intact bonds between bodies of this scene that is no longer in O.engines; None where there is none."""
	return ofScene.removed()


def _value(given, name):
	"""The number for an attribute of PolytopeBond, which has -1 where the bodies' materials decide."""
	if given is None:
		return -1
	if not isNumber(given) or isinstance(given, bool):
		raise ValueError(f'{name}: must be a number, got {given!r}')
	if given == -1:  # what stands for no value
		raise ValueError(f'{name}: must not be negative, got {given!r}')
	return real(given)


def _parts(ids):
	"""Ids of bodies with Polytope shapes, members in place of clumps."""
	parts = []
	try:
		ids = list(ids)
	except TypeError:
		raise ValueError(f'ids: must be a sequence of body ids, got {ids!r}') from None
	for number in ids:
		if isinstance(number, bool) or not isinstance(number, numbers.Integral):
			raise ValueError(f'ids: must be body ids, whole numbers, got {number!r}')
		if not 0 <= number < len(O.bodies) or O.bodies[number] is None:
			raise ValueError(f'ids: there is no body {number}')
		body = O.bodies[number]
		if isinstance(body.shape, Clump):
			parts += list(body.shape.members)
		elif isinstance(body.shape, Polytope):
			parts.append(int(number))
		else:
			raise ValueError(
				f'ids: body {number} has no Polytope shape ({type(body.shape).__name__}); make it with polytope.cuboid or another builder'
			)
	return sorted(set(parts))
