# SPDX-License-Identifier: GPL-2.0-or-later
"""A page for each script of examples/, with its source."""

import ast
import pathlib
import shutil

__all__ = ['write']

project = pathlib.Path(__file__).resolve().parents[2]
folders = {
	'.': 'Examples',
	'verification': 'Verification',
	'paper': 'The paper\'s simulations',
	'peers': 'Scenes that YADE ships for its own polyhedra',
}


def write(folder):
	text = 'Examples\n========\n\n``./run python examples/NAME.py`` runs one; files go into ``output/``.\n\n'
	for part, caption in folders.items():
		text += f'.. toctree::\n   :maxdepth: 1\n   :caption: {caption}\n\n'
		for path in sorted((project / 'examples' / part).glob('*.py')):
			name = path.relative_to(project / 'examples').with_suffix('').as_posix()
			text += f'   {name}\n'
			writeOne(path, name, folder)
	(folder / 'index.rst').write_text(text)


def writeOne(path, name, folder):
	into = folder / f'{name}.rst'
	into.parent.mkdir(parents=True, exist_ok=True)
	said = (ast.get_docstring(ast.parse(path.read_text())) or '').split('\n\n')[0]
	head = f'{path.stem}\n{"=" * len(path.stem)}\n\n'
	shutil.copyfile(path, into.with_suffix('.py'))
	into.write_text(f'{head}{said}\n\n.. literalinclude:: {path.name}\n   :language: python\n')
