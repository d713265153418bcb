# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of a run of a scene: counters, times, energies, overlaps, and a hash of the state it ended in."""

import collections
import hashlib
import struct
import time

from yade import O
from yade.utils import kineticEnergy

__all__ = ['RunWatch', 'stateHash']


def stateHash():
	"""Hash of all bodies' positions, orientations and velocities, to the last bit: equal states have equal hashes."""
	digest = hashlib.sha256()
	for body in O.bodies:
		state = body.state
		numbers = [float(x) for vector in (state.pos, state.ori, state.vel, state.angVel) for x in vector]
		digest.update(struct.pack(f'<{len(numbers)}d', *numbers))
	return digest.hexdigest()[:16]


class RunWatch:
	"""Steps the simulation, and measures it with little disturbance.

	The loop's time is taken with O.timingEnabled. The contact functor's own clock (Ig2_….timing) costs more than what it
	measures in a dismissed pair, so it runs in some steps only, and these do not count for the loop's time. A step in which
	another program took the processor counts for neither the program's nor the centre's time. Steps are taken with O.step in
	the calling thread: O.run(…, wait=True) checks only every 40 ms whether it is done.
	"""

	sampleEvery = 10
	"""Steps between two searches of all contacts for the deepest overlap; a collision at 0.2 sqrt(m/k) takes some ten."""
	timeEvery = 100
	timedSteps = 10
	"""The functor's clock runs in the first timedSteps of timeEvery steps."""
	mostLost = 0.05
	"""Share of a timed step's wall time that it may have been without the processor."""

	def __init__(self, geometryFunctor, interactionLoop):
		self.functor, self.loop = geometryFunctor, interactionLoop
		self.counts = collections.Counter()
		self.timed, self.disturbed = collections.Counter(), collections.Counter()
		self.untimedPairs = self.untimedContacts = 0
		self.steps = self.untimedSteps = 0
		self.deepestOverlap = 0.0
		self.functor.resetStats()
		self.loop.execTime = 0

	def run(self, steps, afterStep=lambda: None):
		"""Take *steps* steps, calling *afterStep* after each."""
		timingBefore = O.timingEnabled, self.functor.timing
		try:
			for _ in range(steps):
				phase = self.steps % self.timeEvery
				if phase in (0, self.timedSteps):
					self._bookCounters()
					self.functor.timing = phase == 0
					O.timingEnabled = not self.functor.timing
				wall, own = time.perf_counter(), time.thread_time()
				O.step()
				wall, own = time.perf_counter() - wall, time.thread_time() - own
				if self.functor.timing:
					self._bookCounters(disturbed=wall - own > self.mostLost * wall)
				self.steps += 1
				self.untimedSteps += not self.functor.timing
				if self.steps % self.sampleEvery == 0:
					self.deepestOverlap = max(self.deepestOverlap, overlapNow())
				afterStep()
			self._bookCounters()
			self.deepestOverlap = max(self.deepestOverlap, overlapNow())
		finally:
			O.timingEnabled, self.functor.timing = timingBefore

	def _bookCounters(self, disturbed=False):
		"""Moves the functor's counters to ours: what was counted with its clock on goes to the timed ones as well."""
		stats = self.functor.stats()
		self.functor.resetStats()
		statuses = stats.pop('statuses')
		self.counts.update(stats)
		self.counts.update({'status ' + name: count for name, count in statuses.items()})
		if self.functor.timing:
			(self.disturbed if disturbed else self.timed).update(stats)
		else:
			self.untimedPairs += stats['pairs']
			self.untimedContacts += stats['contacts']

	def _timedMicroseconds(self, seconds, count):
		"""Mean of undisturbed steps; where none of them had such a query, of the disturbed ones."""
		timed = self.timed if self.timed[count] else self.disturbed
		return 1e6 * _ratio(timed[seconds], timed[count])

	def summary(self):
		"""Counters over the whole run and mean times [µs], as a dictionary."""
		counts = self.counts
		return {
			'steps': self.steps,
			'pairs': counts['pairs'],
			'contactQueries': counts['contacts'],
			'dismissed': counts['dismissed'],
			'pivotsPerPair': _ratio(counts['simplexPivots'], counts['pairs']),
			'newtonPerContact': _ratio(counts['newtonIterations'], counts['contacts']),
			'fallbacks': counts['fallbacks'],
			'failures': counts['failures'],
			'statuses': {key[len('status ') :]: count for key, count in counts.items() if key.startswith('status ') and count},
			'lpMicroseconds': self._timedMicroseconds('lpSeconds', 'pairs'),
			'centreMicroseconds': self._timedMicroseconds('centreSeconds', 'timedPairs'),
			'loopMicrosecondsPerPair': 1e-3 * _ratio(self.loop.execTime, self.untimedPairs),
			'loopMicrosecondsPerContact': 1e-3 * _ratio(self.loop.execTime, self.untimedContacts),
			'loopMicrosecondsPerStep': 1e-3 * _ratio(self.loop.execTime, self.untimedSteps),
			'deepestOverlap': self.deepestOverlap,
			'overlap': overlapNow(),
			'contacts': sum(1 for contact in O.interactions if contact.isReal),
			'kineticEnergy': kineticEnergy(),
			'stateHash': stateHash(),
		}


def overlapNow():
	"""Deepest overlap of all contacts [m]."""
	return max((contact.geom.penetrationDepth for contact in O.interactions if contact.isReal), default=0.0)


def _ratio(total, count):
	return total / count if count else 0.0
