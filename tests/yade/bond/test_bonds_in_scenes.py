# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds with what else a scene has: clumps, threads, measures, checks, other contacts, energies of a body that breaks."""

import pytest
from scenes import gravity, joint, kineticEnergy, loop, stepper
from test_threads import run
from yade import GlobalStiffnessTimeStepper, NewtonIntegrator, O, PolytopeTimeStepper, Vector3, polytope

kn, ks = 1e9, 4e8


def row(number, **bond):
	"""Cubes along x, the first one fixed."""
	joint(normalStiffness=kn, shearStiffness=ks)
	O.bodies.append([polytope.cuboid((k, 0, 0), (0.5, 0.5, 0.5), fixed=k == 0) for k in range(number)])
	loop(True, damping=0.5)
	return polytope.bond(**bond)


def testABlockHangsFromARoofWithoutTilting():
	"""The bond's strength is 40 times the stress by the block's weight; with an ordinary joint, whose force moves to an edge across a gap, the block
	swings off."""
	joint(normalStiffness=kn, shearStiffness=kn)
	O.bodies.append(polytope.cuboid((0, 0, 1.5), (3, 3, 0.5), fixed=True))
	block = O.bodies[O.bodies.append(polytope.cuboid((0.1, 0.2, 0.5), (1, 0.5, 0.5)))]
	loop(True, damping=0.3, gravity=(0, 0, -gravity))
	stress = block.state.mass * gravity / 2
	polytope.bond(tensileStrength=40 * stress, cohesion=40 * stress)
	stepper()
	while O.time < 0.3:
		O.run(1000, wait=True)
	assert block.state.pos[2] - 0.5 == pytest.approx(-stress / kn, rel=1e-3)
	assert block.state.ori.toAxisAngle()[1] < 1e-9 and polytope.bonds().intactCount == 1


def testClumpsAreBondedThroughTheirMembers():
	"""An L of two members hangs from a fixed block by one of them: the bond bears its weight and the moment about the bond."""
	joint(normalStiffness=kn, shearStiffness=ks)
	O.bodies.append(polytope.cuboid((0, 0, 1), (0.5, 0.5, 0.5), fixed=True))
	clump, members = O.bodies.appendClumped([polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)), polytope.cuboid((1, 0, 0), (0.5, 0.5, 0.5))])
	newton = loop(True, damping=0.5, gravity=(0, 0, -gravity))
	assert polytope.bond(ids=[0, clump]) == 1  # none between the members
	bond = polytope.bonds().bonds[0]
	assert {bond.id1, bond.id2} == {0, members[0]}
	state = O.bodies[clump].state
	engine = stepper()
	O.step()
	assert engine.limitedBy in ('contacts', 'material') and O.dt < (state.mass / (kn * 1)) ** 0.5
	O.run(6000, wait=True)
	weight = state.mass * gravity
	sign = 1 if bond.id2 == members[0] else -1
	assert sign * bond.force[2] == pytest.approx(weight, rel=1e-3)
	assert abs(bond.moment[1]) == pytest.approx(weight * 0.5, rel=1e-3)
	assert newton.damping == 0.5 and bond.intact


def testMeasuresCountBonds():
	"""A row that is pulled and bent: mean stress of each cube, symmetric in equilibrium; neighbours in the row."""
	assert row(4) == 3
	stepper()
	O.forces.setPermF(3, (1e4, 0, 0))
	O.forces.setPermT(3, (2e3, 0, 5e3))
	O.run(6000, wait=True)
	stress = polytope.bodyStress([1, 2])
	for tensor in stress.values():
		assert tensor[0, 0] == pytest.approx(1e4, rel=1e-3)
		assert abs(tensor - tensor.T).max() < 1e-2 * 1e4  # moments of 2e3 and 5e3 N m would show as such stresses
	assert polytope.coordinationNumber([1, 2, 3]).mean == pytest.approx(5 / 3)


def testFabricCountsBonds():
	"""A row that is pulled: normals along x; without a force nothing."""
	row(3)
	stepper()
	with pytest.raises(ValueError, match='no contact'):
		polytope.contactFabric()
	O.forces.setPermF(2, (1e4, 0, 0))
	O.run(3000, wait=True)
	fabric = polytope.contactFabric()
	assert fabric[0, 0] == pytest.approx(1, abs=1e-9) and fabric.trace() == pytest.approx(1)


def testMechanicalEnergyCountsBonds():
	row(3)
	next(one for one in O.engines if isinstance(one, NewtonIntegrator)).damping = 0
	O.bodies[2].state.vel = (0.1, 0, 0)
	O.dt = 1e-4
	energies = [polytope.mechanicalEnergy() for _ in range(50)]
	assert energies[-1] == pytest.approx(O.bodies[1].state.mass * 0.01 / 2, rel=1e-2)
	assert max(energies) - min(energies) < 1e-9 * max(energies)  # straight pull: linear springs


def testBondsThatAreSwitchedOffLeaveTheContact():
	row(2)
	O.bodies[1].state.pos = (0.999, 0, 0)
	polytope.bonds().dead = True
	O.dt = 1e-6
	O.step()
	assert O.interactions[0, 1].isReal and O.interactions[0, 1].phys.normalForce[0] != 0
	polytope.bonds().dead = False
	O.step()
	assert not (O.interactions.has(0, 1) and O.interactions[0, 1].isReal)


