# SPDX-License-Identifier: GPL-2.0-or-later
"""What is wrong with a scene, each with the remedy, and what it pays for without using it: `polytope.check(O)`."""

from .about import aboutScene
from .bodies import bodyFindings
from .concaveClumps import concaveClumps
from .contacts import contactFindings
from .costs import costFindings, takeCosts
from .engines import engineFindings
from .extensions import derivedShapes, ownClosures
from .falling import falling
from .findings import Check, Finding
from .incomplete import incomplete
from .lostStrengths import hanging, lostStrengths
from .materials import changedMaterials, defaultMaterial
from .pairs import pairFindings
from .places import lostBodies, placeFindings
from .scene import SceneToCheck
from .softJoints import softJoints
from .steps import stepFindings

__all__ = ['Check', 'check', 'checkOf']


def check(O, costs=False):
	"""Checks the present scene for what is wrong. Most of it YADE would not tell.

	It looks at: bodies without a material or a shape, missing or misplaced engines, bounds, contact functors, physics and laws for shapes
	and materials that can meet, laws that apply forces as for spheres, margins with a stiffness per area, shapes of extensions without a
	margin or with one that is none, normal laws that do not fit together, contact models whose unit of stiffness is another, contacts
	without any damping whose model does not conserve energy, polygons that meet what they cannot touch, positions and velocities that are
	not numbers, polytopes in the same place or deep in each other, boxes without thickness, facets without an area, engines that are there
	twice, controllers for spheres only, YADE's density scaling, bodies that have YADE's default material in place of the scene's, contacts
	of a rock joint's material with one of YADE's own, contacts of materials that were changed since, bodies too large for a periodic cell,
	bonds whose engine is missing, numerical damping beside a moving base or a quiet boundary, water that acts too late, density, mass and
	size of bodies, friction angles in degrees, cohesion and tensile strength in MPa, dilation above friction, stiffnesses too low for the
	loads, joints so soft that a block topples a degree below its own angle, faces on several pieces with a stiffness for each contact,
	clumps that are not convex with such stiffnesses and without damping, gravity that begins at once on joints with a strength to lose,
	joints that lose their cohesion or tensile strength to the material on the other side, bodies that hang from what they only touch or
	that nothing fixed is below, engines that move bodies that are free or do not exist, attributes that nothing reads, contact queries
	that failed, the time step and its time steppers, bodies that move farther than their size in a step, turning boxes and facets that
	YADE's collider does not notice.

	It lists all that it finds, not the first only, and then says how many bodies can move, their sizes in m and masses in kg, the extent of
	what is fixed, and gravity: a stone of 40 m is no mistake that it can know of. Where a position or velocity is not a number, what rests
	on it (overlaps, time step) is not looked at.

	With *costs* it also finds what the scene pays for without using it: switches of the contact functors, energy tracking, a collider that
	runs too often or has boxes that are not tight, a third dimension that nothing moves in, a time step far below the limit. Ask for them when
	the bodies are in contact. The cost is measured on this very scene: it is saved to a file (O.save), which another process loads, and
	steps as it is and changed; engines that run periodically, as recorders and PyRunner, are left out there. Each change is timed with
	the advice above it in force, so that costs add up to what following all of it saves.

	It reads, and changes nothing: the scene is the same afterwards to the last bit. That nothing was found does not mean that the scene is
	what you meant. What PyRunner does is not seen.

	:param O: yade.O
	:param bool costs: True: look for what is not needed, too, and measure what it costs, which takes some seconds
	:returns: *Check*, a list of findings, empty where nothing is wrong: ``print(polytope.check(O))``
	:raises ValueError: naming *O* if it is not yade.O, or the simulation is running; naming *costs* if it is neither True nor False
	:raises OSError: naming *costs* if the scene cannot be saved to a temporary folder (TMPDIR)
	"""
	if not isinstance(costs, bool):
		raise ValueError(f'costs: must be True or False, got {costs!r}')
	found = checkOf(O, None)
	if costs:
		found += [Finding(*one) for one in costFindings(SceneToCheck(O))]
		takeCosts(O, found)
	return found


def checkOf(O, engines):
	"""Checks the scene as it would be with these engines; None: its own."""
	scene = SceneToCheck(O, engines)
	lacking = [Finding(*one) for one in incomplete(scene)]
	if lacking:
		return Check(lacking, '')
	lost = list(lostBodies(scene))
	found = [
		*lost,
		*engineFindings(scene),
		*pairFindings(scene),
		*defaultMaterial(scene),
		*changedMaterials(scene),
		*bodyFindings(scene),
		*derivedShapes(scene),
		*ownClosures(scene),
		*contactFindings(scene),
	]
	if not lost:
		places = list(placeFindings(scene))
		if not {'overlap', 'stiffness'} & {what for what, *_ in places}:  # with which no block stands as it is meant to
			places += softJoints(scene)
		found += [*places, *concaveClumps(scene), *lostStrengths(scene), *hanging(scene), *falling(scene), *stepFindings(scene)]
	findings = (Finding(*one) for one in dict.fromkeys(found))  # bodies of one material find the same
	return Check(findings, '' if engines or lost else aboutScene(scene))
