# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies of classes that extensions derive from Polytope."""

from yade import Body, Polytope, _polytope

from .polytopes import isotropyTolerance

__all__ = ['withShape']


def withShape(body, shape):
	"""Give a body a shape of a class that an extension derives from Polytope.

	``polytope.withShape(polytope.cuboid(…), RoundedPolytope(radius=0.1))``. The planes are the body's own. Mass, centroid and principal axes become
	those of the new shape, with its margin (docs/extending.md); nothing of it moves.

	:param Body body: one that the functions of this module have made, before it goes into O.bodies
	:param Polytope shape: of such a class, without planes
	:returns: the body
	:raises ValueError: naming *body*: one in a scene, no Polytope, a polygon where the shape has a margin; or *shape*: no class derived from
	    Polytope, one that has planes, one whose margin is not known, negative or infinite
	"""
	if not isinstance(body, Body) or type(body.shape) is not Polytope or not len(body.shape.offsets):
		raise ValueError(f'body: must be one with a Polytope shape, as polytope.cuboid(…) makes it, got {body!r}')
	if body.id is not None and body.id >= 0:
		raise ValueError('body: is in a scene already; give it the shape before O.bodies.append(…)')
	if not isinstance(shape, Polytope) or type(shape) is Polytope or len(shape.offsets):
		raise ValueError(f'shape: must be of a class derived from Polytope, without planes, got {shape!r}')
	_polytope.reshape(body, shape, isotropyTolerance)
	return body
