# SPDX-License-Identifier: GPL-2.0-or-later
"""Help texts of the plug-in's classes as plain text: defaults as values, no roles of Sphinx, formulas in Unicode where they are short.

YADE keeps the texts as its own documentation needs them, with C++ expressions for defaults. help() and `?` show what is made of them here.
"""

import re

import yade
from yade import _polytope

__all__ = ['classes', 'plain', 'rewrite']

classes = (
	'BartonBandisStrength BaseMotion Bo1_Polytope_Aabb ContinuouslyYieldingStrength Gl1_Polytope Gl1_PolytopeGeom HyperbolicClosure Ig2_Box_Polytope_PolytopeGeom Ig2_Facet_Polytope_PolytopeGeom Ig2_Polytope_Polytope_PolytopeGeom '
	'Ig2_Sphere_Polytope_PolytopeGeom Ig2_Wall_Polytope_PolytopeGeom Ip2_RockJointMat_RockJointMat_RockJointPhys '
	'Law2_PolytopeGeom_RockJointPhys_MohrCoulomb Polytope PolytopeBolt PolytopeBoltCrossing PolytopeBolts PolytopeBond PolytopeBonds PolytopeCheckpoint PolytopeCollider PolytopeFamilyBound PolytopeGeom PolytopeGeomFunctor PolytopeMarginFunctor PolytopeTimeStepper '
	'PolytopeVTKRecorder PolytopeWater PowerClosure QuietBoundary RockJointMat RockJointPhys VelocityHistory'
).split()

signs = {
	r'\\(?:vec|text|mathrm|left|right|,|;|!)(?![a-z])': '',
	r'\\cdot': '·',
	r'\\times': '×',
	r'\\leq?(?![a-z])': '≤',
	r'\\geq?(?![a-z])': '≥',
	r'\\(tan|sin|cos|log|max|min)': r'\1 ',
	r'\\sqrt\{([^{}]*)\}': r'√(\1)',
	r'\\sqrt': '√',
	r'\\frac(\d)(\d)': r'\1/\2',
	r'\\frac\{([^{}]*)\}\{([^{}]*)\}': r'(\1)/(\2)',
}
"""Commands of LaTeX → what stands for them in plain text."""
letters = {
	'alpha': 'α',
	'beta': 'β',
	'Delta': 'Δ',
	'lambda': 'λ',
	'mu': 'μ',
	'nu': 'ν',
	'omega': 'ω',
	'phi': 'φ',
	'Phi': 'Φ',
	'pi': 'π',
	'psi': 'ψ',
	'rho': 'ρ',
	'sigma': 'σ',
	'tau': 'τ',
	'zeta': 'ζ',
}


def formula(latex):
	for name, letter in letters.items():
		latex = re.sub(rf'\\{name}(?![a-z])\s?', letter, latex)
	for pattern, sign in signs.items():
		latex = re.sub(pattern, sign, latex)
	return latex.replace('{', '').replace('}', '').replace('\\', '').strip()


def plain(text, default=None):
	"""The text without markup.

	:param default: value of the attribute that it describes
	"""
	text = re.sub(r':ydefault:`(?:[^`]*)`', '' if default is None else f'Default: {default!r}.', text)
	text = re.sub(r'\.\. ystaticattr:: \w+\.(\w+)\(=(.*)\)\n', r'\1, default \2:\n', text)
	text = re.sub(r'\s*:yattr(?:type|flags):`[^`]*`', '', text)
	text = re.sub(r':\w+:`([^`<]*?)\s*<[^`]*>`', r'\1', text)
	text = re.sub(r':\w+:`([^`]*)`', r'\1', text)
	text = re.sub(r'\$([^$]+)\$', lambda found: formula(found[1]), text)
	text = re.sub(r'\[(\w+)\]_', r'[\1]', text)
	return text.replace('``', '').strip()


def rewrite():
	"""Rewrites the texts of all these classes, and of their attributes; those of YADE's own base classes stay."""
	for function in (_polytope.contact, _polytope.buildInfo):
		function.__doc__ = plain(function.__doc__)
	_rewriteClass(_polytope.Contact, None)
	for name in classes:
		one = getattr(yade, name, None)
		if one is not None:  # Gl1_Polytope in a YADE without OpenGL
			_rewriteClass(one, one())


def _rewriteClass(one, instance):
	one.__doc__ = plain(one.__doc__ or '')
	for key, member in list(vars(one).items()):
		if isinstance(member, property) and member.__doc__:
			setattr(one, key, property(member.fget, member.fset, member.fdel, plain(member.__doc__, _value(instance, key))))


def _value(instance, key):
	try:
		return getattr(instance, key)
	except Exception:  # what an empty instance does not have
		return None
