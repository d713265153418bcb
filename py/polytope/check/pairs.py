# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of polytope.check() that go the way of a contact: bound, geometry, physics, law.

For each pair of shapes and materials that can meet, the dispatchers themselves are asked, with a body of each kind.
"""

import yade
from yade import Polytope, PolytopeGeom, PolytopeMarginFunctor, Shape

from ..scene.ownFunctors import ownClasses, ownContactsOf
from ..scene.present import contactSettings
from .extensions import contactsToChoose, marginsPerArea, unknownStiffness, withoutCore
from .materials import nameOfDefault

__all__ = ['notPeriodicLaws', 'pairFindings', 'unsuitedLaws']

yadesOwn = ('Box', 'Facet', 'Sphere', 'Wall')
"""Shapes that this module has contacts with polytopes for."""
exactly = (*yadesOwn, 'Polytope', 'GridNode')
"""Classes that a functor of polytopes meets as what they are. YADE passes those derived from Sphere to the functor of spheres."""

unsuitedLaws = (
	'Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM',
	'Law2_ScGeom_MindlinPhys_HertzWithLinearShear',
	'Law2_ScGeom_MindlinPhys_MindlinDeresiewitz',
)
"""Laws whose moments are those of spheres: the normal force has none, and a body never topples (tests/yade/contact/test_yades_laws.py)."""

notPeriodicLaws = ('Law2_ScGeom_FrictViscoPhys_CundallStrackVisco', 'Law2_ScGeom_MindlinPhys_Mindlin')
"""Laws that do so in a periodic cell."""

noFunctor = 'the InteractionLoop has no functor for {} and {}: they pass through each other'


def pairFindings(scene):
	yield from bounds(scene)
	if scene.loops:
		told = set()
		for one in _contacts(scene):
			if one[:2] not in told:
				told.add(one[:2])
				yield one


def bounds(scene):
	"""A body without a bound is in no pair."""
	if not scene.colliders:
		return
	meeting = {kind.shape: kind for pair in scene.meetings() for kind in pair}
	for name, kind in meeting.items():
		if all(collider.boundDispatcher.dispFunctor(scene.examples[kind].shape) is None for collider in scene.colliders):
			own = f'Bo1_{name}_Aabb'
			makes = own if hasattr(yade, own) or not isinstance(scene.examples[kind].shape, Polytope) else 'Bo1_Polytope_Aabb'
			yield 'bounds', f'the collider has no functor for {name}: such bodies touch nothing', f'add {makes}() to the collider'


def _contacts(scene):
	for one, other in scene.meetings():
		polytopes = [kind for kind in (one, other) if kind.shape == 'Polytope' or _isDerived(kind)]
		found = None
		if polytopes and not _hasItsOwn(scene, one, other):
			found = geometry(scene, one, other) or (flat(one, other) if any(kind.variant == 2 for kind in polytopes) else None)
		if found:
			yield found
			continue
		loops = [
			(loop, functor)
			for loop in scene.loops
			if (functor := _functor(loop.geomDispatcher, scene.examples[one].shape, scene.examples[other].shape))
		]
		if not loops:
			candidates = _candidates(one.shape, other.shape)
			advice = f'add {candidates[0]}()' if candidates else contactsToChoose(one.shape, other.shape, ())
			if candidates or _isOfExtension(one) or _isOfExtension(other):
				yield 'contact functors', noFunctor.format(one.shape, other.shape), advice
			continue
		yield from (finding for loop, functor in loops[:1] for finding in forces(scene, loop, functor, one, other))


def _isOfExtension(kind):
	"""Whether it is a class of shapes that an extension has brought."""
	return any(made.__name__ == kind.shape for made in ownClasses(Shape))


def _isDerived(kind):
	"""Whether it is a class derived from Polytope, as extensions have them."""
	taken = getattr(yade, kind.shape, None)
	return bool(taken) and taken is not yade.Polytope and issubclass(taken, yade.Polytope)


def _hasItsOwn(scene, one, other):
	"""Whether a contact functor in the loop is made for just these classes, one of which is of an extension, or asks them for their cores,
	whatever their classes are."""
	if not any(kind.shape not in exactly for kind in (one, other)):
		return False
	shapes = [scene.examples[kind].shape for kind in (one, other)]
	functors = [_functor(loop.geomDispatcher, *shapes) for loop in scene.loops]
	wanted = sorted([one.shape, other.shape])
	return any(functor and (isinstance(functor, PolytopeMarginFunctor) or sorted(functor.bases) == wanted) for functor in functors)


def _functor(dispatcher, *arguments):
	"""The dispatcher's functor; None also where it cannot decide."""
	try:
		return dispatcher.dispFunctor(*arguments)
	except RuntimeError:
		return None


