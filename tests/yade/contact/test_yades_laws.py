# SPDX-License-Identifier: GPL-2.0-or-later
"""Which of YADE's laws suit polytopes: a slender block that stands on its edge, beyond the balance, falls over with those that do.

With the others, which polytope.check names, it stays as it is: they put moments on bodies as on spheres.
"""

from math import acos, degrees, radians

import pytest
import yade
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	Quaternion,
	Vector3,
	polytope,
)
from yade.polytope.check.pairs import notPeriodicLaws, unsuitedLaws

elastic = {'density': 2600, 'young': 1e7, 'poisson': 0.3, 'frictionAngle': 0.5}
springs = {'density': 2600, 'kn': 1e6, 'ks': 1e6, 'cn': 100, 'cs': 100, 'frictionAngle': 0.5}
joint = {'density': 2600, 'normalStiffness': 5e6, 'shearStiffness': 5e6, 'frictionAngle': 0.5}
suited = {
	'Law2_PolytopeGeom_RockJointPhys_MohrCoulomb': ('RockJointMat', joint, 'Ip2_RockJointMat_RockJointMat_RockJointPhys', {}),
	'Law2_ScGeom_FrictPhys_CundallStrack': ('FrictMat', elastic, 'Ip2_FrictMat_FrictMat_FrictPhys', {'sphericalBodies': False}),
	'Law2_ScGeom_MindlinPhys_Mindlin': ('FrictMat', elastic, 'Ip2_FrictMat_FrictMat_MindlinPhys', {}),
	'Law2_ScGeom_ViscElPhys_Basic': ('ViscElMat', springs, 'Ip2_ViscElMat_ViscElMat_ViscElPhys', {}),
	'Law2_ScGeom_ViscoFrictPhys_CundallStrack': ('FrictMat', elastic, 'Ip2_FrictMat_FrictMat_ViscoFrictPhys', {'sphericalBodies': False}),
}
suited['Law2_ScGeom_FrictViscoPhys_CundallStrackVisco'] = (
	'FrictViscoMat',
	{**elastic, 'betan': 0.2},
	'Ip2_FrictViscoMat_FrictViscoMat_FrictViscoPhys',
	{'sphericalBodies': False},
)
unsuited = {
	'Law2_ScGeom_MindlinPhys_HertzWithLinearShear': ('FrictMat', elastic, 'Ip2_FrictMat_FrictMat_MindlinPhys'),
	'Law2_ScGeom_MindlinPhys_MindlinDeresiewitz': ('FrictMat', elastic, 'Ip2_FrictMat_FrictMat_MindlinPhys'),
	'Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM': ('JCFpmMat', elastic, 'Ip2_JCFpmMat_JCFpmMat_JCFpmPhys'),
}
start = radians(18)
"""Tilt of the block's axis at the start; the block balances at 11.3°."""


def tilt(material, values, physics, law, settings, periodic=False, seconds=0.4):
	"""The block's after this time [rad]."""
	O.reset()
	O.periodic = periodic
	if periodic:
		O.cell.setBox(10, 10, 10)
	O.materials.append(getattr(yade, material)(**values))
	turn = Quaternion((0, 1, 0), start)
	middle = turn * Vector3(-0.1, 0, 0.5)
	O.bodies.append(
		[polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True), polytope.cuboid((middle[0], 0, middle[2] - 1e-4), (0.1, 0.1, 0.5), turn)]
	)
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.02),
		InteractionLoop([Ig2_Polytope_Polytope_PolytopeGeom()], [getattr(yade, physics)()], [getattr(yade, law)(**settings)]),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.1),
	]
	O.dt = 1e-4
	while O.time < seconds:
		O.step()
	return acos((O.bodies[1].state.ori * Vector3(0, 0, 1))[2])


@pytest.mark.parametrize('law', suited)
def testBlockTopplesWith(law):
	material, values, physics, settings = suited[law]
	assert degrees(tilt(material, values, physics, law, settings)) > 22
	assert 'laws' not in [one.what for one in polytope.check(O)]


@pytest.mark.parametrize('law', unsuited)
def testBlockStaysWith(law):
	assert degrees(tilt(*unsuited[law], law, {})) < 18.5
	found = polytope.check(O)['laws']
	assert law in found.seen and 'never topples' in found.seen


@pytest.mark.parametrize('law', [law for law in suited if suited[law][3]])
def testBlockStaysWithSphericalBodies(law):
	material, values, physics, _ = suited[law]
	assert degrees(tilt(material, values, physics, law, {})) < 18.5
	assert 'sphericalBodies=False' in polytope.check(O)['laws'].advice


@pytest.mark.parametrize('law', suited)
def testBlockInAPeriodicCell(law):
	*others, settings = suited[law]
	toppled = degrees(tilt(*others, law, settings, periodic=True)) > 22
	found = [one.seen for one in polytope.check(O) if one.what == 'laws']
	assert toppled == (law not in notPeriodicLaws) == (not found), found
	assert toppled or f'{law} in a periodic cell' in found[0]


def testAllThatCheckNamesIsTried():
	assert set(unsuitedLaws) == set(unsuited)
