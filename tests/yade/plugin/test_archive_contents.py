# SPDX-License-Identifier: GPL-2.0-or-later
"""What saved scenes hold of shapes and contacts, and how much of it."""

import copy
import os
import pickle

import pytest
from scenes import joint, loop
from yade import O, Polytope, Quaternion, polytope


def columns(number, gap=-1e-3):
	"""Cubes in twos, one on the other."""
	O.reset()
	joint(normalStiffness=1e8)
	loop()
	for k in range(number):
		O.bodies.append([polytope.cuboid((2 * k, 0, z), (0.5, 0.5, 0.5)) for z in (0, 1 + gap)])
	O.dt = 1e-6


def contacts():
	return {
		(one.id1, one.id2): (one.phys.normalForce, one.phys.kn, one.geom.contactPoint, one.geom.normal, one.geom.refR1)
		for one in O.interactions
	}


@pytest.mark.parametrize('archive', ['scene.xml', 'scene.yade', 'scene.yade.gz'])
def testPlanesAndContactsComeBackBitForBit(archive, tmp_path):
	columns(0)
	body = polytope.regular(12, 0.7, orientation=Quaternion((1, 2, 3), 0.4), cornerRadius=0.1)
	O.bodies.append([body, polytope.cuboid((0, 0, 1.05), (0.5, 0.4, 0.6))])
	planes = [(one.shape.normals, one.shape.offsets) for one in O.bodies]
	assert [len(normals) for normals, _ in planes] == [12, 6]
	O.step()
	before = contacts()
	assert len(before) == 1
	O.save(str(tmp_path / archive), quiet=True)
	assert [(one.shape.normals, one.shape.offsets) for one in O.bodies] == planes
	O.load(str(tmp_path / archive), quiet=True)
	assert [(one.shape.normals, one.shape.offsets) for one in O.bodies] == planes and O.bodies[0].shape.cornerRadius == 0.1
	assert contacts() == before


def testXmlNamesWhatItHolds(tmp_path):
	columns(1)
	O.step()
	O.save(str(tmp_path / 'scene.xml'), quiet=True)
	text = (tmp_path / 'scene.xml').read_text()
	assert all(f'<{name}' in text for name in ('normals', 'offsets', 'contactPoint', 'normalForce', 'statusCode', 'slip'))


@pytest.mark.parametrize('archive', ['scene.xml', 'scene.yade'])
def testAShapeThatBodiesShareStaysOne(archive, tmp_path):
	O.bodies.append([polytope.cuboid((2 * k, 0, 0), (0.5, 0.5, 0.5)) for k in range(2)])
	O.bodies[1].shape = O.bodies[0].shape
	O.save(str(tmp_path / archive), quiet=True)
	O.load(str(tmp_path / archive), quiet=True)
	O.bodies[0].shape.cornerRadius = 0.2
	assert O.bodies[1].shape.cornerRadius == 0.2


@pytest.mark.parametrize('again', [copy.deepcopy, lambda shape: pickle.loads(pickle.dumps(shape))], ids=['copied', 'pickled'])
def testAShapeIsCopiedAndPickledWithItsPlanes(again):
	shape = polytope.regular(8, 0.5, cornerRadius=0.05).shape
	other = again(shape)
	assert (other.normals, other.offsets, other.cornerRadius, other.volume) == (shape.normals, shape.offsets, 0.05, shape.volume)
	assert set(shape.dict()) >= {'normals', 'offsets', 'cornerRadius', 'dimension', 'thickness', 'color'}
	assert Polytope(normals=shape.normals, offsets=shape.offsets).volume == shape.volume


def testPlanesOfAShapeAreNotChanged():
	shape = polytope.cuboid((0, 0, 0), (1, 2, 3)).shape
	planes = shape.normals, shape.offsets
	with pytest.raises(AttributeError):
		shape.offsets = [1] * 6
	shape.updateAttrs({'offsets': [1.0] * 6})
	assert (shape.normals, shape.offsets) == planes and shape.volume == pytest.approx(48)


@pytest.mark.skipif(polytope.buildInfo()['precision'] != 'double', reason='bytes of a double')
def testBytesOfASavedContact(tmp_path):
	"""The contact's numbers take 0.6 kB, the vertices that it keeps 0.1; what the archive notes (classes, bases, addresses) little more."""
	sizes = []
	for gap in (-1e-3, 0.5):
		columns(200, gap)
		engine = polytope.checkpoint(str(tmp_path / 'run'), iterPeriod=1000, onSignal=False)
		O.step()
		engine.write()
		O.save(str(tmp_path / 'scene.yade'), quiet=True)
		assert O.interactions.countReal() == (200 if gap < 0 else 0)
		sizes.append([os.path.getsize(tmp_path / name) for name in ('scene.yade', 'run.yade')])
	each = [(with_ - without) / 200 for with_, without in zip(*sizes, strict=True)]
	print(each)
	assert all(450 < one < 800 for one in each)
