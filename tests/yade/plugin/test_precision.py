# SPDX-License-Identifier: GPL-2.0-or-later
"""The plug-in computes with all digits of the YADE it was built for, whichever of the four precisions that is; and the
precisions agree with each other as far as the coarser one goes."""

import os
import subprocess
import sys

import highPrecisionPair as exact
import mpmath
import precisionScenes
import pytest
import scenes
import yade
from mpmath import mpf
from yade import O, Quaternion, polytope

info = polytope.buildInfo()
precisions = {'double': 53, 'longdouble': 64, 'float128': 113, 'mpfr150': 500}
rounding = mpf(2) ** (1 - info['bits'])


def exactly():
	"""Twenty digits more than YADE's. Without any of YADE's numbers within: turning one into mpmath's sets the digits to YADE's own."""
	return mpmath.workdps(info['digits'] + 20)


def numbers(vector):
	"""YADE's numbers as mpmath's."""
	return [mpf(x) for x in vector]


def testBuildInfoNamesThePrecision():
	assert yade.config.libDir.endswith('yade-' + info['precision'])
	assert info['bits'] == precisions[info['precision']]
	assert info['digits'] == int((info['bits'] - 1) * mpmath.log10(2))


def testPythonsNumbersKeepTheirDigits():
	with exactly():
		third = mpf(1) / 3
	body = polytope.cuboid((third, 0, 0), (1, third, 1), material=scenes.joint())
	found = numbers([body.state.pos[0], body.shape.offsets[2], body.shape.volume])
	with exactly():
		assert abs(found[0] - third) <= rounding
		assert abs(found[1] - third) <= rounding
		assert abs(found[2] - 8 * third) <= 20 * rounding


@pytest.mark.parametrize('archive', ['scene.xml', 'scene.yade'])
def testArchivesKeepAllDigits(archive, tmp_path):
	O.bodies.append(polytope.fromVertices(points1, material=scenes.joint()))
	shape, file = O.bodies[0].shape, str(tmp_path / archive)
	planes = [numbers([*normal, offset]) for normal, offset in zip(shape.normals, shape.offsets, strict=True)]
	O.save(file)
	del shape  # the numbers' memory
	O.reset()
	O.load(file)
	loaded = O.bodies[0].shape
	assert len(planes) > 6 and planes == [numbers([*normal, offset]) for normal, offset in zip(loaded.normals, loaded.offsets, strict=True)]


# ------------------------------------------------------------------------------------------------------------ single pairs

points1 = [(-7, -5, -6), (8, -4, -7), (-3, 9, -5), (6, 7, -4), (-6, -3, 8), (5, -8, 6), (1, 6, 9), (-8, 4, 2)]
points2 = [(5, -6, 1), (17, -3, -4), (6, 9, -2), (19, 5, 3), (9, -1, 14), (4, 1, 7), (15, -9, 5), (11, 8, 10)]
turn = (1, -2, 1, 4)  # x, y, z, w of a quaternion to be normalised
centre, half = (9, 2, 3), (4, 5, 6)


def hulls():
	"""Two hulls of integer points: their planes, centroid and principal axes all come from the plug-in's own arithmetic."""
	return [polytope.fromVertices(points, cornerRadius=2, material=scenes.joint()) for points in (points1, points2)]


def exactHulls():
	planes = exact.hull(points1), exact.hull(points2)
	return planes, min(-exact.largestBall(p)[0] for p in planes)


def hullAndCuboid():
	x, y, z, w = turn
	block = polytope.cuboid(centre, half, Quaternion(w, x, y, z), cornerRadius=2, material=scenes.joint())
	return [polytope.fromVertices(points1, cornerRadius=2, material=scenes.joint()), block]


def exactHullAndCuboid():
	planes = exact.hull(points1), exact.cuboid(centre, half, exact.rotation(*turn))
	return planes, min(-exact.largestBall(planes[0])[0], mpf(min(half)))


pairs = pytest.mark.parametrize('pair, planesOf', [(hulls, exactHulls), (hullAndCuboid, exactHullAndCuboid)])
allowed = 1000 * rounding
"""For lengths of about ten. Planes of hulls and turned bodies carry some ten roundings, and a contact a condition of about ten. Seen: up to 120."""
reached = max(allowed, 1e-9 * rounding * 2**52)
"""What Newton's default tolerance leaves: in double ten (the size of the overlap) times 1e-10, in wider types finer by as much as rounding."""


def distance(a, b):
	return max(abs(p - q) for p, q in zip(a, b, strict=True))


@pairs
def testLinearProgramHasAllDigits(pair, planesOf):
	bodies = pair()
	infeasibility = mpf(polytope.contact(*bodies).infeasibility)
	point = numbers(polytope.contact(*bodies, contactModel='boon2012', contactPoint='chebyshevCentre').point)
	with exactly():
		planes, _ = planesOf()
		s, x = exact.largestBall(planes[0] + planes[1])
		assert s < -0.4
		assert abs(infeasibility - s) <= allowed
		assert distance(point, x) <= allowed


@pairs
def testCentreNormalAndDepthHaveAllDigits(pair, planesOf):
	contact = polytope.contact(*pair(), contactModel='boon2012')
	assert contact.status == 'contact'
	point, normal, depth = numbers(contact.point), numbers(contact.normal), mpf(contact.depth)
	with exactly():
		planes, _ = planesOf()
		x = exact.analyticCentre(planes[0] + planes[1], point)
		n = exact.normal(*planes, x, 2)
		assert distance(point, x) <= reached
		assert distance(normal, n) <= reached
		assert abs(depth - exact.chord(*planes, x, n)) <= reached


# ------------------------------------------------------------------------------------------------------------------ scenes


def ends(scene, precision):
	"""The scene's end in another precision, by a process of its own; skips where that is not built."""
	library = os.path.join(os.path.dirname(yade.config.libDir), 'yade-' + precision)
	if not os.path.exists(os.path.join(library, 'libpolytope.so')):
		pytest.skip(f'{precision} is not built: YADE_POLYTOPE_PRECISION={precision} ./run build')
	environment = dict(os.environ, PYTHONPATH=os.path.join(library, 'py'), OMP_NUM_THREADS='1')
	run = subprocess.run([sys.executable, precisionScenes.__file__, scene], env=environment, capture_output=True, text=True, timeout=1800)
	assert run.returncode == 0, run.stderr
	with mpmath.workdps(160):
		return [mpf(number) for number in run.stdout.split()[-13:]]


@pytest.mark.parametrize('scene', ['collision', 'blockOnFloor'])
@pytest.mark.parametrize('precision', [name for name in precisions if name != info['precision']])
def testScenesAgreeAsFarAsTheCoarserPrecisionGoes(scene, precision):
	theirs = ends(scene, precision)
	ours = numbers(precisionScenes.endOf(scene))
	coarser = mpf(2) ** (1 - min(precisions[precision], info['bits']))
	with mpmath.workdps(160):
		error = distance(ours, theirs)
	assert coarser / 16 < error  # else one of them has not the digits it says
	assert error < 1e5 * coarser
