# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.check names each mistake in a scene, with the remedy, and finds nothing wrong with right scenes.

Every mistake is one change of a right scene; its finding must come by that change alone.
"""

import importlib
import math
import warnings

import pytest
import yade
from boon2012.falling.scene import FallingPolyhedra
from scenes import bounds, runInBackground, withPolytopes
from yade import (
	BartonBandisStrength,
	Bo1_Polytope_Aabb,
	ForceResetter,
	FrictMat,
	GlobalStiffnessTimeStepper,
	HyperbolicClosure,
	Ig2_Box_Sphere_ScGeom,
	Ig2_Facet_Sphere_ScGeom,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Polytope_PolytopeGeom,
	Ig2_Sphere_Sphere_ScGeom,
	Ig2_Wall_Sphere_ScGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Ip2_FrictMat_FrictMat_MindlinPhys,
	Ip2_JCFpmMat_JCFpmMat_JCFpmPhys,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	JCFpmMat,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	Law2_ScGeom_FrictPhys_CundallStrack,
	Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM,
	Law2_ScGeom_MindlinPhys_HertzWithLinearShear,
	Law2_ScGeom_MindlinPhys_Mindlin,
	NewtonIntegrator,
	O,
	Polytope,
	PolytopeCollider,
	PolytopeTimeStepper,
	Quaternion,
	RockJointMat,
	RotationEngine,
	TriaxialStressController,
	polytope,
	utils,
)

withSpheres = (Ig2_Sphere_Sphere_ScGeom, Ig2_Wall_Sphere_ScGeom, Ig2_Facet_Sphere_ScGeom, Ig2_Box_Sphere_ScGeom)


def rock(**attributes):
	return RockJointMat(**{'density': 2600, 'normalStiffness': 1e8, 'shearStiffness': 1e8, 'frictionAngle': 0.6, **attributes})


def scene(others=list, material=None, physics=None, laws=None):
	"""A block above a floor, with the bodies that others() makes, and an engine for everything."""
	O.reset()
	O.materials.append(material or rock())
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.55), (0.5, 0.4, 0.5)))
	O.bodies.append(others())
	O.engines = [
		ForceResetter(),
		PolytopeCollider([one() for one in bounds], verletDist=0.02),
		InteractionLoop(
			[one() for one in (*withPolytopes, *withSpheres)],
			physics or [Ip2_RockJointMat_RockJointMat_RockJointPhys()],
			laws or [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(), Law2_ScGeom_FrictPhys_CundallStrack()],
		),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.2),
		PolytopeTimeStepper(),
	]


def otherShapes():
	return [
		utils.sphere((0, 0, 3), 0.3),
		utils.sphere((2, 0, 3), 0.3),
		utils.wall((0, 0, -2), axis=2),
		utils.facet([(-5, -5, -1), (5, -5, -1), (0, 5, -1)]),
		utils.box((4, 0, 0), (0.1, 1, 1), fixed=True),
	]


def loop():
	return O.engines[2]


def without(functors, kind):
	return [one for one in functors if type(one) is not kind]


def onlyFinding(what):
	found = polytope.check(O)
	assert [one.what for one in found] == [what], repr(found)
	assert found[what].seen and found[what].advice and found[what].advice in repr(found)
	return found[what]


# ------------------------------------------------------------------------------------------------ right scenes


def testRightScenesGiveNothing():
	scene()
	assert not polytope.check(O) and 'nothing' in repr(polytope.check(O))
	scene(otherShapes)
	assert not polytope.check(O)
	for _ in range(300):
		O.step()
	assert not polytope.check(O), 'nor with contacts'
	FallingPolyhedra(number=20).build()
	assert not polytope.check(O)


def testRightSceneOfYadesMaterial():
	scene(
		material=FrictMat(density=2600, young=1e8),
		physics=[Ip2_FrictMat_FrictMat_FrictPhys()],
		laws=[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
	)
	assert not polytope.check(O)
	scene(
		material=FrictMat(density=2600, young=1e8), physics=[Ip2_FrictMat_FrictMat_MindlinPhys()], laws=[Law2_ScGeom_MindlinPhys_Mindlin()]
	)
	assert not polytope.check(O)


def testRightSceneOfPolygons():
	scene()
	O.bodies.clear()
	O.bodies.append(polytope.polygon([(-2, -1), (2, -1), (2, 0), (-2, 0)], fixed=True))
	O.bodies.append(polytope.polygon([(0, 0.1), (1, 0.1), (0, 1)]))
	O.bodies.append(utils.wall((-3, 0, 0), axis=0))
	assert not polytope.check(O)


def testRightSceneWithAClumpAndMasks():
	"""Members of one clump do not meet, nor do bodies without a common bit."""
	scene()
	O.bodies.appendClumped([polytope.cuboid((0, 0, 2), (0.2, 0.2, 0.2)), utils.sphere((0, 0, 2.2), 0.2)])
	assert not polytope.check(O)
	for kind in (Ig2_Sphere_Polytope_PolytopeGeom, Ig2_Sphere_Sphere_ScGeom):
		loop().geomDispatcher.functors = without(loop().geomDispatcher.functors, kind)
	assert polytope.check(O), 'the sphere of the clump meets floor and block'
	for body in O.bodies:
		if isinstance(body.shape, yade.Sphere):
			body.mask = 2
	assert not polytope.check(O)


def testTheOrderOfEnginesIsARound():
	scene()
	O.engines = O.engines[2:4] + O.engines[:2] + O.engines[4:]
	assert not polytope.check(O)


# ------------------------------------------------------------------------------------------------ engines


@pytest.mark.parametrize('missing, words', [(0, 'ForceResetter'), (1, 'collider'), (2, 'InteractionLoop'), (3, 'NewtonIntegrator')])
def testMissingEngine(missing, words):
	scene()
	O.engines = O.engines[:missing] + O.engines[missing + 1 :]
	assert f'no {words}' in onlyFinding('engines').seen


def testForceResetterAfterTheLoop():
	scene()
	resetter, collider, interactions, newton, stepper = O.engines
	O.engines = [collider, interactions, resetter, newton, stepper]
	assert 'put ForceResetter first' in onlyFinding('order of engines').advice


def testSpringWithStiffnessPerArea():
	scene()
	loop().geomDispatcher.functors = [Ig2_Polytope_Polytope_PolytopeGeom(contactModel='spring')]
	assert 'stiffnessPerArea=False' in onlyFinding('damping and energy').advice
	loop().physDispatcher.functors[0].stiffnessPerArea = False
	assert not polytope.check(O)


@pytest.mark.parametrize(('contactModel', 'units'), [('foundation', ['contact']), ('spring', ['area']), ('surface', [])])
def testAModelBesideMaterialsOfBothUnits(contactModel, units):
	scene()
	O.bodies[0].material = RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5, stiffnessPerArea=False)
	loop().geomDispatcher.functors = [Ig2_Polytope_Polytope_PolytopeGeom(contactModel=contactModel)]
	seen = [finding.seen for finding in polytope.check(O) if finding.what == 'damping and energy']
	assert [f'contactModel {contactModel!r} with stiffnesses per {unit}: the force is no gradient of an energy' for unit in units] == seen


@pytest.mark.parametrize('contactModel', ['foundation', 'spring'])
def testAModelForYadesOwnPhysics(contactModel):
	"""Functors for joints beside YADE's own, as polytope.engines() has them, where no body has a joint's material."""
	scene(material=FrictMat(density=2600, young=1e8, frictionAngle=0.5))
	loop().geomDispatcher.functors = [Ig2_Polytope_Polytope_PolytopeGeom(contactModel=contactModel)]
	loop().physDispatcher.functors += [Ip2_FrictMat_FrictMat_FrictPhys()]
	loop().lawDispatcher.functors += [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]
	seen = [finding.seen for finding in polytope.check(O) if 'contactModel' in finding.seen]
	assert len(seen) == (contactModel == 'foundation') and all('per contact' in one for one in seen)


@pytest.mark.parametrize(
	('name', 'value', 'seen'),
	[
		('frictionAngle', 0.1, 'coefficient of friction ('),
		('normalStiffness', 3e8, 'normalStiffness ('),
		('shearStiffness', 3e7, 'shearStiffness ('),
		('stiffnessPerArea', False, 'unit of its stiffness (Pa/m)'),
		('cohesion', 2e4, 'cohesion (10000, not 20000)'),
	],
)
def testMaterialsThatWereChanged(name, value, seen):
	scene(material=RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5, cohesion=1e4))
	O.bodies[1].state.pos = (0, 0, 0.4999)
	O.run(20, True)
	assert any(contact.isReal for contact in O.interactions)
	assert 'material' not in {one.what for one in polytope.check(O)}
	setattr(O.materials[-1], name, value)
	assert seen in {one.what: one.seen for one in polytope.check(O)}['material']
	O.interactions.clear()
	assert 'material' not in {one.what for one in polytope.check(O)}


def testMaterialsOfAMatchMakerAndOfAFailedJointAreTheirOwn():
	scene(material=RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5, residualFrictionAngle=0.4))
	O.bodies[1].state.pos = (0, 0, 0.4999)
	O.run(20, True)
	next(contact for contact in O.interactions if contact.isReal).phys.tangensOfFrictionAngle = math.tan(0.4)
	loop().physDispatcher.functors[0].frictAngle = yade.MatchMaker(algo='val', val=0.3)
	assert 'material' not in {one.what for one in polytope.check(O)}


def testPointWithoutArea():
	scene()
	functor = Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012', contactPoint='chebyshevCentre')
	loop().geomDispatcher.functors = [functor]
	found = {one.what: one for one in polytope.check(O)}
	assert "contactPoint='analyticCentre'" in found['contact point'].advice
	functor.contactPoint = 'analyticCentre'
	assert 'contact point' not in {one.what for one in polytope.check(O)}
	functor.contactPoint = 'chebyshevCentre'
	loop().physDispatcher.functors[0].stiffnessPerArea = False
	assert 'contact point' not in {one.what for one in polytope.check(O)}


def testNoDampingAtAllWithYadesMaterial():
	"""The chord's spring gains energy. Damping anywhere, a rock joint or the contact model surface is the remedy."""
	paper = Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012')
	frict = {'material': FrictMat(density=2600, young=1e8), 'laws': [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]}
	scene(**frict, physics=[Ip2_FrictMat_FrictMat_FrictPhys()])
	O.engines[3].damping = 0
	assert not polytope.check(O)
	loop().geomDispatcher.functors = [paper]
	found = onlyFinding('damping and energy')
	assert 'Ip2_FrictMat_FrictMat_FrictPhys have no damping' in found.seen
	assert 'RockJointMat' in found.advice and 'NewtonIntegrator.damping above 0' in found.advice
	scene()
	O.engines[3].damping = 0
	assert not polytope.check(O), 'rock joints have an energy'
	viscous = {'en': yade.MatchMaker(algo='val', val=0.5), 'es': yade.MatchMaker(algo='val', val=0.5)}
	for physics, number in (({}, 1), (viscous, 0)):
		scene(
			material=FrictMat(density=2600, young=1e8),
			physics=[Ip2_FrictMat_FrictMat_MindlinPhys(**physics)],
			laws=[Law2_ScGeom_MindlinPhys_Mindlin()],
		)
		O.engines[3].damping = 0
		loop().geomDispatcher.functors = [paper]
		assert len(polytope.check(O)) == number
	scene(lambda: [utils.sphere((0, 0, 3), 0.3)], **frict, physics=[Ip2_FrictMat_FrictMat_FrictPhys()])
	O.bodies.erase(1)
	O.engines[3].damping = 0
	assert not polytope.check(O), 'a sphere on a polytope is a spring'


