# SPDX-License-Identifier: GPL-2.0-or-later
"""The installed builds of YADE, one for each precision, and how to start Python with one of them."""

import os
import pathlib

import yade
import yade.config

__all__ = ['available', 'environment', 'finest', 'precisions', 'present']

precisions = ('double', 'longdouble', 'float128', 'mpfr150')
"""Precisions by the names of Debian's builds: 53, 64 and 113 bits, and 150 decimal digits."""


def present():
	"""The one this process runs with."""
	return pathlib.Path(yade.config.libDir).name.removeprefix('yade-')


def _folders(precision):
	"""(of YADE's own Python package, of its libraries with the plug-in among them)."""
	package = pathlib.Path(yade.__file__).resolve().parent.parent  # …/yade-double/py
	name = f'yade-{precision}'
	return package.parent.with_name(name) / 'py', pathlib.Path(yade.config.libDir).with_name(name)


def available(precision):
	"""Whether YADE is installed in this precision and the plug-in was built for it.

	:raises ValueError: naming *precision* if there is no such
	"""
	if precision not in precisions:
		raise ValueError(f'precision: must be one of {precisions}, got {precision!r}')
	package, libraries = _folders(precision)
	return precision == present() or (package.is_dir() and (libraries / 'libpolytope.so').is_file())


def finest(among=precisions):
	"""The finest of those that are available."""
	return [precision for precision in precisions if precision in among and available(precision)][-1]


def environment(precision):
	"""Environment of a process in which `import yade` is YADE in this precision; one thread unless OMP_NUM_THREADS says more."""
	package, _ = _folders(precision)
	others = [path for path in os.environ.get('PYTHONPATH', '').split(os.pathsep) if path and pathlib.Path(path).parent.name[:5] != 'yade-']
	# started by a rank of mpirun, it must not take itself for that rank
	own = {name: value for name, value in os.environ.items() if not name.startswith(('OMPI_', 'PMIX_', 'PRTE_', 'PMI_'))}
	return {'OMP_NUM_THREADS': '1', **own, 'PYTHONPATH': os.pathsep.join([str(package), *others])}
