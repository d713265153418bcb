# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of materials and bodies, of polytope.check(): mass, size, friction, attributes that nothing reads. Each yields (what, seen, advice)."""

import math

import numpy as np
from yade import Box, Facet, FrictMat, Ip2_RockJointMat_RockJointMat_RockJointPhys, Polytope, RockJointMat, Wall

from ..bodies.meshes.facets import haveAreas
from ..bonding.bonds import bonds
from ..rock.faceMaterials import materialsOf
from ..scene.movers import cannotTurn, isMover
from ..scene.present import isPerArea, jointMakers, jointMaterials
from ..scene.radii import outerRadius
from .about import extentOf, extentOfSupports
from .places import overlapShare

__all__ = ['bodyFindings']

largest = 50.0
"""Extent [m] above which a body that can move is taken for one in other units: a boulder of 50 m weighs 3e8 kg."""
earth = 9.7, 9.9
"""Gravity at its surface [m/s²]: lengths are in m, times in s, whatever the unit of mass."""
tonnes = 0.3, 30.0
"""Densities of what can be a body, in t/m³; less than that is no body's density in m and kg, g, lb or t."""
tooStiff = 1e-6
"""Overlap over the inscribed radius under a body's own weight below which its density is taken for one in other units than its stiffness: one of some
t/m³ beside N and m makes it a thousandth of what was meant."""
weakest = 10.0
"""Cohesion or tensile strength of a joint [Pa] below which it is taken for one in MPa: half a millimetre of rock weighs as much."""
weakestWall = 1e5
"""Compressive strength of a joint's wall [Pa] below which it is taken for one in MPa."""
unitsApart = 300.0
"""Extent over the median of the bodies that can move, above which units differ: millimetres and metres differ by 1000, grains
seldom by 100."""
turnedOnly = 1e-6
"""How far a quaternion's norm may be from 1: more stretches a body by more than contacts may be wrong."""


def bodyFindings(scene):
	for one in (
		density,
		mass,
		size,
		flatBoxes,
		flatFacets,
		orientation,
		frictionAngle,
		weakStrengths,
		dilation,
		tension,
		units,
		jointLaws,
		elasticConstants,
	):
		yield from one(scene)


def _materials(scene, kind):
	"""Materials of this class, of bodies and of their faces."""
	found = {id(material): material for body in scene.bodies for material in materialsOf(body)}
	return [material for material in found.values() if isinstance(material, kind)]


def _number(several):
	return f'{len(several)} bodies (body {several[0].id} first)' if len(several) > 1 else f'body {several[0].id}'


def density(scene):
	for material in {id(body.material): body.material for body in scene.bodies if body.material and scene.moves(body)}.values():
		if not float(material.density) > 0:
			seen = f'density of {type(material).__name__} {material.label!r} is {float(material.density):g} kg/m³'
			yield 'density', seen, 'give the material a density above 0 before bodies are made of it: their mass follows from it'
		elif earth[0] <= scene.gravity() <= earth[1] and float(material.density) < tonnes[1]:
			yield from _densityInOtherUnits(scene, material)


def _densityInOtherUnits(scene, material):
	"""Finds a density that is one in other units, in a scene in m and s."""
	density, gravity = float(material.density), scene.gravity()
	seen = f'density of {type(material).__name__} {material.label!r} is {density:g}, less than that of any rock in kg/m³'
	if density < tonnes[0]:
		yield (
			'density',
			f'{seen}, t/m³ or g/m³, with gravity {gravity:g}',
			'density in kg/m³: rock has 2600; with lengths in mm, gravity is 9810',
		)
		return
	bodies = [
		body
		for body in scene.bodies
		if body.material is material and isinstance(material, RockJointMat) and isinstance(body.shape, Polytope) and scene.moves(body)
	]
	makers = jointMakers(scene.loops)
	share = max((overlapShare(body, isPerArea(material, makers), gravity) for body in bodies if makers), default=1)
	if share < tooStiff:
		sinks = f'under their weight bodies of it sink in by {share:.1g} of their radius'
		yield (
			'density',
			f'{seen}; {sinks}',
			'density in kg/m³: rock has 2600; or, in t and m, stiffnesses in kN/m³, a thousandth of those in Pa/m',
		)