def testASceneThatIsEmptyAtFirst():
	"""A runner that waits for a time waits for ever, unless PolytopeCollider has the step of its virtPeriod."""
	scene()
	O.bodies.erase(1)
	O.dt = 1e-8
	O.engines = [*O.engines, yade.PyRunner(command='pass', iterPeriod=1)]
	assert 'waits for ever' in onlyFinding('time step').seen
	O.engines[-1].virtPeriod = 0.01
	assert not polytope.check(O)


# ------------------------------------------------------------------------------------------------ pairs


@pytest.mark.parametrize('name', ['Polytope', 'Sphere', 'Wall', 'Facet', 'Box'])
def testMissingBound(name):
	scene(otherShapes)
	collider = O.engines[1]
	collider.boundDispatcher.functors = without(collider.boundDispatcher.functors, getattr(yade, f'Bo1_{name}_Aabb'))
	found = onlyFinding('bounds')
	assert f'no functor for {name}' in found.seen and f'Bo1_{name}_Aabb()' in found.advice


@pytest.mark.parametrize('kind', [*withPolytopes, *withSpheres])
def testMissingContactFunctor(kind):
	scene(otherShapes)
	loop().geomDispatcher.functors = without(loop().geomDispatcher.functors, kind)
	assert onlyFinding('contact functors').advice == f'add {kind.__name__}()'


@pytest.mark.parametrize(
	'name, words', [('PFacet', 'no contact with polytopes'), ('Cylinder', 'taken for a sphere'), ('GridConnection', 'taken for a sphere')]
)
def testShapesThatHaveNoContact(name, words):
	scene()
	body = utils.sphere((0, 0, 3), 0.3, fixed=True)
	body.shape = getattr(yade, name)()
	O.bodies.append(body)
	O.engines[1].boundDispatcher.functors = [*O.engines[1].boundDispatcher.functors, getattr(yade, f'Bo1_{name}_Aabb')()]
	found = onlyFinding('contact functors')
	assert found.seen.startswith(name) and words in found.seen and 'Facets' in found.advice


@pytest.mark.parametrize(
	'partner, words',
	[
		(lambda: polytope.cuboid((5, 0, 0), (1, 1, 1), fixed=True), 'polyhedra'),
		(lambda: utils.facet([(5, 0, 0), (6, 0, 0), (5, 1, 0)]), 'Facet'),
		(lambda: utils.box((5, 0, 0), (1, 1, 1), fixed=True), 'Box'),
		(lambda: utils.wall((0, 0, -1), axis=2), 'Wall along z'),
	],
	ids=['polyhedron', 'facet', 'box', 'wall'],
)
def testPolygonsThatMeetWhatTheyDoNotTouch(partner, words):
	scene()
	O.bodies.clear()
	O.bodies.append([polytope.polygon([(0, 0.1), (1, 0.1), (0, 1)]), partner()])
	found = onlyFinding('polygons')
	assert words in found.seen and 'polytope.polygon' in found.advice


@pytest.mark.parametrize('partner', ['wall', 'box', 'facet', 'cuboid'])
def testPolygonsDoNotTouchThemIndeed(partner):
	"""A polygon that overlaps one feels no force."""
	scene()
	O.bodies.clear()
	floor = {
		'wall': lambda: utils.wall((0, 0, 0.45), axis=2),
		'box': lambda: utils.box((0, -1, 0), (3, 1.01, 1), fixed=True),
		'facet': lambda: utils.facet([(-3, 0.01, -3), (3, 0.01, -3), (0, 0.01, 3)]),
		'cuboid': lambda: polytope.cuboid((0, -1, 0), (3, 1.01, 1), fixed=True),
	}
	O.bodies.append([polytope.polygon([(0, 0), (1, 0), (0, 1)]), floor[partner]()])
	O.step()
	O.step()
	assert not any(contact.isReal for contact in O.interactions)


