# SPDX-License-Identifier: GPL-2.0-or-later
"""README.md and docs/*.md: links, anchors, names of files and commands hold, every page is in the index, and the Python snippets run."""

import math
import os
import pathlib
import re
import runpy
import shlex
import subprocess
import sys

import pytest
import yade
import yade.utils

project = pathlib.Path(__file__).resolve().parents[3]
readme = project / 'README.md'
pages = sorted((project / 'docs').glob('*.md'))
names = [page.relative_to(project).as_posix() for page in (readme, *pages)]
longestReadme = 120
"""Lines: what one reads before trying."""
fence = re.compile(r'^( *)```(.*?)\n(.*?)^\1```$', re.MULTILINE | re.DOTALL)


def prose(text):
	"""The text without blocks of code."""
	return fence.sub('', text)


def anchors(path):
	"""Anchors of all headings, as GitHub and MyST make them."""
	found = re.findall(r'^#+ +(.+?) *$', prose(path.read_text()), re.MULTILINE)
	return [re.sub(r'[^\w\- ]', '', heading.lower()).replace(' ', '-') for heading in found]


def links(text):
	"""Targets of links and pictures, but those to other sites."""
	found = re.findall(r'\]\(([^()\s]+)\)', re.sub(r'`[^`]*`', '`', prose(text)))
	return [target for target in found if not re.match(r'https?://', target)]


@pytest.mark.parametrize('name', names)
def testLinksResolve(name):
	page = project / name
	for target in links(page.read_text()):
		path, _, anchor = target.partition('#')
		aim = (page.parent / path).resolve() if path else page
		assert aim.is_file(), f'{name}: there is no {path}'
		assert not anchor or anchor in anchors(aim), f'{name}: {aim.name} has no heading #{anchor}, but {anchors(aim)}'


def testLinksAreFound():
	"""The functions above find lines, headings and links."""
	assert links('[a](b.md#c-d) `[x](y)` ![p](q.png) [w](https://example.org)\n```\n[code](no.md)\n```\n') == ['b.md#c-d', 'q.png']
	assert anchors(project / 'docs/index.md')[0] == 'yade-polytope-documentation'


@pytest.mark.parametrize('name', names)
def testHeadingsAreNotRepeated(name):
	found = anchors(project / name)
	assert len(set(found)) == len(found), found


def filesNamedIn(text):
	return re.findall(r'(?<![\w/])(?:src|pkg|py|docs|examples|tests|tools|cmake)/[\w./-]*\w', text)


@pytest.mark.parametrize('name', names)
def testFilesThatAreNamedExist(name):
	for path in filesNamedIn((project / name).read_text()):
		assert (project / path).exists() or path == 'examples/NAME.py', f'{name}: there is no {path}'


@pytest.mark.parametrize('folder', ['src', 'pkg', 'py'])
def testFilesThatCommentsAndHelpTextsNameExist(folder):
	ofYadesLibrary = 'py/_polytope.so'  # in the folder that YADE is installed in
	found = 0
	for source in (project / folder).rglob('*'):
		if source.suffix in ('.py', '.hpp', '.cpp'):
			text = re.sub(r'^\s*#\s*include.*', '', source.read_text(), flags=re.MULTILINE)  # also of YADE's own pkg/
			for path in filesNamedIn(text):
				assert (project / path).exists() or path == ofYadesLibrary, f'{source.relative_to(project)}: there is no {path}'
				found += 1
	assert found, f'{folder} names no file'


def testPagesThatAreNamedElsewhereExist():
	"""They are named in help texts, doc strings and messages."""
	for folder in ('src', 'pkg', 'py', 'examples', 'tests', 'tools'):
		for path in (project / folder).rglob('*'):
			if path.suffix in ('.py', '.hpp', '.cpp', '.sh', '.md') and path != pathlib.Path(__file__).resolve():
				for page in re.findall(r'\bdocs/[\w-]+\.md\b', path.read_text()):
					assert (project / page).is_file(), f'{path.relative_to(project)}: there is no {page}'


@pytest.mark.parametrize('name', names)
def testCommandsThatAreNamedExist(name):
	helped = (project / 'run').read_text().split("<<'END'")[1].split('\nEND\n')[0]
	known = set(re.findall(r'^  (\w+)', helped.split('Environment:')[0], re.MULTILINE))
	assert {'demo', 'test', 'yade', 'python', 'help'} <= known
	for command in re.findall(r'(?<!\w)\./run +([a-z]+)', (project / name).read_text()):
		assert command in known, f'{name}: ./run {command}'


