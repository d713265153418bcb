# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings that a scene needs, and settings that cost time without being used: `polytope.requirements(O)`."""

import dataclasses

from .checks import checks
from .costs import stepTimes

__all__ = ['Finding', 'Requirements', 'requirements']

withoutContacts = (
	'No polytopes are in contact now: what depends on contacts was not checked, and its cost was not measured. '
	'Call again when there are some; if bodies flew apart, take a smaller O.dt.'
)
"""First line about a scene without contacts."""


@dataclasses.dataclass
class Finding:
	"""Result of one check."""

	what: str
	"""'contact area', 'corner radius', …"""
	seen: str
	advice: str = ''
	"""What to change; '' where nothing is to be changed."""
	cost: float = None
	"""Cost of what is not used, or time that the advice saves [µs a step]; negative: following the advice costs that. With the timed
	advice of the findings before it in force: costs add up. None: it does not affect the time, or none was measured."""
	trial: tuple = None
	"""(name, value) of the change that was timed, see worker.change."""


class Requirements:
	"""What polytope.requirements() returns; printing it shows all.

	:ivar list findings: of Finding, those with advice first, in the order in which to follow it
	:ivar list notSeen: (what, why): what could not be checked in the present scene
	:ivar float stepMicroseconds: of all engines, as the scene is; None if it was not measured
	:ivar bool contacts: whether polytopes were in contact
	"""

	def __init__(self, findings, stepMicroseconds=None, notSeen=(), contacts=True):
		self.findings, self.stepMicroseconds, self.notSeen, self.contacts = findings, stepMicroseconds, list(notSeen), contacts

	def __getitem__(self, what):
		"""The finding of that name."""
		for finding in self.findings:
			if finding.what == what:
				return finding
		why = f' ({dict(self.notSeen)[what]})' if what in dict(self.notSeen) else ''
		raise KeyError(f'{what!r} was not checked{why}; there are {[finding.what for finding in self.findings]}')

	@property
	def advice(self):
		"""The findings with something to change."""
		return [finding for finding in self.findings if finding.advice]

	def __repr__(self):
		from tabulate import tabulate

		whole = self.stepMicroseconds
		rows = []
		for finding in self.findings:
			cost = '' if finding.cost is None else f'{finding.cost:+.3g}' + (f' ({100 * finding.cost / whole:+.0f} %)' if whole else '')
			rows.append([finding.what, finding.seen, finding.advice or 'as it should be', cost])
		head = f'{len(self.advice)} of {len(rows)} things to change' + (f'; a step takes {whole:.4g} µs' if whole else '')
		saved = [finding.cost for finding in self.advice if finding.cost is not None]
		if saved:
			head += f', {whole - sum(saved):.4g} µs with all advice that was timed; each row is timed with the advice above it in force'
		table = tabulate(rows, ['', 'seen', 'advice', 'saves [µs a step]'], maxcolwidths=[18, 48, 56, 16], disable_numparse=True)
		missing = [f'{what}: {why}' for what, why in self.notSeen]
		lines = [head, table, *(['Not checked: ' + '; '.join(missing)] if missing else [])]
		return '\n'.join(lines if self.contacts else [withoutContacts, *lines])

	def show(self):
		"""Prints it."""
		print(self)


def requirements(O, measure=True):
	"""Checks the present scene: which settings it needs, and which cost time without being used.

	Checked are: contact area, several pieces under one face with a stiffness per contact, third dimension, damping and energy (and whether
	the contact model conserves energy with these stiffnesses), cohesion, corner radius (of the contact model 'boon2012') against the
	overlaps there are, what planes without a face do to contacts, Newton tolerance against the rounding of positions, time step against
	stiffness and mass, the collider's verletDist and boxes, warm start, solver, contact point, clocks and energy tracking. Check a scene in
	motion or at rest, with contacts: without any, only settings are checked, no cost of contacts is measured, and the first line says so.
	What could not be checked is listed at the end. Overlaps are those of the present state (what was before is known only where a counter
	of the functor tells: contact points deeper than the corner radius): check at the moment of the hardest impact, too. A time step is near
	the limit above stableTimeStep(1), up to which any heap is stable.

	Costs are measured on this very scene: it is saved to a file (O.save), which another process loads, and steps as it is and changed
	(engines that run periodically, as recorders and PyRunner, are left out there). Changes may depend on one another, as the solver's cost
	on the contact point: each is timed with the advice above it in force, so costs add up to what following all of it saves, in this order.
	The scene itself is not touched: its state is the same afterwards to the last bit.

	:param O: yade.O
	:param bool measure: False: only check, which takes no time
	:returns: a *Requirements*
	:raises ValueError: naming *measure* if it is neither True nor False; naming *O*: nothing to check (no engines with a polytope's
		contact functor), or the simulation is running
	:raises OSError: naming *measure* if the scene cannot be saved to a temporary folder (TMPDIR)
	"""
	if not isinstance(measure, bool):
		raise ValueError(f'measure: must be True or False, got {measure!r}')
	found, notSeen, contacts = checks(O)
	findings = sorted((Finding(*one) for one in found), key=lambda finding: not finding.advice)
	if not measure:
		return Requirements(findings, None, notSeen, contacts)
	timed = [finding for finding in findings if finding.trial]
	times, why = stepTimes(O, [(*finding.trial, bool(finding.advice)) for finding in timed])
	if why:
		return Requirements(findings, None, [*notSeen, ('costs', why)], contacts)
	before = times['']
	for finding in timed:
		if finding.trial[0] in times:
			time = times[finding.trial[0]]
			finding.cost = before - time
			before = time if finding.advice else before
	return Requirements(findings, times[''], notSeen, contacts)
