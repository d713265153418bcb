# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages of the plug-in's classes in YADE, from their help texts in C++.

yade.polytope rewrites these texts for the prompt when it is imported; so this module must come first, and keeps them as they are.
"""

import sys

if 'yade.polytope' in sys.modules:
	raise ImportError('classPages: import it before yade.polytope, which rewrites the texts')

import yade
from yade import _polytope
from yadeText import attribute, boost, indented, rest, staticAttributes, title, wrapper

__all__ = ['contact', 'functions', 'groups', 'own', 'write']

groups = {
	'shapes': (
		'Shape and contact geometry',
		(
			'Polytope PolytopeGeom PolytopeGeomFunctor PolytopeMarginFunctor Ig2_Polytope_Polytope_PolytopeGeom Ig2_Sphere_Polytope_PolytopeGeom Ig2_Facet_Polytope_PolytopeGeom '
			'Ig2_Box_Polytope_PolytopeGeom Ig2_Wall_Polytope_PolytopeGeom Bo1_Polytope_Aabb PolytopeFamilyBound Gl1_Polytope Gl1_PolytopeGeom'
		).split(),
	),
	'joints': (
		'Rock joints: material, physics, law',
		'RockJointMat HyperbolicClosure PowerClosure BartonBandisStrength ContinuouslyYieldingStrength RockJointPhys Ip2_RockJointMat_RockJointMat_RockJointPhys Law2_PolytopeGeom_RockJointPhys_MohrCoulomb'.split(),
	),
	'bonds': ('Bonds', ['PolytopeBonds', 'PolytopeBond']),
	'bolts': ('Rock bolts and cables', ['PolytopeBolts', 'PolytopeBolt', 'PolytopeBoltCrossing']),
	'engines': (
		'Engines',
		'PolytopeCollider PolytopeTimeStepper PolytopeWater PolytopeVTKRecorder PolytopeCheckpoint BaseMotion QuietBoundary VelocityHistory'.split(),
	),
}
"""Page, title, names. tests/yade/project/test_site.py sees to it that each class is in one of them."""

own = [name for _, names in groups.values() for name in names if hasattr(yade, name)]  # Gl1_Polytope: not in a YADE without OpenGL
texts = {name: (getattr(yade, name).__doc__, {key: one.__doc__ for key, one in vars(getattr(yade, name)).items()}) for name in own}
functions = {name: getattr(_polytope, name).__doc__ for name in ('contact', 'buildInfo')}
contact = _polytope.Contact.__doc__, {key: one.__doc__ for key, one in vars(_polytope.Contact).items() if isinstance(one, property)}
"""What yade.polytope has from C++: texts of the functions, of the class that contact() returns, and of its attributes."""

references = """References
==========

.. [Boon2012] C.W. Boon, G.T. Houlsby, S. Utili (2012): *A new algorithm for contact detection between convex polygonal and polyhedral
   particles in the discrete element method*, Computers and Geotechnics 44:73-82, https://doi.org/10.1016/j.compgeo.2012.05.012
.. [Hart1988] R. Hart, P.A. Cundall, J. Lemos (1988): *Formulation of a three-dimensional distinct element model. Part II: Mechanical
   calculations for motion and interaction of a system composed of many polyhedral blocks*, International Journal of Rock Mechanics and
   Mining Sciences 25:117-125
.. [Lysmer1969] J. Lysmer, R.L. Kuhlemeyer (1969): *Finite dynamic model for infinite media*, Journal of the Engineering Mechanics Division
   (ASCE) 95(4):859-877
"""


def property_(name, key, text, value):
	"""An attribute: type and default beside its name, what YADE's flags say behind its text."""
	text, kind, hasDefault, meanings = attribute(text)
	head = f'.. py:attribute:: {name}.{key}\n'
	if not kind and value is not None:
		kind = type(value).__name__
	if kind:
		head += f'   :type: {kind}\n'
	if hasDefault and 'read only' not in meanings and value is not None:
		head += f'   :value: {value!r}\n'
	text += f' *({", ".join(meanings)})*' if meanings else ''
	return f'{head}\n{indented(rest(text, own))}\n'


def method(name, key, member):
	arguments, result, text = boost(member.__doc__)
	return f'.. py:method:: {name}.{key}({arguments}) -> {result}\n\n{indented(rest(text, own))}\n'


def members(name):
	one, (_, said) = getattr(yade, name), texts[name]
	instance = one()
	for key, member in vars(one).items():
		if isinstance(member, property) and said[key]:
			yield property_(name, key, said[key], valueOf(instance, key))
		elif not key.startswith('_') and ' -> ' in (getattr(getattr(one, key), '__doc__', None) or ''):
			yield method(name, key, getattr(one, key))


def valueOf(instance, key):
	try:
		return getattr(instance, key)
	except Exception:  # what an empty instance does not have
		return None


def described(name):
	base = getattr(yade, name).__mro__[1].__name__
	shown = f':py:class:`~yade.{base}`' if base in own else f'`{base} <{wrapper}{base}>`__'
	said, static = staticAttributes(texts[name][0])
	text = f'Base: {shown}, with all of its attributes.\n\n{rest(said, own)}'
	text = f'{title(name, "-")}.. py:class:: {name}\n   :no-contents-entry:\n\n{indented(text)}\n' + ''.join(members(name))
	return text + ''.join(
		f'.. py:attribute:: {name}.{key}\n   :value: {default.capitalize()}\n\n{indented(rest(of, own))}\n' for key, default, of in static
	)


def write(folder):
	for page, (caption, names) in groups.items():
		text = f'{title(caption)}.. py:currentmodule:: yade\n\n'
		(folder / f'{page}.rst').write_text(text + ''.join(described(name) for name in names if name in own))
	(folder / 'references.rst').write_text(references)
