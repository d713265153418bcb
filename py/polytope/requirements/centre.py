# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of the contact point and of its solver, of polytope.requirements().

The two belong together: only the analytic centre of the paper's contact (boon2012) needs a solver.
"""

__all__ = ['contactPoint', 'solver']

newtonAdvice = "solver = 'newton': agrees with it to 1e-8 of the overlap; Ipopt is used where it does not converge"


def solver(scene):
	"""solver"""
	inUse = {functor.solver for functor in scene.functors if _solves(functor)}
	if 'ipopt' in inUse:
		return 'ipopt for every contact', newtonAdvice, None, ('solver', 'newton')
	if _waitingIpopt(scene):
		seen = f'ipopt, not in use: {_withoutSolver(scene)}'
		return seen, "solver = 'newton', before contactPoint = 'analyticCentre' brings Ipopt into use", None, ('solver', 'newton')
	if inUse:
		return 'newton', ''
	return f'{" and ".join(scene.values("solver"))}, not in use: {_withoutSolver(scene)}', ''


def contactPoint(scene):
	"""contact point"""
	points = {functor.contactPoint for functor in scene.functors if functor.contactModel == 'boon2012'}
	if not points:
		return 'a contact surface has its own'
	trial = ('contactPoint', 'analyticCentre')
	first = " (solver = 'newton' first)" if _waitingIpopt(scene) else ''
	if 'chebyshevCentre' in points:
		return 'chebyshevCentre, not unique on faces: it jumps', f"contactPoint = 'analyticCentre' where faces meet faces{first}", None, trial
	if 'centroid' in points:
		return 'centroid of the overlap', f"contactPoint = 'analyticCentre'{first}, unless you want the force at the centroid", None, trial
	return 'analyticCentre', ''


def _solves(functor):
	"""Whether the contacts of this functor need a solver."""
	return functor.contactModel == 'boon2012' and functor.contactPoint == 'analyticCentre'


def _waitingIpopt(scene):
	"""Whether Ipopt is not in use, but would be with the contact point that is advised."""
	return any(functor.solver == 'ipopt' and functor.contactModel == 'boon2012' and not _solves(functor) for functor in scene.functors)


def _withoutSolver(scene):
	"""Why no solver is in use."""
	points = sorted({functor.contactPoint for functor in scene.functors if functor.contactModel == 'boon2012' and not _solves(functor)})
	return f'the point of {" and ".join(points)} needs none' if points else 'a contact surface needs none'
