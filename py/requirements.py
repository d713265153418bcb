# SPDX-License-Identifier: GPL-2.0-or-later
"""What a scene needs, and what it pays for without using it: `polytope.requirements(O)`."""

import dataclasses
import json
import pathlib
import subprocess
import sys
import tempfile

from . import tradeoffPrecision as precision
from .requirementsLooks import looks

__all__ = ['Finding', 'Requirements', 'requirements']


@dataclasses.dataclass
class Finding:
	"""One thing looked at."""

	what: str
	"""'contact area', 'corner radius', …"""
	seen: str
	advice: str = ''
	"""What to change; '' where nothing is to be changed."""
	cost: float = None
	"""Of what is paid without use, or of what the advice saves [µs a step]; negative: following the advice costs that. None: no time
	hangs on it, or none was measured."""
	trial: tuple = None
	"""(name, value) of the change that was timed, see requirementsWorker.change."""


class Requirements:
	"""What polytope.requirements() returns; printing it shows all.

	:ivar list findings: of Finding
	:ivar list notSeen: (what, why): what could not be looked at as the scene is now
	:ivar float stepMicroseconds: of all engines, as the scene is; None if it was not measured
	"""

	def __init__(self, findings, stepMicroseconds=None, notSeen=()):
		self.findings, self.stepMicroseconds, self.notSeen = findings, stepMicroseconds, list(notSeen)

	def __getitem__(self, what):
		"""The finding of that name."""
		for finding in self.findings:
			if finding.what == what:
				return finding
		why = f' ({dict(self.notSeen)[what]})' if what in dict(self.notSeen) else ''
		raise KeyError(f'{what!r} was not looked at{why}; there are {[finding.what for finding in self.findings]}')

	@property
	def advice(self):
		"""The findings with something to change."""
		return [finding for finding in self.findings if finding.advice]

	def __repr__(self):
		from tabulate import tabulate

		whole = self.stepMicroseconds
		rows = []
		for finding in sorted(self.findings, key=lambda finding: not finding.advice):
			cost = '' if finding.cost is None else f'{finding.cost:+.3g}' + (f' ({100 * finding.cost / whole:+.0f} %)' if whole else '')
			rows.append([finding.what, finding.seen, finding.advice or 'as it should be', cost])
		head = f'{len(self.advice)} of {len(rows)} things to change' + (f'; a step takes {whole:.4g} µs' if whole else '')
		table = tabulate(rows, ['', 'seen', 'advice', 'saves [µs a step]'], maxcolwidths=[18, 48, 56, 16], disable_numparse=True)
		missing = [f'{what}: {why}' for what, why in self.notSeen]
		return '\n'.join([head, table, *(['Not looked at: ' + '; '.join(missing)] if missing else [])])

	def show(self):
		"""Prints it."""
		print(self)


def requirements(O, measure=True):
	"""Looks at the present scene and says what it needs, and what it pays for without using it.

	Looked at: contact area, third dimension, damping and energy (and whether stiffnesses let the conservative contact be that), cohesion,
	corner radius against the overlaps there are, what planes without a face do to contacts, Newton tolerance against the rounding of
	positions, time step against stiffness and mass, the collider's verletDist and boxes, warm start, solver, contact point, clocks and energy
	tracking. Look at a scene in motion or at rest, with contacts: without any, only settings are seen. What could not be looked at is named
	at the end. Overlaps are those of the present state (what was before is known only where a counter of the functor tells: contact points
	deeper than the corner radius): look at the moment of the hardest blow, too. A time step is near the limit above 1/ω of the fastest body,
	up to which stableTimeStep calls any heap stable.

	Costs are measured on this very scene: it is saved to a file (O.save), which another process loads, steps as it is and with one
	thing changed at a time (engines that run periodically, as recorders and PyRunner, are left out there). The scene itself is not
	touched: its state is the same afterwards to the last bit.

	:param O: yade.O
	:param bool measure: False: look only, at once
	:returns: a :yref:`Requirements`
	:raises ValueError: naming *O*: nothing to look at (no engines with a polytope's contact functor), or the simulation is running
	"""
	found, notSeen = looks(O)
	findings = [Finding(*one) for one in found]
	trials = [finding.trial for finding in findings if finding.trial]
	if not measure:
		return Requirements(findings, None, notSeen)
	times = _timed(O, trials)
	whole = times.get('')
	if isinstance(whole, float):
		for finding in findings:
			time = times.get(finding.trial[0]) if finding.trial else None
			if isinstance(time, float):
				finding.cost = whole - time
	return Requirements(findings, whole if isinstance(whole, float) else None, notSeen)


def _timed(O, trials):
	"""Name of a change → time of a step [µs], '' as it is; text where it did not run."""
	with tempfile.TemporaryDirectory() as folder:
		scene, changes, answers, log = (pathlib.Path(folder) / name for name in ('scene.yade.bin', 'changes.json', 'answers.json', 'log.txt'))
		O.save(str(scene), quiet=True)
		changes.write_text(json.dumps(trials))
		command = [sys.executable, '-P', '-m', 'yade.polytope.requirementsWorker', str(scene), str(changes), str(answers)]
		with open(log, 'w') as file:
			subprocess.run(command, env=precision.environment(precision.present()), stdin=subprocess.DEVNULL, stdout=file, stderr=file)
		return json.loads(answers.read_text()) if answers.is_file() else {}
