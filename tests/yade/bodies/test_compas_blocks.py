# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks of masonry from COMPAS: the layouts of its versions, supports, an arch that stands; malformed files are refused by name."""

import json
from math import cos, pi, sin

import numpy as np
import pytest
from scenes import joint
from yade import O, polytope

faces = [[0, 1, 2, 3], [0, 3, 5, 4], [3, 2, 6, 5], [2, 1, 7, 6], [1, 0, 4, 7], [4, 5, 6, 7]]


@pytest.fixture(autouse=True)
def material():
	joint(frictionAngle=0.7, normalStiffness=1e10, shearStiffness=1e10)


def box(low, high):
	x, y, z = zip(low, high, strict=True)
	return [
		(x[0], y[0], z[0]),
		(x[0], y[1], z[0]),
		(x[1], y[1], z[0]),
		(x[1], y[0], z[0]),
		(x[0], y[0], z[1]),
		(x[1], y[0], z[1]),
		(x[1], y[1], z[1]),
		(x[0], y[1], z[1]),
	]


def mesh(points, text=False):
	"""The tables of a COMPAS mesh; *text*: with vertices named by texts in faces, too, as its first versions have them."""
	return dict(
		attributes={},
		vertex={str(k): dict(zip('xyz', point, strict=True)) for k, point in enumerate(points)},
		face={str(k): [str(one) for one in face] if text else face for k, face in enumerate(faces)},
		max_vertex=7,
	)


def assembly(blocks, supports):
	"""compas_assembly before COMPAS 0.18."""
	nodes = {str(k): dict(x=0, y=0, z=0, is_support=k in supports) for k in range(len(blocks))}
	return dict(assembly=dict(vertex=nodes, edge={}), blocks={str(k): mesh(points, text=True) for k, points in enumerate(blocks)})


def graph(blocks, supports):
	"""compas_assembly of COMPAS 0.18 to 1, nodes in any order."""

	def wrapped(k):
		return dict(
			dtype='compas_assembly.datastructures/Block',
			value=dict(data=mesh(blocks[k]), datatype='compas_assembly.datastructures/Block', compas='0.18.1'),
		)

	nodes = {str(k): dict(block=wrapped(k), x=0, **({'is_support': True} if k in supports else {})) for k in reversed(range(len(blocks)))}
	return dict(dtype='compas_assembly.datastructures/Assembly', value=dict(data=dict(node=nodes, edge={}), compas='0.18.1'))


def graphOfCompas2(blocks, supports):
	nodes = {
		str(k): dict(block=dict(dtype='compas_assembly.datastructures/Block', data=mesh(points)), is_support=k in supports)
		for k, points in enumerate(blocks)
	}
	inner = dict(attributes={}, graph=dict(dtype='compas.datastructures/Graph', data=dict(node=nodes, edge={})))
	return dict(dtype='compas_assembly.datastructures/Assembly', data=inner, guid='1')


def model(blocks, supports):
	"""compas_dem."""
	elements = {}
	for k, points in enumerate(blocks):
		inner = dict(
			transformation=None,
			features=[],
			name='Block',
			geometry=dict(dtype='compas.datastructures/Mesh', data=mesh(points)),
			is_support=k in supports,
		)
		elements[f'{k}-7f39-48e8'] = dict(dtype='compas_dem.elements/Block', data=inner, guid='2')
	return dict(
		dtype='compas_dem.models/BlockModel', data=dict(transformation=None, elements=elements, materials={}, graph=dict(node={}, edge={}))
	)


def meshes(blocks, supports):
	return [dict(dtype='compas.datastructures/Mesh', data=mesh(points)) for points in blocks]


@pytest.mark.parametrize('layout', [assembly, graph, graphOfCompas2, model, meshes])
def testBlocksOfEachVersion(layout, tmp_path):
	path = tmp_path / 'stack.json'
	stack = [box((0, 0, z), (2, 1, z + 0.5)) for z in np.arange(12) / 2]
	path.write_text(json.dumps(layout(stack, {0})))
	bodies = polytope.readShapes(path, shift=(0, 0, 1))
	assert [float(body.state.pos[2]) for body in bodies] == pytest.approx(list(1.25 + np.arange(12) / 2), abs=1e-12)
	assert all(float(body.shape.volume) == pytest.approx(1, rel=1e-12) for body in bodies)
	assert [body.dynamic for body in bodies] == [layout is meshes] + 11 * [True]
	assert all(not body.dynamic for body in polytope.readShapes(path, fixed=True))
	assert float(polytope.readShapes(path, scale=0.1)[0].shape.volume) == pytest.approx(1e-3, rel=1e-12)


def testAnArchFromAFileStands(tmp_path):
	"""Voussoirs of a half circle share faces exactly; both at the springings are supports."""
	angles = np.linspace(0, pi, 12)
	ends = [[(r * cos(a), y, r * sin(a)) for r in (5.0, 5.8) for y in (0.0, 0.5)] for a in angles]
	blocks = [[one[0], one[1], one[3], one[2], two[0], two[2], two[3], two[1]] for one, two in zip(ends, ends[1:], strict=False)]
	(tmp_path / 'arch.json').write_text(json.dumps(model(blocks, {0, 10})))
	ids = O.bodies.append(polytope.readShapes(tmp_path / 'arch.json'))
	O.engines = polytope.engines(damping=0.6)
	start = [O.bodies[one].state.pos for one in ids]
	polytope.settle()
	assert sum(contact.isReal for contact in O.interactions) == 10
	assert max((O.bodies[one].state.pos - before).norm() for one, before in zip(ids, start, strict=True)) < 1e-3
	assert not O.bodies[ids[0]].dynamic and not O.bodies[ids[10]].dynamic and O.bodies[ids[5]].dynamic


@pytest.mark.parametrize(
	'content, words',
	[
		('no', 'is no JSON'),
		('{}', 'has no blocks'),
		('{"dtype": "compas_assembly.datastructures/Assembly", "data": {"graph": {"data": {"node": {}}}}}', 'has no blocks'),
		('[{"dtype": "compas.datastructures/Mesh", "data": {"vertex": {}}}]', 'block 0: is no mesh'),
		('[3]', 'block 0: is no mesh'),
		('[{"vertex": {"0": {"x": 0, "y": 0, "z": 0}}, "face": {}}]', 'block 0: its vertices make no body'),
		('{"elements": {"a": {"data": {"transformation": {"data": {}}, "geometry": null}}}}', 'element a is moved by a transformation'),
	],
)
def testWhatIsRefused(content, words, tmp_path):
	(tmp_path / 'blocks.json').write_text(content)
	with pytest.raises(ValueError, match=f"^path: '.*blocks.json'.*{words}"):
		polytope.readShapes(tmp_path / 'blocks.json')
