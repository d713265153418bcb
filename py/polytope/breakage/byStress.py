# SPDX-License-Identifier: GPL-2.0-or-later
"""Breakage of grains by their mean stress, with strengths that fall with size: `polytope.breakGrains(…)` (docs/bonds.md)."""

import math
import numbers

import numpy as np
from yade import O, Polytope

from ..arguments import namedArguments, number, positive, vector
from ..bonding.bonds import intactBonds
from ..measures.stress import bodyStress
from ..scene.movers import movers
from ..scene.namedBodies import namedBodies
from ..scene.ranks import refuseDivided
from .splitting import splitAnew

__all__ = ['breakGrains']

strengths = ('tension', 'compression', 'shear', 'octahedral', 'vonMises')


@namedArguments
def breakGrains(
	tension=math.inf,
	compression=math.inf,
	shear=math.inf,
	octahedral=math.inf,
	vonMises=math.inf,
	volume=None,
	modulus=None,
	probability=None,
	seed=None,
	ids=None,
	smallest=None,
):
	"""Splits grains whose mean stress exceeds a strength; every few steps: ``PyRunner(command='polytope.breakGrains(…)', iterPeriod=20)``.

	With the principal values σ₁ ≥ σ₂ ≥ σ₃ of bodyStress (tension positive) a grain breaks where one of these exceeds 1, along the plane of
	the largest of them, through its centroid:

	- max(σ₁, 0)/*tension* + max(−σ₃, 0)/*compression* (Gladkyy & Kuna 2017, Granular Matter 19:41) and (σ₁ − σ₃)/2/*shear* (Tresca):
	  along a plane of greatest shear stress, half way between the directions of σ₁ and σ₃;
	- q/*octahedral* with q = √((σ₁−σ₂)² + (σ₂−σ₃)² + (σ₃−σ₁)²)/3 (McDowell & de Bono 2013): normal to the direction of σ₁;
	- 3 q/√2/*vonMises*: along both planes of greatest shear stress, into four pieces.

	What is broken, how, and what is kept: split; all contacts of the pieces begin anew. Members of clumps, bonded and fixed bodies are left out.

	:param float tension, compression, shear, octahedral, vonMises: strengths [Pa] of a grain of *volume*; default infinite
	:param float volume: [m³] for which strengths are given; other grains have strength × (volume/V)^(1/modulus). Default: all have the same
	:param float modulus: of Weibull's distribution, above 0; needed with *volume*, *probability* and *seed*
	:param float probability: strengths are those that have failed with this probability, 0 to 1; default 1 − 1/e, the distribution's scale
	:param int seed: gives each grain a random strength of its own, by its number, distributed after Weibull; not with *probability*
	:param ids: of the grains, of which those that are no more (broken before) are left out, and so are their pieces; default all free polytopes
	:param float smallest: least inscribed radius of a piece [m]: grains that would leave a smaller one do not break; default as of split
	:returns: dictionary: number of each grain that broke → numbers of its pieces
	:raises ValueError: naming the argument
	:raises RuntimeError: the scene is divided on several processes (docs/mpi.md)
	"""
	limits = np.array(
		[_strength(value, name) for value, name in zip((tension, compression, shear, octahedral, vonMises), strengths, strict=True)]
	)
	if np.isinf(limits).all():
		raise ValueError(f'tension: give at least one strength, of {", ".join(strengths)}')
	factor = _sizeEffect(volume, modulus, probability, seed)
	refuseDivided()
	broken = {}
	for k, stress in bodyStress(_breakable(ids)).items():
		values, axes = np.linalg.eigh((stress + stress.T) / 2)
		use, planes = _use(values, axes, limits * factor(O.bodies[k]))
		if use > 1 and (pieces := _cut(k, planes, smallest)):
			broken[k] = pieces
	return broken


def _use(values, axes, limits):
	"""(largest part of a strength that is in use, normals of the planes along which the grain breaks then).

	:param values, axes: principal stresses, ascending, and their directions as columns
	"""
	least, greatest = values[0], values[2]
	q = math.sqrt(((values - np.roll(values, 1)) ** 2).sum()) / 3
	across = [axes[:, 2] + axes[:, 0], axes[:, 2] - axes[:, 0]]
	uses = [
		(max(greatest, 0) / limits[0] + max(-least, 0) / limits[1], across[:1]),
		((greatest - least) / 2 / limits[2], across[:1]),
		(q / limits[3], [axes[:, 2]]),
		(3 * q / math.sqrt(2) / limits[4], across),
	]
	return max(uses, key=lambda one: one[0])


def _cut(k, planes, smallest):
	"""Numbers of the pieces; empty where the first plane would leave one below *smallest*. Where a later plane would, its piece stays."""
	centre, pieces = vector(O.bodies[k].state.pos, 'point'), [k]
	for normal in planes:
		cut = []
		for piece in pieces:
			try:
				cut += splitAnew(piece, normal, centre, smallest)
			except ValueError as refused:
				if not str(refused).startswith('point'):
					raise
				cut.append(piece)
		pieces = cut
	return [piece for piece in pieces if piece != k]


def _breakable(ids):
	if ids is None:
		chosen = [body.id for body in movers() if isinstance(body.shape, Polytope)]
	else:
		chosen = [k for k in namedBodies(ids, erased=True) if O.bodies[k].dynamic and not O.bodies[k].isClump]
		other = next((k for k in chosen if not isinstance(O.bodies[k].shape, Polytope)), None)
		if other is not None:
			raise ValueError(f'ids: body {other} has no Polytope shape')
	flat = next((k for k in chosen if O.bodies[k].shape.dimension == 2), None)
	if flat is not None:
		raise ValueError(f'ids: body {flat} is a polygon; only polyhedra break by their stress (polytope.split breaks polygons)')
	held = {k for bond in intactBonds() for k in (bond.id1, bond.id2)}
	return [k for k in chosen if k not in held]


def _sizeEffect(volume, modulus, probability, seed):
	"""The function from a body to its strength over that which is given."""
	if modulus is None:
		for value, name in ((volume, 'volume'), (probability, 'probability'), (seed, 'seed')):
			if value is not None:
				raise ValueError(f"{name}: needs Weibull's modulus too; give modulus=…")
		return lambda body: 1.0
	power = 1 / positive(modulus, 'modulus')
	reference = None if volume is None else positive(volume, 'volume')
	if probability is not None and seed is not None:
		raise ValueError('probability: random strengths (seed) have all probabilities; leave one of the two out')
	if seed is not None and (isinstance(seed, bool) or not isinstance(seed, numbers.Integral) or seed < 0):
		raise ValueError(f'seed: must be a whole number from 0 on, got {seed!r}')
	shared = 1 - math.exp(-1) if probability is None else float(number(probability, 'probability'))
	if not 0 < shared < 1:
		raise ValueError(f'probability: must be between 0 and 1, got {probability!r}')

	def factor(body):
		failing = shared if seed is None else np.random.default_rng((seed, body.id)).uniform()
		return (-math.log1p(-failing) * (1 if reference is None else reference / float(body.shape.volume))) ** power

	return factor


def _strength(value, name):
	if not number(value, name) > 0:
		raise ValueError(f'{name}: must be a strength above 0 [Pa], got {value!r}')
	return float(value)
