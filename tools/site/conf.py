# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of Sphinx; build.py calls it, in a Python that has imported YADE."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import yadeText
from docutils import nodes
from yade import polytope

project = 'yade-polytope'
version = release = polytope.__version__
copyright = 'the authors of yade-polytope; GPL-2.0-or-later'
extensions = ['myst_parser', 'sphinx.ext.autodoc', 'sphinx.ext.autosummary', 'sphinx.ext.mathjax']

# pages: headings have the anchors that GitHub gives them, $…$ is a formula
myst_enable_extensions = ['dollarmath']
myst_heading_anchors = 4
myst_dmath_double_inline = True
smartquotes = False  # -- is the beginning of an option
suppress_warnings = ['myst.header']  # a page may skip a level of headings

# help texts
autosummary_generate = False
autodoc_member_order = 'bysource'
autodoc_typehints = 'none'
add_module_names = False
toc_object_entries_show_parents = 'hide'
default_role = 'literal'
python_maximum_signature_line_length = 120

# appearance
html_theme = 'furo'
html_title = f'yade-polytope {version}'
html_static_path = [str(pathlib.Path(__file__).parent / 'static')]
html_css_files = ['site.css']
html_copy_source = html_show_sphinx = False
html_show_search_summary = False  # it would fetch pages, which a browser refuses to do from a folder
html_theme_options = {'source_edit_link': '', 'source_view_link': ''}
pygments_style, pygments_dark_style = 'friendly', 'monokai'

# formulas, without a network
mathjax_path = 'mathjax/MathJax.js?config=TeX-AMS_SVG'
mathjax2_config = {
	'messageStyle': 'none',
	'showMathMenu': False,
	'tex2jax': {'inlineMath': [['\\(', '\\)']], 'displayMath': [['\\[', '\\]']], 'ignoreClass': '.*', 'processClass': 'math'},
	'SVG': {'linebreaks': {'automatic': True}, 'scale': 90},
}


def clean(app, what, name, obj, options, lines):
	"""Python's help texts name pages, and several arguments at once, as the reader of a prompt needs it."""
	lines[:] = yadeText.links(yadeText.separate('\n'.join(lines))).split('\n')


def aimOf(app, text, page, named):
	"""Where code in a sentence leads: to the source of an example; to a function or class, where the page names it first."""
	name = yadeText.example(text)
	if name and f'examples/{name}' in app.env.found_docs:
		return app.builder.get_relative_uri(page, f'examples/{name}')
	name = yadeText.object_(text)
	entry = app.env.get_domain('py').objects.get(name)
	if entry is None or name in named or page.startswith('api/'):
		return None
	named.add(name)
	return f'{app.builder.get_relative_uri(page, entry.docname)}#{entry.node_id}'


def linkCode(app, tree, page):
	named = set()
	for literal in list(tree.findall(nodes.literal)):
		aim = None if isinstance(literal.parent, nodes.reference | nodes.title) else aimOf(app, literal.astext(), page, named)
		if aim:
			link = nodes.reference('', internal=True, refuri=aim)
			literal.replace_self(link)
			link += literal


def writeDashes(app, tree, page):
	"""Between an argument and its meaning; in sentences, where smartquotes would write them, -- is an option."""
	for text in list(tree.findall(nodes.Text)):
		if text == ' -- ':
			text.parent.replace(text, nodes.Text(' – '))


def setup(app):
	app.connect('autodoc-process-docstring', clean)
	app.connect('doctree-resolved', linkCode)
	app.connect('doctree-resolved', writeDashes)
