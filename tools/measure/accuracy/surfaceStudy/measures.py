# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that slide and rest on floors made of flush pieces, compared with one smooth floor. Each function is one run."""

import dataclasses
import math

import numpy as np
from yade import O, Quaternion

from .flatBodies import lyingBody, planarBodies
from .floors import Floor, planarFloors
from .surface import SurfaceScene

__all__ = ['Crossing', 'Rest', 'Way', 'cross', 'planarFloor', 'rest', 'slideDown', 'stop']

samples = 400
"""Readings of the body's state in a run, about."""


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
	behind=0.08,
	**scene,
):
	"""A frictionless body at rest on the first piece is given a speed, and slides over the joints.

	It crosses all *seams* joints, and stops with its whole length behind the last one. With *edge* 'front' or 'back' that edge alone
	crosses the first joint, from 1 mm before it to *behind* [m] it, for speeds so low that more would take long. (The paper's normal
	is affected by a joint up to twice the corner radius, 50 mm for the cube.)

	:param dict contact: attributes of the contact functors
	:param float speed: [m/s]
	:param float spacing: of the joints [m]
	:param float angle: between joints and motion [°]
	:param scene: further attributes of SurfaceScene
	"""
	heading = math.radians(90 - angle)
	yaw = scene.get('yaw', 0.0)
	lying = lyingBody(body, heading=heading, yaw=yaw, tilt=scene.get('tilt', Quaternion.Identity))
	start, travel = _path(lying, seams, spacing, heading, edge, behind)
	shift = travel * math.sin(heading)
	pieces = scene.pop('pieces', None) or Floor(
		seams, spacing, before=spacing - start[0] + 2, after=3, side=(min(-2.0, shift - 2), max(2.0, shift + 2))
	)
	run = SurfaceScene(planarFloor(floor, body), body, contact or {}, perArea, pieces, heading=heading, at=start, **scene).build().settle()
	return _slide(run, speed, travel, max(lying.front, lying.back))


def planarFloor(floor, body):
	"""The floor of polygons that is like one of cuboids, for polygons."""
	if body in planarBodies and floor not in planarFloors:
		return {'slab': 'polygon', 'plates': 'polygons', 'oblique': 'obliquePolygons'}[floor]
	return floor


def _path(lying, seams, spacing, heading, edge, behind):
	"""((x, y) to start from, length of the way)."""
	first, last = spacing, spacing * max(seams, 1)
	margin = 0.001
	room = lying.front if edge != 'back' else -lying.back
	x = first - (room + margin) * math.cos(heading)
	if edge is not None:
		return (x, 0.13), margin + behind
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
	left = math.ceil(travel / speed / O.dt)
	every = max(1, left // samples)
	while left > 0:
		run.steps(min(every, left))
		left -= every
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


@dataclasses.dataclass
class Rest:
	"""A body at rest across a joint."""

	depth: float
	"""How far it has sunk in, over that on one piece: its mean depth at rest there; 1 in theory."""
	tilt: float
	"""Angle from the level [rad]; 0 in theory."""
	creep: float
	"""Speed left, over that of a fall through the depth on one piece."""
	contacts: int


def rest(floor='plates', body='cube', contact=None, perArea=False, off=0.0, spacing=1.0, **scene):
	"""Depth of a body at rest across a joint, against that on a slab with the same contact.

	:param float off: of the body's centroid from the joint across x [m]
	"""
	depths = []
	for kind in ('slab', floor):
		pieces = Floor(1, spacing, before=1.5, after=1.5, side=(-1.2, 1.4))
		run = SurfaceScene(planarFloor(kind, body), body, contact or {}, perArea, pieces, at=(spacing + off, 0.13), friction=0.5, **scene)
		run.build().settle(150)
		run.advance(20 * math.sqrt(run.mass / run.stiffness))
		depths.append(run.lying.height - run.position[2])
	fall = math.sqrt(2 * run.gravity * run.depth)
	return Rest(float(depths[1] / depths[0]), run.leaning, float(np.linalg.norm(run.velocity)) / fall, run.touching)


@dataclasses.dataclass
class Way:
	"""A distance for which there is a closed form."""

	distance: float
	"""Distance over the closed form's; 1 in theory."""
	direction: float
	"""Way across the motion over the closed form's along it; 0 in theory."""
	turned: float
	"""Largest component of the spin [rad/s] times the body's half length, over the closed form's largest speed; 0 in theory."""
	travel: float
	"""[m]"""
	steps: int
	failures: int


def stop(floor='plates', body='cube', contact=None, perArea=False, speed=2.0, friction=0.3, spacing=0.2, **scene):
	"""A body with friction slides until it stops: v²/(2 μ g).

	The floor's joints are *spacing* apart over all of the way. The distance is that to the first moment without speed.
	"""
	theory = speed**2 / (2 * friction * 9.81)
	run = _longFloor(floor, body, contact, perArea, theory, spacing, friction=friction, **scene).settle()
	start, first = run.position, O.iter
	run.push(speed)
	for _ in range(round(3 * speed / (friction * run.gravity) / O.dt)):
		O.step()
		if not run.velocity[0] > 0:
			break
	return _way(run, start, theory, speed, first)


def slideDown(floor='plates', body='cube', contact=None, perArea=False, incline=45.0, friction=25.0, time=0.8, spacing=0.4, **scene):
	"""A body released on an incline: from its speed after the first twentieth of a second on, g (sin α − tan φ cos α).

	Until the shear springs are loaded, in the first milliseconds, friction is less than it will be. A body that rocks moves up and down, so that its
	weight on the slope, and friction, vary; while it slides, x + z tan φ of its centroid (z: height above the slope) accelerates by that
	all the same: m x'' = m g sin α − N tan φ, m z'' = N − m g cos α. This is what is read.

	:param float incline: [°]
	:param float friction: angle φ [°]
	:param float time: after which its way is read [s]
	:returns: :yref:`Way`: *distance* is the way less that at constant speed, over ½ a t²
	"""
	a, phi = math.radians(incline), math.radians(friction)
	acceleration = 9.81 * (math.sin(a) - math.tan(phi) * math.cos(a))
	run = _longFloor(
		floor, body, contact, perArea, 0.5 * acceleration * time**2, spacing, friction=math.tan(phi), incline=a, **scene
	).settle()
	first = O.iter
	run.advance(0.05)
	combined = np.array([1, 0, math.tan(phi)])
	start, speed, begun = run.position, float(run.velocity @ combined), O.time
	run.advance(time - 0.05)
	elapsed = O.time - begun
	way = run.position - start
	return _way(
		run, run.position - [way @ combined - speed * elapsed, way[1], 0], 0.5 * acceleration * elapsed**2, acceleration * time, first
	)


def _longFloor(floor, body, contact, perArea, travel, spacing, **scene):
	"""A body that starts a little before the first joint of a floor with as many joints as its way needs."""
	lying = lyingBody(body)
	beyond = 2 * lying.front + 0.4
	pieces = Floor(max(1, math.ceil(1.1 * travel / spacing)), spacing, before=beyond, after=beyond, side=(-0.7, 0.9))
	return SurfaceScene(
		planarFloor(floor, body), body, contact or {}, perArea, pieces, at=(spacing - lying.front - 0.002, 0.13), **scene
	).build()


def _way(run, start, theory, speed, first):
	way = run.position - start
	length = max(run.lying.front, run.lying.back)
	return Way(
		distance=float(way[0] / theory),
		direction=float(way[1] / theory),
		turned=float(np.abs(run.spin).max() * length / speed),
		travel=float(way[0]),
		steps=O.iter - first,
		failures=run.failures,
	)
