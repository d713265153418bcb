# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of polytope.check() of what extensions add (docs/extending.md): shapes, physics. Each yields (what, seen, advice)."""

import itertools

from yade import (
	Body,
	Box,
	Facet,
	FrictMat,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	IPhysFunctor,
	Polytope,
	PolytopeMarginFunctor,
	Shape,
	Sphere,
	Wall,
	_polytope,
)

from ..bodies.polytopes import isotropyTolerance
from ..scene.ownFunctors import ownClasses, ownContactsOf
from ..scene.present import isPerArea, jointMaterials

__all__ = ['contactsToChoose', 'derivedShapes', 'marginsPerArea', 'ownClosures', 'unknownStiffness', 'withoutCore']


def derivedShapes(scene):
	"""Shapes whose radius or margin is none; classes that extensions derive from Polytope: what no stage can know of them."""
	told = {kind for kind in {type(body.shape) for body in scene.bodies} if not _isAsked(kind)}
	for body in scene.bodies:
		kind = type(body.shape)
		if kind in told:
			continue
		derived = isinstance(body.shape, Polytope)
		fault = (_polytope.faultOfShape(body.shape) or faultOfMargin(body.shape)) if derived else _polytope.faultOfFamily(body.shape)
		if fault:
			told.add(kind)
			makes = 'polytope.withShape makes such bodies; ' if derived else 'set the attributes of its shape; '
			yield (
				'shapes',
				f'body {body.id}, a {kind.__name__}: {fault}',
				makes + 'docs/extending.md says what the class must tell',
			)


def _isAsked(kind):
	"""Whether stages ask a class of shapes for its sizes: not those of YADE's that nothing here has a contact with, which may be derived
	from others that have."""
	if kind in (Box, Facet, Sphere, Wall):
		return True
	return kind is not Polytope and (kind in ownClasses(Shape) or bool(ownContactsOf(kind.__name__, 'Polytope')))


def faultOfMargin(shape):
	"""Why the margin of a derived shape is none, as polytope.withShape would say of the shape's attributes; empty: it is one. A step asks
	nothing: with a margin that is no number or below 0 it would be none."""
	usual = Polytope().dict()
	own = {name: value for name, value in shape.dict().items() if name not in usual}
	probe = Body()
	probe.material, probe.shape = FrictMat(density=1), Polytope(normals=shape.normals, offsets=shape.offsets)
	try:
		_polytope.reshape(probe, type(shape)(**own), isotropyTolerance)
	except ValueError as error:
		fault = str(error).removeprefix('shape: ')
		return f'{fault}; its attributes are {own}' if fault.startswith('its margin') else ''
	return ''


def ownClosures(scene):
	"""Normal laws whose parameters were changed after the material had them, which then looked at them."""
	for material in jointMaterials(scene.bodies):
		fault = _polytope.faultOfClosure(material.closure, material.normalStiffness) if material.closure else ''
		if fault:
			yield (
				'joint laws',
				f'closure of RockJointMat {material.label!r}: {fault}',
				'give it parameters with which it is as docs/extending.md says',
			)


def contactsToChoose(one, other, present):
	"""What to do where the loop has no contact functor for two classes, one of which is of an extension. *present*: names of those that it
	has, for classes that these are derived from."""
	own = [name for name in ownContactsOf(one, other) if name not in present]
	if not own:
		return f'no loaded extension has one: write it (docs/extending.md), or keep {one} and {other} apart by the masks of the bodies'
	if len(own) == 1:
		return f'add {own[0]}() to the InteractionLoop; polytope.engines() without geometry has it'
	return f'choose one: polytope.engines(geometry=[Ig2_Polytope_Polytope_PolytopeGeom(), {own[0]}(), …]), or {", ".join(own[1:])} in its place'


def marginsPerArea(scene, functor, maker, one, other):
	"""Contacts by margins have no area, so that with a stiffness per area there is no force."""
	if not isinstance(functor, PolytopeMarginFunctor) or not isinstance(maker, Ip2_RockJointMat_RockJointMat_RockJointPhys):
		return
	sides = [_jointMaterialsOf(scene, kind) for kind in (one, other)]
	for pair in itertools.product(*sides):
		if all(isPerArea(material, [maker]) for material in pair):
			yield (
				'units',
				f'{one.shape} and {other.shape} touch by their margins, without an area, and the stiffnesses of RockJointMat {pair[0].label!r} are per area: they pass through each other',
				'polytope.engines(physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)), and stiffnesses in N/m',
			)
			return


def withoutCore(scene, functor, one, other):
	"""Shapes that a functor by margins is made for, and whose family has no core for it: polygons are none in space."""
	if not isinstance(functor, PolytopeMarginFunctor):
		return
	for kind in dict.fromkeys((one, other)):
		if not _polytope.hasMarginCore(scene.examples[kind].shape):
			flat = kind.variant == 2 and isinstance(scene.examples[kind].shape, Polytope)
			yield (
				'contact functors',
				f'{type(functor).__name__} meets bodies by their cores, and '
				+ (f'a {kind.shape} of dimension 2 has none' if flat else f'{kind.shape} has none')
				+ ': such pairs are counted as failures',
				'make it a polyhedron, a thin prism' if flat else 'give its family the function core (docs/extending.md)',
			)


def _jointMaterialsOf(scene, kind):
	return jointMaterials(
		body for body in scene.bodies if type(body.shape).__name__ == kind.shape and type(body.material).__name__ == kind.material
	)


def unknownStiffness(scene, maker, one, other):
	"""Physics of an extension that do not tell the time step how stiff they can be."""
	if not isinstance(maker, tuple(ownClasses(IPhysFunctor))):
		return
	if not _polytope.givesStiffnesses(maker, *(scene.examples[kind].material for kind in (one, other))):
		yield (
			'time step',
			f'{type(maker).__name__} does not say how stiff its contacts can be: before the first contact the step is that of elastic bodies of the materials\' young',
			'give it the function stiffnesses (docs/extending.md), or set O.dt until bodies touch',
		)
