# SPDX-License-Identifier: GPL-2.0-or-later
"""The plug-in computes with all digits of the YADE it was built for, whichever of the four precisions that is; and the
precisions agree with each other as far as the coarser one goes."""
import os
import subprocess
import sys

import mpmath
import pytest
import yade
from mpmath import mpf
from yade import O, Quaternion, Vector3
from yade import polytope

import highPrecisionPair as exact
import precisionScenes
import scenes

info = polytope.buildInfo()
precisions = {'double': 53, 'longdouble': 64, 'float128': 113, 'mpfr150': 500}
rounding = mpf(2)**(1 - info['bits'])


@pytest.fixture(autouse=True)
def digits():
	"""Twenty more than YADE's."""
	old = mpmath.mp.dps
	with mpmath.workdps(info['digits'] + 20):
		yield
	mpmath.mp.dps = old


def testBuildInfoNamesThePrecision():
	assert yade.config.libDir.endswith('yade-' + info['precision'])
	assert info['bits'] == precisions[info['precision']]
	assert info['digits'] == int((info['bits'] - 1) * mpmath.log10(2))


def testPythonsNumbersKeepTheirDigits():
	third = mpf(1) / 3
	body = polytope.cuboid((third, 0, 0), (1, third, 1), material=scenes.joint())
	assert abs(body.state.pos[0] - third) <= rounding
	assert abs(body.shape.offsets[2] - third) <= rounding
	assert abs(body.shape.volume - 8 * third) <= 20 * rounding


# ------------------------------------------------------------------------------------------------------------ single pairs

points1 = [(-7, -5, -6), (8, -4, -7), (-3, 9, -5), (6, 7, -4), (-6, -3, 8), (5, -8, 6), (1, 6, 9), (-8, 4, 2)]
points2 = [(5, -6, 1), (17, -3, -4), (6, 9, -2), (19, 5, 3), (9, -1, 14), (4, 1, 7), (15, -9, 5), (11, 8, 10)]
turn = (1, -2, 1, 4)  # x, y, z, w of a quaternion to be normalised
centre, half = (9, 2, 3), (4, 5, 6)


def hulls():
	"""Two hulls of integer points: their planes, centroid and principal axes all come from the plug-in's own arithmetic."""
	bodies = [polytope.fromVertices(points, cornerRadius=2, material=scenes.joint()) for points in (points1, points2)]
	return bodies, (exact.hull(points1), exact.hull(points2))


def hullAndCuboid():
	x, y, z, w = turn
	block = polytope.cuboid(centre, half, Quaternion(w, x, y, z), cornerRadius=2, material=scenes.joint())
	body = polytope.fromVertices(points1, cornerRadius=2, material=scenes.joint())
	return [body, block], (exact.hull(points1), exact.cuboid(centre, half, exact.rotation(*turn)))


pairs = pytest.mark.parametrize('pair', [hulls, hullAndCuboid])
allowed = 1000 * rounding
"""Times sizes of ten: planes out of hulls and turned bodies carry some ten roundings, and the contact a condition of about ten."""


def distance(a, b):
	return max(abs(p - q) for p, q in zip(a, b, strict=True))


@pairs
def testLinearProgrammeHasAllDigits(pair):
	(one, two), planes = pair()
	contact = polytope.contact(one, two)
	s, x = exact.largestBall(planes[0] + planes[1])
	assert s < -1
	assert abs(contact.infeasibility - s) <= 10 * allowed
	chebyshev = polytope.contact(one, two, contactPoint='chebyshevCentre')
	assert distance(chebyshev.point, x) <= 10 * allowed


@pairs
def testCentreNormalAndDepthHaveAllDigits(pair):
	(one, two), planes = pair()
	contact = polytope.contact(one, two)
	x = exact.analyticCentre(planes[0] + planes[1], contact.point)
	n = exact.normal(*planes, x, 2)
	assert contact.status == 'contact'
	# Newton's tolerance is relative to the overlap: 1e-10 in double, and finer by as much as rounding in wider types
	centreAllowed = max(10 * allowed, 10 * 1e-10 * rounding * 2**52)
	assert distance(contact.point, x) <= centreAllowed
	assert distance(contact.normal, n) <= centreAllowed
	assert abs(contact.depth - exact.chord(*planes, x, n)) <= centreAllowed


@pairs
def testConservativeForceHasAllDigits(pair):
	(one, two), planes = pair()
	barrier = 2.**-8
	contact = polytope.contact(one, two, contactModel='conservative', barrier=barrier)
	smaller = min(-exact.largestBall(p)[0] for p in planes)
	assert abs(min(one.shape.inscribedRadius, two.shape.inscribedRadius) - smaller) <= 10 * allowed
	mu = barrier * smaller
	value, x, n = exact.conservative(*planes, mu, [*contact.point, contact.infeasibility + mu])
	length = mpmath.sqrt(exact.dot(n, n))
	accepted = max(10 * allowed, 10 * 1e-10 * rounding * 2**52)
	assert distance(contact.point, x) <= accepted
	force = [contact.depth * t for t in contact.normal]  # over the stiffness
	assert distance(force, [-4 * value * t for t in n]) <= accepted
	assert abs(contact.energyPerStiffness - 2 * value**2) <= accepted
	assert length > 0.1


# ------------------------------------------------------------------------------------------------------------------ scenes


def ends(scene, precision):
	"""The scene's end in another precision, by a process of its own; skips where that is not built."""
	library = os.path.join(os.path.dirname(yade.config.libDir), 'yade-' + precision)
	if not os.path.exists(os.path.join(library, 'libpolytope.so')):
		pytest.skip(f'{precision} is not built: YADE_POLYTOPE_PRECISION={precision} ./run build')
	environment = dict(os.environ, PYTHONPATH=os.path.join(library, 'py'), OMP_NUM_THREADS='1')
	run = subprocess.run([sys.executable, precisionScenes.__file__, scene], env=environment, capture_output=True, text=True, timeout=600)
	assert run.returncode == 0, run.stderr
	numbers = run.stdout.split()[-13:]
	with mpmath.workdps(160):
		return [mpf(number) for number in numbers]


@pytest.mark.parametrize('scene', ['collision', 'blockOnFloor'])
@pytest.mark.parametrize('precision', [name for name in precisions if name != info['precision']])
def testScenesAgreeAsFarAsTheCoarserPrecisionGoes(scene, precision):
	theirs = ends(scene, precision)
	ours = precisionScenes.endOf(scene)
	coarser = mpf(2)**(1 - min(precisions[precision], info['bits']))
	error = distance(ours, theirs)
	assert coarser / 16 < error  # else one of them has not the digits it says
	assert error < 1e6 * coarser
