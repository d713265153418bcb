# SPDX-License-Identifier: GPL-2.0-or-later
"""Options of the paper's scripts: what the types refuse, and what counts as the reference."""

import argparse
import pathlib
import sys
from types import SimpleNamespace

import pytest
from boon2012.reporting.options import (
	Decreasing,
	angle,
	count,
	existingFile,
	fraction,
	isReference,
	notNegative,
	number,
	paperParser,
	positive,
	refusing,
	shown,
)


@pytest.mark.parametrize(
	'parse,text,value',
	[
		(positive, '1e7', 1e7),
		(notNegative, '0', 0),
		(fraction, '0', 0),
		(angle, '89.9', 89.9),
		(count, '1e5', 100000),
		(number(least=0.5, most=1), '1', 1),
		(number(least=-1, whole=True), '-1', -1),
		(number(), '-3', -3),
	],
)
def testGoodNumbers(parse, text, value):
	assert parse(text) == value


def testWholeNumbersAreInt():
	assert isinstance(count('7'), int) and isinstance(positive('7'), float)


@pytest.mark.parametrize(
	'parse,texts,rule',
	[
		(positive, ('0', '-1', 'nan', 'inf', 'x', ''), 'a number, above 0'),
		(notNegative, ('-0.1',), 'a number, at least 0'),
		(fraction, ('1', '-0.1'), 'a number, at least 0 and below 1'),
		(angle, ('0', '90'), 'a number, above 0 and below 90'),
		(count, ('0', '1.5'), 'a whole number, at least 1'),
		(number(least=0.5, most=1), ('0.4', '1.1'), 'a number, at least 0.5 and at most 1'),
		(number(), ('inf',), 'a number'),
	],
)
def testBadNumbersAreRefused(parse, texts, rule):
	for text in texts:
		with pytest.raises(argparse.ArgumentTypeError) as refused:
			parse(text)
		assert str(refused.value) == f'must be {rule}, got {text!r}'


def testMissingFileIsRefused(tmp_path):
	with pytest.raises(argparse.ArgumentTypeError, match='there is no file'):
		existingFile(str(tmp_path / 'none.json'))
	assert existingFile(__file__) == pathlib.Path(__file__)


@pytest.fixture
def parser(tmp_path, monkeypatch):
	(tmp_path / 'geometry').mkdir()
	(tmp_path / 'geometry/x.json').write_text('{}')
	monkeypatch.setattr(sys, 'argv', [str(tmp_path / 'x_script.py')])
	parser = paperParser('What it is.\n\nMore.', quick='less', geometry='x.json')
	parser.add_argument('--steps', type=positive, nargs='+', action=Decreasing, default=[1.0, 0.1])
	return parser


def testCommonOptions(parser, tmp_path):
	given = parser.parse_args([])
	assert given.geometry == tmp_path / 'geometry/x.json' and given.output == pathlib.Path('output/x_script')
	assert not given.quick and not given.no_pictures and parser.description == 'What it is.'


def testReferenceIsWhatHasNoOtherSettings(parser, tmp_path, monkeypatch):
	monkeypatch.chdir(tmp_path)

	def reference(*options, **how):
		return isReference(parser, parser.parse_args(options), **how)

	assert reference() and reference('--quick', '--no-pictures', '--output', 'other')
	assert reference('--geometry', 'geometry/x.json', '--steps', '1', '0.1')
	assert not reference('--steps', '1', '0.2') and reference('--steps', '1', '0.2', besides=['steps'])
	(tmp_path / 'other.json').write_text('{}')
	assert not reference('--geometry', 'other.json')


def testStepsMustDecrease(parser, capsys):
	with pytest.raises(SystemExit):
		parser.parse_args(['--steps', '1', '1'])
	assert '--steps: each must be smaller' in capsys.readouterr().err


@pytest.mark.parametrize('error', [ValueError, FileNotFoundError])
def testRefusingNamesTheOption(parser, capsys, error):
	with pytest.raises(SystemExit) as ended, refusing(parser, '--geometry'):
		raise error('no wedge')
	assert ended.value.code == 2 and '--geometry: no wedge' in capsys.readouterr().err


def testShownOptionsArePlain():
	given = SimpleNamespace(start=70.0, steps=[1, 0.1], quick=False, geometry=pathlib.Path('a'), output='out', blocks=object(), edge=None)
	assert shown(given) == {'start': 70.0, 'steps': [1, 0.1], 'quick': False, 'geometry': 'a', 'edge': 'None'}
