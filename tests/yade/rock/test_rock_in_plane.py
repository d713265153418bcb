# SPDX-License-Identifier: GPL-2.0-or-later
"""Jointed rock in the plane: areas, spacings, scatter, ends of joints, and the factor of safety of a plane failure against its closed form."""

import math

import numpy as np
import pytest
from PIL import Image
from yade import O, Polytope, RockJointMat, plot, polytope
from yade.polytope.pictures.faceColors import faceColors, palette
from yade.polytope.pictures.faces import collect
from yade.polytope.pictures.looks import rgbOf
from yade.polytope.scene.movers import partsOf

gravity, density = 9.81, 2600
right, left = math.radians(90), math.radians(270)

slope = [(0, -1), (1, 0), (-math.sin(math.radians(60)), math.cos(math.radians(60))), (0, 1)], [0, 30, 0, 20]
"""Below a face that rises by 60° from the origin, 20 m high, to x = 30."""
areaOfSlope = 30 * 20 - 20 * (20 / math.tan(math.radians(60))) / 2


def joints(*given):
	return [polytope.JointSet(math.radians(dip), direction, spacing) for dip, direction, spacing in given]


def material(**joint):
	O.materials.append(
		RockJointMat(**{'density': density, 'normalStiffness': 1e9, 'shearStiffness': 5e8, 'frictionAngle': math.radians(35), **joint})
	)


def testBlocksArePolygonsWhoseAreasAddUp():
	material()
	rock = polytope.jointedRock(*slope, joints((35, left, 3), (70, right, 4)), smallest=0)
	assert rock.volumes.sum() == pytest.approx(areaOfSlope, rel=1e-12)
	ids = rock.append(thickness=2)
	assert len(ids) == len(rock.blocks) > 40
	bodies = [O.bodies[k] for k in ids]
	assert all(isinstance(body.shape, Polytope) and body.shape.dimension == 2 and body.state.blockedDOFs == 'zXY' for body in bodies)
	assert sum(float(body.shape.volume) for body in bodies) == pytest.approx(2 * areaOfSlope, rel=1e-12)
	assert [float(body.shape.volume) / 2 for body in bodies] == pytest.approx(rock.volumes, rel=1e-12)


def testTheyAreTheSectionOfTheRockInSpace():
	"""Where all joints strike across the section, each block in space is one of the plane, as deep as the prism is."""
	sets = joints((35, left, 3), (70, right, 4), (5, left, 2.5))
	flat = polytope.jointedRock(*slope, sets, smallest=0)
	normals = [(x, 0, y) for x, y in slope[0]]
	space = polytope.jointedRock([*normals, (0, 1, 0), (0, -1, 0)], [*slope[1], 20, 20], sets, smallest=0)
	assert np.sort(flat.volumes) == pytest.approx(np.sort(space.volumes) / 40, abs=1e-10)
	assert np.sort(flat.areas) == pytest.approx(np.sort(space.areas) / 40, abs=1e-10)
	assert flat.joints[:, :2] == pytest.approx(space.joints[:, [0, 2]]) and not flat.joints[:, 2].any()


def testPartsOfARegionThatIsNotConvex():
	"""A step in two parts: rock goes on across the face that they share."""
	sides = [(1, 0), (-1, 0), (0, 1), (0, -1)]
	region = [sides, sides], [[10, 0, 4, 0], [10, -6, 9, -4]]
	rock = polytope.jointedRock(*region, joints((45, right, 2.2)))
	assert rock.volumes.sum() == pytest.approx(10 * 4 + 4 * 5, rel=1e-12)
	material()
	rock.append()
	assert any(body.isClump for body in O.bodies)


