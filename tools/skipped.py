# SPDX-License-Identifier: GPL-2.0-or-later
"""Names every test that `./run test` skipped, and every part that was not there to be tested.

Usage: skipped.py [--expect-core] [--expect-precision NAME]… FOLDER

FOLDER has the JUnit files of the run: core.xml (ctest) and one a precision (pytest). --expect-core: the whole of the core's tests should
have run; --expect-precision: so should the tests in this precision. With CI=true in the environment, ends with 1 if anything was skipped
that tools/skipsAllowed.txt does not allow.
"""

import argparse
import collections
import os
import pathlib
import re
import sys
import xml.etree.ElementTree

# what the core's tests consist of: a part that the build left out for want of a package has no test at all
coreParts = {
	'the core, with GoogleTest': r'^(?!Clang\.|Fuzz\.|Search$|Instructions$|WithoutIpopt$|InstructionSet\.)',
	'the core without Ipopt (is Ipopt missing?)': r'^WithoutIpopt$',
	'the core with lesser instruction sets': r'^InstructionSet\.',
	'instructions of a query': r'^Instructions$',
	'fuzz corpus': r'^Fuzz\.',
	'search': r'^Search$',
	"the core's files looked at by clang": r'^Clang\.',
}


def skippedIn(path):
	"""(names of all tests, [(name, reason)] of those skipped) of a JUnit file of ctest or pytest."""
	names, skipped = [], []
	for case in xml.etree.ElementTree.parse(path).getroot().iter('testcase'):
		name = case.get('name')
		names.append(name)
		mark = case.find('skipped')
		if mark is not None:
			printed = '\n'.join(output.text or '' for output in case.iter('system-out'))
			# pytest has the reason as message; ctest says that there was a skip, GoogleTest prints why
			found = re.search(r': Skipped\n(.*)', printed)
			last = printed.strip().splitlines()[-1:] if mark.get('message', '').startswith('SKIP_RETURN_CODE') else []
			reason = found.group(1) if found else (last or [mark.get('message') or 'no reason given'])[0]
			if case.get('classname', name) != name:
				name = f"{case.get('classname')}.{name}"
			skipped.append((name, reason.strip()))
	return names, skipped


def allSkipped(folder, core, precisions):
	"""[(name, reason)] of all files of the folder."""
	found = []
	for path in sorted(folder.glob('*.xml')):
		names, skipped = skippedIn(path)
		found += [(f'{path.stem}: {name}', reason) for name, reason in skipped]
		if core and path.stem == 'core':
			found += [
				(f'core: {part}', 'not built') for part, pattern in coreParts.items() if not any(re.search(pattern, name) for name in names)
			]
	if core and not (folder / 'core.xml').exists():
		found.append(('core', 'not built'))
	return found + [(f'precision {name}', 'this YADE has none') for name in precisions if not (folder / f'{name}.xml').exists()]


def allowedPatterns():
	lines = (pathlib.Path(__file__).parent / 'skipsAllowed.txt').read_text().splitlines()
	return [re.compile(line) for line in lines if line.strip() and not line.startswith('#')]


def main(arguments=None):
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
	parser.add_argument('--expect-core', action='store_true')
	parser.add_argument('--expect-precision', action='append', default=[])
	parser.add_argument('folder', type=pathlib.Path)
	given = parser.parse_args(arguments)
	found = allSkipped(given.folder, given.expect_core, given.expect_precision)
	byReason = collections.defaultdict(list)
	for name, reason in found:
		byReason[reason].append(name)
	print(f'skipped: {len(found)}')
	for reason, names in byReason.items():
		print(f'  {len(names)} × {reason}')
		for name in names[:8]:
			print(f'      {name}')
		if len(names) > 8:
			print(f'      … and {len(names) - 8} more')
	unexpected = [
		f'{name}: {reason}' for name, reason in found if not any(pattern.search(f'{name}: {reason}') for pattern in allowedPatterns())
	]
	if os.environ.get('CI', '').lower() in ('true', '1') and unexpected:
		print(f'CI: {len(unexpected)} of them are not allowed by tools/skipsAllowed.txt; the first: {unexpected[0]}')
		return 1
	return 0


if __name__ == '__main__':
	sys.exit(main())