def testFrictMatWithThePhysicsOfRockJoints():
	scene()
	O.bodies[1].material = FrictMat(density=2600)
	found = onlyFinding('materials')
	assert 'RockJointMat and FrictMat' in found.seen and 'give all bodies a RockJointMat' in found.advice
	scene(material=FrictMat(density=2600))
	assert 'FrictMat and FrictMat' in onlyFinding('materials').seen


def testARockJointsMaterialBesideYadesOwn():
	scene(
		physics=[Ip2_RockJointMat_RockJointMat_RockJointPhys(), Ip2_FrictMat_FrictMat_FrictPhys()],
		laws=[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(), Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
	)
	O.bodies[1].material = FrictMat(density=2600, young=1e8, label='grain')
	assert "with FrictMat 'grain' are YADE's own" in onlyFinding('no rock joint').seen


def testLawThatIsMissing():
	scene(laws=[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)], physics=[Ip2_FrictMat_FrictMat_MindlinPhys()])
	loop().lawDispatcher.functors = [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()]
	assert 'no law for PolytopeGeom and MindlinPhys' in onlyFinding('laws').seen


def testLawOfSphericalBodies():
	scene(material=FrictMat(density=2600), physics=[Ip2_FrictMat_FrictMat_FrictPhys()], laws=[Law2_ScGeom_FrictPhys_CundallStrack()])
	assert onlyFinding('laws').advice == 'Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)'
	scene(lambda: [utils.sphere((0, 0, 3), 0.3)], laws=[Law2_ScGeom_FrictPhys_CundallStrack()])
	assert onlyFinding('laws').what, 'a rock joint between polytopes too'


@pytest.mark.parametrize(
	'material, physics, law',
	[
		(FrictMat, Ip2_FrictMat_FrictMat_MindlinPhys, Law2_ScGeom_MindlinPhys_HertzWithLinearShear),
		(JCFpmMat, Ip2_JCFpmMat_JCFpmMat_JCFpmPhys, Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM),
	],
)
def testLawsThatNeverToppleABody(material, physics, law):
	scene(material=material(density=2600), physics=[physics()], laws=[law()])
	found = onlyFinding('laws')
	assert law.__name__ in found.seen and 'never topples' in found.seen and 'docs/making-bodies.md' in found.advice
	assert 'take ' in found.advice, 'there is none for these physics that could be added'


# ------------------------------------------------------------------------------------------------ bodies and materials


@pytest.mark.parametrize('first', ['all', 'floor', 'nothing'])
def testBodiesMadeBeforeTheirMaterial(first):
	"""YADE gives them its own: 1000 kg/m³ in place of 2600, and a friction angle of 0.5."""
	O.reset()
	made = [polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True)] if first != 'nothing' else []
	made += [polytope.cuboid((0, 0, 0.3), (0.3, 0.3, 0.3))] if first == 'all' else []
	O.materials.append(rock())
	O.bodies.append(made)
	if first == 'nothing':
		O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	if first != 'all':
		O.bodies.append(polytope.cuboid((0, 0, 0.3), (0.3, 0.3, 0.3)))
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')
		O.engines = polytope.engines()
	if first == 'nothing':
		assert not polytope.check(O)
		return
	found = onlyFinding('default material')
	assert ('2 bodies (body 0 first)' if first == 'all' else 'body 0 has') in found.seen and '1000 kg/m³' in found.seen
	assert (
		'no body has O.materials[1]' if first == 'all' else 'body 1 has a RockJointMat'
	) in found.seen and 'O.materials.append' in found.advice


def testNegativeDensity():
	material = rock()
	scene(material=material)
	material.density = -2600  # builders refuse it; a script may set it afterwards
	for body in O.bodies:
		body.state.mass *= -1
	found = polytope.check(O)
	assert [one.what for one in found] == ['density', 'mass'] and '-2600' in found['density'].seen and 'mass -' in found['mass'].seen


def testMassZero():
	scene()
	O.bodies[1].state.mass = 0
	assert 'body 1 can move and has mass 0' in onlyFinding('mass').seen
	O.bodies[1].dynamic, O.dt = False, 1e-4
	assert not polytope.check(O), 'one that is held needs none'


def testInertiaZero():
	scene()
	O.bodies[1].state.inertia = (0, 1, 1)
	assert 'no inertia' in onlyFinding('mass').seen


def testMeshInMillimetres(tmp_path):
	trimesh = pytest.importorskip('trimesh')
	path = tmp_path / 'brick.stl'
	trimesh.creation.box((100, 100, 100)).export(path)
	scene()
	O.bodies.erase(1)
	O.bodies.append(polytope.fromMesh(path))
	assert [one.what for one in polytope.check(O)] == ['size', 'overlap']  # the floor lies in it
	found = polytope.check(O)['size']
	assert '100 m across and weighs 2.6e+09 kg' in found.seen and 'scale=0.001' in found.advice
	scene()
	O.bodies.append([polytope.fromMesh(path, scale=0.001, center=(k, 0, 2)) for k in (1, 2)])
	assert not polytope.check(O)
	scene()
	O.bodies.erase(1)
	O.bodies.append([polytope.cuboid((0, 0, k), (0.01, 0.01, 0.01)) for k in range(1, 4)] + [polytope.cuboid((20, 0, 0), (5, 5, 5))])
	assert '10 m across' in onlyFinding('size').seen, 'grains of 2 cm beside one of 10 m'


@pytest.mark.parametrize('flat', [False, True])
def testALargeBlockOfALargeSlopeIsInMetres(flat):
	"""A wedge of 89 m; on a base of the size of a brick it is in other units."""
	for half, found in ((45, False), (2, True)):
		O.reset()
		O.materials.append(rock(normalStiffness=1e10, shearStiffness=1e10))
		if flat:
			O.bodies.append(polytope.polygon([(-half, -1), (half, -1), (half, 0), (-half, 0)], fixed=True))
			O.bodies.append(polytope.polygon([(-44.5, 0), (44.5, 0), (0, 40)]))
		else:
			O.bodies.append(polytope.cuboid((0, 0, -1), (half, half, 1), fixed=True))
			O.bodies.append(polytope.cuboid((0, 0, 20), (44.5, 20, 20)))
		O.engines = polytope.engines(gravity=(0, -9.81 * flat, -9.81 * (not flat)))
		assert any(one.what == 'size' for one in polytope.check(O)) == found


def onFaces(**joint):
	"""A block on a floor, in touch; the faces that meet have a material of their own."""
	O.materials.append(rock(label='joint', **joint))
	O.bodies.erase(1)
	number = O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.4, 0.5), material=0))
	for shape, way in ((O.bodies[0].shape, 1), (O.bodies[number].shape, -1)):
		shape.faceMaterials = [1 if way * normal[2] > 0.9 else -1 for normal in shape.normals]
	return number


def testMaterialsOfFacesAreLookedAt():
	scene()
	number = onFaces(cohesion=1e4)
	assert 'joints with cohesion' in polytope.check(O)['gravity at once'].seen
	scene()
	onFaces(normalStiffness=1e4, shearStiffness=1e4)
	assert 'normalStiffness 1e+04 ' in polytope.check(O)['stiffness'].seen
	scene()
	onFaces(young=2e9)
	assert "young of RockJointMat 'joint' is set" in polytope.check(O)['elastic constants'].seen
	scene()
	onFaces(normalStiffness=3e6, shearStiffness=3e6)
	O.bodies[number].state.pos += (0, 0, 1e-4)
	assert 'normalStiffness of 3e+06 Pa/m' in polytope.check(O)['soft joint'].seen


