# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact of one pair in as many digits as mpmath is told, from the half-spaces alone: what test_precision.py compares with.

Nothing of the plug-in's arithmetic is used. Each function is given all planes in world axes as rows (a, d) of unit normal
and offset, body 1's first."""

import mpmath
import numpy as np
from mpmath import mpf
from scipy.optimize import linprog
from scipy.spatial import ConvexHull


def dot(a, b):
	return mpmath.fdot(zip(a, b, strict=True))


def unit(v):
	length = mpmath.sqrt(dot(v, v))
	return [mpf(x) / length for x in v]


def rotation(x, y, z, w):
	"""Matrix of the quaternion, which need not be of unit length."""
	x, y, z, w = unit([x, y, z, w])
	return [
		[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
		[2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
		[2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
	]


def cuboid(centre, half, turn):
	planes = []
	for k in range(3):
		for sign in (1, -1):
			a = [sign * turn[j][k] for j in range(3)]
			planes.append((a, mpf(half[k]) + dot(a, centre)))
	return planes


def hull(points):
	"""The hull of integer points, no four in a plane: planes from exact cross products."""
	planes = []
	middle = [mpf(sum(p[k] for p in points)) / len(points) for k in range(3)]
	for corners in ConvexHull(points).simplices:
		p, q, r = ([int(x) for x in points[i]] for i in corners)
		u, v = ([b - a for a, b in zip(p, other, strict=True)] for other in (q, r))
		a = unit([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
		if dot(a, p) < dot(a, middle):
			a = [-x for x in a]
		planes.append((a, dot(a, p)))
	return planes


def largestBall(planes):
	"""(s*, x) of min s, a·x − d ≤ s (Boon et al. 2012, Eq. 9): the active planes by double precision, then solved and verified."""
	rows = np.array([[*map(float, a), -1.0] for a, _ in planes])
	found = linprog([0, 0, 0, 1], A_ub=rows, b_ub=[float(d) for _, d in planes], bounds=[(None, None)] * 4, method='highs')
	active = np.argsort(found.slack)[:4]
	matrix = mpmath.matrix([[*planes[i][0], -1] for i in active])
	*x, s = mpmath.lu_solve(matrix, mpmath.matrix([planes[i][1] for i in active]))
	weights = mpmath.lu_solve(matrix.T, mpmath.matrix([0, 0, 0, -1]))
	assert min(weights) > 1e-6 and all(dot(a, x) - d < s + mpf(10) ** (5 - mpmath.mp.dps) for a, d in planes)
	return s, x


def newton(gradient, hessian, start):
	"""Zero of the gradient, from nearby."""
	x = mpmath.matrix(start)
	for _ in range(60):
		step = mpmath.lu_solve(hessian(x), -gradient(x))
		x += step
		if mpmath.norm(step) < mpf(10) ** (8 - mpmath.mp.dps):
			return list(x)
	raise AssertionError('no convergence')


def analyticCentre(planes, start):
	"""argmax Σ log(d − a·x) (Eq. 10)."""
	slack = lambda x: [d - dot(a, x) for a, d in planes]

	def gradient(x):
		return mpmath.matrix([mpmath.fsum(a[k] / s for (a, _), s in zip(planes, slack(x), strict=True)) for k in range(3)])

	def hessian(x):
		scaled = [[t / s for t in a] for (a, _), s in zip(planes, slack(x), strict=True)]
		return mpmath.matrix(3, 3) + mpmath.matrix([[mpmath.fsum(r[j] * r[k] for r in scaled) for k in range(3)] for j in range(3)])

	return newton(gradient, hessian, start)


def normal(planes1, planes2, x, cornerRadius):
	"""Unit normal from body 1 to 2: the mean of both inner potential particles' directions (Eqs 13-17)."""
	sides = []
	for planes in (planes1, planes2):
		brackets = [max(dot(a, x) - d + mpf(cornerRadius), 0) for a, d in planes]
		sides.append(unit([mpmath.fsum(b * a[k] for (a, _), b in zip(planes, brackets, strict=True)) for k in range(3)]))
	return unit([p - q for p, q in zip(*sides, strict=True)])


def chord(planes1, planes2, x, n):
	"""Length through x along n in both bodies (section 2.5)."""
	exit = lambda planes, way: min((d - dot(a, x)) / dot(a, way) for a, d in planes if dot(a, way) > 0)
	return exit(planes1, n) + exit(planes2, [-t for t in n])
