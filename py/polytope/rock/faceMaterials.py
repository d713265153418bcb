# SPDX-License-Identifier: GPL-2.0-or-later
"""Materials of a block's faces by the joints that made them."""

import math
from collections.abc import Iterable

from yade import O, RockJointMat, _polytope

from ..arguments import materialOf
from ..bodies.halfSpaces import worldPlanes

__all__ = ['faceMaterials', 'facesThatCount', 'facing', 'materialOfPlane', 'materialsOf', 'materialsOfContact', 'materialsOfFaces']


def materialsOfFaces(given, entries, own):
	"""Index in O.materials for each of the joint sets, -1: the body's own.

	:param own: the bodies' material, as builders take it
	"""
	if isinstance(given, str) or not isinstance(given, Iterable) or len(given := list(given)) != entries:
		raise ValueError(f'jointMaterials: must be a sequence with a material, or None, for each of the {entries} jointSets, got {given!r}')
	own = materialOf(own)
	chosen = []
	for number, material in enumerate(given):
		if material is None:
			chosen.append(-1)
			continue
		try:
			material = materialOf(material)
		except (TypeError, ValueError) as error:
			raise ValueError(f'jointMaterials[{number}]: {error}') from None
		if not isinstance(material, RockJointMat):
			raise ValueError(f'jointMaterials[{number}]: must be a RockJointMat, got {type(material).__name__}')
		for name in ('normalStiffness', 'shearStiffness'):
			if getattr(material, name) > getattr(own, name, 0):
				raise ValueError(
					f'jointMaterials[{number}]: its {name} is above that of the bodies\' own material, {getattr(own, name, 0):g}, by which the time step is chosen '
					'before blocks touch; give the bodies a RockJointMat that is at least as stiff'
				)
		chosen.append(_index(material))
	return chosen


def _index(material):
	"""Index of the material in O.materials, to which it is appended if it is not there."""
	listed = 0 <= material.id < len(O.materials) and O.materials[material.id] is material
	return material.id if listed else O.materials.append(material)


def faceMaterials(joints, sets, chosen):
	"""For each plane of a body's shape the material of the joint that made it.

	:param joints: for each plane the number of its joint, -1: none
	:param sets: for each joint the number of its set
	"""
	return [int(chosen[sets[joint]]) if joint >= 0 else -1 for joint in joints]


def materialOfPlane(body, plane):
	"""Material of the body's plane of this index, if the plane has one of its own (*Polytope.faceMaterials*); else, and for −1, that of the body."""
	own = getattr(body.shape, 'faceMaterials', [])
	return O.materials[own[plane]] if 0 <= plane < len(own) and own[plane] >= 0 else body.material


def facing(normals, along):
	"""(index, cosine of the angle) of that one of these unit normals (n, 3) which looks most along another."""
	cosines = normals @ along
	best = int(cosines.argmax())
	return best, float(cosines[best])


def facesThatCount(cosine1, cosine2):
	"""Whether the faces of body 1 and of body 2 count in a contact, by the cosines of their angles with it: both where both lie on it
	(src/bond/BondTolerances.hpp), else the closer one, as the physics of rock joints has it
	(Ip2_RockJointMat_RockJointMat_RockJointPhys)."""
	if min(cosine1, cosine2) > math.cos(_polytope.facingOfJoints):
		return True, True
	return cosine1 >= cosine2, cosine1 < cosine2


def materialsOfContact(one, other, normal):
	"""Materials of the two sides of a contact of polytopes with this normal, out of the first one."""
	if not any(len(getattr(body.shape, 'faceMaterials', [])) for body in (one, other)):
		return [one.material, other.material]
	planes = [facing(worldPlanes(body)[0], side * normal) for body, side in ((one, 1), (other, -1))]
	own = [materialOfPlane(body, plane) for body, (plane, _) in zip((one, other), planes, strict=True)]
	return [own[k] if counts else own[1 - k] for k, counts in enumerate(facesThatCount(*(cosine for _, cosine in planes)))]


def materialsOf(body):
	"""All that contacts of the body may have, each once: the body's own, where a face has none, and those of faces."""
	own = list(getattr(body.shape, 'faceMaterials', []))
	named = [O.materials[k] for k in dict.fromkeys(own) if k >= 0]
	return named if own and min(own) >= 0 else [body.material, *named]