@pytest.mark.parametrize(
	'length, mass, time', [(1e3, 1e-3, 1), (1e3, 1e3, 1e3), (1e3, 1, 1e3), (1e2, 1e3, 1), (1e6, 1, 1), (1, 1e-3, 1), (3.28084, 2.20462, 1)]
)
def testUnitsThatAgreeWithEachOther(length, mass, time):
	"""mm-t-s, mm-g-ms, mm-kg-ms, cm-g-s, µm-kg-s, m-t-s, ft-lb-s: the scene of 1 m is as sound as in metres."""
	O.reset()
	stiffness = 1e8 * mass / length**2 / time**2
	O.materials.append(rock(density=2600 * mass / length**3, normalStiffness=stiffness, shearStiffness=stiffness))
	O.bodies.append(polytope.cuboid((0, 0, -0.5 * length), (2 * length, 2 * length, 0.5 * length), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.6 * length), (0.5 * length,) * 3))
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		O.engines = polytope.engines(gravity=(0, 0, -9.81 * length / time**2))
	assert not polytope.check(O)


@pytest.mark.parametrize(
	'density, words', [(2.6, 'in t and m, stiffnesses in kN'), (2.6e-9, 'with lengths in mm, gravity is 9810'), (0.2, 'rock has 2600')]
)
def testDensitiesInOtherUnits(density, words):
	scene(material=rock(density=density))
	found = onlyFinding('density')
	assert f'is {density:g}, less than that of any rock' in found.seen and words in found.advice
	with pytest.warns(UserWarning, match='density: '):
		polytope.engines()
	scene(material=rock(density=density * 1000))
	assert density < 1 or not polytope.check(O), 'a block of that in kg/m³'


def testItTellsOfSizesAndMasses():
	"""A stone of 40 m, of dimensions in millimetres, may be meant: it is to be seen."""
	scene()
	assert (
		repr(polytope.check(O))
		== 'nothing was found that is wrong\n1 body can move, 1 m across, 2.08e+03 kg; what is fixed is 4 m across; gravity is (0.0, 0.0, -9.81) m/s²'
	)
	O.reset()
	O.materials.append(rock())
	O.bodies.append(polytope.cuboid((0, 0, 21), (20, 20, 20)))
	O.engines = polytope.engines()
	assert repr(polytope.check(O)).endswith(
		'1 body can move, 40 m across, 1.66e+08 kg; nothing is fixed; gravity is (0.0, 0.0, -9.81) m/s²'
	)
	polytope.clump([polytope.cuboid((100, 0, 0), (1, 1, 1)), polytope.cuboid((102, 0, 0), (1, 1, 1))])
	assert '2 bodies can move, 4 to 40 m across, 4.16e+04 to 1.66e+08 kg' in repr(polytope.check(O)), 'of the clump as a whole'
	O.bodies.append(utils.sphere((0, 0, 190), 45))
	O.engines = polytope.engines()
	assert '3 bodies can move, 4 to 90 m across' in repr(polytope.check(O))


def testMasksWithoutABit():
	scene()
	O.bodies[1].mask = 0
	assert 'touch nothing' in onlyFinding('masks').seen
	O.bodies.append(polytope.cuboid((0, 0, 3), (0.5, 0.4, 0.5)))
	assert not polytope.check(O), 'one of several may be a marker'


def testAnEngineThatMovesNothing():
	scene()
	O.engines = [RotationEngine(ids=[77], rotationAxis=(0, 0, 1), angularVelocity=0), *O.engines]
	assert 'RotationEngine moves body 77' in onlyFinding('engines').seen
	O.engines = [RotationEngine(ids=[0], rotationAxis=(0, 0, 1), angularVelocity=0), *O.engines[1:]]
	assert not polytope.check(O)


def testAnEngineThatMovesAFreeBody():
	scene()
	O.engines = [RotationEngine(ids=[1], rotationAxis=(0, 0, 1), angularVelocity=0), *O.engines]
	found = onlyFinding('engines')
	assert 'RotationEngine moves body 1, which is free' in found.seen and 'fixed=True' in found.advice
	O.bodies[1].state.blockedDOFs = 'Z'
	assert not polytope.check(O), 'it is held where the engine turns it'


@pytest.mark.parametrize('gravity', [(0, 0, 9.81), (0, 9.81, 0), (0, 0, -9.81)])
def testGravityAwayFromTheFloor(gravity):
	"""(0, 9.81, 0): past the floor, which reaches as far as the block does to the side; nobody knows whether that is meant."""
	scene()
	integrator = next(engine for engine in O.engines if isinstance(engine, yade.NewtonIntegrator))
	integrator.gravity = gravity
	if gravity[2] > 0:
		assert 'body 1 is below all that is fixed' in onlyFinding('falls').seen
	else:
		assert not polytope.check(O)


def testABodyThatFellPastTheFloor():
	"""After a run check() finds such a body; its speed does not make the joint too soft."""
	scene(lambda: [polytope.cuboid((5, 0, 0.5), (0.1, 0.1, 0.1))])
	assert not polytope.check(O)
	while O.time < 2:
		O.step()
	found = onlyFinding('falls')
	assert found.seen.startswith('body 2 is below')


def testAFloorThatNothingMeets():
	scene()
	O.bodies[0].mask = 2
	assert 'body 1 has no bit of its mask, 1,' in onlyFinding('masks').seen
	O.bodies.append(polytope.cuboid((0, 0, 3), (0.5, 0.4, 0.5)))
	O.bodies[2].mask = 3
	assert not polytope.check(O), 'the other one may hold it'


def testASceneWithoutAnythingFixedIsTold():
	scene()
	assert 'nothing is fixed' not in repr(polytope.check(O))
	O.bodies[0].dynamic = True
	assert 'nothing is fixed' in repr(polytope.check(O)), 'beside what it finds: bodies of the floor may touch'


def testABodyBelowTheFloor():
	scene(lambda: [polytope.cuboid((0, 0, -3), (0.3, 0.1, 0.05)), polytope.cuboid((0.5, 0, -3), (0.1, 0.1, 0.05))])
	found = onlyFinding('falls')
	assert found.seen.startswith('body 2 is below') and 'so are 1 others' in found.seen


def testATimeStepThatWasNeverSet():
	"""YADE's own O.dt: the run does not end in a lifetime, and nothing else is wrong with it."""
	scene()
	O.engines = [engine for engine in polytope.engines() if not isinstance(engine, PolytopeTimeStepper)]
	O.dt = 1e-8
	found = onlyFinding('time step')
	assert 'nothing sets it' in found.seen and 'times as many steps' in found.seen and 'PolytopeTimeStepper()' in found.advice
	O.dt = 1.1e-8  # somebody wants it so
	assert not polytope.check(O)


def testYadesRecorderKnowsNoPolytopes():
	scene()
	engines = list(O.engines)
	O.engines = [*engines, yade.VTKRecorder(fileName='x', recorders=['spheres'], iterPeriod=10)]
	assert not polytope.check(O)
	for recorder in 'intr', 'all':
		O.engines = [*engines, yade.VTKRecorder(fileName='x', recorders=['spheres', recorder], iterPeriod=10)]
		assert 'PolytopeVTKRecorder' in onlyFinding('recorder').advice


def testNothingThatCanMove():
	scene()
	O.bodies[1].dynamic = False
	O.dt = 1e-8
	assert 'no body can move, and O.dt is 1e-08 s' in onlyFinding('time step').seen
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		polytope.engines()  # bodies may follow
	O.engines = [*O.engines, yade.RotationEngine(ids=[1], angularVelocity=1)]
	assert not polytope.check(O) and repr(polytope.check(O)).endswith('no body can move')
	O.engines, O.dt = O.engines[:-1], 1e-4
	assert not polytope.check(O)


