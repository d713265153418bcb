# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of materials and bodies, of polytope.check(): mass, size, stiffness against load. Each yields (what, seen, advice)."""

import math

import numpy as np
from yade import FrictMat, Ip2_RockJointMat_RockJointMat_RockJointPhys, Polytope, RockJointMat

from ..bonding import bonds

__all__ = ['bodyFindings', 'notNumbers']

largest = 50.0
"""Extent [m] above which a body that can move is taken for one in other units: a boulder of 50 m weighs 3e8 kg."""
unitsApart = 300.0
"""Extent over the median of the bodies that can move, above which units differ: millimetres and metres differ by 1000, grains
seldom by 100."""
softest = 0.1
"""Overlap over the inscribed radius, under a body's own weight or in its impact on one face, above which the contact gives way: overlaps of
some thousandths are usual, and forces are computed for small ones."""


def bodyFindings(scene):
	for one in (coincidence, density, mass, size, frictionAngle, tension, stiffness, elasticConstants):
		yield from one(scene)


def notNumbers(scene):
	"""Also of clumps, whose members follow them."""
	names = ('pos', 'ori', 'vel', 'angVel')
	for body in scene.O.bodies:
		lost = [name for name in names if body is not None and not _finite(getattr(body.state, name))]
		if lost:
			seen = f'body {body.id}: {" and ".join(f"state.{name}" for name in lost)} is not a finite number: no contact of it can be computed'
			yield 'not a number', seen, 'give it finite values; in a run, go back to a saved state and take PolytopeTimeStepper()'
			return


def _finite(several):
	return all(math.isfinite(several[k]) for k in range(len(several)))


def coincidence(scene):
	"""Polytopes of one shape in one place: the overlap is the whole body, and nothing says which way they are to part."""
	there = {}
	for body in scene.bodies:
		if isinstance(body.shape, Polytope):
			planes = sorted(float(offset) for offset in body.shape.offsets)
			where = (*map(float, body.state.pos), float(body.shape.volume), *planes)
			other = there.setdefault(where, body)
			sameClump = body.isClumpMember and other.isClumpMember and body.clumpId == other.clumpId
			if other is not body and other.mask & body.mask and not sameClump:
				seen = f'body {other.id} and body {body.id} have the same shape in the same place: they are shot apart, in any direction'
				yield 'same place', seen, 'move one of them, or O.bodies.erase() it if the same bodies were appended twice'
				return


def _number(several):
	return f'{len(several)} bodies (body {several[0].id} first)' if len(several) > 1 else f'body {several[0].id}'


def density(scene):
	for material in {id(body.material): body.material for body in scene.bodies if body.material and scene.moves(body)}.values():
		if not float(material.density) > 0:
			seen = f'density of {type(material).__name__} {material.label!r} is {float(material.density):g} kg/m³'
			yield 'density', seen, 'give the material a density above 0 before bodies are made of it: their mass follows from it'


def mass(scene):
	free = [body for body in scene.bodies if body.dynamic and not body.isClumpMember]
	light = [body for body in free if not 0 < float(body.state.mass) < math.inf]
	if light:
		seen = f'{_number(light)} can move and has mass {float(light[0].state.mass):g} kg: no force accelerates it'
		yield 'mass', seen, 'make it of a material with a density above 0, or hold it (fixed=True)'
	turning = [body for body in free if body not in light and _turns(body) and not min(map(float, body.state.inertia)) > 0]
	if turning:
		yield (
			'mass',
			f'{_number(turning)} can turn and has no inertia',
			'make it with the functions of polytope, which set it, or set body.state.inertia',
		)


def _turns(body):
	return isinstance(body.shape, Polytope) and body.shape.dimension == 3 and not set('XYZ') <= set(body.state.blockedDOFs)


def size(scene):
	extents = {body.id: _extent(body) for body in scene.bodies if isinstance(body.shape, Polytope) and scene.moves(body)}
	if not extents:
		return
	usual = float(np.median(list(extents.values())))
	for key, extent in extents.items():
		if extent > largest or extent > unitsApart * usual:
			seen = f'body {key} can move, is {extent:.3g} m across and weighs {float(scene.O.bodies[key].state.mass):.3g} kg'
			yield 'size', seen, 'if its mesh or dimensions are in millimetres: fromMesh(path, scale=0.001), other lengths over 1000'
			return


