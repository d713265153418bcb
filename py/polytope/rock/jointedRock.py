# SPDX-License-Identifier: GPL-2.0-or-later
"""A rock mass cut into blocks by joints.

Blocks are lists of half-spaces, so a joint cuts a block in two by being added to it once from either side (src/cutting/JointedBlocks.hpp; Boon,
Houlsby & Utili 2015, "A new rock slicing method based on linear programming", Computers and Geotechnics 65:12-29). Coordinates: x east, y
north, z up.
"""

import dataclasses
import itertools
import numbers
from collections.abc import Iterable

import numpy as np
from yade import O, _polytope

from ..arguments import namedArguments, warn
from ..bodies.clumps import rigid
from ..bodies.polytopes import fromHalfSpaces, randomColour
from ..precision import real
from ..scene.vertices import rows
from .faceMaterials import faceMaterials, materialsOfFaces
from .inPlane import asSegment, expectedInPlane, flatCut, flatSet, outlinesOf
from .joint import Joint, areasOf, asArguments, finite
from .jointedRegion import regionOf
from .jointSets import JointSet
from .jointsOfFaces import contactJoints, jointsOfFaces, jointsOfPlanes, keep, setsOf, writeFaces
from .seams import joinedAcrossSeams
from .termination import Earlier

__all__ = ['JointSet', 'JointedRock', 'jointedRock']

mostBlocks = 500000
"""Blocks: more are refused, since such a scene could not be run; a spacing in a wrong unit is more likely."""

smallestFraction = 0.01
"""Default inscribed radius of the smallest piece over the smallest spacing, or over the region's own inscribed radius if that is less: thinner
pieces need a shorter time step and carry no load."""

smallestBridge = 1e-3
"""Area over which rock goes on from one block to the next, over the smaller of the two faces, below which it is taken for broken: joints
of a file that were meant to end at each other miss by the last of its digits."""
named = 3
"""Joints that a message names."""