def testJointsOfARadiusEndInTheRock():
	"""As many of them as make the length per area, as segments; what they do not cut off stays together."""
	material()
	sets = [polytope.JointSet(math.radians(20), right, p32=0.5, radius=3.0), *joints((65, left, 3))]
	rock = polytope.jointedRock(*slope, sets, seed=4, smallest=0)
	length, area = rock.areas[rock.sets == 0].sum(), rock.volumes.sum()
	assert length / area == pytest.approx(0.5, rel=0.02)
	assert area == pytest.approx(areaOfSlope, rel=1e-12)
	assert max(rock.areas[rock.sets == 0]) <= 6 * (1 + 1e-9)
	ids = rock.append()
	assert any(len(parts) > 1 for parts in rock.bodies)
	assert sum(float(O.bodies[part].state.mass) for k in ids for part in partsOf(k)) == pytest.approx(density * areaOfSlope, rel=1e-9)


def testOneJointOfARadius():
	"""A segment from (2, 2) to (8, 2) of a square cuts nothing off; one as long as the square does."""
	sides = [(1, 0), (-1, 0), (0, 1), (0, -1)]
	for radius, bodies in ((3, 1), (5.1, 2)):
		rock = polytope.jointedRock(sides, [10, 0, 4, 0], [polytope.Joint(0, right, (5, 2, 0), radius)])
		assert len(rock.bodies) == bodies


@pytest.mark.parametrize('kappa', [20, 400])
def testScatterIsThatOfVonMises(kappa):
	"""Mean cosine I₁(κ)/I₀(κ), and a spacing along the mean normal as asked for."""
	from scipy.special import i0e, i1e

	sides = [(1, 0), (-1, 0), (0, 1), (0, -1)]
	rock = polytope.jointedRock(
		sides,
		[200, 200, 200, 200],
		[polytope.JointSet(math.radians(30), right, 4.0, exponential=True, fisher=kappa)],
		incomplete='cut',
		seed=1,
	)
	mean = np.array([math.sin(math.radians(30)), math.cos(math.radians(30))])
	cosines = rock.joints[:, :2] @ mean
	assert cosines.mean() == pytest.approx(i1e(kappa) / i0e(kappa), abs=4 * cosines.std() / math.sqrt(len(cosines)))
	asked = i0e(kappa) / i1e(kappa) / 4
	assert rock.areas.sum() / rock.volumes.sum() == pytest.approx(asked, rel=3 / math.sqrt(len(cosines)))


def testPersistence():
	whole = polytope.jointedRock(*slope, joints((35, left, 3), (70, right, 4)))
	some = [polytope.JointSet(math.radians(35), left, 3, persistence=0.5), polytope.JointSet(math.radians(70), right, 4)]
	part = polytope.jointedRock(*slope, some, seed=2)
	assert 0.3 < (len(part.blocks) - 1) / (len(whole.blocks) - 1) < 0.95 and part.volumes.sum() == pytest.approx(areaOfSlope, rel=1e-12)


def testFacesHaveTheMaterialOfTheirJoint():
	material()
	O.materials.append(RockJointMat(label='bed', density=density, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.3))
	rock = polytope.jointedRock(*slope, joints((35, left, 3), (70, right, 4)))
	for k in rock.append(jointMaterials=['bed', None], material=0):
		body = O.bodies[k]
		for normal, own in zip(body.shape.normals, body.shape.faceMaterials, strict=True):
			normal = body.state.ori * normal
			on = (
				abs(normal[0] + math.sin(math.radians(35)) * np.sign(normal[1] or 1)) < 1e-9
				and abs(abs(normal[1]) - math.cos(math.radians(35))) < 1e-9
			)
			assert own == (1 if on else -1)


dip, height = math.radians(35), 5.0


def planeFailure(**strength):
	"""A triangle on a joint that falls to a free face on the right; what is below it is fixed. Returns its weight and the joint's length."""
	material(**strength)
	sides = [(1, 0), (-1, 0), (0, 1), (0, -1)]
	rock = polytope.jointedRock(sides, [10, 0, 6, 0], [polytope.Joint(dip, right, (10, 1, 0))])
	lower, upper = sorted(rock.append(), key=lambda k: O.bodies[k].state.pos[1])
	O.bodies[lower].dynamic = False
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	area = height * height / math.tan(dip) / 2
	assert float(O.bodies[upper].state.mass) == pytest.approx(density * area, rel=1e-12)
	return upper, density * gravity * area, height / math.sin(dip)


