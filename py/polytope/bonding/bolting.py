# SPDX-License-Identifier: GPL-2.0-or-later
"""Rock bolts and cables between blocks: `polytope.bolt(…)` (docs/support.md)."""

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from yade import PolytopeBolt, PolytopeBolts

from ..arguments import flag, namedArguments, number, vector, warn
from ..scene.present import EngineOfScene

__all__ = ['BoltArrays', 'Dowel', 'Grout', 'bolt', 'boltArrays', 'bolts', 'madeBolts', 'removedBolts']

ofScene = EngineOfScene(PolytopeBolts, 'actingInScene')
"""The last engine PolytopeBolts that was in O.engines: a list of engines that is set later may lack it."""


@dataclasses.dataclass(frozen=True)
class Grout:
	"""Grout between a bolt and the rock around it: shear force per length against slip, elastic, then perfectly plastic."""

	stiffness: float
	"""Shear force per length and slip [N/m²]; Itasca's *Kbond*."""
	strength: float
	"""Largest shear force per length [N/m]; Itasca's *Sbond*. infinity: no slip."""
	length: float | None = None
	"""Grouted length, from the bolt's end [m]; None: all. The rest is free: the plate and the grouted part hold it."""


@dataclasses.dataclass(frozen=True)
class Dowel:
	"""What a grouted bolt resists shear of a joint with, apart from its tension: elastic, then perfectly plastic."""

	stiffness: float
	"""Shear force per shear displacement of the joint [N/m]."""
	strength: float
	"""Largest shear force [N]; infinity: no yield."""

	@classmethod
	def ofBar(cls, diameter, youngsModulus, foundation, yieldStress, rockStrength):
		"""Dowel of a round bar: a beam on an elastic foundation on each side of the joint, and Bjurström's strength.

		K = E I β³ with β⁴ = k/(4 E I) and I = π d⁴/64; F = 0.67 d² √(σ_y σ_c) (Bjurström 1974, as in Lorig 1985).

		:param float diameter: d [m]
		:param float youngsModulus: E of the steel [Pa]
		:param float foundation: k, force per length and deflection of the bar in grout and rock [N/m²]
		:param float yieldStress: σ_y of the steel [Pa]
		:param float rockStrength: σ_c, uniaxial compressive strength of the rock [Pa]
		:raises ValueError: naming the argument that is not a positive number
		"""
		values = dict(
			diameter=diameter, youngsModulus=youngsModulus, foundation=foundation, yieldStress=yieldStress, rockStrength=rockStrength
		)
		for name, value in values.items():
			if not 0 < number(value, name) < math.inf:
				raise ValueError(f'{name}: must be positive and finite, got {value}')
		bending = youngsModulus * math.pi * diameter**4 / 64
		return cls(bending * (foundation / (4 * bending)) ** 0.75, 0.67 * diameter**2 * math.sqrt(yieldStress * rockStrength))


thickest = 0.1
"""Cross-section of a bolt [m²] above which it is taken for one in mm²: cables for bridges have less."""
softest = 1e6
"""Young's modulus [Pa] below which it is taken for one in MPa or GPa: rubber has more."""
largestInGPa = 1e3
"""Number that a Young's modulus in GPa does not reach: steel has 200. Larger ones are taken for MPa."""


class BoltArrays(NamedTuple):
	"""What polytope.boltArrays() returns: a row for each element of steel of each bolt, and one for each crossing from block to block."""

	bolts: np.ndarray
	"""(n,) number of the bolt, in the order in which they were made."""
	distances: np.ndarray
	"""(n, 2) of both ends of the element from the bolt's head, as it was made [m]."""
	forces: np.ndarray
	"""(n,) tension [N]"""
	strains: np.ndarray
	"""(n,) from the unstressed steel on, plastic strain included [-]"""
	crossingBolts: np.ndarray
	"""(m,) number of the bolt of each crossing"""
	crossingIds: np.ndarray
	"""(m, 2) block on the side of the head, block on the side of the end"""
	tensions: np.ndarray
	"""(m,) with which the crossing pulls its two blocks together [N]"""
	openings: np.ndarray
	"""(m,) by how much its two points have moved apart [m]"""
	shearForces: np.ndarray
	"""(m, 3) of the dowel on the second block [N]"""


