# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints from files: tables, BlockGen's, FracMan's and dfnWorks' polygons; malformed ones are refused by line."""

import warnings
from math import cos, radians, sin

import numpy as np
import pytest
from yade import O, RockJointMat, polytope

box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
half = [10] * 6


@pytest.fixture
def read(tmp_path):
	def make(text, name='joints.csv', **named):
		path = tmp_path / name
		path.write_text(text)
		return polytope.readJoints(path, **named)

	return make


@pytest.mark.parametrize('separator', [',', ';', '\t'])
def testTable(read, separator):
	text = 'dip,dip_direction,x,y,z,radius,set,remark\n30,90,1,2,3,4,7,bedding\n\n90,0,0,0,-1,,,fault\n'.replace(',', separator)
	disc, plane = read(text)
	assert (disc.dip, disc.dipDirection, disc.centre, disc.radius, disc.set) == (radians(30), radians(90), (1, 2, 3), 4, 7)
	assert (plane.radius, plane.set, plane.centre) == (None, 0, (0, 0, -1))
	rock = polytope.jointedRock(box, half, [read(text)])
	assert len(rock.bodies) == 2 and rock.sets.tolist() == [1, 0]  # in the order of their numbers, 0 and 7


def testJointsOfAFileHaveMaterialsBySet(read):
	"""Numbers come first, then names; each has its own material."""
	joints = read(
		'# mapped in May\n\ndip,dip_direction,x,y,z,set\n0,0,0,0,0,fault\n# the bedding:\n0,0,0,0,2,bedding\n0,0,0,0,4,12\n0,0,0,0,-4,bedding\n'
	)
	assert [joint.set for joint in joints] == ['fault', 'bedding', 12, 'bedding']
	rock = polytope.jointedRock(box, half, [polytope.Joint(0, 0, (0, 0, -6)), joints])
	assert rock.entries == 4 and rock.sets.tolist() == [0, 3, 2, 1, 2]
	for number in range(5):
		O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, label=f'm{number}'))
	ids = rock.append(material='m0', jointMaterials=['m1', 'm2', 'm3', 'm4'])
	tops = {
		round(
			float(
				O.bodies[k].state.pos[2] + max(O.bodies[k].shape.offsets[i] for i, n in enumerate(O.bodies[k].shape.normals) if n[2] > 0.9)
			),
			3,
		): k
		for k in ids
	}
	found = {
		top: next(O.bodies[k].shape.faceMaterials[i] for i, n in enumerate(O.bodies[k].shape.normals) if n[2] > 0.9)
		for top, k in tops.items()
	}
	assert found == {-6: 1, -4: 3, 0: 4, 2: 3, 4: 2, 10: -1}
	with pytest.raises(ValueError, match='for each of the 4 jointSets'):
		rock.append(material='m0', jointMaterials=['m1', 'm2'])


def testAnglesThatCouldBeRadiansAreTold(read):
	with pytest.warns(UserWarning, match=r'no dip is above 1.2°, no dip direction above 3.14°; if they are in radians, write degrees'):
		read(table + '0.61,3.14,0,0,0,\n1.2,1.57,0,0,0,\n')
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		read(table + '0,0,0,0,0,\n1,6,0,0,0,\n')
		read(table + '0.61,3.14,0,0,0,\n35.5,1.57,0,0,0,\n')


def testJointsOutsideTheRegionAreNamed():
	inside, outside = polytope.Joint(0, 0, (0, 0, 1)), polytope.Joint(0, 0, (0, 0, 40), radius=5)
	with pytest.warns(
		UserWarning,
		match=r'^jointSets: 2 of 3 joints lie wholly outside the region, and cut nothing: 1 at \(0, 0, 40\), 2 at \(0, 0, -11\)',
	):
		rock = polytope.jointedRock(box, half, [[inside, outside], polytope.Joint(0, 0, (0, 0, -11))])
	assert len(rock.bodies) == 2


