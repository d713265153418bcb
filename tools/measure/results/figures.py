# SPDX-License-Identifier: GPL-2.0-or-later
"""The figures of the documentation, each a function of the folder with the results that gives Markdown. A target missed is said in bold."""

import re
import textwrap

results = {'search': 'search.txt'}
"""Name of the results → file in docs/results. Each says revision, seed, date and what it was run on."""
width = 140


def thousands(number):
	return f'{number:,}'.replace(',', ' ')


class Search:
	"""A log of `./run search`."""

	columns = 'pairs overlap apart border exact queries error pivots iterations defects'.split()

	def __init__(self, folder):
		text = (folder / results['search']).read_text()
		self.date = re.search(r'predicate, (\S+)', text).group(1)
		self.revision, self.machine = re.search(r'^revision (\w+)\S*; (.*)$', text, re.MULTILINE).groups()
		self.seed = re.search(r'--seed (\d+)', text).group(1)
		rows = re.findall(r'^(\S+)' + r' +([\d.]+)' * len(self.columns) + '$', text, re.MULTILINE)
		self.rows = {name: dict(zip(self.columns, map(float, numbers), strict=True)) for name, *numbers in rows}
		self.all = self.rows.pop('all')
		line = re.search(r'^defects: +(.*)$', text, re.MULTILINE).group(1)
		self.defects = {name: int(count) for name, count in re.findall(r'(\S[^,]*?) (\d+)(?:, |$)', line)}


def searchPairs(folder):
	return f'{Search(folder).all["pairs"] / 1e6:.0f} million'


def searchVerdict(folder):
	defects = {name: count for name, count in Search(folder).defects.items() if count}
	if defects:
		return '**' + ', '.join(f'{name}: {count}' for name, count in defects.items()) + '**'
	return 'no contact missed, none invented'


def searchSummary(folder):
	search = Search(folder)
	text = f"""In {search.all['pairs'] / 1e6:.0f} million pairs of {len(search.rows)} kinds, {search.all['queries'] / 1e6:.0f} million queries, of which
		{thousands(int(search.all['exact']))} needed rational arithmetic to be judged: {searchVerdict(folder)}; s* within {search.all['error']} of the
		8 roundings of the pair's reach that are stated, after at most {search.all['pivots']:.0f} pivots and {search.all['iterations']:.0f} iterations
		({search.date}, revision {search.revision[:7]}, seed {search.seed}; {search.machine}; `docs/results/search.txt`)."""
	return textwrap.fill(' '.join(text.split()), width, break_long_words=False, break_on_hyphens=False)


figures = {
        'search.pairs': searchPairs,
        'search.verdict': searchVerdict,
        'search.summary': searchSummary,
}