@namedArguments
def bolt(
	head,
	end,
	area,
	youngsModulus,
	yieldForce=math.inf,
	ruptureStrain=math.inf,
	pretension=0,
	grout=None,
	plate=True,
	dowel=None,
	freeLength=None,
):
	"""A rock bolt or cable through blocks: ``polytope.bolt(head=(0, 0, 0), end=(0, 0, 3), area=4.9e-4, youngsModulus=2e11)``.

	It ties together the blocks on the line from *head* to *end*. Without *grout* it is end-anchored: one spring of stiffness EA/L between
	the plate on the first block and the anchor in the last one, free in between, without compression. With it, grout holds the bolt in
	every block, by its shear stiffness and strength along the bolt, and a *dowel* resists shear of each joint. The bolt has no mass. It
	is without force as the blocks are now, but for its pretension. What sticks out of the rock at the head does not count.

	Set O.engines first: the bolts are in an engine PolytopeBolts, which is put between InteractionLoop and NewtonIntegrator.
	docs/support.md has the equations.

	:param Vector3 head: where the plate is, outside of the first block or in it [m]
	:param Vector3 end: the other end; of a bolt without grout in the block that holds the anchor [m]
	:param float area: cross-section of the steel [m²]
	:param float youngsModulus: of the steel [Pa]
	:param float yieldForce: tension at which the steel yields, perfectly plastic [N]; default infinite
	:param float ruptureStrain: strain at which the steel breaks, plastic strain included [-]; default infinite
	:param float pretension: force with which the head is pulled against its plate and locked [N]
	:param Grout grout: polytope.Grout(stiffness, strength, length); default none
	:param bool plate: a plate holds the head; needed without grout
	:param Dowel dowel: polytope.Dowel(stiffness, strength) at each joint that is grouted on both sides; default none
	:param float freeLength: length of a grouted bolt's steel at each joint that grout does not hold [m], which the joint's opening strains;
	    default four diameters
	:returns: the PolytopeBolt
	:raises ValueError: naming the argument and the remedy; then nothing was changed
	"""
	if grout is not None and not isinstance(grout, Grout):
		raise ValueError(f'grout: must be a polytope.Grout(stiffness, strength), got {grout!r}')
	if dowel is not None and not isinstance(dowel, Dowel):
		raise ValueError(f'dowel: must be a polytope.Dowel(stiffness, strength), got {dowel!r}')
	_tellUnits(number(area, 'area'), number(youngsModulus, 'youngsModulus'))
	pattern = PolytopeBolt(
		head=vector(head, 'head'),
		end=vector(end, 'end'),
		area=number(area, 'area'),
		youngsModulus=number(youngsModulus, 'youngsModulus'),
		yieldForce=number(yieldForce, 'yieldForce'),
		ruptureStrain=number(ruptureStrain, 'ruptureStrain'),
		pretension=number(pretension, 'pretension'),
		plate=flag(plate, 'plate'),
		freeLength=_given(freeLength, 'freeLength'),
		**_ofGrout(grout),
		**_ofDowel(dowel),
	)
	engine, index = ofScene.make('bolts act', lambda engine: engine.make(pattern))
	return engine.bolts[index]


def _tellUnits(area, modulus):
	if thickest < area < math.inf:
		warn(f'area: {area:g} m² is that of no bolt; in mm²? {area:g} mm² are {1e-6 * area:g} m²')
	if 0 < modulus < softest:
		unit, size = ('GPa', 1e9) if modulus < largestInGPa else ('MPa', 1e6)
		warn(f'youngsModulus: {modulus:g} Pa is softer than any bolt; in {unit}? {modulus:g} {unit} are {size * modulus:g} Pa')


def bolts():
	"""The scene's engine PolytopeBolts, None where there is none."""
	return ofScene.present()


def madeBolts():
	"""All bolts of the scene."""
	engine = bolts()
	return engine.bolts if engine else []


def removedBolts():
	"""An engine PolytopeBolts that holds blocks of this scene and is no longer in O.engines; None where there is none."""
	return ofScene.removed()


def boltArrays():
	"""Forces in all bolts as they are now, as NumPy arrays: ``polytope.boltArrays().forces.max()``.

	Copies, float64 and int32. ``numpy.savez(file, **polytope.boltArrays()._asdict())`` writes them.

	:returns: BoltArrays, whose help text says what each field is
	"""
	all = list(enumerate(madeBolts()))
	elements = [(k, one.stations[:-1], one.stations[1:], one.elementForces, one.elementStrains) for k, one in all]
	crossings = [(k, crossing) for k, one in all for crossing in one.crossings]

	def column(index):
		return np.array([float(x) for element in elements for x in element[index]])

	return BoltArrays(
		bolts=np.repeat([k for k, _ in all], [len(element[3]) for element in elements]).astype(np.int32),
		distances=np.column_stack([column(1), column(2)]),
		forces=column(3),
		strains=column(4),
		crossingBolts=np.array([k for k, _ in crossings], np.int32),
		crossingIds=np.array([(one.id1, one.id2) for _, one in crossings], np.int32).reshape(-1, 2),
		tensions=np.array([float(one.tension) for _, one in crossings]),
		openings=np.array([float(one.opening) for _, one in crossings]),
		shearForces=np.array([[float(x) for x in one.shearForce] for _, one in crossings]).reshape(-1, 3),
	)


def _given(value, name):
	"""The number for an attribute of PolytopeBolt, which has -1 where none is given."""
	if value is None:
		return -1
	if number(value, name) == -1:  # what stands for no value
		raise ValueError(f'{name}: must not be negative, got {value!r}')
	return number(value, name)


def _ofGrout(grout):
	if grout is None:
		return {}
	if not number(grout.stiffness, 'grout: stiffness') > 0:
		raise ValueError(f'grout: its stiffness must be positive and finite [N/m²], got {grout.stiffness}')
	return dict(
		groutStiffness=number(grout.stiffness, 'grout: stiffness'),
		groutStrength=number(grout.strength, 'grout: strength'),
		groutedLength=_given(grout.length, 'grout: length'),
	)


def _ofDowel(dowel):
	if dowel is None:
		return {}
	if not number(dowel.stiffness, 'dowel: stiffness') > 0:
		raise ValueError(f'dowel: its stiffness must be positive and finite [N/m], got {dowel.stiffness}')
	return dict(dowelStiffness=number(dowel.stiffness, 'dowel: stiffness'), dowelStrength=number(dowel.strength, 'dowel: strength'))
