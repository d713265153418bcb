# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers, tables and paragraphs as Markdown."""

import textwrap

width = 140


def thousands(number):
	return f'{number:,}'.replace(',', ' ')


def paragraph(text):
	"""The text in lines as long as those of the pages."""
	return textwrap.fill(' '.join(text.split()), width, break_long_words=False, break_on_hyphens=False)


def table(titles, rows):
	"""A table of Markdown. Cells are texts; what would end a cell is escaped."""
	lines = [titles, ['---'] * len(titles), *rows]
	return '\n'.join('| ' + ' | '.join(str(cell).replace('|', '\\|').replace('\n', ' ') for cell in line) + ' |' for line in lines)


def bold(text):
	"""What is missed."""
	return f'**{text}**'


def short(number, digits=3):
	"""A number as people write it; 'inf' and what is a text already stays."""
	if number is None:
		return ''
	if isinstance(number, str):
		return number
	return f'{number:.{digits}g}'


def origin(about):
	"""Where results come from, in brackets at the end of a sentence.

	:param dict about: revision, date, machine, cores, load (not all have it), quick
	"""
	parts = [
		f'{about["machine"]}, {about["cores"]} cores',
		about['date'],
		'revision ' + about['revision'][:7] + (' with changes' if about['revision'].endswith('-dirty') else ''),
	]
	if about.get('seed') is not None:
		parts.append(f'seed {about["seed"]}')
	if about.get('quick'):
		parts.append('**the quick variant**')
	if (about.get('load') or 0) > 0.5:
		parts.append(f'the machine was busy when it began, {about["load"]:.1f} processes a minute before')
	return '; '.join(parts)