def _extent(body):
	corners = np.array(body.shape.vertices, float).reshape(-1, 3)[:, : body.shape.dimension]
	return float(np.ptp(corners, axis=0).max())


def frictionAngle(scene):
	"""RockJointMat refuses it itself."""
	for material in {id(body.material): body.material for body in scene.bodies if isinstance(body.material, FrictMat)}.values():
		angle = float(material.frictionAngle)
		if not angle < math.pi / 2:
			seen = f'frictionAngle of {type(material).__name__} {material.label!r} is {angle:g} rad, above π/2'
			yield 'friction angle', seen, f'angles are in radians: frictionAngle=radians({angle:g}), before bodies are made of it'
			return


def tension(scene):
	if bonds() and bonds().bonds:
		return
	for material in {id(body.material): body.material for body in scene.bodies if isinstance(body.material, RockJointMat)}.values():
		if material.tensileStrength > 0:
			seen = f'tensileStrength {float(material.tensileStrength):.3g} Pa of RockJointMat {material.label!r}: a joint pulls at one point and does not resist bending'
			yield 'tension', seen, 'polytope.bond() after O.engines is set: faces that touch then hold with the material\'s strength over their whole area'
			return


def stiffness(scene):
	"""A body on one of its faces, of the mean size of those of its volume, against another one of its material."""
	makers = [
		one for loop in scene.loops for one in loop.physDispatcher.functors if isinstance(one, Ip2_RockJointMat_RockJointMat_RockJointPhys)
	]
	if not makers or makers[0].kn:  # a MatchMaker: its values are not known here
		return
	deepest, worst = 0.0, None
	for body in scene.bodies:
		if isinstance(body.shape, Polytope) and isinstance(body.material, RockJointMat) and body.dynamic and not body.isClumpMember:
			share = _overlap(body, makers[0].stiffnessPerArea, scene.gravity())
			deepest, worst = max((deepest, worst), (share, body), key=lambda one: one[0])
	if deepest <= softest:
		return
	perArea = makers[0].stiffnessPerArea
	unit, other = ('Pa/m', 'N/m') if perArea else ('N/m', 'Pa/m')
	value = f'normalStiffness {float(worst.material.normalStiffness):.3g} {unit}'
	seen = f'{value}: body {worst.id} sinks in by {deepest:.2g} of its inscribed radius, by its weight or speed'
	advice = (
		f'a higher normalStiffness; if it is meant in {other}: Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea={not perArea})'
	)
	yield 'stiffness', seen, advice


def _overlap(body, perArea, gravity):
	"""Over its inscribed radius."""
	shape, weight = body.shape, float(body.state.mass)
	face = float(shape.volume) ** (2 / 3) if shape.dimension == 3 else math.sqrt(float(shape.volume * shape.thickness))
	k = float(body.material.normalStiffness) * (face if perArea else 1)
	return (
		max(weight * gravity / k, float(body.state.vel.norm()) * math.sqrt(weight / k)) / float(shape.inscribedRadius)
		if weight > 0
		else 0.0
	)


def elasticConstants(scene):
	"""young and poisson of a rock joint's material, where no functor reads them."""
	others = any(
		not isinstance(one, Ip2_RockJointMat_RockJointMat_RockJointPhys) for loop in scene.loops for one in loop.physDispatcher.functors
	)
	if others:
		return
	usual = RockJointMat()
	for material in {id(body.material): body.material for body in scene.bodies if isinstance(body.material, RockJointMat)}.values():
		given = [name for name in ('young', 'poisson') if getattr(material, name) != getattr(usual, name)]
		if given:
			seen = f'{" and ".join(given)} of RockJointMat {material.label!r} is set, and nothing reads it'
			yield (
				'elastic constants',
				seen,
				'set normalStiffness and shearStiffness; or take FrictMat with Ip2_FrictMat_FrictMat_FrictPhys()',
			)
			return
