# SPDX-License-Identifier: GPL-2.0-or-later
"""Places in the C++ sources where one operator, sign or number may be another, and the text that makes it so at run time (Switch.hpp)."""

import re
from dataclasses import asdict, dataclass

names = {'+': 'Plus', '-': 'Minus', '*': 'Times', '/': 'Over', '<': 'Less', '<=': 'LessEqual', '>': 'Greater', '>=': 'GreaterEqual'}
names.update({'==': 'Equal', '!=': 'Unequal'})
relations = ('<', '<=', '>', '>=')
others = {'+': ['-'], '-': ['+'], '*': ['/'], '/': ['*'], '==': ['!='], '!=': ['==']}
others.update({op: [other for other in relations if other != op] for op in relations})
precedence = {**{op: '<' for op in relations}, '+': '+', '-': '+', '*': '*', '/': '*', '==': '==', '!=': '=='}
"""For each operator, the one of Switch.hpp that binds as it does."""

binary = re.compile(r'(?<=\s)([+\-*/<>]|[<>=!]=)(?=\s)')
sign = re.compile(r'(?<=[(\[{])-(?=[A-Za-z_(])|(?<=[,=?:*<>&|] )-(?=[A-Za-z_(])|(?<=return )-(?=[A-Za-z_(])|(?<=[,=?:] )-(?=[A-Za-z_(])')
increment = re.compile(r'(?<=\s)[+-]=(?=\s)')
number = re.compile(r'(?<![\w.<>[\'])(\d+(?:\.\d*)?(?:e[-+]?\d+)?)(?![\w.>\]\'])')
leftAlone = re.compile(r'^\s*(?:#|template\b|using\b|case\b|friend\b)|constexpr|static_assert|operator|"|\bfor \(|\benum\b|\[\[|__builtin')
"""Lines without mutants: what the compiler computes itself cannot be switched; messages; loops over indices, which would leave their arrays."""


def brackets(line):
	"""Depth of square brackets at each column: indices would leave their arrays, and bounds are the compiler's."""
	depths, depth = [], 0
	for letter in line:
		depth += (letter == '[') - (letter == ']')
		depths.append(depth)
	return depths


@dataclass
class Mutant:
	id: int
	file: str
	line: int
	column: int
	kind: str  # arithmetic, comparison, sign, increment, constant
	original: str
	mutant: str
	source: str

	row = asdict

	def text(self):
		"""What stands in the place of the original."""
		if self.kind == 'sign':
			return f'mutation::Sign<{self.id}>{{}}->*'
		if self.kind == 'increment':
			return f'{self.original} mutation::Increment<{self.id}>{{}} %='
		if self.kind == 'constant':
			return f'mutation::constant<{self.id}>({self.original}, {self.change})'
		op = precedence[self.original]
		place = f'mutation::Binary<{self.id}, mutation::{names[self.original]}, mutation::{names[self.mutant]}>{{}}'
		return f'{op} {place} {op}'

	@property
	def change(self):
		return 1 if self.mutant.endswith('+ 1') else -1


def withoutComments(text):
	"""The text with blanks for comments, so that columns stay."""

	def blank(match):
		return re.sub(r'[^\n]', ' ', match.group())

	return re.sub(r'//[^\n]*|/\*.*?\*/', blank, text, flags=re.DOTALL)


def sitesOfLine(line):
	"""(column, kind, original, mutants)."""
	for match in binary.finditer(line):
		op = match.group()
		yield match.start(), 'arithmetic' if op in '+-*/' else 'comparison', op, others[op]
	for match in sign.finditer(line):
		yield match.start(), 'sign', '-', ['']
	for match in increment.finditer(line):
		yield match.start(), 'increment', match.group(), ['-=' if match.group() == '+=' else '+=']
	for match in number.finditer(line):
		yield match.start(), 'constant', match.group(), [f'{match.group()} + 1', f'{match.group()} - 1']


def sites(path, name):
	"""Mutants of one file, without ids: (line, column, kind, original, mutants, source)."""
	text = path.read_text()
	depthOfDirective = False
	for index, (line, source) in enumerate(zip(withoutComments(text).splitlines(), text.splitlines(), strict=True)):
		continued, depthOfDirective = depthOfDirective, line.rstrip().endswith('\\')
		if continued or leftAlone.search(line):
			continue
		depth = brackets(line)
		for column, kind, original, mutants in sitesOfLine(line):
			if depth[column] > 0:
				continue
			yield name, index + 1, column, kind, original, mutants, source.strip()


def written(text, mutants):
	"""The text of a file with these mutants in it."""
	lines = text.split('\n')
	for mutant in sorted(mutants, key=lambda m: (m.line, -m.column)):
		line = lines[mutant.line - 1]
		assert line.startswith(mutant.original, mutant.column), mutant
		lines[mutant.line - 1] = line[: mutant.column] + mutant.text() + line[mutant.column + len(mutant.original) :]
	return '\n'.join(lines)