def testDensityScalingIsForSpheres():
	"""YADE ends the process, whether it is set in the stepper or in the integrator."""
	scene()
	with pytest.warns(UserWarning, match='^density scaling: .* for spheres'):
		O.engines = polytope.engines(timeStepper=GlobalStiffnessTimeStepper(defaultDt=1e-4, densityScaling=True))
	assert 'densityScaling=False' in onlyFinding('density scaling').advice
	O.engines = polytope.engines(timeStepper=GlobalStiffnessTimeStepper(defaultDt=1e-4))
	assert not polytope.check(O)
	O.engines[3].densityScaling = True
	assert 'ends the process' in onlyFinding('density scaling').seen
	for k in range(2):
		O.bodies.erase(k)
	O.bodies.append(utils.sphere((0, 0, 1), 0.3))
	assert 'density scaling' not in [one.what for one in polytope.check(O)]


def testStiffnessPerContactWithStiffnessPerArea():
	scene(material=rock(normalStiffness=1e5))
	O.bodies.erase(1)
	O.bodies.append(polytope.cuboid((0, 0, 0.02), (0.02, 0.02, 0.02)))
	found = onlyFinding('stiffness')
	assert '1e+05 Pa/m' in found.seen and 'meant in N/m' in found.advice and 'stiffnessPerArea=False' in found.advice
	loop().physDispatcher.functors[0].stiffnessPerArea = False
	assert not polytope.check(O)


def testStiffnessTooLowForTheSpeed():
	scene(material=rock(normalStiffness=1e6))
	O.engines[3].gravity = (0, 0, 0)
	assert not polytope.check(O)
	O.bodies[1].state.vel = (0, 0, -10)
	assert 'sinks in by' in onlyFinding('stiffness').seen


def testJointLawsOfOneSideAlone():
	law = {'strength': BartonBandisStrength(), 'closure': HyperbolicClosure()}
	for name in law:

		def other():
			return [polytope.cuboid((5, 0, 2), (0.5, 0.5, 0.5), material=O.materials.append(rock(label='other', **{name: law[name]})))]  # noqa: B023

		scene(other)
		found = onlyFinding('joint laws')
		assert type(law[name]).__name__ in found.seen and f'law in {name}' in found.advice
		scene(other, material=rock(**{name: law[name]}))
		assert not polytope.check(O)


def testYoungThatNothingReads():
	scene(material=rock(young=5e7))
	assert 'young of RockJointMat' in onlyFinding('elastic constants').seen
	loop().physDispatcher.functors = [*loop().physDispatcher.functors, Ip2_FrictMat_FrictMat_FrictPhys()]
	assert not polytope.check(O)


@pytest.mark.parametrize('name', ['pos', 'ori', 'vel', 'angVel'])
def testBodyThatIsNowhere(name):
	scene()
	wrong = yade.Quaternion(math.nan, 0, 0, 1) if name == 'ori' else (0, math.nan, 0)
	setattr(O.bodies[1].state, name, wrong)
	found = onlyFinding('not a number')
	assert f'body 1: state.{name} is not a finite number' in found.seen and 'PolytopeTimeStepper()' in found.advice
	setattr(O.bodies[1].state, name, yade.Quaternion(1, 0, 0, 0) if name == 'ori' else (0, math.inf, 0))
	assert bool(polytope.check(O)) == (name != 'ori')


def testBodiesInTheSamePlace():
	scene()
	O.bodies.append(polytope.cuboid((0, 0, 0.55), (0.5, 0.4, 0.5)))
	found = onlyFinding('same place')
	assert 'body 1 and body 2' in found.seen and 'O.bodies.erase()' in found.advice
	O.step()
	O.step()
	contact = O.interactions[1, 2]
	assert contact.geom.status == 'noDirection' and contact.phys.normalForce.norm() == 0, 'nothing presses them apart'
	scene(lambda: [polytope.cuboid((0, 0, 0.55), (0.5, 0.4, 0.5), mask=2)])
	O.bodies[0].mask = 3
	assert not polytope.check(O)
	for other in ((0, 0, 0.56), (0.5, 0.4, 0.5)), ((0, 0, 0.55), (0.5, 0.4, 0.45)), ((0, 0, 0.55), (0.25, 0.8, 0.5)):
		scene(lambda other=other: [polytope.cuboid(*other)])
		onlyFinding('overlap')


def testFrictionAngleInDegrees():
	scene(
		material=FrictMat(density=2600, young=1e8, frictionAngle=35, label='basalt'),
		physics=[Ip2_FrictMat_FrictMat_FrictPhys()],
		laws=[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
	)
	found = onlyFinding('friction angle')
	assert "FrictMat 'basalt' is 35 rad" in found.seen and 'frictionAngle=radians(35)' in found.advice
	O.materials[0].frictionAngle = math.radians(35)
	assert not polytope.check(O)
	with pytest.raises(ValueError, match='frictionAngle'):
		rock(frictionAngle=35)


def testTensileStrengthOfAJointIsNoGlue():
	scene(material=rock(tensileStrength=1e5))
	assert not polytope.check(O)  # with a stiffness per area it is (test_joint_tension.py)
	scene(material=rock(tensileStrength=1e5), physics=[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)])
	found = onlyFinding('tension')
	assert '1e+05 Pa' in found.seen and 'polytope.bond()' in found.advice


@pytest.mark.parametrize('name', ['cohesion', 'tensileStrength'])
def testStrengthThatIsLostToTheOtherSide(name):
	def touching(material):
		O.bodies[1].state.pos = (0, 0, 0.5)
		return [polytope.cuboid((1, 0, 0.5), (0.5, 0.4, 0.5), material=O.materials.append(material))]

	strong = rock(label='strong', **{name: 4e4, 'residualCohesion' if name == 'cohesion' else 'residualTensileStrength': 4e4})
	scene(lambda: touching(strong))
	found = polytope.check(O)['joint strength']
	assert (
		found.seen.startswith('the joint of body ')
		and f'has no {name}' in found.seen
		and "4e+04 Pa of RockJointMat 'strong' and 0 of" in found.seen
	)
	O.bodies[0].shape.faceMaterials = [1] * 6  # by joints of their own
	O.bodies[1].shape.faceMaterials = [1] * 6
	assert not any(one.what == 'joint strength' for one in polytope.check(O))


def testTheFaceThatLiesOnTheContactSaysWhichStrengthIsLost():
	"""A block stands on an edge between two faces without strength, on a floor with cohesion: by the rule of the contact's physics the
	floor's face counts on both sides."""
	O.materials.append(rock(label='weak'))
	O.materials.append(rock(label='strong', cohesion=4e4, residualCohesion=4e4))
	floor = polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), material=1, fixed=True)
	block = polytope.cuboid((0, 0, 0.5 * math.sqrt(2) - 1e-7), (0.5, 0.5, 0.5), Quaternion((1, 0, 0), math.pi / 4), material=0)
	floor.shape.faceMaterials, block.shape.faceMaterials = [1] * 6, [0] * 6
	O.bodies.append([floor, block])
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')
		O.engines = polytope.engines(gravity=(0, 0, -9.81))
		said = polytope.check(O)
	assert not any(one.what == 'joint strength' for one in said)
	O.run(1, wait=True)
	(contact,) = [one for one in O.interactions if one.isReal]
	assert contact.phys.cohesion == 4e4


@pytest.mark.parametrize('name', ['cohesion', 'tensileStrength'])
def testStrengthInMegapascals(name):
	for value, found in ((0.2, True), (2e5, False)):
		scene(material=rock(**{name: value, 'residualCohesion' if name == 'cohesion' else 'residualTensileStrength': value}))
		said = [one for one in polytope.check(O) if one.what == 'joint strength']
		assert bool(said) == found
	scene(material=rock(**{name: 0.2}))
	assert '0.2 MPa are 200000' in polytope.check(O)['joint strength'].advice


def testDilationAboveFriction():
	scene(material=rock(dilationAngle=0.7))
	assert 'dilationAngle 40.1° of RockJointMat' in onlyFinding('dilation').seen
	scene(material=rock(dilationAngle=0.6))
	assert not polytope.check(O)


