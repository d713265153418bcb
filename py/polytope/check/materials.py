# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of which material bodies have, of polytope.check(). Each yields (what, seen, advice)."""

import math

from yade import RockJointMat, RockJointPhys, _polytope

from ..scene.present import isPerArea, jointMakers

__all__ = ['changedMaterials', 'defaultMaterial', 'nameOfDefault']

nameOfDefault = 'defaultMat'
"""Label of the material that YADE gives to bodies made before O.materials has any (yade.utils.defaultMaterial)."""


def defaultMaterial(scene):
	"""Bodies made before the material that was meant for them: YADE gave them its own, of another density and friction."""
	having = [body for body in scene.bodies if body.material]
	default = [body for body in having if body.material.label == nameOfDefault and not isinstance(body.material, RockJointMat)]
	if not default:
		return
	material = default[0].material
	used = {body.material.id for body in having}
	# their numbers alone: reading O.materials ends the process where a material was added twice
	unused = [k for k in range(len(scene.O.materials)) if k not in used]
	beside = next((body for body in having if isinstance(body.material, RockJointMat)), None)
	if not unused and not beside:
		return
	bodies = f'{len(default)} bodies (body {default[0].id} first) have' if len(default) > 1 else f'body {default[0].id} has'
	why = f'body {beside.id} has a RockJointMat' if beside else f'no body has O.materials[{unused[0]}]'
	seen = f"{bodies} YADE's default {type(material).__name__} (density {float(material.density):g} kg/m³, friction angle {float(material.frictionAngle):g}), and {why}"
	yield (
		'default material',
		seen,
		'make the material first, O.materials.append(RockJointMat(…)), and bodies after it; or give them material=…',
	)


def changedMaterials(scene):
	"""Contacts take their values from the materials when they are made: what is changed later holds for new contacts alone."""
	makers = jointMakers(scene.loops)
	if len(makers) != 1 or makers[0].kn or makers[0].ks or makers[0].frictAngle:
		return
	for contact in scene.O.interactions:
		one, other = (scene.O.bodies[k] for k in (contact.id1, contact.id2))
		if not contact.isReal or not isinstance(contact.phys, RockJointPhys) or contact.phys.bond or _ofFaces(one) or _ofFaces(other):
			continue
		wrong = next(_differences(contact.phys, (one.material, other.material), makers), None)
		if wrong:
			seen = f'the contact of body {contact.id1} and body {contact.id2} has another {wrong} than its materials, which were changed after it was made'
			advice = 'O.interactions.clear() makes all contacts anew, without their shear forces; or set what changed in contact.phys, too (friction: polytope.frictionReduction.setFrictionAngle)'
			yield 'material', seen, advice
			return


def _ofFaces(body):
	return len(getattr(body.shape, 'faceMaterials', ())) > 0


def _differences(phys, materials, makers):
	"""What is not the same in a contact and its materials; of values that the law changes itself, none."""
	if not all(isinstance(material, RockJointMat) for material in materials):
		yield 'kind of joint'
		return
	ofMaterials = {isPerArea(material, makers) for material in materials}
	ofContact = {True: phys.normalStiffness > 0, False: phys.normalStiffnessPerContact > 0}  # none: spheres
	if len(ofMaterials) == 1 and any(ofContact.values()):
		perArea = ofMaterials.pop()
		if not ofContact[perArea]:
			yield f"unit of its stiffness ({'N/m' if perArea else 'Pa/m'})"
		for name in ('normalStiffness', 'shearStiffness') if ofContact[perArea] else ():
			values = [getattr(material, name) for material in materials]
			yield from _unlike(name, getattr(phys, name if perArea else name + 'PerContact'), _polytope.stiffnessInSeries(*values))
	if any(material.strength for material in materials):
		return
	if phys.intact or phys.tangensOfResidualFrictionAngle < 0:
		angle = min(float(material.frictionAngle) for material in materials)
		yield from _unlike('coefficient of friction', phys.tangensOfFrictionAngle, math.tan(angle))
	for name in ('cohesion', 'tensileStrength') if phys.intact else ():
		yield from _unlike(name, getattr(phys, name), min(getattr(material, name) for material in materials))


def _unlike(name, present, expected):
	if not math.isclose(float(present), float(expected), rel_tol=1e-9, abs_tol=1e-12):
		yield f'{name} ({float(present):.6g}, not {float(expected):.6g})'