@dataclasses.dataclass(eq=False)
class JointedRock:
	"""What *jointedRock* made."""

	blocks: list
	"""(normals, offsets) of each convex block in world coordinates, for *fromHalfSpaces*, without redundant planes."""
	volumes: np.ndarray
	"""Volume of each block [m³]; they add up to the region's. In the plane areas [m²], and lengths [m] in place of *areas* and *sections*."""
	bodies: list
	"""For each rigid body the numbers of its blocks: one, or several where no joint separates them wholly (*incomplete*)."""
	joints: np.ndarray
	"""(n, 4) planes a·x = d of all joints that cut a block, unit normals."""
	faces: list
	"""For each block the joint (row of *joints*) that made each of its planes; −1: the region's own."""
	sets: np.ndarray
	"""For each joint which of the *jointSets* it comes from."""
	areas: np.ndarray
	"""Area of each joint [m²] inside the blocks that it cut."""
	sections: np.ndarray
	"""Area of these blocks' sections [m²]: larger than *areas* where a joint ends inside a block."""
	network: list
	"""For each joint its own extent (rock.joint.Cut): normal, centre, radius, edges."""
	uncut: int
	"""Cuts that were not made, as they would have left a piece below *smallest*."""
	entries: int
	"""Number of *jointSets*, a list of joints counted as many times as it has sets."""
	placed: dict = dataclasses.field(default_factory=dict, repr=False)
	"""By the number in O.bodies of each polytope that *append* or *split* made: the normals of its planes in its own axes, and the joint
	that made each."""

	def append(self, jointMaterials=None, **body):
		"""Adds the rock to the scene: a body for each of *bodies*, a clump where it has several blocks.

		Mass and inertia of a clump are the sums over its blocks, which do not overlap. There are no contacts between blocks of one clump.

		A material belongs to the faces that its joint has made: a contact that ends and is made again, with the same block or another, has
		that of the face which it lies on (Polytope.faceMaterials).

		:param jointMaterials: for each of *jointSets* (for each set of a list of joints) the RockJointMat of its joints, by index or label
		    in O.materials or itself; None among them: the body's own
		:param body: arguments of *fromHalfSpaces*: material, fixed, color …
		:returns: numbers in O.bodies, in the order of *bodies*: of the body, or of the clump
		:raises ValueError: naming *jointMaterials*: not one for each of *jointSets*, no RockJointMat, or stiffer than the body's own
		    material, which sets the time step before blocks touch
		"""
		chosen = None if jointMaterials is None else materialsOfFaces(jointMaterials, self.entries, body.get('material', -1))
		given = body.get('color')
		ids, joints, placed = [], {}, {}
		for parts in self.bodies:
			colour = randomColour() if given is None else given
			made = [fromHalfSpaces(*self.blocks[k], **{**body, 'color': colour}) for k in parts]
			for k, one in zip(parts, made, strict=True):
				joints[k] = jointsOfPlanes(one, self.blocks[k][0], self.faces[k])
				if chosen is not None:
					one.shape.faceMaterials = faceMaterials(joints[k], self.sets, chosen)
			ids.append(O.bodies.append(made[0]) if len(made) == 1 else rigid(made)[0])
			placed.update((one.id, (rows(one.shape.normals), joints[k])) for k, one in zip(parts, made, strict=True))
		keep(self, placed)
		return ids

	def jointsOfFaces(self, body):
		"""For each plane in the normals of the body's shape the number of the joint that made it; −1: the region's, or a body that is none
		of this rock's.

		After *append*; ``polytope.picture('joints.png', colorBy=rock.jointsOfFaces)`` colours faces by it. Faces that *polytope.split* makes
		have none, what it leaves of others keeps theirs.

		:param body: of O.bodies
		"""
		return jointsOfFaces(self, body)

	def setsOfFaces(self, body):
		"""For each plane in the normals of the body's shape the number of the set in *jointSets* whose joint made it; −1 where
		*jointsOfFaces* has −1."""
		return setsOf(self, jointsOfFaces(self, body))

	def contactJoints(self):
		"""For each row of ``polytope.arrays().contacts`` the number of the joint that the contact is on; −1: none.

		It is the joint that made the face which lies closest to the plane of the contact, of either body, as for materials of faces.
		"""
		return contactJoints(self)

	def contactSets(self):
		"""For each row of ``polytope.arrays().contacts`` the number of the set in *jointSets* whose joint the contact is on; −1: none."""
		return setsOf(self, contactJoints(self))

	def writeFaces(self, path):
		"""Writes the faces of all polytopes in the scene for ParaView, a polygon each, as they are now.

		Cell arrays: *id* of the body, *joint* and *set* that made the face (−1: none), *material* of the face, index in O.materials, and the
		body's *displacement* [m] and *velocity* [m/s]. Files that differ in a number before the end are a series in ParaView.

		:param str path: the file, .vtp; its folder is made if there is none
		:raises ValueError: naming *path* or what the scene lacks
		"""
		writeFaces(self, path)


