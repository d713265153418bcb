# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages of docs/, as they are; the index gets the menu, and the sections that only the site has."""

import pathlib
import re
import shutil

__all__ = ['write']

project = pathlib.Path(__file__).resolve().parents[2]
onlyHere = """
## Look it up

| question | page |
|---|---|
| Which arguments, units, errors has a function or class? | [Functions and classes](api/index.rst) |
| How is the script of an example written? | [Examples](examples/index.rst) |
| What has changed? | [Changes](changes.md) |
"""


def menu(index):
	"""A toctree for each section of the index, of the pages that its table links to."""
	text = index
	for section in re.split(r'^## ', index, flags=re.MULTILINE)[1:]:
		caption = section.split('\n')[0]
		names = re.findall(r'^\|.*\]\(([\w/-]+)\.(?:md|rst)\) \|$', section, re.MULTILINE)
		text += '\n```{toctree}\n:hidden:\n:caption: ' + caption + '\n\n' + '\n'.join(names) + '\n```\n'
	return text


def write(folder):
	for path in (project / 'docs').iterdir():
		if path.suffix in ('.md', '.png', '.gif'):
			shutil.copyfile(path, folder / path.name)
	index = (project / 'docs/index.md').read_text()
	(folder / 'index.md').write_text(menu(index + onlyHere))
	(folder / 'changes.md').write_text((project / 'CHANGELOG.md').read_text())
