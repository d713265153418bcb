# SPDX-License-Identifier: GPL-2.0-or-later
"""Help texts of functions that share arguments: each has all of them, written once."""

import inspect
import re

__all__ = ['withShared']

entry = re.compile(r'^:param (?:\w+ )?(\w+): .*(?:\n[ \t]+.*)*\n?', re.MULTILINE)
behind = re.compile(r'^:(?:returns?|raises)\b', re.MULTILINE)


def withShared(text, shared, without):
	"""A function's help text, with the arguments of another text behind its own ones.

	:param str shared: text that has the shared arguments
	:param without: names of arguments that are left out
	"""
	if not text:  # python -OO
		return text
	text = inspect.cleandoc(text) + '\n'
	added = ''.join(found[0].rstrip('\n') + '\n' for found in entry.finditer(inspect.cleandoc(shared) + '\n') if found[1] not in without)
	end = behind.search(text)
	place = end.start() if end else len(text)
	return (text[:place] + added + text[place:]).rstrip('\n')
