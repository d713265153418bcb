# SPDX-License-Identifier: GPL-2.0-or-later
"""The documentation as a site of static files, build/docs/html/index.html: the program behind `./run docs`.

Sphinx makes it from docs/*.md, from the help texts of the functions and classes, and from examples/. A warning of Sphinx, and a link that
leads nowhere, ends it with 1. Links to other sites are not followed: the site is made, and works, without a network.
"""

import argparse
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import classPages  # before yade.polytope: it reads YADE's texts as they are
import examplePages
import functionPages
import links
import pages
from sphinx.cmd.build import build_main

project = pathlib.Path(__file__).resolve().parents[2]
mathjax = pathlib.Path('/usr/share/javascript/mathjax')
mathjaxParts = (
	*('MathJax.js', 'config/TeX-AMS_SVG.js', 'extensions', 'jax/element', 'jax/input/TeX'),
	*(f'jax/output/SVG/{name}' for name in ('config.js', 'jax.js', 'autoload', 'fonts/TeX')),
)
"""Parts of Debian's libjs-mathjax that show TeX as SVG. Its glyphs are scripts, which a browser loads from a folder, too."""


def writeSources(folder):
	"""What Sphinx reads: the pages as they are in docs/, and those that are made here."""
	pages.write(folder)
	reference = folder / 'api'
	reference.mkdir()
	functionPages.write(reference)
	classPages.write(reference)
	examplePages.write(folder / 'examples')


def addMathjax(folder):
	for part in mathjaxParts:
		into = folder / part
		into.parent.mkdir(parents=True, exist_ok=True)
		(shutil.copytree if (mathjax / part).is_dir() else shutil.copyfile)(mathjax / part, into)


def build(folder):
	"""Makes the site anew in folder/html.

	:returns: exit code of Sphinx, or 1 where a link leads nowhere
	"""
	folder = pathlib.Path(folder)
	for part in ('source', 'doctrees', 'html'):
		shutil.rmtree(folder / part, ignore_errors=True)
	source, html = folder / 'source', folder / 'html'
	source.mkdir(parents=True)
	writeSources(source)
	options = ['--quiet', '--fail-on-warning', '--keep-going', '--builder', 'html', '--conf-dir', str(pathlib.Path(__file__).parent)]
	code = build_main([*options, '--doctree-dir', str(folder / 'doctrees'), str(source), str(html)])
	addMathjax(html / '_static/mathjax')
	broken = links.broken(html)
	for line in broken:
		print(line, file=sys.stderr)
	return code or int(bool(broken))


def main():
	argparse.ArgumentParser(prog='./run docs', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
	folder = project / 'build/docs'
	code = build(folder)
	if code == 0:
		print(f'The documentation: {folder}/html/index.html')
	return code


if __name__ == '__main__':
	sys.exit(main())
