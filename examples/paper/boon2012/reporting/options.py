# SPDX-License-Identifier: GPL-2.0-or-later
"""Options of the paper's scripts: types that refuse invalid values, and the options that all scripts have.

In a script:

	parser = paperParser(__doc__, quick='coarser steps, with the same tolerances', geometry='e_slope.json')
	parser.add_argument('--density', type=positive, default=2500.0, help='[kg/m³]')
	parser.add_argument('--steps', type=positive, nargs='+', action=Decreasing, default=[1.0, 0.1])
	given = parser.parse_args()
	with refusing(parser, '--geometry'):
		slope = readSlope(given.geometry)
"""

import argparse
import contextlib
import math
import pathlib
import tempfile

from .script import scriptFile

__all__ = [
	'Decreasing',
	'angle',
	'contactModels',
	'contactPoints',
	'count',
	'existingFile',
	'fraction',
	'isReference',
	'notNegative',
	'number',
	'paperParser',
	'positive',
	'refusing',
	'shown',
	'writableFolder',
]

contactPoints = ('analyticCentre', 'chebyshevCentre', 'centroid')
contactModels = ('boon2012', 'surface', 'foundation', 'spring')
"""Contact models of Ig2_Polytope_Polytope_PolytopeGeom; the first is the paper's."""

ofTheRun = ('quick', 'output', 'no_pictures')
"""What paperParser() adds: how a script is run, not what it computes."""


def number(above=-math.inf, least=-math.inf, most=math.inf, below=math.inf, whole=False):
	"""An argparse type for finite numbers within limits.

	:param float above, below: limits that are out of range themselves
	:param float least, most: limits that are within range
	:param bool whole: whether only whole numbers will do; values are int then
	:returns: a function of the text; it raises argparse.ArgumentTypeError with the rule that is broken
	"""
	limits = {'above': above, 'at least': least, 'at most': most, 'below': below}
	rule = ' and '.join(f'{word} {limit:g}' for word, limit in limits.items() if math.isfinite(limit))
	rule = ', '.join(part for part in ('a whole number' if whole else 'a number', rule) if part)

	def parse(text):
		try:
			value = float(text)
		except ValueError:
			value = math.nan
		good = math.isfinite(value) and above < value < below and least <= value <= most
		if not good or whole and value != int(value):
			raise argparse.ArgumentTypeError(f'must be {rule}, got {text!r}')
		return int(value) if whole else value

	return parse


positive = number(above=0)
notNegative = number(least=0)
fraction = number(least=0, below=1)
"""A fraction such as NewtonIntegrator's damping: with 1 nothing would move."""
angle = number(above=0, below=90)
"""[°]"""
count = number(least=1, whole=True)


def existingFile(text):
	"""Path of a file that is there (argparse type)."""
	path = pathlib.Path(text)
	if not path.is_file():
		raise argparse.ArgumentTypeError(f'there is no file {text}')
	return path


def writableFolder(text):
	"""Path of a folder that files can be written to, or that can be made (argparse type). Nothing is made: another option may be refused."""
	folder = pathlib.Path(text).resolve()
	there = next(path for path in (folder, *folder.parents) if path.exists())
	try:
		tempfile.TemporaryFile(dir=there).close()
	except OSError as error:
		raise argparse.ArgumentTypeError(
			f'cannot write to {folder}: {error.strerror}; name a folder that files can be written to'
		) from None
	return folder


class Decreasing(argparse.Action):
	"""An argparse action for several numbers, each smaller than the one before: steps from coarse to fine."""

	def __call__(self, parser, namespace, values, option_string=None):
		if any(a <= b for a, b in zip(values, values[1:], strict=False)):
			raise argparse.ArgumentError(self, f'each must be smaller than the one before, got {values}')
		setattr(namespace, self.dest, values)


def paperParser(text, quick, geometry=None, noPictures='no pictures and no plots'):
	"""An argparse parser with the options that all scripts of the paper have: --quick, --output, --no-pictures.

	:param str text: the script's docstring, the first line of which describes it
	:param str quick: what --quick does
	:param str geometry: name of the default geometry file in the folder geometry/ beside the script, for the option --geometry;
	    None: no such option
	:param str noPictures: what --no-pictures does
	"""
	parser = argparse.ArgumentParser(description=text.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	script = scriptFile()
	if geometry is not None:
		default = script.parent / 'geometry' / geometry
		parser.add_argument('--geometry', type=existingFile, default=default, metavar='FILE', help='as JSON, see geometry/README.md')
	parser.add_argument('--quick', action='store_true', help=quick)
	parser.add_argument('--output', type=writableFolder, default=pathlib.Path('output') / script.stem, help='folder for all files')
	parser.add_argument('--no-pictures', action='store_true', help=noPictures)
	return parser


@contextlib.contextmanager
def refusing(parser, option):
	"""Ends the program as argparse does, with a message that names *option*, if what is done with its value raises OSError or
	ValueError."""
	try:
		yield
	except (OSError, ValueError) as error:
		parser.error(f'{option}: {error}')


def isReference(parser, given, besides=()):
	"""Whether all options have their defaults, so that results can be compared with the paper's.

	:param given: what parser.parse_args() returned
	:param besides: names of options that may differ, as attributes of *given*; those of paperParser() may anyway
	"""

	def plain(value):
		return value.resolve() if isinstance(value, pathlib.Path) else value

	names = set(vars(given)) - {*ofTheRun, *besides}
	return all(plain(getattr(given, name)) == plain(parser.get_default(name)) for name in names)


def shown(given, without=('output', 'reference')):
	"""The options as Findings takes them: {name: number, list or text}. Objects a script has made from options are left out."""
	plain = (bool, int, float, str, list, tuple, pathlib.Path, type(None))
	options = {name: value for name, value in vars(given).items() if name not in without and isinstance(value, plain)}
	return {name: value if isinstance(value, (int, float, list)) else str(value) for name, value in options.items()}
