# SPDX-License-Identifier: GPL-2.0-or-later
"""Examples of contacts of one's own: a contact point, and a pair with YADE's grids; and a builder in Python."""

import pytest
from test_extensions import built, inYade, project


def testTheForceActsOnTheFirstBodysSurface():
	"""The force of a tilted block whose edge is in the floor acts in the floor's plane, where the plug-in's own point is not; and a block
	rests on it."""
	library = built('ownPoint')
	script = """
from yade import polytope
polytope.load(sys.argv[1])
def scene(functor, orientation, z):
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.5))
	O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid(center=(0.1, 0.2, z), extents=(0.5, 0.4, 0.5), orientation=orientation))
	O.engines = polytope.engines(geometry=[functor])
seen = []
tilt = Quaternion(Vector3(1, 2, 0).normalized(), 0.3)
for functor in (Ig2_Polytope_Polytope_OwnPoint(), Ig2_Polytope_Polytope_PolytopeGeom()):
	scene(functor, tilt, 0.6)
	want = polytope.contact(O.bodies[0], O.bodies[1])
	O.step()
	c = O.interactions[0, 1]
	seen.append([c.id1, float(c.geom.contactPoint[2]), float(c.geom.penetrationDepth - want.depth), float((c.geom.normal - want.normal).norm()), c.geom.status])
scene(Ig2_Polytope_Polytope_OwnPoint(), Quaternion.Identity, 0.5)
found = repr(polytope.check(O))
O.run(5000, True)
c = O.interactions[0, 1]
weight, turning = float(c.phys.normalForce[2] / (9.81 * O.bodies[1].state.mass)), float(O.bodies[1].state.angVel.norm())
O.bodies[1].state.pos += Vector3(0, 0, 0.01)  # apart from one step to the next
O.bodies[1].state.vel = (0, 0, 0)
O.run(2, True)
answer([seen, found, weight, turning, O.interactions.countReal(), float(O.forces.f(1).norm())])
"""
	((own, plain), found, weight, turning, contacts, force), _ = inYade(script, library)
	assert contacts == 0 and force == 0
	assert own[0] == plain[0] == 0 and own[4] == plain[4] == 'contact'
	assert abs(own[1]) < 1e-12 and plain[1] < -1e-3
	assert own[2:4] == pytest.approx([0, 0], abs=1e-12)  # all else is the plug-in's
	assert weight == pytest.approx(1, rel=1e-3) and turning < 1e-6
	assert found.splitlines()[0] == 'nothing was found that is wrong'


@pytest.fixture(scope='module')
def wrong():
	"""The example, which after a hundred steps has the fault that the environment names."""
	text = (project / 'examples/extend/ownPoint/ownPoint.cpp').read_text()
	after = 'geometry(c).remember(memory);'
	added = """
			const std::string fault = std::getenv("FAULT");
			if (scene->iter > 100) {
				if (fault == "point") result.point[1] = std::nan("");
				if (fault == "normal") result.normal *= 2;
				if (fault == "depth") result.depth = std::numeric_limits<Real>::infinity();
				if (fault == "arm") result.turningArm = std::nan("");
				if (fault == "area") result.area = -1;
				if (fault == "geometry") result.hasGeometry = false;
			}
"""
	assert after in text
	return built('ownPoint', 'wrong', ownPoint=text.replace(after, after + added))