@pytest.mark.filterwarnings('ignore:gravity at once')
@pytest.mark.parametrize('cohesion', [0, 2e4])
@pytest.mark.parametrize('way', ['factorOfSafety', 'limitAnalysis'])
def testPlaneFailure(way, cohesion):
	"""(W cos ψ tan φ + c L) / (W sin ψ)"""
	friction = math.radians(50)
	block, weight, length = planeFailure(frictionAngle=friction, cohesion=cohesion, residualCohesion=cohesion)
	theory = (weight * math.cos(dip) * math.tan(friction) + cohesion * length) / (weight * math.sin(dip))
	if way == 'factorOfSafety':
		polytope.settle()
	found = getattr(polytope, way)()
	assert found.factor == pytest.approx(theory, rel=0.01)
	assert found.bodies == [block]
	assert found.directions[0][:2] @ [math.cos(dip), -math.sin(dip)] == pytest.approx(1, abs=0.3 if way == 'limitAnalysis' else 1e-3)


def testWhatIsNotOfThePlaneIsRefused():
	for bad in (polytope.JointSet(0.5, 0.3, 1), polytope.Joint(0.5, 0.3, (0, 0, 0))):
		with pytest.raises(ValueError, match='^jointSets: in the plane .*dipDirection must be π/2'):
			polytope.jointedRock(*slope, [bad])
	with pytest.raises(ValueError, match=r'^jointSets: a Joint.polygon is one of space'):
		polytope.jointedRock(*slope, [polytope.Joint.polygon([(0, 0, 0), (1, 0, 0), (0, 0, 1)])])
	with pytest.raises(ValueError, match='^normals: some parts .* two components, and some of three'):
		polytope.jointedRock([slope[0], [*np.eye(3), *-np.eye(3)]], [slope[1], [1] * 6], joints((35, left, 3)))
	with pytest.raises(ValueError, match='^offsets: must be one for each of the 4 normals, got 3'):
		polytope.jointedRock(slope[0], slope[1][:3], joints((35, left, 3)))
	with pytest.raises(ValueError, match='^normals: '):
		polytope.jointedRock(slope[0][:2], slope[1][:2], joints((35, left, 3)))
	with pytest.raises(ValueError, match='blocks are to be expected'):
		polytope.jointedRock(*slope, joints((35, left, 3e-3), (70, right, 4e-3)))
	rock = polytope.jointedRock(*slope, joints((35, left, 3)))
	for report in (polytope.rockReport, lambda rock: polytope.keyBlocks(rock, (0, 1, 0), 0.5)):
		with pytest.raises(ValueError, match='^rock: is one in the plane'):
			report(rock)
	with pytest.raises(ValueError, match='^thickness: '):
		polytope.fromHalfSpaces([*np.eye(3), *-np.eye(3)], [1] * 6, thickness=2)


def testPointsOfTwoComponents():
	"""Joints, sets and histories take points of two components as they take three; in space they are refused."""
	first = polytope.Joint(math.radians(35), left, (5, 3), radius=4), polytope.JointSet(math.radians(70), right, 4, through=(2, 1))
	second = polytope.Joint(math.radians(35), left, (5, 3, 7), radius=4), polytope.JointSet(math.radians(70), right, 4, through=(2, 1, 7))
	one = polytope.jointedRock(*slope, [[first[0]], first[1]])
	with (
		pytest.warns(UserWarning, match=r'^jointSets: 1 joints have a z, the first \(5.0, 3.0, 7.0\), which does not count in the plane'),
		pytest.warns(UserWarning, match=r'^jointSets: 1 sets have a z, the first through=\(2.0, 1.0, 7.0\), .*take through=\(x, z\)'),
	):
		two = polytope.jointedRock(*slope, [[second[0]], second[1]])
	assert one.volumes.tolist() == two.volumes.tolist() and len(one.volumes) > 5 and first[0].centre == (5, 3)
	normals = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	for given, name in zip(first, ('centre', 'through'), strict=True):
		with pytest.raises(ValueError, match=f'^{name}: must be three numbers for rock in space, got '):
			polytope.jointedRock(normals, [9] * 6, [given])
	with pytest.raises(ValueError, match='^centre: must be three numbers'):
		polytope.Joint(0, 0, (1,))