def mass(scene):
	light, heavy = [], []
	for body in scene.bodies:
		if isMover(body):
			(heavy if 0 < float(body.state.mass) < math.inf else light).append(body)
	if light:
		seen = f'{_number(light)} can move and has mass {float(light[0].state.mass):g} kg: no force accelerates it'
		flat = isinstance(light[0].shape, (Facet, Wall))
		yield (
			'mass',
			seen,
			'hold it (fixed=True): it has no volume' if flat else 'make it of a material with a density above 0, or hold it (fixed=True)',
		)
	turning = [body for body in heavy if _turns(body) and not min(map(float, body.state.inertia)) > 0]
	if turning:
		yield (
			'mass',
			f'{_number(turning)} can turn and has no inertia',
			'make it with the functions of polytope, which set it, or set body.state.inertia',
		)


def _turns(body):
	return isinstance(body.shape, Polytope) and body.shape.dimension == 3 and not cannotTurn(body)


def size(scene):
	widths = {body.id: 2 * outerRadius(body.shape) for body in scene.bodies if isinstance(body.shape, Polytope) and scene.moves(body)}
	if not widths:
		return
	usual = float(np.median(list(widths.values())))
	# one that is no larger than what is fixed belongs to a scene of that size, as a wedge in a slope does
	limit = max(largest, extentOfSupports(scene)) if scene.inMetres() else math.inf
	large = [
		scene.O.bodies[key]
		for key, width in widths.items()
		if width > unitsApart * usual or (width > limit and extentOf(scene.O.bodies[key]) > limit)
	]
	if large:
		extent, mass = extentOf(large[0]), float(large[0].state.mass)
		seen = f'{_number(large)} can move, is {extent:.3g} m across and weighs {mass:.3g} kg'
		yield 'size', seen, 'if its mesh or dimensions are in millimetres: fromMesh(path, scale=0.001), other lengths over 1000'


def flatBoxes(scene):
	flat = [body for body in scene.bodies if isinstance(body.shape, Box) and not min(map(float, body.shape.extents)) > 0]
	if flat:
		seen = f'{_number(flat)} is a Box with extents {tuple(map(float, flat[0].shape.extents))}: without a thickness nothing rests on it'
		yield 'size', seen, 'give it a thickness, or take a Wall or Facets'


def flatFacets(scene):
	facets = [body for body in scene.bodies if isinstance(body.shape, Facet)]
	corners = np.array([[list(map(float, corner)) for corner in body.shape.vertices] for body in facets]).reshape(-1, 3, 3)
	flat = [facets[k] for k in np.flatnonzero(~haveAreas(corners))]
	if flat:
		seen = f'{_number(flat)} is a Facet with corners on one line: its contacts have no normal, and are counted as failures'
		yield 'size', seen, 'leave it out, as polytope.facets does, or correct its corners'


def orientation(scene):
	wrong = [body for body in scene.bodies if body.shape and abs(float(body.state.ori.norm()) - 1) > turnedOnly]
	if wrong:
		seen = f'{_number(wrong)} has an orientation that is no unit quaternion (norm {float(wrong[0].state.ori.norm()):.3g}): it stretches the body'
		yield (
			'orientation',
			seen,
			'body.state.ori = body.state.ori.normalized(); Quaternion(axis, angle) and polytope.cuboid(…, orientation=…) have norm 1',
		)


def frictionAngle(scene):
	"""RockJointMat refuses it itself."""
	for material in _materials(scene, FrictMat):
		angle = float(material.frictionAngle)
		if not angle < math.pi / 2:
			seen = f'frictionAngle of {type(material).__name__} {material.label!r} is {angle:g} rad, above π/2'
			yield 'friction angle', seen, f'angles are in radians: frictionAngle=radians({angle:g}), before bodies are made of it'


