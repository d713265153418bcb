# SPDX-License-Identifier: GPL-2.0-or-later
"""Links within a folder of HTML files that lead nowhere."""

import pathlib
import urllib.parse
from html.parser import HTMLParser

__all__ = ['broken']


class Page(HTMLParser):
	"""What a page links to, and the places in it that can be linked to."""

	def __init__(self, path):
		super().__init__()
		self.targets, self.places = [], {''}
		self.feed(path.read_text())

	def handle_starttag(self, tag, attributes):
		for key, value in attributes:
			if key == 'id' or (tag == 'a' and key == 'name'):
				self.places.add(value)
			elif key in ('href', 'src') and value is not None:
				self.targets.append(value)


def broken(folder):
	"""A line for each link whose file or place is not in the folder; those to other sites are not followed."""
	folder = pathlib.Path(folder).resolve()
	read = {path: Page(path) for path in sorted(folder.rglob('*.html'))}
	return [
		f'{path.relative_to(folder)}: {target} leads nowhere'
		for path, page in read.items()
		for target in page.targets
		if not leads(path, target, read)
	]


def leads(path, target, read):
	parts = urllib.parse.urlsplit(target)
	if parts.scheme or parts.netloc:
		return True
	aim = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
	if aim in read:
		return urllib.parse.unquote(parts.fragment) in read[aim].places
	return aim.is_file()