@pytest.mark.parametrize('fault', ['point', 'normal', 'depth', 'arm', 'area', 'geometry'])
def testAResultThatIsNoContactIsCounted(fault, wrong):
	"""A point or arm that is no number, a normal that is no unit vector, an infinite depth, a negative area, no geometry: a status and
	counters of the functor, which check tells of; no force."""
	script = """
from yade import polytope
polytope.load(sys.argv[1])
O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.5))
O.bodies.append(polytope.cuboid(center=(0, 0, -0.5), extents=(2, 2, 0.5), fixed=True))
O.bodies.append(polytope.cuboid(center=(0, 0, 0.4999), extents=(0.5, 0.4, 0.5)))
O.engines = polytope.engines(geometry=[Ig2_Polytope_Polytope_OwnPoint()])
O.run(100, True)
functor = O.engines[2].geomDispatcher.functors[0]
before, good = functor.stats()['failures'], O.interactions[0, 1].geom.status
O.run(50, True)
stats, c = functor.stats(), O.interactions[0, 1]
law = O.engines[2].lawDispatcher.functors[0]
numbers = [*c.geom.contactPoint, *c.geom.normal, c.geom.penetrationDepth, *O.bodies[1].state.vel]
answer([before, good, stats['failures'], stats['statuses']['failed'], c.geom.status, all(abs(float(x)) < 10 for x in numbers), law.nonFiniteForces(), [one.what for one in polytope.check(O)]])
"""
	(before, good, failures, failed, status, finite, forces, found), _ = inYade(script, wrong, FAULT=fault)
	assert before == 0 and good == 'contact'
	assert 45 <= failures == failed <= 50 and status == 'failed' and finite and forces == 0
	assert 'failures' in found


def testABlockRestsOnTwoBeamsOfAGrid(tmp_path):
	"""Forces of the four nodes are the block's weight, shared as the lever says; arrays and VTK files know the contacts; loaded again, it
	rests on."""
	library = built('gridPair')
	script = """
from yade import polytope, Quaternion
from yade.gridpfacet import gridNode, gridConnection
polytope.load(sys.argv[1])
O.materials.append(CohFrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.5, label='grid', normalCohesion=1e9, shearCohesion=1e9, momentRotationLaw=True))
rock = O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.5))
O.engines = [ForceResetter(), PolytopeCollider([Bo1_Polytope_Aabb(), Bo1_GridConnection_Aabb(), Bo1_Sphere_Aabb()], verletDist=0.02),
	InteractionLoop([Ig2_GridConnection_Polytope_PolytopeGeom(), Ig2_GridNode_GridNode_GridNodeGeom6D()],
		[Ip2_FrictMat_FrictMat_FrictPhys(), Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
		[Law2_PolytopeGeom_FrictPhys_OnNodes(), Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
	NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.6)]
for y in (-0.25, 0.25):
	a, b = [O.bodies.append(gridNode([x, y, 0], 0.05, material='grid', fixed=True)) for x in (-1, 1)]
	O.bodies.append(gridConnection(a, b, 0.05, material='grid'))
block = O.bodies.append(polytope.cuboid(center=(0.2, 0.05, 0.45), extents=(0.4, 0.4, 0.4), material=rock))
O.dt = 5e-5
found = [one.seen for one in polytope.check(O)]
O.run(20000, True)
weight = 9.81 * float(O.bodies[block].state.mass)
contacts = polytope.arrays().contacts
statuses = [contacts.statuses[k] for k in range(len(contacts.ids)) if block in contacts.ids[k]]
recorder = PolytopeVTKRecorder(fileName=sys.argv[2], recorders=['contacts'], ascii=True)
recorder()
touching = [i.geom.status for i in O.interactions if block in (i.id1, i.id2)]
answer([found, [float(O.forces.f(k)[2]) / weight for k in range(6)], [float(x) for x in O.bodies[block].state.vel], [contacts.statusNames[s] for s in statuses], touching])
"""
	(found, forces, speed, statuses, touching), _ = inYade(script, library, tmp_path / 'grid')
	assert found == []
	assert max(map(abs, speed)) < 1e-4
	assert sum(forces) == pytest.approx(-1, rel=1e-3)
	assert forces[2] == forces[5] == 0  # the connections themselves
	here, there = forces[0] + forces[3], forces[1] + forces[4]  # nodes at x = −1 and 1, block at 0.2
	assert there - here == pytest.approx(-0.2, abs=2e-3)
	assert forces[3] + forces[4] - forces[0] - forces[1] == pytest.approx(-0.05 / 0.25, abs=5e-3)
	assert statuses == touching == ['contact'] * 2
	text = next(tmp_path.glob('gridcontacts.*.vtp')).read_text()
	assert 'NumberOfPoints="4"' in text  # two of them join the nodes of a beam


