# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of the linear program and of the contact point with other settings of the contact functor than those of the run."""

import collections
import itertools

from yade import Ig2_Polytope_Polytope_PolytopeGeom, InsertionSortCollider, InteractionLoop, O

__all__ = ['StateSample', 'hasSolver']


def hasSolver(solver):
	"""Whether this build has it; 'ipopt' is optional."""
	try:
		Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012', solver=solver)
	except ValueError:
		return False
	return True


class StateSample:
	"""States kept during a run (O.saveTmp), on which the contact detection is timed afterwards: the run is not affected.

	*keep* costs some 50 ms for 200 bodies; the states stay in memory until they are overwritten by the next sample's.
	"""

	def __init__(self):
		self.marks = []

	def keep(self):
		"""The scene as it is now."""
		self.marks.append(f'sample{len(self.marks)}')
		O.saveTmp(self.marks[-1], quiet=True)

	def times(self, every=1, passes=5, **settings):
		"""Detect all contacts of every *every*-th state, and return counters and mean times as a dictionary. Leaves another scene in O.

		A state is gone through once to fill the processor's caches, as they are in a run, and then *passes* times, of which the
		fastest counts: another program that takes the processor meanwhile only makes a pass longer.

		:param settings: attributes of Ig2_Polytope_Polytope_PolytopeGeom, e.g. warmStart=False, solver='ipopt'
		:returns: states, pairs, contacts, pivotsPerPair, newtonPerContact, ipoptPerContact, fallbacks, failures; lpMicroseconds per pair,
		    centreMicroseconds per contact (nan where there is none)
		:raises ValueError: for settings the functor refuses
		"""
		total, states = collections.Counter(), 0
		for mark in itertools.islice(self.marks, 0, None, every):
			O.loadTmp(mark, quiet=True)
			next(engine for engine in O.engines if isinstance(engine, InsertionSortCollider))()  # a state has no pairs but those in contact
			loop = next(engine for engine in O.engines if isinstance(engine, InteractionLoop))
			functor = next(functor for functor in loop.geomDispatcher.functors if isinstance(functor, Ig2_Polytope_Polytope_PolytopeGeom))
			functor.timing = True
			for name, value in settings.items():
				setattr(functor, name, value)
			if passes > 1:
				loop()
			stats = [self._onePass(loop, functor) for _ in range(passes)]
			total.update({name: count for name, count in stats[0].items() if name not in ('statuses', 'lpSeconds', 'centreSeconds')})
			for seconds in ('lpSeconds', 'centreSeconds'):
				total[seconds] += min(one[seconds] for one in stats)
			states += 1
		return {
			'states': states,
			'pairs': total['pairs'],
			'contacts': total['contacts'],
			'pivotsPerPair': _mean(total['simplexPivots'], total['pairs']),
			'newtonPerContact': _mean(total['newtonIterations'], total['contacts']),
			'ipoptPerContact': _mean(total['ipoptIterations'], total['contacts']),
			'fallbacks': total['fallbacks'],
			'failures': total['failures'],
			'lpMicroseconds': 1e6 * _mean(total['lpSeconds'], total['pairs']),
			'centreMicroseconds': 1e6 * _mean(total['centreSeconds'], total['timedPairs']),
		}

	@staticmethod
	def _onePass(loop, functor):
		functor.resetStats()
		loop()
		return functor.stats()


def _mean(total, count):
	return total / count if count else float('nan')