def testTableWithOtherNamesAndUnits(read):
	(disc,) = read('"Diameter",Position-X,Position-Y,position-z,Dip,Dip-Direction\n8000,1000,2000,3000,30,90\n', scale=1e-3)
	assert disc.centre == pytest.approx((1, 2, 3)) and disc.radius == pytest.approx(4)


def testBlockGensRectangles(read):
	"""The corners fulfil what BlockGen asks of a joint's points: a·(x − c) = 0, and ± half-lengths along strike and dip."""
	dip, direction, centre, along, down = 60.0, 230.0, np.array([1.0, -2, 0.5]), 3.0, 2.0
	row = ';'.join(map(str, (dip, direction, *centre, along, down, *range(9), 'no remark')))
	for line in (row + ';', row):
		(joint,) = read(f'dip;dipdir;x;y;z;…\n{line}\n')
		dipRad, opposite = radians(90 - dip), radians(direction - 180)
		normal = np.array([cos(opposite) * cos(dipRad), sin(opposite) * cos(dipRad), sin(dipRad)])
		strike = np.array([cos(radians(direction - 90)), sin(radians(direction - 90)), 0])
		away = np.array(joint.corners) - centre
		assert np.abs(away @ normal).max() < 1e-12
		assert sorted(np.abs(away @ strike)) == pytest.approx([along] * 4)
		assert sorted(np.abs(away @ np.cross(normal, strike))) == pytest.approx([down] * 4)
		rock = polytope.jointedRock(box, half, [joint], incomplete='cut')
		assert rock.areas.tolist() == pytest.approx([4 * along * down])


def testBlockGensPersistentPlanes(read):
	text = 'dip;dipdir;spacing;…\n40;90;5;1;2;3;4;5;6;7;8;\n90;0;4;1;2;3;4;5;6;7;8;\n'
	first, second = read(text)
	assert first.spacing == 5 and first.through == (0, 0, 0)
	assert np.cross(first.normal, (0, -sin(radians(40)), cos(radians(40)))) == pytest.approx(0, abs=1e-12)
	assert np.cross(second.normal, (1, 0, 0)) == pytest.approx(0, abs=1e-12)
	assert len(polytope.jointedRock(box, half, read(text)).blocks) > 9


fab = '''BEGIN FORMAT
    Format = Ascii
    No_Fractures = 2
END FORMAT

BEGIN PROPERTIES
    Prop1    =    (Real*4)    "Transmissivity"
END PROPERTIES

BEGIN FRACTURE
    1 4 1 1e-6
        1 -11 -11 2
        2 11 -11 2
        3 11 11 2
        4 -11 11 2
    0 0 0 1
    7 3 2 1e-6
        1 0 0 -5
        2 4 0 -5
        3 0 4 -5
    0 0 0 1
END FRACTURE

BEGIN TESSFRACTURE
    9 4 2 5
        1 -11 -11 -8
        2 11 -11 -8
        3 11 11 -8
        4 -11 11 -8
        1 1 2 3
        2 1 3 4
END TESSFRACTURE
'''


def testFracMan(read):
	joints = read(fab, 'network.fab')
	assert [(joint.set, len(joint.corners)) for joint in joints] == [(1, 4), (2, 3), (5, 3), (5, 3)]
	rock = polytope.jointedRock(box, half, joints)
	volumes = [rock.volumes[parts].sum() for parts in rock.bodies]
	assert sorted(volumes) == pytest.approx([2 * 400, 8 * 400, 10 * 400]), 'the triangle at −5 ends inside, the two at −8 are one joint'
	assert read(fab, 'network.txt')[0].corners == joints[0].corners, 'by its first line'


def testDfnWorks(read):
	joints = read('nPolygons: 2\n4 {-11, -11, 0} {11, -11, 0} {11, 11, 0} {-11, 11, 0}\n3 {0, 0, 5} {1, 0, 5} {0, 1, 5}\n', 'polygons.dat')
	rock = polytope.jointedRock(box, half, joints)
	assert rock.volumes[rock.bodies[0]].sum() == pytest.approx(4000) and len(rock.bodies) == 2


