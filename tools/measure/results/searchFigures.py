# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of `./run search`, from its log."""

import re

from text import paragraph, thousands

file = 'search.txt'


class Search:
	"""A log of `./run search`."""

	columns = 'pairs overlap apart border exact queries error compared volume force moment pivots iterations defects'.split()

	def __init__(self, folder):
		text = (folder / file).read_text()
		self.date = re.search(r'arithmetic, (\S+)', text).group(1)
		self.revision, self.machine = re.search(r'^revision (\w+)\S*; (.*)$', text, re.MULTILINE).groups()
		self.seed = re.search(r'--seed (\d+)', text).group(1)
		rows = re.findall(r'^(\S+)' + r' +([\d.]+)' * len(self.columns) + '$', text, re.MULTILINE)
		self.rows = {name: dict(zip(self.columns, map(float, numbers), strict=True)) for name, *numbers in rows}
		self.all = self.rows.pop('all')
		line = re.search(r'^defects: +(.*)$', text, re.MULTILINE).group(1)
		self.defects = {name: int(count) for name, count in re.findall(r'(\S[^,]*?) (\d+)(?:, |$)', line)}


def pairs(folder):
	return f'{Search(folder).all["pairs"] / 1e6:.0f} million'


def verdict(folder):
	defects = {name: count for name, count in Search(folder).defects.items() if count}
	touch = '' if {'miss', 'false contact'} & set(defects) else 'no contact missed, none invented; '
	return touch + (
		'**' + ', '.join(f'{name}: {count}' for name, count in defects.items()) + '**'
		if defects
		else 'volume, force and moment right to rounding'
	)


def summary(folder):
	search = Search(folder)
	return paragraph(f"""In {search.all['pairs'] / 1e6:.0f} million pairs of {len(search.rows)} kinds, {search.all['queries'] / 1e6:.0f} million queries, of which
		{thousands(int(search.all['exact']))} needed rational arithmetic to be judged: {verdict(folder)}. s* was within {search.all['error']} of the
		8 roundings of the pair's reach that are stated, after at most {search.all['pivots']:.0f} pivots and {search.all['iterations']:.0f} iterations. Of
		{thousands(int(search.all['compared']))} pairs that were compared with 113 digits the largest error, over what is allowed, was
		{search.all['volume']} of the volume, {search.all['force']} of the force and {search.all['moment']} of the moment
		({search.date}, revision {search.revision[:7]}, seed {search.seed}; {search.machine}; `docs/results/search.txt`).""")


figures = {'search.pairs': pairs, 'search.verdict': verdict, 'search.summary': summary}


def taken(source):
	"""What is kept of a log: all of it."""
	return source.read_text()
