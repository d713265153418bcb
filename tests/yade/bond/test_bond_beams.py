# SPDX-License-Identifier: GPL-2.0-or-later
"""Cantilevers of bonded blocks: deflection, natural frequency and failure load against the theory of beams, and against what finitely many bonds give."""

import math

import numpy as np
import pytest
from scenes import joint, loop, stepper
from yade import NewtonIntegrator, O, polytope

modulus, shearModulus = 1e9, 4e8
length, half = 8.0, 0.25
area, inertia = 4 * half**2, (2 * half) ** 4 / 12


def cantilever(number, block=None, **bond):
	"""Blocks in a row along x, the first one fixed and *number* of them free, bonded as a beam of these moduli. Returns the last one.

	The fixed block's half belongs to the beam, too: it begins at that block's centre. With the given length of a block or length/number.
	"""
	h = block or length / number
	O.reset()
	joint(normalStiffness=modulus / h, shearStiffness=shearModulus / h)
	O.bodies.append([polytope.cuboid((k * h, 0, 0), (h / 2, half, half), fixed=k == 0) for k in range(number + 1)])
	loop(True, damping=0.7)
	assert polytope.bond(**bond) == number
	stepper()
	return O.bodies[number]


def settle(body, force, periods=10):
	"""Puts a force on the body, and runs these many periods of the beam's first mode, damped."""
	O.forces.setPermF(body.id, (0, 0, -force))
	O.step()  # the time stepper's first
	for _ in range(int(periods * 2 * math.pi / frequencyOfBeam(length, body.material.density) / O.dt)):
		O.step()


def deflectionOfChain(number, force):
	"""Deflection of the last block's centre: rotation of each bond times its distance, and slip."""
	h = length / number
	arms = h * (np.arange(number) + 0.5)
	return force * h * (arms**2).sum() / (modulus * inertia) + force * length / (shearModulus * area)


def deflectionOfBeam(force):
	"""Timoshenko's beam with a force at its end, the shear spread evenly over its section."""
	return force * length**3 / (3 * modulus * inertia) + force * length / (shearModulus * area)


def frequencyOfBeam(span, density):
	"""First mode of Euler and Bernoulli's cantilever [rad/s]; shear and rotation of the sections lower it by 0.3 % here."""
	return 1.8751040687**2 * math.sqrt(modulus * inertia / (density * area * span**4))


def frequencyOfChain(number, h, body):
	"""First angular frequency of blocks that move along z and turn about y, from their stiffness matrix, assembled here."""
	stiffness = np.zeros((2 * number + 2, 2 * number + 2))
	for k in range(number):
		# of bond k: slip w2 − w1 + h/2 (φ1 + φ2) and turn φ2 − φ1 (w' = −φ)
		for row, spring in (((-1, h / 2, 1, h / 2), shearModulus / h * area), ((0, -1, 0, 1), modulus / h * inertia)):
			at = [2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 3]
			stiffness[np.ix_(at, at)] += spring * np.outer(row, row)
	inverse = 1 / np.sqrt(np.tile([body.state.mass, body.state.inertia[1]], number))
	return math.sqrt(np.linalg.eigvalsh(inverse[:, None] * stiffness[2:, 2:] * inverse)[0])


@pytest.mark.parametrize('number', [1, 2, 6])
def testDeflection(number):
	tip, force = cantilever(number), 1e3
	settle(tip, force)
	assert -tip.state.pos[2] == pytest.approx(deflectionOfChain(number, force), rel=1e-4)
	# the bonds' share of bending misses the beam's by 1/(4 n²): within 1 % from 6 blocks on
	assert -tip.state.pos[2] == pytest.approx(deflectionOfBeam(force), rel=1.05 / (4 * number**2))
	root = next(bond for bond in polytope.bonds().bonds if bond.id1 == 0)
	assert abs(root.force[2]) == pytest.approx(force, rel=1e-4)
	assert abs(root.moment[1]) == pytest.approx(force * length * (1 - 0.5 / number), rel=1e-4)


@pytest.mark.parametrize('number, misses', [(1, 0.12), (2, 0.04), (4, 0.01)])
def testFirstNaturalFrequency(number, misses):
	"""The frequency is that of a beam as long as from the fixed block's centre to the last one's end."""
	h = length / (number + 0.5)
	tip = cantilever(number, h)
	settle(tip, 1e3)
	O.forces.setPermF(tip.id, (0, 0, 0))
	next(one for one in O.engines if isinstance(one, NewtonIntegrator)).damping = 0
	crossings, last, lastTime = [], tip.state.pos[2], O.time
	while len(crossings) < 3:
		O.step()
		now = tip.state.pos[2]
		if last * now < 0:
			crossings.append(lastTime + (O.time - lastTime) * last / (last - now))
		last, lastTime = now, O.time
		assert O.time < 100
	measured = 2 * math.pi / (crossings[2] - crossings[0])
	assert measured == pytest.approx(frequencyOfChain(number, h, tip), rel=1e-2)
	assert measured == pytest.approx(frequencyOfBeam(length, tip.material.density), rel=misses)


@pytest.mark.parametrize('number', [1, 3])
def testFailureLoad(number):
	"""P = σt I/(h/2)/lever: the beam formula at the face of the fixed block. Without the share of bending it holds."""
	strength, lever = 1e4, length * (1 - 0.5 / number)
	failure = strength * inertia / half / lever
	for part, share, fails in ((0.99, 1, False), (1.01, 1, True), (1.01, 0, False)):
		tip = cantilever(number, tensileStrength=strength, bendingShare=share)
		for k in range(1, 481):  # slowly and smoothly, so that inertia adds nothing
			ramp = min(k / 400, 1)
			settle(tip, failure * part * ramp**2 * (3 - 2 * ramp), 0.05)
		assert (polytope.bonds().intactCount < number) == fails
		if fails:
			assert [bond.id1 for bond in polytope.bonds().bonds if not bond.intact] == [0]
