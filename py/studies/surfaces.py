# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that slide, bounce and rest on floors made of flush pieces, against what one smooth floor does. Each function is one run."""

import dataclasses
import math

import numpy as np
from yade import O, Quaternion, Vector3

from ..scenes.flatBodies import lyingBody, planarBodies
from ..scenes.floors import Floor, planarFloors
from ..scenes.surface import SurfaceScene

__all__ = ['Crossing', 'cross']

samples = 400
"""Readings of the body's state in a run."""


@dataclasses.dataclass
class Crossing:
	"""A body that has slid without friction over the joints of a floor."""

	kept: float
	"""Final speed along the motion over the initial one; 1 in theory."""
	slowest: float
	"""Least speed along the motion in between, over the initial one."""
	direction: float
	"""Angle between final and initial velocity in the plane of the floor [rad]; 0 in theory."""
	aside: float
	"""Way across the motion over the way along it; 0 in theory."""
	spin: float
	"""Largest final component of the spin times the body's half length over the initial speed; 0 in theory."""
	lift: float
	"""Largest height over that at rest, over the depth at rest on one piece; 0 in theory."""
	travel: float
	"""[m]"""
	steps: int
	failures: int


def cross(
	floor='plates',
	body='cube',
	contact=None,
	perArea=False,
	speed=1.0,
	seams=3,
	spacing=1.0,
	angle=90.0,
	edge=None,
	**scene,
):
	"""A frictionless body at rest on the first piece is given a speed, and slides over the joints.

	It crosses all *seams* joints, and stops with its whole length behind the last one. With *edge* 'front' or 'back' that edge alone
	crosses the first joint: from 2 mm before it to 80 mm behind (which is beyond where a contact of the default corner radius notices
	it), for speeds so low that more would take long.

	:param dict contact: attributes of the contact functors
	:param float speed: [m/s]
	:param float spacing: of the joints [m]
	:param float angle: between joints and motion [°]
	:param scene: further attributes of SurfaceScene
	"""
	heading = math.radians(90 - angle)
	yaw = scene.get('yaw', 0.0)
	lying = lyingBody(body, heading=heading, yaw=yaw, tilt=scene.get('tilt', Quaternion.Identity))
	start, travel = _path(lying, seams, spacing, heading, edge)
	shift = travel * math.sin(heading)
	pieces = scene.pop('pieces', None) or Floor(
		seams, spacing, before=spacing - start[0] + 2, after=3, side=(min(-2.0, shift - 2), max(2.0, shift + 2))
	)
	run = SurfaceScene(_planarFloor(floor, body), body, contact or {}, perArea, pieces, heading=heading, at=start, **scene).build().settle()
	return _slide(run, speed, travel, max(lying.front, lying.back))


def _planarFloor(floor, body):
	"""The floor of polygons that is like one of cuboids, for polygons."""
	if body in planarBodies and floor not in planarFloors:
		return {'slab': 'polygon', 'plates': 'polygons', 'oblique': 'obliquePolygons'}[floor]
	return floor


def _path(lying, seams, spacing, heading, edge):
	"""((x, y) to start from, length of the way)."""
	first, last = spacing, spacing * max(seams, 1)
	margin = 0.002
	room = lying.front if edge != 'back' else -lying.back
	x = first - (room + margin) * math.cos(heading)
	if edge is not None:
		return (x, 0.13), 0.082
	extent = lying.front + lying.back + 2 * margin
	if heading:  # the joint meets the corners one after another
		extent += 2 * max(lying.front, lying.back) * math.tan(heading)
		x -= max(lying.front, lying.back) * math.sin(heading)
	return (x, 0.13), (last - first) / math.cos(heading) + extent


def _slide(run, speed, travel, length):
	start = run.position
	run.push(speed)
	first = O.iter
	slowest, highest = 1.0, 0.0
	for _ in range(samples):
		run.advance(travel / speed / samples)
		slowest = min(slowest, run.velocity[0] / speed)
		highest = max(highest, run.position[2] - start[2])
		if not math.isfinite(slowest):
			break
	v, way = run.velocity, run.position - start
	return Crossing(
		kept=float(v[0] / speed),
		slowest=float(slowest),
		direction=float(math.atan2(v[1], v[0])),
		aside=float(way[1] / max(abs(way[0]), 1e-300)),
		spin=float(np.abs(run.spin).max() * length / speed),
		lift=float(highest / run.depth),
		travel=float(way[0]),
		steps=O.iter - first,
		failures=run.failures,
	)