def weakStrengths(scene):
	"""What is too little to matter in Pa is a strength in MPa."""
	if not scene.inMetres():
		return
	for material in _materials(scene, RockJointMat):
		for name in ('cohesion', 'tensileStrength'):
			value = float(getattr(material, name))
			if 0 < value < weakest and isPerArea(material, jointMakers(scene.loops)):
				yield (
					'joint strength',
					f'{name} of RockJointMat {material.label!r} is {value:g} Pa, the weight of {value / 2e4:.1g} m of rock',
					f'give it in Pa: {value:g} MPa are {1e6 * value:g}',
				)


def dilation(scene):
	for material in _materials(scene, RockJointMat):
		if float(material.dilationAngle) > float(material.frictionAngle):
			angles = f'dilationAngle {math.degrees(material.dilationAngle):.3g}° of RockJointMat {material.label!r} is above its frictionAngle {math.degrees(material.frictionAngle):.3g}°'
			yield (
				'dilation',
				f'{angles}: slip would do more work against pressure than friction takes',
				'a dilationAngle of at most the frictionAngle, which has the dilation in it',
			)


def tension(scene):
	"""With a stiffness per area such a joint is a bond of its faces."""
	if bonds() and bonds().bonds:
		return
	makers = jointMakers(scene.loops)
	for material in _materials(scene, RockJointMat):
		if material.tensileStrength > 0 and not isPerArea(material, makers):
			seen = f'tensileStrength {float(material.tensileStrength):.3g} Pa of RockJointMat {material.label!r}: a joint with a stiffness per contact pulls at one point and does not resist bending'
			yield 'tension', seen, 'stiffnessPerArea=True, or polytope.bond() after O.engines is set: faces then hold over their whole area'


def units(scene):
	"""Joints of two materials whose stiffnesses are in different units."""
	used, makers = jointMaterials(scene.bodies), jointMakers(scene.loops)
	perArea = [material for material in used if isPerArea(material, makers)]
	perContact = [material for material in used if not isPerArea(material, makers)]
	if perArea and perContact:
		seen = f'stiffnesses of RockJointMat {perArea[0].label!r} are per area [Pa/m], of {perContact[0].label!r} per contact [N/m]'
		yield 'units', seen, 'a joint of both has the stiffness of the latter alone; give both in one unit (RockJointMat.stiffnessPerArea)'


def jointLaws(scene):
	"""Both materials of a joint must have a law for it to hold."""
	used = jointMaterials(scene.bodies)
	for material in used:
		wall = float(getattr(material.strength, 'JCS', weakestWall))
		if wall < weakestWall:
			yield (
				'joint laws',
				f'JCS of RockJointMat {material.label!r} is {wall:g} Pa: no rock is so weak, and its joints have no roughness',
				'give it in Pa: 60 MPa are 60e6',
			)
	for name in ('closure', 'strength'):
		# what is smooth is meant to be
		materials = [material for material in used if name == 'closure' or material.frictionAngle > 0]
		kinds = {type(getattr(material, name)).__name__ for material in materials}
		if len(kinds) > 1:
			without = next((material for material in materials if getattr(material, name) is None), None)
			seen = f'RockJointMats have different laws in {name}: {", ".join(sorted(kinds - {"NoneType"}))}'
			seen += f', and {without.label!r} has none' if without else ''
			usual = 'a linear spring' if name == 'closure' else 'Mohr-Coulomb with the smaller frictionAngle'
			yield (
				'joint laws',
				f'{seen}; a joint between two of them has {usual}',
				f'give both the same kind of law in {name}, if joints between them should have it',
			)


def elasticConstants(scene):
	"""young and poisson of a rock joint's material, where no functor reads them."""
	others = any(
		not isinstance(one, Ip2_RockJointMat_RockJointMat_RockJointPhys) for loop in scene.loops for one in loop.physDispatcher.functors
	)
	if others:
		return
	usual = RockJointMat()
	for material in _materials(scene, RockJointMat):
		given = [name for name in ('young', 'poisson') if getattr(material, name) != getattr(usual, name)]
		if given:
			seen = f'{" and ".join(given)} of RockJointMat {material.label!r} is set, and nothing reads it'
			yield (
				'elastic constants',
				seen,
				'set normalStiffness and shearStiffness; or take FrictMat with Ip2_FrictMat_FrictMat_FrictPhys()',
			)
