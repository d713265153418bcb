# SPDX-License-Identifier: GPL-2.0-or-later
"""Roses and histograms of packings whose directions and forces are known."""

from math import pi

import numpy as np
import pytest
from yade import O, Quaternion, RockJointMat, polytope


def pressed(overlaps):
	"""A cube pressed by a plate from each axis, with these overlaps: forces in their proportion."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.8))
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)))
	for axis, overlap in zip(np.eye(3), overlaps, strict=True):
		O.bodies.append(polytope.cuboid(tuple((1.5 - overlap) * axis), (1, 1, 1), fixed=True))
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()


def testRoseOfContacts(tmp_path):
	"""Contacts along x and z are in the sectors about 0, π/2, π, 3π/2, the one along y is not seen in xz."""
	pressed((1e-4, 1e-4, 3e-4))
	edges, parts = polytope.contactRose(tmp_path / 'rose.png', bins=12)
	assert edges == pytest.approx((np.arange(13) - 0.5) * pi / 6)
	assert parts == pytest.approx([0.25, 0, 0, 0.25, 0, 0, 0.25, 0, 0, 0.25, 0, 0])
	_, parts = polytope.contactRose(bins=4, weight='force')
	assert parts == pytest.approx([0.125, 0.375, 0.125, 0.375], rel=1e-3)
	_, parts = polytope.contactRose(bins=4, weight='force', plane='xy')
	assert parts == pytest.approx([0.25] * 4, rel=1e-3)
	assert (tmp_path / 'rose.png').read_bytes().startswith(b'\x89PNG')


def testHistogramOfForces(tmp_path):
	"""Forces in the ratio 1 : 1 : 4 are 0.5, 0.5 and 2 of their mean."""
	pressed((1e-4, 1e-4, 4e-4))
	edges, density = polytope.forceHistogram(tmp_path / 'forces.svg', bins=4)
	assert edges == pytest.approx(np.arange(5) / 2, rel=1e-3) and (density * np.diff(edges)).sum() == pytest.approx(1)
	# 0.5 is an edge, on one side of which both are, by rounding
	assert (density[:2] * 0.5).sum() == pytest.approx(2 / 3, rel=1e-2) and density[3] * 0.5 == pytest.approx(1 / 3, rel=1e-2)
	assert '<svg' in (tmp_path / 'forces.svg').read_text()


def testRoseOfBodies():
	turned = Quaternion((0, 1, 0), -pi / 4)  # x towards z
	O.bodies.append([polytope.cuboid((4 * k, 0, 0), (1, 0.5, 0.4), turned if k else Quaternion.Identity) for k in range(4)])
	_, parts = polytope.particleRose(bins=8)
	assert parts == pytest.approx([1 / 8, 3 / 8, 0, 0, 1 / 8, 3 / 8, 0, 0])


def testRefusals():
	pressed((1e-4, 1e-4, 1e-4))
	for name, options in (
		('plane', {'plane': 'xx'}),
		('bins', {'bins': 5}),
		('weight', {'weight': 'mass'}),
		('path', {'path': 3}),
		('path', {'path': 'rose.txt'}),
		('ids', {'ids': [9]}),
	):
		with pytest.raises(ValueError, match=f'^{name}: '):
			polytope.contactRose(**options)
	with pytest.raises(ValueError, match='^bins: '):
		polytope.forceHistogram(bins=0)
	O.interactions.clear()
	with pytest.raises(ValueError, match='^ids: no contact'):
		polytope.forceHistogram()
	O.bodies.append(polytope.cuboid((9, 9, 9), (1, 0.5, 0.4)))
	with pytest.raises(ValueError, match='^plane: '):
		polytope.particleRose(plane='yz', ids=[4])
