# SPDX-License-Identifier: GPL-2.0-or-later
"""What is wrong with a scene before its first step, each with the remedy: `polytope.check(O)`."""

from ..requirements import Finding
from .bodies import bodyFindings, movingBodies
from .engines import engineFindings
from .pairs import pairFindings
from .places import notNumbers, placeFindings
from .scene import SceneToCheck
from .softJoints import softJoints
from .steps import stepFindings

__all__ = ['Check', 'check', 'checkOf']


class Check(list):
	"""What polytope.check() returns: a list of findings (`what`, `seen`, `advice`), empty where nothing is wrong. Printing it shows all.

	:param str about: of the bodies, their sizes and masses: printed where nothing is wrong
	"""

	def __init__(self, findings=(), about=''):
		super().__init__(findings)
		self.about = about

	def __getitem__(self, what):
		"""The finding of that name, or of that place in the list."""
		if not isinstance(what, str):
			return super().__getitem__(what)
		for finding in self:
			if finding.what == what:
				return finding
		raise KeyError(f'{what!r} was not found; there are {[finding.what for finding in self]}')

	def __repr__(self):
		if not self:
			return '\n'.join(filter(None, ('nothing was found that is wrong', self.about)))
		return '\n'.join(f'{finding.what}: {finding.seen}\n\t{finding.advice}' for finding in self)


def check(O):
	"""Checks the present scene for what is wrong before the first step. Most of it YADE would not tell.

	It looks at: missing or misplaced engines, bounds, contact functors, physics and laws for shapes and materials that can meet, laws that
	apply forces as for spheres, functors of one loop that disagree in contactModel, contact models whose unit of stiffness is another, contacts of
	YADE's materials without any damping, polygons that meet what they cannot touch, positions and velocities that are not numbers, polytopes
	in the same place or deep in each other, boxes without thickness, engines that are there twice, controllers for spheres only, YADE's density scaling, bodies too large for a periodic cell,
	bonds whose engine is missing, numerical damping beside a moving base or a quiet boundary, water that acts too late, density, mass and size of bodies, friction angles in degrees, stiffnesses too low for the loads, joints so soft that a block topples a degree below its own angle, gravity that begins at once on joints with a strength to lose, attributes that nothing
	reads, the time step and its time steppers, bodies that move farther than their size in a step, turning boxes and facets that YADE's
	collider does not notice.

	It lists all that it finds, not the first only. Where it finds nothing it says how many bodies can move, their sizes in m and masses in kg: a stone of 40 m
	is no mistake that it can know of. Where a position or velocity is not a number, what rests on it (overlaps, time step) is not looked at.

	It reads, and changes nothing. What a scene in motion needs, and what it pays for without using it, tells polytope.requirements(O). That
	nothing was found does not mean that the scene is what you meant. What PyRunner does is not seen.

	:param O: yade.O
	:returns: *Check*, a list of findings, empty where nothing is wrong: ``print(polytope.check(O))``
	:raises ValueError: naming *O* if it is not yade.O, or the simulation is running
	"""
	return checkOf(O, None)


def checkOf(O, engines):
	"""The same of the scene with other engines; None: its own."""
	scene = SceneToCheck(O, engines)
	lost = list(notNumbers(scene))
	found = [*lost, *engineFindings(scene), *pairFindings(scene), *bodyFindings(scene)]
	if not lost:
		places = list(placeFindings(scene))
		if not {'overlap', 'stiffness'} & {what for what, *_ in places}:  # with which no block stands as it is meant to
			places += softJoints(scene)
		found += [*places, *stepFindings(scene)]
	findings = (Finding(*one) for one in dict.fromkeys(found))  # bodies of one material find the same
	return Check(findings, '' if engines else movingBodies(scene))
