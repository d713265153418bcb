# SPDX-License-Identifier: GPL-2.0-or-later
"""The usual engines of a scene in one line: `polytope.engines(…)`."""

import yade
from yade import (
	BaseMotion,
	Bo1_Box_Aabb,
	Bo1_Facet_Aabb,
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	Bo1_Wall_Aabb,
	Collider,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	IGeomFunctor,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	IPhysFunctor,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	LawFunctor,
	NewtonIntegrator,
	O,
	Polytope,
	PolytopeCollider,
	PolytopeTimeStepper,
	PolytopeWater,
	QuietBoundary,
	RockJointMat,
	Sphere,
	TimeStepper,
	Vector3,
)

from .arguments import namedArguments, number, vector, warn
from .bonding.bolting import bolts, removedBolts
from .bonding.bonds import bonds, removedBonds
from .check import checkOf
from .check.scene import SceneToCheck
from .pictures.films import filmEngines
from .rock.pointHistories import histories
from .scene.ownFunctors import ownBounds, ownContacts, ownLaws
from .scene.radii import inscribedRadius
from .scene.relaxing import relaxing

__all__ = ['engines']

usualNormalDamping, usualDamping = 0.3, 0.2
"""Damping of contacts as a fraction of critical; YADE's artificial damping."""
reach = 0.1
"""verletDist over the inscribed radius of the smallest body that can move, as polytope.check(O, costs=True) advises it."""
reachOfNothing = 0.02
"""verletDist [m] in a scene without such a body."""
firstStep = 1e-8
"""Largest O.dt [s] before PolytopeTimeStepper, the last of the engines, has acted: that of a new scene. A step made before, with YADE's own
engines, leaves 1 s or so."""
allShapes = ('Box', 'Facet', 'Polytope', 'Sphere', 'Wall')
gravityOnEarth = 9.81


@namedArguments
def engines(gravity=None, geometry=None, physics=None, law=None, collider=None, integrator=None, timeStepper=None, damping=None):
	"""The usual engines for the bodies that the scene has: ``O.engines = polytope.engines()``. Make the bodies first.

	ForceResetter; PolytopeCollider with the bounds of all shapes; InteractionLoop with contact functors for the scene's shapes, those of
	loaded extensions among them (not where several are made for the same pair: the warning says how to choose one), physics and laws for
	its materials; the bonds and bolts that there are (polytope.bond, polytope.bolt), the water (polytope.water), moving bases and quiet
	boundaries (baseMotion, quietBoundary), forces that fade (excavate); NewtonIntegrator; PolytopeTimeStepper, for which O.dt begins at
	1e-8 s; histories and films. What is wrong with the scene is warned of, as *check* finds it. Further engines are added to the list:
	``O.engines = polytope.engines() + [PyRunner(…)]``.

	:param Vector3 gravity: [m/s²]; default 9.81 along −z, in scenes of polygons along −y
	:param geometry: an Ig2_Polytope_Polytope_PolytopeGeom, whose settings hold for the contacts of all pairs, or a list of all contact
	    functors; default the plug-in's default contact, and those that extensions have for pairs of the scene's shapes
	:param physics: Ip2 functor or a list of them; default by the materials there are: Ip2_RockJointMat_RockJointMat_RockJointPhys() with
	    stiffnesses per area for RockJointMat, Ip2_FrictMat_FrictMat_FrictPhys() for FrictMat
	:param law: Law2 functor or a list of them; default Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3), and
	    Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False) where there is FrictMat, or spheres without a law of their own
	:param collider: default PolytopeCollider with a verletDist of a tenth of the smallest moving body's inscribed radius
	:param integrator: default NewtonIntegrator(gravity=gravity, damping=damping)
	:param timeStepper: default PolytopeTimeStepper(); False: none, O.dt is yours
	:param float damping: YADE's numerical damping of the integrator, from 0 to below 1; default 0.2, with which scenes come to rest soon and
	    whatever moves is slowed down: 0 for sliding, rolling and falling bodies whose motion is to be compared with theory
	:returns: list of engines
	:raises ValueError: naming an argument that is not of its kind, and *gravity* or *damping* if *integrator* is given too
	"""
	scene = SceneToCheck(O, [])
	for name, value in (('gravity', gravity), ('damping', damping)):
		if integrator is not None and value is not None:
			raise ValueError(f'{name}: belongs to the integrator, which is given too; set it there')
	damping = usualDamping if damping is None else number(damping, 'damping')
	if not 0 <= damping < 1:
		raise ValueError(f'damping: must be from 0 to below 1, got {damping}')
	gravity = _usualGravity(scene) if gravity is None else vector(gravity, 'gravity')
	contacts, joints, laws = _geometry(scene, geometry), _physics(scene, physics), _laws(scene, law)
	loop = InteractionLoop(contacts, joints, laws + (ownLaws(contacts, joints, laws) if law is None else []))
	made = [
		*(engine for engine in O.engines if isinstance(engine, BaseMotion)),
		ForceResetter(),
		_one(collider, Collider, 'collider') or _collider(scene),
		loop,
		*(engine for engine in (bonds() or removedBonds(), bolts() or removedBolts()) if engine),
		*(engine for engine in O.engines if isinstance(engine, (PolytopeWater, QuietBoundary))),
		*relaxing(),
		_one(integrator, NewtonIntegrator, 'integrator') or NewtonIntegrator(gravity=gravity, damping=damping),
	]
	if timeStepper is not False:
		made.append(_one(timeStepper, TimeStepper, 'timeStepper') or PolytopeTimeStepper())
	if isinstance(made[-1], PolytopeTimeStepper):
		O.dt = min(O.dt, firstStep)
	made += [*histories(), *filmEngines()]
	for finding in checkOf(O, made):
		warn(f'{finding.what}: {finding.seen}; {finding.advice}')
	return made