@pytest.mark.parametrize('distance, deep', [(0.1, True), (0.5, True), (0.8, True), (0.95, True), (0.99, False), (1.1, False)])
def testBlocksPlacedIntoEachOther(distance, deep):
	"""Cubes of edge 1: at 0.1 they overlap by nine tenths."""
	scene(lambda: [polytope.cuboid((3 + k * distance, 0, 2), (0.5, 0.5, 0.5)) for k in range(2)])
	if not deep:
		assert not polytope.check(O)
		return
	found = onlyFinding('overlap')
	assert 'body 2 and body 3' in found.seen and 'cloud' in found.advice
	O.bodies[3].mask = 2
	assert 'overlap' not in [one.what for one in polytope.check(O)]


@pytest.mark.parametrize(
	'height, deep', [(0.0049, True), (0.0, True), (-0.02, True), (-0.5, True), (-0.97, True), (0.009, True), (0.0099, False)]
)
@pytest.mark.parametrize('aside', [0.0, 0.7])
def testASmallBodyPlacedIntoALargeOne(height, deep, aside):
	"""A cube of 2 cm in a floor of 1 m: it left at up to 77 m/s, and only one near the floor's middle was found."""
	scene(lambda: [polytope.cuboid((aside, aside, height), (0.01, 0.01, 0.01))])
	O.bodies.erase(1)
	if deep:
		assert 'body 0 and body 2' in onlyFinding('overlap').seen
	else:
		assert 'overlap' not in [one.what for one in polytope.check(O)]


@pytest.mark.parametrize(
	'second, half, shared',
	[((3.5, 0, 2), (1, 0.5, 0.5), True), ((4, 0, 2), (1, 0.5, 0.5), False), ((2, 0, 2), (0.2, 2, 0.2), False), ((3, 0.7, 2), (0.3, 1, 0.5), True)],
)
def testMembersOfAClumpWithAFaceInCommon(second, half, shared):
	"""Two bars one behind the other that lie in each other; that touch; a cross without faces in one plane; a T."""
	scene(lambda: [])
	bars = [polytope.cuboid((2, 0, 2), (1, 0.5, 0.5)), polytope.cuboid(second, half)]
	polytope.clump(bars)
	if not shared:
		assert 'overlapping members' not in [one.what for one in polytope.check(O)]
		return
	found = next(one for one in polytope.check(O) if one.what == 'overlapping members')
	assert 'twice the stiffness' in found.seen and 'touch' in found.advice


@pytest.mark.parametrize('attribute, value, what', [('mat', None, 'material'), ('shape', None, 'shape'), ('shape', Polytope, 'shape'), ('mat', FrictMat, 'material')])
def testABodyInContactThatLacksSomething(attribute, value, what):
	"""YADE ends the process where it meets a body without a material, and at a contact of two materials that nothing joins."""
	scene()
	O.bodies[1].state.pos = (0, 0, 0.4999)
	O.step()
	setattr(O.bodies[1], attribute, value and value())
	found = [one for one in polytope.check(O) if one.what == what]
	assert found and 'body 1' in found[0].seen


@pytest.mark.parametrize('perArea, damping', [(False, 0), (False, 0.2), (True, 0)])
@pytest.mark.parametrize(
	'places, concave',
	[([(0, 0), (1, 0), (1, 1)], True), ([(0, 0), (1, 0), (2, 0)], False), ([(0, 0), (1, 0), (2.5, 1)], False), ([(0, 0), (1.5, 0), (1.5, 1)], False)],
)
def testClumpsThatAreNotConvex(places, concave, perArea, damping):
	"""An L of three cubes; a bar; bars and a cube apart. It matters per contact, where nothing dampens."""
	scene(material=rock(stiffnessPerArea=perArea, normalStiffness=1e7))
	polytope.clump([polytope.cuboid((x / 2, 0, 2 + z / 2), (0.25, 0.25, 0.25)) for x, z in places])
	O.engines = polytope.engines(damping=damping)
	found = [one.what for one in polytope.check(O)]
	assert ('concave clump' in found) == (concave and not perArea and damping == 0)


def thrownCube(depth, support, perArea=True, size=0.04):
	"""A cube so deep in what it stands on; the finding, and the greatest speed upwards without damping."""
	O.reset()
	O.materials.append(rock(stiffnessPerArea=perArea, normalStiffness=1e8 if perArea else 1.6e5, shearStiffness=1e5))
	O.bodies.append(support())
	cube = O.bodies.append(polytope.cuboid((0, 0, size / 2 - depth), (size / 2, size / 2, size / 2)))
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')
		O.engines = polytope.engines(damping=0, law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0, shearDamping=0))
	found, speed = polytope.check(O), 0.0
	for _ in range(150):
		O.run(2, True)
		speed = max(speed, O.bodies[cube].state.vel[2])
	return [one for one in found if one.what == 'overlap'], speed


supports = {
	'polytope': lambda: polytope.cuboid((0, 0, -0.5), (0.5, 0.5, 0.5), fixed=True),
	'facet': lambda: utils.facet([(-1, -1, 0), (1, -1, 0), (0, 1, 0)]),
	'wall': lambda: utils.wall(0, axis=2),
	'box': lambda: utils.box((0, 0, -0.5), (0.5, 0.5, 0.5), fixed=True),
}


@pytest.mark.parametrize('perArea', [True, False])
@pytest.mark.parametrize('kind', supports)
def testAnOverlapIsToldByTheSpeedItGives(kind, perArea):
	"""The cube leaves at √(k A / m) d; from 0.89 m/s on it is told, that of a fall over its edge."""
	for depth in 0.0005, 0.0015:
		found, speed = thrownCube(depth, supports[kind], perArea)
		assert speed == pytest.approx(depth * math.sqrt(1.6e5 / 0.1664), rel=0.1)
		assert bool(found) == (speed > math.sqrt(2 * 9.81 * 0.04))
		if found:
			assert float(found[0].seen.split('at up to ')[1].split(' m/s')[0]) == pytest.approx(speed, rel=0.1)


@pytest.mark.parametrize('kind', supports)
def testACentreBeyondTheSurface(kind):
	assert thrownCube(0.03, supports[kind])[0], 'of a facet and a wall it is thrown out on the other side'


def testAnOverlapThatBearsALoadIsNone():
	"""A contact that exists may carry what lies on it."""
	found, _ = thrownCube(0.0015, supports['polytope'])
	assert found
	O.bodies[1].state.pos = (0, 0, 0.02 - 0.0015)
	O.step()
	assert O.interactions[0, 1].isReal and 'overlap' not in [one.what for one in polytope.check(O)]


@pytest.mark.parametrize('height, found', [(-0.01, True), (0.005, True), (0.017, True), (0.019, False), (0.021, False)])
def testASphereInAPolytope(height, found):
	O.reset()
	O.materials.append(rock())
	O.bodies.append(supports['polytope']())
	O.bodies.append(utils.sphere((0, 0, height), 0.02))
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')
		O.engines = polytope.engines()
	assert ('overlap' in [one.what for one in polytope.check(O)]) == found


def testASphereBesideAnEdgeIsInNoFace():
	"""The sphere's ball crosses both planes of the edge and touches nothing."""
	O.reset()
	O.materials.append(rock())
	O.bodies.append(supports['polytope']())
	O.bodies.append(utils.sphere((0.515, 0, 0.015), 0.02))
	O.engines = polytope.engines()
	assert not polytope.check(O)


def testAStoneInTheWallOfACupOfFacets(tmp_path):
	mesh = pytest.importorskip('trimesh').creation.cylinder(0.2, 0.3)
	mesh.export(tmp_path / 'cup.stl')
	for place, wrong in ((0.195, True), (0.1, False)):
		O.reset()
		O.materials.append(rock())
		O.bodies.append(polytope.facets(str(tmp_path / 'cup.stl')))
		O.bodies.append(polytope.cuboid((place, 0, 0), (0.05, 0.05, 0.05)))
		with warnings.catch_warnings():
			warnings.simplefilter('ignore')
			O.engines = polytope.engines()
		assert ['overlap'] * wrong == [one.what for one in polytope.check(O)]