def commands(text):
	"""The words after `./run` of each command in blocks of code and between backquotes."""
	blocks = [line for _, kind, body in fence.findall(text) if kind in ('', 'sh') for line in body.splitlines()]
	inline = re.findall(r'`([^`]*)`', prose(text))
	found = [re.match(r'\s*\./run ([a-z].*)', line) for line in blocks + [' '.join(span.split()) for span in inline]]
	words = [re.sub(r'[|…\[\]]', ' ', one[1]) for one in found if one]  # alternatives, and what may be left out
	return [shlex.split(line, comments=True) for line in words]


def notTaken(verb, *arguments):
	"""Why `./run` refuses it, or which option the program behind it does not have; nothing if it is taken."""
	if verb == 'python':
		script = project / ''.join(arguments[:1])
		options = [word for word in arguments if word.startswith('--')]
		texts = [path.read_text() for path in (script, *script.parent.glob('boon2012/reporting/options.py')) if path.is_file()]
		return ' '.join(option for option in options if not any(f"'{option}'" in text for text in texts))
	tools = project / 'tools'
	check = f'. {shlex.quote(str(tools / "messages.sh"))}; . {shlex.quote(str(tools / "verbs.sh"))}; checkArguments "$@"'
	return subprocess.run(['bash', '-c', check, 'run', verb, *arguments], capture_output=True, text=True).stderr


@pytest.mark.parametrize('name', names)
def testCommandsTakeTheirArguments(name):
	for words in commands((project / name).read_text()):
		assert not notTaken(*words), f'{name}: ./run {" ".join(words)}: {notTaken(*words)}'


def testArgumentsThatAreNotTakenAreFound():
	found = commands('`./run search\n--pears 3` `./run COMMAND`\n```sh\n./run bench --only kernels  # x\n```\n')
	assert found == [['bench', '--only', 'kernels'], ['search', '--pears', '3']]
	assert not notTaken('bench', '--only', 'kernels') and '--pears' in notTaken('search', '--pears', '3')
	assert 'bones' in notTaken('accuracy', '--only', 'bones')
	assert notTaken('python', 'examples/paper/f_collisions.py', '--quick', '--colision', 'edgeEdge') == '--colision'


def testReadmeIsShortAndHasTheCommandsOfContinuousIntegration():
	lines = readme.read_text().splitlines()
	assert len(lines) <= longestReadme, f'{len(lines)} lines; what is more belongs into docs/'
	shell = [body for _, kind, body in fence.findall(readme.read_text()) if kind == 'sh']
	commands = [line.split('#')[0].strip() for body in shell for line in body.splitlines()]
	assert commands == ['./run demo', './run test']
	assert '/run" test "$@"' in (project / '.ci/run').read_text()


def testIndexHasEveryPage():
	text = (project / 'docs/index.md').read_text()
	others = {page.stem for page in pages} - {'index'}
	assert {target.removesuffix('.md') for target in links(text) if target.endswith('.md')} == others
	assert {target for target in links(readme.read_text()) if target.endswith('.md')} >= {f'docs/{name}.md' for name in others}


@pytest.mark.parametrize('page', pages, ids=lambda page: page.name)
def testPageSaysWhichQuestionItAnswers(page):
	title, blank, first = page.read_text().split('\n')[:3]
	assert re.match(r'# \w', title) and not blank and first.startswith('This page answers: ')


def snippets(page):
	"""Python of a page, as one program, with the page's own line numbers."""
	text, lines = page.read_text(), []
	for block in fence.finditer(text):
		if block[2] == 'python':
			start = text.count('\n', 0, block.start(3))
			lines += [''] * (start - len(lines)) + block[3].splitlines()
	return '\n'.join(lines)


def runs(page):
	"""Names after a page's snippets have run as in a script of `yade`, which has these names from the start."""
	given = {**vars(yade.utils), **vars(yade), **vars(math), '__name__': 'script'}
	given['__file__'] = str(project / 'tools/measure/benchmark/bench.py')  # docs/measuring.md is about programs there
	exec(compile(snippets(page), str(page), 'exec'), given)
	return given