def testAContactByMarginsAsksDerivedClassesToo():
	"""A beam of a grid meets a rounded polytope by the functor for polytopes, with both margins; check has nothing to say of it. Where that
	functor is missing it names it, and where it is there it does not."""
	script = """
from yade import polytope
from yade.gridpfacet import gridNode, gridConnection
for path in sys.argv[1:]: polytope.load(path)
O.materials.append(CohFrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.5, label='grid', normalCohesion=1e9, shearCohesion=1e9, momentRotationLaw=True))
rock = O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.5))
def found(*functors):
	O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Polytope_Aabb(), Bo1_GridConnection_Aabb(), Bo1_Sphere_Aabb()]),
		InteractionLoop([*functors, Ig2_GridNode_GridNode_GridNodeGeom6D()],
			[Ip2_FrictMat_FrictMat_FrictPhys(), Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
			[Law2_PolytopeGeom_FrictPhys_OnNodes(), Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.6)]
	return [one.advice for one in polytope.check(O) if one.what == 'contact functors' and 'GridConnection' in one.seen]
found(Ig2_GridConnection_Polytope_PolytopeGeom())  # gridConnection asks the engines
a, b = [O.bodies.append(gridNode([x, 0, 0], 0.05, material='grid', fixed=True)) for x in (-1, 1)]
O.bodies.append(gridConnection(a, b, 0.05, material='grid'))
O.bodies.append(polytope.withShape(polytope.cuboid((0, 0, 0.3 + 0.1 + 0.05 - 0.01), (0.3, 0.3, 0.3), material=rock), RoundedPolytope(radius=0.1)))
answers = [found(), found(Ig2_GridConnection_Polytope_PolytopeGeom())]
O.dt = 1e-9
O.step()
answers.append([float(c.geom.penetrationDepth) for c in O.interactions if c.isReal and isinstance(c.geom, PolytopeGeom)])
answer(answers)
"""
	(without, with_, depths), _ = inYade(script, built('gridPair'), built('roundedPolytope'))
	assert len(without) == 1 and 'Ig2_GridConnection_Polytope_PolytopeGeom' in without[0]
	assert with_ == [] and depths == [pytest.approx(0.01, abs=1e-12)]


def testABuilderInPythonRoundsItsColumns():
	"""Sharp and rounded columns have the volumes of their closed forms, and stand on each other."""
	library = built('roundedPolytope')
	script = """
import math
sys.path.insert(0, sys.argv[2])
from columns import column
from yade import polytope
O.materials.append(RockJointMat(density=1000, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5, stiffnessPerArea=False))
try: column(0.5, 1, rounding=0.1)
except ValueError as error: refused = str(error)
polytope.load(sys.argv[1])
sharp, rounded = column(0.5, 1), column(0.5, 1, rounding=0.1)
h = 0.5 * math.cos(math.pi / 6)
volume = lambda reach: 2 * math.sqrt(3) * reach**2
core, edge = volume(h - 0.1), 2 * (h - 0.1) / math.sqrt(3)
r, tall, area, rim = 0.1, 0.8, volume(h - 0.1), 12 * (h - 0.1) / math.sqrt(3)
# Steiner: faces, edges (mean breadth: upright ones turn by 60°, those of both rims by 90°), ball
steiner = core * tall + r * (2 * area + rim * tall) + r**2 / 2 * (6 * tall * math.pi / 3 + 2 * rim * math.pi / 2) + 4 / 3 * math.pi * r**3
answer([refused, float(sharp.state.mass) / (1000 * volume(h)), float(rounded.state.mass) / (1000 * steiner), [float(x) for x in rounded.state.pos]])
"""
	(refused, sharp, rounded, place), _ = inYade(script, library, project / 'examples/extend/columns')
	assert refused.startswith('rounding: needs the extension')
	assert sharp == pytest.approx(1, rel=1e-12)
	assert rounded == pytest.approx(1, rel=1e-12)
	assert place == pytest.approx([0, 0, 0], abs=1e-12)
