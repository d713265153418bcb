# SPDX-License-Identifier: GPL-2.0-or-later
"""Each class of the plug-in is registered in its own file (pkg/polytope/host/Classes.hpp): one that is forgotten would be missing in YADE."""

import pathlib
import re

root = pathlib.Path(__file__).resolve().parents[3]


def testEachClassIsRegisteredOnce():
	folder = root / 'pkg/polytope'
	headers = [path.read_text() for path in folder.glob('*/*.hpp') if path.name != 'Classes.hpp']
	declared = [name for text in headers for name in re.findall(r'^\s*REGISTER_SERIALIZABLE\((\w+)\)', text, re.MULTILINE)]
	registered = [
		name
		for path in folder.glob('*/*.cpp')
		for names in re.findall(r'POLYTOPE_CLASSES\(((?:\(\w+\)\s*)+)\)', path.read_text())
		for name in re.findall(r'\w+', names)
	]
	declared = [name for name in declared if name != 'KLASS']  # in a macro
	assert len(declared) > 20 and sorted(declared) == sorted(registered)