prints = {
	'docs/stiffness.md': [r'wanted one: (1\.0000|0\.9999)', '^normalDamping=0.255$'],
	'docs/moving-walls.md': [r'^0\.5$', '^True$'],
	'docs/dynamics.md': [r'^0\.15[78] m, by Newmark 0\.157 m$', '^True$'],
	'docs/hopper.md': [r'^nothing was found that is wrong$', r'^[12]\.\d kg/s; empty after 0\.\d\d s$'],
	'docs/ballast.md': [r'^36 stones; porosity of the lower 5 cm: 0\.[4-7]', r'^settlement \d{1,2}\.\d mm$'],
}
"""Lines that the snippets of a page print, as its text or its comments say."""


def testTestsThatAreNamedExist():
	tests = project / 'tests/yade'
	text = (project / 'docs/verification.md').read_text()
	found = re.findall(r'`(test_\w+\.py)::(\w+)`', text)
	assert len(found) == len(re.findall(r'^\| (?!problem|---)', text, re.MULTILINE)) > 25
	for file, name in found:
		assert f'def {name}(' in next(tests.rglob(file)).read_text(), f'{file} has no {name}'


@pytest.mark.parametrize('name', [name for name in names if '```python' in (project / name).read_text()])
def testSnippetsRun(name, tmp_path, monkeypatch, capsys):
	os.makedirs(tmp_path / 'output')
	monkeypatch.chdir(tmp_path)
	monkeypatch.setattr(sys, 'path', list(sys.path))
	runs(project / name)
	said = capsys.readouterr().out
	assert all(re.search(pattern, said, re.MULTILINE) for pattern in prints.get(name, [])), said


@pytest.mark.parametrize('name', ['README.md', 'docs/first-scene.md'])
def testBlockOfTheFirstSceneRestsOnItsFace(name, tmp_path, monkeypatch):
	os.makedirs(tmp_path / 'output')
	monkeypatch.chdir(tmp_path)
	scene = runs(project / name)
	contact, weight = scene['contact'], 9.81 * yade.O.bodies[scene['block']].state.mass
	assert contact.geom.status == 'contact'
	assert (contact.geom.normal - yade.Vector3(0, 0, 1)).norm() < 1e-6, 'as README.md says'
	assert contact.phys.normalForce.norm() == pytest.approx(weight, rel=1e-6)
	assert yade.O.engines[2].geomDispatcher.functors[0].stats()['failures'] == 0


def testStrengthReductionFindsTheDip(capsys):
	"""docs/strength-reduction.md: what its comments say."""
	names = runs(project / 'docs/strength-reduction.md')
	found, safety = names['found'], names['safety']
	assert math.degrees(found.stable) == pytest.approx(29) and math.degrees(found.failed) == pytest.approx(28)
	assert safety.factor == pytest.approx(1.64, abs=0.01)
	*_, factor, _, settled = capsys.readouterr().out.splitlines()
	assert factor.startswith('factor of safety 1.54')
	assert settled.startswith('True ') and float(settled.split()[1]) < 1e-5


def testThePortedWedgeSlidesAsByLimitEquilibrium(capsys):
	"""docs/from-other-codes.md: the two figures that it prints agree, and no query was without an answer."""
	runs(project / 'docs/from-other-codes.md')
	ours, closed = map(float, capsys.readouterr().out.splitlines()[-1].split())
	assert closed == pytest.approx(9.81 * (0.5 - 0.75**0.5 * math.tan(math.radians(15)) * 2**0.5), rel=1e-12) and ours == pytest.approx(
		closed, rel=1e-4
	)
	assert yade.O.engines[2].geomDispatcher.functors[0].stats()['failures'] == 0


def testExamplesThatTheFirstPagesNameRun(tmp_path, monkeypatch, capsys):
	"""examples/hello.py, and examples/oneContact.py, which draws docs/one-contact.png."""
	monkeypatch.setattr(sys, 'argv', ['hello.py'])
	scene = runpy.run_path(str(project / 'examples/hello.py'))
	assert scene['contact'].phys.normalForce.norm() == pytest.approx(scene['weight'], rel=1e-6)
	yade.O.reset()
	picture = tmp_path / 'one-contact.png'
	monkeypatch.setattr(sys, 'argv', ['oneContact.py', str(picture)])
	names = runpy.run_path(str(project / 'examples/oneContact.py'))
	found, ahead, behind = names['found'], *names['ends']
	assert found.status == 'contact' and found.infeasibility < 0
	assert (ahead - behind).dot(found.normal) == pytest.approx(found.depth, rel=1e-12)
	assert picture.read_bytes().startswith(b'\x89PNG') and f'drawn as {picture}' in capsys.readouterr().out
