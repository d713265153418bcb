# SPDX-License-Identifier: GPL-2.0-or-later
"""What polytope.check() returns."""

import dataclasses

__all__ = ['Check', 'Finding']


@dataclasses.dataclass
class Finding:
	"""Result of one check."""

	what: str
	"""'time step', 'overlap', …"""
	seen: str
	advice: str = ''
	"""What to change."""
	trial: tuple = None
	"""(name, value) of the change whose cost can be timed, see costs.change; None: it does not affect the time."""
	cost: float = None
	"""Time that the advice saves [µs a step], with the timed advice of the findings before it in force; None where none was measured."""


class Check(list):
	"""What polytope.check() returns: a list of findings (`what`, `seen`, `advice`, `cost`), empty where nothing is wrong. Printing it shows all.

	:param str about: of the bodies, their sizes and masses, printed after the findings
	:ivar float stepMicroseconds: of all engines, as the scene is; None where no costs were measured
	:ivar str notMeasured: why costs that were asked for are missing; '' where they are not
	"""

	def __init__(self, findings=(), about=''):
		super().__init__(findings)
		self.about, self.stepMicroseconds, self.notMeasured = about, None, ''

	def __getitem__(self, what):
		"""The finding of that name, or of that place in the list."""
		if not isinstance(what, str):
			return super().__getitem__(what)
		for finding in self:
			if finding.what == what:
				return finding
		raise KeyError(f'{what!r} was not found; there are {[finding.what for finding in self]}')

	def __repr__(self):
		costs = [f'costs were not measured: {self.notMeasured}'] if self.notMeasured else []
		if self.stepMicroseconds is not None:
			saved = sum(finding.cost for finding in self if finding.cost is not None)
			after = f', {self.stepMicroseconds - saved:.4g} µs with all advice that was timed' if saved else ''
			costs = [f'a step takes {self.stepMicroseconds:.4g} µs{after}']
		if not self:
			return '\n'.join(filter(None, ('nothing was found that is wrong', self.about, *costs)))
		return '\n'.join([*(self._shown(finding) for finding in self), *filter(None, [self.about]), *costs])

	def _shown(self, finding):
		saves = '' if finding.cost is None else f' (saves {finding.cost:.3g} µs a step, {100 * finding.cost / self.stepMicroseconds:.0f} %)'
		return f'{finding.what}: {finding.seen}\n\t{finding.advice}{saves}'