@pytest.mark.parametrize('sheared', [0, 0.3])
@pytest.mark.parametrize('place, what', [(1.2, 'same place'), (2.25, 'overlap'), (-0.75, 'overlap'), (0.5, None)])
def testBodiesThatMeetAcrossTheBoundary(place, what, sheared):
	O.reset()
	O.materials.append(rock())
	O.periodic = True
	O.cell.hSize = yade.Matrix3(1, sheared, 0, 0, 1, 0, 0, 0, 1)
	O.bodies.append([polytope.regular(12, 0.1, (0.2, 0.2, 0.2)), polytope.regular(12, 0.1, (place + 2 * sheared, 2.2, 0.2))])
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')
		O.engines = polytope.engines(gravity=(0, 0, 0))
	assert [one.what for one in polytope.check(O)] == ([what] if what else [])


def testPartsOfAClumpMayOverlap():
	scene()
	polytope.clump([polytope.cuboid((3, 0, 2), (0.5, 0.5, 0.5)), polytope.cuboid((3.1, 0, 2.05), (0.5, 0.4, 0.4))])
	assert not polytope.check(O)


def testABoxWithoutThickness():
	scene(lambda: [utils.box((0, 0, -2), (3, 3, 0), fixed=True)])
	assert 'without a thickness' in onlyFinding('size').seen


def testAFacetWithoutAnArea():
	"""Told before the run, in which its contacts would fail; one that is only small or long is none of this."""
	scene(
		lambda: [
			utils.facet([(-3, 0, -2), (0, 0, -2), (3, 0, -2)], fixed=True),
			utils.facet([(0, 0, -2), (3, 0, -2), (0, 1e-6, -2)], fixed=True),
		]
	)
	found = onlyFinding('size')
	assert 'body 2 is a Facet with corners on one line' in found.seen and 'corners' in found.advice


def testAnOrientationThatStretches():
	scene()
	O.bodies[0].state.ori = Quaternion(2, 0, 0, 1)
	found = onlyFinding('orientation')
	assert 'body 0 has' in found.seen and 'norm 2.24' in found.seen and 'normalized' in found.advice
	O.bodies[0].state.ori = O.bodies[0].state.ori.normalized()
	assert not polytope.check(O)


def testEnginesThatAreThereTwice():
	scene()
	O.engines = [*O.engines, NewtonIntegrator()]
	assert '2 NewtonIntegrators' in onlyFinding('engines').seen
	scene()
	O.engines = [*O.engines[:3], O.engines[2], *O.engines[3:]]
	assert '2 InteractionLoops' in onlyFinding('engines').seen


def testTwoColliders():
	scene()
	O.engines = O.engines[:2] + [InsertionSortCollider([one() for one in bounds], verletDist=0.02)] + O.engines[2:]
	assert '2 colliders, PolytopeCollider and InsertionSortCollider' in onlyFinding('engines').seen


def testYadesTriaxialControllerKnowsSpheresOnly():
	scene()
	O.engines = [*O.engines, TriaxialStressController(dead=False)]
	assert 'polytope.triaxial' in onlyFinding('engines').advice


# ------------------------------------------------------------------------------------------------ time step and motion


def ownTimeStep(dt):
	O.engines = O.engines[:-1]
	O.dt = dt


def testTimeStepAboveTheStableOne():
	scene()
	ownTimeStep(1)
	limit = polytope.stableTimeStep(1)
	O.dt = 0.99 * limit
	assert not polytope.check(O)
	O.dt = 3 * limit
	found = onlyFinding('time step')
	assert '3 of the largest' in found.seen and 'PolytopeTimeStepper()' in found.advice


def testTimeStepOfAPWave():
	scene()
	ownTimeStep(0.5 * utils.PWaveTimeStep())
	found = onlyFinding('time step')
	assert 'O.dt is 0.5 s' in found.seen and 'PWaveTimeStep is for spheres' in found.seen


@pytest.mark.parametrize('dt', [0, math.nan])
def testTimeStepThatIsNone(dt):
	scene()
	ownTimeStep(dt)
	assert 'above 0' in onlyFinding('time step').advice


def testGlobalStiffnessTimeStepperWithoutItsDefault():
	scene()
	O.engines = O.engines[:-1] + [GlobalStiffnessTimeStepper()]
	assert 'no defaultDt' in onlyFinding('time step').seen
	O.engines[-1].defaultDt = 1e-4
	assert not polytope.check(O)
	O.engines = O.engines + [PolytopeTimeStepper()]
	assert 'both set O.dt' in onlyFinding('time step').seen


def testBodyThatMovesFartherThanItsSizeInAStep():
	"""With a stable step such a speed is more than the stiffness can stop, too."""
	scene(material=rock(normalStiffness=1e12))
	ownTimeStep(1e-5)
	O.bodies[1].state.vel = (0, 0, 3e4)
	assert [one.what for one in polytope.check(O)] == ['stiffness']
	O.bodies[1].state.vel = (0, 0, 5e4)
	found = polytope.check(O)
	assert [one.what for one in found] == ['stiffness', 'speed'] and 'body 1: 5e+04 m/s' in found['speed'].seen


def yadesCollider():
	O.engines = O.engines[:1] + [InsertionSortCollider([one() for one in bounds], verletDist=0.02)] + O.engines[2:]


@pytest.mark.parametrize('shape', ['box', 'facet'])
def testBladeThatTurnsInPlace(shape):
	facet = [(-1, 0, 3), (1, 0, 3), (0, 0, 4)]
	scene(lambda: [utils.box((0, 0, 3), (0.3, 0.01, 0.05), fixed=True) if shape == 'box' else utils.facet(facet)])
	O.engines = O.engines[:3] + [RotationEngine(ids=[2], angularVelocity=1.5, rotationAxis=(0, 0, 1))] + O.engines[3:]
	assert not polytope.check(O)  # PolytopeCollider sees it
	yadesCollider()
	assert 'body 2' in onlyFinding('turning bodies').seen
	O.engines[1].verletDist = 0
	assert not polytope.check(O)
	O.engines[1].verletDist = 0.02
	O.engines = O.engines[:3] + O.engines[4:]
	O.bodies[2].state.angVel = (0, 0, 1)
	advice = onlyFinding('turning bodies').advice
	assert 'PolytopeCollider' in advice and 'verletDist=0' in advice


def testBladeThatTurnsAsAPartOfAClump():
	scene()
	yadesCollider()
	number, members = O.bodies.appendClumped([utils.box((0, 0, 3), (0.3, 0.01, 0.05)), utils.box((0, 0, 3), (0.01, 0.3, 0.05))])
	O.bodies[number].state.blockedDOFs = 'xyzXYZ'
	assert not polytope.check(O)
	O.bodies[number].state.angVel = (0, 0, 1)
	assert f'body {members[0]}' in onlyFinding('turning bodies').seen
	O.bodies[number].state.angVel = (0, 0, 0)
	O.engines = O.engines[:3] + [RotationEngine(ids=[number], angularVelocity=1.5, rotationAxis=(0, 0, 1))] + O.engines[3:]
	assert f'body {members[0]}' in onlyFinding('turning bodies').seen


def testBoxThatOthersMayTurn():
	scene(lambda: [utils.box((0, 0, 3), (0.3, 0.01, 0.05))])
	yadesCollider()
	assert 'body 2' in onlyFinding('turning bodies').seen
	O.bodies[2].state.blockedDOFs = 'XYZ'
	assert not polytope.check(O)