def _one(given, kind, name):
	if given is not None and not isinstance(given, kind):
		raise ValueError(f'{name}: must be a {kind.__name__}, got {given!r}')
	return given


def _several(given, kind, name):
	functors = list(given) if isinstance(given, (list, tuple)) else [given]
	if not functors or not all(isinstance(functor, kind) for functor in functors):
		raise ValueError(f'{name}: must be a functor ({kind.__name__}) or a list of them, got {given!r}')
	return functors


def _usualGravity(scene):
	dimensions = {body.shape.dimension for body in scene.bodies if isinstance(body.shape, Polytope)}
	return Vector3(0, -gravityOnEarth, 0) if dimensions == {2} else Vector3(0, 0, -gravityOnEarth)


def _collider(scene):
	moving = [body.shape for body in scene.bodies if isinstance(body.shape, (Polytope, Sphere)) and scene.moves(body)]
	sizes = [inscribedRadius(shape) for shape in moving]
	bounds = [Bo1_Polytope_Aabb(), Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb(), Bo1_Box_Aabb()]
	bounds += ownBounds({kind.shape for kind in scene.kinds}, bounds)
	return PolytopeCollider(bounds, verletDist=reach * min(sizes) if sizes else reachOfNothing)


def _shapes(scene):
	"""Names of the scene's shapes that contacts are known for; in a scene without bodies all of them."""
	kinds = {kind.shape for kind in scene.kinds} | {'Polytope' for body in scene.bodies if isinstance(body.shape, Polytope)}
	return sorted(kinds & set(allShapes)) or list(allShapes)


def _geometry(scene, given):
	"""Contact functors of all pairs of the scene's shapes for which there are any, those of extensions and *given* among them."""
	if given is not None and type(given) is not Ig2_Polytope_Polytope_PolytopeGeom:
		functors = _several(given, IGeomFunctor, 'geometry')
		kinds = [type(functor).__name__ for functor in functors]
		twice = next((kind for kind in kinds if kinds.count(kind) > 1), None)
		if twice:
			raise ValueError(f'geometry: has {twice} twice; all contacts of a scene have the same settings, so one of each pair is enough')
		return functors
	shapes = _shapes(scene)
	functors = []
	if 'Polytope' in shapes:
		functors.append(given or Ig2_Polytope_Polytope_PolytopeGeom())
		functors += [getattr(yade, f'Ig2_{name}_Polytope_PolytopeGeom')() for name in shapes if name != 'Polytope']
	if 'Sphere' in shapes:
		functors += [getattr(yade, f'Ig2_{name}_Sphere_ScGeom')() for name in shapes if name != 'Polytope']
	return functors + ownContacts({kind.shape for kind in scene.kinds}, functors)


def _physics(scene, given):
	if given is not None:
		return _several(given, IPhysFunctor, 'physics')
	rock, others = _materials(scene)
	return [Ip2_RockJointMat_RockJointMat_RockJointPhys()] * rock + [Ip2_FrictMat_FrictMat_FrictPhys()] * others


def _laws(scene, given):
	rock, others = _materials(scene)
	laws = [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=usualNormalDamping)] * rock
	if given is not None:
		laws, others = _several(given, LawFunctor, 'law'), False
	spheres = 'Sphere' in _shapes(scene) and all(isinstance(one, Law2_PolytopeGeom_RockJointPhys_MohrCoulomb) for one in laws)
	return laws + [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)] * (others or spheres)


def _materials(scene):
	"""(whether there are rock joints, or no bodies yet; whether there is another material)."""
	rock = {isinstance(body.material, RockJointMat) for body in scene.bodies}
	return True in rock or not rock, False in rock