def _candidates(one, other):
	"""Names of the functors that make a contact of two shapes of these names; for shapes that are seldom in one scene no functor is asked for."""
	if not {one, other} <= {'Polytope', *yadesOwn}:
		return []
	starts = {f'Ig2_{one}_{other}_', f'Ig2_{other}_{one}_'}
	return sorted(
		name for name in dir(yade) if any(name.startswith(start) for start in starts) and name.endswith(('_PolytopeGeom', '_ScGeom'))
	)


def geometry(scene, one, other):
	"""Shapes that no contact with a polytope is computed for."""
	present = {type(functor).__name__ for loop in scene.loops for functor in loop.geomDispatcher.functors}
	advice = contactsToChoose(one.shape, other.shape, present)
	shapes = [scene.examples[kind].shape for kind in (one, other)]
	derived = next((kind for kind in (one, other) if _isDerived(kind)), None)
	if derived and any(_functor(loop.geomDispatcher, *shapes) for loop in scene.loops):
		seen = f'there is no functor for {one.shape} and {other.shape}: {derived.shape} is taken for the Polytope of its planes'
		return 'contact functors', seen, advice
	strangers = [kind for kind in (one, other) if kind.shape not in exactly]
	if derived or (strangers and ownContactsOf(one.shape, other.shape)):
		return 'contact functors', noFunctor.format(one.shape, other.shape), advice
	if not strangers:
		return None
	name = strangers[0].shape
	taken = getattr(yade, name, None)
	like = ', and is taken for a sphere' if taken and issubclass(taken, yade.Sphere) else ''
	advice = 'make the body of convex polytopes (fromVertices, fromMesh), or its surface of Facets'
	return 'contact functors', f'{name} has no contact with polytopes{like}', advice


def flat(one, other):
	"""Polygons (dimension 2) touch polygons, and what is a prism along z."""
	flatOne, partner = (one, other) if one.shape == 'Polytope' and one.variant == 2 else (other, one)
	if partner.shape == 'Polytope' and partner.variant == 3:
		return (
			'polygons',
			'polygons (dimension 2) and polyhedra can meet: such pairs are counted as failures',
			'make all bodies with polytope.polygon, or none',
		)
	if partner.shape in ('Box', 'Facet') or (partner.shape == 'Wall' and partner.variant == 2):
		which = 'Wall along z (axis=2)' if partner.shape == 'Wall' else partner.shape
		return (
			'polygons',
			f'a polygon does not touch a {which}',
			'make floors and walls with polytope.polygon(corners, fixed=True), or as Wall along x or y',
		)
	return None


def forces(scene, loop, functor, one, other):
	"""Physics and law of a pair whose geometry this functor makes."""
	geom = _made(type(functor).__name__)
	maker = _functor(loop.physDispatcher, scene.examples[one].material, scene.examples[other].material)
	if maker is None:
		yield (
			'materials',
			f'the InteractionLoop has no physics for {one.material} and {other.material}: YADE ends the run',
			_ofOneMaterial(one, other),
		)
		return
	phys = _made(type(maker).__name__)
	if geom is None or phys is None:
		return
	yield from unknownStiffness(scene, maker, one, other)
	yield from withoutCore(scene, functor, one, other)
	yield from marginsPerArea(scene, functor, maker, one, other)
	yield from noRockJoint(scene, geom, phys, one, other)
	law = _functor(loop.lawDispatcher, geom, phys)
	names = f'{type(geom).__name__} and {type(phys).__name__} ({one.shape} and {other.shape})'
	if law is None:
		yield 'laws', f'the InteractionLoop has no law for {names}: such contacts have no force', _lawFor(geom, phys)
	elif isinstance(geom, PolytopeGeom):
		name = type(law).__name__
		if name in unsuitedLaws:
			yield (
				'laws',
				f'{name} applies forces as on spheres: a polytope with it never topples',
				f'{_lawFor(geom, phys)}; docs/making-bodies.md lists those that suit',
			)
		elif getattr(law, 'sphericalBodies', False):
			yield 'laws', f'{name} has sphericalBodies=True: its moments are those of spheres', f'{name}(sphericalBodies=False)'
		elif name in notPeriodicLaws and scene.O.periodic:
			seen = f'{name} in a periodic cell: its moments are those of spheres there'
			yield (
				'laws',
				seen,
				'take Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False) or Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()',
			)
	if law is not None and isinstance(geom, PolytopeGeom) and undamped(scene, maker, law, phys, one, other):
		damper = 'normalDamping of the law' if isinstance(phys, yade.RockJointPhys) else 'RockJointMat'
		yield (
			'damping and energy',
			f"contacts of polytopes by {type(maker).__name__} have no damping, nor has NewtonIntegrator: with contactModel 'boon2012' they gain energy",
			f"contactModel='surface', or {damper}, or NewtonIntegrator.damping above 0 (usual: 0.2)",
		)