def testPolytopeThatAnEngineTurnsUnnoticed():
	"""YADE's own collider makes the box of a body that seems to rest, before the engine turns it."""
	engine = RotationEngine(ids=[2], angularVelocity=1.5, rotationAxis=(0, 0, 1))
	scene(lambda: [polytope.cuboid((0, 0, 3), (0.3, 0.01, 0.05), fixed=True)])
	O.engines = O.engines[:3] + [engine] + O.engines[3:]
	assert not polytope.check(O)
	yadesCollider()
	assert 'body 2, a Polytope' in onlyFinding('turning bodies').seen
	O.bodies[2].state.angVel = (0, 0, 1.5)
	assert not polytope.check(O)


def testBodyLargerThanHalfOfAPeriodicCell():
	"""YADE's collider ends the run, too, as soon as the body meets another one."""
	for length, wrong in ((0.9, False), (1.1, True)):
		O.reset()
		O.materials.append(rock())
		O.periodic = True
		O.cell.setBox(2, 3, 3)
		O.bodies.append(polytope.cuboid((0.5, 1, 1), (length / 2, 0.2, 0.2)))
		O.bodies.append(polytope.cuboid((0.6, 1, 1.39), (0.3, 0.2, 0.2)))
		O.engines = (
			polytope.engines(collider=PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.01), gravity=(0, 0, 0))
			if not wrong
			else O.engines
		)
		if wrong:
			with pytest.warns(UserWarning, match='^periodic cell: 1 bodies'):
				O.engines = polytope.engines(gravity=(0, 0, 0))
			found = onlyFinding('periodic cell')
			assert 'body 0 most' in found.seen and '0.5' in found.seen and 'larger cell' in found.advice
			O.engines[1].allowBiggerThanPeriod = True
			assert not polytope.check(O)
		else:
			assert not polytope.check(O)
			O.step()


def testWallInAPeriodicCell():
	O.materials.append(rock())
	O.periodic = True
	O.cell.setBox(2, 3, 3)
	O.bodies.append([polytope.cuboid((0.5, 1, 0.5), (0.4, 0.4, 0.4)), utils.wall(0, 2)])
	with pytest.warns(UserWarning, match='^periodic cell: 1 walls'):
		O.engines = polytope.engines(gravity=(0, 0, 0))
	assert 'body 1 first' in onlyFinding('periodic cell').seen
	O.engines[1].allowBiggerThanPeriod = True
	assert not polytope.check(O)
	O.step()


def testAPolygonThickerThanHalfOfAPeriodicCell():
	O.materials.append(rock())
	O.periodic = True
	O.cell.setBox(9, 9, 1.5)
	for k in (0, 1):
		O.bodies.append(polytope.polygon([(k, 0), (k + 0.5, 0), (k, 0.5)]))
	with pytest.warns(UserWarning, match='^periodic cell: 2 bodies'):
		O.engines = polytope.engines(gravity=(0, 0, 0))


def testSmallBodiesNeedNoCloserLook(monkeypatch):
	"""A scene of a million bodies is checked, too: their corners are looked at where a ball round the body does not do."""
	looks = []
	for module, name in ('about', 'extentOf'), ('bodies', 'extentOf'), ('overlaps', 'sortedOffsets'):
		monkeypatch.setattr(importlib.import_module(f'yade.polytope.check.{module}'), name, lambda body: looks.append(body) or 1.0)
	O.materials.append(rock())
	O.periodic = True
	O.cell.setBox(9, 9, 9)
	O.bodies.append([polytope.cuboid((2 * k + 1, 1, 1), (0.5, 0.4, 0.5)) for k in range(3)])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	assert not looks
	assert not polytope.check(O) and len(looks) == 2, 'it tells of the smallest and the largest'


def testAllFaultsOfALoneBodyAreListed():
	"""The engines have no collider, no InteractionLoop and no ForceResetter; no fault hides another."""
	O.materials.append(FrictMat(density=2600, young=1e8, frictionAngle=35, label='basalt'))
	O.materials.append(FrictMat(density=2600, young=1e8, frictionAngle=40, label='granite'))
	O.bodies.append(polytope.cuboid((0, 0, 0), (60, 1, 1), material='basalt'))
	O.bodies.append(polytope.cuboid((0, 0, 0), (60, 1, 1), material='granite', mask=2))
	O.bodies[0].state.mass = 0
	O.bodies[0].state.inertia = (0, 0, 0)
	O.bodies[1].state.vel = (math.nan, 0, 0)
	O.engines = [NewtonIntegrator()]
	seen = repr(polytope.check(O))
	for words in (
		'no InteractionLoop',
		'no collider',
		'no ForceResetter',
		'has mass 0',
		"'basalt' is 35 rad",
		"'granite' is 40 rad",
		'm across',
		'state.vel is not',
	):
		assert words in seen, (words, seen)


# ------------------------------------------------------------------------------------------------ itself


def testItChangesNothing():
	scene(otherShapes)
	for _ in range(20):
		O.step()
	before = O.saveTmp('before', quiet=True), [(*body.state.pos, *body.state.vel) for body in O.bodies], O.iter, O.dt
	polytope.check(O)
	assert before[1:] == ([(*body.state.pos, *body.state.vel) for body in O.bodies], O.iter, O.dt)


def testEmptyScene():
	O.reset()
	assert not polytope.check(O)


def testRefusals():
	for wrong in (None, 1, 'O'):
		with pytest.raises(ValueError, match='O: must be yade.O'):
			polytope.check(wrong)
	scene()
	with pytest.raises(KeyError, match='nothing of the sort'):
		polytope.check(O)['nothing of the sort']
	runInBackground()
	try:
		with pytest.raises(ValueError, match='is running'):
			polytope.check(O)
	finally:
		O.pause()


def cohesive(gap=0.0, **joint):
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.5, **joint))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.5 + gap), (0.5, 0.5, 0.5)))


@pytest.mark.parametrize(
	'gap,gravity,joint,found',
	[
		(0, 9.81, {'cohesion': 1e5}, True),
		(0, 9.81, {'cohesion': 1e5, 'tensileStrength': 1e4}, True),
		(0, 0, {'cohesion': 1e5}, False),
		(0.1, 9.81, {'cohesion': 1e5}, False),  # it falls onto the floor: nothing is glued yet
		(0, 9.81, {}, False),
		(0, 9.81, {'cohesion': 1e5, 'residualCohesion': 1e5}, False),  # perfectly plastic: nothing is lost
	],
)
def testGravityAtOnceOnJointsWithAStrength(gap, gravity, joint, found):
	cohesive(gap, **joint)
	with warnings.catch_warnings(record=True) as told:
		warnings.simplefilter('always')
		O.engines = polytope.engines(gravity=(0, 0, -gravity))
	assert any('polytope.settle()' in str(one.message) for one in told) == found
	assert any(one.what == 'gravity at once' for one in polytope.check(O)) == found
	O.step()
	assert not any(one.what == 'gravity at once' for one in polytope.check(O))


@pytest.mark.parametrize('kind', ['box', 'facet', 'wall'])
@pytest.mark.parametrize('gap', [0, 0.1])
def testGravityAtOnceOnYadesOwnSupports(kind, gap):
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.5, cohesion=1e5))
	supports = {
		'box': lambda: yade.utils.box((0, 0, -0.5), (2, 2, 0.5), fixed=True),
		'facet': lambda: yade.utils.facet([(-4, -4, 0), (4, -4, 0), (0, 4, 0)]),
		'wall': lambda: yade.utils.wall(0, axis=2),
	}
	O.bodies.append(supports[kind]())
	O.bodies.append(polytope.cuboid((0, 0, 0.5 + gap), (0.5, 0.5, 0.5)))
	with warnings.catch_warnings():
		warnings.simplefilter('ignore')
		O.engines = polytope.engines()
	assert any(one.what == 'gravity at once' for one in polytope.check(O)) == (gap == 0)
