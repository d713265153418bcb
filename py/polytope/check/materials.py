# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of which material bodies have, of polytope.check(). Each yields (what, seen, advice)."""

from yade import RockJointMat

__all__ = ['defaultMaterial']

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
