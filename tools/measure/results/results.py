# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes figures into README.md and docs/*.md from the results in docs/results, so that text and data cannot part.

	./run python tools/measure/results/results.py                               writes all figures anew
	./run python tools/measure/results/results.py --check                       ends with 1 if one differs from its data, and names it
	./run python tools/measure/results/results.py --take search output/…/log-….txt   takes over new results first

What stands between <!-- from NAME --> and <!-- end --> is written by the function of that name in figures.py.
"""

import argparse
import pathlib
import re
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from figures import figures, results

project = pathlib.Path(__file__).resolve().parents[3]
place = re.compile(r'(<!-- from ([\w.]+) -->)(.*?)(<!-- end -->)', re.DOTALL)


def pages(root):
	return [root / 'README.md', *sorted((root / 'docs').glob('*.md'))]


def refreshed(text, folder, name):
	"""A page with its figures as the data says. ValueError: a figure that is not known, or a marker that does not end."""

	def figure(match):
		if match.group(2) not in figures:
			raise ValueError(f"{name}: there is no figure '{match.group(2)}'; there are {', '.join(sorted(figures))}")
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


def main():
	parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
	parser.add_argument('--check', action='store_true', help='only says what differs')
	parser.add_argument('--take', nargs=2, metavar=('NAME', 'FILE'), help=f'new results: {", ".join(results)}')
	parser.add_argument('--root', type=pathlib.Path, default=project, help='folder with README.md and docs (the project)')
	arguments = parser.parse_args()
	if arguments.take:
		name, file = arguments.take
		if name not in results:
			parser.error(f"--take: there are no results '{name}'; there are {', '.join(results)}")
		shutil.copyfile(file, arguments.root / 'docs/results' / results[name])
	try:
		found = list(differing(arguments.root))
	except ValueError as error:
		sys.exit(str(error))
	for page, text in found:
		print(f'{page.name} {"differs from docs/results" if arguments.check else "written"}')
		if not arguments.check:
			page.write_text(text)
	sys.exit(bool(found) and arguments.check)


if __name__ == '__main__':
	main()
