# SPDX-License-Identifier: GPL-2.0-or-later
"""Functors of the extensions that are loaded (docs/extending.md) for the shapes of a scene."""

import yade.wrapper
from yade import BoundFunctor, LawFunctor, PolytopeGeomFunctor, _polytope

__all__ = ['ownBounds', 'ownClasses', 'ownContacts', 'ownContactsOf', 'ownLaws']


def ownClasses(base):
	"""Classes that extensions derive from this class of YADE's or the plug-in's, in the order in which they were loaded."""
	names = (name for _, _, classes in _polytope.extensions() for name in classes)
	return [made for made in (getattr(yade.wrapper, name) for name in names) if issubclass(made, base)]


def ownFunctors(base):
	"""Functors of extensions that are made for classes of their own: not those that only serve several as their base."""
	made = []
	for functor in ownClasses(base):
		try:
			bases = functor().bases
		except RuntimeError:  # of YADE: without FUNCTOR2D
			continue
		if bases:
			made.append(functor)
	return made


def _steps(shape, base):
	"""How many classes a class of shapes, by its name, is derived from another; None: it is not."""
	made, known = getattr(yade.wrapper, shape, None), getattr(yade.wrapper, base, None)
	return made.__mro__.index(known) if made and known and issubclass(made, known) else None


def _stepsOfPair(bases, one, other):
	"""Steps of derivation from two classes to those that a functor is made for, in the order that is nearer; None: it is made for others."""
	if len(bases) != 2:
		return None
	ways = [(_steps(one, first), _steps(other, second)) for first, second in (bases, bases[::-1])]
	return min((sum(way) for way in ways if None not in way), default=None)


def ownContactsOf(one, other):
	"""Names of the contact functors that extensions have for two classes of shapes, by their names, or for the nearest that these are
	derived from."""
	steps = {made.__name__: _stepsOfPair(made().bases, one, other) for made in ownFunctors(PolytopeGeomFunctor)}
	fitting = {name: count for name, count in steps.items() if count is not None}
	return [name for name, count in fitting.items() if count == min(fitting.values())]


def ownContacts(shapes, functors):
	"""Contact functors of extensions for pairs of these classes of shapes (names) that none of *functors* is made for. Where several are
	made for the same pair the choice is the user's, and none of them is among these."""
	taken = {tuple(sorted(functor.bases)) for functor in functors}
	pairs = {}
	for made in ownFunctors(PolytopeGeomFunctor):
		bases = made().bases
		if any(_stepsOfPair(bases, one, other) is not None for one in shapes for other in shapes):
			pairs.setdefault(tuple(sorted(bases)), []).append(made)
	return [several[0]() for pair, several in pairs.items() if pair not in taken and len(several) == 1]


def ownBounds(shapes, functors):
	"""Bound functors of extensions for these classes of shapes (names), and those that YADE has for shapes of its own that extensions
	have contacts for. If there are several for one class, the first."""
	taken = {base for functor in functors for base in functor.bases}
	made = [own() for own in ownFunctors(BoundFunctor)]
	touched = {base for own in ownContacts(shapes, []) for base in own.bases}
	yades = (getattr(yade.wrapper, f'Bo1_{shape}_Aabb', None) for shape in sorted(touched))
	chosen = {}
	for functor in [*made, *(kind() for kind in yades if kind)]:
		(base,) = functor.bases
		if base not in taken and any(_steps(shape, base) is not None for shape in shapes):
			chosen.setdefault(base, functor)
	return list(chosen.values())


def ownLaws(contacts, physics, laws):
	"""Laws of extensions for just what these contact functors and Ip2 functors make and none of *laws* is made for. Where several are, the
	choice is the user's, and none of them is among these."""
	geoms, phys = ({type(functor).__name__.rsplit('_', 1)[-1] for functor in functors} for functors in (contacts, physics))
	taken, pairs = [law.bases for law in laws], {}
	for made in ownFunctors(LawFunctor):
		bases = made().bases
		if len(bases) == 2 and bases[0] in geoms and bases[1] in phys and bases not in taken:
			pairs.setdefault(tuple(bases), []).append(made)
	return [several[0]() for several in pairs.values() if len(several) == 1]