def testAHistoryOfAPointInThePlane():
	material()
	O.bodies.append(polytope.polygon([(-2, -1), (2, -1), (2, 0), (-2, 0)], fixed=True))
	block = O.bodies.append(polytope.polygon([(-1, 0), (1, 0), (1, 1), (-1, 1)]))
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	polytope.history({'top': (0.5, 0.9), 'same': (0.5, 0.9, 0)}, every=10)
	O.run(100, wait=True)
	assert plot.data['top_y'] == plot.data['same_y'] and plot.data['top_y'][-1] == pytest.approx(
		float(O.bodies[block].state.pos[1]) - 0.5, rel=0.01
	)
	assert plot.data['top_y'][-1] < -1e-8
	O.reset()
	material()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	O.engines = polytope.engines()
	with pytest.raises(ValueError, match='^points: top: must be three numbers, got .*two are those of a scene of polygons'):
		polytope.history({'top': (0.5, 0.5)})


def testARegionWithoutOpeningsInThePlane():
	"""A tunnel of six sides in a slope, and a trench that reaches out of it."""
	turns = [math.radians(60 * k) for k in range(6)]
	tunnel = [(math.cos(a), math.sin(a)) for a in turns], [2 + 15 * math.cos(a) + 8 * math.sin(a) for a in turns]
	trench = [(1, 0), (-1, 0), (0, 1), (0, -1)], [26, -22, 50, -17]
	region = polytope.regionWithout(*slope, [tunnel, trench])
	assert all(n.shape[1] == 2 for n in region[0])
	rock = polytope.jointedRock(*region, joints((35, left, 3), (70, right, 4)), smallest=0)
	assert rock.volumes.sum() == pytest.approx(areaOfSlope - 6 * 2**2 / math.sqrt(3) - 4 * 3, rel=1e-12)
	again = polytope.regionWithout(*region, [([(1, 0), (-1, 0), (0, 1), (0, -1)], [29, -28, 2, -1])])
	assert polytope.jointedRock(*again, joints((35, left, 3)), smallest=0).volumes.sum() == pytest.approx(rock.volumes.sum() - 1, rel=1e-12)
	with pytest.raises(ValueError, match='^openings: must be a list of'):
		polytope.regionWithout(*slope, [([(1, 0, 0), (-1, 0, 0)], [1, 1])])
	with pytest.raises(ValueError, match='^openings: must be a list of .*a polygon has at least 3 sides, got 1'):
		polytope.regionWithout(*slope, [([(1, 0)], [2])])
	with pytest.raises(ValueError, match='^openings: nothing is left'):
		polytope.regionWithout(*slope, [([(1, 0), (-1, 0), (0, 1), (0, -1)], [99] * 4)])


