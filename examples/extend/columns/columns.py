# SPDX-License-Identifier: GPL-2.0-or-later
"""A builder of one's own, in Python: column pieces as of basalt, prisms over a regular polygon, which roundedPolytope rounds where it is loaded.

yade -n -x columns.py [roundedPolytope.so]
"""

import math
import sys

import yade
from yade import O, RockJointMat, Vector3, polytope

__all__ = ['column']


def column(radius, height, sides=6, rounding=0, **body):
	"""A prism over a regular polygon, upright, with its edges rounded.

	:param float radius: of the circle through the corners of the whole, without rounding [m]
	:param float height: of the whole [m]
	:param int sides: of the polygon
	:param float rounding: radius of the edges [m]; above 0 it needs the extension roundedPolytope
	:param body: as of all bodies: center, orientation, material, fixed …
	:raises ValueError: naming *rounding* where it leaves nothing of the prism, or the extension is not loaded
	"""
	reach = radius * math.cos(math.pi / sides)  # from the axis to a side
	if not 0 <= rounding < min(reach, height / 2):
		raise ValueError(f'rounding: must be at least 0 and below {min(reach, height / 2)}, half the width of the column, got {rounding}')
	if rounding > 0 and not hasattr(yade, 'RoundedPolytope'):
		raise ValueError('rounding: needs the extension roundedPolytope: polytope.load(path) first')
	within, half = radius * (1 - rounding / reach), height / 2 - rounding  # of the planes: the ball adds the rest
	angles = [2 * math.pi * k / sides for k in range(sides)]
	made = polytope.fromVertices([(within * math.cos(a), within * math.sin(a), z) for a in angles for z in (-half, half)], **body)
	return polytope.withShape(made, yade.RoundedPolytope(radius=rounding)) if rounding > 0 else made


def main(extension=None):
	O.materials.append(RockJointMat(density=2900, frictionAngle=0.6))
	rounding = 0.05 if extension and polytope.load(extension) else 0
	for k in range(3):
		O.bodies.append(column(radius=0.5, height=1, rounding=rounding, center=Vector3(0, 0, 0.5 + k)))
	print('columns of', [round(float(body.state.mass), 3) for body in O.bodies], 'kg')


if __name__ == '__main__':
	main(*sys.argv[1:2])
