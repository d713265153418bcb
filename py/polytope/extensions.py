# SPDX-License-Identifier: GPL-2.0-or-later
"""Libraries of others with classes of their own (docs/extending.md): shapes, contacts, physics, laws."""

import collections
import os
import pathlib
import sys

import yade.wrapper
from yade import _polytope

__all__ = ['Extension', 'extensions', 'load']

variable = 'YADE_POLYTOPE_EXTENSIONS'
"""Paths of extensions, separated by colons, which YADE loads when it starts."""

Extension = collections.namedtuple('Extension', 'path name classes')
Extension.__doc__ = (
	"""A library that is loaded: its *path* (str), the *name* it was built with and the names of its *classes* (tuple of str)."""
)


def extensions():
	"""The extensions that are loaded, by *load*, by the environment or from the folder of extensions.

	:returns: list of (path, name, classes), see *Extension*
	"""
	return [Extension(*one) for one in _polytope.extensions()]


def load(path):
	"""Load an extension: a library that was built by ``yade_polytope_add_extension`` (docs/extending.md).

	Its classes are then YADE's like any other: in ``yade.wrapper``, and in the script by their names. Processes that are started from this one, as by
	*tradeoff* and *check*, load it, too: its path is added to the environment variable YADE_POLYTOPE_EXTENSIONS. Loaded already: nothing is done.

	:param str path: of the library; its name does not matter
	:returns: what was loaded: (path, name, classes), see *Extension*
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: naming *path* and the reason where it does not fit: no path, a folder, a file that is cut off, built for another
	    precision, another YADE or another version of this plug-in, no extension at all, a class or normal law whose name there is already,
	    a class that has the index of another
	"""
	if not isinstance(path, (str, os.PathLike)):
		raise ValueError(f'path: must be the path of a library that yade_polytope_add_extension has built, got {path!r}')
	file = pathlib.Path(path).resolve()
	if not file.exists():
		raise FileNotFoundError(f'path: there is no file {file}; build the extension first (docs/extending.md)')
	try:
		extension = Extension(*_polytope.loadExtension(str(file)))
	except RuntimeError as error:
		raise ValueError(f'path: the extension {file} is not loaded: {error}') from None
	_makeKnown(extension.classes)
	paths = [one for one in os.environ.get(variable, '').split(os.pathsep) if one]
	if str(file) not in paths:
		os.environ[variable] = os.pathsep.join([*paths, str(file)])
	return extension


def _makeKnown(classes):
	"""Makes these classes names of the script, which has YADE's own classes from its start."""
	script = vars(sys.modules['__main__'])
	for name in classes:
		made = getattr(yade.wrapper, name)
		setattr(yade, name, made)
		script.setdefault(name, made)