def noRockJoint(scene, geom, phys, one, other):
	"""A rock joint's material beside one of YADE's own. Spheres touch at a point, where friction is right."""
	joints = ['RockJointMat' in kind.material for kind in (one, other)]
	if 'Sphere' in (one.shape, other.shape) or not isinstance(geom, PolytopeGeom) or type(phys) is not yade.FrictPhys or all(joints) == any(joints):
		return
	joint, alone = (one, other) if joints[0] else (other, one)
	labels = [scene.examples[kind].material.label for kind in (joint, alone)]
	if labels[1] == nameOfDefault:
		return  # materials.py tells of it
	yield (
		'no rock joint',
		f"contacts of {joint.material} {labels[0]!r} with {alone.material} {labels[1]!r} are YADE's own: stiffness from young, friction at one point, "
		"without the joint's stiffnesses, cohesion and laws",
		'RockJointMat for both, if they should be joints',
	)


def undamped(scene, maker, law, phys, one, other):
	"""Contacts on two flat-faced bodies without loss in the normal direction, by the model whose force is no gradient of an energy. A
	sphere has none of it."""
	settings = contactSettings(scene.loops)
	if 'Sphere' in (one.shape, other.shape) or not settings or settings.contactModel != 'boon2012':
		return False
	if not scene.integrators or any(float(engine.damping) > 0 for engine in scene.integrators):
		return False
	if isinstance(phys, yade.RockJointPhys):
		return not getattr(law, 'normalDamping', 1) > 0
	if isinstance(phys, yade.MindlinPhys):
		return not any(getattr(maker, name) for name in ('en', 'es', 'betan', 'betas'))
	return type(phys) in (yade.FrictPhys, yade.ViscoFrictPhys)  # the creep of the latter acts on shear alone


def _made(functor):
	"""An empty instance of what a functor makes, by the last word of its name."""
	made = getattr(yade, functor.rsplit('_', 1)[-1], None)
	return made() if made else None


def _lawFor(geom, phys):
	if isinstance(geom, PolytopeGeom) and isinstance(phys, yade.RockJointPhys):
		return 'add Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()'
	if isinstance(geom, PolytopeGeom) and isinstance(phys, yade.MindlinPhys):
		return 'take Law2_ScGeom_MindlinPhys_Mindlin()'
	if isinstance(geom, PolytopeGeom) and isinstance(phys, yade.JCFpmPhys):
		return 'take RockJointMat, whose cohesion and tensileStrength do the same, with its Ip2 and Law2, or polytope.bond()'
	if isinstance(geom, yade.ScGeom) and isinstance(phys, yade.FrictPhys):
		return f'add Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies={not isinstance(geom, PolytopeGeom)})'
	return f'add a law for {type(geom).__name__} and {type(phys).__name__}'


def _ofOneMaterial(one, other):
	yades = 'add Ip2_FrictMat_FrictMat_FrictPhys() and Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)'
	if 'RockJointMat' in (one.material, other.material):
		return f'give all bodies a RockJointMat with Ip2_RockJointMat_RockJointMat_RockJointPhys(), or {yades} for the other pairs'
	if one.material == other.material == 'FrictMat':
		return f'make bodies of RockJointMat, or {yades}'
	return f'add an Ip2 functor for {one.material} and {other.material}'
