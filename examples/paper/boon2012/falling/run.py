# SPDX-License-Identifier: GPL-2.0-or-later
"""The study of simulation A, polyhedra that fall and come to rest: single runs, what they give, and their files.

The result of a run is a dictionary, as it goes to results.json; lengths over L, energies over N m g L.
"""

import csv
import json
import time

from tqdm import tqdm
from yade import O, PolytopeVTKRecorder
from yade.utils import kineticEnergy

from ..runWatch import RunWatch
from ..solverTimes import StateSample, hasSolver
from .pictures import HeapPictures
from .scene import FallingPolyhedra, solids

__all__ = ['FallingRun', 'halfStep', 'quantities', 'save']

halfStep = 4000
"""Step of energyHalf, and of the second picture."""
energyEvery = 20
"""Steps between two points of the energy curve."""

quantities = {
	'energyHalf': f'kinetic energy / (N m g L), step {halfStep}',
	'energyEnd': 'kinetic energy / (N m g L), end',
	'contacts': 'contacts, end',
	'meanHeight': 'mean height of centres / L, end',
	'deepestOverlap': 'deepest overlap / L, whole run',
	'overlap': 'deepest overlap / L, end',
}
"""Quantities by which a heap is judged: name in the results → label."""


class FallingRun:
	"""One run. That of the first seed also leaves pictures and ParaView files, and times of other solvers.

	:param str name: of the solid, a key of boon2012.falling.scene.solids, or 'mixed' for all in one scene
	:param int seed: of the orientations
	:param given: the options *parameters* (a dictionary for FallingPolyhedra), *number*, *steps*, *seed* (the first), *contact_model*,
	    *contact_point*,
	    *output*, *quick*, *no_pictures*, *vtk_every*, *sample_every*, *ipopt_every*
	"""

	def __init__(self, name, seed, given):
		self.name, self.seed, self.given = name, seed, given
		self.first = seed == given.seed
		self.faces = tuple(solids.values()) if name == 'mixed' else (solids[name],)
		self.scene = FallingPolyhedra(faces=self.faces, number=given.number, seed=seed, **given.parameters).build()
		self.scene.geometryFunctor.contactModel = given.contact_model
		self.scene.geometryFunctor.contactPoint = given.contact_point
		self.watch = RunWatch(self.scene.geometryFunctor, self.scene.interactionLoop)
		self.energyUnit = given.number * self.scene.mass * self.scene.gravity * self.scene.size or 1
		self.energies, self.sample, self.wallTime = [], StateSample(), 0.0

	def results(self):
		"""Runs, and returns the results."""
		given, folder = self.given, self.given.output / self.name
		half = min(halfStep, given.steps)
		recorder = self._recorder(folder)
		draws = self.first and not (given.no_pictures or given.quick)
		pictures = HeapPictures(self.scene, folder) if draws else None
		with tqdm(total=given.steps, desc=f'{self.name:12} {self.seed}', unit=' steps', smoothing=0.05, disable=None) as self.progress:
			if draws:
				pictures.draw()
			self._run(half)
			energyHalf = self._energy()
			if draws and half < given.steps:
				pictures.draw()
			self._run(given.steps - half)
		if draws:
			pictures.draw()
			pictures.finish()
		if recorder:
			recorder()  # the state at the end
		results = self._outcome(energyHalf)
		if self.first:
			results.update(self._timesOfSolvers())  # last: it leaves another scene
		return results

	def _recorder(self, folder):
		if not self.first:
			return None
		folder.mkdir(parents=True, exist_ok=True)
		if not self.given.vtk_every:
			return None
		recorder = PolytopeVTKRecorder(fileName=f'{folder}/', iterPeriod=self.given.vtk_every)
		O.engines = O.engines + [recorder]
		return recorder

	def _run(self, steps):
		if steps:
			began = time.perf_counter()
			self.watch.run(steps, self._afterStep)
			self.wallTime += time.perf_counter() - began

	def _afterStep(self):
		self.progress.update()
		if O.iter % energyEvery == 0:
			self.energies.append((O.iter, self._energy()))
		if self.first and O.iter % self.given.sample_every == 0:
			self.sample.keep()

	def _energy(self):
		return kineticEnergy() / self.energyUnit

	def _outcome(self, energyHalf):
		scene, summary = self.scene, self.watch.summary()
		positions = [body.state.pos for body in scene.particles()]
		return {
			'shape': self.name,
			'planesPerPair': 2 * self.faces[0] if len(self.faces) == 1 else None,
			'number': self.given.number,
			'threads': O.numThreads,
			'seed': self.seed,
			'seconds': self.wallTime,
			**summary,
			'energyHalf': energyHalf,
			'energyEnd': summary['kineticEnergy'] / self.energyUnit,
			'meanHeight': sum(p[2] for p in positions) / len(positions) / scene.size,
			'deepestOverlap': summary['deepestOverlap'] / scene.size,
			'overlap': summary['overlap'] / scene.size,
			'inside': sum(max(abs(p[0]), abs(p[1])) < scene.width / 2 and 0 < p[2] < scene.wallHeight for p in positions),
			'energies': self.energies,
		}

	def _timesOfSolvers(self):
		"""Cold starts, and Ipopt, on the states kept during the run."""
		given = self.given
		if not self.sample.marks:
			return {}
		cold = self.sample.times(warmStart=False)
		results = {'cold': cold, 'lpColdMicroseconds': cold['lpMicroseconds'], 'centreColdMicroseconds': cold['centreMicroseconds']}
		if given.ipopt_every and given.contact_model == 'boon2012' and given.contact_point == 'analyticCentre' and hasSolver('ipopt'):
			ipopt = self.sample.times(every=given.ipopt_every, passes=3, solver='ipopt', warmStart=False)
			results.update(ipopt=ipopt, ipoptMicroseconds=ipopt['centreMicroseconds'])
		return results


def save(results, folder):
	"""All runs, seed by seed: results.json, and without what is nested results.csv."""
	(folder / 'results.json').write_text(json.dumps(results, indent='\t') + '\n')
	nested = ('statuses', 'energies', 'cold', 'ipopt')
	with open(folder / 'results.csv', 'w', newline='') as file:
		writer = csv.DictWriter(file, [key for key in results[0] if key not in nested], extrasaction='ignore')
		writer.writeheader()
		writer.writerows(results)
