# SPDX-License-Identifier: GPL-2.0-or-later
"""Which factor to try next, between one at which a scene stands and one at which it fails."""

import math
from typing import NamedTuple

__all__ = ['Bracket']

growth = 1.5
"""Growth of the factor from one trial to the next, until one fails."""
beside = 0.4
"""Distance of trials from the estimated limit over the tolerance, on either side: the nearer, the longer they take, and both together must
be within the tolerance."""
patience = 2
"""Estimates on end that may be wrong."""
near = 0.5
"""How far beyond the lower of two factors that failed an estimate counts, over their distance, in 1/F: far above the limit a mass fails in
other modes."""


class _Failed(NamedTuple):
	"""A trial that failed, as *Bracket.tell* takes it."""

	factor: float
	lacks: float
	body: int
	limit: float
	began: float


class Bracket:
	"""Divisors of strength between which the limit lies: *stable* and *failed*.

	The motion in the trial that failed by the lowest factor tells where the limit is (*Motion*). Where it does not: if a body slides, the
	force that it lacks to stand is linear in tan φ/F and c/F, and the two lowest factors that failed tell by a straight line in 1/F where
	it is zero, if the same body moved farthest in both. A trial on either side of this estimate ends the search if it is right. If it is
	wrong and failed, its own motion tells better; else, and after the second one on end, the bracket is halved next.

	A trial that begins at a much larger strength makes bodies swing, and where joints hardly hold more than the load, such a swing alone
	carries them far. So it counts as failed in the end only if it failed from within the tolerance, and is made again from there if it did
	not; what it forgets if it stands then.

	:param float tolerance: width over the factor that is asked for
	:param float most: largest factor to try
	"""

	def __init__(self, tolerance, most):
		self.tolerance, self.most = tolerance, most
		self.stable = 1.0
		self._failures = []
		"""Trials that failed, those at larger strengths first."""
		self._expected = None
		"""Whether the trial that was asked for last should stand, by the estimate; None: that was no estimate."""
		self._wrong = 0
		"""Estimates on end that were wrong."""

	@property
	def failed(self):
		return self._failures[-1].factor if self._failures else math.inf

	@property
	def isFound(self):
		return self._isNarrow and self._failures[-1].began * (1 + self.tolerance) >= self.failed

	@property
	def _isNarrow(self):
		return self.failed / self.stable - 1 <= self.tolerance

	@property
	def halvings(self):
		"""Trials until it is narrow, if each halves it."""
		wide = self.failed / self.stable if math.isfinite(self.failed) else growth
		return (not math.isfinite(self.failed)) + max(0, math.ceil(math.log2((wide - 1) / self.tolerance)))

	def next(self):
		"""Factor of the next trial."""
		self._expected = None
		if math.isinf(self.failed):
			return min(growth * self.stable, self.most)
		if self._isNarrow:
			return self.failed  # from nearer
		limit = None if self._wrong >= patience else self._estimate()
		if limit is None:
			self._wrong = 0
		if limit is not None:
			low, high = limit * (1 - beside * self.tolerance), limit * (1 + beside * self.tolerance)
			for factor, stands in ((low, True), (high, False)):
				if self.stable < factor < self.failed:
					self._expected = stands
					return factor
		return (self.stable + self.failed) / 2

	def tell(self, factor, stands, lacks=0.0, body=None, limit=None, began=math.inf):
		"""The outcome of a trial.

		:param float lacks: of one that failed: force that the body lacked which moved farthest, over any constant measure
		:param body: which that was
		:param limit: of one that failed: the factor at which it would have stood, by its motion; None: it does not tell
		:param float began: of one that failed: the factor of the state at rest from which it began; infinite: it did not go by a state
		"""
		if stands:
			self.stable = max(self.stable, factor)
		self._failures = [one for one in self._failures if one.factor > factor or (not stands and one.factor < factor)]
		if not stands:
			self._failures = sorted([*self._failures, _Failed(factor, lacks, body, limit, began)], key=lambda one: -one.factor)
		wrong = self._expected not in (None, stands)
		self._wrong = self._wrong + (patience if stands else 1) if wrong else 0

	def _estimate(self):
		lowest = self._failures[-2:]
		limit = lowest[-1].limit
		if limit is not None and self.stable < limit < self.failed:
			return limit
		if len(lowest) < 2:
			return None
		(x1, y1), (x2, y2) = ((1 / one.factor, one.lacks) for one in lowest)
		if lowest[0].body != lowest[1].body or not y1 > y2 > 0 or y2 / (y1 - y2) > near:
			return None
		limit = 1 / (x2 + y2 * (x2 - x1) / (y1 - y2))
		return limit if self.stable < limit < self.failed else None
