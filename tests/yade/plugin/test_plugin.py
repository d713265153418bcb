# SPDX-License-Identifier: GPL-2.0-or-later
"""The plug-in is loaded with YADE, is the one compiled for it, and refuses with a message where it is not."""

import os
import pathlib
import re
import subprocess
import sys

import yade
from yade import polytope


def testCompiledForThisYade():
	info = polytope.buildInfo()
	assert info['yadeVersion'] == yade.config.version
	assert info['yadeFeatures'] == yade.config.features
	assert yade.config.highPrecisionName.lower() == 'precision' + info['precision']


def testItsVersionIsTheOneToCite():
	"""tests/tools/test_package.py compares that of the sources, the package and the changes."""
	text = (pathlib.Path(__file__).resolve().parents[3] / 'CITATION.cff').read_text()
	assert re.search(r'^version: (.*)$', text, re.MULTILINE)[1] == polytope.__version__


def yadeWithout(missing, folder, script):
	"""Runs a script in a YADE whose library folder is this one's, but for one file of the plug-in."""
	library = folder / os.path.relpath(yade.config.libDir, yade.config.prefix)
	(library / 'polytope-py').mkdir(parents=True)
	for place in ('.', 'polytope-py'):
		for name in os.listdir(os.path.join(yade.config.libDir, place)):
			if name not in (missing, 'polytope-py'):
				(library / place / name).symlink_to(os.path.join(yade.config.libDir, place, name))
	environment = dict(os.environ, YADE_PREFIX=str(folder))
	return subprocess.run([sys.executable, '-c', script], env=environment, capture_output=True, text=True, timeout=1800)


def testYadeRunsOnWithoutClassesThatCannotBeLoaded(tmp_path):
	run = yadeWithout('_polytope.so', tmp_path, 'import yade; yade.Sphere(); print("went on")')
	assert run.returncode == 0
	assert 'went on' in run.stdout
	assert 'yade-polytope' in run.stderr and '_polytope.so' in run.stderr and 'Build it again for this YADE' in run.stderr


def testImportTellsWhyThereIsNoPlugin(tmp_path):
	run = yadeWithout('_polytope.so', tmp_path, 'import yade\nfrom yade import polytope')
	assert run.returncode == 1
	assert run.stderr.splitlines()[-2].startswith('ImportError: the plug-in yade-polytope')
