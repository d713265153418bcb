# SPDX-License-Identifier: GPL-2.0-or-later
"""Two of the checks of polytope.requirements(), of the size of overlaps: against corner radius and Newton tolerance. See checks."""

import math

import numpy as np
from yade import Polytope, _polytope

__all__ = ['cornerRadius', 'newtonTolerance']

deepest = 0.5
"""Overlap over corner radius from which on the radius is too small: a contact point lies up to half the overlap's depth in each body,
and the next impact may be twice as deep."""
deeper = ('normalFromOneBody', 'normalFromDual')
"""Outcomes of a query whose point lies deeper than the corner radius."""
roomiest = 200
"""Corner radius over the overlap of an impact (see _ofABlow) up to which it is small enough."""
wideEnough = 10
"""Times the deepest overlap: the corner radius that is advised."""
inside = 0.9
"""Largest corner radius that is advised, over the inscribed radius that it must stay below."""
muchFiner = 10
"""Times by which the Newton tolerance is finer than rounding, from which on it is reported."""
kernel = _polytope.tolerances()
"""Of the numerical core: *rounding* of a coordinate of 1, *depth* over the size, kept whatever newtonTolerance says, *coarsestNewton*."""


def cornerRadius(scene):
	"""corner radius"""
	if 'boon2012' not in scene.values('contactModel'):
		return 'a contact surface has none'
	since, pairs = scene.count(*deeper), scene.pairs()
	if not (scene.depths and pairs):
		before = f'; {since} contact points were deeper than it since the start (or resetStats), by an unknown amount' if since else ''
		return f'{scene.withoutDepths()}{before}'
	shapes = [scene.O.bodies[k].shape for pair in pairs for k in pair]
	lost = sum(contact.geom.status in deeper for contact in scene.contacts)
	depth, blow = max(scene.depths), _ofABlow(scene)
	radius, room = (min(float(getattr(shape, name)) for shape in shapes) for name in ('cornerRadius', 'inscribedRadius'))
	ratio = depth / radius if radius > 0 else math.inf
	seen = f'now the deepest overlap is {depth:.3g} m, the smallest corner radius {radius:.3g} m; {lost} contact points lie deeper than it'
	seen += f', {since} since the start (or resetStats)' if since else ''
	if lost or since or ratio > deepest:
		why = 'a point deeper than the radius gets no gradient' if lost or since else 'the next impact may give deeper points, without gradient'
		wanted = wideEnough * depth
		if not lost and ratio <= deepest:  # it was deeper before, by an unknown amount
			wanted = max(wanted, 2 * radius, 2 * blow)
		if wanted <= inside * room:
			return seen, f'cornerRadius at least {wanted:.2g} m, or stiffer contacts: {why}'
		largest = f', and cornerRadius up to {inside * room:.2g} m (it must stay below the inscribed radius, {room:.3g} m)'
		return seen, f'stiffer contacts{largest if inside * room > radius else ""}: {why}'
	if max(depth, blow) * roomiest < radius:
		seen += f'; a fall from the bodies\' own height makes {blow:.2g} m'
		smaller = f'cornerRadius {wideEnough * max(depth, blow):.2g} m would do'
		return seen, f'{smaller}, unless harder impacts come; larger ones round corners more than necessary'
	return seen, ''


def _ofABlow(scene):
	"""Overlap that a moving body makes with its present speed, or when it falls from its own height: v √(m/kₙ) [m].

	The present state alone is not enough: at rest, overlaps are a hundredth of those of the fall before."""
	gravity = np.linalg.norm(np.array(scene.newton.gravity, float)) if scene.newton else 0
	most = 0
	for contact in scene.contacts:
		for body in (scene.O.bodies[contact.id1], scene.O.bodies[contact.id2]):
			if body.dynamic and isinstance(body.shape, Polytope) and contact.phys.kn > 0:
				speed = float(body.state.vel.squaredNorm()) + 4 * gravity * float(body.shape.inscribedRadius)
				most = max(most, math.sqrt(speed * float(body.state.mass) / float(contact.phys.kn)))
	return most


def newtonTolerance(scene):
	"""Newton tolerance"""
	thin = [-float(contact.geom.infeasibility) for contact in scene.contacts if contact.geom.infeasibility < 0]
	if scene.values('contactModel') != ['boon2012'] or scene.values('contactPoint') != ['analyticCentre']:
		return 'checked for the analytic centre alone'
	if 'newton' not in scene.values('solver'):
		return "it is Newton's, and Ipopt solves for the centre"
	if not thin:
		return 'no polytopes overlap now'
	far = max(max(abs(float(x)) for x in body.state.pos) for body in scene.bodies)
	overlap = float(np.median(thin))
	rounding, kept = kernel['rounding'] * far / overlap, kernel['depth'] * scene.size() / overlap
	tolerance = float(min(scene.values('newtonTolerance')))
	seen = f'{tolerance:.1g}, and {kept:.1g} that the depth needs; positions are rounded by {rounding:.1g} of the overlaps (median)'
	coarsest, tells = min(rounding, kept, kernel['coarsestNewton']), rounding > muchFiner * tolerance and far > 1e3 * scene.size()
	advice = ['move the scene nearer to the origin: the centre is computed more accurately than positions are stored'] if tells else []
	if tolerance < coarsest / muchFiner:
		advice.append(f'newtonTolerance finer than {coarsest:.0g} gains no digit here')
	return seen, '; '.join(advice), None, ('newtonTolerance', coarsest) if tolerance < coarsest / muchFiner else None
