# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages of the functions of yade.polytope, by topic, for Sphinx's autodoc."""

import classPages
from yade import polytope
from yadeText import boost, indented, rest, title

__all__ = ['modules', 'topics', 'write']

topics = {
	'bodies': (
		'Bodies',
		'fromHalfSpaces fromVertices regular cuboid polygon prism frustum fromMesh readShapes writeShapes clump withoutOverlap split withShape',
	),
	'ground': ('Fixed pieces and ground', 'plates tube terrain facets'),
	'grains': ('Random grains', 'randomGrain grains cloud'),
	'rock': (
		'Jointed rock and cells',
		'jointedRock JointSet Joint JointedRock readJoints meshRegion regionWithout rockReport RockReport scanLine stereonet keyBlocks KeyBlock '
		'voronoi VoronoiCells',
	),
	'bonding': ('Bonds and breakage', 'bond bonds breakGrains'),
	'support': ('Rock bolts, cables, linings', 'bolt Grout Dowel bolts boltArrays lining Adhesion'),
	'scene': (
		'Scenes',
		'engines check run settle NotAtRest water stableTimeStep checkpoint continueFrom picture animate Film arrays contact buildInfo',
	),
	'dynamics': ('Shaken scenes', 'velocityHistory baseMotion quietBoundary'),
	'stress': ('Stress, excavation, factor of safety', 'inSitu excavate history factorOfSafety FactorOfSafety limitAnalysis LimitAnalysis'),
	'loading': ('Samples and loading tests', 'pack sample triaxial oedometer simpleShear shearBox'),
	'measures': (
		'Measures',
		'bodyStress contactFabric particleFabric porosity coordinationNumber sizeDistribution aabbExtrema mechanicalEnergy '
		'contactRose particleRose forceHistogram',
	),
	'extensions': ('Classes of others', 'load extensions'),
	'costs': ('Accuracy and cost', 'tradeoff'),
}
"""Page, title, names. tests/yade/project/test_site.py sees to it that each public name is in one of them."""

returned = {
	'support': ('bonding.bolting.BoltArrays', 'rock.lining.Lining', 'rock.lining.LiningForces'),
	'scene': (
		'measures.arrays.BodyArrays',
		'measures.arrays.ContactArrays',
		'check.findings.Check',
		'check.findings.Finding',
		'rest.unrest.Restless',
	),
	'loading': (
		*('loading.walls.WalledSample', 'loading.cell.PeriodicSample'),
		*('loading.triaxial.Triaxial', 'loading.oedometer.Oedometer', 'loading.simpleShear.SimpleShear', 'loading.shearBox.ShearBox'),
	),
	'extensions': ('extensions.Extension',),
	'costs': ('tradeoff.TradeoffTable', 'tradeoff.Row'),
}
"""Classes of what functions of a topic return, which have no public name."""

inner = (
	'axes, titles, hold, measure, begin, note, until, move, replace, mustBePresent, close, deviation, inertialRate, '
	'count, index, append, clear, copy, extend, insert, pop, remove, reverse, sort'
)
"""Members of these that no script needs, or that lists and tuples have."""

modules = ('frictionReduction', 'strengthReduction', 'motionRecord', 'mpi')
"""Modules that are imported by their own names."""


def entry(name):
	if name in classPages.functions:
		arguments, result, text = boost(classPages.functions[name])
		return f'.. py:function:: {name}({arguments}) -> {result}\n\n{indented(rest(text, classPages.own))}\n'
	found = getattr(polytope, name)
	if not isinstance(found, type):
		return f'.. autofunction:: {name}\n\n'
	inherits = found.__base__.__module__.startswith('yade.polytope.')
	return f'.. autoclass:: {name}\n   :members:\n' + ('   :inherited-members:\n\n' if inherits else '\n')


def contactClass():
	"""What contact() returns."""
	said, members = classPages.contact
	text = f'.. py:class:: Contact\n\n   {said}\n\n'
	return text + ''.join(f'   .. py:attribute:: {key}\n\n      {rest(one, classPages.own)}\n\n' for key, one in members.items())


def summary(names):
	return '.. autosummary::\n   :nosignatures:\n\n' + ''.join(f'   ~yade.polytope.{name}\n' for name in names) + '\n'


def topic(page):
	caption, names = topics[page]
	text = title(caption) + '.. py:currentmodule:: yade.polytope\n\n' + ''.join(map(entry, names.split()))
	if page == 'scene':
		text += contactClass()
	if returned.get(page):
		text += title('What they return', '-')
		text += ''.join(
			f'.. autoclass:: yade.polytope.{one}\n   :members:\n   :inherited-members:\n   :exclude-members: {inner}\n\n'
			for one in returned[page]
		)
	return text


def index():
	text = title('Functions and classes') + 'Python functions are in ``yade.polytope``, classes in ``yade``, like all of YADE\'s. '
	text += 'Lengths are in m, angles in rad, all units SI.\n\n'
	text += '.. code-block:: python\n\n   from yade import *\n   from yade import polytope\n\n'
	text += (
		'.. toctree::\n   :hidden:\n\n' + ''.join(f'   {page}\n' for page in (*topics, 'modules', *classPages.groups, 'references')) + '\n'
	)
	for page, (caption, names) in topics.items():
		text += title(caption, '-') + f'On one page: :doc:`{page}`.\n\n' + summary(names.split())
	text += title('Modules', '-') + ''.join(f'* :py:mod:`yade.polytope.{name}`\n' for name in modules) + '\n'
	text += title('Classes of YADE', '-')
	return text + ''.join(
		f'* :doc:`{page}`: {", ".join(f":py:class:`~yade.{name}`" for name in names)}\n' for page, (_, names) in classPages.groups.items()
	)


def write(folder):
	for page in topics:
		(folder / f'{page}.rst').write_text(topic(page))
	parts = (f'{title(name, "-")}.. automodule:: yade.polytope.{name}\n   :members:\n\n' for name in modules)
	(folder / 'modules.rst').write_text(title('Modules') + 'Imported by their own names.\n\n' + ''.join(parts))
	(folder / 'index.rst').write_text(index())
