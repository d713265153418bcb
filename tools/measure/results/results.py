# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of README.md and docs/*.md from the results in docs/results, so that text and data cannot part: the program behind `./run figures`.

	./run figures                              writes all figures anew
	./run figures --check                      ends with 1 if one differs from its data, and names the page
	./run figures --take bench output/bench    takes over new results first, for all their figures
	./run figures --measure bench              runs ./run bench in full and takes over what it finds

What stands between <!-- from NAME --> and <!-- end --> is written by the function of that name. Where there are no results yet, the text
stays as it is.
"""

import argparse
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import benchFigures
import findingsFigures
import mutationFigures
import searchFigures
import tradeoffFigures

project = pathlib.Path(__file__).resolve().parents[3]
place = re.compile(r'(<!-- from ([\w.]+) -->)(.*?)(<!-- end -->)', re.DOTALL)
kinds = {
	'accuracy': (findingsFigures, findingsFigures.files['accuracy']),
	'bench': (benchFigures, benchFigures.file),
	'mutation': (mutationFigures, mutationFigures.file),
	'paper': (findingsFigures, findingsFigures.files['paper']),
	'search': (searchFigures, searchFigures.file),
	'tradeoff': (tradeoffFigures, tradeoffFigures.file),
}
"""Name of the results → module with taken() and figures; file in docs/results."""
figures = {name: figure for module, _ in kinds.values() for name, figure in module.figures.items()}
"""Name in the pages → function of the folder with the results that gives Markdown."""


def pages(root):
	return [root / 'README.md', *sorted((root / 'docs').glob('*.md'))]


def refreshed(text, folder, name):
	"""A page with its figures as the data says. ValueError: a figure that is not known, or a marker that does not end."""

	def figure(match):
		if match.group(2) not in figures:
			raise ValueError(f"{name}: there is no figure '{match.group(2)}'; there are {', '.join(sorted(figures))}")
		if not (folder / kinds[match.group(2).partition('.')[0]][1]).exists():
			return match.group()
		value = figures[match.group(2)](folder)
		return match.group(1) + (f'\n{value}\n' if '\n' in match.group(3) else value) + match.group(4)

	if len(re.findall('<!-- from ', text)) != len(place.findall(text)) or len(re.findall('<!-- end -->', text)) != len(place.findall(text)):
		raise ValueError(f'{name}: <!-- from NAME --> without <!-- end -->, or the other way round')
	return place.sub(figure, text)


def differing(root):
	"""(page, its text as the data says) of those that differ."""
	for page in pages(root):
		text = page.read_text()
		new = refreshed(text, root / 'docs/results', page.name)
		if new != text:
			yield page, new


def take(root, name, source):
	"""What is kept of new results. ValueError: what is there cannot be taken."""
	module, file = kinds[name]
	try:
		text = module.taken(source)
	except (OSError, KeyError, TypeError) as error:
		raise ValueError(f'--take {name} {source}: not the results of a whole run: {type(error).__name__}: {error}') from error
	(root / 'docs/results').mkdir(exist_ok=True)
	if hasattr(module, 'withKept'):  # parts may be run apart
		text = module.withKept(text, root / 'docs/results' / file)
	(root / 'docs/results' / file).write_text(text)


def main():
	parser = argparse.ArgumentParser(prog='./run figures', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
	parser.add_argument('--check', action='store_true', help='only says what differs')
	parser.add_argument(
		'--take', nargs=2, metavar=('NAME', 'PATH'), action='append', default=[], help=f'new results: {", ".join(kinds)}; may be repeated'
	)
	parser.add_argument('--root', type=pathlib.Path, default=project, help='folder with README.md and docs (the project)')
	arguments = parser.parse_args()
	for name, _ in arguments.take:
		if name not in kinds:
			parser.error(f"--take: there are no results '{name}'; there are {', '.join(kinds)}")
	try:
		for name, source in arguments.take:
			take(arguments.root, name, pathlib.Path(source))
		found = list(differing(arguments.root))
	except ValueError as error:
		sys.exit(str(error))
	for page, text in found:
		print(f'{page.name} {"differs from docs/results" if arguments.check else "written"}')
		if not arguments.check:
			page.write_text(text)
	for name, (_, file) in kinds.items():
		if not (arguments.root / 'docs/results' / file).exists():
			print(f'no results of {name} yet: its figures stay as they are')
	sys.exit(bool(found) and arguments.check)


if __name__ == '__main__':
	main()