def testPicturesShowTheSetsOfSides(tmp_path):
	"""A strip along each side of a polygon, on the cap that is seen, has the colour of the set that made it; what is the region's is grey."""
	material()
	rock = polytope.jointedRock([(1, 0), (-1, 0), (0, 1), (0, -1)], [3, 3, 3, 3], joints((0, right, 2), (90, right, 2)))
	ids = rock.append()
	bodies = [O.bodies[k] for k in ids]
	mesh = collect(bodies, faceColors(bodies, rock.setsOfFaces, None).of)['solid']
	loops = np.split(mesh['connectivity'], mesh['offsets'][1:-1])
	cap = {0: [], 1: [], None: []}
	for loop, color in zip(loops, mesh['colors'].tolist(), strict=True):
		points = mesh['points'][loop]
		if np.ptp(points[:, 2]) == 0 and points[0, 2] > 0:
			area = abs(np.sum(points[:, 0] * np.roll(points[:, 1], -1) - points[:, 1] * np.roll(points[:, 0], -1))) / 2
			key = next((k for k in (0, 1) if color == [round(255 * x) for x in rgbOf(palette)[k]]), None)
			cap[key].append(area)
	whole = 6 * 6
	assert sum(sum(areas) for areas in cap.values()) == pytest.approx(whole)
	# a strip has a quarter of the height of the triangle from its side to the middle, 1 − 0.75² of its area; each side of a square has a quarter of its area
	strip = (1 - 0.75**2) / 4
	sides = {0: 0, 1: 0}
	for body in bodies:
		area = float(body.shape.volume)
		for number in rock.setsOfFaces(body).tolist():
			if number >= 0:
				sides[number] += strip * area
	assert [sum(cap[k]) for k in (0, 1)] == pytest.approx([sides[0], sides[1]]) and min(sides.values()) > 1
	polytope.picture(str(tmp_path / 'sets.png'), colorBy=rock.setsOfFaces, legend='set', size=(300, 200), edges=False)
	with Image.open(tmp_path / 'sets.png') as picture:
		seen = np.array(picture.convert('RGB'), int)[60:].reshape(-1, 3)  # below the legend
	for k in (0, 1):  # shaded: of the same hue
		own = np.array(rgbOf(palette)[k])
		alike = seen @ own / np.maximum(np.linalg.norm(seen, axis=1), 1) / np.linalg.norm(own)
		assert ((alike > 0.995) & (seen.min(axis=1) < 100)).sum() > 300


def testFromTheFileOfASurveyToTheFactorOfSafety(tmp_path):
	"""Bedding of 35° with 40° of friction between steep joints: tan 40°/tan 35°; from a CSV file in space, whose x and z are the section's axes."""
	rows = [(35, 270, 5, z, 'bedding') for z in (2, 5, 8)] + [(80, 90, x, 2, 'steep') for x in (3, 6, 9, 12)] + [(85, 0, 5, 5, 'along')]
	text = ''.join(f'{dip},{direction},{x},4,{z},{name}\n' for dip, direction, x, z, name in rows)
	(tmp_path / 'survey.csv').write_text('dip,dip_direction,x,y,z,set\n' + text)
	survey = [
		polytope.Joint(one.dip, one.dipDirection, (one.centre[0], one.centre[2]), one.radius, one.set)
		for one in polytope.readJoints(str(tmp_path / 'survey.csv'))
		if one.set != 'along'  # the section's own direction
	]
	face = math.radians(60)
	section = polytope.jointedRock([(1, 0), (-1, 0), (0, 1), (0, -1), (-math.sin(face), math.cos(face))], [15, 2, 10, 2, 0], [survey])
	for name, friction in (('bedding', 40), ('steep', 45)):
		material(label=name, frictionAngle=math.radians(friction))
	ids = section.append(jointMaterials=['bedding', 'steep'], material='steep')
	for k, blocks in zip(ids, section.bodies, strict=True):
		own = [normal for b in blocks for normal, joint in zip(section.blocks[b][0], section.faces[b], strict=True) if joint < 0]
		O.bodies[k].dynamic = not any(y < -0.99 or x > 0.99 for x, y in own)
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	theory = math.tan(math.radians(40)) / math.tan(math.radians(35))
	found = polytope.limitAnalysis()
	assert len(ids) == 18 and found.factor == pytest.approx(theory, rel=0.01)
	polytope.settle()
	found = polytope.factorOfSafety(tolerance=0.02)
	assert found.stable < theory * 1.001 and found.failed > theory * 0.999 and found.failed <= 1.02 * found.stable
	ways = found.directions[: min(3, len(found.bodies))]
	assert ways @ (-math.cos(math.radians(35)), -math.sin(math.radians(35)), 0) == pytest.approx(np.ones(len(ways)), abs=0.01)