@namedArguments
def jointedRock(normals, offsets, jointSets, smallest=None, seed=0, incomplete='clump'):
	"""Cut a region of rock into blocks by joints::

		slope = polytope.jointedRock(normals, offsets, [polytope.JointSet(radians(35), radians(90), spacing=2), …])
		slope.append(material=…)

	The blocks fill the region and touch without overlap, to the rounding of double (in YADE's wider precisions, too). Joints
	cut one after the other, set by set: where *smallest* or *persistence* keeps a cut from being made, the order matters.

	A joint that ends in the rock cuts the blocks that it reaches into along its whole plane. What it separates only in part is one body, by default:
	its blocks move together. Pieces that make one convex block are put together again.

	In the plane (*normals* of two components) x is horizontal and y up, blocks are polygons, and joints lines as the section shows them:
	*dip* is the apparent one, *dipDirection* π/2 (it falls towards x) or 3π/2, *spacing* and *p32* distance and length per area (P21),
	discs are segments of twice their *radius*, *fisher* the κ of von Mises' distribution, and z of points does not count.

	:param normals: (n, 3) outward normals of the region, of any length [-], in the plane (n, 2); for a region that is not convex a list of
	    those of convex parts, which may share faces and must not overlap
	:param offsets: n offsets, in units of the normals' length [m]: {x : normals[i]·x ≤ offsets[i] for all i}; for several parts a list of those
	:param jointSets: sequence of *JointSet*, *Joint*, and lists of *Joint*, as *readJoints* returns. A list counts as one set for each
	    value of *Joint.set* in it, numbers in ascending order and then names in alphabetical order: so many entries have *jointMaterials*,
	    *sets* and what *keyBlocks* takes by set
	:param float smallest: inscribed radius [m] below which no piece is cut off: the block stays whole there; default a hundredth
	    of the smallest spacing (1/P32) or of the region's own inscribed radius
	:param int seed: of the random places, radii and normals
	:param str incomplete: what becomes of blocks that a joint separates only in part: 'clump', they are one body; 'cut', each is a body, as if joints
	    went on to the faces of the blocks that they reach into (Boon et al. 2015). Either way rock goes on across the faces that parts of
	    the region share, except along a joint (with 'cut' along all of the plane of a joint)
	:returns: *JointedRock*; with a warning where none of the joints reaches into the region
	:raises ValueError: naming the argument: what *fromHalfSpaces* refuses of a region, no joint sets, more than 500 000
	    blocks, *smallest* negative or above the region's inscribed radius, *seed* negative
	"""
	entries = _entriesOf(jointSets)
	if isinstance(seed, bool) or not isinstance(seed, numbers.Integral) or not 0 <= seed < 2**63:
		raise ValueError(f'seed: must be a whole number from 0 on, got {seed!r}')
	if incomplete not in ('clump', 'cut'):
		raise ValueError(f"incomplete: must be 'clump' or 'cut', got {incomplete!r}")
	region = regionOf(normals, offsets)
	if region.thickness:
		_tellHeights(entries)
		entries = [flatSet(entry) if isinstance(entry, JointSet) else entry for entry in entries]
	sets = [entry for entry in entries if isinstance(entry, JointSet)]
	if smallest is None:
		smallest = smallestFraction * min([region.inscribedRadius, *(1 / joints.intensity for joints in sets)])
	if not finite(smallest) or not 0 <= smallest <= region.inscribedRadius:
		raise ValueError(
			f"smallest: must be from zero to the region's own inscribed radius, {region.inscribedRadius:.6g} m, got {smallest!r}: no piece has more"
		)
	through = [joints for joints in sets if joints.radius is None and joints.persistence == 1]
	expected = expectedInPlane(region.volume / region.thickness, through) if region.thickness else _expectedBlocks(region.volume, through)
	if expected > mostBlocks:
		raise ValueError(
			f'jointSets: about {expected:.2g} blocks are to be expected, at most {mostBlocks:.0g} can be; is a spacing in another unit?'
		)
	cuts = _cuts(entries, region, np.random.default_rng(seed))
	partial = len(region.parts) > 1 or any(cut.radius or len(cut.edges) for cut in cuts)
	bridge = smallestBridge if incomplete == 'clump' and partial else -1.0
	bounded = list(map(asSegment, cuts)) if region.thickness else cuts
	made = _polytope.jointedBlocks(region.parts, asArguments(bounded), real(smallest), real(bridge), mostBlocks, int(seed))
	bodies = np.frombuffer(made['bodies'], np.int32)
	if incomplete == 'cut' and len(region.parts) > 1:
		bodies = joinedAcrossSeams(made, bodies, cuts, region, smallestBridge)
	rock = _rock(made, bodies, cuts, region.centre, sum(map(len, map(_setsOf, entries))))
	if region.thickness:
		outlinesOf(rock, region.thickness)
	if not sets and not len(rock.joints) and not rock.uncut and len(region.parts) == 1:  # a joint along the face of two parts cuts neither
		place = ', '.join(f'{round(float(x), 6) + 0.0:g}' for x in region.centre)
		warn(
			f'jointSets: no joint reaches into the region, whose centre is ({place}); are their places in other units or axes (x east, y north, z up)?'
		)
	elif any(not isinstance(entry, JointSet) for entry in entries):
		_tellOutside(entries, region)
	return rock


def _setsOf(entry):
	"""Values of *Joint.set* in a list of joints; of all else one."""
	if not isinstance(entry, (list, tuple)):
		return [None]
	return sorted({joint.set for joint in entry}, key=lambda name: (isinstance(name, str), name)) or [None]


def _singleJoints(entries):
	return [
		joint for entry in entries if not isinstance(entry, JointSet) for joint in (entry if isinstance(entry, (list, tuple)) else [entry])
	]


def _tellHeights(entries):
	"""Joints of a survey in space have their height as z, which is y in the plane."""
	through = [
		entry.through
		for entry in entries
		if isinstance(entry, JointSet) and entry.through is not None and len(entry.through) == 3 and entry.through[2] != 0
	]
	if through:
		warn(
			f'jointSets: {len(through)} sets have a z, the first through={through[0]}, which does not count in the plane, where y is up; of a survey in space take through=(x, z)'
		)
	high = [joint for joint in _singleJoints(entries) if len(joint.centre) == 3 and joint.centre[2] != 0]
	if high:
		warn(
			f'jointSets: {len(high)} joints have a z, the first {high[0].centre}, which does not count in the plane, where y is up; of a survey in space take centre=(x, z)'
		)


