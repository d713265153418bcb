# SPDX-License-Identifier: GPL-2.0-or-later
"""Help texts of YADE's classes as reST for Sphinx: YADE's roles, and formulas between dollars.

YADE's own site has roles for Sphinx in its conf.py; its texts need no more than what is here.
"""

import re

__all__ = ['attribute', 'boost', 'example', 'indented', 'links', 'object_', 'rest', 'separate', 'staticAttributes', 'title', 'wrapper']

flags = {1: 'not saved', 2: 'read only'}
"""Flags of YADE's attributes (its lib/serialization) that a script notices."""
types = {
	'Real': 'float',
	'string': 'str',
	'std::string': 'str',
	'Vector3r': 'Vector3',
	'Quaternionr': 'Quaternion',
	'Body::id_t': 'int',
	'long': 'int',
}
role = re.compile(r'\s*:(ydefault|yattrtype|yattrflags):`([^`]*)`')
signature = re.compile(r'^\s*\w+\((.*?)\) -> (\w+) :\n(.*)$', re.DOTALL)
static = re.compile(r'\.\. ystaticattr:: \w+\.(\w+)\(=(.*)\)\n\n((?:\t.*\n|\n)*)')
wrapper = 'https://yade-dem.org/doc/yade.wrapper.html#yade.wrapper.'


def title(text, line='='):
	return f'{text}\n{line * len(text)}\n\n'


def indented(text):
	return ''.join(f'   {line}\n' if line.strip() else '\n' for line in text.split('\n'))


def boost(text):
	"""Arguments, kind of result and text of a function that is written in C++, from what Boost.Python says of it."""
	given, result, said = signature.match(text).groups()
	arguments = re.sub(r'\(\w+\)|[\[\]]', '', given).replace(' ,', ',').strip()
	arguments = re.sub(r'(?:^|, )arg1\b(?:, )?', '', arguments)
	return arguments, result, re.sub(r'^ {4}', '', said, flags=re.MULTILINE).strip()


def links(text):
	"""The name of a page in docs/ becomes a link to it."""
	return re.sub(r'`{0,2}\bdocs/([\w-]+)\.md\b`{0,2}', r':doc:`/\1`', text)


def separate(text):
	""":param a, b: becomes one field for each, which Sphinx needs."""

	def each(found):
		return '\n'.join(f':param {name}:{found[2]}' for name in found[1].split(', '))

	return re.sub(r'^:param ([^:\n]*, [^:\n]*):(.*(?:\n[ \t]+.*)*)', each, text, flags=re.MULTILINE)


def example(text):
	"""What the page of an example is called, where the text names one; None otherwise."""
	found = re.search(r'(?:^|\s)examples/([\w/-]+)\.py\b', text)
	return found and found[1]


def object_(text):
	"""The full name of what code in a sentence is: polytope.NAME(…) or a class of YADE; without a meaning for other code."""
	found = re.match(r'(polytope\.\w+|[A-Z]\w+)(?![\w.])', text)
	return found and f'yade.{found[1]}'


def attribute(text):
	"""The text of an attribute without YADE's roles, and what they say.

	:returns: text, type as Python calls it (or None), whether it has a default, [what its flags mean]
	"""
	said = dict(role.findall(text))
	kind = said.get('yattrtype')
	if kind:
		kind = re.sub(r'^(?:std::)?vector<(.*)>$', 'list', types.get(kind, kind))
		kind = re.sub(r'^shared_ptr<(.*)>$', r'\1', kind)
	bits = int(said.get('yattrflags') or 0)
	return role.sub('', text).strip(), kind, 'ydefault' in said, [meaning for bit, meaning in flags.items() if bits & bit]


def staticAttributes(text):
	"""The text of a class without its static attributes, and [(name, default, text)] of these: YADE writes them there."""
	return static.sub('', text).strip(), [(name, default, ' '.join(said.split())) for name, default, said in static.findall(text)]


def rest(text, own):
	"""The text as reST.

	:param own: names of the classes that this site has; other ones are YADE's, and are on its site
	"""

	def reference(found):
		shown, target = re.fullmatch(r'(?s)(.*?)(?:\s*<([^>]*)>)?', found[1]).groups()
		target = target or shown
		first = target.split('.')[0]
		return f':py:obj:`{shown} <yade.{target}>`' if first in own else f'`{shown} <{wrapper}{target}>`__'

	text = re.sub(r'(?<!\\)\$([^$]+)\$', lambda found: f':math:`{found[1].strip()}`', text)
	return links(separate(re.sub(r':yref:`([^`]*)`', reference, text)))