table = 'dip,dip_direction,x,y,z,radius\n'


@pytest.mark.parametrize(
	'text, name, says',
	[
		('', 'a.csv', 'line 1: no columns named dip'),
		('dip,x,y,z\n1,2,3,4\n', 'a.csv', 'line 1: no columns named dip'),
		(table, 'a.csv', 'has no joints'),
		(table + '30,90,0,0,0,2\n30,north,0,0,0,2\n', 'a.csv', "line 3: dip_direction must be a number, got 'north'"),
		(table + '95,90,0,0,0,2\n', 'a.csv', 'line 2: dip must be from 0 to 90 degrees, got 95'),
		(table + '30,900,0,0,0,2\n', 'a.csv', 'line 2: dip direction must be an azimuth'),
		(table + '30,90,0,0,0,-2\n', 'a.csv', 'line 2: radius: must be positive'),
		('dip;dip_direction;x;y;z\n35,5;90;0;0;0\n', 'a.csv', "line 2: dip must be a number, got '35,5'; write a decimal point: 35.5"),
		(table + '35,5,90,0,0,0,2\n', 'a.csv', 'line 2: 7 fields, 6 columns; are there decimal commas?'),
		('# a comment\n' + table + '30,north,0,0,0,2\n', 'a.csv', 'line 3: dip_direction must be a number'),
		(table + '30,90,0,0\n', 'a.csv', 'line 2: 4 fields, 6 or more'),
		('dip,dd,dip_direction,x,y,z\n30,90,45,0,0,0\n', 'a.csv', 'line 1: several columns are the dip_direction'),
		(table + '30,90,0,0,nan,1\n', 'a.csv', 'line 2: z must be a number'),
		('a;b\n1;2;3;4;5;6;7;8;9;10;11;12;13\n', 'a.csv', 'line 2: 13 fields separated by semicolons; BlockGen has 11'),
		(fab.replace('END TESSFRACTURE\n', ''), 'a.fab', 'the file ends within the section TESSFRACTURE'),
		(fab.replace('        2 1 3 4\n', '        2 1 3 6\n'), 'a.fab', 'line 31: a triangle names a node that is not there'),
		(fab.replace('2 4 0 -5', '2 4 0'), 'a.fab', 'line 19: a corner must have three coordinates'),
		(fab.replace('2 11 -11 2', '2 -11 -11 2').replace('3 11 11 2', '3 -11 11 2'), 'a.fab', 'line 11: corners: the polygon has no area'),
		('nPolygons: 2\n3 {0, 0, 5} {1, 0, 5} {0, 1, 5}\n', 'a.dat', 'line 1: 2 polygons are told, 1 are there'),
		('nPolygons: 1\n4 {0, 0, 5} {1, 0, 5} {0, 1, 5}\n', 'a.dat', 'line 2: 4 corners are told, 3 are there'),
		('nPolygons: 1\n3 {0, 0, 5} {1, a, 5} {0, 1, 5}\n', 'a.dat', "line 2: a coordinate must be a number, got 'a'"),
	],
)
def testMalformedFilesAreRefusedByLine(read, text, name, says):
	with pytest.raises(ValueError, match='^path: ') as refused:
		read(text, name)
	assert name in str(refused.value) and says in str(refused.value)


def testWrongArgumentsAreRefused(read, tmp_path):
	with pytest.raises(FileNotFoundError, match='^path: there is no file'):
		polytope.readJoints(tmp_path / 'none.csv')
	with pytest.raises(ValueError, match='^format: must be one of table, blockGen'):
		read(table, format='dxf')
	with pytest.raises(ValueError, match='^scale:'):
		read(table, scale=0)
	(tmp_path / 'binary.csv').write_bytes(b'\xff\xfe\x00')
	with pytest.raises(ValueError, match='is no text'):
		polytope.readJoints(tmp_path / 'binary.csv')


def testAFolderIsRefused(tmp_path):
	with pytest.raises(ValueError, match='^path: .* is a folder'):
		polytope.readJoints(tmp_path)