def testTheCheckKnowsBonds():
	row(2)
	stepper()
	assert not polytope.check(O)
	engines = O.engines
	O.engines = [*engines[:3], engines[4], engines[3], engines[5]]
	assert 'not before the NewtonIntegrator' in polytope.check(O)['bonds'].seen
	O.engines = [*(one for one in engines if not isinstance(one, PolytopeTimeStepper)), GlobalStiffnessTimeStepper(defaultDt=1e-5)]
	assert 'does not know bonds' in polytope.check(O)['time step'].seen


def testBondsThatAreLeftOutOfTheEnginesAreMissed():
	"""check() misses them until engines() puts them back; not in another scene, and not once they are broken or their bodies are gone."""
	assert row(3) == 2
	stepper()
	lone = [engine for engine in O.engines if engine is not polytope.bonds() and type(engine).__name__ != 'PolytopeBonds']
	O.engines = lone
	found = polytope.check(O)['bonds']
	assert 'whose 2 bonds were intact' in found.seen and 'polytope.engines(' in found.advice
	O.bodies.erase(2)
	assert 'whose 1 bonds were intact' in polytope.check(O)['bonds'].seen
	O.engines = polytope.engines()
	assert polytope.bonds().intactInScene == 1 and not polytope.check(O)
	O.engines = lone
	O.reset()
	joint(normalStiffness=kn, shearStiffness=ks)
	O.bodies.append([polytope.cuboid((k, 0, 0), (0.5, 0.5, 0.5), fixed=k == 0) for k in range(3)])
	O.engines = polytope.engines()
	assert not polytope.check(O) and polytope.bonds() is None


def testAnUnknownArgumentIsNamed():
	with pytest.raises(TypeError, match="^bond: there is no argument 'strength'; it takes ids, gap, .* tensileStrength, "):
		row(2, strength=1e6)


def testEnergyOfACubeThatBreaksOnAFloor():
	"""Kinetic, stored, slid off and broken: what there was at first, to 1 %, with most bonds failed."""
	joint(normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.4)
	blocks = polytope.voronoi(((0, 0, 0.001), (1, 1, 1.001)), 12, seed=2).blocks
	O.bodies.append([polytope.fromHalfSpaces(*block) for block in blocks])
	O.bodies.append(polytope.cuboid((0.5, 0.5, -0.5), (3, 3, 0.5), fixed=True))
	loop(True)
	made = polytope.bond(ids=range(12), tensileStrength=3e5, cohesion=6e5, frictionAngle=0.5)
	for body in O.bodies:
		if body.dynamic:
			body.state.vel = (0.3, 0, -4)
	O.trackEnergy = True
	stepper(timestepSafetyCoefficient=0.1)
	start = sum(body.state.mass for body in O.bodies if body.dynamic) * (16 + 0.09) / 2
	while O.time < 0.02:
		O.run(50, wait=True)
	assert polytope.bonds().intactCount < made / 2
	before = sum(kineticEnergy(body.state) for body in O.bodies if body.dynamic)
	O.step()
	now = (before + sum(kineticEnergy(body.state) for body in O.bodies if body.dynamic)) / 2
	ours = ('elastPotential', 'plastDissip', 'fractureDissip', 'nonconservative')
	energies = {name: O.energy[name] for name in ours if name in dict(O.energy.items())}
	print(now / start, {name: value / start for name, value in energies.items()})
	assert now + sum(energies.values()) == pytest.approx(start, rel=1e-2)
	# contacts go on with the bonds' forces, which have no edges: a difference of the depth, 6 mm, over the blocks' size
	assert energies['fractureDissip'] > 0.01 * start and abs(energies.get('nonconservative', 0)) < 0.02 * start


twoRows = '''
joint(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.4)
loop(True, gravity=(0, 0, -gravity))
O.bodies.append([polytope.cuboid((k, 3 * side, 0.1 * side), (.5, .5, .5), fixed=k == 0) for side in range(2) for k in range(5)])
polytope.bond(tensileStrength=2e5, cohesion=2e5)
O.dt = 1e-3
O.run(int(sys.argv[4]), True)
print('RESULT', state(), float(polytope.bonds().intactCount).hex())
'''


def testTwoThreadsAgreeExactly():
	"""Two bonds a body, and a failure on the way: forces are sums of two numbers, in any order."""
	import test_save_load

	program = test_save_load.program
	script = program[: program.index('scene, before, after')] + 'assert O.numThreads == int(sys.argv[7]), O.numThreads\n' + twoRows
	one, two = (run('none', threads, 400, script=script) for threads in (1, 2))
	assert one == two and 0 < one[-1] < 8


def testLoadedBondsStayInTheirScene(tmp_path):
	"""Loaded, looked at before any step, and left: they take nothing of the next scene, whose bodies have the same ids. Left out of the
	engines they are missed."""
	name = str(tmp_path / 'bonded.yade')
	assert row(2) == 1
	O.save(name)
	O.load(name, quiet=True)
	assert polytope.bonds().intactInScene == 1
	O.engines = [engine for engine in O.engines if type(engine).__name__ != 'PolytopeBonds']
	assert 'whose 1 bonds were intact' in polytope.check(O)['bonds'].seen
	O.load(name, quiet=True)
	assert polytope.bonds().intactInScene == 1
	O.reset()
	joint(normalStiffness=kn, shearStiffness=ks)
	O.bodies.append([polytope.cuboid((1.2 * k, 0, 0), (0.5, 0.5, 0.5), fixed=k == 0) for k in range(2)])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	assert polytope.bonds() is None and not polytope.check(O)
	O.run(10, wait=True)
	assert O.bodies[1].state.vel.norm() == 0