def _tellOutside(entries, region):
	given = _singleJoints(entries)
	areas = areasOf([_cutOf(joint, region, bounded=True) for joint in given], region.parts)
	outside = [(number, joint) for number, joint in enumerate(given) if not areas[number] > 0]
	if outside:
		ones = ', '.join(f'{number} at ({", ".join(f"{x:g}" for x in joint.centre)})' for number, joint in outside[:named])
		warn(
			f'jointSets: {len(outside)} of {len(given)} joints lie wholly outside the region, and cut nothing: {ones}{", …" if len(outside) > named else ""} (counted from 0)'
		)


def _entriesOf(jointSets):
	entries = list(jointSets) if isinstance(jointSets, Iterable) else []
	lists = [entry if isinstance(entry, (list, tuple)) else [entry] for entry in entries if not isinstance(entry, JointSet)]
	if not entries or not all(isinstance(joint, Joint) for joints in lists for joint in joints):
		raise ValueError('jointSets: must be a sequence of one or more JointSet or Joint, or of lists of Joint')
	return entries


def _cuts(entries, region, random):
	"""All joints in the order in which they cut, about the region's centre."""
	cuts = []
	number = 0
	for entry in entries:
		sets = _setsOf(entry)
		if isinstance(entry, JointSet):
			cuts += entry.cuts(region, Earlier(cuts), number, random)
		else:
			for joint in entry if isinstance(entry, (list, tuple)) else [entry]:
				place = sets.index(joint.set) if isinstance(entry, (list, tuple)) else 0
				cuts.append(dataclasses.replace(_cutOf(joint, region), entry=number + place))
		number += len(sets)
	return cuts


def _cutOf(joint, region, bounded=False):
	"""A single joint about the region's centre; *bounded*: as it bounds blocks."""
	if not region.thickness:
		return joint.cut.moved(-region.centre)
	cut = flatCut(joint).moved(-region.centre)
	return asSegment(cut) if bounded else cut


def _rock(made, bodyOf, cuts, centre, entries):
	"""The result in world coordinates, with the joints that have cut."""
	planes = np.frombuffer(made['planes']).reshape(-1, 4)
	normals, offsets = planes[:, :3].copy(), planes[:, 3] + planes[:, :3] @ centre
	areas, sections = np.frombuffer(made['areas']), np.frombuffer(made['sections'])
	cutting = np.flatnonzero(sections > 0)
	row = np.full(len(cuts) + 1, -1)  # the last one is the region's own, −1
	row[cutting] = np.arange(len(cutting))
	labels = row[np.frombuffer(made['labels'], np.int32)]
	ends = np.cumsum(np.frombuffer(made['counts'], np.int32))
	slices = [slice(begin, end) for begin, end in zip([0, *ends[:-1]], ends, strict=True)]
	bodies = [[] for _ in range(max(bodyOf) + 1)]
	for block, body in enumerate(bodyOf.tolist()):
		bodies[body].append(block)
	return JointedRock(
		[(normals[one], offsets[one]) for one in slices],
		np.frombuffer(made['volumes']).copy(),
		bodies,
		np.array([[*cuts[j].normal, cuts[j].offset + cuts[j].normal @ centre] for j in cutting]).reshape(-1, 4),
		[labels[one] for one in slices],
		np.array([cuts[j].entry for j in cutting], int),
		areas[cutting],
		sections[cutting],
		[cuts[j].moved(centre) for j in cutting],
		made['uncut'],
		entries,
	)


def _expectedBlocks(volume, jointSets):
	"""Number of blocks: as many as there are points in which three joints meet within the region, lines on its surface in which two
	do, and so on."""
	length, scaled = volume ** (1 / 3), [joints.normal * joints.intensity for joints in jointSets]
	planes = sum(np.linalg.norm(a) for a in scaled)
	lines = sum(np.linalg.norm(np.cross(a, b)) for a, b in itertools.combinations(scaled, 2))
	points = sum(abs(np.linalg.det(three)) for three in itertools.combinations(scaled, 3))
	return 1 + planes * length + lines * length**2 + points * volume
