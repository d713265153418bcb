# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run docs`: the site is made without a warning, no link in it leads nowhere, and it has all functions, classes and attributes."""

import html
import importlib
import pathlib
import re
import subprocess
import sys

import pytest
import yade
from yade import polytope
from yade.polytope import _helpTexts

pytest.importorskip('sphinx', reason='Sphinx is not installed: ./run test and ./run docs install it')

project = pathlib.Path(__file__).resolve().parents[3]
programs = project / 'tools/site'


@pytest.fixture(scope='module')
def site(tmp_path_factory):
	"""Folder of the site's files."""
	folder = tmp_path_factory.mktemp('site')
	script = f'import sys; sys.path.insert(0, {str(programs)!r}); import build; sys.exit(build.build({str(folder)!r}))'
	done = subprocess.run([sys.executable, '-c', script], capture_output=True, text=True, timeout=900)
	assert done.returncode == 0 and not done.stderr, done.stderr
	return folder / 'html'


@pytest.fixture
def part(monkeypatch):
	"""part(name): one of the programs' modules that do not need the texts as they were before yade.polytope was imported."""
	monkeypatch.setattr(sys, 'path', [str(programs), *sys.path])
	return importlib.import_module


def read(site, folder=''):
	return {path.relative_to(site).as_posix(): path.read_text() for path in sorted((site / folder).glob('*.html'))}


def testEveryPageIsThere(site):
	names = {page.stem for page in (project / 'docs').glob('*.md')}
	assert names and all((site / f'{name}.html').is_file() for name in names)
	for path in (project / 'examples').glob('*.py'):
		assert path.stem in (site / f'examples/{path.stem}.html').read_text()
	assert '<img' in (site / 'index.html').read_text()


def testAllFunctionsAndClassesAreThere(site):
	places = set(re.findall(r'id="([\w.]+)"', ''.join(read(site, 'api').values())))
	assert {f'yade.polytope.{name}' for name in polytope.__all__} <= places
	assert {
		f'yade.polytope.{name}.{key}' for name in ('FactorOfSafety', 'LimitAnalysis') for key in ('factor', 'stable', 'trials')
	} <= places
	for name in _helpTexts.classes:
		texts = {key for key, one in vars(getattr(yade, name)).items() if isinstance(one, property) and one.__doc__}
		assert {f'yade.{name}', *(f'yade.{name}.{key}' for key in texts)} <= places
	assert {'yade.Gl1_Polytope.edges', 'yade.PolytopeGeomFunctor.stats'} <= places


def testPagesLinkToThem(site):
	text = (site / 'making-bodies.html').read_text()
	assert 'href="api/bodies.html#yade.polytope.cuboid"' in text and 'href="examples/funnel.html"' in text


def testAttributesHaveTypeAndDefault(site):
	text = html.unescape(re.sub(r'<[^>]*>', '', (site / 'api/joints.html').read_text()))
	assert re.search(r'cohesion: float = 0\.0', text) and 'Mohr-Coulomb strength' in text


def testNoMarkupIsLeft(site):
	for name, text in read(site, 'api').items():
		shown = re.sub(r'<(script|style)\b.*?</\1>|<[^>]*>', '', text, flags=re.DOTALL)
		assert not re.search(r':y?[a-z]+:`|``|\$|ystaticattr', shown), name


def testNothingIsLoadedFromElsewhere(site):
	for path in site.rglob('*.html'):
		tags = re.findall(r'<(?:script|link|img|iframe)\b[^>]*>', path.read_text())
		assert tags and not [tag for tag in tags if re.search(r'(?:src|href)="(?:https?:)?//', tag)], path
	for needed in ('MathJax.js', 'config/TeX-AMS_SVG.js', 'jax/output/SVG/jax.js', 'jax/output/SVG/fonts/TeX/fontdata.js'):
		assert (site / '_static/mathjax' / needed).is_file()


def testItCanBeSearched(site):
	found = (site / 'searchindex.js').read_text()
	assert found.startswith('Search.setIndex(') and 'bodyStress' in found and 'voronoi' in found


def testEachNameHasOneTopic(part):
	"""Names of functions only; classes are counted in the site itself."""
	topics = re.search(r'^topics = (\{.*?^\})', (programs / 'functionPages.py').read_text(), re.MULTILINE | re.DOTALL)
	names = [name for _, several in eval(topics[1]).values() for name in several.split()]
	assert sorted(names) == sorted(polytope.__all__)


def testLinksThatLeadNowhereAreFound(part, tmp_path):
	(tmp_path / 'a.html').write_text(
		'<a href="b.html#there">x</a><a href="#no">x</a><img src="no.png"><a href="https://example.org/no">x</a>'
	)
	(tmp_path / 'b.html').write_text('<p id="there"><a href="a.html">x</a><a href="a.html#no">x</a></p>')
	assert [line.split()[1] for line in part('links').broken(tmp_path)] == ['#no', 'no.png', 'a.html#no']


def testTextsOfYadesClasses(part):
	text = part('yadeText')
	said = 'Limit $a_i$ of :yref:`this one<Polytope.x>` and :yref:`Box`, docs/bonds.md. :ydefault:`1` :yattrtype:`Real` :yattrflags:`3` '
	said, kind, hasDefault, meanings = text.attribute(said)
	assert (kind, hasDefault, meanings) == ('float', True, ['not saved', 'read only'])
	assert text.rest(said, ['Polytope']) == (
		f'Limit :math:`a_i` of :py:obj:`this one <yade.Polytope.x>` and `Box <{text.wrapper}Box>`__, :doc:`/bonds`.'
	)
	assert (
		text.separate(':param low, high: of it\n    all\n:returns: x')
		== ':param low: of it\n    all\n:param high: of it\n    all\n:returns: x'
	)
	assert text.boost("\nf( (Law)arg1, (object)b [, (str)how='x']) -> int :\n    Does it.\n    Well.") == (
		"b, how='x'",
		'int',
		'Does it.\nWell.',
	)
	assert text.example('./run python examples/paper/f_collisions.py --quick') == 'paper/f_collisions' and text.example('examples/') is None
	assert text.object_('polytope.cuboid(center, extents)') == 'yade.polytope.cuboid' and text.object_('polytope.mpi.divide') is None
	assert text.object_('RockJointMat(density=1)') == 'yade.RockJointMat' and text.object_('O.dt') is None
