# SPDX-License-Identifier: GPL-2.0-or-later
"""The verification pages: each names a script of at most 40 lines, whose figures are those of the page and near the closed form."""

import contextlib
import io
import pathlib
import re

import pytest

project = pathlib.Path(__file__).resolve().parents[3]
pages = sorted((project / 'docs').glob('verification-*.md'))
within = {
	'arch': None,  # in words: stands, falls
	'bolted-wedge': None,  # test_examples.py runs the script
	'housner': 0.02,
	'in-situ': None,
	'newmark': 0.01,
	'plane': 0.01,
	'roof': 0.006,
	'shear': 0.005,
	'tension-crack': 0.01,
	'toppling': None,  # test_examples.py runs the script
	'wall': None,
	'wedge': 0.01,
}
"""Largest difference between figure and closed form, over the latter."""
number = re.compile(r'-?\d+(?:\.\d+)?')
elsewhere = ('bolted-wedge', 'toppling')


def nameOf(page):
	return page.stem.removeprefix('verification-')


def scriptOf(page):
	(path,) = set(re.findall(r'`\./run python (examples/\S+\.py)` prints', page.read_text()))
	return project / path


def saidBy(page):
	return re.search(r'` prints\n\n```text\n(.*?)\n```', page.read_text(), re.DOTALL)[1]


def testEachPageHasOneShortScript():
	assert {nameOf(page) for page in pages} == set(within)
	scripts = [scriptOf(page) for page in pages]
	assert {path.name for path in (project / 'examples/verification').glob('*.py')} == {
		path.name for path in scripts if path.parent.name == 'verification'
	}
	for page, script in zip(pages, scripts, strict=True):
		assert len(script.read_text().splitlines()) <= 40, script
		assert all(f'**{part}.**' in page.read_text() for part in ('Problem', 'Closed form', 'Our figure', 'Others')), page
		assert f'({page.name})' in (project / 'docs/verification.md').read_text()


@pytest.mark.filterwarnings('ignore')
@pytest.mark.parametrize('page', [page for page in pages if nameOf(page) not in elsewhere], ids=nameOf)
def testTheScriptPrintsWhatThePageSays(page):
	script = scriptOf(page)
	with contextlib.redirect_stdout(io.StringIO()) as printed:
		exec(compile(script.read_text(), str(script), 'exec'), {'__name__': '__main__', '__file__': str(script)})
	lines, told = printed.getvalue().strip().splitlines(), saidBy(page).splitlines()
	assert [number.sub('#', line) for line in lines] == [number.sub('#', line) for line in told]
	for line, same in zip(lines, told, strict=True):
		found = [float(x) for x in number.findall(line)]
		assert found == pytest.approx([float(x) for x in number.findall(same)], rel=0.005, abs=0.02 if nameOf(page) == 'in-situ' else 0)
		if within[nameOf(page)]:
			assert found[-2] == pytest.approx(found[-1], rel=within[nameOf(page)])


def testFiguresOfPagesWhoseScriptsAreRunElsewhere():
	toppling, bolted = (saidBy(project / f'docs/verification-{name}.md') for name in ('toppling', 'bolted-wedge'))
	stands, fails, closed = (float(x) for x in number.findall(toppling))
	assert (stands + fails) / 2 == pytest.approx(closed, abs=0.3)
	for line in bolted.splitlines():
		_, found, closed = (float(x) for x in number.findall(line))
		assert found == pytest.approx(closed, rel=0.01)
