# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects that floors made of pieces must keep: steps, gaps, ends, impacts and rolling. Each function is one run or two."""

import dataclasses
import math

import numpy as np
from yade import O, Quaternion, Vector3
from yade.utils import kineticEnergy

from .flatBodies import lyingBody, planarBodies
from .floors import Floor
from .measures import planarFloor
from .surface import SurfaceScene

__all__ = ['Drop', 'drop', 'edgeCarries', 'gapHolds', 'onStep', 'pressedPast', 'restOverEnd', 'roll']


def onStep(contact=None, perArea=False, floor='plates', body='cube', height=0.002, speed=0.1):
	"""A frictionless body slides against a step.

	:returns: (how far its front has come past the step's face [m], height of the lowest corner past it over the lower
	    floor (infinity if none is) [m], speed along the motion at the end over that at the start)
	"""
	lying = lyingBody(body)
	pieces = Floor(1, 1.0, before=3, after=3, steps=(0.0, height))
	run = SurfaceScene(planarFloor(floor, body), body, contact or {}, perArea, pieces, at=(1 - lying.front - 0.05, 0.13)).build().settle()
	run.push(speed)
	run.advance(0.15 / speed)
	corners = run.corners()
	past = corners[corners[:, 0] > 1 + 2 * run.depth]
	lowest = float(past[:, 2].min()) if len(past) else math.inf
	return float(corners[:, 0].max() - 1), lowest, float(run.velocity[0] / speed)


def pressedPast(speed, height=0.002, side=0.5, depth=SurfaceScene.depth):
	"""How far at most a cube's front comes past a step's face, with a stiffness K per area: until the foundation has its kinetic energy.
	Further in than the step is high, s, the energy grows by K b s²/2 over a way of 1, b: the cube's width. [m]"""
	return depth * side * speed**2 / (SurfaceScene.gravity * height**2)


def gapHolds(contact=None, perArea=False, floor='plates', gap=0.12, body='cube'):
	"""How far bodies have come down over a gap between two plates after a tenth of a second [m]: one wider than the gap, one narrower."""
	found = []
	for kind in (body, 'smallCube'):
		pieces = Floor(1, 1.0, before=3, after=3, gap=gap)
		run = SurfaceScene(floor, kind, contact or {}, perArea, pieces, at=(1.0, 0.13)).build()
		start = run.position
		run.release(0.1)
		found.append(float(start[2] - run.position[2]))
	return tuple(found)


def edgeCarries(contact=None, perArea=False, body='cube', over=0.2, time=0.3):
	"""A body lies over the end of a slab, its centroid *over* half lengths inside of it (negative: outside):
	how far it has come down after so long [m]."""
	lying = lyingBody(body)
	pieces = Floor(0, 1.0, before=3, after=0)
	run = SurfaceScene('slab', body, contact or {}, perArea, pieces, at=(1.0 - over * lying.front, 0.13), friction=0.5).build()
	start = run.position
	run.release(time)
	return float(start[2] - run.position[2])


def restOverEnd(over=0.2, side=0.5, depth=SurfaceScene.depth):
	"""What edgeCarries gives of a cube at rest on a foundation of springs (stiffness per area): its centroid lies c inside of the end, a little less
	once it is tilted; a pressure that falls to 0 over 3 c from the end, and a depth of 2/3 of that at the end below the centroid [m]."""
	inside = over * side / 2
	c = inside
	for _ in range(50):
		edge = 2 * depth * side / (3 * c)
		c = inside - side / 2 * edge / (3 * c)
	return edge * 2 / 3 - depth


@dataclasses.dataclass
class Drop:
	"""A body that has hit a frictionless floor without damping, and left it."""

	sideways: float
	"""Largest horizontal speed afterwards over the speed of the impact; 0 in theory."""
	rebound: float
	"""Upward speed afterwards over the speed of the impact."""
	spin: float
	"""Largest component of the spin afterwards times the body's half length over the speed of the impact."""
	energy: float
	"""Kinetic energy afterwards over that before; 1 in theory."""


def drop(floor='plates', body='cube', contact=None, perArea=False, speed=0.5, tilt=0.0, at=0.0, spacing=1.0, **scene):
	"""A body flies onto a joint, without gravity, friction and damping.

	:param float speed: of the impact [m/s]
	:param float tilt: angle by which the body is turned about the joint's direction [°]
	:param float at: of its centroid from the joint [m]
	"""
	axis = (0, 0, 1) if body in planarBodies else (0, 1, 0)
	turned = Quaternion(axis, math.radians(tilt))
	pieces = Floor(1, spacing, before=spacing + 1.5, after=2.5)
	scene = {'law': {}, 'stepFraction': 0.05, **scene}
	run = SurfaceScene(
		planarFloor(floor, body), body, contact or {}, perArea, pieces, at=(spacing + at, 0.13), tilt=turned, **scene
	).build()
	state, period = run.moving.state, math.sqrt(run.mass / run.stiffness)
	run.newton.gravity = (0, 0, 0)
	O.dt = 0.02 * period
	state.pos += run.turn * Vector3(*((run.depth + 2 * speed * O.dt) * run.up))
	state.vel = run.turn * Vector3(*(-speed * run.up))
	run.advance(4 * period)
	for _ in range(50):
		run.advance(period)
		if not run.touching and run.velocity[2] > 0:
			break
	length = max(run.lying.front, run.lying.back)
	v = run.velocity
	return Drop(
		sideways=float(np.hypot(v[0], v[1]) / speed),
		rebound=float(v[2] / speed),
		spin=float(np.abs(run.spin).max() * length / speed),
		energy=float(kineticEnergy() / (0.5 * run.mass * speed**2)),
	)


def roll(
	floor='plates',
	body='dodecahedron',
	contact=None,
	perArea=False,
	incline=40.0,
	friction=0.9,
	time=1.0,
	seams=10,
	spacing=0.3,
	**scene,
):
	"""A body rolls down an incline: ways along it at tenths of the time [m], its spin damped by its impacts alone.

	Compare floors with each other: there is no closed form.
	"""
	pieces = Floor(seams, spacing, before=3, after=4)
	law = {'normalDamping': 0.5, 'shearDamping': 0.3}
	run = (
		SurfaceScene(
			planarFloor(floor, body),
			body,
			contact or {},
			perArea,
			pieces,
			at=(0.0, 0.13),
			friction=friction,
			incline=math.radians(incline),
			law=law,
			**scene,
		)
		.build()
		.settle()
	)
	start, ways = run.position[0], []
	for _ in range(10):
		run.advance(time / 10)
		ways.append(float(run.position[0] - start))
	return ways
