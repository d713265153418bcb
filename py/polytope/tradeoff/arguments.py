# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of polytope.tradeoff()'s arguments, made before anything runs."""

import inspect
import json
import math
import numbers
import pathlib

import numpy as np

from .. import _builds
from ..precision import isNumber
from .effect import settable

__all__ = ['checkArguments', 'checkedSettings', 'checkNumbers', 'checkReference', 'ofTheScene', 'placeOf']

ofTheScene = ('timeStep', 'timeStepFactor', 'precision')


def placeOf(name, function):
	"""Where another process finds it."""
	code = getattr(function, '__code__', None)
	if code is None or function.__qualname__ != function.__name__ or function.__name__ == '<lambda>':
		raise ValueError(f'{name}: must be a function written with def at the top of a file, got {function!r}')
	file = pathlib.Path(code.co_filename).resolve()
	if not file.is_file():
		raise ValueError(f'{name}: must be written in a file, so that other processes can load it; {code.co_filename} is none')
	return {'module': function.__module__, 'file': str(file), 'name': function.__name__}


def checkedSettings(settings):
	"""name → changes, a copy in kinds that another process understands (numbers of NumPy become Python's).

	:raises ValueError: naming the setting and what is wrong with it
	"""
	if not isinstance(settings, dict) or not settings:
		raise ValueError(f"settings: must be a dictionary with at least one entry, {{'as it is': {{}}}} for example, got {settings!r}")
	return {name: _checkedChanges(name, changes) for name, changes in settings.items()}


def _checkedChanges(setting, changes):
	if not isinstance(setting, str):
		raise ValueError(f'settings: names must be texts, got {setting!r}')
	if not isinstance(changes, dict):
		raise ValueError(f'settings[{setting!r}]: must be a dictionary, {{}} for the scene as it is, got {changes!r}')
	checked = {}
	for name, value in changes.items():
		where = f'settings[{setting!r}][{name!r}]'
		try:
			checked[name] = json.loads(json.dumps(value, default=_plain))
		except (TypeError, ValueError) as error:
			raise ValueError(f'{where}: only texts, numbers, and lists and dictionaries of them reach another process, got {value!r}') from error
		if name in ('timeStep', 'timeStepFactor') and not (_isNumber(checked[name]) and 0 < checked[name] < math.inf):
			raise ValueError(f'{where}: must be a number above 0, got {value!r}')
		if name in settable and value is None:
			raise ValueError(f'{where}: must be what {name} of the contact functor is to be, got None; leave it out to keep what it is')
	if {'timeStep', 'timeStepFactor'} <= checked.keys():
		raise ValueError(f'settings[{setting!r}]: has both timeStep and timeStepFactor; give one of them')
	if 'precision' in checked:
		_builds.available(checked['precision'])
	return checked


def checkArguments(build, settings):
	""":raises ValueError: naming the setting: what it changes is neither the contact functor's nor the scene's, and no argument of *build* either"""
	for setting, changes in settings.items():
		arguments = [name for name in changes if name not in settable and name not in ofTheScene]
		try:
			inspect.signature(build).bind(**dict.fromkeys(arguments))
		except TypeError as error:
			known = ', '.join((*settable, *sorted(ofTheScene)))
			raise ValueError(f'settings[{setting!r}]: build(): {error}; what is not an argument of it must be one of {known}') from None


def _plain(value):
	if isinstance(value, (np.generic, np.ndarray)):
		return value.tolist()
	raise TypeError


def _isNumber(value):
	return isNumber(value) and not isinstance(value, bool)


def checkReference(reference, settings):
	if isinstance(reference, str):
		if reference not in settings:
			raise ValueError(f'reference: {reference!r} is none of the settings, {list(settings)}')
		return
	if isinstance(reference, dict):
		raise ValueError('reference: must be a number or list; of a dict that measure() returns the first entry is what it is compared with')
	try:
		values = [float(one) for one in reference] if hasattr(reference, '__len__') else [float(reference)]
	except (TypeError, ValueError):
		values = []
	if not values or not all(map(math.isfinite, values)):
		raise ValueError(f'reference: must be a finite number, a list of such, or the name of a setting, got {reference!r}')


def checkNumbers(repeats, timedSeconds, timeLimit):
	if not isinstance(repeats, numbers.Integral) or isinstance(repeats, bool) or repeats < 1:
		raise ValueError(f'repeats: must be a whole number, at least 1, got {repeats!r}')
	if not (_isNumber(timedSeconds) and 0 <= timedSeconds < math.inf):
		raise ValueError(f'timedSeconds: must be at least 0 [s], got {timedSeconds!r}')
	if timeLimit is not None and not (_isNumber(timeLimit) and 0 < timeLimit < math.inf):
		raise ValueError(f'timeLimit: must be above 0 [s], or None for no limit, got {timeLimit!r}')
