# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains broken by their mean stress: at the stress of each criterion's closed form, along its planes, without a change of energy."""

import math
import types

import numpy as np
import pytest
from flatFace import faceEnergy, faceForce
from scenes import joint, loop
from yade import O, Vector3, polytope
from yade.polytope.breakage.byStress import _sizeEffect, _use

stiffness, px, pz = 1e9, 4e5, 1e6
edges = 2e-3
"""What the faces' edges take off their pressures: up to the depth over their width."""


@pytest.fixture
def pressed():
	"""A block of 1 × 1 × 2 m between plates without friction: stresses −px, 0, −pz. Its number, and the plate's above it."""
	joint(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0)
	loop(True)
	block = O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 1), velocity=(1e-9, 0, 0), mask=3))
	for axis, half, pressure in ((0, 0.5, px), (2, 1, pz)):
		for side in (1, -1):
			place = side * (half + 0.1 - pressure / stiffness)
			extents = [3, 3, 3]
			extents[axis] = 0.1
			plate = O.bodies.append(
				polytope.cuboid(place * Vector3.Unit(axis), extents, fixed=True, mask=1 + (axis == 2))
			)  # plates do not meet
	O.dt = 1e-9
	O.trackEnergy = True
	O.step()
	return block, plate


q = math.sqrt(px**2 + (pz - px) ** 2 + pz**2) / 3
limits = {'compression': pz, 'shear': pz / 2, 'octahedral': q, 'vonMises': 3 * q / math.sqrt(2)}


@pytest.mark.parametrize('name', limits)
def testEachCriterionBreaksAtItsClosedForm(name, pressed):
	block, _ = pressed
	volume, mass = O.bodies[block].shape.volume, O.bodies[block].state.mass
	assert polytope.breakGrains(**{name: limits[name] * (1 + edges)}) == {}
	broken = polytope.breakGrains(**{name: limits[name] * (1 - edges)})
	assert list(broken) == [block] and O.bodies[block] is None
	pieces = [O.bodies[k] for k in broken[block]]
	assert len(pieces) == (4 if name == 'vonMises' else 2)
	assert sum(piece.shape.volume for piece in pieces) == pytest.approx(volume, rel=1e-12)
	assert sum(piece.state.mass for piece in pieces) == pytest.approx(mass, rel=1e-12)
	assert (sum((piece.state.mass * piece.state.vel for piece in pieces), Vector3.Zero) - mass * Vector3(1e-9, 0, 0)).norm() < 1e-20 * mass
	# the new face's normal: y, the direction of σ₁; or half way between it and z, that of σ₃
	expected = Vector3(0, 1, 0) if name == 'octahedral' else Vector3(0, math.sqrt(0.5), math.sqrt(0.5))
	for piece in pieces:
		normals = [piece.state.ori * normal for normal in piece.shape.normals]
		assert any(Vector3(0, abs(n[1]), abs(n[2])).cross(expected).norm() < 1e-6 and abs(n[0]) < 1e-6 for n in normals)


@pytest.mark.parametrize('name', ['compression', 'octahedral', 'vonMises'])
def testNoEnergyOfOverlapIsReleased(name, pressed):
	_, plate = pressed
	force, stored = O.forces.f(plate)[2], O.energy['elastPotential']
	assert force == pytest.approx(-stiffness * faceForce(pz / stiffness, perArea=True), rel=1e-6)
	assert stored == pytest.approx(
		2 * stiffness * (faceEnergy(pz / stiffness, perArea=True) + faceEnergy(px / stiffness, (1, 2), True)), rel=1e-6
	)
	assert polytope.breakGrains(**{name: 1})
	O.step()
	# each piece has edges of its own
	assert O.forces.f(plate)[2] == pytest.approx(force, rel=edges) and O.energy['elastPotential'] == pytest.approx(stored, rel=edges)


def testStrengthFallsWithSizeAfterWeibull(pressed):
	block, _ = pressed
	given = dict(volume=0.25, modulus=3)  # the block has 2 m³: half the strength
	assert polytope.breakGrains(compression=2 * pz * (1 + edges), **given) == {}
	shared = (-math.log(1 - 0.9)) ** (1 / 3)
	assert polytope.breakGrains(compression=2 * pz / shared * (1 + edges), probability=0.9, **given) == {}
	assert list(polytope.breakGrains(compression=2 * pz / shared * (1 - edges), probability=0.9, **given)) == [block]


def testRandomStrengthsAreThoseOfWeibull():
	"""Largest distance of the distribution of 2000 strengths from Weibull's: 5 % are above 1.36/√2000 = 0.03."""
	factor = _sizeEffect(None, 4, None, 7)
	found = np.sort([factor(types.SimpleNamespace(id=k)) for k in range(2000)])
	expected = 1 - np.exp(-(found**4))
	assert np.abs(expected - np.arange(2000) / 2000).max() < 0.03
	assert factor(types.SimpleNamespace(id=5)) == factor(types.SimpleNamespace(id=5))


def testMixedStressOfMohrAndCoulomb():
	"""Tension along x, compression along z: their parts add up, and each alone counts without the other."""
	axes, none = np.eye(3)[:, ::-1], math.inf  # columns of ascending stresses: z, y, x
	strong = np.array([2.0, 8.0, none, none, none])
	assert _use(np.array([-4.0, 0, 1]), axes, strong)[0] == pytest.approx(1 / 2 + 4 / 8)
	assert _use(np.array([1.0, 2, 3]), axes, strong)[0] == pytest.approx(3 / 2)
	assert _use(np.array([-3.0, -2, -1]), axes, strong)[0] == pytest.approx(3 / 8)
	largest, (normal,) = _use(np.array([-4.0, 0, 1]), axes, strong * 10)
	assert largest == pytest.approx(0.1) and abs(normal / math.sqrt(2)) == pytest.approx([math.sqrt(0.5), 0, math.sqrt(0.5)])


def testWhatIsLeftWholeAndRefused(pressed):
	block, plate = pressed
	assert polytope.breakGrains(compression=1, smallest=10) == {} and O.bodies[block] is not None
	assert polytope.breakGrains(compression=1, ids=[plate]) == {}, 'fixed bodies do not break'
	spare = O.bodies.append(polytope.cuboid((5, 5, 5), (1, 1, 1)))
	O.bodies.erase(spare)
	assert polytope.breakGrains(compression=1, ids=[plate, spare]) == {}, 'what is no more is left out'
	for arguments, words in (
		({}, 'tension: give at least one'),
		({'shear': -1}, 'shear: must be a strength'),
		({'shear': 1, 'volume': 1}, 'volume: needs'),
		({'shear': 1, 'modulus': 0}, 'modulus: must be positive'),
		({'shear': 1, 'modulus': 2, 'probability': 1}, 'probability: must be between'),
		({'shear': 1, 'modulus': 2, 'probability': 0.5, 'seed': 1}, 'probability: random'),
		({'shear': 1, 'modulus': 2, 'seed': -1}, 'seed: must be a whole'),
		({'shear': 1, 'ids': [99]}, 'ids: there is no body 99'),
	):
		with pytest.raises(ValueError, match=f'^{words}'):
			polytope.breakGrains(**arguments)
	neighbour = O.bodies.append(polytope.cuboid((0, 1, 0), (0.5, 0.5, 1)))
	polytope.bond(ids=[block, neighbour])
	assert polytope.breakGrains(compression=1) == {}, 'bonded bodies do not break'
